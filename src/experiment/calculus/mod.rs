//! Exact calculus on polynomials with rational coefficients: derivatives, integrals, differential forms.
//!
//! A statement about smooth functions that is an identity between polynomials is decided by comparing coefficients.

mod form;
mod integral;
mod metric;
mod polynomial;

pub use form::{Form, determinant, masks, random_simplex, wedge_sign};
pub use metric::{Metric, complement_sign};
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

/// A random polynomial that vanishes on the boundary of the unit cube.
pub fn vanishing(n: usize, stream: &mut Stream) -> Polynomial {
    let one = Polynomial::constant(n, Rational::ONE);
    (0..n).fold(Polynomial::random(n, 2, stream), |p, k| {
        let x = Polynomial::variable(n, k);
        &p * &(&x * &(&one - &x))
    })
}
