//! Signs of the solutions of many linear systems with one matrix: how far below 0, or above 1, do they come.

use crate::linalg::Csr;
use crate::linalg::certified::Certified;
use crate::linalg::factor::FactorError;
use crate::property::tolerance::Threshold;

/// Columns solved at a time.
const BLOCK: usize = 64;

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
/// `w_i = defect_i s_i`. A solution x is then within `(τ + max(1, ‖x‖)) g` of that of the operator meant, `g = |A⁻¹| v`, and
/// beyond `(τ + max(1, ‖x‖)) |A⁻¹| w` of an admissible value it is a defect.
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
    let defect = solver.influence_of(&rows.iter().map(|t| t.defect).collect::<Vec<_>>());
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
                let (error, limit) = (size * solver.influence()[row], size * defect[row]);
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
