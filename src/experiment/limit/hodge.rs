//! The Hodge decomposition of a 1-form on a closed surface against the smooth one: `ω = dφ + ⋆dψ + h`.
//!
//! # Definition
//! ω is taken to the edges by its integrals along them, and from the edges back to the triangles by Whitney's forms
//! `w_ij = λ_i dλ_j − λ_j dλ_i`, whose inner product on the edges is M₁. With the incidences d₀ of edges and vertices and d₁ of triangles and edges:
//! * exact part `d₀φ`, the φ that minimises `‖ω − d₀φ‖` in M₁: `L φ = d₀ᵀM₁ω` with `L = d₀ᵀM₁d₀`, which is the cotangent stiffness;
//! * coexact part β, which is orthogonal to all closed cochains and has `d₁β = d₁ω`: `M₁β = d₁ᵀμ`;
//! * harmonic part, the rest.
//!
//! # Errors
//! In L², as forms on the triangles, each relative to the norm of the smooth part. On the sphere the smooth form is pulled back to the triangles along
//! rays. There is no harmonic form on a sphere. On a lattice the harmonic part comes out exactly, up to rounding: an error below `64 V u`, V the
//! number of vertices, counts as none, for the condition of the stiffness of such a mesh is of the order V, and right sides carry a few u.
//!
//! # References
//! \[dodziuk1976\]: the parts converge in L²; with order 1 for Whitney's forms, whose interpolation has this order.

use std::f64::consts::TAU;

use super::mesh::{Element, Mesh};
use super::place::{Boundary, Place, unit};
use crate::domain::geometry::{cross3, dot};
use crate::laplacian;
use crate::linalg::Csr;
use crate::linalg::factor::{Ldlt, Lu};

/// The parts of a form, in this order.
pub const PARTS: [&str; 3] = ["exact part", "coexact part", "harmonic part"];

type Vector = [f64; 3];

/// The parts of the smooth form at a point, as vectors; `None` on places that are not closed.
fn smooth(place: Place, p: Vector) -> Option<[Vector; 3]> {
    let exact = (place.solution(Boundary::Natural).gradient)(p);
    match place {
        // ψ = sin 2πy + ½ cos 2π(x + y), turned by a right angle; h = (0.7, −0.4).
        Place::Torus => {
            let slope = -0.5 * TAU * (TAU * (p[0] + p[1])).sin();
            let psi = [slope, slope + TAU * (TAU * p[1]).cos()];
            Some([exact, [-psi[1], psi[0], 0.0], [0.7, -0.4, 0.0]])
        }
        // ψ = z + 2yz, turned about the normal q.
        Place::Sphere => {
            let q = unit(p);
            let length = dot(&p, &p).sqrt();
            let turned = cross3(&q, &[0.0, 2.0 * q[2], 1.0 + 2.0 * q[1]]);
            Some([exact, turned.map(|x| x / length), [0.0; 3]])
        }
        _ => None,
    }
}

/// The decomposition on one mesh.
struct Decomposition {
    /// The corners of each triangle's edges, and their numbers and signs.
    edges: Vec<[(usize, f64); 3]>,
    /// The parts on the edges.
    parts: [Vec<f64>; 3],
}

/// The corners at the ends of the edges of a triangle.
const ENDS: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// The relative errors of the parts in L²; the last is `None` where there is no harmonic form.
///
/// # Errors
/// A place that is not closed, a system that cannot be factorised, in words.
pub fn errors(mesh: &Mesh) -> Result<[Option<f64>; 3], String> {
    compare(mesh, &decompose(mesh)?)
}

fn compare(mesh: &Mesh, found: &Decomposition) -> Result<[Option<f64>; 3], String> {
    let mut sums = [[0.0; 2]; 3];
    for (element, edges) in mesh.elements.iter().zip(&found.edges) {
        let nodes = element.nodes();
        for shares in &nodes {
            let exact = smooth(mesh.place, element.point(shares)).ok_or("not a closed place")?;
            for (k, sum) in sums.iter_mut().enumerate() {
                let form = whitney(element, shares);
                let value = |c: usize| {
                    let along = |(e, w): (&(usize, f64), &Vector)| e.1 * found.parts[k][e.0] * w[c];
                    edges.iter().zip(&form).map(along).sum::<f64>()
                };
                let wanted = element.along(exact[k]);
                let weight = element.measure / nodes.len() as f64;
                sum[0] += weight * (0..3).map(|c| (value(c) - wanted[c]).powi(2)).sum::<f64>();
                sum[1] += weight * dot(&wanted, &wanted);
            }
        }
    }
    let rounding = 64.0 * mesh.points.len() as f64 * f64::EPSILON;
    let relative = |[error, norm]: [f64; 2]| match (error / norm).sqrt() {
        error if error < rounding => 0.0,
        error => error,
    };
    Ok(sums.map(|sum| (sum[1] > 0.0).then(|| relative(sum))))
}

/// Whitney's forms of the three edges at a point of a triangle.
fn whitney(element: &Element, shares: &[f64]) -> [Vector; 3] {
    let gradients = gradients(element);
    ENDS.map(|[i, j]| [0, 1, 2].map(|c| shares[i] * gradients[j][c] - shares[j] * gradients[i][c]))
}

fn gradients(element: &Element) -> [Vector; 3] {
    let [a, b] = [element.gradients[0], element.gradients[1]];
    [[0, 1, 2].map(|c| -a[c] - b[c]), a, b]
}

/// The integral of the smooth form along an edge, by Gauss' rule with three points; on the sphere along the arc over it.
fn integral(place: Place, from: Vector, to: Vector) -> Option<f64> {
    let step = [0, 1, 2].map(|c| to[c] - from[c]);
    let far = 0.5 * 0.6_f64.sqrt();
    let mut sum = 0.0;
    for (at, weight) in [(0.5 - far, 5.0), (0.5, 8.0), (0.5 + far, 5.0)] {
        let p = [0, 1, 2].map(|c| from[c] + at * step[c]);
        let total = smooth(place, p)?.iter().map(|part| dot(part, &step)).sum::<f64>();
        sum += weight / 18.0 * total;
    }
    Some(sum)
}

/// M₁ on the edges of the mesh.
fn inner_product(mesh: &Mesh, edges: &[[(usize, f64); 3]], count: usize) -> Csr {
    let mut entries = Vec::with_capacity(9 * mesh.elements.len());
    for (element, edges) in mesh.elements.iter().zip(edges) {
        let g = gradients(element);
        let both = |i: usize, j: usize| element.measure / if i == j { 6.0 } else { 12.0 };
        for (&(e, s), [i, j]) in edges.iter().zip(ENDS) {
            for (&(f, t), [k, l]) in edges.iter().zip(ENDS) {
                let product =
                    both(i, k) * dot(&g[j], &g[l]) - both(i, l) * dot(&g[j], &g[k]) - both(j, k) * dot(&g[i], &g[l])
                        + both(j, l) * dot(&g[i], &g[k]);
                entries.push((e, f, s * t * product));
            }
        }
    }
    Csr::from_triplets(count, count, &entries)
}

fn decompose(mesh: &Mesh) -> Result<Decomposition, String> {
    let surface = mesh.domain.as_surface().ok_or("not a surface")?;
    let topology = surface.topology();
    let (vertices, count, faces) = (mesh.points.len(), topology.edges().len(), mesh.elements.len());
    let mut edges = Vec::with_capacity(faces);
    let mut form = vec![0.0; count];
    for element in &mesh.elements {
        let mut mine = [(0, 0.0); 3];
        for (slot, [i, j]) in mine.iter_mut().zip(ENDS) {
            let ((a, p), (b, q)) = (element.corners[i], element.corners[j]);
            let edge = topology.edge_between(a, b).ok_or("an edge of a face is missing")?;
            let sign = if topology.edges()[edge] == [a, b] { 1.0 } else { -1.0 };
            *slot = (edge, sign);
            form[edge] = sign * integral(mesh.place, p, q).ok_or("not a closed place")?;
        }
        edges.push(mine);
    }
    let mass = inner_product(mesh, &edges, count);

    // The exact part, by the Laplacian of the catalogue; one vertex is fixed.
    let cotan = laplacian::find("cotan").ok_or("there is no cotan")?;
    let operator = cotan.build(&mesh.domain, &Default::default()).map_err(|e| e.to_string())?;
    let weighted = mass.mul(&form);
    let mut load = vec![0.0; vertices];
    for (&[a, b], value) in topology.edges().iter().zip(&weighted) {
        load[a] -= value;
        load[b] += value;
    }
    let free: Vec<usize> = (1..vertices).collect();
    let mut solution = [load[1..].to_vec()];
    Ldlt::new(&operator.stiffness().submatrix(&free, &free)).map_err(|e| e.to_string())?.solve(&mut solution);
    let potential = |v: usize| if v == 0 { 0.0 } else { solution[0][v - 1] };
    let exact: Vec<f64> = topology.edges().iter().map(|&[a, b]| potential(b) - potential(a)).collect();

    // The coexact part: M₁β − d₁ᵀμ = 0, d₁β = d₁ω. The equations of all faces add up to zero: one is left out, and its μ is zero.
    let size = count + faces - 1;
    let mut entries: Vec<(usize, usize, f64)> = mass.entries().map(|(i, j, v)| (i, j, *v)).collect();
    let mut right = vec![0.0; size];
    for (face, mine) in edges.iter().enumerate().take(faces - 1) {
        for &(edge, sign) in mine {
            entries.push((edge, count + face, -sign));
            entries.push((count + face, edge, sign));
            right[count + face] += sign * form[edge];
        }
    }
    let mut coexact = [right];
    Lu::new(&Csr::from_triplets(size, size, &entries)).map_err(|e| e.to_string())?.solve(&mut coexact);
    let coexact = coexact[0][..count].to_vec();
    let rest = (0..count).map(|e| form[e] - exact[e] - coexact[e]).collect();
    Ok(Decomposition { edges, parts: [exact, coexact, rest] })
}

#[cfg(test)]
mod tests {
    use super::super::sequence::{Sequence, Way};
    use super::*;

    fn mesh(place: Place, way: Way, n: usize) -> Mesh {
        Sequence { place, way }.mesh(n, 3).unwrap()
    }

    fn product(mass: &Csr, a: &[f64], b: &[f64]) -> f64 {
        mass.mul(a).iter().zip(b).map(|(x, y)| x * y).sum()
    }

    #[test]
    fn the_inner_product_of_differences_is_the_cotangent_stiffness() {
        for (place, way) in [(Place::Torus, Way::Structured), (Place::Sphere, Way::Random)] {
            let mesh = mesh(place, way, 8);
            let found = decompose(&mesh).unwrap();
            let edges = mesh.domain.edges();
            let mass = inner_product(&mesh, &found.edges, edges.len());
            let operator = laplacian::find("cotan").unwrap().build(&mesh.domain, &Default::default()).unwrap();
            let u: Vec<f64> = (0..mesh.points.len()).map(|v| (v as f64 * 0.7).sin()).collect();
            let du: Vec<f64> = edges.iter().map(|&[a, b]| u[b] - u[a]).collect();
            let (left, right) = (product(&mass, &du, &du), operator.stiffness().quadratic_form(&u));
            assert!((left - right).abs() < 1e-12 * right, "{left} {right}");
        }
    }

    #[test]
    fn the_parts_are_orthogonal_and_of_their_kind() {
        for (place, way) in [(Place::Torus, Way::Structured), (Place::Sphere, Way::Random)] {
            let mesh = mesh(place, way, 8);
            let Decomposition { edges, parts } = decompose(&mesh).unwrap();
            let mass = inner_product(&mesh, &edges, mesh.domain.edges().len());
            let norms = parts.each_ref().map(|p| product(&mass, p, p).sqrt());
            for [i, j] in [[0, 1], [0, 2], [1, 2]] {
                let cosine = product(&mass, &parts[i], &parts[j]) / (norms[0] * norms[1]);
                assert!(cosine.abs() < 1e-12, "{place:?} {i} {j}: {cosine:e}");
            }
            // Exact and harmonic parts are closed.
            for part in [&parts[0], &parts[2]] {
                let around = |mine: &[(usize, f64); 3]| mine.iter().map(|(e, s)| s * part[*e]).sum::<f64>();
                assert!(edges.iter().all(|mine| around(mine).abs() < 1e-12 * norms[0]));
            }
            // A sphere has no harmonic form, a torus those of constant coefficients.
            assert_eq!(norms[2] < 1e-12 * norms[0], place == Place::Sphere, "{norms:?}");
        }
    }

    #[test]
    fn the_smooth_parts_are_of_their_kind() {
        // The flux of a turned gradient out of a small square, and the circulation of a gradient round it, vanish.
        for place in [Place::Torus, Place::Sphere] {
            let (p, axes) = super::super::place::testing::somewhere(place, 2);
            let eps = 1e-3;
            for (k, flux) in [(0, false), (1, true), (2, true), (2, false)] {
                let mut sum = 0.0;
                for (a, b, sign) in [(0, 1, 1.0), (1, 0, if flux { 1.0 } else { -1.0 })] {
                    for side in [1.0, -1.0] {
                        let at = [0, 1, 2].map(|c| p[c] + side * eps * axes[a][c]);
                        let part = smooth(place, at).unwrap()[k];
                        let (out, along) = (dot(&part, &axes[a]), dot(&part, &axes[b]));
                        sum += side * if flux { out } else { sign * along };
                    }
                }
                assert!(sum.abs() / eps < 1e-4, "{place:?} {k} {flux}: {sum}");
            }
        }
    }

    #[test]
    fn parts_in_the_place_of_others_and_with_a_wrong_factor_are_seen() {
        for place in [Place::Torus, Place::Sphere] {
            let mesh = mesh(place, Way::Structured, 16);
            let mut found = decompose(&mesh).unwrap();
            let of = |found: &Decomposition| compare(&mesh, found).unwrap();
            let right = of(&found);
            assert!(right.iter().flatten().all(|e| *e < 0.2), "{right:?}");
            assert_eq!(right[2].is_some(), place == Place::Torus);
            found.parts.swap(0, 1);
            assert!(of(&found)[..2].iter().flatten().all(|e| *e > 0.9));
            found.parts.swap(0, 1);
            found.parts[1].iter_mut().for_each(|x| *x *= 1.5);
            assert!((of(&found)[1].unwrap() - 0.5).abs() < 0.1);
        }
    }
}
