//! Forged drawings: in equilibrium, with a fault, and every hypothesis as stated but for one thing.

use lapjury::linalg::Dense;
use lapjury::property::evidence::{Fault, Fraction, Hypothesis, Row};
use lapjury::property::{Evidence, Excerpt, Statement};
use lapjury::scalar::Rational;

use crate::{accepted, refused_for};

type Point = [Rational; 2];

fn whole(x: i64) -> Rational {
    Rational::from(x)
}

/// In lowest terms.
fn written(x: &Rational) -> String {
    Fraction::from(x).to_string()
}

fn area(p: [&Point; 3]) -> Rational {
    let side = |k: usize, axis: usize| p[k][axis].clone() - p[0][axis].clone();
    side(1, 0) * side(2, 1) - side(1, 1) * side(2, 0)
}

/// A drawing to be: the polygon has the first vertices, those inside follow.
#[derive(Clone)]
struct Drawing {
    polygon: Vec<[i64; 2]>,
    boundary: Vec<usize>,
    /// Vertices that are put where they are in equilibrium.
    inside: usize,
    /// Further ones, put at the origin.
    afloat: usize,
    faces: Vec<[usize; 3]>,
    weights: Vec<([usize; 2], i64)>,
    /// All coordinates are multiplied by this.
    scale: Rational,
}

fn ordered(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

fn sides(faces: &[[usize; 3]]) -> impl Iterator<Item = [usize; 2]> + '_ {
    faces.iter().flat_map(|f| [ordered(f[0], f[1]), ordered(f[1], f[2]), ordered(f[2], f[0])])
}

/// A polygon with its faces, and the weight 1 on every edge that has an end inside.
fn drawing(polygon: &[[i64; 2]], inside: usize, faces: &[[usize; 3]]) -> Drawing {
    let rim = polygon.len();
    let mut edges: Vec<[usize; 2]> = sides(faces).filter(|e| e[1] >= rim).collect();
    edges.sort_unstable();
    edges.dedup();
    Drawing {
        polygon: polygon.to_vec(),
        boundary: (0..rim).collect(),
        inside,
        afloat: 0,
        faces: faces.to_vec(),
        weights: edges.into_iter().map(|e| (e, 1)).collect(),
        scale: whole(1),
    }
}

impl Drawing {
    fn weigh(mut self, edge: [usize; 2], weight: i64) -> Self {
        self.weights.iter_mut().find(|w| w.0 == edge).unwrap().1 = weight;
        self
    }

    /// The equilibrium.
    fn at(&self) -> Vec<Point> {
        let rim = self.polygon.len();
        let mut at: Vec<Point> = self.polygon.iter().map(|p| p.map(whole)).collect();
        let mut l = Dense::from_fn(self.inside, self.inside, |_, _| whole(0));
        let mut right = Dense::from_fn(self.inside, 2, |_, _| whole(0));
        let free = |v: usize| (rim..rim + self.inside).contains(&v).then(|| v - rim);
        for &([a, b], weight) in &self.weights {
            for (i, j) in [(a, b), (b, a)] {
                let Some(row) = free(i) else { continue };
                l.add_to(row, row, whole(weight));
                match free(j) {
                    Some(column) => l.add_to(row, column, whole(-weight)),
                    None => (0..2).for_each(|k| right.add_to(row, k, whole(weight * self.polygon[j][k]))),
                }
            }
        }
        let solution = l.solve(&right).unwrap();
        at.extend((0..self.inside).map(|i| [0, 1].map(|k| solution.at(i, k).clone())));
        at.resize(rim + self.inside + self.afloat, [whole(0), whole(0)]);
        at.into_iter().map(|p| p.map(|x| x * self.scale.clone())).collect()
    }

    fn evidence(&self, missing: Hypothesis, fault: Fault) -> Evidence {
        let (at, m) = (self.at(), self.boundary.len());
        let rim = (0..m).map(|k| ordered(self.boundary[k], self.boundary[(k + 1) % m]));
        let mut edges: Vec<[usize; 2]> =
            rim.chain(sides(&self.faces)).chain(self.weights.iter().map(|w| w.0)).collect();
        edges.sort_unstable();
        edges.dedup();
        let term = |(k, &[a, b]): (usize, &[usize; 2])| {
            let square = |axis: usize| {
                let x = at[a][axis].clone() - at[b][axis].clone();
                x.clone() * x
            };
            let weight = self.weights.iter().find(|w| w.0 == [a, b]).map_or(0, |w| w.1);
            whole(k as i64 + 1) * (square(0) + square(1) + whole(weight))
        };
        let checksum = edges.iter().enumerate().map(term).fold(whole(0), |sum, t| sum + t);
        let statement = Statement::NotEmbedded {
            boundary: self.boundary.clone(),
            weights: self.weights.iter().map(|&([a, b], w)| (a, b, w as f64)).collect(),
            drawing: at.iter().map(|p| [written(&p[0]), written(&p[1])]).collect(),
            checksum: written(&checksum),
            missing,
            fault,
        };
        let faces = self.faces.iter().map(|f| f.to_vec()).enumerate().collect();
        Evidence::new(statement, Excerpt { faces, ..Excerpt::default() })
    }

    /// A witness that a face is not counter-clockwise, the first that is not.
    fn folded(&self, missing: Hypothesis) -> Evidence {
        let at = self.at();
        let face = self.faces.iter().position(|f| area(f.map(|v| &at[v]).map(|p| p)) <= whole(0)).unwrap();
        self.evidence(missing, Fault::Face { face })
    }

    /// A witness that the faces overlap.
    fn overlapping(&self, missing: Hypothesis) -> Evidence {
        let at = self.at();
        let magnitude = |x: Rational| if x < whole(0) { -x } else { x };
        let sum = |triangles: Vec<[usize; 3]>| {
            triangles.iter().map(|f| magnitude(area(f.map(|v| &at[v])))).fold(whole(0), |sum, a| sum + a)
        };
        // The polygons here are seen whole from their first corner.
        let polygon = sum((1..self.polygon.len() - 1).map(|k| [0, k, k + 1]).collect());
        let faces = sum(self.faces.clone());
        assert!(faces > polygon);
        self.evidence(missing, Fault::Overlap { faces: written(&faces), polygon: written(&polygon) })
    }
}

/// A polygon with a reflex corner: the mean of its corners lies beyond it.
const DART: [[i64; 2]; 4] = [[0, 3], [-3, -3], [0, 0], [3, -3]];
const FAN: [[usize; 3]; 4] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
const SQUARE: [[i64; 2]; 4] = [[0, 0], [2, 0], [2, 2], [0, 2]];
const TRIANGLE: [[i64; 2]; 3] = [[0, 0], [3, 0], [0, 3]];

fn dart() -> Drawing {
    drawing(&DART, 1, &FAN)
}

/// A triangle with a vertex that hangs on one of its corners.
fn pendant() -> Drawing {
    Drawing { weights: vec![([0, 3], 1)], ..drawing(&TRIANGLE, 1, &[]) }
}

#[test]
fn what_is_forged_here_is_right_but_for_one_thing() {
    accepted(&dart().folded(Hypothesis::ConvexBoundary));
    accepted(&drawing(&SQUARE, 1, &FAN).weigh([0, 4], -2).folded(Hypothesis::PositiveWeights));
    accepted(&pendant().evidence(Hypothesis::ThreeConnected, Fault::Edge { a: 0, b: 3 }));
    accepted(&cut_off_straight_corner(1).folded(Hypothesis::NoChordOnASide));
}

/// A square with a fifth corner in the middle of its lowest side, cut off by a chord; with or without a vertex inside.
fn cut_off_straight_corner(inside: usize) -> Drawing {
    let polygon = [[0, 0], [1, 0], [2, 0], [2, 2], [0, 2]];
    match inside {
        0 => drawing(&polygon, 0, &[[0, 1, 2], [0, 2, 3], [0, 3, 4]]),
        _ => drawing(&polygon, 1, &[[0, 1, 2], [0, 2, 5], [2, 3, 5], [3, 4, 5], [4, 0, 5]]),
    }
}

#[test]
fn more_than_faces_is_not_carried_along_with_a_drawing() {
    let evidence = dart().folded(Hypothesis::ConvexBoundary);
    let row = vec![Row { row: 0, entries: Vec::new() }];
    for more in [
        Excerpt { rows: row.clone(), ..Excerpt::default() },
        Excerpt { mass_rows: row, ..Excerpt::default() },
        Excerpt { positions: vec![(0, [0.0; 3])], ..Excerpt::default() },
        Excerpt { edges: vec![[0, 1]], ..Excerpt::default() },
    ] {
        let excerpt = Excerpt { faces: evidence.excerpt.faces.clone(), ..more };
        refused_for(&Evidence { excerpt, ..evidence.clone() }, "the excerpt carries faces only");
    }
}

#[test]
fn a_boundary_that_is_no_simple_polygon_around_its_area_is_refused() {
    let none =
        Drawing { polygon: Vec::new(), boundary: Vec::new(), inside: 0, afloat: 1, ..drawing(&TRIANGLE, 0, &[]) };
    refused_for(&none.evidence(Hypothesis::PositiveWeights, Fault::Face { face: 0 }), "the boundary is a cycle");
    let simple = "the boundary is a simple polygon";
    let twice = Drawing { boundary: vec![0, 1, 2, 0], ..pendant() };
    refused_for(&twice.evidence(Hypothesis::ThreeConnected, Fault::Edge { a: 0, b: 3 }), simple);
    let clockwise: Vec<[i64; 2]> = SQUARE.iter().rev().copied().collect();
    refused_for(&drawing(&clockwise, 1, &FAN).folded(Hypothesis::ConvexBoundary), simple);
    let crossing = [[0, 0], [4, 0], [0, 2], [3, 1]];
    refused_for(&drawing(&crossing, 1, &FAN).folded(Hypothesis::ConvexBoundary), simple);
}

#[test]
fn two_hypotheses_missing_are_one_too_many() {
    let simple = "the boundary is a simple polygon";
    // A reflex corner besides a negative weight or a chord on a side, a polygon turned round besides a hanging vertex.
    refused_for(&dart().weigh([0, 4], -1).folded(Hypothesis::PositiveWeights), simple);
    let turned = Drawing { polygon: vec![[0, 0], [0, 3], [3, 0]], ..pendant() };
    refused_for(&turned.evidence(Hypothesis::ThreeConnected, Fault::Edge { a: 0, b: 3 }), simple);
    let cut = [[0, 1, 5], [1, 2, 5], [2, 3, 5], [3, 0, 5], [3, 4, 0]];
    let polygon = |fifth: [i64; 2]| [[0, 6], [-6, -6], [0, 0], [6, -6], fifth];
    refused_for(&drawing(&polygon([3, 0]), 1, &cut).folded(Hypothesis::NoChordOnASide), simple);
    // A chord besides the reflex corner.
    refused_for(&drawing(&polygon([9, 3]), 1, &cut).folded(Hypothesis::ConvexBoundary), "the chords are those");
    // Weights that are negative besides it, or zero besides a negative one.
    let signs = "the weights have the signs";
    refused_for(&dart().weigh([0, 4], -1).folded(Hypothesis::ConvexBoundary), signs);
    let square = drawing(&SQUARE, 1, &FAN);
    refused_for(&square.weigh([0, 4], -4).weigh([2, 4], 0).folded(Hypothesis::PositiveWeights), signs);
}

#[test]
fn a_drawing_without_a_vertex_inside_is_no_equilibrium() {
    refused_for(&cut_off_straight_corner(0).folded(Hypothesis::NoChordOnASide), "there is a vertex inside");
}

#[test]
fn every_vertex_inside_is_in_equilibrium() {
    // At the reflex corner, and not in the mean of all four.
    let put = Drawing { inside: 0, afloat: 1, ..dart() };
    refused_for(&put.folded(Hypothesis::ConvexBoundary), "the force at vertex 4 vanishes");
}

#[test]
fn a_weight_stands_on_an_edge_with_an_end_inside_once() {
    let malformed = "is not of an edge a < b with an end inside, once";
    let listed = |at: usize, weight: (usize, usize, f64)| {
        let mut evidence = dart().folded(Hypothesis::ConvexBoundary);
        let Statement::NotEmbedded { weights, .. } = &mut evidence.statement else { unreachable!() };
        weights.insert(at, weight);
        evidence
    };
    // One beside the right one, one overwritten by it, and one on a side of the polygon.
    refused_for(&listed(4, (0, 4, 1.0)), malformed);
    refused_for(&listed(0, (0, 4, 7.0)), malformed);
    refused_for(&listed(0, (0, 1, 0.0)), malformed);
    let mut evidence = dart().folded(Hypothesis::ConvexBoundary);
    let Statement::NotEmbedded { weights, .. } = &mut evidence.statement else { unreachable!() };
    weights[0] = (4, 0, 1.0);
    refused_for(&evidence, malformed);
}

#[test]
fn an_edge_without_a_weight_is_one_that_is_not_there() {
    let mut loose = dart();
    loose.weights.retain(|w| w.0 != [0, 4]);
    refused_for(&loose.folded(Hypothesis::ConvexBoundary), "every edge of a face with an end inside has a weight");
}

#[test]
fn a_surface_is_one_with_the_polygon_as_its_only_edge() {
    // A second sheet, over a face with one end at the rim: three faces lie at two of its edges.
    let sheet = [[0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 1, 4], [1, 3, 4], [3, 0, 4]];
    refused_for(&drawing(&TRIANGLE, 2, &sheet).overlapping(Hypothesis::Disc), "the faces form a surface");
    // A sphere, an octahedron, that touches the disc in two vertices: together they have the Euler number of a disc.
    let mut faces = FAN.to_vec();
    for k in 0..4 {
        let (e, f) = (5 + k, 5 + (k + 1) % 4);
        faces.extend([[0, e, f], [2, f, e]]);
    }
    refused_for(&drawing(&DART, 5, &faces).folded(Hypothesis::ConvexBoundary), "the faces at a vertex form one fan");
    // A torus apart, all of it in one place.
    let torus = (0..7).flat_map(|i| [[i, (i + 1) % 7, (i + 3) % 7], [i, (i + 3) % 7, (i + 2) % 7]]);
    let faces: Vec<[usize; 3]> = FAN.into_iter().chain(torus.map(|f| f.map(|v| 5 + v))).collect();
    let apart = Drawing { afloat: 7, ..drawing(&DART, 1, &faces) };
    refused_for(&apart.folded(Hypothesis::ConvexBoundary), "the surface is connected");
}

#[test]
fn a_torus_with_a_hole_is_not_taken_for_a_disc() {
    // A grid of nine vertices, each square cut by its diagonal, but for the square at the origin, which is left out.
    let name = |i: usize, j: usize| match (i % 3, j % 3) {
        (0, 0) => 0,
        (1, 0) => 1,
        (1, 1) => 2,
        (0, 1) => 3,
        (2, j) => 4 + j,
        (i, _) => 7 + i,
    };
    let squares = (0..3).flat_map(|i| (0..3).map(move |j| (i, j))).filter(|s| *s != (0, 0));
    let cut = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [name(i, j), name(i + 1, j), name(i + 1, j + 1), name(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    // The hole is the polygon, so the faces run around it the other way.
    let faces: Vec<[usize; 3]> = cut.map(|[a, b, c]| [a, c, b]).collect();
    refused_for(&drawing(&DART, 5, &faces).folded(Hypothesis::ConvexBoundary), "the Euler number");
    accepted(&drawing(&SQUARE, 5, &faces).weigh([0, 4], 2).weigh([2, 8], 3).overlapping(Hypothesis::Disc));
}

#[test]
fn a_face_is_not_folded_for_being_written_down_the_other_way_round() {
    // The vertex inside is pulled to where it sees all corners.
    let embedded = dart().weigh([0, 4], 6);
    for turned in [vec![1], vec![0, 1, 2, 3]] {
        let mut other = embedded.clone();
        turned.iter().for_each(|&f: &usize| other.faces[f].swap(1, 2));
        refused_for(&other.folded(Hypothesis::ConvexBoundary), "the faces are oriented as the polygon runs");
    }
    refused_for(
        &embedded.evidence(Hypothesis::ConvexBoundary, Fault::Face { face: 1 }),
        "face 1 is not counter-clockwise",
    );
}

#[test]
fn a_graph_that_hangs_loosely_has_four_vertices_and_no_faces() {
    let (another, fault) = ("the graph has at most four vertices", Fault::Edge { a: 0, b: 3 });
    let chain = Drawing { inside: 2, weights: vec![([0, 3], 1), ([3, 4], 1)], ..pendant() };
    refused_for(&chain.evidence(Hypothesis::ThreeConnected, fault.clone()), another);
    let filled = Drawing { faces: vec![[0, 1, 2]], ..pendant() };
    refused_for(&filled.evidence(Hypothesis::ThreeConnected, fault.clone()), another);
    // A large one is refused without a search for two vertices that separate it.
    let n = 400;
    let chain = (3..n).map(|k| ([k, k + 1], 1));
    let weights = [([0, 3], 1)].into_iter().chain(chain).collect();
    let long = Drawing { inside: 0, afloat: n - 2, weights, ..pendant() };
    refused_for(&long.evidence(Hypothesis::ThreeConnected, fault), another);
}

#[test]
fn positions_are_fractions_of_moderate_length() {
    let mut evidence = dart().folded(Hypothesis::ConvexBoundary);
    let Statement::NotEmbedded { drawing, .. } = &mut evidence.statement else { unreachable!() };
    drawing[4][0] = "0/0".into();
    refused_for(&evidence, "has a denominator that is not positive");
    let large = |digits: usize| {
        let scale = format!("1{}", "0".repeat(digits)).parse().unwrap();
        Drawing { scale, ..dart() }.folded(Hypothesis::ConvexBoundary)
    };
    accepted(&large(100));
    refused_for(&large(10_000), "is too long");
}
