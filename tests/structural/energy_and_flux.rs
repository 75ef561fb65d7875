//! ENERGY and FLUX.

use lapjury::domain::Surface;
use lapjury::linalg::Csr;
use lapjury::property::{Statement, Status};

use crate::meshes::*;
use crate::trials::*;

#[test]
fn the_energy_of_the_coordinates_is_the_area_in_the_plane_and_twice_the_area_in_space() {
    for s in [square(), star(7, |k| 1.0 + 0.2 * (k % 3) as f64), grid_surface(5, 0.25, 4), cube(), hills(5, 4)] {
        let found = verdict("ENERGY", s.clone(), &cotan(&s));
        assert_eq!(found.status(), Status::Holds, "{found:?}");
        assert!(found.margin.unwrap() < 0.5);
    }
}

#[test]
fn a_global_factor_is_found_and_named() {
    for s in [grid_surface(4, 0.2, 1), cube()] {
        for (factor, note) in [(2.0, "2.000"), (0.5, "0.500"), (-1.0, "-1.000")] {
            let found = verdict("ENERGY", s.clone(), &cotan(&s).map(|_, _, v| factor * v));
            assert_eq!(found.status(), Status::Fails);
            assert!(found.notes.iter().any(|n| n == &format!("the energy is {note} × the expected")), "{found:?}");
        }
        let slightly = cotan(&s).map(|_, _, v| (1.0 + 1e-11) * v);
        assert_eq!(status("ENERGY", s.clone(), &slightly), Status::Fails);
    }
}

#[test]
fn an_affine_stretch_is_found_although_every_other_row_property_holds() {
    let s = grid_surface(4, 0.2, 2);
    let stretched: Vec<[f64; 2]> = s.positions().iter().map(|p| [2.0 * p[0], p[1]]).collect();
    let triangles: Vec<[usize; 3]> = (0..s.faces().len()).map(|f| s.triangle(f).unwrap()).collect();
    let l = cotan(&planar(&stretched, &triangles));
    for id in ["LOC", "SYM", "NULL", "LIN"] {
        assert_eq!(status(id, s.clone(), &l), Status::Holds, "{id}");
    }
    assert_eq!(status("ENERGY", s.clone(), &l), Status::Fails);
    assert_eq!(status("FLUX", s, &l), Status::Fails);
}

#[test]
fn the_vertex_of_a_wrong_corner_is_named() {
    let s = hills(5, 3);
    let l = cotan(&s);
    let [i, j] = [14, 15];
    let spoilt = [(i, j, 0.3), (j, i, 0.3), (i, i, -0.3), (j, j, -0.3)]
        .into_iter()
        .fold(l, |l, (a, b, v)| with_added(&l, a, b, v));
    assert_eq!(status("NULL", s.clone(), &spoilt), Status::Holds);
    let found = verdict("ENERGY", s, &spoilt);
    let Statement::Energy { star, trace: true, .. } = statement(&found) else { panic!("{found:?}") };
    assert!([i, j].contains(star));
}

#[test]
fn a_mesh_far_from_the_origin_is_judged_by_its_shape() {
    // Coordinates are multiples of 2^-20, so that a translation by 2^20 is exact.
    let tick = |x: f64| (x * 1048576.0).round() / 1048576.0;
    let (points, triangles) = grid(5, 0.2, 6);
    let near: Vec<[f64; 2]> = points.iter().map(|p| p.map(tick)).collect();
    let far: Vec<[f64; 2]> = near.iter().map(|p| [p[0] + 1048576.0, p[1] - 2097152.0]).collect();
    let s = planar(&far, &triangles);
    let l = cotan(&s);
    assert_eq!(l, cotan(&planar(&near, &triangles)));
    for id in ["LIN", "FLUX", "ENERGY"] {
        assert_eq!(status(id, s.clone(), &l), Status::Holds, "{id}");
        assert_eq!(status(id, s.clone(), &l.map(|i, j, v| if i > j { 1.01 * v } else { *v })), Status::Fails, "{id}");
    }
    assert_eq!(status("ENERGY", s, &l.map(|_, _, v| 2.0 * v)), Status::Fails);
}

#[test]
fn the_energy_leaves_row_sums_to_null_and_circulations_to_sym() {
    let s = grid_surface(4, 0.2, 8);
    let l = cotan(&s);
    // The diagonal takes no part in a sum over differences.
    let shifted = l.add(&Csr::diagonal(&[0.01; 25]));
    assert_eq!(status("ENERGY", s.clone(), &shifted), Status::Holds);
    assert_eq!(status("NULL", s.clone(), &shifted), Status::Fails);
    // Antisymmetric, with vanishing row sums: a circulation around a triangle.
    let [a, b, c] = s.triangle(0).unwrap();
    let around = [(a, b, 0.1), (b, a, -0.1), (b, c, 0.1), (c, b, -0.1), (c, a, 0.1), (a, c, -0.1)];
    let turned = around.into_iter().fold(l, |l, (i, j, v)| with_added(&l, i, j, v));
    assert_eq!(status("ENERGY", s.clone(), &turned), Status::Holds);
    assert_eq!(status("SYM", s, &turned), Status::Fails);
}

#[test]
fn the_flux_through_the_boundary_is_that_of_the_natural_condition() {
    for s in [square(), star(7, |k| 1.0 + 0.2 * (k % 3) as f64), grid_surface(5, 0.25, 4)] {
        let found = verdict("FLUX", s.clone(), &cotan(&s));
        let boundary = s.topology().boundary_vertices().iter().filter(|b| **b).count();
        assert_eq!((found.status(), counts(&found)), (Status::Holds, (0, 0, 0, boundary)), "{found:?}");
    }
}

#[test]
fn flux_sees_doubled_halved_and_missing_boundary_weights_where_lin_is_silent() {
    let s = grid_surface(4, 0.2, 5);
    let boundary =
        |i: usize, j: usize| s.topology().edge_between(i, j).is_some_and(|e| s.topology().is_boundary_edge(e));
    for factor in [2.0, 0.5, 0.0] {
        let off = cotan(&s).map(|i, j, v| if boundary(i, j) { factor * v } else { *v });
        let l = off.map(
            |i, j, v| {
                if i == j { -off.row(i).filter(|&(k, _)| k != i).map(|(_, w)| w).sum::<f64>() } else { *v }
            },
        );
        for id in ["SYM", "NULL", "LIN"] {
            assert_eq!(status(id, s.clone(), &l), Status::Holds, "{id} {factor}");
        }
        let found = verdict("FLUX", s.clone(), &l);
        assert!(matches!(statement(&found), Statement::Moment { boundary: Some(_), .. }));
    }
}

#[test]
fn clockwise_meshes_in_any_coordinate_plane_have_the_same_flux() {
    let (points, triangles) = grid(3, 0.2, 7);
    let reversed: Vec<[usize; 3]> = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
    for faces in [&triangles, &reversed] {
        for place in [
            |p: &[f64; 2]| [p[0], p[1], 0.0],
            |p: &[f64; 2]| [3.0, p[0], p[1]],
            |p: &[f64; 2]| [p[1], -2.0, p[0]],
            |p: &[f64; 2]| [p[0], 1.0, p[1]],
        ] {
            let s = Surface::triangles(points.iter().map(place).collect(), faces).unwrap();
            let l = cotan(&s);
            for id in ["FLUX", "LIN", "ENERGY"] {
                assert_eq!(status(id, s.clone(), &l), Status::Holds, "{id}");
            }
            assert_eq!(status("FLUX", s, &l.map(|_, _, v| 1.001 * v)), Status::Fails);
        }
    }
}

#[test]
fn closed_and_curved_surfaces_and_bent_polygons_are_told_apart() {
    assert_eq!(status("FLUX", cube(), &cotan(&cube())), Status::NotApplicable);
    assert_eq!(status("FLUX", hills(3, 1), &cotan(&hills(3, 1))), Status::NotApplicable);
    let quad = |z: f64| {
        let p = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, z], [0.0, 1.0, 0.0], [0.5, 0.5, 1.0]];
        Surface::new(p, vec![vec![0, 1, 2, 3], vec![0, 1, 4]]).unwrap()
    };
    let l = |s: &Surface| combinatorial(&s.clone().into());
    assert_eq!(status("ENERGY", quad(0.5), &l(&quad(0.5))), Status::NotApplicable);
    assert_eq!(status("ENERGY", quad(0.0), &l(&quad(0.0))), Status::Fails);
}
