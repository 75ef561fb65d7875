//! The Schwarz lantern: meshes that come as near to a cylinder as one likes while areas and eigenvalues tend to something else.
//!
//! # Definition
//! Radius 1, height H, m layers of n sectors, `q = m/(n²H)`, `s² = 1 + π⁴q²/4`. The base of a triangle is `2 sin(π/n)` long; the apex
//! lies H/m above it and by `1 − cos(π/n) ≈ π²/2n²` off the plane above it, so that the slant height is `s H/m` in the limit:
//! `area → 2πHs`.
//!
//! A smooth u at the vertices has on a triangle the derivative `u_θ` along the base and, along the slant,
//! `(u_z H/m ∓ (π²/2n²) u_θθ)/(s H/m)`, for u at the middle of the base is the mean over its ends, which `(π²/2n²) u_θθ` makes larger than
//! u there. The sign alternates between triangles that stand and that hang, half of the area each, and the mixed term cancels: with
//! `κ = π²q/2`, `κ² = s² − 1`, the energy over the area element `s dθ dz` is `u_θ² + u_z²/s² + (1 − 1/s²) u_θθ²`, and
//! ```text
//! λ → k² + (1 − 1/s²) k⁴ + (jπ/(Hs))²,    cos kθ, sin kθ, cos(jπz/H)
//! ```
//! with natural boundary. q → 0 gives the cylinder, `k² + (jπ/H)²`.

use rayon::prelude::*;

use super::limit::order::{DIVIDE, Level as Size, Trend, judge};
use super::limit::sequence::make;
use super::poll::{Case, Every};
use super::{Effort, Experiment, Finding, Setting};
use crate::figure::{Axis, Chart, Figure, Mark, Series};
use crate::laplacian;
use crate::linalg::spectrum::lowest;
use crate::property::Level;
use std::f64::consts::{PI, TAU};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "schwarz-lantern",
    name: "Areas and eigenvalues of Schwarz lanterns",
    statement: "lanterns of radius 1 and height 2 with n sectors and m layers, m/n² → 0 and m/n² constant: area and natural cotangent \
                eigenvalues tend to their closed-form limits, those of the cylinder for the first and others for the second; \
                points and vertices tend to the cylinder for all",
    sources: &["wardetzky-primer", "schwarz1890", "dziuk1988"],
    parts: &[
        "vertices-tend-to-the-cylinder",
        "area-tends-to-its-limit",
        "eigenvalues-tend-to-their-limit",
        "flat-families-tend-to-the-cylinder",
        "area-misses-the-cylinder",
        "eigenvalues-miss-the-cylinder",
    ],
    run,
};

const HEIGHT: f64 = 2.0;

/// How many positive eigenvalues are compared.
const COUNT: usize = 8;

/// How layers grow with the sectors.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Family {
    /// `m = n`: m/n² → 0.
    Flat,
    /// `m = n²/parts`, parts dividing n² for even n.
    Square { parts: usize },
}

impl Family {
    fn layers(self, n: usize) -> usize {
        match self {
            Family::Flat => n,
            Family::Square { parts } => n * n / parts,
        }
    }

    /// The limit of `q = m/(n²H)`.
    fn q(self) -> f64 {
        match self {
            Family::Flat => 0.0,
            Family::Square { parts } => 1.0 / (parts as f64 * HEIGHT),
        }
    }

    fn name(self) -> String {
        match self {
            Family::Flat => "m = n".into(),
            Family::Square { parts: 1 } => "m = n²".into(),
            Family::Square { parts } => format!("m = n²/{parts}"),
        }
    }
}

fn stretch(q: f64) -> f64 {
    (1.0 + PI.powi(4) * q * q / 4.0).sqrt()
}

fn limit_area(q: f64) -> f64 {
    TAU * HEIGHT * stretch(q)
}

/// The smallest positive limits, ascending, copies counted.
fn limit_eigenvalues(q: f64) -> Vec<f64> {
    let s = stretch(q);
    let mut values: Vec<f64> = (0..=COUNT as u32)
        .flat_map(|j| (0..=COUNT as u32).map(move |k| (f64::from(j), f64::from(k))))
        .filter(|&(j, k)| j + k > 0.0)
        .flat_map(|(j, k)| {
            let value = k * k + (1.0 - 1.0 / (s * s)) * k.powi(4) + (j * PI / (HEIGHT * s)).powi(2);
            std::iter::repeat_n(value, if k > 0.0 { 2 } else { 1 })
        })
        .collect();
    values.sort_by(f64::total_cmp);
    values.truncate(COUNT);
    values
}

/// What is measured of one lantern.
struct Lantern {
    area: f64,
    /// The distance of the faces from the cylinder: the sagitta of a base, no more for any point of a face.
    distance: f64,
    eigenvalues: Vec<f64>,
}

fn lantern(m: usize, n: usize) -> Result<Lantern, String> {
    let given = [("m", m.to_string()), ("n", n.to_string()), ("radius", "1".into()), ("height", HEIGHT.to_string())];
    let domain = make(None, "lantern", &given, 0)?;
    let surface = domain.as_surface().ok_or("not a surface")?;
    let operator = laplacian::find("cotan")
        .ok_or("there is no cotan")?
        .build(&domain, &Default::default())
        .map_err(|e| e.to_string())?;
    let mass = operator.mass().ok_or("no mass")?.matrix();
    let spectrum = lowest(operator.stiffness(), mass, COUNT + 1, 0).map_err(|e| e.to_string())?;
    let eigenvalues: Vec<f64> = spectrum.values.iter().skip(1).take(COUNT).copied().collect();
    if !spectrum.closure.certified || eigenvalues.len() < COUNT {
        return Err(format!("m = {m}, n = {n}: the spectrum is not certified"));
    }
    let middles = surface.topology().edges().iter().map(|&[a, b]| {
        let middle = (surface.point(a) + surface.point(b)) * 0.5;
        1.0 - middle.x.hypot(middle.y)
    });
    Ok(Lantern { area: surface.area(), distance: middles.fold(0.0, f64::max), eigenvalues })
}

/// One family with its lanterns, from coarse to fine.
struct Study {
    family: Family,
    lanterns: Vec<(usize, Lantern)>,
}

impl Study {
    fn trend(&self, error: impl Fn(&Lantern) -> f64) -> Trend {
        let level = |(n, lantern): &(usize, Lantern)| Size { h: 1.0 / *n as f64, errors: vec![error(lantern)] };
        judge(&self.lanterns.iter().map(level).collect::<Vec<_>>())
    }

    fn area(&self, q: f64) -> Trend {
        self.trend(|l| (l.area / limit_area(q) - 1.0).abs())
    }

    /// The largest relative error over the eigenvalues.
    fn eigenvalues(&self, q: f64) -> Trend {
        let exact = limit_eigenvalues(q);
        self.trend(|l| l.eigenvalues.iter().zip(&exact).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max))
    }

    fn told(&self, what: &str, trend: Trend) -> Case {
        Case::told(format!("{}: the error of {what} {trend}", self.family.name()))
    }
}

fn studies(setting: &Setting) -> Result<Vec<Study>, String> {
    let (square, flat) = match setting.effort {
        Effort::Smoke => ([8, 12, 16].as_slice(), [10, 14, 20, 28].as_slice()),
        Effort::Full => ([6, 8, 12, 16, 20].as_slice(), [12, 18, 27, 40, 60].as_slice()),
    };
    let families =
        [Family::Flat, Family::Square { parts: 4 }, Family::Square { parts: 2 }, Family::Square { parts: 1 }];
    let jobs: Vec<(Family, usize)> = families
        .iter()
        .flat_map(|f| if *f == Family::Flat { flat } else { square }.iter().map(move |n| (*f, *n)))
        .collect();
    let made = jobs.par_iter().map(|&(f, n)| lantern(f.layers(n), n)).collect::<Result<Vec<_>, String>>()?;
    let mut made = jobs.into_iter().zip(made);
    let mut study = |family: Family| {
        let sizes = if family == Family::Flat { flat } else { square };
        let lanterns = made.by_ref().take(sizes.len()).map(|((_, n), lantern)| (n, lantern)).collect();
        Study { family, lanterns }
    };
    Ok(families.into_iter().map(&mut study).collect())
}

fn run(setting: &Setting) -> Vec<Finding> {
    let [mut near, mut area, mut values, mut flat, mut area_misses, mut values_miss] =
        [(); 6].map(|()| Every::default());
    let (mut areas, mut orders, mut figures) = (Vec::new(), Vec::new(), Vec::new());
    match studies(setting) {
        Err(why) => {
            let all = [&mut near, &mut area, &mut values, &mut flat, &mut area_misses, &mut values_miss];
            all.into_iter().for_each(|every| every.ask(Some(Case::told(why.clone()))));
        }
        Ok(studies) => {
            for study in &studies {
                let q = study.family.q();
                let distance = study.trend(|l| l.distance);
                near.ask((!distance.converges()).then(|| study.told("the distance", distance)));
                let [own_area, own_values] = [study.area(q), study.eigenvalues(q)];
                let name = study.family.name();
                if let Some((n, last)) = study.lanterns.last() {
                    areas.push(format!("{name}: {own_area}, {:.4} at n = {n} of {:.4}", last.area, limit_area(q)));
                    orders.push(format!("{name}: {own_values}"));
                }
                if q == 0.0 {
                    flat.ask((!own_area.converges()).then(|| study.told("the area", own_area)));
                    flat.ask((!own_values.converges()).then(|| study.told("the eigenvalues", own_values)));
                    continue;
                }
                area.ask((!own_area.converges()).then(|| study.told("the area", own_area)));
                values.ask((!own_values.converges()).then(|| study.told("the eigenvalues", own_values)));
                let [round_area, round_values] = [study.area(0.0), study.eigenvalues(0.0)];
                area_misses.ask((!round_area.levels_off()).then(|| study.told("the area", round_area)));
                values_miss.ask((!round_values.levels_off()).then(|| study.told("the eigenvalues", round_values)));
            }
            figures = [sums(&studies), errors(&studies)].into();
        }
    }
    let cases = "families with m/n² constant";
    let mut findings = vec![
        near.answer(
            ENTRY.parts[0],
            "Does the largest distance of the middle of an edge from the cylinder tend to zero?",
            "families",
        ),
        area.answer(ENTRY.parts[1], "Does the area tend to 2πHs, s² = 1 + π⁴q²/4?", cases),
        values.answer(
            ENTRY.parts[2],
            format!("Do the first {COUNT} positive eigenvalues tend to those of k² + (1 − 1/s²) k⁴ + (jπ/(Hs))²?"),
            cases,
        ),
        flat.answer(ENTRY.parts[3], "For m = n, do area and eigenvalues tend to those of the cylinder?", "quantities"),
        area_misses.answer(
            ENTRY.parts[4],
            format!("Does the error against the area of the cylinder level off, its order below {DIVIDE}?"),
            cases,
        ),
        values_miss.answer(ENTRY.parts[5], "Do the errors against the eigenvalues of the cylinder level off?", cases),
    ];
    findings[1].finding += &format!("; {}", areas.join("; "));
    findings[2].finding += &format!("; {}", orders.join("; "));
    findings[2].figures = figures;
    findings.iter_mut().for_each(|f| f.level = Level::Measured);
    findings
}

/// The sum of the eigenvalues against n, with the limits.
fn sums(studies: &[Study]) -> Figure {
    let ends = |y: f64| [6.0, 60.0].map(|n| [n, y]);
    let mut series = Vec::new();
    for study in studies {
        let points = study.lanterns.iter().map(|(n, l)| [*n as f64, l.eigenvalues.iter().sum()]);
        series.push(Series::new(study.family.name(), Mark::Both, points));
        let limit = limit_eigenvalues(study.family.q()).iter().sum();
        series.push(Series::new(format!("limit for {}", study.family.name()), Mark::Reference, ends(limit)));
    }
    Figure::Chart(Chart {
        title: format!(
            "Schwarz lanterns: the sum of the first {COUNT} positive eigenvalues, and the closed form of its limit"
        ),
        x: Axis::logarithmic("sectors n"),
        y: Axis::linear(format!("λ₁ + … + λ{}", subscript(COUNT))),
        series,
    })
}

fn subscript(k: usize) -> char {
    char::from_digit(k as u32, 10).and_then(|d| char::from_u32(0x2080 + d as u32 - 48)).unwrap_or('k')
}

/// The errors against the limit and against the cylinder.
fn errors(studies: &[Study]) -> Figure {
    let mut series = Vec::new();
    for study in studies {
        for (q, against) in [(study.family.q(), "its limit"), (0.0, "the cylinder")] {
            if q == 0.0 && against == "its limit" {
                continue;
            }
            let exact = limit_eigenvalues(q);
            let error =
                |l: &Lantern| l.eigenvalues.iter().zip(&exact).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
            let points = study.lanterns.iter().map(|(n, l)| [1.0 / *n as f64, error(l)]);
            let order = study.eigenvalues(q).order().map_or(String::new(), |o| format!(": {o}"));
            series.push(Series::new(format!("{} against {against}{order}", study.family.name()), Mark::Both, points));
        }
    }
    series.push(Series::new("slope 2", Mark::Reference, [[0.25, 0.5], [0.025, 0.005]]));
    Figure::Chart(Chart {
        title: "Schwarz lanterns: the largest relative error of the eigenvalues".into(),
        x: Axis::logarithmic("1/n"),
        y: Axis::logarithmic("relative error"),
        series,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limits_are_those_of_the_cylinder_without_the_ratio_and_grow_with_it() {
        let cylinder = limit_eigenvalues(0.0);
        // 1, 1, (π/2)², 1 + (π/2)² twice, 4, 4, 4 + (π/2)².
        let z = PI * PI / 4.0;
        let table = [1.0, 1.0, z, 1.0 + z, 1.0 + z, 4.0, 4.0, 4.0 + z];
        assert!(cylinder.iter().zip(table).all(|(a, b)| (a - b).abs() < 1e-14), "{cylinder:?}");
        assert!((limit_area(0.0) - 2.0 * TAU).abs() < 1e-14);
        assert!((limit_area(0.5) / limit_area(0.0)).powi(2) - 1.0 - PI.powi(4) / 16.0 < 1e-12);
    }

    /// The energies of interpolated functions, summed over the mesh, against the derivation, mode by mode.
    #[test]
    fn the_energy_of_an_interpolated_mode_tends_to_its_closed_form() {
        for (parts, n) in [(4, 24), (1, 24)] {
            let family = Family::Square { parts };
            let m = family.layers(n);
            let given =
                [("m", m.to_string()), ("n", n.to_string()), ("radius", "1".into()), ("height", HEIGHT.to_string())];
            let domain = make(None, "lantern", &given, 0).unwrap();
            let operator = laplacian::find("cotan").unwrap().build(&domain, &Default::default()).unwrap();
            let mass = operator.mass().unwrap().matrix();
            let s = stretch(family.q());
            for (j, k) in [(0, 1), (1, 0), (1, 1), (0, 2)] {
                let (a, b) = (f64::from(j), f64::from(k));
                let mode = |p: &[f64; 3]| (b * p[1].atan2(p[0])).cos() * (a * PI * p[2] / HEIGHT).cos();
                let u: Vec<f64> = domain.positions().unwrap().iter().map(mode).collect();
                let found = operator.stiffness().quadratic_form(&u) / mass.quadratic_form(&u);
                let exact = b * b + (1.0 - 1.0 / (s * s)) * b.powi(4) + (a * PI / (HEIGHT * s)).powi(2);
                assert!((found / exact - 1.0).abs() < 0.03, "{family:?} {j} {k}: {found} {exact}");
            }
        }
    }

    #[test]
    fn a_wrong_limit_is_noticed() {
        let studies = studies(&Setting { seed: 1, effort: Effort::Smoke }).unwrap();
        for study in &studies[1..] {
            // The limit of another ratio, and the formula without its term of fourth order.
            let q = study.family.q();
            assert!(study.eigenvalues(q).converges(), "{}", study.eigenvalues(q));
            assert!(!study.eigenvalues(1.3 * q).converges() && !study.area(1.1 * q).converges());
            let s = stretch(q);
            let short = study.trend(|l| (l.eigenvalues[2] - (PI / (HEIGHT * s)).powi(2) * s).abs());
            assert!(!short.converges());
        }
    }
}
