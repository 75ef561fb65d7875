//! Claims: what the literature states, the tests behind each, and what became of it.

mod question;
mod test;

use std::collections::BTreeMap;

use rayon::prelude::*;
use serde::Deserialize;

use crate::domain::Facts;
use crate::experiment::{Finding, Setting};
use crate::record::{Cell, ClaimLine, ClaimOutcome, TestLine};

use question::Docket;
pub use question::{Condition, Quantifier, Question};
pub use test::{Form, Test, TestError};

/// A file of claims. Unknown keys are errors.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClaimFile {
    /// The claims.
    #[serde(rename = "claim")]
    pub claims: Vec<Claim>,
}

/// One statement of the literature.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// Its id in the ledger.
    pub id: String,
    /// The statement, in this project's words.
    pub statement: String,
    /// A key of `references.bib`.
    pub source: String,
    /// The section of the source.
    pub section: String,
    /// The outcome that mathematics leads to expect today.
    pub expected: ClaimOutcome,
    /// The amended form, for a claim that is true under a hypothesis left out.
    #[serde(default)]
    pub amendment: Option<String>,
    /// Its tests.
    #[serde(rename = "test", default)]
    pub tests: Vec<Test>,
}

/// Why there is no such claim.
#[derive(Debug, thiserror::Error)]
pub enum ClaimError {
    /// The text is not a file of claims, or a test asks for what there is not.
    #[error("claims '{file}': {error}")]
    Syntax {
        /// Which file.
        file: String,
        /// What the TOML reader says, with the place.
        error: Box<toml::de::Error>,
    },
    /// No such claim.
    #[error("there is no claim '{id}'; 'lapjury list claims' names those that there are")]
    Unknown {
        /// The id.
        id: String,
    },
}

/// The claims that come with the program.
pub static BUILT_IN: &[(&str, &str)] = &[
    ("taxonomy", include_str!("../../../suites/claims/taxonomy.toml")),
    ("cheeger", include_str!("../../../suites/claims/cheeger.toml")),
    ("smooth", include_str!("../../../suites/claims/smooth.toml")),
    ("graphs", include_str!("../../../suites/claims/graphs.toml")),
    ("discrete", include_str!("../../../suites/claims/discrete.toml")),
    ("coordinates", include_str!("../../../suites/claims/coordinates.toml")),
    ("no_free_lunch", include_str!("../../../suites/claims/no_free_lunch.toml")),
    ("triangulations", include_str!("../../../suites/claims/triangulations.toml")),
    ("isospectral", include_str!("../../../suites/claims/isospectral.toml")),
    ("convergence", include_str!("../../../suites/claims/convergence.toml")),
];

/// Every claim that comes with the program, in the order of the files.
///
/// # Errors
/// A file that does not parse.
pub fn all() -> Result<Vec<Claim>, ClaimError> {
    let mut claims = Vec::new();
    for (file, text) in BUILT_IN {
        claims.extend(parse(file, text)?.claims);
    }
    Ok(claims)
}

/// Reads a file of claims; `name` is used in messages.
///
/// # Errors
/// Text that is not a file of claims, and tests that name what there is not.
pub fn parse(name: &str, text: &str) -> Result<ClaimFile, ClaimError> {
    toml::from_str(text).map_err(|error| ClaimError::Syntax { file: name.to_string(), error: Box::new(error) })
}

/// The claims with these ids, in the order given.
///
/// # Errors
/// An id that does not exist.
pub fn select(ids: &[String]) -> Result<Vec<Claim>, ClaimError> {
    let all = all()?;
    ids.iter()
        .map(|id| all.iter().find(|c| c.id == *id).cloned().ok_or_else(|| ClaimError::Unknown { id: id.clone() }))
        .collect()
}

/// Tests the claims: runs each experiment that they name once, in parallel, and asks the cells of the run.
pub fn test(claims: &[Claim], facts: &BTreeMap<String, Facts>, cells: &[Cell], setting: &Setting) -> Vec<ClaimLine> {
    let tests = claims.iter().flat_map(|c| &c.tests);
    let wanted: BTreeMap<&str, _> = tests.filter_map(Test::experiment).map(|e| (e.id, e)).collect();
    let findings: BTreeMap<&str, Vec<Finding>> =
        wanted.into_par_iter().map(|(id, experiment)| (id, (experiment.run)(setting))).collect();
    let docket = Docket::new(cells, facts);
    claims.iter().map(|claim| claim.test(&findings, &docket, setting)).collect()
}

impl Claim {
    /// Whether some test asks for the verdict on this property of this operator, both by their ids in the catalogue.
    pub fn asks(&self, laplacian: &str, property: &str) -> bool {
        self.tests.iter().filter_map(Test::question).any(|question| question.asks(laplacian, property))
    }

    fn test(&self, findings: &BTreeMap<&str, Vec<Finding>>, docket: &Docket, setting: &Setting) -> ClaimLine {
        let replay = format!("lapjury verify {} --seed {} --effort {}", self.id, setting.seed, setting.effort);
        let answer = |test: &Test| (test.form, test.answer(findings, docket, &replay));
        let tests: Vec<(Form, TestLine)> = self.tests.iter().map(answer).collect();
        ClaimLine {
            id: self.id.clone(),
            statement: self.statement.clone(),
            source: format!("{}, section {}", self.source, self.section),
            outcome: outcome(&tests),
            expected: self.expected,
            amendment: self.amendment.clone(),
            tests: tests.into_iter().map(|(_, t)| t).collect(),
        }
    }
}

/// What the tests of a claim come to.
///
/// A claim without a test of its stated form, or with a test that found nothing to decide, is empty. A stated test that
/// disagrees makes it amended if there are amended tests and all agree, inconclusive if those are open, else refuted. A
/// stated test that is open makes it inconclusive; so does an amended form that fails where the stated one holds. Else it is
/// confirmed.
fn outcome(tests: &[(Form, TestLine)]) -> ClaimOutcome {
    let is_open = |t: &TestLine| t.decided == 0;
    let agrees = |t: &TestLine| t.decided > 0 && t.agrees;
    let disagrees = |t: &TestLine| t.decided > 0 && !t.agrees;
    let of = |form: Form| tests.iter().filter(move |(f, _)| *f == form).map(|(_, t)| t);
    let (stated, amended) = (|| of(Form::Stated), || of(Form::Amended));
    if stated().next().is_none() || tests.iter().any(|(_, t)| t.decided == 0 && t.open == 0) {
        ClaimOutcome::Empty
    } else if stated().any(disagrees) {
        match amended().next() {
            Some(_) if amended().all(agrees) => ClaimOutcome::Amended,
            Some(_) if !amended().any(disagrees) => ClaimOutcome::Inconclusive,
            _ => ClaimOutcome::Refuted,
        }
    } else if stated().any(is_open) || amended().any(disagrees) {
        ClaimOutcome::Inconclusive
    } else {
        ClaimOutcome::Confirmed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::Level;

    /// A test of a form that came out so.
    fn line(form: Form, agrees: bool, decided: usize, open: usize) -> (Form, TestLine) {
        let (question, finding) = (String::new(), String::new());
        let (level, replay, evidence, figures) = (Level::Exact, None, Vec::new(), Vec::new());
        let form_name = form.name().into();
        let line =
            TestLine { question, form: form_name, agrees, decided, open, level, finding, replay, evidence, figures };
        (form, line)
    }

    #[test]
    fn each_outcome_follows_from_its_tests_and_from_no_other() {
        let tests = |stated: &[&str], amended: &[&str]| {
            let of = |form: Form| {
                move |word: &&str| match *word {
                    "yes" => line(form, true, 3, 1),
                    "no" => line(form, false, 3, 0),
                    "open" => line(form, false, 0, 2),
                    _ => line(form, false, 0, 0),
                }
            };
            outcome(
                &stated.iter().map(of(Form::Stated)).chain(amended.iter().map(of(Form::Amended))).collect::<Vec<_>>(),
            )
        };
        use ClaimOutcome::{Amended, Confirmed, Empty, Inconclusive, Refuted};
        for (stated, amended, expected) in [
            (&["yes"][..], &[][..], Confirmed),
            (&["yes", "yes"], &["yes"], Confirmed),
            (&["yes"], &["open"], Confirmed),
            (&["yes"], &["no"], Inconclusive),
            (&["yes", "open"], &[], Inconclusive),
            (&["open"], &["yes"], Inconclusive),
            (&["no"], &["yes", "yes"], Amended),
            (&["no", "open"], &["yes"], Amended),
            (&["no"], &["yes", "open"], Inconclusive),
            (&["no"], &["yes", "no"], Refuted),
            (&["no"], &["open", "no"], Refuted),
            (&["yes", "no"], &[], Refuted),
            (&["no", "open"], &[], Refuted),
            (&[], &[], Empty),
            (&[], &["yes"], Empty),
            (&["yes", "nothing"], &[], Empty),
            (&["no"], &["nothing"], Empty),
        ] {
            assert_eq!(tests(stated, amended), expected, "stated {stated:?}, amended {amended:?}");
        }
    }
}
