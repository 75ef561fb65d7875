//! Harmonic forms with polynomial coefficients, and what they are exceptions to.
//!
//! # Definition
//! In orthonormal coordinates, I a set of differentials, `ι_i dx_I` that without `dx_i` after it was brought to the front:
//!
//! ```text
//! d(p dx_I) = Σ_k ∂p/∂x_k dx_k ∧ dx_I,    d*(p dx_I) = −Σ_(i in I) ∂p/∂x_i ι_i dx_I,    Δ = dd* + d*d
//! ```

use std::collections::BTreeMap;

use super::alone::lowest_terms;
use super::{Answer, Rechecked, Refusal};
use crate::property::evidence::{Exception, Fraction, Term};
use crate::scalar::{Rational, sum};

/// The most dimensions and terms that are computed with.
const LARGEST: (usize, usize) = (8, 1024);

/// The coefficient of each pair of differentials, ascending, and exponents; none is zero.
#[derive(Clone, Debug, Default, PartialEq)]
struct Form(BTreeMap<(Vec<usize>, Vec<u32>), Rational>);

impl Form {
    fn read(what: &'static str, dimension: usize, terms: &[Term]) -> Result<Self, Refusal> {
        let mut form = Form::default();
        for (index, term) in terms.iter().enumerate() {
            let malformed = |problem| Err(Refusal::Malformed { what, index, problem });
            let coefficient = lowest_terms(what, index, &term.coefficient)?;
            let dx = &term.differentials;
            if term.exponents.len() != dimension {
                return malformed("has not one exponent for each dimension");
            }
            if dx.windows(2).any(|pair| pair[0] >= pair[1]) || dx.last().is_some_and(|k| *k >= dimension) {
                return malformed("has differentials that do not ascend, or of no coordinate");
            }
            let new = form.0.insert((dx.clone(), term.exponents.clone()), coefficient.clone()).is_none();
            if coefficient == Rational::ZERO || !new {
                return malformed("is zero, or given twice");
            }
        }
        Ok(form)
    }

    fn add(&mut self, dx: Vec<usize>, exponents: Vec<u32>, coefficient: Rational) {
        let key = (dx, exponents);
        let total = sum(self.0.remove(&key).into_iter().chain([coefficient]));
        if total != Rational::ZERO {
            self.0.insert(key, total);
        }
    }

    /// Derives every term by each coordinate k; `place` says what becomes of the differentials, with the sign turned where true.
    fn derived(&self, dimension: usize, place: impl Fn(usize, &[usize]) -> Option<(Vec<usize>, bool)>) -> Self {
        let mut result = Form::default();
        for ((dx, exponents), c) in &self.0 {
            for k in (0..dimension).filter(|&k| exponents[k] > 0) {
                let Some((dx, turned)) = place(k, dx) else { continue };
                let value = c.clone() * Rational::from(exponents[k]);
                let mut lower = exponents.clone();
                lower[k] -= 1;
                result.add(dx, lower, if turned { -value } else { value });
            }
        }
        result
    }

    /// `d`.
    fn d(&self, dimension: usize) -> Self {
        self.derived(dimension, |k, dx| {
            let before = dx.binary_search(&k).err()?;
            Some(([&dx[..before], &[k], &dx[before..]].concat(), before % 2 == 1))
        })
    }

    /// `d*`.
    fn codifferential(&self, dimension: usize) -> Self {
        self.derived(dimension, |k, dx| {
            let before = dx.binary_search(&k).ok()?;
            Some(([&dx[..before], &dx[before + 1..]].concat(), before % 2 == 0))
        })
    }

    /// `dd* + d*d`.
    fn laplacian(&self, dimension: usize) -> Self {
        let mut total = self.codifferential(dimension).d(dimension);
        let other = self.d(dimension).codifferential(dimension);
        other.0.into_iter().for_each(|((dx, exponents), c)| total.add(dx, exponents, c));
        total
    }

    /// `2 x0 x1^3 dx0∧dx1 + …`.
    fn written(&self) -> String {
        let term = |((dx, exponents), c): (&(Vec<usize>, Vec<u32>), &Rational)| {
            let power = |(k, e): (usize, &u32)| match e {
                0 => String::new(),
                1 => format!(" x{k}"),
                e => format!(" x{k}^{e}"),
            };
            let powers: String = exponents.iter().enumerate().map(power).collect();
            let differentials = dx.iter().map(|k| format!("dx{k}")).collect::<Vec<_>>().join("∧");
            let space = if dx.is_empty() { "" } else { " " };
            format!("{}{powers}{space}{differentials}", Fraction::from(c))
        };
        let terms: Vec<String> = self.0.iter().map(term).collect();
        if terms.is_empty() { "0".into() } else { terms.join(" + ") }
    }
}

/// α is harmonic, and an exception as stated.
pub(super) fn decide(dimension: usize, form: &[Term], exception: &Exception) -> Answer {
    let alpha = Form::read("term of α", dimension, form)?;
    let degree = alpha.0.keys().next().map(|(dx, _)| dx.len());
    if degree.is_none() || alpha.0.keys().any(|(dx, _)| Some(dx.len()) != degree) {
        return Err(Refusal::untrue("α is a form of one degree, not zero", alpha.written()));
    }
    if dimension > LARGEST.0 || form.len() > LARGEST.1 {
        let size = format!("{} terms in {dimension} dimensions", form.len());
        return Ok(Rechecked::Open(format!("{size} are more than are computed with")));
    }
    let laplacian = alpha.laplacian(dimension);
    if laplacian != Form::default() {
        return Err(Refusal::untrue("Δα = 0", laplacian.written()));
    }
    match exception {
        Exception::Closed { derivative } => image("dα", &alpha, |a| a.d(dimension), (dimension, derivative)),
        Exception::CoClosed { codifferential } => {
            image("d*α", &alpha, |a| a.codifferential(dimension), (dimension, codifferential))
        }
        Exception::NoMinimum { value } => everywhere(&alpha, (dimension, degree), value),
    }
}

/// The image of α under `map` is the one stated and not zero, and each term has a share in it, so that none can be changed.
fn image(
    name: &'static str,
    alpha: &Form,
    map: impl Fn(&Form) -> Form,
    (dimension, stated): (usize, &[Term]),
) -> Answer {
    let (stated, found) = (Form::read("term of the image", dimension, stated)?, map(alpha));
    if found == Form::default() {
        return Err(Refusal::untrue(format!("{name} is not zero"), "it is"));
    }
    if stated != found {
        return Err(Refusal::untrue(format!("{name} = {}", stated.written()), found.written()));
    }
    let idle = |(key, c): (&(Vec<usize>, Vec<u32>), &Rational)| {
        let alone = Form(BTreeMap::from([(key.clone(), c.clone())]));
        (map(&alone) == Form::default()).then(|| alone.written())
    };
    match alpha.0.iter().find_map(idle) {
        Some(term) => {
            Err(Refusal::untrue(format!("every term of α has a share in {name}"), format!("{term} has none")))
        }
        None => Ok(Rechecked::Exact),
    }
}

/// α is a function and has this value everywhere. A harmonic function that is not constant has no local minimum.
fn everywhere(alpha: &Form, (dimension, degree): (usize, Option<usize>), value: &Fraction) -> Answer {
    let constant = Form(BTreeMap::from([((Vec::new(), vec![0; dimension]), lowest_terms("value", 0, value)?)]));
    if degree == Some(0) && *alpha == constant {
        return Ok(Rechecked::Exact);
    }
    Err(Refusal::untrue(format!("α is the constant {value}"), alpha.written()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every `x^a dx_I` in `n` dimensions with exponents below 4, and a form made of all of them.
    fn samples(n: u32) -> Vec<Form> {
        let key = |code: usize| {
            let dx: Vec<usize> = (0..n as usize).filter(|k| code >> k & 1 == 1).collect();
            (dx, (0..n).map(|k| (code >> n >> (2 * k) & 3) as u32).collect::<Vec<u32>>())
        };
        let term = |code: usize| (key(code), Rational::from(1 + code as u64 % 7));
        let all: BTreeMap<_, _> = (0..1_usize << (3 * n)).map(term).collect();
        all.iter().map(|(k, c)| Form(BTreeMap::from([(k.clone(), c.clone())]))).chain([Form(all.clone())]).collect()
    }

    #[test]
    fn the_laplacian_is_minus_the_second_derivatives_of_each_coefficient() {
        for n in 1..=3 {
            for form in samples(n) {
                let n = n as usize;
                let mut expected = Form::default();
                for ((dx, exponents), c) in &form.0 {
                    for k in (0..n).filter(|&k| exponents[k] > 1) {
                        let mut lower = exponents.clone();
                        lower[k] -= 2;
                        let factor = Rational::from(exponents[k]) * Rational::from(exponents[k] - 1);
                        expected.add(dx.clone(), lower, -(c.clone() * factor));
                    }
                }
                assert_eq!(form.laplacian(n), expected);
                assert_eq!(form.d(n).d(n), Form::default());
                assert_eq!(form.codifferential(n).codifferential(n), Form::default());
            }
        }
    }

    #[test]
    fn the_codifferential_of_a_1_form_is_minus_the_divergence_and_that_of_the_area_turns() {
        let form = |dx: &[usize], e: [u32; 2], c: i64| Form(BTreeMap::from([((dx.to_vec(), e.to_vec()), c.into())]));
        assert_eq!(form(&[1], [1, 3], 2).codifferential(2), form(&[], [1, 2], -6));
        // d*(x dx∧dy) = −dy, d*(y dx∧dy) = dx: from (d(u dx + v dy), f dx∧dy) = ∫ (∂v/∂x − ∂u/∂y) f by parts.
        assert_eq!(form(&[0, 1], [1, 0], 1).codifferential(2), form(&[1], [0, 0], -1));
        assert_eq!(form(&[0, 1], [0, 1], 1).codifferential(2), form(&[0], [0, 0], 1));
    }
}
