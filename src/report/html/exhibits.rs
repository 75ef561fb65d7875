//! For each operator and property that fails somewhere, the smallest failing case, with its picture.

use maud::{Markup, PreEscaped, html};

use super::super::number::{count, number};
use super::super::taxonomy::{Count, by_class};
use super::super::{csv, download, draw, sentence, svg};
use super::{Page, replay};
use crate::record::{Cell, Exhibit, Recheck};

/// The most bytes that pictures and meshes may take in the page; beyond, an exhibit is told in words.
const PICTURES: usize = 1_100_000;
/// The largest mesh that is put into the page.
const LARGEST_MESH: usize = 60_000;

/// The section.
pub(super) fn section(page: &Page) -> Markup {
    let mut left = PICTURES;
    let articles: Vec<Markup> = page.record.exhibits.iter().map(|e| article(page, e, &mut left)).collect();
    html! {
        section #exhibits {
            h2 { "Exhibits" }
            @if articles.is_empty() { p { "No property failed on any domain." } }
            @else {
                p.lead { "The smallest failing case of each operator and property. Orange marks what is at fault." }
                div.exhibits { @for a in &articles { (a) } }
            }
        }
    }
}

fn article(page: &Page, exhibit: &Exhibit, left: &mut usize) -> Markup {
    let cell = page.index.cell_of(exhibit);
    let id = page.anchors.exhibit(&exhibit.laplacian, &exhibit.property);
    html! {
        article.exhibit id=(id) {
            h3 { a.self href={ "#" (id) } { (exhibit.laplacian) " fails " (exhibit.property) } }
            (figure(exhibit, cell, left))
            @match cell {
                Some(cell) => (words(cell)),
                None => p { "The record has no cell for this exhibit." },
            }
            (how_often(page, exhibit))
            (mesh(exhibit, left))
            @if let Some(cell) = cell { (replay(&cell.replay)) }
        }
    }
}

fn figure(exhibit: &Exhibit, cell: Option<&Cell>, left: &mut usize) -> Markup {
    let Some(picture) = draw(exhibit, cell) else { return html! { p.meta { "There is nothing to draw." } } };
    let legend =
        cell.and_then(|c| c.verdict.evidence()).map(super::super::highlight::Highlight::of).unwrap_or_default().legend;
    let title = format!("{} fails {} on {}", exhibit.laplacian, exhibit.property, exhibit.recipe);
    let image = svg::svg(&picture.drawing, &title);
    if image.len() > *left {
        return html! { p.meta { "The picture is left out to keep this page small; the command below draws it." } };
    }
    *left -= image.len();
    html! {
        figure {
            (PreEscaped(image))
            @if !legend.is_empty() { figcaption { "Coloured: " (legend) "." } }
            @if picture.left_out > 0 {
                figcaption { "Only the neighbourhood is drawn; " (count(picture.left_out)) " more elements are left out." }
            }
        }
    }
}

fn words(cell: &Cell) -> Markup {
    let verdict = &cell.verdict;
    html! {
        p.sentence { (capitalised(&sentence(verdict))) "." }
        p.meta {
            "On " code { (cell.recipe) } " (" (cell.class) "); decided: " (verdict.level)
            @if let Some(margin) = verdict.margin { ", margin " (number(margin)) }
            @if let Some(t) = &verdict.tally {
                "; violations: " (count(t.violations)) ", zeros: " (count(t.zeros)) " of " (count(t.total)) " places"
            }
            "; recheck: "
            @match &cell.recheck {
                Recheck::Refused(_) => strong.loud { (csv::recheck(&cell.recheck)) },
                _ => { (csv::recheck(&cell.recheck)) },
            }
            "."
        }
        @for note in &verdict.notes { p.meta { (note) } }
    }
}

/// In how many cases of which classes it fails.
fn how_often(page: &Page, exhibit: &Exhibit) -> Markup {
    let classes = by_class(&page.index, &exhibit.laplacian, &exhibit.property);
    let of = |c: &Count| format!("{} of {}", count(c.fails), count(c.applicable()));
    let failing: Vec<String> =
        classes.iter().filter(|c| c.1.fails > 0).map(|(name, c)| format!("{name} {}", of(c))).collect();
    html! { @if !failing.is_empty() { p.meta { "Fails on: " (failing.join(", ")) "." } } }
}

fn mesh(exhibit: &Exhibit, left: &mut usize) -> Markup {
    let (ending, text) = download::mesh(exhibit);
    if text.len() > LARGEST_MESH || 2 * text.len() > *left {
        return html! { p.meta { "The mesh has " (count(exhibit.positions.len())) " vertices; the command below makes it." } };
    }
    let address = download::address("text/plain", text.as_bytes());
    *left = left.saturating_sub(address.len());
    let name = format!("{}-{}.{ending}", exhibit.laplacian, exhibit.property);
    html! { p.meta { a download=(name) href=(address) { "Download the mesh (." (ending) ")" } } }
}

/// With a capital letter at its beginning, where it begins with a word and not with a formula.
pub(super) fn capitalised(sentence: &str) -> String {
    let mut chars = sentence.chars();
    match (chars.next(), sentence.chars().nth(1)) {
        (Some(first), Some(second)) if second.is_ascii_lowercase() => first.to_uppercase().chain(chars).collect(),
        _ => sentence.to_string(),
    }
}
