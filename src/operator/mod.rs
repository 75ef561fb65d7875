//! The operator on trial: a stiffness matrix `L`, a mass matrix `M`, and where they came from.
//!
//! # Convention
//! `L` is the weakly defined Laplacian with the geometer's sign: positive semi-definite where symmetric, `ω_ij = −L_ij`,
//! `L_ii = Σ_j ω_ij`. The strongly defined operator is `M⁻¹L ≈ −div ∇`. Whatever comes in with another sign or scale is
//! converted once, in [`convention`].

pub mod convention;
pub mod mass;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::linalg::Csr;
pub use mass::{Mass, MassKind};

/// Where an operator came from and what was done to it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// The catalogue id, or the name an exporter gave.
    pub id: String,
    /// The parameters it was built with.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, String>,
    /// What was converted or left out while it was built or read, in words.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// How far the signs of the off-diagonal entries can be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Signs {
    /// Each entry is zero, positive or negative exactly when the entry of the exact operator is: the construction asked an
    /// exact predicate wherever rounding could have decided.
    Exact,
    /// Entries near zero may have the sign of a rounding error.
    Rounded,
}

/// An operator on the functions over the vertices of a domain.
#[derive(Clone, Debug)]
pub struct Operator {
    stiffness: Csr,
    mass: Option<Mass>,
    signs: Signs,
    provenance: Provenance,
}

/// Why matrices do not make an operator.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OperatorError {
    /// The stiffness matrix is not square.
    #[error("the stiffness matrix is {rows}×{columns}; it must be square, one row for each vertex")]
    NotSquare {
        /// Its rows.
        rows: usize,
        /// Its columns.
        columns: usize,
    },
    /// Mass and stiffness differ in size.
    #[error("the mass matrix has {mass} rows, the stiffness matrix {stiffness}; both must have one for each vertex")]
    MassSize {
        /// Rows of the mass.
        mass: usize,
        /// Rows of the stiffness.
        stiffness: usize,
    },
}

impl Operator {
    /// An operator from its stiffness matrix in this crate's sign.
    ///
    /// # Errors
    /// A matrix that is not square.
    pub fn new(stiffness: Csr, provenance: Provenance) -> Result<Self, OperatorError> {
        if stiffness.rows() != stiffness.columns() {
            return Err(OperatorError::NotSquare { rows: stiffness.rows(), columns: stiffness.columns() });
        }
        Ok(Operator { stiffness, mass: None, signs: Signs::Rounded, provenance })
    }

    /// The same operator with a mass matrix.
    ///
    /// # Errors
    /// A mass of another size.
    pub fn with_mass(mut self, mass: Mass) -> Result<Self, OperatorError> {
        if mass.size() != self.stiffness.rows() {
            return Err(OperatorError::MassSize { mass: mass.size(), stiffness: self.stiffness.rows() });
        }
        self.mass = Some(mass);
        Ok(self)
    }

    /// Declares that the signs of the off-diagonal entries are those of the exact operator. For constructions only.
    pub fn with_exact_signs(mut self) -> Self {
        self.signs = Signs::Exact;
        self
    }

    /// Adds a note to the provenance.
    pub fn with_note(mut self, note: impl Into<String>) -> Self {
        self.provenance.notes.push(note.into());
        self
    }

    /// The number of degrees of freedom.
    pub fn size(&self) -> usize {
        self.stiffness.rows()
    }

    /// The stiffness matrix `L`.
    pub fn stiffness(&self) -> &Csr {
        &self.stiffness
    }

    /// The mass matrix `M`, if there is one.
    pub fn mass(&self) -> Option<&Mass> {
        self.mass.as_ref()
    }

    /// How far the signs of the off-diagonal entries can be trusted.
    pub fn signs(&self) -> Signs {
        self.signs
    }

    /// Where the operator came from.
    pub fn provenance(&self) -> &Provenance {
        &self.provenance
    }
}
