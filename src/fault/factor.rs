//! The whole, or a component of it, is off by a factor.

use super::site::{Site, pick};
use super::{Blind, Class, Fault};
use crate::linalg::Csr;
use crate::operator::Operator;
use crate::stream::Stream;

type Spoilt = Result<Operator, &'static str>;

const fn fault(
    id: &'static str,
    what: &'static str,
    caught_by: &'static [&'static str],
    blind: &'static [Blind],
    change: fn(&Site, &mut Stream) -> Spoilt,
) -> Fault {
    Fault { id, what, class: Class::Factor, masses: &[], caught_by, blind, change }
}

fn times(site: &Site, factor: f64) -> Spoilt {
    site.mapped(|_, _, v| factor * v)
}

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    fault(
        "factor-half",
        "every weight ¼ (cot α + cot β): the ½ taken twice",
        &["ENERGY"],
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, _| times(s, 0.5),
    ),
    fault(
        "factor-two",
        "every weight cot α + cot β: the ½ forgotten",
        &["ENERGY"],
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, _| times(s, 2.0),
    ),
    fault(
        "factor-one-and-1e-9",
        "every entry off by the factor 1 + 1e-9",
        &["ENERGY"],
        &[Blind::AnglesBelow(5.0), Blind::Graph],
        |s, _| times(s, 1.0 + 1e-9),
    ),
    fault("sign-reversed", "the analyst's sign: −L for L", &["PSD"], &[Blind::AnglesBelow(0.01)], |s, _| {
        times(s, -1.0)
    }),
    fault(
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
    fault(
        "zero-matrix",
        "nothing was ever assembled",
        &["KER", "ENERGY"],
        &[Blind::AnglesBelow(1.0), Blind::Graph],
        |s, _| times(s, 0.0),
    ),
    fault("identity", "the identity, as of a solver that was given no matrix", &["NULL"], &[], |s, _| {
        s.with_stiffness(Csr::diagonal(&vec![1.0; s.size()]))
    }),
];
