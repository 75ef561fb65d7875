//! Statements about triangulations, spectra and smooth forms: true ones of every kind as the experiments find them, and what becomes of them when any
//! one number is changed.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use lapjury::experiment::{Effort, Setting, find};
use lapjury::property::recheck::{Rechecked, from_excerpt, kind};
use lapjury::property::{Evidence, Statement};
use serde_json::Value;

/// The evidence of the experiments that is decided without an operator, all of it.
pub fn evidence() -> &'static [Evidence] {
    static FOUND: OnceLock<Vec<Evidence>> = OnceLock::new();
    FOUND.get_or_init(|| {
        let experiments = [
            "negative-weights",
            "rippa-in-the-plane",
            "rippa-in-space",
            "tutte-embedding",
            "flips-in-the-plane",
            "flips-on-tori",
            "isospectral-graphs",
            "isospectral-drums",
            "spectral-rippa",
            "smooth-functions",
            "harmonic-forms",
        ];
        let setting = Setting { seed: 5, effort: Effort::Smoke };
        let found = experiments.iter().flat_map(|id| (find(id).unwrap().run)(&setting));
        found
            .flat_map(|f| f.evidence)
            .filter(|e| {
                matches!(
                    e.statement,
                    Statement::FlipsToDelaunay { .. }
                        | Statement::DelaunayNotMinimal { .. }
                        | Statement::PositiveExtension { .. }
                        | Statement::NotEmbedded { .. }
                        | Statement::TorusFlips { .. }
                        | Statement::Cospectral { .. }
                        | Statement::Transplantation { .. }
                        | Statement::SpectraDiffer { .. }
                        | Statement::DelaunayEigenvalue { .. }
                        | Statement::HarmonicForm { .. }
                )
            })
            .collect()
    })
}

/// The paths of all numbers, those written as text included.
pub fn numbers(value: &Value, at: &str, found: &mut Vec<String>) {
    match value {
        Value::Number(_) => found.push(at.into()),
        Value::String(text) if text.chars().all(|c| c.is_ascii_digit() || c == '/' || c == '-') => {
            found.push(at.into())
        }
        Value::Array(items) => items.iter().enumerate().for_each(|(k, v)| numbers(v, &format!("{at}/{k}"), found)),
        Value::Object(map) => map.iter().for_each(|(k, v)| numbers(v, &format!("{at}/{k}"), found)),
        _ => {}
    }
}

/// Some other numbers in place of one.
pub fn others(value: &Value) -> Vec<Value> {
    match value {
        Value::String(text) => {
            let (p, q) = text.split_once('/').unwrap_or((text, "1"));
            let p: i128 = p.parse().unwrap();
            vec![
                format!("{}/{q}", p + 1).into(),
                format!("{}/{}", 2 * p, format_args!("{}", 2 * q.parse::<i128>().unwrap())).into(),
                format!("{text}0").into(),
                (p + 1).to_string().into(),
                "".into(),
            ]
        }
        number => match number.as_i64().filter(|_| !number.is_f64()) {
            Some(n) => vec![(n + 1).into(), (n - 1).into(), (n + 1000).into()],
            None => {
                let x = number.as_f64().unwrap();
                vec![x.next_up().into(), (x + 1.0).into(), (x - 1.0).into(), 0.5.into(), 1e300.into()]
            }
        },
    }
}

#[test]
fn every_kind_is_verified_exactly_from_its_json_alone() {
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    for evidence in evidence() {
        let text = serde_json::to_string(evidence).unwrap();
        let read: Evidence = serde_json::from_str(&text).unwrap();
        assert_eq!(from_excerpt(&read), Ok(Rechecked::Exact), "{text}");
        *kinds.entry(kind(&evidence.statement)).or_default() += 1;
    }
    let expected = [
        ("cospectral", 4),
        ("delaunay-eigenvalue", 4),
        ("delaunay-not-minimal", 2),
        ("flips-to-delaunay", 3),
        ("harmonic-form", 3),
        ("not-embedded", 5),
        ("positive-extension", 1),
        ("spectra-differ", 1),
        ("torus-flips", 1),
        ("transplantation", 2),
    ];
    assert_eq!(kinds, BTreeMap::from(expected));
}

#[test]
fn a_single_changed_number_is_refused_wherever_it_stands() {
    let mut tried = 0;
    for evidence in evidence() {
        let original = serde_json::to_value(evidence).unwrap();
        let mut places = Vec::new();
        numbers(&original, "", &mut places);
        for place in places {
            for other in others(original.pointer(&place).unwrap()) {
                let mut value = original.clone();
                *value.pointer_mut(&place).unwrap() = other.clone();
                let Ok(changed) = serde_json::from_value::<Evidence>(value) else { continue };
                if changed == *evidence {
                    continue;
                }
                tried += 1;
                let answer = from_excerpt(&changed);
                assert!(answer.is_err(), "{place} = {other} in {original}: {answer:?}");
            }
        }
    }
    assert!(tried > 1000, "{tried}");
}

#[test]
fn a_list_cut_short_turned_round_or_doubled_is_never_a_panic_and_never_true_unless_it_says_the_same() {
    fn lists(value: &Value, at: &str, found: &mut Vec<String>) {
        match value {
            Value::Array(items) => {
                found.push(at.into());
                items.iter().enumerate().for_each(|(k, v)| lists(v, &format!("{at}/{k}"), found));
            }
            Value::Object(map) => map.iter().for_each(|(k, v)| lists(v, &format!("{at}/{k}"), found)),
            _ => {}
        }
    }
    for evidence in evidence() {
        let original = serde_json::to_value(evidence).unwrap();
        let mut places = Vec::new();
        lists(&original, "", &mut places);
        for place in places {
            for how in 0..4 {
                let mut value = original.clone();
                let list = value.pointer_mut(&place).unwrap().as_array_mut().unwrap();
                match how {
                    0 => drop(list.pop()),
                    1 => list.clear(),
                    2 => list.reverse(),
                    _ => list.extend(list.clone()),
                }
                if let Ok(changed) = serde_json::from_value::<Evidence>(value) {
                    let answer = from_excerpt(&changed);
                    // The order of tetrahedra and weights says nothing.
                    assert!(how == 2 || changed == *evidence || answer.is_err(), "{how} at {place} in {original}");
                }
            }
        }
    }
}
