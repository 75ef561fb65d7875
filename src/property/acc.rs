//! ACC: the weights are the cotangent weights of the mesh, as far as rounding allows.
//!
//! # Definition
//! `|−L_ij − ω_ij|` for both directions of every edge, with the exact `ω_ij = ½ Σ cot θ` over the angles θ opposite
//! ([`domain::cotangent`](crate::domain::cotangent), known to far more digits than `L_ij` has). The thresholds are those of one
//! cotangent weight in [`tolerance`](super::tolerance), in the unit of the exact weights:
//! ```text
//! explained = 4u (|L_ij| + Σ 1/sin²θ),      defect = 4 Q explained,      Q = 1/sin θ_min of the triangles beside the edge
//! ```
//! The notes say how the errors are distributed, in units in the last place of the exact weight, by the smallest angle of the triangles
//! beside the edge, and which weight is the worst.
//! # Limitations
//! It says nothing of other constructions, right or wrong: it applies where every entry is a cotangent weight up to a
//! millionth of `½ Σ |cot θ|` (or up to its defect threshold, where that is more), and no entry lies off the edges. A weight that
//! is further off, or a matrix times a factor, is for LIN, ENERGY and FLUX to see. Edges beside a degenerate triangle are left out.

use super::evidence::{Evidence, Statement};
use super::excerpt;
use super::measure::condition::{Flanks, Triangles};
use super::measure::scan::Scan;
use super::tolerance::{Judgement, LARGEST_EXPLAINED, Threshold, UNIT_ROUNDOFF};
use super::verdict::Level;
use super::{Property, Question, Trial, Verdict};
use crate::domain::cotangent::{self, Twofold};
use crate::domain::{Domain, Surface, geometry};

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "ACC",
    name: "accuracy of cotangent weights",
    statement: "ω_ij = ½ (cot α_ij + cot β_ij) on every edge, α and β opposite it",
    sources: &["pinkall-polthier1993"],
    question: Question::Operator(check),
};

/// An edge with its weight, exact and as given in the direction that is further off.
#[derive(Clone, Copy)]
struct Weighed {
    /// Row and column of the entry.
    place: [usize; 2],
    /// `−L_ij`.
    given: f64,
    exact: Twofold,
    /// `|given − exact|`.
    error: f64,
    threshold: Threshold,
    /// `½ Σ |cot θ|`.
    size: f64,
    /// `1/sin θ_min` of the triangles beside the edge.
    condition: f64,
}

impl Weighed {
    /// The error in units in the last place of the exact weight; `None` where that is zero.
    fn ulps(&self) -> Option<f64> {
        (self.exact.high != 0.0).then(|| self.error / ulp(self.exact.high))
    }

    /// Whether the entry is an attempt at this weight at all.
    fn is_meant(&self) -> bool {
        self.error <= LARGEST_EXPLAINED * self.size || self.threshold.judge(self.error) != Judgement::Defect
    }
}

/// The distance from a number to the next larger one of its binade.
fn ulp(x: f64) -> f64 {
    let x = x.abs();
    x.next_up() - x
}

fn check(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let Domain::Surface(surface) = trial.domain else {
        return Verdict::not_applicable(format!("ACC is about triangle surfaces, not a {}", trial.domain.kind()));
    };
    let Some(triangles) = &trial.scales().geometry().triangles else {
        return Verdict::not_applicable("a face is no triangle: a polygon has no cotangent weights");
    };
    if (0..trial.operator.size()).any(|i| trial.scales().leaves_stencil(i)) {
        return Verdict::not_applicable(
            "the operator has entries off the edges of the mesh, where cotangent weights are not",
        );
    }
    let (weights, left_out) = weigh(trial, surface, triangles);
    let strange: Vec<&Weighed> = weights.iter().filter(|w| !w.is_meant()).collect();
    if let Some(worst) = strange.iter().max_by(|a, b| (a.error / a.size).total_cmp(&(b.error / b.size))) {
        return Verdict::not_applicable(format!(
            "{} of {} weights are no cotangent weights, not even roughly: {:e} at {:?}, where ½ (cot α + cot β) = {:e}",
            strange.len(),
            weights.len(),
            worst.given,
            worst.place,
            worst.exact.high
        ));
    }
    if weights.is_empty() {
        return Verdict::not_applicable("no edge has proper triangles beside it");
    }
    let mut scan = Scan::new();
    weights.iter().for_each(|w| scan.look(*w, w.error, w.threshold));
    let verdict = scan.verdict(
        Level::Measured,
        |w| w.place.to_vec(),
        |found| {
            let (w, [i, j]) = (found.place, found.place.place);
            let statement =
                Statement::Inaccurate { i, j, exact: w.exact.high, error: w.error, threshold: found.threshold.defect };
            let edge = surface.topology().edge_between(i, j);
            let faces: Vec<usize> =
                edge.map_or_else(Vec::new, |e| surface.topology().sides(e).iter().map(|s| s.face()).collect());
            Evidence::new(statement, excerpt::of_rows(trial, [i]).with_faces(trial, &faces).with_corners(trial))
        },
    );
    let verdict = distribution(&weights).into_iter().fold(verdict, Verdict::with_note);
    match left_out {
        0 => verdict,
        n => verdict.with_note(format!("{n} edges were left out: beside a degenerate triangle")),
    }
}

/// The edges that have proper triangles beside them and no other, and the number of those left out.
fn weigh(trial: &Trial, surface: &Surface, triangles: &Triangles) -> (Vec<Weighed>, usize) {
    let (topology, matrix) = (surface.topology(), trial.operator.stiffness());
    let proper: Vec<bool> = (0..surface.faces().len())
        .map(|f| surface.triangle(f).is_some_and(|t| is_proper(t.map(|v| surface.positions()[v]))))
        .collect();
    let (mut weights, mut left_out) = (Vec::with_capacity(topology.edges().len()), 0);
    for (edge, &[i, j]) in topology.edges().iter().enumerate() {
        if topology.sides(edge).iter().any(|side| !proper[side.face()]) {
            left_out += 1;
            continue;
        }
        let [p, q] = [i, j].map(|v| surface.point(v));
        let corners = surface.opposite(edge).into_iter().map(|(_, apex)| [surface.point(apex), p, q]);
        let size = 0.5 * corners.clone().map(|[a, p, q]| geometry::cotangent(a, p, q).abs()).sum::<f64>();
        let exact = cotangent::precise_half_sum(corners);
        let weighed = |i: usize, j: usize| {
            let given = -matrix.at(i, j);
            let Flanks { condition, opposite } = triangles.flanks[edge];
            let explained = 4.0 * UNIT_ROUNDOFF * (given.abs() + opposite);
            let threshold = Threshold {
                explained: explained.min(LARGEST_EXPLAINED * trial.scales().rows[i]),
                defect: 4.0 * condition * explained,
            };
            let error = ((given - exact.high) - exact.low).abs();
            Weighed { place: [i, j], given, exact, error, threshold, size, condition }
        };
        let (forth, back) = (weighed(i, j), weighed(j, i));
        weights.push(if back.error > forth.error { back } else { forth });
    }
    (weights, left_out)
}

fn is_proper([a, b, c]: [[f64; 3]; 3]) -> bool {
    !geometry::collinear(a, b, c)
}

/// Classes of the smallest angle beside an edge, in degrees, each from here up to the one before.
const CLASSES: [(f64, &str); 4] =
    [(10.0, "10° or more"), (1.0, "1° to 10°"), (0.01, "0.01° to 1°"), (0.0, "below 0.01°")];

/// A number of units in the last place.
fn count(ulps: f64) -> String {
    if ulps < 1e5 { format!("{ulps:.1}") } else { format!("{ulps:.1e}") }
}

/// The errors in units in the last place by the quality of the triangles, and the worst of all.
fn distribution(weights: &[Weighed]) -> Vec<String> {
    let mut notes = Vec::new();
    let mut classes: [Vec<f64>; CLASSES.len()] = Default::default();
    for w in weights {
        // A little below, so that the rounding of Q moves no angle of exactly ten degrees.
        let angle = (1.0 / w.condition).asin().to_degrees() * (1.0 + 1e-12);
        let class = CLASSES.iter().position(|&(from, _)| angle >= from).unwrap_or(CLASSES.len() - 1);
        classes[class].extend(w.ulps());
    }
    for ((_, name), ulps) in CLASSES.iter().zip(&mut classes).filter(|(_, ulps)| !ulps.is_empty()) {
        ulps.sort_unstable_by(f64::total_cmp);
        let at = |share: f64| ulps[((ulps.len() as f64 * share).ceil() as usize).clamp(1, ulps.len()) - 1];
        let last = ulps.len();
        notes.push(format!(
            "smallest angle {name}: {last} weights, median {} ulp, 99 % within {}, all within {}",
            count(at(0.5)),
            count(at(0.99)),
            count(at(1.0))
        ));
    }
    let zeros = weights.iter().filter(|w| w.exact.high == 0.0);
    if zeros.clone().next().is_some() {
        let stored = zeros.clone().filter(|w| w.given != 0.0).count();
        notes
            .push(format!("{} weights are exactly zero, {stored} of them are stored as something else", zeros.count()));
    }
    let worst = weights.iter().filter_map(|w| Some((w, w.ulps()?))).max_by(|a, b| a.1.total_cmp(&b.1));
    if let Some((w, ulps)) = worst.filter(|(_, ulps)| *ulps > 0.0) {
        notes.push(format!(
            "furthest off is {:e} at {:?}, by {} ulp of {:e}",
            w.given,
            w.place,
            count(ulps),
            w.exact.high
        ));
    }
    notes
}
