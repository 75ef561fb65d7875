//! Parameters of catalogue entries: declared with their range, checked before anything is built.

use std::collections::BTreeMap;

/// A parameter of a construction or a generator.
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// What it means, with its unit.
    pub meaning: &'static str,
    /// The value where none is given.
    pub default: &'static str,
    /// The values admitted.
    pub range: Range,
}

/// The values that a parameter admits.
pub enum Range {
    /// One of these words.
    Choice(&'static [&'static str]),
    /// A number between two bounds, both included.
    Number(f64, f64),
    /// A whole number between two bounds, both included.
    Whole(u64, u64),
    /// A text of a form, described in words.
    Form(&'static str, fn(&str) -> bool),
}

impl Range {
    /// Whether a value is admitted.
    pub fn admits(&self, value: &str) -> bool {
        match self {
            Range::Choice(words) => words.contains(&value),
            Range::Number(low, high) => value.parse::<f64>().is_ok_and(|x| (*low..=*high).contains(&x)),
            Range::Whole(low, high) => value.parse::<u64>().is_ok_and(|x| (*low..=*high).contains(&x)),
            Range::Form(_, admits) => admits(value),
        }
    }
}

impl std::fmt::Display for Range {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Range::Choice(words) => write!(f, "one of {}", words.join(", ")),
            Range::Number(low, high) => write!(f, "a number from {low:?} to {high:?}"),
            Range::Whole(low, high) => write!(f, "a whole number from {low} to {high}"),
            Range::Form(words, _) => f.write_str(words),
        }
    }
}

/// Why parameters were refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SettingsError {
    /// A parameter that the entry does not have.
    #[error("'{entry}' has no parameter '{name}'; it has {}", if known.is_empty() { "none" } else { known })]
    Unknown {
        /// The entry.
        entry: String,
        /// The name given.
        name: String,
        /// The names known.
        known: String,
    },
    /// A parameter value that is not admitted.
    #[error("parameter '{parameter}' of '{entry}' is '{value}'; it must be {range}")]
    OutOfRange {
        /// The entry.
        entry: String,
        /// The parameter.
        parameter: &'static str,
        /// The value given.
        value: String,
        /// The values admitted.
        range: String,
    },
}

/// The checked values of an entry's parameters, defaults filled in.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings(BTreeMap<String, String>);

impl Settings {
    /// Checks what is given against the parameters of an entry and fills in the defaults.
    ///
    /// # Errors
    /// An unknown parameter, or a value out of range.
    pub fn new(entry: &str, parameters: &[Parameter], given: &BTreeMap<String, String>) -> Result<Self, SettingsError> {
        let entry = entry.to_string();
        if let Some(name) = given.keys().find(|k| parameters.iter().all(|p| p.name != k.as_str())) {
            let known = parameters.iter().map(|p| p.name).collect::<Vec<_>>().join(", ");
            return Err(SettingsError::Unknown { entry, name: name.clone(), known });
        }
        let mut values = BTreeMap::new();
        for parameter in parameters {
            let value = given.get(parameter.name).map_or(parameter.default, String::as_str).to_string();
            if !parameter.range.admits(&value) {
                let (parameter, range) = (parameter.name, parameter.range.to_string());
                return Err(SettingsError::OutOfRange { entry, parameter, value, range });
            }
            values.insert(parameter.name.to_string(), value);
        }
        Ok(Settings(values))
    }

    /// The value of a parameter of the entry.
    ///
    /// # Panics
    /// If the entry declares no such parameter: a mistake in the entry, found by its first test.
    pub fn get(&self, name: &str) -> &str {
        self.0.get(name).unwrap_or_else(|| panic!("the entry declares no parameter '{name}'"))
    }

    /// The value of a parameter that the entry declares as a number.
    ///
    /// # Panics
    /// As [`Settings::get`], or if the parameter's range is not numeric.
    pub fn number(&self, name: &str) -> f64 {
        self.get(name).parse().unwrap_or_else(|_| panic!("parameter '{name}' is not declared as a number"))
    }

    /// The value of a parameter that the entry declares as a whole number.
    ///
    /// # Panics
    /// As [`Settings::get`], or if the parameter's range is not [`Range::Whole`].
    pub fn whole(&self, name: &str) -> usize {
        self.get(name).parse().unwrap_or_else(|_| panic!("parameter '{name}' is not declared as a whole number"))
    }

    /// All values, for the provenance.
    pub fn all(&self) -> &BTreeMap<String, String> {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_names_and_values_out_of_range_are_refused_by_name() {
        let p = [Parameter { name: "n", meaning: "", default: "3", range: Range::Whole(1, 9) }];
        let given = |k: &str, v: &str| BTreeMap::from([(k.to_string(), v.to_string())]);
        assert_eq!(Settings::new("x", &p, &BTreeMap::new()).unwrap().whole("n"), 3);
        assert_eq!(
            Settings::new("x", &p, &given("n", "10")).unwrap_err().to_string(),
            "parameter 'n' of 'x' is '10'; it must be a whole number from 1 to 9"
        );
        assert_eq!(
            Settings::new("x", &p, &given("m", "1")).unwrap_err().to_string(),
            "'x' has no parameter 'm'; it has n"
        );
    }
}
