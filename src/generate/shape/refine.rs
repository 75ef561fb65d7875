//! Midpoint subdivision.

/// Cuts every triangle into four at the midpoints of its edges. The new vertices come after the old ones, in the order of
/// their edges; triangle `f` becomes the triangles `4f … 4f + 3`: its three corners, then its middle.
pub fn midpoint(positions: &mut Vec<[f64; 3]>, triangles: &[[usize; 3]]) -> Vec<[usize; 3]> {
    let sides = |t: &[usize; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let mut edges: Vec<[usize; 2]> = triangles.iter().flat_map(|t| sides(t).map(sorted)).collect();
    edges.sort_unstable();
    edges.dedup();
    let first = positions.len();
    for &[a, b] in &edges {
        let (p, q) = (positions[a], positions[b]);
        positions.push(std::array::from_fn(|k| 0.5 * (p[k] + q[k])));
    }
    // Every side is among the edges, so that the search always succeeds.
    let middle = |side: [usize; 2]| first + edges.binary_search(&sorted(side)).unwrap_or_else(|at| at);
    triangles
        .iter()
        .flat_map(|t| {
            let [c, a, b] = sides(t).map(middle);
            [[t[0], c, b], [c, t[1], a], [b, a, t[2]], [a, b, c]]
        })
        .collect()
}

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}
