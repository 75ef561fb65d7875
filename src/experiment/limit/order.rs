//! The order of convergence of measured errors, and when there is none.
//!
//! # Definition
//! Errors e at mesh sizes h, several meshes a size where they are drawn at random: `ln e = a + p ln h + noise`. The order p is the
//! slope of least squares over all meshes. Its half-width adds two things:
//! * `t₀.₉₇₅(N − 2) s/√S_xx`, the confidence interval of the slope, for what varies from mesh to mesh;
//! * `|p_last − p| + |p_last − p_before|`, with p_last the slope between the last two sizes and p_before the one between the two
//!   before, of the geometric means of each size. For `e = C hᵖ (1 + c hʳ + …)`, r ≥ 1, and sizes halved, the slope between neighbours
//!   comes nearer to its limit by a factor 2ʳ ≥ 2 each time, so that it is still off by no more than it has just moved.
//!
//! # The verdict
//! An error that stays has the order 0, and no convergence theorem about piecewise linear functions promises less than 1: the dividing line
//! is ½. *Converges*: the whole interval lies above ½, and the mean error falls at every size. *Levels off*: the whole interval lies
//! below ½, and so does the slope over the last two sizes. *Exact*: every error is zero, that is, one that rounding explains, as those who
//! measure say. Else *undecided*. Each can come out for each sequence of numbers.

use super::student;

/// The order that separates convergence from none.
pub const DIVIDE: f64 = 0.5;

/// The errors at one mesh size.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// The mesh size.
    pub h: f64,
    /// The error of each mesh.
    pub errors: Vec<f64>,
}

impl Level {
    /// The geometric mean of the errors.
    pub fn mean(&self) -> f64 {
        (self.errors.iter().map(|e| e.ln()).sum::<f64>() / self.errors.len() as f64).exp()
    }
}

/// An order with its half-width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Order {
    /// The slope.
    pub p: f64,
    /// Half the width of its interval.
    pub half_width: f64,
}

impl std::fmt::Display for Order {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.2} ± {:.2}", self.p, self.half_width)
    }
}

/// What a sequence of errors says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trend {
    /// It falls with this order.
    Converges(Order),
    /// There is none.
    Exact,
    /// It stays.
    LevelsOff(Order),
    /// Neither can be said.
    Undecided(Option<Order>),
}

impl std::fmt::Display for Trend {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Trend::Converges(order) => write!(f, "converges with order {order}"),
            Trend::Exact => write!(f, "is exact up to rounding"),
            Trend::LevelsOff(order) => write!(f, "levels off, order {order}"),
            Trend::Undecided(Some(order)) => write!(f, "undecided, order {order}"),
            Trend::Undecided(None) => write!(f, "undecided: no order"),
        }
    }
}

impl Trend {
    /// The order, where there is one.
    pub fn order(&self) -> Option<Order> {
        match self {
            Trend::Converges(order) | Trend::LevelsOff(order) => Some(*order),
            Trend::Undecided(order) => *order,
            Trend::Exact => None,
        }
    }

    /// Whether it converges, at whatever order, or is exact.
    pub fn converges(&self) -> bool {
        matches!(self, Trend::Converges(_) | Trend::Exact)
    }

    /// Whether it converges with an interval that reaches `p`, or is exact.
    pub fn reaches(&self, p: f64) -> bool {
        match self {
            Trend::Converges(order) => order.p + order.half_width >= p,
            other => *other == Trend::Exact,
        }
    }

    /// Whether it decides nothing.
    pub fn is_open(&self) -> bool {
        matches!(self, Trend::Undecided(_))
    }

    /// Whether it levels off.
    pub fn levels_off(&self) -> bool {
        matches!(self, Trend::LevelsOff(_))
    }
}

/// The verdict on errors at sizes from coarse to fine. Fewer than three sizes, or an error that is not a positive number,
/// decide nothing.
pub fn judge(levels: &[Level]) -> Trend {
    let mut errors = levels.iter().flat_map(|l| &l.errors);
    if levels.len() >= 3 && errors.all(|e| *e == 0.0) {
        return Trend::Exact;
    }
    let Some(order) = order(levels) else { return Trend::Undecided(None) };
    let means: Vec<f64> = levels.iter().map(Level::mean).collect();
    let falls = means.windows(2).all(|w| w[1] < w[0]);
    let last = slopes(levels).last().copied().unwrap_or(f64::NAN);
    if falls && order.p - order.half_width > DIVIDE {
        Trend::Converges(order)
    } else if order.p + order.half_width < DIVIDE && last < DIVIDE {
        Trend::LevelsOff(order)
    } else {
        Trend::Undecided(Some(order))
    }
}

/// The line of slope p through the middle of the points, from the largest size to the smallest: what a chart shows as the fit.
pub fn fitted(levels: &[Level], p: f64) -> Vec<[f64; 2]> {
    let count = levels.iter().map(|l| l.errors.len()).sum::<usize>() as f64;
    let middle = |f: &dyn Fn(&Level, f64) -> f64| {
        levels.iter().flat_map(|l| l.errors.iter().map(move |e| (l, *e))).map(|(l, e)| f(l, e)).sum::<f64>() / count
    };
    let (x, y) = (middle(&|l, _| l.h.ln()), middle(&|_, e| e.ln()));
    let ends = [levels.first(), levels.last()];
    ends.into_iter().flatten().map(|l| [l.h, (y + p * (l.h.ln() - x)).exp()]).collect()
}

fn slopes(levels: &[Level]) -> Vec<f64> {
    levels.windows(2).map(|w| (w[1].mean() / w[0].mean()).ln() / (w[1].h / w[0].h).ln()).collect()
}

fn order(levels: &[Level]) -> Option<Order> {
    let points: Vec<[f64; 2]> = levels.iter().flat_map(|l| l.errors.iter().map(|e| [l.h.ln(), e.ln()])).collect();
    let steps = slopes(levels);
    let [.., before, last] = steps[..] else { return None };
    if points.iter().chain(&[[before, last]]).flatten().any(|x| !x.is_finite()) {
        return None;
    }
    let count = points.len() as f64;
    let mean = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let spread: f64 = points.iter().map(|p| (p[0] - x).powi(2)).sum();
    let p = points.iter().map(|q| (q[0] - x) * (q[1] - y)).sum::<f64>() / spread;
    let rest: f64 = points.iter().map(|q| (q[1] - y - p * (q[0] - x)).powi(2)).sum();
    let error = (rest / (count - 2.0) / spread).sqrt();
    let half_width =
        student::quantile(points.len().checked_sub(2)?)? * error + (last - p).abs() + (last - before).abs();
    half_width.is_finite().then_some(Order { p, half_width })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Stream;

    fn levels(error: impl Fn(f64) -> f64) -> Vec<Level> {
        (3..7).map(|k| 0.5_f64.powi(k)).map(|h| Level { h, errors: vec![error(h)] }).collect()
    }

    #[test]
    fn a_pure_power_has_its_order_without_width() {
        for p in [0.75, 1.0, 2.0, 4.0] {
            let Trend::Converges(order) = judge(&levels(|h| 3.0 * h.powf(p))) else { panic!("{p}") };
            assert!((order.p - p).abs() < 1e-12 && order.half_width < 1e-10, "{order:?}");
            let points = levels(|h| 3.0 * h.powf(p));
            let line = fitted(&points, p);
            assert!((line[0][1] / points[0].errors[0] - 1.0).abs() < 1e-12 && line[1][0] == points[3].h);
        }
    }

    #[test]
    fn the_interval_contains_the_order_that_a_second_term_hides() {
        for c in [-2.0, -0.5, 0.5, 3.0] {
            for r in [1, 2] {
                let trend = judge(&levels(|h| h * h * (1.0 + c * h.powi(r))));
                let Trend::Converges(order) = trend else { panic!("{c} {r}: {trend}") };
                assert!((order.p - 2.0).abs() <= order.half_width && order.half_width < 0.6, "{c} {r}: {order:?}");
            }
        }
    }

    #[test]
    fn an_error_that_stays_or_grows_or_falls_like_a_logarithm_does_not_converge() {
        assert!(judge(&levels(|_| 0.3)).levels_off());
        assert!(judge(&levels(|h| 0.3 + h)).levels_off());
        assert!(judge(&levels(|h| 1.0 / h)).levels_off());
        assert!(!judge(&levels(|h| 1.0 / -h.ln())).converges());
        assert!(!judge(&levels(|h| 0.01 + h * h)).converges());
    }

    #[test]
    fn what_rises_once_does_not_converge_whatever_its_slope() {
        let mut rising = levels(|h| h * h);
        rising[2].errors[0] = 1.01 * rising[1].errors[0];
        assert!(!judge(&rising).converges());
    }

    #[test]
    fn too_few_sizes_and_no_numbers_decide_nothing() {
        assert_eq!(judge(&levels(|h| h)[..2]), Trend::Undecided(None));
        assert_eq!(judge(&[]), Trend::Undecided(None));
        assert_eq!(judge(&levels(|_| f64::NAN)), Trend::Undecided(None));
        assert_eq!(judge(&levels(|h| if h > 0.05 { 0.0 } else { 1e-3 })), Trend::Undecided(None));
        assert_eq!(judge(&levels(|_| 0.0)), Trend::Exact);
    }

    /// Noise of a twentieth in each error, three meshes a size: the interval misses the true order no more often than one in
    /// twenty.
    #[test]
    fn the_interval_covers_the_order_of_noisy_errors() {
        let mut stream = Stream::new(5, "noise");
        let mut missed = 0;
        for _ in 0..400 {
            let noisy: Vec<Level> = (3..7)
                .map(|k| 0.5_f64.powi(k))
                .map(|h| Level { h, errors: (0..3).map(|_| h * stream.between(-0.05, 0.05).exp()).collect() })
                .collect();
            match judge(&noisy) {
                Trend::Converges(order) => missed += usize::from((order.p - 1.0).abs() > order.half_width),
                other => panic!("{other}"),
            }
        }
        assert!(missed <= 20, "{missed} of 400");
    }
}
