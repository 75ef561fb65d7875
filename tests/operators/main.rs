//! The Laplacians of the catalogue against closed forms, against each other, and against independent computations.

mod closed_forms;
mod exact;
mod identities;
mod masses;
mod meshes;
mod refusals;
mod rows;
mod tets;

use std::collections::BTreeMap;

use lapjury::domain::Domain;
use lapjury::laplacian::{self, BuildError};
use lapjury::linalg::Csr;
use lapjury::operator::Operator;

/// Half a unit in the last place, relative.
const U: f64 = f64::EPSILON / 2.0;

/// Builds a Laplacian with parameters written `a=b c=d`.
fn try_build(id: &str, parameters: &str, domain: &Domain) -> Result<Operator, BuildError> {
    let pairs = parameters.split_whitespace().map(|pair| pair.split_once('=').unwrap());
    let given: BTreeMap<String, String> = pairs.map(|(k, v)| (k.to_string(), v.to_string())).collect();
    laplacian::find(id).unwrap().build(domain, &given)
}

fn build(id: &str, parameters: &str, domain: &Domain) -> Operator {
    try_build(id, parameters, domain).unwrap_or_else(|refusal| panic!("{id} {parameters}: {refusal}"))
}

/// The largest difference of two matrices relative to the row scale of the first.
fn distance(a: &Csr, b: &Csr) -> f64 {
    let scales = a.row_scales();
    let entries = a.entries().map(|(i, j, _)| (i, j)).chain(b.entries().map(|(i, j, _)| (i, j)));
    entries.map(|(i, j)| (a.at(i, j) - b.at(i, j)).abs() / scales[i].max(f64::MIN_POSITIVE)).fold(0.0, f64::max)
}
