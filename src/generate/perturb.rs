//! Moves the vertices of a surface at random.

use super::shape::displace::{in_ball, unfolded};
use super::shape::input::{inherit, surface};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "perturb",
    name: "randomly displaced vertices; a planar mesh stays in its plane and unfolded",
    guarantees: &[
        "the same connectivity; boundary vertices stay unless boundary = free",
        "no vertex moves further than amount times its shortest edge",
        "a planar mesh stays planar: every triangle keeps its orientation (exact), displacements being halved until it does",
    ],
    sources: &[],
    parameters: &[
        Parameter {
            name: "amount",
            meaning: "largest displacement, as a fraction of the vertex's shortest edge, uniform in the ball (plane: disc)",
            default: "0.2",
            range: Range::Number(0.0, 1.0),
        },
        Parameter {
            name: "boundary",
            meaning: "whether boundary vertices move",
            default: "fixed",
            range: Range::Choice(&["fixed", "free"]),
        },
    ],
    make: Make::Modifier(change),
};

fn change(domain: &Domain, settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let surface = surface("perturb", domain)?;
    let (amount, free) = (settings.number("amount"), settings.get("boundary") == "free");
    let reach: Vec<f64> = shortest_edges(surface)
        .iter()
        .zip(domain.boundary())
        .map(|(length, on_boundary)| if *on_boundary && !free { 0.0 } else { amount * length })
        .collect();
    let mut positions = surface.positions().to_vec();
    if let Some([x, y]) = surface.plane() {
        let base: Vec<[f64; 2]> = positions.iter().map(|p| [p[x], p[y]]).collect();
        let shift = reach.iter().map(|r| in_ball::<2>(stream).map(|t| r * t)).collect();
        for (p, [u, v]) in positions.iter_mut().zip(unfolded(&base, shift, &fans(surface))) {
            (p[x], p[y]) = (u, v);
        }
    } else {
        for (p, r) in positions.iter_mut().zip(&reach) {
            let ball = in_ball::<3>(stream);
            *p = std::array::from_fn(|k| p[k] + r * ball[k]);
        }
    }
    inherit(surface, Surface::new(positions, surface.faces().to_vec()))
}

/// For each vertex the length of its shortest edge; 0 for an isolated vertex.
fn shortest_edges(surface: &Surface) -> Vec<f64> {
    let mut shortest = vec![f64::INFINITY; surface.positions().len()];
    for &[a, b] in surface.topology().edges() {
        let length = (surface.point(a) - surface.point(b)).norm();
        shortest[a] = length.min(shortest[a]);
        shortest[b] = length.min(shortest[b]);
    }
    shortest.into_iter().map(|length| if length.is_finite() { length } else { 0.0 }).collect()
}

/// The triangles whose orientations say whether the surface is unfolded ([`Surface::plane`]).
fn fans(surface: &Surface) -> Vec<[usize; 3]> {
    surface.faces().iter().flat_map(|f| f[1..].windows(2).map(|w| [f[0], w[0], w[1]])).collect()
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{change, disc, make, surface_facts};

    #[test]
    fn a_planar_mesh_stays_unfolded_and_its_boundary_fixed() {
        for seed in 0..25 {
            let before = make("random-delaunay", &[("n", "40")], seed);
            let after = change(&before, "perturb", &[("amount", "1")], seed);
            let (f, g) = (surface_facts(&before), disc(&after));
            assert!((f.area - g.area).abs() < 200.0 * f64::EPSILON);
            assert_ne!(before.digest(), after.digest());
            assert_eq!(before.edges(), after.edges());
        }
    }

    #[test]
    fn in_space_no_vertex_moves_further_than_asked() {
        let before = make("icosphere", &[], 0);
        let after = change(&before, "perturb", &[("amount", "0.1")], 4);
        let surface = before.as_surface().unwrap();
        let reach = super::shortest_edges(surface);
        for (v, r) in reach.iter().enumerate() {
            let moved = (surface.point(v) - after.as_surface().unwrap().point(v)).norm();
            assert!(moved > 0.0 && moved <= 0.1001 * r);
        }
    }
}
