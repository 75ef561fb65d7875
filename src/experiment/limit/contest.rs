//! Operators of the catalogue on sequences of meshes: what each quantity does under refinement.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::mesh::Mesh;
use super::modes::Sampled;
use super::order::{Level, Trend, judge};
use super::place::{Boundary, Place};
use super::poisson::{self, Fit};
use super::sequence::Sequence;
use super::spectra::gaps;
use crate::domain::DomainKind;
use crate::laplacian::{self, CONVERGENCE, Laplacian, Promise, Promised, When};
use crate::linalg::Csr;
use crate::linalg::spectrum::SpectrumError;
use crate::operator::Operator;

/// An operator of the catalogue with its parameters.
#[derive(Clone)]
pub struct Contestant {
    /// The entry.
    pub entry: &'static Laplacian,
    /// The parameters that are not at their default.
    pub given: BTreeMap<String, String>,
    /// Whether solutions are compared up to the best factor: an operator that knows no lengths can hope for no more.
    pub scaled: bool,
}

impl Contestant {
    /// The entry with its defaults; `None` without one of this id.
    pub fn of(id: &str) -> Option<Self> {
        Some(Contestant { entry: laplacian::find(id)?, given: BTreeMap::new(), scaled: false })
    }

    /// With a parameter set.
    pub fn with(mut self, name: &str, value: &str) -> Self {
        let default = self.entry.parameters.iter().any(|p| p.name == name && p.default == value);
        if default {
            self.given.remove(name);
        } else {
            self.given.insert(name.into(), value.into());
        }
        self
    }

    /// The id and the parameters, as on the command line.
    pub fn name(&self) -> String {
        let given: Vec<String> = self.given.iter().map(|(k, v)| format!("{k}={v}")).collect();
        if given.is_empty() { self.entry.id.into() } else { format!("{}:{}", self.entry.id, given.join(",")) }
    }

    /// The name of the mass; empty where there is no choice.
    pub fn mass(&self) -> &str {
        let default = || self.entry.parameters.iter().find(|p| p.name == "mass").map_or("", |p| p.default);
        self.given.get("mass").map_or_else(default, String::as_str)
    }

    /// Whether the operator is defined on the meshes of a place.
    pub fn plays(&self, place: Place) -> bool {
        let kind = if place == Place::Cube { DomainKind::Volume } else { DomainKind::Surface };
        self.entry.accepts.contains(&kind)
    }

    /// The operator on a mesh.
    ///
    /// # Errors
    /// A refusal, in words.
    pub fn build(&self, mesh: &Mesh) -> Result<Operator, String> {
        self.entry.build(&mesh.domain, &self.given).map_err(|e| e.to_string())
    }
}

/// Every operator of the catalogue of which it promises that it converges, with every value of the parameters under which it does.
pub fn promised() -> Vec<Contestant> {
    contestants(Promised::Holds)
}

/// Every operator of the catalogue of which it says that it does not always converge, compared up to the best factor.
pub fn denied() -> Vec<Contestant> {
    contestants(Promised::FailsSomewhere).into_iter().map(|c| Contestant { scaled: true, ..c }).collect()
}

fn contestants(outcome: Promised) -> Vec<Contestant> {
    let of = |entry: &'static Laplacian| {
        let promises = entry.promises.iter().filter(move |p| p.property == CONVERGENCE && p.outcome == outcome);
        promises.flat_map(move |promise| settings(entry, promise))
    };
    laplacian::ALL.iter().flat_map(|entry| of(entry)).collect()
}

/// The entry with every combination of the words, and of the ends of the intervals, under which something is promised.
fn settings(entry: &'static Laplacian, promise: &Promise) -> Vec<Contestant> {
    let mut found = vec![Contestant { entry, given: BTreeMap::new(), scaled: false }];
    for when in promise.when {
        let (name, values) = match *when {
            When::Is(name, words) => (name, words.iter().map(|w| w.to_string()).collect::<Vec<_>>()),
            When::Between(name, low, high) if low == high => (name, vec![low.to_string()]),
            When::Between(name, low, high) => (name, vec![low.to_string(), high.to_string()]),
        };
        found = found.into_iter().flat_map(|c| values.iter().map(move |v| c.clone().with(name, v))).collect();
    }
    found
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
    pub note: Option<String>,
}

impl Row {
    /// What the errors of a quantity say, `None` where there are none.
    pub fn trend(&self, quantity: Quantity) -> Option<Trend> {
        self.levels[quantity as usize].as_deref().map(judge)
    }

    /// The row in words.
    pub fn name(&self) -> String {
        format!("{} on {}, {}", self.contestant.name(), self.sequence.name(), self.boundary.name())
    }
}

/// Which meshes are made.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// The sizes n of surfaces, with the number of meshes where they are drawn.
    pub sizes: &'static [(usize, usize)],
    /// The sizes of volumes.
    pub solid: &'static [(usize, usize)],
    /// The seed.
    pub seed: u64,
}

impl Plan {
    /// The meshes of a sequence, size by size.
    ///
    /// # Errors
    /// What a generator refuses, in words.
    pub fn meshes(&self, sequence: Sequence) -> Result<Vec<Vec<Mesh>>, String> {
        let draws = |count: usize| if sequence.is_random() { count } else { 1 };
        let seed = |draw: usize| self.seed.wrapping_mul(1 << 10).wrapping_add(draw as u64);
        let size = |&(n, count): &(usize, usize)| {
            (0..draws(count)).into_par_iter().map(|draw| sequence.mesh(n, seed(draw))).collect()
        };
        let sizes = if sequence.place == Place::Cube { self.solid } else { self.sizes };
        sizes.iter().map(size).collect()
    }
}

/// The errors of each mesh, by size.
pub fn by_size<T>(meshes: &[Vec<Mesh>], found: &[T], error: impl Fn(&T) -> Option<f64>) -> Option<Vec<Level>> {
    let mut rest = found;
    let level = |meshes: &Vec<Mesh>| {
        let (mine, others) = rest.split_at_checked(meshes.len())?;
        rest = others;
        let h = meshes.iter().map(|m| m.h).sum::<f64>() / meshes.len() as f64;
        Some(Level { h, errors: mine.iter().map(&error).collect::<Option<_>>()? })
    };
    meshes.iter().map(level).collect()
}

/// Every operator of a list that is defined there on the meshes of one sequence with each boundary condition; `spectra` says whether spectra
/// are compared, beside solutions.
///
/// # Errors
/// What a construction refuses, in words.
pub fn rows(
    contestants: &[Contestant],
    sequence: Sequence,
    meshes: &[Vec<Mesh>],
    boundaries: &[Boundary],
    spectra: bool,
) -> Result<Vec<Row>, String> {
    let all: Vec<&Mesh> = meshes.iter().flatten().collect();
    let spaces: Vec<Vec<Vec<Sampled>>> = boundaries
        .iter()
        .map(|&boundary| {
            let spaces = if spectra { sequence.place.eigenspaces(boundary) } else { Vec::new() };
            all.par_iter().map(|mesh| spaces.iter().map(|space| space.at(mesh)).collect()).collect()
        })
        .collect();
    let players: Vec<&Contestant> = contestants.iter().filter(|c| c.plays(sequence.place)).collect();
    let jobs: Vec<(usize, usize)> = (0..boundaries.len()).flat_map(|b| (0..all.len()).map(move |m| (b, m))).collect();
    let measure = |&(b, m): &(usize, usize)| measure(&players, all[m], boundaries[b], &spaces[b][m]);
    let measured: Vec<Vec<Measurement>> = jobs.par_iter().map(measure).collect::<Result<_, String>>()?;
    let row = |b: usize, k: usize| {
        let mine: Vec<&Measurement> =
            measured[b * all.len()..(b + 1) * all.len()].iter().map(|list| &list[k]).collect();
        let certified = mine.iter().map(|m| m.certified).collect::<Option<Vec<bool>>>().map(|c| c.iter().all(|c| *c));
        Row {
            contestant: players[k].clone(),
            sequence,
            boundary: boundaries[b],
            levels: QUANTITIES.map(|q| by_size(meshes, &mine, |m| m.errors[q as usize])),
            certified,
            note: mine.iter().find_map(|m| m.note.clone()),
        }
    };
    Ok((0..boundaries.len()).flat_map(|b| (0..players.len()).map(move |k| (b, k))).map(|(b, k)| row(b, k)).collect())
}

/// The errors of each operator on one mesh. Operators that have the same matrices there, as `cotan` and `intrinsic-delaunay` where all edges are Delaunay,
/// are measured once.
fn measure(
    players: &[&Contestant],
    mesh: &Mesh,
    boundary: Boundary,
    spaces: &[Sampled],
) -> Result<Vec<Measurement>, String> {
    let mut seen: Vec<Operator> = Vec::new();
    let mut found: Vec<Measurement> = Vec::new();
    for contestant in players {
        let operator = contestant.build(mesh)?;
        let mass = |o: &Operator| o.mass().map(|m| m.matrix().clone());
        let same = |(k, o): &(usize, &Operator)| {
            players[*k].scaled == contestant.scaled
                && o.stiffness() == operator.stiffness()
                && mass(o) == mass(&operator)
        };
        let measurement = match seen.iter().enumerate().find(same) {
            Some((k, _)) => found[k].clone(),
            None => Measurement::of(contestant, &operator, mesh, boundary, spaces)?,
        };
        found.push(measurement);
        seen.push(operator);
    }
    Ok(found)
}

/// The errors of one operator on one mesh.
#[derive(Clone)]
struct Measurement {
    errors: [Option<f64>; 4],
    certified: Option<bool>,
    note: Option<String>,
}

impl Measurement {
    fn of(
        contestant: &Contestant,
        operator: &Operator,
        mesh: &Mesh,
        boundary: Boundary,
        spaces: &[Sampled],
    ) -> Result<Self, String> {
        let mass = operator.mass().ok_or_else(|| format!("{} has no mass", contestant.name()))?.matrix();
        let mut found = Measurement { errors: [None; 4], certified: None, note: None };
        let symmetric = operator.stiffness().entries().all(|(i, j, v)| *v == operator.stiffness().at(j, i));
        if symmetric && !spaces.is_empty() {
            match gaps(operator, mass, mesh, boundary, spaces, contestant.scaled) {
                Ok(gaps) => {
                    found.errors[..2].copy_from_slice(&[Some(gaps.values), Some(gaps.spaces)]);
                    found.certified = Some(gaps.certified && 100.0 * gaps.rounding <= gaps.values);
                }
                Err(error @ SpectrumError::Mass { .. }) => found.note = Some(error.to_string()),
                Err(error) => return Err(format!("{}: {error}", contestant.name())),
            }
        } else if !symmetric && boundary == Boundary::Natural {
            // Without symmetry the right-hand sides for which a solution exists are not those of mean zero.
            found.note = Some("not symmetric: no natural problem".into());
            return Ok(found);
        } else if !symmetric {
            found.note = Some("not symmetric: no eigenvalues compared".into());
        }
        let [l2, energy] = solved(contestant, operator, mass, mesh, boundary)?;
        found.errors[2..].copy_from_slice(&[Some(l2), Some(energy)]);
        Ok(found)
    }
}

fn solved(
    contestant: &Contestant,
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
    let errors = poisson::errors(mesh, &values, &u, fit);
    Ok([errors.l2, errors.energy])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lists_are_those_of_the_catalogue_with_every_mass_that_is_named() {
        let names = |list: Vec<Contestant>| list.iter().map(Contestant::name).collect::<Vec<_>>();
        let promised = names(promised());
        for name in ["cotan", "cotan:mass=consistent", "intrinsic-delaunay:mass=mixed", "tet-cotan:mass=consistent"] {
            assert!(promised.iter().any(|p| p == name), "{name}: {promised:?}");
        }
        assert!(promised.iter().all(|p| !p.contains("unit")));
        let denied = names(denied());
        assert!(["graph", "mean-value"].iter().all(|id| denied.iter().any(|d| d == id)), "{denied:?}");
        for entry in laplacian::ALL.iter().filter(|e| e.promises.iter().any(|p| p.property == CONVERGENCE)) {
            let listed = |list: &[String]| list.iter().any(|n| n.split(':').next() == Some(entry.id));
            assert!(listed(&promised) || listed(&denied), "{}", entry.id);
        }
    }
}
