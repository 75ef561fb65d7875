//! POS, POS0 and POS-boundary.

use lapjury::domain::delaunay::DelaunayCount;
use lapjury::domain::{Domain, Graph};
use lapjury::linalg::Csr;
use lapjury::property::{Level, Statement, Status};

use crate::meshes::*;
use crate::trials::*;

#[test]
fn a_non_delaunay_edge_is_a_violation_with_its_two_obtuse_angles() {
    let s = obtuse_pair(0.5);
    for id in ["POS", "POS0"] {
        let found = verdict(id, s.clone(), &cotan(&s));
        assert_eq!(counts(&found), (1, 0, 0, 1));
        let Statement::Weight { i: 0, j: 1, zero: false, opposite } = statement(&found) else { panic!("{found:?}") };
        assert_eq!(opposite.iter().map(|c| c.vertex).collect::<Vec<_>>(), [2, 3]);
        for corner in opposite {
            // tan of half the angle at the apex is 1/h = 2.
            assert!((corner.angle_deg - 2.0 * 2f64.atan().to_degrees()).abs() < 1e-9);
        }
        assert_eq!(found.evidence().unwrap().excerpt.faces.len(), 2);
    }
}

#[test]
fn a_cocircular_pair_fails_by_an_exact_zero_and_pos0_holds() {
    let s = square();
    let zero = operator(&cotan(&s)).with_exact_signs();
    let strict = judge("POS", &s.clone().into(), &zero);
    assert_eq!((counts(&strict), strict.level), ((0, 1, 0, 1), Level::Exact));
    assert!(matches!(statement(&strict), Statement::Weight { i: 0, j: 2, zero: true, .. }));
    let weak = judge("POS0", &s.into(), &zero);
    assert_eq!((weak.status(), counts(&weak)), (Status::Holds, (0, 1, 0, 1)));
}

#[test]
fn nothing_fails_by_minus_1e_minus_17() {
    let s = square();
    for noise in [1e-17, -1e-17] {
        let l = with_added(&with_added(&cotan(&s), 0, 2, noise), 2, 0, noise);
        let strict = verdict("POS", s.clone(), &l);
        assert_eq!((strict.status(), counts(&strict)), (Status::Undecided, (0, 0, 1, 1)));
        let weak = verdict("POS0", s.clone(), &l);
        assert_eq!((weak.status(), weak.level, counts(&weak)), (Status::Holds, Level::Measured, (0, 1, 0, 1)));
    }
}

#[test]
fn an_edge_where_nothing_is_stored_has_weight_zero() {
    let s = square();
    let without = Csr::from_triplets(
        4,
        4,
        &cotan(&s).entries().filter(|&(i, j, _)| i + j != 2 || i == j).map(|(i, j, v)| (i, j, *v)).collect::<Vec<_>>(),
    );
    assert_eq!(without.get(0, 2), None);
    assert_eq!(counts(&verdict("POS", s, &without)), (0, 1, 0, 1));
}

#[test]
fn on_random_meshes_violations_are_the_non_delaunay_edges() {
    for seed in 0..30 {
        for s in [grid_surface(6, 0.45, seed), hills(6, seed)] {
            let count = DelaunayCount::of(&s);
            let found = verdict("POS", s.clone(), &cotan(&s));
            let total = count.strict + count.cocircular + count.violated.len();
            assert_eq!(counts(&found), (count.violated.len(), 0, 0, total));
            assert_eq!(found.status() == Status::Fails, !count.violated.is_empty());
        }
    }
}

#[test]
fn the_witness_is_the_most_negative_weight_relative_to_its_row() {
    let s = grid_surface(6, 0.45, 3);
    let l = cotan(&s);
    let scales = l.row_scales();
    let is_edge = |i: usize, j: usize| i != j && s.topology().edge_between(i, j).is_some();
    let expected = l
        .entries()
        .filter(|&(i, j, _)| is_edge(i, j) && !s.topology().is_boundary_edge(s.topology().edge_between(i, j).unwrap()))
        .map(|(i, _, v)| v / scales[i])
        .fold(0.0, f64::max);
    let found = verdict("POS", s.clone(), &l);
    let Statement::Weight { i, j, .. } = statement(&found) else { panic!("{found:?}") };
    let reached = (l.at(*i, *j) / scales[*i]).max(l.at(*i, *j) / scales[*j]);
    assert_eq!(reached, expected);
}

#[test]
fn one_negative_direction_of_an_edge_is_enough_and_named() {
    let s = grid_surface(3, 0.1, 5);
    let l = mean_value(&s);
    assert_eq!(status("POS", s.clone(), &l), Status::Holds);
    let one_way = l.map(|i, j, v| if (i, j) == (9, 5) { 0.5 } else { *v });
    assert!(s.topology().edge_between(5, 9).is_some());
    let found = verdict("POS", s, &one_way);
    assert_eq!(counts(&found).0, 1);
    assert!(matches!(statement(&found), Statement::Weight { i: 9, j: 5, zero: false, .. }));
}

#[test]
fn an_operator_with_edges_of_its_own_has_no_weight_on_edges_that_it_flipped_away() {
    // The intrinsic Delaunay triangulation of the obtuse pair has the edge 23 in place of 01.
    let flipped = planar(&[[-1.0, 0.0], [1.0, 0.0], [0.0, 0.5], [0.0, -0.5]], &[[0, 3, 2], [1, 2, 3]]);
    let l = cotan(&flipped);
    let s = obtuse_pair(0.5);
    for id in ["POS", "POS0"] {
        let found = verdict(id, s.clone(), &l);
        assert_eq!((found.status(), counts(&found)), (Status::Holds, (0, 0, 0, 1)), "{found:?}");
        assert!(found.notes.iter().any(|n| n.contains("1 edges of the domain carry no weight")));
        assert!(found.notes.iter().any(|n| n.contains("1 weights are on pairs that are no edges")));
    }
    let negative = with_added(&with_added(&l, 2, 3, 10.0), 3, 2, 10.0);
    assert!(matches!(statement(&verdict("POS", s, &negative)), Statement::Weight { i: 2, j: 3, zero: false, .. }));
}

#[test]
fn boundary_edges_have_a_count_of_their_own() {
    // The angles opposite the four boundary edges of the obtuse pair are acute; an obtuse corner makes one negative.
    let s = obtuse_pair(0.5);
    let found = verdict("POS-boundary", s.clone(), &cotan(&s));
    assert_eq!((found.status(), counts(&found)), (Status::Holds, (0, 0, 0, 4)));
    assert!(found.notes.iter().any(|n| n.contains("both ends on the boundary") && n.contains("1 (violations 1")));
    let obtuse = planar(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.3]], &[[0, 1, 2]]);
    let found = verdict("POS-boundary", obtuse.clone(), &cotan(&obtuse));
    assert_eq!(counts(&found), (1, 0, 0, 3));
    assert!(matches!(statement(&found), Statement::Weight { i: 0, j: 1, zero: false, .. }));
    assert_eq!(status("POS", obtuse.clone(), &cotan(&obtuse)), Status::NotApplicable);
    assert_eq!(status("POS-boundary", cube(), &cotan(&cube())), Status::NotApplicable);
}

#[test]
fn a_right_angle_opposite_a_boundary_edge_is_an_exact_zero_there() {
    let right = planar(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &[[0, 1, 2]]);
    let found = verdict("POS-boundary", right.clone(), &cotan(&right));
    assert_eq!(counts(&found), (0, 1, 0, 3));
}

#[test]
fn an_edge_with_three_faces_is_interior() {
    let p = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.5, 0.2, 0.0], [0.5, 0.0, 0.2], [0.5, -0.2, 0.0]];
    let s = lapjury::domain::Surface::triangles(p, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]]).unwrap();
    assert_eq!(counts(&verdict("POS", s.clone(), &cotan(&s))), (1, 0, 0, 1));
    assert_eq!(counts(&verdict("POS-boundary", s.clone(), &cotan(&s))), (0, 0, 0, 6));
}

#[test]
fn every_edge_of_a_graph_counts_and_signs_are_literal() {
    let domain: Domain = Graph::new(3, &[[0, 1], [1, 2], [0, 2]]).unwrap().into();
    let l = combinatorial(&domain);
    let found = judge("POS", &domain, &operator(&l));
    assert_eq!((found.status(), found.level, counts(&found)), (Status::Holds, Level::Exact, (0, 0, 0, 3)));
    let tiny = l.map(|i, j, v| if i + j == 1 { 1e-30 } else { *v });
    let found = judge("POS", &domain, &operator(&tiny));
    assert_eq!((found.level, counts(&found)), (Level::Exact, (1, 0, 0, 3)));
}
