//! Images of a domain under a transformation, with what they do to an operator that is invariant.

use crate::domain::{Domain, Graph, PointCloud, Surface, Volume};

/// A transformed domain, and what an operator that respects the transformation is on it.
pub(crate) struct Image {
    /// The transformation, in words that say how to repeat it.
    pub words: String,
    /// The transformed domain.
    pub domain: Domain,
    /// Where the vertices of the original are found: one list for each copy.
    pub places: Vec<Vec<usize>>,
    /// The distance by which rounding may have displaced a vertex, in the units of the original.
    pub displaced: f64,
    /// The factor that the stiffness takes on.
    pub stiffness: f64,
    /// The factor that the mass takes on.
    pub mass: f64,
    /// The rows to compare; all of them if absent.
    pub rows: Option<Vec<bool>>,
}

impl Image {
    /// An image with the same vertices in the same places, whose operator should be the same.
    pub(crate) fn new(words: String, domain: Domain) -> Self {
        let places = vec![(0..domain.vertex_count()).collect()];
        Image { words, domain, places, displaced: 0.0, stiffness: 1.0, mass: 1.0, rows: None }
    }

    /// The same image, with vertices displaced by rounding.
    pub(crate) fn displaced(mut self, by: f64) -> Self {
        self.displaced = by;
        self
    }
}

/// The domain with its positions mapped and, if `reversed`, every face turned round; normals are mapped by `normal`. `None`
/// if it has no positions; an error where the new coordinates make no domain.
pub(crate) fn moved(
    domain: &Domain,
    position: impl Fn(usize, [f64; 3]) -> [f64; 3],
    normal: impl Fn([f64; 3]) -> [f64; 3],
    reversed: bool,
) -> Option<Result<Domain, String>> {
    let place = |p: &[[f64; 3]]| p.iter().enumerate().map(|(i, p)| position(i, *p)).collect::<Vec<_>>();
    let made = match domain {
        Domain::Graph(_) => return None,
        Domain::Surface(s) => {
            if !reversed {
                return Some(s.with_positions(place(s.positions())).map(Domain::from).map_err(|e| e.to_string()));
            }
            let faces = s.faces().iter().map(|f| f.iter().rev().copied().collect()).collect();
            Surface::new(place(s.positions()), faces).map(Domain::from)
        }
        Domain::Volume(v) => {
            let mut tetrahedra = v.tetrahedra().to_vec();
            if reversed {
                tetrahedra.iter_mut().for_each(|t| t.swap(0, 1));
            }
            Volume::new(place(v.positions()), tetrahedra).map(Domain::from)
        }
        Domain::Points(p) => {
            let normals = p.normals().map(|n| n.iter().map(|n| normal(*n)).collect());
            PointCloud::new(place(p.positions()), normals).map(Domain::from)
        }
    };
    Some(made.map_err(|e| e.to_string()))
}

/// The domain with vertex i renumbered `place[i]`.
pub(crate) fn renumbered(domain: &Domain, place: &[usize]) -> Result<Domain, String> {
    fn permuted<T: Copy>(list: &[T], place: &[usize]) -> Vec<T> {
        let mut order: Vec<usize> = (0..list.len()).collect();
        order.sort_by_key(|&i| place[i]);
        order.into_iter().map(|i| list[i]).collect()
    }
    let list = |corners: &[usize]| corners.iter().map(|&v| place[v]).collect::<Vec<_>>();
    let made = match domain {
        Domain::Surface(s) => {
            Surface::new(permuted(s.positions(), place), s.faces().iter().map(list).collect()).map(Domain::from)
        }
        Domain::Volume(v) => {
            let tetrahedra = v.tetrahedra().iter().map(|t| t.map(|v| place[v])).collect();
            Volume::new(permuted(v.positions(), place), tetrahedra).map(Domain::from)
        }
        Domain::Points(p) => {
            let normals = p.normals().map(|n| permuted(n, place));
            PointCloud::new(permuted(p.positions(), place), normals).map(Domain::from)
        }
        Domain::Graph(g) => {
            let edges: Vec<[usize; 2]> = g.edges().iter().map(|e| e.map(|v| place[v])).collect();
            let boundary: Vec<usize> = (0..place.len()).filter(|&v| g.boundary()[v]).map(|v| place[v]).collect();
            graph(place.len(), &edges, g.weights(), &boundary).map(Domain::from)
        }
    };
    made.map_err(|e| e.to_string())
}

/// The domain together with a second copy of it; `shift` moves the copy. Vertex i of the copy has the number `n + i`.
pub(crate) fn doubled(domain: &Domain, shift: impl Fn([f64; 3]) -> [f64; 3]) -> Result<Domain, String> {
    let n = domain.vertex_count();
    let both = |p: &[[f64; 3]]| p.iter().copied().chain(p.iter().map(|p| shift(*p))).collect::<Vec<_>>();
    let made = match domain {
        Domain::Surface(s) => {
            let copy = s.faces().iter().map(|f| f.iter().map(|v| v + n).collect());
            Surface::new(both(s.positions()), s.faces().iter().map(<[usize]>::to_vec).chain(copy).collect())
                .map(Domain::from)
        }
        Domain::Volume(v) => {
            let copy = v.tetrahedra().iter().map(|t| t.map(|v| v + n));
            Volume::new(both(v.positions()), v.tetrahedra().iter().copied().chain(copy).collect()).map(Domain::from)
        }
        Domain::Points(p) => {
            let normals = p.normals().map(|m| [m, m].concat());
            PointCloud::new(both(p.positions()), normals).map(Domain::from)
        }
        Domain::Graph(g) => {
            let copy = g.edges().iter().map(|e| e.map(|v| v + n));
            let edges: Vec<[usize; 2]> = g.edges().iter().copied().chain(copy).collect();
            let weights = g.weights().map(|w| [w, w].concat());
            let boundary: Vec<usize> = (0..2 * n).filter(|&v| g.boundary()[v % n]).collect();
            graph(2 * n, &edges, weights.as_deref(), &boundary).map(Domain::from)
        }
    };
    made.map_err(|e| e.to_string())
}

fn graph(
    n: usize,
    edges: &[[usize; 2]],
    weights: Option<&[f64]>,
    boundary: &[usize],
) -> Result<Graph, crate::domain::DomainError> {
    let graph = match weights {
        Some(w) => Graph::weighted(n, edges, w)?,
        None => Graph::new(n, edges)?,
    };
    graph.with_boundary(boundary)
}

/// The centre of the bounding box and its diagonal.
pub(crate) fn extent(positions: &[[f64; 3]]) -> ([f64; 3], f64) {
    let of = |axis: usize, start: f64, pick: fn(f64, f64) -> f64| positions.iter().map(|p| p[axis]).fold(start, pick);
    let low: [f64; 3] = std::array::from_fn(|k| of(k, f64::INFINITY, f64::min));
    let high: [f64; 3] = std::array::from_fn(|k| of(k, f64::NEG_INFINITY, f64::max));
    let centre = std::array::from_fn(|k| 0.5 * low[k] + 0.5 * high[k]);
    (centre, crate::property::measure::condition::distance(low, high))
}

/// The largest rounding error of `p + shift` over all positions, measured (the error of a sum is computed exactly).
pub(crate) fn rounding_of_shift(positions: &[[f64; 3]], shift: [f64; 3]) -> f64 {
    let error = |a: f64, b: f64| {
        let sum = a + b;
        let part = sum - a;
        ((a - (sum - part)) + (b - part)).abs()
    };
    positions.iter().map(|p| (0..3).map(|k| error(p[k], shift[k])).sum::<f64>()).fold(0.0, f64::max)
}
