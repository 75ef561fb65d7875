//! Whether a triangulation has a convex lift at all, decided by the exact simplex method: locally, across every interior
//! edge, or globally, which makes it the weighted Delaunay triangulation of its vertices.

use crate::domain::{Surface, geometry};
use crate::linalg::simplex::{Farkas, gordan};
use crate::property::evidence::Fraction;
use crate::property::{Evidence, Statement};
use crate::scalar::Rational;

use super::certified::whole;

/// Which conditions a lift has to meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lifting {
    /// Across an edge the opposite vertex of each of its triangles is above the plane of the other.
    Local,
    /// Every vertex is above the plane of every triangle of which it is no corner.
    Global,
}

/// Heights that meet the conditions, or the evidence that there are none. `None` unless the surface is a planar triangulation.
pub fn lifting(surface: &Surface, which: Lifting) -> Option<Result<Vec<Rational>, Evidence>> {
    let at = surface.planar_positions::<Rational>()?;
    let faces: Vec<[usize; 3]> = (0..surface.faces().len()).map(|f| surface.triangle(f)).collect::<Option<_>>()?;
    let pairs: Vec<(usize, usize)> = match which {
        Lifting::Local => interior_pairs(surface),
        Lifting::Global => {
            let pairs = (0..faces.len()).flat_map(|f| (0..at.len()).map(move |v| (f, v)));
            pairs.filter(|(f, v)| !faces[*f].contains(v)).collect()
        }
    };
    let area = |t: [usize; 3]| geometry::doubled_area(&at[t[0]], &at[t[1]], &at[t[2]]);
    let turned = area(*faces.first()?) < Rational::ZERO;
    let condition = |&(f, v): &(usize, usize)| {
        let [a, b, c] = faces[f];
        let mut row = vec![Rational::ZERO; at.len()];
        row[v] = area([a, b, c]);
        row[a] = -area([v, b, c]);
        row[b] = -area([a, v, c]);
        row[c] = -area([a, b, v]);
        if turned { row.into_iter().map(|x| -x).collect() } else { row }
    };
    let rows: Vec<Vec<Rational>> = pairs.iter().map(condition).collect();
    if rows.is_empty() {
        return Some(Ok(vec![Rational::ZERO; at.len()]));
    }
    Some(match gordan(&rows) {
        Farkas::Solution(heights) => Ok(heights),
        Farkas::Refutation(multipliers) => {
            let used = pairs.iter().zip(&multipliers).filter(|(_, m)| **m != Rational::ZERO);
            let multipliers = used.map(|(&(f, v), m)| (f, v, Fraction::from(m))).collect();
            let statement = Statement::NoLift { beside: which == Lifting::Local, multipliers };
            Err(Evidence::new(statement, whole(surface)))
        }
    })
}

/// For each interior edge one of its triangles and the vertex opposite in the other.
fn interior_pairs(surface: &Surface) -> Vec<(usize, usize)> {
    let opposite = |e: usize| surface.opposite(e);
    let edges = 0..surface.topology().edges().len();
    edges.map(opposite).filter(|o| o.len() == 2).map(|o| (o[0].0, o[1].1)).collect()
}
