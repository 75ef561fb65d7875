//! Eigenvalue problems of triangulated polygons, `L u = λ M u` with cotangents: how many eigenvalues lie below a number, exactly.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use super::alone::lowest_terms;
use super::planar::{Planar, Upper, entry};
use super::{Answer, Rechecked, Refusal};
use crate::property::evidence::{Condition, Excerpt, Fraction, Mesh, Weighting};
use crate::scalar::{Rational, Scalar};

/// The largest number of rows that are eliminated.
const LARGEST: usize = 40;

/// What a witness says of two problems.
pub(super) struct Stated<'a> {
    /// σ.
    pub sigma: &'a Fraction,
    /// Eigenvalues below σ.
    pub below: [usize; 2],
    /// `det(L − σM)`.
    pub determinants: &'a [Fraction; 2],
}

/// Two polygons have different numbers of eigenvalues below σ.
pub(super) fn differ(meshes: [&Mesh; 2], of: (Condition, Weighting), stated: &Stated) -> Answer {
    let read = [Planar::of(meshes[0])?, Planar::of(meshes[1])?];
    read.iter().try_for_each(|mesh| mesh.outline().map(drop))?;
    if let Err(answer) = check(&read, of, stated)? {
        return Ok(answer);
    }
    if stated.below[0] != stated.below[1] {
        return Ok(Rechecked::Exact);
    }
    Err(Refusal::untrue("different numbers of eigenvalues lie below σ", format!("{} of both", stated.below[0])))
}

/// The only Delaunay triangulation has fewer eigenvalues below σ than another one of the same points.
pub(super) fn more_on_delaunay(
    excerpt: &Excerpt,
    other: &[[usize; 3]],
    of: (Condition, Weighting),
    stated: &Stated,
) -> Answer {
    let delaunay = Planar::read(excerpt)?;
    let other = delaunay.with(other)?;
    check_strictly_delaunay(&delaunay)?;
    delaunay.check_fills_the_hull()?;
    other.check_fills_the_hull()?;
    if let Err(answer) = check(&[delaunay, other], of, stated)? {
        return Ok(answer);
    }
    if stated.below[0] < stated.below[1] {
        return Ok(Rechecked::Exact);
    }
    Err(Refusal::untrue("fewer eigenvalues lie below σ on Delaunay", format!("{:?}", stated.below)))
}

/// Refuses numbers that are not those of the two problems; the inner error says why nothing was decided.
fn check(
    meshes: &[Planar; 2],
    (condition, mass): (Condition, Weighting),
    stated: &Stated,
) -> Result<Result<(), Rechecked>, Refusal> {
    let sigma = lowest_terms("sigma", 0, stated.sigma)?;
    for (k, mesh) in meshes.iter().enumerate() {
        let rows = kept(mesh, condition);
        if rows.is_empty() {
            return Err(Refusal::untrue("there is an eigenvalue problem", "no vertex is inside"));
        }
        if rows.len() > LARGEST {
            return Ok(Err(Rechecked::Open(format!("{} rows are too many for exact elimination", rows.len()))));
        }
        let (l, m) = (mesh.stiffness(), mesh.mass(mass));
        let shifted = |i: usize, j: usize| entry(&l, i, j) - sigma.clone() * entry(&m, i, j);
        let matrix = rows.iter().map(|&i| rows.iter().map(|&j| shifted(i, j)).collect()).collect();
        let Some((negative, determinant)) = signature(matrix) else {
            return Err(Refusal::untrue("σ is no eigenvalue", "it is one"));
        };
        if lowest_terms("determinant", k, &stated.determinants[k])? != determinant {
            let found = Fraction::from(&determinant).to_string();
            return Err(Refusal::untrue(format!("det(L − σM) = {}", stated.determinants[k]), found));
        }
        if negative != stated.below[k] {
            return Err(Refusal::untrue(format!("{} eigenvalues lie below σ", stated.below[k]), negative.to_string()));
        }
    }
    Ok(Ok(()))
}

/// The vertices whose rows are kept.
pub(super) fn kept(mesh: &Planar, condition: Condition) -> Vec<usize> {
    let boundary: BTreeSet<usize> = mesh.boundary().into_iter().flatten().collect();
    (0..mesh.points.len()).filter(|v| condition == Condition::Neumann || !boundary.contains(v)).collect()
}

/// A symmetric matrix over the vertices kept.
pub(super) fn restricted(matrix: &Upper, rows: &[usize]) -> Vec<Vec<Rational>> {
    rows.iter().map(|&i| rows.iter().map(|&j| entry(matrix, i, j)).collect()).collect()
}

/// The number of negative eigenvalues of a symmetric matrix and its determinant; `None` if that is zero. By congruences that
/// clear one row and column at a time; where the diagonal is zero, one row is added to another before.
fn signature(mut a: Vec<Vec<Rational>>) -> Option<(usize, Rational)> {
    let (mut negative, mut determinant) = (0, Rational::ONE);
    while !a.is_empty() {
        let n = a.len();
        let zero = |x: &Rational| x.cmp_zero() == Ordering::Equal;
        let p = match (0..n).find(|&i| !zero(&a[i][i])) {
            Some(p) => p,
            None => {
                let (p, q) = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).find(|&(i, j)| !zero(&a[i][j]))?;
                (0..n).for_each(|j| a[p][j] = a[p][j].clone() + a[q][j].clone());
                a.iter_mut().for_each(|row| row[p] = row[p].clone() + row[q].clone());
                p
            }
        };
        let row = a.swap_remove(p);
        a.iter_mut().for_each(|r| drop(r.swap_remove(p)));
        let (pivot, mut others) = (row[p].clone(), row);
        others.swap_remove(p);
        negative += usize::from(pivot.cmp_zero() == Ordering::Less);
        determinant = (determinant * pivot.clone()).reduced();
        for (r, x) in a.iter_mut().zip(&others) {
            let factor = x.clone() / pivot.clone();
            for (entry, y) in r.iter_mut().zip(&others).filter(|(_, y)| !zero(y) && !zero(x)) {
                *entry = (entry.clone() - factor.clone() * y.clone()).reduced();
            }
        }
    }
    Some((negative, determinant))
}

/// The determinant of a square matrix, by rows.
pub(super) fn determinant(mut a: Vec<Vec<Rational>>) -> Rational {
    let n = a.len();
    let mut product = Rational::ONE;
    for k in 0..n {
        let Some(p) = (k..n).find(|&i| a[i][k].cmp_zero() != Ordering::Equal) else { return Rational::ZERO };
        if p != k {
            a.swap(p, k);
            product = -product;
        }
        let (above, below) = a.split_at_mut(k + 1);
        let row = &above[k];
        product = (product * row[k].clone()).reduced();
        for other in below.iter_mut().filter(|r| r[k].cmp_zero() != Ordering::Equal) {
            let factor = (other[k].clone() / row[k].clone()).reduced();
            for j in k..n {
                if row[j].cmp_zero() != Ordering::Equal {
                    other[j] = (other[j].clone() - factor.clone() * row[j].clone()).reduced();
                }
            }
        }
    }
    product
}

/// Refuses a triangulation with a point, other than its corners, in or on the circle of a triangle.
fn check_strictly_delaunay(mesh: &Planar) -> Result<(), Refusal> {
    for &[a, b, c] in &mesh.faces {
        let others = (0..mesh.points.len()).filter(|d| ![a, b, c].contains(d));
        if let Some(d) = others.into_iter().find(|&d| mesh.incircle(a, b, c, d) >= dashu_int::IBig::ZERO) {
            let found = format!("vertex {d} is in or on that of ({a}, {b}, {c})");
            return Err(Refusal::untrue("every circle has all other points outside", found));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix<const N: usize>(entries: [[i32; N]; N]) -> Vec<Vec<Rational>> {
        entries.iter().map(|r| r.iter().map(|&x| Rational::from(x)).collect()).collect()
    }

    #[test]
    fn signatures_and_determinants_are_those_of_hand_computation() {
        // Eigenvalues −1, 1; then −1, −1, 2; then 1, 3.
        for (a, negative, product) in
            [(matrix([[0, 1], [1, 0]]), 1, -1), (matrix([[2, 1], [1, 2]]), 0, 3), (matrix([[-2, 1], [1, -2]]), 2, 3)]
        {
            assert_eq!(determinant(a.clone()), Rational::from(product));
            assert_eq!(signature(a), Some((negative, Rational::from(product))));
        }
        let a = matrix([[0, 1, 1], [1, 0, 1], [1, 1, 0]]);
        assert_eq!(signature(a.clone()), Some((2, Rational::from(2))));
        assert_eq!(determinant(a), Rational::from(2));
        assert_eq!(signature(matrix([[1, 1], [1, 1]])), None);
        assert_eq!(signature(matrix([[0, 0], [0, 0]])), None);
    }
}
