//! Why a file could not be read: what, where, and what to do about it.

use std::borrow::Cow;
use std::fmt;

use crate::domain::{DomainError, LARGEST_COORDINATE};

/// A place in a file; prints as `spider.obj:12:7`, as `cut.stl, byte 84`, or as the file alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file, as the caller named it.
    pub file: String,
    /// Where in the file.
    pub position: Position,
}

/// Where in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// Nowhere in particular: the file as a whole.
    File,
    /// In a text, counted from 1; columns are characters.
    Text {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
    },
    /// In binary data: the offset from the start of the (decompressed) file.
    Byte(usize),
}

impl Place {
    /// The file as a whole.
    pub fn file(name: &str) -> Self {
        Place { file: name.to_string(), position: Position::File }
    }

    /// An offset into binary data.
    pub fn byte(name: &str, offset: usize) -> Self {
        Place { file: name.to_string(), position: Position::Byte(offset) }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.position {
            Position::File => write!(f, "{}", self.file),
            Position::Text { line, column } => write!(f, "{}:{line}:{column}", self.file),
            Position::Byte(offset) => write!(f, "{}, byte {offset}", self.file),
        }
    }
}

/// Why a file could not be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReadError {
    /// The operating system refused.
    #[error("{file}: {why}; check the path and its permissions")]
    Open {
        /// The file.
        file: String,
        /// What the operating system said.
        why: String,
    },
    /// No reader for a file with this name.
    #[error("{file}: no reader for {extension}; {known}{advice}")]
    UnknownExtension {
        /// The file.
        file: String,
        /// Its extension in quotes, or "a name without extension".
        extension: String,
        /// Which extensions are known, in words.
        known: String,
        /// What to do with a file of this extension, where that is known; begins with "; ".
        advice: &'static str,
    },
    /// The file is longer than any reader would take.
    #[error("{file}: longer than {limit} bytes when decompressed; no mesh or matrix of that size can be tried")]
    TooLong {
        /// The file.
        file: String,
        /// The limit in bytes.
        limit: u64,
    },
    /// A gzip file whose content is out of proportion to its length; it was not decompressed to the end.
    #[error(
        "{file}: {compressed} bytes of gzip hold more than {limit}, out of all proportion for text of numbers; if it is a mesh or matrix all the same, decompress it with gzip -d first"
    )]
    Bomb {
        /// The file.
        file: String,
        /// Its length in bytes.
        compressed: usize,
        /// How many bytes were decompressed before it was given up.
        limit: u64,
    },
    /// A gzip file that cannot be decompressed.
    #[error(
        "{file}: not a whole gzip file ({why}); copy it again, or remove .gz from its name if it is not compressed"
    )]
    Compressed {
        /// The file.
        file: String,
        /// What the decompressor said.
        why: String,
    },
    /// Something else was expected here.
    #[error("{place}: expected {expected}, found {found}; {advice}")]
    Expected {
        /// Where.
        place: Place,
        /// What was expected.
        expected: Cow<'static, str>,
        /// What stands there, quoted.
        found: String,
        /// What to do.
        advice: Cow<'static, str>,
    },
    /// A coordinate that no domain admits.
    #[error("{place}: coordinate {axis} is {value}; every coordinate must be a finite number between -1e150 and 1e150")]
    Coordinate {
        /// Where.
        place: Place,
        /// x, y or z.
        axis: char,
        /// The value as text.
        value: String,
    },
    /// A component of a normal that no domain admits.
    #[error(
        "{place}: component {axis} of a normal is {value}; every component must be a finite number between -1e150 and 1e150"
    )]
    Normal {
        /// Where.
        place: Place,
        /// x, y or z.
        axis: char,
        /// The value as text.
        value: String,
    },
    /// A face with more corners than there are vertices; nothing was allocated for them.
    #[error(
        "{place}: a face with {corners} corners, but there are {vertices} vertices and a face names each once at most; correct the number of corners"
    )]
    TooManyCorners {
        /// Where.
        place: Place,
        /// How many corners it has.
        corners: u64,
        /// How many vertices there are.
        vertices: usize,
    },
    /// Fewer rows than promised.
    #[error(
        "{place}: {promised} {what} promised, but the file ends after {found}; it is cut short or its count is wrong"
    )]
    TooFew {
        /// Where the data end.
        place: Place,
        /// What was counted.
        what: Cow<'static, str>,
        /// The count in the header.
        promised: usize,
        /// How many came.
        found: usize,
    },
    /// More data than promised.
    #[error("{place}: {promised} {what} promised, but more follows: {found}; correct the count or remove what follows")]
    TooMany {
        /// Where the surplus begins.
        place: Place,
        /// What was counted.
        what: Cow<'static, str>,
        /// The count in the header.
        promised: usize,
        /// What follows, quoted.
        found: String,
    },
    /// A count that the rest of the file cannot hold; nothing was allocated for it.
    #[error(
        "{place}: {promised} {what} promised, but the {bytes} bytes that follow hold {most} at most; the file is cut short or the count is wrong"
    )]
    Oversized {
        /// The place of the count.
        place: Place,
        /// What was counted.
        what: Cow<'static, str>,
        /// The count in the header.
        promised: usize,
        /// How many bytes follow.
        bytes: usize,
        /// How many items these can hold.
        most: usize,
    },
    /// A matrix with more rows or columns than its file could fill; nothing was allocated for it.
    #[error(
        "{place}: {promised} {what} promised, but a file of this length is read with {most} at most, the others would be empty; correct the size line"
    )]
    MostlyEmpty {
        /// The place of the count.
        place: Place,
        /// "rows" or "columns".
        what: &'static str,
        /// The number promised.
        promised: usize,
        /// The largest number admitted.
        most: usize,
    },
    /// An index 0 where counting starts at 1.
    #[error("{place}: index 0, but this format counts from 1; is the file 0-based? Then add 1 to every index")]
    ZeroIndex {
        /// Where.
        place: Place,
    },
    /// A vertex index that names no vertex.
    #[error("{place}: index {index} names no vertex: {}; {advice}", admitted(*.vertices, *.base))]
    IndexOutOfRange {
        /// Where.
        place: Place,
        /// The index as written.
        index: i64,
        /// How many vertices there are.
        vertices: usize,
        /// The index of the first vertex in this format.
        base: usize,
        /// What to do.
        advice: &'static str,
    },
    /// A face with fewer than three corners.
    #[error("{place}: a face with {corners} corners; a face needs at least 3: {advice}")]
    TooFewCorners {
        /// Where.
        place: Place,
        /// How many corners it has.
        corners: usize,
        /// What to do.
        advice: &'static str,
    },
    /// An element that names a vertex twice.
    #[error("{place}: vertex {vertex} stands twice in this {element}; remove the {element} or separate its corners")]
    RepeatedVertex {
        /// The second occurrence.
        place: Place,
        /// "face" or "tetrahedron".
        element: &'static str,
        /// The vertex, numbered as in the file.
        vertex: usize,
    },
    /// A part of the format that is not read.
    #[error("{place}: {what} cannot be read; {advice}")]
    Unsupported {
        /// Where.
        place: Place,
        /// What it is.
        what: String,
        /// What to do.
        advice: &'static str,
    },
    /// Something without which there is no domain.
    #[error("{place}: there is no {what}; {advice}")]
    Missing {
        /// Where it was found to be missing.
        place: Place,
        /// What is missing.
        what: String,
        /// What to do.
        advice: Cow<'static, str>,
    },
    /// Something that may stand once only.
    #[error("{place}: {what} a second time; remove one of the two")]
    Twice {
        /// The second occurrence.
        place: Place,
        /// What it is.
        what: String,
    },
    /// A matrix index outside the matrix.
    #[error(
        "{place}: {axis} {index} is outside the matrix of {rows} rows and {columns} columns; correct the entry or the size line"
    )]
    EntryOutOfRange {
        /// Where.
        place: Place,
        /// "row" or "column".
        axis: &'static str,
        /// The index as written.
        index: usize,
        /// The number of rows.
        rows: usize,
        /// The number of columns.
        columns: usize,
    },
    /// A matrix called symmetric that is not square.
    #[error(
        "{place}: a {symmetry} matrix of {rows} rows and {columns} columns; such a matrix is square, correct the size line"
    )]
    NotSquare {
        /// The size line.
        place: Place,
        /// "symmetric" or "skew-symmetric".
        symmetry: &'static str,
        /// The number of rows.
        rows: usize,
        /// The number of columns.
        columns: usize,
    },
    /// A file called symmetric that stores both triangles, so that mirroring would double its entries.
    #[error(
        "{place}: the header says '{symmetry}', so one triangle is stored, but entry ({}, {}) is on the other side of the \
         diagonal than the entry in line {other_line}. Eigen's saveMarket with its symmetric flag writes both triangles under that header: \
         write 'general' in the header instead, the entries stay as they are", .entry.0, .entry.1
    )]
    BothTriangles {
        /// The first entry on the other side.
        place: Place,
        /// "symmetric" or "skew-symmetric".
        symmetry: &'static str,
        /// Its row and column, counted from 1.
        entry: (usize, usize),
        /// The line of an entry on the first side.
        other_line: usize,
    },
    /// A skew-symmetric matrix with something on its diagonal.
    #[error(
        "{place}: a skew-symmetric matrix has a zero diagonal, but row {row} has {value} there; write 'general' in the header"
    )]
    SkewDiagonal {
        /// Where.
        place: Place,
        /// The row, counted from 1.
        row: usize,
        /// The value as text.
        value: String,
    },
    /// Weights of a graph with a non-zero diagonal.
    #[error(
        "{place}: diagonal entry {value} in row {row}, a loop; a graph is read from its matrix of weights, w_ii = 0 — \
         a Laplacian is an operator, not a graph: give it as a stiffness matrix"
    )]
    Loop {
        /// Where.
        place: Place,
        /// The row, counted from 1.
        row: usize,
        /// The value as text.
        value: String,
    },
    /// The weight of an edge that is not finite.
    #[error("{place}: the weight of edge ({row}, {column}) is {value}; every weight must be a finite number")]
    Weight {
        /// Where.
        place: Place,
        /// The row, counted from 1.
        row: usize,
        /// The column, counted from 1.
        column: usize,
        /// The value as text.
        value: String,
    },
    /// The weights of a graph given twice.
    #[error("{place}: edge ({row}, {column}) was given before; add up the weights of parallel edges first")]
    ParallelEdge {
        /// The second occurrence.
        place: Place,
        /// The row, counted from 1.
        row: usize,
        /// The column, counted from 1.
        column: usize,
    },
    /// Weights of a graph that are not symmetric.
    #[error(
        "{place}: edge ({row}, {column}) has weight {value}, but ({column}, {row}) has {mirrored}; a graph is undirected, give both the same weight"
    )]
    Asymmetric {
        /// Where.
        place: Place,
        /// The row, counted from 1.
        row: usize,
        /// The column, counted from 1.
        column: usize,
        /// Its value as text.
        value: String,
        /// The value on the other side, or "none".
        mirrored: String,
    },
    /// The data are in order, but make no domain.
    #[error("{file}: {source}")]
    Domain {
        /// The file.
        file: String,
        /// What the domain refused.
        source: DomainError,
    },
}

impl ReadError {
    /// A coordinate that a domain admits, or the error that says where it does not.
    pub(super) fn coordinate(value: f64, axis: usize, place: impl FnOnce() -> Place) -> Result<f64, Self> {
        // Written so that NaN is not admitted.
        if (-LARGEST_COORDINATE..=LARGEST_COORDINATE).contains(&value) {
            return Ok(value);
        }
        let axis = ['x', 'y', 'z'][axis];
        Err(ReadError::Coordinate { place: place(), axis, value: format!("{value:?}") })
    }

    /// A component of a normal that a domain admits, or the error that says where it does not.
    pub(super) fn normal(value: f64, axis: usize, place: impl FnOnce() -> Place) -> Result<f64, Self> {
        if (-LARGEST_COORDINATE..=LARGEST_COORDINATE).contains(&value) {
            return Ok(value);
        }
        let axis = ['x', 'y', 'z'][axis];
        Err(ReadError::Normal { place: place(), axis, value: format!("{value:?}") })
    }

    /// A vertex index outside of what a format that counts from `base` admits.
    pub(super) fn index(place: Place, index: i64, vertices: usize, base: usize) -> Self {
        if index == 0 {
            return ReadError::ZeroIndex { place };
        }
        let just_behind = base == 0 && usize::try_from(index) == Ok(vertices);
        let advice = if just_behind {
            "is the file 1-based? Then subtract 1 from every index"
        } else {
            "correct the index or add the vertex"
        };
        ReadError::IndexOutOfRange { place, index, vertices, base, advice }
    }
}

/// "the 8 vertices are numbered 1 to 8".
fn admitted(vertices: usize, base: usize) -> String {
    match vertices {
        0 => "there are none".into(),
        n => format!("the {n} vertices are numbered {base} to {}", n - 1 + base),
    }
}
