//! Domains for the campaign: case k of a seed is the same recipe for ever.
//!
//! The classes take turns. Sizes are small, since a false alarm on a large mesh is one on a small part of it; every
//! [`LARGE_EVERY`]-th case has a hundred thousand vertices.

use crate::stream::Stream;

/// One case in so many is large.
pub const LARGE_EVERY: usize = 25_000;

/// A case: the class of a domain, and its recipe.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Draw {
    /// The class.
    pub class: &'static str,
    /// The recipe.
    pub recipe: String,
}

/// A class with what writes its recipes.
type Family = (&'static str, fn(&mut Stream) -> String);

/// The classes, in turn.
const CLASSES: [Family; 15] = [
    ("planar", planar),
    ("planar-delaunay", delaunay),
    ("planar-flipped", |s| format!("{} | flip:count={},seed={}", delaunay(s), 1 + s.below(9), s.below(1000))),
    ("worst-angle", |s| format!("{} | worst-angle", delaunay(s))),
    ("needles", |s| slivers("needle", s)),
    ("caps", |s| slivers("cap", s)),
    ("irregular-slivers", |s| {
        let shape = if s.below(2) == 0 { "needle" } else { "cap" };
        format!(
            "{} | perturb:amount={:.3},boundary=free,seed={}",
            slivers(shape, s),
            s.between(0.01, 0.4),
            s.below(100_000)
        )
    }),
    ("closed", closed),
    ("closed-flipped", |s| format!("{} | flip:count={},seed={}", closed(s), 1 + s.below(6), s.below(1000))),
    ("curved-with-boundary", curved),
    ("scaled", |s| {
        let factor = ["1e-12", "1e-6", "1e6", "1e12"][s.below(4)];
        format!("{} | scale:factor={factor}", any(s))
    }),
    ("translated", |s| {
        // Coordinates of a diameter near one, a million diameters away: 33 bits of the shape are left.
        let shift = |s: &mut Stream| [-1e6, -7e5, 3e5, 1e6][s.below(4)];
        format!("{} | translate:x={},y={}", any(s), shift(s), shift(s))
    }),
    ("high-valence", |s| {
        // From 3 to 500, small ones as often as large ones.
        let n = (3.0 * (500.0_f64 / 3.0).powf(s.unit())) as usize;
        let n = if s.below(8) == 0 { 500 } else { n };
        if s.below(2) == 0 { format!("wheel:n={n}") } else { format!("wheel:n={n},height={:.3}", s.between(0.05, 2.0)) }
    }),
    ("not-manifold", |s| match s.below(2) {
        0 => format!("fan:k={}", 3 + s.below(5)),
        _ => format!("fan:k={},kind=half-disks,sides={}", 2 + s.below(4), 2 + s.below(5)),
    }),
    ("graph", graph),
];

/// The case of this number.
pub fn draw(seed: u64, case: usize) -> Draw {
    let mut stream = Stream::new(seed, &format!("campaign/{case}"));
    if case % LARGE_EVERY == LARGE_EVERY - 1 {
        let recipe = match stream.below(2) {
            0 => format!("perturbed-grid:nx=316,ny=316,displacement=0.3,seed={}", stream.below(1000)),
            _ => format!("random-delaunay:n=100000,seed={}", stream.below(1000)),
        };
        return Draw { class: "large", recipe };
    }
    let (class, recipe) = CLASSES[case % CLASSES.len()];
    Draw { class, recipe: recipe(&mut stream) }
}

/// How many classes take turns.
pub fn classes() -> usize {
    CLASSES.len()
}

fn planar(s: &mut Stream) -> String {
    let diagonals = ["right", "left", "alternating", "random"][s.below(4)];
    let (nx, ny, seed) = (1 + s.below(4), 1 + s.below(4), s.below(100_000));
    match s.below(4) {
        0 => format!("grid:nx={nx},ny={ny},diagonals={diagonals},seed={seed}"),
        _ => {
            let displacement = s.between(0.02, 0.45);
            format!("perturbed-grid:nx={nx},ny={ny},diagonals={diagonals},displacement={displacement:.3},seed={seed}")
        }
    }
}

fn delaunay(s: &mut Stream) -> String {
    match s.below(3) {
        0 => format!("convex-polygon:n={},seed={}", 3 + s.below(9), s.below(100_000)),
        _ => format!("random-delaunay:n={},seed={}", 4 + s.below(14), s.below(100_000)),
    }
}

fn slivers(shape: &str, s: &mut Stream) -> String {
    let aspect = 10f64.powf(s.between(0.0, 8.0));
    format!("slivers:shape={shape},aspect={aspect:.3e},columns={},rows={}", 2 + s.below(2), 2 + s.below(3))
}

fn closed(s: &mut Stream) -> String {
    let seed = s.below(100_000);
    let source = match s.below(6) {
        0 => "polyhedron:shape=tetrahedron",
        1 => "polyhedron:shape=octahedron",
        2 => "polyhedron:shape=cube",
        3 => "polyhedron:shape=icosahedron",
        4 => "torus:levels=0",
        _ => "genus:genus=1,levels=0",
    };
    format!("{source} | perturb:amount={:.3},seed={seed}", s.between(0.0, 0.4))
}

fn curved(s: &mut Stream) -> String {
    let seed = s.below(100_000);
    match s.below(4) {
        0 => format!("lantern:m={},n={}", 1 + s.below(5), 3 + s.below(5)),
        1 => format!("schonhardt:nested={},twist={:.3} | rotate:seed={seed}", 1 + s.below(2), s.between(-0.5, 0.2)),
        2 => format!("{} | rotate:seed={seed}", planar(s)),
        _ => format!("disk:levels=1 | perturb:amount={:.3},seed={seed} | rotate:seed={seed}", s.between(0.0, 0.4)),
    }
}

fn any(s: &mut Stream) -> String {
    match s.below(5) {
        0 => planar(s),
        1 => delaunay(s),
        2 => slivers("cap", s),
        3 => closed(s),
        _ => curved(s),
    }
}

fn graph(s: &mut Stream) -> String {
    let seed = s.below(100_000);
    match s.below(8) {
        0 => format!("path:n={}", 1 + s.below(9)),
        1 => format!("cycle:n={}", 3 + s.below(9)),
        2 => format!("star:leaves={},boundary=1", 1 + s.below(9)),
        3 => format!("complete:n={},boundary=1", 2 + s.below(7)),
        4 => format!("hypercube:d={}", 1 + s.below(3)),
        5 => format!("planar-graph:n={},seed={seed}", 4 + s.below(9)),
        6 => format!("gnp:n={},p=0.4,boundary=2,seed={seed} | random-weights:seed={seed}", 4 + s.below(9)),
        _ => format!("gnp:n={},p=0.4,boundary=2,seed={seed}", 4 + s.below(9)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_of_a_seed_is_the_same_recipe_for_ever_and_every_recipe_reads() {
        for case in 0..600 {
            let d = draw(1, case);
            assert_eq!(d, draw(1, case));
            assert!(d.recipe.parse::<crate::suite::Recipe>().is_ok(), "{}", d.recipe);
        }
        assert_eq!(draw(1, LARGE_EVERY - 1).class, "large");
    }
}
