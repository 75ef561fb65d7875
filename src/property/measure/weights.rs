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

use super::stencil::Link;
use super::tolerance::{Sign, Threshold};
use crate::domain::{Domain, geometry};
use crate::linalg::parallel;
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
#[derive(Clone, Copy)]
pub(crate) struct Edge {
    /// The number of the edge in the domain, if it is one.
    pub number: Option<usize>,
    first: Weight,
    second: Option<Weight>,
}

impl Edge {
    /// Its weights, that of the smaller row first.
    pub fn weights(&self) -> impl Iterator<Item = &Weight> {
        std::iter::once(&self.first).chain(&self.second)
    }
}

/// All weights of an operator: which there are is known, what they are is looked up when they are asked for.
pub(crate) struct Weights<'a> {
    trial: &'a Trial<'a>,
    is_boundary: Vec<bool>,
    /// Whether the operator has edges of its own: then one of the domain that it stores nothing at carries no weight.
    own_edges: bool,
    /// On pairs that are no edges.
    beside: Vec<Edge>,
    /// How many interior edges of the domain carry a weight, and how many boundary ones.
    counts: [usize; 2],
    /// Edges that carry no weight because the operator has edges of its own.
    pub unweighted: usize,
    /// Whether signs are read literally.
    pub literal: bool,
}

/// Which edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    /// Interior edges and pairs that are no edges.
    Interior,
    /// Boundary edges.
    Boundary,
    /// Interior edges with both ends on the boundary.
    Bridges,
}

impl<'a> Weights<'a> {
    /// Of the operator on trial. Cost: O(nnz log(row length)).
    pub fn of(trial: &'a Trial) -> Self {
        let (matrix, edges, scales) = (trial.operator.stiffness(), trial.domain.edges(), trial.scales());
        let mut weights = Weights {
            trial,
            is_boundary: boundary_edges(trial.domain),
            own_edges: (0..matrix.rows()).any(|i| scales.leaves_stencil(i)),
            beside: Vec::new(),
            counts: [0; 2],
            unweighted: 0,
            literal: trial.has_literal_signs(),
        };
        for e in 0..edges.len() {
            match weights.carries(e) {
                true => weights.counts[usize::from(weights.is_boundary[e])] += 1,
                false => weights.unweighted += 1,
            }
        }
        let beside = |rows: std::ops::Range<usize>| rows.flat_map(|i| weights.beside(i)).collect::<Vec<_>>();
        let found = parallel::blocks(matrix.rows(), beside).concat();
        Weights { beside: found, ..weights }
    }

    /// The weights of row i on pairs that are no edges, each pair with the smaller row that has one.
    fn beside(&self, i: usize) -> impl Iterator<Item = Edge> {
        let matrix = self.trial.operator.stiffness();
        let row = self.trial.stencil().row(matrix, i);
        let off_edges = row.filter(|&(_, v, link)| v != 0.0 && matches!(link, Link::Face | Link::Far));
        off_edges.filter_map(move |(j, _, _)| {
            let opposite = matrix.at(j, i) != 0.0;
            let second = opposite.then(|| self.weight(j, i, None));
            (i < j || !opposite).then(|| Edge { number: None, first: self.weight(i, j, None), second })
        })
    }

    fn carries(&self, edge: usize) -> bool {
        let ([i, j], matrix) = (self.trial.domain.edges()[edge], self.trial.operator.stiffness());
        !self.own_edges || matrix.get(i, j).is_some() || matrix.get(j, i).is_some()
    }

    fn weight(&self, i: usize, j: usize, edge: Option<usize>) -> Weight {
        let value = -self.trial.operator.stiffness().at(i, j);
        let threshold = if self.literal { Threshold::NONE } else { self.trial.scales().sign(i, value, edge) };
        Weight { i, j, value, threshold }
    }

    /// How many edges a part has at most, and the one with this number; `None` where that carries no weight or belongs to
    /// another part.
    fn get(&self, part: Part, k: usize) -> Option<Edge> {
        let edges = self.trial.domain.edges();
        let Some(&[i, j]) = edges.get(k) else { return self.beside.get(k - edges.len()).copied() };
        let on_boundary = self.trial.domain.boundary();
        let belongs = self.is_boundary[k] == (part == Part::Boundary)
            && (part != Part::Bridges || (on_boundary[i] && on_boundary[j]));
        let both = || (self.weight(i, j, Some(k)), self.weight(j, i, Some(k)));
        (belongs && self.carries(k)).then(both).map(|(first, second)| Edge {
            number: Some(k),
            first,
            second: Some(second),
        })
    }

    fn most(&self, part: Part) -> usize {
        self.trial.domain.edges().len() + if part == Part::Interior { self.beside.len() } else { 0 }
    }

    /// Whether there is no edge on the inside, nor a pair that is no edge.
    pub fn no_interior(&self) -> bool {
        self.counts[0] + self.beside.len() == 0
    }

    /// Whether there is no boundary edge.
    pub fn no_boundary(&self) -> bool {
        self.counts[1] == 0
    }

    /// What a reader should know of how the weights were counted.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if !self.beside.is_empty() {
            notes.push(format!("{} weights are on pairs that are no edges of the domain", self.beside.len()));
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

/// Decides a predicate on the edges of a part, worst class first in `order`; the classes in `failing` make it fail.
pub(crate) fn decide(
    weights: &Weights,
    part: Part,
    class: fn(&Weight) -> Class,
    order: [Class; 4],
    failing: &[Class],
) -> Verdict {
    let Survey { tally, worst, margin } = survey(weights, part, class, order);
    let level = if weights.literal { Level::Exact } else { Level::Measured };
    let verdict = match worst {
        Some((found, number, w)) if failing.contains(&found) => {
            Verdict::fails(level, witness(weights.trial, number, &w, found == Class::Zero))
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
    if weights.literal { verdict } else { verdict.with_margin(margin) }
}

/// What the edges of a part come to.
pub(crate) struct Survey {
    /// The classes, an edge being of its worse direction's.
    pub tally: Tally,
    /// The worst weight with its class and its edge: that of the worst class which is the most negative relative to its row.
    worst: Option<(Class, Option<usize>, Weight)>,
    /// The largest margin of a negative weight.
    margin: f64,
}

/// Surveys the edges of a part in their order: block by block in parallel, the blocks in order.
pub(crate) fn survey(weights: &Weights, part: Part, class: fn(&Weight) -> Class, order: [Class; 4]) -> Survey {
    let rank = |c: Class| order.iter().position(|&o| o == c).unwrap_or(order.len());
    let scales = &weights.trial.scales().rows;
    let relative = |w: &Weight| if w.value == 0.0 { 0.0 } else { w.value / scales[w.i] };
    let worse = |a: &Weight, b: &Weight| {
        let (x, y) = (rank(class(a)), rank(class(b)));
        x < y || (x == y && relative(a) < relative(b))
    };
    let block = |range: std::ops::Range<usize>| {
        let (mut tally, mut margin) = (Tally::default(), 0.0_f64);
        let mut worst: Option<(Edge, Weight)> = None;
        for edge in range.filter_map(|k| weights.get(part, k)) {
            tally.total += 1;
            margin = edge.weights().fold(margin, |m, w| m.max(w.threshold.margin((-w.value).max(0.0))));
            let Some(w) = edge.weights().reduce(|a, b| if worse(b, a) { b } else { a }) else { continue };
            match class(w) {
                Class::Violation => tally.violations += 1,
                Class::Zero => tally.zeros += 1,
                Class::Open => tally.undecided += 1,
                Class::Fine => {}
            }
            if worst.as_ref().is_none_or(|(_, known)| worse(w, known)) {
                worst = Some((edge, *w));
            }
        }
        (tally, margin, worst)
    };
    let (mut tally, mut margin, mut worst) = (Tally::default(), 0.0_f64, None::<(Edge, Weight)>);
    for (counted, largest, found) in parallel::blocks(weights.most(part), block) {
        tally.total += counted.total;
        tally.violations += counted.violations;
        tally.zeros += counted.zeros;
        tally.undecided += counted.undecided;
        margin = margin.max(largest);
        worst = match (worst, found) {
            (Some(known), Some(found)) if !worse(&found.1, &known.1) => Some(known),
            (known, found) => found.or(known),
        };
    }
    // Where both directions say the same, the smaller end is named.
    let first = |edge: &Edge, w: &Weight| {
        edge.weights().find(|v| v.value == w.value && class(v) == class(w)).copied().unwrap_or(*w)
    };
    Survey { tally, worst: worst.map(|(edge, w)| (class(&w), edge.number, first(&edge, &w))), margin }
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
