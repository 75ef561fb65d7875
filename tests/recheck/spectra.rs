//! Forged statements about spectra: every number in them is right, and one thing that they rest on is not.

use lapjury::domain::Surface;
use lapjury::laplacian::cotan::stiffness_in_plane;
use lapjury::linalg::Dense;
use lapjury::linalg::pencil::Pencil;
use lapjury::linalg::polynomial::Polynomial;
use lapjury::property::evidence::{Condition, Excerpt, Fraction, Mesh, Weighting};
use lapjury::property::recheck::{Rechecked, from_excerpt};
use lapjury::property::{Evidence, Statement};
use lapjury::scalar::Rational;

use crate::refused_for;

fn whole(x: i64) -> Rational {
    Rational::from(x)
}

fn unit(n: usize) -> Dense<Rational> {
    Dense::from_fn(n, n, |i, j| whole(i64::from(i == j)))
}

fn mesh(points: &[[i64; 2]], faces: &[[usize; 3]]) -> Mesh {
    Mesh { points: points.to_vec(), faces: faces.to_vec() }
}

/// The pencil of the cotangent stiffness and M = I.
fn pencil(mesh: &Mesh) -> Pencil {
    let points: Vec<[f64; 2]> = mesh.points.iter().map(|p| p.map(|x| x as f64)).collect();
    let surface = Surface::planar(&points, &mesh.faces).unwrap();
    let stiffness = Dense::from_csr(&stiffness_in_plane::<Rational>(&surface).unwrap());
    Pencil::new(stiffness, unit(points.len())).unwrap()
}

/// Eigenvalues below σ, and `det(L − σ)`; `None` where that is zero.
fn below(mesh: &Mesh, sigma: &Rational) -> Option<(usize, Fraction)> {
    let shifted = pencil(mesh).shifted(sigma);
    let value = Polynomial::characteristic(&shifted).at(&Rational::ZERO);
    let determinant = if mesh.points.len() % 2 == 1 { -value } else { value };
    (determinant != Rational::ZERO).then(|| (pencil(mesh).inertia(sigma).negative, Fraction::from(&determinant)))
}

/// The first σ among the eighths below which `second` has more eigenvalues, in words of a witness.
fn more_on_the_second(first: &Mesh, second: &Mesh) -> (Fraction, [usize; 2], [Fraction; 2]) {
    (1..400)
        .map(|k| whole(k) / whole(8))
        .find_map(|sigma| {
            let (a, b) = (below(first, &sigma)?, below(second, &sigma)?);
            (a.0 < b.0).then(|| (Fraction::from(&sigma), [a.0, b.0], [a.1, b.1]))
        })
        .unwrap()
}

/// A witness that `first`, said to be Delaunay, has fewer eigenvalues below some σ than `second`, every number of it right.
fn against_rippa(first: &Mesh, second: &Mesh) -> Evidence {
    let (sigma, below, determinants) = more_on_the_second(first, second);
    let (condition, mass, other) = (Condition::Neumann, Weighting::Unit, second.faces.clone());
    let statement = Statement::DelaunayEigenvalue { other, condition, mass, sigma, below, determinants };
    let place = |p: &[i64; 2]| [p[0] as f64, p[1] as f64, 0.0];
    let excerpt = Excerpt {
        positions: first.points.iter().map(place).enumerate().collect(),
        faces: first.faces.iter().map(|f| f.to_vec()).enumerate().collect(),
        ..Excerpt::default()
    };
    Evidence { statement, excerpt }
}

const RHOMBUS: [[i64; 2]; 4] = [[0, 0], [3, -1], [6, 0], [3, 1]];
const SHORT: [[usize; 3]; 2] = [[0, 1, 3], [1, 2, 3]];
const LONG: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

#[test]
fn a_triangulation_that_is_not_delaunay_is_not_taken_for_it() {
    // By Rippa's theorem the long diagonal has the larger eigenvalues, and no more of them below any number.
    refused_for(
        &against_rippa(&mesh(&RHOMBUS, &LONG), &mesh(&RHOMBUS, &SHORT)),
        "every circle has all other points outside",
    );
}

#[test]
fn a_triangulation_with_a_hole_is_no_other_triangulation() {
    let points = [[0, 0], [4, 0], [5, 4], [0, 5], [2, 2]];
    let fan = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
    refused_for(&against_rippa(&mesh(&points, &fan), &mesh(&points, &fan[..3])), "fill the convex hull");
}

#[test]
fn as_many_eigenvalues_on_both_are_no_witness() {
    let (delaunay, other) = (mesh(&RHOMBUS, &SHORT), mesh(&RHOMBUS, &LONG));
    let sigma = whole(1) / whole(64);
    let (a, b) = (below(&delaunay, &sigma).unwrap(), below(&other, &sigma).unwrap());
    assert_eq!(a.0, b.0);
    let mut evidence = against_rippa(&other, &delaunay);
    let excerpt = Excerpt { faces: SHORT.iter().map(|f| f.to_vec()).enumerate().collect(), ..evidence.excerpt.clone() };
    evidence.excerpt = excerpt;
    evidence.statement = Statement::DelaunayEigenvalue {
        other: LONG.to_vec(),
        condition: Condition::Neumann,
        mass: Weighting::Unit,
        sigma: Fraction::from(&sigma),
        below: [a.0, b.0],
        determinants: [a.1.clone(), b.1.clone()],
    };
    refused_for(&evidence, "fewer eigenvalues lie below σ on Delaunay");
    let (condition, mass, sigma) = (Condition::Neumann, Weighting::Unit, Fraction::from(&sigma));
    let (below, determinants) = ([a.0, b.0], [a.1, b.1]);
    let statement =
        Statement::SpectraDiffer { first: delaunay, second: other, condition, mass, sigma, below, determinants };
    refused_for(&Evidence::bare(statement), "different numbers of eigenvalues");
}

/// The squared lengths of the sides of the rhombus, `scale` times as large.
fn outline(scale: u64) -> Vec<u64> {
    vec![10 * scale * scale; 4]
}

/// A statement that R = S makes one problem of the two.
fn intertwined(first: Mesh, second: Mesh, by: impl Fn(usize) -> Option<i64>, outlines: [Vec<u64>; 2]) -> Evidence {
    let entries: Vec<_> =
        (0..first.points.len()).filter_map(|v| Some((v, v, Fraction::from(&whole(by(v)?))))).collect();
    let (matrix, dual) = (entries.clone(), entries);
    let condition = Condition::Neumann;
    Evidence::bare(Statement::Transplantation { first, second, condition, matrix, dual, outlines })
}

#[test]
fn a_singular_matrix_transplants_nothing() {
    // Zero intertwines everything.
    let kite = mesh(&[[0, 0], [3, -1], [7, 0], [3, 1]], &SHORT);
    let evidence = intertwined(mesh(&RHOMBUS, &SHORT), kite, |_| None, [outline(1), vec![10, 17, 17, 10]]);
    refused_for(&evidence, "R is invertible");
}

#[test]
fn a_drum_does_not_sound_like_itself() {
    let drum = || mesh(&RHOMBUS, &SHORT);
    refused_for(&intertwined(drum(), drum(), |_| Some(1), [outline(1), outline(1)]), "tell the polygons apart");
}

#[test]
fn a_drum_twice_as_large_has_the_stiffness_and_not_the_mass() {
    let large = mesh(&RHOMBUS.map(|p| p.map(|x| 2 * x)), &SHORT);
    let evidence = intertwined(mesh(&RHOMBUS, &SHORT), large, |_| Some(1), [outline(1), outline(2)]);
    refused_for(&evidence, "X_B R = S X_A for the barycentric mass");
}

#[test]
fn a_graph_with_other_numbers_is_not_another_graph() {
    // The path of three vertices, twice: x (x − 1) (x − 3).
    let polynomial: Vec<Fraction> = [0, 3, -4, 1].map(|c| Fraction::from(&whole(c))).into();
    let of = |second: Vec<[usize; 2]>| {
        let (vertices, first, polynomial) = (3, vec![[0, 1], [1, 2]], polynomial.clone());
        Evidence::bare(Statement::Cospectral { vertices, first, second, normalised: false, polynomial })
    };
    refused_for(&of(vec![[0, 2], [1, 2]]), "not isomorphic");
    // A triangle has x (x − 3)².
    refused_for(&of(vec![[0, 1], [0, 2], [1, 2]]), "the polynomial is");
}

#[test]
fn what_is_forged_here_is_right_but_for_one_thing() {
    // The same numbers the right way round are those of a true statement: the short diagonal has more eigenvalues below σ.
    let (first, second) = (mesh(&RHOMBUS, &LONG), mesh(&RHOMBUS, &SHORT));
    let (sigma, below, determinants) = more_on_the_second(&first, &second);
    let (condition, mass) = (Condition::Neumann, Weighting::Unit);
    let statement = Statement::SpectraDiffer { first, second, condition, mass, sigma, below, determinants };
    assert_eq!(from_excerpt(&Evidence::bare(statement)), Ok(Rechecked::Exact));
}
