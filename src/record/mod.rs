//! The record of a run: JSON lines with a versioned schema, the only thing that a report reads.
//!
//! Each line is one [`Line`]. Timings have a line of their own, so that the digest over the other lines is the same for any
//! number of threads and on any machine.

pub mod alarms;
mod contents;
mod digest;
mod index;
pub mod planted;
mod read;
mod write;

pub use alarms::Alarms;
pub use contents::Record;
pub use digest::Digest;
pub use index::Index;
pub use planted::Planted;
pub use read::ReadError;
pub use write::{WriteError, Writer};

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::domain::Facts;
pub use crate::property::evidence;
pub use crate::property::{Evidence, Excerpt, Level, Outcome, Statement, Status, Tally, Verdict};

/// The version of the schema: raised when a reader of the old one would misread the new one.
pub const SCHEMA: u32 = 1;

/// One line of a record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "line", rename_all = "kebab-case")]
pub enum Line {
    /// First line.
    Header(Header),
    /// A domain that took part.
    Domain(DomainLine),
    /// An operator that was built, or refused to be.
    Operator(OperatorLine),
    /// A domain that could not be made.
    Broken(BrokenLine),
    /// The verdict on one property of one operator on one domain.
    Cell(Cell),
    /// A claim of the literature and what became of it.
    Claim(ClaimLine),
    /// What an exhaustive search of a small world came to, for one operator and one property.
    Atlas(AtlasLine),
    /// The smallest failing case of a (laplacian, property), with its mesh, for pictures and download.
    Exhibit(Exhibit),
    /// Seconds spent; not part of the digest.
    Timing(Timing),
    /// Last line.
    Footer(Footer),
}

/// What was run, by what, where.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// [`SCHEMA`].
    pub schema: u32,
    /// The suite's id.
    pub suite: String,
    /// The seed.
    pub seed: u64,
    /// This program's version.
    pub version: String,
    /// Provenance that is never compared: command, threads, operating system, processor.
    pub environment: BTreeMap<String, String>,
}

/// A domain that took part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DomainLine {
    /// The recipe that makes it again: a file or a generator call with its seed.
    pub recipe: String,
    /// The class in the suite that it belongs to.
    pub class: String,
    /// Content digest.
    pub digest: String,
    /// Computed facts.
    pub facts: Facts,
    /// What was repaired.
    pub notices: Vec<String>,
}

/// A domain that could not be made: the run is incomplete.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BrokenLine {
    /// The recipe.
    pub recipe: String,
    /// The class in the suite that it belongs to.
    pub class: String,
    /// What went wrong.
    pub error: String,
}

/// An operator that was built on a domain, or refused to be.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OperatorLine {
    /// The domain's recipe.
    pub recipe: String,
    /// The operator's label: catalogue id with the parameters that differ from the default, as in `three-point(p=2)`.
    pub laplacian: String,
    /// Why it was not built. A refusal is not a verdict.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
    /// What the construction noted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// The verdict on one property of one operator on one domain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// The domain's recipe.
    pub recipe: String,
    /// The class of the domain in the suite.
    pub class: String,
    /// The operator's label.
    pub laplacian: String,
    /// The property's id.
    pub property: String,
    /// What the jury found.
    pub verdict: Verdict,
    /// What the literature promises here, if anything: true for "holds".
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub promised: Option<bool>,
    /// Whether nothing contradicts the promise.
    pub as_expected: bool,
    /// What the independent recheck made of the evidence.
    pub recheck: Recheck,
    /// The command that repeats this cell alone, where it did not simply hold or say nothing; empty there.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub replay: String,
}

/// What the independent recheck made of a piece of evidence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Recheck {
    /// Verified in exact arithmetic.
    Exact,
    /// Verified in floating point with an error bound.
    Bounded,
    /// Neither verified nor refuted, and why: too large to decide a second time, or not decidable without the construction.
    Open(String),
    /// There is nothing to verify: no decision.
    Nothing,
    /// Refused: a bug in this program, reported as such.
    Refused(String),
}

/// What became of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ClaimOutcome {
    /// Every test agrees and the evidence survived the recheck.
    Confirmed,
    /// True under a hypothesis that the text leaves out; a witness shows that it is needed.
    Amended,
    /// An exact witness contradicts it.
    Refuted,
    /// The tests leave it open.
    Inconclusive,
    /// The tests selected nothing: an error of the claim, never a success.
    Empty,
}

impl std::fmt::Display for ClaimOutcome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            ClaimOutcome::Confirmed => "confirmed",
            ClaimOutcome::Amended => "confirmed with an amendment",
            ClaimOutcome::Refuted => "refuted as stated",
            ClaimOutcome::Inconclusive => "inconclusive",
            ClaimOutcome::Empty => "nothing was tested",
        })
    }
}

/// A claim of the literature and what became of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClaimLine {
    /// The claim's id, as `c33`.
    pub id: String,
    /// The statement, in this project's words.
    pub statement: String,
    /// Where it is stated.
    pub source: String,
    /// The outcome that the tests came to.
    pub outcome: ClaimOutcome,
    /// The outcome that is expected.
    pub expected: ClaimOutcome,
    /// The amended form, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub amendment: Option<String>,
    /// Each test with what it found.
    pub tests: Vec<TestLine>,
}

/// One test of a claim.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TestLine {
    /// What was tested, in words.
    pub question: String,
    /// Which form of the claim it belongs to: "stated" or "amended".
    pub form: String,
    /// Whether it came out in favour.
    pub agrees: bool,
    /// Cases that were decided.
    pub decided: usize,
    /// Cases that were left open.
    pub open: usize,
    /// How it was decided: exact, bounded, measured.
    pub level: Level,
    /// What was found, with the first counterexample or witness.
    pub finding: String,
    /// The command that repeats the deciding case, if one case decides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub replay: Option<String>,
    /// Witnesses and certificates of the deciding cases, each with its own excerpt.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub evidence: Vec<crate::property::Evidence>,
    /// What there is to look at.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub figures: Vec<crate::figure::Figure>,
}

/// The smallest failing case of a (laplacian, property), with its mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Exhibit {
    /// The operator's label.
    pub laplacian: String,
    /// The property's id.
    pub property: String,
    /// The domain's recipe: the cell with this recipe, laplacian and property has the witness.
    pub recipe: String,
    /// Positions (a graph is drawn on a circle).
    pub positions: Vec<[f64; 3]>,
    /// Faces.
    pub faces: Vec<Vec<usize>>,
    /// Edges.
    pub edges: Vec<[usize; 2]>,
}

/// What an exhaustive search of a small world came to, for one operator and one property.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AtlasLine {
    /// The operator's label.
    pub laplacian: String,
    /// The property's id.
    pub property: String,
    /// The world in words.
    pub world: String,
    /// How many domains it has.
    pub size: usize,
    /// How many of them were searched, smallest first: up to the counterexample, else all.
    pub searched: usize,
    /// Of those searched: decided.
    pub decided: usize,
    /// Of those searched: left open.
    pub open: usize,
    /// Of those searched: the property says nothing there.
    pub silent: usize,
    /// Of those searched: the construction refused.
    pub refused: usize,
    /// The weakest level at which one of them was decided.
    pub level: Option<Level>,
    /// The first counterexample.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub found: Option<Box<AtlasFound>>,
}

/// A counterexample that an exhaustive search met first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AtlasFound {
    /// Width and height of its bounding box, in lattice steps.
    pub extent: [i64; 2],
    /// The verdict with its witness.
    pub cell: Cell,
    /// The mesh.
    pub exhibit: Exhibit,
}

impl AtlasLine {
    /// Whether every smaller domain of the world was decided and holds, or is one that the property says nothing about.
    pub fn is_proved(&self) -> bool {
        self.open == 0
    }

    /// Whether the counterexample contradicts a promise or its evidence was refused.
    pub fn is_unexpected(&self) -> bool {
        self.found.as_ref().is_some_and(|found| found.cell.is_unexpected())
    }
}

/// Seconds spent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Wall-clock seconds of the run.
    pub seconds: f64,
    /// Threads used.
    pub threads: usize,
    /// Summed seconds by part: `generate`, `build/cotan`, `decide/PSD`, `recheck`, `claims`.
    pub parts: BTreeMap<String, f64>,
}

/// The last line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Footer {
    /// SHA-256 over the canonical text of every line but header environment, timing and this one.
    pub results_digest: String,
    /// Number of cells by status.
    pub cells: BTreeMap<String, usize>,
    /// Cells that contradict a promise, claims that did not come out as expected, evidence that was refused.
    pub unexpected: usize,
    /// Domains that could not be made.
    pub broken: usize,
    /// Claims whose tests selected nothing.
    pub empty_claims: usize,
}
