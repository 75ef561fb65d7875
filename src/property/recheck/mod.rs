//! Verifies evidence without any checker.
//!
//! A check that decides a property and a check that its evidence is true are two different programs: this module uses no
//! checker, none of their thresholds and none of their factorisations. It has its own sums with exact fall-back, its own
//! profile factorisation, its own verified solver.
//!
//! # What is verified
//! * [`from_excerpt`]: a witness, from the numbers written down with it and nothing else. Every `f64` is rational, so this is
//!   decided exactly, except where square roots (areas in space) or linear systems ask for a bound.
//! * [`against`]: in addition, that excerpt and operator agree bit for bit, that the star or the edge is whole, and that the
//!   witness is of the kind the property asks for; and certificates, by a scan, factorisation or solve of our own.
//!
//! A witness must exceed its stated threshold *and* what a single rounding of a correct row explains: a threshold of zero
//! makes no witness of the last bit.
//!
//! # Limitations
//! [`Rechecked::Open`] says why something was neither verified nor refuted: the construction would have to be called
//! again, the certificate does not name the sets it tried, the matrix is too large for the second way. A margin that a
//! checker reports is not verified; the predicate is.

mod accuracy;
mod alone;
mod bareiss;
mod certificate;
mod cheeger;
mod classes;
mod cospectral;
mod dense;
mod dirichlet;
mod drawing;
mod eigenvalues;
mod energy;
mod equilibrium;
mod excerpt;
mod extension;
mod flips;
mod harmonic;
mod lattice;
mod leeway;
mod mass;
mod maximum;
mod moment;
mod place;
mod planar;
mod polygon;
mod precision;
mod profile;
mod qr;
mod relevance;
mod scan;
mod shares;
mod solutions;
mod solve;
mod spectrum;
mod terms;
mod tetrahedra;
mod transplantation;
mod weight;
mod witness;

use super::evidence::{Evidence, Statement};
use super::verdict::{Outcome, Verdict};
use crate::domain::Domain;
use crate::operator::Operator;

use excerpt::Material;

/// What the recheck came to, if it refused nothing.
#[derive(Clone, Debug, PartialEq)]
pub enum Rechecked {
    /// True, decided in rational or integer arithmetic or combinatorially.
    Exact,
    /// True, decided in floating point with an error bound, or up to what rounding of the entries explains.
    Bounded,
    /// Neither verified nor refuted; why, and what would decide it.
    Open(String),
}

/// Why evidence was refused: what was stated, and what was found instead.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// An element of the excerpt or of the statement that cannot be.
    #[error("{what} {index} of the evidence {problem}")]
    Malformed {
        /// Which list: "row", "position", "face", …
        what: &'static str,
        /// Which element of it.
        index: usize,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// Something that decides the statement is not in the excerpt.
    #[error("the statement needs {what} {index}, which the excerpt does not carry")]
    Missing {
        /// Which list.
        what: &'static str,
        /// Which element of it.
        index: usize,
    },
    /// The excerpt differs from what it was copied from.
    #[error("{what} {index} was not copied faithfully: the evidence has {copied}, there is {actual}")]
    NotCopied {
        /// Which list.
        what: &'static str,
        /// Which element of it.
        index: usize,
        /// What the evidence says.
        copied: String,
        /// What operator or domain say.
        actual: String,
    },
    /// A number of the statement that cannot be.
    #[error("{name} = {value} in the statement; it must be {must}")]
    Parameter {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        must: &'static str,
    },
    /// The statement is not true.
    #[error("stated: {stated}; found: {found}")]
    Untrue {
        /// What was stated.
        stated: String,
        /// What was found.
        found: String,
    },
    /// The statement does not decide the property.
    #[error("a statement of kind '{kind}' decides nothing about {property}")]
    Irrelevant {
        /// The kind of statement.
        kind: &'static str,
        /// The property's id.
        property: String,
    },
    /// A witness under a holding verdict or a certificate under a failing one.
    #[error("the verdict is '{status}', but its evidence is a {found}")]
    WrongSide {
        /// The verdict's status.
        status: super::verdict::Status,
        /// "witness" or "certificate".
        found: &'static str,
    },
    /// Operator and domain do not belong together.
    #[error("the operator has {rows} rows, the domain {vertices} vertices; the evidence is about another pair")]
    Size {
        /// Rows of the operator.
        rows: usize,
        /// Vertices of the domain.
        vertices: usize,
    },
}

impl Refusal {
    fn untrue(stated: impl Into<String>, found: impl Into<String>) -> Self {
        Refusal::Untrue { stated: stated.into(), found: found.into() }
    }
}

type Answer = Result<Rechecked, Refusal>;

/// Decides a witness on its excerpt alone: what a reader of the JSON can do without mesh and matrix.
///
/// A statement about a triangulation or a smooth form carries all that decides it, witness or certificate. Any other certificate speaks of the
/// whole matrix and comes back [`Rechecked::Open`]; so does a witness whose rows were too many to write down.
///
/// # Errors
/// Evidence that is malformed, incomplete, or not true.
pub fn from_excerpt(evidence: &Evidence) -> Answer {
    let material = Material::read(&evidence.excerpt)?;
    if let Some(answer) = alone::decide(evidence) {
        return answer;
    }
    if !relevance::is_witness(&evidence.statement) {
        certificate::check_numbers(&evidence.statement)?;
        return Ok(Rechecked::Open("a certificate speaks of the whole matrix; recheck it against the operator".into()));
    }
    if relevance::needs_everything(&evidence.statement) && material.is_partial(&evidence.statement) {
        return Ok(Rechecked::Open(
            "the rows were too many to be written down with it; recheck it against the operator".into(),
        ));
    }
    let answer = witness::decide(&evidence.statement, &material)?;
    if matches!(evidence.statement, Statement::Weight { zero: true, .. }) && material.has_no_mesh() {
        return Ok(Rechecked::Open("that a zero stands on an edge is checked against the domain".into()));
    }
    Ok(answer)
}

/// Decides evidence against the operator and the domain it speaks of.
///
/// The excerpt must be a faithful and whole copy; a witness must be one for this property; a certificate is decided by a
/// computation of our own on the whole matrix. For a property that this module does not know, a witness is decided for what
/// it states and a scan stays open.
///
/// Cost: linear in the excerpt for a local witness, in the matrix for a scan; a profile factorisation, a dense inverse below
/// 300 unknowns or an orthogonal triangularisation where the statement speaks of eigenvalues or solutions.
///
/// # Errors
/// Evidence that is malformed, incomplete, copied wrongly, beside the point, or not true.
pub fn against(evidence: &Evidence, property: &str, domain: &Domain, operator: &Operator) -> Answer {
    let (rows, vertices) = (operator.size(), domain.vertex_count());
    if rows != vertices {
        return Err(Refusal::Size { rows, vertices });
    }
    let statement = &evidence.statement;
    relevance::check(statement, property)?;
    let material = Material::read(&evidence.excerpt)?;
    excerpt::check_copy(&evidence.excerpt, domain, operator)?;
    excerpt::check_whole(statement, &evidence.excerpt, domain)?;
    if let Some(answer) = alone::decide(evidence) {
        return answer;
    }
    if !relevance::is_witness(statement) {
        certificate::check_numbers(statement)?;
        return certificate::decide(statement, property, domain, operator);
    }
    let answer = if relevance::needs_everything(statement) {
        let whole = excerpt::whole(domain, operator);
        witness::decide(statement, &Material::read(&whole)?)?
    } else {
        witness::decide(statement, &material)?
    };
    place::check_place(statement, property, domain, operator)?;
    Ok(place::on_operator(statement, operator)?.unwrap_or(answer))
}

/// Decides the evidence of a verdict; `None` where the verdict decides nothing.
///
/// # Errors
/// As [`against`]; and a failing verdict with a certificate, a holding one with a witness.
pub fn of_verdict(
    verdict: &Verdict,
    property: &str,
    domain: &Domain,
    operator: &Operator,
) -> Result<Option<Rechecked>, Refusal> {
    let (evidence, fails) = match &verdict.outcome {
        Outcome::Holds(evidence) => (evidence, false),
        Outcome::Fails(evidence) => (evidence, true),
        Outcome::Undecided(_) | Outcome::NotApplicable(_) => return Ok(None),
    };
    let witness = relevance::is_witness(&evidence.statement);
    if witness != fails {
        let found = if witness { "witness" } else { "certificate" };
        return Err(Refusal::WrongSide { status: verdict.status(), found });
    }
    against(evidence, property, domain, operator).map(Some)
}

/// A threshold: finite and not negative.
fn check_threshold(threshold: f64) -> Result<(), Refusal> {
    if threshold.is_finite() && threshold >= 0.0 {
        return Ok(());
    }
    Err(Refusal::Parameter { name: "threshold", value: threshold, must: "finite and not negative" })
}

/// Whether a number written down for the reader is the one found, to six digits of `scale`.
fn check_number(name: &'static str, stated: f64, found: f64, scale: f64) -> Result<(), Refusal> {
    if (stated - found).abs() <= 1e-6 * scale.abs() {
        return Ok(());
    }
    Err(Refusal::untrue(format!("{name} = {stated}"), format!("{found}")))
}

/// The kind of a statement as JSON calls it.
pub fn kind(statement: &Statement) -> &'static str {
    relevance::kind(statement)
}
