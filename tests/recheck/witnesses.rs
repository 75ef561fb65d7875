//! A true witness of every kind.

use lapjury::domain::Domain;
use lapjury::operator::Operator;
use lapjury::property::evidence::{Corner, Which};
use lapjury::property::{Evidence, Excerpt, Statement};

use crate::operators::*;
use crate::{Example, Expected, Expected::*};

fn example(
    name: &'static str,
    property: &'static str,
    (domain, operator): (Domain, Operator),
    statement: Statement,
    excerpt: Excerpt,
    (alone, held_against): (Expected, Expected),
) -> Example {
    Example { name, property, domain, operator, evidence: Evidence::new(statement, excerpt), alone, held_against }
}

pub fn all() -> Vec<Example> {
    [of_entries(), of_weights(), of_coordinates(), of_solutions(), of_masses(), of_graphs()]
        .into_iter()
        .flatten()
        .collect()
}

fn of_entries() -> Vec<Example> {
    let nan = operator(5, &with(square_cotan(), &[(0, 1, f64::NAN)]));
    let far = operator(5, &with(square_cotan(), &[(0, 2, -0.5)]));
    let far_excerpt = faces(rows(&far, &[0]), &square(), &[0, 3]);
    let lopsided = operator(5, &with(square_cotan(), &[(0, 4, -1.5)]));
    let lopsided_rows = rows(&lopsided, &[0, 4]);
    let sum = operator(5, &with(square_cotan(), &[(1, 1, 1.25)]));
    let sum_rows = rows(&sum, &[1]);
    let cut = operator(3, &laplacian(&[(0, 1, 1.0)]));
    let cut_excerpt = edges(rows(&cut, &[0, 1]), &[]);
    let energy = operator(2, &[(0, 0, 1.0), (0, 1, -2.0), (1, 0, -2.0), (1, 1, 1.0)]);
    let energy_rows = rows(&energy, &[0, 1]);
    let joined = operator(4, &laplacian(&[(0, 1, 1.0), (1, 2, 1.0), (2, 3, 1.0)]));
    let joined_excerpt = edges(rows(&joined, &[1]), &[[0, 1]]);
    let apart = || graph(4, &[[0, 1], [2, 3]], &[]);
    vec![
        example(
            "not finite",
            "FIN",
            (square(), nan),
            Statement::NotFinite { matrix: Which::Stiffness, i: 0, j: 1, value: "NaN".into() },
            Excerpt::default(),
            (Open, Exact),
        ),
        example(
            "far entry",
            "LOC",
            (square(), far),
            Statement::FarEntry { i: 0, j: 2, rings: Some(2) },
            far_excerpt,
            (Exact, Exact),
        ),
        example(
            "entry between components",
            "KER",
            (apart(), joined),
            Statement::FarEntry { i: 1, j: 2, rings: None },
            joined_excerpt,
            (Exact, Exact),
        ),
        example(
            "asymmetry",
            "SYM",
            (square(), lopsided),
            Statement::Asymmetry { i: 0, j: 4, threshold: 1e-12 },
            lopsided_rows,
            (Exact, Exact),
        ),
        example(
            "row sum",
            "NULL",
            (square(), sum),
            Statement::RowSum { i: 1, threshold: 1e-12 },
            sum_rows,
            (Exact, Exact),
        ),
        example(
            "kernel vector",
            "KER",
            (graph(3, &[[0, 1], [1, 2]], &[]), cut),
            Statement::KernelVector { x: vec![(2, 1.0)], a: 2, b: 1, threshold: 1e-12 },
            Excerpt { rows: Vec::new(), ..cut_excerpt },
            (Open, Exact),
        ),
        example(
            "negative energy",
            "PSD",
            (graph(2, &[[0, 1]], &[]), energy),
            Statement::NegativeEnergy { x: vec![(0, 1.0), (1, 1.0)] },
            energy_rows,
            (Exact, Exact),
        ),
    ]
}

fn of_weights() -> Vec<Example> {
    let negative = operator(4, &kite_cotan());
    let excerpt = faces(positions(rows(&negative, &[0]), &kite(), &[0, 1, 2, 3]), &kite(), &[0, 1]);
    let angle_deg = 4.0_f64.atan2(-3.0).to_degrees();
    let opposite = [2, 3].map(|vertex| Corner { vertex, angle_deg }).to_vec();
    let zero = operator(5, &with(square_cotan(), &[(0, 1, 0.0)]));
    let side = faces(positions(rows(&zero, &[0]), &square(), &[0, 1, 4]), &square(), &[0]);
    let on_graph = operator(2, &laplacian(&[(0, 1, -1.0)]));
    let on_graph_rows = rows(&on_graph, &[1]);
    let center = |entries: &[(usize, usize, f64)]| operator(5, &with(square_cotan(), entries));
    let both = center(&[(4, 0, 1.0)]);
    let both_rows = rows(&both, &[4]);
    let none = center(&[(4, 0, 0.0), (4, 1, 0.0), (4, 2, 0.0), (4, 3, 0.0)]);
    let none_rows = rows(&none, &[4]);
    let flipped = center(&[(4, 4, -4.0)]);
    let flipped_rows = rows(&flipped, &[4]);
    let exact = (Exact, Exact);
    let inaccurate = operator(5, &with(square_cotan(), &[(0, 4, -1.5)]));
    let spoke = faces(positions(rows(&inaccurate, &[0]), &square(), &[0, 1, 3, 4]), &square(), &[0, 3]);
    vec![
        example(
            "inaccurate weight",
            "ACC",
            (square(), inaccurate),
            Statement::Inaccurate { i: 0, j: 4, exact: 1.0, error: 0.5, threshold: 1e-3 },
            spoke,
            (Bounded, Bounded),
        ),
        example(
            "negative weight",
            "POS",
            (kite(), negative),
            Statement::Weight { i: 0, j: 1, zero: false, opposite },
            excerpt,
            exact,
        ),
        example(
            "zero weight",
            "POS-boundary",
            (square(), zero),
            Statement::Weight { i: 0, j: 1, zero: true, opposite: vec![Corner { vertex: 4, angle_deg: 90.0 }] },
            side,
            exact,
        ),
        example(
            "negative weight of a graph",
            "POS0",
            (graph(2, &[[0, 1]], &[]), on_graph),
            Statement::Weight { i: 1, j: 0, zero: false, opposite: Vec::new() },
            on_graph_rows,
            exact,
        ),
        example(
            "both signs",
            "MAX-local",
            (square(), both.clone()),
            Statement::BothSigns { i: 4, positive: 1, negative: 0 },
            both_rows.clone(),
            exact,
        ),
        example("no weight", "MAX-local", (square(), none), Statement::NoWeight { i: 4 }, none_rows, exact),
        example("negative share", "MVP", (square(), both), Statement::NotConvex { i: 4, j: 0 }, both_rows, exact),
        example(
            "negative diagonal",
            "MVP",
            (square(), flipped),
            Statement::NotConvex { i: 4, j: 4 },
            flipped_rows,
            exact,
        ),
    ]
}

fn of_coordinates() -> Vec<Example> {
    let tilted = operator(5, &with(square_cotan(), &[(4, 1, -1.5)]));
    let tilted_excerpt = positions(rows(&tilted, &[4]), &square(), &[0, 1, 2, 3, 4]);
    let leaking = operator(5, &with(square_cotan(), &[(0, 4, -2.0)]));
    // The stencil of corner 0, and its neighbours 3 and 1 along the boundary.
    let leaking_excerpt = positions(rows(&leaking, &[0]), &square(), &[0, 1, 3, 4]);
    let doubled: Vec<_> = square_cotan().into_iter().map(|(i, j, v)| (i, j, 2.0 * v)).collect();
    let doubled = operator(5, &doubled);
    let everything = |o: &Operator, d: &Domain, f: &[usize]| {
        let all: Vec<usize> = (0..o.size()).collect();
        faces(positions(rows(o, &all), d, &all), d, f)
    };
    let doubled_excerpt = everything(&doubled, &square(), &[0, 1, 2, 3]);
    let weak =
        operator(4, &laplacian(&[(0, 1, 0.25), (0, 2, 0.25), (0, 3, 0.25), (1, 2, 0.25), (1, 3, 0.25), (2, 3, 0.25)]));
    let weak_excerpt = everything(&weak, &tetrahedron(), &[0, 1, 2, 3]);
    vec![
        example(
            "moment inside",
            "LIN",
            (square(), tilted),
            // −1.5 (2 − 1) − (0 − 1) − (2 − 1) − (0 − 1) = −½
            Statement::Moment { i: 4, axis: 0, axes: [0, 1], boundary: None, threshold: 0.25 },
            tilted_excerpt,
            (Exact, Exact),
        ),
        example(
            "moment on the boundary",
            "FLUX",
            (square(), leaking),
            // Found −2·1; the flux is ½ ((0, 0) − … ) = ½ (y_1 − y_3) = −1.
            Statement::Moment { i: 0, axis: 0, axes: [0, 1], boundary: Some([3, 1]), threshold: 0.5 },
            leaking_excerpt,
            (Exact, Exact),
        ),
        example(
            "energy in the plane",
            "ENERGY",
            (square(), doubled),
            Statement::Energy { axis: 1, other: 1, trace: false, found: 8.0, expected: 4.0, threshold: 1e-9, star: 4 },
            doubled_excerpt,
            (Exact, Exact),
        ),
        example(
            "energy in space",
            "ENERGY",
            (tetrahedron(), weak),
            // Six edges of squared length 8 with weight ¼ against twice the area.
            Statement::Energy {
                axis: 0,
                other: 0,
                trace: true,
                found: 12.0,
                expected: 16.0 * 3.0_f64.sqrt(),
                threshold: 1e-9,
                star: 0,
            },
            weak_excerpt,
            (Bounded, Bounded),
        ),
    ]
}

fn of_solutions() -> Vec<Example> {
    // One unknown: u = −½ u_0 + 1½ u_1.
    let star = || graph(3, &[[0, 2], [1, 2]], &[0, 1]);
    let steep = operator(3, &[(2, 0, 0.5), (2, 1, -1.5), (2, 2, 1.0)]);
    let steep_rows = rows(&steep, &[2]);
    let flat = operator(3, &[(2, 0, 1.0), (2, 1, -1.0)]);
    let flat_rows = rows(&flat, &[2]);
    // M + L = [2 1; 1 2], its inverse [2 −1; −1 2]/3.
    let cold = lumped(operator(2, &[(0, 0, 1.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, 1.0)]), &[1.0, 1.0]);
    let cold_excerpt = Excerpt { mass_rows: mass_rows(&cold, &[0, 1]).mass_rows, ..rows(&cold, &[0, 1]) };
    let bounded = (Bounded, Bounded);
    vec![
        example(
            "below zero",
            "MAX-global",
            (star(), steep.clone()),
            Statement::Overshoot { set: vec![0, 1], source: 0, at: 2, value: -0.5, low: true },
            steep_rows.clone(),
            bounded,
        ),
        example(
            "above one",
            "MAX-global",
            (star(), steep),
            Statement::Overshoot { set: vec![0, 1], source: 1, at: 2, value: 1.5, low: false },
            steep_rows,
            bounded,
        ),
        example(
            "no equation",
            "MAX-global",
            (star(), flat),
            Statement::Singular { set: vec![0, 1], x: vec![(2, 1.0)] },
            flat_rows,
            (Exact, Exact),
        ),
        example(
            "heat that makes cold",
            "MAX-heat",
            (graph(2, &[[0, 1]], &[]), cold),
            Statement::HeatLoss { t: 1.0, source: 1, at: 0, value: -1.0 / 3.0 },
            cold_excerpt,
            bounded,
        ),
    ]
}

fn of_masses() -> Vec<Example> {
    let plain = || operator(5, &square_cotan());
    let whole = |o: &Operator| {
        faces(positions(mass_rows(o, &[0, 1, 2, 3, 4]), &square(), &[0, 1, 2, 3, 4]), &square(), &[0, 1, 2, 3])
    };
    let heavy = lumped(plain(), &[1.0, 1.0, 1.0, 1.0, 1.0]);
    let heavy_excerpt = whole(&heavy);
    let diagonal = |i: usize| (i, i, 0.8);
    let entries: Vec<_> = (0..5).map(diagonal).collect();
    let lopsided = full_mass(plain(), &with(entries.clone(), &[(0, 4, 0.25), (4, 0, 0.125)]));
    let lopsided_rows = mass_rows(&lopsided, &[0, 4]);
    let indefinite = full_mass(plain(), &with(entries, &[(0, 4, -1.0), (4, 0, -1.0)]));
    let indefinite_rows = mass_rows(&indefinite, &[0, 4]);
    // The centre has all four triangles, area 4: a third of it is its share, and it gets a twentieth.
    let misplaced = lumped(plain(), &[0.95, 0.95, 0.95, 0.95, 0.2]);
    let misplaced_excerpt = whole(&misplaced);
    let misplaced_excerpt = Excerpt { mass_rows: mass_rows(&misplaced, &[4]).mass_rows, ..misplaced_excerpt };
    let rotated = operator(5, &square_cotan());
    let exact = (Exact, Exact);
    vec![
        example(
            "total mass",
            "MASS",
            (square(), heavy),
            Statement::MassTotal { found: 5.0, expected: 4.0, threshold: 1e-9 },
            heavy_excerpt,
            exact,
        ),
        example(
            "mass asymmetry",
            "MASS",
            (square(), lopsided),
            Statement::MassAsymmetry { i: 0, j: 4, threshold: 1e-9 },
            lopsided_rows,
            exact,
        ),
        example(
            "mass not positive",
            "MASS",
            (square(), indefinite),
            Statement::MassNotPositive { x: vec![(0, 1.0), (4, 1.0)] },
            indefinite_rows,
            exact,
        ),
        example(
            "mass share",
            "MASS",
            (square(), misplaced),
            Statement::MassShare { i: 4, lower: 1.0, upper: 2.0 },
            misplaced_excerpt,
            exact,
        ),
        example(
            "changed entry",
            "SCALE",
            (square(), rotated),
            Statement::Changed {
                transformation: "scaled by 2".into(),
                matrix: Which::Stiffness,
                i: 0,
                j: 4,
                before: -1.0,
                after: -4.0,
                threshold: 1e-9,
            },
            Excerpt::default(),
            (Open, Open),
        ),
    ]
}

/// The complete graph with four vertices: every pair of pairs has the constant 4/2, and λ̃₁ = 4/3 < 2²/2.
fn of_graphs() -> Vec<Example> {
    let pairs = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    let complete = operator(4, &laplacian(&pairs.map(|[i, j]| (i, j, 1.0))));
    let excerpt = edges(rows(&complete, &[0, 1, 2, 3]), &pairs);
    vec![example(
        "below cheeger",
        "CHEEGER",
        (graph(4, &pairs, &[]), complete),
        Statement::BelowCheeger { x: vec![(0, 1.0), (1, -1.0)], side: vec![0, 1] },
        excerpt,
        (Exact, Exact),
    )]
}

pub fn named(name: &str) -> Example {
    all().into_iter().find(|e| e.name == name).unwrap()
}

#[test]
fn true_witnesses_survive_json_and_are_accepted() {
    all().iter().for_each(Example::assert_true);
}

#[test]
fn a_kernel_vector_with_its_rows_and_edges_is_decided_alone() {
    let mut e = named("kernel vector");
    e.evidence.excerpt = edges(rows(&e.operator, &[0, 1, 2]), &[[0, 1], [1, 2]]);
    e.alone = Exact;
    e.assert_true();
}
