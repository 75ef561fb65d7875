//! Convergence needs consistency in the weak sense, and not at the vertices.
//!
//! The residuals are those of [`limit::residual`](super::limit::residual), orders and rule those of [`limit::order`](super::limit::order).

use rayon::prelude::*;

use super::limit::contest::{Contestant, Plan, Quantity, Row, by_size, denied, promised, rows};
use super::limit::mesh::Mesh;
use super::limit::order::{Level as Size, Trend, judge};
use super::limit::place::Place;
use super::limit::residual::residual;
use super::limit::sequence::{ALL, Sequence, Way, is_quick};
use super::poll::{Case, Every};
use super::{Effort, Experiment, Finding, Setting};
use crate::figure::{Axis, Chart, Figure, Mark, Series};
use crate::laplacian::Promised;
use crate::property::Level;

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "consistency",
    name: "Consistency and convergence",
    statement: "for a smooth u at the vertices of refined surfaces and of structured cubes: whether the largest |M⁻¹Lu − (−Δu)| at a vertex tends to zero wherever \
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

/// The sequence with a pattern that is the same at every interior vertex.
const SQUARE: Sequence = Sequence { place: Place::Square, way: Way::Structured };

/// What happens to one operator on one sequence.
struct Outcome {
    row: Row,
    pointwise: Vec<Size>,
    weak: Vec<Size>,
}

/// The linear elements of a place, of surfaces and of volumes, with lumped masses.
fn elements() -> Vec<Contestant> {
    let lumped = |c: &Contestant| ["barycentric", "voronoi"].contains(&c.mass());
    promised().into_iter().filter(|c| ["cotan", "tet-cotan"].contains(&c.entry.id) && lumped(c)).collect()
}

/// Operators that do not converge although they are symmetric; of the others nothing weak can be asked.
fn others() -> Vec<Contestant> {
    denied()
        .into_iter()
        .filter(|c| c.entry.promises.iter().any(|p| p.property == "SYM" && p.outcome == Promised::Holds))
        .collect()
}

fn outcomes(contestants: &[Contestant], sequence: Sequence, plan: Plan) -> Result<Vec<Outcome>, String> {
    let boundary = sequence.place.boundaries()[0];
    let meshes = plan.meshes(sequence)?;
    let all: Vec<&Mesh> = meshes.iter().flatten().collect();
    let element = elements().into_iter().find(|c| c.plays(sequence.place)).ok_or("no linear elements")?;
    let energies = all.par_iter().map(|mesh| element.build(mesh)).collect::<Result<Vec<_>, String>>()?;
    let solved = rows(contestants, sequence, &meshes, &[boundary], false)?;
    let outcome = |row: Row| {
        let of = |m: usize| {
            let operator = row.contestant.build(all[m])?;
            let mass = operator.mass().ok_or("no mass")?.diagonal();
            let u = all[m].place.solution(boundary);
            let found = residual(&operator, &mass, energies[m].stiffness(), all[m], &u, row.contestant.scaled);
            found.map_err(|e| e.to_string())
        };
        let found = (0..all.len()).into_par_iter().map(of).collect::<Result<Vec<_>, String>>()?;
        let pointwise = by_size(&meshes, &found, |f| Some(f.pointwise)).unwrap_or_default();
        let weak = by_size(&meshes, &found, |f| Some(f.weak)).unwrap_or_default();
        Ok(Outcome { row, pointwise, weak })
    };
    solved.into_iter().map(outcome).collect()
}

fn plan(setting: &Setting) -> Plan {
    let seed = setting.seed;
    match setting.effort {
        Effort::Smoke => Plan { sizes: &[(8, 12), (16, 8), (32, 6)], solid: &[(4, 1), (6, 1), (9, 1)], seed },
        Effort::Full => Plan { sizes: &[(16, 10), (32, 7), (64, 5)], solid: &[(6, 1), (9, 1), (12, 1)], seed },
    }
}

fn run(setting: &Setting) -> Vec<Finding> {
    let [mut control, mut pointwise, mut weak, mut planted] = [(); 4].map(|()| Every::default());
    let (mut table, mut shown) = (Vec::new(), Vec::new());
    // In random cubes that are coarse enough to be solved here the part of the residual that is random is not yet the larger one.
    let tried = |s: &&Sequence| s.place != Place::Cube || s.way == Way::Structured;
    let quick = |s: &&Sequence| setting.effort == Effort::Full || is_quick(**s);
    for &sequence in ALL.iter().filter(tried).filter(quick) {
        let mut contestants = elements();
        if sequence == SQUARE {
            contestants.extend(others());
        }
        let outcomes = match outcomes(&contestants, sequence, plan(setting)) {
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
            if outcome.row.contestant.scaled {
                planted.ask((solution.converges() || !dual.levels_off()).then(case));
                continue;
            }
            ask(&mut pointwise, &outcome, solution, strong, case);
            ask(&mut weak, &outcome, solution, dual, case);
            table.push(format!("{}: at the vertices {strong}, weakly {dual}", outcome.row.name()));
            if sequence == SQUARE {
                control.ask((!strong.reaches(2.0)).then(case));
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
            "Does the solution not converge, up to the best factor, and does the residual in the dual of the energy level off?",
            "operators without lengths or angles on a structured square",
        ),
    ];
    findings[1].finding += &format!("; {}", table.join("; "));
    findings[1].figures = shown;
    findings.iter_mut().for_each(|f| f.level = Level::Measured);
    findings
}

/// Whether a residual tends to zero where the solution converges. The case is open where noise hides either of the two; structured meshes
/// have none, and what does not clearly fall there is an exception.
fn ask(every: &mut Every, outcome: &Outcome, solution: Trend, residual: Trend, case: impl Fn() -> Case) {
    let open = solution.is_open() || residual.is_open() && outcome.row.sequence.is_random();
    match open {
        true => every.leave_open(case().text),
        false if solution.converges() => every.ask((!residual.converges()).then(case)),
        false => {}
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
    let wanted = [(Place::Square, Way::Structured), (Place::Square, Way::Random), (Place::Sphere, Way::Structured)];
    let (sequence, contestant) = (outcome.row.sequence, &outcome.row.contestant);
    if contestant.name() != "cotan" || !wanted.contains(&(sequence.place, sequence.way)) {
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
    use super::super::limit::poisson::solve;
    use super::*;

    fn cotan() -> Contestant {
        Contestant::of("cotan").unwrap()
    }

    #[test]
    fn a_wrong_sign_and_a_wrong_mass_leave_a_residual_of_their_size() {
        let mesh = SQUARE.mesh(16, 0).unwrap();
        let operator = cotan().build(&mesh).unwrap();
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
        for place in [Place::Disc, Place::Cube] {
            let mesh = Sequence { place, way: Way::Random }.mesh(16, 2).unwrap();
            let id = if place == Place::Cube { "tet-cotan" } else { "cotan" };
            let operator = Contestant::of(id).unwrap().build(&mesh).unwrap();
            let mass = operator.mass().unwrap();
            let u = mesh.place.solution(Boundary::Dirichlet);
            let found = residual(&operator, &mass.diagonal(), operator.stiffness(), &mesh, &u, false).unwrap();
            let solution = solve(&operator, mass.matrix(), &mesh, Boundary::Dirichlet, &u).unwrap();
            let exact = mesh.values(u.value);
            let gap: Vec<f64> = solution.iter().zip(&exact).map(|(a, b)| a - b).collect();
            let l = operator.stiffness();
            let distance = (l.quadratic_form(&gap) / l.quadratic_form(&exact)).sqrt();
            assert!((distance - found.weak).abs() < 1e-9 * distance, "{distance} {found:?}");
        }
    }

    #[test]
    fn graph_weights_are_not_consistent_in_any_sense_where_cotan_is_in_both() {
        let graph = others().into_iter().find(|c| c.entry.id == "graph").unwrap();
        let plan = plan(&Setting { seed: 1, effort: Effort::Smoke });
        for outcome in outcomes(&[cotan(), graph], SQUARE, plan).unwrap() {
            let cotan = outcome.row.contestant.entry.id == "cotan";
            assert_eq!(judge(&outcome.weak).converges(), cotan);
            assert_eq!(judge(&outcome.weak).levels_off(), !cotan);
            assert_eq!(judge(&outcome.pointwise).converges(), cotan);
        }
    }
}
