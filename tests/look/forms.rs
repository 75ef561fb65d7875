//! A look at statements about smooth forms: the values of their coefficients at points, and differences of these that are exact for
//! polynomials up to degree 4.

use lapjury::property::evidence::{Exception, Term};
use lapjury::property::{Evidence, Statement};

/// Changes a number of the statement.
pub fn spoil(evidence: &mut Evidence) {
    if let Statement::HarmonicForm { form, .. } = &mut evidence.statement {
        form[0].exponents[0] += 1;
    }
}

/// Whether the statement is true; its kind.
pub fn look(evidence: &Evidence) -> Result<&'static str, String> {
    let Statement::HarmonicForm { dimension: n, form, exception } = &evidence.statement else {
        return Err(format!("no way to look at {:?}", evidence.statement));
    };
    is(form.iter().all(|t| t.exponents.iter().sum::<u32>() <= 4), "the differences are not exact")?;
    let (first, second) = ([1.0, -8.0, 0.0, 8.0, -1.0], [-1.0, 16.0, -30.0, 16.0, -1.0]);
    // In orthonormal coordinates the Laplacian acts on each coefficient by itself.
    let laplacian = |set: usize, x: &[f64]| -(0..*n).map(|k| difference(form, set, x, k, second)).sum::<f64>();
    // The component of dα at J is Σ ± ∂α_(J without k)/∂x_k over k in J, that of d*α at I −Σ ± ∂α_(I with k)/∂x_k over k not in I.
    let sign = |set: usize, k: usize| if (set & ((1 << k) - 1)).count_ones().is_multiple_of(2) { 1.0 } else { -1.0 };
    let part = |set: usize, x: &[f64], inside: bool| -> f64 {
        let axes = (0..*n).filter(|k| (set >> k & 1 == 1) == inside);
        axes.map(|k| sign(set, k) * difference(form, set ^ 1 << k, x, k, first)).sum()
    };
    for x in points(*n) {
        for set in 0..1 << n {
            is(near(laplacian(set, &x), 0.0), "not harmonic")?;
            match exception {
                Exception::Closed { derivative } => {
                    is(near(part(set, &x, true), at(derivative, set, &x)), "another derivative")?;
                }
                Exception::CoClosed { codifferential } => {
                    is(near(-part(set, &x, false), at(codifferential, set, &x)), "another codifferential")?;
                }
                Exception::NoMinimum { value } => {
                    is(set != 0 || at(form, 0, &x) == value.approximate(), "another value")?;
                    is(set == 0 || at(form, set, &x) == 0.0, "no function")?;
                }
            }
        }
    }
    if let Exception::Closed { derivative: image } | Exception::CoClosed { codifferential: image } = exception {
        let nonzero = |x: &Vec<f64>| (0..1 << n).any(|set| at(image, set, x) != 0.0);
        is(points(*n).iter().any(nonzero), "the image is zero")?;
    }
    Ok("harmonic-form")
}

fn is(truth: bool, what: &str) -> Result<(), String> {
    if truth { Ok(()) } else { Err(what.to_string()) }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * (1.0 + a.abs() + b.abs())
}

/// Points without symmetry, more than polynomials of degree 4 in one variable have zeros.
fn points(n: usize) -> Vec<Vec<f64>> {
    (1..=6).map(|p| (0..n).map(|k| f64::from(p) * 0.75 - 2.0 + k as f64 / 8.0).collect()).collect()
}

/// The coefficient of a set of differentials, a bit mask, at a point.
fn at(form: &[Term], set: usize, x: &[f64]) -> f64 {
    let terms = form.iter().filter(|t| t.differentials.iter().map(|k| 1 << k).sum::<usize>() == set);
    terms
        .map(|t| {
            let powers = t.exponents.iter().zip(x).map(|(&e, x)| x.powi(e as i32));
            t.coefficient.approximate() * powers.product::<f64>()
        })
        .sum()
}

/// A twelfth of a weighted sum of values, in steps of 1 along the k-th coordinate.
fn difference(form: &[Term], set: usize, x: &[f64], k: usize, weights: [f64; 5]) -> f64 {
    let moved = |by: f64| x.iter().enumerate().map(|(j, x)| if j == k { x + by } else { *x }).collect::<Vec<f64>>();
    let terms = weights.iter().zip([-2.0, -1.0, 0.0, 1.0, 2.0]);
    terms.map(|(w, by)| w * at(form, set, &moved(by))).sum::<f64>() / 12.0
}
