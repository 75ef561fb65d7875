//! A linear solver that says how far each component of a solution can be off.
//!
//! # Definition
//! With weights `v > 0` on the rows and `g = |A⁻¹| v`, a computed solution x of `A x* = b` whose residual is at most `τ v` row by
//! row satisfies `|x − x*| ≤ τ g`. The same g tells what a perturbation of the matrix with rows at most `v` does.
//!
//! # Accuracy
//! Up to [`LARGEST_INVERSE`] unknowns g is a bound: from the computed inverse Y and `E = I − AY`,
//! `|A⁻¹| v ≤ |Y| v / (1 − η)`, `η = max_k (|E| v)_k / v_k` with the rounding of the product included (Rump 2010, section 10).
//! Above, [`influence`](super::influence) gives a bound where A is an H-matrix or positive definite. Elsewhere g is three times the
//! estimate of `‖A⁻¹ diag(v)‖_∞` of Hager (1984) and Higham (2002, section 15.3), the same for all rows: a measurement, not a bound.

use super::Csr;
use super::backward::gamma;
use super::factor::{FactorError, Ldlt, Lu};
use super::influence::{Comparison, Gap};

/// Up to this size the influence of each row on each unknown is bounded by way of the whole inverse.
pub const LARGEST_INVERSE: usize = 512;

/// Right-hand sides solved together.
const BLOCK: usize = 32;

enum Factor {
    Symmetric(Ldlt),
    General(Lu),
}

/// How the influence is found.
enum Means {
    /// By the whole inverse.
    Inverse,
    /// By the comparison matrix of an H-matrix.
    Comparison(Box<Comparison>),
    /// By the smallest eigenvalue of a positive definite matrix.
    Gap(Gap),
    /// By an estimate.
    Estimate,
}

/// A factorised matrix with a bound on what residuals do to its solutions.
pub struct Certified {
    matrix: Csr,
    factor: Factor,
    weights: Vec<f64>,
    influence: Vec<f64>,
    means: Means,
    longest_row: usize,
}

impl Certified {
    /// Factorises and bounds `g = |A⁻¹| v` for the weights v.
    ///
    /// # Errors
    /// A matrix that is not square or not finite, or singular to working precision.
    pub fn new(matrix: Csr, weights: Vec<f64>) -> Result<Self, FactorError> {
        let factor = match symmetric_factor(&matrix) {
            Some(factor) => Factor::Symmetric(factor),
            None => Factor::General(Lu::new(&matrix)?),
        };
        let longest_row = (0..matrix.rows()).map(|i| matrix.row(i).len()).max().unwrap_or(0);
        let means = if matrix.rows() <= LARGEST_INVERSE { Means::Inverse } else { means(&matrix, &factor, &weights) };
        let mut solver = Certified { matrix, factor, weights, influence: Vec::new(), means, longest_row };
        solver.influence = solver.influence_of(&solver.weights);
        let sound = solver.influence.iter().all(|g| g.is_finite());
        if sound { Ok(solver) } else { Err(FactorError::Singular) }
    }

    /// Whether the influence is a bound rather than an estimate.
    pub fn is_rigorous(&self) -> bool {
        !matches!(self.means, Means::Estimate)
    }

    /// `g = |A⁻¹| v`, bounded or estimated.
    pub fn influence(&self) -> &[f64] {
        &self.influence
    }

    /// `|A⁻¹| w` for other weights w, bounded or estimated; infinite where it cannot be bounded.
    pub fn influence_of(&self, weights: &[f64]) -> Vec<f64> {
        match &self.means {
            Means::Inverse => self.bounded_influence(weights),
            Means::Comparison(comparison) => comparison.influence(weights),
            Means::Gap(gap) => gap.influence(weights),
            Means::Estimate => self.estimated_influence(weights),
        }
    }

    /// Solves for the columns of B, which are replaced, and returns for each its τ: `|x − x*| ≤ τ g`. Infinite where the
    /// solution is not finite.
    pub fn solve(&self, columns: &mut [Vec<f64>]) -> Vec<f64> {
        let right: Vec<Vec<f64>> = columns.to_vec();
        self.raw(columns, false);
        let mut errors: Vec<f64> = right.iter().zip(columns.iter()).map(|(b, x)| self.residual(b, x).0).collect();
        for ((b, x), error) in right.iter().zip(columns.iter_mut()).zip(&mut errors) {
            // Beyond the rounding of a unit solution one step of refinement is worth its cost.
            if *error > 1.0 {
                let mut correction = [self.residual(b, x).1];
                self.raw(&mut correction, false);
                let better: Vec<f64> = x.iter().zip(&correction[0]).map(|(x, d)| x + d).collect();
                let found = self.residual(b, &better).0;
                if found < *error {
                    (*x, *error) = (better, found);
                }
            }
        }
        errors
    }

    fn raw(&self, columns: &mut [Vec<f64>], transposed: bool) {
        for block in columns.chunks_mut(BLOCK) {
            match (&self.factor, transposed) {
                (Factor::Symmetric(f), _) => f.solve(block),
                (Factor::General(f), false) => f.solve(block),
                (Factor::General(f), true) => f.solve_transpose(block),
            }
        }
    }

    /// The largest residual over its weight, the rounding of its computation included; and the residual.
    fn residual(&self, b: &[f64], x: &[f64]) -> (f64, Vec<f64>) {
        let slack = gamma(self.longest_row + 2);
        let (mut worst, mut residual) = (0.0_f64, Vec::with_capacity(b.len()));
        for (k, &b) in b.iter().enumerate() {
            let (mut r, mut size) = (b, b.abs());
            for (j, v) in self.matrix.row(k) {
                r -= v * x[j];
                size += (v * x[j]).abs();
            }
            let bound = (r.abs() + slack * size) / self.weights[k];
            worst = if bound.is_nan() { f64::INFINITY } else { worst.max(bound) };
            residual.push(r);
        }
        (worst, residual)
    }

    fn bounded_influence(&self, weights: &[f64]) -> Vec<f64> {
        let n = self.matrix.rows();
        let (mut sum, mut defect) = (vec![0.0; n], vec![0.0; n]);
        let slack = gamma(self.longest_row + 2);
        for start in (0..n).step_by(BLOCK) {
            let mut block: Vec<Vec<f64>> = (start..n.min(start + BLOCK)).map(|k| unit(n, k)).collect();
            self.raw(&mut block, false);
            for (k, column) in (start..).zip(&block) {
                let weight = weights[k];
                for i in 0..n {
                    sum[i] += column[i].abs() * weight;
                    let (mut r, mut size) = (f64::from(i == k), f64::from(i == k));
                    for (j, v) in self.matrix.row(i) {
                        r -= v * column[j];
                        size += (v * column[j]).abs();
                    }
                    defect[i] += (r.abs() + slack * size) * weight;
                }
            }
        }
        // The sums of n terms and the quotients carry n + 2 roundings more.
        let more = 1.0 + gamma(n + 4);
        let eta = more * defect.iter().zip(weights).map(|(d, v)| d / v).fold(0.0, f64::max);
        let factor = more / (1.0 - eta);
        let sound = eta < 0.5;
        sum.into_iter().map(|g| if sound { g * factor } else { f64::INFINITY }).collect()
    }

    /// The estimate of `‖diag(v) A⁻ᵀ‖₁` by Hager's iteration with Higham's alternating start vector as a safeguard.
    fn estimated_influence(&self, weights: &[f64]) -> Vec<f64> {
        let n = self.matrix.rows();
        let forward = |x: Vec<f64>| {
            let mut column = [x];
            self.raw(&mut column, true);
            let [y] = column;
            y.iter().zip(weights).map(|(y, v)| y * v).collect::<Vec<f64>>()
        };
        let backward = |x: &[f64]| {
            let mut column = [x.iter().zip(weights).map(|(x, v)| x * v).collect::<Vec<f64>>()];
            self.raw(&mut column, false);
            let [y] = column;
            y
        };
        let size = |y: &[f64]| y.iter().map(|y| y.abs()).sum::<f64>();
        let mut x = vec![1.0 / n as f64; n];
        let (mut best, mut last) = (0.0, usize::MAX);
        for _ in 0..5 {
            let y = forward(x);
            if size(&y).is_nan() {
                return vec![f64::INFINITY; n];
            }
            if size(&y) <= best {
                break;
            }
            best = size(&y);
            let signs: Vec<f64> = y.iter().map(|y| if *y < 0.0 { -1.0 } else { 1.0 }).collect();
            let z = backward(&signs);
            let Some(at) = (0..n).max_by(|&a, &b| z[a].abs().total_cmp(&z[b].abs())) else { break };
            if at == last {
                break;
            }
            last = at;
            x = unit(n, at);
        }
        let steps = (n.max(2) - 1) as f64;
        let alternating = (0..n).map(|i| (if i % 2 == 0 { 1.0 } else { -1.0 }) * (1.0 + i as f64 / steps)).collect();
        best = best.max(2.0 * size(&forward(alternating)) / (3.0 * n as f64));
        vec![3.0 * best; n]
    }
}

/// What gives a bound for a matrix too large to be inverted.
fn means(matrix: &Csr, factor: &Factor, weights: &[f64]) -> Means {
    if let Some(comparison) = Comparison::of(matrix, weights) {
        return Means::Comparison(Box::new(comparison));
    }
    match factor {
        Factor::Symmetric(factor) => Gap::of(matrix, factor).map_or(Means::Estimate, Means::Gap),
        Factor::General(_) => Means::Estimate,
    }
}

/// The factorisation `LDLᵀ` where the matrix is symmetric and it is stable: all pivots positive.
fn symmetric_factor(a: &Csr) -> Option<Ldlt> {
    if !a.entries().all(|(i, j, v)| a.at(j, i) == *v) || !(0..a.rows()).all(|i| a.at(i, i) > 0.0) {
        return None;
    }
    Ldlt::new(a).ok().filter(|f| f.pivots().iter().all(|d| *d > 0.0))
}

fn unit(n: usize, k: usize) -> Vec<f64> {
    let mut x = vec![0.0; n];
    x[k] = 1.0;
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::rational::{Elimination, eliminate};
    use crate::scalar::Scalar;

    #[test]
    fn an_entry_above_the_diagonal_alone_is_not_taken_for_symmetric() {
        let a = Csr::from_triplets(2, 2, &[(0, 0, 2.0), (1, 1, 2.0), (0, 1, -1.0)]);
        assert!(symmetric_factor(&a).is_none());
    }

    /// A path with fixed ends, convection c: not symmetric unless c = 0.
    fn convection(n: usize, c: f64) -> Csr {
        let mut t: Vec<_> = (0..n).map(|i| (i, i, 2.0)).collect();
        t.extend((1..n).flat_map(|i| [(i, i - 1, -1.0 - c), (i - 1, i, -1.0 + c)]));
        Csr::from_triplets(n, n, &t)
    }

    #[test]
    fn the_true_solution_lies_within_the_bound() {
        for c in [0.0, 0.3, 3.0] {
            let a = convection(12, c);
            let b: Vec<f64> = (0..12).map(|k| (f64::from(k) * 0.7).cos()).collect();
            let Some(Elimination::Solution(exact)) = eliminate(&a, std::slice::from_ref(&b)) else { panic!("regular") };
            let solver = Certified::new(a, vec![1e-15; 12]).unwrap();
            let mut x = [b];
            let tau = solver.solve(&mut x)[0];
            for i in 0..12 {
                let error = (x[0][i] - exact[0][i].approximate()).abs();
                assert!(error <= tau * solver.influence()[i] * (1.0 + 1e-6), "c = {c}, row {i}: {error:e}");
                assert!(tau * solver.influence()[i] < 1e-10);
            }
        }
    }

    #[test]
    fn the_influence_of_a_fixed_path_is_the_parabola() {
        // A⁻¹ ≥ 0 and A g = 1 has the solution g_i = ½ (i + 1)(n − i).
        let n = 30;
        let solver = Certified::new(convection(n, 0.0), vec![1.0; n]).unwrap();
        for (i, g) in solver.influence().iter().enumerate() {
            let expected = 0.5 * (i as f64 + 1.0) * (n - i) as f64;
            assert!((g - expected).abs() < 1e-9 * expected && *g >= expected * (1.0 - 1e-12));
        }
    }

    #[test]
    fn the_influence_of_a_large_fixed_path_is_the_parabola_and_a_bound() {
        let n = 900;
        let solver = Certified::new(convection(n, 0.0), vec![1.0; n]).unwrap();
        assert!(solver.is_rigorous());
        for (i, g) in solver.influence().iter().enumerate() {
            let expected = 0.5 * (i as f64 + 1.0) * (n - i) as f64;
            assert!((g - expected).abs() < 1e-6 * expected && *g >= expected * (1.0 - 1e-12));
        }
    }

    #[test]
    fn the_estimate_of_a_large_matrix_that_allows_no_bound_covers_the_largest_row() {
        // With c = 3 the weights of a row are 4 and −2 and its comparison matrix is no M-matrix.
        let n = 600;
        let solver = Certified::new(convection(n, 3.0), vec![1.0; n]).unwrap();
        assert!(!solver.is_rigorous());
        let mut columns: Vec<Vec<f64>> = (0..n).map(|k| unit(n, k)).collect();
        solver.solve(&mut columns);
        let row = |i: usize| columns.iter().map(|c| c[i].abs()).sum::<f64>();
        let largest = (0..n).map(row).fold(0.0, f64::max);
        assert!(solver.influence()[0] >= largest && solver.influence()[0] <= 9.0 * largest);
    }

    #[test]
    fn a_singular_matrix_is_refused() {
        let a = Csr::from_triplets(2, 2, &[(0, 0, 1.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 1.0)]);
        assert!(Certified::new(a, vec![1.0; 2]).is_err());
    }
}
