//! Factorisations and solves: the only place that names a type of `faer`.
//!
//! Everything runs sequentially inside one matrix (`Par::Seq`): the program is parallel over cases, and sums are then
//! formed in the same order for any number of threads.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::solvers::{Solve, SolveCore};
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, SparseColMatRef, SymbolicSparseColMatRef, Triplet};
use faer::{Conj, Mat, MatMut, Par, Side};

use super::Csr;

/// Above this size the supernodal factorisation wins by a factor of 4 to 25 on meshes; below it the automatic choice does.
const SUPERNODAL_FROM: usize = 5000;

/// Why a factorisation or decomposition gave nothing.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FactorError {
    /// The matrix is not square.
    #[error("the matrix is {rows}×{columns}, but only a square one can be factorised")]
    NotSquare {
        /// Its rows.
        rows: usize,
        /// Its columns.
        columns: usize,
    },
    /// An entry is NaN or infinite.
    #[error("entry ({row}, {column}) is not finite")]
    NotFinite {
        /// Its row.
        row: usize,
        /// Its column.
        column: usize,
    },
    /// A pivot is exactly zero.
    #[error("the matrix is singular: a pivot is exactly zero")]
    Singular,
    /// Index overflow, memory, or an iteration that did not converge.
    #[error("the factorisation did not finish")]
    Unfinished,
}

/// How many eigenvalues of a symmetric matrix are negative, zero and positive (Sylvester's law of inertia).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inertia {
    /// Negative eigenvalues.
    pub negative: usize,
    /// Zero pivots.
    pub zero: usize,
    /// Positive eigenvalues.
    pub positive: usize,
}

fn check(a: &Csr) -> Result<(), FactorError> {
    if a.rows() != a.columns() {
        return Err(FactorError::NotSquare { rows: a.rows(), columns: a.columns() });
    }
    match a.entries().find(|(_, _, v)| !v.is_finite()) {
        Some((row, column, _)) => Err(FactorError::NotFinite { row, column }),
        None => Ok(()),
    }
}

fn columns(a: &Csr) -> Result<SparseColMat<usize, f64>, FactorError> {
    check(a)?;
    let triplets: Vec<_> = a.entries().map(|(i, j, &v)| Triplet::new(i, j, v)).collect();
    SparseColMat::try_new_from_triplets(a.rows(), a.columns(), &triplets).map_err(|_| FactorError::Unfinished)
}

/// What elimination does to a pattern, whatever the values: computed once for many matrices of one pattern.
#[derive(Clone)]
pub(super) struct Elimination(Arc<SymbolicCholesky<usize>>);

impl Elimination {
    /// In an order of approximate minimum degree.
    fn by_degree(a: &Csr) -> Result<Self, FactorError> {
        let threshold = match a.rows() > SUPERNODAL_FROM {
            true => SupernodalThreshold::FORCE_SUPERNODAL,
            false => SupernodalThreshold::AUTO,
        };
        Self::new(a, SymmetricOrdering::Amd, threshold)
    }

    /// Row after row, in dense blocks.
    pub(super) fn row_by_row(a: &Csr) -> Result<Self, FactorError> {
        Self::new(a, SymmetricOrdering::Identity, SupernodalThreshold::FORCE_SUPERNODAL)
    }

    fn new(a: &Csr, order: SymmetricOrdering<'_, usize>, threshold: SupernodalThreshold) -> Result<Self, FactorError> {
        let parameters = CholeskySymbolicParams { supernodal_flop_ratio_threshold: threshold, ..Default::default() };
        let symbolic = factorize_symbolic_cholesky(transpose(a)?.symbolic(), Side::Upper, order, parameters);
        Ok(Elimination(Arc::new(symbolic.map_err(|_| FactorError::Unfinished)?)))
    }

    /// Factorises a matrix of this pattern.
    pub(super) fn factor(&self, a: &Csr) -> Result<Ldlt, FactorError> {
        let symbolic = &self.0;
        let mut values = vec![0.0; symbolic.len_val()];
        let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
        symbolic
            .factorize_numeric_ldlt(
                &mut values,
                transpose(a)?,
                Side::Upper,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut MemBuffer::new(scratch)),
                Default::default(),
            )
            .map_err(|_| FactorError::Singular)?;
        Ok(Ldlt { symbolic: Arc::clone(symbolic), values })
    }
}

/// The transpose as columns, without a copy: its upper triangle is the lower one of `a`.
fn transpose(a: &Csr) -> Result<SparseColMatRef<'_, usize, f64>, FactorError> {
    check(a)?;
    let pattern = SymbolicSparseColMatRef::new_checked(a.columns(), a.rows(), a.offsets(), None, a.indices());
    Ok(SparseColMatRef::new(pattern, a.values()))
}

/// A factorisation `P A Pᵀ = L D Lᵀ` of a symmetric matrix, without pivoting; the lower triangle of A is read.
///
/// # Guarantees
/// The signs of D are the inertia of a matrix close to A. # Exception: a pivot tiny against the others makes the count
/// worthless; shift the matrix away from its eigenvalues first.
pub struct Ldlt {
    symbolic: Arc<SymbolicCholesky<usize>>,
    values: Vec<f64>,
}

/// Neighbouring columns of L that have their entries below themselves in the same rows.
pub(super) struct Node<'a> {
    /// The first column.
    pub(super) first: usize,
    /// How many columns.
    pub(super) width: usize,
    /// The rows below the columns' own, ascending.
    pub(super) below: &'a [usize],
    /// Column by column `width + below.len()` values: D on the diagonal, L under it, what is above without meaning.
    pub(super) values: &'a [f64],
}

impl<'a> Node<'a> {
    /// The values of a column, from the node's first row on.
    pub(super) fn column(&self, j: usize) -> &'a [f64] {
        let height = self.width + self.below.len();
        &self.values[j * height..(j + 1) * height]
    }
}

impl Ldlt {
    /// Factorises with an approximate minimum degree ordering.
    ///
    /// # Errors
    /// A matrix that is not square or not finite, or a pivot that is exactly zero.
    pub fn new(a: &Csr) -> Result<Self, FactorError> {
        Elimination::by_degree(a)?.factor(a)
    }

    /// The number of rows.
    pub(super) fn rows(&self) -> usize {
        self.symbolic.nrows()
    }

    /// The columns of L, node by node.
    pub(super) fn nodes(&self) -> impl DoubleEndedIterator<Item = Node<'_>> {
        let count = match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(s) => s.ncols(),
            SymbolicCholeskyRaw::Supernodal(s) => s.n_supernodes(),
        };
        (0..count).map(|k| match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(s) => {
                let range = s.col_ptr()[k]..s.col_ptr()[k + 1];
                let below = &s.row_idx()[range.clone()][1..];
                Node { first: k, width: 1, below, values: &self.values[range] }
            }
            SymbolicCholeskyRaw::Supernodal(s) => {
                let (first, end) = (s.supernode_begin()[k], s.supernode_end()[k]);
                let below = &s.row_idx()[s.col_ptr_for_row_idx()[k]..s.col_ptr_for_row_idx()[k + 1]];
                let (width, start) = (end - first, s.col_ptr_for_val()[k]);
                Node { first, width, below, values: &self.values[start..start + width * (width + below.len())] }
            }
        })
    }

    /// The diagonal of D in the order of elimination.
    pub fn pivots(&self) -> Vec<f64> {
        self.nodes().flat_map(|node| (0..node.width).map(move |j| node.column(j)[j])).collect()
    }

    /// The order of elimination: position k eliminates row `order[k]`.
    pub fn order(&self) -> Vec<usize> {
        match self.symbolic.perm() {
            Some(permutation) => permutation.arrays().0.to_vec(),
            None => (0..self.symbolic.nrows()).collect(),
        }
    }

    /// The inertia read off D.
    pub fn inertia(&self) -> Inertia {
        let mut count = Inertia { negative: 0, zero: 0, positive: 0 };
        for d in self.pivots() {
            match d {
                d if d < 0.0 => count.negative += 1,
                d if d > 0.0 => count.positive += 1,
                _ => count.zero += 1,
            }
        }
        count
    }

    fn solve_columns(&self, x: MatMut<'_, f64>) {
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(x.ncols(), Par::Seq);
        LdltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            x,
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
        );
    }

    /// Solves `A X = B`, the columns of B given and replaced.
    pub fn solve(&self, columns: &mut [Vec<f64>]) {
        if columns.is_empty() {
            return;
        }
        let mut x = Mat::from_fn(self.symbolic.nrows(), columns.len(), |i, j| columns[j][i]);
        self.solve_columns(x.as_mut());
        read_back(&x, columns);
    }
}

/// A sparse LU factorisation with partial pivoting, for matrices that are not symmetric.
pub struct Lu(Box<faer::sparse::linalg::solvers::Lu<usize, f64>>);

impl Lu {
    /// Factorises.
    ///
    /// # Errors
    /// A matrix that is not square or not finite, or structurally or numerically singular.
    pub fn new(a: &Csr) -> Result<Self, FactorError> {
        let lu = columns(a)?.as_ref().sp_lu().map_err(|_| FactorError::Singular)?;
        Ok(Lu(Box::new(lu)))
    }

    /// Solves `A X = B`, the columns of B given and replaced.
    pub fn solve(&self, columns: &mut [Vec<f64>]) {
        let rows = columns.first().map_or(0, Vec::len);
        let mut x = Mat::from_fn(rows, columns.len(), |i, j| columns[j][i]);
        self.0.solve_in_place(&mut x);
        read_back(&x, columns);
    }

    /// Solves `Aᵀ X = B`, the columns of B given and replaced.
    pub fn solve_transpose(&self, columns: &mut [Vec<f64>]) {
        let rows = columns.first().map_or(0, Vec::len);
        let mut x = Mat::from_fn(rows, columns.len(), |i, j| columns[j][i]);
        self.0.solve_transpose_in_place_with_conj(Conj::No, x.as_mut());
        read_back(&x, columns);
    }
}

fn read_back(x: &Mat<f64>, columns: &mut [Vec<f64>]) {
    for (j, column) in columns.iter_mut().enumerate() {
        column.iter_mut().enumerate().for_each(|(i, v)| *v = x[(i, j)]);
    }
}

/// A direction of negative energy: searches the elimination for the first negative pivot and returns x with `xᵀAx < 0`
/// (up to rounding: evaluate it again), supported on the rows eliminated before it; `None` if all pivots are positive.
///
/// With `A_pp` the leading block before pivot p, `x = (−A_pp⁻¹ a_p, 1)` gives `xᵀAx = d_p`.
///
/// # Errors
/// As [`Ldlt::new`].
pub fn negative_direction(a: &Csr) -> Result<Option<Vec<f64>>, FactorError> {
    let factor = Ldlt::new(a)?;
    let Some(position) = factor.pivots().iter().position(|&d| d.is_nan() || d <= 0.0) else {
        return Ok(None);
    };
    let order = factor.order();
    let (leading, pivot) = (&order[..position], order[position]);
    let mut x = vec![0.0; a.rows()];
    x[pivot] = 1.0;
    if !leading.is_empty() {
        let block = a.submatrix(leading, leading);
        let mut column = [leading.iter().map(|&i| -a.at(i, pivot)).collect::<Vec<f64>>()];
        Ldlt::new(&block)?.solve(&mut column);
        leading.iter().zip(&column[0]).for_each(|(&i, &v)| x[i] = v);
    }
    Ok(Some(x))
}

/// The dense form of a sparse matrix.
fn dense(a: &Csr) -> Mat<f64> {
    let mut full = Mat::zeros(a.rows(), a.columns());
    a.entries().for_each(|(i, j, &v)| full[(i, j)] = v);
    full
}

/// All eigenvalues, ascending, and orthonormal eigenvectors of the symmetric matrix whose lower triangle is given.
/// Dense: O(n³); below about 2000 unknowns.
///
/// # Errors
/// A matrix that is not square or not finite, or an iteration that did not converge.
pub fn symmetric_eigen(a: &Csr) -> Result<(Vec<f64>, Vec<Vec<f64>>), FactorError> {
    check(a)?;
    let n = a.rows();
    let eigen = dense(a).self_adjoint_eigen(Side::Lower).map_err(|_| FactorError::Unfinished)?;
    let values = (0..n).map(|k| eigen.S().column_vector()[k]).collect();
    let vectors = (0..n).map(|k| (0..n).map(|i| eigen.U()[(i, k)]).collect()).collect();
    Ok((values, vectors))
}

/// All eigenvalues of the pencil `(L, M)`, ascending, and M-orthonormal eigenvectors, through the Cholesky factor of M: the
/// eigenvalues of `G⁻¹ L G⁻ᵀ`, `M = G Gᵀ`. Of both matrices the lower triangle is read. Dense: O(n³).
///
/// # Errors
/// Matrices that are not square or not finite, an iteration that did not converge; `Singular` where M is not positive definite.
pub(super) fn pencil_eigen(stiffness: &Csr, mass: &Csr) -> Result<(Vec<f64>, Mat<f64>), FactorError> {
    check(stiffness)?;
    check(mass)?;
    let factor = dense(mass).llt(Side::Lower).map_err(|_| FactorError::Singular)?;
    let mut reduced = dense(stiffness);
    solve_lower_triangular_in_place(factor.L(), reduced.as_mut(), Par::Seq);
    // The rows of G⁻¹L, solved once more, are the columns of G⁻¹ L G⁻ᵀ.
    let mut reduced = reduced.transpose().to_owned();
    solve_lower_triangular_in_place(factor.L(), reduced.as_mut(), Par::Seq);
    let eigen = reduced.self_adjoint_eigen(Side::Lower).map_err(|_| FactorError::Unfinished)?;
    let values = (0..stiffness.rows()).map(|k| eigen.S().column_vector()[k]).collect();
    let mut vectors = eigen.U().to_owned();
    solve_upper_triangular_in_place(factor.L().transpose(), vectors.as_mut(), Par::Seq);
    Ok((values, vectors))
}

/// The singular values, descending, and the right singular vectors in the same order. Dense: O(n³).
///
/// # Errors
/// A matrix that is not square or not finite, or an iteration that did not converge.
pub fn singular_values(a: &Csr) -> Result<(Vec<f64>, Vec<Vec<f64>>), FactorError> {
    check(a)?;
    let n = a.rows();
    let svd = dense(a).svd().map_err(|_| FactorError::Unfinished)?;
    let values = (0..n).map(|k| svd.S().column_vector()[k]).collect();
    let vectors = (0..n).map(|k| (0..n).map(|i| svd.V()[(i, k)]).collect()).collect();
    Ok((values, vectors))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The Laplacian of a path with n vertices plus a shift.
    fn path(n: usize, shift: f64) -> Csr {
        let mut t = Vec::new();
        for i in 0..n {
            let degree = if i == 0 || i + 1 == n { 1.0 } else { 2.0 };
            t.push((i, i, degree + shift));
            if i + 1 < n {
                t.push((i, i + 1, -1.0));
                t.push((i + 1, i, -1.0));
            }
        }
        Csr::from_triplets(n, n, &t)
    }

    #[test]
    fn the_inertia_counts_the_eigenvalues_of_a_path_below_the_shift() {
        // Eigenvalues 2 − 2 cos(πk/n).
        for n in [10, 300, 6000] {
            let sigma = 0.37;
            let below = (0..n).filter(|&k| 2.0 - 2.0 * (std::f64::consts::PI * k as f64 / n as f64).cos() < sigma);
            assert_eq!(Ldlt::new(&path(n, -sigma)).unwrap().inertia().negative, below.count());
        }
    }

    #[test]
    fn both_factorisations_solve_the_same_system() {
        let a = path(50, 0.1);
        let b: Vec<f64> = (0..50).map(|k| f64::from(k).sin()).collect();
        let (mut x, mut y, mut z) = ([b.clone()], [b.clone()], [b.clone()]);
        Ldlt::new(&a).unwrap().solve(&mut x);
        Lu::new(&a).unwrap().solve(&mut y);
        Lu::new(&a).unwrap().solve_transpose(&mut z);
        for (k, r) in a.mul(&x[0]).iter().enumerate() {
            assert!((r - b[k]).abs() < 1e-13 && (x[0][k] - y[0][k]).abs() < 1e-12 && (z[0][k] - y[0][k]).abs() < 1e-12);
        }
    }

    #[test]
    fn a_negative_direction_has_negative_energy_and_is_absent_for_a_positive_matrix() {
        for n in [12, 7000] {
            let a = path(n, -0.01);
            let x = negative_direction(&a).unwrap().unwrap();
            assert!(a.quadratic_form(&x) < 0.0);
            assert_eq!(negative_direction(&path(n, 0.01)).unwrap(), None);
        }
    }

    #[test]
    fn the_dense_eigenvalues_of_a_path_are_the_closed_form() {
        let (values, vectors) = symmetric_eigen(&path(9, 0.0)).unwrap();
        for (k, value) in values.iter().enumerate() {
            assert!((value - (2.0 - 2.0 * (std::f64::consts::PI * k as f64 / 9.0).cos())).abs() < 1e-14);
        }
        assert!((vectors[0][0].abs() - 1.0 / 3.0).abs() < 1e-14);
    }

    #[test]
    fn a_nan_is_refused_with_its_place() {
        let a = Csr::from_triplets(2, 2, &[(0, 0, 1.0), (1, 0, f64::NAN), (1, 1, 1.0)]);
        assert_eq!(Ldlt::new(&a).err(), Some(FactorError::NotFinite { row: 1, column: 0 }));
    }
}
