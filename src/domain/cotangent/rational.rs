//! The exact way: `cot θ = d/√a` with rational d and a, and a rational root to as many bits as it takes.

use std::cmp::Ordering;

use dashu_base::{BitTest, SquareRoot};
use dashu_int::{IBig, UBig};

use super::super::delaunay;
use super::super::twofold::Twofold;
use crate::scalar::{Rational, Scalar};

/// Bits of a root.
const BITS: isize = 160;

/// A sum of three roots and more that is not told from zero at these is reported as zero; sums of one and two are exact.
const MOST_BITS: isize = 2560;

/// The cotangent at the first of three points, to 2⁻¹⁰⁰ and better; `None` if they lie on a line.
pub(super) fn cotangent(corner: &[[f64; 3]; 3]) -> Option<Twofold> {
    let (d, a) = delaunay::quotient(*corner)?;
    Some(rounded(&root(&d, &a, BITS)))
}

/// The sum of the cotangents at the first points of some triangles, to 2⁻¹⁰⁰ and better; `None` if one of them is degenerate.
///
/// Two of opposite sign are `(c² − e²) / (c − e)`, whose numerator is rational and whose denominator does not cancel: a zero is one exactly.
pub(super) fn sum(corners: &[[[f64; 3]; 3]]) -> Option<Twofold> {
    let quotients: Vec<_> = corners.iter().map(|&corner| delaunay::quotient(corner)).collect::<Option<_>>()?;
    let roots = |bits: isize| quotients.iter().map(move |(d, a)| root(d, a, bits)).collect::<Vec<_>>();
    let plain = |roots: &[Rational]| roots.iter().fold(Rational::zero(), |sum, c| sum + c.clone());
    let mixed = {
        let of = |sign: Ordering| quotients.iter().any(|(d, _)| d.cmp_zero() == sign);
        of(Ordering::Less) && of(Ordering::Greater)
    };
    match quotients.as_slice() {
        [(d, a), (e, b)] if mixed => {
            let [c, f] = [root(d, a, BITS), root(e, b, BITS)];
            let squares = d.clone() * d.clone() / a.clone() - e.clone() * e.clone() / b.clone();
            Some(rounded(&(squares / (c - f))))
        }
        _ if !mixed => Some(rounded(&plain(&roots(BITS)))),
        _ => {
            let mut bits = BITS;
            while bits <= MOST_BITS {
                let roots = roots(bits);
                let sum = plain(&roots);
                let size = roots.iter().fold(Rational::zero(), |size, c| size + c.magnitude());
                // The sum is off by no more than 2^(1−bits) of the size.
                if sum.magnitude() * Rational::from(IBig::ONE << (bits - 110) as usize) > size {
                    return Some(rounded(&sum));
                }
                bits *= 4;
            }
            Some(Twofold::default())
        }
    }
}

/// `d/√a` with a relative error of at most 2^(1−bits).
fn root(d: &Rational, a: &Rational, bits: isize) -> Rational {
    if d.cmp_zero() == Ordering::Equal {
        return Rational::zero();
    }
    // |d|/√a = √(d²/a) = √(2^{2k} N/D) / 2^k, with k such that the integer root has that many bits.
    let (numerator, denominator) = (d.clone() * d.clone() / a.clone()).into_parts();
    let numerator = UBig::try_from(numerator).unwrap_or_default();
    let length = |n: &UBig| n.bit_len() as isize;
    let k = bits + 2 + (length(&denominator) - length(&numerator)) / 2;
    let shifted = |n: UBig, by: isize| if by > 0 { n << by as usize } else { n };
    let root = (shifted(numerator, 2 * k) / shifted(denominator, -2 * k)).sqrt();
    let scale = |by: isize| IBig::from(shifted(UBig::ONE, by));
    let magnitude = Rational::from(IBig::from(root) * scale(-k)) / Rational::from(scale(k));
    if d.cmp_zero() == Ordering::Less { -magnitude } else { magnitude }
}

/// The nearest `f64` and the rest, rounded. What is not zero keeps its sign: below the normal numbers it becomes the smallest of them.
fn rounded(x: &Rational) -> Twofold {
    let high = x.approximate();
    if high.abs() < f64::MIN_POSITIVE {
        return Twofold::from(match x.cmp_zero() {
            Ordering::Less => -f64::MIN_POSITIVE,
            Ordering::Equal => 0.0,
            Ordering::Greater => f64::MIN_POSITIVE,
        });
    }
    match Rational::exactly(high) {
        Some(near) => Twofold { high, low: (x.clone() - near).approximate() },
        None => Twofold::from(high),
    }
}
