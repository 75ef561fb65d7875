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
use crate::domain::{Domain, DomainKind, geometry};
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
    /// The value over the scale of its row.
    relative: f64,
    sign: Sign,
}

/// An edge with its weights: one in each direction, or one where only one is defined.
#[derive(Clone, Copy, Debug)]
struct Edge {
    /// The number of the edge in the domain, if it is one.
    number: Option<usize>,
    first: Weight,
    second: Option<Weight>,
}

impl Edge {
    /// Its weights, that of the smaller row first.
    fn weights(&self) -> impl Iterator<Item = &Weight> {
        std::iter::once(&self.first).chain(&self.second)
    }
}

/// All weights of an operator: which there are is known, what they are is looked up when they are asked for.
struct Weights<'a> {
    trial: &'a Trial<'a>,
    is_boundary: Vec<bool>,
    /// Whether the operator has edges of its own: then one of the domain that it stores nothing at carries no weight.
    own_edges: bool,
    /// On pairs that are no edges.
    beside: Vec<Edge>,
    /// Edges that carry no weight because the operator has edges of its own.
    unweighted: usize,
    /// Whether signs are read literally.
    literal: bool,
}

impl<'a> Weights<'a> {
    /// Of the operator on trial. Cost: O(nnz log(row length)).
    fn of(trial: &'a Trial) -> Self {
        // Computed before threads ask for it.
        trial.mirror();
        let (matrix, edges, scales) = (trial.operator.stiffness(), trial.domain.edges(), trial.scales());
        let mut weights = Weights {
            trial,
            is_boundary: boundary_edges(trial.domain),
            own_edges: (0..matrix.rows()).any(|i| scales.leaves_stencil(i)),
            beside: Vec::new(),
            unweighted: 0,
            literal: trial.has_literal_signs(),
        };
        if weights.own_edges {
            weights.unweighted = (0..edges.len()).filter(|&e| !weights.carries(e)).count();
        }
        // Where no row leaves the stencil and no face has diagonals, every entry is on an edge.
        let diagonals = trial.domain.as_surface().is_some_and(|s| !s.is_triangulated());
        if !(weights.own_edges || diagonals || trial.domain.kind() == DomainKind::Points) {
            return weights;
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
        self.weigh(i, j, edge, self.trial.operator.stiffness().at(i, j))
    }

    /// The weight of an entry.
    fn weigh(&self, i: usize, j: usize, edge: Option<usize>, entry: f64) -> Weight {
        let value = -entry;
        let threshold = if self.literal { Threshold::NONE } else { self.trial.scales().sign(i, value, edge) };
        let relative = if value == 0.0 { 0.0 } else { value / self.trial.scales().rows[i] };
        Weight { i, j, value, threshold, relative, sign: threshold.sign(value) }
    }

    /// The edge with this number, those of the domain first; `None` where it carries no weight.
    fn get(&self, k: usize) -> Option<Edge> {
        let edges = self.trial.domain.edges();
        let Some(&[i, j]) = edges.get(k) else { return self.beside.get(k - edges.len()).copied() };
        let matrix = self.trial.operator.stiffness();
        // As a rule the entries above the diagonal are those of the edges, one after the other.
        let pair = self.trial.mirror().and_then(|mirror| mirror.pairs().get(k));
        let pair = pair.map(|pair| pair.map(|at| at as usize));
        if let Some([upper, lower]) = pair.filter(|at| [matrix.indices()[at[1]], matrix.indices()[at[0]]] == [i, j]) {
            let [forth, back] = [matrix.values()[upper], matrix.values()[lower]];
            let (first, second) = (self.weigh(i, j, Some(k), forth), self.weigh(j, i, Some(k), back));
            return Some(Edge { number: Some(k), first, second: Some(second) });
        }
        let both = || (self.weight(i, j, Some(k)), self.weight(j, i, Some(k)));
        self.carries(k).then(both).map(|(first, second)| Edge { number: Some(k), first, second: Some(second) })
    }

    /// Surveys all parts, block by block in parallel, the blocks in order: each weight is looked up once.
    fn surveys(&self) -> Surveys {
        let count = self.trial.domain.edges().len() + self.beside.len();
        let block = |range: std::ops::Range<usize>| {
            let mut surveys = Surveys::default();
            range.filter_map(|k| self.get(k)).for_each(|edge| surveys.look(self, &edge));
            surveys
        };
        let mut surveys = Surveys::default();
        for found in parallel::blocks(count, block) {
            surveys.strict.add(found.strict);
            surveys.weak.add(found.weak);
            surveys.boundary.add(found.boundary);
            surveys.bridges.add(found.bridges);
        }
        surveys
    }

    /// What a reader should know of how the weights were counted.
    fn notes(&self) -> Vec<String> {
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

/// What is asked of a weight.
#[derive(Clone, Copy, Debug)]
enum Predicate {
    /// `ω > 0`; a weight that rounding cannot tell from zero is open, for only an exact zero is one.
    Strict,
    /// `ω ≥ 0`; what rounding explains is zero.
    Weak,
}

impl Predicate {
    /// The class of a weight, and how bad that is. Worst first: under the strict predicate a negative weight, a zero, a sign that is not
    /// clear; under the weak one a negative weight, one that is open, a zero.
    fn class(self, w: &Weight) -> (Class, u8) {
        match (self, w.sign) {
            (Predicate::Strict, _) if w.value == 0.0 => (Class::Zero, 1),
            (Predicate::Strict, Sign::Zero | Sign::Open) => (Class::Open, 2),
            (Predicate::Weak, Sign::Zero) => (Class::Zero, 2),
            (Predicate::Weak, Sign::Open) if w.value < 0.0 => (Class::Open, 1),
            (_, Sign::Negative) => (Class::Violation, 0),
            (Predicate::Weak, Sign::Open) | (_, Sign::Positive) => (Class::Fine, 3),
        }
    }

    /// How bad a weight is: the less, the worse. Of one class it is the more negative one relative to its row.
    fn order(self, w: &Weight) -> (u8, f64) {
        (self.class(w).1, w.relative)
    }
}

/// What the edges of a part come to under a predicate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Survey {
    predicate: Predicate,
    /// The classes, an edge being of its worse direction's.
    pub tally: Tally,
    /// The worst weight and its edge.
    worst: Option<(Edge, Weight)>,
    /// The largest margin of a negative weight.
    margin: f64,
}

impl Survey {
    fn new(predicate: Predicate) -> Self {
        Survey { predicate, tally: Tally::default(), worst: None, margin: 0.0 }
    }

    fn look(&mut self, edge: &Edge) {
        self.tally.total += 1;
        for w in edge.weights().filter(|w| w.value < 0.0) {
            self.margin = self.margin.max(w.threshold.margin(-w.value));
        }
        let order = |w: &Weight| self.predicate.order(w);
        let Some(w) = edge.weights().reduce(|a, b| if order(b) < order(a) { b } else { a }) else { return };
        match self.predicate.class(w).0 {
            Class::Violation => self.tally.violations += 1,
            Class::Zero => self.tally.zeros += 1,
            Class::Open => self.tally.undecided += 1,
            Class::Fine => {}
        }
        if self.worst.as_ref().is_none_or(|(_, known)| order(w) < order(known)) {
            self.worst = Some((*edge, *w));
        }
    }

    /// What comes of looking at the edges of both, those of `self` first.
    fn add(&mut self, later: Self) {
        self.tally.total += later.tally.total;
        self.tally.violations += later.tally.violations;
        self.tally.zeros += later.tally.zeros;
        self.tally.undecided += later.tally.undecided;
        self.margin = self.margin.max(later.margin);
        let order = |w: &Weight| self.predicate.order(w);
        if let Some((edge, w)) = later.worst
            && self.worst.as_ref().is_none_or(|(_, known)| order(&w) < order(known))
        {
            self.worst = Some((edge, w));
        }
    }

    /// Decides the predicate; the classes in `failing` make it fail.
    pub fn decide(&self, trial: &Trial, failing: &[Class]) -> Verdict {
        let (tally, literal) = (self.tally, trial.has_literal_signs());
        let class = |w: &Weight| self.predicate.class(w).0;
        let level = if literal { Level::Exact } else { Level::Measured };
        // Where both directions say the same, the smaller end is named.
        let first = |(edge, w): &(Edge, Weight)| {
            let same = edge.weights().find(|v| v.value == w.value && class(v) == class(w)).copied();
            (class(w), edge.number, same.unwrap_or(*w))
        };
        let verdict = match self.worst.as_ref().map(first) {
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
        if literal { verdict } else { verdict.with_margin(self.margin) }
    }
}

/// The surveys of all parts; kept by [`Trial::surveys`].
#[derive(Clone, Debug)]
pub(crate) struct Surveys {
    /// `ω > 0` on interior edges.
    pub strict: Survey,
    /// `ω ≥ 0` on interior edges.
    pub weak: Survey,
    /// `ω > 0` on boundary edges.
    pub boundary: Survey,
    /// `ω > 0` on interior edges with both ends on the boundary.
    pub bridges: Survey,
    /// What a reader should know of how the weights were counted.
    pub notes: Vec<String>,
}

impl Default for Surveys {
    fn default() -> Self {
        Surveys {
            strict: Survey::new(Predicate::Strict),
            weak: Survey::new(Predicate::Weak),
            boundary: Survey::new(Predicate::Strict),
            bridges: Survey::new(Predicate::Strict),
            notes: Vec::new(),
        }
    }
}

impl Surveys {
    /// Of the operator on trial.
    pub fn of(trial: &Trial) -> Self {
        let weights = Weights::of(trial);
        Surveys { notes: weights.notes(), ..weights.surveys() }
    }

    /// Looks at an edge in each part that it belongs to.
    fn look(&mut self, weights: &Weights, edge: &Edge) {
        if edge.number.is_some_and(|e| weights.is_boundary[e]) {
            return self.boundary.look(edge);
        }
        self.strict.look(edge);
        self.weak.look(edge);
        let on_boundary = weights.trial.domain.boundary();
        if edge.number.is_some() && on_boundary[edge.first.i] && on_boundary[edge.first.j] {
            self.bridges.look(edge);
        }
    }
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
