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
    #[inline(always)]
    pub fn add(&mut self, x: f64) {
        let (sum, error) = two_sum(self.high, x);
        self.high = sum;
        self.low += error;
    }

    /// Adds `a b`.
    #[inline(always)]
    pub fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        self.add(product);
        self.low += lost(a, b, product);
    }

    /// Adds `a (x − y)`.
    #[inline(always)]
    pub fn add_scaled_difference(&mut self, a: f64, x: f64, y: f64) {
        let (difference, error) = two_sum(x, -y);
        self.add_product(a, difference);
        self.low += a * error;
    }

    /// Adds `a b c`.
    #[inline(always)]
    pub fn add_triple(&mut self, a: f64, b: f64, c: f64) {
        let product = b * c;
        self.add_product(a, product);
        self.low += a * lost(b, c, product);
    }

    /// Adds `a` times what another sum has come to.
    #[inline(always)]
    pub fn add_multiple(&mut self, a: f64, other: Sum) {
        self.add_product(a, other.high);
        self.low += a * other.low;
    }

    /// Adds what another sum has come to.
    pub fn add_sum(&mut self, other: Sum) {
        self.add(other.high);
        self.low += other.low;
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

/// What the rounding of a product lost, `a b − product`, by halves whose products are exact (Dekker): where the machine has no fused
/// multiply-add at hand, which a portable binary cannot count on, that is a call.
#[inline(always)]
fn lost(a: f64, b: f64, product: f64) -> f64 {
    let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
    let rest = a2 * b2 - (((product - a1 * b1) - a2 * b1) - a1 * b2);
    // Near the end of the range the halves themselves overflow.
    if rest.is_finite() { rest } else { a.mul_add(b, -product) }
}

/// The upper 26 bits and the lower 27, of which the sign takes one (Veltkamp).
#[inline(always)]
fn halves(a: f64) -> (f64, f64) {
    const FACTOR: f64 = ((1_u64 << 27) + 1) as f64;
    let c = FACTOR * a;
    let high = c - (c - a);
    (high, a - high)
}

/// The rounded sum and its error: `a + b = sum + error` exactly, short of overflow (Knuth).
#[inline(always)]
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
    fn what_a_product_loses_is_what_the_fused_operation_says() {
        let mut x = 1.0_f64;
        for k in 0..400 {
            x = (x * 1.618_033_988_749).rem_euclid(2.0) + f64::from(k) * 1e-9;
            let (a, b) = (x * 2f64.powi(k - 200), (3.0 - x) * 2f64.powi(100 - k));
            assert_eq!(lost(a, b, a * b), a.mul_add(b, -(a * b)), "{a:e} {b:e}");
            let large = x * 8e307;
            assert_eq!(lost(large, 1e-3, large * 1e-3), large.mul_add(1e-3, -(large * 1e-3)), "{large:e}");
        }
        let halves = (1..4).map(f64::from).collect::<Sum>();
        let mut both = Sum::default();
        both.add(1e16);
        both.add_sum(halves);
        both.add(-1e16);
        assert_eq!(both.value(), 6.0);
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
