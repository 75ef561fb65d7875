//! The Hodge decomposition: `α = dμ + d*ν + h`, orthogonal, its parts unique and its potentials not.
//!
//! # How it is decided
//! For each Fourier mode of each degree on flat tori, and for the cochains of closed triangulations with random inner products: with bases
//! of the images of d and d* and of the kernel of Δ, the parts span all forms if the rank of the three together is the dimension, and are
//! unique if no combination is zero. A potential is unique if d (or d*) has no kernel in its degree.

use super::poll::{Case, Every};
use super::world::complexes::{Complex, closed};
use super::world::excerpt::{on_graph, sparse};
use super::world::graphs::laplacian;
use super::world::modes::{frequencies, tori};
use super::world::stage::{Stage, vanishes, written};
use super::{Experiment, Finding, Setting};
use crate::generate::Stream;
use crate::linalg::Dense;
use crate::property::{Evidence, Statement};
use crate::scalar::Rational;

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "hodge-decomposition",
    name: "The Hodge decomposition of modes and cochains",
    statement: "every form is dμ + d*ν + h with h harmonic; the three parts are orthogonal and unique; the potentials μ and ν are unique up \
                to closed and co-closed forms, and unique if μ = d*(…) and ν = d(…)",
    sources: &["wardetzky-primer"],
    parts: &[
        "parts-span",
        "parts-are-orthogonal",
        "parts-are-unique",
        "potentials-are-unique",
        "potentials-are-unique-in-the-gauge",
    ],
    run,
};

#[derive(Default)]
struct Polls {
    span: Every,
    orthogonal: Every,
    unique: Every,
    potentials: Every,
    gauge: Every,
}

impl Polls {
    fn ask(&mut self, stage: &Stage, evidence: impl FnOnce(&[Rational]) -> Option<Evidence>) {
        let parts = stage.parts();
        self.span.ask(stage.parts_do_not_span(&parts));
        self.orthogonal.ask(stage.parts_not_orthogonal(&parts));
        self.unique.ask(stage.parts_not_unique(&parts));
        self.potentials.ask(stage.ambiguous_potential().map(|x| {
            let text = format!("{}: the potentials 0 and {} have one derivative", stage.name, written(&x));
            evidence(&x).map_or(Case::told(text.clone()), |witness| Case::shown(text, witness))
        }));
        self.gauge.ask(stage.ambiguous_in_the_gauge());
    }
}

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let mut polls = Polls::default();
    for complex in closed() {
        for case in 0..setting.pick(1, 3) {
            let inner = if case == 0 { complex.diagonal(&mut stream) } else { complex.full(&mut stream) };
            // The potentials of 1-cochains are functions, and those of degree 1 are shown first.
            let degrees = (1..=complex.dimension()).chain([0]);
            for (k, stage) in degrees.filter_map(|k| Some((k, complex.stage(k, &inner)?))) {
                polls.ask(&stage, |x| if k == 1 && case == 0 { two_potentials(&complex, &inner[1], x) } else { None });
            }
        }
    }
    for torus in tori(setting.pick(1, 2), &mut stream) {
        let n = torus.dimension();
        for xi in frequencies(n, setting.pick(1, 2) as i64) {
            (0..=n).filter_map(|k| torus.stage(&xi, k)).for_each(|stage| polls.ask(&stage, |_| None));
        }
    }
    let cases = "degrees of cochains on closed triangulations and of Fourier modes on flat tori";
    let unique = "Has no combination of the three parts but the trivial one the sum zero?";
    vec![
        polls.span.answer("parts-span", "Do the images of d and d* and the harmonic forms span all forms?", cases),
        polls.orthogonal.answer("parts-are-orthogonal", "Are the three parts orthogonal?", cases),
        polls.unique.answer("parts-are-unique", unique, cases),
        polls.potentials.answer("potentials-are-unique", "Are μ and ν unique: is 0 the only potential of 0?", cases),
        polls.gauge.answer(
            "potentials-are-unique-in-the-gauge",
            "Are μ among the d*(…) and ν among the d(…) unique?",
            cases,
        ),
    ]
}

/// Two functions with one derivative, 0 and x: `dᵀ M₁ d x = 0` on the graph of vertices and edges, so that `Lμ = d*α` has more than one
/// solution. `None` if x is no function with that property.
fn two_potentials(complex: &Complex, inner: &Dense<Rational>, x: &[Rational]) -> Option<Evidence> {
    let graph = complex.graph(inner)?;
    let l = laplacian(&graph);
    let all: Vec<usize> = (0..l.rows()).collect();
    let fits = x.len() == l.rows() && vanishes(&l.mul(x));
    fits.then(|| on_graph(Statement::Singular { set: Vec::new(), x: sparse(x) }, &graph, &l, &all))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::calculus::whole;
    use crate::property::recheck::{Rechecked, from_excerpt};

    #[test]
    fn two_potentials_with_one_derivative_are_shown_and_survive_the_recheck() {
        let findings = run(&Setting { seed: 1, effort: crate::experiment::Effort::Smoke });
        assert_eq!(findings.iter().map(|f| f.agrees).collect::<Vec<_>>(), [true, true, true, false, true]);
        let evidence = &findings[3].evidence[0];
        assert_eq!(from_excerpt(evidence), Ok(Rechecked::Exact));
        let Statement::Singular { set, x } = &evidence.statement else { panic!("{evidence:?}") };
        assert!(set.is_empty() && x.iter().all(|(_, v)| *v == 1.0) && x.len() == 4);
    }

    #[test]
    fn a_function_that_is_not_constant_has_another_derivative() {
        let complex = &closed()[0];
        let inner = complex.diagonal(&mut Stream::new(1, "masses"));
        assert!(two_potentials(complex, &inner[1], &[1, 1, 1, 1].map(whole)).is_some());
        assert!(two_potentials(complex, &inner[1], &[1, 1, 1, 0].map(whole)).is_none());
        assert!(two_potentials(complex, &inner[1], &[1, 1].map(whole)).is_none());
    }
}
