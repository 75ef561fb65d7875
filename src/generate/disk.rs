//! Refinement sequence of the unit disc: concentric rings.
//!
//! # Definition
//! n = 2^levels rings about a centre; ring k has 6k evenly spaced points on the circle of radius k/n. In each of the six
//! sectors the rings k − 1 and k are joined by 2k − 1 triangles, as in a hexagon of the triangular lattice.

use super::shape::circle;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "disk",
    name: "unit disc in concentric rings, 2^levels of them",
    guarantees: &[
        "1 + 3n(n+1) vertices and 6n² triangles for n = 2^levels; vertex 0 is the centre, rings follow from inside",
        "planar, manifold, connected, genus 0, one boundary loop: 6n points on the unit circle, area 3n sin(π/3n)",
        "Delaunay, all angles between 43° and 90°",
    ],
    sources: &[],
    parameters: &[Parameter {
        name: "levels",
        meaning: "level of refinement",
        default: "3",
        range: Range::Whole(0, 9),
    }],
    make: Make::Source(make),
};

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let n = 1 << settings.whole("levels");
    let mut points = vec![[0.0, 0.0]];
    for ring in 1..=n {
        let radius = ring as f64 / n as f64;
        points.extend((0..6 * ring).map(|k| circle::turn(k, 6 * ring).map(|x| radius * x)));
    }
    let faces: Vec<[usize; 3]> = (1..=n).flat_map(between).collect();
    Ok(Surface::planar(&points, &faces)?.into())
}

/// The triangles between a ring and the next inner one, counter-clockwise.
fn between(ring: usize) -> impl Iterator<Item = [usize; 3]> {
    let vertex = |ring: usize, k: usize| if ring == 0 { 0 } else { 1 + 3 * ring * (ring - 1) + k % (6 * ring) };
    (0..6).flat_map(move |sector| {
        (0..ring).flat_map(move |t| {
            let outer = |t: usize| vertex(ring, sector * ring + t);
            let inner = |t: usize| vertex(ring - 1, sector * (ring - 1) + t);
            let gap = [inner(t), outer(t + 1), inner(t + 1)];
            std::iter::once([inner(t), outer(t), outer(t + 1)]).chain((t + 1 < ring).then_some(gap))
        })
    })
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{disc, make};

    #[test]
    fn every_level_is_a_well_shaped_disc_on_the_unit_circle() {
        for level in 0..7 {
            let n = 2_usize.pow(level);
            let domain = make("disk", &[("levels", &level.to_string())], 0);
            let (all, facts) = (domain.facts(), disc(&domain));
            assert_eq!((all.vertices, all.faces, facts.boundary_edges), (1 + 3 * n * (n + 1), 6 * n * n, 6 * n));
            let sides = 6.0 * n as f64;
            assert!((facts.area - sides / 2.0 * (std::f64::consts::TAU / sides).sin()).abs() < 1e-12);
            assert!(facts.min_angle_deg > 43.0 && facts.max_angle_deg < 90.0, "{level}: {facts:?}");
            assert_eq!(facts.delaunay, Some(true));
            for (v, p) in domain.positions().unwrap().iter().enumerate() {
                let on_circle = (p[0].hypot(p[1]) - 1.0).abs() < 1e-15;
                assert_eq!(on_circle, domain.boundary()[v]);
            }
        }
    }
}
