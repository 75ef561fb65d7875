//! The Laplacian of an orthogonal dual: signed length of the dual edge over length of the edge.
//!
//! # Definition
//! Every vertex has a weight w, a squared radius. The dual vertex of a triangle is its power centre d, the point with
//! `|d − x_i|² − w_i` the same for its three corners; the line between the dual vertices of two neighbouring triangles is
//! orthogonal to their common edge ij, and
//! ```text
//! ω_ij = (signed distance of the two dual vertices) / |ij|
//! ```
//! positive where they lie in the order of their triangles. A triangle i, j, k with angle cotangents cot and doubled area
//! `[ijk]` adds
//! ```text
//! ½ cot_k + (w_i cot_j + w_j cot_i) / (2 |ij|²) − w_k / (2 [ijk])
//! ```
//! With all weights equal the dual vertices are the circumcentres and this is `cotan`. In the plane the weights are those of the
//! lift `h = ½ (|x|² − w)`: the jump of its gradient over the length of the edge, and the dual vertices are the gradients.
//!
//! # Shapes and units
//! L: n×n, dimensionless. M: n×n, length² (`unit`: dimensionless). w: length².
//!
//! # Convention
//! The parameter `weights` chooses w, with `s_i` the squared length of the shortest edge at i:
//!
//! | word | w_i |
//! | --- | --- |
//! | `zero` | 0: `cotan` |
//! | `shortest` | `amount · s_i` |
//! | `random` | `amount · s_i` times a number between −1 and 1 that depends on `seed` and i alone |
//!
//! # Guarantees
//! * FIN, LOC, SYM, NULL: always.
//! * LIN: on manifolds, whatever the weights. *Exception*: around a triangle that was left out.
//! * PSD, ENERGY, PERM, UNION, REACH: of `zero`.
//! * FLUX: of `zero`, on manifolds.
//! * POS: of `zero`, where every interior edge is strictly Delaunay. POS0: of `zero`, where every interior edge is Delaunay.
//! * MASS: `barycentric`, `mixed` and `consistent`.
//! * CON: of `zero`, which is `cotan`, for every mass but `unit`.
//!
//! # Does not hold
//! * POS, POS0, POS-boundary, MVP, MAX-local, MAX-global, MAX-heat: where the triangulation is not the weighted Delaunay
//!   triangulation of its weights; as of `cotan`.
//! * PSD, KER, ENERGY, FLUX: of weights that differ: power centres know less of the boundary than circumcentres do.
//! * PERM, UNION: of `random`, whose weights go with the numbers of the vertices.
//! * MASS: `voronoi` and `unit`, as of `cotan`.
//!
//! # Boundary
//! Natural: the row of a boundary vertex is the sum over the triangles present.
//!
//! # Degenerate input
//! As `cotan`: triangles of zero area are refused, or left out with `degenerate=skip`; at an edge with more than two triangles
//! all of them are summed.
//!
//! # Cost and accuracy
//! O(F log valence). A weight is off by no more than some `16u (1 + |amount|)/sin²θ` of the angles of its triangles. Signs are
//! exact for `zero`. [`stiffness_in_plane`] is exact over the rationals, for any weights.
//!
//! # References
//! \[glickenstein2005\] (the dual of weights); \[wardetzky2007\] (all symmetric, local, linearly precise operators of a planar
//! triangulation are of this form); \[wardetzky-primer\] section 5.3.7.
//!
//! # Example
//! The star with neighbours (±2, 0), (0, ±1). By its formula the weight of the centre, w, changes ω towards (2, 0) by `2 w cot/(2·4)`,
//! with cot = 2 at (2, 0), and towards (0, 1) by `2 w cot/2` with cot = ½ there.
//! ```
//! use lapjury::domain::Surface;
//! use lapjury::laplacian::orthogonal_dual::stiffness_in_plane;
//! let points = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [-2.0, 0.0], [0.0, -1.0]];
//! let star = Surface::planar(&points, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])?;
//! let plain = stiffness_in_plane(&star, &[0.0; 5]).ok_or("planar")?;
//! assert_eq!([plain.at(0, 1), plain.at(0, 2)], [-0.5, -2.0]);
//! let weighted = stiffness_in_plane(&star, &[1.0, 0.0, 0.0, 0.0, 0.0]).ok_or("planar")?;
//! assert_eq!([weighted.at(0, 1), weighted.at(0, 2)], [-1.0, -2.5]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::shape::Triangles;
use super::{BuildError, CONVERGENCE, Fact, Laplacian, Promise, When, cotan, on_triangles, stiffness};
use crate::domain::{Domain, Surface};
use crate::linalg::Csr;
use crate::operator::Operator;
use crate::parameter::{Parameter, Range, Settings};
use crate::scalar::Scalar;

const ZERO: When = When::Is("weights", &["zero"]);

/// The catalogue entry.
pub static ENTRY: Laplacian = Laplacian {
    id: "orthogonal-dual",
    name: "Laplacian of an orthogonal dual",
    definition: "ω_ij = signed length of the dual edge / |ij|, dual vertices the power centres of vertex weights",
    sources: &["glickenstein2005", "wardetzky2007", "wardetzky-primer"],
    accepts: on_triangles::ACCEPTS,
    parameters: &[
        Parameter {
            name: "weights",
            meaning: "the weights of the vertices, in units of the squared length of the shortest edge there",
            default: "shortest",
            range: Range::Choice(&["zero", "shortest", "random"]),
        },
        Parameter {
            name: "amount",
            meaning: "the size of the weights",
            default: "0.25",
            range: Range::Number(-4.0, 4.0),
        },
        Parameter {
            name: "seed",
            meaning: "the seed of random weights",
            default: "1",
            range: Range::Whole(0, u32::MAX as u64),
        },
        on_triangles::MASS,
        on_triangles::DEGENERATE,
    ],
    promises: &[
        Promise::holds("FIN"),
        Promise::holds("LOC"),
        Promise::holds("SYM"),
        Promise::holds("NULL"),
        Promise::holds_given("LIN", &[Fact::Manifold, Fact::NonDegenerate]),
        Promise::holds("PSD").when(&[ZERO]),
        Promise::holds("ENERGY").when(&[ZERO]),
        Promise::holds("PERM").when(&[ZERO]),
        Promise::holds("UNION").when(&[ZERO]),
        Promise::holds("REACH").when(&[ZERO]),
        Promise::holds_given("FLUX", &[Fact::Manifold, Fact::NonDegenerate]).when(&[ZERO]),
        Promise::holds_given("POS", &[Fact::StrictlyDelaunay, Fact::Manifold]).when(&[ZERO]),
        Promise::holds_given("POS0", &[Fact::Delaunay, Fact::Manifold]).when(&[ZERO]),
        Promise::holds_given("MASS", &[Fact::NonDegenerate, Fact::NoIsolatedVertex])
            .when(&[on_triangles::POSITIVE_AREA]),
        Promise::holds(CONVERGENCE).when(&[ZERO, on_triangles::REFINABLE]),
        Promise::fails_somewhere("POS"),
        Promise::fails_somewhere("POS0"),
        Promise::fails_somewhere("POS-boundary"),
        Promise::fails_somewhere("MVP"),
        Promise::fails_somewhere("MAX-local"),
        Promise::fails_somewhere("MAX-global"),
        Promise::fails_somewhere("MAX-heat"),
        Promise::fails_somewhere("PSD"),
        Promise::fails_somewhere("KER"),
        Promise::fails_somewhere("ENERGY"),
        Promise::fails_somewhere("FLUX"),
        Promise::fails_somewhere("PERM"),
        Promise::fails_somewhere("UNION"),
        Promise::fails_somewhere("MASS"),
    ],
    build,
};

fn build(domain: &Domain, settings: &Settings) -> Result<Operator, BuildError> {
    let surface = on_triangles::surface(ENTRY.id, domain)?;
    let weights = weights(surface, settings);
    let zero = settings.get("weights") == "zero";
    let operator = on_triangles::operator(ENTRY.id, domain, settings, |triangles, edge| {
        let weight = if zero { cotan::weight(triangles, edge) } else { weight(triangles, edge, &weights) };
        [weight, weight]
    })?;
    Ok(if zero { operator.with_exact_signs() } else { operator })
}

/// The weights of the vertices.
fn weights(surface: &Surface, settings: &Settings) -> Vec<f64> {
    let mut shortest = vec![f64::INFINITY; surface.positions().len()];
    for &[i, j] in surface.topology().edges() {
        let squared = (surface.point(i) - surface.point(j)).norm_squared();
        [i, j].iter().for_each(|&v| shortest[v] = shortest[v].min(squared));
    }
    let (amount, seed) = (settings.number("amount"), settings.whole("seed") as u64);
    let share = |v: usize| match settings.get("weights") {
        "zero" => 0.0,
        "shortest" => amount,
        _ => amount * scattered(seed, v as u64),
    };
    // A vertex without edges has none to give a weight to.
    let weight = |(v, &s): (usize, &f64)| if s.is_finite() { share(v) * s } else { 0.0 };
    shortest.iter().enumerate().map(weight).collect()
}

/// A number in [−1, 1) that depends on a seed and a number alone (the finaliser of SplitMix64).
fn scattered(seed: u64, number: u64) -> f64 {
    let mut z = number.wrapping_add(seed << 32).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^= z >> 31;
    (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// The sum of what the triangles at an edge add.
fn weight<S: Scalar>(triangles: &Triangles<S>, edge: usize, weights: &[S]) -> S {
    let [i, j] = triangles.surface().topology().edges()[edge];
    triangles.beside(edge).fold(S::zero(), |sum, flank| {
        let ([a, b, c], shape) = (flank.corners, flank.shape);
        let tilt = weights[i].clone() * shape.cotangents[b].clone() + weights[j].clone() * shape.cotangents[a].clone();
        let twice = shape.cotangents[c].clone() + tilt / shape.squared_lengths[c].clone()
            - weights[flank.opposite].clone() / shape.doubled_area.clone();
        sum + S::half() * twice
    })
}

/// The stiffness matrix of a planar mesh and given vertex weights over any scalar, exactly over the rationals; `None` unless all faces
/// are triangles, none is degenerate, the mesh is planar ([`Surface::plane`]) and every vertex has a weight.
pub fn stiffness_in_plane<S: Scalar>(surface: &Surface, weights: &[S]) -> Option<Csr<S>> {
    let triangles = Triangles::<S>::in_plane(surface)?;
    if weights.len() != surface.positions().len() {
        return None;
    }
    let edges = surface.topology().edges().iter().enumerate();
    let of_edge = |e: usize| weight(&triangles, e, weights);
    let list: Vec<_> = edges.map(|(e, &ends)| (ends, [of_edge(e), of_edge(e)])).collect();
    Some(stiffness::from_weights(surface.positions().len(), &list))
}
