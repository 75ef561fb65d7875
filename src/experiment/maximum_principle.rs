//! Positive weights and the three forms of the maximum principle, on every small graph with every set of prescribed values.

use super::poll::{Case, Every};
use super::world::excerpt::{on_graph, rows};
use super::world::graphs::{describe, graphs_up_to, laplacian, proper_subsets, randomly_weighted, rational, unreached};
use super::world::harmonic::{Violation, global, heat, local};
use super::{Experiment, Finding, Setting};
use crate::domain::Graph;
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "maximum-principle",
    name: "Positive weights and the maximum principle on graphs",
    statement: "for positive weights: MAX-local at every vertex with a neighbour; MAX-global for a set of prescribed values \
                exactly when every other vertex is joined to it; MAX-heat for every positive lumped mass and time",
    sources: &["wardetzky-primer", "wardetzky2007"],
    parts: &["global", "global-where-joined", "exactly-where-joined", "local-with-neighbour", "heat"],
    run,
};

/// The times of the implicit heat steps: small, medium and large against a weight of one.
const TIMES: [f64; 3] = [1.0 / 64.0, 1.0, 64.0];

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let (mut every_set, mut joined, mut exactly) = (Every::default(), Every::default(), Every::default());
    let (mut at_vertices, mut heated) = (Every::default(), Every::default());
    let largest = setting.pick(5, 6);
    for graph in graphs_up_to(largest) {
        let random = randomly_weighted(&graph, &mut stream);
        for graph in [&graph, &random] {
            let l = laplacian(graph);
            for set in proper_subsets(graph.vertex_count()) {
                let violation = global(&l, &set);
                let reached = unreached(graph, &set).is_empty();
                exactly.ask((violation.is_none() != reached).then(|| not_equivalent(graph, &set, reached)));
                let case = violation.map(|v| case(graph, &l, v));
                if reached {
                    joined.ask(case.clone());
                }
                every_set.ask(case);
            }
            let with_neighbour = (0..graph.vertex_count()).filter(|i| graph.edges().iter().any(|e| e.contains(i)));
            with_neighbour.for_each(|i| at_vertices.ask(local(&l, i).map(|v| case(graph, &l, v))));
            for t in TIMES {
                let mass: Vec<f64> = (0..l.rows()).map(|_| (1 + stream.below(64)) as f64 / 16.0).collect();
                heated.ask(heat_loss(graph, &l, &mass, t));
            }
        }
    }
    let of = format!("of every graph with at most {largest} vertices, weights one and random positive");
    let sets = format!("sets of prescribed vertices {of}");
    vec![
        every_set.answer("global", "Does MAX-global hold for every set of prescribed values?", &sets),
        joined.answer(
            "global-where-joined",
            "Does MAX-global hold for every set to which every other vertex is joined?",
            &sets,
        ),
        exactly.answer(
            "exactly-where-joined",
            "Does MAX-global hold exactly for the sets to which every other vertex is joined?",
            &sets,
        ),
        at_vertices.answer(
            "local-with-neighbour",
            "Does MAX-local hold at every vertex that has a neighbour?",
            &format!("vertices {of}"),
        ),
        heated.answer(
            "heat",
            "Is (M + tL)⁻¹ M ≥ 0 for random positive lumped masses and t = 1/64, 1, 64?",
            &format!("steps {of}"),
        ),
    ]
}

fn case(graph: &Graph, l: &Dense<Rational>, violation: Violation) -> Case {
    let text = format!("{}: {}", describe(graph), violation.text);
    Case::shown(text, on_graph(violation.statement, graph, l, &violation.rows))
}

fn not_equivalent(graph: &Graph, set: &[usize], reached: bool) -> Case {
    let joined = if reached { "is joined" } else { "is not joined" };
    Case::told(format!("{} with {set:?}: the rest {joined} to the set, MAX-global says the opposite", describe(graph)))
}

fn heat_loss(graph: &Graph, l: &Dense<Rational>, mass: &[f64], t: f64) -> Option<Case> {
    let exact: Vec<Rational> = mass.iter().map(|&m| rational(m)).collect();
    let violation = heat(l, &exact, &rational(t))?;
    let mut case = case(graph, l, violation);
    let diagonal = Dense::from_fn(l.rows(), l.rows(), |i, j| if i == j { exact[i].clone() } else { Rational::zero() });
    let all: Vec<usize> = (0..l.rows()).collect();
    case.evidence.iter_mut().for_each(|e| e.excerpt.mass_rows = rows(&diagonal, &all));
    Some(case)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::Statement;

    #[test]
    fn a_negative_weight_makes_each_question_fail() {
        let graph = Graph::weighted(3, &[[0, 1], [0, 2]], &[2.0, -1.0]).unwrap();
        let l = laplacian(&graph);
        let found = case(&graph, &l, global(&l, &[1, 2]).unwrap());
        assert!(matches!(found.evidence[0].statement, Statement::Overshoot { at: 0, source: 1, low: false, .. }));
        assert!(local(&l, 0).is_some());
        let loss = heat_loss(&graph, &l, &[1.0, 1.0, 1.0], 1.0 / 64.0).unwrap();
        assert_eq!(loss.evidence[0].excerpt.mass_rows.len(), 3);
    }

    #[test]
    fn positive_weights_lose_no_heat() {
        let graph = Graph::weighted(3, &[[0, 1], [0, 2]], &[2.0, 1.0]).unwrap();
        assert!(heat_loss(&graph, &laplacian(&graph), &[1.0, 0.5, 3.0], 64.0).is_none());
    }
}
