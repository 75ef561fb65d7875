//! The table operators × properties: how many verdicts of each status.

use std::collections::BTreeMap;

use crate::record::{Cell, Index, Recheck};
use crate::record::{Level, Status};

/// How many cells came out how.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Count {
    /// The property holds.
    pub holds: usize,
    /// It fails.
    pub fails: usize,
    /// It was left open.
    pub undecided: usize,
    /// It says nothing.
    pub not_applicable: usize,
    /// Cells that contradict a promise or had their evidence refused.
    pub unexpected: usize,
    /// Evidence that the recheck verified exactly.
    pub rechecked_exactly: usize,
    /// Evidence that the recheck verified with an error bound.
    pub rechecked_bounded: usize,
    /// Evidence that the recheck refused.
    pub refused: usize,
    /// Decided cells by level.
    pub levels: BTreeMap<Level, usize>,
    /// The largest margin of a holding cell.
    pub largest_margin: Option<f64>,
}

/// What a count says in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Word {
    /// It holds wherever it was decided, and was decided everywhere.
    Holds,
    /// It fails somewhere.
    Fails,
    /// It fails nowhere and was left open somewhere.
    Undecided,
    /// There were cases, and it says nothing on any of them.
    NotApplicable,
    /// There was no case.
    NoCase,
}

impl Word {
    /// The word itself.
    pub fn text(self) -> &'static str {
        match self {
            Word::Holds => "holds",
            Word::Fails => "fails",
            Word::Undecided => "undecided",
            Word::NotApplicable => "n/a",
            Word::NoCase => "no case",
        }
    }

    /// A sign for it, for narrow tables.
    pub fn sign(self) -> &'static str {
        match self {
            Word::Holds => "✓",
            Word::Fails => "✗",
            Word::Undecided => "?",
            Word::NotApplicable => "–",
            Word::NoCase => "·",
        }
    }

    /// A class name for style sheets.
    pub fn class(self) -> &'static str {
        match self {
            Word::Holds => "holds",
            Word::Fails => "fails",
            Word::Undecided => "undecided",
            Word::NotApplicable | Word::NoCase => "silent",
        }
    }
}

impl Count {
    /// Counts cells.
    pub fn of<'a>(cells: impl IntoIterator<Item = &'a Cell>) -> Self {
        let mut count = Count::default();
        cells.into_iter().for_each(|cell| count.add(cell));
        count
    }

    fn add(&mut self, cell: &Cell) {
        let status = cell.verdict.status();
        *match status {
            Status::Holds => &mut self.holds,
            Status::Fails => &mut self.fails,
            Status::Undecided => &mut self.undecided,
            Status::NotApplicable => &mut self.not_applicable,
        } += 1;
        match cell.recheck {
            Recheck::Exact => self.rechecked_exactly += 1,
            Recheck::Bounded => self.rechecked_bounded += 1,
            Recheck::Refused(_) => self.refused += 1,
            Recheck::Open(_) | Recheck::Nothing => {}
        }
        self.unexpected += usize::from(cell.is_unexpected());
        if matches!(status, Status::Holds | Status::Fails) {
            *self.levels.entry(cell.verdict.level).or_insert(0) += 1;
        }
        if let (Status::Holds, Some(margin)) = (status, cell.verdict.margin) {
            self.largest_margin = Some(self.largest_margin.map_or(margin, |m| m.max(margin)));
        }
    }

    /// Cells on which the property says something.
    pub fn applicable(&self) -> usize {
        self.holds + self.fails + self.undecided
    }

    /// All cells.
    pub fn total(&self) -> usize {
        self.applicable() + self.not_applicable
    }

    /// The verdict in one word.
    pub fn word(&self) -> Word {
        match () {
            _ if self.fails > 0 => Word::Fails,
            _ if self.undecided > 0 => Word::Undecided,
            _ if self.holds > 0 => Word::Holds,
            _ if self.not_applicable > 0 => Word::NotApplicable,
            _ => Word::NoCase,
        }
    }

    /// The number of cells that the word speaks of.
    pub fn of_word(&self) -> usize {
        match self.word() {
            Word::Holds => self.holds,
            Word::Fails => self.fails,
            Word::Undecided => self.undecided,
            Word::NotApplicable | Word::NoCase => self.not_applicable,
        }
    }

    /// The sign with its numbers: `✓ 1043`, `✗ 12/1043`, `? 3/1043`, `–`, `·`.
    pub fn short(&self) -> String {
        let sign = self.word().sign();
        match self.word() {
            Word::Holds => format!("{sign} {}", self.holds),
            Word::Fails | Word::Undecided if self.of_word() == self.applicable() => {
                format!("{sign} {}", self.of_word())
            }
            Word::Fails | Word::Undecided => format!("{sign} {}/{}", self.of_word(), self.applicable()),
            Word::NotApplicable | Word::NoCase => sign.to_string(),
        }
    }
}

/// The counts of an operator and a property, by class of domain, in the order of the classes; empty classes left out.
pub fn by_class<'a>(index: &Index<'a>, laplacian: &str, property: &str) -> Vec<(&'a str, Count)> {
    let cells = index.cells(laplacian, property);
    let of_class = |class: &'a str| (class, Count::of(cells.iter().copied().filter(|c| c.class == class)));
    index.classes.iter().map(|class| of_class(class)).filter(|(_, count)| count.total() > 0).collect()
}

/// The taxonomy for programs: `{"laplacian": {"property": {"verdict": …, "holds": …, …}}}`; pairs without a case left out.
pub fn as_json(index: &Index) -> serde_json::Value {
    let mut table = serde_json::Map::new();
    for laplacian in &index.laplacians {
        let mut row = serde_json::Map::new();
        for property in &index.properties {
            let count = Count::of(index.cells(laplacian, property).iter().copied());
            if count.total() > 0 {
                row.insert(property.to_string(), count.as_json());
            }
        }
        table.insert(laplacian.to_string(), row.into());
    }
    table.into()
}

impl Count {
    fn as_json(&self) -> serde_json::Value {
        serde_json::json!({
            "verdict": self.word().text(),
            "holds": self.holds,
            "fails": self.fails,
            "undecided": self.undecided,
            "not_applicable": self.not_applicable,
            "unexpected": self.unexpected,
            "largest_margin": self.largest_margin,
        })
    }
}
