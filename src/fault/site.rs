//! Where a fault is planted: an operator on its domain, and the ways to change it.

use std::collections::BTreeMap;

use crate::domain::geometry::{self, Vec3};
use crate::domain::{Domain, Surface};
use crate::linalg::Csr;
use crate::operator::{Mass, MassKind, Operator};
use crate::stream::Stream;

/// What every fault of the wrong kind of domain answers.
const NOT_TRIANGLES: &str = "the domain is no triangle mesh with a proper triangle";

/// An operator on its domain, about to be spoilt.
pub struct Site<'a> {
    /// The domain.
    pub domain: &'a Domain,
    /// The correct operator.
    pub operator: &'a Operator,
}

/// A proper triangle of the mesh.
#[derive(Clone, Copy)]
pub(super) struct Triangle {
    /// Its vertices.
    pub corners: [usize; 3],
    /// Where they are.
    pub points: [Vec3; 3],
    /// The cotangents at them.
    pub cotangents: [f64; 3],
}

impl Triangle {
    /// A triangle; `None` if its corners lie on a line.
    pub fn of(positions: &[[f64; 3]], corners: [usize; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(|v| positions[v]);
        let points = [a, b, c].map(Vec3::from);
        let cotangent = |k: usize| geometry::cotangent(points[k], points[(k + 1) % 3], points[(k + 2) % 3]);
        (!geometry::collinear(a, b, c)).then(|| Triangle { corners, points, cotangents: [0, 1, 2].map(cotangent) })
    }

    /// The ends of the side opposite a corner.
    pub fn side(&self, corner: usize) -> [usize; 2] {
        [self.corners[(corner + 1) % 3], self.corners[(corner + 2) % 3]]
    }

    /// The squared length of the side opposite a corner.
    pub fn squared_length(&self, corner: usize) -> f64 {
        (self.points[(corner + 2) % 3] - self.points[(corner + 1) % 3]).norm_squared()
    }

    /// The angle at a corner, in radians.
    pub fn angle(&self, corner: usize) -> f64 {
        geometry::angle(self.points[corner], self.points[(corner + 1) % 3], self.points[(corner + 2) % 3])
    }

    /// The area.
    pub fn area(&self) -> f64 {
        let longest = (1..3).fold(0, |k, c| if self.squared_length(c) > self.squared_length(k) { c } else { k });
        let at = |k: usize| self.points[(longest + k) % 3];
        0.5 * geometry::doubled_area_in_space(at(0), at(1), at(2))
    }

    /// What it contributes to the cotangent weights: `½ cot` to the side opposite each corner.
    pub fn weights(&self) -> [Weight; 3] {
        [0, 1, 2].map(|c| (self.side(c), 0.5 * self.cotangents[c]))
    }
}

/// A contribution to the weight of an edge.
pub(super) type Weight = ([usize; 2], f64);

impl<'a> Site<'a> {
    /// An operator on its domain.
    pub fn new(domain: &'a Domain, operator: &'a Operator) -> Self {
        Site { domain, operator }
    }

    /// The stiffness matrix.
    pub fn stiffness(&self) -> &'a Csr {
        self.operator.stiffness()
    }

    /// The number of vertices.
    pub fn size(&self) -> usize {
        self.operator.size()
    }

    /// The triangle mesh that the domain is.
    pub(super) fn surface(&self) -> Result<&'a Surface, &'static str> {
        self.domain.as_surface().filter(|s| s.is_triangulated() && !s.faces().is_empty()).ok_or(NOT_TRIANGLES)
    }

    /// The proper triangles, at least one.
    pub(super) fn triangles(&self) -> Result<Vec<Triangle>, &'static str> {
        let surface = self.surface()?;
        self.triangles_at(surface.positions())
    }

    /// The same with their corners elsewhere; those that are degenerate there are left out.
    pub(super) fn triangles_at(&self, positions: &[[f64; 3]]) -> Result<Vec<Triangle>, &'static str> {
        let surface = self.surface()?;
        let faces = (0..surface.faces().len()).filter_map(|f| surface.triangle(f));
        let triangles: Vec<Triangle> = faces.filter_map(|corners| Triangle::of(positions, corners)).collect();
        if triangles.is_empty() { Err(NOT_TRIANGLES) } else { Ok(triangles) }
    }

    /// The pairs i < j with a weight in both directions.
    pub(super) fn edges(&self) -> Vec<[usize; 2]> {
        let l = self.stiffness();
        let both = |&(i, j, v): &(usize, usize, &f64)| i < j && *v != 0.0 && l.at(j, i) != 0.0;
        l.entries().filter(both).map(|(i, j, _)| [i, j]).collect()
    }

    /// A pair whose weight counts in both its rows: drawn from the quarter of the pairs with the largest share.
    pub(super) fn heavy_edge(&self, stream: &mut Stream) -> Result<[usize; 2], &'static str> {
        let (l, scales) = (self.stiffness(), self.stiffness().row_scales());
        let share = |&[i, j]: &[usize; 2]| l.at(i, j).abs() / scales[i].max(scales[j]);
        let mut edges = self.edges();
        edges.sort_by(|a, b| share(b).total_cmp(&share(a)).then(a.cmp(b)));
        edges.truncate(edges.len().div_ceil(4));
        pick(&edges, stream).ok_or("the matrix has no weight")
    }

    /// A vertex with a row that is not zero.
    pub(super) fn live_row(&self, stream: &mut Stream) -> Result<usize, &'static str> {
        let scales = self.stiffness().row_scales();
        let rows: Vec<usize> = (0..self.size()).filter(|&i| scales[i] > 0.0).collect();
        pick(&rows, stream).ok_or("the matrix has no row that is not zero")
    }

    /// Two vertices that the operator joins over a third, and not directly; `near` if no more than two rings apart, else any
    /// two that it does not join.
    pub(super) fn strangers(&self, near: bool, stream: &mut Stream) -> Result<[usize; 2], &'static str> {
        let l = self.stiffness();
        let adjacent = |i: usize, j: usize| {
            let edge = [i.min(j), i.max(j)];
            l.get(i, j).is_some() || l.get(j, i).is_some() || self.domain.edges().binary_search(&edge).is_ok()
        };
        let n = self.size();
        for _ in 0..100 {
            let i = stream.below(n);
            let j = match near {
                true => self.neighbour(i, stream).and_then(|k| self.neighbour(k, stream)),
                false => Some(stream.below(n)),
            };
            match j {
                Some(j) if n > 0 && i != j && !adjacent(i, j) => return Ok([i, j]),
                _ => {}
            }
        }
        Err("no two vertices were found that are not joined")
    }

    fn neighbour(&self, i: usize, stream: &mut Stream) -> Option<usize> {
        let row: Vec<usize> =
            (i < self.size()).then(|| self.stiffness().row(i).map(|(j, _)| j).filter(|j| *j != i).collect())?;
        pick(&row, stream)
    }

    /// The operator with another stiffness matrix.
    pub(super) fn with_stiffness(&self, stiffness: Csr) -> Result<Operator, &'static str> {
        let bare =
            Operator::new(stiffness, self.operator.provenance().clone()).map_err(|_| "the matrix is not square")?;
        match self.operator.mass() {
            Some(mass) => bare.with_mass(mass.clone()).map_err(|_| "the mass has another size"),
            None => Ok(bare),
        }
    }

    /// The operator with some entries replaced.
    pub(super) fn with_entries(&self, entries: &[(usize, usize, f64)]) -> Result<Operator, &'static str> {
        self.with_stiffness(replaced(self.stiffness(), entries))
    }

    /// The operator with every stored entry mapped.
    pub(super) fn mapped(&self, f: impl FnMut(usize, usize, &f64) -> f64) -> Result<Operator, &'static str> {
        self.with_stiffness(self.stiffness().map(f))
    }

    /// The operator with what a mistake adds to the matrix of cotangent weights: `L + (mistaken − correct)` where the two sums
    /// over triangles differ, and L where they do not.
    pub(super) fn assembled(
        &self,
        mistaken: impl IntoIterator<Item = Weight>,
        correct: &[Triangle],
    ) -> Result<Operator, &'static str> {
        let mistaken = stiffness(self.size(), mistaken);
        self.with_mistake(&mistaken, &stiffness(self.size(), correct.iter().flat_map(Triangle::weights)))
    }

    /// The same from the two matrices.
    pub(super) fn with_mistake(&self, mistaken: &Csr, correct: &Csr) -> Result<Operator, &'static str> {
        let mut places: BTreeMap<(usize, usize), f64> =
            self.stiffness().entries().map(|(i, j, v)| ((i, j), *v)).collect();
        for (i, j, _) in mistaken.entries().chain(correct.entries()) {
            let (a, b) = (mistaken.at(i, j), correct.at(i, j));
            if a.to_bits() != b.to_bits() && a != b {
                places.insert((i, j), self.stiffness().at(i, j) + (a - b));
            }
        }
        let triplets: Vec<_> = places.into_iter().map(|((i, j), v)| (i, j, v)).collect();
        self.with_stiffness(Csr::from_triplets(self.size(), self.size(), &triplets))
    }

    /// The mass, with its kind.
    pub(super) fn mass(&self) -> Result<&'a Mass, &'static str> {
        self.operator.mass().filter(|m| m.size() > 0).ok_or("there is no mass")
    }

    /// The operator with another mass matrix that passes for the same kind.
    pub(super) fn with_mass(&self, matrix: Csr) -> Result<Operator, &'static str> {
        let kind = self.operator.mass().map_or(MassKind::Given, Mass::kind);
        self.operator.clone().with_mass(Mass::full(kind, matrix)).map_err(|_| "the mass has another size")
    }

    /// Two vertices with clearly different mass.
    pub(super) fn unequal_masses(&self, stream: &mut Stream) -> Result<[usize; 2], &'static str> {
        let mass = self.mass()?.diagonal();
        for _ in 0..100 {
            let (i, j) = (stream.below(mass.len()), stream.below(mass.len()));
            if (mass[i] - mass[j]).abs() > 0.01 * mass[i].abs().max(mass[j].abs()) {
                return Ok([i, j]);
            }
        }
        Err("all vertices have the same mass")
    }

    /// A vertex with mass.
    pub(super) fn heavy_vertex(&self, stream: &mut Stream) -> Result<usize, &'static str> {
        let mass = self.mass()?.diagonal();
        let heavy: Vec<usize> = (0..mass.len()).filter(|&i| mass[i] > 0.0).collect();
        pick(&heavy, stream).ok_or("no vertex has mass")
    }
}

/// An element of a list; `None` of an empty one.
pub(super) fn pick<T: Copy>(list: &[T], stream: &mut Stream) -> Option<T> {
    if list.is_empty() { None } else { Some(list[stream.below(list.len())]) }
}

/// A matrix with some entries replaced, or put in.
pub(super) fn replaced(matrix: &Csr, entries: &[(usize, usize, f64)]) -> Csr {
    let mut places: BTreeMap<(usize, usize), f64> = matrix.entries().map(|(i, j, v)| ((i, j), *v)).collect();
    places.extend(entries.iter().map(|&(i, j, v)| ((i, j), v)));
    let triplets: Vec<_> = places.into_iter().map(|((i, j), v)| (i, j, v)).collect();
    Csr::from_triplets(matrix.rows(), matrix.columns(), &triplets)
}

/// The matrix of some weights: `L_ij = −ω_ij`, rows sum to zero.
pub(super) fn stiffness(n: usize, weights: impl IntoIterator<Item = Weight>) -> Csr {
    let mut sums: BTreeMap<[usize; 2], f64> = BTreeMap::new();
    for ([i, j], w) in weights {
        *sums.entry([i.min(j), i.max(j)]).or_insert(0.0) += w;
    }
    let off_diagonal: Vec<_> =
        sums.into_iter().filter(|([i, j], _)| i != j).flat_map(|([i, j], w)| [(i, j, -w), (j, i, -w)]).collect();
    closed(&Csr::from_triplets(n, n, &off_diagonal))
}

/// The off-diagonal part of a matrix with the diagonal that makes its rows sum to zero.
pub(super) fn closed(matrix: &Csr) -> Csr {
    let mut triplets: Vec<_> = matrix.entries().filter(|(i, j, _)| i != j).map(|(i, j, v)| (i, j, *v)).collect();
    for i in 0..matrix.rows() {
        let sum = matrix.row(i).filter(|(j, _)| *j != i).fold(0.0, |sum, (_, v)| sum - v);
        triplets.push((i, i, sum));
    }
    Csr::from_triplets(matrix.rows(), matrix.columns(), &triplets)
}

/// The masses of a mesh that is shared out triangle by triangle.
pub(super) fn lumped(n: usize, triangles: &[Triangle], share: impl Fn(&Triangle, usize) -> f64) -> Csr {
    let mut diagonal = vec![0.0; n];
    for triangle in triangles {
        (0..3).for_each(|c| diagonal[triangle.corners[c]] += share(triangle, c));
    }
    Csr::diagonal(&diagonal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laplacian;

    #[test]
    fn a_mistake_of_no_consequence_leaves_every_bit() {
        let p = [[0.0, 0.0], [2.0, 0.3], [2.1, 2.0], [0.1, 1.9], [1.0, 0.9]];
        let domain = Domain::from(Surface::planar(&p, &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]).unwrap());
        let operator = laplacian::find("cotan").unwrap().build(&domain, &Default::default()).unwrap();
        let site = Site::new(&domain, &operator);
        let triangles = site.triangles().unwrap();
        let again = site.assembled(triangles.iter().flat_map(Triangle::weights), &triangles).unwrap();
        assert_eq!(again.stiffness(), operator.stiffness());
        // Our own sum over triangles is the cotangent Laplacian, to rounding.
        let own = stiffness(5, triangles.iter().flat_map(Triangle::weights));
        assert!(own.entries().all(|(i, j, v)| (v - operator.stiffness().at(i, j)).abs() < 1e-14));
        let areas = lumped(5, &triangles, |t, _| t.area() / 3.0);
        let mass = operator.mass().unwrap().matrix();
        assert!(areas.entries().all(|(i, j, v)| (v - mass.at(i, j)).abs() < 1e-15));
    }
}
