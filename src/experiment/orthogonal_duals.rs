//! Orthogonal duals: dual vertices against the closed form of the weights, in rational arithmetic.

use std::cmp::Ordering;

use super::poll::{Case, Every, Search};
use super::world::excerpt::rows;
use super::world::triangulations::{Triangulation, describe_world, world};
use super::{Experiment, Finding, Setting};
use crate::domain::geometry::{cross2, dot};
use crate::generate::Stream;
use crate::laplacian::cotan;
use crate::laplacian::orthogonal_dual::stiffness_in_plane;
use crate::linalg::Dense;
use crate::property::{Evidence, Excerpt, Statement};
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "orthogonal-duals",
    name: "Operators of orthogonal duals",
    statement: "the weight of an edge is the signed length of its dual edge over its own, dual vertices being power centres of \
                vertex weights; equal weights give circumcentres and the cotangent Laplacian; all of these operators are local, \
                symmetric and linearly precise, and some have negative weights",
    sources: &["wardetzky-primer", "glickenstein2005"],
    parts: &[
        "weight-is-signed-dual-length-over-length",
        "equal-weights-give-circumcentres-and-cotan",
        "local-symmetric-linear",
        "negative-weight",
    ],
    run,
};

type Point = [Rational; 2];

fn minus(a: &Point, b: &Point) -> Point {
    [a[0].clone() - b[0].clone(), a[1].clone() - b[1].clone()]
}

fn is_zero(x: &Rational) -> bool {
    x.cmp_zero() == Ordering::Equal
}

/// A triangulation with vertex weights and the matrix of its orthogonal dual.
struct Specimen {
    triangulation: Triangulation,
    points: Vec<Point>,
    weights: Vec<Rational>,
    stiffness: Dense<Rational>,
}

impl Specimen {
    fn of(triangulation: Triangulation, weights: Vec<Rational>) -> Option<Self> {
        let stiffness = Dense::from_csr(&stiffness_in_plane(&triangulation.surface(), &weights)?);
        let points = triangulation.points().iter().map(|p| p.map(Rational::from)).collect();
        Some(Specimen { triangulation, points, weights, stiffness })
    }

    /// The point with `|d − x|² − w` the same for three corners, from the two linear equations that say so.
    fn power_centre(&self, [i, j, k]: [usize; 3]) -> Point {
        let power = |v: usize| dot(&self.points[v], &self.points[v]) - self.weights[v].clone();
        let (u, v) = (minus(&self.points[j], &self.points[i]), minus(&self.points[k], &self.points[i]));
        let half = |x: Rational| x * Rational::half();
        let (a, b) = (half(power(j) - power(i)), half(power(k) - power(i)));
        let area = cross2(&u, &v);
        [
            (a.clone() * v[1].clone() - b.clone() * u[1].clone()) / area.clone(),
            (b * u[0].clone() - a * v[0].clone()) / area,
        ]
    }

    /// Whether on every edge `ω |ij|²` is the way from the right dual vertex to the left one, measured along the normal to
    /// the left (on the boundary: from the edge), and the two dual vertices lie on a normal of the edge.
    fn sign_rule(&self) -> bool {
        self.triangulation.edges().iter().all(|edge| {
            let [i, j] = edge.ends;
            let e = minus(&self.points[j], &self.points[i]);
            let left = [-e[1].clone(), e[0].clone()];
            let from = self.power_centre([i, j, edge.left]);
            let to = match edge.right {
                Some(right) => self.power_centre([j, i, right]),
                None => self.points[i].clone(),
            };
            let dual = minus(&from, &to);
            let signed = dot(&dual, &left) + self.stiffness.at(i, j).clone() * dot(&e, &e);
            is_zero(&signed) && (edge.right.is_none() || is_zero(&dot(&dual, &e)))
        })
    }

    /// Whether the dual vertices are circumcentres and the matrix is that of the cotangent Laplacian.
    fn is_cotan(&self) -> bool {
        let equidistant = |f: &[usize; 3]| {
            let centre = self.power_centre(*f);
            let squares = f.map(|v| {
                let r = minus(&centre, &self.points[v]);
                dot(&r, &r)
            });
            squares.iter().all(|s| is_zero(&(s.clone() - squares[0].clone())))
        };
        let plain = cotan::stiffness_in_plane::<Rational>(&self.triangulation.surface());
        let same = |l: Dense<Rational>| {
            let n = self.points.len();
            (0..n * n).all(|k| is_zero(&(l.at(k / n, k % n).clone() - self.stiffness.at(k / n, k % n).clone())))
        };
        self.triangulation.faces().iter().all(equidistant) && plain.is_some_and(|l| same(Dense::from_csr(&l)))
    }

    fn is_local_symmetric_linear(&self) -> bool {
        let n = self.points.len();
        let (boundary, l) = (self.triangulation.boundary(), &self.stiffness);
        let local = (0..n).all(|i| {
            let near = self.triangulation.neighbours(i);
            (0..n).all(|j| i == j || near.contains(&j) || is_zero(l.at(i, j)))
        });
        let moment = |i: usize, axis: usize| {
            crate::scalar::sum((0..n).map(|j| l.at(i, j).clone() * self.points[j][axis].clone()))
        };
        let linear = (0..n).filter(|&i| !boundary[i]).all(|i| (0..2).all(|axis| is_zero(&moment(i, axis))));
        let constant = (0..n).all(|i| is_zero(&crate::scalar::sum((0..n).map(|j| l.at(i, j).clone()))));
        local && linear && constant && l.asymmetry().is_none()
    }

    /// An interior edge with a negative weight.
    fn negative(&self) -> Option<Case> {
        let below = |[i, j]: [usize; 2]| self.stiffness.at(i, j).cmp_zero() == Ordering::Greater;
        let edge = self.triangulation.edges().into_iter().find(|e| e.right.is_some() && below(e.ends))?;
        let [i, j] = [edge.ends[0].min(edge.ends[1]), edge.ends[0].max(edge.ends[1])];
        let statement = Statement::Weight { i, j, zero: false, opposite: Vec::new() };
        let excerpt = Excerpt { rows: rows(&self.stiffness, &[i]), ..Excerpt::default() };
        let text = format!("ω_{i}{j} = {} on {}", -self.stiffness.at(i, j).clone(), self.describe());
        Some(Case::shown(text, Evidence::new(statement, excerpt)))
    }

    fn describe(&self) -> String {
        let weights: Vec<String> = self.weights.iter().map(ToString::to_string).collect();
        format!("{} with vertex weights {}", self.triangulation.describe(), weights.join(", "))
    }
}

fn run(setting: &Setting) -> Vec<Finding> {
    let largest = setting.pick(5, 6);
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let (mut sign, mut equal, mut structure, mut negative) =
        (Every::default(), Every::default(), Every::default(), Search::default());
    for triangulation in world(largest) {
        let n = triangulation.points().len();
        let quarter = |k: usize| Rational::from(k as i64 - 16) / Rational::from(4);
        let random: Vec<Rational> = (0..n).map(|_| quarter(stream.below(33))).collect();
        let same = vec![random[0].clone(); n];
        for (weights, plain) in [(random, false), (same, true)] {
            let text = triangulation.describe();
            let Some(specimen) = Specimen::of(triangulation.clone(), weights) else {
                sign.ask(Some(Case::told(format!("no matrix on {text}"))));
                continue;
            };
            let told = |fine: bool| (!fine).then(|| Case::told(specimen.describe()));
            sign.ask(told(specimen.sign_rule()));
            structure.ask(told(specimen.is_local_symmetric_linear()));
            if plain { equal.ask(told(specimen.is_cotan())) } else { negative.ask(specimen.negative()) }
        }
    }
    let cases = describe_world(largest);
    let with = |text: &str, weights: &str| format!("{text} Cases: {cases}, each with {weights}.");
    let both = "random vertex weights (quarters from −4 to 4) and with equal ones";
    vec![
        sign.answer(
            ENTRY.parts[0],
            with(
                "Is ω_ij the way from the right dual vertex to the left one over |ij|, positive where they lie in the order of \
                 their triangles, and the dual edge orthogonal to ij?",
                both,
            ),
            "triangulations with weights",
        ),
        equal.answer(
            ENTRY.parts[1],
            with("Are the dual vertices circumcentres and the weights those of cotan?", "equal vertex weights"),
            "triangulations with weights",
        ),
        structure.answer(
            ENTRY.parts[2],
            with("Is the operator local, symmetric and linearly precise at interior vertices?", both),
            "triangulations with weights",
        ),
        negative.answer(
            ENTRY.parts[3],
            with("Has an interior edge a negative weight?", "random vertex weights"),
            "triangulations with weights",
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::world::triangulations::triangulations;

    fn star() -> Triangulation {
        let all = triangulations(&[[0, 0], [4, 0], [4, 2], [0, 2], [1, 1]]);
        all.into_iter().find(|t| t.neighbours(4).len() == 4).unwrap()
    }

    fn specimen(weights: [i64; 5]) -> Specimen {
        Specimen::of(star(), weights.map(Rational::from).to_vec()).unwrap()
    }

    #[test]
    fn unequal_weights_are_not_cotan_and_equal_ones_are() {
        assert!(specimen([3; 5]).is_cotan());
        let other = specimen([0, 0, 0, 0, 1]);
        assert!(!other.is_cotan() && other.sign_rule() && other.is_local_symmetric_linear());
    }

    #[test]
    fn a_planted_wrong_weight_breaks_the_sign_rule_and_linear_precision() {
        let mut wrong = specimen([0, 1, 0, 2, 0]);
        let one = Rational::from(1);
        for (i, j, sign) in [(0, 4, 1), (4, 0, 1), (0, 0, -1), (4, 4, -1)] {
            wrong.stiffness.add_to(i, j, one.clone() * Rational::from(sign));
        }
        assert!(!wrong.sign_rule() && !wrong.is_local_symmetric_linear());
    }

    #[test]
    fn a_large_weight_of_a_corner_opposite_makes_an_edge_negative() {
        // The weight of vertex 0 enters ω of the edge (1, 4) by −w/(2 [1 4 0]), [1 4 0] = 4 units of area.
        let case = specimen([100, 0, 0, 0, 0]).negative().unwrap();
        assert!(matches!(case.evidence[0].statement, Statement::Weight { zero: false, .. }), "{}", case.text);
        assert!(specimen([0; 5]).negative().is_none());
    }
}
