//! ACC: how far the cotangent weights of a matrix are off, and what happens to matrices that are spoilt in their last digits.

use std::path::Path;

use lapjury::linalg::Csr;
use lapjury::property::evidence::Evidence;
use lapjury::property::recheck::{self, Rechecked};
use lapjury::{Domain, Operator, Recipe, Statement, Status, Surface, Trial, Verdict, laplacian, property};

fn domain(recipe: &str) -> Domain {
    recipe.parse::<Recipe>().unwrap().build(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn build(id: &str, domain: &Domain) -> Operator {
    laplacian::find(id).unwrap().build(domain, &Default::default()).unwrap()
}

/// The verdict, with its evidence held against the operator, on its own and after a journey through JSON.
fn judge(domain: &Domain, operator: &Operator) -> Verdict {
    let trial = Trial::new(domain, operator, 1).unwrap();
    let verdict = property::find("ACC").unwrap().decide(&trial, None);
    if let Err(refusal) = recheck::of_verdict(&verdict, "ACC", domain, operator) {
        panic!("{refusal}: {verdict:?}");
    }
    if let Some(evidence) = verdict.evidence() {
        let again: Evidence = serde_json::from_str(&serde_json::to_string(evidence).unwrap()).unwrap();
        assert_eq!(&again, evidence);
        recheck::from_excerpt(&again).unwrap();
    }
    verdict
}

fn with(operator: &Operator, change: impl Fn(usize, usize, f64) -> f64) -> Operator {
    let spoilt: Csr = operator.stiffness().map(|i, j, v| change(i, j, *v));
    Operator::new(spoilt, Default::default()).unwrap()
}

/// A fan of needles: angles of `angle` radians at the centre, once around a part of a circle.
fn needles(angle: f64, count: u32) -> Domain {
    let mut points = vec![[0.0, 0.0]];
    points.extend((0..=count).map(|k| {
        let at = 0.3 + angle * f64::from(k);
        [at.cos(), at.sin()]
    }));
    let faces: Vec<[usize; 3]> = (1..=count as usize).map(|k| [0, k, k + 1]).collect();
    Surface::planar(&points, &faces).unwrap().into()
}

#[test]
fn our_own_weights_are_accurate_on_good_meshes_and_on_the_worst() {
    for recipe in [
        "icosphere:levels=2 | perturb:amount=0.1,seed=1",
        "random-delaunay:n=300,seed=2 | flip:count=40,seed=1",
        "grid:nx=8,ny=8",
        "icosphere:levels=1 | scale:factor=1e-30",
        "random-delaunay:n=50,seed=2 | translate:x=1e8,y=-1e8",
    ] {
        let domain = domain(recipe);
        let verdict = judge(&domain, &build("cotan", &domain));
        assert_eq!(verdict.status(), Status::Holds, "{recipe}: {verdict:?}");
        assert!(
            verdict.notes.iter().all(|note| !note.contains("as something else") || note.contains(", 0 of")),
            "{recipe}"
        );
    }
    for angle in [1e-3, 1e-6, 1e-9, 1e-12] {
        let domain = needles(angle, 5);
        let verdict = judge(&domain, &build("cotan", &domain));
        assert_eq!(verdict.status(), Status::Holds, "{angle:e}: {verdict:?}");
        assert!(verdict.margin.unwrap() < 0.3, "{angle:e}: {:?}", verdict.margin);
    }
}

#[test]
fn a_weight_that_is_off_by_a_billionth_fails_and_the_witness_says_which_and_by_how_much() {
    let domain = domain("icosphere:levels=2");
    let cotan = build("cotan", &domain);
    let [i, j] = domain.edges()[17];
    let spoilt = with(&cotan, |a, b, v| if [a, b] == [i, j] || [a, b] == [j, i] { v * (1.0 + 1e-9) } else { v });
    let verdict = judge(&domain, &spoilt);
    assert_eq!(verdict.status(), Status::Fails, "{verdict:?}");
    let witness = verdict.evidence().unwrap();
    let Statement::Inaccurate { i: a, j: b, exact, error, .. } = witness.statement else { panic!("{witness:?}") };
    assert_eq!([a, b], [i, j]);
    assert!((error / exact.abs() / 1e-9 - 1.0).abs() < 1e-6);
    assert_eq!(recheck::from_excerpt(witness), Ok(Rechecked::Bounded));
    let sentence = lapjury::report::sentence(&verdict);
    assert!(sentence.contains(&format!("the weight of ({i}, {j})")), "{sentence}");
    assert!(verdict.notes.iter().any(|n| n.starts_with("furthest off is")), "{:?}", verdict.notes);
}

#[test]
fn a_witness_that_says_more_than_is_true_is_refused() {
    let domain = domain("icosphere:levels=1");
    let spoilt = with(&build("cotan", &domain), |_, _, v| v * (1.0 + 1e-10));
    let verdict = judge(&domain, &spoilt);
    assert_eq!(verdict.status(), Status::Fails);
    let honest = verdict.evidence().unwrap();
    let refused = |change: &dyn Fn(&mut Evidence)| {
        let mut evidence = honest.clone();
        change(&mut evidence);
        recheck::against(&evidence, "ACC", &domain, &spoilt).is_err()
    };
    let Statement::Inaccurate { i, j, exact, error, threshold } = honest.statement else { panic!() };
    let with = |exact: f64, error: f64, threshold: f64| Statement::Inaccurate { i, j, exact, error, threshold };
    assert!(!refused(&|_| {}));
    assert!(refused(&|e| e.statement = with(exact * 1.001, error, threshold)));
    assert!(refused(&|e| e.statement = with(exact, error * 1.5, threshold)));
    assert!(refused(&|e| e.statement = with(exact, error, error * 1.01)));
    assert!(refused(&|e| drop(e.excerpt.faces.pop())));
    assert!(refused(&|e| e.excerpt.positions[0].1[0] += 1e-3));
    // A right weight makes no witness, whatever the threshold.
    let right = build("cotan", &domain);
    let mut evidence = honest.clone();
    evidence.excerpt.rows[0].entries = right.stiffness().row(i).map(|(j, v)| (j, *v)).collect();
    evidence.statement = with(exact, 0.0, 0.0);
    assert!(recheck::against(&evidence, "ACC", &domain, &right).is_err());
    // Nor is a certificate of a spoilt matrix believed.
    let certificate = judge(&domain, &right).evidence().unwrap().clone();
    let worse = self::with(&right, |_, _, v| v * (1.0 + 1e-9));
    assert!(recheck::against(&certificate, "ACC", &domain, &worse).is_err());
}

#[test]
fn single_precision_is_seen_and_cotangents_from_angles_are_not_explained_on_needles() {
    let sphere = domain("icosphere:levels=2 | perturb:amount=0.1,seed=1");
    let single = with(&build("cotan", &sphere), |_, _, v| f64::from(v as f32));
    assert_eq!(judge(&sphere, &single).status(), Status::Fails);

    // cot acos of the normalised dot product, as many a library has it.
    let needles = needles(1e-6, 6);
    let surface = needles.as_surface().unwrap();
    let angle = |a: usize, p: usize, q: usize| {
        let (u, v) = (surface.point(p) - surface.point(a), surface.point(q) - surface.point(a));
        (u.dot(&v) / u.norm() / v.norm()).clamp(-1.0, 1.0).acos()
    };
    let weight = |edge: usize| -> f64 {
        let [i, j] = surface.topology().edges()[edge];
        surface.opposite(edge).into_iter().map(|(_, k)| 0.5 / angle(k, i, j).tan()).sum()
    };
    let exact = build("cotan", &needles);
    let from_angles = with(&exact, |i, j, v| match surface.topology().edge_between(i, j) {
        Some(edge) => -weight(edge),
        None => v,
    });
    let verdict = judge(&needles, &from_angles);
    assert!(matches!(verdict.status(), Status::Undecided | Status::Fails), "{verdict:?}");
    assert_eq!(judge(&needles, &exact).status(), Status::Holds);
}

#[test]
fn other_constructions_and_other_domains_are_none_of_its_business() {
    let flipped = domain("random-delaunay:n=60,seed=1 | flip:count=10,seed=1");
    for id in ["mean-value", "wachspress", "intrinsic-delaunay", "three-point"] {
        for recipe in
            ["random-delaunay:n=60,seed=1 | flip:count=10,seed=1", "icosphere:levels=1 | perturb:amount=0.1,seed=1"]
        {
            let domain = domain(recipe);
            let Ok(operator) = laplacian::find(id).unwrap().build(&domain, &Default::default()) else { continue };
            let verdict = judge(&domain, &operator);
            assert_ne!(verdict.status(), Status::Fails, "{id} on {recipe}");
            assert_ne!(verdict.status(), Status::Undecided, "{id} on {recipe}");
        }
    }
    let doubled = with(&build("cotan", &flipped), |_, _, v| 2.0 * v);
    let verdict = judge(&flipped, &doubled);
    assert_eq!(verdict.status(), Status::NotApplicable);
    assert!(verdict.reason().unwrap().contains("not even roughly"), "{verdict:?}");
    let delaunay = build("intrinsic-delaunay", &flipped);
    assert!(judge(&flipped, &delaunay).reason().unwrap().contains("off the edges"));
    let graph = domain("cycle:n=5");
    assert_eq!(judge(&graph, &build("graph", &graph)).status(), Status::NotApplicable);
}

#[test]
fn edges_beside_a_triangle_without_area_are_left_out() {
    let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0]];
    let domain: Domain = Surface::planar(&points, &[[0, 1, 3], [1, 2, 3], [0, 2, 1]]).unwrap().into();
    let settings = [("degenerate".to_string(), "skip".to_string()), ("mass".to_string(), "unit".to_string())].into();
    let operator = laplacian::find("cotan").unwrap().build(&domain, &settings).unwrap();
    let verdict = judge(&domain, &operator);
    assert_eq!(verdict.status(), Status::Holds, "{verdict:?}");
    assert!(verdict.notes.iter().any(|n| n.starts_with("3 edges were left out")), "{:?}", verdict.notes);
}
