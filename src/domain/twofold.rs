//! Numbers of twice the precision: an unevaluated sum of two `f64`, and the error-free transformations that make them.
//!
//! # Definition
//! ```text
//! two_sum(a, b) = (s, e):  s = fl(a + b),  s + e = a + b exactly        (Knuth; no order of magnitudes asked for)
//! two_product(a, b) = (p, e):  p = fl(a b),  p + e = a b exactly        (Dekker, with Veltkamp's splitting)
//! ```
//! `u = 2⁻⁵³`. Sums are error-free for all finite numbers whose sum is finite. Products are where `2⁻⁹⁶⁰ ≤ |ab| ≤ 2¹⁰⁰⁰` or
//! `ab = 0`, so that the last bit of the error is still a number. No fused multiply-add: without the machine's instruction it
//! is a call that costs more than the splitting.
//!
//! # Cost
//! 6 operations a sum, 17 a product, no branch.
//!
//! # References
//! \[ogita2005\]: the transformations, and the sums of vectors of [`distill`].

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The unit roundoff `u = 2⁻⁵³`.
pub(super) const U: f64 = f64::EPSILON / 2.0;

/// `2^k` for a k at which it is a normal number.
pub(super) const fn power_of_two(k: i32) -> f64 {
    f64::from_bits(((k + 1023) as u64) << 52)
}

/// The rounded sum and its error.
#[inline]
pub(super) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let other = s - a;
    (s, (a - (s - other)) + (b - other))
}

/// The rounded difference and its error.
#[inline]
pub(super) fn two_difference(a: f64, b: f64) -> (f64, f64) {
    two_sum(a, -b)
}

/// The upper 26 bits and the lower 27, of which the sign takes one.
#[inline]
fn split(a: f64) -> (f64, f64) {
    const FACTOR: f64 = ((1_u64 << 27) + 1) as f64;
    let c = FACTOR * a;
    let high = c - (c - a);
    (high, a - high)
}

/// The rounded product and its error.
#[inline]
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    (p, a2 * b2 - (((p - a1 * b1) - a2 * b1) - a1 * b2))
}

/// The sum `high + low` with `|low| ≤ u |high|`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twofold {
    /// The nearest `f64`.
    pub high: f64,
    /// The rest.
    pub low: f64,
}

impl Twofold {
    /// The sum of two numbers, exactly.
    pub fn sum(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, b);
        Twofold { high, low }
    }

    /// The product of two numbers, exactly.
    fn product(a: f64, b: f64) -> Self {
        let (high, low) = two_product(a, b);
        Twofold { high, low }
    }

    /// Half of it, exactly.
    pub fn half(self) -> Self {
        Twofold { high: 0.5 * self.high, low: 0.5 * self.low }
    }

    /// The absolute value.
    pub fn magnitude(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The square root of a positive number: one step of Newton's from that of `high`. The relative error is below 4u².
    pub(super) fn root(self) -> Self {
        let near = self.high.sqrt();
        Twofold::sum(near, (self - Twofold::product(near, near)).high / (2.0 * near))
    }
}

impl From<f64> for Twofold {
    fn from(high: f64) -> Self {
        Twofold { high, low: 0.0 }
    }
}

impl Neg for Twofold {
    type Output = Self;
    fn neg(self) -> Self {
        Twofold { high: -self.high, low: -self.low }
    }
}

/// The relative error is below 4u² where the signs agree, and below 4u² of the larger magnitude always.
impl Add for Twofold {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (s, e) = two_sum(self.high, other.high);
        let (t, f) = two_sum(self.low, other.low);
        let (s, e) = two_sum(s, e + t);
        Twofold::sum(s, e + f)
    }
}

impl Sub for Twofold {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

/// The relative error is below 8u².
impl Mul for Twofold {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (p, e) = two_product(self.high, other.high);
        Twofold::sum(p, e + (self.high * other.low + self.low * other.high))
    }
}

/// The relative error is below 16u².
impl Div for Twofold {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let near = self.high / other.high;
        let rest = self - other * Twofold::from(near);
        Twofold::sum(near, rest.high / other.high)
    }
}

/// The sum of some numbers, and by how much it may be off.
///
/// Three times over, each partial sum is replaced by its rounded value and its error: the last number becomes the rounded sum,
/// the others errors of errors, and the sum stays what it is, exactly. What is then lost is the rounding of the plain sum of
/// N − 1 remainders, at most `N u Σ|remainder|` (the bound doubles that, for its own rounding), which after k passes is of the
/// order `(N u)² |sum| + (N u)^(k+1) Σ|term|`. It is zero, and the sum exact, where no remainder is left.
pub(super) fn distill<const N: usize>(mut terms: [f64; N]) -> (Twofold, f64) {
    for _ in 0..3 {
        for k in 1..N {
            (terms[k], terms[k - 1]) = two_sum(terms[k], terms[k - 1]);
        }
    }
    let Some((&last, rest)) = terms.split_last() else { return (Twofold::default(), 0.0) };
    let low: f64 = rest.iter().sum();
    let remainders: f64 = rest.iter().map(|x| x.abs()).sum();
    (Twofold::sum(last, low), 2.0 * N as f64 * U * remainders)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::{Rational, Scalar};

    fn exactly(x: f64) -> Rational {
        Rational::exactly(x).unwrap()
    }

    fn whole(x: Twofold) -> Rational {
        exactly(x.high) + exactly(x.low)
    }

    /// Numbers of all magnitudes between 2⁻⁴⁰⁰ and 2⁴⁰⁰.
    fn numbers(count: usize) -> Vec<f64> {
        let mut bits = 7_u64;
        let mut next = || {
            bits = bits.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            bits >> 11
        };
        let number = |_| {
            let mantissa = 1.0 + next() as f64 / (1_u64 << 53) as f64;
            let sign = if next() % 2 == 0 { 1.0 } else { -1.0 };
            sign * mantissa * power_of_two((next() % 801) as i32 - 400)
        };
        (0..count).map(number).collect()
    }

    #[test]
    fn sums_and_products_lose_nothing() {
        for pair in numbers(2000).windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let ((s, e), (d, f), (p, g)) = (two_sum(a, b), two_difference(a, b), two_product(a, b));
            assert_eq!(exactly(s) + exactly(e), exactly(a) + exactly(b));
            assert_eq!(exactly(d) + exactly(f), exactly(a) - exactly(b));
            assert_eq!(exactly(p) + exactly(g), exactly(a) * exactly(b));
        }
    }

    #[test]
    fn arithmetic_has_twice_the_digits() {
        let list = numbers(4000);
        let near = |found: Twofold, exact: &Rational, scale: &Rational, times: f64| {
            let error = (whole(found) - exact.clone()).magnitude();
            let bound = scale.magnitude() * exactly(times * U * U);
            assert!(error <= bound, "{found:?}");
        };
        for four in list.windows(4) {
            // The tail is a few last bits of the head.
            let number = |head: f64, tail: f64| Twofold::sum(head, head * tail / tail.abs() * 1.1e-17);
            let (a, b) = (number(four[0], four[1]), number(four[2], four[3]));
            let (x, y) = (whole(a), whole(b));
            near(a * b, &(x.clone() * y.clone()), &(x.clone() * y.clone()), 8.0);
            near(a / b, &(x.clone() / y.clone()), &(x.clone() / y.clone()), 16.0);
            let larger = if x.magnitude() > y.magnitude() { &x } else { &y };
            near(a + b, &(x.clone() + y.clone()), larger, 4.0);
            // r² = x (1 + 2δ) for a root r with a relative error δ.
            let root = whole(a.magnitude().root());
            let square = root.clone() * root;
            let error = (square - x.magnitude()).magnitude();
            assert!(error <= x.magnitude() * exactly(8.01 * U * U));
        }
    }

    #[test]
    fn a_sum_that_cancels_to_the_last_bits_of_its_terms_is_exact() {
        let (sum, bound) = distill([1e100, 1.0, -1e100, 1e-100, -1.0, 0.0]);
        assert_eq!((sum, bound), (Twofold::from(1e-100), 0.0));
        let (sum, bound) = distill([3.0, -1.0, -2.0]);
        assert_eq!((sum.high, bound), (0.0, 0.0));
    }

    #[test]
    fn the_bound_of_a_sum_covers_its_error() {
        for chunk in numbers(2400).chunks_exact(12) {
            let terms: [f64; 12] = chunk.try_into().unwrap();
            let (sum, bound) = distill(terms);
            let exact = terms.iter().fold(Rational::zero(), |total, &x| total + exactly(x));
            assert!((whole(sum) - exact).magnitude() <= exactly(bound), "{terms:?}");
        }
    }
}
