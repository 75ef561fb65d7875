//! The Wachspress (discrete authalic) Laplacian of a triangle surface: linear-precise and rational, not symmetric.
//!
//! # Definition
//! ```text
//! ω_ij = (cot γ_ij + cot δ_ij) / |e_ij|²,   L_ij = −ω_ij,   L_ii = Σ_j ω_ij
//! ```
//! with γ_ij and δ_ij the angles *at j* on either side of the edge ij. Row i holds the Wachspress coordinates of vertex i in the
//! polygon of its neighbours, up to a factor.
//!
//! # Shapes and units
//! L: n×n, length⁻². M: n×n, length² (`unit`: dimensionless).
//!
//! # Convention
//! Rows of such an operator are defined up to a positive factor; this one is that of \[meyer2002\]. Dividing a row by its
//! diagonal gives the barycentric coordinates. It is the member `p = 0` of `three-point`, with factor 1.
//!
//! # Guarantees
//! * FIN, LOC, NULL, PERM, UNION, REACH: always.
//! * LIN: on manifolds. *Exception*: next to a triangle that was left out, or at an edge with three faces.
//! * POS, POS0, POS-boundary, KER, MVP, MAX-local, MAX-global, MAX-heat: where all angles are acute (MAX-heat for lumped masses).
//!   An interior row is positive if and only if the polygon of neighbours is strictly convex at each of them.
//! * MASS: `barycentric`, `mixed` and `consistent`.
//! * RIGID, ISO: promised where angles are at least 1°.
//!
//! # Does not hold
//! * SYM: the star below. PSD: there, too. Since `L1 = 0` but the column sums `1ᵀL` do not vanish, the vector `1 + εy` has the energy
//!   `ε (1ᵀL)y + O(ε²)`, of either sign: no operator with NULL and without SYM is positive semi-definite unless its columns sum to zero.
//! * POS, POS0, MVP, MAX-local: a star that is not convex.
//! * POS-boundary: the triangle (−2, 0), (2, 0), (0, 1), from a base corner to the top.
//! * MAX-global, MAX-heat: some meshes with stars that are not convex.
//! * ENERGY, FLUX, SCALE: the weights are not dimensionless.
//! * MASS: `voronoi` and `unit`, as for `cotan`.
//! * CON: squares cut along one diagonal, even up to the best factor.
//!
//! # Boundary
//! The row of a boundary vertex is the sum over the triangles present.
//!
//! # Degenerate input
//! As `cotan`: triangles of zero area are refused, or left out with `degenerate=skip`; at an edge with more than two triangles
//! all of them are summed.
//!
//! # Cost and accuracy
//! O(F log valence). The error of a weight is below `8u Σ 1/sin²θ / |e|²` over its two angles; its sign is exact, by the rational
//! comparison of two cotangents.
//!
//! # References
//! \[wachspress1975\]; \[meyer2002\] for this form; \[floater-hormann-kos2006\] for its place among the positive ones.
//!
//! # Example
//! The star with neighbours (±2, 0) and (0, ±1): the angles at (2, 0) have cotangent 2 and the edge length 2, those at (0, 1)
//! have cotangent ½ and the edge length 1. Both weights are 1.
//! ```
//! use lapjury::domain::{Domain, Surface};
//! let points = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [-2.0, 0.0], [0.0, -1.0]];
//! let star = Surface::planar(&points, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])?;
//! let wachspress = lapjury::laplacian::find("wachspress").ok_or("missing")?;
//! let operator = wachspress.build(&Domain::from(star), &Default::default())?;
//! let l = operator.stiffness();
//! assert_eq!([l.at(0, 1), l.at(0, 2), l.at(0, 0)], [-1.0, -1.0, 4.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::cmp::Ordering;

use super::shape::{Flank, Triangles, with_sign};
use super::{BuildError, CONVERGENCE, Fact, Laplacian, Promise, on_triangles, stiffness};
use crate::domain::{Domain, Surface, delaunay};
use crate::linalg::Csr;
use crate::operator::Operator;
use crate::parameter::Settings;
use crate::scalar::Scalar;

/// The catalogue entry.
pub static ENTRY: Laplacian = Laplacian {
    id: "wachspress",
    name: "Wachspress Laplacian",
    definition: "ω_ij = (cot γ_ij + cot δ_ij)/|e_ij|², γ and δ the angles at j beside the edge",
    sources: &["wachspress1975", "meyer2002", "floater-hormann-kos2006"],
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
        Promise::holds_given("POS", &[Fact::Acute]),
        Promise::holds_given("POS0", &[Fact::Acute]),
        Promise::holds_given("POS-boundary", &[Fact::Acute]),
        Promise::holds_given("KER", &[Fact::Acute, Fact::HealthyAngles]),
        Promise::holds_given("MVP", &[Fact::Acute, Fact::NoIsolatedVertex]),
        Promise::holds_given("MAX-local", &[Fact::Acute, Fact::NoIsolatedVertex]),
        Promise::holds_given("MAX-global", &[Fact::Acute, Fact::Connected]),
        Promise::holds_given("MAX-heat", &[Fact::Acute, Fact::NoIsolatedVertex]).when(&[on_triangles::LUMPED]),
        Promise::holds_given("MASS", &[Fact::NonDegenerate, Fact::NoIsolatedVertex])
            .when(&[on_triangles::POSITIVE_AREA]),
        Promise::holds_given("RIGID", &[Fact::HealthyAngles]),
        Promise::holds_given("ISO", &[Fact::HealthyAngles]),
        Promise::fails_somewhere("SYM"),
        Promise::fails_somewhere("PSD"),
        Promise::fails_somewhere("POS"),
        Promise::fails_somewhere("POS0"),
        Promise::fails_somewhere("MVP"),
        Promise::fails_somewhere("MAX-local"),
        Promise::fails_somewhere("POS-boundary"),
        Promise::fails_somewhere("MAX-global"),
        Promise::fails_somewhere("MAX-heat"),
        Promise::fails_somewhere("ENERGY"),
        Promise::fails_somewhere("FLUX"),
        Promise::fails_somewhere("SCALE"),
        Promise::fails_somewhere("MASS"),
        Promise::fails_somewhere(CONVERGENCE),
    ],
    build,
};

fn build(domain: &Domain, settings: &Settings) -> Result<Operator, BuildError> {
    let operator = on_triangles::operator(ENTRY.id, domain, settings, |triangles, edge| {
        let [forth, back] = weights(triangles, edge);
        let [i, j] = triangles.surface().topology().edges()[edge];
        [with_sign(forth, tip_sign(triangles, edge, i, j)), with_sign(back, tip_sign(triangles, edge, j, i))]
    })?;
    Ok(operator.with_exact_signs())
}

/// `[ω_ij, ω_ji]`.
fn weights<S: Scalar>(triangles: &Triangles<S>, edge: usize) -> [S; 2] {
    let cotangents = |end: usize| {
        let at_end = |flank: Flank<S>| flank.shape.cotangents[flank.corners[end]].clone();
        triangles.beside(edge).map(at_end).fold(S::zero(), |sum, cot| sum + cot)
    };
    let length = triangles.beside(edge).next().map(|flank| flank.shape.squared_lengths[flank.corners[2]].clone());
    match length {
        Some(squared) => [cotangents(1) / squared.clone(), cotangents(0) / squared],
        None => [S::zero(), S::zero()],
    }
}

/// The exact sign of `ω_ij`: that of the sum of the cotangents at j beside the edge.
pub(super) fn tip_sign(triangles: &Triangles, edge: usize, i: usize, j: usize) -> Ordering {
    let at = |v: usize| triangles.surface().positions()[v];
    let corners: Vec<_> = triangles.beside(edge).map(|flank| [at(j), at(i), at(flank.opposite)]).collect();
    // `None` is for degenerate triangles, which are not among these.
    delaunay::sign_of_cotangents(&corners).unwrap_or(Ordering::Equal)
}

/// The stiffness matrix of a planar mesh over any scalar, exactly over the rationals; `None` unless all faces are
/// triangles, none is degenerate and the mesh is planar ([`Surface::plane`]).
pub fn stiffness_in_plane<S: Scalar>(surface: &Surface) -> Option<Csr<S>> {
    Some(stiffness_of(&Triangles::<S>::in_plane(surface)?))
}

/// The stiffness matrix of triangles over any scalar.
pub(super) fn stiffness_of<S: Scalar>(triangles: &Triangles<S>) -> Csr<S> {
    let surface = triangles.surface();
    let edges = surface.topology().edges().iter().enumerate();
    let weights: Vec<_> = edges.map(|(e, &ends)| (ends, weights(triangles, e))).collect();
    stiffness::from_weights(surface.positions().len(), &weights)
}
