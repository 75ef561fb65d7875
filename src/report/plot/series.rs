//! Any chart of a finding: named series over two axes, plain or logarithmic.

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::super::number::{number, superscript};
use super::{COLOURS, Chart, Data, FINE, GRID, INK, PlotError, grid, ink, px};
use crate::figure::{self, Axis, Mark};

const WIDTH: u32 = 820;
const HEIGHT: u32 = 360;
/// The legend's rows that fit beside a chart of that height.
const ROWS: usize = 14;

/// A chart in drawing coordinates: logarithms where an axis is logarithmic.
#[derive(Clone, Debug)]
pub(super) struct Plot {
    axes: [Scale; 2],
    series: Vec<Line>,
}

/// A series in drawing coordinates, with its name and its mark.
type Line = (String, Vec<(f64, f64)>, Mark);

/// An axis in drawing coordinates.
#[derive(Clone, Debug)]
struct Scale {
    label: String,
    logarithmic: bool,
    range: [f64; 2],
}

/// `None` where no point can be drawn.
pub(super) fn chart(id: String, chart: &figure::Chart) -> Option<Chart> {
    let place = |axis: &Axis, x: f64| {
        let placed = if axis.logarithmic { x.log10() } else { x };
        placed.is_finite().then_some(placed)
    };
    let points = |s: &figure::Series| -> Vec<(f64, f64)> {
        s.points.iter().filter_map(|p| Some((place(&chart.x, p[0])?, place(&chart.y, p[1])?))).collect()
    };
    let drawn = chart.series.iter().map(|s| (s.name.clone(), points(s), s.mark));
    let series: Vec<_> = drawn.filter(|(_, points, _)| !points.is_empty()).take(ROWS).collect();
    let all = || series.iter().flat_map(|s| s.1.iter());
    let axes = [Scale::of(&chart.x, all().map(|p| p.0))?, Scale::of(&chart.y, all().map(|p| p.1))?];
    let plot = Plot { axes, series };
    Some(Chart {
        id,
        title: chart.title.clone(),
        caption: String::new(),
        width: WIDTH,
        height: HEIGHT,
        data: Data::Series(plot),
    })
}

impl Scale {
    /// The axis with room around the values; `None` without a value.
    fn of(axis: &Axis, values: impl Iterator<Item = f64>) -> Option<Self> {
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        if low > high {
            return None;
        }
        // A single value still needs a piece of axis around it.
        let room = match 0.06 * (high - low) {
            room if room > f64::EPSILON * high.abs().max(low.abs()) => room,
            _ if axis.logarithmic => 0.5,
            _ => 0.5 * high.abs().max(f64::MIN_POSITIVE),
        };
        let range = [low - room, high + room];
        range.iter().all(|x| x.is_finite()).then(|| Scale {
            label: axis.label.clone(),
            logarithmic: axis.logarithmic,
            range,
        })
    }

    /// What stands at a tick: whole powers of ten where there are enough of them.
    fn tick(&self, at: f64) -> String {
        if !self.logarithmic {
            // Ticks lie at round numbers; three digits of the range take away what rounding added to them.
            let digits = 10f64.powf(2.0 - (self.range[1] - self.range[0]).log10().floor());
            return number((at * digits).round() / digits);
        }
        let power = at.round();
        let whole = (at - power).abs() < 1e-9;
        match self.range[1] - self.range[0] > 2.5 {
            true if whole => format!("10{}", superscript(power as i32)),
            true => String::new(),
            false => {
                let value = 10f64.powf(at);
                let digits = 10f64.powf(1.0 - value.abs().log10().floor());
                number((value * digits).round() / digits)
            }
        }
    }
}

impl Plot {
    pub(super) fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), PlotError> {
        let [x, y] = &self.axes;
        let mut chart = ChartBuilder::on(area)
            .margin(px(10))
            .margin_right(px(266))
            .x_label_area_size(px(56))
            .y_label_area_size(px(84))
            .build_cartesian_2d(x.range[0]..x.range[1], y.range[0]..y.range[1])
            .map_err(PlotError::of)?;
        chart
            .configure_mesh()
            .x_labels(7)
            .y_labels(7)
            .set_all_tick_mark_size(px(5))
            .max_light_lines(0)
            .bold_line_style(grid())
            .axis_style(INK.stroke_width(FINE))
            .label_style(ink(11, HPos::Center).font.color(&INK))
            .x_label_formatter(&|at: &f64| x.tick(*at))
            .y_label_formatter(&|at: &f64| y.tick(*at))
            .x_desc(x.label.as_str())
            .y_desc(y.label.as_str())
            .axis_desc_style(ink(12, HPos::Center).font.color(&INK))
            .draw()
            .map_err(PlotError::of)?;
        let mut colours = COLOURS.iter().cycle();
        for (row, (name, points, mark)) in self.series.iter().enumerate() {
            let reference = *mark == Mark::Reference;
            let colour = if reference { GRID } else { *colours.next().unwrap_or(&INK) };
            let line = colour.stroke_width(2 * FINE);
            let dot = |at: (f64, f64)| Circle::new(at, px(3) as i32, colour.filled());
            match mark {
                Mark::Line | Mark::Both => {
                    chart.draw_series(LineSeries::new(points.iter().copied(), line)).map_err(PlotError::of)?;
                }
                Mark::Reference => {
                    let dashes = DashedLineSeries::new(points.iter().copied(), px(6), px(5), line);
                    chart.draw_series(dashes).map_err(PlotError::of)?;
                }
                Mark::Dots => {}
            }
            if matches!(mark, Mark::Dots | Mark::Both) {
                chart.draw_series(points.iter().map(|p| dot(*p))).map_err(PlotError::of)?;
            }
            let (left, height) = (px(WIDTH - 252) as i32, px(24 + 22 * row as u32) as i32);
            let ends = [(left, height), (left + px(18) as i32, height)];
            match mark {
                Mark::Reference => {
                    let sample = DashedPathElement::new(ends, px(6), px(5), line);
                    area.draw(&sample).map_err(PlotError::of)?;
                }
                Mark::Line | Mark::Both => area.draw(&PathElement::new(ends.to_vec(), line)).map_err(PlotError::of)?,
                Mark::Dots => {}
            }
            if matches!(mark, Mark::Dots | Mark::Both) {
                let middle = (left + px(9) as i32, height);
                area.draw(&Circle::new(middle, px(3) as i32, colour.filled())).map_err(PlotError::of)?;
            }
            area.draw(&Text::new(name.as_str(), (left + px(24) as i32, height), ink(11, HPos::Left)))
                .map_err(PlotError::of)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::Series;

    fn of(points: &[[f64; 2]], logarithmic: bool) -> Option<Chart> {
        let axis = |label: &str| Axis { label: label.into(), logarithmic };
        let series = vec![Series::new("s", Mark::Both, points.iter().copied())];
        chart("c00-1".into(), &figure::Chart { title: "t".into(), x: axis("x"), y: axis("y"), series })
    }

    #[test]
    fn what_a_logarithm_has_no_place_for_is_left_out_and_nothing_left_is_no_chart() {
        assert!(of(&[[0.0, 1.0], [-1.0, 2.0]], true).is_none());
        assert!(of(&[], false).is_none());
        let Some(Chart { data: Data::Series(plot), .. }) = of(&[[0.0, 1.0], [10.0, 100.0]], true) else { panic!() };
        assert_eq!(plot.series[0].1, [(1.0, 2.0)]);
    }

    #[test]
    fn a_single_point_and_equal_values_can_be_drawn() {
        for logarithmic in [false, true] {
            of(&[[3.0, 3.0]], logarithmic).unwrap().svg().unwrap();
            of(&[[1.0, 5.0], [2.0, 5.0]], logarithmic).unwrap().svg().unwrap();
        }
        of(&[[0.0, 0.0]], false).unwrap().svg().unwrap();
    }

    #[test]
    fn ticks_over_many_decades_are_powers_of_ten_and_over_one_they_are_numbers() {
        let scale = |low: f64, high: f64, logarithmic| Scale { label: String::new(), logarithmic, range: [low, high] };
        assert_eq!(scale(-6.0, 0.0, true).tick(-3.0), "10⁻³");
        assert_eq!(scale(-6.0, 0.0, true).tick(-3.5), "");
        assert_eq!(scale(0.0, 1.0, true).tick(0.5), "3.2");
        assert_eq!(scale(0.0, 10.0, false).tick(2.0000000001), "2");
        assert_eq!(scale(-0.4, 8.4, false).tick(6.0), "6");
        assert_eq!(scale(0.1, 1.05, false).tick(0.8), "0.8");
    }
}
