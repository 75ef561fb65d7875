//! How far rounding may have moved a correct row: the recheck's own allowance.

use crate::domain::{Domain, Surface, geometry};
use crate::linalg::Csr;

use super::terms::U;

/// Constructions that are not ours, or start from edge lengths, round this many times more than the sum of a row does.
const OPERATIONS: f64 = 16.0;

/// A factor between this allowance and that of a checker: a true certificate is never refused, a spoilt matrix is.
const SLACK: f64 = 16.0;

/// No rounding excuses a residual beyond this part of the row scale, however thin the triangles.
const LARGEST: f64 = 1.0 / 1024.0;

/// From here on a face may be exactly degenerate, and rounding is what keeps its area from zero.
const DEGENERATE: f64 = 1e20;

/// For each vertex an absolute allowance for the entries and sums of its row:
/// `16 · (m_i + 16) · u · κ_i · s_i`, at most `s_i / 1024`, with m_i stored entries and `s_i = Σ_k |A_ik|`.
///
/// κ is the squared condition `1 + c²` of the worst face near the vertex, `c = Σ ℓ²/(4 area)`: in a triangle the sum of the
/// three cotangents. A cotangent from coordinates has an error of `8u/sin²θ = 8u (1 + cot²θ)`; one from edge lengths, through
/// Heron's formula, a relative error of the order `u c²`. Both are below κ. "Near" means within two rings, because a
/// construction may have flipped edges in between, and anywhere at all for a row that reaches beyond the edges at its vertex.
pub(super) struct Leeway {
    /// The allowances.
    pub rows: Vec<f64>,
}

impl Leeway {
    /// For a matrix on a domain.
    pub fn of(domain: &Domain, matrix: &Csr) -> Self {
        let near = conditions(domain);
        let everywhere = near.iter().copied().fold(1.0, f64::max);
        let mut neighbours = vec![Vec::new(); domain.vertex_count()];
        for &[a, b] in domain.edges() {
            neighbours[a].push(b);
            neighbours[b].push(a);
        }
        let allowance = |i: usize| {
            let (mut stored, mut scale, mut far) = (0.0, 0.0, false);
            for (j, v) in matrix.row(i).filter(|(_, v)| **v != 0.0) {
                stored += 1.0;
                scale += v.abs();
                far |= j != i && !neighbours[i].contains(&j);
            }
            let condition = if far { everywhere } else { near[i] };
            (SLACK * (stored + OPERATIONS) * U * condition).min(LARGEST) * scale
        };
        Leeway { rows: (0..matrix.rows()).map(allowance).collect() }
    }

    /// The allowance for the difference of `A_ij` and `A_ji`: each is rounded as its own row is.
    pub fn pair(&self, i: usize, j: usize) -> f64 {
        self.rows[i] + self.rows[j]
    }
}

/// For each vertex the worst `1 + c²` of the faces within two rings; 1 where there are no faces.
fn conditions(domain: &Domain) -> Vec<f64> {
    let mut worst = vec![1.0_f64; domain.vertex_count()];
    match domain {
        Domain::Surface(surface) => {
            for face in surface.faces() {
                let c = condition(surface, face);
                face.iter().for_each(|&v| worst[v] = worst[v].max(c));
            }
        }
        Domain::Volume(volume) => {
            for tetrahedron in volume.tetrahedra() {
                let c = thinness(volume.positions(), tetrahedron);
                tetrahedron.iter().for_each(|&v| worst[v] = worst[v].max(c));
            }
        }
        Domain::Graph(_) | Domain::Points(_) => return worst,
    }
    let mut spread = worst.clone();
    for &[a, b] in domain.edges() {
        spread[a] = spread[a].max(worst[b]);
        spread[b] = spread[b].max(worst[a]);
    }
    spread
}

/// `1 + (Σ ℓ²/(4 area))²` of a face; 1 for a degenerate one, which constructions leave out.
fn condition(surface: &Surface, face: &[usize]) -> f64 {
    let sides = (0..face.len()).map(|k| surface.point(face[(k + 1) % face.len()]) - surface.point(face[k]));
    let size = sides.clone().fold(0.0_f64, |m, e| m.max(e.amax()));
    let lengths: f64 = sides.map(|e| (e / size).norm_squared()).sum();
    let origin = surface.point(face[0]);
    let spokes = |w: &[usize]| ((surface.point(w[0]) - origin) / size).cross(&((surface.point(w[1]) - origin) / size));
    let doubled = face[1..].windows(2).map(spokes).sum::<geometry::Vec3>().norm();
    let condition = bounded(lengths / (2.0 * doubled));
    let at = |v: usize| surface.positions()[v];
    let degenerate = || face[1..].windows(2).all(|w| geometry::collinear(at(face[0]), at(w[0]), at(w[1])));
    if condition > DEGENERATE && degenerate() { 1.0 } else { condition }
}

/// `1 + (ℓ³/6V)²` of a tetrahedron with longest edge ℓ; 1 for a degenerate one.
fn thinness(positions: &[[f64; 3]], corners: &[usize; 4]) -> f64 {
    let at = |v: usize| geometry::Vec3::from(positions[v]);
    let sides = [1, 2, 3].map(|k| at(corners[k]) - at(corners[0]));
    let size = sides.iter().fold(0.0_f64, |m, e| m.max(e.norm()));
    let [a, b, c] = sides.map(|e| e / size);
    let condition = bounded(1.0 / a.cross(&b).dot(&c).abs());
    let [p, q, r, s] = corners.map(|v| positions[v]);
    if condition > DEGENERATE && geometry::orient3d(p, q, r, s).is_eq() { 1.0 } else { condition }
}

fn bounded(condition: f64) -> f64 {
    let square = 1.0 + condition * condition;
    if square.is_finite() { square } else { f64::MAX }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_right_isosceles_triangle_has_the_sum_of_its_cotangents_as_condition() {
        // cot 90° + 2 cot 45° = 2.
        let s = Surface::planar(&[[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]], &[[0, 1, 2]]).unwrap();
        assert!((condition(&s, &[0, 1, 2]) - 5.0).abs() < 1e-14);
    }

    #[test]
    fn no_sliver_excuses_more_than_a_thousandth_of_the_row() {
        let s = Surface::planar(&[[0.0, 0.0], [1.0, 0.0], [0.5, 1e-9]], &[[0, 1, 2]]).unwrap();
        let l = Csr::from_triplets(3, 3, &[(0, 0, 3.0), (0, 1, -1.0)]);
        assert_eq!(Leeway::of(&s.into(), &l).rows[0], 4.0 / 1024.0);
    }
}
