//! Small meshes made by formulas.

use lapjury::domain::{Surface, geometry};
use lapjury::generate::Stream;

/// A grid of n × n squares, each cut along a diagonal chosen at random, its interior vertices moved by up to a fifth.
pub fn jittered(seed: u64, n: usize) -> (Vec<[f64; 2]>, Vec<[usize; 3]>) {
    let mut stream = Stream::new(seed, "jittered");
    let mut points = Vec::new();
    for k in 0..(n + 1) * (n + 1) {
        let (x, y) = (k % (n + 1), k / (n + 1));
        let inside = x > 0 && y > 0 && x < n && y < n;
        let mut shift = || if inside { stream.between(-0.2, 0.2) } else { 0.0 };
        points.push([x as f64 + shift(), y as f64 + shift()]);
    }
    let mut faces = Vec::new();
    for k in (0..n * (n + 1)).filter(|k| k % (n + 1) < n) {
        let [a, b, c, d] = [k, k + 1, k + n + 2, k + n + 1];
        if stream.unit() < 0.5 {
            faces.extend([[a, b, c], [a, c, d]]);
        } else {
            faces.extend([[a, b, d], [b, c, d]]);
        }
    }
    (points, faces)
}

pub fn planar(seed: u64, n: usize) -> Surface {
    let (points, faces) = jittered(seed, n);
    Surface::planar(&points, &faces).unwrap()
}

/// The same over the graph of a function.
pub fn landscape(seed: u64, n: usize) -> Surface {
    let (points, faces) = jittered(seed, n);
    let lift = |[x, y]: [f64; 2]| [x, y, 0.7 * (1.3 * x).sin() * (0.9 * y).cos()];
    Surface::triangles(points.into_iter().map(lift).collect(), &faces).unwrap()
}

/// The octahedron, each face cut in four `levels` times, its vertices moved to the sphere and then along it.
pub fn bumpy_sphere(seed: u64, levels: usize) -> Surface {
    let mut points: Vec<[f64; 3]> = Vec::new();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            points.push(std::array::from_fn(|k| if k == axis { sign } else { 0.0 }));
        }
    }
    let mut faces: Vec<[usize; 3]> = (0..8_usize)
        .map(|octant| {
            let [x, y, z] = [octant & 1, 2 + (octant >> 1 & 1), 4 + (octant >> 2 & 1)];
            if octant.count_ones() % 2 == 0 { [x, y, z] } else { [x, z, y] }
        })
        .collect();
    for _ in 0..levels {
        let mut middles = std::collections::BTreeMap::new();
        let mut finer = Vec::new();
        for &[a, b, c] in &faces {
            let [p, q, r] = [[a, b], [b, c], [c, a]].map(|[i, j]| {
                *middles.entry([i.min(j), i.max(j)]).or_insert_with(|| {
                    points.push(std::array::from_fn(|k| 0.5 * (points[i][k] + points[j][k])));
                    points.len() - 1
                })
            });
            finer.extend([[a, p, r], [p, b, q], [r, q, c], [p, q, r]]);
        }
        faces = finer;
    }
    let mut stream = Stream::new(seed, "bumpy");
    for p in &mut points {
        let radius = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        *p = p.map(|x| x / radius + stream.between(-0.05, 0.05));
    }
    Surface::triangles(points, &faces).unwrap()
}

/// A cube of side s, each face cut along a diagonal.
pub fn cube(s: f64) -> Surface {
    let points = (0..8_usize).map(|k| [k & 1, k >> 1 & 1, k >> 2 & 1].map(|bit| s * bit as f64)).collect();
    let squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let faces: Vec<_> = squares.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Surface::triangles(points, &faces).unwrap()
}

pub fn tetrahedron(s: f64) -> Surface {
    let p = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    Surface::triangles(p.map(|p| p.map(|x| s * x)).to_vec(), &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]).unwrap()
}

/// The regular n-gon of radius r around vertex 0.
pub fn regular_star(n: usize, r: f64) -> Surface {
    let mut points = vec![[0.0, 0.0]];
    points.extend((0..n).map(|k| {
        let (sin, cos) = (std::f64::consts::TAU * k as f64 / n as f64).sin_cos();
        [r * cos, r * sin]
    }));
    let faces: Vec<_> = (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % n]).collect();
    Surface::planar(&points, &faces).unwrap()
}

/// The rhombus (±2, 0), (0, ±1), cut along its long diagonal.
pub fn rhombus() -> Surface {
    Surface::planar(&[[-2.0, 0.0], [0.0, -1.0], [2.0, 0.0], [0.0, 1.0]], &[[0, 1, 2], [0, 2, 3]]).unwrap()
}

pub fn scaled(surface: &Surface, s: f64) -> Surface {
    let points = surface.positions().iter().map(|p| p.map(|x| s * x)).collect();
    Surface::new(points, surface.faces().to_vec()).unwrap()
}

/// Turned by the rational rotation (3/5, 4/5) out of the plane z = 0.
pub fn turned(surface: &Surface) -> Surface {
    let points = surface.positions().iter().map(|p| [0.6 * p[0], p[1], 0.8 * p[0]]).collect();
    Surface::new(points, surface.faces().to_vec()).unwrap()
}

/// The Delaunay triangulation of planar points, by spade.
pub fn delaunay(points: &[[f64; 2]]) -> Surface {
    use spade::{DelaunayTriangulation, Point2, Triangulation};
    let points_of_spade = points.iter().map(|p| Point2::new(p[0], p[1])).collect();
    let built = DelaunayTriangulation::<Point2<f64>>::bulk_load_stable(points_of_spade).unwrap();
    let faces: Vec<[usize; 3]> = built.inner_faces().map(|f| f.vertices().map(|v| v.fix().index())).collect();
    Surface::planar(points, &faces).unwrap()
}

/// Random points triangulated, then spoilt.
pub fn spoilt(seed: u64, n: usize) -> (Vec<[f64; 2]>, Surface) {
    let mut stream = Stream::new(seed, "spoilt");
    let points: Vec<[f64; 2]> = (0..n).map(|_| [stream.unit(), stream.unit()]).collect();
    let faces = spoil(&mut stream, &points);
    let surface = Surface::planar(&points, &faces).unwrap();
    (points, surface)
}

/// A Delaunay triangulation of the points after random flips of strictly convex pairs.
pub fn spoil(stream: &mut Stream, points: &[[f64; 2]]) -> Vec<[usize; 3]> {
    let mut faces: Vec<[usize; 3]> = delaunay(points).faces().iter().map(|f| [f[0], f[1], f[2]]).collect();
    for _ in 0..4 * points.len() {
        let (f, k) = (stream.below(faces.len()), stream.below(3));
        let [a, b, c] = std::array::from_fn(|m| faces[f][(k + m) % 3]);
        let Some(g) = faces.iter().position(|t| (0..3).any(|m| t[m] == b && t[(m + 1) % 3] == a)) else { continue };
        let d = faces[g].into_iter().find(|v| ![a, b].contains(v)).unwrap();
        let turn = |x: usize, y: usize, z: usize| geometry::orient2d(points[x], points[y], points[z]);
        if turn(d, c, a).is_gt() && turn(c, d, b).is_gt() {
            (faces[f], faces[g]) = ([d, c, a], [c, d, b]);
        }
    }
    faces
}

pub fn all() -> Vec<(&'static str, Surface)> {
    vec![
        ("planar", planar(1, 6)),
        ("landscape", landscape(2, 6)),
        ("bumpy sphere", bumpy_sphere(3, 2)),
        ("cube", cube(1.0)),
        ("tetrahedron", tetrahedron(1.0)),
        ("spoilt", spoilt(4, 60).1),
        ("rhombus", rhombus()),
    ]
}
