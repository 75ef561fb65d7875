//! Drums glued from seven tiles, exactly: their matrices as sums over tiles, and the matrices that take functions from one drum to
//! the other.
//!
//! # Transplantation
//! A_k and B_k are the involutions of side k of the two gluings as matrices of order 7. Under Neumann's condition, functions u_1, …, u_7
//! on the tiles fit together where `u = A_k u` on each side k; under Dirichlet's they vanish on the boundary, and there a tile that is its
//! own neighbour counts as −1: `u = −u`. A matrix T with `T A_k = B_k T` for all k takes functions on A to functions on B, and its
//! transpose takes them back. A bilinear form that is a sum over congruent tiles then has `b_B(Tu, v) = b_A(u, Tᵀv)`.
//!
//! # Lifting to vertices
//! With R the matrix of T on the values at vertices and S that of Tᵀ, transposed, this says `X_B R = S X_A` for the stiffness and for every
//! mass that is a sum over tiles. With c(v) the number of tiles at a vertex, `c_B R = S c_A`: summing T over the tiles at a vertex of
//! B and at one of A gives both sides. Under Dirichlet's condition the rows that are left belong to vertices inside a tile or inside
//! a side that two tiles share, and c depends on nothing but the place in the tile. So there S = R.

use std::collections::BTreeMap;

use crate::domain::Surface;
use crate::generate::drum::{DRUMS, Drum, Gluing, cut, lattice};
use crate::laplacian::cotan::stiffness_in_plane;
use crate::laplacian::mass;
use crate::linalg::{Csr, Dense};
use crate::operator::MassKind;
use crate::property::evidence::Condition;
use crate::scalar::{Rational, Scalar};

/// The corners of a tile, whole numbers.
pub type Tile = [[i64; 2]; 3];

/// `T A_k = B_k T` for the three sides k: a basis of its solutions T over the rationals.
pub fn transplantations([a, b]: [&Gluing; 2], condition: Condition) -> Vec<Dense<Rational>> {
    let entry = |gluing: &Gluing, side: usize, s: usize, t: usize| {
        let fixed = gluing[side][s] == s && condition == Condition::Dirichlet;
        Rational::from(if gluing[side][s] != t {
            0
        } else if fixed {
            -1
        } else {
            1
        })
    };
    // One equation for each side and each place (t, s); the unknown T[i, j] is number 7i + j.
    let coefficient = |equation: usize, unknown: usize| {
        let (side, t, s) = (equation / 49, equation / 7 % 7, equation % 7);
        let (i, j) = (unknown / 7, unknown % 7);
        let left = if i == t { entry(a, side, j, s) } else { Rational::ZERO };
        let right = if j == s { entry(b, side, t, i) } else { Rational::ZERO };
        left - right
    };
    let conditions = Dense::from_fn(3 * 49, 49, coefficient);
    conditions.kernel().into_iter().map(|x| Dense::from_fn(7, 7, |i, j| x[7 * i + j].clone())).collect()
}

/// A solution that is invertible, with small whole combinations of the basis tried in turn.
pub fn invertible(basis: &[Dense<Rational>]) -> Option<Dense<Rational>> {
    let combine = |x: i64, y: i64| {
        let at = |k: usize, i, j| basis.get(k).map_or(Rational::ZERO, |t| t.at(i, j).clone());
        Dense::from_fn(7, 7, |i, j| Rational::from(x) * at(0, i, j) + Rational::from(y) * at(1, i, j))
    };
    let candidates = [(1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (1, 2)].map(|(x, y)| combine(x, y));
    candidates.into_iter().find(|t| t.rank() == 7)
}

/// A sparse matrix by its entries that are not zero.
pub type Entries = BTreeMap<(usize, usize), Rational>;

/// Both drums with the same tile, and the rows that a boundary condition leaves.
pub struct Pair {
    /// The drums.
    pub drums: [Drum; 2],
    /// The vertices whose rows are kept, ascending.
    pub kept: [Vec<usize>; 2],
    tile: Surface,
}

impl Pair {
    /// The drums with sides in `parts` parts; `None` where the tile is flat.
    pub fn new(tile: Tile, parts: usize, condition: Condition) -> Option<Self> {
        let drums = [0, 1].map(|k| Drum::new(&DRUMS[k], tile.map(|p| p.map(|x| x as f64)), parts));
        let kept = [0, 1].map(|k| {
            let mut on_boundary = vec![false; drums[k].vertex_count()];
            for (side, exchange) in DRUMS[k].iter().enumerate() {
                for s in (0..7).filter(|&s| exchange[s] == s) {
                    let here = drums[k].vertices[s].iter().zip(lattice(parts)).filter(|(_, at)| at[side] == 0);
                    here.for_each(|(&v, _)| on_boundary[v] = true);
                }
            }
            (0..on_boundary.len()).filter(|&v| condition == Condition::Neumann || !on_boundary[v]).collect()
        });
        // Whole coordinates: a tile n times as large.
        let place =
            |at: [usize; 3]| [0, 1].map(|axis| (0..3).map(|k| at[k] as i64 * tile[k][axis]).sum::<i64>() as f64);
        let points: Vec<[f64; 2]> = lattice(parts).into_iter().map(place).collect();
        let tile = Surface::planar(&points, &cut(parts)).ok()?;
        stiffness_in_plane::<Rational>(&tile)?;
        Some(Pair { drums, kept, tile })
    }

    /// Stiffness (no kind) or mass of both drums, of the rows that are kept: the matrix of the tile, summed over the tiles. The mass
    /// is that of the tile whose mesh has the lattice as vertices, n times as large as the one named.
    pub fn matrices(&self, kind: Option<MassKind>) -> Option<[Entries; 2]> {
        let of_tile: Csr<Rational> = match kind {
            None => stiffness_in_plane(&self.tile)?,
            Some(kind) => mass::in_plane(&self.tile, kind)?,
        };
        Some([0, 1].map(|k| {
            let mut sum = Entries::new();
            if kind == Some(MassKind::Unit) {
                sum.extend(self.kept[k].iter().map(|&v| ((v, v), Rational::ONE)));
                return sum;
            }
            for vertices in &self.drums[k].vertices {
                for (i, j, value) in of_tile.entries() {
                    let entry = sum.entry((vertices[i], vertices[j])).or_insert(Rational::ZERO);
                    *entry = (entry.clone() + value.clone()).reduced();
                }
            }
            let keeps = |v: usize| self.kept[k].binary_search(&v).is_ok();
            sum.retain(|(i, j), value| keeps(*i) && keeps(*j) && *value != Rational::ZERO);
            sum
        }))
    }

    /// R: the values at the vertices kept of drum `to`, from those of the other one; `None` where tiles that share a vertex
    /// disagree about them.
    pub fn lifted(&self, t: &Dense<Rational>, to: usize) -> Option<Entries> {
        let from = 1 - to;
        let mut lifted: Entries = BTreeMap::new();
        let mut seen: BTreeMap<usize, Entries> = BTreeMap::new();
        for (tile, vertices) in self.drums[to].vertices.iter().enumerate() {
            for (local, &v) in vertices.iter().enumerate().filter(|(_, v)| self.kept[to].binary_search(v).is_ok()) {
                let mut row = Entries::new();
                for (s, sources) in self.drums[from].vertices.iter().enumerate() {
                    let w = sources[local];
                    if self.kept[from].binary_search(&w).is_ok() {
                        let entry = row.entry((v, w)).or_insert(Rational::ZERO);
                        *entry = entry.clone() + t.at(tile, s).clone();
                    }
                }
                row.retain(|_, value| *value != Rational::ZERO);
                if seen.get(&v).is_some_and(|known| *known != row) {
                    return None;
                }
                lifted.extend(row.clone());
                seen.insert(v, row);
            }
        }
        Some(lifted)
    }

    /// The matrix over the vertices kept, dense.
    pub fn dense(&self, entries: &Entries, k: usize) -> Dense<Rational> {
        let rows = &self.kept[k];
        Dense::from_fn(rows.len(), rows.len(), |i, j| {
            entries.get(&(rows[i], rows[j])).cloned().unwrap_or(Rational::ZERO)
        })
    }
}

/// A side of a polygon: its squared length, and the dot product with the next one.
pub type Side = [Rational; 2];

/// The sides of the boundary polygon in their order, corners with a straight angle left out. An isometry keeps them, up to where
/// the order starts and its sense.
pub fn outline(gluing: &Gluing, tile: Tile) -> Vec<Side> {
    let vertices = Drum::new(gluing, tile.map(|p| p.map(|x| x as f64)), 1).vertices;
    // The lattice of one part has the corners 2, 1, 0 in this order.
    let vertex = |s: usize, corner: usize| vertices[s][2 - corner];
    let mut tiles = vec![(tile.map(|p| p.map(Rational::from)), false)];
    for t in 1..7 {
        let glued = (0..t).flat_map(|s| (0..3).map(move |side| (s, side))).find(|&(s, side)| gluing[side][s] == t);
        let (s, side) = glued.unwrap_or((0, 0));
        let (mut corners, mirrored) = tiles[s].clone();
        corners[side] = reflected(&corners[side], &corners[(side + 1) % 3], &corners[(side + 2) % 3]);
        tiles.push((corners, !mirrored));
    }
    let mut next: BTreeMap<usize, (usize, [Rational; 2])> = BTreeMap::new();
    for (side, exchange) in gluing.iter().enumerate() {
        for s in (0..7).filter(|&s| exchange[s] == s) {
            let (corners, mirrored) = &tiles[s];
            let (from, to) = if *mirrored { (side + 2, side + 1) } else { (side + 1, side + 2) };
            let [p, q] = [&corners[from % 3], &corners[to % 3]];
            next.insert(vertex(s, from % 3), (vertex(s, to % 3), minus(q, p)));
        }
    }
    let mut sides: Vec<[Rational; 2]> = Vec::new();
    let start = next.keys().next().copied().unwrap_or(0);
    let mut at = start;
    while let Some((to, side)) = next.remove(&at) {
        sides.push(side);
        at = to;
    }
    merged(sides)
}

/// Consecutive sides, those that go straight on taken together.
fn merged(mut sides: Vec<[Rational; 2]>) -> Vec<Side> {
    let straight = |u: &[Rational; 2], v: &[Rational; 2]| {
        u[0].clone() * v[1].clone() == u[1].clone() * v[0].clone() && dot(u, v).cmp_zero().is_gt()
    };
    if let Some(first) = (0..sides.len()).find(|&k| !straight(&sides[(k + sides.len() - 1) % sides.len()], &sides[k])) {
        sides.rotate_left(first);
    }
    let mut polygon: Vec<[Rational; 2]> = Vec::new();
    for side in sides {
        match polygon.last_mut().filter(|last| straight(last, &side)) {
            Some(last) => *last = [0, 1].map(|axis| last[axis].clone() + side[axis].clone()),
            None => polygon.push(side),
        }
    }
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(side, next)| [dot(side, side).reduced(), dot(side, next).reduced()]).collect()
}

/// Whether two polygons have the same sides, up to where they start and their sense.
pub fn same_outline(a: &[Side], b: &[Side]) -> bool {
    let n = a.len();
    // Run backwards, the corner after a side is the one that was before it.
    let back = |k: usize| [&b[(2 * n - k) % n][0], &b[(2 * n - k - 1) % n][1]];
    let forth = |k: usize| [&b[k % n][0], &b[k % n][1]];
    let same = |side: &Side, other: [&Rational; 2]| side[0] == *other[0] && side[1] == *other[1];
    let turned = |start: usize| {
        (0..n).all(|k| same(&a[k], forth(start + k))) || (0..n).all(|k| same(&a[k], back((k + start) % n)))
    };
    n == b.len() && (n == 0 || (0..n).any(turned))
}

fn minus(p: &[Rational; 2], q: &[Rational; 2]) -> [Rational; 2] {
    [0, 1].map(|axis| (p[axis].clone() - q[axis].clone()).reduced())
}

fn dot(u: &[Rational; 2], v: &[Rational; 2]) -> Rational {
    u[0].clone() * v[0].clone() + u[1].clone() * v[1].clone()
}

/// The mirror image of p in the line through a and b.
fn reflected(p: &[Rational; 2], a: &[Rational; 2], b: &[Rational; 2]) -> [Rational; 2] {
    let along = minus(b, a);
    let normal = [-along[1].clone(), along[0].clone()];
    let twice = Rational::from(2) * dot(&minus(p, a), &normal) / dot(&normal, &normal);
    [0, 1].map(|axis| (p[axis].clone() - twice.clone() * normal[axis].clone()).reduced())
}

/// The transpose.
pub fn transposed(a: &Entries) -> Entries {
    a.iter().map(|(&(i, j), value)| ((j, i), value.clone())).collect()
}

/// The product of two sparse matrices, entries that are zero left out.
pub fn product(a: &Entries, b: &Entries) -> Entries {
    let mut product = Entries::new();
    for (&(i, k), x) in a {
        for (&(_, j), y) in b.range((k, 0)..=(k, usize::MAX)) {
            let entry = product.entry((i, j)).or_insert(Rational::ZERO);
            *entry = (entry.clone() + x.clone() * y.clone()).reduced();
        }
    }
    product.retain(|_, value| *value != Rational::ZERO);
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_over_tiles_is_the_matrix_of_the_whole_drum() {
        // Right isosceles tiles with whole corners: the drum's own coordinates are exact.
        for parts in [1, 2, 4] {
            let pair = Pair::new([[2, 0], [0, 2], [0, 0]], parts, Condition::Neumann).unwrap();
            let stiffness = pair.matrices(None).unwrap();
            let consistent = pair.matrices(Some(MassKind::Consistent)).unwrap();
            for k in [0, 1] {
                let surface = pair.drums[k].surface().unwrap();
                let whole = Dense::from_csr(&stiffness_in_plane::<Rational>(&surface).unwrap());
                assert_eq!(pair.dense(&stiffness[k], k), whole);
                let scale = Rational::from((parts * parts) as u64);
                let of_surface = mass::in_plane::<Rational>(&surface, MassKind::Consistent).unwrap();
                let scaled = Dense::from_csr(&of_surface.map(|_, _, m| m.clone() * scale.clone()));
                assert_eq!(pair.dense(&consistent[k], k), scaled);
                let dirichlet = Pair::new([[2, 0], [0, 2], [0, 0]], parts, Condition::Dirichlet).unwrap();
                let inside = surface.topology().boundary_vertices();
                let expected: Vec<usize> = (0..inside.len()).filter(|&v| !inside[v]).collect();
                assert_eq!(dirichlet.kept[k], expected);
            }
        }
    }

    #[test]
    fn the_transplantations_form_a_plane_with_invertible_members() {
        for condition in [Condition::Dirichlet, Condition::Neumann] {
            let basis = transplantations([&DRUMS[0], &DRUMS[1]], condition);
            assert_eq!(basis.len(), 2);
            let t = invertible(&basis).unwrap();
            assert!((0..7).all(|i| (0..7).all(|j| t.at(i, j).clone().floor() == t.at(i, j).clone().ceil())));
        }
        // From a drum to itself, the identity is one.
        let own = transplantations([&DRUMS[0], &DRUMS[0]], Condition::Neumann);
        assert!(!own.is_empty());
    }

    #[test]
    fn outlines_of_right_isosceles_drums_are_two_octagons() {
        let found = DRUMS.map(|gluing| outline(&gluing, [[2, 0], [0, 2], [0, 0]]));
        for (sides, mut expected) in found.iter().zip([[4, 4, 4, 4, 8, 4, 4, 32], [4, 16, 4, 8, 8, 4, 4, 8]]) {
            let mut lengths: Vec<Rational> = sides.iter().map(|s| s[0].clone()).collect();
            lengths.sort();
            expected.sort_unstable();
            assert_eq!(lengths, expected.map(Rational::from));
        }
        assert!(!same_outline(&found[0], &found[1]));
        // Started elsewhere, and as its mirror image.
        let tile = [[2, 0], [0, 2], [0, 0]];
        let mirrored = outline(&DRUMS[1], tile.map(|[x, y]: [i64; 2]| [-x, y]));
        let mut turned = found[1].clone();
        turned.rotate_left(3);
        assert!(same_outline(&turned, &found[1]) && same_outline(&mirrored, &found[1]));
        let reversed: Vec<Side> =
            (0..8).rev().map(|k| [found[1][k][0].clone(), found[1][(k + 7) % 8][1].clone()]).collect();
        assert!(same_outline(&reversed, &found[1]));
    }

    #[test]
    fn a_matrix_that_is_no_transplantation_tears_functions_apart() {
        let pair = Pair::new([[2, 0], [0, 2], [0, 0]], 2, Condition::Neumann).unwrap();
        let mut t = invertible(&transplantations([&DRUMS[0], &DRUMS[1]], Condition::Neumann)).unwrap();
        assert!(pair.lifted(&t, 1).is_some());
        t.add_to(0, 0, Rational::ONE);
        assert!(pair.lifted(&t, 1).is_none());
    }
}
