//! Entries and eigenvalues that can be written down.

use std::f64::consts::PI;

use lapjury::domain::{Domain, Graph, Surface};
use lapjury::linalg::{Csr, factor::symmetric_eigen};
use lapjury::operator::Signs;

use crate::{U, build, meshes};

const SCALES: [f64; 5] = [1.0, 1e8, 1e-8, 1e100, 1e-100];

#[test]
fn cotan_on_a_cube_is_one_on_sides_and_zero_on_diagonals_at_every_scale() {
    for s in SCALES {
        let domain = Domain::from(meshes::cube(s));
        let operator = build("cotan", "", &domain);
        assert_eq!(operator.signs(), Signs::Exact);
        for &[i, j] in domain.edges() {
            let side = (i ^ j).count_ones() == 1;
            // Vertices are numbered by their coordinates in bits: a side changes one bit. cot 45° = 1, cot 90° = 0.
            let (expected, found) = (if side { 1.0 } else { 0.0 }, -operator.stiffness().at(i, j));
            assert!((found - expected).abs() <= 8.0 * U && (side || found == 0.0), "scale {s:e}, ({i}, {j}): {found}");
        }
    }
}

#[test]
fn cotan_on_a_regular_tetrahedron_is_one_over_root_three_at_every_scale() {
    for s in SCALES {
        let l = build("cotan", "", &Domain::from(meshes::tetrahedron(s)));
        for (i, j, v) in l.stiffness().entries() {
            let expected = if i == j { 3.0 } else { -1.0 } / 3f64.sqrt();
            assert!((v - expected).abs() <= 40.0 * U, "scale {s:e}: {v}");
        }
    }
}

#[test]
fn cotan_on_the_right_grid_is_the_five_point_stencil() {
    let n = 5;
    for s in SCALES {
        let points: Vec<_> = (0..n * n).map(|k| [s * (k % n) as f64, s * (k / n) as f64]).collect();
        let faces: Vec<_> = (0..n * n - n)
            .filter(|k| k % n + 1 < n)
            .flat_map(|k| [[k, k + 1, k + n + 1], [k, k + n + 1, k + n]])
            .collect();
        let domain = Domain::from(Surface::planar(&points, &faces).unwrap());
        let l = build("cotan", "", &domain);
        for i in domain.interior() {
            let row: Vec<f64> = l.stiffness().row(i).map(|(_, v)| *v).collect();
            let stencil = [0.0, -1.0, -1.0, 4.0, -1.0, -1.0, 0.0];
            assert!(row.iter().zip(stencil).all(|(v, e)| (v - e).abs() <= 16.0 * U), "scale {s:e}: {row:?}");
        }
    }
}

#[test]
fn a_regular_star_has_the_same_weights_for_the_whole_family() {
    for n in 3..9 {
        for r in [1.0, 1e8, 1e-8, 0.3] {
            let domain = Domain::from(meshes::regular_star(n, r));
            let tan = (PI / n as f64).tan();
            // Angles at the centre are 2π/n, at the rim π/2 − π/n; the spokes have length r.
            let check = |id: &str, parameters: &str, expected: f64| {
                let l = build(id, parameters, &domain);
                for j in 1..=n {
                    let found = -l.stiffness().at(0, j);
                    assert!(
                        (found / expected - 1.0).abs() < 400.0 * U,
                        "{id} {parameters} n = {n}: {found} {expected}"
                    );
                }
            };
            check("cotan", "", tan);
            check("mean-value", "", 2.0 * tan / r);
            check("wachspress", "", 2.0 * tan / (r * r));
            for p in [-3.0, 0.0, 0.5, 1.0, 2.0, 4.0] {
                check("three-point", &format!("p={p}"), 2.0 * tan * r.powf(p - 2.0));
            }
        }
    }
}

#[test]
fn the_counterexamples_of_the_docs_are_what_they_say() {
    let rhombus = Domain::from(meshes::rhombus());
    assert_eq!(build("cotan", "", &rhombus).stiffness().at(0, 2), 0.75);
    let square = Domain::from(
        Surface::planar(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], &[[0, 1, 2], [0, 2, 3]]).unwrap(),
    );
    assert_eq!(build("graph", "", &square).stiffness().quadratic_form(&[0.0, 1.0, 1.0, 0.0]), 3.0);
    let flat = Domain::from(Surface::planar(&[[-2.0, 0.0], [2.0, 0.0], [0.0, 1.0]], &[[0, 1, 2]]).unwrap());
    assert_eq!(build("cotan", "", &flat).stiffness().at(0, 1), 0.375);
    assert!(build("wachspress", "", &flat).stiffness().at(0, 2) > 0.0);
    let delaunay = build("intrinsic-delaunay", "", &flat);
    assert_eq!(delaunay.stiffness().at(0, 1), 0.375);
    assert!(build("cotan", "mass=voronoi", &flat).mass().unwrap().diagonal()[0] < 0.0);
    let triangle = Graph::weighted(3, &[[0, 1], [1, 2], [0, 2]], &[1.0, 1.0, -0.5]).unwrap();
    let (values, _) = symmetric_eigen(build("weighted-graph", "", &triangle.into()).stiffness()).unwrap();
    // The trace is 3 and two eigenvalues vanish.
    assert!(values[0].abs() < 1e-15 && values[1].abs() < 1e-15 && (values[2] - 3.0).abs() < 1e-14, "{values:?}");
}

fn spectrum(l: &Csr) -> Vec<f64> {
    symmetric_eigen(l).unwrap().0
}

fn check_spectrum(name: &str, l: &Csr, mut expected: Vec<f64>) {
    expected.sort_by(f64::total_cmp);
    for (found, expected) in spectrum(l).iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-13, "{name}: {found} against {expected}");
    }
}

#[test]
fn graphs_have_the_spectra_of_the_textbook() {
    let n = 9;
    let path: Vec<_> = (0..n - 1).map(|k| [k, k + 1]).collect();
    let cycle: Vec<_> = (0..n).map(|k| [k, (k + 1) % n]).collect();
    let complete: Vec<_> = (0..n).flat_map(|a| (a + 1..n).map(move |b| [a, b])).collect();
    let star: Vec<_> = (1..n).map(|k| [0, k]).collect();
    let cube: Vec<_> =
        (0..8_usize).flat_map(|a| (0..3).map(move |bit| [a, a | 1 << bit])).filter(|[a, b]| a != b).collect();
    let cosines = |step: f64, count: usize| (0..count).map(move |k| 1.0 - (step * k as f64).cos());
    let with = |first: &[f64], rest: f64, count: usize| [first, &vec![rest; count - first.len()]].concat();
    let m = n as f64;
    let plain = |edges: &[[usize; 2]], n: usize| build("graph", "", &Graph::new(n, edges).unwrap().into());
    let normal = |edges: &[[usize; 2]], n: usize| build("normalized-graph", "", &Graph::new(n, edges).unwrap().into());
    check_spectrum("path", plain(&path, n).stiffness(), cosines(PI / m, n).map(|x| 2.0 * x).collect());
    check_spectrum("cycle", plain(&cycle, n).stiffness(), cosines(2.0 * PI / m, n).map(|x| 2.0 * x).collect());
    check_spectrum("complete", plain(&complete, n).stiffness(), with(&[0.0], m, n));
    check_spectrum("star", plain(&star, n).stiffness(), with(&[0.0, m], 1.0, n));
    check_spectrum("cube", plain(&cube, 8).stiffness(), vec![0.0, 2.0, 2.0, 2.0, 4.0, 4.0, 4.0, 6.0]);
    check_spectrum("normal path", normal(&path, n).stiffness(), cosines(PI / (m - 1.0), n).collect());
    check_spectrum("normal cycle", normal(&cycle, n).stiffness(), cosines(2.0 * PI / m, n).collect());
    check_spectrum("normal complete", normal(&complete, n).stiffness(), with(&[0.0], m / (m - 1.0), n));
    check_spectrum("normal star", normal(&star, n).stiffness(), with(&[0.0, 2.0], 1.0, n));
}

#[test]
fn a_doubled_obtuse_triangle_gets_the_tangents_of_its_angles() {
    // tan α = 1/3, tan β = 1/2, glued front to back: after the flip of the long side the weights are tan α and tan β, and the
    // loop at the apex weighs nothing. The loop has length 2, and the area stays 5.
    let p = vec![[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [3.0, 1.0, 0.0]];
    let domain = Domain::from(Surface::triangles(p, &[[0, 1, 2], [0, 2, 1]]).unwrap());
    let operator = build("intrinsic-delaunay", "mass=voronoi", &domain);
    let l = operator.stiffness();
    assert!((l.at(0, 2) + 1.0 / 3.0).abs() < 4.0 * U && (l.at(1, 2) + 0.5).abs() < 4.0 * U);
    assert_eq!(l.at(0, 1), 0.0);
    assert!((operator.mass().unwrap().total() - 5.0).abs() < 1e-14);
    // The two right-angled halves, doubled: a's cell is a kite with legs √10/2 and right angles, 2·½·(√10/2)²·tan α.
    assert!((operator.mass().unwrap().diagonal()[0] - 2.5 / 3.0).abs() < 1e-14);
}
