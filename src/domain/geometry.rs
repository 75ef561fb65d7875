//! Angles, areas and exact orientation predicates.

use std::cmp::Ordering;

use robust::{Coord, Coord3D};

pub use super::cotangent::cotangent;
use crate::scalar::{Rational, Scalar};

/// A vector in space.
pub type Vec3 = nalgebra::Vector3<f64>;

/// Whether the adaptive predicates are exact on these coordinates: degree four in bits no smaller than the last bit of
/// 1e-50 (about 1e-66) stays above the smallest `f64`, and nothing overflows. Outside, the rationals decide.
fn within_range(coordinates: &[f64]) -> bool {
    coordinates.iter().all(|&x| x == 0.0 || (1e-50..1e50).contains(&x.abs()))
}

fn exact<const N: usize, const D: usize>(points: [[f64; D]; N]) -> [[Rational; D]; N] {
    // Coordinates of a domain are finite; a caller's NaN is read as zero and its sign means nothing.
    points.map(|p| p.map(|x| Rational::exactly(x).unwrap_or_else(Rational::zero)))
}

fn minus<S: Scalar, const D: usize>(a: &[S; D], b: &[S; D]) -> [S; D] {
    std::array::from_fn(|k| a[k].clone() - b[k].clone())
}

/// The dot product.
pub fn dot<S: Scalar, const D: usize>(a: &[S; D], b: &[S; D]) -> S {
    (0..D).fold(S::zero(), |sum, k| sum + a[k].clone() * b[k].clone())
}

/// The cross product in the plane.
pub fn cross2<S: Scalar>(a: &[S; 2], b: &[S; 2]) -> S {
    a[0].clone() * b[1].clone() - a[1].clone() * b[0].clone()
}

/// The cross product in space.
pub fn cross3<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    std::array::from_fn(|k| {
        let (u, v) = ((k + 1) % 3, (k + 2) % 3);
        a[u].clone() * b[v].clone() - a[v].clone() * b[u].clone()
    })
}

/// Twice the signed area `[abc]` of a triangle in the plane, over any scalar.
pub fn doubled_area<S: Scalar>(a: &[S; 2], b: &[S; 2], c: &[S; 2]) -> S {
    cross2(&minus(b, a), &minus(c, a))
}

/// The cotangent of the angle at `apex` in a triangle of the plane, `(p − apex)·(q − apex) / |[apex p q]|`, over any scalar.
/// `None` if the triangle is degenerate.
pub fn cotangent_in_plane<S: Scalar>(apex: &[S; 2], p: &[S; 2], q: &[S; 2]) -> Option<S> {
    let (u, v) = (minus(p, apex), minus(q, apex));
    let area = cross2(&u, &v).magnitude();
    (area.cmp_zero() == Ordering::Greater).then(|| dot(&u, &v) / area)
}

/// The sign of the area of the triangle `abc` in the plane: `Greater` when counter-clockwise. Exact.
pub fn orient2d(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Ordering {
    if within_range([a, b, c].as_flattened()) {
        let at = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
        return robust::orient2d(at(a), at(b), at(c)).cmp_zero();
    }
    let [a, b, c] = exact([a, b, c]);
    doubled_area(&a, &b, &c).cmp_zero()
}

/// The sign of the volume of the tetrahedron `abcd`: `Equal` when coplanar. Exact.
pub fn orient3d(a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]) -> Ordering {
    if within_range([a, b, c, d].as_flattened()) {
        let at = |p: [f64; 3]| Coord3D { x: p[0], y: p[1], z: p[2] };
        return robust::orient3d(at(a), at(b), at(c), at(d)).cmp_zero();
    }
    let [a, b, c, d] = exact([a, b, c, d]);
    let (u, v, w) = (minus(&a, &d), minus(&b, &d), minus(&c, &d));
    dot(&u, &cross3(&v, &w)).cmp_zero()
}

/// Whether `d` is inside (`Greater`), on (`Equal`) or outside (`Less`) the circle through the counter-clockwise `abc`. Exact.
pub fn incircle(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> Ordering {
    if within_range([a, b, c, d].as_flattened()) {
        let at = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
        return robust::incircle(at(a), at(b), at(c), at(d)).cmp_zero();
    }
    let [a, b, c, d] = exact([a, b, c, d]);
    incircle_determinant(&a, &b, &c, &d).cmp_zero()
}

/// The in-circle determinant over any scalar: positive iff `d` is inside the circle through the counter-clockwise `abc`.
pub fn incircle_determinant<S: Scalar>(a: &[S; 2], b: &[S; 2], c: &[S; 2], d: &[S; 2]) -> S {
    let (u, v, w) = (minus(a, d), minus(b, d), minus(c, d));
    dot(&u, &u) * cross2(&v, &w) + dot(&v, &v) * cross2(&w, &u) + dot(&w, &w) * cross2(&u, &v)
}

/// Whether three points of space lie on a line. Exact.
pub fn collinear(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> bool {
    // A projection of a proper triangle to one of the three coordinate planes is a proper triangle.
    (0..3).all(|axis| {
        let at = |p: [f64; 3]| [p[(axis + 1) % 3], p[(axis + 2) % 3]];
        orient2d(at(a), at(b), at(c)) == Ordering::Equal
    })
}

/// The largest power of two that is not above a positive number; 1 for zero. Dividing by it is exact.
fn binade(x: f64) -> f64 {
    match x.to_bits() {
        0 => 1.0,
        bits if x.is_normal() => f64::from_bits(bits & f64::INFINITY.to_bits()),
        bits => f64::from_bits(1 << bits.ilog2()),
    }
}

/// Dot and cross product of two sides of a triangle, each side divided by a power of two that brings it to magnitude one.
struct Corner {
    dot: f64,
    cross: Vec3,
    scales: [f64; 2],
}

impl Corner {
    /// Below this sine the cross product has lost half its digits to cancellation, and it is formed in rationals instead.
    const NEEDLE: f64 = 1.0 / (1_u64 << 26) as f64;

    fn at(apex: Vec3, p: Vec3, q: Vec3) -> Self {
        let (u, v) = (p - apex, q - apex);
        let scales = [binade(u.amax()), binade(v.amax())];
        let (u, v) = (u / scales[0], v / scales[1]);
        let fast = Corner { dot: u.dot(&v), cross: u.cross(&v), scales };
        if fast.cross.amax() > Self::NEEDLE { fast } else { Self::exactly(apex, p, q, scales) }
    }

    /// The same with every component rounded once, however thin the triangle is.
    fn exactly(apex: Vec3, p: Vec3, q: Vec3, scales: [f64; 2]) -> Self {
        let [apex, p, q] = exact([apex, p, q].map(Into::into));
        let [s, t] = scales.map(|s| Rational::exactly(s).unwrap_or_else(Rational::zero));
        let (u, v) = (minus(&p, &apex).map(|x| x / s.clone()), minus(&q, &apex).map(|x| x / t.clone()));
        Corner { dot: dot(&u, &v).approximate(), cross: cross3(&u, &v).map(|x| x.approximate()).into(), scales }
    }

    /// `cross = magnitude · direction` with the direction near length one: its square neither over- nor underflows.
    fn normal(&self) -> (f64, f64) {
        let magnitude = binade(self.cross.amax());
        (magnitude, (self.cross / magnitude).norm())
    }
}

/// The angle at `apex`, in radians, from `atan2` of cross and dot product: accurate for the smallest angles.
pub fn angle(apex: Vec3, p: Vec3, q: Vec3) -> f64 {
    let corner = Corner::at(apex, p, q);
    let (magnitude, direction) = corner.normal();
    (magnitude * direction).atan2(corner.dot)
}

/// Twice the area of a triangle in space, `|(p − apex) × (q − apex)|`: the error is relative, at most `8u / sin θ` with θ the
/// angle at `apex`, and 8u where sin θ is below about 2⁻²⁶. Overflows only if the area does.
pub fn doubled_area_in_space(apex: Vec3, p: Vec3, q: Vec3) -> f64 {
    let corner = Corner::at(apex, p, q);
    let (magnitude, direction) = corner.normal();
    let [s, t] = corner.scales;
    direction * magnitude * s.max(t) * s.min(t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_predicates_agree_with_the_rationals_near_degeneracy() {
        let (a, b) = ([0.5, 0.5], [12.0, 12.0]);
        for i in 0..64 {
            for j in 0..64 {
                let c = [24.0 + f64::from(i) * 4e-15, 24.0 + f64::from(j) * 4e-15];
                let [x, y, z] = exact([a, b, c]);
                assert_eq!(orient2d(a, b, c), doubled_area(&x, &y, &z).cmp_zero());
                let [x, y, z, w] = exact([a, [3.0, -1.0], c, b]);
                assert_eq!(incircle(a, [3.0, -1.0], c, b), incircle_determinant(&x, &y, &z, &w).cmp_zero());
            }
        }
    }

    #[test]
    fn tiny_and_huge_coordinates_keep_their_signs() {
        for s in [1e-150, 1e-200, 1e140] {
            assert_eq!(orient2d([0.0, 0.0], [s, 0.0], [0.0, s]), Ordering::Greater);
            assert_eq!(incircle([0.0, 0.0], [s, 0.0], [0.0, s], [s / 2.0, s / 2.0]), Ordering::Greater);
            assert!(!collinear([0.0; 3], [s, 0.0, s], [0.0, s, 0.0]));
        }
    }

    #[test]
    fn cotangents_of_the_right_isosceles_triangle_are_zero_and_one() {
        let (a, b, c) = (Vec3::zeros(), Vec3::x() * 1e-120, Vec3::y() * 1e-120);
        assert_eq!(cotangent(a, b, c), 0.0);
        assert_eq!(cotangent(b, c, a), 1.0);
    }

    #[test]
    fn a_binade_is_the_largest_power_of_two_below() {
        for (x, expected) in [(1.0, 1.0), (1.75, 1.0), (0.7, 0.5), (5e-324, 5e-324), (1.5e-323, 1e-323), (0.0, 1.0)] {
            assert_eq!(binade(x), expected);
        }
    }

    #[test]
    fn cotangents_of_needles_keep_their_digits_where_the_cross_product_cancels() {
        // Apex (0, 0), p = (1, 1), q = (2, 2 + h): cot = (4 + h)/h, and h is a few last bits.
        for bits in 1..20 {
            let h = f64::from(bits) * 2f64.powi(-51);
            let found = cotangent(Vec3::zeros(), Vec3::new(1.0, 1.0, 0.0), Vec3::new(2.0, 2.0 + h, 0.0));
            assert!((found - (4.0 + h) / h).abs() <= 4.0 * f64::EPSILON * found, "{found}");
        }
        let sliver = cotangent(Vec3::zeros(), Vec3::x(), Vec3::new(0.5, 1e-200, 0.0));
        assert!((sliver / 0.5e200 - 1.0).abs() < 1e-15);
        assert!(cotangent(Vec3::zeros(), Vec3::x(), Vec3::x() * 2.0).is_infinite());
    }

    #[test]
    fn angle_and_area_are_the_same_at_every_scale() {
        for s in [1e-150, 1e-100, 1.0, 1e100, 1e149] {
            let (a, b, c) = (Vec3::zeros(), Vec3::x() * s, (Vec3::x() + Vec3::z()) * s);
            assert!((angle(a, b, c) - std::f64::consts::FRAC_PI_4).abs() < 1e-15);
            assert!((doubled_area_in_space(a, b, c) / s / s - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn the_cotangent_stays_within_its_bound_of_the_rational_one() {
        let mut bits = 1_u64;
        let mut next = || {
            bits = bits.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (bits >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
        };
        for _ in 0..500 {
            let thin = next().abs().powi(6);
            let [a, b] = [[next(), next()], [next(), next()]];
            let c = [b[0] + thin * next(), b[1] + thin * next()];
            let [x, y, z] = exact([a, b, c]);
            let Some(reference) = cotangent_in_plane(&x, &y, &z) else { continue };
            let reference = Scalar::approximate(&reference);
            let flat = |p: [f64; 2]| Vec3::new(p[0], p[1], 0.0);
            let bound = 4.0 * f64::EPSILON * (1.0 + reference * reference);
            assert!((cotangent(flat(a), flat(b), flat(c)) - reference).abs() <= bound);
        }
    }
}
