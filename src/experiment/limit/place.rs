//! Smooth domains with a Poisson problem on each whose solution is known; [`modes`](super::modes) has their spectra.
//!
//! Signs: the Laplacian is −Δ, positive semi-definite, and `source` is −Δu.

use std::f64::consts::{PI, TAU};

/// A smooth domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// `[0, 1]²`.
    Square,
    /// `[0, 1]³`.
    Cube,
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

/// A smooth function with its derivatives.
#[derive(Clone, Copy)]
pub struct Smooth {
    /// u.
    pub value: fn([f64; 3]) -> f64,
    /// ∇u, of the extension that [`Function`](super::modes::Function) speaks of.
    pub gradient: fn([f64; 3]) -> [f64; 3],
    /// −Δu.
    pub source: fn([f64; 3]) -> f64,
}

impl Place {
    /// The boundary conditions that there are.
    pub fn boundaries(self) -> &'static [Boundary] {
        match self {
            Place::Square | Place::Cube | Place::Disc => &[Boundary::Dirichlet, Boundary::Natural],
            Place::Torus | Place::Sphere => &[Boundary::Natural],
        }
    }

    /// A function that is no eigenfunction and satisfies the boundary condition: zero on the boundary of square and cube, other
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
            // eˣ sin πx sin πy sin πz.
            (Place::Cube, Boundary::Dirichlet) => Smooth {
                value: |[x, y, z]| x.exp() * (PI * x).sin() * (PI * y).sin() * (PI * z).sin(),
                gradient: |p| {
                    let [(sx, cx), (sy, cy), (sz, cz)] = p.map(|x| (PI * x).sin_cos());
                    let e = p[0].exp();
                    [e * (sx + PI * cx) * sy * sz, e * PI * sx * cy * sz, e * PI * sx * sy * cz]
                },
                source: |[x, y, z]| {
                    let (s, c) = (PI * x).sin_cos();
                    -x.exp() * (PI * y).sin() * (PI * z).sin() * ((1.0 - 3.0 * PI * PI) * s + TAU * c)
                },
            },
            // cos πx (1 + cos 2πy) + cos πz.
            (Place::Cube, Boundary::Natural) => Smooth {
                value: |[x, y, z]| (PI * x).cos() * (1.0 + (TAU * y).cos()) + (PI * z).cos(),
                gradient: |[x, y, z]| {
                    let (s, c) = (PI * x).sin_cos();
                    [-PI * s * (1.0 + (TAU * y).cos()), -TAU * c * (TAU * y).sin(), -PI * (PI * z).sin()]
                },
                source: |[x, y, z]| PI * PI * ((PI * x).cos() * (1.0 + 5.0 * (TAU * y).cos()) + (PI * z).cos()),
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
}

/// The point of the unit sphere on the same ray.
pub fn unit(p: [f64; 3]) -> [f64; 3] {
    let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
    p.map(|x| x / length)
}

#[cfg(test)]
pub(super) mod testing {
    //! Derivatives by differences.

    use super::*;

    pub const ALL: [Place; 5] = [Place::Square, Place::Cube, Place::Disc, Place::Torus, Place::Sphere];

    /// A point inside each place and orthonormal tangents there.
    pub fn somewhere(place: Place, k: usize) -> ([f64; 3], Vec<[f64; 3]>) {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let t = k as f64;
        match place {
            Place::Sphere => {
                let p = unit([(t + 0.3).sin(), (2.0 * t).cos(), 0.7 - 0.2 * t]);
                let a = unit([-p[1], p[0], 0.0]);
                (p, vec![a, [p[1] * a[2] - p[2] * a[1], p[2] * a[0] - p[0] * a[2], p[0] * a[1] - p[1] * a[0]]])
            }
            Place::Cube => ([0.11 + 0.1 * t, 0.57 - 0.06 * t, 0.37 + 0.05 * t], axes.to_vec()),
            _ => ([0.11 + 0.1 * t, 0.57 - 0.06 * t, 0.0], axes[..2].to_vec()),
        }
    }

    pub fn along(p: [f64; 3], d: [f64; 3], s: f64) -> [f64; 3] {
        [0, 1, 2].map(|k| p[k] + s * d[k])
    }

    /// −Δ by differences: for a function constant along rays the ambient Laplacian on the unit sphere is the intrinsic one, and
    /// second differences along two tangents differ from it by nothing, since the third direction contributes zero to first order.
    pub fn minus_laplacian(f: &dyn Fn([f64; 3]) -> f64, p: [f64; 3], tangents: &[[f64; 3]]) -> f64 {
        let eps = 1e-4;
        let second = |d: [f64; 3]| (f(along(p, d, eps)) - 2.0 * f(p) + f(along(p, d, -eps))) / (eps * eps);
        -tangents.iter().map(|d| second(*d)).sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::testing::{ALL, along, minus_laplacian, somewhere};
    use super::*;

    #[test]
    fn gradient_and_source_are_the_derivatives_of_the_value() {
        for place in ALL {
            for &boundary in place.boundaries() {
                let u = place.solution(boundary);
                for k in 0..5 {
                    let (p, tangents) = somewhere(place, k);
                    let source = minus_laplacian(&|q| (u.value)(q), p, &tangents);
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
            let cube = Place::Cube.solution(Boundary::Natural).gradient;
            for (axis, side) in (0..3).flat_map(|axis| [0.0, 1.0].map(|side| (axis, side))) {
                let mut p = [t, 0.2 + 0.7 * t, 1.0 - t];
                p[axis] = side;
                assert!(cube(p)[axis].abs() < 1e-13);
            }
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
