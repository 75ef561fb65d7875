//! MAX-global: the discrete maximum principle of the Dirichlet problem.
//!
//! # Definition
//! B the boundary, I the rest: `L_II` is regular and `H = −L_II⁻¹ L_IB ≥ 0` with no entry above 1. With vanishing row sums the rows
//! of H sum to one, and every solution of `(Lu)_I = 0` takes its largest and smallest value on B.
//!
//! On a closed domain B is drawn: [`SETS`] seeded sets, from two vertices to a tenth of all, each with a vertex of
//! every component. Isolated vertices (no edge, no entry) count as prescribed: there is no equation at them.
//!
//! # Decision
//! 1. No negative weight in the rows of I and a chain of positive weights from each to B: `L_II` is a weakly chained
//!    diagonally dominant M-matrix, regular with `L_II⁻¹ ≥ 0`.
//! 2. A part of I that no weight joins to B: singular, where its row sums vanish, exactly or up to the rounding of a sum;
//!    otherwise nothing is decided.
//! 3. Otherwise all columns of H are computed, each entry with a bound of its error; up to ten equations
//!    in rational numbers.
//!
//! An entry fails if it leaves `[0, 1]` by more than what thresholds of the rows do to it ([`rounding`](super::measure::rounding)): −1e-17
//! beside a cocircular pair is no failure.
//!
//! # Level
//! Exact by rational elimination; bounded where the influence of residuals is: up to 512 equations always, above for H-matrices
//! and positive definite ones ([`certified`](crate::linalg::certified)); measured elsewhere, and for holding closed domains, where
//! sets are drawn. A solution that rounding may have moved by more than a thousandth is undecided. What can hide is in
//! `docs/tolerance.md`.
//!
//! # References
//! Ciarlet 1970; Shivakumar and Chew 1974 (weakly chained dominance); Wardetzky et al. 2007.

use super::measure::row;
use super::solve::chains::Chains;
use super::solve::problem::{Chance, Problem};
use super::tolerance::Sign;
use super::{Evidence, Property, Question, Statement, Status, Trial, Verdict};
use crate::stream::Stream;

/// How many sets are drawn on a closed domain.
pub const SETS: usize = 4;

/// The largest number of prescribed values in a set that is drawn.
pub const LARGEST_SET: usize = 256;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "MAX-global",
    name: "discrete maximum principle",
    statement: "L_II is regular and 0 ≤ −L_II⁻¹ L_IB ≤ 1 entrywise",
    sources: &["ciarlet1970", "wardetzky2007"],
    question: Question::Operator(decide),
};

fn decide(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let alone = trial.isolated();
    let flags = trial.domain.boundary();
    let boundary: Vec<usize> = (0..flags.len()).filter(|&v| flags[v]).collect();
    let prescribed = |set: &[usize]| -> Vec<bool> {
        let mut inside = alone.clone();
        set.iter().for_each(|&v| inside[v] = true);
        inside
    };
    if boundary.is_empty() {
        if alone.iter().filter(|a| !**a).count() < 2 {
            return Verdict::not_applicable("the domain has no two vertices that are joined");
        }
        return closed(trial, &alone, prescribed);
    }
    let problem = Problem::new(trial, prescribed(&boundary));
    if problem.is_empty() {
        return Verdict::not_applicable("every vertex is on the boundary");
    }
    let whole = alone.iter().all(|a| !*a);
    problem.decide(whole, Chance::Given)
}

/// A closed domain: sets are drawn.
fn closed(trial: &Trial, alone: &[bool], prescribed: impl Fn(&[usize]) -> Vec<bool>) -> Verdict {
    let sets = draw(trial, alone);
    let sizes = sets.iter().map(|s| s.len().to_string()).collect::<Vec<_>>().join(", ");
    let note = format!("closed domain: {} sets were drawn, of {sizes} vertices", sets.len());
    let problems: Vec<Problem> = sets.iter().map(|set| Problem::new(trial, prescribed(set))).collect();
    if let Some(verdict) = joined_throughout(trial, alone, &sets) {
        return verdict.with_note(note);
    }
    let mut kept: Option<Verdict> = None;
    for problem in problems.iter().filter(|p| !p.is_empty()) {
        let verdict = problem.decide(false, Chance::Drawn);
        match verdict.status() {
            Status::Fails => return verdict.with_note(note),
            Status::Undecided => kept = Some(verdict),
            _ if kept.as_ref().is_none_or(|k| k.status() == Status::Holds && k.margin <= verdict.margin) => {
                kept = Some(verdict);
            }
            _ => {}
        }
    }
    kept.unwrap_or_else(|| Verdict::not_applicable("every vertex is prescribed")).with_note(note)
}

/// A closed domain without a negative weight whose components are joined throughout: every set passes.
fn joined_throughout(trial: &Trial, alone: &[bool], sets: &[Vec<usize>]) -> Option<Verdict> {
    let matrix = trial.operator.stiffness();
    let (rounding, scales) = (trial.rounding(), &trial.scales().rows);
    if !(0..matrix.rows()).all(|i| row::no_negative_weight(matrix, i)) {
        return None;
    }
    let counts = |i: usize, _, v: f64| v < 0.0 && rounding.weight(i, v) != Sign::Zero;
    let class = Chains::new(matrix, counts).classes();
    let components = trial.domain.components();
    let mut of_component = vec![usize::MAX; class.len()];
    for v in (0..class.len()).filter(|&v| !alone[v]) {
        let known = &mut of_component[components[v]];
        if *known != usize::MAX && *known != class[v] {
            return None;
        }
        *known = class[v];
    }
    let vanishes = |i: usize| row::sum(matrix, i).abs() <= rounding.row(i).explained * scales[i];
    let largest = sets.iter().map(Vec::len).max().unwrap_or(0);
    let evidence = || Evidence::bare(Statement::SignPattern { set: largest });
    (0..matrix.rows()).all(vanishes).then(|| Verdict::holds(trial.level_of_signs(), evidence()))
}

/// The sets of a closed domain: a vertex of each component, filled up to 2, √n, n/30 and n/10.
fn draw(trial: &Trial, alone: &[bool]) -> Vec<Vec<usize>> {
    let mut stream = Stream::new(trial.seed, "MAX-global");
    let components = trial.domain.components();
    let vertices: Vec<usize> = (0..alone.len()).filter(|&v| !alone[v]).collect();
    let n = vertices.len();
    let sizes: [usize; SETS] = [2, (n as f64).sqrt().ceil() as usize, n.div_ceil(30), n.div_ceil(10)];
    sizes
        .iter()
        .map(|&size| {
            let mut order = vertices.clone();
            stream.shuffle(&mut order);
            let mut seen = vec![false; components.len()];
            let (first, rest): (Vec<usize>, Vec<usize>) =
                order.into_iter().partition(|&v| !std::mem::replace(&mut seen[components[v]], true));
            let size = size.clamp(2, LARGEST_SET).min(n - 1).max(first.len());
            let mut set: Vec<usize> = first.into_iter().chain(rest).take(size).collect();
            set.sort_unstable();
            set
        })
        .collect()
}
