//! Small meshes and operators whose entries can be worked out by hand.

use lapjury::domain::{Domain, Graph, Surface};
use lapjury::linalg::Csr;
use lapjury::operator::{Mass, MassKind, Operator, Provenance};
use lapjury::property::Excerpt;
use lapjury::property::evidence::Row;

/// A square of side 2 whose centre, vertex 4, is joined to the corners. Area 4.
pub fn square() -> Domain {
    let p = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0]];
    Surface::planar(&p, &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]).unwrap().into()
}

/// Its cotangent matrix: the angles opposite the spokes are 45°, so they weigh ½(1 + 1); those opposite the sides are right.
pub fn square_cotan() -> Vec<(usize, usize, f64)> {
    let mut t = vec![(4, 4, 4.0)];
    (0..4).for_each(|i| t.extend([(i, i, 1.0), (i, 4, -1.0), (4, i, -1.0)]));
    t
}

/// Two obtuse triangles over the edge (0, 1): the angles opposite have cotangent −3/4. The ends see cotangent 2.
///
/// At vertex 0 of triangle (0, 1, 2): sides (4, 0) and (2, 1), dot 8, cross 4. The remaining edges have one opposite angle of
/// cotangent 2 and weigh 1.
pub fn kite() -> Domain {
    let p = [[0.0, 0.0], [4.0, 0.0], [2.0, 1.0], [2.0, -1.0]];
    Surface::planar(&p, &[[0, 1, 2], [1, 0, 3]]).unwrap().into()
}

pub fn kite_cotan() -> Vec<(usize, usize, f64)> {
    laplacian(&[(0, 1, -0.75), (0, 2, 1.0), (0, 3, 1.0), (1, 2, 1.0), (1, 3, 1.0)])
}

/// The Laplacian with these weights.
pub fn laplacian(weights: &[(usize, usize, f64)]) -> Vec<(usize, usize, f64)> {
    weights.iter().flat_map(|&(i, j, w)| [(i, j, -w), (j, i, -w), (i, i, w), (j, j, w)]).collect()
}

/// A regular tetrahedron with edges of length 2√2: area 8√3.
pub fn tetrahedron() -> Domain {
    let p = vec![[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    Surface::triangles(p, &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]).unwrap().into()
}

pub fn graph(n: usize, edges: &[[usize; 2]], boundary: &[usize]) -> Domain {
    Graph::new(n, edges).unwrap().with_boundary(boundary).unwrap().into()
}

pub fn operator(n: usize, entries: &[(usize, usize, f64)]) -> Operator {
    Operator::new(Csr::from_triplets(n, n, entries), Provenance::default()).unwrap()
}

/// The same entries with some replaced or added.
pub fn with(mut entries: Vec<(usize, usize, f64)>, changes: &[(usize, usize, f64)]) -> Vec<(usize, usize, f64)> {
    entries.retain(|e| !changes.iter().any(|c| (c.0, c.1) == (e.0, e.1)));
    entries.extend(changes);
    entries
}

pub fn lumped(o: Operator, diagonal: &[f64]) -> Operator {
    o.with_mass(Mass::lumped(MassKind::Given, diagonal)).unwrap()
}

pub fn full_mass(o: Operator, entries: &[(usize, usize, f64)]) -> Operator {
    let n = o.size();
    o.with_mass(Mass::full(MassKind::Given, Csr::from_triplets(n, n, entries))).unwrap()
}

fn rows_of(matrix: &Csr, which: &[usize]) -> Vec<Row> {
    which.iter().map(|&i| Row { row: i, entries: matrix.row(i).map(|(j, v)| (j, *v)).collect() }).collect()
}

pub fn rows(o: &Operator, which: &[usize]) -> Excerpt {
    Excerpt { rows: rows_of(o.stiffness(), which), ..Excerpt::default() }
}

pub fn mass_rows(o: &Operator, which: &[usize]) -> Excerpt {
    Excerpt { mass_rows: rows_of(o.mass().unwrap().matrix(), which), ..Excerpt::default() }
}

pub fn positions(mut e: Excerpt, domain: &Domain, which: &[usize]) -> Excerpt {
    e.positions = which.iter().map(|&v| (v, domain.positions().unwrap()[v])).collect();
    e
}

pub fn faces(mut e: Excerpt, domain: &Domain, which: &[usize]) -> Excerpt {
    e.faces = which.iter().map(|&f| (f, domain.as_surface().unwrap().faces()[f].to_vec())).collect();
    e
}

pub fn edges(mut e: Excerpt, which: &[[usize; 2]]) -> Excerpt {
    e.edges = which.to_vec();
    e
}
