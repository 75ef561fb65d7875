//! MAX-global with a negative weight, on a triangulation of whole points: the harmonic extension computed again, exactly.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use super::alone::check_exact;
use super::planar::{Planar, Upper, entry};
use super::{Answer, Rechecked, Refusal, bareiss};
use crate::property::evidence::{Excerpt, Row};
use crate::scalar::{Rational, Scalar};

/// The weight of an interior edge with an end inside is negative, and the harmonic extension from the boundary positive.
pub(super) fn decide(excerpt: &Excerpt, [i, j]: [usize; 2], weight: &str, smallest: &str) -> Answer {
    let mesh = Planar::read(excerpt)?;
    let boundary: BTreeSet<usize> = mesh.outline()?.into_iter().collect();
    let inside: Vec<usize> = (0..mesh.points.len()).filter(|v| !boundary.contains(v)).collect();
    let edge = mesh.faces.iter().any(|f| f.contains(&i) && f.contains(&j)) && i < j;
    if !edge || !(inside.contains(&i) || inside.contains(&j)) {
        return Err(Refusal::untrue(format!("({i}, {j}) is an edge with an end inside, i < j"), "it is not"));
    }
    let l = mesh.stiffness();
    check_rows(&l, &excerpt.rows, mesh.points.len())?;
    let omega = -entry(&l, i, j);
    check_exact(&format!("ω of the edge ({i}, {j})"), weight, &omega)?;
    if omega.cmp_zero() != Ordering::Less {
        return Err(Refusal::untrue(format!("ω of the edge ({i}, {j}) is negative"), weight));
    }
    if inside.len() > bareiss::LARGEST {
        return Ok(Rechecked::Open(format!("{} unknowns are too many for exact elimination", inside.len())));
    }
    let rows: Vec<Vec<(usize, Rational)>> =
        inside.iter().map(|&k| inside.iter().enumerate().map(|(c, &m)| (c, entry(&l, k, m))).collect()).collect();
    let mut least: Option<Rational> = None;
    for &source in &boundary {
        let right: Vec<Rational> = inside.iter().map(|&k| -entry(&l, k, source)).collect();
        for at in 0..inside.len() {
            let Some(value) = bareiss::component(&rows, &right, at) else {
                return Err(Refusal::untrue("the Dirichlet problem has one solution", "L_II is singular"));
            };
            least = Some(match least {
                Some(least) if least <= value => least,
                _ => value,
            });
        }
    }
    let least = least.unwrap_or_else(Rational::zero);
    check_exact("the smallest entry of the extension", smallest, &least)?;
    if least.cmp_zero() == Ordering::Greater {
        return Ok(Rechecked::Exact);
    }
    Err(Refusal::untrue("every entry of the extension is positive", smallest))
}

/// Refuses rows that are not those of the matrix, rounded.
fn check_rows(l: &Upper, rows: &[Row], size: usize) -> Result<(), Refusal> {
    if rows.len() != size {
        return Err(Refusal::untrue(format!("there are {size} rows"), rows.len().to_string()));
    }
    for (i, row) in rows.iter().enumerate() {
        let entries = (0..size).map(|j| (j, entry(l, i, j).reduced().approximate()));
        let found: Vec<(usize, f64)> = entries.filter(|e| e.1 != 0.0).collect();
        if row.row != i || row.entries != found {
            return Err(Refusal::untrue(format!("row {i} is that of the triangulation"), format!("{found:?}")));
        }
    }
    Ok(())
}
