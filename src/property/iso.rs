//! ISO: the operator is intrinsic.
//!
//! # Definition
//! Folding a planar mesh along a straight chain of edges changes no length inside the surface, and so neither L nor M.
//!
//! # Decision
//! The longest straight chain of interior edges from boundary to boundary is found exactly; the smaller part of the mesh is turned about it by
//! a right angle. New coordinates are rounded: vertices are displaced by up to `32 u` times the diameter.
//!
//! # Exception
//! Not applicable where the mesh is not planar or has no such chain.

use super::relate::crease;
use super::relate::image::{Image, extent, moved};
use super::relate::relation;
use super::tolerance::UNIT_ROUNDOFF;
use super::{Construction, Property, Question, Trial, Verdict};
use crate::domain::geometry::Vec3;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "ISO",
    name: "invariance under isometric folding",
    statement: "folding a planar mesh along a straight chain of edges changes neither L nor M",
    sources: &[],
    question: Question::Construction(decide),
};

fn decide(trial: &Trial, construction: &Construction) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let Some(surface) = trial.domain.as_surface() else {
        return Verdict::not_applicable(format!("a {} cannot be folded", trial.domain.kind()));
    };
    let Some(axes) = surface.plane() else {
        return Verdict::not_applicable("the mesh is not planar");
    };
    let Some(found) = crease::longest(surface, axes) else {
        return Verdict::not_applicable("no straight chain of interior edges runs from boundary to boundary");
    };
    let (first, last) = (found.chain[0], found.chain[found.chain.len() - 1]);
    let origin = surface.point(first);
    let along = (surface.point(last) - origin).normalize();
    let normal_axis = 3 - axes[0] - axes[1];
    let normal = Vec3::ith(normal_axis, 1.0);
    let across = normal.cross(&along);
    let fold = |v: usize, p: [f64; 3]| {
        if !found.folded[v] {
            return p;
        }
        let q = Vec3::from(p) - origin;
        (origin + along * along.dot(&q) + normal * across.dot(&q)).into()
    };
    let words = format!(
        "folding by 90° along the {} edges from vertex {first} to vertex {last}, the smaller part turned",
        found.chain.len() - 1
    );
    let (_, diameter) = extent(surface.positions());
    let largest = surface.positions().iter().flatten().fold(diameter, |m, x| m.max(x.abs()));
    match moved(trial.domain, fold, |n| n, false) {
        Some(Ok(domain)) => {
            let image = Image::new(words, domain).displaced(32.0 * UNIT_ROUNDOFF * largest);
            relation::decide(trial, construction, vec![image])
        }
        Some(Err(why)) => Verdict::not_applicable(why),
        None => Verdict::not_applicable("the domain has no positions"),
    }
}
