//! Small worlds, enumerated whole: every graph with few vertices, every triangulation of few lattice points.

pub mod certified;
pub mod excerpt;
pub mod graphs;
pub mod harmonic;
pub mod stars;
pub mod lifting;
pub mod planar;
pub mod triangulations;
pub mod twisted;
