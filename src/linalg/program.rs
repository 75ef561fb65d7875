//! Linear programs in floating point: the only place that names a type of `clarabel`.
//!
//! What comes out is a proposal. It is rounded and verified exactly where it is used, and what does not survive that is
//! decided by the exact [`simplex`](super::simplex).

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, SupportedConeT, ZeroConeT,
};

use super::Csr;

/// Which unknowns of `A x = 0`, `x ≥ 0` can be positive, with a solution and multipliers that show it.
#[derive(Clone, Debug, PartialEq)]
pub struct Split {
    /// A solution, at least 1 where it can be positive.
    pub solution: Vec<f64>,
    /// `y` with `Aᵀy ≥ 0`, at least 1 where the solution cannot be positive.
    pub multipliers: Vec<f64>,
    /// For each unknown, whether it can be positive.
    pub carried: Vec<bool>,
}

/// Splits the unknowns of `A x = 0`, `x ≥ 0` into those that some solution makes positive and the others: the largest
/// `Σ s` with `0 ≤ s ≤ 1`, `s ≤ x` (Goldman and Tucker). `None` where the solver does not come to an end.
///
/// Cost: some twenty to thirty sparse factorisations.
pub fn split(a: &Csr) -> Option<Split> {
    let (rows, n) = (a.rows(), a.columns());
    let mut entries: Vec<_> = a.entries().map(|(i, j, v)| (i, j, *v)).collect();
    for k in 0..n {
        entries.push((rows + k, k, -1.0));
        entries.push((rows + k, n + k, 1.0));
        entries.push((rows + n + k, n + k, -1.0));
        entries.push((rows + 2 * n + k, n + k, 1.0));
    }
    let mut right = vec![0.0; rows + 3 * n];
    right[rows + 2 * n..].fill(1.0);
    let mut costs = vec![0.0; 2 * n];
    costs[n..].fill(-1.0);
    let (x, multipliers) = solve(2 * n, &costs, &entries, &right, rows)?;
    let carried = (0..n).map(|k| x[n + k] > 0.5).collect();
    Some(Split { solution: x[..n].to_vec(), multipliers: multipliers[..rows].to_vec(), carried })
}

/// The `x` with `A x = 0` and `c·x = 1` whose smallest component is largest, and that component. `None` where the solver does
/// not come to an end.
pub fn largest_minimum(a: &Csr, c: &[f64]) -> Option<(Vec<f64>, f64)> {
    let (rows, n) = (a.rows(), a.columns());
    let mut entries: Vec<_> = a.entries().map(|(i, j, v)| (i, j, *v)).collect();
    entries.extend(c.iter().enumerate().map(|(k, &c)| (rows, k, c)));
    for k in 0..n {
        entries.push((rows + 1 + k, k, -1.0));
        entries.push((rows + 1 + k, n, 1.0));
    }
    let mut right = vec![0.0; rows + 1 + n];
    right[rows] = 1.0;
    let mut costs = vec![0.0; n + 1];
    costs[n] = -1.0;
    let (mut x, _) = solve(n + 1, &costs, &entries, &right, rows + 1)?;
    let smallest = x.pop()?;
    Some((x, smallest))
}

/// Minimises `costs·x` under `A x = right` in the first `equations` rows and `A x ≤ right` in the others: solution and
/// multipliers.
fn solve(
    unknowns: usize,
    costs: &[f64],
    entries: &[(usize, usize, f64)],
    right: &[f64],
    equations: usize,
) -> Option<(Vec<f64>, Vec<f64>)> {
    let column = |pick: fn(&(usize, usize, f64)) -> usize| entries.iter().map(pick).collect::<Vec<_>>();
    let values = entries.iter().map(|e| e.2).collect();
    let matrix = CscMatrix::new_from_triplets(right.len(), unknowns, column(|e| e.0), column(|e| e.1), values);
    let cones: [SupportedConeT<f64>; 2] = [ZeroConeT(equations), NonnegativeConeT(right.len() - equations)];
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .max_iter(200)
        .tol_gap_abs(1e-11)
        .tol_gap_rel(1e-11)
        .tol_feas(1e-11)
        .build()
        .ok()?;
    let quadratic = CscMatrix::zeros((unknowns, unknowns));
    let mut solver = DefaultSolver::new(&quadratic, costs, &matrix, right, &cones, settings).ok()?;
    solver.solve();
    let ended = matches!(
        solver.solution.status,
        SolverStatus::Solved
            | SolverStatus::AlmostSolved
            | SolverStatus::InsufficientProgress
            | SolverStatus::MaxIterations
    );
    let finite = |list: &[f64]| list.iter().all(|v| v.is_finite());
    (ended && finite(&solver.solution.x) && finite(&solver.solution.z))
        .then(|| (solver.solution.x.clone(), solver.solution.z.clone()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_two_coupled_and_one_lone_unknown_the_lone_one_cannot_be_positive() {
        // x₀ = x₁ and x₂ = 0.
        let a = Csr::from_triplets(2, 3, &[(0, 0, 1.0), (0, 1, -1.0), (1, 2, 1.0)]);
        let split = split(&a).unwrap();
        assert_eq!(split.carried, [true, true, false]);
        assert!(split.solution[0] > 0.99 && (split.solution[0] - split.solution[1]).abs() < 1e-9);
        assert!(split.multipliers[1] > 0.99 && split.multipliers[0].abs() < 1e-6);
    }

    #[test]
    fn the_largest_minimum_shares_a_budget_evenly_where_nothing_forbids_it() {
        let a = Csr::from_triplets(1, 3, &[(0, 0, 1.0), (0, 1, -1.0)]);
        let (x, smallest) = largest_minimum(&a, &[1.0, 1.0, 2.0]).unwrap();
        assert!((smallest - 0.25).abs() < 1e-9 && x.iter().all(|x| (x - 0.25).abs() < 1e-8), "{x:?}");
        // x₀ + x₁ = 0 leaves no positive pair; the best smallest component is zero, with x₂ taking the budget.
        let a = Csr::from_triplets(1, 3, &[(0, 0, 1.0), (0, 1, 1.0)]);
        let (_, smallest) = largest_minimum(&a, &[1.0, 1.0, 2.0]).unwrap();
        assert!(smallest.abs() < 1e-9);
    }
}
