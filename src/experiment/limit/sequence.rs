//! Sequences of meshes that refine a smooth domain.

use std::collections::BTreeMap;

use super::place::Place;
use crate::domain::Domain;
use crate::generate;

/// A way to refine a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Way {
    /// The same pattern at every level.
    Structured,
    /// Evenly spaced boundary vertices, random interior ones, Delaunay.
    RandomDelaunay,
    /// The structured square after random flips, one for every sixteen edges: no longer Delaunay. On a lattice no triangle is
    /// smaller than another; elsewhere flips make triangles as thin as rounding allows, and what they carry does not converge.
    Flipped,
}

/// A sequence of meshes, level by level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Sequence {
    /// What is refined.
    pub place: Place,
    /// How.
    pub way: Way,
}

/// One mesh of a sequence.
pub struct Mesh {
    /// What it refines.
    pub place: Place,
    /// The mesh.
    pub domain: Domain,
    /// `√(2 area/triangles)`: the leg of a right isosceles triangle of the mean area.
    pub h: f64,
}

/// Every sequence. Flips on a surface in space change its shape.
pub const ALL: &[Sequence] = &[
    Sequence { place: Place::Square, way: Way::Structured },
    Sequence { place: Place::Square, way: Way::RandomDelaunay },
    Sequence { place: Place::Square, way: Way::Flipped },
    Sequence { place: Place::Disc, way: Way::Structured },
    Sequence { place: Place::Disc, way: Way::RandomDelaunay },
    Sequence { place: Place::Torus, way: Way::Structured },
    Sequence { place: Place::Sphere, way: Way::Structured },
];

impl Sequence {
    /// The name used in texts.
    pub fn name(self) -> &'static str {
        match (self.place, self.way) {
            (Place::Square, Way::Structured) => "square, structured",
            (Place::Square, Way::RandomDelaunay) => "square, random Delaunay",
            (Place::Square, Way::Flipped) => "square, flipped",
            (Place::Disc, Way::RandomDelaunay) => "disc, random Delaunay",
            (Place::Disc, _) => "disc, rings",
            (Place::Torus, _) => "flat torus, structured",
            (Place::Sphere, _) => "sphere, icosahedral",
        }
    }

    /// How many meshes a level has, where `random` are drawn for those that are random.
    pub fn draws(self, random: usize) -> usize {
        if self.way == Way::Structured { 1 } else { random }
    }

    /// The mesh of a level: some `4^level` vertices.
    ///
    /// # Errors
    /// What a generator refuses, in words.
    pub fn mesh(self, level: usize, seed: u64) -> Result<Mesh, String> {
        let cells = 1_usize << level;
        let whole = |k: usize| k.to_string();
        let mut domain = match (self.place, self.way) {
            (Place::Square, Way::RandomDelaunay) => {
                let given = [("nx", whole(cells)), ("ny", whole(cells)), ("displacement", "0.499".into())];
                let grid = source("perturbed-grid", &given, seed)?;
                let unit = change(&grid, "scale", &[("factor", (1.0 / cells as f64).to_string())], seed)?;
                change(&unit, "delaunay", &[], seed)?
            }
            (Place::Square, _) => source("square", &[("levels", whole(level))], seed)?,
            // Rings at the level below have 6n boundary edges and 3n² + 3n + 1 vertices, n = 2^(level − 1); here as many.
            (Place::Disc, Way::RandomDelaunay) => {
                let n = cells / 2;
                let given = [("n", whole(3 * n * n - 3 * n + 1)), ("m", whole(6 * n))];
                source("random-delaunay-disk", &given, seed)?
            }
            (Place::Disc, _) => source("disk", &[("levels", whole(level.saturating_sub(1)))], seed)?,
            (Place::Torus, _) => source("flat-torus", &[("levels", whole(level.saturating_sub(2)))], seed)?,
            (Place::Sphere, _) => source("icosphere", &[("levels", whole(level.saturating_sub(2)))], seed)?,
        };
        if self.way == Way::Flipped {
            let count = domain.edges().len() / 16;
            domain = change(&domain, "flip", &[("count", whole(count))], seed)?;
        }
        let surface = domain.as_surface().ok_or("not a surface")?;
        let h = (2.0 * surface.area() / surface.faces().len() as f64).sqrt();
        Ok(Mesh { place: self.place, domain, h })
    }
}

fn source(id: &str, given: &[(&str, String)], seed: u64) -> Result<Domain, String> {
    make(None, id, given, seed)
}

fn change(domain: &Domain, id: &str, given: &[(&str, String)], seed: u64) -> Result<Domain, String> {
    make(Some(domain), id, given, seed)
}

/// Runs a generator of the catalogue.
pub fn make(input: Option<&Domain>, id: &str, given: &[(&str, String)], seed: u64) -> Result<Domain, String> {
    let generator = generate::find(id).ok_or_else(|| format!("there is no generator '{id}'"))?;
    let given: BTreeMap<String, String> = given.iter().map(|(k, v)| (k.to_string(), v.clone())).collect();
    generator.run(input, &given, seed).map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sequence_halves_its_size_and_fills_its_place() {
        for sequence in ALL {
            let area = match sequence.place {
                Place::Square | Place::Torus => 1.0,
                Place::Disc => std::f64::consts::PI,
                Place::Sphere => 4.0 * std::f64::consts::PI,
            };
            let meshes: Vec<Mesh> = (2..5).map(|level| sequence.mesh(level, 7).unwrap()).collect();
            let found = |m: &Mesh| m.domain.as_surface().unwrap().area();
            assert!((found(&meshes[2]) - area).abs() < 0.05 * area, "{}", sequence.name());
            for pair in meshes.windows(2) {
                let ratio = pair[0].h / pair[1].h;
                assert!((1.8..2.2).contains(&ratio), "{}: {ratio}", sequence.name());
            }
            let facts = meshes[2].domain.facts().surface.unwrap();
            assert_eq!(facts.delaunay == Some(true), sequence.way != Way::Flipped, "{}", sequence.name());
        }
    }
}
