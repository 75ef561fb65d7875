//! Identities between constructions.

use lapjury::domain::geometry::{self, Vec3};
use lapjury::domain::{Domain, Graph, Surface};
use lapjury::generate::Stream;
use lapjury::linalg::{Csr, factor::symmetric_eigen};
use lapjury::operator::{Operator, Signs};

use crate::{U, build, distance, meshes};

/// The stiffness matrix of linear elements from gradients: `(e_i · e_j)/4A` with the edge vectors around each triangle.
fn finite_elements(surface: &Surface) -> Csr {
    let mut entries = Vec::new();
    for f in 0..surface.faces().len() {
        let t = surface.triangle(f).unwrap();
        let edge = |k: usize| -> Vec3 { surface.point(t[(k + 2) % 3]) - surface.point(t[(k + 1) % 3]) };
        let doubled_area = edge(0).cross(&edge(1)).norm();
        for a in 0..3 {
            entries.extend((0..3).map(|b| (t[a], t[b], edge(a).dot(&edge(b)) / (2.0 * doubled_area))));
        }
    }
    let n = surface.positions().len();
    Csr::from_triplets(n, n, &entries)
}

#[test]
fn cotan_is_the_sum_of_the_element_matrices() {
    for (name, surface) in meshes::all() {
        let expected = finite_elements(&surface);
        let found = build("cotan", "", &surface.into());
        let apart = distance(found.stiffness(), &expected);
        assert!(apart < 1e-13, "{name}: {apart:e}");
    }
}

#[test]
fn the_graph_laplacian_of_a_surface_is_that_of_its_edges() {
    for (name, surface) in meshes::all() {
        let domain = Domain::from(surface);
        let graph = Domain::from(Graph::new(domain.vertex_count(), domain.edges()).unwrap());
        let l = build("graph", "", &domain);
        assert_eq!(l.stiffness(), build("graph", "", &graph).stiffness(), "{name}");
        assert_eq!(l.stiffness(), build("weighted-graph", "weights=unit", &domain).stiffness(), "{name}");
        assert_eq!(l.stiffness(), build("normalized-graph", "form=random-walk", &domain).stiffness(), "{name}");
    }
}

#[test]
fn inverse_lengths_are_weights_of_the_distances() {
    let domain = Domain::from(meshes::landscape(5, 4));
    let positions = domain.positions().unwrap();
    for (rule, power) in [("inverse-length", -1), ("inverse-squared-length", -2)] {
        let l = build("weighted-graph", &format!("weights={rule}"), &domain);
        for &[i, j] in domain.edges() {
            let length = (Vec3::from(positions[i]) - Vec3::from(positions[j])).norm();
            assert!((-l.stiffness().at(i, j) / length.powi(power) - 1.0).abs() < 20.0 * U);
        }
    }
}

#[test]
fn both_forms_of_the_normalized_laplacian_have_the_same_spectrum() {
    let domain = Domain::from(meshes::landscape(7, 4));
    for weights in ["unit", "inverse-length"] {
        let symmetric = build("normalized-graph", &format!("weights={weights}"), &domain);
        let walk = build("normalized-graph", &format!("weights={weights} form=random-walk"), &domain);
        assert_eq!(*symmetric.stiffness(), symmetric.stiffness().transpose());
        let (values, vectors) = symmetric_eigen(symmetric.stiffness()).unwrap();
        let degrees = walk.mass().unwrap().diagonal();
        assert!(values[0].abs() < 1e-13 && values[values.len() - 1] < 2.0 + 1e-13);
        for (value, vector) in values.iter().zip(&vectors) {
            // S L S v = λ v ⇔ L (S v) = λ D (S v).
            let x: Vec<f64> = vector.iter().zip(&degrees).map(|(v, d)| v / d.sqrt()).collect();
            for ((lx, x), d) in walk.stiffness().mul(&x).iter().zip(&x).zip(&degrees) {
                assert!((lx - value * d * x).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn the_three_point_family_passes_through_its_three_members() {
    for (name, surface) in meshes::all() {
        let domain = Domain::from(surface);
        for (p, id, factor) in [(0, "wachspress", 1.0), (1, "mean-value", 1.0), (2, "cotan", 2.0)] {
            let family = build("three-point", &format!("p={p}"), &domain);
            let member = build(id, "", &domain);
            let apart = distance(family.stiffness(), &member.stiffness().map(|_, _, v| factor * v));
            assert!(apart < 1e-12, "{name} p = {p}: {apart:e}");
            assert_eq!((family.signs(), member.signs()), (Signs::Exact, Signs::Exact));
            let sign = |v: f64| v.partial_cmp(&0.0);
            assert!(member.stiffness().entries().all(|(i, j, v)| sign(family.stiffness().at(i, j)) == sign(*v)));
        }
    }
}

#[test]
fn the_three_point_family_satisfies_the_star_formula() {
    let (points, faces) = meshes::jittered(11, 6);
    let domain = Domain::from(Surface::planar(&points, &faces).unwrap());
    let surface = domain.as_surface().unwrap();
    for p in [-2.5, 0.0, 0.5, 1.0, 1.7, 2.0, 3.0] {
        let l = build("three-point", &format!("p={p}"), &domain);
        for i in domain.interior() {
            // The neighbours of i in counter-clockwise order.
            let mut ring: Vec<usize> = l.stiffness().row(i).map(|(j, _)| j).filter(|&j| j != i).collect();
            let direction = |j: usize| (points[j][1] - points[i][1]).atan2(points[j][0] - points[i][0]);
            ring.sort_by(|&a, &b| direction(a).total_cmp(&direction(b)));
            let at = |k: usize| points[ring[k % ring.len()]];
            let area = |a: usize, b: usize| geometry::doubled_area(&points[i], &at(a), &at(b));
            let c =
                |k: usize| (Vec3::from(surface.positions()[ring[k % ring.len()]]) - surface.point(i)).norm().powf(p);
            let n = ring.len();
            for k in n..2 * n {
                let (before, after) = (area(k - 1, k), area(k, k + 1));
                let expected = (c(k + 1) * before - c(k) * area(k - 1, k + 1) + c(k - 1) * after) / (before * after);
                let found = -l.stiffness().at(i, ring[k % n]);
                assert!((found - expected).abs() < 1e-12 * l.stiffness().at(i, i).abs(), "p = {p}: {found} {expected}");
            }
        }
    }
}

#[test]
fn on_a_delaunay_mesh_intrinsic_delaunay_is_cotan_bit_by_bit() {
    let stream = &mut Stream::new(5, "points");
    let points: Vec<_> = (0..80).map(|_| [stream.unit(), stream.unit()]).collect();
    let flat = meshes::delaunay(&points);
    let turned = meshes::turned(&flat);
    let (mut checked, surfaces) = (0, [meshes::cube(0.3), meshes::tetrahedron(2.0), turned, flat]);
    for surface in surfaces {
        let domain = Domain::from(surface);
        for mass in ["barycentric", "voronoi", "mixed", "consistent", "unit"] {
            let delaunay = build("intrinsic-delaunay", &format!("mass={mass}"), &domain);
            let cotan = build("cotan", &format!("mass={mass}"), &domain);
            if domain.facts().surface.unwrap().delaunay == Some(true) {
                assert_eq!(delaunay.stiffness(), cotan.stiffness());
                assert_eq!(delaunay.signs(), Signs::Exact);
                assert!(distance(cotan.mass().unwrap().matrix(), delaunay.mass().unwrap().matrix()) < 16.0 * U);
                checked += 1;
            }
        }
    }
    assert_eq!(checked, 20);
}

#[test]
fn on_a_spoilt_mesh_intrinsic_delaunay_is_cotan_of_the_delaunay_mesh() {
    for seed in 0..3 {
        let (points, spoilt) = meshes::spoilt(seed, 120);
        let expected = build("cotan", "mass=mixed", &meshes::delaunay(&points).into());
        let flat = build("intrinsic-delaunay", "mass=mixed", &spoilt.clone().into());
        assert_eq!(flat.signs(), Signs::Exact);
        assert!(distance(expected.stiffness(), flat.stiffness()) < 1e-13);
        assert!(distance(expected.mass().unwrap().matrix(), flat.mass().unwrap().matrix()) < 1e-13);
        // Turned out of the plane only lengths are known; what the slivers of the spoilt mesh have lost is lost.
        let space = build("intrinsic-delaunay", "mass=mixed", &meshes::turned(&spoilt).into());
        assert_eq!(space.signs(), Signs::Rounded);
        assert!(distance(expected.stiffness(), space.stiffness()) < 1e-8);
        assert!(distance(expected.mass().unwrap().matrix(), space.mass().unwrap().matrix()) < 1e-8);
    }
}

#[test]
fn intrinsic_delaunay_has_no_negative_interior_weight_on_folded_surfaces() {
    for seed in 0..4 {
        let domain = Domain::from(meshes::bumpy_sphere(seed, 3));
        assert!(domain.facts().surface.unwrap().non_delaunay_edges > Some(0));
        let l = build("intrinsic-delaunay", "", &domain);
        let scales = l.stiffness().row_scales();
        assert!(l.stiffness().entries().all(|(i, j, v)| i == j || *v <= 32.0 * U * scales[i]));
        assert!(l.provenance().notes[0].contains("flips"), "{:?}", l.provenance().notes);
    }
}

#[test]
fn every_row_sums_to_zero_up_to_one_sum() {
    for (name, surface) in meshes::all() {
        let domain = Domain::from(surface);
        for id in ["graph", "cotan", "intrinsic-delaunay", "mean-value", "wachspress", "three-point"] {
            let l = build(id, "", &domain);
            for (i, scale) in l.stiffness().row_scales().into_iter().enumerate() {
                let (sum, terms) = l.stiffness().row(i).fold((0.0, 0), |(sum, terms), (_, v)| (sum + v, terms + 1));
                // The diagonal carries the rounding of one sum of this many terms, this sum another.
                assert!(sum.abs() <= 2.0 * f64::from(terms) * U * scale, "{id} on {name}, row {i}: {sum:e}");
            }
        }
    }
}

/// The smallest eigenvalue of the symmetric part.
fn smallest(l: &Csr) -> f64 {
    symmetric_eigen(&l.symmetric_part()).unwrap().0[0]
}

#[test]
fn the_star_of_the_docs_is_not_positive_semidefinite_without_symmetry() {
    let points = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [-2.0, 0.0], [0.0, -1.0]];
    let star = Surface::planar(&points, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]).unwrap();
    for domain in [Domain::from(star), meshes::planar(1, 6).into()] {
        for id in ["mean-value", "wachspress"] {
            let l = build(id, "", &domain);
            assert!(smallest(l.stiffness()) < -1e-3, "{id}: {}", smallest(l.stiffness()));
            assert!(distance(l.stiffness(), &l.stiffness().transpose()) > 1e-3, "{id} is not symmetric");
        }
        for id in ["cotan", "graph", "intrinsic-delaunay"] {
            assert!(smallest(build(id, "", &domain).stiffness()) > -1e-13, "{id}");
        }
    }
}

#[test]
fn renumbering_can_change_the_barycentric_mass_of_a_cocircular_mesh_but_not_stiffness_and_voronoi_mass() {
    // Ten points on the circle of radius 5 and six outside, after random flips: the way back may end at any diagonals of the ten.
    let mut points: Vec<[f64; 2]> = vec![[5.0, 0.0], [4.0, 3.0], [3.0, 4.0], [0.0, 5.0], [-3.0, 4.0], [-4.0, 3.0]];
    points.extend([[-5.0, 0.0], [-3.0, -4.0], [0.0, -5.0], [4.0, -3.0]]);
    points.extend([[6.0, 5.0], [-7.0, 1.0], [1.0, -8.0], [9.0, 1.0], [-5.0, -6.0], [-2.0, 7.0]]);
    let n = points.len();
    let stream = &mut Stream::new(298, "renumber");
    let faces = meshes::spoil(stream, &points);
    let mut barycentric = std::collections::BTreeSet::new();
    let reference = build("intrinsic-delaunay", "mass=voronoi", &Surface::planar(&points, &faces).unwrap().into());
    for _ in 0..10 {
        let mut place: Vec<usize> = (0..n).collect();
        stream.shuffle(&mut place);
        let mut moved = vec![[0.0; 2]; n];
        (0..n).for_each(|v| moved[place[v]] = points[v]);
        let renumbered: Vec<[usize; 3]> = faces.iter().map(|t| t.map(|v| place[v])).collect();
        let domain = Domain::from(Surface::planar(&moved, &renumbered).unwrap());
        let voronoi = build("intrinsic-delaunay", "mass=voronoi", &domain);
        assert!(distance(&voronoi.stiffness().submatrix(&place, &place), reference.stiffness()) < 1e-13);
        let mass = |operator: &Operator| operator.mass().unwrap().matrix().submatrix(&place, &place);
        assert!(distance(&mass(&voronoi), reference.mass().unwrap().matrix()) < 1e-13);
        let sixths = mass(&build("intrinsic-delaunay", "", &domain));
        // Coordinates are whole numbers, so six times a barycentric mass is one, too.
        barycentric.insert((0..n).map(|v| (sixths.at(v, v) * 6.0).round() as i64).collect::<Vec<_>>());
    }
    assert!(barycentric.len() > 1, "{barycentric:?}");
}
