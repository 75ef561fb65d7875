//! What right cotangents cost: on healthy triangles, on slivers, on needles and caps; and what half-sums cost that cancel.
//!
//! `cargo bench --bench cotangents` measures and says which share of the angles took the careful and the exact way. "plain" is the
//! formula that one would write without a bound.

use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lapjury::domain::cotangent::{self, Way};
use lapjury::domain::geometry::Vec3;
use lapjury::stream::Stream;
use lapjury::{Domain, Recipe};

fn of_mesh(recipe: &str) -> Vec<[Vec3; 3]> {
    let recipe: Recipe = recipe.parse().expect("a recipe");
    let domain = recipe.build(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("a domain");
    let Domain::Surface(surface) = domain else { return Vec::new() };
    (0..surface.faces().len()).filter_map(|f| surface.triangle(f)).map(|t| t.map(|v| surface.point(v))).collect()
}

/// Triangles in space with one angle between 1e-12 and 0.1, and random other ones.
fn needles() -> Vec<[Vec3; 3]> {
    let mut r = Stream::new(1, "needles");
    let mut vector = move || Vec3::from_fn(|_, _| r.between(-1.0, 1.0));
    let mut s = Stream::new(2, "angles");
    (0..5000)
        .map(|_| {
            let (a, u, v) = (vector(), vector(), vector());
            let off = v - u * (u.dot(&v) / u.norm_squared());
            [a, a + u, a + u * s.between(0.5, 2.0) + off * 10f64.powf(s.between(-12.0, -1.0))]
        })
        .collect()
}

fn plain(corners: [Vec3; 3]) -> [f64; 3] {
    let at = |k: usize| corners[k % 3];
    let area = (at(1) - at(0)).cross(&(at(2) - at(0))).norm();
    [0, 1, 2].map(|k| (at(k + 1) - at(k)).dot(&(at(k + 2) - at(k))) / area)
}

fn triangles(c: &mut Criterion) {
    let families = [
        ("sphere", of_mesh("icosphere:levels=5 | perturb:amount=0.1,seed=1")),
        ("grid", of_mesh("grid:nx=60,ny=60")),
        ("delaunay", of_mesh("random-delaunay:n=4000,seed=1")),
        ("flipped", of_mesh("random-delaunay:n=4000,seed=1 | flip:count=2000,seed=1")),
        ("needles", needles()),
    ];
    let mut group = c.benchmark_group("cotangents of a triangle");
    for (name, triangles) in &families {
        let ways: Vec<Way> = triangles.iter().flat_map(|t| cotangent::of_triangle(*t).ways).collect();
        let share = |way: Way| 100.0 * ways.iter().filter(|w| **w == way).count() as f64 / ways.len() as f64;
        println!("{name}: careful {:.3} %, exact {:.3} %", share(Way::Distilled), share(Way::Rational));
        group.throughput(Throughput::Elements(triangles.len() as u64));
        group.bench_function(format!("{name}, right"), |b| {
            b.iter(|| triangles.iter().map(|t| cotangent::of_triangle(*black_box(t)).values[0]).sum::<f64>());
        });
        group.bench_function(format!("{name}, plain"), |b| {
            b.iter(|| triangles.iter().map(|t| plain(*black_box(t))[0]).sum::<f64>());
        });
    }
    group.finish();
}

fn half_sums(c: &mut Criterion) {
    // (0, y) sees the edge from (1, 0) to (−1, 0) under an angle with the cotangent (y² − 1) / 2|y|.
    let kite = |low: f64, high: f64| [-low, high].map(|y| [Vec3::y() * y, Vec3::x(), -Vec3::x()]);
    let mut group = c.benchmark_group("half-sum of two cotangents");
    let last = 2.0 + 4.0 * f64::EPSILON;
    for (name, corners) in [
        ("of one sign", kite(2.0, 3.0)),
        ("cancelling to a twentieth", kite(0.5, 1.9)),
        ("cancelling to the last place", kite(0.5, last)),
        ("cancelling to zero", kite(0.5, 2.0)),
    ] {
        let cotangents = corners.map(|c| cotangent::of_triangle(c).values[0]);
        group.bench_function(name, |b| {
            b.iter(|| cotangent::half_sum(black_box(&cotangents), || black_box(corners).into_iter()));
        });
    }
    group.finish();
}

criterion_group! {
    name = cotangents;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500))
        .without_plots();
    targets = triangles, half_sums
}
criterion_main!(cotangents);
