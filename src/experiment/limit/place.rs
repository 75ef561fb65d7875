//! Smooth domains whose spectrum is known in closed form, with a Poisson problem whose solution is known.
//!
//! | place | `−Δφ = λφ`, Dirichlet | natural |
//! | --- | --- | --- |
//! | unit square | `π²(a² + b²)`, sin sin, a, b ≥ 1 | `π²(a² + b²)`, cos cos, a, b ≥ 0 |
//! | unit disc | zeros of J_m squared, `J_m(jr) cos mθ, sin mθ` | zeros of J_m' squared |
//! | flat torus ℝ²/ℤ² | | `4π²(a² + b²)`, cos and sin of `2π(ax + by)` |
//! | unit sphere | | `l(l + 1)`, the harmonic polynomials of degree l |
//!
//! Signs: the Laplacian is −Δ, positive semi-definite, and `source` is −Δu.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use super::bessel;
use crate::domain::{Domain, Surface};

/// A function of a place. On the sphere it is constant along rays from the centre, on the torus periodic.
pub type Function = Box<dyn Fn([f64; 3]) -> f64 + Send + Sync>;

/// A smooth domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// `[0, 1]²`.
    Square,
    /// `x² + y² ≤ 1`.
    Disc,
    /// `ℝ²/ℤ²`.
    Torus,
    /// `x² + y² + z² = 1`.
    Sphere,
}

/// What holds at the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Boundary {
    /// Values are given.
    Dirichlet,
    /// The normal derivative is zero; also where there is no boundary.
    Natural,
}

impl Boundary {
    /// The name used in texts.
    pub fn name(self) -> &'static str {
        match self {
            Boundary::Dirichlet => "Dirichlet",
            Boundary::Natural => "natural",
        }
    }
}

/// An eigenvalue with a basis of its eigenspace.
pub struct Cluster {
    /// The eigenvalue.
    pub value: f64,
    /// The basis.
    pub functions: Vec<Function>,
}

/// A smooth function with its derivatives.
#[derive(Clone, Copy)]
pub struct Smooth {
    /// u.
    pub value: fn([f64; 3]) -> f64,
    /// ∇u, of the extension that [`Function`] speaks of.
    pub gradient: fn([f64; 3]) -> [f64; 3],
    /// −Δu.
    pub source: fn([f64; 3]) -> f64,
}

impl Place {
    /// The boundary conditions that there are.
    pub fn boundaries(self) -> &'static [Boundary] {
        match self {
            Place::Square | Place::Disc => &[Boundary::Dirichlet, Boundary::Natural],
            Place::Torus | Place::Sphere => &[Boundary::Natural],
        }
    }

    /// The eigenspaces of the smallest positive eigenvalues, ascending: three, two on the sphere.
    pub fn eigenspaces(self, boundary: Boundary) -> Vec<Cluster> {
        match self {
            Place::Square => square(boundary),
            Place::Disc => disc(boundary),
            Place::Torus => torus(),
            Place::Sphere => sphere(),
        }
    }

    /// A function that is no eigenfunction and satisfies the boundary condition: zero on the boundary of the square, other
    /// values on that of the disc; zero normal derivative.
    pub fn solution(self, boundary: Boundary) -> Smooth {
        match (self, boundary) {
            // eˣ sin πx sin πy.
            (Place::Square, Boundary::Dirichlet) => Smooth {
                value: |[x, y, _]| x.exp() * (PI * x).sin() * (PI * y).sin(),
                gradient: |[x, y, _]| {
                    let (s, c) = (PI * x).sin_cos();
                    let (sy, cy) = (PI * y).sin_cos();
                    [x.exp() * (s + PI * c) * sy, x.exp() * PI * s * cy, 0.0]
                },
                source: |[x, y, _]| {
                    let (s, c) = (PI * x).sin_cos();
                    -x.exp() * (PI * y).sin() * ((1.0 - 2.0 * PI * PI) * s + TAU * c)
                },
            },
            // cos πx (1 + cos 2πy).
            (Place::Square, Boundary::Natural) => Smooth {
                value: |[x, y, _]| (PI * x).cos() * (1.0 + (TAU * y).cos()),
                gradient: |[x, y, _]| {
                    let (s, c) = (PI * x).sin_cos();
                    [-PI * s * (1.0 + (TAU * y).cos()), -TAU * c * (TAU * y).sin(), 0.0]
                },
                source: |[x, y, _]| PI * PI * (PI * x).cos() * (1.0 + 5.0 * (TAU * y).cos()),
            },
            // eˣ cos 2y.
            (Place::Disc, Boundary::Dirichlet) => Smooth {
                value: |[x, y, _]| x.exp() * (2.0 * y).cos(),
                gradient: |[x, y, _]| [x.exp() * (2.0 * y).cos(), -2.0 * x.exp() * (2.0 * y).sin(), 0.0],
                source: |[x, y, _]| 3.0 * x.exp() * (2.0 * y).cos(),
            },
            // x (1 − r²/3) + r² − r⁴/2.
            (Place::Disc, Boundary::Natural) => Smooth {
                value: |[x, y, _]| {
                    let r = x * x + y * y;
                    x * (1.0 - r / 3.0) + r - 0.5 * r * r
                },
                gradient: |[x, y, _]| {
                    let r = x * x + y * y;
                    [
                        1.0 - r / 3.0 - 2.0 / 3.0 * x * x + 2.0 * x * (1.0 - r),
                        -2.0 / 3.0 * x * y + 2.0 * y * (1.0 - r),
                        0.0,
                    ]
                },
                source: |[x, y, _]| 8.0 / 3.0 * x - 4.0 + 8.0 * (x * x + y * y),
            },
            // exp(sin 2πx) + sin 2πx cos 2πy.
            (Place::Torus, _) => Smooth {
                value: |[x, y, _]| (TAU * x).sin().exp() + (TAU * x).sin() * (TAU * y).cos(),
                gradient: |[x, y, _]| {
                    let (s, c) = (TAU * x).sin_cos();
                    let (sy, cy) = (TAU * y).sin_cos();
                    [TAU * c * (s.exp() + cy), -TAU * s * sy, 0.0]
                },
                source: |[x, y, _]| {
                    let (s, c) = (TAU * x).sin_cos();
                    TAU * TAU * (-(c * c - s) * s.exp() + 2.0 * s * (TAU * y).cos())
                },
            },
            // x + xy + xyz.
            (Place::Sphere, _) => Smooth {
                value: |p| {
                    let [x, y, z] = unit(p);
                    x + x * y + x * y * z
                },
                gradient: |p| {
                    let q @ [x, y, z] = unit(p);
                    let full = [1.0 + y + y * z, x + x * z, x * y];
                    let along: f64 = (0..3).map(|k| full[k] * q[k]).sum();
                    let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
                    [0, 1, 2].map(|k| (full[k] - along * q[k]) / length)
                },
                source: |p| {
                    let [x, y, z] = unit(p);
                    2.0 * x + 6.0 * x * y + 12.0 * x * y * z
                },
            },
        }
    }

    /// Where vertex v of a mesh of the place is: in the plane of the torus, else where the mesh has it.
    pub fn point(self, domain: &Domain, v: usize) -> [f64; 3] {
        match self {
            Place::Torus => {
                let n = (domain.vertex_count() as f64).sqrt().round() as usize;
                [(v % n) as f64 / n as f64, (v / n) as f64 / n as f64, 0.0]
            }
            _ => domain.positions().map_or([f64::NAN; 3], |p| p[v]),
        }
    }

    /// The corners of a triangle, near to each other: on the torus those in the plane that lie around the first.
    pub fn corners(self, domain: &Domain, surface: &Surface, face: usize) -> Option<([usize; 3], [[f64; 3]; 3])> {
        let vertices = surface.triangle(face)?;
        let mut points = vertices.map(|v| self.point(domain, v));
        if self == Place::Torus {
            let origin = points[0];
            for p in &mut points {
                (0..2).for_each(|k| p[k] -= (p[k] - origin[k]).round());
            }
        }
        Some((vertices, points))
    }
}

fn unit(p: [f64; 3]) -> [f64; 3] {
    let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
    p.map(|x| x / length)
}

/// How many eigenspaces are compared.
const SPACES: usize = 3;

/// The first eigenspaces of a lattice of frequencies: `scale (a² + b²)`.
fn lattice(scale: f64, modes: impl Iterator<Item = ([i32; 2], Vec<Function>)>) -> Vec<Cluster> {
    let mut clusters: BTreeMap<i32, Vec<Function>> = BTreeMap::new();
    for ([a, b], functions) in modes {
        clusters.entry(a * a + b * b).or_default().extend(functions);
    }
    let clusters = clusters.into_iter().take(SPACES);
    clusters.map(|(square, functions)| Cluster { value: scale * f64::from(square), functions }).collect()
}

fn square(boundary: Boundary) -> Vec<Cluster> {
    let wave = |boundary: Boundary, k: i32, x: f64| match boundary {
        Boundary::Dirichlet => (PI * f64::from(k) * x).sin(),
        Boundary::Natural => (PI * f64::from(k) * x).cos(),
    };
    let first = i32::from(boundary == Boundary::Dirichlet);
    let pairs = (first..4).flat_map(|a| (first..4).map(move |b| [a, b])).filter(|p| *p != [0, 0]);
    let mode = move |[a, b]: [i32; 2]| {
        let function: Function = Box::new(move |[x, y, _]| wave(boundary, a, x) * wave(boundary, b, y));
        ([a, b], vec![function])
    };
    lattice(PI * PI, pairs.map(mode))
}

fn torus() -> Vec<Cluster> {
    // One of each pair of opposite frequencies.
    let pairs = (0..3).flat_map(|a| (-2..3).map(move |b| [a, b])).filter(|&[a, b]| a > 0 || b > 0);
    let mode = |[a, b]: [i32; 2]| {
        let phase = move |[x, y, _]: [f64; 3]| TAU * (f64::from(a) * x + f64::from(b) * y);
        let functions: Vec<Function> = vec![Box::new(move |p| phase(p).cos()), Box::new(move |p| phase(p).sin())];
        ([a, b], functions)
    };
    lattice(TAU * TAU, pairs.map(mode))
}

fn disc(boundary: Boundary) -> Vec<Cluster> {
    let zeros = |m: u32| match boundary {
        Boundary::Dirichlet => bessel::zeros(|x| bessel::j(m, x)),
        Boundary::Natural => bessel::zeros(|x| bessel::derivative(m, x)),
    };
    // The first zeros grow with the order (for J_m' from m = 1 on), those of order 4 lie beyond the third eigenvalue.
    let mut all: Vec<(f64, u32)> = (0..5).flat_map(|m| zeros(m).into_iter().map(move |z| (z, m))).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let cluster = |(zero, m): (f64, u32)| {
        let radial = move |[x, y, _]: [f64; 3]| bessel::j(m, zero * x.hypot(y));
        let angle = move |[x, y, _]: [f64; 3]| f64::from(m) * y.atan2(x);
        let mut functions: Vec<Function> = vec![Box::new(move |p| radial(p) * angle(p).cos())];
        if m > 0 {
            functions.push(Box::new(move |p| radial(p) * angle(p).sin()));
        }
        Cluster { value: zero * zero, functions }
    };
    all.into_iter().take(SPACES).map(cluster).collect()
}

fn sphere() -> Vec<Cluster> {
    let on = |f: fn([f64; 3]) -> f64| -> Function { Box::new(move |p| f(unit(p))) };
    let first = vec![on(|[x, ..]| x), on(|[_, y, _]| y), on(|[.., z]| z)];
    let second = vec![
        on(|[x, y, _]| x * y),
        on(|[_, y, z]| y * z),
        on(|[x, _, z]| z * x),
        on(|[x, y, _]| x * x - y * y),
        on(|[.., z]| 3.0 * z * z - 1.0),
    ];
    vec![Cluster { value: 2.0, functions: first }, Cluster { value: 6.0, functions: second }]
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Place; 4] = [Place::Square, Place::Disc, Place::Torus, Place::Sphere];

    /// A point inside each place and two unit tangents there.
    fn somewhere(place: Place, k: usize) -> ([f64; 3], [[f64; 3]; 2]) {
        let flat = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let t = k as f64;
        match place {
            Place::Sphere => {
                let p = unit([(t + 0.3).sin(), (2.0 * t).cos(), 0.7 - 0.2 * t]);
                let a = unit([-p[1], p[0], 0.0]);
                (p, [a, [p[1] * a[2] - p[2] * a[1], p[2] * a[0] - p[0] * a[2], p[0] * a[1] - p[1] * a[0]]])
            }
            _ => ([0.11 + 0.1 * t, 0.57 - 0.06 * t, 0.0], flat),
        }
    }

    fn along(p: [f64; 3], d: [f64; 3], s: f64) -> [f64; 3] {
        [0, 1, 2].map(|k| p[k] + s * d[k])
    }

    /// −Δ by differences: for a function constant along rays the ambient Laplacian on the unit sphere is the intrinsic one, and
    /// second differences along two tangents differ from it by nothing, since the third direction contributes zero to first order.
    fn minus_laplacian(f: &dyn Fn([f64; 3]) -> f64, p: [f64; 3], tangents: [[f64; 3]; 2]) -> f64 {
        let eps = 1e-4;
        let second = |d: [f64; 3]| (f(along(p, d, eps)) - 2.0 * f(p) + f(along(p, d, -eps))) / (eps * eps);
        -tangents.into_iter().map(second).sum::<f64>()
    }

    #[test]
    fn every_eigenfunction_is_one_and_ascends_in_its_place() {
        for place in ALL {
            for &boundary in place.boundaries() {
                let spaces = place.eigenspaces(boundary);
                assert!(spaces.windows(2).all(|w| w[0].value < w[1].value - 0.5));
                for Cluster { value, functions } in spaces {
                    for f in functions {
                        for k in 0..5 {
                            let (p, tangents) = somewhere(place, k);
                            let gap = minus_laplacian(&f, p, tangents) - value * f(p);
                            assert!(gap.abs() < 1e-4, "{place:?} {boundary:?} {value}: {gap}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn the_eigenvalues_and_their_multiplicities_are_those_of_the_textbooks() {
        let found = |place: Place, boundary, scale: f64| -> Vec<(f64, usize)> {
            let spaces = place.eigenspaces(boundary).into_iter();
            spaces.map(|c| ((c.value / scale * 1e4).round() / 1e4, c.functions.len())).collect()
        };
        use Boundary::{Dirichlet, Natural};
        assert_eq!(found(Place::Square, Dirichlet, PI * PI), [(2.0, 1), (5.0, 2), (8.0, 1)]);
        assert_eq!(found(Place::Square, Natural, PI * PI), [(1.0, 2), (2.0, 1), (4.0, 2)]);
        assert_eq!(found(Place::Torus, Natural, TAU * TAU), [(1.0, 4), (2.0, 4), (4.0, 4)]);
        assert_eq!(found(Place::Sphere, Natural, 1.0), [(2.0, 3), (6.0, 5)]);
        // 2.404826², 3.831706², 5.135622²; 1.841184², 3.054237², 3.831706².
        assert_eq!(found(Place::Disc, Dirichlet, 1.0), [(5.7832, 1), (14.682, 2), (26.3746, 2)]);
        assert_eq!(found(Place::Disc, Natural, 1.0), [(3.39, 2), (9.3284, 2), (14.682, 1)]);
    }

    #[test]
    fn gradient_and_source_are_the_derivatives_of_the_value() {
        for place in ALL {
            for &boundary in place.boundaries() {
                let u = place.solution(boundary);
                for k in 0..5 {
                    let (p, tangents) = somewhere(place, k);
                    let source = minus_laplacian(&|q| (u.value)(q), p, tangents);
                    assert!(
                        (source - (u.source)(p)).abs() < 2e-4,
                        "{place:?} {boundary:?}: {source} {}",
                        (u.source)(p)
                    );
                    let off = p.map(|x| 0.9 * x);
                    for q in [p, off] {
                        for d in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
                            let difference = ((u.value)(along(q, d, 1e-5)) - (u.value)(along(q, d, -1e-5))) / 2e-5;
                            let slope: f64 = (0..3).map(|k| (u.gradient)(q)[k] * d[k]).sum();
                            assert!((difference - slope).abs() < 1e-6, "{place:?} {boundary:?}: {difference} {slope}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn natural_solutions_have_no_normal_derivative() {
        let [square, disc] = [Place::Square, Place::Disc].map(|p| p.solution(Boundary::Natural).gradient);
        for t in [0.0, 0.3, 0.8, 2.0, 5.0_f64] {
            let (s, c) = t.sin_cos();
            let g = disc([c, s, 0.0]);
            assert!((g[0] * c + g[1] * s).abs() < 1e-14);
            let t = t % 1.0;
            let sides = [
                square([0.0, t, 0.0])[0],
                square([1.0, t, 0.0])[0],
                square([t, 0.0, 0.0])[1],
                square([t, 1.0, 0.0])[1],
            ];
            assert!(sides.iter().all(|d| d.abs() < 1e-13), "{sides:?}");
        }
    }
}
