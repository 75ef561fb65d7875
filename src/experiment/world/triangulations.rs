//! Every triangulation of few lattice points: all point sets of a box up to its symmetries, all triangulations of each by
//! flips.
//!
//! A triangulation of a point set uses every point and fills the convex hull. Any two of them are joined by flips (Lawson
//! 1972), so a search that follows every flip from one of them has met them all.

use std::collections::BTreeSet;

use crate::domain::Surface;

/// A point of the integer lattice.
pub type Point = [i64; 2];

/// A triangulation of lattice points in the plane: counter-clockwise triangles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Triangulation {
    points: Vec<Point>,
    faces: Vec<[usize; 3]>,
}

/// An edge of a triangulation with its one or two opposite vertices, the one to the left of `ends[0] → ends[1]` first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Its ends; the face of `left` runs from the first to the second.
    pub ends: [usize; 2],
    /// The vertex opposite in the face to the left.
    pub left: usize,
    /// The vertex opposite in the face to the right; none on the boundary.
    pub right: Option<usize>,
}

/// Twice the signed area of a triangle.
pub fn doubled_area(a: Point, b: Point, c: Point) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

impl Triangulation {
    /// The triangulation with these counter-clockwise faces.
    pub(in crate::experiment) fn new(points: &[Point], mut faces: Vec<[usize; 3]>) -> Self {
        faces.iter_mut().for_each(|f| {
            while f[0] > f[1] || f[0] > f[2] {
                f.rotate_left(1)
            }
        });
        faces.sort_unstable();
        Triangulation { points: points.to_vec(), faces }
    }

    /// The points.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// The faces, each counter-clockwise from its smallest corner, in lexicographic order.
    pub fn faces(&self) -> &[[usize; 3]] {
        &self.faces
    }

    /// The edges in lexicographic order of the sorted ends.
    pub fn edges(&self) -> Vec<Edge> {
        let mut sides: Vec<([usize; 2], bool, usize)> = Vec::with_capacity(3 * self.faces.len());
        for f in &self.faces {
            for k in 0..3 {
                let (a, b, apex) = (f[k], f[(k + 1) % 3], f[(k + 2) % 3]);
                sides.push(([a.min(b), a.max(b)], a > b, apex));
            }
        }
        sides.sort_unstable();
        let mut edges: Vec<Edge> = Vec::new();
        let mut last = None;
        for (ends, backward, apex) in sides {
            match edges.last_mut() {
                Some(edge) if last == Some(ends) => edge.right = Some(apex),
                _ => {
                    let ends = if backward { [ends[1], ends[0]] } else { ends };
                    edges.push(Edge { ends, left: apex, right: None });
                }
            }
            last = Some(ends);
        }
        edges
    }

    /// For each vertex, whether it is on the boundary.
    pub fn boundary(&self) -> Vec<bool> {
        let mut boundary = vec![false; self.points.len()];
        for edge in self.edges().iter().filter(|e| e.right.is_none()) {
            edge.ends.iter().for_each(|&v| boundary[v] = true);
        }
        boundary
    }

    /// The neighbours of a vertex, ascending.
    pub fn neighbours(&self, vertex: usize) -> Vec<usize> {
        let mut found: Vec<usize> =
            self.faces.iter().filter(|f| f.contains(&vertex)).flatten().copied().filter(|&v| v != vertex).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The triangulation as a domain.
    ///
    /// # Panics
    /// Never for a triangulation of this module: indices are in range and coordinates small whole numbers.
    pub fn surface(&self) -> Surface {
        let positions: Vec<[f64; 2]> = self.points.iter().map(|p| p.map(|x| x as f64)).collect();
        Surface::planar(&positions, &self.faces).expect("corners in range, coordinates finite")
    }

    /// The triangulation in words.
    pub fn describe(&self) -> String {
        let points: Vec<String> = self.points.iter().map(|p| format!("({}, {})", p[0], p[1])).collect();
        let faces: Vec<String> = self.faces.iter().map(|f| format!("{}-{}-{}", f[0], f[1], f[2])).collect();
        format!("points {}, triangles {}", points.join(" "), faces.join(" "))
    }

    /// The triangulation with this interior edge flipped; `None` unless its two triangles form a strictly convex quadrangle.
    pub fn flipped(&self, edge: &Edge) -> Option<Self> {
        let ([a, b], c, d) = (edge.ends, edge.left, edge.right?);
        let turn = |i: usize, j: usize, k: usize| doubled_area(self.points[i], self.points[j], self.points[k]);
        if turn(d, b, c) <= 0 || turn(c, a, d) <= 0 {
            return None;
        }
        let beside = |f: &&[usize; 3]| !(f.contains(&a) && f.contains(&b));
        let kept = self.faces.iter().filter(beside).copied();
        Some(Triangulation::new(&self.points, kept.chain([[d, b, c], [c, a, d]]).collect()))
    }
}

/// All triangulations of a set of distinct points, in lexicographic order of their faces; none if they are collinear.
pub fn triangulations(points: &[Point]) -> Vec<Triangulation> {
    let Some(first) = sweep(points) else { return Vec::new() };
    let mut met: BTreeSet<Vec<[usize; 3]>> = BTreeSet::from([first.faces.clone()]);
    let mut next = vec![first];
    while let Some(current) = next.pop() {
        for flipped in current.edges().iter().filter_map(|e| current.flipped(e)) {
            if met.insert(flipped.faces.clone()) {
                next.push(flipped);
            }
        }
    }
    met.into_iter().map(|faces| Triangulation { points: points.to_vec(), faces }).collect()
}

/// One triangulation: points in lexicographic order, each joined to the part of the hull that it sees; `None` for points on a
/// line.
pub fn sweep(points: &[Point]) -> Option<Triangulation> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_key(|&i| points[i]);
    let turn = |i: usize, j: usize, k: usize| doubled_area(points[i], points[j], points[k]);
    // The first points may be collinear: the first one off their line is joined to each segment between them.
    let off = (2..order.len()).find(|&k| turn(order[0], order[1], order[k]) != 0)?;
    let apex = order[off];
    let (mut line, mut faces) = (order[..off].to_vec(), Vec::new());
    if turn(line[0], line[1], apex) < 0 {
        line.reverse();
    }
    faces.extend(line.windows(2).map(|w| [w[0], w[1], apex]));
    let mut hull = [line, vec![apex]].concat();
    for &p in &order[off + 1..] {
        let n = hull.len();
        let sees = |k: usize| turn(hull[k % n], hull[(k + 1) % n], p) < 0;
        // The point is outside the hull, so it sees a chain of its edges, and not all of them.
        let start = (0..n).find(|&k| sees(k) && !sees(k + n - 1))?;
        let count = (0..n).take_while(|&k| sees(start + k)).count();
        faces.extend((start..start + count).map(|k| [hull[(k + 1) % n], hull[k % n], p]));
        let kept = (start + count..=start + n).map(|k| hull[k % n]);
        hull = kept.chain([p]).collect();
    }
    Some(Triangulation::new(points, faces))
}

/// The point sets with `n` points in lattice boxes of at most `side` × `side` unit squares, once up to the symmetries of the
/// box and translation: those whose bounding box has its corner at the origin and is no higher than wide. The smaller box
/// comes first (by width, then height), within a box the lexicographic order decides.
pub fn point_sets(n: usize, side: i64) -> Vec<Vec<Point>> {
    let mut sets = Vec::new();
    for width in 1..=side {
        for height in 0..=width {
            let cells: Vec<Point> = (0..=width).flat_map(|x| (0..=height).map(move |y| [x, y])).collect();
            let fills = |s: &[Point]| {
                let reaches = |axis: usize, value: i64| s.iter().any(|p| p[axis] == value);
                reaches(0, 0) && reaches(0, width) && reaches(1, 0) && reaches(1, height)
            };
            let mut chosen = Vec::with_capacity(n);
            subsets(&cells, n, &mut chosen, &mut |s| {
                if fills(s) && is_first_of_its_images(s, width, height) {
                    sets.push(s.to_vec());
                }
            });
        }
    }
    sets
}

fn subsets(cells: &[Point], n: usize, chosen: &mut Vec<Point>, visit: &mut impl FnMut(&[Point])) {
    if chosen.len() == n {
        return visit(chosen);
    }
    for (k, &cell) in cells.iter().enumerate() {
        chosen.push(cell);
        subsets(&cells[k + 1..], n, chosen, visit);
        chosen.pop();
    }
}

/// Whether no symmetry of the box takes the sorted set to one that comes before it.
fn is_first_of_its_images(set: &[Point], width: i64, height: i64) -> bool {
    (1..8).all(|symmetry| {
        if symmetry & 4 != 0 && width != height {
            return true;
        }
        let image = |&[x, y]: &Point| {
            let x = if symmetry & 1 != 0 { width - x } else { x };
            let y = if symmetry & 2 != 0 { height - y } else { y };
            if symmetry & 4 != 0 { [y, x] } else { [x, y] }
        };
        let mut images: Vec<Point> = set.iter().map(image).collect();
        images.sort_unstable();
        set <= images.as_slice()
    })
}

/// Every triangulation of every point set with 3 to `largest` points ([`point_sets`], box of 3 × 3 unit squares), fewest
/// points first.
pub fn world(largest: usize) -> impl Iterator<Item = Triangulation> {
    (3..=largest).flat_map(|n| point_sets(n, 3)).flat_map(|points| triangulations(&points))
}

/// The world in words, for the question of a finding.
pub fn describe_world(largest: usize) -> String {
    format!(
        "every triangulation of every set of 3 to {largest} points in a box of 4 × 4 lattice points, up to its symmetries; \
         fewest points first, then the smaller box, then lexicographic"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(width: i64, height: i64) -> Vec<Point> {
        (0..=width).flat_map(|x| (0..=height).map(move |y| [x, y])).collect()
    }

    #[test]
    fn the_numbers_of_triangulations_are_the_known_ones() {
        // Convex polygons: Catalan numbers. Grids: Kaibel and Ziegler 2003, f(1, n) = (2n choose n), f(2, 2) = 64, f(2, 3) = 852.
        assert_eq!(triangulations(&[[0, 0], [1, 0], [1, 1], [0, 1]]).len(), 2);
        assert_eq!(triangulations(&[[1, 0], [2, 0], [3, 1], [3, 2], [1, 3], [0, 2]]).len(), 14);
        assert_eq!(triangulations(&grid(2, 1)).len(), 6);
        assert_eq!(triangulations(&grid(3, 1)).len(), 20);
        assert_eq!(triangulations(&grid(2, 2)).len(), 64);
        assert_eq!(triangulations(&grid(3, 2)).len(), 852);
        assert!(triangulations(&[[0, 0], [1, 1], [2, 2]]).is_empty());
    }

    #[test]
    fn every_triangulation_fills_its_convex_hull_with_counter_clockwise_triangles() {
        for t in world(5) {
            let areas = t.faces().iter().map(|f| doubled_area(t.points[f[0]], t.points[f[1]], t.points[f[2]]));
            assert!(areas.clone().all(|a| a > 0));
            // The hull's area from the boundary edges alone (the shoelace formula).
            let shoelace = |e: &Edge| {
                let [p, q] = e.ends.map(|v| t.points[v]);
                p[0] * q[1] - p[1] * q[0]
            };
            assert_eq!(areas.sum::<i64>(), t.edges().iter().filter(|e| e.right.is_none()).map(shoelace).sum::<i64>());
            assert_eq!(t.boundary(), t.surface().topology().boundary_vertices());
            assert!((0..t.points.len()).all(|v| !t.neighbours(v).is_empty()), "every point is used");
        }
    }

    #[test]
    fn every_set_of_points_has_one_representative() {
        // Two points fill a box only as the ends of a diagonal, and the two diagonals are mirror images: one set for each of
        // the 9 boxes of width 1 to 3 and no greater height.
        assert_eq!(point_sets(2, 3).len(), 9);
        // Brute force: the orbits of all triples of the 3 × 3 lattice under its 8 symmetries and translations.
        let cells = grid(2, 2);
        let mut orbits = BTreeSet::new();
        let mut chosen = Vec::new();
        subsets(&cells, 3, &mut chosen, &mut |s| {
            let images = (0..8).map(|symmetry| {
                let turned = s.iter().map(|&[x, y]| match symmetry % 4 {
                    0 => [x, y],
                    1 => [-y, x],
                    2 => [-x, -y],
                    _ => [y, -x],
                });
                let turned: Vec<Point> = turned.map(|[x, y]| if symmetry < 4 { [x, y] } else { [-x, y] }).collect();
                let low = |axis: usize| turned.iter().map(|p| p[axis]).min().unwrap();
                let mut moved: Vec<Point> = turned.iter().map(|p| [p[0] - low(0), p[1] - low(1)]).collect();
                moved.sort_unstable();
                moved
            });
            orbits.extend(images.min());
        });
        assert_eq!(point_sets(3, 2).len(), orbits.len());
    }

    #[test]
    fn flipping_an_edge_twice_gives_the_same_triangulation() {
        let mut flips = 0;
        for t in world(5) {
            for edge in t.edges() {
                let Some(flipped) = t.flipped(&edge) else { continue };
                let back = flipped.edges().into_iter().find(|e| !t.edges().iter().any(|f| same_ends(e, f))).unwrap();
                assert_eq!(flipped.flipped(&back), Some(t.clone()));
                flips += 1;
            }
        }
        assert!(flips > 100);
    }

    fn same_ends(a: &Edge, b: &Edge) -> bool {
        a.ends == b.ends || a.ends == [b.ends[1], b.ends[0]]
    }
}
