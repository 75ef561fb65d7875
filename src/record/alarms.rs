//! What a campaign for false alarms came to: plain data, the only thing that its report reads.

use serde::{Deserialize, Serialize};

use super::planted::hexadecimal;

/// The version of this schema.
pub const ALARMS_SCHEMA: u32 = 1;

/// Correct operators × the properties that they promise, on many domains.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Alarms {
    /// [`ALARMS_SCHEMA`].
    pub schema: u32,
    /// The program's version.
    pub version: String,
    /// The seed.
    pub seed: u64,
    /// How many domains.
    pub cases: usize,
    /// How many of them have no angle below 1°.
    pub healthy_cases: usize,
    /// The smallest and the largest number of vertices.
    pub vertices: [usize; 2],
    /// Domains on which the construction gave no operator.
    pub refused: usize,
    /// The counts, by operator, property and class of domain.
    pub tallies: Vec<AlarmTally>,
    /// Promised properties that fail: the first of them.
    pub alarms: Vec<AlarmLine>,
    /// Promised properties that are undecided although all angles are at least 1°: the first of them.
    pub open: Vec<AlarmLine>,
}

/// The verdicts on a promised property of an operator on a class of domains.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AlarmTally {
    /// The operator's label.
    pub operator: String,
    /// The property's id.
    pub property: String,
    /// The class of the domains.
    pub class: String,
    /// How many hold.
    pub holds: usize,
    /// How many are undecided.
    pub undecided: usize,
    /// How many of those where all angles are at least 1°.
    pub undecided_healthy: usize,
    /// How many say nothing.
    pub not_applicable: usize,
    /// How many fail: false alarms.
    pub fails: usize,
}

/// A verdict that should not be.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AlarmLine {
    /// The recipe of the domain.
    pub recipe: String,
    /// The class of the domain.
    pub class: String,
    /// The operator's label.
    pub operator: String,
    /// The property's id.
    pub property: String,
    /// What it says.
    pub says: String,
    /// The command that repeats it.
    pub replay: String,
}

impl AlarmTally {
    /// Every verdict.
    pub fn total(&self) -> usize {
        self.decidable() + self.not_applicable
    }

    /// The verdicts that say something.
    pub fn decidable(&self) -> usize {
        self.holds + self.undecided + self.fails
    }
}

impl Alarms {
    /// The sum of some tallies.
    pub fn sum(&self, keep: impl Fn(&AlarmTally) -> bool) -> AlarmTally {
        let mut sum = AlarmTally::default();
        for t in self.tallies.iter().filter(|t| keep(t)) {
            sum.holds += t.holds;
            sum.undecided += t.undecided;
            sum.undecided_healthy += t.undecided_healthy;
            sum.not_applicable += t.not_applicable;
            sum.fails += t.fails;
        }
        sum
    }

    /// The distinct values of a key of the tallies, in order of appearance.
    pub fn distinct<'a>(&'a self, key: impl Fn(&'a AlarmTally) -> &'a str) -> Vec<&'a str> {
        let mut found: Vec<&str> = Vec::new();
        for t in &self.tallies {
            if !found.contains(&key(t)) {
                found.push(key(t));
            }
        }
        found
    }

    /// The digest of everything: the same for any number of threads.
    ///
    /// # Errors
    /// What JSON cannot say (nothing in this schema).
    pub fn digest(&self) -> Result<String, serde_json::Error> {
        hexadecimal(self)
    }
}
