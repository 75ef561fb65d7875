//! Points of the unit circle with the same bits on every platform.
//!
//! The sine of the system's library may differ in its last bit from one platform to the next, and with it every digest of
//! a torus. Here only `+ − × / √` are used, which IEEE 754 rounds in one way, and the symmetries of the circle are exact:
//! `turn(1, 4)` is (0, 1), and the points of a regular polygon mirror each other bit for bit.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

/// `(cos, sin)` of the angle `2πk/n`; n > 0. Error below 4u, u = 2⁻⁵³: an angle of at most π/4 and one power series.
pub fn turn(k: usize, n: usize) -> [f64; 2] {
    let four = 4 * (k % n);
    let (quarter, rest) = (four / n, four % n);
    let [x, y] = match (2 * rest).cmp(&n) {
        std::cmp::Ordering::Less => series(FRAC_PI_2 * rest as f64 / n as f64),
        std::cmp::Ordering::Equal => [FRAC_1_SQRT_2; 2],
        std::cmp::Ordering::Greater => {
            let [y, x] = series(FRAC_PI_2 * (n - rest) as f64 / n as f64);
            [x, y]
        }
    };
    rotate([x, y], quarter)
}

/// `(cos, sin)` of an angle in radians. Error below `(4 + |angle|) u` for angles of a few turns.
pub fn direction(angle: f64) -> [f64; 2] {
    let quarters = (angle / FRAC_PI_2).round();
    rotate(series(angle - quarters * FRAC_PI_2), quarters.rem_euclid(4.0) as usize)
}

/// The circular arc between two unit vectors less than half a turn apart, cut in half `doublings` times: `2^doublings + 1`
/// points, both ends included.
pub fn arc(from: [f64; 2], to: [f64; 2], doublings: usize) -> Vec<[f64; 2]> {
    let mut points = vec![from, to];
    for _ in 0..doublings {
        let mut finer = vec![points[0]];
        for w in points.windows(2) {
            let (x, y) = (w[0][0] + w[1][0], w[0][1] + w[1][1]);
            let length = (x * x + y * y).sqrt();
            finer.extend([[x / length, y / length], w[1]]);
        }
        points = finer;
    }
    points
}

/// A quarter turn, `quarters` times. Adding 0 turns a negative zero into zero.
fn rotate([x, y]: [f64; 2], quarters: usize) -> [f64; 2] {
    match quarters % 4 {
        0 => [x, y],
        1 => [0.0 - y, x],
        2 => [0.0 - x, 0.0 - y],
        _ => [y, 0.0 - x],
    }
}

/// The power series of cosine and sine for |x| ≤ π/4, from the smallest term up; the first term left out is below 2⁻⁶⁰.
fn series(x: f64) -> [f64; 2] {
    let square = x * x;
    let horner = |first: u32| {
        // 1 − x²/((f+1)(f+2)) (1 − x²/((f+3)(f+4)) (1 − …)) for f = `first`.
        (0..9).rev().fold(1.0, |tail, k| {
            let f = f64::from(first + 2 * k);
            1.0 - square / ((f + 1.0) * (f + 2.0)) * tail
        })
    };
    [horner(0), x * horner(1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    const U: f64 = f64::EPSILON / 2.0;

    #[test]
    fn turns_agree_with_the_library_and_are_exactly_symmetric() {
        for n in 1..60 {
            for k in 0..2 * n {
                let [x, y] = turn(k, n);
                let angle = std::f64::consts::TAU * k as f64 / n as f64;
                // The library's argument carries two roundings of an angle of at most 4π.
                assert!((x - angle.cos()).abs() < 30.0 * U && (y - angle.sin()).abs() < 30.0 * U, "{k}/{n}");
                let [mirrored_x, mirrored_y] = turn((2 * n - k) % n, n);
                assert!(mirrored_x == x && mirrored_y == -y, "{k}/{n}");
            }
        }
        assert_eq!((turn(1, 4), turn(2, 4), turn(0, 7)), ([0.0, 1.0], [-1.0, 0.0], [1.0, 0.0]));
        assert_eq!(turn(1, 6)[0], turn(5, 6)[0]);
    }

    #[test]
    fn directions_agree_with_the_library() {
        for k in -700..700 {
            let angle = f64::from(k) * 0.01;
            let [x, y] = direction(angle);
            let bound = (6.0 + angle.abs()) * U;
            assert!((x - angle.cos()).abs() < bound && (y - angle.sin()).abs() < bound, "{angle}");
        }
    }

    #[test]
    fn an_arc_cut_in_half_has_equal_chords() {
        let points = arc([1.0, 0.0], [0.0, 1.0], 3);
        assert_eq!(points.len(), 9);
        for (k, p) in points.iter().enumerate() {
            let [x, y] = turn(k, 32);
            assert!((p[0] - x).abs() < 20.0 * U && (p[1] - y).abs() < 20.0 * U);
        }
    }
}
