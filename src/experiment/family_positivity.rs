//! For which exponents the one-parameter family is positive at every vertex inside every convex polygon: 0 and 1 alone.
//!
//! # Where the witnesses come from
//! Let v lie between its neighbours u and w on the polygon, `v = a u + b w`. The corner at v is convex where `a + b > 1`, and
//! the weight of v is negative exactly where `|v|^p > a |u|^p + b |w|^p`. With `u = (cos θ, −sin θ)`, `w = R (cos θ, sin θ)`, `v = (ρ, 0)`
//! both are conditions on `cos θ`:
//! ```text
//! ρ^(1−p) (1 + R^(p−1))/2  <  cos θ  <  ρ (1 + 1/R)/2,    cos θ < 1
//! ```
//! The interval is empty for p = 0 (both ends are equal) and p = 1 (the left end is 1). For p > 1 a spike serves (R = 1, ρ > 1),
//! for p < 0 a blunt corner (R = 1, ρ < 1), between 0 and 1 a lopsided one (R large). The polygon is closed by one more corner behind
//! the origin. With `ρ = s^q`, `R = S^q` everything is rational for `p = m/q`.

use std::cmp::Ordering;

use super::poll::{Case, Every};
use super::world::excerpt::on_triangulation;
use super::world::stars::{Star, power};
use super::world::triangulations::{Triangulation, describe_world, world};
use super::{Experiment, Finding, Setting};
use crate::generate::Stream;
use crate::laplacian::three_point;
use crate::linalg::Dense;
use crate::property::Statement;
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "family-positivity",
    name: "Positivity of the one-parameter family on convex polygons",
    statement: "c_j = r_j^p gives positive weights at every vertex inside every convex polygon for p = 0 and p = 1, and for no other \
                exponent",
    sources: &["floater-hormann-kos2006", "wardetzky2007"],
    parts: &["positive-for-zero-and-one", "negative-for-every-other-exponent", "smallest-lattice-witness"],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let largest = setting.pick(5, 6);
    let mut positive = Every::default();
    let mut found: Vec<(i32, Option<Case>)> = [-4, -2, 2, 4].map(|p| (p, None)).to_vec();
    for t in world(largest) {
        let boundary = t.boundary();
        for i in (0..boundary.len()).filter(|&i| !boundary[i]) {
            let Some((star, ring)) = Star::of(&t, i).filter(|(star, _)| star.is_convex()) else { continue };
            positive.ask(negative(&star, 0).map(|k| told(&star, k, "p = 0")));
            for (p, case) in found.iter_mut().filter(|(_, case)| case.is_none()) {
                *case = lattice_case(&t, i, &star, &ring, *p);
            }
        }
    }
    for _ in 0..setting.pick(500, 4000) {
        let Some(star) = Star::random(1, &mut stream).filter(Star::is_convex) else { continue };
        for p in [0, 1] {
            positive.ask(negative(&star, p).map(|k| told(&star, k, &format!("p = {p}"))));
        }
    }
    let (mut others, mut sample) = (Every::default(), String::new());
    for (m, q) in exponents(setting.pick(2, 4) as i64) {
        let star = witness(m, q);
        let name = format!("p = {m}/{q}");
        let is_one = star.as_ref().is_some_and(|s| s.is_convex() && negative(s, m).is_some());
        if let (Some(star), true) = (&star, (m, q) == (1, 2)) {
            sample = format!("; for p = 1/2 {}", star.describe());
        }
        others.ask((!is_one).then(|| Case::told(format!("{name}: no convex polygon was found"))));
    }
    let mut lattice = Every::default();
    let mut shown = Vec::new();
    for (p, case) in found {
        lattice.ask(case.is_none().then(|| Case::told(format!("p = {p}: none in the lattice box"))));
        shown.extend(case);
    }
    let cases = describe_world(largest);
    let mut others = others.answer(
        ENTRY.parts[1],
        format!(
            "Is there, for every p = m/q with |p| ≤ 4 and q ≤ {} but 0 and 1, a convex polygon with a negative weight?",
            setting.pick(2, 4)
        ),
        "exponents",
    );
    others.finding += &sample;
    let mut lattice = lattice.answer(
        ENTRY.parts[2],
        format!("Is there a convex lattice polygon with a negative weight for p = −4, −2, 2, 4? Cases: {cases}."),
        "exponents",
    );
    lattice.finding = shown.iter().fold(lattice.finding, |text, case| text + "; smallest: " + &case.text);
    lattice.evidence = shown.into_iter().flat_map(|case| case.evidence).collect();
    vec![
        positive.answer(
            ENTRY.parts[0],
            format!(
                "Are all weights positive for p = 0 at the interior vertices with convex stars of {cases}, and for p = 0 and 1 in random \
                 convex polygons with spokes of rational length?"
            ),
            "stars and exponents",
        ),
        others,
        lattice,
    ]
}

/// The spoke with a weight that is not positive, for `c = root^exponent`.
fn negative(star: &Star, exponent: i64) -> Option<usize> {
    star.weights(&star.numbers(exponent)).iter().position(|w| w.cmp_zero() != Ordering::Greater)
}

fn told(star: &Star, spoke: usize, name: &str) -> Case {
    Case::told(format!("{name}: spoke {spoke} of {}", star.describe()))
}

/// A negative weight of the family's matrix at a vertex with a convex star.
fn lattice_case(t: &Triangulation, i: usize, star: &Star, ring: &[usize], p: i32) -> Option<Case> {
    let weights = star.weights(&star.numbers(i64::from(p / 2)));
    let j = ring[weights.iter().position(|w| w.cmp_zero() == Ordering::Less)?];
    let matrix = Dense::from_csr(&three_point::stiffness_in_plane::<Rational>(&t.surface(), p)?);
    let text = format!("p = {p}: ω_{i}{j} = {} on {}", -matrix.at(i, j).clone(), t.describe());
    let statement = Statement::Weight { i, j, zero: false, opposite: Vec::new() };
    let mut witness = on_triangulation(statement, t, &matrix, &[i]);
    // The row shows the sign. A mesh beside a weight is there for its cotangents, and this weight has others.
    witness.excerpt.faces.clear();
    Some(Case::shown(text, witness))
}

/// The exponents m/q in lowest terms, |m/q| ≤ 4, but 0 and 1.
fn exponents(largest: i64) -> Vec<(i64, i64)> {
    let lowest = |m: i64, q: i64| (2..=q).all(|d| m % d != 0 || q % d != 0);
    let all = (1..=largest).flat_map(|q| (-4 * q..=4 * q).map(move |m| (m, q)));
    all.filter(|&(m, q)| lowest(m, q) && m != 0 && m != q).collect()
}

/// A convex quadrangle around the origin in which a weight of the exponent m/q is negative, as the heading describes; `None`
/// where the search meets none.
fn witness(m: i64, q: i64) -> Option<Star> {
    let whole = |k: i64| Rational::from(k);
    let ratio = |a: i64, b: i64| whole(a) / whole(b);
    let roots: Vec<Rational> =
        [ratio(2, 1), ratio(1, 2)].into_iter().chain((2..9).flat_map(|k| [ratio(k + 1, k), ratio(k, k + 1)])).collect();
    let pairs = (0..24).flat_map(|k| roots.iter().map(move |s| (power(&Rational::from(2), k), s)));
    pairs.into_iter().find_map(|(large, s)| {
        // ρ^p = s^m, R^(p−1) = S^(m−q).
        let low = power(s, q - m) * (Rational::ONE + power(&large, m - q)) / whole(2);
        let high = power(s, q) * (Rational::ONE + power(&large, -q)) / whole(2);
        let high = if high > Rational::ONE { Rational::ONE } else { high };
        let tangent = if low < high { half_tangent(&low, &high)? } else { return None };
        let mut star = Star { spokes: Vec::new(), roots: Vec::new() };
        star.push(&-tangent.clone(), &Rational::ONE, q);
        star.push(&Rational::zero(), s, q);
        star.push(&tangent, &large, q);
        close(star, s, q).filter(|star| negative(star, m).is_some())
    })
}

/// A rational t with `(1 − t²)/(1 + t²)` between two numbers, 0 ≤ low < high ≤ 1.
fn half_tangent(low: &Rational, high: &Rational) -> Option<Rational> {
    let middle = ((low.clone() + high.clone()) / Rational::from(2)).approximate();
    let t = ((1.0 - middle) / (1.0 + middle)).sqrt();
    (4..52).find_map(|bits| {
        let scale = f64::from(bits).exp2();
        let t = Rational::exactly((t * scale).round() / scale)?;
        let square = t.clone() * t.clone();
        let cosine = (Rational::ONE - square.clone()) / (Rational::ONE + square);
        (low < &cosine && &cosine < high).then_some(t)
    })
}

/// The star with one more corner behind the origin, opposite to the middle one, close enough that the quadrangle is convex.
fn close(star: Star, s: &Rational, q: i64) -> Option<Star> {
    (0..40).find_map(|k| {
        let mut closed = star.clone();
        let root = (s.clone() * power(&Rational::from(2), -k)).reduced();
        // Half an angle of π has no tangent: the spoke along the positive axis, turned round.
        closed.push(&Rational::zero(), &root, q);
        let last = closed.spokes.len() - 1;
        closed.spokes[last] = closed.spokes[last].clone().map(|x| -x);
        closed.is_convex().then_some(closed)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_of_witnesses_is_empty_for_zero_and_one_and_for_no_other_exponent() {
        for q in 1..=4 {
            assert!(witness(0, q).is_none() && witness(q, q).is_none());
        }
        for (m, q) in exponents(3) {
            let star = witness(m, q).unwrap_or_else(|| panic!("{m}/{q}"));
            assert_eq!((star.is_convex(), negative(&star, m)), (true, Some(1)), "{m}/{q}");
            assert_eq!((negative(&star, 0), negative(&star, q)), (None, None), "{m}/{q}");
        }
    }

    #[test]
    fn exponents_are_fractions_in_lowest_terms() {
        assert_eq!(exponents(1), [(-4, 1), (-3, 1), (-2, 1), (-1, 1), (2, 1), (3, 1), (4, 1)]);
        assert_eq!(exponents(2).len(), 7 + 8);
    }
}
