//! Forged statements about flips, about positive extensions and about five points of space, exact in every number.

use lapjury::linalg::Dense;
use lapjury::property::evidence::{Flip, Fraction, Row};
use lapjury::property::{Evidence, Excerpt, Statement};
use lapjury::scalar::{Rational, Scalar};

use crate::polygons::stiffness;
use crate::{accepted, refused_for, too_many};

fn whole(x: i64) -> Rational {
    Rational::from(x)
}

/// In lowest terms.
fn written(x: &Rational) -> String {
    Fraction::from(x).to_string()
}

fn excerpt(points: &[[i64; 2]], faces: &[[usize; 3]]) -> Excerpt {
    Excerpt {
        positions: points.iter().map(|p| [p[0] as f64, p[1] as f64, 0.0]).enumerate().collect(),
        faces: faces.iter().map(|f| f.to_vec()).enumerate().collect(),
        ..Excerpt::default()
    }
}

/// κ of a flip, from `L_before − L_after = κ w wᵀ` at the first corner.
fn kappa(points: &[[i64; 2]], [a, b, c, d]: [usize; 4]) -> Rational {
    let change = stiffness(points, &[[a, b, c], [a, c, d]]).at(a, a).clone()
        - stiffness(points, &[[a, b, d], [b, c, d]]).at(a, a).clone();
    let cross = |p: usize, q: usize, r: usize| {
        let [u, v] = [q, r].map(|x| [points[x][0] - points[p][0], points[x][1] - points[p][1]]);
        whole(u[0] * v[1] - u[1] * v[0])
    };
    change / (cross(b, c, d) * cross(b, c, d))
}

/// Flips from one triangulation to another, with the function that is v at vertex v.
fn flipped(points: &[[i64; 2]], faces: &[[usize; 3]], flips: &[[usize; 4]]) -> Evidence {
    let mut now = faces.to_vec();
    let u: Vec<Rational> = (0..points.len() as i64).map(whole).collect();
    let energy = |faces: &[[usize; 3]]| (stiffness(points, faces).quadratic_form(&u) / whole(2)).approximate();
    let mut energies = vec![energy(&now)];
    for &[a, b, c, d] in flips {
        let of = |f: &[usize; 3], t: [usize; 3]| t.iter().all(|v| f.contains(v));
        now.retain(|f| !of(f, [a, b, c]) && !of(f, [a, c, d]));
        now.extend([[a, b, d], [b, c, d]]);
        energies.push(energy(&now));
    }
    let flip = |quad: &[usize; 4]| Flip { quad: *quad, kappa: written(&kappa(points, *quad)) };
    let statement = Statement::FlipsToDelaunay {
        flips: flips.iter().map(flip).collect(),
        end: now,
        values: (0..points.len()).map(|v| v as f64).collect(),
        energies,
    };
    Evidence::new(statement, excerpt(points, faces))
}

const RHOMBUS: [[i64; 2]; 4] = [[0, 0], [3, -1], [6, 0], [3, 1]];
const SHORT: [[usize; 3]; 2] = [[0, 1, 3], [1, 2, 3]];
const LONG: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

#[test]
fn flips_go_down_all_the_way_to_delaunay() {
    accepted(&flipped(&RHOMBUS, &LONG, &[[0, 1, 2, 3]]));
    accepted(&flipped(&RHOMBUS, &SHORT, &[]));
    refused_for(&flipped(&RHOMBUS, &LONG, &[]), "the circle of every triangle is empty");
    // Up and down again.
    refused_for(&flipped(&RHOMBUS, &SHORT, &[[3, 0, 1, 2], [0, 1, 2, 3]]), "κ of flip 0 is positive");
    // A square is Delaunay either way.
    let square = [[0, 0], [1, 0], [1, 1], [0, 1]];
    refused_for(&flipped(&square, &LONG, &[[0, 1, 2, 3]]), "κ of flip 0 is positive");
}

#[test]
fn what_is_flipped_is_the_diagonal_of_a_strictly_convex_quadrilateral() {
    // Three corners on a line: the face that the flip would make has no area.
    let mut straight = flipped(&RHOMBUS, &LONG, &[[0, 1, 2, 3]]);
    let points = [[0, 0], [3, 0], [6, 0], [3, 3]];
    straight.excerpt = excerpt(&points, &[[0, 1, 3], [1, 2, 3]]);
    let Statement::FlipsToDelaunay { flips, energies, .. } = &mut straight.statement else { unreachable!() };
    flips[0].quad = [1, 2, 3, 0];
    let u: Vec<Rational> = (0..4).map(whole).collect();
    energies[0] = (stiffness(&points, &SHORT).quadratic_form(&u) / whole(2)).approximate();
    refused_for(&straight, "is not of a strictly convex quadrilateral");
}

#[test]
fn a_part_of_the_delaunay_triangulation_is_not_reached_by_flips() {
    let points = [[0, 0], [4, 0], [5, 4], [0, 5], [2, 2]];
    let fan = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
    accepted(&flipped(&points, &fan, &[]));
    refused_for(&flipped(&points, &fan[..3], &[]), "the triangles fill the convex hull");
}

#[test]
fn values_and_positions_are_whole_numbers_in_the_plane_and_numbered_throughout() {
    let right = flipped(&RHOMBUS, &LONG, &[[0, 1, 2, 3]]);
    let changed = |change: &dyn Fn(&mut Excerpt)| {
        let mut evidence = right.clone();
        change(&mut evidence.excerpt);
        evidence
    };
    // Read as whole numbers these would be the ones that all the rest is right for.
    refused_for(&changed(&|e| e.positions[2].1[0] = 6.5), "position 2 of the evidence is no whole number");
    refused_for(&changed(&|e| e.positions[2].1[2] = 1.0), "position 2 of the evidence is not in the plane");
    refused_for(&changed(&|e| e.positions[3].0 = 4), "needs position 3");
    refused_for(&changed(&|e| e.faces[1].0 = 2), "needs face 1");
    refused_for(&changed(&|e| e.faces[1].1.push(1)), "face 1 of the evidence is no triangle");
    let mut evidence = right.clone();
    let Statement::FlipsToDelaunay { values, .. } = &mut evidence.statement else { unreachable!() };
    values[3] = 3.25;
    refused_for(&evidence, "value 3 of the evidence is no whole number");
    // Sums of numbers beyond 2⁴⁰ need not be exact.
    let far = |x: i64| RHOMBUS.map(|p| [p[0] + x, p[1]]);
    accepted(&flipped(&far((1 << 40) - 6), &LONG, &[[0, 1, 2, 3]]));
    refused_for(&flipped(&far((1 << 40) - 5), &LONG, &[[0, 1, 2, 3]]), "is no whole number of moderate size");
    for count in [3, 5] {
        let mut evidence = right.clone();
        let Statement::FlipsToDelaunay { values, .. } = &mut evidence.statement else { unreachable!() };
        values.resize(count, 0.0);
        refused_for(&evidence, "there are 4 values");
    }
}

/// A statement that the extension from the boundary of this fan is positive, with the weight of the edge (i, j).
fn extended(points: &[[i64; 2]], faces: &[[usize; 3]], boundary: usize, [i, j]: [usize; 2]) -> Evidence {
    let n = points.len();
    let l = stiffness(points, faces);
    let (inside, rim): (Vec<usize>, Vec<usize>) = ((boundary..n).collect(), (0..boundary).collect());
    let minus = |a: Dense<Rational>| Dense::from_fn(a.rows(), a.columns(), |i, j| -a.at(i, j).clone());
    let extension = l.submatrix(&inside, &inside).solve(&minus(l.submatrix(&inside, &rim))).unwrap();
    let entries = (0..inside.len()).flat_map(|r| (0..rim.len()).map(move |c| (r, c)));
    let smallest = entries.map(|(r, c)| extension.at(r, c).clone()).min().unwrap();
    let row = |i: usize| {
        let entries = (0..n).map(|j| (j, l.at(i, j).clone().approximate())).filter(|e| e.1 != 0.0);
        Row { row: i, entries: entries.collect() }
    };
    let weight = written(&-l.at(i, j).clone());
    let excerpt = Excerpt { rows: (0..n).map(row).collect(), ..excerpt(points, faces) };
    Evidence::new(Statement::PositiveExtension { i, j, weight, smallest: written(&smallest) }, excerpt)
}

const FAN: [[usize; 3]; 4] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
const WIDE: [[i64; 2]; 5] = [[0, 0], [4, 0], [4, 2], [0, 2], [2, 1]];

#[test]
fn a_negative_weight_is_one_of_an_edge_with_an_end_inside() {
    // Opposite the long sides the angles at the centre are obtuse; the spokes have positive weights.
    let with_an_end_inside = "is an edge with an end inside, i < j";
    refused_for(&extended(&WIDE, &FAN, 4, [0, 1]), with_an_end_inside);
    refused_for(&extended(&WIDE, &FAN, 4, [4, 0]), with_an_end_inside);
    refused_for(&extended(&WIDE, &FAN, 4, [0, 2]), with_an_end_inside);
    refused_for(&extended(&WIDE, &FAN, 4, [0, 4]), "ω of the edge (0, 4) is negative");
}

#[test]
fn an_extension_that_is_negative_somewhere_is_not_positive() {
    // The long spoke to the corner 1 has obtuse angles on both sides.
    let points = [[3, -1], [6, 0], [3, 1], [-4, 4], [-4, -4], [0, 0]];
    let fan = [0, 1, 2, 3, 4].map(|k| [k, (k + 1) % 5, 5]);
    refused_for(&extended(&points, &fan, 5, [1, 5]), "every entry of the extension is positive");
}

#[test]
fn an_extension_lives_on_one_polygon_with_its_own_rows() {
    // Ears on two neighbouring sides that overlap.
    let ears = [&[[0, 0], [2, 0], [2, 2], [0, 2], [5, -1], [4, -2]][..], &[[1, 1]]].concat();
    let faces = [[0, 1, 6], [1, 2, 6], [2, 3, 6], [3, 0, 6], [1, 0, 4], [2, 1, 5]];
    refused_for(&extended(&ears, &faces, 6, [0, 6]), "the boundary is a simple polygon");
    let mut evidence = extended(&WIDE, &FAN, 4, [0, 4]);
    evidence.excerpt.rows[4].entries[0].1 = evidence.excerpt.rows[4].entries[0].1.next_up();
    refused_for(&evidence, "row 4 is that of the triangulation");
    evidence.excerpt.rows.pop();
    refused_for(&evidence, "there are 5 rows");
}

#[test]
fn an_extension_into_more_vertices_than_are_eliminated_is_left_open() {
    // Points on the long diagonal of a kite, whose last part is seen from both sides under an obtuse angle.
    let inside = 41;
    let kite = [[-30, 0], [60, -5], [90, 0], [60, 5]];
    let points: Vec<[i64; 2]> = kite.into_iter().chain((0..inside).map(|k| [k, 0])).collect();
    let first = 4;
    let last = first + inside as usize - 1;
    let mut faces = vec![[0, 1, first], [3, 0, first], [last, 1, 2], [last, 2, 3]];
    (first..last).for_each(|k| faces.extend([[k, 1, k + 1], [k, k + 1, 3]]));
    too_many(&extended(&points, &faces, first, [2, last]));
}

/// The energy of a function on tetrahedra, by its gradient on each.
fn energy(points: &[[i64; 3]; 5], tets: &[[usize; 4]], u: &[i64; 5]) -> Rational {
    let mut total = whole(0);
    for t in tets {
        let side = |k: usize, axis: usize| whole(points[t[k + 1]][axis] - points[t[0]][axis]);
        let sides = Dense::from_fn(3, 3, side);
        let rise = Dense::from_fn(3, 1, |k, _| whole(u[t[k + 1]] - u[t[0]]));
        let gradient = sides.solve(&rise).unwrap();
        let minor = |j: usize| {
            let [p, q] = [[1, 2], [2, 0], [0, 1]][j];
            side(1, p) * side(2, q) - side(1, q) * side(2, p)
        };
        let volume = (0..3).map(|j| side(0, j) * minor(j)).fold(whole(0), |s, x| s + x);
        let volume = if volume < whole(0) { -volume } else { volume };
        let square = (0..3).map(|k| gradient.at(k, 0).clone() * gradient.at(k, 0).clone()).fold(whole(0), |s, x| s + x);
        total += square * volume / whole(12);
    }
    total
}

fn in_space(points: [[i64; 3]; 5], [delaunay, other]: [&[[usize; 4]]; 2], u: [i64; 5]) -> Evidence {
    let energies = [delaunay, other].map(|tets| written(&energy(&points, tets, &u)));
    let (delaunay, other) = (delaunay.to_vec(), other.to_vec());
    let statement = Statement::DelaunayNotMinimal { delaunay, other, values: u.map(|x| x as f64).to_vec(), energies };
    let positions = points.map(|p| p.map(|x| x as f64)).into_iter().enumerate().collect();
    Evidence::new(statement, Excerpt { positions, ..Excerpt::default() })
}

/// A triangle between two points far from it: a tetrahedron on either side is Delaunay, three around the axis are not.
const BIPYRAMID: [[i64; 3]; 5] = [[4, 0, 0], [-2, 3, 0], [-2, -3, 0], [0, 0, 9], [0, 0, -9]];
const STACKED: [[usize; 4]; 2] = [[0, 1, 2, 3], [0, 1, 2, 4]];
const AROUND: [[usize; 4]; 3] = [[0, 1, 3, 4], [1, 2, 3, 4], [2, 0, 3, 4]];

#[test]
fn a_function_with_more_energy_where_it_should_have_less_is_no_witness_against_rippa() {
    // Up to an affine function there is only this one.
    let ends = [0, 0, 0, 1, 1];
    refused_for(&in_space(BIPYRAMID, [&STACKED, &AROUND], ends), "the energy on the Delaunay triangulation is larger");
    refused_for(&in_space(BIPYRAMID, [&AROUND, &STACKED], ends), "the first triangulation alone is Delaunay");
}

#[test]
fn a_witness_against_rippa_names_both_triangulations_and_nothing_else() {
    let is_one = |e: &&Evidence| matches!(e.statement, Statement::DelaunayNotMinimal { .. });
    let evidence = crate::triangulations::evidence().iter().find(is_one).unwrap();
    let Statement::DelaunayNotMinimal { delaunay, other, values, .. } = &evidence.statement else { unreachable!() };
    let points: [[i64; 3]; 5] = std::array::from_fn(|v| evidence.excerpt.positions[v].1.map(|x| x as i64));
    let u: [i64; 5] = std::array::from_fn(|v| values[v] as i64);
    accepted(&in_space(points, [delaunay, other], u));
    let mut with_a_face = evidence.clone();
    with_a_face.excerpt.faces.push((0, vec![0, 1, 2]));
    refused_for(&with_a_face, "there are no faces");
    // Without one tetrahedron, or with it twice.
    let two = "the tetrahedra are the two triangulations";
    refused_for(&in_space(points, [delaunay, &other[1..]], u), two);
    let mut twice = in_space(points, [delaunay, other], u);
    let Statement::DelaunayNotMinimal { other, .. } = &mut twice.statement else { unreachable!() };
    other.push(other[0]);
    refused_for(&twice, two);
}

#[test]
fn five_points_with_one_inside_have_one_triangulation_that_uses_them_all() {
    let points = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1], [0, 0, 0]];
    let four = [[0, 1, 2, 4], [0, 1, 3, 4], [0, 2, 3, 4], [1, 2, 3, 4]];
    refused_for(&in_space(points, [&four, &[[0, 1, 2, 3]]], [0, 0, 0, 0, 1]), "two triangulations that use them all");
}
