//! With positive weights the value of a harmonic function is an average of its neighbours' values.

use std::cmp::Ordering;

use super::poll::{Case, Every};
use super::world::excerpt::on_graph;
use super::world::graphs::{component_count, describe, graphs_up_to, laplacian, proper_subsets, randomly_weighted};
use super::world::harmonic::{extension, outside};
use super::{Experiment, Finding, Setting};
use crate::domain::Graph;
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::property::Statement;
use crate::scalar::{Rational, Scalar, sum};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "mean-value-property",
    name: "The mean value property of graphs with positive weights",
    statement: "at a vertex i with a neighbour the quotients ω_ij/L_ii are positive and sum to one, so that (Lu)_i = 0 says \
                that u_i is a convex combination of its neighbours' values",
    sources: &["wardetzky-primer"],
    parts: &["rows-are-convex-combinations", "harmonic-values-are-averages"],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let (mut rows, mut values) = (Every::default(), Every::default());
    let largest = setting.pick(5, 6);
    for graph in graphs_up_to(largest) {
        let random = randomly_weighted(&graph, &mut stream);
        for graph in [&graph, &random] {
            let l = laplacian(graph);
            let with_neighbour = (0..graph.vertex_count()).filter(|i| graph.edges().iter().any(|e| e.contains(i)));
            with_neighbour.for_each(|i| rows.ask(not_convex(graph, &l, i)));
            if component_count(graph) == 1 {
                for set in proper_subsets(graph.vertex_count()) {
                    let prescribed: Vec<Rational> = set.iter().map(|_| draw(&mut stream)).collect();
                    values.ask(not_an_average(graph, &l, &set, &prescribed));
                }
            }
        }
    }
    let weightings = format!("of every graph with at most {largest} vertices, with weights one and random positive");
    vec![
        rows.answer(
            "rows-are-convex-combinations",
            "Are the quotients ω_ij/L_ii at a vertex with a neighbour positive, with sum one?",
            &format!("vertices {weightings}"),
        ),
        values.answer(
            "harmonic-values-are-averages",
            "Is a harmonic value the weighted average of its neighbours' values and between their extremes?",
            &format!("Dirichlet problems (every set of prescribed vertices, random values), connected, {weightings}"),
        ),
    ]
}

fn draw(stream: &mut Stream) -> Rational {
    Rational::from_parts((stream.below(33) as i64 - 16).into(), 8u8.into())
}

fn not_convex(graph: &Graph, l: &Dense<Rational>, i: usize) -> Option<Case> {
    let case = |j: usize, text: String| {
        let statement = Statement::NotConvex { i, j };
        Case::shown(format!("{}: {text}", describe(graph)), on_graph(statement, graph, l, &[i]))
    };
    if l.at(i, i).cmp_zero() != Ordering::Greater {
        return Some(case(i, format!("L_{i}{i} is {}", l.at(i, i))));
    }
    let neighbours: Vec<usize> = (0..l.columns()).filter(|&j| j != i && l.at(i, j).cmp_zero().is_ne()).collect();
    let share = |j: usize| -l.at(i, j).clone() / l.at(i, i).clone();
    if let Some(&j) = neighbours.iter().find(|&&j| share(j).cmp_zero() == Ordering::Less) {
        return Some(case(j, format!("vertex {j} has the share {} in vertex {i}", share(j).reduced())));
    }
    let total = sum(neighbours.iter().map(|&j| share(j)));
    (total != Rational::ONE)
        .then(|| Case::told(format!("{}: the shares at vertex {i} sum to {total}", describe(graph))))
}

fn not_an_average(graph: &Graph, l: &Dense<Rational>, set: &[usize], prescribed: &[Rational]) -> Option<Case> {
    let inside = outside(graph.vertex_count(), set);
    let mut u = vec![Rational::zero(); graph.vertex_count()];
    set.iter().zip(prescribed).for_each(|(&b, value)| u[b] = value.clone());
    let Some(h) = extension(l, set) else {
        return Some(Case::told(format!("{}: no unique harmonic extension from {set:?}", describe(graph))));
    };
    inside.iter().zip(h.mul(prescribed)).for_each(|(&i, value)| u[i] = value);
    let bad = inside.into_iter().find(|&i| !is_average(graph, &u, i))?;
    Some(Case::told(format!("{}: values {u:?}, prescribed at {set:?}, at vertex {bad}", describe(graph))))
}

/// Whether `u_i Σ ω = Σ ω u_j` over the edges at i, and `u_i` is between the extremes of the `u_j`.
fn is_average(graph: &Graph, u: &[Rational], i: usize) -> bool {
    let edges = graph.edges().iter().enumerate().filter(|(_, e)| e.contains(&i));
    let stencil: Vec<(Rational, &Rational)> =
        edges.map(|(k, e)| (super::world::graphs::weight(graph, k), &u[e[0] + e[1] - i])).collect();
    let total = sum(stencil.iter().map(|(w, _)| w.clone()));
    let weighted = sum(stencil.iter().map(|(w, v)| w.clone() * (*v).clone()));
    u[i].clone() * total == weighted
        && stencil.iter().any(|(_, v)| **v <= u[i])
        && stencil.iter().any(|(_, v)| **v >= u[i])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::world::graphs::rational;

    fn star(weights: &[f64; 3]) -> Graph {
        Graph::weighted(4, &[[0, 1], [0, 2], [0, 3]], weights).unwrap()
    }

    #[test]
    fn a_negative_weight_is_found_as_a_negative_share() {
        let graph = star(&[1.0, 2.0, -0.5]);
        let case = not_convex(&graph, &laplacian(&graph), 0).unwrap();
        assert_eq!(case.evidence[0].statement, Statement::NotConvex { i: 0, j: 3 });
        assert!(not_convex(&star(&[1.0, 2.0, 0.5]), &laplacian(&star(&[1.0, 2.0, 0.5])), 0).is_none());
    }

    #[test]
    fn a_diagonal_that_is_not_the_degree_is_found() {
        let graph = star(&[1.0, 2.0, 3.0]);
        let mut l = laplacian(&graph);
        l.add_to(0, 0, Rational::ONE);
        assert!(not_convex(&graph, &l, 0).is_some());
        l.add_to(0, 0, rational(-7.0));
        assert_eq!(not_convex(&graph, &l, 0).unwrap().evidence[0].statement, Statement::NotConvex { i: 0, j: 0 });
    }

    #[test]
    fn a_harmonic_value_outside_its_neighbours_is_found() {
        let values = [1.0, 0.0, 4.0].map(rational);
        let good = star(&[1.0, 2.0, 1.0]);
        assert!(not_an_average(&good, &laplacian(&good), &[1, 2, 3], &values).is_none());
        // (1 + 0 − 4·½·1)/… : u_0 = (1·1 + 1·0 − ½·4)/(3/2) = −2/3 is below all its neighbours.
        let bad = star(&[1.0, 1.0, -0.5]);
        assert!(not_an_average(&bad, &laplacian(&bad), &[1, 2, 3], &values).is_some());
        // The matrix of other weights than the graph's: an average, but not of these weights.
        assert!(not_an_average(&good, &laplacian(&star(&[1.0, 1.0, 1.0])), &[1, 2, 3], &values).is_some());
    }
}
