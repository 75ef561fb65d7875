//! Exact solution of small linear systems by fraction-free elimination.

use std::cmp::Ordering;

use dashu_int::IBig;

use crate::scalar::{Rational, Scalar};

/// Numerators grow with the number of unknowns; up to here the elimination takes well below a second.
pub(super) const LARGEST: usize = 40;

/// Component `at` of the solution of `A x = b`, A by sparse rows; `None` if A is singular.
///
/// Bareiss (1968): every division is exact, numerators stay as small as the minors that they are. The unknown asked for is
/// eliminated last, so no back substitution is needed.
pub(super) fn component(rows: &[Vec<(usize, Rational)>], b: &[Rational], at: usize) -> Option<Rational> {
    let n = rows.len();
    let column = |j: usize| match j {
        j if j == at => n - 1,
        j if j == n - 1 => at,
        j => j,
    };
    let mut a: Vec<Vec<IBig>> = rows.iter().zip(b).map(|(row, b)| integers(n, row, b, column)).collect();
    let mut previous = IBig::ONE;
    for k in 0..n {
        let pivot = (k..n).find(|&i| a[i][k] != IBig::ZERO)?;
        a.swap(k, pivot);
        let (above, below) = a.split_at_mut(k + 1);
        let row = &above[k];
        for other in below {
            for j in k + 1..=n {
                other[j] = (&row[k] * &other[j] - &other[k] * &row[j]) / &previous;
            }
            other[k] = IBig::ZERO;
        }
        previous = row[k].clone();
    }
    let last = &a[n - 1];
    let quotient = Rational::from(last[n].clone()) / Rational::from(last[n - 1].clone());
    Some(quotient)
}

/// A row of the augmented matrix times a common denominator.
fn integers(n: usize, row: &[(usize, Rational)], b: &Rational, column: impl Fn(usize) -> usize) -> Vec<IBig> {
    let mut common = Rational::from(IBig::ONE);
    for v in row.iter().map(|e| &e.1).chain([b]) {
        let denominator = Rational::from(IBig::from((v.clone() * common.clone()).denominator().clone()));
        common *= denominator;
    }
    let whole = |v: &Rational| {
        let (numerator, denominator) = (v.clone() * common.clone()).into_parts();
        numerator / IBig::from(denominator)
    };
    let mut dense = vec![IBig::ZERO; n + 1];
    row.iter().filter(|e| e.1.cmp_zero() != Ordering::Equal).for_each(|(j, v)| dense[column(*j)] = whole(v));
    dense[n] = whole(b);
    dense
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rational(x: f64) -> Rational {
        Rational::exactly(x).unwrap()
    }

    #[test]
    fn a_system_of_three_unknowns_has_the_solution_it_was_made_from() {
        let a = [[2.0, -0.5, 0.0], [0.25, 3.0, 1e-3], [0.0, -1.0, 7.5]];
        let x = [1.0, -2.0, 0.75];
        let exact_b = |i: usize| (0..3).fold(Rational::zero(), |s, j| s + rational(a[i][j]) * rational(x[j]));
        let rows: Vec<Vec<_>> = a.iter().map(|r| r.iter().map(|v| rational(*v)).enumerate().collect()).collect();
        let b: Vec<_> = (0..3).map(exact_b).collect();
        for (at, expected) in x.iter().enumerate() {
            let found = component(&rows, &b, at).unwrap();
            assert_eq!((found - rational(*expected)).cmp_zero(), Ordering::Equal);
        }
    }

    #[test]
    fn zero_pivots_are_stepped_around_and_singular_matrices_refused() {
        let one = || rational(1.0);
        let swap = vec![vec![(1, one())], vec![(0, one())]];
        assert_eq!(component(&swap, &[rational(3.0), rational(4.0)], 0).unwrap().approximate(), 4.0);
        let singular = vec![vec![(0, one()), (1, one())], vec![(0, one()), (1, one())]];
        assert!(component(&singular, &[one(), one()], 1).is_none());
    }
}
