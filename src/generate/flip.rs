//! Random legal flips of edges.

use super::shape::input::{impossible, inherit, refused_flip, surface};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::Domain;
use crate::domain::flip::Triangulation;
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "flip",
    name: "random legal edge flips of a triangle surface; extrinsic, so that a surface in space changes its shape",
    guarantees: &[
        "the same vertices, number of edges and faces, boundary, genus, components; manifold if the input is",
        "exactly count flips, each legal when made; one may undo another",
        "a planar mesh stays planar and unfolded (exact) and keeps its area",
        "in space no face becomes degenerate; area and smoothness are not kept, and the surface may come to cross itself",
    ],
    sources: &["lawson1977"],
    parameters: &[Parameter {
        name: "count",
        meaning: "number of flips",
        default: "20",
        range: Range::Whole(0, 10_000_000),
    }],
    make: Make::Modifier(change),
};

fn change(domain: &Domain, settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let surface = surface("flip", domain)?;
    let refused = refused_flip("flip");
    let mut mesh = Triangulation::of(surface).map_err(&refused)?;
    let count = settings.whole("count");
    for made in 0..count {
        let Some(half_edge) = choose(&mesh, stream) else {
            let why = format!("after {made} of {count} flips no edge can be flipped legally; ask for at most {made}");
            return Err(impossible("flip", why));
        };
        mesh.flip(half_edge).map_err(&refused)?;
    }
    inherit(surface, mesh.into_surface())
}

/// A random legal edge, each with the same probability: by trial, or from the list of all where legal ones are rare.
fn choose(mesh: &Triangulation, stream: &mut Stream) -> Option<usize> {
    for _ in 0..64 {
        let half_edge = stream.below(mesh.half_edges());
        if mesh.half_edges() > 0 && mesh.is_legal(half_edge) {
            return Some(half_edge);
        }
    }
    let legal: Vec<usize> = (0..mesh.half_edges()).filter(|&h| mesh.is_legal(h)).collect();
    legal.get(stream.below(legal.len())).copied()
}

#[cfg(test)]
mod tests {
    use crate::domain::Domain;
    use crate::generate::GenerateError;
    use crate::generate::testing::{change, disc, given, make, surface_facts};

    fn count(n: usize) -> String {
        n.to_string()
    }

    #[test]
    fn flips_in_the_plane_keep_vertices_faces_boundary_and_area() {
        for seed in 0..25 {
            let before = make("random-delaunay", &[("n", "50")], seed);
            let after = change(&before, "flip", &[("count", &count(1 + seed as usize * 4))], seed);
            let (f, g) = (surface_facts(&before), disc(&after));
            assert_eq!(before.positions(), after.positions());
            assert_eq!(before.boundary(), after.boundary());
            assert_eq!((before.edges().len(), before.facts().faces), (after.edges().len(), after.facts().faces));
            // Each of F areas below ½ and their sum carries a few roundings of magnitude 1.
            assert!((f.area - g.area).abs() < 200.0 * f64::EPSILON);
        }
    }

    #[test]
    fn one_flip_exchanges_one_edge() {
        for seed in 0..20 {
            let before = make("grid", &[], seed);
            let after = change(&before, "flip", &[("count", "1")], seed);
            let gone = before.edges().iter().filter(|e| !after.edges().contains(e)).count();
            let came = after.edges().iter().filter(|e| !before.edges().contains(e)).count();
            assert_eq!((gone, came), (1, 1));
        }
    }

    #[test]
    fn flips_in_space_keep_the_topology_and_make_no_degenerate_face() {
        for seed in 0..10 {
            let before = make("torus", &[("levels", "1")], seed);
            let after = change(&before, "flip", &[("count", "150")], seed);
            let f = surface_facts(&after);
            assert_eq!(
                (f.genus, f.closed, f.manifold, f.degenerate_faces, f.duplicate_faces),
                (Some(1), true, true, 0, 0)
            );
            assert_eq!(before.edges().len(), after.edges().len());
        }
    }

    #[test]
    fn a_mesh_without_a_flippable_edge_and_a_graph_are_refused() {
        let run = |d: &Domain| super::ENTRY.run(Some(d), &given(&[("count", "3")]), 1).unwrap_err();
        let tetrahedron = make("polyhedron", &[("shape", "tetrahedron")], 0);
        assert!(matches!(run(&tetrahedron), GenerateError::Impossible { .. }));
        assert!(run(&tetrahedron).to_string().contains("after 0 of 3 flips"));
        assert!(run(&make("path", &[], 0)).to_string().contains("not a graph"));
    }
}
