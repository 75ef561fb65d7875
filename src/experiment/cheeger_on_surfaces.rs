//! Cheeger's and Buser's inequalities on surfaces: where both numbers are known in closed form, and where sweeps bound them.
//!
//! # Definitions
//! The constants, with their proofs or sources, are in `known`: closed surfaces, as the primer has it, and planar ones with free
//! and with fixed boundary. Cheeger's inequality is `λ_C²/4 ≤ λ₁`. Buser's is `λ₁ ≤ 2 (n − 1) K λ_C + 10 λ_C²` for closed
//! surfaces of dimension n with `Ric ≥ −(n − 1) K²` [Buser 1982, theorem 1.2]; so `λ₁ ≤ 10 (K λ_C + λ_C²)` for n = 2, the form of the primer.
//! All closed surfaces here have K = 0: for none of negative curvature is λ_C known to us, and the term with K is not put to
//! the test.
//!
//! # How it is decided
//! * In closed form, in `f64` with all roundings covered.
//! * On meshes: λ₁ of linear elements with the mass of linear elements, with a bound of its error and an inertia count that no smaller
//!   one is missing. Where the mesh is the surface it is at least the smooth eigenvalue.
//! * Sweeps: level sets of the first eigenfunction, piecewise straight, so that length and areas are those of a true cut of the
//!   mesh, up to rounding, which is bounded. Each is an upper bound of the constant of the mesh, and by a stated factor of that of the
//!   smooth surface. By the coarea formula the best level set of *any* function has a ratio of at most `2 √R`, R its Rayleigh quotient with exact
//!   integrals: `λ_C²/4 ≤ λ₁` on every mesh, with the cut as the certificate.
//! * A constant too large is below one of the cuts; one too small, or a wrong eigenvalue, is not the limit under refinement.

mod isoline;
mod known;
mod neck;
mod patchwork;

use rayon::prelude::*;

use super::poll::{Case, Every};
use super::{Experiment, Finding, Setting};
use crate::figure::{Axis, Chart, Figure, Mark, Series, Sketch};
use crate::property::Level;
use isoline::{Cut, sweep};
use known::Known;
use patchwork::{Boundary, Patchwork};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "cheeger-on-surfaces",
    name: "Cheeger's and Buser's inequalities on surfaces",
    statement: "λ_C²/4 ≤ λ₁ on closed surfaces, with free and with fixed boundary, and λ₁ ≤ 10 λ_C² on closed surfaces without \
                negative curvature, where λ_C is known; sweeps over level sets of the first eigenfunction bound λ_C from above, \
                tend to it where a level set is optimal, and cut a dumbbell at its neck",
    sources: &[
        "wardetzky-primer",
        "cheeger1970",
        "buser1982",
        "osserman1978",
        "howards-hutchings-morgan1999",
        "burago-mazya1969",
        "kawohl-lachand-robert2006",
        "chavel1984",
        "mccartin2003",
    ],
    parts: &[
        "lower-bound-in-closed-form",
        "lower-bound-on-meshes",
        "eigenvalues-converge",
        "sweep-cuts-bound-above",
        "sweep-cuts-converge",
        "sweep-cuts-certify-the-lower-bound",
        "buser-in-closed-form",
        "buser-on-meshes",
        "dumbbells-are-cut-at-the-neck",
    ],
    run,
};

/// No closed form here has more than thirty operations, and none cancels.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Orders of convergence that are taken for two.
const ORDER_TWO: [f64; 2] = [1.5, 2.5];

/// The numbers in Buser's inequality: of `K λ_C`, and of `λ_C²`.
const BUSER: [f64; 2] = [2.0, 10.0];

/// A mesh with its first eigenvalue and the best level set.
struct Step {
    size: f64,
    factor: f64,
    eigenvalue: f64,
    error: f64,
    certified: bool,
    cut: Cut,
}

/// A surface with its meshes, refined.
struct Study {
    known: Known,
    steps: Vec<Step>,
}

impl Study {
    fn of(known: Known, levels: std::ops::Range<usize>) -> Result<Self, String> {
        let steps = levels.map(|level| step(&known, level)).collect::<Result<_, _>>();
        steps.map(|steps| Study { steps, known }).map_err(|why| why.to_string())
    }

    fn told(&self, text: String) -> Case {
        Case::told(format!("{}: {text}", self.known.name))
    }

    fn last(&self) -> Option<&Step> {
        self.steps.last()
    }
}

fn step(known: &Known, level: usize) -> Result<Step, String> {
    let missing = || format!("{}: no mesh of level {level}", known.name);
    let mesh = (known.mesh)(level).ok_or_else(missing)?;
    let modes = mesh.modes(known.boundary, known.copies).map_err(|e| format!("{}: {e}", known.name))?;
    let u = match known.guide {
        Some(guide) => mesh.nearest(&modes, guide),
        None => modes.vectors[0].clone(),
    };
    let cut = sweep(&mesh, &u, known.boundary).ok_or_else(|| format!("{}: no level set cuts", known.name))?;
    Ok(Step {
        size: mesh.size(),
        factor: known.likeness.factor(&mesh),
        eigenvalue: modes.values[0],
        error: modes.error,
        certified: modes.certified,
        cut,
    })
}

/// The order of convergence over the last refinement by two; `None` with fewer than two errors.
fn order(errors: &[f64]) -> Option<f64> {
    let [.., before, last] = errors else { return None };
    Some((before / last).log2())
}

#[derive(Default)]
struct Polls {
    closed_form: Every,
    meshes: Every,
    eigenvalues: Every,
    above: Every,
    tending: Every,
    certified: Every,
    buser: Every,
    buser_meshes: Every,
}

impl Polls {
    fn ask(&mut self, study: &Study, [linear, quadratic]: [f64; 2]) {
        let (known, h) = (&study.known, study.known.constant());
        let bound = 0.25 * h * h;
        let wrong = bound * (1.0 + ROUNDING) > known.eigenvalue * (1.0 - ROUNDING);
        self.closed_form.ask(wrong.then(|| study.told(format!("λ_C²/4 = {bound} and λ₁ = {}", known.eigenvalue))));
        // Ric ≥ 0: K = 0.
        let buser = linear * 0.0 * h + quadratic * h * h;
        if known.boundary == Boundary::Closed {
            let wrong = known.eigenvalue * (1.0 + ROUNDING) > buser * (1.0 - ROUNDING);
            self.buser.ask(wrong.then(|| study.told(format!("λ₁ = {} and the bound {buser}", known.eigenvalue))));
        }
        for step in &study.steps {
            self.ask_mesh(study, step, bound, buser);
        }
        self.ask_limits(study);
    }

    fn ask_mesh(&mut self, study: &Study, step: &Step, bound: f64, buser: f64) {
        let (known, h) = (&study.known, study.known.constant());
        let [low, high] = [step.eigenvalue - step.error, step.eigenvalue + step.error];
        let below = known.likeness.is_from_above() && high < known.eigenvalue * (1.0 - ROUNDING);
        let wrong = !step.certified || low < bound * (1.0 + ROUNDING) || below;
        let told = |bound: f64| {
            study.told(format!("λ₁ of the mesh is {} ± {:e}, the bound {bound}", step.eigenvalue, step.error))
        };
        self.meshes.ask(wrong.then(|| told(if below { known.eigenvalue } else { bound })));
        if known.boundary == Boundary::Closed {
            self.buser_meshes.ask((!step.certified || high > buser * (1.0 - ROUNDING)).then(|| told(buser)));
        }
        let (least, floor) = (step.cut.at_least(), step.factor * h * (1.0 - ROUNDING));
        // The true ratio of this cut is known up to rounding: it must not be below the constant as a whole.
        let better = step.cut.at_most() < floor;
        self.above.ask(better.then(|| study.told(format!("a cut with {} ({least}), below {floor}", step.cut.ratio()))));
        self.certify(known.name, &step.cut, step.eigenvalue, step.error, step.certified);
    }

    /// Whether a cut shows that `λ_C²/4 ≤ λ₁` on its mesh.
    fn certify(&mut self, name: &str, cut: &Cut, eigenvalue: f64, error: f64, certified: bool) {
        let ratio = cut.at_most();
        let shows = certified && 0.25 * ratio * ratio <= eigenvalue - error;
        self.certified
            .ask((!shows).then(|| Case::told(format!("{name}: the best level set has {ratio}, λ₁ = {eigenvalue}"))));
    }

    /// Whether eigenvalues and, where a level set is optimal, cuts tend to what they should.
    fn ask_limits(&mut self, study: &Study) {
        let (known, h) = (&study.known, study.known.constant());
        let relative = |x: f64, limit: f64| (x / limit - 1.0).abs();
        let errors: Vec<f64> = study.steps.iter().map(|s| relative(s.eigenvalue, known.eigenvalue)).collect();
        let found = order(&errors);
        let two = found.is_some_and(|p| (ORDER_TWO[0]..=ORDER_TWO[1]).contains(&p));
        self.eigenvalues.ask((!two).then(|| study.told(format!("order {found:?}, errors {errors:?}"))));
        if known.guide.is_none() {
            return;
        }
        let errors: Vec<f64> = study.steps.iter().map(|s| relative(s.cut.ratio(), h)).collect();
        // An optimal line that the mesh contains is found up to the accuracy of the eigenfunction and of the sums.
        let floor = |s: &Step| 16.0 * s.error / s.eigenvalue + relative(s.cut.at_most(), s.cut.at_least());
        let exact = study.steps.iter().zip(&errors).all(|(s, e)| *e <= floor(s));
        let tends = exact || order(&errors).is_some_and(|p| p >= 1.0);
        self.tending.ask((!tends).then(|| study.told(format!("relative errors {errors:?}"))));
    }

    fn answer(self, studies: &[Study], neck: Finding) -> Vec<Finding> {
        let count = studies.len();
        let surfaces = format!("surfaces with known constant ({} closed)", closed(studies).count());
        let meshes = format!("meshes of {count} {surfaces}");
        let parts: [&'static str; 9] = std::array::from_fn(|k| ENTRY.parts[k]);
        let mut findings = vec![
            self.closed_form.answer(parts[0], "Is λ_C²/4 ≤ λ₁, both in closed form?", &surfaces),
            self.meshes.answer(
                parts[1],
                "Is λ_C²/4 ≤ λ₁ of the mesh, counted by inertia, and is that no less than the smooth λ₁ where the mesh is the surface?",
                &meshes,
            ),
            self.eigenvalues.answer(parts[2], "Does λ₁ of the meshes tend to the closed form with order two?", &surfaces),
            self.above.answer(parts[3], "Is no sweep cut better than the known constant allows?", &meshes),
            self.tending.answer(
                parts[4],
                "Do the sweep cuts tend to the known constant?",
                "surfaces where a level set of an eigenfunction is an optimal cut",
            ),
            self.certified.answer(
                parts[5],
                "Has the best level set of the first eigenfunction a ratio of at most 2√λ₁, so that λ_C²/4 ≤ λ₁ on the mesh?",
                "meshes, dumbbells and surfaces of genus 1 to 3 among them",
            ),
            self.buser.answer(parts[6], "Is λ₁ ≤ 10 λ_C², both in closed form?", "closed surfaces without negative curvature"),
            self.buser_meshes.answer(parts[7], "Is λ₁ of the mesh ≤ 10 λ_C²?", "meshes of closed surfaces without negative curvature"),
            neck,
        ];
        let levels = [
            Level::Bounded,
            Level::Bounded,
            Level::Measured,
            Level::Bounded,
            Level::Measured,
            Level::Bounded,
            Level::Bounded,
            Level::Bounded,
            Level::Measured,
        ];
        findings.iter_mut().zip(levels).for_each(|(finding, level)| finding.level = level);
        findings[0].finding.push_str(&table(studies));
        findings[0].figures.push(Figure::Chart(sandwich(studies)));
        findings[2].finding.push_str(&orders(studies));
        findings[3].finding.push_str(&sweeps(studies));
        findings[4].figures.push(Figure::Chart(convergence(studies)));
        findings[6].finding.push_str(&quotients(studies));
        findings
    }
}

fn closed(studies: &[Study]) -> impl Iterator<Item = &Study> {
    studies.iter().filter(|s| s.known.boundary == Boundary::Closed)
}

fn table(studies: &[Study]) -> String {
    let row = |s: &Study| {
        let (k, h) = (&s.known, s.known.constant());
        format!("; {}: λ_C = {h:.6}, λ_C²/4 = {:.6}, λ₁ = {:.6}", k.name, 0.25 * h * h, k.eigenvalue)
    };
    studies.iter().map(row).collect()
}

fn orders(studies: &[Study]) -> String {
    let row = |s: &Study| {
        let errors: Vec<f64> = s.steps.iter().map(|t| (t.eigenvalue / s.known.eigenvalue - 1.0).abs()).collect();
        let last = errors.last().copied().unwrap_or(f64::NAN);
        format!("; {}: order {:.2}, error {last:.1e}", s.known.name, order(&errors).unwrap_or(f64::NAN))
    };
    studies.iter().map(row).collect()
}

fn sweeps(studies: &[Study]) -> String {
    let row = |s: &Study| {
        let last = s.last().map_or(f64::NAN, |t| t.cut.ratio());
        format!("; {}: λ_C = {:.6}, best level set {last:.6}", s.known.name, s.known.constant())
    };
    studies.iter().map(row).collect()
}

fn quotients(studies: &[Study]) -> String {
    let quotient = |s: &Study| s.known.eigenvalue / s.known.constant().powi(2);
    let rows: String = closed(studies).map(|s| format!("; {}: λ₁/λ_C² = {:.6}", s.known.name, quotient(s))).collect();
    rows + "; K = 0 on all of them, so that the term with K is not tested"
}

/// Constants and best cuts over the eigenvalue, below Cheeger's line and above Buser's.
fn sandwich(studies: &[Study]) -> Chart {
    let eigenvalues = || studies.iter().map(|s| s.known.eigenvalue);
    let ends = [eigenvalues().fold(f64::INFINITY, f64::min), eigenvalues().fold(0.0, f64::max)];
    let known = |boundary: Boundary| {
        let chosen = studies.iter().filter(move |s| s.known.boundary == boundary);
        chosen.map(|s| [s.known.eigenvalue, s.known.constant()])
    };
    let swept = studies.iter().filter_map(|s| Some([s.known.eigenvalue, s.last()?.cut.ratio()]));
    let series = vec![
        Series::new("2 √λ₁: Cheeger's upper end", Mark::Reference, ends.map(|x| [x, 2.0 * x.sqrt()])),
        Series::new("√(λ₁/10): Buser's lower end, closed", Mark::Reference, ends.map(|x| [x, (0.1 * x).sqrt()])),
        Series::new("best level set", Mark::Dots, swept),
        Series::new("λ_C, closed", Mark::Dots, known(Boundary::Closed)),
        Series::new("λ_C, free boundary", Mark::Dots, known(Boundary::Free)),
        Series::new("λ_C, fixed boundary", Mark::Dots, known(Boundary::Fixed)),
    ];
    let (x, y) = (Axis::logarithmic("λ₁"), Axis::logarithmic("λ_C"));
    Chart { title: "Cheeger constants of surfaces between their bounds".into(), x, y, series }
}

/// Excess of the best level set over the constant, by the size of the triangles.
fn convergence(studies: &[Study]) -> Chart {
    let line = |s: &Study| {
        let h = s.known.constant();
        let points: Vec<[f64; 2]> = s.steps.iter().map(|t| [t.size, t.cut.ratio() / h - 1.0]).collect();
        // Lines that the mesh contains are exact up to rounding, and have no place on a logarithmic axis.
        let is_seen = points.iter().all(|p| p[1] > f64::from(f32::EPSILON));
        is_seen.then(|| Series::new(s.known.name, Mark::Both, points))
    };
    let series = studies.iter().filter_map(line).collect();
    let (x, y) =
        (Axis::logarithmic("side of a square of a triangle's mean area"), Axis::logarithmic("ratio / λ_C − 1"));
    Chart { title: "Best level sets under refinement".into(), x, y, series }
}

/// A mesh with a function as its colours and a cut drawn bold.
fn sketch(title: String, mesh: &Patchwork, u: &[f64], cut: &Cut) -> Sketch {
    let (mut points, mut values, mut marked) = (mesh.positions.clone(), u.to_vec(), Vec::new());
    for ends in cut.points(mesh) {
        let first = points.len();
        points.extend(ends);
        values.extend([cut.level; 2]);
        marked.push([first, first + 1]);
    }
    let faces = mesh.faces.iter().map(|f| f.to_vec()).collect();
    Sketch { title, points, faces, edges: Vec::new(), values, marked }
}

/// The best level set of the square with fixed boundary: near the square with rounded corners.
fn drawn_square() -> Option<Figure> {
    let square = known::all().into_iter().find(|k| k.boundary == Boundary::Fixed && k.name.starts_with("square"))?;
    let mesh = (square.mesh)(1)?;
    let modes = mesh.modes(square.boundary, 1).ok()?;
    let cut = sweep(&mesh, &modes.vectors[0], square.boundary)?;
    let title = format!(
        "Square with fixed boundary: the best level set of the first eigenfunction, {:.4}, where λ_C is {:.4}",
        cut.ratio(),
        square.constant()
    );
    Some(Figure::Sketch(sketch(title, &mesh, &modes.vectors[0], &cut)))
}

fn run(setting: &Setting) -> Vec<Finding> {
    let levels = 0..setting.pick(3, 4);
    let studied: Vec<Result<Study, String>> =
        known::all().into_par_iter().map(|known| Study::of(known, levels.clone())).collect();
    let mut polls = Polls::default();
    let mut studies = Vec::new();
    for study in studied {
        match study {
            Ok(study) => {
                polls.ask(&study, BUSER);
                studies.push(study);
            }
            Err(why) => polls.meshes.ask(Some(Case::told(why))),
        }
    }
    let necks = neck::run(setting, &mut polls);
    let mut findings = polls.answer(&studies, necks);
    findings[3].figures.extend(drawn_square());
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    fn study(name: &str) -> Study {
        Study::of(known::all().into_iter().find(|k| k.name.starts_with(name)).unwrap(), 0..3).unwrap()
    }

    /// Which of the first eight questions are answered with yes when something is changed on a surface.
    fn answers(study: &mut Study, buser: [f64; 2], change: impl Fn(&mut Known)) -> [bool; 8] {
        let as_it_is = study.known.clone();
        change(&mut study.known);
        let mut polls = Polls::default();
        polls.ask(study, buser);
        let findings = polls.answer(std::slice::from_ref(study), Every::default().answer("", "", ""));
        study.known = as_it_is;
        std::array::from_fn(|k| findings[k].agrees || findings[k].decided == 0)
    }

    #[test]
    fn every_surface_agrees_as_it_is_and_disagrees_with_another_constant_or_eigenvalue() {
        for known in known::all() {
            let name = known.name;
            let mut study = study(name);
            let mut all = |change: &dyn Fn(&mut Known)| answers(&mut study, BUSER, change);
            assert_eq!(all(&|_| ()), [true; 8], "{name}");
            // An eigenvalue that is off by five in a hundred is no limit of the meshes' eigenvalues.
            for factor in [0.95, 1.05] {
                assert!(!all(&|k| k.eigenvalue *= factor)[2], "{name} {factor}");
            }
            // Five times the constant is against Cheeger's inequality; a tenth more is above a cut.
            assert!(!all(&|k| k.length *= 5.0)[0], "{name}");
            assert!(!all(&|k| k.length *= 1.1)[3], "{name}");
            if known.guide.is_some() {
                assert!(!all(&|k| k.length *= 0.97)[4], "{name}");
            }
        }
    }

    #[test]
    fn a_smaller_number_than_ten_is_enough_on_these_surfaces_and_two_is_not() {
        // λ₁/λ_C² is 2 on the sphere and π²/4 on every flat torus.
        for (name, enough, too_small) in [
            ("sphere", 2.01, 1.99),
            ("flat torus", 2.47, 2.46),
            ("square torus", 2.47, 2.46),
            ("hexagonal", 2.47, 2.46),
        ] {
            let mut study = study(name);
            assert!(answers(&mut study, [2.0, enough], |_| ())[6], "{name}");
            assert!(!answers(&mut study, [2.0, too_small], |_| ())[6], "{name}");
        }
    }

    #[test]
    fn a_cut_that_is_too_long_certifies_nothing() {
        let mut study = study("rectangle 2 × 1, free");
        study.steps.iter_mut().for_each(|s| s.cut.length *= 4.0);
        assert!(!answers(&mut study, BUSER, |_| ())[5]);
    }
}
