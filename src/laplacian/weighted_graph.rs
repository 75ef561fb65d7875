//! The weighted graph Laplacian, on graphs with given weights and on anything whose edges have a length.
//!
//! # Definition
//! ```text
//! L_ij = −ω_ij,   L_ii = Σ_j ω_ij,   ω_ij given, or 1/|e_ij|, or 1/|e_ij|²
//! ```
//!
//! # Shapes and units
//! L: n×n, in units of the weights: as given, length⁻¹ or length⁻². M: the identity.
//!
//! # Convention
//! The crate's. With `weights=unit` it is `graph`.
//!
//! # Guarantees
//! * FIN, LOC, SYM, NULL, PERM, RIGID, ISO, REACH, UNION: whatever the weights.
//! * PSD, POS, POS0, POS-boundary, MAX-heat: for `unit`, `inverse-length` and `inverse-squared-length`, which are positive.
//! * KER: for those, where angles are at least 1°, so that no eigenvalue drowns in rounding.
//! * MVP, MAX-local, MAX-global: for those. *Exception*: isolated vertices have empty rows; a component without a boundary
//!   vertex has no Dirichlet problem.
//!
//! # Does not hold
//! * PSD, POS, POS0, KER, MVP, MAX-local, MAX-global, MAX-heat: for given weights of both signs: the single edge of weight −1 is negative,
//!   and weights 1, 1, −½ on a triangle have a kernel beyond the constants.
//! * LIN, ENERGY, FLUX, SCALE: lengths alone know nothing of angles.
//! * CON: for those rules, squares cut along one diagonal, even up to the best factor.
//!
//! # Boundary
//! The row of a boundary vertex is like every other.
//!
//! # Degenerate input
//! An edge of length zero is refused (its weight is infinite). An isolated vertex has an empty row. A domain without given
//! weights, or without positions, is refused where the weights need them.
//!
//! # Cost and accuracy
//! O(E). A weight from a length has a relative error below 8u; signs are exact.
//!
//! # References
//! \[chung1997\] section 1.4 (weighted graphs).
//!
//! # Example
//! A path whose second edge is a spring pushing apart.
//! ```
//! use lapjury::domain::{Domain, Graph};
//! let path = Graph::weighted(3, &[[0, 1], [1, 2]], &[2.0, -0.5])?;
//! let weighted = lapjury::laplacian::find("weighted-graph").ok_or("missing")?;
//! let operator = weighted.build(&Domain::from(path), &Default::default())?;
//! let l = operator.stiffness();
//! assert_eq!([l.at(0, 1), l.at(1, 2), l.at(1, 1)], [-2.0, 0.5, 1.5]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::{BuildError, CONVERGENCE, Fact, Laplacian, Promise, When, stiffness};
use crate::domain::geometry::Vec3;
use crate::domain::{Domain, DomainKind};
use crate::operator::{Mass, MassKind, Operator, Provenance};
use crate::parameter::{Parameter, Range, Settings};

/// Where the weights are positive.
pub(super) const POSITIVE: When = When::Is("weights", &["unit", "inverse-length", "inverse-squared-length"]);

/// The catalogue entry.
pub static ENTRY: Laplacian = Laplacian {
    id: "weighted-graph",
    name: "weighted graph Laplacian",
    definition: "ω_ij given, or 1/|e_ij|, or 1/|e_ij|²",
    sources: &["chung1997"],
    accepts: &[DomainKind::Surface, DomainKind::Graph, DomainKind::Volume],
    parameters: &[Parameter {
        name: "weights",
        meaning: "the weights of the edges",
        default: "given",
        range: Range::Choice(&["given", "unit", "inverse-length", "inverse-squared-length"]),
    }],
    promises: &[
        Promise::holds("FIN"),
        Promise::holds("LOC"),
        Promise::holds("SYM"),
        Promise::holds("NULL"),
        Promise::holds("PERM"),
        Promise::holds("RIGID"),
        Promise::holds("ISO"),
        Promise::holds("REACH"),
        Promise::holds("UNION"),
        Promise::holds("PSD").when(&[POSITIVE]),
        Promise::holds("POS").when(&[POSITIVE]),
        Promise::holds("POS0").when(&[POSITIVE]),
        Promise::holds("POS-boundary").when(&[POSITIVE]),
        Promise::holds("MAX-heat").when(&[POSITIVE]),
        Promise::holds_given("KER", &[Fact::HealthyAngles]).when(&[POSITIVE]),
        Promise::holds_given("MVP", &[Fact::NoIsolatedVertex]).when(&[POSITIVE]),
        Promise::holds_given("MAX-local", &[Fact::NoIsolatedVertex]).when(&[POSITIVE]),
        Promise::holds_given("MAX-global", &[Fact::Connected]).when(&[POSITIVE]),
        Promise::fails_somewhere("PSD"),
        Promise::fails_somewhere("POS"),
        Promise::fails_somewhere("POS0"),
        Promise::fails_somewhere("KER"),
        Promise::fails_somewhere("MVP"),
        Promise::fails_somewhere("MAX-local"),
        Promise::fails_somewhere("MAX-global"),
        Promise::fails_somewhere("MAX-heat"),
        Promise::fails_somewhere("LIN"),
        Promise::fails_somewhere("ENERGY"),
        Promise::fails_somewhere("FLUX"),
        Promise::fails_somewhere("SCALE"),
        Promise::fails_somewhere(CONVERGENCE).when(&[POSITIVE]),
    ],
    build,
};

fn build(domain: &Domain, settings: &Settings) -> Result<Operator, BuildError> {
    let weights = edge_weights(ENTRY.id, domain, settings.get("weights"))?;
    let weights: Vec<_> = domain.edges().iter().zip(weights).map(|(&edge, w)| (edge, [w, w])).collect();
    let n = domain.vertex_count();
    let matrix = stiffness::finite(ENTRY.id, n, &weights)?;
    let provenance = Provenance { id: ENTRY.id.into(), parameters: settings.all().clone(), notes: Vec::new() };
    let operator = Operator::new(matrix, provenance)?;
    Ok(operator.with_mass(Mass::lumped(MassKind::Unit, &vec![1.0; n]))?.with_exact_signs())
}

/// The weights of the edges of a domain by the name of their rule.
///
/// # Errors
/// Given weights where there are none; lengths where there are no positions, or where one is zero.
pub(super) fn edge_weights(laplacian: &'static str, domain: &Domain, rule: &str) -> Result<Vec<f64>, BuildError> {
    match rule {
        "given" => match domain {
            Domain::Graph(graph) if graph.weights().is_some() => Ok(graph.weights().unwrap_or(&[]).to_vec()),
            _ => Err(BuildError::Missing {
                laplacian,
                what: "weights given with the edges",
                remedy: "use a weighted graph, or choose weights=unit, inverse-length or inverse-squared-length",
            }),
        },
        "unit" => Ok(vec![1.0; domain.edges().len()]),
        rule => {
            let positions = domain.positions().ok_or(BuildError::Missing {
                laplacian,
                what: "positions, for the lengths of edges",
                remedy: "use a mesh, or choose weights=given or weights=unit",
            })?;
            let point = |[i, j]: &&[usize; 2]| positions[*i] == positions[*j];
            if let Some(&[a, b]) = domain.edges().iter().find(point) {
                let count = domain.edges().iter().filter(point).count();
                return Err(BuildError::ZeroLength { laplacian, a, b, count });
            }
            let power = if rule == "inverse-length" { 1 } else { 2 };
            Ok(domain.edges().iter().map(|edge| inverse_length(positions, edge).powi(power)).collect())
        }
    }
}

/// `1/|e|`, without under- or overflow on the way.
fn inverse_length(positions: &[[f64; 3]], &[i, j]: &[usize; 2]) -> f64 {
    let edge = Vec3::from(positions[j]) - Vec3::from(positions[i]);
    let largest = edge.amax();
    if largest == 0.0 { f64::INFINITY } else { 1.0 / (edge / largest).norm() / largest }
}
