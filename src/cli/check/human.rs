//! What `check` answers, as text for people.

use super::{Decided, colour};
use crate::domain::Facts;
use crate::external::Comparison;
use crate::operator::Operator;
use crate::property::Status;
use crate::record::Recheck;
use crate::report::number::number;

/// Where what belongs to a verdict is set in, below the status.
const INDENT: &str = "\n             ";

pub(super) fn human(
    source: &str,
    facts: &Facts,
    operator: &Operator,
    decided: &[Decided],
    comparisons: &[Comparison],
) -> String {
    let mut text = format!("{}\n{}\n", domain_line(source, facts), operator_line(operator));
    for d in decided {
        text += &verdict_line(d);
    }
    for c in comparisons {
        text += &format!("\n{c}\n");
    }
    text
}

fn domain_line(source: &str, facts: &Facts) -> String {
    let mut text = format!(
        "{source}: {} with {} vertices, {} edges, {} faces, {} component{}",
        facts.kind,
        facts.vertices,
        facts.edges,
        facts.faces,
        facts.components,
        if facts.components == 1 { "" } else { "s" }
    );
    if let Some(s) = &facts.surface {
        text += &format!(", angles {:.4}° to {:.4}°", s.min_angle_deg, s.max_angle_deg);
        if let Some(n) = s.non_delaunay_edges {
            text += &format!(", {n} non-Delaunay edges");
            if let Some(near) = s.non_delaunay_within_rounding.filter(|near| *near > 0) {
                text += &format!(" ({near} of them within the rounding of the coordinates)");
            }
        }
    }
    text
}

fn operator_line(operator: &Operator) -> String {
    let provenance = operator.provenance();
    let settings: Vec<String> = provenance.parameters.iter().map(|(k, v)| format!("{k}={v}")).collect();
    let mut text = format!("operator {} {}\n", provenance.id, settings.join(", "));
    for note in &provenance.notes {
        text += &format!("  {note}\n");
    }
    text
}

fn verdict_line(decided: &Decided) -> String {
    let verdict = &decided.verdict;
    let status = verdict.status();
    let mark = match status {
        _ if !colour() => "",
        Status::Holds => "\u{1b}[34m",
        Status::Fails => "\u{1b}[33m",
        _ => "\u{1b}[2m",
    };
    let reset = if mark.is_empty() { "" } else { "\u{1b}[0m" };
    let mut text = format!("{:<13}{mark}{status:<15}{reset}{:<9}", decided.property.id, verdict.level);
    if let Some(t) = &verdict.tally {
        text += &format!(" {} of {} violated", t.violations, t.total);
        if t.zeros > 0 {
            text += &format!(", {} zero", t.zeros);
        }
        if t.undecided > 0 {
            text += &format!(", {} within rounding", t.undecided);
        }
    }
    if let Some(margin) = verdict.margin {
        text += &format!(" margin {}", number(margin));
    }
    if let Some(reason) = verdict.reason() {
        text += &format!(" {reason}");
    }
    if status == Status::Fails {
        text += &format!("{INDENT}{}", crate::report::sentence(verdict));
    }
    for note in &verdict.notes {
        text += &format!("{INDENT}{note}");
    }
    if let Recheck::Refused(why) = &decided.recheck {
        text += &format!("{INDENT}the evidence did not survive the recheck, which is a bug in lapjury: {why}");
    }
    if !crate::suite::cases::as_expected(decided.promised, verdict) {
        text += &format!("{INDENT}unexpected: this property is promised here");
    }
    text + "\n"
}
