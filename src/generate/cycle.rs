//! The cycle graph.

use super::shape::verge::{BOUNDARY, bounded, shuffled};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::Domain;
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "cycle",
    name: "cycle of n vertices",
    guarantees: &["n vertices, n edges, connected, every valence 2; unweighted; random boundary vertices"],
    sources: &[],
    parameters: &[
        Parameter { name: "n", meaning: "number of vertices", default: "12", range: Range::Whole(3, 1_000_000) },
        BOUNDARY,
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let n = settings.whole("n");
    let edges: Vec<[usize; 2]> = (0..n).map(|k| [k, (k + 1) % n]).collect();
    bounded("cycle", (n, &edges), &shuffled(n, stream), settings)
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{make, valences};

    #[test]
    fn a_cycle_is_connected_with_all_valences_two() {
        for n in 3..30 {
            let domain = make("cycle", &[("n", &n.to_string()), ("boundary", "3")], n as u64);
            assert_eq!(valences(&domain), vec![2; n]);
            assert_eq!((domain.facts().components, domain.facts().boundary_vertices), (1, 3));
        }
    }
}
