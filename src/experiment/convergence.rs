//! What converges under refinement, at which order, and what does not: eigenvalues, eigenspaces and solutions of Poisson's
//! equation on domains where all of them are known, for every operator of which the catalogue promises or denies it (CON).
//!
//! The rule that decides is that of [`limit::order`](super::limit::order), the smooth problems those of
//! [`limit::place`](super::limit::place). Structured meshes have no noise: there an error that does not clearly converge is an exception. Where
//! meshes are drawn it is one if it clearly does not; if noise hides that, the case is open, and with it the question. A finite
//! number of meshes proves no limit: the level is "measured", but for the completeness of the spectra, which is certified.

use rayon::prelude::*;

use super::limit::chart;
use super::limit::contest::{Contestant, Plan, QUANTITIES, Quantity, Row, by_size, denied, promised, rows};
use super::limit::hodge;
use super::limit::mesh::Mesh;
use super::limit::order::{Level as Size, Trend, judge};
use super::limit::place::{Boundary, Place};
use super::limit::sequence::{ALL, Sequence, Way, is_quick};
use super::poll::{Case, Every, Search};
use super::{Effort, Experiment, Finding, Setting};
use crate::property::Level;

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "convergence",
    name: "Convergence of eigenvalues, eigenspaces and solutions",
    statement: "every operator of which the catalogue promises CON, with every mass for which it does, on refined squares, discs, flat tori, \
                spheres and cubes: structured; random (Delaunay in the plane); flipped, with angles up to 150°. Dirichlet and natural \
                boundary. Eigenvalues, eigenspaces and solutions of Poisson's equation against closed forms, with the order of each \
                error and its interval. Every operator of which the catalogue denies CON, under the same rule",
    sources: &["wardetzky-primer", "wardetzky2007", "dziuk1988", "strang-fix1973", "babuska-aziz1976"],
    parts: &[
        "spectra-are-complete",
        "eigenvalues-converge",
        "eigenspaces-converge",
        "poisson-converges-in-l2",
        "poisson-converges-in-energy",
        "orders-reach-the-theory",
        "cotan-converges",
        "graph-does-not-converge",
        "mean-value-does-not-converge",
        "every-denial-is-shown",
        "hodge-components-converge",
    ],
    run,
};

/// The sequence on which operators fail: one diagonal in every cell, so that one direction is not like the other.
const ONE_DIAGONAL: Sequence = Sequence { place: Place::Square, way: Way::Structured };

/// The closed surface with harmonic forms.
const TORUS: Sequence = Sequence { place: Place::Torus, way: Way::Structured };

fn plan(setting: &Setting) -> Plan {
    let seed = setting.seed;
    match setting.effort {
        Effort::Smoke => Plan { sizes: &[(8, 8), (16, 6), (32, 4)], solid: &[(4, 1), (6, 1), (9, 1)], seed },
        Effort::Full => Plan { sizes: &[(8, 10), (16, 10), (32, 5)], solid: &[(8, 10), (12, 6), (17, 2)], seed },
    }
}

/// Who plays: on structured sequences all that are promised; on the others `cotan` with every mass and the operators that have no choice but the
/// mass, with the barycentric one (`orthogonal-dual` with zero weights is `cotan`); fewer and on fewer sequences for a quick look.
fn plays(contestant: &Contestant, sequence: Sequence, effort: Effort) -> bool {
    let plain = contestant.mass() == "barycentric";
    let other = plain && contestant.given.is_empty();
    match effort {
        Effort::Full => other || contestant.entry.id == "cotan" || !sequence.is_random(),
        Effort::Smoke if sequence.is_random() => plain && is_quick(sequence),
        Effort::Smoke => plain || contestant.name() == "cotan:mass=consistent",
    }
}

/// What was measured.
struct Study {
    /// Operators that are promised to converge.
    kept: Vec<Row>,
    /// Operators that are not, on [`ONE_DIAGONAL`].
    denied: Vec<Row>,
    /// What was refused, in words: it speaks against every statement about all meshes.
    refused: Vec<String>,
}

impl Study {
    fn run(setting: &Setting) -> Self {
        let mut study = Study { kept: Vec::new(), denied: Vec::new(), refused: Vec::new() };
        let (promised, denied) = (promised(), denied());
        for &sequence in ALL {
            let measure = || {
                let playing =
                    promised.iter().filter(|c| plays(c, sequence, setting.effort)).cloned().collect::<Vec<_>>();
                if playing.is_empty() {
                    return Ok((Vec::new(), Vec::new()));
                }
                let meshes = plan(setting).meshes(sequence)?;
                let kept = rows(&playing, sequence, &meshes, sequence.place.boundaries(), true)?;
                let others = if sequence == ONE_DIAGONAL { denied.as_slice() } else { &[] };
                Ok((kept, rows(others, sequence, &meshes, &[Boundary::Dirichlet], true)?))
            };
            match measure() {
                Ok((kept, denied)) => {
                    study.kept.extend(kept);
                    study.denied.extend(denied);
                }
                Err::<_, String>(why) => study.refused.push(format!("{}: {why}", sequence.name())),
            }
        }
        study
    }

    /// A poll that what was refused speaks against.
    fn every(&self) -> Every {
        let mut every = Every::default();
        self.refused.iter().for_each(|why| every.ask(Some(Case::told(why.clone()))));
        every
    }
}

fn run(setting: &Setting) -> Vec<Finding> {
    let study = Study::run(setting);
    let mut findings = vec![complete(&study)];
    findings.extend(QUANTITIES.into_iter().zip(&ENTRY.parts[1..5]).map(|(q, part)| converges(&study, q, part)));
    findings.push(theory(&study));
    findings.push(column(&study, "cotan", ENTRY.parts[6]));
    findings.push(stays(&study, "graph", ENTRY.parts[7]));
    findings.push(stays(&study, "mean-value", ENTRY.parts[8]));
    findings.push(denials(&study));
    findings.push(hodge(setting));
    findings[1..].iter_mut().for_each(|f| f.level = Level::Measured);
    findings[0].level = Level::Bounded;
    findings
}

fn complete(study: &Study) -> Finding {
    let mut every = study.every();
    for row in study.kept.iter().chain(&study.denied) {
        if let Some(certified) = row.certified {
            every.ask((!certified).then(|| Case::told(row.name())));
        }
    }
    every.answer(
        ENTRY.parts[0],
        "Does an inertia count certify that every spectrum compared is complete, with residuals below a hundredth of its error?",
        "sequences of spectra",
    )
}

fn converges(study: &Study, quantity: Quantity, part: &'static str) -> Finding {
    let mut every = study.every();
    let mut without = Vec::new();
    for row in &study.kept {
        match row.trend(quantity) {
            Some(trend) => ask(&mut every, row, quantity, trend),
            None => without.push(format!("{} ({})", row.name(), row.note.as_deref().unwrap_or("nothing measured"))),
        }
    }
    let question = format!(
        "Do the errors of {} fall at every size, with the whole interval of their order above ½?",
        quantity.name()
    );
    let mut finding = every.answer(part, question, "operators on sequences with a boundary condition");
    finding.finding +=
        &format!("; orders, from the least to the largest over the operators: {}", orders(study, quantity));
    if let Some(first) = without.first() {
        finding.finding += &format!("; {} have none, the first: {first}", without.len());
    }
    finding.figures.push(chart::convergence(&study.kept, quantity));
    finding
}

/// Whether a case speaks against convergence, and where noise hides it.
fn ask(every: &mut Every, row: &Row, quantity: Quantity, trend: Trend) {
    match trend.is_open() && row.sequence.is_random() {
        true => every.leave_open(told(row, quantity, trend).text),
        false => every.ask((!trend.converges()).then(|| told(row, quantity, trend))),
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
fn orders(study: &Study, quantity: Quantity) -> String {
    let mut texts = Vec::new();
    for sequence in ALL {
        for boundary in sequence.place.boundaries() {
            let mine = study.kept.iter().filter(|r| r.sequence == *sequence && r.boundary == *boundary);
            let mut found: Vec<_> = mine.filter_map(|r| r.trend(quantity)?.order()).collect();
            found.sort_by(|a, b| a.p.total_cmp(&b.p));
            if let [least, .., most] = found[..] {
                texts.push(format!("{}, {}: {least} to {most}", sequence.name(), boundary.name()));
            }
        }
    }
    texts.join("; ")
}

/// Where the theory of linear elements promises an order: a mass exact on linear functions, angles bounded.
fn theory(study: &Study) -> Finding {
    let mut every = study.every();
    let exact = |row: &&Row| ["barycentric", "consistent"].contains(&row.contestant.mass());
    for row in study.kept.iter().filter(exact).filter(|r| !r.sequence.is_random()) {
        for quantity in QUANTITIES {
            if let Some(trend) = row.trend(quantity) {
                every.ask((!trend.reaches(quantity.promised())).then(|| told(row, quantity, trend)));
            }
        }
    }
    every.answer(
        ENTRY.parts[5],
        "Is the order that the theory promises, 2 and in energy 1, within the interval or nearer than the next lower one, for barycentric \
         and consistent mass on structured sequences, whose angles are bounded?",
        "quantities",
    )
}

/// The cell CON of an operator: every quantity on every sequence.
fn column(study: &Study, id: &str, part: &'static str) -> Finding {
    let mut every = study.every();
    for row in study.kept.iter().filter(|r| r.contestant.entry.id == id) {
        for quantity in QUANTITIES {
            if let Some(trend) = row.trend(quantity) {
                ask(&mut every, row, quantity, trend);
            }
        }
    }
    every.answer(
        part,
        format!("Does every quantity of {id} that there is converge on every sequence, with every mass but unit?"),
        "quantities on sequences",
    )
}

/// The quantities whose errors stay, though the operator is given the best factor.
fn staying(row: &Row) -> impl Iterator<Item = (Quantity, Trend)> {
    let trends = QUANTITIES.into_iter().filter_map(|q| Some((q, row.trend(q)?)));
    trends.filter(|(_, trend)| trend.levels_off())
}

fn stays(study: &Study, id: &str, part: &'static str) -> Finding {
    let mut search = Search::default();
    for row in study.denied.iter().filter(|r| r.contestant.entry.id == id) {
        for quantity in QUANTITIES {
            let Some(trend) = row.trend(quantity) else { continue };
            search.ask(trend.levels_off().then(|| told(row, quantity, trend)));
        }
    }
    search.answer(
        part,
        format!(
            "Does an error of {id} level off, up to the best factor, on squares whose cells all have the same diagonal?"
        ),
        "quantities",
    )
}

fn denials(study: &Study) -> Finding {
    let mut every = study.every();
    let mut texts = Vec::new();
    for row in &study.denied {
        let found: Vec<(Quantity, Trend)> = staying(row).collect();
        every.ask(found.is_empty().then(|| Case::told(row.name())));
        let named = found.iter().map(|(quantity, _)| quantity.name()).collect::<Vec<_>>();
        texts.push(format!("{}: {}", row.contestant.name(), named.join(", ")));
    }
    let mut finding = every.answer(
        ENTRY.parts[9],
        "Does some error level off, up to the best factor, for every operator of which the catalogue says that it need not converge?",
        "operators",
    );
    finding.finding += &format!("; what stays: {}", texts.join("; "));
    finding.figures.push(chart::staying(&study.denied));
    finding
}

/// The parts of a 1-form on the closed sequences.
fn hodge(setting: &Setting) -> Finding {
    let mut every = Every::default();
    let (mut texts, mut shown) = (Vec::new(), Vec::new());
    for &sequence in ALL.iter().filter(|s| s.place == Place::Sphere || **s == TORUS) {
        match parts(sequence, setting) {
            Err(why) => every.ask(Some(Case::told(format!("{}: {why}", sequence.name())))),
            Ok(parts) => {
                for (part, levels) in parts {
                    let trend = judge(&levels);
                    let case = format!("{part} on {}: {trend}", sequence.name());
                    match trend.is_open() && sequence.is_random() {
                        true => every.leave_open(case.clone()),
                        false => every.ask((!trend.reaches(1.0)).then(|| Case::told(case.clone()))),
                    }
                    shown.extend(chart::pair(&levels, &format!("{part}, {}", sequence.name())));
                    texts.push(case);
                }
            }
        }
    }
    let mut finding = every.answer(
        ENTRY.parts[10],
        "Do exact, coexact and harmonic part of a 1-form converge in L², the order nearer to 1 than to 0?",
        "parts on closed sequences",
    );
    finding.finding += &format!("; {}", texts.join("; "));
    finding.figures.push(chart::figure("Hodge decomposition of a 1-form: the parts in L²", 1.0, shown));
    finding
}

/// The errors of each part that there is, by size.
fn parts(sequence: Sequence, setting: &Setting) -> Result<Vec<(&'static str, Vec<Size>)>, String> {
    let meshes = plan(setting).meshes(sequence)?;
    let all: Vec<&Mesh> = meshes.iter().flatten().collect();
    let found = all.par_iter().map(|mesh| hodge::errors(mesh)).collect::<Result<Vec<_>, String>>()?;
    let part = |(k, name)| Some((name, by_size(&meshes, &found, |errors| errors[k])?));
    Ok(hodge::PARTS.into_iter().enumerate().filter_map(part).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operator::Mass;

    fn smoke() -> Setting {
        Setting { seed: 1, effort: Effort::Smoke }
    }

    fn measured(contestants: &[Contestant], sequence: Sequence) -> Vec<Row> {
        let meshes = plan(&smoke()).meshes(sequence).unwrap();
        rows(contestants, sequence, &meshes, &sequence.place.boundaries()[..1], true).unwrap()
    }

    fn study(kept: Vec<Row>, denied: Vec<Row>, refused: &[&str]) -> Study {
        Study { kept, denied, refused: refused.iter().map(|w| w.to_string()).collect() }
    }

    #[test]
    fn the_operators_that_the_paper_denies_convergence_do_not_converge_and_cotan_does_by_the_same_rule() {
        let cotan = Contestant::of("cotan").unwrap();
        let scaled = Contestant { scaled: true, ..cotan.clone() };
        let all: Vec<Contestant> = denied().into_iter().chain([scaled, cotan]).collect();
        for row in measured(&all, ONE_DIAGONAL) {
            for quantity in QUANTITIES {
                let Some(trend) = row.trend(quantity) else {
                    assert!(row.note.is_some());
                    continue;
                };
                let expected = row.contestant.entry.id == "cotan";
                assert_eq!(trend.converges(), expected, "{}: {} {trend}", row.name(), quantity.name());
            }
        }
    }

    /// Faults planted among the operators that are promised to converge: graph weights, the unit mass, twice the stiffness (which is what
    /// the three-point family is for p = 2).
    #[test]
    fn a_planted_operator_turns_every_finding_round_that_speaks_of_it() {
        let cotan = Contestant::of("cotan").unwrap();
        let faults = [
            Contestant::of("graph").unwrap(),
            cotan.clone().with("mass", "unit"),
            Contestant::of("three-point").unwrap().with("p", "2"),
        ];
        for (fault, sequence) in faults.iter().flat_map(|f| [ONE_DIAGONAL, ALL[1]].map(|s| (f, s))) {
            let all = measured(&[cotan.clone(), fault.clone()], sequence);
            let (first, both) = all.split_at(1);
            let of = |quantity: Quantity| both[0].trend(quantity);
            assert!(QUANTITIES.iter().any(|q| of(*q).is_some_and(|t| t.levels_off())), "{}", fault.name());
            assert!(first.iter().all(|row| QUANTITIES.iter().all(|q| row.trend(*q).unwrap().converges())));
            let both = study(all, Vec::new(), &[]);
            for (quantity, part) in QUANTITIES.into_iter().zip(&ENTRY.parts[1..5]) {
                let Some(trend) = both.kept[1].trend(quantity) else { continue };
                let finding = converges(&both, quantity, part);
                assert_eq!(finding.agrees, trend.converges(), "{}", finding.finding);
                assert!(finding.agrees || finding.finding.contains(&fault.name()), "{}", finding.finding);
            }
        }
    }

    /// An error that falls at first and stays at one per cent is no noise where meshes are structured.
    #[test]
    fn a_mass_that_is_wrong_by_one_per_cent_is_an_exception() {
        let meshes = plan(&smoke()).meshes(ONE_DIAGONAL).unwrap();
        let cotan = Contestant::of("cotan").unwrap();
        let spaces = Place::Square.eigenspaces(Boundary::Dirichlet);
        let error = |mesh: &Mesh, factor: f64| {
            let operator = cotan.build(mesh).unwrap();
            let mass = operator.mass().unwrap().matrix().map(|_, _, m| factor * m);
            let spaces: Vec<_> = spaces.iter().map(|s| s.at(mesh)).collect();
            let operator = operator.with_mass(Mass::full(crate::operator::MassKind::Given, mass.clone())).unwrap();
            super::super::limit::spectra::gaps(&operator, &mass, mesh, Boundary::Dirichlet, &spaces, false)
                .unwrap()
                .values
        };
        for (factor, agrees) in [(1.0, true), (1.01, false), (0.99, false)] {
            let level = |size: &Vec<Mesh>| Size { h: size[0].h, errors: vec![error(&size[0], factor)] };
            let mut row = measured(std::slice::from_ref(&cotan), ONE_DIAGONAL).remove(0);
            row.levels[0] = Some(meshes.iter().map(level).collect());
            let finding = converges(&study(vec![row], Vec::new(), &[]), Quantity::Values, ENTRY.parts[1]);
            assert_eq!((finding.agrees, finding.decided), (agrees, 1), "{factor}: {}", finding.finding);
        }
    }

    #[test]
    fn a_wrong_order_a_wrong_spectrum_and_a_refusal_are_seen() {
        let row = || measured(&[Contestant::of("cotan").unwrap()], ONE_DIAGONAL).remove(0);
        assert!(theory(&study(vec![row()], Vec::new(), &[])).agrees);
        // The errors in energy, of order 1, in the place of those in L², which are promised order 2.
        let mut wrong = row();
        wrong.levels[2] = wrong.levels[3].clone();
        assert!(!theory(&study(vec![wrong], Vec::new(), &[])).agrees);
        // The spectrum of another place: the errors against the natural spectrum do not fall.
        let sequence = Sequence { place: Place::Disc, way: Way::Structured };
        let meshes = plan(&smoke()).meshes(sequence).unwrap();
        let spaces = Place::Disc.eigenspaces(Boundary::Natural);
        let gap = |mesh: &Mesh| {
            let operator = Contestant::of("cotan").unwrap().build(mesh).unwrap();
            let mass = operator.mass().unwrap().matrix().clone();
            let spaces: Vec<_> = spaces.iter().map(|s| s.at(mesh)).collect();
            super::super::limit::spectra::gaps(&operator, &mass, mesh, Boundary::Dirichlet, &spaces, false)
                .unwrap()
                .values
        };
        let levels: Vec<Size> = meshes.iter().map(|m| Size { h: m[0].h, errors: vec![gap(&m[0])] }).collect();
        assert!(judge(&levels).levels_off());
        assert!(!column(&study(vec![row()], Vec::new(), &["refused"]), "cotan", ENTRY.parts[6]).agrees);
        assert!(!stays(&study(Vec::new(), vec![row()], &[]), "cotan", ENTRY.parts[7]).agrees);
        assert!(!denials(&study(Vec::new(), vec![row()], &[])).agrees);
    }
}
