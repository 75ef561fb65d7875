//! Edges, their sides, components, boundary and orientation of a list of faces.

use rayon::prelude::*;

use super::Faces;
use super::incidence::Incidence;

/// One side of an edge: the face that lies there and the corner of that face at which the edge starts. Eight bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    face: u32,
    /// Twice the corner, plus one where the face runs from the smaller vertex to the larger.
    corner_and_direction: u32,
}

impl Side {
    /// The face.
    pub fn face(self) -> usize {
        self.face as usize
    }

    /// The edge runs from this corner of the face to the next one.
    pub fn corner(self) -> usize {
        (self.corner_and_direction / 2) as usize
    }

    /// Whether the face runs along the edge from its smaller to its larger vertex.
    pub fn forward(self) -> bool {
        self.corner_and_direction % 2 == 1
    }
}

/// A face around a vertex: which, and with which of its corners. Eight bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner {
    face: u32,
    corner: u32,
}

impl Corner {
    /// The face.
    pub fn face(self) -> usize {
        self.face as usize
    }

    /// The corner at which the vertex sits.
    pub fn corner(self) -> usize {
        self.corner as usize
    }

    /// The vertices after and before this one around the face.
    pub fn neighbours(self, faces: &Faces) -> [usize; 2] {
        let (corners, k) = (&faces[self.face()], self.corner());
        [corners[if k + 1 == corners.len() { 0 } else { k + 1 }], corners[if k == 0 { corners.len() } else { k } - 1]]
    }
}

/// The connectivity of a list of faces: edges with the faces beside them, boundary, manifoldness.
///
/// # Memory
/// 24 bytes an edge, 16 a corner and 13 a vertex: with E = 3n and 6n corners on a triangle mesh of n vertices, 181 n.
#[derive(Clone, Debug)]
pub struct Topology {
    edges: Vec<[usize; 2]>,
    side_offsets: Vec<u32>,
    sides: Vec<Side>,
    non_manifold_edges: Vec<usize>,
    incidence: Incidence,
    boundary_vertices: Vec<bool>,
    star_offsets: Vec<u32>,
    star: Vec<Corner>,
}

/// How many vertices a thread takes at a time; what depends on it is only who does which.
const BLOCK: usize = 1 << 13;

/// The edges from the vertices of a block to larger ones, how many sides each has, and the sides.
#[derive(Default)]
struct Block {
    edges: Vec<[usize; 2]>,
    counts: Vec<u32>,
    sides: Vec<Side>,
}

impl Topology {
    /// The largest number of corners, over all faces together, that the connectivity can number.
    pub const MOST_CORNERS: usize = u32::MAX as usize / 2;

    /// Reads the connectivity off the faces, in parallel over vertices: each finds among the faces around it the edges to larger
    /// vertices. Cost: O(n + F log valence).
    ///
    /// # Panics
    /// If a vertex is out of range or there are more than [`MOST_CORNERS`](Topology::MOST_CORNERS) corners: callers check both
    /// where faces enter the program.
    pub fn new(vertices: usize, faces: &Faces) -> Self {
        assert!(faces.corners().len() <= Topology::MOST_CORNERS, "too many corners to number");
        let (star_offsets, star) = stars(vertices, faces);
        let around = |v: usize| &star[star_offsets[v] as usize..star_offsets[v + 1] as usize];
        let block = |range: std::ops::Range<usize>, mut block: Block| {
            let mut found: Vec<(usize, Side)> = Vec::new();
            for low in range {
                edges_upward(low, around(low), faces, &mut found);
                for &(high, side) in &found {
                    match (block.edges.last(), block.counts.last_mut()) {
                        (Some(&last), Some(count)) if last == [low, high] => *count += 1,
                        _ => {
                            block.edges.push([low, high]);
                            block.counts.push(1);
                        }
                    }
                    block.sides.push(side);
                }
            }
            block
        };
        let corners = faces.corners().len();
        let blocks: Vec<Block> = if vertices <= BLOCK || rayon::current_num_threads() == 1 {
            // Euler: a closed triangle mesh has half as many edges as corners, and one with a boundary a few more.
            let (edges, counts) = (Vec::with_capacity(corners / 2 + 1), Vec::with_capacity(corners / 2 + 1));
            vec![block(0..vertices, Block { edges, counts, sides: Vec::with_capacity(corners) })]
        } else {
            let range = |k: usize| k * BLOCK..vertices.min((k + 1) * BLOCK);
            (0..vertices.div_ceil(BLOCK)).into_par_iter().map(|k| block(range(k), Block::default())).collect()
        };
        let count: usize = blocks.iter().map(|b| b.edges.len()).sum();
        let (mut edges, mut sides) = (Vec::new(), Vec::new());
        if blocks.len() > 1 {
            edges.reserve_exact(count);
            sides.reserve_exact(corners);
        }
        let mut side_offsets = Vec::with_capacity(count + 1);
        side_offsets.push(0);
        let (mut boundary_vertices, mut non_manifold_edges) = (vec![false; vertices], Vec::new());
        let mut end = 0;
        for block in blocks {
            for (&[a, b], &count) in block.edges.iter().zip(&block.counts) {
                if count > 2 {
                    non_manifold_edges.push(side_offsets.len() - 1);
                }
                end += count;
                side_offsets.push(end);
                if count == 1 {
                    boundary_vertices[a] = true;
                    boundary_vertices[b] = true;
                }
            }
            // The first is kept as it is, if nothing is to come after it.
            if edges.capacity() == 0 {
                (edges, sides) = (block.edges, block.sides);
            } else {
                edges.extend(block.edges);
                sides.extend(block.sides);
            }
        }
        let incidence = Incidence::new(vertices, &edges);
        Topology { edges, side_offsets, sides, non_manifold_edges, incidence, boundary_vertices, star_offsets, star }
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
        &self.sides[self.side_offsets[edge] as usize..self.side_offsets[edge + 1] as usize]
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
    pub fn star(&self, vertex: usize) -> &[Corner] {
        &self.star[self.star_offsets[vertex] as usize..self.star_offsets[vertex + 1] as usize]
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

    /// The edges with more than two faces, ascending.
    pub fn non_manifold_edges(&self) -> &[usize] {
        &self.non_manifold_edges
    }

    /// The edges at each vertex.
    pub fn incidence(&self) -> &Incidence {
        &self.incidence
    }

    /// The vertices whose faces form more than one fan, counting faces as joined when they share an edge at the vertex.
    /// Ends of non-manifold edges are not listed for that reason alone.
    pub fn non_manifold_vertices(&self, faces: &Faces) -> Vec<usize> {
        let (mut ends, mut union) = (Vec::new(), Union(Vec::new()));
        (0..self.boundary_vertices.len()).filter(|&v| self.fans(v, faces, &mut ends, &mut union) > 1).collect()
    }

    /// The number of fans around a vertex; `ends` and `union` are working memory.
    fn fans(&self, vertex: usize, faces: &Faces, ends: &mut Vec<(usize, usize)>, union: &mut Union) -> usize {
        let star = self.star(vertex);
        ends.clear();
        ends.extend(star.iter().enumerate().flat_map(|(at, c)| c.neighbours(faces).map(|neighbour| (neighbour, at))));
        ends.sort_unstable();
        union.0.clear();
        union.0.extend(0..star.len());
        ends.windows(2).filter(|w| w[0].0 == w[1].0).for_each(|w| union.join(w[0].1, w[1].1));
        (0..star.len()).filter(|&at| union.root(at) == at).count()
    }
}

/// The corners around each vertex, in face order, and where those of each vertex begin.
fn stars(vertices: usize, faces: &Faces) -> (Vec<u32>, Vec<Corner>) {
    let mut offsets = vec![0; vertices + 2];
    for &v in faces.corners() {
        offsets[v + 2] += 1;
    }
    for v in 0..=vertices {
        offsets[v + 1] += offsets[v];
    }
    // Counted two places on, the offsets are where the next corner goes, and where each star begins in the end.
    let mut star = vec![Corner { face: 0, corner: 0 }; faces.corners().len()];
    for (face, corners) in faces.iter().enumerate() {
        for (corner, &v) in corners.iter().enumerate() {
            star[offsets[v + 1] as usize] = Corner { face: face as u32, corner: corner as u32 };
            offsets[v + 1] += 1;
        }
    }
    offsets.pop();
    (offsets, star)
}

/// The edges from a vertex to larger ones with a side for each face, in order of the larger vertex, the face, the corner.
fn edges_upward(low: usize, star: &[Corner], faces: &Faces, found: &mut Vec<(usize, Side)>) {
    found.clear();
    for &at in star {
        let [next, previous] = at.neighbours(faces);
        if next > low {
            found.push((next, Side { face: at.face, corner_and_direction: 2 * at.corner + 1 }));
        }
        if previous > low {
            let corner = if at.corner == 0 { faces[at.face()].len() as u32 } else { at.corner } - 1;
            found.push((previous, Side { face: at.face, corner_and_direction: 2 * corner }));
        }
    }
    // Faces come in order, and each names a vertex once: sorted by the vertex, equal ones kept in order, all is in order. The lists
    // are short, so by insertion.
    if found.len() > 32 {
        return found.sort_by_key(|&(high, _)| high);
    }
    for k in 1..found.len() {
        let (item, mut at) = (found[k], k);
        while at > 0 && found[at - 1].0 > item.0 {
            found[at] = found[at - 1];
            at -= 1;
        }
        found[at] = item;
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
pub fn orient(faces: &mut Faces, topology: &Topology) -> Orientation {
    let pair = |e: usize| match topology.sides(e) {
        &[a, b] => Some((a.face(), b.face(), a.forward() == b.forward())),
        _ => None,
    };
    let pairs = || (0..topology.edges().len()).filter_map(pair);
    let ill = pairs().filter(|&(_, _, disagree)| disagree).count();
    let mut result = Orientation { orientable: true, ill_oriented_edges: ill, flipped_faces: 0 };
    if ill == 0 {
        return result;
    }
    let mut neighbours: Vec<Vec<(usize, bool)>> = vec![Vec::new(); faces.len()];
    for (f, g, disagree) in pairs() {
        neighbours[f].push((g, disagree));
        neighbours[g].push((f, disagree));
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
                faces.reverse(face);
                result.flipped_faces += 1;
            }
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    fn topology(n: usize, faces: &[[usize; 3]]) -> (Faces, Topology) {
        let faces = Faces::triangles(faces);
        let t = Topology::new(n, &faces);
        (faces, t)
    }

    /// Edges and sides by a sorted map over all faces: another way than star by star.
    fn by_map(faces: &Faces) -> BTreeMap<[usize; 2], Vec<(usize, usize, bool)>> {
        let mut map: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for (face, corners) in faces.iter().enumerate() {
            for (corner, &a) in corners.iter().enumerate() {
                let b = corners[(corner + 1) % corners.len()];
                map.entry([a.min(b), a.max(b)]).or_default().push((face, corner, a < b));
            }
        }
        map
    }

    #[test]
    fn stars_find_the_edges_and_sides_of_a_map_where_many_faces_share_them_and_on_any_number_of_threads() {
        let mut state = 1_u64;
        let mut below = |n: usize| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as usize % n
        };
        for (n, count) in [(5, 40), (12, 200), (200, 150), (3 * BLOCK, 9 * BLOCK)] {
            // Triangles, quadrilaterals and pentagons of neighbouring numbers, the larger of them with many faces an edge.
            let face = |_| {
                let (first, corners) = (below(n - 4), 3 + below(3));
                let mut face: Vec<usize> = (first..first + corners).collect();
                let turn = below(corners);
                face.rotate_left(turn);
                if below(2) == 0 { face.into_iter().rev().collect() } else { face }
            };
            let faces: Faces = (0..count).map(face).collect::<Vec<Vec<usize>>>().iter().collect();
            let expected = by_map(&faces);
            for threads in [1, 2, 4] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let t = pool.install(|| Topology::new(n, &faces));
                assert_eq!(t.edges(), expected.keys().copied().collect::<Vec<_>>());
                for (e, sides) in expected.values().enumerate() {
                    let found: Vec<_> = t.sides(e).iter().map(|s| (s.face(), s.corner(), s.forward())).collect();
                    assert_eq!(found, *sides);
                }
            }
        }
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
