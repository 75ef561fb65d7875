//! Every fault on every mesh: who catches it?
//!
//! # What counts
//! A fault is planted in the cotangent Laplacian (on graphs in the graph Laplacian). A property takes part where the correct operator
//! has it, or is promised it and rounding leaves it open; it catches the fault if it fails on the spoilt operator.
//! * *caught*: one of the properties that must catch it fails. They see matrix and mesh alone.
//! * *compared*: the fault says that no property can see it on such a mesh, and an entry differs from the correct one by more
//!   than any correct implementation explains.
//! * *undecided*: no entry differs by as much, or a property that must catch it is undecided now and was not before.
//! * *within rounding*: no entry differs by more than the rounding of two good implementations explains.
//! * *missed*: an entry differs by more, and nothing that must see it does.
//!
//! The change is measured by the comparison, property by property the verdicts are made without it: the two do not know of
//! each other. Faults of the mass are planted twice, in a mass that says which one it is and in one that does not.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::pool::{Place, Size, places};
use super::{CampaignError, Options};
use crate::domain::{Domain, DomainKind, Facts};
use crate::external::{compare, compare_mass};
use crate::fault::{self, Fault, Planting};
use crate::operator::{Mass, MassKind, Operator};
use crate::property::{self, Property, Status, Trial};
use crate::record::planted::{FaultLine, MeshLine, PLANTED_SCHEMA, Planted, PlantingLine, PlantingResult};
use crate::suite::Choice;

/// Beyond this many vertices the properties that factorise are asked only where the fault names them.
const FACTORISED: usize = 150;

/// Every property that is about one operator, those that solve for harmonic functions left out: the others see the same.
pub fn jury() -> Vec<&'static Property> {
    let solves = ["MAX-global", "MAX-heat"];
    property::ALL.iter().copied().filter(|p| !p.is_relation() && !solves.contains(&p.id)).collect()
}

/// Plants every fault on every mesh of a pool.
///
/// # Errors
/// A mesh that cannot be made, threads that cannot be started.
pub fn run(size: Size, options: &Options) -> Result<Planted, CampaignError> {
    let faults: Vec<&Fault> = fault::all().collect();
    try_faults(&faults, &places(size), &jury(), size.name(), options)
}

/// The same for some faults, meshes and properties.
///
/// # Errors
/// As [`run`].
pub fn try_faults(
    faults: &[&Fault],
    places: &[Place],
    jury: &[&'static Property],
    size: &str,
    options: &Options,
) -> Result<Planted, CampaignError> {
    let pool = options.pool()?;
    let sat: Vec<Result<(MeshLine, Vec<PlantingLine>), CampaignError>> = pool.install(|| {
        let each = places.par_iter().with_max_len(1);
        each.map(|place| Ok(sit(place, &place.domain(&options.root)?, faults, jury, options.seed))).collect()
    });
    let mut planted = Planted {
        schema: PLANTED_SCHEMA,
        version: env!("CARGO_PKG_VERSION").into(),
        size: size.into(),
        seed: options.seed,
        faults: faults.iter().map(|f| line(f)).collect(),
        ..Planted::default()
    };
    for result in sat {
        let (mesh, plantings) = result?;
        planted.meshes.push(mesh);
        planted.plantings.extend(plantings);
    }
    Ok(planted)
}

fn line(fault: &Fault) -> FaultLine {
    FaultLine {
        id: fault.id.into(),
        what: fault.what.into(),
        class: fault.class.name().into(),
        caught_by: fault.caught_by.iter().map(|p| p.to_string()).collect(),
        blind: fault.blind.iter().map(|b| b.text()).collect(),
    }
}

/// A correct operator, and what the jury says of it.
struct Host<'a> {
    label: String,
    operator: Operator,
    declared: bool,
    domain: &'a Domain,
    facts: &'a Facts,
    correct: BTreeMap<&'static str, Status>,
}

/// Every fault on one mesh.
fn sit(
    place: &Place,
    domain: &Domain,
    faults: &[&Fault],
    jury: &[&'static Property],
    seed: u64,
) -> (MeshLine, Vec<PlantingLine>) {
    let facts = domain.facts();
    let hosts = hosts(domain, &facts, jury, seed);
    let mesh = MeshLine {
        name: place.name.clone(),
        class: place.class.into(),
        vertices: facts.vertices,
        min_angle_deg: facts.surface.as_ref().map(|s| s.min_angle_deg),
        digest: domain.digest(),
    };
    let mut lines = Vec::new();
    for fault in faults {
        // Faults of the stiffness are planted in the first host alone, those of a mass where there is such a mass.
        let wanted = |(at, host): &(usize, &Host)| if fault.is_of_mass() { host.has_mass_of(fault) } else { *at == 0 };
        lines.extend(hosts.iter().enumerate().filter(wanted).map(|(_, host)| PlantingLine {
            fault: fault.id.into(),
            mesh: place.name.clone(),
            class: place.class.into(),
            operator: host.label.clone(),
            declared: host.declared,
            result: host.plant(fault, jury, seed),
        }));
    }
    (mesh, lines)
}

/// The operators that faults are planted in: with every mass that is positive, which says so or does not.
fn hosts<'a>(domain: &'a Domain, facts: &'a Facts, jury: &[&'static Property], seed: u64) -> Vec<Host<'a>> {
    let labels: &[&str] = match domain.kind() {
        DomainKind::Surface => {
            &["cotan:degenerate=skip", "cotan:degenerate=skip,mass=mixed", "cotan:degenerate=skip,mass=consistent"]
        }
        _ => &["graph"],
    };
    let mut hosts = Vec::new();
    for (label, declared) in labels.iter().flat_map(|l| [(l, true), (l, false)]) {
        // What the catalogue does not build on a mesh is not spoilt there.
        let Ok(choice) = label.parse::<Choice>() else { continue };
        let Ok(operator) = choice.build(domain) else { continue };
        let mut host = Host { label: (*label).into(), operator, declared, domain, facts, correct: BTreeMap::new() };
        let promised = |p: &&'static Property| choice.promises(p.id, facts) == Some(true);
        let seen = host.seen(&host.operator);
        for &property in jury {
            let status = host.decide(property, &seen, seed);
            let takes_part = status == Some(Status::Holds) || promised(&property) && status == Some(Status::Undecided);
            if let (Some(status), true) = (status, takes_part) {
                host.correct.insert(property.id, status);
            }
        }
        hosts.push(host);
    }
    hosts
}

impl Host<'_> {
    fn has_mass_of(&self, fault: &Fault) -> bool {
        self.operator.mass().is_some_and(|m| fault.masses.contains(&m.kind()))
    }

    /// What the jury sees of an operator: as a matrix from elsewhere, its mass unlabelled unless it is declared.
    fn seen(&self, operator: &Operator) -> Operator {
        let bare = Operator::new(operator.stiffness().clone(), operator.provenance().clone());
        let kind = |m: &Mass| if self.declared { m.kind() } else { MassKind::Given };
        let mass = operator.mass().map(|m| Mass::full(kind(m), m.matrix().clone()));
        match (bare, mass) {
            (Ok(bare), Some(mass)) => bare.with_mass(mass).unwrap_or_else(|_| operator.clone()),
            (Ok(bare), None) => bare,
            (Err(_), _) => operator.clone(),
        }
    }

    fn decide(&self, property: &Property, operator: &Operator, seed: u64) -> Option<Status> {
        let trial = Trial::new(self.domain, operator, seed).ok()?;
        Some(property.decide(&trial, None).status())
    }

    /// Plants a fault and looks who catches it.
    fn plant(&self, fault: &Fault, jury: &[&'static Property], seed: u64) -> PlantingResult {
        let spoilt = match fault.plant(self.domain, &self.operator, seed) {
            Planting::NotHere(why) => return PlantingResult::NotHere(why.into()),
            Planting::Unchanged => return PlantingResult::Unchanged,
            Planting::Spoilt(spoilt) => spoilt,
        };
        let (mut failing, mut open) = (Vec::new(), Vec::new());
        let seen = self.seen(&spoilt);
        if let Ok(trial) = Trial::new(self.domain, &seen, seed) {
            for property in jury {
                let Some(before) = self.correct.get(property.id) else { continue };
                let named = fault.caught_by.contains(&property.id);
                let factorises = matches!(property.id, "KER" | "PSD");
                if factorises && !named && self.facts.vertices > FACTORISED {
                    continue;
                }
                match property.decide(&trial, None).status() {
                    Status::Fails => failing.push(property.id),
                    Status::Undecided if named && *before != Status::Undecided => open.push(property.id),
                    _ => {}
                }
            }
        }
        let words = |list: &[&str]| list.iter().map(|id| id.to_string()).collect::<Vec<_>>();
        if let Some(by) = fault.caught_by.iter().find(|id| failing.contains(id)) {
            failing.retain(|id| id != by);
            return PlantingResult::Caught { by: by.to_string(), also: words(&failing) };
        }
        let change = self.change(&spoilt);
        if change.beyond > 0 && fault.is_hidden(self.facts, self.declared) {
            PlantingResult::Compared { beyond: change.beyond }
        } else if change.beyond > 0 && open.is_empty() {
            PlantingResult::Missed { beyond: change.beyond, others: words(&failing) }
        } else if change.open > 0 || !open.is_empty() {
            PlantingResult::Undecided { by: words(&open), open: change.open }
        } else {
            PlantingResult::WithinRounding
        }
    }

    /// How the spoilt matrices differ from the correct ones.
    fn change(&self, spoilt: &Operator) -> Change {
        let stiffness = compare(self.domain, spoilt, &self.operator, &self.label);
        let mass = match (spoilt.mass(), self.operator.mass()) {
            (Some(theirs), Some(ours)) => Some(compare_mass(self.domain, theirs, ours, &self.label)),
            _ => None,
        };
        Change {
            beyond: stiffness.beyond + mass.as_ref().map_or(0, |m| m.beyond),
            open: stiffness.open + mass.as_ref().map_or(0, |m| m.open),
        }
    }
}

/// How many entries differ by more than any correct implementation explains, and by more than two good ones do.
struct Change {
    beyond: usize,
    open: usize,
}
