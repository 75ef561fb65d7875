//! One self-contained page: it works from `file://` without a request, reads without JavaScript and without a style sheet,
//! on light and dark screens, narrow ones, and on paper. A file for each section.

mod alarms;
mod anchor;
mod atlas;
mod claims;
mod evidence;
mod exhibits;
mod header;
mod matrix;
mod planted;
mod provenance;
mod shell;
mod tables;

use maud::{Markup, PreEscaped, html};

use super::plot::charts;
use super::{File, Options, RenderError};
use crate::record::{Index, Record};
pub(super) use alarms::page as alarms_page;
use anchor::Anchors;
pub(super) use planted::page as planted_page;
use shell::shell;

/// What every section needs.
struct Page<'a> {
    record: &'a Record,
    index: Index<'a>,
    options: &'a Options,
    anchors: Anchors,
}

/// The sections, by anchor and title, as the navigation lists them.
const SECTIONS: [(&str, &str); 9] = [
    ("taxonomy", "Taxonomy"),
    ("claims", "Claims"),
    ("atlas", "Atlas"),
    ("exhibits", "Exhibits"),
    ("evidence", "Evidence"),
    ("plots", "Plots"),
    ("domains", "Domains"),
    ("provenance", "Provenance"),
    ("sources", "Sources"),
];

/// The page. `files` are the other files of the report: small tables are put into the page as downloads, large ones are
/// linked where they lie, beside it.
///
/// # Errors
/// What a chart refuses.
pub fn html(record: &Record, options: &Options, files: &[File]) -> Result<String, RenderError> {
    let index = record.index();
    let in_atlas = record.atlas.iter().flat_map(|line| [line.laplacian.as_str(), line.property.as_str()]);
    let anchors = Anchors::of(&index, in_atlas, record.claims.iter().map(|c| c.id.as_str()));
    let page = Page { record, index, options, anchors };
    let plots = plots(record)?;
    let main = html! {
        (matrix::section(&page))
        (tables::unexpected(&page))
        (claims::section(&page)?)
        (atlas::section(&page))
        (exhibits::section(&page))
        (evidence::section(&page))
        (plots)
        (tables::domains(&page))
        (provenance::section(&page, files))
        (provenance::sources(&page))
    };
    let title = format!("Discrete Laplacians on trial: {}", record.header.suite);
    Ok(shell(&title, &SECTIONS, header::header(&page), main))
}

fn plots(record: &Record) -> Result<Markup, RenderError> {
    let mut figures = Vec::new();
    for chart in charts(record) {
        figures.push((chart.svg()?, chart));
    }
    Ok(html! {
        section #plots {
            h2 { "Plots" }
            @if figures.is_empty() { p { "The record has no numbers to plot." } }
            @for (svg, chart) in &figures {
                figure.plot id={ "plot-" (chart.id) } {
                    h3 { (chart.title) }
                    div.scroll { (PreEscaped(svg)) }
                    figcaption { (chart.caption) }
                }
            }
        }
    })
}

/// A box that scrolls sideways on its own, so that the page never does.
fn scroll(label: &str, content: Markup) -> Markup {
    html! { div.scroll role="region" aria-label=(label) tabindex="0" { (content) } }
}

/// A command to copy.
fn replay(command: &str) -> Markup {
    html! { pre.replay { code { (command) } } }
}
