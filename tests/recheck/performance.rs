//! What a recheck costs.

use std::time::Instant;

use lapjury::domain::{Domain, Surface};
use lapjury::operator::Operator;
use lapjury::property::recheck::against;
use lapjury::property::{Evidence, Statement};

use crate::operators::{lumped, operator};

/// A k × k grid of right triangles with its cotangent matrix: weights 1 inside, ½ on the boundary, 0 across.
pub fn grid(k: usize) -> (Domain, Operator) {
    let at = |x: usize, y: usize| y * k + x;
    let mut p = Vec::new();
    let (mut faces, mut entries) = (Vec::new(), Vec::new());
    let mut mass = vec![0.0; k * k];
    for y in 0..k {
        for x in 0..k {
            p.push([x as f64, y as f64]);
            for (next, rim) in [((x + 1, y), y == 0 || y + 1 == k), ((x, y + 1), x == 0 || x + 1 == k)] {
                if next.0 < k && next.1 < k {
                    let (i, j, w) = (at(x, y), at(next.0, next.1), if rim { 0.5 } else { 1.0 });
                    entries.extend([(i, j, -w), (j, i, -w), (i, i, w), (j, j, w)]);
                }
            }
            if x + 1 < k && y + 1 < k {
                for f in [[at(x, y), at(x + 1, y), at(x + 1, y + 1)], [at(x, y), at(x + 1, y + 1), at(x, y + 1)]] {
                    f.iter().for_each(|&v| mass[v] += 1.0 / 6.0);
                    faces.push(f);
                }
            }
        }
    }
    (Surface::planar(&p, &faces).unwrap().into(), lumped(operator(k * k, &entries), &mass))
}

const SCANS: [&str; 10] = ["FIN", "LOC", "SYM", "NULL", "POS0", "LIN", "FLUX", "ENERGY", "MVP", "MASS"];

fn certificates(n: usize, stored: usize, rim: usize) -> Vec<(&'static str, Statement)> {
    let scan = |property: &'static str| (property, Statement::Scan { checked: stored, worst: vec![0] });
    let mut all: Vec<_> = SCANS.into_iter().map(scan).collect();
    all[0].1 = Statement::Scan { checked: stored + n, worst: Vec::new() };
    all.push(("PSD", Statement::SumOfSquares));
    all.push(("PSD", Statement::ShiftedFactor { shift: 1e-11, smallest_pivot: 1e-11 }));
    all.push(("KER", Statement::ClosedClasses { kernel: 1 }));
    all.push(("KER", Statement::InertiaCount { shift: 1e-9, kernel: 1 }));
    all.push(("MAX-global", Statement::SignPattern { set: rim }));
    all
}

fn recheck_all(k: usize) -> f64 {
    let (domain, operator) = grid(k);
    let statements = certificates(k * k, operator.stiffness().stored(), 4 * (k - 1));
    let start = Instant::now();
    for (property, statement) in &statements {
        let answer = against(&Evidence::bare(statement.clone()), property, &domain, &operator);
        assert!(answer.is_ok(), "{property} {statement:?}: {answer:?}");
    }
    start.elapsed().as_secs_f64() / statements.len() as f64
}

#[test]
fn a_small_mesh_takes_less_than_a_millisecond_a_cell() {
    let best = (0..20).map(|_| recheck_all(7)).fold(f64::INFINITY, f64::min);
    println!("49 vertices: {:.1} µs a cell", 1e6 * best);
    assert!(best < 1e-3, "{best}");
}

#[test]
fn three_thousand_vertices_are_rechecked_in_full() {
    let seconds = recheck_all(55);
    println!("3025 vertices: {:.1} ms a cell", 1e3 * seconds);
    assert!(seconds < 2.0, "{seconds}");
}

#[test]
fn an_overshoot_on_a_large_mesh_is_verified_by_a_sparse_solve() {
    let k = 24;
    let (domain, good) = grid(k);
    // A weight turned negative near the boundary: its source now cools its neighbour, where nothing else warms it.
    let (i, b) = (k + 1, 1);
    let mut entries: Vec<_> = good.stiffness().entries().map(|(i, j, v)| (i, j, *v)).collect();
    entries.extend([(i, b, 1.5), (b, i, 1.5)]);
    let spoilt = operator(k * k, &entries);
    let set: Vec<usize> = (0..k * k).filter(|&v| domain.boundary()[v]).collect();
    let overshoot =
        |value: f64, low: bool| Evidence::bare(Statement::Overshoot { set: set.clone(), source: b, at: i, value, low });
    // u_i = −½ g with g the value that a unit inflow at i gives there: read it off the refusal of a wrong value.
    let refusal = against(&overshoot(-7.0, true), "MAX-global", &domain, &spoilt).unwrap_err().to_string();
    let value: f64 = refusal.rsplit(' ').next().unwrap().parse().unwrap();
    assert!(value < -0.1 && value > -0.25, "{refusal}");
    let answer = against(&overshoot(value, true), "MAX-global", &domain, &spoilt);
    assert_eq!(answer, Ok(lapjury::property::recheck::Rechecked::Bounded));
    assert!(against(&overshoot(value, false), "MAX-global", &domain, &spoilt).is_err());
}
