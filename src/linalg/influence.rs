//! Bounds of `|A⁻¹| w` for matrices that are too large to be inverted.
//!
//! # H-matrices
//! The comparison matrix ⟨A⟩ has `|a_ii|` on the diagonal and `−|a_ij|` off it. If `⟨A⟩ z > 0` for some `z > 0`, it is an M-matrix, A is
//! regular and `|A⁻¹| ≤ ⟨A⟩⁻¹` (Ostrowski 1937). So `⟨A⟩ z ≥ β w` gives `|A⁻¹| w ≤ z / β`. z is the computed solution of `⟨A⟩ z = w`; that it
//! is positive, and the product of which with ⟨A⟩ rounds at most `γ_(m+1) |⟨A⟩| z`, is checked, so nothing is believed of the solve.
//!
//! # Positive definite matrices
//! With `A ⪰ g S`, `S = diag(s)` the row scales, and `|r| ≤ w`, Cauchy and Schwarz give
//! `|(A⁻¹ r)_i|² ≤ (A⁻¹)_ii · rᵀ A⁻¹ r ≤ (1 / g s_i) · Σ_k w_k² / g s_k`. g is bounded from below by a factorisation of `A − σS` with
//! positive pivots: `g = σ − ε`, ε its backward error ([`backward`](super::backward)); σ is half of an estimate of the smallest
//! eigenvalue by inverse iteration. On a mesh of n vertices this is about √n times too large.

use super::Csr;
use super::backward::{UNIT_ROUNDOFF, gamma};
use super::factor::{Ldlt, Lu};

/// Steps of the inverse iteration: the estimate need only be within a factor of two.
const STEPS: usize = 12;

/// The comparison matrix of an H-matrix, factorised.
pub(super) struct Comparison {
    matrix: Csr,
    factor: Solve,
    longest_row: usize,
}

enum Solve {
    Symmetric(Ldlt),
    General(Lu),
}

impl Comparison {
    /// Of a square matrix; `None` unless the weights show that it is an H-matrix.
    pub(super) fn of(matrix: &Csr, weights: &[f64]) -> Option<Self> {
        let compared = matrix.map(|i, j, v| if i == j { v.abs() } else { -v.abs() });
        let symmetric = compared.entries().all(|(i, j, v)| compared.at(j, i) == *v);
        let factor = if symmetric {
            Solve::Symmetric(Ldlt::new(&compared).ok().filter(|f| f.pivots().iter().all(|d| *d > 0.0))?)
        } else {
            Solve::General(Lu::new(&compared).ok()?)
        };
        let longest_row = (0..matrix.rows()).map(|i| matrix.row(i).len()).max().unwrap_or(0);
        let comparison = Comparison { matrix: compared, factor, longest_row };
        comparison.influence(weights).iter().all(|g| g.is_finite()).then_some(comparison)
    }

    /// A bound of `|A⁻¹| w`; infinite where the weights show nothing.
    pub(super) fn influence(&self, weights: &[f64]) -> Vec<f64> {
        let mut column = [weights.to_vec()];
        match &self.factor {
            Solve::Symmetric(f) => f.solve(&mut column),
            Solve::General(f) => f.solve(&mut column),
        }
        let [z] = column;
        let slack = gamma(self.longest_row + 2);
        let mut beta = if z.iter().all(|z| *z > 0.0 && z.is_finite()) { f64::INFINITY } else { 0.0 };
        for (i, w) in weights.iter().enumerate() {
            let (mut image, mut size) = (0.0, 0.0);
            for (j, v) in self.matrix.row(i) {
                image += v * z[j];
                size += (v * z[j]).abs();
            }
            beta = f64::min(beta, (image - slack * size) / w);
        }
        let bound = |z: f64| z / beta * (1.0 + 8.0 * UNIT_ROUNDOFF);
        z.iter().map(|&z| if beta > 0.0 { bound(z) } else { f64::INFINITY }).collect()
    }
}

/// A lower bound for the eigenvalues of a positive definite matrix relative to its row scales.
pub(super) struct Gap {
    scales: Vec<f64>,
    gap: f64,
}

impl Gap {
    /// Of a symmetric matrix and its factorisation; `None` if no positive bound was found.
    pub(super) fn of(matrix: &Csr, factor: &Ldlt) -> Option<Self> {
        let scales = matrix.row_scales();
        let shift = 0.5 * smallest_eigenvalue(matrix, factor, &scales);
        let lowered: Vec<f64> = scales.iter().map(|s| -shift * s).collect();
        let factor = Ldlt::new(&matrix.add(&Csr::diagonal(&lowered))).ok()?;
        let gap = shift - factor.backward_error(&scales);
        (gap > 0.0 && factor.pivots().iter().all(|d| *d > 0.0)).then_some(Gap { scales, gap })
    }

    /// A bound of `|A⁻¹| w`.
    pub(super) fn influence(&self, weights: &[f64]) -> Vec<f64> {
        let energy: f64 = weights.iter().zip(&self.scales).map(|(w, s)| w * (w / s)).sum();
        let more = 1.0 + gamma(weights.len() + 8);
        self.scales.iter().map(|s| (energy / s).sqrt() / self.gap * more).collect()
    }
}

/// An estimate from above of the smallest eigenvalue of `A x = λ diag(s) x`, by inverse iteration from a vector of no symmetry.
fn smallest_eigenvalue(matrix: &Csr, factor: &Ldlt, scales: &[f64]) -> f64 {
    let mut x: Vec<f64> = (0..scales.len()).map(|i| 1.0 + 0.5 * (i as f64).sin()).collect();
    for _ in 0..STEPS {
        let mut column = [x.iter().zip(scales).map(|(x, s)| x * s).collect::<Vec<f64>>()];
        factor.solve(&mut column);
        let size = column[0].iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        x = column[0].iter().map(|v| v / size).collect();
    }
    let norm: f64 = x.iter().zip(scales).map(|(x, s)| x * x * s).sum();
    matrix.quadratic_form(&x) / norm
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::certified::Certified;

    /// A grid of k × k vertices with fixed values around it; every seventh weight along rows is `w`, the others 1.
    fn grid(k: usize, w: f64) -> Csr {
        let mut t = Vec::new();
        let mut join = |a: usize, b: usize, w: f64| t.extend([(a, a, w), (b, b, w), (a, b, -w), (b, a, -w)]);
        for r in 0..k {
            for c in 0..k {
                if c + 1 < k {
                    join(r * k + c, r * k + c + 1, if (r * k + c) % 7 == 0 { w } else { 1.0 });
                }
                if r + 1 < k {
                    join(r * k + c, (r + 1) * k + c, 1.0);
                }
            }
        }
        let rim = |i: usize| [i / k == 0, i / k + 1 == k, i % k == 0, i % k + 1 == k].iter().filter(|b| **b).count();
        t.extend((0..k * k).map(|i| (i, i, rim(i) as f64)));
        Csr::from_triplets(k * k, k * k, &t)
    }

    #[test]
    fn both_bounds_cover_the_whole_inverse() {
        // 20 × 20 is inverted by the other path. A weight of −0.3 makes the matrix no M-matrix, and no H-matrix.
        for w in [1.0, -0.3] {
            let a = grid(20, w);
            let weights: Vec<f64> =
                a.row_scales().iter().enumerate().map(|(i, s)| s * (1.0 + (i % 3) as f64)).collect();
            let whole = Certified::new(a.clone(), weights.clone()).unwrap();
            let gap = Gap::of(&a, &Ldlt::new(&a).unwrap()).unwrap().influence(&weights);
            // One bound for all rows alike: about √n = 20 times the largest.
            let largest = whole.influence().iter().copied().fold(0.0, f64::max);
            for (i, g) in gap.iter().enumerate() {
                assert!(*g >= whole.influence()[i] && *g <= 60.0 * largest, "w = {w}, row {i}: {g:e} for {largest:e}");
            }
            match Comparison::of(&a, &weights) {
                Some(comparison) => {
                    for (g, exact) in comparison.influence(&weights).iter().zip(whole.influence()) {
                        assert!((g / exact - 1.0).abs() < 1e-9);
                    }
                }
                None => assert!(w < 0.0),
            }
        }
    }

    #[test]
    fn a_few_small_negative_weights_leave_an_h_matrix_whose_bound_covers_the_inverse() {
        let a = grid(15, -1e-4);
        let weights = vec![1.0; 225];
        let bound = Comparison::of(&a, &weights).unwrap().influence(&weights);
        let whole = Certified::new(a, weights).unwrap();
        assert!(bound.iter().zip(whole.influence()).all(|(g, exact)| *g >= exact * (1.0 - 1e-10) && *g < 2.0 * exact));
    }

    #[test]
    fn a_singular_matrix_and_an_indefinite_one_have_no_bound() {
        let free = Csr::from_triplets(2, 2, &[(0, 0, 1.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 1.0)]);
        assert!(Comparison::of(&free, &[1.0; 2]).is_none());
        let crossed = Csr::from_triplets(2, 2, &[(0, 0, 1.0), (0, 1, -2.0), (1, 0, -2.0), (1, 1, 1.0)]);
        assert!(Comparison::of(&crossed, &[1.0; 2]).is_none());
    }
}
