//! The mean value Laplacian of a triangle surface: linear-precise and positive, not symmetric.
//!
//! # Definition
//! ```text
//! ω_ij = (tan(γ_ij/2) + tan(δ_ij/2)) / |e_ij|,   L_ij = −ω_ij,   L_ii = Σ_j ω_ij
//! ```
//! with γ_ij and δ_ij the angles *at i* on either side of the edge ij.
//!
//! # Shapes and units
//! L: n×n, length⁻¹. M: n×n, length² (`unit`: dimensionless).
//!
//! # Convention
//! Rows of such an operator are defined up to a positive factor; this one is that of \[floater2003\]. It is the member `p = 1` of
//! `three-point`, with factor 1.
//!
//! # Guarantees
//! * FIN, LOC, NULL, PERM, UNION, REACH: always.
//! * LIN: on manifolds. *Exception*: next to a triangle that was left out, or at an edge with three faces.
//! * POS, POS0, POS-boundary: where no triangle was left out: each term is positive.
//! * KER, MVP, MAX-local, MAX-global, MAX-heat: follow from positive weights (MAX-heat for positive lumped masses).
//!   *Exception*: isolated vertices; a component without a boundary vertex has no Dirichlet problem.
//! * MASS: `barycentric`, `mixed` and `consistent`.
//! * RIGID, ISO: promised where angles are at least 1°.
//!
//! # Does not hold
//! * SYM: the star below. PSD: there, too. Since `L1 = 0` but the column sums `1ᵀL` do not vanish, the vector `1 + εy` has the energy
//!   `ε (1ᵀL)y + O(ε²)`, of either sign: no operator with NULL and without SYM is positive semi-definite unless its columns sum to zero.
//! * ENERGY, FLUX, SCALE: the weights are not dimensionless.
//! * MAX-heat: the consistent mass with small time steps.
//! * MASS: `voronoi` and `unit`, as for `cotan`.
//! * CON: squares cut along one diagonal, even up to the best factor \[wardetzky2007\].
//!
//! # Boundary
//! The row of a boundary vertex is the sum over the triangles present.
//!
//! # Degenerate input
//! As `cotan`: triangles of zero area are refused, or left out with `degenerate=skip`; at an edge with more than two triangles
//! all of them are summed.
//!
//! # Cost and accuracy
//! O(F log valence). A term `tan(θ/2)/|e|`, from `1/(cot θ + √(1 + cot²θ))`, has a relative error below `8u/sin θ + 6u`; it is positive,
//! so signs are exact.
//!
//! # References
//! \[floater2003\]; \[floater-hormann-kos2006\] for its place in the family; \[wardetzky2007\] for CON.
//!
//! # Example
//! The star with neighbours (±2, 0) and (0, ±1): all angles at the centre are right, tan 45° = 1, so the weight of an edge is
//! two over its length.
//! ```
//! use lapjury::domain::{Domain, Surface};
//! let points = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [-2.0, 0.0], [0.0, -1.0]];
//! let star = Surface::planar(&points, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])?;
//! let mean_value = lapjury::laplacian::find("mean-value").ok_or("missing")?;
//! let operator = mean_value.build(&Domain::from(star), &Default::default())?;
//! let l = operator.stiffness();
//! assert_eq!([l.at(0, 1), l.at(0, 2), l.at(0, 0)], [-1.0, -2.0, 6.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::shape::{Flank, Triangles};
use super::{BuildError, CONVERGENCE, Fact, Laplacian, Promise, on_triangles};
use crate::domain::Domain;
use crate::operator::Operator;
use crate::parameter::Settings;

/// The catalogue entry.
pub static ENTRY: Laplacian = Laplacian {
    id: "mean-value",
    name: "mean value Laplacian",
    definition: "ω_ij = (tan(γ_ij/2) + tan(δ_ij/2))/|e_ij|, γ and δ the angles at i beside the edge",
    sources: &["floater2003", "floater-hormann-kos2006", "wardetzky2007"],
    accepts: on_triangles::ACCEPTS,
    parameters: &[on_triangles::MASS, on_triangles::DEGENERATE],
    promises: &[
        Promise::holds("FIN"),
        Promise::holds("LOC"),
        Promise::holds("NULL"),
        Promise::holds("PERM"),
        Promise::holds("UNION"),
        Promise::holds("REACH"),
        Promise::holds_given("LIN", &[Fact::Manifold, Fact::NonDegenerate]),
        Promise::holds_given("POS", &[Fact::NonDegenerate]),
        Promise::holds_given("POS0", &[Fact::NonDegenerate]),
        Promise::holds_given("POS-boundary", &[Fact::NonDegenerate]),
        Promise::holds_given("KER", &[Fact::NonDegenerate, Fact::HealthyAngles]),
        Promise::holds_given("MVP", &[Fact::NonDegenerate, Fact::NoIsolatedVertex]),
        Promise::holds_given("MAX-local", &[Fact::NonDegenerate, Fact::NoIsolatedVertex]),
        Promise::holds_given("MAX-global", &[Fact::NonDegenerate, Fact::Connected]),
        Promise::holds_given("MAX-heat", &[Fact::NonDegenerate, Fact::NoIsolatedVertex])
            .when(&[on_triangles::POSITIVE_LUMPED]),
        Promise::holds_given("MASS", &[Fact::NonDegenerate, Fact::NoIsolatedVertex])
            .when(&[on_triangles::POSITIVE_AREA]),
        Promise::holds_given("RIGID", &[Fact::HealthyAngles]),
        Promise::holds_given("ISO", &[Fact::HealthyAngles]),
        Promise::fails_somewhere("SYM"),
        Promise::fails_somewhere("PSD"),
        Promise::fails_somewhere("ENERGY"),
        Promise::fails_somewhere("FLUX"),
        Promise::fails_somewhere("SCALE"),
        Promise::fails_somewhere("MAX-heat"),
        Promise::fails_somewhere("MASS"),
        Promise::fails_somewhere(CONVERGENCE),
    ],
    build,
};

fn build(domain: &Domain, settings: &Settings) -> Result<Operator, BuildError> {
    let operator = on_triangles::operator(ENTRY.id, domain, settings, |triangles, edge| {
        [weight(triangles, edge, 0), weight(triangles, edge, 1)]
    })?;
    Ok(operator.with_exact_signs())
}

/// The weight of the row of the edge's end `from` (0 or 1).
fn weight(triangles: &Triangles, edge: usize, from: usize) -> f64 {
    triangles.beside(edge).map(|flank| term(&flank, from)).sum()
}

/// `tan(θ/2) / |e|`, positive even where the quotient underflows.
fn term(flank: &Flank<f64>, from: usize) -> f64 {
    let [_, _, apex] = flank.corners;
    let length = flank.shape.squared_lengths[apex].sqrt();
    (tan_half(flank.shape.cotangents[flank.corners[from]]) / length).max(f64::MIN_POSITIVE)
}

/// `tan(θ/2) = 1/(cot θ + √(1 + cot²θ)) = √(1 + cot²θ) − cot θ`, whichever does not cancel.
pub(super) fn tan_half(cotangent: f64) -> f64 {
    let cosecant = cotangent.hypot(1.0);
    if cotangent > 0.0 { 1.0 / (cotangent + cosecant) } else { cosecant - cotangent }
}
