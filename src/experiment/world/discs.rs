//! Triangulated discs as such, without positions: those of small triangulations, polygons to draw their boundary as, and the
//! drawing in which the inner vertices are in equilibrium.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use super::triangulations::{Point, Triangulation, doubled_area, world};
use crate::domain::geometry;
use crate::linalg::Csr;
use crate::linalg::rational::{Elimination, eliminate};
use crate::property::evidence::{Fault, Hypothesis};
use crate::property::{Evidence, Excerpt, Statement};
use crate::scalar::{Rational, Scalar};

/// A drawn point.
pub type Drawn = [Rational; 2];

/// A triangulated surface with a boundary cycle, or a graph (no faces) with a cycle that is to be drawn as a polygon.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Disc {
    /// The number of vertices; those of the boundary come first, in their order around it.
    pub vertices: usize,
    /// How many of them are on the boundary.
    pub rim: usize,
    /// The faces, oriented as the boundary runs.
    pub faces: Vec<[usize; 3]>,
    /// The edges, ends ascending.
    pub edges: Vec<[usize; 2]>,
}

impl Disc {
    /// A surface with the boundary cycle 0, 1, …, rim − 1.
    pub fn new(vertices: usize, rim: usize, mut faces: Vec<[usize; 3]>) -> Self {
        for f in &mut faces {
            while f[0] > f[1] || f[0] > f[2] {
                f.rotate_left(1);
            }
        }
        faces.sort_unstable();
        let sides = faces.iter().flat_map(|f| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]]);
        let edges: BTreeSet<[usize; 2]> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        Disc { vertices, rim, faces, edges: edges.into_iter().collect() }
    }

    /// The combinatorial disc of a triangulation.
    pub fn of(t: &Triangulation) -> Option<Self> {
        let after: BTreeMap<usize, usize> =
            t.edges().iter().filter(|e| e.right.is_none()).map(|e| (e.ends[0], e.ends[1])).collect();
        let first = *after.keys().next()?;
        let mut cycle = vec![first];
        while let Some(&next) = after.get(cycle.last()?).filter(|&&v| v != first) {
            cycle.push(next);
        }
        let n = t.points().len();
        let inside = (0..n).filter(|v| !after.contains_key(v));
        let order: Vec<usize> = cycle.iter().copied().chain(inside).collect();
        let mut number = vec![0; n];
        order.iter().enumerate().for_each(|(k, &v)| number[v] = k);
        Some(Disc::new(n, cycle.len(), t.faces().iter().map(|f| f.map(|v| number[v])).collect()))
    }

    /// The edges with an end inside.
    pub fn inner_edges(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.edges.iter().copied().filter(|e| e[1] >= self.rim)
    }

    /// The edges that join two vertices of the boundary and are not part of it.
    pub fn chords(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let last = self.rim - 1;
        let within = self.edges.iter().copied().filter(|e| e[1] < self.rim);
        within.filter(move |&[a, b]| b != a + 1 && [a, b] != [0, last])
    }

    /// The first of the discs that differ by the start of the boundary and the numbers inside, and their mirror images.
    fn canonical(&self) -> Self {
        let (m, n) = (self.rim, self.vertices);
        let mut best: Option<Disc> = None;
        for inside in permutations((m..n).collect()) {
            for start in 0..m {
                for mirrored in [false, true] {
                    let number = |v: usize| match v {
                        v if v >= m => inside[v - m],
                        v if mirrored => (start + m - v) % m,
                        v => (start + v) % m,
                    };
                    let faces = self.faces.iter().map(|f| {
                        let [a, b, c] = f.map(number);
                        if mirrored { [a, c, b] } else { [a, b, c] }
                    });
                    let image = Disc::new(n, m, faces.collect());
                    if best.as_ref().is_none_or(|b| image < *b) {
                        best = Some(image);
                    }
                }
            }
        }
        best.unwrap_or_else(|| self.clone())
    }

    /// The drawing with the boundary at `polygon` and `Σ_j ω_ij (x_j − x_i) = 0` inside, exactly; the weights are those of the
    /// inner edges in their order. `None` if it is not the only one.
    pub fn draw(&self, polygon: &[Point], weights: &[f64]) -> Option<Vec<Drawn>> {
        let size = self.vertices - self.rim;
        let (mut triplets, mut right) = (Vec::new(), [vec![0.0; size], vec![0.0; size]]);
        for ([a, b], &w) in self.inner_edges().zip(weights) {
            for (i, j) in [(a, b), (b, a)].into_iter().filter(|e| e.0 >= self.rim) {
                let row = i - self.rim;
                triplets.push((row, row, w));
                if j >= self.rim {
                    triplets.push((row, j - self.rim, -w));
                } else {
                    (0..2).for_each(|axis| right[axis][row] += w * polygon[j][axis] as f64);
                }
            }
        }
        let Some(Elimination::Solution(x)) = eliminate(&Csr::from_triplets(size, size, &triplets), &right) else {
            return None;
        };
        let rim = polygon.iter().map(|p| p.map(Rational::from));
        Some(rim.chain((0..size).map(|k| [x[0][k].clone().reduced(), x[1][k].clone().reduced()])).collect())
    }

    /// The first face that is not drawn counter-clockwise.
    pub fn folded(&self, at: &[Drawn]) -> Option<usize> {
        let area = |f: &[usize; 3]| geometry::doubled_area(&at[f[0]], &at[f[1]], &at[f[2]]);
        self.faces.iter().position(|f| area(f).cmp_zero() != Ordering::Greater)
    }

    /// The force `Σ_j ω_ij (x_j − x_i)` at an inner vertex, summed anew.
    pub fn force(&self, at: &[Drawn], weights: &[f64], vertex: usize) -> Option<Drawn> {
        let mut force = [Rational::zero(), Rational::zero()];
        for ([a, b], &w) in self.inner_edges().zip(weights).filter(|(e, _)| e.contains(&vertex)) {
            for (axis, f) in force.iter_mut().enumerate() {
                let pull = at[a + b - vertex][axis].clone() - at[vertex][axis].clone();
                *f = (f.clone() + Rational::exactly(w)? * pull).reduced();
            }
        }
        Some(force)
    }

    /// The witness against Tutte's theorem without one of its hypotheses.
    pub fn witness(&self, at: &[Drawn], weights: &[f64], missing: Hypothesis, fault: Fault) -> Evidence {
        let text = |x: &Rational| x.clone().reduced().to_string();
        let weight = |e: &[usize; 2]| self.inner_edges().zip(weights).find(|(f, _)| f == e).map_or(0.0, |(_, &w)| w);
        let term = |(k, e): (u32, &[usize; 2])| {
            let [x, y]: [Rational; 2] = std::array::from_fn(|axis| at[e[0]][axis].clone() - at[e[1]][axis].clone());
            let weight = Rational::exactly(weight(e)).unwrap_or_else(Rational::zero);
            (Rational::from(k) * (x.clone() * x + y.clone() * y + weight)).reduced()
        };
        let sides = (0..self.rim).map(|k| (k, (k + 1) % self.rim)).map(|(a, b)| [a.min(b), a.max(b)]);
        let all: BTreeSet<[usize; 2]> = self.edges.iter().copied().chain(sides).collect();
        let checksum = (1..).zip(&all).map(term).fold(Rational::zero(), |sum, t| (sum + t).reduced());
        let statement = Statement::NotEmbedded {
            boundary: (0..self.rim).collect(),
            weights: self.inner_edges().zip(weights).map(|([a, b], &w)| (a, b, w)).collect(),
            drawing: at.iter().map(|[x, y]| [text(x), text(y)]).collect(),
            checksum: text(&checksum),
            missing,
            fault,
        };
        let faces = self.faces.iter().map(|f| f.to_vec()).enumerate().collect();
        Evidence::new(statement, Excerpt { faces, ..Excerpt::default() })
    }

    /// The disc in words.
    pub fn describe(&self) -> String {
        let words = |list: Vec<String>| list.join(" ");
        if self.faces.is_empty() {
            return format!("edges {}", words(self.edges.iter().map(|[a, b]| format!("{a}-{b}")).collect()));
        }
        format!("triangles {}", words(self.faces.iter().map(|[a, b, c]| format!("{a}-{b}-{c}")).collect()))
    }
}

/// Every triangulated disc with `n` vertices, one of them inside at least, that a lattice triangulation of a box of 4 × 4 points
/// has; once up to renumbering and reflection.
pub fn discs(n: usize) -> Vec<Disc> {
    let found: BTreeSet<Disc> = world(n)
        .filter(|t| t.points().len() == n)
        .filter_map(|t| Disc::of(&t))
        .filter(|d| d.rim < d.vertices)
        .map(|d| d.canonical())
        .collect();
    found.into_iter().collect()
}

/// Every surface with `n` vertices and the boundary 0, 1, 2, one of its faces taken out of a closed one; numbered in every way.
/// Discs are oriented as the boundary runs; where a surface has no orientation that of the faces is arbitrary.
///
/// Faces are put one after the other at the first edge that has one face only; an edge has two at most, and at the end
/// the faces around each vertex form one fan.
pub fn surfaces(n: usize) -> Vec<Disc> {
    let mut found = Vec::new();
    grow(n, &mut vec![[0, 1, 2]], &mut found);
    found
}

fn grow(n: usize, faces: &mut Vec<[usize; 3]>, found: &mut Vec<Disc>) {
    let mut count: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for f in faces.iter() {
        for [a, b] in [[f[0], f[1]], [f[1], f[2]], [f[0], f[2]]] {
            *count.entry([a.min(b), a.max(b)]).or_default() += 1;
        }
    }
    if count.values().any(|&c| c > 2) {
        return;
    }
    let Some([a, b]) = count.iter().find(|e| *e.1 == 1).map(|e| *e.0) else {
        let used: BTreeSet<usize> = faces.iter().flatten().copied().collect();
        if used.len() == n && (0..n).all(|v| is_one_fan(faces, v)) {
            found.push(Disc::new(n, 3, oriented(&faces[1..])));
        }
        return;
    };
    for c in (0..n).filter(|c| *c != a && *c != b) {
        let mut face = [a, b, c];
        face.sort_unstable();
        if !faces.contains(&face) {
            faces.push(face);
            grow(n, faces, found);
            faces.pop();
        }
    }
}

fn is_one_fan(faces: &[[usize; 3]], v: usize) -> bool {
    let at: Vec<&[usize; 3]> = faces.iter().filter(|f| f.contains(&v)).collect();
    let (mut reached, mut queue) = (BTreeSet::from([0]), vec![0]);
    while let Some(i) = queue.pop() {
        for j in 0..at.len() {
            if at[i].iter().any(|w| *w != v && at[j].contains(w)) && reached.insert(j) {
                queue.push(j);
            }
        }
    }
    reached.len() == at.len()
}

/// The faces turned so that neighbours agree as far as they can, beginning at the edge 0 → 1 of the boundary.
fn oriented(faces: &[[usize; 3]]) -> Vec<[usize; 3]> {
    let mut turned: Vec<Option<[usize; 3]>> = vec![None; faces.len()];
    let mut queue = vec![[0, 1]];
    while let Some([a, b]) = queue.pop() {
        let beside = (0..faces.len()).find(|&k| turned[k].is_none() && faces[k].contains(&a) && faces[k].contains(&b));
        let Some(k) = beside else { continue };
        let c = faces[k].iter().sum::<usize>() - a - b;
        turned[k] = Some([a, b, c]);
        queue.extend([[c, b], [a, c]]);
    }
    turned.into_iter().zip(faces).map(|(t, f)| t.unwrap_or(*f)).collect()
}

/// How the corners of a simple polygon turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turning {
    /// All to the left.
    Strict,
    /// To the left or straight on.
    Straight,
    /// Some to the right.
    Reflex,
}

/// The simple polygons with `m` lattice corners that run counter-clockwise in a box of the given size and fill it.
pub fn polygons(m: usize, [width, height]: Point) -> Vec<(Vec<Point>, Turning)> {
    let cells: Vec<Point> = (0..=width).flat_map(|x| (0..=height).map(move |y| [x, y])).collect();
    let mut found = Vec::new();
    tuples(&cells, m, &mut Vec::new(), &mut |p| {
        let reaches = |axis: usize, value: i64| p.iter().any(|q| q[axis] == value);
        if reaches(0, 0) && reaches(0, width) && reaches(1, 0) && reaches(1, height) {
            found.extend(turning(p).map(|t| (p.to_vec(), t)));
        }
    });
    found
}

fn tuples(cells: &[Point], m: usize, chosen: &mut Vec<Point>, visit: &mut impl FnMut(&[Point])) {
    if chosen.len() == m {
        return visit(chosen);
    }
    for cell in cells {
        if !chosen.contains(cell) {
            chosen.push(*cell);
            tuples(cells, m, chosen, visit);
            chosen.pop();
        }
    }
}

/// How a polygon turns; `None` unless it is simple and runs counter-clockwise.
fn turning(p: &[Point]) -> Option<Turning> {
    let m = p.len();
    let at = |k: usize| p[k % m];
    if (0..m).map(|k| doubled_area(at(0), at(k), at(k + 1))).sum::<i64>() <= 0 {
        return None;
    }
    let on = |a: Point, b: Point, c: Point| {
        doubled_area(a, b, c) == 0 && (0..2).all(|k| a[k].min(b[k]) <= c[k] && c[k] <= a[k].max(b[k]))
    };
    for i in 0..m {
        for j in i + 1..m {
            let (a, b, c, d) = (at(i), at(i + 1), at(j), at(j + 1));
            let meet = if j == i + 1 {
                on(a, b, d)
            } else if i == 0 && j == m - 1 {
                on(a, b, c)
            } else {
                let side = |p, q, r| doubled_area(p, q, r).signum();
                let crossing = side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
                crossing || on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b)
            };
            // At a shared corner the far ends are asked both ways: one side may run back along the other.
            let back = j == i + 1 && on(c, d, a) || i == 0 && j == m - 1 && on(c, d, b);
            if meet || back {
                return None;
            }
        }
    }
    let turns: Vec<i64> = (0..m).map(|k| doubled_area(at(k), at(k + 1), at(k + 2))).collect();
    Some(match turns.iter().min() {
        Some(least) if *least > 0 => Turning::Strict,
        Some(0) => Turning::Straight,
        _ => Turning::Reflex,
    })
}

fn permutations(items: Vec<usize>) -> Vec<Vec<usize>> {
    if items.is_empty() {
        return vec![Vec::new()];
    }
    let rest = |k: usize| items.iter().copied().filter(|&v| v != items[k]).collect::<Vec<_>>();
    (0..items.len())
        .flat_map(|k| permutations(rest(k)).into_iter().map(move |tail| (k, tail)))
        .map(|(k, tail)| [vec![items[k]], tail].concat())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_as_many_small_discs_as_drawn_by_hand() {
        // Four vertices: the wheel of three. Five: the wheel of four, a quadrilateral with a diagonal and a vertex in one half,
        // a triangle with two vertices inside.
        let count = |n: usize| discs(n).len();
        assert_eq!([count(3), count(4), count(5)], [0, 1, 3]);
    }

    #[test]
    fn the_closed_surfaces_with_six_vertices_are_spheres_and_the_projective_plane() {
        // Labelled spheres with a given face: all of Euler number 1 without that face. The projective plane has ten faces and
        // all fifteen edges.
        let six = surfaces(6);
        let euler = |d: &Disc| d.vertices as i64 - d.edges.len() as i64 + d.faces.len() as i64;
        assert!(six.iter().all(|d| [0, 1].contains(&euler(d))));
        let plane: Vec<&Disc> = six.iter().filter(|d| euler(d) == 0).collect();
        assert!(!plane.is_empty() && plane.iter().all(|d| (d.faces.len(), d.edges.len()) == (9, 15)));
        // 6! / 60 = 12 labellings, each with ten of the twenty triangles as faces: six contain a given one.
        assert_eq!(plane.len(), 6);
        assert!((4..6).all(|n| surfaces(n).iter().all(|d| euler(d) == 1)));
    }

    #[test]
    fn polygons_are_simple_and_told_apart_by_their_corners() {
        assert_eq!(turning(&[[0, 0], [1, 0], [1, 1], [0, 1]]), Some(Turning::Strict));
        assert_eq!(turning(&[[0, 0], [1, 0], [2, 0], [0, 1]]), Some(Turning::Straight));
        assert_eq!(turning(&[[0, 0], [2, 0], [1, 1], [0, 2]]), Some(Turning::Straight));
        assert_eq!(turning(&[[0, 0], [3, 0], [1, 1], [0, 3]]), Some(Turning::Reflex));
        assert_eq!(turning(&[[0, 0], [1, 1], [1, 0], [0, 1]]), None);
        assert_eq!(turning(&[[0, 1], [1, 1], [1, 0], [0, 0]]), None);
        assert_eq!(turning(&[[0, 0], [2, 0], [1, 0], [0, 1]]), None);
    }

    #[test]
    fn the_centre_of_a_wheel_is_the_weighted_mean_of_its_rim() {
        let wheel = &discs(4)[0];
        let at = wheel.draw(&[[0, 0], [3, 0], [0, 3]], &[1.0, 1.0, 2.0]).unwrap();
        let quarter = |n: i64| Rational::from(n) / Rational::from(4);
        assert_eq!(at[3], [quarter(3), quarter(6)]);
        assert_eq!(wheel.folded(&at), None);
        assert_eq!(wheel.force(&at, &[1.0, 1.0, 2.0], 3), Some([Rational::ZERO, Rational::ZERO]));
        assert_eq!(wheel.draw(&[[0, 0], [3, 0], [0, 3]], &[1.0, 1.0, -2.0]), None);
    }
}
