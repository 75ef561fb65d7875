//! Who is next to whom: the pairs at which a local operator may have an entry.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, VecDeque};

use crate::domain::{Domain, Surface};
use crate::linalg::Csr;

/// For each vertex its neighbours: those that share a face with it (on triangles, tetrahedra and graphs: an edge).
///
/// # Memory
/// 8 bytes a vertex, and 12 for each neighbour of each vertex: 80 n on a triangle mesh of n vertices.
#[derive(Clone, Debug)]
pub struct Stencil {
    offsets: Vec<usize>,
    neighbours: Vec<usize>,
    /// The edge to each neighbour; [`NO_EDGE`] where a face is all they share.
    edges: Vec<u32>,
}

const NO_EDGE: u32 = u32::MAX;

/// How a pair of vertices stands to the domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Link {
    /// A vertex with itself.
    Same,
    /// The ends of an edge; its number.
    Edge(usize),
    /// Vertices of a face that share no edge.
    Face,
    /// Vertices that share nothing.
    Far,
}

impl Link {
    /// The number of the edge, if it is one.
    pub fn edge(self) -> Option<usize> {
        if let Link::Edge(e) = self { Some(e) } else { None }
    }
}

impl Stencil {
    /// Of a domain. Cost: O(n + F); where faces have more than three corners, their diagonals are sorted in as well.
    pub fn of(domain: &Domain) -> Self {
        let edges = domain.edges();
        let mut offsets = vec![0; domain.vertex_count() + 2];
        edges.iter().flatten().for_each(|&v| offsets[v + 2] += 1);
        (0..=domain.vertex_count()).for_each(|v| offsets[v + 1] += offsets[v]);
        let (mut neighbours, mut numbers) = (vec![0; 2 * edges.len()], vec![NO_EDGE; 2 * edges.len()]);
        // Edges come in lexicographic order: first the smaller neighbours of each vertex, then the larger ones, ascending.
        for side in [1, 0] {
            for (number, edge) in edges.iter().enumerate() {
                let next = &mut offsets[edge[side] + 1];
                (neighbours[*next], numbers[*next]) = (edge[1 - side], u32::try_from(number).unwrap_or(NO_EDGE));
                *next += 1;
            }
        }
        offsets.pop();
        let stencil = Stencil { offsets, neighbours, edges: numbers };
        match domain {
            Domain::Surface(surface) if !surface.is_triangulated() => stencil.with_diagonals(surface),
            _ => stencil,
        }
    }

    /// Adds the pairs of vertices that share a face.
    fn with_diagonals(self, surface: &Surface) -> Self {
        let n = surface.positions().len();
        let mut all: Vec<Vec<(usize, u32)>> = (0..n).map(|v| self.links(v).collect()).collect();
        for face in surface.faces().iter().filter(|f| f.len() > 3) {
            face.iter().for_each(|&v| all[v].extend(face.iter().filter(|&&w| w != v).map(|&w| (w, NO_EDGE))));
        }
        let mut stencil = Stencil { offsets: vec![0], neighbours: Vec::new(), edges: Vec::new() };
        for list in &mut all {
            list.sort_unstable();
            // Of equal neighbours the first has the number of the edge, if one has.
            list.dedup_by_key(|(w, _)| *w);
            stencil.neighbours.extend(list.iter().map(|l| l.0));
            stencil.edges.extend(list.iter().map(|l| l.1));
            stencil.offsets.push(stencil.neighbours.len());
        }
        stencil
    }

    fn range(&self, vertex: usize) -> std::ops::Range<usize> {
        self.offsets[vertex]..self.offsets[vertex + 1]
    }

    fn links(&self, vertex: usize) -> impl Iterator<Item = (usize, u32)> + '_ {
        self.range(vertex).map(|at| (self.neighbours[at], self.edges[at]))
    }

    /// The neighbours of a vertex, ascending.
    pub fn neighbours(&self, vertex: usize) -> &[usize] {
        &self.neighbours[self.range(vertex)]
    }

    /// The numbers of the edges at a vertex, by neighbour.
    pub(crate) fn edges(&self, vertex: usize) -> impl Iterator<Item = usize> + '_ {
        self.edges[self.range(vertex)].iter().filter(|&&e| e != NO_EDGE).map(|&e| e as usize)
    }

    /// Whether a local operator may have an entry at (i, j).
    pub fn contains(&self, i: usize, j: usize) -> bool {
        i == j || self.neighbours(i).binary_search(&j).is_ok()
    }

    /// How i stands to each of some vertices, ascending: both lists are walked once.
    pub(crate) fn along<'a>(&'a self, i: usize, columns: &'a [usize]) -> impl Iterator<Item = Link> + 'a {
        let (mut at, end) = (self.offsets[i], self.offsets[i + 1]);
        columns.iter().map(move |&j| {
            while at < end && self.neighbours[at] < j {
                at += 1;
            }
            match () {
                () if i == j => Link::Same,
                () if at == end || self.neighbours[at] != j => Link::Far,
                () if self.edges[at] == NO_EDGE => Link::Face,
                () => Link::Edge(self.edges[at] as usize),
            }
        })
    }

    /// The entries of row i with how their column stands to i.
    pub(crate) fn row<'a>(&'a self, matrix: &'a Csr, i: usize) -> impl Iterator<Item = (usize, f64, Link)> + 'a {
        let (columns, values) = matrix.row_slices(i);
        columns.iter().zip(values).zip(self.along(i, columns)).map(|((&j, &v), link)| (j, v, link))
    }

    /// The non-zero entries of row i that lie off the stencil.
    pub fn far_entries<'a>(&'a self, matrix: &'a Csr, i: usize) -> impl Iterator<Item = (usize, f64)> + 'a {
        self.row(matrix, i).filter(|&(_, v, link)| v != 0.0 && link == Link::Far).map(|(j, v, _)| (j, v))
    }

    /// The distance in rings from a vertex to each of `targets` (ascending), `None` where they are not connected. Stops when all are
    /// found; `budget` counts visited vertices down and ends the search at zero, then the rest is `None` as well.
    pub fn rings(&self, from: usize, targets: &[usize], budget: &mut usize) -> Vec<Option<usize>> {
        let mut distance = BTreeMap::from([(from, 0)]);
        let mut queue = VecDeque::from([from]);
        let mut missing = targets.iter().filter(|&&t| t != from).count();
        while let Some(v) = queue.pop_front().filter(|_| missing > 0 && *budget > 0) {
            *budget -= 1;
            let next = distance[&v] + 1;
            for &w in self.neighbours(v) {
                if let Entry::Vacant(place) = distance.entry(w) {
                    place.insert(next);
                    missing -= usize::from(targets.binary_search(&w).is_ok());
                    queue.push_back(w);
                }
            }
        }
        targets.iter().map(|t| distance.get(t).copied()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Graph;

    #[test]
    fn the_diagonals_of_a_quadrilateral_are_in_its_stencil() {
        let p = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let s = Stencil::of(&Surface::new(p, vec![vec![0, 1, 2, 3]]).unwrap().into());
        assert!(s.contains(0, 2) && s.contains(1, 3));
        assert_eq!(s.neighbours(0), [1, 2, 3]);
        let links = [Link::Same, Link::Edge(0), Link::Face, Link::Edge(1), Link::Far];
        assert_eq!(s.along(0, &[0, 1, 2, 3, 7]).collect::<Vec<_>>(), links);
    }

    #[test]
    fn rings_on_a_path_are_the_distances_along_it() {
        let s = Stencil::of(&Graph::new(6, &[[0, 1], [1, 2], [2, 3], [3, 4]]).unwrap().into());
        let mut budget = 100;
        assert_eq!(s.rings(0, &[2, 4, 5], &mut budget), [Some(2), Some(4), None]);
        assert_eq!(s.rings(0, &[4], &mut 2), [None]);
    }
}
