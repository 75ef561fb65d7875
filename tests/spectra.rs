//! Certified spectra of real meshes and of spheres, against an independent program and against closed forms.

use std::path::PathBuf;

use lapjury::domain::Domain;
use lapjury::exchange::read_domain;
use lapjury::laplacian;
use lapjury::linalg::spectrum::{Spectrum, lowest};
use lapjury::suite::Recipe;

fn mesh(name: &str) -> Domain {
    read_domain(&PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("fixtures/meshes").join(name)).unwrap()
}

fn spectrum(domain: &Domain, mass: &str, count: usize, seed: u64) -> Spectrum {
    let settings = [("mass".to_string(), mass.to_string())].into();
    let operator = laplacian::find("cotan").unwrap().build(domain, &settings).unwrap();
    lowest(operator.stiffness(), operator.mass().unwrap().matrix(), count, seed).unwrap()
}

/// λ₂, λ₃, λ₄ with the barycentric mass as printed in the table of `fixtures/meshes/LICENSES.md`, which an independent program
/// wrote with six digits.
fn printed(name: &str) -> Vec<f64> {
    let table = include_str!("../fixtures/meshes/LICENSES.md");
    let row = table.lines().find(|line| line.starts_with(&format!("| `{name}`"))).unwrap();
    row.split('|').nth(8).unwrap().split(',').map(|word| word.trim().parse().unwrap()).collect()
}

/// Half a unit of the sixth digit.
fn half_a_digit(x: f64) -> f64 {
    0.5 * 10_f64.powf(x.abs().log10().floor() - 5.0)
}

#[test]
fn the_eigenvalues_of_real_meshes_are_those_of_an_independent_program() {
    for name in [
        "spot.ply",
        "bob_small.ply",
        "fox.ply",
        "eight.off",
        "anchor.off",
        "blade.off",
        "three_peaks.off",
        "oblong.off",
    ] {
        let found = spectrum(&mesh(name), "barycentric", 4, 1);
        assert!(found.closure.certified, "{name}: {:?}", found.closure);
        for (found, expected) in found.values[1..4].iter().zip(printed(name)) {
            assert!((found - expected).abs() <= 1.001 * half_a_digit(expected), "{name}: {found} is not {expected}");
        }
    }
}

#[test]
fn the_bones_have_twenty_six_zeros_and_no_more() {
    let found = spectrum(&mesh("bones.off"), "barycentric", 26, 1);
    let zeros = found.values.iter().filter(|v| v.abs() < 1e-9).count();
    assert_eq!((zeros, found.closure.certified), (26, true));
}

#[test]
fn every_multiplet_of_a_sphere_is_whole_from_twenty_starts() {
    let domain = "icosphere:levels=3".parse::<Recipe>().unwrap().build(std::path::Path::new(".")).unwrap();
    for seed in 0..20 {
        let found = spectrum(&domain, "barycentric", 30, seed);
        // 1 + 3 + 5 + 7 + 9 + 11 = 36: thirty is inside the multiplet l = 5.
        assert_eq!((found.values.len(), found.closure.certified), (36, true), "seed {seed}: {:?}", found.closure);
        for (k, value) in found.values.iter().enumerate() {
            let l = (k as f64).sqrt().floor();
            assert!((value - l * (l + 1.0)).abs() <= 0.05 * l * (l + 1.0) + 1e-10, "{k}: {value}");
        }
    }
}

#[test]
fn eigenvalues_of_a_sphere_converge_at_order_two_for_lumped_and_full_mass() {
    for mass in ["barycentric", "mixed", "consistent"] {
        let of = |level: usize| {
            let recipe: Recipe = format!("icosphere:levels={level}").parse().unwrap();
            spectrum(&recipe.build(std::path::Path::new(".")).unwrap(), mass, 16, 0).values
        };
        let (coarse, fine) = (of(3), of(4));
        for k in 4..16 {
            let l = (k as f64).sqrt().floor();
            let order = ((coarse[k] - l * (l + 1.0)) / (fine[k] - l * (l + 1.0))).abs().log2();
            assert!((1.9..2.1).contains(&order), "{mass}, {k}: {order}");
        }
    }
}
