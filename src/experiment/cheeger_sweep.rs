//! The spectral sweep on graphs: the best of the n − 1 cuts that an eigenvector orders, against all partitions where those can
//! be enumerated, and against the eigenvalue where they cannot.
//!
//! # Definition
//! A vector x orders the vertices; its cuts separate the k vertices with the smallest components from the others. With
//! `h = min cut / min(vol A, vol B)`, volumes by degrees, and `R(x) = xᵀLx / (xᵀDx − (1ᵀDx)²/vol)`:
//!
//! ```text
//! λ̃₁/2 ≤ h ≤ h(x),    h(x)²/2 ≤ R(x)    for every vector x that is not constant,
//! ```
//! h(x) the best of its cuts. The last inequality is the proof of Cheeger's: shifting x by its weighted median makes the
//! denominator larger only, and the positive or the negative part has a quotient that is no larger [Chung 1997, section 2.3].
//! It is a certificate without enumeration: a sweep shows that its own cut is nearly optimal.
//!
//! # How it is decided
//! x is an eigenvector of `L u = λ D u` of the smallest eigenvalue above zero, rounded to whole multiples of 2⁻²⁰ of its largest
//! component; from there on all numbers are whole. The eigenvalue comes with an enclosure (`linalg::spectrum`), which is held
//! against exact inertia counts where the graph is small.

use super::poll::{Case, Every};
use super::world::cuts::{Cut, Specimen, double, half_square};
use super::world::graphs::{component_count, describe, random_graphs, randomly_weighted};
use super::{Experiment, Finding, Setting};
use crate::domain::Graph;
use crate::figure::{Axis, Chart, Figure, Mark, Series};
use crate::generate::Stream;
use crate::linalg::Csr;
use crate::linalg::spectrum::{SpectrumError, lowest};
use crate::property::Level;
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "cheeger-sweep",
    name: "Spectral sweeps on graphs",
    statement: "λ̃₁/2 ≤ h ≤ h(x) and h(x)²/2 ≤ R(x), h(x) the best cut in the order of an eigenvector x, on graphs too large for \
                their partitions to be enumerated",
    sources: &["chung1997"],
    parts: &[
        "sweep-bounds-the-constant",
        "sweep-obeys-cheeger",
        "eigenvalue-is-enclosed",
        "eigenvalue-below-twice-the-sweep",
    ],
    run,
};

/// Random weights are multiples of a sixteenth.
const UNIT: f64 = 16.0;

/// Components of the vector are whole multiples of this part of the largest.
const GRAIN: f64 = (1 << 20) as f64;

/// A graph, the enclosure of its eigenvalue and the best cut of the sweep.
struct Swept {
    graph: Graph,
    eigenvalue: f64,
    /// λ̃₁ is within so much of the eigenvalue.
    error: f64,
    /// Whether the enclosure is one.
    certified: bool,
    best: Cut,
    rayleigh: Rational,
}

impl Swept {
    fn of(graph: Graph) -> Result<Self, SpectrumError> {
        let n = graph.vertex_count();
        let weights: Vec<f64> = (0..graph.edges().len()).map(|k| graph.weights().map_or(1.0, |w| w[k])).collect();
        let mut degrees = vec![0.0; n];
        let mut entries = Vec::with_capacity(4 * weights.len());
        for (&[i, j], &w) in graph.edges().iter().zip(&weights) {
            entries.extend([(i, i, w), (j, j, w), (i, j, -w), (j, i, -w)]);
            degrees[i] += w;
            degrees[j] += w;
        }
        let spectrum = lowest(&Csr::from_triplets(n, n, &entries), &Csr::diagonal(&degrees), 2, 0)?;
        let residuals: f64 = spectrum.residuals.iter().map(|r| r * r).sum();
        // Kahan's bound for all pairs together; the residuals themselves carry the rounding of rows of a matrix of norm two.
        let error = (2.0 * residuals).sqrt() + 8.0 * n as f64 * f64::EPSILON;
        let x = whole(spectrum.vector(1));
        let (best, rayleigh) = sweep(&graph, &weights, &x);
        Ok(Swept {
            graph,
            eigenvalue: spectrum.values[1],
            error,
            certified: spectrum.closure.certified,
            best,
            rayleigh,
        })
    }

    fn told(&self, text: String) -> Case {
        Case::told(format!("{text} on {}", describe(&self.graph)))
    }
}

/// A vector in whole multiples of the grain of its largest component.
fn whole(x: &[f64]) -> Vec<i128> {
    let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    x.iter().map(|v| (v / largest * GRAIN).round() as i128).collect()
}

/// The best cut in the order of x and its quotient `R(x)`, exactly.
fn sweep(graph: &Graph, weights: &[f64], x: &[i128]) -> (Cut, Rational) {
    let n = graph.vertex_count();
    let mut neighbours = vec![Vec::new(); n];
    let (mut energy, mut degrees) = (0, vec![0; n]);
    for (&[i, j], w) in graph.edges().iter().zip(weights) {
        let w = (UNIT * w) as i128;
        neighbours[i].push((j, w));
        neighbours[j].push((i, w));
        degrees[i] += w;
        degrees[j] += w;
        energy += w * (x[i] - x[j]) * (x[i] - x[j]);
    }
    let total: i128 = degrees.iter().sum();
    let square: i128 = (0..n).map(|i| degrees[i] * x[i] * x[i]).sum();
    let mean: i128 = (0..n).map(|i| degrees[i] * x[i]).sum();
    let rayleigh = fraction(energy * total, square * total - mean * mean);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by_key(|&i| (x[i], i));
    let (mut inside, mut cut, mut volume) = (vec![false; n], 0, 0);
    let mut best: Option<(Rational, usize)> = None;
    for (k, &i) in order.iter().enumerate().take(n - 1) {
        inside[i] = true;
        volume += degrees[i];
        cut += neighbours[i].iter().map(|&(j, w)| if inside[j] { -w } else { w }).sum::<i128>();
        let ratio = fraction(cut, volume.min(total - volume));
        if best.as_ref().is_none_or(|(b, _)| ratio < *b) {
            best = Some((ratio, k + 1));
        }
    }
    let (ratio, count) = best.unwrap_or((Rational::zero(), 0));
    let mut side = order[..count].to_vec();
    side.sort_unstable();
    (Cut { ratio, side }, rayleigh)
}

fn fraction(p: i128, q: i128) -> Rational {
    (Rational::from(p) / Rational::from(q)).reduced()
}

/// Two halves with many edges inside and few between, and a path through all of them.
fn communities(n: usize, stream: &mut Stream) -> Graph {
    let within = (12.0 / n as f64).min(0.5);
    let mut edges = Vec::new();
    for i in 0..n {
        for j in i + 1..n {
            let chance = if (2 * i < n) == (2 * j < n) { within } else { within / 20.0 };
            if stream.unit() < chance || j == i + 1 {
                edges.push([i, j]);
            }
        }
    }
    let graph = Graph::new(n, &edges).expect("pairs of different vertices, each once");
    randomly_weighted(&graph, stream)
}

#[derive(Default)]
struct Polls {
    constant: Every,
    cheeger: Every,
    enclosed: Every,
    twice: Every,
    /// Sweeps that found the constant, and the largest quotient of the two.
    found: usize,
    worst: f64,
    points: [Vec<[f64; 2]>; 2],
}

impl Polls {
    fn count(&mut self, all: Option<&Specimen>, graph: Graph) {
        let n = graph.vertex_count();
        match Swept::of(graph) {
            Ok(swept) => self.ask(&swept, all),
            Err(error) => self.twice.ask(Some(Case::told(format!("no eigenvalue with {n} vertices: {error}")))),
        }
    }

    fn ask(&mut self, s: &Swept, all: Option<&Specimen>) {
        let h = &s.best.ratio;
        let bound = half_square(h);
        let text = || format!("h(x)²/2 = {bound} exceeds R(x) = {}", s.rayleigh);
        self.cheeger.ask((bound > s.rayleigh).then(|| s.told(text())));
        let upper = Rational::exactly(s.eigenvalue + s.error);
        let is_below = s.certified && upper.is_some_and(|upper| upper <= double(h));
        self.twice.ask((!is_below).then(|| s.told(format!("λ̃₁ = {} and 2 h(x) = {}", s.eigenvalue, double(h)))));
        self.points[1].push([s.eigenvalue, h.approximate()]);
        let Some(all) = all else { return };
        let constant = &all.chung.ratio;
        self.constant.ask((h < constant).then(|| s.told(format!("h(x) = {h} is below h = {constant}"))));
        self.found += usize::from(h == constant);
        self.worst = self.worst.max(h.approximate() / constant.approximate());
        self.points[0].push([s.eigenvalue, constant.approximate()]);
        let ends = [s.eigenvalue - s.error, s.eigenvalue + s.error].map(Rational::exactly);
        let [Some(low), Some(high)] = ends else {
            return self.enclosed.ask(Some(s.told("λ̃₁ is not finite".into())));
        };
        let is_inside = all.is_lower_bound(&low) && all.is_upper_bound(&high);
        self.enclosed.ask((!is_inside).then(|| s.told(format!("λ̃₁ is not {} ± {}", s.eigenvalue, s.error))));
    }

    fn answer(self, small: &str, large: &str) -> Vec<Finding> {
        let everything = format!("graphs: {small}, and {large}");
        let chart = chart(self.points);
        let (found, worst) = (self.found, self.worst);
        let [p0, p1, p2, p3] = std::array::from_fn(|k| ENTRY.parts[k]);
        let mut constant =
            self.constant.answer(p0, "Is the best cut of the sweep no better than the best of all?", small);
        constant.finding.push_str(&format!("; the sweep found h itself on {found} of them, at worst {worst:.3} h"));
        let mut cheeger = self.cheeger.answer(p1, "Is h(x)²/2 ≤ R(x) for the best cut of the sweep?", &everything);
        cheeger.figures.push(Figure::Chart(chart));
        let enclosed = self.enclosed.answer(
            p2,
            "Does the enclosure of λ̃₁ by Lanczos or dense decomposition contain it, by exact inertia counts?",
            small,
        );
        let mut twice = self.twice.answer(p3, "Is the enclosed λ̃₁ at most 2 h(x)?", &everything);
        twice.level = Level::Bounded;
        vec![constant, cheeger, enclosed, twice]
    }
}

/// Both constants over the eigenvalue, between the bounds of Cheeger's inequality.
fn chart([all, sweep]: [Vec<[f64; 2]>; 2]) -> Chart {
    let ends = |f: fn(f64) -> f64| {
        let eigenvalues = || sweep.iter().map(|p| p[0]);
        let (low, high) = (eigenvalues().fold(f64::INFINITY, f64::min), eigenvalues().fold(0.0, f64::max));
        [low, high].map(|x| [x, f(x)])
    };
    let series = vec![
        Series::new("√(2 λ̃₁)", Mark::Reference, ends(|x| (2.0 * x).sqrt())),
        Series::new("λ̃₁/2", Mark::Reference, ends(|x| 0.5 * x)),
        Series::new("best cut of the sweep", Mark::Dots, sweep.iter().copied()),
        Series::new("best of all partitions", Mark::Dots, all),
    ];
    let (x, y) = (Axis::logarithmic("λ̃₁"), Axis::logarithmic("cut / smaller volume"));
    Chart { title: "Cheeger constants of graphs between their bounds".into(), x, y, series }
}

fn run(setting: &Setting) -> Vec<Finding> {
    let (few, copies) = (setting.pick(8, 60), setting.pick(1, 4));
    let sizes: &[usize] = if few < 60 { &[30, 300] } else { &[20, 40, 80, 150, 300, 400] };
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let mut polls = Polls::default();
    let drawn = random_graphs(few, &mut stream).into_iter().filter(|g| component_count(g) == 1);
    for graph in drawn.collect::<Vec<_>>() {
        let graph = randomly_weighted(&graph, &mut stream);
        polls.count(Specimen::of(graph.clone()).as_ref(), graph);
    }
    for &n in sizes {
        for _ in 0..copies {
            polls.count(None, communities(n, &mut stream));
        }
    }
    let largest = sizes.last().copied().unwrap_or_default();
    polls.answer(
        "random connected graphs of 7 to 12 vertices with random weights",
        &format!("{} weighted pairs of communities of up to {largest} vertices", copies * sizes.len()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(n: usize) -> Graph {
        Graph::new(n, &(1..n).map(|k| [k - 1, k]).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn the_sweep_of_a_path_cuts_it_in_the_middle() {
        // Volume of either half of a path of ten: nine ends of edges. λ̃₁ = 1 − cos(π/9).
        let swept = Swept::of(path(10)).unwrap();
        assert_eq!(swept.best.ratio, fraction(1, 9));
        assert!(swept.best.side == [0, 1, 2, 3, 4] || swept.best.side == [5, 6, 7, 8, 9]);
        assert!((swept.eigenvalue - (1.0 - (std::f64::consts::PI / 9.0).cos())).abs() < swept.error + 1e-15);
        assert!(swept.certified && swept.error < 1e-10);
    }

    #[test]
    fn the_cheeger_bound_holds_for_vectors_that_are_no_eigenvectors() {
        let mut stream = Stream::new(5, "vectors");
        for n in [3, 6, 12, 25] {
            let graph = communities(n, &mut stream);
            let weights = graph.weights().unwrap().to_vec();
            for _ in 0..40 {
                let x: Vec<i128> = (0..n).map(|_| stream.below(9) as i128).collect();
                if x.iter().any(|v| *v != x[0]) {
                    let (best, rayleigh) = sweep(&graph, &weights, &x);
                    assert!(half_square(&best.ratio) <= rayleigh, "{x:?} on {}", describe(&graph));
                }
            }
        }
    }

    #[test]
    fn a_cut_that_is_too_good_or_too_bad_and_a_wrong_eigenvalue_are_found_out() {
        let all = Specimen::of(path(10)).unwrap();
        let answers = |spoil: &dyn Fn(&mut Swept)| {
            let mut swept = Swept::of(path(10)).unwrap();
            spoil(&mut swept);
            let mut polls = Polls::default();
            polls.ask(&swept, Some(&all));
            polls.answer("s", "l").iter().map(|f| f.agrees).collect::<Vec<_>>()
        };
        assert_eq!(answers(&|_| ()), [true; 4]);
        assert_eq!(answers(&|s| s.best.ratio = fraction(1, 10)), [false, true, true, true]);
        assert_eq!(answers(&|s| s.best.ratio = fraction(1, 2)), [true, false, true, true]);
        assert_eq!(answers(&|s| s.eigenvalue += 0.01), [true, true, false, true]);
        assert_eq!(answers(&|s| s.eigenvalue -= 0.01), [true, true, false, true]);
        assert_eq!(answers(&|s| s.eigenvalue = 0.25), [true, true, false, false]);
        assert_eq!(answers(&|s| s.certified = false), [true, true, true, false]);
    }
}
