//! The Delaunay triangulation of random points in a disc with evenly spaced boundary points.

use super::random_delaunay::POINTS;
use super::shape::{circle, scatter};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface, geometry};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "random-delaunay-disk",
    name: "Delaunay triangulation of points uniformly in a regular polygon on the unit circle, with its corners",
    guarantees: &[
        "the first m vertices are the corners of a regular polygon on the unit circle; the n others lie strictly inside it",
        "the boundary is the polygon: m boundary vertices and edges, area (m/2) sin(2π/m)",
        "planar, Delaunay (exact), manifold, connected, genus 0, one boundary loop, no degenerate face",
    ],
    sources: &["delaunay1934"],
    parameters: &[
        POINTS,
        Parameter {
            name: "m",
            meaning: "evenly spaced boundary points",
            default: "24",
            range: Range::Whole(3, 100_000),
        },
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let (n, m) = (settings.whole("n"), settings.whole("m"));
    let mut points: Vec<[f64; 2]> = (0..m).map(|k| circle::turn(k, m)).collect();
    // The circle inscribed in the polygon has the radius cos(π/m); a little less, so that rounding cannot matter.
    let certain = circle::turn(1, 2 * m)[0] * (1.0 - 8.0 * f64::EPSILON);
    while points.len() < n + m {
        let p = [stream.between(-1.0, 1.0), stream.between(-1.0, 1.0)];
        if geometry::dot(&p, &p) < certain * certain || inside(&points[..m], p) {
            points.push(p);
        }
    }
    let faces = scatter::delaunay("random-delaunay-disk", &points)?;
    Ok(Surface::planar(&points, &faces)?.into())
}

/// Whether a point lies strictly inside a convex counter-clockwise polygon. Exact; O(m).
fn inside(polygon: &[[f64; 2]], p: [f64; 2]) -> bool {
    // Outside the circle it cannot be inside; this spares the predicates for most points of the square.
    geometry::dot(&p, &p) <= 1.0
        && (0..polygon.len()).all(|k| geometry::orient2d(polygon[k], polygon[(k + 1) % polygon.len()], p).is_gt())
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{disc, make};

    #[test]
    fn the_boundary_is_the_regular_polygon_whatever_the_seed() {
        for seed in 0..40 {
            let (n, m) = (3 + seed as usize * 2, 3 + seed as usize % 11);
            let domain = make("random-delaunay-disk", &[("n", &n.to_string()), ("m", &m.to_string())], seed);
            let facts = disc(&domain);
            assert_eq!((domain.vertex_count(), facts.boundary_edges, facts.delaunay), (n + m, m, Some(true)));
            assert!((0..n + m).all(|v| domain.boundary()[v] == (v < m)));
            let area = m as f64 / 2.0 * (std::f64::consts::TAU / m as f64).sin();
            assert!((facts.area - area).abs() < 1e-12);
        }
    }
}
