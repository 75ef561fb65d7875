//! Operators that come from elsewhere: read from files, converted once, compared with ours.

mod compare;

use std::path::Path;

pub use compare::{Comparison, Difference, compare, compare_mass};

use crate::exchange::{self, ReadError};
use crate::operator::convention::{Sign, SignError, check_declared, detect_sign, to_ours};
use crate::operator::{Mass, MassKind, Operator, OperatorError, Provenance};

/// What the owner of a matrix says of its sign.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum DeclaredSign {
    /// Read it off the diagonal
    #[default]
    Auto,
    /// Positive semi-definite
    Psd,
    /// Negative semi-definite
    Nsd,
}

/// Why a matrix did not become an operator.
#[derive(Debug, thiserror::Error)]
pub enum ExternalError {
    /// A file could not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The sign is unclear or contradicts the declaration.
    #[error("{file}: {error}")]
    Sign {
        /// The stiffness file.
        file: String,
        /// What is wrong.
        error: SignError,
    },
    /// A scale that cannot be divided by.
    #[error("the scale {0} must be a positive finite number")]
    Scale(f64),
    /// The matrices do not fit together.
    #[error(transparent)]
    Operator(#[from] OperatorError),
}

/// Reads a stiffness matrix and perhaps a mass matrix, settles the sign, converts to this crate's convention and says in the
/// provenance what was found and done.
///
/// A negative mass (some libraries pair `−L` with `−M`) is not converted: MASS finds it.
///
/// # Errors
/// A file that cannot be read, a sign that is unclear or contradicts the declaration, sizes that do not fit.
pub fn read_operator(
    stiffness: &Path,
    mass: Option<&Path>,
    sign: DeclaredSign,
    scale: f64,
) -> Result<Operator, ExternalError> {
    if !(scale.is_finite() && scale > 0.0) {
        return Err(ExternalError::Scale(scale));
    }
    let file = exchange::read_matrix(stiffness)?;
    let mut notes = file.notices.clone();
    let wrap = |error| ExternalError::Sign { file: stiffness.display().to_string(), error };
    let found = match sign {
        DeclaredSign::Auto => detect_sign(&file.matrix).map_err(wrap)?,
        DeclaredSign::Psd => Sign::PositiveSemidefinite,
        DeclaredSign::Nsd => Sign::NegativeSemidefinite,
    };
    check_declared(&file.matrix, found).map_err(wrap)?;
    let how = if sign == DeclaredSign::Auto { "read off the diagonal" } else { "as declared" };
    notes.push(format!("sign: {found} ({how})"));
    if found == Sign::NegativeSemidefinite {
        notes.push("every entry was multiplied by −1, to this program's positive semi-definite sign".into());
    }
    if scale != 1.0 {
        notes.push(format!("every entry was divided by the declared scale {scale}"));
    }
    let provenance = Provenance { id: stiffness.display().to_string(), notes, ..Provenance::default() };
    let operator = Operator::new(to_ours(&file.matrix, found, scale), provenance)?;
    match mass {
        None => Ok(operator),
        Some(path) => {
            let file = exchange::read_matrix(path)?;
            let mass = if file.matrix.columns() == 1 && file.matrix.rows() != 1 {
                let diagonal: Vec<f64> = (0..file.matrix.rows()).map(|i| file.matrix.at(i, 0)).collect();
                Mass::lumped(MassKind::Given, &diagonal)
            } else {
                Mass::full(MassKind::Given, file.matrix)
            };
            let operator = file.notices.into_iter().fold(operator, Operator::with_note);
            Ok(operator.with_mass(mass)?)
        }
    }
}
