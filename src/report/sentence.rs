//! A sentence for every kind of witness and certificate.

use super::number::{count, degrees, number};
use crate::record::evidence::{Corner, Row, SparseVector, Which};
use crate::record::{Evidence, Excerpt, Outcome, Statement, Verdict};

/// The verdict in words: what the evidence states, or why there is no decision.
pub fn sentence(verdict: &Verdict) -> String {
    match &verdict.outcome {
        Outcome::Holds(e) | Outcome::Fails(e) => statement(e),
        Outcome::Undecided(why) => format!("left open: {why}"),
        Outcome::NotApplicable(why) => format!("says nothing here: {why}"),
    }
}

/// What a witness or certificate states.
pub fn statement(evidence: &Evidence) -> String {
    let x = &evidence.excerpt;
    match &evidence.statement {
        Statement::NotFinite { matrix, i, j, value } => format!("entry ({i}, {j}) of {} is {value}", letter(*matrix)),
        Statement::FarEntry { i, j, rings } => format!(
            "L({i}, {j}){} is not zero although vertices {i} and {j} {}",
            equals(entry(&x.rows, *i, *j)),
            match rings {
                Some(r) => format!("are {r} edges apart"),
                None => "are not connected".into(),
            }
        ),
        Statement::Asymmetry { i, j, threshold } => asymmetry("L", &x.rows, *i, *j, *threshold),
        Statement::MassAsymmetry { i, j, threshold } => asymmetry("M", &x.mass_rows, *i, *j, *threshold),
        Statement::RowSum { i, threshold } => format!(
            "row {i} of L adds up to {} instead of 0 (threshold {})",
            approximately(row(&x.rows, *i).map(|r| r.entries.iter().map(|e| e.1).sum())),
            number(*threshold)
        ),
        Statement::KernelVector { x: vector, a, b, threshold } => format!(
            "L takes a vector to zero (up to {} of the row scales) although it is not constant on a component: it is {} at \
             vertex {a} and {} at vertex {b}",
            number(*threshold),
            number(component(vector, *a)),
            number(component(vector, *b))
        ),
        Statement::Weight { i, j, zero, opposite } => weight(x, *i, *j, *zero, opposite),
        Statement::NegativeEnergy { x: vector } => {
            format!("xᵀLx{} is negative for a vector x with {}", equals(energy(&x.rows, vector)), components(vector))
        }
        Statement::MassNotPositive { x: vector } => format!(
            "xᵀMx{} is not positive for a vector x with {}",
            equals(energy(&x.mass_rows, vector)),
            components(vector)
        ),
        Statement::Moment { i, axis, axes, boundary, threshold } => moment(x, *i, *axis, *axes, *boundary, *threshold),
        Statement::Energy { axis, other, trace, found, expected, threshold, star } => format!(
            "{} is {} instead of {} (threshold {}); the star of vertex {star} has the largest share",
            match (trace, axis == other) {
                (true, _) => "the summed Dirichlet energy of the coordinates".to_string(),
                (_, true) => format!("the Dirichlet energy of the coordinate {}", letter_of(*axis)),
                _ => format!("the mixed energy of the coordinates {} and {}", letter_of(*axis), letter_of(*other)),
            },
            number(*found),
            number(*expected),
            number(*threshold)
        ),
        Statement::BothSigns { i, positive, negative } => format!(
            "row {i} has the weight {} towards {positive} and {} towards {negative}: a function that L takes to zero at {i} \
             can have a strict maximum there",
            omega(x, *i, *positive),
            omega(x, *i, *negative)
        ),
        Statement::NoWeight { i } => {
            format!("every weight of row {i} is zero: L takes every function to zero there, maxima included")
        }
        Statement::NotConvex { i, j } if i == j => format!(
            "L({i}, {i}){} is not positive: the value at {i} is no mean of its neighbours",
            equals(entry(&x.rows, *i, *i))
        ),
        Statement::NotConvex { i, j } => format!(
            "the value at {i} is no convex combination of its neighbours: {j} takes part with the share {}",
            approximately(entry(&x.rows, *i, *j).zip(entry(&x.rows, *i, *i)).map(|(off, diagonal)| -off / diagonal))
        ),
        Statement::Overshoot { set, source, at, value, low } => format!(
            "with u = 1 at vertex {source} and u = 0 at {}, the harmonic u is {} at vertex {at}, {} every prescribed value",
            others(set.len()),
            number(*value),
            if *low { "below" } else { "above" }
        ),
        Statement::Singular { set, x: vector } => format!(
            "the Dirichlet problem with values prescribed at {} vertices has no unique solution: L takes a vector with {} \
             that vanishes there to zero at all other vertices",
            set.len(),
            components(vector)
        ),
        Statement::HeatLoss { t, source, at, value } => format!(
            "heat that starts at vertex {source} makes vertex {at} colder than anything was: after one implicit step of \
             t = {} the temperature there is {}",
            number(*t),
            number(*value)
        ),
        Statement::MassTotal { found, expected, threshold } => format!(
            "the masses add up to {} instead of the area {} (threshold {})",
            number(*found),
            number(*expected),
            number(*threshold)
        ),
        Statement::MassShare { i, lower, upper } => format!(
            "vertex {i} has the mass {}, outside the bounds {} and {} that its star sets",
            approximately(row(&x.mass_rows, *i).map(|r| r.entries.iter().map(|e| e.1).sum())),
            number(*lower),
            number(*upper)
        ),
        Statement::Changed { transformation, matrix, i, j, before, after, threshold } => format!(
            "after this transformation: {transformation}; entry ({i}, {j}) of {}, brought back, is {} where it was {} \
             (threshold {})",
            letter(*matrix),
            number(*after),
            number(*before),
            number(*threshold)
        ),
        Statement::BelowCheeger { x, side } => format!(
            "the partition into {} and the rest has the smallest constant λ_C, with the volume as printed, and a vector with {} \
             has a Rayleigh quotient below λ_C²/2",
            tuple(side),
            components(x)
        ),
        Statement::Scan { checked, worst } => match worst.as_slice() {
            [] => format!("{} places were looked at and none violates the property", count(*checked)),
            [i] => format!("{} places were looked at; the worst, vertex {i}, is within the threshold", count(*checked)),
            ends => format!(
                "{} places were looked at; the worst, {}, is within the threshold",
                count(*checked),
                tuple(ends)
            ),
        },
        Statement::SumOfSquares => "L is symmetric with vanishing row sums and no negative weight, so xᵀLx = \
             ½ Σ ω_ij (x_i − x_j)² is a sum of squares"
            .into(),
        Statement::ShiftedFactor { shift, smallest_pivot } => format!(
            "after a shift of {} of the row scales every pivot is positive, the smallest {} of its row scale",
            number(*shift),
            number(*smallest_pivot)
        ),
        Statement::InertiaCount { shift, kernel } => format!(
            "exactly {kernel} eigenvalue{} (relative to the row scales) between −{} and {}, by the inertia of two factorisations",
            if *kernel == 1 { " lies" } else { "s lie" },
            number(*shift),
            number(*shift)
        ),
        Statement::ClosedClasses { kernel } => format!(
            "no weight is negative and the vertices fall into {kernel} closed class{}, so that the kernel has that dimension",
            if *kernel == 1 { "" } else { "es" }
        ),
        Statement::SingularValues { kernel, zero, positive } => format!(
            "{kernel} singular value{} at most {} of the largest, the next is {}",
            if *kernel == 1 { " is" } else { "s are" },
            number(*zero),
            number(*positive)
        ),
        Statement::SignPattern { set } => format!(
            "no free row has a negative weight and chains of positive weights lead from every free vertex to the {set} \
             vertices with prescribed values: an M-matrix"
        ),
        Statement::Solved { columns, smallest, error } => format!(
            "all {} columns of the solution were computed; the smallest entry is {}, with an error of at most {}",
            count(*columns),
            number(*smallest),
            number(*error)
        ),
        Statement::Compared { transformations, entries } => format!(
            "{} entries agree after {}",
            count(*entries),
            if transformations.is_empty() { "no transformation".to_string() } else { transformations.join("; ") }
        ),
    }
}

fn weight(x: &Excerpt, i: usize, j: usize, zero: bool, opposite: &[Corner]) -> String {
    let omega = if zero { "ω = 0 exactly".to_string() } else { omega(x, i, j) };
    let angles: Vec<String> = opposite.iter().map(|c| degrees(c.angle_deg)).collect();
    let sum: f64 = opposite.iter().map(|c| c.angle_deg).sum();
    let why = match (angles.as_slice(), zero) {
        ([a, b], true) => format!("; the opposite angles {a} and {b} add up to 180°"),
        ([a, b], false) if sum > 180.0 => format!("; the opposite angles {a} and {b} add up to more than 180°"),
        ([a, b], false) => format!("; the opposite angles are {a} and {b}"),
        ([a], true) => format!("; the opposite angle {a} is right"),
        ([a], false) if sum > 90.0 => format!("; the opposite angle {a} is obtuse"),
        ([a], false) => format!("; the opposite angle is {a}"),
        _ => String::new(),
    };
    format!("edge ({i}, {j}): {omega}{why}")
}

fn moment(x: &Excerpt, i: usize, axis: usize, axes: [usize; 2], boundary: Option<[usize; 2]>, t: f64) -> String {
    let at = |v: usize| x.positions.iter().find(|p| p.0 == v).map(|p| p.1);
    let found = row(&x.rows, i).zip(at(i)).and_then(|(r, here)| {
        let term = |&(j, l): &(usize, f64)| at(j).map(|there| l * (there[axis % 3] - here[axis % 3]));
        r.entries.iter().map(term).sum::<Option<f64>>()
    });
    let expected = match boundary {
        None => Some(0.0),
        Some([p, q]) => at(p).zip(at(q)).map(|(p, q)| {
            let step = |axis: usize| q[axis % 3] - p[axis % 3];
            if axis == axes[0] { 0.5 * step(axes[1]) } else { -0.5 * step(axes[0]) }
        }),
    };
    let what = if boundary.is_some() { "the outward flux through its two half boundary edges" } else { "zero" };
    format!(
        "at vertex {i} L takes the coordinate {} to {} instead of {what}{} (threshold {})",
        letter_of(axis),
        approximately(found),
        if boundary.is_some() { equals(expected) } else { String::new() },
        number(t)
    )
}

fn asymmetry(name: &str, rows: &[Row], i: usize, j: usize, threshold: f64) -> String {
    format!(
        "{name}({i}, {j}){} and {name}({j}, {i}){} differ by more than the threshold {}",
        equals(entry(rows, i, j)),
        equals(entry(rows, j, i)),
        number(threshold)
    )
}

fn row(rows: &[Row], i: usize) -> Option<&Row> {
    rows.iter().find(|r| r.row == i)
}

/// An entry of an excerpted row; an entry that is not stored is zero.
pub(super) fn entry(rows: &[Row], i: usize, j: usize) -> Option<f64> {
    row(rows, i).map(|r| r.entries.iter().find(|e| e.0 == j).map_or(0.0, |e| e.1))
}

fn omega(x: &Excerpt, i: usize, j: usize) -> String {
    match entry(&x.rows, i, j) {
        Some(l) => format!("ω = {}", number(-l)),
        None => "ω".into(),
    }
}

/// `xᵀAx` from the rows of the support, in floating point: for the reader; the recheck decides it exactly.
fn energy(rows: &[Row], x: &SparseVector) -> Option<f64> {
    let product = |i: usize| row(rows, i).map(|r| r.entries.iter().map(|&(j, a)| a * component(x, j)).sum::<f64>());
    x.iter().map(|&(i, value)| product(i).map(|p| value * p)).sum()
}

fn component(x: &SparseVector, i: usize) -> f64 {
    x.iter().find(|c| c.0 == i).map_or(0.0, |c| c.1)
}

fn components(x: &SparseVector) -> String {
    match x.len() {
        1 => "one non-zero component".into(),
        n => format!("{} non-zero components", count(n)),
    }
}

fn others(set: usize) -> String {
    match set.saturating_sub(1) {
        0 => "no other vertex prescribed".into(),
        1 => "the other prescribed vertex".into(),
        n => format!("the {n} other prescribed vertices"),
    }
}

fn equals(value: Option<f64>) -> String {
    value.map_or_else(String::new, |v| format!(" = {}", number(v)))
}

fn approximately(value: Option<f64>) -> String {
    value.map_or_else(|| "another value".into(), number)
}

fn tuple(ends: &[usize]) -> String {
    format!("({})", ends.iter().map(usize::to_string).collect::<Vec<_>>().join(", "))
}

fn letter(matrix: Which) -> &'static str {
    match matrix {
        Which::Stiffness => "L",
        Which::Mass => "M",
    }
}

fn letter_of(axis: usize) -> &'static str {
    ["x", "y", "z"].get(axis).copied().unwrap_or("?")
}
