//! Rippa's theorem for eigenvalues: of all triangulations of points in the plane, is the i-th eigenvalue smallest on the Delaunay
//! triangulation?
//!
//! # Where it follows
//! `L_T − L_D` is positive semi-definite ([`rippa-in-the-plane`](super::rippa_in_the_plane)), so with one mass M for both
//! `λ_i(L_T, M) ≥ λ_i(L_D, M)` by the min-max principle, with the rows of the boundary and without. That is so for `M = I`, and for
//! every other mass that the points determine.
//!
//! # Where it does not
//! Barycentric and consistent masses are those of a triangulation: a flip makes some heavier, and an eigenvalue falls. The smallest
//! point sets on which that happens are found by trying all.
//!
//! # How it is decided
//! The characteristic polynomials of both problems are computed over the rationals. All of their roots are real; Sturm's chain of the
//! product separates them, and between neighbours Descartes' rule counts those of each. The order of the i-th roots is right for all
//! i exactly where the Delaunay triangulation has nowhere fewer of them below. On larger random meshes the counts are inertias at
//! some rational numbers.

use super::poll::{Case, Every};
use super::world::descent::Descent;
use super::world::triangulations::{
    Point, Triangulation, describe_world, doubled_area, point_sets, sweep, triangulations,
};
use super::{Experiment, Finding, Setting};
use crate::domain::Surface;
use crate::figure::{Figure, Sketch};
use crate::generate::Stream;
use crate::laplacian::cotan::stiffness_in_plane;
use crate::laplacian::mass;
use crate::linalg::factor::symmetric_eigen;
use crate::linalg::pencil::{Pencil, out_of_order, simplest};
use crate::linalg::{Csr, Polynomial};
use crate::operator::MassKind;
use crate::property::evidence::{Condition, Fraction, Weighting};
use crate::property::{Evidence, Excerpt, Statement};
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "spectral-rippa",
    name: "The eigenvalues of the Delaunay triangulation",
    statement: "λ_i(T) ≥ λ_i(D) for every i, T any triangulation of the points and D the Delaunay one, for L alone and with a mass that \
                does not depend on the triangulation; not with the barycentric or the consistent mass",
    sources: &["wardetzky-primer", "rippa1990", "chen2010"],
    parts: &[
        "stiffness-alone-neumann",
        "stiffness-alone-dirichlet",
        "fixed-mass-neumann",
        "fixed-mass-dirichlet",
        "random-meshes",
        "barycentric-neumann",
        "barycentric-dirichlet",
        "consistent-neumann",
        "consistent-dirichlet",
    ],
    run,
};

/// A triangulation with its matrices.
struct Meshed {
    triangulation: Triangulation,
    stiffness: Csr<Rational>,
    inside: Vec<usize>,
}

impl Meshed {
    fn of(triangulation: Triangulation) -> Option<Self> {
        let stiffness = stiffness_in_plane::<Rational>(&triangulation.surface())?;
        let boundary = triangulation.boundary();
        let inside = (0..boundary.len()).filter(|&v| !boundary[v]).collect();
        Some(Meshed { triangulation, stiffness, inside })
    }

    fn rows(&self, condition: Condition) -> Vec<usize> {
        match condition {
            Condition::Dirichlet => self.inside.clone(),
            Condition::Neumann => (0..self.stiffness.rows()).collect(),
        }
    }

    fn pencil(&self, mass: &Csr<Rational>, condition: Condition) -> Option<Pencil> {
        Pencil::of(&self.stiffness, mass, &self.rows(condition))
    }

    fn own_mass(&self, kind: MassKind) -> Option<Csr<Rational>> {
        mass::in_plane(&self.triangulation.surface(), kind)
    }

    /// Whether every circle of a triangle has all other points strictly outside: the only Delaunay triangulation.
    fn is_strictly_delaunay(&self) -> bool {
        let p = self.triangulation.points();
        self.triangulation
            .faces()
            .iter()
            .all(|f| (0..p.len()).filter(|d| !f.contains(d)).all(|d| incircle(p, [f[0], f[1], f[2], d]) < 0))
    }

    fn is_delaunay(&self) -> bool {
        let p = self.triangulation.points();
        self.triangulation.faces().iter().all(|f| (0..p.len()).all(|d| incircle(p, [f[0], f[1], f[2], d]) <= 0))
    }
}

/// The in-circle determinant in whole numbers.
fn incircle(p: &[Point], [a, b, c, d]: [usize; 4]) -> i64 {
    let square = |v: usize| (0..2).map(|k| (p[v][k] - p[d][k]).pow(2)).sum::<i64>();
    let area = |x: usize, y: usize| doubled_area(p[d], p[x], p[y]);
    square(a) * area(b, c) + square(b) * area(c, a) + square(c) * area(a, b)
}

const CONDITIONS: [Condition; 2] = [Condition::Neumann, Condition::Dirichlet];

/// The masses that a triangulation has of its own.
const OWN: [(MassKind, Weighting); 2] =
    [(MassKind::Barycentric, Weighting::Barycentric), (MassKind::Consistent, Weighting::Consistent)];

#[derive(Default)]
struct Polls {
    /// M = I, by condition.
    alone: [Every; 2],
    /// A random mass for each point.
    fixed: [Every; 2],
    /// Barycentric and consistent, each by condition, with the pictures of the first exception.
    own: [[(Every, Vec<Figure>); 2]; 2],
    random: Every,
}

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let mut polls = Polls::default();
    // Problems with as many rows as points are asked in a smaller world; those of the one or two vertices inside in all of it.
    let (largest, side) = (5, setting.pick(2, 3) as i64);
    for points in (4..=largest).flat_map(|n| point_sets(n, 3)) {
        let width = points.iter().map(|p| p[0]).max().unwrap_or(0);
        let conditions = if width <= side { &CONDITIONS[..] } else { &CONDITIONS[1..] };
        polls.ask(&points, conditions, &mut stream);
    }
    for _ in 0..setting.pick(2, 12) {
        polls.at_random(6 + stream.below(setting.pick(3, 5)), &mut stream);
    }
    let world = describe_world(largest);
    polls.answer([&world.replace("4 × 4", &format!("{0} × {0}", side + 1)), &world])
}

impl Polls {
    /// Every other triangulation of some points against the Delaunay one.
    fn ask(&mut self, points: &[Point], conditions: &[Condition], stream: &mut Stream) {
        let all: Vec<Meshed> = triangulations(points).into_iter().filter_map(Meshed::of).collect();
        let Some(delaunay) = all.iter().find(|t| t.is_delaunay()).filter(|_| all.len() > 1) else { return };
        let unit = Csr::diagonal(&vec![Rational::ONE; points.len()]);
        let drawn: Vec<Rational> = points.iter().map(|_| Rational::from(1 + stream.below(9) as u64)).collect();
        let fixed = Csr::diagonal(&drawn);
        let only = delaunay.is_strictly_delaunay();
        for &condition in conditions {
            let k = usize::from(condition == Condition::Dirichlet);
            if delaunay.rows(condition).is_empty() {
                continue;
            }
            for (poll, mass) in [(&mut self.alone[k], &unit), (&mut self.fixed[k], &fixed)] {
                each(
                    delaunay,
                    &all,
                    condition,
                    |_| Some(mass.clone()),
                    |answer| {
                        poll.ask(answer.map(|(other, t)| Case::told(told(delaunay, other, &t))));
                    },
                );
            }
            for (m, (kind, weighting)) in OWN.into_iter().enumerate().filter(|_| only) {
                let (poll, figures) = &mut self.own[m][k];
                each(
                    delaunay,
                    &all,
                    condition,
                    |mesh| mesh.own_mass(kind),
                    |answer| {
                        let case = answer.map(|(other, t)| {
                            if figures.is_empty() {
                                *figures = vec![sketch(delaunay, "Delaunay"), sketch(other, "the other triangulation")];
                            }
                            shown([delaunay, other], condition, (kind, weighting), &t)
                        });
                        poll.ask(case);
                    },
                );
            }
        }
    }

    /// A triangulation of random points against the Delaunay one at numbers between its eigenvalues, by inertia.
    fn at_random(&mut self, n: usize, stream: &mut Stream) {
        let mut points: Vec<Point> = Vec::new();
        while points.len() < n {
            let p = [stream.below(40) as i64, stream.below(40) as i64];
            if !points.contains(&p) {
                points.push(p);
            }
        }
        let Some(start) = sweep(&points) else { return };
        let Some(end) = Descent::of(start.surface()).ok().and_then(|descent| end(&start, &descent)) else {
            return self.random.ask(Some(Case::told(format!("no flips to Delaunay of {points:?}"))));
        };
        let (Some(other), Some(delaunay)) = (Meshed::of(start), Meshed::of(end)) else { return };
        let unit = Csr::diagonal(&vec![Rational::ONE; n]);
        let fixed =
            Csr::diagonal(&(0..n).map(|_| Rational::from(1 + stream.below(9) as u64)).collect::<Vec<Rational>>());
        for (condition, mass) in CONDITIONS.into_iter().flat_map(|c| [(c, &unit), (c, &fixed)]) {
            let [Some(d), Some(t)] = [&delaunay, &other].map(|mesh| mesh.pencil(mass, condition)) else { continue };
            for sigma in probes(&d) {
                let (on_delaunay, on_other) = (d.inertia(&sigma), t.inertia(&sigma));
                let fewer = on_delaunay.negative < on_other.negative
                    || on_delaunay.negative + on_delaunay.zero < on_other.negative + on_other.zero;
                self.random.ask(fewer.then(|| Case::told(told(&delaunay, &other, &sigma))));
            }
        }
    }

    fn answer(self, [world, whole]: [&str; 2]) -> Vec<Finding> {
        let p = ENTRY.parts;
        let ask = |what: &str| {
            let cases = if what.contains("Dirichlet") { whole } else { world };
            format!("Is λ_i(T) ≥ λ_i(D) for every i, {what}? Cases: {cases}.")
        };
        let others = "pairs of a triangulation and the Delaunay one of the same points";
        let [alone, alone_inside] = self.alone;
        let [fixed, fixed_inside] = self.fixed;
        let [barycentric, consistent] = self.own;
        let mut findings = vec![
            alone.answer(p[0], ask("for M = I, Neumann"), others),
            alone_inside.answer(p[1], ask("for M = I, Dirichlet"), others),
            fixed.answer(p[2], ask("for a random mass at each point, the same for all triangulations, Neumann"), others),
            fixed_inside.answer(p[3], ask("for a random mass at each point, the same for all, Dirichlet"), others),
            self.random.answer(
                p[4],
                "Does L_T − σM never have more negative eigenvalues than L_D − σM, for M = I and for random masses, Neumann and Dirichlet?",
                "numbers σ between the eigenvalues of random meshes",
            ),
        ];
        let named = ["barycentric", "consistent"].into_iter().flat_map(|m| ["Neumann", "Dirichlet"].map(|c| (m, c)));
        let polls = barycentric.into_iter().chain(consistent);
        for (((poll, figures), (mass, condition)), part) in polls.zip(named).zip(&p[5..]) {
            let question =
                ask(&format!("with the {mass} mass, {condition}, the Delaunay triangulation being the only one"));
            let mut finding = poll.answer(part, question, others);
            finding.figures = figures;
            findings.push(finding);
        }
        findings
    }
}

/// The faces at the end of the flips.
fn end(start: &Triangulation, descent: &Descent) -> Option<Triangulation> {
    let t = Triangulation::new(start.points(), descent.end.clone());
    let positive = |f: &[usize; 3]| doubled_area(t.points()[f[0]], t.points()[f[1]], t.points()[f[2]]) > 0;
    t.faces().iter().all(positive).then_some(t)
}

/// Asks of each triangulation but the Delaunay one whether an eigenvalue is smaller; the answer is the triangulation with a number
/// below which it has more of them.
fn each<'a>(
    delaunay: &Meshed,
    all: &'a [Meshed],
    condition: Condition,
    mass: impl Fn(&Meshed) -> Option<Csr<Rational>>,
    mut answer: impl FnMut(Option<(&'a Meshed, Rational)>),
) {
    let polynomial =
        |mesh: &Meshed| -> Option<Polynomial<Rational>> { mesh.pencil(&mass(mesh)?, condition)?.characteristic() };
    let Some(smallest) = polynomial(delaunay) else { return };
    for other in all.iter().filter(|t| t.triangulation != delaunay.triangulation) {
        if let Some(found) = polynomial(other) {
            answer(out_of_order(&smallest, &found).map(|t| (other, t)));
        }
    }
}

/// Numbers near the middle between neighbouring eigenvalues, from floating point, multiples of 2⁻¹⁰.
fn probes(pencil: &Pencil) -> Vec<Rational> {
    let n = pencil.size();
    let half = |i: usize| pencil.mass().at(i, i).approximate().sqrt();
    let entries: Vec<_> = (0..n * n)
        .map(|k| (k / n, k % n, pencil.stiffness().at(k / n, k % n).approximate() / (half(k / n) * half(k % n))))
        .collect();
    let values = symmetric_eigen(&Csr::from_triplets(n, n, &entries)).map(|found| found.0).unwrap_or_default();
    let middles = values.windows(2).map(|w| 0.5 * (w[0] + w[1])).chain(values.last().map(|v| v + 0.5));
    middles.filter_map(|x| Rational::exactly((x * 1024.0).round() / 1024.0)).collect()
}

fn told(delaunay: &Meshed, other: &Meshed, t: &Rational) -> String {
    let faces: Vec<String> =
        other.triangulation.faces().iter().map(|f| format!("{}-{}-{}", f[0], f[1], f[2])).collect();
    format!("more eigenvalues below {t} on {} than on Delaunay, {}", faces.join(" "), delaunay.triangulation.describe())
}

/// The exception with its witness: a simple number below which there are more.
fn shown(meshes: [&Meshed; 2], condition: Condition, (kind, mass): (MassKind, Weighting), t: &Rational) -> Case {
    let [delaunay, other] = meshes;
    let pencils = meshes.map(|mesh| mesh.own_mass(kind).and_then(|m| mesh.pencil(&m, condition)));
    let [Some(d), Some(o)] = pencils else { return Case::told(told(delaunay, other, t)) };
    let separates = |t: &Rational| {
        let (a, b) = (d.inertia(t), o.inertia(t));
        (a.zero, b.zero) == (0, 0) && a.negative < b.negative
    };
    let sigma = simplest(t, 256, separates).unwrap_or_else(|| t.clone());
    let determinant = |p: &Pencil| {
        let value = Polynomial::characteristic(&p.shifted(&sigma)).at(&Rational::ZERO);
        Fraction::from(&if p.size().is_multiple_of(2) { value } else { -value })
    };
    let statement = Statement::DelaunayEigenvalue {
        other: other.triangulation.faces().to_vec(),
        condition,
        mass,
        sigma: Fraction::from(&sigma),
        below: [d.inertia(&sigma).negative, o.inertia(&sigma).negative],
        determinants: [determinant(&d), determinant(&o)],
    };
    let positions = delaunay.triangulation.points().iter().map(|&[x, y]| [x as f64, y as f64, 0.0]).enumerate();
    let faces = delaunay.triangulation.faces().iter().map(|f| f.to_vec()).enumerate();
    let excerpt = Excerpt { positions: positions.collect(), faces: faces.collect(), ..Excerpt::default() };
    Case::shown(told(delaunay, other, &sigma), Evidence::new(statement, excerpt))
}

fn sketch(mesh: &Meshed, what: &str) -> Figure {
    let surface: Surface = mesh.triangulation.surface();
    Figure::Sketch(Sketch {
        title: format!("The smallest exception: {what}"),
        points: surface.positions().to_vec(),
        faces: surface.faces().iter().map(<[usize]>::to_vec).collect(),
        edges: Vec::new(),
        values: Vec::new(),
        marked: Vec::new(),
    })
}
