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
    rows: Vec<Threshold>,
    scales: Vec<f64>,
    quality: Vec<f64>,
    shortest: Vec<f64>,
    degenerate: Vec<bool>,
    literal: bool,
}

impl Rounding {
    /// Of the operator on trial; kept by [`Trial::rounding`]. Cost: O(nnz).
    pub fn of(trial: &Trial) -> Self {
        let (matrix, at) = (trial.operator.stiffness(), trial.scales().geometry());
        let row = |i: usize| {
            let (mut q, mut shortest, mut degenerate) = (1.0, f64::INFINITY, false);
            let columns = matrix.row_slices(i).0;
            for &j in columns.iter().chain([&i]) {
                q = f64::max(q, at.vertices[j]);
                shortest = f64::min(shortest, at.shortest[j]);
                degenerate |= at.degenerate[j];
            }
            (Threshold::over(1.0, columns.len(), q), q, shortest, degenerate)
        };
        let n = matrix.rows();
        let mut rounding = Rounding {
            rows: Vec::with_capacity(n),
            scales: trial.scales().rows.clone(),
            quality: Vec::with_capacity(n),
            shortest: Vec::with_capacity(n),
            degenerate: Vec::with_capacity(n),
            literal: trial.has_literal_signs(),
        };
        for (threshold, q, shortest, degenerate) in parallel::collect(n, row) {
            rounding.rows.push(threshold);
            rounding.quality.push(q);
            rounding.shortest.push(shortest);
            rounding.degenerate.push(degenerate);
        }
        rounding
    }

    /// The thresholds of row i, relative to its scale.
    pub fn row(&self, i: usize) -> Threshold {
        self.rows[i]
    }

    /// The same where coordinates were moved by `displaced`; infinite beside a degenerate face, which may have become a proper
    /// one.
    pub fn row_displaced(&self, i: usize, displaced: f64) -> Threshold {
        let own = self.rows[i];
        if displaced == 0.0 {
            return own;
        }
        let quality = if self.degenerate[i] { f64::INFINITY } else { self.quality[i] };
        own.plus(Threshold::of_displacement(quality, displaced / self.shortest[i]))
    }

    /// The condition of the worst element at a vertex or at a vertex of its row; 1 where the domain has no elements.
    pub fn quality(&self, i: usize) -> f64 {
        self.quality[i]
    }

    /// The sign of the weight `−value` of the entry `L_ij = value` off the diagonal.
    pub fn weight(&self, i: usize, value: f64) -> Sign {
        let threshold = if self.literal { Threshold::NONE } else { self.rows[i].times(self.scales[i]) };
        threshold.sign(-value)
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
