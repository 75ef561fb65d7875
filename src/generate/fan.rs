//! A non-manifold fan: sheets that meet in one edge, as the pages of a book in its spine.

use super::shape::circle;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "fan",
    name: "non-manifold fan: k triangles, or k half-discs, around one edge",
    guarantees: &[
        "connected; edge 0–1, of length 2 on the z-axis, has k faces: for k > 2 the only non-manifold edge",
        "no non-manifold vertex apart from that edge, no degenerate face, every sheet congruent up to rounding",
        "half-disks: k interior vertices, one for each sheet",
    ],
    sources: &[],
    parameters: &[
        Parameter { name: "k", meaning: "number of sheets", default: "3", range: Range::Whole(1, 10_000) },
        Parameter {
            name: "kind",
            meaning: "sheets of one triangle, or triangulated half-discs with an interior vertex",
            default: "triangles",
            range: Range::Choice(&["triangles", "half-disks"]),
        },
        Parameter { name: "sides", meaning: "sides of a half-disc's arc", default: "4", range: Range::Whole(2, 100) },
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let (k, sides) = (settings.whole("k"), settings.whole("sides"));
    let half_disks = settings.get("kind") == "half-disks";
    let mut positions = vec![[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
    let mut faces = Vec::new();
    for sheet in 0..k {
        let [c, s] = circle::turn(sheet, k);
        // A point of the sheet at a distance from the spine and a height.
        let at = |[distance, z]: [f64; 2]| [distance * c, distance * s, z];
        let first = positions.len();
        if !half_disks {
            positions.push(at([1.0, 0.0]));
            faces.push([0, first, 1]);
            continue;
        }
        positions.push(at([0.5, 0.0]));
        // From pole to pole: the angle grows from −90° to 90°.
        let arc = (1..sides).map(|t| circle::turn(t, 2 * sides)).map(|[down, out]| at([out, -down]));
        positions.extend(arc);
        let rim: Vec<usize> = std::iter::once(0).chain(first + 1..first + sides).chain([1]).collect();
        faces.extend(rim.windows(2).map(|w| [first, w[0], w[1]]));
        faces.push([first, 1, 0]);
    }
    Ok(Surface::triangles(positions, &faces)?.into())
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{make, surface_facts};

    #[test]
    fn only_the_spine_is_not_manifold() {
        for k in 1..12_usize {
            for (kind, faces, inside) in [("triangles", 1, 0), ("half-disks", 5, 1)] {
                let domain = make("fan", &[("k", &k.to_string()), ("kind", kind)], 0);
                let (all, facts) = (domain.facts(), surface_facts(&domain));
                let surface = domain.as_surface().unwrap();
                let spine = surface.topology().edge_between(0, 1).unwrap();
                assert_eq!(surface.topology().sides(spine).len(), k);
                assert_eq!((all.faces, all.components), (k * faces, 1));
                assert_eq!((facts.non_manifold_edges, facts.non_manifold_vertices), (usize::from(k > 2), 0));
                assert_eq!((facts.degenerate_faces, facts.duplicate_faces, facts.manifold), (0, 0, k <= 2));
                assert_eq!(domain.interior().len(), k * inside);
            }
        }
    }

    #[test]
    fn a_half_disc_has_the_area_of_half_a_regular_polygon() {
        let domain = make("fan", &[("k", "3"), ("kind", "half-disks"), ("sides", "6")], 0);
        let half = 0.5 * 6.0 * (std::f64::consts::TAU / 12.0).sin();
        assert!((surface_facts(&domain).area - 3.0 * half).abs() < 1e-13);
    }
}
