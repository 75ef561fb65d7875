//! Areas, and the Dirichlet energy of the coordinates.

use std::cmp::Ordering;

use super::excerpt::Material;
use super::terms::{Terms, U};
use super::{Answer, Rechecked, Refusal, check_number, check_threshold, witness};
use crate::scalar::{Rational, Scalar};

/// An entry of the energy of the coordinates, or its trace.
#[derive(Clone, Copy)]
pub(super) struct Entry {
    /// First coordinate.
    pub axis: usize,
    /// Second coordinate.
    pub other: usize,
    /// Whether the trace is meant instead.
    pub trace: bool,
}

/// The area of the faces.
pub(super) enum Area {
    /// A mesh in a coordinate plane: the sum of the areas as a polynomial, to be evaluated exactly.
    Planar {
        /// The sum.
        terms: Terms,
        /// The normal.
        normal: usize,
        /// Whether two faces are turned against each other.
        folded: bool,
    },
    /// A mesh in space: the sum of square roots, and how far it may be away.
    Spatial(f64, f64),
}

impl Area {
    /// The value and how far it may be away.
    pub fn approximate(&self) -> (f64, f64) {
        match self {
            Area::Planar { terms, .. } => (terms.value(), terms.bound()),
            Area::Spatial(value, bound) => (*value, *bound),
        }
    }
}

/// The area of the given faces; a polygon counts with the length of its vector area.
pub(super) fn area<'a>(
    faces: impl Iterator<Item = &'a [usize]> + Clone,
    position: impl Fn(usize) -> Result<[f64; 3], Refusal>,
) -> Result<Area, Refusal> {
    let corners = |f: &[usize]| f.iter().map(|&v| position(v)).collect::<Result<Vec<_>, _>>();
    let mut constant = [true; 3];
    let mut first = None;
    for f in faces.clone() {
        for p in corners(f)? {
            let origin = *first.get_or_insert(p);
            (0..3).for_each(|k| constant[k] &= p[k] == origin[k]);
        }
    }
    let Some(normal) = [2, 0, 1].into_iter().find(|&k| constant[k]) else {
        let (mut total, mut bound) = (0.0, 0.0);
        let mut count = 0.0;
        for f in faces {
            let (area, error) = spatial_area(&corners(f)?);
            (total, bound, count) = (total + area, bound + error, count + 1.0);
        }
        return Ok(Area::Spatial(total, 2.0 * (bound + count * U * total)));
    };
    let (mut terms, mut positive, mut negative) = (Terms::default(), false, false);
    for f in faces {
        let face = planar_area(&corners(f)?, [(normal + 1) % 3, (normal + 2) % 3]);
        let turn = face.sign();
        positive |= turn == Ordering::Greater;
        negative |= turn == Ordering::Less;
        terms.append(if turn == Ordering::Less { -1.0 } else { 1.0 }, face);
    }
    Ok(Area::Planar { terms, normal, folded: positive && negative })
}

/// The signed area of a polygon in a coordinate plane.
fn planar_area(corners: &[[f64; 3]], [a, b]: [usize; 2]) -> Terms {
    let mut area = Terms::default();
    let o = corners[0];
    for w in corners[1..].windows(2) {
        area.add_differences(0.5, [w[0][a], o[a]], [w[1][b], o[b]]);
        area.add_differences(-0.5, [w[0][b], o[b]], [w[1][a], o[a]]);
    }
    area
}

/// The length of the vector area and a bound on its rounding error.
///
/// Each component of a cross product of rounded differences carries at most four roundings of a magnitude below `|p||q|`,
/// the sum over k triangles k more, the norm three of its own; the bound takes 16 + 2k of `Σ |p||q|`.
fn spatial_area(corners: &[[f64; 3]]) -> (f64, f64) {
    let minus = |p: [f64; 3], o: [f64; 3]| [p[0] - o[0], p[1] - o[1], p[2] - o[2]];
    let norm = |p: [f64; 3]| p[0].hypot(p[1]).hypot(p[2]);
    let (mut sum, mut scale) = ([0.0; 3], 0.0);
    for w in corners[1..].windows(2) {
        let (p, q) = (minus(w[0], corners[0]), minus(w[1], corners[0]));
        for (k, total) in sum.iter_mut().enumerate() {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            *total += p[a] * q[b] - p[b] * q[a];
        }
        scale += norm(p) * norm(q);
    }
    (0.5 * norm(sum), (16.0 + 2.0 * corners.len() as f64) * U * scale)
}

/// ENERGY: the entry of the energy of the coordinates is not the area by more than the threshold.
pub(super) fn decide(m: &Material, entry: Entry, found: f64, expected: f64, threshold: f64, star: usize) -> Answer {
    check_threshold(threshold)?;
    m.rows.row(star)?;
    m.rows.check_closed(|_| false)?;
    m.faces.iter().flat_map(|f| &f.1).try_for_each(|&v| m.rows.row(v).map(drop))?;
    let energy = energy(m, entry)?;
    let area = area(m.faces.iter().map(|f| f.1.as_slice()), |v| m.position(v))?;
    if !entry.trace {
        check_plane(&area, entry)?;
    }
    let factor = match (entry.trace, entry.axis == entry.other) {
        (true, _) => 2.0,
        (false, true) => 1.0,
        (false, false) => 0.0,
    };
    let (size, error) = area.approximate();
    check_number("found", found, energy.value(), energy.value().abs() + size)?;
    check_number("expected", expected, factor * size, size)?;
    let name = || "|energy − area|".to_string();
    match area {
        Area::Planar { terms, .. } => {
            let mut difference = energy;
            difference.append(-factor, terms);
            witness::exceeds(&difference, threshold, name)?;
            Ok(Rechecked::Exact)
        }
        Area::Spatial(..) => {
            let faces = || m.faces.iter().map(|f| f.1.as_slice());
            differs(energy, factor, (size, error), || sharp_area(faces(), |v| m.position(v)), threshold, name)
        }
    }
}

/// Whether a sum differs from `factor` times an area in space by more than the threshold, the error of the area included;
/// where the quick area is too coarse to tell, the sharp one decides.
pub(super) fn differs(
    mut sum: Terms,
    factor: f64,
    (size, error): (f64, f64),
    sharp: impl FnOnce() -> Result<(f64, f64), Refusal>,
    threshold: f64,
    name: impl Fn() -> String,
) -> Answer {
    sum.add(-factor * size);
    if sum.exceeds(threshold + factor * error) {
        witness::exceeds(&sum, threshold, name)?;
        return Ok(Rechecked::Bounded);
    }
    sum.add(factor * size);
    let (size, error) = sharp()?;
    sum.add(-factor * size);
    if !sum.exceeds(threshold + factor * error) && sum.exceeds(threshold - factor * error) {
        return Ok(Rechecked::Open(format!("the area is known to {error:e} only, and that decides")));
    }
    witness::exceeds(&sum, threshold, name)?;
    Ok(Rechecked::Bounded)
}

/// The area in space from exact squares: each square root is rounded three times, the sum of m faces m times more.
pub(super) fn sharp_area<'a>(
    faces: impl Iterator<Item = &'a [usize]>,
    position: impl Fn(usize) -> Result<[f64; 3], Refusal>,
) -> Result<(f64, f64), Refusal> {
    let (mut total, mut count) = (Terms::default(), 0.0);
    for f in faces {
        let corners = f.iter().map(|&v| position(v)).collect::<Result<Vec<_>, _>>()?;
        let square = [[1, 2], [2, 0], [0, 1]].map(|axes| planar_area(&corners, axes).exact());
        let square = square.into_iter().fold(Rational::zero(), |sum, a| sum + a.clone() * a);
        total.add(square.approximate().sqrt());
        count += 1.0;
    }
    Ok((total.value(), (count + 8.0) * U * total.value()))
}

/// `½ Σ_{i≠j} ω_ij (x_i − x_j)_a (x_i − x_j)_b` at the entry (a, b), or its trace.
fn energy(m: &Material, entry: Entry) -> Result<Terms, Refusal> {
    let pairs = if entry.trace { vec![[0, 0], [1, 1], [2, 2]] } else { vec![[entry.axis, entry.other]] };
    if let Some(&axis) = pairs.iter().flatten().find(|&&a| a > 2) {
        return Err(Refusal::Malformed { what: "axis", index: axis, problem: "is not 0, 1 or 2" });
    }
    let mut sum = Terms::default();
    for (i, row) in m.rows.iter() {
        let p = m.position(i)?;
        for &(j, v) in row.iter().filter(|e| e.1 != 0.0) {
            if i != j {
                let q = m.position(j)?;
                pairs.iter().for_each(|&[a, b]| sum.add_differences(-0.5 * v, [p[a], q[a]], [p[b], q[b]]));
            }
        }
    }
    Ok(sum)
}

fn check_plane(area: &Area, entry: Entry) -> Result<(), Refusal> {
    match area {
        Area::Planar { normal, folded: false, .. } if ![entry.axis, entry.other].contains(normal) => Ok(()),
        Area::Planar { folded: true, .. } => {
            Err(Refusal::untrue("the mesh is unfolded", "faces are turned against each other"))
        }
        _ => Err(Refusal::untrue(
            format!("the mesh lies in a plane of coordinates {} and {}", entry.axis, entry.other),
            "it does not",
        )),
    }
}
