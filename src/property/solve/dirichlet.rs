//! Signs of the solutions of many linear systems with one matrix: how far below 0, or above 1, do they come.

use crate::linalg::Csr;
use crate::linalg::certified::Certified;
use crate::linalg::factor::FactorError;
use crate::property::tolerance::Threshold;

/// Columns solved at a time.
const BLOCK: usize = 64;

/// A solution that rounding of the matrix may have moved by more than this, of values between 0 and 1, certifies nothing.
const LARGEST_ERROR: f64 = 1.0 / 1024.0;

/// Where a solution came closest to leaving its range, or left it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extreme {
    /// How far outside, over what rounding of matrix and solution explains: negative inside.
    pub margin: f64,
    /// The column.
    pub column: usize,
    /// The row.
    pub row: usize,
    /// The value there.
    pub value: f64,
    /// How far outside, over what only a defect explains.
    pub severity: f64,
}

impl Extreme {
    const NONE: Extreme =
        Extreme { margin: f64::NEG_INFINITY, column: 0, row: 0, value: 0.0, severity: f64::NEG_INFINITY };

    /// The worse of two: a defect before what is none, then the larger margin.
    fn worse(self, other: Self) -> Self {
        let key = |e: &Self| (if e.severity > 1.0 { e.severity } else { 0.0 }, e.margin);
        if key(&other) > key(&self) { other } else { self }
    }
}

/// What was found in all columns.
pub(crate) struct Signs {
    /// The entry farthest below zero, measured by what only a defect explains; where none is below that, by what rounding
    /// explains.
    pub low: Extreme,
    /// The same above one.
    pub high: Extreme,
    /// The smallest entry.
    pub smallest: f64,
    /// The largest bound for an error: of the solution, and of what the rounding of the matrix does to it.
    pub error: f64,
    /// How many columns.
    pub columns: usize,
    /// Whether the error is a bound rather than an estimate.
    pub rigorous: bool,
}

impl Signs {
    /// Whether the solution is known well enough for its signs to mean something.
    pub(crate) fn is_certain(&self) -> bool {
        self.error <= LARGEST_ERROR
    }

    /// Why a solution that leaves its range nowhere decides nothing.
    pub(crate) fn uncertainty(&self) -> String {
        format!(
            "rounding of the matrix may move an entry of the solution by {:.1e}: it is too ill-conditioned to tell a sign",
            self.error
        )
    }

    /// Whether an entry lies below zero by more than a defect's worth.
    pub(crate) fn is_negative(&self) -> bool {
        self.low.severity > 1.0
    }

    /// Whether an entry lies above one by more than a defect's worth.
    pub(crate) fn exceeds_one(&self) -> bool {
        self.high.severity > 1.0
    }

    /// Whether rounding explains everything below zero.
    pub(crate) fn is_nonnegative(&self) -> bool {
        self.low.margin <= 1.0
    }

    /// Whether rounding explains everything above one.
    pub(crate) fn is_at_most_one(&self) -> bool {
        self.high.margin <= 1.0
    }
}

/// Solves `A x = b` for the columns `b = right(0), …, right(columns − 1)` and looks at every entry.
///
/// `rows` are the thresholds of the rows of A and of the right-hand sides for values up to one, `v_i = explained_i s_i` and
/// `w_i = defect_i s_i`. The operator meant has `A' = A + δA` and `b' = b + δb` with `|δb − δA x| ≤ v max(1, ‖x‖)`, so that
/// `|x' − x| ≤ (τ + max(1, ‖x‖)) |A'⁻¹| v`. With `g = |A⁻¹| v` and `|δA| g ≤ v ‖g‖`, Neumann's series gives
/// `|A'⁻¹| v ≤ g / (1 − ‖g‖)`, the norm being the largest component; where it is not below one, A' may be singular and nothing is
/// explained or decided. Beyond `(τ + max(1, ‖x‖)) h / (1 − ‖h‖)`, `h = |A⁻¹| w`, of an admissible value the solution is a defect.
///
/// # Errors
/// A matrix that is singular to working precision.
pub(crate) fn signs(
    matrix: Csr,
    rows: &[Threshold],
    columns: usize,
    right: impl Fn(usize) -> Vec<f64>,
) -> Result<Signs, FactorError> {
    let solver = Certified::new(matrix, rows.iter().map(|t| t.explained).collect())?;
    let explained = perturbed(solver.influence());
    let defect = perturbed(&solver.influence_of(&rows.iter().map(|t| t.defect).collect::<Vec<_>>()));
    let mut found = Signs {
        low: Extreme::NONE,
        high: Extreme::NONE,
        smallest: f64::INFINITY,
        error: 0.0,
        columns,
        rigorous: solver.is_rigorous(),
    };
    for start in (0..columns).step_by(BLOCK) {
        let mut block: Vec<Vec<f64>> = (start..columns.min(start + BLOCK)).map(&right).collect();
        let errors = solver.solve(&mut block);
        for ((column, x), tau) in (start..).zip(&block).zip(errors) {
            if !tau.is_finite() {
                return Err(FactorError::Singular);
            }
            let size = tau + x.iter().fold(1.0_f64, |m, v| m.max(v.abs()));
            for (row, &value) in x.iter().enumerate() {
                let (error, limit) = (size * explained[row], size * defect[row]);
                let at =
                    |outside: f64| Extreme { margin: outside / error, severity: outside / limit, column, row, value };
                found.smallest = found.smallest.min(value);
                found.error = found.error.max(error);
                found.low = found.low.worse(at(-value));
                found.high = found.high.worse(at(value - 1.0));
            }
        }
    }
    Ok(found)
}

/// `g / (1 − ‖g‖)`, infinite where that is no bound.
fn perturbed(influence: &[f64]) -> Vec<f64> {
    let largest = influence.iter().copied().fold(0.0, f64::max);
    influence.iter().map(|g| if largest < 1.0 { g / (1.0 - largest) } else { f64::INFINITY }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `[1 + a, −1; −1, 1 + a]`, whose inverse has the row sums 1/a, with values 1 prescribed beyond.
    fn found(a: f64, explained: f64) -> Signs {
        let matrix = Csr::from_triplets(2, 2, &[(0, 0, 1.0 + a), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 1.0 + a)]);
        let rows = [Threshold { explained, defect: 4.0 * explained }; 2];
        signs(matrix, &rows, 1, |_| vec![a, -2.0 * a]).unwrap()
    }

    #[test]
    fn a_nearly_singular_matrix_decides_nothing_however_negative_its_solution() {
        // ‖g‖ = explained / a. The solution is (1 + O(a), …) / … and negative by about a half.
        let (sound, singular) = (found(1e-3, 1e-9), found(1e-3, 1e-2));
        assert!(sound.is_negative() && sound.is_certain());
        assert!(!singular.is_negative() && !singular.is_certain());
        // Up to a defect's worth the matrix meant may be singular, up to rounding it is not.
        let between = found(1e-3, 3e-4);
        assert!(!between.is_negative() && !between.is_certain());
    }

    #[test]
    fn the_error_covers_the_solution_of_every_perturbed_matrix() {
        let (a, delta) = (0.01, 1e-4);
        let (plain, base) = (found(a, 2.0 * delta), [a, -2.0 * a]);
        for corner in 0..16 {
            let sign = |k: usize| if corner >> k & 1 == 0 { delta } else { -delta };
            let (p, q, r, s) = (1.0 + a + sign(0), -1.0 + sign(1), -1.0 + sign(2), 1.0 + a + sign(3));
            let det = p * s - q * r;
            let x = [(s * base[0] - q * base[1]) / det, (p * base[1] - r * base[0]) / det];
            assert!(x[0].min(x[1]) >= plain.smallest - plain.error, "corner {corner}");
        }
    }
}
