//! The star graph.

use super::shape::verge::{BOUNDARY, bounded};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::Domain;
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "star",
    name: "star: one centre and its leaves",
    guarantees: &[
        "vertex 0 is the centre; leaves + 1 vertices, leaves edges, connected; unweighted",
        "the boundary takes leaves in order, the centre last",
    ],
    sources: &[],
    parameters: &[
        Parameter { name: "leaves", meaning: "number of leaves", default: "12", range: Range::Whole(1, 1_000_000) },
        BOUNDARY,
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let leaves = settings.whole("leaves");
    let edges: Vec<[usize; 2]> = (1..=leaves).map(|k| [0, k]).collect();
    let order: Vec<usize> = (1..=leaves).chain([0]).collect();
    bounded("star", (leaves + 1, &edges), &order, settings)
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{make, valences};

    #[test]
    fn a_star_has_one_centre_and_leaves_that_make_the_boundary() {
        for leaves in 1..20 {
            let count = leaves.to_string();
            let domain = make("star", &[("leaves", &count), ("boundary", &count)], 0);
            let expected: Vec<usize> = std::iter::once(leaves).chain((0..leaves).map(|_| 1)).collect();
            assert_eq!((valences(&domain), domain.interior()), (expected, vec![0]));
        }
    }
}
