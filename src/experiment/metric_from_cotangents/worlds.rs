//! Random surfaces, closed and with boundary, and surfaces of several parts.

use std::collections::BTreeMap;

use crate::domain::{Domain, Surface, geometry};
use crate::generate::{self, Stream};

/// A surface and the recipe that makes it.
pub struct Specimen {
    /// The recipe, as the command line takes it.
    pub recipe: String,
    /// The surface.
    pub surface: Surface,
}

type Step<'a> = (&'a str, Vec<(&'a str, String)>);

/// The smallest angle of a random surface, in degrees. The cotangents of an angle α determine its triangle up to a relative
/// error of `u/α²` (u the unit roundoff): with thinner triangles 1e-10 would be a question of luck.
pub const SMALLEST_ANGLE_DEG: f64 = 0.5;

/// What the generators make of these steps; `None` where one refuses, or where an angle is too small.
fn make(steps: &[Step], seed: u64) -> Option<Specimen> {
    let (mut domain, mut recipe): (Option<Domain>, Vec<String>) = (None, Vec::new());
    for (id, settings) in steps {
        let given: BTreeMap<String, String> = settings.iter().map(|(k, v)| (k.to_string(), v.clone())).collect();
        domain = Some(generate::find(id)?.run(domain.as_ref(), &given, seed).ok()?);
        let settings = settings.iter().map(|(k, v)| format!("{k}={v}")).chain([format!("seed={seed}")]);
        recipe.push(format!("{id}:{}", settings.collect::<Vec<_>>().join(",")));
    }
    let surface = domain?.as_surface()?.clone();
    (smallest_angle_deg(&surface)? >= SMALLEST_ANGLE_DEG).then(|| Specimen { recipe: recipe.join(" | "), surface })
}

fn smallest_angle_deg(surface: &Surface) -> Option<f64> {
    let corner = |face: usize, k: usize| {
        let [a, b, c] = [0, 1, 2].map(|j| surface.faces()[face][(k + j) % 3]);
        geometry::angle(surface.point(a), surface.point(b), surface.point(c)).to_degrees()
    };
    let corners = (0..surface.faces().len()).flat_map(|face| (0..3).map(move |k| (face, k)));
    corners.map(|(face, k)| corner(face, k)).reduce(f64::min)
}

/// Draws until a surface is made.
fn until(mut draw: impl FnMut() -> Option<Specimen>) -> Specimen {
    loop {
        if let Some(specimen) = draw() {
            return specimen;
        }
    }
}

/// A random closed surface of genus `case % 3`, shaken, and every other time flipped as well.
pub fn closed(case: usize, stream: &mut Stream) -> Specimen {
    until(|| draw_closed(case, stream))
}

fn draw_closed(case: usize, stream: &mut Stream) -> Option<Specimen> {
    let seed = stream.below(1 << 20) as u64;
    let text = |x: usize| x.to_string();
    let source = match case % 3 {
        0 => ("icosphere", vec![("levels", text(1 + stream.below(2)))]),
        1 => ("torus", vec![("levels", text(0)), ("minor", stream.between(0.2, 0.5).to_string())]),
        _ => ("genus", vec![("genus", text(2)), ("levels", text(0)), ("smoothing", text(stream.below(3)))]),
    };
    let shaken = ("perturb", vec![("amount", stream.between(0.02, 0.25).to_string())]);
    let flipped = ("flip", vec![("count", text(1 + stream.below(12)))]);
    let steps = if (case / 3).is_multiple_of(2) { vec![source, shaken] } else { vec![source, shaken, flipped] };
    make(&steps, seed)
}

/// A random surface with boundary: a disc in the plane, flipped every other time; a square with a wavy boundary; a cylinder.
pub fn bounded(case: usize, stream: &mut Stream) -> Specimen {
    until(|| draw_bounded(case, stream))
}

fn draw_bounded(case: usize, stream: &mut Stream) -> Option<Specimen> {
    let seed = stream.below(1 << 20) as u64;
    let text = |x: usize| x.to_string();
    let points = text(15 + stream.below(40));
    let free = |amount: f64| ("perturb", vec![("amount", amount.to_string()), ("boundary", "free".to_string())]);
    let steps = match case % 4 {
        0 => vec![("random-delaunay-disk", vec![("n", points), ("m", text(9))])],
        1 => vec![("random-delaunay-disk", vec![("n", points), ("m", text(9))]), ("flip", vec![("count", text(4))])],
        2 => vec![("grid", vec![("nx", text(6)), ("ny", text(5))]), free(stream.between(0.02, 0.3))],
        _ => vec![("lantern", vec![("m", text(3)), ("n", text(8))]), free(stream.between(0.02, 0.2))],
    };
    make(&steps, seed)
}

/// Two surfaces as one: apart, or with the first vertex of the second one on the first vertex of the first.
pub fn united(a: &Surface, b: &Surface, touching: bool) -> Option<Surface> {
    let n = a.positions().len();
    let step: [f64; 3] = match touching {
        true => std::array::from_fn(|k| a.positions()[0][k] - b.positions()[0][k]),
        false => [64.0, 0.0, 0.0],
    };
    let place = |v: usize| match (touching, v) {
        (true, 0) => 0,
        (true, v) => n + v - 1,
        (false, v) => n + v,
    };
    let moved = b.positions().iter().map(|p| std::array::from_fn(|k| p[k] + step[k])).skip(usize::from(touching));
    let positions: Vec<[f64; 3]> = a.positions().iter().copied().chain(moved).collect();
    let own = a.faces().iter().map(<[usize]>::to_vec);
    let other = b.faces().iter().map(|f| f.iter().map(|&v| place(v)).collect());
    Surface::new(positions, own.chain(other).collect()).ok()
}

/// Small surfaces with whole coordinates and the number of their parts: tetrahedra, octahedra, discs, and pairs of them, apart
/// or touching in a vertex.
pub fn whole(stream: &mut Stream) -> Vec<(String, Surface, usize)> {
    let tetrahedron: &[[usize; 3]] = &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let octahedron: &[[usize; 3]] =
        &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1], [5, 2, 1], [5, 3, 2], [5, 4, 3], [5, 1, 4]];
    let fan: &[[usize; 3]] = &[[0, 1, 2], [0, 2, 3], [0, 3, 4]];
    let mut made: Vec<(String, Surface)> = Vec::new();
    for (name, faces) in [("a tetrahedron", tetrahedron), ("an octahedron", octahedron), ("a fan", fan)] {
        let count = faces.iter().flatten().max().map_or(0, |last| last + 1);
        let surface = loop {
            let points =
                (0..count).map(|_| std::array::from_fn(|_| stream.below(13) as f64)).collect::<Vec<[f64; 3]>>();
            let straight = faces.iter().any(|f| geometry::collinear(points[f[0]], points[f[1]], points[f[2]]));
            if let (false, Ok(surface)) = (straight, Surface::triangles(points, faces)) {
                break surface;
            }
        };
        made.push((name.to_string(), surface));
    }
    let mut all: Vec<(String, Surface, usize)> = made.iter().map(|(n, s)| (n.clone(), s.clone(), 1)).collect();
    for (i, (a, s)) in made.iter().enumerate() {
        for (b, t) in &made[i..] {
            for (touching, how) in [(false, "apart"), (true, "touching in a vertex")] {
                all.extend(united(s, t, touching).map(|u| (format!("{a} and {b}, {how}"), u, 2)));
            }
        }
    }
    all
}
