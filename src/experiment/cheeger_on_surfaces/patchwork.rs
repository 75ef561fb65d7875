//! Triangles glued along their sides, each with coordinates in its own plane: surfaces in space, and flat tori that have no
//! place there.

use std::f64::consts::TAU;

use crate::domain::{Surface, geometry};
use crate::linalg::Csr;
use crate::linalg::spectrum::{SpectrumError, lowest};

/// A triangulated surface with a flat metric on each triangle.
pub struct Patchwork {
    /// Where the vertices are: in space, or in one copy of a torus.
    pub positions: Vec<[f64; 3]>,
    /// The triangles, by vertices.
    pub faces: Vec<[usize; 3]>,
    /// The corners of each triangle in its plane, the first one at the origin.
    pub corners: Vec<[[f64; 2]; 3]>,
    /// Whether a vertex lies on the boundary.
    pub boundary: Vec<bool>,
}

/// What is prescribed on the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// There is none.
    Closed,
    /// Nothing: the natural condition.
    Free,
    /// The function vanishes there.
    Fixed,
}

/// The eigenfunctions of one eigenvalue, the smallest one above zero.
pub struct Modes {
    /// Its copies, ascending.
    pub values: Vec<f64>,
    /// Each is within so much of an eigenvalue of the exact matrices.
    pub error: f64,
    /// Whether an inertia count proves that no smaller one is missing.
    pub certified: bool,
    /// Values at the vertices, of mass one.
    pub vectors: Vec<Vec<f64>>,
}

impl Patchwork {
    /// A triangulated surface in space; `None` where a face is not a triangle.
    pub fn of(surface: &Surface, boundary: &[bool]) -> Option<Self> {
        let faces: Vec<[usize; 3]> = (0..surface.faces().len()).map(|f| surface.triangle(f)).collect::<Option<_>>()?;
        let plane = |f: &[usize; 3]| {
            let [p, q, r] = f.map(|v| surface.point(v));
            let (u, v) = (q - p, r - p);
            let length = u.norm();
            [[0.0, 0.0], [length, 0.0], [u.dot(&v) / length, geometry::doubled_area_in_space(p, q, r) / length]]
        };
        let corners = faces.iter().map(plane).collect();
        Some(Patchwork { positions: surface.positions().to_vec(), faces, corners, boundary: boundary.to_vec() })
    }

    /// The parallelogram with the sides u and v in `cells` equal cells, two triangles each; opposite sides are glued if it is
    /// periodic.
    pub fn parallelogram([u, v]: [[f64; 2]; 2], [across, up]: [usize; 2], periodic: bool) -> Self {
        let [columns, rows] = if periodic { [across, up] } else { [across + 1, up + 1] };
        let vertex = |i: usize, j: usize| (j % rows) * columns + i % columns;
        let at = |i: usize, j: usize| {
            let (s, t) = (i as f64 / across as f64, j as f64 / up as f64);
            [s * u[0] + t * v[0], s * u[1] + t * v[1]]
        };
        let cell =
            |(i, j): (usize, usize)| [[(i, j), (i + 1, j), (i + 1, j + 1)], [(i, j), (i + 1, j + 1), (i, j + 1)]];
        let triangles: Vec<_> = (0..up).flat_map(|j| (0..across).map(move |i| (i, j))).flat_map(cell).collect();
        let faces = triangles.iter().map(|t| t.map(|(i, j)| vertex(i, j))).collect();
        let corners = triangles.iter().map(|t| from_the_first(t.map(|(i, j)| at(i, j)))).collect();
        let places = || (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
        let is_outside = |(i, j)| !periodic && (i == 0 || j == 0 || i == across || j == up);
        let positions = places().map(|(i, j)| at(i, j)).map(|[x, y]| [x, y, 0.0]).collect();
        Patchwork { positions, faces, corners, boundary: places().map(is_outside).collect() }
    }

    /// The triangle with the corners 0, u and v in n² equal ones.
    pub fn triangle([u, v]: [[f64; 2]; 2], n: usize) -> Self {
        let vertex = |i: usize, j: usize| j * (n + 1) - j * j.saturating_sub(1) / 2 + i;
        let at = |i: usize, j: usize| {
            let (s, t) = (i as f64 / n as f64, j as f64 / n as f64);
            [s * u[0] + t * v[0], s * u[1] + t * v[1]]
        };
        let places = || (0..=n).flat_map(move |j| (0..=n - j).map(move |i| (i, j)));
        let mut triangles = Vec::with_capacity(n * n);
        for (i, j) in places().filter(|(i, j)| i + j < n) {
            triangles.push([(i, j), (i + 1, j), (i, j + 1)]);
            if i + j + 1 < n {
                triangles.push([(i + 1, j), (i + 1, j + 1), (i, j + 1)]);
            }
        }
        let faces = triangles.iter().map(|t| t.map(|(i, j)| vertex(i, j))).collect();
        let corners = triangles.iter().map(|t| from_the_first(t.map(|(i, j)| at(i, j)))).collect();
        let positions = places().map(|(i, j)| at(i, j)).map(|[x, y]| [x, y, 0.0]).collect();
        let boundary = places().map(|(i, j)| i == 0 || j == 0 || i + j == n).collect();
        Patchwork { positions, faces, corners, boundary }
    }

    /// The area of a triangle.
    pub fn area(&self, face: usize) -> f64 {
        let [_, p, q] = self.corners[face];
        0.5 * (p[0] * q[1] - p[1] * q[0]).abs()
    }

    /// The area of all of them.
    pub fn total(&self) -> f64 {
        (0..self.faces.len()).map(|f| self.area(f)).sum()
    }

    /// The side of a square of the mean area of a triangle.
    pub fn size(&self) -> f64 {
        (self.total() / self.faces.len() as f64).sqrt()
    }

    /// Stiffness and mass of linear elements: `L_ij = −½ Σ cot`, `M_ij` a twelfth of the areas beside the edge, twice that on the
    /// diagonal.
    pub fn matrices(&self) -> [Csr; 2] {
        let n = self.positions.len();
        let (mut stiffness, mut mass) = (Vec::new(), Vec::new());
        for (f, (face, corners)) in self.faces.iter().zip(&self.corners).enumerate() {
            let area = self.area(f);
            for k in 0..3 {
                let [i, j] = [face[(k + 1) % 3], face[(k + 2) % 3]];
                let [a, p, q] = [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]];
                let (u, v) = ([p[0] - a[0], p[1] - a[1]], [q[0] - a[0], q[1] - a[1]]);
                // The cotangent at corner k is the dot product over the doubled area.
                let half = 0.25 * (u[0] * v[0] + u[1] * v[1]) / area;
                stiffness.extend([(i, i, half), (j, j, half), (i, j, -half), (j, i, -half)]);
                mass.extend([(face[k], face[k], area / 6.0), (i, j, area / 12.0), (j, i, area / 12.0)]);
            }
        }
        [Csr::from_triplets(n, n, &stiffness), Csr::from_triplets(n, n, &mass)]
    }

    /// The eigenfunctions of the smallest eigenvalue above zero, which has `copies`.
    ///
    /// # Errors
    /// What the eigensolver reports.
    pub fn modes(&self, boundary: Boundary, copies: usize) -> Result<Modes, SpectrumError> {
        let [stiffness, mass] = self.matrices();
        let n = self.positions.len();
        let free: Vec<usize> = (0..n).filter(|&v| boundary != Boundary::Fixed || !self.boundary[v]).collect();
        let [l, m] = [&stiffness, &mass].map(|a| a.submatrix(&free, &free));
        let first = usize::from(boundary != Boundary::Fixed);
        let spectrum = lowest(&l, &m, first + copies, 0)?;
        let residuals: f64 = spectrum.residuals.iter().map(|r| r * r).sum();
        // M ≥ ¼ diag(M). An entry is a sum of a few terms of a few roundings each: so much can its row move an eigenvalue.
        let scale = l.row_scales().iter().enumerate().map(|(i, s)| 4.0 * s / m.at(i, i)).fold(0.0, f64::max);
        let error = 2.0 * (2.0 * residuals).sqrt() + 32.0 * f64::EPSILON * scale;
        let extended = |j: usize| {
            let mut u = vec![0.0; n];
            free.iter().zip(spectrum.vector(j)).for_each(|(&v, x)| u[v] = *x);
            let sign = if u.iter().sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
            u.iter().map(|x| sign * x).collect::<Vec<f64>>()
        };
        Ok(Modes {
            values: spectrum.values[first..first + copies].to_vec(),
            error,
            certified: spectrum.closure.certified,
            vectors: (first..first + copies).map(extended).collect(),
        })
    }

    /// The function among the modes that is nearest to a given one in the mass.
    pub fn nearest(&self, modes: &Modes, guide: impl Fn([f64; 3]) -> f64) -> Vec<f64> {
        let [_, mass] = self.matrices();
        let wanted: Vec<f64> = self.positions.iter().map(|p| guide(*p)).collect();
        let weighted = mass.mul(&wanted);
        let share = |u: &Vec<f64>| u.iter().zip(&weighted).map(|(a, b)| a * b).sum::<f64>();
        let shares: Vec<f64> = modes.vectors.iter().map(share).collect();
        (0..wanted.len()).map(|v| modes.vectors.iter().zip(&shares).map(|(u, s)| s * u[v]).sum()).collect()
    }

    /// The smallest distance of the plane of a triangle from the origin.
    pub fn inradius(&self) -> f64 {
        let at = |v: usize| geometry::Vec3::from(self.positions[v]);
        let distance = |f: &[usize; 3]| {
            let [p, q, r] = f.map(at);
            let normal = (q - p).cross(&(r - p));
            (normal.dot(&p) / normal.norm()).abs()
        };
        self.faces.iter().map(distance).fold(f64::INFINITY, f64::min)
    }

    /// Half the angle at the centre of a side of a regular polygon with as many sides as there are vertices on the boundary.
    pub fn half_angle(&self) -> f64 {
        0.5 * TAU / self.boundary.iter().filter(|b| **b).count() as f64
    }
}

fn from_the_first(points: [[f64; 2]; 3]) -> [[f64; 2]; 3] {
    points.map(|p| [p[0] - points[0][0], p[1] - points[0][1]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Domain;
    use std::collections::BTreeMap;

    fn generated(id: &str, level: &str) -> Domain {
        let given = BTreeMap::from([("levels".to_string(), level.to_string())]);
        crate::generate::find(id).unwrap().run(None, &given, 0).unwrap()
    }

    #[test]
    fn its_matrices_are_those_of_the_catalogue() {
        for id in ["icosphere", "disk", "flat-torus", "dumbbell"] {
            let domain = generated(id, "1");
            let given = BTreeMap::from([("mass".to_string(), "consistent".to_string())]);
            let operator = crate::laplacian::find("cotan").unwrap().build(&domain, &given).unwrap();
            let [l, m] = Patchwork::of(domain.as_surface().unwrap(), domain.boundary()).unwrap().matrices();
            for (ours, theirs) in [(l, operator.stiffness()), (m, operator.mass().unwrap().matrix())] {
                let scales = theirs.row_scales();
                let same = |(i, j, v): (usize, usize, &f64)| (v - theirs.at(i, j)).abs() < 1e-13 * scales[i];
                assert!(ours.entries().all(same), "{id}");
            }
        }
    }

    #[test]
    fn a_parallelogram_and_a_triangle_have_their_areas_and_boundaries() {
        let u = [[2.0, 0.0], [0.5, 1.0]];
        let open = Patchwork::parallelogram(u, [6, 4], false);
        let closed = Patchwork::parallelogram(u, [6, 4], true);
        let triangle = Patchwork::triangle(u, 5);
        for (patchwork, vertices, faces, boundary, area) in
            [(&open, 35, 48, 20, 2.0), (&closed, 24, 48, 0, 2.0), (&triangle, 21, 25, 15, 1.0)]
        {
            assert_eq!((patchwork.positions.len(), patchwork.faces.len()), (vertices, faces));
            assert_eq!(patchwork.boundary.iter().filter(|b| **b).count(), boundary);
            assert!((patchwork.total() - area).abs() < 1e-14);
            // Every side that is not on the boundary belongs to two triangles.
            let mut sides = BTreeMap::<[usize; 2], usize>::new();
            for f in &patchwork.faces {
                (0..3)
                    .for_each(|k| *sides.entry([f[k].min(f[(k + 1) % 3]), f[k].max(f[(k + 1) % 3])]).or_default() += 1);
            }
            assert_eq!(sides.values().filter(|c| **c == 1).count(), boundary);
            assert!(sides.values().all(|c| *c <= 2));
        }
    }

    #[test]
    fn the_modes_of_the_unit_square_are_near_their_closed_forms() {
        let square = Patchwork::parallelogram([[1.0, 0.0], [0.0, 1.0]], [12, 12], false);
        let pi2 = std::f64::consts::PI.powi(2);
        for (boundary, copies, exact) in [(Boundary::Free, 2, pi2), (Boundary::Fixed, 1, 2.0 * pi2)] {
            let modes = square.modes(boundary, copies).unwrap();
            assert!(modes.certified && modes.error < 1e-6, "{}", modes.error);
            assert!(modes.values.iter().all(|v| *v > exact && *v < 1.05 * exact), "{:?}", modes.values);
        }
        let free = square.modes(Boundary::Free, 2).unwrap();
        let along = square.nearest(&free, |p| (std::f64::consts::PI * p[0]).cos());
        let error = along.iter().zip(&square.positions).map(|(u, p)| (u - (std::f64::consts::PI * p[0]).cos()).abs());
        assert!(error.fold(0.0, f64::max) < 0.05);
    }
}
