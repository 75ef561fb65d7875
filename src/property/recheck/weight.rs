//! Weights of edges: their sign, the faces at the edge, the corners opposite.

use std::cmp::Ordering;

use super::excerpt::Material;
use super::{Answer, Rechecked, Refusal};
use crate::property::evidence::Corner;
use crate::scalar::Scalar;

/// A weight `ω_ij = −L_ij` that passes for zero is below this part of its row scale, `2⁻⁴⁰`: far below what a figure shows,
/// far above the rounding of a healthy mesh.
const ZERO: f64 = 1.0 / (1_u64 << 40) as f64;

/// POS, POS0: `ω_ij` is negative, or zero, on an edge.
///
/// An entry off the edges of the domain is a weight as soon as it is not zero, so an excerpt without faces and edges decides
/// that a weight is negative; that a zero is a weight at all takes an edge.
pub(super) fn decide(m: &Material, i: usize, j: usize, zero: bool, opposite: &[Corner]) -> Answer {
    if i == j {
        return Err(Refusal::Malformed {
            what: "edge at vertex",
            index: i,
            problem: "has the same vertex at both ends",
        });
    }
    let entry = m.rows.entry(i, j)?;
    let answer = match (zero, entry.cmp_zero()) {
        (false, Ordering::Greater) | (true, Ordering::Equal) => Rechecked::Exact,
        (true, _) if entry.abs() <= ZERO * m.rows.row(i)?.iter().map(|e| e.1.abs()).sum::<f64>() => Rechecked::Bounded,
        _ => {
            let stated = if zero { "zero" } else { "negative" };
            return Err(Refusal::untrue(format!("the weight of ({i}, {j}) is {stated}"), (-entry).to_string()));
        }
    };
    if !m.edges.is_empty() && !m.edges.iter().any(|e| e.contains(&i) && e.contains(&j)) {
        return Err(Refusal::Missing { what: "an edge at vertex", index: i });
    }
    check_opposite(m, i, j, opposite)?;
    Ok(answer)
}

/// MAX-local: every weight of row i is zero, or passes for zero.
pub(super) fn none(m: &Material, i: usize) -> Answer {
    let row = m.rows.row(i)?;
    let scale: f64 = row.iter().map(|e| e.1.abs()).sum();
    let weights = || row.iter().filter(|e| e.0 != i && e.1 != 0.0);
    if let Some((j, v)) = weights().find(|e| e.1.abs() > ZERO * scale) {
        return Err(Refusal::untrue(format!("every weight of row {i} is zero"), format!("L_{i},{j} = {v}")));
    }
    Ok(if weights().next().is_none() { Rechecked::Exact } else { Rechecked::Bounded })
}

fn check_opposite(m: &Material, i: usize, j: usize, opposite: &[Corner]) -> Result<(), Refusal> {
    let mut thirds = Vec::new();
    for (index, corners) in m.faces {
        let n = corners.len();
        let along = |a: usize, b: usize| (0..n).any(|k| corners[k] == a && corners[(k + 1) % n] == b);
        if !along(i, j) && !along(j, i) {
            return Err(Refusal::Malformed { what: "face", index: *index, problem: "does not lie at the edge" });
        }
        if n == 3 {
            thirds.extend(corners.iter().copied().filter(|&v| v != i && v != j));
        }
    }
    let mut stated: Vec<usize> = opposite.iter().map(|c| c.vertex).collect();
    stated.sort_unstable();
    thirds.sort_unstable();
    if stated != thirds {
        return Err(Refusal::untrue(format!("opposite ({i}, {j}) lie {stated:?}"), format!("{thirds:?}")));
    }
    for corner in opposite {
        check_angle(m, i, j, corner)?;
    }
    Ok(())
}

fn check_angle(m: &Material, i: usize, j: usize, corner: &Corner) -> Result<(), Refusal> {
    let (apex, p, q) = (m.position(corner.vertex)?, m.position(i)?, m.position(j)?);
    let side = |end: [f64; 3]| {
        let d: [f64; 3] = std::array::from_fn(|k| end[k] - apex[k]);
        let size = d.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
        d.map(|x| if size > 0.0 { x / size } else { 0.0 })
    };
    let (u, v) = (side(p), side(q));
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let dot = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let angle = cross[0].hypot(cross[1]).hypot(cross[2]).atan2(dot).to_degrees();
    if (angle - corner.angle_deg).abs() <= 1e-6 {
        return Ok(());
    }
    Err(Refusal::untrue(format!("the angle at {} is {}°", corner.vertex, corner.angle_deg), format!("{angle}°")))
}
