//! Moving every point of a domain by one map.

use super::input::{impossible, inherit};
use crate::domain::{Domain, PointCloud, Surface, Volume};
use crate::generate::GenerateError;

/// The domain with every position mapped, and the normals of a point cloud by a map of their own.
///
/// # Errors
/// A graph has no positions; a coordinate that leaves the admitted range.
pub fn positions(
    generator: &'static str,
    domain: &Domain,
    map: impl Fn([f64; 3]) -> [f64; 3],
    map_normal: impl Fn([f64; 3]) -> [f64; 3],
) -> Result<Domain, GenerateError> {
    let moved = |positions: &[[f64; 3]]| positions.iter().map(|p| map(*p)).collect();
    Ok(match domain {
        Domain::Surface(s) => return inherit(s, Surface::new(moved(s.positions()), s.faces().to_vec())),
        Domain::Points(p) => {
            let normals = p.normals().map(|n| n.iter().map(|n| map_normal(*n)).collect());
            PointCloud::new(moved(p.positions()), normals)?.into()
        }
        Domain::Volume(v) => Volume::new(moved(v.positions()), v.tetrahedra().to_vec())?.into(),
        Domain::Graph(_) => return Err(impossible(generator, "it moves points, and a graph has none")),
    })
}
