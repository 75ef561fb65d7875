//! Cotangents of the angles of a triangle and half-sums of them, right to the last digits whatever the triangle.
//!
//! # Definition
//! ```text
//! cot θ = d / |n|,  d = (p − apex)·(q − apex),  n = (p − apex)×(q − apex),      ω = ½ Σ cot θ
//! ```
//! of the coordinates as they are: a domain's `f64` are exact numbers.
//!
//! # Guarantees
//! On every triangle that is not degenerate, at every place and scale that a domain may have, as long as the result is a normal number:
//! * a cotangent is off by at most `½ ulp + u/4 |cot θ|`, so by less than one unit in the last place; zero is zero exactly;
//! * a half-sum is off by at most `½ ulp + 3u |ω|`, so by less than 4 units in the last place, however much of it cancels; of one
//!   or two cotangents a zero is zero exactly, and so is the sign. *Exception*: of three and more (an edge that is not manifold) a sum
//!   below 2⁻²⁴⁰⁰ of its terms is reported as zero.
//! * Multiplying all coordinates by a power of two changes no bit, while none of them leaves the normal numbers.
//!
//! # Why not the plain formula
//! Plain `f64` rounds the edges (2u), products and sums (3u) of the dot product, as much for the cross product, then root and
//! quotient: a bound of 13u of a result whose terms do not cancel at all, above the 4u that four units in the last place are at
//! worst. No test after the fact can pass it, so the cheap way is one that rounds less.
//!
//! # Three ways
//! | way | when it is enough | cost |
//! | --- | --- | --- |
//! | [heads](Way::Heads): products of upper halves, without rounding | `|n| ≥ 2⁻¹⁶ AB` and `|d| ≥ 2⁻¹⁶ ab`: all but caps flatter than about 1.5e-5 and angles as near to 90° | some 350 operations a triangle |
//! | [distilled](Way::Distilled): error-free transformations, four-fold sums | flat down to 1e-40, right up to the last bit | a microsecond a corner |
//! | [rational](Way::Rational): rationals and their square roots | always | some 20 microseconds a corner |
//!
//! The bound of each decides whether the next one is asked; the derivations are with the code.

mod distilled;
mod heads;
mod rational;

use super::geometry::{Vec3, doubled_area_in_space};
pub use super::twofold::Twofold;
use super::twofold::U;
use heads::{Heads, SIDE_BY_SIDE};

/// How a cotangent was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Way {
    /// The cheap way.
    Heads,
    /// Error-free transformations.
    Distilled,
    /// Rationals.
    Rational,
}

/// The cotangents of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cotangents {
    /// At the three corners; infinite or NaN where the triangle is degenerate.
    pub values: [f64; 3],
    /// Twice the area, with a relative error of a few u.
    pub doubled_area: f64,
    /// How each was computed.
    pub ways: [Way; 3],
}

/// The cotangents of a triangle.
#[inline]
pub fn of_triangle(corners: [Vec3; 3]) -> Cotangents {
    let points = corners.map(Into::into);
    let heads = Heads::of(&points);
    let values = heads.cotangents.map(|c| c.high);
    if heads.suffices(0) && heads.suffices(1) && heads.suffices(2) {
        return Cotangents { values, doubled_area: heads.doubled_area, ways: [Way::Heads; 3] };
    }
    carefully(corners, &points, &heads)
}

/// The cotangents and twice the area of many triangles, bit for bit those of [`of_triangle`], as long as the list to fill:
/// `corners` gives the triangle with a number in it.
pub fn of_triangles(corners: impl Fn(usize) -> [[f64; 3]; 3], fill: &mut [[f64; 4]]) {
    let careful = |k: usize| {
        let found = of_triangle(corners(k).map(Vec3::from));
        [found.values[0], found.values[1], found.values[2], found.doubled_area]
    };
    let (mut coordinates, mut suffices) = ([[0.0; 9]; SIDE_BY_SIDE], [0.0; SIDE_BY_SIDE]);
    let (blocks, rest) = fill.as_chunks_mut::<SIDE_BY_SIDE>();
    let first_of_rest = SIDE_BY_SIDE * blocks.len();
    for (block, found) in blocks.iter_mut().enumerate() {
        for (at, nine) in coordinates.iter_mut().enumerate() {
            let [p, q, r] = corners(SIDE_BY_SIDE * block + at);
            *nine = [p[0], p[1], p[2], q[0], q[1], q[2], r[0], r[1], r[2]];
        }
        heads::many(&coordinates, found, &mut suffices);
        for at in (0..SIDE_BY_SIDE).filter(|&at| suffices[at] == 0.0) {
            found[at] = careful(SIDE_BY_SIDE * block + at);
        }
    }
    for (at, found) in rest.iter_mut().enumerate() {
        *found = careful(first_of_rest + at);
    }
}

#[cold]
fn carefully(corners: [Vec3; 3], points: &[[f64; 3]; 3], heads: &Heads) -> Cotangents {
    let one = |k: usize| match heads.suffices(k) {
        true => (heads.cotangents[k].high, Way::Heads),
        false => rounded(&[points[k], points[(k + 1) % 3], points[(k + 2) % 3]]),
    };
    let found = [one(0), one(1), one(2)];
    let doubled_area = match heads.area_suffices() {
        true => heads.doubled_area,
        false => distilled::doubled_area(points).unwrap_or_else(|| {
            let [a, b, c] = corners;
            doubled_area_in_space(a, b, c)
        }),
    };
    Cotangents { values: found.map(|f| f.0), doubled_area, ways: found.map(|f| f.1) }
}

/// The cotangent of the angle at `apex`: one of [`of_triangle`].
pub fn cotangent(apex: Vec3, p: Vec3, q: Vec3) -> f64 {
    let corner = [apex, p, q].map(Into::into);
    let heads = Heads::of(&corner);
    if heads.suffices(0) { heads.cotangents[0].high } else { rounded(&corner).0 }
}

/// The cotangent at the first of three points where the cheap way is not enough.
fn rounded(corner: &[[f64; 3]; 3]) -> (f64, Way) {
    if let Some((cot, error)) = distilled::cotangent(corner) {
        // Rounded to the nearest, the twofold number is off by half a unit in the last place and its own error.
        if error <= 0.25 * U * cot.high.abs() {
            return (cot.high, Way::Distilled);
        }
    }
    match rational::cotangent(corner) {
        Some(cot) => (cot.high, Way::Rational),
        None => {
            let [apex, p, q] = corner.map(Vec3::from);
            ((p - apex).dot(&(q - apex)) / 0.0, Way::Rational)
        }
    }
}

/// The weight `½ Σ cot` of at most two cotangents as [`of_triangle`] has them; `corners` gives the triangles, each from the angle's
/// corner on, and is asked only where too much cancels. For more than two use [`precise_half_sum`].
///
/// With relative errors of `1¼u` a sum of two is off by `1¼u Σ|cot|` and half a unit in the last place, which is within the
/// guarantee while `1¼ Σ|cot| ≤ 3 |Σ cot|`; two of one sign always are.
#[inline]
pub fn half_sum<C: Iterator<Item = [Vec3; 3]>>(cotangents: &[f64], corners: impl FnOnce() -> C) -> f64 {
    let (sum, size) = cotangents.iter().fold((0.0, 0.0), |(sum, size), c| (sum + c, size + c.abs()));
    if cotangents.len() <= 2 && 1.25 * size <= 3.0 * sum.abs() { 0.5 * sum } else { cancelling(corners()) }
}

#[cold]
fn cancelling(corners: impl Iterator<Item = [Vec3; 3]>) -> f64 {
    precise_half_sum(corners).high
}

/// The weight `½ Σ cot` over the angles at the first points of some triangles in twice the precision: off by at most `u |ω|` before it is
/// rounded, and as a rule by far less. NaN if one of the triangles is degenerate.
pub fn precise_half_sum(corners: impl IntoIterator<Item = [Vec3; 3]>) -> Twofold {
    let corners: Vec<[[f64; 3]; 3]> = corners.into_iter().map(|corner| corner.map(Into::into)).collect();
    let cheap = corners.iter().map(|corner| {
        let heads = Heads::of(corner);
        heads.area_suffices().then(|| (heads.cotangents[0], heads.error(0)))
    });
    let sum = sum(cheap).or_else(|| sum(corners.iter().map(distilled::cotangent)));
    sum.or_else(|| rational::sum(&corners)).unwrap_or(Twofold::from(f64::NAN)).half()
}

/// The sum of cotangents with their errors, if it is known to u.
fn sum(cotangents: impl Iterator<Item = Option<(Twofold, f64)>>) -> Option<Twofold> {
    let (mut sum, mut error, mut size) = (Twofold::default(), 0.0, 0.0);
    for found in cotangents {
        let (cot, own) = found?;
        sum = sum + cot;
        error += own;
        size += cot.high.abs();
    }
    // Sums of two-fold numbers are off by 4u² of the magnitudes; twice that is for the rounding of the bound.
    (error + 8.0 * U * U * size <= 0.5 * U * sum.high.abs() || error + size == 0.0).then_some(sum)
}
