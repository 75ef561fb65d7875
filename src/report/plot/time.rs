//! Where the time went: a bar for each part of the run.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::super::number::seconds;
use super::{BLUE, Chart, Data, PlotError, ink, px};
use crate::record::Record;

const WIDTH: u32 = 760;
const ROW: u32 = 24;
/// The most bars; the rest is summed up.
const BARS: usize = 16;

/// Seconds by part, the largest first.
#[derive(Clone, Debug)]
pub(super) struct Time {
    parts: Vec<(String, f64)>,
}

pub(super) fn chart(record: &Record) -> Option<Chart> {
    let timing = record.timing.as_ref()?;
    let mut parts: Vec<(String, f64)> = timing.parts.iter().map(|(p, s)| (p.clone(), *s)).collect();
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    if parts.len() > BARS {
        let rest: f64 = parts.drain(BARS - 1..).map(|p| p.1).sum();
        parts.push(("all other parts".into(), rest));
    }
    parts.retain(|p| p.1 > 0.0);
    (!parts.is_empty()).then(|| Chart {
        id: "time".into(),
        title: "Where the time went".into(),
        caption: format!(
            "Seconds summed over {} thread{}; the whole run took {}. Timings are not part of the results digest.",
            timing.threads,
            if timing.threads == 1 { "" } else { "s" },
            seconds(timing.seconds)
        ),
        width: WIDTH,
        height: ROW * parts.len() as u32 + 16,
        data: Data::Time(Time { parts }),
    })
}

impl Time {
    pub(super) fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), PlotError> {
        let (left, right) = (px(170) as i32, px(WIDTH - 80) as i32);
        let largest = self.parts.iter().map(|p| p.1).fold(f64::MIN_POSITIVE, f64::max);
        for (k, (part, time)) in self.parts.iter().enumerate() {
            let top = px(8 + ROW * k as u32) as i32;
            let middle = top + px(ROW / 2) as i32;
            let end = left + (f64::from(right - left) * time / largest).round().max(1.0) as i32;
            let bar = Rectangle::new([(left, top + px(4) as i32), (end, top + px(ROW - 4) as i32)], BLUE.filled());
            area.draw(&bar).map_err(PlotError::of)?;
            area.draw(&Text::new(part.as_str(), (left - px(10) as i32, middle), ink(12, HPos::Right)))
                .map_err(PlotError::of)?;
            area.draw(&Text::new(seconds(*time), (end + px(8) as i32, middle), ink(12, HPos::Left)))
                .map_err(PlotError::of)?;
        }
        Ok(())
    }
}
