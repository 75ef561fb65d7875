//! What a row says by itself: whether its weights have one sign, what it sums to, whether it mirrors its column.

use super::compensated::Sum;
use super::tolerance::{Threshold, agree};
use crate::linalg::{Csr, parallel};

/// Whether there is no negative weight in a row: every entry off the diagonal is at most zero.
pub(crate) fn no_negative_weight(matrix: &Csr, i: usize) -> bool {
    matrix.row(i).all(|(j, v)| i == j || *v <= 0.0)
}

/// The sum of a row.
pub(crate) fn sum(matrix: &Csr, i: usize) -> f64 {
    matrix.row(i).map(|(_, v)| *v).sum()
}

/// The sum of a row, in twice the working precision.
pub(crate) fn compensated_sum(matrix: &Csr, i: usize) -> f64 {
    matrix.row_slices(i).1.iter().copied().collect::<Sum>().value()
}

/// The sum of each row, in twice the working precision.
pub(crate) fn compensated_sums(matrix: &Csr) -> Vec<f64> {
    parallel::collect(matrix.rows(), |i| compensated_sum(matrix, i))
}

/// Whether the row sum vanishes up to the rounding of a sum on the diagonal.
pub(crate) fn sum_vanishes(matrix: &Csr, i: usize) -> bool {
    let size = matrix.row(i).map(|(_, v)| v.abs()).sum();
    sum(matrix, i).abs() <= Threshold::of_sum(size, matrix.row(i).len()).explained
}

/// Whether every entry agrees with its mirror image, as a number that is computed twice does.
pub(crate) fn is_symmetric(matrix: &Csr) -> bool {
    matrix.entries().all(|(i, j, v)| agree(*v, matrix.at(j, i)))
}
