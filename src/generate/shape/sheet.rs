//! Structured sheets of triangulated quadrilateral cells, open or periodic.

use crate::generate::Stream;
use crate::parameter::{Parameter, Range};

/// Which diagonal cuts each cell.
pub const DIAGONALS: Parameter = Parameter {
    name: "diagonals",
    meaning: "the diagonal of each cell: to the right (south-west to north-east), to the left, alternating like a chessboard (valences 4 and 8 inside), or random",
    default: "right",
    range: Range::Choice(&["right", "left", "alternating", "random"]),
};

/// A sheet of `columns × rows` cells; along a periodic direction the last vertices are the first ones.
#[derive(Clone, Copy, Debug)]
pub struct Sheet {
    /// Cells in the first direction; at least 3 if periodic.
    pub columns: usize,
    /// Cells in the second direction; at least 3 if periodic.
    pub rows: usize,
    /// Which directions are periodic.
    pub periodic: [bool; 2],
}

impl Sheet {
    /// A sheet with four sides.
    pub fn open(columns: usize, rows: usize) -> Self {
        Sheet { columns, rows, periodic: [false, false] }
    }

    /// Vertices along each direction.
    pub fn size(&self) -> [usize; 2] {
        let count = |cells: usize, periodic: bool| cells + usize::from(!periodic);
        [count(self.columns, self.periodic[0]), count(self.rows, self.periodic[1])]
    }

    /// The vertices as `[column, row]`, in the order of their numbers: row by row.
    pub fn vertices(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        let [across, up] = self.size();
        (0..up).flat_map(move |j| (0..across).map(move |i| [i, j]))
    }

    /// The number of the vertex in a column and a row, taken periodically where the sheet is.
    pub fn vertex(&self, column: usize, row: usize) -> usize {
        let [across, up] = self.size();
        (row % up) * across + column % across
    }

    /// Two triangles for each cell, counter-clockwise in (column, row), cell by cell. `right(i, j)` says whether the
    /// diagonal of a cell runs from its corner (i, j) to (i + 1, j + 1).
    pub fn triangles(&self, mut right: impl FnMut(usize, usize) -> bool) -> Vec<[usize; 3]> {
        let mut faces = Vec::with_capacity(2 * self.columns * self.rows);
        for j in 0..self.rows {
            for i in 0..self.columns {
                let [a, b] = [self.vertex(i, j), self.vertex(i + 1, j)];
                let [c, d] = [self.vertex(i + 1, j + 1), self.vertex(i, j + 1)];
                faces.extend(if right(i, j) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
            }
        }
        faces
    }

    /// The triangles for a value of the parameter [`DIAGONALS`].
    pub fn cut(&self, diagonals: &str, stream: &mut Stream) -> Vec<[usize; 3]> {
        match diagonals {
            "left" => self.triangles(|_, _| false),
            "alternating" => self.triangles(|i, j| (i + j) % 2 == 0),
            "random" => self.triangles(|_, _| stream.below(2) == 0),
            _ => self.triangles(|_, _| true),
        }
    }
}
