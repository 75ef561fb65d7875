//! The edges at each vertex, ordered by their other ends: the pattern of a sparse matrix before there is one.

/// The edges at each vertex, those to smaller vertices first; both sorts ascend by the other end.
///
/// Edges in lexicographic order lie together by their smaller ends, so that only those at the larger ends are listed.
///
/// # Memory
/// 8 bytes a vertex and 4 an edge.
#[derive(Clone, Debug)]
pub struct Incidence {
    /// The first edge whose smaller end is this vertex or a later one.
    upward: Vec<u32>,
    /// Where the edges whose larger end is this vertex begin in the list.
    starts: Vec<u32>,
    downward: Vec<u32>,
}

impl Incidence {
    /// Of edges `[smaller, larger]` in lexicographic order, none twice, fewer than 2³² of them. Cost: O(n + E).
    pub fn new(vertices: usize, edges: &[[usize; 2]]) -> Self {
        let (mut upward, mut starts) = (vec![0; vertices + 1], vec![0; vertices + 2]);
        for &[low, high] in edges {
            upward[low + 1] += 1;
            starts[high + 2] += 1;
        }
        for v in 0..vertices {
            upward[v + 1] += upward[v];
            starts[v + 1] += starts[v];
        }
        // Counted two places on, the starts are where the next edge goes, and where the list of each vertex begins in the end.
        starts[vertices + 1] += starts[vertices];
        let mut downward = vec![0; edges.len()];
        for (edge, &[_, high]) in edges.iter().enumerate() {
            downward[starts[high + 1] as usize] = edge as u32;
            starts[high + 1] += 1;
        }
        starts.pop();
        Incidence { upward, starts, downward }
    }

    /// The number of vertices.
    pub fn vertices(&self) -> usize {
        self.upward.len() - 1
    }

    /// The number of edges at a vertex.
    pub fn degree(&self, vertex: usize) -> usize {
        self.downward(vertex).len() + self.upward(vertex).len()
    }

    /// The edges to smaller vertices, ascending.
    pub fn downward(&self, vertex: usize) -> &[u32] {
        &self.downward[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }

    /// The edges to larger vertices.
    pub fn upward(&self, vertex: usize) -> std::ops::Range<usize> {
        self.upward[vertex] as usize..self.upward[vertex + 1] as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_vertex_has_its_edges_by_their_other_ends() {
        let edges = [[0, 1], [0, 3], [1, 2], [1, 3], [2, 3]];
        let at = Incidence::new(5, &edges);
        assert_eq!((at.downward(3), at.upward(3)), (&[1, 3, 4][..], 5..5));
        assert_eq!((at.downward(1), at.upward(1)), (&[0][..], 2..4));
        assert_eq!([0, 1, 2, 3, 4].map(|v| at.degree(v)), [2, 3, 2, 3, 0]);
        assert_eq!((at.vertices(), Incidence::new(0, &[]).vertices()), (5, 0));
    }
}
