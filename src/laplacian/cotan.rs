//! The cotangent Laplacian: linear finite elements on a triangle surface.
//!
//! # Definition
//! ```text
//! ω_ij = ½ (cot α_ij + cot β_ij),   L_ij = −ω_ij,   L_ii = Σ_j ω_ij
//! ```
//! with α_ij and β_ij the angles opposite the edge ij. It is the stiffness matrix `∫ ∇φ_i · ∇φ_j` of the hat functions, and
//! the orthogonal dual Laplacian of the circumcentres.
//!
//! # Shapes and units
//! L: n×n, dimensionless. M: n×n, length² (`unit`: dimensionless).
//!
//! # Convention
//! The crate's: positive semi-definite, factor ½. The factors to other libraries are listed in
//! [`operator::convention`](crate::operator::convention).
//!
//! # Guarantees
//! * FIN, LOC, SYM, NULL, PSD, ENERGY, ACC, PERM, UNION, REACH: always, non-manifold meshes included.
//! * KER: of the exact operator always; promised where angles are at least 1°, so that no eigenvalue drowns in rounding.
//! * LIN, FLUX: on manifolds. *Exception*: around a triangle that was left out, and at an edge with three faces, the star is
//!   not a cycle and the fluxes do not cancel.
//! * POS: where every interior edge is strictly Delaunay, or all angles are acute. POS0, MVP, MAX-local, MAX-global: where
//!   every interior edge is Delaunay. *Exception*: an isolated vertex has an empty row; a component without a boundary
//!   vertex has no Dirichlet problem.
//! * POS-boundary: where all angles are acute: a boundary weight is a single cotangent.
//! * MAX-heat: for lumped masses, on closed Delaunay surfaces and where all angles are acute.
//! * MASS: `barycentric`, `mixed` and `consistent`.
//! * RIGID, ISO, SCALE: `unit` mass does not scale. Promised where angles are at least 1°: coordinates are rounded by the
//!   motion, and a cotangent magnifies that by 1/sin².
//! * CON: for every mass but `unit`, where the angles stay below a bound less than 180° and the metric converges.
//!
//! # Does not hold
//! * POS, POS0: the vertices (±2, 0), (0, ±1) with the edge along the long diagonal, whose weight is −¾. MVP, MAX-local: any mesh
//!   with such an edge at an interior vertex; other weights of its row are positive, since `L_ii > 0`.
//! * POS-boundary: the triangle (−2, 0), (2, 0), (0, 1): −⅜ on the long side.
//! * MAX-global, MAX-heat: some meshes that are not Delaunay; MAX-heat also for the consistent mass with small time steps.
//! * MASS: `voronoi` is negative at the acute corners of a flat triangle; `unit` does not know the area.
//!
//! # Boundary
//! Natural: the row of a boundary vertex is the sum over the triangles present.
//!
//! # Degenerate input
//! Triangles of zero area (decided exactly) are refused, or left out and counted with `degenerate=skip`. At an edge with more
//! than two triangles all of them are summed, and the operator notes it. An isolated vertex has an empty row and mass zero.
//!
//! # Cost and accuracy
//! O(F log valence). A weight is within 4 units in the last place of the exact one, whatever the angles and however much of the sum
//! cancels ([`domain::cotangent`](crate::domain::cotangent)). So its sign is exact, and a true zero is stored as zero.
//!
//! # References
//! \[macneal1949\], \[duffin1959\] (plane), \[dziuk1988\] (surfaces, convergence), \[pinkall-polthier1993\];
//! \[meyer2003\] for the mass `mixed`; \[wardetzky2007\] for the properties, CON among them.
//!
//! # Example
//! The star with neighbours (±2, 0) and (0, ±1): opposite the edge to (2, 0) both angles have cotangent ½, opposite the edge
//! to (0, 1) both have cotangent 2.
//! ```
//! use lapjury::domain::{Domain, Surface};
//! let points = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [-2.0, 0.0], [0.0, -1.0]];
//! let star = Surface::planar(&points, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])?;
//! let cotan = lapjury::laplacian::find("cotan").ok_or("missing")?;
//! let operator = cotan.build(&Domain::from(star), &Default::default())?;
//! let l = operator.stiffness();
//! assert_eq!([l.at(0, 1), l.at(0, 2), l.at(0, 0)], [-0.5, -2.0, 5.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::cmp::Ordering;

use super::shape::{Flank, Triangles};
use super::{BuildError, CONVERGENCE, Fact, Laplacian, Promise, When, on_triangles, stiffness};
use crate::domain::{Domain, Surface, cotangent, delaunay};
use crate::linalg::Csr;
use crate::operator::Operator;
use crate::parameter::Settings;
use crate::scalar::Scalar;

/// The catalogue entry.
pub static ENTRY: Laplacian = Laplacian {
    id: "cotan",
    name: "cotangent Laplacian",
    definition: "ω_ij = ½ (cot α_ij + cot β_ij), α and β opposite the edge; one term on the boundary",
    sources: &["macneal1949", "duffin1959", "dziuk1988", "pinkall-polthier1993", "wardetzky2007", "meyer2003"],
    accepts: on_triangles::ACCEPTS,
    parameters: &[on_triangles::MASS, on_triangles::DEGENERATE],
    promises: &[
        Promise::holds("FIN"),
        Promise::holds("LOC"),
        Promise::holds("SYM"),
        Promise::holds("NULL"),
        Promise::holds("PSD"),
        Promise::holds("ENERGY"),
        Promise::holds("ACC"),
        Promise::holds("PERM"),
        Promise::holds("UNION"),
        Promise::holds("REACH"),
        Promise::holds_given("KER", &[Fact::HealthyAngles, Fact::NonDegenerate]),
        Promise::holds_given("LIN", &[Fact::Manifold, Fact::NonDegenerate]),
        Promise::holds_given("FLUX", &[Fact::Manifold, Fact::NonDegenerate]),
        Promise::holds_given("POS", &[Fact::StrictlyDelaunay, Fact::Manifold]),
        Promise::holds_given("POS", &[Fact::Acute]),
        Promise::holds_given("POS0", &[Fact::Delaunay, Fact::Manifold]),
        Promise::holds_given("POS0", &[Fact::Acute]),
        Promise::holds_given("POS-boundary", &[Fact::Acute]),
        Promise::holds_given("MVP", &[Fact::Delaunay, Fact::Manifold, Fact::NonDegenerate, Fact::NoIsolatedVertex]),
        Promise::holds_given(
            "MAX-local",
            &[Fact::Delaunay, Fact::Manifold, Fact::NonDegenerate, Fact::NoIsolatedVertex],
        ),
        Promise::holds_given("MAX-global", &[Fact::Delaunay, Fact::Manifold, Fact::NonDegenerate, Fact::Connected]),
        Promise::holds_given(
            "MAX-heat",
            &[Fact::Delaunay, Fact::Manifold, Fact::Closed, Fact::NonDegenerate, Fact::NoIsolatedVertex],
        )
        .when(&[on_triangles::LUMPED]),
        Promise::holds_given("MAX-heat", &[Fact::Acute, Fact::NoIsolatedVertex]).when(&[on_triangles::LUMPED]),
        Promise::holds_given("MASS", &[Fact::NonDegenerate, Fact::NoIsolatedVertex])
            .when(&[on_triangles::POSITIVE_AREA]),
        Promise::holds_given("RIGID", &[Fact::HealthyAngles]),
        Promise::holds_given("ISO", &[Fact::HealthyAngles]),
        Promise::holds_given("SCALE", &[Fact::HealthyAngles])
            .when(&[When::Is("mass", &["barycentric", "voronoi", "mixed", "consistent"])]),
        Promise::holds(CONVERGENCE).when(&[on_triangles::REFINABLE]),
        Promise::fails_somewhere("POS"),
        Promise::fails_somewhere("POS0"),
        Promise::fails_somewhere("POS-boundary"),
        Promise::fails_somewhere("MVP"),
        Promise::fails_somewhere("MAX-local"),
        Promise::fails_somewhere("MAX-global"),
        Promise::fails_somewhere("MAX-heat"),
        Promise::fails_somewhere("MASS"),
    ],
    build,
};

fn build(domain: &Domain, settings: &Settings) -> Result<Operator, BuildError> {
    let operator = on_triangles::symmetric_operator(ENTRY.id, domain, settings, weight)?;
    Ok(operator.with_exact_signs())
}

/// `½ Σ cot` over the angles opposite an edge, with a relative error below one: its sign is exact.
pub(super) fn weight(triangles: &Triangles, edge: usize) -> f64 {
    let (mut cotangents, mut count) = ([0.0; 2], 0);
    for &cotangent in triangles.cotangents_opposite(edge) {
        if count < 2 {
            cotangents[count] = cotangent;
        }
        count += 1;
    }
    let surface = triangles.surface();
    let [i, j] = surface.topology().edges()[edge].map(|v| surface.point(v));
    let corner = |flank: Flank<f64>| [surface.point(flank.opposite), i, j];
    if count > 2 {
        return cotangent::precise_half_sum(triangles.beside(edge).map(corner)).high;
    }
    cotangent::half_sum(&cotangents[..count], || triangles.beside(edge).map(corner))
}

/// `½ Σ cot` over any scalar.
fn weight_over<S: Scalar>(triangles: &Triangles<S>, edge: usize) -> S {
    triangles.cotangents_opposite(edge).fold(S::zero(), |sum, cotangent| sum + S::half() * cotangent.clone())
}

/// The exact sign of the weight.
pub(super) fn sign(triangles: &Triangles, edge: usize) -> Ordering {
    if let Some(sign) = delaunay::clear_sign(triangles.cotangents_opposite(edge).copied()) {
        return sign;
    }
    let surface = triangles.surface();
    let [i, j] = surface.topology().edges()[edge].map(|v| surface.positions()[v]);
    let apexes: Vec<_> = triangles.beside(edge).map(|flank| surface.positions()[flank.opposite]).collect();
    // `None` is for degenerate triangles, which are not among these.
    delaunay::cotangent_sum_sign(i, j, &apexes).unwrap_or(Ordering::Equal)
}

/// The stiffness matrix of a planar mesh over any scalar, exactly over the rationals; `None` unless all faces are
/// triangles, none is degenerate and the mesh is planar ([`Surface::plane`]).
pub fn stiffness_in_plane<S: Scalar>(surface: &Surface) -> Option<Csr<S>> {
    Some(stiffness_of(&Triangles::<S>::in_plane(surface)?))
}

/// The stiffness matrix of triangles over any scalar.
pub(super) fn stiffness_of<S: Scalar>(triangles: &Triangles<S>) -> Csr<S> {
    let surface = triangles.surface();
    let both = |(e, &ends): (usize, &[usize; 2])| {
        let weight = weight_over(triangles, e);
        (ends, [weight.clone(), weight])
    };
    let weights: Vec<_> = surface.topology().edges().iter().enumerate().map(both).collect();
    stiffness::from_weights(surface.positions().len(), &weights)
}
