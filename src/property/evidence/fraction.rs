//! Rational numbers as text.

use dashu_int::{IBig, UBig};
use serde::{Deserialize, Serialize};

use crate::scalar::{Rational, Scalar};

/// A rational number as text: decimal digits, perhaps with a minus before them and a denominator after, "-7" or "22/7".
///
/// JSON has no such number, and an `f64` has not enough digits for one that equations have to hold of.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Fraction(String);

impl Fraction {
    /// From its text, which may turn out not to be a number.
    pub fn text(text: impl Into<String>) -> Self {
        Fraction(text.into())
    }

    /// The number; `None` where the text is not one.
    pub fn value(&self) -> Option<Rational> {
        let (numerator, denominator) = self.0.split_once('/').unwrap_or((&self.0, "1"));
        let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        if !digits(numerator.strip_prefix('-').unwrap_or(numerator)) || !digits(denominator) {
            return None;
        }
        let denominator: UBig = denominator.parse().ok()?;
        let numerator: IBig = numerator.parse().ok()?;
        (denominator != UBig::ZERO).then(|| Rational::from_parts(numerator, denominator))
    }

    /// The nearest `f64`, for a reader; NaN where the text is no number.
    pub fn approximate(&self) -> f64 {
        self.value().map_or(f64::NAN, |value| value.approximate())
    }
}

impl From<&Rational> for Fraction {
    /// In lowest terms.
    fn from(value: &Rational) -> Self {
        let (numerator, denominator) = value.clone().canonicalize().into_parts();
        Fraction(if denominator == UBig::ONE { numerator.to_string() } else { format!("{numerator}/{denominator}") })
    }
}

impl std::fmt::Display for Fraction {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fraction_is_read_back_in_lowest_terms() {
        let value = Rational::from(IBig::from(-44)) / Rational::from(IBig::from(14));
        let fraction = Fraction::from(&value);
        assert_eq!(fraction.to_string(), "-22/7");
        assert!(fraction.value().is_some_and(|back| back == value));
        assert_eq!(Fraction::from(&Rational::from(IBig::from(3))).to_string(), "3");
        assert!((fraction.approximate() + 22.0 / 7.0).abs() < 1e-15);
    }

    #[test]
    fn what_is_no_fraction_is_none() {
        for text in ["", "-", "1/0", "1/-2", "0x10", "1_000", "+1", "1.5", "1/2/3", " 1", "--1"] {
            assert_eq!(Fraction::text(text).value(), None, "{text:?}");
        }
    }
}
