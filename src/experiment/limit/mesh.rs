//! One mesh of a sequence, with what is asked of it again and again: where its vertices are and how linear functions look on its
//! triangles or tetrahedra.

use super::place::Place;
use crate::domain::Domain;
use crate::domain::geometry::{cross3, dot};

/// One mesh of a sequence.
pub struct Mesh {
    /// What it refines.
    pub place: Place,
    /// The mesh.
    pub domain: Domain,
    /// `√(2 area/triangles)`, the leg of a right isosceles triangle of the mean area; in space `∛(6 volume/tetrahedra)`.
    pub h: f64,
    /// Where the vertices are: on the torus in the plane.
    pub points: Vec<[f64; 3]>,
    /// The triangles, in space the tetrahedra.
    pub elements: Vec<Element>,
}

/// A triangle or a tetrahedron.
pub struct Element {
    /// The vertices and where they are: on the torus near to each other in the plane.
    pub corners: Vec<(usize, [f64; 3])>,
    /// `∇λ` of the corners but the first, λ the linear function that is one there and zero at the others; in the plane of a triangle.
    pub gradients: Vec<[f64; 3]>,
    /// Area or volume.
    pub measure: f64,
}

impl Mesh {
    /// The mesh, `None` if it is made of neither triangles nor tetrahedra.
    pub fn new(place: Place, domain: Domain) -> Option<Self> {
        let n = domain.vertex_count();
        let points: Vec<[f64; 3]> = match place {
            Place::Torus => {
                let side = (n as f64).sqrt().round() as usize;
                let at = |k: usize| k as f64 / side as f64;
                (0..n).map(|v| [at(v % side), at(v / side), 0.0]).collect()
            }
            _ => domain.positions()?.to_vec(),
        };
        let lists: Vec<Vec<usize>> = match &domain {
            Domain::Surface(surface) => {
                let triangle = |f: usize| Some(surface.triangle(f)?.to_vec());
                (0..surface.faces().len()).map(triangle).collect::<Option<_>>()?
            }
            Domain::Volume(volume) => volume.tetrahedra().iter().map(|t| t.to_vec()).collect(),
            _ => return None,
        };
        let corners = |vertices: Vec<usize>| {
            let origin = points[vertices[0]];
            let near = |p: [f64; 3]| match place {
                Place::Torus => [0, 1, 2].map(|k| p[k] - (p[k] - origin[k]).round()),
                _ => p,
            };
            vertices.into_iter().map(|v| (v, near(points[v]))).collect()
        };
        let elements: Vec<Element> = lists.into_iter().map(|list| Element::new(corners(list))).collect();
        let mean = elements.iter().map(|e| e.measure).sum::<f64>() / elements.len() as f64;
        let h = if matches!(domain, Domain::Volume(_)) { (6.0 * mean).cbrt() } else { (2.0 * mean).sqrt() };
        Some(Mesh { place, domain, h, points, elements })
    }

    /// A function of the place at the vertices.
    pub fn values(&self, f: impl Fn([f64; 3]) -> f64) -> Vec<f64> {
        self.points.iter().map(|p| f(*p)).collect()
    }
}

impl Element {
    fn new(corners: Vec<(usize, [f64; 3])>) -> Self {
        let edge = |k: usize| [0, 1, 2].map(|c| corners[k].1[c] - corners[0].1[c]);
        let (e, f) = (edge(1), edge(2));
        // A triangle is a prism of height one: the third edge is the unit normal.
        let (g, share) = match corners.len() {
            4 => (edge(3), 6.0),
            _ => {
                let normal = cross3(&e, &f);
                let length = dot(&normal, &normal).sqrt();
                (normal.map(|x| x / length), 2.0)
            }
        };
        let faces = [cross3(&f, &g), cross3(&g, &e), cross3(&e, &f)];
        let determinant = dot(&e, &faces[0]);
        let gradients = faces[..corners.len() - 1].iter().map(|n| n.map(|x| x / determinant)).collect();
        Element { corners, gradients, measure: determinant.abs() / share }
    }

    /// The gradient of the linear function with these values at the corners.
    pub fn gradient(&self, values: &[f64]) -> [f64; 3] {
        [0, 1, 2].map(|c| self.gradients.iter().zip(&values[1..]).map(|(g, v)| (v - values[0]) * g[c]).sum())
    }

    /// What lies in the element of a vector at one of its points: on a triangle the part in its plane.
    pub fn along(&self, vector: [f64; 3]) -> [f64; 3] {
        let edge = |k: usize| [0, 1, 2].map(|c| self.corners[k].1[c] - self.corners[0].1[c]);
        let values: Vec<f64> = (0..self.corners.len()).map(|k| dot(&edge(k), &vector)).collect();
        self.gradient(&values)
    }

    /// Points of equal weight by their shares of the corners, exact for polynomials of degree two: the middles of the edges of a triangle;
    /// in a tetrahedron four points on the lines from the middle to the corners \[strang-fix1973\].
    pub fn nodes(&self) -> Vec<Vec<f64>> {
        let count = self.corners.len();
        let [one, rest] = match count {
            4 => [(5.0 + 3.0 * 5.0_f64.sqrt()) / 20.0, (5.0 - 5.0_f64.sqrt()) / 20.0],
            _ => [0.0, 0.5],
        };
        (0..count).map(|k| (0..count).map(|c| if c == k { one } else { rest }).collect()).collect()
    }

    /// The point with these shares of the corners.
    pub fn point(&self, shares: &[f64]) -> [f64; 3] {
        [0, 1, 2].map(|c| self.corners.iter().zip(shares).map(|((_, p), share)| share * p[c]).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::super::sequence::{Sequence, Way};
    use super::*;

    #[test]
    fn the_nodes_integrate_quadratic_polynomials_exactly() {
        // Over the unit cube: x² → ⅓, xy → ¼, x²y is of degree three; over the square likewise.
        for (place, n) in [(Place::Square, 4), (Place::Cube, 2)] {
            let mesh = Sequence { place, way: Way::Structured }.mesh(n, 0).unwrap();
            let integral = |f: &dyn Fn([f64; 3]) -> f64| -> f64 {
                let of = |e: &Element| {
                    let nodes = e.nodes();
                    nodes.iter().map(|s| f(e.point(s))).sum::<f64>() * e.measure / nodes.len() as f64
                };
                mesh.elements.iter().map(of).sum()
            };
            assert!((integral(&|_| 1.0) - 1.0).abs() < 1e-14);
            assert!((integral(&|[x, ..]| x * x) - 1.0 / 3.0).abs() < 1e-14);
            assert!((integral(&|[x, y, _]| x * y) - 0.25).abs() < 1e-14);
            assert!((mesh.h - 1.0 / n as f64).abs() < 1e-14);
        }
    }

    #[test]
    fn linear_functions_have_their_gradient_and_vectors_their_part_in_the_plane() {
        for place in [Place::Disc, Place::Sphere, Place::Cube] {
            let mesh = Sequence { place, way: Way::Structured }.mesh(8, 0).unwrap();
            let a = [0.3, -1.2, 0.7];
            for element in &mesh.elements {
                let values: Vec<f64> = element.corners.iter().map(|(_, p)| dot(&a, p)).collect();
                let (found, along) = (element.gradient(&values), element.along(a));
                assert!((0..3).all(|k| (found[k] - along[k]).abs() < 1e-12));
                if place == Place::Cube {
                    assert!((0..3).all(|k| (found[k] - a[k]).abs() < 1e-12));
                }
            }
        }
    }
}
