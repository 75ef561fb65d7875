//! Bessel functions of the first kind and their zeros, for the spectrum of the disc.
//!
//! # Definition
//! `J_m(x) = Σ_k (−1)ᵏ (x/2)^(2k+m) / (k! (k+m)!)`, and `J_m' = ½ (J_{m−1} − J_{m+1})`, `J_0' = −J_1`.
//!
//! # Accuracy
//! The terms of the series grow to at most `I_m(x) ≤ eˣ` before they cancel, so that the absolute error is below `n u eˣ` with n the
//! number of terms: 1e-11 at x = 10, which is as far as it is used here.

/// Where the series is still good for ten digits.
const FAR: f64 = 10.0;

/// `J_m(x)` for `0 ≤ x ≤ 10`.
pub fn j(m: u32, x: f64) -> f64 {
    let half = 0.5 * x;
    let first = (1..=m).fold(1.0, |term, k| term * half / f64::from(k));
    let (mut term, mut sum) = (first, first);
    for k in 1..200 {
        term *= -half * half / (f64::from(k) * f64::from(k + m));
        let next = sum + term;
        // Past their largest the terms fall, and one that changes nothing is followed by none that does.
        if next == sum && f64::from(k) > half {
            break;
        }
        sum = next;
    }
    sum
}

/// `J_m'(x)`.
pub fn derivative(m: u32, x: f64) -> f64 {
    if m == 0 { -j(1, x) } else { 0.5 * (j(m - 1, x) - j(m + 1, x)) }
}

/// The first positive zeros of `f` up to 10, by bracketing and bisection down to neighbouring numbers.
///
/// Consecutive zeros of J_m and of J_m' lie further apart than 1 (Sturm comparison with `u″ + u = 0`), and the first ones of those with
/// m > 0 beyond m: a step of 0.1 meets each by itself.
pub fn zeros(f: impl Fn(f64) -> f64) -> Vec<f64> {
    let steps = (10.0 * FAR) as u32;
    let at = |k: u32| f64::from(k) / 10.0 + 0.05;
    let brackets = (0..steps - 1).map(|k| [at(k), at(k + 1)]).filter(|[a, b]| (f(*a) < 0.0) != (f(*b) < 0.0));
    brackets.map(|bracket| bisect(&f, bracket)).collect()
}

/// Halves a bracket until no number lies between its ends.
pub fn bisect(f: impl Fn(f64) -> f64, [mut a, mut b]: [f64; 2]) -> f64 {
    let negative = f(a) < 0.0;
    loop {
        let middle = 0.5 * (a + b);
        if middle <= a || middle >= b {
            return middle;
        }
        if (f(middle) < 0.0) == negative { a = middle } else { b = middle }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz and Stegun, tables 9.5 (zeros of J_m and J_m').
    #[test]
    fn the_zeros_are_those_of_the_handbook() {
        let tables: [(u32, &[f64]); 4] = [
            (0, &[2.404_825_557_7, 5.520_078_110_3, 8.653_727_912_9]),
            (1, &[3.831_705_97, 7.015_586_67]),
            (2, &[5.135_622_30, 8.417_244_14]),
            (3, &[6.380_161_90, 9.761_023_13]),
        ];
        for (m, table) in tables {
            let found = zeros(|x| j(m, x));
            assert_eq!(found.len(), table.len(), "{m}: {found:?}");
            assert!(found.iter().zip(table).all(|(a, b)| (a - b).abs() < 6e-9), "{m}: {found:?}");
        }
        let tables: [(u32, &[f64]); 4] = [
            (0, &[3.831_705_97, 7.015_586_67]),
            (1, &[1.841_18, 5.331_44, 8.536_32]),
            (2, &[3.054_24, 6.706_13, 9.969_47]),
            (3, &[4.201_19, 8.015_24]),
        ];
        for (m, table) in tables {
            let found = zeros(|x| derivative(m, x));
            // The last zero of J_2' lies beyond the last bracket.
            let table = &table[..if m == 2 { 2 } else { table.len() }];
            assert_eq!(found.len(), table.len(), "{m}: {found:?}");
            assert!(found.iter().zip(table).all(|(a, b)| (a - b).abs() < 6e-6), "{m}: {found:?}");
        }
    }

    #[test]
    fn the_functions_satisfy_the_equation_and_the_recurrence() {
        for m in 1..5 {
            for k in 1..20 {
                let x = f64::from(k) * 0.5;
                let recurrence = j(m - 1, x) + j(m + 1, x) - 2.0 * f64::from(m) / x * j(m, x);
                assert!(recurrence.abs() < 1e-11 * f64::from(m), "{m} {x}: {recurrence:e}");
                let eps = 1e-5;
                let difference = (j(m, x + eps) - j(m, x - eps)) / (2.0 * eps);
                assert!((difference - derivative(m, x)).abs() < 1e-6);
            }
        }
        // Σ over all orders: J_0 + 2 Σ J_2k = 1.
        for x in [0.5, 3.0, 8.0] {
            let sum = j(0, x) + 2.0 * (1..20).map(|k| j(2 * k, x)).sum::<f64>();
            assert!((sum - 1.0).abs() < 1e-12, "{x}: {sum}");
        }
    }
}
