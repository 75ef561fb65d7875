//! The spectra of both drums in floating point, and eigenfunctions that correspond.

use std::collections::BTreeMap;

use super::{Condition, ENTRY, RIGHT, Way, lifts};
use crate::domain::{Domain, Surface};
use crate::experiment::poll::{Case, Every};
use crate::experiment::world::drums::Pair;
use crate::experiment::{Finding, Setting};
use crate::figure::{Figure, Sketch};
use crate::generate;
use crate::laplacian;
use crate::linalg::spectrum::{Spectrum, lowest};
use crate::operator::Operator;
use crate::property::Level;
use crate::scalar::Scalar;

/// How many eigenvalues are compared.
const COUNT: usize = 20;

/// What "the same" means here, relative to the eigenvalue, or to the first one that is not zero.
const AGREEMENT: f64 = 1e-10;

/// Parts of a side in the pictures: 343 triangles.
const PARTS: usize = 7;

/// The lower end of the spectrum of an operator with the rows that are kept.
fn spectrum(operator: &Operator, kept: &[usize], count: usize, seed: u64) -> Option<Spectrum> {
    let mass = operator.mass()?.matrix().submatrix(kept, kept);
    lowest(&operator.stiffness().submatrix(kept, kept), &mass, count, seed).ok()
}

fn cotan(domain: &Domain, mass: &str) -> Option<Operator> {
    let given = BTreeMap::from([("mass".to_string(), mass.to_string())]);
    laplacian::find("cotan")?.build(domain, &given).ok()
}

fn kept(domain: &Domain, condition: Condition) -> Vec<usize> {
    let boundary = domain.boundary();
    (0..boundary.len()).filter(|&v| condition == Condition::Neumann || !boundary[v]).collect()
}

/// Both drums as the generator makes them.
fn drums(level: usize) -> Option<[Domain; 2]> {
    let drum = generate::find("drum")?;
    let make = |which: &str| {
        let given = BTreeMap::from([("which", which.to_string()), ("level", level.to_string())]);
        drum.run(None, &given.into_iter().map(|(k, v)| (k.to_string(), v)).collect(), 0).ok()
    };
    Some([make("a")?, make("b")?])
}

/// The largest difference of the first eigenvalues, relative; `None` where a spectrum is not certified to be complete.
fn difference(domains: &[Domain; 2], condition: Condition, mass: &str, seed: u64) -> Option<f64> {
    let of = |domain: &Domain| spectrum(&cotan(domain, mass)?, &kept(domain, condition), COUNT, seed);
    let [a, b] = [of(&domains[0])?, of(&domains[1])?];
    let complete = a.closure.certified && b.closure.certified && a.values.len().min(b.values.len()) >= COUNT;
    let first = b.values.get(1).copied()?;
    let off = |(x, y): (&f64, &f64)| (x - y).abs() / y.abs().max(first);
    complete.then(|| a.values.iter().zip(&b.values).take(COUNT).map(off).fold(0.0, f64::max))
}

/// Whether the spectra agree in floating point, with pictures.
pub(super) fn agree(setting: &Setting, ways: &[Way]) -> Finding {
    let level = setting.pick(3, 4);
    let mut every = Every::default();
    let mut worst = 0.0_f64;
    for (condition, mass) in [Condition::Dirichlet, Condition::Neumann]
        .into_iter()
        .flat_map(|c| ["barycentric", "consistent"].map(|m| (c, m)))
    {
        let found = drums(level).and_then(|domains| difference(&domains, condition, mass, setting.seed));
        worst = worst.max(found.unwrap_or(f64::INFINITY));
        let agrees = found.is_some_and(|d| d <= AGREEMENT);
        every.ask((!agrees).then(|| Case::told(format!("{condition}, {mass}: they differ by {found:?}"))));
    }
    let question = format!(
        "Do the first {COUNT} eigenvalues of both drums agree to {AGREEMENT:e}, each list complete by an inertia count?"
    );
    let mut finding = every.answer(
        ENTRY.parts[6],
        question,
        &format!("problems (Dirichlet and Neumann, barycentric and consistent mass) with tiles of 4^{level} triangles"),
    );
    // The first digit is enough, and does not depend on how sums are rounded.
    finding.finding += if worst <= 1e-12 { "; to 1e-12" } else { "; to 1e-10" };
    finding.level = Level::Measured;
    finding.figures = ways.iter().filter_map(pictures).flatten().collect();
    finding
}

/// The third eigenfunction of A, and on B what the transplantation makes of it.
fn pictures(way: &Way) -> Option<[Figure; 2]> {
    let pair = Pair::new(RIGHT, PARTS, way.condition)?;
    let [r, _] = lifts(&pair, &way.t)?;
    let surfaces = [pair.drums[0].surface().ok()?, pair.drums[1].surface().ok()?];
    let operator = cotan(&surfaces[0].clone().into(), "barycentric")?;
    let found = spectrum(&operator, &pair.kept[0], 3, 0)?;
    let mut values = [vec![0.0; surfaces[0].positions().len()], vec![0.0; surfaces[1].positions().len()]];
    pair.kept[0].iter().zip(found.vector(2)).for_each(|(&v, x)| values[0][v] = *x);
    for (&(v, w), entry) in &r {
        values[1][v] += entry.approximate() * values[0][w];
    }
    let lambda = *found.values.get(2)?;
    let sketch = |surface: &Surface, values: &[f64], what: &str| {
        let largest = values.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        Figure::Sketch(Sketch {
            title: format!("{}, {what} of λ = {lambda:.4}", way.condition),
            points: surface.positions().to_vec(),
            faces: surface.faces().iter().map(<[usize]>::to_vec).collect(),
            edges: Vec::new(),
            // Four digits are what a colour shows.
            values: values.iter().map(|x| (x / largest * 1e4).round() / 1e4).collect(),
            marked: Vec::new(),
        })
    };
    Some([
        sketch(&surfaces[0], &values[0], "the third eigenfunction"),
        sketch(&surfaces[1], &values[1], "its transplantation, an eigenfunction"),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::world::drums::{invertible, transplantations};
    use crate::generate::drum::DRUMS;

    #[test]
    fn a_transplanted_eigenfunction_is_an_eigenfunction_of_the_other_drum() {
        for condition in [Condition::Dirichlet, Condition::Neumann] {
            let t = invertible(&transplantations([&DRUMS[0], &DRUMS[1]], condition)).unwrap();
            let pair = Pair::new(RIGHT, PARTS, condition).unwrap();
            let [r, _] = lifts(&pair, &t).unwrap();
            let operators = [0, 1].map(|k| cotan(&pair.drums[k].surface().unwrap().into(), "barycentric").unwrap());
            let found = spectrum(&operators[0], &pair.kept[0], 3, 0).unwrap();
            let mut u = BTreeMap::new();
            for (&(v, w), entry) in &r {
                let x = found.vector(2)[pair.kept[0].binary_search(&w).unwrap()];
                *u.entry(v).or_insert(0.0) += entry.approximate() * x;
            }
            let u: Vec<f64> = pair.kept[1].iter().map(|v| u.get(v).copied().unwrap_or(0.0)).collect();
            let of = |m: &crate::linalg::Csr| m.submatrix(&pair.kept[1], &pair.kept[1]).mul(&u);
            let (l, m) = (of(operators[1].stiffness()), of(operators[1].mass().unwrap().matrix()));
            let size = u.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            assert!(size > 0.0 && l.iter().zip(&m).all(|(l, m)| (l - found.values[2] * m).abs() < 1e-9 * size));
        }
    }
}
