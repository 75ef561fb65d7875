//! Sequences of meshes that refine a smooth domain.

use std::collections::BTreeMap;

use super::mesh::Mesh;
use super::place::Place;
use crate::domain::{Domain, Surface, geometry};
use crate::generate::{self, Stream};

/// A way to refine a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Way {
    /// The same pattern at every size.
    Structured,
    /// Random vertices inside, in the plane connected by Delaunay, on the sphere and in the cube as in the pattern; on the torus random diagonals.
    Random,
    /// The pattern after random flips that leave no angle above [`WIDEST`], one for every eight edges where so many are found.
    Flipped,
}

/// The widest angle that flips may make, in degrees. Linear elements converge on meshes whose angles stay below some bound less than 180°
/// \[babuska-aziz1976\], and need not on others: without the bound flips make triangles as thin as rounding allows.
pub const WIDEST: f64 = 150.0;

/// A sequence of meshes, size by size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Sequence {
    /// What is refined.
    pub place: Place,
    /// How.
    pub way: Way,
}

const fn sequence(place: Place, way: Way) -> Sequence {
    Sequence { place, way }
}

/// Every sequence.
pub const ALL: &[Sequence] = &[
    sequence(Place::Square, Way::Structured),
    sequence(Place::Square, Way::Random),
    sequence(Place::Square, Way::Flipped),
    sequence(Place::Disc, Way::Structured),
    sequence(Place::Disc, Way::Random),
    sequence(Place::Disc, Way::Flipped),
    sequence(Place::Torus, Way::Structured),
    sequence(Place::Torus, Way::Random),
    sequence(Place::Sphere, Way::Structured),
    sequence(Place::Sphere, Way::Random),
    sequence(Place::Cube, Way::Structured),
    sequence(Place::Cube, Way::Random),
];

/// Whether a sequence is among those for a quick look: neither flipped, nor a disc or a cube of random vertices.
pub fn is_quick(sequence: Sequence) -> bool {
    let drawn = sequence.way == Way::Random && ![Place::Disc, Place::Cube].contains(&sequence.place);
    sequence.way == Way::Structured || drawn
}

impl Sequence {
    /// The name used in texts.
    pub fn name(self) -> &'static str {
        match (self.place, self.way) {
            (Place::Square, Way::Structured) => "square, structured",
            (Place::Square, Way::Random) => "square, random Delaunay",
            (Place::Square, Way::Flipped) => "square, flipped",
            (Place::Disc, Way::Random) => "disc, random Delaunay",
            (Place::Disc, Way::Flipped) => "disc, flipped",
            (Place::Disc, _) => "disc, rings",
            (Place::Torus, Way::Random) => "flat torus, random diagonals",
            (Place::Torus, _) => "flat torus, structured",
            (Place::Sphere, Way::Random) => "sphere, random",
            (Place::Sphere, _) => "sphere, icosahedral",
            (Place::Cube, Way::Random) => "cube, random",
            (Place::Cube, _) => "cube, structured",
        }
    }

    /// Whether meshes are drawn.
    pub fn is_random(self) -> bool {
        self.way != Way::Structured
    }

    /// The mesh with some n² vertices, n a power of two, at least 4; in the cube n³, n any number. Each seed, size and sequence draws
    /// independently.
    ///
    /// # Errors
    /// What a generator refuses, in words.
    pub fn mesh(self, n: usize, seed: u64) -> Result<Mesh, String> {
        let whole = |k: usize| k.to_string();
        let level = n.ilog2() as usize;
        let mut stream = Stream::new(seed, &format!("{} {n}", self.name()));
        let drawn = stream.bits();
        let unit = ("factor", (1.0 / n as f64).to_string());
        let pattern = match (self.place, self.way) {
            (Place::Square, Way::Random) => {
                let given = [("nx", whole(n)), ("ny", whole(n)), ("displacement", "0.499".into())];
                let grid = make(None, "perturbed-grid", &given, drawn)?;
                make(Some(&make(Some(&grid), "scale", &[unit], drawn)?), "delaunay", &[], drawn)?
            }
            (Place::Square, _) => make(None, "square", &[("levels", whole(level))], drawn)?,
            (Place::Disc, _) => make(None, "disk", &[("levels", whole(level - 1))], drawn)?,
            (Place::Torus, way) => {
                let diagonals = if way == Way::Random { "random" } else { "right" };
                make(None, "flat-torus", &[("levels", whole(level - 2)), ("diagonals", diagonals.into())], drawn)?
            }
            (Place::Sphere, _) => make(None, "icosphere", &[("levels", whole(level - 2))], drawn)?,
            (Place::Cube, way) => {
                let displacement = if way == Way::Random { "0.16" } else { "0" };
                let given = ["nx", "ny", "nz"].map(|name| (name, whole(n)));
                let given: Vec<_> = given.into_iter().chain([("displacement", displacement.into())]).collect();
                make(Some(&make(None, "tet-grid", &given, drawn)?), "scale", &[unit], drawn)?
            }
        };
        let domain = match (self.place, self.way) {
            (Place::Disc, Way::Random) => {
                let moved = make(Some(&pattern), "perturb", &[("amount", "0.499".into())], drawn)?;
                make(Some(&moved), "delaunay", &[], drawn)?
            }
            (Place::Sphere, Way::Random) => jittered(&pattern, &mut stream)?,
            (_, Way::Flipped) => flipped(&pattern, &mut stream)?,
            _ => pattern,
        };
        Mesh::new(self.place, domain).ok_or_else(|| format!("{}: no triangles or tetrahedra", self.name()))
    }
}

/// Runs a generator of the catalogue.
///
/// # Errors
/// What it refuses, in words.
pub fn make(input: Option<&Domain>, id: &str, given: &[(&str, String)], seed: u64) -> Result<Domain, String> {
    let generator = generate::find(id).ok_or_else(|| format!("there is no generator '{id}'"))?;
    let given: BTreeMap<String, String> = given.iter().map(|(k, v)| (k.to_string(), v.clone())).collect();
    generator.run(input, &given, seed).map_err(|e| e.to_string())
}

/// Vertices of a sphere about the origin moved along it, by no more than three tenths of the shortest edge in each coordinate before they are drawn
/// back to it. The triangles of an icosphere stay away from zero area, and some edges are no longer Delaunay.
fn jittered(domain: &Domain, stream: &mut Stream) -> Result<Domain, String> {
    let surface = domain.as_surface().ok_or("not a surface")?;
    let length = |&[a, b]: &[usize; 2]| (surface.point(a) - surface.point(b)).norm();
    let shortest = domain.edges().iter().map(length).fold(f64::INFINITY, f64::min);
    let moved = surface.positions().iter().map(|p| {
        let q = p.map(|x| x + 0.3 * shortest * stream.between(-1.0, 1.0));
        super::place::unit(q)
    });
    let moved = surface.with_positions(moved.collect()).map_err(|e| e.to_string())?;
    Ok(moved.into())
}

/// Flips edges in random order, each face at most once, so that no triangle is flipped out of shape step by step: where both new
/// triangles lie inside the two old ones and have no angle above [`WIDEST`].
fn flipped(domain: &Domain, stream: &mut Stream) -> Result<Domain, String> {
    let surface = domain.as_surface().ok_or("not a surface")?;
    let mut faces: Vec<[usize; 3]> = (0..surface.faces().len()).filter_map(|f| surface.triangle(f)).collect();
    let mut free = vec![true; faces.len()];
    let mut edges: Vec<usize> = (0..domain.edges().len()).collect();
    stream.shuffle(&mut edges);
    let mut wanted = edges.len() / 8;
    for edge in edges {
        let [(f, c), (g, d)] = surface.opposite(edge)[..] else { continue };
        if wanted == 0 {
            break;
        }
        // The face f is (a, b, c) and the other one (b, a, d), both counter-clockwise.
        let at = faces[f].iter().position(|v| *v == c).unwrap_or(0);
        let (a, b) = (faces[f][(at + 1) % 3], faces[f][(at + 2) % 3]);
        let new = [[c, a, d], [d, b, c]];
        if free[f] && free[g] && new.iter().all(|t| is_admitted(surface, *t)) {
            (faces[f], faces[g]) = (new[0], new[1]);
            (free[f], free[g]) = (false, false);
            wanted -= 1;
        }
    }
    let made = Surface::triangles(surface.positions().to_vec(), &faces).map_err(|e| e.to_string())?;
    Ok(made.into())
}

/// Whether a triangle of the plane is counter-clockwise without an angle above [`WIDEST`].
fn is_admitted(surface: &Surface, triangle: [usize; 3]) -> bool {
    let [p, q, r] = triangle.map(|v| surface.positions()[v]);
    let plane = [p, q, r].map(|x| [x[0], x[1]]);
    let corners = triangle.map(|v| surface.point(v));
    let angle = |k: usize| geometry::angle(corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
    geometry::orient2d(plane[0], plane[1], plane[2]).is_gt() && (0..3).all(|k| angle(k).to_degrees() <= WIDEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sequence_halves_its_size_and_fills_its_place() {
        for sequence in ALL {
            let full = match sequence.place {
                Place::Square | Place::Torus | Place::Cube => 1.0,
                Place::Disc => std::f64::consts::PI,
                Place::Sphere => 4.0 * std::f64::consts::PI,
            };
            let meshes: Vec<Mesh> = [4, 8, 16].into_iter().map(|n| sequence.mesh(n, 7).unwrap()).collect();
            let found: f64 = meshes[2].elements.iter().map(|e| e.measure).sum();
            assert!((found - full).abs() < 0.05 * full, "{}", sequence.name());
            for pair in meshes.windows(2) {
                let ratio = pair[0].h / pair[1].h;
                assert!((1.7..2.2).contains(&ratio), "{}: {ratio}", sequence.name());
            }
        }
    }

    #[test]
    fn flips_and_moves_leave_delaunay_and_no_angle_above_the_bound() {
        for sequence in ALL.iter().filter(|s| s.place != Place::Cube) {
            for seed in 0..10 {
                let mesh = sequence.mesh(16, seed).unwrap();
                let facts = mesh.domain.facts().surface.unwrap();
                let obtuse = sequence.way == Way::Flipped || *sequence == super::sequence(Place::Sphere, Way::Random);
                assert_eq!(facts.delaunay == Some(true), !obtuse, "{}", sequence.name());
                assert_eq!((facts.degenerate_faces, facts.flipped_faces), (0, 0));
                if sequence.way != Way::Random || sequence.place == Place::Sphere {
                    assert!(facts.max_angle_deg < WIDEST + 1e-9, "{}: {facts:?}", sequence.name());
                }
                let count = mesh.domain.edges().len() / 8;
                if sequence.way == Way::Flipped {
                    let still = Sequence { way: Way::Structured, ..*sequence }.mesh(16, seed).unwrap();
                    let new = mesh.domain.edges().iter().filter(|e| !still.domain.edges().contains(e)).count();
                    assert!(2 * new >= count && new <= count, "{}: {new} of {count}", sequence.name());
                }
            }
        }
    }

    #[test]
    fn another_seed_or_size_is_another_draw() {
        for sequence in ALL.iter().filter(|s| s.is_random()) {
            let [a, b] = [1, 2].map(|seed| sequence.mesh(8, seed).unwrap().domain.digest());
            assert_ne!(a, b);
            assert_eq!(a, sequence.mesh(8, 1).unwrap().domain.digest());
        }
    }
}
