//! Flips to Delaunay.

use std::cmp::Ordering;
use std::collections::VecDeque;

use super::{Face, IntrinsicTriangulation, NONE, area_in_space, distance};
use crate::domain::{delaunay, geometry};

/// The unit of every rounding bound, u = 2⁻⁵³.
const UNIT: f64 = f64::EPSILON / 2.0;

/// The diagonal that a flip would put in, with twice the areas of the triangle at the start of the old edge and at its end.
struct OtherDiagonal {
    length: f64,
    areas: [f64; 2],
}

impl IntrinsicTriangulation<'_> {
    /// Flips until every interior edge is Delaunay; returns the number of flips. Edges wait in a queue that starts in their
    /// order, so the result depends on nothing else. A flip costs O(1), plus exact arithmetic where rounding could decide.
    pub fn make_delaunay(&mut self) -> usize {
        self.make_delaunay_knowing(|_| None)
    }

    /// The same where the exact sign of the cotangent sum is `known` of edges of the surface, as far as it is: it is asked for
    /// those between two triangles that no flip has touched. What becomes of the triangulation does not depend on it.
    pub fn make_delaunay_knowing(&mut self, known: impl Fn(usize) -> Option<Ordering>) -> usize {
        let before = self.flips;
        let mut queue: VecDeque<usize> = (0..self.edge_count()).collect();
        let mut queued = vec![true; self.edge_count()];
        while let Some(edge) = queue.pop_front() {
            queued[edge] = false;
            let Some(around) = self.improve(edge, &known) else { continue };
            for side in around.map(|h| h / 2) {
                if !std::mem::replace(&mut queued[side], true) {
                    queue.push_back(side);
                }
            }
        }
        self.flips - before
    }

    /// Flips the edge if it is not Delaunay; returns the half-edges of the four sides around it.
    fn improve(&mut self, edge: usize, known: impl Fn(usize) -> Option<Ordering>) -> Option<[usize; 4]> {
        let (h, t) = (2 * edge, 2 * edge + 1);
        // The two angles opposite an edge within a single triangle add up to less than π.
        let (f, g) = (self.face(h), self.face(t));
        if !self.is_inside(h) || !self.is_inside(t) || f == g {
            return None;
        }
        let sign = if self.touched[edge] { None } else { known(edge) };
        if sign.is_some_and(|sign| sign != Ordering::Less) {
            return None;
        }
        let straight = self.is_straight(f) && self.is_straight(g);
        let violated = match straight {
            true => sign.unwrap_or_else(|| self.exact_sign(edge)) == Ordering::Less,
            false => self.is_clearly_negative(edge),
        };
        if !violated {
            return None;
        }
        let flipped = if self.is_planar() { self.other_diagonal_in_plane(edge) } else { self.other_diagonal(edge) };
        let proper = flipped.areas.iter().chain([&flipped.length]).all(|&x| x > 0.0 && x.is_finite());
        if !proper || !(straight || self.lowers_index(edge, &flipped)) {
            return None;
        }
        self.flip(edge, &flipped);
        Some([self.next(h), self.next(self.next(h)), self.next(t), self.next(self.next(t))])
    }

    /// The vertices around an edge: its start a, the apex c to its left, its end b, the apex d to its right.
    fn quadrilateral(&self, edge: usize) -> [usize; 4] {
        let (h, t) = (2 * edge, 2 * edge + 1);
        let apex = |h: usize| self.origin(self.next(self.next(h)));
        [self.origin(h), apex(h), self.origin(t), apex(t)]
    }

    /// The sign of the cotangent sum of an edge between straight triangles, exactly.
    fn exact_sign(&self, edge: usize) -> Ordering {
        let [a, c, b, d] = self.quadrilateral(edge).map(|v| self.surface.positions()[v]);
        match self.plane {
            None => delaunay::cotangent_sum_sign(a, b, &[c, d]).unwrap_or(Ordering::Equal),
            Some([x, y]) => {
                let [a, b, c, d] = [a, b, c, d].map(|p| [p[x], p[y]]);
                let inside = geometry::incircle(a, b, c, d);
                // Either every triangle of a planar mesh is counter-clockwise or none is.
                if self.counter_clockwise { inside.reverse() } else { inside }
            }
        }
    }

    /// Whether the cotangent sum of the stored lengths and areas is negative by more than its rounding.
    fn is_clearly_negative(&self, edge: usize) -> bool {
        let (h, t) = (2 * edge, 2 * edge + 1);
        let bound = |h: usize| 8.0 * UNIT * self.squares(h).iter().sum::<f64>() / self.doubled_area(self.face(h));
        self.cotangent_opposite(h) + self.cotangent_opposite(t) < -(bound(h) + bound(t))
    }

    /// The other diagonal from lengths and areas, the two triangles laid out flat with the edge on the x-axis.
    fn other_diagonal(&self, edge: usize) -> OtherDiagonal {
        let (h, t) = (2 * edge, 2 * edge + 1);
        let length = self.length[edge];
        // Where the apex is, seen from the start of the half-edge: along it, and away from it.
        let apex = |h: usize| {
            let (n, p) = (self.next(h), self.next(self.next(h)));
            let (from_end, from_start) = (self.length[n / 2], self.length[p / 2]);
            let along = 0.5 * (length + (from_start - from_end) * ((from_start + from_end) / length));
            (along, self.doubled_area(self.face(h)) / length)
        };
        let ((c, above), (d_from_end, below)) = (apex(h), apex(t));
        let d = length - d_from_end;
        OtherDiagonal {
            length: (c - d).hypot(above + below),
            areas: [d * above + c * below, d_from_end * above + (length - c) * below],
        }
    }

    /// The other diagonal from positions.
    fn other_diagonal_in_plane(&self, edge: usize) -> OtherDiagonal {
        let [a, c, b, d] = self.quadrilateral(edge).map(|v| self.surface.point(v));
        OtherDiagonal { length: distance(c, d), areas: [area_in_space([d, c, a]), area_in_space([c, d, b])] }
    }

    /// Whether the sum of the six cotangents of the two triangles, `Σ (a² + b² + c²)/4A`, decreases by the flip.
    fn lowers_index(&self, edge: usize, flipped: &OtherDiagonal) -> bool {
        let (h, t) = (2 * edge, 2 * edge + 1);
        let index = |squares: [f64; 3], doubled_area: f64| squares.iter().sum::<f64>() / doubled_area;
        let stored = |h: usize| {
            let face = self.face(h);
            index(self.squares(self.faces[face].first as usize), self.doubled_area(face))
        };
        let (after_h, after_t) = (self.next(h), self.next(t));
        let square = |h: usize| self.length[h / 2] * self.length[h / 2];
        let diagonal = flipped.length * flipped.length;
        let near = index([diagonal, square(self.next(after_h)), square(after_t)], flipped.areas[0]);
        let far = index([diagonal, square(self.next(after_t)), square(after_h)], flipped.areas[1]);
        near + far < stored(h) + stored(t)
    }

    /// Replaces the edge ab by the other diagonal: its left triangle becomes d c a, its right one c d b.
    fn flip(&mut self, edge: usize, flipped: &OtherDiagonal) {
        let [_, c, _, d] = self.quadrilateral(edge);
        let (h, t) = (2 * edge, 2 * edge + 1);
        let (bc, ad) = (self.next(h), self.next(t));
        let (ca, db) = (self.next(bc), self.next(ad));
        let (left, right) = (self.face(h), self.face(t));
        for (ring, face) in [([h, ca, ad], left), ([t, db, bc], right)] {
            for k in 0..3 {
                let half_edge = &mut self.half_edges[ring[k]];
                (half_edge.next, half_edge.face) = (ring[(k + 1) % 3] as u32, face as u32);
            }
        }
        (self.half_edges[h].origin, self.half_edges[t].origin) = (d as u32, c as u32);
        let (straight, source) = (self.is_planar(), NONE);
        for (face, first, doubled_area) in [(left, h, flipped.areas[0]), (right, t, flipped.areas[1])] {
            self.faces[face] = Face { doubled_area, first: first as u32, source, straight };
        }
        [edge, bc / 2, ca / 2, ad / 2, db / 2].into_iter().for_each(|e| self.touched[e] = true);
        self.length[edge] = flipped.length;
        self.flips += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Surface;
    use crate::domain::intrinsic::IntrinsicError;

    fn all(_: usize) -> bool {
        true
    }

    /// Numbers in [0, 1) from a linear congruence.
    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    /// Every invariant of the structure.
    fn sanity_check(t: &IntrinsicTriangulation) {
        for face in 0..t.face_count() {
            let ring = t.half_edges(face);
            assert!(ring.iter().all(|&h| t.face(h) == face && t.next(t.next(t.next(h))) == h));
            let [a, b, c] = ring.map(|h| t.length(h / 2));
            assert!(a < b + c && b < c + a && c < a + b, "triangle inequality in {face}: {a} {b} {c}");
            let s = 0.5 * (a + b + c);
            let heron = 2.0 * (s * (s - a)).sqrt() * ((s - b) * (s - c)).sqrt();
            assert!((t.doubled_area(face) / heron - 1.0).abs() < 1e-6, "area of {face}");
        }
        for edge in 0..t.edge_count() {
            for h in t.sides(edge) {
                let other = h ^ 1;
                if t.is_inside(other) {
                    assert_eq!(t.origin(h), t.origin(t.next(other)));
                }
            }
        }
    }

    fn total(t: &IntrinsicTriangulation) -> f64 {
        (0..t.face_count()).map(|f| 0.5 * t.doubled_area(f)).sum()
    }

    /// A planar mesh of random points whose triangulation is spoilt by flips of strictly convex pairs.
    fn spoilt(seed: u64, n: usize) -> (Vec<[f64; 2]>, Vec<[usize; 3]>) {
        use spade::{DelaunayTriangulation, Point2, Triangulation};
        let mut unit = numbers(seed);
        let points: Vec<[f64; 2]> = (0..n).map(|_| [unit(), unit()]).collect();
        let delaunay: DelaunayTriangulation<Point2<f64>> =
            DelaunayTriangulation::bulk_load_stable(points.iter().map(|p| Point2::new(p[0], p[1])).collect()).unwrap();
        let mut faces: Vec<[usize; 3]> =
            delaunay.inner_faces().map(|f| f.vertices().map(|v| v.fix().index())).collect();
        for _ in 0..4 * n {
            let (f, k) = ((unit() * faces.len() as f64) as usize, (unit() * 3.0) as usize);
            let [a, b, c] = std::array::from_fn(|m| faces[f][(k + m) % 3]);
            let Some(g) = faces.iter().position(|t| (0..3).any(|m| t[m] == b && t[(m + 1) % 3] == a)) else { continue };
            let d = faces[g].into_iter().find(|v| ![a, b].contains(v)).unwrap();
            let turn = |x: usize, y: usize, z: usize| geometry::orient2d(points[x], points[y], points[z]);
            if turn(d, c, a).is_gt() && turn(c, d, b).is_gt() {
                (faces[f], faces[g]) = ([d, c, a], [c, d, b]);
            }
        }
        (points, faces)
    }

    fn delaunay_edges(points: &[[f64; 2]]) -> Vec<[usize; 2]> {
        use spade::{DelaunayTriangulation, Point2, Triangulation};
        let delaunay: DelaunayTriangulation<Point2<f64>> =
            DelaunayTriangulation::bulk_load_stable(points.iter().map(|p| Point2::new(p[0], p[1])).collect()).unwrap();
        let edge = |e: [usize; 2]| [e[0].min(e[1]), e[0].max(e[1])];
        let mut edges: Vec<_> =
            delaunay.undirected_edges().map(|e| edge(e.vertices().map(|v| v.fix().index()))).collect();
        edges.sort_unstable();
        edges
    }

    fn edges_of(t: &IntrinsicTriangulation) -> Vec<[usize; 2]> {
        let mut edges: Vec<_> =
            (0..t.edge_count()).filter_map(|e| t.ends(e)).map(|[a, b]| [a.min(b), a.max(b)]).collect();
        edges.sort_unstable();
        edges
    }

    #[test]
    fn flips_in_the_plane_reach_the_triangulation_that_spade_builds() {
        for seed in 0..4 {
            let (points, faces) = spoilt(seed, 150);
            let surface = Surface::planar(&points, &faces).unwrap();
            let mut t = IntrinsicTriangulation::new(&surface, all).unwrap();
            assert!(t.make_delaunay() > 50);
            sanity_check(&t);
            assert_eq!(edges_of(&t), delaunay_edges(&points));
            assert!((0..t.face_count()).all(|f| t.is_straight(f)));
        }
    }

    #[test]
    fn flips_by_lengths_reach_it_as_well() {
        for seed in 0..4 {
            let (points, faces) = spoilt(seed, 150);
            // Turned out of the coordinate plane: nothing but lengths is left once a flip has been made.
            let turned = points.iter().map(|p| [0.6 * p[0], p[1], 0.8 * p[0]]).collect();
            let surface = Surface::triangles(turned, &faces).unwrap();
            let mut t = IntrinsicTriangulation::new(&surface, all).unwrap();
            let before = total(&t);
            t.make_delaunay();
            sanity_check(&t);
            assert_eq!(edges_of(&t), delaunay_edges(&points));
            assert!((total(&t) / before - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_doubled_obtuse_triangle_gets_a_loop() {
        // Angles α at a with tan α = 1/3 and β at b with tan β = 1/2, obtuse at c; the front is glued to the back. The flip of ab
        // joins c to itself across the fold: a loop of twice the height, in triangles with the angles 2α and 2β.
        let p = vec![[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [3.0, 1.0, 0.0]];
        let surface = Surface::triangles(p, &[[0, 1, 2], [0, 2, 1]]).unwrap();
        let mut t = IntrinsicTriangulation::new(&surface, all).unwrap();
        assert_eq!(t.make_delaunay(), 1);
        sanity_check(&t);
        assert_eq!(t.ends(0), Some([2, 2]));
        assert!((t.length(0) - 2.0).abs() < 1e-15);
        // Base angles are 90° − α and 90° − β: both sides of ac see 90° − α, whose cotangent is tan α.
        for (edge, tangent) in [(1, 1.0 / 3.0), (2, 0.5)] {
            for h in t.sides(edge) {
                assert!((t.cotangent_opposite(h) - tangent).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn cocircular_edges_are_left_alone_in_every_position() {
        let n = 12;
        let mut faces = Vec::new();
        for k in (0..n * n).filter(|k| k % n + 1 < n && k / n + 1 < n) {
            faces.extend([[k, k + 1, k + n + 1], [k, k + n + 1, k + n]]);
        }
        for s in [1.0, 0.1, 1e-100] {
            let grid = |k: usize| [s * (k % n) as f64, s * (k / n) as f64];
            let turned = (0..n * n).map(grid).map(|[x, y]| [0.6 * x, y, 0.8 * x]).collect();
            let surface = Surface::triangles(turned, &faces).unwrap();
            let mut t = IntrinsicTriangulation::new(&surface, all).unwrap();
            // Rounded coordinates put a corner on either side of the circle; no square is flipped more than once for that.
            assert!(t.make_delaunay() <= (n - 1) * (n - 1));
            sanity_check(&t);
        }
    }

    #[test]
    fn what_cannot_be_glued_is_refused_with_its_edge() {
        let fan = Surface::triangles(
            vec![[0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]],
            &[[0, 1, 2], [0, 1, 3], [0, 1, 4]],
        )
        .unwrap();
        let refusal = IntrinsicTriangulation::new(&fan, all).unwrap_err();
        assert_eq!(refusal.to_string(), "edge (0, 1) has 3 faces; separate the sheets first");
        assert!(
            IntrinsicTriangulation::new(&fan, |f| f != 1).is_err(),
            "the two that are left disagree in orientation"
        );
        let ring = |k: usize| (std::f64::consts::TAU * k as f64 / 5.0).sin_cos();
        let moebius = (0..5).map(|k| [ring(k).0, ring(k).1, f64::from(k as u8 % 2)]).collect();
        let strip: Vec<[usize; 3]> = (0..5).map(|k| [k, (k + 1) % 5, (k + 2) % 5]).collect();
        let strip = Surface::triangles(moebius, &strip).unwrap();
        assert!(matches!(IntrinsicTriangulation::new(&strip, all), Err(IntrinsicError::NotOrientable { .. })));
    }
}
