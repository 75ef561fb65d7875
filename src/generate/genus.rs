//! Closed surfaces of any genus: the boundary of a block of cubes with holes.
//!
//! # Definition
//! A block of (2g + 1) × 3 × 1 unit cubes without the g cubes (2k + 1, 1, 0) (for g = 0: three cubes in a row). Each square
//! of its boundary is cut into two triangles, these `levels` times into four; then every vertex moves half the way to the
//! average of its neighbours, `smoothing` times, which rounds the edges of the block.

use super::shape::input::{admit, impossible};
use super::shape::refine;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface, geometry};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "genus",
    name: "closed surface of genus g: the boundary of a block with g holes, smoothed on request",
    guarantees: &[
        "closed, manifold, connected, genus g, no degenerate face",
        "without smoothing: area 18g + 14, an interior volume of 5g + 3",
    ],
    sources: &[],
    parameters: &[
        Parameter { name: "genus", meaning: "number of holes", default: "2", range: Range::Whole(0, 50) },
        Parameter {
            name: "levels",
            meaning: "how often every triangle is cut into four",
            default: "1",
            range: Range::Whole(0, 5),
        },
        Parameter { name: "smoothing", meaning: "smoothing steps", default: "0", range: Range::Whole(0, 50) },
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let (genus, levels) = (settings.whole("genus"), settings.whole("levels"));
    let (mut positions, mut faces) = block(genus);
    admit("genus", "triangles", faces.len() << (2 * levels))?;
    for _ in 0..levels {
        faces = refine::midpoint(&mut positions, &faces);
    }
    let edges = Surface::triangles(positions.clone(), &faces)?.topology().edges().to_vec();
    for _ in 0..settings.whole("smoothing") {
        smooth(&mut positions, &edges);
    }
    if let Some([a, b, c]) =
        faces.iter().find(|f| geometry::collinear(positions[f[0]], positions[f[1]], positions[f[2]]))
    {
        return Err(impossible(
            "genus",
            format!("smoothing made triangle ({a}, {b}, {c}) degenerate; ask for fewer steps"),
        ));
    }
    Ok(Surface::triangles(positions, &faces)?.into())
}

/// The boundary of the block, vertices in lexicographic order of (z, y, x), faces counter-clockwise seen from outside.
fn block(genus: usize) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    let columns = 2 * genus + 1;
    // Cells are counted from 1, so that 0 is outside on every side.
    let solid = |[x, y, z]: [usize; 3]| {
        let hole = x % 2 == 0 && y == 2;
        (1..=columns).contains(&x) && (1..=3).contains(&y) && z == 1 && !hole
    };
    let mut squares: Vec<[[usize; 3]; 4]> = Vec::new();
    for cell in (0..3 * columns).map(|k| [1 + k % columns, 1 + k / columns, 1]).filter(|c| solid(*c)) {
        for axis in 0..3 {
            let step = |from: [usize; 3], axis: usize| std::array::from_fn(|k| from[k] + usize::from(k == axis));
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let square = |from: [usize; 3]| [from, step(from, u), step(step(from, u), v), step(from, v)];
            let mut below = cell;
            below[axis] -= 1;
            if !solid(step(cell, axis)) {
                squares.push(square(step(cell, axis)));
            }
            if !solid(below) {
                let [a, b, c, d] = square(cell);
                squares.push([a, d, c, b]);
            }
        }
    }
    let order = |p: &[usize; 3]| [p[2], p[1], p[0]];
    let mut corners: Vec<[usize; 3]> = squares.iter().flatten().copied().collect();
    corners.sort_unstable_by_key(order);
    corners.dedup();
    // Every corner of a square is in the list, so that the search always succeeds.
    let number = |p: [usize; 3]| corners.binary_search_by_key(&order(&p), order).unwrap_or_else(|at| at);
    let faces = squares.iter().flat_map(|s| {
        let [a, b, c, d] = s.map(number);
        [[a, b, c], [a, c, d]]
    });
    let faces = faces.collect();
    (corners.iter().map(|p| p.map(|x| x as f64 - 1.0)).collect(), faces)
}

/// Moves every vertex half the way to the average of its neighbours.
fn smooth(positions: &mut [[f64; 3]], edges: &[[usize; 2]]) {
    let mut sums = vec![([0.0; 3], 0.0); positions.len()];
    for &[a, b] in edges {
        for (v, w) in [(a, b), (b, a)] {
            sums[v].0 = std::array::from_fn(|k| sums[v].0[k] + positions[w][k]);
            sums[v].1 += 1.0;
        }
    }
    for (p, (sum, count)) in positions.iter_mut().zip(sums) {
        *p = std::array::from_fn(|k| 0.5 * (p[k] + sum[k] / count));
    }
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{make, outward_volume, surface_facts};

    #[test]
    fn the_computed_genus_is_the_one_asked_for_smoothed_or_not() {
        for genus in 0..=5 {
            for (levels, smoothing) in [("0", "0"), ("1", "0"), ("1", "5"), ("2", "20")] {
                let given = [("genus", &*genus.to_string().leak()), ("levels", levels), ("smoothing", smoothing)];
                let domain = make("genus", &given, 0);
                let facts = surface_facts(&domain);
                assert_eq!((facts.genus, facts.closed, facts.manifold), (Some(genus), true, true));
                assert_eq!((domain.facts().components, facts.degenerate_faces, facts.flipped_faces), (1, 0, 0));
                if smoothing == "0" {
                    let g = genus as f64;
                    assert_eq!((facts.area, outward_volume(&domain)), (18.0 * g + 14.0, 5.0 * g + 3.0));
                }
            }
        }
    }
}
