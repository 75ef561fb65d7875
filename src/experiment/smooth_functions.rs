//! Smooth functions: Green's identities, mean values, extrema and Stokes' theorem on polynomials.
//!
//! Every statement here is an identity between integrals or derivatives of polynomials, decided over the rationals. The sign
//! is the geometer's, `Δ = −div ∇`.

use std::cmp::Ordering;

use super::calculus::{Form, Metric, Polynomial, divergence, drawn, random_simplex, ratio, vanishing, whole};
use super::poll::{Case, Every};
use super::{Experiment, Finding, Setting};
use crate::generate::Stream;
use crate::property::evidence::{Exception, Fraction};
use crate::property::{Evidence, Statement};
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "smooth-functions",
    name: "Green's identities, mean values, extrema and Stokes' theorem on polynomials",
    statement: "on functions that vanish on the boundary Δ = −div ∇ is symmetric and positive semi-definite, and −div the adjoint \
                of ∇; harmonic functions have their averages over balls and spheres as values and no strict extremum; \
                Stokes' theorem holds on simplices and d∘d = 0",
    sources: &["wardetzky-primer", "folland2001"],
    parts: &[
        "green-identity",
        "laplacian-is-positive",
        "divergence-is-minus-the-adjoint",
        "no-strict-maximum",
        "no-strict-minimum",
        "no-minimum",
        "mean-over-balls",
        "mean-over-spheres",
        "stokes-on-simplices",
        "derivative-twice-is-zero",
        "carre-du-champ",
    ],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let (mut green, mut positive, mut adjoint) = (Every::default(), Every::default(), Every::default());
    for case in 0..setting.pick(8, 40) {
        let n = 1 + case % 3;
        let (u, v) = (vanishing(n, &mut stream), vanishing(n, &mut stream));
        let field: Vec<Polynomial> = (0..n).map(|_| Polynomial::random(n, 2, &mut stream)).collect();
        green.ask(not_green(&u, &v, &v.laplacian()));
        positive.ask(not_positive(&u, &u.laplacian()));
        adjoint.ask(not_adjoint(&u, &field));
    }
    let (mut maximum, mut minimum, mut balls, mut spheres) =
        (Every::default(), Every::default(), Every::default(), Every::default());
    for case in 0..setting.pick(12, 60) {
        let p = harmonic(2 + case % 2, 2 + (case / 2 % 4) as u32, &mut stream);
        let centre: Vec<Rational> = (0..p.variables()).map(|_| drawn(&mut stream)).collect();
        let radius = ratio(1 + stream.below(12) as i64, 4);
        maximum.ask(strict_extremum(&p, &centre, Ordering::Greater));
        minimum.ask(strict_extremum(&p, &centre, Ordering::Less));
        balls.ask(not_the_mean(&p, &centre, &radius, Polynomial::average_over_ball));
        spheres.ask(not_the_mean(&p, &centre, &radius, Polynomial::average_over_sphere));
    }
    let (mut stokes, mut twice) = (Every::default(), Every::default());
    for (n, k) in (1..=3).flat_map(|n| (0..n).map(move |k| (n, k))) {
        for form in Form::basis(n, k, 2) {
            twice.ask(not_exact(&form));
        }
        for _ in 0..setting.pick(2, 8) {
            let (form, simplex) = (Form::random(n, k, 3, &mut stream), random_simplex(n, k + 1, &mut stream));
            stokes.ask(not_stokes(&form, &form.d(), &simplex));
            twice.ask(not_exact(&form));
        }
    }
    let mut metrics = Every::default();
    for case in 0..setting.pick(4, 16) {
        let metric = Metric::random(2 + case % 2, &mut stream);
        metrics.ask(not_recovered(metric.inverse(), |f| metric.laplacian(f)));
    }
    let functions = "pairs of polynomials that vanish on the boundary of the unit interval, square or cube";
    let harmonics = "random harmonic polynomials of degree 2 to 5 in two and three variables at random points";
    vec![
        green.answer("green-identity", "Is (u, Δv) = ∫ ∇u·∇v = (Δu, v)?", functions),
        positive.answer("laplacian-is-positive", "Is (u, Δu) > 0 for u ≠ 0?", functions),
        adjoint.answer(
            "divergence-is-minus-the-adjoint",
            "Is (∇u, X) = (u, −div X)?",
            "pairs of a polynomial that vanishes on the boundary of the unit interval, square or cube, and a polynomial field",
        ),
        maximum.answer("no-strict-maximum", "Is there a direction in which the values do not fall?", harmonics),
        minimum.answer("no-strict-minimum", "Is there a direction in which the values do not rise?", harmonics),
        no_minimum().answer(
            "no-minimum",
            "Has no harmonic polynomial a local minimum at the origin, strict or not?",
            "harmonic polynomials of degree at most 2 in two variables with coefficients −1, 0, 1",
        ),
        balls.answer("mean-over-balls", "Is the value at the centre the average over every ball?", harmonics),
        spheres.answer("mean-over-spheres", "Is the value at the centre the average over every sphere?", harmonics),
        stokes.answer(
            "stokes-on-simplices",
            "Is ∫_σ dω = ∫_∂σ ω?",
            "random polynomial forms of every degree on random simplices, one to three dimensions",
        ),
        twice.answer("derivative-twice-is-zero", "Is d∘d = 0?", "polynomial forms, one to three dimensions"),
        metrics.answer(
            "carre-du-champ",
            "Is −½(Δ(xy) − x Δy − y Δx), of the coordinates two by two, the inverse metric?",
            "Laplace–Beltrami operators of random curved polynomial metrics in two and three dimensions",
        ),
    ]
}

fn told(violated: bool, text: impl FnOnce() -> String) -> Option<Case> {
    violated.then(|| Case::told(text()))
}

fn not_green(u: &Polynomial, v: &Polynomial, laplacian_v: &Polynomial) -> Option<Case> {
    let n = u.variables();
    let product = u.gradient().iter().zip(v.gradient()).fold(Polynomial::zero(n), |s, (p, q)| &s + &(p * &q));
    let left = (u * laplacian_v).over_unit_cube();
    let (middle, right) = (product.over_unit_cube(), (&u.laplacian() * v).over_unit_cube());
    told(left != middle || middle != right, || format!("u = {u}, v = {v}: {left}, {middle}, {right}"))
}

fn not_positive(u: &Polynomial, laplacian: &Polynomial) -> Option<Case> {
    let value = (u * laplacian).over_unit_cube();
    let right = if u.is_zero() { Ordering::Equal } else { Ordering::Greater };
    told(value.cmp_zero() != right, || format!("u = {u}: {value}"))
}

fn not_adjoint(u: &Polynomial, field: &[Polynomial]) -> Option<Case> {
    let product = u.gradient().iter().zip(field).fold(Polynomial::zero(field.len()), |s, (p, q)| &s + &(p * q));
    let (left, right) = (product.over_unit_cube(), -(u * &divergence(field)).over_unit_cube());
    told(left != right, || format!("u = {u}: {left}, {right}"))
}

/// A random harmonic polynomial: random terms of even and odd order in the last variable are continued by
/// `∂²p/∂z² = −(the other second derivatives)`, term by term.
fn harmonic(n: usize, degree: u32, stream: &mut Stream) -> Polynomial {
    let last = n - 1;
    // p = Σ z^k p_k with p_{k+2} = L p_k / ((k + 1)(k + 2)), L the Laplacian (positive) of the other variables.
    let flat = |stream: &mut Stream, degree: u32| {
        let p = Polynomial::random(n, degree, stream);
        let free = p.terms().filter(|(e, _)| e[last] == 0);
        free.fold(Polynomial::zero(n), |q, (e, c)| q.plus(e.to_vec(), c.clone()))
    };
    let z = Polynomial::variable(n, last);
    let mut sum = Polynomial::zero(n);
    for start in 0..2_u32 {
        let mut p = flat(stream, degree - start);
        let mut power = if start == 0 { Polynomial::constant(n, Rational::ONE) } else { z.clone() };
        for k in (start..=degree).step_by(2) {
            sum = &sum + &(&power * &p);
            p = p.laplacian().times(&ratio(1, (k + 1) * (k + 2)));
            power = &(&power * &z) * &z;
        }
    }
    sum
}

/// The part of lowest positive degree of the expansion about a point; `None` for a constant. It decides whether the
/// values next to the point rise or fall in a direction where it does not vanish.
fn leading(p: &Polynomial, centre: &[Rational]) -> Option<Polynomial> {
    let about = p.about(centre);
    (1..=about.degree()?).map(|d| about.homogeneous(d)).find(|part| !part.is_zero())
}

/// Directions with whole coordinates of at most 4.
fn directions(n: usize) -> impl Iterator<Item = Vec<Rational>> {
    (0..9_usize.pow(n as u32))
        .map(move |code| (0..n as u32).map(|k| whole((code / 9_usize.pow(k) % 9) as i64 - 4)).collect())
}

/// No direction in which the values rise (`Greater`) or fall (`Less`) although p is not constant; a constant has no strict
/// extremum.
fn strict_extremum(p: &Polynomial, centre: &[Rational], sense: Ordering) -> Option<Case> {
    let leading = leading(p, centre)?;
    let found = directions(p.variables()).any(|v| leading.at(&v).cmp_zero() == sense);
    told(!found, || format!("{p} has the leading part {leading} at {}", written(centre)))
}

fn written(point: &[Rational]) -> String {
    point.iter().map(|x| x.clone().reduced().to_string()).collect::<Vec<_>>().join(", ")
}

/// Every polynomial of the family that is harmonic, the constants first and of these 1: an exception where it has a minimum at the origin.
/// A polynomial that is not constant falls in some direction, or is left as no exception only if one is found.
fn no_minimum() -> Every {
    let exponents = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];
    let mut every = Every::default();
    for code in 0..3_usize.pow(6) {
        let coefficient =
            |k: usize| whole(if k == 0 { [1, 0, -1] } else { [0, 1, -1] }[code / 3_usize.pow(k as u32) % 3]);
        let terms = exponents.iter().enumerate().map(|(k, e)| (e.to_vec(), coefficient(k)));
        let p = terms.fold(Polynomial::zero(2), |p, (e, c)| p.plus(e, c));
        if p.laplacian().is_zero() {
            every.ask(minimum_at_the_origin(&p));
        }
    }
    every
}

fn minimum_at_the_origin(p: &Polynomial) -> Option<Case> {
    let origin = [Rational::ZERO, Rational::ZERO];
    match leading(p, &origin) {
        None => {
            let text = format!("the constant {p}, which has a minimum, not strict, at every point");
            let exception = Exception::NoMinimum { value: Fraction::from(&p.constant_term()) };
            let form = Form::new(p.variables(), 0, [(0, p.clone())]).terms();
            let statement = Statement::HarmonicForm { dimension: p.variables(), form, exception };
            Some(Case::shown(text, Evidence::bare(statement)))
        }
        Some(_) => strict_extremum(p, &origin, Ordering::Less),
    }
}

fn not_the_mean(
    p: &Polynomial,
    centre: &[Rational],
    radius: &Rational,
    average: impl Fn(&Polynomial, &Rational) -> Rational,
) -> Option<Case> {
    let (value, mean) = (p.at(centre), average(&p.about(centre), radius));
    told(value != mean, || format!("{p} at {}, radius {radius}: {value} and {mean}", written(centre)))
}

fn not_exact(form: &Form) -> Option<Case> {
    told(!form.d().d().is_zero(), || format!("a form of degree {}", form.degree()))
}

fn not_stokes(form: &Form, derivative: &Form, simplex: &[Vec<Rational>]) -> Option<Case> {
    let inside = derivative.over(simplex);
    let faces = (0..simplex.len()).map(|left_out| {
        let face: Vec<Vec<Rational>> =
            (0..simplex.len()).filter(|&k| k != left_out).map(|k| simplex[k].clone()).collect();
        let value = form.over(&face);
        if left_out % 2 == 0 { value } else { -value }
    });
    let around = crate::scalar::sum(faces);
    told(inside != around, || format!("a form of degree {}: {inside} and {around}", form.degree()))
}

/// `Γ(x_i, x_j) = −½(Δ(x_i x_j) − x_i Δx_j − x_j Δx_i)` is compared with `g^ij`.
fn not_recovered(inverse: &[Vec<Polynomial>], laplacian: impl Fn(&Polynomial) -> Polynomial) -> Option<Case> {
    let n = inverse.len();
    let x = |k: usize| Polynomial::variable(n, k);
    let square = |i: usize, j: usize| {
        let mixed = &(&x(i) * &laplacian(&x(j))) + &(&x(j) * &laplacian(&x(i)));
        (&mixed - &laplacian(&(&x(i) * &x(j)))).times(&Rational::half())
    };
    let bad = (0..n * n).find(|k| square(k / n, k % n) != inverse[k / n][k % n])?;
    Some(Case::told(format!("entry ({}, {}) is {} in {n} dimensions", bad / n, bad % n, square(bad / n, bad % n))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::recheck;

    fn power(n: usize, k: usize) -> Polynomial {
        &Polynomial::variable(n, k) * &Polynomial::variable(n, k)
    }

    #[test]
    fn the_wrong_sign_a_missing_derivative_and_a_boundary_value_break_greens_identity() {
        let mut stream = Stream::new(1, "planted");
        let (u, v) = (vanishing(2, &mut stream), vanishing(2, &mut stream));
        assert!(not_green(&u, &v, &v.laplacian()).is_none() && not_positive(&u, &u.laplacian()).is_none());
        assert!(not_green(&u, &v, &-&v.laplacian()).is_some() && not_positive(&u, &-&u.laplacian()).is_some());
        assert!(not_green(&u, &v, &-&v.derivative(0).derivative(0)).is_some());
        let free = power(2, 0);
        assert!(not_green(&free, &v, &v.laplacian()).is_some(), "x² does not vanish on the boundary");
        assert!(not_adjoint(&free, &[Polynomial::variable(2, 0), Polynomial::zero(2)]).is_some());
    }

    #[test]
    fn the_polynomials_drawn_are_harmonic_and_others_miss_mean_and_maximum_principle() {
        let mut stream = Stream::new(2, "planted");
        for (n, degree) in [(2, 5), (3, 4), (3, 2)] {
            let p = harmonic(n, degree, &mut stream);
            assert!(p.laplacian().is_zero() && p.degree() == Some(degree), "{p}");
        }
        let (bowl, origin) = (&power(2, 0) + &power(2, 1), [Rational::ZERO, Rational::ZERO]);
        assert!(strict_extremum(&bowl, &origin, Ordering::Less).is_some());
        assert!(strict_extremum(&-&bowl, &origin, Ordering::Greater).is_some());
        assert!(not_the_mean(&bowl, &origin, &Rational::ONE, Polynomial::average_over_ball).is_some());
        assert!(not_the_mean(&bowl, &origin, &Rational::ONE, Polynomial::average_over_sphere).is_some());
        let saddle = &power(2, 0) - &power(2, 1);
        assert!(minimum_at_the_origin(&saddle).is_none() && minimum_at_the_origin(&bowl).is_some());
        let found = no_minimum().answer("no-minimum", "", "polynomials");
        assert!(
            found.finding.starts_with("3 of ") && found.finding.contains("the first: the constant 1"),
            "{}",
            found.finding
        );
        assert_eq!(recheck::from_excerpt(&found.evidence[0]), Ok(recheck::Rechecked::Exact));
    }

    #[test]
    fn a_derivative_with_a_wrong_sign_breaks_stokes() {
        let mut stream = Stream::new(3, "planted");
        let (form, simplex) = (Form::random(2, 1, 2, &mut stream), random_simplex(2, 2, &mut stream));
        assert!(not_stokes(&form, &form.d(), &simplex).is_none());
        assert!(not_stokes(&form, &Form::random(2, 2, 1, &mut stream), &simplex).is_some());
        let turned: Vec<Vec<Rational>> = simplex.iter().rev().cloned().collect();
        assert_eq!(form.d().over(&turned), -form.d().over(&simplex));
    }

    #[test]
    fn another_metric_and_a_term_of_order_zero_are_noticed() {
        let mut stream = Stream::new(4, "planted");
        let (metric, other) = (Metric::random(2, &mut stream), Metric::random(2, &mut stream));
        assert!(not_recovered(metric.inverse(), |f| metric.laplacian(f)).is_none());
        assert!(not_recovered(metric.inverse(), |f| other.laplacian(f)).is_some());
        assert!(not_recovered(metric.inverse(), |f| &metric.laplacian(f) + f).is_some());
    }
}
