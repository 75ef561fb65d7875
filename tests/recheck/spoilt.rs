//! Witnesses with one thing changed, each refused.

use lapjury::property::evidence::Which;
use lapjury::property::{Evidence, Statement};

use crate::Example;
use crate::operators::{operator, rows};
use crate::witnesses::{all, named};

macro_rules! spoil {
    ($name:expr, $( $what:expr => $pattern:pat => $change:expr );+ $(;)?) => {{
        let e = named($name);
        $( e.assert_refused($what, |evidence| match &mut evidence.statement { $pattern => $change, _ => unreachable!() }); )+
        e
    }};
}

fn spoil_row(e: &Example, at: usize) {
    e.assert_refused("an entry changed", |v| {
        let entry = &mut v.excerpt.rows[at].entries[0].1;
        *entry = entry.next_up();
    });
    e.assert_refused("an entry dropped", |v| {
        let row = &mut v.excerpt.rows[at].entries;
        row.truncate(row.len() - 1);
    });
    e.assert_refused("a column moved", |v| v.excerpt.rows[at].entries.last_mut().unwrap().0 += 1_000_000_000_000);
    e.assert_refused("a row moved", |v| v.excerpt.rows[at].row += 1);
    e.assert_refused("a row twice", |v| {
        let row = v.excerpt.rows[at].clone();
        v.excerpt.rows.push(row);
    });
}

#[test]
fn spoilt_witnesses_about_entries_are_refused() {
    spoil!("not finite",
        "row" => Statement::NotFinite { i, .. } => *i = 3;
        "row far out" => Statement::NotFinite { i, .. } => *i = usize::MAX;
        "value" => Statement::NotFinite { value, .. } => *value = "inf".into();
        "a number" => Statement::NotFinite { value, .. } => *value = "1".into();
        "matrix" => Statement::NotFinite { matrix, .. } => *matrix = Which::Mass);
    let e = spoil!("far entry",
        "a neighbour" => Statement::FarEntry { j, .. } => *j = 4;
        "no entry" => Statement::FarEntry { j, .. } => *j = 3;
        "itself" => Statement::FarEntry { j, .. } => *j = 0;
        "rings" => Statement::FarEntry { rings, .. } => *rings = Some(3);
        "not connected" => Statement::FarEntry { rings, .. } => *rings = None;
        "another row" => Statement::FarEntry { i, .. } => *i = 1);
    spoil_row(&e, 0);
    e.assert_refused("a face dropped", |v| drop(v.excerpt.faces.pop()));
    e.assert_refused("a face renamed", |v| v.excerpt.faces[0].0 = 1);
    spoil!("entry between components",
        "rings" => Statement::FarEntry { rings, .. } => *rings = Some(2);
        "neighbour" => Statement::FarEntry { j, .. } => *j = 0;
        "row" => Statement::FarEntry { i, .. } => *i = 2);
    let e = spoil!("asymmetry",
        "threshold" => Statement::Asymmetry { threshold, .. } => *threshold = 0.5;
        "negative threshold" => Statement::Asymmetry { threshold, .. } => *threshold = -1.0;
        "symmetric pair" => Statement::Asymmetry { i, .. } => *i = 1;
        "the diagonal" => Statement::Asymmetry { i, .. } => *i = 4);
    spoil_row(&e, 1);
    let e = spoil!("row sum",
        "threshold" => Statement::RowSum { threshold, .. } => *threshold = 0.25;
        "infinite threshold" => Statement::RowSum { threshold, .. } => *threshold = f64::INFINITY;
        "row" => Statement::RowSum { i, .. } => *i = 2);
    spoil_row(&e, 0);
    spoil!("kernel vector",
        "not in the kernel" => Statement::KernelVector { x, .. } => x.push((0, 1.0));
        "nearly in the kernel" => Statement::KernelVector { x, threshold, .. } => { x.push((0, 1e-3)); *threshold = 1.0 };
        "constant" => Statement::KernelVector { a, .. } => *a = 0;
        "too small" => Statement::KernelVector { x, .. } => x[0].1 = 0.999;
        "out of range" => Statement::KernelVector { x, .. } => x[0].0 = usize::MAX;
        "zero" => Statement::KernelVector { x, .. } => x.clear();
        "twice" => Statement::KernelVector { x, .. } => x.push((2, 1.0)));
    let e = spoil!("negative energy",
        "a sign" => Statement::NegativeEnergy { x } => x[0].1 = -1.0;
        "a component dropped" => Statement::NegativeEnergy { x } => drop(x.pop());
        "empty" => Statement::NegativeEnergy { x } => x.clear();
        "infinite" => Statement::NegativeEnergy { x } => x[0].1 = f64::INFINITY;
        "index" => Statement::NegativeEnergy { x } => x[1].0 = 7);
    spoil_row(&e, 0);
}

#[test]
fn spoilt_witnesses_about_weights_are_refused() {
    let e = spoil!("negative weight",
        "zero" => Statement::Weight { zero, .. } => *zero = true;
        "another edge" => Statement::Weight { j, .. } => *j = 2;
        "an angle" => Statement::Weight { opposite, .. } => opposite[0].angle_deg += 1e-5;
        "a corner" => Statement::Weight { opposite, .. } => opposite[0].vertex = 3;
        "a corner dropped" => Statement::Weight { opposite, .. } => drop(opposite.pop());
        "a loop" => Statement::Weight { j, .. } => *j = 0);
    spoil_row(&e, 0);
    e.assert_refused("a face dropped", |v| drop(v.excerpt.faces.pop()));
    e.assert_refused("a position", |v| v.excerpt.positions[2].1[1] = 1.0_f64.next_up());
    e.assert_refused("a position dropped", |v| v.excerpt.positions.retain(|p| p.0 != 3));
    e.assert_refused("a face twice", |v| {
        let face = v.excerpt.faces[0].clone();
        v.excerpt.faces.push(face);
    });
    spoil!("zero weight",
        "negative" => Statement::Weight { zero, .. } => *zero = false;
        "another edge" => Statement::Weight { j, .. } => *j = 4;
        "no edge" => Statement::Weight { j, .. } => *j = 2;
        "an angle" => Statement::Weight { opposite, .. } => opposite[0].angle_deg = 89.0);
    spoil!("negative weight of a graph",
        "zero" => Statement::Weight { zero, .. } => *zero = true;
        "a loop" => Statement::Weight { j, .. } => *j = 1;
        "an absent row" => Statement::Weight { i, j, .. } => (*i, *j) = (0, 1));
    let e = spoil!("both signs",
        "positive" => Statement::BothSigns { positive, .. } => *positive = 0;
        "negative" => Statement::BothSigns { negative, .. } => *negative = 2;
        "itself" => Statement::BothSigns { negative, .. } => *negative = 4;
        "row" => Statement::BothSigns { i, .. } => *i = 0);
    spoil_row(&e, 0);
    let e = spoil!("no weight",
        "row" => Statement::NoWeight { i } => *i = 0;
        "out of range" => Statement::NoWeight { i } => *i = 99);
    spoil_row(&e, 0);
    let e = spoil!("negative share",
        "column" => Statement::NotConvex { j, .. } => *j = 1;
        "the diagonal" => Statement::NotConvex { j, .. } => *j = 4;
        "row" => Statement::NotConvex { i, .. } => *i = 1);
    spoil_row(&e, 0);
    // With the diagonal negative every positive weight has a negative share, so other columns stay true.
    let e = spoil!("negative diagonal",
        "row" => Statement::NotConvex { i, .. } => *i = 0;
        "absent" => Statement::NotConvex { i, j } => (*i, *j) = (9, 9));
    spoil_row(&e, 0);
}

#[test]
fn spoilt_witnesses_about_coordinates_are_refused() {
    let e = spoil!("moment inside",
        "threshold" => Statement::Moment { threshold, .. } => *threshold = 0.5;
        "row" => Statement::Moment { i, .. } => *i = 0;
        "axis" => Statement::Moment { axis, .. } => *axis = 2;
        "no axis" => Statement::Moment { axis, .. } => *axis = 3;
        "one axis" => Statement::Moment { axes, .. } => *axes = [1, 1];
        "on the boundary" => Statement::Moment { boundary, .. } => *boundary = Some([3, 1]));
    spoil_row(&e, 0);
    e.assert_refused("a position", |v| v.excerpt.positions[0].1[0] = f64::MIN_POSITIVE);
    e.assert_refused("a position dropped", |v| v.excerpt.positions.retain(|p| p.0 != 1));
    let e = spoil!("moment on the boundary",
        "threshold" => Statement::Moment { threshold, .. } => *threshold = 1.0;
        "turned" => Statement::Moment { boundary, .. } => *boundary = Some([1, 3]);
        "not next" => Statement::Moment { boundary, .. } => *boundary = Some([3, 4]);
        "mirrored" => Statement::Moment { axes, .. } => *axes = [1, 0];
        "inside" => Statement::Moment { boundary, .. } => *boundary = None;
        "normal" => Statement::Moment { axis, .. } => *axis = 2);
    spoil_row(&e, 0);
    let e = spoil!("energy in the plane",
        "threshold" => Statement::Energy { threshold, .. } => *threshold = 4.0;
        "found" => Statement::Energy { found, .. } => *found = 8.1;
        "expected" => Statement::Energy { expected, .. } => *expected = 4.1;
        "normal axis" => Statement::Energy { axis, .. } => *axis = 2;
        "off the diagonal" => Statement::Energy { axis, .. } => *axis = 0;
        "trace" => Statement::Energy { trace, .. } => *trace = true;
        "star" => Statement::Energy { star, .. } => *star = 5);
    spoil_row(&e, 2);
    e.assert_refused("a face", |v| v.excerpt.faces[1].1.swap(0, 1));
    spoil!("energy in space",
        "threshold" => Statement::Energy { threshold, .. } => *threshold = 16.0;
        "found" => Statement::Energy { found, .. } => *found = 12.001;
        "expected" => Statement::Energy { expected, .. } => *expected *= 0.5;
        "a plane" => Statement::Energy { trace, .. } => *trace = false);
}

#[test]
fn spoilt_witnesses_about_solutions_are_refused() {
    let e = spoil!("below zero",
        "value" => Statement::Overshoot { value, .. } => *value = -0.50001;
        "high" => Statement::Overshoot { low, .. } => *low = false;
        "another source" => Statement::Overshoot { source, .. } => *source = 1;
        "source outside" => Statement::Overshoot { source, .. } => *source = 2;
        "at the set" => Statement::Overshoot { at, .. } => *at = 1;
        "out of range" => Statement::Overshoot { at, .. } => *at = usize::MAX;
        "a smaller set" => Statement::Overshoot { set, .. } => drop(set.pop());
        "a set with repetition" => Statement::Overshoot { set, .. } => set.push(0));
    spoil_row(&e, 0);
    spoil!("above one",
        "low" => Statement::Overshoot { low, .. } => *low = true;
        "value" => Statement::Overshoot { value, .. } => *value = 1.0;
        "another source" => Statement::Overshoot { source, .. } => *source = 0);
    let e = spoil!("no equation",
        "not in the kernel" => Statement::Singular { x, .. } => x.push((0, 1.0));
        "zero" => Statement::Singular { x, .. } => x[0].1 = 0.0;
        "index" => Statement::Singular { x, .. } => x[0].0 = 3;
        "a smaller set" => Statement::Singular { set, .. } => drop(set.pop()));
    spoil_row(&e, 0);
    let e = spoil!("heat that makes cold",
        "value" => Statement::HeatLoss { value, .. } => *value = -0.3334;
        "backwards" => Statement::HeatLoss { t, .. } => *t = -1.0;
        "another time" => Statement::HeatLoss { t, .. } => *t = 2.0;
        "where it was" => Statement::HeatLoss { at, .. } => *at = 1;
        "out of range" => Statement::HeatLoss { source, .. } => *source = 5);
    spoil_row(&e, 1);
    e.assert_refused("a mass", |v| v.excerpt.mass_rows[0].entries[0].1 = 2.0);
}

#[test]
fn spoilt_witnesses_about_masses_are_refused() {
    let e = spoil!("total mass",
        "threshold" => Statement::MassTotal { threshold, .. } => *threshold = 1.0;
        "found" => Statement::MassTotal { found, .. } => *found = 5.1;
        "expected" => Statement::MassTotal { expected, .. } => *expected = 3.9);
    e.assert_refused("a mass", |v| v.excerpt.mass_rows[2].entries[0].1 = 2.0);
    e.assert_refused("a face", |v| v.excerpt.faces[0].1[0] = 3);
    let e = spoil!("mass asymmetry",
        "threshold" => Statement::MassAsymmetry { threshold, .. } => *threshold = 0.125;
        "the diagonal" => Statement::MassAsymmetry { j, .. } => *j = 0;
        "an absent row" => Statement::MassAsymmetry { i, .. } => *i = 2);
    e.assert_refused("a row dropped", |v| drop(v.excerpt.mass_rows.pop()));
    let e = spoil!("mass not positive",
        "a sign" => Statement::MassNotPositive { x } => x[0].1 = -1.0;
        "a component" => Statement::MassNotPositive { x } => drop(x.pop());
        "zero" => Statement::MassNotPositive { x } => x.clear();
        "NaN" => Statement::MassNotPositive { x } => x[1].1 = f64::NAN);
    e.assert_refused("a row dropped", |v| drop(v.excerpt.mass_rows.pop()));
    let e = spoil!("mass share",
        "lower" => Statement::MassShare { lower, .. } => *lower = 0.1;
        "bounds of nothing known" => Statement::MassShare { lower, upper, .. } => (*lower, *upper) = (3.0, 4.0);
        "turned bounds" => Statement::MassShare { lower, upper, .. } => (*lower, *upper) = (2.0, 1.0);
        "another vertex" => Statement::MassShare { i, .. } => *i = 0);
    e.assert_refused("a face dropped", |v| drop(v.excerpt.faces.pop()));
    let e = spoil!("inaccurate weight",
        "threshold" => Statement::Inaccurate { threshold, .. } => *threshold = 0.5;
        "exact weight" => Statement::Inaccurate { exact, .. } => *exact = 1.001;
        "error" => Statement::Inaccurate { error, .. } => *error = 0.6;
        "another edge" => Statement::Inaccurate { j, .. } => *j = 1;
        "no edge" => Statement::Inaccurate { j, .. } => *j = 0);
    e.assert_refused("a face dropped", |v| drop(v.excerpt.faces.pop()));
    e.assert_refused("all faces dropped", |v| v.excerpt.faces.clear());
    e.assert_refused("a position moved", |v| v.excerpt.positions[1].1[0] = 5.0);
    spoil!("changed entry",
        "before" => Statement::Changed { before, .. } => *before = -1.0001;
        "after" => Statement::Changed { after, .. } => *after = -1.0;
        "threshold" => Statement::Changed { threshold, .. } => *threshold = 3.0;
        "no transformation" => Statement::Changed { transformation, .. } => transformation.clear();
        "another entry" => Statement::Changed { j, .. } => *j = 0;
        "out of range" => Statement::Changed { i, .. } => *i = 5;
        "no mass" => Statement::Changed { matrix, .. } => *matrix = Which::Mass);
    let e = spoil!("below cheeger",
        "a constant" => Statement::BelowCheeger { x, .. } => *x = vec![(0, 1.0), (1, 1.0), (2, 1.0), (3, 1.0)];
        "no vector" => Statement::BelowCheeger { x, .. } => x.clear();
        "a vertex alone" => Statement::BelowCheeger { side, .. } => drop(side.pop());
        "a vertex twice" => Statement::BelowCheeger { side, .. } => *side = vec![1, 1];
        "another graph's vertex" => Statement::BelowCheeger { side, .. } => side[0] = 7;
        "no side" => Statement::BelowCheeger { side, .. } => side.clear());
    spoil_row(&e, 0);
}

#[test]
fn a_defect_of_the_last_bit_is_no_witness() {
    // ⅓ + ⅓ + ⅓ rounds to 1; exactly it misses 1 by 2⁻⁵⁴.
    let third = 1.0 / 3.0;
    let o = operator(4, &[(0, 0, 1.0), (0, 1, -third), (0, 2, -third), (0, 3, -third)]);
    let evidence = Evidence::new(Statement::RowSum { i: 0, threshold: 0.0 }, rows(&o, &[0]));
    let refusal = lapjury::property::recheck::from_excerpt(&evidence).unwrap_err();
    assert!(refusal.to_string().contains("one rounding"), "{refusal}");
}

#[test]
fn a_witness_of_another_property_is_refused() {
    for mut e in all() {
        e.property = if e.property == "ENERGY" { "SYM" } else { "ENERGY" };
        let refusal = e.against(&e.evidence).unwrap_err();
        assert!(refusal.to_string().contains("decides nothing about"), "{}: {refusal}", e.name);
    }
}

#[test]
fn a_witness_of_an_unknown_property_is_decided_for_what_it_states() {
    let mut e = named("asymmetry");
    e.property = "MY-OWN";
    assert_eq!(e.against(&e.evidence), Ok(lapjury::property::recheck::Rechecked::Exact));
    e.assert_refused("threshold", |v| match &mut v.statement {
        Statement::Asymmetry { threshold, .. } => *threshold = 9.0,
        _ => unreachable!(),
    });
}
