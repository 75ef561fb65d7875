//! How far the matrix that was really factorised is from the one that was meant.
//!
//! The computed factors are the exact factors of `A + E` with `|E| ≤ γ_k |L||D||Lᵀ|` entrywise, `γ_k = k u/(1 − k u)`. By
//! Sylvester's law the signs of D are the inertia of `A + E` itself, so a bound for E relative to `diag(s)` is all that an
//! inertia count needs (Demmel 1989; Rump 2006).
//!
//! # The constant
//! Let m be the largest number of entries in a row of L, the one on the diagonal included. `l_ij d_j = a_ij − Σ l_ik d_k l_jk` has at
//! most m − 1 products, and *in whatever order* they are summed, blocked, or fused with the sum, `γ_m` covers sums, products and
//! one division (Higham 2002, lemma 8.4). The order of elimination does not enter, nor do the dense blocks of the supernodal code:
//! their matrix products are sums of all the products, their triangular solves have a unit diagonal and substitute, and the zeros
//! that fill a block up are entries of L like others, their products exact. Added to m are one each for
//!
//! 1. the third factor `d_k`, multiplied in beforehand or divided out afterwards;
//! 2. the division, which is a product with the rounded reciprocal of the pivot;
//! 3. `½ (a_ij + a_ji)`, where the matrix was made symmetric: its rounding is `u |a_ij|`, and `|A| ≤ (1 + γ) |L||D||Lᵀ|`;
//! 4. the sum `a_ii + τ s_i` of a shift, likewise; the product `τ s_i` itself is off by `u τ s_i`: the 4u below;
//! 5. the evaluation of `|L||D||Lᵀ| 1` in floating point, whose terms are positive.
//!
//! So `k = m + 5`. Underflow is added: each operation may lose `2⁻¹⁰⁷⁴`.

use super::factor::Ldlt;

/// The unit roundoff 2⁻⁵³.
pub const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// The smallest positive number, 2⁻¹⁰⁷⁴.
const SMALLEST: f64 = 5e-324;

/// Higham's `γ_k = k u/(1 − k u)`: the relative error of k rounded operations in a row.
pub fn gamma(k: usize) -> f64 {
    let ku = k as f64 * UNIT_ROUNDOFF;
    ku / (1.0 - ku)
}

impl Ldlt {
    /// Visits the entries of L strictly below the diagonal, in the numbering of the elimination.
    fn visit_lower(&self, mut visit: impl FnMut(usize, usize, f64)) {
        for node in self.nodes() {
            for j in 0..node.width {
                let (own, below) = node.column(j).split_at(node.width);
                (j + 1..node.width).for_each(|i| visit(node.first + i, node.first + j, own[i]));
                node.below.iter().zip(below).for_each(|(&i, &v)| visit(i, node.first + j, v));
            }
        }
    }

    /// A bound for the largest eigenvalue of |E| relative to `diag(scales)`, E the backward error of the factorisation
    /// together with the rounding of a sum on the diagonal; infinite if a scale is not positive.
    ///
    /// For a matrix `B ≥ 0` that eigenvalue is at most `max_i (B1)_i / s_i` (Collatz and Wielandt).
    pub fn backward_error(&self, scales: &[f64]) -> f64 {
        let (n, pivots) = (self.rows(), self.pivots());
        let mut columns = vec![1.0; n];
        let mut length = vec![1_usize; n];
        self.visit_lower(|i, j, v| {
            columns[j] += v.abs();
            length[i] += 1;
        });
        let inner: Vec<f64> = columns.iter().zip(&pivots).map(|(c, d)| c * d.abs()).collect();
        let mut product = inner.clone();
        self.visit_lower(|i, j, v| product[i] += v.abs() * inner[j]);
        let worst = self
            .order()
            .iter()
            .zip(&product)
            .map(|(&row, p)| if scales[row] > 0.0 { p / scales[row] } else { f64::INFINITY })
            .fold(0.0, f64::max);
        let terms = length.into_iter().max().unwrap_or(0);
        // A product or quotient that underflows is off by 2⁻¹⁰⁷⁴, times a pivot where it is multiplied by one afterwards.
        let largest = pivots.iter().fold(1.0_f64, |m, d| m.max(d.abs()));
        let smallest = scales.iter().copied().fold(f64::INFINITY, f64::min);
        let lost = 2.0 * (n * terms) as f64 * SMALLEST * largest / smallest;
        if lost.is_nan() { f64::INFINITY } else { gamma(terms + 5) * worst + 4.0 * UNIT_ROUNDOFF + lost }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Csr;

    /// A five-point grid Laplacian of k × k vertices with a shift.
    fn grid(k: usize, shift: f64) -> Csr {
        let mut t = Vec::new();
        let mut join = |a: usize, b: usize| t.extend([(a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)]);
        for r in 0..k {
            for c in 0..k {
                if c + 1 < k {
                    join(r * k + c, r * k + c + 1);
                }
                if r + 1 < k {
                    join(r * k + c, (r + 1) * k + c);
                }
            }
        }
        t.extend((0..k * k).map(|i| (i, i, shift)));
        Csr::from_triplets(k * k, k * k, &t)
    }

    #[test]
    fn the_product_of_the_factors_is_the_matrix_within_the_bound() {
        // 5 × 5 runs the simplicial code, 80 × 80 the supernodal one.
        for k in [5, 80] {
            let a = grid(k, 0.25);
            let factor = Ldlt::new(&a).unwrap();
            let (order, pivots) = (factor.order(), factor.pivots());
            // L D Lᵀ x against A x for a test vector, in the numbering of the elimination.
            let x: Vec<f64> = (0..k * k).map(|i| (i as f64).sin()).collect();
            let permuted: Vec<f64> = order.iter().map(|&i| x[i]).collect();
            let mut y = permuted.clone();
            factor.visit_lower(|i, j, v| y[j] += v * permuted[i]);
            y.iter_mut().zip(&pivots).for_each(|(y, d)| *y *= d);
            let mut z = y.clone();
            factor.visit_lower(|i, j, v| z[i] += v * y[j]);
            let (expected, scales) = (a.mul(&x), a.row_scales());
            let bound = factor.backward_error(&scales);
            assert!(bound < 1e-12, "{bound:e} is no longer rounding");
            for (at, &row) in order.iter().enumerate() {
                assert!((z[at] - expected[row]).abs() <= bound * 8.0 * scales[row], "row {row}");
            }
        }
    }

    #[test]
    fn a_row_without_scale_has_no_bound() {
        let factor = Ldlt::new(&Csr::diagonal(&[1.0, 1.0])).unwrap();
        assert_eq!(factor.backward_error(&[1.0, 0.0]), f64::INFINITY);
    }
}
