//! The wrong elements are added up, or the right ones the wrong number of times. Assembled again from triangles.

use std::collections::BTreeMap;

use super::site::{Site, Triangle, pick, stiffness};
use super::{Blind, Class, Fault, Spoilt};
use crate::linalg::Csr;
use crate::stream::Stream;

/// What sees a wrong sum over triangles.
const SUM: &[&str] = &["ENERGY", "LIN", "FLUX"];

/// Assembles with one random triangle counted `times` times.
fn counted(site: &Site, stream: &mut Stream, times: f64) -> Spoilt {
    let triangles = site.triangles()?;
    let chosen = stream.below(triangles.len());
    let factor = |k: usize| if k == chosen { times } else { 1.0 };
    let weights = triangles.iter().enumerate().flat_map(|(k, t)| t.weights().map(|(ends, w)| (ends, factor(k) * w)));
    site.assembled(weights, &triangles)
}

/// The number of triangles at each edge.
fn sides(triangles: &[Triangle]) -> BTreeMap<[usize; 2], usize> {
    let mut sides = BTreeMap::new();
    triangles
        .iter()
        .flat_map(Triangle::weights)
        .for_each(|([i, j], _)| *sides.entry([i.min(j), i.max(j)]).or_insert(0) += 1);
    sides
}

/// An interior edge whose flip is an edge of no triangle: the edge, and the vertices opposite.
fn flippable(
    site: &Site,
    triangles: &[Triangle],
    stream: &mut Stream,
) -> Result<([usize; 2], [usize; 2]), &'static str> {
    let sides = sides(triangles);
    let mut opposite: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for t in triangles {
        for c in 0..3 {
            let [i, j] = t.side(c);
            opposite.entry([i.min(j), i.max(j)]).or_default().push(t.corners[c]);
        }
    }
    let candidates: Vec<([usize; 2], [usize; 2])> = opposite
        .into_iter()
        .filter_map(|(edge, apexes)| <[usize; 2]>::try_from(apexes).ok().map(|[a, b]| (edge, [a.min(b), a.max(b)])))
        .filter(|(_, new)| new[0] != new[1] && !sides.contains_key(new))
        .filter(|&([i, j], [a, b])| {
            let at = site.domain.positions().unwrap_or_default();
            Triangle::of(at, [a, b, i]).is_some() && Triangle::of(at, [a, b, j]).is_some()
        })
        .collect();
    pick(&candidates, stream).ok_or("no edge can be flipped")
}

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    Class::Assembly.fault(
        "triangle-dropped",
        "a triangle left out of the sum",
        SUM,
        &[Blind::AnglesBelow(1.0)],
        |s, r| counted(s, r, 0.0),
    ),
    Class::Assembly.fault("triangle-doubled", "a triangle added twice", SUM, &[Blind::AnglesBelow(1.0)], |s, r| {
        counted(s, r, 2.0)
    }),
    Class::Assembly.fault(
        "triangle-subtracted",
        "a triangle with the other orientation, whose signed area turns its cotangents round",
        SUM,
        &[Blind::AnglesBelow(1.0)],
        |s, r| counted(s, r, -1.0),
    ),
    Class::Assembly.fault(
        "half-edge-twice",
        "a half-edge visited twice: one cotangent counts double",
        SUM,
        &[Blind::AnglesBelow(1.0)],
        |s, r| {
            let triangles = s.triangles()?;
            let mut weights: Vec<_> = triangles.iter().flat_map(Triangle::weights).collect();
            let twice = pick(&weights, r).ok_or("there is no half-edge")?;
            weights.push(twice);
            s.assembled(weights, &triangles)
        },
    ),
    Class::Assembly.fault(
        "half-edge-missed",
        "a half-edge that the loop ends before: one cotangent does not count",
        SUM,
        &[Blind::AnglesBelow(1.0)],
        |s, r| {
            let triangles = s.triangles()?;
            let mut weights: Vec<_> = triangles.iter().flat_map(Triangle::weights).collect();
            weights.remove(r.below(weights.len()));
            s.assembled(weights, &triangles)
        },
    ),
    Class::Assembly.fault(
        "last-triangle-missed",
        "the loop over triangles ends one too early",
        SUM,
        &[Blind::AnglesBelow(1.0)],
        |s, _| {
            let triangles = s.triangles()?;
            s.assembled(triangles[..triangles.len() - 1].iter().flat_map(Triangle::weights), &triangles)
        },
    ),
    Class::Assembly.fault(
        "overwritten",
        "contributions to a place are assigned, not added: the last triangle wins",
        &["NULL"],
        &[Blind::AnglesBelow(1.0)],
        |s, _| {
            let triangles = s.triangles()?;
            let (mut places, n) = (BTreeMap::new(), s.size());
            for ([i, j], w) in triangles.iter().flat_map(Triangle::weights) {
                for (row, column, v) in [(i, j, -w), (j, i, -w), (i, i, w), (j, j, w)] {
                    places.insert((row, column), v);
                }
            }
            let triplets: Vec<_> = places.into_iter().map(|((i, j), v)| (i, j, v)).collect();
            let correct = stiffness(n, triangles.iter().flat_map(Triangle::weights));
            s.with_mistake(&Csr::from_triplets(n, n, &triplets), &correct)
        },
    ),
    Class::Assembly.fault(
        "diagonal-counted-once",
        "the diagonal gets each weight at one end of its edge only",
        &["NULL"],
        &[Blind::AnglesBelow(0.1)],
        |s, _| {
            let triangles = s.triangles()?;
            let correct = stiffness(s.size(), triangles.iter().flat_map(Triangle::weights));
            let mut diagonal = vec![0.0; s.size()];
            triangles.iter().flat_map(Triangle::weights).for_each(|([i, _], w)| diagonal[i] += w);
            s.with_mistake(&correct.map(|i, j, v| if i == j { diagonal[i] } else { *v }), &correct)
        },
    ),
    Class::Assembly.fault(
        "one-side-for-both",
        "inside, the first cotangent taken for both",
        SUM,
        &[Blind::AnglesBelow(1.0)],
        |s, _| {
            let triangles = s.triangles()?;
            let (sides, mut seen) = (sides(&triangles), BTreeMap::new());
            let weights: Vec<_> = triangles
                .iter()
                .flat_map(Triangle::weights)
                .map(|([i, j], w)| {
                    let edge = [i.min(j), i.max(j)];
                    let first: &mut f64 = seen.entry(edge).or_insert(w);
                    ([i, j], if sides[&edge] == 2 { *first } else { w })
                })
                .collect();
            s.assembled(weights, &triangles)
        },
    ),
    Class::Assembly.fault(
        "flipped-in-space",
        "an edge flipped as if it were intrinsic: two chords across the fold for the two triangles",
        &["LOC", "ENERGY"],
        &[Blind::AnglesBelow(1.0)],
        |s, r| {
            let triangles = s.triangles()?;
            let ([i, j], [a, b]) = flippable(s, &triangles, r)?;
            let at = s.domain.positions().ok_or("there are no positions")?;
            let beside = |t: &&Triangle| t.corners.contains(&i) && t.corners.contains(&j);
            let kept = triangles.iter().filter(|t| !beside(t)).copied();
            let chords = [Triangle::of(at, [a, b, i]), Triangle::of(at, [a, b, j])];
            let mistaken: Vec<Triangle> = kept.chain(chords.into_iter().flatten()).collect();
            s.assembled(mistaken.iter().flat_map(Triangle::weights), &triangles)
        },
    ),
];
