//! What a suite file says. Unknown keys are errors.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use super::atlas;
use super::choice::ChoiceError;
use super::claims::ClaimError;
use super::recipe::RecipeError;
use crate::experiment::Effort;

/// In a list of names: every entry of the catalogue that the list does not name, so that a new entry takes part unasked.
pub const OTHERS: &str = "others";

/// A suite: domains by class, operators, properties, claims.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Suite {
    /// Its id: the file's stem.
    pub id: String,
    /// What it is for, in a sentence.
    pub title: String,
    /// The seed from which every other one is drawn.
    pub seed: u64,
    /// The operators, each an id with settings as in `three-point:p=2`; `others` stands for every other one. If absent, all.
    #[serde(default = "others")]
    pub laplacians: Vec<String>,
    /// The properties by id; `others` stands for every other one. If absent, all.
    #[serde(default = "others")]
    pub properties: Vec<String>,
    /// The claims by id; `others` stands for every other one. If absent, none.
    #[serde(default)]
    pub claims: Vec<String>,
    /// The effort of the experiments behind the claims.
    #[serde(default)]
    pub effort: Effort,
    /// The exhaustive search for smallest counterexamples, if there is to be one.
    #[serde(default)]
    pub atlas: Option<atlas::Written>,
    /// The domains.
    #[serde(rename = "class", default)]
    pub classes: Vec<Class>,
}

fn others() -> Vec<String> {
    vec![OTHERS.into()]
}

/// A class of domains.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Class {
    /// Its id.
    pub id: String,
    /// A recipe, in which `{name}` stands for a value drawn from `vary` and `{seed}` for a seed drawn for each domain.
    #[serde(default)]
    pub recipe: Option<String>,
    /// How many domains to draw.
    #[serde(default = "one")]
    pub count: usize,
    /// What is drawn for each domain.
    #[serde(default)]
    pub vary: BTreeMap<String, Vary>,
    /// Mesh files instead of a recipe, each perhaps with modifiers.
    #[serde(default)]
    pub files: Vec<String>,
    /// The operators tried on this class, if not the suite's.
    #[serde(default)]
    pub laplacians: Option<Vec<String>>,
    /// Properties left out on this class; "relations" stands for all that compare operators of related domains.
    #[serde(default)]
    pub without: Vec<String>,
}

fn one() -> usize {
    1
}

/// The values that a name in a recipe takes.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
pub enum Vary {
    /// A whole number from a range, both ends included.
    Whole {
        /// Smallest.
        from: u64,
        /// Largest.
        to: u64,
    },
    /// A number from a range, drawn to six digits.
    Number {
        /// Lower end.
        from: f64,
        /// Upper end.
        to: f64,
    },
    /// One of these words, which may hold `{seed}`.
    Choice(Vec<String>),
}

/// Why a suite cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum SuiteError {
    /// The file could not be read.
    #[error("suite {path}: {error}")]
    Read {
        /// Its path.
        path: String,
        /// What the system says.
        error: std::io::Error,
    },
    /// The text is not TOML, or has an unknown key, or lacks one.
    #[error("suite '{suite}': {error}")]
    Syntax {
        /// Which suite.
        suite: String,
        /// What the TOML reader says.
        error: Box<toml::de::Error>,
    },
    /// No suite of this name comes with the program.
    #[error(
        "there is no suite '{id}'; 'lapjury list suites' names those that there are, and a file's name ends in .toml"
    )]
    Unknown {
        /// The name.
        id: String,
    },
    /// A property that is not in the catalogue.
    #[error("suite '{suite}': there is no property '{id}'; 'lapjury list properties' names those that there are")]
    Property {
        /// Which suite.
        suite: String,
        /// The name.
        id: String,
    },
    /// An operator that is not in the catalogue, or does not have these settings.
    #[error("suite '{suite}': {error}")]
    Choice {
        /// Which suite.
        suite: String,
        /// What is wrong.
        error: Box<ChoiceError>,
    },
    /// A claim that there is not.
    #[error("suite '{suite}': {error}")]
    Claim {
        /// Which suite.
        suite: String,
        /// What is wrong.
        error: Box<ClaimError>,
    },
    /// A class that makes no sense.
    #[error("class '{class}' of suite '{suite}' {problem}")]
    Class {
        /// Which suite.
        suite: String,
        /// Which class.
        class: String,
        /// What is wrong.
        problem: String,
    },
    /// An atlas that cannot be searched.
    #[error("the atlas of suite '{suite}' {problem}")]
    Atlas {
        /// Which suite.
        suite: String,
        /// What is wrong.
        problem: String,
    },
    /// A recipe that does not parse.
    #[error("class '{class}' of suite '{suite}': {error}")]
    Recipe {
        /// Which suite.
        suite: String,
        /// Which class.
        class: String,
        /// What is wrong with it.
        error: Box<RecipeError>,
    },
    /// Nothing is selected.
    #[error("suite '{suite}' selects nothing: no domain with an operator and a property, and no claim")]
    Empty {
        /// Which suite.
        suite: String,
    },
}

/// The suites that come with the program.
pub static BUILT_IN: &[(&str, &str)] =
    &[("primer", include_str!("../../suites/primer.toml")), ("smoke", include_str!("../../suites/smoke.toml"))];

impl Suite {
    /// Reads a suite. `name` is used in messages.
    ///
    /// # Errors
    /// Text that is not a suite.
    pub fn parse(name: &str, text: &str) -> Result<Self, SuiteError> {
        toml::from_str(text).map_err(|error| SuiteError::Syntax { suite: name.to_string(), error: Box::new(error) })
    }

    /// The suite with this id that comes with the program.
    ///
    /// # Errors
    /// A name that is not built in.
    pub fn built_in(id: &str) -> Result<Self, SuiteError> {
        let found = BUILT_IN.iter().find(|(name, _)| *name == id);
        let (name, text) = found.ok_or_else(|| SuiteError::Unknown { id: id.to_string() })?;
        Suite::parse(name, text)
    }

    /// The suite in the file of this name if it ends in `.toml`, else the one that comes with the program.
    ///
    /// # Errors
    /// A file that cannot be read, text that is not a suite, a name that is not built in.
    pub fn named(name: &str) -> Result<Self, SuiteError> {
        if Path::new(name).extension().is_none_or(|e| e != "toml") {
            return Suite::built_in(name);
        }
        let text = std::fs::read_to_string(name).map_err(|error| SuiteError::Read { path: name.into(), error })?;
        Suite::parse(name, &text)
    }
}
