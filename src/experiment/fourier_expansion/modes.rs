//! All eigenpairs of a pencil with bounds on what their rounding amounts to, and the exact coefficients of a function.
//!
//! # The bounds
//! A computed sum of k products is off by at most `γ_k` times the sum of their magnitudes, in whatever order (Higham 2002, section 3.1). `v_iᵀMv_j` is
//! n + m products deep, m the longest row of M, so that
//!
//! ```text
//! ‖VᵀMV − I‖_F ≤ ‖computed‖_F + γ_(n+m+2) ‖ |V|ᵀ|M||V| ‖_F
//! |(Lv − λMv)_i| ≤ |computed| + γ_(l+m+3) (|L||v| + |λ||M||v|)_i
//! ```
//! and both norms are evaluated with one more factor for the sums of squares. Products below `2⁻¹⁰²²` lose `2⁻¹⁰⁷⁴` each, `2⁻¹⁰²²` altogether.
//! `‖M^(−½)r‖² ≤ rᵀ diag(M)⁻¹ r/c` with `M ≥ c diag(M)`, c = 1 for a lumped mass, else ¼, which `linalg::spectrum` has confirmed.

use crate::linalg::Csr;
use crate::linalg::backward::gamma;
use crate::linalg::spectrum::lowest;
use crate::scalar::{Rational, Scalar, sum};

/// Eigenpairs of `L u = λ M u`.
pub struct Modes {
    /// Domain and operator, in words.
    pub name: String,
    stiffness: Csr,
    mass: Csr,
    values: Vec<f64>,
    vectors: Vec<Vec<f64>>,
    /// A bound for `‖VᵀMV − I‖_F`.
    pub epsilon: f64,
    /// A bound for `‖M^(−½)(LV − MVΛ)‖_F`.
    pub rho: f64,
}

impl Modes {
    /// All eigenpairs of a pencil.
    ///
    /// # Errors
    /// What the eigensolver says.
    pub fn of(name: String, stiffness: Csr, mass: Csr) -> Result<Self, String> {
        let spectrum = lowest(&stiffness, &mass, stiffness.rows(), 0).map_err(|e| e.to_string())?;
        let vectors = (0..spectrum.values.len()).map(|j| spectrum.vector(j).to_vec()).collect();
        Modes::from_pairs(name, stiffness, mass, spectrum.values, vectors).ok_or_else(|| "not finite".into())
    }

    /// Whatever pairs somebody has; `None` where a number is not finite.
    pub fn from_pairs(
        name: String,
        stiffness: Csr,
        mass: Csr,
        values: Vec<f64>,
        vectors: Vec<Vec<f64>>,
    ) -> Option<Self> {
        let mut modes = Modes { name, stiffness, mass, values, vectors, epsilon: 0.0, rho: 0.0 };
        (modes.epsilon, modes.rho) = (modes.departure(), modes.residual());
        (modes.epsilon.is_finite() && modes.rho.is_finite()).then_some(modes)
    }

    /// The number of rows.
    pub fn size(&self) -> usize {
        self.stiffness.rows()
    }

    /// The eigenvalues, ascending.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// An eigenvector.
    pub fn vector(&self, j: usize) -> &[f64] {
        &self.vectors[j]
    }

    /// The largest magnitude of an eigenvalue.
    pub fn largest(&self) -> f64 {
        self.values.iter().fold(0.0, |m, v| m.max(v.abs()))
    }

    /// The M-product of two functions, in floating point.
    pub fn inner(&self, u: &[f64], v: &[f64]) -> f64 {
        self.mass.mul(u).iter().zip(v).map(|(a, b)| a * b).sum()
    }

    /// What rounding explains of ε and of ρ relative to the largest eigenvalue; see the experiment.
    pub fn tolerance(&self) -> f64 {
        let n = self.size();
        8.0 * (n as f64).powf(1.5) * gamma(n)
    }

    fn departure(&self) -> f64 {
        let (n, m) = (self.size(), longest(&self.mass));
        let magnitudes = self.mass.map(|_, _, v| v.abs());
        let (mut square, mut sizes) = (0.0, 0.0);
        for (j, v) in self.vectors.iter().enumerate() {
            let image = self.mass.mul(v);
            let size = magnitudes.mul(&absolute(v));
            for (i, w) in self.vectors.iter().enumerate() {
                let product: f64 = w.iter().zip(&image).map(|(a, b)| a * b).sum();
                let bound: f64 = w.iter().zip(&size).map(|(a, b)| a.abs() * b).sum();
                let departure = product - f64::from(u8::from(i == j));
                square += departure * departure;
                sizes += bound * bound;
            }
        }
        let more = 1.0 + gamma(n * n + n + m + 8);
        (square.sqrt() + gamma(n + m + 2) * sizes.sqrt()) * more + f64::MIN_POSITIVE
    }

    fn residual(&self) -> f64 {
        let lumped = self.mass.entries().all(|(i, j, v)| i == j || *v == 0.0);
        let domination = if lumped { 1.0 } else { 0.25 };
        let absolutes = [&self.stiffness, &self.mass].map(|a| a.map(|_, _, v| v.abs()));
        let terms = longest(&self.stiffness) + longest(&self.mass) + 3;
        let mut square = 0.0;
        for (lambda, v) in self.values.iter().zip(&self.vectors) {
            let (lv, mv) = (self.stiffness.mul(v), self.mass.mul(v));
            let sizes = absolutes.each_ref().map(|a| a.mul(&absolute(v)));
            for i in 0..self.size() {
                let size = sizes[0][i] + lambda.abs() * sizes[1][i];
                let bound = (lv[i] - lambda * mv[i]).abs() + gamma(terms) * size;
                square += bound * bound / self.mass.at(i, i);
            }
        }
        let n = self.size();
        (square / domination).sqrt() * (1.0 + gamma(n * n + terms + 8)) + f64::MIN_POSITIVE
    }

    /// Vectors and values, to be tampered with.
    #[cfg(test)]
    pub fn pairs(&self) -> (Vec<Vec<f64>>, Vec<f64>) {
        (self.vectors.clone(), self.values.clone())
    }

    /// `‖VᵀMV − I‖_F²`, exactly.
    #[cfg(test)]
    pub fn exact_epsilon_squared(&self) -> Option<Rational> {
        let (mass, mut total) = (self.mass.exact()?, Rational::ZERO);
        let vectors: Vec<Vec<Rational>> = self.vectors.iter().map(|v| rational(v)).collect::<Option<_>>()?;
        for (j, v) in vectors.iter().enumerate() {
            let image = mass.mul(v);
            for (i, w) in vectors.iter().enumerate() {
                let one = if i == j { Rational::ONE } else { Rational::ZERO };
                let departure = dot(w, &image) - one;
                total += departure.clone() * departure;
            }
        }
        Some(total)
    }
}

fn longest(a: &Csr) -> usize {
    (0..a.rows()).map(|i| a.row(i).len()).max().unwrap_or(0)
}

fn absolute(v: &[f64]) -> Vec<f64> {
    v.iter().map(|x| x.abs()).collect()
}

fn rational(v: &[f64]) -> Option<Vec<Rational>> {
    v.iter().map(|x| Rational::exactly(*x)).collect()
}

fn dot(a: &[Rational], b: &[Rational]) -> Rational {
    sum(a.iter().zip(b).map(|(x, y)| x.clone() * y.clone()))
}

/// The coefficients `c = VᵀMu` of a function and what they are compared with, exactly.
pub struct Coefficients {
    /// c.
    pub exact: Vec<Rational>,
    /// `Σ c_j²`.
    pub sum: Rational,
    /// `uᵀMu`.
    pub square: Rational,
    /// `Σ λ_j c_j²`.
    pub weighted: Rational,
    /// `uᵀLu`.
    pub energy: Rational,
    /// `‖u − Vc‖²` in the norm of M, c rounded to `f64`.
    pub rest: Rational,
}

impl Coefficients {
    /// The coefficients; `None` where a number is not finite.
    pub fn of(modes: &Modes, u: &[f64]) -> Option<Self> {
        let (stiffness, mass, u) = (modes.stiffness.exact()?, modes.mass.exact()?, rational(u)?);
        let (image, values) = (mass.mul(&u), rational(&modes.values)?);
        let vectors: Vec<Vec<Rational>> = modes.vectors.iter().map(|v| rational(v)).collect::<Option<_>>()?;
        let exact: Vec<Rational> = vectors.iter().map(|v| dot(v, &image)).collect();
        let mut rest = u.clone();
        for (c, v) in exact.iter().zip(&vectors) {
            let rounded = Rational::exactly(c.approximate())?;
            rest.iter_mut().zip(v).for_each(|(r, v)| *r = r.clone() - rounded.clone() * v.clone());
        }
        let squares: Vec<Rational> = exact.iter().map(|c| c.clone() * c.clone()).collect();
        Some(Coefficients {
            sum: sum(squares.iter().cloned()),
            square: dot(&u, &image),
            weighted: dot(&values, &squares),
            energy: dot(&u, &stiffness.mul(&u)),
            rest: mass.quadratic_form(&rest),
            exact,
        })
    }
}
