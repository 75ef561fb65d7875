//! The properties: one predicate a file, one `static ENTRY` each.
//!
//! A property is a predicate on `(L, M, domain)` or on a construction that can be called again; it never looks at which
//! code made the matrix, and this module never imports [`laplacian`](crate::laplacian).
//!
//! To add one: write the file and name it below, in the `catalogue`.
//!
//! Besides the properties: what they decide on ([`Trial`]) and answer with ([`verdict`], [`evidence`], cut out by `excerpt`);
//! `measure` says how large a residual is and how large it may be ([`tolerance`]), `solve` holds the solvers that several
//! properties share, `relate` the comparison of constructions. [`recheck`] uses none of these.

pub mod evidence;
pub mod exact;
mod excerpt;
mod measure;
pub mod recheck;
mod relate;
mod solve;
mod trial;
pub mod verdict;

catalogue! {
    /// Every property, in the order of the tables.
    Property:
    fin,
    loc,
    sym,
    null,
    ker,
    pos,
    pos0,
    pos_boundary,
    psd,
    lin,
    energy,
    flux,
    acc,
    mvp,
    mass,
    max_local,
    max_global,
    max_heat,
    perm,
    rigid,
    scale,
    iso,
    reach,
    union,
}

pub use evidence::{Evidence, Excerpt, Statement};
pub use measure::{stencil, tolerance};
pub use trial::Trial;
pub use verdict::{Level, Outcome, Status, Tally, Verdict};

use crate::domain::Domain;
use crate::operator::Operator;

/// A catalogue entry.
pub struct Property {
    /// The id, in upper case, as the field abbreviates it.
    pub id: &'static str,
    /// What it is called in full.
    pub name: &'static str,
    /// What exactly is decided, in plain Unicode maths.
    pub statement: &'static str,
    /// Keys of `references.bib`.
    pub sources: &'static [&'static str],
    /// How it is decided.
    pub question: Question,
}

/// What a property asks of: a finished operator, or a construction that can be called.
pub enum Question {
    /// A predicate on matrices and domain.
    Operator(fn(&Trial) -> Verdict),
    /// A relation between the operators that a construction makes of related domains.
    Construction(fn(&Trial, &Construction) -> Verdict),
}

/// A construction that can be called on any domain; the error is the refusal in words.
pub type Construction<'a> = dyn Fn(&Domain) -> Result<Operator, String> + Sync + 'a;

impl Property {
    /// Whether it compares the operators that a construction makes of related domains.
    pub fn is_relation(&self) -> bool {
        matches!(self.question, Question::Construction(_))
    }

    /// Decides the property. A relation between constructions is not applicable where none can be called.
    pub fn decide(&self, trial: &Trial, construction: Option<&Construction>) -> Verdict {
        match (&self.question, construction) {
            (Question::Operator(check), _) => check(trial),
            (Question::Construction(check), Some(construction)) => check(trial, construction),
            (Question::Construction(_), None) => Verdict::not_applicable(
                "the operator came as a matrix; this relation needs one that can be built again",
            ),
        }
    }
}
