//! The exact twins: for which operators of the catalogue the matrices of a planar mesh are rational, and the matrices.
//!
//! # Definition
//! On a planar mesh with `f64` coordinates the entries of `graph` and `weighted-graph` with unit or inverse squared weights,
//! `cotan`, `wachspress` and `three-point` with an even p are rational numbers, and so are all masses made from triangles. The twin
//! of an operator is built by the same formulas over [`Rational`] ([`Scalar`]).
//!
//! # Guarantees
//! A twin is the operator of the entry's definition without any rounding. `mean-value`, `three-point` with another p and inverse
//! lengths are irrational and have none; neither has `intrinsic-delaunay`, whose flips this module does not repeat.
//!
//! # Degenerate input
//! None where a face is no triangle or a degenerate one, or the mesh is not planar ([`Surface::plane`]).

use super::shape::Triangles;
use super::{Laplacian, cotan, mass, stiffness, three_point, wachspress};
use crate::domain::Surface;
use crate::linalg::Csr;
use crate::operator::MassKind;
use crate::parameter::Settings;
use crate::scalar::{Rational, Scalar};

/// The matrices of an operator on a planar mesh, exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Twin {
    /// The stiffness matrix.
    pub stiffness: Csr<Rational>,
    /// The mass matrix; none where it has none that is rational.
    pub mass: Option<Csr<Rational>>,
}

/// The exact twin of an operator with these settings; `None` where it has none.
pub fn twin(laplacian: &Laplacian, settings: &Settings, surface: &Surface) -> Option<Twin> {
    let triangles = Triangles::<Rational>::in_plane(surface)?;
    let stiffness = match laplacian.id {
        "graph" => by_length(&triangles, |_| Some(one()))?,
        "weighted-graph" => match settings.get("weights") {
            "unit" => by_length(&triangles, |_| Some(one()))?,
            "inverse-squared-length" => by_length(&triangles, |squared| Some(one() / squared.clone()))?,
            _ => return None,
        },
        "cotan" => cotan::stiffness_of(&triangles),
        "wachspress" => wachspress::stiffness_of(&triangles),
        "three-point" => three_point::stiffness_of(&triangles, even(settings.number("p"))?),
        _ => return None,
    };
    let kind = match laplacian.id {
        "graph" | "weighted-graph" => Some(MassKind::Unit),
        _ => MassKind::from_name(settings.get("mass")),
    };
    let n = surface.positions().len();
    let mass = kind.and_then(|k| mass::of_triangles(k, n, triangles.each().map(|(_, t, shape)| (t, shape))));
    Some(Twin { stiffness, mass })
}

/// The whole number that an even p is.
fn even(p: f64) -> Option<i32> {
    // The range of p is −8 to 8: nothing is cut off.
    (p % 2.0 == 0.0).then_some(p as i32)
}

fn one() -> Rational {
    Rational::half() + Rational::half()
}

/// The weight of an edge from its squared length.
fn by_length(triangles: &Triangles<Rational>, weight: impl Fn(&Rational) -> Option<Rational>) -> Option<Csr<Rational>> {
    let surface = triangles.surface();
    let of_edge = |(e, &ends): (usize, &[usize; 2])| {
        let w = triangles.beside(e).next().map(|flank| weight(&flank.shape.squared_lengths[flank.corners[2]]))??;
        Some((ends, [w.clone(), w]))
    };
    let weights = surface.topology().edges().iter().enumerate().map(of_edge).collect::<Option<Vec<_>>>()?;
    Some(stiffness::from_weights(surface.positions().len(), &weights))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Domain;
    use crate::laplacian::{ALL, find};
    use std::collections::BTreeMap;

    fn mesh() -> Surface {
        let points = [[0.0, 0.0], [4.0, 0.5], [3.5, 3.0], [-0.5, 2.0], [1.75, 1.25]];
        Surface::planar(&points, &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]).unwrap()
    }

    fn given(text: &str) -> BTreeMap<String, String> {
        let pairs = text.split(',').filter(|s| !s.is_empty()).map(|s| s.split_once('=').unwrap());
        pairs.map(|(k, v)| (k.to_string(), v.to_string())).collect()
    }

    #[test]
    fn a_twin_is_the_operator_without_its_rounding() {
        let mut twins = 0;
        for (id, settings) in [
            ("graph", ""),
            ("weighted-graph", "weights=unit"),
            ("weighted-graph", "weights=inverse-squared-length"),
            ("cotan", ""),
            ("cotan", "mass=mixed"),
            ("cotan", "mass=voronoi"),
            ("cotan", "mass=consistent"),
            ("cotan", "mass=unit"),
            ("wachspress", ""),
            ("three-point", "p=-2"),
            ("three-point", "p=0"),
            ("three-point", "p=2"),
            ("three-point", "p=4"),
        ] {
            let (entry, given) = (find(id).unwrap(), given(settings));
            let exact = twin(entry, &entry.check(&given).unwrap(), &mesh()).unwrap();
            let rounded = entry.build(&Domain::from(mesh()), &given).unwrap();
            let size = rounded.stiffness().row_scales().into_iter().fold(0.0, f64::max);
            for (i, j, v) in exact.stiffness.entries() {
                let difference = (Scalar::approximate(v) - rounded.stiffness().at(i, j)).abs();
                assert!(difference <= 64.0 * f64::EPSILON * size, "{id} {settings} at ({i}, {j})");
            }
            let mass = exact.mass.unwrap();
            for (i, j, v) in mass.entries() {
                let found = rounded.mass().unwrap().matrix().at(i, j);
                assert!((Scalar::approximate(v) - found).abs() <= 64.0 * f64::EPSILON * found.abs().max(1.0), "{id}");
            }
            twins += 1;
        }
        assert_eq!(twins, 13);
    }

    #[test]
    fn wachspress_and_cotan_are_members_of_the_family() {
        let of = |id: &str, settings: &str| {
            let entry = find(id).unwrap();
            twin(entry, &entry.check(&given(settings)).unwrap(), &mesh()).unwrap().stiffness
        };
        assert_eq!(of("three-point", "p=0"), of("wachspress", ""));
        let twice = of("cotan", "").map(|_, _, v| v.clone() + v.clone());
        assert_eq!(of("three-point", "p=2"), twice);
    }

    #[test]
    fn an_irrational_operator_has_no_twin_and_a_surface_in_space_none_at_all() {
        for (id, settings) in [
            ("mean-value", ""),
            ("three-point", "p=1"),
            ("three-point", "p=0.5"),
            ("weighted-graph", "weights=inverse-length"),
            ("intrinsic-delaunay", ""),
            ("normalized-graph", ""),
        ] {
            let entry = find(id).unwrap();
            assert_eq!(twin(entry, &entry.check(&given(settings)).unwrap(), &mesh()), None, "{id} {settings}");
        }
        let tent = Surface::triangles(
            vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0], [1.0, 1.0, 0.5]],
            &[[0, 1, 2], [1, 3, 2]],
        );
        let tent = tent.unwrap();
        for entry in ALL {
            let settings = entry.check(&BTreeMap::new()).unwrap();
            assert_eq!(twin(entry, &settings, &tent), None, "{}", entry.id);
        }
    }
}
