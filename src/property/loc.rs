//! LOC: a vertex sees its neighbours only.
//!
//! # Definition
//! `L_ij ≠ 0, i ≠ j ⇒ i and j share an edge`; on polygon meshes: a face. A stored zero is no entry. An entry no larger than the
//! rounding of its row leaves the verdict open, unless the construction vouches for its zeros. How far the stencil reaches
//! is told in rings.

use super::evidence::{Evidence, Statement};
use super::excerpt;
use super::stencil::Link;
use super::verdict::{Level, Tally};
use super::{Property, Question, Trial, Verdict};
use crate::domain::{Domain, DomainKind};
use crate::linalg::parallel;
use crate::operator::Signs;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "LOC",
    name: "locality",
    statement: "L_ij ≠ 0, i ≠ j ⇒ i and j share an edge (polygon meshes: a face)",
    sources: &["wardetzky2007"],
    question: Question::Operator(check),
};

/// How many vertices the search for stencil radii may visit in all.
const VISITS: usize = 2_000_000;

/// A non-zero entry off the stencil.
struct Far {
    i: usize,
    j: usize,
    /// Its magnitude relative to its row.
    size: f64,
    /// Its magnitude over the rounding of its row.
    margin: f64,
}

fn check(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    if trial.domain.kind() == DomainKind::Points {
        return Verdict::not_applicable("a point cloud has no edges that an operator could be local to");
    }
    let (far, total) = far_entries(trial);
    let exact = trial.operator.signs() == Signs::Exact;
    let clear = |f: &&Far| exact || f.margin > 1.0;
    let violations = far.iter().filter(clear).count();
    let tally = Tally { violations, undecided: far.len() - violations, zeros: 0, total };
    let worst = far.iter().filter(clear).reduce(|worst, f| if f.size > worst.size { f } else { worst });
    let verdict = match (worst, far.first()) {
        (Some(worst), _) => Verdict::fails(Level::Exact, witness(trial, worst)),
        (None, Some(faint)) => Verdict::undecided(format!(
            "{} entries off the stencil, ({}, {}) the first, are no larger than the rounding of their rows: they may be \
             meant as zeros",
            far.len(),
            faint.i,
            faint.j
        )),
        (None, None) => {
            let scan = Statement::Scan { checked: total, worst: Vec::new() };
            Verdict::holds(Level::Exact, Evidence::bare(scan))
        }
    };
    let mut verdict = verdict.with_tally(tally).with_note(radius(trial, &far, total > 0));
    if let Some(margin) = far.iter().map(|f| f.margin).reduce(f64::max).filter(|_| !exact) {
        verdict = verdict.with_margin(margin);
    }
    match trial.domain {
        Domain::Surface(s) if !s.is_triangulated() => {
            verdict.with_note("polygon mesh: a pair counts as local if it shares a face")
        }
        _ => verdict,
    }
}

/// The non-zero entries off the stencil, row by row, and how many there are off the diagonal in all.
fn far_entries(trial: &Trial) -> (Vec<Far>, usize) {
    let (matrix, stencil, scales) = (trial.operator.stiffness(), trial.stencil(), trial.scales());
    let parts = parallel::blocks(matrix.rows(), |rows| {
        let (mut far, mut total) = (Vec::new(), 0);
        for i in rows {
            let (columns, values) = matrix.row_slices(i);
            if !scales.leaves_stencil(i) {
                total += columns.iter().zip(values).filter(|&(&j, &v)| j != i && v != 0.0).count();
                continue;
            }
            for (j, v, link) in stencil.row(matrix, i).filter(|&(j, v, _)| i != j && v != 0.0) {
                total += 1;
                if link == Link::Far {
                    let (size, margin) = (v.abs() / scales.rows[i], scales.row(i).margin(v.abs()));
                    far.push(Far { i, j, size, margin });
                }
            }
        }
        (far, total)
    });
    let total = parts.iter().map(|(_, total)| total).sum();
    (parts.into_iter().flat_map(|(far, _)| far).collect(), total)
}

fn witness(trial: &Trial, far: &Far) -> Evidence {
    let &Far { i, j, .. } = far;
    let mut unlimited = usize::MAX;
    let rings = trial.stencil().rings(i, &[j], &mut unlimited)[0];
    Evidence::new(Statement::FarEntry { i, j, rings }, excerpt::of_rows(trial, [i]).with_star(trial, i))
}

/// How far the stencil reaches, in words.
fn radius(trial: &Trial, far: &[Far], any: bool) -> String {
    let (mut reach, mut unconnected, mut budget) = (usize::from(any), 0, VISITS);
    for row in far.chunk_by(|a, b| a.i == b.i) {
        let targets: Vec<usize> = row.iter().map(|f| f.j).collect();
        let rings = trial.stencil().rings(row[0].i, &targets, &mut budget);
        if budget == 0 {
            reach = rings.into_iter().flatten().fold(reach, usize::max);
            return format!("stencil radius: at least {reach} rings; the search was cut short");
        }
        unconnected += rings.iter().filter(|r| r.is_none()).count();
        reach = rings.into_iter().flatten().fold(reach, usize::max);
    }
    let beyond = match unconnected {
        0 => String::new(),
        n => format!(", and {n} entries join vertices that are not connected"),
    };
    format!("stencil radius: {reach} ring{}{beyond}", if reach == 1 { "" } else { "s" })
}
