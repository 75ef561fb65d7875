//! MAX-local: a discrete harmonic function has no strict local maximum inside.
//!
//! # Definition
//! At an interior vertex i no u with `(Lu)_i = 0` has a strict local maximum over the stencil of row i. With vanishing row sums
//! `(Lu)_i = Σ_j ω_ij (u_i − u_j)`, and such a u exists iff the weights take both signs or are all zero: with both signs the
//! positive differences can be balanced; with one sign the sum of positive differences has that sign.
//!
//! # Decision
//! By the signs of the weights of each interior row, all entries off the diagonal included. They are exact where the operator says so;
//! otherwise a weight within rounding of zero counts as zero, and a row fails only if a weight of either sign is a defect's
//! worth. Weights of both signs beyond rounding, but not that large, leave their row open.
//!
//! # Limitations
//! Vertices on the boundary are not looked at. Isolated vertices (no edge, no entry) neither: no neighbour could be below
//! them. The equivalence presumes NULL.
//!
//! # References
//! Wardetzky et al. 2007, section 2 (where positive weights are asked for instead, which is more).

use super::excerpt::of_rows;
use super::tolerance::Sign;
use super::{Evidence, Property, Question, Statement, Tally, Trial, Verdict};

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "MAX-local",
    name: "local maximum principle",
    statement: "at interior i no u with (Lu)_i = 0 has a strict local maximum ⇔ the weights of row i have one sign and are not \
                all zero",
    sources: &["wardetzky2007"],
    question: Question::Operator(decide),
};

/// What the signs of a row say: its largest weights of either sign beyond rounding.
struct Signature {
    positive: Option<Found>,
    negative: Option<Found>,
}

#[derive(Clone, Copy)]
struct Found {
    column: usize,
    size: f64,
    decisive: bool,
}

fn decide(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let alone = trial.isolated();
    let rows: Vec<usize> = trial.domain.interior().into_iter().filter(|&i| !alone[i]).collect();
    if rows.is_empty() {
        return Verdict::not_applicable("the domain has no interior vertex with a neighbour");
    }
    let scales = &trial.scales().rows;
    let mut tally = Tally { total: rows.len(), ..Tally::default() };
    let mut worst: Option<(f64, Statement, usize)> = None;
    let (mut closest, mut open) = ((-1.0, rows[0]), rows[0]);
    for &i in &rows {
        let row = Signature::of(trial, i);
        let found = match (row.positive, row.negative) {
            (Some(p), Some(q)) if p.decisive && q.decisive => Some((
                p.size.min(q.size) / scales[i],
                Statement::BothSigns { i, positive: p.column, negative: q.column },
            )),
            (None, None) => Some((1.0, Statement::NoWeight { i })),
            _ => None,
        };
        if let Some((size, statement)) = found {
            tally.violations += 1;
            tally.zeros += usize::from(matches!(statement, Statement::NoWeight { .. }));
            if worst.as_ref().is_none_or(|(most, _, _)| size > *most) {
                worst = Some((size, statement, i));
            }
        } else if row.is_open() {
            tally.undecided += 1;
            open = i;
        } else {
            // The row whose weakest weight is weakest stands closest to failing.
            let weakest = weakest(trial, i) / scales[i];
            if -weakest > closest.0 {
                closest = (-weakest, i);
            }
        }
    }
    let level = trial.level_of_signs();
    let verdict = match worst {
        Some((_, statement, i)) => Verdict::fails(level, Evidence::new(statement, of_rows(trial, [i]))),
        None if tally.undecided > 0 => Verdict::undecided(format!(
            "{} of {} rows, row {open} among them, have a weight between what rounding explains and a defect",
            tally.undecided, tally.total
        )),
        None => {
            let statement = Statement::Scan { checked: rows.len(), worst: vec![closest.1] };
            Verdict::holds(level, Evidence::bare(statement))
        }
    };
    let left_out = alone.iter().filter(|a| **a).count();
    let verdict = verdict.with_tally(tally);
    if left_out > 0 { verdict.with_note(format!("isolated vertices left out: {left_out}")) } else { verdict }
}

impl Signature {
    fn of(trial: &Trial, i: usize) -> Self {
        let mut row = Signature { positive: None, negative: None };
        for (column, &v) in trial.operator.stiffness().row(i).filter(|&(j, _)| j != i) {
            let sign = trial.rounding().weight(i, v);
            if sign == Sign::Zero {
                continue;
            }
            let found = Found { column, size: v.abs(), decisive: sign != Sign::Open };
            let side = if v < 0.0 { &mut row.positive } else { &mut row.negative };
            if side.is_none_or(|old| found.size > old.size) {
                *side = Some(found);
            }
        }
        row
    }

    /// Both signs beyond rounding.
    fn is_open(&self) -> bool {
        self.positive.is_some() && self.negative.is_some()
    }
}

/// The smallest magnitude of a weight of the row that is not zero.
fn weakest(trial: &Trial, i: usize) -> f64 {
    let weights = trial.operator.stiffness().row(i).filter(|&(j, v)| j != i && *v != 0.0);
    weights.map(|(_, v)| v.abs()).fold(f64::INFINITY, f64::min)
}
