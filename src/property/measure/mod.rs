//! What checks measure with: neighbourhoods, the conditioning of the geometry, the thresholds that follow from it, and sums that
//! add no error of their own.

pub(crate) mod compensated;
pub(crate) mod condition;
pub(crate) mod moment;
pub(crate) mod rounding;
pub(crate) mod row;
pub(crate) mod scan;
pub(crate) mod shares;
pub mod stencil;
pub mod tolerance;
pub(crate) mod weights;
