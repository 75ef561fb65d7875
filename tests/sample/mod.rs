//! Sample records, made in code: a rich one with every kind of witness and certificate, a tiny one, and a large one.

use std::collections::BTreeMap;

use lapjury::domain::{Domain, Graph, Surface};
use lapjury::figure::{Axis, Chart, Figure, Mark, Series, Sketch};
use lapjury::property::evidence::{
    Condition, Corner, Exception, Fault, Flip, Fraction, Hypothesis, Mesh, Row, Term, Weighting, Which,
};
use lapjury::property::{Evidence, Excerpt, Level, Statement, Tally, Verdict};
use lapjury::record::{
    AtlasFound, AtlasLine, Cell, ClaimLine, ClaimOutcome, DomainLine, Exhibit, Header, Line, OperatorLine, Recheck,
    Record, SCHEMA, TestLine, Timing, Writer,
};

pub fn header(suite: &str) -> Header {
    let environment =
        [("command", "lapjury run primer"), ("operating system", "linux x86_64"), ("processor", "a processor")];
    Header {
        schema: SCHEMA,
        suite: suite.into(),
        seed: 7,
        version: "0.1.0".into(),
        environment: environment.map(|(k, v)| (k.to_string(), v.to_string())).into(),
    }
}

/// Text of a record as a run writes it.
pub fn written(record: &Record) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = Writer::new(&mut bytes);
    record.results().for_each(|line| writer.write(&line).unwrap());
    if let Some(timing) = &record.timing {
        writer.write(&Line::Timing(timing.clone())).unwrap();
    }
    writer.finish().unwrap();
    bytes
}

pub fn cell(recipe: &str, class: &str, laplacian: &str, property: &str, verdict: Verdict) -> Cell {
    let recheck = match verdict.evidence() {
        Some(_) if verdict.level == Level::Exact => Recheck::Exact,
        Some(_) => Recheck::Bounded,
        None => Recheck::Nothing,
    };
    Cell {
        recipe: recipe.into(),
        class: class.into(),
        laplacian: laplacian.into(),
        property: property.into(),
        verdict,
        promised: None,
        as_expected: true,
        recheck,
        replay: format!("lapjury check --domain '{recipe}' --laplacian {laplacian} --property {property}"),
    }
}

pub fn scan(margin: f64) -> Verdict {
    Verdict::holds(Level::Bounded, Evidence::bare(Statement::Scan { checked: 40, worst: vec![1, 2] }))
        .with_margin(margin)
}

/// A domain with what the record says of it and what an exhibit shows of it.
pub struct Place {
    pub recipe: String,
    pub class: String,
    pub domain: Domain,
}

impl Place {
    fn new(recipe: &str, class: &str, domain: impl Into<Domain>) -> Self {
        Place { recipe: recipe.into(), class: class.into(), domain: domain.into() }
    }

    pub fn line(&self) -> DomainLine {
        DomainLine {
            recipe: self.recipe.clone(),
            class: self.class.clone(),
            digest: self.domain.digest(),
            facts: self.domain.facts(),
            notices: self.domain.notices().to_vec(),
        }
    }

    pub fn exhibit(&self, laplacian: &str, property: &str) -> Exhibit {
        let n = self.domain.vertex_count();
        let turn = |k: usize| std::f64::consts::TAU * k as f64 / n as f64;
        let circle = || (0..n).map(|k| [turn(k).cos(), turn(k).sin(), 0.0]).collect();
        Exhibit {
            laplacian: laplacian.into(),
            property: property.into(),
            recipe: self.recipe.clone(),
            positions: self.domain.positions().map_or_else(circle, <[_]>::to_vec),
            faces: self.domain.as_surface().map(|s| s.faces().to_vec()).unwrap_or_default(),
            edges: self.domain.edges().to_vec(),
        }
    }
}

/// A planar patch whose edge (1, 3) is not Delaunay: the angles at 0 and 2 are obtuse.
pub fn kite() -> Place {
    let p = [[0.0, 0.35], [-1.3, 1.0], [0.1, 1.45], [1.2, 0.9], [0.0, -0.6], [0.1, 2.3]];
    let faces = [[0, 3, 1], [1, 3, 2], [0, 1, 4], [0, 4, 3], [1, 2, 5], [2, 3, 5]];
    Place::new("kite(apex=0.35)", "hand-made", Surface::planar(&p, &faces).unwrap())
}

/// A jittered grid.
pub fn grid(n: usize) -> Place {
    let at = |k: usize| (k % n, k / n);
    let jitter = |k: usize, s: f64| 0.32 * (k as f64 * s).sin();
    let inner = |c: usize| f64::from(u8::from(c > 0 && c + 1 < n));
    let position = |k| {
        let (x, y) = at(k);
        let free = inner(x) * inner(y);
        [x as f64 + free * jitter(k, 12.9), y as f64 + free * jitter(k, 78.2)]
    };
    let positions: Vec<[f64; 2]> = (0..n * n).map(position).collect();
    let squares = (0..n * n).filter(|&k| at(k).0 + 1 < n && at(k).1 + 1 < n);
    let faces: Vec<[usize; 3]> = squares.flat_map(|k| [[k, k + 1, k + n + 1], [k, k + n + 1, k + n]]).collect();
    Place::new(
        &format!("perturbed-grid(n={n}, seed=7)"),
        "perturbed grids",
        Surface::planar(&positions, &faces).unwrap(),
    )
}

/// A sphere as an octahedron refined twice, slightly squeezed.
pub fn sphere() -> Place {
    let mut p: Vec<[f64; 3]> =
        vec![[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let mut faces = vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..2 {
        let mut middles: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        let mut finer = Vec::new();
        for [a, b, c] in faces {
            let mut middle = |i: usize, j: usize| {
                *middles.entry([i.min(j), i.max(j)]).or_insert_with(|| {
                    let sum: [f64; 3] = std::array::from_fn(|k| p[i][k] + p[j][k]);
                    let length = sum.iter().map(|c| c * c).sum::<f64>().sqrt();
                    p.push(sum.map(|c| c / length));
                    p.len() - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        faces = finer;
    }
    p.iter_mut().for_each(|q| q[2] *= 0.8);
    Place::new("octasphere(level=2, squeeze=0.8)", "spheres", Surface::triangles(p, &faces).unwrap())
}

/// A cycle with two chords.
pub fn cycle() -> Place {
    let mut edges: Vec<[usize; 2]> = (0..9).map(|k| [k.min((k + 1) % 9), k.max((k + 1) % 9)]).collect();
    edges.extend([[0, 4], [2, 7]]);
    Place::new("cycle(9)+chords", "graphs", Graph::new(9, &edges).unwrap())
}

fn row(row: usize, entries: &[(usize, f64)]) -> Row {
    Row { row, entries: entries.to_vec() }
}

fn rows(rows: Vec<Row>) -> Excerpt {
    Excerpt { rows, ..Excerpt::default() }
}

/// Every kind of witness, with its property.
pub fn witnesses() -> Vec<(&'static str, Statement, Excerpt)> {
    let corner = |vertex, angle_deg| Corner { vertex, angle_deg };
    let two = rows(vec![row(3, &[(1, 0.31), (3, 0.91), (7, -1.21)]), row(7, &[(3, -1.0), (7, 2.0)])]);
    let mass = Excerpt {
        mass_rows: vec![row(3, &[(3, -0.2), (4, 0.5)]), row(4, &[(3, 0.25), (4, 0.1)])],
        ..Excerpt::default()
    };
    let flux =
        Excerpt { positions: vec![(3, [0.0, 0.0, 0.0]), (1, [-1.0, 0.0, 0.0]), (7, [1.0, 1.0, 0.0])], ..two.clone() };
    let wave = |n: usize| (0..n).map(|k| (k, (1.7 * k as f64).sin())).collect::<Vec<_>>();
    vec![
        ("FIN", Statement::NotFinite { matrix: Which::Stiffness, i: 2, j: 3, value: "NaN".into() }, Excerpt::default()),
        ("LOC", Statement::FarEntry { i: 1, j: 7, rings: Some(3) }, rows(vec![row(1, &[(1, 1.0), (7, -0.25)])])),
        ("SYM", Statement::Asymmetry { i: 3, j: 7, threshold: 1.2e-15 }, two.clone()),
        ("NULL", Statement::RowSum { i: 3, threshold: 1e-14 }, two.clone()),
        ("KER", Statement::KernelVector { x: wave(9), a: 1, b: 5, threshold: 3e-15 }, Excerpt::default()),
        (
            "POS",
            Statement::Weight { i: 1, j: 3, zero: false, opposite: vec![corner(0, 127.9), corner(2, 133.6)] },
            rows(vec![row(1, &[(1, 0.5), (3, 0.31)])]),
        ),
        (
            "POS0",
            Statement::Weight { i: 1, j: 3, zero: true, opposite: vec![corner(0, 90.0), corner(2, 90.0)] },
            Excerpt::default(),
        ),
        (
            "POS-boundary",
            Statement::Weight { i: 1, j: 4, zero: false, opposite: vec![corner(0, 101.3)] },
            rows(vec![row(1, &[(4, 0.1)])]),
        ),
        ("PSD", Statement::NegativeEnergy { x: wave(66) }, Excerpt::default()),
        ("LIN", Statement::Moment { i: 3, axis: 0, axes: [0, 1], boundary: None, threshold: 4e-15 }, flux.clone()),
        ("FLUX", Statement::Moment { i: 3, axis: 1, axes: [0, 1], boundary: Some([1, 7]), threshold: 4e-15 }, flux),
        (
            "ENERGY",
            Statement::Energy {
                axis: 0,
                other: 0,
                trace: false,
                found: 17.2,
                expected: 16.0,
                threshold: 1e-12,
                star: 12,
            },
            Excerpt::default(),
        ),
        (
            "ACC",
            Statement::Inaccurate { i: 3, j: 7, exact: 1.25, error: 0.04, threshold: 3e-14 },
            rows(vec![row(3, &[(3, 1.0), (7, -1.21)])]),
        ),
        (
            "MAX-local",
            Statement::BothSigns { i: 3, positive: 7, negative: 1 },
            rows(vec![row(3, &[(1, 0.31), (3, 0.9), (7, -1.21)])]),
        ),
        ("MAX-row", Statement::NoWeight { i: 3 }, Excerpt::default()),
        ("MVP", Statement::NotConvex { i: 3, j: 1 }, two.clone()),
        ("MVP-diagonal", Statement::NotConvex { i: 3, j: 3 }, rows(vec![row(3, &[(3, -0.4)])])),
        (
            "MAX-global",
            Statement::Overshoot {
                set: vec![0, 1, 2, 3, 4, 5, 9, 14, 19, 24],
                source: 2,
                at: 7,
                value: -0.037,
                low: true,
            },
            Excerpt::default(),
        ),
        (
            "MAX-unique",
            Statement::Singular { set: vec![0, 1, 2, 3, 4], x: vec![(6, 1.0), (7, -1.0)] },
            Excerpt::default(),
        ),
        ("MAX-heat", Statement::HeatLoss { t: 0.01, source: 6, at: 8, value: -2.4e-4 }, Excerpt::default()),
        ("MASS", Statement::MassTotal { found: 15.0, expected: 16.0, threshold: 1e-13 }, mass.clone()),
        ("MASS-symmetric", Statement::MassAsymmetry { i: 3, j: 4, threshold: 1e-16 }, mass.clone()),
        ("MASS-positive", Statement::MassNotPositive { x: vec![(3, 1.0)] }, mass.clone()),
        ("MASS-share", Statement::MassShare { i: 3, lower: 0.4, upper: 1.2 }, mass),
        (
            "PERM",
            Statement::Changed {
                transformation: "renumbering with seed 7".into(),
                matrix: Which::Stiffness,
                i: 3,
                j: 4,
                before: -0.5,
                after: -0.25,
                threshold: 1e-15,
            },
            Excerpt::default(),
        ),
        ("CHEEGER", Statement::BelowCheeger { x: vec![(0, 1.0), (1, -1.0)], side: vec![0, 1] }, Excerpt::default()),
    ]
}

/// Every kind of certificate.
pub fn certificates() -> Vec<Statement> {
    vec![
        Statement::Scan { checked: 8784, worst: vec![3, 7] },
        Statement::SumOfSquares,
        Statement::ShiftedFactor { shift: 1e-13, smallest_pivot: 2.2e-4 },
        Statement::InertiaCount { shift: 1e-12, kernel: 1 },
        Statement::ClosedClasses { kernel: 2 },
        Statement::SingularValues { kernel: 2, zero: 3e-17, positive: 0.04 },
        Statement::SignPattern { set: 16 },
        Statement::Solved { columns: 16, smallest: 0.003, error: 1e-14 },
        Statement::Compared { transformations: vec!["renumbering with seed 7".into()], entries: 1200 },
    ]
}

/// Every kind of statement about triangulations, drawings and smooth forms.
pub fn triangulations() -> Vec<Statement> {
    let text = |x: &str| x.to_string();
    let at = |x: &str, y: &str| [text(x), text(y)];
    vec![
        Statement::FlipsToDelaunay {
            flips: vec![Flip { quad: [0, 1, 2, 3], kappa: text("3/64") }],
            end: vec![[0, 1, 3], [1, 2, 3]],
            values: vec![1.0, 0.0, 0.0, 0.0],
            energies: vec![0.875, 0.5],
        },
        Statement::DelaunayNotMinimal {
            delaunay: vec![[0, 1, 2, 3], [0, 2, 3, 4], [1, 2, 3, 4]],
            other: vec![[0, 1, 2, 4], [0, 1, 3, 4]],
            values: vec![1.0, 0.0, 0.0, 0.0, 0.0],
            energies: [text("2/3"), text("11/24")],
        },
        Statement::PositiveExtension { i: 0, j: 4, weight: text("-1/4"), smallest: text("1/12") },
        Statement::NotEmbedded {
            boundary: vec![0, 1, 2],
            weights: vec![(0, 3, 1.0), (1, 3, 1.0), (2, 3, -1.0)],
            drawing: vec![at("0", "0"), at("1", "0"), at("0", "1"), at("1", "-1")],
            checksum: text("12"),
            missing: Hypothesis::PositiveWeights,
            fault: Fault::Face { face: 0 },
        },
        Statement::TorusFlips { start: [[1, 0], [3, 1]], flips: 3, end: [[1, 0], [0, 1]] },
        Statement::Cospectral {
            vertices: 4,
            first: vec![[0, 1], [0, 2], [0, 3]],
            second: vec![[0, 1], [0, 3], [1, 2], [2, 3]],
            normalised: true,
            polynomial: ["0", "-2", "5", "-4", "1"].map(Fraction::text).to_vec(),
        },
        Statement::Transplantation {
            first: mesh(),
            second: mesh(),
            condition: Condition::Neumann,
            matrix: vec![(0, 0, Fraction::text("1"))],
            dual: vec![(0, 0, Fraction::text("1"))],
            outlines: [vec![1, 2, 1], vec![1, 2, 1]],
        },
        Statement::SpectraDiffer {
            first: mesh(),
            second: mesh(),
            condition: Condition::Neumann,
            mass: Weighting::Unit,
            sigma: Fraction::text("2/3"),
            below: [3, 4],
            determinants: ["-1/9", "1/9"].map(Fraction::text),
        },
        Statement::DelaunayEigenvalue {
            other: vec![[0, 2, 3], [0, 3, 1]],
            condition: Condition::Neumann,
            mass: Weighting::Barycentric,
            sigma: Fraction::text("4/3"),
            below: [1, 2],
            determinants: ["-1/9", "1/9"].map(Fraction::text),
        },
        Statement::HarmonicForm {
            dimension: 2,
            form: vec![term("-1", &[0, 1], &[0]), term("1", &[1, 0], &[1])],
            exception: Exception::Closed { derivative: vec![term("2", &[0, 0], &[0, 1])] },
        },
    ]
}

fn term(coefficient: &str, exponents: &[u32], differentials: &[usize]) -> Term {
    let coefficient = Fraction::text(coefficient);
    Term { coefficient, exponents: exponents.to_vec(), differentials: differentials.to_vec() }
}

/// A triangle.
fn mesh() -> Mesh {
    Mesh { points: vec![[0, 0], [1, 0], [0, 1]], faces: vec![[0, 1, 2]] }
}

const OPERATORS: [&str; 8] = [
    "graph",
    "cotan",
    "cotan(mass=mixed)",
    "intrinsic-delaunay",
    "mean-value",
    "wachspress",
    "three-point(p=2)",
    "weighted-graph",
];

/// A record with every kind of witness and certificate, claims of every outcome, and something unexpected.
pub fn rich() -> Record {
    let places = [kite(), grid(5), sphere(), cycle()];
    let mut record = Record::new(header("primer"));
    record.domains = places.iter().map(Place::line).collect();
    record.domains[1].notices.push("4 faces were turned round to orient the mesh".into());
    let certificates = certificates();
    for (l, laplacian) in OPERATORS.iter().enumerate() {
        for (k, (property, statement, excerpt)) in witnesses().into_iter().enumerate() {
            let mut fails = (3 * l + k) % 7 == 0 || (property == "POS" && l == 1) || l == 1 && k < 9;
            fails &= l != 0;
            for (d, place) in places.iter().enumerate() {
                let fit = suits(&statement, place);
                let verdict = match () {
                    _ if fails && fit => {
                        Verdict::fails(Level::Exact, Evidence::new(statement.clone(), excerpt.clone()))
                            .with_tally(Tally { violations: 12, zeros: 1, undecided: 0, total: 40 })
                    }
                    _ if (k + l) % 9 == 0 && d == 1 => Verdict::undecided("the residual is 40 roundings"),
                    _ if k == 14 || (d == 3 && k % 3 == 0) => Verdict::not_applicable("no flat interior vertex"),
                    _ => {
                        let certificate = certificates[(k + d) % certificates.len()].clone();
                        let margin = 10f64.powf(-(((7 * k + 3 * d + 5 * l) % 60) as f64) / 9.0);
                        Verdict::holds(Level::Bounded, Evidence::bare(certificate)).with_margin(margin)
                    }
                };
                record.cells.push(cell(&place.recipe, &place.class, laplacian, property, verdict));
            }
            if let (true, Some(place)) = (fails, places.iter().find(|p| suits(&statement, p))) {
                record.exhibits.push(place.exhibit(laplacian, property));
            }
        }
    }
    scatter(&mut record);
    let last = record.cells.len() - 1;
    record.cells[last].as_expected = false;
    record.cells[last].promised = Some(true);
    record.cells[last - 1].recheck = Recheck::Refused("row 3 is not the operator's".into());
    record.operators.push(OperatorLine {
        recipe: cycle().recipe,
        laplacian: "mean-value".into(),
        refused: Some("mean-value accepts surfaces, this is a graph".into()),
        notes: Vec::new(),
    });
    record.claims = claims();
    let parts = [
        ("generate", 1.9),
        ("build/cotan", 0.8),
        ("decide/PSD", 4.2),
        ("decide/MAX-global", 11.5),
        ("recheck", 6.3),
        ("claims", 0.0004),
    ];
    record.timing = Some(Timing { seconds: 14.2, threads: 2, parts: parts.map(|(k, v)| (k.to_string(), v)).into() });
    Record::parse(&written(&record)).unwrap()
}

/// Many small meshes with a share of negative weights, for the charts.
fn scatter(record: &mut Record) {
    let base = grid(5);
    for k in 0..60 {
        let mut line = base.line();
        line.recipe = format!("random-flips(n={k})");
        line.class = "random flips".into();
        let surface = line.facts.surface.as_mut().unwrap();
        surface.non_delaunay_edges = Some(k % 30);
        let interior = line.facts.edges - surface.boundary_edges;
        for (laplacian, violations) in
            [("cotan", k % 30), ("three-point(p=2)", (k % 30) / 2 + k % 3), ("intrinsic-delaunay", 0)]
        {
            let tally = Tally { violations, zeros: 0, undecided: 0, total: interior };
            let (_, statement, excerpt) = witnesses().swap_remove(5);
            let verdict = match violations {
                0 => Verdict::holds(
                    Level::Exact,
                    Evidence::bare(Statement::Scan { checked: interior, worst: vec![0, 1] }),
                ),
                _ => Verdict::fails(Level::Exact, Evidence::new(statement, excerpt)),
            };
            record.cells.push(cell(&line.recipe, &line.class, laplacian, "POS", verdict.with_tally(tally)));
        }
        record.domains.push(line);
    }
}

/// Where a witness of the sample can be drawn.
fn suits(statement: &Statement, place: &Place) -> bool {
    let class = place.class.as_str();
    match statement {
        Statement::Weight { .. } => class == "hand-made",
        Statement::NegativeEnergy { .. } => class == "spheres",
        Statement::KernelVector { .. } | Statement::FarEntry { .. } => class == "graphs",
        Statement::BothSigns { .. } | Statement::MassShare { .. } | Statement::NoWeight { .. } => class == "spheres",
        Statement::Moment { boundary: Some(_), .. } => class == "perturbed grids",
        _ => class == "perturbed grids",
    }
}

/// A chart of each mark over logarithms, one over plain numbers, and a sketch.
fn figures() -> Vec<Figure> {
    let power = |p: i32| (1..6).map(move |k| [0.5_f64.powi(k), 0.1 * 0.5_f64.powi(p * k)]);
    let series = vec![
        Series::new("cotan", Mark::Both, power(2)),
        Series::new("graph", Mark::Dots, power(0)),
        Series::new("h²", Mark::Reference, power(2)),
    ];
    let (x, y) = (Axis::logarithmic("h, mean edge length"), Axis::logarithmic("relative error of λ₁"));
    let chart = Chart { title: "The first eigenvalue under refinement".into(), x, y, series };
    let series = vec![Series::new("λ", Mark::Line, (0..9).map(|k| [f64::from(k), 1.0 - 0.1 * f64::from(k)]))];
    let plain = Chart { title: "Numbers that fall".into(), x: Axis::linear("k"), y: Axis::linear("λ"), series };
    let sketch = Sketch {
        values: vec![1.0, -1.0, 0.5, 0.0],
        marked: vec![[0, 2]],
        ..Sketch::of_graph("A cycle of four", 4, &[[0, 1], [1, 2], [2, 3], [0, 3]])
    };
    vec![Figure::Chart(chart), Figure::Chart(plain), Figure::Sketch(sketch)]
}

pub fn claims() -> Vec<ClaimLine> {
    let test = |form: &str, agrees, finding: &str| TestLine {
        question:
            "the smallest eigenvalue of L, by the inertia of a shifted factorisation, over all domains of the suite"
                .into(),
        form: form.into(),
        agrees,
        decided: 1043,
        open: 2,
        level: Level::Exact,
        finding: finding.into(),
        replay: Some("lapjury verify c33".into()),
        evidence: Vec::new(),
        figures: figures(),
    };
    let claim = |id: &str, statement: &str, outcome, expected, tests| ClaimLine {
        id: id.into(),
        statement: statement.into(),
        source: "Wardetzky et al. 2007, section 2".into(),
        outcome,
        expected,
        amendment: (outcome == ClaimOutcome::Amended).then(|| "The same with ≥ in place of >.".into()),
        tests,
    };
    use ClaimOutcome::{Amended, Confirmed, Empty, Inconclusive, Refuted};
    vec![
        claim(
            "c33",
            "Positive weights make L positive semi-definite.",
            Confirmed,
            Confirmed,
            vec![test("stated", true, "all hold")],
        ),
        claim(
            "c81",
            "The weight ω = ½(cot α + cot β) of an interior edge is positive exactly when α + β < π; it is so for all edges exactly on Delaunay triangulations.",
            Amended,
            Amended,
            vec![
                test("stated", false, "cocircular vertices: ω = 0 on a Delaunay edge"),
                test("amended", true, "all agree"),
            ],
        ),
        claim(
            "c40",
            "λ_C²/2 ≤ λ̃₁ ≤ 2λ_C with the volume as printed.",
            Refuted,
            Confirmed,
            vec![test("stated", false, "a path on 3 vertices")],
        ),
        claim(
            "c45",
            "Every function is a sum of eigenvectors.",
            Inconclusive,
            Inconclusive,
            vec![test("stated", true, "open")],
        ),
        claim("c99", "A claim that selects nothing.", Empty, Empty, vec![]),
    ]
}

/// A cell with a smallest counterexample, one with a first known, one without, and one of an operator that has no cells.
pub fn atlas(place: &Place, cell: &Cell) -> Vec<AtlasLine> {
    let line = |laplacian: &str, property: &str, open: usize, found: bool| AtlasLine {
        laplacian: laplacian.into(),
        property: property.into(),
        world: "every triangulation of 3 points".into(),
        size: 6917,
        searched: if found { 34 } else { 6917 },
        decided: if found { 5 } else { 6900 },
        open,
        silent: if found { 29 - open } else { 17 - open },
        refused: 0,
        level: Some(Level::Exact),
        found: found.then(|| {
            Box::new(AtlasFound { extent: [2, 1], cell: cell.clone(), exhibit: place.exhibit(laplacian, property) })
        }),
    };
    vec![
        line("cotan", "POS", 0, true),
        line("graph", "LIN", 2, true),
        line("cotan:mass=voronoi", "MASS", 0, true),
        line("cotan:mass=unit", "MASS", 0, true),
        line("cotan", "SYM", 0, false),
    ]
}

/// Two operators, three properties, two domains.
pub fn tiny() -> Record {
    let mut record = Record::new(header("tiny"));
    let (kite, grid) = (kite(), grid(3));
    record.domains = vec![kite.line(), grid.line()];
    let fails = || {
        let (_, statement, excerpt) = witnesses().swap_remove(5);
        Verdict::fails(Level::Exact, Evidence::new(statement, excerpt))
    };
    let mut add = |place: &Place, laplacian: &str, property: &str, verdict| {
        record.cells.push(cell(&place.recipe, &place.class, laplacian, property, verdict));
    };
    for place in [&kite, &grid] {
        add(place, "graph", "SYM", scan(0.1));
        add(place, "graph", "LIN", Verdict::not_applicable("no flat interior vertex"));
        add(place, "cotan", "SYM", scan(0.2));
    }
    add(&kite, "cotan", "POS", fails());
    add(&grid, "cotan", "POS", scan(0.3));
    add(&grid, "cotan", "LIN", Verdict::undecided("the residual is 40 roundings"));
    record.cells[6].as_expected = false;
    record.cells[6].promised = Some(true);
    record.exhibits = vec![kite.exhibit("cotan", "POS")];
    record.claims = claims().into_iter().take(3).collect();
    record.atlas = atlas(&kite, &record.cells[5]);
    Record::parse(&written(&record)).unwrap()
}

/// About seventy thousand cells, as a nightly run has them.
pub fn large() -> Record {
    let mut record = Record::new(header("nightly"));
    let (kite, grid) = (kite(), grid(3));
    let witnesses = witnesses();
    for k in 0..370 {
        let place = if k % 2 == 0 { &kite } else { &grid };
        let recipe = format!("perturbed-grid(n=12, amplitude=0.35, seed={k})");
        let class = format!("class {}", k % 12);
        record.domains.push(DomainLine { recipe: recipe.clone(), class: class.clone(), ..place.line() });
        for (l, laplacian) in OPERATORS.iter().enumerate() {
            for (p, (property, statement, excerpt)) in witnesses.iter().enumerate() {
                let verdict = match (l * p + k) % 5 {
                    0 => Verdict::fails(Level::Exact, Evidence::new(statement.clone(), excerpt.clone())),
                    _ => scan(0.5 / (1 + k) as f64),
                };
                record.cells.push(cell(&recipe, &class, laplacian, property, verdict));
            }
        }
    }
    for laplacian in OPERATORS {
        record.exhibits.extend(witnesses.iter().map(|w| sphere().exhibit(laplacian, w.0)));
    }
    record
}

/// A statement of each kind about a triangulation: the star of a vertex in a square, its numbers for show.
pub fn weighings() -> Vec<lapjury::property::Evidence> {
    let number = |x: i64| Fraction::text(x.to_string());
    let positions: Vec<(usize, [f64; 3])> = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [0.0, 0.0]]
        .map(|[x, y]| [x, y, 0.0])
        .into_iter()
        .enumerate()
        .collect();
    let excerpt =
        Excerpt { positions, faces: (0..4).map(|k| (k, vec![k, (k + 1) % 4, 4])).collect(), ..Excerpt::default() };
    let spokes = |x: i64| (0..4).map(|k| ([k, 4], number(x))).collect::<Vec<_>>();
    let heights = (0..5).map(|v| (v, number(i64::from(v < 4)))).collect();
    [
        Statement::Lift { heights, weights: spokes(1) },
        Statement::Equilibrium { weights: spokes(2) },
        Statement::Motion { motion: vec![(4, [number(1), number(-2)])], rates: spokes(3) },
        Statement::NoLift { beside: true, multipliers: vec![(0, 2, number(1)), (1, 3, number(1))] },
    ]
    .into_iter()
    .map(|statement| lapjury::property::Evidence::new(statement, excerpt.clone()))
    .collect()
}
