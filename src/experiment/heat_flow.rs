//! With positive weights heat flows from hot to cold: along each edge, in an explicit step up to a sharp bound, in an
//! implicit step of any length.

use std::cmp::Ordering;

use super::poll::{Case, Every};
use super::world::graphs::{describe, graphs_up_to, laplacian, randomly_weighted, rational};
use super::world::harmonic::heat;
use super::{Experiment, Finding, Setting};
use crate::domain::Graph;
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::scalar::{Rational, Scalar, sum};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "heat-flow",
    name: "The direction of heat flow on graphs",
    statement: "for positive weights and du/dt = −M⁻¹Lu, M lumped and positive: the flux ω_ij (u_i − u_j) runs from the hotter \
                to the colder end of each edge and the fluxes add up to the change; the explicit step u − tM⁻¹Lu keeps \
                min u and max u for all u exactly when t ≤ min_i M_ii/L_ii; the implicit step keeps them for all t > 0",
    sources: &["wardetzky-primer", "wardetzky2007"],
    parts: &[
        "flux-runs-from-hot-to-cold",
        "explicit-step-keeps-the-range",
        "longer-step-leaves-the-range",
        "implicit-step-keeps-the-range",
    ],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let (mut flux, mut within) = (Every::default(), Every::default());
    let (mut beyond, mut implicit) = (Every::default(), Every::default());
    let largest = setting.pick(5, 6);
    for graph in graphs_up_to(largest) {
        let random = randomly_weighted(&graph, &mut stream);
        for graph in [&graph, &random] {
            let l = laplacian(graph);
            let n = graph.vertex_count();
            let temperatures: Vec<Rational> = (0..n).map(|_| rational(stream.below(17) as f64 / 4.0 - 2.0)).collect();
            let mass: Vec<Rational> = (0..n).map(|_| rational((1 + stream.below(64)) as f64 / 16.0)).collect();
            flux.ask(wrong_flux(graph, &l, &temperatures));
            implicit.ask(heat(&l, &mass, &Rational::ONE).map(|v| told(graph, &v.text)));
            let Some((bound, _)) = longest_step(&l, &mass) else { continue };
            for step in [bound.clone() * Rational::half(), bound.clone()] {
                within.ask(leaves_the_range(&l, &mass, &step).map(|text| told(graph, &text)));
            }
            let longer = bound * rational(1.0 + 1.0 / 1024.0);
            let kept = leaves_the_range(&l, &mass, &longer).is_none();
            beyond.ask(kept.then(|| told(graph, &format!("the range is kept at t = {longer}"))));
        }
    }
    let of = format!("of every graph with at most {largest} vertices, weights one and random positive");
    let with_edge = format!("steps on weightings {of}, that have an edge, with random lumped masses");
    vec![
        flux.answer(
            ENTRY.parts[0],
            "Does every flux run from the hotter to the colder end, and do the fluxes add up to −Lu?",
            &format!("random temperatures on weightings {of}"),
        ),
        within.answer(
            ENTRY.parts[1],
            "Does u − tM⁻¹Lu stay between min u and max u for every u at t = b and t = b/2, b = min_i M_ii/L_ii?",
            &with_edge,
        ),
        beyond.answer(
            ENTRY.parts[2],
            "Does it leave them for some u at t = (1 + 1/1024) b, so that the bound is sharp?",
            &with_edge,
        ),
        implicit.answer(
            ENTRY.parts[3],
            "Is (M + tL)⁻¹ M ≥ 0 at t = 1?",
            &format!("steps on weightings {of}, with random lumped masses"),
        ),
    ]
}

fn told(graph: &Graph, text: &str) -> Case {
    Case::told(format!("{}: {text}", describe(graph)))
}

/// Reads the flux of each edge off the matrix: its sign against the temperatures, its balance against `−Lu`.
fn wrong_flux(graph: &Graph, l: &Dense<Rational>, u: &[Rational]) -> Option<Case> {
    let mut gain = vec![Rational::zero(); u.len()];
    for &[i, j] in graph.edges() {
        let difference = u[i].clone() - u[j].clone();
        let flux = -l.at(i, j).clone() * difference.clone();
        if flux.cmp_zero() != difference.cmp_zero() {
            let text = format!("the flux {flux} from vertex {i} at {} to vertex {j} at {}", u[i], u[j]);
            return Some(told(graph, &text));
        }
        gain[i] = gain[i].clone() - flux.clone();
        gain[j] = gain[j].clone() + flux;
    }
    let change = l.mul(u);
    let i = (0..u.len()).find(|&i| gain[i] != -change[i].clone())?;
    Some(told(graph, &format!("at vertex {i} the fluxes add up to {}, −Lu is {}", gain[i], -change[i].clone())))
}

/// `min_i M_ii / L_ii` over the rows with a positive diagonal, and where it is attained; `None` if there is no such row.
fn longest_step(l: &Dense<Rational>, mass: &[Rational]) -> Option<(Rational, usize)> {
    let rows = (0..l.rows()).filter(|&i| l.at(i, i).cmp_zero() == Ordering::Greater);
    let steps = rows.map(|i| ((mass[i].clone() / l.at(i, i).clone()).reduced(), i));
    steps.reduce(|a, b| if b.0 < a.0 { b } else { a })
}

/// The explicit step keeps the range of every u exactly when `P = I − tM⁻¹L` has no negative entry and rows that sum to one.
fn leaves_the_range(l: &Dense<Rational>, mass: &[Rational], t: &Rational) -> Option<String> {
    let n = l.rows();
    let entry = |i: usize, j: usize| {
        let identity = if i == j { Rational::ONE } else { Rational::zero() };
        (identity - t.clone() * l.at(i, j).clone() / mass[i].clone()).reduced()
    };
    let places = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    if let Some((i, j)) = places.into_iter().find(|&(i, j)| entry(i, j).cmp_zero() == Ordering::Less) {
        return Some(format!(
            "at t = {t} the temperature 1 at vertex {j}, else 0, gives {} at vertex {i}",
            entry(i, j)
        ));
    }
    let i = (0..n).find(|&i| sum((0..n).map(|j| entry(i, j))) != Rational::ONE)?;
    Some(format!("at t = {t} the constant 1 changes at vertex {i}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(weights: &[f64; 2]) -> Graph {
        Graph::weighted(3, &[[0, 1], [1, 2]], weights).unwrap()
    }

    #[test]
    fn a_negative_weight_lets_heat_run_uphill() {
        let u = [0.0, 1.0, 3.0].map(rational);
        assert!(wrong_flux(&path(&[1.0, 1.0]), &laplacian(&path(&[1.0, 1.0])), &u).is_none());
        let case = wrong_flux(&path(&[1.0, -1.0]), &laplacian(&path(&[1.0, -1.0])), &u).unwrap();
        assert!(case.text.ends_with("the flux 2 from vertex 1 at 1 to vertex 2 at 3"), "{}", case.text);
    }

    #[test]
    fn a_source_on_the_diagonal_breaks_the_balance_and_the_range() {
        let mut l = laplacian(&path(&[1.0, 1.0]));
        l.add_to(1, 1, Rational::ONE);
        assert!(wrong_flux(&path(&[1.0, 1.0]), &l, &[0.0, 1.0, 3.0].map(rational)).is_some());
        assert!(leaves_the_range(&l, &vec![Rational::ONE; 3], &rational(0.125)).is_some());
    }

    #[test]
    fn the_bound_of_a_path_is_one_half_and_sharp() {
        let (l, mass) = (laplacian(&path(&[1.0, 1.0])), vec![Rational::ONE; 3]);
        assert_eq!(longest_step(&l, &mass), Some((Rational::half(), 1)));
        assert_eq!(leaves_the_range(&l, &mass, &Rational::half()), None);
        assert!(leaves_the_range(&l, &mass, &rational(0.5 + f64::EPSILON)).is_some());
    }

    #[test]
    fn an_edgeless_graph_has_no_bound() {
        assert_eq!(longest_step(&laplacian(&Graph::new(2, &[]).unwrap()), &[Rational::ONE, Rational::ONE]), None);
    }
}
