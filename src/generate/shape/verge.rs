//! The boundary of a generated graph: the vertices at which a Dirichlet problem prescribes values.

use super::input::impossible;
use crate::domain::{Domain, Graph};
use crate::generate::{GenerateError, Stream};
use crate::parameter::{Parameter, Range, Settings};

/// How many vertices make the boundary.
pub const BOUNDARY: Parameter = Parameter {
    name: "boundary",
    meaning: "number of boundary (Dirichlet) vertices",
    default: "0",
    range: Range::Whole(0, 1_000_000),
};

/// A graph whose boundary are the first vertices of a list, as many as the parameter [`BOUNDARY`] says.
pub fn bounded(
    generator: &'static str,
    (vertices, edges): (usize, &[[usize; 2]]),
    order: &[usize],
    settings: &Settings,
) -> Result<Domain, GenerateError> {
    let count = settings.whole("boundary");
    let Some(boundary) = order.get(..count) else {
        return Err(impossible(generator, format!("{count} boundary vertices of {vertices} vertices; ask for fewer")));
    };
    Ok(Graph::new(vertices, edges)?.with_boundary(boundary)?.into())
}

/// The vertices in random order.
pub fn shuffled(vertices: usize, stream: &mut Stream) -> Vec<usize> {
    let mut order: Vec<usize> = (0..vertices).collect();
    stream.shuffle(&mut order);
    order
}
