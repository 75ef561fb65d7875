//! Correct operators under unfavourable circumstances: never failing, whatever the scale, the order or the shape.

use lapjury::domain::Surface;
use lapjury::linalg::Csr;
use lapjury::property::{Status, Verdict};

use crate::meshes::*;
use crate::trials::*;

/// What is true of the cotangent Laplacian on every mesh.
const PROMISED: [&str; 7] = ["FIN", "LOC", "SYM", "NULL", "LIN", "ENERGY", "FLUX"];

fn verdicts(s: &Surface, l: &Csr) -> Vec<(&'static str, Verdict)> {
    PROMISED.iter().map(|&id| (id, verdict(id, s.clone(), l))).collect()
}

fn all_hold(s: &Surface, l: &Csr, what: &str) {
    for (id, v) in verdicts(s, l) {
        assert!(matches!(v.status(), Status::Holds | Status::NotApplicable), "{what}: {id}: {v:?}");
    }
}

/// As [`all_hold`], but the energy of slivers may stay open: from an aspect ratio of about 1e5 on no digit of it is left.
fn all_hold_but_energy(s: &Surface, l: &Csr, what: &str) {
    for (id, v) in verdicts(s, l) {
        match id {
            "ENERGY" => assert_ne!(v.status(), Status::Fails, "{what}: {v:?}"),
            _ => assert!(matches!(v.status(), Status::Holds | Status::NotApplicable), "{what}: {id}: {v:?}"),
        }
    }
}

fn none_fails(s: &Surface, l: &Csr, what: &str) {
    for (id, v) in verdicts(s, l) {
        assert_ne!(v.status(), Status::Fails, "{what}: {id}: {v:?}");
    }
}

fn shuffled(n: usize, seed: u64) -> Vec<usize> {
    let (mut order, mut numbers) = ((0..n).collect::<Vec<_>>(), Numbers(seed));
    for k in (1..n).rev() {
        order.swap(k, numbers.below(k + 1));
    }
    order
}

fn stretched(n: usize, jitter: f64, seed: u64, stretch: [f64; 2]) -> Surface {
    let (points, triangles) = grid(n, jitter, seed);
    let points: Vec<[f64; 2]> = points.iter().map(|p| [p[0] * stretch[0], p[1] * stretch[1]]).collect();
    planar(&points, &triangles)
}

#[test]
fn healthy_meshes_hold_in_any_order_of_assembly_from_coordinates_and_from_lengths() {
    for seed in 0..12 {
        for s in [grid_surface(6, 0.3, seed), hills(6, seed), star(9, |k| 1.0 + 0.3 * ((k * 5) % 3) as f64)] {
            let order = shuffled(s.faces().len(), seed);
            for how in [Cotangents::Coordinates, Cotangents::Lengths] {
                all_hold(&s, &cotan_in_order(&s, how, &order), &format!("seed {seed}"));
            }
        }
    }
}

#[test]
fn the_scale_of_the_mesh_does_not_matter() {
    for scale in [1e-100, 1e-12, 1e12, 1e100] {
        let s = stretched(4, 0.25, 3, [scale; 2]);
        let l = cotan(&s);
        all_hold(&s, &l, &format!("{scale:e}"));
        for id in ["ENERGY", "FLUX"] {
            assert_eq!(status(id, s.clone(), &l.map(|_, _, v| (1.0 + 1e-10) * v)), Status::Fails, "{scale:e} {id}");
        }
    }
}

#[test]
fn the_scale_of_the_matrix_does_not_matter_to_symmetry_and_kernel() {
    let s = grid_surface(4, 0.25, 3);
    for scale in [1e-100, 1e100] {
        let l = cotan(&s).map(|_, _, v| scale * v);
        for id in ["LOC", "SYM", "NULL", "LIN"] {
            assert_eq!(status(id, s.clone(), &l), Status::Holds, "{scale:e} {id}");
        }
        let [i, j] = [12, 13];
        assert_eq!(status("SYM", s.clone(), &with_scaled_entry(&l, i, j, 1.0 + 1e-12)), Status::Fails);
        assert_eq!(status("NULL", s.clone(), &with_scaled_entry(&l, i, i, 1.0 + 1e-12)), Status::Fails);
        assert_eq!(status("LIN", s.clone(), &with_scaled_entry(&l, i, j, 1.0 + 1e-11)), Status::Fails);
    }
}

#[test]
fn needles_of_any_aspect_ratio_hold_from_coordinates() {
    for exponent in 0..=8 {
        let aspect = 10f64.powi(exponent);
        for stretch in [[aspect, 1.0], [1.0, aspect]] {
            for jitter in [0.0, 0.25] {
                let s = stretched(5, jitter, 2, stretch);
                all_hold_but_energy(&s, &cotan(&s), &format!("{stretch:?} {jitter}"));
            }
        }
    }
}

#[test]
fn slivers_never_fail_from_lengths_even_by_the_naive_formula_of_heron() {
    for exponent in 0..=8 {
        let aspect = 10f64.powi(exponent);
        for seed in 0..4 {
            let s = stretched(5, 0.25, seed, [aspect, 1.0]);
            let order = shuffled(s.faces().len(), seed);
            let l = cotan_in_order(&s, Cotangents::Lengths, &order);
            if l.entries().all(|(_, _, v)| v.is_finite()) {
                none_fails(&s, &l, &format!("1e{exponent}"));
            }
        }
    }
}

#[test]
fn caps_of_any_height_never_fail() {
    // An equilateral-like triangle with a point just above the middle of an edge, and its mirror image below.
    for exponent in 0..=8 {
        let h = 10f64.powi(-exponent);
        let points = [[0.0, 0.0], [1.0, 0.1], [0.52, 0.05 + h], [0.45, 0.9], [0.4, -0.8]];
        let s = planar(&points, &[[0, 1, 2], [2, 1, 3], [0, 2, 3], [1, 0, 4]]);
        for how in [Cotangents::Coordinates, Cotangents::Lengths] {
            let l = cotan_in_order(&s, how, &[0, 1, 2, 3]);
            none_fails(&s, &l, &format!("1e-{exponent}"));
            assert!(matches!(status("POS0", s.clone(), &l), Status::Fails | Status::Undecided | Status::Holds));
        }
        all_hold(&s, &cotan(&s), &format!("1e-{exponent}"));
    }
}

#[test]
fn random_slivers_never_fail() {
    let mut numbers = Numbers(17);
    for round in 0..300 {
        let n = 4 + numbers.below(5);
        let flat = 10f64.powf(-8.0 * numbers.next());
        let radius: Vec<f64> = (0..n).map(|_| 10f64.powf(-3.0 * numbers.next())).collect();
        let turn: f64 = numbers.next();
        let angle = |k: usize| std::f64::consts::TAU * (k as f64 + turn) / n as f64;
        let ring = (0..n).map(|k| [radius[k] * angle(k).cos(), flat * radius[k] * angle(k).sin()]);
        let points: Vec<[f64; 2]> = std::iter::once([0.0, 0.0]).chain(ring).collect();
        let triangles: Vec<[usize; 3]> = (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % n]).collect();
        let s = planar(&points, &triangles);
        let order: Vec<usize> = (0..n).collect();
        for how in [Cotangents::Coordinates, Cotangents::Lengths] {
            let l = cotan_in_order(&s, how, &order);
            if l.entries().all(|(_, _, v)| v.is_finite()) {
                none_fails(&s, &l, &format!("round {round}, flatness {flat:e}"));
            }
        }
        all_hold_but_energy(&s, &cotan(&s), &format!("round {round}, flatness {flat:e}"));
    }
}

#[test]
fn a_weight_that_is_positive_on_a_sliver_is_never_called_negative() {
    for exponent in 0..=8 {
        let aspect = 10f64.powi(exponent);
        // Right triangles, stretched along their legs, stay right: every diagonal is cocircular, every other edge positive.
        let s = stretched(4, 0.0, 1, [aspect, 1.0]);
        let order: Vec<usize> = (0..s.faces().len()).collect();
        for how in [Cotangents::Coordinates, Cotangents::Lengths] {
            let l = cotan_in_order(&s, how, &order);
            let found = verdict("POS0", s.clone(), &l);
            assert_ne!(found.status(), Status::Fails, "1e{exponent}: {found:?}");
            assert_eq!(counts(&verdict("POS", s.clone(), &l)).0, 0);
        }
    }
}

#[test]
fn a_vertex_beside_a_degenerate_triangle_is_left_out_not_blamed() {
    // Vertex 4 lies on the edge 01: the triangle 0 1 4 is degenerate and skipped in the sum.
    let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 2.0], [1.0, -2.0], [1.0, 0.0]];
    let s = planar(&points, &[[0, 4, 2], [4, 1, 2], [0, 1, 4], [1, 0, 3]]);
    let l = cotan_in_order(&s, Cotangents::Coordinates, &[0, 1, 3]);
    for id in ["SYM", "NULL", "ENERGY"] {
        assert_eq!(status(id, s.clone(), &l), Status::Holds, "{id}");
    }
    for id in ["LIN", "FLUX"] {
        assert_ne!(status(id, s.clone(), &l), Status::Fails, "{id}");
    }
}

#[test]
fn the_bounds_leave_room_for_good_code_and_none_to_spare_for_poor_code() {
    // What is computed from coordinates stays below half of what rounding explains; an upper triangle from coordinates
    // under a lower one from lengths does not, and yet nothing fails.
    let mut beyond = 0;
    for seed in 0..40 {
        let flat = 10f64.powf(-4.0 * Numbers(seed).next());
        for s in [grid_surface(5, 0.49, seed), stretched(5, 0.25, seed, [1.0, flat])] {
            let order = shuffled(s.faces().len(), seed);
            let good = cotan_in_order(&s, Cotangents::Coordinates, &order);
            let poor = cotan_in_order(&s, Cotangents::Lengths, &order);
            let mixed = good.map(|i, j, v| if i < j { *v } else { poor.at(i, j) });
            for id in ["SYM", "NULL", "LIN", "FLUX"] {
                // Strong perturbations fold some of the grids over: LIN and FLUX say nothing there.
                let Some(margin) = verdict(id, s.clone(), &good).margin else { continue };
                assert!(margin < 0.5, "{id}, seed {seed}: {margin}");
                let mixed = verdict(id, s.clone(), &mixed);
                assert_ne!(mixed.status(), Status::Fails, "{id}, seed {seed}: {mixed:?}");
                beyond += usize::from(mixed.margin.unwrap() > 1.0);
            }
        }
    }
    assert!(beyond > 40, "{beyond}");
}
