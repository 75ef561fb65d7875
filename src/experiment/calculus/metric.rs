//! Riemannian metrics with polynomial entries on a cube, and the operators they make of forms.
//!
//! # Definition
//! With the inverse metric `g^ij`, `√g` a constant, and minors `g^IK` of the inverse for sets of k differentials:
//!
//! ```text
//! ⟨α, β⟩ = Σ α_I g^IK β_K,    (⋆β)_(complement of I) = sign(I, complement) √g Σ_K g^IK β_K,    so that α ∧ ⋆β = ⟨α, β⟩ √g dx
//! d*β = (−1)^(n(k+1)+1) ⋆d⋆β on k-forms,    Δ = dd* + d*d
//! ```

use super::form::{Form, masks};
use super::polynomial::{Polynomial, divergence};
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::scalar::Rational;

/// A metric, by its inverse; its determinant is constant.
pub struct Metric {
    inverse: Vec<Vec<Polynomial>>,
    /// √g.
    density: Rational,
}

impl Metric {
    /// `g⁻¹ = A Aᵀ`, A the product of a lower and an upper triangular matrix with ones on the diagonal and random polynomials
    /// beside it: not constant, not flat, determinant 1.
    pub fn random(n: usize, stream: &mut Stream) -> Self {
        let mut triangle = |lower: bool| -> Vec<Vec<Polynomial>> {
            let mut entry = |i: usize, j: usize| match (i == j, (i > j) == lower) {
                (true, _) => Polynomial::constant(n, Rational::ONE),
                (false, true) => Polynomial::random(n, 1, stream),
                (false, false) => Polynomial::zero(n),
            };
            (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
        };
        let (lower, upper) = (triangle(true), triangle(false));
        let product = |a: &[Vec<Polynomial>], b: &dyn Fn(usize, usize) -> Polynomial| -> Vec<Vec<Polynomial>> {
            let entry = |i: usize, j: usize| (0..n).fold(Polynomial::zero(n), |s, k| &s + &(&a[i][k] * &b(k, j)));
            (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
        };
        let a = product(&lower, &|k, j| upper[k][j].clone());
        Metric { inverse: product(&a, &|k, j| a[j][k].clone()), density: Rational::ONE }
    }

    /// The flat metric with this inverse and this √g, the square root of its determinant.
    pub fn flat(inverse: &Dense<Rational>, density: Rational) -> Self {
        let n = inverse.rows();
        let entry = |i: usize, j: usize| Polynomial::constant(n, inverse.at(i, j).clone());
        Metric { inverse: (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect(), density }
    }

    /// The metric of orthonormal coordinates.
    pub fn euclidean(n: usize) -> Self {
        let unit = |i, j| if i == j { Rational::ONE } else { Rational::ZERO };
        Metric::flat(&Dense::from_fn(n, n, unit), Rational::ONE)
    }

    /// The inverse metric.
    pub fn inverse(&self) -> &[Vec<Polynomial>] {
        &self.inverse
    }

    /// `Δf = −(1/√g) Σ ∂_i(√g g^ij ∂_j f)`, √g constant.
    pub fn laplacian(&self, f: &Polynomial) -> Polynomial {
        let gradient = f.gradient();
        let raised = self
            .inverse
            .iter()
            .map(|row| row.iter().zip(&gradient).fold(Polynomial::zero(f.variables()), |s, (g, d)| &s + &(g * d)));
        -&divergence(&raised.collect::<Vec<_>>())
    }

    /// `Σ_K g^IK β_K` for a set I.
    fn raised(&self, form: &Form, set: u32) -> Polynomial {
        let n = form.dimension();
        masks(n, form.degree()).into_iter().fold(Polynomial::zero(n), |sum, other| {
            let part = form.part(other);
            if part.is_zero() { sum } else { &sum + &(&self.minor(set, other) * &part) }
        })
    }

    /// The minor of the inverse in the rows and columns of two sets, expanded along its first row.
    fn minor(&self, rows: u32, columns: u32) -> Polynomial {
        let n = self.inverse.len();
        if rows == 0 {
            return Polynomial::constant(n, Rational::ONE);
        }
        let (i, left) = (rows.trailing_zeros() as usize, rows & (rows - 1));
        let chosen = (0..n).filter(|j| columns >> j & 1 == 1);
        chosen.enumerate().fold(Polynomial::zero(n), |sum, (place, j)| {
            let term = &self.inverse[i][j] * &self.minor(left, columns & !(1 << j));
            if place % 2 == 0 { &sum + &term } else { &sum - &term }
        })
    }

    /// `⟨α, β⟩ √g`, whose integral is the inner product of two forms of one degree.
    pub fn paired(&self, alpha: &Form, beta: &Form) -> Polynomial {
        let n = alpha.dimension();
        let terms = masks(n, alpha.degree()).into_iter().filter(|&set| !alpha.part(set).is_zero());
        let sum = terms.fold(Polynomial::zero(n), |s, set| &s + &(&alpha.part(set) * &self.raised(beta, set)));
        sum.times(&self.density)
    }

    /// The Hodge star.
    pub fn star(&self, form: &Form) -> Form {
        let (n, k) = (form.dimension(), form.degree());
        let all = (1_u32 << n) - 1;
        let parts = masks(n, k).into_iter().map(|set| {
            let factor = self.density.clone() * super::whole(complement_sign(n, set));
            (all & !set, self.raised(form, set).times(&factor))
        });
        Form::new(n, n - k, parts)
    }

    /// `d*` by the star; `None` of a function, where it is zero for want of a degree below.
    pub fn codifferential(&self, form: &Form) -> Option<Form> {
        let (n, k) = (form.dimension(), form.degree());
        if k == 0 {
            return None;
        }
        let inner = self.star(&self.star(form).d());
        let sign = super::whole(if (n * (k + 1) + 1).is_multiple_of(2) { 1 } else { -1 });
        Some(Form::new(n, k - 1, masks(n, k - 1).into_iter().map(|m| (m, inner.part(m).times(&sign)))))
    }

    /// `Δ = dd* + d*d`.
    pub fn hodge_laplacian(&self, form: &Form) -> Form {
        let (n, k) = (form.dimension(), form.degree());
        let zero = || Form::new(n, k, []);
        let first = self.codifferential(form).map_or_else(zero, |f| f.d());
        let second = if k < n { self.codifferential(&form.d()).unwrap_or_else(zero) } else { zero() };
        first.plus(&second)
    }
}

/// The sign of the permutation that puts a set of differentials, ascending, before the others, ascending.
pub fn complement_sign(n: usize, set: u32) -> i64 {
    let inside = (0..n).filter(|k| set >> k & 1 == 1);
    let before: u32 = inside.map(|k| (!set & ((1 << k) - 1)).count_ones()).sum();
    if before.is_multiple_of(2) { 1 } else { -1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_star_of_euclidean_space_turns_the_differentials_round() {
        // ⋆dx = dy ∧ dz, ⋆dy = −dx ∧ dz, ⋆dz = dx ∧ dy; in the plane ⋆dx = dy, ⋆dy = −dx.
        let one = |n: usize, set: u32| {
            Form::new(n, set.count_ones() as usize, [(set, Polynomial::constant(n, Rational::ONE))])
        };
        let found =
            |n: usize, set: u32, image: u32| Metric::euclidean(n).star(&one(n, set)).part(image).constant_term();
        assert_eq!([found(3, 1, 6), found(3, 2, 5), found(3, 4, 3)], [1, -1, 1].map(super::super::whole));
        assert_eq!([found(2, 1, 2), found(2, 2, 1)], [1, -1].map(super::super::whole));
    }

    #[test]
    fn the_hodge_laplacian_of_euclidean_space_takes_each_coefficient_by_itself() {
        let mut stream = Stream::new(1, "hodge");
        for (n, k) in [(1, 0), (1, 1), (2, 0), (2, 1), (2, 2), (3, 1), (3, 2)] {
            let form = Form::random(n, k, 3, &mut stream);
            let found = Metric::euclidean(n).hodge_laplacian(&form);
            assert!(masks(n, k).into_iter().all(|m| found.part(m) == form.part(m).laplacian()), "{n} {k}");
        }
    }

    #[test]
    fn the_star_twice_is_a_sign() {
        let mut stream = Stream::new(2, "star");
        for (n, k) in (2..=3).flat_map(|n| (0..=n).map(move |k| (n, k))) {
            let (metric, form) = (Metric::random(n, &mut stream), Form::random(n, k, 1, &mut stream));
            let (twice, sign) = (metric.star(&metric.star(&form)), if (k * (n - k)) % 2 == 0 { 1 } else { -1 });
            let same = |m| twice.part(m) == form.part(m).times(&super::super::whole(sign));
            assert!(masks(n, k).into_iter().all(same), "{n} {k}");
        }
    }
}
