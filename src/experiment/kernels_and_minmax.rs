//! Eigenvalues of Laplacians in exact arithmetic: kernels, real roots, eigenvectors, and the min–max principle.
//!
//! # How the min–max principle is decided
//! λ_k is the smallest t such that some k-dimensional space has no Rayleigh quotient above t. Both halves are statements about
//! inertia, for every rational t: on a space S with basis B the pencil `Bᵀ(L − tM)B` has no more negative eigenvalues than
//! `L − tM` (no space does better); and the elimination of `L − tM` gives a space of as many dimensions as it has negative
//! eigenvalues on which the form is negative (some space does as well as eigenvectors).

use std::cmp::Ordering;

use super::calculus::{Polynomial, ratio, whole};
use super::poll::{Case, Every, Search};
use super::world::excerpt::{on_graph, sparse};
use super::world::graphs::{component_count, describe, graphs_up_to, laplacian, randomly_weighted};
use super::world::triangulations::{describe_world, world};
use super::{Experiment, Finding, Setting};
use crate::domain::Graph;
use crate::generate::Stream;
use crate::laplacian::cotan::stiffness_in_plane;
use crate::linalg::Dense;
use crate::linalg::polynomial::{self, Sturm};
use crate::property::Statement;
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "kernels-and-minmax",
    name: "Kernels, eigenvalues and the min–max principle, exactly",
    statement: "with zero boundary values the kernel of a Laplacian is trivial; without, it is the constants on connected domains \
                alone; symmetric positive semi-definite matrices have real eigenvalues ≥ 0 and a basis of eigenvectors, \
                which in infinite dimension they need not have; eigenvalues are minima over spaces of maxima of Rayleigh quotients",
    sources: &["wardetzky-primer"],
    parts: &[
        "dirichlet-kernel-is-trivial",
        "kernel-is-constant",
        "connected-kernel-is-constant",
        "kernel-has-a-dimension-for-each-component",
        "eigenvalues-are-nonnegative",
        "eigenvectors-in-any-dimension",
        "eigenvectors-in-finite-dimension",
        "first-eigenvalue-is-the-minimum",
        "no-space-is-better",
        "some-space-attains",
    ],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let points = setting.pick(5, 6);
    let (mut dirichlet, mut connected) = (Every::default(), Every::default());
    for t in world(points) {
        let Some(l) = stiffness_in_plane::<Rational>(&t.surface()).map(|l| Dense::from_csr(&l)) else { continue };
        let inside: Vec<usize> = (0..l.rows()).filter(|&v| !t.boundary()[v]).collect();
        if !inside.is_empty() {
            dirichlet.ask(not_regular(&l.submatrix(&inside, &inside), &t.describe()));
        }
        connected.ask(wrong_kernel(&l, 1, &t.describe()));
    }
    let (mut constant, mut dimension) = (Every::default(), Every::default());
    let (mut real, mut finite) = (Every::default(), Every::default());
    let (mut first, mut better, mut attained) = (Every::default(), Every::default(), Every::default());
    for graph in graphs_up_to(setting.pick(4, 5)) {
        for graph in [randomly_weighted(&graph, &mut stream), graph] {
            let (l, n) = (laplacian(&graph), graph.vertex_count());
            constant.ask(more_than_constants(&graph, &l));
            dimension.ask(wrong_kernel(&l, component_count(&graph), &describe(&graph)));
            if component_count(&graph) == 1 {
                connected.ask(wrong_kernel(&l, 1, &describe(&graph)));
            }
            real.ask(not_nonnegative(&l, &describe(&graph)));
            finite.ask(no_basis(&l, &describe(&graph)));
            let mass = Dense::from_fn(n, n, |i, j| whole(if i == j { 1 + (i as i64 * 5) % 3 } else { 0 }));
            for _ in 0..setting.pick(2, 6) {
                let t = ratio(stream.below(160) as i64, 16);
                let k = 1 + stream.below(n);
                let basis = random_space(n, k, &mut stream);
                let shifted = shifted(&l, &mass, &t);
                better.ask(better_space(&shifted, &basis, &describe(&graph)));
                attained.ask(unattained(&shifted, &describe(&graph)));
                if n > 1 && component_count(&graph) == 1 {
                    first.ask(first_is_not_the_minimum(&l, &mass, &t, &describe(&graph)));
                }
            }
        }
    }
    let mut infinite = Search::default();
    for degree in 0..setting.pick(5, 8) {
        infinite.ask(eigenpolynomial(degree, |k| vec![(k + 1, Rational::ONE)]));
    }
    let infinite = infinite.answer(
        "eigenvectors-in-any-dimension",
        "Has every symmetric positive semi-definite operator an eigenvector? Multiplication by x on the polynomials over [0, 1] is \
         one, (u, xv) = (xu, v) and (u, xu) ≥ 0: is there a λ and a polynomial p of at most that degree with x p = λ p?",
        "degrees",
    );
    let triangulations = describe_world(points);
    let graphs = "graphs with few vertices, unit and random weights";
    vec![
        dirichlet.answer(
            "dirichlet-kernel-is-trivial",
            format!("Is the part L_II of the cotangent stiffness at interior vertices positive definite? Cases: {triangulations}."),
            "triangulations with an interior vertex",
        ),
        constant.answer("kernel-is-constant", "Is the kernel of the Laplacian the constants?", graphs),
        connected.answer(
            "connected-kernel-is-constant",
            format!("Is it on connected domains? Cases: {triangulations}, and connected graphs."),
            "triangulations and graphs",
        ),
        dimension.answer(
            "kernel-has-a-dimension-for-each-component",
            "Is the kernel the functions that are constant on each component?",
            graphs,
        ),
        real.answer(
            "eigenvalues-are-nonnegative",
            "Are all roots of the characteristic polynomial real and non-negative (Sturm's theorem)?",
            graphs,
        ),
        infinite,
        finite.answer(
            "eigenvectors-in-finite-dimension",
            "Is there a basis of eigenvectors: does the squarefree part of the characteristic polynomial vanish at L?",
            graphs,
        ),
        first.answer(
            "first-eigenvalue-is-the-minimum",
            "Is the smallest Rayleigh quotient orthogonal to the constants below t exactly where two eigenvalues are?",
            "pairs of a connected graph and a t",
        ),
        better.answer(
            "no-space-is-better",
            "Has no random space more dimensions of Rayleigh quotient below t than the pencil has eigenvalues there?",
            "triples of a graph, a space and a t",
        ),
        attained.answer(
            "some-space-attains",
            "Is there a space of as many dimensions as eigenvalues below t, all of whose Rayleigh quotients are below t?",
            "pairs of a graph and a t",
        ),
    ]
}

/// The columns are k vectors with small whole components.
fn random_space(n: usize, k: usize, stream: &mut Stream) -> Dense<Rational> {
    let mut basis = Dense::from_fn(n, k, |_, _| Rational::ZERO);
    let (rows, columns) = (basis.rows(), basis.columns());
    for (i, j) in (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))) {
        basis.add_to(i, j, whole(stream.below(9) as i64 - 4));
    }
    basis
}

/// `L − tM`.
fn shifted(l: &Dense<Rational>, mass: &Dense<Rational>, t: &Rational) -> Dense<Rational> {
    Dense::from_fn(l.rows(), l.rows(), |i, j| (l.at(i, j).clone() - t.clone() * mass.at(i, j).clone()).reduced())
}

fn negatives(a: &Dense<Rational>) -> usize {
    a.eliminate().inertia().negative
}

/// `Bᵀ A B`.
fn restricted(a: &Dense<Rational>, basis: &Dense<Rational>) -> Dense<Rational> {
    basis.transpose().product(&a.product(basis))
}

fn told(violated: bool, text: impl FnOnce() -> String) -> Option<Case> {
    violated.then(|| Case::told(text()))
}

fn not_regular(inner: &Dense<Rational>, name: &str) -> Option<Case> {
    let eliminated = inner.eliminate();
    told(!eliminated.is_definite() || !inner.kernel().is_empty(), || format!("{:?} on {name}", eliminated.inertia()))
}

/// The kernel has this dimension, and the constants are in it.
fn wrong_kernel(l: &Dense<Rational>, expected: usize, name: &str) -> Option<Case> {
    let found = l.kernel().len();
    let constant = l.mul(&vec![Rational::ONE; l.rows()]).iter().all(|v| v.cmp_zero() == Ordering::Equal);
    told(found != expected || !constant, || format!("a kernel of dimension {found} on {name}"))
}

/// A vector of the kernel that vanishes at a vertex and not everywhere.
fn more_than_constants(graph: &Graph, l: &Dense<Rational>) -> Option<Case> {
    let kernel = l.kernel();
    let pivot = kernel.first()?;
    let other = kernel.get(1)?;
    let at = (0..l.rows()).find(|&v| pivot[v].cmp_zero() != Ordering::Equal)?;
    let factor = other[at].clone() / pivot[at].clone();
    let x: Vec<Rational> =
        other.iter().zip(pivot).map(|(o, p)| (o.clone() - factor.clone() * p.clone()).reduced()).collect();
    let all: Vec<usize> = (0..l.rows()).collect();
    let statement = Statement::Singular { set: vec![at], x: sparse(&x) };
    let text = format!("{:?}, which vanishes at vertex {at}, on {}", sparse(&x), describe(graph));
    Some(Case::shown(text, on_graph(statement, graph, l, &all)))
}

/// Distinct roots in [0, bound], and in all, by Sturm's theorem; the bound is that of Gershgorin.
fn not_nonnegative(a: &Dense<Rational>, name: &str) -> Option<Case> {
    let p = polynomial::Polynomial::characteristic(a);
    let distinct = p.without_multiplicities().degree().unwrap_or(0);
    let sums = (0..a.rows()).map(|i| crate::scalar::sum((0..a.rows()).map(|j| a.at(i, j).magnitude())));
    let bound = sums.fold(whole(1), |m, s| if s > m { s } else { m });
    // Sturm's interval is open below, so that 0 is counted by itself.
    let zero = usize::from(p.at(&Rational::ZERO).cmp_zero() == Ordering::Equal);
    let chain = Sturm::new(&p);
    let found = zero + chain.up_to(&bound) - chain.up_to(&Rational::ZERO);
    told(found != distinct, || format!("{found} real roots ≥ 0 of {distinct} on {name}"))
}

fn no_basis(a: &Dense<Rational>, name: &str) -> Option<Case> {
    told(!has_basis(a), || name.to_string())
}

/// Whether A has a basis of eigenvectors over the complex numbers: the part s of its characteristic polynomial that has each root once
/// has `s(A) = 0`.
pub(super) fn has_basis(a: &Dense<Rational>) -> bool {
    let value = polynomial::Polynomial::characteristic(a).without_multiplicities().at_matrix(a);
    let n = a.rows();
    (0..n * n).all(|k| value.at(k / n, k % n).cmp_zero() == Ordering::Equal)
}

/// With `Q` a basis of the vectors orthogonal to M1: the form `L − tM` is negative somewhere on it exactly if the pencil has
/// two eigenvalues below t, of which the constants give one.
fn first_is_not_the_minimum(l: &Dense<Rational>, mass: &Dense<Rational>, t: &Rational, name: &str) -> Option<Case> {
    let n = l.rows();
    let weight = |i: usize| crate::scalar::sum((0..n).map(|j| mass.at(i, j).clone()));
    let basis = Dense::from_fn(n, n - 1, |i, j| match i {
        0 => -weight(j + 1),
        i if i == j + 1 => weight(0),
        _ => Rational::ZERO,
    });
    let shifted = shifted(l, mass, t);
    let below = negatives(&restricted(&shifted, &basis)) > 0;
    told(below != (negatives(&shifted) >= 2), || format!("t = {t} on {name}"))
}

fn better_space(shifted: &Dense<Rational>, basis: &Dense<Rational>, name: &str) -> Option<Case> {
    let (space, all) = (negatives(&restricted(shifted, basis)), negatives(shifted));
    told(space > all, || format!("{space} dimensions for {all} eigenvalues on {name}"))
}

/// The directions of negative energy one after another, each orthogonal to the last in the sense of the form.
fn unattained(shifted: &Dense<Rational>, name: &str) -> Option<Case> {
    let (n, wanted) = (shifted.rows(), negatives(shifted));
    let mut space: Vec<Vec<Rational>> = Vec::new();
    let mut rest = shifted.clone();
    while let Some(x) = rest.eliminate().negative_direction() {
        // rest − (rest x)(rest x)ᵀ / xᵀ rest x has x in its kernel and one negative eigenvalue less.
        let (image, energy) = (rest.mul(&x), rest.quadratic_form(&x));
        rest = Dense::from_fn(n, n, |i, j| {
            (rest.at(i, j).clone() - image[i].clone() * image[j].clone() / energy.clone()).reduced()
        });
        space.push(x);
        if space.len() > n {
            break;
        }
    }
    if space.is_empty() {
        return told(wanted != 0, || name.to_string());
    }
    let basis = Dense::from_fn(n, space.len(), |i, j| space[j][i].clone());
    let found = negatives(&restricted(shifted, &basis));
    told(found != wanted || space.len() != wanted, || format!("{found} dimensions for {wanted} eigenvalues on {name}"))
}

/// The coefficients of a polynomial, by power.
type Image = Vec<(usize, Rational)>;

/// A degree for which `A p = λ p` is not excluded for every λ at once: the conditions on the coefficients of p are linear with
/// entries in ℚ\[λ\], and all but the one on the constant term are regular, whatever λ is, if their determinant is a constant
/// other than 0.
fn eigenpolynomial(degree: usize, operator: impl Fn(usize) -> Image) -> Option<Case> {
    let lambda = Polynomial::variable(1, 0);
    let entry = |row: usize, column: usize| {
        let image = operator(column).into_iter().filter(|(power, _)| *power == row);
        let value = image.fold(Polynomial::zero(1), |sum, (_, c)| &sum + &Polynomial::constant(1, c));
        if row == column { &value - &lambda } else { value }
    };
    let rows: Vec<Vec<Polynomial>> =
        (1..=degree + 1).map(|row| (0..=degree).map(|column| entry(row, column)).collect()).collect();
    let determinant = determinant(&rows);
    told(determinant.degree() != Some(0), || format!("degree {degree}: the determinant is {determinant}"))
}

/// Expanded along the first row.
fn determinant(rows: &[Vec<Polynomial>]) -> Polynomial {
    let Some((first, rest)) = rows.split_first() else { return Polynomial::constant(1, Rational::ONE) };
    first.iter().enumerate().filter(|(_, entry)| !entry.is_zero()).fold(Polynomial::zero(1), |sum, (j, entry)| {
        let minor: Vec<Vec<Polynomial>> = rest.iter().map(|row| [&row[..j], &row[j + 1..]].concat()).collect();
        let term = entry * &determinant(&minor);
        if j % 2 == 0 { &sum + &term } else { &sum - &term }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix<const N: usize>(rows: [[i64; N]; N]) -> Dense<Rational> {
        Dense::from_fn(N, N, |i, j| whole(rows[i][j]))
    }

    #[test]
    fn a_negative_a_complex_and_a_defective_eigenvalue_are_noticed() {
        assert!(not_nonnegative(&matrix([[1, -1], [-1, 1]]), "").is_none());
        assert!(not_nonnegative(&matrix([[1, 2], [2, 1]]), "").is_some(), "the eigenvalue −1");
        assert!(not_nonnegative(&matrix([[1, -1], [1, 1]]), "").is_some(), "the eigenvalues 1 ± i");
        assert!(no_basis(&matrix([[1, 1], [0, 1]]), "").is_some() && no_basis(&matrix([[1, 1], [1, 1]]), "").is_none());
    }

    #[test]
    fn a_jordan_block_has_no_basis_and_a_rotation_has_a_complex_one() {
        assert!(!has_basis(&matrix([[2, 1], [0, 2]])));
        assert!([[[0, -1], [1, 0]], [[1, 0], [0, 1]]].into_iter().all(|rows| has_basis(&matrix(rows))));
        assert!(has_basis(&matrix([[1, -1, 0], [-1, 2, -1], [0, -1, 1]])));
    }

    #[test]
    fn a_second_component_and_a_free_interior_enlarge_the_kernel() {
        let apart = Graph::new(3, &[[0, 1]]).unwrap();
        let l = laplacian(&apart);
        let case = more_than_constants(&apart, &l).unwrap();
        assert!(matches!(case.evidence[0].statement, Statement::Singular { .. }));
        assert!(wrong_kernel(&l, 1, "").is_some() && wrong_kernel(&l, 2, "").is_none());
        assert!(wrong_kernel(&matrix([[1, 1], [1, 1]]), 1, "").is_some(), "the kernel is not the constants");
        assert!(not_regular(&l, "").is_some() && not_regular(&matrix([[2, -1], [-1, 2]]), "").is_none());
    }

    #[test]
    fn a_pencil_with_an_eigenvalue_too_few_is_noticed_by_the_space_that_has_it() {
        let (a, wrong) = (matrix([[-1, 0], [0, -2]]), matrix([[-1, 0], [0, 2]]));
        let plane = matrix([[1, 1], [1, -1]]);
        assert!(better_space(&a, &plane, "").is_none());
        assert_eq!(negatives(&restricted(&a, &plane)), 2);
        assert!(negatives(&restricted(&a, &plane)) > negatives(&wrong));
        assert!(unattained(&a, "").is_none() && unattained(&wrong, "").is_none());
    }

    #[test]
    fn multiplication_by_x_has_no_eigenpolynomial_and_x_times_the_derivative_has() {
        let multiplication = |k: usize| vec![(k + 1, Rational::ONE)];
        let euler = |k: usize| vec![(k, whole(k as i64))];
        for degree in 0..5 {
            assert!(eigenpolynomial(degree, multiplication).is_none());
            assert!(eigenpolynomial(degree, euler).is_some());
        }
    }
}
