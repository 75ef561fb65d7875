//! `tet-cotan`: closed forms, the exact twin, and what properties say on volumes.

use std::cmp::Ordering;
use std::path::Path;

use lapjury::domain::{Domain, Volume};
use lapjury::laplacian::{find, tet_cotan};
use lapjury::linalg::Csr;
use lapjury::operator::MassKind;
use lapjury::property::{self, Status, Trial};
use lapjury::scalar::{Rational, Scalar};
use lapjury::suite::Recipe;

use crate::{U, build};

/// The corner x + 2y + 4z of the unit cube has this number.
fn cube(scale: f64) -> Vec<[f64; 3]> {
    (0..8).map(|v| [v & 1, v >> 1 & 1, v >> 2 & 1].map(|x| scale * f64::from(x))).collect()
}

/// The regular tetrahedron on alternating corners and the four that it cuts off.
const FIVE: [[usize; 4]; 5] = [[0, 3, 5, 6], [1, 0, 3, 5], [2, 0, 3, 6], [4, 0, 5, 6], [7, 3, 5, 6]];

fn make(recipe: &str) -> Domain {
    recipe.parse::<Recipe>().unwrap().build(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn volume(domain: &Domain) -> &Volume {
    let Domain::Volume(volume) = domain else { panic!("a volume") };
    volume
}

fn close(found: f64, expected: f64) -> bool {
    (found - expected).abs() <= 16.0 * U * expected.abs().max(1e-300)
}

#[test]
fn the_regular_tetrahedron_has_the_weight_of_its_dihedral_angle() {
    // cos θ = 1/3, so cot θ = 1/√8: ω = ℓ/(6√8).
    for scale in [1.0, 1e8, 1e-8] {
        let p = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        let p = p.iter().map(|p| p.map(|x| scale * x)).collect();
        let domain = Domain::from(Volume::new(p, vec![[0, 1, 2, 3]]).unwrap());
        let l = build("tet-cotan", "", &domain);
        let expected = 8f64.sqrt() * scale / (6.0 * 8f64.sqrt());
        for i in 0..4 {
            assert!(close(l.stiffness().at(i, i), 3.0 * expected));
            assert!((0..i).all(|j| close(-l.stiffness().at(i, j), expected)));
        }
        // Edge ℓ = √8: the volume is ℓ³/(6√2) = 8/3.
        assert!(close(l.mass().unwrap().total(), 8.0 / 3.0 * scale.powi(3)));
    }
}

#[test]
fn a_cube_of_five_tetrahedra_has_a_sixth_on_its_edges_and_a_twelfth_on_the_diagonals() {
    for scale in [1.0, 1e8, 1e-8] {
        let domain = Domain::from(Volume::new(cube(scale), FIVE.to_vec()).unwrap());
        let l = build("tet-cotan", "", &domain);
        for &[i, j] in domain.edges() {
            let expected = if (i ^ j).count_ones() == 1 { scale / 6.0 } else { scale / 12.0 };
            assert!(close(-l.stiffness().at(i, j), expected), "({i}, {j})");
        }
    }
}

#[test]
fn kuhns_six_tetrahedra_leave_the_edges_alone_and_exact_zeros_on_every_diagonal() {
    // Along x, y, z in order each tetrahedron has ⅙ on its three steps: at both ends of the long diagonal two of them share a step.
    let l = build("tet-cotan", "", &make("tet-grid:nx=1,ny=1,nz=1"));
    for i in 0..8_usize {
        for j in 0..i {
            let step = (i ^ j).count_ones() == 1;
            let expected = match (step, j == 0 || i == 7) {
                (true, true) => 1.0 / 3.0,
                (true, false) => 1.0 / 6.0,
                _ => 0.0,
            };
            let found = -l.stiffness().at(i, j);
            assert!(if expected == 0.0 { found == 0.0 } else { close(found, expected) }, "({i}, {j}): {found}");
        }
    }
    // Inside a grid that is the stencil of seven points.
    let grid = build("tet-cotan", "", &make("tet-grid"));
    let middle: Vec<(usize, f64)> =
        grid.stiffness().row(13).filter(|(_, v)| **v != 0.0).map(|(j, v)| (j, *v)).collect();
    assert_eq!(middle.iter().map(|(j, _)| *j).collect::<Vec<_>>(), [4, 10, 12, 13, 14, 16, 22]);
    assert!(middle.iter().all(|(j, v)| close(*v, if *j == 13 { 6.0 } else { -1.0 })));
}

#[test]
fn the_rational_twin_is_linear_precise_and_its_energy_is_the_volume() {
    for recipe in ["tet-grid:nx=2,ny=2,nz=3,displacement=0.16,seed=4", "fixtures/meshes/cube86.mesh"] {
        let domain = make(recipe);
        let volume = volume(&domain);
        let l: Csr<Rational> = tet_cotan::stiffness_of(volume).unwrap();
        let boundary = domain.boundary();
        let x: Vec<Vec<Rational>> =
            (0..3).map(|a| volume.positions().iter().map(|p| Rational::exactly(p[a]).unwrap()).collect()).collect();
        let images: Vec<Vec<Rational>> = x.iter().map(|x| l.mul(x)).collect();
        for image in &images {
            assert!((0..boundary.len()).all(|i| boundary[i] || image[i].cmp_zero() == Ordering::Equal), "{recipe}");
        }
        let mass: Csr<Rational> = tet_cotan::mass_of(volume, MassKind::Consistent).unwrap();
        let total = mass.entries().fold(Rational::zero(), |sum, (_, _, v)| sum + v.clone());
        for (a, image) in images.iter().enumerate() {
            for (b, x) in x.iter().enumerate() {
                let energy = image.iter().zip(x).fold(Rational::zero(), |s, (y, x)| s + y.clone() * x.clone());
                let expected = if a == b { total.clone() } else { Rational::zero() };
                assert_eq!((energy - expected).cmp_zero(), Ordering::Equal, "{recipe} ({a}, {b})");
            }
        }
        // The f64 operator is its rounding, sign by sign.
        let rounded = build("tet-cotan", "", &domain);
        for (i, j, v) in l.entries().filter(|(i, j, _)| i != j) {
            let found = rounded.stiffness().at(i, j);
            assert_eq!(found.partial_cmp(&0.0), Some(v.cmp_zero()), "{recipe} ({i}, {j})");
            assert!((found - v.approximate()).abs() <= 1e-12, "{recipe} ({i}, {j})");
        }
    }
}

#[test]
fn a_sliver_has_the_weights_of_exact_arithmetic() {
    // Four points almost in a plane: D is lost in its rounding.
    let p = vec![[0.1, 0.2, 0.3], [1.3, 0.7, 0.1], [0.9, 1.9, 0.4], [0.7, 0.9, 0.2666666666666667]];
    let domain = Domain::from(Volume::new(p, vec![[0, 1, 2, 3]]).unwrap());
    let exact: Csr<Rational> = tet_cotan::stiffness_of(volume(&domain)).unwrap();
    let rounded = build("tet-cotan", "", &domain);
    for (i, j, v) in exact.entries().filter(|(i, j, _)| i != j) {
        let (found, expected) = (rounded.stiffness().at(i, j), v.approximate());
        assert!((found - expected).abs() <= 1e-9 * expected.abs(), "({i}, {j}): {found} {expected}");
    }
}

#[test]
fn orientation_does_not_matter_and_a_flat_tetrahedron_is_refused_by_name() {
    let kuhn = make("tet-grid:nx=2,ny=2,nz=2,displacement=0.1,seed=2");
    let turned = volume(&kuhn).tetrahedra().iter().map(|t| [t[1], t[0], t[2], t[3]]).collect();
    let turned = Domain::from(Volume::new(volume(&kuhn).positions().to_vec(), turned).unwrap());
    let (a, b) = (build("tet-cotan", "", &kuhn), build("tet-cotan", "", &turned));
    assert!(a.stiffness().entries().all(|(i, j, v)| (v - b.stiffness().at(i, j)).abs() < 1e-14));
    let flat = Domain::from(Volume::new(cube(1.0), vec![[0, 1, 2, 4], [0, 1, 2, 3]]).unwrap());
    let refusal = find("tet-cotan").unwrap().build(&flat, &Default::default()).unwrap_err().to_string();
    assert_eq!(
        refusal,
        "tetrahedron 1 (0, 1, 2, 3) has zero volume, where 'tet-cotan' is not defined (1 such tetrahedra in all); remove them"
    );
}

#[test]
fn properties_of_surfaces_say_nothing_on_a_volume_and_the_others_are_decided() {
    let choice: lapjury::suite::Choice = "tet-cotan".parse().unwrap();
    for recipe in ["tet-grid:nx=3,ny=2,nz=2,displacement=0.1,seed=2", "fixtures/meshes/cube86.mesh"] {
        let domain = make(recipe);
        let operator = choice.build(&domain).unwrap();
        let trial = Trial::new(&domain, &operator, 1).unwrap();
        let status = |id: &str| {
            let again = |domain: &Domain| choice.build(domain).map_err(|e| e.to_string());
            property::find(id).unwrap().decide(&trial, Some(&again)).status()
        };
        for id in ["FIN", "LOC", "SYM", "NULL", "KER", "PSD", "LIN", "MASS", "PERM", "RIGID", "SCALE", "UNION"] {
            assert_eq!(status(id), Status::Holds, "{id} on {recipe}");
        }
        for id in ["ENERGY", "FLUX", "ISO"] {
            assert_eq!(status(id), Status::NotApplicable, "{id} on {recipe}");
        }
    }
}
