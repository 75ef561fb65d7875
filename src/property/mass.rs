//! MASS: the mass matrix is an inner product that measures the area.
//!
//! # Definition
//! * `M = Mᵀ`, and `xᵀMx > 0` for all x ≠ 0 (a diagonal by its signs, a full matrix by its pivots after scaling by
//!   `M_ii^(−1/2)`). Vertices without any area around them, or without an edge, have no mass and are left out.
//! * On surfaces `1ᵀM1 = area`, and the share `Σ_j M_ij` of each vertex lies within the bounds that its star sets (see
//!   [`shares`](super::measure::shares)): a permuted or misplaced mass has the right total. A mass that says which one it is must have
//!   the very shares of that one. Of a given mass it is told which it looks like; where nine tenths of the shares are those
//!   of a known mass and one is not, though possible, the verdict is open.

use super::evidence::{Evidence, Statement};
use super::excerpt;
use super::measure::compensated::Sum;
use super::measure::row;
use super::measure::scan::{Finding, Scan};
use super::measure::shares::{self, Share};
use super::tolerance::{Judgement, LARGEST_EXPLAINED, Threshold, UNIT_ROUNDOFF};
use super::verdict::{Level, Status};
use super::{Property, Question, Trial, Verdict};
use crate::domain::{Domain, Surface};
use crate::linalg::Csr;
use crate::linalg::factor::{Ldlt, negative_direction};
use crate::operator::{Mass, MassKind};

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "MASS",
    name: "mass matrix",
    statement: "M symmetric positive definite; on surfaces 1ᵀM1 = area and each share Σ_j M_ij within the bounds of its star",
    sources: &["meyer2003"],
    question: Question::Operator(check),
};

/// The scaled matrix is taken for positive definite if all its eigenvalues exceed this; far above the rounding of a
/// factorisation with unit diagonal, far below the ½ of the consistent mass.
const SMALLEST_EIGENVALUE: f64 = 1.0 / 1_073_741_824.0;

fn check(trial: &Trial) -> Verdict {
    let Some(mass) = trial.operator.mass() else {
        return Verdict::not_applicable("the operator has no mass matrix");
    };
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let surface = trial.domain.as_surface().filter(|s| shares::has_planar_faces(s));
    let shares = surface.map(|s| shares::of(s, trial.scales()));
    let mut parts = vec![symmetric(trial, mass), positive(trial, mass, shares.as_deref())];
    if let (Some(surface), Some(shares)) = (surface, &shares) {
        parts.push(total(trial, mass, surface));
        parts.push(shared_out(trial, mass, surface, shares));
    }
    let kind = if mass.is_lumped() { "lumped mass" } else { "full mass" };
    let verdict = strictest(parts).with_note(kind);
    match trial.domain {
        Domain::Surface(_) if surface.is_none() => {
            verdict.with_note("a polygon is not planar, its area a convention: total and shares were not compared")
        }
        Domain::Surface(_) => verdict,
        _ => verdict.with_note("the domain has no area: total and shares were not compared"),
    }
}

/// The first failing part, else the first open one, else the last; with the largest margin and all notes.
fn strictest(parts: Vec<Verdict>) -> Verdict {
    let notes: Vec<String> = parts.iter().flat_map(|v| v.notes.clone()).collect();
    let margin = parts.iter().filter_map(|v| v.margin).fold(0.0, f64::max);
    let rank = |v: &Verdict| match v.status() {
        Status::Fails => 2,
        Status::Undecided => 1,
        _ => 0,
    };
    let worst =
        parts.into_iter().reduce(|a, b| if rank(&b) > rank(&a) || (rank(&b), rank(&a)) == (0, 0) { b } else { a });
    let mut verdict = worst.unwrap_or_else(|| Verdict::not_applicable("nothing to look at"));
    verdict.notes = notes;
    if rank(&verdict) == 0 { verdict.with_margin(margin) } else { verdict }
}

fn symmetric(trial: &Trial, mass: &Mass) -> Verdict {
    let matrix = mass.matrix();
    let mut scan = Scan::new();
    for i in (0..matrix.rows()).filter(|&i| matrix.row_slices(i).0 != [i]) {
        for (j, &v) in matrix.row(i).filter(|&(j, _)| i != j) {
            let opposite = matrix.at(j, i);
            if i > j && opposite != 0.0 {
                continue;
            }
            let q = trial.scales().condition(i).max(trial.scales().condition(j));
            scan.look([i, j], (v - opposite).abs(), Threshold::over(v.abs().max(opposite.abs()), 1, q));
        }
    }
    scan.verdict(
        Level::Measured,
        |place| place.to_vec(),
        |found| {
            let [i, j] = found.place;
            let statement = Statement::MassAsymmetry { i, j, threshold: found.threshold.defect };
            Evidence::new(statement, excerpt::of_mass_rows(matrix, &[i, j]))
        },
    )
}

/// The vertices that must have mass: with area around them on a surface, with an edge on other meshes, all of a cloud.
fn massive(trial: &Trial, shares: Option<&[Share]>) -> Vec<usize> {
    let connected = |&i: &usize| !trial.stencil().neighbours(i).is_empty();
    match (shares, trial.domain) {
        (Some(shares), _) => (0..shares.len()).filter(|&i| shares[i].star > 0.0).collect(),
        (None, Domain::Points(p)) => (0..p.positions().len()).collect(),
        (None, domain) => (0..domain.vertex_count()).filter(connected).collect(),
    }
}

fn positive(trial: &Trial, mass: &Mass, shares: Option<&[Share]>) -> Verdict {
    let vertices = massive(trial, shares);
    let scan = Scan::over(vertices.len(), |at, scan: &mut Scan<usize>| {
        let i = vertices[at];
        let d = mass.matrix().at(i, i);
        let (residual, threshold) = match (d, shares) {
            (d, _) if d > 0.0 => (0.0, Threshold::NONE),
            (d, Some(shares)) if d < 0.0 => {
                (-d, Threshold { explained: 0.0, defect: shares[i].voronoi_threshold.explained })
            }
            _ => (f64::INFINITY, Threshold::NONE),
        };
        scan.look(i, residual, threshold);
    });
    let witness = |x: Vec<(usize, f64)>| {
        let support: Vec<usize> = x.iter().map(|&(i, _)| i).collect();
        Evidence::new(Statement::MassNotPositive { x }, excerpt::of_mass_rows(mass.matrix(), &support))
    };
    let signs = scan.verdict(Level::Exact, |&i| vec![i], |found| witness(vec![(found.place, 1.0)]));
    let signs = match mass.size() - vertices.len() {
        0 => signs,
        n => signs.with_note(format!("{n} vertices without area or edges were left out of positivity")),
    };
    if mass.is_lumped() || signs.status() != Status::Holds {
        return signs;
    }
    let verdict = match definite(mass.matrix(), &vertices) {
        Definite::Yes => Verdict::holds(
            Level::Measured,
            Evidence::bare(Statement::Scan { checked: vertices.len(), worst: Vec::new() }),
        ),
        Definite::No(x) => Verdict::fails(Level::Exact, witness(x)),
        Definite::Open(why) => Verdict::undecided(why),
    };
    signs.notes.into_iter().fold(verdict, Verdict::with_note)
}

/// Whether a full matrix is positive definite on some of its rows.
enum Definite {
    Yes,
    No(Vec<(usize, f64)>),
    Open(String),
}

/// Factorises the matrix scaled to unit diagonal, whose diagonal must be positive.
fn definite(matrix: &Csr, vertices: &[usize]) -> Definite {
    let root: Vec<f64> = vertices.iter().map(|&i| matrix.at(i, i).sqrt()).collect();
    let scaled = matrix.submatrix(vertices, vertices).map(|i, j, v| v / root[i] / root[j]).symmetric_part();
    let shift = Csr::diagonal(&vec![-SMALLEST_EIGENVALUE; vertices.len()]);
    if Ldlt::new(&scaled.add(&shift)).is_ok_and(|f| f.pivots().iter().all(|&d| d > 0.0)) {
        return Definite::Yes;
    }
    if let Ok(Some(y)) = negative_direction(&scaled) {
        let x: Vec<f64> = y.iter().zip(&root).map(|(y, root)| y / root).collect();
        let (mut value, mut size) = (Sum::default(), 0.0);
        for (at, &i) in vertices.iter().enumerate() {
            for (j, &v) in matrix.row(i) {
                let Ok(other) = vertices.binary_search(&j) else { continue };
                value.add_triple(x[at], v, x[other]);
                size += (x[at] * v * x[other]).abs();
            }
        }
        // Twice the working precision: the value is good to about n² u² of the magnitudes.
        if value.value() < -UNIT_ROUNDOFF * LARGEST_EXPLAINED * size {
            let x = vertices.iter().copied().zip(x).filter(|&(_, x)| x != 0.0).collect();
            return Definite::No(x);
        }
    }
    Definite::Open(format!(
        "after scaling to unit diagonal the smallest eigenvalue of M is not above {SMALLEST_EIGENVALUE:.1e}, and no direction of \
         negative energy was found"
    ))
}

fn total(trial: &Trial, mass: &Mass, surface: &Surface) -> Verdict {
    let (area, mut threshold) = trial.area(surface);
    for i in 0..mass.size() {
        let values = mass.matrix().row_slices(i).1;
        let size = values.iter().map(|v| v.abs()).sum();
        threshold = threshold.plus(Threshold::over(size, values.len(), trial.scales().condition(i)));
    }
    threshold.explained = threshold.explained.min(LARGEST_EXPLAINED * area);
    let found = mass.matrix().values().iter().copied().collect::<Sum>().value();
    let mut scan = Scan::new();
    scan.look((), (found - area).abs(), threshold);
    let verdict = scan.verdict(
        Level::Measured,
        |()| Vec::new(),
        |worst| {
            let statement = Statement::MassTotal { found, expected: area, threshold: worst.threshold.defect };
            Evidence::new(statement, excerpt::of_mass_and_mesh(trial, mass.matrix()))
        },
    );
    let note = format!("total {found:?}, area {area:?}");
    if verdict.status() == Status::Holds || area == 0.0 {
        verdict.with_note(note)
    } else {
        verdict.with_note(format!("{note}: {:.3} ×", found / area))
    }
}

/// A known way to share out the area.
struct Known {
    name: &'static str,
    kinds: &'static [MassKind],
    share: fn(&Share) -> f64,
    threshold: fn(&Share) -> Threshold,
}

const KNOWN: [Known; 3] = [
    Known {
        name: "barycentric or consistent",
        kinds: &[MassKind::Barycentric, MassKind::Consistent],
        share: |s| s.third,
        threshold: |s| s.threshold,
    },
    Known { name: "mixed", kinds: &[MassKind::Mixed], share: |s| s.mixed, threshold: |s| s.threshold },
    Known { name: "voronoi", kinds: &[MassKind::Voronoi], share: |s| s.voronoi, threshold: |s| s.voronoi_threshold },
];

impl Known {
    /// Whether the share of a vertex is that of this mass.
    fn has(&self, s: &Share, found: f64) -> bool {
        (self.threshold)(s).judge((found - (self.share)(s)).abs()) != Judgement::Defect
    }
}

fn shared_out(trial: &Trial, mass: &Mass, surface: &Surface, shares: &[Share]) -> Verdict {
    let found = row::compensated_sums(mass.matrix());
    let known = |k: &&Known| surface.is_triangulated() && k.kinds.contains(&mass.kind());
    let declared = KNOWN.iter().find(known);
    let scan = Scan::over(shares.len(), |i, scan: &mut Scan<(usize, [f64; 2])>| {
        let s = &shares[i];
        let (bounds, threshold) = match declared {
            Some(k) => ([(k.share)(s); 2], (k.threshold)(s)),
            None => ([s.lower, s.upper], s.voronoi_threshold),
        };
        let outside = (bounds[0] - found[i]).max(found[i] - bounds[1]).max(0.0);
        scan.look((i, bounds), outside, threshold);
    });
    let verdict = scan.verdict(
        Level::Measured,
        |&(i, _)| vec![i],
        |worst: &Finding<(usize, [f64; 2])>| {
            let (i, [lower, upper]) = worst.place;
            let slack = worst.threshold.defect;
            let statement = Statement::MassShare { i, lower: lower - slack, upper: upper + slack };
            let excerpt = excerpt::of_mass_rows(mass.matrix(), &[i]).with_star(trial, i).with_corners(trial);
            Evidence::new(statement, excerpt)
        },
    );
    match declared {
        Some(k) => verdict.with_note(format!("shares compared with those of the {} mass", k.name)),
        None if surface.is_triangulated() => resemblance(verdict, shares, &found),
        None => verdict,
    }
}

/// Says which known mass an unknown one looks like; leaves open a holding verdict if only a tenth of the shares or less are not.
fn resemblance(verdict: Verdict, shares: &[Share], found: &[f64]) -> Verdict {
    let matches = |k: &Known| shares.iter().zip(found).filter(|(s, f)| k.has(s, **f)).count();
    let Some((best, count)) = KNOWN.iter().map(|k| (k, matches(k))).reduce(|a, b| if b.1 > a.1 { b } else { a }) else {
        return verdict;
    };
    if count == shares.len() {
        return verdict.with_note(format!("looks like the {} mass", best.name));
    }
    let odd = (0..shares.len()).find(|&i| !best.has(&shares[i], found[i]));
    match odd {
        Some(i) if verdict.status() == Status::Holds && 10 * count >= 9 * shares.len() => {
            let mut open = Verdict::undecided(format!(
                "{count} of {} shares are those of the {} mass; at vertex {i} the share is {:?}, where that mass has {:?}",
                shares.len(),
                best.name,
                found[i],
                (best.share)(&shares[i])
            ));
            open.margin = verdict.margin;
            open.tally = verdict.tally;
            open
        }
        _ => verdict.with_note(format!("{count} of {} shares are those of the {} mass", shares.len(), best.name)),
    }
}
