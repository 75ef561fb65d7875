//! The meshes of the table, the operator that is spoilt on them, and their condition, computed a second way.

use std::collections::BTreeSet;

use lapjury::domain::{Domain, Surface};
use lapjury::laplacian;
use lapjury::linalg::Csr;
use lapjury::operator::{Mass, MassKind, Operator, Provenance};
use lapjury::property::{self, Status, Trial};

pub const U: f64 = f64::EPSILON / 2.0;

/// A mesh with the cotangent Laplacian and the barycentric mass on it, as matrices of unknown origin.
pub struct World {
    pub name: &'static str,
    pub surface: Surface,
    pub domain: Domain,
    pub l: Csr,
    pub mass: Vec<f64>,
    /// The vertex where defects are planted: the interior vertex nearest the middle.
    pub c: usize,
    /// Its neighbour with the largest weight.
    pub j: usize,
    /// An edge of the boundary with the largest weight, of those the nearest.
    pub rim: Option<[usize; 2]>,
    /// Q of each vertex: the largest `1/sin θ` at its triangles.
    pub q: Vec<f64>,
}

impl World {
    fn of(name: &'static str, surface: Surface) -> Self {
        let domain = Domain::from(surface.clone());
        let built = laplacian::find("cotan").unwrap().build(&domain, &Default::default()).unwrap();
        let (l, mass) = (built.stiffness().clone(), built.mass().unwrap().diagonal());
        let n = l.rows();
        let at = |v: usize| surface.positions()[v];
        let middle: [f64; 3] = std::array::from_fn(|k| (0..n).map(|v| at(v)[k]).sum::<f64>() / n as f64);
        let interior = domain.interior();
        let c = *interior.iter().min_by(|a, b| far(at(**a), middle).total_cmp(&far(at(**b), middle))).unwrap();
        let weight = |i: usize, j: usize| -l.at(i, j);
        let neighbours = || l.row(c).map(|(j, _)| j).filter(|&j| j != c);
        let j = neighbours().max_by(|&a, &b| weight(c, a).total_cmp(&weight(c, b))).unwrap();
        let topology = surface.topology();
        let edges = topology.edges().iter().enumerate().filter(|(e, _)| topology.is_boundary_edge(*e));
        let rims: Vec<[usize; 2]> = edges.map(|(_, e)| *e).collect();
        let strongest = rims.iter().map(|e| weight(e[0], e[1])).fold(0.0, f64::max);
        let strong = rims.into_iter().filter(|e| weight(e[0], e[1]) > 0.99 * strongest);
        let rim = strong.min_by(|a, b| far(at(a[0]), at(c)).total_cmp(&far(at(b[0]), at(c))));
        let mut q = vec![1.0_f64; n];
        for f in surface.faces() {
            let worst =
                (0..3).map(|k| 1.0 / sine(at(f[k]), at(f[(k + 1) % 3]), at(f[(k + 2) % 3]))).fold(1.0, f64::max);
            f.iter().for_each(|&v| q[v] = q[v].max(worst));
        }
        World { name, domain, l, mass, c, j, rim, q, surface }
    }

    /// The icosphere with 162 vertices; closed.
    pub fn icosphere() -> Self {
        let domain = "icosphere:levels=2".parse::<lapjury::Recipe>().unwrap().build(std::path::Path::new(".")).unwrap();
        World::of("icosphere", domain.as_surface().unwrap().clone())
    }

    /// Seven rows of seven vertices: isosceles triangles of height 1 that are all acute, their apex the smallest angle.
    pub fn slivers(name: &'static str, apex_deg: f64) -> Self {
        let base = 2.0 * (apex_deg.to_radians() / 2.0).tan();
        let side = 7;
        let shift = |row: usize| if row % 2 == 1 { 0.5 } else { 0.0 };
        let points: Vec<[f64; 2]> =
            (0..side * side).map(|k| [base * ((k % side) as f64 + shift(k / side)), (k / side) as f64]).collect();
        let mut triangles = Vec::new();
        for (row, k) in (0..side - 1).flat_map(|row| (0..side - 1).map(move |k| (row, k))) {
            let [a, b] = [row * side + k, row * side + k + 1];
            let [d, e] = [a + side, b + side];
            triangles.extend(if row % 2 == 0 { [[a, b, d], [b, e, d]] } else { [[a, b, e], [a, e, d]] });
        }
        World::of(name, Surface::planar(&points, &triangles).unwrap())
    }

    /// The same with all faces at a vertex removed but two beside each other, so that it has one neighbour in the interior.
    pub fn opened(&self) -> (Self, usize) {
        let topology = self.surface.topology();
        let b = self.j;
        let star: BTreeSet<usize> = topology.star(b).iter().map(|s| s.0).collect();
        let c = self.c;
        let kept = |f: &usize| !star.contains(f) || self.surface.faces()[*f].contains(&c);
        let faces: Vec<[usize; 3]> =
            (0..self.surface.faces().len()).filter(kept).map(|f| self.surface.triangle(f).unwrap()).collect();
        let surface = Surface::triangles(self.surface.positions().to_vec(), &faces).unwrap();
        (World { c, j: b, ..World::of(self.name, surface) }, b)
    }

    /// `s_i = Σ_k |L_ik|`.
    pub fn s(&self, i: usize) -> f64 {
        self.l.row(i).map(|(_, v)| v.abs()).sum()
    }

    /// `4m + 32Q` and `4 (4m + 32Q²)` in units of u, capped as the page says.
    pub fn factors(&self, m: usize, q: f64) -> [f64; 2] {
        let (m, explained) = (4.0 * m as f64, 4.0 * m as f64 + 32.0 * q);
        let explained = (explained * U).min(1.0 / 1_048_576.0);
        [explained, (4.0 * (m + 32.0 * q * q) * U).max(explained)]
    }

    /// The factors of row i with its own Q.
    pub fn row(&self, i: usize) -> [f64; 2] {
        self.factors(self.l.row(i).len(), self.q[i])
    }

    /// The factors of row i with the worst Q of its neighbours.
    pub fn coupled(&self, i: usize) -> [f64; 2] {
        self.factors(self.l.row(i).len(), self.l.row(i).map(|(j, _)| self.q[j]).fold(1.0, f64::max))
    }

    /// `u (4 |w| + 4 ρ)` for the edge ij of a cotangent matrix, times `4 Q_ij` for the second, over s_i: ρ the sum of `1/sin²` opposite.
    pub fn edge(&self, [i, j]: [usize; 2], weight: f64) -> [f64; 2] {
        let edge = self.surface.topology().edge_between(i, j).unwrap();
        let at = |v: usize| self.surface.positions()[v];
        let rho: f64 = self.surface.opposite(edge).iter().map(|(_, v)| sine(at(*v), at(i), at(j)).powi(-2)).sum();
        let of_faces = self.surface.topology().star(i).iter().map(|s| &self.surface.faces()[s.0]);
        let near = of_faces.filter(|f| f.contains(&j));
        let sines = near.flat_map(|f| (0..3).map(move |k| [f[k], f[(k + 1) % 3], f[(k + 2) % 3]]));
        let q = sines.map(|[a, b, c]| 1.0 / sine(at(a), at(b), at(c))).fold(1.0, f64::max);
        let (s, bound) = (self.s(i), 4.0 * U * (weight.abs() + rho));
        [(bound / s).min(1.0 / 1_048_576.0), 4.0 * q * bound / s]
    }

    /// The operator with these changes added to L: the entry and its size.
    pub fn changed(&self, changes: &[(usize, usize, f64)]) -> Operator {
        self.given(self.l.add(&Csr::from_triplets(self.l.rows(), self.l.rows(), changes)))
    }

    /// A matrix with the mass, both from nowhere.
    pub fn given(&self, l: Csr) -> Operator {
        let plain = Operator::new(l, Provenance::default()).unwrap();
        plain.with_mass(Mass::lumped(MassKind::Barycentric, &self.mass)).unwrap()
    }

    /// The weight of the edge ij set to `w` on both sides, row sums kept.
    pub fn with_weight(&self, [i, j]: [usize; 2], w: f64) -> Operator {
        self.reweighted(|a, b, v| if [a, b] == [i, j] || [a, b] == [j, i] { -w } else { v })
    }

    /// With other entries off the diagonal, which becomes minus their sum.
    pub fn reweighted(&self, entry: impl Fn(usize, usize, f64) -> f64) -> Operator {
        let off = |i: usize| self.l.row(i).filter(move |&(j, _)| j != i).map(|(j, v)| entry(i, j, *v)).sum::<f64>();
        let diagonal: Vec<f64> = (0..self.l.rows()).map(|i| -off(i)).collect();
        self.given(self.l.map(|i, j, v| if i == j { diagonal[i] } else { entry(i, j, *v) }))
    }

    /// What is left of `s_i` when the weight of the edge ij is taken out.
    pub fn rest(&self, [i, j]: [usize; 2]) -> f64 {
        self.with_weight([i, j], 0.0).stiffness().row_scales()[i] / self.s(i)
    }

    pub fn judge(&self, id: &str, operator: &Operator) -> Status {
        let trial = Trial::new(&self.domain, operator, 5).unwrap();
        property::find(id).unwrap().decide(&trial, None).status()
    }
}

fn far(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

/// The distance of two vertices.
pub fn length(world: &World, i: usize, j: usize) -> f64 {
    far(world.surface.positions()[i], world.surface.positions()[j])
}

/// The sine of the angle at `a` in the triangle abc.
fn sine(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    let minus = |p: [f64; 3]| -> [f64; 3] { std::array::from_fn(|k| p[k] - a[k]) };
    let ([x, y, z], [p, q, r]) = (minus(b), minus(c));
    let cross = [y * r - z * q, z * p - x * r, x * q - y * p];
    let norm = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    norm(cross) / norm([x, y, z]) / norm([p, q, r])
}
