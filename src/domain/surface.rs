//! Triangle and polygon meshes in the plane or in space.

use std::sync::{Arc, OnceLock};

use super::geometry::{self, Vec3};
use super::topology::{self, Orientation, Topology};
use super::{DomainError, Faces, check_coordinates, check_corners};
use crate::scalar::Scalar;

/// A polygon mesh: positions and faces, with their connectivity.
///
/// # Guarantees
/// Coordinates are finite and below [`LARGEST_COORDINATE`](super::LARGEST_COORDINATE) in magnitude, indices are in range, no
/// face names a vertex twice. Neighbouring faces agree in orientation wherever that is possible; faces that had to be
/// turned round for it are told in [`notices`](Surface::notices).
/// # Limitations
/// Non-manifold edges and vertices, degenerate and duplicate faces and isolated vertices are admitted and counted as
/// [`Facts`](super::Facts): what an operator makes of them is the operator's to say.
#[derive(Clone, Debug)]
pub struct Surface {
    positions: Vec<[f64; 3]>,
    faces: Faces,
    topology: Arc<Topology>,
    orientation: Orientation,
    notices: Vec<String>,
    /// Found when first asked for.
    plane: OnceLock<Option<[usize; 2]>>,
}

impl Surface {
    /// Validates positions and faces, orients the faces where possible. Cost: O(n + F).
    ///
    /// # Errors
    /// A coordinate that is not finite, an index out of range, a face with fewer than three corners or a repeated one.
    pub fn new(positions: Vec<[f64; 3]>, faces: Vec<Vec<usize>>) -> Result<Self, DomainError> {
        Surface::from_faces(positions, faces.iter().collect())
    }

    /// The same from faces in one list; see [`Surface::new`].
    ///
    /// # Errors
    /// As [`Surface::new`].
    pub fn from_faces(positions: Vec<[f64; 3]>, mut faces: Faces) -> Result<Self, DomainError> {
        check_coordinates(&positions)?;
        let corners = faces.corners().len();
        if corners > Topology::MOST_CORNERS {
            return Err(DomainError::TooManyCorners { corners });
        }
        for (face, corners) in faces.iter().enumerate() {
            if corners.len() < 3 {
                return Err(DomainError::TooFewCorners { face, corners: corners.len() });
            }
            check_corners("face", face, corners, positions.len())?;
        }
        let mut topology = Topology::new(positions.len(), &faces);
        let orientation = topology::orient(&mut faces, &topology);
        let mut notices = Vec::new();
        if orientation.flipped_faces > 0 {
            topology = Topology::new(positions.len(), &faces);
            notices.push(format!(
                "{} of {} faces were turned round: {} edges were crossed twice in the same direction",
                orientation.flipped_faces,
                faces.len(),
                orientation.ill_oriented_edges
            ));
        }
        if !orientation.orientable {
            notices.push("some component cannot be oriented; its faces are left as they came".into());
        }
        let topology = Arc::new(topology);
        Ok(Surface { positions, faces, topology, orientation, notices, plane: OnceLock::new() })
    }

    /// A triangle mesh; see [`Surface::new`].
    ///
    /// # Errors
    /// As [`Surface::new`].
    pub fn triangles(positions: Vec<[f64; 3]>, faces: &[[usize; 3]]) -> Result<Self, DomainError> {
        Surface::from_faces(positions, Faces::triangles(faces))
    }

    /// A triangle mesh in the plane, z = 0; see [`Surface::new`].
    ///
    /// # Errors
    /// As [`Surface::new`].
    pub fn planar(positions: &[[f64; 2]], faces: &[[usize; 3]]) -> Result<Self, DomainError> {
        Surface::triangles(positions.iter().map(|p| [p[0], p[1], 0.0]).collect(), faces)
    }

    /// The same faces with their vertices elsewhere. Cost: O(n + F); the connectivity is shared.
    ///
    /// # Errors
    /// A coordinate that is not finite or out of range, or a list of another length.
    pub fn with_positions(&self, positions: Vec<[f64; 3]>) -> Result<Self, DomainError> {
        let (found, expected) = (positions.len(), self.positions.len());
        if found != expected {
            return Err(DomainError::WrongLength { what: "positions", found, expected, of: "vertices" });
        }
        check_coordinates(&positions)?;
        Ok(Surface { positions, plane: OnceLock::new(), ..self.clone() })
    }

    /// Adds a notice about where the surface came from (welded vertices, dropped records, …).
    pub fn with_notice(mut self, notice: String) -> Self {
        self.notices.insert(0, notice);
        self
    }

    /// The coordinates; z = 0 for a mesh drawn in the plane.
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// The position of a vertex as a vector.
    pub fn point(&self, vertex: usize) -> Vec3 {
        Vec3::from(self.positions[vertex])
    }

    /// The faces, each as the list of its corners.
    pub fn faces(&self) -> &Faces {
        &self.faces
    }

    /// The connectivity.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// What orienting the faces came to.
    pub fn orientation(&self) -> Orientation {
        self.orientation
    }

    /// What was repaired, in words.
    pub fn notices(&self) -> &[String] {
        &self.notices
    }

    /// Whether every face is a triangle.
    pub fn is_triangulated(&self) -> bool {
        self.faces.are_triangles()
    }

    /// The corners of a triangle. `None` if the face has more than three.
    pub fn triangle(&self, face: usize) -> Option<[usize; 3]> {
        <[usize; 3]>::try_from(&self.faces[face]).ok()
    }

    /// The vertices opposite an edge in the triangles beside it, with their faces. Polygons with more corners have none.
    pub fn opposite(&self, edge: usize) -> Vec<(usize, usize)> {
        let third = |s: &topology::Side| self.triangle(s.face()).map(|t| (s.face(), t[(s.corner() + 2) % 3]));
        self.topology.sides(edge).iter().filter_map(third).collect()
    }

    /// The two axes that span the mesh if it lies in a coordinate plane and no two of its non-degenerate faces have
    /// opposite orientation there (decided exactly); `None` otherwise.
    ///
    /// With these axes the mesh is flat and unfolded, so that coordinates are linear functions in the sense of LIN.
    pub fn plane(&self) -> Option<[usize; 2]> {
        *self.plane.get_or_init(|| self.find_plane())
    }

    fn find_plane(&self) -> Option<[usize; 2]> {
        let constant = |axis: usize| self.positions.windows(2).all(|w| w[0][axis] == w[1][axis]);
        let normal = [2, 0, 1].into_iter().find(|&axis| constant(axis))?;
        let axes = [(normal + 1) % 3, (normal + 2) % 3];
        let at = |v: usize| [self.positions[v][axes[0]], self.positions[v][axes[1]]];
        let (mut positive, mut negative) = (false, false);
        for face in &self.faces {
            for k in 1..face.len() - 1 {
                let turn = geometry::orient2d(at(face[0]), at(face[k]), at(face[k + 1]));
                positive |= turn.is_gt();
                negative |= turn.is_lt();
            }
        }
        let folded = positive && negative;
        (!self.faces.is_empty() && !folded).then_some(axes)
    }

    /// The coordinates in the plane of the mesh, over any scalar; `None` unless the mesh is planar ([`Surface::plane`]).
    pub fn planar_positions<S: Scalar>(&self) -> Option<Vec<[S; 2]>> {
        let [a, b] = self.plane()?;
        self.positions.iter().map(|p| Some([S::exactly(p[a])?, S::exactly(p[b])?])).collect()
    }

    /// The coordinates over any scalar.
    pub fn scalar_positions<S: Scalar>(&self) -> Vec<[S; 3]> {
        // Coordinates are finite (checked by the constructor), so each has its exact counterpart.
        let exact = |x: f64| S::exactly(x).unwrap_or_else(S::zero);
        self.positions.iter().map(|p| p.map(exact)).collect()
    }

    /// The total area; a polygon counts with the length of its vector area.
    pub fn area(&self) -> f64 {
        (0..self.faces.len()).map(|f| self.face_area(f)).sum()
    }

    /// The area of a face: for a polygon the length of its vector area `½ Σ x_k × x_{k+1}`. Edge vectors are scaled before
    /// they are multiplied, so that nothing under- or overflows unless the area itself does.
    pub fn face_area(&self, face: usize) -> f64 {
        let corners = &self.faces[face];
        let origin = self.point(corners[0]);
        if let &[_, b, c] = corners {
            return 0.5 * geometry::doubled_area_in_space(origin, self.point(b), self.point(c));
        }
        let edges: Vec<Vec3> = corners[1..].iter().map(|&v| self.point(v) - origin).collect();
        let scale = edges.iter().map(|e| e.amax()).fold(0.0, f64::max);
        if scale == 0.0 {
            return 0.0;
        }
        let vector = edges.windows(2).fold(Vec3::zeros(), |sum, w| sum + (w[0] / scale).cross(&(w[1] / scale)));
        0.5 * vector.norm() * scale * scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_with_other_positions_keeps_its_faces_and_refuses_what_is_no_coordinate() {
        let s = Surface::planar(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &[[0, 1, 2]]).unwrap();
        let moved = s.with_positions(vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]]).unwrap();
        assert_eq!((moved.faces(), moved.area()), (s.faces(), 2.0));
        assert_eq!(moved.topology().edges(), s.topology().edges());
        assert!(s.with_positions(vec![[0.0; 3]; 2]).is_err());
        assert!(s.with_positions(vec![[f64::NAN; 3]; 3]).is_err());
    }
}
