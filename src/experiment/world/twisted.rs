//! Twisted nested triangles with rational corners: every twist is exact.
//!
//! A rotation about the centroid of a triangle is, in an affine image of the equilateral one, a matrix of rational numbers as
//! soon as `cos θ` and `√3 sin θ` are rational: with `m = √3 tan(θ/2)` they are `(3 − m²)/(3 + m²)` and `6m/(3 + m²)`.
//! Equilibria, lifts and motions exist or not alike on affine images, so that the outer triangle may have whole corners.

use dashu_int::IBig;

use crate::domain::Surface;
use crate::scalar::{Rational, Scalar};

/// A twist by the rational `m = √3 tan(θ/2)`, θ the angle.
pub type Twist = Rational;

/// The angle of a twist, in degrees.
pub fn degrees(m: &Twist) -> f64 {
    (2.0 * (m.approximate() / 3_f64.sqrt()).atan()).to_degrees()
}

/// A rational number.
pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::from(IBig::from(numerator)) / Rational::from(IBig::from(denominator))
}

/// The corners of `nested + 1` triangles, each turned by the twist and scaled by `size` against the one around it.
fn corners(m: &Twist, size: &Rational, nested: usize) -> Vec<[Rational; 2]> {
    let three = ratio(3, 1);
    let square = m.clone() * m.clone();
    let cosine = (three.clone() - square.clone()) / (three.clone() + square.clone());
    let sine = ratio(6, 1) * m.clone() / (three + square);
    // Seen from the centroid, turning takes o_k to a o_k + b o_{k+1} + c o_{k+2}, the shares adding up to 1.
    let third = |x: Rational| x / ratio(3, 1);
    let shares = [
        third(Rational::ONE + ratio(2, 1) * cosine.clone()),
        third(Rational::ONE - cosine.clone() + sine.clone()),
        third(Rational::ONE - cosine - sine),
    ];
    // The centroid is the origin.
    let mut ring: Vec<[Rational; 2]> = [[0, -1], [1, 0], [-1, 1]].map(|p| p.map(|x| ratio(3 * x, 1))).to_vec();
    let mut all = ring.clone();
    for _ in 0..nested {
        let corner = |k: usize| -> [Rational; 2] {
            std::array::from_fn(|axis| {
                let term = |j: usize| shares[j].clone() * ring[(k + j) % 3][axis].clone();
                ((term(0) + term(1) + term(2)) * size.clone()).reduced()
            })
        };
        ring = (0..3).map(corner).collect();
        all.extend(ring.clone());
    }
    all
}

/// The corners, where no triangle is folded.
pub fn turns(m: &Twist, size: &Rational, nested: usize) -> Option<Vec<[Rational; 2]>> {
    let corners = corners(m, size, nested);
    let area = |f: &[usize; 3]| crate::domain::geometry::doubled_area(&corners[f[0]], &corners[f[1]], &corners[f[2]]);
    faces(nested).iter().all(|f| area(f) > Rational::ZERO).then_some(corners)
}

/// The triangulation, with the diagonals of the generator `schonhardt`, corners multiplied by their common denominator; `None`
/// where a triangle is folded, or where a corner is beyond the whole numbers that `f64` has.
pub fn twisted(m: &Twist, size: &Rational, nested: usize) -> Option<Surface> {
    let corners = corners(m, size, nested);
    let mut common = IBig::ONE;
    for x in corners.iter().flatten() {
        let denominator = IBig::from(x.clone().reduced().into_parts().1);
        common = &common * &denominator / gcd(common.clone(), denominator.clone());
    }
    let whole = |x: &Rational| {
        let product = x.clone() * Rational::from(common.clone());
        let rounded = product.approximate();
        (rounded.abs() < 9e15 && Rational::exactly(rounded)? == product).then_some(rounded)
    };
    let points = corners.iter().map(|[x, y]| Some([whole(x)?, whole(y)?])).collect::<Option<Vec<_>>>()?;
    let faces = faces(nested);
    let turn = |f: &[usize; 3]| crate::domain::geometry::orient2d(points[f[0]], points[f[1]], points[f[2]]);
    faces.iter().all(|f| turn(f).is_gt()).then(|| Surface::planar(&points, &faces).ok()).flatten()
}

/// The triangles: around each ring first those with an outer edge, the innermost triangle last.
pub fn faces(nested: usize) -> Vec<[usize; 3]> {
    let ring = |r: usize| {
        (0..3).flat_map(move |k| {
            let (o, p) = (3 * r + k, 3 * r + (k + 1) % 3);
            let (i, j) = (o + 3, p + 3);
            [[o, p, j], [o, j, i]]
        })
    };
    (0..nested).flat_map(ring).chain([[3 * nested, 3 * nested + 1, 3 * nested + 2]]).collect()
}

fn gcd(mut a: IBig, mut b: IBig) -> IBig {
    while b != IBig::ZERO {
        (a, b) = (b.clone(), a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rational_twist_turns_by_its_angle_in_the_equilateral_picture() {
        // (x, y) = ((0, −1) a + (1, 0) b + (−1, 1) c) is taken to the equilateral triangle with corners at 0°, 120°, 240°.
        let equilateral = |[x, y]: [f64; 2]| {
            // (1, 0) is the corner at 120°, (0, −1) the one at 0°.
            let (s, c) = (3_f64.sqrt() / 2.0, -0.5);
            [x * c - y, x * s]
        };
        for (n, d) in [(1, 7), (-2, 5), (1, 3), (-1, 1)] {
            let m = ratio(n, d);
            let all = corners(&m, &ratio(2, 5), 2);
            for k in 0..6 {
                let at = |v: usize| equilateral([all[v][0].approximate(), all[v][1].approximate()]);
                let (outer, inner) = (at(k), at(k + 3));
                let turn = (outer[0] * inner[1] - outer[1] * inner[0]).atan2(outer[0] * inner[0] + outer[1] * inner[1]);
                assert!((turn.to_degrees() - degrees(&m)).abs() < 1e-9, "{n}/{d}: {}", turn.to_degrees());
                assert!((inner[0].hypot(inner[1]) / outer[0].hypot(outer[1]) - 0.4).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_twist_that_folds_a_triangle_makes_no_mesh() {
        assert!(twisted(&ratio(1, 4), &ratio(2, 5), 1).is_some());
        assert!(twisted(&ratio(3, 2), &ratio(2, 5), 1).is_none());
    }
}
