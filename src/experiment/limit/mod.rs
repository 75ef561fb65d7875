//! What tends to what under refinement: sequences of meshes, smooth problems with known answers, and the order of an error.

pub mod bessel;
pub mod chart;
pub mod contest;
pub mod hodge;
pub mod mesh;
pub mod modes;
pub mod order;
pub mod place;
pub mod poisson;
pub mod residual;
pub mod sequence;
pub mod spectra;
pub mod student;
