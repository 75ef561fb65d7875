//! Who is next to whom: the pairs at which a local operator may have an entry.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, VecDeque};

use crate::domain::Domain;
use crate::linalg::Csr;

/// For each vertex its neighbours: those that share a face with it (on triangles, tetrahedra and graphs: an edge).
#[derive(Clone, Debug)]
pub struct Stencil(Vec<Vec<usize>>);

impl Stencil {
    /// Of a domain. Cost: O(n + F).
    pub fn of(domain: &Domain) -> Self {
        let mut neighbours = vec![Vec::new(); domain.vertex_count()];
        for &[a, b] in domain.edges() {
            neighbours[a].push(b);
            neighbours[b].push(a);
        }
        if let Domain::Surface(surface) = domain {
            for face in surface.faces().iter().filter(|f| f.len() > 3) {
                face.iter().for_each(|&v| neighbours[v].extend(face.iter().filter(|&&w| w != v)));
            }
        }
        for list in &mut neighbours {
            list.sort_unstable();
            list.dedup();
        }
        Stencil(neighbours)
    }

    /// The neighbours of a vertex, ascending.
    pub fn neighbours(&self, vertex: usize) -> &[usize] {
        &self.0[vertex]
    }

    /// Whether a local operator may have an entry at (i, j).
    pub fn contains(&self, i: usize, j: usize) -> bool {
        i == j || self.0[i].binary_search(&j).is_ok()
    }

    /// The non-zero entries of row i that lie off the stencil.
    pub fn far_entries<'a>(&'a self, matrix: &'a Csr, i: usize) -> impl Iterator<Item = (usize, f64)> + 'a {
        matrix.row(i).filter(move |&(j, v)| *v != 0.0 && !self.contains(i, j)).map(|(j, v)| (j, *v))
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
            for &w in &self.0[v] {
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
    use crate::domain::{Graph, Surface};

    #[test]
    fn the_diagonals_of_a_quadrilateral_are_in_its_stencil() {
        let p = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let s = Stencil::of(&Surface::new(p, vec![vec![0, 1, 2, 3]]).unwrap().into());
        assert!(s.contains(0, 2) && s.contains(1, 3));
        assert_eq!(s.neighbours(0), [1, 2, 3]);
    }

    #[test]
    fn rings_on_a_path_are_the_distances_along_it() {
        let s = Stencil::of(&Graph::new(6, &[[0, 1], [1, 2], [2, 3], [3, 4]]).unwrap().into());
        let mut budget = 100;
        assert_eq!(s.rings(0, &[2, 4, 5], &mut budget), [Some(2), Some(4), None]);
        assert_eq!(s.rings(0, &[4], &mut 2), [None]);
    }
}
