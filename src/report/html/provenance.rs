//! Where the record comes from, what can be taken away, and whose work it stands on.

use maud::{Markup, html};

use super::super::number::{count, seconds};
use super::super::{File, download};
use super::Page;

/// The largest table that is put into the page; larger ones are linked beside it.
const LARGEST_DOWNLOAD: usize = 80_000;

/// The section.
pub(super) fn section(page: &Page, files: &[File]) -> Markup {
    let header = &page.record.header;
    html! {
        section #provenance {
            h2 { "Provenance" }
            dl {
                dt { "Program" } dd { "lapjury " (header.version) ", record schema " (header.schema) }
                dt { "Suite and seed" } dd { (header.suite) ", " (header.seed) }
                @if let Some(footer) = &page.record.footer {
                    dt { "Results digest" } dd { code { (footer.results_digest) } }
                    dt { "Verdicts" }
                    dd { @for (k, (status, n)) in footer.cells.iter().enumerate() { @if k > 0 { ", " } (status) " " (count(*n)) } }
                }
                @if let Some(t) = &page.record.timing {
                    dt { "Time" } dd { (seconds(t.seconds)) " with " (t.threads) @if t.threads == 1 { " thread" } @else { " threads" } }
                }
                @for (key, value) in &header.environment { dt { (key) } dd { (value) } }
            }
            h3 { "Downloads" }
            ul.downloads { @for file in files.iter().filter(|f| mime(&f.path).is_some()) { li { (link(file)) } } }
        }
    }
}

fn mime(path: &str) -> Option<&'static str> {
    match path.rsplit('.').next() {
        Some("csv") => Some("text/csv"),
        Some("json") => Some("application/json"),
        _ => None,
    }
}

fn link(file: &File) -> Markup {
    let kilobytes = file.bytes.len().div_ceil(1000);
    let address = download::address(mime(&file.path).unwrap_or("text/plain"), &file.bytes);
    html! {
        @if address.len() <= LARGEST_DOWNLOAD { a download=(file.path) href=(address) { (file.path) } " (" (count(kilobytes)) " kB)" }
        @else { a href=(file.path) { (file.path) } " (" (count(kilobytes)) " kB, beside this page)" }
    }
}

/// Sources and licences.
pub(super) fn sources(page: &Page) -> Markup {
    html! {
        section #sources {
            h2 { "Sources" }
            @if page.options.bibliography.is_empty() { p { "No bibliography was given." } }
            @else { details { summary { "BibTeX of every source" } pre.text { (page.options.bibliography) } } }
            @if !page.options.licences.is_empty() {
                details { summary { "Licences of the meshes" } pre.text { (page.options.licences) } }
            }
        }
    }
}
