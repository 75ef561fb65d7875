//! Straight chains of interior edges across a planar mesh: lines about which it can be folded.

use std::collections::BTreeMap;

use crate::domain::Surface;
use crate::domain::geometry::orient2d;

/// A straight chain of edges from boundary to boundary, and the vertices on one side of it.
pub(crate) struct Crease {
    /// Its vertices in order.
    pub chain: Vec<usize>,
    /// For each vertex whether it belongs to the part that is folded; false on the chain.
    pub folded: Vec<bool>,
}

/// The longest straight chain of interior edges that runs from boundary to boundary and divides the mesh into two parts which meet in
/// the chain only; `None` if there is none. Collinearity is decided exactly.
pub(crate) fn longest(surface: &Surface, axes: [usize; 2]) -> Option<Crease> {
    let n = surface.positions().len();
    let topology = surface.topology();
    let mut neighbours = vec![Vec::new(); n];
    for (e, &[a, b]) in topology.edges().iter().enumerate() {
        if topology.sides(e).len() == 2 {
            neighbours[a].push(b);
            neighbours[b].push(a);
        }
    }
    let mut chains: Vec<Vec<usize>> = Vec::new();
    for start in (0..n).filter(|&v| topology.boundary_vertices()[v]) {
        for &second in &neighbours[start] {
            if let Some(chain) = walk(surface, axes, &neighbours, start, second)
                && chain.first() < chain.last()
            {
                chains.push(chain);
            }
        }
    }
    chains.sort_by_key(|c| std::cmp::Reverse(c.len()));
    chains.into_iter().find_map(|chain| divide(surface, chain))
}

/// Follows the edges straight on from a boundary vertex until the boundary is met again.
fn walk(
    surface: &Surface,
    axes: [usize; 2],
    neighbours: &[Vec<usize>],
    start: usize,
    second: usize,
) -> Option<Vec<usize>> {
    let at = |v: usize| axes.map(|k| surface.positions()[v][k]);
    let mut chain = vec![start, second];
    while !surface.topology().boundary_vertices()[chain[chain.len() - 1]] {
        let (a, b) = (at(chain[chain.len() - 2]), at(chain[chain.len() - 1]));
        // Straight on: collinear, and not back. Exact differences decide which way a collinear point lies.
        let ahead = |p: [f64; 2]| (0..2).all(|k| (p[k] - b[k]) * (b[k] - a[k]) >= 0.0);
        let next = neighbours[chain[chain.len() - 1]]
            .iter()
            .copied()
            .find(|&w| orient2d(a, b, at(w)).is_eq() && ahead(at(w)) && !chain.contains(&w))?;
        // Also straight from the start: a chain of exactly collinear triples is collinear, so this only guards the data.
        if !orient2d(at(start), b, at(next)).is_eq() {
            return None;
        }
        chain.push(next);
    }
    Some(chain)
}

/// Cuts the mesh along a chain.
fn divide(surface: &Surface, chain: Vec<usize>) -> Option<Crease> {
    let cut: Vec<usize> = chain.windows(2).filter_map(|w| surface.topology().edge_between(w[0], w[1])).collect();
    let mut joined = Vec::new();
    for e in (0..surface.topology().edges().len()).filter(|e| !cut.contains(e)) {
        let sides = surface.topology().sides(e);
        joined.extend(sides.windows(2).map(|w| [w[0].face(), w[1].face()]));
    }
    let part = crate::domain::topology::components(surface.faces().len(), &joined);
    let beside = surface.topology().sides(*cut.first()?);
    let [one, other] = beside else { return None };
    let (one, other) = (part[one.face()], part[other.face()]);
    // The part that is folded: the smaller one beside the chain.
    let size = |p: usize| part.iter().filter(|&&q| q == p).count();
    let turned = if size(one) <= size(other) { one } else { other };
    if one == other {
        return None;
    }
    let mut sides: BTreeMap<usize, (bool, bool)> = BTreeMap::new();
    for (face, corners) in surface.faces().iter().enumerate() {
        for &v in corners {
            let entry = sides.entry(v).or_default();
            if part[face] == turned { entry.0 = true } else { entry.1 = true }
        }
    }
    let mut folded = vec![false; surface.positions().len()];
    for (&v, &(inside, outside)) in &sides {
        if inside && outside && !chain.contains(&v) {
            return None;
        }
        folded[v] = inside && !outside;
    }
    Some(Crease { chain, folded })
}
