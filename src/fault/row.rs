//! A row, a column or the diagonal is wrong.

use super::site::{Site, closed, pick};
use super::{Blind, Class, Fault, Spoilt};
use crate::stream::Stream;

/// Multiplies a row.
fn row_times(site: &Site, stream: &mut Stream, factor: f64) -> Spoilt {
    let row = site.live_row(stream)?;
    site.mapped(|i, _, v| if i == row { factor * v } else { *v })
}

/// A boundary vertex that is joined to something.
fn boundary(site: &Site, stream: &mut Stream) -> Result<usize, &'static str> {
    let scales = site.stiffness().row_scales();
    let vertices: Vec<usize> =
        site.domain.boundary().iter().enumerate().filter(|(i, b)| **b && scales[*i] > 0.0).map(|(i, _)| i).collect();
    pick(&vertices, stream).ok_or("there is no boundary")
}

/// Adds to every diagonal entry.
fn diagonal(site: &Site, f: impl Fn(f64, f64) -> f64) -> Spoilt {
    let (l, scales) = (site.stiffness(), site.stiffness().row_scales());
    let entries: Vec<_> = (0..site.size()).map(|i| (i, i, f(l.at(i, i), scales[i]))).collect();
    site.with_entries(&entries)
}

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    Class::Row.fault("row-doubled", "a row counted twice", &["SYM"], &[Blind::AnglesBelow(0.01)], |s, r| {
        row_times(s, r, 2.0)
    }),
    Class::Row.fault(
        "row-scaled-1e-9",
        "a row off by the factor 1 + 1e-9",
        &["SYM"],
        &[Blind::AnglesBelow(0.1)],
        |s, r| row_times(s, r, 1.0 + 1e-9),
    ),
    Class::Row.fault("row-zero", "a row that was never filled", &["SYM"], &[Blind::AnglesBelow(0.01)], |s, r| {
        row_times(s, r, 0.0)
    }),
    Class::Row.fault(
        "row-reversed",
        "the weights of a row in reverse order",
        &["SYM"],
        &[Blind::AnglesBelow(0.1)],
        |s, r| {
            let i = s.live_row(r)?;
            let row: Vec<(usize, f64)> = s.stiffness().row(i).filter(|(j, _)| *j != i).map(|(j, v)| (j, *v)).collect();
            let turned: Vec<_> = row.iter().zip(row.iter().rev()).map(|(&(j, _), &(_, v))| (i, j, v)).collect();
            s.with_entries(&turned)
        },
    ),
    Class::Row.fault(
        "upper-triangle-only",
        "only the entries above the diagonal stored, as of a symmetric format",
        &["SYM"],
        &[Blind::AnglesBelow(0.01)],
        |s, _| s.mapped(|i, j, v| if j < i { 0.0 } else { *v }),
    ),
    Class::Row.fault(
        "divided-by-degree",
        "D⁻¹L, the random walk's matrix, for L",
        &["SYM", "ENERGY"],
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, _| {
            let l = s.stiffness();
            s.mapped(|i, _, v| if l.at(i, i) == 0.0 { *v } else { v / l.at(i, i) })
        },
    ),
    Class::Row.fault(
        "divided-by-mass",
        "M⁻¹L, the pointwise operator, for L",
        &["SYM", "ENERGY"],
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, _| {
            let mass = s.mass()?.diagonal();
            s.mapped(|i, _, v| if mass[i] > 0.0 { v / mass[i] } else { *v })
        },
    ),
    Class::Row.fault(
        "skew-part",
        "a skew-symmetric part of 1e-6 of the weights",
        &["SYM"],
        &[Blind::AnglesBelow(0.01)],
        |s, _| {
            s.mapped(|i, j, v| {
                if i < j {
                    v * (1.0 + 1e-6)
                } else if i > j {
                    v * (1.0 - 1e-6)
                } else {
                    *v
                }
            })
        },
    ),
    Class::Row.fault(
        "diagonal-missing",
        "a diagonal entry that was never written",
        &["NULL"],
        &[Blind::AnglesBelow(0.01)],
        |s, r| {
            let i = s.live_row(r)?;
            s.with_entries(&[(i, i, 0.0)])
        },
    ),
    Class::Row.fault(
        "diagonal-stale",
        "a diagonal entry summed before its last weight came",
        &["NULL"],
        &[Blind::AnglesBelow(0.1)],
        |s, r| {
            let [i, j] = s.heavy_edge(r)?;
            s.with_entries(&[(i, i, s.stiffness().at(i, i) + s.stiffness().at(i, j))])
        },
    ),
    Class::Row.fault(
        "diagonal-off-1e-9",
        "a diagonal entry off by 1e-9 of itself",
        &["NULL"],
        &[Blind::AnglesBelow(1.0)],
        |s, r| {
            let i = s.live_row(r)?;
            s.with_entries(&[(i, i, s.stiffness().at(i, i) * (1.0 + 1e-9))])
        },
    ),
    Class::Row.fault(
        "diagonal-negated",
        "the diagonal with the other sign",
        &["NULL"],
        &[Blind::AnglesBelow(0.01)],
        |s, _| diagonal(s, |d, _| -d),
    ),
    Class::Row.fault(
        "diagonal-of-magnitudes",
        "the diagonal Σ|ω_ij| for Σω_ij",
        &["NULL"],
        &[Blind::AnglesBelow(1.0)],
        |s, _| diagonal(s, |d, scale| if scale - d.abs() > (1.0 + 1e-9) * d.abs() { scale - d.abs() } else { d }),
    ),
    Class::Row.fault(
        "diagonal-shifted-1e-8",
        "1e-8 of each row's diagonal added to it, to make the matrix regular",
        &["NULL"],
        &[Blind::AnglesBelow(1.0)],
        |s, _| diagonal(s, |d, _| d * (1.0 + 1e-8)),
    ),
    Class::Row.fault(
        "vertex-pinned",
        "a penalty on the diagonal of one vertex, to make the matrix regular",
        &["NULL"],
        &[Blind::AnglesBelow(0.01)],
        |s, r| {
            let i = s.live_row(r)?;
            s.with_entries(&[(i, i, s.stiffness().at(i, i) + s.stiffness().row_scales()[i])])
        },
    ),
    Class::Row.fault(
        "isolated-vertex-given-1",
        "a 1 on the diagonal of a vertex without neighbours",
        &["NULL"],
        &[],
        |s, r| {
            let scales = s.stiffness().row_scales();
            let alone: Vec<usize> = (0..s.size()).filter(|&i| scales[i] == 0.0).collect();
            let i = pick(&alone, r).ok_or("there is no isolated vertex")?;
            s.with_entries(&[(i, i, 1.0)])
        },
    ),
    Class::Row.fault(
        "boundary-row-eliminated",
        "the row of a boundary vertex replaced by that of the identity, its column kept",
        &["SYM"],
        &[Blind::AnglesBelow(0.01)],
        |s, r| {
            let b = boundary(s, r)?;
            s.mapped(|i, j, v| if i != b { *v } else { f64::from(i == j) })
        },
    ),
    Class::Row.fault(
        "boundary-vertex-eliminated",
        "row and column of a boundary vertex replaced by those of the identity",
        &["NULL"],
        &[Blind::AnglesBelow(0.1)],
        |s, r| {
            let b = boundary(s, r)?;
            s.mapped(|i, j, v| if i != b && j != b { *v } else { f64::from(i == j) })
        },
    ),
    Class::Row.fault(
        "boundary-rows-eliminated",
        "every row of a boundary vertex replaced by that of the identity",
        &["SYM", "NULL"],
        &[Blind::AnglesBelow(0.01)],
        |s, r| {
            boundary(s, r)?;
            let on_boundary = s.domain.boundary();
            s.mapped(|i, j, v| if on_boundary[i] { f64::from(i == j) } else { *v })
        },
    ),
    Class::Row.fault(
        "vertex-cut-off",
        "every weight at one vertex missing, diagonals included",
        &["KER", "LIN", "FLUX", "ENERGY"],
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, r| {
            let c = s.live_row(r)?;
            let rest = s.stiffness().map(|i, j, v| if i == c || j == c { 0.0 } else { *v });
            let closing = closed(&rest);
            let entries: Vec<_> = (0..s.size())
                .filter(|&i| i == c || s.stiffness().at(i, c) != 0.0)
                .flat_map(|i| [(i, c, 0.0), (c, i, 0.0), (i, i, closing.at(i, i))])
                .collect();
            s.with_entries(&entries)
        },
    ),
];
