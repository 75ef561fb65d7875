//! Forms with polynomial coefficients in words.

use super::sentence::superscript;
use crate::record::evidence::{Exception, Term};

/// What a harmonic form is an exception to.
pub(super) fn exception(form: &[Term], exception: &Exception) -> String {
    let name = match form.first().map_or(0, |t| t.differentials.len()) {
        0 => "the function".to_string(),
        k => format!("the {k}-form"),
    };
    let written = written(form);
    match exception {
        Exception::Closed { derivative } => {
            format!("{name} α = {written} is harmonic, Δα = 0, and not closed: dα = {}", self::written(derivative))
        }
        Exception::CoClosed { codifferential } => {
            format!(
                "{name} α = {written} is harmonic, Δα = 0, and not co-closed: d*α = {}",
                self::written(codifferential)
            )
        }
        Exception::NoMinimum { value } => {
            let value = value.to_string().replace('-', "−");
            format!(
                "the function u = {written} is harmonic, Δu = 0, and {value} everywhere: every point is a minimum, and none a strict one"
            )
        }
    }
}

/// The terms in their order, as in a book: `−y dx + x dy`.
fn written(terms: &[Term]) -> String {
    let mut said = String::new();
    for term in terms {
        let c = term.coefficient.to_string();
        let (sign, size) = c.strip_prefix('-').map_or((" + ", c.as_str()), |size| (" − ", size));
        said += match (said.is_empty(), sign) {
            (true, " + ") => "",
            (true, _) => "−",
            _ => sign,
        };
        let powers = term.exponents.iter().enumerate().filter(|(_, e)| **e > 0).map(|(k, &e)| match e {
            1 => coordinate(k),
            _ => format!("{}{}", coordinate(k), superscript(e as usize)),
        });
        let differentials: Vec<String> = term.differentials.iter().map(|&k| format!("d{}", coordinate(k))).collect();
        let mut factors: Vec<String> = powers.collect();
        factors.extend((!differentials.is_empty()).then(|| differentials.join("∧")));
        if size != "1" || factors.is_empty() {
            factors.insert(0, size.to_string());
        }
        said += &factors.join(" ");
    }
    if said.is_empty() { "0".into() } else { said }
}

/// x, y, z, and by their numbers from the fourth coordinate on.
fn coordinate(k: usize) -> String {
    ["x", "y", "z"].get(k).map_or_else(|| format!("x{k}"), |name| (*name).to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::evidence::Fraction;

    fn term(coefficient: &str, exponents: &[u32], differentials: &[usize]) -> Term {
        let coefficient = Fraction::text(coefficient);
        Term { coefficient, exponents: exponents.to_vec(), differentials: differentials.to_vec() }
    }

    #[test]
    fn a_form_is_written_as_in_a_book() {
        let turning = [term("-1", &[0, 1], &[0]), term("1", &[1, 0], &[1])];
        assert_eq!(written(&turning), "−y dx + x dy");
        assert_eq!(written(&[term("3/2", &[2, 1], &[0, 1]), term("-1", &[0, 0], &[0, 1])]), "3/2 x² y dx∧dy − dx∧dy");
        assert_eq!((written(&[term("-1", &[0], &[])]), written(&[])), ("−1".to_string(), "0".to_string()));
        assert_eq!(written(&[term("1", &[0, 0, 0, 10], &[3])]), "x3¹⁰ dx3");
        let derivative = vec![term("2", &[0, 0], &[0, 1])];
        let said = exception(&turning, &Exception::Closed { derivative });
        let constant = exception(&[term("-2", &[0], &[])], &Exception::NoMinimum { value: Fraction::text("-2") });
        assert!(constant.starts_with("the function u = −2 is harmonic, Δu = 0, and −2 everywhere: "), "{constant}");
        assert_eq!(said, "the 1-form α = −y dx + x dy is harmonic, Δα = 0, and not closed: dα = 2 dx∧dy");
    }
}
