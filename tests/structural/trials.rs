//! Bringing matrices to trial, and checking each witness again in rational arithmetic.

use std::cmp::Ordering;

use lapjury::domain::Domain;
use lapjury::linalg::Csr;
use lapjury::operator::{Mass, MassKind, Operator, Provenance};
use lapjury::property::{self, Outcome, Statement, Status, Trial, Verdict};
use lapjury::scalar::{Rational, Scalar, sum};

/// The properties decided here.
pub const ALL: [&str; 12] =
    ["FIN", "LOC", "SYM", "NULL", "POS", "POS0", "POS-boundary", "LIN", "ENERGY", "FLUX", "MVP", "MASS"];

pub fn operator(l: &Csr) -> Operator {
    Operator::new(l.clone(), Provenance::default()).unwrap()
}

pub fn with_mass(l: &Csr, kind: MassKind, matrix: &Csr) -> Operator {
    operator(l).with_mass(Mass::full(kind, matrix.clone())).unwrap()
}

/// The verdict on an operator; a witness must be true in rational arithmetic and survive JSON.
pub fn judge(id: &str, domain: &Domain, operator: &Operator) -> Verdict {
    let trial = Trial::new(domain, operator, 1).unwrap();
    let verdict = property::find(id).unwrap().decide(&trial, None);
    if let Outcome::Fails(evidence) = &verdict.outcome {
        assert!(is_true(&evidence.statement, domain, operator), "{id}: {:?}", evidence.statement);
        for row in &evidence.excerpt.rows {
            let expected: Vec<_> = operator.stiffness().row(row.row).map(|(j, v)| (j, *v)).collect();
            assert_eq!(row.entries, expected);
        }
    }
    let text = serde_json::to_string(&verdict).unwrap();
    assert_eq!(serde_json::from_str::<Verdict>(&text).unwrap(), verdict, "{text}");
    verdict
}

/// The verdict on a matrix.
pub fn verdict(id: &str, domain: impl Into<Domain>, l: &Csr) -> Verdict {
    judge(id, &domain.into(), &operator(l))
}

/// The status of a matrix.
pub fn status(id: &str, domain: impl Into<Domain>, l: &Csr) -> Status {
    verdict(id, domain, l).status()
}

/// `(violations, zeros, undecided, total)`.
pub fn counts(verdict: &Verdict) -> (usize, usize, usize, usize) {
    let t = verdict.tally.unwrap();
    (t.violations, t.zeros, t.undecided, t.total)
}

/// The witness of a failing verdict.
pub fn statement(verdict: &Verdict) -> &Statement {
    assert_eq!(verdict.status(), Status::Fails, "{verdict:?}");
    &verdict.evidence().unwrap().statement
}

pub fn rational(x: f64) -> Rational {
    Rational::exactly(x).unwrap()
}

fn exceeds(residual: &Rational, threshold: f64) -> bool {
    if !threshold.is_finite() {
        return false;
    }
    (residual.magnitude() - rational(threshold)).cmp_zero() == Ordering::Greater
}

/// Whether a witness is true, decided from whole matrix and mesh in rational arithmetic, by its definition alone.
fn is_true(statement: &Statement, domain: &Domain, operator: &Operator) -> bool {
    let l = operator.stiffness();
    let entry = |i: usize, j: usize| rational(l.at(i, j));
    let x = |v: usize, axis: usize| rational(domain.positions().unwrap()[v][axis]);
    let row_sum = |m: &Csr, i: usize| sum(m.row(i).map(|(_, v)| rational(*v)));
    let mass = |i: usize, j: usize| rational(operator.mass().unwrap().matrix().at(i, j));
    match statement {
        Statement::NotFinite { i, j, .. } => {
            !l.at(*i, *j).is_finite() || !operator.mass().unwrap().matrix().at(*i, *j).is_finite()
        }
        Statement::FarEntry { i, j, .. } => l.at(*i, *j) != 0.0 && !share_a_face(domain, *i, *j),
        Statement::Asymmetry { i, j, threshold } => exceeds(&(entry(*i, *j) - entry(*j, *i)), *threshold),
        Statement::RowSum { i, threshold } => exceeds(&row_sum(l, *i), *threshold),
        Statement::Weight { i, j, zero, .. } => {
            entry(*i, *j).cmp_zero() == if *zero { Ordering::Equal } else { Ordering::Greater }
        }
        Statement::NotConvex { i, j } if i == j => l.at(*i, *i) <= 0.0,
        Statement::NotConvex { i, j } => l.at(*i, *j) > 0.0,
        Statement::Moment { i, axis, axes, boundary, threshold } => {
            let terms = l.row(*i).map(|(j, v)| rational(*v) * (x(j, *axis) - x(*i, *axis)));
            let expected = boundary.map_or(Rational::ZERO, |[p, q]| {
                let along = |a: usize| (x(q, a) - x(p, a)) * rational(0.5);
                if *axis == axes[0] { along(axes[1]) } else { -along(axes[0]) }
            });
            exceeds(&(sum(terms) - expected), *threshold)
        }
        Statement::Energy { axis, other, trace, expected, threshold, .. } => {
            let axes = if *trace { vec![(0, 0), (1, 1), (2, 2)] } else { vec![(*axis, *other)] };
            let term =
                |(i, j, v): (usize, usize, &f64)| sum(axes.iter().map(|&(a, b)| x(i, a) * rational(*v) * x(j, b)));
            exceeds(&(sum(l.entries().map(term)) - rational(*expected)), *threshold)
        }
        Statement::MassTotal { expected, threshold, .. } => {
            let m = operator.mass().unwrap().matrix();
            exceeds(&(sum((0..m.rows()).map(|i| row_sum(m, i))) - rational(*expected)), *threshold)
        }
        Statement::MassAsymmetry { i, j, threshold } => exceeds(&(mass(*i, *j) - mass(*j, *i)), *threshold),
        Statement::MassNotPositive { x } => {
            let pairs = x.iter().flat_map(|a| x.iter().map(move |b| (a, b)));
            let energy = sum(pairs.map(|(a, b)| rational(a.1) * mass(a.0, b.0) * rational(b.1)));
            energy.cmp_zero() != Ordering::Greater
        }
        Statement::MassShare { i, lower, upper } => {
            let share = row_sum(operator.mass().unwrap().matrix(), *i);
            (share.clone() - rational(*lower)).cmp_zero() == Ordering::Less
                || (share - rational(*upper)).cmp_zero() == Ordering::Greater
        }
        other => panic!("not a witness of these properties: {other:?}"),
    }
}

/// Brute force over all faces, or all edges where there are none.
pub fn share_a_face(domain: &Domain, i: usize, j: usize) -> bool {
    match domain.as_surface() {
        Some(s) => s.faces().iter().any(|f| f.contains(&i) && f.contains(&j)),
        None => domain.edges().iter().any(|e| e.contains(&i) && e.contains(&j)),
    }
}
