//! Two polygons that are not congruent, with one eigenvalue problem: `X_B R = S X_A`.

use std::cmp::Ordering;

use dashu_int::IBig;

use super::alone::lowest_terms;
use super::eigenvalues::{determinant, kept, restricted};
use super::planar::Planar;
use super::{Answer, Rechecked, Refusal};
use crate::property::evidence::{Condition, Fraction, Mesh, Weighting};
use crate::scalar::{Rational, Scalar};

/// The largest number of rows whose products are formed.
const LARGEST: usize = 80;

type Entries = [(usize, usize, Fraction)];

/// The stiffness and both masses are intertwined, R is invertible, the polygons are not congruent.
pub(super) fn decide(
    meshes: [&Mesh; 2],
    condition: Condition,
    [matrix, dual]: [&Entries; 2],
    outlines: &[Vec<u64>; 2],
) -> Answer {
    let [a, b] = [Planar::of(meshes[0])?, Planar::of(meshes[1])?];
    let rows = [kept(&a, condition), kept(&b, condition)];
    let n = rows[0].len();
    if rows[1].len() != n || n == 0 {
        return Err(Refusal::untrue(
            "both problems have the same number of rows",
            format!("{n} and {}", rows[1].len()),
        ));
    }
    if n > LARGEST {
        return Ok(Rechecked::Open(format!("{n} rows are too many to be multiplied exactly")));
    }
    let r = read(matrix, &rows)?;
    let s = read(dual, &rows)?;
    if condition == Condition::Dirichlet && r != s {
        return Err(Refusal::untrue("under Dirichlet S is R", "it is another matrix"));
    }
    let masses = [Weighting::Barycentric, Weighting::Consistent];
    let of = |mesh: &Planar, k: usize| if k == 0 { mesh.stiffness() } else { mesh.mass(masses[k - 1]) };
    for k in 0..3 {
        let (x_a, x_b) = (restricted(&of(&a, k), &rows[0]), restricted(&of(&b, k), &rows[1]));
        if product(&x_b, &r) != product(&s, &x_a) {
            let what = ["the stiffness", "the barycentric mass", "the consistent mass"][k];
            return Err(Refusal::untrue(format!("X_B R = S X_A for {what}"), "not so"));
        }
    }
    if determinant(r).cmp_zero() == Ordering::Equal {
        return Err(Refusal::untrue("R is invertible", "its determinant is zero"));
    }
    let found = [outline(&a)?, outline(&b)?];
    for (stated, found) in outlines.iter().zip(&found) {
        if !same_cycle(&stated.iter().map(|x| IBig::from(*x)).collect::<Vec<_>>(), found) {
            return Err(Refusal::untrue(
                format!("the polygon has the squared lengths {stated:?}"),
                format!("{found:?}"),
            ));
        }
    }
    if same_cycle(&found[0], &found[1]) {
        return Err(Refusal::untrue("the lengths of the sides tell the polygons apart", "they do not"));
    }
    Ok(Rechecked::Exact)
}

/// A matrix from its entries, by the rows of the problem.
fn read(entries: &Entries, rows: &[Vec<usize>; 2]) -> Result<Vec<Vec<Rational>>, Refusal> {
    let n = rows[0].len();
    let mut matrix = vec![vec![Rational::ZERO; n]; n];
    for (index, (i, j, text)) in entries.iter().enumerate() {
        let value = lowest_terms("entry", index, text)?;
        let (Ok(i), Ok(j)) = (rows[1].binary_search(i), rows[0].binary_search(j)) else {
            return Err(Refusal::Malformed { what: "entry", index, problem: "is of no row or column of the problem" });
        };
        if matrix[i][j] != Rational::ZERO || value == Rational::ZERO {
            return Err(Refusal::Malformed { what: "entry", index, problem: "is zero, or given twice" });
        }
        matrix[i][j] = value;
    }
    Ok(matrix)
}

fn product(a: &[Vec<Rational>], b: &[Vec<Rational>]) -> Vec<Vec<Rational>> {
    let n = a.len();
    let mut c = vec![vec![Rational::ZERO; n]; n];
    for (row, sums) in a.iter().zip(&mut c) {
        for (x, other) in row.iter().zip(b).filter(|(x, _)| **x != Rational::ZERO) {
            for (sum, y) in sums.iter_mut().zip(other).filter(|(_, y)| **y != Rational::ZERO) {
                *sum = (sum.clone() + x.clone() * y.clone()).reduced();
            }
        }
    }
    c
}

/// The squared lengths of the sides of the boundary polygon in their order, straight corners left out.
fn outline(mesh: &Planar) -> Result<Vec<IBig>, Refusal> {
    let cycle = mesh.outline()?;
    let n = cycle.len();
    let side = |k: usize| {
        let [p, q] = [k, k + 1].map(|k| &mesh.points[cycle[k % n]]);
        [&q[0] - &p[0], &q[1] - &p[1]]
    };
    let dot = |u: &[IBig; 2], v: &[IBig; 2]| &u[0] * &v[0] + &u[1] * &v[1];
    let is_corner = |k: usize| {
        let (u, v) = (side(k + n - 1), side(k));
        &u[0] * &v[1] != &u[1] * &v[0] || dot(&u, &v) <= IBig::ZERO
    };
    let corners: Vec<usize> = (0..n).filter(|&k| is_corner(k)).collect();
    let length = |at: usize| {
        let [p, q] = [corners[at], corners[(at + 1) % corners.len()]].map(|k| &mesh.points[cycle[k]]);
        let u = [&q[0] - &p[0], &q[1] - &p[1]];
        dot(&u, &u)
    };
    Ok((0..corners.len()).map(length).collect())
}

/// Whether two lists are the same up to where they start and their sense, as those of congruent polygons are.
fn same_cycle(a: &[IBig], b: &[IBig]) -> bool {
    let n = a.len();
    let same = |start: usize, back: bool| {
        let place = |k: usize| if back { start + n - k } else { start + k };
        (0..n).all(|k| a[k] == b[place(k) % n])
    };
    n == b.len() && (0..n).any(|start| same(start, false) || same(start, true))
}
