//! MVP: the mean value property at interior vertices.
//!
//! # Definition
//! A function with `(Lu)_i = 0` has at i a convex combination of the values around: `L_ii > 0`, `ω_ij / L_ii ≥ 0` for all
//! j ≠ i, and `Σ_j ω_ij / L_ii = 1`, that is, row i sums to zero. Signs are read as in [POS0](super::pos0), sums as in
//! [NULL](super::null). Isolated vertices have nothing around them and are left out.

use super::evidence::{Evidence, Statement};
use super::excerpt;
use super::measure::row;
use super::measure::scan::Scan;
use super::tolerance::Threshold;
use super::verdict::Level;
use super::{Property, Question, Trial, Verdict};
use crate::operator::Signs;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "MVP",
    name: "mean value property",
    statement: "ω_ij / L_ii ≥ 0 and Σ_j ω_ij / L_ii = 1 at every interior vertex",
    sources: &["floater2003", "wardetzky2007"],
    question: Question::Operator(check),
};

/// What is wrong with a row.
#[derive(Clone, Copy, Debug)]
enum Fault {
    /// The row does not sum to zero.
    Sum,
    /// The weight to this vertex is negative; the vertex itself stands for its diagonal.
    Weight(usize),
}

fn check(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let (matrix, boundary, stencil) = (trial.operator.stiffness(), trial.domain.boundary(), trial.stencil());
    // Computed before threads ask for them.
    trial.scales();
    let scan = Scan::over(matrix.rows(), |i, scan: &mut Scan<(usize, Fault)>| {
        if !boundary[i] && !stencil.neighbours(i).is_empty() {
            let (fault, residual, threshold) = worst_of_row(trial, i, row::compensated_sum(matrix, i));
            scan.look((i, fault), residual, threshold);
        }
    });
    if scan.is_empty() {
        return Verdict::not_applicable("there is no interior vertex with a neighbour");
    }
    let mut verdict = scan.verdict(
        Level::Measured,
        |&(i, _)| vec![i],
        |found| {
            let (i, fault) = found.place;
            let statement = match fault {
                Fault::Sum => Statement::RowSum { i, threshold: found.threshold.defect },
                Fault::Weight(j) => Statement::NotConvex { i, j },
            };
            Evidence::new(statement, excerpt::of_rows(trial, [i]))
        },
    );
    let by_sign = verdict.evidence().is_some_and(|e| matches!(e.statement, Statement::NotConvex { .. }));
    if by_sign && trial.operator.signs() == Signs::Exact {
        verdict.level = Level::Exact;
    }
    verdict
}

fn worst_of_row(trial: &Trial, i: usize, sum: f64) -> (Fault, f64, Threshold) {
    let diagonal = trial.operator.stiffness().at(i, i);
    if diagonal <= 0.0 {
        return (Fault::Weight(i), f64::INFINITY, Threshold::NONE);
    }
    let rank =
        |(_, residual, threshold): &(Fault, f64, Threshold)| (threshold.judge(*residual), threshold.margin(*residual));
    let mut worst = (Fault::Sum, sum.abs(), trial.scales().row(i));
    let matrix = trial.operator.stiffness();
    // The diagonal is positive: is anything else?
    if matrix.row_slices(i).1.iter().filter(|v| **v > 0.0).count() == 1 {
        return worst;
    }
    for (j, v, link) in trial.stencil().row(matrix, i).filter(|&(j, v, _)| j != i && v > 0.0) {
        let threshold = match trial.operator.signs() {
            Signs::Exact => Threshold::NONE,
            Signs::Rounded => trial.scales().sign(i, v, link.edge()),
        };
        let found = (Fault::Weight(j), v, threshold);
        if rank(&found) > rank(&worst) {
            worst = found;
        }
    }
    worst
}
