//! An operator of the catalogue with settings, as a suite or a command names it.

use std::fmt;
use std::str::FromStr;

use super::call::{Call, CallError};
use crate::domain::{Domain, Facts, Surface};
use crate::laplacian::exact::{self, Twin};
use crate::laplacian::{self, BuildError, Laplacian};
use crate::operator::Operator;
use crate::parameter::SettingsError;

/// An entry of the catalogue with the settings that were given; its text is the operator's label, as in `three-point:p=2`.
#[derive(Clone)]
pub struct Choice {
    /// The entry.
    pub laplacian: &'static Laplacian,
    call: Call,
}

/// Why a text names no operator.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChoiceError {
    /// It is not written as an id with settings.
    #[error(transparent)]
    Call(#[from] CallError),
    /// No such entry.
    #[error("there is no operator '{id}'; 'lapjury list laplacians' names those that there are")]
    Unknown {
        /// The id.
        id: String,
    },
    /// Settings that the entry does not admit.
    #[error(transparent)]
    Settings(#[from] SettingsError),
}

impl Choice {
    /// Builds the operator.
    ///
    /// # Errors
    /// What the entry refuses.
    pub fn build(&self, domain: &Domain) -> Result<Operator, BuildError> {
        self.laplacian.build(domain, &self.call.settings)
    }

    /// The exact matrices on a planar mesh; `None` where the operator is not rational, or the mesh not planar.
    pub fn twin(&self, surface: &Surface) -> Option<Twin> {
        exact::twin(self.laplacian, &self.laplacian.check(&self.call.settings).ok()?, surface)
    }

    /// What the entry promises of the property on a domain with these facts: `Some(true)` that it holds, `None` nothing.
    pub fn promises(&self, property: &str, facts: &Facts) -> Option<bool> {
        self.laplacian.promises_with(property, facts, &self.call.settings)
    }

    /// Whether a setting was given, rather than left at its default.
    pub fn names(&self, key: &str) -> bool {
        self.call.settings.contains_key(key)
    }

    /// The same choice with one more setting.
    ///
    /// # Errors
    /// A setting that the entry does not admit.
    pub fn with(mut self, key: &str, value: &str) -> Result<Self, ChoiceError> {
        self.call.settings.insert(key.into(), value.into());
        self.laplacian.check(&self.call.settings)?;
        Ok(self)
    }
}

impl FromStr for Choice {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        let call: Call = text.parse()?;
        let laplacian = laplacian::find(&call.id).ok_or_else(|| ChoiceError::Unknown { id: call.id.clone() })?;
        laplacian.check(&call.settings)?;
        Ok(Choice { laplacian, call })
    }
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.call.fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_label_reads_back_as_the_same_choice() {
        for entry in laplacian::ALL {
            assert_eq!(entry.id.parse::<Choice>().unwrap().to_string(), entry.id);
        }
        let choice: Choice = " three-point : p = 2".parse().unwrap();
        assert_eq!(choice.to_string(), "three-point:p=2");
        assert_eq!(choice.with("p", "0.5").unwrap().to_string(), "three-point:p=0.5");
    }

    #[test]
    fn what_the_catalogue_does_not_have_is_refused_with_advice() {
        let message = |text: &str| text.parse::<Choice>().err().unwrap().to_string();
        assert_eq!(
            message("cotangent"),
            "there is no operator 'cotangent'; 'lapjury list laplacians' names those that there are"
        );
        assert_eq!(message("graph:p=2"), "'graph' has no parameter 'p'; it has none");
        assert!(message("three-point:p=99").contains("it must be a number from -8.0 to 8.0"));
        assert!("graph".parse::<Choice>().unwrap().with("mass", "voronoi").is_err());
    }
}
