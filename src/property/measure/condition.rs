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
    /// `1 / sin θ` at each corner.
    pub inverse_sine: [f64; 3],
    /// `cot θ` at each corner.
    pub cotangent: [f64; 3],
    /// The triangle's share of the cotangent Laplacian's diagonal at each corner: `½ (cot θ_b + cot θ_c) = ℓ_a² / 4A > 0`.
    pub pull: [f64; 3],
    /// The squared length opposite each corner.
    pub squared_length: [f64; 3],
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
        let edges = edges.map(|e| e / size);
        let squares = edges.map(|e| e.norm_squared());
        let lengths = squares.map(f64::sqrt);
        // The cross product of the two shorter edges cancels least.
        let longest = (0..3).fold(0, |best, a| if lengths[a] > lengths[best] { a } else { best });
        let normal = edges[(longest + 1) % 3].cross(&edges[(longest + 2) % 3]);
        // Scaled before it is squared: the square of a height of 1e-170 is zero.
        let found = if normal.amax() > 0.0 { (normal / normal.amax()).norm() * normal.amax() } else { 0.0 };
        if found < 1e-10 && geometry::collinear(corners[0].into(), corners[1].into(), corners[2].into()) {
            return None;
        }
        let doubled = found.max(1.0 / WORST);
        let (next, last) = ([1, 2, 0], [2, 0, 1]);
        let per_corner = |f: &dyn Fn(usize) -> f64| [f(0), f(1), f(2)];
        Some(Shape {
            inverse_sine: per_corner(&|a| (lengths[next[a]] * lengths[last[a]] / doubled).clamp(1.0, WORST)),
            cotangent: per_corner(&|a| -edges[next[a]].dot(&edges[last[a]]) / doubled),
            pull: per_corner(&|a| squares[a] / (2.0 * doubled)),
            squared_length: squares.map(|s| s * size * size),
            area: 0.5 * found * size * size,
        })
    }

    /// The shape of a face of a surface; `None` if it is no triangle, or degenerate.
    pub fn of_face(surface: &Surface, face: usize) -> Option<Self> {
        Shape::of(surface.triangle(face)?.map(|v| surface.point(v)))
    }

    /// `1 / sin θ_min`.
    pub fn condition(&self) -> f64 {
        self.inverse_sine.iter().copied().fold(1.0, f64::max)
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
    /// At each vertex the largest Q of the elements there, at least 1.
    pub vertices: Vec<f64>,
    /// At each vertex the length of the shortest edge of the elements there; infinite where there is no element.
    pub shortest: Vec<f64>,
    /// At each vertex whether an element there is degenerate.
    pub degenerate: Vec<bool>,
    /// What triangles add.
    pub triangles: Option<Triangles>,
}

/// What only triangle surfaces have.
#[derive(Clone, Debug)]
pub(crate) struct Triangles {
    /// At each edge the largest Q of the triangles beside it.
    pub edge_condition: Vec<f64>,
    /// At each edge `ρ = Σ 1/sin² θ` over the angles opposite.
    pub opposite: Vec<f64>,
    /// At each vertex `σ = Σ ½ (cot θ_b + cot θ_c)`, the diagonal of the cotangent Laplacian.
    pub pull: Vec<f64>,
    /// The triangles.
    pub faces: Vec<Element>,
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
        let (vertices, shortest, degenerate) = (vec![1.0; n], vec![f64::INFINITY; n], vec![false; n]);
        Condition { vertices, shortest, degenerate, triangles: None }
    }

    /// Adds an element with its condition, `None` for a degenerate one, and its shortest edge.
    fn add(&mut self, corners: &[usize], q: Option<f64>, shortest: f64) {
        for &v in corners {
            self.shortest[v] = self.shortest[v].min(shortest);
            match q {
                Some(q) => self.vertices[v] = self.vertices[v].max(q),
                None => self.degenerate[v] = true,
            }
        }
    }

    /// The worst condition of the whole domain.
    pub fn worst(&self) -> f64 {
        self.vertices.iter().copied().fold(1.0, f64::max)
    }
}

/// Gathered vertex by vertex over the faces around it, and edge by edge over those beside it, in face order.
fn of_surface(surface: &Surface) -> Condition {
    let topology = surface.topology();
    let faces = parallel::collect(surface.faces().len(), |face| Element::of(surface, face));
    let (n, edges) = (surface.positions().len(), topology.edges().len());
    let at_vertex = |v: usize| topology.star(v).iter().map(|c| (&faces[c.face()], c.corner()));
    // Condition, shortest side, whether one is degenerate, pull: each star is walked once.
    let around = |v: usize| {
        let (mut worst, mut shortest, mut degenerate, mut pull) = (1.0, f64::INFINITY, false, 0.0);
        for (face, corner) in at_vertex(v) {
            shortest = f64::min(shortest, face.shortest);
            match face.condition {
                Some(q) => worst = f64::max(worst, q),
                None => degenerate = true,
            }
            if let Some(shape) = &face.shape {
                pull += shape.pull[corner];
            }
        }
        (worst, shortest, degenerate, pull)
    };
    let beside = |e: usize| {
        let (mut worst, mut squares) = (1.0, 0.0);
        for side in topology.sides(e) {
            let face = &faces[side.face()];
            if let (Some(shape), Some(q)) = (&face.shape, face.condition) {
                worst = f64::max(worst, q);
                squares += shape.inverse_sine[(side.corner() + 2) % 3].powi(2);
            }
        }
        (worst, squares)
    };
    let mut condition = Condition::perfect(n);
    let mut pull = vec![0.0; n];
    for (v, found) in parallel::collect(n, around).into_iter().enumerate() {
        (condition.vertices[v], condition.shortest[v], condition.degenerate[v], pull[v]) = found;
    }
    if surface.is_triangulated() {
        let (edge_condition, opposite) = parallel::collect(edges, beside).into_iter().unzip();
        condition.triangles = Some(Triangles { edge_condition, opposite, pull, faces });
    }
    condition
}

/// What the vertices and edges of a face gather from it; of a polygon with more corners there is no shape.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    /// Its shape, if it is a proper triangle.
    pub shape: Option<Shape>,
    /// Its condition; `None` if it is degenerate.
    pub condition: Option<f64>,
    shortest: f64,
}

impl Element {
    fn of(surface: &Surface, face: usize) -> Self {
        let corners = &surface.faces()[face];
        let at = |k: usize| surface.positions()[corners[if k == corners.len() { 0 } else { k }]];
        let shortest = (0..corners.len()).map(|k| distance(at(k), at(k + 1))).fold(f64::INFINITY, f64::min);
        let shape = Shape::of_face(surface, face);
        let condition = shape.as_ref().map(Shape::condition).or_else(|| of_polygon(surface, face));
        Element { shape, condition, shortest }
    }
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
        condition.add(tet, proper.then_some(q), shortest);
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
            for (found, expected) in s.inverse_sine.iter().zip([1.0, root, root]) {
                assert!((found - expected).abs() < 1e-15);
            }
            assert_eq!((s.cotangent, s.pull), ([0.0, 1.0, 1.0], [1.0, 0.5, 0.5]));
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
        assert!((equilateral.vertices[0] - 2.0 / 3f64.sqrt()).abs() < 1e-15);
        assert!((equilateral.shortest[2] - 1.0).abs() < 1e-15 && !equilateral.degenerate[0]);
        let flat = of(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]);
        assert_eq!((flat.vertices[1], flat.shortest[1], flat.degenerate[1]), (1.0, 1.0, true));
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
