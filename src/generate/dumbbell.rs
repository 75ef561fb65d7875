//! Two spheres joined by a neck.
//!
//! # Definition
//! The surface of revolution about the x-axis of the profile: an arc of the unit circle from its far pole to the height
//! `neck`, a straight line of length `length` at that height, and the mirror image of the arc. Polygonal, inscribed in this
//! surface: 8·2^levels meridians; the arc is cut at the equator, both parts and the neck into 2^(levels+1) pieces.

use super::shape::circle;
use super::shape::sheet::Sheet;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "dumbbell",
    name: "dumbbell: two unit spheres joined by a cylindrical neck",
    guarantees: &[
        "closed, manifold, connected, genus 0, no degenerate face, faces counter-clockwise seen from outside",
        "the vertices are mirror symmetric in x, exactly",
        "the shortest closed line around the neck is a regular polygon inscribed in a circle of radius neck",
    ],
    sources: &["cheeger1970"],
    parameters: &[
        Parameter { name: "levels", meaning: "level of refinement", default: "1", range: Range::Whole(0, 6) },
        Parameter { name: "neck", meaning: "radius of the neck", default: "0.25", range: Range::Number(0.001, 0.9) },
        Parameter { name: "length", meaning: "length of the neck", default: "1", range: Range::Number(0.01, 100.0) },
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let (levels, neck, length) = (settings.whole("levels"), settings.number("neck"), settings.number("length"));
    let profile = profile(levels + 1, neck, length);
    // The rings between the poles make a sheet that is periodic around the axis.
    let rings = &profile[1..profile.len() - 1];
    let sheet = Sheet { columns: 8 << levels, rows: rings.len() - 1, periodic: [true, false] };
    let on_ring = |[i, j]: [usize; 2]| {
        let ([c, s], [x, radius]) = (circle::turn(i, sheet.columns), rings[j]);
        [x, radius * c, radius * s]
    };
    let mut positions: Vec<[f64; 3]> = sheet.vertices().map(on_ring).collect();
    let mut faces = sheet.triangles(|i, j| (i + j) % 2 == 0);
    let (left, right) = (positions.len(), positions.len() + 1);
    positions.extend([profile[0], profile[profile.len() - 1]].map(|[x, _]| [x, 0.0, 0.0]));
    for i in 0..sheet.columns {
        faces.push([left, sheet.vertex(i + 1, 0), sheet.vertex(i, 0)]);
        faces.push([right, sheet.vertex(i, sheet.rows), sheet.vertex(i + 1, sheet.rows)]);
    }
    Ok(Surface::triangles(positions, &faces)?.into())
}

/// The profile from pole to pole as (x, radius), exactly symmetric in x.
fn profile(doublings: usize, neck: f64, length: f64) -> Vec<[f64; 2]> {
    let joint = [(1.0 - neck * neck).sqrt(), neck];
    let centre = -0.5 * length - joint[0];
    let mut arc = circle::arc([-1.0, 0.0], [0.0, 1.0], doublings);
    arc.extend(&circle::arc([0.0, 1.0], joint, doublings)[1..]);
    let mut left: Vec<[f64; 2]> = arc.iter().map(|[x, r]| [centre + x, *r]).collect();
    // The last point of the arc is the first of the neck.
    left.pop();
    let pieces = 1 << doublings;
    let along = |k: usize| [length * (k as f64 / pieces as f64 - 0.5), neck];
    let right = left.iter().rev().map(|[x, r]| [-x, *r]);
    left.iter().copied().chain((0..=pieces).map(along)).chain(right).collect()
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{make, outward_volume, surface_facts};

    #[test]
    fn it_is_a_closed_sphere_whose_area_and_volume_tend_to_the_closed_forms() {
        let pi = std::f64::consts::PI;
        for (neck, length) in [(0.05_f64, 2.0), (0.25, 1.0), (0.9, 0.01)] {
            let cut = (1.0 - neck * neck).sqrt();
            // A sphere without the cap above the height `cut` (Archimedes), twice, and the neck.
            let area = 2.0 * (2.0 * pi * (1.0 + cut)) + 2.0 * pi * neck * length;
            let ball = 4.0 / 3.0 * pi - pi / 3.0 * (1.0 - cut).powi(2) * (2.0 + cut);
            let volume = 2.0 * ball + pi * neck * neck * length;
            let mut errors = Vec::new();
            for level in 0..4 {
                let given = [("levels", level.to_string()), ("neck", neck.to_string()), ("length", length.to_string())];
                let given: Vec<(&str, &str)> = given.iter().map(|(k, v)| (*k, v.as_str())).collect();
                let domain = make("dumbbell", &given, 0);
                let facts = surface_facts(&domain);
                assert_eq!((facts.genus, facts.closed, facts.manifold), (Some(0), true, true));
                assert_eq!((facts.degenerate_faces, facts.flipped_faces, domain.facts().components), (0, 0, 1));
                errors.push([area - facts.area, volume - outward_volume(&domain)]);
            }
            let order_two = |k: usize| errors.windows(2).skip(1).all(|w| (w[0][k] / w[1][k] - 4.0).abs() < 0.3);
            assert!(order_two(0) && order_two(1), "{errors:?}");
        }
    }

    #[test]
    fn it_is_exactly_symmetric_in_x() {
        let domain = make("dumbbell", &[], 0);
        let at = domain.positions().unwrap();
        assert!(at.iter().all(|p| at.contains(&[-p[0], p[1], p[2]])));
    }
}
