//! Graphs as Matrix Market files: the symmetric matrix of their weights.
//!
//! Entry (i, j) is the weight of the edge between i and j, and a `pattern` a graph without weights. The file is `symmetric`,
//! with one triangle stored, or `general` with equal entries on both sides. The diagonal is empty or zero. An edge of weight
//! zero is an edge. The boundary of a graph is not part of the file.

use std::collections::BTreeMap;

use super::error::{Place, ReadError};
use super::matrix_market::{Entry, Field, Stored, Symmetry, shortest};
use crate::domain::{Domain, Graph};

pub(super) fn parse(name: &str, bytes: &[u8]) -> Result<Domain, ReadError> {
    let stored = Stored::read(name, bytes)?;
    if stored.rows != stored.columns {
        let (place, symmetry) = (stored.size.place(), "symmetric");
        return Err(ReadError::NotSquare { place, symmetry, rows: stored.rows, columns: stored.columns });
    }
    if stored.rows == 0 {
        let advice = "the matrix of weights has a row for each".into();
        return Err(ReadError::Missing { place: Place::file(name), what: "vertex".into(), advice });
    }
    if stored.symmetry == Symmetry::SkewSymmetric {
        let (place, what) = (Place::file(name), "a skew-symmetric matrix of weights".into());
        return Err(ReadError::Unsupported { place, what, advice: "the weights of a graph are symmetric" });
    }
    let (mut edges, mut weights) = (Vec::new(), Vec::new());
    for entry in edge_entries(&stored)? {
        edges.push([entry.row, entry.column]);
        weights.push(entry.value);
    }
    let graph = match stored.field {
        Field::Pattern => Graph::new(stored.rows, &edges),
        _ => Graph::weighted(stored.rows, &edges, &weights),
    };
    Ok(graph.map_err(|source| ReadError::Domain { file: name.to_string(), source })?.into())
}

/// One entry for each edge, every entry checked.
fn edge_entries<'a, 'b>(stored: &'b Stored<'a>) -> Result<Vec<&'b Entry<'a>>, ReadError> {
    let mut seen: BTreeMap<(usize, usize), &Entry> = BTreeMap::new();
    for entry in &stored.entries {
        let (place, row, column) = (|| entry.word.place(), entry.row + 1, entry.column + 1);
        let value = || shortest(entry.value);
        if entry.row == entry.column {
            if entry.value != 0.0 {
                return Err(ReadError::Loop { place: place(), row, value: value() });
            }
            continue;
        }
        if !entry.value.is_finite() {
            return Err(ReadError::Weight { place: place(), row, column, value: value() });
        }
        if seen.insert((entry.row, entry.column), entry).is_some() {
            return Err(ReadError::ParallelEdge { place: place(), row, column });
        }
    }
    if stored.symmetry == Symmetry::Symmetric {
        return Ok(seen.into_values().collect());
    }
    for (&(i, j), entry) in &seen {
        let mirrored = seen.get(&(j, i)).map(|e| e.value);
        if mirrored != Some(entry.value) {
            let (value, mirrored) = (shortest(entry.value), mirrored.map_or("none".into(), shortest));
            return Err(ReadError::Asymmetric {
                place: entry.word.place(),
                row: i + 1,
                column: j + 1,
                value,
                mirrored,
            });
        }
    }
    Ok(seen.into_values().filter(|e| e.row > e.column).collect())
}

/// The graph as the lower triangle of its matrix of weights; a pattern if it has none. Numbers have the fewest digits that
/// read back bit for bit.
pub fn write_graph(graph: &Graph) -> String {
    let field = if graph.weights().is_some() { "real" } else { "pattern" };
    let (n, m) = (graph.vertex_count(), graph.edges().len());
    let mut text = format!("%%MatrixMarket matrix coordinate {field} symmetric\n{n} {n} {m}\n");
    for (k, [low, high]) in graph.edges().iter().enumerate() {
        let weight = graph.weights().map(|w| format!(" {}", shortest(w[k]))).unwrap_or_default();
        text.push_str(&format!("{} {}{weight}\n", high + 1, low + 1));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn graph(text: &str) -> Graph {
        match parse("t.mtx", format!("%%MatrixMarket matrix coordinate {text}").as_bytes()) {
            Ok(Domain::Graph(graph)) => graph,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn graphs_come_back_with_and_without_weights() {
        for g in [
            Graph::new(4, &[[0, 1], [2, 1]]).unwrap(),
            Graph::weighted(4, &[[0, 1], [2, 1], [3, 0]], &[0.1, -2.0 / 3.0, 0.0]).unwrap(),
        ] {
            let Ok(Domain::Graph(back)) = parse("t.mtx", write_graph(&g).as_bytes()) else { panic!("graph") };
            assert_eq!((back.vertex_count(), back.edges(), back.weights()), (4, g.edges(), g.weights()));
        }
    }

    #[test]
    fn a_general_file_with_both_sides_is_the_same_graph() {
        let general = graph("real general\n3 3 5\n1 2 0.5\n3 2 4\n2 1 0.5\n2 3 4\n1 1 0\n");
        let symmetric = graph("real symmetric\n3 3 2\n2 1 0.5\n3 2 4\n");
        assert_eq!((general.edges(), general.weights()), (symmetric.edges(), symmetric.weights()));
    }
}
