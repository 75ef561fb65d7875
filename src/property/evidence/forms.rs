//! Parts of statements about forms with polynomial coefficients.

use serde::{Deserialize, Serialize};

use super::Fraction;

/// A term `c x₀^e₀ x₁^e₁ … dx_i ∧ dx_j ∧ …`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Term {
    /// c, in lowest terms and not zero.
    pub coefficient: Fraction,
    /// The exponent of each coordinate, as many as dimensions.
    pub exponents: Vec<u32>,
    /// The coordinates i < j < … of the differentials, none for a function.
    pub differentials: Vec<usize>,
}

/// What a harmonic form α is an exception to. Every term of α has a share in what is written down here, so that none can be
/// changed alone.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "to", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Exception {
    /// Being closed: `dα` is not zero, nor is d of a single term.
    Closed {
        /// `dα`, all its terms.
        derivative: Vec<Term>,
    },
    /// Being co-closed: `d*α` is not zero, nor is d* of a single term.
    CoClosed {
        /// `d*α`, all its terms.
        codifferential: Vec<Term>,
    },
    /// Having no local minimum: α is a constant function, so that every point is a minimum of it, and none a strict one.
    NoMinimum {
        /// The value of α everywhere.
        value: Fraction,
    },
}
