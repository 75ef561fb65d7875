//! FLUX: at the boundary of a planar domain the operator sees the outward flux of the coordinates.
//!
//! # Definition
//! With the natural boundary condition `(Lx)_i = ∫_∂Ω φ_i ∂x/∂n`, so at a boundary vertex with previous and next boundary
//! vertices p and q (the surface to the left) `Σ_j L_ij (X_j − X_i) = ½ (ℓ₁n₁ + ℓ₂n₂) = ½ J (X_q − X_p)`,
//! `J(a, b) = (b, −a)`. LIN's counterpart where LIN is silent: it sees doubled, halved and missing boundary weights.
//! # Limitations
//! Boundary vertices with other than two boundary edges, or with a degenerate face, are left out.

use super::measure::condition::distance;
use super::measure::moment::{self, is_proper_star};
use super::measure::scan::Scan;
use super::verdict::Level;
use super::{Property, Question, Trial, Verdict, lin};
use crate::domain::{Domain, Surface};

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "FLUX",
    name: "flux through the boundary",
    statement: "planar, natural boundary: (LX)_i = ½ (ℓ₁n₁ + ℓ₂n₂) at every boundary vertex",
    sources: &[],
    question: Question::Operator(check),
};

fn check(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let Domain::Surface(surface) = trial.domain else {
        return Verdict::not_applicable(format!("FLUX is about planar surfaces, not a {}", trial.domain.kind()));
    };
    let Some(axes) = moment::oriented_axes(surface) else {
        return Verdict::not_applicable("the surface is not planar");
    };
    let positions = surface.positions();
    let mut scan = Scan::new();
    let mut left_out = 0;
    for (i, _) in surface.topology().boundary_vertices().iter().enumerate().filter(|(_, b)| **b) {
        let Some([p, q]) = boundary_neighbours(trial, surface, i) else {
            left_out += 1;
            continue;
        };
        let threshold = moment::threshold(trial, positions, i, 0.5 * distance(positions[p], positions[q]));
        let (axis, residual) = lin::worst(&axes, |axis| {
            let mut sum = moment::moment(trial, positions, i, axis);
            let (along, sign) = if axis == axes[0] { (axes[1], 0.5) } else { (axes[0], -0.5) };
            sum.add_scaled_difference(-sign, positions[q][along], positions[p][along]);
            sum.value().abs()
        });
        scan.look((i, axis, [p, q]), residual, threshold);
    }
    if scan.is_empty() {
        return Verdict::not_applicable(if left_out == 0 {
            "there is no boundary"
        } else {
            "no boundary vertex has the neighbourhood of a manifold with boundary"
        });
    }
    let verdict = scan.verdict(
        Level::Measured,
        |&(i, ..)| vec![i],
        |found| {
            let (i, axis, pq) = found.place;
            moment::witness(trial, (i, axis), axes, Some(pq), found.threshold.defect)
        },
    );
    match left_out {
        0 => verdict,
        n => verdict.with_note(format!("{n} boundary vertices were left out: not manifold, or at a degenerate face")),
    }
}

/// The vertices before and after a boundary vertex, the surface to the left of a counter-clockwise boundary.
fn boundary_neighbours(trial: &Trial, surface: &Surface, i: usize) -> Option<[usize; 2]> {
    if !is_proper_star(trial, surface, i, 2) {
        return None;
    }
    let on_boundary = |v: usize| {
        let edge = surface.topology().edge_between(i, v);
        edge.is_some_and(|e| surface.topology().is_boundary_edge(e))
    };
    let (mut before, mut after) = (None, None);
    for corner in surface.topology().star(i) {
        let [next, previous] = corner.neighbours(surface.faces());
        if on_boundary(next) {
            after = Some(next);
        }
        if on_boundary(previous) {
            before = Some(previous);
        }
    }
    Some([before?, after?])
}
