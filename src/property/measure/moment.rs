//! First moments `Σ_j L_ij (x_j − x_i)` of a row, and the vertices at which they mean something: LIN and FLUX.

use std::collections::BTreeMap;

use super::compensated::Sum;
use super::condition::distance;
use super::tolerance::Threshold;
use crate::domain::geometry::{collinear, orient2d, orient3d};
use crate::domain::{Surface, Volume};
use crate::property::evidence::{Evidence, Statement};
use crate::property::{Trial, excerpt};

/// The moment of row i along an axis, less `expected`, in twice the working precision. Signed.
pub(crate) fn moment(trial: &Trial, positions: &[[f64; 3]], i: usize, axis: usize) -> Sum {
    let mut sum = Sum::default();
    for (j, &v) in trial.operator.stiffness().row(i) {
        sum.add_scaled_difference(v, positions[j][axis], positions[i][axis]);
    }
    sum
}

/// What moments of row i are measured against; `more` is the magnitude of what is subtracted.
pub(crate) fn threshold(trial: &Trial, positions: &[[f64; 3]], i: usize, more: f64) -> Threshold {
    let length = |j: usize| distance(positions[i], positions[j]);
    let size: f64 = trial.operator.stiffness().row(i).map(|(j, v)| v.abs() * length(j)).sum();
    trial.scales().combination(i, size + more)
}

/// The evidence of a moment that is not what it should be.
pub(crate) fn witness(
    trial: &Trial,
    (i, axis): (usize, usize),
    axes: [usize; 2],
    boundary: Option<[usize; 2]>,
    threshold: f64,
) -> Evidence {
    let stencil = trial.operator.stiffness().row(i).map(|(j, _)| j).chain([i]).chain(boundary.into_iter().flatten());
    let excerpt = excerpt::of_rows(trial, [i]).with_positions(trial, stencil);
    Evidence::new(Statement::Moment { i, axis, axes, boundary, threshold }, excerpt)
}

/// The axes of a planar surface in the order that makes its faces counter-clockwise.
pub(crate) fn oriented_axes(surface: &Surface) -> Option<[usize; 2]> {
    let [a, b] = surface.plane()?;
    let mut turns = (0..surface.faces().len()).flat_map(|f| turns(surface, f, [a, b]));
    let clockwise = turns.find(|t| t.is_ne()).is_some_and(|t| t.is_lt());
    Some(if clockwise { [b, a] } else { [a, b] })
}

/// The exact orientations in a coordinate plane of the triangles that fan out from the first corner of a face.
fn turns(surface: &Surface, face: usize, axes: [usize; 2]) -> impl Iterator<Item = std::cmp::Ordering> + '_ {
    let at = move |v: usize| axes.map(|a| surface.positions()[v][a]);
    let corners = &surface.faces()[face];
    corners[1..].windows(2).map(move |w| orient2d(at(corners[0]), at(w[0]), at(w[1])))
}

/// A triangle of the fan of a face that is not degenerate, if there is one.
fn proper_triangle(surface: &Surface, face: usize) -> Option<[usize; 3]> {
    let corners = &surface.faces()[face];
    let at = |v: usize| surface.positions()[v];
    let fan = corners[1..].windows(2).map(|w| [corners[0], w[0], w[1]]);
    fan.into_iter().find(|&[a, b, c]| !collinear(at(a), at(b), at(c)))
}

/// Whether faces are around a vertex as on a manifold, none of them degenerate: `boundary_edges` edges at the vertex have one
/// face, all others two.
pub(crate) fn is_proper_star(trial: &Trial, surface: &Surface, vertex: usize, boundary_edges: usize) -> bool {
    let topology = surface.topology();
    let star = topology.star(vertex);
    let proper = || match surface.is_triangulated() {
        true => !trial.scales().geometry().stars[vertex].degenerate,
        false => star.iter().all(|c| proper_triangle(surface, c.face()).is_some()),
    };
    let (mut all, mut ones, mut twos) = (0, 0, 0);
    for edge in trial.stencil().edges(vertex) {
        all += 1;
        ones += usize::from(topology.sides(edge).len() == 1);
        twos += usize::from(topology.sides(edge).len() == 2);
    }
    !star.is_empty() && ones == boundary_edges && ones + twos == all && proper()
}

/// Whether the star of a vertex lies unfolded in a plane, decided exactly: all its vertices are coplanar, and its faces have
/// the same orientation there.
pub(crate) fn is_flat_star(surface: &Surface, vertex: usize) -> bool {
    let star = surface.topology().star(vertex);
    let at = |v: usize| surface.positions()[v];
    let Some([a, b, c]) = star.first().and_then(|corner| proper_triangle(surface, corner.face())) else { return false };
    // Points of one coordinate plane are coplanar without a determinant, which would be zero the slow way.
    let level = |v: usize| (0..3).any(|k| [a, b, c].iter().all(|&w| at(w)[k] == at(v)[k]));
    let coplanar = |v: usize| [a, b, c].contains(&v) || level(v) || orient3d(at(a), at(b), at(c), at(v)).is_eq();
    if !star.iter().all(|corner| surface.faces()[corner.face()].iter().all(|&v| coplanar(v))) {
        return false;
    }
    let project = |axes: [usize; 2], v: usize| axes.map(|k| at(v)[k]);
    let faithful = |axes: &[usize; 2]| orient2d(project(*axes, a), project(*axes, b), project(*axes, c)).is_ne();
    let Some(axes) = [[0, 1], [1, 2], [2, 0]].into_iter().find(faithful) else { return false };
    let (mut left, mut right) = (false, false);
    for turn in star.iter().flat_map(|corner| turns(surface, corner.face(), axes)) {
        left |= turn.is_gt();
        right |= turn.is_lt();
    }
    !(left && right)
}

/// For each vertex of a volume, whether the tetrahedra around it are in place: none degenerate, and the two at each triangle
/// on opposite sides of it. Exact.
pub(crate) fn proper_balls(volume: &Volume) -> Vec<bool> {
    let at = |v: usize| volume.positions()[v];
    let mut proper = vec![false; volume.positions().len()];
    volume.tetrahedra().iter().flatten().for_each(|&v| proper[v] = true);
    let mut apexes: BTreeMap<[usize; 3], Vec<usize>> = BTreeMap::new();
    for tet in volume.tetrahedra() {
        let mut t = *tet;
        t.sort_unstable();
        let [a, b, c, d] = t;
        if orient3d(at(a), at(b), at(c), at(d)).is_eq() {
            t.iter().for_each(|&v| proper[v] = false);
        }
        for (triangle, apex) in [([b, c, d], a), ([a, c, d], b), ([a, b, d], c), ([a, b, c], d)] {
            apexes.entry(triangle).or_default().push(apex);
        }
    }
    for ([a, b, c], apexes) in apexes {
        let side = |v: usize| orient3d(at(a), at(b), at(c), at(v));
        let in_place = match apexes.as_slice() {
            [_] => true,
            [p, q] => side(*p) == side(*q).reverse(),
            _ => false,
        };
        if !in_place {
            [a, b, c].into_iter().for_each(|v| proper[v] = false);
        }
    }
    proper
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Csr;
    use crate::operator::{Operator, Provenance};

    fn fan(z: f64) -> Surface {
        let p = vec![[0.0, 0.0, z], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
        Surface::triangles(p, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]).unwrap()
    }

    fn is_proper(surface: Surface, vertex: usize, boundary_edges: usize) -> bool {
        let n = surface.positions().len();
        let domain = crate::Domain::from(surface);
        let operator = Operator::new(Csr::diagonal(&vec![1.0; n]), Provenance::default()).unwrap();
        let trial = Trial::new(&domain, &operator, 0).unwrap();
        is_proper_star(&trial, domain.as_surface().unwrap(), vertex, boundary_edges)
    }

    #[test]
    fn a_star_with_a_degenerate_or_a_third_face_is_not_proper() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.0]];
        let with = |face: [usize; 3]| Surface::planar(&square, &[[0, 1, 2], [0, 2, 3], face]).unwrap();
        assert!(is_proper(with([1, 4, 2]), 1, 2) && !is_proper(with([0, 1, 4]), 1, 2));
        assert!(!is_proper(with([0, 2, 4]), 0, 2) && !is_proper(with([0, 2, 4]), 0, 3));
        let pentagon = Surface::new(square.map(|[x, y]| [x, y, 0.0]).to_vec(), vec![vec![0, 1, 4, 2, 3]]).unwrap();
        assert!(is_proper(pentagon, 4, 2));
    }

    #[test]
    fn a_star_is_flat_until_its_centre_is_lifted_by_the_smallest_number() {
        assert!(is_flat_star(&fan(0.0), 0) && is_proper(fan(0.0), 0, 0));
        assert!(!is_flat_star(&fan(5e-324), 0));
        assert!(is_proper(fan(0.0), 1, 2) && !is_proper(fan(0.0), 1, 0));
    }

    #[test]
    fn a_folded_star_is_not_flat() {
        // The fourth neighbour is folded back over the first: the last two triangles turn the other way.
        let p = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.1, 0.5, 0.0]];
        let s = Surface::triangles(p, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]).unwrap();
        assert!(!is_flat_star(&s, 0));
        assert!(s.plane().is_none());
    }

    #[test]
    fn clockwise_faces_swap_the_axes() {
        let p = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(oriented_axes(&Surface::planar(&p, &[[0, 1, 2]]).unwrap()), Some([0, 1]));
        assert_eq!(oriented_axes(&Surface::planar(&p, &[[0, 2, 1]]).unwrap()), Some([1, 0]));
    }

    #[test]
    fn tetrahedra_on_the_same_side_of_their_common_triangle_are_not_in_place() {
        let volume = |z: f64| {
            let p = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.2, 0.2, 1.0], [0.2, 0.2, z]];
            Volume::new(p, vec![[0, 1, 2, 3], [0, 1, 2, 4]]).unwrap()
        };
        assert_eq!(proper_balls(&volume(-1.0)), [true; 5]);
        assert_eq!(proper_balls(&volume(2.0)), [false, false, false, true, true]);
    }
}
