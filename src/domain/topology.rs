//! Edges, their sides, components, boundary and orientation of a list of faces.

use std::collections::BTreeMap;

/// One side of an edge: the face that lies there and the corner of that face at which the edge starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// The face.
    pub face: usize,
    /// The edge runs from this corner of the face to the next one.
    pub corner: usize,
    /// Whether the face runs along the edge from its smaller to its larger vertex.
    pub forward: bool,
}

/// The connectivity of a list of faces: edges with the faces beside them, boundary, manifoldness.
#[derive(Clone, Debug)]
pub struct Topology {
    edges: Vec<[usize; 2]>,
    side_offsets: Vec<usize>,
    sides: Vec<Side>,
    boundary_vertices: Vec<bool>,
    star_offsets: Vec<usize>,
    star: Vec<(usize, usize)>,
}

impl Topology {
    /// Reads the connectivity off the faces. Cost: O(n + F log valence).
    pub fn new(vertices: usize, faces: &[Vec<usize>]) -> Self {
        let mut by_low: Vec<Vec<(usize, Side)>> = vec![Vec::new(); vertices];
        for (face, corners) in faces.iter().enumerate() {
            for (corner, &a) in corners.iter().enumerate() {
                let b = corners[(corner + 1) % corners.len()];
                by_low[a.min(b)].push((a.max(b), Side { face, corner, forward: a < b }));
            }
        }
        let (mut edges, mut sides, mut side_offsets) = (Vec::new(), Vec::new(), vec![0]);
        for (low, list) in by_low.iter_mut().enumerate() {
            list.sort_by_key(|&(high, side)| (high, side.face, side.corner));
            for &(high, side) in list.iter() {
                if edges.last() != Some(&[low, high]) {
                    if !edges.is_empty() {
                        side_offsets.push(sides.len());
                    }
                    edges.push([low, high]);
                }
                sides.push(side);
            }
        }
        if !edges.is_empty() {
            side_offsets.push(sides.len());
        }
        let mut boundary_vertices = vec![false; vertices];
        for (e, &[a, b]) in edges.iter().enumerate() {
            if side_offsets[e + 1] - side_offsets[e] == 1 {
                boundary_vertices[a] = true;
                boundary_vertices[b] = true;
            }
        }
        let mut star_offsets = vec![0; vertices + 1];
        for &v in faces.iter().flatten() {
            star_offsets[v + 1] += 1;
        }
        for v in 0..vertices {
            star_offsets[v + 1] += star_offsets[v];
        }
        let mut next = star_offsets.clone();
        let mut star = vec![(0, 0); star_offsets[vertices]];
        for (face, corners) in faces.iter().enumerate() {
            for (corner, &v) in corners.iter().enumerate() {
                star[next[v]] = (face, corner);
                next[v] += 1;
            }
        }
        Topology { edges, side_offsets, sides, boundary_vertices, star_offsets, star }
    }

    /// The edges as `[smaller, larger]`, in lexicographic order.
    pub fn edges(&self) -> &[[usize; 2]] {
        &self.edges
    }

    /// The number of the edge between two vertices.
    pub fn edge_between(&self, a: usize, b: usize) -> Option<usize> {
        self.edges.binary_search(&[a.min(b), a.max(b)]).ok()
    }

    /// The faces beside an edge: one on the boundary, two inside, more where the surface is not a manifold.
    pub fn sides(&self, edge: usize) -> &[Side] {
        &self.sides[self.side_offsets[edge]..self.side_offsets[edge + 1]]
    }

    /// Whether exactly one face lies at the edge.
    pub fn is_boundary_edge(&self, edge: usize) -> bool {
        self.sides(edge).len() == 1
    }

    /// For each vertex, whether it is an end of a boundary edge.
    pub fn boundary_vertices(&self) -> &[bool] {
        &self.boundary_vertices
    }

    /// The faces around a vertex, each with the corner at which the vertex sits, in face order.
    pub fn star(&self, vertex: usize) -> &[(usize, usize)] {
        &self.star[self.star_offsets[vertex]..self.star_offsets[vertex + 1]]
    }

    /// The number of boundary loops: connected components of the boundary edges.
    pub fn boundary_loops(&self) -> usize {
        let loops: Vec<_> =
            (0..self.edges.len()).filter(|&e| self.is_boundary_edge(e)).map(|e| self.edges[e]).collect();
        let of = components(self.boundary_vertices.len(), &loops);
        let mut seen: Vec<usize> = loops.iter().map(|e| of[e[0]]).collect();
        seen.sort_unstable();
        seen.dedup();
        seen.len()
    }

    /// The edges with more than two faces.
    pub fn non_manifold_edges(&self) -> Vec<usize> {
        (0..self.edges.len()).filter(|&e| self.sides(e).len() > 2).collect()
    }

    /// The vertices whose faces form more than one fan, counting faces as joined when they share an edge at the vertex.
    /// Ends of non-manifold edges are not listed for that reason alone.
    pub fn non_manifold_vertices(&self, faces: &[Vec<usize>]) -> Vec<usize> {
        (0..self.boundary_vertices.len()).filter(|&v| self.fans(v, faces) > 1).collect()
    }

    fn fans(&self, vertex: usize, faces: &[Vec<usize>]) -> usize {
        let star = self.star(vertex);
        let mut joined_at: BTreeMap<usize, usize> = BTreeMap::new();
        let mut union = Union::new(star.len());
        for (at, &(face, corner)) in star.iter().enumerate() {
            let corners = &faces[face];
            for neighbour in
                [corners[(corner + 1) % corners.len()], corners[(corner + corners.len() - 1) % corners.len()]]
            {
                let first = *joined_at.entry(neighbour).or_insert(at);
                union.join(first, at);
            }
        }
        (0..star.len()).filter(|&at| union.root(at) == at).count()
    }
}

/// For each vertex the number of its connected component, numbered in order of the smallest vertex.
pub fn components(vertices: usize, edges: &[[usize; 2]]) -> Vec<usize> {
    let mut union = Union::new(vertices);
    for &[a, b] in edges {
        union.join(a, b);
    }
    let mut number = vec![usize::MAX; vertices];
    let mut next = 0;
    (0..vertices)
        .map(|v| {
            let root = union.root(v);
            if number[root] == usize::MAX {
                number[root] = next;
                next += 1;
            }
            number[root]
        })
        .collect()
}

/// Disjoint sets whose representative is their smallest member.
struct Union(Vec<usize>);

impl Union {
    fn new(n: usize) -> Self {
        Union((0..n).collect())
    }
    fn root(&mut self, mut v: usize) -> usize {
        while self.0[v] != v {
            self.0[v] = self.0[self.0[v]];
            v = self.0[v];
        }
        v
    }
    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
}

/// What orienting the faces came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Orientation {
    /// Whether neighbouring faces can all be made to agree.
    pub orientable: bool,
    /// How many interior edges two faces crossed in the same direction before the repair.
    pub ill_oriented_edges: usize,
    /// How many faces were turned round.
    pub flipped_faces: usize,
}

/// Turns faces round until neighbours across two-sided edges agree, the minority of each component first; leaves a
/// component that cannot be oriented as it was.
pub fn orient(faces: &mut [Vec<usize>], topology: &Topology) -> Orientation {
    let mut neighbours: Vec<Vec<(usize, bool)>> = vec![Vec::new(); faces.len()];
    let mut ill = 0;
    for e in 0..topology.edges().len() {
        if let [a, b] = topology.sides(e) {
            let disagree = a.forward == b.forward;
            ill += usize::from(disagree);
            neighbours[a.face].push((b.face, disagree));
            neighbours[b.face].push((a.face, disagree));
        }
    }
    let mut result = Orientation { orientable: true, ill_oriented_edges: ill, flipped_faces: 0 };
    if ill == 0 {
        return result;
    }
    let mut turn: Vec<Option<bool>> = vec![None; faces.len()];
    for seed in 0..faces.len() {
        if turn[seed].is_some() {
            continue;
        }
        let (mut component, mut next, mut consistent) = (vec![seed], 0, true);
        turn[seed] = Some(false);
        while next < component.len() {
            let face = component[next];
            next += 1;
            for &(other, disagree) in &neighbours[face] {
                let wanted = turn[face].unwrap_or(false) ^ disagree;
                match turn[other] {
                    None => {
                        turn[other] = Some(wanted);
                        component.push(other);
                    }
                    Some(found) => consistent &= found == wanted,
                }
            }
        }
        let turned = component.iter().filter(|&&f| turn[f] == Some(true)).count();
        let minority = turned * 2 <= component.len();
        result.orientable &= consistent;
        if consistent {
            for &face in component.iter().filter(|&&f| turn[f] == Some(minority)) {
                faces[face].reverse();
                result.flipped_faces += 1;
            }
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    fn topology(n: usize, faces: &[[usize; 3]]) -> (Vec<Vec<usize>>, Topology) {
        let faces: Vec<Vec<usize>> = faces.iter().map(|f| f.to_vec()).collect();
        let t = Topology::new(n, &faces);
        (faces, t)
    }

    #[test]
    fn two_triangles_share_one_interior_edge() {
        let (_, t) = topology(4, &[[0, 1, 2], [0, 2, 3]]);
        assert_eq!(t.edges(), [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]);
        assert_eq!(t.sides(1).len(), 2);
        assert_eq!((0..5).filter(|&e| t.is_boundary_edge(e)).count(), 4);
        assert_eq!(t.boundary_loops(), 1);
    }

    #[test]
    fn two_triangles_that_touch_in_a_vertex_make_it_non_manifold() {
        let (faces, t) = topology(5, &[[0, 1, 2], [0, 3, 4]]);
        assert_eq!(t.non_manifold_vertices(&faces), [0]);
    }

    #[test]
    fn three_triangles_on_an_edge_make_it_non_manifold_but_not_its_ends() {
        let (faces, t) = topology(5, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]]);
        assert_eq!(t.non_manifold_edges(), [0]);
        assert!(t.non_manifold_vertices(&faces).is_empty());
    }

    #[test]
    fn orienting_turns_the_minority_round() {
        let (mut faces, t) = topology(5, &[[0, 1, 2], [0, 3, 2], [0, 3, 4]]);
        let found = orient(&mut faces, &t);
        assert_eq!(found, Orientation { orientable: true, ill_oriented_edges: 2, flipped_faces: 1 });
        let again = Topology::new(5, &faces);
        assert_eq!(orient(&mut faces, &again).ill_oriented_edges, 0);
    }

    #[test]
    fn a_moebius_strip_cannot_be_oriented() {
        let strip: Vec<[usize; 3]> = (0..5).map(|k| [k, (k + 1) % 5, (k + 2) % 5]).collect();
        let (mut faces, t) = topology(5, &strip);
        assert!(!orient(&mut faces, &t).orientable);
    }

    #[test]
    fn components_are_numbered_by_smallest_vertex_and_isolated_vertices_count() {
        assert_eq!(components(6, &[[4, 5], [0, 2]]), [0, 1, 0, 2, 3, 3]);
    }
}
