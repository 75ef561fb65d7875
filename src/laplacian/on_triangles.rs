//! What all constructions on triangle surfaces have in common: their parameters, and the way from edge weights to operator.

use super::shape::Triangles;
use super::{BuildError, When, mass, stiffness};
use crate::domain::{Domain, DomainKind, Surface};
use crate::linalg::parallel;
use crate::operator::{Operator, Provenance};
use crate::parameter::{Parameter, Range, Settings};

/// The kinds of domain accepted.
pub(super) const ACCEPTS: &[DomainKind] = &[DomainKind::Surface];

/// The parameter `mass`.
pub(super) const MASS: Parameter =
    Parameter { name: "mass", meaning: "the mass matrix", default: "barycentric", range: Range::Choice(mass::KINDS) };

/// The parameter `degenerate`.
pub(super) const DEGENERATE: Parameter = Parameter {
    name: "degenerate",
    meaning: "what to do with triangles of zero area: refuse the mesh, or skip them and say so",
    default: "refuse",
    range: Range::Choice(&["refuse", "skip"]),
};

/// Masses that are diagonal, and positive wherever the weights of a surface are.
pub(super) const LUMPED: When = When::Is("mass", &["barycentric", "voronoi", "mixed", "unit"]);

/// Masses that are diagonal and positive on every surface.
pub(super) const POSITIVE_LUMPED: When = When::Is("mass", &["barycentric", "mixed", "unit"]);

/// Masses that are positive definite on every surface and add up to its area.
pub(super) const POSITIVE_AREA: When = When::Is("mass", &["barycentric", "mixed", "consistent"]);

/// Masses that integrate smooth functions in the limit of fine meshes.
pub(super) const REFINABLE: When = When::Is("mass", &["barycentric", "voronoi", "mixed", "consistent"]);

/// The surface of a domain.
pub(super) fn surface<'a>(laplacian: &'static str, domain: &'a Domain) -> Result<&'a Surface, BuildError> {
    domain.as_surface().ok_or(BuildError::WrongKind { laplacian, kind: domain.kind(), accepts: ACCEPTS })
}

/// The operator with the weights `[ω_ij, ω_ji]` that a formula gives for each edge, the natural sum over the triangles
/// present at the edge: two inside, one on the boundary, more where the surface is not a manifold.
pub(super) fn operator(
    laplacian: &'static str,
    domain: &Domain,
    settings: &Settings,
    weights: impl Fn(&Triangles, usize) -> [f64; 2] + Sync + Send,
) -> Result<Operator, BuildError> {
    assembled(laplacian, domain, settings, weights, |both, upward| if upward { both[0] } else { both[1] })
}

/// The same where `ω_ij = ω_ji`.
pub(super) fn symmetric_operator(
    laplacian: &'static str,
    domain: &Domain,
    settings: &Settings,
    weight: impl Fn(&Triangles, usize) -> f64 + Sync + Send,
) -> Result<Operator, BuildError> {
    assembled(laplacian, domain, settings, weight, |weight, _| *weight)
}

/// The operator with what a formula gives for each edge; `weight` reads the one of the row of the smaller end (`true`) or of the
/// larger one out of that.
fn assembled<W: Send + Sync>(
    laplacian: &'static str,
    domain: &Domain,
    settings: &Settings,
    formula: impl Fn(&Triangles, usize) -> W + Sync + Send,
    weight: impl Fn(&W, bool) -> f64 + Sync,
) -> Result<Operator, BuildError> {
    let surface = surface(laplacian, domain)?;
    let skip = settings.get("degenerate") == "skip";
    let triangles = Triangles::new(laplacian, surface, skip)?.with_lengths(laplacian)?;
    let (edges, incidence) = (surface.topology().edges(), surface.topology().incidence());
    let mass = mass::of_surface(laplacian, settings.get("mass"), &triangles)?;
    let weights: Vec<W> = parallel::collect(edges.len(), |e| formula(&triangles, e));
    let notes = notes(&triangles);
    drop(triangles);
    let matrix = stiffness::of_edges(laplacian, edges, incidence, |e, upward| weight(&weights[e], upward))?;
    let provenance = Provenance { id: laplacian.into(), parameters: settings.all().clone(), notes };
    Ok(Operator::new(matrix, provenance)?.with_mass(mass)?)
}

/// What a reader should know of the mesh: triangles left out, edges with more than two.
pub(super) fn notes(triangles: &Triangles) -> Vec<String> {
    let mut notes = Vec::new();
    if triangles.skipped() > 0 {
        notes.push(format!("{} triangles of zero area were left out", triangles.skipped()));
    }
    let topology = triangles.surface().topology();
    let sheets = topology.non_manifold_edges();
    if let Some(&first) = sheets.first() {
        let ([a, b], faces) = (topology.edges()[first], topology.sides(first).len());
        notes.push(format!(
            "{} edges have more than two faces, the first is ({a}, {b}) with {faces} faces; their weights are sums over all of them",
            sheets.len()
        ));
    }
    notes
}
