//! Dense square matrices of `f64`: products, norms, singular values.

use faer::Mat;

use super::Csr;
use super::factor::FactorError;

/// A dense square matrix.
#[derive(Clone, Debug)]
pub struct Full(pub(super) Mat<f64>);

/// `A = U diag(σ) Vᵀ`, computed.
#[derive(Clone, Debug)]
pub struct SingularValues {
    /// The singular values, descending.
    pub values: Vec<f64>,
    /// The columns of U.
    pub left: Vec<Vec<f64>>,
    /// The columns of V.
    pub right: Vec<Vec<f64>>,
}

impl Full {
    /// The n×n matrix with the entry `f(i, j)` at `(i, j)`.
    pub fn from_fn(n: usize, f: impl Fn(usize, usize) -> f64) -> Self {
        Full(Mat::from_fn(n, n, f))
    }

    /// The dense form of a square sparse matrix.
    pub fn of(a: &Csr) -> Self {
        let mut full = Mat::zeros(a.rows(), a.rows());
        a.entries().for_each(|(i, j, &v)| full[(i, j)] = v);
        Full(full)
    }

    /// The number of rows.
    pub fn size(&self) -> usize {
        self.0.nrows()
    }

    /// The entry at `(i, j)`.
    pub fn at(&self, i: usize, j: usize) -> f64 {
        self.0[(i, j)]
    }

    /// Replaces the entry at `(i, j)`.
    pub fn set(&mut self, i: usize, j: usize, value: f64) {
        self.0[(i, j)] = value;
    }

    /// The product with another matrix; each entry is a sum of n products in some order.
    pub fn times(&self, other: &Full) -> Full {
        let n = self.size();
        let mut product = Mat::zeros(n, n);
        faer::linalg::matmul::matmul(
            product.as_mut(),
            faer::Accum::Replace,
            self.0.as_ref(),
            other.0.as_ref(),
            1.0,
            faer::Par::Seq,
        );
        Full(product)
    }

    /// The matrix of the magnitudes.
    pub fn magnitudes(&self) -> Full {
        Full::from_fn(self.size(), |i, j| self.at(i, j).abs())
    }

    /// `‖A‖_∞`, the largest sum of magnitudes of a row; NaN where an entry is.
    pub fn row_norm(&self) -> f64 {
        largest((0..self.size()).map(|i| (0..self.size()).map(|j| self.at(i, j).abs()).sum()))
    }

    /// `‖A‖₁`, the largest sum of magnitudes of a column; NaN where an entry is.
    pub fn column_norm(&self) -> f64 {
        largest((0..self.size()).map(|j| (0..self.size()).map(|i| self.at(i, j).abs()).sum()))
    }

    /// The singular values and vectors. O(n³).
    ///
    /// # Errors
    /// An entry that is not finite, or an iteration that did not converge.
    pub fn singular_values(&self) -> Result<SingularValues, FactorError> {
        let n = self.size();
        for (row, column) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            if !self.at(row, column).is_finite() {
                return Err(FactorError::NotFinite { row, column });
            }
        }
        let svd = self.0.svd().map_err(|_| FactorError::Unfinished)?;
        let columns = |m: faer::MatRef<'_, f64>| (0..n).map(|k| (0..n).map(|i| m[(i, k)]).collect()).collect();
        Ok(SingularValues {
            values: (0..n).map(|k| svd.S().column_vector()[k]).collect(),
            left: columns(svd.U()),
            right: columns(svd.V()),
        })
    }
}

fn largest(sums: impl Iterator<Item = f64>) -> f64 {
    sums.fold(0.0, |m, s| if s.is_nan() || s > m { s } else { m })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_norms_are_those_of_rows_and_columns_and_the_product_is_the_product() {
        let a = Full::from_fn(2, |i, j| [[1.0, -2.0], [3.0, 4.0]][i][j]);
        assert_eq!((a.row_norm(), a.column_norm()), (7.0, 6.0));
        let square = a.times(&a);
        assert_eq!([square.at(0, 0), square.at(0, 1), square.at(1, 0), square.at(1, 1)], [-5.0, -10.0, 15.0, 10.0]);
    }

    #[test]
    fn the_decomposition_gives_the_matrix_back() {
        let a = Full::from_fn(5, |i, j| ((3 * i + 7 * j * j) % 11) as f64 - 4.0);
        let found = a.singular_values().unwrap();
        for (i, j) in (0..5).flat_map(|i| (0..5).map(move |j| (i, j))) {
            let sum: f64 = (0..5).map(|k| found.values[k] * found.left[k][i] * found.right[k][j]).sum();
            assert!((sum - a.at(i, j)).abs() < 1e-13);
        }
        assert!(Full::from_fn(1, |_, _| f64::NAN).singular_values().is_err());
    }
}
