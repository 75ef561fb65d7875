//! The weights `ω_ij = −L_ij` on edges, and their signs: what POS, POS0 and POS-boundary share.
//!
//! # Which pairs have a weight
//! * Every edge of the domain: interior edges (two faces or more; all edges of a graph) apart from boundary edges (one face; the
//!   edges of boundary triangles of a volume). Where nothing is stored the weight is zero.
//! * Every other pair with a non-zero entry counts as an interior pair: an operator that is not local has weights there.
//! * If the operator has entries off its stencil, an edge of the domain at which nothing is stored is *not* a weight: the
//!   operator has edges of its own (the intrinsic Delaunay triangulation flipped that one away).
//!
//! An edge is counted once though it is two entries; it is as bad as the worse of them. A pair that is not an edge has a
//! weight only in the direction that is not zero.
//!
//! # Signs
//! A zero is not a small number: an entry that is zero, or absent, is an exact zero and counted as one. A construction that
//! vouches for its signs ([`Signs::Exact`](crate::operator::Signs::Exact)) is taken at its word, graphs are read literally; everywhere else a non-zero
//! entry within its threshold ([`Scales::sign`](super::tolerance::Scales::sign)) has no clear sign.

use super::tolerance::{Sign, Threshold};
use crate::domain::{Domain, geometry};
use crate::property::evidence::{Corner, Evidence, Statement};
use crate::property::verdict::{Level, Tally};
use crate::property::{Trial, Verdict, excerpt};

/// One direction of an edge: the entry `(i, j)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weight {
    /// Row.
    pub i: usize,
    /// Column.
    pub j: usize,
    /// `ω_ij = −L_ij`.
    pub value: f64,
    /// How far from zero it must be for its sign to be clear; nothing where signs are literal.
    pub threshold: Threshold,
}

/// An edge with its weights: one in each direction, or one where only one is defined.
pub(crate) struct Edge {
    /// The number of the edge in the domain, if it is one.
    pub number: Option<usize>,
    /// Its weights, that of the smaller row first.
    pub weights: Vec<Weight>,
}

/// All weights of an operator.
pub(crate) struct Weights {
    /// On interior edges and on pairs that are no edges.
    pub interior: Vec<Edge>,
    /// On boundary edges.
    pub boundary: Vec<Edge>,
    /// How many of the interior ones are on pairs that are no edges.
    pub off_edges: usize,
    /// Edges that carry no weight because the operator has edges of its own.
    pub unweighted: usize,
    /// Whether signs are read literally.
    pub literal: bool,
}

impl Weights {
    /// Of the operator on trial. Cost: O(nnz log).
    pub fn of(trial: &Trial) -> Self {
        let (matrix, edges) = (trial.operator.stiffness(), trial.domain.edges());
        let literal = trial.has_literal_signs();
        let weight = |i: usize, j: usize, edge: Option<usize>| {
            let value = -matrix.at(i, j);
            let threshold = if literal { Threshold::NONE } else { trial.scales().sign(i, value, edge) };
            Weight { i, j, value, threshold }
        };
        let own_edges = (0..matrix.rows()).any(|i| trial.scales().leaves_stencil(i));
        let is_boundary = boundary_edges(trial.domain);
        let mut found = Weights { interior: Vec::new(), boundary: Vec::new(), off_edges: 0, unweighted: 0, literal };
        for (number, &[i, j]) in edges.iter().enumerate() {
            if own_edges && matrix.get(i, j).is_none() && matrix.get(j, i).is_none() {
                found.unweighted += 1;
                continue;
            }
            let number = Some(number);
            let edge = Edge { number, weights: vec![weight(i, j, number), weight(j, i, number)] };
            let list = if number.is_some_and(|e| is_boundary[e]) { &mut found.boundary } else { &mut found.interior };
            list.push(edge);
        }
        for (i, j, v) in matrix.entries().filter(|&(i, j, v)| i != j && *v != 0.0) {
            let opposite = matrix.at(j, i) != 0.0;
            if (i > j && opposite) || edges.binary_search(&[i.min(j), i.max(j)]).is_ok() || *v == 0.0 {
                continue;
            }
            let mut weights = vec![weight(i, j, None)];
            weights.extend(opposite.then(|| weight(j, i, None)));
            found.interior.push(Edge { number: None, weights });
            found.off_edges += 1;
        }
        found
    }

    /// What a reader should know of how the weights were counted.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.off_edges > 0 {
            notes.push(format!("{} weights are on pairs that are no edges of the domain", self.off_edges));
        }
        if self.unweighted > 0 {
            notes.push(format!(
                "{} edges of the domain carry no weight: the operator has edges of its own",
                self.unweighted
            ));
        }
        notes
    }
}

/// For each edge of the domain, whether it is on the boundary.
fn boundary_edges(domain: &Domain) -> Vec<bool> {
    let edges = domain.edges();
    match domain {
        Domain::Surface(s) => (0..edges.len()).map(|e| s.topology().is_boundary_edge(e)).collect(),
        Domain::Volume(v) => {
            let mut flags = vec![false; edges.len()];
            for &[a, b, c] in v.boundary_triangles() {
                for edge in [[a, b], [a, c], [b, c]] {
                    if let Ok(e) = edges.binary_search(&edge) {
                        flags[e] = true;
                    }
                }
            }
            flags
        }
        _ => vec![false; edges.len()],
    }
}

/// What the sign of a weight comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Class {
    /// The predicate is violated.
    Violation,
    /// The weight is zero.
    Zero,
    /// Rounding leaves it open.
    Open,
    /// The predicate is true.
    Fine,
}

/// The strict predicate `ω > 0`; a weight that rounding cannot tell from zero is open, for only an exact zero is one.
pub(crate) fn strict(w: &Weight) -> Class {
    match w.threshold.sign(w.value) {
        _ if w.value == 0.0 => Class::Zero,
        Sign::Zero | Sign::Open => Class::Open,
        Sign::Negative => Class::Violation,
        Sign::Positive => Class::Fine,
    }
}

/// The weak predicate `ω ≥ 0`; what rounding explains is zero.
pub(crate) fn weak(w: &Weight) -> Class {
    match w.threshold.sign(w.value) {
        Sign::Zero => Class::Zero,
        Sign::Negative => Class::Violation,
        Sign::Open if w.value < 0.0 => Class::Open,
        Sign::Open | Sign::Positive => Class::Fine,
    }
}

/// Decides a predicate on a list of edges, worst class first in `order`; the classes in `failing` make it fail.
pub(crate) fn decide(
    trial: &Trial,
    edges: &[Edge],
    literal: bool,
    class: fn(&Weight) -> Class,
    order: [Class; 4],
    failing: &[Class],
) -> Verdict {
    let (tally, worst) = survey(trial, edges, class, order);
    let level = if literal { Level::Exact } else { Level::Measured };
    let verdict = match worst {
        Some((found, number, w)) if failing.contains(&found) => {
            Verdict::fails(level, witness(trial, number, &w, found == Class::Zero))
        }
        Some((Class::Open, _, w)) => Verdict::undecided(format!(
            "the weight {:.2e} at ({}, {}), one of {}, is no larger than {:.2e}: rounding may have given it its sign",
            w.value, w.i, w.j, tally.undecided, w.threshold.defect
        )),
        other => {
            let worst = other.map_or_else(Vec::new, |(_, _, w)| vec![w.i, w.j]);
            Verdict::holds(level, Evidence::bare(Statement::Scan { checked: tally.total, worst }))
        }
    };
    let verdict = verdict.with_tally(tally);
    if literal {
        return verdict;
    }
    let weights = edges.iter().flat_map(|e| &e.weights);
    verdict.with_margin(weights.map(|w| w.threshold.margin((-w.value).max(0.0))).fold(0.0, f64::max))
}

/// Counts the classes, an edge being of its worse direction's, and finds the worst weight: that of the worst class which is
/// the most negative relative to its row.
pub(crate) fn survey(
    trial: &Trial,
    edges: &[Edge],
    class: fn(&Weight) -> Class,
    order: [Class; 4],
) -> (Tally, Option<(Class, Option<usize>, Weight)>) {
    let rank = |c: Class| order.iter().position(|&o| o == c).unwrap_or(order.len());
    let relative = |w: &Weight| if w.value == 0.0 { 0.0 } else { w.value / trial.scales().rows[w.i] };
    let worse = |a: &Weight, b: &Weight| {
        let (x, y) = (rank(class(a)), rank(class(b)));
        x < y || (x == y && relative(a) < relative(b))
    };
    let mut tally = Tally { total: edges.len(), ..Tally::default() };
    let mut worst: Option<(&Edge, &Weight)> = None;
    for edge in edges {
        let Some(w) = edge.weights.iter().reduce(|a, b| if worse(b, a) { b } else { a }) else { continue };
        match class(w) {
            Class::Violation => tally.violations += 1,
            Class::Zero => tally.zeros += 1,
            Class::Open => tally.undecided += 1,
            Class::Fine => {}
        }
        if worst.as_ref().is_none_or(|(_, known)| worse(w, known)) {
            worst = Some((edge, w));
        }
    }
    // Where both directions say the same, the smaller end is named.
    let first = |edge: &Edge, w: &Weight| {
        edge.weights.iter().find(|v| v.value == w.value && class(v) == class(w)).copied().unwrap_or(*w)
    };
    (tally, worst.map(|(edge, w)| (class(w), edge.number, first(edge, w))))
}

fn witness(trial: &Trial, number: Option<usize>, w: &Weight, zero: bool) -> Evidence {
    let mut excerpt = excerpt::of_rows(trial, [w.i]).with_positions(trial, [w.i, w.j]);
    let mut opposite = Vec::new();
    if let (Domain::Surface(surface), Some(edge)) = (trial.domain, number) {
        let faces: Vec<usize> = surface.topology().sides(edge).iter().map(|s| s.face()).collect();
        excerpt = excerpt.with_faces(trial, &faces).with_corners(trial);
        let angle = |v: usize| geometry::angle(surface.point(v), surface.point(w.i), surface.point(w.j)).to_degrees();
        opposite = surface.opposite(edge).into_iter().map(|(_, v)| Corner { vertex: v, angle_deg: angle(v) }).collect();
    }
    Evidence::new(Statement::Weight { i: w.i, j: w.j, zero, opposite }, excerpt)
}
