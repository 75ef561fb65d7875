//! The claims of the literature: a table, then a section each with a permanent anchor.

use std::collections::BTreeSet;

use maud::{Markup, PreEscaped, html};

use super::super::figure::{Drawn, drawn};
use super::super::figures;
use super::super::number::count;
use super::super::plot::PlotError;
use super::super::statement;
use super::{Page, replay, scroll};
use crate::record::{ClaimLine, ClaimOutcome, TestLine};

/// The section.
pub(super) fn section(page: &Page) -> Result<Markup, PlotError> {
    let claims = &page.record.claims;
    Ok(html! {
        section #claims {
            h2 { "Claims" }
            @if claims.is_empty() { p { "The suite tests no claim of the literature." } }
            @else {
                (scroll("Claims", html! {
                    table.list.sortable {
                        thead { tr { th { "claim" } th { "outcome" } th { "expected" } th { "statement" } } }
                        tbody {
                            @for c in claims {
                                tr {
                                    td { a href={ "#" (page.anchors.claim(&c.id)) } { (c.id) } }
                                    td { (outcome(c)) }
                                    td { @if c.is_unexpected() { strong.loud { (c.expected) } } @else { "as expected" } }
                                    td.prose { (c.statement) }
                                }
                            }
                        }
                    }
                }))
                @for c in claims { (claim(page, c)?) }
            }
        }
    })
}

fn claim(page: &Page, c: &ClaimLine) -> Result<Markup, PlotError> {
    let commands: BTreeSet<&String> = c.tests.iter().filter_map(|t| t.replay.as_ref()).collect();
    Ok(html! {
        article.claim id=(page.anchors.claim(&c.id)) {
            h3 { a.self href={ "#" (page.anchors.claim(&c.id)) } { (c.id) } " " (outcome(c)) }
            blockquote { p { (c.statement) } }
            @if let Some(amendment) = &c.amendment { p { b { "Amended: " } (amendment) } }
            p.meta {
                "Source: " (c.source) ". "
                @if c.is_unexpected() { strong.loud { "Expected: " (c.expected) "." } } @else { "This is the expected outcome." }
            }
            @if c.tests.is_empty() { p { "Nothing was tested." } }
            @else {
                (scroll(&format!("Tests of {}", c.id), html! {
                    table.list {
                        thead { tr { th { "test" } th { "form" } th { "in favour" } th.n { "decided" } th.n { "open" } th { "level" } th { "finding" } } }
                        tbody { @for t in &c.tests { (test(t)) } }
                    }
                }))
                (pictures(c)?)
                @for command in commands { (replay(command)) }
            }
        }
    })
}

/// The pictures of what the tests of a claim show.
fn pictures(c: &ClaimLine) -> Result<Markup, PlotError> {
    let of_evidence = c.tests.iter().flat_map(|t| &t.evidence).flat_map(figures);
    let all: Vec<Drawn> = of_evidence.chain(drawn(c)?).collect();
    Ok(html! {
        @for picture in all {
            figure { div.scroll { (PreEscaped(picture.svg)) } figcaption { (picture.caption) "." } }
        }
    })
}

fn test(t: &TestLine) -> Markup {
    html! {
        tr {
            td.prose { (t.question) }
            td { (t.form) }
            @match (t.decided, t.agrees) {
                (0, _) => { td.undecided { "open" } }
                (_, true) => { td.holds { "✓ yes" } }
                (_, false) => { td.fails { "✗ no" } }
            }
            td.n { (count(t.decided)) }
            td.n { (count(t.open)) }
            td { (t.level) }
            td.prose {
                (t.finding)
                @for evidence in &t.evidence { p.meta { "Evidence: " (statement(evidence)) "." } }
            }
        }
    }
}

fn outcome(c: &ClaimLine) -> Markup {
    let class = match c.outcome {
        ClaimOutcome::Confirmed => "holds",
        ClaimOutcome::Amended | ClaimOutcome::Refuted => "fails",
        ClaimOutcome::Inconclusive | ClaimOutcome::Empty => "undecided",
    };
    html! { span class={ "key " (class) } { (c.outcome) } }
}
