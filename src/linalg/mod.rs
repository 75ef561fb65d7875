//! The wall around the linear algebra: our own compressed rows over any scalar, and `faer` behind [`factor`],
//! `clarabel` behind [`program`].
//!
//! Nothing outside this module names a type of either.

pub mod backward;
pub mod certified;
pub mod csr;
mod dissection;
pub mod exact;
pub mod factor;
pub mod full;
mod influence;
mod lanczos;
pub mod mirror;
mod panel;
pub(crate) mod parallel;
pub mod pencil;
pub mod polynomial;
pub mod program;
pub mod rational;
pub mod regular;
pub mod simplex;
pub mod spectrum;
mod substitution;

pub use csr::Csr;
pub use exact::Dense;
pub use mirror::Mirror;
pub use pencil::Pencil;
pub use polynomial::Polynomial;
