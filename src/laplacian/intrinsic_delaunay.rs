//! The intrinsic Delaunay Laplacian: the cotangent Laplacian of the intrinsic Delaunay triangulation of the same surface.
//!
//! # Definition
//! ```text
//! ω_ij = ½ Σ (cot α_e + cot β_e)   over the intrinsic edges e from i to j
//! ```
//! of the triangulation of the same polyhedral metric with the same vertices in which `α_e + β_e ≤ π` at every interior edge. It is
//! reached by flipping edges; several edges may join the same two vertices, and a loop contributes nothing. Where four
//! vertices are cocircular the triangulation is not unique; L is, since the diagonals weigh zero.
//!
//! # Shapes and units
//! L: n×n, dimensionless. M: n×n, length² (`unit`: dimensionless), from the intrinsic triangles.
//!
//! # Convention
//! That of `cotan`, with which it agrees, entry by entry, on a Delaunay mesh. The number of flips is a note of the operator.
//!
//! # Guarantees
//! * FIN, SYM, NULL, PSD: always.
//! * POS0, MVP, MAX-local: where no triangle was left out. *Exception*: isolated vertices; by rounding, see below.
//! * MAX-global: on connected surfaces. MAX-heat: on closed ones, for lumped masses.
//! * POS, LOC, MASS, PERM, UNION: without flips, that is on Delaunay meshes (POS: strictly Delaunay).
//! * KER: promised where angles are at least 1°; flips only enlarge the smallest angle.
//! * LIN, ENERGY, FLUX: on planar meshes, convex or not: flips give a triangulation of the same domain by straight edges.
//! * PERM, UNION, RIGID, ISO, SCALE: for the masses `voronoi` and `unit` (SCALE: `voronoi`), which do not depend on the choice at
//!   cocircular vertices; promised where angles are at least 1°.
//! * CON: for every mass but `unit`, as of `cotan`: linear elements of the same metric. The table of \[wardetzky2007\] leaves it open.
//!
//! # Does not hold
//! * LOC: the vertices (±2, 0), (0, ±1) with the long diagonal: the entry of the short one, which is no edge of the mesh.
//! * POS: there, the edge of the mesh has no weight. POS-boundary: a triangle with an obtuse angle opposite the boundary.
//! * REACH: one moved vertex can start a chain of flips.
//! * LIN, ENERGY: on surfaces in space, coordinates are not linear along intrinsic edges.
//! * MASS: shares are those of the intrinsic star, and `voronoi` can be negative at the boundary.
//! * PERM, UNION: with `barycentric`, `mixed` or `consistent` mass at cocircular vertices, where the order of the edges, or the
//!   rounding of a translated copy, chooses the diagonal.
//! * MAX-heat: an obtuse angle opposite the boundary; the consistent mass with small time steps.
//!
//! # Boundary
//! Natural. Boundary edges are never flipped, and their weights may be negative; they join boundary vertices only, so the
//! Dirichlet problem does not see them.
//!
//! # Degenerate input
//! Triangles of zero area are refused, or left out with `degenerate=skip`, which leaves a slit. An edge with more than two
//! triangles and a surface that cannot be oriented are refused. Pinched vertices are admitted.
//!
//! # Cost and accuracy
//! O(F) memory; a flip is O(1), and their number is about F in practice but not bounded by F in space. In the plane edges are
//! judged exactly, weights are computed from positions, and signs are exact. In space flipped triangles are known by rounded
//! lengths: a weight that is zero in exact arithmetic may come out negative by rounding; it is kept and counted in a note.
//!
//! # References
//! \[bobenko-springborn2007\] (the operator, its uniqueness); \[wardetzky2007\] (its properties); \[musin1997\] for the end of
//! the flips in space, see [`domain::intrinsic`](crate::domain::intrinsic).
//!
//! # Example
//! The rhombus (±2, 0), (0, ±1) cut along its long diagonal: opposite it both cotangents are −¾. The flip puts in the short
//! diagonal, opposite which both are ¾.
//! ```
//! use lapjury::domain::{Domain, Surface};
//! let rhombus = Surface::planar(&[[-2.0, 0.0], [0.0, -1.0], [2.0, 0.0], [0.0, 1.0]], &[[0, 1, 2], [0, 2, 3]])?;
//! let delaunay = lapjury::laplacian::find("intrinsic-delaunay").ok_or("missing")?;
//! let operator = delaunay.build(&Domain::from(rhombus), &Default::default())?;
//! let l = operator.stiffness();
//! assert_eq!([l.at(0, 2), l.at(1, 3)], [0.0, -0.75]);
//! assert_eq!(operator.provenance().notes, ["1 flips to the intrinsic Delaunay triangulation"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::shape::{self, Shape, Triangles};
use super::{BuildError, CONVERGENCE, Fact, Laplacian, Promise, When, mass, on_triangles, stiffness};
use crate::domain::intrinsic::{IntrinsicError, IntrinsicTriangulation};
use crate::domain::{Domain, cotangent, delaunay};
use crate::linalg::{Csr, parallel};
use crate::operator::{Operator, Provenance};
use crate::parameter::Settings;

const UNIQUE: When = When::Is("mass", &["voronoi", "unit"]);

/// The catalogue entry.
pub static ENTRY: Laplacian = Laplacian {
    id: "intrinsic-delaunay",
    name: "intrinsic Delaunay Laplacian",
    definition: "the cotangent Laplacian of the intrinsic Delaunay triangulation, reached by flips",
    sources: &["bobenko-springborn2007", "musin1997", "wardetzky2007"],
    accepts: on_triangles::ACCEPTS,
    parameters: &[on_triangles::MASS, on_triangles::DEGENERATE],
    promises: &[
        Promise::holds("FIN"),
        Promise::holds("SYM"),
        Promise::holds("NULL"),
        Promise::holds("PSD"),
        Promise::holds_given("POS0", &[Fact::NonDegenerate]),
        Promise::holds_given("POS", &[Fact::StrictlyDelaunay, Fact::NonDegenerate]),
        Promise::holds_given("MVP", &[Fact::NonDegenerate, Fact::NoIsolatedVertex]),
        Promise::holds_given("MAX-local", &[Fact::NonDegenerate, Fact::NoIsolatedVertex]),
        Promise::holds_given("MAX-global", &[Fact::NonDegenerate, Fact::Connected]),
        Promise::holds_given("MAX-heat", &[Fact::NonDegenerate, Fact::NoIsolatedVertex, Fact::Closed])
            .when(&[on_triangles::LUMPED]),
        Promise::holds_given("LOC", &[Fact::Delaunay]),
        Promise::holds_given("KER", &[Fact::NonDegenerate, Fact::HealthyAngles]),
        Promise::holds_given("LIN", &[Fact::Planar, Fact::NonDegenerate]),
        Promise::holds_given("FLUX", &[Fact::Planar, Fact::NonDegenerate, Fact::Manifold]),
        Promise::holds_given("ENERGY", &[Fact::Planar]),
        Promise::holds_given("MASS", &[Fact::Delaunay, Fact::NonDegenerate, Fact::NoIsolatedVertex])
            .when(&[on_triangles::POSITIVE_AREA]),
        Promise::holds_given("PERM", &[Fact::Delaunay]),
        Promise::holds_given("PERM", &[Fact::HealthyAngles]).when(&[UNIQUE]),
        Promise::holds_given("UNION", &[Fact::StrictlyDelaunay]),
        Promise::holds_given("UNION", &[Fact::HealthyAngles]).when(&[UNIQUE]),
        Promise::holds_given("RIGID", &[Fact::HealthyAngles]).when(&[UNIQUE]),
        Promise::holds_given("ISO", &[Fact::HealthyAngles]).when(&[UNIQUE]),
        Promise::holds_given("SCALE", &[Fact::HealthyAngles]).when(&[When::Is("mass", &["voronoi"])]),
        Promise::holds(CONVERGENCE).when(&[on_triangles::REFINABLE]),
        Promise::fails_somewhere("LOC"),
        Promise::fails_somewhere("POS"),
        Promise::fails_somewhere("POS-boundary"),
        Promise::fails_somewhere("REACH"),
        Promise::fails_somewhere("LIN"),
        Promise::fails_somewhere("ENERGY"),
        Promise::fails_somewhere("MASS"),
        Promise::fails_somewhere("PERM"),
        Promise::fails_somewhere("UNION"),
        Promise::fails_somewhere("MAX-heat"),
    ],
    build,
};

fn build(domain: &Domain, settings: &Settings) -> Result<Operator, BuildError> {
    let surface = on_triangles::surface(ENTRY.id, domain)?;
    let skip = settings.get("degenerate") == "skip";
    let triangles = Triangles::new(ENTRY.id, surface, skip)?.with_lengths(ENTRY.id)?;
    let doubled_area = |face: usize| triangles.angles(face).map(|angles| angles[3]);
    let mut intrinsic = IntrinsicTriangulation::with_areas(surface, doubled_area).map_err(refusal)?;
    let clear = |e: usize| delaunay::clear_sign(triangles.cotangents_opposite(e).copied());
    let clear = parallel::collect(intrinsic.edge_count(), clear);
    let flips = intrinsic.make_delaunay_knowing(|edge| clear[edge]);
    drop(clear);
    let angles = parallel::collect(intrinsic.face_count(), |f| angles(&intrinsic, &triangles, f));
    // The cotangent opposite each half-edge, put down face by face: edges then read theirs in order.
    let mut opposite = vec![0.0; 2 * intrinsic.edge_count()];
    for (face, cotangents) in angles.iter().enumerate() {
        let [h, n, p] = intrinsic.half_edges(face);
        [opposite[n], opposite[p], opposite[h]] = [cotangents[0], cotangents[1], cotangents[2]];
    }
    let weights = parallel::collect(intrinsic.edge_count(), |e| weight(&intrinsic, &opposite, e));
    drop(opposite);
    let n = surface.positions().len();
    // An edge without a triangle adds nothing, and neither does a loop.
    let ends = |e: usize| intrinsic.ends(e).unwrap_or_default();
    let matrix = stiffness::from_each(n, weights.len(), ends, |e, _| weights[e]);
    stiffness::check_finite(ENTRY.id, &matrix)?;
    let each = angles.iter().enumerate().map(|(f, angles)| (f, corners(&intrinsic, f), angles));
    let mass = match settings.get("mass") {
        "barycentric" => mass::barycentric(ENTRY.id, n, each.map(|(_, corners, angles)| (corners, angles[3])))?,
        name => {
            let shape = |f: usize, angles: &[f64; 4]| shape(&intrinsic, &triangles, f, angles);
            mass::build(ENTRY.id, name, n, each.map(|(f, corners, angles)| (corners, shape(f, angles))))?
        }
    };
    let mut notes = on_triangles::notes(&triangles);
    notes.push(format!("{flips} flips to the intrinsic Delaunay triangulation"));
    notes.extend(negative_by_rounding(&intrinsic, &weights));
    let provenance = Provenance { id: ENTRY.id.into(), parameters: settings.all().clone(), notes };
    let exact = (intrinsic.is_planar() || flips == 0) && !has_parallel_edges(&intrinsic, &matrix);
    let operator = Operator::new(matrix, provenance)?.with_mass(mass)?;
    Ok(if exact { operator.with_exact_signs() } else { operator })
}

fn refusal(error: IntrinsicError) -> BuildError {
    let laplacian = ENTRY.id;
    match error {
        IntrinsicError::NotATriangle { face, corners } => BuildError::NotATriangle { laplacian, face, corners },
        IntrinsicError::NonManifold { a, b, faces } => BuildError::NonManifold { laplacian, a, b, faces },
        IntrinsicError::NotOrientable { a, b } => BuildError::NotOrientable { laplacian, a, b },
    }
}

/// The corners of an intrinsic triangle, in the order of its half-edges.
fn corners(intrinsic: &IntrinsicTriangulation, face: usize) -> [usize; 3] {
    let known = intrinsic.source(face).and_then(|source| intrinsic.surface().triangle(source));
    known.unwrap_or_else(|| intrinsic.corners(face))
}

/// The cotangents of an intrinsic triangle, in the order of its half-edges, and twice its area: those of the face that it is, from
/// positions where it is straight in space.
fn angles(intrinsic: &IntrinsicTriangulation, triangles: &Triangles, face: usize) -> [f64; 4] {
    if let Some(known) = intrinsic.source(face).and_then(|source| triangles.angles(source)) {
        return *known;
    }
    let ([x, y, z], doubled_area) = if intrinsic.is_straight(face) {
        let found = cotangent::of_triangle(intrinsic.corners(face).map(|v| intrinsic.surface().point(v)));
        (found.values, found.doubled_area)
    } else {
        (opposite(intrinsic, face).map(|h| intrinsic.cotangent_opposite(h)), intrinsic.doubled_area(face))
    };
    [x, y, z, doubled_area]
}

/// The half-edges opposite the corners of a triangle: corner k is where half-edge k starts, opposite it is the one that follows.
fn opposite(intrinsic: &IntrinsicTriangulation, face: usize) -> [usize; 3] {
    let [h, n, p] = intrinsic.half_edges(face);
    [n, p, h]
}

/// The shape of an intrinsic triangle with these [`angles`].
#[inline]
fn shape(
    intrinsic: &IntrinsicTriangulation,
    triangles: &Triangles,
    face: usize,
    &[x, y, z, doubled_area]: &[f64; 4],
) -> Shape<f64> {
    if let Some(known) = intrinsic.source(face).and_then(|source| triangles.shape(source)) {
        return known;
    }
    let squared_lengths = if intrinsic.is_straight(face) {
        shape::squared_lengths(intrinsic.corners(face).map(|v| &intrinsic.surface().positions()[v]))
    } else {
        opposite(intrinsic, face).map(|h| intrinsic.length(h / 2) * intrinsic.length(h / 2))
    };
    Shape { cotangents: [x, y, z], squared_lengths, doubled_area }
}

/// The weight of an intrinsic edge, its sign exact where both triangles are straight; `opposite` has the cotangent opposite each
/// half-edge.
fn weight(intrinsic: &IntrinsicTriangulation, opposite: &[f64], edge: usize) -> f64 {
    let (mut cotangents, mut count) = ([0.0; 2], 0);
    for h in intrinsic.sides(edge) {
        cotangents[count] = opposite[h];
        count += 1;
    }
    if !intrinsic.sides(edge).all(|h| intrinsic.is_straight(intrinsic.face(h))) {
        return 0.5 * cotangents[0] + 0.5 * cotangents[1];
    }
    cotangent::half_sum(&cotangents[..count], || {
        let at = |v: usize| intrinsic.surface().point(v);
        let [p, q] = intrinsic.ends(edge).unwrap_or_default().map(at);
        intrinsic.sides(edge).map(move |h| [at(intrinsic.apex(h)), p, q])
    })
}

/// A note on interior edges whose weight is negative: on a Delaunay triangulation only rounding can make it so.
fn negative_by_rounding(intrinsic: &IntrinsicTriangulation, weights: &[f64]) -> Option<String> {
    let negative = weights.iter().enumerate().filter(|&(e, w)| *w < 0.0 && intrinsic.sides(e).count() == 2);
    let (count, worst) = negative.fold((0, 0.0), |(count, worst), (_, w)| (count + 1, f64::min(worst, *w)));
    (count > 0)
        .then(|| format!("{count} interior weights are negative by rounding, the worst is {worst:e}; they are kept"))
}

/// Whether two edges have the same ends: then the matrix has fewer entries than ends and vertices, or a vertex several loops.
fn has_parallel_edges(intrinsic: &IntrinsicTriangulation, matrix: &Csr) -> bool {
    let (mut edges, mut loops) = (0, Vec::new());
    for [a, b] in (0..intrinsic.edge_count()).filter_map(|e| intrinsic.ends(e)) {
        edges += 1;
        if a == b {
            loops.push(a);
        }
    }
    loops.sort_unstable();
    let entries = matrix.rows() + 2 * (edges - loops.len());
    matrix.stored() < entries || loops.windows(2).any(|pair| pair[0] == pair[1])
}
