//! MASS.

use lapjury::domain::{Domain, Graph, Surface};
use lapjury::linalg::Csr;
use lapjury::operator::MassKind;
use lapjury::property::{Statement, Status, Verdict};

use crate::meshes::*;
use crate::trials::*;

/// The mass of a kind, from its textbook formula.
fn mass(s: &Surface, kind: MassKind) -> Csr {
    let n = s.positions().len();
    let mut triplets = Vec::new();
    for f in 0..s.faces().len() {
        let t = s.triangle(f).unwrap();
        let p = t.map(|v| s.point(v));
        let area = 0.5 * (p[1] - p[0]).cross(&(p[2] - p[0])).norm();
        let cot = cotangents(t.map(|v| s.positions()[v]), Cotangents::Coordinates);
        let obtuse = (0..3).find(|&k| cot[k] < 0.0);
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            let voronoi = ((p[b] - p[k]).norm_squared() * cot[a] + (p[a] - p[k]).norm_squared() * cot[b]) / 8.0;
            let part = match (kind, obtuse) {
                (MassKind::Barycentric, _) => area / 3.0,
                (MassKind::Mixed, Some(o)) => area / if o == k { 2.0 } else { 4.0 },
                (MassKind::Mixed | MassKind::Voronoi, _) => voronoi,
                _ => area / 6.0,
            };
            triplets.push((t[k], t[k], part));
            if kind == MassKind::Consistent {
                triplets.extend([(t[k], t[a], area / 12.0), (t[k], t[b], area / 12.0)]);
            }
        }
    }
    Csr::from_triplets(n, n, &triplets)
}

const KINDS: [MassKind; 4] = [MassKind::Barycentric, MassKind::Mixed, MassKind::Consistent, MassKind::Voronoi];

fn judged(s: &Surface, kind: MassKind, m: &Csr) -> Verdict {
    judge("MASS", &s.clone().into(), &with_mass(&cotan(s), kind, m))
}

#[test]
fn all_masses_of_the_literature_hold_declared_or_not() {
    for s in [grid_surface(5, 0.2, 1), hills(5, 2), star(7, |k| 1.0 + 0.1 * k as f64)] {
        for kind in KINDS {
            for declared in [kind, MassKind::Given] {
                let found = judged(&s, declared, &mass(&s, kind));
                assert_eq!(found.status(), Status::Holds, "{kind:?} as {declared:?}: {found:?}");
                assert!(found.margin.unwrap() < 1.0);
            }
        }
        let found = judged(&s, MassKind::Given, &mass(&s, MassKind::Mixed));
        assert!(found.notes.iter().any(|n| n == "looks like the mixed mass"), "{:?}", found.notes);
        let found = judged(&s, MassKind::Given, &mass(&s, MassKind::Consistent));
        assert!(found.notes.iter().any(|n| n == "full mass"), "{:?}", found.notes);
    }
}

#[test]
fn obtuse_triangles_keep_the_bounded_masses_and_break_the_signed_one() {
    // An obtuse triangle between two tips: the circumcentric part of the thin corners is negative.
    let s = planar(&[[0.0, 0.0], [4.0, 0.0], [2.0, 0.5]], &[[0, 1, 2]]);
    for kind in [MassKind::Barycentric, MassKind::Mixed, MassKind::Consistent] {
        assert_eq!(judged(&s, kind, &mass(&s, kind)).status(), Status::Holds);
        assert_eq!(judged(&s, MassKind::Given, &mass(&s, kind)).status(), Status::Holds);
    }
    let found = judged(&s, MassKind::Voronoi, &mass(&s, MassKind::Voronoi));
    assert!(matches!(statement(&found), Statement::MassNotPositive { x } if x.len() == 1));
}

#[test]
fn a_wrong_total_is_found_with_its_factor() {
    let s = hills(4, 1);
    for factor in [2.0, 0.5, 1.0 + 1e-11] {
        let found = judged(&s, MassKind::Given, &mass(&s, MassKind::Barycentric).map(|_, _, v| factor * v));
        let Statement::MassTotal { found: total, expected, .. } = statement(&found) else { panic!("{found:?}") };
        assert!((total / expected - factor).abs() < 1e-13);
    }
    let unit = judged(&s, MassKind::Unit, &Csr::diagonal(&[1.0; 25]));
    assert!(matches!(statement(&unit), Statement::MassTotal { found: 25.0, .. }));
}

#[test]
fn a_permuted_mass_has_the_right_total_and_the_wrong_shares() {
    let s = grid_surface(4, 0.2, 3);
    let right = mass(&s, MassKind::Barycentric);
    let d: Vec<f64> = (0..25).map(|i| right.at(i, i)).collect();
    let turned: Vec<f64> = (0..25).map(|i| d[(i + 7) % 25]).collect();
    for declared in [MassKind::Barycentric, MassKind::Given] {
        let found = judged(&s, declared, &Csr::diagonal(&turned));
        assert!(matches!(statement(&found), Statement::MassShare { .. }), "{found:?}");
    }
    // Two inner vertices with eight triangles each swapped: possible shares, but not those of the mass that it says it is.
    let mut swapped = d.clone();
    swapped.swap(6, 12);
    assert!(matches!(
        statement(&judged(&s, MassKind::Barycentric, &Csr::diagonal(&swapped))),
        Statement::MassShare { .. }
    ));
    let open = judged(&s, MassKind::Given, &Csr::diagonal(&swapped));
    assert_eq!(open.status(), Status::Undecided);
    assert!(open.reason().unwrap().contains("23 of 25 shares are those of the barycentric"), "{open:?}");
}

#[test]
fn an_asymmetric_or_indefinite_full_mass_is_found() {
    let s = grid_surface(4, 0.2, 3);
    let m = mass(&s, MassKind::Consistent);
    let asymmetric = with_scaled_entry(&m, 12, 13, 1.0 + 1e-12);
    assert!(matches!(
        statement(&judged(&s, MassKind::Consistent, &asymmetric)),
        Statement::MassAsymmetry { i: 12, j: 13, .. }
    ));
    // Strong coupling: [[d, c], [c, d]] with c > d has the negative direction (1, −1).
    let strong = [(12, 13), (13, 12)].into_iter().fold(m.clone(), |m, (i, j)| with_scaled_entry(&m, i, j, 40.0));
    let found = judged(&s, MassKind::Consistent, &strong);
    assert!(matches!(statement(&found), Statement::MassNotPositive { x } if x.len() > 1), "{found:?}");
    let zero = with_scaled_entry(&mass(&s, MassKind::Barycentric), 12, 12, 0.0);
    assert!(matches!(statement(&judged(&s, MassKind::Given, &zero)), Statement::MassNotPositive { .. }));
}

#[test]
fn a_singular_full_mass_is_not_called_positive() {
    // The rank-one mass vvᵀ is positive semi-definite only.
    let graph: Domain = Graph::new(3, &[[0, 1], [1, 2]]).unwrap().into();
    let triplets: Vec<_> = (0..9).map(|k| (k / 3, k % 3, 1.0)).collect();
    let m = Csr::from_triplets(3, 3, &triplets);
    let found = judge("MASS", &graph, &with_mass(&combinatorial(&graph), MassKind::Given, &m));
    assert_ne!(found.status(), Status::Holds);
    let regular = with_added(&with_added(&with_added(&m, 0, 0, 1.0), 1, 1, 1.0), 2, 2, 1.0);
    let found = judge("MASS", &graph, &with_mass(&combinatorial(&graph), MassKind::Given, &regular));
    assert_eq!(found.status(), Status::Holds);
    assert!(found.notes.iter().any(|n| n.contains("no area")));
}

#[test]
fn isolated_vertices_need_no_mass() {
    let p = [[0.0, 0.0], [1.0, 0.0], [0.3, 0.8], [9.0, 9.0]];
    let s = planar(&p, &[[0, 1, 2]]);
    let found = judged(&s, MassKind::Barycentric, &mass(&s, MassKind::Barycentric));
    assert_eq!(found.status(), Status::Holds, "{found:?}");
    assert!(found.notes.iter().any(|n| n.contains("1 vertices without area")));
    let given = with_added(&mass(&s, MassKind::Barycentric), 3, 3, 1.0);
    assert_eq!(judged(&s, MassKind::Given, &given).status(), Status::Fails);
}
