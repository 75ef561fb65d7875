//! Poisson's equation `−Δu = f` with a known solution, and the error of its discrete solution `L u_h = M f`.
//!
//! # Boundary
//! Dirichlet: the values of u are given at the boundary vertices. Natural: the mean of f is taken out of the right-hand side (it is
//! zero but for the quadrature in M), one vertex is fixed, and u_h is compared up to a constant.
//!
//! # Norms
//! `‖u_h − u‖` in L² and in the energy `(∫|∇(u_h − u)|²)^½`, u_h linear on each triangle, relative to the same norm of u. Both are integrated
//! on the mesh with the midpoints of the edges, exactly for polynomials of degree two; so it is the mesh that measures, and never
//! the operator.

use super::place::{Boundary, Smooth};
use super::sequence::Mesh;
use crate::linalg::Csr;
use crate::linalg::factor::{FactorError, Ldlt, Lu};
use crate::operator::Operator;

/// The relative errors of a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// In L².
    pub l2: f64,
    /// In the energy norm.
    pub energy: f64,
}

/// What a solution may be corrected by before it is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// Nothing.
    None,
    /// A constant is added.
    Constant,
    /// It is multiplied by the best factor: an operator that knows no lengths can hope for no more. For zero boundary values.
    Factor,
}

/// Solves `L u_h = M f` at the vertices.
///
/// # Errors
/// A system that cannot be factorised.
pub fn solve(
    operator: &Operator,
    mass: &Csr,
    mesh: &Mesh,
    boundary: Boundary,
    u: &Smooth,
) -> Result<Vec<f64>, FactorError> {
    let n = operator.size();
    let l = operator.stiffness();
    let point = |v: usize| mesh.place.point(&mesh.domain, v);
    let source: Vec<f64> = (0..n).map(|v| (u.source)(point(v))).collect();
    let mut load = mass.mul(&source);
    let (unknown, mut values): (Vec<usize>, Vec<f64>) = match boundary {
        Boundary::Dirichlet => {
            let given = (0..n).map(|v| if mesh.domain.boundary()[v] { (u.value)(point(v)) } else { 0.0 });
            (mesh.domain.interior(), given.collect())
        }
        Boundary::Natural => {
            let shares = mass.mul(&vec![1.0; n]);
            let mean = load.iter().sum::<f64>() / shares.iter().sum::<f64>();
            load.iter_mut().zip(&shares).for_each(|(b, share)| *b -= mean * share);
            ((1..n).collect(), vec![0.0; n])
        }
    };
    let known = l.mul(&values);
    let mut solution = [unknown.iter().map(|&v| load[v] - known[v]).collect::<Vec<f64>>()];
    let matrix = l.submatrix(&unknown, &unknown);
    if matrix.entries().all(|(i, j, v)| *v == matrix.at(j, i)) {
        Ldlt::new(&matrix)?.solve(&mut solution);
    } else {
        Lu::new(&matrix)?.solve(&mut solution);
    }
    unknown.iter().zip(&solution[0]).for_each(|(&v, x)| values[v] = *x);
    Ok(values)
}

/// A midpoint of an edge with its share of the area, the discrete value and gradient, and the smooth ones.
struct Sample {
    weight: f64,
    values: [f64; 2],
    gradients: [[f64; 3]; 2],
}

/// The relative errors of values at the vertices, `None` if a face is not a triangle.
pub fn errors(mesh: &Mesh, values: &[f64], u: &Smooth, fit: Fit) -> Option<Errors> {
    let samples = samples(mesh, values, u)?;
    let sum = |f: &dyn Fn(&Sample) -> f64| samples.iter().map(|s| s.weight * f(s)).sum::<f64>();
    let (mut factor, mut shift) = (1.0, 0.0);
    match fit {
        Fit::None => {}
        Fit::Constant => shift = sum(&|s| s.values[1] - s.values[0]) / sum(&|_| 1.0),
        Fit::Factor => factor = sum(&|s| s.values[0] * s.values[1]) / sum(&|s| s.values[0] * s.values[0]),
    }
    let mean = if fit == Fit::Constant { sum(&|s| s.values[1]) / sum(&|_| 1.0) } else { 0.0 };
    let square = |f: &dyn Fn(usize) -> f64| (0..3).map(|k| f(k) * f(k)).sum::<f64>();
    let l2 = sum(&|s| (factor * s.values[0] + shift - s.values[1]).powi(2)) / sum(&|s| (s.values[1] - mean).powi(2));
    if fit == Fit::Factor {
        let product = |s: &Sample| (0..3).map(|k| s.gradients[0][k] * s.gradients[1][k]).sum::<f64>();
        factor = sum(&product) / sum(&|s| square(&|k| s.gradients[0][k]));
    }
    let difference = |s: &Sample| square(&|k| factor * s.gradients[0][k] - s.gradients[1][k]);
    let energy = sum(&difference) / sum(&|s| square(&|k| s.gradients[1][k]));
    Some(Errors { l2: l2.sqrt(), energy: energy.sqrt() })
}

fn samples(mesh: &Mesh, values: &[f64], u: &Smooth) -> Option<Vec<Sample>> {
    let surface = mesh.domain.as_surface()?;
    let mut samples = Vec::with_capacity(3 * surface.faces().len());
    for face in 0..surface.faces().len() {
        let (vertices, p) = mesh.place.corners(&mesh.domain, surface, face)?;
        let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (e, f) = (minus(p[1], p[0]), minus(p[2], p[0]));
        // The gradient of a linear function from its differences along e and f: the inverse of their Gram matrix.
        let (ee, ef, ff) = (dot(e, e), dot(e, f), dot(f, f));
        let determinant = ee * ff - ef * ef;
        let gradient = |along: [f64; 2]| {
            let a = (ff * along[0] - ef * along[1]) / determinant;
            let b = (ee * along[1] - ef * along[0]) / determinant;
            [0, 1, 2].map(|k| a * e[k] + b * f[k])
        };
        let x = vertices.map(|v| values[v]);
        let discrete = gradient([x[1] - x[0], x[2] - x[0]]);
        for k in 0..3 {
            let l = (k + 1) % 3;
            let middle = [0, 1, 2].map(|c| 0.5 * (p[k][c] + p[l][c]));
            let full = (u.gradient)(middle);
            samples.push(Sample {
                weight: determinant.sqrt() / 6.0,
                values: [0.5 * (x[k] + x[l]), (u.value)(middle)],
                gradients: [discrete, gradient([dot(full, e), dot(full, f)])],
            });
        }
    }
    Some(samples)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::super::place::Place;
    use super::super::sequence::{ALL, Sequence, Way};
    use super::*;

    fn cotan(mesh: &Mesh) -> Operator {
        crate::laplacian::find("cotan").unwrap().build(&mesh.domain, &BTreeMap::new()).unwrap()
    }

    fn fit(boundary: Boundary) -> Fit {
        if boundary == Boundary::Natural { Fit::Constant } else { Fit::None }
    }

    #[test]
    fn the_solution_of_cotan_is_near_on_every_sequence() {
        for sequence in ALL {
            let mesh = sequence.mesh(4, 3).unwrap();
            let operator = cotan(&mesh);
            let mass = operator.mass().unwrap().matrix();
            for &boundary in mesh.place.boundaries() {
                let u = mesh.place.solution(boundary);
                let found = solve(&operator, mass, &mesh, boundary, &u).unwrap();
                let errors = errors(&mesh, &found, &u, fit(boundary)).unwrap();
                assert!(errors.l2 < 0.1 && errors.energy < 0.35, "{} {boundary:?}: {errors:?}", sequence.name());
            }
        }
    }

    #[test]
    fn linear_functions_have_no_error_and_others_the_one_of_their_formula() {
        let mesh = Sequence { place: Place::Square, way: Way::RandomDelaunay }.mesh(3, 1).unwrap();
        let linear = Smooth { value: |[x, y, _]| 2.0 * x - y, gradient: |_| [2.0, -1.0, 0.0], source: |_| 0.0 };
        let operator = cotan(&mesh);
        let mass = operator.mass().unwrap().matrix();
        let values = solve(&operator, mass, &mesh, Boundary::Dirichlet, &linear).unwrap();
        let found = errors(&mesh, &values, &linear, Fit::None).unwrap();
        assert!(found.l2 < 1e-13 && found.energy < 1e-12, "{found:?}");
        // Zero against x: everything is missing. A constant more is no error where constants do not count.
        let zero = vec![0.0; values.len()];
        assert_eq!(errors(&mesh, &zero, &linear, Fit::None), Some(Errors { l2: 1.0, energy: 1.0 }));
        let raised: Vec<f64> = values.iter().map(|v| v + 5.0).collect();
        assert!(errors(&mesh, &raised, &linear, Fit::Constant).unwrap().l2 < 1e-13);
        let doubled: Vec<f64> = values.iter().map(|v| 2.0 * v).collect();
        let found = errors(&mesh, &doubled, &linear, Fit::Factor).unwrap();
        assert!(found.l2 < 1e-13 && found.energy < 1e-12);
    }

    #[test]
    fn the_interpolant_of_a_square_has_the_energy_error_of_its_formula() {
        // x² on the structured square: the error of ∂x in a cell of width h is x − its mean, ∫ = h²/12 · 4, so h/√3 in all;
        // the norm of ∇x² is 2/√3: relative h/2.
        let u = Smooth { value: |[x, ..]| x * x, gradient: |[x, ..]| [2.0 * x, 0.0, 0.0], source: |_| -2.0 };
        for level in 2..5 {
            let mesh = Sequence { place: Place::Square, way: Way::Structured }.mesh(level, 0).unwrap();
            let values: Vec<f64> =
                (0..mesh.domain.vertex_count()).map(|v| (u.value)(mesh.place.point(&mesh.domain, v))).collect();
            let found = errors(&mesh, &values, &u, Fit::None).unwrap();
            assert!((found.energy - 0.5 * mesh.h).abs() < 1e-14, "{found:?} {}", mesh.h);
        }
    }

    #[test]
    fn a_wrong_sign_and_a_wrong_factor_do_not_go_away() {
        let mesh = Sequence { place: Place::Sphere, way: Way::Structured }.mesh(5, 0).unwrap();
        let operator = cotan(&mesh);
        let u = mesh.place.solution(Boundary::Natural);
        for (factor, least) in [(-1.0, 1.9), (0.5, 0.4)] {
            let mass = operator.mass().unwrap().matrix().map(|_, _, m| factor * m);
            let found = solve(&operator, &mass, &mesh, Boundary::Natural, &u).unwrap();
            let errors = errors(&mesh, &found, &u, Fit::Constant).unwrap();
            assert!(errors.l2 > least && errors.energy > least, "{factor}: {errors:?}");
        }
    }
}
