//! What generators refuse, and how a modifier hands its surface on.

use crate::domain::flip::FlipError;
use crate::domain::{Domain, DomainError, Surface};
use crate::generate::GenerateError;

/// The most vertices (or edges of a graph) that a generator makes.
pub const LARGEST: usize = 2_000_000;

/// Refuses to make more than [`LARGEST`] elements.
pub fn admit(generator: &'static str, what: &str, count: usize) -> Result<(), GenerateError> {
    let why = || format!("{count} {what} are more than {LARGEST}; choose smaller parameters");
    if count > LARGEST { Err(impossible(generator, why())) } else { Ok(()) }
}

/// The refusal of a generator.
pub fn impossible(generator: &'static str, why: impl Into<String>) -> GenerateError {
    GenerateError::Impossible { generator, why: why.into() }
}

/// The refusal of a generator that flips edges.
pub fn refused_flip(generator: &'static str) -> impl Fn(FlipError) -> GenerateError {
    move |error| impossible(generator, error.to_string())
}

/// The surface to change.
pub fn surface<'a>(generator: &'static str, domain: &'a Domain) -> Result<&'a Surface, GenerateError> {
    domain.as_surface().ok_or_else(|| impossible(generator, format!("it changes a surface, not a {}", domain.kind())))
}

/// The triangles of the surface to change.
pub fn triangles(generator: &'static str, surface: &Surface) -> Result<Vec<[usize; 3]>, GenerateError> {
    let corners = |face: usize| format!("face {face} has {} corners", surface.faces()[face].len());
    (0..surface.faces().len())
        .map(|f| {
            surface
                .triangle(f)
                .ok_or_else(|| impossible(generator, format!("{}; triangulate the mesh first", corners(f))))
        })
        .collect()
}

/// A surface with the notices of the one that it was made from.
pub fn inherit(from: &Surface, made: Result<Surface, DomainError>) -> Result<Domain, GenerateError> {
    let made = from.notices().iter().rev().fold(made?, |made, notice| made.with_notice(notice.clone()));
    Ok(made.into())
}
