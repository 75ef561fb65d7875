//! Properties decided in rational arithmetic, on planar meshes of moderate size whose operator has rational entries.
//!
//! # Definition
//! The predicates are those of the properties with these ids, without a threshold: what is zero is zero. A second way to every
//! verdict that floating point gives on such a mesh, and the way that the exhaustive searches go.
//!
//! | id | how |
//! | --- | --- |
//! | SYM, NULL, POS, POS0, POS-boundary, LIN, ENERGY, FLUX, MVP, MAX-local | entry by entry, in O(n + E) |
//! | PSD | inertia of the symmetric part by rational elimination (`L = U D Uᵀ`, Sylvester) |
//! | KER | rank by rational elimination |
//! | MAX-global | `H = −L_II⁻¹ L_IB` by rational elimination |
//!
//! # Limitations
//! Triangulated, planar, manifold surfaces without degenerate face and isolated vertex. The eliminations take O(n³) operations on
//! numbers that grow: meant for some sixty vertices. LOC and FIN are combinatorial already; the relations, MASS and MAX-heat
//! (whose times and bounds are rounded numbers) are not decided here.

use std::cmp::Ordering;

use crate::domain::{Domain, Surface, geometry};
use crate::linalg::{Csr, Dense};
use crate::scalar::{Rational, Scalar};

/// What a predicate came to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Decision {
    /// It is true.
    Holds,
    /// It is false, at these vertices: one, or the ends of an edge; none where it is false of the matrix as a whole.
    Fails(Vec<usize>),
    /// It says nothing here: there is no place that it speaks of.
    Silent,
}

/// The properties that are decided here.
pub const DECIDED: &[&str] = &[
    "SYM",
    "NULL",
    "KER",
    "POS",
    "POS0",
    "POS-boundary",
    "PSD",
    "LIN",
    "ENERGY",
    "FLUX",
    "MVP",
    "MAX-local",
    "MAX-global",
];

/// A planar mesh with exact coordinates.
pub struct Plane<'a> {
    surface: &'a Surface,
    positions: Vec<[Rational; 2]>,
    boundary: Vec<bool>,
    components: Vec<usize>,
}

impl<'a> Plane<'a> {
    /// A mesh on which properties are decided here; none where it is not one of those.
    pub fn new(domain: &'a Domain) -> Option<Self> {
        let surface = domain.as_surface()?;
        let positions = surface.planar_positions::<Rational>()?;
        let facts = domain.facts();
        let of_surface = facts.surface?;
        let regular = of_surface.manifold && of_surface.degenerate_faces == 0 && facts.isolated_vertices == 0;
        let boundary = surface.topology().boundary_vertices().to_vec();
        let fits = regular && surface.is_triangulated() && !positions.is_empty();
        fits.then(|| Plane { surface, positions, boundary, components: domain.components() })
    }
}

/// A planar mesh with an exact stiffness matrix.
pub struct Case<'a> {
    plane: &'a Plane<'a>,
    stiffness: &'a Csr<Rational>,
}

impl<'a> Case<'a> {
    /// A case; none where the matrix has another size than the mesh.
    pub fn new(plane: &'a Plane<'a>, stiffness: &'a Csr<Rational>) -> Option<Self> {
        let square = stiffness.rows() == plane.positions.len() && stiffness.columns() == stiffness.rows();
        square.then_some(Case { plane, stiffness })
    }

    /// Decides a property; `None` for those that are not decided here.
    pub fn decide(&self, property: &str) -> Option<Decision> {
        Some(match property {
            "SYM" => first(self.asymmetry()),
            "NULL" => first((0..self.size()).find(|&i| nonzero(&self.row_sum(i))).map(|i| vec![i])),
            "KER" => self.kernel(),
            "POS" => self.weights(false, |w| w == Ordering::Greater),
            "POS0" => self.weights(false, |w| w != Ordering::Less),
            "POS-boundary" => self.weights(true, |w| w == Ordering::Greater),
            "PSD" => self.semidefinite(),
            "LIN" => self.over(false, |i| (0..2).any(|axis| nonzero(&self.moment(i, axis)))),
            "ENERGY" => self.energy(),
            "FLUX" => self.over(true, |i| self.flux_is_wrong(i)),
            "MVP" => self.over(false, |i| self.is_no_average(i)),
            "MAX-local" => self.over(false, |i| self.has_not_one_sign(i)),
            "MAX-global" => self.maximum_principle(),
            _ => return None,
        })
    }

    fn size(&self) -> usize {
        self.plane.positions.len()
    }

    fn interior(&self) -> Vec<usize> {
        (0..self.size()).filter(|&i| !self.plane.boundary[i]).collect()
    }

    /// The first vertex, inside or on the boundary, of which something is wrong.
    fn over(&self, boundary: bool, wrong: impl Fn(usize) -> bool) -> Decision {
        let places: Vec<usize> = (0..self.size()).filter(|&i| self.plane.boundary[i] == boundary).collect();
        if places.is_empty() {
            Decision::Silent
        } else {
            first(places.into_iter().find(|&i| wrong(i)).map(|i| vec![i]))
        }
    }

    fn asymmetry(&self) -> Option<Vec<usize>> {
        let entry = self.stiffness.entries().find(|&(i, j, v)| i != j && self.stiffness.at(j, i) != *v);
        entry.map(|(i, j, _)| vec![i, j])
    }

    fn row_sum(&self, i: usize) -> Rational {
        crate::scalar::sum(self.stiffness.row(i).map(|(_, v)| v.clone()))
    }

    /// The sign of `ω_ij`.
    fn sign(&self, i: usize, j: usize) -> Ordering {
        self.stiffness.get(i, j).map_or(Ordering::Equal, |v| v.cmp_zero().reverse())
    }

    fn weights(&self, boundary: bool, good: fn(Ordering) -> bool) -> Decision {
        let topology = self.plane.surface.topology();
        let edges = topology.edges().iter().enumerate().filter(|(e, _)| topology.is_boundary_edge(*e) == boundary);
        let edges: Vec<[usize; 2]> = edges.map(|(_, ends)| *ends).collect();
        if edges.is_empty() {
            return Decision::Silent;
        }
        let bad = edges.iter().flat_map(|&[i, j]| [[i, j], [j, i]]).find(|&[i, j]| !good(self.sign(i, j)));
        first(bad.map(|ends| ends.to_vec()))
    }

    /// `Σ_j L_ij (x_j − x_i)`.
    fn moment(&self, i: usize, axis: usize) -> Rational {
        let term = |(j, v): (usize, &Rational)| {
            v.clone() * (self.plane.positions[j][axis].clone() - self.plane.positions[i][axis].clone())
        };
        crate::scalar::sum(self.stiffness.row(i).map(term))
    }

    /// Twice the signed area.
    fn doubled_area(&self) -> Rational {
        let of = |f: &[usize]| {
            let [a, b, c] = [0, 1, 2].map(|k| &self.plane.positions[f[k]]);
            geometry::doubled_area(a, b, c)
        };
        crate::scalar::sum(self.plane.surface.faces().iter().map(of))
    }

    /// `½ Σ_{i≠j} ω_ij (x_i − x_j)(x_i − x_j)ᵀ = area·I₂`.
    fn energy(&self) -> Decision {
        let area = self.doubled_area().magnitude() * Rational::half();
        let difference = |i: usize, j: usize, axis: usize| {
            self.plane.positions[i][axis].clone() - self.plane.positions[j][axis].clone()
        };
        let wrong = [[0, 0], [0, 1], [1, 1]].into_iter().find(|&[a, b]| {
            let off = self.stiffness.entries().filter(|(i, j, _)| i != j);
            let terms = off.map(|(i, j, v)| -(v.clone() * difference(i, j, a) * difference(i, j, b)));
            let found = Rational::half() * crate::scalar::sum(terms);
            let expected = if a == b { area.clone() } else { Rational::zero() };
            nonzero(&(found - expected))
        });
        first(wrong.map(|_| Vec::new()))
    }

    /// `(LX)_i ≠ ½ J (x_q − x_p)`, p and q before and after i along the boundary, J a quarter turn clockwise.
    fn flux_is_wrong(&self, i: usize) -> bool {
        let turn = if self.doubled_area().cmp_zero() == Ordering::Less { -Rational::half() } else { Rational::half() };
        let topology = self.plane.surface.topology();
        let on_boundary = |v: usize| topology.edge_between(i, v).is_some_and(|e| topology.is_boundary_edge(e));
        let (mut before, mut after) = (i, i);
        for &at in topology.star(i) {
            let (corners, corner) = (&self.plane.surface.faces()[at.face()], at.corner());
            let (next, previous) = (corners[(corner + 1) % 3], corners[(corner + 2) % 3]);
            after = if on_boundary(next) { next } else { after };
            before = if on_boundary(previous) { previous } else { before };
        }
        let along =
            |axis: usize| self.plane.positions[after][axis].clone() - self.plane.positions[before][axis].clone();
        let expected = [turn.clone() * along(1), -(turn * along(0))];
        (0..2).any(|axis| nonzero(&(self.moment(i, axis) - expected[axis].clone())))
    }

    fn is_no_average(&self, i: usize) -> bool {
        let diagonal = self.stiffness.at(i, i).cmp_zero() == Ordering::Greater;
        let negative = self.stiffness.row(i).any(|(j, _)| j != i && self.sign(i, j) == Ordering::Less);
        !diagonal || negative || nonzero(&self.row_sum(i))
    }

    fn has_not_one_sign(&self, i: usize) -> bool {
        let with = |sign| self.stiffness.row(i).any(|(j, _)| j != i && self.sign(i, j) == sign);
        with(Ordering::Less) == with(Ordering::Greater)
    }

    fn semidefinite(&self) -> Decision {
        let symmetric = |i: usize, j: usize| {
            let twice = self.stiffness.at(i, j) + self.stiffness.at(j, i);
            if nonzero(&twice) { (Rational::half() * twice).reduced() } else { Rational::zero() }
        };
        let matrix = Dense::from_fn(self.size(), self.size(), symmetric);
        let holds = matrix.eliminate().is_semidefinite();
        if holds { Decision::Holds } else { Decision::Fails(Vec::new()) }
    }

    fn kernel(&self) -> Decision {
        let components = &self.plane.components;
        let count = components.iter().max().map_or(0, |last| last + 1);
        // An operator that joins no two components annihilates the locally constant functions where its row sums vanish.
        if let Some(i) = (0..self.size()).find(|&i| {
            nonzero(&self.row_sum(i))
                || self.stiffness.row(i).any(|(j, v)| components[j] != components[i] && nonzero(v))
        }) {
            return Decision::Fails(vec![i]);
        }
        let rank = Dense::from_csr(self.stiffness).rank();
        if rank + count == self.size() { Decision::Holds } else { Decision::Fails(Vec::new()) }
    }

    fn maximum_principle(&self) -> Decision {
        let inside = self.interior();
        let set: Vec<usize> = (0..self.size()).filter(|&i| self.plane.boundary[i]).collect();
        if inside.is_empty() || set.is_empty() {
            return Decision::Silent;
        }
        let block = |columns: &[usize]| {
            Dense::from_fn(inside.len(), columns.len(), |i, j| self.stiffness.at(inside[i], columns[j]).reduced())
        };
        // L_II H = −L_IB: solved for −H.
        let Some(minus) = block(&inside).solve(&block(&set)) else { return Decision::Fails(Vec::new()) };
        let one = Rational::half() + Rational::half();
        let outside = |i: usize, b: usize| {
            let x = -minus.at(i, b).clone();
            x.cmp_zero() == Ordering::Less || (x - one.clone()).cmp_zero() == Ordering::Greater
        };
        let places = (0..inside.len()).flat_map(|i| (0..set.len()).map(move |b| (i, b)));
        first(places.into_iter().find(|&(i, b)| outside(i, b)).map(|(i, b)| vec![inside[i], set[b]]))
    }
}

fn first(wrong: Option<Vec<usize>>) -> Decision {
    wrong.map_or(Decision::Holds, Decision::Fails)
}

fn nonzero(x: &Rational) -> bool {
    x.cmp_zero() != Ordering::Equal
}

#[cfg(test)]
mod tests {
    use super::*;

    fn star() -> Domain {
        let points = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [-2.0, 0.0], [0.0, -1.0]];
        Surface::planar(&points, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]).unwrap().into()
    }

    /// The cotangent matrix of the star: ½ to the far neighbours, 2 to the near ones, ½ (0 − …) outside: by hand, `cot` at the
    /// corners of the right triangle with legs 2 and 1 are 0, ½ and 2, so that the boundary edges have weight 0.
    fn cotan() -> Vec<(usize, usize, f64)> {
        let mut l = vec![(0, 0, 5.0)];
        for (j, w) in [(1, 0.5), (2, 2.0), (3, 0.5), (4, 2.0)] {
            l.extend([(0, j, -w), (j, 0, -w), (j, j, w)]);
        }
        l
    }

    fn decide(entries: &[(usize, usize, f64)], property: &str) -> Decision {
        let exact: Vec<_> = entries.iter().map(|&(i, j, v)| (i, j, Rational::exactly(v).unwrap())).collect();
        let matrix = Csr::from_triplets(5, 5, &exact);
        let star = star();
        let plane = Plane::new(&star).unwrap();
        Case::new(&plane, &matrix).unwrap().decide(property).unwrap()
    }

    #[test]
    fn of_the_right_star_everything_holds_but_positivity_on_the_boundary() {
        for property in DECIDED {
            let expected = if *property == "POS-boundary" { Decision::Fails(vec![1, 2]) } else { Decision::Holds };
            assert_eq!(decide(&cotan(), property), expected, "{property}");
        }
    }

    #[test]
    fn each_property_fails_where_it_is_spoilt_by_the_smallest_number_and_names_the_place() {
        let tiny = f64::MIN_POSITIVE;
        let spoilt = |more: &[(usize, usize, f64)]| [cotan(), more.to_vec()].concat();
        let one_way = spoilt(&[(0, 1, -tiny), (0, 0, tiny)]);
        assert_eq!(decide(&one_way, "SYM"), Decision::Fails(vec![0, 1]));
        assert_eq!(decide(&one_way, "LIN"), Decision::Fails(vec![0]));
        assert_eq!(decide(&one_way, "NULL"), Decision::Holds);
        let both = spoilt(&[(0, 1, -tiny), (1, 0, -tiny), (0, 0, tiny), (1, 1, tiny)]);
        assert_eq!(decide(&both, "SYM"), Decision::Holds);
        assert_eq!(decide(&both, "ENERGY"), Decision::Fails(vec![]));
        assert_eq!(decide(&both, "FLUX"), Decision::Fails(vec![1]));
        assert_eq!(decide(&spoilt(&[(3, 3, tiny)]), "NULL"), Decision::Fails(vec![3]));
        assert_eq!(decide(&spoilt(&[(3, 3, tiny)]), "KER"), Decision::Fails(vec![3]));
        assert_eq!(decide(&spoilt(&[(0, 0, tiny)]), "MVP"), Decision::Fails(vec![0]));
        assert_eq!(decide(&spoilt(&[(3, 3, -tiny)]), "PSD"), Decision::Fails(vec![]));
        // ω₀₁ from ½ to zero, to less than zero, and the row adjusted.
        let zero = spoilt(&[(0, 1, 0.5), (1, 0, 0.5), (0, 0, -0.5), (1, 1, -0.5)]);
        assert_eq!([decide(&zero, "POS"), decide(&zero, "POS0")], [Decision::Fails(vec![0, 1]), Decision::Holds]);
        assert_eq!([decide(&zero, "KER"), decide(&zero, "MAX-local")], [Decision::Fails(vec![]), Decision::Holds]);
        let negative = spoilt(&[(0, 1, 0.75), (1, 0, 0.75), (0, 0, -0.75), (1, 1, -0.75)]);
        assert_eq!(
            [decide(&negative, "POS0"), decide(&negative, "MVP")],
            [Decision::Fails(vec![0, 1]), Decision::Fails(vec![0])]
        );
        assert_eq!(decide(&negative, "MAX-local"), Decision::Fails(vec![0]));
        assert_eq!(decide(&negative, "MAX-global"), Decision::Fails(vec![0, 1]));
        assert_eq!(decide(&spoilt(&[(0, 0, -5.0)]), "MAX-global"), Decision::Fails(vec![]), "singular");
    }

    #[test]
    fn what_is_not_decided_here_says_so() {
        let exact = Csr::<Rational>::diagonal(&vec![Rational::zero(); 5]);
        let star = star();
        let plane = Plane::new(&star).unwrap();
        assert_eq!(Case::new(&plane, &exact).unwrap().decide("MASS"), None);
        assert!(Case::new(&plane, &Csr::<Rational>::diagonal(&[])).is_none());
        let triangle = Domain::from(Surface::planar(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &[[0, 1, 2]]).unwrap());
        let three = Csr::<Rational>::diagonal(&vec![Rational::zero(); 3]);
        let plane = Plane::new(&triangle).unwrap();
        let case = Case::new(&plane, &three).unwrap();
        for property in ["POS", "POS0", "LIN", "MVP", "MAX-local", "MAX-global"] {
            assert_eq!(case.decide(property), Some(Decision::Silent), "{property}");
        }
    }
}
