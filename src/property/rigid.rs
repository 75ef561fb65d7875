//! RIGID: an operator does not know where it is.
//!
//! # Definition
//! Rotation, translation, and reflection with all faces flipped change nothing.
//!
//! # Decision
//! * Rotation about the centre of the bounding box, seeded; within its plane for a planar mesh, so that it stays planar. New coordinates
//!   are rounded: vertices are displaced by up to `16 u` times the diameter.
//! * Translation by a power of two above the diameter along each axis of the mesh; the displacement is measured, and zero for
//!   coordinates with few digits.
//! * Reflection `x ↦ −x` in the first axis of the mesh, which is exact.
//!
//! # Exception
//! Not applicable to graphs, which have no positions.

use super::relate::image::{Image, extent, moved, rounding_of_shift};
use super::relate::relation;
use super::tolerance::UNIT_ROUNDOFF;
use super::{Construction, Property, Question, Trial, Verdict};
use crate::domain::Domain;
use crate::stream::Stream;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "RIGID",
    name: "invariance under rigid motions",
    statement: "L(RX + t) = L(X) and M likewise, for rotations and reflections R and translations t",
    sources: &[],
    question: Question::Construction(decide),
};

type Matrix = [[f64; 3]; 3];

fn decide(trial: &Trial, construction: &Construction) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    match images(trial) {
        None => Verdict::not_applicable("a graph has no positions"),
        Some(Err(why)) => Verdict::not_applicable(why),
        Some(Ok(images)) => relation::decide(trial, construction, images),
    }
}

fn images(trial: &Trial) -> Option<Result<Vec<Image>, String>> {
    let positions = trial.domain.positions()?;
    if positions.is_empty() {
        return Some(Err("the domain has no vertex".into()));
    }
    let (centre, diameter) = extent(positions);
    let axes = axes(trial.domain);
    let (rotation, words) = rotation(&mut Stream::new(trial.seed, "RIGID"), &axes);
    let turn = |p: [f64; 3]| apply(&rotation, p);
    let about_centre = |_: usize, p: [f64; 3]| turn(std::array::from_fn(|k| p[k] - centre[k]));
    let step = 2f64.powi(diameter.max(f64::MIN_POSITIVE).log2().ceil() as i32);
    let shift: [f64; 3] = std::array::from_fn(|k| if axes.contains(&k) { step } else { 0.0 });
    let shifted = |_: usize, p: [f64; 3]| std::array::from_fn(|k| p[k] + shift[k]);
    let mirror = |p: [f64; 3]| std::array::from_fn(|k| if k == axes[0] { -p[k] } else { p[k] });
    let rotated = moved(trial.domain, about_centre, turn, false)?;
    let translated = moved(trial.domain, shifted, |n| n, false)?;
    let reflected = moved(trial.domain, |_, p| mirror(p), mirror, true)?;
    let displaced = 16.0 * UNIT_ROUNDOFF * diameter;
    Some((|| {
        Ok(vec![
            Image::new(format!("reflecting axis {} with all faces flipped", axes[0]), reflected?),
            Image::new(format!("translating by {shift:?}"), translated?).displaced(rounding_of_shift(positions, shift)),
            Image::new(words, rotated?).displaced(displaced),
        ])
    })())
}

/// The axes along which the domain extends: the two of its plane, or all three.
fn axes(domain: &Domain) -> Vec<usize> {
    match domain.as_surface().and_then(|s| s.plane()) {
        Some(plane) => plane.to_vec(),
        None => vec![0, 1, 2],
    }
}

/// A seeded rotation: in the plane of two axes, or by a seeded unit quaternion.
fn rotation(stream: &mut Stream, axes: &[usize]) -> (Matrix, String) {
    if let [a, b] = *axes {
        let angle = stream.between(0.3, 1.2);
        let (sin, cos) = angle.sin_cos();
        let mut m: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
        (m[a][a], m[a][b], m[b][a], m[b][b]) = (cos, -sin, sin, cos);
        return (m, format!("rotating by {angle} about the centre of the box, in the plane of axes {a} and {b}"));
    }
    let q: [f64; 4] = std::array::from_fn(|_| stream.normal());
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [w, x, y, z] = q.map(|c| c / length);
    let m = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ];
    (m, format!("rotating about the centre of the box by the quaternion [{w}, {x}, {y}, {z}]"))
}

fn apply(m: &Matrix, p: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|j| m[i][j] * p[j]).sum())
}
