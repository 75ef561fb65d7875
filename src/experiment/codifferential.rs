//! The codifferential: the adjoint of d, by three formulas, and the Laplacian that it makes.
//!
//! # How it is decided
//! On flat tori mode by mode (`world::modes`): the adjoint `G_(k−1)⁻¹ (ξ∧)ᵀ G_k` from the inner products; `±⋆d⋆` from the Hodge star, which
//! an orthonormal coframe gives without any inner product; and the contraction with the vector `G⁻¹ξ`. On curved metrics by integrals of
//! polynomials over the cube: `∫ ⟨dα, β⟩ = ∫ ⟨α, d*β⟩`, d* from the star, for α that vanishes on the boundary.

use super::calculus::{Form, Metric, Polynomial, masks, vanishing, whole};
use super::poll::{Case, Every};
use super::world::modes::{Torus, frequencies, tori, wedge};
use super::{Experiment, Finding, Setting};
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::scalar::Rational;

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "codifferential",
    name: "The codifferential and the Hodge Laplacian, on flat tori and curved metrics",
    statement: "d* = (−1)^(n(k+1)+1) ⋆d⋆ on k-forms is the adjoint of d; on a flat torus dd* + d*d multiplies each Fourier mode of each \
                degree by 4π²|ξ|²; on functions it is d*d = −div ∇",
    sources: &["wardetzky-primer"],
    parts: &[
        "star-pairs-with-the-inner-product",
        "codifferential-is-the-adjoint",
        "adjoint-on-curved-metrics",
        "laplacian-of-a-mode",
        "laplacian-of-functions",
    ],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let (mut star, mut adjoint, mut curved, mut symbol, mut functions) =
        (Every::default(), Every::default(), Every::default(), Every::default(), Every::default());
    for torus in tori(setting.pick(1, 3), &mut stream) {
        let n = torus.dimension();
        (0..=n).for_each(|k| star.ask(not_the_star(&torus, k, stars(&torus, k))));
        for xi in frequencies(n, setting.pick(1, 2) as i64) {
            for k in 0..=n {
                let Some(stage) = torus.stage(&xi, k) else { continue };
                symbol.ask(not_the_length(&stage.laplacian(), &torus.squared_length(&xi), &stage.name));
                if k > 0 {
                    let others = others(&torus, &xi, k);
                    adjoint.ask(not_the_adjoint(stage.before_adjoint(), &others, &stage.name));
                }
            }
            functions.ask(more_than_the_second_half(&torus, &xi, &torus.squared_length(&xi)));
        }
    }
    for case in 0..setting.pick(6, 18) {
        let n = 2 + usize::from(case % 6 == 5);
        let metric = Metric::random(n, &mut stream);
        let k = 1 + case % n;
        let parts: Vec<_> = masks(n, k - 1).into_iter().map(|m| (m, vanishing(n, &mut stream))).collect();
        let (alpha, beta) = (Form::new(n, k - 1, parts), Form::random(n, k, 1, &mut stream));
        curved.ask(not_adjoint_on(&metric, &alpha, &beta, metric.codifferential(&beta)));
        let u = Polynomial::random(n, 2, &mut stream);
        functions.ask(not_the_laplacian(&metric, &u, |form| metric.hodge_laplacian(form)));
    }
    vec![
        star.answer(
            "star-pairs-with-the-inner-product",
            "Is α ∧ ⋆β = ⟨α, β⟩ √g dx and ⋆⋆ = (−1)^(k(n−k)), for the star of an orthonormal coframe and for the one of this equation?",
            "degrees of forms on flat tori of one to three dimensions",
        ),
        adjoint.answer(
            "codifferential-is-the-adjoint",
            "Are ±⋆d⋆, the contraction with the frequency, and the adjoint of d for the inner products the same matrix?",
            "Fourier modes of a positive degree on flat tori of one to three dimensions",
        ),
        curved.answer(
            "adjoint-on-curved-metrics",
            "Is ∫ ⟨dα, β⟩ = ∫ ⟨α, ±⋆d⋆β⟩ for α that vanishes on the boundary?",
            "pairs of polynomial forms on squares and cubes with random curved metrics",
        ),
        symbol.answer(
            "laplacian-of-a-mode",
            "Is dd* + d*d the multiplication by |ξ|² (in units of 4π²)?",
            "Fourier modes of every degree on flat tori of one to three dimensions",
        ),
        functions.answer(
            "laplacian-of-functions",
            "Is Δ = d*d on functions, |ξ|² on each mode of a flat torus and −div ∇ on curved metrics?",
            "modes of functions on flat tori, and polynomials with curved metrics",
        ),
    ]
}

fn told(violated: bool, text: impl FnOnce() -> String) -> Option<Case> {
    violated.then(|| Case::told(text()))
}

/// The stars of an orthonormal coframe on k-forms and on (n − k)-forms.
fn stars(torus: &Torus, k: usize) -> Option<(Dense<Rational>, Dense<Rational>)> {
    torus.star_of_coframe(k).zip(torus.star_of_coframe(torus.dimension() - k))
}

/// On the basis forms: `a ∧ ⋆b`, a multiple of dx, against `⟨a, b⟩ √g`, for the star of the coframe; and the star twice.
fn not_the_star(torus: &Torus, k: usize, stars: Option<(Dense<Rational>, Dense<Rational>)>) -> Option<Case> {
    let n = torus.dimension();
    let text = format!("degree {k} on {}", torus.name);
    // Where no coframe is rational, the star over √g has the square det G with its partner.
    let Some((star, back)) = stars else { return torus.star_is_no_square_root(k).then(|| Case::told(text)) };
    let density = torus.coframe().map(super::calculus::determinant)?;
    let all = (1_u32 << n) - 1;
    let sets = masks(n, k);
    let complements = masks(n, n - k);
    for (i, &set) in sets.iter().enumerate() {
        let place = complements.iter().position(|&c| c == all & !set)?;
        let sign = whole(super::calculus::complement_sign(n, set));
        for j in 0..sets.len() {
            let product = sign.clone() * star.at(place, j).clone();
            if product != torus.inner(k).at(i, j).clone() * density.clone() {
                return Some(Case::told(format!("{text}: basis forms {i} and {j}")));
            }
        }
    }
    let (twice, sign) = (back.product(&star), whole(if (k * (n - k)).is_multiple_of(2) { 1 } else { -1 }));
    told(!is_multiple_of_identity(&twice, &sign), || format!("{text}: the star twice"))
}

fn is_multiple_of_identity(a: &Dense<Rational>, factor: &Rational) -> bool {
    let entry = |i, j| if i == j { factor.clone() } else { Rational::ZERO };
    (0..a.rows()).all(|i| (0..a.columns()).all(|j| *a.at(i, j) == entry(i, j)))
}

/// `d*` on k-forms by the stars and by the contraction, with their names.
fn others(torus: &Torus, xi: &[i64], k: usize) -> Vec<(&'static str, Dense<Rational>)> {
    let stars = torus.codifferentials_of_stars(xi, k).into_iter().map(|d| ("the star's", d));
    stars.chain([("the contraction", torus.contraction(xi, k))]).collect()
}

fn not_the_adjoint(adjoint: &Dense<Rational>, others: &[(&str, Dense<Rational>)], name: &str) -> Option<Case> {
    let (which, _) = others.iter().find(|(_, other)| other != adjoint)?;
    Some(Case::told(format!("{name}: {which} is another matrix")))
}

fn not_the_length(laplacian: &Dense<Rational>, length: &Rational, name: &str) -> Option<Case> {
    told(!is_multiple_of_identity(laplacian, length), || format!("{name}: not {length}"))
}

/// On functions the first half, dd*, has no degree to go through, and the second is `(ξ∧)* ξ∧ = Σ g^ij ξ_i ξ_j`.
fn more_than_the_second_half(torus: &Torus, xi: &[i64], length: &Rational) -> Option<Case> {
    let (stage, above) = (torus.stage(xi, 0)?, torus.stage(xi, 1)?);
    let second = above.before_adjoint().product(&wedge(xi, 0));
    let first_is_empty = stage.before_adjoint().rows() == 0;
    let same = second == stage.laplacian() && is_multiple_of_identity(&second, length);
    told(!same || !first_is_empty, || stage.name.clone())
}

/// α vanishes on the boundary; `d*β` is what is said to be the codifferential of β.
fn not_adjoint_on(metric: &Metric, alpha: &Form, beta: &Form, codifferential: Option<Form>) -> Option<Case> {
    let left = metric.paired(&alpha.d(), beta).over_unit_cube();
    let right = metric.paired(alpha, &codifferential?).over_unit_cube();
    told(left != right, || format!("degree {} in {} dimensions: {left}, {right}", beta.degree(), beta.dimension()))
}

fn not_the_laplacian(metric: &Metric, u: &Polynomial, hodge: impl Fn(&Form) -> Form) -> Option<Case> {
    let found = hodge(&Form::new(u.variables(), 0, [(0, u.clone())])).part(0);
    told(found != metric.laplacian(u), || format!("u = {u}: {found} is not {}", metric.laplacian(u)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::calculus::ratio;

    fn skew() -> Torus {
        let a = Dense::from_fn(2, 2, |i, j| ratio([[2, 1], [0, 3]][i][j], 2));
        Torus::of_coframe(a).unwrap()
    }

    fn scaled(a: &Dense<Rational>, factor: i64) -> Dense<Rational> {
        Dense::from_fn(a.rows(), a.columns(), |i, j| whole(factor) * a.at(i, j).clone())
    }

    #[test]
    fn a_wrong_sign_and_the_wrong_metric_are_not_the_adjoint() {
        let (torus, xi) = (skew(), [1, -2]);
        for k in 1..=2 {
            let right = others(&torus, &xi, k);
            let adjoint = torus.stage(&xi, k).unwrap().before_adjoint().clone();
            assert_eq!(right.len(), 3, "two stars and a contraction");
            assert!(not_the_adjoint(&adjoint, &right, "").is_none());
            for spoilt in 0..right.len() {
                let mut wrong = others(&torus, &xi, k);
                wrong[spoilt].1 = scaled(&wrong[spoilt].1, -1);
                assert!(not_the_adjoint(&adjoint, &wrong, "").is_some());
            }
            let other = Torus::new(Dense::from_fn(2, 2, |i, j| whole(i64::from(i == j)))).unwrap();
            assert!(not_the_adjoint(&adjoint, &others(&other, &xi, k), "").is_some());
        }
    }

    #[test]
    fn a_star_of_another_sign_size_or_metric_is_not_the_star() {
        let (torus, unit) = (skew(), Torus::of_coframe(Dense::from_fn(2, 2, |i, j| whole(i64::from(i == j)))).unwrap());
        for k in 0..=2 {
            assert!(not_the_star(&torus, k, stars(&torus, k)).is_none());
            assert!(not_the_star(&torus, k, stars(&unit, k)).is_some(), "{k}");
            for factor in [-1, 2] {
                let wrong = stars(&torus, k).map(|(star, back)| (scaled(&star, factor), back));
                assert!(not_the_star(&torus, k, wrong).is_some(), "{k}, the star itself");
                let wrong = stars(&torus, k).map(|(star, back)| (star, scaled(&back, factor)));
                assert!(not_the_star(&torus, k, wrong).is_some(), "{k}, the star twice");
            }
        }
        // The lattice A₂ has √g = √3 and is asked without a coframe.
        let lattice = Torus::new(Dense::from_fn(2, 2, |i, j| whole([[2, -1], [-1, 2]][i][j]))).unwrap();
        assert!((0..=2).all(|k| not_the_star(&lattice, k, None).is_none()));
        assert!(more_than_the_second_half(&lattice, &[1, 1], &whole(2)).is_none(), "(2 + 2 + 2·1)/3");
        assert!(more_than_the_second_half(&lattice, &[1, 1], &whole(1)).is_some());
    }

    #[test]
    fn half_of_the_laplacian_and_another_length_are_noticed() {
        let (torus, xi) = (skew(), [1, -2]);
        let (stage, length) = (torus.stage(&xi, 1).unwrap(), torus.squared_length(&xi));
        assert!(not_the_length(&stage.laplacian(), &length, "").is_none());
        assert!(
            not_the_length(&stage.laplacian(), &whole(5), "").is_some(),
            "5 is the length for orthonormal coordinates"
        );
        let half = wedge(&xi, 0).product(stage.before_adjoint());
        assert!(not_the_length(&half, &length, "").is_some());
    }

    #[test]
    fn boundary_values_a_wrong_sign_and_another_metric_break_the_adjoint_on_the_square() {
        let mut stream = Stream::new(1, "planted");
        let (metric, other) = (Metric::random(2, &mut stream), Metric::random(2, &mut stream));
        let beta = Form::random(2, 1, 1, &mut stream);
        let alpha = Form::new(2, 0, [(0, vanishing(2, &mut stream))]);
        let right = || metric.codifferential(&beta);
        assert!(not_adjoint_on(&metric, &alpha, &beta, right()).is_none());
        assert!(not_adjoint_on(&metric, &alpha, &beta, other.codifferential(&beta)).is_some());
        let negative = right().map(|f| Form::new(2, 0, [(0, -&f.part(0))]));
        assert!(not_adjoint_on(&metric, &alpha, &beta, negative).is_some());
        let free = Form::random(2, 0, 2, &mut stream);
        assert!(not_adjoint_on(&metric, &free, &beta, right()).is_some());
    }

    #[test]
    fn the_laplacian_of_another_metric_is_noticed() {
        let mut stream = Stream::new(2, "planted");
        let (metric, other) = (Metric::random(2, &mut stream), Metric::random(2, &mut stream));
        let u = Polynomial::random(2, 2, &mut stream);
        assert!(not_the_laplacian(&metric, &u, |f| metric.hodge_laplacian(f)).is_none());
        assert!(not_the_laplacian(&metric, &u, |f| other.hodge_laplacian(f)).is_some());
    }
}
