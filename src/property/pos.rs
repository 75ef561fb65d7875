//! POS: the weights on interior edges are positive.
//!
//! # Definition
//! `ω_ij = −L_ij > 0` on every interior edge. `violations` counts `ω < 0`, `zeros` counts `ω = 0`: a cocircular pair makes
//! the strict predicate fail by an exact zero, and the verdict says so. Which pairs have a weight, and when a sign is clear,
//! is told in [`weights`](super::measure::weights). Boundary edges have [POS-boundary](super::pos_boundary).

use super::measure::weights::{Class, Part, Weights, decide, strict};
use super::{Property, Question, Trial, Verdict};

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "POS",
    name: "positive weights",
    statement: "ω_ij > 0 on every interior edge",
    sources: &["wardetzky2007"],
    question: Question::Operator(check),
};

/// Worst first: a negative weight, a zero, a sign that is not clear.
pub(super) const ORDER: [Class; 4] = [Class::Violation, Class::Zero, Class::Open, Class::Fine];

fn check(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let weights = Weights::of(trial);
    if weights.no_interior() {
        return Verdict::not_applicable("there is no interior edge");
    }
    let failing = [Class::Violation, Class::Zero];
    let verdict = decide(&weights, Part::Interior, strict, ORDER, &failing);
    weights.notes().into_iter().fold(verdict, Verdict::with_note)
}
