//! Cotangents of random bad triangles against a formula of its own in integers, family by family.
//!
//! ```text
//! cargo run --release --example cotangents_under_trial -- [count] [seed]
//! ```
//! prints, for each family of triangles, the largest error in units in the last place, the angles that took the careful and the
//! exact way, and the cost of a triangle in the quickest batch. Exits with 1 if an error exceeds four units.

#[path = "../tests/oracle/mod.rs"]
#[allow(dead_code, reason = "the tests use more of it")]
mod oracle;

use std::hint::black_box;
use std::process::ExitCode;
use std::time::Instant;

use lapjury::domain::cotangent::{self, Way};
use lapjury::domain::geometry::Vec3;
use lapjury::stream::Stream;
use oracle::{FAMILIES, Point, triangle, ulps_of_cotangent};
use rayon::prelude::*;

const BATCH: u64 = 1000;
const ALLOWED: f64 = 4.0;

#[derive(Clone, Copy, Default)]
struct Account {
    angles: u64,
    degenerate: u64,
    distilled: u64,
    rational: u64,
    worst: f64,
    triangles: u64,
    /// Of the quickest batch: the machine may be busy with other things.
    nanoseconds_each: Option<f64>,
}

impl Account {
    fn plus(self, other: Self) -> Self {
        Account {
            angles: self.angles + other.angles,
            degenerate: self.degenerate + other.degenerate,
            distilled: self.distilled + other.distilled,
            rational: self.rational + other.rational,
            worst: self.worst.max(other.worst),
            triangles: self.triangles + other.triangles,
            nanoseconds_each: self.nanoseconds_each.into_iter().chain(other.nanoseconds_each).reduce(f64::min),
        }
    }

    fn of(family: usize, seed: u64, batch: u64, size: u64) -> Self {
        let mut r = Stream::new(seed, &format!("{}, batch {batch}", FAMILIES[family]));
        let triangles: Vec<[Point; 3]> = (0..size).map(|_| triangle(family, &mut r)).collect();
        let start = Instant::now();
        let found: Vec<_> = triangles.iter().map(|t| cotangent::of_triangle(black_box(*t).map(Vec3::from))).collect();
        let each = start.elapsed().as_secs_f64() * 1e9 / size as f64;
        let mut account = Account { nanoseconds_each: Some(each), triangles: size, ..Account::default() };
        for (t, found) in triangles.iter().zip(&found) {
            for k in 0..3 {
                match ulps_of_cotangent([t[k], t[(k + 1) % 3], t[(k + 2) % 3]], found.values[k]) {
                    Some(ulps) => {
                        account.angles += 1;
                        account.worst = account.worst.max(ulps);
                        account.distilled += u64::from(found.ways[k] == Way::Distilled);
                        account.rational += u64::from(found.ways[k] == Way::Rational);
                    }
                    None => account.degenerate += 1,
                }
            }
        }
        account
    }
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1).map(|a| a.parse::<u64>().unwrap_or_else(|_| panic!("{a}: a number")));
    let (count, seed) = (arguments.next().unwrap_or(100_000), arguments.next().unwrap_or(1));
    let each = count.div_ceil(FAMILIES.len() as u64);
    println!("{:<30} {:>9} {:>9} {:>9} {:>9} {:>9}", "family", "angles", "max ulp", "careful", "exact", "ns each");
    let mut total = Account::default();
    for (family, name) in FAMILIES.iter().enumerate() {
        let batches = (0..each.div_ceil(BATCH)).into_par_iter();
        let sum = batches
            .map(|b| Account::of(family, seed, b, BATCH.min(each - b * BATCH)))
            .reduce(Account::default, Account::plus);
        print(name, &sum);
        total = total.plus(sum);
    }
    print("all", &Account { nanoseconds_each: None, ..total });
    println!("{} triangles, {} angles of degenerate ones left out", total.triangles, total.degenerate);
    if total.worst <= ALLOWED { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn print(name: &str, a: &Account) {
    let share = |n: u64| format!("{:.3} %", 100.0 * n as f64 / a.angles.max(1) as f64);
    let each = a.nanoseconds_each.map_or_else(String::new, |each| format!("{each:.0}"));
    println!(
        "{name:<30} {:>9} {:>9.3} {:>9} {:>9} {each:>9}",
        a.angles,
        a.worst,
        share(a.distilled),
        share(a.rational)
    );
}
