//! Exact solution of small linear systems, without fractions (Bareiss 1968).
//!
//! Every finite `f64` is an integer times a power of two, so a row of `[A | B]` becomes a row of integers by one power of
//! two, which changes no solution. The elimination of Gauss and Jordan in Bareiss's form then stays among integers:
//! every entry is a minor of the matrix, so that the numbers grow with the logarithm of determinants and no faster.

use dashu_int::IBig;

use super::Csr;
use crate::scalar::Rational;

/// What exact elimination found.
#[derive(Clone, Debug, PartialEq)]
pub enum Elimination {
    /// The matrix is regular; the columns of the solution.
    Solution(Vec<Vec<Rational>>),
    /// The matrix is singular; an integer vector of its kernel.
    Kernel(Vec<IBig>),
}

/// Solves `A X = B` exactly for a square matrix and the given columns of B; `None` if an entry is not finite.
///
/// Cost: O(n² (n + columns)) products of integers of about `n` times 60 bits; meant for n up to a few dozen.
pub fn eliminate(a: &Csr, columns: &[Vec<f64>]) -> Option<Elimination> {
    let n = a.rows();
    let mut rows: Vec<Vec<IBig>> = (0..n)
        .map(|i| {
            let mut row = vec![0.0; n];
            a.row(i).for_each(|(j, v)| row[j] = *v);
            row.extend(columns.iter().map(|c| c[i]));
            integers(&row)
        })
        .collect::<Option<_>>()?;
    let width = n + columns.len();
    let mut last = IBig::ONE;
    for k in 0..n {
        let Some(at) = (k..n).find(|&i| !rows[i][k].is_zero()) else {
            let mut kernel: Vec<IBig> = (0..k).map(|i| -rows[i][k].clone()).collect();
            kernel.push(last);
            kernel.resize(n, IBig::ZERO);
            return Some(Elimination::Kernel(kernel));
        };
        rows.swap(k, at);
        let pivot = std::mem::take(&mut rows[k]);
        for (i, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = row[k].clone();
            for j in k + 1..width {
                let mut value = &pivot[k] * &row[j];
                if !factor.is_zero() && !pivot[j].is_zero() {
                    value -= &factor * &pivot[j];
                }
                row[j] = value / &last;
            }
            row[k] = IBig::ZERO;
            if i < k {
                row[i] = pivot[k].clone();
            }
        }
        last = pivot[k].clone();
        rows[k] = pivot;
    }
    let quotient = |i: usize, j: usize| Rational::from(rows[i][n + j].clone()) / Rational::from(last.clone());
    Some(Elimination::Solution((0..columns.len()).map(|j| (0..n).map(|i| quotient(i, j)).collect()).collect()))
}

/// A row multiplied by the power of two that makes every entry an integer; `None` if an entry is not finite.
fn integers(row: &[f64]) -> Option<Vec<IBig>> {
    let parts: Vec<(i64, i32)> = row.iter().map(|&x| parts(x)).collect::<Option<_>>()?;
    let lowest = parts.iter().filter(|(m, _)| *m != 0).map(|(_, e)| *e).min().unwrap_or(0);
    Some(
        parts
            .into_iter()
            .map(|(m, e)| if m == 0 { IBig::ZERO } else { IBig::from(m) << (e - lowest) as usize })
            .collect(),
    )
}

/// `(m, e)` with `x = m 2^e`, m odd or zero.
fn parts(x: f64) -> Option<(i64, i32)> {
    if !x.is_finite() {
        return None;
    }
    let bits = x.to_bits();
    let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i32, (bits & ((1 << 52) - 1)) as i64);
    let (mantissa, exponent) = if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) };
    if mantissa == 0 {
        return Some((0, 0));
    }
    let shift = mantissa.trailing_zeros();
    let odd = mantissa >> shift;
    Some((if x < 0.0 { -odd } else { odd }, exponent + shift as i32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Scalar;

    #[test]
    fn an_integer_system_is_solved_exactly() {
        // [2 1; 1 3] x = [1; 2]: x = (1/5, 3/5).
        let a = Csr::from_triplets(2, 2, &[(0, 0, 2.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, 3.0)]);
        let Some(Elimination::Solution(x)) = eliminate(&a, &[vec![1.0, 2.0]]) else { panic!("regular") };
        let fifth = |k: i64| Rational::from(IBig::from(k)) / Rational::from(IBig::from(5));
        assert_eq!(x, [[fifth(1), fifth(3)]]);
    }

    #[test]
    fn the_residual_of_a_solution_is_exactly_zero_at_extreme_scales() {
        let values = [1e-300, 0.1, -3e200, 7.0, 5e-324, 2.0 / 3.0, -1e-8, 1e8, 0.3];
        let t: Vec<_> = values.iter().enumerate().map(|(k, &v)| (k / 3, k % 3, v)).collect();
        let a = Csr::from_triplets(3, 3, &t);
        let Some(Elimination::Solution(x)) = eliminate(&a, &[vec![0.7, -1e-20, 3.0]]) else { panic!("regular") };
        let product = a.exact().unwrap().mul(&x[0]);
        for (found, expected) in product.into_iter().zip([0.7, -1e-20, 3.0]) {
            assert_eq!((found - Rational::exactly(expected).unwrap()).cmp_zero(), std::cmp::Ordering::Equal);
        }
    }

    #[test]
    fn a_singular_matrix_gives_a_vector_of_its_kernel() {
        let a = Csr::from_triplets(
            3,
            3,
            &[(0, 0, 1.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 2.5), (1, 2, -1.5), (2, 1, -1.5), (2, 2, 1.5)],
        );
        let Some(Elimination::Kernel(x)) = eliminate(&a, &[]) else { panic!("constants are in the kernel") };
        assert!(!x[0].is_zero() && x.iter().all(|v| *v == x[0]), "{x:?}");
        assert_eq!(eliminate(&Csr::diagonal(&[f64::NAN]), &[]), None);
    }

    #[test]
    fn a_zero_in_the_corner_is_pivoted_around() {
        let a = Csr::from_triplets(2, 2, &[(0, 1, 2.0), (1, 0, 4.0)]);
        let Some(Elimination::Solution(x)) = eliminate(&a, &[vec![2.0, 2.0]]) else { panic!("regular") };
        assert_eq!(x[0].iter().map(Scalar::approximate).collect::<Vec<_>>(), [0.5, 1.0]);
    }
}
