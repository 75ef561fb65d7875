//! The cheap way: edge vectors cut in two at a common bit, so that products of the upper parts add up without rounding.
//!
//! # Formula
//! An edge is a difference of two points, held exactly as a rounded difference and its error. With `2^e ≤ size < 2^(e+1)`, size
//! the largest of its three components, every component is `head + tail`: the head a multiple of `2^(e−24)`, so that it has 25
//! bits, the tail the rest, rounded once. Then
//! ```text
//! d = Σ H_k G_k  +  Σ (H_k Q_k + R_k G_k + R_k Q_k)          H, R of one edge, G, Q of the other
//! ```
//! and likewise each component of the cross product n. The first sum has terms of 50 bits on a common grid: it is formed without
//! any rounding. The second is 2⁻²⁵ of the first and may be rounded as it comes. `|n|²` is formed from n in the same way; the root and the quotient
//! are corrected by their residuals, which are formed likewise.
//!
//! # Error
//! With a and b the sizes of the two edges, `u = 2⁻⁵³`, up to factors `1 + 2⁻²⁰` for which the last step leaves room:
//! * A tail is at most `2⁻²⁵ a` and rounded by `2⁻⁷⁸ a`.
//! * d: three times two products of a head with a tail, each rounded five times at most (product, two sums, two sums):
//!   `5u · 6 · 2⁻²⁵ ab = 30 · 2⁻⁷⁸ ab`; the rounding of the tails gives `6 · 2⁻⁷⁸ ab`: `36 · 2⁻⁷⁸ ab < 2⁻⁷² ab`.
//! * n: per component `4u · 4 · 2⁻²⁵ ab + 4 · 2⁻⁷⁸ ab`, and at most `8 · 2⁻⁷⁸ ab` where the sum of upper and lower part is taken apart again
//!   though the lower one is larger: `28 · 2⁻⁷⁸ ab`, and √3 times that for the vector: `< 2⁻⁷² ab`.
//! * |n|², the root, the quotient with their residuals: each a few times `2⁻⁷⁸` relative, together below `2⁻⁷³`.
//! * Underflow adds 2⁻¹⁰⁷⁵ a product, which is nothing: sizes are kept within 2^±200.
//!
//! So, with A and B the sizes of the edges that n is formed from,
//! ```text
//! |error| ≤ 2⁻⁷² ab / |n|  +  |cot| (2⁻⁷² AB / |n| + 2⁻⁷³)
//! ```
//! before the one rounding to `f64`. Where `|n| ≥ 2⁻¹⁶ AB` and `|d| ≥ 2⁻¹⁶ ab` each of the two large terms is at most
//! `2⁻⁵⁶ |cot| = u/8`: the cotangent is off by half a unit in the last place and a quarter of u, and that is the test.
//! n is formed at the first corner, from edges that are as they come; where it is too small against AB, and only there, the triangle is
//! turned so that the longest edge is opposite the first corner: then n is largest against AB, and needles pass as well.
//!
//! # Cost
//! Some 310 additions and multiplications, four divisions, one root, and no branch: [`many`] triangles are computed side by side,
//! as many at a time as the machine's registers have room for.

use super::super::twofold::{Twofold, power_of_two, two_difference};

/// Edges of these sizes are taken as they are; others are brought to the size one first.
const USUAL: std::ops::Range<f64> = power_of_two(-200)..power_of_two(200);

/// The relative size of dot and cross product from which on their error is at most u/8: `2⁻¹⁶`.
const ENOUGH: f64 = power_of_two(-16);

/// The error of dot and cross product relative to the sizes of the edges: `2⁻⁷²`.
const ERROR: f64 = power_of_two(-72);

/// The exponent of a positive number, as a power of two. Zero for zero and below the normal numbers.
#[inline(always)]
fn binade(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & f64::INFINITY.to_bits())
}

#[inline(always)]
fn size(v: &[f64; 3]) -> f64 {
    larger(larger(v[0].abs(), v[1].abs()), v[2].abs())
}

/// The larger of two numbers, where neither is NaN: one instruction.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// A vector cut at a bit common to its components.
#[derive(Clone, Copy)]
struct Cut {
    head: [f64; 3],
    tail: [f64; 3],
}

/// Cuts a vector `high + low` whose `high` has the given size.
#[inline(always)]
fn cut(high: [f64; 3], low: [f64; 3], size: f64) -> Cut {
    // Added and taken away again, it leaves multiples of its last bit: of 2^(e−24).
    let anchor = binade(size) * (1.5 * power_of_two(28));
    let head = high.map(|x| (x + anchor) - anchor);
    Cut { head, tail: std::array::from_fn(|k| (high[k] - head[k]) + low[k]) }
}

/// The upper 26 bits of a number.
#[inline(always)]
fn upper(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & !((1 << 27) - 1))
}

#[inline(always)]
fn dot(e: &Cut, f: &Cut) -> Twofold {
    let heads = (e.head[0] * f.head[0] + e.head[1] * f.head[1]) + e.head[2] * f.head[2];
    let mixed = |k: usize| (e.head[k] * f.tail[k] + e.tail[k] * f.head[k]) + e.tail[k] * f.tail[k];
    apart(heads, (mixed(0) + mixed(1)) + mixed(2))
}

/// A component of the cross product.
#[inline(always)]
fn cross(e: &Cut, f: &Cut, a: usize, b: usize) -> Twofold {
    let heads = e.head[a] * f.head[b] - e.head[b] * f.head[a];
    let mixed = |a: usize, b: usize| (e.head[a] * f.tail[b] + e.tail[a] * f.head[b]) + e.tail[a] * f.tail[b];
    apart(heads, mixed(a, b) - mixed(b, a))
}

/// The sum of two numbers and what its rounding lost, if the first is the larger one.
#[inline(always)]
fn apart(large: f64, small: f64) -> Twofold {
    let high = large + small;
    Twofold { high, low: small - (high - large) }
}

/// What the cheap way makes of a triangle.
pub(super) struct Heads {
    /// The cotangents, unrounded.
    pub cotangents: [Twofold; 3],
    /// Twice the area.
    pub doubled_area: f64,
    /// By how much each cotangent may be off before it is rounded.
    dot_is_enough: [bool; 3],
    area_is_enough: bool,
    /// The product of the sizes of the two edges at each corner over the length of the cross product.
    thinness: [f64; 3],
    /// The same at the corner that the cross product is formed at.
    area_thinness: f64,
}

impl Heads {
    /// Of a triangle.
    #[inline]
    pub fn of(corners: &[[f64; 3]; 3]) -> Self {
        let heads = Self::as_it_comes(corners);
        if heads.area_is_enough { heads } else { Self::turned(corners) }
    }

    /// The same with the longest edge opposite the first corner on the way.
    #[cold]
    fn turned(corners: &[[f64; 3]; 3]) -> Self {
        let length =
            |k: usize| size(&std::array::from_fn(|axis| corners[(k + 2) % 3][axis] - corners[(k + 1) % 3][axis]));
        let longest = (1..3).fold(0, |best, k| if length(k) > length(best) { k } else { best });
        let mut heads = Self::as_it_comes(&[0, 1, 2].map(|k| corners[(longest + k) % 3]));
        heads.cotangents.rotate_right(longest);
        heads.dot_is_enough.rotate_right(longest);
        heads.thinness.rotate_right(longest);
        heads
    }

    fn as_it_comes(corners: &[[f64; 3]; 3]) -> Self {
        let (high, low) = edges(corners);
        let sizes = [size(&high[0]), size(&high[1]), size(&high[2])];
        if sizes.iter().all(|s| USUAL.contains(s)) {
            Self::with_exact_dots(&high, &low, &sizes)
        } else {
            Self::scaled(high, low)
        }
    }

    /// A dot product that is small is as good as any other if it was formed without rounding.
    #[inline]
    fn with_exact_dots(high: &[[f64; 3]; 3], low: &[[f64; 3]; 3], sizes: &[f64; 3]) -> Self {
        let (mut heads, e) = Self::of_edges(high, low, sizes);
        for k in 0..3 {
            heads.dot_is_enough[k] = heads.dot_is_enough[k] || is_exact(&e[(k + 1) % 3], &e[(k + 2) % 3]);
        }
        heads
    }

    /// The same where a size is unusual, if a power of two makes them all usual.
    #[cold]
    fn scaled(high: [[f64; 3]; 3], low: [[f64; 3]; 3]) -> Self {
        let largest = high.iter().map(size).fold(0.0, f64::max);
        // A subnormal number counts as the smallest normal one: then the sizes stay unusual, and nothing here is enough.
        let exponent = (largest.to_bits() >> 52) as i32 - 1023;
        let halves = [-exponent / 2, -exponent - -exponent / 2].map(power_of_two);
        let brought = |edges: [[f64; 3]; 3]| edges.map(|edge| edge.map(|x| x * halves[0] * halves[1]));
        let before = [high, low];
        let (high, low) = (brought(high), brought(low));
        // A component that vanishes on the way is no zero, and a dot product of such none either.
        let kept = |(x, y): (&f64, &f64)| *x == 0.0 || y.abs() >= f64::MIN_POSITIVE;
        let lossless = before.iter().flatten().flatten().zip([high, low].iter().flatten().flatten()).all(kept);
        let sizes = [size(&high[0]), size(&high[1]), size(&high[2])];
        let mut found = Self::with_exact_dots(&high, &low, &sizes);
        found.area_is_enough &= lossless && sizes.iter().all(|s| USUAL.contains(s));
        halves.iter().for_each(|half| found.doubled_area = found.doubled_area / half / half);
        found
    }

    /// Of the edges opposite the corners, going round, and these cut in two. No branch.
    #[inline(always)]
    fn of_edges(high: &[[f64; 3]; 3], low: &[[f64; 3]; 3], sizes: &[f64; 3]) -> (Self, [Cut; 3]) {
        let e = [cut(high[0], low[0], sizes[0]), cut(high[1], low[1], sizes[1]), cut(high[2], low[2], sizes[2])];
        let products = [sizes[1] * sizes[2], sizes[2] * sizes[0], sizes[0] * sizes[1]];
        let n = [cross(&e[1], &e[2], 1, 2), cross(&e[1], &e[2], 2, 0), cross(&e[1], &e[2], 0, 1)];
        let n_high = [n[0].high, n[1].high, n[2].high];
        let n_cut = cut(n_high, [n[0].low, n[1].low, n[2].low], size(&n_high));
        let heads = (n_cut.head[0] * n_cut.head[0] + n_cut.head[1] * n_cut.head[1]) + n_cut.head[2] * n_cut.head[2];
        let mixed = |k: usize| n_cut.tail[k] * (2.0 * n_cut.head[k] + n_cut.tail[k]);
        let square = apart(heads, (mixed(0) + mixed(1)) + mixed(2));

        let root = square.high.sqrt();
        let root_upper = upper(root);
        let root_lower = root - root_upper;
        let residual = ((square.high - root_upper * root_upper) - root_lower * (root + root_upper)) + square.low;
        // The true root is root · (1 + excess).
        let excess = 0.5 * residual / square.high;
        let inverse = 1.0 / root;

        // Edge k is opposite corner k, and the three go round: the dot product at corner k is −e_{k+1} · e_{k+2}.
        let dots = [dot(&e[1], &e[2]), dot(&e[2], &e[0]), dot(&e[0], &e[1])];
        let quotient = |k: usize| {
            let d = Twofold { high: 0.0 - dots[k].high, low: 0.0 - dots[k].low };
            let near = d.high / root;
            let near_upper = upper(near);
            let rest = (d.high - near_upper * root_upper) - (near_upper * root_lower + (near - near_upper) * root);
            apart(near, (rest + d.low) * inverse - near * excess)
        };
        let enough = |k: usize| dots[k].high.abs() >= ENOUGH * products[k];
        let heads = Heads {
            cotangents: [quotient(0), quotient(1), quotient(2)],
            doubled_area: root + root * excess,
            dot_is_enough: [enough(0), enough(1), enough(2)],
            area_is_enough: root >= ENOUGH * products[0],
            thinness: [products[0] * inverse, products[1] * inverse, products[2] * inverse],
            area_thinness: products[0] * inverse,
        };
        (heads, e)
    }

    /// Whether twice the area is off by little more than one rounding.
    #[inline]
    pub fn area_suffices(&self) -> bool {
        self.area_is_enough
    }

    /// Whether a cotangent is off by no more than half a unit in the last place and u/4.
    #[inline]
    pub fn suffices(&self, corner: usize) -> bool {
        self.area_is_enough && self.dot_is_enough[corner]
    }

    /// By how much a cotangent may be off before it is rounded, if the area suffices.
    pub fn error(&self, corner: usize) -> f64 {
        let relative = ERROR * self.area_thinness + 0.5 * ERROR;
        ERROR * self.thinness[corner] + self.cotangents[corner].high.abs() * relative
    }
}

/// Whether a dot product is a sum without any rounding: no tails, or no term at all.
fn is_exact(e: &Cut, f: &Cut) -> bool {
    let vanishes = |v: &Cut, k: usize| v.head[k] == 0.0 && v.tail[k] == 0.0;
    let no_tail = |v: &Cut| v.tail.iter().all(|t| *t == 0.0);
    (0..3).all(|k| vanishes(e, k) || vanishes(f, k)) || (no_tail(e) && no_tail(f))
}

/// The edges opposite the corners, going round: rounded, and what the rounding lost.
#[inline(always)]
fn edges(corners: &[[f64; 3]; 3]) -> ([[f64; 3]; 3], [[f64; 3]; 3]) {
    let edge = |p: &[f64; 3], q: &[f64; 3]| {
        let [x, y, z] = [two_difference(p[0], q[0]), two_difference(p[1], q[1]), two_difference(p[2], q[2])];
        ([x.0, y.0, z.0], [x.1, y.1, z.1])
    };
    let [a, b, c] = corners;
    let (e, f, g) = (edge(c, b), edge(a, c), edge(b, a));
    ([e.0, f.0, g.0], [e.1, f.1, g.1])
}

/// How many triangles are computed side by side: a multiple of what registers hold, few enough to stay in the nearest cache.
pub(super) const SIDE_BY_SIDE: usize = 32;

/// The cotangents and twice the area of many triangles, each given as its nine coordinates: bit for bit those of [`Heads::of`]
/// wherever it is said that they suffice. That is said by a one, where not by a zero.
pub(super) fn many(
    coordinates: &[[f64; 9]; SIDE_BY_SIDE],
    found: &mut [[f64; 4]; SIDE_BY_SIDE],
    suffices: &mut [f64; SIDE_BY_SIDE],
) {
    // A loop without a branch: the compiler takes several triangles at a time.
    for ((c, found), suffices) in coordinates.iter().zip(found).zip(suffices) {
        let (high, low) = edges(&[[c[0], c[1], c[2]], [c[3], c[4], c[5]], [c[6], c[7], c[8]]]);
        let sizes = [size(&high[0]), size(&high[1]), size(&high[2])];
        let (heads, _) = Heads::of_edges(&high, &low, &sizes);
        let [x, y, z] = &heads.cotangents;
        *found = [x.high, y.high, z.high, heads.doubled_area];
        let least = -larger(larger(-sizes[0], -sizes[1]), -sizes[2]);
        let usual = (least >= USUAL.start) & (size(&sizes) < USUAL.end);
        let dots = heads.dot_is_enough[0] & heads.dot_is_enough[1] & heads.dot_is_enough[2];
        *suffices = if usual & dots & heads.area_is_enough { 1.0 } else { 0.0 };
    }
}

#[cfg(test)]
mod tests {
    use super::super::rational;
    use super::*;
    use crate::stream::Stream;

    #[test]
    fn the_bound_covers_the_error_before_it_is_rounded_and_is_no_guess() {
        let mut stream = Stream::new(3, "heads");
        let (mut tried, mut worst) = (0, 0.0_f64);
        for k in 0..3000 {
            // From round triangles to needles of 2⁻³⁰.
            let flatness = power_of_two(-(k % 31));
            let mut point =
                |height: f64| [stream.between(-1.0, 1.0), height * stream.between(-1.0, 1.0), 0.3 * flatness];
            let corners = [point(flatness), point(flatness), point(flatness)];
            let heads = Heads::of(&corners);
            if !heads.area_suffices() {
                continue;
            }
            for corner in 0..3 {
                let Some(exact) = rational::cotangent(&[0, 1, 2].map(|i| corners[(corner + i) % 3])) else { continue };
                let found = &heads.cotangents[corner];
                let error = ((found.high - exact.high) + (found.low - exact.low)).abs();
                assert!(error <= heads.error(corner), "{corners:?} at {corner}: {error:e}, {:e}", heads.error(corner));
                worst = worst.max(error / heads.error(corner));
                tried += 1;
            }
        }
        // A bound that is never approached would hide that it bounds something else.
        assert!(tried > 1000 && worst > power_of_two(-12), "{tried}, {worst:e}");
    }
}
