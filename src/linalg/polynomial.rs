//! Polynomials in one variable over any [`Scalar`], for proofs over the rationals: characteristic polynomials, and their real
//! roots counted by signs.
//!
//! # Definition
//! `p(x) = det(xI − A) = xⁿ + c_(n−1) xⁿ⁻¹ + … + c_0`, by Faddeev and LeVerrier:
//! ```text
//! B_1 = I,   c_(n−k) = −tr(A B_k)/k,   B_(k+1) = A B_k + c_(n−k) I
//! ```
//!
//! # Two ways to count roots
//! * Where all roots are real, as of a symmetric matrix, the sign changes of the coefficients of `p(x + t)` are the roots above t,
//!   each as often as it is multiple: Descartes' bound is attained. [`Polynomial::real_roots`].
//! * Sturm's chain counts the distinct real roots of any polynomial. [`Sturm`].
//!
//! # Limitations
//! Over `f64` nothing is proved here. Cost over the rationals: O(n⁴) products of numbers that grow with n; some thirty rows.
//!
//! # References
//! \[gantmacher1959\] chapter IV §5 for the characteristic polynomial; \[basu-pollack-roy2006\] sections 2.2.1 and 8.3 for both counts.

use std::cmp::Ordering;

use super::Dense;
use crate::scalar::Scalar;

/// A polynomial by its coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct Polynomial<S> {
    /// Ascending; the last one is not zero.
    coefficients: Vec<S>,
}

/// How many roots of a polynomial lie on either side of a number, each as often as it is multiple.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Roots {
    /// Below it.
    pub below: usize,
    /// At it.
    pub at: usize,
    /// Above it.
    pub above: usize,
}

impl<S: Scalar> Polynomial<S> {
    /// The polynomial with these coefficients, ascending.
    pub fn new(mut coefficients: Vec<S>) -> Self {
        while coefficients.last().is_some_and(|c| c.cmp_zero() == Ordering::Equal) {
            coefficients.pop();
        }
        Polynomial { coefficients }
    }

    /// `det(xI − A)`.
    pub fn characteristic(a: &Dense<S>) -> Self {
        let n = a.rows();
        let mut coefficients = vec![S::zero(); n];
        coefficients.push(whole(1));
        let mut b = Dense::from_fn(n, n, |i, j| whole(usize::from(i == j)));
        for k in 1..=n {
            let mut product = a.product(&b);
            let trace = (0..n).fold(S::zero(), |sum, i| sum + product.at(i, i).clone());
            let c = (-(trace / whole(k))).reduced();
            (0..n).for_each(|i| product.add_to(i, i, c.clone()));
            coefficients[n - k] = c;
            b = product;
        }
        Polynomial::new(coefficients)
    }

    /// The coefficients, ascending; none of the zero polynomial.
    pub fn coefficients(&self) -> &[S] {
        &self.coefficients
    }

    /// The degree; `None` of the zero polynomial.
    pub fn degree(&self) -> Option<usize> {
        self.coefficients.len().checked_sub(1)
    }

    /// The value at x.
    pub fn at(&self, x: &S) -> S {
        self.coefficients.iter().rev().fold(S::zero(), |value, c| (value * x.clone() + c.clone()).reduced())
    }

    /// The value at a square matrix.
    pub fn at_matrix(&self, a: &Dense<S>) -> Dense<S> {
        let n = a.rows();
        let zero = Dense::from_fn(n, n, |_, _| S::zero());
        self.coefficients.iter().rev().fold(zero, |value, c| {
            let mut next = a.product(&value);
            (0..n).for_each(|i| next.add_to(i, i, c.clone()));
            next
        })
    }

    /// The product with another one.
    pub fn times(&self, other: &Self) -> Self {
        let (m, n) = (self.coefficients.len(), other.coefficients.len());
        let coefficient = |k: usize| {
            let terms = (0..m).filter(|i| (i + 1..=i + n).contains(&(k + 1)));
            let term = |i: usize| self.coefficients[i].clone() * other.coefficients[k - i].clone();
            terms.fold(S::zero(), |sum, i| sum + term(i)).reduced()
        };
        Polynomial::new((0..(m + n).saturating_sub(1)).map(coefficient).collect())
    }

    /// The derivative.
    pub fn derivative(&self) -> Self {
        let term = |(k, c): (usize, &S)| (c.clone() * whole(k)).reduced();
        Polynomial::new(self.coefficients.iter().enumerate().skip(1).map(term).collect())
    }

    /// Quotient and remainder; `None` where the divisor is zero.
    pub fn divided(&self, by: &Self) -> Option<(Self, Self)> {
        let (leading, degree) = (by.coefficients.last()?, by.degree()?);
        let mut rest = self.coefficients.clone();
        let mut quotient = vec![S::zero(); rest.len().saturating_sub(degree)];
        for k in (0..quotient.len()).rev() {
            let factor = (rest[k + degree].clone() / leading.clone()).reduced();
            for (i, c) in by.coefficients.iter().enumerate() {
                rest[k + i] = (rest[k + i].clone() - factor.clone() * c.clone()).reduced();
            }
            quotient[k] = factor;
        }
        rest.truncate(degree);
        Some((Polynomial::new(quotient), Polynomial::new(rest)))
    }

    /// The polynomial with each root once, with the same leading coefficient.
    pub fn without_multiplicities(&self) -> Self {
        let (mut a, mut b) = (self.clone(), self.derivative());
        while let Some((_, rest)) = a.divided(&b) {
            (a, b) = (b, rest.of_unit_size());
        }
        // The last divisor is the greatest common one of both.
        let Some(leading) = a.coefficients.last().cloned() else { return a };
        let common = Polynomial { coefficients: a.coefficients.into_iter().map(|c| c / leading.clone()).collect() };
        self.divided(&common).map_or_else(|| self.clone(), |(quotient, _)| quotient)
    }

    /// Divided by the magnitude of its leading coefficient, which keeps the numbers of a chain of remainders short.
    fn of_unit_size(self) -> Self {
        let Some(size) = self.coefficients.last().map(Scalar::magnitude) else { return self };
        Polynomial { coefficients: self.coefficients.into_iter().map(|c| (c / size.clone()).reduced()).collect() }
    }

    /// The roots on either side of t, of a polynomial all of whose roots are real; of another one this means nothing.
    pub fn real_roots(&self, t: &S) -> Roots {
        let shifted = self.shifted(t);
        let zero = |c: &&S| c.cmp_zero() == Ordering::Equal;
        let at = shifted.iter().take_while(zero).count();
        let signs: Vec<Ordering> = shifted.iter().filter(|c| !zero(c)).map(Scalar::cmp_zero).collect();
        let above = signs.windows(2).filter(|w| w[0] != w[1]).count();
        Roots { below: self.degree().unwrap_or(0).saturating_sub(at + above), at, above }
    }

    /// The coefficients of `p(x + t)`, by repeated division by `x − t` (Horner).
    fn shifted(&self, t: &S) -> Vec<S> {
        let mut c = self.coefficients.clone();
        for start in 0..c.len().saturating_sub(1) {
            for k in (start..c.len() - 1).rev() {
                c[k] = (c[k].clone() + t.clone() * c[k + 1].clone()).reduced();
            }
        }
        c
    }
}

fn whole<S: Scalar>(k: usize) -> S {
    // Whole numbers have an exact counterpart in every scalar.
    S::exactly(k as f64).unwrap_or_else(S::zero)
}

/// Sturm's chain of a polynomial.
#[derive(Clone, Debug)]
pub struct Sturm<S> {
    chain: Vec<Polynomial<S>>,
}

impl<S: Scalar> Sturm<S> {
    /// The chain `p, p′, −(p mod p′), …` of a polynomial, multiple roots taken once.
    pub fn new(polynomial: &Polynomial<S>) -> Self {
        let first = polynomial.without_multiplicities();
        let mut chain = vec![first.clone(), first.derivative()];
        while let Some((_, rest)) = chain[chain.len() - 2].divided(&chain[chain.len() - 1]) {
            let rest = rest.of_unit_size();
            chain.push(Polynomial { coefficients: rest.coefficients.into_iter().map(|c| -c).collect() });
        }
        Sturm { chain }
    }

    /// How many distinct real roots are at most x.
    pub fn up_to(&self, x: &S) -> usize {
        let far = self.chain.iter().map(|p| {
            let sign = p.coefficients.last().map_or(Ordering::Equal, Scalar::cmp_zero);
            if p.degree().is_some_and(|d| d % 2 == 1) { sign.reverse() } else { sign }
        });
        changes(far).saturating_sub(changes(self.chain.iter().map(|p| p.at(x).cmp_zero())))
    }

    /// Numbers that are no roots, ascending, so that between neighbours there is one real root at most, and none outside the first
    /// and the last: bisection from Cauchy's bound.
    pub fn separators(&self) -> Vec<S> {
        let Some(leading) = self.chain[0].coefficients.last() else { return Vec::new() };
        let ratio = |c: &S| (c.clone() / leading.clone()).magnitude();
        let largest = self.chain[0].coefficients.iter().map(ratio).fold(S::zero(), |m, r| if r > m { r } else { m });
        let bound = (largest + whole(1)).reduced();
        let mut cuts = vec![-bound.clone(), bound.clone()];
        let mut open = vec![(-bound.clone(), 0, bound, self.up_to(&cuts[1]))];
        while let Some((low, before, high, after)) = open.pop() {
            if after > before + 1 {
                let cut = self.between(&low, &high);
                let count = self.up_to(&cut);
                open.extend([(low, before, cut.clone(), count), (cut.clone(), count, high, after)]);
                cuts.push(cut);
            }
        }
        cuts.sort_by(|a, b| a.partial_cmp(b).unwrap_or(Ordering::Equal));
        cuts
    }

    /// A number between two others, in the middle or near it, that is no root: one of degree + 1 candidates is none.
    fn between(&self, low: &S, high: &S) -> S {
        let parts = 2 * self.chain[0].coefficients.len() + 2;
        let place = |k: usize| {
            let share = whole::<S>(k) / whole(parts);
            (low.clone() + share * (high.clone() - low.clone())).reduced()
        };
        let no_root = |x: &S| self.chain[0].at(x).cmp_zero() != Ordering::Equal;
        (parts / 2..parts).map(place).find(no_root).unwrap_or_else(|| place(parts / 2))
    }
}

fn changes(signs: impl Iterator<Item = Ordering>) -> usize {
    let signs: Vec<Ordering> = signs.filter(|s| *s != Ordering::Equal).collect();
    signs.windows(2).filter(|w| w[0] != w[1]).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Stream;
    use crate::linalg::Csr;
    use crate::linalg::factor::symmetric_eigen;
    use crate::scalar::Rational;

    fn rational(x: f64) -> Rational {
        Rational::exactly(x).unwrap()
    }

    /// The Laplacian of a graph.
    fn laplacian(n: usize, joined: impl Fn(usize, usize) -> bool) -> Dense<Rational> {
        let degree = |i: usize| (0..n).filter(|&j| j != i && joined(i, j)).count();
        Dense::from_fn(n, n, |i, j| match (i == j, joined(i, j)) {
            (true, _) => rational(degree(i) as f64),
            (false, true) => rational(-1.0),
            (false, false) => rational(0.0),
        })
    }

    /// `Π (x − r)^m`.
    fn with_roots(roots: &[(i32, usize)]) -> Polynomial<Rational> {
        let one = Polynomial::new(vec![rational(1.0)]);
        let copies = roots.iter().flat_map(|&(r, m)| std::iter::repeat_n(r, m));
        copies.fold(one, |p, r| p.times(&Polynomial::new(vec![rational(f64::from(-r)), rational(1.0)])))
    }

    #[test]
    fn complete_graphs_stars_and_hypercubes_have_the_polynomials_of_the_textbook() {
        for n in 2..8 {
            let complete = Polynomial::characteristic(&laplacian(n, |_, _| true));
            assert_eq!(complete, with_roots(&[(0, 1), (n as i32, n - 1)]));
            let star = Polynomial::characteristic(&laplacian(n, |i, j| i == 0 || j == 0));
            assert_eq!(star, with_roots(&[(0, 1), (1, n - 2), (n as i32, 1)]));
        }
        let cube = Polynomial::characteristic(&laplacian(8, |i, j| (i ^ j).count_ones() == 1));
        assert_eq!(cube, with_roots(&[(0, 1), (2, 3), (4, 3), (6, 1)]));
    }

    #[test]
    fn paths_and_cycles_have_their_eigenvalues_where_the_cosines_are() {
        for n in 3..11 {
            let path = Polynomial::characteristic(&laplacian(n, |i, j| i.abs_diff(j) == 1));
            let cycle = Polynomial::characteristic(&laplacian(n, |i, j| [1, n - 1].contains(&i.abs_diff(j))));
            let of = |k: usize, period: usize| 2.0 - 2.0 * (std::f64::consts::TAU * k as f64 / period as f64).cos();
            for step in 0..34 {
                let t = 0.037 + f64::from(step) / 8.0;
                for (polynomial, period) in [(&path, 2 * n), (&cycle, n)] {
                    let expected = (0..n).filter(|&k| of(k, period) < t).count();
                    let found = polynomial.real_roots(&rational(t));
                    assert_eq!(found, Roots { below: expected, at: 0, above: n - expected }, "{n} {t}");
                }
            }
            assert_eq!(cycle.real_roots(&rational(0.0)).at, 1);
        }
    }

    #[test]
    fn sturm_counts_the_roots_of_the_path_of_three_and_none_of_a_rotation() {
        let path = Polynomial::characteristic(&laplacian(3, |i, j| i.abs_diff(j) == 1));
        // x (x − 1) (x − 3) = x³ − 4x² + 3x.
        assert_eq!(path.coefficients(), [0.0, 3.0, -4.0, 1.0].map(rational));
        let between = |p: &Polynomial<Rational>, low: f64, high: f64| {
            let chain = Sturm::new(p);
            chain.up_to(&rational(high)) - chain.up_to(&rational(low))
        };
        let found = [(-1.0, 0.0), (0.0, 1.0), (1.0, 2.0), (1.0, 3.0), (-9.0, 9.0)].map(|(a, b)| between(&path, a, b));
        assert_eq!(found, [1, 1, 0, 1, 3]);
        let turn = Dense::from_fn(2, 2, |i, j| rational([[0.0, -1.0], [1.0, 0.0]][i][j]));
        let circle = Polynomial::characteristic(&turn);
        assert_eq!((between(&circle, -5.0, 5.0), circle.without_multiplicities().degree()), (0, Some(2)));
        // Cayley and Hamilton.
        assert!((0..4).all(|k| circle.at_matrix(&turn).at(k / 2, k % 2).cmp_zero() == Ordering::Equal));
    }

    /// A symmetric matrix of whole numbers from −3 to 3.
    fn symmetric(n: usize, stream: &mut Stream) -> Dense<f64> {
        let drawn: Vec<f64> = (0..n * n).map(|_| stream.below(7) as f64 - 3.0).collect();
        Dense::from_fn(n, n, |i, j| drawn[i.min(j) * n + i.max(j)])
    }

    #[test]
    fn both_counts_and_the_inertia_agree_with_the_dense_eigenvalues() {
        let mut stream = Stream::new(3, "polynomials");
        for round in 0..40 {
            let n = 1 + round % 8;
            let a = symmetric(n, &mut stream);
            let triplets: Vec<_> = (0..n * n).map(|k| (k / n, k % n, *a.at(k / n, k % n))).collect();
            let values = symmetric_eigen(&Csr::from_triplets(n, n, &triplets)).unwrap().0;
            let exact = Dense::from_fn(n, n, |i, j| rational(*a.at(i, j)));
            let polynomial = Polynomial::characteristic(&exact);
            let sturm = Sturm::new(&polynomial);
            let mut distinct = values.clone();
            distinct.dedup_by(|a, b| (*a - *b).abs() < 1e-8);
            let cuts = sturm.separators();
            assert!(cuts.windows(2).all(|w| w[0] < w[1]));
            assert_eq!(sturm.up_to(cuts.last().unwrap()), distinct.len());
            for t in cuts.iter().map(Scalar::approximate).chain([-2.03125, 0.015625, 1.984375]) {
                if values.iter().any(|v| (v - t).abs() < 1e-7) {
                    continue;
                }
                let below = values.iter().filter(|v| **v < t).count();
                let found = polynomial.real_roots(&rational(t));
                assert_eq!((found.below, found.at, found.above), (below, 0, n - below), "{t} {values:?}");
                assert_eq!(sturm.up_to(&rational(t)), distinct.iter().filter(|v| **v < t).count());
                let shifted = Dense::from_fn(n, n, |i, j| {
                    exact.at(i, j).clone() - if i == j { rational(t) } else { rational(0.0) }
                });
                assert_eq!(shifted.eliminate().inertia().negative, below);
            }
            let between = cuts.windows(2).map(|w| sturm.up_to(&w[1]) - sturm.up_to(&w[0]));
            assert!(between.clone().all(|k| k <= 1) && between.sum::<usize>() == distinct.len());
        }
    }

    #[test]
    fn the_value_at_a_number_is_the_determinant_there() {
        let mut stream = Stream::new(4, "polynomials");
        let a = symmetric(5, &mut stream);
        let polynomial = Polynomial::characteristic(&Dense::from_fn(5, 5, |i, j| rational(*a.at(i, j))));
        for t in [-7.0, -0.5, 0.25, 3.0] {
            // Laplace's expansion along the first row.
            fn determinant(m: &[Vec<f64>]) -> f64 {
                let minor =
                    |j: usize| -> Vec<Vec<f64>> { m[1..].iter().map(|r| [&r[..j], &r[j + 1..]].concat()).collect() };
                let sign = |j: usize| if j.is_multiple_of(2) { 1.0 } else { -1.0 };
                if m.is_empty() { 1.0 } else { (0..m.len()).map(|j| sign(j) * m[0][j] * determinant(&minor(j))).sum() }
            }
            let rows: Vec<Vec<f64>> =
                (0..5).map(|i| (0..5).map(|j| if i == j { t } else { 0.0 } - a.at(i, j)).collect()).collect();
            assert_eq!(polynomial.at(&rational(t)), rational(determinant(&rows)));
        }
    }

    #[test]
    fn a_multiple_root_is_one_root_for_sturm_and_several_for_descartes() {
        let p = with_roots(&[(-2, 3), (1, 2), (5, 1)]);
        assert_eq!(p.without_multiplicities(), with_roots(&[(-2, 1), (1, 1), (5, 1)]));
        assert_eq!(Sturm::new(&p).up_to(&rational(1.0)), 2);
        assert_eq!(p.real_roots(&rational(1.0)), Roots { below: 3, at: 2, above: 1 });
        // No real root at all: x² + 1.
        let q = Polynomial::new(vec![rational(1.0), rational(0.0), rational(1.0)]);
        assert_eq!(Sturm::new(&q).up_to(&rational(100.0)), 0);
        assert_eq!(Polynomial::<Rational>::new(vec![rational(0.0)]).degree(), None);
        assert!(q.divided(&Polynomial::new(Vec::new())).is_none());
    }
}
