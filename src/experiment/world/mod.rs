//! Small worlds, enumerated whole: every graph with few vertices, every triangulation of few lattice points.

pub mod certified;
pub mod complexes;
pub mod cuts;
pub mod descent;
pub mod discs;
pub mod drums;
pub mod excerpt;
pub mod five_points;
pub mod graphs;
pub mod harmonic;
pub mod lifting;
pub mod modes;
pub mod planar;
pub mod stage;
pub mod stars;
pub mod triangulations;
pub mod twisted;
