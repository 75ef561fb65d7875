//! How far from the threshold holding verdicts are: a strip of shades for each property.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::super::number::{count, superscript};
use super::{BLUE, Chart, Data, FINE, INK, ORANGE, PlotError, grid, ink, px};
use crate::record::Record;
use crate::record::Status;

/// Decades shown below the threshold; smaller margins and zero go into the first bin.
const DECADES: i32 = 8;
/// Bins in a decade.
const FINENESS: i32 = 4;
/// Bins below the threshold, and one beyond it, which no holding verdict should be in.
const BINS: usize = (DECADES * FINENESS) as usize + 1;
const ROW: u32 = 22;
const WIDTH: u32 = 760;

/// The distribution of margins by property.
#[derive(Clone, Debug)]
pub(super) struct Margins {
    rows: Vec<(String, [usize; BINS])>,
}

pub(super) fn chart(record: &Record) -> Option<Chart> {
    let index = record.index();
    let mut rows: Vec<(String, [usize; BINS])> = Vec::new();
    for property in &index.properties {
        let mut bins = [0; BINS];
        let holding = record.cells.iter().filter(|c| c.property == *property && c.verdict.status() == Status::Holds);
        holding.filter_map(|c| c.verdict.margin).filter(|m| *m >= 0.0).for_each(|m| bins[bin(m)] += 1);
        if bins.iter().any(|b| *b > 0) {
            rows.push((property.to_string(), bins));
        }
    }
    let total: usize = rows.iter().flat_map(|r| r.1).sum();
    (total > 0).then(|| Chart {
        id: "margins".into(),
        title: "How far from the threshold holding verdicts are".into(),
        caption: format!(
            "The margin is the residual over its threshold: left of 1 rounding explains it. {} holding verdicts with a \
             margin; the stronger the colour of a cell, the larger its share of the row. The first cell also has every \
             margin below 10{}, zeros included; a cell beyond the line would be a verdict held against its threshold. \
             Decisions made in exact arithmetic or combinatorially have no margin.",
            count(total),
            superscript(-DECADES)
        ),
        width: WIDTH,
        height: ROW * rows.len() as u32 + 56,
        data: Data::Margins(Margins { rows }),
    })
}

fn bin(margin: f64) -> usize {
    let decades = if margin > 0.0 { margin.log10() } else { f64::NEG_INFINITY };
    let at = ((decades + f64::from(DECADES)) * f64::from(FINENESS)).floor();
    at.clamp(0.0, (BINS - 1) as f64) as usize
}

impl Margins {
    pub(super) fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), PlotError> {
        let (left, top, right) = (px(124) as i32, px(14) as i32, px(WIDTH - 24) as i32);
        let step = f64::from(right - left) / f64::from(BINS as u32 + 1);
        let x = |bin: f64| left + (bin * step).round() as i32;
        let y = |row: usize| top + (px(ROW) * row as u32) as i32;
        let bottom = y(self.rows.len());
        for k in 0..=DECADES {
            let at = x(f64::from(k * FINENESS));
            area.draw(&PathElement::new(vec![(at, top), (at, bottom)], grid())).map_err(PlotError::of)?;
            let label = if k == DECADES { "1".into() } else { format!("10{}", superscript(k - DECADES)) };
            area.draw(&Text::new(label, (at, bottom + px(12) as i32), ink(11, HPos::Center))).map_err(PlotError::of)?;
        }
        for (r, (property, bins)) in self.rows.iter().enumerate() {
            let middle = y(r) + px(ROW / 2) as i32;
            area.draw(&Text::new(property.as_str(), (left - px(10) as i32, middle), ink(11, HPos::Right)))
                .map_err(PlotError::of)?;
            let largest = bins.iter().copied().max().unwrap_or(0).max(1);
            for (k, n) in bins.iter().enumerate().filter(|(_, n)| **n > 0) {
                let shade = 0.18 + 0.82 * (*n as f64 / largest as f64).sqrt();
                let corners = [(x(k as f64), y(r) + px(3) as i32), (x((k + 1) as f64), y(r + 1) - px(3) as i32)];
                area.draw(&Rectangle::new(corners, BLUE.mix(shade).filled())).map_err(PlotError::of)?;
            }
        }
        let threshold = x(f64::from(DECADES * FINENESS));
        let line =
            PathElement::new(vec![(threshold, top - px(4) as i32), (threshold, bottom)], ORANGE.stroke_width(2 * FINE));
        area.draw(&line).map_err(PlotError::of)?;
        let axis = PathElement::new(vec![(left, bottom), (right, bottom)], INK.stroke_width(FINE));
        area.draw(&axis).map_err(PlotError::of)?;
        let middle = ((left + threshold) / 2, bottom + px(32) as i32);
        area.draw(&Text::new("margin = residual / threshold", middle, ink(12, HPos::Center))).map_err(PlotError::of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_margin_falls_into_its_decade() {
        assert_eq!((bin(0.0), bin(1e-30), bin(1.1e-8)), (0, 0, 0));
        assert_eq!((bin(0.999), bin(1.0), bin(1e9)), (BINS - 2, BINS - 1, BINS - 1));
        assert_eq!(bin(0.11), BINS - 1 - FINENESS as usize);
    }
}
