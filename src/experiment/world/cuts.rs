//! Connected graphs with exact matrices, their cuts of the smallest ratio over all partitions, and exact bounds of λ̃₁.
//!
//! The volume of a side is the sum of degrees (Chung), or the weights inside, each edge counted twice (the primer).

use std::cmp::Ordering;

use super::graphs::laplacian;
use crate::domain::Graph;
use crate::linalg::Dense;
use crate::linalg::pencil::Pencil;
use crate::scalar::{Rational, Scalar};

/// A connected graph with its exact matrices and both constants.
pub struct Specimen {
    /// The graph.
    pub graph: Graph,
    /// Its Laplacian, with the degrees as mass.
    pub pencil: Pencil,
    /// Its degrees: the sums of the weights at a vertex.
    pub degrees: Vec<Rational>,
    /// The primer's constant; `None` where every partition has a side without an edge inside.
    pub printed: Option<Cut>,
    /// Chung's constant.
    pub chung: Cut,
}

/// The smallest ratio over all partitions, and a partition that attains it.
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// The weight between the sides over the smaller volume.
    pub ratio: Rational,
    /// The vertices of one side.
    pub side: Vec<usize>,
}

impl Specimen {
    /// The graph's matrices and constants; `None` for a graph that no partition cuts: less than two vertices, or no edge.
    pub fn of(graph: Graph) -> Option<Self> {
        let stiffness = laplacian(&graph);
        let degrees: Vec<Rational> = (0..stiffness.rows()).map(|i| stiffness.at(i, i).clone()).collect();
        let (printed, chung) = constants(&stiffness, &degrees);
        let zero = Rational::ZERO;
        let mass =
            Dense::from_fn(degrees.len(), degrees.len(), |i, j| if i == j { degrees[i].clone() } else { zero.clone() });
        Some(Specimen { graph, pencil: Pencil::new(stiffness, mass)?, degrees, printed, chung: chung? })
    }

    /// Eigenvalues of the pencil (L, D) below t, and equal to t.
    pub fn eigenvalues_below(&self, t: &Rational) -> (usize, usize) {
        let inertia = self.pencil.inertia(t);
        (inertia.negative, inertia.zero)
    }

    /// Whether `t ≤ λ̃₁`: below a positive t lies the zero eigenvalue alone.
    pub fn is_lower_bound(&self, t: &Rational) -> bool {
        self.eigenvalues_below(t).0 <= 1
    }

    /// Whether `λ̃₁ ≤ t`.
    pub fn is_upper_bound(&self, t: &Rational) -> bool {
        let (below, equal) = self.eigenvalues_below(t);
        below + equal >= 2
    }

    /// A vector with `xᵀLx < t (xᵀDx − (1ᵀDx)²/1ᵀD1)`: negative directions of `L − tD + t D11ᵀD/1ᵀD1`, which is L itself on
    /// constants.
    pub fn slow_vector(&self, t: &Rational) -> Option<Vec<(usize, f64)>> {
        let n = self.degrees.len();
        let total = self.degrees.iter().fold(Rational::zero(), |sum, d| sum + d.clone());
        let form = Dense::from_fn(n, n, |i, j| {
            let d = |k: usize| self.degrees[k].clone();
            let diagonal = if i == j { t.clone() * d(i) } else { Rational::zero() };
            (self.pencil.stiffness().at(i, j).clone() - diagonal + t.clone() * d(i) * d(j) / total.clone()).reduced()
        });
        let x = form.eliminate().negative_direction()?;
        let rounded: Vec<f64> = x.iter().map(Scalar::approximate).collect();
        let exact: Vec<Rational> = rounded.iter().map(|v| Rational::exactly(*v)).collect::<Option<_>>()?;
        let still = form.quadratic_form(&exact).cmp_zero() == Ordering::Less;
        still.then(|| rounded.into_iter().enumerate().filter(|(_, v)| *v != 0.0).collect())
    }
}

/// Both constants over all partitions, vertex 0 on the first side; the partitions in the order of the Gray code, each from the
/// last by one vertex that changes sides. `None` where no partition has a finite ratio.
pub fn constants(l: &Dense<Rational>, degrees: &[Rational]) -> (Option<Cut>, Option<Cut>) {
    let n = degrees.len();
    let total = degrees.iter().fold(Rational::zero(), |sum, d| sum + d.clone());
    let (mut printed, mut chung): (Option<Cut>, Option<Cut>) = (None, None);
    let mut other = vec![false; n];
    let (mut cut, mut volume) = (Rational::zero(), Rational::zero());
    for code in 1..1_usize << n.saturating_sub(1) {
        let v = 1 + code.trailing_zeros() as usize;
        other[v] = !other[v];
        // Entries of L are −ω: the edges between v and its new side leave the cut, those to its old side enter it.
        let between = (0..n).filter(|&j| j != v).fold(Rational::zero(), |sum, j| {
            if other[j] == other[v] { sum + l.at(v, j).clone() } else { sum - l.at(v, j).clone() }
        });
        cut = (cut + between).reduced();
        let degree = degrees[v].clone();
        volume = (if other[v] { volume + degree } else { volume - degree }).reduced();
        let rest = total.clone() - volume.clone();
        let smaller = if volume < rest { volume.clone() } else { rest };
        let side = || (0..n).filter(|&i| other[i]).collect::<Vec<usize>>();
        for (best, of) in [(&mut printed, smaller.clone() - cut.clone()), (&mut chung, smaller)] {
            if of.cmp_zero() != Ordering::Greater {
                continue;
            }
            let ratio = (cut.clone() / of).reduced();
            if best.as_ref().is_none_or(|b| ratio < b.ratio) {
                *best = Some(Cut { ratio, side: side() });
            }
        }
    }
    (printed, chung)
}

/// `x²/2`.
pub fn half_square(x: &Rational) -> Rational {
    (x.clone() * x.clone() * Rational::half()).reduced()
}

/// `2x`.
pub fn double(x: &Rational) -> Rational {
    x.clone() + x.clone()
}

/// `x/(1 + x)`: Chung's constant from the printed one.
pub fn related(printed: &Rational) -> Rational {
    (printed.clone() / (Rational::ONE + printed.clone())).reduced()
}

#[cfg(test)]
mod tests {
    use super::super::graphs::{component_count, graphs};
    use super::*;
    use crate::linalg::Csr;
    use crate::linalg::factor::symmetric_eigen;

    fn specimen(n: usize, edges: &[[usize; 2]]) -> Specimen {
        Specimen::of(Graph::new(n, edges).unwrap()).unwrap()
    }

    fn ratio(p: i32, q: i32) -> Rational {
        Rational::from(p) / Rational::from(q)
    }

    #[test]
    fn the_path_of_four_is_cut_in_the_middle() {
        // One edge cut; inside either half one edge, counted twice: 1/2. Degrees 1 + 2: 1/3.
        let path = specimen(4, &[[0, 1], [1, 2], [2, 3]]);
        let printed = path.printed.clone().unwrap();
        assert_eq!((printed.ratio, path.chung.ratio.clone()), (ratio(1, 2), ratio(1, 3)));
        assert!(printed.side == [2, 3] || printed.side == [0, 1]);
    }

    #[test]
    fn a_star_has_no_finite_printed_constant() {
        assert!(specimen(4, &[[0, 1], [0, 2], [0, 3]]).printed.is_none());
    }

    #[test]
    fn the_bounds_agree_with_eigenvalues_in_floating_point() {
        for n in 2..=5 {
            for graph in graphs(n).into_iter().filter(|g| component_count(g) == 1) {
                let s = Specimen::of(graph).unwrap();
                let d: Vec<f64> = s.degrees.iter().map(|d| d.approximate()).collect();
                let entries: Vec<_> = (0..n * n)
                    .map(|k| {
                        (
                            k / n,
                            k % n,
                            s.pencil.stiffness().at(k / n, k % n).approximate() / (d[k / n] * d[k % n]).sqrt(),
                        )
                    })
                    .collect();
                let lambda = symmetric_eigen(&Csr::from_triplets(n, n, &entries)).unwrap().0[1];
                for k in 1..40 {
                    let t = f64::from(k) / 19.0;
                    if (t - lambda).abs() > 1e-9 {
                        let exact = Rational::exactly(t).unwrap();
                        assert_eq!(s.is_lower_bound(&exact), t < lambda, "{t} {lambda}");
                        assert_eq!(s.is_upper_bound(&exact), t > lambda, "{t} {lambda}");
                    }
                }
            }
        }
    }

    #[test]
    fn every_partition_is_seen_by_the_gray_code() {
        // Against the subsets themselves.
        let s = specimen(5, &[[0, 1], [1, 2], [2, 3], [3, 4], [4, 0], [0, 2]]);
        let weight = |a: usize, b: usize| 0.0 - s.pencil.stiffness().at(a, b).approximate();
        let mut best = f64::INFINITY;
        for mask in 1..31_usize {
            let inside = |v: usize| mask >> v & 1 == 1;
            let pairs = (0..5).flat_map(|a| (0..5).map(move |b| (a, b))).filter(|(a, b)| a != b);
            let sum = |f: &dyn Fn(usize, usize) -> bool| {
                pairs.clone().filter(|&(a, b)| f(a, b)).map(|(a, b)| weight(a, b)).sum::<f64>()
            };
            let cut = sum(&|a, b| inside(a) && !inside(b));
            let smaller = sum(&|a, b| inside(a) && inside(b)).min(sum(&|a, b| !inside(a) && !inside(b)));
            if smaller > 0.0 {
                best = best.min(cut / smaller);
            }
        }
        let found = s.printed.unwrap();
        assert!((found.ratio.approximate() - best).abs() < 1e-15, "{} {best} {:?}", found.ratio, found.side);
    }

    #[test]
    fn a_bound_that_is_too_high_is_found_out_with_a_vector() {
        let path = specimen(4, &[[0, 1], [1, 2], [2, 3]]);
        // λ̃₁ of the path of four is ½.
        assert!(path.is_lower_bound(&ratio(1, 2)) && !path.is_lower_bound(&ratio(51, 100)));
        assert!(path.slow_vector(&ratio(51, 100)).is_some() && path.slow_vector(&ratio(49, 100)).is_none());
    }
}
