//! How far a dense matrix is from losing rank: a rigorous lower bound of a singular value.
//!
//! # Definition
//! For an n×n matrix B, `c < n` and a matrix K of rank c at most, `σ_(n−c)(B) ≥ σ_n(B + K)` (Weyl). With the c last singular vectors
//! `K = σ₁ Σ u vᵀ` makes `C = B + K` as regular as B is apart from its kernel. R, an approximate inverse of C, gives
//! `‖C⁻¹‖_p ≤ ‖R‖_p / (1 − ρ_p)` with `ρ_p ≥ ‖I − RC‖_p` below one, p = 1 and ∞, and `σ_n(C)² ≥ 1 / (‖C⁻¹‖₁ ‖C⁻¹‖_∞)`.
//!
//! # Accuracy
//! A bound, whatever the singular vectors are worth: `fl(RC)` is off by at most `γ_n |R||C|`, and C itself, as stored, by
//! `γ_(c+3) (|B| + σ₁ Σ |u||v|ᵀ)` from a matrix that differs from B by rank c; this is subtracted, in the norm of Frobenius. It is up
//! to √n times too small. Rump 2010, section 10.

use super::backward::{UNIT_ROUNDOFF, gamma};
use super::full::{Full, SingularValues};

/// A lower bound of the singular value before the last `kernel` ones of the decomposed matrix, whose entries are each known up to
/// `entry` times their magnitude; zero or less if there is none.
pub fn singular_value_from_below(matrix: &Full, decomposed: &SingularValues, kernel: usize, entry: f64) -> f64 {
    let n = matrix.size();
    let (Some(&largest), true) = (decomposed.values.first(), kernel < n) else { return 0.0 };
    let last = n - kernel..n;
    let (mut bordered, mut defect) = (matrix.clone(), 0.0_f64);
    let slack = gamma(kernel + 3);
    for i in 0..n {
        for j in 0..n {
            let terms = || last.clone().map(|k| largest * decomposed.left[k][i] * decomposed.right[k][j]);
            let (value, size) = (terms().sum::<f64>(), terms().map(f64::abs).sum::<f64>());
            let own = matrix.at(i, j).abs();
            bordered.set(i, j, matrix.at(i, j) + value);
            defect += (entry * own + slack * (own + size)).powi(2);
        }
    }
    let weight = |k: usize| if k < n - kernel { 1.0 / decomposed.values[k] } else { 1.0 / largest };
    let inverse = Full::from_fn(n, |i, k| decomposed.right[k][i] * weight(k))
        .times(&Full::from_fn(n, |k, j| decomposed.left[k][j]));
    let product = inverse.times(&bordered);
    let magnitudes = inverse.magnitudes().times(&bordered.magnitudes());
    let residual = |i: usize, j: usize| {
        let one = f64::from(u8::from(i == j));
        // The difference rounds once, and not at all where it cancels.
        (one - product.at(i, j)).abs() * (1.0 + 2.0 * UNIT_ROUNDOFF)
            + gamma(n + 2) * magnitudes.at(i, j) * (1.0 + gamma(n))
    };
    let error = Full::from_fn(n, residual);
    let more = 1.0 + gamma(n + 4);
    let square: f64 = [(inverse.row_norm(), error.row_norm()), (inverse.column_norm(), error.column_norm())]
        .map(|(norm, rho)| if rho * more < 1.0 { norm * more / (1.0 - rho * more) } else { f64::INFINITY })
        .iter()
        .product();
    let bound = 1.0 / (square.sqrt() * more) - defect.sqrt() * (1.0 + gamma(n * n + 4));
    if bound.is_nan() { 0.0 } else { bound }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Csr;

    /// The Laplacian of a path: `σ_k = 2 − 2 cos(πk/n)`, the last one zero.
    fn path(n: usize) -> Csr {
        let mut t = Vec::new();
        for i in 1..n {
            t.extend([(i, i, 1.0), (i - 1, i - 1, 1.0), (i, i - 1, -1.0), (i - 1, i, -1.0)]);
        }
        Csr::from_triplets(n, n, &t)
    }

    #[test]
    fn the_bound_of_a_path_lies_below_the_closed_form_and_near_it() {
        for n in [3, 20, 60] {
            let a = path(n);
            let decomposed = Full::of(&a).singular_values().unwrap();
            let expected = 2.0 - 2.0 * (std::f64::consts::PI / n as f64).cos();
            let bound = singular_value_from_below(&Full::of(&a), &decomposed, 1, 0.0);
            assert!(bound <= expected && bound > expected / (2.0 * (n as f64).sqrt()), "{n}: {bound:e} {expected:e}");
            // With nothing bordered the kernel is met.
            assert!(singular_value_from_below(&Full::of(&a), &decomposed, 0, 0.0) <= 0.0);
        }
    }

    #[test]
    fn a_kernel_that_is_larger_than_stated_has_no_bound() {
        // Two paths that are not joined.
        let mut t: Vec<_> = path(8).entries().map(|(i, j, v)| (i, j, *v)).collect();
        t.extend(path(5).entries().map(|(i, j, v)| (8 + i, 8 + j, *v)));
        let a = Csr::from_triplets(13, 13, &t);
        let decomposed = Full::of(&a).singular_values().unwrap();
        assert!(singular_value_from_below(&Full::of(&a), &decomposed, 1, 0.0) <= 1e-14);
        assert!(singular_value_from_below(&Full::of(&a), &decomposed, 2, 0.0) > 0.05);
    }

    #[test]
    fn spoilt_singular_vectors_spoil_the_bound_and_not_its_truth() {
        let a = path(12);
        let mut decomposed = Full::of(&a).singular_values().unwrap();
        decomposed.right[3].iter_mut().for_each(|x| *x *= 1.3);
        decomposed.left[11].swap(0, 5);
        let expected = 2.0 - 2.0 * (std::f64::consts::PI / 12.0).cos();
        assert!(singular_value_from_below(&Full::of(&a), &decomposed, 1, 0.0) <= expected);
    }
}
