//! Dirichlet energy against flips to Delaunay: a falling line for each certificate of Rippa's theorem in the record.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::super::number::{count, number};
use super::{COLOURS, Chart, Data, FINE, GRID, INK, PlotError, grid, ink, px};
use crate::record::{Record, Statement};

const WIDTH: u32 = 760;
const HEIGHT: u32 = 360;
/// Certificates beyond as many are left out.
const MOST: usize = 4;

/// The logarithm of energy over energy on the Delaunay triangulation, after each flip.
#[derive(Clone, Debug)]
pub(super) struct Energy {
    lines: Vec<(String, Vec<f64>)>,
}

pub(super) fn chart(record: &Record) -> Option<Chart> {
    let tests = record.claims.iter().flat_map(|c| c.tests.iter().map(move |t| (&c.id, t)));
    let lines: Vec<(String, Vec<f64>)> = tests
        .flat_map(|(id, test)| test.evidence.iter().map(move |e| (id, e)))
        .filter_map(|(id, evidence)| match &evidence.statement {
            Statement::FlipsToDelaunay { energies, .. } => {
                let points = evidence.excerpt.positions.len();
                Some((format!("{id}: {} points, {} flips", count(points), energies.len() - 1), line(energies)?))
            }
            _ => None,
        })
        .take(MOST)
        .collect();
    (!lines.is_empty()).then(|| Chart {
        id: "energy".into(),
        title: "Dirichlet energy on the way to Delaunay".into(),
        caption: "The Dirichlet energy ½ uᵀLu of a function of random values after each flip, over that on the Delaunay \
                  triangulation, for the certificates of Rippa's theorem in this record; a step for each flip, the scale is \
                  logarithmic. Every flip takes ½ κ (w·u)² ≥ 0 away, so no line ever rises."
            .into(),
        width: WIDTH,
        height: HEIGHT,
        data: Data::Energy(Energy { lines }),
    })
}

/// Decimal logarithms relative to the last energy; `None` without a flip or where the last energy is not positive.
fn line(energies: &[f64]) -> Option<Vec<f64>> {
    let last = energies.last().copied().filter(|e| *e > 0.0 && energies.len() > 1)?;
    let logarithms: Vec<f64> = energies.iter().map(|e| (e / last).log10()).collect();
    logarithms.iter().all(|x| x.is_finite()).then_some(logarithms)
}

impl Energy {
    pub(super) fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), PlotError> {
        let flips = self.lines.iter().map(|l| l.1.len() - 1).max().unwrap_or(1).max(1) as f64;
        let top = self.lines.iter().flat_map(|l| l.1.iter().copied()).fold(0.01, f64::max);
        let mut chart = ChartBuilder::on(area)
            .margin(px(10))
            .margin_right(px(210))
            .x_label_area_size(px(56))
            .y_label_area_size(px(76))
            .build_cartesian_2d(0.0..1.02 * flips, 0.0..1.06 * top)
            .map_err(PlotError::of)?;
        chart
            .configure_mesh()
            .x_labels(8)
            .y_labels(6)
            .set_all_tick_mark_size(px(5))
            .max_light_lines(0)
            .bold_line_style(grid())
            .axis_style(INK.stroke_width(FINE))
            .label_style(ink(11, HPos::Center).font.color(&INK))
            .x_label_formatter(&|x: &f64| if x.fract() == 0.0 { format!("{x:.0}") } else { String::new() })
            .y_label_formatter(&|y: &f64| format!("× {}", number((100.0 * 10f64.powf(*y)).round() / 100.0)))
            .x_desc("flips")
            .y_desc("energy over that on Delaunay")
            .axis_desc_style(ink(12, HPos::Center).font.color(&INK))
            .draw()
            .map_err(PlotError::of)?;
        let floor = LineSeries::new([(0.0, 0.0), (flips, 0.0)], GRID.stroke_width(FINE));
        chart.draw_series(floor).map_err(PlotError::of)?;
        for (k, ((label, line), colour)) in self.lines.iter().zip(COLOURS).enumerate() {
            let steps = line.windows(2).enumerate().flat_map(|(x, w)| {
                let x = x as f64;
                [(x, w[0]), (x + 1.0, w[0]), (x + 1.0, w[1])]
            });
            let style = colour.stroke_width(2 * FINE);
            chart.draw_series(LineSeries::new(steps, style)).map_err(PlotError::of)?;
            let row = px(26 + 22 * k as u32) as i32;
            let left = px(WIDTH - 196) as i32;
            let sample = PathElement::new(vec![(left, row), (left + px(14) as i32, row)], style);
            area.draw(&sample).map_err(PlotError::of)?;
            area.draw(&Text::new(label.as_str(), (left + px(20) as i32, row), ink(11, HPos::Left)))
                .map_err(PlotError::of)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energies_are_measured_against_the_last_one_and_a_constant_function_has_no_line() {
        assert_eq!(line(&[100.0, 10.0, 1.0]), Some(vec![2.0, 1.0, 0.0]));
        assert_eq!(line(&[0.0, 0.0]), None);
        assert_eq!(line(&[3.0]), None);
    }
}
