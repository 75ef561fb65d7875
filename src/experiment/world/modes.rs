//! Fourier modes of differential forms on flat tori.
//!
//! # Definition
//! On ℝⁿ/ℤⁿ with a constant metric G the forms `a e^(2πi ξ·x)`, ξ ∈ ℤⁿ and a ∈ Λᵏ, are a mode: d takes it to the mode
//! `2πi ξ∧a` of the next degree, modes of different ξ are orthogonal, and the inner product on Λᵏ is the matrix of k×k minors of
//! `G⁻¹`. So d, d* and Δ are matrices for each ξ. They are written here in units of 2πi, −2πi and 4π²:
//!
//! ```text
//! d = ξ∧,    d* = G_(k−1)⁻¹ (ξ∧)ᵀ G_k,    Δ = dd* + d*d = |ξ|² = Σ g^ij ξ_i ξ_j
//! ```
//! A smooth form is the sum of its modes, so that a statement on all modes is one on all trigonometric forms.

use crate::experiment::calculus::{complement_sign, determinant, masks, ratio, wedge_sign, whole};
use crate::experiment::world::stage::Stage;
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::scalar::{Rational, Scalar};

/// A flat torus by its metric.
pub struct Torus {
    /// The metric in words.
    pub name: String,
    metric: Dense<Rational>,
    inverse: Dense<Rational>,
    /// `G = AᵀA`, the rows of A an orthonormal coframe, where there is a rational one.
    coframe: Option<Dense<Rational>>,
    /// The inner products of all degrees.
    inner: Vec<Dense<Rational>>,
}

impl Torus {
    /// The torus of a metric; `None` unless it is symmetric and positive definite.
    pub fn new(metric: Dense<Rational>) -> Option<Self> {
        let positive = metric.asymmetry().is_none() && metric.eliminate().is_definite();
        let inverse = metric.inverse().filter(|_| positive)?;
        let inner = (0..=metric.rows()).map(|k| compound(&inverse, k)).collect();
        let rows = (0..metric.rows())
            .map(|i| (0..metric.rows()).map(|j| metric.at(i, j).to_string()).collect::<Vec<_>>().join(" "));
        let name = format!("the torus of the metric [{}]", rows.collect::<Vec<_>>().join("; "));
        Some(Torus { name, metric, inverse, coframe: None, inner })
    }

    /// The torus of the metric `AᵀA`; `None` unless `det A > 0`.
    pub fn of_coframe(a: Dense<Rational>) -> Option<Self> {
        let oriented = determinant(&a) > Rational::ZERO;
        let torus = Torus::new(a.transpose().product(&a)).filter(|_| oriented)?;
        Some(Torus { coframe: Some(a), ..torus })
    }

    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.metric.rows()
    }

    /// The inner product of k-forms.
    pub fn inner(&self, k: usize) -> &Dense<Rational> {
        &self.inner[k]
    }

    /// The inverse metric.
    pub fn inverse(&self) -> &Dense<Rational> {
        &self.inverse
    }

    /// An orthonormal coframe, where there is a rational one.
    pub fn coframe(&self) -> Option<&Dense<Rational>> {
        self.coframe.as_ref()
    }

    /// `Σ g^ij ξ_i ξ_j`.
    pub fn squared_length(&self, xi: &[i64]) -> Rational {
        self.inverse.quadratic_form(&xi.iter().map(|&x| whole(x)).collect::<Vec<_>>())
    }

    /// The mode ξ in degree k.
    pub fn stage(&self, xi: &[i64], k: usize) -> Option<Stage> {
        let (n, none) = (self.dimension(), Dense::from_fn(0, 0, |_, _| Rational::ZERO));
        let size = self.inner[k].rows();
        let before = if k == 0 { Dense::from_fn(size, 0, |_, _| Rational::ZERO) } else { wedge(xi, k - 1) };
        let after = if k == n { Dense::from_fn(0, size, |_, _| Rational::ZERO) } else { wedge(xi, k) };
        let below = if k == 0 { &none } else { &self.inner[k - 1] };
        let above = if k == n { &none } else { &self.inner[k + 1] };
        Stage::new(format!("degree {k}, ξ = {xi:?} on {}", self.name), before, after, [below, &self.inner[k], above])
    }

    /// `d*` on k-forms as the contraction with the vector `G⁻¹ξ`.
    pub fn contraction(&self, xi: &[i64], k: usize) -> Dense<Rational> {
        let (n, v) = (self.dimension(), self.inverse.mul(&xi.iter().map(|&x| whole(x)).collect::<Vec<_>>()));
        let (rows, columns) = (masks(n, k - 1), masks(n, k));
        Dense::from_fn(rows.len(), columns.len(), |i, j| {
            let axis = (rows[i] ^ columns[j]).trailing_zeros() as usize;
            let contained = columns[j] & rows[i] == rows[i];
            let sign = if contained { wedge_sign(axis, rows[i]) } else { None };
            sign.map_or(Rational::ZERO, |s| whole(s) * v[axis].clone())
        })
    }

    /// The Hodge star of k-forms over √g, from `α ∧ ⋆β = ⟨α, β⟩ √g dx`.
    fn star_over_density(&self, k: usize) -> Dense<Rational> {
        turned(self.dimension(), k).product(&self.inner[k])
    }

    /// Whether the star over √g, followed by that of the degree n − k, is not `±1/det G`.
    pub fn star_is_no_square_root(&self, k: usize) -> bool {
        let n = self.dimension();
        let twice = self.star_over_density(n - k).product(&self.star_over_density(k));
        let sign = whole(if (k * (n - k)).is_multiple_of(2) { 1 } else { -1 });
        let expected = |i, j| if i == j { sign.clone() / determinant(&self.metric) } else { Rational::ZERO };
        (0..twice.rows()).any(|i| (0..twice.rows()).any(|j| *twice.at(i, j) != expected(i, j)))
    }

    /// The Hodge star of k-forms from an orthonormal coframe θ = A dx: `⋆θ_I = ±θ_(complement of I)`. No inner product enters.
    pub fn star_of_coframe(&self, k: usize) -> Option<Dense<Rational>> {
        let (n, a) = (self.dimension(), self.coframe.as_ref()?);
        let to_coframe = compound(&a.inverse()?, k).transpose();
        Some(compound(a, n - k).transpose().product(&turned(n, k).product(&to_coframe)))
    }

    /// `d*` on k-forms as `(−1)^(n(k+1)) ⋆d⋆` in these units, which contain the sign of −2πi: once by the star over √g, whose square is
    /// put in afterwards, and by the coframe, where there is one.
    pub fn codifferentials_of_stars(&self, xi: &[i64], k: usize) -> Vec<Dense<Rational>> {
        let n = self.dimension();
        let sign = whole(if (n * (k + 1)).is_multiple_of(2) { 1 } else { -1 });
        let between = |factor: Rational, first: Dense<Rational>, second: Dense<Rational>| {
            let product = second.product(&wedge(xi, n - k).product(&first));
            let factor = sign.clone() * factor;
            Dense::from_fn(product.rows(), product.columns(), |i, j| {
                (factor.clone() * product.at(i, j).clone()).reduced()
            })
        };
        let over_density =
            between(determinant(&self.metric), self.star_over_density(k), self.star_over_density(n - k + 1));
        let stars = self.star_of_coframe(k).zip(self.star_of_coframe(n - k + 1));
        [over_density].into_iter().chain(stars.map(|(s, t)| between(Rational::ONE, s, t))).collect()
    }
}

/// The matrix of `a ↦ ξ ∧ a` from k-forms.
pub fn wedge(xi: &[i64], k: usize) -> Dense<Rational> {
    let (rows, columns) = (masks(xi.len(), k + 1), masks(xi.len(), k));
    Dense::from_fn(rows.len(), columns.len(), |i, j| {
        let axis = (rows[i] ^ columns[j]).trailing_zeros() as usize;
        let contained = rows[i] & columns[j] == columns[j];
        let sign = if contained { wedge_sign(axis, columns[j]) } else { None };
        whole(sign.map_or(0, |s| s * xi[axis]))
    })
}

/// The signed permutation that takes a set of differentials to its complement.
fn turned(n: usize, k: usize) -> Dense<Rational> {
    let (rows, columns, all) = (masks(n, n - k), masks(n, k), (1_u32 << n) - 1);
    Dense::from_fn(rows.len(), columns.len(), |i, j| {
        whole(if rows[i] == all & !columns[j] { complement_sign(n, columns[j]) } else { 0 })
    })
}

/// The matrix of k×k minors.
fn compound(a: &Dense<Rational>, k: usize) -> Dense<Rational> {
    let sets: Vec<Vec<usize>> =
        masks(a.rows(), k).into_iter().map(|mask| (0..a.rows()).filter(|i| mask >> i & 1 == 1).collect()).collect();
    Dense::from_fn(sets.len(), sets.len(), |i, j| determinant(&a.submatrix(&sets[i], &sets[j])))
}

/// The frequencies with components of at most `largest`.
pub fn frequencies(n: usize, largest: i64) -> Vec<Vec<i64>> {
    let base = 2 * largest as usize + 1;
    let digit = |code: usize, k: usize| (code / base.pow(k as u32) % base) as i64 - largest;
    (0..base.pow(n as u32)).map(|code| (0..n).map(|k| digit(code, k)).collect()).collect()
}

/// Tori of one to three dimensions: of orthonormal coordinates, of the lattices A₂ and A₃, whose √g is not rational or whose coframe is
/// not, of random coframes, and of random metrics.
pub fn tori(random: usize, stream: &mut Stream) -> Vec<Torus> {
    let unit = |n: usize| Dense::from_fn(n, n, |i, j| whole(i64::from(i == j)));
    let lattice =
        |n: usize| Dense::from_fn(n, n, |i, j| whole(if i == j { 2 } else { -i64::from(i.abs_diff(j) == 1) }));
    let mut all: Vec<Torus> = (1..=3).filter_map(|n| Torus::of_coframe(unit(n))).collect();
    all.extend((2..=3).filter_map(|n| Torus::new(lattice(n))));
    for n in 1..=3 {
        let mut drawn = Vec::new();
        while drawn.len() < 2 * random {
            let entries: Vec<Rational> = (0..n * n).map(|_| ratio(stream.below(9) as i64 - 4, 2)).collect();
            let a = Dense::from_fn(n, n, |i, j| entries[i * n + j].clone());
            let square = a.transpose().product(&a);
            let more = ratio(1 + stream.below(5) as i64, 3);
            let other = Dense::from_fn(n, n, |i, j| {
                if i == j { square.at(i, j).clone() + more.clone() } else { square.at(i, j).clone() }
            });
            if let (Some(torus), Some(other)) = (Torus::of_coframe(a), Torus::new(other)) {
                drawn.extend([torus, other]);
            }
        }
        all.extend(drawn);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_covector_twice_is_zero_and_the_wedge_of_two_is_the_cross_product() {
        let (xi, eta) = ([2, -1, 3], [1, 4, -2]);
        let zero = wedge(&xi, 1).product(&wedge(&xi, 0));
        assert!((0..3).all(|i| *zero.at(i, 0) == Rational::ZERO));
        // dx∧dy, dx∧dz, dy∧dz.
        let product = wedge(&xi, 1).mul(&eta.map(whole));
        assert_eq!(product, [9, -7, -10].map(whole));
        let volume = wedge(&[1, 1, 1], 2).mul(&product);
        assert_eq!(volume, [whole(9 + 7 - 10)], "det of (1, 1, 1), ξ and η");
    }

    #[test]
    fn the_tori_are_of_three_dimensions_skew_and_with_and_without_a_coframe() {
        let all = tori(2, &mut Stream::new(1, "tori"));
        assert_eq!(all.len(), 3 + 2 + 12);
        assert!([1, 2, 3].iter().all(|&n| all.iter().any(|t| t.dimension() == n && t.coframe().is_some())));
        assert!(
            all.iter().any(|t| t.dimension() == 3 && *t.inner(1).at(0, 2) != Rational::ZERO && t.coframe().is_none())
        );
        assert!(Torus::new(Dense::from_fn(2, 2, |_, _| whole(1))).is_none(), "not definite");
        assert_eq!((frequencies(2, 2).len(), frequencies(3, 1).len()), (25, 27));
    }
}
