//! The rational twins: exact properties, and the distance of the f64 constructions from them.

use std::cmp::Ordering;

use lapjury::domain::geometry::cotangent;
use lapjury::domain::topology::Corner;
use lapjury::domain::{Domain, Surface};
use lapjury::laplacian::{cotan, mass, wachspress};
use lapjury::linalg::Csr;
use lapjury::operator::MassKind;
use lapjury::scalar::{Rational, Scalar};

use crate::{U, build, meshes};

const KINDS: [MassKind; 4] = [MassKind::Barycentric, MassKind::Voronoi, MassKind::Mixed, MassKind::Consistent];

fn planar_meshes() -> Vec<Surface> {
    vec![meshes::planar(1, 5), meshes::planar(2, 4), meshes::spoilt(6, 40).1, meshes::rhombus()]
}

fn coordinates(surface: &Surface) -> [Vec<Rational>; 2] {
    let positions = surface.planar_positions::<Rational>().unwrap();
    [0, 1].map(|axis| positions.iter().map(|p| p[axis].clone()).collect())
}

fn is_zero(x: &Rational) -> bool {
    x.cmp_zero() == Ordering::Equal
}

fn area(surface: &Surface) -> Rational {
    let p = surface.planar_positions::<Rational>().unwrap();
    let doubled = |f: &[usize]| lapjury::domain::geometry::doubled_area(&p[f[0]], &p[f[1]], &p[f[2]]).magnitude();
    surface.faces().iter().map(doubled).fold(Rational::zero(), |sum, a| sum + a) * Rational::half()
}

#[test]
fn linear_precision_is_exactly_zero() {
    for surface in planar_meshes() {
        let boundary = surface.topology().boundary_vertices();
        for l in [cotan::stiffness_in_plane(&surface).unwrap(), wachspress::stiffness_in_plane(&surface).unwrap()] {
            for x in coordinates(&surface) {
                let image = l.mul(&x);
                assert!(image.iter().zip(boundary).all(|(y, b)| *b || is_zero(y)));
            }
        }
    }
}

#[test]
fn the_energy_of_the_coordinates_is_exactly_the_area() {
    for surface in planar_meshes() {
        let l: Csr<Rational> = cotan::stiffness_in_plane(&surface).unwrap();
        let x = coordinates(&surface);
        for a in 0..2 {
            for b in 0..2 {
                let energy = l.mul(&x[a]).into_iter().zip(&x[b]).fold(Rational::zero(), |s, (y, x)| s + y * x.clone());
                let expected = if a == b { area(&surface) } else { Rational::zero() };
                assert!(is_zero(&(energy - expected)));
            }
        }
    }
}

#[test]
fn rows_sum_to_exactly_zero_and_every_mass_to_exactly_the_area() {
    for surface in planar_meshes() {
        let ones = vec![Rational::exactly(1.0).unwrap(); surface.positions().len()];
        for l in [cotan::stiffness_in_plane(&surface).unwrap(), wachspress::stiffness_in_plane(&surface).unwrap()] {
            assert!(l.mul(&ones).iter().all(is_zero));
        }
        for kind in KINDS {
            let m: Csr<Rational> = mass::in_plane(&surface, kind).unwrap();
            assert!(is_zero(&(m.quadratic_form(&ones) - area(&surface))), "{kind:?}");
        }
    }
}

#[test]
fn the_star_formula_gives_both_twins() {
    // ω_i = (c_{i+1} A_{i−1} − c_i B_i + c_{i−1} A_i)/(A_{i−1} A_i) with c = 1 is Wachspress, with c = r² twice cotan.
    let surface = meshes::planar(9, 4);
    let p = surface.planar_positions::<Rational>().unwrap();
    let cotan = cotan::stiffness_in_plane::<Rational>(&surface).unwrap();
    let wachspress = wachspress::stiffness_in_plane::<Rational>(&surface).unwrap();
    let domain = Domain::from(surface.clone());
    for i in domain.interior() {
        let star = surface.topology().star(i);
        let after = |corner: &Corner| corner.neighbours(surface.faces())[0];
        let before = |corner: &Corner| corner.neighbours(surface.faces())[1];
        let mut ring = vec![after(&star[0])];
        for _ in 1..star.len() {
            let last = *ring.last().unwrap();
            let next = star.iter().find(|&corner| after(corner) == last).unwrap();
            ring.push(before(next));
        }
        let n = ring.len();
        let v = |k: usize| &p[ring[k % n]];
        let bracket = |a: usize, b: usize| lapjury::domain::geometry::doubled_area(&p[i], v(a), v(b));
        let square = |k: usize| {
            let d: [Rational; 2] = std::array::from_fn(|axis| v(k)[axis].clone() - p[i][axis].clone());
            lapjury::domain::geometry::dot(&d, &d)
        };
        for k in n..2 * n {
            let (before, both, after) = (bracket(k - 1, k), bracket(k - 1, k + 1), bracket(k, k + 1));
            let product = before.clone() * after.clone();
            let with = |c: [Rational; 3]| {
                let [low, mid, high] = c;
                (high * before.clone() - mid * both.clone() + low * after.clone()) / product.clone()
            };
            let one = || Rational::exactly(1.0).unwrap();
            assert!(is_zero(&(with([one(), one(), one()]) + wachspress.at(i, ring[k % n]))));
            let squares = with([square(k - 1), square(k), square(k + 1)]);
            let double = Rational::exactly(2.0).unwrap() * cotan.at(i, ring[k % n]);
            assert!(is_zero(&(squares + double)));
        }
    }
}

/// `Σ 1/sin²` over the angles that a weight is made of.
fn condition(surface: &Surface, edge: usize, apexes: impl Fn(usize) -> [usize; 3]) -> f64 {
    let squares = surface.opposite(edge).into_iter().map(|(_, k)| {
        let [a, p, q] = apexes(k).map(|v| surface.point(v));
        1.0 + cotangent(a, p, q).powi(2)
    });
    squares.sum()
}

#[test]
fn cotan_is_within_its_bound_of_the_exact_twin_and_has_its_signs() {
    for surface in planar_meshes() {
        let exact: Csr<Rational> = cotan::stiffness_in_plane(&surface).unwrap();
        let found = build("cotan", "", &surface.clone().into());
        for (e, &[i, j]) in surface.topology().edges().iter().enumerate() {
            let difference = (exact.at(i, j) - Rational::exactly(found.stiffness().at(i, j)).unwrap()).magnitude();
            // 4u Σ 1/sin² of the cotangents, and half an ulp for the sum, which is below that again.
            let bound = 8.0 * U * condition(&surface, e, |k| [k, i, j]);
            assert!(difference.approximate() <= bound, "({i}, {j}): {:e} against {bound:e}", difference.approximate());
            assert_eq!(found.stiffness().at(i, j).cmp_zero(), exact.at(i, j).cmp_zero());
        }
    }
}

#[test]
fn wachspress_is_within_its_bound_of_the_exact_twin_and_has_its_signs() {
    for surface in planar_meshes() {
        let exact: Csr<Rational> = wachspress::stiffness_in_plane(&surface).unwrap();
        let found = build("wachspress", "", &surface.clone().into());
        for (e, &[a, b]) in surface.topology().edges().iter().enumerate() {
            for [i, j] in [[a, b], [b, a]] {
                let value = found.stiffness().at(i, j);
                let difference = (exact.at(i, j) - Rational::exactly(value).unwrap()).magnitude().approximate();
                let square = (surface.point(i) - surface.point(j)).norm_squared();
                let bound = 16.0 * U * condition(&surface, e, |k| [j, i, k]) / square;
                assert!(difference <= bound, "({i}, {j}): {difference:e} against {bound:e}");
                assert_eq!(value.cmp_zero(), exact.at(i, j).cmp_zero());
            }
        }
    }
}

#[test]
fn masses_are_near_their_exact_twins() {
    for surface in [meshes::planar(1, 5), meshes::planar(2, 4)] {
        for kind in KINDS {
            let exact: Csr<Rational> = mass::in_plane(&surface, kind).unwrap();
            let found = build("cotan", &format!("mass={}", kind.name()), &surface.clone().into());
            for (i, j, v) in found.mass().unwrap().matrix().entries() {
                let difference = (exact.at(i, j) - Rational::exactly(*v).unwrap()).magnitude().approximate();
                // Areas below 1, angles above 20°: 1/sin² < 9, some ten roundings in each of at most 8 triangles.
                assert!(difference <= 8.0 * 9.0 * 10.0 * U, "{kind:?} ({i}, {j}): {difference:e}");
            }
        }
    }
}

#[test]
fn there_is_no_twin_of_a_surface_in_space_or_of_a_degenerate_one() {
    assert!(cotan::stiffness_in_plane::<Rational>(&meshes::cube(1.0)).is_none());
    let line = Surface::planar(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], &[[0, 1, 2]]).unwrap();
    assert!(cotan::stiffness_in_plane::<Rational>(&line).is_none());
    assert!(wachspress::stiffness_in_plane::<Rational>(&line).is_none());
    assert!(mass::in_plane::<Rational>(&meshes::rhombus(), MassKind::Given).is_none());
}
