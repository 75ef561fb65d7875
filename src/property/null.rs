//! NULL: constants are in the kernel.
//!
//! # Definition
//! `L 1 = 0`: the residual of row i is `|Σ_j L_ij|`, summed in twice the working precision, against the row scale
//! `s_i = Σ_j |L_ij|`.

use super::evidence::{Evidence, Statement};
use super::excerpt;
use super::measure::row;
use super::measure::scan::Scan;
use super::verdict::Level;
use super::{Property, Question, Trial, Verdict};

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "NULL",
    name: "constants in the kernel",
    statement: "L 1 = 0",
    sources: &["wardetzky2007"],
    question: Question::Operator(check),
};

fn check(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let (matrix, scales) = (trial.operator.stiffness(), trial.scales());
    let scan = Scan::over(matrix.rows(), |i, scan: &mut Scan<usize>| {
        scan.look(i, row::compensated_sum(matrix, i).abs(), scales.row(i));
    });
    scan.verdict(
        Level::Measured,
        |&i| vec![i],
        |found| {
            let (i, threshold) = (found.place, found.threshold.defect);
            Evidence::new(Statement::RowSum { i, threshold }, excerpt::of_rows(trial, [i]))
        },
    )
}
