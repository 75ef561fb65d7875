//! Writing a record line by line.

use std::collections::BTreeMap;
use std::io::Write;

use super::contents::count;
use super::{ClaimOutcome, Digest, Footer, Line, Record};

/// Why a line could not be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The sink refused.
    #[error("the record could not be written: {0}")]
    Io(#[from] std::io::Error),
    /// Not sayable in JSON.
    #[error("a line of the record could not be put into JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// NaN and infinity have no JSON form: written down they would not read back.
    #[error("a line of the record holds a number that is not finite, which JSON cannot say: {line}")]
    NotFinite {
        /// The beginning of the line.
        line: String,
    },
}

/// Writes lines as they are decided, each flushed, and keeps the digest and the counts of the footer.
pub struct Writer<W: Write> {
    sink: W,
    digest: Digest,
    cells: BTreeMap<String, usize>,
    unexpected: usize,
    broken: usize,
    empty_claims: usize,
}

impl<W: Write> Writer<W> {
    /// A writer of a new record. The first line must be the header.
    pub fn new(sink: W) -> Self {
        Writer { sink, digest: Digest::default(), cells: BTreeMap::new(), unexpected: 0, broken: 0, empty_claims: 0 }
    }

    /// A writer that goes on after the lines of `record`, which the sink already holds.
    ///
    /// # Errors
    /// What JSON cannot say (nothing in this schema).
    pub fn resume(sink: W, record: &Record) -> Result<Self, WriteError> {
        let mut writer = Writer::new(sink);
        for line in record.results() {
            writer.digest.add(&line)?;
            writer.count(&line);
        }
        Ok(writer)
    }

    /// Writes a line and flushes it.
    ///
    /// # Errors
    /// What the sink refuses, and numbers that are not finite.
    pub fn write(&mut self, line: &Line) -> Result<(), WriteError> {
        let mut text = serde_json::to_string(line)?;
        if text.contains("null") && !matches!(super::read::line(&text), Ok(back) if back == *line) {
            return Err(WriteError::NotFinite { line: text.chars().take(200).collect() });
        }
        match line {
            Line::Timing(_) | Line::Footer(_) => {}
            Line::Header(_) => self.digest.add(line)?,
            _ => self.digest.add_text(&text),
        }
        self.count(line);
        text.push('\n');
        self.sink.write_all(text.as_bytes())?;
        Ok(self.sink.flush()?)
    }

    fn count(&mut self, line: &Line) {
        match line {
            Line::Cell(cell) => {
                count(&mut self.cells, cell);
                self.unexpected += usize::from(cell.is_unexpected());
            }
            Line::Claim(claim) => {
                self.unexpected += usize::from(claim.is_unexpected());
                self.empty_claims += usize::from(claim.outcome == ClaimOutcome::Empty);
            }
            Line::Atlas(line) => self.unexpected += usize::from(line.is_unexpected()),
            Line::Broken(_) => self.broken += 1,
            _ => {}
        }
    }

    /// Writes the footer and gives it back.
    ///
    /// # Errors
    /// What the sink refuses.
    pub fn finish(mut self) -> Result<Footer, WriteError> {
        let footer = Footer {
            results_digest: self.digest.value(),
            cells: std::mem::take(&mut self.cells),
            unexpected: self.unexpected,
            broken: self.broken,
            empty_claims: self.empty_claims,
        };
        self.write(&Line::Footer(footer.clone()))?;
        Ok(footer)
    }
}
