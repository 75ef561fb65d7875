//! The head of the page: what was run, and how it came out, in one line.

use maud::{Markup, html};

use super::super::number::count;
use super::super::text::plural;
use super::Page;

/// The head.
pub(super) fn header(page: &Page) -> Markup {
    let record = page.record;
    let unexpected = record.unexpected();
    html! {
        header {
            p.kicker { "lapjury " (record.header.version) }
            h1 { "Discrete Laplacians on trial" }
            p.summary {
                "suite " b { (record.header.suite) } " · seed " (record.header.seed)
                " · " (plural(record.domains.len(), "domain")) " · " (plural(record.cells.len(), "verdict")) " · "
                @if unexpected == 0 { span.quiet { "0 unexpected" } }
                @else { a.loud href="#unexpected" { (count(unexpected)) " unexpected" } }
            }
            p.digest {
                @match &record.footer {
                    Some(footer) => { "results digest " code { (footer.results_digest) } },
                    None => strong { "The run did not come to its end: this record has no footer." },
                }
            }
            @for notice in &record.notices { p.notice { "Notice: " (notice) } }
        }
    }
}
