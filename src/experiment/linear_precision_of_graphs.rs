//! The combinatorial Laplacian of a triangulation's edges is local, symmetric and positive, and not linearly precise.

use std::cmp::Ordering;

use super::poll::{Case, Every, Search};
use super::world::excerpt::on_triangulation;
use super::world::graphs::laplacian;
use super::world::triangulations::{Triangulation, describe_world, world};
use super::{Experiment, Finding, Setting};
use crate::domain::Graph;
use crate::linalg::Dense;
use crate::property::Statement;
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "linear-precision-of-graphs",
    name: "The combinatorial Laplacian on planar triangulations",
    statement: "with weight one on every edge L is local, symmetric and has positive weights; Lx = 0 holds at an interior vertex \
                exactly when it is the centroid of its neighbours, and in general it is not",
    sources: &["wardetzky2007", "wardetzky-primer"],
    parts: &["local-symmetric-positive", "linear-exactly-at-centroids", "not-linear"],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let largest = setting.pick(5, 6);
    let (mut structure, mut centroids, mut linear) = (Every::default(), Every::default(), Search::default());
    for t in world(largest) {
        let l = combinatorial(&t);
        structure.ask(not_local_symmetric_positive(&t, &l));
        let boundary = t.boundary();
        for i in (0..boundary.len()).filter(|&i| !boundary[i]) {
            let moment = moment(&t, &l, i);
            centroids.ask(
                (moment.is_none() != is_centroid(&t, i)).then(|| Case::told(format!("vertex {i} of {}", t.describe()))),
            );
            linear.ask(moment);
        }
    }
    let cases = describe_world(largest);
    let question = |text: &str| format!("{text} Cases: {cases}.");
    vec![
        structure.answer(
            ENTRY.parts[0],
            question("Are the weights positive on the edges and zero elsewhere, and is L symmetric?"),
            "triangulations",
        ),
        centroids.answer(
            ENTRY.parts[1],
            question("Is Lx = Ly = 0 at an interior vertex exactly when it is the centroid of its neighbours?"),
            "interior vertices",
        ),
        linear.answer(ENTRY.parts[2], question("Is Lx ≠ 0 or Ly ≠ 0 at some interior vertex?"), "interior vertices"),
    ]
}

fn combinatorial(t: &Triangulation) -> Dense<Rational> {
    let edges: Vec<[usize; 2]> = t.edges().iter().map(|e| e.ends).collect();
    let graph = Graph::new(t.points().len(), &edges).expect("the edges of a triangulation are distinct");
    laplacian(&graph)
}

fn not_local_symmetric_positive(t: &Triangulation, l: &Dense<Rational>) -> Option<Case> {
    let n = t.points().len();
    let joined: Vec<Vec<usize>> = (0..n).map(|i| t.neighbours(i)).collect();
    let places = (0..n).flat_map(|i| (0..n).filter(move |&j| j != i).map(move |j| (i, j)));
    let (i, j) = places.into_iter().find(|&(i, j)| {
        let expected = if joined[i].contains(&j) { Ordering::Less } else { Ordering::Equal };
        l.at(i, j).cmp_zero() != expected || l.at(i, j) != l.at(j, i)
    })?;
    Some(Case::told(format!("entry ({i}, {j}) is {}, its mirror image {} on {}", l.at(i, j), l.at(j, i), t.describe())))
}

/// `Σ_j L_ij (x_j − x_i) ≠ 0` for one of the two coordinates.
fn moment(t: &Triangulation, l: &Dense<Rational>, i: usize) -> Option<Case> {
    let coordinate = |v: usize, axis: usize| Rational::from(t.points()[v][axis]);
    let at = |axis: usize| {
        let terms = (0..l.columns()).map(|j| l.at(i, j).clone() * (coordinate(j, axis) - coordinate(i, axis)));
        crate::scalar::sum(terms)
    };
    let axis = (0..2).find(|&axis| at(axis).cmp_zero() != Ordering::Equal)?;
    let name = ["x", "y"][axis];
    let text = format!("(L{name})_{i} = {} at the star of vertex {i} on {}", at(axis), t.describe());
    let statement = Statement::Moment { i, axis, axes: [0, 1], boundary: None, threshold: 0.0 };
    Some(Case::shown(text, on_triangulation(statement, t, l, &[i])))
}

/// Whether the vertex times its valence is the sum of its neighbours, in whole numbers.
fn is_centroid(t: &Triangulation, i: usize) -> bool {
    let neighbours = t.neighbours(i);
    (0..2).all(|axis| {
        let total: i64 = neighbours.iter().map(|&j| t.points()[j][axis]).sum();
        total == neighbours.len() as i64 * t.points()[i][axis]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::world::triangulations::triangulations;
    use crate::laplacian::cotan::stiffness_in_plane;

    /// The vertex (1, 1) joined to the corners of a quadrangle, one of which is pulled out when `out` is 3.
    fn star(out: i64) -> Triangulation {
        triangulations(&[[0, 1], [1, 0], [out, 1], [1, 2], [1, 1]])
            .into_iter()
            .find(|t| t.neighbours(4).len() == 4)
            .unwrap()
    }

    #[test]
    fn a_symmetric_star_is_linear_and_a_stretched_one_is_not() {
        assert!(moment(&star(2), &combinatorial(&star(2)), 4).is_none());
        // (−1) + 2 − 0: the neighbours' abscissae relative to the centre sum to 1, and L has the opposite sign.
        let case = moment(&star(3), &combinatorial(&star(3)), 4).unwrap();
        assert!(case.text.starts_with("(Lx)_4 = -1"), "{}", case.text);
        assert!(matches!(case.evidence[0].statement, Statement::Moment { i: 4, axis: 0, .. }));
    }

    #[test]
    fn the_cotangent_weights_of_the_stretched_star_are_linear() {
        let l = Dense::from_csr(&stiffness_in_plane(&star(3).surface()).unwrap());
        assert!(moment(&star(3), &l, 4).is_none());
    }

    #[test]
    fn a_negative_weight_a_far_entry_and_an_asymmetry_are_found() {
        let t = star(2);
        assert!(not_local_symmetric_positive(&t, &combinatorial(&t)).is_none());
        for (i, j, change) in [(4, 0, 2), (0, 2, -1), (4, 1, -1)] {
            let mut l = combinatorial(&t);
            l.add_to(i, j, Rational::from(change));
            assert!(not_local_symmetric_positive(&t, &l).is_some());
        }
    }
}
