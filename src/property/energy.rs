//! ENERGY: the Dirichlet energy of the coordinates is the area.
//!
//! # Definition
//! `E(x, y) = ½ Σ_{i≠j} ω_ij (x_i − x_j)(y_i − y_j)`, which for a symmetric L with vanishing row sums is `xᵀLy`. With X the
//! coordinates, `E(X, X) = area·I₂` on planar surfaces and `tr E(X, X) = 2·area` on surfaces in space. It sees a global factor,
//! an affine stretch and a wrong corner, which no other property of the matrix sees.
//!
//! The form in differences is local, blind to where the mesh lies, and defined for every matrix; what it leaves out, row
//! sums and asymmetry, is the business of NULL and SYM.
//! # Limitations
//! Polygon surfaces in space must have planar faces (decided exactly): else their area is a convention.

use super::evidence::{Evidence, Statement};
use super::excerpt;
use super::measure::compensated::Sum;
use super::measure::condition::Shape;
use super::measure::condition::distance;
use super::measure::moment::oriented_axes;
use super::measure::scan::Scan;
use super::measure::shares;
use super::tolerance::{LARGEST_EXPLAINED, Threshold};
use super::verdict::Level;
use super::{Property, Question, Trial, Verdict};
use crate::domain::{Domain, Surface};
use crate::linalg::parallel;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "ENERGY",
    name: "energy of the coordinates",
    statement: "½ Σ_{i≠j} ω_ij (x_i − x_j)(x_i − x_j)ᵀ = area·I₂ on planar surfaces; its trace is 2·area on surfaces in space",
    sources: &["pinkall-polthier1993"],
    question: Question::Operator(check),
};

/// An entry of the energy of the coordinates, or its trace.
#[derive(Clone, Copy)]
struct Place {
    axis: usize,
    other: usize,
    trace: bool,
    found: f64,
    expected: f64,
}

fn check(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let Domain::Surface(surface) = trial.domain else {
        return Verdict::not_applicable(format!("ENERGY is about surfaces, not a {}", trial.domain.kind()));
    };
    let plane = oriented_axes(surface);
    if plane.is_none() && !shares::has_planar_faces(surface) {
        return Verdict::not_applicable("the surface has a polygon that is not planar: its area is a convention");
    }
    let (area, area_threshold) = trial.area(surface);
    if area == 0.0 {
        return Verdict::not_applicable("the surface has no area");
    }
    let (energies, rounding) = match plane {
        Some([a, b]) => energies(trial, surface, |sums: &mut [Sum; 3], w, d| {
            sums[0].add_triple(d[a], w, d[a]);
            sums[1].add_triple(d[b], w, d[a]);
            sums[2].add_triple(d[b], w, d[b]);
        }),
        None => energies(trial, surface, |sums, w, d| {
            let mut square = Sum::default();
            d.into_iter().for_each(|d| square.add_product(d, d));
            sums[0].add_multiple(w, square);
        }),
    };
    let [first, second, third] = energies.map(Sum::value);
    let threshold = |expected: f64| {
        let t = rounding.plus(area_threshold);
        // On bad slivers the worst case exceeds the area itself: nothing above a share of it is called explained.
        Threshold { explained: t.explained.min(LARGEST_EXPLAINED * expected), defect: t.defect }
    };
    let mut scan = Scan::new();
    match plane {
        Some(axes) => {
            let [a, b] = axes;
            // The energy of (b, a) is that of (a, b), bit for bit.
            for (axis, other, found) in [(a, a, first), (a, b, second), (b, a, second), (b, b, third)] {
                let expected = if axis == other { area } else { 0.0 };
                let place = Place { axis, other, trace: false, found, expected };
                scan.look(place, (found - expected).abs(), threshold(area));
            }
        }
        None => {
            let found = first;
            let place = Place { axis: 0, other: 0, trace: true, found, expected: 2.0 * area };
            scan.look(place, (found - 2.0 * area).abs(), threshold(2.0 * area));
        }
    }
    let mut factor = None;
    let verdict = scan.verdict(
        Level::Measured,
        |p| if p.trace { Vec::new() } else { vec![p.axis, p.other] },
        |worst| {
            let Place { axis, other, trace, found, expected } = worst.place;
            factor = (expected > 0.0).then(|| found / expected);
            let (threshold, star) = (worst.threshold.defect, most_suspect(trial, surface));
            let statement = Statement::Energy { axis, other, trace, found, expected, threshold, star };
            Evidence::new(statement, excerpt::of_stiffness_and_mesh(trial))
        },
    );
    match factor {
        Some(factor) => verdict.with_note(format!("the energy is {factor:.3} × the expected")),
        None => verdict,
    }
}

/// Sums `½ Σ_{i≠j} ω_ij f(x_i − x_j)` in twice the working precision, `add` telling what a difference adds with its factor, and what
/// rounding explains of an energy: that of each row, over the energies of its edges. All in one pass over the matrix, the blocks in order.
fn energies(
    trial: &Trial,
    surface: &Surface,
    add: impl Fn(&mut [Sum; 3], f64, [f64; 3]) + Sync + Send,
) -> ([Sum; 3], Threshold) {
    let (matrix, scales, positions) = (trial.operator.stiffness(), trial.scales(), surface.positions());
    let block = |rows: std::ops::Range<usize>| {
        let (mut sums, mut rounding) = ([Sum::default(); 3], Threshold::NONE);
        for i in rows {
            let (p, mut size) = (positions[i], 0.0);
            for (j, &v) in matrix.row(i).filter(|&(j, _)| j != i) {
                let q = positions[j];
                let d = [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
                size += v.abs() * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                add(&mut sums, -0.5 * v, d);
            }
            rounding = rounding.plus(scales.combination(i, 0.5 * size));
        }
        (sums, rounding)
    };
    let (mut sums, mut rounding) = ([Sum::default(); 3], Threshold::NONE);
    for (found, explained) in parallel::blocks(matrix.rows(), block) {
        sums.iter_mut().zip(found).for_each(|(sum, found)| sum.add_sum(found));
        rounding = rounding.plus(explained);
    }
    (sums, rounding)
}

/// The vertex whose row accounts for most of what is wrong: its share `½ Σ_j ω_ij |x_i − x_j|²` of the trace against twice
/// the signed circumcentric area around it, which is what the cotangent Laplacian has; with polygons, the largest share.
fn most_suspect(trial: &Trial, surface: &Surface) -> usize {
    let mut wrong = vec![0.0; surface.positions().len()];
    for (i, j, v) in trial.operator.stiffness().entries() {
        wrong[i] -= 0.5 * v * distance(surface.positions()[i], surface.positions()[j]).powi(2);
    }
    if surface.is_triangulated() {
        for (face, corners) in surface.faces().iter().enumerate() {
            let Some(shape) = Shape::of_face(surface, face) else { continue };
            for (corner, &v) in corners.iter().enumerate() {
                wrong[v] -= 2.0 * shares::voronoi(&shape, corner);
            }
        }
    }
    (0..wrong.len()).fold(0, |worst, i| if wrong[i].abs() > wrong[worst].abs() { i } else { worst })
}
