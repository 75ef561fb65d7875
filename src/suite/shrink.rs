//! Shrinking: a surface on which something goes wrong is made smaller while it still goes wrong.
//!
//! # Definition
//! Three kinds of step, each kept if the predicate is still true of the result, in rounds until none helps:
//! 1. faces are left out, in halves, quarters, … down to single ones (delta debugging), with the vertices that no face is left for;
//! 2. a vertex is moved onto one of its neighbours, with which the faces between them vanish;
//! 3. coordinates become small whole numbers: the whole mesh is put on a lattice of 1, 2, 3, … steps, then single coordinates
//!    are pulled towards zero.
//!
//! # Guarantees
//! The predicate is true of what comes out if it was of what went in; else that comes back unchanged. Steps keep what the
//! surface had: manifold, connected, planar and unfolded, without degenerate face, triangulated. The order of steps is fixed: the same surface
//! and predicate give the same result. The predicate is called at most as often as stated.
//!
//! # Limitations
//! The result is small, not smallest: no single step makes it smaller. Only surfaces shrink.
//!
//! # References
//! Zeller and Hildebrandt 2002 for the first step.

use std::collections::BTreeSet;

use crate::domain::{Domain, Surface, SurfaceFacts};

/// What shrinking came to.
pub struct Shrunk {
    /// The domain.
    pub domain: Domain,
    /// How often the predicate was asked.
    pub calls: usize,
}

/// Shrinks a domain while `fails` is true of it, asking at most `most` times.
pub fn shrink(domain: &Domain, most: usize, fails: &dyn Fn(&Domain) -> bool) -> Shrunk {
    let untouched = |calls| Shrunk { domain: domain.clone(), calls };
    let Domain::Surface(surface) = domain else { return untouched(0) };
    if most == 0 || !fails(domain) {
        return untouched(most.min(1));
    }
    let keeps = Kept::of(domain);
    let mut work = Work { best: Mesh::of(surface), keeps, fails, calls: 1, most };
    loop {
        let before = work.best.clone();
        work.fewer_faces();
        work.fewer_vertices();
        if work.best == before || work.is_spent() {
            break;
        }
    }
    work.smaller_coordinates();
    let domain = work.best.domain().unwrap_or_else(|| domain.clone());
    Shrunk { domain, calls: work.calls }
}

/// Positions and faces.
#[derive(Clone, PartialEq)]
struct Mesh {
    positions: Vec<[f64; 3]>,
    faces: Vec<Vec<usize>>,
}

impl Mesh {
    fn of(surface: &Surface) -> Self {
        Mesh { positions: surface.positions().to_vec(), faces: surface.faces().to_vec() }
    }

    fn domain(&self) -> Option<Domain> {
        Surface::new(self.positions.clone(), self.faces.clone()).ok().map(Domain::from)
    }

    /// Without the vertices that no face has.
    fn compact(mut self) -> Self {
        let used: BTreeSet<usize> = self.faces.iter().flatten().copied().collect();
        let number: std::collections::BTreeMap<usize, usize> = used.iter().enumerate().map(|(k, &v)| (v, k)).collect();
        self.positions = used.iter().map(|&v| self.positions[v]).collect();
        self.faces.iter_mut().flatten().for_each(|v| *v = number[v]);
        self
    }
}

/// What a step must keep.
struct Kept {
    components: usize,
    facts: Option<SurfaceFacts>,
}

impl Kept {
    fn of(domain: &Domain) -> Self {
        let facts = domain.facts();
        Kept { components: facts.components, facts: facts.surface }
    }

    fn allows(&self, domain: &Domain) -> bool {
        let facts = domain.facts();
        let (Some(had), Some(has)) = (&self.facts, &facts.surface) else { return false };
        facts.components <= self.components.max(1)
            && facts.vertices > 0
            && (!had.manifold || has.manifold)
            && (!had.planar || has.planar)
            && (!had.orientable || has.orientable)
            && has.degenerate_faces <= had.degenerate_faces
            && has.duplicate_faces <= had.duplicate_faces
    }
}

struct Work<'a> {
    best: Mesh,
    keeps: Kept,
    fails: &'a dyn Fn(&Domain) -> bool,
    calls: usize,
    most: usize,
}

impl Work<'_> {
    fn is_spent(&self) -> bool {
        self.calls >= self.most
    }

    /// Takes the mesh if it keeps what is to be kept and the predicate is true of it.
    fn try_out(&mut self, mesh: Mesh) -> bool {
        if self.is_spent() || mesh.faces.is_empty() {
            return false;
        }
        let Some(domain) = mesh.domain() else { return false };
        if !self.keeps.allows(&domain) {
            return false;
        }
        self.calls += 1;
        let taken = (self.fails)(&domain);
        if taken {
            self.best = mesh;
        }
        taken
    }

    /// Leaves out runs of faces, long ones first. The faces are in the order of a walk over neighbours, so that a run is a
    /// patch and not confetti.
    fn fewer_faces(&mut self) {
        self.best.faces = walk(&self.best.faces);
        let mut run = self.best.faces.len() / 2;
        while run >= 1 && !self.is_spent() {
            let mut at = 0;
            while at < self.best.faces.len() {
                let mut mesh = self.best.clone();
                let end = (at + run).min(mesh.faces.len());
                mesh.faces.drain(at..end);
                if !self.try_out(mesh.compact()) {
                    at += run;
                }
            }
            run /= 2;
        }
    }

    /// Moves a vertex onto one of its neighbours: the faces with both are left out, and so is the vertex.
    fn fewer_vertices(&mut self) {
        let mut vertex = 0;
        while vertex < self.best.positions.len() && !self.is_spent() {
            let neighbours: BTreeSet<usize> = self
                .best
                .faces
                .iter()
                .filter(|f| f.contains(&vertex))
                .flatten()
                .copied()
                .filter(|&v| v != vertex)
                .collect();
            let moved = neighbours.into_iter().any(|onto| {
                let mut mesh = self.best.clone();
                mesh.faces.retain(|f| !(f.contains(&vertex) && f.contains(&onto)));
                mesh.faces.iter_mut().flatten().filter(|v| **v == vertex).for_each(|v| *v = onto);
                self.try_out(mesh.compact())
            });
            if !moved {
                vertex += 1;
            }
        }
    }

    fn smaller_coordinates(&mut self) {
        for steps in [1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 24, 32, 64, 128, 256, 1024] {
            let mesh = on_lattice(&self.best, f64::from(steps));
            if self.try_out(mesh) {
                break;
            }
        }
        let mut improved = true;
        while improved && !self.is_spent() {
            improved = false;
            for v in 0..self.best.positions.len() {
                for axis in 0..3 {
                    improved |= self.pull(v, axis);
                }
            }
        }
    }

    /// Pulls a coordinate towards zero: to zero itself, to half of it, to the whole number before it.
    fn pull(&mut self, v: usize, axis: usize) -> bool {
        let x = self.best.positions[v][axis];
        let candidates = [0.0, (0.5 * x).trunc(), x.trunc(), x - x.signum()];
        for y in candidates.into_iter().filter(|y| y.abs() < x.abs()) {
            let mut mesh = self.best.clone();
            mesh.positions[v][axis] = y;
            if self.try_out(mesh) {
                return true;
            }
        }
        false
    }
}

/// The mesh moved to the origin, scaled to so many steps and rounded to whole numbers.
fn on_lattice(mesh: &Mesh, steps: f64) -> Mesh {
    let low: [f64; 3] = std::array::from_fn(|a| mesh.positions.iter().map(|p| p[a]).fold(f64::INFINITY, f64::min));
    let extent = mesh.positions.iter().flat_map(|p| (0..3).map(move |a| p[a] - low[a])).fold(0.0, f64::max);
    let scale = if extent > 0.0 { steps / extent } else { 0.0 };
    let put = |p: &[f64; 3]| std::array::from_fn(|a| ((p[a] - low[a]) * scale).round());
    Mesh { positions: mesh.positions.iter().map(put).collect(), faces: mesh.faces.clone() }
}

/// The faces in breadth-first order over common vertices, from the first face of each component.
fn walk(faces: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let vertices = faces.iter().flatten().max().map_or(0, |v| v + 1);
    let mut star = vec![Vec::new(); vertices];
    for (f, face) in faces.iter().enumerate() {
        face.iter().for_each(|&v| star[v].push(f));
    }
    let (mut seen, mut order) = (vec![false; faces.len()], Vec::with_capacity(faces.len()));
    for start in 0..faces.len() {
        if std::mem::replace(&mut seen[start], true) {
            continue;
        }
        let mut next = order.len();
        order.push(start);
        while next < order.len() {
            for &f in faces[order[next]].iter().flat_map(|&v| &star[v]) {
                if !std::mem::replace(&mut seen[f], true) {
                    order.push(f);
                }
            }
            next += 1;
        }
    }
    order.into_iter().map(|f| faces[f].clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::{self, Status, Trial};
    use crate::suite::{Choice, Recipe};
    use std::cell::Cell;
    use std::path::Path;

    fn make(recipe: &str) -> Domain {
        recipe.parse::<Recipe>().unwrap().build(Path::new(".")).unwrap()
    }

    fn fails(laplacian: &str, property: &str) -> impl Fn(&Domain) -> bool {
        let (choice, property) = (laplacian.parse::<Choice>().unwrap(), property::find(property).unwrap());
        move |domain| {
            let Ok(operator) = choice.build(domain) else { return false };
            let trial = Trial::new(domain, &operator, 0).unwrap();
            property.decide(&trial, None).status() == Status::Fails
        }
    }

    #[test]
    fn a_failure_planted_in_two_hundred_vertices_shrinks_to_the_size_known_by_hand() {
        // A negative interior weight needs one interior edge: two triangles, four vertices. A triangle with an obtuse angle is
        // one face. A failing MAX-local needs an interior vertex, and not one inside a triangle: there the two angles opposite an
        // inner edge are less than those of the triangle, and every weight is positive. So it takes five vertices, four faces.
        let mesh = make("random-delaunay:n=200,seed=3 | flip:count=40,seed=3");
        assert_eq!(mesh.vertex_count(), 200);
        for (property, vertices, faces) in [("POS0", 4, 2), ("POS-boundary", 3, 1), ("MAX-local", 5, 4)] {
            let small = shrink(&mesh, 4000, &fails("cotan", property));
            let facts = small.domain.facts();
            assert_eq!((facts.vertices, facts.faces), (vertices, faces), "{property} after {} calls", small.calls);
            let whole = small.domain.positions().unwrap().iter().flatten().all(|x| x.fract() == 0.0 && x.abs() <= 8.0);
            assert!(whole, "{property}: {:?}", small.domain.positions());
            assert!(fails("cotan", property)(&small.domain));
        }
    }

    #[test]
    fn a_mark_that_is_planted_by_hand_is_found_again_whatever_surrounds_it() {
        // The predicate knows nothing of geometry: two faces with a common edge, one of whose ends has z = 1.
        let grid = make("grid:nx=9,ny=9");
        let surface = grid.as_surface().unwrap();
        let mut positions = surface.positions().to_vec();
        positions[44][2] = 1.0;
        let tent = Domain::from(Surface::new(positions, surface.faces().to_vec()).unwrap());
        let marked = |domain: &Domain| {
            let s = domain.as_surface().unwrap();
            let top = |v: &usize| s.positions()[*v][2] == 1.0;
            (0..s.topology().edges().len())
                .any(|e| s.topology().sides(e).len() == 2 && s.topology().edges()[e].iter().any(top))
        };
        let small = shrink(&tent, 4000, &marked).domain;
        assert_eq!((small.vertex_count(), small.facts().faces), (4, 2));
    }

    #[test]
    fn a_predicate_that_is_never_true_leaves_the_domain_alone_and_is_asked_once() {
        let mesh = make("random-delaunay:n=50,seed=1");
        let asked = Cell::new(0);
        let never = |_: &Domain| {
            asked.set(asked.get() + 1);
            false
        };
        let same = shrink(&mesh, 100, &never);
        assert_eq!((same.domain.digest(), same.calls, asked.get()), (mesh.digest(), 1, 1));
    }

    #[test]
    fn the_predicate_is_asked_no_more_often_than_stated_and_the_result_is_the_same_every_time() {
        let mesh = make("random-delaunay:n=60,seed=2 | flip:count=20,seed=2");
        for most in [0, 1, 7, 50] {
            let asked = Cell::new(0);
            let fails = fails("cotan", "POS");
            let counted = |domain: &Domain| {
                asked.set(asked.get() + 1);
                fails(domain)
            };
            let small = shrink(&mesh, most, &counted);
            assert!(asked.get() <= most && small.calls == asked.get(), "{} of {most}", asked.get());
            assert_eq!(small.domain.digest(), shrink(&mesh, most, &fails).domain.digest());
        }
    }

    #[test]
    fn every_domain_that_the_predicate_sees_is_as_regular_as_the_first() {
        let mesh = make("random-delaunay:n=40,seed=5 | flip:count=30,seed=5");
        let seen = Cell::new(0);
        let fails = fails("mean-value", "SYM");
        let watched = |domain: &Domain| {
            let facts = domain.facts();
            let s = facts.surface.unwrap();
            assert!(s.manifold && s.planar && s.degenerate_faces == 0 && s.duplicate_faces == 0);
            assert_eq!((facts.components, facts.isolated_vertices), (1, 0));
            seen.set(seen.get() + 1);
            fails(domain)
        };
        let small = shrink(&mesh, 2000, &watched).domain;
        assert!(seen.get() > 10 && small.vertex_count() == 3);
        // On closed surfaces a face cannot be left out without a hole; what is left is a patch.
        let closed = shrink(&make("icosphere:levels=1 | flip:count=30"), 2000, &super::tests::fails("cotan", "POS0"));
        assert_eq!(closed.domain.vertex_count(), 4);
    }
}
