//! What an operator makes of one triangulation, decided exactly where that can be.

use crate::domain::Domain;
use crate::laplacian::exact::Twin;
use crate::operator::Operator;
use crate::property::exact::{Case, DECIDED, Decision, Plane};
use crate::property::{Level, Property, Status, Trial};
use crate::suite::cases::seed_of;
use crate::suite::choice::Choice;

/// The answer on one triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    /// A verdict, and its level.
    Decided(Status, Level),
    /// The construction refuses the triangulation.
    Refused,
}

/// Operators with the properties asked of each; the number of a property is that of its cell.
pub(super) struct Judge<'a> {
    rows: Vec<(&'a Choice, Vec<(usize, &'static Property)>)>,
}

impl<'a> Judge<'a> {
    /// Groups the cells by operator.
    pub fn new(wanted: &[(usize, &'a Choice, &'static Property)]) -> Self {
        let mut rows: Vec<(&Choice, Vec<_>)> = Vec::new();
        for &(cell, choice, property) in wanted {
            match rows.iter_mut().find(|(known, _)| std::ptr::eq(*known, choice)) {
                Some((_, list)) => list.push((cell, property)),
                None => rows.push((choice, vec![(cell, property)])),
            }
        }
        Judge { rows }
    }

    /// The answers of all cells on a domain.
    pub fn answers(&self, domain: &Domain, recipe: &str) -> Vec<(usize, Answer)> {
        let plane = Plane::new(domain);
        let seed = seed_of(recipe);
        self.rows.iter().flat_map(|(choice, list)| answers_of(choice, list, domain, plane.as_ref(), seed)).collect()
    }
}

fn answers_of(
    choice: &Choice,
    list: &[(usize, &'static Property)],
    domain: &Domain,
    plane: Option<&Plane>,
    seed: u64,
) -> Vec<(usize, Answer)> {
    let exactly = list.iter().any(|(_, p)| DECIDED.contains(&p.id));
    let twin: Option<Twin> = if exactly { domain.as_surface().and_then(|s| choice.twin(s)) } else { None };
    let case = match (plane, &twin) {
        (Some(plane), Some(twin)) => Case::new(plane, &twin.stiffness),
        _ => None,
    };
    let mut rounded: Option<Option<Operator>> = None;
    let mut answer = |property: &'static Property| {
        if let Some(decision) = case.as_ref().and_then(|case| case.decide(property.id)) {
            return Answer::Decided(status(&decision), Level::Exact);
        }
        let operator = rounded.get_or_insert_with(|| choice.build(domain).ok());
        let Some(trial) = operator.as_ref().and_then(|o| Trial::new(domain, o, seed).ok()) else {
            return Answer::Refused;
        };
        let construction = |domain: &Domain| choice.build(domain).map_err(|refusal| refusal.to_string());
        let verdict = property.decide(&trial, Some(&construction));
        Answer::Decided(verdict.status(), verdict.level)
    };
    list.iter().map(|&(cell, property)| (cell, answer(property))).collect()
}

fn status(decision: &Decision) -> Status {
    match decision {
        Decision::Holds => Status::Holds,
        Decision::Fails(_) => Status::Fails,
        Decision::Silent => Status::NotApplicable,
    }
}
