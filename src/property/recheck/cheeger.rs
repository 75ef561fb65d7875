//! The Cheeger constant of a small graph by its definition, and a vector below its bound.

use std::cmp::Ordering;

use super::excerpt::Material;
use super::witness::vector;
use super::{Answer, Rechecked, Refusal};
use crate::property::evidence::SparseVector;
use crate::scalar::{Rational, Scalar};

/// The largest number of vertices whose partitions are enumerated.
const LARGEST: usize = 16;

fn exact(x: f64) -> Rational {
    // Entries and components were found finite when they were read.
    Rational::exactly(x).unwrap_or_else(Rational::zero)
}

/// Decides that the partition into `side` and the rest has the smallest ratio λ_C, and that x is below `λ_C²/2`.
pub(super) fn below(m: &Material, x: &SparseVector, side: &[usize]) -> Answer {
    let n = m.rows.len();
    if n > LARGEST {
        return Ok(Rechecked::Open(format!("the partitions of more than {LARGEST} vertices are not enumerated")));
    }
    let weights = weights(m, n)?;
    let mask = side.iter().try_fold(0_usize, |mask, &v| match v {
        v if v < n && mask >> v & 1 == 0 => Ok(mask | 1 << v),
        index => {
            Err(Refusal::Malformed { what: "vertex", index, problem: "is twice on its side, or not in the graph" })
        }
    })?;
    let constant =
        (1..(1_usize << n) - 1).filter_map(|mask| ratio(&weights, mask)).reduce(|a, b| if b < a { b } else { a });
    let attained = if mask == 0 || mask == (1 << n) - 1 { None } else { ratio(&weights, mask) };
    let (Some(constant), Some(attained)) = (constant, attained) else {
        return Err(Refusal::untrue("the partition has a finite ratio", "it has not"));
    };
    if attained != constant {
        return Err(Refusal::untrue(
            format!("the smallest ratio is {}", attained.approximate()),
            constant.approximate().to_string(),
        ));
    }
    let x = vector(x)?;
    if let Some((&index, _)) = x.range(n..).next() {
        return Err(Refusal::Missing { what: "row", index });
    }
    let at = |v: usize| x.get(&v).copied().map_or_else(Rational::zero, exact);
    let degree = |i: usize| weights[i].iter().fold(Rational::zero(), |sum, w| sum + w.clone());
    let (mut energy, mut square, mut mean, mut total) =
        (Rational::zero(), Rational::zero(), Rational::zero(), Rational::zero());
    for (i, row) in weights.iter().enumerate() {
        for (j, weight) in row.iter().enumerate().take(i) {
            let difference = at(i) - at(j);
            energy += weight.clone() * difference.clone() * difference;
        }
        square += degree(i) * at(i) * at(i);
        mean += degree(i) * at(i);
        total += degree(i);
    }
    let bound = constant.clone() * constant * Rational::half() * (square - mean.clone() * mean / total);
    if (energy.clone() - bound.clone()).cmp_zero() == Ordering::Less {
        return Ok(Rechecked::Exact);
    }
    Err(Refusal::untrue(format!("xᵀLx < {}", bound.approximate()), energy.approximate().to_string()))
}

/// `ω_ij`, from the rows of a Laplacian: symmetric, no weight negative, rows summing to zero, all exactly.
fn weights(m: &Material, n: usize) -> Result<Vec<Vec<Rational>>, Refusal> {
    let mut weights = vec![vec![Rational::zero(); n]; n];
    for (i, list) in weights.iter_mut().enumerate() {
        let mut sum = Rational::zero();
        for &(j, v) in m.rows.row(i)? {
            sum += exact(v);
            // A column without a row is refused here.
            let opposite = m.rows.entry(j, i)?;
            if i == j {
                continue;
            }
            if v > 0.0 || opposite != v {
                return Err(Refusal::untrue(format!("ω_{i},{j} is a positive symmetric weight"), (-v).to_string()));
            }
            list[j] = -exact(v);
        }
        if sum.cmp_zero() != Ordering::Equal {
            return Err(Refusal::untrue(format!("row {i} sums to zero"), sum.approximate().to_string()));
        }
    }
    Ok(weights)
}

/// The cut over the smaller volume `Σ_{i,j∈A} ω_ij`; `None` where that is zero.
fn ratio(weights: &[Vec<Rational>], mask: usize) -> Option<Rational> {
    let inside = |v: usize| mask >> v & 1 == 1;
    let (mut cut, mut volume, mut rest) = (Rational::zero(), Rational::zero(), Rational::zero());
    for (i, row) in weights.iter().enumerate() {
        for (j, w) in row.iter().enumerate() {
            match (inside(i), inside(j)) {
                (true, true) => volume += w.clone(),
                (false, false) => rest += w.clone(),
                (true, false) => cut += w.clone(),
                (false, true) => {}
            }
        }
    }
    let smaller = if volume < rest { volume } else { rest };
    (smaller.cmp_zero() == Ordering::Greater).then(|| cut / smaller)
}
