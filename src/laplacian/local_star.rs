//! The star of a point in a cloud that samples a surface or a curve: who is beside it, and its share of the area.
//!
//! # Definition
//! Neighbours of p are the nearest points. Their directions from p, each of length one, have a matrix of second moments; the tangent
//! plane is spanned by its two larger eigenvectors, the tangent line by the largest. Each direction counts once, however far away
//! its point is: a direction is off the tangent plane by half the curvature times the distance.
//!
//! On a surface the neighbours are projected to the plane and p is joined to those that a Delaunay triangulation of them joins it to.
//! Inversion `y ↦ y/|y|²` about p takes circles through p to lines: the star of p is the convex hull of the inverted points, a
//! triangle of the star an edge of the hull with p on its left. The corners keep their places in space, and the share is a third of
//! the areas of the triangles.
//!
//! Two triangles beside an edge make a quadrangle, and the stars of its four corners should agree on its diagonal: where each corner took
//! the one that ends in it, the shares would add up to 4/3 of it. Seen in a tangent plane what is far is foreshortened, and each corner
//! would indeed do that on a grid. So the angles in space decide, which are the same for all four: a diagonal will do if the angles
//! opposite it add up to at most π. In the plane that is Delaunay's rule, and both will do only on a circle; a quadrangle bent in space has
//! angles of less than 2π, and both may do. Where both will do, the share of p is the mean over the fans from each corner of the polygon,
//! which no numbering changes, and which like each of them integrates linear functions exactly.
//!
//! On a curve the star is the segment to the next point on either side, the share half of both lengths.
//!
//! # Decision
//! A star is *settled* when it goes all round p and no circle through its corners reaches beyond the neighbours that were looked at. Until it
//! is, twice as many are looked at, again and again up to a limit. At the rim of a cloud it never is: then the star is open, its triangles
//! those that are there.
//!
//! # Accuracy
//! Angles are compared up to what the rounding of the coordinates does to them. Everything is done in units of the distance of the
//! farthest neighbour.
//!
//! # References
//! \[belkin-sun-wang2009\] for projection, triangulation and lifting; circles by inversion is classical.

use super::BuildError;
use crate::domain::geometry::Vec3;
use crate::domain::nearest::{Found, Nearest};

/// Half the distance from 1 to the next number.
const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// How many neighbours are looked at first: twice as many as a point has on the average, on a curve and on a surface.
const NEIGHBOURS: [usize; 2] = [4, 12];

/// How many times as many at most: 64 on a curve, 48 on a surface. Of points drawn independently so many lie on one side of a point, which then
/// has an open star in the middle of the sample, with a probability of 2⁻⁶³ and 48 · 2⁻⁴⁷.
const MOST: [usize; 2] = [16, 4];

/// What may lie off the tangent space, as a share of the smallest second moment in it. Above 1 it is no tangent space.
const FLAT: f64 = 0.5;

/// A nearer neighbour than this share of the farthest: products of inverted coordinates might overflow.
const NEAREST: f64 = 1.0 / (1_u128 << 120) as f64;

/// The star of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Star {
    /// Its share of the area, or of the length of a curve.
    pub share: f64,
    /// Whether it goes all round the point.
    pub closed: bool,
    settled: bool,
}

/// Why there is no star.
enum Failure {
    /// The neighbours lie on a line.
    Collinear,
    /// They do not lie near a plane or, for a curve, a line.
    Crooked,
}

/// The star of a point of a cloud of dimension 1 or 2, in which no coordinate is larger than `largest`.
///
/// # Errors
/// Coincident points; neighbours that do not lie near a plane or line; neighbours on a surface that lie on a line.
pub fn star(
    laplacian: &'static str,
    cloud: &Nearest,
    point: usize,
    dimension: usize,
    largest: f64,
) -> Result<Star, BuildError> {
    let others = cloud.points().len().saturating_sub(1);
    let (mut found, mut failure, mut looked_at) = (None, None, 0);
    let mut count = NEIGHBOURS[dimension - 1];
    while count <= MOST[dimension - 1] * NEIGHBOURS[dimension - 1] && looked_at < others {
        let neighbours = with_ties(cloud, point, count.min(others), largest);
        looked_at = neighbours.len();
        let patch = Patch::of(laplacian, cloud, point, &neighbours, largest)?;
        let star = if dimension == 1 { patch.on_a_curve() } else { patch.on_a_surface() };
        match star {
            Ok(star) => {
                found = Some(star);
                if star.settled {
                    break;
                }
            }
            // A larger neighbourhood may leave a line, but it is not flatter.
            Err(Failure::Crooked) => {
                failure = failure.or(Some(Failure::Crooked));
                break;
            }
            Err(Failure::Collinear) => failure = Some(Failure::Collinear),
        }
        count *= 2;
    }
    let why = match failure {
        Some(Failure::Crooked) if dimension == 1 => "do not lie near a line",
        Some(Failure::Crooked) => "do not lie near a plane",
        _ => "lie on a line",
    };
    found.ok_or(BuildError::NoTangent { laplacian, vertex: point, neighbours: looked_at, why })
}

/// The nearest points and whoever is as far away as the last of them up to rounding, so that no numbering chooses between them. A
/// difference of coordinates is off by `2u` of the largest coordinate and `u` of itself; the square of the distance d by twice d times
/// that for each axis, and two squares are compared.
fn with_ties(cloud: &Nearest, point: usize, count: usize, largest: f64) -> Vec<Found> {
    let last = cloud.nearest_to(point, count).last().map_or(0.0, |f| f.squared);
    let leeway = 24.0 * UNIT_ROUNDOFF * (largest + last.sqrt()) * last.sqrt();
    cloud.within(point, last + leeway)
}

/// A point with its neighbours, relative to it, in units of the distance of the farthest.
struct Patch {
    at: Vec<Vec3>,
    /// The unit.
    radius: f64,
    /// The error of a coordinate.
    error: f64,
    /// The eigenvalues of the second moments of the directions, descending, with their vectors.
    axes: [(f64, Vec3); 3],
}

impl Patch {
    fn of(
        laplacian: &'static str,
        cloud: &Nearest,
        point: usize,
        neighbours: &[Found],
        largest: f64,
    ) -> Result<Self, BuildError> {
        let origin = Vec3::from(cloud.points()[point]);
        let radius = neighbours.iter().map(|f| f.squared).fold(0.0, f64::max).sqrt();
        let at: Vec<Vec3> =
            neighbours.iter().map(|f| (Vec3::from(cloud.points()[f.point]) - origin) / radius).collect();
        let too_near = |k: &usize| radius == 0.0 || at[*k].norm() < NEAREST;
        if let Some(k) = (0..at.len()).find(too_near) {
            let [a, b] = [point.min(neighbours[k].point), point.max(neighbours[k].point)];
            return Err(BuildError::Coincident { laplacian, a, b });
        }
        let mut moments = nalgebra::Matrix3::zeros();
        for direction in at.iter().map(|v| v.normalize()) {
            moments += direction * direction.transpose();
        }
        let eigen = moments.symmetric_eigen();
        let axis = |k: usize| (eigen.eigenvalues[k], Vec3::from(eigen.eigenvectors.column(k)));
        let mut axes = [axis(0), axis(1), axis(2)];
        axes.sort_by(|a, b| b.0.total_cmp(&a.0));
        // Coordinates are given with an error of u each, two of them make a difference; then a quotient and a sum of three products.
        let error = 2.0 * UNIT_ROUNDOFF * largest / radius + 8.0 * UNIT_ROUNDOFF;
        Ok(Patch { at, radius, error, axes })
    }

    fn on_a_curve(&self) -> Result<Star, Failure> {
        let [(along, axis), (across, _), _] = self.axes;
        let places: Vec<f64> = self.at.iter().map(|v| v.dot(&axis)).collect();
        let steep = self.at.iter().zip(&places).any(|(v, y)| 2.0 * y.abs() < v.norm());
        if across > FLAT * along || steep {
            return Err(Failure::Crooked);
        }
        let nearest = |side: f64| {
            let here = (0..places.len()).filter(|&k| side * places[k] > 0.0);
            here.min_by(|&a, &b| places[a].abs().total_cmp(&places[b].abs())).map(|k| self.at[k].norm())
        };
        let sides = [nearest(1.0), nearest(-1.0)];
        let closed = sides.iter().all(Option::is_some);
        let length: f64 = sides.iter().flatten().sum();
        Ok(Star { share: 0.5 * length * self.radius, closed, settled: closed })
    }

    fn on_a_surface(&self) -> Result<Star, Failure> {
        let [(_, first), (second, other), (off, _)] = self.axes;
        // A sum of as many dyads, each rounded, is off by no more.
        if second <= 4.0 * UNIT_ROUNDOFF * self.at.len() as f64 {
            return Err(Failure::Collinear);
        }
        let places: Vec<[f64; 2]> = self.at.iter().map(|v| [v.dot(&first), v.dot(&other)]).collect();
        let steep = self.at.iter().zip(&places).any(|(v, y)| 4.0 * square(*y) < v.norm_squared());
        if off > FLAT * second || steep {
            return Err(Failure::Crooked);
        }
        let plane = Plane { places, lifted: &self.at, error: self.error };
        let corners = plane.corners();
        let polygons: Vec<Vec<usize>> = plane.polygons(&corners);
        let shares = polygons.iter().map(|p| share(&p.iter().map(|&k| self.at[k]).collect::<Vec<_>>()));
        let share = shares.sum::<f64>() * self.radius * self.radius;
        if share == 0.0 {
            return Err(Failure::Collinear);
        }
        let closed = corners.len() > 2 && polygons.len() == corners.len();
        let settled = closed && polygons.iter().all(|p| plane.diameter(p[0], p[p.len() - 1]) <= 1.0);
        Ok(Star { share, closed, settled })
    }
}

/// Which diagonals of a quadrangle will do.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Diagonal {
    /// The one that ends in the origin.
    Own,
    /// The other.
    Other,
    /// Both.
    Either,
}

/// Neighbours in the tangent plane, the point itself at the origin.
struct Plane<'a> {
    places: Vec<[f64; 2]>,
    /// Where they are in space.
    lifted: &'a [Vec3],
    /// The error of a coordinate.
    error: f64,
}

impl Plane<'_> {
    fn inverted(&self, k: usize) -> [f64; 2] {
        let y = self.places[k];
        y.map(|x| x / square(y))
    }

    /// Whether the triangle of the origin and two places is counter-clockwise.
    fn turns_left(&self, a: usize, b: usize) -> bool {
        cross(self.places[a], self.places[b]) > 0.0
    }

    /// Whether the quadrangle of the origin and three places goes round counter-clockwise in this order.
    fn in_order(&self, a: usize, b: usize, c: usize) -> bool {
        self.turns_left(a, b) && self.turns_left(b, c) && self.turns_left(a, c)
    }

    /// Which diagonals of the quadrangle of the origin and three neighbours, in this order, will do. Coordinates that are off by e move a
    /// side of length ℓ or more by less than 3.5 e, an angle by 7 e/ℓ and the sum of two by 14 e/ℓ; e is at least eight units, so that this
    /// covers the rounding of the sine.
    fn diagonal(&self, a: usize, b: usize, c: usize) -> Diagonal {
        // A left turn at the origin, at a and at c is given. Without one at b the other diagonal runs outside.
        let [before, after] = [[a, b], [b, c]].map(|[k, l]| [0, 1].map(|x| self.places[l][x] - self.places[k][x]));
        if cross(before, after) <= 0.0 {
            return Diagonal::Own;
        }
        let [a, b, c] = [a, b, c].map(|k| self.lifted[k]);
        let origin = Vec3::zeros();
        let shortest = [a, b - a, c - b, c].map(|side| side.norm()).into_iter().fold(f64::INFINITY, f64::min);
        let leeway = 14.0 * self.error / shortest;
        let will_do = |ends: [Vec3; 2], apexes: [Vec3; 2]| {
            let [p, q] = apexes.map(|apex| (ends[0] - apex, ends[1] - apex));
            let cosine = |(u, v): (Vec3, Vec3)| u.dot(&v) / (u.norm() * v.norm());
            let sine = |(u, v): (Vec3, Vec3)| u.cross(&v).norm() / (u.norm() * v.norm());
            sine(p) * cosine(q) + cosine(p) * sine(q) >= -leeway
        };
        match (will_do([origin, b], [a, c]), will_do([a, c], [origin, b])) {
            (true, false) => Diagonal::Own,
            (false, true) => Diagonal::Other,
            _ => Diagonal::Either,
        }
    }

    /// The diameter of the circle through the origin and two places.
    fn diameter(&self, a: usize, b: usize) -> f64 {
        let [a, b] = [a, b].map(|k| self.inverted(k));
        square([b[0] - a[0], b[1] - a[1]]).sqrt() / cross(a, b)
    }

    /// The corners of the star, counter-clockwise: those of the convex hull of the inverted places, without those that share a polygon
    /// with their neighbours or that the angles in space leave out, and with those that they put in.
    fn corners(&self) -> Vec<usize> {
        let inverted: Vec<[f64; 2]> = (0..self.places.len()).map(|k| self.inverted(k)).collect();
        let mut order: Vec<usize> = (0..inverted.len()).collect();
        let key = |k: usize| inverted[k];
        order.sort_by(|&a, &b| key(a)[0].total_cmp(&key(b)[0]).then(key(a)[1].total_cmp(&key(b)[1])));
        let turn = |a: usize, b: usize, c: usize| {
            let [a, b, c] = [a, b, c].map(key);
            cross([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]])
        };
        let chain = |order: &mut dyn Iterator<Item = usize>| {
            let mut chain: Vec<usize> = Vec::new();
            for k in order {
                while chain.len() > 1 && turn(chain[chain.len() - 2], chain[chain.len() - 1], k) <= 0.0 {
                    chain.pop();
                }
                chain.push(k);
            }
            chain.pop();
            chain
        };
        let mut corners = chain(&mut order.iter().copied());
        corners.extend(chain(&mut order.iter().rev().copied()));
        let out = |corners: &[usize], k: usize| {
            let count = corners.len();
            let [a, b, c] = [corners[(k + count - 1) % count], corners[k], corners[(k + 1) % count]];
            count > 2 && self.in_order(a, b, c) && self.diagonal(a, b, c) != Diagonal::Own
        };
        while let Some(k) = (0..corners.len()).find(|&k| out(&corners, k)) {
            corners.remove(k);
        }
        let missing = |corners: &[usize], k: usize| {
            let [a, c] = [corners[k], corners[(k + 1) % corners.len()]];
            let own =
                |&b: &usize| !corners.contains(&b) && self.in_order(a, b, c) && self.diagonal(a, b, c) == Diagonal::Own;
            (0..self.places.len()).find(own)
        };
        while let Some((k, b)) = (0..corners.len()).find_map(|k| Some((k, missing(&corners, k)?))) {
            corners.insert(k + 1, b);
        }
        corners
    }

    /// The other corners of each polygon at the origin, counter-clockwise.
    fn polygons(&self, corners: &[usize]) -> Vec<Vec<usize>> {
        let edge = |k: usize| [corners[k], corners[(k + 1) % corners.len()]];
        let edges = (0..corners.len()).map(edge).filter(|&[a, b]| self.turns_left(a, b));
        let polygon = |[a, b]: [usize; 2]| {
            let inside = |&c: &usize| self.in_order(a, c, b) && self.diagonal(a, c, b) == Diagonal::Either;
            let mut between: Vec<usize> = (0..self.places.len()).filter(inside).collect();
            // The angle seen from the origin grows from a to b by less than π: so does the place along the inverted line.
            let (from, to) = (self.inverted(a), self.inverted(b));
            let along = |&c: &usize| {
                let w = self.inverted(c);
                (w[0] - from[0]) * (to[0] - from[0]) + (w[1] - from[1]) * (to[1] - from[1])
            };
            between.sort_by(|c, d| along(c).total_cmp(&along(d)));
            [&[a], &between[..], &[b]].concat()
        };
        edges.map(polygon).collect()
    }
}

/// The share of the origin in the polygon with these other corners in order: the mean over the fans from each corner of a third of the
/// areas of the triangles at the origin.
fn share(corners: &[Vec3]) -> f64 {
    let area = |a: usize, b: usize| 0.5 * corners[a].cross(&corners[b]).norm();
    let last = corners.len() - 1;
    let whole: f64 = (0..last).map(|k| area(k, k + 1)).sum();
    // The fan from an inner corner has two triangles at the origin, the fans from the first and the last have one.
    let inner: f64 = (1..last).map(|k| area(0, k) + area(k, last)).sum();
    (whole + inner + 2.0 * area(0, last)) / (3.0 * (corners.len() + 1) as f64)
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn square(a: [f64; 2]) -> f64 {
    a[0] * a[0] + a[1] * a[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use spade::{DelaunayTriangulation, Point2, Triangulation};
    use std::f64::consts::PI;

    fn numbers() -> impl FnMut() -> f64 {
        let mut state = 11_u64;
        move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    fn stars(points: &[[f64; 3]], dimension: usize) -> Vec<Star> {
        let cloud = Nearest::new(points);
        let largest = points.iter().flatten().fold(0.0, |a: f64, x| a.max(x.abs()));
        (0..points.len()).map(|i| star("x", &cloud, i, dimension, largest).unwrap()).collect()
    }

    /// A third of the triangles of one triangulation of all points, made by another program.
    fn thirds(points: &[[f64; 3]]) -> Vec<f64> {
        let flat = points.iter().map(|p| Point2::new(p[0], p[1])).collect();
        let all: DelaunayTriangulation<Point2<f64>> = DelaunayTriangulation::bulk_load_stable(flat).unwrap();
        assert_eq!(all.num_vertices(), points.len());
        let mut shares = vec![0.0; points.len()];
        for face in all.inner_faces() {
            let [a, b, c] = face.vertices().map(|v| v.position());
            let area = 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
            face.vertices().iter().for_each(|v| shares[v.fix().index()] += area / 3.0);
        }
        shares
    }

    #[test]
    fn closed_stars_in_the_plane_are_those_of_one_triangulation_of_all_points() {
        let mut next = numbers();
        // Evenly spread, and with clusters.
        let even: Vec<[f64; 3]> = (0..400).map(|_| [next(), next(), 0.0]).collect();
        let clustered: Vec<[f64; 3]> = (0..400).map(|_| [next().powi(2), next().powi(2), 0.0]).collect();
        for points in [even, clustered] {
            let expected = thirds(&points);
            let settled: Vec<(usize, Star)> =
                stars(&points, 2).into_iter().enumerate().filter(|(_, s)| s.settled).collect();
            assert!(settled.len() > 300, "{}", settled.len());
            for (i, star) in settled {
                assert!((star.share - expected[i]).abs() < 1e-9 * expected[i], "{i}: {star:?} {}", expected[i]);
            }
        }
    }

    #[test]
    fn on_grids_every_inner_point_has_a_cell_whatever_their_plane_and_scale() {
        let axes = [Vec3::new(2.0, -1.0, 2.0) / 3.0, Vec3::new(2.0, 2.0, -1.0) / 3.0];
        for scale in [1e-9, 1.0, 1e9] {
            for shear in [0.0, 0.5] {
                let at = |i: i32, j: i32| {
                    let place = axes[0] * (f64::from(i) + shear * f64::from(j)) + axes[1] * f64::from(j);
                    (place + Vec3::new(7.0, 0.3, -2.0)).scale(scale).into()
                };
                let points: Vec<[f64; 3]> = (0..7).flat_map(|i| (0..7).map(move |j| at(i, j))).collect();
                let stars = stars(&points, 2);
                for i in (2..5).flat_map(|i| (2..5).map(move |j| 7 * i + j)) {
                    assert!((stars[i].share / scale / scale - 1.0).abs() < 1e-12 && stars[i].closed, "{:?}", stars[i]);
                }
            }
        }
    }

    #[test]
    fn the_shares_of_a_polygon_add_up_to_it_and_have_its_centre() {
        let turns = [0.1, 0.9, 1.7, 3.0, 4.4, 5.1_f64];
        let corners: Vec<Vec3> = turns.iter().map(|a| Vec3::new(a.cos(), a.sin(), 0.0)).collect();
        for count in 3..=turns.len() {
            let shares: Vec<f64> = (0..count)
                .map(|k| share(&(1..count).map(|m| corners[(k + m) % count] - corners[k]).collect::<Vec<_>>()))
                .collect();
            let (mut area, mut moment) = (0.0, Vec3::zeros());
            for k in 1..count - 1 {
                let [a, b, c] = [corners[0], corners[k], corners[k + 1]];
                let part = 0.5 * (b - a).cross(&(c - a)).z;
                area += part;
                moment += (a + b + c) * (part / 3.0);
            }
            let found: Vec3 = shares.iter().zip(&corners).map(|(s, c)| c * *s).sum();
            assert!((shares.iter().sum::<f64>() - area).abs() < 1e-14 && (found - moment).norm() < 1e-14, "{count}");
        }
    }

    /// An inscribed triangle of side h is smaller than the surface over it by a share of the order h², and so is the sum of all.
    #[test]
    fn all_areas_add_up_to_those_of_sphere_torus_and_circle() {
        let mut next = numbers();
        let sphere: Vec<[f64; 3]> = (0..800)
            .map(|_| {
                let (z, (s, c)) = (2.0 * next() - 1.0, (2.0 * PI * next()).sin_cos());
                let r = (1.0 - z * z).sqrt();
                [r * c, r * s, z]
            })
            .collect();
        let torus = |u: f64, v: f64| {
            let r = 1.0 + 0.5 * v.cos();
            [r * u.cos(), r * u.sin(), 0.5 * v.sin()]
        };
        let turn = |k: usize, n: usize| 2.0 * PI * k as f64 / n as f64;
        let grid: Vec<[f64; 3]> = (0..40 * 20).map(|k| torus(turn(k % 40, 40), turn(k / 40, 20))).collect();
        let shaken: Vec<[f64; 3]> =
            (0..40 * 20).map(|k| torus(turn(k % 40, 40) + 0.1 * next(), turn(k / 40, 20) + 0.2 * next())).collect();
        let circle: Vec<[f64; 3]> =
            (0..80).map(|k| (turn(k, 80) + 0.06 * next()).sin_cos()).map(|(s, c)| [c, s, 0.0]).collect();
        let cases = [
            (sphere, 2, 4.0 * PI, 1.0),
            (grid, 2, 2.0 * PI * PI, 0.25),
            (shaken, 2, 2.0 * PI * PI, 0.25),
            (circle, 1, 2.0 * PI, 1.0),
        ];
        for (points, dimension, area, radius_squared) in cases {
            let stars = stars(&points, dimension);
            assert!(stars.iter().all(|s| s.closed));
            let total: f64 = stars.iter().map(|s| s.share).sum();
            let h_squared = (area / points.len() as f64).powf(2.0 / dimension as f64);
            let missing = 1.0 - total / area;
            assert!(missing > 0.0 && missing < h_squared / radius_squared, "{missing} {h_squared}");
        }
    }
}
