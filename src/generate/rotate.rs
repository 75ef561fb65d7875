//! A random rotation about the origin.

use super::shape::displace::in_ball;
use super::shape::place;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, geometry};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "rotate",
    name: "random rotation about the origin, uniformly distributed",
    guarantees: &[
        "the same connectivity; lengths and angles up to rounding, orientation kept",
        "axis = any: a planar mesh no longer lies exactly in a coordinate plane, so that it counts as a surface in space",
        "axis = z: z is unchanged, a mesh in the plane z = 0 stays there; cocircular edges are so only up to rounding",
    ],
    sources: &["shoemake1992"],
    parameters: &[Parameter {
        name: "axis",
        meaning: "any axis, or the z-axis",
        default: "any",
        range: Range::Choice(&["any", "z"]),
    }],
    make: Make::Modifier(change),
};

fn change(domain: &Domain, settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let matrix = if settings.get("axis") == "z" { about_z(stream) } else { rotation(stream) };
    let turn = |p: [f64; 3]| matrix.each_ref().map(|row| geometry::dot(row, &p));
    let turned = place::positions("rotate", domain, turn, turn)?;
    Ok(match (turned, domain) {
        (Domain::Surface(made), Domain::Surface(from)) if from.plane().is_some() && made.plane().is_none() => made
            .with_notice(
                "a planar mesh was rotated out of its coordinate plane; it counts as a surface in space".into(),
            )
            .into(),
        (made, _) => made,
    })
}

/// The matrix of a unit quaternion `(w, x, y, z)/√(w² + x² + y² + z²)` drawn from the ball, so that its direction and the
/// rotation are uniformly distributed.
fn rotation(stream: &mut Stream) -> [[f64; 3]; 3] {
    let (q, square) = away_from_zero::<4>(stream);
    let [w, x, y, z] = q;
    let s = 2.0 / square;
    [
        [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
        [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
        [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
    ]
}

fn about_z(stream: &mut Stream) -> [[f64; 3]; 3] {
    let (p, square) = away_from_zero::<2>(stream);
    let [c, s] = p.map(|x| x / square.sqrt());
    [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]
}

/// A point of the ball whose square does not lose digits to underflow, and its square.
fn away_from_zero<const D: usize>(stream: &mut Stream) -> ([f64; D], f64) {
    loop {
        let p = in_ball::<D>(stream);
        let square = geometry::dot(&p, &p);
        if square > 1e-6 {
            return (p, square);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::testing::{change, make, surface_facts};

    #[test]
    fn the_matrix_is_orthogonal_with_determinant_one() {
        for seed in 0..50 {
            let m = rotation(&mut Stream::new(seed, "test"));
            for i in 0..3 {
                for j in 0..3 {
                    let expected = f64::from(u8::from(i == j));
                    assert!((geometry::dot(&m[i], &m[j]) - expected).abs() < 1e-14);
                }
            }
            assert!((geometry::dot(&m[2], &geometry::cross3(&m[0], &m[1])) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn area_is_kept_and_a_plane_is_left_only_about_any_axis() {
        let before = make("random-delaunay", &[], 2);
        let (f, space) = (surface_facts(&before), change(&before, "rotate", &[], 1));
        let flat = change(&before, "rotate", &[("axis", "z")], 1);
        assert!((surface_facts(&space).area - f.area).abs() < 1e-13);
        assert!((surface_facts(&flat).area - f.area).abs() < 1e-13);
        assert_eq!((surface_facts(&space).planar, surface_facts(&flat).planar), (false, true));
        assert!(space.notices()[0].contains("surface in space") && flat.notices().is_empty());
    }
}
