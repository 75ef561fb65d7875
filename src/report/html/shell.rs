//! What every page has around its sections: head, navigation, style and script.

use maud::{DOCTYPE, Markup, PreEscaped, html};

/// Nothing is ever loaded: not even a script of this page could.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";

/// A page. `sections` are anchors with their titles, as the navigation lists them, the first being what a reader skips to.
pub(super) fn shell(title: &str, sections: &[(&str, &str)], header: Markup, main: Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                link rel="icon" href="data:,";
                title { (title) }
                style { (PreEscaped(include_str!("page.css"))) }
            }
            body {
                @for (id, title) in sections.iter().take(1) { a.skip href={ "#" (id) } { "Skip to the " (title.to_lowercase()) } }
                (header)
                nav aria-label="Sections" {
                    @for (id, title) in sections { a href={ "#" (id) } { (title) } " " }
                }
                main { (main) }
                script { (PreEscaped(include_str!("page.js"))) }
            }
        }
    };
    page.into_string()
}
