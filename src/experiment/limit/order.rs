//! The order of convergence of measured errors, and when there is none.
//!
//! # Definition
//! Errors e at K ≥ 3 mesh sizes h, from large to small, of several independent meshes a size where they are drawn at random:
//! ```text
//! ln e = a + p ln h + b(h) + noise
//! ```
//! with noise of mean zero, independent and normal, of one variance σ² for all sizes (where it falls under refinement the estimate below errs
//! to the safe side), and b(h) → 0 what keeps the error from being a power yet. The order p is the slope of least squares over the
//! means of the sizes. Its half-width adds two things:
//! * `t₀.₉₇₅(N − K) s √Σ c²/m`, the confidence interval of the slope `Σ c · mean`, m meshes a size, N in all. s² is the variance within
//!   the sizes: it knows noise and nothing of b. With one mesh a size there is no noise, and this is zero.
//! * `|p′ − p| + |p′ − p″|/(q − 1)`, with p″ and p′ the slopes over the coarser and over the finer ⌈K/2⌉ sizes (all but one for K ≤ 4) and q
//!   the ratio of the mesh sizes in the middles of the two. For `e = C hᵖ (1 + c hʳ + …)`, r ≥ 1, the finer slope is nearer to its limit than
//!   the coarser by the factor qʳ ≥ q, to first order in c hʳ, so that it is still off by no more than this.
//!
//! # The verdict
//! An error that stays has the order 0, and no convergence theorem about piecewise linear functions promises less than 1: the dividing line
//! is ½. *Converges*: the whole interval lies above ½, and the mean error falls at every size. *Levels off*: the whole interval lies
//! below ½. *Exact*: every error is zero, that is, one that rounding explains, as those who measure say. Else *undecided*. Each can come
//! out for each sequence of numbers, and the rule knows nothing of what is expected.

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
        self.middle().exp()
    }

    /// The mean of `ln e`.
    fn middle(&self) -> f64 {
        self.errors.iter().map(|e| e.ln()).sum::<f64>() / self.errors.len() as f64
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

    /// Whether it converges with an interval that reaches `p` or an order nearer to `p` than to `p − 1`, the next one that theory
    /// knows; or is exact.
    pub fn reaches(&self, p: f64) -> bool {
        match self {
            Trend::Converges(order) => order.p + order.half_width.max(DIVIDE) >= p,
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
    let falls = levels.windows(2).all(|w| w[1].mean() < w[0].mean());
    if falls && order.p - order.half_width > DIVIDE {
        Trend::Converges(order)
    } else if order.p + order.half_width < DIVIDE {
        Trend::LevelsOff(order)
    } else {
        Trend::Undecided(Some(order))
    }
}

/// The line of slope p through the middle of the points, from the largest size to the smallest: what a chart shows as the fit.
pub fn fitted(levels: &[Level], p: f64) -> Vec<[f64; 2]> {
    let (x, y) = (mean(levels, |l| l.h.ln()), mean(levels, Level::middle));
    let ends = [levels.first(), levels.last()];
    ends.into_iter().flatten().map(|l| [l.h, (y + p * (l.h.ln() - x)).exp()]).collect()
}

fn mean(levels: &[Level], f: impl Fn(&Level) -> f64) -> f64 {
    levels.iter().map(f).sum::<f64>() / levels.len() as f64
}

/// The slope of least squares over the means of the sizes, and the `√Σ c²/m` by which it varies for σ = 1.
fn slope(levels: &[Level]) -> [f64; 2] {
    let x = mean(levels, |l| l.h.ln());
    let spread: f64 = levels.iter().map(|l| (l.h.ln() - x).powi(2)).sum();
    let weight = |l: &Level| (l.h.ln() - x) / spread;
    let variance: f64 = levels.iter().map(|l| weight(l).powi(2) / l.errors.len() as f64).sum();
    [levels.iter().map(|l| weight(l) * l.middle()).sum(), variance.sqrt()]
}

fn order(levels: &[Level]) -> Option<Order> {
    let sizes = levels.len();
    let window = sizes.div_ceil(2).max(sizes.min(4).saturating_sub(1));
    if sizes < 3 || levels.iter().any(|l| l.errors.is_empty()) {
        return None;
    }
    let (coarse, fine) = (&levels[..window], &levels[sizes - window..]);
    let [[p, deviation], [before, _], [last, _]] = [slope(levels), slope(coarse), slope(fine)];
    let ratio = (mean(coarse, |l| l.h.ln()) - mean(fine, |l| l.h.ln())).exp();
    let within = |l: &Level| l.errors.iter().map(|e| (e.ln() - l.middle()).powi(2)).sum::<f64>();
    let freedom = levels.iter().map(|l| l.errors.len() - 1).sum::<usize>();
    let noise = match student::quantile(freedom) {
        Some(t) => t * (levels.iter().map(within).sum::<f64>() / freedom as f64).sqrt() * deviation,
        None => 0.0,
    };
    let half_width = noise + (last - p).abs() + (last - before).abs() / (ratio - 1.0);
    (p.is_finite() && half_width.is_finite() && ratio > 1.0).then_some(Order { p, half_width })
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
                // A fifth for what the first order in c hʳ leaves out: it is as large as ⅜.
                assert!(
                    (order.p - 2.0).abs() <= 1.2 * order.half_width && order.half_width < 0.6,
                    "{c} {r}: {order:?}"
                );
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
