//! Scans: every place is looked at again. Here the predicates on the matrix; see [`precision`](super::precision) for those on
//! coordinates and [`shares`](super::shares) for masses.

use super::leeway::Leeway;
use super::terms::Terms;
use super::{Answer, Rechecked, Refusal, accuracy, place, precision, shares};
use crate::domain::Domain;
use crate::linalg::Csr;
use crate::operator::{Operator, Signs};

/// What a scan of our own came to: whether nothing had to be put down to rounding, and how many places there are.
pub(super) struct Seen {
    pub exact: bool,
    pub places: usize,
}

/// Decides the certificate "every place was looked at and none violates the property".
pub(super) fn decide(property: &str, domain: &Domain, operator: &Operator, checked: usize, worst: &[usize]) -> Answer {
    let n = domain.vertex_count();
    if let Some(&index) = worst.iter().find(|&&v| v >= n) {
        return Err(Refusal::Missing { what: "vertex", index });
    }
    let l = operator.stiffness();
    if property == "FIN" {
        let masses = operator.mass().map_or(Ok(0), |m| check_finite(m.matrix()).map(|()| m.matrix().stored()))?;
        check_finite(l)?;
        return conclude(Seen { exact: true, places: l.stored() + masses }, checked, domain, operator);
    }
    check_finite(l)?;
    let scan = Scan { domain, operator, leeway: Leeway::of(domain, l) };
    let seen = match property {
        "LOC" => scan.local(),
        "SYM" => scan.pairs(),
        "NULL" => row_sums(l, &scan.leeway, 0..n).map(|exact| Seen { exact, places: n }),
        "POS" | "POS0" | "POS-boundary" => scan.positive(property),
        "MVP" => scan.mean_value(),
        "MAX-local" => scan.local_maximum(),
        "LIN" if domain.as_surface().is_none() => {
            return Ok(Rechecked::Open("linear precision is scanned for on surfaces only".into()));
        }
        "LIN" => precision::linear(&scan),
        "FLUX" => precision::flux(&scan),
        "ENERGY" => precision::energy(&scan),
        "ACC" => accuracy::scan(&scan),
        "MASS" => return shares::scan(domain, operator),
        other => return Ok(Rechecked::Open(format!("this program knows no predicate '{other}' to scan for"))),
    }?;
    conclude(seen, checked, domain, operator)
}

/// Refuses a number of places that is smaller than ours, or larger than all there are.
fn conclude(seen: Seen, checked: usize, domain: &Domain, operator: &Operator) -> Answer {
    let stored = operator.stiffness().stored() + operator.mass().map_or(0, |m| m.matrix().stored());
    let most = 2 * (stored + domain.edges().len()) + 4 * domain.vertex_count();
    if checked < seen.places || checked > most {
        return Err(Refusal::untrue(format!("{checked} places were looked at"), format!("there are {}", seen.places)));
    }
    Ok(if seen.exact { Rechecked::Exact } else { Rechecked::Bounded })
}

/// Refuses a NaN or an infinity.
pub(super) fn check_finite(matrix: &Csr) -> Result<(), Refusal> {
    match matrix.entries().find(|e| !e.2.is_finite()) {
        Some((i, j, v)) => Err(Refusal::untrue("every entry is finite", format!("({i}, {j}) is {v}"))),
        None => Ok(()),
    }
}

/// Refuses an asymmetry beyond rounding; whether there is none at all.
pub(super) fn symmetric(matrix: &Csr, leeway: &Leeway) -> Result<bool, Refusal> {
    let mut exact = true;
    for (i, j, v) in matrix.entries() {
        let other = matrix.at(j, i);
        exact &= *v == other;
        if (v - other).abs() > leeway.pair(i, j) {
            return Err(Refusal::untrue(format!("A_{i},{j} = A_{j},{i}"), format!("{v} and {other}")));
        }
    }
    Ok(exact)
}

/// Refuses a row sum beyond rounding; whether all vanish exactly.
pub(super) fn row_sums(matrix: &Csr, leeway: &Leeway, rows: impl Iterator<Item = usize>) -> Result<bool, Refusal> {
    let mut exact = true;
    for i in rows {
        let mut sum = Terms::default();
        matrix.row(i).for_each(|(_, v)| sum.add(*v));
        check_sum(&sum, leeway.rows[i], || format!("row {i} sums to zero"))?;
        exact &= sum.value() == 0.0 && !sum.exceeds(0.0);
    }
    Ok(exact)
}

/// Refuses a sum beyond what is allowed.
pub(super) fn check_sum(sum: &Terms, allowed: f64, stated: impl Fn() -> String) -> Result<(), Refusal> {
    if sum.exceeds(allowed) {
        let found = format!("{:e}, where rounding explains {allowed:e}", sum.value());
        return Err(Refusal::untrue(stated(), found));
    }
    Ok(())
}

/// An operator under scrutiny, with what rounding excuses.
pub(super) struct Scan<'a> {
    pub domain: &'a Domain,
    pub operator: &'a Operator,
    pub leeway: Leeway,
}

impl Scan<'_> {
    /// What passes for zero in row i when the sign of an entry is asked.
    fn zone(&self, i: usize) -> f64 {
        if self.operator.signs() == Signs::Exact { 0.0 } else { self.leeway.rows[i] }
    }

    fn local(&self) -> Result<Seen, Refusal> {
        let mut seen = Seen { exact: true, places: 0 };
        let edges = self.domain.edges();
        for (i, j, v) in self.operator.stiffness().entries().filter(|e| e.0 != e.1 && *e.2 != 0.0) {
            seen.places += 1;
            let joined = edges.binary_search(&[i.min(j), i.max(j)]).is_ok();
            let share = || {
                let surface = self.domain.as_surface();
                surface.is_some_and(|s| s.topology().star(i).iter().any(|c| s.faces()[c.face()].contains(&j)))
            };
            if joined || share() {
                continue;
            }
            seen.exact = false;
            if v.abs() > self.leeway.rows[i] {
                return Err(Refusal::untrue(format!("({i}, {j}) share a face or an edge"), format!("L_{i},{j} = {v}")));
            }
        }
        Ok(seen)
    }

    fn pairs(&self) -> Result<Seen, Refusal> {
        let l = self.operator.stiffness();
        let exact = symmetric(l, &self.leeway)?;
        let places = l.entries().filter(|&(i, j, _)| i < j || (i > j && l.get(j, i).is_none())).count();
        Ok(Seen { exact, places })
    }

    /// The edges of the class that the property speaks of, in both directions; POS and POS0 speak of every entry off the edges
    /// of the domain as well. Edges at which an operator with edges of its own stores nothing carry no weight.
    fn positive(&self, property: &str) -> Result<Seen, Refusal> {
        let (l, edges) = (self.operator.stiffness(), self.domain.edges());
        let mut seen = Seen { exact: true, places: 0 };
        let mut check = |i: usize, j: usize| {
            let v = l.at(i, j);
            let allowed = if property == "POS0" { self.zone(i) } else { 0.0 };
            seen.exact &= v <= 0.0;
            if v > allowed || (property != "POS0" && v == 0.0) {
                return Err(Refusal::untrue(format!("the weight of ({i}, {j}) is positive"), (-v).to_string()));
            }
            Ok(())
        };
        let mut places = 0;
        let (own, on_boundary) = (place::has_own_edges(self.domain, l), place::boundary_edges(self.domain));
        for (&[i, j], &boundary) in edges.iter().zip(&on_boundary) {
            let absent = own && l.get(i, j).is_none() && l.get(j, i).is_none();
            if boundary == (property == "POS-boundary") && !absent {
                places += 1;
                check(i, j).and_then(|()| check(j, i))?;
            }
        }
        if property != "POS-boundary" {
            for (i, j, _) in l.entries().filter(|&(i, j, v)| i != j && *v != 0.0) {
                if edges.binary_search(&[i.min(j), i.max(j)]).is_err() {
                    places += usize::from(i < j || l.at(j, i) == 0.0);
                    check(i, j)?;
                }
            }
        }
        seen.places = places;
        Ok(seen)
    }

    /// The interior vertices with an edge.
    fn interior(&self) -> Vec<usize> {
        let mut touched = vec![false; self.domain.vertex_count()];
        self.domain.edges().iter().flatten().for_each(|&v| touched[v] = true);
        self.domain.interior().into_iter().filter(|&i| touched[i]).collect()
    }

    fn mean_value(&self) -> Result<Seen, Refusal> {
        let (l, rows) = (self.operator.stiffness(), self.interior());
        let mut exact = row_sums(l, &self.leeway, rows.iter().copied())?;
        for &i in &rows {
            if l.at(i, i) <= 0.0 {
                return Err(Refusal::untrue(format!("L_{i},{i} > 0"), l.at(i, i).to_string()));
            }
            for (j, v) in l.row(i).filter(|e| e.0 != i) {
                exact &= *v <= 0.0;
                if *v > self.zone(i) {
                    return Err(Refusal::untrue(format!("row {i} has no negative share"), format!("L_{i},{j} = {v}")));
                }
            }
        }
        Ok(Seen { exact, places: rows.len() })
    }

    fn local_maximum(&self) -> Result<Seen, Refusal> {
        let l = self.operator.stiffness();
        let outside = place::prescribed(self.domain, self.operator);
        let mut seen = Seen { exact: true, places: 0 };
        for i in (0..l.rows()).filter(|&i| !outside[i]) {
            seen.places += 1;
            let weights = || l.row(i).filter(|e| e.0 != i && *e.1 != 0.0).map(|e| *e.1);
            let zone = self.zone(i);
            let both = weights().any(|v| v < -zone) && weights().any(|v| v > zone);
            if both || weights().next().is_none() {
                let found = if both { "both signs" } else { "no weight at all" };
                return Err(Refusal::untrue(format!("the weights of row {i} have one sign"), found));
            }
            seen.exact &= !weights().any(|v| v.abs() <= zone);
        }
        Ok(seen)
    }
}
