//! Mass matrices.

use serde::{Deserialize, Serialize};

use crate::linalg::Csr;

/// Which mass matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MassKind {
    /// Of linear elements: `M_ii = A_i/6`, `M_ij = A_ij/12` with the areas around the vertex and beside the edge.
    Consistent,
    /// A third of the triangle areas around the vertex.
    Barycentric,
    /// Circumcentric area around the vertex, signed: negative parts where a circumcentre lies outside.
    Voronoi,
    /// Circumcentric in acute triangles, ½ and ¼ of the area in obtuse ones (Meyer et al. 2003): positive, total the area.
    Mixed,
    /// The vertex degrees, or another diagonal that belongs to a graph.
    Degree,
    /// One for each vertex.
    Unit,
    /// Read from a file: nothing is known of how it was made.
    Given,
}

impl MassKind {
    /// The name in kebab case, as on the command line.
    pub fn name(self) -> &'static str {
        match self {
            MassKind::Consistent => "consistent",
            MassKind::Barycentric => "barycentric",
            MassKind::Voronoi => "voronoi",
            MassKind::Mixed => "mixed",
            MassKind::Degree => "degree",
            MassKind::Unit => "unit",
            MassKind::Given => "given",
        }
    }

    /// The kind with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        [
            MassKind::Consistent,
            MassKind::Barycentric,
            MassKind::Voronoi,
            MassKind::Mixed,
            MassKind::Degree,
            MassKind::Unit,
            MassKind::Given,
        ]
        .into_iter()
        .find(|k| k.name() == name)
    }
}

/// A mass matrix: diagonal or full.
#[derive(Clone, Debug, PartialEq)]
pub struct Mass {
    kind: MassKind,
    matrix: Csr,
    lumped: bool,
}

impl Mass {
    /// A diagonal mass.
    pub fn lumped(kind: MassKind, diagonal: &[f64]) -> Self {
        Mass { kind, matrix: Csr::diagonal(diagonal), lumped: true }
    }

    /// A diagonal mass that takes the list of its entries over.
    pub fn of_diagonal(kind: MassKind, diagonal: Vec<f64>) -> Self {
        Mass { kind, matrix: Csr::from_diagonal(diagonal), lumped: true }
    }

    /// A mass matrix; it counts as lumped if it has no non-zero entry off the diagonal.
    pub fn full(kind: MassKind, matrix: Csr) -> Self {
        let lumped = matrix.entries().all(|(i, j, v)| i == j || *v == 0.0);
        Mass { kind, matrix, lumped }
    }

    /// Which one.
    pub fn kind(&self) -> MassKind {
        self.kind
    }

    /// Whether it is diagonal.
    pub fn is_lumped(&self) -> bool {
        self.lumped
    }

    /// The matrix.
    pub fn matrix(&self) -> &Csr {
        &self.matrix
    }

    /// The number of rows.
    pub fn size(&self) -> usize {
        self.matrix.rows()
    }

    /// The diagonal.
    pub fn diagonal(&self) -> Vec<f64> {
        (0..self.size()).map(|i| self.matrix.at(i, i)).collect()
    }

    /// The total `1ᵀ M 1`, summed row by row.
    pub fn total(&self) -> f64 {
        (0..self.size()).map(|i| self.matrix.row(i).map(|(_, v)| v).sum::<f64>()).sum()
    }
}
