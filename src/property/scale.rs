//! SCALE: stiffness has no unit on a surface, mass that of an area.
//!
//! # Definition
//! With coordinates multiplied by s: `L(sX) = s^(d−2) L(X)` and `M(sX) = s^d M(X)`, d = 2 on surfaces, 3 in volumes: the Dirichlet energy
//! of a function and the integral of one.
//!
//! # Decision
//! s = 2, which is exact, and s = 3, whose rounding displaces vertices by `u` times their coordinates. A construction that scales
//! otherwise (mean value coordinates: weights are inverse lengths) fails; the exponent found is noted.
//!
//! # Exception
//! Not applicable to graphs, which have no positions, and to point clouds, which have no dimension of their own.

use super::relate::image::{Image, moved};
use super::relate::relation;
use super::tolerance::UNIT_ROUNDOFF;
use super::{Construction, Property, Question, Status, Trial, Verdict};
use crate::domain::Domain;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "SCALE",
    name: "behaviour under scaling",
    statement: "L(sX) = s^(d−2) L(X), M(sX) = s^d M(X), d the dimension: stiffness of a surface unchanged, mass times s²",
    sources: &[],
    question: Question::Construction(decide),
};

fn decide(trial: &Trial, construction: &Construction) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let dimension = match trial.domain {
        Domain::Surface(_) => 2,
        Domain::Volume(_) => 3,
        Domain::Graph(_) => return Verdict::not_applicable("a graph has no positions"),
        Domain::Points(_) => return Verdict::not_applicable("a point cloud has no dimension of its own"),
    };
    let images: Result<Vec<Image>, String> = [2.0, 3.0].iter().map(|&s| image(trial.domain, s, dimension)).collect();
    let verdict = match images {
        Ok(images) => relation::decide(trial, construction, images),
        Err(why) => return Verdict::not_applicable(why),
    };
    match verdict.status() {
        Status::Fails => exponents(trial, construction).into_iter().fold(verdict, Verdict::with_note),
        _ => verdict,
    }
}

fn image(domain: &Domain, s: f64, dimension: i32) -> Result<Image, String> {
    let scaled = scaled(domain, s)?;
    let largest = domain.positions().unwrap_or(&[]).iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    // Multiplying by two is exact; otherwise each of three coordinates is off by u times its value.
    let displaced = if s == 2.0 { 0.0 } else { 2.0 * UNIT_ROUNDOFF * largest };
    let mut image = Image::new(format!("scaling by {s}"), scaled).displaced(displaced);
    (image.stiffness, image.mass) = (s.powi(dimension - 2), s.powi(dimension));
    Ok(image)
}

fn scaled(domain: &Domain, s: f64) -> Result<Domain, String> {
    moved(domain, |_, p| p.map(|x| s * x), |n| n, false).unwrap_or_else(|| Err("the domain has no positions".into()))
}

/// The exponents of s that the construction shows at s = 2, if all rows agree on them.
fn exponents(trial: &Trial, construction: &Construction) -> Option<String> {
    let after = construction(&scaled(trial.domain, 2.0).ok()?).ok()?;
    let exponent = |before: &crate::linalg::Csr, now: &crate::linalg::Csr| {
        let (before, now) = (before.row_scales(), now.row_scales());
        let found: Vec<f64> =
            before.iter().zip(&now).filter(|(b, n)| **b > 0.0 && **n > 0.0).map(|(b, n)| (n / b).log2()).collect();
        let first = *found.first()?;
        let spread = found.iter().map(|e| (e - first).abs()).fold(0.0, f64::max);
        Some(if spread < 1e-6 { format!("s^{first:.3}") } else { "no power of s".to_string() })
    };
    let stiffness = exponent(trial.operator.stiffness(), after.stiffness())?;
    let mass = trial.operator.mass().zip(after.mass()).and_then(|(b, n)| exponent(b.matrix(), n.matrix()));
    Some(match mass {
        Some(mass) => format!("found: stiffness times {stiffness}, mass times {mass}"),
        None => format!("found: stiffness times {stiffness}"),
    })
}
