//! The atlas: the smallest counterexample of each failing cell as a picture, and on how many cases each other one holds.

use maud::{Markup, PreEscaped, html};

use super::super::atlas::cases;
use super::super::number::count;
use super::super::{csv, draw, sentence, svg};
use super::exhibits::capitalised;
use super::{Page, scroll};
use crate::record::{AtlasFound, AtlasLine};

/// The most bytes that the pictures may take; beyond, a counterexample is told in words.
const PICTURES: usize = 700_000;

/// The section; nothing where no world was searched.
pub(super) fn section(page: &Page) -> Markup {
    let lines = &page.record.atlas;
    let failing: Vec<(&AtlasLine, &AtlasFound)> =
        lines.iter().filter_map(|l| l.found.as_deref().map(|found| (l, found))).collect();
    let holding: Vec<&AtlasLine> = lines.iter().filter(|l| l.found.is_none()).collect();
    let mut worlds: Vec<&str> = lines.iter().map(|l| l.world.as_str()).collect();
    worlds.dedup();
    let mut left = PICTURES;
    let plates: Vec<Markup> = failing.iter().map(|(line, found)| plate(page, line, found, &mut left)).collect();
    html! {
        section #atlas {
            h2 { "Atlas of smallest counterexamples" }
            @if lines.is_empty() { p { "No small world was searched exhaustively." } }
            @else {
                p.lead {
                    "Tried: " (worlds.join("; for properties that compare operators of related domains, "))
                    ", once up to the symmetries of the box. Smaller means fewer vertices, then the smaller box, then "
                    "lexicographic order; orange marks what is at fault."
                }
                div.atlas { @for p in &plates { (p) } }
                @if !holding.is_empty() { (scroll("Cells without a counterexample in the small world", table(&holding))) }
            }
        }
    }
}

fn plate(page: &Page, line: &AtlasLine, found: &AtlasFound, left: &mut usize) -> Markup {
    let id = format!("atlas:{}", page.anchors.exhibit(&line.laplacian, &line.property));
    let title = format!("{} fails {} on {}", line.laplacian, line.property, found.cell.recipe);
    let image = draw(&found.exhibit, Some(&found.cell)).map(|p| svg::svg(&p.drawing, &title));
    let image = image.filter(|image| image.len() <= *left);
    *left -= image.as_ref().map_or(0, String::len);
    html! {
        figure.plate id=(id) {
            @match &image {
                Some(image) => (PreEscaped(image)),
                None => p.meta { code { (found.cell.recipe) } },
            }
            figcaption {
                a.self href={ "#" (id) } { b { (line.laplacian) " fails " (line.property) } }
                ": " (cases(line)) ". "
                span title=(found.cell.recipe) { (capitalised(&sentence(&found.cell.verdict))) "; recheck " (csv::recheck(&found.cell.recheck)) "." }
            }
        }
    }
}

fn table(lines: &[&AtlasLine]) -> Markup {
    html! {
        table.list.sortable.filterable {
            thead {
                tr {
                    th { "operator" } th { "property" } th.n { "holds on" } th.n { "left open" } th.n { "n/a" } th.n { "refused" }
                    th { "decided" }
                }
            }
            tbody {
                @for line in lines {
                    tr {
                        td { (line.laplacian) } td { (line.property) }
                        @for n in [line.decided, line.open, line.silent, line.refused] { td.n data-v=(n) { (count(n)) } }
                        td { @if let Some(level) = line.level { (level) } @else { "–" } }
                    }
                }
            }
        }
    }
}
