//! Exact arithmetic: the assembly of a large planar mesh, decisions on a small one, and the exhaustive search.
//!
//! `cargo bench --bench exact` measures, `cargo test --benches` only tries each once.

use std::path::Path;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use lapjury::laplacian::{cotan, wachspress};
use lapjury::linalg::Csr;
use lapjury::property::exact::{Case, Plane};
use lapjury::suite::Choice;
use lapjury::suite::atlas::{World, search};
use lapjury::{Domain, Rational, Recipe, property};

fn domain(recipe: &str) -> Domain {
    recipe.parse::<Recipe>().expect("a recipe").build(Path::new(".")).expect("a domain")
}

fn assembly(c: &mut Criterion) {
    let mut group = c.benchmark_group("exact assembly of 10,000 vertices");
    let mesh = domain("random-delaunay:n=10000,seed=1");
    let surface = mesh.as_surface().expect("a surface");
    group.bench_function("cotan", |b| {
        b.iter(|| -> Csr<Rational> { cotan::stiffness_in_plane(surface).expect("planar") })
    });
    group.bench_function("wachspress", |b| {
        b.iter(|| -> Csr<Rational> { wachspress::stiffness_in_plane(surface).expect("planar") })
    });
    group.finish();
}

fn decisions(c: &mut Criterion) {
    let mut group = c.benchmark_group("exact decisions on 30 vertices");
    let mesh = domain("random-delaunay:n=30,seed=1 | flip:count=10,seed=1");
    let stiffness = cotan::stiffness_in_plane(mesh.as_surface().expect("a surface")).expect("planar");
    let plane = Plane::new(&mesh).expect("planar");
    let case = Case::new(&plane, &stiffness).expect("of its size");
    for id in ["POS", "LIN", "PSD", "MAX-global"] {
        group.bench_function(id, |b| b.iter(|| case.decide(id)));
    }
    group.finish();
}

fn searches(c: &mut Criterion) {
    let mut group = c.benchmark_group("exhaustive search");
    for (laplacian, id) in [("cotan", "POS"), ("cotan", "PSD"), ("mean-value", "LIN")] {
        let choice: Choice = laplacian.parse().expect("in the catalogue");
        let property = property::find(id).expect("a property");
        let world = World::of(property);
        group.bench_function(format!("{laplacian} {id}"), |b| b.iter(|| search(world, &[(&choice, property)])));
    }
    group.finish();
}

criterion_group! {
    name = exact;
    config = Criterion::default().sample_size(10).measurement_time(Duration::from_secs(3));
    targets = assembly, decisions, searches
}
criterion_main!(exact);
