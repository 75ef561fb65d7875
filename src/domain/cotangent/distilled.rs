//! The careful way: every product of an edge vector's parts with its error, summed as if in four times the precision.
//!
//! # Formula
//! The two sides at a corner are rounded differences with their errors, hence exact. A product of two components is eight numbers that
//! add up to it exactly, a dot product 24, a component of the cross product 16, and [`distill`] adds them up with an error of the order
//! `(24u)⁴` of the terms and `(24u)²` of the sum, and says how large it may be. Root and quotient are formed in [`Twofold`]s, where nothing
//! cancels: `16u²` for `|n|²`, half of that and `4u²` for the root, `16u²` for the quotient, below `2⁻⁹⁶` in all.
//!
//! # Range
//! Each side is brought to the size one, which changes no angle. Components, and what their rounding lost, must then be zero or at least
//! 2⁻⁴⁸⁰, so that their products have no bits below the smallest `f64`.
//!
//! # Cost
//! Some 3,000 operations: about a microsecond.

use super::super::twofold::{Twofold, distill, power_of_two, two_difference, two_product};

/// Below this a product loses bits: `2⁻⁴⁸⁰`.
const SMALLEST: f64 = power_of_two(-480);

/// The largest component of a cross product, and a dot product that is not zero, must be this large: `2⁻⁴²⁰`.
const SMALL: f64 = power_of_two(-420);

/// Root and quotient in twice the precision.
const ARITHMETIC: f64 = power_of_two(-96);

/// A component as an exact sum of two numbers.
type Pair = [f64; 2];

/// A side, brought to the size one.
struct Side {
    components: [Pair; 3],
    /// Multiplying by both of these brought it there.
    halves: [f64; 2],
}

/// The cotangent at the first of three points and by how much it may be off; `None` where the numbers leave the range, or where
/// the cross product is not clear of its error.
pub(super) fn cotangent([apex, p, q]: &[[f64; 3]; 3]) -> Option<(Twofold, f64)> {
    let (u, v) = (Side::new(apex, p)?, Side::new(apex, q)?);
    let mut terms = [0.0; 24];
    for k in 0..3 {
        terms[8 * k..8 * k + 8].copy_from_slice(&product(u.components[k], v.components[k]));
    }
    let (d, d_error) = distill(terms);
    if d.high != 0.0 && d.high.abs() < SMALL {
        return None;
    }
    let (n, n_error) = cross(&u, &v)?;
    let cotangent = d / n;
    let size = cotangent.high.abs();
    // Twice, for the rounding of the bound and what is of second order in it.
    Some((cotangent, 2.0 * (d_error + size * n_error) / n.high + ARITHMETIC * size))
}

/// Twice the area of a triangle, off by little more than one rounding; `None` as above.
pub(super) fn doubled_area([apex, p, q]: &[[f64; 3]; 3]) -> Option<f64> {
    let (u, v) = (Side::new(apex, p)?, Side::new(apex, q)?);
    let (n, _) = cross(&u, &v)?;
    // One side after the other, and in halves, so that nothing on the way is larger or smaller than need be.
    let [a, b] = [u.halves, v.halves];
    Some(n.high / a[0] / b[0] / a[1] / b[1])
}

/// The length of the cross product and by how much it may be off before root and squares are rounded.
fn cross(u: &Side, v: &Side) -> Option<(Twofold, f64)> {
    let (u, v) = (&u.components, &v.components);
    let (mut square, mut error, mut largest) = (Twofold::default(), 0.0, 0.0_f64);
    for k in 0..3 {
        let (a, b) = ((k + 1) % 3, (k + 2) % 3);
        let mut terms = [0.0; 16];
        terms[..8].copy_from_slice(&product(u[a], v[b]));
        terms[8..].copy_from_slice(&product(u[b].map(|x| -x), v[a]));
        let (n, own) = distill(terms);
        square = square + n * n;
        error += own;
        largest = largest.max(n.high.abs());
    }
    (largest >= SMALL && error <= largest * power_of_two(-60)).then(|| (square.root(), error))
}

impl Side {
    fn new(from: &[f64; 3], to: &[f64; 3]) -> Option<Self> {
        let pairs: [Pair; 3] = std::array::from_fn(|k| two_difference(to[k], from[k]).into());
        let size = pairs.iter().fold(0.0_f64, |size, pair| size.max(pair[0].abs()));
        if !size.is_normal() {
            return None;
        }
        let exponent = (size.to_bits() >> 52) as i32 - 1023;
        let halves = [-exponent / 2, -exponent - -exponent / 2].map(power_of_two);
        let components = pairs.map(|pair| pair.map(|x| x * halves[0] * halves[1]));
        // A number that vanished on the way, or lost bits, is too small as well.
        let kept = |before: f64, after: f64| before == 0.0 || after.abs() >= SMALLEST;
        let all = (0..3).all(|k| (0..2).all(|l| kept(pairs[k][l], components[k][l])));
        all.then_some(Side { components, halves })
    }
}

/// Eight numbers that add up to the product exactly.
fn product(a: Pair, b: Pair) -> [f64; 8] {
    let mut terms = [0.0; 8];
    for (at, (x, y)) in [(a[1], b[1]), (a[1], b[0]), (a[0], b[1]), (a[0], b[0])].into_iter().enumerate() {
        (terms[4 + at], terms[at]) = two_product(x, y);
    }
    terms
}
