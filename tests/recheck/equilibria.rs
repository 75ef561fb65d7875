//! Forged statements about lifts, equilibria and motions of a planar triangulation.

use lapjury::domain::{Domain, Surface};
use lapjury::property::evidence::Fraction;
use lapjury::property::recheck::{Rechecked, against};
use lapjury::property::{Evidence, Excerpt, Statement};

use crate::operators::operator;
use crate::{accepted, refused_for};

type Numbers = Vec<([usize; 2], Fraction)>;

fn number(x: i64) -> Fraction {
    Fraction::text(x.to_string())
}

fn on(edges: &[[usize; 2]], numbers: &[i64]) -> Numbers {
    edges.iter().copied().zip(numbers.iter().copied().map(number)).collect()
}

fn excerpt(points: &[[i64; 2]], faces: &[[usize; 3]]) -> Excerpt {
    let place = |(v, p): (usize, &[i64; 2])| (v, [p[0] as f64, p[1] as f64, 0.0]);
    Excerpt {
        positions: points.iter().enumerate().map(place).collect(),
        faces: faces.iter().map(|f| f.to_vec()).enumerate().collect(),
        ..Excerpt::default()
    }
}

const SQUARE: [[i64; 2]; 5] = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 1]];
const FAN: [[usize; 3]; 4] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
const SPOKES: [[usize; 2]; 4] = [[0, 4], [1, 4], [2, 4], [3, 4]];

fn square() -> Excerpt {
    excerpt(&SQUARE, &FAN)
}

fn weights(excerpt: Excerpt, weights: Numbers) -> Evidence {
    Evidence::new(Statement::Equilibrium { weights }, excerpt)
}

/// The square's corners lifted by 1: the jump of the gradient across a spoke is as long as the spoke.
fn lift(heights: &[(usize, i64)], weights: Numbers) -> Evidence {
    let heights = heights.iter().map(|&(v, h)| (v, number(h))).collect();
    Evidence::new(Statement::Lift { heights, weights }, square())
}

const HEIGHTS: [(usize, i64); 5] = [(0, 1), (1, 1), (2, 1), (3, 1), (4, 0)];

/// A triangle in one three times as large, twisted: inner corner 3 + i is joined to the outer ones i and i + 1.
fn twisted() -> Excerpt {
    let inner = [[2, -1], [-1, 2], [-1, -1]];
    let points: Vec<[i64; 2]> = inner.iter().map(|p| p.map(|x| 3 * x)).chain(inner).collect();
    let ring = (0..3).flat_map(|i| {
        let j = (i + 1) % 3;
        [[3 + i, i, j], [3 + i, j, 3 + j]]
    });
    excerpt(&points, &[[3, 4, 5]].into_iter().chain(ring).collect::<Vec<_>>())
}

/// The edges with an inner end, and how fast they lengthen when the inner triangle turns back.
fn rates() -> Numbers {
    let edges = [[0, 3], [0, 5], [1, 3], [1, 4], [2, 4], [2, 5], [3, 4], [3, 5], [4, 5]];
    on(&edges, &[0, 9, 9, 0, 9, 0, 0, 0, 0])
}

fn turn() -> Vec<(usize, [Fraction; 2])> {
    [(3, [-1, -2]), (4, [2, 1]), (5, [-1, 1])].map(|(v, y)| (v, y.map(number))).into()
}

fn motion(excerpt: Excerpt, motion: Vec<(usize, [Fraction; 2])>, rates: Numbers) -> Evidence {
    Evidence::new(Statement::Motion { motion, rates }, excerpt)
}

fn no_lift(excerpt: Excerpt, beside: bool, multipliers: &[(usize, usize, i64)]) -> Evidence {
    let multipliers = multipliers.iter().map(|&(f, v, x)| (f, v, number(x))).collect();
    Evidence::new(Statement::NoLift { beside, multipliers }, excerpt)
}

/// The outer corner i must be above the plane through 3 + i, i + 1, 4 + i, so higher than i + 1 where the inner triangle is at 0:
/// around the circle that cannot be.
const AROUND: [(usize, usize, i64); 3] = [(2, 0, 1), (4, 1, 1), (6, 2, 1)];

#[test]
fn what_is_forged_here_is_right_but_for_one_thing() {
    accepted(&weights(square(), on(&SPOKES, &[1, 1, 1, 1])));
    accepted(&lift(&HEIGHTS, on(&SPOKES, &[1, 1, 1, 1])));
    accepted(&motion(twisted(), turn(), rates()));
    accepted(&no_lift(twisted(), true, &AROUND));
    accepted(&no_lift(twisted(), false, &AROUND));
}

#[test]
fn a_triangulation_lies_flat_with_two_faces_at_an_edge() {
    let with = |more: &[[i64; 2]], faces: &[[usize; 3]]| {
        let excerpt = excerpt(&[&SQUARE[..], more].concat(), &[&FAN[..], faces].concat());
        weights(excerpt, on(&SPOKES, &[1, 1, 1, 1]))
    };
    accepted(&with(&[[1, -1]], &[[1, 0, 5]]));
    let third = "as a third one, or turned against the one beside";
    refused_for(&with(&[[1, -1], [1, 3]], &[[1, 0, 5], [0, 1, 6]]), third);
    refused_for(&with(&[[1, 3]], &[[0, 1, 5]]), third);
    // Folded over the side, or on it.
    for apex in [[1, 1], [1, 0]] {
        refused_for(&with(&[apex], &[[1, 0, 5]]), "all triangles turn the same way");
    }
    let numbered = |numbers: [usize; 4]| {
        let mut excerpt = square();
        numbers.iter().zip(&mut excerpt.faces).for_each(|(number, face)| face.0 = *number);
        weights(excerpt, on(&SPOKES, &[1, 1, 1, 1]))
    };
    refused_for(&numbered([0, 1, 2, 4]), "faces numbered from 0");
    refused_for(&numbered([1, 0, 2, 3]), "faces numbered from 0");
}

#[test]
fn a_part_of_a_triangulation_says_nothing_about_all_of_it() {
    let domain: Domain = Surface::planar(&SQUARE.map(|p| p.map(|x| x as f64)), &FAN).unwrap().into();
    let operator = operator(5, &[]);
    let whole = weights(square(), on(&SPOKES, &[1, 1, 1, 1]));
    assert_eq!(against(&whole, "", &domain, &operator), Ok(Rechecked::Exact));
    // Without a face no vertex is left inside, and nothing to balance.
    let part = weights(excerpt(&SQUARE, &FAN[..3]), Vec::new());
    accepted(&part);
    let refusal = against(&part, "", &domain, &operator).unwrap_err().to_string();
    assert!(refusal.contains("every face, of which there are 4"), "{refusal}");
}

#[test]
fn weights_are_positive_in_balance_and_one_for_each_edge() {
    let of = |numbers: &[i64]| weights(square(), on(&SPOKES, numbers));
    // Opposite spokes balance each other whatever their sign.
    refused_for(&of(&[1, -1, 1, -1]), "the weight of (1, 4) is positive");
    refused_for(&of(&[0, 1, 0, 1]), "the weight of (0, 4) is positive");
    refused_for(&of(&[1, 1, 2, 1]), "= 0 at vertex 4");
    let listed = |edges: &[[usize; 2]]| weights(square(), on(edges, &[1; 5]));
    refused_for(&listed(&[[0, 4], [1, 4], [2, 4], [3, 4], [0, 1]]), "stands on no edge");
    refused_for(&listed(&[[0, 4], [1, 4], [2, 4], [3, 4], [3, 4]]), "is given twice");
    refused_for(&listed(&[[0, 4], [2, 4]]), "the number of the edge from vertex 1");
}

#[test]
fn the_weights_of_a_lift_follow_from_its_heights() {
    let right = || on(&SPOKES, &[1, 1, 1, 1]);
    refused_for(&lift(&HEIGHTS, on(&SPOKES, &[2, 2, 2, 2])), "the weight of (0, 4) is 2");
    refused_for(&lift(&[&HEIGHTS[..], &[(4, 0)]].concat(), right()), "height 5 of the evidence is given twice");
    refused_for(&lift(&HEIGHTS[..4], right()), "the height of vertex 4");
    // Upside down.
    refused_for(
        &lift(&HEIGHTS.map(|(v, h)| (v, -h)), on(&SPOKES, &[-1, -1, -1, -1])),
        "the weight of (0, 4) is positive",
    );
}

#[test]
fn a_motion_keeps_the_boundary_in_place_shortens_no_edge_and_lengthens_one() {
    let with = |more: (usize, [i64; 2])| [turn(), vec![(more.0, more.1.map(number))]].concat();
    refused_for(&motion(twisted(), with((5, [-1, 1])), rates()), "motion 3 of the evidence is given twice");
    refused_for(&motion(twisted(), with((6, [0, 0])), rates()), "moves a vertex that is not an interior one");
    // A corner of the square may be drawn out of it, and anything may stay.
    let corner = vec![(0, [-1, -1].map(number))];
    refused_for(&motion(square(), corner, on(&SPOKES, &[2, 0, 0, 0])), "moves a vertex that is not an interior one");
    refused_for(&motion(square(), Vec::new(), on(&SPOKES, &[0, 0, 0, 0])), "some edge is lengthened");
    let aside = vec![(4, [1, 0].map(number))];
    refused_for(&motion(square(), aside, on(&SPOKES, &[1, -1, -1, 1])), "edge (1, 4) is not shortened");
    let backwards = turn().into_iter().map(|(v, [a, b])| (v, [a, b].map(|x| number(-(x.approximate() as i64)))));
    refused_for(&motion(twisted(), backwards.collect(), rates()), "the rate of (0, 5) is 9");
}

#[test]
fn conditions_on_heights_are_about_a_face_and_a_vertex_off_it() {
    let more = |beside: bool, condition: (usize, usize, i64)| {
        no_lift(twisted(), beside, &[&AROUND[..], &[condition]].concat())
    };
    refused_for(&more(false, (7, 0, 0)), "names a face that is not there");
    refused_for(&more(false, (0, 6, 0)), "names a vertex that is not one off its face");
    refused_for(&more(false, (2, 0, 0)), "is given twice");
    // A condition on a corner of the face itself says 0 > 0.
    refused_for(&no_lift(square(), false, &[(0, 0, 1)]), "names a vertex that is not one off its face");
    // Vertex 2 is beyond the faces beside (3, 0, 1).
    accepted(&more(false, (1, 2, 0)));
    refused_for(&more(true, (1, 2, 0)), "is not opposite in a face beside");
}

#[test]
fn conditions_on_heights_add_up_with_multipliers_that_are_not_negative() {
    // Both say that the corners 0 and 2 of the square are higher than the middle.
    refused_for(&no_lift(square(), false, &[(0, 2, 1), (1, 0, -1)]), "multiplier 1 of the evidence is negative");
    refused_for(&no_lift(square(), false, &[(0, 2, 0), (1, 0, 0)]), "some multiplier is positive");
    refused_for(&no_lift(square(), false, &[]), "some multiplier is positive");
    refused_for(&no_lift(square(), false, &[(0, 2, 1), (1, 0, 1)]), "cancels");
}
