//! Excerpts of small matrices and meshes, to go with a statement. The matrix of an excerpt is the exact one with each entry
//! rounded to the nearest `f64`.

use super::triangulations::{Edge, Triangulation};
use crate::domain::{Graph, geometry};
use crate::linalg::Dense;
use crate::property::evidence::{Corner, Row, SparseVector};
use crate::property::{Evidence, Excerpt, Statement};
use crate::scalar::{Rational, Scalar};

/// Rows of a matrix with their entries that are not zero.
pub fn rows(matrix: &Dense<Rational>, numbers: &[usize]) -> Vec<Row> {
    let row = |i: usize| {
        let entries = (0..matrix.columns()).map(|j| (j, matrix.at(i, j).approximate()));
        Row { row: i, entries: entries.filter(|(_, v)| *v != 0.0).collect() }
    };
    numbers.iter().map(|&i| row(i)).collect()
}

/// The non-zero components of a vector.
pub fn sparse(x: &[Rational]) -> SparseVector {
    let components = x.iter().map(Scalar::approximate).enumerate();
    components.filter(|(_, v)| *v != 0.0).collect()
}

/// A statement about rows of a graph's matrix, with all of its edges.
pub fn on_graph(statement: Statement, graph: &Graph, matrix: &Dense<Rational>, numbers: &[usize]) -> Evidence {
    let excerpt = Excerpt { rows: rows(matrix, numbers), edges: graph.edges().to_vec(), ..Excerpt::default() };
    Evidence::new(statement, excerpt)
}

/// A statement about rows of a matrix on a triangulation, with all of its positions and the faces that it speaks of.
pub fn on_triangulation(
    statement: Statement,
    triangulation: &Triangulation,
    matrix: &Dense<Rational>,
    numbers: &[usize],
) -> Evidence {
    let positions = triangulation.points().iter().map(|&[x, y]| [x as f64, y as f64, 0.0]).enumerate();
    let spoken_of = |face: &[usize]| match &statement {
        Statement::Weight { i, j, .. } => face.contains(i) && face.contains(j),
        Statement::FarEntry { i, .. } => face.contains(i),
        _ => true,
    };
    let faces = triangulation.faces().iter().map(|f| f.to_vec()).enumerate().filter(|(_, f)| spoken_of(f));
    let excerpt = Excerpt {
        rows: rows(matrix, numbers),
        positions: positions.collect(),
        faces: faces.collect(),
        ..Excerpt::default()
    };
    Evidence::new(statement, excerpt)
}

/// The corners opposite an edge with their angles.
pub fn corners(t: &Triangulation, edge: &Edge) -> Vec<Corner> {
    let at = |v: usize| geometry::Vec3::new(t.points()[v][0] as f64, t.points()[v][1] as f64, 0.0);
    let angle = |apex: usize| geometry::angle(at(apex), at(edge.ends[0]), at(edge.ends[1])).to_degrees();
    [Some(edge.left), edge.right]
        .into_iter()
        .flatten()
        .map(|vertex| Corner { vertex, angle_deg: angle(vertex) })
        .collect()
}
