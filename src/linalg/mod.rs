//! The wall around the linear algebra: our own compressed rows over any scalar, and `faer` behind [`factor`].
//!
//! Nothing outside this module names a type of `faer`.

pub mod backward;
pub mod certified;
pub mod csr;
pub mod exact;
pub mod factor;
pub mod full;
mod influence;
pub mod rational;
pub mod regular;

pub use csr::Csr;
pub use exact::Dense;
