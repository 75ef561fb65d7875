//! Triangulations of whole points in the plane: orientation, circles and cotangent stiffness in whole numbers.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use dashu_int::IBig;

use super::alone::{fraction, triangles, whole_positions};
use super::{Refusal, polygon};
use crate::property::evidence::{Excerpt, Mesh, Weighting};
use crate::scalar::{Rational, Scalar};

/// A point of the plane.
pub(super) type Point = [IBig; 2];

/// A symmetric matrix by its entries `(i, j)`, `i ≤ j`.
pub(super) type Upper = BTreeMap<(usize, usize), Rational>;

/// Whole points and counter-clockwise triangles, each edge on at most two of them.
#[derive(Clone)]
pub(super) struct Planar {
    /// The points.
    pub points: Vec<Point>,
    /// The triangles, each from its smallest corner.
    pub faces: BTreeSet<[usize; 3]>,
}

impl Planar {
    /// Reads an excerpt that carries all positions and all faces of a triangulation in the plane z = 0.
    pub fn read(excerpt: &Excerpt) -> Result<Self, Refusal> {
        let mut points = Vec::with_capacity(excerpt.positions.len());
        for (index, [x, y, z]) in whole_positions(&excerpt.positions)?.into_iter().enumerate() {
            if z != IBig::ZERO {
                return Err(Refusal::Malformed { what: "position", index, problem: "is not in the plane z = 0" });
            }
            points.push([x, y]);
        }
        let read = triangles(&excerpt.faces)?;
        let planar = Planar { points, faces: read.iter().map(|&t| from_smallest(t)).collect() };
        planar.check(read.len())?;
        Ok(planar)
    }

    /// Reads a mesh.
    pub fn of(mesh: &Mesh) -> Result<Self, Refusal> {
        let points = mesh.points.iter().map(|p| p.map(IBig::from)).collect();
        let planar = Planar { points, faces: mesh.faces.iter().map(|&t| from_smallest(t)).collect() };
        planar.check(mesh.faces.len())?;
        Ok(planar)
    }

    /// The same points with other triangles.
    pub fn with(&self, faces: &[[usize; 3]]) -> Result<Self, Refusal> {
        let planar = Planar { points: self.points.clone(), faces: faces.iter().map(|&t| from_smallest(t)).collect() };
        planar.check(faces.len())?;
        Ok(planar)
    }

    /// Refuses corners out of range, triangles that are not counter-clockwise, a directed edge that occurs twice.
    fn check(&self, count: usize) -> Result<(), Refusal> {
        if self.faces.len() != count {
            return Err(Refusal::untrue("no face occurs twice", "one does"));
        }
        let mut sides = BTreeSet::new();
        for (index, f) in self.faces.iter().enumerate() {
            if let Some(&missing) = f.iter().find(|&&v| v >= self.points.len()) {
                return Err(Refusal::Missing { what: "position", index: missing });
            }
            if self.area(f[0], f[1], f[2]) <= IBig::ZERO {
                return Err(Refusal::Malformed { what: "triangle", index, problem: "is not counter-clockwise" });
            }
            if (0..3).any(|k| !sides.insert([f[k], f[(k + 1) % 3]])) {
                return Err(Refusal::Malformed { what: "triangle", index, problem: "shares a directed edge" });
            }
        }
        match (0..self.points.len()).find(|v| !self.faces.iter().any(|f| f.contains(v))) {
            Some(index) => Err(Refusal::Malformed { what: "position", index, problem: "is at no face" }),
            None => Ok(()),
        }
    }

    /// Twice the signed area of the triangle `abc`.
    pub fn area(&self, a: usize, b: usize, c: usize) -> IBig {
        let [a, b, c] = [a, b, c].map(|v| &self.points[v]);
        (&b[0] - &a[0]) * (&c[1] - &a[1]) - (&b[1] - &a[1]) * (&c[0] - &a[0])
    }

    /// The dot product of the sides at a corner.
    fn dot(&self, apex: usize, p: usize, q: usize) -> IBig {
        let [o, p, q] = [apex, p, q].map(|v| &self.points[v]);
        (&p[0] - &o[0]) * (&q[0] - &o[0]) + (&p[1] - &o[1]) * (&q[1] - &o[1])
    }

    /// The in-circle determinant: positive iff d is inside the circle through the counter-clockwise a, b, c.
    pub fn incircle(&self, a: usize, b: usize, c: usize, d: usize) -> IBig {
        let lift = |v: usize| self.dot(d, v, v);
        lift(a) * self.area(d, b, c) + lift(b) * self.area(d, c, a) + lift(c) * self.area(d, a, b)
    }

    /// Refuses a triangulation with a vertex inside the circle of a triangle. By whole numbers, every vertex against every circle.
    pub fn check_delaunay(&self) -> Result<(), Refusal> {
        for &[a, b, c] in &self.faces {
            if let Some(d) = (0..self.points.len()).find(|&d| self.incircle(a, b, c, d) > IBig::ZERO) {
                return Err(Refusal::untrue(
                    "the circle of every triangle is empty",
                    format!("vertex {d} is inside that of ({a}, {b}, {c})"),
                ));
            }
        }
        Ok(())
    }

    /// Refuses triangles that are no triangulation of the convex hull: the boundary runs once around with every point on its left,
    /// so that the triangles, all counter-clockwise, cover every place inside once.
    pub fn check_fills_the_hull(&self) -> Result<(), Refusal> {
        let boundary = self.boundary();
        let starts: BTreeSet<usize> = boundary.iter().map(|e| e[0]).collect();
        let left = |&[a, b]: &[usize; 2]| (0..self.points.len()).all(|v| self.area(a, b, v) >= IBig::ZERO);
        if starts.len() == boundary.len() && boundary.iter().all(left) {
            return Ok(());
        }
        Err(Refusal::untrue("the triangles fill the convex hull", "they do not"))
    }

    /// The vertices of the boundary in their order, if it is one simple polygon. Then it runs once around every place inside, so
    /// that the triangles, all counter-clockwise, cover each of them once: they are a triangulation of the polygon.
    pub fn outline(&self) -> Result<Vec<usize>, Refusal> {
        let boundary = self.boundary();
        let next: BTreeMap<usize, usize> = boundary.iter().map(|&[a, b]| (a, b)).collect();
        let mut cycle: Vec<usize> = next.keys().take(1).copied().collect();
        while let Some(&v) = cycle.last().and_then(|v| next.get(v)).filter(|v| **v != cycle[0]) {
            if cycle.len() == next.len() {
                break;
            }
            cycle.push(v);
        }
        // A vertex from which two edges go on has one of them in the map.
        if next.len() != boundary.len() || cycle.len() != next.len() || cycle.is_empty() {
            return Err(Refusal::untrue("the boundary is one polygon", "it is not"));
        }
        let corners: Vec<_> = cycle.iter().map(|&v| self.points[v].clone().map(Rational::from)).collect();
        if polygon::is_simple(&corners) {
            return Ok(cycle);
        }
        Err(Refusal::untrue("the boundary is a simple polygon", "it meets itself"))
    }

    /// The cotangent stiffness: each corner adds half its cotangent, dot product over twice the area, to the edge opposite.
    pub fn stiffness(&self) -> Upper {
        let mut l = Upper::new();
        for &f in &self.faces {
            for k in 0..3 {
                let (apex, p, q) = (f[k], f[(k + 1) % 3], f[(k + 2) % 3]);
                let weight = fraction(self.dot(apex, p, q), IBig::from(2) * self.area(f[0], f[1], f[2]));
                add(&mut l, p, p, weight.clone());
                add(&mut l, q, q, weight.clone());
                add(&mut l, p.min(q), p.max(q), -weight);
            }
        }
        l
    }

    /// The mass matrix.
    pub fn mass(&self, kind: Weighting) -> Upper {
        let mut m = Upper::new();
        if kind == Weighting::Unit {
            (0..self.points.len()).for_each(|v| add(&mut m, v, v, Rational::ONE));
        }
        for &f in &self.faces {
            // Twice the area over the number of such shares in it.
            let share = |shares: i64| fraction(self.area(f[0], f[1], f[2]), IBig::from(2 * shares));
            for (k, &v) in f.iter().enumerate() {
                let w = f[(k + 1) % 3];
                match kind {
                    Weighting::Unit => {}
                    Weighting::Barycentric => add(&mut m, v, v, share(3)),
                    Weighting::Consistent => {
                        add(&mut m, v, v, share(6));
                        add(&mut m, v.min(w), v.max(w), share(12));
                    }
                }
            }
        }
        m
    }

    /// The directed edges that have a triangle on their left and none on their right.
    pub fn boundary(&self) -> Vec<[usize; 2]> {
        let sides: BTreeSet<[usize; 2]> =
            self.faces.iter().flat_map(|f| (0..3).map(|k| [f[k], f[(k + 1) % 3]])).collect();
        sides.iter().filter(|[a, b]| !sides.contains(&[*b, *a])).copied().collect()
    }
}

/// Adds to an entry.
pub(super) fn add(l: &mut Upper, i: usize, j: usize, value: Rational) {
    let entry = l.entry((i, j)).or_insert_with(Rational::zero);
    *entry = (entry.clone() + value).reduced();
}

/// The entry at `(i, j)` or `(j, i)`.
pub(super) fn entry(l: &Upper, i: usize, j: usize) -> Rational {
    l.get(&(i.min(j), i.max(j))).cloned().unwrap_or_else(Rational::zero)
}

/// The first entry in which two matrices differ.
pub(super) fn difference(l: &Upper, m: &Upper) -> Option<(usize, usize)> {
    let places: BTreeSet<(usize, usize)> = l.keys().chain(m.keys()).copied().collect();
    places.into_iter().find(|&(i, j)| (entry(l, i, j) - entry(m, i, j)).cmp_zero() != Ordering::Equal)
}

/// A triangle from its smallest corner.
pub(super) fn from_smallest(mut t: [usize; 3]) -> [usize; 3] {
    while t[0] > t[1] || t[0] > t[2] {
        t.rotate_left(1);
    }
    t
}
