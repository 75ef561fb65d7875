//! Fourier expansion in eigenvectors on graphs, exactly: orthogonality, completeness, Parseval's identity, energy.
//!
//! # Definition
//! With `L v = λ M v`, L symmetric and M positive, and an M-orthogonal basis of eigenvectors v of norms `vᵀMv`:
//!
//! ```text
//! u = Σ v (vᵀMu)/(vᵀMv),    uᵀMu = Σ (vᵀMu)²/(vᵀMv),    uᵀLu = Σ λ (vᵀMu)²/(vᵀMv)    for every u
//! ```
//! that is `Σ Mv vᵀM/(vᵀMv) = M`, and `= L` with the factor λ: identities between matrices.
//!
//! # How it is decided
//! Over the rationals, on the pencils that have a rational spectrum: all graphs with few vertices whose eigenvalues are whole (an
//! eigenvalue of a matrix of whole numbers is), and all masses of few values that leave them rational. An approximate eigenvalue times `det M`
//! is rounded to a whole number, and believed if the kernels of `L − λM` have n dimensions altogether.

use std::cmp::Ordering;

use super::calculus::whole;
use super::kernels_and_minmax::has_basis;
use super::poll::{Case, Every, Search};
use super::world::excerpt::on_graph;
use super::world::graphs::{describe, graphs_up_to, laplacian, with_weights};
use super::world::stage::written;
use super::{Experiment, Finding, Setting};
use crate::domain::Graph;
use crate::generate::Stream;
use crate::linalg::factor::symmetric_eigen;
use crate::linalg::{Csr, Dense, Pencil};
use crate::property::{Evidence, Statement};
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "eigenvector-expansion",
    name: "Expansion in eigenvectors on graphs, exactly",
    statement: "eigenvectors of L u = λ M u with L symmetric, its weights positive or not, and M positive are orthogonal and complete, and \
                norm and energy are sums over them; without symmetry there need not be an inner product, nor a basis",
    sources: &["wardetzky-primer", "grone-merris2008"],
    parts: &[
        "eigenvectors-are-orthogonal",
        "parseval-for-every-function",
        "energy-for-every-function",
        "negative-weights-expand-as-well",
        "not-symmetric-and-not-orthogonal",
        "not-symmetric-and-not-complete",
    ],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let (mut orthogonal, mut parseval, mut energy) = (Every::default(), Every::default(), Every::default());
    for (name, pencil) in pencils(setting, &mut stream) {
        let Some(expansion) = Expansion::of(&pencil, name) else { continue };
        orthogonal.ask(expansion.not_orthogonal());
        parseval.ask(expansion.not_parseval());
        energy.ask(expansion.not_the_energy());
    }
    let mut signed = Every::default();
    for (name, pencil) in signed_pencils(setting) {
        let Some(expansion) = Expansion::of(&pencil, name) else { continue };
        signed.ask(expansion.not_orthogonal().or(expansion.not_parseval()).or(expansion.not_the_energy()));
    }
    let (mut lopsided, mut defective) = (Search::default(), Search::default());
    for l in directed(3) {
        lopsided.ask(no_mass(&l));
        defective.ask(no_basis(&l));
    }
    let pencils = "pencils with a rational spectrum: graphs with few vertices, hypercubes, complete graphs weighted by products of masses, \
                   unit masses and others";
    let directed = "matrices with row sums zero on three vertices, weights 1, 2, 3 in each direction";
    vec![
        orthogonal.answer(
            "eigenvectors-are-orthogonal",
            "Is vᵀMw = 0 for all eigenvectors v and w of different eigenvalues?",
            pencils,
        ),
        parseval.answer("parseval-for-every-function", "Is uᵀMu = Σ (vᵀMu)²/(vᵀMv) for every u?", pencils),
        energy.answer("energy-for-every-function", "Is uᵀLu = Σ λ (vᵀMu)²/(vᵀMv) for every u?", pencils),
        signed.answer(
            "negative-weights-expand-as-well",
            "Are all three true where a weight is negative?",
            "pencils with a rational spectrum and a negative weight",
        ),
        lopsided.answer(
            "not-symmetric-and-not-orthogonal",
            "Is there an operator with positive weights and a basis of eigenvectors that no positive mass makes orthogonal?",
            directed,
        ),
        defective.answer(
            "not-symmetric-and-not-complete",
            "Is there one with positive weights and no basis of eigenvectors?",
            directed,
        ),
    ]
}

/// All graphs with few vertices and unit masses, those with fewer and all masses of 1, 2, 3; hypercubes; complete graphs.
fn pencils(setting: &Setting, stream: &mut Stream) -> Vec<(String, Pencil)> {
    let mut all = Vec::new();
    let mut add = |graph: &Graph, masses: &[i64]| {
        let name = format!("{}, masses {masses:?}", describe(graph));
        all.extend(pencil(laplacian(graph), masses).map(|p| (name, p)));
    };
    for graph in graphs_up_to(setting.pick(5, 6)) {
        add(&graph, &vec![1; graph.vertex_count()]);
    }
    for graph in graphs_up_to(setting.pick(3, 4)) {
        choices(graph.vertex_count(), &[1, 2, 3])
            .iter()
            .filter(|m| m.iter().any(|x| *x > 1))
            .for_each(|m| add(&graph, m));
    }
    for dimension in 3..=setting.pick(3, 4) {
        add(&hypercube(dimension), &vec![1; 1 << dimension]);
    }
    for n in 4..=setting.pick(5, 9) {
        let masses: Vec<i64> = (0..n).map(|_| 1 + stream.below(3) as i64).collect();
        add(&complete(&masses), &masses);
    }
    all
}

/// Weights 1 and −1 on every graph with at most four vertices, at least one of them negative, with two masses.
fn signed_pencils(setting: &Setting) -> Vec<(String, Pencil)> {
    let mut all = Vec::new();
    for graph in graphs_up_to(setting.pick(3, 4)) {
        let n = graph.vertex_count();
        for weights in choices(graph.edges().len(), &[1, -1]).iter().filter(|w| w.contains(&-1)) {
            let weights: Vec<f64> = weights.iter().map(|&w| w as f64).collect();
            let signed = with_weights(&graph, &weights);
            for masses in [vec![1; n], (0..n as i64).map(|i| 1 + i % 2).collect()] {
                let name = format!("{}, masses {masses:?}", describe(&signed));
                all.extend(pencil(laplacian(&signed), &masses).map(|p| (name, p)));
            }
        }
    }
    all
}

fn pencil(l: Dense<Rational>, masses: &[i64]) -> Option<Pencil> {
    let n = masses.len();
    Pencil::new(l, Dense::from_fn(n, n, |i, j| whole(if i == j { masses[i] } else { 0 })))
}

/// All lists of a length with entries among these.
fn choices(length: usize, among: &[i64]) -> Vec<Vec<i64>> {
    let base = among.len();
    let list = |code: usize| (0..length).map(|k| among[code / base.pow(k as u32) % base]).collect();
    (0..base.pow(length as u32)).map(list).collect()
}

fn hypercube(dimension: usize) -> Graph {
    let edges = (0..1_usize << dimension).flat_map(|v| (0..dimension).map(move |k| [v, v ^ 1 << k]));
    let edges: Vec<[usize; 2]> = edges.filter(|[a, b]| a < b).collect();
    Graph::new(1 << dimension, &edges).expect("edges of a cube, each once")
}

/// The complete graph with the weights `m_i m_j`: `L = (Σ m) M − m mᵀ`, with two eigenvalues for whatever masses.
fn complete(masses: &[i64]) -> Graph {
    let n = masses.len();
    let pairs: Vec<[usize; 2]> = (0..n).flat_map(|i| (i + 1..n).map(move |j| [i, j])).collect();
    let weights: Vec<f64> = pairs.iter().map(|&[i, j]| (masses[i] * masses[j]) as f64).collect();
    with_weights(&Graph::new(n, &pairs).expect("pairs, each once"), &weights)
}

/// A pencil with bases of its eigenspaces, as elimination gives them.
struct Expansion<'a> {
    name: String,
    pencil: &'a Pencil,
    spaces: Vec<(Rational, Vec<Vec<Rational>>)>,
}

impl<'a> Expansion<'a> {
    /// `None` where not all eigenvalues are rational. L has whole entries and M is diagonal with whole entries.
    fn of(pencil: &'a Pencil, name: String) -> Option<Self> {
        let n = pencil.size();
        let root = |i: usize| pencil.mass().at(i, i).approximate().sqrt();
        let places = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let entry = |(i, j): (usize, usize)| (i, j, pencil.stiffness().at(i, j).approximate() / (root(i) * root(j)));
        let (values, _) = symmetric_eigen(&Csr::from_triplets(n, n, &places.map(entry).collect::<Vec<_>>())).ok()?;
        let determinant = (0..n).fold(Rational::ONE, |product, i| product * pencil.mass().at(i, i).clone());
        let mut whole_values: Vec<i64> =
            values.iter().map(|v| (v * determinant.approximate()).round() as i64).collect();
        whole_values.dedup();
        let candidates = whole_values.into_iter().map(|p| (whole(p) / determinant.clone()).reduced());
        let spaces: Vec<_> = candidates.map(|t| (t.clone(), pencil.shifted(&t).kernel())).collect();
        let dimensions: usize = spaces.iter().map(|(_, basis)| basis.len()).sum();
        (dimensions == n).then_some(Expansion { name, pencil, spaces })
    }

    fn inner(&self, v: &[Rational], w: &[Rational]) -> Rational {
        let image = self.pencil.mass().mul(w);
        crate::scalar::sum(v.iter().zip(image).map(|(a, b)| a.clone() * b)).reduced()
    }

    fn not_orthogonal(&self) -> Option<Case> {
        for (k, (first, left)) in self.spaces.iter().enumerate() {
            for (second, right) in &self.spaces[..k] {
                for (v, w) in left.iter().flat_map(|v| right.iter().map(move |w| (v, w))) {
                    if self.inner(v, w) != Rational::ZERO {
                        let pair = format!("{} for {first} and {} for {second}", written(v), written(w));
                        return Some(Case::told(format!("{pair} are not orthogonal on {}", self.name)));
                    }
                }
            }
        }
        None
    }

    /// An M-orthogonal basis of each eigenspace (Gram and Schmidt, without norms).
    fn orthogonal(&self) -> Vec<(Rational, Vec<Rational>)> {
        let mut all = Vec::new();
        for (value, basis) in &self.spaces {
            let mut done: Vec<Vec<Rational>> = Vec::new();
            for v in basis {
                let mut rest = v.clone();
                for w in &done {
                    let factor = self.inner(v, w) / self.inner(w, w);
                    rest =
                        rest.iter().zip(w).map(|(r, w)| (r.clone() - factor.clone() * w.clone()).reduced()).collect();
                }
                done.push(rest);
            }
            all.extend(done.into_iter().map(|v| (value.clone(), v)));
        }
        all
    }

    /// `Σ f(λ) Mv vᵀM/(vᵀMv)` differs from a matrix.
    fn sum_is_not(&self, f: impl Fn(&Rational) -> Rational, expected: &Dense<Rational>) -> Option<[usize; 2]> {
        let n = self.pencil.size();
        let mut sum = Dense::from_fn(n, n, |_, _| Rational::ZERO);
        for (value, v) in self.orthogonal() {
            let image = self.pencil.mass().mul(&v);
            let factor = f(&value) / self.inner(&v, &v);
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                sum.add_to(i, j, factor.clone() * image[i].clone() * image[j].clone());
            }
        }
        (0..n).flat_map(|i| (0..n).map(move |j| [i, j])).find(|&[i, j]| sum.at(i, j) != expected.at(i, j))
    }

    fn not_parseval(&self) -> Option<Case> {
        let [i, j] = self.sum_is_not(|_| Rational::ONE, self.pencil.mass())?;
        Some(Case::told(format!("the products of e_{i} and e_{j} differ on {}", self.name)))
    }

    fn not_the_energy(&self) -> Option<Case> {
        let [i, j] = self.sum_is_not(Rational::clone, self.pencil.stiffness())?;
        Some(Case::told(format!("the energies of e_{i} and e_{j} differ on {}", self.name)))
    }
}

/// All matrices with row sums zero and the weights 1, 2, 3 in each direction between any two vertices, but the symmetric ones.
fn directed(n: usize) -> impl Iterator<Item = Dense<Rational>> {
    let matrix = move |weights: Vec<i64>| {
        let weight = |i: usize, j: usize| weights[i * (n - 1) + if j > i { j - 1 } else { j }];
        Dense::from_fn(n, n, |i, j| match i == j {
            true => whole((0..n).filter(|&k| k != i).map(|k| weight(i, k)).sum()),
            false => whole(-weight(i, j)),
        })
    };
    choices(n * (n - 1), &[1, 2, 3]).into_iter().map(matrix).filter(|l| l.asymmetry().is_some())
}

/// The matrix with the statement that it is not symmetric.
fn asymmetry(l: &Dense<Rational>) -> Option<Evidence> {
    let n = l.rows();
    let [i, j] = l.asymmetry()?;
    let pairs: Vec<[usize; 2]> = (0..n).flat_map(|i| (i + 1..n).map(move |j| [i, j])).collect();
    let graph = Graph::new(n, &pairs).ok()?;
    Some(on_graph(Statement::Asymmetry { i, j, threshold: 0.0 }, &graph, l, &[i, j]))
}

/// The eigenvectors of a matrix with n different whole eigenvalues.
fn simple_eigenvectors(l: &Dense<Rational>) -> Option<Vec<(i64, Vec<Rational>)>> {
    let n = l.rows();
    // Gershgorin: with row sums zero every eigenvalue is within twice the largest diagonal entry.
    let largest = (0..n).map(|i| l.at(i, i).approximate()).fold(0.0, f64::max);
    let shifted =
        |t: i64| Dense::from_fn(n, n, |i, j| if i == j { l.at(i, j).clone() - whole(t) } else { l.at(i, j).clone() });
    let found: Vec<_> =
        (0..=2 * largest as i64).filter_map(|t| shifted(t).kernel().into_iter().next().map(|v| (t, v))).collect();
    (found.len() == n).then_some(found)
}

/// A basis of eigenvectors that are not orthogonal for any positive diagonal mass: the conditions `Σ m_i v_i w_i = 0` on m have the solution 0
/// alone, or one up to multiples that is not positive.
fn no_mass(l: &Dense<Rational>) -> Option<Case> {
    let vectors = simple_eigenvectors(l)?;
    let n = l.rows();
    let pairs: Vec<(usize, usize)> = (0..n).flat_map(|a| (0..a).map(move |b| (a, b))).collect();
    let conditions = Dense::from_fn(pairs.len(), n, |row, i| {
        vectors[pairs[row].0].1[i].clone() * vectors[pairs[row].1].1[i].clone()
    });
    let possible = match conditions.kernel().as_slice() {
        [] => false,
        [m] => [Ordering::Less, Ordering::Greater].iter().any(|sign| m.iter().all(|x| x.cmp_zero() == *sign)),
        _ => return None,
    };
    let spoken: Vec<String> = vectors.iter().map(|(t, v)| format!("{} for {t}", written(v))).collect();
    let text = format!("{} with the eigenvectors {}", matrix_in_words(l), spoken.join(", "));
    (!possible).then(|| asymmetry(l).map_or(Case::told(text.clone()), |witness| Case::shown(text, witness)))
}

fn no_basis(l: &Dense<Rational>) -> Option<Case> {
    let text = matrix_in_words(l);
    (!has_basis(l)).then(|| asymmetry(l).map_or(Case::told(text.clone()), |witness| Case::shown(text, witness)))
}

fn matrix_in_words(l: &Dense<Rational>) -> String {
    let row = |i: usize| (0..l.columns()).map(|j| l.at(i, j).to_string()).collect::<Vec<_>>().join(" ");
    format!("[{}]", (0..l.rows()).map(row).collect::<Vec<_>>().join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix<const N: usize>(rows: [[i64; N]; N]) -> Dense<Rational> {
        Dense::from_fn(N, N, |i, j| whole(rows[i][j]))
    }

    fn star() -> Pencil {
        let star = Graph::new(4, &[[0, 1], [0, 2], [0, 3]]).unwrap();
        pencil(laplacian(&star), &[1, 1, 1, 1]).unwrap()
    }

    #[test]
    fn the_graphs_with_whole_eigenvalues_are_as_many_as_the_encyclopedia_of_integer_sequences_says() {
        // A363065.
        for (n, expected) in [(1, 1), (2, 2), (3, 4), (4, 10), (5, 24), (6, 70)] {
            let graphs = super::super::world::graphs::graphs(n);
            let whole_ones = graphs.iter().filter(|g| {
                let pencil = pencil(laplacian(g), &vec![1; n]).unwrap();
                Expansion::of(&pencil, String::new()).is_some()
            });
            assert_eq!(whole_ones.count(), expected, "{n}");
        }
    }

    #[test]
    fn an_eigenvector_left_out_doubled_or_of_another_mass_breaks_parseval_and_energy() {
        let pencil = star();
        let right = || Expansion::of(&pencil, String::new()).unwrap();
        assert!(
            right().not_orthogonal().is_none()
                && right().not_parseval().is_none()
                && right().not_the_energy().is_none()
        );
        assert_eq!(
            right().spaces.iter().map(|(t, b)| (t.clone(), b.len())).collect::<Vec<_>>(),
            [(whole(0), 1), (whole(1), 2), (whole(4), 1)]
        );
        for space in 0..3 {
            let mut less = right();
            less.spaces[space].1.pop();
            assert!(less.not_parseval().is_some(), "{space}");
            // Nothing is missing of the energy where the eigenvalue is 0.
            assert_eq!(less.not_the_energy().is_some(), space > 0);
        }
        let mut twice = right();
        let last = twice.spaces[2].clone();
        twice.spaces.push(last);
        assert!(twice.not_parseval().is_some() && twice.not_orthogonal().is_some());
        let other = pencil_of_other_mass();
        let mixed = Expansion { name: String::new(), pencil: &other, spaces: right().spaces };
        assert!(mixed.not_orthogonal().is_some() && mixed.not_parseval().is_some());
        let mut wrong = right();
        wrong.spaces[1].0 = whole(2);
        assert!(wrong.not_the_energy().is_some() && wrong.not_parseval().is_none());
    }

    fn pencil_of_other_mass() -> Pencil {
        Pencil::new(star().stiffness().clone(), matrix([[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]))
            .unwrap()
    }

    #[test]
    fn an_operator_that_a_mass_makes_symmetric_is_no_instance() {
        // diag(1, ½, ⅓) S for a symmetric S has the mass (1, 2, 3).
        let walk = matrix([[12, -6, -6], [-3, 9, -6], [-2, -4, 6]]);
        assert!(super::super::world::stage::vanishes(&walk.mul(&[1, 1, 1].map(whole))));
        assert!(no_mass(&walk).is_none() && no_basis(&walk).is_none());
        let turning = matrix([[1, -1, 0], [0, 1, -1], [-1, 0, 1]]);
        assert!(no_basis(&turning).is_none(), "complex eigenvalues, a basis all the same");
        let first = directed(3).find_map(|l| no_mass(&l)).unwrap();
        assert!(matches!(first.evidence[0].statement, Statement::Asymmetry { .. }));
        assert!(directed(3).find_map(|l| no_basis(&l)).is_some());
    }
}
