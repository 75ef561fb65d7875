//! A low-pass filter: noise on a function is spread over all frequencies, the function is not.
//!
//! # Definition
//! On a triangulated square with signal s and noise η, `f = s + η`, the filter keeps the coefficients of f up to a frequency: with ĉ for
//! coefficients,
//!
//! ```text
//! ‖filtered − s‖² = Σ_kept η̂_j² + Σ_cut ŝ_j²,    ‖f − s‖² = Σ η̂_j²    (Parseval)
//! ```
//! so that it gains where the signal has less than the noise above the cut. The signal has the wave numbers of three eigenfunctions of the unit
//! square, at most 3π; the cut is at twice the largest eigenvalue of them, `2·9π²`, and knows nothing else of the signal.

use std::f64::consts::PI;

use super::modes::Modes;
use super::specimens::{Specimen, domain};
use crate::experiment::Finding;
use crate::experiment::poll::{Case, Every};
use crate::figure::{Axis, Chart, Figure, Mark, Series, Sketch};
use crate::generate::Stream;
use crate::property::Level;

/// The cut of the filter: twice the eigenvalue `9π²` of `cos 3πx`.
const CUT: f64 = 18.0 * PI * PI;

/// Counts filtered functions; the first one is shown.
#[derive(Default)]
pub struct Tally {
    every: Every,
    gains: Vec<f64>,
    figures: Vec<Figure>,
}

/// Signal, noise, and both with the frequencies below the cut alone.
struct Filtered<'a> {
    modes: &'a Modes,
    signal: Vec<f64>,
    noise: Vec<f64>,
    signal_hat: Vec<f64>,
    noise_hat: Vec<f64>,
    kept: usize,
    filtered: Vec<f64>,
}

impl<'a> Filtered<'a> {
    fn new(modes: &'a Modes, signal: Vec<f64>, noise: Vec<f64>, kept: usize) -> Self {
        let hat = |u: &[f64]| (0..modes.values().len()).map(|j| modes.inner(u, modes.vector(j))).collect::<Vec<f64>>();
        let (signal_hat, noise_hat) = (hat(&signal), hat(&noise));
        let mut filtered = vec![0.0; signal.len()];
        for j in 0..kept {
            let c = signal_hat[j] + noise_hat[j];
            filtered.iter_mut().zip(modes.vector(j)).for_each(|(f, v)| *f += c * v);
        }
        Filtered { modes, signal, noise, signal_hat, noise_hat, kept, filtered }
    }

    /// The error before and after, at the vertices.
    fn errors(&self) -> [f64; 2] {
        let after: Vec<f64> = self.filtered.iter().zip(&self.signal).map(|(f, s)| f - s).collect();
        [&self.noise, &after].map(|e| self.modes.inner(e, e).sqrt())
    }

    /// The error with the lowest k frequencies, by Parseval.
    fn predicted(&self, k: usize) -> f64 {
        let squares = |c: &[f64]| c.iter().map(|c| c * c).sum::<f64>();
        (squares(&self.noise_hat[..k]) + squares(&self.signal_hat[k..])).sqrt()
    }

    /// No gain, or another error than Parseval's. The two are norms of vectors that differ by `2ε(‖s‖ + ‖η‖)` and the rounding of sums of n
    /// terms, of which the tolerance of the eigenvectors is a multiple.
    fn not_better(&self) -> Option<String> {
        let [before, after] = self.errors();
        let scale = self.modes.inner(&self.signal, &self.signal).sqrt() + before;
        let predicted = self.predicted(self.kept);
        let off = (after - predicted).abs() > 4.0 * self.modes.tolerance() * scale;
        (off || after >= before)
            .then(|| format!("error {before:.3} before, {after:.3} after, {predicted:.3} by Parseval"))
    }
}

/// Three eigenfunctions of the unit square.
fn signal([x, y, _]: [f64; 3]) -> f64 {
    (PI * x).cos() * (PI * y).cos() + 0.75 * (2.0 * PI * y).cos() - 0.5 * (3.0 * PI * x).cos()
}

impl Tally {
    /// Draws a square and noise on it.
    pub fn ask(&mut self, stream: &mut Stream) {
        let seed = stream.below(1 << 20) as u64;
        let name = format!("random-delaunay:n=180,seed={seed}");
        let made = domain(&[("random-delaunay", &[("n", "180")])], seed).map(|domain| Specimen {
            name: name.clone(),
            domain,
            operator: "cotan",
            settings: &[],
        });
        let modes = made.as_ref().and_then(Specimen::matrices).map(|(l, m)| Modes::of(name.clone(), l, m));
        let (Some(specimen), Some(Ok(modes))) = (made, modes) else {
            return self.every.ask(Some(Case::told(format!("{name}: no eigenvectors"))));
        };
        let Some(surface) = specimen.domain.as_surface() else { return };
        let clean: Vec<f64> = surface.positions().iter().map(|p| signal(*p)).collect();
        let noise = clean.iter().map(|_| 0.6 * stream.normal()).collect();
        let kept = modes.values().iter().take_while(|v| **v <= CUT).count();
        let filtered = Filtered::new(&modes, clean, noise, kept);
        self.every.ask(filtered.not_better().map(|text| Case::told(format!("{name}: {text}"))));
        let [before, after] = filtered.errors();
        self.gains.push(before / after);
        if self.figures.is_empty() {
            let points = surface.positions().to_vec();
            let faces = surface.faces().iter().map(<[usize]>::to_vec).collect();
            self.figures = figures(&filtered, points, faces);
        }
    }

    /// The answer.
    pub fn answer(self, part: &'static str) -> Finding {
        let least = self.gains.iter().copied().fold(f64::INFINITY, f64::min);
        let most = self.gains.iter().copied().fold(0.0, f64::max);
        let mut finding = self.every.answer(
            part,
            "Is a function with noise nearer to the function without, in the norm of M, once the frequencies above 18π² are cut off, by as \
             much as Parseval says?",
            "noisy functions on random triangulations of the square with 180 points",
        );
        finding.finding += &format!("; the error falls by a factor of {least:.2} to {most:.2}");
        Finding { level: Level::Measured, figures: self.figures, ..finding }
    }
}

fn figures(f: &Filtered, points: Vec<[f64; 3]>, faces: Vec<Vec<usize>>) -> Vec<Figure> {
    let noisy: Vec<f64> = f.signal.iter().zip(&f.noise).map(|(s, n)| s + n).collect();
    let [before, after] = f.errors();
    let sketch = |title: String, values: Vec<f64>| {
        let (points, faces) = (points.clone(), faces.clone());
        Figure::Sketch(Sketch { title, points, faces, edges: Vec::new(), values, marked: Vec::new() })
    };
    // The constants have the eigenvalue 0, which an axis of factors does not show.
    let spectrum = |c: &[f64]| {
        let points = f.modes.values().iter().zip(c).skip(1).map(|(v, c)| [*v, c.abs()]);
        points.filter(|p| p[1] > 1e-5).collect::<Vec<_>>()
    };
    let all: Vec<f64> = f.signal_hat.iter().zip(&f.noise_hat).map(|(s, n)| s + n).collect();
    let high = all.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let coefficients = Chart {
        title: "The coefficients of a function with and without noise, and the cut of the filter".into(),
        x: Axis::logarithmic("λ"),
        y: Axis::logarithmic("|c|"),
        series: vec![
            Series::new("with noise", Mark::Dots, spectrum(&all)),
            Series::new("without", Mark::Dots, spectrum(&f.signal_hat)),
            Series::new("cut", Mark::Reference, [[CUT, 1e-4], [CUT, high]]),
        ],
    };
    let curve = (1..=f.noise_hat.len()).map(|k| [k as f64, f.predicted(k)]);
    let errors = Chart {
        title: "The error of the filtered function over the number of frequencies kept".into(),
        x: Axis::linear("frequencies kept"),
        y: Axis::linear("‖filtered − signal‖"),
        series: vec![
            Series::new("after", Mark::Line, curve),
            Series::new("before", Mark::Reference, [[1.0, before], [f.noise_hat.len() as f64, before]]),
            Series::new("the filter", Mark::Dots, [[f.kept as f64, after]]),
        ],
    };
    vec![
        sketch(format!("A function with noise: error {before:.3}"), noisy),
        sketch(format!("The same with its {} lowest frequencies alone: error {after:.3}", f.kept), f.filtered.clone()),
        Figure::Chart(coefficients),
        Figure::Chart(errors),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_filter_that_cuts_the_signal_or_keeps_other_coefficients_does_not_pass() {
        let domain = domain(&[("square", &[("levels", "3")])], 1).unwrap();
        let points = domain.as_surface().unwrap().positions().to_vec();
        let specimen = Specimen { name: String::new(), domain, operator: "cotan", settings: &[] };
        let (l, m) = specimen.matrices().unwrap();
        let modes = Modes::of("square".into(), l, m).unwrap();
        let clean: Vec<f64> = points.iter().map(|p| signal(*p)).collect();
        let mut stream = Stream::new(1, "noise");
        let noise: Vec<f64> = clean.iter().map(|_| 0.6 * stream.normal()).collect();
        let kept = modes.values().iter().take_while(|v| **v <= CUT).count();
        let with = |kept: usize| Filtered::new(&modes, clean.clone(), noise.clone(), kept);
        assert!(with(kept).not_better().is_none() && kept < 40);
        assert!(with(1).not_better().is_some(), "nothing is left of the signal");
        assert!(with(modes.size()).not_better().is_some(), "nothing is cut");
        let mut other = with(kept);
        other.filtered[3] += 0.1;
        assert!(other.not_better().is_some(), "not what Parseval says");
        let faint: Vec<f64> = noise.iter().map(|n| 1e-3 * n).collect();
        assert!(
            Filtered::new(&modes, clean.clone(), faint, kept).not_better().is_some(),
            "the cut costs more than the noise"
        );
    }
}
