//! Random planar graphs: a random Delaunay triangulation without a share of its edges.

use super::random_delaunay::{POINTS, square};
use super::shape::scatter;
use super::shape::verge::{BOUNDARY, bounded, shuffled};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::Domain;
use crate::domain::faces::Faces;
use crate::domain::topology::Topology;
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "planar-graph",
    name: "edges of a random Delaunay triangulation, a share of them removed",
    guarantees: &[
        "n vertices, planar (at most 3n − 6 edges), simple, unweighted; random boundary vertices",
        "exactly round(removed · E) of the E Delaunay edges are missing; not connected in general",
    ],
    sources: &["delaunay1934"],
    parameters: &[
        POINTS,
        Parameter {
            name: "removed",
            meaning: "share of the edges removed",
            default: "0.2",
            range: Range::Number(0.0, 1.0),
        },
        BOUNDARY,
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let n = settings.whole("n");
    let faces = scatter::delaunay("planar-graph", &square(n, stream))?;
    let mut edges = Topology::new(n, &Faces::triangles(&faces)).edges().to_vec();
    stream.shuffle(&mut edges);
    edges.truncate(edges.len() - (settings.number("removed") * edges.len() as f64).round() as usize);
    bounded("planar-graph", (n, &edges), &shuffled(n, stream), settings)
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::make;

    #[test]
    fn the_share_removed_is_exact_and_what_is_left_is_a_part_of_the_whole() {
        for seed in 0..20 {
            let run = |removed| make("planar-graph", &[("n", "45"), ("removed", removed), ("boundary", "4")], seed);
            let (whole, some, none) = (run("0"), run("0.3"), run("1"));
            let e = whole.edges().len();
            assert!((44..=3 * 45 - 6).contains(&e) && whole.facts().components == 1);
            assert_eq!(some.edges().len(), e - (0.3 * e as f64).round() as usize);
            assert!(some.edges().iter().all(|edge| whole.edges().contains(edge)));
            assert_eq!((none.edges().len(), none.facts().boundary_vertices), (0, 4));
        }
    }
}
