//! Witnesses, each decided on the material given.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use super::excerpt::{Material, Rows};
use super::terms::{Terms, U};
use super::{
    Answer, Rechecked, Refusal, check_threshold, dirichlet, energy, equilibrium, mass, moment, relevance, weight,
};
use crate::property::evidence::{SparseVector, Statement};
use crate::scalar::Scalar;

/// The largest threshold, relative to the row scale, below which `Lx` passes for zero: the smallest positive eigenvalue
/// relative to row scales of a mesh with n vertices is of the order 1/n, so that 2⁻²⁰ lies below those of meshes with fewer
/// than some 100,000 vertices.
pub(super) const NEARLY_ZERO: f64 = 1.0 / (1_u64 << 20) as f64;

/// Decides a witness.
pub(super) fn decide(statement: &Statement, m: &Material) -> Answer {
    match statement {
        Statement::NotFinite { value, .. } => not_finite(value),
        Statement::FarEntry { i, j, rings } => far_entry(m, *i, *j, *rings),
        Statement::Asymmetry { i, j, threshold } => asymmetry(&m.rows, *i, *j, *threshold),
        Statement::RowSum { i, threshold } => {
            exceeds(&row_sum(&m.rows, *i)?, *threshold, || format!("|Σ_j L_{i},j|"))?;
            Ok(Rechecked::Exact)
        }
        Statement::KernelVector { x, a, b, threshold } => kernel_vector(m, x, *a, *b, *threshold),
        Statement::Weight { i, j, zero, opposite } => weight::decide(m, *i, *j, *zero, opposite),
        Statement::NegativeEnergy { x } => negative_energy(&m.rows, x),
        Statement::Moment { i, axis, axes, boundary, threshold } => {
            moment::decide(m, *i, *axis, *axes, *boundary, *threshold)
        }
        Statement::Energy { axis, other, trace, found, expected, threshold, star } => {
            let entry = energy::Entry { axis: *axis, other: *other, trace: *trace };
            energy::decide(m, entry, *found, *expected, *threshold, *star)
        }
        Statement::BothSigns { i, positive, negative } => {
            sign(&m.rows, *i, *positive, Ordering::Less)?;
            sign(&m.rows, *i, *negative, Ordering::Greater)
        }
        Statement::NoWeight { i } => weight::none(m, *i),
        Statement::NotConvex { i, j } => not_convex(&m.rows, *i, *j),
        Statement::Overshoot { set, source, at, value, low } => {
            dirichlet::overshoot(m, set, *source, dirichlet::Point { at: *at, value: *value }, *low)
        }
        Statement::Singular { set, x } => dirichlet::singular(m, set, x),
        Statement::HeatLoss { t, source, at, value } => {
            dirichlet::heat_loss(m, *t, *source, dirichlet::Point { at: *at, value: *value })
        }
        Statement::MassTotal { found, expected, threshold } => mass::total(m, *found, *expected, *threshold),
        Statement::MassAsymmetry { i, j, threshold } => asymmetry(&m.mass, *i, *j, *threshold),
        Statement::MassNotPositive { x } => mass::not_positive(&m.mass, x),
        Statement::MassShare { i, lower, upper } => mass::share(m, *i, *lower, *upper),
        Statement::Changed { transformation, before, after, threshold, .. } => {
            changed(transformation, *before, *after, *threshold)
        }
        Statement::Lift { heights, weights } => equilibrium::lift(m, heights, weights),
        Statement::Equilibrium { weights } => equilibrium::weights(m, weights),
        Statement::Motion { motion, rates } => equilibrium::motion(m, motion, rates),
        Statement::NoLift { beside, multipliers } => equilibrium::no_lift(m, *beside, multipliers),
        certificate => Ok(Rechecked::Open(format!("'{}' is no witness", relevance::kind(certificate)))),
    }
}

/// Refuses a sum that does not exceed its threshold, or not even one rounding of its terms.
pub(super) fn exceeds(sum: &Terms, threshold: f64, name: impl Fn() -> String) -> Result<(), Refusal> {
    check_threshold(threshold)?;
    for (bound, what) in [(threshold, "the threshold"), (U * sum.scale(), "one rounding of its terms")] {
        if !sum.exceeds(bound) {
            return Err(Refusal::untrue(
                format!("{} exceeds {what} {bound:e}", name()),
                format!("{:e}", sum.value().abs()),
            ));
        }
    }
    Ok(())
}

/// Reads a vector: indices once each, components finite, not all zero.
pub(super) fn vector(x: &SparseVector) -> Result<BTreeMap<usize, f64>, Refusal> {
    let mut map = BTreeMap::new();
    for &(index, value) in x {
        if !value.is_finite() {
            return Err(Refusal::Malformed { what: "component", index, problem: "is not finite" });
        }
        if map.insert(index, value).is_some() {
            return Err(Refusal::Malformed { what: "component", index, problem: "is given twice" });
        }
    }
    map.retain(|_, value| *value != 0.0);
    if map.is_empty() {
        return Err(Refusal::untrue("the vector is not zero", "it is"));
    }
    Ok(map)
}

/// `Σ x_i A_ij x_j` over the support of x, whose rows must be there.
pub(super) fn quadratic_form(rows: &Rows, x: &BTreeMap<usize, f64>) -> Result<Terms, Refusal> {
    let mut sum = Terms::default();
    for (&i, &xi) in x {
        for &(j, v) in rows.row(i)? {
            if let Some(&xj) = x.get(&j) {
                sum.add_product(v, xi, xj);
            }
        }
    }
    Ok(sum)
}

/// The sum of row `i`.
pub(super) fn row_sum(rows: &Rows, i: usize) -> Result<Terms, Refusal> {
    let mut sum = Terms::default();
    rows.row(i)?.iter().for_each(|e| sum.add(e.1));
    Ok(sum)
}

fn not_finite(value: &str) -> Answer {
    if ["NaN", "inf", "-inf"].contains(&value) {
        return Ok(Rechecked::Open("JSON has no such number; recheck it against the operator".into()));
    }
    Err(Refusal::untrue("the entry is not finite", value))
}

fn far_entry(m: &Material, i: usize, j: usize, rings: Option<usize>) -> Answer {
    if i == j || rings.is_some_and(|r| r < 2) {
        return Err(Refusal::untrue(format!("{j} is outside the star of {i}"), "it is nearer than two rings"));
    }
    if m.rows.entry(i, j)? == 0.0 {
        return Err(Refusal::untrue(format!("L_{i},{j} ≠ 0"), "0"));
    }
    for (index, corners) in m.faces {
        if !corners.contains(&i) {
            return Err(Refusal::Malformed {
                what: "face",
                index: *index,
                problem: "is not in the star of the vertex",
            });
        }
        if corners.contains(&j) {
            return Err(Refusal::untrue(format!("no face contains {i} and {j}"), format!("face {index} does")));
        }
    }
    for (index, edge) in m.edges.iter().enumerate() {
        if !edge.contains(&i) {
            return Err(Refusal::Malformed { what: "edge", index, problem: "is not at the vertex" });
        }
        if edge.contains(&j) {
            return Err(Refusal::untrue(format!("no edge joins {i} and {j}"), format!("edge {index} does")));
        }
    }
    Ok(Rechecked::Exact)
}

fn asymmetry(rows: &Rows, i: usize, j: usize, threshold: f64) -> Answer {
    let mut difference = Terms::default();
    difference.add(rows.entry(i, j)?);
    difference.add(-rows.entry(j, i)?);
    exceeds(&difference, threshold, || format!("|A_{i},{j} − A_{j},{i}|"))?;
    Ok(Rechecked::Exact)
}

fn kernel_vector(m: &Material, x: &SparseVector, a: usize, b: usize, threshold: f64) -> Answer {
    check_threshold(threshold)?;
    let threshold = threshold.min(NEARLY_ZERO);
    let x = vector(x)?;
    let at = |v: usize| x.get(&v).copied().unwrap_or(0.0);
    m.rows.check_closed(|_| false)?;
    x.keys().chain([&a, &b]).try_for_each(|&v| m.rows.row(v).map(drop))?;
    let mut difference = Terms::default();
    difference.add(at(a));
    difference.add(-at(b));
    if !difference.exceeds(1.0_f64.next_down()) {
        return Err(Refusal::untrue(format!("|x_{a} − x_{b}| ≥ 1"), difference.value().abs().to_string()));
    }
    let mut exact = true;
    for (i, row) in m.rows.iter() {
        let (mut product, mut scale) = (Terms::default(), 0.0);
        for &(j, v) in row {
            product.add_product(v, at(j), 1.0);
            scale += v.abs();
        }
        // The scale is a sum of n rounded magnitudes; the allowance keeps a vector that just meets the threshold.
        let allowed = threshold * scale * (1.0 + (row.len() as f64 + 4.0) * U);
        if product.exceeds(allowed) {
            return Err(Refusal::untrue(format!("|(Lx)_{i}| ≤ {allowed:e}"), format!("{:e}", product.value().abs())));
        }
        exact &= !product.exceeds(0.0);
    }
    if m.edges.is_empty() && m.faces.is_empty() {
        let why = format!("that {a} and {b} belong to one component is checked against the domain");
        return Ok(Rechecked::Open(why));
    }
    check_joined(m, a, b)?;
    Ok(if exact { Rechecked::Exact } else { Rechecked::Bounded })
}

fn check_joined(m: &Material, a: usize, b: usize) -> Result<(), Refusal> {
    let mut neighbours: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let sides = m.faces.iter().flat_map(|(_, f)| (0..f.len()).map(move |k| [f[k], f[(k + 1) % f.len()]]));
    for [p, q] in sides.chain(m.edges.iter().copied()) {
        neighbours.entry(p).or_default().push(q);
        neighbours.entry(q).or_default().push(p);
    }
    let (mut reached, mut queue) = (std::collections::BTreeSet::from([a]), vec![a]);
    while let Some(v) = queue.pop() {
        for &w in neighbours.get(&v).map_or(&[][..], Vec::as_slice) {
            if reached.insert(w) {
                queue.push(w);
            }
        }
    }
    if reached.contains(&b) {
        return Ok(());
    }
    Err(Refusal::untrue(format!("{a} and {b} belong to one component"), "they do not"))
}

fn negative_energy(rows: &Rows, x: &SparseVector) -> Answer {
    let energy = quadratic_form(rows, &vector(x)?)?;
    if energy.sign() != Ordering::Less {
        return Err(Refusal::untrue("xᵀLx < 0", format!("{:e}", energy.value())));
    }
    exceeds(&energy, 0.0, || "|xᵀLx|".into())?;
    Ok(Rechecked::Exact)
}

/// `wanted` is the sign of the entry: `Less` for a positive weight.
fn sign(rows: &Rows, i: usize, j: usize, wanted: Ordering) -> Answer {
    let entry = rows.entry(i, j)?;
    if i != j && entry.cmp_zero() == wanted {
        return Ok(Rechecked::Exact);
    }
    let stated = if wanted == Ordering::Less { "positive" } else { "negative" };
    Err(Refusal::untrue(format!("the weight of {i} to {j} is {stated}"), (-entry).to_string()))
}

fn not_convex(rows: &Rows, i: usize, j: usize) -> Answer {
    let (diagonal, entry) = (rows.entry(i, i)?, rows.entry(i, j)?);
    let fails = if i == j {
        diagonal <= 0.0
    } else {
        // ω_ij / L_ii < 0 with ω_ij = −L_ij: entry and diagonal have the same sign.
        diagonal != 0.0 && entry.cmp_zero() == diagonal.cmp_zero()
    };
    if fails {
        return Ok(Rechecked::Exact);
    }
    Err(Refusal::untrue(
        format!("row {i} gives {j} a negative share"),
        format!("L_{i},{j} = {entry}, L_{i},{i} = {diagonal}"),
    ))
}

fn changed(transformation: &str, before: f64, after: f64, threshold: f64) -> Answer {
    let mut difference = Terms::default();
    for (what, x) in [(1.0, before), (-1.0, after)] {
        if !x.is_finite() {
            return Err(Refusal::Parameter { name: "entry", value: x, must: "finite" });
        }
        difference.add(what * x);
    }
    exceeds(&difference, threshold, || "|before − after|".into())?;
    if transformation.trim().is_empty() {
        return Err(Refusal::untrue("the transformation is named", "nothing"));
    }
    Ok(Rechecked::Open("the construction would have to be called again on the transformed domain".into()))
}
