//! Delaunay triangulations of point sets in the plane.

use spade::{DelaunayTriangulation, Point2, Triangulation};

use super::input::impossible;
use crate::generate::GenerateError;

/// The Delaunay triangles of points in the plane, counter-clockwise, the smallest vertex first, in lexicographic order: no
/// order of the library that computes them shows through, so that the same points give the same mesh for ever, as long as
/// no four of them are cocircular. Exact predicates; O(n log n).
///
/// # Errors
/// Two points coincide (the library would merge them and shift all later indices), or all lie on a line.
pub fn delaunay(generator: &'static str, points: &[[f64; 2]]) -> Result<Vec<[usize; 3]>, GenerateError> {
    let sites = points.iter().map(|p| Point2::new(p[0], p[1])).collect();
    let mesh = DelaunayTriangulation::<Point2<f64>>::bulk_load_stable(sites)
        .map_err(|error| impossible(generator, error.to_string()))?;
    if mesh.num_vertices() != points.len() {
        return Err(impossible(generator, "two points coincide; choose another seed"));
    }
    let mut faces: Vec<[usize; 3]> =
        mesh.inner_faces().map(|f| smallest_first(f.vertices().map(|v| v.index()))).collect();
    if faces.is_empty() {
        return Err(impossible(generator, "all points lie on a line; choose another seed or more points"));
    }
    faces.sort_unstable();
    Ok(faces)
}

fn smallest_first([a, b, c]: [usize; 3]) -> [usize; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coinciding_and_collinear_points_are_refused() {
        let message = |p: &[[f64; 2]]| delaunay("x", p).unwrap_err().to_string();
        assert!(message(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0]]).contains("coincide"));
        assert!(message(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]).contains("on a line"));
    }

    #[test]
    fn indices_are_those_of_the_points_and_faces_are_counter_clockwise() {
        let faces = delaunay("x", &[[0.0, 1.0], [0.0, 0.0], [1.0, 0.0]]).unwrap();
        assert_eq!(faces, [[0, 1, 2]]);
    }
}
