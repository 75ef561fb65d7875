//! The two drums that sound alike: seven copies of a triangle, glued along their sides in two ways.
//!
//! # Definition
//! A gluing has an involution of the tiles 0, …, 6 for each side of the tile, the one opposite corner 0, 1, 2: two tiles that it
//! exchanges are mirror images in their common side, a tile that it fixes has a side of the boundary there. Both gluings here are
//! trees of tiles, so that any triangle unfolds along them into the plane. [`DRUMS`] has the pair from which the drums of Gordon,
//! Webb and Wolpert come, with right isosceles tiles two octagons.
//!
//! A tile is cut into n² triangles by lines parallel to its sides, n = 2^level: a mirror image of a tile has the mirror image
//! of its mesh.
//!
//! # References
//! \[gordon-webb-wolpert1992\]; \[buser1994\] section 2, where the pairs of gluings are listed.

use super::shape::input::impossible;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, DomainError, Surface, geometry};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "drum",
    name: "one of two drums that sound alike: seven triangles glued along their sides",
    guarantees: &[
        "9 + 15(n−1) + 7(n−1)(n−2)/2 vertices and 7n² triangles for n = 2^level, 9n edges on the boundary, seven times the area of the tile",
        "planar, manifold, connected, genus 0, one boundary loop; a tile with a sharp angle may make the drum overlap itself",
        "every vertex has exact coordinates where the tile is right isosceles with its legs along the axes and whole numbers as corners",
    ],
    sources: &["gordon-webb-wolpert1992", "buser1994"],
    parameters: &[
        Parameter { name: "which", meaning: "which of the two", default: "a", range: Range::Choice(&["a", "b"]) },
        Parameter {
            name: "level",
            meaning: "level of refinement of the tile",
            default: "3",
            range: Range::Whole(0, 8),
        },
        Parameter {
            name: "tile",
            meaning: "the corners of the first tile, coordinates apart by a space and corners by ';'",
            default: "2 0;0 2;0 0",
            range: Range::Form("three corners of two finite coordinates, as in '2 0;0 2;0 0'", |text| {
                corners(text).is_some()
            }),
        },
    ],
    make: Make::Source(make),
};

/// For each side the involution of the seven tiles.
pub type Gluing = [[usize; 7]; 3];

/// The gluings of the two drums.
pub const DRUMS: [Gluing; 2] = [
    [[0, 2, 1, 3, 5, 4, 6], [0, 1, 3, 2, 6, 5, 4], [1, 0, 2, 4, 3, 5, 6]],
    [[0, 2, 1, 3, 5, 4, 6], [0, 3, 2, 1, 4, 6, 5], [1, 0, 2, 4, 3, 5, 6]],
];

/// The corners of a triangle.
pub type Corners = [[f64; 2]; 3];

/// Seven tiles glued together, each with the mesh of a triangle.
#[derive(Clone, Debug)]
pub struct Drum {
    /// The number n of parts of a side.
    pub parts: usize,
    /// For each tile the vertices of its mesh, in the order of [`lattice`].
    pub vertices: Vec<Vec<usize>>,
    /// The corners of each tile.
    tiles: Vec<Corners>,
    /// Whether each tile is a mirror image of the first.
    mirrored: Vec<bool>,
}

/// The vertices of the mesh of a tile by their barycentric coordinates, multiplied by n.
pub fn lattice(parts: usize) -> Vec<[usize; 3]> {
    (0..=parts).flat_map(|i| (0..=parts - i).map(move |j| [i, j, parts - i - j])).collect()
}

impl Drum {
    /// Unfolds the tiles of a gluing from the first one.
    pub fn new(gluing: &Gluing, tile: Corners, parts: usize) -> Self {
        let local = lattice(parts);
        let mut drum = Drum { parts, vertices: Vec::new(), tiles: vec![tile], mirrored: vec![false] };
        drum.vertices.push((0..local.len()).collect());
        let mut count = local.len();
        for t in 1..7 {
            // In the numbering of `DRUMS` every tile but the first is glued to one before it.
            let glued = (0..t).flat_map(|s| (0..3).map(move |side| (s, side))).find(|&(s, side)| gluing[side][s] == t);
            let Some((s, side)) = glued else { continue };
            let mut corners = drum.tiles[s];
            corners[side] = reflected(corners[side], corners[(side + 1) % 3], corners[(side + 2) % 3]);
            let vertex = |(v, at): (usize, &[usize; 3])| {
                if at[side] == 0 {
                    return drum.vertices[s][v];
                }
                count += 1;
                count - 1
            };
            let vertices = local.iter().enumerate().map(vertex).collect();
            drum.vertices.push(vertices);
            drum.tiles.push(corners);
            drum.mirrored.push(!drum.mirrored[s]);
        }
        drum
    }

    /// How many vertices there are.
    pub fn vertex_count(&self) -> usize {
        self.vertices.iter().flatten().max().map_or(0, |last| last + 1)
    }

    /// The positions of the vertices.
    pub fn points(&self) -> Vec<[f64; 2]> {
        let mut points = vec![[0.0; 2]; self.vertex_count()];
        let n = self.parts as f64;
        // The tile that has a vertex first, comes last.
        for (vertices, corners) in self.vertices.iter().zip(&self.tiles).rev() {
            for (&v, at) in vertices.iter().zip(lattice(self.parts)) {
                let along = |axis: usize| (0..3).map(|k| at[k] as f64 * corners[k][axis]).sum::<f64>() / n;
                points[v] = [along(0), along(1)];
            }
        }
        points
    }

    /// The triangles, counter-clockwise.
    pub fn faces(&self) -> Vec<[usize; 3]> {
        let turned = geometry::orient2d(self.tiles[0][0], self.tiles[0][1], self.tiles[0][2]).is_lt();
        let small = cut(self.parts);
        let of_tile = |(vertices, mirrored): (&Vec<usize>, &bool)| {
            let place = |f: &[usize; 3]| {
                let [a, b, c] = f.map(|v| vertices[v]);
                if *mirrored == turned { [a, b, c] } else { [a, c, b] }
            };
            small.iter().map(place).collect::<Vec<_>>()
        };
        self.vertices.iter().zip(&self.mirrored).flat_map(of_tile).collect()
    }

    /// The drum as a surface in the plane.
    ///
    /// # Errors
    /// Coordinates out of range.
    pub fn surface(&self) -> Result<Surface, DomainError> {
        Surface::planar(&self.points(), &self.faces())
    }
}

/// The triangles of the mesh of a tile, counter-clockwise where the tile is.
pub fn cut(parts: usize) -> Vec<[usize; 3]> {
    // Row i of the lattice has n + 1 − i vertices.
    let vertex = |i: usize, j: usize| i * (parts + 1) - i * i.saturating_sub(1) / 2 + j;
    let cells = (0..parts).flat_map(|i| (0..parts - i).map(move |j| (i, j)));
    cells
        .flat_map(|(i, j)| {
            let upright = [vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)];
            let between = [vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            std::iter::once(upright).chain((i + j + 1 < parts).then_some(between))
        })
        .collect()
}

/// The mirror image of p in the line through a and b. Cost: a dozen operations, each rounded.
fn reflected(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let normal = [a[1] - b[1], b[0] - a[0]];
    let square = normal[0] * normal[0] + normal[1] * normal[1];
    let twice = 2.0 * ((p[0] - a[0]) * normal[0] + (p[1] - a[1]) * normal[1]) / square;
    [p[0] - twice * normal[0], p[1] - twice * normal[1]]
}

fn corners(text: &str) -> Option<Corners> {
    let corner = |part: &str| {
        let x: Vec<f64> = part.split_whitespace().map(|w| w.parse().ok()).collect::<Option<_>>()?;
        <[f64; 2]>::try_from(x).ok().filter(|x| x.iter().all(|x| x.is_finite()))
    };
    let all: Vec<[f64; 2]> = text.split(';').map(corner).collect::<Option<_>>()?;
    all.try_into().ok()
}

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let parts = 1 << settings.whole("level");
    // The text was checked against its form.
    let tile = corners(settings.get("tile")).unwrap_or_default();
    if geometry::orient2d(tile[0], tile[1], tile[2]).is_eq() {
        return Err(impossible(ENTRY.id, "the corners of the tile lie on a line; give three that do not"));
    }
    let gluing = &DRUMS[usize::from(settings.get("which") == "b")];
    Ok(Drum::new(gluing, tile, parts).surface()?.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::testing::{disc, given, make};

    #[test]
    fn both_gluings_are_trees_of_seven_tiles() {
        for gluing in DRUMS {
            let pairs: Vec<(usize, usize)> =
                gluing.iter().flat_map(|p| (0..7).map(|s| (s, p[s]))).filter(|(s, t)| s < t).collect();
            assert!(gluing.iter().all(|p| (0..7).all(|s| p[p[s]] == s)), "involutions");
            assert_eq!(pairs.len(), 6);
            assert!((1..7).all(|t| pairs.iter().any(|(_, u)| *u == t)), "each is glued to one before it");
        }
    }

    #[test]
    fn counts_area_and_boundary_are_the_closed_forms() {
        for which in ["a", "b"] {
            for level in 0..4 {
                for (tile, area) in [("2 0;0 2;0 0", 2.0), ("0 0;0 2;2 0", 2.0), ("0 0;1.25 0.5;0.5 1", 0.5)] {
                    let domain = make("drum", &[("which", which), ("level", &level.to_string()), ("tile", tile)], 0);
                    let (n, facts) = (1_usize << level, disc(&domain));
                    let vertices = 9 + 15 * (n - 1) + 7 * (n - 1) * n.saturating_sub(2) / 2;
                    assert_eq!((domain.vertex_count(), domain.facts().faces), (vertices, 7 * n * n));
                    assert_eq!(facts.boundary_edges, 9 * n);
                    assert!((facts.area - 7.0 * area).abs() < 1e-13, "{which} {level} {tile}");
                    let surface = domain.as_surface().unwrap();
                    let small = area / (n * n) as f64;
                    assert!((0..7 * n * n).all(|f| (surface.face_area(f) - small).abs() < 1e-13), "congruent");
                }
            }
        }
    }

    /// The lengths of the sides of the boundary polygon, straight corners left out, in order.
    fn sides(domain: &Domain) -> Vec<f64> {
        let surface = domain.as_surface().unwrap();
        let topology = surface.topology();
        let boundary: Vec<[usize; 2]> = (0..topology.edges().len())
            .filter(|&e| topology.is_boundary_edge(e))
            .map(|e| topology.edges()[e])
            .collect();
        let mut cycle = vec![boundary[0][0], boundary[0][1]];
        while cycle.len() < boundary.len() {
            let [.., before, last] = cycle[..] else { unreachable!() };
            let next = boundary.iter().find(|e| e.contains(&last) && !e.contains(&before)).unwrap();
            cycle.push(next[0] + next[1] - last);
        }
        let n = cycle.len();
        let at = |k: usize| surface.point(cycle[k % n]);
        let corners: Vec<usize> =
            (0..n).filter(|&k| (at(k) - at(k + n - 1)).cross(&(at(k + 1) - at(k))).norm() > 1e-9).collect();
        let m = corners.len();
        (0..m).map(|k| (at(corners[(k + 1) % m]) - at(corners[k])).norm()).collect()
    }

    #[test]
    fn with_right_isosceles_tiles_they_are_two_octagons_of_one_perimeter_that_are_not_congruent() {
        let found = ["a", "b"].map(|which| sides(&make("drum", &[("which", which), ("level", "0")], 0)));
        let root = 2.0_f64.sqrt();
        for lengths in &found {
            assert_eq!(lengths.len(), 8);
            assert!((lengths.iter().sum::<f64>() - 2.0 * (6.0 + 3.0 * root)).abs() < 1e-12);
        }
        let longest = found.map(|lengths| lengths.into_iter().fold(0.0, f64::max));
        assert!((longest[0] - 4.0 * root).abs() < 1e-12 && (longest[1] - 4.0).abs() < 1e-12, "{longest:?}");
    }

    #[test]
    fn vertices_that_two_tiles_share_are_at_one_place() {
        let drum = Drum::new(&DRUMS[0], [[5.0, 1.0], [1.0, 4.0], [0.0, 0.0]], 4);
        let points = drum.points();
        for (vertices, corners) in drum.vertices.iter().zip(&drum.tiles) {
            for (&v, at) in vertices.iter().zip(lattice(4)) {
                let along = |axis: usize| (0..3).map(|k| at[k] as f64 * corners[k][axis]).sum::<f64>() / 4.0;
                assert!((points[v][0] - along(0)).abs() + (points[v][1] - along(1)).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_flat_tile_is_refused() {
        let error = ENTRY.run(None, &given(&[("tile", "0 0;1 1;2 2")]), 0).unwrap_err().to_string();
        assert_eq!(error, "'drum' cannot do this: the corners of the tile lie on a line; give three that do not");
        let error = ENTRY.run(None, &given(&[("tile", "0 0;1 1")]), 0).unwrap_err().to_string();
        assert!(error.ends_with("it must be three corners of two finite coordinates, as in '2 0;0 2;0 0'"));
    }
}
