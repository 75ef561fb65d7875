//! The boundary is treated as it should not be.

use super::site::{Site, Triangle};
use super::{Blind, Class, Fault, Spoilt};

/// What sees the boundary.
const BOUNDARY: &[&str] = &["FLUX", "ENERGY"];

/// Where it does not.
const SLIVERS: &[Blind] = &[Blind::AnglesBelow(1.0)];

/// Assembles with the weights of boundary edges, or of the others, times a factor.
fn weights(site: &Site, on_boundary: bool, factor: f64) -> Spoilt {
    let (topology, triangles) = (site.surface()?.topology(), site.triangles()?);
    if !topology.boundary_vertices().contains(&true) {
        return Err("there is no boundary");
    }
    let lies = |[i, j]: [usize; 2]| topology.edge_between(i, j).is_some_and(|e| topology.is_boundary_edge(e));
    let scaled = |(ends, w)| (ends, if lies(ends) == on_boundary { factor * w } else { w });
    let weights: Vec<_> = triangles.iter().flat_map(Triangle::weights).map(scaled).collect();
    site.assembled(weights, &triangles)
}

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    Class::Boundary.fault(
        "boundary-weights-doubled",
        "the one cotangent of a boundary edge counted as if there were two",
        BOUNDARY,
        SLIVERS,
        |s, _| weights(s, true, 2.0),
    ),
    Class::Boundary.fault(
        "boundary-weights-halved",
        "the mean of one cotangent and none: ¼ cot on the boundary",
        BOUNDARY,
        SLIVERS,
        |s, _| weights(s, true, 0.5),
    ),
    Class::Boundary.fault(
        "boundary-weights-missing",
        "no weight on boundary edges, as of a loop over pairs of triangles",
        BOUNDARY,
        SLIVERS,
        |s, _| weights(s, true, 0.0),
    ),
    Class::Boundary.fault(
        "interior-weights-halved",
        "the factor ½ taken twice inside, and once on the boundary",
        &["ENERGY", "FLUX"],
        SLIVERS,
        |s, _| weights(s, false, 0.5),
    ),
    Class::Boundary.fault(
        "boundary-rows-zero",
        "the rows of boundary vertices never filled",
        &["SYM", "FLUX", "ENERGY"],
        SLIVERS,
        |s, _| {
            let on_boundary = s.surface()?.topology().boundary_vertices();
            s.mapped(|i, _, v| if on_boundary[i] { 0.0 } else { *v })
        },
    ),
    Class::Boundary.fault(
        "triangles-at-boundary-missed",
        "triangles with a boundary edge left out",
        &["ENERGY", "FLUX", "LIN"],
        SLIVERS,
        |s, _| {
            let (topology, triangles) = (s.surface()?.topology(), s.triangles()?);
            let lies = |[i, j]: [usize; 2]| topology.edge_between(i, j).is_some_and(|e| topology.is_boundary_edge(e));
            let inside: Vec<Triangle> =
                triangles.iter().filter(|t| (0..3).all(|c| !lies(t.side(c)))).copied().collect();
            s.assembled(inside.iter().flat_map(Triangle::weights), &triangles)
        },
    ),
];
