//! Random weights for the edges of a graph, a prescribed share of them negative.

use super::shape::input::impossible;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Graph};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "random-weights",
    name: "random edge weights of a graph, a share of them negative",
    guarantees: &[
        "the same vertices, edges and boundary; magnitudes uniformly in [low, high)",
        "exactly round(negative · E) weights are negative, all others positive, none zero",
    ],
    sources: &[],
    parameters: &[
        Parameter { name: "low", meaning: "smallest magnitude", default: "0.5", range: Range::Number(1e-12, 1e12) },
        Parameter { name: "high", meaning: "largest magnitude", default: "2", range: Range::Number(1e-12, 1e12) },
        Parameter {
            name: "negative",
            meaning: "share of negative weights",
            default: "0",
            range: Range::Number(0.0, 1.0),
        },
    ],
    make: Make::Modifier(change),
};

fn change(domain: &Domain, settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let Domain::Graph(graph) = domain else {
        let why = format!("it weights the edges of a graph, not of a {}; put 'as-graph' before it", domain.kind());
        return Err(impossible("random-weights", why));
    };
    let (low, high) = (settings.number("low"), settings.number("high"));
    if low > high {
        return Err(impossible("random-weights", format!("low = {low} must not exceed high = {high}")));
    }
    let edges = graph.edges();
    let mut weights: Vec<f64> = edges.iter().map(|_| stream.between(low, high)).collect();
    let negative = (settings.number("negative") * edges.len() as f64).round() as usize;
    let mut order: Vec<usize> = (0..edges.len()).collect();
    stream.shuffle(&mut order);
    order[..negative].iter().for_each(|&e| weights[e] = -weights[e]);
    let boundary: Vec<usize> = (0..graph.vertex_count()).filter(|&v| graph.boundary()[v]).collect();
    Ok(Graph::weighted(graph.vertex_count(), edges, &weights)?.with_boundary(&boundary)?.into())
}

#[cfg(test)]
mod tests {
    use crate::domain::Domain;
    use crate::generate::testing::{change, given, make};

    #[test]
    fn the_share_of_negative_weights_is_exact() {
        for seed in 0..20 {
            let before = make("gnp", &[("boundary", "5")], seed);
            for share in ["0", "0.25", "0.5", "1"] {
                let given = [("low", "0.5"), ("high", "3"), ("negative", share)];
                let Domain::Graph(g) = change(&before, "random-weights", &given, seed) else { panic!("a graph") };
                assert_eq!((g.edges(), g.boundary()), (before.edges(), before.boundary()));
                let weights = g.weights().unwrap();
                let expected = (share.parse::<f64>().unwrap() * weights.len() as f64).round() as usize;
                assert_eq!(weights.iter().filter(|w| **w < 0.0).count(), expected);
                assert!(weights.iter().all(|w| (0.5..3.0).contains(&w.abs())));
            }
        }
    }

    #[test]
    fn a_surface_and_an_empty_interval_are_refused() {
        let run = |d: &Domain| super::ENTRY.run(Some(d), &given(&[("low", "3")]), 1).unwrap_err().to_string();
        assert!(run(&make("grid", &[], 0)).contains("put 'as-graph' before it"));
        assert!(run(&make("path", &[], 0)).contains("must not exceed"));
    }
}
