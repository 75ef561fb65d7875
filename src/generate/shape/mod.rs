//! What several families of domains are made from. No generator lives here.

pub mod circle;
pub mod displace;
pub mod input;
pub mod place;
pub mod refine;
pub mod scatter;
pub mod sheet;
pub mod verge;
