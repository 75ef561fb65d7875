//! Poisson's equation `−Δu = f` with a known solution, and the error of its discrete solution `L u_h = M f`.
//!
//! # Boundary
//! Dirichlet: the values of u are given at the boundary vertices. Natural: the mean of f is taken out of the right-hand side (it is
//! zero but for the quadrature in M), one vertex is fixed, and u_h is compared up to a constant.
//!
//! # Norms
//! `‖u_h − u‖` in L² and in the energy `(∫|∇(u_h − u)|²)^½`, u_h linear on each triangle or tetrahedron, relative to the same norm of u. Both
//! are integrated on the mesh, exactly for polynomials of degree two; so it is the mesh that measures, and never the operator.

use super::mesh::Mesh;
use super::place::{Boundary, Smooth};
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
    let source = mesh.values(u.source);
    let mut load = mass.mul(&source);
    let (unknown, mut values): (Vec<usize>, Vec<f64>) = match boundary {
        Boundary::Dirichlet => {
            let given = |(p, on): (&[f64; 3], &bool)| if *on { (u.value)(*p) } else { 0.0 };
            (mesh.domain.interior(), mesh.points.iter().zip(mesh.domain.boundary()).map(given).collect())
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

/// A node with its share of the measure, the discrete value and gradient, and the smooth ones.
struct Sample {
    weight: f64,
    values: [f64; 2],
    gradients: [[f64; 3]; 2],
}

/// The relative errors of values at the vertices.
pub fn errors(mesh: &Mesh, values: &[f64], u: &Smooth, fit: Fit) -> Errors {
    let samples = samples(mesh, values, u);
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
    Errors { l2: l2.sqrt(), energy: energy.sqrt() }
}

fn samples(mesh: &Mesh, values: &[f64], u: &Smooth) -> Vec<Sample> {
    let mut samples = Vec::with_capacity(4 * mesh.elements.len());
    for element in &mesh.elements {
        let x: Vec<f64> = element.corners.iter().map(|(v, _)| values[*v]).collect();
        let (discrete, nodes) = (element.gradient(&x), element.nodes());
        for shares in &nodes {
            let at = element.point(shares);
            samples.push(Sample {
                weight: element.measure / nodes.len() as f64,
                values: [shares.iter().zip(&x).map(|(s, x)| s * x).sum(), (u.value)(at)],
                gradients: [discrete, element.along((u.gradient)(at))],
            });
        }
    }
    samples
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::super::place::Place;
    use super::super::sequence::{ALL, Sequence, Way};
    use super::*;

    fn cotan(mesh: &Mesh) -> Operator {
        let id = if mesh.place == Place::Cube { "tet-cotan" } else { "cotan" };
        crate::laplacian::find(id).unwrap().build(&mesh.domain, &BTreeMap::new()).unwrap()
    }

    fn fit(boundary: Boundary) -> Fit {
        if boundary == Boundary::Natural { Fit::Constant } else { Fit::None }
    }

    #[test]
    fn the_solution_of_cotan_is_near_on_every_sequence() {
        for sequence in ALL {
            let mesh = sequence.mesh(if sequence.place == Place::Cube { 8 } else { 16 }, 3).unwrap();
            let operator = cotan(&mesh);
            let mass = operator.mass().unwrap().matrix();
            for &boundary in mesh.place.boundaries() {
                let u = mesh.place.solution(boundary);
                let found = solve(&operator, mass, &mesh, boundary, &u).unwrap();
                let errors = errors(&mesh, &found, &u, fit(boundary));
                assert!(errors.l2 < 0.1 && errors.energy < 0.35, "{} {boundary:?}: {errors:?}", sequence.name());
            }
        }
    }

    #[test]
    fn linear_functions_have_no_error_and_others_the_one_of_their_formula() {
        let mesh = Sequence { place: Place::Square, way: Way::Random }.mesh(8, 1).unwrap();
        let linear = Smooth { value: |[x, y, _]| 2.0 * x - y, gradient: |_| [2.0, -1.0, 0.0], source: |_| 0.0 };
        let operator = cotan(&mesh);
        let mass = operator.mass().unwrap().matrix();
        let values = solve(&operator, mass, &mesh, Boundary::Dirichlet, &linear).unwrap();
        let found = errors(&mesh, &values, &linear, Fit::None);
        assert!(found.l2 < 1e-13 && found.energy < 1e-12, "{found:?}");
        // Zero against x: everything is missing. A constant more is no error where constants do not count.
        let zero = vec![0.0; values.len()];
        assert_eq!(errors(&mesh, &zero, &linear, Fit::None), Errors { l2: 1.0, energy: 1.0 });
        let raised: Vec<f64> = values.iter().map(|v| v + 5.0).collect();
        assert!(errors(&mesh, &raised, &linear, Fit::Constant).l2 < 1e-13);
        let doubled: Vec<f64> = values.iter().map(|v| 2.0 * v).collect();
        let found = errors(&mesh, &doubled, &linear, Fit::Factor);
        assert!(found.l2 < 1e-13 && found.energy < 1e-12);
    }

    #[test]
    fn the_interpolant_of_a_square_has_the_energy_error_of_its_formula() {
        // x² on the structured square: the error of ∂x in a cell of width h is x − its mean, ∫ = h²/12 · 4, so h/√3 in all;
        // the norm of ∇x² is 2/√3: relative h/2.
        let u = Smooth { value: |[x, ..]| x * x, gradient: |[x, ..]| [2.0 * x, 0.0, 0.0], source: |_| -2.0 };
        for level in [4, 8, 16] {
            let mesh = Sequence { place: Place::Square, way: Way::Structured }.mesh(level, 0).unwrap();
            let values = mesh.values(u.value);
            let found = errors(&mesh, &values, &u, Fit::None);
            assert!((found.energy - 0.5 * mesh.h).abs() < 1e-14, "{found:?} {}", mesh.h);
        }
    }

    #[test]
    fn a_wrong_sign_and_a_wrong_factor_do_not_go_away() {
        let mesh = Sequence { place: Place::Sphere, way: Way::Structured }.mesh(32, 0).unwrap();
        let operator = cotan(&mesh);
        let u = mesh.place.solution(Boundary::Natural);
        for (factor, least) in [(-1.0, 1.9), (0.5, 0.4)] {
            let mass = operator.mass().unwrap().matrix().map(|_, _, m| factor * m);
            let found = solve(&operator, &mass, &mesh, Boundary::Natural, &u).unwrap();
            let errors = errors(&mesh, &found, &u, Fit::Constant);
            assert!(errors.l2 > least && errors.energy > least, "{factor}: {errors:?}");
        }
    }
}
