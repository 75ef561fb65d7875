//! `summary.md`: the taxonomy and what was not expected, for the summary of a CI step.

use std::fmt::Write as _;

use super::sentence::sentence;
use super::taxonomy::Count;
use super::text;
use crate::record::Record;

/// The size that a CI step summary may have.
const LARGEST: usize = 900 * 1024;

/// The summary.
pub fn markdown(record: &Record) -> String {
    let index = record.index();
    let mut out = format!("## Discrete Laplacians on trial\n\n{}\n\n", escape(&text::summary(record)));
    if let Some(footer) = &record.footer {
        let _ = writeln!(out, "Results digest `{}`\n", footer.results_digest);
    }
    let _ = writeln!(out, "| |{}", index.properties.iter().map(|p| format!(" {} |", escape(p))).collect::<String>());
    let _ = writeln!(out, "| --- |{}", " --- |".repeat(index.properties.len()));
    for laplacian in &index.laplacians {
        let cell = |p: &&str| format!(" {} |", Count::of(index.cells(laplacian, p).iter().copied()).short());
        let _ = writeln!(out, "| {} |{}", escape(laplacian), index.properties.iter().map(cell).collect::<String>());
    }
    out += "\n✓ n holds in all n cases · ✗ k/n fails in k of n · ? k/n left open in k of n · – says nothing\n";
    out += &claims(record);
    unexpected(record, &mut out);
    out
}

fn claims(record: &Record) -> String {
    if record.claims.is_empty() {
        return String::new();
    }
    let mut out =
        String::from("\n### Claims\n\n| claim | outcome | expected | statement |\n| --- | --- | --- | --- |\n");
    for c in &record.claims {
        let mark = if c.is_unexpected() { "**" } else { "" };
        let statement = escape(&c.statement);
        let _ = writeln!(out, "| {} | {mark}{}{mark} | {} | {statement} |", escape(&c.id), c.outcome, c.expected);
    }
    out
}

/// Lists what was not expected until the summary is full, and says how much was left out.
fn unexpected(record: &Record, out: &mut String) {
    let cells: Vec<_> = record.cells.iter().filter(|c| c.is_unexpected()).collect();
    if cells.is_empty() {
        return;
    }
    *out += "\n### Unexpected\n\n";
    for (at, cell) in cells.iter().enumerate() {
        let item = format!(
            "- **{} {}** on `{}`: {}, {}. `{}`\n",
            escape(&cell.laplacian),
            escape(&cell.property),
            cell.recipe.replace('`', "'"),
            cell.verdict.status(),
            escape(&sentence(&cell.verdict)),
            cell.replay.replace('`', "'")
        );
        if out.len() + item.len() > LARGEST {
            let _ = writeln!(out, "- … and {} more", cells.len() - at);
            return;
        }
        *out += &item;
    }
}

/// Keeps text from being read as Markdown or HTML.
fn escape(text: &str) -> String {
    let special = |c: char| "\\`*_[]<>|#&".contains(c);
    let escaped = |c: char| match c {
        '\n' | '\r' => vec![' '],
        c if special(c) => vec!['\\', c],
        c => vec![c],
    };
    text.chars().flat_map(escaped).collect()
}
