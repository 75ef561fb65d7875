//! The intrinsic Delaunay condition of an edge, decided exactly.
//!
//! # Definition
//! For an interior edge ij with opposite angles α and β: `cot α + cot β > 0 ⇔ α + β < π`, the edge is strictly Delaunay;
//! zero at a cocircular pair; negative when the edge is not Delaunay. On a surface in space `cot α = d/√a` with
//! `d = (i−k)·(j−k)` and `a = |(i−k)×(j−k)|²`, both rational, so the sign of the sum of two follows from signs and squares:
//! for `d₁ ≥ 0 > d₂` it is the sign of `d₁² a₂ − d₂² a₁`.
//!
//! # What the rounding of coordinates decides
//! The sign is that of the `f64` coordinates. Where those came from decimals, or from a rotation, each is off by up to half
//! an ulp, `|δx| ≤ u |x|`, and a vertex by up to `r_v = u ‖x_v‖`. That turns the edge vector from k to i by at most
//! `arcsin((r_i + r_k) / |ik|)`, hence the angle at k by no more than the turns of its two sides, and `α + β` by no more than
//! the sum over both apexes. A violated edge whose excess `α + β − π` is not larger lies *within the rounding of the
//! coordinates*: a mesh whose coordinates round to these may have it cocircular, or on the other side. The converse is not claimed,
//! since the bound adds up the worst turns of all sides. The excess itself does not suffer from cancellation: it is
//! `atan2(−(cot α + cot β), 1 − cot α cot β)`, and the sum of two cotangents of opposite sign is
//! `(cot² α − cot² β) / (cot α − cot β)` with a rational numerator.

use std::cmp::Ordering;

use super::geometry::{Vec3, cross3, dot};
use super::{Surface, geometry};
use crate::scalar::{Rational, Scalar};

/// Half an ulp of a number in [1, 2): `u = 2⁻⁵³`.
const HALF_ULP: f64 = f64::EPSILON / 2.0;

/// How the interior edges of a triangle mesh stand to the Delaunay condition.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DelaunayCount {
    /// Edges with α + β < π.
    pub strict: usize,
    /// Edges with α + β = π.
    pub cocircular: usize,
    /// Edges with α + β > π, by number, ascending.
    pub violated: Vec<usize>,
    /// How many of the violated ones owe it to no more than the rounding of their coordinates, perhaps.
    pub within_rounding: usize,
    /// Edges that have a degenerate triangle at their side, where no angle is defined.
    pub undefined: usize,
}

impl DelaunayCount {
    /// Counts the interior edges of a surface; edges with other than two triangles beside them are left out.
    pub fn of(surface: &Surface) -> Self {
        let mut count = DelaunayCount::default();
        for edge in 0..surface.topology().edges().len() {
            if surface.topology().sides(edge).len() != 2 || surface.opposite(edge).len() != 2 {
                continue;
            }
            match weight_sign(surface, edge) {
                Some(Ordering::Greater) => count.strict += 1,
                Some(Ordering::Equal) => count.cocircular += 1,
                Some(Ordering::Less) => {
                    count.within_rounding += usize::from(is_within_rounding(surface, edge));
                    count.violated.push(edge);
                }
                None => count.undefined += 1,
            }
        }
        count
    }

    /// Whether no edge violates the condition and every angle is defined.
    pub fn is_delaunay(&self) -> bool {
        self.violated.is_empty() && self.undefined == 0
    }
}

/// The exact sign of `Σ cot` over the angles opposite an edge, in one triangle, two, or more; `None` if one of the
/// triangles is degenerate.
///
/// More than two cotangents (a non-manifold edge) are summed in intervals that are refined until they exclude zero; sums
/// that cannot be told from zero at 2⁻²⁰⁰⁰ relative are reported as zero.
pub fn weight_sign(surface: &Surface, edge: usize) -> Option<Ordering> {
    let [i, j] = surface.topology().edges()[edge];
    let at = |v: usize| surface.positions()[v];
    let apexes: Vec<[f64; 3]> = surface.opposite(edge).into_iter().map(|(_, k)| at(k)).collect();
    cotangent_sum_sign(at(i), at(j), &apexes)
}

/// Whether the rounding of the coordinates could have brought about that the angles opposite a violated edge exceed π.
fn is_within_rounding(surface: &Surface, edge: usize) -> bool {
    let [i, j] = surface.topology().edges()[edge];
    let corners: Vec<[[f64; 3]; 3]> =
        surface.opposite(edge).into_iter().map(|(_, k)| [k, i, j].map(|v| surface.positions()[v])).collect();
    let [first, second] = corners[..] else { return false };
    let turn = turn_by_rounding(first) + turn_by_rounding(second);
    let roughly = angle(first) + angle(second) - std::f64::consts::PI;
    // An angle is off by at most 8u (what its cotangent is off by, times sin²θ), and the sum by 8u more.
    roughly <= turn + 24.0 * HALF_ULP && excess(first, second) <= turn
}

/// How far the angle at the first of three points may be turned by the rounding of their coordinates, in radians.
fn turn_by_rounding([apex, p, q]: [[f64; 3]; 3]) -> f64 {
    let length = |v: [f64; 3]| v[0].hypot(v[1]).hypot(v[2]);
    let turn = |end: [f64; 3]| {
        let side = length(std::array::from_fn(|c| end[c] - apex[c]));
        let share = HALF_ULP * (length(apex) + length(end)) / side;
        // A side that may be turned round has no direction.
        if share < 1.0 { share.asin() } else { std::f64::consts::PI }
    };
    turn(p) + turn(q)
}

fn angle(corner: [[f64; 3]; 3]) -> f64 {
    let [apex, p, q] = corner.map(Vec3::from);
    geometry::angle(apex, p, q)
}

/// By how much the angles at the first points of two triangles exceed π together, in radians, with a relative error of a
/// few u however small it is; NaN if one of the triangles is degenerate.
fn excess(first: [[f64; 3]; 3], second: [[f64; 3]; 3]) -> f64 {
    let (Some((d, a)), Some((e, b))) = (quotient(first), quotient(second)) else { return f64::NAN };
    let (x2, y2) = (d.clone() * d.clone() / a, e.clone() * e.clone() / b);
    let root = |square: &Rational, sign: &Rational| match sign.cmp_zero() {
        Ordering::Less => -square.approximate().sqrt(),
        _ => square.approximate().sqrt(),
    };
    let (x, y) = (root(&x2, &d), root(&y2, &e));
    let sum = if x * y < 0.0 { (x2 - y2).approximate() / (x - y) } else { x + y };
    (-sum).atan2(1.0 - x * y)
}

/// The exact sign of the sum of the cotangents at `apexes` of the triangles over the segment `pq`; `None` if one of them is
/// degenerate. See [`weight_sign`].
pub fn cotangent_sum_sign(p: [f64; 3], q: [f64; 3], apexes: &[[f64; 3]]) -> Option<Ordering> {
    let corners: Vec<_> = apexes.iter().map(|&apex| [apex, p, q]).collect();
    sign_of_cotangents(&corners)
}

/// The exact sign of the sum of the cotangents at the first point of each of some triangles; `None` if one of them is
/// degenerate. See [`weight_sign`] for sums of more than two.
pub fn sign_of_cotangents(corners: &[[[f64; 3]; 3]]) -> Option<Ordering> {
    if let Some(sign) = filtered(corners) {
        return Some(sign);
    }
    let quotients: Vec<_> = corners.iter().map(|&corner| quotient(corner)).collect::<Option<_>>()?;
    Some(match quotients.as_slice() {
        [] => Ordering::Equal,
        [(d, _)] => d.cmp_zero(),
        [(d, a), (e, b)] => sign_of_two(d, a, e, b),
        many => sign_of_many(many),
    })
}

/// The cotangent `d/√a` at the first of three points as (d, a), exactly; `None` if they lie on a line.
pub(super) fn quotient(corner: [[f64; 3]; 3]) -> Option<(Rational, Rational)> {
    let [k, p, q] = corner.map(|x| x.map(|x| Rational::exactly(x).unwrap_or_else(Rational::zero)));
    let u: [Rational; 3] = std::array::from_fn(|c| p[c].clone() - k[c].clone());
    let v: [Rational; 3] = std::array::from_fn(|c| q[c].clone() - k[c].clone());
    let normal = cross3(&u, &v);
    let a = dot(&normal, &normal);
    (a.cmp_zero() != Ordering::Equal).then(|| (dot(&u, &v), a))
}

/// The floating-point answer where its error bound decides.
fn filtered(corners: &[[[f64; 3]; 3]]) -> Option<Ordering> {
    clear_sign(corners.iter().map(|corner| {
        let [apex, p, q] = corner.map(Vec3::from);
        geometry::cotangent(apex, p, q)
    }))
}

/// The sign of a sum of cotangents that [`geometry::cotangent`] computed, where their error bound decides it: each is good to
/// 1¼u, and adding up m of them costs m − 1 more of the magnitudes.
pub fn clear_sign(cotangents: impl Iterator<Item = f64>) -> Option<Ordering> {
    let (mut sum, mut bound, mut count) = (0.0, 0.0, 0.0);
    for cot in cotangents {
        sum += cot;
        bound += cot.abs();
        count += 1.0;
    }
    // One u more covers the rounding of the bound; what underflows is not decided here.
    let bound = (count + 2.0) * HALF_ULP * bound + f64::MIN_POSITIVE;
    (sum.is_finite() && sum.abs() > bound).then(|| sum.cmp_zero())
}

/// The sign of `d/√a + e/√b`.
fn sign_of_two(d: &Rational, a: &Rational, e: &Rational, b: &Rational) -> Ordering {
    match (d.cmp_zero(), e.cmp_zero()) {
        (x, Ordering::Equal) => x,
        (Ordering::Equal, y) => y,
        (x, y) if x == y => x,
        (x, _) => {
            let squares = d.clone() * d.clone() * b.clone() - e.clone() * e.clone() * a.clone();
            if x == Ordering::Greater { squares.cmp_zero() } else { squares.cmp_zero().reverse() }
        }
    }
}

/// The sign of `Σ d/√a` by integer square roots of growing precision.
fn sign_of_many(quotients: &[(Rational, Rational)]) -> Ordering {
    use dashu_base::SquareRoot;
    use dashu_int::{IBig, UBig};
    for bits in [128_usize, 512, 2048] {
        // d/√a = sign(d) √(d²/a), and ⌊√(2^{2b} d²/a)⌋ is within one of 2^b |d|/√a.
        let mut low = IBig::ZERO;
        for (d, a) in quotients {
            let (numerator, denominator) = (d.clone() * d.clone() / a.clone()).into_parts();
            let scaled: UBig = UBig::try_from(numerator << (2 * bits)).unwrap_or_default() / denominator;
            let root = IBig::from(scaled.sqrt());
            low += if d.cmp_zero() == Ordering::Less { -root } else { root };
        }
        let slack = IBig::from(quotients.len());
        if low > slack {
            return Ordering::Greater;
        }
        if low < -slack {
            return Ordering::Less;
        }
    }
    Ordering::Equal
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(p: [f64; 2]) -> [f64; 3] {
        [p[0], p[1], 0.0]
    }

    #[test]
    fn in_the_plane_the_sign_is_minus_the_incircle_predicate() {
        let points: Vec<[f64; 2]> = (0..25).map(|k| [f64::from(k % 5), f64::from(k / 5)]).collect();
        let mut signs = [0; 3];
        for &i in &points {
            for &j in &points {
                for &k in &points {
                    for &l in points.iter().step_by(3) {
                        if geometry::orient2d(i, j, k).is_gt() && geometry::orient2d(j, i, l).is_gt() {
                            let expected = geometry::incircle(i, j, k, l).reverse();
                            let found = cotangent_sum_sign(flat(i), flat(j), &[flat(k), flat(l)]);
                            assert_eq!(found, Some(expected), "{i:?} {j:?} {k:?} {l:?}");
                            signs[(expected as i8 + 1) as usize] += 1;
                        }
                    }
                }
            }
        }
        assert!(signs.iter().all(|&n| n > 100), "each of the three signs occurs: {signs:?}");
    }

    #[test]
    fn a_cocircular_pair_is_zero_even_when_folded_into_space() {
        // Two right isosceles triangles over the same hypotenuse, one of them folded up: cot 90° + cot 90° = 0.
        let found = cotangent_sum_sign([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], &[[0.0; 3], [1.0, 1.0, 0.0]]);
        assert_eq!(found, Some(Ordering::Equal));
        let s = 0.5;
        let folded = cotangent_sum_sign([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], &[[0.0; 3], [s, s, s * 2f64.sqrt()]]);
        // √2 is rounded, so the angle is not exactly right; the sign is the exact sign of the data.
        assert_ne!(folded, None);
    }

    #[test]
    fn one_ulp_decides_beyond_the_reach_of_rounding() {
        let (p, q, k) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]);
        let out = [1.0 + f64::EPSILON, 1.0, 0.0];
        let inside = [1.0 - f64::EPSILON, 1.0, 0.0];
        assert_eq!(cotangent_sum_sign(p, q, &[k, out]), Some(Ordering::Greater));
        assert_eq!(cotangent_sum_sign(p, q, &[k, inside]), Some(Ordering::Less));
    }

    #[test]
    fn three_cotangents_that_cancel_are_told_from_those_that_do_not() {
        // cot 45° = 1 twice against cot 135° = −1 and a right angle.
        let (p, q) = ([0.0; 3], [2.0, 0.0, 0.0]);
        let right = [1.0, 1.0, 0.0];
        let acute = [0.0, 2.0, 0.0];
        let obtuse = [1.0, 0.0, 2f64.sqrt() - 1.0];
        assert_eq!(cotangent_sum_sign(p, q, &[right, right, right]), Some(Ordering::Equal));
        assert_eq!(cotangent_sum_sign(p, q, &[right, acute, acute]), Some(Ordering::Greater));
        assert_eq!(cotangent_sum_sign(p, q, &[right, obtuse, obtuse]), Some(Ordering::Less));
    }

    /// The kite over the segment from (0, 1 + h) to (0, −1) with apexes at distance one from the origin, one turned up: right
    /// angles for h = 0, and `α + β − π = 2 (atan(1 + h) − π/4) = 2 atan(h / (2 + h))` else.
    fn kite(h: f64) -> [[[f64; 3]; 3]; 2] {
        [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]].map(|apex| [apex, [0.0, 1.0 + h, 0.0], [0.0, -1.0, 0.0]])
    }

    fn kite_at(x: f64, h: f64) -> DelaunayCount {
        let p = [[x + 1.0, 0.0], [x - 1.0, 0.0], [x, 1.0 + h], [x, -1.0]];
        DelaunayCount::of(&Surface::planar(&p, &[[0, 2, 3], [1, 3, 2]]).unwrap())
    }

    #[test]
    fn the_excess_of_a_kite_is_accurate_from_the_last_bit_to_a_right_angle() {
        for bits in -2..=52 {
            let h = 2f64.powi(-bits);
            let [first, second] = kite(h);
            let expected = 2.0 * (h / (2.0 + h)).atan();
            assert!((excess(first, second) / expected - 1.0).abs() <= 16.0 * HALF_ULP, "2^-{bits}");
        }
        assert!(excess(kite(0.0)[0], [[1.0; 3]; 3]).is_nan());
    }

    #[test]
    fn an_excess_of_a_last_bit_may_be_rounding_and_more_than_the_bound_may_not() {
        // The vertices are off by up to u, the sides √2 long: four sides turn by 4 · 2u/√2 = 5.66 u in all, and the excess is h.
        for (ulps, within) in [(1, 1), (2, 1), (3, 0), (1000, 0)] {
            let count = kite_at(0.0, f64::from(ulps) * f64::EPSILON);
            assert_eq!((count.violated.len(), count.within_rounding), (1, within), "{ulps}");
        }
        // A thousand away from the origin coordinates are a thousand times coarser.
        for (ulps, within) in [(3, 1), (1000, 1), (6000, 0)] {
            assert_eq!(kite_at(1000.0, f64::from(ulps) * f64::EPSILON).within_rounding, within, "{ulps}");
        }
        assert_eq!(kite_at(0.0, 0.0), DelaunayCount { cocircular: 1, ..DelaunayCount::default() });
    }

    #[test]
    fn four_decimals_on_a_circle_are_no_longer_on_it_as_doubles() {
        // 0.3² + 0.4² = 0.5², but the doubles nearest to 0.3 and 0.4 give more: the diagonal that ends there is violated.
        let p = |x: f64| [[x, 0.4], [-0.5, 0.0], [0.0, -0.5], [0.5, 0.0]];
        let count = |x| DelaunayCount::of(&Surface::planar(&p(x), &[[0, 1, 2], [0, 2, 3]]).unwrap());
        assert_eq!((count(0.3).violated.len(), count(0.3).within_rounding), (1, 1));
        assert_eq!((count(0.300000001).violated.len(), count(0.300000001).within_rounding), (1, 0));
    }

    #[test]
    fn two_flat_caps_exceed_by_almost_half_a_turn_and_no_rounding_did_that() {
        let p = [[-1.0, 0.0], [1.0, 0.0], [0.0, 1e-9], [0.0, -1e-9]];
        let count = DelaunayCount::of(&Surface::planar(&p, &[[0, 1, 2], [1, 0, 3]]).unwrap());
        assert_eq!((count.violated.len(), count.within_rounding), (1, 0));
    }

    #[test]
    fn a_degenerate_triangle_has_no_sign() {
        assert_eq!(cotangent_sum_sign([0.0; 3], [1.0, 1.0, 1.0], &[[2.0, 2.0, 2.0]]), None);
    }
}
