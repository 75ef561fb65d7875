//! A row for each operator and property: how it was decided, how far from the threshold, what the recheck made of it.

use maud::{Markup, html};

use super::super::number::{count, number};
use super::super::taxonomy::{Count, Word};
use super::{Page, scroll};

/// The section.
pub(super) fn section(page: &Page) -> Markup {
    let pairs = page.index.laplacians.iter().flat_map(|l| page.index.properties.iter().map(move |p| (*l, *p)));
    let rows: Vec<(&str, &str, Count)> = pairs
        .map(|(l, p)| (l, p, Count::of(page.index.cells(l, p).iter().copied())))
        .filter(|r| r.2.total() > 0)
        .collect();
    html! {
        section #evidence {
            h2 { "Evidence" }
            p.lead {
                "Every decision carries a certificate or a witness, which independent code checks again: exactly where "
                "the data are rational, with an error bound elsewhere. The margin is the residual over its threshold; below 1 "
                "rounding explains it."
            }
            (scroll("Evidence by operator and property", html! {
                table.list.sortable.filterable {
                    thead {
                        tr {
                            th { "operator" } th { "property" } th { "verdict" } th.n { "holds" } th.n { "fails" }
                            th.n { "undecided" } th.n { "n/a" } th { "decided" } th.n { "largest margin" }
                            th { "rechecked" } th.n { "unexpected" }
                        }
                    }
                    tbody { @for (l, p, c) in &rows { (row(page, l, p, c)) } }
                }
            }))
        }
    }
}

fn row(page: &Page, laplacian: &str, property: &str, c: &Count) -> Markup {
    let levels: Vec<String> = c.levels.iter().map(|(level, n)| format!("{level} {}", count(*n))).collect();
    html! {
        tr id=(page.anchors.evidence(laplacian, property)) {
            td { (laplacian) }
            td { (property) }
            td class=(c.word().class()) {
                @if c.word() == Word::Fails && page.index.exhibit(laplacian, property).is_some() {
                    a href={ "#" (page.anchors.exhibit(laplacian, property)) } { (c.word().sign()) " " (c.word().text()) }
                } @else { (c.word().sign()) " " (c.word().text()) }
            }
            (n(c.holds)) (n(c.fails)) (n(c.undecided)) (n(c.not_applicable))
            td { (levels.join(", ")) }
            td.n data-v=(c.largest_margin.unwrap_or(-1.0)) { (c.largest_margin.map_or("–".into(), number)) }
            td {
                @if c.rechecked_exactly > 0 { "exact " (count(c.rechecked_exactly)) " " }
                @if c.rechecked_bounded > 0 { "bounded " (count(c.rechecked_bounded)) " " }
                @if c.refused > 0 { strong.loud { "refused " (count(c.refused)) } }
            }
            @if c.unexpected > 0 { td.n data-v=(c.unexpected) { strong.loud { (count(c.unexpected)) } } } @else { (n(0)) }
        }
    }
}

fn n(value: usize) -> Markup {
    html! { td.n data-v=(value) { (count(value)) } }
}
