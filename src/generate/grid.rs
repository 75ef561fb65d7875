//! The structured triangulation of a rectangle: unit squares, each cut by a diagonal.

use super::shape::input::admit;
use super::shape::sheet::{DIAGONALS, Sheet};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// Cells in x.
pub(super) const NX: Parameter =
    Parameter { name: "nx", meaning: "cells in x", default: "8", range: Range::Whole(1, 1_000_000) };

/// Cells in y.
pub(super) const NY: Parameter =
    Parameter { name: "ny", meaning: "cells in y", default: "8", range: Range::Whole(1, 1_000_000) };

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "grid",
    name: "structured grid of unit squares, each cut by a diagonal, with integer coordinates",
    guarantees: &[
        "(nx+1)(ny+1) vertices at the points of the integer lattice, row by row, 2·nx·ny triangles",
        "planar, manifold, connected, genus 0, one boundary loop, no degenerate face, area nx·ny exactly",
        "Delaunay, with nx·ny cocircular edges: the diagonals",
    ],
    sources: &[],
    parameters: &[NX, NY, DIAGONALS],
    make: Make::Source(make),
};

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let sheet = Sheet::open(settings.whole("nx"), settings.whole("ny"));
    admit("grid", "vertices", (sheet.columns + 1) * (sheet.rows + 1))?;
    let faces = sheet.cut(settings.get("diagonals"), stream);
    Ok(Surface::planar(&lattice(&sheet), &faces)?.into())
}

/// The points of the integer lattice.
pub(super) fn lattice(sheet: &Sheet) -> Vec<[f64; 2]> {
    sheet.vertices().map(|[i, j]| [i as f64, j as f64]).collect()
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{disc, make};

    #[test]
    fn a_grid_is_a_delaunay_disc_whose_diagonals_are_cocircular() {
        for diagonals in ["right", "left", "alternating", "random"] {
            for (nx, ny) in [(1, 1), (4, 3), (2, 9)] {
                let domain =
                    make("grid", &[("nx", &nx.to_string()), ("ny", &ny.to_string()), ("diagonals", diagonals)], 5);
                let facts = disc(&domain);
                assert_eq!((domain.vertex_count(), domain.facts().faces), ((nx + 1) * (ny + 1), 2 * nx * ny));
                assert_eq!((facts.delaunay, facts.cocircular_edges), (Some(true), Some(nx * ny)));
                assert!((facts.area - (nx * ny) as f64).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn the_chessboard_has_valences_four_and_eight_inside() {
        let domain = make("grid", &[("diagonals", "alternating")], 0);
        let mut valence = vec![0; domain.vertex_count()];
        domain.edges().iter().flatten().for_each(|&v| valence[v] += 1);
        assert!(domain.interior().iter().all(|&v| valence[v] == 4 || valence[v] == 8));
    }

    #[test]
    fn more_vertices_than_admitted_are_refused() {
        let given = [("nx", "1000000"), ("ny", "1000000")].map(|(k, v)| (k.to_string(), v.to_string()));
        let error = super::ENTRY.run(None, &given.into(), 0).unwrap_err();
        assert!(error.to_string().contains("choose smaller parameters"), "{error}");
    }
}
