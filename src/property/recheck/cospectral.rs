//! Two graphs with one characteristic polynomial that are not isomorphic.

use std::collections::BTreeSet;

use dashu_int::IBig;

use super::alone::lowest_terms;
use super::eigenvalues::determinant;
use super::{Answer, Rechecked, Refusal};
use crate::property::evidence::Fraction;
use crate::scalar::Rational;

/// The largest number of vertices whose renumberings are searched.
const LARGEST: usize = 9;

/// A graph by the neighbours of each vertex.
struct Neighbours(Vec<BTreeSet<usize>>);

impl Neighbours {
    fn read(vertices: usize, edges: &[[usize; 2]]) -> Result<Self, Refusal> {
        let mut neighbours = vec![BTreeSet::new(); vertices];
        for (index, &[a, b]) in edges.iter().enumerate() {
            let new = a < vertices && b < vertices && a != b && neighbours[a].insert(b);
            if !new {
                return Err(Refusal::Malformed { what: "edge", index, problem: "is no edge, or one that there is" });
            }
            neighbours[b].insert(a);
        }
        Ok(Neighbours(neighbours))
    }

    fn degree(&self, v: usize) -> usize {
        self.0[v].len()
    }

    /// `det(xB − L)`, B the degrees or the identity.
    fn at(&self, x: i64, normalised: bool) -> Rational {
        let n = self.0.len();
        let entry = |i: usize, j: usize| match (i == j, self.0[i].contains(&j)) {
            (true, _) => {
                let degree = self.degree(i) as i64;
                x * if normalised { degree } else { 1 } - degree
            }
            (false, true) => 1,
            (false, false) => 0,
        };
        determinant((0..n).map(|i| (0..n).map(|j| Rational::from(IBig::from(entry(i, j)))).collect()).collect())
    }

    /// Whether the vertices from `images.len()` on can be sent somewhere so that edges become edges and all others others.
    fn extends(&self, other: &Self, images: &mut Vec<usize>) -> bool {
        let v = images.len();
        if v == self.0.len() {
            return true;
        }
        for w in 0..self.0.len() {
            let fits = !images.contains(&w)
                && self.degree(v) == other.degree(w)
                && images.iter().enumerate().all(|(u, x)| self.0[v].contains(&u) == other.0[w].contains(x));
            if fits {
                images.push(w);
                if self.extends(other, images) {
                    return true;
                }
                images.pop();
            }
        }
        false
    }
}

/// Both graphs have the polynomial, by its values at n + 1 whole numbers; no renumbering takes one to the other.
pub(super) fn decide(vertices: usize, edges: [&[[usize; 2]]; 2], normalised: bool, polynomial: &[Fraction]) -> Answer {
    let read = |(k, text): (usize, &Fraction)| lowest_terms("coefficient", k, text);
    let coefficients: Vec<Rational> = polynomial.iter().enumerate().map(read).collect::<Result<_, _>>()?;
    if coefficients.len().checked_sub(1) != Some(vertices) || coefficients.last() != Some(&Rational::ONE) {
        return Err(Refusal::untrue(
            "the polynomial is monic, of a degree that is the number of vertices",
            "it is not",
        ));
    }
    if vertices > LARGEST {
        return Ok(Rechecked::Open(format!("the renumberings of more than {LARGEST} vertices are not searched")));
    }
    let graphs = [Neighbours::read(vertices, edges[0])?, Neighbours::read(vertices, edges[1])?];
    for graph in &graphs {
        if let (Some(v), true) = ((0..vertices).find(|&v| graph.degree(v) == 0), normalised) {
            return Err(Refusal::untrue("every vertex has a neighbour", format!("vertex {v} has none")));
        }
        // det(xD − L) = det D · det(xI − D⁻¹L).
        let product = (0..vertices).fold(Rational::ONE, |p, v| p * Rational::from(graph.degree(v) as u64));
        let factor = if normalised { product } else { Rational::ONE };
        for x in 0..=vertices as i64 {
            let at = Rational::from(IBig::from(x));
            let value = coefficients.iter().rev().fold(Rational::ZERO, |sum, c| sum * at.clone() + c.clone());
            let found = graph.at(x, normalised) / factor.clone();
            if value != found {
                let stated = format!("the polynomial is {value} at {x}");
                return Err(Refusal::untrue(stated, found.to_string()));
            }
        }
    }
    if graphs[0].extends(&graphs[1], &mut Vec::new()) {
        return Err(Refusal::untrue("the graphs are not isomorphic", "they are"));
    }
    Ok(Rechecked::Exact)
}
