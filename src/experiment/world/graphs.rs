//! Every graph with few vertices, once up to renumbering, and exact Laplacians of weighted graphs.

use crate::domain::Graph;
use crate::domain::topology::components;
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::scalar::{Rational, Scalar};

/// All graphs with `n` vertices, one for each class of isomorphic graphs, the empty graph first and the complete one last.
/// Their numbers are 1, 2, 4, 11, 34, 156, 1044, … [OEIS A000088]. At most 7 vertices: cost `2^(n(n−1)/2)` plus n! for each class.
///
/// # Panics
/// For more than 7 vertices.
pub fn graphs(n: usize) -> Vec<Graph> {
    assert!(n <= 7, "the classes of graphs with {n} vertices are too many to enumerate by their orbits");
    let pairs: Vec<[usize; 2]> = (0..n).flat_map(|i| (i + 1..n).map(move |j| [i, j])).collect();
    let mut place = vec![vec![0; n]; n];
    for (k, &[i, j]) in pairs.iter().enumerate() {
        place[i][j] = k;
        place[j][i] = k;
    }
    let renumberings = permutations(n);
    let mut seen = vec![false; 1 << pairs.len()];
    let mut classes = Vec::new();
    for mask in 0..seen.len() {
        if seen[mask] {
            continue;
        }
        let chosen = || (0..pairs.len()).filter(|k| mask >> k & 1 == 1);
        for p in &renumberings {
            seen[chosen().fold(0, |image, k| image | 1 << place[p[pairs[k][0]]][p[pairs[k][1]]])] = true;
        }
        let edges: Vec<[usize; 2]> = chosen().map(|k| pairs[k]).collect();
        classes.extend(Graph::new(n, &edges));
    }
    classes.sort_by_key(|g| g.edges().len());
    classes
}

/// All graphs with one to `largest` vertices; see [`graphs`].
pub fn graphs_up_to(largest: usize) -> Vec<Graph> {
    (1..=largest).flat_map(graphs).collect()
}

/// Random graphs with 7 to 12 vertices, each edge present with the same probability, itself random.
pub fn random_graphs(count: usize, stream: &mut Stream) -> Vec<Graph> {
    let mut drawn = Vec::with_capacity(count);
    while drawn.len() < count {
        let (n, density) = (7 + stream.below(6), stream.unit());
        let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| [i, j]));
        let edges: Vec<[usize; 2]> = pairs.filter(|_| stream.unit() < density).collect();
        drawn.extend(Graph::new(n, &edges));
    }
    drawn
}

fn permutations(n: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for _ in 0..n {
        let longer = |p: Vec<usize>| {
            let free: Vec<usize> = (0..n).filter(|k| !p.contains(k)).collect();
            free.into_iter().map(move |k| [p.clone(), vec![k]].concat()).collect::<Vec<_>>()
        };
        all = all.into_iter().flat_map(longer).collect();
    }
    all
}

/// The same graph with these weights. The weights belong to the graph's edges in their order.
pub fn with_weights(graph: &Graph, weights: &[f64]) -> Graph {
    let boundary: Vec<usize> = (0..graph.vertex_count()).filter(|&i| graph.boundary()[i]).collect();
    Graph::weighted(graph.vertex_count(), graph.edges(), weights)
        .and_then(|g| g.with_boundary(&boundary))
        .expect("edges and boundary of a graph, one finite weight for each edge")
}

/// The same graph with random positive weights, multiples of 1/16 from 1/16 to 8: sums of them are exact in `f64`.
pub fn randomly_weighted(graph: &Graph, stream: &mut Stream) -> Graph {
    let weights: Vec<f64> = graph.edges().iter().map(|_| (1 + stream.below(128)) as f64 / 16.0).collect();
    with_weights(graph, &weights)
}

/// The weight of the `k`-th edge, 1 where none is given.
pub fn weight(graph: &Graph, k: usize) -> Rational {
    graph.weights().map_or(Rational::ONE, |w| rational(w[k]))
}

/// The rational number equal to a finite `f64`.
///
/// # Panics
/// If it is not finite.
pub fn rational(x: f64) -> Rational {
    Rational::exactly(x).expect("finite")
}

/// The Laplacian `L = δᵀ W δ`, summed edge by edge: each edge adds `ω (e_i − e_j)(e_i − e_j)ᵀ`.
pub fn laplacian(graph: &Graph) -> Dense<Rational> {
    let n = graph.vertex_count();
    let mut l = Dense::from_fn(n, n, |_, _| Rational::zero());
    for (k, &[i, j]) in graph.edges().iter().enumerate() {
        let w = weight(graph, k);
        for (row, column, entry) in [(i, i, w.clone()), (j, j, w.clone()), (i, j, -w.clone()), (j, i, -w)] {
            l.add_to(row, column, entry);
        }
    }
    l
}

/// The number of connected components.
pub fn component_count(graph: &Graph) -> usize {
    components(graph.vertex_count(), graph.edges()).into_iter().max().map_or(0, |last| last + 1)
}

/// The vertices outside `set` that no path of edges joins to it.
pub fn unreached(graph: &Graph, set: &[usize]) -> Vec<usize> {
    let of = components(graph.vertex_count(), graph.edges());
    let reached: Vec<usize> = set.iter().map(|&b| of[b]).collect();
    (0..graph.vertex_count()).filter(|&i| !reached.contains(&of[i])).collect()
}

/// The subsets of `0..n` that are neither empty nor everything, the smaller number of the binary count first.
pub fn proper_subsets(n: usize) -> impl Iterator<Item = Vec<usize>> {
    (1..(1_usize << n).saturating_sub(1)).map(move |mask| (0..n).filter(|i| mask >> i & 1 == 1).collect())
}

/// The graph in words: vertices and edges, with the weights where they are not all one.
pub fn describe(graph: &Graph) -> String {
    let edge = |(k, [i, j]): (usize, &[usize; 2])| match graph.weights() {
        Some(w) => format!("{i}–{j}: {}", w[k]),
        None => format!("{i}–{j}"),
    };
    let edges: Vec<String> = graph.edges().iter().enumerate().map(edge).collect();
    let edges = if edges.is_empty() { "no edge".into() } else { edges.join(", ") };
    format!("the graph with {} vertices and {edges}", graph.vertex_count())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_classes_are_as_many_as_the_encyclopedia_of_integer_sequences_says() {
        // A000088 all graphs, A001349 connected graphs.
        let all = [1, 2, 4, 11, 34, 156, 1044];
        let connected = [1, 1, 2, 6, 21, 112, 853];
        for n in 1..=7 {
            let classes = graphs(n);
            assert_eq!(classes.len(), all[n - 1]);
            assert_eq!(classes.iter().filter(|g| component_count(g) == 1).count(), connected[n - 1]);
        }
    }

    #[test]
    fn the_laplacian_of_a_weighted_path_is_the_textbook_matrix() {
        let path = Graph::weighted(3, &[[0, 1], [1, 2]], &[2.0, 3.0]).unwrap();
        let expected = [[2.0, -2.0, 0.0], [-2.0, 5.0, -3.0], [0.0, -3.0, 3.0]];
        assert_eq!(laplacian(&path), Dense::from_fn(3, 3, |i, j| rational(expected[i][j])));
    }

    #[test]
    fn every_proper_subset_occurs_once_and_unreached_vertices_are_those_of_other_components() {
        assert_eq!(proper_subsets(4).count(), 14);
        assert_eq!(proper_subsets(0).count() + proper_subsets(1).count(), 0);
        let two = Graph::new(5, &[[0, 1], [2, 3]]).unwrap();
        assert_eq!(unreached(&two, &[1]), [2, 3, 4]);
    }
}
