//! The mass matrices of a triangle mesh, summed from triangles.
//!
//! # Definition
//! A is the area of a triangle with corners i, j, k.
//!
//! | kind | share of corner i | beside |
//! | --- | --- | --- |
//! | consistent | A/6 | `M_ij` += A/12 |
//! | barycentric | A/3 | |
//! | voronoi | (ℓ_ij² cot_k + ℓ_ik² cot_j)/8: the part of the triangle nearer to i, signed where the circumcentre is outside | |
//! | mixed | as voronoi; A/2 at an obtuse corner and A/4 at the two others | |
//! | unit | none: one for each vertex | |
//!
//! # Guarantees
//! The total of every kind but `unit` is the area. Consistent, barycentric and mixed masses are positive (of a triangle, a
//! mixed share lies between A/4 and A/2), and so is voronoi where every interior edge is Delaunay and no corner opposite the
//! boundary is obtuse. A vertex without triangles has mass zero.
//!
//! # References
//! \[meyer2003\] section 3 for `mixed`: the obtuse cases are theirs, A/2 and A/4.

use std::cmp::Ordering;

use super::BuildError;
use super::shape::{Shape, Triangles};
use super::stiffness::check_finite;
use crate::domain::Surface;
use crate::domain::topology::Corner;
use crate::linalg::{Csr, parallel};
use crate::operator::{Mass, MassKind};
use crate::scalar::Scalar;

/// The kinds of mass that a triangle mesh has, by name.
pub const KINDS: &[&str] = &["barycentric", "voronoi", "mixed", "consistent", "unit"];

/// The mass matrix of some triangles over any scalar; `None` for a kind that is not made from triangles.
pub fn of_triangles<S: Scalar>(
    kind: MassKind,
    vertices: usize,
    triangles: impl Iterator<Item = ([usize; 3], Shape<S>)>,
) -> Option<Csr<S>> {
    match kind {
        MassKind::Consistent => Some(consistent(vertices, triangles)),
        MassKind::Barycentric => Some(lumped(vertices, triangles, |shape| thirds(shape))),
        MassKind::Voronoi => Some(lumped(vertices, triangles, |shape| circumcentric(shape))),
        MassKind::Mixed => Some(lumped(vertices, triangles, |shape| mixed(shape))),
        MassKind::Unit => Some(Csr::diagonal(&vec![number(1.0); vertices])),
        MassKind::Degree | MassKind::Given => None,
    }
}

/// The exact mass matrix of a planar mesh; `None` unless all faces are triangles, none degenerate, the mesh planar, and
/// the kind one that is made from triangles.
pub fn in_plane<S: Scalar>(surface: &Surface, kind: MassKind) -> Option<Csr<S>> {
    let triangles = Triangles::<S>::in_plane(surface)?;
    of_triangles(kind, surface.positions().len(), triangles.each().map(|(_, t, shape)| (t, shape)))
}

/// The mass matrix with this name, checked.
///
/// # Errors
/// An area that is not a normal number, an entry that is not finite.
pub(super) fn build(
    laplacian: &'static str,
    name: &str,
    vertices: usize,
    triangles: impl Iterator<Item = ([usize; 3], Shape<f64>)> + Clone,
) -> Result<Mass, BuildError> {
    // The name was checked against `KINDS`.
    let kind = MassKind::from_name(name).unwrap_or(MassKind::Unit);
    if let (Some(([i, j, _], shape)), true) =
        (triangles.clone().find(|(_, shape)| !shape.doubled_area.is_normal()), kind != MassKind::Unit)
    {
        return Err(BuildError::NotFinite { laplacian, i, j, value: format!("area {:e}", shape.doubled_area) });
    }
    let matrix = of_triangles(kind, vertices, triangles).unwrap_or_else(|| Csr::diagonal(&vec![1.0; vertices]));
    check_finite(laplacian, &matrix)?;
    Ok(Mass::full(kind, matrix))
}

/// The barycentric mass of triangles of which no more than corners and twice the areas are known, bit for bit that of [`build`].
///
/// # Errors
/// As [`build`].
pub(super) fn barycentric(
    laplacian: &'static str,
    vertices: usize,
    triangles: impl Iterator<Item = ([usize; 3], f64)>,
) -> Result<Mass, BuildError> {
    let mut diagonal = vec![0.0; vertices];
    for (corners, doubled_area) in triangles {
        if !doubled_area.is_normal() {
            let [i, j, _] = corners;
            return Err(BuildError::NotFinite { laplacian, i, j, value: format!("area {doubled_area:e}") });
        }
        corners.into_iter().for_each(|v| diagonal[v] += doubled_area / 6.0);
    }
    let mass = Mass::of_diagonal(MassKind::Barycentric, diagonal);
    check_finite(laplacian, mass.matrix())?;
    Ok(mass)
}

/// The mass matrix with this name of the proper triangles of a surface, bit for bit that of [`build`]; a diagonal one is
/// gathered vertex by vertex over the faces around it, in parallel.
///
/// # Errors
/// As [`build`].
pub(super) fn of_surface(laplacian: &'static str, name: &str, triangles: &Triangles) -> Result<Mass, BuildError> {
    let vertices = triangles.surface().positions().len();
    let each = triangles.each().map(|(_, corners, shape)| (corners, shape));
    let kind = MassKind::from_name(name).unwrap_or(MassKind::Unit);
    if !triangles.have_normal_areas() {
        return build(laplacian, name, vertices, each);
    }
    let shape = |c: &Corner| triangles.shape(c.face());
    let diagonal = match kind {
        // A third of the area asks for no more than the area.
        MassKind::Barycentric => gathered(triangles, |c| Some(triangles.angles(c.face())?[3] / 6.0)),
        MassKind::Voronoi => gathered(triangles, |c| Some(circumcentric(&shape(c)?)[c.corner()])),
        MassKind::Mixed => gathered(triangles, |c| Some(mixed(&shape(c)?)[c.corner()])),
        _ => return build(laplacian, name, vertices, each),
    };
    if diagonal.iter().all(|v| v.is_finite()) {
        return Ok(Mass::of_diagonal(kind, diagonal));
    }
    check_finite(laplacian, &Csr::diagonal(&diagonal))?;
    Ok(Mass::of_diagonal(kind, diagonal))
}

/// At each vertex the sum of the shares of the proper triangles around it, in face order.
fn gathered(triangles: &Triangles, share: impl Fn(&Corner) -> Option<f64> + Sync + Send) -> Vec<f64> {
    let topology = triangles.surface().topology();
    parallel::collect(triangles.surface().positions().len(), |v| {
        topology.star(v).iter().filter_map(&share).fold(0.0, |sum, share| sum + share)
    })
}

fn number<S: Scalar>(x: f64) -> S {
    // Whole numbers have an exact counterpart in every scalar.
    S::exactly(x).unwrap_or_else(S::zero)
}

fn consistent<S: Scalar>(n: usize, triangles: impl Iterator<Item = ([usize; 3], Shape<S>)>) -> Csr<S> {
    let mut entries = Vec::new();
    for (corners, shape) in triangles {
        let twelfth = shape.doubled_area.clone() / number(24.0);
        let sixth = shape.doubled_area.clone() / number(12.0);
        for (a, &i) in corners.iter().enumerate() {
            entries.extend(corners.iter().enumerate().map(|(b, &j)| {
                let share = if a == b { &sixth } else { &twelfth };
                (i, j, share.clone())
            }));
        }
    }
    Csr::from_triplets(n, n, &entries)
}

fn lumped<S: Scalar>(
    n: usize,
    triangles: impl Iterator<Item = ([usize; 3], Shape<S>)>,
    shares: impl Fn(&Shape<S>) -> [S; 3],
) -> Csr<S> {
    let mut diagonal = vec![S::zero(); n];
    for (corners, shape) in triangles {
        for (i, share) in corners.into_iter().zip(shares(&shape)) {
            diagonal[i] = diagonal[i].clone() + share;
        }
    }
    Csr::diagonal(&diagonal)
}

fn thirds<S: Scalar>(shape: &Shape<S>) -> [S; 3] {
    std::array::from_fn(|_| shape.doubled_area.clone() / number(6.0))
}

fn circumcentric<S: Scalar>(shape: &Shape<S>) -> [S; 3] {
    let side = |k: usize| shape.squared_lengths[k % 3].clone() * shape.cotangents[k % 3].clone();
    std::array::from_fn(|i| (side(i + 1) + side(i + 2)) / number(8.0))
}

fn mixed<S: Scalar>(shape: &Shape<S>) -> [S; 3] {
    match shape.cotangents.iter().position(|c| c.cmp_zero() == Ordering::Less) {
        None => circumcentric(shape),
        Some(obtuse) => {
            std::array::from_fn(|i| shape.doubled_area.clone() / number(if i == obtuse { 4.0 } else { 8.0 }))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Rational;

    const LUMPED: [MassKind; 3] = [MassKind::Barycentric, MassKind::Voronoi, MassKind::Mixed];

    fn triangle(p: [[f64; 2]; 3]) -> Shape<Rational> {
        let exact = p.map(|p| p.map(|x| Rational::exactly(x).unwrap()));
        Shape::in_plane([&exact[0], &exact[1], &exact[2]]).unwrap()
    }

    fn diagonal(kind: MassKind, shape: &Shape<Rational>) -> [f64; 3] {
        let m = of_triangles(kind, 3, [([0, 1, 2], shape.clone())].into_iter()).unwrap();
        std::array::from_fn(|i| Scalar::approximate(&m.at(i, i)))
    }

    #[test]
    fn the_right_isosceles_triangle_has_its_half_and_two_quarters() {
        let right = triangle([[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]]);
        assert_eq!(diagonal(MassKind::Voronoi, &right), [1.0, 0.5, 0.5]);
        assert_eq!(diagonal(MassKind::Mixed, &right), [1.0, 0.5, 0.5]);
    }

    #[test]
    fn beyond_the_right_angle_voronoi_turns_negative_and_mixed_does_not() {
        let flat = triangle([[0.0, 0.5], [-2.0, -0.5], [2.0, -0.5]]);
        // Area 2; base 4, height 1: ℓ² = 5, 5, 16, cot = −3/4 at the top and 2 at the base.
        assert_eq!(diagonal(MassKind::Voronoi, &flat), [2.5, -0.25, -0.25]);
        assert_eq!(diagonal(MassKind::Mixed, &flat), [1.0, 0.5, 0.5]);
    }

    #[test]
    fn the_total_of_each_kind_is_exactly_the_area() {
        for x in -8..8 {
            let t = triangle([[0.1, 0.2], [3.0, -0.7], [f64::from(x), 1.3]]);
            let area = t.doubled_area.clone() * Rational::half();
            for kind in LUMPED.into_iter().chain([MassKind::Consistent]) {
                let m = of_triangles(kind, 3, [([0, 1, 2], t.clone())].into_iter()).unwrap();
                let total = m.entries().fold(Rational::zero(), |sum, (_, _, v)| sum + v.clone());
                assert_eq!((total - area.clone()).cmp_zero(), Ordering::Equal, "{kind:?} {x}");
            }
        }
    }

    #[test]
    fn a_mixed_share_lies_between_a_quarter_and_a_half_of_the_triangle() {
        for k in 0..400 {
            let t = triangle([[-1.0, 0.0], [1.0, 0.0], [f64::from(k % 20) / 7.0, f64::from(k / 20 + 1) / 5.0]]);
            let area = 0.5 * Scalar::approximate(&t.doubled_area);
            for share in diagonal(MassKind::Mixed, &t) {
                assert!(share > 0.2499999 * area && share < 0.5000001 * area, "{k}: {share} of {area}");
            }
        }
    }
}
