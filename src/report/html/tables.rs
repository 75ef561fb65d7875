//! What was not expected, and the domains.

use maud::{Markup, html};

use super::super::number::{count, degrees};
use super::super::text::plural;
use super::super::{csv, sentence};
use super::{Page, scroll};
use crate::record::{Cell, DomainLine, Recheck};

/// The most unexpected cells spelt out.
const MOST_CELLS: usize = 200;
/// The most domains listed.
const MOST_DOMAINS: usize = 900;

/// What was not expected; nothing where everything was.
pub(super) fn unexpected(page: &Page) -> Markup {
    let cells: Vec<&Cell> = page.record.cells.iter().filter(|c| c.is_unexpected()).collect();
    let claims = page.record.claims.iter().filter(|c| c.is_unexpected()).count();
    if cells.len() + claims == 0 {
        return html! {};
    }
    html! {
        section #unexpected {
            h2 { "Unexpected" }
            @if claims > 0 { p { (plural(claims, "claim")) " did not come out as expected; see " a href="#claims" { "Claims" } "." } }
            @if !cells.is_empty() {
                (scroll("Unexpected verdicts", html! {
                    table.list.sortable {
                        thead { tr { th { "operator" } th { "property" } th { "domain" } th { "verdict" } th { "in words" } th { "repeat" } } }
                        tbody { @for cell in cells.iter().take(MOST_CELLS) { (unexpected_cell(cell)) } }
                    }
                }))
            }
            (more(cells.len(), MOST_CELLS, "cells.csv"))
        }
    }
}

fn unexpected_cell(c: &Cell) -> Markup {
    html! {
        tr {
            td { (c.laplacian) }
            td { (c.property) }
            td { code { (c.recipe) } }
            td {
                (c.verdict.status())
                @if c.promised == Some(true) { " although promised to hold" }
                @if let Recheck::Refused(_) = c.recheck { "; " strong.loud { (csv::recheck(&c.recheck)) } }
            }
            td.prose { (sentence(&c.verdict)) }
            td { code { (c.replay) } }
        }
    }
}

/// The domains, by class and one by one, and what was refused.
pub(super) fn domains(page: &Page) -> Markup {
    let domains = &page.record.domains;
    html! {
        section #domains {
            h2 { "Domains" }
            (scroll("Classes of domains", html! {
                table.list.sortable {
                    thead { tr { th { "class" } th.n { "domains" } th.n { "vertices, from" } th.n { "to" } th.n { "smallest angle" } th.n { "planar" } th.n { "Delaunay" } } }
                    tbody { @for class in &page.index.classes { (class_row(class, domains)) } }
                }
            }))
            (refusals(page))
            details {
                summary { "All domains" }
                (scroll("Domains", html! {
                    table.list.sortable.filterable {
                        thead {
                            tr {
                                th { "domain" } th { "class" } th { "kind" } th.n { "V" } th.n { "E" } th.n { "F" } th.n { "genus" }
                                th { "facts" } th.n { "angles from" } th.n { "to" } th { "notices" }
                            }
                        }
                        tbody { @for d in domains.iter().take(MOST_DOMAINS) { (domain(d)) } }
                    }
                }))
            }
            (more(domains.len(), MOST_DOMAINS, "domains.csv"))
        }
    }
}

fn class_row(class: &str, domains: &[DomainLine]) -> Markup {
    let of: Vec<&DomainLine> = domains.iter().filter(|d| d.class == class).collect();
    let vertices = of.iter().map(|d| d.facts.vertices);
    let surfaces = || of.iter().filter_map(|d| d.facts.surface.as_ref());
    let angle = surfaces().map(|s| s.min_angle_deg).fold(f64::INFINITY, f64::min);
    html! {
        tr {
            td { (class) }
            (n(of.len()))
            (n(vertices.clone().min().unwrap_or(0)))
            (n(vertices.max().unwrap_or(0)))
            @if angle.is_finite() { td.n data-v=(angle) { (degrees(angle)) } } @else { td.n data-v="-1" { "–" } }
            (n(surfaces().filter(|s| s.planar).count()))
            (n(surfaces().filter(|s| s.delaunay == Some(true)).count()))
        }
    }
}

fn domain(d: &DomainLine) -> Markup {
    let s = d.facts.surface.as_ref();
    html! {
        tr {
            td { code { (d.recipe) } }
            td { (d.class) }
            td { (d.facts.kind) }
            (n(d.facts.vertices)) (n(d.facts.edges)) (n(d.facts.faces))
            td.n data-v=(s.and_then(|s| s.genus).map_or(-1, |g| g as i64)) { (s.and_then(|s| s.genus).map_or("–".into(), |g| g.to_string())) }
            td { (facts(d).join(", ")) }
            @if let Some(s) = s {
                td.n data-v=(s.min_angle_deg) { (degrees(s.min_angle_deg)) }
                td.n data-v=(s.max_angle_deg) { (degrees(s.max_angle_deg)) }
            } @else { td.n data-v="-1" { "–" } td.n data-v="-1" { "–" } }
            td.prose { (d.notices.join("; ")) }
        }
    }
}

fn facts(d: &DomainLine) -> Vec<String> {
    let mut facts = Vec::new();
    if d.facts.components != 1 {
        facts.push(format!("{} components", count(d.facts.components)));
    }
    if let Some(s) = &d.facts.surface {
        facts.push(if s.closed { "closed".into() } else { "with boundary".into() });
        facts.extend((!s.manifold).then(|| "not manifold".to_string()));
        facts.extend((!s.orientable).then(|| "not orientable".to_string()));
        facts.extend(s.planar.then(|| "planar".to_string()));
        facts.extend((s.delaunay == Some(true)).then(|| "Delaunay".to_string()));
        facts.extend(s.non_delaunay_edges.filter(|n| *n > 0).map(|n| format!("{} non-Delaunay edges", count(n))));
        facts.extend((s.degenerate_faces > 0).then(|| format!("{} degenerate faces", count(s.degenerate_faces))));
    }
    facts
}

/// Operators that refused a domain, by reason. A refusal is not a verdict.
fn refusals(page: &Page) -> Markup {
    let mut reasons: std::collections::BTreeMap<(&str, &str), (usize, &str)> = std::collections::BTreeMap::new();
    for o in &page.record.operators {
        if let Some(why) = &o.refused {
            reasons.entry((&o.laplacian, why)).or_insert((0, &o.recipe)).0 += 1;
        }
    }
    html! {
        @if !reasons.is_empty() {
            h3 { "Refused" }
            p.meta { "Where an operator was not built there is no verdict." }
            (scroll("Refused operators", html! {
                table.list.sortable {
                    thead { tr { th { "operator" } th { "reason" } th.n { "domains" } th { "first" } } }
                    tbody {
                        @for ((laplacian, why), (times, first)) in reasons.iter().take(MOST_CELLS) {
                            tr { td { (laplacian) } td.prose { (why) } (n(*times)) td { code { (first) } } }
                        }
                    }
                }
            }))
            (more(reasons.len(), MOST_CELLS, "the record"))
        }
    }
}

fn more(all: usize, shown: usize, place: &str) -> Markup {
    html! { @if all > shown { p.notice { (count(all - shown)) " more rows are left out to keep this page small; all are in " (place) "." } } }
}

fn n(value: usize) -> Markup {
    html! { td.n data-v=(value) { (count(value)) } }
}
