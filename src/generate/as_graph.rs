//! The graph of the edges of a mesh.

use super::shape::input::impossible;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Graph};
use crate::parameter::Settings;

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "as-graph",
    name: "graph of the edges of a surface or volume; positions are forgotten",
    guarantees: &["the same vertices, edges, components and boundary vertices; unweighted"],
    sources: &[],
    parameters: &[],
    make: Make::Modifier(change),
};

fn change(domain: &Domain, _: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    if !matches!(domain, Domain::Surface(_) | Domain::Volume(_)) {
        return Err(impossible(
            "as-graph",
            format!("it reads the edges of a surface or volume, not of {}", domain.kind()),
        ));
    }
    let boundary: Vec<usize> = (0..domain.vertex_count()).filter(|&v| domain.boundary()[v]).collect();
    Ok(Graph::new(domain.vertex_count(), domain.edges())?.with_boundary(&boundary)?.into())
}

#[cfg(test)]
mod tests {
    use crate::domain::DomainKind;
    use crate::generate::testing::{change, make};

    #[test]
    fn edges_and_boundary_are_those_of_the_surface() {
        for (id, seed) in [("random-delaunay", 3), ("torus", 0), ("fan", 0), ("disk", 0)] {
            let before = make(id, &[], seed);
            let after = change(&before, "as-graph", &[], 0);
            assert_eq!(after.kind(), DomainKind::Graph);
            assert_eq!((before.edges(), before.boundary()), (after.edges(), after.boundary()));
        }
    }
}
