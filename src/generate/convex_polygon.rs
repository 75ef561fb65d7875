//! A random convex polygon, triangulated as the star of an interior vertex.
//!
//! # Definition
//! Valtr's polygon \[valtr1995\]: n vectors whose x and y components are the gaps of two random chains that go to and fro
//! between the extremes, paired at random and laid end to end in the order of their directions. The interior vertex is a
//! convex combination of the corners with random positive weights.

use std::cmp::Ordering;

use super::shape::input::impossible;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface, geometry};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "convex-polygon",
    name: "random convex polygon as the star of one interior vertex",
    guarantees: &[
        "vertex 0 is the interior one, vertices 1 to n the corners counter-clockwise; n triangles",
        "strictly convex at every corner, vertex 0 strictly inside (both exact)",
        "planar, manifold, connected, genus 0, one boundary loop, no degenerate face",
    ],
    sources: &["valtr1995"],
    parameters: &[Parameter { name: "n", meaning: "number of corners", default: "7", range: Range::Whole(3, 300) }],
    make: Make::Source(make),
};

/// A draw fails where rounding makes an angle straight: for few corners hardly ever.
const TRIES: usize = 100;

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let n = settings.whole("n");
    for _ in 0..TRIES {
        let corners = corners(n, stream);
        let mut points = vec![combination(&corners, stream)];
        points.extend(&corners);
        let faces: Vec<[usize; 3]> = (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % n]).collect();
        let angles = (0..n).map(|k| [1 + k, 1 + (k + 1) % n, 1 + (k + 2) % n]);
        let left_turn = |[a, b, c]: [usize; 3]| geometry::orient2d(points[a], points[b], points[c]).is_gt();
        if angles.chain(faces.iter().copied()).all(left_turn) {
            return Ok(Surface::planar(&points, &faces)?.into());
        }
    }
    Err(impossible(
        "convex-polygon",
        format!("{TRIES} polygons had a straight angle after rounding; ask for fewer corners"),
    ))
}

fn corners(n: usize, stream: &mut Stream) -> Vec<[f64; 2]> {
    let x = gaps(n, stream);
    let mut y = gaps(n, stream);
    stream.shuffle(&mut y);
    let mut vectors: Vec<[f64; 2]> = x.into_iter().zip(y).map(|(x, y)| [x, y]).collect();
    vectors.sort_by(by_direction);
    let mut at = [0.0, 0.0];
    vectors
        .iter()
        .map(|v| {
            at = [at[0] + v[0], at[1] + v[1]];
            at
        })
        .collect()
}

/// The signed gaps of two chains from the smallest to the largest of n random numbers, one there and one back; sum zero.
fn gaps(n: usize, stream: &mut Stream) -> Vec<f64> {
    let mut numbers: Vec<f64> = (0..n).map(|_| stream.unit()).collect();
    numbers.sort_by(f64::total_cmp);
    let (first, last) = (numbers[0], numbers[n - 1]);
    let mut ends = [first, first];
    let mut gaps = Vec::with_capacity(n);
    for &x in &numbers[1..n - 1] {
        let back = stream.below(2);
        gaps.push(if back == 1 { ends[1] - x } else { x - ends[0] });
        ends[back] = x;
    }
    gaps.extend([last - ends[0], ends[1] - last]);
    gaps
}

/// By angle from the positive x-axis, counter-clockwise. Exact.
fn by_direction(a: &[f64; 2], b: &[f64; 2]) -> Ordering {
    let lower = |v: &[f64; 2]| v[1] < 0.0 || (v[1] == 0.0 && v[0] < 0.0);
    lower(a).cmp(&lower(b)).then_with(|| geometry::orient2d([0.0, 0.0], *a, *b).reverse())
}

fn combination(corners: &[[f64; 2]], stream: &mut Stream) -> [f64; 2] {
    // Weights bounded away from zero keep the point off the boundary.
    let weights: Vec<f64> = corners.iter().map(|_| stream.between(0.1, 1.0)).collect();
    let total: f64 = weights.iter().sum();
    std::array::from_fn(|k| corners.iter().zip(&weights).map(|(p, w)| w * p[k]).sum::<f64>() / total)
}

#[cfg(test)]
mod tests {
    use crate::domain::geometry::orient2d;
    use crate::generate::testing::{disc, make};

    #[test]
    fn every_corner_sees_all_others_on_the_left_of_its_side() {
        for seed in 0..60 {
            let n = 3 + seed as usize % 20;
            let domain = make("convex-polygon", &[("n", &n.to_string())], seed);
            let facts = disc(&domain);
            assert_eq!((domain.vertex_count(), domain.facts().faces, facts.boundary_edges), (n + 1, n, n));
            assert_eq!(domain.interior(), [0]);
            let at = |v: usize| [domain.positions().unwrap()[v][0], domain.positions().unwrap()[v][1]];
            for k in 0..n {
                let (a, b) = (1 + k, 1 + (k + 1) % n);
                assert!((0..=n).all(|v| v == a || v == b || orient2d(at(a), at(b), at(v)).is_gt()));
            }
        }
    }

    #[test]
    fn polygons_with_many_corners_succeed() {
        disc(&make("convex-polygon", &[("n", "300")], 1));
    }
}
