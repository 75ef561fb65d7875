//! SYM: the matrix is its own transpose.
//!
//! # Definition
//! `L_ij = L_ji` for every pair. The residual `|L_ij − L_ji|` is measured against the rounding of the two entries themselves, so
//! that neither a large entry elsewhere nor a sliver hides it; see [`tolerance`](super::tolerance).

use super::evidence::{Evidence, Statement};
use super::excerpt;
use super::measure::scan::Scan;
use super::tolerance::Threshold;
use super::verdict::{Level, Outcome};
use super::{Property, Question, Trial, Verdict};

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
    let mut scan = Scan::new();
    for pair in pairs(trial) {
        scan.look([pair.i, pair.j], pair.difference.abs(), pair.threshold);
    }
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

/// The pairs at which something is stored on either side of the diagonal, row by row.
pub(super) fn pairs<'a>(trial: &'a Trial) -> impl Iterator<Item = Pair> + 'a {
    let (matrix, scales, edges) = (trial.operator.stiffness(), trial.scales(), trial.domain.edges());
    let transpose = matrix.transpose();
    (0..matrix.rows()).flat_map(move |i| {
        let upper = |&(j, _): &(usize, &f64)| j > i;
        let mut columns: Vec<usize> =
            matrix.row(i).filter(upper).chain(transpose.row(i).filter(upper)).map(|(j, _)| j).collect();
        columns.sort_unstable();
        columns.dedup();
        let pairs: Vec<Pair> = columns
            .into_iter()
            .map(|j| {
                let (upper, lower) = (matrix.at(i, j), transpose.at(i, j));
                let edge = edges.binary_search(&[i, j]).ok();
                let threshold = scales.entry(i, upper, edge).plus(scales.entry(j, lower, edge));
                Pair { i, j, difference: upper - lower, threshold }
            })
            .collect();
        pairs
    })
}
