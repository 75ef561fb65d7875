//! Witnesses that ask for the solution of a linear system: the Dirichlet problem, a step of heat flow.

use std::collections::{BTreeMap, BTreeSet};

use super::excerpt::{Entries, Material};
use super::solve::{Solver, System};
use super::terms::{Terms, U};
use super::{Answer, Rechecked, Refusal, bareiss, witness};
use crate::property::evidence::SparseVector;
use crate::scalar::{Rational, Scalar};

/// A component of a solution and its stated value.
#[derive(Clone, Copy)]
pub(super) struct Point {
    /// The vertex.
    pub at: usize,
    /// The value there, approximately.
    pub value: f64,
}

/// One row of a system: coefficients `a + t·b` of the unknowns, and the right-hand side.
struct Row<'a> {
    plain: Entries<'a>,
    timed: Entries<'a>,
    t: f64,
}

impl Row<'_> {
    /// The entries by column: value and bound on its rounding. One product and one sum, where there is a second matrix.
    fn rounded(&self) -> BTreeMap<usize, (f64, f64)> {
        let mut row: BTreeMap<usize, (f64, f64)> = self.plain.iter().map(|&(j, v)| (j, (v, 0.0))).collect();
        for &(j, v) in self.timed {
            let entry = row.entry(j).or_insert((0.0, 0.0));
            let product = self.t * v;
            let radius = 2.5 * U * (entry.0.abs() + product.abs()) + f64::MIN_POSITIVE;
            *entry = (entry.0 + product, radius);
        }
        row
    }

    /// The entries by column, exactly.
    fn exact(&self) -> BTreeMap<usize, Rational> {
        let rational = |x: f64| Rational::exactly(x).unwrap_or_else(Rational::zero);
        let mut row: BTreeMap<usize, Rational> = self.plain.iter().map(|&(j, v)| (j, rational(v))).collect();
        for &(j, v) in self.timed {
            let entry = row.entry(j).or_insert_with(Rational::zero);
            *entry = entry.clone() + rational(self.t) * rational(v);
        }
        row
    }
}

/// A linear system whose rows are looked up by vertex; columns in `known` do not count as unknowns.
struct Problem<'a, F: Fn(usize) -> Result<Row<'a>, Refusal>, B: Fn(usize) -> Result<f64, Refusal>> {
    row: F,
    right: B,
    known: &'a BTreeSet<usize>,
}

/// What became of a comparison with a level.
enum Decided {
    Yes(Rechecked),
    No(f64),
    Open(String),
}

impl<'a, F: Fn(usize) -> Result<Row<'a>, Refusal>, B: Fn(usize) -> Result<f64, Refusal>> Problem<'a, F, B> {
    /// The unknowns on which the one at `at` depends, ascending.
    fn unknowns(&self, at: usize) -> Result<Vec<usize>, Refusal> {
        let (mut seen, mut queue) = (BTreeSet::from([at]), vec![at]);
        while let Some(k) = queue.pop() {
            let row = (self.row)(k)?;
            for &(j, v) in row.plain.iter().chain(row.timed) {
                if v != 0.0 && !self.known.contains(&j) && seen.insert(j) {
                    queue.push(j);
                }
            }
        }
        Ok(seen.into_iter().collect())
    }

    /// Whether the component lies beyond `level`: below for `low`, above otherwise. The stated value must be right as well.
    fn beyond(&self, point: Point, level: f64, low: bool) -> Result<Decided, Refusal> {
        let unknowns = self.unknowns(point.at)?;
        let place = |v: usize| unknowns.binary_search(&v).ok();
        let right = unknowns.iter().map(|&k| (self.right)(k)).collect::<Result<Vec<_>, _>>()?;
        let mut rows = Vec::with_capacity(unknowns.len());
        for &k in &unknowns {
            let row = (self.row)(k)?.rounded();
            rows.push(row.into_iter().filter_map(|(j, (v, e))| place(j).map(|j| (j, v, e))).collect());
        }
        let at = place(point.at).unwrap_or(0);
        let system = System { rows };
        let why = match Solver::new(&system) {
            Ok(solver) => {
                let found = solver.solve(&right);
                let (x, error) = (found.x[at], found.error[at]);
                let distance = if low { level - x } else { x - level };
                if distance > error {
                    check_value(point, x, error)?;
                    return Ok(Decided::Yes(Rechecked::Bounded));
                }
                if distance < -error {
                    return Ok(Decided::No(x));
                }
                format!("the solution there is {x:e} with an error of at most {error:e}")
            }
            Err(why) => why,
        };
        if unknowns.len() > bareiss::LARGEST {
            return Ok(Decided::Open(why));
        }
        let mut exact = Vec::with_capacity(unknowns.len());
        for &k in &unknowns {
            let row = (self.row)(k)?.exact();
            exact.push(row.into_iter().filter_map(|(j, v)| place(j).map(|j| (j, v))).collect());
        }
        let rational = |x: f64| Rational::exactly(x).unwrap_or_else(Rational::zero);
        let right: Vec<Rational> = right.iter().map(|&b| rational(b)).collect();
        let Some(x) = bareiss::component(&exact, &right, at) else {
            return Err(Refusal::untrue("the system has one solution", "its matrix is singular"));
        };
        check_value(point, x.approximate(), 0.0)?;
        let distance = if low { rational(level) - x.clone() } else { x.clone() - rational(level) };
        Ok(if distance.cmp_zero().is_gt() { Decided::Yes(Rechecked::Exact) } else { Decided::No(x.approximate()) })
    }
}

fn check_value(point: Point, found: f64, error: f64) -> Result<(), Refusal> {
    if (point.value - found).abs() <= 1e-6 * found.abs() + error {
        return Ok(());
    }
    Err(Refusal::untrue(format!("the value at {} is {}", point.at, point.value), found.to_string()))
}

fn answer(decided: Decided, stated: impl Into<String>) -> Answer {
    match decided {
        Decided::Yes(level) => Ok(level),
        Decided::No(found) => Err(Refusal::untrue(stated, found.to_string())),
        Decided::Open(why) => Ok(Rechecked::Open(why)),
    }
}

fn distinct(set: &[usize]) -> Result<BTreeSet<usize>, Refusal> {
    let members: BTreeSet<usize> = set.iter().copied().collect();
    if members.len() == set.len() {
        return Ok(members);
    }
    Err(Refusal::Malformed { what: "the set of", index: set.len(), problem: "vertices names one twice" })
}

/// MAX-global: the solution of the Dirichlet problem leaves [0, 1].
pub(super) fn overshoot(m: &Material, set: &[usize], source: usize, point: Point, low: bool) -> Answer {
    let set = distinct(set)?;
    if !set.contains(&source) {
        return Err(Refusal::Malformed { what: "source", index: source, problem: "is not in the set" });
    }
    if set.contains(&point.at) {
        return Err(Refusal::Malformed { what: "vertex", index: point.at, problem: "is in the set" });
    }
    let problem = Problem {
        row: |k| Ok(Row { plain: m.rows.row(k)?, timed: &[], t: 0.0 }),
        right: |k| Ok(-m.rows.entry(k, source)?),
        known: &set,
    };
    let (level, stated) = if low { (0.0, "below 0") } else { (1.0, "above 1") };
    answer(problem.beyond(point, level, low)?, format!("the solution at {} is {stated}", point.at))
}

/// MAX-heat: entry `(at, source)` of `(M + tL)⁻¹ M` is negative.
pub(super) fn heat_loss(m: &Material, t: f64, source: usize, point: Point) -> Answer {
    if !t.is_finite() || t <= 0.0 {
        return Err(Refusal::Parameter { name: "t", value: t, must: "positive and finite" });
    }
    m.mass.row(source)?;
    let none = BTreeSet::new();
    let problem = Problem {
        row: |k| Ok(Row { plain: m.mass.row(k)?, timed: m.rows.row(k)?, t }),
        right: |k| m.mass.entry(k, source),
        known: &none,
    };
    answer(problem.beyond(point, 0.0, true)?, format!("the temperature at {} is below 0", point.at))
}

/// MAX-global: `(Lx)_k = 0` outside the set although `x ≠ 0` vanishes on it.
pub(super) fn singular(m: &Material, set: &[usize], x: &SparseVector) -> Answer {
    let set = distinct(set)?;
    let x = witness::vector(x)?;
    if let Some(v) = x.keys().find(|v| set.contains(v)) {
        return Err(Refusal::untrue("the vector vanishes on the set", format!("it does not at {v}")));
    }
    for &v in x.keys() {
        let neighbours = m.rows.row(v)?.iter().filter(|e| e.1 != 0.0 && !set.contains(&e.0));
        neighbours.map(|e| e.0).try_for_each(|w| m.rows.row(w).map(drop))?;
    }
    let mut exact = true;
    for (k, row) in m.rows.iter().filter(|r| !set.contains(&r.0)) {
        let mut product = Terms::default();
        row.iter().for_each(|(j, v)| product.add_product(*v, x.get(j).copied().unwrap_or(0.0), 1.0));
        let zero = !product.exceeds(0.0);
        exact &= zero;
        // What rounding the row's entries once, and summing them, can leave of a zero.
        let allowed = 4.0 * (row.len() as f64 + 1.0) * U * product.scale();
        if !zero && product.exceeds(allowed) {
            return Err(Refusal::untrue(format!("(Lx)_{k} = 0"), format!("{:e}", product.value())));
        }
    }
    Ok(if exact { Rechecked::Exact } else { Rechecked::Bounded })
}
