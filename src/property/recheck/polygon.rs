//! Whether a closed polygon is simple, in exact fractions.

use std::cmp::Ordering;

use crate::scalar::{Rational, Scalar};

/// A point of the plane.
pub(super) type Point = [Rational; 2];

/// The vector from q to p.
pub(super) fn minus(p: &Point, q: &Point) -> Point {
    [(p[0].clone() - q[0].clone()).reduced(), (p[1].clone() - q[1].clone()).reduced()]
}

/// Twice the signed area of the triangle `abc`.
pub(super) fn area(a: &Point, b: &Point, c: &Point) -> Rational {
    let (u, v) = (minus(b, a), minus(c, a));
    (u[0].clone() * v[1].clone() - u[1].clone() * v[0].clone()).reduced()
}

/// Whether no two sides of the polygon with these corners meet but at the corner that they share. Every pair of sides is looked at.
pub(super) fn is_simple(corners: &[Point]) -> bool {
    let n = corners.len();
    let side = |k: usize| [&corners[k], &corners[(k + 1) % n]];
    let neighbours = |k: usize| {
        // Two sides at a corner meet nowhere else unless the second runs back along the first.
        let ([a, b], c) = (side(k), side((k + 1) % n)[1]);
        let (u, v) = (minus(b, a), minus(c, b));
        let along = u[0].clone() * v[0].clone() + u[1].clone() * v[1].clone();
        area(a, b, c).cmp_zero() != Ordering::Equal || along.cmp_zero() == Ordering::Greater
    };
    let far = |i: usize, j: usize| i + 1 < j && !(i == 0 && j == n - 1);
    (0..n).all(neighbours) && (0..n).all(|i| (0..n).all(|j| !far(i, j) || are_apart(side(i), side(j))))
}

/// Whether two segments have no point in common.
fn are_apart(p: [&Point; 2], q: [&Point; 2]) -> bool {
    let side = |[a, b]: [&Point; 2], c: &Point| area(a, b, c).cmp_zero();
    let crossed = |x: Ordering, y: Ordering| x != y || x == Ordering::Equal;
    let of_p = [side(p, q[0]), side(p, q[1])];
    if of_p == [Ordering::Equal; 2] {
        return !overlap_on_a_line(p, q);
    }
    !(crossed(of_p[0], of_p[1]) && crossed(side(q, p[0]), side(q, p[1])))
}

fn overlap_on_a_line(p: [&Point; 2], q: [&Point; 2]) -> bool {
    let range = |e: [&Point; 2], axis: usize| {
        let [x, y] = e.map(|v| v[axis].clone());
        if x < y { (x, y) } else { (y, x) }
    };
    (0..2).all(|axis| {
        let ((a, b), (c, d)) = (range(p, axis), range(q, axis));
        a <= d && c <= b
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_that_cross_touch_or_run_back_are_not_simple() {
        let simple =
            |corners: &[[i32; 2]]| is_simple(&corners.iter().map(|p| p.map(Rational::from)).collect::<Vec<_>>());
        assert!(simple(&[[0, 0], [4, 0], [4, 4], [2, 1], [0, 4]]));
        assert!(simple(&[[0, 0], [2, 0], [4, 0], [0, 4]]));
        for crooked in [
            // Two sides cross.
            &[[0, 0], [4, 0], [0, 2], [3, 1]][..],
            // A corner on a side.
            &[[0, 0], [4, 0], [4, 4], [2, 0], [0, 4]],
            // A corner twice.
            &[[2, 0], [4, 0], [4, 4], [2, 0], [0, 4], [0, 0]],
            // A side that runs back along the one before, and one along another far from it.
            &[[0, 0], [4, 0], [2, 0], [0, 4]],
            &[[0, 0], [4, 0], [4, 4], [3, 0], [1, 0], [0, 4]],
            // A side without length.
            &[[0, 0], [4, 0], [4, 0], [0, 4]],
        ] {
            assert!(!simple(crooked), "{crooked:?}");
        }
    }
}
