//! Small simplicial complexes, closed and with boundary, with random inner products on their cochains.

use crate::domain::Graph;
use crate::experiment::calculus::{ratio, whole};
use crate::experiment::world::graphs::with_weights;
use crate::experiment::world::stage::Stage;
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::scalar::{Rational, Scalar};

/// A simplicial complex: its simplices by dimension, each with ascending corners, in lexicographic order.
pub struct Complex {
    /// What it is.
    pub name: &'static str,
    simplices: Vec<Vec<Vec<usize>>>,
}

impl Complex {
    /// The complex of these simplices of the largest dimension and all of their faces.
    pub fn new(name: &'static str, top: Vec<Vec<usize>>) -> Self {
        let sorted = |mut simplex: Vec<usize>| {
            simplex.sort_unstable();
            simplex
        };
        let mut level: Vec<Vec<usize>> = top.into_iter().map(sorted).collect();
        let mut simplices = Vec::new();
        while level.first().is_some_and(|s| !s.is_empty()) {
            level.sort();
            level.dedup();
            let faces = level.iter().flat_map(|s| (0..s.len()).map(|left_out| without(s, left_out))).collect();
            simplices.push(std::mem::replace(&mut level, faces));
        }
        simplices.reverse();
        Complex { name, simplices }
    }

    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.simplices.len() - 1
    }

    /// How many simplices of dimension k there are.
    pub fn count(&self, k: usize) -> usize {
        self.simplices.get(k).map_or(0, Vec::len)
    }

    /// The derivative of k-cochains, by Stokes: the sum over the boundary with its signs.
    pub fn derivative(&self, k: usize) -> Dense<Rational> {
        let empty = Vec::new();
        let (rows, columns) = (self.simplices.get(k + 1).unwrap_or(&empty), self.simplices.get(k).unwrap_or(&empty));
        Dense::from_fn(rows.len(), columns.len(), |i, j| {
            let place = (0..rows[i].len()).find(|&left_out| without(&rows[i], left_out) == columns[j]);
            whole(place.map_or(0, |p| if p % 2 == 0 { 1 } else { -1 }))
        })
    }

    /// Degree k with these inner products, one for each degree.
    pub fn stage(&self, k: usize, inner: &[Dense<Rational>]) -> Option<Stage> {
        let none = Dense::from_fn(0, 0, |_, _| Rational::ZERO);
        let before = match k.checked_sub(1) {
            Some(below) => self.derivative(below),
            None => Dense::from_fn(self.count(0), 0, |_, _| Rational::ZERO),
        };
        let below = k.checked_sub(1).map_or(&none, |below| &inner[below]);
        let name = format!("degree {k} on {}", self.name);
        Stage::new(name, before, self.derivative(k), [below, &inner[k], inner.get(k + 1).unwrap_or(&none)])
    }

    /// Random positive diagonal inner products, multiples of 1/16 up to 2.
    pub fn diagonal(&self, stream: &mut Stream) -> Vec<Dense<Rational>> {
        let draw = |n: usize, stream: &mut Stream| {
            let d: Vec<Rational> = (0..n).map(|_| ratio(1 + stream.below(32) as i64, 16)).collect();
            Dense::from_fn(n, n, |i, j| if i == j { d[i].clone() } else { Rational::ZERO })
        };
        self.simplices.iter().map(|s| draw(s.len(), stream)).collect()
    }

    /// Random positive definite inner products with entries between all simplices: diagonal ones and a square `vvᵀ`.
    pub fn full(&self, stream: &mut Stream) -> Vec<Dense<Rational>> {
        let with_square = |d: Dense<Rational>, stream: &mut Stream| {
            let v: Vec<Rational> = (0..d.rows()).map(|_| whole(stream.below(5) as i64 - 2)).collect();
            Dense::from_fn(d.rows(), d.rows(), |i, j| (d.at(i, j).clone() + v[i].clone() * v[j].clone()).reduced())
        };
        self.diagonal(stream).into_iter().map(|d| with_square(d, stream)).collect()
    }

    /// Vertices and edges as a graph, weighted by a diagonal inner product of 1-cochains.
    pub fn graph(&self, inner: &Dense<Rational>) -> Option<Graph> {
        let edges: Vec<[usize; 2]> = self.simplices.get(1)?.iter().map(|s| [s[0], s[1]]).collect();
        let weights: Vec<f64> = (0..edges.len()).map(|k| inner.at(k, k).approximate()).collect();
        Graph::new(self.count(0), &edges).ok().map(|graph| with_weights(&graph, &weights))
    }
}

fn without(simplex: &[usize], left_out: usize) -> Vec<usize> {
    simplex.iter().enumerate().filter(|(k, _)| *k != left_out).map(|(_, v)| *v).collect()
}

/// Closed manifolds of one to three dimensions: circle, two circles, sphere twice, torus (Möbius 1861), projective plane, 3-sphere.
pub fn closed() -> Vec<Complex> {
    let all_but_one = |n: usize| (0..n).map(move |k| (0..n).filter(|&v| v != k).collect::<Vec<usize>>()).collect();
    let lists = |faces: &[[usize; 3]]| faces.iter().map(|f| f.to_vec()).collect::<Vec<_>>();
    let ring = |from: usize, n: usize| (0..n).map(move |k| vec![from + k, from + (k + 1) % n]);
    let octahedron = (0..8).map(|code| (0..3).map(|axis| 2 * axis + (code >> axis & 1)).collect()).collect();
    let torus = (0..7).flat_map(|i| [vec![i, (i + 1) % 7, (i + 3) % 7], vec![i, (i + 2) % 7, (i + 3) % 7]]).collect();
    let projective =
        [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 1, 5], [1, 2, 4], [2, 3, 5], [1, 3, 4], [2, 4, 5], [1, 3, 5]];
    vec![
        Complex::new("a circle", ring(0, 4).collect()),
        Complex::new("two circles", ring(0, 3).chain(ring(3, 3)).collect()),
        Complex::new("the surface of a tetrahedron", all_but_one(4)),
        Complex::new("the surface of an octahedron", octahedron),
        Complex::new("the torus with seven vertices", torus),
        Complex::new("the projective plane with six vertices", lists(&projective)),
        Complex::new("the surface of a 4-simplex", all_but_one(5)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_complexes_are_closed_manifolds_with_the_betti_numbers_of_the_textbook() {
        let betti: [&[usize]; 7] = [&[1, 1], &[2, 2], &[1, 0, 1], &[1, 0, 1], &[1, 2, 1], &[1, 0, 0], &[1, 0, 0, 1]];
        let counts: [&[usize]; 7] =
            [&[4, 4], &[6, 6], &[4, 6, 4], &[6, 12, 8], &[7, 21, 14], &[6, 15, 10], &[5, 10, 10, 5]];
        for ((complex, betti), counts) in closed().iter().zip(betti).zip(counts) {
            let dimension = complex.dimension();
            assert_eq!((0..=dimension).map(|k| complex.count(k)).collect::<Vec<_>>(), counts, "{}", complex.name);
            // Every simplex of the dimension below has two beside it.
            let d = complex.derivative(dimension - 1);
            let beside = |j: usize| (0..d.rows()).filter(|&i| *d.at(i, j) != Rational::ZERO).count();
            assert!((0..d.columns()).all(|j| beside(j) == 2), "{}", complex.name);
            let inner = complex.diagonal(&mut Stream::new(1, "masses"));
            let found = |k| complex.stage(k, &inner).unwrap().cohomology().unwrap();
            assert_eq!((0..=dimension).map(found).collect::<Vec<_>>(), betti, "{}", complex.name);
        }
    }

    #[test]
    fn the_derivative_twice_is_zero_and_the_full_inner_products_are_definite() {
        for complex in closed() {
            for k in 0..complex.dimension() {
                let twice = complex.derivative(k + 1).product(&complex.derivative(k));
                assert!((0..twice.rows()).all(|i| (0..twice.columns()).all(|j| *twice.at(i, j) == Rational::ZERO)));
            }
            let full = complex.full(&mut Stream::new(2, "masses"));
            assert!(full.iter().all(|g| g.asymmetry().is_none() && g.eliminate().is_definite()));
        }
    }
}
