//! A whole record in memory.

use std::collections::BTreeMap;

use super::{
    AtlasLine, BrokenLine, Cell, ClaimLine, Digest, DomainLine, Exhibit, Footer, Header, Index, Line, OperatorLine,
    Recheck, Timing, WriteError, Writer,
};

/// Everything that a run wrote, each kind of line in the order in which it came.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// What was run.
    pub header: Header,
    /// The domains.
    pub domains: Vec<DomainLine>,
    /// The domains that could not be made.
    pub broken: Vec<BrokenLine>,
    /// The operators, refusals included.
    pub operators: Vec<OperatorLine>,
    /// The verdicts.
    pub cells: Vec<Cell>,
    /// The claims.
    pub claims: Vec<ClaimLine>,
    /// The exhaustive searches of small worlds.
    pub atlas: Vec<AtlasLine>,
    /// The smallest failing cases.
    pub exhibits: Vec<Exhibit>,
    /// Seconds spent, where the run came to its end.
    pub timing: Option<Timing>,
    /// The last line, where the run came to its end.
    pub footer: Option<Footer>,
    /// What the reader noticed: a torn last line that was dropped.
    pub notices: Vec<String>,
}

impl Record {
    /// A record with a header and nothing else.
    pub fn new(header: Header) -> Self {
        Record {
            header,
            domains: Vec::new(),
            broken: Vec::new(),
            operators: Vec::new(),
            cells: Vec::new(),
            claims: Vec::new(),
            atlas: Vec::new(),
            exhibits: Vec::new(),
            timing: None,
            footer: None,
            notices: Vec::new(),
        }
    }

    /// Takes a line in. A header replaces the header; of two timings (a run that was interrupted and went on) the seconds
    /// add up.
    pub fn push(&mut self, line: Line) {
        match line {
            Line::Header(h) => self.header = h,
            Line::Domain(d) => self.domains.push(d),
            Line::Broken(b) => self.broken.push(b),
            Line::Operator(o) => self.operators.push(o),
            Line::Cell(c) => self.cells.push(c),
            Line::Claim(c) => self.claims.push(c),
            Line::Atlas(a) => self.atlas.push(a),
            Line::Exhibit(e) => self.exhibits.push(e),
            Line::Timing(t) => match &mut self.timing {
                None => self.timing = Some(t),
                Some(sum) => add(sum, t),
            },
            Line::Footer(f) => self.footer = Some(f),
        }
    }

    /// The lines that are results, in canonical order: header, domains, those that could not be made, operators, cells, claims, atlas,
    /// exhibits.
    pub fn results(&self) -> impl Iterator<Item = Line> + '_ {
        std::iter::once(Line::Header(self.header.clone()))
            .chain(self.domains.iter().cloned().map(Line::Domain))
            .chain(self.broken.iter().cloned().map(Line::Broken))
            .chain(self.operators.iter().cloned().map(Line::Operator))
            .chain(self.cells.iter().cloned().map(Line::Cell))
            .chain(self.claims.iter().cloned().map(Line::Claim))
            .chain(self.atlas.iter().cloned().map(Line::Atlas))
            .chain(self.exhibits.iter().cloned().map(Line::Exhibit))
    }

    /// Writes the whole record in canonical order; timing and footer only where the record has them.
    ///
    /// # Errors
    /// What the sink refuses, and numbers that JSON cannot say.
    pub fn write(&self, sink: impl std::io::Write) -> Result<(), WriteError> {
        let mut writer = Writer::new(sink);
        self.results().try_for_each(|line| writer.write(&line))?;
        if let Some(timing) = &self.timing {
            writer.write(&Line::Timing(timing.clone()))?;
        }
        if self.footer.is_some() {
            writer.finish()?;
        }
        Ok(())
    }

    /// The digest of the results (see [`Digest`]).
    ///
    /// # Errors
    /// What JSON cannot say (nothing in this schema).
    pub fn digest(&self) -> Result<String, serde_json::Error> {
        let mut digest = Digest::default();
        self.results().try_for_each(|line| digest.add(&line))?;
        Ok(digest.value())
    }

    /// Lookups by key. Cost: O(n log n).
    pub fn index(&self) -> Index<'_> {
        Index::of(self)
    }

    /// How many cells, claims and smallest counterexamples did not come out as expected, or had their evidence refused.
    pub fn unexpected(&self) -> usize {
        self.cells.iter().filter(|c| c.is_unexpected()).count()
            + self.claims.iter().filter(|c| c.is_unexpected()).count()
            + self.atlas.iter().filter(|a| a.is_unexpected()).count()
    }
}

fn add(sum: &mut Timing, more: Timing) {
    sum.seconds += more.seconds;
    sum.threads = sum.threads.max(more.threads);
    for (part, seconds) in more.parts {
        *sum.parts.entry(part).or_insert(0.0) += seconds;
    }
}

impl Cell {
    /// Whether it contradicts a promise or its evidence was refused.
    pub fn is_unexpected(&self) -> bool {
        !self.as_expected || matches!(self.recheck, Recheck::Refused(_))
    }
}

impl ClaimLine {
    /// Whether the outcome is not the expected one.
    pub fn is_unexpected(&self) -> bool {
        self.outcome != self.expected
    }
}

/// The number of cells by status, as the footer states it.
pub(super) fn count(cells: &mut BTreeMap<String, usize>, cell: &Cell) {
    *cells.entry(cell.verdict.status().to_string()).or_insert(0) += 1;
}
