//! FIN: every entry of both matrices is a finite number.
//!
//! # Definition
//! No `L_ij` and no `M_ij` is NaN or ±∞. Decided literally. Every other property takes it for granted and is not
//! applicable where it fails.

use super::evidence::{Evidence, Statement, Which};
use super::verdict::{Level, Tally};
use super::{Property, Question, Trial, Verdict};

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "FIN",
    name: "finite entries",
    statement: "no entry of L or M is NaN or infinite",
    sources: &[],
    question: Question::Operator(check),
};

fn check(trial: &Trial) -> Verdict {
    let stiffness = [(Which::Stiffness, trial.operator.stiffness())];
    let mass = trial.operator.mass().map(|m| (Which::Mass, m.matrix()));
    let mut tally = Tally::default();
    let mut first = None;
    for (matrix, values) in stiffness.into_iter().chain(mass) {
        if values.values().iter().all(|v| v.is_finite()) {
            tally.total += values.stored();
            continue;
        }
        for (i, j, v) in values.entries() {
            tally.total += 1;
            if !v.is_finite() {
                tally.violations += 1;
                first.get_or_insert(Statement::NotFinite { matrix, i, j, value: v.to_string() });
            }
        }
    }
    match first {
        Some(witness) => Verdict::fails(Level::Exact, Evidence::bare(witness)),
        None => {
            Verdict::holds(Level::Exact, Evidence::bare(Statement::Scan { checked: tally.total, worst: Vec::new() }))
        }
    }
    .with_tally(tally)
}
