//! One degree of a complex of finite dimension: `A → B → C` with inner products on all three.
//!
//! # Definition
//! With the derivatives `p: A → B` and `q: B → C`, `q p = 0`, and the inner products `xᵀ G y`:
//!
//! ```text
//! p* = G_A⁻¹ pᵀ G_B,    q* = G_B⁻¹ qᵀ G_C,    Δ = p p* + q* q    on B
//! ```
//! A Fourier mode of forms on a flat torus is one, and so are the k-cochains of a triangulation with any masses.

use crate::experiment::poll::Case;
use crate::linalg::Dense;
use crate::scalar::{Rational, Scalar};

/// The two derivatives and their adjoints.
pub struct Stage {
    /// What it is, in words.
    pub name: String,
    before: Dense<Rational>,
    after: Dense<Rational>,
    before_adjoint: Dense<Rational>,
    after_adjoint: Dense<Rational>,
    inner: Dense<Rational>,
}

impl Stage {
    /// From the derivatives p and q and the inner products of A, B and C; `None` where one of these is singular.
    pub fn new(
        name: String,
        before: Dense<Rational>,
        after: Dense<Rational>,
        inner: [&Dense<Rational>; 3],
    ) -> Option<Self> {
        let [a, b, c] = inner;
        let before_adjoint = a.solve(&before.transpose().product(b))?;
        let after_adjoint = b.solve(&after.transpose().product(c))?;
        Some(Stage { name, before, after, before_adjoint, after_adjoint, inner: b.clone() })
    }

    /// The dimension of B.
    pub fn size(&self) -> usize {
        self.inner.rows()
    }

    /// `p*`.
    pub fn before_adjoint(&self) -> &Dense<Rational> {
        &self.before_adjoint
    }

    /// `p p* + q* q`.
    pub fn laplacian(&self) -> Dense<Rational> {
        let (first, second) = (self.before.product(&self.before_adjoint), self.after_adjoint.product(&self.after));
        Dense::from_fn(self.size(), self.size(), |i, j| (first.at(i, j).clone() + second.at(i, j).clone()).reduced())
    }

    /// `dim ker q − rank p`: the dimension of the cohomology, from the derivatives alone.
    pub fn cohomology(&self) -> Option<usize> {
        (self.size() - self.after.rank()).checked_sub(self.before.rank())
    }

    /// A harmonic vector that is not closed or not co-closed, or vectors that are both and not harmonic.
    ///
    /// The kernel of Δ is compared with that of q over p*, which needs no product.
    pub fn harmonic_and_not_both(&self) -> Option<Case> {
        let harmonic = self.laplacian().kernel();
        for x in &harmonic {
            for (name, image) in [("q", self.after.mul(x)), ("p*", self.before_adjoint.mul(x))] {
                if !vanishes(&image) {
                    return Some(Case::told(format!("{}: Δx = 0 and {name}x ≠ 0 for x = {}", self.name, written(x))));
                }
            }
        }
        let both = stacked(&self.after, &self.before_adjoint).kernel().len();
        let text = || format!("{}: {} harmonic and {both} closed and co-closed dimensions", self.name, harmonic.len());
        (both != harmonic.len()).then(|| Case::told(text()))
    }

    /// A harmonic space that is not as large as the cohomology.
    pub fn harmonic_is_not_cohomology(&self) -> Option<Case> {
        let (found, expected) = (self.laplacian().kernel().len(), self.cohomology());
        let text = || format!("{}: {found} harmonic dimensions, cohomology {expected:?}", self.name);
        (Some(found) != expected).then(|| Case::told(text()))
    }

    /// Bases of the images of p and of q*, and of the kernel of Δ, as columns.
    pub fn parts(&self) -> [Dense<Rational>; 3] {
        let (kernel, n) = (self.laplacian().kernel(), self.size());
        let harmonic = Dense::from_fn(n, kernel.len(), |i, j| kernel[j][i].clone());
        [independent(&self.before), independent(&self.after_adjoint), harmonic]
    }

    /// The three parts together do not span B.
    pub fn parts_do_not_span(&self, parts: &[Dense<Rational>; 3]) -> Option<Case> {
        let rank = beside(parts).rank();
        let text = || format!("{}: the parts span {rank} of {} dimensions", self.name, self.size());
        (rank != self.size()).then(|| Case::told(text()))
    }

    /// Two of the parts are not orthogonal.
    pub fn parts_not_orthogonal(&self, parts: &[Dense<Rational>; 3]) -> Option<Case> {
        let names = ["exact", "co-exact", "harmonic"];
        let pairs = [(0, 1), (0, 2), (1, 2)].into_iter();
        let product = |(a, b): (usize, usize)| parts[a].transpose().product(&self.inner.product(&parts[b]));
        let zero = |m: &Dense<Rational>| (0..m.rows()).all(|i| (0..m.columns()).all(|j| *m.at(i, j) == Rational::ZERO));
        let (a, b) = pairs.into_iter().find(|&pair| !zero(&product(pair)))?;
        Some(Case::told(format!("{}: the {} and the {} part are not orthogonal", self.name, names[a], names[b])))
    }

    /// A vector is a sum of parts in two ways: a combination of the bases of the parts is zero.
    pub fn parts_not_unique(&self, parts: &[Dense<Rational>; 3]) -> Option<Case> {
        let kernel = beside(parts).kernel();
        let first = kernel.first()?;
        Some(Case::told(format!("{}: the combination {} of the parts is zero", self.name, written(first))))
    }

    /// A potential that is not zero with p x = 0, or with q* y = 0.
    pub fn ambiguous_potential(&self) -> Option<Vec<Rational>> {
        let kernels = [&self.before, &self.after_adjoint].into_iter().map(Dense::kernel);
        kernels.into_iter().flatten().next()
    }

    /// Potentials `p* ν` with one image under p, or `q λ` with one image under q*, are not equal.
    pub fn ambiguous_in_the_gauge(&self) -> Option<Case> {
        let pairs = [("p*", &self.before, &self.before_adjoint), ("q", &self.after_adjoint, &self.after)];
        let lost = |(_, outer, inner): &(&str, &Dense<Rational>, &Dense<Rational>)| {
            outer.product(inner).rank() != inner.rank()
        };
        let (name, ..) = pairs.into_iter().find(lost)?;
        Some(Case::told(format!("{}: two potentials in the image of {name} have one derivative", self.name)))
    }
}

/// Whether every component is zero.
pub fn vanishes(x: &[Rational]) -> bool {
    x.iter().all(|v| *v == Rational::ZERO)
}

/// A vector in words.
pub fn written(x: &[Rational]) -> String {
    let parts: Vec<String> = x.iter().map(|v| v.clone().reduced().to_string()).collect();
    format!("({})", parts.join(", "))
}

/// One matrix above another.
fn stacked(top: &Dense<Rational>, bottom: &Dense<Rational>) -> Dense<Rational> {
    let rows = top.rows();
    Dense::from_fn(rows + bottom.rows(), top.columns(), |i, j| {
        if i < rows { top.at(i, j).clone() } else { bottom.at(i - rows, j).clone() }
    })
}

/// Matrices side by side.
fn beside(parts: &[Dense<Rational>; 3]) -> Dense<Rational> {
    let columns: Vec<(usize, usize)> =
        parts.iter().enumerate().flat_map(|(k, p)| (0..p.columns()).map(move |j| (k, j))).collect();
    Dense::from_fn(parts[0].rows(), columns.len(), |i, j| parts[columns[j].0].at(i, columns[j].1).clone())
}

/// Columns of a matrix that span its image and are independent: the first ones that raise the rank.
fn independent(a: &Dense<Rational>) -> Dense<Rational> {
    let rows: Vec<usize> = (0..a.rows()).collect();
    let mut chosen: Vec<usize> = Vec::new();
    let rank = a.rank();
    for j in 0..a.columns() {
        if chosen.len() == rank {
            break;
        }
        let longer = [chosen.as_slice(), &[j]].concat();
        if a.submatrix(&rows, &longer).rank() == longer.len() {
            chosen = longer;
        }
    }
    a.submatrix(&rows, &chosen)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::calculus::whole;

    fn matrix<const M: usize, const N: usize>(rows: [[i64; N]; M]) -> Dense<Rational> {
        Dense::from_fn(M, N, |i, j| whole(rows[i][j]))
    }

    fn unit(n: usize) -> Dense<Rational> {
        Dense::from_fn(n, n, |i, j| whole(i64::from(i == j)))
    }

    /// The circle of three edges: q = 0.
    fn circle() -> Stage {
        let d = matrix([[-1, 1, 0], [0, -1, 1], [-1, 0, 1]]);
        let mass = matrix([[2, 1, 0], [1, 2, 0], [0, 0, 3]]);
        Stage::new("circle".into(), d, Dense::from_fn(0, 3, |_, _| whole(0)), [&unit(3), &mass, &unit(0)]).unwrap()
    }

    #[test]
    fn the_circle_has_one_harmonic_form_and_an_orthogonal_decomposition() {
        let (stage, parts) = (circle(), circle().parts());
        assert_eq!((stage.cohomology(), stage.laplacian().kernel().len()), (Some(1), 1));
        assert_eq!([0, 1, 2].map(|k| parts[k].columns()), [2, 0, 1]);
        assert!(stage.harmonic_and_not_both().is_none() && stage.harmonic_is_not_cohomology().is_none());
        assert!(stage.parts_do_not_span(&parts).is_none() && stage.parts_not_orthogonal(&parts).is_none());
        assert!(stage.parts_not_unique(&parts).is_none() && stage.ambiguous_in_the_gauge().is_none());
        assert_eq!(stage.ambiguous_potential(), Some(vec![whole(1); 3]), "the constants");
    }

    #[test]
    fn indefinite_inner_products_break_every_statement_somewhere() {
        let none = |n: usize| Dense::from_fn(0, n, |_, _| whole(0));
        let signs = matrix([[1, 0], [0, -1]]);
        // On B: p = (1, 1) is orthogonal to itself, exact and harmonic at once.
        let on_b =
            |g: &Dense<Rational>| Stage::new("B".into(), matrix([[1], [1]]), none(2), [&unit(1), g, &unit(0)]).unwrap();
        let [wrong, right] =
            [on_b(&signs), on_b(&unit(2))].map(|s| (s.parts_not_unique(&s.parts()), s.parts_do_not_span(&s.parts())));
        assert!(wrong.0.is_some() && wrong.1.is_some() && right.0.is_none() && right.1.is_none());
        // On A: p p* = 0 although p* is not.
        let on_a =
            |g: &Dense<Rational>| Stage::new("A".into(), matrix([[1, 1]]), none(1), [g, &unit(1), &unit(0)]).unwrap();
        let (wrong, right) = (on_a(&signs), on_a(&unit(2)));
        assert!(wrong.harmonic_and_not_both().is_some() && right.harmonic_and_not_both().is_none());
        assert!(wrong.harmonic_is_not_cohomology().is_some() && right.harmonic_is_not_cohomology().is_none());
        assert!(wrong.ambiguous_in_the_gauge().is_some() && right.ambiguous_in_the_gauge().is_none());
    }

    #[test]
    fn a_part_left_out_does_not_span_and_another_inner_product_is_not_orthogonal() {
        let [exact, coexact, _] = circle().parts();
        let none = Dense::from_fn(3, 0, |_, _| whole(0));
        assert!(circle().parts_do_not_span(&[exact.clone(), coexact, none.clone()]).is_some());
        let tilted = matrix([[1], [1], [0]]);
        assert!(circle().parts_not_orthogonal(&[exact, none, tilted]).is_some());
    }
}
