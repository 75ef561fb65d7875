//! Counts the exceptions to an inequality by weights and by number of vertices, and keeps the smallest to be drawn.

use std::collections::BTreeMap;

use crate::domain::Graph;
use crate::experiment::Finding;
use crate::experiment::poll::{Case, Every};
use crate::experiment::world::cuts::{Cut, Specimen};
use crate::figure::{Figure, Sketch};

/// Drawings of a finding.
const DRAWN: usize = 4;

/// How many of how many, by number of vertices.
#[derive(Default)]
pub struct BySize(BTreeMap<usize, [usize; 2]>);

impl BySize {
    /// Counts a graph.
    pub fn count(&mut self, vertices: usize, is_one: bool) {
        let counts = self.0.entry(vertices).or_default();
        counts[0] += usize::from(is_one);
        counts[1] += 1;
    }
}

impl std::fmt::Display for BySize {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let sizes: Vec<String> = self.0.iter().map(|(n, [k, of])| format!("{k} of {of} with {n}")).collect();
        f.write_str(&sizes.join(", "))
    }
}

/// A question with its exceptions: for all weights one, and for random positive weights.
#[derive(Default)]
pub struct Tally {
    every: Every,
    unit: BySize,
    random: BySize,
    /// Exceptions with all weights one and the least number of vertices.
    smallest: Vec<Sketch>,
}

impl Tally {
    /// Counts a graph; `violation` is what speaks against the statement there, with the cut that it is about.
    pub fn ask(&mut self, s: &Specimen, violation: Option<Case>, cut: Option<&Cut>) {
        let n = s.degrees.len();
        let has_unit_weights = s.graph.weights().is_none();
        if has_unit_weights { &mut self.unit } else { &mut self.random }.count(n, violation.is_some());
        let as_small = self.smallest.first().is_none_or(|drawn| drawn.points.len() == n);
        if let (Some(_), Some(cut)) = (&violation, cut)
            && has_unit_weights
            && as_small
            && self.smallest.len() < DRAWN
        {
            self.smallest.push(drawn(&s.graph, cut));
        }
        self.every.ask(violation);
    }

    /// The answer; `cases` says what a case is.
    pub fn answer(self, part: &'static str, question: &str, cases: &str) -> Finding {
        let mut finding = self.every.answer(part, question, cases);
        let (unit, random) = (self.unit, self.random);
        finding.finding.push_str(&format!(
            "; exceptions by number of vertices, all weights one: {unit}; random positive weights: {random}"
        ));
        finding.figures = self.smallest.into_iter().map(Figure::Sketch).collect();
        finding
    }
}

/// The graph with the cut edges bold and the sides in two colours.
pub fn drawn(graph: &Graph, cut: &Cut) -> Sketch {
    let n = graph.vertex_count();
    let inside = |v: usize| cut.side.contains(&v);
    let title = format!("A smallest exception: the cut edges over the smaller volume are {}", cut.ratio);
    let values = (0..n).map(|v| if inside(v) { 1.0 } else { -1.0 }).collect();
    let marked = graph.edges().iter().copied().filter(|&[a, b]| inside(a) != inside(b)).collect();
    Sketch { values, marked, ..Sketch::of_graph(title, n, graph.edges()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exceptions_with_unit_and_with_random_weights_are_counted_apart_and_the_smallest_are_drawn() {
        let edges = |n: usize| (1..n).map(|k| [k - 1, k]).collect::<Vec<_>>();
        let specimen = |n: usize, weights: Option<f64>| {
            let graph = match weights {
                Some(w) => Graph::weighted(n, &edges(n), &vec![w; n - 1]).unwrap(),
                None => Graph::new(n, &edges(n)).unwrap(),
            };
            Specimen::of(graph).unwrap()
        };
        let mut tally = Tally::default();
        for (n, weights, violates) in
            [(4, None, false), (4, Some(2.0), true), (5, None, true), (5, Some(0.5), false), (6, None, true)]
        {
            let s = specimen(n, weights);
            tally.ask(&s, violates.then(|| Case::told("so")), s.printed.as_ref());
        }
        let finding = tally.answer("p", "?", "paths");
        assert!(!finding.agrees && finding.decided == 5, "{finding:?}");
        let counts = "all weights one: 0 of 1 with 4, 1 of 1 with 5, 1 of 1 with 6; \
                      random positive weights: 1 of 1 with 4, 0 of 1 with 5";
        assert!(finding.finding.ends_with(counts), "{}", finding.finding);
        let [Figure::Sketch(sketch)] = &finding.figures[..] else { panic!("{:?}", finding.figures) };
        assert_eq!((sketch.points.len(), sketch.marked.len()), (5, 1));
    }
}
