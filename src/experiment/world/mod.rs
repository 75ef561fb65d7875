//! Small worlds, enumerated whole: every graph with few vertices, every triangulation of few lattice points.

pub mod excerpt;
pub mod graphs;
pub mod harmonic;
pub mod stars;
pub mod triangulations;
