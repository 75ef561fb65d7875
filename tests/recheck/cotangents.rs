//! Forged statements about the accuracy of cotangent weights.

use lapjury::domain::{Domain, Surface};
use lapjury::laplacian;
use lapjury::operator::Operator;
use lapjury::property::recheck::{Refusal, against};
use lapjury::property::{Evidence, Excerpt, Statement};

use crate::operators::{faces, operator, positions, rows, square, square_cotan, with};
use crate::refused_for;
use crate::witnesses::named;

/// A statement that the weight of the spoke (0, 4) of the square, which is 1 as it should be, is off.
fn off_the_spoke(around: &[usize], exact: f64, error: f64) -> Evidence {
    let right = operator(5, &square_cotan());
    let excerpt = faces(positions(rows(&right, &[0]), &square(), &[0, 1, 2, 3, 4]), &square(), around);
    Evidence::new(Statement::Inaccurate { i: 0, j: 4, exact, error, threshold: 1e-3 }, excerpt)
}

#[test]
fn faces_elsewhere_say_nothing_about_an_edge() {
    // Face 1 is at the end 4 and not at 0; its corner 1 would add ½ cot 45°.
    refused_for(&off_the_spoke(&[0, 1, 3], 1.5, 0.5), "face 1 of the evidence does not lie at the edge");
    refused_for(&off_the_spoke(&[], 0.0, 1.0), "a face at the edge from vertex 0");
}

#[test]
fn an_inaccuracy_exceeds_a_threshold_that_is_a_number() {
    for bad in [-1e-3, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let mut evidence = named("inaccurate weight").evidence;
        let Statement::Inaccurate { threshold, .. } = &mut evidence.statement else { unreachable!() };
        *threshold = bad;
        refused_for(&evidence, "it must be finite and not negative");
    }
}

#[test]
fn an_inaccuracy_is_more_than_the_threshold_and_more_than_one_rounding() {
    let with_threshold = |weight: f64, threshold: f64| {
        let spoilt = operator(5, &with(square_cotan(), &[(0, 4, -weight)]));
        let excerpt = faces(positions(rows(&spoilt, &[0]), &square(), &[0, 1, 3, 4]), &square(), &[0, 3]);
        let statement = Statement::Inaccurate { i: 0, j: 4, exact: 1.0, error: weight - 1.0, threshold };
        Evidence::new(statement, excerpt)
    };
    let accepted = |evidence: &Evidence| lapjury::property::recheck::from_excerpt(evidence).is_ok();
    assert!(accepted(&with_threshold(1.5, 0.5_f64.next_down())));
    refused_for(&with_threshold(1.5, 0.5), "off by more than the threshold");
    // One rounding of 1 is 2⁻⁵³; the next numbers above 1 are 2⁻⁵² apart, those below half of that.
    assert!(accepted(&with_threshold(1.0_f64.next_up(), 0.0)));
    let below = 1.0_f64.next_down();
    refused_for(&with_threshold(below, 0.0), "off by more than one rounding of its terms");
}

/// The certificate of accuracy on a mesh of this many edges.
fn certified(domain: &Domain, operator: &Operator) -> Result<(), Refusal> {
    let checked = domain.edges().len();
    let evidence = Evidence::new(Statement::Scan { checked, worst: vec![0, 1] }, Excerpt::default());
    against(&evidence, "ACC", domain, operator).map(drop)
}

#[test]
fn a_mesh_with_one_weight_off_is_not_certified_to_be_accurate() {
    // On triangles so thin plain numbers are not asked, and rounding excuses more.
    let thin = Surface::planar(&[[0.0, 0.0], [1.0, 0.0], [0.5, 2e-4], [0.5, -2e-4]], &[[0, 1, 2], [1, 0, 3]]).unwrap();
    for (domain, smallest) in [(square(), 1e-9), (thin.into(), 1e-3)] {
        let right = laplacian::find("cotan").unwrap().build(&domain, &Default::default()).unwrap();
        assert_eq!(certified(&domain, &right), Ok(()));
        let entries: Vec<_> = right.stiffness().entries().map(|(i, j, v)| (i, j, *v)).collect();
        let weight = right.stiffness().at(0, 1);
        let scale: f64 = right.stiffness().row(0).map(|(_, v)| v.abs()).sum();
        for off in [smallest * scale, -scale] {
            let spoilt = operator(right.size(), &with(entries.clone(), &[(0, 1, weight + off)]));
            let refusal = certified(&domain, &spoilt).unwrap_err().to_string();
            assert!(refusal.contains("the weight of (0, 1) is ½ Σ cot"), "{refusal}");
        }
    }
}
