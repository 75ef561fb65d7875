//! The figures of findings, drawn: charts by the plotter, sketches as exhibits are.

use super::highlight::Highlight;
use super::picture::picture;
use super::{plot, svg};
use crate::figure::{Figure, Sketch};
use crate::record::{ClaimLine, Exhibit, Record};

/// A picture as SVG and what it shows.
pub struct Drawn {
    /// The SVG element.
    pub svg: String,
    /// What it shows.
    pub caption: String,
}

/// The figures of a claim, drawn.
///
/// # Errors
/// What the plotter refuses.
pub(super) fn drawn(claim: &ClaimLine) -> Result<Vec<Drawn>, plot::PlotError> {
    let mut all = Vec::new();
    for (id, figure) in numbered(claim) {
        match figure {
            Figure::Chart(chart) => {
                let chart = plot::of_finding(id, chart);
                all.extend(chart.map(|c| Ok(Drawn { svg: c.svg()?, caption: c.title })).transpose()?);
            }
            Figure::Sketch(sketch) => all.extend(sketched(sketch)),
        }
    }
    Ok(all)
}

/// The charts of all claims of a record, to be files of their own.
pub(super) fn charts(record: &Record) -> impl Iterator<Item = plot::Chart> {
    record.claims.iter().flat_map(numbered).filter_map(|(id, figure)| match figure {
        Figure::Chart(chart) => plot::of_finding(id, chart),
        Figure::Sketch(_) => None,
    })
}

/// Each figure with a name: that of the claim and its number there.
fn numbered(claim: &ClaimLine) -> impl Iterator<Item = (String, &Figure)> {
    let figures = claim.tests.iter().flat_map(|t| &t.figures);
    figures.enumerate().map(|(k, figure)| (format!("{}-{}", claim.id, k + 1), figure))
}

fn sketched(sketch: &Sketch) -> Option<Drawn> {
    let exhibit = Exhibit {
        laplacian: String::new(),
        property: String::new(),
        recipe: sketch.title.clone(),
        positions: sketch.points.clone(),
        faces: sketch.faces.clone(),
        edges: sketch.edges.clone(),
    };
    let highlight = Highlight {
        bad: sketch.marked.clone(),
        values: sketch.values.iter().copied().enumerate().collect(),
        ..Highlight::default()
    };
    let svg = svg::svg(&picture(&exhibit, &highlight)?.drawing, &sketch.title);
    Some(Drawn { svg, caption: sketch.title.clone() })
}
