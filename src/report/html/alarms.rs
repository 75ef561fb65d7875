//! The page of a campaign for false alarms: operator × class, and the undecided shares.

use maud::{Markup, html};

use super::super::RenderError;
use super::super::alarms::{on, share};
use super::super::number::count;
use super::{replay, scroll, shell};
use crate::record::alarms::{AlarmLine, AlarmTally, Alarms};

/// The page.
///
/// # Errors
/// What JSON cannot say (nothing in this schema).
pub fn page(alarms: &Alarms) -> Result<String, RenderError> {
    let header = header(alarms)?;
    let (operators, classes) = (alarms.distinct(|t| &t.operator), alarms.distinct(|t| &t.class));
    let properties = alarms.distinct(|t| &t.property);
    let main = html! {
        (lines("alarms", "False alarms", "A promised property that fails.", &alarms.alarms))
        (lines("open", "Undecided although all angles are at least 1°", "Conditioning is no excuse there.", &alarms.open))
        section #operators {
            h2 { "False alarms by operator" }
            (table("operator \\ domains", &operators, &classes, |operator, class| {
                false_alarms(&alarms.sum(|t| t.operator == operator && t.class == class))
            }))
            p.legend { "False alarms among the verdicts that say something. " span.key.silent { "·" } " no verdict." }
        }
        section #undecided {
            h2 { "Undecided by property" }
            (table("property \\ domains", &properties, &classes, |property, class| undecided(&on(alarms, property, class))))
            p.legend {
                "The share of promised properties that rounding leaves open, over all operators, of the verdicts that say something."
            }
        }
    };
    let sections = [("operators", "False alarms"), ("undecided", "Undecided")];
    Ok(shell("The jury on trial: false alarms", &sections, header, main))
}

fn header(alarms: &Alarms) -> Result<Markup, RenderError> {
    let all = alarms.sum(|_| true);
    Ok(html! {
        header {
            p.kicker { "lapjury " (alarms.version) }
            h1 { "False alarms" }
            p.summary {
                (count(alarms.cases)) " domains of " (count(alarms.vertices[0])) " to " (count(alarms.vertices[1])) " vertices · seed " (alarms.seed)
                " · " (count(all.total())) " verdicts · "
                @if all.fails == 0 { span.quiet { "0 false alarms" } } @else { a.loud href="#alarms" { (count(all.fails)) " false alarms" } }
                " · " (share(all.undecided, all.decidable())) " undecided, "
                @if all.undecided_healthy == 0 { "none" } @else { a.loud href="#open" { (count(all.undecided_healthy)) } }
                " where all angles are at least 1°"
            }
            p.digest { "results digest " code { (alarms.digest()?) } }
            p.lead {
                "Operators of the catalogue on generated domains, judged on every property that the literature promises of them there. "
                (count(alarms.healthy_cases)) " domains have no angle below 1°; on " (count(alarms.refused)) " the construction gave no operator."
            }
        }
    })
}

fn lines(id: &str, title: &str, meta: &str, lines: &[AlarmLine]) -> Markup {
    html! {
        @if !lines.is_empty() {
            section id=(id) {
                h2 { (title) }
                p.meta { (meta) }
                @for line in lines.iter().take(100) {
                    p { (line.property) " of " (line.operator) ", " (line.class) ": " (line.says) }
                    (replay(&line.replay))
                }
            }
        }
    }
}

fn table(corner: &str, rows: &[&str], columns: &[&str], cell: impl Fn(&str, &str) -> Markup) -> Markup {
    scroll(
        corner,
        html! {
            table.matrix {
                thead { tr { td.corner { (corner) } @for column in columns { th scope="col" { (column) } } } }
                tbody {
                    @for row in rows {
                        tr { th scope="row" { (row) } @for column in columns { (cell(row, column)) } }
                    }
                }
            }
        },
    )
}

fn false_alarms(tally: &AlarmTally) -> Markup {
    let class = if tally.fails > 0 {
        "fails"
    } else if tally.decidable() == 0 {
        "silent"
    } else {
        "holds"
    };
    html! {
        td class=(class) {
            span.numbers { @if tally.decidable() == 0 { "·" } @else { (count(tally.fails)) " of " (count(tally.decidable())) } }
        }
    }
}

fn undecided(tally: &AlarmTally) -> Markup {
    let class = if tally.undecided > 0 {
        "undecided"
    } else if tally.decidable() == 0 {
        "silent"
    } else {
        "holds"
    };
    html! {
        td class=(class) {
            span.numbers {
                @if tally.decidable() == 0 { "·" }
                @else { (share(tally.undecided, tally.decidable())) " of " (count(tally.decidable())) }
            }
        }
    }
}
