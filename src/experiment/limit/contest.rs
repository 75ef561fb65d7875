//! Operators of the catalogue on sequences of meshes: what each quantity does under refinement.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::order::{Level, Trend, judge};
use super::place::Boundary;
use super::poisson::{self, Fit};
use super::sequence::{Mesh, Sequence, Way};
use super::spectra::gaps;
use crate::laplacian;
use crate::linalg::Csr;
use crate::linalg::spectrum::SpectrumError;
use crate::operator::Operator;

/// An operator of the catalogue with its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contestant {
    /// The id and the parameters, as on the command line.
    pub name: &'static str,
    /// The id.
    pub id: &'static str,
    /// The parameters.
    pub given: &'static [(&'static str, &'static str)],
    /// Whether the operator knows no lengths, so that solutions are compared up to the best factor.
    pub scaled: bool,
}

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// Eigenvalues.
    Values,
    /// Eigenspaces.
    Spaces,
    /// The solution of Poisson's equation in L².
    PoissonL2,
    /// The solution of Poisson's equation in the energy norm.
    PoissonEnergy,
}

impl Quantity {
    /// The name used in texts.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Values => "eigenvalues",
            Quantity::Spaces => "eigenspaces",
            Quantity::PoissonL2 => "Poisson in L²",
            Quantity::PoissonEnergy => "Poisson in energy",
        }
    }

    /// The order that the theory of linear elements promises on meshes whose angles stay away from 0 and π, for a mass that
    /// integrates linear functions exactly and data as smooth as here \[strang-fix1973\], \[dziuk1988\].
    pub fn promised(self) -> f64 {
        if self == Quantity::PoissonEnergy { 1.0 } else { 2.0 }
    }
}

/// Every quantity, in the order of a [`Row`].
pub const QUANTITIES: [Quantity; 4] =
    [Quantity::Values, Quantity::Spaces, Quantity::PoissonL2, Quantity::PoissonEnergy];

/// The errors of one operator on one sequence.
pub struct Row {
    /// The operator.
    pub contestant: Contestant,
    /// The sequence.
    pub sequence: Sequence,
    /// The boundary condition.
    pub boundary: Boundary,
    /// The errors by quantity, `None` where the operator has none: eigenvalues of a pencil that is not symmetric, or whose mass is not
    /// positive definite.
    pub levels: [Option<Vec<Level>>; 4],
    /// Whether every spectrum was certified complete with rounding below a hundredth of its error; `None` without a spectrum.
    pub certified: Option<bool>,
    /// Why something is missing.
    pub notes: Vec<String>,
}

impl Row {
    /// What the errors of a quantity say, `None` where there are none.
    pub fn trend(&self, quantity: Quantity) -> Option<Trend> {
        self.levels[quantity as usize].as_deref().map(judge)
    }

    /// The row in words.
    pub fn name(&self) -> String {
        format!("{} on {}, {}", self.contestant.name, self.sequence.name(), self.boundary.name())
    }
}

/// Which meshes are made.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// The coarsest level.
    pub first: usize,
    /// The finest level of a structured sequence.
    pub last: usize,
    /// The finest level of a random one.
    pub last_random: usize,
    /// Draws of a random mesh at each level.
    pub draws: usize,
    /// The seed of the first.
    pub seed: u64,
}

impl Plan {
    /// The meshes of a sequence, level by level.
    ///
    /// # Errors
    /// What a generator refuses, in words.
    pub fn meshes(&self, sequence: Sequence) -> Result<Vec<Mesh>, String> {
        let draws = sequence.draws(self.draws);
        let last = if sequence.way == Way::Structured { self.last } else { self.last_random };
        let places: Vec<(usize, usize)> =
            (self.first..=last).flat_map(|level| (0..draws).map(move |draw| (level, draw))).collect();
        places.par_iter().map(|&(level, draw)| sequence.mesh(level, self.seed + draw as u64)).collect()
    }
}

/// Every operator of a list on one sequence with each boundary condition, level by level; the meshes are made once.
///
/// # Errors
/// What a generator or a construction refuses, in words.
pub fn rows(
    contestants: &[Contestant],
    sequence: Sequence,
    boundaries: &[Boundary],
    plan: Plan,
) -> Result<Vec<Row>, String> {
    let draws = sequence.draws(plan.draws);
    let meshes = plan.meshes(sequence)?;
    let cells: Vec<(Contestant, Boundary)> =
        boundaries.iter().flat_map(|b| contestants.iter().map(move |c| (*c, *b))).collect();
    let jobs: Vec<(usize, usize)> = (0..cells.len()).flat_map(|c| (0..meshes.len()).map(move |m| (c, m))).collect();
    let measure = |&(c, m): &(usize, usize)| Measurement::of(cells[c].0, &meshes[m], cells[c].1);
    let measured: Vec<Measurement> = jobs.par_iter().map(measure).collect::<Result<_, String>>()?;
    let row = |(c, &(contestant, boundary)): (usize, &(Contestant, Boundary))| {
        let mine = &measured[c * meshes.len()..(c + 1) * meshes.len()];
        let levels = QUANTITIES.map(|q| levels(mine, &meshes, draws, q));
        let certified = mine.iter().map(|m| m.certified).collect::<Option<Vec<bool>>>().map(|c| c.iter().all(|c| *c));
        let mut notes: Vec<String> = mine.iter().filter_map(|m| m.note.clone()).collect();
        notes.truncate(1);
        Row { contestant, sequence, boundary, levels, certified, notes }
    };
    Ok(cells.iter().enumerate().map(row).collect())
}

/// The errors of a quantity by level, if every mesh has it.
fn levels(measured: &[Measurement], meshes: &[Mesh], draws: usize, quantity: Quantity) -> Option<Vec<Level>> {
    let level = |(measured, meshes): (&[Measurement], &[Mesh])| {
        let errors = measured.iter().map(|m| m.errors[quantity as usize]).collect::<Option<Vec<f64>>>()?;
        Some(Level { h: meshes.iter().map(|m| m.h).sum::<f64>() / meshes.len() as f64, errors })
    };
    measured.chunks(draws).zip(meshes.chunks(draws)).map(level).collect()
}

/// The errors of one operator on one mesh.
struct Measurement {
    errors: [Option<f64>; 4],
    certified: Option<bool>,
    note: Option<String>,
}

impl Measurement {
    fn of(contestant: Contestant, mesh: &Mesh, boundary: Boundary) -> Result<Self, String> {
        let operator = build(contestant, mesh)?;
        let mass = operator.mass().ok_or_else(|| format!("{} has no mass", contestant.name))?.matrix().clone();
        let mut found = Measurement { errors: [None; 4], certified: None, note: None };
        let symmetric = operator.stiffness().entries().all(|(i, j, v)| *v == operator.stiffness().at(j, i));
        if symmetric {
            let spaces = mesh.place.eigenspaces(boundary);
            match gaps(&operator, &mass, mesh, boundary, &spaces, contestant.scaled) {
                Ok(gaps) => {
                    found.errors[..2].copy_from_slice(&[Some(gaps.values), Some(gaps.spaces)]);
                    found.certified = Some(gaps.certified && 100.0 * gaps.rounding <= gaps.values);
                }
                Err(error @ SpectrumError::Mass { .. }) => found.note = Some(error.to_string()),
                Err(error) => return Err(format!("{}: {error}", contestant.name)),
            }
        } else if boundary == Boundary::Natural {
            // Without symmetry the right-hand sides for which a solution exists are not those of mean zero.
            found.note = Some("not symmetric: no natural problem".into());
            return Ok(found);
        } else {
            found.note = Some("not symmetric: no eigenvalues compared".into());
        }
        let [l2, energy] = solved(contestant, &operator, &mass, mesh, boundary)?;
        found.errors[2..].copy_from_slice(&[Some(l2), Some(energy)]);
        Ok(found)
    }
}

fn solved(
    contestant: Contestant,
    operator: &Operator,
    mass: &Csr,
    mesh: &Mesh,
    boundary: Boundary,
) -> Result<[f64; 2], String> {
    let u = mesh.place.solution(boundary);
    let values = poisson::solve(operator, mass, mesh, boundary, &u).map_err(|e| e.to_string())?;
    let fit = match boundary {
        Boundary::Natural => Fit::Constant,
        Boundary::Dirichlet if contestant.scaled => Fit::Factor,
        Boundary::Dirichlet => Fit::None,
    };
    let errors = poisson::errors(mesh, &values, &u, fit).ok_or("a face is not a triangle")?;
    Ok([errors.l2, errors.energy])
}

/// The operator on a mesh.
///
/// # Errors
/// A refusal, in words.
pub fn build(contestant: Contestant, mesh: &Mesh) -> Result<Operator, String> {
    let entry = laplacian::find(contestant.id).ok_or_else(|| format!("there is no '{}'", contestant.id))?;
    let given: BTreeMap<String, String> =
        contestant.given.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect();
    entry.build(&mesh.domain, &given).map_err(|e| e.to_string())
}
