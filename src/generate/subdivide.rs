//! Midpoint subdivision of a triangle surface.

use super::shape::input::{admit, inherit, surface, triangles};
use super::shape::refine;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "subdivide",
    name: "midpoint subdivision: every triangle into four",
    guarantees: &[
        "4^levels times the faces; the old vertices come first and do not move",
        "genus, components, boundary loops and manifoldness are those of the input, and so is the shape up to rounding",
    ],
    sources: &[],
    parameters: &[Parameter { name: "levels", meaning: "how often", default: "1", range: Range::Whole(0, 8) }],
    make: Make::Modifier(change),
};

fn change(domain: &Domain, settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let surface = surface("subdivide", domain)?;
    let mut faces = triangles("subdivide", surface)?;
    let mut positions = surface.positions().to_vec();
    let levels = settings.whole("levels");
    admit("subdivide", "triangles", faces.len().saturating_mul(1 << (2 * levels)))?;
    for _ in 0..levels {
        faces = refine::midpoint(&mut positions, &faces);
    }
    inherit(surface, Surface::triangles(positions, &faces))
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{change, make, surface_facts};

    #[test]
    fn subdivision_keeps_topology_area_and_angles() {
        for (id, given) in
            [("torus", vec![]), ("genus", vec![]), ("grid", vec![]), ("fan", vec![("kind", "half-disks")])]
        {
            let before = make(id, &given, 0);
            let after = change(&before, "subdivide", &[("levels", "2")], 0);
            let (f, g) = (surface_facts(&before), surface_facts(&after));
            let (old, new) = (before.vertex_count(), after.vertex_count());
            // One level: V + E vertices, 2E + 3F edges, 4F faces; so V − E + F is kept.
            let (e, faces) = (before.edges().len(), before.facts().faces);
            assert_eq!(new, old + e + (2 * e + 3 * faces));
            assert_eq!(after.facts().faces, 16 * faces);
            assert_eq!(after.positions().unwrap()[..old], *before.positions().unwrap());
            assert_eq!(
                (f.genus, f.boundary_loops, f.manifold, f.planar, 4 * f.boundary_edges, g.flipped_faces),
                (g.genus, g.boundary_loops, g.manifold, g.planar, g.boundary_edges, 0)
            );
            assert!((f.area - g.area).abs() < 1e-12 * f.area);
            assert!((f.min_angle_deg - g.min_angle_deg).abs() < 1e-9);
        }
    }
}
