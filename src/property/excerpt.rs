//! Cuttings from matrix and mesh: the excerpts that evidence carries.

use super::Trial;
use super::evidence::{Excerpt, LARGEST_EXCERPT, Row};
use crate::domain::Domain;
use crate::linalg::Csr;

/// Whole rows of a matrix, copied bit for bit, in the order given.
pub(crate) fn copy_rows(matrix: &Csr, which: impl IntoIterator<Item = usize>) -> Vec<Row> {
    let copy = |row: usize| Row { row, entries: matrix.row(row).map(|(j, v)| (j, *v)).collect() };
    which.into_iter().map(copy).collect()
}

/// Rows of the stiffness matrix.
pub(crate) fn of_rows(trial: &Trial, which: impl IntoIterator<Item = usize>) -> Excerpt {
    Excerpt { rows: copy_rows(trial.operator.stiffness(), which), ..Excerpt::default() }
}

/// Rows of the stiffness matrix of which a statement about all rows speaks; nothing above [`LARGEST_EXCERPT`] entries.
pub(crate) fn of_all_rows(trial: &Trial, which: impl IntoIterator<Item = usize>) -> Excerpt {
    if is_large(trial.operator.stiffness()) { Excerpt::default() } else { of_rows(trial, which) }
}

/// Rows of a mass matrix; nothing if they have more than [`LARGEST_EXCERPT`] entries.
pub(crate) fn of_mass_rows(mass: &Csr, which: &[usize]) -> Excerpt {
    let size: usize = which.iter().map(|&i| mass.row(i).len()).sum();
    if size > LARGEST_EXCERPT {
        return Excerpt::default();
    }
    Excerpt { mass_rows: copy_rows(mass, which.iter().copied()), ..Excerpt::default() }
}

/// All rows of the stiffness matrix, all positions and faces; nothing above [`LARGEST_EXCERPT`] entries.
pub(crate) fn of_stiffness_and_mesh(trial: &Trial) -> Excerpt {
    let matrix = trial.operator.stiffness();
    if is_large(matrix) {
        return Excerpt::default();
    }
    Excerpt { rows: copy_rows(matrix, 0..matrix.rows()), ..Excerpt::default() }.with_whole_mesh(trial)
}

/// All rows of a mass matrix, all positions and faces; nothing above [`LARGEST_EXCERPT`] entries.
pub(crate) fn of_mass_and_mesh(trial: &Trial, mass: &Csr) -> Excerpt {
    if is_large(mass) {
        return Excerpt::default();
    }
    Excerpt { mass_rows: copy_rows(mass, 0..mass.rows()), ..Excerpt::default() }.with_whole_mesh(trial)
}

fn is_large(matrix: &Csr) -> bool {
    matrix.stored() > LARGEST_EXCERPT
}

impl Excerpt {
    fn with_whole_mesh(self, trial: &Trial) -> Self {
        let vertices: Vec<usize> = (0..trial.domain.vertex_count()).collect();
        let faces: Vec<usize> = (0..trial.domain.as_surface().map_or(0, |s| s.faces().len())).collect();
        self.with_positions(trial, vertices).with_faces(trial, &faces)
    }

    /// With the positions of vertices, ascending, each once.
    pub(crate) fn with_positions(mut self, trial: &Trial, vertices: impl IntoIterator<Item = usize>) -> Self {
        if let Some(positions) = trial.domain.positions() {
            self.positions.extend(vertices.into_iter().map(|v| (v, positions[v])));
            self.positions.sort_by_key(|&(v, _)| v);
            self.positions.dedup_by_key(|&mut (v, _)| v);
        }
        self
    }

    /// With faces of a surface.
    pub(crate) fn with_faces(mut self, trial: &Trial, which: &[usize]) -> Self {
        if let Some(surface) = trial.domain.as_surface() {
            self.faces.extend(which.iter().map(|&f| (f, surface.faces()[f].to_vec())));
        }
        self
    }

    /// With all faces at a vertex; on a domain without faces with all edges there.
    pub(crate) fn with_star(mut self, trial: &Trial, vertex: usize) -> Self {
        match trial.domain {
            Domain::Surface(surface) => {
                let faces: Vec<usize> = surface.topology().star(vertex).iter().map(|c| c.face()).collect();
                self.with_faces(trial, &faces)
            }
            other => {
                self.edges.extend(other.edges().iter().filter(|e| e.contains(&vertex)));
                self
            }
        }
    }

    /// With the positions of the corners of the faces that it has.
    pub(crate) fn with_corners(self, trial: &Trial) -> Self {
        let corners: Vec<usize> = self.faces.iter().flat_map(|(_, f)| f.iter().copied()).collect();
        self.with_positions(trial, corners)
    }
}
