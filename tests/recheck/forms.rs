//! Forged statements about smooth forms: every number in them is right, and one thing that they rest on is not.

use lapjury::property::evidence::{Exception, Fraction, Term};
use lapjury::property::recheck::{Rechecked, Refusal, against, from_excerpt};
use lapjury::property::{Evidence, Statement};

use crate::triangulations::{numbers, others};

fn term(coefficient: &str, exponents: &[u32], differentials: &[usize]) -> Term {
    let coefficient = Fraction::text(coefficient);
    Term { coefficient, exponents: exponents.to_vec(), differentials: differentials.to_vec() }
}

fn answer(dimension: usize, form: &[Term], exception: Exception) -> Result<Rechecked, Refusal> {
    let statement = Statement::HarmonicForm { dimension, form: form.to_vec(), exception };
    let text = serde_json::to_string(&Evidence::bare(statement)).unwrap();
    from_excerpt(&serde_json::from_str(&text).unwrap())
}

fn not_closed(dimension: usize, form: &[Term], derivative: &[Term]) -> Result<Rechecked, Refusal> {
    answer(dimension, form, Exception::Closed { derivative: derivative.to_vec() })
}

fn not_co_closed(dimension: usize, form: &[Term], codifferential: &[Term]) -> Result<Rechecked, Refusal> {
    answer(dimension, form, Exception::CoClosed { codifferential: codifferential.to_vec() })
}

fn minimum(dimension: usize, form: &[Term], value: &str) -> Result<Rechecked, Refusal> {
    answer(dimension, form, Exception::NoMinimum { value: Fraction::text(value) })
}

#[track_caller]
fn refused_for(answer: Result<Rechecked, Refusal>, reason: &str) {
    let refusal = answer.expect_err(reason).to_string();
    assert!(refusal.contains(reason), "{refusal}");
}

const TRUE: Result<Rechecked, Refusal> = Ok(Rechecked::Exact);

/// `−y dx + x dy`.
fn turning() -> [Term; 2] {
    [term("-1", &[0, 1], &[0]), term("1", &[1, 0], &[1])]
}

/// True statements with several terms, several dimensions and fractions.
fn statements() -> Vec<Statement> {
    let of =
        |dimension, form: &[Term], exception| Statement::HarmonicForm { dimension, form: form.to_vec(), exception };
    // x² − y² + 3/2 z, its derivative in an order that somebody may have written it in.
    let saddle = [term("1", &[2, 0, 0], &[]), term("-1", &[0, 2, 0], &[]), term("3/2", &[0, 0, 1], &[])];
    let derivative = vec![term("3/2", &[0, 0, 0], &[2]), term("-2", &[0, 1, 0], &[1]), term("2", &[1, 0, 0], &[0])];
    let rotation = vec![term("2", &[0, 0], &[0, 1])];
    // d*(x z dx∧dy) = −z dy.
    let screw = vec![term("-1", &[0, 0, 1], &[1])];
    vec![
        of(2, &turning(), Exception::Closed { derivative: rotation }),
        of(3, &saddle, Exception::Closed { derivative }),
        of(3, &[term("1", &[1, 0, 1], &[0, 1])], Exception::CoClosed { codifferential: screw }),
        of(3, &[term("-7/3", &[0, 0, 0], &[])], Exception::NoMinimum { value: Fraction::text("-7/3") }),
    ]
}

#[test]
fn forms_of_every_degree_with_fractions_are_verified_and_none_of_their_numbers_can_be_changed() {
    let mut tried = 0;
    for statement in statements() {
        let original = serde_json::to_value(Evidence::bare(statement)).unwrap();
        let read = |value| serde_json::from_value::<Evidence>(value).ok();
        assert_eq!(from_excerpt(&read(original.clone()).unwrap()), TRUE, "{original}");
        let mut places = Vec::new();
        numbers(&original, "", &mut places);
        for place in places {
            for other in others(original.pointer(&place).unwrap()) {
                let mut value = original.clone();
                *value.pointer_mut(&place).unwrap() = other.clone();
                let Some(changed) = read(value).filter(|_| original.pointer(&place) != Some(&other)) else { continue };
                tried += 1;
                assert!(from_excerpt(&changed).is_err(), "{place} = {other} in {original}");
            }
        }
    }
    assert!(tried > 150, "{tried}");
}

#[test]
fn what_is_not_harmonic_is_refused_whatever_its_derivative() {
    refused_for(not_closed(1, &[term("1", &[2], &[])], &[term("2", &[1], &[])]), "Δα = 0");
    refused_for(not_closed(1, &[term("1", &[2], &[])], &[term("2", &[1], &[0])]), "Δα = 0");
    refused_for(not_co_closed(1, &[term("1", &[2], &[0])], &[term("-2", &[1], &[])]), "Δα = 0");
    // The bowl has a minimum, and it is strict.
    refused_for(minimum(2, &[term("1", &[2, 0], &[]), term("1", &[0, 2], &[])], "0"), "Δα = 0");
}

#[test]
fn a_closed_form_and_a_co_closed_one_are_no_exceptions() {
    refused_for(not_closed(1, &[term("1", &[1], &[0])], &[]), "dα is not zero");
    refused_for(not_closed(1, &[term("1", &[0], &[])], &[]), "dα is not zero");
    refused_for(not_co_closed(2, &turning(), &[]), "d*α is not zero");
    // A function has no codifferential, whatever is written down for it.
    refused_for(not_co_closed(1, &[term("1", &[1], &[])], &[term("1", &[0], &[])]), "d*α is not zero");
    // y dx + x dy = d(xy): each term alone has a derivative.
    let exact = [term("1", &[0, 1], &[0]), term("1", &[1, 0], &[1])];
    refused_for(not_closed(2, &exact, &[]), "dα is not zero");
}

#[test]
fn a_wrong_sign_and_a_missing_term_are_refused() {
    refused_for(not_closed(2, &turning(), &[term("-2", &[0, 0], &[0, 1])]), "dα = -2 dx0∧dx1; found: 2 dx0∧dx1");
    refused_for(not_co_closed(1, &[term("1", &[1], &[0])], &[term("1", &[0], &[])]), "d*α = 1; found: -1");
    let saddle = [term("1", &[2, 0], &[]), term("-1", &[0, 2], &[])];
    refused_for(not_closed(2, &saddle, &[term("2", &[1, 0], &[0])]), "dα = 2 x0 dx0; found: 2 x0 dx0 + -2 x1 dx1");
}

#[test]
fn a_saddle_has_no_minimum_and_a_form_is_no_function() {
    let saddle = [term("1", &[2, 0], &[]), term("-1", &[0, 2], &[])];
    refused_for(minimum(2, &saddle, "0"), "α is the constant 0");
    refused_for(minimum(1, &[term("1", &[0], &[])], "2"), "α is the constant 2");
    refused_for(minimum(1, &[term("1", &[0], &[0])], "1"), "α is the constant 1");
    refused_for(minimum(2, &[], "0"), "not zero");
}

#[test]
fn a_term_that_could_be_anything_is_refused() {
    let with_a_constant = [term("1", &[1], &[]), term("5", &[0], &[])];
    refused_for(not_closed(1, &with_a_constant, &[term("1", &[0], &[0])]), "every term of α has a share in dα");
    let with_a_turn = [term("1", &[1, 0], &[0]), term("5", &[1, 0], &[1])];
    refused_for(not_co_closed(2, &with_a_turn, &[term("-1", &[0, 0], &[])]), "every term of α has a share in d*α");
}

#[test]
fn what_is_no_form_is_refused() {
    let dx = || [term("1", &[0], &[0])];
    let malformed = [
        (1, vec![term("2/2", &[1], &[])], "no fraction in lowest terms"),
        (1, vec![term("0", &[1], &[])], "is zero, or given twice"),
        (1, vec![term("1", &[1], &[]), term("1", &[1], &[])], "is zero, or given twice"),
        (2, vec![term("1", &[1], &[])], "one exponent for each dimension"),
        (1_000_000, vec![term("1", &[1], &[])], "one exponent for each dimension"),
        (1, vec![term("1", &[1], &[1])], "do not ascend, or of no coordinate"),
        (1, vec![term("1", &[1], &[0, 0])], "do not ascend, or of no coordinate"),
        (2, vec![term("1", &[1, 0], &[1, 0])], "do not ascend, or of no coordinate"),
        (1, vec![term("1", &[1], &[]), term("1", &[0], &[0])], "of one degree"),
    ];
    for (dimension, form, reason) in malformed {
        refused_for(not_closed(dimension, &form, &dx()), reason);
    }
    refused_for(not_closed(1, &[term("1", &[1], &[])], &[term("1", &[0, 0], &[0])]), "of the image");
    let huge = [term("1", &[u32::MAX], &[])];
    refused_for(not_closed(1, &huge, &dx()), "Δα = 0");
}

#[test]
fn more_dimensions_than_are_computed_with_stay_open() {
    let (mut exponents, zero) = (vec![0; 9], [0; 9]);
    exponents[0] = 1;
    assert!(matches!(not_closed(9, &[term("1", &exponents, &[])], &[term("1", &zero, &[0])]), Ok(Rechecked::Open(_))));
}

#[test]
fn it_decides_no_property_of_an_operator() {
    let example = crate::all().into_iter().find(|e| e.property == "SYM").unwrap();
    let exception = Exception::NoMinimum { value: Fraction::text("1") };
    let statement = Statement::HarmonicForm { dimension: 1, form: vec![term("1", &[0], &[])], exception };
    let evidence = Evidence::bare(statement);
    let held = |property| against(&evidence, property, &example.domain, &example.operator);
    refused_for(held("SYM"), "decides nothing about SYM");
    assert_eq!(held("MY-OWN"), TRUE);
}
