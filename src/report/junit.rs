//! `junit.xml` in the dialect that Jenkins reads: a suite for each operator, a test for each property, one for each claim.

use std::fmt::Write as _;

use super::sentence::sentence;
use crate::record::{Cell, ClaimLine, Record};

/// The most unexpected cells spelt out in one test.
const LISTED: usize = 10;

/// The file. A test fails when a cell is unexpected, not when a property fails.
pub fn junit(record: &Record) -> String {
    let index = record.index();
    let mut suites = String::new();
    for laplacian in &index.laplacians {
        let cases: Vec<Case> = index
            .properties
            .iter()
            .map(|property| (property, index.cells(laplacian, property)))
            .filter(|(_, cells)| !cells.is_empty())
            .map(|(property, cells)| Case { name: property.to_string(), failure: cell_failure(cells) })
            .collect();
        suites += &suite(laplacian, &cases);
    }
    if !record.claims.is_empty() {
        let case = |c: &ClaimLine| Case { name: c.id.clone(), failure: claim_failure(c) };
        suites += &suite("claims", &record.claims.iter().map(case).collect::<Vec<_>>());
    }
    format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"lapjury\">\n{suites}</testsuites>\n")
}

struct Case {
    name: String,
    failure: Option<String>,
}

fn suite(name: &str, cases: &[Case]) -> String {
    let failures = cases.iter().filter(|c| c.failure.is_some()).count();
    let name = escape(name);
    let mut out = format!(
        "  <testsuite name=\"{name}\" tests=\"{}\" failures=\"{failures}\" errors=\"0\" skipped=\"0\">\n",
        cases.len()
    );
    for case in cases {
        let _ = write!(out, "    <testcase classname=\"{name}\" name=\"{}\"", escape(&case.name));
        out += &match &case.failure {
            None => "/>\n".to_string(),
            Some(text) => {
                format!(">\n      <failure message=\"unexpected\">{}</failure>\n    </testcase>\n", escape(text))
            }
        };
    }
    out + "  </testsuite>\n"
}

fn cell_failure(cells: &[&Cell]) -> Option<String> {
    let unexpected: Vec<_> = cells.iter().filter(|c| c.is_unexpected()).collect();
    let line = |c: &&&Cell| format!("{}: {}, {}; {}", c.recipe, c.verdict.status(), sentence(&c.verdict), c.replay);
    let lines: Vec<String> = unexpected.iter().take(LISTED).map(line).collect();
    let rest = unexpected.len().saturating_sub(LISTED);
    let more = if rest > 0 { format!("\n… and {rest} more") } else { String::new() };
    (!unexpected.is_empty()).then(|| lines.join("\n") + &more)
}

fn claim_failure(claim: &ClaimLine) -> Option<String> {
    let findings: Vec<String> = claim.tests.iter().map(|t| format!("{}: {}", t.question, t.finding)).collect();
    let text = format!("{}, expected: {}\n{}", claim.outcome, claim.expected, findings.join("\n"));
    claim.is_unexpected().then_some(text)
}

/// Escapes what XML reads as markup and drops what it cannot hold at all.
fn escape(text: &str) -> String {
    let legal = |c: &char| !c.is_control() || matches!(c, '\n' | '\t');
    let mut out = String::with_capacity(text.len());
    for c in text.chars().filter(legal) {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            c => out.push(c),
        }
    }
    out
}
