//! Signs of weights and of eigenvalues on graphs: inertia and kernel, exactly, on every small graph.

use super::poll::{Case, Every, Search};
use super::world::excerpt::{on_graph, sparse};
use super::world::graphs::{
    component_count, describe, graphs_up_to, laplacian, random_graphs, randomly_weighted, with_weights,
};
use super::{Experiment, Finding, Setting};
use crate::domain::Graph;
use crate::domain::topology::components;
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::property::{Evidence, Statement};
use crate::scalar::Rational;

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "graph-positivity",
    name: "Positive weights and positive semi-definiteness on graphs",
    statement: "positive weights give a positive semi-definite L whose kernel is the functions that are constant on each \
                component; some graphs with a negative weight are positive semi-definite as well, some are not",
    sources: &["wardetzky-primer", "chung1997"],
    parts: &[
        "positive-weights-are-psd",
        "kernel-is-locally-constant",
        "connected-kernel-is-constant",
        "negative-weight-and-psd",
        "negative-weight-and-not-psd",
    ],
    run,
};

/// The weights tried on every edge in the search for a negative weight.
const TRIED: [f64; 3] = [-1.0, 1.0, 2.0];

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let (mut psd, mut kernel, mut constants) = (Every::default(), Every::default(), Every::default());
    let (largest, weightings) = (setting.pick(5, 6), setting.pick(2, 4));
    let larger = random_graphs(setting.pick(6, 30), &mut stream);
    let count = larger.len();
    for graph in graphs_up_to(largest).into_iter().chain(larger) {
        let random = (0..weightings).map(|_| randomly_weighted(&graph, &mut stream)).collect::<Vec<_>>();
        for graph in [graph].iter().chain(&random) {
            let l = laplacian(graph);
            psd.ask(not_semidefinite(graph, &l));
            kernel.ask(kernel_not_locally_constant(graph, &l));
            if component_count(graph) == 1 {
                constants.ask(kernel_not_constant(graph, &l));
            }
        }
    }
    let cases = format!(
        "weightings (all one and {weightings} random positive) of every graph with at most {largest} vertices \
         and {count} random ones with 7 to 12"
    );
    let connected =
        format!("weightings of the connected graphs with at most {largest} vertices and among {count} random ones");
    let (with, without) = negative_weights(setting.pick(3, 4));
    vec![
        psd.answer("positive-weights-are-psd", "Do positive weights make L positive semi-definite?", &cases),
        kernel.answer(
            "kernel-is-locally-constant",
            "With positive weights, is the kernel the functions that are constant on each component?",
            &cases,
        ),
        constants.answer(
            "connected-kernel-is-constant",
            "With positive weights on a connected graph, is the kernel the constants?",
            &connected,
        ),
        with,
        without,
    ]
}

/// Searches every graph, every weighting by [`TRIED`] with a negative weight; the inertia decides each.
fn negative_weights(largest: usize) -> (Finding, Finding) {
    let (mut semidefinite, mut indefinite) = (Search::default(), Search::default());
    for graph in graphs_up_to(largest) {
        let count = graph.edges().len();
        for code in 0..TRIED.len().pow(count as u32) {
            let weights: Vec<f64> = (0..count).map(|k| TRIED[code / TRIED.len().pow(k as u32) % TRIED.len()]).collect();
            let Some(edge) = weights.iter().position(|w| *w < 0.0) else { continue };
            let graph = with_weights(&graph, &weights);
            let l = laplacian(&graph);
            let spoilt = not_semidefinite(&graph, &l);
            semidefinite.ask(spoilt.is_none().then(|| negative_weight(&graph, &l, edge)));
            indefinite.ask(spoilt);
        }
    }
    let cases =
        format!("weightings by −1, 1 and 2, one at least negative, of every graph with at most {largest} vertices");
    (
        semidefinite.answer(
            "negative-weight-and-psd",
            "Is L positive semi-definite on some graph with a negative weight?",
            &cases,
        ),
        indefinite.answer(
            "negative-weight-and-not-psd",
            "Does L take a negative value xᵀLx on some graph with a negative weight?",
            &cases,
        ),
    )
}

fn negative_weight(graph: &Graph, l: &Dense<Rational>, edge: usize) -> Case {
    let [i, j] = graph.edges()[edge];
    let inertia = l.eliminate().inertia();
    let text = format!("{}, with {} positive and {} zero eigenvalues", describe(graph), inertia.positive, inertia.zero);
    let statement = Statement::Weight { i, j, zero: false, opposite: Vec::new() };
    Case::shown(text, on_graph(statement, graph, l, &[i]))
}

fn not_semidefinite(graph: &Graph, l: &Dense<Rational>) -> Option<Case> {
    let x = l.eliminate().negative_direction()?;
    let (value, x) = (l.quadratic_form(&x), sparse(&x));
    let support: Vec<usize> = x.iter().map(|(i, _)| *i).collect();
    let text = format!("{}: xᵀLx = {value} for x = {x:?}", describe(graph));
    Some(Case::shown(text, on_graph(Statement::NegativeEnergy { x }, graph, l, &support)))
}

/// The kernel is as large as the number of components and each of its vectors is constant on each of them; the rank agrees.
fn kernel_not_locally_constant(graph: &Graph, l: &Dense<Rational>) -> Option<Case> {
    let of = components(graph.vertex_count(), graph.edges());
    let (kernel, expected) = (l.kernel(), component_count(graph));
    for x in &kernel {
        let pairs = (0..of.len()).flat_map(|a| (a + 1..of.len()).map(move |b| (a, b)));
        if let Some((a, b)) = pairs.into_iter().find(|&(a, b)| of[a] == of[b] && x[a] != x[b]) {
            return Some(Case::shown(format!("{}: {x:?}", describe(graph)), kernel_vector(graph, l, x, a, b)));
        }
    }
    let rank = graph.vertex_count() - l.eliminate().inertia().zero;
    (kernel.len() != expected || rank + expected != graph.vertex_count()).then(|| {
        Case::told(format!("{}: dimension {} for {expected} components, rank {rank}", describe(graph), kernel.len()))
    })
}

fn kernel_vector(graph: &Graph, l: &Dense<Rational>, x: &[Rational], a: usize, b: usize) -> Evidence {
    // Scaled so that the values at a and b differ by one.
    let difference = x[a].clone() - x[b].clone();
    let scaled: Vec<Rational> = x.iter().map(|v| v.clone() / difference.clone()).collect();
    let all: Vec<usize> = (0..l.rows()).collect();
    let statement = Statement::KernelVector { x: sparse(&scaled), a, b, threshold: f64::EPSILON };
    on_graph(statement, graph, l, &all)
}

fn kernel_not_constant(graph: &Graph, l: &Dense<Rational>) -> Option<Case> {
    let kernel = l.eliminate().kernel();
    let constant = kernel.len() == 1 && kernel[0].iter().all(|v| *v == kernel[0][0]);
    (!constant).then(|| Case::told(format!("{}: the kernel has dimension {}", describe(graph), kernel.len())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::factor::Inertia;

    fn triangle(weights: &[f64; 3]) -> Graph {
        Graph::weighted(3, &[[0, 1], [0, 2], [1, 2]], weights).unwrap()
    }

    #[test]
    fn a_triangle_is_psd_exactly_when_sum_and_pairwise_products_are_nonnegative() {
        // The two eigenvalues beside 0 have the sum 2(a + b + c) and the product 3(ab + bc + ca).
        let values = [-2.0, -1.0, -0.5, 1.0, 2.0, 3.0];
        for a in values {
            for b in values {
                for c in values {
                    let graph = triangle(&[a, b, c]);
                    let expected = a + b + c >= 0.0 && a * b + b * c + c * a >= 0.0;
                    assert_eq!(not_semidefinite(&graph, &laplacian(&graph)).is_none(), expected, "{a} {b} {c}");
                }
            }
        }
    }

    #[test]
    fn a_planted_negative_weight_is_found_with_its_direction() {
        let graph = triangle(&[1.0, 1.0, -1.0]);
        let case = not_semidefinite(&graph, &laplacian(&graph)).unwrap();
        assert!(matches!(case.evidence[0].statement, Statement::NegativeEnergy { .. }));
    }

    #[test]
    fn a_cancelled_edge_enlarges_the_kernel_and_is_found() {
        // The weights −1, 2, 2 have ab + bc + ca = 0: a second vector in the kernel of a connected graph.
        let graph = triangle(&[-1.0, 2.0, 2.0]);
        let l = laplacian(&graph);
        assert_eq!(l.eliminate().inertia(), Inertia { negative: 0, zero: 2, positive: 1 });
        assert!(kernel_not_constant(&graph, &l).is_some());
        let found = kernel_not_locally_constant(&graph, &l).unwrap();
        assert!(matches!(found.evidence[0].statement, Statement::KernelVector { .. }));
    }
}
