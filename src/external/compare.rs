//! Two operators on one domain, entry by entry, within the bound that the mesh's conditioning sets.
//!
//! # Stiffness
//! The bound at a place is the sum of both matrices' own, see [`tolerance`](crate::property::tolerance).
//!
//! # Mass
//! An area is off by a relative `32 Q u` at most, Q = 1/sin θ_min, and an entry of the consistent, barycentric and mixed mass is
//! a sum of m positive shares of areas at vertex i: it is off by `(4m + 32 Q_i) u` of itself, as a row of the stiffness matrix is.
//! The circumcentric parts `⅛ b² cot β` of the Voronoi mass are not all positive: each is off by `⅛ b² · 8u/sin²β = u D²`, D the
//! circumdiameter, two for each triangle, which adds `4u Σ D²` over the star for both matrices together. It holds for a mass that
//! does not say which one it is, and for the mixed mass in triangles that are not obtuse, where its parts are the same.

use std::fmt;

use serde::Serialize;

use crate::domain::Domain;
use crate::linalg::Csr;
use crate::operator::{Mass, MassKind, Operator};
use crate::property::tolerance::{Judgement, Scales, Threshold, UNIT_ROUNDOFF};

/// How the entries of two stiffness matrices, or two mass matrices, compare.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// The label of the operator compared with.
    pub against: String,
    /// Places where either matrix has a non-zero entry.
    pub entries: usize,
    /// Places with equal bits.
    pub identical: usize,
    /// Places whose difference the rounding of two good implementations explains.
    pub explained: usize,
    /// Places whose difference only a poor but correct implementation explains.
    pub open: usize,
    /// Places whose difference no correct implementation explains.
    pub beyond: usize,
    /// The place that differs by most multiples of the bound.
    pub worst: Option<Difference>,
}

/// A place where two matrices differ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// Row.
    pub i: usize,
    /// Column.
    pub j: usize,
    /// The entry of the operator on trial.
    pub theirs: f64,
    /// The entry of the operator compared with.
    pub ours: f64,
    /// The difference over what the rounding of two good implementations explains.
    pub multiples: f64,
}

/// Compares the stiffness matrices of two operators on a domain. Cost: O(nnz log).
pub fn compare(domain: &Domain, theirs: &Operator, ours: &Operator, against: &str) -> Comparison {
    let (a, b) = (theirs.stiffness(), ours.stiffness());
    let (of_a, of_b) = (Scales::of(domain, a), Scales::of(domain, b));
    compare_entries(a, b, against, |i, j, x, y| {
        let edge = domain.edges().binary_search(&[i.min(j), i.max(j)]).ok();
        of_a.entry(i, x, edge).plus(of_b.entry(i, y, edge))
    })
}

/// Compares the mass matrices of two operators on a domain; ours says of which kind both are meant to be. Cost: O(nnz log + F).
pub fn compare_mass(domain: &Domain, theirs: &Mass, ours: &Mass, against: &str) -> Comparison {
    let scales = Scales::of(domain, ours.matrix());
    let circumscribed = circumscribed(domain, |obtuse| match ours.kind() {
        MassKind::Voronoi | MassKind::Given => true,
        MassKind::Mixed => !obtuse,
        _ => false,
    });
    let mut valence = vec![1; ours.size()];
    for &[i, j] in domain.edges() {
        valence[i] += 1;
        valence[j] += 1;
    }
    compare_entries(theirs.matrix(), ours.matrix(), against, |i, j, x, y| {
        let q = scales.condition(i).max(scales.condition(j));
        let both = Threshold::over(x.abs() + y.abs(), valence[i], q);
        let explained = if i == j { 4.0 * UNIT_ROUNDOFF * circumscribed[i] } else { 0.0 };
        both.plus(Threshold { explained, defect: 4.0 * q * explained })
    })
}

/// At each vertex the sum of the squared circumdiameters of those of its triangles that count, `D = abc / 2A`.
fn circumscribed(domain: &Domain, counts: impl Fn(bool) -> bool) -> Vec<f64> {
    let mut sums = vec![0.0; domain.vertex_count()];
    let Some(surface) = domain.as_surface() else { return sums };
    for face in 0..surface.faces().len() {
        let (Some(corners), area) = (surface.triangle(face), surface.face_area(face)) else { continue };
        let [a, b, c] = corners.map(|v| surface.point(v));
        let mut sides = [(c - b).norm(), (a - c).norm(), (b - a).norm()];
        sides.sort_by(f64::total_cmp);
        let [a, b, c] = sides;
        // A right angle is not obtuse, and rounding may take it for either: there both shares are the same.
        if area > 0.0 && counts((a / c).powi(2) + (b / c).powi(2) < 1.0) {
            // In this order neither product nor quotient leaves the range of `f64` before D does.
            let diameter = a / (2.0 * area) * b * c;
            corners.iter().for_each(|&v| sums[v] += diameter * diameter);
        }
    }
    sums
}

/// Compares two matrices of one size; `bound(i, j, x, y)` is the threshold of `x − y` at (i, j).
fn compare_entries(
    theirs: &Csr,
    ours: &Csr,
    against: &str,
    bound: impl Fn(usize, usize, f64, f64) -> Threshold,
) -> Comparison {
    let mut comparison = Comparison {
        against: against.to_string(),
        entries: 0,
        identical: 0,
        explained: 0,
        open: 0,
        beyond: 0,
        worst: None,
    };
    for i in 0..theirs.rows().min(ours.rows()) {
        let mut columns: Vec<usize> =
            theirs.row(i).chain(ours.row(i)).filter(|(_, v)| **v != 0.0).map(|(j, _)| j).collect();
        columns.sort_unstable();
        columns.dedup();
        for j in columns {
            let (x, y) = (theirs.at(i, j), ours.at(i, j));
            let threshold = bound(i, j, x, y);
            let residual = (x - y).abs();
            comparison.entries += 1;
            match threshold.judge(residual) {
                _ if x == y => comparison.identical += 1,
                Judgement::Explained => comparison.explained += 1,
                Judgement::Open => comparison.open += 1,
                Judgement::Defect => comparison.beyond += 1,
            }
            let multiples = threshold.margin(residual);
            if multiples > comparison.worst.as_ref().map_or(0.0, |w| w.multiples) {
                comparison.worst = Some(Difference { i, j, theirs: x, ours: y, multiples });
            }
        }
    }
    comparison
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "against {}: {} entries, {} identical, {} within the bound of the mesh, {} that only a poor algorithm \
             explains, {} beyond",
            self.against, self.entries, self.identical, self.explained, self.open, self.beyond
        )?;
        match &self.worst {
            None => Ok(()),
            Some(w) => write!(
                f,
                "\n  worst at ({}, {}): {} against {}, {:.3} times the bound",
                w.i, w.j, w.theirs, w.ours, w.multiples
            ),
        }
    }
}
