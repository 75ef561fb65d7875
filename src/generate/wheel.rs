//! A hub of any valence: a regular polygon joined to its centre, flat or raised to a cone.
//!
//! # Definition
//! Vertex 0 at (0, 0, height), vertices 1 to n on the unit circle at z = 0, n triangles between. With height 0 it is planar; the
//! angles at the hub are then 2π/n, those at the rim π/2 − π/n.

use super::shape::circle;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "wheel",
    name: "wheel: a regular polygon joined to its centre, which may be raised",
    guarantees: &[
        "vertex 0 is the hub with valence n, vertices 1 to n the rim counter-clockwise; n triangles",
        "manifold, connected, genus 0, one boundary loop, no degenerate face; planar if the height is 0",
    ],
    sources: &[],
    parameters: &[
        Parameter { name: "n", meaning: "valence of the hub", default: "12", range: Range::Whole(3, 100_000) },
        Parameter { name: "height", meaning: "height of the hub", default: "0", range: Range::Number(-1e6, 1e6) },
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let (n, height) = (settings.whole("n"), settings.number("height"));
    let rim = (0..n).map(|k| {
        let [x, y] = circle::turn(k, n);
        [x, y, 0.0]
    });
    let points = std::iter::once([0.0, 0.0, height]).chain(rim).collect();
    let faces: Vec<[usize; 3]> = (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % n]).collect();
    Ok(Surface::triangles(points, &faces)?.into())
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{disc, make, surface_facts, valences};

    #[test]
    fn the_hub_has_the_valence_asked_for_and_the_wheel_is_flat_without_height() {
        for n in [3, 4, 17, 500] {
            let flat = make("wheel", &[("n", &n.to_string())], 0);
            let facts = disc(&flat);
            assert_eq!((valences(&flat)[0], facts.boundary_edges, flat.vertex_count()), (n, n, n + 1));
            let cone = make("wheel", &[("n", &n.to_string()), ("height", "1")], 0);
            assert!(!surface_facts(&cone).planar);
            // n isosceles triangles over 2 sin(π/n), with sides √2.
            let half = std::f64::consts::PI / n as f64;
            let area = n as f64 * half.sin() * (2.0 - half.sin().powi(2)).sqrt();
            assert!((surface_facts(&cone).area / area - 1.0).abs() < 1e-12);
        }
    }
}
