//! Graphs with optional weights and an optional boundary.

use super::{DomainError, check_corners};

/// A simple undirected graph, with optional edge weights and an optional set of boundary vertices.
#[derive(Clone, Debug)]
pub struct Graph {
    vertices: usize,
    edges: Vec<[usize; 2]>,
    weights: Option<Vec<f64>>,
    boundary: Vec<bool>,
}

impl Graph {
    /// A graph from its edges; they are stored as `[smaller, larger]` in lexicographic order.
    ///
    /// # Errors
    /// An index out of range, a loop, an edge given twice.
    pub fn new(vertices: usize, edges: &[[usize; 2]]) -> Result<Self, DomainError> {
        Graph::build(vertices, edges, None)
    }

    /// A graph whose `k`-th edge has the weight `weights[k]`.
    ///
    /// # Errors
    /// As [`Graph::new`]; a weight that is not finite, a list of weights of another length.
    pub fn weighted(vertices: usize, edges: &[[usize; 2]], weights: &[f64]) -> Result<Self, DomainError> {
        if weights.len() != edges.len() {
            return Err(DomainError::WrongLength {
                what: "weights",
                found: weights.len(),
                expected: edges.len(),
                of: "edges",
            });
        }
        if let Some(index) = weights.iter().position(|w| !w.is_finite()) {
            return Err(DomainError::WeightNotFinite { index, value: weights[index].to_string() });
        }
        Graph::build(vertices, edges, Some(weights))
    }

    fn build(vertices: usize, edges: &[[usize; 2]], weights: Option<&[f64]>) -> Result<Self, DomainError> {
        let mut order: Vec<usize> = (0..edges.len()).collect();
        for (index, edge) in edges.iter().enumerate() {
            check_corners("edge", index, edge, vertices)?;
        }
        let normal = |k: usize| [edges[k][0].min(edges[k][1]), edges[k][0].max(edges[k][1])];
        order.sort_by_key(|&k| (normal(k), k));
        if let Some(w) = order.windows(2).find(|w| normal(w[0]) == normal(w[1])) {
            let [a, b] = normal(w[1]);
            return Err(DomainError::DuplicateEdge { index: w[1], a, b });
        }
        Ok(Graph {
            vertices,
            edges: order.iter().map(|&k| normal(k)).collect(),
            weights: weights.map(|w| order.iter().map(|&k| w[k]).collect()),
            boundary: vec![false; vertices],
        })
    }

    /// The same graph with a boundary: the vertices at which a Dirichlet problem prescribes values.
    ///
    /// # Errors
    /// An index out of range.
    pub fn with_boundary(mut self, boundary: &[usize]) -> Result<Self, DomainError> {
        self.boundary = vec![false; self.vertices];
        for (index, &vertex) in boundary.iter().enumerate() {
            check_corners("boundary vertex", index, &[vertex], self.vertices)?;
            self.boundary[vertex] = true;
        }
        Ok(self)
    }

    /// The number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.vertices
    }

    /// The edges as `[smaller, larger]`, in lexicographic order.
    pub fn edges(&self) -> &[[usize; 2]] {
        &self.edges
    }

    /// The weights, one for each edge, if any were given.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// For each vertex, whether it is on the boundary.
    pub fn boundary(&self) -> &[bool] {
        &self.boundary
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_follow_their_edges_into_sorted_order() {
        let g = Graph::weighted(3, &[[2, 1], [1, 0]], &[5.0, 7.0]).unwrap();
        assert_eq!(g.edges(), [[0, 1], [1, 2]]);
        assert_eq!(g.weights(), Some(&[7.0, 5.0][..]));
    }

    #[test]
    fn loops_parallel_edges_and_foreign_vertices_are_refused() {
        assert!(matches!(Graph::new(2, &[[1, 1]]), Err(DomainError::RepeatedVertex { .. })));
        assert!(matches!(Graph::new(2, &[[0, 1], [1, 0]]), Err(DomainError::DuplicateEdge { index: 1, .. })));
        assert!(matches!(Graph::new(2, &[[0, 2]]), Err(DomainError::IndexOutOfRange { vertex: 2, .. })));
        assert!(matches!(Graph::weighted(2, &[[0, 1]], &[f64::NAN]), Err(DomainError::WeightNotFinite { .. })));
    }
}
