//! What relations between constructions need: images of a domain, and the comparison of the operators on both.

pub(crate) mod crease;
pub(crate) mod image;
pub(crate) mod relation;
