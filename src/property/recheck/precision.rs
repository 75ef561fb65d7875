//! Scans of what an operator does to coordinates: LIN, FLUX, ENERGY.

use super::scan::{Scan, Seen, check_sum};
use super::terms::{Terms, U};
use super::{Refusal, energy, moment};
use crate::domain::Surface;

fn surface<'a>(scan: &Scan<'a>) -> Result<&'a Surface, Refusal> {
    scan.domain.as_surface().ok_or_else(|| Refusal::untrue("the domain is a surface", scan.domain.kind().to_string()))
}

/// LIN: at interior vertices of a planar mesh, of a mesh in space where the star is flat and the row does not leave it; always
/// without a degenerate face or a non-manifold edge at the vertex.
pub(super) fn linear(scan: &Scan) -> Result<Seen, Refusal> {
    let (surface, l) = (surface(scan)?, scan.operator.stiffness());
    let plane = surface.plane();
    let stays = |i: usize| {
        let beyond = |j: usize| !surface.topology().star(i).iter().any(|c| surface.faces()[c.face()].contains(&j));
        !l.row(i).any(|(j, v)| j != i && *v != 0.0 && beyond(j))
    };
    let mut places = 0;
    for i in scan.domain.interior().into_iter().filter(|&i| moment::is_proper_star(surface, i, 0)) {
        if plane.is_some() || (stays(i) && moment::is_flat_star(surface, i)) {
            places += 1;
            check_moments(scan, surface, i, &[0, 1, 2], None)?;
        }
    }
    Ok(Seen { exact: false, places })
}

/// FLUX: at boundary vertices with two boundary edges.
pub(super) fn flux(scan: &Scan) -> Result<Seen, Refusal> {
    let surface = surface(scan)?;
    let Some(axes) = moment::oriented_axes(surface) else {
        return Err(Refusal::untrue("the mesh lies unfolded in a plane", "it does not"));
    };
    let mut places = 0;
    for i in (0..scan.leeway.rows.len()).filter(|&i| moment::is_proper_star(surface, i, 2)) {
        if let Some(neighbours) = moment::boundary_neighbours(surface, i) {
            places += 1;
            check_moments(scan, surface, i, &axes, Some((neighbours, axes)))?;
        }
    }
    Ok(Seen { exact: false, places })
}

fn check_moments(
    scan: &Scan,
    surface: &Surface,
    i: usize,
    coordinates: &[usize],
    boundary: Option<([usize; 2], [usize; 2])>,
) -> Result<(), Refusal> {
    for &axis in coordinates {
        let row = scan.operator.stiffness().row(i).map(|(j, v)| (j, *v));
        let (sum, reach) = moment::residual(surface, row, i, axis, boundary)?;
        // The flux has a length of its own, which a row of zeros does not know.
        let allowed = scan.leeway.rows[i] * reach + 4.0 * U * sum.scale();
        check_sum(&sum, allowed, || {
            format!("the first moment of row {i} in coordinate {axis} is that of a linear function")
        })?;
    }
    Ok(())
}

/// ENERGY, as a sum over edges.
pub(super) fn energy(scan: &Scan) -> Result<Seen, Refusal> {
    let (surface, l) = (surface(scan)?, scan.operator.stiffness());
    let area = energy::area(surface.faces().iter(), |v| Ok(surface.positions()[v]))?;
    let (size, error) = area.approximate();
    let entries = match surface.plane() {
        Some([a, b]) => vec![(vec![[a, a]], 1.0), (vec![[b, b]], 1.0), (vec![[a, b]], 0.0), (vec![[b, a]], 0.0)],
        None => vec![(vec![[0, 0], [1, 1], [2, 2]], 2.0)],
    };
    for (pairs, factor) in &entries {
        let (mut sum, mut allowed) = (Terms::default(), factor * error);
        for i in 0..l.rows() {
            let p = surface.positions()[i];
            let mut farthest = 0.0_f64;
            for (j, v) in l.row(i).filter(|&(j, v)| j != i && *v != 0.0) {
                let q = surface.positions()[j];
                pairs.iter().for_each(|&[a, b]| sum.add_differences(-0.5 * v, [p[a], q[a]], [p[b], q[b]]));
                farthest = (0..3).fold(farthest, |far, k| far.max((p[k] - q[k]).abs()));
            }
            allowed += pairs.len() as f64 * scan.leeway.rows[i] * farthest * farthest;
        }
        sum.add(-factor * size);
        check_sum(&sum, allowed, || format!("the energy of the coordinates is the area at {pairs:?}"))?;
    }
    Ok(Seen { exact: false, places: 1 })
}
