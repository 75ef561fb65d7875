//! Two operators on one domain, entry by entry, within the bound that the mesh's conditioning sets.

use std::fmt;

use serde::Serialize;

use crate::domain::Domain;
use crate::operator::Operator;
use crate::property::tolerance::{Judgement, Scales};

/// How the entries of two stiffness matrices compare.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// The label of the operator compared with.
    pub against: String,
    /// Places where either matrix has a non-zero entry.
    pub entries: usize,
    /// Places with equal bits.
    pub identical: usize,
    /// Places whose difference the rounding of two good implementations explains.
    pub explained: usize,
    /// Places whose difference only a poor but correct implementation explains.
    pub open: usize,
    /// Places whose difference no correct implementation explains.
    pub beyond: usize,
    /// The place that differs by most multiples of the bound.
    pub worst: Option<Difference>,
}

/// A place where two matrices differ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// Row.
    pub i: usize,
    /// Column.
    pub j: usize,
    /// The entry of the operator on trial.
    pub theirs: f64,
    /// The entry of the operator compared with.
    pub ours: f64,
    /// The difference over what the rounding of two good implementations explains.
    pub multiples: f64,
}

/// Compares the stiffness matrices of two operators on a domain. The bound at a place is the sum of both matrices' own
/// (see [`tolerance`](crate::property::tolerance)). Cost: O(nnz log).
pub fn compare(domain: &Domain, theirs: &Operator, ours: &Operator, against: &str) -> Comparison {
    let (a, b) = (theirs.stiffness(), ours.stiffness());
    let (of_a, of_b) = (Scales::of(domain, a), Scales::of(domain, b));
    let mut comparison = Comparison {
        against: against.to_string(),
        entries: 0,
        identical: 0,
        explained: 0,
        open: 0,
        beyond: 0,
        worst: None,
    };
    for i in 0..a.rows().min(b.rows()) {
        let mut columns: Vec<usize> = a.row(i).chain(b.row(i)).filter(|(_, v)| **v != 0.0).map(|(j, _)| j).collect();
        columns.sort_unstable();
        columns.dedup();
        for j in columns {
            let (x, y) = (a.at(i, j), b.at(i, j));
            let edge = domain.edges().binary_search(&[i.min(j), i.max(j)]).ok();
            let threshold = of_a.entry(i, x, edge).plus(of_b.entry(i, y, edge));
            let residual = (x - y).abs();
            comparison.entries += 1;
            match threshold.judge(residual) {
                _ if x == y => comparison.identical += 1,
                Judgement::Explained => comparison.explained += 1,
                Judgement::Open => comparison.open += 1,
                Judgement::Defect => comparison.beyond += 1,
            }
            let multiples = threshold.margin(residual);
            if multiples > comparison.worst.as_ref().map_or(0.0, |w| w.multiples) {
                comparison.worst = Some(Difference { i, j, theirs: x, ours: y, multiples });
            }
        }
    }
    comparison
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "against {}: {} entries, {} identical, {} within the bound of the mesh, {} that only a poor algorithm \
             explains, {} beyond",
            self.against, self.entries, self.identical, self.explained, self.open, self.beyond
        )?;
        match &self.worst {
            None => Ok(()),
            Some(w) => write!(
                f,
                "\n  worst at ({}, {}): {} against {}, {:.3} times the bound",
                w.i, w.j, w.theirs, w.ours, w.multiples
            ),
        }
    }
}
