//! The share of negative weights against the share of edges that are not Delaunay, a mark a mesh.

use std::collections::BTreeSet;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::super::number::count;
use super::{Chart, Data, FINE, GRID, INK, PlotError, grid, ink, px};
use crate::record::{Index, Record};

const WIDTH: u32 = 760;
const HEIGHT: u32 = 400;
/// Operators that get a colour of their own.
const SERIES: usize = 5;
/// Marks closer than this part of the range are drawn once.
const RESOLUTION: f64 = 150.0;

/// Colours that everyone can tell apart on light and on dark ground (after Okabe and Ito).
const COLOURS: [RGBColor; SERIES] = [
    RGBColor(217, 104, 20),
    RGBColor(70, 138, 210),
    RGBColor(0, 158, 115),
    RGBColor(190, 96, 160),
    RGBColor(160, 140, 30),
];

/// Shares of edges and weights, by operator.
#[derive(Clone, Debug)]
pub(super) struct NegativeWeights {
    series: Vec<(String, Vec<(f64, f64)>)>,
    largest: f64,
}

pub(super) fn chart(record: &Record) -> Option<Chart> {
    let index = record.index();
    let mut series: Vec<(String, Vec<(f64, f64)>)> =
        index.laplacians.iter().map(|l| (l.to_string(), shares(&index, l))).filter(|s| !s.1.is_empty()).collect();
    let meshes = series.iter().map(|s| s.1.len()).max()?;
    let negative = |points: &[(f64, f64)]| points.iter().map(|p| p.1).sum::<f64>();
    series.sort_by(|a, b| negative(&b.1).total_cmp(&negative(&a.1)));
    let never: Vec<String> = series.iter().filter(|s| negative(&s.1) == 0.0).map(|s| s.0.clone()).collect();
    series.truncate(SERIES);
    series.retain(|s| negative(&s.1) > 0.0);
    let all = || series.iter().flat_map(|s| s.1.iter().copied());
    let largest = all().map(|(x, y)| x.max(y)).fold(0.0, f64::max);
    if largest == 0.0 {
        return None;
    }
    let silent = if never.is_empty() {
        String::new()
    } else {
        format!(" No negative weight on any mesh: {}.", never.join(", "))
    };
    let caption = format!(
        "Share of interior edges with ω < 0 against the share of interior edges that are not Delaunay (decided by exact \
         predicates), a mark for each of up to {} triangle meshes; marks that coincide are drawn once. On the grey diagonal \
         the two shares are equal.{silent}",
        count(meshes)
    );
    let series = series.into_iter().map(|(l, points)| (l, thinned(&points, largest / RESOLUTION))).collect();
    Some(Chart {
        id: "negative-weights".into(),
        title: "Negative weights and edges that are not Delaunay".into(),
        caption,
        width: WIDTH,
        height: HEIGHT,
        data: Data::NegativeWeights(NegativeWeights { series, largest }),
    })
}

fn shares(index: &Index, laplacian: &str) -> Vec<(f64, f64)> {
    let share = |c: &&crate::record::Cell| {
        let tally = c.verdict.tally.as_ref().filter(|t| t.total > 0)?;
        let facts = &index.domain(&c.recipe)?.facts;
        let surface = facts.surface.as_ref()?;
        let interior = facts.edges.checked_sub(surface.boundary_edges).filter(|n| *n > 0)?;
        let not_delaunay = surface.non_delaunay_edges? as f64 / interior as f64;
        Some((not_delaunay, tally.violations as f64 / tally.total as f64))
    };
    index.cells(laplacian, "POS").iter().filter_map(share).collect()
}

fn thinned(points: &[(f64, f64)], step: f64) -> Vec<(f64, f64)> {
    let mut seen = BTreeSet::new();
    let place = |p: &(f64, f64)| ((p.0 / step).round() as i64, (p.1 / step).round() as i64);
    points.iter().filter(|p| seen.insert(place(p))).copied().collect()
}

impl NegativeWeights {
    pub(super) fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), PlotError> {
        let top = 1.06 * self.largest;
        let percent =
            |x: &f64| if self.largest < 0.05 { format!("{:.1} %", 100.0 * x) } else { format!("{:.0} %", 100.0 * x) };
        let mut chart = ChartBuilder::on(area)
            .margin(px(10))
            .margin_right(px(190))
            .x_label_area_size(px(56))
            .y_label_area_size(px(76))
            .build_cartesian_2d(0.0..top, 0.0..top)
            .map_err(PlotError::of)?;
        chart
            .configure_mesh()
            .x_labels(6)
            .y_labels(6)
            .set_all_tick_mark_size(px(5))
            .max_light_lines(0)
            .bold_line_style(grid())
            .axis_style(INK.stroke_width(FINE))
            .label_style(ink(11, HPos::Center).font.color(&INK))
            .x_label_formatter(&percent)
            .y_label_formatter(&percent)
            .x_desc("interior edges that are not Delaunay")
            .y_desc("interior edges with ω < 0")
            .axis_desc_style(ink(12, HPos::Center).font.color(&INK))
            .draw()
            .map_err(PlotError::of)?;
        let diagonal = LineSeries::new([(0.0, 0.0), (top, top)], GRID.stroke_width(FINE));
        chart.draw_series(diagonal).map_err(PlotError::of)?;
        for (k, (laplacian, points)) in self.series.iter().enumerate() {
            let colour = COLOURS[k % SERIES];
            for p in points {
                let (x, y) = chart.plotting_area().map_coordinate(p);
                mark(area, k, (x, y), colour)?;
            }
            let row = px(26 + 22 * k as u32) as i32;
            mark(area, k, (px(WIDTH - 172) as i32, row), colour)?;
            area.draw(&Text::new(laplacian.as_str(), (px(WIDTH - 160) as i32, row), ink(12, HPos::Left)))
                .map_err(PlotError::of)?;
        }
        Ok(())
    }
}

/// A mark told apart by shape as well as by colour.
fn mark<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    k: usize,
    (x, y): (i32, i32),
    colour: RGBColor,
) -> Result<(), PlotError> {
    let r = px(4) as i32;
    let line = colour.stroke_width(FINE + FINE / 2);
    match k % SERIES {
        0 => area.draw(&Circle::new((x, y), r, line)),
        1 => area.draw(&Polygon::new(vec![(x - r, y + r), (x + r, y + r), (x, y - r)], colour.filled())),
        2 => area.draw(&Cross::new((x, y), r - 2, line)),
        3 => area.draw(&Rectangle::new([(x - r + 2, y - r + 2), (x + r - 2, y + r - 2)], line)),
        _ => area.draw(&PathElement::new(vec![(x, y - r), (x + r, y), (x, y + r), (x - r, y), (x, y - r)], line)),
    }
    .map_err(PlotError::of)
}
