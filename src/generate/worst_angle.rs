//! Flips to a triangulation with a lexicographically bad angle vector: the opposite of Delaunay.
//!
//! # Definition
//! The angle vector of a triangulation lists its angles from the smallest up. An edge is flipped iff the flip is legal and
//! lowers the smallest of the six angles of its quadrilateral; then the angle vector decreases lexicographically, and no
//! triangulation comes twice, so that the flips end. In the plane this is the case exactly where the edge is strictly
//! Delaunay \[berg-et-al2008, lemma 9.4\], which is decided exactly: every flip makes an edge that violates the condition.
//! In space the angles are compared in floating point, as a function of the triangle alone, so that the argument still holds.
//!
//! The flip that makes the smallest new angle comes first. The end is a local minimum, not the worst triangulation there is.
//!
//! # Cost
//! O(log F) for each flip and O(F log F) for each pass; in the plane one pass suffices, with at most n(n−1)/2 flips, since each
//! raises the lift to the paraboloid.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::shape::input::{inherit, refused_flip, surface};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::Domain;
use crate::domain::flip::{Quad, Triangulation};
use crate::domain::geometry::{self, Vec3};
use crate::parameter::Settings;

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "worst-angle",
    name: "edge flips as long as they make the smallest angle smaller: far from Delaunay",
    guarantees: &[
        "the same vertices, number of edges and faces, boundary, genus; a planar mesh stays planar and keeps its area",
        "the angle vector has decreased lexicographically with each flip, and no legal flip decreases it further",
        "in the plane every interior edge with a strictly convex quadrilateral violates the Delaunay condition or is cocircular",
    ],
    sources: &["berg-et-al2008", "lawson1977"],
    parameters: &[],
    make: Make::Modifier(change),
};

fn change(domain: &Domain, _: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let surface = surface("worst-angle", domain)?;
    let refused = refused_flip("worst-angle");
    let mut mesh = Triangulation::of(surface).map_err(&refused)?;
    // In space a flip may take away the edge that made another flip, far off, illegal: a pass ends when its queue is empty,
    // and the last pass finds nothing.
    loop {
        let mut queue: BinaryHeap<Candidate> = (0..mesh.half_edges()).filter_map(|h| candidate(&mesh, h)).collect();
        if queue.is_empty() {
            break;
        }
        while let Some(best) = queue.pop() {
            // A candidate is stale once a neighbour was flipped; its successor is in the queue.
            if candidate(&mesh, best.half_edge).is_none_or(|now| now.quad != best.quad) {
                continue;
            }
            let faces = [best.half_edge / 3, mesh.twin(best.half_edge).unwrap_or(best.half_edge) / 3];
            mesh.flip(best.half_edge).map_err(&refused)?;
            let changed = faces.into_iter().flat_map(|f| [3 * f, 3 * f + 1, 3 * f + 2]);
            queue.extend(changed.filter_map(|h| candidate(&mesh, h)));
        }
    }
    inherit(surface, mesh.into_surface())
}

/// A flip that lowers the smallest angle; larger is worse, ties by half-edge.
struct Candidate {
    /// Cotangent of the smallest angle of the new triangles.
    cotangent: f64,
    half_edge: usize,
    quad: Quad,
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        self.cotangent.total_cmp(&other.cotangent).then(other.half_edge.cmp(&self.half_edge))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Candidate {}

fn candidate(mesh: &Triangulation, half_edge: usize) -> Option<Candidate> {
    let quad = mesh.quad(half_edge).filter(|_| mesh.is_legal(half_edge))?;
    let Quad { a, b, c, d } = quad;
    let smallest = |s, t| largest_cotangent(mesh, s).max(largest_cotangent(mesh, t));
    let cotangent = smallest([d, c, a], [c, d, b]);
    let lowers = match mesh.in_circle(half_edge) {
        Some(side) => side == Ordering::Less,
        None => cotangent > smallest([a, b, c], [b, a, d]),
    };
    lowers.then_some(Candidate { cotangent, half_edge, quad })
}

/// The cotangent of the smallest angle of a triangle, the corners taken in ascending order so that it does not depend on
/// where the face starts.
fn largest_cotangent(mesh: &Triangulation, mut triangle: [usize; 3]) -> f64 {
    triangle.sort_unstable();
    let [p, q, r] = mesh.corners(triangle).map(Vec3::from);
    geometry::cotangent(p, q, r).max(geometry::cotangent(q, r, p)).max(geometry::cotangent(r, p, q))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Surface;
    use crate::generate::testing::{change, disc, make, surface_facts};
    use crate::scalar::Rational;

    fn exact_cotangents(surface: &Surface, triangle: [usize; 3]) -> Vec<Rational> {
        let at = surface.planar_positions::<Rational>().unwrap();
        let [a, b, c] = triangle;
        [[a, b, c], [b, c, a], [c, a, b]]
            .iter()
            .map(|t| geometry::cotangent_in_plane(&at[t[0]], &at[t[1]], &at[t[2]]).unwrap())
            .collect()
    }

    #[test]
    fn in_the_plane_a_strictly_delaunay_edge_is_one_whose_flip_makes_the_smallest_angle_smaller() {
        let surface = make("random-delaunay", &[("n", "25")], 3);
        let surface = change(&surface, "flip", &[("count", "20")], 3);
        let surface = surface.as_surface().unwrap();
        let mesh = Triangulation::of(surface).unwrap();
        let (mut lowering, mut raising) = (0, 0);
        for h in (0..mesh.half_edges()).filter(|&h| mesh.is_legal(h)) {
            let Quad { a, b, c, d } = mesh.quad(h).unwrap();
            let smallest = |s, t| {
                let mut all = exact_cotangents(surface, s);
                all.extend(exact_cotangents(surface, t));
                all.into_iter().reduce(|x, y| if y > x { y } else { x }).unwrap()
            };
            let lowers = smallest([d, c, a], [c, d, b]) > smallest([a, b, c], [b, a, d]);
            assert_eq!(lowers, candidate(&mesh, h).is_some());
            if lowers { lowering += 1 } else { raising += 1 }
        }
        assert!(lowering > 10 && raising > 10);
    }

    #[test]
    fn no_flip_lowers_the_angle_vector_further_and_most_edges_are_not_delaunay() {
        for seed in 0..12 {
            let start = make("random-delaunay", &[("n", "80")], seed);
            let end = change(&start, "worst-angle", &[], seed);
            let (before, after) = (surface_facts(&start), disc(&end));
            assert_eq!(start.positions(), end.positions());
            assert!((before.area - after.area).abs() < 400.0 * f64::EPSILON);
            assert!(after.min_angle_deg < before.min_angle_deg);
            let mesh = Triangulation::of(end.as_surface().unwrap()).unwrap();
            assert!((0..mesh.half_edges()).all(|h| candidate(&mesh, h).is_none()));
            let convex = (0..mesh.half_edges()).filter(|&h| mesh.is_legal(h)).count() / 2;
            let violated = after.non_delaunay_edges.unwrap();
            assert!(violated >= convex && 4 * violated > end.edges().len(), "{violated} of {}", end.edges().len());
        }
    }

    #[test]
    fn surfaces_in_space_end_too_and_keep_their_genus() {
        let end = change(&make("torus", &[("levels", "1")], 0), "worst-angle", &[], 0);
        let facts = surface_facts(&end);
        assert_eq!((facts.genus, facts.closed, facts.manifold, facts.degenerate_faces), (Some(1), true, true, 0));
        let mesh = Triangulation::of(end.as_surface().unwrap()).unwrap();
        assert!((0..mesh.half_edges()).all(|h| candidate(&mesh, h).is_none()));
    }
}
