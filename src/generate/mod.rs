//! Generators of domains: one family a file, every one seeded, with the facts it guarantees.
//!
//! To add one: write the file and name it below, in the `catalogue`.

mod shape;
#[cfg(test)]
mod testing;

catalogue! {
    /// Every generator.
    Generator:
    as_graph,
    complete,
    convex_polygon,
    cycle,
    delaunay,
    disk,
    pub drum,
    dumbbell,
    fan,
    flat_torus,
    flip,
    genus,
    gnp,
    grid,
    hypercube,
    icosphere,
    lantern,
    pub listed,
    path,
    perturb,
    perturbed_grid,
    planar_graph,
    polyhedron,
    random_delaunay,
    random_delaunay_disk,
    random_weights,
    renumber,
    rotate,
    scale,
    schonhardt,
    slivers,
    square,
    star,
    subdivide,
    tet_grid,
    torus,
    translate,
    wheel,
    worst_angle,
}

use std::collections::BTreeMap;

use crate::domain::{Domain, DomainError};
use crate::parameter::{Parameter, Settings, SettingsError};
pub use crate::stream::Stream;

/// A catalogue entry: makes a domain from nothing, or changes one.
pub struct Generator {
    /// The id, in kebab case; the file has the same name in snake case.
    pub id: &'static str,
    /// What it makes, in a sentence.
    pub name: &'static str,
    /// The facts that hold for every parameter and seed, in words; a test holds each against computed facts.
    pub guarantees: &'static [&'static str],
    /// Keys of `references.bib`.
    pub sources: &'static [&'static str],
    /// Its parameters; the seed is not one of them.
    pub parameters: &'static [Parameter],
    /// How it is made.
    pub make: Make,
}

/// A source makes a domain; a modifier changes one.
pub enum Make {
    /// From parameters and a stream of random numbers.
    Source(fn(&Settings, &mut Stream) -> Result<Domain, GenerateError>),
    /// From a domain, parameters and a stream of random numbers.
    Modifier(fn(&Domain, &Settings, &mut Stream) -> Result<Domain, GenerateError>),
}

/// Why nothing was generated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GenerateError {
    /// Parameters were refused.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// The generated data make no domain.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// The generator cannot do what the parameters ask.
    #[error("'{generator}' cannot do this: {why}")]
    Impossible {
        /// The generator.
        generator: &'static str,
        /// Why, and what to change.
        why: String,
    },
    /// A modifier without a domain to modify, or a source given one.
    #[error("'{generator}' {problem}")]
    Position {
        /// The generator.
        generator: &'static str,
        /// What is wrong with its place in the recipe.
        problem: &'static str,
    },
}

impl Generator {
    /// Makes a domain. `input` is the domain to change, for a modifier. The stream depends on the seed and on the id, so that
    /// two generators with the same seed draw different numbers.
    ///
    /// # Errors
    /// Parameters out of range, or what the generator refuses.
    pub fn run(
        &self,
        input: Option<&Domain>,
        given: &BTreeMap<String, String>,
        seed: u64,
    ) -> Result<Domain, GenerateError> {
        let settings = Settings::new(self.id, self.parameters, given)?;
        let mut stream = Stream::new(seed, self.id);
        match (&self.make, input) {
            (Make::Source(make), None) => make(&settings, &mut stream),
            (Make::Modifier(change), Some(domain)) => change(domain, &settings, &mut stream),
            (Make::Source(_), Some(_)) => Err(GenerateError::Position {
                generator: self.id,
                problem: "makes a domain from nothing; it must come first in a recipe",
            }),
            (Make::Modifier(_), None) => Err(GenerateError::Position {
                generator: self.id,
                problem: "changes a domain; give it one, as in 'icosphere:levels=2 | THIS'",
            }),
        }
    }
}
