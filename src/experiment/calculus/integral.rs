//! Exact integrals of polynomials: boxes, simplices, and averages over balls and spheres.
//!
//! * Simplex `t_k ≥ 0, Σ t_k ≤ 1` in n variables: `∫ t^a = Π a_k! / (n + |a|)!`.
//! * Unit sphere in n dimensions: the average of `x^a` is 0 if some `a_k` is odd, else `Π (a_k − 1)!! / (n (n + 2) … (n + |a| − 2))`;
//!   over the ball the average of a term of degree d is that times `n / (n + d)`. Source: Folland 2001.

use super::polynomial::Polynomial;
use super::{ratio, whole};
use crate::scalar::{Rational, Scalar, sum};

impl Polynomial {
    /// The integral over the box with these lower and upper bounds in each variable.
    pub fn over_box(&self, low: &[Rational], high: &[Rational]) -> Rational {
        let power = |x: &Rational, e: u32| (0..e).fold(Rational::ONE, |p, _| p * x.clone());
        let terms = self.terms().map(|(exponents, c)| {
            exponents.iter().enumerate().fold(c.clone(), |product, (k, &e)| {
                product * (power(&high[k], e + 1) - power(&low[k], e + 1)) * ratio(1, e + 1)
            })
        });
        sum(terms).reduced()
    }

    /// The integral over the unit cube.
    pub fn over_unit_cube(&self) -> Rational {
        self.over_box(&vec![Rational::ZERO; self.variables()], &vec![Rational::ONE; self.variables()])
    }

    /// The integral over the simplex `t_k ≥ 0, Σ t_k ≤ 1`.
    pub fn over_simplex(&self) -> Rational {
        let factorial = |n: u32| (1..=n).fold(Rational::ONE, |p, k| p * whole(i64::from(k)));
        let n = self.variables() as u32;
        let terms = self.terms().map(|(exponents, c)| {
            let numerator = exponents.iter().fold(c.clone(), |p, &e| p * factorial(e));
            numerator / factorial(n + exponents.iter().sum::<u32>())
        });
        sum(terms).reduced()
    }

    /// The average over the sphere of this radius about the origin.
    pub fn average_over_sphere(&self, radius: &Rational) -> Rational {
        self.average(radius, |_, _| Rational::ONE)
    }

    /// The average over the ball of this radius about the origin.
    pub fn average_over_ball(&self, radius: &Rational) -> Rational {
        self.average(radius, |n, degree| ratio(i64::from(n), n + degree))
    }

    fn average(&self, radius: &Rational, radial: impl Fn(u32, u32) -> Rational) -> Rational {
        let n = self.variables() as u32;
        let even = self.terms().filter(|(exponents, _)| exponents.iter().all(|e| e % 2 == 0));
        let terms = even.map(|(exponents, c)| {
            let degree: u32 = exponents.iter().sum();
            let odd = |e: u32| (1..e).step_by(2).fold(Rational::ONE, |p, k| p * whole(i64::from(k)));
            let numerator = exponents.iter().fold(c.clone(), |p, &e| p * odd(e));
            let below = (0..degree / 2).fold(Rational::ONE, |p, k| p * whole(i64::from(n + 2 * k)));
            let scale = (0..degree).fold(Rational::ONE, |p, _| p * radius.clone());
            numerator / below * scale * radial(n, degree)
        });
        sum(terms).reduced()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Stream;

    fn term(exponents: &[u32]) -> Polynomial {
        Polynomial::monomial(exponents.to_vec(), Rational::ONE)
    }

    #[test]
    fn integrals_of_the_textbook() {
        assert_eq!(term(&[2, 1]).over_unit_cube(), ratio(1, 6));
        assert_eq!(term(&[1, 1]).over_simplex(), ratio(1, 24));
        // ∫ x² over the disc is π/4 of π; over the ball 4π/15 of 4π/3; x²y² over the sphere 1/15.
        assert_eq!(term(&[2, 0]).average_over_ball(&Rational::ONE), ratio(1, 4));
        assert_eq!(term(&[2, 0, 0]).average_over_ball(&Rational::ONE), ratio(1, 5));
        assert_eq!(term(&[2, 2, 0]).average_over_sphere(&Rational::ONE), ratio(1, 15));
        assert_eq!(term(&[2, 0]).average_over_sphere(&ratio(3, 1)), ratio(9, 2));
        assert_eq!(term(&[1, 2]).average_over_ball(&Rational::ONE), Rational::ZERO);
    }

    #[test]
    fn the_average_over_a_sphere_is_that_of_pizzettis_series() {
        // Σ_k r^(2k) (∂²)^k p(0) / (2^k k! n (n + 2) … (n + 2k − 2)), from derivatives alone.
        let mut stream = Stream::new(1, "pizzetti");
        for n in [2, 3] {
            let (mut p, r) = (Polynomial::random(n, 6, &mut stream), ratio(2, 3));
            let expected = p.average_over_sphere(&r);
            let (mut total, mut factor) = (Rational::ZERO, Rational::ONE);
            for k in 0..=3_i64 {
                total += factor.clone() * p.constant_term();
                p = -&p.laplacian();
                factor = factor * r.clone() * r.clone() / whole(2 * (k + 1) * (n as i64 + 2 * k));
            }
            assert_eq!(total, expected);
        }
    }

    #[test]
    fn the_square_is_two_simplices() {
        // t = (x, y) below the diagonal, (1 − x, 1 − y) above it.
        let p = Polynomial::random(2, 5, &mut Stream::new(2, "square"));
        let one = Polynomial::constant(2, Rational::ONE);
        let mirrored = p.composed(&[&one - &Polynomial::variable(2, 0), &one - &Polynomial::variable(2, 1)]);
        assert_eq!(p.over_simplex() + mirrored.over_simplex(), p.over_unit_cube());
    }
}
