//! POS: the weights on interior edges are positive.
//!
//! # Definition
//! `ω_ij = −L_ij > 0` on every interior edge. `violations` counts `ω < 0`, `zeros` counts `ω = 0`: a cocircular pair makes
//! the strict predicate fail by an exact zero, and the verdict says so. Which pairs have a weight, and when a sign is clear,
//! is told in [`weights`](super::measure::weights). Boundary edges have [POS-boundary](super::pos_boundary).

use super::measure::weights::Class;
use super::{Property, Question, Trial, Verdict};

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "POS",
    name: "positive weights",
    statement: "ω_ij > 0 on every interior edge",
    sources: &["wardetzky2007"],
    question: Question::Operator(check),
};

fn check(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let surveys = trial.surveys();
    if surveys.strict.tally.total == 0 {
        return Verdict::not_applicable("there is no interior edge");
    }
    let verdict = surveys.strict.decide(trial, &[Class::Violation, Class::Zero]);
    surveys.notes.iter().cloned().fold(verdict, Verdict::with_note)
}
