//! One mass is wrong, or all lose digits.

use super::site::{Site, Triangle, lumped, pick, replaced};
use super::{Blind, Class, Fault, Spoilt};
use crate::operator::MassKind;
use crate::stream::Stream;

/// Masses that are positive and add up to the area.
const ANY: &[MassKind] = &[MassKind::Barycentric, MassKind::Mixed, MassKind::Consistent];
/// The diagonal ones of them.
const LUMPED: &[MassKind] = &[MassKind::Barycentric, MassKind::Mixed];

const fn fault(
    id: &'static str,
    what: &'static str,
    masses: &'static [MassKind],
    caught_by: &'static [&'static str],
    blind: &'static [Blind],
    change: fn(&Site, &mut Stream) -> Spoilt,
) -> Fault {
    Fault { id, what, class: Class::Mass, masses, caught_by, blind, change }
}

/// Replaces one diagonal entry by a function of it.
fn one(site: &Site, stream: &mut Stream, f: impl Fn(f64) -> f64) -> Spoilt {
    let (i, mass) = (site.heavy_vertex(stream)?, site.mass()?.matrix());
    site.with_mass(replaced(mass, &[(i, i, f(mass.at(i, i)))]))
}

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    fault("mass-nan", "one mass is not a number", ANY, &["FIN"], &[], |s, r| one(s, r, |_| f64::NAN)),
    fault("mass-infinite", "one mass is infinite", ANY, &["FIN"], &[], |s, r| one(s, r, |_| f64::INFINITY)),
    fault("mass-zero-at-a-vertex", "one vertex with triangles and without mass", ANY, &["MASS"], &[], |s, r| {
        one(s, r, |_| 0.0)
    }),
    fault(
        "mass-negative-at-a-vertex",
        "one mass with the other sign",
        ANY,
        &["MASS"],
        &[Blind::AnglesBelow(0.01)],
        |s, r| one(s, r, |m| -m),
    ),
    fault("mass-off-at-a-vertex", "one mass a tenth too large", ANY, &["MASS"], &[Blind::AnglesBelow(1.0)], |s, r| {
        one(s, r, |m| 1.1 * m)
    }),
    fault(
        "mass-off-1e-9-at-a-vertex",
        "one mass off by 1e-9 of itself",
        ANY,
        &["MASS"],
        &[Blind::AnglesBelow(3.0), Blind::Undeclared],
        |s, r| one(s, r, |m| m * (1.0 + 1e-9)),
    ),
    fault(
        "mass-moved",
        "a tenth of one mass moved to another vertex",
        LUMPED,
        &["MASS"],
        &[Blind::AnglesBelow(1.0), Blind::Undeclared],
        |s, r| {
            let (i, mass) = (s.heavy_vertex(r)?, s.mass()?.matrix());
            let others: Vec<usize> = (0..mass.rows()).filter(|&j| j != i && mass.at(j, j) > 0.0).collect();
            let j = pick(&others, r).ok_or("there is one vertex with mass")?;
            let part = 0.1 * mass.at(i, i);
            s.with_mass(replaced(mass, &[(i, i, mass.at(i, i) - part), (j, j, mass.at(j, j) + part)]))
        },
    ),
    fault(
        "two-masses-swapped",
        "the masses of two vertices exchanged",
        LUMPED,
        &["MASS"],
        &[Blind::AnglesBelow(1.0), Blind::Undeclared],
        |s, r| {
            let ([i, j], mass) = (s.unequal_masses(r)?, s.mass()?.matrix());
            s.with_mass(replaced(mass, &[(i, i, mass.at(j, j)), (j, j, mass.at(i, i))]))
        },
    ),
    fault(
        "mass-triangle-missed",
        "a triangle left out of the masses",
        &[MassKind::Barycentric],
        &["MASS"],
        &[Blind::AnglesBelow(1.0)],
        |s, r| {
            let mut triangles = s.triangles()?;
            triangles.remove(r.below(triangles.len()));
            s.with_mass(lumped(s.size(), &triangles, |t: &Triangle, _| t.area() / 3.0))
        },
    ),
    fault(
        "mass-one-way",
        "an entry of the consistent mass off by 1e-6 of itself in one direction",
        &[MassKind::Consistent],
        &["MASS"],
        &[Blind::AnglesBelow(0.1)],
        |s, r| {
            let mass = s.mass()?.matrix();
            let places: Vec<(usize, usize)> =
                mass.entries().filter(|(i, j, v)| i != j && **v > 0.0).map(|(i, j, _)| (i, j)).collect();
            let (i, j) = pick(&places, r).ok_or("the mass is diagonal")?;
            s.with_mass(replaced(mass, &[(i, j, mass.at(i, j) * (1.0 + 1e-6))]))
        },
    ),
    fault(
        "mass-in-f32",
        "masses rounded to single precision",
        ANY,
        &["MASS"],
        &[Blind::AnglesBelow(3.0), Blind::Undeclared],
        |s, _| s.with_mass(s.mass()?.matrix().map(|_, _, v| f64::from(*v as f32))),
    ),
    fault(
        "isolated-vertex-given-mass",
        "a mass at a vertex without triangles",
        LUMPED,
        &["MASS"],
        &[Blind::AnglesBelow(1.0)],
        |s, r| {
            let mass = s.mass()?.matrix();
            let bare: Vec<usize> = (0..mass.rows()).filter(|&i| mass.at(i, i) == 0.0).collect();
            let i = pick(&bare, r).ok_or("every vertex has triangles")?;
            let mean = (0..mass.rows()).map(|k| mass.at(k, k)).sum::<f64>() / mass.rows() as f64;
            s.with_mass(replaced(mass, &[(i, i, mean)]))
        },
    ),
];
