//! Certificates of the maximum principle by complete solutions: every column is solved for again.

use super::solve::{Entry, Solver, System};
use super::terms::U;
use super::witness::NEARLY_ZERO;
use super::{Answer, Rechecked, Refusal, place, scan};
use crate::domain::Domain;
use crate::linalg::Csr;
use crate::operator::{Mass, MassKind, Operator};

/// More multiplications than this take longer than a recheck may.
const MOST_WORK: usize = 2_000_000_000;

/// What a certificate says of the solutions.
#[derive(Clone, Copy)]
pub(super) struct Stated {
    /// How many right-hand sides.
    pub columns: usize,
    /// The smallest entry.
    pub smallest: f64,
    /// The bound on the error of each entry, rounding of the matrix included.
    pub error: f64,
}

/// What our own solutions come to.
struct Range {
    smallest: f64,
    largest: f64,
    error: f64,
}

/// MAX-global, MAX-heat: every column is non-negative (and at most one).
pub(super) fn decide(property: &str, domain: &Domain, operator: &Operator, stated: Stated) -> Answer {
    scan::check_finite(operator.stiffness())?;
    if stated.error > 1.0 / 1024.0 {
        return Ok(Rechecked::Open(format!("the solution is certain to {:e} only, by its own account", stated.error)));
    }
    if property == "MAX-heat" { heat(domain, operator, stated) } else { dirichlet(domain, operator, stated) }
}

/// `−L_II⁻¹ L_IB`, of which only the columns of vertices with a neighbour in I are not zero.
fn dirichlet(domain: &Domain, operator: &Operator, stated: Stated) -> Answer {
    let l = operator.stiffness();
    if !domain.boundary().contains(&true) {
        return Ok(Rechecked::Open("the certificate does not name the sets that were drawn".into()));
    }
    let prescribed = place::prescribed(domain, operator);
    let free: Vec<usize> = (0..l.rows()).filter(|&i| !prescribed[i]).collect();
    let mut place = vec![None; l.rows()];
    free.iter().enumerate().for_each(|(at, &i)| place[i] = Some(at));
    let mut sides = vec![Vec::new(); l.rows()];
    for (at, &i) in free.iter().enumerate() {
        l.row(i).filter(|e| place[e.0].is_none() && *e.1 != 0.0).for_each(|(b, v)| sides[b].push((at, -v)));
    }
    let sources: Vec<Vec<(usize, f64)>> = sides.into_iter().filter(|s| !s.is_empty()).collect();
    let most = prescribed.iter().filter(|p| **p).count();
    if stated.columns < sources.len() || stated.columns > most {
        let found = format!("{most} prescribed values, {} of which matter", sources.len());
        return Err(Refusal::untrue(format!("{} columns were computed", stated.columns), found));
    }
    let row = |&i: &usize| l.row(i).filter_map(|(j, v)| place[j].map(|at| (at, *v, 0.0))).collect();
    let system = System { rows: free.iter().map(row).collect() };
    match range(&system, &sources) {
        Err(why) => Ok(Rechecked::Open(why)),
        Ok(range) => {
            check_sign(&range, stated)?;
            if range.largest - range.error - stated.error > 1.0 {
                return Err(Refusal::untrue("no entry exceeds 1", format!("{}", range.largest)));
            }
            // Columns without a neighbour in I are zero.
            let zero = stated.columns > sources.len() || sources.is_empty();
            let smallest = if zero { range.smallest.min(0.0) } else { range.smallest };
            check_smallest(&[smallest], range.error, stated)
        }
    }
}

/// `(M + tL)⁻¹ M` for each of the [`times`].
fn heat(domain: &Domain, operator: &Operator, stated: Stated) -> Answer {
    let Some(mass) = operator.mass() else {
        return Err(Refusal::untrue("there is a mass matrix", "there is none"));
    };
    let (m, l) = (mass.matrix(), operator.stiffness());
    scan::check_finite(m)?;
    if stated.columns > m.rows() || stated.columns == 0 {
        let found = format!("{} vertices", m.rows());
        return Err(Refusal::untrue(format!("{} columns were computed", stated.columns), found));
    }
    if stated.columns < m.rows() {
        return Ok(Rechecked::Open("a sample of columns was computed, and the certificate does not name it".into()));
    }
    let transpose = m.transpose();
    let columns: Vec<Vec<(usize, f64)>> =
        (0..m.rows()).map(|j| transpose.row(j).map(|(i, v)| (i, *v)).collect()).collect();
    let (mut smallest, mut error) = (Vec::new(), 0.0_f64);
    for t in times(domain, l, mass) {
        match range(&step(m, l, t), &columns) {
            Err(why) => return Ok(Rechecked::Open(why)),
            Ok(range) => {
                check_sign(&range, stated)?;
                smallest.push(range.smallest);
                error = error.max(range.error);
            }
        }
    }
    check_smallest(&smallest, error, stated)
}

/// `M + tL`; each entry rounds once for the product and once for the sum.
fn step(m: &Csr, l: &Csr, t: f64) -> System {
    let sum = m.add(&l.map(|_, _, v| t * v));
    let size = |i: usize, j: usize| m.at(i, j).abs() + (t * l.at(i, j)).abs();
    let row = |i: usize| -> Vec<Entry> {
        sum.row(i).map(|(j, v)| (j, *v, 2.5 * U * size(i, j) + f64::MIN_POSITIVE)).collect()
    };
    System { rows: (0..sum.rows()).map(row).collect() }
}

/// The time steps of MAX-heat: `h²/16, h², 16h²`, h² the mean squared edge length; 1 where there are no positions, and where the
/// mass counts vertices or edges.
pub(super) fn times(domain: &Domain, l: &Csr, mass: &Mass) -> [f64; 3] {
    let counts = [MassKind::Unit, MassKind::Degree].contains(&mass.kind());
    let unit = if counts { 1.0 } else { squared_edge_length(domain, l) };
    [1.0 / 16.0, 1.0, 16.0].map(|factor| factor * unit)
}

fn squared_edge_length(domain: &Domain, l: &Csr) -> f64 {
    let Some(positions) = domain.positions() else { return 1.0 };
    let square = |a: usize, b: usize| (0..3).map(|k| (positions[a][k] - positions[b][k]).powi(2)).sum::<f64>();
    let lengths: Vec<f64> = if domain.edges().is_empty() {
        l.entries().filter(|(i, j, v)| i < j && **v != 0.0).map(|(i, j, _)| square(i, j)).collect()
    } else {
        domain.edges().iter().map(|&[a, b]| square(a, b)).collect()
    };
    lengths.iter().sum::<f64>() / lengths.len().max(1) as f64
}

/// Solves for sparse columns; the error says why not.
fn range(system: &System, columns: &[Vec<(usize, f64)>]) -> Result<Range, String> {
    let mut range = Range { smallest: f64::INFINITY, largest: f64::NEG_INFINITY, error: 0.0 };
    let solver = Solver::new(system)?;
    if solver.work() * columns.len() > MOST_WORK {
        return Err(format!("{} columns are too many to solve for again", columns.len()));
    }
    for column in columns {
        let mut right = vec![0.0; system.rows.len()];
        column.iter().for_each(|&(at, v)| right[at] = v);
        let found = solver.solve(&right);
        for (x, e) in found.x.iter().zip(&found.error) {
            range.smallest = range.smallest.min(*x);
            range.largest = range.largest.max(*x);
            range.error = if e.is_nan() { f64::INFINITY } else { range.error.max(*e) };
        }
    }
    if range.error > NEARLY_ZERO {
        return Err(format!("the solution is known only to {:e}", range.error));
    }
    Ok(range)
}

fn check_sign(range: &Range, stated: Stated) -> Result<(), Refusal> {
    if range.smallest + range.error + stated.error < 0.0 {
        return Err(Refusal::untrue("no entry is negative", format!("{:e}", range.smallest)));
    }
    Ok(())
}

/// The smallest entry stated must be one of those found, up to both errors.
fn check_smallest(found: &[f64], error: f64, stated: Stated) -> Answer {
    let close = |x: &f64| (stated.smallest - x).abs() <= error + stated.error + 1e-6 * x.abs();
    if found.iter().any(|x| close(x) || (x.is_infinite() && stated.smallest == 0.0)) {
        return Ok(Rechecked::Bounded);
    }
    Err(Refusal::untrue(format!("the smallest entry is {:e}", stated.smallest), format!("{found:?}")))
}
