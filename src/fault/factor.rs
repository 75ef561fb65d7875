//! The whole, or a component of it, is off by a factor.

use super::site::{Site, pick};
use super::{Blind, Class, Fault, Spoilt};
use crate::linalg::Csr;

fn times(site: &Site, factor: f64) -> Spoilt {
    site.mapped(|_, _, v| factor * v)
}

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    Class::Factor.fault(
        "factor-half",
        "every weight ¼ (cot α + cot β): the ½ taken twice",
        &["ENERGY"],
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, _| times(s, 0.5),
    ),
    Class::Factor.fault(
        "factor-two",
        "every weight cot α + cot β: the ½ forgotten",
        &["ENERGY"],
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, _| times(s, 2.0),
    ),
    Class::Factor.fault(
        "factor-one-and-1e-9",
        "every entry off by the factor 1 + 1e-9",
        &["ENERGY"],
        &[Blind::AnglesBelow(5.0), Blind::Graph],
        |s, _| times(s, 1.0 + 1e-9),
    ),
    Class::Factor.fault(
        "sign-reversed",
        "the analyst's sign: −L for L",
        &["PSD"],
        &[Blind::AnglesBelow(0.01)],
        |s, _| times(s, -1.0),
    ),
    Class::Factor.fault(
        "component-doubled",
        "one component counted twice",
        &["ENERGY"],
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, r| {
            let of = s.domain.components();
            let mut live: Vec<usize> = s.edges().iter().map(|e| of[e[0]]).collect();
            live.sort_unstable();
            live.dedup();
            if live.len() < 2 {
                return Err("there is one component");
            }
            let c = pick(&live, r).ok_or("there is no component")?;
            s.mapped(|i, _, v| if of[i] == c { 2.0 * v } else { *v })
        },
    ),
    Class::Factor.fault(
        "zero-matrix",
        "nothing was ever assembled",
        &["KER", "ENERGY"],
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, _| times(s, 0.0),
    ),
    Class::Factor.fault("identity", "the identity, as of a solver that was given no matrix", &["NULL"], &[], |s, _| {
        s.with_stiffness(Csr::diagonal(&vec![1.0; s.size()]))
    }),
];
