//! Correct operators on thousands of domains: no promised property may fail, and none may be undecided where all angles are at
//! least one degree.
//!
//! The operators take turns on the classes of domains; each is judged on every property that the catalogue promises of it on that
//! domain, relations between constructions included. On domains of more than [`STRUCTURAL`] vertices the relations and what
//! solves or factorises are left out.

use std::collections::BTreeMap;
use std::path::Path;

use rayon::prelude::*;

use super::draw::{self, Draw};
use super::{CampaignError, Options};
use crate::domain::{Domain, DomainKind, Facts};
use crate::property::{self, Status, Trial, Verdict};
use crate::record::alarms::{ALARMS_SCHEMA, AlarmLine, AlarmTally, Alarms};
use crate::suite::{Choice, Recipe, RecipeError};

/// Beyond this many vertices only properties that look at each entry once are asked.
pub const STRUCTURAL: usize = 2_000;

/// The smallest angle, in degrees, from which on conditioning is no excuse.
const HEALTHY_DEGREES: f64 = 1.0;

/// The most lines of each kind that are kept.
const MOST_LINES: usize = 200;

/// The operators on surfaces.
const ON_SURFACES: [&str; 13] = [
    "cotan",
    "intrinsic-delaunay",
    "mean-value",
    "cotan:mass=mixed",
    "wachspress",
    "three-point:p=0.5",
    "cotan:mass=consistent",
    "intrinsic-delaunay:mass=voronoi",
    "graph",
    "cotan:mass=voronoi",
    "weighted-graph:weights=inverse-length",
    "normalized-graph",
    "three-point:p=1.5",
];

/// The operators on graphs.
const ON_GRAPHS: [&str; 4] = ["graph", "weighted-graph", "normalized-graph", "normalized-graph:form=random-walk"];

/// What one case came to.
struct Case {
    class: &'static str,
    vertices: usize,
    healthy: bool,
    operator: &'static str,
    /// Each promised property: its id, the status, and what it says if that should not be.
    verdicts: Vec<(&'static str, Status, Option<AlarmLine>)>,
    refused: bool,
}

/// Runs the first `cases` cases of a seed.
///
/// # Errors
/// A recipe that makes no domain, threads that cannot be started.
pub fn run(cases: usize, options: &Options) -> Result<Alarms, CampaignError> {
    let pool = options.pool()?;
    let mut tallies: BTreeMap<(&str, &str, &str), AlarmTally> = BTreeMap::new();
    let mut alarms = Alarms {
        schema: ALARMS_SCHEMA,
        version: env!("CARGO_PKG_VERSION").into(),
        seed: options.seed,
        cases,
        vertices: [usize::MAX, 0],
        ..Alarms::default()
    };
    // In pieces: memory does not grow with the number of cases.
    for start in (0..cases).step_by(10_000) {
        let piece = start..cases.min(start + 10_000);
        let sat: Vec<Result<Case, CampaignError>> =
            pool.install(|| piece.into_par_iter().with_max_len(16).map(|case| sit(case, options)).collect());
        for case in sat {
            take_in(case?, &mut alarms, &mut tallies);
        }
    }
    alarms.tallies = tallies.into_values().collect();
    alarms.vertices[0] = alarms.vertices[0].min(alarms.vertices[1]);
    Ok(alarms)
}

fn take_in<'a>(case: Case, alarms: &mut Alarms, tallies: &mut BTreeMap<(&'a str, &'a str, &'a str), AlarmTally>) {
    alarms.healthy_cases += usize::from(case.healthy);
    alarms.refused += usize::from(case.refused);
    alarms.vertices = [alarms.vertices[0].min(case.vertices), alarms.vertices[1].max(case.vertices)];
    for (property, status, line) in case.verdicts {
        let tally = tallies.entry((case.operator, property, case.class)).or_insert_with(|| AlarmTally {
            operator: case.operator.into(),
            property: property.into(),
            class: case.class.into(),
            ..AlarmTally::default()
        });
        let list = match status {
            Status::Holds => {
                tally.holds += 1;
                continue;
            }
            Status::NotApplicable => {
                tally.not_applicable += 1;
                continue;
            }
            Status::Fails => {
                tally.fails += 1;
                &mut alarms.alarms
            }
            Status::Undecided => {
                tally.undecided += 1;
                tally.undecided_healthy += usize::from(case.healthy);
                if !case.healthy {
                    continue;
                }
                &mut alarms.open
            }
        };
        list.extend(line.filter(|_| list.len() < MOST_LINES));
    }
}

/// Makes the domain of a case, builds its operator and decides what is promised.
fn sit(case: usize, options: &Options) -> Result<Case, CampaignError> {
    let Draw { class, recipe } = draw::draw(options.seed, case);
    let (recipe, domain) = domain(recipe, &options.root)?;
    let facts = domain.facts();
    let healthy = facts.surface.as_ref().is_none_or(|s| s.min_angle_deg >= HEALTHY_DEGREES && s.degenerate_faces == 0);
    let turn = case / draw::classes();
    let operator = match domain.kind() {
        DomainKind::Surface if facts.vertices > STRUCTURAL => ON_SURFACES[turn % 7],
        DomainKind::Surface => ON_SURFACES[turn % ON_SURFACES.len()],
        _ => ON_GRAPHS[turn % ON_GRAPHS.len()],
    };
    let failed = |error: String| CampaignError::Domain { name: recipe.clone(), error };
    let choice: Choice = operator.parse().map_err(|e: crate::suite::ChoiceError| failed(e.to_string()))?;
    let verdicts = judge(&choice, &domain, &facts, options.seed).map(|verdicts| {
        let line = |property: &str, verdict: &Verdict| AlarmLine {
            recipe: recipe.clone(),
            class: class.into(),
            operator: operator.into(),
            property: property.into(),
            says: says(verdict),
            replay: format!("lapjury check --domain '{recipe}' --laplacian {operator} --property {property}"),
        };
        let told = |(property, verdict): (&'static str, Verdict)| {
            let status = verdict.status();
            let telling = status == Status::Fails || status == Status::Undecided && healthy;
            (property, status, telling.then(|| line(property, &verdict)))
        };
        verdicts.into_iter().map(told).collect::<Vec<_>>()
    });
    let refused = verdicts.is_none();
    Ok(Case { class, vertices: facts.vertices, healthy, operator, verdicts: verdicts.unwrap_or_default(), refused })
}

/// Makes the domain. A last modifier that refuses its domain (no edge of a fan can be flipped) is left out.
fn domain(mut recipe: String, root: &Path) -> Result<(String, Domain), CampaignError> {
    loop {
        let made = recipe.parse::<Recipe>().and_then(|parsed| parsed.build(root));
        match (made, recipe.rfind(" | ")) {
            (Ok(domain), _) => return Ok((recipe, domain)),
            (Err(RecipeError::Generate(_)), Some(modifier)) => recipe.truncate(modifier),
            (Err(error), _) => return Err(CampaignError::Domain { name: recipe, error: error.to_string() }),
        }
    }
}

/// The verdicts on what the catalogue promises; `None` where the construction refuses the domain.
fn judge(choice: &Choice, domain: &Domain, facts: &Facts, seed: u64) -> Option<Vec<(&'static str, Verdict)>> {
    let operator = choice.build(domain).ok()?;
    let trial = Trial::new(domain, &operator, seed).ok()?;
    let construction = |domain: &Domain| choice.build(domain).map_err(|refusal| refusal.to_string());
    let solves = ["KER", "PSD", "MVP", "MAX-global", "MAX-heat"];
    let promised = property::ALL
        .iter()
        .filter(|p| choice.promises(p.id, facts) == Some(true))
        .filter(|p| facts.vertices <= STRUCTURAL || !p.is_relation() && !solves.contains(&p.id));
    Some(promised.map(|p| (p.id, p.decide(&trial, Some(&construction)))).collect())
}

/// What a verdict that should not be says.
fn says(verdict: &Verdict) -> String {
    match verdict.evidence() {
        Some(evidence) => format!("{:?}, margin {:?}", evidence.statement, verdict.margin),
        None => verdict.reason().unwrap_or_default().to_string(),
    }
}
