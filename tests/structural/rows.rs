//! SYM, NULL, LIN and MVP: residuals of entries and rows.

use lapjury::domain::{Domain, Graph, PointCloud, Surface, Volume};
use lapjury::linalg::Csr;
use lapjury::property::{Level, Statement, Status};
use proptest::prelude::*;

use crate::meshes::*;
use crate::trials::*;

#[test]
fn a_relative_asymmetry_of_1e_minus_12_fails_on_every_edge_of_a_healthy_mesh() {
    for s in [star(6, |_| 1.0), cube(), grid_surface(4, 0.25, 7), hills(4, 8), obtuse_pair(0.5)] {
        let l = cotan(&s);
        for &[i, j] in s.topology().edges() {
            // A weight near zero is the difference of large terms: not that edge is healthy.
            if l.at(i, j).abs() < 0.05 {
                continue;
            }
            let spoilt = with_scaled_entry(&l, i, j, 1.0 + 1e-12);
            let found = verdict("SYM", s.clone(), &spoilt);
            assert_eq!((found.status(), counts(&found).0), (Status::Fails, 1), "edge {i} {j}: {found:?}");
            assert!(matches!(statement(&found), Statement::Asymmetry { i: a, j: b, .. } if (*a, *b) == (i, j)));
        }
    }
}

#[test]
fn weights_written_twice_are_exactly_symmetric_and_weights_computed_twice_are_symmetric() {
    let s = hills(6, 3);
    let exact = verdict("SYM", s.clone(), &cotan(&s));
    assert_eq!((exact.status(), exact.level, exact.margin), (Status::Holds, Level::Exact, Some(0.0)));
    // The upper triangle from coordinates, the lower one from lengths.
    let order: Vec<usize> = (0..s.faces().len()).collect();
    let other = cotan_in_order(&s, Cotangents::Lengths, &order);
    let mixed = cotan(&s).map(|i, j, v| if i < j { *v } else { other.at(i, j) });
    let found = verdict("SYM", s, &mixed);
    assert_eq!(found.status(), Status::Holds, "{found:?}");
    assert!(found.margin.unwrap() > 0.0);
}

#[test]
fn an_entry_on_one_side_only_is_an_asymmetry() {
    let graph: Domain = Graph::new(3, &[[0, 1], [1, 2]]).unwrap().into();
    let l = combinatorial(&graph);
    assert_eq!(judge("SYM", &graph, &operator(&l)).status(), Status::Holds);
    for (i, j) in [(0, 2), (2, 0)] {
        let found = judge("SYM", &graph, &operator(&with_added(&l, i, j, 1.0)));
        assert!(matches!(statement(&found), Statement::Asymmetry { i: 0, j: 2, .. }));
    }
    let s = grid_surface(4, 0.2, 4);
    let floater = mean_value(&s);
    assert_eq!(status("SYM", s, &floater), Status::Fails);
}

#[test]
fn a_defect_is_seen_beside_an_entry_of_1e8() {
    // A sliver at the left, a relative asymmetry of 1e-11 at the right.
    let (mut points, mut triangles) = grid(3, 0.2, 9);
    let n = points.len();
    points.extend([[-1.0, 0.0], [-0.5, 1e-9]]);
    triangles.push([0, n + 1, n]);
    let s = planar(&points, &triangles);
    let l = cotan(&s);
    assert!(l.at(0, n).abs() > 1e8);
    let [i, j] = [14, 15];
    assert_eq!(status("SYM", s.clone(), &l), Status::Holds);
    assert_eq!(status("SYM", s.clone(), &with_scaled_entry(&l, i, j, 1.0 + 1e-11)), Status::Fails);
    assert_eq!(status("NULL", s.clone(), &l), Status::Holds);
    assert_eq!(status("NULL", s, &with_scaled_entry(&l, i, i, 1.0 + 1e-11)), Status::Fails);
}

#[test]
fn row_sums_vanish_for_laplacians_and_a_perturbed_diagonal_is_found() {
    for s in [star(7, |k| 1.0 + 0.1 * k as f64), cube(), grid_surface(5, 0.25, 2), hills(5, 2)] {
        for l in [cotan(&s), mean_value(&s), combinatorial(&s.clone().into())] {
            assert_eq!(status("NULL", s.clone(), &l), Status::Holds);
            for i in 0..l.rows() {
                let found = verdict("NULL", s.clone(), &with_scaled_entry(&l, i, i, 1.0 - 1e-12));
                assert!(matches!(statement(&found), Statement::RowSum { i: at, .. } if *at == i));
            }
        }
    }
    let domain: Domain = Graph::new(3, &[[0, 1], [1, 2]]).unwrap().into();
    // S L S with S = diag(1, 2^-1/2, 1): the rows do not sum to zero on a graph that is not regular.
    let root = [1.0, 0.5f64.sqrt(), 1.0];
    let normalised = combinatorial(&domain).map(|i, j, v| root[i] * v * root[j]);
    assert_eq!(judge("NULL", &domain, &operator(&normalised)).status(), Status::Fails);
    assert_eq!(judge("SYM", &domain, &operator(&normalised)).status(), Status::Holds);
}

#[test]
fn linear_functions_are_harmonic_for_cotan_and_mean_value_but_not_for_the_graph() {
    let s = grid_surface(6, 0.25, 11);
    for l in [cotan(&s), mean_value(&s)] {
        let found = verdict("LIN", s.clone(), &l);
        assert_eq!(found.status(), Status::Holds, "{found:?}");
        assert_eq!(counts(&found), (0, 0, 0, 25));
    }
    let found = verdict("LIN", s.clone(), &combinatorial(&s.clone().into()));
    assert_eq!(counts(&found), (25, 0, 0, 25));
    // On a regular star even unit weights are linear-precise, by symmetry.
    let hexagon = star(6, |_| 1.0);
    assert_eq!(status("LIN", hexagon.clone(), &combinatorial(&hexagon.into())), Status::Holds);
}

#[test]
fn in_space_only_flat_stars_count() {
    // A 2×2 grid of squares whose right half is folded up: vertices (1, 1) lies on the fold; then a 4×2 grid with flat stars.
    let (points, triangles) = grid(4, 0.0, 1);
    let fold = |at: f64| {
        let lift = |&[x, y]: &[f64; 2]| if x > at { [at, y, x - at] } else { [x, y, 0.0] };
        Surface::triangles(points.iter().map(lift).collect(), &triangles).unwrap()
    };
    let s = fold(0.5);
    let found = verdict("LIN", s.clone(), &cotan(&s));
    // Of the 9 interior vertices the 3 with x = ½ are on the fold.
    assert_eq!((found.status(), counts(&found).3), (Status::Holds, 6));
    let [flat, creased] = [6, 12];
    let spoilt = |i: usize| with_added(&with_added(&cotan(&s), i, i + 1, -0.1), i, i, 0.1);
    assert_eq!(status("LIN", s.clone(), &spoilt(flat)), Status::Fails);
    assert_eq!(status("LIN", s.clone(), &spoilt(creased)), Status::Holds);
    let bumpy = hills(4, 1);
    let none = verdict("LIN", bumpy.clone(), &cotan(&bumpy));
    assert_eq!(none.status(), Status::NotApplicable);
    assert!(none.reason().unwrap().contains("none of the 9 interior vertices"));
    assert_eq!(status("LIN", square(), &cotan(&square())), Status::NotApplicable);
}

#[test]
fn domains_without_coordinates_or_interior_are_told_apart() {
    let graph: Domain = Graph::new(2, &[[0, 1]]).unwrap().into();
    let points: Domain = PointCloud::new(vec![[0.0; 3]; 2], None).unwrap().into();
    let l = Csr::from_triplets(2, 2, &[(0, 0, 1.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 1.0)]);
    for id in ["LIN", "FLUX", "ENERGY", "POS-boundary", "MASS"] {
        assert_eq!(judge(id, &graph, &operator(&l)).status(), Status::NotApplicable, "{id}");
        assert_eq!(judge(id, &points, &operator(&l)).status(), Status::NotApplicable, "{id}");
    }
    assert_eq!(judge("LOC", &points, &operator(&l)).status(), Status::NotApplicable);
    assert_eq!(judge("POS", &points, &operator(&l)).status(), Status::Holds);
}

#[test]
fn on_a_volume_the_centre_of_a_regular_tetrahedron_is_linear_precise_for_equal_weights_only() {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let positions: Vec<[f64; 3]> = std::iter::once([0.0; 3]).chain(corners).collect();
    let v: Domain =
        Volume::new(positions, vec![[0, 1, 2, 3], [0, 1, 2, 4], [0, 1, 3, 4], [0, 2, 3, 4]]).unwrap().into();
    let l = combinatorial(&v);
    assert_eq!(judge("LIN", &v, &operator(&l)).status(), Status::Holds);
    let spoilt = with_scaled_entry(&l, 0, 3, 1.0 + 1e-9);
    assert_eq!(judge("LIN", &v, &operator(&spoilt)).status(), Status::Fails);
}

#[test]
fn the_mean_value_property_needs_signs_sums_and_a_positive_diagonal() {
    let s = star(6, |k| 1.0 + 0.2 * (k % 2) as f64);
    let l = mean_value(&s);
    assert_eq!(status("MVP", s.clone(), &l), Status::Holds);
    assert_eq!(counts(&verdict("MVP", s.clone(), &l)).3, 1);
    let negative = with_added(&with_added(&l, 0, 3, 5.0), 0, 0, -5.0);
    assert!(matches!(statement(&verdict("MVP", s.clone(), &negative)), Statement::NotConvex { i: 0, j: 3 }));
    let sum = with_scaled_entry(&l, 0, 0, 1.1);
    assert!(matches!(statement(&verdict("MVP", s.clone(), &sum)), Statement::RowSum { i: 0, .. }));
    let turned = l.map(|_, _, v| -v);
    assert!(matches!(statement(&verdict("MVP", s.clone(), &turned)), Statement::NotConvex { i: 0, j: 0 }));
    // Boundary rows do not matter.
    assert_eq!(status("MVP", s, &with_added(&l, 2, 0, 50.0)), Status::Holds);
    assert_eq!(status("MVP", square(), &cotan(&square())), Status::NotApplicable);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_number_of_bad_rows_is_that_of_dense_rational_sums(seed in 0_u64..1000, bad in prop::collection::vec(0_usize..25, 0..6)) {
        let s = grid_surface(4, 0.25, seed);
        let mut l = cotan(&s);
        for &i in &bad {
            l = with_added(&l, i, (i + 1) % 25, 0.25);
        }
        let exact: Vec<f64> = (0..25)
            .map(|i| lapjury::scalar::sum((0..25).map(|j| rational(l.at(i, j)))))
            .map(|sum| lapjury::scalar::Scalar::approximate(&sum))
            .collect();
        let expected = exact.iter().filter(|sum| sum.abs() > 1e-6).count();
        let found = verdict("NULL", s, &l);
        prop_assert_eq!(counts(&found), (expected, 0, 0, 25));
    }
}
