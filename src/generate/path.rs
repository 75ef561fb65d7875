//! The path graph.

use super::shape::input::admit;
use super::shape::verge::{BOUNDARY, bounded};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::Domain;
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "path",
    name: "path of n vertices in a row",
    guarantees: &[
        "n vertices, n − 1 edges, connected; unweighted",
        "the boundary takes the two ends first, then the others in order",
    ],
    sources: &[],
    parameters: &[
        Parameter { name: "n", meaning: "number of vertices", default: "12", range: Range::Whole(1, 1_000_000) },
        BOUNDARY,
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let n = settings.whole("n");
    admit("path", "vertices", n)?;
    let edges: Vec<[usize; 2]> = (1..n).map(|k| [k - 1, k]).collect();
    let order: Vec<usize> = [0].into_iter().chain((1..n).rev().take(1)).chain(1..n.saturating_sub(1)).collect();
    bounded("path", (n, &edges), &order, settings)
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::make;

    #[test]
    fn a_path_is_a_tree_with_two_leaves_which_are_the_first_boundary() {
        let single = make("path", &[("n", "1")], 0).facts();
        assert_eq!((single.vertices, single.edges), (1, 0));
        for n in 2..30 {
            let domain = make("path", &[("n", &n.to_string()), ("boundary", "2")], 0);
            let facts = domain.facts();
            assert_eq!((facts.vertices, facts.edges, facts.components, facts.boundary_vertices), (n, n - 1, 1, 2));
            assert!(domain.boundary()[0] && domain.boundary()[n - 1]);
        }
    }
}
