//! Meshes and matrices to try properties on: small, written out, or from a fixed stream of numbers.

use lapjury::domain::{Domain, Surface};
use lapjury::linalg::Csr;

/// A fixed stream of numbers in [0, 1): a linear congruential generator with Knuth's constants.
pub struct Numbers(pub u64);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn below(&mut self, n: usize) -> usize {
        ((self.next() * n as f64) as usize).min(n - 1)
    }
}

/// Triangles over planar points.
pub fn planar(points: &[[f64; 2]], triangles: &[[usize; 3]]) -> Surface {
    Surface::planar(points, triangles).unwrap()
}

/// The unit square with a diagonal: a cocircular pair.
pub fn square() -> Surface {
    planar(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], &[[0, 1, 2], [0, 2, 3]])
}

/// Two triangles over the edge 01 with angles above 90° opposite: `ω_01 = cot 2·atan(1/h)`, negative for h < 1.
pub fn obtuse_pair(h: f64) -> Surface {
    planar(&[[-1.0, 0.0], [1.0, 0.0], [0.0, h], [0.0, -h]], &[[0, 1, 2], [1, 0, 3]])
}

/// A centre (vertex 0) with `n` neighbours on the unit circle, moved outward by `radius(k)`.
pub fn star(n: usize, radius: impl Fn(usize) -> f64) -> Surface {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / n as f64;
    let ring = (0..n).map(|k| [radius(k) * angle(k).cos(), radius(k) * angle(k).sin()]);
    let points: Vec<[f64; 2]> = std::iter::once([0.0, 0.0]).chain(ring).collect();
    let triangles: Vec<[usize; 3]> = (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % n]).collect();
    planar(&points, &triangles)
}

/// An n×n grid of squares of side 1/n, each with one diagonal, the inner vertices moved by up to `jitter` sides.
pub fn grid(n: usize, jitter: f64, seed: u64) -> (Vec<[f64; 2]>, Vec<[usize; 3]>) {
    let mut numbers = Numbers(seed);
    let mut points = Vec::new();
    for y in 0..=n {
        for x in 0..=n {
            let inner = x > 0 && y > 0 && x < n && y < n;
            let mut move_by = || if inner { jitter * (2.0 * numbers.next() - 1.0) } else { 0.0 };
            points.push([(x as f64 + move_by()) / n as f64, (y as f64 + move_by()) / n as f64]);
        }
    }
    let at = |x: usize, y: usize| y * (n + 1) + x;
    let mut triangles = Vec::new();
    for y in 0..n {
        for x in 0..n {
            let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
            triangles.extend(if (x + y) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
        }
    }
    (points, triangles)
}

/// [`grid`] as a surface.
pub fn grid_surface(n: usize, jitter: f64, seed: u64) -> Surface {
    let (points, triangles) = grid(n, jitter, seed);
    planar(&points, &triangles)
}

/// The unit cube, each side split by one diagonal.
pub fn cube() -> Surface {
    let p = (0..8).map(|k| [f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2 & 1)]).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[usize; 3]> = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Surface::triangles(p, &triangles).unwrap()
}

/// The graph of a smooth function over a jittered grid: a curved surface with boundary.
pub fn hills(n: usize, seed: u64) -> Surface {
    let (points, triangles) = grid(n, 0.2, seed);
    let lift = |&[x, y]: &[f64; 2]| [x, y, 0.3 * (5.0 * x).sin() * (4.0 * y).cos()];
    Surface::triangles(points.iter().map(lift).collect(), &triangles).unwrap()
}

/// How the cotangent of an angle is computed.
#[derive(Clone, Copy)]
pub enum Cotangents {
    /// `dot / |cross|` of edge vectors.
    Coordinates,
    /// From edge lengths with Heron's formula as it stands: the worst that is still correct.
    Lengths,
}

/// The cotangents at the corners of a triangle.
pub fn cotangents(p: [[f64; 3]; 3], how: Cotangents) -> [f64; 3] {
    let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let norm = |a: [f64; 3]| dot(a, a).sqrt();
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    match how {
        Cotangents::Coordinates => [0, 1, 2].map(|k| {
            let scaled = |a: [f64; 3]| a.map(|x| x / a.iter().fold(0.0_f64, |m, x| m.max(x.abs())));
            let (u, v) = (scaled(minus(p[(k + 1) % 3], p[k])), scaled(minus(p[(k + 2) % 3], p[k])));
            dot(u, v) / norm(cross(u, v))
        }),
        Cotangents::Lengths => {
            let l = [0, 1, 2].map(|k| norm(minus(p[(k + 1) % 3], p[(k + 2) % 3])));
            let s = 0.5 * (l[0] + l[1] + l[2]);
            let area = (s * (s - l[0]) * (s - l[1]) * (s - l[2])).sqrt();
            [0, 1, 2].map(|k| {
                let (a, b, c) = (l[k], l[(k + 1) % 3], l[(k + 2) % 3]);
                (b * b + c * c - a * a) / (4.0 * area)
            })
        }
    }
}

/// The cotangent Laplacian, its triangles added up in the order given.
pub fn cotan_in_order(surface: &Surface, how: Cotangents, order: &[usize]) -> Csr {
    let mut triplets = Vec::new();
    for &f in order {
        let t = surface.triangle(f).unwrap();
        let cot = cotangents(t.map(|v| surface.positions()[v]), how);
        for k in 0..3 {
            let (i, j, w) = (t[(k + 1) % 3], t[(k + 2) % 3], 0.5 * cot[k]);
            triplets.extend([(i, j, -w), (j, i, -w), (i, i, w), (j, j, w)]);
        }
    }
    let n = surface.positions().len();
    Csr::from_triplets(n, n, &triplets)
}

/// The cotangent Laplacian from coordinates.
pub fn cotan(surface: &Surface) -> Csr {
    let order: Vec<usize> = (0..surface.faces().len()).collect();
    cotan_in_order(surface, Cotangents::Coordinates, &order)
}

/// The Laplacian of the edges with unit weights.
pub fn combinatorial(domain: &Domain) -> Csr {
    let mut triplets = Vec::new();
    for &[i, j] in domain.edges() {
        triplets.extend([(i, j, -1.0), (j, i, -1.0), (i, i, 1.0), (j, j, 1.0)]);
    }
    Csr::from_triplets(domain.vertex_count(), domain.vertex_count(), &triplets)
}

/// Floater's mean-value weights at every vertex: `ω_ij = Σ tan(γ/2) / |e_ij|` over the angles at i beside ij.
pub fn mean_value(surface: &Surface) -> Csr {
    let n = surface.positions().len();
    let mut triplets = Vec::new();
    for face in surface.faces() {
        for k in 0..3 {
            let (i, a, b) = (face[k], face[(k + 1) % 3], face[(k + 2) % 3]);
            let (u, v) = (surface.point(a) - surface.point(i), surface.point(b) - surface.point(i));
            let tangent = u.cross(&v).norm() / (u.norm() * v.norm() + u.dot(&v));
            for (j, e) in [(a, u), (b, v)] {
                let w = tangent / e.norm();
                triplets.extend([(i, j, -w), (i, i, w)]);
            }
        }
    }
    Csr::from_triplets(n, n, &triplets)
}

/// The matrix with `change` added to one entry.
pub fn with_added(matrix: &Csr, i: usize, j: usize, change: f64) -> Csr {
    matrix.add(&Csr::from_triplets(matrix.rows(), matrix.columns(), &[(i, j, change)]))
}

/// The matrix with one stored entry multiplied.
pub fn with_scaled_entry(matrix: &Csr, i: usize, j: usize, factor: f64) -> Csr {
    matrix.map(|a, b, v| if (a, b) == (i, j) { v * factor } else { *v })
}
