//! A test of a claim: a part of an experiment, or a question to the cells of the run.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::question::{Condition, Docket, Quantifier, Question};
use crate::experiment::{self, Experiment, Finding};
use crate::laplacian::{self, Fact};
use crate::property::Level;
use crate::record::TestLine;

/// A test, every name of it looked up.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "Written")]
pub struct Test {
    /// Which form of the claim it tests.
    pub form: Form,
    asks: Asks,
}

/// Which form of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Form {
    /// As the source states it.
    Stated,
    /// With the hypothesis that makes it true.
    Amended,
}

#[derive(Clone)]
enum Asks {
    Part(&'static Experiment, &'static str),
    Cells(Question),
}

impl std::fmt::Debug for Asks {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Asks::Part(experiment, part) => write!(f, "{}/{part}", experiment.id),
            Asks::Cells(question) => question.fmt(f),
        }
    }
}

/// A test as the file has it. Unknown keys are errors.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    form: Form,
    #[serde(default)]
    experiment: Option<String>,
    #[serde(default)]
    part: Option<String>,
    /// Whether every selected cell must agree, or some.
    #[serde(default)]
    quantifier: Option<Quantifier>,
    /// The operators asked, by catalogue id; all if absent.
    #[serde(default)]
    laplacians: Vec<String>,
    /// Only domains with these facts are asked, by their names: `"connected"`.
    #[serde(default)]
    facts: Vec<String>,
    /// Only domains and operators with these verdicts are asked: `"POS holds"`.
    #[serde(default)]
    given: Vec<String>,
    /// The verdicts that they should have.
    #[serde(default)]
    then: Vec<String>,
}

/// Why a test asks nothing that there is.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TestError {
    /// Neither an experiment nor a question.
    #[error(
        "a test has either 'experiment' and 'part', or 'quantifier' and 'then' with perhaps 'laplacians', 'facts', 'given'"
    )]
    Neither,
    /// No such experiment.
    #[error("there is no experiment '{0}'; 'lapjury list experiments' names those that there are")]
    Experiment(String),
    /// No such part.
    #[error("experiment '{experiment}' has no part '{part}'; it has {}", known.join(", "))]
    Part {
        /// The experiment.
        experiment: &'static str,
        /// The name in question.
        part: String,
        /// The parts that there are.
        known: &'static [&'static str],
    },
    /// No such operator.
    #[error("there is no operator '{0}'; 'lapjury list laplacians' names those that there are")]
    Laplacian(String),
    /// No such fact.
    #[error("there is no fact '{0}'; the facts are {known}", known = Fact::ALL.map(Fact::name).join(", "))]
    Fact(String),
    /// A condition that does not read "PROPERTY status".
    #[error("'{0}' does not read 'PROPERTY holds' or 'PROPERTY fails' with a property of 'lapjury list properties'")]
    Condition(String),
}

impl TryFrom<Written> for Test {
    type Error = TestError;

    fn try_from(written: Written) -> Result<Self, TestError> {
        let asks = match (&written.experiment, &written.part, written.quantifier) {
            (Some(id), Some(part), None) if written.asks_no_cell() => part_of(id, part)?,
            (None, None, Some(quantifier)) if !written.then.is_empty() => Asks::Cells(Question {
                quantifier,
                laplacians: written.laplacians.iter().map(|id| known_laplacian(id)).collect::<Result<_, _>>()?,
                facts: written.facts.iter().map(|name| fact(name)).collect::<Result<_, _>>()?,
                given: written.given.iter().map(|text| text.parse()).collect::<Result<_, _>>()?,
                then: written.then.iter().map(|text| text.parse()).collect::<Result<_, _>>()?,
            }),
            _ => return Err(TestError::Neither),
        };
        Ok(Test { form: written.form, asks })
    }
}

impl Written {
    fn asks_no_cell(&self) -> bool {
        [&self.laplacians, &self.facts, &self.given, &self.then].iter().all(|list| list.is_empty())
    }
}

fn part_of(id: &str, part: &str) -> Result<Asks, TestError> {
    let experiment = experiment::find(id).ok_or_else(|| TestError::Experiment(id.into()))?;
    let unknown = || TestError::Part { experiment: experiment.id, part: part.into(), known: experiment.parts };
    let part = experiment.parts.iter().find(|p| **p == part).ok_or_else(unknown)?;
    Ok(Asks::Part(experiment, part))
}

fn known_laplacian(id: &str) -> Result<&'static str, TestError> {
    laplacian::find(id).map(|l| l.id).ok_or_else(|| TestError::Laplacian(id.into()))
}

fn fact(name: &str) -> Result<Fact, TestError> {
    Fact::ALL.into_iter().find(|f| f.name() == name).ok_or_else(|| TestError::Fact(name.into()))
}

impl std::str::FromStr for Condition {
    type Err = TestError;

    /// Reads "PROPERTY status".
    fn from_str(text: &str) -> Result<Self, TestError> {
        Condition::read(text).ok_or_else(|| TestError::Condition(text.into()))
    }
}

impl Test {
    /// The experiment that it is a part of, if it is one.
    pub(super) fn experiment(&self) -> Option<&'static Experiment> {
        match self.asks {
            Asks::Part(experiment, _) => Some(experiment),
            Asks::Cells(_) => None,
        }
    }

    /// The question to the cells, if it is one.
    pub(super) fn question(&self) -> Option<&Question> {
        match &self.asks {
            Asks::Part(..) => None,
            Asks::Cells(question) => Some(question),
        }
    }

    /// What it came to; `replay` is the command that runs the experiment again.
    pub(super) fn answer(&self, findings: &BTreeMap<&str, Vec<Finding>>, docket: &Docket, replay: &str) -> TestLine {
        match &self.asks {
            Asks::Part(experiment, part) => {
                let found = findings.get(experiment.id).and_then(|list| list.iter().find(|f| f.part == *part));
                self.line(found, replay)
            }
            Asks::Cells(question) => question.ask(docket, self.form),
        }
    }

    /// An experiment that answers none of its parts decided nothing.
    fn line(&self, finding: Option<&Finding>, replay: &str) -> TestLine {
        TestLine {
            question: finding.map_or_else(String::new, |f| f.question.clone()),
            form: self.form.name().into(),
            agrees: finding.is_some_and(|f| f.agrees),
            decided: finding.map_or(0, |f| f.decided),
            open: finding.map_or(0, |f| f.open),
            level: finding.map_or(Level::Exact, |f| f.level),
            finding: finding.map_or_else(|| "the experiment gave no answer".into(), |f| f.finding.clone()),
            replay: Some(replay.into()),
            evidence: finding.map_or_else(Vec::new, |f| f.evidence.clone()),
            figures: finding.map_or_else(Vec::new, |f| f.figures.clone()),
        }
    }
}

impl Form {
    /// The form in a word.
    pub fn name(self) -> &'static str {
        match self {
            Form::Stated => "stated",
            Form::Amended => "amended",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(text: &str) -> String {
        toml::from_str::<Test>(text).expect_err(text).to_string()
    }

    #[test]
    fn a_test_that_asks_what_there_is_not_is_refused_with_advice() {
        let ask = "form = 'stated'\nquantifier = 'every'\n";
        for (text, message) in [
            ("form = 'stated'".to_string(), "a test has either 'experiment' and 'part'"),
            ("form = 'stated'\nexperiment = 'heat-flow'".into(), "a test has either 'experiment' and 'part'"),
            (ask.into(), "a test has either 'experiment' and 'part'"),
            (
                "form = 'stated'\nexperiment = 'heat-flow'\npart = 'x'\nthen = ['POS holds']".into(),
                "a test has either 'experiment' and 'part'",
            ),
            ("form = 'stated'\nexperiment = 'heat'\npart = 'x'".into(), "there is no experiment 'heat'"),
            (
                "form = 'stated'\nexperiment = 'heat-flow'\npart = 'x'".into(),
                "'heat-flow' has no part 'x'; it has flux-",
            ),
            (format!("{ask}then = ['POS']"), "'POS' does not read 'PROPERTY holds'"),
            (format!("{ask}then = ['POS undecided']"), "'POS undecided' does not read"),
            (format!("{ask}then = ['POSS holds']"), "'POSS holds' does not read"),
            (format!("{ask}then = ['POS holds']\nlaplacians = ['cotangent']"), "there is no operator 'cotangent'"),
            (
                format!("{ask}then = ['POS holds']\nfacts = ['flat']"),
                "there is no fact 'flat'; the facts are Delaunay,",
            ),
            (format!("{ask}then = ['POS holds']\nwhen = []"), "unknown field `when`"),
        ] {
            assert!(refusal(&text).contains(message), "{text}\n{}", refusal(&text));
        }
    }
}
