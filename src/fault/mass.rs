//! The mass matrix is that of another rule, of another scale, or in another order.

use super::site::{Site, Triangle, lumped};
use super::{Blind, Class, Fault, Spoilt};
use crate::linalg::Csr;
use crate::operator::MassKind;
use crate::stream::Stream;

/// Masses that are positive and add up to the area.
const ANY: &[MassKind] = &[MassKind::Barycentric, MassKind::Mixed, MassKind::Consistent];
/// The diagonal ones of them.
const LUMPED: &[MassKind] = &[MassKind::Barycentric, MassKind::Mixed];

/// What no property sees where triangles are bad.
const SLIVERS: &[Blind] = &[Blind::AnglesBelow(1.0)];

const fn fault(
    id: &'static str,
    what: &'static str,
    masses: &'static [MassKind],
    blind: &'static [Blind],
    change: fn(&Site, &mut Stream) -> Spoilt,
) -> Fault {
    Fault { id, what, class: Class::Mass, masses, caught_by: &["MASS"], blind, change }
}

/// A fault that no property can see: total, row sums and definiteness are as they should be.
const fn hidden(
    id: &'static str,
    what: &'static str,
    masses: &'static [MassKind],
    why: &'static [Blind],
    change: fn(&Site, &mut Stream) -> Spoilt,
) -> Fault {
    Fault { caught_by: &[], ..fault(id, what, masses, why, change) }
}

fn times(site: &Site, factor: f64) -> Spoilt {
    site.with_mass(site.mass()?.matrix().map(|_, _, v| factor * v))
}

/// The mass of a rule for the share of a corner.
fn rule(site: &Site, share: impl Fn(&Triangle, usize) -> f64) -> Spoilt {
    site.with_mass(lumped(site.size(), &site.triangles()?, share))
}

/// The masses of some triangles that are full matrices: `own` and `beside` times the area.
fn full(site: &Site, own: f64, beside: f64) -> Spoilt {
    let mut triplets = Vec::new();
    for t in site.triangles()? {
        let area = t.area();
        for (a, &i) in t.corners.iter().enumerate() {
            triplets
                .extend(t.corners.iter().enumerate().map(|(b, &j)| (i, j, area * if a == b { own } else { beside })));
        }
    }
    site.with_mass(Csr::from_triplets(site.size(), site.size(), &triplets))
}

/// The signed circumcentric part of a corner.
fn circumcentric(t: &Triangle, c: usize) -> f64 {
    let part = |k: usize| t.squared_length(k % 3) * t.cotangents[k % 3];
    0.125 * (part(c + 1) + part(c + 2))
}

/// The corner with an obtuse angle.
fn obtuse(t: &Triangle) -> Option<usize> {
    (0..3).find(|&c| t.cotangents[c] < 0.0)
}

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    fault("mass-without-third", "the whole area at each corner, for a third of it", ANY, SLIVERS, |s, _| times(s, 3.0)),
    fault("mass-doubled", "the parallelogram for the triangle: the ½ of the area forgotten", ANY, SLIVERS, |s, _| {
        times(s, 2.0)
    }),
    fault("mass-halved", "half of the area", ANY, SLIVERS, |s, _| times(s, 0.5)),
    fault("mass-off-1e-9", "every mass off by the factor 1 + 1e-9", ANY, &[Blind::AnglesBelow(5.0)], |s, _| {
        times(s, 1.0 + 1e-9)
    }),
    fault("mass-negated", "the sign that goes with the analyst's Laplacian", ANY, &[], |s, _| times(s, -1.0)),
    fault("mass-inverse", "the inverse of the lumped mass", LUMPED, SLIVERS, |s, _| {
        s.with_mass(s.mass()?.matrix().map(|_, _, v| if *v == 0.0 { 0.0 } else { 1.0 / v }))
    }),
    fault("mass-unit", "the identity", ANY, SLIVERS, |s, _| s.with_mass(Csr::diagonal(&vec![1.0; s.mass()?.size()]))),
    fault(
        "mass-by-valence",
        "the area shared out in equal parts by the number of triangles at a vertex",
        LUMPED,
        &[Blind::AnglesBelow(1.0), Blind::Undeclared],
        |s, _| {
            let triangles = s.triangles()?;
            let (count, area) = (3.0 * triangles.len() as f64, triangles.iter().map(Triangle::area).sum::<f64>());
            rule(s, |_, _| area / count)
        },
    ),
    fault(
        "mass-permuted",
        "the masses in another order than the vertices",
        LUMPED,
        &[Blind::AnglesBelow(1.0), Blind::Undeclared],
        |s, r| {
            let mut mass = s.mass()?.diagonal();
            r.shuffle(&mut mass);
            s.with_mass(Csr::diagonal(&mass))
        },
    ),
    fault(
        "masses-off-by-one",
        "each vertex has the mass of the one before",
        LUMPED,
        &[Blind::AnglesBelow(1.0), Blind::Undeclared],
        |s, _| {
            let mut mass = s.mass()?.diagonal();
            mass.rotate_right(1);
            s.with_mass(Csr::diagonal(&mass))
        },
    ),
    fault(
        "obtuse-rule-forgotten",
        "the circumcentric area also where a triangle is obtuse",
        &[MassKind::Mixed],
        &[Blind::AnglesBelow(1.0), Blind::Undeclared],
        |s, _| rule(s, circumcentric),
    ),
    fault(
        "obtuse-rule-turned-round",
        "a quarter of the area at the obtuse corner and a half beside it",
        &[MassKind::Mixed],
        SLIVERS,
        |s, _| {
            rule(s, |t, c| match obtuse(t) {
                Some(k) => t.area() * if k == c { 0.25 } else { 0.5 },
                None => circumcentric(t, c),
            })
        },
    ),
    fault(
        "obtuse-rule-everywhere",
        "half of the area at the largest angle and a quarter beside it in every triangle",
        &[MassKind::Mixed],
        &[Blind::AnglesBelow(1.0), Blind::Undeclared],
        |s, _| {
            rule(s, |t, c| {
                let largest = (1..3).fold(0, |k, a| if t.squared_length(a) > t.squared_length(k) { a } else { k });
                t.area() * if c == largest { 0.5 } else { 0.25 }
            })
        },
    ),
    fault(
        "clamped-circumcentric",
        "negative circumcentric parts set to zero",
        &[MassKind::Mixed],
        &[Blind::AnglesBelow(1.0), Blind::Undeclared],
        |s, _| rule(s, |t, c| circumcentric(t, c).max(0.0)),
    ),
    fault(
        "thirds-for-mixed",
        "a third of the area, labelled mixed",
        &[MassKind::Mixed],
        &[Blind::AnglesBelow(1.0), Blind::Undeclared],
        |s, _| rule(s, |t, _| t.area() / 3.0),
    ),
    hidden(
        "lumped-for-consistent",
        "the row sums of the consistent mass, labelled consistent",
        &[MassKind::Consistent],
        &[Blind::Anywhere(
            "row sums, total and definiteness are those of the consistent mass; only the entries are not",
        )],
        |s, _| rule(s, |t, _| t.area() / 3.0),
    ),
    hidden(
        "consistent-for-lumped",
        "the consistent mass, labelled barycentric",
        &[MassKind::Barycentric],
        &[Blind::Anywhere("row sums, total and definiteness are those of the lumped mass; only the entries are not")],
        |s, _| full(s, 1.0 / 6.0, 1.0 / 12.0),
    ),
    fault(
        "consistent-with-ninths",
        "a ninth of the area in all nine places, for a sixth and twelfths",
        &[MassKind::Consistent],
        &[Blind::Anywhere(
            "row sums and total are those of the consistent mass, and on many meshes the matrix is definite",
        )],
        |s, _| full(s, 1.0 / 9.0, 1.0 / 9.0),
    ),
    fault(
        "consistent-coefficients-exchanged",
        "a twelfth on the diagonal and sixths beside it",
        &[MassKind::Consistent],
        SLIVERS,
        |s, _| full(s, 1.0 / 12.0, 1.0 / 6.0),
    ),
    fault(
        "mass-boundary-doubled",
        "the masses of boundary vertices doubled, as if the mesh went on",
        LUMPED,
        SLIVERS,
        |s, _| {
            let on_boundary = s.domain.boundary();
            s.with_mass(s.mass()?.matrix().map(|i, _, v| if on_boundary[i] { 2.0 * v } else { *v }))
        },
    ),
    fault("mass-projected", "the areas of the mesh seen from above", &[MassKind::Barycentric], SLIVERS, |s, _| {
        let flat: Vec<[f64; 3]> = s.surface()?.positions().iter().map(|p| [p[0], p[1], 0.0]).collect();
        s.with_mass(lumped(s.size(), &s.triangles_at(&flat)?, |t, _| t.area() / 3.0))
    }),
];
