//! One entry is wrong, in one direction or off the stencil.

use super::site::{Site, pick};
use super::{Blind, Class, Fault, Spoilt};
use crate::stream::Stream;

/// The smallest positive number of `f64`.
const DENORMAL: f64 = f64::from_bits(1);

/// Multiplies one direction of a weight.
fn one_way(site: &Site, stream: &mut Stream, factor: f64) -> Spoilt {
    let [i, j] = site.heavy_edge(stream)?;
    site.with_entries(&[(i, j, factor * site.stiffness().at(i, j))])
}

/// Puts something into both directions between two vertices that are not joined.
fn far(site: &Site, stream: &mut Stream, near: bool, value: impl Fn(f64) -> f64) -> Spoilt {
    let [i, j] = site.strangers(near, stream)?;
    let scales = site.stiffness().row_scales();
    let v = value(scales[i].max(scales[j]));
    site.with_entries(&[(i, j, v), (j, i, v)])
}

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    Class::Entry.fault(
        "sign-one-way",
        "the sign of L_ij, and not of L_ji",
        &["SYM"],
        &[Blind::AnglesBelow(0.01)],
        |s, r| one_way(s, r, -1.0),
    ),
    Class::Entry.fault(
        "entry-off-1e-6",
        "L_ij off by 1e-6 of itself, and L_ji not",
        &["SYM"],
        &[Blind::AnglesBelow(0.01)],
        |s, r| one_way(s, r, 1.0 + 1e-6),
    ),
    Class::Entry.fault(
        "entry-off-1e-9",
        "L_ij off by 1e-9 of itself, and L_ji not",
        &["SYM"],
        &[Blind::AnglesBelow(0.1)],
        |s, r| one_way(s, r, 1.0 + 1e-9),
    ),
    Class::Entry.fault(
        "entry-off-1e-12",
        "L_ij off by 1e-12 of itself, and L_ji not",
        &["SYM"],
        &[Blind::AnglesBelow(1.0)],
        |s, r| one_way(s, r, 1.0 + 1e-12),
    ),
    Class::Entry.fault(
        "one-sided-update",
        "a weight grown by a tenth in row i and left in row j",
        &["SYM"],
        &[Blind::AnglesBelow(0.01)],
        |s, r| {
            let [i, j] = s.heavy_edge(r)?;
            let v = s.stiffness().at(i, j);
            s.with_entries(&[(i, j, 1.1 * v), (i, i, s.stiffness().at(i, i) - 0.1 * v)])
        },
    ),
    Class::Entry.fault(
        "entry-missing-one-way",
        "L_ij is not stored, and L_ji is",
        &["SYM"],
        &[Blind::AnglesBelow(0.01)],
        |s, r| one_way(s, r, 0.0),
    ),
    Class::Entry.fault(
        "entry-huge",
        "L_ij is 1e200 times its row, as an uninitialised number may be",
        &["SYM"],
        &[],
        |s, r| {
            let [i, j] = s.heavy_edge(r)?;
            s.with_entries(&[(i, j, 1e200 * s.stiffness().row_scales()[i])])
        },
    ),
    Class::Entry.fault("entry-nan", "one entry is not a number", &["FIN"], &[], |s, r| {
        let [i, j] = s.heavy_edge(r)?;
        s.with_entries(&[(i, j, f64::NAN)])
    }),
    Class::Entry.fault("entry-infinite", "one entry is infinite", &["FIN"], &[], |s, r| {
        let [i, j] = s.heavy_edge(r)?;
        s.with_entries(&[(i, j, f64::INFINITY)])
    }),
    Class::Entry.fault(
        "diagonal-nan",
        "one diagonal entry is not a number, as 0/0 of a vertex without neighbours",
        &["FIN"],
        &[],
        |s, r| {
            let rows: Vec<usize> = (0..s.size()).collect();
            let i = pick(&rows, r).ok_or("there is no vertex")?;
            s.with_entries(&[(i, i, f64::NAN)])
        },
    ),
    Class::Entry.fault(
        "far-entry",
        "an entry as large as a row between two vertices that are not joined",
        &["LOC"],
        &[],
        |s, r| far(s, r, false, |scale| -scale),
    ),
    Class::Entry.fault(
        "two-ring-entry-1e-12",
        "an entry of 1e-12 of its row between vertices two rings apart",
        &["LOC"],
        &[],
        |s, r| far(s, r, true, |scale| -1e-12 * scale),
    ),
    Class::Entry.fault(
        "far-denormal",
        "a denormal number between two vertices that are not joined",
        &["LOC"],
        &[],
        |s, r| far(s, r, false, |_| -DENORMAL),
    ),
    Class::Entry.fault("stored-zero", "a stored zero off the stencil: no entry, and no fault", &[], &[], |s, r| {
        far(s, r, true, |_| 0.0)
    }),
    Class::Entry.fault(
        "weight-in-wrong-column",
        "L_ij is written to column k two rings away",
        &["LOC"],
        &[],
        |s, r| {
            let [i, k] = s.strangers(true, r)?;
            let row: Vec<usize> = s.stiffness().row(i).map(|(j, _)| j).filter(|&j| j != i).collect();
            let j = pick(&row, r).ok_or("the row is empty")?;
            s.with_entries(&[(i, j, 0.0), (i, k, s.stiffness().at(i, j))])
        },
    ),
];
