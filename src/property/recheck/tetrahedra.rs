//! The two triangulations of five points of space and the Dirichlet energy on each.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use dashu_int::IBig;

use super::alone::{check_exact, fraction, whole_positions};
use super::flips::read_values;
use super::{Answer, Rechecked, Refusal};
use crate::property::evidence::Excerpt;
use crate::scalar::{Rational, Scalar};

type Point = [IBig; 3];

/// The tetrahedra named are the two triangulations, the first is strictly Delaunay, and the energies are as stated, the first
/// one larger.
pub(super) fn decide(excerpt: &Excerpt, named: [&[[usize; 4]]; 2], values: &[f64], energies: &[String; 2]) -> Answer {
    let points = whole_positions(&excerpt.positions)?;
    let Ok(points) = <[Point; 5]>::try_from(points) else {
        return Err(Refusal::untrue("there are five points", excerpt.positions.len().to_string()));
    };
    if !excerpt.faces.is_empty() {
        return Err(Refusal::untrue("there are no faces", "there are"));
    }
    let u = read_values(values, 5)?;
    let two = triangulations(&points)?;
    let sorted = |tets: &[[usize; 4]]| tets.iter().map(|t| sorted(*t)).collect::<BTreeSet<_>>();
    let [delaunay, other] = named.map(sorted);
    let whole = named[0].len() == delaunay.len() && named[1].len() == other.len();
    let both = [delaunay.clone(), other.clone()];
    if !whole || (both != two && [both[1].clone(), both[0].clone()] != two) {
        return Err(Refusal::untrue("the tetrahedra are the two triangulations", format!("those are {two:?}")));
    }
    for tet in &delaunay {
        let rest = (0..5).find(|v| !tet.contains(v)).unwrap_or(0);
        let inside = signed(&points, *tet) * in_sphere(&points, *tet, rest);
        if inside >= IBig::ZERO {
            let found = format!("point {rest} is not outside the sphere through {tet:?}");
            return Err(Refusal::untrue("the first triangulation alone is Delaunay", found));
        }
    }
    let [first, second] = [delaunay, other].map(|tets| energy(&points, &tets, &u));
    check_exact("the energy on the Delaunay triangulation", &energies[0], &first)?;
    check_exact("the energy on the other", &energies[1], &second)?;
    if (first - second).cmp_zero() == Ordering::Greater {
        return Ok(Rechecked::Exact);
    }
    Err(Refusal::untrue("the energy on the Delaunay triangulation is larger", energies.join(" against ")))
}

fn sorted(mut t: [usize; 4]) -> [usize; 4] {
    t.sort_unstable();
    t
}

/// Five points have one affine dependency w (up to a factor) unless all are coplanar; leaving out each point with w > 0 in
/// turn gives one triangulation, leaving out each with w < 0 the other (Radon, Lawson). Each uses every point if there are two
/// signs of either kind at least.
fn triangulations(points: &[Point; 5]) -> Result<[BTreeSet<[usize; 4]>; 2], Refusal> {
    let without = |k: usize| -> [usize; 4] { std::array::from_fn(|m| if m < k { m } else { m + 1 }) };
    let w: [IBig; 5] = std::array::from_fn(|k| {
        let d = signed(points, without(k));
        if k % 2 == 0 { d } else { -d }
    });
    let of = |sign: Ordering| -> BTreeSet<[usize; 4]> {
        (0..5).filter(|&k| w[k].cmp(&IBig::ZERO) == sign).map(without).collect()
    };
    let two = [of(Ordering::Greater), of(Ordering::Less)];
    if two.iter().any(|t| t.len() < 2) {
        return Err(Refusal::untrue("five points have two triangulations that use them all", "they have not"));
    }
    Ok(two)
}

fn minus(p: &Point, q: &Point) -> Point {
    std::array::from_fn(|k| &p[k] - &q[k])
}

fn dot(p: &Point, q: &Point) -> IBig {
    &p[0] * &q[0] + &p[1] * &q[1] + &p[2] * &q[2]
}

fn cross(p: &Point, q: &Point) -> Point {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        &p[i] * &q[j] - &p[j] * &q[i]
    })
}

/// Six times the signed volume.
fn signed(points: &[Point; 5], [a, b, c, d]: [usize; 4]) -> IBig {
    let [u, v, w] = [b, c, d].map(|p| minus(&points[p], &points[a]));
    dot(&u, &cross(&v, &w))
}

/// Positive iff e is inside the sphere through a positively oriented tetrahedron: minus the determinant of the rows
/// `(p − e, |p − e|²)`, expanded along the squares.
fn in_sphere(points: &[Point; 5], [a, b, c, d]: [usize; 4], e: usize) -> IBig {
    let [p, q, r, s] = [a, b, c, d].map(|v| minus(&points[v], &points[e]));
    let triple = |x: &Point, y: &Point, z: &Point| dot(x, &cross(y, z));
    dot(&p, &p) * triple(&q, &r, &s) - dot(&q, &q) * triple(&p, &r, &s) + dot(&r, &r) * triple(&p, &q, &s)
        - dot(&s, &s) * triple(&p, &q, &r)
}

/// `½ Σ_T |T| |∇u|²`. With D six times the volume of T, `D ∇u = Σ u_k n_k` where n_k is the cross product of the two sides of the
/// face opposite k that points inwards; so a tetrahedron has the energy `|Σ u_k n_k|² / (12 |D|)`.
fn energy(points: &[Point; 5], tets: &BTreeSet<[usize; 4]>, u: &[Rational]) -> Rational {
    let mut total = Rational::zero();
    for tet in tets {
        let volume = signed(points, *tet);
        let mut gradient = [Rational::zero(), Rational::zero(), Rational::zero()];
        for k in 0..4 {
            let [p, q, r] = std::array::from_fn(|m| tet[(k + 1 + m) % 4]);
            let normal = cross(&minus(&points[q], &points[p]), &minus(&points[r], &points[p]));
            let height = dot(&normal, &minus(&points[tet[k]], &points[p]));
            let sign = Rational::from(if height > IBig::ZERO { IBig::ONE } else { -IBig::ONE });
            for (g, n) in gradient.iter_mut().zip(normal) {
                *g = g.clone() + sign.clone() * u[tet[k]].clone() * Rational::from(n);
            }
        }
        let square = gradient.into_iter().fold(Rational::zero(), |s, g| s + g.clone() * g);
        let twelfth = if volume > IBig::ZERO { volume } else { -volume } * IBig::from(12);
        total = (total + square * fraction(IBig::ONE, twelfth)).reduced();
    }
    total
}
