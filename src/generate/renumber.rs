//! A random renumbering of the vertices.

use super::shape::{input::inherit, verge};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Graph, PointCloud, Surface, Volume};
use crate::parameter::Settings;

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "renumber",
    name: "random renumbering of the vertices of any domain",
    guarantees: &[
        "isomorphic to the input: coordinates, normals, weights and boundary follow their vertices",
        "faces and tetrahedra keep their order and the order of their corners",
    ],
    sources: &[],
    parameters: &[],
    make: Make::Modifier(change),
};

fn change(domain: &Domain, _: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    // Old vertex `v` gets the number `new[v]`.
    let new = verge::shuffled(domain.vertex_count(), stream);
    Ok(match domain {
        Domain::Surface(s) => {
            let faces = s.faces().iter().map(|f| f.iter().map(|&v| new[v]).collect()).collect();
            return inherit(s, Surface::new(moved(s.positions(), &new), faces));
        }
        Domain::Graph(g) => {
            let edges: Vec<[usize; 2]> = g.edges().iter().map(|e| e.map(|v| new[v])).collect();
            let renumbered = match g.weights() {
                Some(weights) => Graph::weighted(g.vertex_count(), &edges, weights)?,
                None => Graph::new(g.vertex_count(), &edges)?,
            };
            let boundary: Vec<usize> = (0..new.len()).filter(|&v| g.boundary()[v]).map(|v| new[v]).collect();
            renumbered.with_boundary(&boundary)?.into()
        }
        Domain::Points(p) => PointCloud::new(moved(p.positions(), &new), p.normals().map(|n| moved(n, &new)))?.into(),
        Domain::Volume(v) => {
            let tetrahedra = v.tetrahedra().iter().map(|t| t.map(|v| new[v])).collect();
            Volume::new(moved(v.positions(), &new), tetrahedra)?.into()
        }
    })
}

fn moved(values: &[[f64; 3]], new: &[usize]) -> Vec<[f64; 3]> {
    let mut result = vec![[0.0; 3]; values.len()];
    for (value, &at) in values.iter().zip(new) {
        result[at] = *value;
    }
    result
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{change, make, surface_facts};

    #[test]
    fn a_renumbered_surface_has_the_same_triangles_in_space() {
        let before = make("random-delaunay", &[], 2);
        let after = change(&before, "renumber", &[], 1);
        assert_ne!(before.digest(), after.digest());
        let corners = |d: &crate::domain::Domain| -> Vec<Vec<[f64; 3]>> {
            let s = d.as_surface().unwrap();
            s.faces().iter().map(|f| f.iter().map(|&v| s.positions()[v]).collect()).collect()
        };
        assert_eq!(corners(&before), corners(&after));
        assert_eq!(surface_facts(&before).delaunay, surface_facts(&after).delaunay);
    }

    #[test]
    fn weights_and_boundary_follow_the_vertices_of_a_graph() {
        let before = change(&make("star", &[("leaves", "5"), ("boundary", "5")], 0), "random-weights", &[], 3);
        let after = change(&before, "renumber", &[], 9);
        let crate::domain::Domain::Graph(g) = &after else { panic!("a graph") };
        let centre = (0..6).find(|&v| g.edges().iter().all(|e| e.contains(&v))).unwrap();
        assert!((0..6).all(|v| g.boundary()[v] == (v != centre)));
        let sorted = |d: &crate::domain::Domain| {
            let crate::domain::Domain::Graph(g) = d else { panic!("a graph") };
            let mut w = g.weights().unwrap().to_vec();
            w.sort_by(f64::total_cmp);
            w
        };
        assert_eq!(sorted(&before), sorted(&after));
    }
}
