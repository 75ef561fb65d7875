//! LIN: linear functions are harmonic where the surface is flat.
//!
//! # Definition
//! `Σ_j L_ij (x_j − x_i) = 0` for every coordinate x: on planar surfaces at every interior vertex, on surfaces in space at the
//! interior vertices whose star is flat (coplanar by an exact predicate, and unfolded), on volumes at every interior vertex.
//! # Limitations
//! Vertices with a degenerate face, or without the neighbourhood of a manifold, are left out: there the sum does not close
//! up. So are, in space, rows with entries beyond the flat star: those coordinates are not linear functions of the surface.

use super::measure::moment::{self, is_flat_star, is_proper_star};
use super::measure::scan::Scan;
use super::verdict::Level;
use super::{Property, Question, Trial, Verdict};
use crate::domain::Domain;
use crate::linalg::parallel;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "LIN",
    name: "linear precision",
    statement: "Σ_j L_ij (x_j − x_i) = 0 for every coordinate x at interior vertices whose star is flat",
    sources: &["wardetzky2007"],
    question: Question::Operator(check),
};

fn check(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let Some(positions) = trial.domain.positions() else {
        return Verdict::not_applicable("a graph has no coordinates");
    };
    let Places { vertices, axes, plane } = match trial.domain {
        Domain::Points(_) => return Verdict::not_applicable("a point cloud has no interior and no flat stars"),
        domain => places(trial, domain),
    };
    let interior = trial.domain.boundary().iter().filter(|b| !**b).count();
    if vertices.is_empty() {
        return Verdict::not_applicable(match interior {
            0 => "there is no interior vertex".to_string(),
            n => format!("none of the {n} interior vertices has a flat and regular star that its row stays within"),
        });
    }
    // Computed before threads ask for them.
    trial.scales();
    let scan = Scan::over(vertices.len(), |at, scan: &mut Scan<(usize, usize)>| {
        let i = vertices[at];
        let threshold = moment::threshold(trial, positions, i, 0.0);
        let size = |axis: usize| moment::moment(trial, positions, i, axis).value().abs();
        let (axis, residual) = worst(&axes, size);
        scan.look((i, axis), residual, threshold);
    });
    let looked_at = vertices.len();
    scan.verdict(
        Level::Measured,
        |&(i, _)| vec![i],
        |found| moment::witness(trial, found.place, plane, None, found.threshold.defect),
    )
    .with_note(format!("looked at {looked_at} of {interior} interior vertices: those with a flat star"))
}

/// The axis with the largest residual, the first of equals.
pub(super) fn worst(axes: &[usize], residual: impl Fn(usize) -> f64) -> (usize, f64) {
    axes.iter().map(|&axis| (axis, residual(axis))).fold((axes[0], -1.0), |w, a| if a.1 > w.1 { a } else { w })
}

/// Where LIN says something, for which coordinates, and the plane where there is one.
struct Places {
    vertices: Vec<usize>,
    axes: Vec<usize>,
    plane: [usize; 2],
}

fn places(trial: &Trial, domain: &Domain) -> Places {
    match domain {
        Domain::Surface(surface) => {
            let plane = moment::oriented_axes(surface);
            let (boundary, _) = (domain.boundary(), (trial.scales(), trial.stencil()));
            let flat = |i: usize| {
                !boundary[i]
                    && is_proper_star(trial, surface, i, 0)
                    && (plane.is_some() || (is_flat_star(surface, i) && !trial.scales().leaves_stencil(i)))
            };
            let flat = parallel::collect(boundary.len(), flat);
            Places {
                vertices: (0..flat.len()).filter(|&i| flat[i]).collect(),
                axes: plane.map_or(vec![0, 1, 2], |p| p.to_vec()),
                plane: plane.unwrap_or([0, 1]),
            }
        }
        Domain::Volume(volume) => {
            let proper = moment::proper_balls(volume);
            let vertices = domain.interior().into_iter().filter(|&i| proper[i]).collect();
            Places { vertices, axes: vec![0, 1, 2], plane: [0, 1] }
        }
        _ => Places { vertices: Vec::new(), axes: vec![0], plane: [0, 1] },
    }
}
