//! Exact calculus on polynomials with rational coefficients: derivatives, integrals, differential forms.
//!
//! A statement about smooth functions that is an identity between polynomials is decided by comparing coefficients.

mod form;
mod integral;
mod polynomial;

pub use form::{Form, random_simplex};
pub use polynomial::{Polynomial, divergence};

use crate::generate::Stream;
use crate::scalar::Rational;

/// The rational number `numerator / denominator`; a denominator of 0 counts as 1.
pub fn ratio(numerator: i64, denominator: u32) -> Rational {
    Rational::from_parts(numerator.into(), denominator.max(1).into())
}

/// A whole number as a rational one.
pub fn whole(x: i64) -> Rational {
    ratio(x, 1)
}

/// A random multiple of 1/6 between −3 and 3.
pub fn drawn(stream: &mut Stream) -> Rational {
    ratio(stream.below(37) as i64 - 18, 6)
}
