//! The taxonomy: operators × properties, a verdict in each cell.

use maud::{Markup, html};

use super::super::number::count;
use super::super::taxonomy::{Count, Word};
use super::{Page, scroll};

/// Up to this many properties stand side by side, as on paper; more stand below each other.
const SIDE_BY_SIDE: usize = 10;

/// The section.
pub(super) fn section(page: &Page) -> Markup {
    let (laplacians, properties) = (&page.index.laplacians, &page.index.properties);
    let upright = properties.len() > SIDE_BY_SIDE;
    let (rows, columns) = if upright { (properties, laplacians) } else { (laplacians, properties) };
    html! {
        section #taxonomy {
            h2 { "Taxonomy" }
            @if rows.is_empty() || columns.is_empty() { p { "The record has no verdicts." } }
            @else {
                (scroll("Taxonomy, operators and properties", html! {
                    table.matrix {
                        thead {
                            tr {
                                td.corner { @if upright { "property \\ operator" } @else { "operator \\ property" } }
                                @for column in columns { th scope="col" { (head(page, column)) } }
                            }
                        }
                        tbody {
                            @for row in rows {
                                tr {
                                    th scope="row" { (head(page, row)) }
                                    @for column in columns {
                                        @let (l, p) = if upright { (column, row) } else { (row, column) };
                                        (cell(page, l, p))
                                    }
                                }
                            }
                        }
                    }
                }))
                p.legend {
                    span.key.holds { "✓ holds" } " in all of n cases; "
                    span.key.fails { "✗ fails" } " in k of n; "
                    span.key.undecided { "? undecided" } " in k of n and fails in none; "
                    span.key.silent { "– n/a" } " says nothing on any domain; "
                    span.key.silent { "· no case" } " was not asked. Each cell leads to its evidence."
                }
            }
        }
    }
}

fn head(page: &Page, label: &str) -> Markup {
    let (id, parameters) = label.split_at(label.find('(').unwrap_or(label.len()));
    html! { span.id { (id) wbr; (parameters) } @if let Some(name) = page.options.name(label) { " " span.name { (name) } } }
}

fn cell(page: &Page, laplacian: &str, property: &str) -> Markup {
    let counts = Count::of(page.index.cells(laplacian, property).iter().copied());
    let word = counts.word();
    if word == Word::NoCase {
        return html! { td.silent { span.sign aria-hidden="true" { "·" } " " span.word { "no case" } } };
    }
    let target = match word == Word::Fails && page.index.exhibit(laplacian, property).is_some() {
        true => page.anchors.exhibit(laplacian, property),
        false => page.anchors.evidence(laplacian, property),
    };
    html! {
        td class=(word.class()) {
            a href={ "#" (target) } {
                span.sign aria-hidden="true" { (word.sign()) } " " span.word { (word.text()) }
                @if word != Word::NotApplicable {
                    " " span.numbers { (count(counts.of_word())) " of " (count(counts.applicable())) }
                }
                @if counts.unexpected > 0 { " " span.loud { (count(counts.unexpected)) " unexpected" } }
            }
        }
    }
}
