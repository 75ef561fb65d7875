//! Certificates about eigenvalues: definiteness and kernel.

use std::collections::BTreeMap;

use super::leeway::Leeway;
use super::profile::{self, Profile, Symmetric};
use super::terms::{Terms, U};
use super::witness::NEARLY_ZERO;
use super::{Answer, Rechecked, Refusal, qr, scan};
use crate::domain::Domain;
use crate::operator::{Operator, Signs};

/// Above this size a dense triangularisation takes longer than a tenth of a second.
const DENSE: usize = 500;

/// PSD: symmetric, row sums zero, no negative weight.
pub(super) fn sum_of_squares(domain: &Domain, operator: &Operator) -> Answer {
    let l = operator.stiffness();
    let leeway = Leeway::of(domain, l);
    scan::check_finite(l)?;
    let symmetric = scan::symmetric(l, &leeway)?;
    let sums = scan::row_sums(l, &leeway, 0..l.rows())?;
    let mut exact = symmetric && sums;
    for (i, j, v) in l.entries().filter(|e| e.0 != e.1) {
        let zone = if operator.signs() == Signs::Exact { 0.0 } else { leeway.rows[i] };
        if *v > zone {
            return Err(Refusal::untrue("no weight is negative", format!("that of ({i}, {j}) is {}", -v)));
        }
        exact &= *v <= 0.0;
    }
    Ok(if exact { Rechecked::Exact } else { Rechecked::Bounded })
}

/// The symmetric part without its zero rows, and the row scales of `L`.
struct Reduced {
    kept: Vec<usize>,
    matrix: Symmetric,
    scales: Vec<f64>,
    dropped: usize,
}

fn reduced(operator: &Operator) -> Result<Reduced, Refusal> {
    let l = operator.stiffness();
    scan::check_finite(l)?;
    let (part, scales) = (l.symmetric_part(), l.row_scales());
    let kept: Vec<usize> = (0..l.rows()).filter(|&i| part.row(i).any(|(_, v)| *v != 0.0)).collect();
    if let Some(i) = kept.iter().find(|&&i| scales[i] == 0.0) {
        return Err(Refusal::untrue(
            "½(L + Lᵀ) is semi-definite",
            format!("row {i} of L is zero and its column is not"),
        ));
    }
    let mut place = vec![0; l.rows()];
    kept.iter().enumerate().for_each(|(at, &i)| place[i] = at);
    let row = |&i: &usize| part.row(i).filter(|(_, v)| **v != 0.0).map(|(j, v)| (place[j], *v)).collect();
    Ok(Reduced {
        matrix: kept.iter().map(row).collect(),
        scales: kept.iter().map(|&i| scales[i]).collect(),
        dropped: l.rows() - kept.len(),
        kept,
    })
}

impl Reduced {
    /// Factorises `A + factor·diag(lift)`: the number of negative pivots, and how far relative to s the matrix factorised may be
    /// from the one meant.
    fn negative(&self, lift: &[f64], factor: f64) -> Result<(usize, f64), String> {
        let factor = Profile::factor(&profile::add_diagonal(&self.matrix, lift, factor))?;
        // Symmetrising, scaling and shifting round four times.
        Ok((factor.negative_pivots(), factor.backward_error(&self.scales) + 4.0 * U))
    }
}

/// PSD: no eigenvalue relative to the row scales below the shift.
pub(super) fn shifted_factor(domain: &Domain, operator: &Operator, shift: f64) -> Answer {
    // Twice the shift: what a factorisation with the shift itself found positive is so for any order of elimination.
    // A shift that slivers made large says nothing of the other rows: then each row gets its own allowance.
    let reduced = reduced(operator)?;
    let local = shift > NEARLY_ZERO;
    let lift: Vec<f64> = if local {
        let leeway = Leeway::of(domain, operator.stiffness());
        reduced.kept.iter().zip(&reduced.scales).map(|(&i, s)| leeway.rows[i] + NEARLY_ZERO * s).collect()
    } else {
        reduced.scales.iter().map(|s| 2.0 * shift * s).collect()
    };
    let (negative, rounding) = match reduced.negative(&lift, 1.0) {
        Ok(found) => found,
        Err(why) => return Ok(Rechecked::Open(why)),
    };
    if rounding > shift.clamp(NEARLY_ZERO / 1024.0, NEARLY_ZERO) {
        return Ok(Rechecked::Open(format!(
            "the factorisation may have rounded by {rounding:e}, the shift is {shift:e}"
        )));
    }
    if negative > 0 {
        let by = if local { "what rounding explains".into() } else { format!("{:e} of the row scales", 2.0 * shift) };
        return Err(Refusal::untrue(
            format!("no energy is negative by more than {by}"),
            format!("{negative} pivots are"),
        ));
    }
    Ok(Rechecked::Bounded)
}

/// KER: as many eigenvalues near zero as there are components, none below, and locally constant functions among them.
pub(super) fn inertia(domain: &Domain, operator: &Operator, shift: f64, kernel: usize) -> Answer {
    let l = operator.stiffness();
    let reduced = reduced(operator)?;
    check_kernel(domain, operator, kernel, reduced.dropped)?;
    scan::symmetric(l, &Leeway::of(domain, l))?;
    let mut why = String::new();
    // Where the shift meets an eigenvalue of a leading block the factorisation is worthless: move it.
    for factor in [1.0, 1.5, 2.0, 3.0] {
        let shift = factor * shift;
        match (reduced.negative(&reduced.scales, shift), reduced.negative(&reduced.scales, -shift)) {
            (Ok((below, e)), Ok((within, f))) if e.max(f) <= 0.5 * shift => {
                let expected = components(domain) - reduced.dropped;
                if (below, within) == (0, expected) {
                    return Ok(Rechecked::Bounded);
                }
                return Err(Refusal::untrue(
                    format!("{expected} eigenvalues lie in ±{shift:e} relative to the row scales, none below"),
                    format!("{within} below {shift:e}, {below} below −{shift:e}"),
                ));
            }
            (Ok((_, e)), Ok((_, f))) => why = format!("factorising may have rounded by {:e}", e.max(f)),
            (Err(e), _) | (_, Err(e)) => why = e,
        }
    }
    Ok(Rechecked::Open(why))
}

/// KER for any matrix: the rank is at least n minus the number of components, and locally constant functions are in the kernel.
pub(super) fn singular_values(domain: &Domain, operator: &Operator, kernel: usize) -> Answer {
    let l = operator.stiffness();
    scan::check_finite(l)?;
    let scales = l.row_scales();
    let dropped = scales.iter().filter(|s| **s == 0.0).count();
    check_kernel(domain, operator, kernel, dropped)?;
    let n = l.rows();
    if n > DENSE {
        return Ok(Rechecked::Open(format!("{n} rows are too many for a dense triangularisation")));
    }
    let mut dense = vec![vec![0.0; n]; n];
    l.entries().filter(|(_, _, v)| **v != 0.0).for_each(|(i, j, v)| dense[i][j] = v / scales[i]);
    let bound = qr::singular_value_from_below(&dense, n - components(domain));
    if bound > 0.0 {
        return Ok(Rechecked::Bounded);
    }
    Ok(Rechecked::Open(format!("the smallest positive singular value could not be bounded away from zero ({bound:e})")))
}

fn components(domain: &Domain) -> usize {
    domain.components().into_iter().max().map_or(0, |m| m + 1)
}

/// The stated kernel has one dimension for each component (vertices without an edge may have been left out), and functions
/// that are constant on a component are in it.
pub(super) fn check_kernel(
    domain: &Domain,
    operator: &Operator,
    kernel: usize,
    isolated: usize,
) -> Result<(), Refusal> {
    let (of, count) = (domain.components(), components(domain));
    if kernel != count && kernel + isolated != count {
        return Err(Refusal::untrue(format!("the kernel has dimension {kernel}"), format!("{count} components")));
    }
    let l = operator.stiffness();
    let leeway = Leeway::of(domain, l);
    for i in 0..l.rows() {
        let mut sums: BTreeMap<usize, Terms> = BTreeMap::new();
        l.row(i).for_each(|(j, v)| sums.entry(of[j]).or_default().add(*v));
        for (component, sum) in sums {
            if sum.exceeds(leeway.rows[i]) {
                let stated = format!("row {i} sums to zero over component {component}");
                return Err(Refusal::untrue(stated, format!("{:e}", sum.value())));
            }
        }
    }
    Ok(())
}
