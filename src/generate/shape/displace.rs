//! Random displacements that fold no face.

use std::cmp::Ordering;

use crate::domain::geometry;
use crate::generate::Stream;

/// A point uniformly in the unit ball of dimension D, by rejection from the cube.
pub fn in_ball<const D: usize>(stream: &mut Stream) -> [f64; D] {
    loop {
        let p: [f64; D] = std::array::from_fn(|_| stream.between(-1.0, 1.0));
        if geometry::dot(&p, &p) <= 1.0 {
            return p;
        }
    }
}

/// Moves points of the plane so that no triangle changes its orientation (exact predicate): as long as one does, the
/// displacement of each of its corners is halved, and is dropped after [`HALVINGS`] times. Deterministic. A triangle that
/// is degenerate at first is not looked at.
pub fn unfolded(base: &[[f64; 2]], mut shift: Vec<[f64; 2]>, triangles: &[[usize; 3]]) -> Vec<[f64; 2]> {
    let turn = |at: &[[f64; 2]], t: &[usize; 3]| geometry::orient2d(at[t[0]], at[t[1]], at[t[2]]);
    let proper: Vec<_> =
        triangles.iter().map(|t| (t, turn(base, t))).filter(|(_, turn)| *turn != Ordering::Equal).collect();
    let place = |v: usize, shift: &[[f64; 2]]| [base[v][0] + shift[v][0], base[v][1] + shift[v][1]];
    let mut moved: Vec<[f64; 2]> = (0..base.len()).map(|v| place(v, &shift)).collect();
    let mut halvings = vec![0; base.len()];
    loop {
        let mut folded = false;
        for (t, before) in &proper {
            if turn(&moved, t) != *before {
                folded = true;
                for &v in *t {
                    halvings[v] += 1;
                    let factor = if halvings[v] > HALVINGS { 0.0 } else { 0.5 };
                    shift[v] = shift[v].map(|x| factor * x);
                    moved[v] = place(v, &shift);
                }
            }
        }
        if !folded {
            return moved;
        }
    }
}

/// 2⁻⁶⁰ of a displacement of the order of an edge is below the rounding of the edge's coordinates.
const HALVINGS: usize = 60;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_displacement_that_would_fold_a_triangle_is_halved_until_it_does_not() {
        let base = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        // Moving the last point by (0, −3t) keeps the triangle upright for t < 1/3.
        let moved = unfolded(&base, vec![[0.0; 2], [0.0; 2], [0.0, -3.0]], &[[0, 1, 2]]);
        assert_eq!(moved[2], [0.0, 0.25]);
        let far = unfolded(&base, vec![[0.0; 2], [0.0; 2], [0.0, -1e300]], &[[0, 1, 2]]);
        assert_eq!(far[2], [0.0, 1.0]);
    }

    #[test]
    fn points_of_the_ball_fill_it_evenly() {
        let mut stream = Stream::new(1, "ball");
        let inner = (0..4000).filter(|_| {
            let p = in_ball::<3>(&mut stream);
            geometry::dot(&p, &p) < 0.25
        });
        // The ball of half the radius has an eighth of the volume: 500 ± 5 standard deviations of √(4000 · ⅛ · ⅞) ≈ 21.
        assert!((395..605).contains(&inner.count()));
    }
}
