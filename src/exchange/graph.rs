//! Graphs as Matrix Market files: the symmetric matrix of their weights.
//!
//! Entry (i, j) is the weight of the edge between i and j, and a `pattern` a graph without weights. The file is `symmetric`,
//! with one triangle stored, or `general` with equal entries on both sides. The diagonal is empty or zero. An edge of weight
//! zero is an edge. The boundary of a graph is not part of the file.

use super::error::{Place, ReadError};
use super::matrix_market::{Field, Stored, Symmetry, shortest};
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
    for k in edge_entries(&stored)? {
        let (row, column, value) = stored.entries[k];
        edges.push([row, column]);
        weights.push(value);
    }
    let graph = match stored.field {
        Field::Pattern => Graph::new(stored.rows, &edges),
        _ => Graph::weighted(stored.rows, &edges, &weights),
    };
    Ok(graph.map_err(|source| ReadError::Domain { file: name.to_string(), source })?.into())
}

/// The numbers of the entries that stand for an edge, one for each, by row and column; every entry is checked.
fn edge_entries(stored: &Stored) -> Result<Vec<usize>, ReadError> {
    let entries = &stored.entries;
    for (k, &(i, j, value)) in entries.iter().enumerate() {
        let text = || shortest(value);
        if i == j && value != 0.0 {
            return Err(ReadError::Loop { place: stored.place(k), row: i + 1, value: text() });
        }
        if i != j && !value.is_finite() {
            return Err(ReadError::Weight { place: stored.place(k), row: i + 1, column: j + 1, value: text() });
        }
    }
    let at = |k: usize| (entries[k].0, entries[k].1);
    let mut order: Vec<usize> = (0..entries.len()).filter(|&k| entries[k].0 != entries[k].1).collect();
    order.sort_unstable_by_key(|&k| (at(k), k));
    if let Some(k) = order.windows(2).filter(|w| at(w[0]) == at(w[1])).map(|w| w[1]).min() {
        let (i, j) = at(k);
        return Err(ReadError::ParallelEdge { place: stored.place(k), row: i + 1, column: j + 1 });
    }
    if stored.symmetry == Symmetry::Symmetric {
        return Ok(order);
    }
    for &k in &order {
        let (i, j, value) = entries[k];
        let mirrored = order.binary_search_by_key(&(j, i), |&other| at(other)).ok().map(|at| entries[order[at]].2);
        if mirrored != Some(value) {
            let (value, mirrored) = (shortest(value), mirrored.map_or("none".into(), shortest));
            return Err(ReadError::Asymmetric { place: stored.place(k), row: i + 1, column: j + 1, value, mirrored });
        }
    }
    order.retain(|&k| entries[k].0 > entries[k].1);
    Ok(order)
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
