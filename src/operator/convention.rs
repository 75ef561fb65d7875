//! The one place where signs and scales are converted.
//!
//! | library | sign | factor to ours |
//! | --- | --- | --- |
//! | libigl `cotmatrix` | negative semi-definite | −1 |
//! | pmp | negative semi-definite | −1 |
//! | geometry-central, robust_laplacian, potpourri3d, LaPy, scikit-fem, gpytoolbox | positive semi-definite | 1 |
//! | CGAL `cotangent_weight` | positive | ¼ |

use crate::linalg::Csr;

/// The sign convention of a stiffness matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sign {
    /// Ours: the diagonal is positive.
    PositiveSemidefinite,
    /// The diagonal is negative.
    NegativeSemidefinite,
}

impl std::fmt::Display for Sign {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Sign::PositiveSemidefinite => "positive semi-definite",
            Sign::NegativeSemidefinite => "negative semi-definite",
        })
    }
}

/// Why the sign of a matrix could not be settled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SignError {
    /// The diagonal does not tell.
    #[error(
        "the sign cannot be read off the diagonal ({positive} positive, {negative} negative entries); \
         say which it is with --sign psd or --sign nsd"
    )]
    Ambiguous {
        /// Positive diagonal entries.
        positive: usize,
        /// Negative diagonal entries.
        negative: usize,
    },
    /// Declared and found sign differ.
    #[error(
        "the matrix was declared {declared}, but {against} of its {total} non-zero diagonal entries say the opposite; \
         correct the declaration"
    )]
    Contradicts {
        /// What was declared.
        declared: Sign,
        /// Diagonal entries with the other sign.
        against: usize,
        /// Non-zero diagonal entries.
        total: usize,
    },
}

/// Reads the sign off the diagonal: the sign of at least nine tenths of its non-zero entries.
///
/// A single spoilt row must not turn a matrix round: it is found by the properties instead.
///
/// # Errors
/// A diagonal without such a majority.
pub fn detect_sign(matrix: &Csr) -> Result<Sign, SignError> {
    let (positive, negative) = diagonal_signs(matrix);
    if positive > 0 && positive >= 9 * negative {
        Ok(Sign::PositiveSemidefinite)
    } else if negative > 0 && negative >= 9 * positive {
        Ok(Sign::NegativeSemidefinite)
    } else {
        Err(SignError::Ambiguous { positive, negative })
    }
}

/// Refuses a declared sign that most of the diagonal contradicts.
///
/// # Errors
/// A declaration that at least nine tenths of the non-zero diagonal entries contradict.
pub fn check_declared(matrix: &Csr, declared: Sign) -> Result<(), SignError> {
    match detect_sign(matrix) {
        Ok(found) if found != declared => {
            let (positive, negative) = diagonal_signs(matrix);
            let against = if declared == Sign::PositiveSemidefinite { negative } else { positive };
            Err(SignError::Contradicts { declared, against, total: positive + negative })
        }
        _ => Ok(()),
    }
}

fn diagonal_signs(matrix: &Csr) -> (usize, usize) {
    let diagonal = |keep: fn(f64) -> bool| (0..matrix.rows()).filter(|&i| keep(matrix.at(i, i))).count();
    (diagonal(|d| d > 0.0), diagonal(|d| d < 0.0))
}

/// Converts a matrix to this crate's convention: PSD sign, scale one. `scale` is the factor by which it was multiplied.
pub fn to_ours(matrix: &Csr, sign: Sign, scale: f64) -> Csr {
    let factor = match sign {
        Sign::PositiveSemidefinite => 1.0 / scale,
        Sign::NegativeSemidefinite => -1.0 / scale,
    };
    if factor == 1.0 { matrix.clone() } else { matrix.map(|_, _, v| factor * v) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn diagonal(values: &[f64]) -> Csr {
        Csr::diagonal(values)
    }

    #[test]
    fn one_spoilt_row_in_twenty_does_not_turn_the_sign() {
        let mut d = vec![-2.0; 20];
        d[3] = 5.0;
        assert_eq!(detect_sign(&diagonal(&d)), Ok(Sign::NegativeSemidefinite));
        assert!(matches!(detect_sign(&diagonal(&[1.0, -1.0])), Err(SignError::Ambiguous { .. })));
    }

    #[test]
    fn a_declaration_against_the_diagonal_is_an_error() {
        let found = check_declared(&diagonal(&[1.0, 2.0, 0.0]), Sign::NegativeSemidefinite);
        assert!(matches!(found, Err(SignError::Contradicts { against: 2, total: 2, .. })));
    }
}
