//! Certificates: each decided again on the whole matrix.

use super::solutions::{self, Stated};
use super::{Answer, Rechecked, Refusal, classes, maximum, scan, spectrum};
use crate::domain::Domain;
use crate::operator::Operator;
use crate::property::evidence::Statement;

/// What separates a kernel from the rest, relative to the row scales, is at most this; it must stay well below one.
const LARGEST_SHIFT: f64 = 1.0 / 8192.0;

/// Refuses numbers that no computation can have given.
pub(super) fn check_numbers(statement: &Statement) -> Result<(), Refusal> {
    let check = |name, value: f64, holds: bool, must| {
        if holds && value.is_finite() { Ok(()) } else { Err(Refusal::Parameter { name, value, must }) }
    };
    match *statement {
        Statement::Scan { ref worst, .. } => {
            check("the length of worst", worst.len() as f64, worst.len() <= 2, "at most 2")
        }
        Statement::ShiftedFactor { shift, smallest_pivot } => {
            check("shift", shift, shift > 0.0, "positive")?;
            let possible = (0.0..=1.0 + 3.0 * shift).contains(&smallest_pivot);
            check("smallest_pivot", smallest_pivot, possible, "positive and at most the row scale")
        }
        Statement::InertiaCount { shift, .. } => {
            check("shift", shift, shift > 0.0 && shift <= LARGEST_SHIFT, "positive and at most 2⁻¹³")
        }
        Statement::SingularValues { zero, positive, .. } => {
            check("zero", zero, (0.0..=LARGEST_SHIFT).contains(&zero), "at least 0 and at most 2⁻¹³")?;
            let possible = (positive > zero && positive <= 1.0 + 1e-9) || (positive == 0.0 && zero == 0.0);
            check("positive", positive, possible, "between zero and 1")
        }
        Statement::Solved { smallest, error, .. } => {
            check("error", error, error >= 0.0, "not negative")?;
            check("smallest", smallest, smallest >= -error, "no smaller than the error below zero")
        }
        Statement::Compared { ref transformations, .. } => {
            let count = transformations.len();
            check("the number of transformations", count as f64, count > 0, "positive")
        }
        _ => Ok(()),
    }
}

/// Decides a certificate of a property on the whole matrix.
pub(super) fn decide(statement: &Statement, property: &str, domain: &Domain, operator: &Operator) -> Answer {
    match statement {
        Statement::Scan { checked, worst } => scan::decide(property, domain, operator, *checked, worst),
        Statement::SumOfSquares => spectrum::sum_of_squares(domain, operator),
        Statement::ShiftedFactor { shift, .. } => spectrum::shifted_factor(domain, operator, *shift),
        Statement::InertiaCount { shift, kernel } => spectrum::inertia(domain, operator, *shift, *kernel),
        Statement::ClosedClasses { kernel } => classes::decide(domain, operator, *kernel),
        Statement::SingularValues { kernel, .. } => spectrum::singular_values(domain, operator, *kernel),
        Statement::SignPattern { set } => maximum::sign_pattern(property, domain, operator, *set),
        Statement::Solved { columns, smallest, error } => solutions::decide(
            property,
            domain,
            operator,
            Stated { columns: *columns, smallest: *smallest, error: *error },
        ),
        Statement::Compared { .. } => {
            Ok(Rechecked::Open("the construction would have to be called again on the transformed domains".into()))
        }
        _ => Ok(Rechecked::Open("the statement is a witness".into())),
    }
}
