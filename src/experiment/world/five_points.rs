//! Five points of the integer lattice in space: all sets in a box up to its symmetries, their two triangulations, the spheres
//! and the stiffness matrices, in whole numbers and fractions.
//!
//! Five points that are not coplanar have one affine dependency `Σ w_k = 0`, `Σ w_k x_k = 0` up to a factor; `w_k` is, up to the
//! sign `(−1)^k`, six times the volume of the other four. Leaving out each point with w > 0 in turn gives one triangulation,
//! each with w < 0 the other (Radon, Lawson). Both use all points where there are at least two signs of either kind:
//! * two and three: two tetrahedra over a common triangle, or three around the segment that pierces it;
//! * two and two: a pyramid over a quadrilateral, cut along either diagonal.

use std::cmp::Ordering;

use crate::linalg::Dense;
use crate::property::{Evidence, Excerpt, Statement};
use crate::scalar::{Rational, Scalar};

/// A point of the integer lattice.
pub type Point = [i64; 3];

/// Tetrahedra by the numbers of their corners, ascending.
pub type Tetrahedra = Vec<[usize; 4]>;

/// Five points with two triangulations that use them all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FivePoints {
    /// The points.
    pub points: [Point; 5],
    /// The affine dependency; as many negative components as positive ones, or more.
    pub w: [i64; 5],
    /// The triangulation that leaves out each point with w > 0 in turn: two tetrahedra.
    pub two: Tetrahedra,
    /// The triangulation that leaves out each point with w < 0: three tetrahedra, or two for a pyramid.
    pub other: Tetrahedra,
}

impl FivePoints {
    /// The two triangulations; `None` where five points have not two that use them all.
    pub fn of(points: [Point; 5]) -> Option<Self> {
        let volumes: [i64; 5] = std::array::from_fn(|k| volume(&points, without(k)));
        let mut w: [i64; 5] = std::array::from_fn(|k| if k % 2 == 0 { volumes[k] } else { -volumes[k] });
        let count = |w: &[i64; 5], sign| w.iter().filter(|x| x.cmp(&&0) == sign).count();
        if count(&w, Ordering::Greater) > count(&w, Ordering::Less) {
            w = w.map(|x| -x);
        }
        if count(&w, Ordering::Greater) < 2 {
            return None;
        }
        let leaving = |sign| (0..5).filter(|&k| w[k].cmp(&0) == sign).map(without).collect();
        Some(FivePoints { points, w, two: leaving(Ordering::Greater), other: leaving(Ordering::Less) })
    }

    /// Whether it is a pyramid over a quadrilateral.
    pub fn is_pyramid(&self) -> bool {
        self.other.len() == 2
    }

    /// The two points with w > 0: the ends of the segment that pierces the triangle of the others.
    pub fn piercing(&self) -> [usize; 2] {
        let mut ends = (0..5).filter(|&k| self.w[k] > 0);
        [ends.next().unwrap_or(0), ends.next().unwrap_or(0)]
    }

    /// How the fifth point stands to the sphere through a tetrahedron of `two`: `Greater` inside, so that `other` is the only
    /// Delaunay triangulation; `Less` outside, so that `two` is; `Equal` where all five lie on a sphere.
    pub fn in_sphere(&self) -> Ordering {
        let tet = self.two[0];
        let rest = (0..5).find(|k| !tet.contains(k)).unwrap_or(0);
        let [p, q, r, s] = tet.map(|k| minus(&self.points[k], &self.points[rest]));
        let square = |x: &Point| dot(x, x);
        let triple = |x: &Point, y: &Point, z: &Point| dot(x, &cross(y, z));
        let determinant = square(&p) * triple(&q, &r, &s) - square(&q) * triple(&p, &r, &s)
            + square(&r) * triple(&p, &q, &s)
            - square(&s) * triple(&p, &q, &r);
        (determinant * volume(&self.points, tet).signum()).cmp(&0)
    }

    /// The Delaunay triangulation, where it is the only one, and the other one.
    pub fn delaunay(&self) -> Option<(&Tetrahedra, &Tetrahedra)> {
        match self.in_sphere() {
            Ordering::Greater => Some((&self.other, &self.two)),
            Ordering::Less => Some((&self.two, &self.other)),
            Ordering::Equal => None,
        }
    }

    /// The stiffness matrix of piecewise linear functions, `K_ij = ∫ ∇φ_i·∇φ_j`. With D six times the volume of a tetrahedron,
    /// `D ∇φ_k` is the cross product `n_k` of two sides of the face opposite k that points inwards: `K_ij = Σ n_i·n_j / (6 |D|)`.
    pub fn stiffness(&self, tetrahedra: &[[usize; 4]]) -> Dense<Rational> {
        let mut k = Dense::from_fn(5, 5, |_, _| Rational::zero());
        for tet in tetrahedra {
            let sixfold = 6 * volume(&self.points, *tet).abs();
            let normals = tet.map(|v| self.normal(tet, v));
            for (i, n) in tet.iter().zip(&normals) {
                for (j, m) in tet.iter().zip(&normals) {
                    k.add_to(*i, *j, Rational::from(dot(n, m)) / Rational::from(sixfold));
                }
            }
        }
        k
    }

    /// The cross product of two sides of the face opposite a corner, pointing inwards.
    fn normal(&self, tet: &[usize; 4], apex: usize) -> Point {
        let mut face = tet.iter().filter(|&&v| v != apex).map(|&v| self.points[v]);
        let corner = |p: Option<Point>| p.unwrap_or_default();
        let (p, q, r) = (corner(face.next()), corner(face.next()), corner(face.next()));
        let n = cross(&minus(&q, &p), &minus(&r, &p));
        if dot(&n, &minus(&self.points[apex], &p)) < 0 { n.map(|x| -x) } else { n }
    }

    /// That the function has more energy on the Delaunay triangulation than on the other; `None` where it has not.
    pub fn witness(&self, values: [i64; 5]) -> Option<Evidence> {
        let (delaunay, other) = self.delaunay()?;
        let u = values.map(Rational::from);
        let energy = |t: &[[usize; 4]]| (Rational::half() * self.stiffness(t).quadratic_form(&u)).reduced();
        let (first, second) = (energy(delaunay), energy(other));
        if first <= second {
            return None;
        }
        let statement = Statement::DelaunayNotMinimal {
            delaunay: delaunay.clone(),
            other: other.clone(),
            values: values.iter().map(|&x| x as f64).collect(),
            energies: [first.to_string(), second.to_string()],
        };
        let positions = self.points.iter().map(|p| p.map(|x| x as f64)).enumerate().collect();
        Some(Evidence::new(statement, Excerpt { positions, ..Excerpt::default() }))
    }

    /// The points in words.
    pub fn describe(&self) -> String {
        let points: Vec<String> = self.points.iter().map(|[x, y, z]| format!("({x}, {y}, {z})")).collect();
        format!("the points {}", points.join(" "))
    }
}

fn without(k: usize) -> [usize; 4] {
    std::array::from_fn(|m| if m < k { m } else { m + 1 })
}

fn minus(p: &Point, q: &Point) -> Point {
    std::array::from_fn(|k| p[k] - q[k])
}

fn dot(p: &Point, q: &Point) -> i64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

fn cross(p: &Point, q: &Point) -> Point {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        p[i] * q[j] - p[j] * q[i]
    })
}

/// Six times the signed volume.
fn volume(points: &[Point; 5], [a, b, c, d]: [usize; 4]) -> i64 {
    let [u, v, w] = [b, c, d].map(|k| minus(&points[k], &points[a]));
    dot(&u, &cross(&v, &w))
}

/// Every set of five lattice points with two triangulations whose bounding box is that of one of the boxes, once up to
/// translation and the symmetries of the box. The boxes come by width, then height, then depth, none of them larger than the
/// one before; within a box the lexicographic order decides.
pub fn world(largest: Point) -> Vec<FivePoints> {
    let mut sets = Vec::new();
    for width in 1..=largest[0] {
        for height in 1..=largest[1].min(width) {
            for depth in 1..=largest[2].min(height) {
                in_box([width, height, depth], &mut sets);
            }
        }
    }
    sets
}

/// The world in words.
pub fn describe_world([width, height, depth]: Point) -> String {
    format!(
        "sets of five lattice points in boxes of up to {width} × {height} × {depth} unit cubes, up to their symmetries; the \
         smaller box first, then lexicographic"
    )
}

fn in_box(size: Point, sets: &mut Vec<FivePoints>) {
    let [width, height, depth] = size;
    let cells: Vec<Point> =
        (0..=width).flat_map(|x| (0..=height).flat_map(move |y| (0..=depth).map(move |z| [x, y, z]))).collect();
    let symmetries = symmetries(size);
    let n = cells.len();
    for a in 0..n {
        for b in a + 1..n {
            for c in b + 1..n {
                for d in c + 1..n {
                    for e in d + 1..n {
                        let points = [a, b, c, d, e].map(|k| cells[k]);
                        if fills(&points, size) && is_first_of_its_images(&points, size, &symmetries) {
                            sets.extend(FivePoints::of(points));
                        }
                    }
                }
            }
        }
    }
}

fn fills(points: &[Point; 5], size: Point) -> bool {
    (0..3).all(|k| points.iter().any(|p| p[k] == 0) && points.iter().any(|p| p[k] == size[k]))
}

/// The permutations of the axes that keep the size, each with the axes that are turned round.
fn symmetries(size: Point) -> Vec<([usize; 3], [bool; 3])> {
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let keeps = |order: &[usize; 3]| (0..3).all(|k| size[order[k]] == size[k]);
    let flips = |mask: usize| [mask & 1 != 0, mask & 2 != 0, mask & 4 != 0];
    orders.into_iter().filter(keeps).flat_map(|order| (0..8).map(move |mask| (order, flips(mask)))).collect()
}

fn is_first_of_its_images(points: &[Point; 5], size: Point, symmetries: &[([usize; 3], [bool; 3])]) -> bool {
    symmetries.iter().all(|(order, turned)| {
        let coordinate = |p: &Point, k: usize| if turned[k] { size[k] - p[order[k]] } else { p[order[k]] };
        let mut image = points.map(|p| std::array::from_fn(|k| coordinate(&p, k)));
        image.sort_unstable();
        *points <= image
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    const PIERCED: [Point; 5] = [[0, 0, 0], [2, 0, 0], [0, 2, 0], [1, 1, 1], [0, 0, -1]];

    #[test]
    fn volumes_of_both_triangulations_agree_and_the_dependency_is_one() {
        for set in world([2, 2, 1]) {
            let total = |t: &Tetrahedra| t.iter().map(|t| volume(&set.points, *t).abs()).sum::<i64>();
            assert_eq!(total(&set.two), total(&set.other));
            assert_eq!(set.w.iter().sum::<i64>(), 0);
            for axis in 0..3 {
                assert_eq!((0..5).map(|k| set.w[k] * set.points[k][axis]).sum::<i64>(), 0);
            }
            assert_eq!(set.two.len() + set.other.len(), if set.is_pyramid() { 4 } else { 5 });
        }
    }

    #[test]
    fn the_stiffness_of_a_corner_of_the_cube_is_that_of_hand_computation() {
        // The tetrahedron 0, e₁, e₂, e₃ of volume 1/6 has the gradients (−1, −1, −1), e₁, e₂, e₃.
        let set = FivePoints::of([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]).unwrap();
        let k = set.stiffness(&[[0, 1, 2, 3]]);
        let sixth = |n: i64| Rational::from(n) / Rational::from(6);
        assert_eq!([k.at(0, 0), k.at(0, 1), k.at(1, 1), k.at(1, 2)], [&sixth(3), &sixth(-1), &sixth(1), &sixth(0)]);
    }

    #[test]
    fn every_set_has_one_representative() {
        // Brute force over all sets in the cube of 2 × 1 × 1, by the orbits of their sorted images.
        let size = [2, 1, 1];
        let cells: Vec<Point> = (0..12).map(|k: i64| [k / 4, k / 2 % 2, k % 2]).collect();
        let mut orbits = BTreeSet::new();
        for mask in 0_u32..1 << 12 {
            if mask.count_ones() != 5 {
                continue;
            }
            let chosen: Vec<Point> = (0..12).filter(|k| mask >> k & 1 == 1).map(|k| cells[k]).collect();
            let points: [Point; 5] = chosen.try_into().unwrap();
            if fills(&points, size) && FivePoints::of(points).is_some() {
                let images = symmetries(size).into_iter().map(|(order, turned)| {
                    let mut image = points
                        .map(|p| std::array::from_fn(|k| if turned[k] { size[k] - p[order[k]] } else { p[order[k]] }));
                    image.sort_unstable();
                    image
                });
                orbits.insert(images.min().unwrap());
            }
        }
        let found: Vec<[Point; 5]> = world(size).into_iter().map(|s| s.points).filter(|p| fills(p, size)).collect();
        assert_eq!(found, orbits.into_iter().collect::<Vec<_>>());
    }

    #[test]
    fn the_sphere_decides_which_triangulation_is_delaunay() {
        // The sphere through 0, (2, 0, 0), (0, 2, 0), (1, 1, 1) has the centre (1, 1, −½); (0, 0, −1) lies on it.
        let on = FivePoints::of(PIERCED).unwrap();
        assert_eq!((on.in_sphere(), on.delaunay()), (Ordering::Equal, None));
        let place = |z: i64| FivePoints::of([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, 2], [1, 1, z]]).unwrap();
        // The circle around the base has its centre (2, 2) and the square of its radius is 8; with (1, 1, z), 2 from the
        // centre's square: flat pairs lie inside each other's spheres, high ones do not.
        assert_eq!(place(-1).delaunay().unwrap().0.len(), 3);
        assert_eq!(place(-9).delaunay().unwrap().0.len(), 2);
    }
}
