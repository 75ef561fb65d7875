//! Flips a planar triangulation to Delaunay.

use super::shape::input::{inherit, refused_flip, surface};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::Domain;
use crate::domain::flip::Triangulation;
use crate::parameter::Settings;

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "delaunay",
    name: "Delaunay triangulation of a planar mesh by edge flips, with the exact in-circle predicate",
    guarantees: &[
        "the same vertices and boundary, planar; no interior edge violates the Delaunay condition (exact)",
        "a Delaunay mesh is left as it is; a cocircular edge is never flipped",
    ],
    sources: &["lawson1977"],
    parameters: &[],
    make: Make::Modifier(change),
};

fn change(domain: &Domain, _: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let surface = surface("delaunay", domain)?;
    let refused = refused_flip("delaunay");
    let mut mesh = Triangulation::of(surface).map_err(&refused)?;
    mesh.flip_to_delaunay().map_err(&refused)?;
    inherit(surface, mesh.into_surface())
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{change, disc, given, make};

    #[test]
    fn flips_undo_flips_because_the_delaunay_triangulation_is_unique() {
        for seed in 0..25 {
            let start = make("random-delaunay", &[("n", "70")], seed);
            let flipped = change(&start, "flip", &[("count", "200")], seed);
            assert_ne!(flipped.edges(), start.edges());
            let back = change(&flipped, "delaunay", &[], 0);
            assert_eq!(back.edges(), start.edges());
            assert_eq!(disc(&back).delaunay, Some(true));
            assert_eq!(change(&start, "delaunay", &[], 0).digest(), start.digest());
        }
    }

    #[test]
    fn a_surface_in_space_is_refused() {
        let error = super::ENTRY.run(Some(&make("icosphere", &[], 0)), &given(&[]), 0).unwrap_err();
        assert!(error.to_string().contains("coordinate plane"), "{error}");
    }
}
