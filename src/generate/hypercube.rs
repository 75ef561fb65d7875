//! The graph of a cube of any dimension.

use super::shape::verge::{BOUNDARY, bounded, shuffled};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::Domain;
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "hypercube",
    name: "graph of the cube of dimension d: binary words that differ in one digit",
    guarantees: &["2^d vertices, d·2^(d−1) edges, connected, every valence d; unweighted; random boundary vertices"],
    sources: &[],
    parameters: &[Parameter { name: "d", meaning: "dimension", default: "4", range: Range::Whole(1, 17) }, BOUNDARY],
    make: Make::Source(make),
};

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let d = settings.whole("d");
    let n = 1_usize << d;
    let edges: Vec<[usize; 2]> =
        (0..n).flat_map(|word| (0..d).map(move |digit| [word, word ^ (1 << digit)])).filter(|[a, b]| a < b).collect();
    bounded("hypercube", (n, &edges), &shuffled(n, stream), settings)
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{make, valences};

    #[test]
    fn a_hypercube_is_connected_bipartite_and_regular() {
        for d in 1..9 {
            let domain = make("hypercube", &[("d", &d.to_string())], 4);
            assert_eq!(valences(&domain), vec![d; 1 << d]);
            assert_eq!(domain.facts().components, 1);
            assert!(domain.edges().iter().all(|[a, b]| (a.count_ones() + b.count_ones()) % 2 == 1));
        }
    }
}
