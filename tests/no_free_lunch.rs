//! No free lunch: every triangulation has exactly one certificate, and a certificate with one number changed is refused.

use lapjury::domain::{Domain, Surface};
use lapjury::experiment::no_free_lunch::random_case;
use lapjury::experiment::world::certified::{certified, evidence, verified};
use lapjury::experiment::world::lifting::{Lifting, lifting};
use lapjury::experiment::world::twisted::{ratio, twisted};
use lapjury::laplacian::equilibrium::{Certificate, decide, decide_by_simplex};
use lapjury::property::evidence::Fraction;
use lapjury::property::recheck::{Rechecked, from_excerpt};
use lapjury::property::{Evidence, Statement};
use lapjury::{Recipe, Trial, laplacian, property};
use rayon::prelude::*;
use serde_json::Value;

fn surface(recipe: &str) -> Surface {
    let domain = recipe.parse::<Recipe>().unwrap().build(std::path::Path::new(".")).unwrap();
    domain.as_surface().unwrap().clone()
}

/// Decides `count` random triangulations; how many have a lift, a motion, and were decided by the exact simplex method.
fn decide_all(count: usize) -> [usize; 3] {
    let one = |k: usize| {
        let case = random_case(2007, k);
        let surface = case.domain.as_surface().unwrap();
        assert!((5..=60).contains(&surface.positions().len()), "{}", case.recipe);
        let found = certified(surface).unwrap_or_else(|why| panic!("{}: {why}", case.recipe));
        look(&found.evidence).unwrap_or_else(|why| panic!("{}: {why}", case.recipe));
        let positive = found.decision.certificate.is_positive();
        [usize::from(positive), usize::from(!positive), usize::from(found.decision.by_simplex)]
    };
    let add = |a: [usize; 3], b: [usize; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    (0..count).into_par_iter().map(one).reduce(|| [0; 3], add)
}

#[test]
fn every_random_triangulation_has_exactly_one_certificate() {
    let [lifts, motions, _] = decide_all(90);
    assert!(lifts > 20 && motions > 10 && lifts + motions == 90, "{lifts} {motions}");
}

/// `cargo test --release --test no_free_lunch -- --ignored --nocapture`
#[test]
#[ignore = "minutes"]
fn ten_thousand_random_triangulations_have_exactly_one_certificate_each() {
    let start = std::time::Instant::now();
    let [lifts, motions, by_simplex] = decide_all(10_000);
    assert_eq!(lifts + motions, 10_000);
    println!("{lifts} lifts, {motions} motions, {by_simplex} by the simplex method, {:.1?}", start.elapsed());
}

#[test]
fn the_recipe_of_a_random_case_makes_the_same_mesh_again() {
    for k in 0..9 {
        let case = random_case(3, k);
        assert_eq!(Domain::from(surface(&case.recipe)).digest(), case.domain.digest(), "{}", case.recipe);
    }
}

/// A certificate again, in floating point and with formulas of its own: heights by the distance of a vertex from a plane.
fn look(evidence: &Evidence) -> Result<(), String> {
    let x = |v: usize| evidence.excerpt.positions[v].1;
    let is = |truth: bool, what: &str| if truth { Ok(()) } else { Err(what.to_string()) };
    let cross = |a: usize, b: usize, c: usize| {
        let (a, b, c) = (x(a), x(b), x(c));
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    match &evidence.statement {
        Statement::Lift { heights, weights } => {
            is(heights.iter().enumerate().all(|(k, h)| k == h.0), "a height is missing")?;
            is(weights.iter().all(|w| w.1.approximate() > 0.0), "a weight is not positive")
        }
        Statement::Equilibrium { weights } => {
            is(weights.iter().all(|w| w.1.approximate() > 0.0), "a weight is not positive")
        }
        Statement::Motion { motion, rates } => {
            let y =
                |v: usize| motion.iter().find(|m| m.0 == v).map_or([0.0; 2], |m| [0, 1].map(|k| m.1[k].approximate()));
            let size = motion.iter().flat_map(|m| &m.1).map(|c| c.approximate().abs()).fold(0.0, f64::max);
            for ([i, j], rate) in rates {
                let (a, b, p, q) = (y(*i), y(*j), x(*i), x(*j));
                let terms = [0, 1].map(|k| (a[k] - b[k]) * (p[k] - q[k]));
                let length = (p[0] - q[0]).hypot(p[1] - q[1]);
                is((terms[0] + terms[1] - rate.approximate()).abs() <= 1e-12 * size * length, "another rate")?;
            }
            is(rates.iter().all(|r| r.1.approximate() >= 0.0), "an edge is shortened")?;
            is(rates.iter().any(|r| r.1.approximate() > 0.0), "no edge is lengthened")
        }
        Statement::NoLift { multipliers, .. } => {
            let mut sums = vec![0.0; evidence.excerpt.positions.len()];
            for (f, v, m) in multipliers {
                let [a, b, c] = evidence.excerpt.faces[*f].1[..] else { return Err("no triangle".into()) };
                let m = m.approximate();
                sums[*v] += m * cross(a, b, c);
                sums[a] -= m * cross(*v, b, c);
                sums[b] -= m * cross(a, *v, c);
                sums[c] -= m * cross(a, b, *v);
            }
            let scale: f64 = multipliers
                .iter()
                .map(|(f, ..)| {
                    let face = &evidence.excerpt.faces[*f].1;
                    cross(face[0], face[1], face[2]).abs()
                })
                .sum();
            is(sums.iter().all(|s| s.abs() <= 1e-9 * scale * sums.len() as f64), "the conditions do not cancel")
        }
        other => Err(format!("no way to look at {other:?}")),
    }
}

#[test]
fn a_twist_decides_and_the_exact_simplex_method_alone_decides_the_same() {
    for (twist, positive) in [(-0.3, true), (-0.01, true), (0.01, false), (0.3, false)] {
        let surface = surface(&format!("schonhardt:twist={twist}"));
        assert_eq!(decide(&surface).unwrap().certificate.is_positive(), positive, "{twist}");
        assert_eq!(decide_by_simplex(&surface).unwrap().is_positive(), positive, "{twist}");
    }
    // At twist 0 the conditions are met with equality: rounding decides nothing.
    let straight = decide(&twisted(&ratio(0, 1), &ratio(1, 2), 1).unwrap()).unwrap();
    assert!(straight.by_simplex && !straight.certificate.is_positive());
}

#[test]
fn a_cotangent_lift_is_found_on_every_delaunay_triangulation() {
    for seed in 0..5 {
        let surface = surface(&format!("random-delaunay:n=30,seed={seed}"));
        assert!(matches!(decide(&surface).unwrap().certificate, Certificate::Heights(_)));
    }
}

/// One example of each kind.
fn examples() -> Vec<Evidence> {
    let lift = twisted(&ratio(-1, 4), &ratio(2, 5), 1).unwrap();
    let motion = twisted(&ratio(1, 4), &ratio(2, 5), 1).unwrap();
    let whole = twisted(&ratio(0, 1), &ratio(2, 5), 2).unwrap();
    let ring = Surface::new(whole.positions().to_vec(), whole.faces().iter().take(12).map(<[usize]>::to_vec).collect())
        .unwrap();
    let mut examples: Vec<Evidence> = [&lift, &motion, &ring].map(|s| certified(s).unwrap().evidence).to_vec();
    for which in [Lifting::Local, Lifting::Global] {
        examples.push(lifting(&motion, which).unwrap().unwrap_err());
    }
    examples
}

#[test]
fn each_kind_of_certificate_is_verified_and_refused_with_any_number_changed() {
    let kinds: Vec<&str> = examples().iter().map(|e| lapjury::property::recheck::kind(&e.statement)).collect();
    assert_eq!(kinds, ["lift", "motion", "equilibrium", "no-lift", "no-lift"]);
    for example in examples() {
        verified(&example).unwrap();
        look(&example).unwrap();
        let original = serde_json::to_value(&example).unwrap();
        let mut places = Vec::new();
        numbers(&original, String::new(), &mut places);
        assert!(places.len() > 60);
        for place in places {
            let mut value = original.clone();
            let leaf = value.pointer_mut(&place).unwrap();
            *leaf = changed(leaf);
            let spoilt: Evidence = serde_json::from_value(value).unwrap();
            // A contradiction between conditions speaks of the faces that it names alone.
            let unnamed = matches!(example.statement, Statement::NoLift { .. }) && place.contains("/faces/");
            assert!(unnamed || from_excerpt(&spoilt).is_err(), "{place} of {:?}", example.statement);
        }
    }
}

/// The places of all numbers, fractions included.
fn numbers(value: &Value, at: String, found: &mut Vec<String>) {
    match value {
        Value::Number(_) => found.push(at),
        Value::String(text) if Fraction::text(text.as_str()).value().is_some() => found.push(at),
        Value::Array(items) => items.iter().enumerate().for_each(|(k, v)| numbers(v, format!("{at}/{k}"), found)),
        Value::Object(map) => map.iter().for_each(|(k, v)| numbers(v, format!("{at}/{k}"), found)),
        _ => {}
    }
}

fn changed(leaf: &Value) -> Value {
    match leaf {
        Value::String(text) => {
            // One more in the numerator.
            let (numerator, rest) = text.split_at(text.find('/').unwrap_or(text.len()));
            let more: i128 = numerator.parse::<i128>().unwrap() + 1;
            format!("{more}{rest}").into()
        }
        number => match number.as_u64() {
            Some(n) => (n + 1).into(),
            None => number.as_f64().unwrap().next_up().into(),
        },
    }
}

#[test]
fn certificates_that_are_none_are_refused_for_what_they_are() {
    let motion = twisted(&ratio(1, 4), &ratio(2, 5), 1).unwrap();
    let refusal = |certificate: &Certificate| {
        let written = evidence(&motion, certificate).unwrap();
        from_excerpt(&written).unwrap_err().to_string()
    };
    let zero = || ratio(0, 1);
    assert!(refusal(&Certificate::Heights(vec![zero(); 6])).contains("is positive"));
    assert!(refusal(&Certificate::Weights(vec![ratio(1, 1); 9])).contains("at vertex 3"));
    assert!(refusal(&Certificate::Motion(vec![[zero(), zero()]; 6])).contains("some edge is lengthened"));
    let mut other_way = vec![[zero(), zero()]; 6];
    other_way[3] = [ratio(1, 1), zero()];
    assert!(refusal(&Certificate::Motion(other_way)).contains("not shortened"));
    let mut bare = certified(&motion).unwrap().evidence;
    bare.excerpt.faces.pop();
    assert!(from_excerpt(&bare).is_err());
    let example = &examples()[0];
    assert_eq!(from_excerpt(example), Ok(Rechecked::Exact));
}

#[test]
fn optimal_positive_has_all_four_properties_where_it_exists_and_refuses_with_a_motion_elsewhere() {
    let entry = laplacian::find("optimal-positive").unwrap();
    for recipe in ["random-delaunay:n=40,seed=4", "schonhardt:twist=-0.3", "grid:nx=4,ny=3,diagonals=random,seed=2"] {
        let domain = recipe.parse::<Recipe>().unwrap().build(std::path::Path::new(".")).unwrap();
        let operator = entry.build(&domain, &Default::default()).unwrap();
        let trial = Trial::new(&domain, &operator, 0).unwrap();
        for id in ["SYM", "LOC", "LIN", "POS", "NULL", "PSD"] {
            let verdict = property::find(id).unwrap().decide(&trial, None);
            assert_eq!(verdict.status(), lapjury::Status::Holds, "{id} on {recipe}: {verdict:?}");
        }
        // The energies of the coordinates add up to twice the area.
        let surface = domain.as_surface().unwrap();
        let energy: f64 = (0..2)
            .map(|k| operator.stiffness().quadratic_form(&surface.positions().iter().map(|p| p[k]).collect::<Vec<_>>()))
            .sum();
        assert!((energy / (2.0 * surface.area()) - 1.0).abs() < 1e-8, "{recipe}: {energy}");
    }
    let refused = entry.build(&Domain::from(surface("schonhardt:twist=0.3")), &Default::default()).unwrap_err();
    assert!(refused.to_string().contains("moving vertex 3"), "{refused}");
    let sphere = "icosphere:levels=1".parse::<Recipe>().unwrap().build(std::path::Path::new(".")).unwrap();
    assert!(entry.build(&sphere, &Default::default()).unwrap_err().to_string().contains("plane"));
}

#[test]
fn no_positive_weights_of_the_same_energy_have_a_larger_smallest_one() {
    let build = |id: &str, domain: &Domain| laplacian::find(id).unwrap().build(domain, &Default::default()).unwrap();
    for seed in 0..4 {
        let domain = Domain::from(surface(&format!("random-delaunay-disk:n=20,m=8,seed={seed}")));
        let least = |id: &str| {
            let operator = build(id, &domain);
            domain.edges().iter().map(|e| -operator.stiffness().at(e[0], e[1])).fold(f64::INFINITY, f64::min)
        };
        // Cotangent weights satisfy the equations, and their energies add up to twice the area.
        assert!(least("optimal-positive") >= least("cotan") - 1e-9);
    }
}

#[test]
fn the_orthogonal_dual_of_zero_weights_is_cotan_and_the_rational_one_is_its_proof() {
    let entry = laplacian::find("orthogonal-dual").unwrap();
    let set = |pairs: &[(&str, &str)]| pairs.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect();
    for recipe in ["random-delaunay:n=30,seed=1 | flip:count=10,seed=1", "icosphere:levels=1", "slivers:columns=4"] {
        let domain = recipe.parse::<Recipe>().unwrap().build(std::path::Path::new(".")).unwrap();
        let zero = entry.build(&domain, &set(&[("weights", "zero")])).unwrap();
        let cotan = laplacian::find("cotan").unwrap().build(&domain, &Default::default()).unwrap();
        assert_eq!(zero.stiffness(), cotan.stiffness(), "{recipe}");
    }
    let domain = Domain::from(surface("random-delaunay:n=30,seed=1"));
    let random = entry.build(&domain, &set(&[("weights", "random"), ("seed", "7")])).unwrap();
    let other = entry.build(&domain, &set(&[("weights", "random"), ("seed", "8")])).unwrap();
    assert_ne!(random.stiffness(), other.stiffness());
    let trial = Trial::new(&domain, &random, 0).unwrap();
    for id in ["SYM", "LOC", "LIN", "NULL"] {
        assert_eq!(property::find(id).unwrap().decide(&trial, None).status(), lapjury::Status::Holds, "{id}");
    }
}
