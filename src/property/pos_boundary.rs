//! POS-boundary: the weights on boundary edges are positive.
//!
//! # Definition
//! `ω_ij = −L_ij > 0` on every boundary edge, where a cotangent weight has one angle only and is negative as soon as that
//! angle is obtuse, Delaunay or not. Interior edges with both ends on the boundary matter to no Dirichlet problem; they
//! belong to [POS](super::pos) and are told apart in a note here.

use super::measure::weights::Class;
use super::{Property, Question, Trial, Verdict};
use crate::domain::Domain;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "POS-boundary",
    name: "positive weights on the boundary",
    statement: "ω_ij > 0 on every boundary edge",
    sources: &["wardetzky2007"],
    question: Question::Operator(check),
};

fn check(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    if let Domain::Graph(_) | Domain::Points(_) = trial.domain {
        return Verdict::not_applicable(format!(
            "a {} has no boundary edges; POS looks at all weights",
            trial.domain.kind()
        ));
    }
    let surveys = trial.surveys();
    if surveys.boundary.tally.total == 0 {
        return Verdict::not_applicable("there is no boundary edge");
    }
    let verdict = surveys.boundary.decide(trial, &[Class::Violation, Class::Zero]);
    let tally = surveys.bridges.tally;
    if tally.total == 0 {
        return verdict;
    }
    verdict.with_note(format!(
        "interior edges with both ends on the boundary, counted by POS: {} (violations {}, zeros {}, undecided {})",
        tally.total, tally.violations, tally.zeros, tally.undecided
    ))
}
