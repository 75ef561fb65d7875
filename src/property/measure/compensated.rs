//! Sums and products in twice the working precision (Ogita, Rump and Oishi 2005).
//!
//! A residual that decides a verdict must not owe its size to its own evaluation, and a witness must survive exact
//! arithmetic: with n terms the value is off by at most `u |value| + n² u² Σ |terms|`, u = 2⁻⁵³.

/// A running sum with the error of every addition and product carried along.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sum {
    high: f64,
    low: f64,
}

impl Sum {
    /// Adds `x`.
    pub fn add(&mut self, x: f64) {
        let (sum, error) = two_sum(self.high, x);
        self.high = sum;
        self.low += error;
    }

    /// Adds `a b`.
    pub fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        self.add(product);
        self.low += a.mul_add(b, -product);
    }

    /// Adds `a (x − y)`.
    pub fn add_scaled_difference(&mut self, a: f64, x: f64, y: f64) {
        let (difference, error) = two_sum(x, -y);
        self.add_product(a, difference);
        self.add_product(a, error);
    }

    /// Adds `a b c`.
    pub fn add_triple(&mut self, a: f64, b: f64, c: f64) {
        let product = b * c;
        self.add_product(a, product);
        self.add_product(a, b.mul_add(c, -product));
    }

    /// The sum, rounded once.
    pub fn value(self) -> f64 {
        self.high + self.low
    }
}

impl FromIterator<f64> for Sum {
    fn from_iter<T: IntoIterator<Item = f64>>(terms: T) -> Self {
        let mut sum = Sum::default();
        terms.into_iter().for_each(|x| sum.add(x));
        sum
    }
}

/// The rounded sum and its error: `a + b = sum + error` exactly, short of overflow (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let rest = sum - a;
    (sum, (a - (sum - rest)) + (b - rest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::{Rational, Scalar};

    #[test]
    fn a_sum_that_cancels_sixteen_digits_is_still_right() {
        assert_eq!([1e16, 1.0, -1e16].into_iter().collect::<Sum>().value(), 1.0);
        assert_eq!([1.0, 1e100, 1.0, -1e100].into_iter().collect::<Sum>().value(), 2.0);
    }

    #[test]
    fn products_and_differences_agree_with_the_rationals() {
        let exact = |x: f64| Rational::exactly(x).unwrap();
        let (a, x, y) = (0.1, 1e8 + 0.3, 1e8 - 0.7);
        let mut sum = Sum::default();
        sum.add_scaled_difference(a, x, y);
        sum.add_triple(a, x, -y);
        sum.add_triple(a, y, x);
        let expected = exact(a) * (exact(x) - exact(y));
        assert!((sum.value() - expected.approximate()).abs() <= f64::EPSILON * expected.approximate());
    }
}
