//! Tetrahedron, cube, octahedron and icosahedron.

use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface, geometry};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "polyhedron",
    name: "regular tetrahedron, cube (its faces cut by the diagonals of a tetrahedron), octahedron or icosahedron",
    guarantees: &[
        "closed, convex, manifold, connected, genus 0, faces counter-clockwise seen from outside",
        "coordinates ±1 and 0 (icosahedron: also ± the golden ratio); edges 2√2, 2 (diagonals 2√2), √2, 2 long",
        "Delaunay; the six diagonals of the cube are cocircular",
    ],
    sources: &[],
    parameters: &[Parameter {
        name: "shape",
        meaning: "which polyhedron",
        default: "icosahedron",
        range: Range::Choice(&["tetrahedron", "cube", "octahedron", "icosahedron"]),
    }],
    make: Make::Source(make),
};

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let (positions, faces) = match settings.get("shape") {
        "tetrahedron" => hull(even_corners()),
        "cube" => cube(),
        "octahedron" => hull((0..6).map(|k| std::array::from_fn(|c| if c == k / 2 { sign(k) } else { 0.0 })).collect()),
        _ => icosahedron(),
    };
    Ok(Surface::triangles(positions, &faces)?.into())
}

/// The icosahedron with corners (0, ±1, ±φ) and their cyclic shifts, φ the golden ratio.
pub(super) fn icosahedron() -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    let golden = 0.5 * (1.0 + 5_f64.sqrt());
    let corner = |k: usize| {
        let p = [0.0, sign(k), sign(k / 2) * golden];
        std::array::from_fn(|c| p[(c + k / 4) % 3])
    };
    hull((0..12).map(corner).collect())
}

/// The corners of the cube with an even number of minus signs.
fn even_corners() -> Vec<[f64; 3]> {
    vec![[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]]
}

fn cube() -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    // Over each edge of the tetrahedron of even corners lie two triangles, with the two odd corners at distance 2 of both.
    let (even, faces) = hull(even_corners());
    let odd = even.iter().map(|p| p.map(|x| -x));
    let positions = even.iter().copied().chain(odd).collect();
    // The corner opposite `v` is `v + 4`; that of a face `abc` of the tetrahedron is the one opposite its missing corner.
    let cap = |f: &[usize; 3]| {
        let apex = 4 + (6 - f[0] - f[1] - f[2]);
        [[f[0], f[1], apex], [f[1], f[2], apex], [f[2], f[0], apex]]
    };
    (positions, faces.iter().flat_map(cap).collect())
}

/// The faces of the convex hull of a few points no four of which are coplanar on the hull: triples with all other points
/// strictly on one side, turned so that this is the inner side.
fn hull(points: Vec<[f64; 3]>) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    let mut faces = Vec::new();
    for a in 0..points.len() {
        for b in a + 1..points.len() {
            for c in b + 1..points.len() {
                let side = |d: usize| geometry::orient3d(points[a], points[b], points[c], points[d]);
                let mut others = (0..points.len()).filter(|d| ![a, b, c].contains(d)).map(side);
                if others.clone().all(|s| s.is_gt()) {
                    faces.push([a, b, c]);
                } else if others.all(|s| s.is_lt()) {
                    faces.push([a, c, b]);
                }
            }
        }
    }
    (points, faces)
}

fn sign(k: usize) -> f64 {
    if k.is_multiple_of(2) { 1.0 } else { -1.0 }
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{make, outward, surface_facts};

    #[test]
    fn counts_edges_and_areas_are_the_closed_forms() {
        let (r2, r3) = (2_f64.sqrt(), 3_f64.sqrt());
        for (shape, counts, lengths, area) in [
            ("tetrahedron", (4, 6, 4), vec![2.0 * r2], 8.0 * r3),
            ("cube", (8, 18, 12), vec![2.0, 2.0 * r2], 24.0),
            ("octahedron", (6, 12, 8), vec![r2], 4.0 * r3),
            ("icosahedron", (12, 30, 20), vec![2.0], 20.0 * r3),
        ] {
            let domain = make("polyhedron", &[("shape", shape)], 0);
            let (all, facts) = (domain.facts(), surface_facts(&domain));
            assert_eq!((all.vertices, all.edges, all.faces, all.components), (counts.0, counts.1, counts.2, 1));
            assert_eq!((facts.genus, facts.closed, facts.manifold, facts.flipped_faces), (Some(0), true, true, 0));
            assert!((facts.area - area).abs() < 1e-13 * area);
            let s = domain.as_surface().unwrap();
            for &[a, b] in domain.edges() {
                let length = (s.point(a) - s.point(b)).norm();
                assert!(lengths.iter().any(|l| (l - length).abs() < 1e-14), "{shape}: {length}");
            }
            assert_eq!(facts.cocircular_edges, Some(if shape == "cube" { 6 } else { 0 }));
            assert_eq!(facts.delaunay, Some(true));
            assert!(outward(&domain), "{shape}");
        }
    }
}
