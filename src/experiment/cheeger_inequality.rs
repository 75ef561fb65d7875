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
//! `½ (λ_C/(1 + λ_C))² ≤ λ̃₁ ≤ 2 λ_C/(1 + λ_C) ≤ 2 λ_C`.
//!
//! # How it is decided
//! λ̃₁ is compared with a rational t by the inertia of `L − tD` over the rationals: its negative eigenvalues are as many as the
//! eigenvalues of `D^(−½) L D^(−½)` below t. The constants come from all partitions.

use std::cmp::Ordering;

use super::poll::{Case, Every};
use super::world::excerpt::on_graph;
use super::world::graphs::{component_count, describe, graphs, laplacian, randomly_weighted};
use super::{Experiment, Finding, Setting};
use crate::domain::Graph;
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::property::Statement;
use crate::scalar::{Rational, Scalar};

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
        "printed-scaling-is-defined",
        "degree-scaling-is-normal",
    ],
    run,
};

/// A connected graph with its exact matrices and both constants.
struct Specimen {
    graph: Graph,
    stiffness: Dense<Rational>,
    degrees: Vec<Rational>,
    printed: Option<Cut>,
    chung: Cut,
}

/// The smallest ratio over all partitions, and a partition that attains it.
#[derive(Clone)]
struct Cut {
    ratio: Rational,
    side: Vec<usize>,
}

impl Specimen {
    fn of(graph: Graph) -> Option<Self> {
        let stiffness = laplacian(&graph);
        let degrees: Vec<Rational> = (0..stiffness.rows()).map(|i| stiffness.at(i, i).clone()).collect();
        let (printed, chung) = constants(&stiffness, &degrees);
        Some(Specimen { graph, stiffness, degrees, printed, chung: chung? })
    }

    /// Eigenvalues of the pencil (L, D) below t, and equal to t.
    fn eigenvalues_below(&self, t: &Rational) -> (usize, usize) {
        let n = self.degrees.len();
        let shifted = Dense::from_fn(n, n, |i, j| {
            let entry = self.stiffness.at(i, j).clone();
            if i == j { (entry - t.clone() * self.degrees[i].clone()).reduced() } else { entry }
        });
        let inertia = shifted.eliminate().inertia();
        (inertia.negative, inertia.zero)
    }

    /// Whether `t ≤ λ̃₁`: below a positive t lies the zero eigenvalue alone.
    fn is_lower_bound(&self, t: &Rational) -> bool {
        self.eigenvalues_below(t).0 <= 1
    }

    /// Whether `λ̃₁ ≤ t`.
    fn is_upper_bound(&self, t: &Rational) -> bool {
        let (below, equal) = self.eigenvalues_below(t);
        below + equal >= 2
    }

    fn told(&self, text: &str) -> Case {
        Case::told(format!("{text} on {}", describe(&self.graph)))
    }

    /// A vector whose Rayleigh quotient is below half the square of the printed constant, with the partition that attains it.
    fn below_the_printed_bound(&self, cut: &Cut) -> Option<Case> {
        let t = half_square(&cut.ratio);
        if self.is_lower_bound(&t) {
            return None;
        }
        let x = self.slow_vector(&t)?;
        let text = format!("λ_C = {}, and λ̃₁ < λ_C²/2 = {t} on {}", cut.ratio, describe(&self.graph));
        let statement = Statement::BelowCheeger { x, side: cut.side.clone() };
        let all: Vec<usize> = (0..self.degrees.len()).collect();
        Some(Case::shown(text, on_graph(statement, &self.graph, &self.stiffness, &all)))
    }

    /// A vector with `xᵀLx < t (xᵀDx − (1ᵀDx)²/1ᵀD1)`: negative directions of `L − tD + t D11ᵀD/1ᵀD1`, which is L itself on
    /// constants.
    fn slow_vector(&self, t: &Rational) -> Option<Vec<(usize, f64)>> {
        let n = self.degrees.len();
        let total = self.degrees.iter().fold(Rational::zero(), |sum, d| sum + d.clone());
        let form = Dense::from_fn(n, n, |i, j| {
            let d = |k: usize| self.degrees[k].clone();
            let diagonal = if i == j { t.clone() * d(i) } else { Rational::zero() };
            (self.stiffness.at(i, j).clone() - diagonal + t.clone() * d(i) * d(j) / total.clone()).reduced()
        });
        let x = form.eliminate().negative_direction()?;
        let rounded: Vec<f64> = x.iter().map(Scalar::approximate).collect();
        let exact: Vec<Rational> = rounded.iter().map(|v| Rational::exactly(*v)).collect::<Option<_>>()?;
        let still = form.quadratic_form(&exact).cmp_zero() == Ordering::Less;
        still.then(|| rounded.into_iter().enumerate().filter(|(_, v)| *v != 0.0).collect())
    }
}

/// Both constants over all partitions, vertex 0 on the first side; the partitions in the order of the Gray code, each from the
/// last by one vertex that changes sides. `None` where no partition has a finite ratio.
fn constants(l: &Dense<Rational>, degrees: &[Rational]) -> (Option<Cut>, Option<Cut>) {
    let n = degrees.len();
    let total = degrees.iter().fold(Rational::zero(), |sum, d| sum + d.clone());
    let (mut printed, mut chung): (Option<Cut>, Option<Cut>) = (None, None);
    let mut other = vec![false; n];
    let (mut cut, mut volume) = (Rational::zero(), Rational::zero());
    for code in 1..1_usize << n.saturating_sub(1) {
        let v = 1 + code.trailing_zeros() as usize;
        other[v] = !other[v];
        // Entries of L are −ω: the edges between v and its new side leave the cut, those to its old side enter it.
        let between = (0..n).filter(|&j| j != v).fold(Rational::zero(), |sum, j| {
            if other[j] == other[v] { sum + l.at(v, j).clone() } else { sum - l.at(v, j).clone() }
        });
        cut = (cut + between).reduced();
        let degree = degrees[v].clone();
        volume = (if other[v] { volume + degree } else { volume - degree }).reduced();
        let rest = total.clone() - volume.clone();
        let smaller = if volume < rest { volume.clone() } else { rest };
        let side = || (0..n).filter(|&i| other[i]).collect::<Vec<usize>>();
        for (best, of) in [(&mut printed, smaller.clone() - cut.clone()), (&mut chung, smaller)] {
            if of.cmp_zero() != Ordering::Greater {
                continue;
            }
            let ratio = (cut.clone() / of).reduced();
            if best.as_ref().is_none_or(|b| ratio < b.ratio) {
                *best = Some(Cut { ratio, side: side() });
            }
        }
    }
    (printed, chung)
}

fn half_square(x: &Rational) -> Rational {
    (x.clone() * x.clone() * Rational::half()).reduced()
}

fn double(x: &Rational) -> Rational {
    x.clone() + x.clone()
}

/// Chung's constant from the printed one.
fn related(printed: &Rational) -> Rational {
    (printed.clone() / (Rational::ONE + printed.clone())).reduced()
}

/// A question with its exceptions by the number of vertices.
#[derive(Default)]
struct Tally {
    every: Every,
    by_size: std::collections::BTreeMap<usize, [usize; 2]>,
}

impl Tally {
    fn ask(&mut self, n: usize, violation: Option<Case>) {
        let counts = self.by_size.entry(n).or_default();
        counts[0] += usize::from(violation.is_some());
        counts[1] += 1;
        self.every.ask(violation);
    }

    fn answer(self, part: &'static str, question: &str, cases: &str) -> Finding {
        let sizes: Vec<String> = self.by_size.iter().map(|(n, [k, of])| format!("{k} of {of} with {n}")).collect();
        let mut finding = self.every.answer(part, question, cases);
        finding.finding.push_str(&format!("; exceptions by number of vertices: {}", sizes.join(", ")));
        finding
    }
}

#[derive(Default)]
struct Polls {
    scaling: Tally,
    linear: Tally,
    printed_lower: Tally,
    printed_upper: Tally,
    chung_lower: Tally,
    chung_upper: Tally,
    related: Tally,
    corrected: Tally,
    printed_scaling: Tally,
    degree_scaling: Tally,
    infinite: usize,
}

impl Polls {
    fn ask(&mut self, s: &Specimen) {
        let n = s.degrees.len();
        self.ask_scaling(s);
        let h = &s.chung.ratio;
        self.chung_lower.ask(n, (!s.is_lower_bound(&half_square(h))).then(|| s.told("λ̃₁ < h²/2")));
        self.chung_upper.ask(n, (!s.is_upper_bound(&double(h))).then(|| s.told("λ̃₁ > 2h")));
        self.printed_scaling
            .ask(n, Some(s.told("ω_00 = 0: no vertex is joined to itself, so that 1/√ω_ii is undefined")));
        let two = Rational::from(2);
        let (below, equal) = s.eigenvalues_below(&two);
        self.degree_scaling.ask(n, (below + equal < n).then(|| s.told("D^(−½) L D^(−½) has an eigenvalue above 2")));
        let Some(printed) = &s.printed else {
            self.infinite += 1;
            return;
        };
        self.printed_lower.ask(n, s.below_the_printed_bound(printed));
        let above = !s.is_upper_bound(&double(&printed.ratio));
        self.printed_upper.ask(n, above.then(|| s.told(&format!("λ̃₁ > 2λ_C = {}", double(&printed.ratio)))));
        let expected = related(&printed.ratio);
        self.related.ask(
            n,
            (expected != *h).then(|| s.told(&format!("h = {h}, λ_C = {}, λ_C/(1 + λ_C) = {expected}", printed.ratio))),
        );
        self.corrected.ask(n, (!s.is_lower_bound(&half_square(&expected))).then(|| s.told("λ̃₁ < ½ (λ_C/(1 + λ_C))²")));
    }

    /// Seven thirds of every weight: the same constants, the same pencil up to the factor.
    fn ask_scaling(&mut self, s: &Specimen) {
        let n = s.degrees.len();
        let factor = Rational::from(7) / Rational::from(3);
        let scaled = Dense::from_fn(n, n, |i, j| s.stiffness.at(i, j).clone() * factor.clone());
        let degrees: Vec<Rational> = s.degrees.iter().map(|d| d.clone() * factor.clone()).collect();
        let (printed, chung) = constants(&scaled, &degrees);
        let ratio = |cut: &Option<Cut>| cut.as_ref().map(|c| c.ratio.clone());
        let same = ratio(&printed) == ratio(&s.printed) && ratio(&chung).as_ref() == Some(&s.chung.ratio);
        self.scaling.ask(n, (!same).then(|| s.told("a common factor 7/3 changes a constant")));
        let edges = s.graph.edges();
        let sum = Dense::from_fn(n, n, |i, j| {
            // Edge by edge, the weight times the Laplacian of that edge alone.
            edges.iter().fold(Rational::zero(), |sum, &[a, b]| {
                let w = s.stiffness.at(a, b).clone();
                match ((i == a) as i8 - (i == b) as i8) * ((j == a) as i8 - (j == b) as i8) {
                    1 => sum - w,
                    -1 => sum + w,
                    _ => sum,
                }
            })
        });
        self.linear.ask(n, (sum != s.stiffness).then(|| s.told("L is not the sum over its edges")));
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
        let finite = format!("{cases} for which the printed constant is finite ({} have none)", self.infinite);
        let [parts_0, parts_1, parts_2, parts_3, parts_4, parts_5, parts_6, parts_7, parts_8, parts_9] =
            std::array::from_fn(|k| ENTRY.parts[k]);
        vec![
            self.scaling.answer(
                parts_0,
                "Do both constants stay when all weights are multiplied by one factor?",
                cases,
            ),
            self.linear.answer(parts_1, "Is L the sum of its edges' Laplacians, each times its weight?", cases),
            self.printed_lower.answer(parts_2, "Is λ_C²/2 ≤ λ̃₁ with the volume as printed?", &finite),
            self.printed_upper.answer(parts_3, "Is λ̃₁ ≤ 2 λ_C with the volume as printed?", &finite),
            self.chung_lower.answer(parts_4, "Is h²/2 ≤ λ̃₁ with the sum of degrees as volume?", cases),
            self.chung_upper.answer(parts_5, "Is λ̃₁ ≤ 2h with the sum of degrees as volume?", cases),
            self.related.answer(parts_6, "Is h = λ_C/(1 + λ_C)?", &finite),
            self.corrected.answer(parts_7, "Is ½ (λ_C/(1 + λ_C))² ≤ λ̃₁ with the volume as printed?", &finite),
            self.printed_scaling.answer(parts_8, "Is S_ii = 1/√ω_ii defined, as printed?", cases),
            self.degree_scaling.answer(
                parts_9,
                "With S_ii = 1/√L_ii, are all eigenvalues of S L S between 0 and 2?",
                cases,
            ),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Csr;
    use crate::linalg::factor::symmetric_eigen;

    fn specimen(n: usize, edges: &[[usize; 2]]) -> Specimen {
        Specimen::of(Graph::new(n, edges).unwrap()).unwrap()
    }

    fn ratio(p: i32, q: i32) -> Rational {
        Rational::from(p) / Rational::from(q)
    }

    #[test]
    fn the_path_of_four_is_cut_in_the_middle() {
        // One edge cut; inside either half one edge, counted twice: 1/2. Degrees 1 + 2: 1/3.
        let path = specimen(4, &[[0, 1], [1, 2], [2, 3]]);
        let printed = path.printed.clone().unwrap();
        assert_eq!((printed.ratio, path.chung.ratio.clone()), (ratio(1, 2), ratio(1, 3)));
        assert!(printed.side == [2, 3] || printed.side == [0, 1]);
    }

    #[test]
    fn a_star_has_no_finite_printed_constant() {
        assert!(specimen(4, &[[0, 1], [0, 2], [0, 3]]).printed.is_none());
    }

    #[test]
    fn the_bounds_agree_with_eigenvalues_in_floating_point() {
        for n in 2..=5 {
            for graph in graphs(n).into_iter().filter(|g| component_count(g) == 1) {
                let s = Specimen::of(graph).unwrap();
                let d: Vec<f64> = s.degrees.iter().map(|d| d.approximate()).collect();
                let entries: Vec<_> = (0..n * n)
                    .map(|k| (k / n, k % n, s.stiffness.at(k / n, k % n).approximate() / (d[k / n] * d[k % n]).sqrt()))
                    .collect();
                let lambda = symmetric_eigen(&Csr::from_triplets(n, n, &entries)).unwrap().0[1];
                for k in 1..40 {
                    let t = f64::from(k) / 19.0;
                    if (t - lambda).abs() > 1e-9 {
                        let exact = Rational::exactly(t).unwrap();
                        assert_eq!(s.is_lower_bound(&exact), t < lambda, "{t} {lambda}");
                        assert_eq!(s.is_upper_bound(&exact), t > lambda, "{t} {lambda}");
                    }
                }
            }
        }
    }

    #[test]
    fn every_partition_is_seen_by_the_gray_code() {
        // Against the subsets themselves.
        let s = specimen(5, &[[0, 1], [1, 2], [2, 3], [3, 4], [4, 0], [0, 2]]);
        let weight = |a: usize, b: usize| 0.0 - s.stiffness.at(a, b).approximate();
        let mut best = f64::INFINITY;
        for mask in 1..31_usize {
            let inside = |v: usize| mask >> v & 1 == 1;
            let pairs = (0..5).flat_map(|a| (0..5).map(move |b| (a, b))).filter(|(a, b)| a != b);
            let sum = |f: &dyn Fn(usize, usize) -> bool| {
                pairs.clone().filter(|&(a, b)| f(a, b)).map(|(a, b)| weight(a, b)).sum::<f64>()
            };
            let cut = sum(&|a, b| inside(a) && !inside(b));
            let smaller = sum(&|a, b| inside(a) && inside(b)).min(sum(&|a, b| !inside(a) && !inside(b)));
            if smaller > 0.0 {
                best = best.min(cut / smaller);
            }
        }
        let found = s.printed.unwrap();
        assert!((found.ratio.approximate() - best).abs() < 1e-15, "{} {best} {:?}", found.ratio, found.side);
    }

    #[test]
    fn a_bound_that_is_too_high_is_found_out_with_a_vector() {
        let path = specimen(4, &[[0, 1], [1, 2], [2, 3]]);
        // λ̃₁ of the path of four is ½.
        assert!(path.is_lower_bound(&ratio(1, 2)) && !path.is_lower_bound(&ratio(51, 100)));
        assert!(path.slow_vector(&ratio(51, 100)).is_some() && path.slow_vector(&ratio(49, 100)).is_none());
        let cut = Cut { ratio: ratio(3, 2), side: vec![2, 3] };
        assert!(path.below_the_printed_bound(&cut).is_some());
    }
}
