//! Parts of statements about spectra.

use serde::{Deserialize, Serialize};

/// A triangle mesh in the plane, whole numbers as coordinates.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// The points.
    pub points: Vec<[i64; 2]>,
    /// Counter-clockwise triangles.
    pub faces: Vec<[usize; 3]>,
}

/// What eigenfunctions do at the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Condition {
    /// They vanish: rows and columns of vertices on the boundary are left out.
    Dirichlet,
    /// Nothing: all rows and columns.
    Neumann,
}

/// The mass matrix of an eigenvalue problem `L u = λ M u` on a triangle mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Weighting {
    /// M = I: the eigenvalues are those of L.
    Unit,
    /// A third of the triangle areas around each vertex.
    Barycentric,
    /// Of linear elements: a sixth of each triangle's area for each corner, a twelfth for each pair.
    Consistent,
}

impl std::fmt::Display for Condition {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Condition::Dirichlet => "Dirichlet",
            Condition::Neumann => "Neumann",
        })
    }
}

impl std::fmt::Display for Weighting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Weighting::Unit => "no mass",
            Weighting::Barycentric => "the barycentric mass",
            Weighting::Consistent => "the consistent mass",
        })
    }
}
