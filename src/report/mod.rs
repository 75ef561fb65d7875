//! Reports: what a [`Record`] says, one format a file. A report reads the record and nothing else; rendering one again runs
//! no mathematics.
//!
//! [`render`] gives every file of a report directory; [`text::text`] what a terminal shows. A picture or a chart as PNG comes
//! from [`exhibit_png`] and [`plot::Chart::png`].

pub mod alarms;
mod atlas;
pub mod csv;
mod download;
mod drawing;
mod figure;
mod forms;
mod highlight;
mod html;
mod junit;
mod markdown;
pub mod number;
mod picture;
pub mod planted;
pub mod plot;
pub mod png;
mod reciprocal;
mod sentence;
mod svg;
pub mod taxonomy;
pub mod text;
mod view;

use std::collections::BTreeMap;

pub use atlas::smallest;
pub use figure::Drawn;
pub use html::html;
pub use junit::junit;
pub use markdown::markdown;
pub use reciprocal::figures;
pub use sentence::{sentence, statement};

use crate::record::{Cell, Exhibit, Record};

/// What a report says beyond its record.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The BibTeX of every source.
    pub bibliography: String,
    /// The licences of the meshes.
    pub licences: String,
    /// Short names of properties and operators, by id: `SYM` → `symmetric`.
    pub names: BTreeMap<String, String>,
}

impl Options {
    /// The short name of a property or an operator; an operator's parameters are looked past.
    pub fn name(&self, label: &str) -> Option<&str> {
        let id = label.split(':').next().unwrap_or(label);
        self.names.get(label).or_else(|| self.names.get(id)).map(String::as_str)
    }
}

/// A file of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Its path relative to the report's directory, with forward slashes.
    pub path: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// Why a report could not be rendered.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// A table.
    #[error("a table of the report could not be written: {0}")]
    Table(#[from] ::csv::Error),
    /// A chart.
    #[error(transparent)]
    Chart(#[from] plot::PlotError),
    /// JSON.
    #[error("the JSON of the report could not be written: {0}")]
    Json(#[from] serde_json::Error),
}

/// Every file of a report: the page, the tables, the charts, the summaries.
///
/// # Errors
/// What a writer of tables or charts refuses; nothing that a record from the reader brings about.
pub fn render(record: &Record, options: &Options) -> Result<Vec<File>, RenderError> {
    let mut files = tables(record)?;
    for chart in plot::charts(record).into_iter().chain(figure::charts(record)) {
        files.push(File { path: format!("charts/{}.svg", chart.id), bytes: chart.svg()?.into_bytes() });
    }
    files.push(File { path: "summary.md".into(), bytes: markdown(record).into_bytes() });
    files.push(File { path: "junit.xml".into(), bytes: junit(record).into_bytes() });
    files.push(File { path: "index.html".into(), bytes: html(record, options, &files)?.into_bytes() });
    Ok(files)
}

/// The tables, as CSV and the taxonomy as JSON too.
fn tables(record: &Record) -> Result<Vec<File>, RenderError> {
    let index = record.index();
    let file = |path: &str, bytes| File { path: path.into(), bytes };
    Ok(vec![
        file("atlas.csv", csv::atlas(record)?),
        file("taxonomy.csv", csv::taxonomy(&index)?),
        file("taxonomy.json", serde_json::to_vec(&taxonomy::as_json(&index))?),
        file("claims.csv", csv::claims(record)?),
        file("tests.csv", csv::tests(record)?),
        file("domains.csv", csv::domains(record)?),
        file("cells.csv", csv::cells(record)?),
    ])
}

/// The picture of an exhibit as SVG; `None` where there is nothing to draw.
pub fn exhibit_svg(exhibit: &Exhibit, cell: Option<&Cell>) -> Option<String> {
    let title = format!("{} and {} on {}", exhibit.laplacian, exhibit.property, exhibit.recipe);
    draw(exhibit, cell).map(|p| svg::svg(&p.drawing, &title))
}

/// The picture of an exhibit as a PNG file on white, `scale` times 400 pixels wide; `None` where there is nothing to draw.
///
/// # Errors
/// What the painter refuses.
pub fn exhibit_png(exhibit: &Exhibit, cell: Option<&Cell>, scale: u32) -> Result<Option<Vec<u8>>, plot::PlotError> {
    draw(exhibit, cell).map(|p| png::drawing(&p.drawing, scale)).transpose()
}

fn draw(exhibit: &Exhibit, cell: Option<&Cell>) -> Option<picture::Picture> {
    let highlight = cell.and_then(|c| c.verdict.evidence()).map(highlight::Highlight::of).unwrap_or_default();
    picture::picture(exhibit, &highlight)
}
