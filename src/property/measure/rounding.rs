//! The thresholds of whole rows for decisions that couple a row with its neighbours: solutions, directions, comparisons.
//!
//! # Definition
//! Formulas and their derivation are in [`tolerance`](super::tolerance). Row i has Q_i, the worst condition at vertex i *and at the
//! vertices of its row*: an entry `L_ij` of an operator that is not symmetric may be computed at j. The thresholds are
//! relative to the row scale s_i.

use super::tolerance::{Sign, Threshold};
use crate::linalg::parallel;
use crate::property::Trial;

/// What rounding explains, row by row.
pub(crate) struct Rounding {
    rows: Vec<Row>,
    literal: bool,
}

struct Row {
    /// Relative to the scale.
    threshold: Threshold,
    scale: f64,
    quality: f64,
    shortest: f64,
    degenerate: bool,
}

impl Rounding {
    /// Of the operator on trial; kept by [`Trial::rounding`]. Cost: O(nnz).
    pub fn of(trial: &Trial) -> Self {
        let (matrix, scales) = (trial.operator.stiffness(), trial.scales());
        let row = |i: usize| {
            let (mut quality, mut shortest, mut degenerate) = (1.0, f64::INFINITY, false);
            let columns = matrix.row_slices(i).0;
            for &j in columns.iter().chain([&i]) {
                let star = &scales.geometry().stars[j];
                quality = f64::max(quality, star.condition);
                shortest = f64::min(shortest, star.shortest);
                degenerate |= star.degenerate;
            }
            let threshold = Threshold::over(1.0, columns.len(), quality);
            Row { threshold, scale: scales.rows[i], quality, shortest, degenerate }
        };
        Rounding { rows: parallel::collect(matrix.rows(), row), literal: trial.has_literal_signs() }
    }

    /// The thresholds of row i, relative to its scale.
    pub fn row(&self, i: usize) -> Threshold {
        self.rows[i].threshold
    }

    /// The same where coordinates were moved by `displaced`; infinite beside a degenerate face, which may have become a proper
    /// one.
    pub fn row_displaced(&self, i: usize, displaced: f64) -> Threshold {
        let own = &self.rows[i];
        if displaced == 0.0 {
            return own.threshold;
        }
        let quality = if own.degenerate { f64::INFINITY } else { own.quality };
        own.threshold.plus(Threshold::of_displacement(quality, displaced / own.shortest))
    }

    /// The condition of the worst element at a vertex or at a vertex of its row; 1 where the domain has no elements.
    pub fn quality(&self, i: usize) -> f64 {
        self.rows[i].quality
    }

    /// The sign of the weight `−value` of the entry `L_ij = value` off the diagonal.
    pub fn weight(&self, i: usize, value: f64) -> Sign {
        self.signs(i).sign(-value)
    }

    /// What the weights of row i must exceed for their sign to be clear.
    pub fn signs(&self, i: usize) -> Threshold {
        if self.literal { Threshold::NONE } else { self.rows[i].threshold.times(self.rows[i].scale) }
    }
}

#[cfg(test)]
mod tests {
    use crate::domain::Surface;
    use crate::linalg::Csr;
    use crate::operator::{Operator, Provenance};
    use crate::property::Trial;

    #[test]
    fn a_row_is_measured_with_the_worst_of_its_neighbours() {
        // A needle of height 1e-6 at vertices 0, 1, 2; vertex 3 sees it through its row only.
        let p = [[0.0, 0.0], [1.0, 0.0], [0.0, 1e-6], [1.0, -1.0]];
        let domain = Surface::planar(&p, &[[0, 1, 2], [0, 3, 1]]).unwrap().into();
        let t = [(0, 0, 1.0), (1, 1, 1.0), (2, 2, 1.0), (3, 3, 1.0), (3, 0, -1.0)];
        let stiffness = Csr::from_triplets(4, 4, &t);
        let provenance = Provenance { id: "test".into(), parameters: Default::default(), notes: Vec::new() };
        let operator = Operator::new(stiffness, provenance).unwrap();
        let trial = Trial::new(&domain, &operator, 0).unwrap();
        let rounding = trial.rounding();
        assert_eq!(rounding.quality(3), rounding.quality(0));
        assert!((rounding.quality(3) * 1e-6 - 1.0).abs() < 1e-9);
        // 8 Q δ / ℓ more when moved by δ; nothing more when not.
        assert_eq!(rounding.row_displaced(3, 0.0), rounding.row(3));
        let more = rounding.row_displaced(3, 1e-16).explained - rounding.row(3).explained;
        assert!((more / (8.0 * 1e6 * 1e-16 / 1e-6) - 1.0).abs() < 1e-6, "{more:e}");
    }
}
