//! Point clouds.

use super::{DomainError, check_coordinates};

/// Points in space, with optional normals.
#[derive(Clone, Debug)]
pub struct PointCloud {
    positions: Vec<[f64; 3]>,
    normals: Option<Vec<[f64; 3]>>,
    boundary: Vec<bool>,
}

impl PointCloud {
    /// Validates the coordinates.
    ///
    /// # Errors
    /// A coordinate that is not finite; normals that are not one for each point.
    pub fn new(positions: Vec<[f64; 3]>, normals: Option<Vec<[f64; 3]>>) -> Result<Self, DomainError> {
        check_coordinates(&positions)?;
        if let Some(normals) = &normals {
            if normals.len() != positions.len() {
                return Err(DomainError::WrongLength {
                    what: "normals",
                    found: normals.len(),
                    expected: positions.len(),
                    of: "points",
                });
            }
            check_coordinates(normals)?;
        }
        let boundary = vec![false; positions.len()];
        Ok(PointCloud { positions, normals, boundary })
    }

    /// The coordinates.
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// The normals, if any were given.
    pub fn normals(&self) -> Option<&[[f64; 3]]> {
        self.normals.as_deref()
    }

    /// No point of a cloud is known to be on a boundary.
    pub fn boundary(&self) -> &[bool] {
        &self.boundary
    }
}
