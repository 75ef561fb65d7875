//! Small dense matrices over any [`Scalar`], for proofs over the rationals: symmetric elimination with its inertia, rank,
//! kernel, solution and inverse.
//!
//! # Limitations
//! O(n³) operations on numbers that grow with n: meant for at most some sixty rows. Over `f64` a pivot counts as zero only
//! if it is exactly zero, so nothing decided here is proved there; use [`factor`](super::factor) instead.

use std::cmp::Ordering;

use super::Csr;
use super::factor::Inertia;
use crate::scalar::Scalar;

/// A dense matrix, stored row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Dense<S> {
    rows: usize,
    columns: usize,
    entries: Vec<S>,
}

impl<S: Scalar> Dense<S> {
    /// The matrix with the entry `f(i, j)` at `(i, j)`.
    pub fn from_fn(rows: usize, columns: usize, f: impl Fn(usize, usize) -> S) -> Self {
        let entries = (0..rows * columns).map(|k| f(k / columns, k % columns)).collect();
        Dense { rows, columns, entries }
    }

    /// The dense form of a sparse matrix.
    pub fn from_csr(a: &Csr<S>) -> Self {
        Dense::from_fn(a.rows(), a.columns(), |i, j| a.at(i, j))
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The entry at `(i, j)`.
    pub fn at(&self, i: usize, j: usize) -> &S {
        &self.entries[i * self.columns + j]
    }

    fn put(&mut self, i: usize, j: usize, value: S) {
        self.entries[i * self.columns + j] = value;
    }

    /// Adds to the entry at `(i, j)`.
    pub fn add_to(&mut self, i: usize, j: usize, value: S) {
        let sum = self.at(i, j).clone() + value;
        self.put(i, j, sum.reduced());
    }

    /// The transpose.
    pub fn transpose(&self) -> Self {
        Dense::from_fn(self.columns, self.rows, |i, j| self.at(j, i).clone())
    }

    /// Rows and columns renumbered in the order given.
    pub fn submatrix(&self, rows: &[usize], columns: &[usize]) -> Self {
        Dense::from_fn(rows.len(), columns.len(), |i, j| self.at(rows[i], columns[j]).clone())
    }

    /// The product `A B`.
    pub fn product(&self, other: &Self) -> Self {
        let term = |i, j, k| self.at(i, k).clone() * other.at(k, j).clone();
        Dense::from_fn(self.rows, other.columns, |i, j| {
            (0..self.columns).fold(S::zero(), |sum, k| sum + term(i, j, k)).reduced()
        })
    }

    /// The product `A x`.
    pub fn mul(&self, x: &[S]) -> Vec<S> {
        let row = |i| (0..self.columns).fold(S::zero(), |sum, j| sum + self.at(i, j).clone() * x[j].clone());
        (0..self.rows).map(|i| row(i).reduced()).collect()
    }

    /// The quadratic form `xᵀ A x`.
    pub fn quadratic_form(&self, x: &[S]) -> S {
        self.mul(x).into_iter().zip(x).fold(S::zero(), |sum, (y, x)| sum + y * x.clone()).reduced()
    }

    /// The first pair `i < j` with `A_ij ≠ A_ji`; `None` if the matrix is symmetric.
    pub fn asymmetry(&self) -> Option<[usize; 2]> {
        let pairs = (0..self.rows).flat_map(|i| (i + 1..self.rows).map(move |j| [i, j]));
        pairs.into_iter().find(|&[i, j]| self.at(i, j) != self.at(j, i))
    }

    /// The reduced row echelon form (Gauss and Jordan) and the columns of its pivots, ascending, among the first
    /// `among` columns.
    fn echelon(&self, among: usize) -> (Self, Vec<usize>) {
        let mut a = self.clone();
        let mut pivots = Vec::new();
        for column in 0..among {
            let top = pivots.len();
            let Some(source) = (top..a.rows).find(|&i| nonzero(a.at(i, column))) else { continue };
            for j in 0..a.columns {
                a.entries.swap(top * a.columns + j, source * a.columns + j);
            }
            let pivot = a.at(top, column).clone();
            for j in column..a.columns {
                let quotient = a.at(top, j).clone() / pivot.clone();
                a.put(top, j, quotient.reduced());
            }
            for i in (0..a.rows).filter(|&i| i != top) {
                let factor = a.at(i, column).clone();
                if nonzero(&factor) {
                    for j in column..a.columns {
                        if nonzero(a.at(top, j)) {
                            a.add_to(i, j, -(factor.clone() * a.at(top, j).clone()));
                        }
                    }
                }
            }
            pivots.push(column);
        }
        (a, pivots)
    }

    /// The rank.
    pub fn rank(&self) -> usize {
        self.echelon(self.columns).1.len()
    }

    /// A basis of the kernel: one vector for each column without a pivot, with the component 1 there.
    pub fn kernel(&self) -> Vec<Vec<S>> {
        let (a, pivots) = self.echelon(self.columns);
        let free = (0..self.columns).filter(|j| !pivots.contains(j));
        free.map(|j| {
            let mut x = vec![S::zero(); self.columns];
            x[j] = one();
            pivots.iter().enumerate().for_each(|(row, &p)| x[p] = -a.at(row, j).clone());
            x
        })
        .collect()
    }

    /// The solution of `A X = B` of a square matrix; `None` if it is singular.
    pub fn solve(&self, b: &Self) -> Option<Self> {
        let n = self.rows;
        let beside = |i: usize, j: usize| if j < n { self.at(i, j).clone() } else { b.at(i, j - n).clone() };
        let (a, pivots) = Dense::from_fn(n, n + b.columns, beside).echelon(n);
        (pivots.len() == n).then(|| Dense::from_fn(n, b.columns, |i, j| a.at(i, n + j).clone()))
    }

    /// The inverse; `None` if the matrix is singular.
    pub fn inverse(&self) -> Option<Self> {
        self.solve(&Dense::from_fn(self.rows, self.rows, |i, j| if i == j { one() } else { S::zero() }))
    }

    /// Eliminates a symmetric matrix. Of another one (see [`Dense::asymmetry`]) the result means nothing.
    pub fn eliminate(&self) -> Elimination<S> {
        Elimination::of(self)
    }
}

fn one<S: Scalar>() -> S {
    S::half() + S::half()
}

fn nonzero<S: Scalar>(x: &S) -> bool {
    x.cmp_zero() != Ordering::Equal
}

/// A symmetric elimination `A = L D Lᵀ` up to the order of the rows, where D has blocks of one row, and blocks
/// `[0 b; b 0]` of two rows where every remaining diagonal entry is zero (Lagrange's reduction of a quadratic form).
///
/// # Guarantees
/// Over an exact field the signs of D are the inertia of A (Sylvester), whatever the matrix.
pub struct Elimination<S> {
    size: usize,
    steps: Vec<Step<S>>,
    zero: Vec<usize>,
}

/// The block of D, and for each row of it the multiples that were subtracted from the rows left over.
struct Step<S> {
    block: Block<S>,
    multiples: Vec<(usize, Vec<(usize, S)>)>,
}

enum Block<S> {
    One(usize, S),
    Two(usize, usize, S),
}

impl<S: Scalar> Elimination<S> {
    fn of(matrix: &Dense<S>) -> Self {
        let mut a = matrix.clone();
        let mut left: Vec<usize> = (0..a.rows).collect();
        let mut steps = Vec::new();
        while let Some(block) = next_block(&a, &left) {
            // `(pivot row, row that multiplies it, divisor)`: for a block of two, each row is cleared by the other.
            let clearing = match &block {
                Block::One(p, d) => vec![(*p, *p, d.clone())],
                Block::Two(p, q, b) => vec![(*p, *q, b.clone()), (*q, *p, b.clone())],
            };
            left.retain(|i| clearing.iter().all(|(p, _, _)| p != i));
            let multiple = |i: usize, by: usize, d: &S| (a.at(i, by).clone() / d.clone()).reduced();
            let multiples: Vec<(usize, Vec<(usize, S)>)> = clearing
                .iter()
                .map(|(p, by, d)| {
                    let touched = left.iter().filter(|&&i| nonzero(a.at(i, *by)));
                    (*p, touched.map(|&i| (i, multiple(i, *by, d))).collect())
                })
                .collect();
            for (p, factors) in &multiples {
                for (i, factor) in factors {
                    for &j in &left {
                        let term = factor.clone() * a.at(*p, j).clone();
                        if nonzero(&term) {
                            a.add_to(*i, j, -term);
                        }
                    }
                }
            }
            steps.push(Step { block, multiples });
        }
        Elimination { size: a.rows, steps, zero: left }
    }

    /// The numbers of negative, zero and positive eigenvalues.
    pub fn inertia(&self) -> Inertia {
        let mut count = Inertia { negative: 0, zero: self.zero.len(), positive: 0 };
        for step in &self.steps {
            match &step.block {
                Block::One(_, d) if d.cmp_zero() == Ordering::Less => count.negative += 1,
                Block::One(..) => count.positive += 1,
                Block::Two(..) => {
                    count.negative += 1;
                    count.positive += 1;
                }
            }
        }
        count
    }

    /// Whether no eigenvalue is negative.
    pub fn is_semidefinite(&self) -> bool {
        self.inertia().negative == 0
    }

    /// Whether every eigenvalue is positive.
    pub fn is_definite(&self) -> bool {
        self.inertia().positive == self.size
    }

    /// A vector x with `xᵀ A x < 0`; `None` if there is none.
    pub fn negative_direction(&self) -> Option<Vec<S>> {
        self.steps.iter().find_map(|step| match &step.block {
            Block::One(p, d) if d.cmp_zero() == Ordering::Less => Some(self.lift(&[(*p, one())])),
            Block::One(..) => None,
            Block::Two(p, q, b) => {
                let opposite = if b.cmp_zero() == Ordering::Less { one() } else { -one::<S>() };
                Some(self.lift(&[(*p, one()), (*q, opposite)]))
            }
        })
    }

    /// A basis of the kernel.
    pub fn kernel(&self) -> Vec<Vec<S>> {
        self.zero.iter().map(|&i| self.lift(&[(i, one())])).collect()
    }

    /// The solution of `Lᵀ x = y` for a `y` that vanishes on every block but one: then `xᵀ A x = yᵀ D y`.
    fn lift(&self, y: &[(usize, S)]) -> Vec<S> {
        let mut x = vec![S::zero(); self.size];
        y.iter().for_each(|(i, value)| x[*i] = value.clone());
        for step in self.steps.iter().rev() {
            for (p, factors) in &step.multiples {
                let pull = factors.iter().fold(S::zero(), |sum, (i, m)| sum + m.clone() * x[*i].clone());
                x[*p] = (x[*p].clone() - pull).reduced();
            }
        }
        x
    }
}

/// The next block of D: the first diagonal entry that is not zero, else the first entry at all.
fn next_block<S: Scalar>(a: &Dense<S>, left: &[usize]) -> Option<Block<S>> {
    if let Some(&p) = left.iter().find(|&&p| nonzero(a.at(p, p))) {
        return Some(Block::One(p, a.at(p, p).clone()));
    }
    let pairs = left.iter().enumerate().flat_map(|(k, &p)| left[k + 1..].iter().map(move |&q| (p, q)));
    pairs.into_iter().find(|&(p, q)| nonzero(a.at(p, q))).map(|(p, q)| Block::Two(p, q, a.at(p, q).clone()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Stream;
    use crate::linalg::factor::{singular_values, symmetric_eigen};
    use crate::scalar::Rational;

    fn exact(a: &Dense<f64>) -> Dense<Rational> {
        Dense::from_fn(a.rows(), a.columns(), |i, j| Rational::exactly(*a.at(i, j)).unwrap())
    }

    fn sparse(a: &Dense<f64>) -> Csr {
        let place = |k: usize| (k / a.columns(), k % a.columns());
        let triplets: Vec<_> = (0..a.rows() * a.columns()).map(place).map(|(i, j)| (i, j, *a.at(i, j))).collect();
        Csr::from_triplets(a.rows(), a.columns(), &triplets)
    }

    /// A symmetric matrix of whole numbers from −2 to 2, with a zero diagonal for every third seed.
    fn symmetric(n: usize, seed: u64) -> Dense<f64> {
        let mut stream = Stream::new(seed, "symmetric");
        let drawn: Vec<f64> = (0..n * n).map(|_| stream.below(5) as f64 - 2.0).collect();
        Dense::from_fn(n, n, |i, j| if i == j && seed.is_multiple_of(3) { 0.0 } else { drawn[i.min(j) * n + i.max(j)] })
    }

    #[test]
    fn the_inertia_is_that_of_the_dense_eigenvalues() {
        let mut singular = 0;
        for seed in 0..60 {
            let n = 2 + seed as usize % 7;
            let a = symmetric(n, seed);
            let (values, _) = symmetric_eigen(&sparse(&a)).unwrap();
            // Integer entries of magnitude 2 at most: a nonzero eigenvalue is at least 1/(2n)^(n−1) > 1e-9.
            let count = |keep: fn(f64) -> bool| values.iter().filter(|v| keep(**v)).count();
            let expected = Inertia {
                negative: count(|v| v < -1e-10),
                zero: count(|v| v.abs() <= 1e-10),
                positive: count(|v| v > 1e-10),
            };
            let found = exact(&a).eliminate();
            assert_eq!(found.inertia(), expected, "seed {seed}");
            assert_eq!(exact(&a).rank(), n - expected.zero);
            singular += usize::from(expected.zero > 0);
        }
        assert!(singular > 5, "singular cases occur: {singular}");
    }

    #[test]
    fn a_negative_direction_exists_exactly_when_a_negative_eigenvalue_does() {
        for seed in 0..60 {
            let a = exact(&symmetric(2 + seed as usize % 6, seed));
            let found = a.eliminate();
            match found.negative_direction() {
                Some(x) => assert_eq!(a.quadratic_form(&x).cmp_zero(), Ordering::Less),
                None => assert_eq!(found.inertia().negative, 0),
            }
        }
    }

    #[test]
    fn both_eliminations_find_the_same_kernel() {
        for seed in 0..60 {
            let a = exact(&symmetric(3 + seed as usize % 4, seed));
            let (symmetric, general) = (a.eliminate().kernel(), a.kernel());
            assert_eq!(symmetric.len(), general.len());
            for x in symmetric.iter().chain(&general) {
                assert!(a.mul(x).iter().all(|r| r.cmp_zero() == Ordering::Equal));
                assert!(x.iter().any(nonzero));
            }
        }
    }

    #[test]
    fn the_inverse_of_the_hilbert_matrix_is_the_matrix_of_whole_numbers_in_closed_form() {
        let n = 8;
        let whole = |x: u128| Rational::from_parts(x.into(), 1u8.into());
        let hilbert = Dense::from_fn(n, n, |i, j| whole(1) / whole((i + j + 1) as u128));
        let inverse = hilbert.inverse().unwrap();
        let choose = |n: u128, k: u128| (0..k).fold(1, |c, i| c * (n - i) / (i + 1));
        let n = n as u128;
        for i in 0..n {
            for j in 0..n {
                let magnitude =
                    (i + j + 1) * choose(n + i, n - j - 1) * choose(n + j, n - i - 1) * choose(i + j, i).pow(2);
                let sign = if (i + j) % 2 == 0 { whole(1) } else { -whole(1) };
                assert_eq!(*inverse.at(i as usize, j as usize), sign * whole(magnitude));
            }
        }
        assert!(hilbert.eliminate().is_definite());
    }

    #[test]
    fn a_singular_system_has_no_solution_and_no_inverse() {
        let path = Dense::from_fn(3, 3, |i, j| match i.abs_diff(j) {
            0 => {
                if i == 1 {
                    2.0
                } else {
                    1.0
                }
            }
            1 => -1.0,
            _ => 0.0,
        });
        let path = exact(&path);
        assert_eq!(path.inverse(), None);
        assert_eq!(path.rank(), 2);
        assert_eq!(path.eliminate().inertia(), Inertia { negative: 0, zero: 1, positive: 2 });
    }

    #[test]
    fn the_rank_of_a_rectangular_matrix_is_the_number_of_its_singular_values() {
        let mut stream = Stream::new(5, "rank");
        let (left, right): (Vec<f64>, Vec<f64>) =
            (0..12).map(|_| (stream.below(7) as f64, stream.below(7) as f64)).unzip();
        let a = Dense::from_fn(6, 2, |i, k| left[2 * i + k]).product(&Dense::from_fn(2, 6, |k, j| right[6 * k + j]));
        let values = singular_values(&sparse(&a)).unwrap().0;
        assert_eq!(exact(&a).rank(), values.iter().filter(|v| **v > 1e-9).count());
        assert_eq!(exact(&a).transpose().rank(), exact(&a).rank());
    }

    #[test]
    fn sixty_rows_stay_affordable() {
        let a =
            exact(&Dense::from_fn(60, 60, |i, j| if i == j { 4.0 } else { -f64::from(u8::from(i.abs_diff(j) < 3)) }));
        let x: Vec<Rational> = (0..60).map(|k| Rational::exactly(f64::from(k) / 8.0).unwrap()).collect();
        let b = a.mul(&x);
        let solution = a.solve(&Dense::from_fn(60, 1, |i, _| b[i].clone())).unwrap();
        assert!((0..60).all(|i| *solution.at(i, 0) == x[i]));
    }
}
