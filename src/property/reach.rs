//! REACH: the construction is local.
//!
//! # Definition
//! Moving a vertex changes no row further away than `r = 1` ring, rings counted by common faces. A construction from faces has
//! `L_ij` depend on the faces that contain i and j, so that row i depends on the faces at i: a vertex outside them has no say.
//! An operator on the intrinsic Delaunay triangulation fails where flips carry a change further.
//!
//! # Decision
//! [`MOVED`] seeded interior vertices are moved, one at a time, by a twentieth of the shortest edge there (in the plane, for a planar mesh, without
//! turning a triangle over). The first is drawn among the vertices to which a row further away refers, if there are any:
//! they are where a change would be seen.
//!
//! # Exception
//! Not applicable to graphs and point clouds, where no vertex has a position and faces at once.

use super::measure::condition::distance;
use super::relate::image::{Image, moved};
use super::relate::relation;
use super::stencil::Stencil;
use super::{Construction, Property, Question, Trial, Verdict};
use crate::domain::geometry::{Vec3, orient2d};
use crate::domain::{Domain, Surface};
use crate::stream::Stream;

/// How many vertices are moved, one at a time.
pub const MOVED: usize = 4;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "REACH",
    name: "locality of the construction",
    statement: "moving a vertex changes no row of L and M further away than one ring, rings counted by common faces",
    sources: &["wardetzky2007"],
    question: Question::Construction(decide),
};

fn decide(trial: &Trial, construction: &Construction) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    let cells: Vec<Vec<usize>> = match trial.domain {
        Domain::Surface(s) => s.faces().to_vec(),
        Domain::Volume(v) => v.tetrahedra().iter().map(|t| t.to_vec()).collect(),
        Domain::Graph(_) => return Verdict::not_applicable("a graph has no positions"),
        Domain::Points(_) => return Verdict::not_applicable("a point cloud has no rings"),
    };
    let near = trial.stencil();
    let mut stream = Stream::new(trial.seed, "REACH");
    let chosen = choose(trial, &mut stream);
    let images: Vec<Image> =
        chosen.into_iter().filter_map(|v| image(trial.domain, &cells, near, v, &mut stream)).collect();
    if images.is_empty() {
        return Verdict::not_applicable("no interior vertex can be moved, or none has a row further away");
    }
    relation::decide(trial, construction, images)
}

/// Interior vertices with rows further away: one that such a row refers to first, then drawn ones.
fn choose(trial: &Trial, stream: &mut Stream) -> Vec<usize> {
    let (near, n) = (trial.stencil(), trial.domain.vertex_count());
    let count = |v: usize| near.neighbours(v).len();
    let mut all: Vec<usize> =
        trial.domain.interior().into_iter().filter(|&v| count(v) > 0 && count(v) + 1 < n).collect();
    stream.shuffle(&mut all);
    let mut met = vec![false; n];
    for (i, j, v) in trial.operator.stiffness().entries() {
        met[j] |= *v != 0.0 && !near.contains(j, i);
    }
    all.sort_by_key(|&v| !met[v]);
    all.truncate(MOVED);
    all
}

fn image(domain: &Domain, cells: &[Vec<usize>], near: &Stencil, vertex: usize, stream: &mut Stream) -> Option<Image> {
    let positions = domain.positions()?;
    let lengths = near.neighbours(vertex).iter().map(|&w| distance(positions[vertex], positions[w]));
    let shortest = lengths.fold(f64::INFINITY, f64::min);
    if !(shortest > 0.0 && shortest.is_finite()) {
        return None;
    }
    let plane = domain.as_surface().and_then(Surface::plane);
    let mut direction = Vec3::zeros();
    match plane {
        Some(axes) => axes.iter().for_each(|&k| direction[k] = stream.normal()),
        None => (0..3).for_each(|k| direction[k] = stream.normal()),
    }
    let direction = direction.normalize();
    if !direction.iter().all(|x| x.is_finite()) {
        return None;
    }
    // Halved until no triangle of a planar star turns over.
    let mut length = shortest / 20.0;
    let target = loop {
        let target: [f64; 3] = (Vec3::from(positions[vertex]) + direction * length).into();
        if plane.is_none_or(|axes| !turns_over(positions, cells, vertex, target, axes)) {
            break target;
        }
        length /= 2.0;
        if length < shortest * 1e-6 {
            return None;
        }
    };
    let place = |v: usize, p: [f64; 3]| if v == vertex { target } else { p };
    let moved = moved(domain, place, |n| n, false)?.ok()?;
    let mut image = Image::new(format!("moving vertex {vertex} to {target:?}"), moved);
    image.rows = Some((0..positions.len()).map(|i| !near.contains(vertex, i)).collect());
    Some(image)
}

/// Whether a triangle at the vertex changes its orientation when the vertex is moved.
fn turns_over(positions: &[[f64; 3]], cells: &[Vec<usize>], vertex: usize, target: [f64; 3], axes: [usize; 2]) -> bool {
    let flat = |p: [f64; 3]| axes.map(|k| p[k]);
    let before = |v: usize| flat(positions[v]);
    let after = |v: usize| if v == vertex { flat(target) } else { before(v) };
    cells.iter().filter(|c| c.contains(&vertex)).any(|cell| {
        (1..cell.len() - 1).any(|k| {
            let corners = [cell[0], cell[k], cell[k + 1]];
            let turn = |at: &dyn Fn(usize) -> [f64; 2]| orient2d(at(corners[0]), at(corners[1]), at(corners[2]));
            turn(&before) != turn(&after)
        })
    })
}
