//! Point-cloud Laplacians are consistent where the bandwidth shrinks more slowly than the spacing.
//!
//! # What is measured
//! For samples of circle, sphere and torus and `f = x`, a product of coordinates and `x³`: the largest error at [`EVALUATED`]
//! points of the cloud, relative to the largest |Δf|, for the worst of the three. It is split in two: the *bias* of the smooth
//! kernel at this bandwidth, known in closed form or by quadrature without visible error, and the error of the *sum*, all the
//! rest. The operator is `point-cloud-heat`, its rows computed as in the catalogue but not put into a matrix.
//!
//! # The coupling
//! The bias is `O(t)`, the sum is off by `O(h² t^(−3/2))` at most ([`point_cloud_heat`](crate::laplacian::point_cloud_heat)):
//! both are of the order of t for `t ∝ h^(4/5)`, on a surface `n^(−2/5)`, on a curve `n^(−4/5)`. That is the coupling here, `t =
//! C ρ^(6/5) h^(4/5)` with the smallest radius of curvature ρ; t is halved from level to level, and the order of an error is
//! taken in t. On irregular samples the errors of single triangles cancel in part, so that the bias is what is left.
//!
//! # Planted
//! With t a fixed multiple of h² the sum gets worse and worse: directions do not cancel, and the error is of the order 1/h. With
//! the power of t that belongs to another dimension, or without the division by t, the limit is another one. The same rule must
//! say so.
//!
//! Orders, their intervals and the rule that decides are those of [`limit::order`](super::limit::order). A finite number of
//! samples proves no limit: the level is "measured". The largest error is one over a fixed number of points: over all n it may be
//! larger by a factor `√(ln n)`. A random sample that leaves a point without a tangent plane is refused by the operator, left out
//! here, and counted.

mod kernel;
mod shape;

use std::f64::consts::PI;

use rayon::prelude::*;

use super::limit::order::{Level as Size, Trend, judge};
use super::poll::{Case, Every};
use super::{Effort, Experiment, Finding, Setting};
use crate::figure::{Axis, Chart, Figure, Mark, Series};
use crate::generate::Stream;
use crate::laplacian::point_cloud_heat::{Heat, Sample};
use crate::property::Level;
use shape::{SHAPES, Shape, Smooth, WAYS, Way, functions};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "point-cloud-consistency",
    name: "Consistency of point-cloud Laplacians",
    statement: "jittered and random samples of circle, sphere and torus, refined: whether M⁻¹Lf of point-cloud-heat tends to −Δf at the points for \
                x, a quadratic and a cubic polynomial when the bandwidth t shrinks like h^(4/5); how the error divides into the bias of the smooth \
                kernel and the error of the sum; and whether it does not with t ∝ h², a wrong dimension, a missing division by t",
    sources: &["wardetzky-primer", "belkin-sun-wang2009", "liu2012"],
    parts: &[
        "coupled-bandwidth-converges",
        "bias-has-the-order-of-the-bandwidth",
        "sum-tends-to-the-integral",
        "bandwidth-like-the-square-does-not-converge",
        "wrong-powers-of-the-bandwidth-do-not-converge",
    ],
    run,
};

/// At how many points of a cloud the error is looked at.
pub const EVALUATED: usize = 200;

/// The order of the bandwidth in h.
const POWER: f64 = 0.8;

/// Beyond nine √t lies 3e-8 of the second moment of the kernel: far below every error here.
const CUTOFF: f64 = 9.0;

/// The ratio t/h² of the planted bandwidth.
const FIXED_RATIO: f64 = 0.25;

/// What was measured on one cloud: its bandwidth and spacing, and errors, the worst of the functions each.
struct Measured {
    h: f64,
    t: f64,
    total: f64,
    /// Of the sum alone, at the bandwidth of the coarsest cloud.
    sum: f64,
    fixed_ratio: f64,
    wrong_dimension: f64,
    wrong_time: f64,
}

/// The bandwidth of the first level and the constant of the coupling. On a curve the sum is the less accurate one at the same t and h.
fn plan(shape: Shape) -> (f64, f64) {
    match shape {
        Shape::Circle => (0.1, 1.0),
        Shape::Sphere => (0.085, 0.3),
        Shape::Torus => (0.036, 0.3),
    }
}

/// The bandwidth that goes with a spacing.
fn coupled(shape: Shape, h: f64) -> f64 {
    plan(shape).1 * shape.radius().powf(2.0 - POWER) * h.powf(POWER)
}

/// The number of points of a level: that at which the coupled bandwidth is halved from each to the next.
fn count(shape: Shape, level: usize) -> usize {
    let (first, constant) = plan(shape);
    let t = first / (1_usize << level) as f64;
    let h = (t / constant / shape.radius().powf(2.0 - POWER)).powf(1.0 / POWER);
    (shape.area() / h.powi(shape.dimension() as i32)).round() as usize
}

/// A cloud with its functions.
struct Cloud {
    shape: Shape,
    points: Vec<[f64; 3]>,
    functions: [Smooth; 3],
    values: [Vec<f64>; 3],
    /// The largest |Δf|.
    sizes: [f64; 3],
}

impl Cloud {
    fn new(Job { shape, way, level, draw }: Job, seed: u64) -> Self {
        let name = format!("point-cloud-consistency {} {} {level} {draw}", shape.name(), way.name());
        Cloud::of(shape, shape.sample(way, count(shape, level), &mut Stream::new(seed, &name)))
    }

    fn of(shape: Shape, points: Vec<[f64; 3]>) -> Self {
        let functions = functions(shape);
        let values = functions.map(|f| points.iter().map(|p| (f.value)(*p)).collect());
        let sizes = functions.map(|f| points.iter().map(|p| shape.source(&f, *p).abs()).fold(0.0, f64::max));
        Cloud { shape, points, functions, values, sizes }
    }

    /// The points that are looked at.
    fn evaluated(&self) -> impl Iterator<Item = usize> {
        let step = (self.points.len() / EVALUATED).max(1);
        (0..self.points.len()).step_by(step)
    }

    fn sources(&self, i: usize) -> [f64; 3] {
        self.functions.map(|f| self.shape.source(&f, self.points[i]))
    }

    fn smooth(&self, t: f64, i: usize) -> [f64; 3] {
        kernel::smooth(self.shape, &self.functions, t, self.points[i])
    }

    /// `M⁻¹Lf` of each function at a point.
    fn apply(&self, heat: &Heat, i: usize) -> [f64; 3] {
        let row: Vec<(usize, f64)> = heat.row(i).collect();
        [0, 1, 2].map(|k| row.iter().map(|(j, c)| c * (self.values[k][i] - self.values[k][*j])).sum())
    }

    /// The distance of two triples of values, relative to the largest |Δf| of each.
    fn distance(&self, a: [f64; 3], b: [f64; 3]) -> f64 {
        (0..3).map(|k| (a[k] - b[k]).abs() / self.sizes[k]).fold(0.0, f64::max)
    }

    fn largest(&self, error: impl Fn(usize) -> f64) -> f64 {
        self.evaluated().map(error).fold(0.0, f64::max)
    }

    fn measure(&self, coarsest: f64) -> Result<Measured, String> {
        let shape = self.shape;
        let sample = Sample::new(&self.points, shape.dimension()).map_err(|e| e.to_string())?;
        let h = sample.spacing();
        let t = coupled(shape, h);
        let at = |t: f64| sample.heat(t / (h * h), CUTOFF);
        let (heat, first) = (at(t), at(coarsest));
        let found: Vec<(usize, [f64; 3])> = self.evaluated().map(|i| (i, self.apply(&heat, i))).collect();
        // A factor times M⁻¹L: the largest error.
        let times = |factor: f64| {
            let error = |(i, value): &(usize, [f64; 3])| self.distance(value.map(|x| factor * x), self.sources(*i));
            found.iter().map(error).fold(0.0, f64::max)
        };
        // (4πt)^(−d/2) with the other of the dimensions 1 and 2; its unit of length is ten radii, so that it is far from 1.
        let power = if shape.dimension() == 1 { -0.5 } else { 0.5 };
        let other = (4.0 * PI * t / (10.0 * shape.radius()).powi(2)).powf(power);
        let fixed = sample.heat(FIXED_RATIO, CUTOFF);
        Ok(Measured {
            h,
            t,
            total: times(1.0),
            sum: self.largest(|i| self.distance(self.apply(&first, i), self.smooth(coarsest, i))),
            fixed_ratio: self.largest(|i| self.distance(self.apply(&fixed, i), self.sources(i))),
            wrong_dimension: times(other),
            wrong_time: times(t),
        })
    }
}

/// What was measured on the clouds of one shape and way: by level, then draw.
struct Study {
    shape: Shape,
    way: Way,
    levels: Vec<Vec<Measured>>,
}

/// A cloud of a study.
#[derive(Clone, Copy, PartialEq)]
struct Job {
    shape: Shape,
    way: Way,
    level: usize,
    draw: usize,
}

/// The studies, and what was said of each cloud that was refused.
fn studies(setting: &Setting) -> (Vec<Study>, Vec<String>) {
    // Small clouds cost little and vary more.
    let draws = |shape: Shape, way: Way, level: usize| match (shape, way) {
        (Shape::Circle, _) => setting.pick(3, 8),
        (_, Way::Jittered) => setting.pick(5 >> level, 8 >> level),
        (_, Way::Random) => setting.pick(7 >> level, 16 >> level),
    };
    let levels = |shape: Shape| if shape == Shape::Circle { 4 } else { 3 };
    // The clouds of a quick look are too coarse for independent points on a torus: some are refused, and what is left is too few.
    let plays = |pair: &(Shape, Way)| setting.effort == Effort::Full || *pair != (Shape::Torus, Way::Random);
    let pairs = || SHAPES.into_iter().flat_map(|shape| WAYS.map(|way| (shape, way))).filter(plays);
    let jobs = |(shape, way): (Shape, Way)| {
        let job = move |level| (0..draws(shape, way, level)).map(move |draw| Job { shape, way, level, draw });
        (0..levels(shape)).flat_map(job).collect::<Vec<_>>()
    };
    let mut all: Vec<Job> = pairs().flat_map(jobs).collect();
    // The largest first, so that no thread is left with one at the end.
    all.sort_by_key(|job| std::cmp::Reverse(count(job.shape, job.level)));
    let measure = |job: &Job| {
        let found = Cloud::new(*job, setting.seed).measure(plan(job.shape).0);
        let named = |e: String| format!("{}, {}, level {}: {e}", job.shape.name(), job.way.name(), job.level);
        found.map(|m| (*job, m)).map_err(named)
    };
    let measured: Vec<_> = all.par_iter().with_max_len(1).map(measure).collect();
    let (mut found, mut refused) = (Vec::new(), Vec::new());
    for result in measured {
        match result {
            Ok(pair) => found.push(pair),
            Err(why) => refused.push(why),
        }
    }
    let study = |(shape, way): (Shape, Way)| {
        let mut levels: Vec<Vec<Measured>> = (0..levels(shape)).map(|_| Vec::new()).collect();
        for job in jobs((shape, way)) {
            let at = found.iter().position(|(other, _)| *other == job);
            levels[job.level].extend(at.map(|at| found.swap_remove(at).1));
        }
        Study { shape, way, levels }
    };
    (pairs().map(study).collect(), refused)
}

impl Study {
    fn name(&self) -> String {
        format!("{}, {}", self.shape.name(), self.way.name())
    }

    /// Errors over what they are to fall with.
    fn sizes(&self, over: fn(&Measured) -> f64, of: fn(&Measured) -> f64) -> Vec<Size> {
        let size = |draws: &Vec<Measured>| {
            let h = draws.iter().map(over).sum::<f64>() / draws.len() as f64;
            Size { h, errors: draws.iter().map(of).collect() }
        };
        self.levels.iter().map(size).collect()
    }
}

/// One question: the cases and what they came to, in words.
#[derive(Default)]
struct Asked {
    every: Every,
    table: Vec<String>,
}

impl Asked {
    /// Whether the trend of some errors is as it should be.
    fn ask(&mut self, name: String, sizes: &[Size], right: impl Fn(&Trend) -> bool) {
        let trend = judge(sizes);
        let ends = [sizes.first(), sizes.last()].map(|s| s.map_or(f64::NAN, Size::mean));
        let text = format!("{name}: {trend}, from {:.1e} to {:.1e}", ends[0], ends[1]);
        match trend.is_open() {
            true => self.every.leave_open(text.clone()),
            false => self.every.ask((!right(&trend)).then(|| Case::told(text.clone()))),
        }
        self.table.push(text);
    }

    fn answer(self, part: &'static str, question: &str) -> Finding {
        let mut finding = self.every.answer(part, question, "refined samples");
        finding.finding += &format!("; {}", self.table.join("; "));
        finding.level = Level::Measured;
        finding
    }
}

fn run(setting: &Setting) -> Vec<Finding> {
    let [mut total, mut bias, mut sum, mut square, mut powers] = [(); 5].map(|()| Asked::default());
    let (studies, refused) = studies(setting);
    for study in &studies {
        let by_t = |of| study.sizes(|m| m.t, of);
        total.ask(study.name(), &by_t(|m| m.total), Trend::converges);
        sum.ask(study.name(), &study.sizes(|m| m.h, |m| m.sum), |t| t.converges() && t.reaches(2.0));
        square.ask(study.name(), &study.sizes(|m| m.h, |m| m.fixed_ratio), Trend::levels_off);
        let wrong = |what: &str| format!("{}, {what}", study.name());
        powers.ask(wrong("other dimension"), &by_t(|m| m.wrong_dimension), Trend::levels_off);
        powers.ask(wrong("not divided"), &by_t(|m| m.wrong_time), Trend::levels_off);
    }
    let kernels = SHAPES.map(biases);
    for (shape, sizes) in SHAPES.into_iter().zip(&kernels) {
        bias.ask(shape.name().into(), sizes, |t| t.converges() && t.reaches(1.0));
    }
    if let Some(first) = refused.first() {
        total
            .table
            .push(format!("{} samples were refused as too coarse and left out, the first: {first}", refused.len()));
    }
    let sweeps = [Shape::Circle, Shape::Sphere].into_iter().filter_map(|s| sweep(s, setting.seed).ok()).collect();
    let mut findings = vec![
        total.answer(ENTRY.parts[0], "Does the largest error at a point tend to zero with t, for t ∝ h^(4/5)?"),
        bias.answer(ENTRY.parts[1], "Does the bias of the smooth kernel fall with t at the order 1?"),
        sum.answer(ENTRY.parts[2], "Does the sum tend to the integral at a fixed t, with the order 2 in h or more?"),
        square.answer(ENTRY.parts[3], "Does the error stay, or grow, where t is a fixed multiple of h²?"),
        powers.answer(
            ENTRY.parts[4],
            "Does the error stay with the constant of another dimension, and without the division by t?",
        ),
    ];
    findings[0].figures = SHAPES.into_iter().zip(&kernels).map(|(shape, bias)| along(&studies, shape, bias)).collect();
    findings[2].figures = sweeps;
    findings
}

/// The bias of the kernel over t, halved five times, at the same points of the shape each time: no cloud is needed.
fn biases(shape: Shape) -> Vec<Size> {
    let points = shape.sample(Way::Jittered, EVALUATED / 2, &mut Stream::new(0, "point-cloud-consistency bias"));
    let cloud = Cloud::of(shape, points);
    let error = |t: f64| cloud.largest(|i| cloud.distance(cloud.smooth(t, i), cloud.sources(i)));
    let bandwidths = (0..6).map(|k| plan(shape).0 * 0.5_f64.powi(k));
    bandwidths.map(|t| Size { h: t, errors: vec![error(t)] }).collect()
}

/// The errors along the coupled sequence, and the bias in them.
fn along(studies: &[Study], shape: Shape, bias: &[Size]) -> Figure {
    let named = |name: &str, sizes: &[Size], mark: Mark| {
        let order = judge(sizes).order().map_or(String::new(), |o| format!(": order {o}"));
        Series::new(format!("{name}{order}"), mark, sizes.iter().map(|s| [s.h, s.mean()]))
    };
    let mut series = vec![named("bias of the kernel", bias, Mark::Line)];
    for study in studies.iter().filter(|s| s.shape == shape) {
        series.push(named(study.way.name(), &study.sizes(|m| m.t, |m| m.total), Mark::Both));
    }
    if let [first, .., last] = series[0].points[..] {
        let reference = [first, [last[0], first[1] * last[0] / first[0]]].map(|[t, e]| [t, 1.5 * e]);
        series.push(Series::new("slope 1", Mark::Reference, reference));
    }
    Figure::Chart(Chart {
        title: format!("Largest error on the {} along t ∝ h^(4/5)", shape.name()),
        x: Axis::logarithmic("bandwidth t"),
        y: Axis::logarithmic("error over largest |Δf|"),
        series,
    })
}

/// The error over the bandwidth for random samples of growing numbers, and the bias alone.
///
/// # Errors
/// What a sample refuses, in words.
fn sweep(shape: Shape, seed: u64) -> Result<Figure, String> {
    let bandwidths: Vec<f64> = (0..12).map(|k| 0.3 * 0.6_f64.powi(k)).collect();
    let cloud = |level| Cloud::new(Job { shape, way: Way::Random, level, draw: 0 }, seed);
    let clouds: Vec<Cloud> = (0..3).map(cloud).collect();
    let curve = |cloud: &Cloud| {
        let sample = Sample::new(&cloud.points, shape.dimension()).map_err(|e| e.to_string())?;
        let h = sample.spacing();
        let point = |&t: &f64| {
            let heat = sample.heat(t / (h * h), CUTOFF);
            [t, cloud.largest(|i| cloud.distance(cloud.apply(&heat, i), cloud.sources(i)))]
        };
        // Below a tenth of h² the kernel sees next to nothing.
        let points: Vec<[f64; 2]> = bandwidths.iter().filter(|t| **t > 0.1 * h * h).map(point).collect();
        Ok(Series::new(format!("{} points", cloud.points.len()), Mark::Both, points))
    };
    let mut series = clouds.iter().map(curve).collect::<Result<Vec<_>, String>>()?;
    let cloud = &clouds[0];
    let bias = |&t: &f64| [t, cloud.largest(|i| cloud.distance(cloud.smooth(t, i), cloud.sources(i)))];
    series.push(Series::new("bias of the kernel", Mark::Reference, bandwidths.iter().map(bias)));
    Ok(Figure::Chart(Chart {
        title: format!(
            "Largest error on random samples of the {}: the sum on the left, the bias on the right",
            shape.name()
        ),
        x: Axis::logarithmic("bandwidth t"),
        y: Axis::logarithmic("error over largest |Δf|"),
        series,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn jittered(shape: Shape, level: usize) -> Cloud {
        Cloud::new(Job { shape, way: Way::Jittered, level, draw: 0 }, 4)
    }

    #[test]
    fn bias_and_error_of_the_sum_bound_the_error() {
        for shape in SHAPES {
            let cloud = jittered(shape, 0);
            let sample = Sample::new(&cloud.points, shape.dimension()).unwrap();
            let t = coupled(shape, sample.spacing());
            let found = cloud.measure(t).unwrap();
            let bias = cloud.largest(|i| cloud.distance(cloud.smooth(t, i), cloud.sources(i)));
            assert!(found.total <= bias + found.sum + 1e-12, "{shape:?}");
            assert!(found.total < 0.7 && bias > 0.01, "{shape:?} {}", found.total);
        }
    }

    #[test]
    fn clouds_halve_their_bandwidth_which_their_spacing_tells() {
        for shape in SHAPES {
            let measured = |level: usize| {
                let cloud = jittered(shape, level);
                let sample = Sample::new(&cloud.points, shape.dimension()).unwrap();
                assert_eq!(sample.open(), 0);
                coupled(shape, sample.spacing())
            };
            let [coarse, fine] = [0, 1].map(measured);
            assert!((coarse / plan(shape).0 - 1.0).abs() < 0.05, "{shape:?} {coarse}");
            assert!((coarse / fine - 2.0).abs() < 0.1, "{shape:?} {coarse} {fine}");
        }
    }

    #[test]
    fn a_constant_that_is_wrong_is_seen_by_the_rule_that_sees_the_right_one_converge() {
        let levels: Vec<Vec<Measured>> =
            (0..4).map(|level| vec![jittered(Shape::Circle, level).measure(0.1).unwrap()]).collect();
        let study = Study { shape: Shape::Circle, way: Way::Jittered, levels };
        let trend = |of| judge(&study.sizes(|m| m.t, of));
        assert!(trend(|m| m.total).converges());
        assert!(trend(|m| m.wrong_dimension).levels_off() && trend(|m| m.wrong_time).levels_off());
        assert!(judge(&study.sizes(|m| m.h, |m| m.fixed_ratio)).levels_off());
    }
}
