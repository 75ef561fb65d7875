//! Forged statements about graphs and about a torus: partitions, polynomials, bases.

use lapjury::property::evidence::Fraction;
use lapjury::property::{Evidence, Statement};

use crate::operators::{laplacian, operator, rows, with};
use crate::{accepted, refused_for, too_many};

/// The complete graph with four vertices: with the sides {0, 1} and {2, 3} the smallest constant, 4/2, is attained.
fn complete() -> Vec<(usize, usize, f64)> {
    laplacian(&[(0, 1, 1.0), (0, 2, 1.0), (0, 3, 1.0), (1, 2, 1.0), (1, 3, 1.0), (2, 3, 1.0)])
}

fn below_cheeger(n: usize, entries: &[(usize, usize, f64)], side: &[usize], x: &[(usize, f64)]) -> Evidence {
    let all: Vec<usize> = (0..n).collect();
    let statement = Statement::BelowCheeger { x: x.to_vec(), side: side.to_vec() };
    Evidence::new(statement, rows(&operator(n, entries), &all))
}

const APART: [(usize, f64); 2] = [(0, 1.0), (1, -1.0)];

#[test]
fn a_partition_that_is_not_the_best_one_does_not_attain_the_constant() {
    accepted(&below_cheeger(4, &complete(), &[0, 1], &APART));
    // With the edge (0, 2) ten times as heavy the pairs {0, 2} and {1, 3} have the smaller ratio, 4/2 against 13/2.
    let heavy = laplacian(&[(0, 1, 1.0), (0, 2, 10.0), (0, 3, 1.0), (1, 2, 1.0), (1, 3, 1.0), (2, 3, 1.0)]);
    let x = [(1, 1.0), (3, -1.0)];
    accepted(&below_cheeger(4, &heavy, &[0, 2], &x));
    refused_for(&below_cheeger(4, &heavy, &[0, 1], &x), "the smallest ratio is");
}

#[test]
fn rows_that_are_not_those_of_a_laplacian_with_positive_weights_have_no_constant() {
    let of = |changes: &[(usize, usize, f64)]| below_cheeger(4, &with(complete(), changes), &[0, 1], &APART);
    // Only what stands beside the diagonal takes part in the constant.
    refused_for(&of(&[(3, 3, 4.0)]), "row 3 sums to zero");
    // Only the weight of the larger end to the smaller one takes part in the energy: here 2 and 1 in place of 1 and 1, and less energy.
    refused_for(&of(&[(0, 1, -2.0), (0, 0, 4.0)]), "ω_0,1 is a positive symmetric weight");
    let negative = laplacian(&[(0, 1, -0.5), (0, 2, 1.0), (0, 3, 1.0), (1, 2, 1.0), (1, 3, 1.0), (2, 3, 1.0)]);
    refused_for(&below_cheeger(4, &negative, &[0, 2], &APART), "ω_0,1 is a positive symmetric weight");
    let mut beyond = of(&[(3, 3, 4.0)]);
    beyond.excerpt.rows[3].entries.push((4, -1.0));
    refused_for(&beyond, "needs row 4");
}

#[test]
fn a_vector_on_other_vertices_than_those_of_the_graph_is_none_of_the_graph() {
    refused_for(&below_cheeger(4, &complete(), &[0, 1], &[(0, 1.0), (1, -1.0), (4, 7.0)]), "needs row 4");
}

#[test]
fn partitions_and_renumberings_of_large_graphs_are_not_enumerated() {
    for n in [17, 70] {
        let path: Vec<_> = (1..n).map(|k| (k - 1, k, 1.0)).collect();
        too_many(&below_cheeger(n, &laplacian(&path), &[0], &[(0, 1.0)]));
    }
    // Ten vertices without an edge, twice: x¹⁰.
    too_many(&cospectral(10, [&[], &[]], false, &[0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]));
}

fn cospectral(vertices: usize, [first, second]: [&[[usize; 2]]; 2], normalised: bool, polynomial: &[i64]) -> Evidence {
    let polynomial = polynomial.iter().map(|c| Fraction::text(c.to_string())).collect();
    let (first, second) = (first.to_vec(), second.to_vec());
    Evidence::bare(Statement::Cospectral { vertices, first, second, normalised, polynomial })
}

#[test]
fn a_polynomial_belongs_to_a_graph_with_as_many_vertices_and_edges_between_them() {
    let degree = "of a degree that is the number of vertices";
    refused_for(&cospectral(usize::MAX, [&[], &[]], false, &[]), degree);
    refused_for(&cospectral(usize::MAX, [&[], &[]], false, &[1]), degree);
    refused_for(&cospectral(2, [&[], &[]], false, &[0, 1]), degree);
    refused_for(&cospectral(1, [&[], &[]], false, &[0, 2]), degree);
    // A path of two vertices: x (x − 2).
    for bad in [[0, 2], [1, 1], [2, 0]] {
        refused_for(&cospectral(2, [&[bad], &[[0, 1]]], false, &[0, -2, 1]), "is no edge");
        refused_for(&cospectral(2, [&[[0, 1]], &[bad]], false, &[0, -2, 1]), "is no edge");
    }
    for twice in [[0, 1], [1, 0]] {
        refused_for(
            &cospectral(2, [&[[0, 1], twice], &[[0, 1]]], false, &[0, -2, 1]),
            "edge 1 of the evidence is no edge",
        );
    }
}

#[test]
fn a_walk_leaves_every_vertex() {
    refused_for(&cospectral(2, [&[], &[]], true, &[0, 0, 1]), "every vertex has a neighbour");
}

fn torus(start: [[i64; 2]; 2], flips: usize, end: [[i64; 2]; 2]) -> Evidence {
    Evidence::bare(Statement::TorusFlips { start, flips, end })
}

#[test]
fn flips_of_a_torus_start_from_a_basis_turned_to_the_left() {
    let squares = [[1, 0], [0, 1]];
    accepted(&torus(squares, 0, squares));
    // Every other point, every point from the other side, one direction alone.
    for start in [[[2, 0], [0, 1]], [[0, 1], [1, 0]], [[1, 0], [-1, 0]], [[0, 0], [0, 0]]] {
        refused_for(&torus(start, 0, start), "the edges are a positive basis of ℤ²");
    }
    // A sheared one takes a flip for each of its steps, and no fewer.
    let sheared = [[1, 0], [3, 1]];
    refused_for(&torus(sheared, 0, sheared), "after 0 flips every edge is Delaunay");
    refused_for(&torus(squares, 0, [[0, 1], [-1, 0]]), "the edges at the end are those written down");
}

#[test]
fn a_million_flips_of_a_torus_are_not_repeated() {
    let squares = [[1, 0], [0, 1]];
    too_many(&torus(squares, (1 << 20) + 1, squares));
    refused_for(&torus(squares, 1 << 20, squares), "it takes 1048576 flips");
}
