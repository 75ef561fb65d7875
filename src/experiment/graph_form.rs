//! The Laplacian of a weighted graph in its three forms: differences, matrix, Dirichlet energy.
//!
//! An identity in `u` that is linear holds for every `u` if it holds for each `e_k`; a quadratic one if it holds for each
//! `e_k` and `e_k + e_l`. So each graph is decided for all functions at once.

use super::poll::{Case, Every};
use super::world::excerpt::on_graph;
use super::world::graphs::{describe, graphs_up_to, laplacian, random_graphs, randomly_weighted, weight};
use super::{Experiment, Finding, Setting};
use crate::domain::Graph;
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::property::Statement;
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "graph-form",
    name: "The forms of a graph's Laplacian",
    statement: "(Lu)_i = Σ_j ω_ij (u_i − u_j) is the product with L = δᵀWδ; uᵀLu = ½ Σ_i Σ_j ω_ij (u_i − u_j)²; L = Lᵀ; \
                L_ij = −ω_ij off the diagonal and L_ii = Σ_j ω_ij on it",
    sources: &["wardetzky-primer", "chung1997"],
    parts: &["matrix-form", "dirichlet-energy", "symmetry", "degree-on-the-diagonal"],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let (mut form, mut energy, mut symmetry, mut degree) =
        (Every::default(), Every::default(), Every::default(), Every::default());
    let (largest, weightings) = (setting.pick(5, 6), setting.pick(1, 3));
    let larger = random_graphs(setting.pick(6, 30), &mut stream);
    let count = larger.len();
    for graph in graphs_up_to(largest).into_iter().chain(larger) {
        let random = (0..weightings).map(|_| randomly_weighted(&graph, &mut stream)).collect::<Vec<_>>();
        for graph in [graph].iter().chain(&random) {
            let l = laplacian(graph);
            form.ask(not_the_difference_form(graph, &l));
            energy.ask(not_the_energy(graph, &l));
            symmetry.ask(not_symmetric(graph, &l));
            degree.ask(not_the_degree(graph, &l));
        }
    }
    let cases = format!(
        "weightings (all one and {weightings} random) of every graph with at most {largest} vertices and \
         {count} random ones with 7 to 12"
    );
    vec![
        form.answer("matrix-form", "Is (Lu)_i = Σ_j ω_ij (u_i − u_j) for every u?", &cases),
        energy.answer("dirichlet-energy", "Is uᵀLu = ½ Σ_i Σ_j ω_ij (u_i − u_j)² for every u?", &cases),
        symmetry.answer("symmetry", "Is L = Lᵀ?", &cases),
        degree.answer("degree-on-the-diagonal", "Is L_ij = −ω_ij off the diagonal and L_ii = Σ_j ω_ij on it?", &cases),
    ]
}

fn basis(n: usize, ones: &[usize]) -> Vec<Rational> {
    (0..n).map(|i| if ones.contains(&i) { Rational::ONE } else { Rational::zero() }).collect()
}

/// `Σ_j ω_ij (u_i − u_j)` at every vertex, edge by edge.
fn differences(graph: &Graph, u: &[Rational]) -> Vec<Rational> {
    let mut sum = vec![Rational::zero(); u.len()];
    for (k, &[i, j]) in graph.edges().iter().enumerate() {
        let flow = weight(graph, k) * (u[i].clone() - u[j].clone());
        sum[i] = sum[i].clone() + flow.clone();
        sum[j] = sum[j].clone() - flow;
    }
    sum
}

/// `½ Σ_i Σ_j ω_ij (u_i − u_j)²` over the ordered pairs.
fn energy(graph: &Graph, u: &[Rational]) -> Rational {
    let pairs = graph.edges().iter().enumerate().flat_map(|(k, &[i, j])| [(k, i, j), (k, j, i)]);
    let terms = pairs.map(|(k, i, j)| {
        let difference = u[i].clone() - u[j].clone();
        weight(graph, k) * difference.clone() * difference
    });
    crate::scalar::sum(terms) * Rational::half()
}

fn not_the_difference_form(graph: &Graph, l: &Dense<Rational>) -> Option<Case> {
    let n = graph.vertex_count();
    let k = (0..n).find(|&k| l.mul(&basis(n, &[k])) != differences(graph, &basis(n, &[k])))?;
    Some(Case::told(format!("{}: L e_{k} is not the sum of the differences of e_{k}", describe(graph))))
}

fn not_the_energy(graph: &Graph, l: &Dense<Rational>) -> Option<Case> {
    let n = graph.vertex_count();
    let ones = (0..n).flat_map(|k| (k..n).map(move |m| [k, m]));
    let bad = ones.into_iter().find(|ones| {
        let u = basis(n, ones);
        l.quadratic_form(&u) != energy(graph, &u)
    })?;
    Some(Case::told(format!("{}: for u = 1 at {bad:?}, else 0, the two sides differ", describe(graph))))
}

fn not_symmetric(graph: &Graph, l: &Dense<Rational>) -> Option<Case> {
    let [i, j] = l.asymmetry()?;
    let statement = Statement::Asymmetry { i, j, threshold: 0.0 };
    Some(Case::shown(format!("{}: L_{i}{j} ≠ L_{j}{i}", describe(graph)), on_graph(statement, graph, l, &[i, j])))
}

fn not_the_degree(graph: &Graph, l: &Dense<Rational>) -> Option<Case> {
    let n = graph.vertex_count();
    let expected = |i: usize, j: usize| {
        let edges = graph.edges().iter().enumerate();
        if i == j {
            crate::scalar::sum(edges.filter(|(_, e)| e.contains(&i)).map(|(k, _)| weight(graph, k)))
        } else {
            let between = edges.into_iter().find(|(_, e)| **e == [i.min(j), i.max(j)]);
            between.map_or_else(Rational::zero, |(k, _)| -weight(graph, k))
        }
    };
    let places = (0..n).flat_map(|i| (0..n).map(move |j| [i, j]));
    let [i, j] = places.into_iter().find(|&[i, j]| *l.at(i, j) != expected(i, j))?;
    Some(Case::told(format!("{}: L_{i}{j} is {} instead of {}", describe(graph), l.at(i, j), expected(i, j))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::world::graphs::with_weights;

    fn square() -> Graph {
        let cycle = Graph::new(4, &[[0, 1], [1, 2], [2, 3], [0, 3]]).unwrap();
        with_weights(&cycle, &[1.0, 2.0, 3.0, 4.0])
    }

    #[test]
    fn the_right_matrix_passes_every_question() {
        let (graph, l) = (square(), laplacian(&square()));
        assert!(not_the_difference_form(&graph, &l).is_none() && not_the_energy(&graph, &l).is_none());
        assert!(not_symmetric(&graph, &l).is_none() && not_the_degree(&graph, &l).is_none());
    }

    #[test]
    fn a_wrong_weight_fails_difference_form_energy_and_degree() {
        let wrong = laplacian(&with_weights(&square(), &[1.0, 2.0, 3.0, 5.0]));
        assert!(not_the_difference_form(&square(), &wrong).is_some());
        assert!(not_the_energy(&square(), &wrong).is_some());
        assert!(not_the_degree(&square(), &wrong).is_some());
    }

    #[test]
    fn a_wrong_sign_and_a_factor_one_half_fail_the_energy() {
        let l = laplacian(&square());
        for factor in [-1.0, 0.5, 2.0] {
            let factor = Rational::exactly(factor).unwrap();
            let scaled = Dense::from_fn(4, 4, |i, j| factor.clone() * l.at(i, j).clone());
            assert!(not_the_energy(&square(), &scaled).is_some());
        }
    }

    #[test]
    fn an_entry_moved_across_the_diagonal_fails_symmetry_but_not_the_energy() {
        let mut skew = laplacian(&square());
        skew.add_to(0, 2, Rational::ONE);
        skew.add_to(2, 0, -Rational::ONE);
        assert!(not_symmetric(&square(), &skew).is_some());
        assert!(not_the_energy(&square(), &skew).is_none());
        assert!(not_the_difference_form(&square(), &skew).is_some());
    }
}
