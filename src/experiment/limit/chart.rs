//! Charts of errors under refinement.

use super::contest::{Quantity, Row};
use super::order::{Level, fitted, judge};
use super::place::{Boundary, Place};
use super::sequence::Way;
use crate::figure::{Axis, Chart, Figure, Mark, Series};

/// The errors of `cotan` with its default mass on one sequence of each place, with fitted lines and the promised slope.
pub fn convergence(rows: &[Row], quantity: Quantity) -> Figure {
    let shown = |r: &&Row| {
        let plain = r.contestant.given.is_empty() && ["cotan", "tet-cotan"].contains(&r.contestant.entry.id);
        let way = if r.sequence.place == Place::Disc { Way::Random } else { Way::Structured };
        plain && r.boundary == r.sequence.place.boundaries()[0] && r.sequence.way == way
    };
    let pairs = rows.iter().filter(shown).filter_map(|row| of_row(row, quantity, row.sequence.name()));
    let title = format!("{} of cotan and, in the cube, of tet-cotan", capital(quantity.name()));
    figure(&title, quantity.promised(), pairs.collect())
}

/// The errors of solutions that do not tend to zero.
pub fn staying(rows: &[Row]) -> Figure {
    let quantity = Quantity::PoissonEnergy;
    // As many as there are colours.
    let shown = ["graph", "weighted-graph:weights=inverse-length", "mean-value", "wachspress"];
    let mine = |row: &&Row| shown.contains(&row.contestant.name().as_str()) && row.boundary == Boundary::Dirichlet;
    let pairs = rows.iter().filter(mine).filter_map(|row| of_row(row, quantity, &row.contestant.name()));
    let title = "Solutions of Poisson's equation up to the best factor, squares with one diagonal";
    figure(title, quantity.promised(), pairs.collect())
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

fn of_row(row: &Row, quantity: Quantity, name: &str) -> Option<[Series; 2]> {
    pair(row.levels[quantity as usize].as_ref()?, name)
}

/// The errors, named with their order, and the fitted line; `None` without an order.
pub fn pair(levels: &[Level], name: &str) -> Option<[Series; 2]> {
    let order = judge(levels).order()?;
    let points = |l: &Level| l.errors.iter().map(|e| [l.h, *e]).collect::<Vec<_>>();
    let dots = Series::new(format!("{name}: {order}"), Mark::Dots, levels.iter().flat_map(points));
    Some([dots, Series::new(format!("fit, {name}"), Mark::Reference, fitted(levels, order.p))])
}

/// The dots first, so that each series has a colour of its own, then the fitted lines and the slope p that is promised.
pub fn figure(title: &str, p: f64, pairs: Vec<[Series; 2]>) -> Figure {
    let (mut series, fits): (Vec<Series>, Vec<Series>) = pairs.into_iter().map(|[dots, fit]| (dots, fit)).unzip();
    let points = || series.iter().flat_map(|s| &s.points);
    let sizes = |pick: fn(f64, f64) -> f64, from: f64| points().map(|p| p[0]).fold(from, pick);
    let (least, most) = (sizes(f64::min, f64::INFINITY), sizes(f64::max, 0.0));
    let top = points().map(|p| p[1]).fold(0.0, f64::max);
    let reference = [least, most].map(|h| [h, top * (h / most).powf(p)]);
    series.extend(fits);
    series.push(Series::new(format!("slope {p}"), Mark::Reference, reference));
    Figure::Chart(Chart {
        title: title.into(),
        x: Axis::logarithmic("mesh size h"),
        y: Axis::logarithmic("relative error"),
        series,
    })
}
