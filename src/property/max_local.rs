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
use crate::linalg::parallel;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "MAX-local",
    name: "local maximum principle",
    statement: "at interior i no u with (Lu)_i = 0 has a strict local maximum ⇔ the weights of row i have one sign and are not \
                all zero",
    sources: &["wardetzky2007"],
    question: Question::Operator(decide),
};

/// What the signs of a row say: its largest weights of either sign beyond rounding, and its weakest.
struct Signature {
    positive: Option<Found>,
    negative: Option<Found>,
    /// The smallest magnitude of a weight that is not zero.
    weakest: f64,
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
    // Computed before threads ask for them.
    trial.rounding();
    let survey = parallel::blocks(rows.len(), |range| {
        let mut survey = Survey::default();
        rows[range].iter().for_each(|&i| survey.look(trial, i));
        survey
    });
    let Survey { tally, worst, closest, open } = survey.into_iter().fold(Survey::default(), Survey::then);
    let level = trial.level_of_signs();
    let verdict = match worst {
        Some((_, statement, i)) => Verdict::fails(level, Evidence::new(statement, of_rows(trial, [i]))),
        None if tally.undecided > 0 => Verdict::undecided(format!(
            "{} of {} rows, row {} among them, have a weight between what rounding explains and a defect",
            tally.undecided,
            tally.total,
            open.unwrap_or(rows[0])
        )),
        None => {
            let statement = Statement::Scan { checked: rows.len(), worst: vec![closest.map_or(rows[0], |(_, i)| i)] };
            Verdict::holds(level, Evidence::bare(statement))
        }
    };
    let left_out = alone.iter().filter(|a| **a).count();
    let verdict = verdict.with_tally(tally);
    if left_out > 0 { verdict.with_note(format!("isolated vertices left out: {left_out}")) } else { verdict }
}

/// The rows looked at so far.
#[derive(Default)]
struct Survey {
    tally: Tally,
    /// The worst violation: its size relative to the row, what it says, the row.
    worst: Option<(f64, Statement, usize)>,
    /// The row whose weakest weight is weakest relative to the row: it stands closest to failing.
    closest: Option<(f64, usize)>,
    /// The last open row.
    open: Option<usize>,
}

impl Survey {
    fn look(&mut self, trial: &Trial, i: usize) {
        let (row, scale) = (Signature::of(trial, i), trial.scales().rows[i]);
        self.tally.total += 1;
        let found = match (row.positive, row.negative) {
            (Some(p), Some(q)) if p.decisive && q.decisive => {
                let statement = Statement::BothSigns { i, positive: p.column, negative: q.column };
                Some((p.size.min(q.size) / scale, statement))
            }
            (None, None) => Some((1.0, Statement::NoWeight { i })),
            _ => None,
        };
        if let Some((size, statement)) = found {
            self.tally.violations += 1;
            self.tally.zeros += usize::from(matches!(statement, Statement::NoWeight { .. }));
            if self.worst.as_ref().is_none_or(|(most, _, _)| size > *most) {
                self.worst = Some((size, statement, i));
            }
        } else if row.is_open() {
            self.tally.undecided += 1;
            self.open = Some(i);
        } else {
            let weakest = row.weakest / scale;
            if self.closest.is_none_or(|(least, _)| weakest < least) {
                self.closest = Some((weakest, i));
            }
        }
    }

    /// What comes of looking at the rows of both, those of `self` first.
    fn then(mut self, later: Self) -> Self {
        self.tally.total += later.tally.total;
        self.tally.violations += later.tally.violations;
        self.tally.zeros += later.tally.zeros;
        self.tally.undecided += later.tally.undecided;
        if let Some((size, ..)) = &later.worst
            && self.worst.as_ref().is_none_or(|(most, ..)| size > most)
        {
            self.worst = later.worst;
        }
        if let Some((weakest, _)) = later.closest
            && self.closest.is_none_or(|(least, _)| weakest < least)
        {
            self.closest = later.closest;
        }
        self.open = later.open.or(self.open);
        self
    }
}

impl Signature {
    fn of(trial: &Trial, i: usize) -> Self {
        let (mut row, threshold) =
            (Signature { positive: None, negative: None, weakest: f64::INFINITY }, trial.rounding().signs(i));
        for (column, &v) in trial.operator.stiffness().row(i).filter(|&(j, v)| j != i && *v != 0.0) {
            row.weakest = row.weakest.min(v.abs());
            let sign = threshold.sign(-v);
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
