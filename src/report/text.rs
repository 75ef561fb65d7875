//! The terminal: the table operators × properties, what was not expected, the claims.

use std::ffi::OsStr;
use std::fmt::Write as _;

use super::sentence::sentence;
use super::taxonomy::{Count, Word};
use crate::record::{Index, Record};

/// How the text is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    /// Whether to colour with ANSI escapes.
    pub colour: bool,
    /// The width of the terminal in characters; the table is broken into bands that fit.
    pub width: usize,
}

impl Default for Style {
    fn default() -> Self {
        Style { colour: false, width: 100 }
    }
}

/// Whether to colour: on a terminal, unless `NO_COLOR` is set to anything but the empty string.
pub fn wants_colour(is_terminal: bool, no_color: Option<&OsStr>) -> bool {
    is_terminal && no_color.is_none_or(OsStr::is_empty)
}

/// The most cells and claims listed as unexpected; the rest is counted.
const LISTED: usize = 20;

/// The whole text.
pub fn text(record: &Record, style: Style) -> String {
    let index = record.index();
    let mut out = summary(record) + "\n\n";
    out += &table(&index, style);
    out += &unexpected(record, style);
    out += &claims(record, style);
    out += &atlas(record);
    for notice in &record.notices {
        out += &format!("\nnotice: {notice}\n");
    }
    out
}

/// One line: suite, seed, how much was done.
pub fn summary(record: &Record) -> String {
    format!(
        "suite {} · seed {} · {} · {} · {}",
        record.header.suite,
        record.header.seed,
        plural(record.domains.len(), "domain"),
        plural(record.cells.len(), "verdict"),
        match record.unexpected() {
            0 => "nothing unexpected".into(),
            n => format!("{n} unexpected"),
        }
    )
}

/// `1 domain`, `2 domains`.
pub(super) fn plural(n: usize, noun: &str) -> String {
    format!("{} {noun}{}", super::number::count(n), if n == 1 { "" } else { "s" })
}

fn table(index: &Index, style: Style) -> String {
    let first = index.laplacians.iter().map(|l| l.chars().count()).max().unwrap_or(0);
    let columns: Vec<Column> = index.properties.iter().map(|p| Column::of(index, p)).collect();
    let mut out = String::new();
    let mut rest = columns.as_slice();
    while !rest.is_empty() {
        let band = band(rest, style.width.saturating_sub(first));
        let (now, later) = rest.split_at(band);
        let heads = now.iter().map(|c| (c.property.to_string(), None));
        out += &line("", first, heads.zip(now).map(|((t, w), c)| (t, w, c.width)), style);
        for (r, laplacian) in index.laplacians.iter().enumerate() {
            let cells = now.iter().map(|c| (c.cells[r].short(), Some(c.cells[r].word()), c.width));
            out += &line(laplacian, first, cells, style);
        }
        out.push('\n');
        rest = later;
    }
    out + "✓ n holds in all n cases   ✗ k/n fails in k of n   ? k/n left open in k of n   – says nothing   · no case\n"
}

struct Column<'a> {
    property: &'a str,
    cells: Vec<Count>,
    width: usize,
}

impl<'a> Column<'a> {
    fn of(index: &Index<'a>, property: &'a str) -> Self {
        let count = |laplacian: &&str| Count::of(index.cells(laplacian, property).iter().copied());
        let cells: Vec<Count> = index.laplacians.iter().map(count).collect();
        let widest = cells.iter().map(|c| c.short().chars().count()).max().unwrap_or(0);
        Column { property, width: widest.max(property.chars().count()), cells }
    }
}

/// How many columns fit; at least one.
fn band(columns: &[Column], width: usize) -> usize {
    let mut used = 0;
    let fits = columns.iter().take_while(|c| {
        used += c.width + 2;
        used <= width
    });
    fits.count().max(1)
}

fn line(head: &str, width: usize, cells: impl Iterator<Item = (String, Option<Word>, usize)>, style: Style) -> String {
    let mut out = format!("{head:<width$}");
    for (text, word, width) in cells {
        let padding = width.saturating_sub(text.chars().count());
        let _ = write!(out, "  {}{:padding$}", paint(&text, word, style), "");
    }
    out.trim_end().to_string() + "\n"
}

/// Blue for holds, yellow for fails, bright black for silence: told apart by everyone.
fn paint(text: &str, word: Option<Word>, style: Style) -> String {
    let code = match word {
        Some(Word::Holds) => "34",
        Some(Word::Fails) => "33",
        Some(Word::Undecided) => "35",
        Some(Word::NotApplicable | Word::NoCase) => "90",
        None => "1",
    };
    if style.colour { format!("\u{1b}[{code}m{text}\u{1b}[0m") } else { text.to_string() }
}

fn unexpected(record: &Record, style: Style) -> String {
    let cells: Vec<_> = record.cells.iter().filter(|c| c.is_unexpected()).collect();
    if cells.is_empty() {
        return String::new();
    }
    let mut out = format!("\n{}\n", paint("Unexpected", None, style));
    for cell in cells.iter().take(LISTED) {
        let _ = writeln!(out, "  {} {} on {}", cell.laplacian, cell.property, cell.recipe);
        let promise = if cell.promised == Some(true) { " although it is promised to hold" } else { "" };
        let _ = writeln!(out, "    {}{promise}: {}", cell.verdict.status(), sentence(&cell.verdict));
        if let crate::record::Recheck::Refused(why) = &cell.recheck {
            let _ = writeln!(out, "    its evidence was refused by the recheck: {why}");
        }
        let _ = writeln!(out, "    {}", cell.replay);
    }
    if cells.len() > LISTED {
        let _ = writeln!(out, "  … and {} more", cells.len() - LISTED);
    }
    out
}

/// How many operators and properties the exhaustive search of small worlds came to what.
fn atlas(record: &Record) -> String {
    if record.atlas.is_empty() {
        return String::new();
    }
    let (failing, holding): (Vec<_>, Vec<_>) = record.atlas.iter().partition(|line| line.found.is_some());
    let proved = failing.iter().filter(|line| line.is_proved()).count();
    format!(
        "\nAtlas: {} failing, {proved} of them by a provably smallest mesh; {} without a counterexample in the small world\n",
        plural(failing.len(), "cell"),
        holding.len()
    )
}

fn claims(record: &Record, style: Style) -> String {
    if record.claims.is_empty() {
        return String::new();
    }
    let width = record.claims.iter().map(|c| c.id.chars().count()).max().unwrap_or(0);
    let mut out = format!("\n{}\n", paint("Claims", None, style));
    for claim in &record.claims {
        let against = if claim.is_unexpected() { format!("   expected: {}", claim.expected) } else { String::new() };
        let _ = writeln!(out, "  {:<width$}  {}{against}", claim.id, claim.outcome);
    }
    out
}
