//! Cotangent weights once more: `cot θ = d/√a` in rationals, with roots of our own.

use std::cmp::Ordering;

use dashu_base::{BitTest, SquareRoot};
use dashu_int::{IBig, UBig};

use super::excerpt::Material;
use super::scan::{Scan, Seen};
use super::terms::U;
use super::{Answer, Rechecked, Refusal, check_number, check_threshold};
use crate::scalar::{Rational, Scalar};

/// Bits of a root. A weight is then known to 2⁻³⁰⁰ of its cotangents, and an error to as much.
const BITS: isize = 300;

/// The squared sine, relative to the sides, below which plain `f64` is not asked.
const THIN: f64 = 1.0 / (1_u64 << 20) as f64;

/// A weight and the sum of the magnitudes of its terms.
struct Weight {
    value: Rational,
    size: Rational,
}

/// `½ Σ cot` over the angles at the first points; `None` if one of the triangles is degenerate.
fn weight(corners: &[[[f64; 3]; 3]]) -> Option<Weight> {
    let (mut value, mut size) = (Rational::zero(), Rational::zero());
    for &corner in corners {
        let cot = cotangent(corner)? * Rational::half();
        size += cot.magnitude();
        value += cot;
    }
    Some(Weight { value, size })
}

/// The cotangent at the first of three points from squared lengths: `2d = B + C − A`, `4a = 4BC − (2d)²`.
fn cotangent(corner: [[f64; 3]; 3]) -> Option<Rational> {
    let [k, p, q] = corner.map(|x| x.map(|x| Rational::exactly(x).unwrap_or_else(Rational::zero)));
    let squared = |x: &[Rational; 3], y: &[Rational; 3]| {
        (0..3).fold(Rational::zero(), |sum, c| {
            let difference = x[c].clone() - y[c].clone();
            sum + difference.clone() * difference
        })
    };
    let (a, b, c) = (squared(&p, &q), squared(&k, &p), squared(&k, &q));
    let twice = b.clone() + c.clone() - a;
    let four = Rational::from(IBig::from(4)) * b * c - twice.clone() * twice.clone();
    if four.cmp_zero() != Ordering::Greater {
        return None;
    }
    let sign = twice.cmp_zero();
    let root = root(twice.clone() * twice / four);
    Some(if sign == Ordering::Less { -root } else { root })
}

/// The square root of a number that is not negative.
fn root(square: Rational) -> Rational {
    let (numerator, denominator) = square.into_parts();
    let numerator = UBig::try_from(numerator).unwrap_or_default();
    let shifted = |n: UBig, by: isize| if by > 0 { n << by as usize } else { n };
    let k = BITS + (denominator.bit_len() as isize - numerator.bit_len() as isize) / 2;
    let root = (shifted(numerator, 2 * k) / shifted(denominator, -2 * k)).sqrt();
    let power = |by: isize| IBig::from(shifted(UBig::ONE, by));
    Rational::from(IBig::from(root) * power(-k)) / Rational::from(power(k))
}

/// ACC: `|−L_ij − ½ Σ cot| > threshold`, and more than one rounding of its terms.
pub(super) fn decide(m: &Material, [i, j]: [usize; 2], exact: f64, error: f64, threshold: f64) -> Answer {
    check_threshold(threshold)?;
    let given = -m.rows.entry(i, j)?;
    let mut corners = Vec::new();
    for (index, face) in m.faces {
        let [a, b, c] = face[..] else {
            return Err(Refusal::Malformed { what: "face", index: *index, problem: "is no triangle" });
        };
        let Some(apex) = [a, b, c].into_iter().find(|v| ![i, j].contains(v)).filter(|_| i != j) else {
            return Err(Refusal::Malformed { what: "face", index: *index, problem: "does not lie at the edge" });
        };
        if ![i, j].iter().all(|v| face.contains(v)) {
            return Err(Refusal::Malformed { what: "face", index: *index, problem: "does not lie at the edge" });
        }
        corners.push([m.position(apex)?, m.position(i)?, m.position(j)?]);
    }
    if corners.is_empty() {
        return Err(Refusal::Missing { what: "a face at the edge from vertex", index: i });
    }
    let Some(weight) = weight(&corners) else {
        return Err(Refusal::untrue("the triangles at the edge are proper", "one is degenerate"));
    };
    let difference = (Rational::exactly(given).unwrap_or_else(Rational::zero) - weight.value.clone()).magnitude();
    let bound = |x: f64| Rational::exactly(x).unwrap_or_else(Rational::zero);
    // Twice a root's error on either side: the sign is that of the exact difference.
    let slack = weight.size.clone() * bound(U * U * U * U);
    for (least, what) in [(bound(threshold), "the threshold"), (weight.size * bound(U), "one rounding of its terms")] {
        if difference <= least.clone() + slack.clone() {
            return Err(Refusal::untrue(
                format!("L_{i},{j} is off by more than {what}, {:e}", least.approximate()),
                format!("{:e}", difference.approximate()),
            ));
        }
    }
    let found = weight.value.approximate();
    check_number("exact", exact, found, found)?;
    check_number("error", error, difference.approximate(), difference.approximate())?;
    Ok(Rechecked::Bounded)
}

/// The certificate of ACC: every weight on an edge between proper triangles is off by no more than rounding explains.
pub(super) fn scan(scan: &Scan) -> Result<Seen, Refusal> {
    let Some(surface) = scan.domain.as_surface() else {
        return Err(Refusal::untrue("the domain is a surface", scan.domain.kind().to_string()));
    };
    let l = scan.operator.stiffness();
    let mut seen = Seen { exact: false, places: 0 };
    for (edge, &[i, j]) in surface.topology().edges().iter().enumerate() {
        let at = |v: usize| surface.positions()[v];
        let corners: Vec<_> = surface.opposite(edge).into_iter().map(|(_, apex)| [at(apex), at(i), at(j)]).collect();
        let plainly = corners.iter().try_fold(0.0, |sum, corner| plain(corner).map(|cot| sum + 0.5 * cot));
        let mut exactly = None;
        for (i, j) in [(i, j), (j, i)] {
            let given = -l.at(i, j);
            let allowed = scan.leeway.rows[i];
            if plainly.is_some_and(|weight| (given - weight).abs() <= allowed) {
                continue;
            }
            if exactly.is_none() {
                exactly = Some(weight(&corners));
            }
            // An edge beside a degenerate triangle is not one of the places.
            let Some(Some(weight)) = &exactly else { continue };
            let given = Rational::exactly(given).unwrap_or_else(Rational::zero);
            let difference = (given.clone() - weight.value.clone()).magnitude().approximate();
            if difference > allowed {
                return Err(Refusal::untrue(
                    format!("the weight of ({i}, {j}) is ½ Σ cot = {:e}", weight.value.approximate()),
                    format!("{:e}", given.approximate()),
                ));
            }
        }
        if plainly.is_some() || matches!(exactly, Some(Some(_))) {
            seen.places += 1;
        }
    }
    Ok(seen)
}

/// The cotangent in plain `f64`; `None` where the triangle is thin or out of range, so that this would say little.
fn plain([apex, p, q]: &[[f64; 3]; 3]) -> Option<f64> {
    let u: [f64; 3] = std::array::from_fn(|k| p[k] - apex[k]);
    let v: [f64; 3] = std::array::from_fn(|k| q[k] - apex[k]);
    let dot = |a: &[f64; 3], b: &[f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let (square, sides) = (dot(&n, &n), dot(&u, &u) * dot(&v, &v));
    (square.is_normal() && sides.is_normal() && square > THIN * sides).then(|| dot(&u, &v) / square.sqrt())
}
