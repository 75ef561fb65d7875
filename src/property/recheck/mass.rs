//! Witnesses about mass matrices.

use std::cmp::Ordering;

use super::energy::{self, Area, area};
use super::excerpt::{Material, Rows};
use super::shares::Star;
use super::terms::Terms;
use super::{Answer, Rechecked, Refusal, check_number, check_threshold, witness};
use crate::property::evidence::SparseVector;

/// The total mass is not the area.
pub(super) fn total(m: &Material, found: f64, expected: f64, threshold: f64) -> Answer {
    check_threshold(threshold)?;
    m.faces.iter().flat_map(|f| &f.1).try_for_each(|&v| m.mass.row(v).map(drop))?;
    m.mass.check_closed(|_| false)?;
    let mut sum = Terms::default();
    m.mass.iter().flat_map(|(_, row)| row).for_each(|e| sum.add(e.1));
    let area = area(m.faces.iter().map(|f| f.1.as_slice()), |v| m.position(v))?;
    let (size, error) = area.approximate();
    check_number("found", found, sum.value(), sum.scale())?;
    check_number("expected", expected, size, size)?;
    let name = || "|1ᵀM1 − area|".to_string();
    match area {
        Area::Planar { terms, .. } => {
            sum.append(-1.0, terms);
            witness::exceeds(&sum, threshold, name)?;
            Ok(Rechecked::Exact)
        }
        Area::Spatial(..) => {
            let faces = || m.faces.iter().map(|f| f.1.as_slice());
            energy::differs(sum, 1.0, (size, error), || energy::sharp_area(faces(), |v| m.position(v)), threshold, name)
        }
    }
}

/// `xᵀMx ≤ 0`.
pub(super) fn not_positive(rows: &Rows, x: &SparseVector) -> Answer {
    let energy = witness::quadratic_form(rows, &witness::vector(x)?)?;
    if energy.sign() == Ordering::Greater {
        return Err(Refusal::untrue("xᵀMx ≤ 0", format!("{:e}", energy.value())));
    }
    Ok(Rechecked::Exact)
}

/// The share of a vertex is outside bounds that admit a share known from the literature.
pub(super) fn share(m: &Material, i: usize, lower: f64, upper: f64) -> Answer {
    for (name, value) in [("lower", lower), ("upper", upper)] {
        if !value.is_finite() {
            return Err(Refusal::Parameter { name, value, must: "finite" });
        }
    }
    let outside = |bound: f64, side: Ordering| -> Result<bool, Refusal> {
        let mut sum = witness::row_sum(&m.mass, i)?;
        sum.add(-bound);
        Ok(sum.sign() == side)
    };
    if !outside(lower, Ordering::Less)? && !outside(upper, Ordering::Greater)? {
        let found = witness::row_sum(&m.mass, i)?.value();
        return Err(Refusal::untrue(format!("the share of {i} is outside [{lower}, {upper}]"), found.to_string()));
    }
    let mut star = Star::default();
    for (index, corners) in m.faces {
        let Some(at) = corners.iter().position(|&v| v == i) else {
            return Err(Refusal::Malformed {
                what: "face",
                index: *index,
                problem: "is not in the star of the vertex",
            });
        };
        let positions = corners.iter().map(|&v| m.position(v)).collect::<Result<Vec<_>, _>>()?;
        star.add(&positions, at);
    }
    let admits = |share: f64| lower <= share + 1e-6 * star.area && share - 1e-6 * star.area <= upper;
    if lower <= upper && [star.even, star.circumcentric, star.mixed].into_iter().any(admits) {
        return Ok(Rechecked::Exact);
    }
    Err(Refusal::untrue(
        format!("the star sets the bounds [{lower}, {upper}]"),
        format!("no known share: even {}, circumcentric {}, mixed {}", star.even, star.circumcentric, star.mixed),
    ))
}
