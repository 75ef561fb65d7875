//! Small pencils `L u = λ M u` over the rationals, exactly: polynomials and counts of eigenvalues.
//!
//! L is symmetric, M symmetric and positive definite. By Sylvester's law `L − tM` has as many negative eigenvalues as the pencil has
//! below t, and a kernel of the dimension of the eigenspace at t.

use std::cmp::Ordering;

use super::factor::Inertia;
use super::polynomial::{Polynomial, Sturm};
use super::{Csr, Dense};
use crate::scalar::{Rational, Scalar};

/// A pencil of two symmetric matrices, the second one positive definite.
#[derive(Clone, Debug, PartialEq)]
pub struct Pencil {
    stiffness: Dense<Rational>,
    mass: Dense<Rational>,
}

impl Pencil {
    /// The pencil; `None` unless both are symmetric, of the same size, and the mass positive definite.
    pub fn new(stiffness: Dense<Rational>, mass: Dense<Rational>) -> Option<Self> {
        let n = stiffness.rows();
        let fits = [stiffness.columns(), mass.rows(), mass.columns()] == [n; 3];
        let symmetric = fits && stiffness.asymmetry().is_none() && mass.asymmetry().is_none();
        (symmetric && mass.eliminate().is_definite()).then_some(Pencil { stiffness, mass })
    }

    /// The pencil of the rows and columns named: with the interior vertices, the one of the Dirichlet problem.
    pub fn of(stiffness: &Csr<Rational>, mass: &Csr<Rational>, kept: &[usize]) -> Option<Self> {
        let dense = |a: &Csr<Rational>| Dense::from_csr(a).submatrix(kept, kept);
        Pencil::new(dense(stiffness), dense(mass))
    }

    /// The number of rows.
    pub fn size(&self) -> usize {
        self.stiffness.rows()
    }

    /// The stiffness matrix.
    pub fn stiffness(&self) -> &Dense<Rational> {
        &self.stiffness
    }

    /// The mass matrix.
    pub fn mass(&self) -> &Dense<Rational> {
        &self.mass
    }

    /// `det(xI − M⁻¹L)`: monic, with the eigenvalues as roots.
    pub fn characteristic(&self) -> Option<Polynomial<Rational>> {
        Some(Polynomial::characteristic(&self.mass.solve(&self.stiffness)?))
    }

    /// `L − tM`.
    pub fn shifted(&self, t: &Rational) -> Dense<Rational> {
        let n = self.size();
        Dense::from_fn(n, n, |i, j| {
            (self.stiffness.at(i, j).clone() - t.clone() * self.mass.at(i, j).clone()).reduced()
        })
    }

    /// The eigenvalues below, at and above t, counted as the signs of an elimination of `L − tM`.
    pub fn inertia(&self, t: &Rational) -> Inertia {
        self.shifted(t).eliminate().inertia()
    }
}

/// Whether, of two polynomials of one degree all of whose roots are real, the i-th root of the first is at most that of the second, for
/// every i; otherwise a number that separates two which are the other way round.
///
/// All distinct roots of both are isolated by Sturm's theorem, and between neighbours the roots of each are counted by Descartes'
/// rule: the order is right exactly where the second has nowhere more of them below.
pub fn out_of_order(first: &Polynomial<Rational>, second: &Polynomial<Rational>) -> Option<Rational> {
    let cuts = Sturm::new(&first.times(second)).separators();
    cuts.into_iter().find(|t| second.real_roots(t).below > first.real_roots(t).below)
}

/// The fraction with the smallest denominator, at most `largest`, that a condition admits near a number.
pub fn simplest(near: &Rational, largest: u32, admits: impl Fn(&Rational) -> bool) -> Option<Rational> {
    (1..=largest).find_map(|q| {
        let down = (near.clone() * Rational::from(q)).floor();
        let fraction = |p: Rational| (p / Rational::from(q)).reduced();
        let candidates = [fraction(Rational::from(down.clone())), fraction(Rational::from(down) + Rational::ONE)];
        candidates.into_iter().find(|t| t.cmp_zero() == Ordering::Greater && admits(t))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix<const N: usize>(entries: [[f64; N]; N]) -> Dense<Rational> {
        Dense::from_fn(N, N, |i, j| Rational::exactly(entries[i][j]).unwrap())
    }

    fn ratio(p: i32, q: i32) -> Rational {
        Rational::from(p) / Rational::from(q)
    }

    #[test]
    fn a_pencil_of_two_rows_has_the_roots_of_its_quadratic() {
        // det [2 − 2x, −1 − x; −1 − x, 2 − 2x] = 4(1 − x)² − (1 + x)² = 3x² − 10x + 3: ⅓ and 3.
        let pencil = Pencil::new(matrix([[2.0, -1.0], [-1.0, 2.0]]), matrix([[2.0, 1.0], [1.0, 2.0]])).unwrap();
        let polynomial = pencil.characteristic().unwrap();
        assert_eq!(polynomial.coefficients(), [Rational::ONE, ratio(-10, 3), Rational::ONE]);
        for (t, expected) in [(ratio(1, 4), [0, 0, 2]), (ratio(1, 3), [0, 1, 1]), (ratio(2, 1), [1, 0, 1])] {
            let (roots, inertia) = (polynomial.real_roots(&t), pencil.inertia(&t));
            assert_eq!([roots.below, roots.at, roots.above], expected);
            assert_eq!([inertia.negative, inertia.zero, inertia.positive], expected);
        }
    }

    #[test]
    fn a_mass_that_is_not_positive_definite_and_a_lopsided_matrix_make_no_pencil() {
        let unit = matrix([[1.0, 0.0], [0.0, 1.0]]);
        assert!(Pencil::new(unit.clone(), matrix([[1.0, 0.0], [0.0, 0.0]])).is_none());
        assert!(Pencil::new(matrix([[1.0, 2.0], [0.0, 1.0]]), unit.clone()).is_none());
        assert!(Pencil::new(unit, matrix([[1.0]])).is_none());
    }

    #[test]
    fn roots_out_of_order_are_separated_by_a_number() {
        let of = |values: [f64; 3]| {
            Polynomial::characteristic(&Dense::from_fn(3, 3, |i, j| {
                Rational::exactly(if i == j { values[i] } else { 0.0 }).unwrap()
            }))
        };
        assert_eq!(out_of_order(&of([0.0, 1.0, 2.0]), &of([0.0, 1.0, 2.5])), None);
        assert_eq!(out_of_order(&of([0.0, 1.0, 2.0]), &of([0.0, 1.0, 2.0])), None);
        let t = out_of_order(&of([0.0, 1.0, 2.0]), &of([0.0, 0.875, 3.0])).unwrap().approximate();
        assert!(t > 0.875 && t < 1.0);
        let between = |t: &Rational| (0.61..0.65).contains(&t.approximate());
        assert_eq!(simplest(&ratio(61, 100), 64, between), Some(ratio(5, 8)));
        assert_eq!(simplest(&ratio(61, 100), 7, between), None);
    }
}
