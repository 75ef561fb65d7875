//! One weight is wrong in both directions: the matrix stays symmetric. With the diagonal corrected its rows still sum to zero.

use super::site::{Site, pick};
use super::{Blind, Class, Fault, Spoilt};
use crate::stream::Stream;

/// Multiplies a weight; `balanced`: and takes the difference to the diagonal.
fn weight(site: &Site, [i, j]: [usize; 2], factor: f64, balanced: bool) -> Spoilt {
    let l = site.stiffness();
    let (v, w) = (l.at(i, j), l.at(j, i));
    let mut entries = vec![(i, j, factor * v), (j, i, factor * w)];
    if balanced {
        entries.push((i, i, l.at(i, i) + (v - factor * v)));
        entries.push((j, j, l.at(j, j) + (w - factor * w)));
    }
    site.with_entries(&entries)
}

/// A heavy weight times a factor.
fn scaled(site: &Site, stream: &mut Stream, factor: f64, balanced: bool) -> Spoilt {
    weight(site, site.heavy_edge(stream)?, factor, balanced)
}

/// What sees a weight that is wrong while symmetry and row sums are right.
const BALANCED: &[&str] = &["LIN", "FLUX", "ENERGY"];

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    Class::Entry.fault(
        "sign-of-a-weight",
        "the sign of a weight, the diagonal left as it was",
        &["NULL"],
        &[Blind::AnglesBelow(0.1)],
        |s, r| scaled(s, r, -1.0, false),
    ),
    Class::Entry.fault(
        "sign-of-a-weight-balanced",
        "the sign of a weight, with the diagonal that goes with it",
        BALANCED,
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, r| scaled(s, r, -1.0, true),
    ),
    Class::Entry.fault(
        "weight-off-1e-6",
        "a weight off by 1e-6 of itself, the diagonal as it was",
        &["NULL"],
        &[Blind::AnglesBelow(0.1)],
        |s, r| scaled(s, r, 1.0 + 1e-6, false),
    ),
    Class::Entry.fault(
        "weight-off-1e-9",
        "a weight off by 1e-9 of itself, the diagonal as it was",
        &["NULL"],
        &[Blind::AnglesBelow(3.0)],
        |s, r| scaled(s, r, 1.0 + 1e-9, false),
    ),
    Class::Entry.fault(
        "weight-off-1e-12",
        "a weight off by 1e-12 of itself, the diagonal as it was",
        &["NULL"],
        &[Blind::AnglesBelow(30.0), Blind::Anywhere("in the sum of a long row 1e-12 of one entry is rounding")],
        |s, r| scaled(s, r, 1.0 + 1e-12, false),
    ),
    Class::Entry.fault(
        "weight-off-1e-6-balanced",
        "a weight off by 1e-6 of itself, with the diagonal that goes with it",
        BALANCED,
        &[Blind::AnglesBelow(1.0), Blind::Curved, Blind::Unsound, Blind::Graph],
        |s, r| scaled(s, r, 1.0 + 1e-6, true),
    ),
    Class::Entry.fault(
        "weight-off-1e-9-balanced",
        "a weight off by 1e-9 of itself, with the diagonal that goes with it",
        BALANCED,
        &[Blind::AnglesBelow(3.0), Blind::Curved, Blind::Unsound, Blind::Graph],
        |s, r| scaled(s, r, 1.0 + 1e-9, true),
    ),
    Class::Entry.fault(
        "weight-missing",
        "an edge without its weight, the diagonal as it was",
        &["NULL"],
        &[Blind::AnglesBelow(0.1)],
        |s, r| scaled(s, r, 0.0, false),
    ),
    Class::Entry.fault(
        "weight-missing-balanced",
        "an edge forgotten altogether, diagonal included",
        BALANCED,
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, r| scaled(s, r, 0.0, true),
    ),
    Class::Entry.fault(
        "weight-doubled",
        "an edge counted twice, diagonal included",
        BALANCED,
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, r| scaled(s, r, 2.0, true),
    ),
    Class::Entry.fault(
        "weight-denormal",
        "a weight flushed to the smallest number, the diagonal as it was",
        &["NULL"],
        &[Blind::AnglesBelow(0.1)],
        |s, r| {
            let [i, j] = s.heavy_edge(r)?;
            let tiny = f64::from_bits(1).copysign(s.stiffness().at(i, j));
            s.with_entries(&[(i, j, tiny), (j, i, tiny)])
        },
    ),
    Class::Entry.fault(
        "two-weights-swapped",
        "the weights of two edges at a vertex, exchanged",
        &["NULL"],
        &[Blind::AnglesBelow(1.0)],
        |s, r| {
            let l = s.stiffness();
            let at = |i: usize| s.edges().into_iter().filter(move |e| e.contains(&i));
            let i = s.live_row(r)?;
            let ends: Vec<usize> = at(i).map(|[a, b]| if a == i { b } else { a }).collect();
            let j = pick(&ends, r).ok_or("the vertex has no edge")?;
            let unlike: Vec<usize> =
                ends.into_iter().filter(|&k| (l.at(i, k) - l.at(i, j)).abs() > 0.01 * l.at(i, j).abs()).collect();
            let k = pick(&unlike, r).ok_or("the weights at the vertex are equal")?;
            let (v, w) = (l.at(i, j), l.at(i, k));
            s.with_entries(&[(i, j, w), (j, i, w), (i, k, v), (k, i, v)])
        },
    ),
];
