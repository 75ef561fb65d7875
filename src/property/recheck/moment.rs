//! First moments of a row: linear functions in the kernel inside, the flux through the boundary outside.

use std::cmp::Ordering;

use super::excerpt::Material;
use super::terms::Terms;
use super::{Answer, Rechecked, Refusal, witness};
use crate::domain::{Domain, Surface, geometry};

/// LIN, FLUX: `|Σ_j L_ij (x_j − x_i) − e| > threshold`.
pub(super) fn decide(
    m: &Material,
    i: usize,
    axis: usize,
    axes: [usize; 2],
    boundary: Option<[usize; 2]>,
    threshold: f64,
) -> Answer {
    if axis > 2 || axes[0] > 2 || axes[1] > 2 || axes[0] == axes[1] {
        return Err(Refusal::Malformed {
            what: "axis",
            index: axis,
            problem: "is none of two different axes in space",
        });
    }
    let centre = m.position(i)?;
    let mut sum = Terms::default();
    for &(j, v) in m.rows.row(i)? {
        if j != i && v != 0.0 {
            sum.add_differences(v, [m.position(j)?[axis], centre[axis]], [1.0, 0.0]);
        }
    }
    if let Some([p, q]) = boundary {
        sum.append(-1.0, flux(m.position(p)?, m.position(q)?, axis, axes)?);
    }
    witness::exceeds(&sum, threshold, || format!("|Σ_j L_{i},j (x_j − x_{i}) − e|, coordinate {axis},"))?;
    Ok(Rechecked::Exact)
}

/// The component `axis` of `½ J (x_q − x_p)`, `J(a, b) = (b, −a)` in the plane of `axes`.
fn flux(p: [f64; 3], q: [f64; 3], axis: usize, axes: [usize; 2]) -> Result<Terms, Refusal> {
    let (along, half) = match axis {
        a if a == axes[0] => (axes[1], 0.5),
        a if a == axes[1] => (axes[0], -0.5),
        _ => return Err(Refusal::Malformed { what: "axis", index: axis, problem: "is not in the plane of the mesh" }),
    };
    let mut flux = Terms::default();
    flux.add_differences(half, [q[along], p[along]], [1.0, 0.0]);
    Ok(flux)
}

/// The residual of LIN or FLUX at a vertex of a surface and `max_j |x_j − x_i|`, the length that rounding is relative to.
pub(super) fn residual(
    surface: &Surface,
    row: impl Iterator<Item = (usize, f64)>,
    i: usize,
    axis: usize,
    boundary: Option<([usize; 2], [usize; 2])>,
) -> Result<(Terms, f64), Refusal> {
    let at = |v: usize| surface.positions()[v];
    let (mut sum, mut reach) = (Terms::default(), 0.0_f64);
    for (j, v) in row.filter(|&(j, v)| j != i && v != 0.0) {
        sum.add_differences(v, [at(j)[axis], at(i)[axis]], [1.0, 0.0]);
        reach = (0..3).fold(reach, |r, k| r.max((at(j)[k] - at(i)[k]).abs()));
    }
    if let Some(([p, q], axes)) = boundary {
        sum.append(-1.0, flux(at(p), at(q), axis, axes)?);
    }
    Ok((sum, reach))
}

/// Refuses a witness of LIN where the star is not flat, or one of FLUX whose axes or boundary neighbours are wrong.
pub(super) fn check_place(
    domain: &Domain,
    i: usize,
    axes: [usize; 2],
    boundary: Option<[usize; 2]>,
) -> Result<(), Refusal> {
    let surface = match (domain, boundary) {
        (Domain::Surface(surface), _) => surface,
        // Space is flat: an interior vertex is enough.
        (Domain::Volume(_), None) => return Ok(()),
        _ => return Err(Refusal::untrue("the domain has flat stars", domain.kind().to_string())),
    };
    let Some([p, q]) = boundary else {
        if surface.plane().is_some() || is_flat_star(surface, i) {
            return Ok(());
        }
        return Err(Refusal::untrue(format!("the star of {i} is flat"), "it is not"));
    };
    if oriented_axes(surface) != Some(axes) {
        return Err(Refusal::untrue(
            format!("the faces are positively oriented in the plane of axes {axes:?}"),
            "they are not",
        ));
    }
    if boundary_neighbours(surface, i) != Some([p, q]) {
        return Err(Refusal::untrue(
            format!("the boundary runs {p} → {i} → {q}"),
            format!("{:?}", boundary_neighbours(surface, i)),
        ));
    }
    Ok(())
}

/// The axes of a planar mesh, in the order in which its faces turn counter-clockwise.
pub(super) fn oriented_axes(surface: &Surface) -> Option<[usize; 2]> {
    let [a, b] = surface.plane()?;
    let at = |v: usize| [surface.positions()[v][a], surface.positions()[v][b]];
    let corners = surface.faces().iter().flat_map(|f| f[1..].windows(2).map(move |w| [f[0], w[0], w[1]]));
    let mut turns = corners.map(|[x, y, z]| geometry::orient2d(at(x), at(y), at(z)));
    match turns.find(|t| *t != Ordering::Equal)? {
        Ordering::Greater => Some([a, b]),
        _ => Some([b, a]),
    }
}

/// The previous and the next vertex along the boundary with the surface to the left; `None` unless there is one of each.
pub(super) fn boundary_neighbours(surface: &Surface, i: usize) -> Option<[usize; 2]> {
    let (mut previous, mut next) = (Vec::new(), Vec::new());
    for at in surface.topology().star(i) {
        let (f, corner) = (&surface.faces()[at.face()], at.corner());
        let (before, after) = (f[(corner + f.len() - 1) % f.len()], f[(corner + 1) % f.len()]);
        let on_boundary =
            |v| surface.topology().edge_between(i, v).is_some_and(|e| surface.topology().is_boundary_edge(e));
        previous.extend(on_boundary(before).then_some(before));
        next.extend(on_boundary(after).then_some(after));
    }
    match (previous.as_slice(), next.as_slice()) {
        (&[p], &[q]) => Some([p, q]),
        _ => None,
    }
}

/// Whether the faces around a vertex are as on a manifold, none degenerate: `ends` edges at it have one face, all others two.
pub(super) fn is_proper_star(surface: &Surface, i: usize, ends: usize) -> bool {
    let (topology, at) = (surface.topology(), |v: usize| surface.positions()[v]);
    let mut edges = Vec::new();
    for c in topology.star(i) {
        let (f, corner) = (&surface.faces()[c.face()], c.corner());
        if f[1..].windows(2).all(|w| geometry::collinear(at(f[0]), at(w[0]), at(w[1]))) {
            return false;
        }
        let neighbours = [f[(corner + 1) % f.len()], f[(corner + f.len() - 1) % f.len()]];
        edges.extend(neighbours.into_iter().filter_map(|v| topology.edge_between(i, v)));
    }
    edges.sort_unstable();
    edges.dedup();
    let with = |faces: usize| edges.iter().filter(|&&e| topology.sides(e).len() == faces).count();
    !edges.is_empty() && with(1) == ends && with(1) + with(2) == edges.len()
}

/// Whether the faces around a vertex lie in one plane, unfolded. Exact.
pub(super) fn is_flat_star(surface: &Surface, i: usize) -> bool {
    let at = |v: usize| surface.positions()[v];
    let star = surface.topology().star(i);
    let faces = || star.iter().map(|c| &surface.faces()[c.face()]);
    let triangles = || faces().flat_map(|f| f[1..].windows(2).map(move |w| [f[0], w[0], w[1]]));
    let Some([a, b, c]) = triangles().find(|t| !geometry::collinear(at(t[0]), at(t[1]), at(t[2]))) else {
        return false;
    };
    let coplanar = |v: usize| geometry::orient3d(at(a), at(b), at(c), at(v)) == Ordering::Equal;
    if !faces().flatten().all(|&v| coplanar(v)) {
        return false;
    }
    // In a plane, a projection that keeps one proper triangle proper keeps the orientation of all or turns all.
    let turn = |[x, y, z]: [usize; 3], axis: usize| {
        let flat = |v: usize| [at(v)[(axis + 1) % 3], at(v)[(axis + 2) % 3]];
        geometry::orient2d(flat(x), flat(y), flat(z))
    };
    let Some(axis) = (0..3).find(|&axis| turn([a, b, c], axis) != Ordering::Equal) else { return false };
    let turns: Vec<_> = triangles().map(|t| turn(t, axis)).collect();
    !(turns.contains(&Ordering::Less) && turns.contains(&Ordering::Greater))
}
