//! Looking at one place after another and keeping the worst.

use super::tolerance::{Judgement, Threshold};
use crate::linalg::parallel;
use crate::property::Verdict;
use crate::property::evidence::{Evidence, Statement};
use crate::property::verdict::{Level, Tally};

/// A place of a domain: a vertex `[i]` or a pair `[i, j]`.
pub(crate) type Place = Vec<usize>;

/// A place with its residual.
#[derive(Clone, Debug)]
pub(crate) struct Finding<P> {
    /// Where.
    pub place: P,
    /// The residual found there.
    pub residual: f64,
    /// What it is measured against.
    pub threshold: Threshold,
}

impl<P> Finding<P> {
    fn judgement(&self) -> Judgement {
        self.threshold.judge(self.residual)
    }

    fn margin(&self) -> f64 {
        self.threshold.margin(self.residual)
    }

    fn worse_than(&self, other: &Self) -> bool {
        (self.judgement(), self.margin()) > (other.judgement(), other.margin())
    }
}

/// The places looked at so far: how many of each judgement, and the worst.
pub(crate) struct Scan<P> {
    tally: Tally,
    worst: Option<Finding<P>>,
    /// Whether a margin is not a number: then which finding is the worst depends on where one begins.
    unordered: bool,
}

impl<P: Send> Scan<P> {
    /// The scan of `look(0), look(1), …`, block by block in parallel; the result is that of looking in order.
    pub fn over(count: usize, look: impl Fn(usize, &mut Scan<P>) + Sync + Send) -> Self {
        let whole = |range: std::ops::Range<usize>| {
            let mut scan = Scan::new();
            range.for_each(|k| look(k, &mut scan));
            scan
        };
        let parts = parallel::blocks(count, whole);
        if parts.iter().any(|part| part.unordered) {
            return whole(0..count);
        }
        parts.into_iter().fold(Scan::new(), Scan::then)
    }
}

impl<P> Scan<P> {
    pub fn new() -> Self {
        Scan { tally: Tally::default(), worst: None, unordered: false }
    }

    /// What comes of looking at the places of both, those of `self` first.
    fn then(mut self, other: Self) -> Self {
        self.tally.total += other.tally.total;
        self.tally.undecided += other.tally.undecided;
        self.tally.violations += other.tally.violations;
        match (&self.worst, other.worst) {
            (Some(worst), Some(found)) if !found.worse_than(worst) => {}
            (_, Some(found)) => self.worst = Some(found),
            (_, None) => {}
        }
        self
    }

    /// Looks at a place without any residual, whose threshold is finite: it is asked for only where this is the first place.
    pub fn pass(&mut self, place: P, threshold: impl FnOnce() -> Threshold) {
        match self.worst {
            Some(_) => self.tally.total += 1,
            None => self.look(place, 0.0, threshold()),
        }
    }

    /// Looks at a place. Of equally bad ones the first is kept.
    pub fn look(&mut self, place: P, residual: f64, threshold: Threshold) {
        let finding = Finding { place, residual, threshold };
        self.unordered |= finding.margin().is_nan();
        self.tally.total += 1;
        match finding.judgement() {
            Judgement::Explained => {}
            Judgement::Open => self.tally.undecided += 1,
            Judgement::Defect => self.tally.violations += 1,
        }
        if self.worst.as_ref().is_none_or(|worst| finding.worse_than(worst)) {
            self.worst = Some(finding);
        }
    }

    /// Whether nothing was looked at.
    pub fn is_empty(&self) -> bool {
        self.tally.total == 0
    }

    /// The largest margin among the places so far, 0 if there are none.
    pub fn margin(&self) -> f64 {
        self.worst.as_ref().map_or(0.0, Finding::margin)
    }

    /// The verdict: fails at a defect, undecided at an open place, else holds. `name` gives the place of a finding;
    /// `witness` makes the evidence of a failure.
    pub fn verdict(
        self,
        level: Level,
        name: impl FnOnce(&P) -> Place,
        witness: impl FnOnce(&Finding<P>) -> Evidence,
    ) -> Verdict {
        let checked = self.tally.total;
        let Some(worst) = self.worst else {
            return Verdict::holds(level, Evidence::bare(Statement::Scan { checked, worst: Vec::new() }));
        };
        let verdict = match worst.judgement() {
            Judgement::Explained => {
                Verdict::holds(level, Evidence::bare(Statement::Scan { checked, worst: name(&worst.place) }))
            }
            Judgement::Open => Verdict::undecided(gap(&name(&worst.place), worst.residual, worst.threshold)),
            Judgement::Defect => Verdict::fails(level, witness(&worst)),
        };
        verdict.with_margin(worst.margin()).with_tally(self.tally)
    }
}

/// Why a residual decides nothing.
pub(crate) fn gap(place: &[usize], residual: f64, threshold: Threshold) -> String {
    let at = match place {
        [] => String::new(),
        [i] => format!("at vertex {i} "),
        pair => format!("at {pair:?} "),
    };
    if !threshold.explained.is_finite() || !residual.is_finite() {
        return format!("{at}the numbers are beyond the range of f64; rescale the operator");
    }
    format!(
        "{at}the residual {residual:.2e} is above {:.2e}, which rounding explains, and not above {:.2e}, which only a \
         defect explains",
        threshold.explained, threshold.defect
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::Status;

    fn verdict(residuals: &[f64]) -> Verdict {
        let mut scan = Scan::new();
        let threshold = Threshold { explained: 1.0, defect: 10.0 };
        residuals.iter().enumerate().for_each(|(i, &r)| scan.look(i, r, threshold));
        let witness =
            |f: &Finding<usize>| Evidence::bare(Statement::RowSum { i: f.place, threshold: f.threshold.defect });
        scan.verdict(Level::Measured, |&i| vec![i], witness)
    }

    #[test]
    fn the_worst_judgement_decides_and_the_tally_counts_the_rest() {
        assert_eq!(verdict(&[0.0, 0.5]).status(), Status::Holds);
        assert_eq!(verdict(&[0.0, 5.0]).status(), Status::Undecided);
        let fails = verdict(&[0.0, 5.0, 11.0, 20.0, 20.0]);
        assert_eq!(fails.evidence().unwrap().statement, Statement::RowSum { i: 3, threshold: 10.0 });
        assert_eq!(fails.tally, Some(Tally { violations: 3, zeros: 0, undecided: 1, total: 5 }));
        assert_eq!(fails.margin, Some(20.0));
    }

    #[test]
    fn scanning_in_blocks_is_scanning_in_order_even_where_a_margin_is_no_number() {
        let t = |explained: f64| Threshold { explained, defect: 8.0 * explained };
        for odd in [None, Some(3), Some(4096), Some(9000)] {
            let residual = |k: usize| if odd == Some(k) { f64::NAN } else { ((k * 7919) % 1009) as f64 };
            let look = |k: usize, scan: &mut Scan<usize>| scan.look(k, residual(k), t(1.0 + (k % 3) as f64));
            let (mut one, all) = (Scan::new(), Scan::over(10_000, look));
            (0..10_000).for_each(|k| look(k, &mut one));
            let place = |s: &Scan<usize>| s.worst.as_ref().map(|w| (w.place, w.residual.to_bits()));
            assert_eq!((one.tally, place(&one)), (all.tally, place(&all)), "{odd:?}");
        }
    }

    #[test]
    fn a_defect_outweighs_an_open_place_with_a_larger_margin() {
        let mut scan = Scan::new();
        scan.look(0, 100.0, Threshold { explained: 1.0, defect: 1e9 });
        scan.look(1, 3.0, Threshold { explained: 1.0, defect: 2.0 });
        let verdict = scan.verdict(
            Level::Measured,
            |&i| vec![i],
            |f| Evidence::bare(Statement::RowSum { i: f.place, threshold: f.threshold.defect }),
        );
        assert_eq!(verdict.status(), Status::Fails);
    }
}
