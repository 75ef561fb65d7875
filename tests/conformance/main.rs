//! Conformance: every construction on every domain that it accepts, every property of each, every piece of evidence through
//! JSON and recheck.

mod domains;
mod makers;

use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::LazyLock;

use domains::Place;
use lapjury::domain::Domain;
use lapjury::operator::Operator;
use lapjury::property::recheck::{Rechecked, from_excerpt, of_verdict};
use lapjury::property::{self, Property, Status, Trial, Verdict};
use makers::Maker;

/// What a construction came to on a domain: the verdicts of all properties, or the refusal.
struct Sitting {
    place: usize,
    maker: usize,
    result: Result<Vec<Verdict>, String>,
    /// What went against the rules, in words.
    breaches: Vec<String>,
}

struct Session {
    places: Vec<Place>,
    makers: Vec<Maker>,
    sittings: Vec<Sitting>,
}

/// Every construction on every domain of a kind that it accepts, once for all tests.
static SESSION: LazyLock<Session> = LazyLock::new(|| {
    let places = domains::all();
    let makers: Vec<Maker> = makers::catalogue().into_iter().chain(makers::defective()).collect();
    let sittings = (0..places.len() * makers.len())
        .map(|k| (k / makers.len(), k % makers.len()))
        .map(|(place, maker)| sit(&places[place], &makers[maker], place, maker))
        .collect();
    Session { places, makers, sittings }
});

impl Session {
    fn name(&self, sitting: &Sitting) -> String {
        format!("'{}' on '{}'", self.makers[sitting.maker].label, self.places[sitting.place].name)
    }

    fn assert_no_breach(&self) {
        let told = |s: &Sitting| s.breaches.iter().map(|b| format!("{}: {b}", self.name(s))).collect::<Vec<_>>();
        let breaches: Vec<String> = self.sittings.iter().flat_map(told).collect();
        assert!(breaches.is_empty(), "{} breaches:\n{}", breaches.len(), breaches.join("\n"));
    }
}

fn sit(place: &Place, maker: &Maker, at: usize, by: usize) -> Sitting {
    let attempt = catch_unwind(AssertUnwindSafe(|| {
        let mut breaches = Vec::new();
        let result = maker.build(&place.domain).map(|operator| {
            check_shape(maker, &place.domain, &operator, &mut breaches);
            judge(maker, &place.domain, &operator, &mut breaches)
        });
        (result, breaches)
    }));
    let (result, breaches) = attempt.unwrap_or_else(|_| (Err("panic".into()), vec!["it panicked".into()]));
    Sitting { place: at, maker: by, result, breaches }
}

fn check_shape(maker: &Maker, domain: &Domain, operator: &Operator, breaches: &mut Vec<String>) {
    if operator.size() != domain.vertex_count() {
        breaches.push(format!("{} rows for {} vertices", operator.size(), domain.vertex_count()));
    }
    let matrices = [Some(operator.stiffness()), operator.mass().map(|m| m.matrix())];
    let finite = matrices.iter().flatten().all(|m| m.entries().all(|(_, _, v)| v.is_finite()));
    if maker.entry.is_some() && !finite {
        breaches.push("an entry is not finite".into());
    }
}

fn judge(maker: &Maker, domain: &Domain, operator: &Operator, breaches: &mut Vec<String>) -> Vec<Verdict> {
    let (trial, facts) = (Trial::new(domain, operator, 1).unwrap(), domain.facts());
    let construction = |d: &Domain| maker.build(d);
    let decide = |property: &&'static Property| {
        let verdict = property.decide(&trial, Some(&construction));
        let promised = maker.entry.and_then(|e| e.promises_with(property.id, &facts, &maker.settings));
        if promised == Some(true) && verdict.status() == Status::Fails {
            breaches.push(format!("{} is promised and fails: {verdict:?}", property.id));
        }
        if let Err(breach) = check_evidence(&verdict, property.id, domain, operator) {
            breaches.push(format!("{}: {breach}: {verdict:?}", property.id));
        }
        verdict
    };
    property::ALL.iter().map(decide).collect()
}

/// Evidence must survive JSON and the recheck; what is true of the whole operator must not be refused on its excerpt alone.
fn check_evidence(verdict: &Verdict, property: &str, domain: &Domain, operator: &Operator) -> Result<(), String> {
    let text = serde_json::to_string(verdict).map_err(|e| e.to_string())?;
    let read: Verdict = serde_json::from_str(&text).map_err(|e| e.to_string())?;
    if read != *verdict {
        return Err("JSON changes it".into());
    }
    let answer = of_verdict(&read, property, domain, operator).map_err(|e| format!("recheck refuses: {e}"))?;
    match (read.evidence(), answer) {
        (None, None) => Ok(()),
        (Some(_), None) | (None, Some(_)) => Err("evidence and recheck do not go together".into()),
        (Some(_), Some(Rechecked::Open(why))) if why.is_empty() => Err("open without a reason".into()),
        (Some(evidence), Some(_)) => {
            from_excerpt(evidence).map(|_| ()).map_err(|e| format!("true, but refused on its excerpt alone: {e}"))
        }
    }
}

#[test]
fn nothing_panics_promises_are_kept_and_all_evidence_is_true() {
    SESSION.assert_no_breach();
}

#[test]
fn kinds_that_an_entry_does_not_accept_are_refused_and_no_others() {
    for sitting in &SESSION.sittings {
        let (maker, place) = (&SESSION.makers[sitting.maker], &SESSION.places[sitting.place]);
        let Some(entry) = maker.entry else { continue };
        let accepted = entry.accepts.contains(&place.domain.kind());
        match &sitting.result {
            Ok(_) => assert!(accepted, "{} was accepted", SESSION.name(sitting)),
            Err(refusal) => {
                assert!(refusal.len() > 20, "{}: {refusal}", SESSION.name(sitting));
                let by_kind = refusal.contains("is not defined on") || refusal.contains("is defined on");
                assert!(accepted || by_kind, "{}: {refusal}", SESSION.name(sitting));
            }
        }
    }
    assert!(!domains::clouds().is_empty());
}

#[test]
fn every_construction_builds_on_every_sound_domain_of_its_kind() {
    let weights_given = |m: &Maker| m.settings.get("weights").map_or(m.label.starts_with("weighted"), |w| w == "given");
    let mut built = BTreeSet::new();
    for sitting in &SESSION.sittings {
        let (maker, place) = (&SESSION.makers[sitting.maker], &SESSION.places[sitting.place]);
        let Some(entry) = maker.entry else { continue };
        if sitting.result.is_ok() {
            built.insert(maker.label.clone());
        }
        let surface = place.domain.as_surface().is_some_and(|s| s.is_triangulated());
        // Flips need two faces at an edge.
        let manifold = entry.id != "intrinsic-delaunay" || !place.name.starts_with("fan");
        // Positive weights need a plane, and need not exist there.
        let manifold = manifold && entry.id != "optimal-positive";
        // Four or eight points about a centre have no tangent planes, and slivers reach no further than they are wide.
        let manifold = manifold && entry.id != "point-cloud-heat";
        let generated = domains::GENERATED.contains(&place.name.as_str());
        let sound = generated && surface && manifold && !weights_given(maker);
        if sound && entry.accepts.contains(&place.domain.kind()) {
            assert!(sitting.result.is_ok(), "{}: {:?}", SESSION.name(sitting), sitting.result.as_ref().err());
        }
    }
    let makers: BTreeSet<String> =
        SESSION.makers.iter().filter(|m| m.entry.is_some()).map(|m| m.label.clone()).collect();
    assert_eq!(built, makers, "every construction builds somewhere");
}

#[test]
fn every_property_is_seen_holding_and_seen_failing() {
    let mut seen: BTreeMap<(&str, Status), usize> = BTreeMap::new();
    for verdicts in SESSION.sittings.iter().filter_map(|s| s.result.as_ref().ok()) {
        for (property, verdict) in property::ALL.iter().zip(verdicts) {
            *seen.entry((property.id, verdict.status())).or_default() += 1;
        }
    }
    let count = |id: &'static str, status| seen.get(&(id, status)).copied().unwrap_or(0);
    let line = |p: &&Property| {
        let all = [Status::Holds, Status::Fails, Status::Undecided, Status::NotApplicable].map(|s| count(p.id, s));
        format!("{:13} holds {:5} fails {:5} undecided {:5} not applicable {:5}", p.id, all[0], all[1], all[2], all[3])
    };
    let table = property::ALL.iter().map(line).collect::<Vec<_>>().join("\n");
    println!("{table}");
    let both = |p: &Property| count(p.id, Status::Holds) > 0 && count(p.id, Status::Fails) > 0;
    assert!(property::ALL.iter().copied().all(both), "a checker that was not seen deciding both ways:\n{table}");
}

#[test]
fn a_relation_between_constructions_says_nothing_of_a_matrix_alone() {
    let place = &domains::all()[0];
    let operator = makers::catalogue()[0].build(&place.domain).unwrap();
    let trial = Trial::new(&place.domain, &operator, 1).unwrap();
    let silent = property::ALL.iter().filter(|p| p.decide(&trial, None).status() == Status::NotApplicable);
    let silent: BTreeSet<&str> = silent.map(|p| p.id).collect();
    for id in ["PERM", "RIGID", "SCALE", "ISO", "REACH", "UNION"] {
        assert!(silent.contains(id), "{id}");
    }
}
