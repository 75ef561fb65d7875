//! Masses: totals, positivity, which triangles they come from.

use lapjury::domain::{Domain, Surface};
use lapjury::operator::MassKind;

use crate::{build, meshes};

const KINDS: [&str; 4] = ["barycentric", "voronoi", "mixed", "consistent"];

/// The area by Heron's formula as Kahan writes it: another way than cross products.
fn heron(surface: &Surface) -> f64 {
    let area = |f: &[usize]| {
        let side = |a: usize, b: usize| (surface.point(f[a]) - surface.point(f[b])).norm();
        let mut s = [side(0, 1), side(1, 2), side(2, 0)];
        s.sort_by(|x, y| y.total_cmp(x));
        let [a, b, c] = s;
        0.25 * ((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))).sqrt()
    };
    surface.faces().iter().map(area).sum()
}

#[test]
fn every_mass_of_every_operator_adds_up_to_the_area() {
    for (name, surface) in meshes::all() {
        let area = heron(&surface);
        let domain = Domain::from(surface);
        for id in ["cotan", "intrinsic-delaunay", "mean-value", "wachspress", "three-point"] {
            for kind in KINDS {
                let operator = build(id, &format!("mass={kind}"), &domain);
                let mass = operator.mass().unwrap();
                // Signed parts may cancel: the scale is the sum of their magnitudes.
                let scale: f64 = mass.matrix().row_scales().iter().sum();
                assert!((mass.total() - area).abs() < 1e-12 * scale, "{id} {kind} on {name}: {}", mass.total());
                assert_eq!((mass.kind().name(), mass.is_lumped()), (kind, kind != "consistent"));
            }
            let unit = build(id, "mass=unit", &domain);
            assert_eq!(unit.mass().unwrap().total(), domain.vertex_count() as f64);
        }
    }
}

#[test]
fn all_masses_but_voronoi_are_positive() {
    for (name, surface) in meshes::all() {
        for kind in ["barycentric", "mixed", "consistent", "unit"] {
            let operator = build("cotan", &format!("mass={kind}"), &surface.clone().into());
            assert!(operator.mass().unwrap().diagonal().iter().all(|m| *m > 0.0), "{kind} on {name}");
        }
    }
    let flat = Domain::from(Surface::planar(&[[-2.0, 0.0], [2.0, 0.0], [0.0, 1.0]], &[[0, 1, 2]]).unwrap());
    // Area 2, ℓ² = 16, 5, 5, cot = −¾ at the top and 2 at the base: (16·(−¾) + 5·2)/8 = −¼ and 2·10/8 = 2½.
    assert_eq!(build("cotan", "mass=voronoi", &flat).mass().unwrap().diagonal(), [-0.25, -0.25, 2.5]);
}

#[test]
fn the_consistent_mass_has_the_barycentric_one_as_row_sums() {
    for (name, surface) in meshes::all() {
        let domain = Domain::from(surface);
        let full = build("cotan", "mass=consistent", &domain);
        let lumped = build("cotan", "mass=barycentric", &domain);
        let sums = full.mass().unwrap().matrix().mul(&vec![1.0; domain.vertex_count()]);
        for (sum, m) in sums.iter().zip(lumped.mass().unwrap().diagonal()) {
            assert!((sum / m - 1.0).abs() < 1e-14, "{name}");
        }
    }
}

#[test]
fn masses_scale_with_the_square_at_extreme_scales() {
    let surface = meshes::bumpy_sphere(1, 1);
    for kind in KINDS {
        let parameters = format!("mass={kind}");
        let at_one = build("cotan", &parameters, &surface.clone().into());
        for s in [2f64.powi(332), 2f64.powi(-332)] {
            let scaled = build("cotan", &parameters, &meshes::scaled(&surface, s).into());
            let pairs = scaled.mass().unwrap().matrix().entries().zip(at_one.mass().unwrap().matrix().entries());
            assert!(pairs.into_iter().all(|((_, _, m), (_, _, n))| *m == n * s * s), "{kind} at {s:e}");
            assert_eq!(scaled.stiffness(), at_one.stiffness());
        }
    }
}

#[test]
fn graphs_have_unit_mass_and_walks_their_degrees() {
    let domain = Domain::from(meshes::rhombus());
    assert_eq!(build("graph", "", &domain).mass().unwrap().kind(), MassKind::Unit);
    let walk = build("normalized-graph", "form=random-walk", &domain);
    assert_eq!(walk.mass().unwrap().kind(), MassKind::Degree);
    assert_eq!(walk.mass().unwrap().diagonal(), [3.0, 2.0, 3.0, 2.0]);
}
