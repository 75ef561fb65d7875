//! Flips to Delaunay in the plane: they end, in any order, after no more flips than a sharp bound; and they reach far.
//!
//! A flip with `incircle > 0` lowers the piecewise linear lift of the triangulation to `z = x² + y²` over its quadrilateral and
//! leaves it elsewhere. So the volume below the lift falls with every flip, and the flips end; an edge that was flipped away
//! lies above the lift from then on and never comes back. Each flip takes away another edge for good, none of them is an edge
//! of the Delaunay triangulation at the end, and there are n(n−1)/2 pairs of vertices:
//! ```text
//! flips ≤ n(n−1)/2 − (3n − 3 − h),   h vertices on the hull;   (n−2)(n−3)/2 in convex position
//! ```
//! On the points (k, k²), k = 1, …, n, four of them in their order have in-circle determinants of one sign, the flips are those of
//! the Tamari lattice of the n-gon, whose longest chain has (n−2)(n−3)/2 steps: the bound is attained.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use super::poll::{Case, Every, Search};
use super::world::descent::{Descent, term};
use super::world::excerpt::on_triangulation;
use super::world::triangulations::{
    Edge, Point, Triangulation, describe_world, doubled_area, point_sets, sweep, triangulations,
};
use super::{Experiment, Finding, Setting};
use crate::domain::{Domain, flip};
use crate::generate::{self, Stream};
use crate::laplacian::cotan::stiffness_in_plane;
use crate::linalg::Dense;
use crate::property::{Evidence, Statement};
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "flips-in-the-plane",
    name: "Flips to Delaunay in the plane",
    statement: "every sequence of flips that each lower the lift ends in a Delaunay triangulation, all with the same cotangent \
                operator, after at most n(n−1)/2 − (3n − 3 − h) flips, which is sharp; the new edges join vertices any number of \
                edges apart",
    sources: &["wardetzky-primer", "lawson1977", "delaunay1934"],
    parts: &[
        "every-flip-lowers-the-lift",
        "every-sequence-ends-delaunay",
        "same-operator-in-any-order",
        "ties-leave-a-choice",
        "within-the-bound",
        "bound-is-attained",
        "random-meshes-within-the-bound",
        "joins-vertices-apart",
        "joins-vertices-any-number-of-edges-apart",
    ],
    run,
};

/// A flip: the corners a, b, c, d, and the number of the triangulation that it leads to.
type Step = ([usize; 4], usize);

/// The length of a longest sequence of flips and its first one.
type Longest = (usize, Option<Step>);

/// The triangulations of a point set and the flips between them that lower the lift.
struct World {
    all: Vec<Triangulation>,
    /// For each, the flips that lower its lift.
    down: Vec<Vec<Step>>,
    /// Six times the volume below each lift.
    volume: Vec<i64>,
}

impl World {
    fn of(points: &[Point]) -> Self {
        let all = triangulations(points);
        let place: BTreeMap<&[[usize; 3]], usize> = all.iter().enumerate().map(|(k, t)| (t.faces(), k)).collect();
        let lowering = |t: &Triangulation| {
            let flips = t.edges().into_iter().filter(|e| inside(points, e));
            flips
                .filter_map(|e| {
                    let to = *place.get(t.flipped(&e)?.faces())?;
                    Some(([e.ends[0], e.right?, e.ends[1], e.left], to))
                })
                .collect()
        };
        let down = all.iter().map(lowering).collect();
        let volume = all.iter().map(below_the_lift).collect();
        World { all, down, volume }
    }

    /// The longest sequence of flips from each triangulation, and its first flip; those of lower volume come first.
    fn longest(&self) -> Vec<Longest> {
        let mut order: Vec<usize> = (0..self.all.len()).collect();
        order.sort_by_key(|&k| self.volume[k]);
        let mut longest = vec![(0, None); self.all.len()];
        for k in order {
            for &(quad, to) in &self.down[k] {
                if longest[to].0 + 1 > longest[k].0 {
                    longest[k] = (longest[to].0 + 1, Some((quad, to)));
                }
            }
        }
        longest
    }

    fn ends(&self) -> impl Iterator<Item = &Triangulation> {
        self.all.iter().zip(&self.down).filter(|(_, down)| down.is_empty()).map(|(t, _)| t)
    }
}

/// The in-circle determinant in whole numbers.
fn incircle(p: &[Point], [a, b, c, d]: [usize; 4]) -> i64 {
    let square = |v: usize| (0..2).map(|k| (p[v][k] - p[d][k]).pow(2)).sum::<i64>();
    let area = |x: usize, y: usize| doubled_area(p[d], p[x], p[y]);
    square(a) * area(b, c) + square(b) * area(c, a) + square(c) * area(a, b)
}

/// Whether the edge violates the Delaunay condition.
fn inside(points: &[Point], edge: &Edge) -> bool {
    edge.right.is_some_and(|right| incircle(points, [edge.ends[0], edge.ends[1], edge.left, right]) > 0)
}

fn below_the_lift(t: &Triangulation) -> i64 {
    let p = t.points();
    let lift = |v: usize| p[v][0] * p[v][0] + p[v][1] * p[v][1];
    t.faces().iter().map(|&[a, b, c]| doubled_area(p[a], p[b], p[c]) * (lift(a) + lift(b) + lift(c))).sum()
}

/// `n(n−1)/2 − (3n − 3 − h)`.
fn bound(n: usize, h: usize) -> usize {
    (n * (n - 1) / 2).saturating_sub(3 * n - 3 - h)
}

fn run(setting: &Setting) -> Vec<Finding> {
    let mut polls = Polls::default();
    let largest = setting.pick(5, 6);
    (3..=largest).flat_map(|n| point_sets(n, 3)).for_each(|points| polls.ask(&points));
    for n in 4..=setting.pick(6, 8) {
        polls.on_the_parabola(n);
    }
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    for _ in 0..setting.pick(4, 40) {
        polls.at_random(10 + stream.below(setting.pick(20, 190)), &mut stream);
    }
    for rings in 2..=setting.pick(4, 12) {
        polls.far_apart(rings);
    }
    polls.answer(&describe_world(largest))
}

#[derive(Default)]
struct Polls {
    lower: Every,
    delaunay: Every,
    same: Every,
    ties: Search,
    bounded: Every,
    attained: Every,
    random: Every,
    apart: Search,
    any: Every,
    most: BTreeMap<usize, usize>,
    sharp: Option<(usize, Evidence)>,
    densest: (usize, usize),
    reached: Vec<String>,
}

impl Polls {
    fn ask(&mut self, points: &[Point]) {
        let world = World::of(points);
        let Some(first) = world.all.first() else { return };
        let (n, h) = (points.len(), first.boundary().iter().filter(|b| **b).count());
        for (k, flips) in world.down.iter().enumerate() {
            for (quad, to) in flips {
                let rises = world.volume[*to] >= world.volume[k];
                self.lower
                    .ask(rises.then(|| told(&world.all[k], &format!("the flip of {quad:?} does not lower the lift"))));
            }
        }
        for end in world.ends() {
            self.delaunay.ask(not_empty(end).map(|what| told(end, &what)));
        }
        let operators: Vec<Option<Dense<Rational>>> = world.ends().map(stiffness).collect();
        let differ = operators.iter().any(|l| l.is_none() || *l != operators[0]);
        self.same.ask(differ.then(|| told(first, "two Delaunay triangulations differ in their operators")));
        let ends: Vec<&Triangulation> = world.ends().collect();
        self.ties.ask((ends.len() > 1).then(|| {
            Case::told(format!(
                "{} Delaunay triangulations, {} and {}",
                ends.len(),
                ends[0].describe(),
                ends[1].describe()
            ))
        }));
        let most = world.longest().iter().map(|l| l.0).max().unwrap_or(0);
        let record = self.most.entry(n).or_default();
        *record = most.max(*record);
        self.bounded
            .ask((most > bound(n, h)).then(|| told(first, &format!("{most} flips, the bound is {}", bound(n, h)))));
        if let Some(Some(l)) = operators.first() {
            world.all.iter().for_each(|t| self.apart.ask(joined_apart(t, l)));
        }
    }

    /// The longest sequence of flips on points of a parabola, against the bound.
    fn on_the_parabola(&mut self, n: usize) {
        let points: Vec<Point> = (1..=n as i64).map(|k| [k, k * k]).collect();
        let world = World::of(&points);
        let longest = world.longest();
        let start = (0..longest.len()).max_by_key(|&k| (longest[k].0, std::cmp::Reverse(k))).unwrap_or(0);
        let most = longest.get(start).map_or(0, |l| l.0);
        let off = most != bound(n, n) || bound(n, n) != (n - 2) * (n - 3) / 2;
        self.attained.ask(off.then(|| Case::told(format!("{n} points: {most} flips, the bound is {}", bound(n, n)))));
        if n <= 6 {
            self.sharp = certificate(&world, &longest, start).map(|e| (most, e)).or(self.sharp.take());
        }
    }

    /// The flips of the library on a random mesh, and on the same one after flips towards a worst angle vector.
    fn at_random(&mut self, n: usize, stream: &mut Stream) {
        let mut points = BTreeSet::new();
        while points.len() < n {
            points.insert([stream.below(1000) as i64, stream.below(1000) as i64]);
        }
        let points: Vec<Point> = points.into_iter().collect();
        let Some(start) = sweep(&points) else { return };
        let h = start.boundary().iter().filter(|b| **b).count();
        let domain = Domain::from(start.surface());
        let worst = generate::find("worst-angle").and_then(|g| g.run(Some(&domain), &BTreeMap::new(), 0).ok());
        for domain in [Some(domain), worst] {
            let flips = domain.as_ref().and_then(Domain::as_surface).and_then(|surface| {
                let mut mesh = flip::Triangulation::of(surface).ok()?;
                mesh.flip_to_delaunay().ok()
            });
            let Some(flips) = flips else {
                self.random.ask(Some(Case::told(format!("{n} points that could not be flipped"))));
                continue;
            };
            if flips * self.densest.1 >= self.densest.0 * n {
                self.densest = (flips, n);
            }
            let over = flips > bound(n, h);
            self.random
                .ask(over.then(|| Case::told(format!("{flips} flips on {n} points, the bound is {}", bound(n, h)))));
        }
    }

    /// A zigzag strip on the parabola in which the first vertex is `rings` edges away from the last; its Delaunay triangulation
    /// has an edge between two vertices as far apart.
    fn far_apart(&mut self, rings: usize) {
        let n = 2 * rings;
        let points: Vec<Point> = (1..=n as i64).map(|k| [k, k * k]).collect();
        let Some(strip) = strip(&points) else { return self.any.ask(Some(Case::told("no strip".to_string()))) };
        let surface = strip.surface();
        let far = Descent::of(surface).ok().and_then(|descent| {
            let sides = descent.end.iter().flat_map(|f| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]]);
            sides.map(|[a, b]| (distance(&strip, a, b), a.min(b), a.max(b))).max().map(|far| (far, descent.terms.len()))
        });
        match far {
            Some(((found, a, b), flips)) if found >= rings => {
                self.reached.push(format!("{found} ({a} and {b} of {n} points, {flips} flips)"));
                self.any.ask(None);
            }
            _ => self.any.ask(Some(told(&strip, &format!("no new edge joins vertices {rings} edges apart")))),
        }
    }

    fn answer(self, cases: &str) -> Vec<Finding> {
        let p = ENTRY.parts;
        let ask = |text: &str| format!("{text} Cases: {cases}.");
        let sets = "point sets with all of their triangulations";
        let most: Vec<String> = self.most.iter().map(|(n, most)| format!("{most} for {n} points")).collect();
        let mut bounded = self.bounded.answer(
            p[4],
            ask("Is the longest sequence of flips, over all starts and orders, at most n(n−1)/2 − (3n − 3 − h) long?"),
            sets,
        );
        bounded.finding += &format!("; the longest: {}", most.join(", "));
        let mut attained = self.attained.answer(
            p[5],
            "Has the longest sequence of flips on the points (k, k²), k = 1, …, n, exactly (n−2)(n−3)/2 of them, the bound?",
            "numbers of points from 4 up",
        );
        if let Some((flips, evidence)) = self.sharp {
            attained.finding += &format!("; the certificate has {flips} flips");
            attained.evidence.push(evidence);
        }
        let mut random = self.random.answer(
            p[6],
            "Are the flips that the library makes within the bound?",
            "sweep triangulations of random points, and the same after flips towards a worst angle vector",
        );
        random.finding += &format!("; most flips for a point: {} on {} points", self.densest.0, self.densest.1);
        let mut any = self.any.answer(
            p[8],
            "Does the Delaunay triangulation of a zigzag strip on the points (k, k²), k = 1, …, 2r, join vertices r edges apart?",
            "distances r from 2 up",
        );
        any.finding += &format!("; edges apart: {}", self.reached.join(", "));
        vec![
            self.lower.answer(p[0], ask("Does every flip lower the lift?"), "flips of violated edges"),
            self.delaunay.answer(
                p[1],
                ask("Is a triangulation without a flip that lowers the lift Delaunay: is the circle of every triangle empty?"),
                "triangulations in which sequences of flips end",
            ),
            self.same.answer(p[2], ask("Have all ends of sequences of flips the same cotangent operator?"), sets),
            self.ties.answer(p[3], ask("Are there sequences of flips with different ends?"), sets),
            bounded,
            attained,
            random,
            self.apart.answer(
                p[7],
                ask("Has the Delaunay operator a non-zero entry between vertices that share no edge of the mesh it is made from?"),
                "triangulations",
            ),
            any,
        ]
    }
}

fn told(t: &Triangulation, what: &str) -> Case {
    Case::told(format!("{what} on {}", t.describe()))
}

/// A vertex in the circle of a triangle, looked for everywhere.
fn not_empty(t: &Triangulation) -> Option<String> {
    let n = t.points().len();
    t.faces().iter().find_map(|&[a, b, c]| {
        let d = (0..n).find(|&d| incircle(t.points(), [a, b, c, d]) > 0)?;
        Some(format!("vertex {d} is inside the circle of ({a}, {b}, {c})"))
    })
}

fn stiffness(t: &Triangulation) -> Option<Dense<Rational>> {
    Some(Dense::from_csr(&stiffness_in_plane::<Rational>(&t.surface())?))
}

/// The certificate of the longest sequence of flips from a triangulation.
fn certificate(world: &World, longest: &[Longest], start: usize) -> Option<Evidence> {
    let surface = world.all[start].surface();
    let points = surface.planar_positions::<Rational>()?;
    let (mut terms, mut at) = (Vec::new(), start);
    while let Some((quad, to)) = longest[at].1 {
        terms.push(term(&points, quad)?);
        at = to;
    }
    let end = world.all[at].faces().to_vec();
    // 1 at every other point: each flip changes the energy of some function, and this one sees most of them.
    let values: Vec<f64> = (0..points.len()).map(|k| (k % 2) as f64).collect();
    Descent { start: surface, terms, end }.certificate(&values)
}

/// An entry of the Delaunay operator between vertices that share no edge of a triangulation.
fn joined_apart(t: &Triangulation, l: &Dense<Rational>) -> Option<Case> {
    let n = l.rows();
    let edges = t.edges();
    let joined = |i: usize, j: usize| edges.iter().any(|e| e.ends == [i, j] || e.ends == [j, i]);
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    let (i, j) = pairs.into_iter().find(|&(i, j)| l.at(i, j).cmp_zero() != Ordering::Equal && !joined(i, j))?;
    let statement = Statement::FarEntry { i, j, rings: Some(distance(t, i, j)) };
    let text = format!("L({i}, {j}) = {} after flips from {}", l.at(i, j), t.describe());
    Some(Case::shown(text, on_triangulation(statement, t, l, &[i])))
}

/// How many edges apart two vertices are.
fn distance(t: &Triangulation, from: usize, to: usize) -> usize {
    let mut reached = BTreeSet::from([from]);
    for rings in 0..t.points().len() {
        if reached.contains(&to) {
            return rings;
        }
        let next: Vec<usize> = reached.iter().flat_map(|&v| t.neighbours(v)).collect();
        reached.extend(next);
    }
    t.points().len()
}

/// The zigzag triangulation of points in convex position, listed along the curve: 0, n−1, 1, n−2, … each joined to the next.
fn strip(points: &[Point]) -> Option<Triangulation> {
    let (mut low, mut high) = (0, points.len().checked_sub(1)?);
    let mut faces = Vec::new();
    while low + 1 < high {
        faces.push([low, low + 1, high]);
        low += 1;
        if low + 1 < high {
            faces.push([low, high - 1, high]);
            high -= 1;
        }
    }
    triangulation(points, &faces)
}

/// A triangulation with these counter-clockwise faces; `None` if one is not.
fn triangulation(points: &[Point], faces: &[[usize; 3]]) -> Option<Triangulation> {
    let ccw = |f: &[usize; 3]| doubled_area(points[f[0]], points[f[1]], points[f[2]]) > 0;
    faces.iter().all(ccw).then(|| Triangulation::new(points, faces.to_vec()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::recheck::{self, Rechecked};

    #[test]
    fn the_bound_is_one_for_four_points_in_convex_position_and_none_for_a_point_in_a_triangle() {
        assert_eq!([bound(3, 3), bound(4, 4), bound(4, 3), bound(5, 5), bound(6, 6)], [0, 1, 0, 3, 6]);
    }

    #[test]
    fn the_longest_chain_of_the_pentagon_has_three_flips_and_a_certificate() {
        let points: Vec<Point> = (1..=5).map(|k| [k, k * k]).collect();
        let world = World::of(&points);
        let longest = world.longest();
        let start = (0..5).max_by_key(|&k| longest[k].0).unwrap();
        assert_eq!(longest[start].0, 3);
        let evidence = certificate(&world, &longest, start).unwrap();
        assert_eq!(recheck::from_excerpt(&evidence), Ok(Rechecked::Exact));
    }

    #[test]
    fn a_violated_edge_of_a_rhombus_is_noticed_by_the_circle_and_by_the_lift() {
        let all = triangulations(&[[0, 1], [2, 0], [2, 2], [4, 1]]);
        let [first, second] = all.as_slice() else { panic!("two diagonals") };
        let (good, bad) = if not_empty(first).is_none() { (first, second) } else { (second, first) };
        assert!(not_empty(bad).is_some() && below_the_lift(good) < below_the_lift(bad));
        let l = stiffness(good).unwrap();
        assert!(joined_apart(bad, &l).is_some() && joined_apart(good, &l).is_none());
    }

    #[test]
    fn the_ends_of_a_strip_are_half_its_length_apart() {
        let points: Vec<Point> = (1..=8).map(|k| [k, k * k]).collect();
        let strip = strip(&points).unwrap();
        assert_eq!(strip.faces().len(), 6);
        assert_eq!(distance(&strip, 0, 4), 4);
    }
}
