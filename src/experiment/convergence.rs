//! What converges under refinement, at which order, and what does not: eigenvalues, eigenspaces and solutions of Poisson's
//! equation on domains where all of them are known.
//!
//! Orders, their intervals and the rule that decides are those of [`limit::order`](super::limit::order), the smooth problems those of
//! [`limit::place`](super::limit::place). A finite number of meshes proves no limit: the level is "measured", but for the completeness of
//! the spectra, which is certified.

use super::limit::contest::{Contestant, Plan, QUANTITIES, Quantity, Row, rows};
use super::limit::order::{Level as Size, Trend, fitted};
use super::limit::place::{Boundary, Place};
use super::limit::sequence::{ALL, Sequence, Way};
use super::poll::{Case, Every, Search};
use super::{Effort, Experiment, Finding, Setting};
use crate::figure::{Axis, Chart, Figure, Mark, Series};
use crate::property::Level;

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "convergence",
    name: "Convergence of eigenvalues, eigenspaces and solutions",
    statement: "cotan with every mass, intrinsic-delaunay and orthogonal-dual with zero weights on refined squares, discs, flat tori and \
                spheres, structured, random Delaunay and flipped, with Dirichlet and natural boundary: eigenvalues, eigenspaces and \
                solutions of Poisson's equation against closed forms, with the order of each error and its interval; \
                combinatorial, inverse-length, mean value and Wachspress weights under the same rule",
    sources: &["wardetzky-primer", "wardetzky2007", "dziuk1988", "strang-fix1973"],
    parts: &[
        "spectra-are-complete",
        "eigenvalues-converge",
        "eigenspaces-converge",
        "poisson-converges-in-l2",
        "poisson-converges-in-energy",
        "orders-reach-the-theory",
        "cotan-converges",
        "intrinsic-delaunay-converges",
        "graph-does-not-converge",
        "mean-value-does-not-converge",
    ],
    run,
};

const fn cotan(name: &'static str, given: &'static [(&'static str, &'static str)]) -> Contestant {
    Contestant { name, id: "cotan", given, scaled: false }
}

/// The operators that are made to converge.
const CLAIMING: [Contestant; 6] = [
    cotan("cotan", &[]),
    cotan("cotan:mass=consistent", &[("mass", "consistent")]),
    cotan("cotan:mass=mixed", &[("mass", "mixed")]),
    cotan("cotan:mass=voronoi", &[("mass", "voronoi")]),
    Contestant { name: "intrinsic-delaunay", id: "intrinsic-delaunay", given: &[], scaled: false },
    Contestant {
        name: "orthogonal-dual:weights=zero",
        id: "orthogonal-dual",
        given: &[("weights", "zero")],
        scaled: false,
    },
];

/// Operators whose weights are not an energy: compared up to the factor that suits them best.
const PLANTED: [Contestant; 4] = [
    Contestant { name: "graph", id: "graph", given: &[], scaled: true },
    Contestant { name: "mean-value", id: "mean-value", given: &[], scaled: true },
    Contestant { name: "wachspress", id: "wachspress", given: &[], scaled: true },
    Contestant {
        name: "weighted-graph:weights=inverse-length",
        id: "weighted-graph",
        given: &[("weights", "inverse-length")],
        scaled: true,
    },
];

/// The sequence on which the planted operators are shown: one diagonal in every cell, so that one direction is not like the other.
const ONE_DIAGONAL: Sequence = Sequence { place: Place::Square, way: Way::Structured };

fn plan(setting: &Setting) -> Plan {
    Plan { first: 3, last: 6, last_random: setting.pick(5, 6), draws: 2, seed: setting.seed }
}

fn run(setting: &Setting) -> Vec<Finding> {
    let (mut all, mut refused) = (Vec::new(), Vec::new());
    let claiming: Vec<Contestant> = match setting.effort {
        Effort::Smoke => vec![CLAIMING[0], CLAIMING[1], CLAIMING[4]],
        Effort::Full => CLAIMING.to_vec(),
    };
    for &sequence in ALL {
        match rows(&claiming, sequence, sequence.place.boundaries(), plan(setting)) {
            Ok(rows) => all.extend(rows),
            Err(why) => refused.push(format!("{}: {why}", sequence.name())),
        }
    }
    let planted = match rows(&PLANTED, ONE_DIAGONAL, &[Boundary::Dirichlet], plan(setting)) {
        Ok(rows) => rows,
        Err(why) => {
            refused.push(why);
            Vec::new()
        }
    };
    let mut findings = vec![complete(&all, &planted, &refused)];
    findings.extend(QUANTITIES.into_iter().zip(&ENTRY.parts[1..5]).map(|(q, part)| converges(&all, &refused, q, part)));
    findings.push(theory(&all));
    findings.push(column(&all, &refused, "cotan", ENTRY.parts[6]));
    findings.push(column(&all, &refused, "intrinsic-delaunay", ENTRY.parts[7]));
    findings.push(stays(&planted, "graph", ENTRY.parts[8]));
    findings.push(stays(&planted, "mean-value", ENTRY.parts[9]));
    findings
}

/// A refusal speaks against every statement about all meshes.
fn refusals(every: &mut Every, refused: &[String]) {
    refused.iter().for_each(|why| every.ask(Some(Case::told(why.clone()))));
}

fn complete(all: &[Row], planted: &[Row], refused: &[String]) -> Finding {
    let mut every = Every::default();
    refusals(&mut every, refused);
    for row in all.iter().chain(planted) {
        if let Some(certified) = row.certified {
            every.ask((!certified).then(|| Case::told(row.name())));
        }
    }
    let mut finding = every.answer(
        ENTRY.parts[0],
        "Does an inertia count certify that every spectrum compared is complete, with residuals below a hundredth of its error?",
        "sequences of spectra",
    );
    finding.level = Level::Bounded;
    finding
}

fn converges(all: &[Row], refused: &[String], quantity: Quantity, part: &'static str) -> Finding {
    let mut every = Every::default();
    refusals(&mut every, refused);
    let mut without = Vec::new();
    for row in all {
        match row.trend(quantity) {
            Some(trend) => ask(&mut every, row, quantity, trend),
            None => without.push(format!("{} ({})", row.name(), row.notes.join("; "))),
        }
    }
    let question = format!(
        "Do the errors of {} fall at every size, with the whole interval of their order above ½, wherever that is decided?",
        quantity.name()
    );
    let mut finding = every.answer(part, question, "operators on sequences with a boundary condition");
    finding.level = Level::Measured;
    finding.finding +=
        &format!("; orders, from the least to the largest over the operators: {}", orders(all, quantity));
    if let Some(first) = without.first() {
        finding.finding += &format!("; {} have none, the first: {first}", without.len());
    }
    finding.figures.extend(chart(all, quantity));
    finding
}

/// An error that levels off is an exception, one that is too noisy to say is left open.
fn ask(every: &mut Every, row: &Row, quantity: Quantity, trend: Trend) {
    match trend.is_open() {
        true => every.leave_open(told(row, quantity, trend).text),
        false => every.ask(trend.levels_off().then(|| told(row, quantity, trend))),
    }
}

fn told(row: &Row, quantity: Quantity, trend: Trend) -> Case {
    let means = row.levels[quantity as usize].iter().flatten().map(|l| format!("{:.2e}", l.mean()));
    Case::told(format!(
        "{}, {}: {trend} (errors {})",
        row.name(),
        quantity.name(),
        means.collect::<Vec<_>>().join(", ")
    ))
}

/// The range of orders on each sequence and boundary condition.
fn orders(all: &[Row], quantity: Quantity) -> String {
    let mut texts = Vec::new();
    for sequence in ALL {
        for boundary in sequence.place.boundaries() {
            let mine = all.iter().filter(|r| r.sequence == *sequence && r.boundary == *boundary);
            let mut found: Vec<_> = mine.filter_map(|r| r.trend(quantity)?.order()).collect();
            found.sort_by(|a, b| a.p.total_cmp(&b.p));
            if let [least, .., most] = found[..] {
                texts.push(format!("{}, {}: {least} to {most}", sequence.name(), boundary.name()));
            }
        }
    }
    texts.join("; ")
}

/// Where the theory of linear elements promises an order: linear elements, a mass exact on linear functions, angles bounded.
fn theory(all: &[Row]) -> Finding {
    let mut every = Every::default();
    let elements = |row: &&Row| row.contestant == CLAIMING[0] || row.contestant == CLAIMING[1];
    for row in all.iter().filter(elements).filter(|r| r.sequence.way == Way::Structured) {
        for quantity in QUANTITIES {
            if let Some(trend) = row.trend(quantity) {
                match trend.is_open() {
                    true => every.leave_open(told(row, quantity, trend).text),
                    false => every.ask((!trend.reaches(quantity.promised())).then(|| told(row, quantity, trend))),
                }
            }
        }
    }
    let mut finding = every.answer(
        ENTRY.parts[5],
        "Does the interval reach the order that the theory promises, 2 and in energy 1, for barycentric and consistent mass on \
         structured sequences, whose angles are bounded?",
        "quantities",
    );
    finding.level = Level::Measured;
    finding
}

/// The cell CON of an operator: every quantity on every sequence.
fn column(all: &[Row], refused: &[String], id: &str, part: &'static str) -> Finding {
    let mut every = Every::default();
    refusals(&mut every, refused);
    for row in all.iter().filter(|r| r.contestant.id == id) {
        for quantity in QUANTITIES {
            if let Some(trend) = row.trend(quantity) {
                ask(&mut every, row, quantity, trend);
            }
        }
    }
    let question =
        format!("Does every quantity of {id} that there is converge on every sequence where that is decided?");
    let mut finding = every.answer(part, question, "quantities on sequences");
    finding.level = Level::Measured;
    finding
}

/// An error that stays though the operator is given the best factor.
fn stays(planted: &[Row], id: &str, part: &'static str) -> Finding {
    let mut search = Search::default();
    for row in planted.iter().filter(|r| r.contestant.id == id) {
        for quantity in QUANTITIES {
            if let Some(trend) = row.trend(quantity) {
                search.ask(trend.levels_off().then(|| told(row, quantity, trend)));
            }
        }
    }
    let question = format!(
        "Does an error of {id} level off, up to the best factor, on squares whose cells all have the same diagonal?"
    );
    let mut finding = search.answer(part, question, "quantities");
    finding.level = Level::Measured;
    let series = planted.iter().flat_map(|row| series(row, Quantity::PoissonEnergy, row.contestant.id));
    let title = "Errors that stay: solutions of Poisson's equation up to the best factor, structured square";
    finding.figures.push(figure(title, Quantity::PoissonEnergy, series.collect(), planted));
    finding
}

fn chart(all: &[Row], quantity: Quantity) -> Option<Figure> {
    // As many as there are colours.
    let left_out = Sequence { place: Place::Disc, way: Way::RandomDelaunay };
    let shown = |r: &&Row| {
        r.contestant == CLAIMING[0] && r.boundary == r.sequence.place.boundaries()[0] && r.sequence != left_out
    };
    let rows: Vec<&Row> = all.iter().filter(shown).collect();
    let series = rows.iter().flat_map(|row| series(row, quantity, row.sequence.name())).collect();
    let title =
        format!("cotan, barycentric mass: {} against closed forms, with fitted and promised slope", quantity.name());
    Some(figure(&title, quantity, series, all))
}

/// The errors, named with their order, and the fitted line.
fn series(row: &Row, quantity: Quantity, name: &str) -> Option<[Series; 2]> {
    let levels = row.levels[quantity as usize].as_ref()?;
    let order = row.trend(quantity)?.order()?;
    let points = |l: &Size| l.errors.iter().map(|e| [l.h, *e]).collect::<Vec<_>>();
    let dots = Series::new(format!("{name}: {order}"), Mark::Dots, levels.iter().flat_map(points));
    Some([dots, Series::new(format!("fit, {name}"), Mark::Reference, fitted(levels, order.p))])
}

/// A chart of errors: the dots first, so that each sequence has a colour of its own, then the fitted lines and the promised slope.
fn figure(title: &str, quantity: Quantity, pairs: Vec<[Series; 2]>, rows: &[Row]) -> Figure {
    let (mut series, fits): (Vec<Series>, Vec<Series>) = pairs.into_iter().map(|[dots, fit]| (dots, fit)).unzip();
    series.extend(fits);
    let sizes: Vec<f64> = rows.iter().flat_map(|r| r.levels[quantity as usize].iter().flatten()).map(|l| l.h).collect();
    let (least, most) = sizes.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), h| (a.min(*h), b.max(*h)));
    let p = quantity.promised();
    let reference = [least, most].map(|h| [h, 0.5 * (h / most).powf(p)]);
    series.push(Series::new(format!("slope {p}"), Mark::Reference, reference));
    Figure::Chart(Chart {
        title: title.into(),
        x: Axis::logarithmic("mesh size h"),
        y: Axis::logarithmic("relative error"),
        series,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn setting(effort: Effort) -> Setting {
        Setting { seed: 1, effort }
    }

    #[test]
    fn the_operators_that_the_paper_denies_convergence_do_not_converge_and_cotan_does_by_the_same_rule() {
        let scaled = Contestant { scaled: true, ..CLAIMING[0] };
        let all: Vec<Contestant> = PLANTED.into_iter().chain([scaled, CLAIMING[0]]).collect();
        let rows = rows(&all, ONE_DIAGONAL, &[Boundary::Dirichlet], plan(&setting(Effort::Smoke))).unwrap();
        for row in &rows {
            for quantity in QUANTITIES {
                let Some(trend) = row.trend(quantity) else {
                    assert!(!row.notes.is_empty());
                    continue;
                };
                assert_eq!(
                    trend.converges(),
                    row.contestant.id == "cotan",
                    "{}: {} {trend}",
                    row.name(),
                    quantity.name()
                );
            }
        }
    }

    #[test]
    fn a_planted_operator_among_those_that_claim_turns_the_findings_round() {
        let graph = Contestant { scaled: false, ..PLANTED[0] };
        let rows =
            rows(&[CLAIMING[0], graph], ONE_DIAGONAL, &[Boundary::Dirichlet], plan(&setting(Effort::Smoke))).unwrap();
        for (quantity, part) in QUANTITIES.into_iter().zip(&ENTRY.parts[1..5]) {
            assert!(converges(&rows[..1], &[], quantity, part).agrees);
            let finding = converges(&rows, &[], quantity, part);
            assert!(!finding.agrees && finding.finding.contains("graph"), "{}", finding.finding);
        }
        assert!(!column(&rows, &[], "graph", ENTRY.parts[6]).agrees);
        assert!(!stays(&rows, "cotan", ENTRY.parts[8]).agrees);
        assert!(!column(&rows, &["refused".into()], "cotan", ENTRY.parts[6]).agrees);
    }
}
