//! The convex energy whose stationary point is the metric, and Newton's method for it.
//!
//! # Definition
//! A triangle with `u_e = ℓ_e²/2` on its sides has the area `A = ½ √Q`, `Q = 2(u_a u_b + u_b u_c + u_c u_a) − u_a² − u_b² − u_c²`
//! (Heron), and `∂A/∂u_c = (u_a + u_b − u_c)/(2√Q) = ½ cot γ`. Q has the signature (1, 2), so that A is concave on the cone
//! `Q > 0, u > 0`, which is the triangle inequality, and linear along its rays only. Hence
//! `E(u) = Σ_e w_e u_e − Σ_f A_f(u)` is convex and homogeneous of degree one, and E′(u) = 0 says that w are the cotangent
//! weights of u; by Euler's relation E(u) = 0 there.
//!
//! # One scale for each part
//! `E″(u) v = 0` exactly where v is a multiple of u on each triangle: triangles that share a side share the factor. So the metric
//! is unique up to one factor for each part of the surface that is connected through sides; the gauge keeps `Σ c_e u_e` of each,
//! with positive factors c.
//!
//! # Weights of no metric
//! With the gauge E has a minimum whatever w is: A is infinitely steep at the boundary of the cone, and that all u of a part
//! vanish is excluded by the gauge. There `w − ½ Σ cot = λ c`, λ constant on each part, and `E(u) = λ Σ c_e u_e`. The weights
//! belong to a metric exactly if every λ vanishes: a metric has E ≥ 0 everywhere, which λ < 0 contradicts; and it has E = 0
//! somewhere, while λ > 0 gives `E(v) ≥ λ Σ c_e v_e > 0` for every v. So one wrong weight alone is always noticed: where it is
//! too small E becomes negative at the old metric, and where it is too large E becomes positive on every metric.

use crate::domain::Surface;
use crate::domain::topology::components;
use crate::linalg::Csr;
use crate::linalg::backward::gamma;
use crate::linalg::factor::{FactorError, Ldlt};

/// Newton steps for one set of weights: where more are needed, weights half as far away are quicker.
const LIMIT: usize = 20;

/// The shortest stride from the weights of equilateral triangles, at 0, to those given, at 1.
const SHORTEST: f64 = 1e-4;

/// Triangles by their three sides, and the part that each side belongs to.
pub struct Sides {
    /// The sides of each triangle.
    pub triangles: Vec<[usize; 3]>,
    /// Of each side, the number of its part: triangles that share a side are in one part.
    pub parts: Vec<usize>,
}

/// Where the energy is lowest.
pub struct Minimum {
    /// `ℓ²/2` of each side, up to a factor for each part.
    pub u: Vec<f64>,
    /// λ of each part.
    pub multipliers: Vec<f64>,
    /// A bound for `|w_e − ½ Σ cot − λ c_e|/c_e` on each part, rounding included.
    pub residuals: Vec<f64>,
    /// The largest relative change of a side in each step.
    pub steps: Vec<f64>,
}

/// A Newton step within the gauge, λ of each part, and the gradient there.
struct Step {
    direction: Vec<f64>,
    multipliers: Vec<f64>,
    gradient: Vec<f64>,
}

/// Why no minimum was found.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum NoMinimum {
    /// A factorisation failed.
    #[error(transparent)]
    Factor(#[from] FactorError),
    /// The iteration did not settle.
    #[error("the iteration did not settle, however short the stride")]
    Unsettled,
}

impl Minimum {
    /// A part whose weights belong to no metric whatever: `w − ½ Σ cot` has one sign on all of it, rounding included.
    pub fn without_metric(&self) -> Option<usize> {
        let signs = self.multipliers.iter().zip(&self.residuals);
        signs.into_iter().position(|(multiplier, residual)| multiplier.abs() > *residual)
    }
}

impl Sides {
    /// The sides of a surface's triangles, numbered like its edges; `None` where a face is no triangle.
    pub fn of(surface: &Surface) -> Option<Self> {
        let between = |a: usize, b: usize| surface.topology().edge_between(a, b);
        let sides = |face: usize| {
            let [a, b, c] = surface.triangle(face)?;
            Some([between(b, c)?, between(c, a)?, between(a, b)?])
        };
        let triangles: Vec<[usize; 3]> = (0..surface.faces().len()).map(sides).collect::<Option<_>>()?;
        Some(Sides::new(surface.topology().edges().len(), triangles))
    }

    /// The sides of these triangles.
    pub fn new(count: usize, triangles: Vec<[usize; 3]>) -> Self {
        let pairs: Vec<[usize; 2]> = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c]]).collect();
        Sides { parts: components(count, &pairs), triangles }
    }

    /// The number of parts.
    pub fn part_count(&self) -> usize {
        self.parts.iter().max().map_or(0, |last| last + 1)
    }

    /// The cotangent weights of u: half the sum of the cotangents opposite each side. `None` outside the cone.
    pub fn cotangents(&self, u: &[f64]) -> Option<Vec<f64>> {
        let mut weights = vec![0.0; u.len()];
        for sides in &self.triangles {
            let (half, root) = half_gradient(sides.map(|e| u[e]))?;
            (0..3).for_each(|k| weights[sides[k]] += half[k] / (2.0 * root));
        }
        Some(weights)
    }

    /// `E(u)` and the sum of the magnitudes in it. `None` outside the cone.
    pub fn energy(&self, w: &[f64], u: &[f64]) -> Option<(f64, f64)> {
        let mut sum = (0.0, 0.0);
        for (w, u) in w.iter().zip(u) {
            sum = (sum.0 + w * u, sum.1 + (w * u).abs());
        }
        for sides in &self.triangles {
            let (_, root) = half_gradient(sides.map(|e| u[e]))?;
            sum = (sum.0 - 0.5 * root, sum.1 + 0.5 * root);
        }
        Some(sum)
    }

    /// Minimises the energy with `Σ c_e u_e` on each part kept, `c_e` from 1 upwards with the magnitude of w: the cotangents of
    /// slivers are large, and so is their rounding.
    ///
    /// The weights run from those of equilateral triangles to w, as far at once as a few damped steps follow: a triangle that
    /// comes close to the boundary of the cone on the way would come back slowly.
    pub fn minimise(&self, w: &[f64]) -> Result<Minimum, NoMinimum> {
        let mut u = vec![1.0; self.parts.len()];
        let start = self.cotangents(&u).ok_or(NoMinimum::Unsettled)?;
        let average = w.iter().map(|w| w.abs()).sum::<f64>() / w.len() as f64;
        let gauge: Vec<f64> = w.iter().map(|w| 1.0 + w.abs() / average).collect();
        let (mut reached, mut stride, mut steps) = (0.0, 1.0_f64, Vec::new());
        loop {
            let to = (reached + stride).min(1.0);
            let weights: Vec<f64> = w.iter().zip(&start).map(|(w, s)| s + to * (w - s)).collect();
            let (weights, near) = if to == 1.0 { (w, 0.0) } else { (weights.as_slice(), 1e-2) };
            match self.settle(weights, &gauge, &u, near, &mut steps) {
                Ok(minimum) if to == 1.0 => return Ok(Minimum { steps, ..minimum }),
                Ok(minimum) => (u, reached, stride) = (minimum.u, to, 2.0 * stride),
                Err(_) if stride > SHORTEST => stride *= 0.5,
                Err(why) => return Err(why),
            }
        }
    }

    /// Damped Newton steps until one changes u by less than `near` or only by rounding.
    fn settle(
        &self,
        w: &[f64],
        gauge: &[f64],
        start: &[f64],
        near: f64,
        steps: &mut Vec<f64>,
    ) -> Result<Minimum, NoMinimum> {
        let (mut u, mut last) = (start.to_vec(), f64::INFINITY);
        for _ in 0..LIMIT {
            let Step { direction, multipliers, gradient } = self.newton(w, gauge, &u)?;
            let slope: f64 = direction.iter().zip(&gradient).map(|(d, g)| d * g).sum();
            let (energy, size) = self.energy(w, &u).ok_or(NoMinimum::Unsettled)?;
            let rounding = gamma(u.len() + self.triangles.len()) * size;
            let at = |t: f64| u.iter().zip(&direction).map(|(u, d)| u + t * d).collect::<Vec<f64>>();
            let lower = |t: &f64| {
                let to = at(*t);
                let found = self.stays_inside(&u, &to).then(|| self.energy(w, &to)).flatten();
                found.is_some_and(|(e, _)| e <= energy + 1e-4 * t * slope + rounding)
            };
            let t = (0..10).map(|k| 0.5_f64.powi(k)).find(lower).ok_or(NoMinimum::Unsettled)?;
            let change = direction.iter().zip(&u).map(|(d, u)| (t * d / u).abs()).fold(0.0, f64::max);
            u = at(t);
            steps.push(change);
            // Newton's steps square themselves: once they are small and no longer shrink they are rounding.
            let still = change <= 1e-15 || (last < 1e-8 && change >= 0.25 * last);
            if t == 1.0 && (change <= near || still) {
                let residuals = self.residuals(w, gauge, &u, &multipliers)?;
                return Ok(Minimum { u, multipliers, residuals, steps: Vec::new() });
            }
            last = change;
        }
        Err(NoMinimum::Unsettled)
    }

    /// Whether no triangle loses more than nine tenths of its Q: Newton's model of the area is worthless across the
    /// boundary of the cone, and close to it the matrix is nearly singular.
    fn stays_inside(&self, from: &[f64], to: &[f64]) -> bool {
        self.triangles.iter().all(|sides| {
            let root = |u: &[f64]| half_gradient(sides.map(|e| u[e])).map(|(_, root)| root * root);
            root(from).zip(root(to)).is_some_and(|(from, to)| to > 0.1 * from)
        })
    }

    /// A Newton step within the gauge, λ of each part, and the gradient.
    ///
    /// `H u = 0` on each part, so `H d = λ − g` can be solved with one side of each part left out of H, which is then positive
    /// definite, and a multiple of u restores the gauge.
    fn newton(&self, w: &[f64], gauge: &[f64], u: &[f64]) -> Result<Step, NoMinimum> {
        let (n, parts) = (u.len(), self.part_count());
        let cotangents = self.cotangents(u).ok_or(NoMinimum::Unsettled)?;
        let gradient: Vec<f64> = w.iter().zip(&cotangents).map(|(w, c)| w - c).collect();
        let total = self.per_part(u.iter().zip(gauge).map(|(u, c)| u * c));
        let pull = self.per_part(u.iter().zip(&gradient).map(|(u, g)| u * g));
        let multipliers: Vec<f64> = pull.iter().zip(&total).map(|(p, t)| p / t).collect();
        let mut left_out = vec![None; parts];
        for (e, &part) in self.parts.iter().enumerate() {
            if left_out[part].is_none_or(|last: usize| u[e] > u[last]) {
                left_out[part] = Some(e);
            }
        }
        let kept: Vec<usize> = (0..n).filter(|&e| left_out[self.parts[e]] != Some(e)).collect();
        let mut column =
            [kept.iter().map(|&e| multipliers[self.parts[e]] * gauge[e] - gradient[e]).collect::<Vec<f64>>()];
        Ldlt::new(&self.hessian(u)?.submatrix(&kept, &kept))?.solve(&mut column);
        let mut direction = vec![0.0; n];
        kept.iter().zip(&column[0]).for_each(|(&e, d)| direction[e] = *d);
        let drift = self.per_part(direction.iter().zip(gauge).map(|(d, c)| d * c));
        (0..n).for_each(|e| direction[e] -= drift[self.parts[e]] / total[self.parts[e]] * u[e]);
        Ok(Step { direction, multipliers, gradient })
    }

    /// `E″`: of each triangle `(b bᵀ/Q − B)/(2√Q)`, B with −1 on the diagonal and 1 beside it, b = Bu.
    pub fn hessian(&self, u: &[f64]) -> Result<Csr, NoMinimum> {
        let mut triplets = Vec::with_capacity(9 * self.triangles.len());
        for sides in &self.triangles {
            let (b, root) = half_gradient(sides.map(|e| u[e])).ok_or(NoMinimum::Unsettled)?;
            for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
                let form = if i == j { -1.0 } else { 1.0 };
                triplets.push((sides[i], sides[j], (b[i] / root * (b[j] / root) - form) / (2.0 * root)));
            }
        }
        Ok(Csr::from_triplets(u.len(), u.len(), &triplets))
    }

    /// A bound for `|w_e − ½Σcot − λ c_e|/c_e` on each part: the largest found, and what rounding may hide there.
    fn residuals(&self, w: &[f64], gauge: &[f64], u: &[f64], multipliers: &[f64]) -> Result<Vec<f64>, NoMinimum> {
        let cotangents = self.cotangents(u).ok_or(NoMinimum::Unsettled)?;
        let mut hidden = vec![0.0; u.len()];
        for sides in &self.triangles {
            let rounding = rounding(sides.map(|e| u[e])).ok_or(NoMinimum::Unsettled)?;
            (0..3).for_each(|k| hidden[sides[k]] += rounding[k]);
        }
        let mut largest = vec![0.0_f64; multipliers.len()];
        for (e, &part) in self.parts.iter().enumerate() {
            let pull = multipliers[part] * gauge[e];
            let sums = gamma(8) * (w[e].abs() + cotangents[e].abs() + pull.abs());
            let found = (w[e] - cotangents[e] - pull).abs() + sums + hidden[e];
            largest[part] = largest[part].max(found * (1.0 + gamma(4)) / gauge[e]);
        }
        Ok(largest)
    }

    /// The sums over each part, in the order of the sides.
    pub fn per_part(&self, values: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut sums = vec![0.0; self.part_count()];
        values.enumerate().for_each(|(e, v)| sums[self.parts[e]] += v);
        sums
    }
}

/// `g = ½ ∇Q = (u_b + u_c − u_a, …)`, the dot products of the sides at the corners, and √Q; `None` outside the cone.
/// `Q = g_a g_b + g_b g_c + g_c g_a`.
fn half_gradient([a, b, c]: [f64; 3]) -> Option<([f64; 3], f64)> {
    let half = [b + c - a, c + a - b, a + b - c];
    let q = half[0] * half[1] + half[2] * (half[0] + half[1]);
    (a > 0.0 && b > 0.0 && c > 0.0 && q > 0.0 && q.is_finite()).then(|| (half, q.sqrt()))
}

/// A bound for the rounding of the three half cotangents `g/(2√Q)`: each g is two sums off by at most `γ₂ (u_a + u_b + u_c)`, Q
/// by its products and by what the g pass on; twice the terms of first order cover those of higher order while they are small.
fn rounding(u: [f64; 3]) -> Option<[f64; 3]> {
    let (half, root) = half_gradient(u)?;
    let of_half = gamma(2) * u.iter().sum::<f64>();
    let sizes = half.map(f64::abs);
    let products = sizes[0] * sizes[1] + sizes[2] * (sizes[0] + sizes[1]);
    let of_q = gamma(4) * products + 2.0 * of_half * sizes.iter().sum::<f64>();
    let relative = of_q / (2.0 * root * root) + gamma(4);
    Some(sizes.map(|size| 2.0 * (of_half / (2.0 * root) + size / (2.0 * root) * relative)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> Sides {
        Sides::new(6, vec![[0, 1, 2], [0, 3, 4], [1, 3, 5], [2, 4, 5]])
    }

    #[test]
    fn the_right_triangle_has_the_cotangents_one_one_zero_and_the_area_one_half() {
        let one = Sides::new(3, vec![[0, 1, 2]]);
        // Legs of length 1 and their hypotenuse: u = ½, ½, 1.
        assert_eq!(one.cotangents(&[0.5, 0.5, 1.0]).unwrap(), [0.5, 0.5, 0.0]);
        assert_eq!(one.energy(&[0.0; 3], &[0.5, 0.5, 1.0]).unwrap().0, -0.5);
        assert!(one.cotangents(&[0.5, 0.5, 2.0]).is_none(), "1, 1, 2 is straight");
    }

    #[test]
    fn the_hessian_is_the_derivative_of_the_gradient_and_u_is_its_kernel() {
        let (sides, u) = (tetrahedron(), [1.0, 1.1, 0.9, 1.2, 1.3, 0.8]);
        let hessian = sides.hessian(&u).unwrap();
        assert!(hessian.mul(&u).iter().all(|r| r.abs() < 1e-14));
        for k in 0..6 {
            let at = |t: f64| {
                let mut moved = u;
                moved[k] += t;
                sides.cotangents(&moved).unwrap()
            };
            for (e, (plus, minus)) in at(1e-5).iter().zip(at(-1e-5)).enumerate() {
                assert!((hessian.at(e, k) + (plus - minus) / 2e-5).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn a_tetrahedron_is_found_again_and_a_wrong_weight_is_not_a_metric() {
        let (sides, u) = (tetrahedron(), [1.0, 1.1, 0.9, 1.2, 1.3, 0.7]);
        let w = sides.cotangents(&u).unwrap();
        let found = sides.minimise(&w).unwrap();
        assert!(found.u.iter().zip(&u).all(|(f, u)| (f / found.u[0] - u).abs() < 1e-13));
        assert!(found.multipliers[0].abs() < 1e-14);
        for wrong in [-1e-3, 1e-3] {
            let mut w = w.clone();
            w[2] += wrong;
            let found = sides.minimise(&w).unwrap();
            assert!(found.multipliers[0] * wrong > 0.0 && found.residuals[0] < 1e-3 * found.multipliers[0].abs());
        }
    }
}
