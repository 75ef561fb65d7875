//! Refinement sequence of the unit square.

use super::shape::sheet::{DIAGONALS, Sheet};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "square",
    name: "unit square, structured, 2^levels cells along each side",
    guarantees: &[
        "(2^levels + 1)² vertices with exact coordinates, 2·4^levels triangles, nested in their vertices, area 1",
        "planar, manifold, connected, genus 0, one boundary loop, Delaunay with cocircular diagonals",
    ],
    sources: &[],
    parameters: &[
        Parameter { name: "levels", meaning: "level of refinement", default: "3", range: Range::Whole(0, 10) },
        DIAGONALS,
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let n = 1 << settings.whole("levels");
    let sheet = Sheet::open(n, n);
    let points: Vec<[f64; 2]> = sheet.vertices().map(|at| at.map(|k| k as f64 / n as f64)).collect();
    let faces = sheet.cut(settings.get("diagonals"), stream);
    Ok(Surface::planar(&points, &faces)?.into())
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{disc, make};

    #[test]
    fn every_level_is_the_unit_square() {
        for level in 0..6 {
            for diagonals in ["right", "alternating"] {
                let domain = make("square", &[("levels", &level.to_string()), ("diagonals", diagonals)], 0);
                let (all, facts) = (domain.facts(), disc(&domain));
                assert_eq!((all.vertices, all.faces), ((2_usize.pow(level) + 1).pow(2), 2 * 4_usize.pow(level)));
                assert_eq!((facts.delaunay, facts.cocircular_edges), (Some(true), Some(4_usize.pow(level))));
                // Dyadic coordinates: every area is a power of two and every partial sum exact.
                assert_eq!(facts.area, 1.0);
            }
        }
    }
}
