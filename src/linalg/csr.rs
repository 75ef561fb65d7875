//! Sparse matrices in compressed rows, over any [`Scalar`].

use super::parallel::{self, BLOCK};
use crate::scalar::Scalar;

/// A sparse matrix in compressed rows; column indices ascend within each row and occur once.
///
/// An entry that is stored may be zero: what is stored is what the construction wrote, and a checker asks for the value.
#[derive(Clone, Debug, PartialEq)]
pub struct Csr<S = f64> {
    rows: usize,
    columns: usize,
    offsets: Vec<usize>,
    indices: Vec<usize>,
    values: Vec<S>,
}

impl<S: Scalar> Csr<S> {
    /// Builds from `(row, column, value)` triplets; triplets of the same place are added in the order given.
    ///
    /// Cost: O(n + nnz log(row length)).
    ///
    /// # Panics
    /// If an index is out of range: callers check indices where they enter the program.
    pub fn from_triplets(rows: usize, columns: usize, triplets: &[(usize, usize, S)]) -> Self {
        let mut offsets = vec![0; rows + 1];
        for &(i, j, _) in triplets {
            assert!(i < rows && j < columns, "entry ({i}, {j}) outside a {rows}×{columns} matrix");
            offsets[i + 1] += 1;
        }
        for i in 0..rows {
            offsets[i + 1] += offsets[i];
        }
        let mut next = offsets.clone();
        let mut order = vec![0; triplets.len()];
        for (k, &(i, _, _)) in triplets.iter().enumerate() {
            order[next[i]] = k;
            next[i] += 1;
        }
        let (mut indices, mut values) = (Vec::new(), Vec::new());
        indices.reserve_exact(triplets.len());
        values.reserve_exact(triplets.len());
        let mut matrix = Self { rows, columns, offsets: Vec::with_capacity(rows + 1), indices, values };
        matrix.offsets.push(0);
        for i in 0..rows {
            let row = &mut order[offsets[i]..offsets[i + 1]];
            row.sort_by_key(|&k| (triplets[k].1, k));
            let start = matrix.indices.len();
            for &k in row.iter() {
                let (_, j, value) = &triplets[k];
                if matrix.indices.len() > start && matrix.indices.last() == Some(j) {
                    let last = matrix.values.len() - 1;
                    matrix.values[last] = matrix.values[last].clone() + value.clone();
                } else {
                    matrix.indices.push(*j);
                    matrix.values.push(value.clone());
                }
            }
            matrix.offsets.push(matrix.indices.len());
        }
        matrix
    }

    /// Builds row by row, in parallel, without triplets: row i has `length(i)` entries, which `write` stores as its columns,
    /// ascending, and its values. What a row becomes must depend on nothing but its number.
    ///
    /// Cost: O(n + nnz), and what `write` costs. Memory: the matrix itself, 8 bytes a row and 8 an entry beside its value.
    pub(crate) fn from_rows(
        rows: usize,
        columns: usize,
        length: impl Fn(usize) -> usize,
        write: impl Fn(usize, &mut [usize], &mut [S]) + Sync,
    ) -> Self {
        let mut offsets = Vec::with_capacity(rows + 1);
        offsets.push(0);
        let mut end = 0;
        offsets.extend((0..rows).map(|i| {
            end += length(i);
            end
        }));
        let (mut indices, mut values) = (vec![0; end], vec![S::zero(); end]);
        write_rows(&offsets, 0, &mut indices, &mut values, &write);
        Csr { rows, columns, offsets, indices, values }
    }

    /// A diagonal matrix.
    pub fn diagonal(values: &[S]) -> Self {
        Csr::from_diagonal(values.to_vec())
    }

    /// A diagonal matrix that takes the list of its values over.
    pub fn from_diagonal(values: Vec<S>) -> Self {
        let n = values.len();
        Csr { rows: n, columns: n, offsets: (0..=n).collect(), indices: (0..n).collect(), values }
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The number of stored entries, zeros included.
    pub fn stored(&self) -> usize {
        self.values.len()
    }

    /// The stored entries of row `i`, columns ascending.
    pub fn row(&self, i: usize) -> impl ExactSizeIterator<Item = (usize, &S)> + Clone {
        let range = self.offsets[i]..self.offsets[i + 1];
        self.indices[range.clone()].iter().copied().zip(&self.values[range])
    }

    /// All stored entries, row by row.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, &S)> {
        (0..self.rows).flat_map(move |i| self.row(i).map(move |(j, v)| (i, j, v)))
    }

    /// The stored columns of row `i`, ascending, and their values.
    pub fn row_slices(&self, i: usize) -> (&[usize], &[S]) {
        let range = self.offsets[i]..self.offsets[i + 1];
        (&self.indices[range.clone()], &self.values[range])
    }

    /// Where each row begins among the stored entries, and the end.
    pub(super) fn offsets(&self) -> &[usize] {
        &self.offsets
    }

    /// The columns of the stored entries, row by row.
    pub fn indices(&self) -> &[usize] {
        &self.indices
    }

    /// The stored values, row by row.
    pub fn values(&self) -> &[S] {
        &self.values
    }

    /// The entry at `(i, j)`; `None` where nothing is stored.
    pub fn get(&self, i: usize, j: usize) -> Option<&S> {
        let range = self.offsets[i]..self.offsets[i + 1];
        let at = self.indices[range.clone()].binary_search(&j).ok()?;
        Some(&self.values[range.start + at])
    }

    /// The entry at `(i, j)`, zero where nothing is stored.
    pub fn at(&self, i: usize, j: usize) -> S {
        self.get(i, j).cloned().unwrap_or_else(S::zero)
    }

    /// The product `A x`, each row summed in column order.
    pub fn mul(&self, x: &[S]) -> Vec<S> {
        (0..self.rows).map(|i| self.row(i).fold(S::zero(), |sum, (j, v)| sum + v.clone() * x[j].clone())).collect()
    }

    /// The quadratic form `xᵀ A x`.
    pub fn quadratic_form(&self, x: &[S]) -> S {
        self.mul(x).into_iter().zip(x).fold(S::zero(), |sum, (y, x)| sum + y * x.clone())
    }

    /// The transpose.
    pub fn transpose(&self) -> Self {
        let mut offsets = vec![0; self.columns + 1];
        for &j in &self.indices {
            offsets[j + 1] += 1;
        }
        for j in 0..self.columns {
            offsets[j + 1] += offsets[j];
        }
        let mut next = offsets.clone();
        let mut order = vec![(0, 0); self.values.len()];
        for i in 0..self.rows {
            for k in self.offsets[i]..self.offsets[i + 1] {
                let j = self.indices[k];
                order[next[j]] = (i, k);
                next[j] += 1;
            }
        }
        Csr {
            rows: self.columns,
            columns: self.rows,
            offsets,
            indices: order.iter().map(|&(i, _)| i).collect(),
            values: order.iter().map(|&(_, k)| self.values[k].clone()).collect(),
        }
    }

    /// The same matrix with every stored value replaced by `f(i, j, value)`.
    pub fn map<T: Scalar>(&self, mut f: impl FnMut(usize, usize, &S) -> T) -> Csr<T> {
        Csr {
            rows: self.rows,
            columns: self.columns,
            offsets: self.offsets.clone(),
            indices: self.indices.clone(),
            values: self.entries().map(|(i, j, v)| f(i, j, v)).collect(),
        }
    }

    /// The sum `A + B` of two matrices of the same shape; an entry is stored where one of them stores it.
    pub fn add(&self, other: &Self) -> Self {
        let stored = self.stored() + other.stored();
        let (mut offsets, mut indices, mut values) = (vec![0], Vec::with_capacity(stored), Vec::with_capacity(stored));
        for i in 0..self.rows {
            let (mut left, mut right) = (self.row(i).peekable(), other.row(i).peekable());
            loop {
                let (j, value) = match (left.peek(), right.peek()) {
                    (Some(&(j, a)), Some(&(k, b))) if j == k => {
                        right.next();
                        left.next();
                        (j, a.clone() + b.clone())
                    }
                    (Some(&(j, a)), right) if right.is_none_or(|&(k, _)| j < k) => {
                        left.next();
                        (j, a.clone())
                    }
                    (_, Some(&(k, b))) => {
                        right.next();
                        (k, b.clone())
                    }
                    _ => break,
                };
                indices.push(j);
                values.push(value);
            }
            offsets.push(indices.len());
        }
        Csr { rows: self.rows, columns: self.columns, offsets, indices, values }
    }

    /// The square matrix with row and column `order[k]` as number k.
    ///
    /// # Panics
    /// If `order` is no permutation.
    pub(super) fn permuted(&self, order: &[usize]) -> Self {
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(k, &i)| place[i] = k);
        let length = |k: usize| self.row(order[k]).len();
        Csr::from_rows(self.rows, self.columns, length, |k, indices, values| {
            let (columns, entries) = self.row_slices(order[k]);
            let mut row: Vec<usize> = (0..columns.len()).collect();
            row.sort_unstable_by_key(|&q| place[columns[q]]);
            for (at, q) in row.into_iter().enumerate() {
                indices[at] = place[columns[q]];
                values[at] = entries[q].clone();
            }
        })
    }

    /// The submatrix of the given rows and columns, renumbered in the order given.
    pub fn submatrix(&self, rows: &[usize], columns: &[usize]) -> Self {
        let mut place = vec![usize::MAX; self.columns];
        for (at, &j) in columns.iter().enumerate() {
            place[j] = at;
        }
        let mut triplets = Vec::new();
        for (at, &i) in rows.iter().enumerate() {
            triplets
                .extend(self.row(i).filter(|&(j, _)| place[j] != usize::MAX).map(|(j, v)| (at, place[j], v.clone())));
        }
        Csr::from_triplets(rows.len(), columns.len(), &triplets)
    }
}

/// Writes the rows with these offsets, of which the first is number `first`, halving the work until it is a block.
fn write_rows<S: Scalar>(
    offsets: &[usize],
    first: usize,
    indices: &mut [usize],
    values: &mut [S],
    write: &(impl Fn(usize, &mut [usize], &mut [S]) + Sync),
) {
    let rows = offsets.len() - 1;
    if rows > BLOCK {
        let middle = rows / 2;
        let at = offsets[middle] - offsets[0];
        let ((i, j), (v, w)) = (indices.split_at_mut(at), values.split_at_mut(at));
        rayon::join(
            || write_rows(&offsets[..=middle], first, i, v, write),
            || write_rows(&offsets[middle..], first + middle, j, w, write),
        );
        return;
    }
    for (row, range) in offsets.windows(2).enumerate() {
        let range = range[0] - offsets[0]..range[1] - offsets[0];
        write(first + row, &mut indices[range.clone()], &mut values[range]);
    }
}

impl Csr<f64> {
    /// The row scales `s_i = Σ_k |A_ik|`.
    pub fn row_scales(&self) -> Vec<f64> {
        parallel::collect(self.rows, |i| self.row_slices(i).1.iter().map(|v| v.abs()).sum())
    }

    /// The symmetric part `½(A + Aᵀ)`.
    pub fn symmetric_part(&self) -> Self {
        self.add(&self.transpose()).map(|_, _, v| 0.5 * v)
    }

    /// The exact rational twin of the matrix; `None` if an entry is not finite.
    pub fn exact(&self) -> Option<Csr<crate::scalar::Rational>> {
        if self.values.iter().any(|v| !v.is_finite()) {
            return None;
        }
        Some(self.map(|_, _, v| Scalar::exactly(*v).unwrap_or_else(Scalar::zero)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Csr {
        Csr::from_triplets(3, 4, &[(2, 1, 1.0), (0, 3, 2.0), (0, 0, 5.0), (2, 1, 0.5), (1, 2, -1.0)])
    }

    #[test]
    fn triplets_of_one_place_are_added_and_columns_ascend() {
        let a = sample();
        assert_eq!(
            a.entries().map(|(i, j, v)| (i, j, *v)).collect::<Vec<_>>(),
            [(0, 0, 5.0), (0, 3, 2.0), (1, 2, -1.0), (2, 1, 1.5)]
        );
        assert_eq!(a.get(2, 1), Some(&1.5));
        assert_eq!(a.get(2, 2), None);
    }

    #[test]
    fn transposing_twice_gives_the_same_matrix() {
        assert_eq!(sample().transpose().transpose(), sample());
        assert_eq!(sample().transpose().at(3, 0), 2.0);
    }

    #[test]
    fn the_product_agrees_with_the_dense_sum() {
        let (a, x) = (sample(), [1.0, -2.0, 0.25, 3.0]);
        let dense: Vec<f64> = (0..3).map(|i| (0..4).map(|j| a.at(i, j) * x[j]).sum()).collect();
        assert_eq!(a.mul(&x), dense);
    }

    #[test]
    fn a_sum_stores_what_either_stores_and_a_permutation_moves_rows_and_columns_together() {
        let (a, b) = (
            Csr::from_triplets(2, 2, &[(0, 0, 1.0), (0, 1, 2.0)]),
            Csr::from_triplets(2, 2, &[(0, 1, 3.0), (1, 0, 4.0)]),
        );
        assert_eq!(a.add(&b), Csr::from_triplets(2, 2, &[(0, 0, 1.0), (0, 1, 5.0), (1, 0, 4.0)]));
        let order = [2, 0, 1];
        let square = sample().submatrix(&order, &order);
        assert_eq!(sample().submatrix(&[0, 1, 2], &[0, 1, 2]).permuted(&order), square);
    }

    #[test]
    fn a_submatrix_takes_rows_and_columns_in_the_order_given() {
        let b = sample().submatrix(&[2, 0], &[3, 1]);
        assert_eq!((b.rows(), b.columns()), (2, 2));
        assert_eq!((b.at(0, 1), b.at(1, 0), b.at(1, 1)), (1.5, 2.0, 0.0));
    }
}
