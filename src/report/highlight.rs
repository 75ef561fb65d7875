//! What a witness points at in a picture: edges, vertices, stars, values.

use crate::record::evidence::Fraction;
use crate::record::{Evidence, Statement};

/// The places that a picture shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Highlight {
    /// Edges that are at fault.
    pub bad: Vec<[usize; 2]>,
    /// Edges to tell from them.
    pub good: Vec<[usize; 2]>,
    /// Pairs that share no edge, joined by a dashed line.
    pub pairs: Vec<[usize; 2]>,
    /// Vertices at fault.
    pub vertices: Vec<usize>,
    /// Vertices whose star is marked.
    pub stars: Vec<usize>,
    /// Corners `(vertex, towards, towards, degrees)` whose angle is drawn.
    pub angles: Vec<(usize, usize, usize, f64)>,
    /// Values at vertices, coloured.
    pub values: Vec<(usize, f64)>,
    /// Arrows at vertices, of any common scale.
    pub arrows: Vec<(usize, [f64; 2])>,
    /// Heights of a lift of the mesh: its gradients are the vertices of a dual graph.
    pub lift: Vec<(usize, f64)>,
    /// What the colours of the values mean.
    pub legend: &'static str,
}

impl Highlight {
    /// What the statement points at. Certificates point at their worst place.
    pub fn of(evidence: &Evidence) -> Self {
        let none = Highlight::default();
        let values = |values: Vec<(usize, f64)>, legend| Highlight { values, legend, ..Highlight::default() };
        match &evidence.statement {
            Statement::Weight { i, j, opposite, .. } => Highlight {
                bad: vec![[*i, *j]],
                angles: opposite.iter().map(|c| (c.vertex, *i, *j, c.angle_deg)).collect(),
                ..none
            },
            Statement::FarEntry { i, j, .. } => Highlight { pairs: vec![[*i, *j]], vertices: vec![*i, *j], ..none },
            Statement::NotFinite { i, j, .. }
            | Statement::Asymmetry { i, j, .. }
            | Statement::MassAsymmetry { i, j, .. }
            | Statement::Inaccurate { i, j, .. }
            | Statement::Changed { i, j, .. }
            | Statement::NotConvex { i, j } => between(*i, *j),
            Statement::RowSum { i, .. }
            | Statement::NoWeight { i }
            | Statement::MassShare { i, .. }
            | Statement::Energy { star: i, .. } => at(*i),
            Statement::Moment { i, boundary, .. } => {
                let halves = boundary.iter().flatten().map(|&end| [*i, end]).collect();
                Highlight { good: halves, ..at(*i) }
            }
            Statement::BothSigns { i, positive, negative } => {
                Highlight { bad: vec![[*i, *negative]], good: vec![[*i, *positive]], vertices: vec![*i], ..none }
            }
            Statement::KernelVector { x, a, b, .. } => {
                Highlight { vertices: vec![*a, *b], ..values(x.clone(), "the vector that L takes to zero") }
            }
            Statement::NegativeEnergy { x } => values(x.clone(), "a direction of negative energy"),
            Statement::BelowCheeger { x, side } => Highlight {
                vertices: side.clone(),
                ..values(x.clone(), "a vector below the printed bound; circled: one side of the best partition")
            },
            Statement::MassNotPositive { x } => values(x.clone(), "a direction of no positive mass"),
            Statement::Singular { x, .. } => values(x.clone(), "zero where values are prescribed, and not zero"),
            Statement::Overshoot { set, source, at, value, .. } => {
                let prescribed = set.iter().map(|&v| (v, f64::from(u8::from(v == *source))));
                let all = prescribed.chain([(*at, *value)]).collect();
                Highlight { vertices: vec![*at], ..values(all, "prescribed values, and the value outside their range") }
            }
            Statement::HeatLoss { source, at, value, .. } => Highlight {
                vertices: vec![*at],
                ..values(vec![(*source, 1.0), (*at, *value)], "where the heat was, and the temperature below zero")
            },
            Statement::Motion { motion, .. } => {
                let arrow = |(v, y): &(usize, [Fraction; 2])| (*v, [y[0].approximate(), y[1].approximate()]);
                Highlight { arrows: motion.iter().map(arrow).collect(), ..none }
            }
            Statement::Lift { heights, .. } => {
                Highlight { lift: heights.iter().map(|(v, h)| (*v, h.approximate())).collect(), ..none }
            }
            Statement::Equilibrium { .. } | Statement::NoLift { .. } => none,
            Statement::Scan { worst, .. } => match worst.as_slice() {
                [i] => at(*i),
                [i, j] => between(*i, *j),
                _ => none,
            },
            Statement::MassTotal { .. }
            | Statement::SumOfSquares
            | Statement::ShiftedFactor { .. }
            | Statement::InertiaCount { .. }
            | Statement::SingularValues { .. }
            | Statement::ClosedClasses { .. }
            | Statement::SignPattern { .. }
            | Statement::Solved { .. }
            | Statement::Compared { .. }
            | Statement::FlipsToDelaunay { .. }
            | Statement::DelaunayNotMinimal { .. }
            | Statement::NotEmbedded { .. }
            | Statement::TorusFlips { .. }
            | Statement::Cospectral { .. }
            | Statement::Transplantation { .. }
            | Statement::SpectraDiffer { .. }
            | Statement::DelaunayEigenvalue { .. }
            | Statement::HarmonicForm { .. } => none,
            Statement::PositiveExtension { i, j, .. } => Highlight { bad: vec![[*i, *j]], ..none },
        }
    }

    /// The vertices that a picture must show, the most telling first.
    pub fn focus(&self) -> Vec<usize> {
        let ends = [&self.bad, &self.pairs, &self.good].into_iter().flatten().flatten().copied();
        let mut focus: Vec<usize> =
            self.vertices.iter().copied().chain(ends).chain(self.stars.iter().copied()).collect();
        if focus.is_empty() {
            let largest = self.values.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
            focus.extend(largest.map(|v| v.0));
        }
        let mut seen = std::collections::BTreeSet::new();
        focus.retain(|v| seen.insert(*v));
        focus
    }
}

fn at(i: usize) -> Highlight {
    Highlight { vertices: vec![i], stars: vec![i], ..Highlight::default() }
}

/// An entry off the diagonal is an edge, one on the diagonal a vertex.
fn between(i: usize, j: usize) -> Highlight {
    match i == j {
        true => at(i),
        false => Highlight { bad: vec![[i, j]], vertices: vec![i, j], ..Highlight::default() },
    }
}
