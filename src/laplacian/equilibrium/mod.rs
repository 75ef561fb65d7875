//! No free lunch: whether a planar triangulation has symmetric, local, linearly precise weights that are all positive,
//! decided with a certificate.
//!
//! # Definition
//! Weights `ω_ij = ω_ji` on the edges are in *equilibrium* where `Σ_j ω_ij (x_i − x_j) = 0` at every interior vertex i: that is
//! SYM, LOC and LIN. The edges with an interior end are *constrained*; an edge between two boundary vertices is free, and
//! its weight may be any number. By Stiemke's alternative there are either equilibrium weights that are positive on every
//! constrained edge, or there is a *motion* y of the vertices, zero on the boundary, with
//! `g_ij = (y_i − y_j)·(x_i − x_j) ≥ 0` on all constrained edges and `> 0` on one; never both, since
//! `Σ ω_ij g_ij = Σ_i y_i · Σ_j ω_ij (x_i − x_j) = 0`.
//!
//! On a disc positive weights are a *lift*: heights h, linear on triangles and strictly convex across every interior edge,
//! with `ω_ij` = jump of the gradient across ij / |ij|, a rational number (Maxwell, Cremona). With left and right vertex k
//! and l, triangles counter-clockwise and `[abc]` twice the area:
//! ```text
//! ω_ij = (h_l [ijk] − h_i [ljk] − h_j [ilk] − h_k [ijl]) / ([ijk] [jil])
//! ```
//! `h = ½|x|²` gives the cotangent weights. Where the domain is no disc the weights themselves are the certificate.
//!
//! # How it is decided
//! A linear program in floating point proposes ([`program::split`]); the proposal is rounded
//! to whole numbers and verified exactly. What does not survive that is decided by the exact simplex method.
//!
//! # Guarantees
//! A certificate that comes out was verified in rational arithmetic, and one comes out for every triangulation that is
//! accepted.
//!
//! # Cost
//! A few milliseconds for a hundred edges. The exact simplex method takes seconds from some twenty interior vertices on.

mod lift;
mod net;

pub use lift::Lift;
pub use net::Net;

use std::cmp::Ordering;

use crate::domain::Surface;
use crate::linalg::factor::Ldlt;
use crate::linalg::{Csr, program, simplex};
use crate::scalar::{Rational, Scalar};

/// What shows that positive weights in equilibrium exist, or that they do not.
#[derive(Clone, Debug, PartialEq)]
pub enum Certificate {
    /// Heights of all vertices, strictly convex across every interior edge.
    Heights(Vec<Rational>),
    /// The weights of the constrained edges, positive and in equilibrium.
    Weights(Vec<Rational>),
    /// The motion of all vertices.
    Motion(Vec<[Rational; 2]>),
}

impl Certificate {
    /// Whether it shows that positive weights exist.
    pub fn is_positive(&self) -> bool {
        !matches!(self, Certificate::Motion(_))
    }

    /// What it shows, with the first numbers of it.
    pub fn in_words(&self) -> String {
        match self {
            Certificate::Heights(h) => format!("{} heights are strictly convex across every interior edge", h.len()),
            Certificate::Weights(w) => format!("{} positive weights are in equilibrium at interior vertices", w.len()),
            Certificate::Motion(y) => {
                let number = |x: &Rational| x.approximate();
                let moved = || y.iter().enumerate().filter(|(_, y)| y.iter().any(|x| x.cmp_zero() != Ordering::Equal));
                let some: Vec<String> =
                    moved().take(4).map(|(v, y)| format!("{v} by ({}, {})", number(&y[0]), number(&y[1]))).collect();
                let rest = moved().count().saturating_sub(4);
                let more = if rest > 0 { format!(" and {rest} others") } else { String::new() };
                format!(
                    "with the boundary held, moving vertex {}{more} shortens no edge with an interior end and lengthens one, \
                     which positive weights in equilibrium forbid",
                    some.join(", ")
                )
            }
        }
    }
}

/// A certificate and how it was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Decision {
    /// The certificate, verified.
    pub certificate: Certificate,
    /// Whether rounding had left it open, so that the exact simplex method decided.
    pub by_simplex: bool,
}

/// Decides a triangulation. `None` unless it is planar, with triangles alone, none degenerate, and without an edge of more
/// than two faces.
pub fn decide(surface: &Surface) -> Option<Decision> {
    let net = Net::of(surface)?;
    let lift = Lift::of(surface)?;
    let rounded = propose(&net, &lift);
    let by_simplex = rounded.is_none();
    let certificate = match rounded {
        Some(certificate) => certificate,
        None => exactly(&net, &lift),
    };
    Some(Decision { certificate, by_simplex })
}

/// As [`decide`], where the exact simplex method is asked only on nets of at most [`QUICK`] equations: `None` also where rounding
/// left a larger one open.
pub fn decide_quickly(surface: &Surface) -> Option<Certificate> {
    let (net, lift) = (Net::of(surface)?, Lift::of(surface)?);
    propose(&net, &lift).or_else(|| (net.forces().rows() <= QUICK).then(|| exactly(&net, &lift)))
}

/// Twelve interior vertices: the exact simplex method takes some tens of milliseconds.
pub const QUICK: usize = 24;

/// The certificate by the exact simplex method alone: the second way.
pub fn decide_by_simplex(surface: &Surface) -> Option<Certificate> {
    Some(exactly(&Net::of(surface)?, &Lift::of(surface)?))
}

/// What the linear program proposes, where it survives rounding.
fn propose(net: &Net, lift: &Lift) -> Option<Certificate> {
    if net.edges().is_empty() {
        return if lift.is_disc() { lift.rounded(&[], net).map(Certificate::Heights) } else { None };
    }
    let forces = net.forces();
    let mut scales = vec![1.0; net.edges().len()];
    for _ in 0..PASSES {
        let split = program::split(&forces.map(|_, j, v| v * scales[j]))?;
        let found: Vec<f64> = split.solution.iter().zip(&scales).map(|(x, s)| x * s).collect();
        if lift.is_disc() && found.iter().all(|f| *f > 0.0) {
            let weights = net.weights_of(&found);
            let exact = || projected(&net.equations(), projected(&net.equations(), weights.clone())?);
            if let Some(heights) = lift.rounded(&weights, net).or_else(|| lift.rounded(&exact()?, net)) {
                return Some(Certificate::Heights(heights));
            }
        }
        if split.carried.iter().all(|c| *c) {
            if !lift.is_disc() {
                // Weights off a disc obey equations, which rounding breaks.
                return None;
            }
        } else if let Some(motion) = net.rounded_motion(&split) {
            return Some(Certificate::Motion(motion));
        }
        for (scale, x) in scales.iter_mut().zip(&split.solution) {
            *scale *= x.max(1.0);
        }
    }
    None
}

/// Where forces are of many magnitudes, as in deeply nested triangles, the solver sees only the largest. The next pass counts each in
/// units of what the one before has found.
const PASSES: usize = 3;

/// Weights moved onto the equations, each in proportion to its size: `ω − W Aᵀ (A W Aᵀ)⁻¹ A ω` with `W = diag(ω²)`. `None` where that
/// cannot be computed.
///
/// A solver meets the equations up to its tolerance for the largest weights, and this for each vertex up to those there.
pub(super) fn projected(equations: &Csr, weights: Vec<f64>) -> Option<Vec<f64>> {
    let n = equations.rows();
    if n == 0 {
        return Some(weights);
    }
    let scaled = equations.map(|_, j, v| v * weights[j]);
    let across = scaled.transpose();
    let mut entries = Vec::new();
    for edge in 0..across.rows() {
        for (i, a) in across.row(edge) {
            entries.extend(across.row(edge).map(|(j, b)| (i, j, a * b)));
        }
    }
    let normal = Csr::from_triplets(n, n, &entries);
    let mut multipliers = [equations.mul(&weights)];
    Ldlt::new(&normal).ok()?.solve(&mut multipliers);
    let correction = across.mul(&multipliers[0]);
    let corrected: Vec<f64> = weights.iter().zip(correction).map(|(w, c)| w - w * c).collect();
    corrected.iter().all(|w| w.is_finite()).then_some(corrected)
}

fn exactly(net: &Net, lift: &Lift) -> Certificate {
    match simplex::stiemke(&net.rows()) {
        simplex::Farkas::Refutation(y) => Certificate::Motion(net.motion_of(&y)),
        simplex::Farkas::Solution(weights) if lift.is_disc() => Certificate::Heights(lift.heights(&weights, net)),
        simplex::Farkas::Solution(weights) => Certificate::Weights(weights),
    }
}
