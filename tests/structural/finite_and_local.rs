//! FIN and LOC.

use lapjury::domain::{Domain, Graph, Surface};
use lapjury::linalg::Csr;
use lapjury::operator::MassKind;
use lapjury::property::{Level, Statement, Status};

use crate::meshes::*;
use crate::trials::*;

#[test]
fn a_matrix_of_numbers_is_finite_and_every_entry_was_looked_at() {
    let s = grid_surface(3, 0.2, 1);
    let l = cotan(&s);
    let found = verdict("FIN", s, &l);
    assert_eq!(found.status(), Status::Holds);
    assert_eq!(counts(&found), (0, 0, 0, l.stored()));
}

#[test]
fn a_nan_fails_fin_and_nothing_else() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let domain: Domain = grid_surface(2, 0.0, 1).into();
        let l = with_added(&cotan(domain.as_surface().unwrap()), 4, 1, bad);
        let found = judge("FIN", &domain, &operator(&l));
        assert!(matches!(statement(&found), Statement::NotFinite { i: 4, j: 1, .. }));
        let whole = with_mass(&l, MassKind::Given, &Csr::diagonal(&[1.0; 9]));
        for id in ALL.iter().filter(|id| **id != "FIN") {
            let other = judge(id, &domain, &whole);
            assert_eq!(other.status(), Status::NotApplicable, "{id}");
            assert!(other.reason().unwrap().contains("see FIN"), "{id}");
        }
    }
}

#[test]
fn a_nan_in_the_mass_is_found_too() {
    let domain: Domain = square().into();
    let mass = Csr::diagonal(&[1.0, f64::NAN, 1.0, 1.0]);
    let found = judge("FIN", &domain, &with_mass(&cotan(&square()), MassKind::Given, &mass));
    assert!(matches!(statement(&found), Statement::NotFinite { i: 1, j: 1, .. }));
}

#[test]
fn a_mesh_operator_is_local_and_an_entry_two_rings_away_is_not() {
    let s = grid_surface(4, 0.2, 3);
    let l = cotan(&s);
    let holds = verdict("LOC", s.clone(), &l);
    assert_eq!((holds.status(), holds.level), (Status::Holds, Level::Exact));
    assert!(holds.notes.iter().any(|n| n == "stencil radius: 1 ring"), "{:?}", holds.notes);
    let fails = verdict("LOC", s, &with_added(&l, 0, 24, 1e-9));
    assert!(matches!(statement(&fails), Statement::FarEntry { i: 0, j: 24, rings: Some(4..=8) }));
    assert_eq!(counts(&fails).0, 1);
}

#[test]
fn stored_zeros_are_not_entries_and_entries_as_small_as_rounding_leave_it_open() {
    let s = grid_surface(4, 0.0, 1);
    let l = cotan(&s);
    assert_eq!(status("LOC", s.clone(), &with_added(&l, 0, 24, 0.0)), Status::Holds);
    let faint = with_added(&l, 0, 24, 1e-18);
    assert_eq!(status("LOC", s.clone(), &faint), Status::Undecided);
    let vouched = operator(&faint).with_exact_signs();
    assert_eq!(judge("LOC", &s.into(), &vouched).status(), Status::Fails);
}

#[test]
fn the_diagonal_of_a_quadrilateral_is_local_on_a_polygon_mesh() {
    let p = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0]];
    let s = Surface::new(p, vec![vec![0, 1, 2, 3], vec![1, 4, 5, 2]]).unwrap();
    let l = with_added(&combinatorial(&s.clone().into()), 0, 2, -0.5);
    let found = verdict("LOC", s.clone(), &l);
    assert_eq!(found.status(), Status::Holds);
    assert!(found.notes.iter().any(|n| n.contains("polygon")));
    assert_eq!(status("LOC", s, &with_added(&l, 0, 4, 1.0)), Status::Fails);
}

#[test]
fn the_number_of_far_entries_is_that_of_brute_force() {
    let mut numbers = Numbers(5);
    for _ in 0..20 {
        let domain: Domain = grid_surface(3, 0.2, 2).into();
        let n = domain.vertex_count();
        let triplets: Vec<_> = (0..30).map(|_| (numbers.below(n), numbers.below(n), numbers.next() - 0.5)).collect();
        let l = Csr::from_triplets(n, n, &triplets);
        let expected = (0..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .filter(|&(i, j)| i != j && l.at(i, j) != 0.0 && !share_a_face(&domain, i, j))
            .count();
        let found = judge("LOC", &domain, &operator(&l));
        assert_eq!(counts(&found).0, expected);
        assert_eq!(found.status() == Status::Fails, expected > 0);
    }
}

#[test]
fn on_a_graph_an_entry_between_components_has_no_distance() {
    let graph: Domain = Graph::new(4, &[[0, 1], [2, 3]]).unwrap().into();
    let l = with_added(&combinatorial(&graph), 0, 3, 1.0);
    let found = judge("LOC", &graph, &operator(&l));
    assert!(matches!(statement(&found), Statement::FarEntry { i: 0, j: 3, rings: None }));
    assert_eq!(found.evidence().unwrap().excerpt.edges, [[0, 1]]);
}
