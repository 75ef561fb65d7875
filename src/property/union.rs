//! UNION: what is apart does not interact.
//!
//! # Definition
//! On the disjoint union of the domain and a copy, L and M are block diagonal, each block what the construction
//! makes of its part alone.
//!
//! # Decision
//! The copy is moved along the first axis of the domain by a power of two above twice the diameter where that rounds no
//! coordinate. Elsewhere it stays in place: rounding is a matter of [RIGID](super::rigid) — it may settle a cocircular pair in
//! another way — and that two meshes are apart is a matter of their faces. Entries outside the
//! blocks are named with the numbers they have in the union: vertex i of the copy is `n + i`.
//!
//! # Exception
//! Not applicable to point clouds, where being apart is a matter of distance.

use super::relate::image::{Image, doubled, extent, rounding_of_shift};
use super::relate::relation;
use super::{Construction, Property, Question, Trial, Verdict};
use crate::domain::Domain;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "UNION",
    name: "disjoint unions",
    statement: "L(X ∪ X') is block diagonal with blocks L(X) and L(X') for a copy X', and M likewise",
    sources: &[],
    question: Question::Construction(decide),
};

fn decide(trial: &Trial, construction: &Construction) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    if matches!(trial.domain, Domain::Points(_)) {
        return Verdict::not_applicable("in a point cloud being apart is a matter of distance");
    }
    let n = trial.domain.vertex_count();
    let mut shift = [0.0; 3];
    if let Some(positions) = trial.domain.positions().filter(|p| !p.is_empty()) {
        let (_, diameter) = extent(positions);
        let plane = trial.domain.as_surface().and_then(|s| s.plane());
        shift[plane.map_or(0, |axes| axes[0])] = 2f64.powi(diameter.max(1e-300).log2().ceil() as i32 + 1);
        if rounding_of_shift(positions, shift) != 0.0 {
            shift = [0.0; 3];
        }
    }
    match doubled(trial.domain, |p| std::array::from_fn(|k| p[k] + shift[k])) {
        Ok(domain) => {
            let words = match shift {
                [0.0, 0.0, 0.0] => "the union with a copy".to_string(),
                _ => format!("the union with a copy translated by {shift:?}"),
            };
            let mut image = Image::new(words, domain);
            image.places = vec![(0..n).collect(), (n..2 * n).collect()];
            relation::decide(trial, construction, vec![image])
        }
        Err(why) => Verdict::not_applicable(why),
    }
}
