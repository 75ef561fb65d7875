//! The experiments come out as the claims expect, their witnesses survive an independent look, and the claims name what
//! exists.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use lapjury::domain::{Domain, Surface, delaunay};
use lapjury::experiment::{ALL, Effort, Finding, Setting, find};
use lapjury::linalg::Csr;
use lapjury::linalg::factor::{Lu, symmetric_eigen};
use lapjury::property::evidence::Row;
use lapjury::property::recheck::{self, Rechecked};
use lapjury::property::{Evidence, Level, Statement};
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Claims {
    claim: Vec<Claim>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Claim {
    id: String,
    statement: String,
    source: String,
    section: String,
    expected: String,
    amendment: Option<String>,
    test: Vec<Test>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Test {
    form: String,
    experiment: Option<String>,
    part: Option<String>,
    quantifier: Option<String>,
    #[serde(default)]
    laplacians: Vec<String>,
    #[serde(default)]
    facts: Vec<String>,
    #[serde(default)]
    given: Vec<String>,
    #[serde(default)]
    then: Vec<String>,
}

fn claims() -> Vec<Claim> {
    [
        include_str!("../suites/claims/cheeger.toml"),
        include_str!("../suites/claims/smooth.toml"),
        include_str!("../suites/claims/graphs.toml"),
        include_str!("../suites/claims/discrete.toml"),
        include_str!("../suites/claims/no_free_lunch.toml"),
        include_str!("../suites/claims/taxonomy.toml"),
        include_str!("../suites/claims/coordinates.toml"),
        include_str!("../suites/claims/triangulations.toml"),
        include_str!("../suites/claims/isospectral.toml"),
        include_str!("../suites/claims/convergence.toml"),
    ]
    .into_iter()
    .flat_map(|text| toml::from_str::<Claims>(text).unwrap().claim)
    .collect()
}

fn findings(effort: Effort, seed: u64) -> BTreeMap<(&'static str, &'static str), Finding> {
    let of = |e: &'static lapjury::experiment::Experiment| {
        (e.run)(&Setting { seed, effort }).into_iter().map(move |f| ((e.id, f.part), f))
    };
    ALL.iter().copied().flat_map(of).collect()
}

/// The findings of one run, shared by the tests that only read them.
fn smoke() -> &'static BTreeMap<(&'static str, &'static str), Finding> {
    static RUN: OnceLock<BTreeMap<(&'static str, &'static str), Finding>> = OnceLock::new();
    RUN.get_or_init(|| findings(Effort::Smoke, 1))
}

/// Experiments that compute with rounding: all others decide exactly.
const MEASURED: [&str; 9] = [
    "cheeger-on-surfaces",
    "cheeger-sweep",
    "consistency",
    "convergence",
    "fourier-expansion",
    "isospectral-drums",
    "metric-from-cotangents",
    "point-cloud-consistency",
    "schwarz-lantern",
];

#[test]
fn every_experiment_answers_its_parts_in_their_order() {
    let setting = Setting { seed: 1, effort: Effort::Smoke };
    for experiment in ALL {
        assert_eq!(find(experiment.id).map(|e| e.id), Some(experiment.id));
        let findings = (experiment.run)(&setting);
        assert_eq!(findings.iter().map(|f| f.part).collect::<Vec<_>>(), experiment.parts, "{}", experiment.id);
        let exact = |f: &Finding| f.level == Level::Exact && f.open == 0;
        // A question with an exception is answered whatever else is left open.
        let measured = |f: &Finding| MEASURED.contains(&experiment.id) && (f.open == 0 || !f.agrees);
        assert!(findings.iter().all(|f| f.decided > 0 && (exact(f) || measured(f))), "{}", experiment.id);
        let again = findings.iter().all(|f| smoke()[&(experiment.id, f.part)] == *f);
        assert!(again, "{} is not deterministic", experiment.id);
    }
}

#[test]
fn the_claims_name_every_part_of_every_experiment_and_nothing_else() {
    let mut named = BTreeSet::new();
    for claim in claims() {
        for test in &claim.test {
            match (&test.experiment, &test.part) {
                (Some(experiment), Some(part)) => {
                    assert!(test.quantifier.is_none() && test.then.is_empty(), "{}", claim.id);
                    named.insert((experiment.clone(), part.clone()));
                }
                (None, None) => assert!(test.quantifier.is_some() && !test.then.is_empty(), "{}", claim.id),
                _ => panic!("{}: an experiment's test names both experiment and part", claim.id),
            }
        }
    }
    let parts = ALL.iter().flat_map(|e| e.parts.iter().map(|p| (e.id.to_string(), p.to_string())));
    assert_eq!(named, parts.collect());
}

#[test]
fn the_claims_are_complete_and_well_formed() {
    const PROPERTIES: [&str; 12] =
        ["NULL", "LOC", "SYM", "PSD", "KER", "POS", "POS0", "LIN", "MVP", "MAX-local", "MAX-global", "MAX-heat"];
    let claims = claims();
    let mut ids: Vec<&str> = claims.iter().map(|c| c.id.as_str()).collect();
    ids.sort_unstable();
    let expected = "c01 c02 c03 c04 c05 c06 c07 c09 c11 c12 c13 c15 c18 c19 c20 c21 c22 c23 c26 c27 c28 c29 c30 c31 c32 c33 c34 c35 c36 c37 c38 c39 c40 c41 c42 c43 c44 c45 c46 c47 c48 c49 c50 c51 c52 c67 c68 c70 c71 c72 c73 c74 c75 c76 c77 c78 c79 c80 c81 c82 c83 c84 c85 c86 c87 c88 c89 c90 c91 c92 c93 c94 c95 c96 c97 t01";
    assert_eq!(ids, expected.split(' ').collect::<Vec<_>>());
    for claim in &claims {
        assert!(!claim.statement.is_empty() && !claim.source.is_empty() && !claim.section.is_empty());
        assert!(["confirmed", "amended", "refuted"].contains(&claim.expected.as_str()));
        assert_eq!(claim.amendment.is_some(), claim.expected == "amended", "{}", claim.id);
        for test in &claim.test {
            assert!(["stated", "amended"].contains(&test.form.as_str()));
            assert!(test.quantifier.iter().all(|q| q == "every" || q == "some"));
            assert!(test.laplacians.iter().all(|l| l.chars().all(|c| c.is_ascii_lowercase() || c == '-')));
            for fact in &test.facts {
                assert!(lapjury::laplacian::Fact::ALL.iter().any(|f| f.name() == fact), "{}: {fact}", claim.id);
            }
            for condition in test.given.iter().chain(&test.then) {
                let (property, status) = condition.split_once(' ').unwrap();
                assert!(PROPERTIES.contains(&property) && ["holds", "fails"].contains(&status), "{condition}");
            }
        }
    }
}

#[test]
fn the_experiments_come_out_as_the_claims_expect() {
    for findings in [smoke(), &findings(Effort::Smoke, 2)] {
        for claim in claims() {
            let agree = |form: &str| {
                let tests = claim.test.iter().filter(|t| t.form == form);
                let answer = |t: &Test| {
                    let (experiment, part) = (find(t.experiment.as_deref()?)?, t.part.as_deref()?);
                    findings.iter().find(|((e, p), _)| *e == experiment.id && *p == part).map(|(_, f)| f.agrees)
                };
                tests.filter_map(answer).collect::<Vec<bool>>()
            };
            let (stated, amended) = (agree("stated"), agree("amended"));
            match claim.expected.as_str() {
                "confirmed" => assert!(stated.iter().all(|a| *a), "{}", claim.id),
                "amended" => {
                    assert!(stated.contains(&false), "{}: nothing shows that the amendment is needed", claim.id);
                    assert!(!amended.is_empty() && amended.iter().all(|a| *a), "{}", claim.id);
                }
                "refuted" => assert!(stated.contains(&false) && amended.is_empty(), "{}", claim.id),
                other => panic!("{}: no claim here is expected to be {other}", claim.id),
            }
        }
    }
}

/// Every witness again, from its excerpt alone: in floating point or by whole numbers, with other code than the experiments'.
#[test]
fn every_witness_survives_an_independent_look() {
    let mut kinds = BTreeSet::new();
    for ((experiment, part), finding) in smoke() {
        for evidence in &finding.evidence {
            let kind = look(evidence).unwrap_or_else(|why| panic!("{experiment}/{part}: {why}"));
            kinds.insert(kind);
            let text = serde_json::to_string(evidence).unwrap();
            assert_eq!(&serde_json::from_str::<Evidence>(&text).unwrap(), evidence);
        }
    }
    let of_matrices =
        ["asymmetry", "below-cheeger", "far", "moment", "negative-energy", "overshoot", "singular", "weight"];
    let of_weights = ["equilibrium", "lift", "motion", "no-lift"];
    let of_triangulations = ["extension", "flips", "not-embedded", "not-minimal", "torus"];
    let of_spectra = ["cospectral", "delaunay-eigenvalue", "spectra-differ", "transplantation"];
    let all =
        of_matrices.into_iter().chain(of_weights).chain(of_triangulations).chain(of_spectra).chain(["harmonic-form"]);
    assert_eq!(kinds, all.collect());
}

#[test]
fn the_independent_look_refuses_spoilt_witnesses() {
    for ((experiment, part), finding) in smoke() {
        for evidence in &finding.evidence {
            assert!(look(&spoilt(evidence)).is_err(), "{experiment}/{part}");
            let mut bare = evidence.clone();
            bare.excerpt.rows.clear();
            if evidence.excerpt.rows.is_empty() {
                (bare.excerpt.positions, bare.excerpt.faces) = (Vec::new(), Vec::new());
            }
            assert!(bare == *evidence || look(&bare).is_err(), "{experiment}/{part}");
        }
    }
}

/// The two smallest triangulations that a search came back with, judged again in floating point on the catalogue's matrix.
#[test]
fn the_triangulations_found_have_the_property_they_were_searched_for() {
    let cotan = |part| {
        let finding = &smoke()[&("negative-weights", part)];
        let Statement::Weight { i, j, zero: false, .. } = finding.evidence[0].statement else {
            panic!("not a negative weight")
        };
        let domain = Domain::from(triangulation(&finding.finding));
        let operator = lapjury::laplacian::find("cotan").unwrap().build(&domain, &BTreeMap::new()).unwrap();
        assert!(operator.stiffness().at(i, j) > 0.1);
        (domain, operator)
    };
    let (_, operator) = cotan("negative-interior-weight-and-psd");
    let (eigenvalues, _) = symmetric_eigen(operator.stiffness()).unwrap();
    assert!(eigenvalues[0].abs() < 1e-14 && eigenvalues[1] > 1e-3, "{eigenvalues:?}");
    let (domain, operator) = cotan("negative-weight-and-max");
    let (boundary, inside): (Vec<usize>, Vec<usize>) = (0..operator.size()).partition(|&v| domain.boundary()[v]);
    let entries = |i: usize| operator.stiffness().row(i).map(|(j, v)| (j, *v)).collect();
    let rows: Vec<Row> = inside.iter().map(|&row| Row { row, entries: entries(row) }).collect();
    for &source in &boundary {
        let u = harmonic(&rows, &boundary, source).unwrap();
        assert!(u.iter().all(|(_, value)| *value > 0.01 && *value < 1.0), "{source}: {u:?}");
    }
}

/// A witness whose excerpt no longer shows what it states.
fn spoilt(evidence: &Evidence) -> Evidence {
    let mut spoilt = evidence.clone();
    triangulations::spoil(&mut spoilt);
    spectra::spoil(&mut spoilt);
    forms::spoil(&mut spoilt);
    for row in &mut spoilt.excerpt.rows {
        match evidence.statement {
            Statement::Asymmetry { .. } | Statement::FarEntry { .. } => row.entries.retain(|e| e.0 == row.row),
            Statement::Singular { .. } => row.entries.push((row.row, 1.0)),
            Statement::BelowCheeger { .. } => {
                row.entries.iter_mut().for_each(|e| e.1 *= if e.0 == 0 { 64.0 } else { 1.0 })
            }
            _ => row.entries.iter_mut().for_each(|e| e.1 = if e.0 == row.row { e.1.abs() } else { -e.1.abs() }),
        }
    }
    if let Some((_, p)) = spoilt.excerpt.positions.last_mut().filter(|_| spoilt.excerpt.rows.is_empty()) {
        *p = p.map(|x| if x == 0.0 { x } else { -0.5 * x });
    }
    if let Statement::Weight { i, .. } | Statement::Moment { i, .. } = evidence.statement {
        spoilt.excerpt.rows.retain(|r| r.row != i);
    }
    spoilt
}

fn look(evidence: &Evidence) -> Result<&'static str, String> {
    let rows = &evidence.excerpt.rows;
    let row = |i: usize| rows.iter().find(|r| r.row == i).ok_or(format!("row {i} is missing"));
    let entry = |i: usize, j: usize| row(i).map(|r| r.entries.iter().find(|e| e.0 == j).map_or(0.0, |e| e.1));
    let is = |truth: bool, what: &str| if truth { Ok(()) } else { Err(what.to_string()) };
    match &evidence.statement {
        Statement::Weight { i, j, zero, .. } => {
            let l = entry(*i, *j)?;
            is(if *zero { l == 0.0 } else { l > 0.0 }, "the entry has another sign")?;
            is(row(*i)?.entries.iter().any(|e| e.0 == *i && e.1 > 0.0), "no positive diagonal")?;
            if !evidence.excerpt.faces.is_empty() {
                let surface = surface(evidence);
                let edge = surface.topology().edge_between(*i, *j).ok_or("no such edge")?;
                is(sums_to_zero(&row(*i)?.entries), "the row does not sum to zero")?;
                let sign = delaunay::weight_sign(&surface, edge).ok_or("degenerate")?;
                is(
                    sign == if *zero { std::cmp::Ordering::Equal } else { std::cmp::Ordering::Less },
                    "the mesh differs",
                )?;
            } else {
                is(sums_to_zero(&row(*i)?.entries), "the row does not sum to zero")?;
            }
            Ok("weight")
        }
        Statement::NegativeEnergy { x } => {
            let value = |k: usize| x.iter().find(|(i, _)| *i == k).map_or(0.0, |(_, v)| *v);
            let mut energy = 0.0;
            for (i, xi) in x {
                energy += xi * row(*i)?.entries.iter().map(|(j, l)| l * value(*j)).sum::<f64>();
            }
            is(energy < -1e-9, "the energy is not negative")?;
            Ok("negative-energy")
        }
        Statement::Overshoot { set, source, at, value, low } => {
            let u = harmonic(rows, set, *source)?;
            let found = u.iter().find(|(i, _)| i == at).ok_or("no value there")?.1;
            is((found - value).abs() < 1e-9 && if *low { found < 0.0 } else { found > 1.0 }, "another value")?;
            Ok("overshoot")
        }
        Statement::Singular { set, x } => {
            is(!x.is_empty() && x.iter().all(|(i, v)| *v != 0.0 && !set.contains(i)), "not a direction off the set")?;
            for (i, _) in x {
                row(*i)?;
            }
            let residual = |r: &Row| {
                let terms = r.entries.iter().filter_map(|(j, l)| x.iter().find(|(k, _)| k == j).map(|(_, v)| l * v));
                terms.sum::<f64>()
            };
            is(rows.iter().all(|r| residual(r) == 0.0), "not in the kernel")?;
            Ok("singular")
        }
        Statement::BelowCheeger { x, side } => {
            let n = rows.len();
            let value = |k: usize| x.iter().find(|(i, _)| *i == k).map_or(0.0, |(_, v)| *v);
            let weights: Vec<Vec<f64>> = (0..n)
                .map(|i| (0..n).map(|j| if i == j { 0.0 } else { -entry(i, j).unwrap_or(1.0) }).collect())
                .collect();
            let ratio = |inside: &dyn Fn(usize) -> bool| {
                let sum = |f: &dyn Fn(usize, usize) -> bool| -> f64 {
                    (0..n * n).filter(|k| f(k / n, k % n)).map(|k| weights[k / n][k % n]).sum()
                };
                let volume = sum(&|i, j| inside(i) && inside(j)).min(sum(&|i, j| !inside(i) && !inside(j)));
                if volume > 0.0 { sum(&|i, j| inside(i) && !inside(j)) / volume } else { f64::INFINITY }
            };
            let smallest =
                (1..(1_usize << n) - 1).map(|mask| ratio(&|v| mask >> v & 1 == 1)).fold(f64::INFINITY, f64::min);
            is((ratio(&|v| side.contains(&v)) - smallest).abs() < 1e-12, "another partition is better")?;
            let degree = |i: usize| weights[i].iter().sum::<f64>();
            let mean = (0..n).map(|i| degree(i) * value(i)).sum::<f64>() / (0..n).map(degree).sum::<f64>();
            let square: f64 = (0..n).map(|i| degree(i) * (value(i) - mean).powi(2)).sum();
            let energy: f64 =
                (0..n * n).map(|k| 0.5 * weights[k / n][k % n] * (value(k / n) - value(k % n)).powi(2)).sum();
            is(energy < 0.5 * smallest * smallest * square * (1.0 - 1e-12), "the vector is not below the bound")?;
            Ok("below-cheeger")
        }
        Statement::Asymmetry { i, j, threshold } => {
            is((entry(*i, *j)? - entry(*j, *i)?).abs() > *threshold, "the entries agree")?;
            Ok("asymmetry")
        }
        Statement::FarEntry { i, j, .. } => {
            is(entry(*i, *j)? != 0.0, "the entry is zero")?;
            let together = |f: &[usize]| f.contains(i) && f.contains(j);
            is(!evidence.excerpt.faces.iter().any(|(_, f)| together(f)), "they share a face")?;
            Ok("far")
        }
        Statement::Moment { i, axis, .. } => {
            let x = |v: usize| evidence.excerpt.positions.iter().find(|p| p.0 == v).map(|p| p.1[*axis]).unwrap();
            is(sums_to_zero(&row(*i)?.entries), "the row does not sum to zero")?;
            let moment: f64 = row(*i)?.entries.iter().map(|(j, l)| l * (x(*j) - x(*i))).sum();
            is(moment != 0.0, "the moment vanishes")?;
            Ok("moment")
        }
        // Looked at in floating point by the tests of these certificates; here by the recheck, which knows no experiment.
        Statement::Lift { .. }
        | Statement::Equilibrium { .. }
        | Statement::Motion { .. }
        | Statement::NoLift { .. }
        | Statement::Transplantation { .. } => match recheck::from_excerpt(evidence) {
            Ok(Rechecked::Exact) => Ok(recheck::kind(&evidence.statement)),
            other => Err(format!("{other:?}")),
        },
        Statement::Cospectral { .. } | Statement::SpectraDiffer { .. } | Statement::DelaunayEigenvalue { .. } => {
            spectra::look(evidence)
        }
        Statement::HarmonicForm { .. } => forms::look(evidence),
        _ => triangulations::look(evidence),
    }
}

#[path = "look/forms.rs"]
mod forms;
#[path = "look/spectra.rs"]
mod spectra;
#[path = "look/triangulations.rs"]
mod triangulations;

fn sums_to_zero(entries: &[(usize, f64)]) -> bool {
    let scale: f64 = entries.iter().map(|e| e.1.abs()).sum();
    entries.iter().map(|e| e.1).sum::<f64>().abs() <= 8.0 * f64::EPSILON * scale
}

fn surface(evidence: &Evidence) -> Surface {
    let positions = evidence.excerpt.positions.iter().map(|p| p.1).collect();
    Surface::new(positions, evidence.excerpt.faces.iter().map(|f| f.1.clone()).collect()).unwrap()
}

/// The triangulation that an answer describes: `… points (0, 0) (2, 1) …, triangles 0-1-2 …`. The excerpt of a witness has
/// only the faces that the witness speaks of.
fn triangulation(answer: &str) -> Surface {
    let numbers = |text: &str| -> Vec<usize> {
        text.split(|c: char| !c.is_ascii_digit()).filter_map(|word| word.parse().ok()).collect()
    };
    let (points, triangles) = answer.rsplit_once(" on points ").unwrap().1.split_once(", triangles ").unwrap();
    let positions = numbers(points).chunks(2).map(|p| [p[0] as f64, p[1] as f64, 0.0]).collect();
    Surface::new(positions, numbers(triangles).chunks(3).map(<[usize]>::to_vec).collect()).unwrap()
}

/// The harmonic function with value 1 at `source`, 0 on the rest of the set, by a sparse factorisation in floating point.
fn harmonic(rows: &[Row], set: &[usize], source: usize) -> Result<Vec<(usize, f64)>, String> {
    let inside: Vec<usize> = rows.iter().map(|r| r.row).filter(|i| !set.contains(i)).collect();
    let place = |v: usize| inside.iter().position(|i| *i == v);
    let (mut triplets, mut right) = (Vec::new(), vec![0.0; inside.len()]);
    for (at, &i) in inside.iter().enumerate() {
        for &(j, l) in rows.iter().filter(|r| r.row == i).flat_map(|r| &r.entries) {
            match place(j) {
                Some(column) => triplets.push((at, column, l)),
                None if j == source => right[at] = -l,
                None => {}
            }
        }
    }
    let mut solution = [right];
    let matrix = Csr::from_triplets(inside.len(), inside.len(), &triplets);
    Lu::new(&matrix).map_err(|e| e.to_string())?.solve(&mut solution);
    Ok(inside.into_iter().zip(solution[0].iter().copied()).collect())
}
