//! Differential forms with polynomial coefficients.

use std::collections::BTreeMap;

use super::polynomial::{Polynomial, exponents};
use super::{drawn, whole};
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::property::evidence::{Fraction, Term};
use crate::scalar::{Rational, Scalar};

/// A form of one degree: a polynomial for each set of differentials, a bit mask.
#[derive(Clone, Debug, PartialEq)]
pub struct Form {
    dimension: usize,
    degree: usize,
    parts: BTreeMap<u32, Polynomial>,
}

/// The sets of `degree` differentials out of `dimension`, ascending as numbers.
pub fn masks(dimension: usize, degree: usize) -> Vec<u32> {
    (0..1_u32 << dimension).filter(|mask| mask.count_ones() as usize == degree).collect()
}

/// The sign of `dx_k ∧ dx_I` against the differentials in ascending order; `None` if k is in I.
pub fn wedge_sign(k: usize, mask: u32) -> Option<i64> {
    let before = (mask & ((1 << k) - 1)).count_ones();
    (mask >> k & 1 == 0).then_some(if before.is_multiple_of(2) { 1 } else { -1 })
}

impl Form {
    /// The form with these coefficients of sets of differentials.
    pub fn new(dimension: usize, degree: usize, parts: impl IntoIterator<Item = (u32, Polynomial)>) -> Self {
        Form { dimension, degree, parts: parts.into_iter().collect() }
    }

    /// Random coefficients up to a degree of polynomials.
    pub fn random(dimension: usize, degree: usize, polynomials: u32, stream: &mut Stream) -> Self {
        let parts = masks(dimension, degree).into_iter();
        let parts = parts.map(|m| (m, Polynomial::random(dimension, polynomials, stream))).collect();
        Form { dimension, degree, parts }
    }

    /// Every form `x^a dx_I` up to a degree of polynomials: the forms that linear statements are to be tested on.
    pub fn basis(dimension: usize, degree: usize, polynomials: u32) -> Vec<Self> {
        let masks = masks(dimension, degree);
        let term = |mask: u32, e: Vec<u32>| {
            let parts = BTreeMap::from([(mask, Polynomial::monomial(e, Rational::ONE))]);
            Form { dimension, degree, parts }
        };
        let each = |mask: u32| exponents(dimension, polynomials).into_iter().map(move |e| term(mask, e));
        masks.into_iter().flat_map(each).collect()
    }

    /// The coefficient of a set of differentials.
    pub fn part(&self, mask: u32) -> Polynomial {
        self.parts.get(&mask).cloned().unwrap_or_else(|| Polynomial::zero(self.dimension))
    }

    /// Its terms as evidence writes them down.
    pub fn terms(&self) -> Vec<Term> {
        let of = |(&mask, p): (&u32, &Polynomial)| -> Vec<Term> {
            let differentials: Vec<usize> = (0..self.dimension).filter(|k| mask >> k & 1 == 1).collect();
            let term = |(e, c): (&[u32], &Rational)| Term {
                coefficient: Fraction::from(c),
                exponents: e.to_vec(),
                differentials: differentials.clone(),
            };
            p.terms().map(term).collect()
        };
        self.parts.iter().flat_map(of).collect()
    }

    /// Whether every coefficient is 0.
    pub fn is_zero(&self) -> bool {
        self.parts.values().all(Polynomial::is_zero)
    }

    /// The number of variables.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The sum of two forms of one degree.
    pub fn plus(&self, other: &Self) -> Self {
        let sum = |mask: u32| (mask, &self.part(mask) + &other.part(mask));
        Form::new(self.dimension, self.degree, masks(self.dimension, self.degree).into_iter().map(sum))
    }

    /// The number of differentials in each term.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The exterior derivative `d(p dx_I) = Σ_k ∂p/∂x_k dx_k ∧ dx_I`.
    pub fn d(&self) -> Self {
        let mut result = Form { dimension: self.dimension, degree: self.degree + 1, parts: BTreeMap::new() };
        for (&mask, p) in &self.parts {
            for k in 0..self.dimension {
                let Some(sign) = wedge_sign(k, mask) else { continue };
                let sum = &result.part(mask | 1 << k) + &p.derivative(k).times(&whole(sign));
                result.parts.insert(mask | 1 << k, sum);
            }
        }
        result
    }

    /// The integral over the simplex with these corners, one more than the degree, oriented by their order.
    ///
    /// Pulled back by `x = c_0 + Σ t_k (c_k − c_0)`, `dx_I` becomes the minor of the columns `c_k − c_0` in the rows I.
    pub fn over(&self, corners: &[Vec<Rational>]) -> Rational {
        let k = self.degree;
        if k == 0 {
            return self.part(0).at(&corners[0]);
        }
        let step = |axis: usize, side: usize| corners[side + 1][axis].clone() - corners[0][axis].clone();
        let place: Vec<Polynomial> = (0..self.dimension)
            .map(|axis| {
                let start = Polynomial::constant(k, corners[0][axis].clone());
                (0..k).fold(start, |sum, side| &sum + &Polynomial::variable(k, side).times(&step(axis, side)))
            })
            .collect();
        let terms = self.parts.iter().map(|(&mask, p)| {
            let axes: Vec<usize> = (0..self.dimension).filter(|a| mask >> a & 1 == 1).collect();
            let minor = Dense::from_fn(k, k, |row, side| step(axes[row], side));
            p.composed(&place).over_simplex() * determinant(&minor)
        });
        crate::scalar::sum(terms).reduced()
    }
}

impl std::fmt::Display for Form {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = |mask: u32| {
            let axes = (0..self.dimension).filter(|a| mask >> a & 1 == 1);
            axes.map(|a| ["dx", "dy", "dz"].get(a).map_or_else(|| format!("dx{a}"), |n| (*n).to_string()))
                .collect::<Vec<_>>()
                .join("∧")
        };
        let terms = self.parts.iter().filter(|(_, p)| !p.is_zero()).map(|(&mask, p)| match mask {
            0 => p.to_string(),
            _ => format!("({p}) {}", name(mask)),
        });
        let terms: Vec<String> = terms.collect();
        f.write_str(&if terms.is_empty() { "0".to_string() } else { terms.join(" + ") })
    }
}

/// The determinant of a small matrix, expanded along its first row.
pub fn determinant(a: &Dense<Rational>) -> Rational {
    let n = a.rows();
    if n == 0 {
        return Rational::ONE;
    }
    let rest: Vec<usize> = (1..n).collect();
    let terms = (0..n).map(|j| {
        let columns: Vec<usize> = (0..n).filter(|&c| c != j).collect();
        let minor = a.at(0, j).clone() * determinant(&a.submatrix(&rest, &columns));
        if j % 2 == 0 { minor } else { -minor }
    });
    crate::scalar::sum(terms).reduced()
}

/// A random simplex with rational corners: `degree + 1` points.
pub fn random_simplex(dimension: usize, degree: usize, stream: &mut Stream) -> Vec<Vec<Rational>> {
    (0..=degree).map(|_| (0..dimension).map(|_| drawn(stream)).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_derivative_of_x_dy_is_the_area() {
        let x_dy = Form::basis(2, 1, 1).into_iter().find(|f| f.part(2) == Polynomial::variable(2, 0)).unwrap();
        let corner = |x: i64, y: i64| vec![whole(x), whole(y)];
        assert_eq!(x_dy.d().part(3), Polynomial::constant(2, Rational::ONE));
        assert_eq!(x_dy.d().over(&[corner(0, 0), corner(3, 0), corner(0, 2)]), whole(3));
        assert_eq!(x_dy.d().over(&[corner(0, 0), corner(0, 2), corner(3, 0)]), whole(-3));
        // Along the edge from (3, 0) to (0, 2): ∫ x dy = 3.
        assert_eq!(x_dy.over(&[corner(3, 0), corner(0, 2)]), whole(3));
    }

    #[test]
    fn a_permutation_has_its_sign_as_determinant() {
        let turn = Dense::from_fn(3, 3, |i, j| whole(i64::from((i + 1) % 3 == j)));
        let swap = Dense::from_fn(3, 3, |i, j| whole(i64::from([1, 0, 2][i] == j)));
        assert_eq!((determinant(&turn), determinant(&swap)), (whole(1), whole(-1)));
    }
}
