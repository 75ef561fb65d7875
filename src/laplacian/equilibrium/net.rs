//! The edges that carry weights, and the equations at the free vertices.

use std::cmp::Ordering;

use crate::domain::Surface;
use crate::linalg::Csr;
use crate::linalg::program::Split;
use crate::scalar::{Rational, Scalar};

/// Edges with their vectors, of which some vertices are free and the others held.
#[derive(Clone, Debug)]
pub struct Net {
    vertices: usize,
    /// The number of each free vertex among the free ones.
    place: Vec<Option<usize>>,
    free: usize,
    edges: Vec<[usize; 2]>,
    vectors: Vec<[Rational; 2]>,
}

impl Net {
    /// The constrained edges of a planar triangulation, in the order of its edges. `None` unless it is planar and made of
    /// triangles, with at most two at an edge.
    pub fn of(surface: &Surface) -> Option<Self> {
        let positions = surface.planar_positions::<Rational>()?;
        let topology = surface.topology();
        if !surface.is_triangulated() || !topology.non_manifold_edges().is_empty() {
            return None;
        }
        let boundary = topology.boundary_vertices();
        let held = |e: &&[usize; 2]| !(boundary[e[0]] && boundary[e[1]]);
        let edges: Vec<[usize; 2]> = topology.edges().iter().filter(held).copied().collect();
        let vector =
            |&[i, j]: &[usize; 2]| std::array::from_fn(|axis| positions[i][axis].clone() - positions[j][axis].clone());
        let vectors = edges.iter().map(vector).collect();
        Some(Net::new(boundary, edges, vectors))
    }

    /// From vertices that are held, edges, and for each edge `[i, j]` the vector `x_i − x_j` (on a torus, along the edge).
    pub fn new(held: &[bool], edges: Vec<[usize; 2]>, vectors: Vec<[Rational; 2]>) -> Self {
        let mut touched = vec![false; held.len()];
        edges.iter().flatten().for_each(|&v| touched[v] = true);
        let mut free = 0;
        let place = (0..held.len())
            .map(|v| {
                (touched[v] && !held[v]).then(|| {
                    free += 1;
                    free - 1
                })
            })
            .collect();
        Net { vertices: held.len(), place, free, edges, vectors }
    }

    /// The constrained edges.
    pub fn edges(&self) -> &[[usize; 2]] {
        &self.edges
    }

    /// `(row, column, value)` of the equations, two for each free vertex: `Σ_j ω_ij (x_i − x_j) = 0`.
    fn entries(&self) -> impl Iterator<Item = (usize, usize, Rational)> + '_ {
        self.edges.iter().zip(&self.vectors).enumerate().flat_map(move |(e, (&[i, j], d))| {
            let at = move |v: usize, sign: bool| {
                let place = self.place[v];
                (0..2).filter_map(move |axis| {
                    let value = if sign { d[axis].clone() } else { -d[axis].clone() };
                    Some((2 * place? + axis, e, value))
                })
            };
            at(i, true).chain(at(j, false))
        })
    }

    /// The equations exactly, by rows.
    pub fn rows(&self) -> Vec<Vec<Rational>> {
        let mut rows = vec![vec![Rational::ZERO; self.edges.len()]; 2 * self.free];
        for (i, j, value) in self.entries() {
            rows[i][j] = rows[i][j].clone() + value;
        }
        rows
    }

    /// The equations for the weights, in floating point.
    pub fn equations(&self) -> Csr {
        let entries: Vec<_> = self.entries().map(|(i, j, v)| (i, j, v.approximate())).collect();
        Csr::from_triplets(2 * self.free, self.edges.len(), &entries)
    }

    /// The lengths of the edges.
    pub fn lengths(&self) -> Vec<f64> {
        self.vectors.iter().map(|[x, y]| x.approximate().hypot(y.approximate())).collect()
    }

    /// The equations for the forces `ω_ij |ij|`, in floating point: every column has unit vectors.
    pub fn forces(&self) -> Csr {
        let lengths = self.lengths();
        self.equations().map(|_, j, v| v / lengths[j])
    }

    /// The weights of some forces.
    pub fn weights_of(&self, forces: &[f64]) -> Vec<f64> {
        forces.iter().zip(self.lengths()).map(|(f, l)| f / l).collect()
    }

    /// The rates `g_ij = (y_i − y_j)·(x_i − x_j)` of the constrained edges.
    pub fn rates(&self, motion: &[[Rational; 2]]) -> Vec<Rational> {
        let rate = |(&[i, j], d): (&[usize; 2], &[Rational; 2])| {
            let term = |axis: usize| (motion[i][axis].clone() - motion[j][axis].clone()) * d[axis].clone();
            term(0) + term(1)
        };
        self.edges.iter().zip(&self.vectors).map(rate).collect()
    }

    /// Whether a motion shows that no positive weights are in equilibrium. Exact.
    pub fn is_refuted_by(&self, motion: &[[Rational; 2]]) -> bool {
        let still = |v: usize| motion[v].iter().all(|x| x.cmp_zero() == Ordering::Equal);
        let held = (0..self.vertices).filter(|&v| self.place[v].is_none());
        let rates = self.rates(motion);
        held.into_iter().all(still)
            && rates.iter().all(|g| g.cmp_zero() != Ordering::Less)
            && rates.iter().any(|g| g.cmp_zero() == Ordering::Greater)
    }

    /// Whether weights of the constrained edges are positive and in equilibrium. Exact.
    pub fn is_carried_by(&self, weights: &[Rational]) -> bool {
        let mut forces = vec![Rational::ZERO; 2 * self.free];
        for (i, j, value) in self.entries() {
            forces[i] = forces[i].clone() + value * weights[j].clone();
        }
        weights.iter().all(|w| w.cmp_zero() == Ordering::Greater)
            && forces.iter().all(|f| f.cmp_zero() == Ordering::Equal)
    }

    /// The multipliers of the equations as a motion of all vertices.
    pub fn motion_of(&self, multipliers: &[Rational]) -> Vec<[Rational; 2]> {
        let at = |p: &Option<usize>| match p {
            Some(p) => [multipliers[2 * p].clone(), multipliers[2 * p + 1].clone()],
            None => [Rational::ZERO, Rational::ZERO],
        };
        self.place.iter().map(at).collect()
    }

    /// A proposed motion in whole numbers, with as few digits as survive the verification.
    ///
    /// The ends of edges that some weights in equilibrium make positive are held still: unless they lie in special position
    /// they have to be, as `g = 0` on all of those edges.
    pub fn rounded_motion(&self, split: &Split) -> Option<Vec<[Rational; 2]>> {
        let mut proposed: Vec<[f64; 2]> = self
            .place
            .iter()
            .map(|p| p.map_or([0.0; 2], |p| [2 * p, 2 * p + 1].map(|k| split.multipliers[k])))
            .collect();
        for (edge, _) in self.edges.iter().zip(&split.carried).filter(|(_, carried)| **carried) {
            edge.iter().for_each(|&v| proposed[v] = [0.0; 2]);
        }
        let largest = proposed.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        if largest == 0.0 {
            return None;
        }
        let whole = DIGITS.iter().map(|bits| {
            let scale = 2_f64.powi(*bits) / largest;
            proposed.iter().map(|y| y.map(|y| rounded(y * scale))).collect::<Vec<_>>()
        });
        let exact = |y: f64| Rational::exactly(y).unwrap_or_else(Rational::zero);
        let floating = proposed.iter().map(|y| y.map(exact)).collect();
        whole.chain([floating]).find(|motion| self.is_refuted_by(motion))
    }
}

/// How many bits the largest number of a rounded certificate has, tried one after the other.
pub(super) const DIGITS: [i32; 4] = [10, 20, 36, 52];

/// The nearest whole number.
pub(super) fn rounded(x: f64) -> Rational {
    Rational::exactly(x.round()).unwrap_or_else(Rational::zero)
}
