//! Exhaustive small worlds: every graph on at most five labelled vertices, every choice of diagonals of small grids, each
//! verdict against brute force.

use lapjury::domain::{Domain, Graph, Surface};
use lapjury::laplacian::{self, cotan::stiffness_in_plane};
use lapjury::linalg::Dense;
use lapjury::operator::Operator;
use lapjury::property::recheck::of_verdict;
use lapjury::property::{self, Level, Statement, Status, Trial, Verdict};
use lapjury::scalar::{Rational, Scalar};

/// Decides a property and rechecks its evidence.
fn judge(id: &str, domain: &Domain, operator: &Operator) -> Verdict {
    let trial = Trial::new(domain, operator, 1).unwrap();
    let verdict = property::find(id).unwrap().decide(&trial, None);
    of_verdict(&verdict, id, domain, operator).unwrap_or_else(|refusal| panic!("{id}: {refusal}: {verdict:?}"));
    verdict
}

fn build(id: &str, domain: &Domain) -> Operator {
    laplacian::find(id).unwrap().build(domain, &Default::default()).unwrap()
}

fn holds(yes: bool) -> Status {
    if yes { Status::Holds } else { Status::Fails }
}

/// The members of the set that the bits of a mask name.
fn members(mask: usize, size: usize) -> Vec<usize> {
    (0..size).filter(|k| mask >> k & 1 == 1).collect()
}

/// `0 ≤ −L_II⁻¹ L_IB ≤ 1` by rational elimination; a singular `L_II` fails.
fn maximum_principle(l: &Dense<Rational>, set: &[usize]) -> bool {
    let inside: Vec<usize> = (0..l.rows()).filter(|i| !set.contains(i)).collect();
    let Some(h) = l.submatrix(&inside, &inside).solve(&l.submatrix(&inside, set)) else { return false };
    let zero = Rational::zero();
    let one = Rational::exactly(1.0).unwrap();
    let between = |x: Rational| zero <= x && x <= one;
    (0..h.rows()).all(|i| (0..h.columns()).all(|b| between(-h.at(i, b).clone())))
}

/// A graph by the mask of its edges, with everything that brute force says of it.
struct Labelled {
    vertices: usize,
    edges: Vec<[usize; 2]>,
}

impl Labelled {
    /// All graphs on `n` labelled vertices: `2^(n(n−1)/2)`.
    fn all(n: usize) -> impl Iterator<Item = Labelled> {
        let pairs: Vec<[usize; 2]> = (0..n).flat_map(|i| (i + 1..n).map(move |j| [i, j])).collect();
        (0..1 << pairs.len()).map(move |mask| Labelled {
            vertices: n,
            edges: members(mask, pairs.len()).into_iter().map(|k| pairs[k]).collect(),
        })
    }

    fn domain(&self, boundary: &[usize]) -> Domain {
        Graph::new(self.vertices, &self.edges).unwrap().with_boundary(boundary).unwrap().into()
    }

    fn degree(&self, v: usize) -> usize {
        self.edges.iter().filter(|e| e.contains(&v)).count()
    }

    /// `D − A` in whole numbers.
    fn laplacian(&self) -> Dense<Rational> {
        let entry = |i: usize, j: usize| match i == j {
            true => self.degree(i) as f64,
            false => -f64::from(u8::from(self.edges.contains(&[i.min(j), i.max(j)]))),
        };
        Dense::from_fn(self.vertices, self.vertices, |i, j| Rational::exactly(entry(i, j)).unwrap())
    }

    /// By spreading the smallest label until nothing changes.
    fn components(&self) -> usize {
        let mut label: Vec<usize> = (0..self.vertices).collect();
        for _ in 0..self.vertices {
            for &[a, b] in &self.edges {
                label[a] = label[a].min(label[b]);
                label[b] = label[a];
            }
        }
        (0..self.vertices).filter(|&v| label[v] == v).count()
    }
}

#[test]
fn on_every_graph_of_at_most_five_vertices_the_structural_verdicts_are_those_of_brute_force() {
    let mut graphs = 0;
    for graph in (0..=5).flat_map(Labelled::all) {
        let domain = graph.domain(&[]);
        let operator = build("graph", &domain);
        let (l, edges) = (graph.laplacian(), &graph.edges);
        for (i, row) in (0..graph.vertices).map(|i| (i, operator.stiffness().row(i))) {
            row.for_each(|(j, v)| assert_eq!(Rational::exactly(*v).unwrap(), *l.at(i, j), "{edges:?}"));
        }
        assert_eq!(l.asymmetry(), None);
        assert!(l.eliminate().is_semidefinite());
        for id in ["FIN", "LOC", "SYM", "NULL", "PSD", "KER"] {
            let verdict = judge(id, &domain, &operator);
            let nothing = graph.vertices == 0 || id == "LOC" && edges.is_empty();
            let ok = verdict.status() == Status::Holds || nothing && verdict.status() == Status::NotApplicable;
            assert!(ok, "{id} on {edges:?}: {verdict:?}");
            if id == "KER" && graph.vertices > 0 {
                let components = graph.components();
                assert_eq!(l.kernel().len(), components, "{edges:?}");
                let statement = &verdict.evidence().unwrap().statement;
                let counted = matches!(statement, Statement::ClosedClasses { kernel } if *kernel == components);
                assert!(counted, "{edges:?}: {statement:?}");
            }
        }
        let lively = (0..graph.vertices).any(|v| graph.degree(v) > 0);
        for id in ["POS", "POS0", "MAX-local"] {
            let expected = if lively { Status::Holds } else { Status::NotApplicable };
            let verdict = judge(id, &domain, &operator);
            assert_eq!(verdict.status(), expected, "{id} on {edges:?}");
            assert!(!lively || verdict.level == Level::Exact, "{id} on {edges:?}: {verdict:?}");
        }
        let alone = (0..graph.vertices).any(|v| graph.degree(v) == 0);
        let verdict = judge("MVP", &domain, &operator);
        // The row of an isolated vertex is empty, and no average.
        assert!(alone || graph.vertices == 0 || verdict.status() == Status::Holds, "MVP on {edges:?}: {verdict:?}");
        graphs += 1;
    }
    assert_eq!(graphs, 1 + 1 + 2 + 8 + 64 + 1024);
}

#[test]
fn with_every_boundary_of_every_graph_of_at_most_four_vertices_max_global_is_decided_as_by_elimination() {
    let mut seen = [0; 3];
    for graph in (1..=4).flat_map(Labelled::all) {
        let l = graph.laplacian();
        for mask in 1..1 << graph.vertices {
            let set = members(mask, graph.vertices);
            let domain = graph.domain(&set);
            let verdict = judge("MAX-global", &domain, &build("graph", &domain));
            // There is no equation at an isolated vertex: it counts as prescribed.
            let prescribed: Vec<usize> =
                (0..graph.vertices).filter(|v| set.contains(v) || graph.degree(*v) == 0).collect();
            let expected = match prescribed.len() == graph.vertices {
                true => Status::NotApplicable,
                false => holds(maximum_principle(&l, &prescribed)),
            };
            assert_eq!(verdict.status(), expected, "{:?} with boundary {set:?}: {verdict:?}", graph.edges);
            let outcomes = [Status::Holds, Status::Fails, Status::NotApplicable];
            seen[outcomes.iter().position(|s| *s == expected).unwrap()] += 1;
        }
    }
    assert!(seen.iter().all(|n| *n > 20), "{seen:?}");
}

/// Where the points of a grid lie; every cell stays convex.
type Placement = fn(usize, usize) -> [i64; 2];

/// Straight, sheared, and bumpy: cocircular diagonals only; one kind of diagonal worse than the other; a mixture.
const PLACEMENTS: [(&str, Placement); 3] = [
    ("straight", |x, y| [x as i64, y as i64]),
    ("sheared", |x, y| [3 * x as i64 + y as i64, 3 * y as i64]),
    ("bumpy", |x, y| {
        let bump = |a: usize, b: usize| (5 * a + 3 * b + a * b) as i64 % 3 - 1;
        [4 * x as i64 + bump(x, y), 4 * y as i64 + bump(y, x + 1)]
    }),
];

/// A triangulated k × k grid on whole coordinates.
struct Grid {
    points: Vec<[i64; 2]>,
    faces: Vec<[usize; 3]>,
}

impl Grid {
    /// The diagonal of cell c runs from its lower left corner if bit c of the mask is set, else from its lower right one.
    fn new(k: usize, placement: Placement, mask: usize) -> Self {
        let points = (0..(k + 1) * (k + 1)).map(|v| placement(v % (k + 1), v / (k + 1))).collect();
        let cell = |c: usize| {
            let a = c / k * (k + 1) + c % k;
            let [b, c, d] = [a + 1, a + k + 2, a + k + 1];
            (a, b, c, d)
        };
        let halves = |at: usize| match (cell(at), mask >> at & 1) {
            ((a, b, c, d), 1) => [[a, b, c], [a, c, d]],
            ((a, b, c, d), _) => [[a, b, d], [b, c, d]],
        };
        Grid { points, faces: (0..k * k).flat_map(halves).collect() }
    }

    fn surface(&self) -> Surface {
        let positions: Vec<[f64; 2]> = self.points.iter().map(|p| p.map(|x| x as f64)).collect();
        Surface::planar(&positions, &self.faces).unwrap()
    }

    /// The in-circle determinant of the triangle `abc`, counter-clockwise, and d, in whole numbers: positive inside.
    fn in_circle(&self, [a, b, c]: [usize; 3], d: usize) -> i64 {
        let row = |v: usize| {
            let (x, y) = (self.points[v][0] - self.points[d][0], self.points[v][1] - self.points[d][1]);
            [x, y, x * x + y * y]
        };
        let [p, q, r] = [row(a), row(b), row(c)];
        p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0])
    }

    /// Interior edges, by every pair of faces with two common corners: how many are not Delaunay, and how many cocircular.
    fn delaunay_count(&self) -> [usize; 3] {
        let mut count = [0; 3];
        for (at, f) in self.faces.iter().enumerate() {
            for g in &self.faces[at + 1..] {
                let opposite: Vec<usize> = g.iter().copied().filter(|v| !f.contains(v)).collect();
                let &[d] = opposite.as_slice() else { continue };
                count[match self.in_circle(*f, d) {
                    x if x > 0 => 0,
                    0 => 1,
                    _ => 2,
                }] += 1;
            }
        }
        count
    }
}

fn assert_as_by_brute_force(name: &str, grid: &Grid, seen: &mut [[usize; 2]; 3]) {
    let surface = grid.surface();
    let exact = Dense::from_csr(&stiffness_in_plane::<Rational>(&surface).unwrap());
    let domain = Domain::from(surface);
    let operator = build("cotan", &domain);
    let [violations, zeros, positive] = grid.delaunay_count();
    let case = |verdict: &Verdict| format!("{name} {:?}: {verdict:?}", grid.faces);

    for (id, failing) in [("POS0", violations), ("POS", violations + zeros)] {
        let verdict = judge(id, &domain, &operator);
        assert_eq!((verdict.status(), verdict.level), (holds(failing == 0), Level::Exact), "{id} {}", case(&verdict));
        let tally = verdict.tally.unwrap();
        assert_eq!((tally.zeros, tally.total), (zeros, violations + zeros + positive), "{id} {}", case(&verdict));
        assert_eq!((tally.violations, tally.undecided), (violations, 0), "{id} {}", case(&verdict));
    }

    let boundary: Vec<usize> = (0..grid.points.len()).filter(|&v| domain.boundary()[v]).collect();
    let interior = domain.interior();
    for axis in 0..2 {
        let x: Vec<Rational> = grid.points.iter().map(|p| Rational::from(p[axis])).collect();
        let image = exact.mul(&x);
        assert!(interior.iter().all(|&i| image[i].cmp_zero().is_eq()), "the exact operator is linear on {name}");
    }
    let linear = judge("LIN", &domain, &operator);
    assert_eq!(linear.status(), Status::Holds, "LIN {}", case(&linear));

    let one_sign = |i: usize| {
        let weights = || (0..exact.columns()).filter(move |&j| j != i).map(|j| exact.at(i, j).cmp_zero());
        weights().any(|w| w.is_lt()) != weights().any(|w| w.is_gt())
    };
    let expected = [
        ("MAX-local", interior.iter().all(|&i| one_sign(i))),
        ("MAX-global", maximum_principle(&exact, &boundary)),
        ("PSD", exact.eliminate().is_semidefinite()),
        ("KER", exact.kernel().len() == 1),
    ];
    for (id, expected) in expected {
        let verdict = judge(id, &domain, &operator);
        assert_eq!(verdict.status(), holds(expected), "{id} {}", case(&verdict));
    }
    for (count, holds) in seen.iter_mut().zip([violations == 0, expected[0].1, expected[1].1]) {
        count[usize::from(holds)] += 1;
    }
}

#[test]
fn for_all_diagonals_of_small_grids_cotan_is_judged_as_by_brute_force() {
    let mut seen = [[0; 2]; 3];
    for (name, placement) in PLACEMENTS {
        for k in 1..=3 {
            for mask in 0..1 << (k * k) {
                let grid = Grid::new(k, placement, mask);
                if k > 1 {
                    assert_as_by_brute_force(name, &grid, &mut seen);
                }
            }
        }
    }
    assert!(seen.iter().flatten().all(|n| *n > 50), "each of POS0, MAX-local, MAX-global both ways: {seen:?}");
}

#[test]
fn on_the_straight_grid_linear_functions_are_harmonic_to_the_last_bit() {
    for mask in 0..512 {
        let domain = Domain::from(Grid::new(3, PLACEMENTS[0].1, mask).surface());
        let l = build("cotan", &domain);
        let positions = domain.positions().unwrap();
        for axis in 0..2 {
            let image = l.stiffness().mul(&positions.iter().map(|p| p[axis]).collect::<Vec<_>>());
            assert!(domain.interior().iter().all(|&i| image[i] == 0.0), "diagonals {mask:09b}");
        }
        // Every weight is 0, ½ or 1: the row sums are exact as well.
        assert_eq!(judge("LIN", &domain, &l).margin, Some(0.0));
    }
}
