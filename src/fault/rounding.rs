//! Numbers lose digits.

use super::site::closed;
use super::{Blind, Class, Fault};

/// A number with some digits after the first.
fn printed(x: f64, digits: usize) -> f64 {
    format!("{x:.digits$e}").parse().unwrap_or(x)
}

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    Class::Rounding.fault(
        "entries-in-f32",
        "every entry rounded to single precision",
        &["NULL", "LIN", "FLUX", "ENERGY"],
        &[Blind::AnglesBelow(3.0), Blind::Curved, Blind::Graph],
        |s, _| s.mapped(|_, _, v| f64::from(*v as f32)),
    ),
    Class::Rounding.fault(
        "weights-in-f32",
        "weights rounded to single precision, the diagonal summed from them in double",
        &["LIN", "FLUX", "ENERGY"],
        &[Blind::AnglesBelow(3.0), Blind::Graph],
        |s, _| s.with_stiffness(closed(&s.stiffness().map(|_, _, v| f64::from(*v as f32)))),
    ),
    Class::Rounding.fault(
        "entries-to-6-digits",
        "entries printed with six digits",
        &["NULL", "LIN", "FLUX", "ENERGY"],
        &[Blind::AnglesBelow(1.0), Blind::Curved, Blind::Graph],
        |s, _| s.mapped(|_, _, v| printed(*v, 5)),
    ),
    Class::Rounding.fault(
        "entries-to-8-decimals",
        "entries printed with eight places after the point",
        &["NULL", "LIN", "FLUX", "ENERGY"],
        &[Blind::AnglesBelow(3.0), Blind::Curved, Blind::Graph],
        |s, _| s.mapped(|_, _, v| if v.abs() < 1e6 { format!("{v:.8}").parse().unwrap_or(*v) } else { *v }),
    ),
    Class::Rounding.fault(
        "small-weights-dropped",
        "weights below a hundredth of their row taken for zero",
        &["NULL"],
        &[Blind::AnglesBelow(1.0)],
        |s, _| {
            let scales = s.stiffness().row_scales();
            s.mapped(|i, j, v| if i != j && v.abs() < 0.01 * scales[i].min(scales[j]) { 0.0 } else { *v })
        },
    ),
    Class::Rounding.fault(
        "weights-in-integers",
        "weights truncated to whole numbers",
        &["NULL", "LIN", "FLUX", "ENERGY"],
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, _| s.mapped(|_, _, v| v.trunc()),
    ),
];
