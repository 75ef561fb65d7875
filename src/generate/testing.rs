//! Short ways to say "make this" in tests.

use std::collections::BTreeMap;

use super::find;
use crate::domain::{Domain, SurfaceFacts};

pub fn given(settings: &[(&str, &str)]) -> BTreeMap<String, String> {
    settings.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect()
}

pub fn make(id: &str, settings: &[(&str, &str)], seed: u64) -> Domain {
    find(id).unwrap().run(None, &given(settings), seed).unwrap_or_else(|e| panic!("{id} {settings:?} {seed}: {e}"))
}

pub fn change(domain: &Domain, id: &str, settings: &[(&str, &str)], seed: u64) -> Domain {
    let made = find(id).unwrap().run(Some(domain), &given(settings), seed);
    made.unwrap_or_else(|e| panic!("{id} {settings:?} {seed}: {e}"))
}

pub fn surface_facts(domain: &Domain) -> SurfaceFacts {
    domain.facts().surface.expect("a surface")
}

/// The facts of a domain, having checked that it is a proper triangulated topological disc in the plane.
pub fn disc(domain: &Domain) -> SurfaceFacts {
    let (all, s) = (domain.facts(), surface_facts(domain));
    assert_eq!((all.components, all.isolated_vertices, s.euler_characteristic, s.genus), (1, 0, 1, Some(0)));
    assert_eq!((s.planar, s.manifold, s.orientable, s.closed, s.boundary_loops), (true, true, true, false, 1));
    assert_eq!((s.degenerate_faces, s.duplicate_faces, s.flipped_faces, s.ill_oriented_edges), (0, 0, 0, 0));
    assert_eq!(s.corners.keys().copied().collect::<Vec<_>>(), [3]);
    s
}

/// Six times the signed volume, divided by six: positive where the faces are counter-clockwise seen from outside.
pub fn outward_volume(domain: &Domain) -> f64 {
    let s = domain.as_surface().unwrap();
    let six: f64 = s.faces().iter().map(|f| s.point(f[0]).dot(&s.point(f[1]).cross(&s.point(f[2])))).sum();
    six / 6.0
}

/// Whether the origin lies behind every face.
pub fn outward(domain: &Domain) -> bool {
    let s = domain.as_surface().unwrap();
    s.faces().iter().all(|f| s.point(f[0]).dot(&s.point(f[1]).cross(&s.point(f[2]))) > 0.0)
}

pub fn valences(domain: &Domain) -> Vec<usize> {
    let mut valence = vec![0; domain.vertex_count()];
    domain.edges().iter().flatten().for_each(|&v| valence[v] += 1);
    valence
}
