//! Harmonic forms: closed and co-closed on closed manifolds, and what a boundary breaks.
//!
//! # Definition
//! A form is harmonic if `Δα = (dd* + d*d)α = 0`, closed if `dα = 0`, co-closed if `d*α = 0`. Without a boundary `(Δα, α) = |dα|² + |d*α|²`, so
//! that the first is both of the others. With one the boundary terms are missing there: x is harmonic and not closed on an interval, x dx
//! harmonic and not co-closed.
//!
//! # How it is decided
//! The kernels of matrices over the rationals: for each Fourier mode of each degree on flat tori, and for the cochains of closed
//! triangulations with random inner products, where the cohomology comes from the derivatives alone. With a boundary by
//! a search among polynomial forms with few coefficients; what is found is written down as a [`Statement`] that the recheck decides.

use super::calculus::{Form, Metric, Polynomial, masks, whole};
use super::poll::{Case, Every, Search};
use super::world::complexes::closed;
use super::world::modes::{Torus, frequencies, tori};
use super::{Experiment, Finding, Setting};
use crate::generate::Stream;
use crate::property::evidence::Exception;
use crate::property::{Evidence, Statement};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "harmonic-forms",
    name: "Harmonic forms on closed manifolds, and with a boundary",
    statement: "on closed manifolds a form is harmonic exactly if it is closed and co-closed, and the harmonic forms are as many as the \
                cohomology; with a boundary there are harmonic forms that are not closed, and others that are not co-closed",
    sources: &["wardetzky-primer"],
    parts: &[
        "modes-closed-and-co-closed",
        "constants-on-flat-tori",
        "cochains-closed-and-co-closed",
        "cohomology-of-closed-complexes",
        "harmonic-and-not-closed",
        "harmonic-and-not-co-closed",
    ],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let (mut modes, mut constants) = (Every::default(), Every::default());
    for torus in tori(setting.pick(1, 3), &mut stream) {
        let n = torus.dimension();
        let all = frequencies(n, setting.pick(1, 2) as i64);
        for k in 0..=n {
            all.iter().filter_map(|xi| torus.stage(xi, k)).for_each(|stage| modes.ask(stage.harmonic_and_not_both()));
            constants.ask(other_than_constants(&torus, &all, k, &harmonic_dimensions(&torus, &all, k)));
        }
    }
    let (mut cochains, mut cohomology) = (Every::default(), Every::default());
    for complex in closed() {
        for case in 0..setting.pick(1, 3) {
            let inner = if case == 0 { complex.diagonal(&mut stream) } else { complex.full(&mut stream) };
            for stage in (0..=complex.dimension()).filter_map(|k| complex.stage(k, &inner)) {
                cochains.ask(stage.harmonic_and_not_both());
                cohomology.ask(stage.harmonic_is_not_cohomology());
            }
        }
    }
    let (mut not_closed, mut not_coclosed) = (Search::default(), Search::default());
    for form in forms() {
        let metric = Metric::euclidean(form.dimension());
        if metric.hodge_laplacian(&form).is_zero() {
            not_closed.ask(with_derivative(&form));
            not_coclosed.ask(with_codifferential(&metric, &form));
        }
    }
    let tori = "Fourier modes of every degree on flat tori of one to three dimensions";
    let complexes = "degrees of cochains on closed triangulations: circles, spheres, torus, projective plane, 3-sphere, with random inner \
                     products";
    let polynomials = "harmonic polynomial forms with coefficients −1, 0, 1 on the interval (degree at most 2) and the square (linear)";
    vec![
        modes.answer("modes-closed-and-co-closed", "Is the kernel of Δ that of d and d* together?", tori),
        constants.answer(
            "constants-on-flat-tori",
            "Are the harmonic forms the constant ones, as many as the binomial coefficient of dimension and degree?",
            "pairs of a degree and a flat torus, all frequencies of a box",
        ),
        cochains.answer("cochains-closed-and-co-closed", "Is the kernel of Δ that of d and d* together?", complexes),
        cohomology.answer(
            "cohomology-of-closed-complexes",
            "Has it the dimension of the cohomology, dim ker d − rank d of the degree below?",
            complexes,
        ),
        not_closed.answer(
            "harmonic-and-not-closed",
            "With a boundary: is there a form with Δα = 0 and dα ≠ 0?",
            polynomials,
        ),
        not_coclosed.answer(
            "harmonic-and-not-co-closed",
            "With a boundary: is there a form with Δα = 0 and d*α ≠ 0?",
            polynomials,
        ),
    ]
}

/// The dimension of the harmonic forms of each mode in degree k.
fn harmonic_dimensions(torus: &Torus, all: &[Vec<i64>], k: usize) -> Vec<usize> {
    all.iter().filter_map(|xi| torus.stage(xi, k)).map(|stage| stage.laplacian().kernel().len()).collect()
}

/// All of the mode ξ = 0 is harmonic, and nothing of any other.
fn other_than_constants(torus: &Torus, all: &[Vec<i64>], k: usize, found: &[usize]) -> Option<Case> {
    let n = torus.dimension();
    let binomial = (0..k).fold(1, |c, i| c * (n - i) / (i + 1));
    let expected = all.iter().map(|xi| if xi.iter().all(|x| *x == 0) { binomial } else { 0 });
    if expected.clone().eq(found.iter().copied()) {
        return None;
    }
    let place = expected.zip(found).position(|(e, f)| e != *f);
    let text = place.map(|p| format!("{} at ξ = {:?}", found[p], all[p])).unwrap_or_else(|| "modes are missing".into());
    Some(Case::told(format!("harmonic dimensions of degree {k} on {}: {text}", torus.name)))
}

/// Functions and 1-forms on the interval, then forms of every degree on the square, the simplest first.
fn forms() -> Vec<Form> {
    let families = [(1, 0, 2), (1, 1, 2), (2, 0, 1), (2, 1, 1), (2, 2, 1)];
    families.into_iter().flat_map(|(n, k, degree)| combinations(n, k, degree)).collect()
}

/// All forms with coefficients 0, 1, −1 up to a degree of polynomials.
fn combinations(n: usize, k: usize, degree: u32) -> Vec<Form> {
    let basis = Form::basis(n, k, degree);
    let coefficient = |code: usize, place: usize| [0, 1, -1][code / 3_usize.pow(place as u32) % 3];
    let form = |code: usize| {
        let part = |mask: u32| {
            basis.iter().enumerate().fold(Polynomial::zero(n), |sum, (place, b)| {
                &sum + &b.part(mask).times(&whole(coefficient(code, place)))
            })
        };
        Form::new(n, k, masks(n, k).into_iter().map(|m| (m, part(m))))
    };
    (0..3_usize.pow(basis.len() as u32)).map(form).collect()
}

fn with_derivative(form: &Form) -> Option<Case> {
    let derivative = form.d();
    (form.degree() < form.dimension() && !derivative.is_zero()).then(|| {
        let exception = Exception::Closed { derivative: derivative.terms() };
        Case::shown(format!("α = {form}, dα = {derivative}"), witness(form, exception))
    })
}

fn with_codifferential(metric: &Metric, form: &Form) -> Option<Case> {
    let image = metric.codifferential(form).filter(|image| !image.is_zero())?;
    let exception = Exception::CoClosed { codifferential: image.terms() };
    Some(Case::shown(format!("α = {form}, d*α = {image}"), witness(form, exception)))
}

fn witness(form: &Form, exception: Exception) -> Evidence {
    Evidence::bare(Statement::HarmonicForm { dimension: form.dimension(), form: form.terms(), exception })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::recheck;

    #[test]
    fn the_first_forms_found_with_a_boundary_are_x_and_x_dx() {
        let findings = run(&Setting { seed: 1, effort: crate::experiment::Effort::Smoke });
        assert!(findings.iter().all(|f| f.agrees), "{findings:?}");
        assert!(findings[4].finding.ends_with("α = x, dα = (1) dx"), "{}", findings[4].finding);
        assert!(findings[5].finding.ends_with("α = (x) dx, d*α = −1"), "{}", findings[5].finding);
    }

    #[test]
    fn closed_and_co_closed_polynomial_forms_are_no_instances() {
        let x = || Polynomial::variable(2, 0);
        let y = || Polynomial::variable(2, 1);
        let plane = Metric::euclidean(2);
        // x dx − y dy is the derivative of a harmonic function; x dy − y dx turns round.
        let both = Form::new(2, 1, [(1, x()), (2, -&y())]);
        assert!(with_derivative(&both).is_none() && with_codifferential(&plane, &both).is_none());
        let turning = Form::new(2, 1, [(1, -&y()), (2, x())]);
        assert!(with_derivative(&turning).is_some() && with_codifferential(&plane, &turning).is_none());
        assert!(plane.hodge_laplacian(&turning).is_zero());
    }

    #[test]
    fn the_recheck_accepts_the_forms_that_are_harmonic_with_an_image_of_every_term_and_no_others() {
        let accepts =
            |form: &Form, exception| recheck::from_excerpt(&witness(form, exception)) == Ok(recheck::Rechecked::Exact);
        let mut accepted = [0, 0];
        for form in forms() {
            let (n, k) = (form.dimension(), form.degree());
            let metric = Metric::euclidean(n);
            let harmonic = metric.hodge_laplacian(&form).is_zero();
            let each = |map: &dyn Fn(&Form) -> bool| {
                let parts = masks(n, k).into_iter().map(|m| (m, form.part(m)));
                let alone = |(m, p): (u32, Polynomial)| -> Vec<Form> {
                    let one = |(e, c): (&[u32], &crate::scalar::Rational)| Polynomial::monomial(e.to_vec(), c.clone());
                    p.terms().map(|t| Form::new(n, k, [(m, one(t))])).collect()
                };
                parts.flat_map(alone).all(|f| map(&f))
            };
            let d = form.d();
            let moves = |f: &Form| metric.codifferential(f).is_some_and(|f| !f.is_zero());
            let image = metric.codifferential(&form).unwrap_or_else(|| Form::new(n, 0, []));
            let found = [
                accepts(&form, Exception::Closed { derivative: d.terms() }),
                accepts(&form, Exception::CoClosed { codifferential: image.terms() }),
            ];
            let expected =
                [harmonic && !d.is_zero() && each(&|f| !f.d().is_zero()), harmonic && !image.is_zero() && each(&moves)];
            assert_eq!(found, expected, "{form}");
            accepted.iter_mut().zip(found).for_each(|(count, f)| *count += usize::from(f));
        }
        // On the interval ax with a ≠ 0: 2. On the square ax + by, not both 0: 8; a y dx + b x dy with a ≠ b: 6. ⋆ takes them to
        // those that are not co-closed.
        assert_eq!(accepted, [16, 16]);
    }

    #[test]
    fn a_mode_left_out_and_a_harmonic_form_too_many_are_noticed() {
        let torus = Torus::new(crate::linalg::Dense::from_fn(2, 2, |i, j| whole(i64::from(i == j)))).unwrap();
        let all = frequencies(2, 1);
        let right = harmonic_dimensions(&torus, &all, 1);
        assert_eq!((right[4], right.iter().sum::<usize>()), (2, 2));
        assert!(other_than_constants(&torus, &all, 1, &right).is_none());
        assert!(other_than_constants(&torus, &all, 1, &right[..8]).is_some());
        let mut wrong = right.clone();
        wrong[3] = 1;
        assert!(other_than_constants(&torus, &all, 1, &wrong).is_some());
    }
}
