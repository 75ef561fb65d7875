//! Flips of a triangulation of the flat torus with one vertex.

use dashu_int::IBig;

use super::{Answer, Rechecked, Refusal};

type Vector = [IBig; 2];

/// More flips than this are not repeated.
const LARGEST: usize = 1 << 20;

/// Repeats the flips. The two triangles have the sides u, v and −(u + v), so at each edge the two opposite angles are the
/// same one, and the edge is violated where that angle is obtuse: at most one of the three is.
pub(super) fn decide(start: &[[i64; 2]; 2], flips: usize, end: &[[i64; 2]; 2]) -> Answer {
    if flips > LARGEST {
        return Ok(Rechecked::Open(format!("{flips} flips are too many to be repeated")));
    }
    let read = |v: [i64; 2]| v.map(IBig::from);
    let (mut u, mut v) = (read(start[0]), read(start[1]));
    // A flip keeps the determinant, so that the end is a basis if it is the one that is reached.
    let determinant = &u[0] * &v[1] - &u[1] * &v[0];
    if determinant != IBig::ONE {
        return Err(Refusal::untrue("the edges are a positive basis of ℤ²", format!("determinant {determinant}")));
    }
    for made in 0..flips {
        match flipped(&u, &v) {
            Some((p, q)) => (u, v) = (p, q),
            None => return Err(Refusal::untrue(format!("it takes {flips} flips"), format!("{made}"))),
        }
    }
    if flipped(&u, &v).is_some() {
        return Err(Refusal::untrue(format!("after {flips} flips every edge is Delaunay"), "an angle is obtuse"));
    }
    if [u.clone(), v.clone()] == end.map(read) {
        return Ok(Rechecked::Exact);
    }
    let found = format!("({}, {}), ({}, {})", u[0], u[1], v[0], v[1]);
    Err(Refusal::untrue("the edges at the end are those written down", found))
}

/// Two edges after the flip of the violated edge; `None` if there is none. With s = u + v: at the corner between the sides u and
/// v the angle of the triangle is that between u and −v, opposite s. An obtuse angle there has u·v > 0, and s becomes u − v.
fn flipped(u: &Vector, v: &Vector) -> Option<(Vector, Vector)> {
    let s: Vector = [&u[0] + &v[0], &u[1] + &v[1]];
    let obtuse = |a: &Vector, b: &Vector| &a[0] * &b[0] + &a[1] * &b[1] > IBig::ZERO;
    let negative = |a: &Vector| -> Vector { [-&a[0], -&a[1]] };
    if obtuse(u, v) {
        // The edges u, v, u − v = u + (−v): the positive basis (−v, u) has the sum u − v.
        return Some((negative(v), u.clone()));
    }
    // Opposite v is the angle between u and s turned round: u·(−s) > 0; then v = s − u becomes s + u.
    if obtuse(u, &negative(&s)) {
        return Some((u.clone(), s));
    }
    if obtuse(v, &negative(&s)) {
        return Some((s, v.clone()));
    }
    None
}
