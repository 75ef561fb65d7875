//! Puts edge weights together to a stiffness matrix.

use super::BuildError;
use crate::linalg::Csr;
use crate::scalar::Scalar;

/// The two weights `[ω_ij, ω_ji]` of an edge `[i, j]`.
pub type EdgeWeights<S> = ([usize; 2], [S; 2]);

/// The matrix `L_ij = −ω_ij`, `L_ii = Σ_j ω_ij`. Weights of parallel edges are added; an edge from a vertex to itself
/// contributes nothing.
///
/// The diagonal is summed over the finished weights of the row, columns ascending: a row sum is zero up to the rounding of
/// that one sum, however the weights came about. Over the rationals it is zero. Cost: O(n + E log valence).
pub fn from_weights<S: Scalar>(vertices: usize, weights: &[EdgeWeights<S>]) -> Csr<S> {
    let mut entries = Vec::with_capacity(2 * weights.len());
    for ([i, j], [forth, back]) in weights.iter().filter(|([i, j], _)| i != j) {
        // Subtracted from zero rather than negated: a weight of zero is stored as +0.
        entries.push((*i, *j, S::zero() - forth.clone()));
        entries.push((*j, *i, S::zero() - back.clone()));
    }
    let off_diagonal = Csr::from_triplets(vertices, vertices, &entries);
    let row_sum = |i: usize| off_diagonal.row(i).fold(S::zero(), |sum, (_, v)| sum - v.clone());
    let diagonal: Vec<S> = (0..vertices).map(row_sum).collect();
    off_diagonal.add(&Csr::diagonal(&diagonal))
}

/// The same, refused if an entry is not finite.
///
/// # Errors
/// The first entry that is NaN or infinite.
pub fn finite(laplacian: &'static str, vertices: usize, weights: &[EdgeWeights<f64>]) -> Result<Csr, BuildError> {
    let matrix = from_weights(vertices, weights);
    check_finite(laplacian, &matrix)?;
    Ok(matrix)
}

/// Refuses a matrix with an entry that is not finite.
///
/// # Errors
/// The first entry that is NaN or infinite.
pub fn check_finite(laplacian: &'static str, matrix: &Csr) -> Result<(), BuildError> {
    match matrix.entries().find(|(_, _, v)| !v.is_finite()) {
        Some((i, j, value)) => Err(BuildError::NotFinite { laplacian, i, j, value: value.to_string() }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parallel_edges_add_up_and_loops_vanish() {
        let l = from_weights(2, &[([0, 1], [1.0, 2.0]), ([0, 1], [0.5, 0.25]), ([1, 1], [7.0, 7.0])]);
        assert_eq!([l.at(0, 0), l.at(0, 1), l.at(1, 0), l.at(1, 1)], [1.5, -1.5, -2.25, 2.25]);
    }

    #[test]
    fn a_zero_weight_is_stored_as_positive_zero() {
        let l = from_weights(2, &[([0, 1], [0.0, 0.0])]);
        assert!(l.get(0, 1).is_some_and(|v| *v == 0.0 && v.is_sign_positive()));
    }

    #[test]
    fn an_infinite_weight_is_refused_with_its_place() {
        let refusal = finite("x", 2, &[([0, 1], [1.0, f64::INFINITY])]).unwrap_err();
        assert!(matches!(refusal, BuildError::NotFinite { i: 1, j: 0, .. }), "{refusal}");
    }
}
