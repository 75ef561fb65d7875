//! What a trial of planted faults came to: plain data, the only thing that its report reads.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

/// The version of this schema.
pub const PLANTED_SCHEMA: u32 = 1;

/// Faults × meshes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Planted {
    /// [`PLANTED_SCHEMA`].
    pub schema: u32,
    /// The program's version.
    pub version: String,
    /// Which pool of meshes.
    pub size: String,
    /// The seed of the faults.
    pub seed: u64,
    /// The faults, in the order of their catalogue.
    pub faults: Vec<FaultLine>,
    /// The meshes.
    pub meshes: Vec<MeshLine>,
    /// Each fault planted on each mesh.
    pub plantings: Vec<PlantingLine>,
}

/// A fault.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FaultLine {
    /// Its id.
    pub id: String,
    /// What it does.
    pub what: String,
    /// The kind of mistake.
    pub class: String,
    /// The properties that must catch it, the one meant for it first.
    pub caught_by: Vec<String>,
    /// Where no property can.
    pub blind: Vec<String>,
}

/// A mesh of the pool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshLine {
    /// Its recipe, or its name in words.
    pub name: String,
    /// Its class.
    pub class: String,
    /// How many vertices.
    pub vertices: usize,
    /// The smallest angle in degrees, where it has angles.
    pub min_angle_deg: Option<f64>,
    /// The digest of the domain.
    pub digest: String,
}

/// A fault planted on a mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlantingLine {
    /// The fault's id.
    pub fault: String,
    /// The mesh's name.
    pub mesh: String,
    /// The class of the mesh.
    pub class: String,
    /// The label of the operator that was spoilt.
    pub operator: String,
    /// Whether its mass says which one it is.
    pub declared: bool,
    /// What came of it.
    pub result: PlantingResult,
}

/// What came of a planted fault.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum PlantingResult {
    /// It does not apply here, for this reason.
    NotHere(String),
    /// It does not change the operator here.
    Unchanged,
    /// It changes the operator by no more than rounding explains, at every place.
    WithinRounding,
    /// A property that must catch it fails, and did not on the correct operator.
    Caught {
        /// The first of them, in the order of the fault's list.
        by: String,
        /// Every other property that fails now, and did not.
        also: Vec<String>,
    },
    /// Where no property can see it, the comparison with the correct operator does.
    Compared {
        /// Places beyond the bound.
        beyond: usize,
    },
    /// The change lies in the band between rounding and a defect.
    Undecided {
        /// Properties that are undecided now, and were not.
        by: Vec<String>,
        /// Places that the comparison leaves open.
        open: usize,
    },
    /// The change is beyond the band, and nothing that must see it does.
    Missed {
        /// Places beyond the bound of the comparison.
        beyond: usize,
        /// Properties that fail, though nobody said that they would.
        others: Vec<String>,
    },
}

impl PlantingResult {
    /// In a word, as tables have it.
    pub fn word(&self) -> &'static str {
        match self {
            PlantingResult::NotHere(_) => "not here",
            PlantingResult::Unchanged => "unchanged",
            PlantingResult::WithinRounding => "within rounding",
            PlantingResult::Caught { .. } => "caught",
            PlantingResult::Compared { .. } => "compared",
            PlantingResult::Undecided { .. } => "undecided",
            PlantingResult::Missed { .. } => "missed",
        }
    }

    /// By whom: the property, or a reason.
    pub fn by(&self) -> String {
        match self {
            PlantingResult::NotHere(why) => why.clone(),
            PlantingResult::Caught { by, .. } => by.clone(),
            PlantingResult::Compared { .. } => "comparison".into(),
            PlantingResult::Undecided { by, .. } => by.join(" "),
            PlantingResult::Missed { others, .. } => others.join(" "),
            PlantingResult::Unchanged | PlantingResult::WithinRounding => String::new(),
        }
    }
}

impl Planted {
    /// The plantings that were missed.
    pub fn missed(&self) -> impl Iterator<Item = &PlantingLine> {
        self.plantings.iter().filter(|p| matches!(p.result, PlantingResult::Missed { .. }))
    }

    /// How many plantings came to each word.
    pub fn counts(&self) -> BTreeMap<&'static str, usize> {
        let mut counts = BTreeMap::new();
        self.plantings.iter().for_each(|p| *counts.entry(p.result.word()).or_insert(0) += 1);
        counts
    }

    /// The classes of meshes, in the order of the pool.
    pub fn classes(&self) -> Vec<&str> {
        let mut classes: Vec<&str> = Vec::new();
        for mesh in &self.meshes {
            if !classes.contains(&mesh.class.as_str()) {
                classes.push(&mesh.class);
            }
        }
        classes
    }

    /// The digest of everything: the same for any number of threads.
    ///
    /// # Errors
    /// What JSON cannot say (nothing in this schema).
    pub fn digest(&self) -> Result<String, serde_json::Error> {
        hexadecimal(self)
    }
}

/// SHA-256 of the compact JSON of a value, in hexadecimal.
pub(super) fn hexadecimal(value: &impl Serialize) -> Result<String, serde_json::Error> {
    let hash = Sha256::digest(serde_json::to_vec(value)?);
    Ok(hash.iter().map(|b| format!("{b:02x}")).collect())
}
