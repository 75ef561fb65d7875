//! Negative cotangent weights in the plane: what they spoil and what they do not, on every small triangulation.

use std::cmp::Ordering;

use super::poll::{Case, Every, Search};
use super::world::excerpt::{corners, on_triangulation, sparse};
use super::world::harmonic::{extension, global};
use super::world::triangulations::{Edge, Triangulation, describe_world, world};
use super::{Experiment, Finding, Setting};
use crate::laplacian::cotan::stiffness_in_plane;
use crate::linalg::Dense;
use crate::property::{Evidence, Statement};
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "negative-weights",
    name: "Negative cotangent weights, semi-definiteness and the maximum principle",
    statement: "the cotangent stiffness is positive semi-definite also where interior weights are negative; positive interior \
                weights give MAX-global; a negative weight at an interior vertex may leave or break it",
    sources: &["wardetzky-primer", "wardetzky2007"],
    parts: &[
        "every-triangulation-is-psd",
        "negative-interior-weight-and-psd",
        "positive-weights-are-psd",
        "positive-weights-and-max",
        "negative-weight-and-max",
        "negative-weight-and-no-max",
    ],
    run,
};

/// What the questions look at, for one triangulation.
struct Specimen {
    triangulation: Triangulation,
    edges: Vec<Edge>,
    boundary: Vec<bool>,
    stiffness: Dense<Rational>,
}

impl Specimen {
    fn of(triangulation: Triangulation) -> Option<Self> {
        let stiffness = Dense::from_csr(&stiffness_in_plane(&triangulation.surface())?);
        let (edges, boundary) = (triangulation.edges(), triangulation.boundary());
        Some(Specimen { triangulation, edges, boundary, stiffness })
    }

    fn sign(&self, edge: &Edge) -> Ordering {
        self.stiffness.at(edge.ends[0], edge.ends[1]).cmp_zero().reverse()
    }

    fn interior_edges(&self) -> impl Iterator<Item = &Edge> {
        self.edges.iter().filter(|e| e.right.is_some())
    }

    fn prescribed(&self) -> Vec<usize> {
        (0..self.boundary.len()).filter(|&v| self.boundary[v]).collect()
    }

    fn has_interior_vertex(&self) -> bool {
        self.boundary.contains(&false)
    }

    /// The first negative weight of an interior edge, or of one with an end inside.
    fn negative(&self, at_interior_vertex: bool) -> Option<&Edge> {
        let admitted = |e: &&Edge| !at_interior_vertex || e.ends.iter().any(|&v| !self.boundary[v]);
        self.interior_edges().filter(admitted).find(|e| self.sign(e) == Ordering::Less)
    }

    fn case(&self, text: &str, statement: Statement, rows: &[usize]) -> Case {
        let text = format!("{text} on {}", self.triangulation.describe());
        Case::shown(text, on_triangulation(statement, &self.triangulation, &self.stiffness, rows))
    }

    fn weight(&self, edge: &Edge) -> (String, Evidence) {
        let [i, j] = [edge.ends[0].min(edge.ends[1]), edge.ends[0].max(edge.ends[1])];
        let statement = Statement::Weight { i, j, zero: false, opposite: corners(&self.triangulation, edge) };
        let weight = -self.stiffness.at(i, j).clone();
        let evidence = on_triangulation(statement, &self.triangulation, &self.stiffness, &[i]);
        (format!("ω_{i}{j} = {weight}"), evidence)
    }

    fn not_semidefinite(&self) -> Option<Case> {
        let x = sparse(&self.stiffness.eliminate().negative_direction()?);
        let rows: Vec<usize> = x.iter().map(|(i, _)| *i).collect();
        Some(self.case("xᵀLx < 0", Statement::NegativeEnergy { x }, &rows))
    }

    /// The smallest entry of the harmonic extension from the boundary.
    fn smallest_harmonic_value(&self) -> Option<Rational> {
        let h = extension(&self.stiffness, &self.prescribed())?;
        let entries = (0..h.rows()).flat_map(|i| (0..h.columns()).map(move |b| (i, b)));
        entries.map(|(i, b)| h.at(i, b).clone()).reduce(|a, b| if b < a { b } else { a })
    }

    /// The certificate of MAX-global with a negative weight; `None` where the extension has a zero.
    fn positive_extension(&self, edge: &Edge, smallest: &Rational) -> Option<Evidence> {
        let [i, j] = [edge.ends[0].min(edge.ends[1]), edge.ends[0].max(edge.ends[1])];
        let text = |x: Rational| x.reduced().to_string();
        let weight = text(-self.stiffness.at(i, j).clone());
        let statement = Statement::PositiveExtension { i, j, weight, smallest: text(smallest.clone()) };
        let all: Vec<usize> = (0..self.boundary.len()).collect();
        let positive = smallest.cmp_zero() == Ordering::Greater;
        positive.then(|| on_triangulation(statement, &self.triangulation, &self.stiffness, &all))
    }

    fn no_maximum_principle(&self) -> Option<Case> {
        let violation = global(&self.stiffness, &self.prescribed())?;
        Some(self.case(&violation.text, violation.statement, &violation.rows))
    }
}

fn run(setting: &Setting) -> Vec<Finding> {
    let largest = setting.pick(6, 7);
    let mut polls = Polls::default();
    for triangulation in world(largest) {
        let text = triangulation.describe();
        match Specimen::of(triangulation) {
            Some(specimen) => polls.ask(&specimen),
            None => polls.psd.ask(Some(Case::told(format!("no cotangent stiffness on {text}")))),
        }
    }
    polls.answer(&describe_world(largest))
}

#[derive(Default)]
struct Polls {
    psd: Every,
    negative_psd: Search,
    positive_psd: Every,
    positive_max: Every,
    negative_max: Search,
    negative_no_max: Search,
    negative: usize,
}

impl Polls {
    fn ask(&mut self, specimen: &Specimen) {
        let indefinite = specimen.not_semidefinite();
        let negative = specimen.negative(false);
        self.negative_psd.ask(negative.filter(|_| indefinite.is_none()).map(|edge| {
            let (text, evidence) = specimen.weight(edge);
            let inertia = specimen.stiffness.eliminate().inertia();
            let numbers = format!("{} positive, {} zero, no negative eigenvalue", inertia.positive, inertia.zero);
            Case::shown(format!("{text}, {numbers} on {}", specimen.triangulation.describe()), evidence)
        }));
        if specimen.edges.iter().all(|e| specimen.sign(e) == Ordering::Greater) {
            self.positive_psd.ask(indefinite.clone());
        }
        self.psd.ask(indefinite);
        let broken = specimen.no_maximum_principle().filter(|_| specimen.has_interior_vertex());
        if specimen.has_interior_vertex() && specimen.interior_edges().all(|e| specimen.sign(e) == Ordering::Greater) {
            self.positive_max.ask(broken.clone());
        }
        let edge = specimen.negative(true);
        self.negative += usize::from(edge.is_some());
        let negative = edge.map(|e| specimen.weight(e));
        self.negative_max.ask(negative.clone().filter(|_| broken.is_none()).map(|(weight, evidence)| {
            let smallest = specimen.smallest_harmonic_value();
            let text = smallest.as_ref().map_or(String::new(), |h| format!(", min H = {h}"));
            let certificate = edge.zip(smallest).and_then(|(edge, h)| specimen.positive_extension(edge, &h));
            Case {
                text: format!("{weight}{text} on {}", specimen.triangulation.describe()),
                evidence: [evidence].into_iter().chain(certificate).collect(),
            }
        }));
        self.negative_no_max.ask(
            negative
                .zip(broken)
                .map(|((weight, _), case)| Case { text: format!("{weight}; {}", case.text), evidence: case.evidence }),
        );
    }

    fn answer(self, cases: &str) -> Vec<Finding> {
        let question = |text: &str| format!("{text} Cases: {cases}.");
        let searched =
            format!("triangulations, {} of them with a negative weight at an interior vertex", self.negative);
        vec![
            self.psd.answer(
                ENTRY.parts[0],
                question("Is the cotangent stiffness positive semi-definite, whatever its weights?"),
                "triangulations",
            ),
            self.negative_psd.answer(
                ENTRY.parts[1],
                question("Is it positive semi-definite with a negative weight on an interior edge?"),
                "triangulations",
            ),
            self.positive_psd.answer(
                ENTRY.parts[2],
                question("Is it positive semi-definite where every weight is positive?"),
                "triangulations with positive weights",
            ),
            self.positive_max.answer(
                ENTRY.parts[3],
                question("Does MAX-global hold where every interior weight is positive?"),
                "triangulations with an interior vertex and positive interior weights",
            ),
            self.negative_max.answer(
                ENTRY.parts[4],
                question("Does MAX-global hold somewhere with a negative weight at an interior vertex?"),
                &searched,
            ),
            self.negative_no_max.answer(
                ENTRY.parts[5],
                question("Does MAX-global fail somewhere with a negative weight at an interior vertex?"),
                &searched,
            ),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::world::triangulations::triangulations;

    /// The vertex (1, 1) in a rectangle of width 4 and height 2, joined to all four corners.
    fn star() -> Specimen {
        let all = triangulations(&[[0, 0], [4, 0], [4, 2], [0, 2], [1, 1]]);
        Specimen::of(all.into_iter().find(|t| t.neighbours(4).len() == 4).unwrap()).unwrap()
    }

    #[test]
    fn the_weights_of_a_stretched_star_have_the_signs_of_hand_computation() {
        // At (0, 0) the angles over the edge to (1, 1) are those at (0, 2), 45°, and at (4, 0), with cotangent 3: both acute.
        let star = star();
        assert_eq!(*star.stiffness.at(0, 4), Rational::from(-2));
        assert!(star.negative(true).is_none());
        assert!(star.not_semidefinite().is_none() && star.no_maximum_principle().is_none());
        // Each of the rows of H: weights over their sum, 2 and 2 from (0, ·), and what linear precision leaves for (4, ·).
        let sum = Rational::from(4) + Rational::from(4) / Rational::from(3);
        assert_eq!(star.smallest_harmonic_value(), Some(Rational::from(2) / Rational::from(3) / sum));
    }

    #[test]
    fn a_planted_negative_weight_spoils_both_and_is_found() {
        let mut star = star();
        let planted = Rational::from(3);
        for (i, j) in [(0, 4), (4, 0)] {
            star.stiffness.add_to(i, j, planted.clone());
            star.stiffness.add_to(i, i, -planted.clone());
        }
        assert!(star.negative(true).is_some_and(|e| e.ends == [0, 4] || e.ends == [4, 0]));
        let violation = star.no_maximum_principle().unwrap();
        assert!(matches!(violation.evidence[0].statement, Statement::Overshoot { at: 4, source: 0, low: true, .. }));
        assert!(star.not_semidefinite().is_some());
    }

    #[test]
    fn a_matrix_of_the_wrong_sign_is_not_semidefinite() {
        let mut star = star();
        star.stiffness = Dense::from_fn(5, 5, |i, j| -star.stiffness.at(i, j).clone());
        let case = star.not_semidefinite().unwrap();
        assert!(matches!(case.evidence[0].statement, Statement::NegativeEnergy { .. }));
    }
}
