//! Edge flips of triangle surfaces: legality decided exactly, O(1) for each flip, Delaunay by flips in the plane.
//!
//! # Definition
//! An interior edge `ab` with the triangle `abc` on its left and `bad` on its right is *flipped* by replacing the two
//! triangles by `dca` and `cdb`: the other diagonal of the quadrilateral `a, d, b, c`. The flip is *legal*
//! * in the plane, iff both new triangles are counter-clockwise (exact `orient2d`). Where both old ones are, this says that
//!   the quadrilateral is strictly convex. A degenerate triangle with an apex inside its longest side is mended by it.
//! * in space, iff neither new triangle is degenerate (exact). The flip is *extrinsic*: the surface changes its shape.
//!
//! In both, the new edge must not exist yet, and the edge must have exactly two sides that agree in orientation.
//! So the vertices, the number of faces, the boundary, the Euler characteristic and manifoldness never change; in the plane
//! the area does not change either.
//!
//! # Termination of [`Triangulation::flip_to_delaunay`]
//! A flip is made only where `d` lies strictly inside the circle `abc`. It lowers the piecewise linear lift of the mesh to
//! the paraboloid `z = x² + y²` strictly, so that an edge once flipped away never comes back: at most n(n−1)/2 flips
//! \[lawson1977\]. In practice there are O(n). Where it stops, no interior edge violates the Delaunay condition, because a
//! violating edge of two proper triangles always has a strictly convex quadrilateral. With a boundary that is not convex
//! this is the constrained Delaunay triangulation. *Exception*: a mesh that overlaps itself around a branch point may keep
//! a violating edge, where the other diagonal exists already.
//!
//! # Cost
//! Building O(F log valence), a flip O(1), a legality test one hash look-up and two or a few exact predicates.

use std::cmp::Ordering;
use std::collections::HashSet;

use super::{DomainError, Surface, geometry};

const NONE: usize = usize::MAX;

/// Why an edge cannot be flipped, or a surface not be edited by flips.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FlipError {
    /// A face with more than three corners.
    #[error("face {face} has {corners} corners; only triangles can be flipped: triangulate the mesh first")]
    NotTriangle {
        /// The face.
        face: usize,
        /// Its number of corners.
        corners: usize,
    },
    /// The flip would fold the surface, make a degenerate triangle or double an edge, or the edge has no two sides.
    #[error("edge ({a}, {b}) cannot be flipped legally")]
    Illegal {
        /// One end.
        a: usize,
        /// The other end.
        b: usize,
    },
    /// A planar algorithm was given a surface that is not planar.
    #[error(
        "the surface does not lie unfolded in a coordinate plane; flips to Delaunay are decided exactly only there"
    )]
    NotPlanar,
    /// A planar algorithm was given a triangle of zero area.
    #[error("face {face} has collinear corners; remove degenerate triangles before flipping to Delaunay")]
    Degenerate {
        /// The face.
        face: usize,
    },
}

/// The corners of the two triangles beside an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quad {
    /// The edge runs from `a` to `b`.
    pub a: usize,
    /// See `a`.
    pub b: usize,
    /// The apex of the triangle `abc` on the left.
    pub c: usize,
    /// The apex of the triangle `bad` on the right.
    pub d: usize,
}

/// A triangle surface that can be edited by flips.
///
/// Half-edge `3f + k` runs from corner `k` of face `f` to the next corner.
#[derive(Clone, Debug)]
pub struct Triangulation {
    faces: Vec<[usize; 3]>,
    /// The half-edge on the other side, or `NONE` where a flip is out of question.
    twins: Vec<usize>,
    /// All edges, for look-up only: the order of a hash set is never used.
    edges: HashSet<[usize; 2]>,
    positions: Vec<[f64; 3]>,
    /// Coordinates in which all faces are counter-clockwise, if the surface is planar.
    plane: Option<Vec<[f64; 2]>>,
}

impl Triangulation {
    /// Reads the connectivity off a triangle surface.
    ///
    /// # Errors
    /// A face with more than three corners.
    pub fn of(surface: &Surface) -> Result<Self, FlipError> {
        let triangle = |face| {
            surface.triangle(face).ok_or_else(|| FlipError::NotTriangle { face, corners: surface.faces()[face].len() })
        };
        let faces = (0..surface.faces().len()).map(triangle).collect::<Result<Vec<_>, _>>()?;
        let topology = surface.topology();
        let mut twins = vec![NONE; 3 * faces.len()];
        for edge in 0..topology.edges().len() {
            if let [s, t] = topology.sides(edge)
                && s.forward() != t.forward()
            {
                let (h, g) = (3 * s.face() + s.corner(), 3 * t.face() + t.corner());
                (twins[h], twins[g]) = (g, h);
            }
        }
        let edges = topology.edges().iter().copied().collect();
        let plane = counter_clockwise_plane(surface, &faces);
        Ok(Triangulation { faces, twins, edges, positions: surface.positions().to_vec(), plane })
    }

    /// The triangles.
    pub fn faces(&self) -> &[[usize; 3]] {
        &self.faces
    }

    /// The number of half-edges, three for each face.
    pub fn half_edges(&self) -> usize {
        self.twins.len()
    }

    /// The coordinates in which every proper face is counter-clockwise, if the surface is planar.
    pub fn plane(&self) -> Option<&[[f64; 2]]> {
        self.plane.as_deref()
    }

    /// The positions of three vertices.
    pub fn corners(&self, vertices: [usize; 3]) -> [[f64; 3]; 3] {
        vertices.map(|v| self.positions[v])
    }

    /// The edge of a half-edge as `[smaller, larger]`.
    pub fn edge(&self, half_edge: usize) -> [usize; 2] {
        sorted(self.corner(half_edge), self.corner(next(half_edge)))
    }

    /// The half-edge on the other side; `None` as for [`Triangulation::quad`].
    pub fn twin(&self, half_edge: usize) -> Option<usize> {
        Some(self.twins[half_edge]).filter(|&twin| twin != NONE)
    }

    /// The two triangles beside a half-edge; `None` on the boundary, at a non-manifold edge, where the two sides disagree in
    /// orientation.
    pub fn quad(&self, half_edge: usize) -> Option<Quad> {
        let twin = self.twins[half_edge];
        (twin != NONE).then(|| Quad {
            a: self.corner(half_edge),
            b: self.corner(twin),
            c: self.corner(next(next(half_edge))),
            d: self.corner(next(next(twin))),
        })
    }

    /// Whether the edge can be flipped legally; see the [module](self).
    pub fn is_legal(&self, half_edge: usize) -> bool {
        let Some(Quad { a, b, c, d }) = self.quad(half_edge) else { return false };
        if c == d || self.edges.contains(&sorted(c, d)) {
            return false;
        }
        match &self.plane {
            Some(at) => [[d, c, a], [c, d, b]].iter().all(|t| geometry::orient2d(at[t[0]], at[t[1]], at[t[2]]).is_gt()),
            None => [[d, c, a], [c, d, b]].iter().all(|&t| {
                let [p, q, r] = self.corners(t);
                !geometry::collinear(p, q, r)
            }),
        }
    }

    /// In the plane, how the right apex stands to the circle through the left triangle: `Greater` inside (the edge violates
    /// the Delaunay condition), `Equal` on it. Exact. `None` without two sides, and in space.
    pub fn in_circle(&self, half_edge: usize) -> Option<Ordering> {
        let (at, Quad { a, b, c, d }) = (self.plane.as_ref()?, self.quad(half_edge)?);
        Some(geometry::incircle(at[a], at[b], at[c], at[d]))
    }

    /// Flips an edge: the faces on its left and right become `dca` and `cdb`.
    ///
    /// # Errors
    /// The flip is not legal; nothing is changed.
    pub fn flip(&mut self, half_edge: usize) -> Result<(), FlipError> {
        let Some(Quad { a, b, c, d }) = self.quad(half_edge).filter(|_| self.is_legal(half_edge)) else {
            let [a, b] = self.edge(half_edge);
            return Err(FlipError::Illegal { a, b });
        };
        let twin = self.twins[half_edge];
        let (f, g) = (half_edge / 3, twin / 3);
        let outer = |h: usize| [self.twins[next(h)], self.twins[next(next(h))]];
        let ([bc, ca], [ad, db]) = (outer(half_edge), outer(twin));
        (self.faces[f], self.faces[g]) = ([d, c, a], [c, d, b]);
        for (h, other) in [(3 * f, 3 * g), (3 * f + 1, ca), (3 * f + 2, ad), (3 * g + 1, db), (3 * g + 2, bc)] {
            self.twins[h] = other;
            if other != NONE {
                self.twins[other] = h;
            }
        }
        self.edges.remove(&sorted(a, b));
        self.edges.insert(sorted(c, d));
        Ok(())
    }

    /// Flips edges of a planar surface until every interior edge is Delaunay; the number of flips made. Deterministic.
    ///
    /// # Errors
    /// The surface is not planar, or a face is degenerate.
    pub fn flip_to_delaunay(&mut self) -> Result<usize, FlipError> {
        let at = self.plane.as_ref().ok_or(FlipError::NotPlanar)?;
        let flat = |t: &[usize; 3]| geometry::orient2d(at[t[0]], at[t[1]], at[t[2]]).is_eq();
        if let Some(face) = self.faces.iter().position(flat) {
            return Err(FlipError::Degenerate { face });
        }
        let mut stack: Vec<usize> = (0..self.half_edges()).rev().collect();
        let mut flips = 0;
        while let Some(h) = stack.pop() {
            // Not legal although violated: the mesh overlaps itself around a branch point, and the other diagonal exists.
            if self.in_circle(h) != Some(Ordering::Greater) || !self.is_legal(h) {
                continue;
            }
            let (f, g) = (h / 3, self.twins[h] / 3);
            self.flip(h)?;
            flips += 1;
            // The half-edges of both faces were renamed: all four outer edges are looked at again.
            stack.extend([3 * f + 1, 3 * f + 2, 3 * g + 1, 3 * g + 2]);
        }
        Ok(flips)
    }

    /// The surface after the flips.
    ///
    /// # Errors
    /// None in practice: positions and indices come from a surface.
    pub fn into_surface(self) -> Result<Surface, DomainError> {
        Surface::triangles(self.positions, &self.faces)
    }

    /// The first invariant that does not hold, in words: twins mirror each other and run in opposite directions, edges are
    /// those of the faces, planar faces are not clockwise. For tests. Cost: O(F) and a predicate for each planar face.
    pub fn violated_invariant(&self) -> Option<String> {
        for (h, &twin) in self.twins.iter().enumerate() {
            if twin != NONE && (self.twins[twin] != h || self.corner(twin) != self.corner(next(h))) {
                return Some(format!("half-edges {h} and {twin} do not mirror each other"));
            }
            if twin != NONE && self.corner(next(twin)) != self.corner(h) {
                return Some(format!("half-edge {twin} does not end where {h} starts"));
            }
        }
        let edges: HashSet<_> = (0..self.half_edges()).map(|h| self.edge(h)).collect();
        if edges != self.edges {
            return Some("the set of edges is not that of the faces".into());
        }
        let at = self.plane.as_ref()?;
        let clockwise = |t: &[usize; 3]| geometry::orient2d(at[t[0]], at[t[1]], at[t[2]]).is_lt();
        self.faces.iter().position(clockwise).map(|f| format!("face {f} is clockwise"))
    }

    fn corner(&self, half_edge: usize) -> usize {
        self.faces[half_edge / 3][half_edge % 3]
    }
}

fn next(half_edge: usize) -> usize {
    half_edge - half_edge % 3 + (half_edge + 1) % 3
}

fn sorted(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// The plane's coordinates, exchanged if the faces run clockwise in them.
fn counter_clockwise_plane(surface: &Surface, faces: &[[usize; 3]]) -> Option<Vec<[f64; 2]>> {
    let [x, y] = surface.plane()?;
    let at = |v: usize| [surface.positions()[v][x], surface.positions()[v][y]];
    let clockwise = faces.iter().any(|&[a, b, c]| geometry::orient2d(at(a), at(b), at(c)).is_lt());
    let [x, y] = if clockwise { [y, x] } else { [x, y] };
    Some(surface.positions().iter().map(|p| [p[x], p[y]]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Domain;

    fn grid(n: usize) -> Surface {
        let at = |i: usize, j: usize| j * (n + 1) + i;
        let points: Vec<[f64; 2]> =
            (0..(n + 1) * (n + 1)).map(|k| [(k % (n + 1)) as f64, (k / (n + 1)) as f64]).collect();
        let cells = (0..n * n).map(|k| (k % n, k / n));
        let faces: Vec<[usize; 3]> = cells
            .flat_map(|(i, j)| [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]])
            .collect();
        Surface::planar(&points, &faces).unwrap()
    }

    #[test]
    fn every_legal_flip_keeps_the_invariants_and_the_second_one_undoes_it() {
        let start = Triangulation::of(&grid(4)).unwrap();
        assert_eq!(start.violated_invariant(), None);
        let mut legal = 0;
        for h in (0..start.half_edges()).filter(|&h| start.is_legal(h)) {
            let mut t = start.clone();
            let before = t.edge(h);
            t.flip(h).unwrap();
            assert_eq!(t.violated_invariant(), None);
            assert_ne!(t.edge(h / 3 * 3), before);
            t.flip(h / 3 * 3).unwrap();
            assert_eq!((t.violated_invariant(), t.edge(h / 3 * 3)), (None, before));
            legal += 1;
        }
        // Both sides of each diagonal; around horizontal and vertical edges lies a parallelogram: n(n − 1) of each.
        assert_eq!(legal, 2 * (16 + 2 * 12));
    }

    #[test]
    fn long_walks_of_flips_keep_the_invariants_and_the_area() {
        let mut t = Triangulation::of(&grid(5)).unwrap();
        let (mut state, mut made) = (1_u64, 0);
        for _ in 0..2000 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            if t.flip((state >> 33) as usize % t.half_edges()).is_ok() {
                made += 1;
                assert_eq!(t.violated_invariant(), None);
            }
        }
        assert!(made > 200);
        let facts = Domain::from(t.into_surface().unwrap()).facts();
        let s = facts.surface.unwrap();
        assert_eq!((s.manifold, s.planar, s.boundary_loops, s.boundary_edges, s.flipped_faces), (true, true, 1, 20, 0));
        // 50 triangles of half a unit square: sums of multiples of ½ are exact, only the norms are rounded.
        assert!((s.area - 25.0).abs() < 25.0 * 50.0 * f64::EPSILON);
    }

    #[test]
    fn a_reflex_quadrilateral_a_boundary_edge_and_a_doubled_edge_are_refused() {
        let reflex = [[0.0, 0.0], [1.0, 0.0], [0.2, 0.2], [0.0, 1.0]];
        let mut t = Triangulation::of(&Surface::planar(&reflex, &[[0, 1, 2], [0, 2, 3]]).unwrap()).unwrap();
        assert_eq!((0..6).filter(|&h| t.quad(h).is_some()).count(), 2);
        assert!((0..6).all(|h| matches!(t.flip(h), Err(FlipError::Illegal { .. }))));
        // Each edge of a tetrahedron is the other diagonal of its opposite edge.
        let p = vec![[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        let closed = Surface::triangles(p, &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]).unwrap();
        let t = Triangulation::of(&closed).unwrap();
        assert!((0..12).all(|h| t.quad(h).is_some() && !t.is_legal(h)));
    }

    #[test]
    fn a_straight_angle_is_no_strictly_convex_quadrilateral_but_a_flat_triangle_is_mended() {
        let p = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, -1.0], [1.0, 1.0]];
        // The edge 2–4 has a straight angle at 2.
        let t = Triangulation::of(&Surface::planar(&p, &[[0, 2, 4], [2, 1, 4]]).unwrap()).unwrap();
        assert!((0..6).all(|h| !t.is_legal(h)));
        // Vertex 2 inside the side 0–1 of a degenerate triangle.
        let t = Triangulation::of(&Surface::planar(&p[..4], &[[0, 1, 2], [1, 0, 3]]).unwrap()).unwrap();
        assert!(t.is_legal(0));
    }

    #[test]
    fn in_space_a_flip_needs_only_a_new_edge_and_proper_triangles() {
        let p = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.2, 0.2, 0.5], [0.0, 1.0, 0.0]];
        let mut t = Triangulation::of(&Surface::triangles(p, &[[0, 1, 2], [0, 2, 3]]).unwrap()).unwrap();
        let h = (0..6).find(|&h| t.quad(h).is_some()).unwrap();
        t.flip(h).unwrap();
        assert_eq!((t.violated_invariant(), t.edge(h / 3 * 3)), (None, [1, 3]));
    }

    #[test]
    fn flips_reach_delaunay_also_on_clockwise_meshes() {
        let mut t = Triangulation::of(&grid(6)).unwrap();
        for step in 0..500 {
            let h = (step * 37) % t.half_edges();
            let _refused_or_done = t.flip(h);
        }
        let shuffled = t.into_surface().unwrap();
        let turned: Vec<Vec<usize>> = shuffled.faces().iter().map(|f| f.iter().rev().copied().collect()).collect();
        for surface in [shuffled.clone(), Surface::new(shuffled.positions().to_vec(), turned).unwrap()] {
            assert_eq!(Domain::from(surface.clone()).facts().surface.unwrap().delaunay, Some(false));
            let mut t = Triangulation::of(&surface).unwrap();
            let flips = t.flip_to_delaunay().unwrap();
            assert!(flips > 0 && flips <= 49 * 48 / 2);
            assert_eq!((t.violated_invariant(), t.flip_to_delaunay()), (None, Ok(0)));
            assert_eq!(Domain::from(t.into_surface().unwrap()).facts().surface.unwrap().delaunay, Some(true));
        }
    }

    #[test]
    fn polygons_and_surfaces_in_space_are_refused_by_name() {
        let p = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.5], [0.0, 1.0, 0.0]];
        let polygon = Surface::new(p.clone(), vec![vec![0, 1, 2, 3]]).unwrap();
        assert_eq!(Triangulation::of(&polygon).unwrap_err(), FlipError::NotTriangle { face: 0, corners: 4 });
        let folded = Surface::triangles(p, &[[0, 1, 2], [0, 2, 3]]).unwrap();
        assert_eq!(Triangulation::of(&folded).unwrap().flip_to_delaunay(), Err(FlipError::NotPlanar));
    }
}
