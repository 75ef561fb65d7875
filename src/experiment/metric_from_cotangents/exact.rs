//! What makes the recovery of a metric work, in rational arithmetic: the gradient of the area, its concavity, its scales.

use std::cmp::Ordering;

use super::energy::Sides;
use crate::domain::{Surface, geometry};
use crate::experiment::calculus::{Polynomial, ratio, whole};
use crate::experiment::poll::Case;
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::scalar::{Rational, Scalar};

/// `Q = 2(ab + bc + ca) − a² − b² − c² = 4 A²`, three variables.
pub fn heron() -> Polynomial {
    let squares = [[2, 0, 0], [0, 2, 0], [0, 0, 2]].map(|e| (e, whole(-1)));
    let products = [[1, 1, 0], [0, 1, 1], [1, 0, 1]].map(|e| (e, whole(2)));
    squares.into_iter().chain(products).fold(Polynomial::zero(3), |q, (e, c)| q.plus(e.to_vec(), c))
}

/// The triangle with corners x, y, z in space, its coordinates nine variables: `(y − x)·…`, all as polynomials.
struct Drawn {
    /// `½|side|²` opposite each corner.
    u: Vec<Polynomial>,
    /// The dot product of the two sides at each corner.
    dots: Vec<Polynomial>,
    /// `|(y − x) × (z − x)|²`, four times the squared area.
    cross: Polynomial,
}

impl Drawn {
    fn new() -> Self {
        let at = |corner: usize, axis: usize| Polynomial::variable(9, 3 * corner + axis);
        let side = |from: usize, to: usize| [0, 1, 2].map(|axis| &at(to % 3, axis) - &at(from % 3, axis));
        let dot = |a: &[Polynomial; 3], b: &[Polynomial; 3]| {
            (0..3).fold(Polynomial::zero(9), |sum, k| &sum + &(&a[k] * &b[k]))
        };
        let u = |k: usize| dot(&side(k + 1, k + 2), &side(k + 1, k + 2)).times(&Rational::half());
        let (p, q) = (side(0, 1), side(0, 2));
        let cross = [0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            &(&p[i] * &q[j]) - &(&p[j] * &q[i])
        });
        Drawn {
            u: (0..3).map(u).collect(),
            dots: (0..3).map(|k| dot(&side(k, k + 1), &side(k, k + 2))).collect(),
            cross: dot(&cross, &cross),
        }
    }
}

/// For every triangle in space at once, as identities between polynomials in its nine coordinates: `q(u) = 4A²`, and at each
/// corner `½ cot = ∂A/∂u`. With `A = ½ √q` the derivative is `∂q/∂u / (4 √q)`, and `½ cot = dot/(2 · 2A)`, `2A = √q`: the
/// two agree where `∂q/∂u = 2 dot`. One violation for each identity that fails.
pub fn gradient_identities(q: &Polynomial) -> Vec<Option<Case>> {
    let drawn = Drawn::new();
    let mut asked = vec![(q.composed(&drawn.u), drawn.cross, "16 A² is not Heron's polynomial".to_string())];
    for (k, dot) in drawn.dots.iter().enumerate() {
        let derivative = q.derivative(k).composed(&drawn.u);
        asked.push((derivative, dot.times(&whole(2)), format!("∂A/∂u is not ½ cot at corner {k}")));
    }
    asked.into_iter().map(|(found, expected, text)| (found != expected).then(|| Case::told(text))).collect()
}

/// `4 Q^(3/2)` times the second derivative of the area: `2Q q″ − q′q′ᵀ`, a rational matrix.
fn curvature(q: &Polynomial, u: &[Rational]) -> Dense<Rational> {
    let (value, first) = (q.at(u), q.gradient());
    let slope: Vec<Rational> = first.iter().map(|p| p.at(u)).collect();
    Dense::from_fn(3, 3, |i, j| {
        let second = first[i].derivative(j).at(u);
        (whole(2) * value.clone() * second - slope[i].clone() * slope[j].clone()).reduced()
    })
}

/// The area is concave at u and flat along u only: the second derivative has two negative eigenvalues and the kernel u.
pub fn not_concave(q: &Polynomial, u: &[Rational]) -> Option<Case> {
    let eliminated = curvature(q, u).eliminate();
    let (inertia, kernel) = (eliminated.inertia(), eliminated.kernel());
    let along = |x: &[Rational]| (0..3).all(|k| x[k].clone() * u[0].clone() == u[k].clone() * x[0].clone());
    let right = inertia.negative == 2 && inertia.zero == 1 && kernel.iter().all(|x| along(x));
    (!right).then(|| Case::told(format!("u = {}, {}, {}: {inertia:?}", u[0], u[1], u[2])))
}

/// A random triangle in the cone, by its u: corners at whole points in space.
pub fn random_sides(stream: &mut Stream) -> [Rational; 3] {
    loop {
        let point = |stream: &mut Stream| [0; 3].map(|_| stream.below(13) as f64 - 6.0);
        let corners = [point(stream), point(stream), point(stream)];
        if !geometry::collinear(corners[0], corners[1], corners[2]) {
            return [0, 1, 2].map(|k| half_square(corners[(k + 1) % 3], corners[(k + 2) % 3]));
        }
    }
}

/// `½ |a − b|²` of points with whole coordinates.
fn half_square(a: [f64; 3], b: [f64; 3]) -> Rational {
    let square: f64 = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum();
    ratio(square as i64, 2)
}

/// The directions in which no triangle's area bends, for a surface with whole coordinates. Since every triangle's second
/// derivative is negative semi-definite, they are the kernel of any sum of these with positive factors.
pub fn flat_directions(surface: &Surface, sides: &Sides) -> Vec<Vec<Rational>> {
    let (q, edges) = (heron(), surface.topology().edges());
    let u = |e: usize| half_square(surface.positions()[edges[e][0]], surface.positions()[edges[e][1]]);
    let mut sum = Dense::from_fn(edges.len(), edges.len(), |_, _| Rational::ZERO);
    for triangle in &sides.triangles {
        let bent = curvature(&q, &triangle.map(u));
        for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
            sum.add_to(triangle[i], triangle[j], bent.at(i, j).clone());
        }
    }
    sum.eliminate().kernel()
}

/// The flat directions are one for each part, a multiple of u there and 0 elsewhere in any basis that has as many.
pub fn scales_are_not_parts(surface: &Surface, expected: usize, name: &str) -> Option<Case> {
    let sides = Sides::of(surface)?;
    let (flat, edges) = (flat_directions(surface, &sides), surface.topology().edges());
    let u = |e: usize| half_square(surface.positions()[edges[e][0]], surface.positions()[edges[e][1]]);
    let bent = flat.iter().any(|x| {
        sides.triangles.iter().any(|t| {
            [1, 2].iter().any(|&k| {
                let (a, b) = (x[t[0]].clone() * u(t[k]), x[t[k]].clone() * u(t[0]));
                (a - b).cmp_zero() != Ordering::Equal
            })
        })
    });
    let text = || Case::told(format!("{name}: {} free scales for {expected} parts", flat.len()));
    (bent || flat.len() != expected || sides.part_count() != expected).then(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn herons_polynomial_passes_and_a_wrong_coefficient_or_sign_does_not() {
        assert!(gradient_identities(&heron()).iter().all(Option::is_none));
        let wrong = heron().plus(vec![1, 1, 0], whole(1));
        assert!(gradient_identities(&wrong).iter().filter(|v| v.is_some()).count() >= 3);
        assert!(gradient_identities(&heron().times(&whole(-1))).iter().all(Option::is_some));
    }

    #[test]
    fn a_quadratic_form_of_another_signature_is_not_concave() {
        let u = [whole(2), whole(3), whole(2)];
        assert!(not_concave(&heron(), &u).is_none());
        let square =
            [[2, 0, 0], [0, 2, 0], [0, 0, 2]].iter().fold(Polynomial::zero(3), |q, e| q.plus(e.to_vec(), whole(1)));
        assert!(not_concave(&square, &u).is_some());
    }

    #[test]
    fn two_triangles_that_share_a_vertex_alone_have_two_scales() {
        let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -2.0]];
        let pinched = Surface::planar(&points, &[[0, 1, 2], [0, 3, 4]]).unwrap();
        assert!(scales_are_not_parts(&pinched, 2, "").is_none() && scales_are_not_parts(&pinched, 1, "").is_some());
        let joined = Surface::planar(&points, &[[0, 1, 2], [0, 2, 3]]).unwrap();
        assert!(scales_are_not_parts(&joined, 1, "").is_none());
    }
}
