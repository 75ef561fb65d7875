//! Characteristic polynomials of rational matrices and their real roots, exactly.

use std::cmp::Ordering;

use super::whole;
use crate::linalg::Dense;
use crate::scalar::{Rational, Scalar};

/// Coefficients in one variable, the constant first, the last one not zero; empty for 0.
type Coefficients = Vec<Rational>;

fn trimmed(mut p: Coefficients) -> Coefficients {
    while p.last().is_some_and(|c| c.cmp_zero() == Ordering::Equal) {
        p.pop();
    }
    p
}

/// The characteristic polynomial `det(t − A)`, coefficients ascending, by the recursion of Faddeev and Le Verrier:
/// `M_1 = A`, `c_{n−k} = −tr(M_k)/k`, `M_{k+1} = A (M_k + c_{n−k})`.
pub fn characteristic(a: &Dense<Rational>) -> Coefficients {
    let n = a.rows();
    let mut coefficients = vec![Rational::ZERO; n + 1];
    coefficients[n] = Rational::ONE;
    let mut m = a.clone();
    for k in 1..=n {
        let trace = crate::scalar::sum((0..n).map(|i| m.at(i, i).clone()));
        let c = (-trace / whole(k as i64)).reduced();
        coefficients[n - k] = c.clone();
        (0..n).for_each(|i| m.add_to(i, i, c.clone()));
        m = a.product(&m);
    }
    coefficients
}

fn derivative(p: &[Rational]) -> Coefficients {
    p.iter().enumerate().skip(1).map(|(k, c)| (c.clone() * whole(k as i64)).reduced()).collect()
}

/// Quotient and remainder.
fn divided(p: &[Rational], q: &[Rational]) -> (Coefficients, Coefficients) {
    let (mut rest, mut quotient) = (p.to_vec(), vec![Rational::ZERO; (p.len() + 1).saturating_sub(q.len())]);
    let Some(lead) = q.last() else { return (quotient, rest) };
    while rest.len() >= q.len() {
        let (shift, factor) = (rest.len() - q.len(), rest[rest.len() - 1].clone() / lead.clone());
        for (k, c) in q.iter().enumerate() {
            rest[shift + k] = (rest[shift + k].clone() - factor.clone() * c.clone()).reduced();
        }
        quotient[shift] = factor.reduced();
        rest.pop();
        rest = trimmed(rest);
    }
    (quotient, rest)
}

/// The polynomial with the same roots, each once: `p / gcd(p, p′)`.
fn squarefree(p: &[Rational]) -> Coefficients {
    let (mut a, mut b) = (p.to_vec(), derivative(p));
    while !b.is_empty() {
        let rest = divided(&a, &b).1;
        (a, b) = (b, rest);
    }
    divided(p, &a).0
}

/// The number of distinct real roots in `(low, high]`, by Sturm's theorem.
pub fn roots_in(p: &[Rational], low: &Rational, high: &Rational) -> usize {
    let mut chain = vec![squarefree(p)];
    chain.push(derivative(&chain[0]));
    while chain.last().is_some_and(|p| !p.is_empty()) {
        let (before, last) = (&chain[chain.len() - 2], &chain[chain.len() - 1]);
        chain.push(divided(before, last).1.into_iter().map(|c| -c).collect());
    }
    let changes = |t: &Rational| {
        let value =
            |p: &Coefficients| p.iter().rev().fold(Rational::ZERO, |v, c| (v * t.clone() + c.clone()).reduced());
        let signs = chain.iter().map(|p| value(p).cmp_zero()).filter(|s| *s != Ordering::Equal).collect::<Vec<_>>();
        signs.windows(2).filter(|w| w[0] != w[1]).count()
    };
    changes(low).saturating_sub(changes(high))
}

/// Whether A has a basis of eigenvectors over the complex numbers: the squarefree part s of its characteristic polynomial
/// has `s(A) = 0`. With it the degree of s, the number of distinct eigenvalues.
pub fn diagonalises(a: &Dense<Rational>) -> (bool, usize) {
    let (n, s) = (a.rows(), squarefree(&characteristic(a)));
    let mut value = Dense::from_fn(n, n, |_, _| Rational::ZERO);
    for c in s.iter().rev() {
        value = a.product(&value);
        (0..n).for_each(|i| value.add_to(i, i, c.clone()));
    }
    let vanishes = (0..n * n).all(|k| value.at(k / n, k % n).cmp_zero() == Ordering::Equal);
    (vanishes, s.len().saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix<const N: usize>(rows: [[i64; N]; N]) -> Dense<Rational> {
        Dense::from_fn(N, N, |i, j| whole(rows[i][j]))
    }

    #[test]
    fn the_laplacian_of_the_path_of_three_has_the_eigenvalues_0_1_3() {
        let path = matrix([[1, -1, 0], [-1, 2, -1], [0, -1, 1]]);
        // t (t − 1) (t − 3) = t³ − 4t² + 3t.
        let p = characteristic(&path);
        assert_eq!(p, [0, 3, -4, 1].map(whole));
        let count = |low, high| roots_in(&p, &whole(low), &whole(high));
        assert_eq!([count(-1, 0), count(0, 1), count(1, 2), count(1, 3), count(-9, 9)], [1, 1, 0, 1, 3]);
        assert_eq!(diagonalises(&path), (true, 3));
    }

    #[test]
    fn a_jordan_block_does_not_diagonalise_and_a_rotation_has_no_real_root() {
        assert_eq!(diagonalises(&matrix([[2, 1], [0, 2]])), (false, 1));
        let turn = matrix([[0, -1], [1, 0]]);
        assert_eq!(diagonalises(&turn), (true, 2));
        assert_eq!(roots_in(&characteristic(&turn), &whole(-5), &whole(5)), 0);
        assert_eq!(diagonalises(&matrix([[1, 0], [0, 1]])), (true, 1));
    }
}
