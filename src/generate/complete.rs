//! The complete graph.

use super::shape::input::admit;
use super::shape::verge::{BOUNDARY, bounded, shuffled};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::Domain;
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "complete",
    name: "complete graph on n vertices",
    guarantees: &["n vertices, n(n−1)/2 edges, every valence n − 1; unweighted; random boundary vertices"],
    sources: &[],
    parameters: &[
        Parameter { name: "n", meaning: "number of vertices", default: "10", range: Range::Whole(2, 2_000) },
        BOUNDARY,
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let n = settings.whole("n");
    admit("complete", "edges", n * (n - 1) / 2)?;
    let edges: Vec<[usize; 2]> = (0..n).flat_map(|a| (a + 1..n).map(move |b| [a, b])).collect();
    bounded("complete", (n, &edges), &shuffled(n, stream), settings)
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{make, valences};

    #[test]
    fn every_vertex_of_a_complete_graph_meets_all_others() {
        for n in 2..20 {
            let domain = make("complete", &[("n", &n.to_string()), ("boundary", "1")], 4);
            assert_eq!(valences(&domain), vec![n - 1; n]);
            assert_eq!(domain.facts().boundary_vertices, 1);
        }
    }
}
