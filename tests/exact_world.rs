//! Two ways to every verdict: rational arithmetic and floating point agree over the exhaustive world of small triangulations
//! and on random meshes.

use std::collections::BTreeMap;
use std::path::Path;

use lapjury::domain::Domain;
use lapjury::experiment::world::triangulations::world;
use lapjury::property::exact::{Case, DECIDED, Decision, Plane};
use lapjury::property::{self, Status, Trial};
use lapjury::suite::{Choice, Recipe};

/// Operators that are rational in the plane: symmetric, not symmetric, and one that knows nothing of geometry.
const OPERATORS: [&str; 6] = [
    "cotan",
    "wachspress",
    "graph",
    "three-point:p=4",
    "three-point:p=-2",
    "weighted-graph:weights=inverse-squared-length",
];

#[derive(Default)]
struct Count {
    holds: usize,
    fails: usize,
    silent: usize,
    open: usize,
}

/// Compares the two ways on one domain; rounding may leave a verdict open, and must not decide it otherwise.
fn compare(domain: &Domain, choices: &[Choice], counts: &mut BTreeMap<&'static str, Count>) {
    let plane = Plane::new(domain).expect("planar and regular");
    for choice in choices {
        let twin = choice.twin(domain.as_surface().unwrap()).expect("rational");
        let case = Case::new(&plane, &twin.stiffness).unwrap();
        let operator = choice.build(domain).unwrap();
        let trial = Trial::new(domain, &operator, 0).unwrap();
        for &id in DECIDED {
            let count = counts.entry(id).or_default();
            let decision = case.decide(id).unwrap();
            let verdict = property::find(id).unwrap().decide(&trial, None);
            let expected = match decision {
                Decision::Holds => Status::Holds,
                Decision::Fails(_) => Status::Fails,
                Decision::Silent => Status::NotApplicable,
            };
            if verdict.status() == Status::Undecided {
                count.open += 1;
                continue;
            }
            assert_eq!(verdict.status(), expected, "{choice} {id} on {:?}: {verdict:?}", domain.positions());
            match expected {
                Status::Holds => count.holds += 1,
                Status::Fails => count.fails += 1,
                _ => count.silent += 1,
            }
        }
    }
}

fn choices() -> Vec<Choice> {
    OPERATORS.iter().map(|text| text.parse().unwrap()).collect()
}

#[test]
fn over_every_small_triangulation_both_ways_come_to_the_same() {
    let (choices, mut counts) = (choices(), BTreeMap::new());
    // Six points take an optimised build a few seconds.
    for t in world(if cfg!(debug_assertions) { 5 } else { 6 }) {
        // Most of the world has six points: three operators of different kinds are enough there.
        let some = if t.points().len() > 5 { &choices[..3] } else { &choices[..] };
        compare(&t.surface().into(), some, &mut counts);
    }
    for (id, count) in &counts {
        // Where signs are rounded (p = 4, p = −2) a weight that is exactly zero may come out as a last bit.
        assert!(count.open * 200 <= count.holds, "{id}: rounding leaves {} open", count.open);
        assert!(count.holds > 100, "{id}");
        let never = ["NULL", "KER"].contains(id);
        assert!(never || count.fails > 100, "{id} fails {} times", count.fails);
    }
}

#[test]
fn on_random_meshes_of_up_to_thirty_vertices_both_ways_come_to_the_same() {
    let (choices, mut counts) = (choices(), BTreeMap::new());
    for (n, seed) in [(6, 1), (8, 2), (10, 3), (13, 4), (17, 5), (22, 6), (30, 7)] {
        let recipe = format!("random-delaunay:n={n},seed={seed} | flip:count={},seed={seed}", n / 2);
        let domain = recipe.parse::<Recipe>().unwrap().build(Path::new(".")).unwrap();
        // The numbers grow with the exponents: the larger meshes are for the first two operators.
        let some = if n > 15 { &choices[..2] } else { &choices[..] };
        compare(&domain, some, &mut counts);
    }
    let (open, all) = counts.values().fold((0, 0), |(o, a), c| (o + c.open, a + c.open + c.holds + c.fails + c.silent));
    assert!(open * 50 <= all, "{open} of {all} were left open");
}
