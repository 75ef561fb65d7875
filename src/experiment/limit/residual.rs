//! Consistency: how nearly the values of a smooth function at the vertices satisfy the discrete equation.
//!
//! # Definition
//! For u at the vertices and f = −Δu there:
//! * pointwise, `max_i |(M⁻¹Lu)_i − f_i| / max |f|` over the interior vertices, M lumped;
//! * weak, `max_v (Lu − Mf)·v / |v|_E` over v that vanish on the boundary, `|v|²_E = vᵀKv` with K the stiffness of linear elements: the norm
//!   of the residual r in the dual of the energy, `√(rᵀK⁻¹r)`, relative to `|u|_E`.
//!
//! For K = L the second is the distance in energy of the discrete solution from u at the vertices, so that a solution
//! converges exactly if it tends to zero; the first bounds it, and not the other way.

use super::mesh::Mesh;
use super::place::Smooth;
use crate::linalg::Csr;
use crate::linalg::factor::{FactorError, Ldlt};
use crate::operator::Operator;

/// The two residuals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// The largest one at a vertex.
    pub pointwise: f64,
    /// The one in the dual of the energy.
    pub weak: f64,
}

/// The residuals of a smooth function on a mesh, at the interior vertices, all of them on a closed mesh. `energy` is the stiffness
/// matrix K. `scaled` multiplies M by the factor that makes it add up to the measure of the mesh, and L by the one that makes the weak
/// residual smallest then.
///
/// # Errors
/// An energy that cannot be factorised.
pub fn residual(
    operator: &Operator,
    mass: &[f64],
    energy: &Csr,
    mesh: &Mesh,
    u: &Smooth,
    scaled: bool,
) -> Result<Residual, FactorError> {
    let total = mesh.elements.iter().map(|e| e.measure).sum::<f64>() / mass.iter().sum::<f64>();
    let mass: Vec<f64> = mass.iter().map(|m| if scaled { total * m } else { *m }).collect();
    let (values, source) = (mesh.values(u.value), mesh.values(u.source));
    let inside = mesh.domain.interior();
    let closed = inside.len() == operator.size();
    // On a closed mesh one vertex is fixed and the mean is taken out of both sides, as the solution does.
    let unknown: Vec<usize> = if closed { (1..operator.size()).collect() } else { inside.clone() };
    let mean =
        if closed { source.iter().zip(&mass).map(|(f, m)| f * m).sum::<f64>() / mass.iter().sum::<f64>() } else { 0.0 };
    let left = operator.stiffness().mul(&values);
    let right: Vec<f64> = source.iter().zip(&mass).map(|(f, m)| (f - mean) * m).collect();
    let factor = Ldlt::new(&energy.submatrix(&unknown, &unknown))?;
    let pick = |x: &[f64]| unknown.iter().map(|&v| x[v]).collect::<Vec<f64>>();
    let mut solved = [pick(&left), pick(&right)];
    factor.solve(&mut solved);
    let [l, r] = [pick(&left), pick(&right)];
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let scale = if scaled { dot(&l, &solved[1]) / dot(&l, &solved[0]) } else { 1.0 };
    let rest: Vec<f64> = l.iter().zip(&r).map(|(l, r)| scale * l - r).collect();
    let lifted: Vec<f64> = solved[0].iter().zip(&solved[1]).map(|(l, r)| scale * l - r).collect();
    let weak = (dot(&rest, &lifted).max(0.0) / energy.quadratic_form(&values)).sqrt();
    let largest = source.iter().fold(0.0, |a: f64, f| a.max(f.abs()));
    let pointwise = inside.iter().map(|&v| (scale * left[v] / mass[v] - source[v]).abs()).fold(0.0, f64::max) / largest;
    Ok(Residual { pointwise, weak })
}
