//! The sign of a cotangent weight, the sum of the opposite angles, and Delaunay triangulations, decided exactly in different
//! ways.
//!
//! With `d` the dot and `c > 0` the cross product of the sides at an apex, the angle there is the argument of `d + ic`. Angles
//! add when such numbers are multiplied, so `α + β < π` exactly when `Im (d + ic)(d' + ic') > 0`. The weight is the sum
//! `½ (d/c + d'/c')`, and the in-circle predicate knows neither.

use std::cmp::Ordering;

use super::poll::{Case, Every, Search};
use super::world::excerpt::{corners, on_triangulation};
use super::world::graphs::rational;
use super::world::triangulations::{Edge, Triangulation, describe_world, world};
use super::{Experiment, Finding, Setting};
use crate::domain::geometry::{self, cotangent_in_plane, cross2, dot};
use crate::generate::Stream;
use crate::laplacian::cotan::stiffness_in_plane;
use crate::linalg::Dense;
use crate::property::Statement;
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "cotangent-sign",
    name: "The sign of a cotangent weight and the Delaunay condition",
    statement: "on an interior edge cot α + cot β has the sign of π − α − β, on a boundary edge it need not; all interior weights \
                are non-negative exactly on Delaunay triangulations, positive exactly on those without a cocircular pair",
    sources: &["wardetzky-primer", "bobenko-springborn2007"],
    parts: &[
        "sign-on-every-edge",
        "sign-on-interior-edges",
        "sign-is-the-in-circle-predicate",
        "positive-everywhere-iff-delaunay",
        "nonnegative-inside-iff-delaunay",
        "positive-inside-iff-strictly-delaunay",
        "delaunay-with-zero-weight",
        "delaunay-with-negative-boundary-weight",
    ],
    run,
};

type Point = [f64; 2];

/// An edge with its opposite vertices: `left` to the left of `ends`, `right` to the right, if there is one.
struct Wings {
    ends: [Point; 2],
    left: Point,
    right: Option<Point>,
}

impl Wings {
    fn of(t: &Triangulation, edge: &Edge) -> Self {
        let at = |v: usize| t.points()[v].map(|x| x as f64);
        Wings { ends: edge.ends.map(at), left: at(edge.left), right: edge.right.map(at) }
    }

    fn apexes(&self) -> impl Iterator<Item = Point> {
        [Some(self.left), self.right].into_iter().flatten()
    }

    /// The sign of the sum of the cotangents.
    fn weight(&self) -> Option<Ordering> {
        let [p, q] = self.ends.map(exact);
        let cotangents: Option<Vec<Rational>> = self.apexes().map(|k| cotangent_in_plane(&exact(k), &p, &q)).collect();
        Some(crate::scalar::sum(cotangents?).cmp_zero())
    }

    /// The sign of π minus the sum of the opposite angles, from the product of complex numbers.
    fn angles(&self) -> Ordering {
        let [p, q] = self.ends.map(exact);
        let mut product = [Rational::ONE, Rational::zero()];
        for apex in self.apexes().map(exact) {
            let side = |end: &[Rational; 2]| [end[0].clone() - apex[0].clone(), end[1].clone() - apex[1].clone()];
            let (u, v) = (side(&p), side(&q));
            let (d, c) = (dot(&u, &v), cross2(&u, &v).magnitude());
            let [x, y] = product;
            product = [x.clone() * d.clone() - y.clone() * c.clone(), x * c + y * d];
        }
        product[1].cmp_zero()
    }

    /// Whether the right vertex is outside (`Greater`), on or inside the circle through the other three.
    fn circle(&self) -> Option<Ordering> {
        let [p, q] = self.ends;
        Some(geometry::incircle(p, q, self.left, self.right?).reverse())
    }

    /// What the angles measured by `atan2` say; `None` where they are too close to π to tell.
    fn measured(&self) -> Option<Ordering> {
        let at = |p: Point| geometry::Vec3::new(p[0], p[1], 0.0);
        let total: f64 = self.apexes().map(|k| geometry::angle(at(k), at(self.ends[0]), at(self.ends[1]))).sum();
        let gap = std::f64::consts::PI - total;
        (gap.abs() > 1e-6).then(|| gap.cmp_zero())
    }

    fn describe(&self) -> String {
        let right = self.right.map_or("nothing".to_string(), |p| format!("{p:?}"));
        format!(
            "the edge {:?} {:?} with {:?} to its left and {right} to its right",
            self.ends[0], self.ends[1], self.left
        )
    }

    /// cot α + cot β against α + β, the angle being zero where there is no triangle.
    fn sign_differs(&self) -> bool {
        let disagrees = self.measured().is_some_and(|m| m != self.angles());
        self.weight() != Some(self.angles()) || disagrees
    }

    fn circle_differs(&self) -> bool {
        self.weight() != self.circle()
    }
}

fn exact(p: Point) -> [Rational; 2] {
    p.map(rational)
}

fn run(setting: &Setting) -> Vec<Finding> {
    let (largest, random) = (setting.pick(5, 6), setting.pick(300, 3000));
    let mut polls = Polls::default();
    for t in world(largest) {
        polls.ask_triangulation(&t);
    }
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    for _ in 0..random {
        polls.ask_pair(&random_pair(&mut stream));
        let pair = cocircular_pair(&mut stream);
        polls.ask_pair(&nudged(&pair, &mut stream));
        polls.ask_pair(&pair);
    }
    polls.answer(&describe_world(largest), random)
}

/// Two random triangles over an edge.
fn random_pair(stream: &mut Stream) -> Wings {
    loop {
        let mut point = || [stream.between(-1.0, 1.0), stream.between(-1.0, 1.0)];
        let (ends, left, right) = ([point(), point()], point(), point());
        let side = |p: Point| geometry::orient2d(ends[0], ends[1], p);
        match (side(left), side(right)) {
            (Ordering::Greater, Ordering::Less) => return Wings { ends, left, right: Some(right) },
            (Ordering::Less, Ordering::Greater) => return Wings { ends, left: right, right: Some(left) },
            _ => {}
        }
    }
}

/// Four different points among the 36 lattice points of the circle x² + y² = 65², in counter-clockwise order.
fn cocircular_pair(stream: &mut Stream) -> Wings {
    let mut circle: Vec<Point> = Vec::new();
    for x in -65_i32..=65 {
        for y in -65_i32..=65 {
            if x * x + y * y == 65 * 65 {
                circle.push([f64::from(x), f64::from(y)]);
            }
        }
    }
    circle.sort_by(|p, q| p[1].atan2(p[0]).total_cmp(&q[1].atan2(q[0])));
    let mut chosen: Vec<usize> = (0..circle.len()).collect();
    stream.shuffle(&mut chosen);
    chosen.truncate(4);
    chosen.sort_unstable();
    let [a, b, c, d] = [chosen[0], chosen[1], chosen[2], chosen[3]].map(|k| circle[k]);
    Wings { ends: [a, c], left: d, right: Some(b) }
}

/// The same pair with one coordinate of one apex changed by one unit in the last place.
fn nudged(pair: &Wings, stream: &mut Stream) -> Wings {
    let mut left = pair.left;
    let axis = stream.below(2);
    left[axis] = if stream.below(2) == 0 { left[axis].next_up() } else { left[axis].next_down() };
    Wings { ends: pair.ends, left, right: pair.right }
}

/// How a triangulation stands to the empty-circle condition: every vertex against the circumcircle of every triangle.
fn empty_circles(t: &Triangulation) -> Ordering {
    let at = |v: usize| t.points()[v].map(|x| x as f64);
    let others = |f: &[usize; 3]| (0..t.points().len()).filter(|v| !f.contains(v)).collect::<Vec<_>>();
    let inside = |f: &[usize; 3], v: usize| geometry::incircle(at(f[0]), at(f[1]), at(f[2]), at(v));
    let deepest = t.faces().iter().flat_map(|f| others(f).into_iter().map(|v| inside(f, v))).max();
    deepest.map_or(Ordering::Greater, Ordering::reverse)
}

#[derive(Default)]
struct Polls {
    every_edge: Every,
    interior_edges: Every,
    circle: Every,
    positive: Every,
    nonnegative: Every,
    strict: Every,
    zero: Search,
    boundary: Search,
}

impl Polls {
    fn ask_pair(&mut self, wings: &Wings) {
        let told = |differs: bool| differs.then(|| Case::told(wings.describe()));
        self.every_edge.ask(told(wings.sign_differs()));
        self.interior_edges.ask(told(wings.sign_differs()));
        self.circle.ask(told(wings.circle_differs()));
    }

    fn ask_triangulation(&mut self, t: &Triangulation) {
        let edges = t.edges();
        let signs: Vec<Option<Ordering>> = edges.iter().map(|e| Wings::of(t, e).weight()).collect();
        for edge in &edges {
            let wings = Wings::of(t, edge);
            if edge.right.is_some() {
                self.ask_pair(&wings);
            } else {
                self.every_edge.ask(wings.sign_differs().then(|| weight_case(t, edge)));
            }
        }
        let interior = || edges.iter().zip(&signs).filter(|(e, _)| e.right.is_some()).map(|(_, s)| *s);
        let delaunay = empty_circles(t);
        let all_positive = signs.iter().all(|s| *s == Some(Ordering::Greater));
        let exception = || {
            let at = signs.iter().position(|s| *s != Some(Ordering::Greater)).unwrap_or(0);
            weight_case(t, &edges[at])
        };
        let told = || Case::told(t.describe());
        self.positive.ask((all_positive != delaunay.is_ge()).then(exception));
        self.nonnegative.ask((interior().all(|s| s.is_some_and(Ordering::is_ge)) != delaunay.is_ge()).then(told));
        self.strict.ask((interior().all(|s| s == Some(Ordering::Greater)) != delaunay.is_gt()).then(told));
        let with_sign = |inside: bool, sign: Ordering| {
            let fits = |e: &Edge, s: Option<Ordering>| e.right.is_some() == inside && s == Some(sign);
            edges.iter().zip(&signs).find(|(e, s)| delaunay.is_ge() && fits(e, **s)).map(|(e, _)| e)
        };
        self.zero.ask(with_sign(true, Ordering::Equal).map(|e| weight_case(t, e)));
        self.boundary.ask(with_sign(false, Ordering::Less).map(|e| weight_case(t, e)));
    }

    fn answer(self, world: &str, random: usize) -> Vec<Finding> {
        let pairs = format!(
            "Cases: the edges of {world}; {random} random pairs of triangles; {random} pairs with corners on a circle, as they \
             are and with one coordinate changed in the last place."
        );
        let question = |text: &str| format!("{text} Cases: {world}.");
        vec![
            self.every_edge.answer(
                ENTRY.parts[0],
                format!("Is cot α + cot β > 0 ⇔ α + β < π on every edge, with α alone on the boundary? {pairs}"),
                "edges",
            ),
            self.interior_edges.answer(
                ENTRY.parts[1],
                format!("Has cot α + cot β the sign of π − α − β, zero included, on every interior edge? {pairs}"),
                "interior edges",
            ),
            self.circle.answer(
                ENTRY.parts[2],
                format!("Is that the sign of the in-circle predicate, positive for a vertex outside? {pairs}"),
                "interior edges",
            ),
            self.positive.answer(
                ENTRY.parts[3],
                question(
                    "Are all weights positive, boundary included, exactly when no circumcircle has a vertex inside?",
                ),
                "triangulations",
            ),
            self.nonnegative.answer(
                ENTRY.parts[4],
                question("Are all interior weights non-negative exactly when no circumcircle has a vertex inside?"),
                "triangulations",
            ),
            self.strict.answer(
                ENTRY.parts[5],
                question(
                    "Are all interior weights positive exactly when no circumcircle has a further vertex in or on it?",
                ),
                "triangulations",
            ),
            self.zero.answer(
                ENTRY.parts[6],
                question("Has some Delaunay triangulation an interior edge of weight zero?"),
                "triangulations",
            ),
            self.boundary.answer(
                ENTRY.parts[7],
                question("Has some Delaunay triangulation a boundary edge of negative weight?"),
                "triangulations",
            ),
        ]
    }
}

/// The weight of an edge, zero or negative, as a witness.
fn weight_case(t: &Triangulation, edge: &Edge) -> Case {
    let [i, j] = [edge.ends[0].min(edge.ends[1]), edge.ends[0].max(edge.ends[1])];
    let place = if edge.right.is_some() { "interior" } else { "boundary" };
    let Some(l) = stiffness_in_plane::<Rational>(&t.surface()).map(|l| Dense::from_csr(&l)) else {
        return Case::told(t.describe());
    };
    let text = format!("the {place} edge {i}–{j} of weight {} on {}", -l.at(i, j).clone(), t.describe());
    let zero = l.at(i, j).cmp_zero() == Ordering::Equal;
    let statement = Statement::Weight { i, j, zero, opposite: corners(t, edge) };
    Case::shown(text, on_triangulation(statement, t, &l, &[i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::world::triangulations::triangulations;

    fn wings(right: Option<Point>) -> Wings {
        Wings { ends: [[0.0, 0.0], [2.0, 0.0]], left: [1.0, 1.0], right }
    }

    #[test]
    fn a_right_angle_against_smaller_equal_and_larger_ones() {
        for (y, expected) in [(-2.0, Ordering::Greater), (-1.0, Ordering::Equal), (-0.5, Ordering::Less)] {
            let pair = wings(Some([1.0, y]));
            assert_eq!((pair.weight(), pair.angles(), pair.circle()), (Some(expected), expected, Some(expected)));
            assert!(!pair.sign_differs() && !pair.circle_differs());
        }
    }

    #[test]
    fn an_obtuse_boundary_angle_has_a_negative_weight_and_is_less_than_straight() {
        let flat = Wings { ends: [[0.0, 0.0], [2.0, 0.0]], left: [1.0, 0.5], right: None };
        assert_eq!((flat.weight(), flat.angles()), (Some(Ordering::Less), Ordering::Greater));
        assert!(flat.sign_differs());
    }

    #[test]
    fn the_last_place_of_a_cocircular_pair_decides_in_all_three_ways() {
        let mut stream = Stream::new(3, "test");
        for _ in 0..50 {
            let pair = cocircular_pair(&mut stream);
            assert_eq!(
                (pair.weight(), pair.angles(), pair.circle()),
                (Some(Ordering::Equal), Ordering::Equal, Some(Ordering::Equal))
            );
            let nudged = nudged(&pair, &mut stream);
            assert_eq!(nudged.weight(), Some(nudged.angles()));
            assert_eq!(nudged.weight(), nudged.circle());
        }
    }

    #[test]
    fn a_triangle_turned_the_wrong_way_is_found_by_the_circle() {
        // Both apexes on one side, one right-angled inside the circle of the other: the weight is positive all the same.
        let folded = Wings { ends: [[0.0, 0.0], [2.0, 0.0]], left: [1.0, 2.0], right: Some([1.0, 1.0]) };
        assert!(folded.circle_differs());
    }

    #[test]
    fn empty_circles_tell_the_three_kinds_of_diagonals_apart() {
        let kinds = |points: &[[i64; 2]]| triangulations(points).iter().map(empty_circles).collect::<Vec<_>>();
        assert_eq!(kinds(&[[0, 0], [1, 0], [1, 1], [0, 1]]), [Ordering::Equal, Ordering::Equal]);
        let mut kite = kinds(&[[0, 1], [1, 0], [3, 1], [1, 2]]);
        kite.sort();
        assert_eq!(kite, [Ordering::Less, Ordering::Greater]);
    }
}
