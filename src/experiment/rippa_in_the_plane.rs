//! Rippa in the plane: of all triangulations the Delaunay one has the least Dirichlet energy, for every function, because
//! flips lead there and each takes a positive semi-definite term of rank one away.

use std::collections::BTreeMap;

use super::poll::{Case, Every};
use super::world::descent::{Descent, term};
use super::world::triangulations::{self, Point, Triangulation, describe_world, world};
use super::{Experiment, Finding, Setting};
use crate::domain::{Domain, Surface};
use crate::generate::{self, Stream};
use crate::laplacian::cotan::stiffness_in_plane;
use crate::linalg::Dense;
use crate::property::Evidence;
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "rippa-in-the-plane",
    name: "Delaunay minimises the Dirichlet energy of every function, in the plane",
    statement: "L_T − L_D = Σ κ w wᵀ with κ > 0 over the flips from a triangulation T to a Delaunay one D, exactly; so \
                uᵀL_T u ≥ uᵀL_D u for every u",
    sources: &["wardetzky-primer", "rippa1990", "lawson1977"],
    parts: &["a-flip-is-rank-one", "every-triangulation", "random-meshes", "worst-angle-meshes"],
    run,
};

/// Whole coordinates of random meshes are below this.
const SIDE: usize = 1000;

fn run(setting: &Setting) -> Vec<Finding> {
    let side = setting.pick(2, 3) as i64;
    let mut flips = Every::default();
    for points in triangulations::point_sets(4, side) {
        flips.ask(not_rank_one(&points));
    }
    let largest = setting.pick(5, 6);
    let mut everywhere = Every::default();
    for triangulation in world(largest) {
        everywhere.ask(exception(triangulation.surface(), true));
    }
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let count = setting.pick(6, 60);
    let (mut random, mut worst) = (Every::default(), Every::default());
    let mut certificates = [None, None];
    for k in 0..count {
        let n = 8 + stream.below(setting.pick(6, 33));
        let start = random_mesh(n, &mut stream);
        let spoilt = start.as_ref().and_then(worst_angle);
        let values: Vec<f64> = (0..n).map(|_| stream.below(17) as f64 - 8.0).collect();
        for (surface, (poll, certificate)) in
            [start, spoilt].into_iter().zip([&mut random, &mut worst].into_iter().zip(&mut certificates))
        {
            let Some(surface) = surface else {
                poll.ask(Some(Case::told(format!("no mesh of {n} random points"))));
                continue;
            };
            if k == 0 {
                *certificate = Descent::of(surface.clone()).ok().and_then(|d| d.certificate(&values));
            }
            poll.ask(exception(surface, false));
        }
    }
    let [of_random, of_worst] = certificates;
    let question = "Is L_T − L_D, entry by entry, the sum of κ w wᵀ with κ > 0 over the flips from T to Delaunay?";
    vec![
        flips.answer(
            ENTRY.parts[0],
            "Is L_ac − L_bd = κ w wᵀ, with κ of the sign of the in-circle determinant, for the two diagonals?",
            &format!("sets of four points in a box of {0} × {0} lattice points", side + 1),
        ),
        everywhere.answer(
            ENTRY.parts[1],
            format!("{question} Has it no negative eigenvalue? Cases: {}.", describe_world(largest)),
            "triangulations",
        ),
        with(random.answer(ENTRY.parts[2], question, "sweep triangulations of random whole points"), of_random),
        with(
            worst.answer(ENTRY.parts[3], question, "the same meshes after flips towards a worst angle vector"),
            of_worst,
        ),
    ]
}

/// A finding with a certificate, where no exception is in its place.
fn with(mut finding: Finding, certificate: Option<Evidence>) -> Finding {
    if finding.agrees {
        finding.evidence.extend(certificate);
    }
    finding
}

/// Where the two triangulations of four points in convex position do not differ by the term of the flip.
fn not_rank_one(points: &[Point]) -> Option<Case> {
    let both = triangulations::triangulations(points);
    let [first, second] = both.as_slice() else { return None };
    let at: Vec<[Rational; 2]> = points.iter().map(|p| p.map(Rational::from)).collect();
    let diagonal = first.edges().into_iter().find(|e| e.right.is_some())?;
    let quad = [diagonal.ends[0], diagonal.right?, diagonal.ends[1], diagonal.left];
    let told = |what: String| Some(Case::told(format!("{what} on {}", first.describe())));
    let Some(t) = term(&at, quad) else { return told("no strictly convex quadrilateral".into()) };
    let stiffness = |t: &Triangulation| stiffness_in_plane::<Rational>(&t.surface());
    let (Some(before), Some(after)) = (stiffness(first), stiffness(second)) else {
        return told("no cotangent stiffness".into());
    };
    let places = (0..4).flat_map(|m| (0..4).map(move |n| (m, n)));
    let (m, n) = places.into_iter().find(|&(m, n)| {
        let (i, j) = (quad[m], quad[n]);
        before.at(i, j) - after.at(i, j) != t.kappa.clone() * t.w[m].clone() * t.w[n].clone()
    })?;
    told(format!("L_ac − L_bd differs from κ w wᵀ at ({}, {})", quad[m], quad[n]))
}

/// What speaks against the theorem on a mesh. With `inertia`, semi-definiteness is decided a second time, by elimination.
fn exception(surface: Surface, inertia: bool) -> Option<Case> {
    let n = surface.positions().len();
    let told = |what: String| {
        let faces: Vec<String> = surface.faces().iter().map(|f| format!("{f:?}")).collect();
        Case::told(format!("{what} on {:?} with the faces {}", surface.positions(), faces.join(" ")))
    };
    let descent = match Descent::of(surface.clone()) {
        Ok(descent) => descent,
        Err(error) => return Some(told(error.to_string())),
    };
    if let Some(what) = descent.violation() {
        return Some(told(what));
    }
    if !inertia {
        return None;
    }
    let entries: BTreeMap<(usize, usize), Rational> = descent.difference()?;
    let zero = Rational::zero();
    let dense = Dense::from_fn(n, n, |i, j| entries.get(&(i, j)).unwrap_or(&zero).clone());
    (!dense.eliminate().is_semidefinite()).then(|| told("L_T − L_D has a negative eigenvalue".into()))
}

/// A triangulation of random whole points by the sweep: far from Delaunay.
fn random_mesh(n: usize, stream: &mut Stream) -> Option<Surface> {
    let mut points: Vec<Point> = Vec::with_capacity(n);
    while points.len() < n {
        let p = [stream.below(SIDE) as i64, stream.below(SIDE) as i64];
        if !points.contains(&p) {
            points.push(p);
        }
    }
    Some(triangulations::sweep(&points)?.surface())
}

/// The mesh after the flips of the generator `worst-angle`.
fn worst_angle(surface: &Surface) -> Option<Surface> {
    let domain = Domain::from(surface.clone());
    let changed = generate::find("worst-angle")?.run(Some(&domain), &BTreeMap::new(), 0).ok()?;
    changed.as_surface().cloned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kite_is_rank_one_and_three_points_inside_one_another_have_no_second_triangulation() {
        assert!(not_rank_one(&[[0, 0], [1, 0], [3, 3], [0, 1]]).is_none());
        assert!(not_rank_one(&[[0, 0], [3, 0], [0, 3], [1, 1]]).is_none());
    }

    #[test]
    fn random_meshes_have_whole_positions_and_worst_ones_need_more_flips() {
        let mut stream = Stream::new(1, "test");
        let (mut before, mut after) = (0, 0);
        for _ in 0..5 {
            let mesh = random_mesh(20, &mut stream).unwrap();
            assert!(mesh.positions().iter().flatten().all(|x| x.fract() == 0.0));
            let spoilt = worst_angle(&mesh).unwrap();
            assert_eq!(spoilt.positions(), mesh.positions());
            before += Descent::of(mesh).unwrap().terms.len();
            after += Descent::of(spoilt).unwrap().terms.len();
        }
        assert!(after > before, "{after} against {before}");
    }

    #[test]
    fn a_mesh_with_a_degenerate_face_is_an_exception_and_no_panic() {
        let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]];
        let flat = Surface::planar(&points, &[[0, 1, 3], [1, 2, 3], [0, 2, 1]]).unwrap();
        assert!(exception(flat, true).is_some());
    }
}
