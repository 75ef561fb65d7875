//! The one-parameter family of three-point coordinates on a triangle surface: Wachspress, mean value and cotangent in one.
//!
//! # Definition
//! For a vertex with neighbours j at distance r_j, any numbers c_j give weights that reproduce linear functions. Here
//! `c_j = r_j^p`. A triangle with corners i, j, k and angle θ at i adds to ω_ij
//! ```text
//! (1/(r_j sin θ)) (c_k/r_k − (c_j/r_j) cos θ)   =   r_j^(p−2) ( ((r_k/r_j)^(p−1) − 1)/sin θ + tan(θ/2) )
//! ```
//! and `L_ij = −ω_ij`, `L_ii = Σ_j ω_ij`. Summed over the two triangles at an edge of the plane this is the star formula
//! `ω_j = (c_{j+1} A_{j−1} − c_j B_j + c_{j−1} A_j)/(A_{j−1} A_j)`, with `A_j = [i j j+1]`, `B_j = [i j−1 j+1]`, since
//! `B_j/(A_{j−1} A_j) = (cot θ_{j−1} + cot θ_j)/r_j²`. The form by triangles is intrinsic, needs no closed star, and serves in space.
//!
//! # Shapes and units
//! L: n×n, length^(p−2). M: n×n, length² (`unit`: dimensionless).
//!
//! # Convention
//! | p | member | this ω is |
//! | --- | --- | --- |
//! | 0 | `wachspress` | the same |
//! | 1 | `mean-value` | the same |
//! | 2 | `cotan` | twice the cotangent weight |
//!
//! # Guarantees
//! * FIN, LOC, NULL, PERM, UNION, REACH: for every p.
//! * LIN: for every p, on manifolds. *Exception*: next to a triangle that was left out, or at an edge with three faces.
//! * POS, POS0, POS-boundary, KER, MVP, MAX-local, MAX-global, MAX-heat: p = 1; and 0 ≤ p ≤ 2 where all angles are acute:
//!   `cos θ < r_k/r_j < 1/cos θ` then, and the bracket of the definition is positive (MAX-heat for positive lumped masses).
//! * MASS: `barycentric`, `mixed` and `consistent`.
//! * RIGID, ISO: promised where angles are at least 1° and |p| ≤ 4.
//!
//! # Does not hold
//! * SYM, PSD, ENERGY, FLUX, SCALE: for p other than 2.
//! * POS, POS0, POS-boundary, MVP, MAX-local, MAX-global, MAX-heat: for p other than 1, on stars with obtuse angles.
//! * MASS: `voronoi` and `unit`, as for `cotan`.
//! * CON: p = 0 and p = 1 on squares cut along one diagonal, even up to the best factor. p = 2 is twice `cotan`.
//!
//! # Boundary
//! The row of a boundary vertex is the sum over the triangles present.
//!
//! # Degenerate input
//! As `cotan`: triangles of zero area are refused, or left out with `degenerate=skip`; at an edge with more than two triangles
//! all of them are summed.
//!
//! # Cost and accuracy
//! O(F log valence). `(r_k/r_j)^(p−1) − 1` is formed without cancellation from `r_k² − r_j² = 2A (cot at k − cot at j)`; the error of
//! a weight is then that of its angles, `8u/sin²θ` at each corner, times `|p − 1|` and `r_j^(p−2)`. Signs are exact for p = 0, 1, 2.
//!
//! # References
//! \[floater-hormann-kos2006\] (the family: their `c_i = r_i^p`); \[langer2006\] (dual faces).
//!
//! # Example
//! The star with neighbours (±2, 0) and (0, ±1), p = 2: twice the cotangent weights ½ and 2.
//! ```
//! use lapjury::domain::{Domain, Surface};
//! let points = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [-2.0, 0.0], [0.0, -1.0]];
//! let star = Surface::planar(&points, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])?;
//! let three_point = lapjury::laplacian::find("three-point").ok_or("missing")?;
//! let p = [("p".to_string(), "2".to_string())].into();
//! let operator = three_point.build(&Domain::from(star), &p)?;
//! let l = operator.stiffness();
//! assert!((l.at(0, 1) + 1.0).abs() < 1e-15 && (l.at(0, 2) + 4.0).abs() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::cmp::Ordering;

use super::mean_value::tan_half;
use super::shape::{Flank, Triangles, with_sign};
use super::{BuildError, CONVERGENCE, Fact, Laplacian, Promise, When, cotan, on_triangles, stiffness, wachspress};
use crate::domain::{Domain, Surface};
use crate::linalg::Csr;
use crate::operator::Operator;
use crate::parameter::{Parameter, Range, Settings};
use crate::scalar::Scalar;

const MEAN_VALUE: When = When::Between("p", 1.0, 1.0);
const BETWEEN: When = When::Between("p", 0.0, 2.0);
const MODERATE: When = When::Between("p", -4.0, 4.0);

/// The catalogue entry.
pub static ENTRY: Laplacian = Laplacian {
    id: "three-point",
    name: "three-point family",
    definition: "ω_ij = Σ (r_k^(p−1) − r_j^(p−1) cos θ)/(r_j sin θ) over the triangles ijk, θ the angle at i",
    sources: &["floater-hormann-kos2006", "langer2006"],
    accepts: on_triangles::ACCEPTS,
    parameters: &[
        Parameter {
            name: "p",
            meaning: "the exponent in c_j = r_j^p: 0 Wachspress, 1 mean value, 2 cotangent (twice)",
            default: "1",
            range: Range::Number(-8.0, 8.0),
        },
        on_triangles::MASS,
        on_triangles::DEGENERATE,
    ],
    promises: &[
        Promise::holds("FIN"),
        Promise::holds("LOC"),
        Promise::holds("NULL"),
        Promise::holds("PERM"),
        Promise::holds("UNION"),
        Promise::holds("REACH"),
        Promise::holds_given("LIN", &[Fact::Manifold, Fact::NonDegenerate]),
        Promise::holds_given("POS", &[Fact::NonDegenerate]).when(&[MEAN_VALUE]),
        Promise::holds_given("POS", &[Fact::Acute]).when(&[BETWEEN]),
        Promise::holds_given("POS0", &[Fact::NonDegenerate]).when(&[MEAN_VALUE]),
        Promise::holds_given("POS0", &[Fact::Acute]).when(&[BETWEEN]),
        Promise::holds_given("POS-boundary", &[Fact::NonDegenerate]).when(&[MEAN_VALUE]),
        Promise::holds_given("POS-boundary", &[Fact::Acute]).when(&[BETWEEN]),
        Promise::holds_given("KER", &[Fact::NonDegenerate, Fact::HealthyAngles]).when(&[MEAN_VALUE]),
        Promise::holds_given("KER", &[Fact::Acute, Fact::HealthyAngles]).when(&[BETWEEN]),
        Promise::holds_given("MVP", &[Fact::NonDegenerate, Fact::NoIsolatedVertex]).when(&[MEAN_VALUE]),
        Promise::holds_given("MVP", &[Fact::Acute, Fact::NoIsolatedVertex]).when(&[BETWEEN]),
        Promise::holds_given("MAX-local", &[Fact::NonDegenerate, Fact::NoIsolatedVertex]).when(&[MEAN_VALUE]),
        Promise::holds_given("MAX-local", &[Fact::Acute, Fact::NoIsolatedVertex]).when(&[BETWEEN]),
        Promise::holds_given("MAX-global", &[Fact::NonDegenerate, Fact::Connected]).when(&[MEAN_VALUE]),
        Promise::holds_given("MAX-global", &[Fact::Acute, Fact::Connected]).when(&[BETWEEN]),
        Promise::holds_given("MAX-heat", &[Fact::NonDegenerate, Fact::NoIsolatedVertex])
            .when(&[MEAN_VALUE, on_triangles::POSITIVE_LUMPED]),
        Promise::holds_given("MAX-heat", &[Fact::Acute, Fact::NoIsolatedVertex]).when(&[BETWEEN, on_triangles::LUMPED]),
        Promise::holds_given("MASS", &[Fact::NonDegenerate, Fact::NoIsolatedVertex])
            .when(&[on_triangles::POSITIVE_AREA]),
        Promise::holds_given("RIGID", &[Fact::HealthyAngles]).when(&[MODERATE]),
        Promise::holds_given("ISO", &[Fact::HealthyAngles]).when(&[MODERATE]),
        Promise::fails_somewhere("SYM"),
        Promise::fails_somewhere("PSD"),
        Promise::fails_somewhere("ENERGY"),
        Promise::fails_somewhere("FLUX"),
        Promise::fails_somewhere("SCALE"),
        Promise::fails_somewhere("POS"),
        Promise::fails_somewhere("POS0"),
        Promise::fails_somewhere("POS-boundary"),
        Promise::fails_somewhere("MVP"),
        Promise::fails_somewhere("MAX-local"),
        Promise::fails_somewhere("MAX-global"),
        Promise::fails_somewhere("MAX-heat"),
        Promise::fails_somewhere("MASS"),
        Promise::fails_somewhere(CONVERGENCE).when(&[When::Between("p", 0.0, 1.0)]),
    ],
    build,
};

fn build(domain: &Domain, settings: &Settings) -> Result<Operator, BuildError> {
    let p = settings.number("p");
    let operator = on_triangles::operator(ENTRY.id, domain, settings, |triangles, edge| {
        [0, 1].map(|from| {
            let weight = triangles.beside(edge).map(|flank| term(&flank, from, p)).sum();
            sign(triangles, edge, from, p).map_or(weight, |sign| with_sign(weight, sign))
        })
    })?;
    Ok(if sign_is_known(p) { operator.with_exact_signs() } else { operator })
}

fn sign_is_known(p: f64) -> bool {
    [0.0, 1.0, 2.0].contains(&p)
}

/// The exact sign of the weight in the row of the edge's end `from`, for the members that have one.
fn sign(triangles: &Triangles, edge: usize, from: usize, p: f64) -> Option<Ordering> {
    let ends = triangles.surface().topology().edges()[edge];
    match p {
        0.0 => Some(wachspress::tip_sign(triangles, edge, ends[from], ends[1 - from])),
        1.0 => Some(triangles.beside(edge).count().cmp(&0)),
        2.0 => Some(cotan::sign(triangles, edge)),
        _ => None,
    }
}

/// What a triangle adds to ω_ij, i the edge's end `from`. A power of the length beyond the range of `f64` gives NaN, which
/// the assembly refuses.
fn term(flank: &Flank<f64>, from: usize, p: f64) -> f64 {
    let (i, j, k) = (flank.corners[from], flank.corners[1 - from], flank.corners[2]);
    let shape = &flank.shape;
    // The side ij is opposite k, and the side ik opposite j.
    let (near, far) = (shape.squared_lengths[k], shape.squared_lengths[j]);
    let power = near.powf(0.5 * (p - 2.0));
    if !power.is_normal() {
        return f64::NAN;
    }
    let excess = shape.doubled_area / near * (shape.cotangents[k] - shape.cotangents[j]);
    let log_ratio = 0.5 * if excess > -0.5 { excess.ln_1p() } else { (far / near).ln() };
    let cotangent = shape.cotangents[i];
    power * (((p - 1.0) * log_ratio).exp_m1() * cotangent.hypot(1.0) + tan_half(cotangent))
}

/// The stiffness matrix of a planar mesh over any scalar, exactly over the rationals, for an even p; `None` unless p is
/// even, all faces are triangles, none is degenerate and the mesh is planar ([`Surface::plane`]).
pub fn stiffness_in_plane<S: Scalar>(surface: &Surface, p: i32) -> Option<Csr<S>> {
    let triangles = Triangles::<S>::in_plane(surface)?;
    (p % 2 == 0).then(|| stiffness_of(&triangles, p))
}

/// The stiffness matrix of triangles over any scalar, p even: a triangle ijk of area A adds `r_k^p/(2A) − r_j^(p−2) cot θ_i` to
/// ω_ij, in which only squares of lengths occur.
pub(super) fn stiffness_of<S: Scalar>(triangles: &Triangles<S>, p: i32) -> Csr<S> {
    let surface = triangles.surface();
    let both = |(e, &ends): (usize, &[usize; 2])| {
        let weight = |from: usize| {
            triangles.beside(e).fold(S::zero(), |sum, flank| {
                let (i, j, k) = (flank.corners[from], flank.corners[1 - from], flank.corners[2]);
                let shape = flank.shape;
                let far = power(&shape.squared_lengths[j], p / 2) / shape.doubled_area.clone();
                sum + far - power(&shape.squared_lengths[k], p / 2 - 1) * shape.cotangents[i].clone()
            })
        };
        (ends, [weight(0), weight(1)])
    };
    let weights: Vec<_> = surface.topology().edges().iter().enumerate().map(both).collect();
    stiffness::from_weights(surface.positions().len(), &weights)
}

/// An integer power of what is not zero.
fn power<S: Scalar>(x: &S, exponent: i32) -> S {
    let one = S::half() + S::half();
    let magnitude = (0..exponent.unsigned_abs()).fold(one.clone(), |product, _| product * x.clone());
    if exponent < 0 { one / magnitude } else { magnitude }
}
