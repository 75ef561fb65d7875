//! Strips of ever thinner triangles: needles or caps.
//!
//! # Definition
//! Row `k` of the mesh, counted from the thickest, has the height `aspect^(−k/(rows−1))`: from 1 down to 1/aspect.
//! * `needle`: rectangles of width 1 cut by a diagonal: right triangles with legs 1 and h, one angle near 0, none near 180°.
//! * `cap`: every other line of vertices is shifted by half a cell: isosceles triangles over a base of 1 with height h,
//!   whose apex angle comes near 180°. The shape names are those of \[botsch-kobbelt2001\].
//!
//! The thinnest row is at y = 0 and the rows grow upwards, so that the small heights are not lost by rounding.

use super::shape::input::admit;
use super::shape::sheet::Sheet;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "slivers",
    name: "slivers of graded aspect ratio: a sheet whose row heights fall geometrically from 1 to 1/aspect",
    guarantees: &[
        "planar, manifold, connected, genus 0, one boundary loop, interior vertices, no degenerate face",
        "needle: smallest angle atan(1/aspect), largest 90°; Delaunay, with cocircular diagonals",
        "cap, aspect above 4: largest angle 180° − 2 atan(2/aspect), and not Delaunay",
    ],
    sources: &["botsch-kobbelt2001"],
    parameters: &[
        Parameter {
            name: "shape",
            meaning: "needle or cap",
            default: "needle",
            range: Range::Choice(&["needle", "cap"]),
        },
        Parameter {
            name: "aspect",
            meaning: "cell width over the smallest row height",
            default: "1e8",
            range: Range::Number(1.0, 1e8),
        },
        Parameter { name: "columns", meaning: "cells across", default: "6", range: Range::Whole(2, 100_000) },
        Parameter { name: "rows", meaning: "rows of cells", default: "9", range: Range::Whole(2, 1_000) },
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let sheet = Sheet::open(settings.whole("columns"), settings.whole("rows"));
    admit("slivers", "vertices", (sheet.columns + 1) * (sheet.rows + 1))?;
    let lines = lines(settings.number("aspect"), sheet.rows);
    let cap = settings.get("shape") == "cap";
    let shift = |row: usize| if cap && row % 2 == 1 { 0.5 } else { 0.0 };
    let points: Vec<[f64; 2]> = sheet.vertices().map(|[i, j]| [i as f64 + shift(j), lines[j]]).collect();
    // Seen from a row that is shifted to the right, the nearer upper vertex is the left one, and the other way round.
    let faces = sheet.triangles(|_, j| cap && j % 2 == 1);
    Ok(Surface::planar(&points, &faces)?.into())
}

/// The heights of the lines of vertices: sums of the row heights from the thinnest up.
fn lines(aspect: f64, rows: usize) -> Vec<f64> {
    let ratio = root(aspect, rows - 1);
    let (mut height, mut y, mut lines) = (1.0 / aspect, 0.0, vec![0.0]);
    for _ in 0..rows {
        y += height;
        height *= ratio;
        lines.push(y);
    }
    lines
}

/// The `n`-th root of `x ≥ 1` by bisection: products only, the same bits on every platform.
fn root(x: f64, n: usize) -> f64 {
    let (mut low, mut high) = (1.0, x);
    // 80 halvings of an interval below 2²⁷ leave nothing between neighbouring numbers.
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if (0..n).fold(1.0, |power, _| power * middle) > x { high = middle } else { low = middle }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::testing::{disc, make};

    #[test]
    fn angles_are_those_of_the_definition_for_every_aspect() {
        for exponent in 1..=8 {
            let aspect = 10_f64.powi(exponent);
            let given = |shape| [("shape", shape), ("aspect", &*aspect.to_string().leak()), ("rows", "5")];
            let needle = disc(&make("slivers", &given("needle"), 0));
            assert!((needle.min_angle_deg - (1.0 / aspect).atan().to_degrees()).abs() < 1e-9 * needle.min_angle_deg);
            assert!((needle.max_angle_deg - 90.0).abs() < 1e-9);
            assert_eq!((needle.delaunay, needle.cocircular_edges), (Some(true), Some(30)));
            let cap = disc(&make("slivers", &given("cap"), 0));
            let expected = 180.0 - 2.0 * (2.0 / aspect).atan().to_degrees();
            assert!((cap.max_angle_deg - expected).abs() < 1e-7);
            assert_eq!(cap.delaunay, Some(false));
        }
    }

    #[test]
    fn row_heights_fall_from_one_to_one_over_the_aspect() {
        let lines = lines(1e8, 9);
        let heights: Vec<f64> = lines.windows(2).map(|w| w[1] - w[0]).collect();
        assert_eq!(heights[0], 1e-8);
        assert!((heights[8] - 1.0).abs() < 1e-12);
        assert!(heights.windows(2).all(|w| (w[1] / w[0] - 10.0).abs() < 1e-8));
    }

    #[test]
    fn there_are_interior_vertices() {
        assert_eq!(make("slivers", &[], 0).interior().len(), 5 * 8);
    }
}
