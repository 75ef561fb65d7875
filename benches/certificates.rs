//! One certificate of no free lunch: decided, written down, verified again.

use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use lapjury::experiment::world::certified::evidence;
use lapjury::laplacian::equilibrium::{decide, decide_by_simplex};
use lapjury::property::recheck::from_excerpt;
use lapjury::{Domain, Recipe, laplacian};

fn domain(recipe: &str) -> Domain {
    recipe.parse::<Recipe>().expect("a recipe").build(Path::new(".")).expect("a domain")
}

fn certificates(c: &mut Criterion) {
    let mut group = c.benchmark_group("certificates");
    for n in [50, 200] {
        for (name, changes) in [("lift", ""), ("motion", " | worst-angle")] {
            let domain = domain(&format!("random-delaunay:n={n},seed=1{changes}"));
            let surface = domain.as_surface().expect("a surface");
            group.bench_with_input(BenchmarkId::new(format!("decide, {name}"), n), surface, |b, s| {
                b.iter(|| decide(black_box(s)).expect("planar"));
            });
            let found = decide(surface).expect("planar");
            assert_eq!(found.certificate.is_positive(), name == "lift");
            let written = evidence(surface, &found.certificate).expect("planar");
            group.bench_with_input(BenchmarkId::new(format!("recheck, {name}"), n), &written, |b, e| {
                b.iter(|| from_excerpt(black_box(e)).expect("true"));
            });
        }
        let delaunay = domain(&format!("random-delaunay:n={n},seed=1"));
        let optimal = laplacian::find("optimal-positive").expect("in the catalogue");
        group.bench_with_input(BenchmarkId::new("optimal-positive", n), &delaunay, |b, d| {
            b.iter(|| optimal.build(black_box(d), &Default::default()).expect("positive weights"));
        });
    }
    let straight = domain("schonhardt:twist=0,ratio=0.5,nested=3");
    let straight = straight.as_surface().expect("a surface");
    group.bench_function("decide by the exact simplex method, 12 points", |b| {
        b.iter(|| decide_by_simplex(black_box(straight)).expect("planar"));
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500))
        .without_plots();
    targets = certificates
}
criterion_main!(benches);
