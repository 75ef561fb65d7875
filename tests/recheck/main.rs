//! Evidence, each kind with a true example made by hand, spoilt in several ways.

mod certificates;
mod cotangents;
mod drawings;
mod equilibria;
mod excerpts;
mod flips;
mod forms;
mod graphs;
mod imports;
mod mutation;
mod operators;
mod performance;
mod polygons;
mod spectra;
mod spoilt;
mod triangulations;
mod witnesses;

use lapjury::domain::Domain;
use lapjury::operator::Operator;
use lapjury::property::Evidence;
use lapjury::property::recheck::{Rechecked, Refusal, against, from_excerpt};

/// True evidence with what it speaks of, and what the recheck must make of it.
pub struct Example {
    pub name: &'static str,
    pub property: &'static str,
    pub domain: Domain,
    pub operator: Operator,
    pub evidence: Evidence,
    pub alone: Expected,
    pub held_against: Expected,
}

/// What the recheck must come to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    Exact,
    Bounded,
    Open,
}

impl Expected {
    fn of(found: &Rechecked) -> Self {
        match found {
            Rechecked::Exact => Expected::Exact,
            Rechecked::Bounded => Expected::Bounded,
            Rechecked::Open(why) => {
                assert!(!why.is_empty());
                Expected::Open
            }
        }
    }
}

impl Example {
    /// The evidence through JSON.
    pub fn round_trip(&self) -> Evidence {
        let text = serde_json::to_string(&self.evidence).unwrap();
        serde_json::from_str(&text).unwrap()
    }

    pub fn against(&self, evidence: &Evidence) -> Result<Rechecked, Refusal> {
        against(evidence, self.property, &self.domain, &self.operator)
    }

    /// Refuses to go on unless the example is accepted as expected.
    pub fn assert_true(&self) {
        let evidence = self.round_trip();
        assert_eq!(evidence, self.evidence, "{}", self.name);
        let alone = from_excerpt(&evidence).unwrap_or_else(|e| panic!("{}: {e}", self.name));
        assert_eq!(Expected::of(&alone), self.alone, "{} alone: {alone:?}", self.name);
        let whole = self.against(&evidence).unwrap_or_else(|e| panic!("{}: {e}", self.name));
        assert_eq!(Expected::of(&whole), self.held_against, "{} against: {whole:?}", self.name);
    }

    /// Asserts that a change is seen, on the excerpt alone or against the operator.
    pub fn assert_refused(&self, what: &str, change: impl FnOnce(&mut Evidence)) {
        let mut evidence = self.evidence.clone();
        change(&mut evidence);
        assert_ne!(evidence, self.evidence, "{}, {what}: nothing was changed", self.name);
        let refusal = self.against(&evidence);
        match refusal {
            Err(refusal) => assert!(refusal.to_string().len() > 20, "{}, {what}: {refusal}", self.name),
            Ok(found) => panic!("{}, {what}: accepted as {found:?}", self.name),
        }
    }
}

/// Asserts that forged evidence is refused, on its excerpt alone, for the one thing that is wrong with it.
#[track_caller]
pub fn refused_for(evidence: &Evidence, reason: &str) {
    let refusal = from_excerpt(evidence).expect_err(reason).to_string();
    assert!(refusal.contains(reason), "not for '{reason}': {refusal}");
}

/// Asserts that evidence is true, decided exactly on its excerpt alone: what a forgery starts from.
#[track_caller]
pub fn accepted(evidence: &Evidence) {
    assert_eq!(from_excerpt(evidence), Ok(Rechecked::Exact));
}

/// Asserts that evidence is left open as being about too much.
#[track_caller]
pub fn too_many(evidence: &Evidence) {
    let answer = from_excerpt(evidence);
    assert!(
        matches!(&answer, Ok(Rechecked::Open(why)) if why.contains("too many") || why.contains("more than")),
        "{answer:?}"
    );
}

pub fn all() -> Vec<Example> {
    witnesses::all().into_iter().chain(certificates::all()).collect()
}
