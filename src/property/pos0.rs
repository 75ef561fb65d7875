//! POS0: no weight on an interior edge is negative.
//!
//! # Definition
//! `ω_ij = −L_ij ≥ 0` on every interior edge: the weak form of [POS](super::pos). A weight that rounding cannot tell from
//! zero counts among the `zeros`.

use super::measure::weights::Class;
use super::{Property, Question, Trial, Verdict};

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "POS0",
    name: "non-negative weights",
    statement: "ω_ij ≥ 0 on every interior edge",
    sources: &["wardetzky2007", "bobenko-springborn2007"],
    question: Question::Operator(check),
};

fn check(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let surveys = trial.surveys();
    if surveys.weak.tally.total == 0 {
        return Verdict::not_applicable("there is no interior edge");
    }
    let verdict = surveys.weak.decide(trial, &[Class::Violation]);
    surveys.notes.iter().cloned().fold(verdict, Verdict::with_note)
}
