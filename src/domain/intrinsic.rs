//! Intrinsic triangulations: triangles known by their side lengths, glued along sides, and flips to Delaunay.
//!
//! # Definition
//! A surface made of flat triangles has a metric of its own. An *intrinsic edge* is a straight line of that metric; it need not
//! be straight in space. Flipping an edge replaces it by the other diagonal of the two triangles beside it, laid out flat. The
//! triangulation is *Delaunay* when the angles opposite each interior edge add up to at most π.
//!
//! # Guarantees
//! The surface does not change: flips keep vertices, boundary, area and metric. Two vertices may be joined by several edges and
//! a vertex to itself (a Δ-complex). [`make_delaunay`](IntrinsicTriangulation::make_delaunay) ends, by two arguments:
//! * Where the triangles beside an edge lie straight in space (all triangles of a planar mesh, and those of the input that no
//!   flip has touched) the edge is judged exactly on positions. In the plane such flips end, since each lowers the triangulated
//!   graph of |x|²; in space each uses up two triangles of the input.
//! * Elsewhere an edge is flipped only if its cotangent sum, from the stored lengths and areas, is negative beyond rounding *and* the
//!   sum of the six cotangents of the two triangles decreases as stored. In exact arithmetic the second follows from the first
//!   (the harmonic index of Musin). The stored numbers of all triangles, added exactly, decrease with each such flip, so no state
//!   comes back.
//!
//! # Limitations
//! In space the lengths are rounded, so an edge whose angles add up to π within rounding may remain on either side of it. Flips
//! cannot cross boundary edges: the angle opposite one may be obtuse.
//!
//! # References
//! \[bobenko-springborn2007\] (existence, uniqueness of the Laplacian); \[musin1997\] (the harmonic index).

mod flips;

use super::Surface;
use super::geometry::{self, Vec3};

/// "No half-edge": the outside of a boundary edge; no face. The connectivity of a surface numbers no more than half as many.
const NONE: u32 = u32::MAX;

/// A triangulation of a surface by intrinsic edges. Edge e has the half-edges 2e and 2e + 1, running opposite ways.
#[derive(Clone, Debug)]
pub struct IntrinsicTriangulation<'a> {
    surface: &'a Surface,
    plane: Option<[usize; 2]>,
    /// Whether the first triangle of a planar surface, and so every one, is counter-clockwise there.
    counter_clockwise: bool,
    half_edges: Vec<HalfEdge>,
    length: Vec<f64>,
    faces: Vec<Face>,
    /// Of each edge, whether a triangle beside it was touched by a flip.
    touched: Vec<bool>,
    flips: usize,
}

/// A side of an edge, with all that a walk round a triangle asks for in one place. Twelve bytes.
#[derive(Clone, Copy, Debug)]
struct HalfEdge {
    /// The vertex where it starts.
    origin: u32,
    /// The half-edge that follows it round its triangle.
    next: u32,
    /// Its triangle.
    face: u32,
}

impl HalfEdge {
    /// One without a triangle.
    const OUTSIDE: HalfEdge = HalfEdge { origin: NONE, next: NONE, face: NONE };
}

#[derive(Clone, Copy, Debug)]
struct Face {
    doubled_area: f64,
    /// One of its half-edges.
    first: u32,
    /// The face of the surface that it is; [`NONE`] once a flip has touched it.
    source: u32,
    /// Whether it is the triangle that its corners span in space.
    straight: bool,
}

/// Why a surface has no intrinsic triangulation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum IntrinsicError {
    /// A face with more than three corners.
    #[error("face {face} has {corners} corners; triangulate the mesh first")]
    NotATriangle {
        /// The face.
        face: usize,
        /// How many corners it has.
        corners: usize,
    },
    /// An edge with more than two faces.
    #[error("edge ({a}, {b}) has {faces} faces; separate the sheets first")]
    NonManifold {
        /// One end.
        a: usize,
        /// The other end.
        b: usize,
        /// How many faces lie at it.
        faces: usize,
    },
    /// Neighbouring faces that cannot be made to agree in orientation.
    #[error("the faces beside edge ({a}, {b}) disagree in orientation; cut the surface open first")]
    NotOrientable {
        /// One end.
        a: usize,
        /// The other end.
        b: usize,
    },
}

impl<'a> IntrinsicTriangulation<'a> {
    /// The triangulation by the faces of a surface that `keep` admits; the sides of the others become boundary.
    ///
    /// Pinched vertices (two fans that share nothing but the vertex) are admitted. Faces must not be degenerate.
    ///
    /// # Errors
    /// A face that is not a triangle, an edge with more than two faces, faces that disagree in orientation.
    pub fn new(surface: &'a Surface, keep: impl Fn(usize) -> bool) -> Result<Self, IntrinsicError> {
        IntrinsicTriangulation::with_areas(surface, |face| {
            keep(face).then(|| surface.triangle(face).map_or(0.0, |t| area_in_space(t.map(|v| surface.point(v)))))
        })
    }

    /// The same where twice the area of each face is known: `doubled_area` has it of those that are admitted.
    ///
    /// # Errors
    /// As [`new`](IntrinsicTriangulation::new).
    pub fn with_areas(
        surface: &'a Surface,
        doubled_area: impl Fn(usize) -> Option<f64>,
    ) -> Result<Self, IntrinsicError> {
        let edges = surface.topology().edges();
        let mut result = IntrinsicTriangulation {
            surface,
            plane: surface.plane(),
            counter_clockwise: false,
            half_edges: vec![HalfEdge::OUTSIDE; 2 * edges.len()],
            length: edges.iter().map(|&[a, b]| distance(surface.point(a), surface.point(b))).collect(),
            faces: Vec::with_capacity(surface.faces().len()),
            touched: vec![false; edges.len()],
            flips: 0,
        };
        let rings = result.take_half_edges(|face| doubled_area(face).is_some())?;
        for (source, ring) in rings.into_iter().enumerate() {
            if let Some(area) = doubled_area(source) {
                result.push_face(ring, area, source);
            }
        }
        if let (Some(axes), false) = (result.plane, result.faces.is_empty()) {
            let [a, b, c] = result.corners(0).map(|v| axes.map(|k| surface.positions()[v][k]));
            result.counter_clockwise = geometry::orient2d(a, b, c).is_gt();
        }
        Ok(result)
    }

    /// Sets the origin of each half-edge; returns those around each face that is kept.
    fn take_half_edges(&mut self, keep: impl Fn(usize) -> bool) -> Result<Vec<[u32; 3]>, IntrinsicError> {
        let topology = self.surface.topology();
        let mut rings = vec![[0; 3]; self.surface.faces().len()];
        for (e, &[a, b]) in topology.edges().iter().enumerate() {
            let sides = || topology.sides(e).iter().filter(|side| keep(side.face()));
            if sides().count() > 2 {
                return Err(IntrinsicError::NonManifold { a, b, faces: sides().count() });
            }
            for side in sides() {
                let corners = self.surface.faces()[side.face()].len();
                if corners != 3 {
                    return Err(IntrinsicError::NotATriangle { face: side.face(), corners });
                }
                let h = 2 * e + usize::from(!side.forward());
                if self.half_edges[h].origin != NONE {
                    return Err(IntrinsicError::NotOrientable { a, b });
                }
                self.half_edges[h].origin = if side.forward() { a } else { b } as u32;
                rings[side.face()][side.corner()] = h as u32;
            }
        }
        Ok(rings)
    }

    fn push_face(&mut self, ring: [u32; 3], doubled_area: f64, source: usize) {
        for k in 0..3 {
            let half_edge = &mut self.half_edges[ring[k] as usize];
            (half_edge.next, half_edge.face) = (ring[(k + 1) % 3], self.faces.len() as u32);
        }
        self.faces.push(Face { doubled_area, first: ring[0], source: source as u32, straight: true });
    }

    /// Where a half-edge starts.
    fn origin(&self, half_edge: usize) -> usize {
        self.half_edges[half_edge].origin as usize
    }

    /// The half-edge that follows one round its triangle.
    fn next(&self, half_edge: usize) -> usize {
        self.half_edges[half_edge].next as usize
    }

    /// Whether a half-edge has a triangle.
    fn is_inside(&self, half_edge: usize) -> bool {
        self.half_edges[half_edge].face != NONE
    }

    /// The surface.
    pub fn surface(&self) -> &'a Surface {
        self.surface
    }

    /// The number of flips so far.
    pub fn flips(&self) -> usize {
        self.flips
    }

    /// The number of edges, which flips keep: edge e of the surface becomes edge e.
    pub fn edge_count(&self) -> usize {
        self.length.len()
    }

    /// The half-edges of an edge that have a triangle: two inside, one on the boundary, none where no face was kept.
    pub fn sides(&self, edge: usize) -> impl Iterator<Item = usize> + Clone + '_ {
        [2 * edge, 2 * edge + 1].into_iter().filter(|&h| self.is_inside(h))
    }

    /// The ends of an edge, equal for a loop; `None` for an edge of the surface none of whose faces was kept.
    pub fn ends(&self, edge: usize) -> Option<[usize; 2]> {
        let (h, t) = (2 * edge, 2 * edge + 1);
        match (self.is_inside(h), self.is_inside(t)) {
            (true, true) => Some([self.origin(h), self.origin(t)]),
            (true, false) => Some([self.origin(h), self.origin(self.next(h))]),
            (false, true) => Some([self.origin(t), self.origin(self.next(t))]),
            (false, false) => None,
        }
    }

    /// The length of an edge.
    pub fn length(&self, edge: usize) -> f64 {
        self.length[edge]
    }

    /// The number of triangles.
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// The triangle to the left of a half-edge that has one.
    pub fn face(&self, half_edge: usize) -> usize {
        self.half_edges[half_edge].face as usize
    }

    /// The three half-edges of a triangle in order; half-edge h belongs to edge h/2.
    pub fn half_edges(&self, face: usize) -> [usize; 3] {
        let h = self.faces[face].first as usize;
        [h, self.next(h), self.next(self.next(h))]
    }

    /// The corners of a triangle: where its half-edges start.
    pub fn corners(&self, face: usize) -> [usize; 3] {
        self.half_edges(face).map(|h| self.origin(h))
    }

    /// The vertex opposite a half-edge that has a triangle.
    pub fn apex(&self, half_edge: usize) -> usize {
        self.origin(self.next(self.next(half_edge)))
    }

    /// Twice the area of a triangle.
    pub fn doubled_area(&self, face: usize) -> f64 {
        self.faces[face].doubled_area
    }

    /// Whether the triangle is the one that its corners span in space, so that positions give its metric.
    pub fn is_straight(&self, face: usize) -> bool {
        self.is_planar() || self.faces[face].straight
    }

    /// The face of the surface that a triangle is, corner for corner; `None` once a flip has touched it.
    pub fn source(&self, face: usize) -> Option<usize> {
        Some(self.faces[face].source).filter(|&source| source != NONE).map(|source| source as usize)
    }

    /// Whether the surface lies in a coordinate plane: then every triangle stays straight and every decision is exact.
    pub fn is_planar(&self) -> bool {
        self.plane.is_some()
    }

    /// The cotangent of the angle opposite a half-edge, `(b² + c² − a²)/4A` from lengths and area.
    ///
    /// Its absolute error is below `8u (a² + b² + c²)/2A` plus what earlier flips have left in lengths and area.
    pub fn cotangent_opposite(&self, half_edge: usize) -> f64 {
        let [a, b, c] = self.squares(half_edge);
        0.5 * (b + c - a) / self.doubled_area(self.face(half_edge))
    }

    /// The squared lengths of the side of a half-edge and of the two that follow it.
    fn squares(&self, half_edge: usize) -> [f64; 3] {
        let (n, p) = (self.next(half_edge), self.next(self.next(half_edge)));
        [half_edge, n, p].map(|h| self.length[h / 2] * self.length[h / 2])
    }
}

fn distance(p: Vec3, q: Vec3) -> f64 {
    let difference = q - p;
    match difference.norm_squared() {
        square if (1e-280..1e300).contains(&square) => square.sqrt(),
        // Scaled where the square would lose digits below the range, or leave it.
        _ if difference.amax() > 0.0 => (difference / difference.amax()).norm() * difference.amax(),
        _ => 0.0,
    }
}

/// Twice the area.
fn area_in_space(corners: [Vec3; 3]) -> f64 {
    let length = |k: usize| distance(corners[(k + 1) % 3], corners[(k + 2) % 3]);
    // Most accurate from the corner opposite the longest side, whose sine is the largest.
    let apex = (1..3).fold(0, |best, k| if length(k) > length(best) { k } else { best });
    geometry::doubled_area_in_space(corners[apex], corners[(apex + 1) % 3], corners[(apex + 2) % 3])
}
