//! The combinatorial graph Laplacian, on anything that has edges: graphs, surfaces, volumes.
//!
//! # Definition
//! ```text
//! ω_ij = 1 on every edge,   L_ij = −1,   L_ii = degree of i
//! ```
//!
//! # Shapes and units
//! L: n×n, dimensionless, integers. M: the identity.
//!
//! # Convention
//! The crate's. Weights that a graph carries are not looked at; see `weighted-graph`.
//!
//! # Guarantees
//! * FIN, LOC, SYM, NULL, KER, PSD, POS, POS0, POS-boundary: always. On polygon meshes the edges are those of the faces.
//! * MVP, MAX-local: without isolated vertices, whose rows are empty.
//! * MAX-global: on connected domains. *Exception*: a component without a boundary vertex has no Dirichlet problem.
//! * MAX-heat: always.
//! * PERM, RIGID, ISO, REACH, UNION: positions are not looked at.
//!
//! # Does not hold
//! * LIN: a vertex that is not the mean of its neighbours.
//! * ENERGY, FLUX: the unit square with a diagonal has the energy 3 in x, and area 1.
//! * CON: squares cut along one diagonal, even up to the best factor \[wardetzky2007\].
//!
//! # Boundary
//! The row of a boundary vertex is like every other.
//!
//! # Degenerate input
//! Faces of zero area have edges like others. An isolated vertex has an empty row. Non-manifold edges count once.
//!
//! # Cost and accuracy
//! O(E). Exact.
//!
//! # References
//! \[chung1997\] section 1.2 (unnormalised); \[wardetzky2007\] (CON).
//!
//! # Example
//! The path with three vertices.
//! ```
//! use lapjury::domain::{Domain, Graph};
//! let path = Graph::new(3, &[[0, 1], [1, 2]])?;
//! let graph = lapjury::laplacian::find("graph").ok_or("missing")?;
//! let operator = graph.build(&Domain::from(path), &Default::default())?;
//! let l = operator.stiffness();
//! assert_eq!([l.at(0, 0), l.at(1, 1), l.at(0, 1), l.at(0, 2)], [1.0, 2.0, -1.0, 0.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::{BuildError, CONVERGENCE, Fact, Laplacian, Promise, stiffness};
use crate::domain::{Domain, DomainKind};
use crate::operator::{Mass, MassKind, Operator, Provenance};
use crate::parameter::Settings;

/// The catalogue entry.
pub static ENTRY: Laplacian = Laplacian {
    id: "graph",
    name: "graph Laplacian",
    definition: "ω_ij = 1 on every edge",
    sources: &["chung1997", "wardetzky2007"],
    accepts: &[DomainKind::Surface, DomainKind::Graph, DomainKind::Volume],
    parameters: &[],
    promises: &[
        Promise::holds("FIN"),
        Promise::holds("LOC"),
        Promise::holds("SYM"),
        Promise::holds("NULL"),
        Promise::holds("KER"),
        Promise::holds("PSD"),
        Promise::holds("POS"),
        Promise::holds("POS0"),
        Promise::holds("POS-boundary"),
        Promise::holds_given("MVP", &[Fact::NoIsolatedVertex]),
        Promise::holds_given("MAX-local", &[Fact::NoIsolatedVertex]),
        Promise::holds_given("MAX-global", &[Fact::Connected]),
        Promise::holds("MAX-heat"),
        Promise::holds("PERM"),
        Promise::holds("RIGID"),
        Promise::holds("ISO"),
        Promise::holds("REACH"),
        Promise::holds("UNION"),
        Promise::fails_somewhere("LIN"),
        Promise::fails_somewhere("ENERGY"),
        Promise::fails_somewhere("FLUX"),
        Promise::fails_somewhere(CONVERGENCE),
    ],
    build,
};

fn build(domain: &Domain, settings: &Settings) -> Result<Operator, BuildError> {
    let n = domain.vertex_count();
    let weights: Vec<_> = domain.edges().iter().map(|&edge| (edge, [1.0, 1.0])).collect();
    let provenance = Provenance { id: ENTRY.id.into(), parameters: settings.all().clone(), notes: Vec::new() };
    let operator = Operator::new(stiffness::from_weights(n, &weights), provenance)?;
    Ok(operator.with_mass(Mass::lumped(MassKind::Unit, &vec![1.0; n]))?.with_exact_signs())
}
