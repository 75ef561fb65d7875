//! Cotangents and cotangent weights against a formula of their own in integers, on the triangles that floating point fears.

mod oracle;

use lapjury::domain::cotangent::{self, Way};
use lapjury::domain::geometry::Vec3;
use lapjury::stream::Stream;
use oracle::{FAMILIES, Point, triangle, ulps_of_cotangent, ulps_of_half_sum};
use rayon::prelude::*;

/// Half a unit for the last rounding and a quarter of u before it.
const CLAIMED: f64 = 0.75;

fn vectors(t: [Point; 3]) -> [Vec3; 3] {
    t.map(Vec3::from)
}

fn corner(t: [Point; 3], k: usize) -> [Point; 3] {
    [t[k], t[(k + 1) % 3], t[(k + 2) % 3]]
}

#[test]
fn cotangents_are_right_to_the_last_digit_on_a_hundred_thousand_triangles_of_every_bad_family() {
    for (family, name) in FAMILIES.iter().enumerate() {
        let worst = (0..100_u64).into_par_iter().map(|batch| {
            let mut r = Stream::new(batch, name);
            let (mut worst, mut proper) = (0.0_f64, 0);
            for _ in 0..100 {
                let t = triangle(family, &mut r);
                let found = cotangent::of_triangle(vectors(t));
                for k in 0..3 {
                    let Some(ulps) = ulps_of_cotangent(corner(t, k), found.values[k]) else { continue };
                    assert!(ulps <= CLAIMED, "{name}: {ulps} ulp by {:?} at {k} of {t:?}", found.ways[k]);
                    worst = worst.max(ulps);
                    proper += 1;
                }
            }
            (worst, proper)
        });
        let (worst, proper) = worst.reduce(|| (0.0, 0), |a, b| (a.0.max(b.0), a.1 + b.1));
        assert!(proper > 10_000 && worst > 0.0, "{name}: {proper} angles, worst {worst}");
    }
}

#[test]
fn one_corner_alone_has_the_cotangent_of_the_triangle_and_so_has_every_order_of_its_corners() {
    for (family, name) in FAMILIES.iter().enumerate() {
        let mut r = Stream::new(3, name);
        for _ in 0..200 {
            let t = triangle(family, &mut r);
            let [a, b, c] = vectors(t);
            let all = cotangent::of_triangle([a, b, c]).values;
            for (found, k) in [
                (cotangent::cotangent(a, b, c), 0),
                (cotangent::cotangent(a, c, b), 0),
                (cotangent::of_triangle([b, a, c]).values[0], 1),
                (cotangent::of_triangle([c, b, a]).values[0], 2),
            ] {
                if ulps_of_cotangent(corner(t, k), all[k]).is_some() {
                    assert!((found - all[k]).abs() <= f64::EPSILON * all[k].abs(), "{name}: {found:e}, {:e}", all[k]);
                }
            }
        }
    }
}

#[test]
fn powers_of_two_change_no_bit() {
    for (family, name) in FAMILIES.iter().enumerate() {
        let mut r = Stream::new(4, name);
        for _ in 0..100 {
            let t = triangle(family, &mut r);
            let found = cotangent::of_triangle(vectors(t)).values;
            for power in [-100, -30, -1, 1, 20, 90] {
                let scaled = t.map(|p| p.map(|x| x * 2f64.powi(power)));
                let again = cotangent::of_triangle(vectors(scaled)).values;
                if found.iter().all(|c| c.is_finite()) {
                    assert_eq!(found.map(f64::to_bits), again.map(f64::to_bits), "{name}, 2^{power}: {t:?}");
                }
            }
        }
    }
}

/// Points of the circle around the origin of radius 65, going round.
const ON_CIRCLE: [(f64, f64); 12] = [
    (65.0, 0.0),
    (63.0, 16.0),
    (52.0, 39.0),
    (25.0, 60.0),
    (0.0, 65.0),
    (-33.0, 56.0),
    (-60.0, 25.0),
    (-63.0, -16.0),
    (-39.0, -52.0),
    (0.0, -65.0),
    (16.0, -63.0),
    (56.0, -33.0),
];

/// Two triangles over one edge: `[apex, p, q]` each, the angles together almost, or exactly, 180°.
fn kite(kind: usize, r: &mut Stream) -> [[Point; 3]; 2] {
    let turn = r.between(0.0, std::f64::consts::TAU);
    let on_circle = |angle: f64| [(turn + angle).cos(), (turn + angle).sin(), 0.0];
    let (first, second, third) = (r.between(0.1, 1.5), r.between(1.6, 3.0), r.between(3.1, 6.2));
    let [p, a, q, mut b] = [0.0, first, second, third].map(on_circle);
    match kind {
        // Rounded from one circle: the sum is some last bits of its terms.
        0 => {}
        // A little off the circle.
        1 => b = b.map(|x| x * (1.0 + 10f64.powf(r.between(-15.0, -1.0)))),
        // Folded up along the edge, the sum irrational.
        2 => {
            let middle: Point = std::array::from_fn(|k| 0.5 * (p[k] + q[k]));
            let away: Point = std::array::from_fn(|k| b[k] - middle[k]);
            let along: Point = std::array::from_fn(|k| q[k] - p[k]);
            let dot = |x: Point, y: Point| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
            let share = dot(away, along) / dot(along, along);
            let foot: Point = std::array::from_fn(|k| middle[k] + share * along[k]);
            let rise: Point = std::array::from_fn(|k| b[k] - foot[k]);
            let height = dot(rise, rise).sqrt();
            let fold = r.between(0.1, 1.5);
            b = std::array::from_fn(|k| {
                foot[k] + rise[k] * fold.cos() + if k == 2 { height * fold.sin() } else { 0.0 }
            });
        }
        // Integer points on the circle x² + y² = 65²: exactly cocircular.
        _ => {
            let mut four = [0; 4];
            while (1..4).any(|k| four[..k].contains(&four[k])) {
                four = [0; 4].map(|_: usize| r.below(ON_CIRCLE.len()));
            }
            four.sort_unstable();
            let at = |k: usize| [ON_CIRCLE[k].0, ON_CIRCLE[k].1, 0.0];
            return [[at(four[1]), at(four[0]), at(four[2])], [at(four[3]), at(four[0]), at(four[2])]];
        }
    }
    [[a, p, q], [b, p, q]]
}

fn weight(corners: [[Point; 3]; 2]) -> f64 {
    let corners = corners.map(vectors);
    let cotangents = corners.map(|c| cotangent::of_triangle(c).values[0]);
    cotangent::half_sum(&cotangents, || corners.into_iter())
}

#[test]
fn weights_are_within_four_units_in_the_last_place_however_much_of_them_cancels() {
    let (mut worst, mut zeros) = ([0.0_f64; 5], 0);
    for (kind, worst) in worst.iter_mut().enumerate() {
        let mut r = Stream::new(5, "kites");
        for _ in 0..2000 {
            let corners = if kind < 4 {
                kite(kind, &mut r)
            } else {
                // Any two triangles at all.
                let [a, p, q] = triangle(r.below(FAMILIES.len()), &mut r);
                [[a, p, q], [triangle(1, &mut r)[0], p, q]]
            };
            let found = weight(corners);
            let Some(ulps) = ulps_of_half_sum(corners, found) else { continue };
            assert!(ulps <= 4.0, "kind {kind}: {ulps} ulp, {found:e} for {corners:?}");
            *worst = worst.max(ulps);
            zeros += usize::from(found == 0.0);
        }
    }
    assert!(worst[0] > 0.0 && worst[2] > 0.0 && worst[4] > 0.0 && zeros >= 2000, "{worst:?}, {zeros}");
}

#[test]
fn precise_weights_have_digits_to_spare() {
    let mut r = Stream::new(6, "kites");
    for _ in 0..2000 {
        let corners = kite(1, &mut r);
        let found = cotangent::precise_half_sum(corners.map(vectors));
        if let Some(ulps) = ulps_of_half_sum(corners, found.high) {
            assert!(ulps <= 1.0, "{ulps} for {corners:?}");
        }
    }
}

#[test]
fn three_faces_at_an_edge_add_up_and_cancel() {
    // cot 45° twice against cot 135°.. and a third that is left over.
    let (p, q) = (Vec3::zeros(), Vec3::new(2.0, 0.0, 0.0));
    let (right, acute) = (Vec3::new(1.0, 1.0, 0.0), Vec3::new(0.0, 2.0, 0.0));
    let of = |apexes: [Vec3; 3]| cotangent::precise_half_sum(apexes.map(|a| [a, p, q])).high;
    assert_eq!(of([right; 3]), 0.0);
    assert_eq!(of([right, acute, acute]), 1.0);
    // (1, h) sees the edge under 2 atan(1/h): cot = (h² − 1)/2h, −¾ for h = ½.
    let obtuse = Vec3::new(1.0, 0.5, 0.0);
    assert_eq!(of([obtuse, right, acute]), 0.125);
}

#[test]
fn the_ways_are_taken_where_they_are_said_to_be() {
    let ways = |t: [Point; 3]| cotangent::of_triangle(vectors(t)).ways;
    let flat = |h: f64| [[0.3, 0.1, 0.0], [1.3, 0.1, 0.0], [0.8, 0.1 + h, 0.0]];
    assert_eq!(ways(flat(0.4)), [Way::Heads; 3]);
    assert_eq!(ways(flat(1e-3)), [Way::Heads; 3]);
    assert_eq!(ways(flat(1e-7)), [Way::Distilled; 3]);
    // An exact right angle needs no care, on the axes or off them.
    assert_eq!(ways([[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.7, 0.0]]), [Way::Heads; 3]);
    assert_eq!(ways([[0.0; 3], [3.0, 4.0, 0.0], [-4.0, 3.0, 0.0]]), [Way::Heads; 3]);
    // A height that products cannot hold beside a length of one.
    assert_eq!(ways([[0.0; 3], [1.0, 0.0, 0.0], [0.5, 1e-200, 0.0]]), [Way::Rational; 3]);
}

#[test]
fn a_degenerate_triangle_has_no_finite_cotangent() {
    let line = [Vec3::zeros(), Vec3::x(), Vec3::x() * 3.0];
    let found = cotangent::of_triangle(line);
    assert!(found.values.iter().all(|c| c.is_infinite()) && found.doubled_area == 0.0, "{found:?}");
    assert!(cotangent::precise_half_sum([line]).high.is_nan());
}

#[test]
fn a_cotangent_below_the_normal_numbers_keeps_its_sign() {
    // cot = 1e-200 · 1e-150 / 1 at the origin, in a triangle with sides of 1e150 and 1.
    let (p, q) = (Vec3::new(1e150, 0.0, 0.0), Vec3::new(1e-200, 1e150, 0.0));
    for (q, sign) in [(q, 1.0), (Vec3::new(-1e-200, 1e150, 0.0), -1.0), (Vec3::new(0.0, 1e150, 0.0), 0.0)] {
        let found = cotangent::cotangent(Vec3::zeros(), p, q);
        assert_eq!(found, sign * f64::MIN_POSITIVE);
        assert_eq!(cotangent::half_sum(&[found], std::iter::empty), sign * f64::MIN_POSITIVE / 2.0);
    }
}

#[test]
fn many_triangles_side_by_side_have_the_bits_of_each_alone() {
    let mut r = Stream::new(3, "side by side");
    // Counts that leave a rest; families in turn, so that slow triangles stand beside quick ones.
    for count in [0, 1, 31, 32, 33, 4096, 4099] {
        let all: Vec<[Point; 3]> = (0..count).map(|k| triangle(k % FAMILIES.len(), &mut r)).collect();
        let mut found = vec![[0.0; 4]; count];
        cotangent::of_triangles(|k| all[k], &mut found);
        for (t, found) in all.iter().zip(&found) {
            let alone = cotangent::of_triangle(vectors(*t));
            let [x, y, z] = alone.values;
            assert_eq!(found.map(f64::to_bits), [x, y, z, alone.doubled_area].map(f64::to_bits), "{t:?}");
        }
    }
}
