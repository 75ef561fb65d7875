//! SYM: the matrix is its own transpose.
//!
//! # Definition
//! `L_ij = L_ji` for every pair. The residual `|L_ij − L_ji|` is measured against the rounding of the two entries themselves, so
//! that neither a large entry elsewhere nor a sliver hides it; see [`tolerance`](super::tolerance).

use super::evidence::{Evidence, Statement};
use super::excerpt;
use super::measure::scan::Scan;
use super::stencil::Link;
use super::tolerance::Threshold;
use super::verdict::{Level, Outcome};
use super::{Property, Question, Trial, Verdict};
use crate::linalg::Csr;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "SYM",
    name: "symmetry",
    statement: "L = Lᵀ",
    sources: &["wardetzky2007"],
    question: Question::Operator(check),
};

fn check(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let pairs = Pairs::of(trial);
    let scan = Scan::over(trial.operator.size(), |i, scan: &mut Scan<[usize; 2]>| {
        pairs.of_row(i, |pair| match pair.difference == 0.0 && pairs.are_in_range(pair.i, pair.j) {
            true => scan.pass([pair.i, pair.j], || pairs.threshold(&pair)),
            false => scan.look([pair.i, pair.j], pair.difference.abs(), pairs.threshold(&pair)),
        });
    });
    let bitwise = scan.margin() == 0.0;
    let mut verdict = scan.verdict(
        Level::Measured,
        |place| place.to_vec(),
        |found| {
            let [i, j] = found.place;
            let statement = Statement::Asymmetry { i, j, threshold: found.threshold.defect };
            Evidence::new(statement, excerpt::of_rows(trial, [i, j]))
        },
    );
    if bitwise && matches!(verdict.outcome, Outcome::Holds(_)) {
        verdict.level = Level::Exact;
    }
    verdict
}

/// A pair `i < j` at which something is stored: L_ij and L_ji.
struct Pair {
    i: usize,
    j: usize,
    upper: f64,
    lower: f64,
    /// `L_ij − L_ji`.
    difference: f64,
}

/// The pairs at which something is stored on either side of the diagonal.
struct Pairs<'a> {
    trial: &'a Trial<'a>,
    /// The transpose, where an entry has no mirror image: without it such a pair is found from its smaller vertex only.
    transpose: Option<Csr>,
}

impl<'a> Pairs<'a> {
    /// Of the operator on trial. Cost: O(nnz).
    fn of(trial: &'a Trial) -> Self {
        // Computed before threads ask for them.
        trial.scales();
        trial.stencil();
        let transpose = trial.mirror().is_none().then(|| trial.operator.stiffness().transpose());
        Pairs { trial, transpose }
    }

    /// Whether the scales of two rows are finite: then so are the thresholds between them.
    fn are_in_range(&self, i: usize, j: usize) -> bool {
        let rows = &self.trial.scales().rows;
        rows[i].is_finite() && rows[j].is_finite()
    }

    /// What the difference is measured against.
    fn threshold(&self, &Pair { i, j, upper, lower, .. }: &Pair) -> Threshold {
        let (scales, stencil) = (self.trial.scales(), self.trial.stencil());
        let edge = stencil.along(i, &[j]).next().and_then(Link::edge);
        scales.entry(i, upper, edge).plus(scales.entry(j, lower, edge))
    }

    /// The pairs whose smaller vertex is i, by the larger one.
    fn of_row(&self, i: usize, mut look: impl FnMut(Pair)) {
        let matrix = self.trial.operator.stiffness();
        let mut see = |j: usize, upper: f64, lower: f64| look(Pair { i, j, upper, lower, difference: upper - lower });
        let above = |m: &Csr| m.row_slices(i).0.partition_point(|&j| j <= i);
        let Some(transpose) = &self.transpose else {
            let (columns, values) = (matrix.indices(), matrix.values());
            for pair in self.trial.mirror().map_or(&[][..], |mirror| mirror.row(i)) {
                let [upper, lower] = pair.map(|at| at as usize);
                see(columns[upper], values[upper], values[lower]);
            }
            return;
        };
        let (columns, values) = matrix.row_slices(i);
        let (columns, values) = (&columns[above(matrix)..], &values[above(matrix)..]);
        // Both rows are walked at once, whichever column comes first.
        let (mirror, mirrored) = transpose.row_slices(i);
        let (mut a, mut b) = (0, above(transpose));
        while let Some(j) = columns.get(a).into_iter().chain(mirror.get(b)).min().copied() {
            let (mut upper, mut lower) = (0.0, 0.0);
            if columns.get(a) == Some(&j) {
                (upper, a) = (values[a], a + 1);
            }
            if mirror.get(b) == Some(&j) {
                (lower, b) = (mirrored[b], b + 1);
            }
            see(j, upper, lower);
        }
    }
}
