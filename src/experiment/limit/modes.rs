//! The first eigenvalues and eigenspaces of each place, in closed form.
//!
//! | place | `−Δφ = λφ`, Dirichlet | natural |
//! | --- | --- | --- |
//! | unit square | `π²(a² + b²)`, sin sin, a, b ≥ 1 | `π²(a² + b²)`, cos cos, a, b ≥ 0 |
//! | unit cube | `π²(a² + b² + c²)`, sin sin sin | `π²(a² + b² + c²)`, cos cos cos |
//! | unit disc | zeros of J_m squared, `J_m(jr) cos mθ, sin mθ` | zeros of J_m' squared |
//! | flat torus ℝ²/ℤ² | | `4π²(a² + b²)`, cos and sin of `2π(ax + by)` |
//! | unit sphere | | `l(l + 1)`, the harmonic polynomials of degree l |

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use super::bessel;
use super::mesh::Mesh;
use super::place::{Boundary, Place, unit};

/// A function of a place. On the sphere it is constant along rays from the centre, on the torus periodic.
pub type Function = Box<dyn Fn([f64; 3]) -> f64 + Send + Sync>;

/// An eigenvalue with a basis of its eigenspace.
pub struct Cluster {
    /// The eigenvalue.
    pub value: f64,
    /// The basis.
    pub functions: Vec<Function>,
}

/// An eigenvalue with the values of a basis of its eigenspace at the vertices of a mesh.
pub struct Sampled {
    /// The eigenvalue.
    pub value: f64,
    /// The values of each function.
    pub functions: Vec<Vec<f64>>,
}

impl Cluster {
    /// The functions at the vertices.
    pub fn at(&self, mesh: &Mesh) -> Sampled {
        Sampled { value: self.value, functions: self.functions.iter().map(|f| mesh.values(f)).collect() }
    }
}

impl Place {
    /// The eigenspaces of the smallest positive eigenvalues, ascending: three; two on the sphere and in the cube,
    /// where many functions share one.
    pub fn eigenspaces(self, boundary: Boundary) -> Vec<Cluster> {
        match self {
            Place::Square => cube::<2>(boundary),
            Place::Cube => cube::<3>(boundary).into_iter().take(2).collect(),
            Place::Disc => disc(boundary),
            Place::Torus => torus(),
            Place::Sphere => sphere(),
        }
    }
}

/// How many eigenspaces are compared.
const SPACES: usize = 3;

/// The first eigenspaces of a lattice of frequencies: `scale |k|²`.
fn lattice<const D: usize>(scale: f64, modes: impl Iterator<Item = ([i32; D], Vec<Function>)>) -> Vec<Cluster> {
    let mut clusters: BTreeMap<i32, Vec<Function>> = BTreeMap::new();
    for (frequency, functions) in modes {
        clusters.entry(frequency.iter().map(|k| k * k).sum()).or_default().extend(functions);
    }
    let clusters = clusters.into_iter().take(SPACES);
    clusters.map(|(square, functions)| Cluster { value: scale * f64::from(square), functions }).collect()
}

/// The unit cube in D dimensions: products of sines or cosines along the axes.
fn cube<const D: usize>(boundary: Boundary) -> Vec<Cluster> {
    let wave = move |k: i32, x: f64| match boundary {
        Boundary::Dirichlet => (PI * f64::from(k) * x).sin(),
        Boundary::Natural => (PI * f64::from(k) * x).cos(),
    };
    let first = i32::from(boundary == Boundary::Dirichlet);
    let frequencies = (0..3_i32.pow(D as u32)).map(move |code| {
        let mut rest = code;
        [0; D].map(|_| {
            let digit = rest % 3;
            rest /= 3;
            first + digit
        })
    });
    let mode = move |frequency: [i32; D]| {
        let product = move |p: [f64; 3]| frequency.iter().zip(p).map(|(k, x)| wave(*k, x)).product();
        (frequency, vec![Box::new(product) as Function])
    };
    lattice(PI * PI, frequencies.filter(|k| *k != [0; D]).map(mode))
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
    use super::super::place::testing::{ALL, minus_laplacian, somewhere};
    use super::*;

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
                            let gap = minus_laplacian(&f, p, &tangents) - value * f(p);
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
        assert_eq!(found(Place::Cube, Dirichlet, PI * PI), [(3.0, 1), (6.0, 3)]);
        assert_eq!(found(Place::Cube, Natural, PI * PI), [(1.0, 3), (2.0, 3)]);
        assert_eq!(found(Place::Torus, Natural, TAU * TAU), [(1.0, 4), (2.0, 4), (4.0, 4)]);
        assert_eq!(found(Place::Sphere, Natural, 1.0), [(2.0, 3), (6.0, 5)]);
        // 2.404826², 3.831706², 5.135622²; 1.841184², 3.054237², 3.831706².
        assert_eq!(found(Place::Disc, Dirichlet, 1.0), [(5.7832, 1), (14.682, 2), (26.3746, 2)]);
        assert_eq!(found(Place::Disc, Natural, 1.0), [(3.39, 2), (9.3284, 2), (14.682, 1)]);
    }
}
