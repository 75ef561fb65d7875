//! Curves and surfaces without boundary, smooth functions on them with their Laplacians, and samples.
//!
//! # Laplacians
//! With n the outer normal and H the sum of the principal curvatures (for the curve, its curvature in its plane), the coordinates have
//! `−Δx = H n_x`, and `∇x·∇y = −n_x n_y`, `|∇x|² = 1 − n_x²`. Products follow: `−Δ(fg) = f(−Δg) + g(−Δf) − 2∇f·∇g`.

use std::f64::consts::{PI, TAU};

use crate::generate::Stream;

/// A place to sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// The unit circle.
    Circle,
    /// The unit sphere.
    Sphere,
    /// The torus with circles of radius 1 and ½.
    Torus,
}

/// All of them.
pub const SHAPES: [Shape; 3] = [Shape::Circle, Shape::Sphere, Shape::Torus];

/// How to sample it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Evenly, then each point displaced at random by up to a third of the spacing.
    Jittered,
    /// Independently, with the same chance for the same area.
    Random,
}

/// Both.
pub const WAYS: [Way; 2] = [Way::Jittered, Way::Random];

/// A function on any of the shapes.
#[derive(Clone, Copy)]
pub struct Smooth {
    /// Its value at a point.
    pub value: fn([f64; 3]) -> f64,
    /// −Δf at a point with this outer normal and sum of curvatures.
    pub source: fn([f64; 3], [f64; 3], f64) -> f64,
}

/// Linear, quadratic and cubic: x, xy or xz, x³.
pub fn functions(shape: Shape) -> [Smooth; 3] {
    let linear = Smooth { value: |p| p[0], source: |_, n, h| h * n[0] };
    let cubic = Smooth {
        value: |p| p[0].powi(3),
        source: |p, n, h| 3.0 * p[0] * p[0] * h * n[0] - 6.0 * p[0] * (1.0 - n[0] * n[0]),
    };
    let product = match shape {
        Shape::Circle => {
            Smooth { value: |p| p[0] * p[1], source: |p, n, h| h * (p[0] * n[1] + p[1] * n[0]) + 2.0 * n[0] * n[1] }
        }
        _ => Smooth { value: |p| p[0] * p[2], source: |p, n, h| h * (p[0] * n[2] + p[2] * n[0]) + 2.0 * n[0] * n[2] },
    };
    [linear, product, cubic]
}

impl Shape {
    /// The name used in texts.
    pub fn name(self) -> &'static str {
        match self {
            Shape::Circle => "circle",
            Shape::Sphere => "sphere",
            Shape::Torus => "torus",
        }
    }

    /// Its dimension.
    pub fn dimension(self) -> usize {
        if self == Shape::Circle { 1 } else { 2 }
    }

    /// Its length or area.
    pub fn area(self) -> f64 {
        match self {
            Shape::Circle => TAU,
            Shape::Sphere => 4.0 * PI,
            Shape::Torus => 0.5 * TAU * TAU,
        }
    }

    /// The smallest radius of curvature.
    pub fn radius(self) -> f64 {
        if self == Shape::Torus { 0.5 } else { 1.0 }
    }

    /// The outer normal and the sum of the principal curvatures at a point.
    pub fn normal(self, p: [f64; 3]) -> ([f64; 3], f64) {
        match self {
            Shape::Circle => (p, 1.0),
            Shape::Sphere => (p, 2.0),
            Shape::Torus => {
                let axis = p[0].hypot(p[1]);
                let cosine = (axis - 1.0) / 0.5;
                ([cosine * p[0] / axis, cosine * p[1] / axis, p[2] / 0.5], 2.0 + cosine / axis)
            }
        }
    }

    /// −Δf at a point.
    pub fn source(self, f: &Smooth, p: [f64; 3]) -> f64 {
        let (normal, curvature) = self.normal(p);
        (f.source)(p, normal, curvature)
    }

    /// A sample of about `count` points: on the torus twice a square.
    pub fn sample(self, way: Way, count: usize, stream: &mut Stream) -> Vec<[f64; 3]> {
        let half = (count as f64 / 2.0).sqrt().round();
        match (self, way) {
            (Shape::Circle, way) => (0..count).map(|k| at_angle(self.angle(way, k, count, stream))).collect(),
            (Shape::Sphere, Way::Random) => (0..count).map(|_| unit([(); 3].map(|()| stream.normal()))).collect(),
            (Shape::Sphere, Way::Jittered) => {
                // A spiral in which each point is turned on by the golden angle; a cell has the area 4π/n.
                let reach = (4.0 * PI / count as f64).sqrt() / 3.0;
                let place = |k: usize| {
                    let z = 1.0 - (2 * k + 1) as f64 / count as f64;
                    let (s, c) = (PI * (3.0 - 5_f64.sqrt()) * k as f64).sin_cos();
                    let r = (1.0 - z * z).sqrt();
                    unit([r * c, r * s, z].map(|x| x + stream.between(-reach, reach)))
                };
                (0..count).map(place).collect()
            }
            (Shape::Torus, Way::Jittered) => {
                let shaken = |k: f64, n: f64, stream: &mut Stream| TAU * (k + stream.between(-1.0, 1.0) / 3.0) / n;
                let grid = (0..2 * half as usize).flat_map(|i| (0..half as usize).map(move |j| [i as f64, j as f64]));
                grid.map(|[i, j]| on_torus(shaken(i, 2.0 * half, stream), shaken(j, half, stream))).collect()
            }
            (Shape::Torus, Way::Random) => {
                // The area element is ½ (1 + ½ cos v): an angle is kept with that chance over its maximum.
                let mut minor = || {
                    loop {
                        let v = stream.between(0.0, TAU);
                        if stream.unit() * 1.5 < 1.0 + 0.5 * v.cos() {
                            return [stream.between(0.0, TAU), v];
                        }
                    }
                };
                (0..count).map(|_| minor()).map(|[u, v]| on_torus(u, v)).collect()
            }
        }
    }

    fn angle(self, way: Way, k: usize, count: usize, stream: &mut Stream) -> f64 {
        match way {
            Way::Jittered => TAU * (k as f64 + stream.between(-1.0, 1.0) / 3.0) / count as f64,
            Way::Random => stream.between(0.0, TAU),
        }
    }
}

fn unit(p: [f64; 3]) -> [f64; 3] {
    let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
    p.map(|x| x / length)
}

/// The point of the unit circle at an angle.
pub fn at_angle(angle: f64) -> [f64; 3] {
    [angle.cos(), angle.sin(), 0.0]
}

/// The point of the torus at two angles.
pub fn on_torus(u: f64, v: f64) -> [f64; 3] {
    let axis = 1.0 + 0.5 * v.cos();
    [axis * u.cos(), axis * u.sin(), 0.5 * v.sin()]
}

impl Way {
    /// The name used in texts.
    pub fn name(self) -> &'static str {
        match self {
            Way::Jittered => "jittered",
            Way::Random => "random",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Second differences in the parameters of each shape, a way without normals.
    fn by_differences(shape: Shape, f: &Smooth, [u, v]: [f64; 2]) -> f64 {
        let eps = 1e-3;
        let second = |g: &dyn Fn(f64) -> f64| (g(eps) - 2.0 * g(0.0) + g(-eps)) / (eps * eps);
        let first = |g: &dyn Fn(f64) -> f64| (g(eps) - g(-eps)) / (2.0 * eps);
        let on_sphere = |u: f64, v: f64| [v.cos() * u.cos(), v.cos() * u.sin(), v.sin()];
        match shape {
            Shape::Circle => -second(&|e| (f.value)(at_angle(u + e))),
            // f_vv − tan v f_v + f_uu/cos² v; on the torus f_vv/r² − sin v f_v/(r ρ) + f_uu/ρ².
            Shape::Sphere => {
                let along = second(&|e| (f.value)(on_sphere(u, v + e)));
                let slope = first(&|e| (f.value)(on_sphere(u, v + e)));
                -along + v.tan() * slope - second(&|e| (f.value)(on_sphere(u + e, v))) / v.cos().powi(2)
            }
            Shape::Torus => {
                let axis = 1.0 + 0.5 * v.cos();
                let along = second(&|e| (f.value)(on_torus(u, v + e)));
                let slope = first(&|e| (f.value)(on_torus(u, v + e)));
                -along / 0.25 + v.sin() * slope / (0.5 * axis)
                    - second(&|e| (f.value)(on_torus(u + e, v))) / (axis * axis)
            }
        }
    }

    #[test]
    fn the_sources_are_the_laplacians() {
        for shape in SHAPES {
            for f in functions(shape) {
                for k in 0..9 {
                    let [u, v] = [0.3 + 0.7 * f64::from(k), 1.2 - 0.25 * f64::from(k)];
                    let p = match shape {
                        Shape::Circle => at_angle(u),
                        Shape::Sphere => [v.cos() * u.cos(), v.cos() * u.sin(), v.sin()],
                        Shape::Torus => on_torus(u, v),
                    };
                    let gap = shape.source(&f, p) - by_differences(shape, &f, [u, v]);
                    assert!(gap.abs() < 1e-3, "{shape:?} {k}: {gap}");
                }
            }
        }
    }

    #[test]
    fn samples_lie_on_their_shapes_and_fill_them() {
        for shape in SHAPES {
            for way in WAYS {
                let points = shape.sample(way, 2000, &mut Stream::new(3, "sample"));
                assert_eq!(
                    points.len(),
                    if shape == Shape::Torus { 2048 - 48 * usize::from(way == Way::Random) } else { 2000 }
                );
                let mean = [0, 1, 2].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64);
                assert!(mean.iter().all(|m| m.abs() < 0.1), "{shape:?} {way:?} {mean:?}");
                for p in points {
                    let (normal, _) = shape.normal(p);
                    assert!((normal.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12);
                }
            }
        }
    }
}
