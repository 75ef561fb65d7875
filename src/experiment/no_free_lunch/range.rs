//! For which twists nested triangles have no positive weights, found by bisection over rational twists.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::super::poll::{Case, Every};
use super::super::world::certified::certified;
use super::super::world::twisted::{Twist, degrees, faces, ratio, turns, twisted};
use super::ENTRY;
use crate::experiment::Finding;
use crate::figure::{Axis, Chart, Figure, Mark, Series};
use crate::laplacian::equilibrium::Net;
use crate::linalg::simplex::{Farkas, stiemke};
use crate::scalar::{Rational, Scalar};

/// The sizes of a triangle over the next outer one.
const SIZES: [(i64, i64); 5] = [(1, 5), (3, 10), (2, 5), (1, 2), (3, 5)];

/// The sizes in words.
fn sizes() -> String {
    SIZES.map(|(n, d)| format!("{n}/{d}")).join(", ")
}

/// Whether positive weights exist at a twist, exactly; `None` where a triangle is folded.
fn is_positive(m: &Twist, size: &Rational, nested: usize) -> Option<bool> {
    let corners = turns(m, size, nested)?;
    let held: Vec<bool> = (0..corners.len()).map(|v| v < 3).collect();
    let mut edges: Vec<[usize; 2]> = faces(nested)
        .iter()
        .flat_map(|f| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]])
        .map(|[i, j]| [i.min(j), i.max(j)])
        .filter(|e| !(held[e[0]] && held[e[1]]))
        .collect();
    edges.sort_unstable();
    edges.dedup();
    let vector = |&[i, j]: &[usize; 2]| std::array::from_fn(|k| corners[i][k].clone() - corners[j][k].clone());
    let vectors = edges.iter().map(vector).collect();
    Some(matches!(stiemke(&Net::new(&held, edges, vectors).rows()), Farkas::Solution(_)))
}

/// Twists between which the answer changes, as near to each other as bisection brought them.
struct Change {
    below: Twist,
    above: Twist,
    /// What is true below and above; `None` for a folded triangle.
    from: Option<bool>,
    to: Option<bool>,
}

/// What became of a family of twists.
struct Family {
    changes: Vec<Change>,
    /// The twists k/8 in degrees, each with its answer where no triangle is folded.
    grid: Vec<(f64, bool)>,
    /// How many twists were decided in all.
    decided: usize,
}

/// The changes along the twists k/8, each bisected `steps` times.
fn family(size: &Rational, nested: usize, steps: usize) -> Family {
    let answer = |m: &Twist| is_positive(m, size, nested);
    let grid: Vec<(Twist, Option<bool>)> = (-40..=16)
        .map(|k| {
            let m = ratio(k, 8);
            let found = answer(&m);
            (m, found)
        })
        .collect();
    let mut decided = grid.iter().filter(|g| g.1.is_some()).count();
    let mut found = Vec::new();
    for pair in grid.windows(2).filter(|p| p[0].1 != p[1].1) {
        let (mut below, mut above) = (pair[0].0.clone(), pair[1].0.clone());
        for _ in 0..steps {
            let middle = ((below.clone() + above.clone()) * Rational::half()).reduced();
            let here = answer(&middle);
            decided += usize::from(here.is_some());
            if here == pair[0].1 { below = middle } else { above = middle }
        }
        found.push(Change { below, above, from: pair[0].1, to: pair[1].1 });
    }
    let grid = grid.iter().filter_map(|(m, answer)| Some((degrees(m), (*answer)?))).collect();
    Family { changes: found, grid, decided }
}

fn word(answer: Option<bool>) -> &'static str {
    match answer {
        None => "folded",
        Some(true) => "positive weights",
        Some(false) => "none",
    }
}

pub(super) fn run(steps: usize) -> Vec<Finding> {
    vec![certificates(), range(steps)]
}

/// Twists at which a motion was written down and verified.
fn certificates() -> Finding {
    let mut poll = Every::default();
    let mut shown = Vec::new();
    for nested in 1..=3 {
        for size in SIZES {
            for m in [(0, 1), (1, 8), (1, 4)] {
                let m = ratio(m.0, m.1);
                let Some(surface) = twisted(&m, &ratio(size.0, size.1), nested) else { continue };
                let text =
                    || format!("{nested} triangles of size {}/{} twisted by {:.2}°", size.0, size.1, degrees(&m));
                match certified(&surface) {
                    Ok(found) if !found.decision.certificate.is_positive() => {
                        if shown.is_empty() && m > Rational::ZERO {
                            shown.push(found.evidence);
                        }
                        poll.ask(None);
                    }
                    Ok(found) => poll.ask(Some(Case::shown(text(), found.evidence))),
                    Err(why) => poll.ask(Some(Case::told(format!("{}: {why}", text())))),
                }
            }
        }
    }
    // For comparison: a little twist the other way has a lift.
    let other = twisted(&ratio(-1, 4), &ratio(2, 5), 1).and_then(|surface| certified(&surface).ok());
    shown.extend(other.map(|found| found.evidence));
    let mut finding = poll.answer(
        ENTRY.parts[8],
        format!(
            "Has no triangulation by nested triangles that are twisted the way of their diagonals, or not at all, positive weights? Cases: 1 to \
         3 triangles inside, sizes {}, twists 0, 1/8, 1/4 (as √3 tan(θ/2)), where no triangle is folded.",
            sizes()
        ),
        "triangulations",
    );
    if finding.evidence.is_empty() {
        finding.finding += "; shown: the motion of the first one, and the lift of one twisted the other way";
        finding.evidence = shown;
    }
    finding
}

/// The whole range of twists.
fn range(steps: usize) -> Finding {
    let mut poll = Every::default();
    let (mut ranges, mut decided) = (Vec::new(), 0);
    let mut dots: BTreeMap<(usize, bool), Vec<[f64; 2]>> = BTreeMap::new();
    let families: Vec<(usize, (i64, i64))> = [1, 2].iter().flat_map(|&n| SIZES.map(|size| (n, size))).collect();
    let decide = |&(nested, (n, d)): &(usize, (i64, i64))| family(&ratio(n, d), nested, steps);
    let results: Vec<_> = families.par_iter().map(decide).collect();
    for (&(nested, (n, d)), found) in families.iter().zip(&results) {
        decided += found.decided;
        let changes: Vec<String> = found
            .changes
            .iter()
            .map(|c| {
                let (from, to) = (word(c.from), word(c.to));
                format!("{from} up to {:.4}°, {to} from {:.4}°", degrees(&c.below), degrees(&c.above))
            })
            .collect();
        ranges.push(format!("{nested} of size {n}/{d}: {}", changes.join("; ")));
        for &(twist, answer) in &found.grid {
            dots.entry((nested, answer)).or_default().push([twist, n as f64 / d as f64]);
        }
        // From 0 on there are none, whatever the number and the size, up to where a triangle folds.
        let none = found.changes.iter().all(|c| c.to != Some(true) || c.above < Rational::ZERO);
        poll.ask((!none).then(|| Case::told(format!("{nested} triangles of size {n}/{d}"))));
    }
    let mut finding = poll.answer(
        ENTRY.parts[9],
        format!(
            "For which twists have nested triangles no positive weights: for all from 0 up to the fold? Cases: 1 and 2 triangles inside, \
             sizes {}, twists √3 tan(θ/2) = k/8 and {steps} bisections of every change, decided by the exact simplex method.",
            sizes()
        ),
        "families",
    );
    finding.finding += &format!("; {decided} twists decided; {}", ranges.join(". "));
    for nested in [1, 2] {
        let series = |answer: bool| {
            let name = if answer { "positive weights" } else { "none" };
            Series::new(name, Mark::Dots, dots.get(&(nested, answer)).cloned().unwrap_or_default())
        };
        finding.figures.push(Figure::Chart(Chart {
            title: format!("Which twists have positive weights, with {nested} inside; elsewhere a triangle is folded"),
            x: Axis::linear("twist in degrees"),
            y: Axis::linear("size of the next triangle inside"),
            series: [true, false].map(series).into(),
        }));
    }
    finding
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_triangle_inside_has_positive_weights_exactly_between_minus_120_degrees_and_0() {
        let size = ratio(2, 5);
        for (n, d, expected) in [(-1, 1 << 20, true), (0, 1, false), (1, 1 << 20, false), (-2, 1, true), (1, 4, false)]
        {
            assert_eq!(is_positive(&ratio(n, d), &size, 1), Some(expected), "{n}/{d}");
        }
        assert_eq!(is_positive(&ratio(3, 2), &size, 1), None);
        let found = family(&size, 1, 8).changes;
        let words: Vec<_> = found.iter().map(|c| (c.from, c.to)).collect();
        let (yes, no) = (Some(true), Some(false));
        assert_eq!(words, [(None, no), (no, yes), (yes, no), (no, None)]);
        // −120° is m = −3: there, as at 0, edges of the inner triangle are parallel to outer ones.
        assert!(found[1].below == ratio(-3, 1) && (degrees(&found[1].below) + 120.0).abs() < 1e-12);
        assert!(found[2].below < Rational::ZERO && found[2].above == Rational::ZERO);
    }
}
