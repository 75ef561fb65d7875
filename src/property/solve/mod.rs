//! What checks solve: Dirichlet problems, chains of positive weights, directions of negative energy, vectors of the kernel.

pub(crate) mod chains;
pub(crate) mod direction;
pub(crate) mod dirichlet;
pub(crate) mod null_vector;
pub(crate) mod problem;
