//! Cotangents and their half-sums by another formula: the law of cosines, in integers, with integer roots of 200 bits.
//!
//! ```text
//! cot θ = D / √(4BC − D²),  D = B + C − A,   A, B, C squared lengths: opposite the angle and of its two sides
//! ```

use dashu_base::{BitTest, SquareRoot};
use dashu_int::{IBig, UBig};
use lapjury::stream::Stream;

pub type Point = [f64; 3];

/// `(m, e)` with `x = m 2^e`.
fn parts(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i32, (bits & ((1 << 52) - 1)) as i64);
    let (mantissa, exponent) = if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) };
    if mantissa == 0 {
        return (0, 0);
    }
    let shift = mantissa.trailing_zeros();
    ((mantissa >> shift) * if x < 0.0 { -1 } else { 1 }, exponent + shift as i32)
}

/// Points as integers, up to one power of two common to all.
fn integers<const N: usize>(points: [Point; N]) -> [[IBig; 3]; N] {
    let all = points.iter().flatten().map(|&x| parts(x)).filter(|p| p.0 != 0).map(|p| p.1);
    let lowest = all.min().unwrap_or(0);
    points.map(|p| {
        p.map(|x| match parts(x) {
            (0, _) => IBig::ZERO,
            (m, e) => IBig::from(m) << (e - lowest) as usize,
        })
    })
}

fn squared(p: &[IBig; 3], q: &[IBig; 3]) -> IBig {
    (0..3).fold(IBig::ZERO, |sum, k| {
        let d = &p[k] - &q[k];
        sum + &d * &d
    })
}

/// A cotangent as `D/√S` with integers D and S.
pub struct Quotient {
    numerator: IBig,
    square: UBig,
}

/// A number `m 2^e`, m of 190 bits or more and off by at most one; or zero exactly.
pub struct Number {
    mantissa: IBig,
    exponent: isize,
}

fn shifted(n: UBig, by: isize) -> UBig {
    if by > 0 { n << by as usize } else { n }
}

impl Quotient {
    /// At the first of three points; `None` if they lie on a line.
    pub fn at([apex, p, q]: [Point; 3]) -> Option<Self> {
        let [k, p, q] = integers([apex, p, q]);
        let (a, b, c) = (squared(&p, &q), squared(&k, &p), squared(&k, &q));
        let numerator = &b + &c - a;
        let square = UBig::try_from(IBig::from(4) * b * c - &numerator * &numerator).unwrap();
        (!square.is_zero()).then_some(Quotient { numerator, square })
    }

    /// To a number of bits.
    fn number(&self, bits: isize) -> Number {
        let magnitude = UBig::try_from(self.numerator.clone().max(-self.numerator.clone())).unwrap();
        let length = |n: &UBig| n.bit_len() as isize;
        // |D|/√S = √(2^{2k} D²/S) / 2^k.
        let k = bits - length(&magnitude) + length(&self.square) / 2;
        let square = &magnitude * &magnitude;
        let root = (shifted(square, 2 * k) / shifted(self.square.clone(), -2 * k)).sqrt();
        let root = IBig::from(root);
        Number { mantissa: if self.numerator < IBig::ZERO { -root } else { root }, exponent: -k }
    }

    fn is_zero(&self) -> bool {
        self.numerator.is_zero()
    }
}

impl Number {
    /// The error of an `f64` in units in the last place of this number; 0 or infinite where this is zero.
    pub fn ulps(&self, found: f64) -> f64 {
        if self.mantissa.is_zero() {
            return if found == 0.0 { 0.0 } else { f64::INFINITY };
        }
        if !found.is_finite() {
            return f64::INFINITY;
        }
        let size = UBig::try_from(self.mantissa.clone().max(-self.mantissa.clone())).unwrap();
        // 2^(leading − 1) ≤ |m| < 2^leading.
        let leading = size.bit_len() as isize;
        let last = (leading + self.exponent - 53).max(-1074);
        let (m, e) = parts(found);
        let (mut given, mut own) = (IBig::from(m), self.mantissa.clone());
        let lift = e as isize - self.exponent;
        if lift >= 0 {
            given <<= lift as usize
        } else {
            own <<= (-lift) as usize
        }
        let exponent = self.exponent.min(e as isize);
        let difference = (given - own).to_f64().value().abs();
        difference * 2f64.powi((exponent - last) as i32)
    }
}

/// The error of a cotangent in units in the last place; `None` for a degenerate triangle.
pub fn ulps_of_cotangent(corner: [Point; 3], found: f64) -> Option<f64> {
    let quotient = Quotient::at(corner)?;
    Some(
        if quotient.is_zero() { Number { mantissa: IBig::ZERO, exponent: 0 } } else { quotient.number(200) }
            .ulps(found),
    )
}

/// The error of a half-sum of two cotangents in units in the last place; `None` if one triangle is degenerate.
pub fn ulps_of_half_sum(corners: [[Point; 3]; 2], found: f64) -> Option<f64> {
    let [a, b] = corners.map(Quotient::at);
    let (a, b) = (a?, b?);
    let squares = &a.numerator * &a.numerator * IBig::from(b.square.clone())
        - &b.numerator * &b.numerator * IBig::from(a.square.clone());
    let opposite = (a.numerator < IBig::ZERO) != (b.numerator < IBig::ZERO);
    let zero = Number { mantissa: IBig::ZERO, exponent: 0 };
    if squares.is_zero() && (opposite || a.is_zero()) {
        return Some(zero.ulps(found));
    }
    let mut bits = 300;
    loop {
        let numbers: Vec<Number> = [&a, &b].into_iter().filter(|q| !q.is_zero()).map(|q| q.number(bits)).collect();
        let lowest = numbers.iter().map(|n| n.exponent).min().unwrap();
        let highest = numbers.iter().map(|n| n.exponent).max().unwrap();
        let sum =
            numbers.iter().fold(IBig::ZERO, |sum, n| sum + (n.mantissa.clone() << (n.exponent - lowest) as usize));
        // Each root is off by one of its last bits.
        let size = UBig::try_from(sum.clone().max(-sum.clone())).unwrap();
        if size.bit_len() > (highest - lowest) as usize + 150 {
            return Some(Number { mantissa: sum, exponent: lowest - 1 }.ulps(found));
        }
        bits *= 2;
    }
}

/// A family of bad triangles.
pub const FAMILIES: [&str; 10] = [
    "healthy",
    "needles",
    "caps",
    "near-right angles",
    "needles at scales 1e±100",
    "caps at scales 1e±100",
    "healthy, 1e8 diameters away",
    "needles, 1e8 diameters away",
    "a few last bits from a line",
    "exactly right angles and few bits",
];

/// A random triangle of a family.
pub fn triangle(family: usize, r: &mut Stream) -> [Point; 3] {
    let power = |r: &mut Stream, low: f64, high: f64| 10f64.powf(r.between(low, high));
    let signed = |r: &mut Stream| if r.bits() & 1 == 0 { 1.0 } else { -1.0 };
    match family {
        0 => std::array::from_fn(|_| point(r)),
        1 => turned(needle(power(r, -12.0, -1.0), r), 1.0, r),
        2 => turned(cap(power(r, -12.0, -1.0), r), 1.0, r),
        3 => {
            let off = signed(r) * power(r, -17.0, -2.0);
            let long = power(r, -2.0, 2.0);
            turned([[0.0, 0.0], [1.0, 0.0], [off * long, long]], 1.0, r)
        }
        4 => {
            let scale = 10f64.powf(100.0 * signed(r) + r.between(-5.0, 5.0));
            turned(needle(power(r, -12.0, -1.0), r), scale, r)
        }
        5 => {
            let scale = 10f64.powf(100.0 * signed(r) + r.between(-5.0, 5.0));
            turned(cap(power(r, -12.0, -1.0), r), scale, r)
        }
        6 | 7 => {
            let flat = if family == 6 { needle(r.between(0.2, 1.5), r) } else { needle(power(r, -12.0, -1.0), r) };
            let away = point(r).map(|x| x * power(r, 0.0, 8.0));
            let near = turned(flat, 1.0, r);
            near.map(|p| std::array::from_fn(|k| p[k] + away[k]))
        }
        8 => {
            let (a, b, t) = (point(r), point(r), r.between(-1.0, 2.0));
            let on_line: Point = std::array::from_fn(|k| a[k] + t * (b[k] - a[k]));
            let off = on_line.map(|x| x + (r.below(5) as f64 - 2.0) * f64::EPSILON * x);
            let all = [a, b, off];
            let start = r.below(3);
            std::array::from_fn(|k| all[(start + k) % 3])
        }
        _ => {
            let bits = 2f64.powi(1 + r.below(26) as i32);
            let planar = r.bits() & 1 == 0;
            let one = |r: &mut Stream| (r.between(-1.0, 1.0) * bits).round();
            let (u, at) = ([one(r), one(r)], [one(r), one(r)]);
            let by = (r.between(-1.0, 1.0) * 8.0).round();
            let z = if planar { 0.0 } else { 3.0 };
            [[at[0], at[1], z], [at[0] + u[0], at[1] + u[1], z], [at[0] - by * u[1], at[1] + by * u[0], z]]
        }
    }
}

fn point(r: &mut Stream) -> Point {
    std::array::from_fn(|_| r.between(-1.0, 1.0))
}

/// An angle at one corner, which one is random, between sides whose lengths are within a factor of a hundred, or nearly equal.
fn needle(angle: f64, r: &mut Stream) -> [[f64; 2]; 3] {
    let ratio = if r.bits() & 1 == 0 { 1.0 + angle * r.between(-2.0, 2.0) } else { 10f64.powf(r.between(-2.0, 2.0)) };
    let all = [[0.0, 0.0], [1.0, 0.0], [ratio * angle.cos(), ratio * angle.sin()]];
    let start = r.below(3);
    std::array::from_fn(|k| all[(start + k) % 3])
}

/// Two angles of a size and a third near 180°.
fn cap(height: f64, r: &mut Stream) -> [[f64; 2]; 3] {
    let all = [[r.between(0.05, 0.95), height], [0.0, 0.0], [1.0, 0.0]];
    let start = r.below(3);
    std::array::from_fn(|k| all[(start + k) % 3])
}

/// A plane triangle, scaled, turned into space by random orthogonal vectors (half of them stay in the plane z = 0).
fn turned(flat: [[f64; 2]; 3], scale: f64, r: &mut Stream) -> [Point; 3] {
    let dot = |a: Point, b: Point| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let unit = |a: Point| a.map(|x| x / dot(a, a).sqrt());
    let mut x = point(r);
    let mut y = point(r);
    if r.bits() & 1 == 0 {
        (x[2], y[2]) = (0.0, 0.0);
    }
    let x = unit(x);
    let along = dot(x, y);
    let y = unit(std::array::from_fn(|k| y[k] - along * x[k]));
    flat.map(|p| std::array::from_fn(|k| (p[0] * x[k] + p[1] * y[k]) * scale))
}
