//! Stars of a vertex at the origin with rational neighbours: weights from a choice of numbers `c_j`, and the dual face that
//! they are the edges of.
//!
//! # Definition
//! Neighbours `v_1, …, v_n` counter-clockwise around 0, `A_i = [0 v_i v_{i+1}] > 0` and `B_i = [0 v_{i−1} v_{i+1}]` twice signed
//! areas. For any numbers `c_i` let `d_i` be the point with `d_i·v_i = c_i` and `d_i·v_{i+1} = c_{i+1}`: the polygon of the `d_i` has
//! its `i`-th edge on the line `x·v_i = c_i`, orthogonal to the spoke, and that edge is
//! ```text
//! d_i − d_{i−1} = ω_i J v_i,    ω_i = (c_{i+1} A_{i−1} − c_i B_i + c_{i−1} A_i)/(A_{i−1} A_i),    J(x, y) = (−y, x)
//! ```
//! so that ω_i is the signed length of the dual edge over that of the spoke, and `Σ ω_i v_i = 0` says that the polygon closes.

use std::cmp::Ordering;

use super::triangulations::Triangulation;
use crate::generate::Stream;
use crate::scalar::{Rational, Scalar};

/// A point with rational coordinates.
pub type Place = [Rational; 2];

/// The neighbours of a vertex at the origin, counter-clockwise, consecutive ones less than half a turn apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Star {
    /// The neighbours.
    pub spokes: Vec<Place>,
    /// A root of the length of each: `|v| = root^q`, or `|v|² = root`, as the maker says.
    pub roots: Vec<Rational>,
}

/// `[0 a b]`, twice the signed area.
pub fn turn(a: &Place, b: &Place) -> Rational {
    a[0].clone() * b[1].clone() - a[1].clone() * b[0].clone()
}

fn minus(a: &Place, b: &Place) -> Place {
    [a[0].clone() - b[0].clone(), a[1].clone() - b[1].clone()]
}

/// `a·b`.
pub fn dot(a: &Place, b: &Place) -> Rational {
    a[0].clone() * b[0].clone() + a[1].clone() * b[1].clone()
}

/// An integer power of what is not zero.
pub fn power(x: &Rational, exponent: i64) -> Rational {
    let magnitude = (0..exponent.unsigned_abs()).fold(Rational::ONE, |product, _| product * x.clone());
    if exponent < 0 { Rational::ONE / magnitude } else { magnitude }.reduced()
}

impl Star {
    /// The star of an interior vertex of a triangulation, moved to the origin; the roots are the squared lengths. With the
    /// numbers of the neighbours.
    pub fn of(t: &Triangulation, vertex: usize) -> Option<(Self, Vec<usize>)> {
        let sides: Vec<[usize; 2]> = t
            .faces()
            .iter()
            .filter_map(|f| f.iter().position(|&v| v == vertex).map(|k| [f[(k + 1) % 3], f[(k + 2) % 3]]))
            .collect();
        let mut ring = vec![sides.first()?[0]];
        while ring.len() < sides.len() {
            let last = ring[ring.len() - 1];
            ring.push(sides.iter().find(|s| s[0] == last)?[1]);
        }
        let relative = |v: usize, axis: usize| Rational::from(t.points()[v][axis] - t.points()[vertex][axis]);
        let spokes: Vec<Place> = ring.iter().map(|&v| [relative(v, 0), relative(v, 1)]).collect();
        let roots = spokes.iter().map(|v| dot(v, v)).collect();
        sides.iter().any(|s| s[1] == ring[0]).then_some((Star { spokes, roots }, ring))
    }

    /// A random star of 3 to 7 spokes with lengths that are `q`-th powers of rational numbers; `None` where two neighbours are
    /// half a turn apart or more.
    pub fn random(q: i64, stream: &mut Stream) -> Option<Self> {
        let count = 3 + stream.below(5);
        let mut tangents: Vec<i64> = (0..count).map(|_| stream.below(97) as i64 - 48).collect();
        tangents.sort_unstable();
        tangents.dedup();
        let mut star = Star { spokes: Vec::new(), roots: Vec::new() };
        for k in tangents {
            let root = Rational::from_parts((2 + stream.below(5) as i64).into(), 4u8.into());
            star.push(&Rational::from_parts(k.into(), 16u8.into()), &root, q);
        }
        star.is_proper().then_some(star)
    }

    /// Adds a spoke of length `root^q` in the direction whose half angle has this tangent.
    pub fn push(&mut self, tangent: &Rational, root: &Rational, q: i64) {
        let square = tangent.clone() * tangent.clone();
        let scale = power(root, q) / (Rational::ONE + square.clone());
        let two = Rational::from(2);
        self.spokes
            .push([((Rational::ONE - square) * scale.clone()).reduced(), (two * tangent.clone() * scale).reduced()]);
        self.roots.push(root.clone());
    }

    fn len(&self) -> usize {
        self.spokes.len()
    }

    fn at(&self, k: usize) -> &Place {
        &self.spokes[k % self.len()]
    }

    /// Whether there are three spokes or more and every one turns left to the next by less than half a turn.
    pub fn is_proper(&self) -> bool {
        self.len() >= 3 && (0..self.len()).all(|k| turn(self.at(k), self.at(k + 1)).cmp_zero() == Ordering::Greater)
    }

    /// Whether the neighbours are the corners of a strictly convex polygon around the origin.
    pub fn is_convex(&self) -> bool {
        let left = |k: usize| {
            let (a, b, c) = (self.at(k), self.at(k + 1), self.at(k + 2));
            turn(&minus(b, a), &minus(c, b)).cmp_zero() == Ordering::Greater
        };
        self.is_proper() && (0..self.len()).all(left)
    }

    /// The numbers `c_i = root^exponent`.
    pub fn numbers(&self, exponent: i64) -> Vec<Rational> {
        self.roots.iter().map(|root| power(root, exponent)).collect()
    }

    /// The weights `ω_i` of the numbers `c_i`, by the formula in areas.
    pub fn weights(&self, c: &[Rational]) -> Vec<Rational> {
        let n = self.len();
        let weight = |i: usize| {
            let (before, here, after) = (self.at(i + n - 1), self.at(i), self.at(i + 1));
            let (previous, next) = (turn(before, here), turn(here, after));
            let numerator = c[(i + 1) % n].clone() * previous.clone() - c[i].clone() * turn(before, after)
                + c[(i + n - 1) % n].clone() * next.clone();
            (numerator / (previous * next)).reduced()
        };
        (0..n).map(weight).collect()
    }

    /// The corners `d_i` of the dual face of the numbers `c_i`.
    pub fn dual_face(&self, c: &[Rational]) -> Vec<Place> {
        let corner = |i: usize| {
            let (v, w) = (self.at(i), self.at(i + 1));
            let (a, b, area) = (&c[i], &c[(i + 1) % self.len()], turn(v, w));
            let solve = |x: Rational| (x / area.clone()).reduced();
            [
                solve(a.clone() * w[1].clone() - b.clone() * v[1].clone()),
                solve(b.clone() * v[0].clone() - a.clone() * w[0].clone()),
            ]
        };
        (0..self.len()).map(corner).collect()
    }

    /// The signed length of each edge of a closed polygon over that of the spoke it is orthogonal to; `None` where some edge is
    /// not orthogonal to its spoke. The polygon's first corner lies between the first two spokes.
    pub fn ratios(&self, polygon: &[Place]) -> Option<Vec<Rational>> {
        let n = self.len();
        let ratio = |i: usize| {
            let (edge, spoke) = (minus(&polygon[i], &polygon[(i + n - 1) % n]), self.at(i));
            let orthogonal = dot(&edge, spoke).cmp_zero() == Ordering::Equal;
            orthogonal.then(|| (turn(spoke, &edge) / dot(spoke, spoke)).reduced())
        };
        (0..n).map(ratio).collect()
    }

    /// `Σ ω_i v_i`.
    pub fn moment(&self, weights: &[Rational]) -> Place {
        let along = |axis: usize| {
            let terms = self.spokes.iter().zip(weights).map(|(v, w)| v[axis].clone() * w.clone());
            crate::scalar::sum(terms)
        };
        [along(0), along(1)]
    }

    /// In words.
    pub fn describe(&self) -> String {
        let point = |v: &Place| format!("({}, {})", v[0].clone().reduced(), v[1].clone().reduced());
        format!("the vertex (0, 0) with neighbours {}", self.spokes.iter().map(point).collect::<Vec<_>>().join(" "))
    }
}

/// Whether both coordinates are zero.
pub fn is_origin(p: &Place) -> bool {
    p.iter().all(|x| x.cmp_zero() == Ordering::Equal)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(x: f64) -> Rational {
        Rational::exactly(x).unwrap()
    }

    fn star(points: &[[f64; 2]]) -> Star {
        let spokes: Vec<Place> = points.iter().map(|p| p.map(number)).collect();
        let roots = spokes.iter().map(|v| dot(v, v)).collect();
        Star { spokes, roots }
    }

    #[test]
    fn the_square_has_the_square_as_dual_face() {
        let square = star(&[[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]);
        let ones = square.numbers(0);
        let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(|p| p.map(number));
        assert_eq!(square.dual_face(&ones), corners);
        assert_eq!(square.weights(&ones), vec![number(2.0); 4]);
        assert_eq!(square.ratios(&corners), Some(vec![number(2.0); 4]));
        assert!(square.is_convex());
    }

    #[test]
    fn a_reflex_corner_is_no_convex_polygon_and_half_a_turn_no_star() {
        assert!(!star(&[[3.0, 0.0], [0.5, 0.5], [0.0, 3.0], [-1.0, -1.0]]).is_convex());
        assert!(star(&[[3.0, 0.0], [0.5, 0.5], [0.0, 3.0], [-1.0, -1.0]]).is_proper());
        assert!(!star(&[[1.0, 0.0], [-1.0, 0.0], [0.0, -1.0]]).is_proper());
        assert!(!star(&[[1.0, 0.0], [0.0, 1.0]]).is_proper());
    }

    #[test]
    fn random_stars_have_the_lengths_that_they_promise() {
        let mut stream = Stream::new(1, "stars");
        let mut made = 0;
        for _ in 0..200 {
            let Some(star) = Star::random(3, &mut stream) else { continue };
            made += 1;
            for (v, root) in star.spokes.iter().zip(&star.roots) {
                assert_eq!(dot(v, v), power(root, 6));
            }
        }
        assert!(made > 20, "{made}");
    }

    #[test]
    fn a_polygon_with_a_slanted_edge_is_no_dual_face() {
        let square = star(&[[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]);
        let slanted = [[1.0, 1.5], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(|p| p.map(number));
        assert_eq!(square.ratios(&slanted), None);
    }
}
