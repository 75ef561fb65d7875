//! MAX-heat: heat flows from hot to cold.
//!
//! # Definition
//! One implicit Euler step `(M + tL)⁻¹ M ≥ 0` entrywise, for `t = h²/16, h², 16h²`: h² is the mean squared edge length, the time in
//! which heat crosses an edge; 1 on a graph, and where the mass counts vertices or edges (`unit`, `degree`) and no area: there M/L
//! is no squared length.
//!
//! # Decision
//! 1. A lumped positive mass, no negative weight, and row sums of L that are not below zero by more than rounding, or by what the
//!    mass outweighs: then `M + tL` is an M-matrix, that of the operator meant where rounding had to be excused.
//! 2. Otherwise all columns up to [`ALL_COLUMNS`] vertices, above a seeded sample of [`SAMPLE`] columns, each entry with
//!    the bound of its error.
//!
//! # Exception
//! Not applicable without a mass, or where a row of the mass has a diagonal entry or a sum that is not positive.
//!
//! # Level
//! Exact or bounded by the pattern of signs. Otherwise bounded where all columns are computed with a bound
//! ([`certified`](crate::linalg::certified)); measured for a sample, and where the influence of residuals is estimated.
//!
//! # References
//! Thomée and Wahlbin 2008 (on the lumped and the consistent mass).

use super::evidence::LARGEST_EXCERPT;
use super::excerpt::{copy_rows, of_all_rows};
use super::measure::condition::distance;
use super::measure::row;
use super::solve::dirichlet::{self, Signs};
use super::tolerance::Threshold;
use super::{Evidence, Level, Property, Question, Statement, Trial, Verdict};
use crate::linalg::Csr;
use crate::operator::{Mass, MassKind};
use crate::stream::Stream;

/// Up to this many vertices every column is computed.
pub const ALL_COLUMNS: usize = 300;

/// How many columns are drawn above.
pub const SAMPLE: usize = 32;

/// The time steps, in units of h².
const TIMES: [f64; 3] = [1.0 / 16.0, 1.0, 16.0];

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "MAX-heat",
    name: "maximum principle of the heat equation",
    statement: "(M + tL)⁻¹ M ≥ 0 entrywise for t = h²/16, h², 16 h², h² the mean squared edge length (1 where the mass counts vertices \
                or edges)",
    sources: &["thomee-wahlbin2008"],
    question: Question::Operator(decide),
};

fn decide(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let Some(mass) = trial.operator.mass() else {
        return Verdict::not_applicable("the operator has no mass matrix");
    };
    if trial.operator.size() == 0 {
        return Verdict::not_applicable("the domain has no vertex");
    }
    if let Some(i) = not_positive(mass) {
        return Verdict::not_applicable(format!(
            "row {i} of the mass has a diagonal entry or a sum that is not positive"
        ));
    }
    let counts = matches!(mass.kind(), MassKind::Unit | MassKind::Degree);
    let Some(unit) = (if counts { Some(1.0) } else { squared_edge_length(trial) }) else {
        return Verdict::not_applicable("the domain has no edge of positive length to measure time by");
    };
    let heat = Heat { trial, mass, times: TIMES.map(|t| t * unit) };
    heat.decide().with_note(format!("t = h²/16, h², 16 h² with h² = {unit:.6e}"))
}

fn not_positive(mass: &Mass) -> Option<usize> {
    let sum = |i: usize| mass.matrix().row(i).map(|(_, v)| *v).sum::<f64>();
    (0..mass.size()).find(|&i| !(mass.matrix().at(i, i) > 0.0 && sum(i) > 0.0))
}

/// The mean squared length of the edges, or of the pairs that the matrix joins where there are no edges; 1 without positions.
fn squared_edge_length(trial: &Trial) -> Option<f64> {
    let Some(positions) = trial.domain.positions() else { return Some(1.0) };
    let square = |[a, b]: [usize; 2]| distance(positions[a], positions[b]).powi(2);
    let lengths: Vec<f64> = if trial.domain.edges().is_empty() {
        let joined = trial.operator.stiffness().entries().filter(|(i, j, v)| i < j && **v != 0.0);
        joined.map(|(i, j, _)| square([i, j])).collect()
    } else {
        trial.domain.edges().iter().map(|e| square(*e)).collect()
    };
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    (mean > 0.0 && mean.is_finite()).then_some(mean)
}

struct Heat<'a> {
    trial: &'a Trial<'a>,
    mass: &'a Mass,
    times: [f64; 3],
}

impl Heat<'_> {
    fn step(&self, t: f64) -> Csr {
        self.mass.matrix().add(&self.trial.operator.stiffness().map(|_, _, v| t * v))
    }

    fn decide(&self) -> Verdict {
        if let Some(level) = self.is_m_matrix() {
            return Verdict::holds(level, Evidence::bare(Statement::SignPattern { set: 0 }));
        }
        let columns = self.columns();
        let sampled = columns.len() < self.trial.operator.size();
        let rounding = self.trial.rounding();
        let mut worst: Option<Signs> = None;
        for t in self.times {
            let step = self.step(t);
            let (of_mass, of_stiffness) = (self.mass.matrix().row_scales(), &self.trial.scales().rows);
            let scale = |i: usize| of_mass[i] + t * of_stiffness[i];
            let rows: Vec<_> = (0..step.rows()).map(|i| rounding.row(i).times(scale(i))).collect();
            let transposed = self.mass.matrix().transpose();
            let right = |k: usize| {
                let mut b = vec![0.0; step.rows()];
                transposed.row(columns[k]).for_each(|(i, v)| b[i] = *v);
                b
            };
            let Ok(signs) = dirichlet::signs(step.clone(), &rows, columns.len(), right) else {
                return Verdict::undecided(format!("M + tL is singular to working precision for t = {t:.6e}"));
            };
            if signs.is_negative() {
                return self.fails(t, &signs, columns[signs.low.column]);
            }
            if worst.as_ref().is_none_or(|w| signs.low.margin > w.low.margin) {
                worst = Some(signs);
            }
        }
        let Some(signs) = worst else { return Verdict::not_applicable("no time step was tried") };
        if !signs.is_nonnegative() {
            return Verdict::undecided(format!(
                "an entry of the step is {:.3e}, {:.1} times what rounding explains",
                signs.low.value, signs.low.margin
            ));
        }
        if !signs.is_certain() {
            return Verdict::undecided(signs.uncertainty());
        }
        let level = if signs.rigorous && !sampled { Level::Bounded } else { Level::Measured };
        let statement = Statement::Solved { columns: signs.columns, smallest: signs.smallest, error: signs.error };
        let verdict = Verdict::holds(level, Evidence::bare(statement)).with_margin(signs.low.margin.max(0.0));
        if sampled {
            return verdict.with_note(format!("{} of {} columns, drawn", columns.len(), self.trial.operator.size()));
        }
        verdict
    }

    /// Whether `M + tL` is an M-matrix for every t that is tried, and at what level.
    fn is_m_matrix(&self) -> Option<Level> {
        let stiffness = self.trial.operator.stiffness();
        let (diagonal, scales) = (self.mass.diagonal(), &self.trial.scales().rows);
        let sums = row::compensated_sums(stiffness);
        let outweighed = |i: usize| {
            self.times.iter().all(|t| {
                let rounding = Threshold::of_sum(diagonal[i] + t * scales[i], stiffness.row(i).len()).explained;
                diagonal[i] + t * sums[i] > rounding
            })
        };
        // Row sums vanish, as far as rounding goes, in every operator that is meant to have constants in its kernel; a large time
        // only magnifies what the rounding of the diagonal left.
        let excused = |i: usize| -sums[i] <= self.trial.rounding().row(i).explained * scales[i];
        let rows = || 0..diagonal.len();
        if !self.mass.is_lumped() || !rows().all(|i| row::no_negative_weight(stiffness, i)) {
            return None;
        }
        if rows().all(outweighed) {
            return Some(self.trial.level_of_signs());
        }
        rows().all(|i| excused(i) || outweighed(i)).then_some(Level::Bounded)
    }

    fn columns(&self) -> Vec<usize> {
        let n = self.trial.operator.size();
        let mut all: Vec<usize> = (0..n).collect();
        if n > ALL_COLUMNS {
            Stream::new(self.trial.seed, "MAX-heat").shuffle(&mut all);
            all.truncate(SAMPLE);
            all.sort_unstable();
        }
        all
    }

    fn fails(&self, t: f64, signs: &Signs, source: usize) -> Verdict {
        let at = signs.low;
        let statement = Statement::HeatLoss { t, source, at: at.row, value: at.value };
        let all = 0..self.trial.operator.size();
        let mut excerpt = of_all_rows(self.trial, all.clone());
        if self.mass.matrix().stored() <= LARGEST_EXCERPT {
            excerpt.mass_rows = copy_rows(self.mass.matrix(), all);
        }
        let level = if signs.rigorous { Level::Bounded } else { Level::Measured };
        Verdict::fails(level, Evidence::new(statement, excerpt)).with_margin(at.severity)
    }
}
