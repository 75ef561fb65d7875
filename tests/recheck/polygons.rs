//! Forged eigenvalue problems: of meshes that are no triangulated polygons, of too many rows or none, of matrices that are
//! not read as they are written.

use lapjury::linalg::Dense;
use lapjury::property::evidence::{Condition, Excerpt, Fraction, Mesh, Weighting};
use lapjury::property::{Evidence, Statement};
use lapjury::scalar::Rational;

use crate::{accepted, refused_for, too_many};

fn whole(x: i64) -> Rational {
    Rational::from(x)
}

fn mesh(points: &[[i64; 2]], faces: &[[usize; 3]]) -> Mesh {
    Mesh { points: points.to_vec(), faces: faces.to_vec() }
}

/// Twice the signed area, and the dot product of the sides at the first corner.
fn area_and_dot(points: &[[i64; 2]], [a, b, c]: [usize; 3]) -> [i64; 2] {
    let [u, v] = [b, c].map(|p| [points[p][0] - points[a][0], points[p][1] - points[a][1]]);
    [u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]]
}

/// The cotangent stiffness of whatever triangles there are, those turned round counted negatively.
pub fn stiffness(points: &[[i64; 2]], faces: &[[usize; 3]]) -> Dense<Rational> {
    let mut l = Dense::from_fn(points.len(), points.len(), |_, _| whole(0));
    for &[a, b, c] in faces {
        for [apex, p, q] in [[a, b, c], [b, c, a], [c, a, b]] {
            let [area, dot] = area_and_dot(points, [apex, p, q]);
            let weight = whole(dot) / whole(2 * area);
            for (i, j) in [(p, q), (q, p)] {
                l.add_to(i, i, weight.clone());
                l.add_to(i, j, -weight.clone());
            }
        }
    }
    l
}

/// The vertices inside, or all.
fn kept(mesh: &Mesh, condition: Condition) -> Vec<usize> {
    let sides: Vec<[usize; 2]> = mesh.faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    let on_boundary = |v: usize| sides.iter().any(|&[a, b]| (a == v || b == v) && !sides.contains(&[b, a]));
    (0..mesh.points.len()).filter(|&v| condition == Condition::Neumann || !on_boundary(v)).collect()
}

/// Eigenvalues of the stiffness below σ, and `det(L − σ)`.
fn below(mesh: &Mesh, condition: Condition, sigma: i64) -> (usize, Fraction) {
    let rows = kept(mesh, condition);
    let mut shifted = stiffness(&mesh.points, &mesh.faces).submatrix(&rows, &rows);
    (0..rows.len()).for_each(|i| shifted.add_to(i, i, whole(-sigma)));
    (shifted.eliminate().inertia().negative, Fraction::from(&determinant(&shifted)))
}

/// By the first row: for the few rows here.
fn determinant(a: &Dense<Rational>) -> Rational {
    let n = a.rows();
    if n == 0 {
        return whole(1);
    }
    let rest: Vec<usize> = (1..n).collect();
    let minor = |j: usize| {
        let columns: Vec<usize> = (0..n).filter(|k| *k != j).collect();
        a.at(0, j).clone()
            * determinant(&a.submatrix(&rest, &columns))
            * whole(if j.is_multiple_of(2) { 1 } else { -1 })
    };
    (0..n).map(minor).fold(whole(0), |sum, x| sum + x)
}

/// A witness that two meshes have different numbers of eigenvalues below σ, every number of it right.
fn differ(first: &Mesh, second: &Mesh, condition: Condition, sigma: i64) -> Evidence {
    let [a, b] = [first, second].map(|m| below(m, condition, sigma));
    assert_ne!(a.0, b.0);
    Evidence::bare(Statement::SpectraDiffer {
        first: first.clone(),
        second: second.clone(),
        condition,
        mass: Weighting::Unit,
        sigma: Fraction::text(sigma.to_string()),
        below: [a.0, b.0],
        determinants: [a.1, b.1],
    })
}

const SQUARE: [[i64; 2]; 5] = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 1]];
const FAN: [[usize; 3]; 4] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];

fn fan() -> Mesh {
    mesh(&SQUARE, &FAN)
}

/// Half a square: eigenvalues 0, ½ and 3/2.
fn triangle() -> Mesh {
    mesh(&[[0, 0], [1, 0], [0, 1]], &[[0, 1, 2]])
}

#[test]
fn what_is_forged_here_is_right_but_for_one_thing() {
    // The square's: 0, 1, 1, 1 and 5.
    accepted(&differ(&triangle(), &fan(), Condition::Neumann, 2));
}

#[test]
fn what_is_no_triangulated_polygon_has_no_eigenvalues() {
    let refused = |points: &[[i64; 2]], faces: &[[usize; 3]], reason: &str| {
        let (other, condition) = (mesh(points, faces), Condition::Neumann);
        let zero = Fraction::text("0");
        let tells_apart = |sigma: &i64| {
            let [a, b] = [&triangle(), &other].map(|m| below(m, condition, *sigma));
            a.0 != b.0 && a.1 != zero && b.1 != zero
        };
        let sigma = (1..100).find(tells_apart).unwrap();
        refused_for(&differ(&triangle(), &other, condition, sigma), reason);
        refused_for(&differ(&other, &triangle(), condition, sigma), reason);
    };
    let with = |more: &[[i64; 2]]| [&SQUARE[..], more].concat();
    let and = |more: &[[usize; 3]]| [&FAN[..], more].concat();
    // A vertex at no face; a face turned round; a directed edge with two faces.
    refused(&with(&[[5, 5]]), &FAN, "is at no face");
    refused(&with(&[[1, 2]]), &and(&[[0, 1, 5]]), "shares a directed edge");
    refused(&with(&[[1, 2]]), &and(&[[1, 0, 5]]), "is not counter-clockwise");
    // Apart, in one vertex, with a hole.
    refused(&with(&[[5, 0], [6, 0], [5, 1]]), &and(&[[5, 6, 7]]), "the boundary is one polygon");
    refused(&with(&[[4, 2], [2, 4]]), &and(&[[2, 5, 6]]), "the boundary is one polygon");
    let frame = [[0, 0], [6, 0], [0, 6], [1, 1], [3, 1], [1, 3]];
    let ring = [[0, 1, 3], [1, 4, 3], [1, 2, 4], [2, 5, 4], [2, 0, 5], [0, 3, 5]];
    refused(&frame, &ring, "the boundary is one polygon");
    // Two ears, on neighbouring sides, that overlap; a fan that runs around its centre and further.
    refused(&with(&[[5, -1], [4, -2]]), &and(&[[1, 0, 5], [2, 1, 6]]), "the boundary is a simple polygon");
    let around = [[0, 0], [2, 0], [0, 2], [-2, 0], [0, -2], [3, 0], [0, 3]];
    let spiral = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 6]];
    refused(&around, &spiral, "the boundary is a simple polygon");
}

#[test]
fn a_face_is_written_down_once_and_between_points_that_there_are() {
    // The numbers are those of the square without the face too many.
    let Statement::SpectraDiffer { first, second, condition, mass, sigma, below, determinants } =
        differ(&triangle(), &fan(), Condition::Neumann, 2).statement
    else {
        unreachable!()
    };
    let with = |face: [usize; 3]| {
        let mut second = second.clone();
        second.faces.push(face);
        Evidence::bare(Statement::SpectraDiffer {
            first: first.clone(),
            second,
            condition,
            mass,
            sigma: sigma.clone(),
            below,
            determinants: determinants.clone(),
        })
    };
    refused_for(&with([1, 4, 0]), "no face occurs twice");
    refused_for(&with([1, 0, 9]), "needs position 9");
    refused_for(&with([0, 4, 2]), "is not counter-clockwise");
}

#[test]
fn a_drum_without_a_vertex_inside_makes_no_sound() {
    refused_for(&differ(&triangle(), &fan(), Condition::Dirichlet, 5), "there is an eigenvalue problem");
    // Two that are not congruent, with matrices of no rows.
    let other = mesh(&[[0, 0], [2, 0], [0, 1]], &[[0, 1, 2]]);
    let outlines = [vec![1, 2, 1], vec![4, 5, 1]];
    refused_for(
        &transplanted([triangle(), other], Condition::Dirichlet, [&[], &[]], outlines),
        "the same number of rows",
    );
}

/// A strip of n points in two rows.
fn strip(n: usize) -> Mesh {
    let points: Vec<[i64; 2]> = (0..n as i64).map(|k| [k, k % 2]).collect();
    let turned = |k: usize| if k.is_multiple_of(2) { [k, k + 2, k + 1] } else { [k, k + 1, k + 2] };
    mesh(&points, &(0..n - 2).map(turned).collect::<Vec<_>>())
}

fn transplanted(
    [first, second]: [Mesh; 2],
    condition: Condition,
    [matrix, dual]: [&[(usize, usize, &str)]; 2],
    outlines: [Vec<u64>; 2],
) -> Evidence {
    let entries = |list: &[(usize, usize, &str)]| list.iter().map(|&(i, j, x)| (i, j, Fraction::text(x))).collect();
    let (matrix, dual) = (entries(matrix), entries(dual));
    Evidence::bare(Statement::Transplantation { first, second, condition, matrix, dual, outlines })
}

#[test]
fn problems_of_more_rows_than_are_eliminated_are_left_open() {
    let statement = |second: Mesh| Statement::SpectraDiffer {
        first: triangle(),
        second,
        condition: Condition::Neumann,
        mass: Weighting::Unit,
        sigma: Fraction::text("2"),
        below: [3, 0],
        determinants: [Fraction::text("-3/2"), Fraction::text("1")],
    };
    refused_for(&Evidence::bare(statement(strip(40))), "det(L − σM)");
    too_many(&Evidence::bare(statement(strip(41))));
    let sides = |n: usize| vec![2, 4, 4, n as u64];
    let of = |n: usize| transplanted([strip(n), strip(n)], Condition::Neumann, [&[], &[]], [sides(n), sides(n)]);
    refused_for(&of(80), "R is invertible");
    too_many(&of(81));
}

/// The square, and the square with an ear: one vertex inside each, with the same star.
fn with_an_ear(ears: &[[i64; 2]], faces: &[[usize; 3]]) -> [Mesh; 2] {
    [fan(), mesh(&[&SQUARE[..], ears].concat(), &[&FAN[..], faces].concat())]
}

const ONE: [(usize, usize, &str); 1] = [(4, 4, "1")];

#[test]
fn a_drum_that_lies_upon_itself_is_no_polygon() {
    let square = vec![4, 4, 4, 4];
    let one = with_an_ear(&[[5, -1]], &[[1, 0, 5]]);
    accepted(&transplanted(one, Condition::Dirichlet, [&ONE, &ONE], [square.clone(), vec![26, 10, 4, 4, 4]]));
    let two = with_an_ear(&[[5, -1], [4, -2]], &[[1, 0, 5], [2, 1, 6]]);
    let sides = vec![26, 10, 8, 20, 4, 4];
    refused_for(
        &transplanted(two, Condition::Dirichlet, [&ONE, &ONE], [square, sides]),
        "the boundary is a simple polygon",
    );
}

#[test]
fn a_matrix_has_an_entry_once_and_none_that_is_zero() {
    let of = |entries: &[(usize, usize, &str)]| {
        let sides = [vec![4, 4, 4, 4], vec![26, 10, 4, 4, 4]];
        transplanted(with_an_ear(&[[5, -1]], &[[1, 0, 5]]), Condition::Dirichlet, [entries, &ONE], sides)
    };
    refused_for(&of(&[(4, 4, "1"), (4, 4, "1")]), "entry 1 of the evidence is zero, or given twice");
    refused_for(&of(&[(4, 4, "0"), (4, 4, "1")]), "entry 0 of the evidence is zero, or given twice");
    refused_for(&of(&[(4, 4, "1"), (0, 4, "1")]), "is of no row or column of the problem");
    refused_for(&of(&[(4, 4, "2/2")]), "is no fraction in lowest terms");
}

#[test]
fn drums_with_other_numbers_of_vertices_inside_are_not_transplanted() {
    // Two vertices inside, one behind the other.
    let points = [[0, 0], [6, 0], [6, 2], [0, 2], [2, 1], [4, 1]];
    let faces = [[0, 1, 4], [1, 5, 4], [1, 2, 5], [2, 3, 5], [3, 4, 5], [3, 0, 4]];
    let pair = [fan(), mesh(&points, &faces)];
    let outlines = [vec![4, 4, 4, 4], vec![36, 4, 36, 4]];
    refused_for(
        &transplanted(pair, Condition::Dirichlet, [&[(5, 4, "1")], &[(5, 4, "1")]], outlines),
        "both problems have the same number of rows",
    );
}

#[test]
fn drums_that_are_transplanted_with_another_dual_have_no_matrix_of_their_own() {
    // Rectangles w × h fanned from the centre have the one eigenvalue 2 (1/w² + 1/h²) over a share of the area: 1² + 8² = 4² + 7².
    let rectangle = |w: i64, h: i64| mesh(&[[0, 0], [w, 0], [w, h], [0, h], [w / 2, h / 2]], &FAN);
    let pair = || [rectangle(112, 14), rectangle(28, 16)];
    let outlines = || [[112, 14], [28, 16]].map(|[w, h]: [u64; 2]| vec![w * w, h * h, w * w, h * h]);
    let dual = [(4, 4, "2/7")];
    refused_for(&transplanted(pair(), Condition::Dirichlet, [&ONE, &dual], outlines()), "under Dirichlet S is R");
    refused_for(
        &transplanted(pair(), Condition::Dirichlet, [&ONE, &ONE], outlines()),
        "X_B R = S X_A for the stiffness",
    );
}

#[test]
fn a_delaunay_triangulation_with_a_hole_is_not_the_whole_of_it() {
    // Seven points of which no four lie on a circle, two of them inside.
    let points = [[0, 0], [9, -1], [13, 6], [7, 12], [-2, 8], [4, 4], [7, 5]];
    let n = points.len();
    let inside = |[a, b, c]: [usize; 3], d: usize| {
        let row = |v: usize| [0, 1].map(|k| points[v][k] - points[d][k]);
        let [p, q, r] = [a, b, c].map(row);
        let lifted = |x: [i64; 2]| x[0] * x[0] + x[1] * x[1];
        let cross = |x: [i64; 2], y: [i64; 2]| x[0] * y[1] - x[1] * y[0];
        lifted(p) * cross(q, r) - lifted(q) * cross(p, r) + lifted(r) * cross(p, q)
    };
    let triples = (0..n).flat_map(|a| (a + 1..n).flat_map(move |b| (a + 1..n).map(move |c| [a, b, c])));
    let empty = |t: &[usize; 3]| {
        area_and_dot(&points, *t)[0] > 0 && (0..n).filter(|d| !t.contains(d)).all(|d| inside(*t, d) < 0)
    };
    let all: Vec<[usize; 3]> = triples.filter(empty).collect();
    assert_eq!(all.len(), 2 * n - 2 - 5);
    // Without a face at one of the two vertices inside only the other is left inside.
    let hole = all.iter().position(|f| f.contains(&5) && !f.contains(&6)).unwrap();
    let mut part = all.clone();
    part.remove(hole);
    let (part, other) = (mesh(&points, &part), mesh(&points, &all));
    let sigma = 20;
    let [a, b] = [&part, &other].map(|m| below(m, Condition::Dirichlet, sigma));
    assert_eq!([a.0, b.0], [1, 2]);
    let statement = Statement::DelaunayEigenvalue {
        other: all,
        condition: Condition::Dirichlet,
        mass: Weighting::Unit,
        sigma: Fraction::text(sigma.to_string()),
        below: [a.0, b.0],
        determinants: [a.1, b.1],
    };
    let excerpt = Excerpt {
        positions: points.iter().map(|p| [p[0] as f64, p[1] as f64, 0.0]).enumerate().collect(),
        faces: part.faces.iter().map(|f| f.to_vec()).enumerate().collect(),
        ..Excerpt::default()
    };
    refused_for(&Evidence::new(statement, excerpt), "the triangles fill the convex hull");
}
