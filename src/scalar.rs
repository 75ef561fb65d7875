//! The field that a formula is written over: `f64`, or the exact rationals.
//!
//! Every `f64` is a rational number, so a planar mesh with `f64` coordinates is exactly rational, and so is every entry of
//! a matrix that somebody hands us. A formula written once over [`Scalar`] is evaluated fast over `f64` and exactly over
//! [`Rational`]; the two cannot drift apart because they are the same code.

use std::cmp::Ordering;
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// An exact rational number. Not kept in lowest terms: common factors of two are removed, others may remain.
pub type Rational = dashu_ratio::Relaxed;

/// A field with an order, in which every finite `f64` has an exact counterpart.
pub trait Scalar:
    Clone
    + Debug
    + PartialOrd
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// The neutral element of addition.
    fn zero() -> Self;

    /// The element equal to `x`. A NaN or an infinity has no rational counterpart: over [`Rational`] it is `None`.
    fn exactly(x: f64) -> Option<Self>;

    /// The nearest `f64`, for printing and for comparisons that need no proof.
    fn approximate(&self) -> f64;

    /// The sign of the element: `Less` for negative, `Equal` for zero, `Greater` for positive. A NaN counts as `Equal`.
    fn cmp_zero(&self) -> Ordering {
        self.partial_cmp(&Self::zero()).unwrap_or(Ordering::Equal)
    }

    /// The absolute value.
    fn magnitude(&self) -> Self {
        if self.cmp_zero() == Ordering::Less { -self.clone() } else { self.clone() }
    }

    /// The element one half, which every formula for a cotangent weight needs.
    fn half() -> Self;

    /// The same element in its shortest form: in lowest terms over the rationals. An elimination calls it after every
    /// step, since the length of a [`Rational`] in other than lowest terms doubles from step to step.
    fn reduced(self) -> Self {
        self
    }
}

impl Scalar for f64 {
    fn zero() -> Self {
        0.0
    }
    fn exactly(x: f64) -> Option<Self> {
        Some(x)
    }
    fn approximate(&self) -> f64 {
        *self
    }
    fn half() -> Self {
        0.5
    }
}

impl Scalar for Rational {
    fn zero() -> Self {
        Rational::ZERO
    }
    fn exactly(x: f64) -> Option<Self> {
        Rational::try_from(x).ok()
    }
    fn approximate(&self) -> f64 {
        self.to_f64().value()
    }
    fn half() -> Self {
        Rational::from_parts(1.into(), 2u8.into())
    }
    fn reduced(self) -> Self {
        self.canonicalize().relax()
    }
}

/// Sums in the order given, so that the same terms always round the same way.
pub fn sum<S: Scalar>(terms: impl IntoIterator<Item = S>) -> S {
    terms.into_iter().fold(S::zero(), |total, term| total + term)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tenth_as_f64_is_not_a_tenth() {
        let tenth = Rational::exactly(0.1).unwrap();
        let ten = Rational::exactly(10.0).unwrap();
        assert_ne!((tenth * ten).cmp_zero(), Ordering::Equal);
        let one = Rational::exactly(1.0).unwrap();
        assert_eq!(
            (Rational::exactly(0.1).unwrap() * Rational::exactly(10.0).unwrap() - one).cmp_zero(),
            Ordering::Greater
        );
    }

    #[test]
    fn non_finite_numbers_are_not_rational() {
        assert!(Rational::exactly(f64::NAN).is_none());
        assert!(Rational::exactly(f64::INFINITY).is_none());
    }

    #[test]
    fn conversion_to_f64_inverts_exactly_for_extreme_magnitudes() {
        for x in [1e-300, -3.5, 1e300, 5e-324, f64::MAX, 0.0] {
            assert_eq!(Scalar::approximate(&Rational::exactly(x).unwrap()), x);
        }
    }
}
