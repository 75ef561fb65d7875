//! The icosahedron, subdivided and projected to a sphere.

use super::polyhedron::icosahedron;
use super::shape::refine;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface, geometry};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "icosphere",
    name: "sphere: an icosahedron whose triangles are cut into four and projected, level by level",
    guarantees: &[
        "10·4^levels + 2 vertices on the sphere about the origin (up to rounding), 20·4^levels triangles",
        "closed, manifold, connected, genus 0, Delaunay, no degenerate face; levels are nested in their vertices",
        "all angles between 54° and 73°",
    ],
    sources: &[],
    parameters: &[
        Parameter {
            name: "levels",
            meaning: "how often every triangle is cut into four",
            default: "2",
            range: Range::Whole(0, 8),
        },
        Parameter { name: "radius", meaning: "the radius", default: "1", range: Range::Number(1e-30, 1e30) },
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let radius = settings.number("radius");
    let (mut positions, mut faces) = icosahedron();
    positions.iter_mut().for_each(|p| *p = unit(*p));
    for _ in 0..settings.whole("levels") {
        faces = refine::midpoint(&mut positions, &faces);
        positions.iter_mut().for_each(|p| *p = unit(*p));
    }
    let scaled = positions.iter().map(|p| p.map(|x| radius * x)).collect();
    Ok(Surface::triangles(scaled, &faces)?.into())
}

fn unit(p: [f64; 3]) -> [f64; 3] {
    let length = geometry::dot(&p, &p).sqrt();
    p.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{make, outward, surface_facts};

    #[test]
    fn every_level_is_a_delaunay_sphere_whose_area_tends_to_four_pi_at_order_two() {
        let mut defects = Vec::new();
        for level in 0..5 {
            let domain = make("icosphere", &[("levels", &level.to_string())], 0);
            let (all, facts) = (domain.facts(), surface_facts(&domain));
            assert_eq!((all.vertices, all.faces), (10 * 4_usize.pow(level) + 2, 20 * 4_usize.pow(level)));
            assert_eq!((facts.genus, facts.closed, facts.manifold, facts.delaunay), (Some(0), true, true, Some(true)));
            assert!(facts.min_angle_deg > 54.0 && facts.max_angle_deg < 73.0);
            assert!(outward(&domain));
            let s = domain.as_surface().unwrap();
            assert!((0..all.vertices).all(|v| (s.point(v).norm() - 1.0).abs() < 1e-15));
            defects.push(4.0 * std::f64::consts::PI - facts.area);
        }
        assert!(defects.windows(2).skip(1).all(|w| (w[0] / w[1] - 4.0).abs() < 0.2), "{defects:?}");
    }

    #[test]
    fn levels_are_nested() {
        let at = |levels| make("icosphere", &[("levels", levels)], 0).positions().unwrap().to_vec();
        let (coarse, fine) = (at("1"), at("2"));
        let gap = |p: &[f64; 3], q: &[f64; 3]| (0..3).map(|k| (p[k] - q[k]).abs()).fold(0.0, f64::max);
        assert!(coarse.iter().zip(&fine).all(|(p, q)| gap(p, q) < 1e-15));
    }
}
