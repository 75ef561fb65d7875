//! How badly conditioned the geometry at a vertex or an edge is, as far as the rounding of weights goes.
//!
//! # Definition
//! For a triangle with angles θ, edge lengths ℓ (opposite) and area A:
//! `Q = 1 / sin θ_min = (product of the two longest edges) / 2A`. A polygon with more corners has `Q = perimeter² / 8A`: a
//! straight angle does it no harm, a thin shape does. A tetrahedron has
//! `Q = (ℓ³ / 6V) (ℓ² / 2A_min)` with its longest edge and smallest face. Every Q is at least 1 and cut off at 1e18.
//! Elements of exactly zero area or volume have no condition; the vertices of such are marked.

use crate::domain::geometry::{self, Vec3};
use crate::domain::{Domain, Surface, Volume};
use crate::linalg::parallel;

/// Beyond this an element is as good as degenerate in `f64`.
const WORST: f64 = 1e18;

/// What rounding sees of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    /// `cot θ` at each corner.
    pub cotangent: [f64; 3],
    /// The triangle's share of the cotangent Laplacian's diagonal at each corner: `½ (cot θ_b + cot θ_c) = ℓ_a² / 4A > 0`.
    pub pull: [f64; 3],
    /// The area.
    pub area: f64,
}

impl Shape {
    /// The shape of a triangle; `None` if its corners lie exactly on a line.
    pub fn of(corners: [Vec3; 3]) -> Option<Self> {
        let edge = |a: usize| corners[(a + 2) % 3] - corners[(a + 1) % 3];
        let edges = [edge(0), edge(1), edge(2)];
        let size = edges.iter().map(|e| e.amax()).fold(0.0, f64::max);
        if size == 0.0 {
            return None;
        }
        // Where fourth powers would leave the range the triangle is brought to size one.
        let unit = if (1e-70..1e70).contains(&size) { 1.0 } else { size };
        let edges = if unit == 1.0 { edges } else { edges.map(|e| e / unit) };
        let size = size / unit;
        let squares = edges.map(|e| e.norm_squared());
        // The cross product of the two shorter edges cancels least.
        let longest = (0..3).fold(0, |best, a| if squares[a] > squares[best] { a } else { best });
        let normal = edges[(longest + 1) % 3].cross(&edges[(longest + 2) % 3]);
        let found = match normal.norm_squared() {
            square if square > 1e-290 => square.sqrt(),
            // Scaled before it is squared: the square of a height of 1e-170 is zero.
            _ if normal.amax() > 0.0 => (normal / normal.amax()).norm() * normal.amax(),
            _ => 0.0,
        };
        let square = size * size;
        if found < 1e-10 * square && geometry::collinear(corners[0].into(), corners[1].into(), corners[2].into()) {
            return None;
        }
        let inverse = 1.0 / found.max(square / WORST);
        let cotangent = |a: usize| -edges[(a + 1) % 3].dot(&edges[(a + 2) % 3]) * inverse;
        Some(Shape {
            cotangent: [cotangent(0), cotangent(1), cotangent(2)],
            pull: squares.map(|s| 0.5 * s * inverse),
            area: 0.5 * found * unit * unit,
        })
    }

    /// `1 / sin² θ` at a corner.
    #[inline]
    pub fn squared_cosecant(&self, corner: usize) -> f64 {
        1.0 + self.cotangent[corner] * self.cotangent[corner]
    }

    /// The squared length opposite a corner.
    #[inline]
    pub fn squared_length(&self, corner: usize) -> f64 {
        4.0 * self.area * self.pull[corner]
    }

    /// The shape of a face of a surface; `None` if it is no triangle, or degenerate.
    pub fn of_face(surface: &Surface, face: usize) -> Option<Self> {
        Shape::of(surface.triangle(face)?.map(|v| surface.point(v)))
    }

    /// `1 / sin θ_min`.
    pub fn condition(&self) -> f64 {
        let largest = self.cotangent.iter().fold(0.0_f64, |largest, cot| largest.max(cot.abs()));
        (1.0 + largest * largest).sqrt().min(WORST)
    }
}

/// The distance of two points.
pub(crate) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let squared = x * x + y * y + z * z;
    // Where the square keeps its digits its root is as good as the slower `hypot`.
    if (1e-280..1e300).contains(&squared) { squared.sqrt() } else { x.hypot(y).hypot(z) }
}

/// The conditions of a domain, gathered at vertices and edges.
#[derive(Clone, Debug)]
pub(crate) struct Condition {
    /// What the elements at each vertex come to.
    pub stars: Vec<Star>,
    /// What triangles add.
    pub triangles: Option<Triangles>,
}

/// What the elements at a vertex come to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Star {
    /// The largest Q, at least 1.
    pub condition: f64,
    /// The length of the shortest edge; infinite where there is no element.
    pub shortest: f64,
    /// `σ = Σ ½ (cot θ_b + cot θ_c)` over the triangles, the diagonal of the cotangent Laplacian.
    pub pull: f64,
    /// Whether an element is degenerate.
    pub degenerate: bool,
}

impl Default for Star {
    fn default() -> Self {
        Star { condition: 1.0, shortest: f64::INFINITY, pull: 0.0, degenerate: false }
    }
}

impl Star {
    /// Adds an element with its condition, `None` for a degenerate one, and its shortest edge.
    fn add(&mut self, condition: Option<f64>, shortest: f64) {
        self.shortest = self.shortest.min(shortest);
        match condition {
            Some(q) => self.condition = self.condition.max(q),
            None => self.degenerate = true,
        }
    }
}

/// What only triangle surfaces have.
#[derive(Clone, Debug)]
pub(crate) struct Triangles {
    /// What the triangles beside each edge come to.
    pub flanks: Vec<Flanks>,
    /// The triangles.
    pub faces: Vec<Element>,
}

/// What the triangles beside an edge come to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flanks {
    /// The largest Q, at least 1.
    pub condition: f64,
    /// `ρ = Σ 1/sin² θ` over the angles opposite.
    pub opposite: f64,
}

impl Condition {
    /// Of a domain. Graphs and point clouds have Q = 1: their weights are not computed from angles.
    pub fn of(domain: &Domain) -> Self {
        match domain {
            Domain::Surface(s) => of_surface(s),
            Domain::Volume(v) => of_volume(v),
            _ => Condition::perfect(domain.vertex_count()),
        }
    }

    /// Of a domain without elements.
    fn perfect(n: usize) -> Self {
        Condition { stars: vec![Star::default(); n], triangles: None }
    }

    /// The worst condition of the whole domain.
    pub fn worst(&self) -> f64 {
        self.stars.iter().map(|star| star.condition).fold(1.0, f64::max)
    }
}

/// Gathered vertex by vertex over the faces around it, and edge by edge over those beside it, in face order.
fn of_surface(surface: &Surface) -> Condition {
    let topology = surface.topology();
    let faces = parallel::collect(surface.faces().len(), |face| Element::of(surface, face));
    let around = |v: usize| {
        let mut star = Star::default();
        for corner in topology.star(v) {
            let face = &faces[corner.face()];
            star.add(face.condition(), face.shortest);
            if let Some(shape) = face.shape() {
                star.pull += shape.pull[corner.corner()];
            }
        }
        star
    };
    let beside = |e: usize| {
        let mut flanks = Flanks { condition: 1.0, opposite: 0.0 };
        for side in topology.sides(e) {
            let face = &faces[side.face()];
            if let (Some(shape), Some(q)) = (face.shape(), face.condition()) {
                flanks.condition = flanks.condition.max(q);
                flanks.opposite += shape.squared_cosecant((side.corner() + 2) % 3);
            }
        }
        flanks
    };
    let stars = parallel::collect(surface.positions().len(), around);
    if !surface.is_triangulated() {
        return Condition { stars, triangles: None };
    }
    let flanks = parallel::collect(topology.edges().len(), beside);
    Condition { stars, triangles: Some(Triangles { flanks, faces }) }
}

/// What the vertices and edges of a face gather from it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Element {
    /// NaN where it is no proper triangle.
    shape: Shape,
    /// NaN where it is degenerate.
    condition: f64,
    shortest: f64,
}

impl Element {
    fn of(surface: &Surface, face: usize) -> Self {
        let corners = &surface.faces()[face];
        let at = |k: usize| surface.positions()[corners[if k == corners.len() { 0 } else { k }]];
        let shortest = shortest((0..corners.len()).map(|k| [at(k), at(k + 1)]));
        match Shape::of_face(surface, face) {
            Some(shape) => Element { shape, condition: shape.condition(), shortest },
            None => {
                let shape = Shape { cotangent: [f64::NAN; 3], pull: [f64::NAN; 3], area: f64::NAN };
                Element { shape, condition: of_polygon(surface, face).unwrap_or(f64::NAN), shortest }
            }
        }
    }

    /// Its shape, if it is a proper triangle.
    #[inline]
    pub fn shape(&self) -> Option<&Shape> {
        (!self.shape.area.is_nan()).then_some(&self.shape)
    }

    /// Its condition; `None` if it is degenerate.
    #[inline]
    pub fn condition(&self) -> Option<f64> {
        (!self.condition.is_nan()).then_some(self.condition)
    }
}

/// The shortest of some distances.
fn shortest(sides: impl Iterator<Item = [[f64; 3]; 2]> + Clone) -> f64 {
    let squared = |[a, b]: [[f64; 3]; 2]| (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>();
    let least = sides.clone().map(squared).fold(f64::INFINITY, f64::min);
    // Where squares keep their digits their order is that of the lengths.
    if least > 1e-280 { least.sqrt() } else { sides.map(|[a, b]| distance(a, b)).fold(f64::INFINITY, f64::min) }
}

/// The condition of a face with more than three corners; `None` for a triangle or a polygon without area.
fn of_polygon(surface: &Surface, face: usize) -> Option<f64> {
    let corners = &surface.faces()[face];
    if corners.len() == 3 {
        return None;
    }
    let side = |k: usize| (surface.point(corners[(k + 1) % corners.len()]) - surface.point(corners[k])).norm();
    let perimeter: f64 = (0..corners.len()).map(side).sum();
    let q = (perimeter / 8.0) * (perimeter / surface.face_area(face));
    (perimeter > 0.0 && q.is_finite()).then(|| q.clamp(1.0, WORST))
}

fn of_volume(volume: &Volume) -> Condition {
    let mut condition = Condition::perfect(volume.positions().len());
    for tet in volume.tetrahedra() {
        let p = tet.map(|v| Vec3::from(volume.positions()[v]));
        let lengths = || (0..4).flat_map(|a| (0..a).map(move |b| (p[a] - p[b]).norm()));
        let (size, shortest) = (lengths().fold(0.0, f64::max), lengths().fold(f64::INFINITY, f64::min));
        let p = p.map(|x| (x - p[0]) / size);
        let doubled_face = |skip: usize| {
            let f = [(skip + 1) % 4, (skip + 2) % 4, (skip + 3) % 4];
            (p[f[1]] - p[f[0]]).cross(&(p[f[2]] - p[f[0]])).norm()
        };
        let smallest = (0..4).map(doubled_face).fold(f64::INFINITY, f64::min);
        let determinant = p[1].dot(&p[2].cross(&p[3])).abs();
        let q = (1.0 / (determinant * smallest)).clamp(1.0, WORST);
        let [a, b, c, d] = tet.map(|v| volume.positions()[v]);
        let proper = q.is_finite() && geometry::orient3d(a, b, c, d).is_ne();
        tet.iter().for_each(|&v| condition.stars[v].add(proper.then_some(q), shortest));
    }
    condition
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shape_of_the_right_isosceles_triangle_is_known_at_every_size() {
        for size in [1.0, 1e-140, 1e140] {
            let s = Shape::of([Vec3::zeros(), Vec3::x() * size, Vec3::y() * size]).unwrap();
            let root = 2f64.sqrt();
            assert_eq!([0, 1, 2].map(|c| s.squared_cosecant(c)), [1.0, 2.0, 2.0]);
            assert!((s.condition() - root).abs() < 1e-15);
            assert_eq!((s.cotangent, s.pull), ([0.0, 1.0, 1.0], [1.0, 0.5, 0.5]));
            assert!((s.squared_length(0) / (2.0 * size * size) - 1.0).abs() < 1e-15);
            assert!((s.area / (0.5 * size * size) - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn exactly_collinear_corners_have_no_shape_and_nearly_collinear_ones_have() {
        let flat = |h: f64| Shape::of([Vec3::zeros(), Vec3::x(), Vec3::new(0.5, h, 0.0)]);
        assert!(flat(0.0).is_none());
        let cap = flat(1e-12).unwrap();
        // Angles atan(2h) twice: 1/sin = 1/2h.
        assert!((cap.condition() * 2e-12 - 1.0).abs() < 1e-3);
        assert!(flat(1e-30).is_some());
    }

    #[test]
    fn the_condition_of_an_equilateral_triangle_is_two_over_the_root_of_three_and_a_flat_one_has_none() {
        let of = |p: &[[f64; 2]; 3]| Condition::of(&Surface::planar(p, &[[0, 1, 2]]).unwrap().into());
        let equilateral = of(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.75_f64.sqrt()]]);
        assert!((equilateral.stars[0].condition - 2.0 / 3f64.sqrt()).abs() < 1e-15);
        assert!((equilateral.stars[2].shortest - 1.0).abs() < 1e-15 && !equilateral.stars[0].degenerate);
        let flat = of(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]);
        let flat = flat.stars[1];
        assert_eq!((flat.condition, flat.shortest, flat.degenerate), (1.0, 1.0, true));
    }

    #[test]
    fn the_rounding_of_cotangents_on_needles_stays_below_the_bound() {
        // cot at the three corners of (0, 0), (1, 0.1), (0.3, h): the exact values are quotients of rationals.
        use crate::domain::geometry::{cotangent, cotangent_in_plane};
        use crate::property::tolerance::UNIT_ROUNDOFF;
        use crate::scalar::{Rational, Scalar};
        for k in 0..40 {
            let h = 10f64.powi(-(k % 9)) * (1.0 + 0.013 * f64::from(k));
            let p = [[0.0, 0.0], [1.0, 0.1], [0.3, h]];
            let surface = Surface::planar(&p, &[[0, 1, 2]]).unwrap();
            let Some(shape) = Shape::of_face(&surface, 0) else { continue };
            let exact = p.map(|p| p.map(|x| Rational::exactly(x).unwrap()));
            let cots: Vec<f64> = (0..3)
                .map(|c| cotangent(surface.point(c), surface.point((c + 1) % 3), surface.point((c + 2) % 3)))
                .collect();
            let scale = cots.iter().map(|c| c.abs()).fold(0.0, f64::max);
            for c in 0..3 {
                let truth = cotangent_in_plane(&exact[c], &exact[(c + 1) % 3], &exact[(c + 2) % 3]).unwrap();
                let error = (Rational::exactly(cots[c]).unwrap() - truth).approximate().abs();
                assert!(error <= 8.0 * UNIT_ROUNDOFF * shape.condition() * scale.max(1.0), "h = {h:e}: {error:e}");
            }
        }
    }

    #[test]
    fn distances_agree_with_hypot_at_every_size() {
        for size in [1.0, 1e-160, 1e150, 3e-143] {
            let found = distance([2.0 * size, 0.0, 6.0 * size], [0.0, 3.0 * size, 0.0]);
            assert!((found / (7.0 * size) - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn the_pull_of_a_corner_is_the_mean_of_the_other_two_cotangents() {
        let s = Shape::of([Vec3::zeros(), Vec3::new(3.0, 1.0, 2.0), Vec3::new(-1.0, 0.5, 4.0)]).unwrap();
        for a in 0..3 {
            let mean = 0.5 * (s.cotangent[(a + 1) % 3] + s.cotangent[(a + 2) % 3]);
            assert!((s.pull[a] - mean).abs() < 1e-14);
        }
    }
}
