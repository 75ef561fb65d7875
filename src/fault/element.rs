//! An element contributes the wrong number. Assembled again from triangles.

use super::site::{Site, Triangle, stiffness};
use super::{Blind, Class, Fault, Spoilt};

/// What sees a wrong weight: the energy first, since some of these make every weight wrong alike.
const WEIGHTS: &[&str] = &["ENERGY", "LIN", "FLUX"];

/// Where not even they do.
const SLIVERS: &[Blind] = &[Blind::AnglesBelow(1.0)];

/// Assembles with another contribution of the corner to the side opposite.
fn each(site: &Site, weight: impl Fn(&Triangle, usize) -> f64) -> Spoilt {
    let triangles = site.triangles()?;
    let weights = triangles.iter().flat_map(|t| [0, 1, 2].map(|c| (t.side(c), weight(t, c))));
    site.assembled(weights, &triangles)
}

/// Assembles with every finished weight mapped.
fn finished(site: &Site, f: impl Fn(f64) -> f64) -> Spoilt {
    let triangles = site.triangles()?;
    let correct = stiffness(site.size(), triangles.iter().flat_map(Triangle::weights));
    let edges = correct.entries().filter(|(i, j, _)| i < j);
    let weights: Vec<_> = edges.map(|(i, j, v)| ([i, j], f(-v))).collect();
    site.with_mistake(&stiffness(site.size(), weights), &correct)
}

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    Class::Element.fault("cosine-for-cotangent", "½ cos θ for ½ cot θ", WEIGHTS, SLIVERS, |s, _| {
        each(s, |t, c| 0.5 * t.angle(c).cos())
    }),
    Class::Element.fault("tangent-for-cotangent", "½ tan θ for ½ cot θ", WEIGHTS, SLIVERS, |s, _| {
        each(s, |t, c| 0.5 * t.angle(c).tan())
    }),
    Class::Element.fault(
        "degrees-for-radians",
        "angles in degrees given to a function of radians",
        WEIGHTS,
        SLIVERS,
        |s, _| each(s, |t, c| 0.5 / t.angle(c).to_degrees().tan()),
    ),
    Class::Element
        .fault("angle-for-cotangent", "½ θ for ½ cot θ", WEIGHTS, SLIVERS, |s, _| each(s, |t, c| 0.5 * t.angle(c))),
    Class::Element.fault("area-for-angle", "half the area for half the cotangent", WEIGHTS, SLIVERS, |s, _| {
        each(s, |t, _| 0.5 * t.area())
    }),
    Class::Element.fault(
        "angle-at-wrong-corner",
        "the cotangent of the next corner for that of the one opposite",
        WEIGHTS,
        SLIVERS,
        |s, _| each(s, |t, c| 0.5 * t.cotangents[(c + 1) % 3]),
    ),
    Class::Element.fault(
        "adjacent-for-opposite",
        "the mean cotangent of the two angles beside an edge for that of the one opposite",
        WEIGHTS,
        SLIVERS,
        |s, _| each(s, |t, c| 0.25 * (t.cotangents[(c + 1) % 3] + t.cotangents[(c + 2) % 3])),
    ),
    Class::Element.fault(
        "one-wrong-corner",
        "in one triangle the cotangents are one corner on",
        WEIGHTS,
        &[Blind::AnglesBelow(1.0), Blind::Curved],
        |s, r| {
            let triangles = s.triangles()?;
            let chosen = r.below(triangles.len());
            let cotangent = |k: usize, t: &Triangle, c: usize| t.cotangents[if k == chosen { (c + 1) % 3 } else { c }];
            let weights = triangles
                .iter()
                .enumerate()
                .flat_map(|(k, t)| [0, 1, 2].map(|c| (t.side(c), 0.5 * cotangent(k, t, c))));
            s.assembled(weights, &triangles)
        },
    ),
    Class::Element.fault(
        "unnormalised-dot",
        "the dot product of the sides for the cotangent: not divided by the cross product",
        WEIGHTS,
        SLIVERS,
        |s, _| each(s, |t, c| t.cotangents[c] * t.area()),
    ),
    Class::Element.fault(
        "area-not-doubled",
        "the dot product over the area, and not over twice the area",
        &["ENERGY", "FLUX"],
        SLIVERS,
        |s, _| each(s, |t, c| t.cotangents[c]),
    ),
    Class::Element.fault(
        "lengths-for-squares",
        "edge lengths for their squares in (b² + c² − a²) / 8A",
        WEIGHTS,
        SLIVERS,
        |s, _| {
            each(s, |t, c| {
                let length = |k: usize| t.squared_length(k % 3).sqrt();
                (length(c + 1) + length(c + 2) - length(c)) / (8.0 * t.area())
            })
        },
    ),
    Class::Element.fault("clamped-cotangent", "negative cotangents set to zero", WEIGHTS, SLIVERS, |s, _| {
        each(s, |t, c| 0.5 * t.cotangents[c].max(0.0))
    }),
    Class::Element.fault(
        "absolute-cotangent",
        "the magnitude of the cotangent, as from an unsigned sine and cosine",
        WEIGHTS,
        SLIVERS,
        |s, _| each(s, |t, c| 0.5 * t.cotangents[c].abs()),
    ),
    Class::Element
        .fault("clamped-weight", "negative weights set to zero", WEIGHTS, SLIVERS, |s, _| finished(s, |w| w.max(0.0))),
    Class::Element.fault(
        "clamped-to-1e-3",
        "weights below 1e-3 set to 1e-3, to make the matrix an M-matrix",
        WEIGHTS,
        SLIVERS,
        |s, _| finished(s, |w| w.max(1e-3)),
    ),
    Class::Element.fault(
        "cotangent-cut-at-10",
        "cotangents cut off at ±10, to be safe from slivers",
        WEIGHTS,
        &[Blind::AnglesBelow(1.0)],
        |s, _| each(s, |t, c| 0.5 * t.cotangents[c].clamp(-10.0, 10.0)),
    ),
    Class::Element.fault(
        "uniform-weights",
        "the weight 1 for every edge: the graph's Laplacian",
        WEIGHTS,
        SLIVERS,
        |s, _| finished(s, |_| 1.0),
    ),
    Class::Element.fault(
        "mean-of-two-on-all",
        "every weight the mean of its two cotangents, also where there is one",
        &["ENERGY", "FLUX"],
        SLIVERS,
        |s, _| {
            let triangles = s.triangles()?;
            let surface = s.surface()?;
            let single = |[i, j]: [usize; 2]| {
                surface.topology().edge_between(i, j).is_some_and(|e| surface.topology().sides(e).len() == 1)
            };
            let weights = triangles.iter().flat_map(Triangle::weights);
            let weights: Vec<_> = weights.map(|(ends, w)| (ends, if single(ends) { 2.0 * w } else { w })).collect();
            s.assembled(weights, &triangles)
        },
    ),
];
