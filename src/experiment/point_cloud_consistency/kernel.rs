//! The smooth operator that the sums approach: `F_t f(p) = 1/t ∫ (4πt)^(−d/2) exp(−|p − q|²/4t) (f(p) − f(q)) dq`.
//!
//! # Definition
//! On the sphere the mean of a harmonic polynomial of degree l over a circle about p is P_l times its value at p, so that it is an eigenfunction,
//! with x = 1 − cos of the angle, |p − q|² = 2x:
//! ```text
//! λ_l(t) = 1/(2t²) ∫₀² e^(−x/2t) (1 − P_l(1 − x)) dx;   λ₁ = 2 (1 − (1 + 1/t) e^(−1/t)),   λ₂ = 6 (1 − 2t) + O(e^(−1/t))
//! ```
//! λ₁ is 2 beyond all orders of t. On circle and torus the trapezoidal rule in the angles, whose error is that of a Gaussian sampled at its own
//! width √t: below e^(−4π²).

use std::f64::consts::{PI, TAU};

use super::shape::{Shape, Smooth, at_angle, on_torus};
use crate::domain::nearest::squared_distance;

/// `F_t f` at a point, of the three [`functions`](super::shape::functions).
pub fn smooth(shape: Shape, f: &[Smooth; 3], t: f64, p: [f64; 3]) -> [f64; 3] {
    let steps = |length: f64| (length / t.sqrt()).ceil().max(32.0) as usize;
    let turn = |k: usize, n: usize| TAU * k as f64 / n as f64;
    let here = f.map(|f| (f.value)(p));
    let add = |sum: &mut [f64; 3], q: [f64; 3], weight: f64| {
        let weight = weight * (-squared_distance(p, q) / (4.0 * t)).exp();
        (0..3).for_each(|k| sum[k] += weight * (here[k] - (f[k].value)(q)));
    };
    let mut sum = [0.0; 3];
    match shape {
        Shape::Circle => {
            let n = steps(TAU);
            (0..n).for_each(|k| add(&mut sum, at_angle(turn(k, n)), TAU / n as f64));
            sum.map(|x| x / (4.0 * PI * t).sqrt() / t)
        }
        Shape::Torus => {
            let [n, m] = [steps(1.5 * TAU), steps(0.5 * TAU)];
            for v in (0..m).map(|j| turn(j, m)) {
                let weight = 0.5 * (1.0 + 0.5 * v.cos()) * TAU * TAU / (n * m) as f64;
                (0..n).for_each(|i| add(&mut sum, on_torus(turn(i, n), v), weight));
            }
            sum.map(|x| x / (4.0 * PI * t) / t)
        }
        // x and xz are harmonic; x³ = (x³ − 3x/5) + 3x/5, of degrees 3 and 1.
        Shape::Sphere => {
            let [first, second, third] = [1, 2, 3].map(|l| eigenvalue(l, t));
            let [x, xz, cube] = here;
            [first * x, second * xz, third * (cube - 0.6 * x) + first * 0.6 * x]
        }
    }
}

/// λ_l(t) on the sphere, l = 1, 2, 3.
pub fn eigenvalue(l: usize, t: f64) -> f64 {
    // ∫₀² xᵏ e^(−ax) dx = k!/a^(k+1) (1 − e^(−2a) Σ_{m ≤ k} (2a)^m/m!), times 1/(2t²) = 2a².
    let a = 0.5 / t;
    let moment = |k: i32| {
        let (mut term, mut sum, mut factorial) = (1.0, 1.0, 1.0);
        for m in 1..=k {
            term *= 2.0 * a / f64::from(m);
            sum += term;
            factorial *= f64::from(m);
        }
        2.0 * factorial * a.powi(1 - k) * (1.0 - (-2.0 * a).exp() * sum)
    };
    // 1 − P_l(1 − x): x, 3x − 3/2 x², 6x − 15/2 x² + 5/2 x³.
    match l {
        1 => moment(1),
        2 => 3.0 * moment(1) - 1.5 * moment(2),
        _ => 6.0 * moment(1) - 7.5 * moment(2) + 2.5 * moment(3),
    }
}

#[cfg(test)]
mod tests {
    use super::super::shape::{SHAPES, functions};
    use super::*;

    #[test]
    fn the_eigenvalues_on_the_sphere_are_those_of_the_expansion_and_of_a_sum_over_circles() {
        for t in [0.1, 0.03, 0.01_f64] {
            let tail = 200.0 / t * (-1.0 / t).exp();
            assert!((eigenvalue(1, t) - 2.0 * (1.0 - (1.0 + 1.0 / t) * (-1.0 / t).exp())).abs() < 1e-12);
            assert!((eigenvalue(2, t) - 6.0 * (1.0 - 2.0 * t)).abs() < 1e-12 + tail);
            assert!((eigenvalue(3, t) - (12.0 - 60.0 * t + 120.0 * t * t)).abs() < 1e-11 + tail);
            // Simpson's rule over the cosine.
            let n = 20_000;
            let value = |k: usize| {
                let x = 2.0 * k as f64 / n as f64;
                let s = 1.0 - x;
                (-x / (2.0 * t)).exp() * (1.0 - 0.5 * s * (5.0 * s * s - 3.0)) / (2.0 * t * t)
            };
            let weight = |k: usize| if k == 0 || k == n { 1.0 } else { 2.0 + 2.0 * (k % 2) as f64 };
            let simpson = (0..=n).map(|k| weight(k) * value(k)).sum::<f64>() * 2.0 / n as f64 / 3.0;
            assert!((eigenvalue(3, t) - simpson).abs() < 1e-7, "{t}: {simpson}");
        }
    }

    /// On the circle cos mθ is an eigenfunction with `m² + t (5m²/4 − m⁴/2) + O(t²)`, by the expansion of Bessel functions.
    #[test]
    fn on_the_circle_the_bias_is_that_of_the_expansion() {
        for t in [1e-2, 1e-3, 1e-4] {
            let p = at_angle(0.7);
            let found = smooth(Shape::Circle, &functions(Shape::Circle), t, p);
            let bias = |value: f64, at: f64, m: f64| (value / at - m * m) / t;
            let [one, two] = [bias(found[0], p[0], 1.0), bias(found[1], p[0] * p[1], 2.0)];
            assert!((one - 0.75).abs() < 9.0 * t && (two + 3.0).abs() < 90.0 * t, "{t}: {found:?}");
        }
    }

    #[test]
    fn everywhere_the_smooth_operator_tends_to_the_laplacian() {
        for shape in SHAPES {
            let p = match shape {
                Shape::Circle => at_angle(0.4),
                Shape::Sphere => [0.48, 0.6, 0.64],
                Shape::Torus => on_torus(0.4, 2.0),
            };
            let functions = functions(shape);
            let gaps = |t: f64| {
                let found = smooth(shape, &functions, t, p);
                [0, 1, 2].map(|k| (found[k] - shape.source(&functions[k], p)).abs())
            };
            for (coarse, fine) in gaps(1e-3).into_iter().zip(gaps(2.5e-4)) {
                assert!(coarse < 0.2 && fine < 0.3 * coarse + 1e-9, "{shape:?}: {coarse} {fine}");
            }
        }
    }
}
