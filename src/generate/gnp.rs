//! Random graphs G(n, p).

use super::shape::input::admit;
use super::shape::verge::{BOUNDARY, bounded, shuffled};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::Domain;
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "gnp",
    name: "random graph G(n, p): each pair is an edge with probability p, independently",
    guarantees: &[
        "n vertices, simple, unweighted; random boundary vertices",
        "not connected in general, isolated vertices possible; p = 0 has no edge and p = 1 all",
    ],
    sources: &["gilbert1959"],
    parameters: &[
        Parameter { name: "n", meaning: "number of vertices", default: "40", range: Range::Whole(2, 2_000) },
        Parameter { name: "p", meaning: "probability of an edge", default: "0.15", range: Range::Number(0.0, 1.0) },
        BOUNDARY,
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let (n, p) = (settings.whole("n"), settings.number("p"));
    admit("gnp", "pairs", n * (n - 1) / 2)?;
    let pairs = (0..n).flat_map(|a| (a + 1..n).map(move |b| [a, b]));
    let edges: Vec<[usize; 2]> = pairs.filter(|_| stream.unit() < p).collect();
    bounded("gnp", (n, &edges), &shuffled(n, stream), settings)
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::make;

    fn edges(n: usize, p: f64, seed: u64) -> usize {
        make("gnp", &[("n", &n.to_string()), ("p", &p.to_string()), ("boundary", "2")], seed).edges().len()
    }

    #[test]
    fn the_number_of_edges_is_binomial() {
        let pairs = 60.0 * 59.0 / 2.0;
        for p in [0.05, 0.3, 0.8] {
            let total: usize = (0..40).map(|seed| edges(60, p, seed)).sum();
            // Six standard deviations of the sum of 40 draws.
            let (mean, deviation) = (40.0 * pairs * p, (40.0 * pairs * p * (1.0 - p)).sqrt());
            assert!((total as f64 - mean).abs() < 6.0 * deviation, "{p}: {total} for {mean}");
        }
        assert_eq!((edges(30, 0.0, 1), edges(30, 1.0, 1)), (0, 435));
    }
}
