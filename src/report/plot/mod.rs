//! Charts, drawn with plotters: the same bytes on every machine, readable on light and on dark ground.
//!
//! plotters places everything on whole pixels, so a chart is drawn at four times its size and shown smaller. Its ink is
//! a colour of its own that becomes `currentColor` in the SVG.

mod energy;
mod margins;
mod negative_weights;
mod series;
mod time;

use std::sync::Once;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};

use super::png::{Image, encode};
use crate::record::Record;

/// Why a chart could not be drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the chart could not be drawn: {0}")]
pub struct PlotError(String);

impl PlotError {
    pub(super) fn of(error: impl std::fmt::Display) -> Self {
        PlotError(error.to_string())
    }
}

/// A chart of a record.
#[derive(Clone, Debug)]
pub struct Chart {
    /// A name for files and anchors.
    pub id: String,
    /// What it shows, in a few words.
    pub title: String,
    /// How to read it.
    pub caption: String,
    width: u32,
    height: u32,
    data: Data,
}

/// What a chart shows.
#[derive(Clone, Debug)]
enum Data {
    Energy(energy::Energy),
    Margins(margins::Margins),
    NegativeWeights(negative_weights::NegativeWeights),
    Series(series::Plot),
    Time(time::Time),
}

/// Every chart that the record has data for, apart from those of its claims.
pub fn charts(record: &Record) -> Vec<Chart> {
    [margins::chart(record), negative_weights::chart(record), energy::chart(record), time::chart(record)]
        .into_iter()
        .flatten()
        .collect()
}

/// The chart of a finding; `None` where nothing of it can be drawn.
pub fn of_finding(id: String, chart: &crate::figure::Chart) -> Option<Chart> {
    series::chart(id, chart)
}

/// How much larger than shown a chart is drawn.
const FINE: u32 = 4;

/// The ink: text and axes.
const INK: RGBColor = RGBColor(1, 2, 3);
/// Lines behind the data.
const GRID: RGBColor = RGBColor(128, 136, 148);
/// A first colour for data.
const BLUE: RGBColor = RGBColor(70, 138, 210);
/// A second colour for data, told apart from the first by everyone.
const ORANGE: RGBColor = RGBColor(217, 104, 20);

impl Chart {
    /// The chart as an SVG element.
    ///
    /// # Errors
    /// What plotters refuses.
    pub fn svg(&self) -> Result<String, PlotError> {
        fonts();
        let mut text = String::new();
        {
            let area = SVGBackend::with_string(&mut text, (self.width * FINE, self.height * FINE)).into_drawing_area();
            self.draw_on(area)?;
        }
        let start = text.find('>').map_or(0, |at| at + 1);
        let body = text[start..].replace("#010203", "currentColor").replace('\n', "");
        let (w, h) = (self.width, self.height);
        let head = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\" role=\"img\" width=\"{w}\" height=\"{h}\" \
             viewBox=\"0 0 {} {}\"><title>{}</title>",
            w * FINE,
            h * FINE,
            super::svg::escape(&self.title)
        );
        Ok(head + &body)
    }

    /// The chart as a PNG file on white, at four times its size.
    ///
    /// # Errors
    /// What plotters refuses.
    pub fn png(&self) -> Result<Vec<u8>, PlotError> {
        fonts();
        let (width, height) = (self.width * FINE, self.height * FINE);
        let mut image = Image { width, height, pixels: vec![255; 3 * width as usize * height as usize] };
        {
            let area = BitMapBackend::with_buffer(&mut image.pixels, (width, height)).into_drawing_area();
            self.draw_on(area)?;
        }
        Ok(encode(&image))
    }

    fn draw_on<B: DrawingBackend>(&self, area: DrawingArea<B, Shift>) -> Result<(), PlotError> {
        match &self.data {
            Data::Energy(data) => data.draw(&area)?,
            Data::Margins(data) => data.draw(&area)?,
            Data::NegativeWeights(data) => data.draw(&area)?,
            Data::Series(data) => data.draw(&area)?,
            Data::Time(data) => data.draw(&area)?,
        }
        area.present().map_err(PlotError::of)
    }
}

/// A length in the units of a chart.
const fn px(length: u32) -> u32 {
    length * FINE
}

/// A text style in ink. plotters measures fonts by their line, a fifth larger than their em.
fn ink(size: u32, horizontal: HPos) -> TextStyle<'static> {
    ("sans-serif", 1.2 * f64::from(px(size))).into_font().color(&INK).pos(Pos::new(horizontal, VPos::Center))
}

/// The colours of lines that are told apart, by everyone.
const COLOURS: [RGBColor; 6] =
    [BLUE, ORANGE, RGBColor(0, 158, 115), RGBColor(190, 96, 160), RGBColor(160, 120, 20), RGBColor(86, 160, 190)];

/// Thin lines behind the data.
fn grid() -> ShapeStyle {
    GRID.mix(0.3).stroke_width(FINE)
}

/// Registers the embedded fonts, once: no font of the machine is ever asked for.
pub(super) fn fonts() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // The only refusal is of bytes that are no font, and these are; a chart without fonts would say so itself.
        let _ = register_font("sans-serif", FontStyle::Normal, dejavu::sans::regular());
        let _ = register_font("sans-serif", FontStyle::Bold, dejavu::sans::bold());
    });
}
