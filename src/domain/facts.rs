//! Everything that is computed about a domain.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::delaunay::DelaunayCount;
use super::{Domain, DomainKind, Surface, Volume, geometry};

/// Computed facts of a domain. What does not apply to its kind is absent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "FlatFacts")]
pub struct Facts {
    /// Which kind of domain.
    pub kind: DomainKind,
    /// Number of vertices.
    pub vertices: usize,
    /// Number of edges.
    pub edges: usize,
    /// Number of faces (of a volume: tetrahedra).
    pub faces: usize,
    /// Connected components, isolated vertices included.
    pub components: usize,
    /// Vertices without an edge.
    pub isolated_vertices: usize,
    /// Number of boundary vertices.
    pub boundary_vertices: usize,
    /// Facts that only surfaces have.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub surface: Option<SurfaceFacts>,
}

/// [`Facts`] as they are read: a flattened optional struct would swallow its own errors, so the rest is read by hand.
#[derive(Deserialize)]
struct FlatFacts {
    kind: DomainKind,
    vertices: usize,
    edges: usize,
    faces: usize,
    components: usize,
    isolated_vertices: usize,
    boundary_vertices: usize,
    #[serde(flatten)]
    surface: serde_json::Map<String, serde_json::Value>,
}

impl TryFrom<FlatFacts> for Facts {
    type Error = serde_json::Error;

    fn try_from(flat: FlatFacts) -> Result<Self, Self::Error> {
        Ok(Facts {
            kind: flat.kind,
            vertices: flat.vertices,
            edges: flat.edges,
            faces: flat.faces,
            components: flat.components,
            isolated_vertices: flat.isolated_vertices,
            boundary_vertices: flat.boundary_vertices,
            surface: match flat.surface.is_empty() {
                true => None,
                false => Some(serde_json::from_value(serde_json::Value::Object(flat.surface))?),
            },
        })
    }
}

/// Computed facts of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SurfaceFacts {
    /// Faces by number of corners.
    pub corners: BTreeMap<usize, usize>,
    /// Connected components of the boundary.
    pub boundary_loops: usize,
    /// Number of boundary edges.
    pub boundary_edges: usize,
    /// `V − E + F`, isolated vertices not counted.
    pub euler_characteristic: i64,
    /// Sum of the genera of the components; absent unless manifold and orientable.
    pub genus: Option<usize>,
    /// Whether no edge has fewer than two faces.
    pub closed: bool,
    /// Whether no edge has more than two faces and no vertex more than one fan.
    pub manifold: bool,
    /// Whether the faces can be oriented consistently.
    pub orientable: bool,
    /// Edges that two faces crossed in the same direction in the input.
    pub ill_oriented_edges: usize,
    /// Faces turned round to mend that.
    pub flipped_faces: usize,
    /// Edges with more than two faces.
    pub non_manifold_edges: usize,
    /// Vertices with more than one fan of faces.
    pub non_manifold_vertices: usize,
    /// Faces of zero area (triangles: decided exactly).
    pub degenerate_faces: usize,
    /// Faces that have the same corners as an earlier one.
    pub duplicate_faces: usize,
    /// Whether the mesh lies unfolded in a coordinate plane.
    pub planar: bool,
    /// Smallest corner angle, in degrees.
    pub min_angle_deg: f64,
    /// Largest corner angle, in degrees.
    pub max_angle_deg: f64,
    /// Total area.
    pub area: f64,
    /// Whether every interior edge is Delaunay and every angle defined; absent unless all faces are triangles. Exact.
    pub delaunay: Option<bool>,
    /// Interior edges whose opposite angles add up to more than π; absent unless all faces are triangles. Exact.
    pub non_delaunay_edges: Option<usize>,
    /// How many of these may owe it to the rounding of the coordinates to `f64`, see [`delaunay`](super::delaunay): the
    /// numbers that were rounded may have had them cocircular, or Delaunay. Absent unless all faces are triangles.
    pub non_delaunay_within_rounding: Option<usize>,
    /// Interior edges whose opposite angles add up to π; absent unless all faces are triangles. Exact.
    pub cocircular_edges: Option<usize>,
}

impl Facts {
    /// Computes the facts of a domain.
    pub fn of(domain: &Domain) -> Self {
        let components = domain.components();
        let mut touched = vec![false; domain.vertex_count()];
        domain.edges().iter().flatten().for_each(|&v| touched[v] = true);
        Facts {
            kind: domain.kind(),
            vertices: domain.vertex_count(),
            edges: domain.edges().len(),
            faces: match domain {
                Domain::Surface(s) => s.faces().len(),
                Domain::Volume(v) => Volume::tetrahedra(v).len(),
                _ => 0,
            },
            components: components.iter().max().map_or(0, |m| m + 1),
            isolated_vertices: touched.iter().filter(|t| !**t).count(),
            boundary_vertices: domain.boundary().iter().filter(|b| **b).count(),
            surface: domain.as_surface().map(|s| SurfaceFacts::of(s, &components, &touched)),
        }
    }

    /// Whether there is a single component.
    pub fn connected(&self) -> bool {
        self.components == 1
    }
}

impl SurfaceFacts {
    fn of(surface: &Surface, components: &[usize], touched: &[bool]) -> Self {
        let topology = surface.topology();
        let edges = topology.edges().len();
        let mut corners = BTreeMap::new();
        surface.faces().iter().for_each(|f| *corners.entry(f.len()).or_insert(0) += 1);
        let used = touched.iter().filter(|t| **t).count();
        let euler = used as i64 - edges as i64 + surface.faces().len() as i64;
        let boundary_edges = (0..edges).filter(|&e| topology.is_boundary_edge(e)).count();
        let boundary_loops = topology.boundary_loops();
        let non_manifold_edges = topology.non_manifold_edges().len();
        let non_manifold_vertices = topology.non_manifold_vertices(surface.faces()).len();
        let manifold = non_manifold_edges + non_manifold_vertices == 0;
        let mut parts: Vec<usize> = (0..touched.len()).filter(|&v| touched[v]).map(|v| components[v]).collect();
        parts.sort_unstable();
        parts.dedup();
        let handles = 2 * parts.len() as i64 - euler - boundary_loops as i64;
        let orientation = surface.orientation();
        let (min, max) = angle_range(surface);
        let delaunay = surface.is_triangulated().then(|| DelaunayCount::of(surface));
        SurfaceFacts {
            corners,
            boundary_loops,
            boundary_edges,
            euler_characteristic: euler,
            genus: (manifold && orientation.orientable && handles >= 0).then_some((handles / 2) as usize),
            closed: boundary_edges == 0,
            manifold,
            orientable: orientation.orientable,
            ill_oriented_edges: orientation.ill_oriented_edges,
            flipped_faces: orientation.flipped_faces,
            non_manifold_edges,
            non_manifold_vertices,
            degenerate_faces: degenerate_faces(surface).len(),
            duplicate_faces: duplicate_faces(surface),
            planar: surface.plane().is_some(),
            min_angle_deg: min,
            max_angle_deg: max,
            area: surface.area(),
            delaunay: delaunay.as_ref().map(DelaunayCount::is_delaunay),
            non_delaunay_edges: delaunay.as_ref().map(|d| d.violated.len()),
            non_delaunay_within_rounding: delaunay.as_ref().map(|d| d.within_rounding),
            cocircular_edges: delaunay.as_ref().map(|d| d.cocircular),
        }
    }
}

/// The faces of zero area: triangles with collinear corners (decided exactly), polygons whose corners are all collinear.
pub fn degenerate_faces(surface: &Surface) -> Vec<usize> {
    let at = |v: usize| surface.positions()[v];
    let flat = |f: &[usize]| {
        let far = f.iter().copied().find(|&v| at(v) != at(f[0])).unwrap_or(f[0]);
        f.iter().all(|&v| geometry::collinear(at(f[0]), at(far), at(v)))
    };
    surface.faces().iter().enumerate().filter(|(_, face)| flat(face)).map(|(f, _)| f).collect()
}

/// Of faces with the same corners one has the same smallest vertex as the other: only those around a vertex are compared.
fn duplicate_faces(surface: &Surface) -> usize {
    let faces = surface.faces();
    let mut sorted: Vec<Vec<usize>> = Vec::new();
    let mut duplicates = 0;
    for v in 0..surface.positions().len() {
        let here = surface.topology().star(v).iter().map(|c| &faces[c.face()]);
        let mut used = 0;
        for face in here.filter(|f| f.iter().all(|&w| w >= v)) {
            if used == sorted.len() {
                sorted.push(Vec::new());
            }
            sorted[used].clear();
            sorted[used].extend_from_slice(face);
            sorted[used].sort_unstable();
            used += 1;
        }
        sorted[..used].sort_unstable();
        duplicates += sorted[..used].windows(2).filter(|w| w[0] == w[1]).count();
    }
    duplicates
}

fn angle_range(surface: &Surface) -> (f64, f64) {
    let mut range = (180.0_f64, 0.0_f64);
    for face in surface.faces() {
        for (k, &v) in face.iter().enumerate() {
            let next = face[(k + 1) % face.len()];
            let previous = face[(k + face.len() - 1) % face.len()];
            let angle = geometry::angle(surface.point(v), surface.point(next), surface.point(previous)).to_degrees();
            range = (range.0.min(angle), range.1.max(angle));
        }
    }
    range
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> Surface {
        let p = vec![[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        Surface::triangles(p, &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]).unwrap()
    }

    #[test]
    fn a_tetrahedron_is_a_closed_connected_sphere_with_equal_angles() {
        let facts = Domain::from(tetrahedron()).facts();
        let s = facts.surface.as_ref().unwrap();
        assert_eq!((facts.vertices, facts.edges, facts.faces, facts.components), (4, 6, 4, 1));
        assert_eq!((s.euler_characteristic, s.genus, s.closed, s.manifold), (2, Some(0), true, true));
        assert_eq!((s.delaunay, s.non_delaunay_edges, s.cocircular_edges), (Some(true), Some(0), Some(0)));
        assert!((s.min_angle_deg - 60.0).abs() < 1e-12 && (s.max_angle_deg - 60.0).abs() < 1e-12);
    }

    #[test]
    fn a_square_with_a_diagonal_is_planar_and_its_diagonal_cocircular() {
        let p = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let facts = Domain::from(Surface::planar(&p, &[[0, 1, 2], [0, 2, 3]]).unwrap()).facts();
        let s = facts.surface.unwrap();
        assert_eq!((s.planar, s.cocircular_edges, s.boundary_edges, s.boundary_loops), (true, Some(1), 4, 1));
        assert_eq!((s.area, s.genus), (1.0, Some(0)));
    }

    #[test]
    fn facts_survive_json() {
        let facts = Domain::from(tetrahedron()).facts();
        let text = serde_json::to_string(&facts).unwrap();
        assert!(text.contains("\"non_delaunay_edges\":0,\"non_delaunay_within_rounding\":0,"));
        assert_eq!(serde_json::from_str::<Facts>(&text).unwrap(), facts);
        assert!(serde_json::from_str::<Facts>(&text.replace("planar", "plane")).is_err());
    }
}
