//! Refinement sequence of the flat rectangular torus, folded isometrically into space.
//!
//! # Definition
//! No smooth flat torus lies in space with straight faces, but the folded map
//! `(u, v) ↦ (γ(u), |v|)`, u modulo width, v in (−height/2, height/2] modulo height, γ the boundary of a square of
//! perimeter `width` by arc length, keeps the length of every curve. Its creases are grid lines: every triangle lies in one
//! flat piece, so that the mesh is, triangle by triangle, the flat torus `ℝ²/(width ℤ × height ℤ)` cut into
//! n × n rectangles with a diagonal each, n = 4·2^levels. The cone angle at each vertex is 2π.
//!
//! # Limitations
//! In space it is a square tube with a double wall: apart from the two rims every position is taken by two vertices, v and
//! −v. It is flat for whatever sees lengths and connectivity only, as every intrinsic operator does. A file format that
//! welds equal positions tears it; an operator or a check that looks at positions as such (a point cloud, normals) sees
//! the double wall.
//!
//! Spectrum of the smooth torus: `4π² (j²/width² + k²/height²)`, j and k whole.

use super::shape::sheet::{DIAGONALS, Sheet};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "flat-torus",
    name: "flat rectangular torus, folded isometrically into space as a square tube with a double wall",
    guarantees: &[
        "16·4^levels vertices, 32·4^levels triangles, closed, manifold, connected, genus 1, nested in their vertices",
        "every triangle is half a rectangle of width/n × height/n, so that the cone angle is 2π everywhere; area width·height",
        "Delaunay with cocircular diagonals for sides that are powers of two (exact coordinates)",
        "two vertices share each position that is not on a rim (v = 0 or height/2)",
    ],
    sources: &[],
    parameters: &[
        Parameter {
            name: "levels",
            meaning: "level of refinement: n = 4·2^levels cells along each side",
            default: "1",
            range: Range::Whole(0, 8),
        },
        Parameter {
            name: "width",
            meaning: "length of the closed lines v = constant",
            default: "1",
            range: Range::Number(1e-6, 1e6),
        },
        Parameter {
            name: "height",
            meaning: "length of the closed lines u = constant",
            default: "1",
            range: Range::Number(1e-6, 1e6),
        },
        DIAGONALS,
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let n = 4 << settings.whole("levels");
    let (across, up) = (settings.number("width") / n as f64, settings.number("height") / n as f64);
    let sheet = Sheet { columns: n, rows: n, periodic: [true, true] };
    let at = |[i, j]: [usize; 2]| {
        let [x, y] = around_square(i, n / 4);
        [across * x as f64, across * y as f64, up * j.min(n - j) as f64]
    };
    let faces = sheet.cut(settings.get("diagonals"), stream);
    Ok(Surface::triangles(sheet.vertices().map(at).collect(), &faces)?.into())
}

/// The `i`-th point on the boundary of a square of lattice points with the given side, counter-clockwise from a corner.
fn around_square(i: usize, side: usize) -> [usize; 2] {
    let along = i % side;
    match i / side {
        0 => [along, 0],
        1 => [side, along],
        2 => [side - along, side],
        _ => [0, side - along],
    }
}

#[cfg(test)]
mod tests {
    use crate::domain::geometry;
    use crate::generate::testing::{make, surface_facts};

    #[test]
    fn every_triangle_has_the_sides_of_a_flat_grid_and_every_cone_angle_is_a_full_turn() {
        for level in 0..3 {
            for diagonals in ["right", "alternating", "random"] {
                let given =
                    [("levels", &*level.to_string().leak()), ("width", "8"), ("height", "4"), ("diagonals", diagonals)];
                let domain = make("flat-torus", &given, 7);
                let (all, facts) = (domain.facts(), surface_facts(&domain));
                let n = 4 * 2_usize.pow(level);
                assert_eq!((all.vertices, all.edges, all.faces), (n * n, 3 * n * n, 2 * n * n));
                assert_eq!((facts.genus, facts.closed, facts.manifold, facts.flipped_faces), (Some(1), true, true, 0));
                assert_eq!((facts.area, facts.delaunay, facts.cocircular_edges), (32.0, Some(true), Some(n * n)));
                let s = domain.as_surface().unwrap();
                let (a, b) = (8.0 / n as f64, 4.0 / n as f64);
                let mut cone = vec![0.0; all.vertices];
                for f in s.faces() {
                    let corner = |k: usize| s.point(f[k % 3]);
                    let mut squares: Vec<f64> = (0..3).map(|k| (corner(k) - corner(k + 1)).norm_squared()).collect();
                    squares.sort_by(f64::total_cmp);
                    assert_eq!(squares, [b * b, a * a, a * a + b * b]);
                    (0..3).for_each(|k| cone[f[k]] += geometry::angle(corner(k), corner(k + 1), corner(k + 2)));
                }
                assert!(cone.iter().all(|angle| (angle - std::f64::consts::TAU).abs() < 1e-13));
            }
        }
    }

    #[test]
    fn two_vertices_share_each_position_off_the_rims() {
        let domain = make("flat-torus", &[], 0);
        let at = domain.positions().unwrap();
        for p in at {
            let rim = p[2] == 0.0 || p[2] == 0.5;
            assert_eq!(at.iter().filter(|q| *q == p).count(), if rim { 1 } else { 2 });
        }
    }
}
