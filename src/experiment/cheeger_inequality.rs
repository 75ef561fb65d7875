//! The Cheeger inequality on graphs, with the volume as the primer prints it and with Chung's: every small connected graph.
//!
//! # Definitions
//! For a partition of the vertices into A and B, `cut = Σ_{i∈A, j∈B} ω_ij`, and the constant is the smallest
//! `cut / min(vol A, vol B)`. The primer's volume is `Σ_{i,j∈A} ω_ij`, each edge inside counted twice; Chung's is the sum of
//! degrees `Σ_{i∈A} d_i`, which is the primer's plus the cut. A partition with a side of volume zero has an infinite ratio and
//! competes with none; where all partitions are of that kind, on a star or a triangle, the primer's constant is infinite.
//!
//! # The exact relation
//! With p the primer's volume of the smaller side, `cut/(p + cut) = (cut/p)/(1 + cut/p)`, and `x/(1 + x)` is increasing: both
//! constants are attained at the same partition, and `h = λ_C/(1 + λ_C)`. Chung's inequality `h²/2 ≤ λ̃₁ ≤ 2h` becomes
//! `½ (λ_C/(1 + λ_C))² ≤ λ̃₁ ≤ 2 λ_C/(1 + λ_C) ≤ 2 λ_C`. An infinite λ_C is h = 1 and gives `½ ≤ λ̃₁ ≤ 2`, while the printed
//! lower bound is then infinite and false.
//!
//! # How it is decided
//! λ̃₁ is compared with a rational t by the inertia of `L − tD` over the rationals: its negative eigenvalues are as many as the
//! eigenvalues of `D^(−½) L D^(−½)` below t. The constants come from all partitions.

mod tally;

use super::poll::Case;
use super::world::cuts::{Cut, Specimen, constants, double, half_square, related};
use super::world::excerpt::on_graph;
use super::world::graphs::{component_count, describe, graphs, randomly_weighted};
use super::{Experiment, Finding, Setting};
use crate::domain::Graph;
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::property::Statement;
use crate::scalar::{Rational, Scalar};
use tally::{BySize, Tally};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "cheeger-inequality",
    name: "The Cheeger inequality on graphs",
    statement: "λ_C²/2 ≤ λ̃₁ ≤ 2 λ_C, with the volume as printed (edges inside, counted twice) and with the sum of degrees",
    sources: &["wardetzky-primer", "chung1997"],
    parts: &[
        "scaling-changes-no-constant",
        "laplacian-is-linear-in-the-weights",
        "printed-lower-bound",
        "printed-upper-bound",
        "chung-lower-bound",
        "chung-upper-bound",
        "constants-are-related",
        "corrected-lower-bound",
        "corrected-upper-bound",
        "printed-scaling-is-defined",
        "degree-scaling-is-normal",
    ],
    run,
};

#[derive(Default)]
struct Polls {
    scaling: Tally,
    linear: Tally,
    printed_lower: Tally,
    printed_upper: Tally,
    chung_lower: Tally,
    chung_upper: Tally,
    related: Tally,
    corrected_lower: Tally,
    corrected_upper: Tally,
    printed_scaling: Tally,
    degree_scaling: Tally,
    /// Graphs whose printed constant is infinite: with all weights one, and with random weights.
    infinite: [BySize; 2],
}

fn told(s: &Specimen, text: &str) -> Case {
    Case::told(format!("{text} on {}", describe(&s.graph)))
}

/// Where the printed lower bound is wrong: with a vector whose Rayleigh quotient is below it, and the partition that attains
/// the constant.
fn below_the_printed_bound(s: &Specimen, cut: &Cut) -> Option<Case> {
    let t = half_square(&cut.ratio);
    if s.is_lower_bound(&t) {
        return None;
    }
    let text = format!("λ_C = {}, and λ̃₁ < λ_C²/2 = {t} on {}", cut.ratio, describe(&s.graph));
    // A vector may be lost by rounding it to `f64`; the exception is not.
    let Some(x) = s.slow_vector(&t) else { return Some(Case::told(text)) };
    let statement = Statement::BelowCheeger { x, side: cut.side.clone() };
    let all: Vec<usize> = (0..s.degrees.len()).collect();
    Some(Case::shown(text, on_graph(statement, &s.graph, s.pencil.stiffness(), &all)))
}

impl Polls {
    fn ask(&mut self, s: &Specimen) {
        self.ask_scaling(s);
        let (h, cut) = (&s.chung.ratio, Some(&s.chung));
        self.chung_lower.ask(s, (!s.is_lower_bound(&half_square(h))).then(|| told(s, "λ̃₁ < h²/2")), cut);
        self.chung_upper.ask(s, (!s.is_upper_bound(&double(h))).then(|| told(s, "λ̃₁ > 2h")), cut);
        let undefined = told(s, "ω_00 = 0: no vertex is joined to itself, so that 1/√ω_ii is undefined");
        self.printed_scaling.ask(s, Some(undefined), None);
        let (below, equal) = s.eigenvalues_below(&Rational::from(2));
        let above = below + equal < s.degrees.len();
        self.degree_scaling.ask(s, above.then(|| told(s, "D^(−½) L D^(−½) has an eigenvalue above 2")), None);
        self.ask_printed(s);
    }

    /// The inequalities for the printed constant, where it is finite.
    fn ask_printed(&mut self, s: &Specimen) {
        let kind = usize::from(s.graph.weights().is_some());
        self.infinite[kind].count(s.degrees.len(), s.printed.is_none());
        let Some(printed) = &s.printed else { return };
        let (h, cut) = (&s.chung.ratio, Some(printed));
        self.printed_lower.ask(s, below_the_printed_bound(s, printed), cut);
        let twice = double(&printed.ratio);
        self.printed_upper.ask(s, (!s.is_upper_bound(&twice)).then(|| told(s, &format!("λ̃₁ > 2λ_C = {twice}"))), cut);
        let expected = related(&printed.ratio);
        let differs = || told(s, &format!("h = {h}, λ_C = {}, λ_C/(1 + λ_C) = {expected}", printed.ratio));
        self.related.ask(s, (expected != *h).then(differs), cut);
        let lower = s.is_lower_bound(&half_square(&expected));
        self.corrected_lower.ask(s, (!lower).then(|| told(s, "λ̃₁ < ½ (λ_C/(1 + λ_C))²")), cut);
        let upper = s.is_upper_bound(&double(&expected));
        self.corrected_upper.ask(s, (!upper).then(|| told(s, "λ̃₁ > 2 λ_C/(1 + λ_C)")), cut);
    }

    /// Seven thirds of every weight: the same constants, the same pencil up to the factor.
    fn ask_scaling(&mut self, s: &Specimen) {
        let n = s.degrees.len();
        let factor = Rational::from(7) / Rational::from(3);
        let scaled = Dense::from_fn(n, n, |i, j| s.pencil.stiffness().at(i, j).clone() * factor.clone());
        let degrees: Vec<Rational> = s.degrees.iter().map(|d| d.clone() * factor.clone()).collect();
        let (printed, chung) = constants(&scaled, &degrees);
        let ratio = |cut: &Option<Cut>| cut.as_ref().map(|c| c.ratio.clone());
        let same = ratio(&printed) == ratio(&s.printed) && ratio(&chung).as_ref() == Some(&s.chung.ratio);
        self.scaling.ask(s, (!same).then(|| told(s, "a common factor 7/3 changes a constant")), None);
        let edges = s.graph.edges();
        let sum = Dense::from_fn(n, n, |i, j| {
            // Edge by edge, the weight times the Laplacian of that edge alone.
            edges.iter().fold(Rational::zero(), |sum, &[a, b]| {
                let w = s.pencil.stiffness().at(a, b).clone();
                match ((i == a) as i8 - (i == b) as i8) * ((j == a) as i8 - (j == b) as i8) {
                    1 => sum - w,
                    -1 => sum + w,
                    _ => sum,
                }
            })
        });
        self.linear.ask(s, (sum != *s.pencil.stiffness()).then(|| told(s, "L is not the sum over its edges")), None);
    }
}

fn run(setting: &Setting) -> Vec<Finding> {
    let largest = setting.pick(5, 7);
    let weightings = setting.pick(1, 2);
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let mut polls = Polls::default();
    for n in 2..=largest {
        for graph in graphs(n).into_iter().filter(|g| component_count(g) == 1) {
            let random: Vec<Graph> = (0..weightings).map(|_| randomly_weighted(&graph, &mut stream)).collect();
            for graph in std::iter::once(graph).chain(random) {
                Specimen::of(graph).iter().for_each(|s| polls.ask(s));
            }
        }
    }
    polls.answer(&format!(
        "weightings (all one and {weightings} random positive) of every connected graph with 2 to {largest} vertices"
    ))
}

impl Polls {
    fn answer(self, cases: &str) -> Vec<Finding> {
        let finite = format!("{cases} for which the printed constant is finite");
        let [unit, random] = &self.infinite;
        let infinite = format!(
            "; not counted, since the constant and with it the lower bound is infinite, so that it is false there: \
             all weights one: {unit}; random positive weights: {random}"
        );
        let questions = [
            (self.scaling, "Do both constants stay when all weights are multiplied by one factor?", cases),
            (self.linear, "Is L the sum of its edges' Laplacians, each times its weight?", cases),
            (self.printed_lower, "Is λ_C²/2 ≤ λ̃₁ with the volume as printed?", &finite),
            (self.printed_upper, "Is λ̃₁ ≤ 2 λ_C with the volume as printed?", &finite),
            (self.chung_lower, "Is h²/2 ≤ λ̃₁ with the sum of degrees as volume?", cases),
            (self.chung_upper, "Is λ̃₁ ≤ 2h with the sum of degrees as volume?", cases),
            (self.related, "Is h = λ_C/(1 + λ_C)?", &finite),
            (self.corrected_lower, "Is ½ (λ_C/(1 + λ_C))² ≤ λ̃₁ with the volume as printed?", &finite),
            (self.corrected_upper, "Is λ̃₁ ≤ 2 λ_C/(1 + λ_C) with the volume as printed?", &finite),
            (self.printed_scaling, "Is S_ii = 1/√ω_ii defined, as printed?", cases),
            (self.degree_scaling, "With S_ii = 1/√L_ii, are all eigenvalues of S L S between 0 and 2?", cases),
        ];
        let parts = ENTRY.parts.iter();
        let mut findings: Vec<Finding> =
            parts.zip(questions).map(|(part, (tally, question, cases))| tally.answer(part, question, cases)).collect();
        findings.iter_mut().filter(|f| f.part == "printed-lower-bound").for_each(|f| f.finding.push_str(&infinite));
        findings
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bound_that_is_too_high_is_shown_with_a_vector() {
        // λ̃₁ of the path of four is ½, below (3/2)²/2.
        let path = Specimen::of(Graph::new(4, &[[0, 1], [1, 2], [2, 3]]).unwrap()).unwrap();
        let cut = Cut { ratio: Rational::from(3) / Rational::from(2), side: vec![2, 3] };
        assert_eq!(below_the_printed_bound(&path, &cut).map(|case| case.evidence.len()), Some(1));
        assert!(below_the_printed_bound(&path, path.printed.as_ref().unwrap()).is_none());
    }
}
