//! What a check answers with: an outcome, a level of evidence, a margin — never a bare bool.

use serde::{Deserialize, Serialize};

use super::evidence::Evidence;

/// The answer of a property.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Verdict {
    /// What was decided, with what shows it.
    pub outcome: Outcome,
    /// How it was decided.
    pub level: Level,
    /// The worst residual over its threshold: below 1 rounding explains it. `None` where the decision is combinatorial.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// Counts, where the property is about a list of places.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tally: Option<Tally>,
    /// What else a reader should know: the stencil radius, which mass, which range of times.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// What was decided. A failing verdict cannot be written down without its witness, nor a holding one without its certificate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Outcome {
    /// The property is true of this operator on this domain; the evidence is a certificate.
    Holds(Box<Evidence>),
    /// It is false; the evidence is a witness.
    Fails(Box<Evidence>),
    /// The residual lies between what rounding explains and what a defect explains; where and by how much.
    Undecided(String),
    /// The property says nothing here; why.
    NotApplicable(String),
}

/// The four statuses, without their evidence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// See [`Outcome::Holds`].
    Holds,
    /// See [`Outcome::Fails`].
    Fails,
    /// See [`Outcome::Undecided`].
    Undecided,
    /// See [`Outcome::NotApplicable`].
    NotApplicable,
}

impl std::fmt::Display for Status {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            Status::Holds => "holds",
            Status::Fails => "fails",
            Status::Undecided => "undecided",
            Status::NotApplicable => "not-applicable",
        })
    }
}

/// How a verdict was reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Level {
    /// In rational arithmetic, by exact predicates, or combinatorially.
    Exact,
    /// In floating point with an error bound that covers the worst case.
    Bounded,
    /// In floating point against a stated tolerance.
    Measured,
}

impl std::fmt::Display for Level {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            Level::Exact => "exact",
            Level::Bounded => "bounded",
            Level::Measured => "measured",
        })
    }
}

/// Counts over the places that a property looks at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tally {
    /// Places where the property is violated.
    pub violations: usize,
    /// Places where the deciding number is zero (POS: ω = 0 is not ω < 0).
    pub zeros: usize,
    /// Places that rounding leaves open.
    pub undecided: usize,
    /// Places looked at.
    pub total: usize,
}

impl Verdict {
    /// The property holds.
    pub fn holds(level: Level, certificate: Evidence) -> Self {
        Verdict::of(Outcome::Holds(Box::new(certificate)), level)
    }

    /// The property fails.
    pub fn fails(level: Level, witness: Evidence) -> Self {
        Verdict::of(Outcome::Fails(Box::new(witness)), level)
    }

    /// Rounding leaves it open.
    pub fn undecided(gap: impl Into<String>) -> Self {
        Verdict::of(Outcome::Undecided(gap.into()), Level::Measured)
    }

    /// The property says nothing here.
    pub fn not_applicable(why: impl Into<String>) -> Self {
        Verdict::of(Outcome::NotApplicable(why.into()), Level::Exact)
    }

    fn of(outcome: Outcome, level: Level) -> Self {
        Verdict { outcome, level, margin: None, tally: None, notes: Vec::new() }
    }

    /// With the worst residual over its threshold. A NaN is dropped: a margin is a number or absent.
    pub fn with_margin(mut self, margin: f64) -> Self {
        self.margin = margin.is_finite().then_some(margin);
        self
    }

    /// With counts.
    pub fn with_tally(mut self, tally: Tally) -> Self {
        self.tally = Some(tally);
        self
    }

    /// With a remark for the reader.
    pub fn with_note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// The status without its evidence.
    pub fn status(&self) -> Status {
        match self.outcome {
            Outcome::Holds(_) => Status::Holds,
            Outcome::Fails(_) => Status::Fails,
            Outcome::Undecided(_) => Status::Undecided,
            Outcome::NotApplicable(_) => Status::NotApplicable,
        }
    }

    /// The witness or certificate.
    pub fn evidence(&self) -> Option<&Evidence> {
        match &self.outcome {
            Outcome::Holds(e) | Outcome::Fails(e) => Some(e),
            _ => None,
        }
    }

    /// Why there is no decision, if there is none.
    pub fn reason(&self) -> Option<&str> {
        match &self.outcome {
            Outcome::Undecided(why) | Outcome::NotApplicable(why) => Some(why),
            _ => None,
        }
    }
}
