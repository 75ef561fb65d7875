//! Statements about triangulations, drawings and smooth forms: decided by the numbers written down with them, in whole numbers and
//! fractions, with or without an operator at hand.

use dashu_int::IBig;

use super::{
    Answer, Refusal, cospectral, drawing, eigenvalues, extension, flips, harmonic, lattice, tetrahedra, transplantation,
};
use crate::property::evidence::{Evidence, Fraction, Statement};
use crate::scalar::{Rational, Scalar};

/// Coordinates and values are whole numbers up to this: sums and differences of them are exact in `f64`.
const LARGEST: f64 = (1_u64 << 40) as f64;

/// Decides a statement of this kind; `None` for the others.
pub(super) fn decide(evidence: &Evidence) -> Option<Answer> {
    let excerpt = &evidence.excerpt;
    match &evidence.statement {
        Statement::FlipsToDelaunay { flips, end, values, energies } => {
            Some(flips::decide(excerpt, flips, end, values, energies))
        }
        Statement::DelaunayNotMinimal { delaunay, other, values, energies } => {
            Some(tetrahedra::decide(excerpt, [delaunay, other], values, energies))
        }
        Statement::PositiveExtension { i, j, weight, smallest } => {
            Some(extension::decide(excerpt, [*i, *j], weight, smallest))
        }
        Statement::NotEmbedded { boundary, weights, drawing, checksum, missing, fault } => {
            let drawn = drawing::Drawn { boundary, weights, drawing, checksum };
            Some(drawing::decide(excerpt, &drawn, *missing, fault))
        }
        Statement::TorusFlips { start, flips, end } => Some(lattice::decide(start, *flips, end)),
        Statement::Cospectral { vertices, first, second, normalised, polynomial } => {
            Some(cospectral::decide(*vertices, [first, second], *normalised, polynomial))
        }
        Statement::Transplantation { first, second, condition, matrix, dual, outlines } => {
            Some(transplantation::decide([first, second], *condition, [matrix, dual], outlines))
        }
        Statement::SpectraDiffer { first, second, condition, mass, sigma, below, determinants } => {
            let stated = eigenvalues::Stated { sigma, below: *below, determinants };
            Some(eigenvalues::differ([first, second], (*condition, *mass), &stated))
        }
        Statement::DelaunayEigenvalue { other, condition, mass, sigma, below, determinants } => {
            let stated = eigenvalues::Stated { sigma, below: *below, determinants };
            Some(eigenvalues::more_on_delaunay(excerpt, other, (*condition, *mass), &stated))
        }
        Statement::HarmonicForm { dimension, form, exception } => Some(harmonic::decide(*dimension, form, exception)),
        _ => None,
    }
}

/// The integer equal to a number.
pub(super) fn whole(what: &'static str, index: usize, x: f64) -> Result<IBig, Refusal> {
    if x.fract() == 0.0 && x.abs() <= LARGEST {
        return Ok(IBig::from(x as i64));
    }
    Err(Refusal::Malformed { what, index, problem: "is no whole number of moderate size" })
}

/// The positions of an excerpt, numbered from 0 without a gap, as whole numbers.
pub(super) fn whole_positions(positions: &[(usize, [f64; 3])]) -> Result<Vec<[IBig; 3]>, Refusal> {
    let mut points = Vec::with_capacity(positions.len());
    for (expected, &(index, p)) in positions.iter().enumerate() {
        if index != expected {
            return Err(Refusal::Missing { what: "position", index: expected });
        }
        let [x, y, z] = p.map(|x| whole("position", index, x));
        points.push([x?, y?, z?]);
    }
    Ok(points)
}

/// The faces of an excerpt, numbered from 0 without a gap, as triangles.
pub(super) fn triangles(faces: &[(usize, Vec<usize>)]) -> Result<Vec<[usize; 3]>, Refusal> {
    let mut read = Vec::with_capacity(faces.len());
    for (expected, (index, corners)) in faces.iter().enumerate() {
        if *index != expected {
            return Err(Refusal::Missing { what: "face", index: expected });
        }
        let malformed = Refusal::Malformed { what: "face", index: *index, problem: "is no triangle" };
        read.push(<[usize; 3]>::try_from(corners.as_slice()).map_err(|_| malformed)?);
    }
    Ok(read)
}

/// A fraction of whole numbers.
pub(super) fn fraction(numerator: IBig, denominator: IBig) -> Rational {
    Rational::from(numerator) / Rational::from(denominator)
}

/// Refuses a fraction that is not written down exactly as `p/q` in lowest terms.
pub(super) fn check_exact(name: &str, stated: &str, found: &Rational) -> Result<(), Refusal> {
    let found = written(found);
    if stated == found {
        return Ok(());
    }
    Err(Refusal::untrue(format!("{name} = {stated}"), found))
}

/// Reads a fraction that is written in lowest terms.
pub(super) fn lowest_terms(what: &'static str, index: usize, text: &Fraction) -> Result<Rational, Refusal> {
    match text.value().filter(|value| Fraction::from(value) == *text) {
        Some(value) => Ok(value),
        None => Err(Refusal::Malformed { what, index, problem: "is no fraction in lowest terms" }),
    }
}

/// A rational number as `p/q` in lowest terms, `p` where q is 1.
pub(super) fn written(x: &Rational) -> String {
    x.clone().reduced().to_string()
}
