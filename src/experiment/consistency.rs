//! Convergence needs consistency in the weak sense, and not at the vertices.
//!
//! The residuals are those of [`limit::residual`](super::limit::residual), orders and rule those of [`limit::order`](super::limit::order).

use rayon::prelude::*;

use super::limit::contest::{Contestant, Plan, Quantity, Row, build, rows};
use super::limit::order::{Level as Size, Trend, judge};
use super::limit::place::Place;
use super::limit::residual::residual;
use super::limit::sequence::{ALL, Mesh, Sequence, Way};
use super::poll::{Case, Every};
use super::{Experiment, Finding, Setting};
use crate::figure::{Axis, Chart, Figure, Mark, Series};
use crate::property::Level;

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "consistency",
    name: "Consistency and convergence",
    statement: "for a smooth u at the vertices of refined meshes: whether the largest |M⁻¹Lu − (−Δu)| at a vertex tends to zero wherever \
                the solution of Poisson's equation converges; whether the residual Lu − M(−Δu) does in the dual of the energy; and \
                whether that stays where the solution does not converge",
    sources: &["wardetzky-primer", "wardetzky2007", "dziuk1988"],
    parts: &[
        "pointwise-on-a-structured-square",
        "pointwise-wherever-poisson-converges",
        "weakly-wherever-poisson-converges",
        "not-weakly-where-it-does-not",
    ],
    run,
};

const COTAN: Contestant = Contestant { name: "cotan", id: "cotan", given: &[], scaled: false };
const VORONOI: Contestant =
    Contestant { name: "cotan:mass=voronoi", id: "cotan", given: &[("mass", "voronoi")], scaled: false };
const GRAPH: Contestant = Contestant { name: "graph", id: "graph", given: &[], scaled: true };
const INVERSE: Contestant = Contestant {
    name: "weighted-graph:weights=inverse-length",
    id: "weighted-graph",
    given: &[("weights", "inverse-length")],
    scaled: true,
};

/// The sequence with a pattern that is the same at every interior vertex.
const SQUARE: Sequence = Sequence { place: Place::Square, way: Way::Structured };

/// What happens to one operator on one sequence.
struct Outcome {
    row: Row,
    pointwise: Vec<Size>,
    weak: Vec<Size>,
}

fn outcomes(contestants: &[Contestant], sequence: Sequence, plan: Plan) -> Result<Vec<Outcome>, String> {
    let boundary = sequence.place.boundaries()[0];
    let draws = sequence.draws(plan.draws);
    let meshes = plan.meshes(sequence)?;
    let solved = rows(contestants, sequence, &[boundary], plan)?;
    let outcome = |row: Row| {
        let contestant = row.contestant;
        let of = |mesh: &Mesh| {
            let (operator, energy) = (build(contestant, mesh)?, build(COTAN, mesh)?);
            let mass = operator.mass().ok_or("no mass")?.diagonal();
            let u = mesh.place.solution(boundary);
            let found = residual(&operator, &mass, energy.stiffness(), mesh, &u, contestant.scaled);
            found.map_err(|e| e.to_string())
        };
        let found = meshes.par_iter().map(of).collect::<Result<Vec<_>, String>>()?;
        let sizes = |pick: &dyn Fn(usize) -> f64| -> Vec<Size> {
            let level = |k: usize| {
                let mine = k * draws..(k + 1) * draws;
                let h = mine.clone().map(|m| meshes[m].h).sum::<f64>() / draws as f64;
                Size { h, errors: mine.map(pick).collect() }
            };
            (0..meshes.len() / draws).map(level).collect()
        };
        let (pointwise, weak) = (sizes(&|m| found[m].pointwise), sizes(&|m| found[m].weak));
        Ok(Outcome { row, pointwise, weak })
    };
    solved.into_iter().map(outcome).collect()
}

fn run(setting: &Setting) -> Vec<Finding> {
    let plan = Plan { first: 3, last: 6, last_random: setting.pick(5, 6), draws: 3, seed: setting.seed };
    let [mut control, mut pointwise, mut weak, mut planted] = [(); 4].map(|()| Every::default());
    let (mut table, mut shown) = (Vec::new(), Vec::new());
    for &sequence in ALL {
        let others: &[Contestant] =
            if sequence == SQUARE { &[COTAN, VORONOI, GRAPH, INVERSE] } else { &[COTAN, VORONOI] };
        let outcomes = match outcomes(others, sequence, plan) {
            Ok(outcomes) => outcomes,
            Err(why) => {
                let case = Case::told(format!("{}: {why}", sequence.name()));
                [&mut pointwise, &mut weak].into_iter().for_each(|every| every.ask(Some(case.clone())));
                continue;
            }
        };
        for outcome in outcomes {
            let Some(solution) = outcome.row.trend(Quantity::PoissonEnergy) else { continue };
            let (strong, dual) = (judge(&outcome.pointwise), judge(&outcome.weak));
            let case = || told(&outcome, solution, strong, dual);
            if solution.converges() {
                ask(&mut pointwise, strong, strong.levels_off(), case);
                ask(&mut weak, dual, dual.levels_off(), case);
                table.push(format!("{}: at the vertices {strong}, weakly {dual}", outcome.row.name()));
                if sequence == SQUARE {
                    ask(&mut control, strong, !strong.reaches(2.0), case);
                }
            } else if solution.levels_off() {
                ask(&mut planted, dual, dual.converges(), case);
            }
            shown.extend(figure(&outcome));
        }
    }
    let cases = "operators on sequences where the solution converges in energy";
    let mut findings = vec![
        control.answer(ENTRY.parts[0], "Does the residual at the vertices fall with order 2 where all stars are alike?", "masses"),
        pointwise.answer(ENTRY.parts[1], "Does the largest residual at a vertex tend to zero wherever the solution converges?", cases),
        weak.answer(ENTRY.parts[2], "Does the residual in the dual of the energy tend to zero wherever the solution converges?", cases),
        planted.answer(
            ENTRY.parts[3],
            "Does the residual in the dual of the energy not tend to zero where the solution does not converge, up to the best factor?",
            "operators without lengths on a structured square",
        ),
    ];
    findings[1].finding += &format!("; {}", table.join("; "));
    findings[1].figures = shown;
    findings.iter_mut().for_each(|f| f.level = Level::Measured);
    findings
}

/// A trend that is too noisy to say leaves the case open.
fn ask(every: &mut Every, trend: Trend, against: bool, case: impl Fn() -> Case) {
    match trend.is_open() {
        true => every.leave_open(case().text),
        false => every.ask(against.then(case)),
    }
}

fn told(outcome: &Outcome, solution: Trend, strong: Trend, dual: Trend) -> Case {
    Case::told(format!(
        "{}: the solution {solution}, the residual at the vertices {strong}, in the dual of the energy {dual}",
        outcome.row.name()
    ))
}

/// The three errors side by side, for one mass on one random and one structured sequence.
fn figure(outcome: &Outcome) -> Option<Figure> {
    let wanted =
        [(Place::Square, Way::Structured), (Place::Square, Way::RandomDelaunay), (Place::Sphere, Way::Structured)];
    let sequence = outcome.row.sequence;
    if outcome.row.contestant != COTAN || !wanted.contains(&(sequence.place, sequence.way)) {
        return None;
    }
    let solution = outcome.row.levels[Quantity::PoissonEnergy as usize].as_deref()?;
    let of = |name: &str, levels: &[Size]| {
        let name = match judge(levels).order() {
            Some(order) => format!("{name}: {order}"),
            None => name.to_string(),
        };
        Series::new(name, Mark::Both, levels.iter().map(|l| [l.h, l.mean()]))
    };
    let ends = [outcome.weak.last()?, outcome.weak.first()?];
    let reference = |p: f64| {
        let top = ends[1].mean().max(solution.first().map_or(0.0, Size::mean));
        Series::new(format!("slope {p}"), Mark::Reference, ends.map(|l| [l.h, top * (l.h / ends[1].h).powf(p)]))
    };
    Some(Figure::Chart(Chart {
        title: format!("Residuals and solution: cotan, {}, {}", sequence.name(), outcome.row.boundary.name()),
        x: Axis::logarithmic("mesh size h"),
        y: Axis::logarithmic("relative error"),
        series: vec![
            of("residual, worst vertex", &outcome.pointwise),
            of("residual, dual of the energy", &outcome.weak),
            of("solution in energy", solution),
            reference(1.0),
            reference(2.0),
        ],
    }))
}

#[cfg(test)]
mod tests {
    use super::super::limit::place::Boundary;
    use super::*;

    const PLAN: Plan = Plan { first: 3, last: 6, last_random: 5, draws: 1, seed: 1 };

    #[test]
    fn a_wrong_sign_and_a_wrong_mass_leave_a_residual_of_their_size() {
        let mesh = SQUARE.mesh(4, 0).unwrap();
        let operator = build(COTAN, &mesh).unwrap();
        let mass = operator.mass().unwrap().diagonal();
        let u = mesh.place.solution(Boundary::Dirichlet);
        let of = |factor: f64| {
            let mass: Vec<f64> = mass.iter().map(|m| factor * m).collect();
            residual(&operator, &mass, operator.stiffness(), &mesh, &u, false).unwrap()
        };
        let right = of(1.0);
        assert!(right.pointwise < 0.02 && right.weak < 0.02, "{right:?}");
        assert!((of(-1.0).weak - 2.0).abs() < 0.05 && of(-1.0).pointwise > 1.9);
        assert!((of(2.0).weak - 1.0).abs() < 0.05 && (of(2.0).pointwise - 0.5).abs() < 0.05);
    }

    #[test]
    fn the_weak_residual_is_the_distance_of_the_solution_from_the_values_at_the_vertices() {
        let mesh = Sequence { place: Place::Disc, way: Way::RandomDelaunay }.mesh(4, 2).unwrap();
        let operator = build(COTAN, &mesh).unwrap();
        let mass = operator.mass().unwrap();
        let u = mesh.place.solution(Boundary::Dirichlet);
        let found = residual(&operator, &mass.diagonal(), operator.stiffness(), &mesh, &u, false).unwrap();
        let solution =
            super::super::limit::poisson::solve(&operator, mass.matrix(), &mesh, Boundary::Dirichlet, &u).unwrap();
        let exact: Vec<f64> = (0..solution.len()).map(|v| (u.value)(mesh.place.point(&mesh.domain, v))).collect();
        let gap: Vec<f64> = solution.iter().zip(&exact).map(|(a, b)| a - b).collect();
        let l = operator.stiffness();
        let distance = (l.quadratic_form(&gap) / l.quadratic_form(&exact)).sqrt();
        assert!((distance - found.weak).abs() < 1e-9 * distance, "{distance} {found:?}");
    }

    #[test]
    fn graph_weights_are_not_consistent_in_any_sense_where_cotan_is_in_both() {
        for outcome in outcomes(&[COTAN, GRAPH], SQUARE, PLAN).unwrap() {
            let cotan = outcome.row.contestant == COTAN;
            assert_eq!(judge(&outcome.weak).converges(), cotan);
            assert_eq!(judge(&outcome.weak).levels_off(), !cotan);
            assert_eq!(judge(&outcome.pointwise).converges(), cotan);
        }
    }
}
