//! What an operator lives on: a [`Surface`], a [`Graph`], a [`PointCloud`] or a [`Volume`].
//!
//! A domain is validated when it is built. Everything about it — closed, manifold, oriented, planar, Delaunay, genus,
//! degenerate faces, smallest angle — is a computed fact ([`Facts`]), never a declaration.

pub mod cotangent;
pub mod delaunay;
mod digest;
pub mod faces;
mod facts;
pub mod flip;
pub mod geometry;
mod graph;
pub mod incidence;
pub mod intrinsic;
pub mod nearest;
mod points;
mod surface;
pub mod topology;
mod twofold;
mod volume;

pub use faces::Faces;
pub use facts::{Facts, SurfaceFacts};
pub use graph::Graph;
pub use points::PointCloud;
pub use surface::Surface;
pub use volume::Volume;

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

/// A place where an operator can live.
#[derive(Clone, Debug)]
pub enum Domain {
    /// A triangle or polygon mesh in the plane or in space.
    Surface(Surface),
    /// A graph with optional weights.
    Graph(Graph),
    /// Points without connectivity.
    Points(PointCloud),
    /// A tetrahedral mesh.
    Volume(Volume),
}

/// The four kinds of domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DomainKind {
    /// See [`Surface`].
    Surface,
    /// See [`Graph`].
    Graph,
    /// See [`PointCloud`].
    Points,
    /// See [`Volume`].
    Volume,
}

impl std::fmt::Display for DomainKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            DomainKind::Surface => "surface",
            DomainKind::Graph => "graph",
            DomainKind::Points => "points",
            DomainKind::Volume => "volume",
        })
    }
}

/// Why something is not a domain: what is wrong, and at which element.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DomainError {
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex}: coordinate {axis} is {value}; every coordinate must be a finite number")]
    NotFinite {
        /// The vertex.
        vertex: usize,
        /// 0, 1, 2 for x, y, z.
        axis: usize,
        /// The coordinate as text.
        value: String,
    },
    /// A coordinate is so large that squares of differences overflow.
    #[error("vertex {vertex}: coordinate {value:e} is beyond ±1e150, where areas overflow; rescale the domain")]
    TooLarge {
        /// The vertex.
        vertex: usize,
        /// The coordinate.
        value: f64,
    },
    /// An index that names no vertex.
    #[error("{element} {index} names vertex {vertex}, but the domain has {vertices} vertices (0 to {})", vertices.saturating_sub(1))]
    IndexOutOfRange {
        /// "face", "edge" or "tetrahedron".
        element: &'static str,
        /// Which one.
        index: usize,
        /// The index that it names.
        vertex: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// More corners than the connectivity can number.
    #[error(
        "the faces have {corners} corners in all; at most {} can be numbered, split the mesh",
        topology::Topology::MOST_CORNERS
    )]
    TooManyCorners {
        /// How many there are.
        corners: usize,
    },
    /// An element with too few corners.
    #[error("face {face} has {corners} corners; a face needs at least 3")]
    TooFewCorners {
        /// The face.
        face: usize,
        /// How many corners it has.
        corners: usize,
    },
    /// An element that names a vertex twice.
    #[error("{element} {index} names vertex {vertex} twice; remove the element or separate its corners")]
    RepeatedVertex {
        /// "face", "edge" or "tetrahedron".
        element: &'static str,
        /// Which one.
        index: usize,
        /// The vertex named twice.
        vertex: usize,
    },
    /// A list whose length does not fit.
    #[error("{what}: {found} values for {expected} {of}; give one for each")]
    WrongLength {
        /// What the list holds.
        what: &'static str,
        /// How many values came.
        found: usize,
        /// How many were needed.
        expected: usize,
        /// What they belong to.
        of: &'static str,
    },
    /// A graph edge given twice.
    #[error("edge {index} ({a}, {b}) was given before; add up the weights of parallel edges first")]
    DuplicateEdge {
        /// Which edge.
        index: usize,
        /// Its smaller end.
        a: usize,
        /// Its larger end.
        b: usize,
    },
    /// A weight that is not finite.
    #[error("edge {index} has weight {value}; every weight must be a finite number")]
    WeightNotFinite {
        /// Which edge.
        index: usize,
        /// The weight as text.
        value: String,
    },
}

/// The largest magnitude of a coordinate: beyond it the square of an edge's length may overflow.
pub const LARGEST_COORDINATE: f64 = 1e150;

/// Refuses coordinates that are not finite or so large that squares overflow.
fn check_coordinates(positions: &[[f64; 3]]) -> Result<(), DomainError> {
    for (vertex, p) in positions.iter().enumerate() {
        for (axis, &x) in p.iter().enumerate() {
            if !x.is_finite() {
                return Err(DomainError::NotFinite { vertex, axis, value: x.to_string() });
            }
            if x.abs() > LARGEST_COORDINATE {
                return Err(DomainError::TooLarge { vertex, value: x });
            }
        }
    }
    Ok(())
}

/// Refuses an element that names a vertex out of range or twice.
fn check_corners(element: &'static str, index: usize, corners: &[usize], vertices: usize) -> Result<(), DomainError> {
    // A polygon may have as many corners as there are vertices; comparing each with all before it would take hours.
    let long = corners.len() > 32;
    let mut seen = BTreeSet::new();
    for (at, &vertex) in corners.iter().enumerate() {
        if vertex >= vertices {
            return Err(DomainError::IndexOutOfRange { element, index, vertex, vertices });
        }
        let repeated = if long { !seen.insert(vertex) } else { corners[..at].contains(&vertex) };
        if repeated {
            return Err(DomainError::RepeatedVertex { element, index, vertex });
        }
    }
    Ok(())
}

impl Domain {
    /// Which of the four kinds it is.
    pub fn kind(&self) -> DomainKind {
        match self {
            Domain::Surface(_) => DomainKind::Surface,
            Domain::Graph(_) => DomainKind::Graph,
            Domain::Points(_) => DomainKind::Points,
            Domain::Volume(_) => DomainKind::Volume,
        }
    }

    /// The number of vertices.
    pub fn vertex_count(&self) -> usize {
        match self {
            Domain::Surface(s) => s.positions().len(),
            Domain::Graph(g) => g.vertex_count(),
            Domain::Points(p) => p.positions().len(),
            Domain::Volume(v) => v.positions().len(),
        }
    }

    /// The edges, each as `[smaller, larger]`, in lexicographic order. A point cloud has none.
    pub fn edges(&self) -> &[[usize; 2]] {
        match self {
            Domain::Surface(s) => s.topology().edges(),
            Domain::Graph(g) => g.edges(),
            Domain::Points(_) => &[],
            Domain::Volume(v) => v.edges(),
        }
    }

    /// For each vertex, whether it is on the boundary: the ends of boundary edges of a surface, the given boundary set of a
    /// graph, the corners of boundary triangles of a volume, none of a point cloud.
    pub fn boundary(&self) -> &[bool] {
        match self {
            Domain::Surface(s) => s.topology().boundary_vertices(),
            Domain::Graph(g) => g.boundary(),
            Domain::Points(p) => p.boundary(),
            Domain::Volume(v) => v.boundary(),
        }
    }

    /// The vertices that are not on the boundary, ascending.
    pub fn interior(&self) -> Vec<usize> {
        self.boundary().iter().enumerate().filter(|(_, b)| !**b).map(|(i, _)| i).collect()
    }

    /// For each vertex the number of its connected component, numbered by smallest vertex. An isolated vertex is a
    /// component of its own.
    pub fn components(&self) -> Vec<usize> {
        topology::components(self.vertex_count(), self.edges())
    }

    /// The coordinates of the vertices (z = 0 in the plane), where the domain has any.
    pub fn positions(&self) -> Option<&[[f64; 3]]> {
        match self {
            Domain::Surface(s) => Some(s.positions()),
            Domain::Graph(_) => None,
            Domain::Points(p) => Some(p.positions()),
            Domain::Volume(v) => Some(v.positions()),
        }
    }

    /// The surface, if it is one.
    pub fn as_surface(&self) -> Option<&Surface> {
        match self {
            Domain::Surface(s) => Some(s),
            _ => None,
        }
    }

    /// What was repaired or is worth knowing about the input, in words.
    pub fn notices(&self) -> &[String] {
        match self {
            Domain::Surface(s) => s.notices(),
            _ => &[],
        }
    }

    /// Everything computed about the domain. Cost: O(n + F) and an exact predicate for each interior edge.
    pub fn facts(&self) -> Facts {
        Facts::of(self)
    }

    /// A SHA-256 of kind, coordinates (bit for bit) and connectivity, in hexadecimal.
    pub fn digest(&self) -> String {
        digest::digest(self)
    }
}

impl From<Surface> for Domain {
    fn from(s: Surface) -> Self {
        Domain::Surface(s)
    }
}

impl From<Graph> for Domain {
    fn from(g: Graph) -> Self {
        Domain::Graph(g)
    }
}

impl From<PointCloud> for Domain {
    fn from(p: PointCloud) -> Self {
        Domain::Points(p)
    }
}

impl From<Volume> for Domain {
    fn from(v: Volume) -> Self {
        Domain::Volume(v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_repeated_corner_is_found_in_faces_of_every_length() {
        for corners in 3..100 {
            let mut face: Vec<usize> = (0..corners).collect();
            assert_eq!(check_corners("face", 0, &face, corners), Ok(()));
            face[corners - 1] = corners / 2 - 1;
            let expected = DomainError::RepeatedVertex { element: "face", index: 0, vertex: corners / 2 - 1 };
            assert_eq!(check_corners("face", 0, &face, corners), Err(expected));
        }
    }
}
