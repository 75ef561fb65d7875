//! A true certificate of every kind, and matrices spoilt under it.

use lapjury::domain::Domain;
use lapjury::linalg::Csr;
use lapjury::operator::Operator;
use lapjury::property::recheck::{Rechecked, Refusal, against, of_verdict};
use lapjury::property::{Evidence, Level, Statement, Verdict};

use crate::operators::*;
use crate::{Example, Expected, Expected::*};

/// Masses of the square: a third of the area around each vertex.
const THIRDS: [f64; 5] = [2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 4.0 / 3.0];

fn example(
    name: &'static str,
    property: &'static str,
    domain: Domain,
    operator: Operator,
    statement: Statement,
    held_against: Expected,
) -> Example {
    Example { name, property, domain, operator, evidence: Evidence::bare(statement), alone: Open, held_against }
}

fn good_square() -> Operator {
    lumped(operator(5, &square_cotan()), &THIRDS)
}

fn scan(name: &'static str, property: &'static str, checked: usize, expected: Expected) -> Example {
    example(name, property, square(), good_square(), Statement::Scan { checked, worst: vec![4] }, expected)
}

/// Weights of a walk around a triangle in one direction: not symmetric, kernel of dimension one.
fn walk() -> Vec<(usize, usize, f64)> {
    (0..3).flat_map(|i| [(i, i, 1.0), (i, (i + 1) % 3, -1.0)]).collect()
}

/// A square of side 2 with a vertex at its centre and a negative weight inside, whose extension is positive nevertheless.
fn mixed_signs() -> (Domain, Operator) {
    // Path 0 – 2 – 3 – 1 with an extra weight −¼ between 0 and 3: at 2: 2u₂ − u₃ = u₀; at 3: 1¾ u₃ − u₂ = u₁ − ¼ u₀.
    // With u₀ = 1: 2·(7/4) − 1 = 5/2: u₂ = (7/4 − 1/4)/(5/2) = 3/5, u₃ = (2·(−¼) + 1)/(5/2) = 1/5. With u₁ = 1: 2/5, 4/5.
    let d = graph(4, &[[0, 2], [2, 3], [1, 3], [0, 3]], &[0, 1]);
    (d, operator(4, &laplacian(&[(0, 2, 1.0), (2, 3, 1.0), (1, 3, 1.0), (0, 3, -0.25)])))
}

pub fn all() -> Vec<Example> {
    let triangle = || graph(3, &[[0, 1], [1, 2], [0, 2]], &[]);
    let (domain, operator_with_signs) = mixed_signs();
    vec![
        scan("finite", "FIN", 18, Exact),
        scan("local", "LOC", 8, Exact),
        scan("symmetric", "SYM", 4, Exact),
        scan("null", "NULL", 5, Exact),
        scan("positive", "POS", 4, Exact),
        scan("not negative", "POS0", 4, Exact),
        scan("linear", "LIN", 1, Bounded),
        scan("flux", "FLUX", 4, Bounded),
        scan("energy", "ENERGY", 4, Bounded),
        scan("mean value", "MVP", 1, Exact),
        scan("local maximum", "MAX-local", 1, Exact),
        scan("mass", "MASS", 5, Bounded),
        example(
            "positive on the boundary",
            "POS-boundary",
            kite(),
            operator(4, &kite_cotan()),
            Statement::Scan { checked: 4, worst: vec![0, 2] },
            Exact,
        ),
        example("sum of squares", "PSD", square(), good_square(), Statement::SumOfSquares, Exact),
        example(
            "shifted factor",
            "PSD",
            kite(),
            operator(4, &kite_cotan()),
            Statement::ShiftedFactor { shift: 1e-12, smallest_pivot: 1e-12 },
            Bounded,
        ),
        example(
            "inertia",
            "KER",
            kite(),
            operator(4, &kite_cotan()),
            Statement::InertiaCount { shift: 1e-10, kernel: 1 },
            Bounded,
        ),
        example(
            "closed classes",
            "KER",
            square(),
            good_square().with_exact_signs(),
            Statement::ClosedClasses { kernel: 1 },
            Exact,
        ),
        example(
            "singular values",
            "KER",
            triangle(),
            operator(3, &walk()),
            // |e^{2πi/3} − 1| = √3 twice.
            Statement::SingularValues { kernel: 1, zero: 1e-16, positive: 1.0 },
            Bounded,
        ),
        example(
            "sign pattern",
            "MAX-global",
            square(),
            good_square().with_exact_signs(),
            Statement::SignPattern { set: 4 },
            Exact,
        ),
        example(
            "sign pattern of a closed domain",
            "MAX-global",
            triangle(),
            operator(3, &walk()),
            Statement::SignPattern { set: 2 },
            Bounded,
        ),
        example("sign pattern of heat", "MAX-heat", square(), good_square(), Statement::SignPattern { set: 0 }, Exact),
        example(
            "solved",
            "MAX-global",
            domain,
            operator_with_signs,
            Statement::Solved { columns: 2, smallest: 0.2, error: 1e-14 },
            Bounded,
        ),
        example(
            "solved for heat",
            "MAX-heat",
            graph(2, &[[0, 1]], &[]),
            // (M + tL)⁻¹ M = (1/(1 + 2t)) [1 + t, t; t, 1 + t]: the smallest is t/(1 + 2t) at t = 1/16.
            lumped(operator(2, &laplacian(&[(0, 1, 1.0)])), &[1.0, 1.0]),
            Statement::Solved { columns: 2, smallest: 1.0 / 18.0, error: 1e-14 },
            Bounded,
        ),
        example(
            "compared",
            "PERM",
            square(),
            good_square(),
            Statement::Compared { transformations: vec!["reversed numbering".into()], entries: 13 },
            Open,
        ),
    ]
}

fn named(name: &str) -> Example {
    all().into_iter().find(|e| e.name == name).unwrap()
}

#[test]
fn true_certificates_survive_json_and_are_accepted() {
    all().iter().for_each(Example::assert_true);
}

/// The certificate under a spoilt operator.
fn refused(name: &str, entries: &[(usize, usize, f64)]) {
    let e = named(name);
    let n = e.operator.size();
    let kept = e.operator.stiffness().entries().map(|(i, j, v)| (i, j, *v)).collect();
    let spoilt = operator(n, &with(kept, entries));
    let spoilt = match e.operator.mass() {
        Some(m) => spoilt.with_mass(m.clone()).unwrap(),
        None => spoilt,
    };
    match against(&e.evidence, e.property, &e.domain, &spoilt) {
        Err(Refusal::Untrue { stated, found }) => assert!(!stated.is_empty() && !found.is_empty()),
        other => panic!("{name} with {entries:?}: {other:?}"),
    }
}

#[test]
fn certificates_over_a_spoilt_matrix_are_refused() {
    refused("finite", &[(2, 2, f64::INFINITY)]);
    refused("local", &[(0, 2, -1e-6)]);
    refused("symmetric", &[(0, 4, -1.0 - 1e-9)]);
    refused("symmetric", &[(0, 4, 0.0)]);
    refused("null", &[(3, 3, 1.0 + 1e-9)]);
    refused("positive", &[(4, 2, 0.0)]);
    refused("positive", &[(2, 4, 1e-300)]);
    refused("positive", &[(0, 2, 1e-3)]);
    refused("not negative", &[(4, 2, 1e-6)]);
    refused("positive on the boundary", &[(2, 0, 0.25)]);
    refused("linear", &[(4, 2, -1.0 - 1e-9)]);
    refused("flux", &[(3, 4, -1.0 - 1e-9)]);
    refused("energy", &[(3, 4, -1.0 - 1e-9), (3, 3, 1.0 + 1e-9)]);
    refused("mean value", &[(4, 4, 4.0 + 1e-9)]);
    refused("mean value", &[(4, 4, -4.0), (4, 0, 7.0)]);
    refused("local maximum", &[(4, 0, 1e-6)]);
    refused("local maximum", &[(4, 0, 0.0), (4, 1, 0.0), (4, 2, 0.0), (4, 3, 0.0)]);
    refused("sum of squares", &[(4, 0, 1.0), (0, 4, 1.0), (4, 4, 2.0), (0, 0, -1.0)]);
    refused("sum of squares", &[(4, 4, 3.9)]);
    refused("shifted factor", &[(0, 1, 2.5), (1, 0, 2.5), (0, 0, -0.5), (1, 1, -0.5)]);
    refused("inertia", &[(2, 0, 0.0), (0, 2, 0.0), (2, 1, 0.0), (1, 2, 0.0), (2, 2, 0.0), (0, 0, 0.25), (1, 1, 0.25)]);
    refused("inertia", &[(2, 2, 2.1)]);
    refused("closed classes", &[(0, 4, 0.0), (0, 0, 0.0), (4, 0, 0.0), (4, 4, 3.0)]);
    refused("closed classes", &[(0, 4, 1.0), (0, 0, -1.0)]);
    refused("singular values", &[(0, 0, 1.5)]);
    refused("sign pattern", &[(4, 0, 1.0), (4, 4, 2.0)]);
    refused("sign pattern", &[(4, 4, 3.0)]);
    refused("sign pattern", &[(4, 0, 0.0), (4, 1, 0.0), (4, 2, 0.0), (4, 3, 0.0), (4, 4, 0.0)]);
    refused("sign pattern of a closed domain", &[(0, 1, 0.0), (0, 0, 0.0)]);
    refused("sign pattern of heat", &[(0, 4, 0.5), (0, 0, -0.5)]);
    refused("solved", &[(3, 0, 1.0), (3, 3, 1.0)]);
    refused("solved", &[(3, 3, 0.6)]);
    refused("solved for heat", &[(0, 1, 1.0), (1, 0, 1.0)]);
}

#[test]
fn masses_spoilt_under_their_certificate_are_refused() {
    let e = named("mass");
    let plain = || operator(5, &square_cotan());
    let diagonal: Vec<_> = THIRDS.iter().enumerate().map(|(i, m)| (i, i, *m)).collect();
    for spoilt in [
        lumped(plain(), &[0.7, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 4.0 / 3.0]),
        lumped(plain(), &[0.0, 4.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 4.0 / 3.0]),
        lumped(plain(), &[-2.0 / 3.0, 2.0, 2.0 / 3.0, 2.0 / 3.0, 4.0 / 3.0]),
        lumped(plain(), &[0.1, 0.1, 0.1, 0.1, 3.6]),
        full_mass(plain(), &with(diagonal.clone(), &[(0, 4, 0.1), (1, 4, -0.1)])),
        full_mass(plain(), &with(diagonal.clone(), &[(0, 1, 1.0), (1, 0, 1.0), (2, 3, -1.0), (3, 2, -1.0)])),
        plain(),
    ] {
        let answer = against(&e.evidence, e.property, &e.domain, &spoilt);
        assert!(matches!(answer, Err(Refusal::Untrue { .. })), "{answer:?}");
    }
    let consistent = with(diagonal, &[(0, 0, 0.5), (0, 4, 1.0 / 12.0), (4, 0, 1.0 / 12.0), (4, 4, 4.0 / 3.0)]);
    let consistent = full_mass(plain(), &consistent);
    assert_eq!(against(&e.evidence, e.property, &e.domain, &consistent), Ok(Rechecked::Bounded));
}

macro_rules! spoil {
    ($name:expr, $( $what:expr => $pattern:pat => $change:expr );+ $(;)?) => {{
        let e = named($name);
        $( e.assert_refused($what, |evidence| match &mut evidence.statement { $pattern => $change, _ => unreachable!() }); )+
    }};
}

#[test]
fn spoilt_certificates_are_refused() {
    for name in ["finite", "local", "symmetric", "null", "positive", "flux", "mean value", "local maximum"] {
        spoil!(name,
            "fewer places" => Statement::Scan { checked, .. } => *checked -= 1;
            "more places than there are" => Statement::Scan { checked, .. } => *checked = 1 << 40;
            "a place out of range" => Statement::Scan { worst, .. } => *worst = vec![5];
            "a place of three" => Statement::Scan { worst, .. } => *worst = vec![0, 1, 2]);
    }
    spoil!("shifted factor",
        "negative shift" => Statement::ShiftedFactor { shift, .. } => *shift = -1e-12;
        "no shift" => Statement::ShiftedFactor { shift, .. } => *shift = 0.0;
        "negative pivot" => Statement::ShiftedFactor { smallest_pivot, .. } => *smallest_pivot = -1e-9;
        "large pivot" => Statement::ShiftedFactor { smallest_pivot, .. } => *smallest_pivot = 2.0);
    spoil!("inertia",
        "kernel" => Statement::InertiaCount { kernel, .. } => *kernel = 2;
        "no kernel" => Statement::InertiaCount { kernel, .. } => *kernel = 0;
        "a shift that says nothing" => Statement::InertiaCount { shift, .. } => *shift = 0.5);
    spoil!("closed classes",
        "kernel" => Statement::ClosedClasses { kernel } => *kernel = 2;
        "no kernel" => Statement::ClosedClasses { kernel } => *kernel = 0;
        "huge" => Statement::ClosedClasses { kernel } => *kernel = usize::MAX);
    spoil!("singular values",
        "kernel" => Statement::SingularValues { kernel, .. } => *kernel = 2;
        "no gap" => Statement::SingularValues { positive, .. } => *positive = 1e-16;
        "zero that is none" => Statement::SingularValues { zero, .. } => *zero = 0.5);
    spoil!("sign pattern",
        "set" => Statement::SignPattern { set } => *set = 3;
        "empty set" => Statement::SignPattern { set } => *set = 0);
    spoil!("solved",
        "too few columns" => Statement::Solved { columns, .. } => *columns = 1;
        "too many columns" => Statement::Solved { columns, .. } => *columns = 3;
        "smallest" => Statement::Solved { smallest, .. } => *smallest = 0.21;
        "negative" => Statement::Solved { smallest, .. } => *smallest = -0.1;
        "error" => Statement::Solved { error, .. } => *error = -1.0);
    spoil!("solved for heat",
        "no columns" => Statement::Solved { columns, .. } => *columns = 0;
        "too many columns" => Statement::Solved { columns, .. } => *columns = 3;
        "smallest" => Statement::Solved { smallest, .. } => *smallest = 0.1);
    spoil!("compared", "nothing" => Statement::Compared { transformations, .. } => transformations.clear());
}

#[test]
fn a_verdict_with_evidence_for_the_other_side_is_refused() {
    let e = named("symmetric");
    let verdict = Verdict::holds(Level::Exact, e.evidence.clone());
    assert_eq!(of_verdict(&verdict, e.property, &e.domain, &e.operator), Ok(Some(Rechecked::Exact)));
    let turned = Verdict::fails(Level::Exact, e.evidence.clone());
    let refusal = of_verdict(&turned, e.property, &e.domain, &e.operator).unwrap_err();
    assert_eq!(refusal.to_string(), "the verdict is 'fails', but its evidence is a certificate");
    let open = Verdict::undecided("close");
    assert_eq!(of_verdict(&open, e.property, &e.domain, &e.operator), Ok(None));
}

#[test]
fn an_operator_of_another_size_is_refused() {
    let e = named("symmetric");
    let answer = against(&e.evidence, e.property, &e.domain, &operator(4, &kite_cotan()));
    assert_eq!(answer, Err(Refusal::Size { rows: 4, vertices: 5 }));
}

#[test]
fn what_the_second_way_cannot_decide_is_said_to_be_open() {
    let e = named("solved");
    let closed = graph(4, &[[0, 2], [2, 3], [1, 3], [0, 3]], &[]);
    let answer = against(&e.evidence, e.property, &closed, &e.operator).unwrap();
    assert!(matches!(&answer, Rechecked::Open(why) if why.contains("sets")), "{answer:?}");
    let n = 600;
    let ring: Vec<[usize; 2]> = (0..n).map(|i| [i, (i + 1) % n]).collect();
    let walk: Vec<_> = (0..n).flat_map(|i| [(i, i, 1.0), (i, (i + 1) % n, -1.0)]).collect();
    let large = Operator::new(Csr::from_triplets(n, n, &walk), Default::default()).unwrap();
    let values = Evidence::bare(Statement::SingularValues { kernel: 1, zero: 1e-16, positive: 1e-3 });
    let answer = against(&values, "KER", &graph(n, &ring, &[]), &large).unwrap();
    assert!(matches!(&answer, Rechecked::Open(why) if why.contains("too many")), "{answer:?}");
}
