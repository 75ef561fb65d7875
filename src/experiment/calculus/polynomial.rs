//! Polynomials in several variables over the rationals.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::ops::{Add, Mul, Neg, Sub};

use super::{drawn, whole};
use crate::generate::Stream;
use crate::scalar::{Rational, Scalar};

/// A polynomial in a fixed number of variables: a coefficient, not zero, for each vector of exponents.
#[derive(Clone, Debug, PartialEq)]
pub struct Polynomial {
    variables: usize,
    terms: BTreeMap<Vec<u32>, Rational>,
}

impl Polynomial {
    /// The polynomial 0.
    pub fn zero(variables: usize) -> Self {
        Polynomial { variables, terms: BTreeMap::new() }
    }

    /// A constant.
    pub fn constant(variables: usize, value: Rational) -> Self {
        Polynomial::zero(variables).plus(vec![0; variables], value)
    }

    /// The k-th variable.
    pub fn variable(variables: usize, k: usize) -> Self {
        let exponents = (0..variables).map(|j| u32::from(j == k)).collect();
        Polynomial::zero(variables).plus(exponents, Rational::ONE)
    }

    /// A single term.
    pub fn monomial(exponents: Vec<u32>, coefficient: Rational) -> Self {
        Polynomial::zero(exponents.len()).plus(exponents, coefficient)
    }

    /// With a term added.
    pub fn plus(mut self, exponents: Vec<u32>, coefficient: Rational) -> Self {
        let sum = self.terms.remove(&exponents).unwrap_or_else(Rational::zero) + coefficient;
        if sum.cmp_zero() != Ordering::Equal {
            self.terms.insert(exponents, sum.reduced());
        }
        self
    }

    /// Random coefficients on every term up to a degree.
    pub fn random(variables: usize, degree: u32, stream: &mut Stream) -> Self {
        exponents(variables, degree).into_iter().fold(Self::zero(variables), |p, e| p.plus(e, drawn(stream)))
    }

    /// The number of variables.
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// Exponents and coefficients.
    pub fn terms(&self) -> impl Iterator<Item = (&[u32], &Rational)> {
        self.terms.iter().map(|(e, c)| (e.as_slice(), c))
    }

    /// Whether it is 0.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// Its terms of one degree.
    pub fn homogeneous(&self, degree: u32) -> Self {
        let terms = self.terms.iter().filter(|(e, _)| e.iter().sum::<u32>() == degree);
        Polynomial { variables: self.variables, terms: terms.map(|(e, c)| (e.clone(), c.clone())).collect() }
    }

    /// The largest degree of a term; `None` for 0.
    pub fn degree(&self) -> Option<u32> {
        self.terms.keys().map(|e| e.iter().sum()).max()
    }

    /// Its constant term.
    pub fn constant_term(&self) -> Rational {
        self.terms.get(&vec![0; self.variables]).cloned().unwrap_or_else(Rational::zero)
    }

    /// A multiple.
    pub fn times(&self, factor: &Rational) -> Self {
        let scaled = self.terms.iter().map(|(e, c)| (e.clone(), c.clone() * factor.clone()));
        scaled.fold(Self::zero(self.variables), |p, (e, c)| p.plus(e, c))
    }

    /// The derivative by the k-th variable.
    pub fn derivative(&self, k: usize) -> Self {
        let terms = self.terms.iter().filter(|(e, _)| e[k] > 0);
        terms.fold(Self::zero(self.variables), |p, (e, c)| {
            let mut lower = e.clone();
            lower[k] -= 1;
            p.plus(lower, c.clone() * whole(i64::from(e[k])))
        })
    }

    /// The derivatives by all variables.
    pub fn gradient(&self) -> Vec<Self> {
        (0..self.variables).map(|k| self.derivative(k)).collect()
    }

    /// `Δp = −Σ ∂²p/∂x_k²`, with the sign that makes it positive semi-definite.
    pub fn laplacian(&self) -> Self {
        -&divergence(&self.gradient())
    }

    /// With a polynomial in the place of each variable.
    ///
    /// # Panics
    /// If these are not as many as the variables, or none.
    pub fn composed(&self, inner: &[Polynomial]) -> Self {
        assert!(inner.len() == self.variables && !inner.is_empty(), "one polynomial for each variable");
        let n = inner[0].variables;
        self.terms.iter().fold(Self::zero(n), |sum, (e, c)| {
            let factors = e.iter().zip(inner).flat_map(|(&e, p)| std::iter::repeat_n(p, e as usize));
            &sum + &factors.fold(Self::constant(n, c.clone()), |product, p| &product * p)
        })
    }

    /// The value at a point.
    pub fn at(&self, point: &[Rational]) -> Rational {
        let terms = self.terms.iter().map(|(e, c)| {
            let powers = e.iter().zip(point).flat_map(|(&e, x)| std::iter::repeat_n(x, e as usize));
            powers.fold(c.clone(), |product, x| product * x.clone())
        });
        crate::scalar::sum(terms).reduced()
    }

    /// `p(x + point)`, its expansion about a point.
    pub fn about(&self, point: &[Rational]) -> Self {
        let n = self.variables;
        let shifted: Vec<Self> = (0..n).map(|k| Self::variable(n, k).plus(vec![0; n], point[k].clone())).collect();
        self.composed(&shifted)
    }
}

/// `Σ ∂X_k/∂x_k` of a vector field.
pub fn divergence(field: &[Polynomial]) -> Polynomial {
    let zero = Polynomial::zero(field.len());
    field.iter().enumerate().fold(zero, |sum, (k, p)| &sum + &p.derivative(k))
}

/// All vectors of exponents up to a total degree.
pub fn exponents(variables: usize, degree: u32) -> Vec<Vec<u32>> {
    let mut all = vec![Vec::new()];
    for _ in 0..variables {
        let longer = |e: Vec<u32>| {
            let left = degree - e.iter().sum::<u32>();
            (0..=left).map(move |next| [e.as_slice(), &[next]].concat())
        };
        all = all.into_iter().flat_map(longer).collect();
    }
    all
}

impl Add for &Polynomial {
    type Output = Polynomial;
    fn add(self, other: &Polynomial) -> Polynomial {
        other.terms.iter().fold(self.clone(), |p, (e, c)| p.plus(e.clone(), c.clone()))
    }
}

impl Neg for &Polynomial {
    type Output = Polynomial;
    fn neg(self) -> Polynomial {
        let terms = self.terms.iter().map(|(e, c)| (e.clone(), -c.clone())).collect();
        Polynomial { variables: self.variables, terms }
    }
}

impl Sub for &Polynomial {
    type Output = Polynomial;
    fn sub(self, other: &Polynomial) -> Polynomial {
        self + &-other
    }
}

/// The exponents of a product of two terms.
fn joined(e: &[u32], f: &[u32]) -> Vec<u32> {
    e.iter().zip(f).map(|(a, b)| a + b).collect()
}

impl Mul for &Polynomial {
    type Output = Polynomial;
    fn mul(self, other: &Polynomial) -> Polynomial {
        let mut product = Polynomial::zero(self.variables);
        for (e, c) in &self.terms {
            for (f, d) in &other.terms {
                product = product.plus(joined(e, f), c.clone() * d.clone());
            }
        }
        product
    }
}

impl std::fmt::Display for Polynomial {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        const NAMES: [&str; 3] = ["x", "y", "z"];
        if self.is_zero() {
            return f.write_str("0");
        }
        for (at, (e, c)) in self.terms.iter().rev().enumerate() {
            let negative = c.cmp_zero() == Ordering::Less;
            let sign = match (at, negative) {
                (0, true) => "−",
                (0, false) => "",
                (_, true) => " − ",
                (_, false) => " + ",
            };
            let powers = e.iter().enumerate().filter(|(_, e)| **e > 0).map(|(k, &e)| {
                let name = NAMES.get(k).map_or_else(|| format!("x{k}"), |n| (*n).to_string());
                if e == 1 { name } else { format!("{name}^{e}") }
            });
            let (powers, size) = (powers.collect::<Vec<_>>().join(" "), c.magnitude().reduced());
            match (size == Rational::ONE, powers.is_empty()) {
                (_, true) => write!(f, "{sign}{size}")?,
                (true, false) => write!(f, "{sign}{powers}")?,
                (false, false) => write!(f, "{sign}{size} {powers}")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::calculus::ratio;

    fn x() -> Polynomial {
        Polynomial::variable(2, 0)
    }

    fn y() -> Polynomial {
        Polynomial::variable(2, 1)
    }

    #[test]
    fn derivatives_follow_the_product_rule_and_commute() {
        let mut stream = Stream::new(3, "polynomial");
        let (p, q) = (Polynomial::random(2, 3, &mut stream), Polynomial::random(2, 4, &mut stream));
        let product = &(&p.derivative(0) * &q) + &(&p * &q.derivative(0));
        assert_eq!((&p * &q).derivative(0), product);
        assert_eq!(q.derivative(0).derivative(1), q.derivative(1).derivative(0));
        assert_ne!((&p * &q).derivative(0), &p.derivative(0) * &q.derivative(0));
    }

    #[test]
    fn the_laplacian_of_the_squared_distance_is_minus_twice_the_dimension() {
        let square = &(&x() * &x()) + &(&y() * &y());
        assert_eq!(square.laplacian(), Polynomial::constant(2, ratio(-4, 1)));
        assert!((&(&x() * &x()) - &(&y() * &y())).laplacian().is_zero());
    }

    #[test]
    fn composition_is_evaluation_at_the_values() {
        let mut stream = Stream::new(4, "polynomial");
        let (p, q) = (Polynomial::random(2, 3, &mut stream), Polynomial::random(2, 2, &mut stream));
        let r = Polynomial::random(2, 2, &mut stream);
        let point = [ratio(2, 3), ratio(-5, 7)];
        assert_eq!(p.composed(&[q.clone(), r.clone()]).at(&point), p.at(&[q.at(&point), r.at(&point)]));
        assert_eq!(p.about(&point).constant_term(), p.at(&point));
    }

    #[test]
    fn a_polynomial_is_written_as_in_a_book() {
        let p = &(&x() * &(&x() * &y())).times(&ratio(-3, 2)) + &(&y() - &Polynomial::constant(2, ratio(1, 3)));
        assert_eq!(p.to_string(), "−3/2 x^2 y + y − 1/3");
        assert_eq!(Polynomial::zero(1).to_string(), "0");
    }

    #[test]
    fn the_exponents_up_to_a_degree_are_as_many_as_the_binomial_coefficient_says() {
        assert_eq!((exponents(2, 4).len(), exponents(3, 3).len()), (15, 20));
    }
}
