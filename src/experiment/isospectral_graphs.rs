//! Graphs that cannot be told apart by a spectrum: every pair of non-isomorphic graphs with few vertices whose Laplacians have one
//! characteristic polynomial.
//!
//! # Definitions
//! Unit weights, D the degrees, A the adjacency: `L = D − A` on every graph, and `D⁻¹L` on those without isolated vertices, which has
//! the eigenvalues of `D^(−½) L D^(−½)`. The polynomials `det(xI − L)` and `det(xI − D⁻¹L)` are computed over the rationals; two
//! graphs have the same eigenvalues with the same multiplicities exactly where the polynomials are equal.
//!
//! # What is compared
//! The enumeration has one graph of each class of isomorphic graphs, so any two of one polynomial are a pair. Smaller means
//! fewer vertices, then fewer edges.

use std::collections::BTreeMap;

use super::poll::{Case, Search};
use super::world::graphs::{component_count, describe, graphs, laplacian};
use super::{Experiment, Finding, Setting};
use crate::domain::Graph;
use crate::figure::{Figure, Sketch};
use crate::linalg::{Dense, Polynomial};
use crate::property::evidence::Fraction;
use crate::property::{Evidence, Statement};
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "isospectral-graphs",
    name: "Isospectral graphs that are not isomorphic",
    statement: "there are graphs with the same eigenvalues of L, and of D⁻¹L, that are not isomorphic; all pairs among small graphs",
    sources: &["wardetzky-primer", "haemers-spence2004", "chung1997"],
    parts: &[
        "combinatorial-laplacian",
        "normalised-laplacian",
        "connected-and-combinatorial",
        "connected-and-normalised",
    ],
    run,
};

/// Which of the two matrices.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Combinatorial,
    Normalised,
}

impl Form {
    /// The matrix; `None` where it is not defined.
    fn of(self, graph: &Graph) -> Option<Dense<Rational>> {
        let l = laplacian(graph);
        if self == Form::Combinatorial {
            return Some(l);
        }
        let n = l.rows();
        let isolated = (0..n).any(|i| l.at(i, i).cmp_zero() == std::cmp::Ordering::Equal);
        (!isolated).then(|| Dense::from_fn(n, n, |i, j| (l.at(i, j).clone() / l.at(i, i).clone()).reduced()))
    }
}

/// Graphs with one polynomial.
struct Class {
    polynomial: Polynomial<Rational>,
    graphs: Vec<Graph>,
}

/// The classes with n vertices, in the order of their first graphs.
fn classes(all: &[Graph], form: Form) -> Vec<Class> {
    let mut place: BTreeMap<Vec<Fraction>, usize> = BTreeMap::new();
    let mut classes: Vec<Class> = Vec::new();
    for graph in all {
        let Some(matrix) = form.of(graph) else { continue };
        let polynomial = Polynomial::characteristic(&matrix);
        let key = fractions(&polynomial);
        match place.get(&key) {
            Some(&at) => classes[at].graphs.push(graph.clone()),
            None => {
                place.insert(key, classes.len());
                classes.push(Class { polynomial, graphs: vec![graph.clone()] });
            }
        }
    }
    classes
}

fn fractions(polynomial: &Polynomial<Rational>) -> Vec<Fraction> {
    polynomial.coefficients().iter().map(Fraction::from).collect()
}

/// What was found for one matrix, among all graphs or the connected ones.
#[derive(Default)]
struct Tally {
    search: Search,
    lines: Vec<String>,
    figures: Vec<Figure>,
}

impl Tally {
    /// Counts the pairs among graphs with n vertices.
    fn ask(&mut self, all: &[Graph], form: Form) {
        let classes = classes(all, form);
        let (mut pairs, mut mates) = (0, 0);
        for class in &classes {
            let k = class.graphs.len();
            pairs += k * (k - 1) / 2;
            mates += if k > 1 { k } else { 0 };
        }
        let n = all.first().map_or(0, Graph::vertex_count);
        let graphs: usize = classes.iter().map(|c| c.graphs.len()).sum();
        self.lines.push(format!("{n} vertices: {pairs} pairs, {mates} of {graphs} graphs have a mate"));
        for class in classes {
            // One case for each graph: whether an earlier one, with no more edges, has its polynomial.
            for (k, graph) in class.graphs.iter().enumerate() {
                let case = (k > 0).then(|| pair(&class.graphs[0], graph, &class.polynomial, form));
                if let (Some(_), true) = (&case, self.figures.is_empty()) {
                    self.figures = [&class.graphs[0], graph].into_iter().map(sketch).collect();
                }
                self.search.ask(case);
            }
        }
    }

    fn answer(self, part: &'static str, question: &str, cases: &str) -> Finding {
        let mut finding = self.search.answer(part, question, cases);
        finding.finding += &format!("; {}", self.lines.join("; "));
        finding.figures = self.figures;
        finding
    }
}

fn pair(first: &Graph, second: &Graph, polynomial: &Polynomial<Rational>, form: Form) -> Case {
    let statement = Statement::Cospectral {
        vertices: first.vertex_count(),
        first: first.edges().to_vec(),
        second: second.edges().to_vec(),
        normalised: form == Form::Normalised,
        polynomial: fractions(polynomial),
    };
    Case::shown(format!("{} and {}", describe(first), describe(second)), Evidence::bare(statement))
}

fn sketch(graph: &Graph) -> Figure {
    let title =
        format!("one of the smallest pair, {} vertices and {} edges", graph.vertex_count(), graph.edges().len());
    Figure::Sketch(Sketch::of_graph(title, graph.vertex_count(), graph.edges()))
}

fn run(setting: &Setting) -> Vec<Finding> {
    let largest = setting.pick(6, 7);
    let mut tallies: [Tally; 4] = Default::default();
    for n in 1..=largest {
        let all = graphs(n);
        let connected: Vec<Graph> = all.iter().filter(|g| component_count(g) == 1).cloned().collect();
        for (tally, (among, form)) in tallies.iter_mut().zip([
            (&all, Form::Combinatorial),
            (&all, Form::Normalised),
            (&connected, Form::Combinatorial),
            (&connected, Form::Normalised),
        ]) {
            tally.ask(among, form);
        }
    }
    let questions = [
        ("Have two non-isomorphic graphs the same det(xI − L)?", "graphs"),
        ("Have two non-isomorphic graphs without isolated vertices the same det(xI − D⁻¹L)?", "such graphs"),
        ("Have two non-isomorphic connected graphs the same det(xI − L)?", "connected graphs"),
        ("Have two non-isomorphic connected graphs the same det(xI − D⁻¹L)?", "connected graphs"),
    ];
    let answers = tallies.into_iter().zip(ENTRY.parts).zip(questions);
    answers
        .map(|((tally, part), (question, cases))| {
            let cases = format!("{cases} with 1 to {largest} vertices, each up to renumbering");
            tally.answer(part, question, &cases)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::recheck::{self, Rechecked};

    #[test]
    fn as_many_graphs_have_a_mate_as_the_literature_says() {
        // Haemers and Spence 2004: of the Laplacian, 4 of the graphs with 6 vertices and 130 of those with 7, none with fewer.
        for (n, expected) in [(1, 0), (2, 0), (3, 0), (4, 0), (5, 0), (6, 4), (7, 130)] {
            let classes = classes(&graphs(n), Form::Combinatorial);
            let mates: usize = classes.iter().map(|c| c.graphs.len()).filter(|k| *k > 1).sum();
            assert_eq!(mates, expected, "{n}");
        }
    }

    #[test]
    fn complete_bipartite_graphs_with_as_many_vertices_have_one_normalised_spectrum() {
        // 0, 1 (n − 2 times), 2: K_{1,3} and K_{2,2} are the smallest pair.
        let classes = classes(&graphs(4), Form::Normalised);
        let pair = classes.iter().find(|c| c.graphs.len() > 1).unwrap();
        let edges: Vec<usize> = pair.graphs.iter().map(|g| g.edges().len()).collect();
        assert_eq!(edges, [3, 4]);
        assert!(super::classes(&graphs(3), Form::Normalised).iter().all(|c| c.graphs.len() == 1));
    }

    #[test]
    fn a_pair_is_verified_from_its_json_alone_and_isomorphic_graphs_are_none() {
        let square = Graph::new(4, &[[0, 1], [1, 2], [2, 3], [0, 3]]).unwrap();
        let star = Graph::new(4, &[[0, 1], [0, 2], [0, 3]]).unwrap();
        let again = Graph::new(4, &[[0, 2], [1, 2], [1, 3], [0, 3]]).unwrap();
        let polynomial = Polynomial::characteristic(&Form::Normalised.of(&square).unwrap());
        let look = |second: &Graph| {
            let evidence = pair(&square, second, &polynomial, Form::Normalised).evidence.remove(0);
            recheck::from_excerpt(&serde_json::from_str(&serde_json::to_string(&evidence).unwrap()).unwrap())
        };
        assert_eq!(look(&star), Ok(Rechecked::Exact));
        assert!(look(&again).is_err() && look(&square).is_err());
    }
}
