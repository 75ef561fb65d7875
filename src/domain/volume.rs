//! Tetrahedral meshes.

use std::collections::BTreeMap;

use super::{DomainError, check_coordinates, check_corners};

/// A tetrahedral mesh in space.
#[derive(Clone, Debug)]
pub struct Volume {
    positions: Vec<[f64; 3]>,
    tetrahedra: Vec<[usize; 4]>,
    edges: Vec<[usize; 2]>,
    boundary_triangles: Vec<[usize; 3]>,
    boundary: Vec<bool>,
}

impl Volume {
    /// Validates positions and tetrahedra, finds edges and boundary. Cost: O(T log T).
    ///
    /// # Errors
    /// A coordinate that is not finite, an index out of range or repeated.
    pub fn new(positions: Vec<[f64; 3]>, tetrahedra: Vec<[usize; 4]>) -> Result<Self, DomainError> {
        check_coordinates(&positions)?;
        let mut edges = Vec::new();
        let mut triangles: BTreeMap<[usize; 3], usize> = BTreeMap::new();
        for (index, tet) in tetrahedra.iter().enumerate() {
            check_corners("tetrahedron", index, tet, positions.len())?;
            let mut t = *tet;
            t.sort_unstable();
            for a in 0..4 {
                edges.extend((a + 1..4).map(|b| [t[a], t[b]]));
            }
            for skip in 0..4 {
                let face: Vec<usize> = (0..4).filter(|&k| k != skip).map(|k| t[k]).collect();
                *triangles.entry([face[0], face[1], face[2]]).or_default() += 1;
            }
        }
        edges.sort_unstable();
        edges.dedup();
        let boundary_triangles: Vec<_> = triangles.into_iter().filter(|&(_, n)| n == 1).map(|(t, _)| t).collect();
        let mut boundary = vec![false; positions.len()];
        boundary_triangles.iter().flatten().for_each(|&v| boundary[v] = true);
        Ok(Volume { positions, tetrahedra, edges, boundary_triangles, boundary })
    }

    /// The coordinates.
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// The tetrahedra, as given.
    pub fn tetrahedra(&self) -> &[[usize; 4]] {
        &self.tetrahedra
    }

    /// The edges as `[smaller, larger]`, in lexicographic order.
    pub fn edges(&self) -> &[[usize; 2]] {
        &self.edges
    }

    /// The triangles that belong to one tetrahedron only, corners ascending.
    pub fn boundary_triangles(&self) -> &[[usize; 3]] {
        &self.boundary_triangles
    }

    /// For each vertex, whether it is a corner of a boundary triangle.
    pub fn boundary(&self) -> &[bool] {
        &self.boundary
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_tetrahedra_share_a_triangle_and_have_six_boundary_ones() {
        let p = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
        let v = Volume::new(p, vec![[0, 1, 2, 3], [4, 1, 2, 3]]).unwrap();
        assert_eq!((v.edges().len(), v.boundary_triangles().len()), (9, 6));
        assert!(v.boundary().iter().all(|&b| b));
    }
}
