//! PSD: no function has negative energy.
//!
//! # Definition
//! `xᵀLx ≥ 0` for all x, of the symmetric part `S = ½(L + Lᵀ)` where L is not symmetric.
//!
//! # Decision
//! 1. A symmetric matrix with vanishing row sums and no negative weight is a sum of squares.
//! 2. Otherwise S is lifted by `τ diag(s)` and factorised: positive pivots and a backward error of at most `½ τ diag(s)` prove that
//!    no eigenvalue relative to `diag(s)` is below `−τ` by more than that error ([`backward`](crate::linalg::backward)). τ starts at
//!    512 u and grows to four times the error. If a pivot is not positive, S is lifted row by row by what rounding explains in the
//!    entries ([`rounding`](super::measure::rounding)), which a sliver raises in its own rows only.
//! 3. A pivot that is not positive gives a direction: one on the fewest vertices around some vertex if there is such, else that of
//!    the whole elimination, thinned out. It is rounded and its energy computed exactly. The property fails if the energy is below zero by more than `Σ defect_i s_i x_i²`: a symmetric perturbation with rows at most
//!    `defect_i s_i` changes the energy by no more.
//!
//! # Level
//! A witness is exact. A certificate is bounded: it says that no eigenvalue relative to `diag(s)` is below minus the stated shift,
//! in which the backward error is included. What can hide below it is in `docs/tolerance.md`.
//!
//! # Cost
//! One sparse factorisation for a holding operator that is no sum of squares; a handful for a failing one.
//!
//! # References
//! Wardetzky et al. 2007, section 2; Rump 2006 (verified positive definiteness); Demmel 1989.

use super::excerpt::of_rows;
use super::measure::row;
use super::solve::direction::{Direction, Energy};
use super::tolerance::{Threshold, UNIT_ROUNDOFF};
use super::{Evidence, Level, Property, Question, Statement, Trial, Verdict};
use crate::linalg::Csr;
use crate::linalg::factor::{FactorError, Ldlt};

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "PSD",
    name: "positive semi-definite",
    statement: "xᵀLx ≥ 0 for all x (of the symmetric part, where L is not symmetric)",
    sources: &["wardetzky2007", "rump2006"],
    question: Question::Operator(decide),
};

fn decide(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let matrix = trial.operator.stiffness();
    if is_sum_of_squares(matrix) {
        return Verdict::holds(Level::Bounded, Evidence::bare(Statement::SumOfSquares)).with_margin(0.0);
    }
    let case = Case::new(trial);
    let verdict = case.decide();
    if (0..matrix.rows()).any(|i| matrix.row(i).any(|(j, v)| matrix.at(j, i) != *v)) {
        return verdict.with_note("L is not symmetric: its symmetric part ½(L + Lᵀ) is decided");
    }
    verdict
}

/// Whether `xᵀLx = ½ Σ ω_ij (x_i − x_j)²` up to the rounding of a sum on the diagonal, with `ω ≥ 0`.
fn is_sum_of_squares(matrix: &Csr) -> bool {
    (0..matrix.rows()).all(|i| row::no_negative_weight(matrix, i) && row::sum_vanishes(matrix, i))
        && row::is_symmetric(matrix)
}

/// Lifts, relative to the row scales, that a negative energy may survive. A direction that survives a high one is confined to few
/// vertices: the highest is searched first.
const LIFTS: [f64; 12] = [0.3, 0.1, 0.03, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-9];

/// The symmetric part without its empty rows, and what it is compared with.
struct Case<'a> {
    trial: &'a Trial<'a>,
    /// The rows of S that are not empty.
    rows: Vec<usize>,
    /// S on those rows.
    part: Csr,
    /// L on those rows.
    given: Csr,
    /// `s_i = Σ_k |L_ik|`, of S where the row of L is empty.
    scales: Vec<f64>,
    /// The thresholds of the rows, times the larger of the two scales.
    thresholds: Vec<Threshold>,
}

impl<'a> Case<'a> {
    fn new(trial: &'a Trial<'a>) -> Self {
        let whole = trial.operator.stiffness().symmetric_part();
        let (own, rounding) = (whole.row_scales(), trial.rounding());
        let rows: Vec<usize> = (0..own.len()).filter(|&i| own[i] > 0.0).collect();
        let stiffness = trial.operator.stiffness();
        let of_given = stiffness.row_scales();
        let scales = rows.iter().map(|&i| if of_given[i] > 0.0 { of_given[i] } else { own[i] }).collect();
        let thresholds = rows.iter().map(|&i| rounding.row(i).times(own[i].max(of_given[i]))).collect();
        let (part, given) = (whole.submatrix(&rows, &rows), stiffness.submatrix(&rows, &rows));
        Case { trial, part, given, rows, scales, thresholds }
    }

    fn energy(&self) -> Energy<'_> {
        Energy { part: &self.part, given: &self.given, thresholds: &self.thresholds }
    }

    fn lifted(&self, lift: impl Fn(usize) -> f64) -> Csr {
        let diagonal: Vec<f64> = (0..self.rows.len()).map(lift).collect();
        self.part.add(&Csr::diagonal(&diagonal))
    }

    fn decide(&self) -> Verdict {
        if let Some(found) = self.energy().in_the_plane() {
            return self.fails(found);
        }
        // The lift must exceed the rounding of the factorisation, which is known only afterwards.
        let mut shift = 512.0 * UNIT_ROUNDOFF;
        for _ in 0..3 {
            let lifted = self.lifted(|i| shift * self.scales[i]);
            match self.attempt(&lifted) {
                Attempt::Positive { error, smallest } if error <= 0.5 * shift => {
                    return self.holds(shift + error, smallest).with_margin(error / shift);
                }
                Attempt::Positive { error, .. } => shift = 4.0 * error,
                Attempt::Negative => {
                    if let Some(found) = self.energy().in_a_ball() {
                        return self.fails(found);
                    }
                    let deep = LIFTS.iter().map(|&lift| self.lifted(|i| lift * self.scales[i]));
                    return match deep.chain([lifted]).find_map(|lifted| self.energy().search(&lifted)) {
                        Some(found) => self.fails(found),
                        None => self.decide_locally(shift),
                    };
                }
            }
        }
        Verdict::undecided(format!("the factorisation rounds more than {shift:.1e} relative to the row scales"))
    }

    /// The rows lifted by what rounding explains in each, and by the shift, which must exceed the rounding of the factorisation in
    /// *every* row: what a sliver is allowed is no excuse for the others.
    fn decide_locally(&self, mut shift: f64) -> Verdict {
        let explained = self.thresholds.iter().zip(&self.scales).map(|(t, s)| t.explained / s).fold(0.0, f64::max);
        for _ in 0..3 {
            let lifted = self.lifted(|i| self.thresholds[i].explained + shift * self.scales[i]);
            match self.attempt(&lifted) {
                Attempt::Positive { error, smallest } if error <= 0.5 * shift => {
                    return self.holds(explained + shift + error, smallest).with_note(
                        "each row was lifted by what rounding explains there; the shift stated is that of the worst row",
                    );
                }
                Attempt::Positive { error, .. } => shift = 4.0 * error,
                Attempt::Negative => break,
            }
        }
        let largest = explained + shift;
        let defective = self.lifted(|i| self.thresholds[i].defect);
        match self.energy().search(&defective) {
            Some(found) => self.fails(found),
            None => Verdict::undecided(format!(
                "some direction has negative energy, more than rounding explains (up to {largest:.1e} of the row scale) and less \
                 than a defect"
            )),
        }
    }

    fn attempt(&self, lifted: &Csr) -> Attempt {
        match Ldlt::new(lifted) {
            Ok(factor) => {
                let pivots = factor.pivots();
                if pivots.iter().all(|d| *d > 0.0) {
                    let order = factor.order();
                    let relative = order.iter().zip(&pivots).map(|(&i, d)| d / self.scales[i]);
                    let smallest = relative.fold(f64::INFINITY, f64::min);
                    return Attempt::Positive { error: factor.backward_error(&self.scales), smallest };
                }
                Attempt::Negative
            }
            Err(FactorError::Singular) => Attempt::Negative,
            Err(_) => Attempt::Positive { error: f64::INFINITY, smallest: 0.0 },
        }
    }

    fn holds(&self, shift: f64, smallest_pivot: f64) -> Verdict {
        // An empty matrix has no pivot.
        let smallest_pivot = if smallest_pivot.is_finite() { smallest_pivot } else { 0.0 };
        Verdict::holds(Level::Bounded, Evidence::bare(Statement::ShiftedFactor { shift, smallest_pivot }))
    }

    fn fails(&self, found: Direction) -> Verdict {
        let x: Vec<(usize, f64)> = found.x.iter().map(|&(i, v)| (self.rows[i], v)).collect();
        let excerpt = of_rows(self.trial, x.iter().map(|&(i, _)| i));
        Verdict::fails(Level::Exact, Evidence::new(Statement::NegativeEnergy { x }, excerpt))
            .with_margin(found.margin)
            .with_note(format!(
                "the energy is {:.3e}; down to −{:.1e} a correct operator might have it",
                found.energy, found.tolerated
            ))
    }
}

enum Attempt {
    Positive { error: f64, smallest: f64 },
    Negative,
}
