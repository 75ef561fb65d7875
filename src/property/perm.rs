//! PERM: numbers are names.
//!
//! # Definition
//! Renumbering the vertices by P: `L(PX) = P L(X) Pᵀ`. Renumbering the faces, and starting each at another corner, changes
//! nothing.
//!
//! # Decision
//! A seeded permutation of the vertices, and on surfaces and volumes one of the faces with a seeded start for each. Compared entry by
//! entry ([`relation`](super::relation)): sums may be formed in another order, nothing else may differ.

use super::relate::image::{Image, renumbered};
use super::relate::relation;
use super::{Construction, Property, Question, Trial, Verdict};
use crate::domain::{Domain, Surface, Volume};
use crate::stream::Stream;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "PERM",
    name: "invariance under renumbering",
    statement: "L(PX) = P L(X) Pᵀ for a permutation P of the vertices; the order of faces and of their corners does not matter",
    sources: &[],
    question: Question::Construction(decide),
};

fn decide(trial: &Trial, construction: &Construction) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    match images(trial) {
        Ok(images) => relation::decide(trial, construction, images),
        Err(why) => Verdict::not_applicable(why),
    }
}

fn images(trial: &Trial) -> Result<Vec<Image>, String> {
    let seed = trial.seed;
    let mut stream = Stream::new(seed, "PERM");
    let mut place: Vec<usize> = (0..trial.domain.vertex_count()).collect();
    stream.shuffle(&mut place);
    let domain = renumbered(trial.domain, &place)?;
    let words = format!("renumbering the vertices (stream PERM, seed {seed})");
    let mut images = vec![Image { places: vec![place], ..Image::new(words, domain) }];
    let words = format!("renumbering the faces and starting each at another corner (stream PERM, seed {seed})");
    match trial.domain {
        Domain::Surface(s) => {
            let mut faces = s.faces().to_vec();
            stream.shuffle(&mut faces);
            for corners in &mut faces {
                let start = stream.below(corners.len());
                corners.rotate_left(start);
            }
            let surface = Surface::new(s.positions().to_vec(), faces).map_err(|e| e.to_string())?;
            images.push(Image::new(words, surface.into()));
        }
        Domain::Volume(v) => {
            let mut tetrahedra = v.tetrahedra().to_vec();
            stream.shuffle(&mut tetrahedra);
            // Cyclic shifts of the last three corners keep the orientation.
            tetrahedra.iter_mut().for_each(|t| t[1..].rotate_left(stream.below(3)));
            let volume = Volume::new(v.positions().to_vec(), tetrahedra).map_err(|e| e.to_string())?;
            images.push(Image::new(words, volume.into()));
        }
        Domain::Graph(_) | Domain::Points(_) => {}
    }
    Ok(images)
}
