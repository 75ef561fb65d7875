//! The structural properties, each shown holding and failing on matrices made here by hand, with every witness checked again
//! in rational arithmetic.

mod energy_and_flux;
mod finite_and_local;
mod mass;
mod meshes;
mod rows;
mod signs;
mod trials;
mod unfavourable;
