//! Files: meshes, point sets, graphs and matrices, one format a file.
//!
//! | format | extension | read as | written by |
//! | --- | --- | --- | --- |
//! | OFF (COFF, NOFF, STOFF) | `.off` | surface; without faces a point cloud | [`write_off`] |
//! | Wavefront OBJ | `.obj` | surface; without faces a point cloud | [`write_obj`] |
//! | PLY, ascii and binary | `.ply` | surface; without faces a point cloud | |
//! | STL, ascii and binary | `.stl` | surface, corners welded | |
//! | XYZ, with or without normals | `.xyz` | point cloud | [`write_xyz`] |
//! | medit | `.mesh` | volume; without tetrahedra a surface | [`write_medit`] |
//! | Matrix Market | `.mtx` | graph, or by [`read_matrix`] a matrix | [`write_graph`], [`write_matrix_market`] |
//!
//! Every file may be compressed with gzip, whatever its name.
//!
//! # Guarantees
//! No input makes a reader panic, and none makes it work longer than in proportion to its length. Sizes are checked before
//! anything is allocated for them: a file that is refused has cost less than ten times its length (decompressed) and 32 KiB,
//! or up to twenty times where it is long and nothing but faces with indices of a digit, or one polygon of all vertices.
//! Decompressed content is limited to 4 GiB and, beyond 16 MiB, to 200 times the compressed length. Numbers are
//! read strictly, counts are compared with what follows, indices are checked where they stand; an error says which file,
//! line and column (byte, in binary data), what was expected and what to do. Numbers are written with the fewest digits that
//! read back bit for bit.
//! # Limitations
//! A file that is accepted costs what its domain or matrix holds: a surface some 140 bytes a corner while its edges are
//! found, which of a usual mesh is ten times its text and of the densest one, a few digits a face, fifty times; a row of a
//! matrix 24 bytes, empty ones included, of which there may be 65536 more than bytes in the file; an entry 48 bytes, and twice
//! that where it is mirrored.
//! Colours, texture coordinates, materials and groups are skipped; so are the normals of a surface.

mod bytes;
mod error;
mod face;
mod file;
mod graph;
mod matrix_market;
mod matrix_rows;
mod medit;
mod number;
mod obj;
mod off;
mod ply;
mod ply_header;
mod stl;
mod text;
mod write;
mod xyz;

use std::path::Path;

pub use error::{Place, Position, ReadError};
pub use file::{Format, unpack};
pub use graph::write_graph;
pub use matrix_market::{MatrixFile, parse_matrix, write_matrix_market};
pub use medit::write_medit;
pub use obj::write_obj;
pub use off::write_off;
pub use write::{WriteError, native_format, write_domain};
pub use xyz::write_xyz;

use crate::domain::Domain;

/// Reads a domain from a file, in the format that its extension names.
///
/// # Errors
/// A file that cannot be opened, an unknown extension, and whatever [`parse_domain`] refuses.
pub fn read_domain(path: &Path) -> Result<Domain, ReadError> {
    let format = Format::of(path)?;
    parse_domain(format, &path.display().to_string(), &file::read(path)?)
}

/// Reads a domain from the (decompressed) content of a file; `name` is what errors call it. Cost: linear in the length.
///
/// # Errors
/// Content that does not follow the format, or that is no domain.
pub fn parse_domain(format: Format, name: &str, bytes: &[u8]) -> Result<Domain, ReadError> {
    match format {
        Format::Off => off::parse(name, bytes),
        Format::Obj => obj::parse(name, bytes),
        Format::Ply => ply::parse(name, bytes),
        Format::Stl => stl::parse(name, bytes),
        Format::Xyz => xyz::parse(name, bytes),
        Format::Medit => medit::parse(name, bytes),
        Format::MatrixMarket => graph::parse(name, bytes),
    }
}

/// Reads a matrix from a Matrix Market file.
///
/// # Errors
/// A file that cannot be opened, another extension than `.mtx`, and whatever [`parse_matrix`] refuses.
pub fn read_matrix(path: &Path) -> Result<MatrixFile, ReadError> {
    file::check_matrix_extension(path)?;
    parse_matrix(&path.display().to_string(), &file::read(path)?)
}
