//! Intrinsic flips on sheared flat tori: the surface and its number of triangles stay the same, the number of flips does not.
//!
//! The torus ℝ²/(kℤ)² with its k² whole points as vertices and the edges (1, 0), (s, 1), (s + 1, 1) at each of them: for every
//! whole shear s another triangulation of the same flat surface. An edge is a whole vector, so that everything is decided in
//! whole numbers: a triangle with the sides u, v, −(u + v) has an obtuse angle opposite u + v iff `u·v > 0`, and the sum of the
//! two cotangents opposite an edge has the sign of the sum of dot products, since all triangles have the same area.

use std::collections::VecDeque;

use super::poll::{Case, Every};
use super::{Experiment, Finding, Setting};
use crate::figure::{Axis, Chart, Figure, Mark, Series};
use crate::property::{Evidence, Statement};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "flips-on-tori",
    name: "Intrinsic flips on sheared flat tori",
    statement: "from the triangulation of ℝ²/(kℤ)² with the edges (1, 0), (s, 1), (s + 1, 1) it takes s flips to Delaunay for k = 1, \
                each of them forced, and a number that grows with s for every k: no number of vertices bounds it",
    sources: &["wardetzky-primer", "bobenko-springborn2007"],
    parts: &["one-vertex-takes-the-shear", "ends-delaunay", "grows-with-the-shear"],
    run,
};

type Vector = [i64; 2];

/// A triangulation of a flat torus: half-edges with their vectors; `3f, 3f + 1, 3f + 2` around each triangle.
struct Torus {
    vector: Vec<Vector>,
    twin: Vec<usize>,
}

impl Torus {
    /// k² vertices, sheared.
    fn sheared(k: usize, shear: i64) -> Self {
        let (u, v) = ([1, 0], [shear, 1]);
        let mut torus = Torus { vector: Vec::new(), twin: vec![0; 6 * k * k] };
        // Cell (i, j) in the basis u, v: the triangle u, v, −(u+v) and the triangle u + v, −u, −v.
        let place = |i: usize, j: usize| 6 * ((j % k) * k + i % k);
        for j in 0..k {
            for i in 0..k {
                let s = add(u, v);
                torus.vector.extend([u, v, negative(s), s, negative(u), negative(v)]);
                let at = place(i, j);
                // The first triangle lies below the diagonal, the second above it: u is the lower side of the one, −u the upper
                // side of the other one row further down; v the right side, −v the left side one column further on.
                for (h, t) in [(at + 2, at + 3), (at, place(i, j + k - 1) + 4), (at + 1, place(i + 1, j) + 5)] {
                    torus.twin[h] = t;
                    torus.twin[t] = h;
                }
            }
        }
        torus
    }

    fn next(h: usize) -> usize {
        h - h % 3 + (h + 1) % 3
    }

    /// Minus the dot product that the cotangent opposite a half-edge has as its numerator.
    fn obtuseness(&self, h: usize) -> i64 {
        let (n, p) = (Torus::next(h), Torus::next(Torus::next(h)));
        dot(self.vector[n], self.vector[p])
    }

    /// Whether the cotangents opposite the edge have a negative sum.
    fn is_violated(&self, h: usize) -> bool {
        self.obtuseness(h) + self.obtuseness(self.twin[h]) > 0
    }

    /// Flips to Delaunay; how many flips. `None` after more than `limit`, or where a triangle is folded.
    fn make_delaunay(&mut self, limit: usize) -> Option<usize> {
        let mut queue: VecDeque<usize> = (0..self.vector.len()).collect();
        let mut flips = 0;
        while let Some(h) = queue.pop_front() {
            if !self.is_violated(h) {
                continue;
            }
            flips += 1;
            if flips > limit || self.twin[h] / 3 == h / 3 {
                return None;
            }
            queue.extend(self.flip(h));
        }
        self.is_sound().then_some(flips)
    }

    /// Replaces the edge by the other diagonal; returns the half-edges of both triangles.
    fn flip(&mut self, h: usize) -> [usize; 6] {
        let t = self.twin[h];
        let (h1, h2, t1, t2) =
            (Torus::next(h), Torus::next(Torus::next(h)), Torus::next(t), Torus::next(Torus::next(t)));
        // Left triangle h, h1, h2 becomes d → c, h2, t1; right one c → d, t2, h1, where c and d are the apexes.
        let old = [h1, h2, t1, t2];
        let (vectors, twins) = (old.map(|x| self.vector[x]), old.map(|x| self.twin[x]));
        let diagonal = negative(add(vectors[1], vectors[2]));
        self.vector[h] = diagonal;
        self.vector[t] = negative(diagonal);
        // Where each of the four sides goes: h1 → t2's place, h2 → h1's, t1 → h2's, t2 → t1's.
        let new = [t2, h1, h2, t1];
        let moved = |x: usize| (0..4).find(|&k| old[k] == x).map_or(x, |k| new[k]);
        for k in 0..4 {
            self.vector[new[k]] = vectors[k];
        }
        for k in 0..4 {
            let other = moved(twins[k]);
            self.twin[new[k]] = other;
            self.twin[other] = new[k];
        }
        [h, h1, h2, t, t1, t2]
    }

    /// Every triangle closes with the doubled area one, twins run opposite ways.
    fn is_sound(&self) -> bool {
        let v = &self.vector;
        let closes = |f: usize| {
            let [a, b, c] = [v[3 * f], v[3 * f + 1], v[3 * f + 2]];
            add(add(a, b), c) == [0, 0] && a[0] * b[1] - a[1] * b[0] == 1
        };
        (0..v.len() / 3).all(closes)
            && (0..v.len()).all(|h| v[self.twin[h]] == negative(v[h]) && self.twin[self.twin[h]] == h)
    }
}

fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

fn negative(a: Vector) -> Vector {
    [-a[0], -a[1]]
}

fn dot(a: Vector, b: Vector) -> i64 {
    a[0] * b[0] + a[1] * b[1]
}

fn run(setting: &Setting) -> Vec<Finding> {
    let (mut forced, mut ends, mut grows) = (Every::default(), Every::default(), Every::default());
    let (largest, shears) = (setting.pick(2, 6), setting.pick(8, 64) as i64);
    let (mut table, mut lines) = (Vec::new(), Vec::new());
    for k in 1..=largest {
        let mut last = None;
        let (mut row, mut line) = (Vec::new(), Vec::new());
        for shear in 0..=shears {
            let mut torus = Torus::sheared(k, shear);
            let limit = 64 * k * k * (shear as usize + 1);
            let flips = torus.is_sound().then(|| torus.make_delaunay(limit)).flatten();
            let violated = flips.is_none() || (0..torus.vector.len()).any(|h| torus.is_violated(h));
            ends.ask(violated.then(|| Case::told(format!("k = {k}, s = {shear}: {flips:?} flips"))));
            if k == 1 {
                forced
                    .ask((flips != Some(shear as usize)).then(|| Case::told(format!("s = {shear}: {flips:?} flips"))));
            }
            // One flip more for each vertex and step of the shear, or the question is answered with no.
            let least = k * k * shear as usize;
            let slow = flips.is_none_or(|f| f < least || last.is_some_and(|l| f <= l));
            grows.ask(slow.then(|| Case::told(format!("k = {k}, s = {shear}: {flips:?} flips after {last:?}"))));
            if shear > 0 && shear & (shear - 1) == 0 {
                row.push(format!("{shear}: {}", flips.map_or("none".to_string(), |f| f.to_string())));
            }
            line.extend(flips.map(|f| [shear as f64, f as f64]));
            last = flips;
        }
        let name = if k == 1 { "1 vertex".into() } else { format!("{} vertices", k * k) };
        lines.push(Series::new(name, Mark::Line, line));
        table.push(format!("{} vertices {{{}}}", k * k, row.join(", ")));
    }
    let mut forced = forced.answer(
        ENTRY.parts[0],
        "Does the torus with one vertex and the shear s take exactly s flips?",
        "shears from 0 up",
    );
    forced.evidence.extend(certificate(shears));
    let cases = format!("tori with up to {} vertices and shears up to {shears}", largest * largest);
    let mut grows = grows.answer(
        ENTRY.parts[2],
        "Is the number of flips at least the shear times the number of vertices, and larger for each larger shear?",
        &cases,
    );
    grows.finding += &format!("; flips by shear: {}", table.join("; "));
    let least = Series::new("the shear", Mark::Reference, [[0.0, 0.0], [shears as f64, shears as f64]]);
    grows.figures.push(Figure::Chart(Chart {
        title: "Flips to Delaunay on sheared flat tori: no bound by the number of vertices alone".into(),
        x: Axis::linear("shear"),
        y: Axis::linear("flips"),
        series: lines.into_iter().chain([least]).collect(),
    }));
    vec![
        forced,
        ends.answer(
            ENTRY.parts[1],
            "Do the flips end with no negative sum of cotangents, every triangle closed?",
            &cases,
        ),
        grows,
    ]
}

/// The flips of the torus with one vertex, whose violated edge is the only one at each step.
fn certificate(shear: i64) -> Option<Evidence> {
    let (mut u, mut v) = ([1, 0], [shear, 1]);
    let start = [u, v];
    let mut flips = 0;
    loop {
        let s = add(u, v);
        (u, v) = match (dot(u, v) > 0, dot(u, s) < 0, dot(v, s) < 0) {
            (true, _, _) => (negative(v), u),
            (_, true, _) => (u, s),
            (_, _, true) => (s, v),
            _ => break,
        };
        flips += 1;
    }
    Some(Evidence::bare(Statement::TorusFlips { start, flips, end: [u, v] }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::recheck::{self, Rechecked};

    #[test]
    fn a_square_grid_is_delaunay_and_a_shear_by_one_takes_a_flip() {
        for k in 1..4 {
            let mut torus = Torus::sheared(k, 0);
            assert!(torus.is_sound());
            assert_eq!(torus.make_delaunay(10), Some(0));
        }
        assert_eq!(Torus::sheared(1, 1).make_delaunay(10), Some(1));
    }

    #[test]
    fn every_flip_keeps_the_invariants_and_the_fourth_one_in_a_row_is_the_first() {
        for k in 1..4 {
            for h in 0..6 * k * k {
                let mut torus = Torus::sheared(k, 2);
                let before = torus.vector.clone();
                if torus.obtuseness(h) + torus.obtuseness(torus.twin[h]) < 0 || torus.twin[h] / 3 == h / 3 {
                    continue;
                }
                torus.flip(h);
                assert!(torus.is_sound());
                torus.flip(h);
                assert!(torus.is_sound());
                assert_eq!(torus.vector[h], negative(before[h]), "two flips turn an edge round");
            }
        }
    }

    #[test]
    fn the_certificate_counts_as_the_half_edges_do_and_is_verified() {
        for shear in 0..20 {
            let evidence = certificate(shear).unwrap();
            let Statement::TorusFlips { flips, .. } = evidence.statement else { panic!() };
            assert_eq!(Some(flips), Torus::sheared(1, shear).make_delaunay(100));
            assert_eq!(recheck::from_excerpt(&evidence), Ok(Rechecked::Exact));
        }
    }
}
