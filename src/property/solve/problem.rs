//! The maximum principle of one Dirichlet problem: by the pattern of signs, exactly, or in floating point with bounds.

use super::chains::Chains;
use super::dirichlet::{self, Signs};
use crate::linalg::Csr;
use crate::linalg::rational::{Elimination, eliminate};
use crate::property::evidence::LARGEST_EXCERPT;
use crate::property::excerpt::{of_all_rows, of_rows};
use crate::property::measure::row;
use crate::property::tolerance::{Sign, Threshold};
use crate::property::{Evidence, Level, Statement, Trial, Verdict};
use crate::scalar::{Rational, Scalar};

/// Up to this many equations are solved in rational numbers.
const LARGEST_EXACT: usize = 10;

/// Up to this many equations an exact vector of the kernel is looked for.
const LARGEST_KERNEL: usize = 40;

fn marked(flags: &[bool]) -> Vec<usize> {
    (0..flags.len()).filter(|&i| flags[i]).collect()
}

/// How the set came about.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Chance {
    /// By the boundary of the domain.
    Given,
    /// At random, on a closed domain.
    Drawn,
}

/// A Dirichlet problem: values are prescribed on a set, the equations are the rows outside it.
pub(crate) struct Problem<'a> {
    trial: &'a Trial<'a>,
    /// The vertices where values are prescribed, ascending.
    set: Vec<usize>,
    /// The others.
    free: Vec<usize>,
    inside: Vec<bool>,
}

impl<'a> Problem<'a> {
    /// The problem with values prescribed where `inside` says so.
    pub(crate) fn new(trial: &'a Trial<'a>, inside: Vec<bool>) -> Self {
        let free = (0..inside.len()).filter(|&i| !inside[i]).collect();
        Problem { trial, set: marked(&inside), free, inside }
    }

    /// Whether there is no equation.
    pub(crate) fn is_empty(&self) -> bool {
        self.free.is_empty()
    }

    fn matrix(&self) -> &Csr {
        self.trial.operator.stiffness()
    }

    /// Decides the discrete maximum principle of this problem.
    ///
    /// `whole`: every vertex takes part, so that a certificate may speak of all.
    pub(crate) fn decide(&self, whole: bool, chance: Chance) -> Verdict {
        let rounding = self.trial.rounding();
        let chains = Chains::new(self.matrix(), |i, _, v| v < 0.0 && rounding.weight(i, v) != Sign::Zero);
        let one_sign = self.free.iter().all(|&i| row::no_negative_weight(self.matrix(), i));
        let reached = chains.lead_to(&self.set);
        let reach = self.free.iter().all(|&i| reached[i]);
        let sums = self.free.iter().all(|&i| row::sum(self.matrix(), i).abs() <= self.threshold(i).explained);
        if whole && one_sign && reach && sums && chance == Chance::Given {
            let statement = Statement::SignPattern { set: self.set.len() };
            return Verdict::holds(self.trial.level_of_signs(), Evidence::bare(statement));
        }
        if let Some(verdict) = self.cut_off() {
            return verdict;
        }
        if self.free.len() <= LARGEST_EXACT
            && let Some(verdict) = self.exactly()
        {
            return verdict;
        }
        self.in_floating_point(chance)
    }

    /// Free vertices from which no entry leads to the set, in their rows or through other rows.
    fn cut_off(&self) -> Option<Verdict> {
        let joined = Chains::new(self.matrix(), |_, _, v| v != 0.0).lead_to(&self.set);
        let lost: Vec<usize> = self.free.iter().copied().filter(|&i| !joined[i]).collect();
        let &first = lost.first()?;
        // One piece of what is lost: its rows refer to lost vertices only.
        let edges: Vec<[usize; 2]> = self
            .matrix()
            .entries()
            .filter(|&(i, j, v)| *v != 0.0 && !joined[i] && !joined[j])
            .map(|(i, j, _)| [i, j])
            .collect();
        let piece = crate::domain::topology::components(joined.len(), &edges);
        let x: Vec<(usize, f64)> = lost.iter().filter(|&&i| piece[i] == piece[first]).map(|&i| (i, 1.0)).collect();
        Some(self.singular(&x).or_else(|| self.kernel()).unwrap_or_else(|| {
            Verdict::undecided(format!(
                "no entry leads from vertex {first} to a prescribed value, so L_II is singular if row sums vanish; here they do \
                 not"
            ))
        }))
    }

    /// The witness that x is in the kernel of `L_II`, exactly or up to the rounding of a row sum.
    fn singular(&self, x: &[(usize, f64)]) -> Option<Verdict> {
        let mut full = vec![None; self.inside.len()];
        for &(i, v) in x {
            full[i] = Some(Rational::exactly(v)?);
        }
        let (mut touched, mut exact) = (Vec::new(), true);
        for &k in &self.free {
            let mut terms = Vec::new();
            for (j, v) in self.matrix().row(k) {
                if let Some(xj) = &full[j] {
                    terms.push(Rational::exactly(*v)? * xj.clone());
                }
            }
            if !terms.is_empty() {
                touched.push(k);
            }
            let scale: f64 = terms.iter().map(|t: &Rational| t.approximate().abs()).sum();
            let image = crate::scalar::sum(terms).approximate().abs();
            // Vanishing up to the rounding of the sum on the diagonal is what a correct row does.
            if image > Threshold::of_sum(scale, self.matrix().row(k).len()).explained {
                return None;
            }
            exact &= image == 0.0;
        }
        let components = self.trial.domain.components();
        let own: Vec<usize> = x.iter().map(|&(i, _)| components[i]).collect();
        let rows = (0..full.len()).filter(|k| own.contains(&components[*k]) || touched.binary_search(k).is_ok());
        let statement = Statement::Singular { set: self.set.clone(), x: x.to_vec() };
        let excerpt = if self.matrix().stored() > LARGEST_EXCERPT {
            of_rows(self.trial, touched.clone())
        } else {
            of_rows(self.trial, rows)
        };
        let level = if exact { Level::Exact } else { Level::Bounded };
        Some(Verdict::fails(level, Evidence::new(statement, excerpt)))
    }

    fn block(&self) -> Csr {
        self.matrix().submatrix(&self.free, &self.free)
    }

    /// The vertices of the set that a free row refers to: the other columns of H are zero.
    fn sources(&self) -> Vec<usize> {
        let mut met = vec![false; self.inside.len()];
        for &i in &self.free {
            self.matrix().row(i).filter(|&(j, v)| self.inside[j] && *v != 0.0).for_each(|(j, _)| met[j] = true);
        }
        marked(&met)
    }

    fn right(&self, source: usize) -> Vec<f64> {
        self.free.iter().map(|&i| -self.matrix().at(i, source)).collect()
    }

    fn thresholds(&self) -> Vec<Threshold> {
        self.free.iter().map(|&i| self.threshold(i)).collect()
    }

    fn threshold(&self, i: usize) -> Threshold {
        self.trial.rounding().row(i).times(self.trial.scales().rows[i])
    }

    fn in_floating_point(&self, chance: Chance) -> Verdict {
        let sources = self.sources();
        let found = dirichlet::signs(self.block(), &self.thresholds(), sources.len(), |k| self.right(sources[k]));
        match found {
            Ok(signs) => self.judge(&signs, &sources, chance),
            Err(_) => self.kernel().unwrap_or_else(|| Verdict::undecided("L_II is singular to working precision")),
        }
    }

    fn judge(&self, signs: &Signs, sources: &[usize], chance: Chance) -> Verdict {
        let level = match (signs.rigorous, chance) {
            (true, _) if signs.is_negative() || signs.exceeds_one() => Level::Bounded,
            (true, Chance::Given) => Level::Bounded,
            _ => Level::Measured,
        };
        let verdict = if signs.is_negative() || signs.exceeds_one() {
            let low = signs.is_negative();
            let at = if low { signs.low } else { signs.high };
            return self.overshoot(sources[at.column], at.row, at.value, low, level).with_margin(at.severity);
        } else if signs.is_nonnegative() && signs.is_at_most_one() && !signs.is_certain() {
            Verdict::undecided(signs.uncertainty())
        } else if signs.is_nonnegative() && signs.is_at_most_one() {
            let (columns, error) = (signs.columns, signs.error);
            // Without a source the solution is zero.
            let smallest = if columns == 0 { 0.0 } else { signs.smallest };
            Verdict::holds(level, Evidence::bare(Statement::Solved { columns, smallest, error }))
        } else {
            let at = if signs.is_nonnegative() { signs.high } else { signs.low };
            Verdict::undecided(format!(
                "the solution with 1 at vertex {} is {:.3e} at vertex {}, {:.1} times what rounding explains",
                sources[at.column], at.value, self.free[at.row], at.margin
            ))
        };
        let verdict = verdict.with_margin(signs.low.margin.max(signs.high.margin).max(0.0));
        if signs.rigorous {
            return verdict;
        }
        verdict.with_note("the influence of residuals is three times an estimate (Hager, Higham), not a bound")
    }

    fn overshoot(&self, source: usize, row: usize, value: f64, low: bool, level: Level) -> Verdict {
        let statement = Statement::Overshoot { set: self.set.clone(), source, at: self.free[row], value, low };
        let excerpt = of_all_rows(self.trial, self.free.iter().copied());
        Verdict::fails(level, Evidence::new(statement, excerpt))
    }

    /// Rational elimination of a small problem; `None` where the exact answer lies within what the rounding of the matrix
    /// does, so that the bounds of the other path have to weigh it.
    fn exactly(&self) -> Option<Verdict> {
        let sources = self.sources();
        let right: Vec<Vec<f64>> = sources.iter().map(|&b| self.right(b)).collect();
        let columns = match eliminate(&self.block(), &right)? {
            Elimination::Solution(columns) => columns,
            Elimination::Kernel(_) => return self.kernel(),
        };
        let bounds = dirichlet::signs(self.block(), &self.thresholds(), sources.len(), |k| right[k].clone()).ok()?;
        let one = Rational::exactly(1.0)?;
        let outside = |x: &Rational| x.cmp_zero().is_lt() || (x.clone() - one.clone()).cmp_zero().is_gt();
        if columns.iter().flatten().any(outside) {
            let low = bounds.is_negative();
            if !low && !bounds.exceeds_one() {
                return None;
            }
            let at = if low { bounds.low } else { bounds.high };
            let value = columns[at.column][at.row].approximate();
            let verdict = self.overshoot(sources[at.column], at.row, value, low, Level::Exact);
            return Some(verdict.with_margin(at.severity));
        }
        let smallest = columns.iter().flatten().map(Scalar::approximate).fold(f64::INFINITY, f64::min);
        let smallest = if columns.is_empty() { 0.0 } else { smallest };
        let statement = Statement::Solved { columns: columns.len(), smallest, error: 0.0 };
        Some(Verdict::holds(Level::Exact, Evidence::bare(statement)).with_margin(0.0))
    }

    /// An exact vector of the kernel of a small `L_II` with components that an `f64` holds.
    fn kernel(&self) -> Option<Verdict> {
        if self.free.len() > LARGEST_KERNEL {
            return None;
        }
        let Elimination::Kernel(x) = eliminate(&self.block(), &[])? else { return None };
        let largest = x.iter().max_by_key(|v| v.pow(2))?.clone();
        let ratio = |v: &dashu_int::IBig| Rational::from(v.clone()) / Rational::from(largest.clone());
        let components = self.free.iter().zip(&x).filter(|(_, v)| !v.is_zero());
        let candidate: Vec<(usize, f64)> = components.map(|(&i, v)| (i, ratio(v).approximate())).collect();
        self.singular(&candidate).or_else(|| {
            let whole = self.free.iter().zip(&x).filter(|(_, v)| !v.is_zero());
            let whole: Vec<(usize, f64)> = whole.map(|(&i, v)| (i, Rational::from(v.clone()).approximate())).collect();
            whole.iter().all(|(_, v)| v.is_finite()).then(|| self.singular(&whole)).flatten()
        })
    }
}
