//! What `check` answers, as JSON for scripts.

use super::Decided;
use crate::domain::{Domain, Facts};
use crate::external::Comparison;
use crate::operator::{Mass, Operator, Provenance};
use crate::property::{Evidence, Level, Status, Tally};
use crate::record::Recheck;

/// What `check` answers, as one JSON object.
#[derive(serde::Serialize)]
pub(super) struct Answer<'a> {
    pub(super) domain: DomainAnswer,
    pub(super) operator: OperatorAnswer,
    pub(super) verdicts: Vec<VerdictAnswer<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) comparison: Option<Comparison>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mass_comparison: Option<Comparison>,
}

#[derive(serde::Serialize)]
pub(super) struct DomainAnswer {
    source: String,
    digest: String,
    #[serde(flatten)]
    facts: Facts,
    notices: Vec<String>,
}

#[derive(serde::Serialize)]
pub(super) struct OperatorAnswer {
    #[serde(flatten)]
    provenance: Provenance,
    #[serde(skip_serializing_if = "Option::is_none")]
    refused: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stored: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mass_total: Option<f64>,
}

/// A verdict with its counts spread out, as scripts like to read it.
#[derive(serde::Serialize)]
pub(super) struct VerdictAnswer<'a> {
    property: &'static str,
    status: Status,
    evidence: Level,
    #[serde(skip_serializing_if = "Option::is_none")]
    violations: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    zeros: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    open: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    total: Option<usize>,
    margin: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    notes: &'a [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    witness: Option<&'a Evidence>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certificate: Option<&'a Evidence>,
    recheck: &'a Recheck,
    #[serde(skip_serializing_if = "Option::is_none")]
    promised: Option<bool>,
}

impl DomainAnswer {
    pub(super) fn new(source: &str, domain: &Domain, facts: &Facts) -> Self {
        DomainAnswer {
            source: source.into(),
            digest: domain.digest(),
            facts: facts.clone(),
            notices: domain.notices().to_vec(),
        }
    }
}

impl OperatorAnswer {
    pub(super) fn refused(id: &str, why: &str) -> Self {
        OperatorAnswer {
            provenance: Provenance { id: id.into(), ..Provenance::default() },
            refused: Some(why.into()),
            stored: None,
            mass_total: None,
        }
    }

    pub(super) fn built(operator: &Operator) -> Self {
        OperatorAnswer {
            provenance: operator.provenance().clone(),
            refused: None,
            stored: Some(operator.stiffness().stored()),
            mass_total: operator.mass().map(Mass::total).filter(|t| t.is_finite()),
        }
    }
}

impl<'a> VerdictAnswer<'a> {
    pub(super) fn new(decided: &'a Decided) -> Self {
        let verdict = &decided.verdict;
        let tally = |count: fn(&Tally) -> usize| verdict.tally.as_ref().map(count);
        let status = verdict.status();
        VerdictAnswer {
            property: decided.property.id,
            status,
            evidence: verdict.level,
            violations: tally(|t| t.violations),
            zeros: tally(|t| t.zeros),
            open: tally(|t| t.undecided),
            total: tally(|t| t.total),
            margin: verdict.margin,
            reason: verdict.reason(),
            notes: &verdict.notes,
            witness: verdict.evidence().filter(|_| status == Status::Fails),
            certificate: verdict.evidence().filter(|_| status == Status::Holds),
            recheck: &decided.recheck,
            promised: decided.promised,
        }
    }
}
