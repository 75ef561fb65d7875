//! Fourier expansion in the eigenvectors of meshes and graphs, held against what their computed eigenvectors allow.
//!
//! # Definition
//! V has all n computed eigenvectors of `L u = λ M u` as columns, `c = VᵀMu` are the coefficients of a function u. What there is of rounding in
//! V is measured by two numbers, each with a bound for the rounding of its own computation (`fourier_expansion::modes`):
//!
//! ```text
//! ε ≥ ‖VᵀMV − I‖_F,    ρ ≥ ‖M^(−½)(LV − MVΛ)‖_F
//! ```
//! With `W = M^½ V`, square, `WWᵀ − I` has the eigenvalues of `WᵀW − I`, so that for every u
//!
//! ```text
//! |Σ c_j² − uᵀMu| ≤ ε uᵀMu,    ‖u − Vc‖_M ≤ ε ‖u‖_M
//! |Σ λ_j c_j² − uᵀLu| ≤ |c|² (max|λ| ε/(1 − ε) + √(1 + ε) ρ/(1 − ε)²) = β
//! Σ_(j ≥ k) c_j² ≤ (uᵀLu + β + Σ_(λ_j < 0) |λ_j| c_j²)/λ_k
//! ```
//! The first needs every eigenvector: with one left out ε is as small, and the sum is not. The last is what completeness says in the limit: the tail of a
//! function of finite energy vanishes as λ_k grows.
//!
//! # How it is decided
//! The entries of V, L, M and u are `f64`, that is rational numbers, and all that is said of u is evaluated over the rationals. ε and
//! `ρ/max|λ|` themselves must not exceed `8 n^(3/2) γ_n`: the columns of a product of r reflections or rotations of n rows are orthonormal up to
//! `√n r γ_n` in the Frobenius norm (Higham 2002, lemma 19.3, its constant taken as 1), `r = 4n` for the reduction to a tridiagonal matrix and
//! the iterations on that, and twice as much for VᵀV.

mod filter;
mod modes;
mod specimens;

use super::poll::{Case, Every};
use super::{Experiment, Finding, Setting};
use crate::figure::{Axis, Chart, Figure, Mark, Series};
use crate::generate::Stream;
use crate::property::Level;
use crate::scalar::{Rational, Scalar};

use modes::{Coefficients, Modes};
use specimens::{Specimen, functions, specimens};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "fourier-expansion",
    name: "Fourier expansion on meshes: Parseval, energy, tails, and a low-pass filter",
    statement: "computed eigenvectors of symmetric Laplacians are orthonormal up to rounding and complete: norms and energies are sums over \
                the coefficients, a function comes back from them, and its tail is below its energy over the frequency",
    sources: &["wardetzky-primer"],
    parts: &[
        "eigenvectors-are-orthonormal",
        "parseval",
        "function-comes-back",
        "energy-by-frequency",
        "tail-below-energy",
        "low-pass-filter",
    ],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let mut polls = Polls::default();
    for specimen in specimens(setting.pick(0, 1) == 1, setting.seed) {
        match specimen {
            Ok(specimen) => polls.ask_all(specimen, &mut stream),
            Err(name) => polls.orthonormal.ask(Some(Case::told(format!("{name}: no domain")))),
        }
    }
    let mut filtered = filter::Tally::default();
    for _ in 0..setting.pick(2, 8) {
        filtered.ask(&mut stream);
    }
    let mut findings = polls.answer();
    findings.push(filtered.answer("low-pass-filter"));
    findings
}

#[derive(Default)]
struct Polls {
    orthonormal: Every,
    parseval: Every,
    back: Every,
    energy: Every,
    tail: Every,
    /// Largest values seen: ε, ρ/max|λ|, the relative defects of Parseval, of the function and of the energy.
    worst: [f64; 5],
    /// The name of a mesh, and the tails of functions on it.
    tails: Vec<(String, Series)>,
}

impl Polls {
    fn ask_all(&mut self, specimen: Specimen, stream: &mut Stream) {
        let modes = specimen.matrices().ok_or("no operator".to_string());
        let modes = match modes.and_then(|(l, m)| Modes::of(specimen.name.clone(), l, m)) {
            Ok(modes) => modes,
            Err(why) => return self.orthonormal.ask(Some(Case::told(format!("{}: {why}", specimen.name)))),
        };
        self.orthonormal.ask(not_orthonormal(&modes));
        self.worst[0] = self.worst[0].max(modes.epsilon);
        self.worst[1] = self.worst[1].max(modes.rho / modes.largest());
        for (function, u) in functions(&specimen.domain, stream) {
            match Coefficients::of(&modes, &u) {
                Some(c) => self.ask(&modes, &c, function),
                None => self.parseval.ask(Some(Case::told(format!("{function} is not finite on {}", modes.name)))),
            }
        }
    }

    fn ask(&mut self, modes: &Modes, c: &Coefficients, function: &str) {
        let tell = |text: Option<String>| text.map(|t| Case::told(format!("{function} on {}: {t}", modes.name)));
        self.parseval.ask(tell(not_parseval(modes, c)));
        self.back.ask(tell(not_back(modes, c)));
        self.energy.ask(tell(not_the_energy(modes, c)));
        self.tail.ask(tell(above_the_energy(modes, c)));
        let relative = |x: &Rational, of: &Rational| (x.clone() / of.clone()).approximate().abs();
        let scale = c.square.clone() * Rational::exactly(modes.largest()).unwrap_or(Rational::ONE);
        let seen = [
            relative(&(c.sum.clone() - c.square.clone()), &c.square),
            relative(&c.rest, &c.square).sqrt(),
            relative(&(c.weighted.clone() - c.energy.clone()), &scale),
        ];
        seen.iter().zip(&mut self.worst[2..]).for_each(|(x, worst)| *worst = worst.max(*x));
        // Of the last planar mesh: the largest one.
        if modes.name.starts_with("random-delaunay") && ["a coordinate", "random signs"].contains(&function) {
            self.tails.retain(|(name, _)| *name == modes.name);
            self.tails.extend(tails(modes, c, function).map(|series| (modes.name.clone(), series)));
        }
    }

    fn answer(self) -> Vec<Finding> {
        let functions = "functions on meshes and graphs";
        let [epsilon, rho, parseval, back, energy] = self.worst;
        let with = |mut finding: Finding, level: Level, numbers: String| {
            finding.level = level;
            finding.finding += &numbers;
            finding
        };
        let mut tail = self.tail.answer(
            "tail-below-energy",
            "Is Σ_(j ≥ k) c_j² ≤ (uᵀLu + β + Σ_(λ_j < 0) |λ_j| c_j²)/λ_k for every k with λ_k > 0?",
            functions,
        );
        if !self.tails.is_empty() {
            tail.figures.push(Figure::Chart(Chart {
                title: "What is left of a function without its lowest frequencies, below its energy over the frequency"
                    .into(),
                x: Axis::logarithmic("λ_k"),
                y: Axis::logarithmic("Σ_(j ≥ k) c_j² / ‖u‖²"),
                series: self.tails.into_iter().map(|(_, series)| series).collect(),
            }));
        }
        vec![
            with(
                self.orthonormal.answer(
                    "eigenvectors-are-orthonormal",
                    "Are there n eigenvectors with ‖VᵀMV − I‖_F and ‖M^(−½)(LV − MVΛ)‖_F/max|λ| at most 8 n^(3/2) γ_n?",
                    "meshes and graphs, closed and with boundary, lumped and full mass, weights of either sign",
                ),
                Level::Measured,
                format!("; largest {epsilon:.1e} and {rho:.1e}"),
            ),
            with(
                self.parseval.answer("parseval", "Is |Σ c_j² − uᵀMu| ≤ ε uᵀMu?", functions),
                Level::Bounded,
                format!("; largest relative difference {parseval:.1e}"),
            ),
            with(
                self.back.answer("function-comes-back", "Is ‖u − Σ c_j v_j‖ ≤ ε ‖u‖ in the norm of M?", functions),
                Level::Bounded,
                format!("; largest relative difference {back:.1e}"),
            ),
            with(
                self.energy.answer("energy-by-frequency", "Is |Σ λ_j c_j² − uᵀLu| ≤ β?", functions),
                Level::Bounded,
                format!("; largest difference {energy:.1e} max|λ| ‖u‖²"),
            ),
            Finding { level: Level::Bounded, ..tail },
        ]
    }
}

fn not_orthonormal(modes: &Modes) -> Option<Case> {
    let (n, count) = (modes.size(), modes.values().len());
    let allowed = modes.tolerance();
    let good = count == n && modes.epsilon <= allowed && modes.rho <= allowed * modes.largest();
    let numbers = || format!("ε = {:.1e}, ρ = {:.1e}, max|λ| = {:.1e}", modes.epsilon, modes.rho, modes.largest());
    (!good).then(|| {
        Case::told(format!("{}: {count} of {n} eigenvectors, {}, allowed {allowed:.1e}", modes.name, numbers()))
    })
}

/// Why the bounds say nothing here: they are not small.
fn without_bound(modes: &Modes) -> Option<String> {
    let small = modes.epsilon <= modes.tolerance() && modes.rho <= modes.tolerance() * modes.largest();
    (!small).then(|| format!("no bound: ε = {:.1e}, ρ = {:.1e}", modes.epsilon, modes.rho))
}

fn exactly(x: f64) -> Option<Rational> {
    Rational::exactly(x)
}

fn not_parseval(modes: &Modes, c: &Coefficients) -> Option<String> {
    let defect = (c.sum.clone() - c.square.clone()).magnitude();
    let allowed = exactly(modes.epsilon).map(|epsilon| epsilon * c.square.clone());
    let text = || format!("Σ c² = {}, uᵀMu = {}", c.sum.approximate(), c.square.approximate());
    without_bound(modes).or_else(|| (allowed.is_none_or(|a| defect > a)).then(text))
}

/// The coefficients are rounded once before the function is put together: u (1 + ε) ‖u‖ more.
fn not_back(modes: &Modes, c: &Coefficients) -> Option<String> {
    let bound = modes.epsilon + 2.0 * f64::EPSILON;
    let allowed = exactly(bound).map(|b| b.clone() * b * c.square.clone());
    let text = || format!("‖u − Vc‖² = {:.1e}", c.rest.approximate());
    without_bound(modes).or_else(|| (allowed.is_none_or(|a| c.rest > a)).then(text))
}

/// β; every operation rounds by at most a factor 1 + u, and 1 + 2⁻⁴⁰ covers the dozen of them.
fn beta(modes: &Modes, c: &Coefficients) -> f64 {
    let (epsilon, rho, square) = (modes.epsilon, modes.rho, c.sum.approximate());
    let left = 1.0 - epsilon;
    square * (modes.largest() * epsilon / left + (1.0 + epsilon).sqrt() * rho / (left * left)) * (1.0 + 2_f64.powi(-40))
}

fn not_the_energy(modes: &Modes, c: &Coefficients) -> Option<String> {
    let defect = (c.weighted.clone() - c.energy.clone()).magnitude();
    let text = || format!("Σ λc² = {}, uᵀLu = {}", c.weighted.approximate(), c.energy.approximate());
    without_bound(modes).or_else(|| exactly(beta(modes, c)).is_none_or(|b| defect > b).then(text))
}

fn above_the_energy(modes: &Modes, c: &Coefficients) -> Option<String> {
    let values: Vec<Rational> = modes.values().iter().filter_map(|v| exactly(*v)).collect();
    let square = |j: usize| c.exact[j].clone() * c.exact[j].clone();
    let below: Rational = crate::scalar::sum(
        (0..values.len()).filter(|&j| values[j] < Rational::ZERO).map(|j| values[j].magnitude() * square(j)),
    );
    let allowed = c.energy.clone() + exactly(beta(modes, c))? + below;
    let mut tail = Rational::ZERO;
    for k in (0..values.len()).rev().take_while(|&k| values[k] > Rational::ZERO) {
        tail += square(k);
        if values[k].clone() * tail.clone() > allowed {
            return Some(format!("the tail from λ_{k} = {} is {}", modes.values()[k], tail.approximate()));
        }
    }
    None
}

/// The tail of a function and its bound, over the eigenvalue, relative to the norm.
fn tails(modes: &Modes, c: &Coefficients, function: &str) -> [Series; 2] {
    let (values, square) = (modes.values(), c.square.approximate());
    let coefficients: Vec<f64> = c.exact.iter().map(Scalar::approximate).collect();
    let tail = |k: usize| coefficients[k..].iter().map(|c| c * c).sum::<f64>() / square;
    let places = || (1..values.len()).filter(|k| values[*k] > values[k - 1] * (1.0 + 1e-6));
    let energy = c.energy.approximate() / square;
    let ends = [1, values.len() - 1].map(|k| [values[k], energy / values[k]]);
    [
        // Below the rounding of a norm there is nothing to see.
        Series::new(function, Mark::Both, places().map(|k| [values[k], tail(k)]).filter(|p| p[1] > 1e-16)),
        Series::new(format!("energy of {function} / λ"), Mark::Reference, ends),
    ]
}

#[cfg(test)]
mod tests {
    use super::specimens::domain;
    use super::*;
    use crate::linalg::Csr;

    fn sphere() -> (Csr, Csr) {
        let domain = domain(&[("icosphere", &[("levels", "1")])], 1).unwrap();
        let specimen = Specimen { name: String::new(), domain, operator: "cotan", settings: &[] };
        specimen.matrices().unwrap()
    }

    fn verdicts(modes: &Modes, u: &[f64]) -> [bool; 5] {
        let c = Coefficients::of(modes, u).unwrap();
        [
            not_orthonormal(modes).is_some(),
            not_parseval(modes, &c).is_some(),
            not_back(modes, &c).is_some(),
            not_the_energy(modes, &c).is_some(),
            above_the_energy(modes, &c).is_some(),
        ]
    }

    /// A function with a share of every mode.
    fn noise() -> Vec<f64> {
        let mut stream = Stream::new(3, "noise");
        (0..42).map(|_| stream.normal()).collect()
    }

    #[test]
    fn what_is_right_passes_and_a_dropped_or_doubled_eigenvector_does_not() {
        let (l, m) = sphere();
        let right = Modes::of("sphere".into(), l.clone(), m.clone()).unwrap();
        assert_eq!(verdicts(&right, &noise()), [false; 5]);
        assert!(right.epsilon < 1e-12 && right.rho < 1e-10 * right.largest());
        for dropped in [0, 7, 41] {
            let (mut vectors, mut values) = right.pairs();
            vectors.remove(dropped);
            values.remove(dropped);
            let less = Modes::from_pairs("less".into(), l.clone(), m.clone(), values, vectors).unwrap();
            let found = verdicts(&less, &noise());
            assert!(found[0] && found[1] && found[2], "{dropped}: {found:?}");
            assert_eq!(found[3], dropped > 0, "the constants have no energy");
        }
        let (mut vectors, mut values) = right.pairs();
        vectors[9] = vectors[8].clone();
        values[9] = values[8];
        let twice = Modes::from_pairs("twice".into(), l, m, values, vectors).unwrap();
        assert_eq!(verdicts(&twice, &noise())[..4], [true; 4]);
    }

    #[test]
    fn another_mass_a_wrong_eigenvalue_and_a_vector_out_of_place_are_noticed() {
        let (l, m) = sphere();
        let right = Modes::of("sphere".into(), l.clone(), m.clone()).unwrap();
        let (vectors, values) = right.pairs();
        let heavier = m.map(|i, _, v| if i == 5 { v * (1.0 + 1e-6) } else { *v });
        let other = Modes::from_pairs("mass".into(), l.clone(), heavier, values.clone(), vectors.clone()).unwrap();
        assert_eq!(verdicts(&other, &noise())[..2], [true; 2]);
        let mut wrong = values.clone();
        wrong[20] *= 1.0 + 1e-6;
        let wrong = Modes::from_pairs("value".into(), l.clone(), m.clone(), wrong, vectors.clone()).unwrap();
        let found = verdicts(&wrong, &noise());
        assert!(found[0] && found[3]);
        let mut swapped = vectors.clone();
        swapped.swap(1, 41);
        let swapped = Modes::from_pairs("order".into(), l, m, values, swapped).unwrap();
        assert!(verdicts(&swapped, &noise())[0]);
    }

    #[test]
    fn the_tail_of_a_high_frequency_is_not_below_the_energy_of_a_low_one() {
        let (l, m) = sphere();
        let modes = Modes::of("sphere".into(), l, m).unwrap();
        let (high, low) = (modes.vector(41).to_vec(), modes.vector(1).to_vec());
        let (mut c, other) = (Coefficients::of(&modes, &high).unwrap(), Coefficients::of(&modes, &low).unwrap());
        assert!(above_the_energy(&modes, &c).is_none());
        c.energy = other.energy;
        assert!(above_the_energy(&modes, &c).is_some());
    }

    #[test]
    fn the_numbers_of_the_bound_cover_those_over_the_rationals() {
        let (l, m) = sphere();
        let modes = Modes::of("sphere".into(), l, m).unwrap();
        let exact = modes.exact_epsilon_squared().unwrap();
        let epsilon = Rational::exactly(modes.epsilon).unwrap();
        assert!(exact <= epsilon.clone() * epsilon);
    }
}
