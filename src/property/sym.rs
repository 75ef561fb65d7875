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
        pairs.of_row(i, |pair| scan.look([pair.i, pair.j], pair.difference.abs(), pair.threshold));
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

/// A pair `i < j` at which something is stored, with `L_ij − L_ji`.
pub(super) struct Pair {
    /// The smaller vertex.
    pub i: usize,
    /// The larger vertex.
    pub j: usize,
    /// `L_ij − L_ji`.
    pub difference: f64,
    /// What the difference is measured against.
    pub threshold: Threshold,
}

/// The pairs at which something is stored on either side of the diagonal.
pub(super) struct Pairs<'a> {
    trial: &'a Trial<'a>,
    /// The transpose, where an entry has no mirror image: without it such a pair is found from its smaller vertex only.
    transpose: Option<Csr>,
}

impl<'a> Pairs<'a> {
    /// Of the operator on trial. Cost: O(nnz).
    pub fn of(trial: &'a Trial) -> Self {
        // Computed before threads ask for them.
        trial.scales();
        trial.stencil();
        let transpose = trial.mirror().is_none().then(|| trial.operator.stiffness().transpose());
        Pairs { trial, transpose }
    }

    /// The pairs whose smaller vertex is i, by the larger one.
    pub fn of_row(&self, i: usize, mut look: impl FnMut(Pair)) {
        let matrix = self.trial.operator.stiffness();
        let (scales, stencil) = (self.trial.scales(), self.trial.stencil());
        let mut see = |j: usize, link: Link, upper: f64, lower: f64| {
            let threshold = scales.entry(i, upper, link.edge()).plus(scales.entry(j, lower, link.edge()));
            look(Pair { i, j, difference: upper - lower, threshold });
        };
        let above = |m: &Csr| m.row_slices(i).0.partition_point(|&j| j <= i);
        let (columns, values) = matrix.row_slices(i);
        let (columns, values) = (&columns[above(matrix)..], &values[above(matrix)..]);
        let Some(transpose) = &self.transpose else {
            let pairs = self.trial.mirror().map_or(&[][..], |mirror| mirror.row(i));
            for ((&j, &[upper, lower]), link) in columns.iter().zip(pairs).zip(stencil.along(i, columns)) {
                see(j, link, matrix.values()[upper as usize], matrix.values()[lower as usize]);
            }
            return;
        };
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
            let link = stencil.along(i, &[j]).next().unwrap_or(Link::Far);
            see(j, link, upper, lower);
        }
    }
}
