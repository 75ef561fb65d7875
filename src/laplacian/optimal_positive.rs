//! Positive weights by linear programming: on a planar triangulation the symmetric, linearly precise weights whose smallest
//! is largest; a refusal with a certificate where no positive ones exist.
//!
//! # Definition
//! ```text
//! largest t with   ω_ij ≥ t,   Σ_j ω_ij (x_i − x_j) = 0 at interior vertices i,   Σ ω_ij |ij|² = 2 · area
//! ```
//! over all edges; then `L_ij = −ω_ij`, `L_ii = Σ_j ω_ij`. The last equation fixes the scale as `cotan` has it: the energies
//! of the two coordinates add up to twice the area. An edge between two boundary vertices is in no equation but the last.
//!
//! # Shapes and units
//! L: n×n, dimensionless. M: n×n, length² (`unit`: dimensionless).
//!
//! # Convention
//! The crate's. The smallest weight is determined; where several weights attain it, these are the ones near the middle of
//! their set at which the solver's path ends.
//!
//! # Guarantees
//! * FIN, LOC, SYM, NULL, LIN, PSD: wherever it is built.
//! * POS, POS0, POS-boundary: wherever it is built.
//! * MVP, MAX-local, MAX-global: wherever it is built, on connected meshes. *Exception*: an isolated vertex.
//! * MASS: `barycentric`, `mixed` and `consistent`.
//!
//! # Does not hold
//! * ENERGY, FLUX: the equations do not ask for them one by one.
//! * REACH: a vertex that moves changes weights everywhere.
//! * MASS: `voronoi` and `unit`, as of `cotan`.
//!
//! # Boundary
//! The rows of boundary vertices have the weights of the edges there, without an equation of their own.
//!
//! # Degenerate input
//! A mesh that is not planar, not made of triangles, not a manifold along its edges, or has a degenerate triangle is refused. So is a
//! mesh without positive weights, with the certificate: a motion that shortens no edge with an interior end
//! ([`equilibrium`](super::equilibrium)), verified exactly.
//!
//! # Cost and accuracy
//! A linear program: some twenty sparse factorisations, milliseconds for a hundred edges. The smallest weight is within 1e-9 of the
//! optimum; the equations hold to rounding, since the weights are projected onto them last. That positive weights exist is
//! decided exactly, by a lift or, on up to twelve interior vertices, by the exact simplex method; where angles are so small that
//! rounding decides nothing on a larger mesh, the mesh is refused for that.
//!
//! # References
//! \[wardetzky2007\] (that none need exist, and when they do).
//!
//! # Example
//! The star with neighbours (±2, 0), (0, ±1), area 4: weights a towards (±2, 0) and b towards (0, ±1), c on the four sides of squared
//! length 5: `8a + 2b + 20c = 8`, so that all are 8/30.
//! ```
//! use lapjury::domain::{Domain, Surface};
//! let points = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [-2.0, 0.0], [0.0, -1.0]];
//! let star = Surface::planar(&points, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])?;
//! let optimal = lapjury::laplacian::find("optimal-positive").ok_or("missing")?;
//! let operator = optimal.build(&Domain::from(star), &Default::default())?;
//! for (i, j) in [(0, 1), (0, 2), (1, 2)] {
//!     assert!((operator.stiffness().at(i, j) + 4.0 / 15.0).abs() < 1e-7);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::equilibrium::{self, Certificate, Lift, Net, decide_quickly};
use super::shape::Triangles;
use super::{BuildError, Fact, Laplacian, Promise, mass, on_triangles, stiffness};
use crate::domain::{Domain, Surface};
use crate::linalg::{Csr, program};
use crate::operator::{Operator, Provenance};
use crate::parameter::Settings;

/// The catalogue entry.
pub static ENTRY: Laplacian = Laplacian {
    id: "optimal-positive",
    name: "positive weights by linear programming",
    definition: "the weights in equilibrium at interior vertices whose smallest is largest, with Σ ω_ij |ij|² = 2 area",
    sources: &["wardetzky2007"],
    accepts: on_triangles::ACCEPTS,
    parameters: &[on_triangles::MASS],
    promises: &[
        Promise::holds("FIN"),
        Promise::holds("LOC"),
        Promise::holds("SYM"),
        Promise::holds("NULL"),
        Promise::holds("LIN"),
        Promise::holds("PSD"),
        Promise::holds("POS"),
        Promise::holds("POS0"),
        Promise::holds("POS-boundary"),
        Promise::holds_given("MVP", &[Fact::NoIsolatedVertex]),
        Promise::holds_given("MAX-local", &[Fact::NoIsolatedVertex]),
        Promise::holds_given("MAX-global", &[Fact::Connected]),
        Promise::holds_given("MASS", &[Fact::NoIsolatedVertex]).when(&[on_triangles::POSITIVE_AREA]),
        Promise::fails_somewhere("ENERGY"),
        Promise::fails_somewhere("FLUX"),
        Promise::fails_somewhere("REACH"),
        Promise::fails_somewhere("MASS"),
    ],
    build,
};

fn build(domain: &Domain, settings: &Settings) -> Result<Operator, BuildError> {
    let laplacian = ENTRY.id;
    let surface = on_triangles::surface(laplacian, domain)?;
    let elsewhere = BuildError::Missing {
        laplacian,
        what: "a triangulation that lies unfolded in a coordinate plane, with at most two triangles at an edge",
        remedy: "use intrinsic-delaunay on a surface in space",
    };
    if surface.plane().is_none() {
        return Err(elsewhere);
    }
    let triangles = Triangles::new(laplacian, surface, false)?.with_lengths(laplacian)?;
    let (Some(net), Some(lift)) = (Net::of(surface), Lift::of(surface)) else { return Err(elsewhere) };
    let proposed = Program::of(surface, &net).optimum();
    let proposed = match proposed {
        Some(weights) if proves(&net, &lift, surface, &weights) => weights,
        other => match decide_quickly(surface) {
            Some(certificate @ Certificate::Motion(_)) => {
                return Err(BuildError::NoPositiveWeights { laplacian, certificate: Box::new(certificate) });
            }
            shown => shown.and(other).ok_or(BuildError::Missing {
                laplacian,
                what: "a linear program that floating point can solve, and the angles of this mesh are too small for it",
                remedy: "remove the smallest angles",
            })?,
        },
    };
    let edges = surface.topology().edges();
    let weights: Vec<_> = edges.iter().zip(&proposed).map(|(&ends, &w)| (ends, [w, w])).collect();
    let n = surface.positions().len();
    let matrix = stiffness::finite(laplacian, n, &weights)?;
    let shapes = triangles.each().map(|(_, corners, shape)| (corners, shape));
    let mass = mass::build(laplacian, settings.get("mass"), n, shapes)?;
    let notes = on_triangles::notes(&triangles);
    let provenance = Provenance { id: laplacian.into(), parameters: settings.all().clone(), notes };
    // Positive weights exist, so the exact optimum is positive on every edge, as these are.
    Ok(Operator::new(matrix, provenance)?.with_mass(mass)?.with_exact_signs())
}

/// Whether these weights, put right by a lift, show that positive ones exist. Exact.
fn proves(net: &Net, lift: &Lift, surface: &Surface, weights: &[f64]) -> bool {
    let place = |e: &[usize; 2]| surface.topology().edge_between(e[0], e[1]).map(|at| weights[at]);
    let constrained: Option<Vec<f64>> = net.edges().iter().map(place).collect();
    lift.is_disc() && constrained.is_some_and(|weights| lift.rounded(&weights, net).is_some())
}

/// The linear program, over all edges.
struct Program {
    equations: Csr,
    shares: Vec<f64>,
}

impl Program {
    fn of(surface: &Surface, net: &Net) -> Self {
        let edges = surface.topology().edges();
        let squared: Vec<f64> =
            edges.iter().map(|&[i, j]| (surface.point(i) - surface.point(j)).norm_squared()).collect();
        let doubled_area = 2.0 * surface.area();
        // Lengths in units of the root of the area, so that no scale of the mesh reaches the solver.
        let unit = doubled_area.sqrt();
        let place: Vec<Option<usize>> =
            net.edges().iter().map(|e| surface.topology().edge_between(e[0], e[1])).collect();
        let equations = net.equations();
        let entries: Vec<_> = equations.entries().filter_map(|(i, j, v)| Some((i, place[j]?, v / unit))).collect();
        Program {
            equations: Csr::from_triplets(equations.rows(), edges.len(), &entries),
            shares: squared.iter().map(|s| s / doubled_area).collect(),
        }
    }

    /// The optimal weights, positive, with the equations holding to rounding.
    fn optimum(&self) -> Option<Vec<f64>> {
        let (mut weights, _) = program::largest_minimum(&self.equations, &self.shares)?;
        for _ in 0..3 {
            weights = equilibrium::projected(&self.equations, weights)?;
        }
        weights.iter().all(|w| *w > 0.0).then_some(weights)
    }
}
