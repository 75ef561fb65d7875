//! A small domain of every class: what an operator meets in practice, and what it should never meet.

use std::path::Path;

use lapjury::domain::{Domain, Graph, PointCloud, Surface, Volume};
use lapjury::suite::Recipe;

/// A domain with its name.
pub struct Place {
    pub name: String,
    pub domain: Domain,
}

fn place(name: &str, domain: impl Into<Domain>) -> Place {
    Place { name: name.into(), domain: domain.into() }
}

/// Surfaces and graphs that a generator makes.
pub const GENERATED: &[&str] = &[
    "polyhedron:shape=tetrahedron",
    "polyhedron:shape=cube",
    "icosphere:levels=1",
    "flat-torus:levels=0",
    "torus:levels=0 | flip:count=9,seed=3",
    "genus:genus=1",
    "grid:nx=3,ny=3,diagonals=alternating",
    "perturbed-grid:nx=3,ny=4,displacement=0.4,seed=2",
    "random-delaunay:n=14,seed=4",
    "random-delaunay:n=14,seed=4 | flip:count=12,seed=1",
    "random-delaunay:n=10,seed=6 | worst-angle",
    "random-delaunay:n=9,seed=8 | flip:count=9,seed=1 | scale:factor=1e-12 | translate:x=100,y=-3",
    "convex-polygon:n=7,seed=1",
    "disk:levels=1",
    "schonhardt:nested=2",
    "lantern:m=4,n=5",
    "listed",
    "tet-grid:nx=2,ny=2,nz=2,displacement=0.16,seed=1",
    "slivers:shape=needle,aspect=1e6,columns=3,rows=3",
    "slivers:shape=cap,aspect=1e8,columns=3,rows=3",
    "fan:k=3",
    "fan:k=4,kind=half-disks",
    "path:n=6,boundary=2",
    "cycle:n=7",
    "star:leaves=4,boundary=1",
    "complete:n=5,boundary=2",
    "hypercube:d=3",
    "gnp:n=9,p=0.2,boundary=2,seed=5",
    "gnp:n=9,p=0.5,boundary=2,seed=5 | random-weights:seed=1",
    "gnp:n=9,p=0.5,boundary=2,seed=6 | random-weights:negative=0.4,seed=2",
    "planar-graph:n=9,seed=1 | random-weights:negative=0.1,seed=3",
];

fn generated() -> impl Iterator<Item = Place> {
    GENERATED.iter().map(|recipe| place(recipe, recipe.parse::<Recipe>().unwrap().build(Path::new(".")).unwrap()))
}

fn flat(points: &[[f64; 2]], faces: &[[usize; 3]]) -> Surface {
    Surface::planar(points, faces).unwrap()
}

fn in_space(points: &[[f64; 3]], faces: &[&[usize]]) -> Surface {
    Surface::new(points.to_vec(), faces.iter().map(|f| f.to_vec()).collect()).unwrap()
}

/// A square of side 2 joined to its centre, vertex 4.
const WINDMILL: [[f64; 2]; 5] = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0]];
const SAILS: [[usize; 3]; 4] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];

/// Surfaces with too little of everything.
fn meagre() -> Vec<Place> {
    vec![
        place("a surface without vertices", flat(&[], &[])),
        place("a surface of one vertex", flat(&[[1.0, 2.0]], &[])),
        place("a surface without faces", flat(&WINDMILL, &[])),
        place("a single triangle", flat(&[[0.0, 0.0], [1.0, 0.0], [0.3, 0.8]], &[[0, 1, 2]])),
        place("a triangle and an isolated vertex", {
            flat(&[[0.0, 0.0], [1.0, 0.0], [5.0, 5.0], [0.3, 0.8]], &[[0, 1, 3]])
        }),
        place("a windmill between isolated vertices", {
            let mut points = vec![[9.0, 9.0]];
            points.extend(WINDMILL);
            points.push([8.0, 8.0]);
            flat(&points, &SAILS.map(|f| f.map(|v| v + 1)))
        }),
    ]
}

/// Sound surfaces that few tests think of.
fn unusual() -> Vec<Place> {
    let scaled = |s: f64| flat(&WINDMILL.map(|p| p.map(|x| x * s)), &SAILS);
    let two = |gap: f64| {
        let shifted = WINDMILL.map(|p| [p[0] + gap, p[1]]);
        let faces: Vec<[usize; 3]> = SAILS.iter().copied().chain(SAILS.map(|f| f.map(|v| v + 5))).collect();
        flat(&[WINDMILL, shifted].concat(), &faces)
    };
    let tetrahedra = {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let points = [corners, corners.map(|p| p.map(|x| 3.0 - x))].concat();
        let faces: [&[usize]; 8] =
            [&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2], &[4, 5, 6], &[4, 7, 5], &[5, 7, 6], &[4, 6, 7]];
        in_space(&points, &faces)
    };
    vec![
        place("a windmill of side 2e140", scaled(1e140)),
        place("a windmill of side 2e-120", scaled(1e-120)),
        place("two windmills", two(5.0)),
        place("two tetrahedra", tetrahedra),
        place("a pillow of two triangles", {
            in_space(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[&[0, 1, 2], &[0, 2, 1]])
        }),
        place("a roof with an isolated edge of right angles", {
            let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            in_space(&points, &[&[0, 1, 2], &[1, 0, 3]])
        }),
        place("a quadrangle beside a pentagon", {
            let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, -0.5], [3.0, 0.5], [2.0, 1.5]];
            in_space(&points.map(|p| [p[0], p[1], 0.0]), &[&[0, 1, 2, 3], &[1, 4, 5, 6, 2]])
        }),
    ]
}

/// Surfaces that are no good: degenerate, folded, not manifold, not orientable.
fn unsound() -> Vec<Place> {
    let moebius = {
        let turn = |k: usize| std::f64::consts::TAU * k as f64 / 5.0;
        let at = |k: usize, side: f64| {
            let (t, w) = (turn(k), 0.3 * side);
            let r = 1.0 + w * (t / 2.0).cos();
            [r * t.cos(), r * t.sin(), w * (t / 2.0).sin()]
        };
        let points: Vec<[f64; 3]> = (0..5).flat_map(|k| [at(k, -1.0), at(k, 1.0)]).collect();
        let next = |k: usize| if k < 4 { [2 * k + 2, 2 * k + 3] } else { [1, 0] };
        let cell = |k: usize| [[2 * k, next(k)[0], 2 * k + 1], [2 * k + 1, next(k)[0], next(k)[1]]];
        Surface::triangles(points, &(0..5).flat_map(cell).collect::<Vec<_>>()).unwrap()
    };
    vec![
        place("a Möbius strip", moebius),
        place("two triangles that share a vertex", {
            flat(&[[0.0, 0.0], [1.0, 0.2], [1.0, 1.0], [-1.0, 0.1], [-1.0, -1.0]], &[[0, 1, 2], [0, 3, 4]])
        }),
        place("a face given twice", {
            flat(&[[0.0, 0.0], [1.0, 0.0], [0.2, 1.0], [1.0, 1.0]], &[[0, 1, 2], [1, 3, 2], [0, 1, 2]])
        }),
        place("a triangle folded back over its neighbour", {
            flat(&[[0.0, 0.0], [1.0, 0.0], [0.3, 1.0], [0.6, 0.7]], &[[0, 1, 2], [1, 0, 3]])
        }),
        place("a triangle of collinear corners", {
            flat(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0]], &[[0, 1, 3], [1, 2, 3], [0, 2, 1]])
        }),
        place("an edge of length zero", {
            flat(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]], &[[0, 1, 2], [0, 2, 3], [0, 3, 1]])
        }),
        place("a windmill crushed to a point", flat(&[[1.0, 1.0]; 5], &SAILS)),
        place("a sliver of height 1e-300", {
            flat(&[[0.0, 0.0], [1.0, 0.0], [0.5, 1e-300], [0.5, -1.0]], &[[0, 1, 2], [1, 0, 3]])
        }),
        place("a sliver of height 1e-17 inside a windmill", {
            let mut points = WINDMILL;
            points[4] = [1.0, 1e-17];
            flat(&points, &SAILS)
        }),
    ]
}

/// Graphs at the ends of their range.
fn graphs() -> Vec<Place> {
    let graph = |n: usize, edges: &[[usize; 2]]| Graph::new(n, edges).unwrap();
    let weighted = |weights: &[f64]| Graph::weighted(4, &[[0, 1], [1, 2], [2, 3], [0, 3]], weights).unwrap();
    vec![
        place("a graph without vertices", graph(0, &[])),
        place("a graph of one vertex", graph(1, &[])),
        place("a graph without edges", graph(3, &[])),
        place("a graph that is all boundary", graph(3, &[[0, 1], [1, 2]]).with_boundary(&[0, 1, 2]).unwrap()),
        place("two triangles and an isolated vertex", graph(7, &[[0, 1], [1, 2], [0, 2], [3, 4], [4, 5], [3, 5]])),
        place("a cycle of weight zero", weighted(&[0.0; 4])),
        place("a cycle with one zero weight", weighted(&[1.0, 1.0, 0.0, 1.0])),
        place("a cycle of negative weights", weighted(&[-1.0, -2.0, -1.0, -0.5])),
        // Three resistors of 1 in series with one of −3: one more function of no energy.
        place("a cycle at its critical weight", weighted(&[1.0, 1.0, 1.0, -1.0 / 3.0])),
        place("a cycle of weights near the ends of f64", weighted(&[1e300, 1e-300, 1.0, 1e150])),
    ]
}

fn volumes() -> Vec<Place> {
    let corners =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.2, 0.2, 0.2]];
    let volume = |n: usize, t: &[[usize; 4]]| Volume::new(corners[..n].to_vec(), t.to_vec()).unwrap();
    vec![
        place("a volume without vertices", volume(0, &[])),
        place("a volume without tetrahedra", volume(3, &[])),
        place("a tetrahedron", volume(4, &[[0, 1, 2, 3]])),
        place("two tetrahedra over a triangle", volume(5, &[[0, 1, 2, 3], [1, 2, 3, 4]])),
        // Vertex 5 is inside the first tetrahedron; vertex 4 is isolated.
        place("a tetrahedron about a vertex", volume(6, &[[0, 1, 2, 5], [0, 1, 5, 3], [0, 5, 2, 3], [5, 1, 2, 3]])),
    ]
}

/// Point clouds, of every dimension.
pub fn clouds() -> Vec<Place> {
    let cloud = |points: &[[f64; 3]]| PointCloud::new(points.to_vec(), None).unwrap();
    let turn = |k: usize, n: usize| (std::f64::consts::TAU * k as f64 / n as f64).sin_cos();
    let circle: Vec<[f64; 3]> = (0..30).map(|k| turn(k, 30)).map(|(s, c)| [c, s, 0.5 * s]).collect();
    let ring = |k: usize| [turn(k % 12, 12), turn(k / 12, 24)];
    let torus: Vec<[f64; 3]> =
        (0..288).map(ring).map(|[(s, c), (sin, cos)]| [(3.0 + c) * cos, (3.0 + c) * sin, s]).collect();
    vec![
        place("no points", cloud(&[])),
        place("two points", cloud(&[[0.0; 3], [1.0; 3]])),
        place("three points", cloud(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])),
        place("a point given twice", cloud(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])),
        place(
            "the corners of a cube",
            cloud(&[0, 1, 2, 3, 4, 5, 6, 7].map(|k| [0, 1, 2].map(|b| f64::from(k >> b & 1)))),
        ),
        place("an ellipse of points", cloud(&circle)),
        place("a torus of points", cloud(&torus)),
    ]
}

/// Every domain.
pub fn all() -> Vec<Place> {
    let lists = [meagre(), unusual(), unsound(), graphs(), volumes(), clouds()];
    generated().chain(lists.into_iter().flatten()).collect()
}
