//! The normalized graph Laplacian, and the random walk with the same spectrum, on anything that has edges.
//!
//! # Definition
//! With the weighted graph Laplacian `L`, degrees `d_i = Σ_j ω_ij` and `S = diag(d_i^(−1/2))`:
//! ```text
//! form=symmetric:     S L S,   off the diagonal −ω_ij/√(d_i d_j), on it 1;   M = identity
//! form=random-walk:   L with M = diag(d_i), so that the strong form is I − D⁻¹W
//! ```
//!
//! # Shapes and units
//! Both n×n, dimensionless (`random-walk`: in the unit of the weights, which cancels in the strong form).
//!
//! # Convention
//! The crate's sign. Both forms have the same generalized eigenvalues, between 0 and 2 for positive weights.
//!
//! # Guarantees
//! * FIN, LOC, SYM, UNION, PERM, RIGID, ISO: always.
//! * REACH: for `unit` weights. *Exception*: with lengths a row also depends on the degrees of the neighbours, two rings away.
//! * PSD, POS, POS0, POS-boundary, MAX-heat: for positive weights, that is all rules but `given`.
//! * MAX-local: for positive weights, without isolated vertices.
//! * NULL: for `form=random-walk`. KER, MVP, MAX-global: for that form and positive weights (KER where angles are at least
//!   1° or all weights are one).
//!
//! # Does not hold
//! * NULL, KER, MVP: for `form=symmetric` on a graph that is not regular: the kernel is spanned by `√d_i`, which is not constant
//!   on the path with three vertices.
//! * POS, POS0, PSD: for given weights of both signs: 3, 3, −2 on a triangle, where all degrees are positive.
//! * LIN, ENERGY, FLUX, CON: as for `graph`.
//!
//! # Boundary
//! The row of a boundary vertex is like every other.
//!
//! # Degenerate input
//! An isolated vertex has degree zero and `S` is not defined there: its row is empty (Chung's convention), its mass is one in
//! both forms, and the operator notes how many there are. A vertex *with* edges whose degree is not positive is refused.
//!
//! # Cost and accuracy
//! O(E). Off the diagonal a relative error below 4u plus half that of the two degrees; the diagonal of the symmetric form is one
//! exactly. Signs are exact.
//!
//! # References
//! \[chung1997\] section 1.2.
//!
//! # Example
//! The path with three vertices has degrees 1, 2, 1.
//! ```
//! use lapjury::domain::{Domain, Graph};
//! let path = Domain::from(Graph::new(3, &[[0, 1], [1, 2]])?);
//! let normalized = lapjury::laplacian::find("normalized-graph").ok_or("missing")?;
//! let operator = normalized.build(&path, &Default::default())?;
//! let l = operator.stiffness();
//! assert_eq!([l.at(0, 0), l.at(1, 1)], [1.0, 1.0]);
//! assert!((l.at(0, 1) + 0.5f64.sqrt()).abs() < 1e-15);
//! let walk = normalized.build(&path, &[("form".to_string(), "random-walk".to_string())].into())?;
//! assert_eq!(walk.mass().map(|m| m.diagonal()), Some(vec![1.0, 2.0, 1.0]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::weighted_graph::{POSITIVE, edge_weights};
use super::{BuildError, CONVERGENCE, Fact, Laplacian, Promise, When, stiffness};
use crate::domain::{Domain, DomainKind};
use crate::linalg::Csr;
use crate::operator::{Mass, MassKind, Operator, Provenance};
use crate::parameter::{Parameter, Range, Settings};

const WALK: When = When::Is("form", &["random-walk"]);
const UNIT: When = When::Is("weights", &["unit"]);

/// The catalogue entry.
pub static ENTRY: Laplacian = Laplacian {
    id: "normalized-graph",
    name: "normalized graph Laplacian",
    definition: "S L S with S = diag(L_ii^(−1/2)); or L with the mass diag(L_ii), the random walk",
    sources: &["chung1997"],
    accepts: &[DomainKind::Surface, DomainKind::Graph, DomainKind::Volume],
    parameters: &[
        Parameter {
            name: "weights",
            meaning: "the weights of the edges",
            default: "unit",
            range: Range::Choice(&["unit", "given", "inverse-length", "inverse-squared-length"]),
        },
        Parameter {
            name: "form",
            meaning: "S L S with unit mass, or L with the degrees as mass",
            default: "symmetric",
            range: Range::Choice(&["symmetric", "random-walk"]),
        },
    ],
    promises: &[
        Promise::holds("FIN"),
        Promise::holds("LOC"),
        Promise::holds("SYM"),
        Promise::holds("UNION"),
        Promise::holds("PERM"),
        Promise::holds("RIGID"),
        Promise::holds("ISO"),
        Promise::holds("REACH").when(&[UNIT]),
        Promise::holds("PSD").when(&[POSITIVE]),
        Promise::holds("POS").when(&[POSITIVE]),
        Promise::holds("POS0").when(&[POSITIVE]),
        Promise::holds("POS-boundary").when(&[POSITIVE]),
        Promise::holds("MAX-heat").when(&[POSITIVE]),
        Promise::holds_given("MAX-local", &[Fact::NoIsolatedVertex]).when(&[POSITIVE]),
        Promise::holds("NULL").when(&[WALK]),
        Promise::holds("KER").when(&[WALK, UNIT]),
        Promise::holds_given("KER", &[Fact::HealthyAngles]).when(&[WALK, POSITIVE]),
        Promise::holds_given("MVP", &[Fact::NoIsolatedVertex]).when(&[WALK, POSITIVE]),
        Promise::holds_given("MAX-global", &[Fact::Connected]).when(&[WALK, POSITIVE]),
        Promise::fails_somewhere("NULL"),
        Promise::fails_somewhere("KER"),
        Promise::fails_somewhere("MVP"),
        Promise::fails_somewhere("POS"),
        Promise::fails_somewhere("POS0"),
        Promise::fails_somewhere("PSD"),
        Promise::fails_somewhere("LIN"),
        Promise::fails_somewhere("ENERGY"),
        Promise::fails_somewhere("FLUX"),
        Promise::fails_somewhere(CONVERGENCE),
    ],
    build,
};

fn build(domain: &Domain, settings: &Settings) -> Result<Operator, BuildError> {
    let n = domain.vertex_count();
    let weights = edge_weights(ENTRY.id, domain, settings.get("weights"))?;
    let weights: Vec<_> = domain.edges().iter().zip(weights).map(|(&edge, w)| (edge, [w, w])).collect();
    let unscaled = stiffness::finite(ENTRY.id, n, &weights)?;
    let isolated = isolated(domain);
    let degrees = degrees(&unscaled, &isolated)?;
    let walk = settings.get("form") == "random-walk";
    let (matrix, mass) = if walk {
        (unscaled, Mass::lumped(MassKind::Degree, &degrees))
    } else {
        (normalized(&unscaled, &degrees, &isolated), Mass::lumped(MassKind::Unit, &vec![1.0; n]))
    };
    stiffness::check_finite(ENTRY.id, &matrix)?;
    let provenance = Provenance { id: ENTRY.id.into(), parameters: settings.all().clone(), notes: Vec::new() };
    let operator = Operator::new(matrix, provenance)?.with_mass(mass)?.with_exact_signs();
    Ok(match isolated.iter().filter(|i| **i).count() {
        0 => operator,
        count => operator.with_note(format!("{count} isolated vertices have degree zero: empty rows and mass one")),
    })
}

fn isolated(domain: &Domain) -> Vec<bool> {
    let mut isolated = vec![true; domain.vertex_count()];
    domain.edges().iter().flatten().for_each(|&v| isolated[v] = false);
    isolated
}

/// The degrees; one for isolated vertices.
fn degrees(l: &Csr, isolated: &[bool]) -> Result<Vec<f64>, BuildError> {
    let degree = |(vertex, &alone): (usize, &bool)| match (alone, l.at(vertex, vertex)) {
        (true, _) => Ok(1.0),
        (false, degree) if degree > 0.0 => Ok(degree),
        (false, degree) => Err(BuildError::Degree { laplacian: ENTRY.id, vertex, degree }),
    };
    isolated.iter().enumerate().map(degree).collect()
}

fn normalized(l: &Csr, degrees: &[f64], isolated: &[bool]) -> Csr {
    l.map(|i, j, value| match (i == j, isolated[i]) {
        (true, alone) => f64::from(u8::from(!alone)),
        (false, _) if *value == 0.0 => 0.0,
        // Two roots rather than the root of the product, which may over- or underflow.
        (false, _) => {
            // In one order for both entries of an edge, so that they round alike.
            let scaled = value / degrees[i.min(j)].sqrt() / degrees[i.max(j)].sqrt();
            scaled.abs().max(f64::MIN_POSITIVE).copysign(*value)
        }
    })
}
