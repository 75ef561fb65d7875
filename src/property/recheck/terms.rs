//! Sums of products, decided exactly: in floating point where its error bound allows, in rationals where it does not.

use std::cmp::Ordering;

use crate::scalar::{Rational, Scalar};

/// The unit roundoff `u = 2⁻⁵³`.
pub(super) const U: f64 = f64::EPSILON / 2.0;

/// Products between these magnitudes neither overflow nor lose bits to underflow.
const SAFE: std::ops::RangeInclusive<f64> = 1e-290..=1e290;

/// `factor · (first₀ − first₁) · (second₀ − second₁)`.
struct Term {
    factor: f64,
    first: [f64; 2],
    second: [f64; 2],
}

/// A sum of products of numbers and differences, all finite.
#[derive(Default)]
pub(super) struct Terms(Vec<Term>);

/// The sum in floating point.
#[derive(Clone, Copy)]
struct Approximation {
    value: f64,
    /// How far the exact sum may be away; infinite where a product left the safe range.
    bound: f64,
    /// `Σ |term|`.
    scale: f64,
}

impl Terms {
    /// Adds a number.
    pub fn add(&mut self, x: f64) {
        self.add_differences(x, [1.0, 0.0], [1.0, 0.0]);
    }

    /// Adds `factor · a · b`.
    pub fn add_product(&mut self, factor: f64, a: f64, b: f64) {
        self.add_differences(factor, [a, 0.0], [b, 0.0]);
    }

    /// Adds `factor · (first₀ − first₁) · (second₀ − second₁)`.
    pub fn add_differences(&mut self, factor: f64, first: [f64; 2], second: [f64; 2]) {
        self.0.push(Term { factor, first, second });
    }

    /// Adds `sign` times every term of another sum.
    pub fn append(&mut self, sign: f64, other: Terms) {
        self.0.extend(other.0.into_iter().map(|t| Term { factor: sign * t.factor, ..t }));
    }

    /// A difference is rounded once, a product of three factors twice more, a sum of n terms n − 1 times: each term carries at
    /// most n + 3 roundings. Three more cover the rounding of the bound itself.
    fn approximate(&self) -> Approximation {
        let (mut value, mut scale, mut safe) = (0.0, 0.0, true);
        for t in &self.0 {
            let (a, b) = (t.first[0] - t.first[1], t.second[0] - t.second[1]);
            if t.factor == 0.0 || a == 0.0 || b == 0.0 {
                continue;
            }
            let partial = t.factor * a;
            let term = partial * b;
            safe &= SAFE.contains(&partial.abs()) && SAFE.contains(&term.abs());
            value += term;
            scale += term.abs();
        }
        let bound = if safe { (self.0.len() as f64 + 6.0) * U * scale } else { f64::INFINITY };
        Approximation { value, bound, scale }
    }

    /// The sum in rationals. A number that is not finite counts as zero: excerpts are refused before they come here.
    pub fn exact(&self) -> Rational {
        let rational = |x: f64| Rational::exactly(x).unwrap_or_else(Rational::zero);
        let difference = |d: [f64; 2]| if d[1] == 0.0 { rational(d[0]) } else { rational(d[0]) - rational(d[1]) };
        let term = |t: &Term| rational(t.factor) * difference(t.first) * difference(t.second);
        self.0.iter().fold(Rational::zero(), |sum, t| sum + term(t))
    }

    /// The sum, correctly signed and rounded to about the last bit of its largest term.
    pub fn value(&self) -> f64 {
        let a = self.approximate();
        if a.bound.is_finite() { a.value } else { self.exact().approximate() }
    }

    /// How far [`value`](Self::value) may be from the sum.
    pub fn bound(&self) -> f64 {
        let a = self.approximate();
        if a.bound.is_finite() { a.bound } else { 2.0 * U * self.exact().approximate().abs() }
    }

    /// `Σ |term|`, up to rounding.
    pub fn scale(&self) -> f64 {
        let a = self.approximate();
        if a.bound.is_finite() {
            return a.scale;
        }
        let magnitude = |t: &Term| Terms(vec![Term { ..*t }]).exact().magnitude();
        self.0.iter().fold(Rational::zero(), |sum, t| sum + magnitude(t)).approximate()
    }

    /// The sign of the sum. Exact.
    pub fn sign(&self) -> Ordering {
        let a = self.approximate();
        if a.value.abs() > a.bound { a.value.cmp_zero() } else { self.exact().cmp_zero() }
    }

    /// Whether `|Σ| > threshold`. Exact.
    pub fn exceeds(&self, threshold: f64) -> bool {
        let a = self.approximate();
        if a.value.abs() - a.bound > threshold * (1.0 + 4.0 * U) {
            return true;
        }
        if (a.value.abs() + a.bound) * (1.0 + 4.0 * U) < threshold {
            return false;
        }
        match Rational::exactly(threshold) {
            Some(threshold) => (self.exact().magnitude() - threshold).cmp_zero() == Ordering::Greater,
            None => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_that_rounds_to_zero_keeps_its_sign() {
        let mut sum = Terms::default();
        [1.0, 1e-40, -1.0].into_iter().for_each(|x| sum.add(x));
        assert_eq!(sum.sign(), Ordering::Greater);
        assert!(sum.exceeds(0.0) && sum.exceeds(9.9e-41) && !sum.exceeds(1e-40));
    }

    #[test]
    fn products_beyond_the_range_of_f64_are_decided_exactly() {
        let mut sum = Terms::default();
        sum.add_product(1e300, 1e300, 1.0);
        sum.add_product(-1e300, 1e300, 1.0);
        assert_eq!(sum.sign(), Ordering::Equal);
        sum.add_product(-1e-300, 1e-300, 1e-300);
        assert_eq!(sum.sign(), Ordering::Less);
        assert!(!sum.exceeds(1e-320));
    }

    #[test]
    fn differences_are_not_rounded() {
        let mut sum = Terms::default();
        sum.add_differences(1.0, [1.0, 1e-30], [1.0, 0.0]);
        sum.add(-1.0);
        assert_eq!(sum.sign(), Ordering::Less);
    }

    #[test]
    fn the_threshold_itself_is_not_exceeded() {
        let mut sum = Terms::default();
        sum.add_product(3.0, 0.25, 2.0);
        assert!(!sum.exceeds(1.5) && sum.exceeds(1.5_f64.next_down()));
    }
}
