//! A sentence for every kind of witness and certificate.

use super::forms;
use super::number::{count, degrees, number};
use crate::record::evidence::{Corner, Fault, Fraction, Hypothesis, Row, SparseVector, Which};
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
        Statement::Inaccurate { i, j, exact, error, threshold } => format!(
            "the weight of ({i}, {j}) is {} where ½ Σ cot over the angles opposite is {exact:e}: it is off by {} (threshold {})",
            approximately(entry(&x.rows, *i, *j).map(|v| -v)),
            number(*error),
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
            "the partition into {} and the rest has the smallest constant λ_C, with the volume as printed, and a vector with {} has \
             a Rayleigh quotient below λ_C²/2",
            tuple(side),
            components(x)
        ),
        Statement::Lift { heights, weights } => format!(
            "{} heights are strictly convex across all {} interior edges: the jumps of the gradient are positive weights in \
             equilibrium at every interior vertex",
            count(heights.len()),
            count(weights.len())
        ),
        Statement::Equilibrium { weights } => format!(
            "the {} edges with an interior end have positive weights in equilibrium at every interior vertex",
            count(weights.len())
        ),
        Statement::Motion { motion, rates } => format!(
            "with the boundary held, a motion of {} interior vertices shortens none of the {} edges with an interior end and \
             lengthens {}: no positive weights are in equilibrium",
            count(motion.len()),
            count(rates.len()),
            count(rates.iter().filter(|r| r.1.approximate() > 0.0).count())
        ),
        Statement::NoLift { beside, multipliers } => format!(
            "no heights {}: {} such conditions, with positive multipliers, add up to 0 > 0",
            if *beside {
                "are strictly convex across every interior edge"
            } else {
                "lift every vertex above the plane of every triangle that it is no corner of"
            },
            count(multipliers.len())
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
        Statement::FlipsToDelaunay { flips, energies, .. } => format!(
            "{} flip{} to the Delaunay triangulation, each of which takes κ w wᵀ with κ > 0 from L, and their sum is L_T − L_D; \
             a function's Dirichlet energy falls from {} to {}",
            count(flips.len()),
            if flips.len() == 1 { " leads" } else { "s lead" },
            approximately(energies.first().copied()),
            approximately(energies.last().copied())
        ),
        Statement::DelaunayNotMinimal { delaunay, other, values, energies: [on_delaunay, on_other] } => format!(
            "on the Delaunay triangulation of {}, {} tetrahedra, the function with the values {} has the Dirichlet energy \
             {on_delaunay}, and on the other one, {} tetrahedra, only {on_other}",
            places(x),
            delaunay.len(),
            values.iter().map(|v| number(*v)).collect::<Vec<_>>().join(", "),
            other.len()
        ),
        Statement::PositiveExtension { i, j, weight, smallest } => format!(
            "ω = {weight} on the edge ({i}, {j}), and yet every entry of the harmonic extension from the boundary is positive, \
             the smallest {smallest}"
        ),
        Statement::NotEmbedded { drawing, missing, fault, .. } => format!(
            "all forces at the inner vertices vanish, {}, and {} in the drawing {}",
            match missing {
                Hypothesis::ConvexBoundary => "the boundary polygon is not convex",
                Hypothesis::PositiveWeights => "a weight is negative",
                Hypothesis::NoChordOnASide => "an edge joins two vertices of one side of the polygon",
                Hypothesis::Disc => "the surface is no disc",
                Hypothesis::ThreeConnected => "the graph is not 3-connected",
            },
            match fault {
                Fault::Face { face } => format!("face {face} is not counter-clockwise"),
                Fault::Edge { a, b } => format!("vertices {a} and {b}, which share an edge, coincide"),
                Fault::Overlap { faces, polygon } =>
                    format!("the faces take twice the area {faces}, the polygon has only {polygon}"),
            },
            drawing.iter().map(|[x, y]| format!("({x}, {y})")).collect::<Vec<_>>().join(" ")
        ),
        Statement::TorusFlips { start: [u, v], flips, end: [p, q] } => format!(
            "on the flat torus ℝ²/ℤ² the triangulation with one vertex and the edges ({}, {}), ({}, {}) and their sum is exactly \
             {} flip{} away from the Delaunay triangulation, with ({}, {}), ({}, {}) and their sum",
            u[0],
            u[1],
            v[0],
            v[1],
            count(*flips),
            if *flips == 1 { "" } else { "s" },
            p[0],
            p[1],
            q[0],
            q[1]
        ),
        Statement::Cospectral { vertices, first, second, normalised, polynomial } => format!(
            "the graphs with {vertices} vertices and the edges {} and {} are not isomorphic, and both have det(xI − {}) = {}",
            edges(first),
            edges(second),
            if *normalised { "D⁻¹L" } else { "L" },
            terms(polynomial)
        ),
        Statement::Transplantation { first, condition, matrix, .. } => format!(
            "the two polygons are not congruent, and an invertible matrix with {} entries takes the functions on one to those on \
             the other so that stiffness, barycentric and consistent mass of {} triangles correspond, under {condition}",
            count(matrix.len()),
            count(first.faces.len())
        ),
        Statement::SpectraDiffer { condition, mass, sigma, below: [a, b], .. } => format!(
            "under {condition}, with {mass}, {a} eigenvalue{} of the first mesh and {b} of the second {} below {sigma}",
            if *a == 1 { "" } else { "s" },
            if *b == 1 { "lies" } else { "lie" }
        ),
        Statement::DelaunayEigenvalue { condition, mass, sigma, below: [delaunay, other], .. } => format!(
            "under {condition}, with {mass}, {delaunay} eigenvalue{} of the Delaunay triangulation of {} and {other} of another one \
             {} below {sigma}: its eigenvalue number {} is larger",
            if *delaunay == 1 { "" } else { "s" },
            places(x),
            if *other == 1 { "lies" } else { "lie" },
            delaunay + 1
        ),
        Statement::HarmonicForm { form, exception, .. } => forms::exception(form, exception),
    }
}

fn edges(list: &[[usize; 2]]) -> String {
    list.iter().map(|[a, b]| format!("{a}–{b}")).collect::<Vec<_>>().join(" ")
}

/// A polynomial in x by its coefficients, ascending.
fn terms(coefficients: &[Fraction]) -> String {
    let mut said = String::new();
    for (power, c) in coefficients.iter().map(Fraction::to_string).enumerate().rev().filter(|(_, c)| c != "0") {
        let (sign, size) = c.strip_prefix('-').map_or((" + ", c.as_str()), |size| (" − ", size));
        said += if said.is_empty() && sign == " + " { "" } else { sign };
        let size = if size == "1" && power > 0 { "" } else { size };
        said += &match power {
            0 => size.to_string(),
            1 => format!("{size}x"),
            _ => format!("{size}x{}", superscript(power)),
        };
    }
    said
}

pub(super) fn superscript(power: usize) -> String {
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    power.to_string().bytes().map(|b| digits[usize::from(b - b'0')]).collect()
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

/// The positions of an excerpt as points of space.
fn places(x: &Excerpt) -> String {
    let point = |p: &(usize, [f64; 3])| format!("({}, {}, {})", number(p.1[0]), number(p.1[1]), number(p.1[2]));
    x.positions.iter().map(point).collect::<Vec<_>>().join(" ")
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
