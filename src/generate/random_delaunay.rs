//! The Delaunay triangulation of random points in the unit square.

use super::shape::scatter;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The number of random points.
pub(super) const POINTS: Parameter =
    Parameter { name: "n", meaning: "number of random points", default: "60", range: Range::Whole(3, 1_000_000) };

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "random-delaunay",
    name: "Delaunay triangulation of points uniformly in the unit square",
    guarantees: &[
        "n vertices, every one in the half-open unit square",
        "planar, Delaunay (exact), manifold, connected, genus 0, one boundary loop, no degenerate face",
        "the boundary is the convex hull of the points",
    ],
    sources: &["delaunay1934"],
    parameters: &[POINTS],
    make: Make::Source(make),
};

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let points = square(settings.whole("n"), stream);
    let faces = scatter::delaunay("random-delaunay", &points)?;
    Ok(Surface::planar(&points, &faces)?.into())
}

/// Points uniformly in the unit square.
pub(super) fn square(n: usize, stream: &mut Stream) -> Vec<[f64; 2]> {
    (0..n).map(|_| [stream.unit(), stream.unit()]).collect()
}

#[cfg(test)]
mod tests {
    use crate::domain::geometry::orient2d;
    use crate::generate::testing::{disc, make};

    #[test]
    fn random_points_make_a_delaunay_disc_with_convex_boundary_whatever_the_seed() {
        for seed in 0..60 {
            let n = 3 + (seed as usize * 7) % 90;
            let domain = make("random-delaunay", &[("n", &n.to_string())], seed);
            let facts = disc(&domain);
            assert_eq!((domain.vertex_count(), facts.delaunay, domain.facts().isolated_vertices), (n, Some(true), 0));
            let surface = domain.as_surface().unwrap();
            let at = |v: usize| [surface.positions()[v][0], surface.positions()[v][1]];
            for e in (0..domain.edges().len()).filter(|&e| surface.topology().is_boundary_edge(e)) {
                let side = surface.topology().sides(e)[0];
                let corners = &surface.faces()[side.face()];
                let (a, b) = (corners[side.corner()], corners[(side.corner() + 1) % 3]);
                assert!((0..n).all(|v| v == a || v == b || orient2d(at(a), at(b), at(v)).is_gt()));
            }
        }
    }
}
