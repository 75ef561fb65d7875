//! The parts of a run, each on its own: what a suite spends its time on.
//!
//! `cargo bench --bench parts` measures, `cargo test --benches` only tries each once.

use std::collections::BTreeMap;
use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use lapjury::domain::delaunay::cotangent_sum_sign;
use lapjury::exchange::{Format, parse_domain, parse_matrix, write_domain, write_matrix_market};
use lapjury::experiment::{self, Effort, Setting};
use lapjury::property::recheck::of_verdict;
use lapjury::suite::cases;
use lapjury::{Domain, Operator, Recipe, Suite, Trial, laplacian, property};

fn domain(recipe: &str) -> Domain {
    recipe.parse::<Recipe>().expect("a recipe").build(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("a domain")
}

fn build(id: &str, domain: &Domain) -> Operator {
    laplacian::find(id).expect("in the catalogue").build(domain, &BTreeMap::new()).expect("an operator")
}

/// The properties that ask about matrices and not about a construction.
fn structural() -> impl Iterator<Item = &'static property::Property> {
    property::ALL.iter().copied().filter(|p| matches!(p.question, property::Question::Operator(_)))
}

fn domains(c: &mut Criterion) {
    let mut group = c.benchmark_group("domains");
    group.bench_function("generate random-delaunay, 1000 points", |b| {
        let recipe: Recipe = "random-delaunay:n=1000,seed=1".parse().expect("a recipe");
        b.iter(|| recipe.build(Path::new(".")).expect("a domain"));
    });
    let spot = domain("fixtures/meshes/spot.ply");
    group.bench_function(format!("facts of spot, {} vertices", spot.vertex_count()), |b| b.iter(|| spot.facts()));
    group.bench_function(format!("digest of spot, {} vertices", spot.vertex_count()), |b| b.iter(|| spot.digest()));
    group.finish();
}

fn operators(c: &mut Criterion) {
    let mut group = c.benchmark_group("operators");
    for levels in [5, 6] {
        let sphere = domain(&format!("icosphere:levels={levels}"));
        let id = BenchmarkId::new("cotan with barycentric mass on an icosphere", sphere.vertex_count());
        group.bench_with_input(id, &sphere, |b, sphere| b.iter(|| build("cotan", sphere)));
    }
    let flipped = domain("random-delaunay:n=1000,seed=1 | flip:count=500,seed=1");
    group.bench_function("intrinsic-delaunay of 500 flips", |b| b.iter(|| build("intrinsic-delaunay", &flipped)));
    group.finish();
}

fn predicates(c: &mut Criterion) {
    let mut group = c.benchmark_group("sign of a weight");
    let (p, q) = ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
    let clear = [[0.5, 1.0, 0.0], [0.5, -1.0, 0.0]];
    // Opposite corners of a square: both angles are right.
    let cocircular = [[0.5, 0.5, 0.0], [0.5, -0.5, 0.0]];
    group.bench_function("clear, in floating point", |b| b.iter(|| cotangent_sum_sign(p, q, black_box(&clear))));
    group.bench_function("cocircular, in rationals", |b| b.iter(|| cotangent_sum_sign(p, q, black_box(&cocircular))));
    group.finish();
}

fn properties(c: &mut Criterion) {
    let sphere = domain("icosphere:levels=5 | perturb:amount=0.1,seed=1");
    let operator = build("cotan", &sphere);
    let mut group = c.benchmark_group(format!("properties of cotan, {} vertices", sphere.vertex_count()));
    for property in structural() {
        group.bench_function(property.id, |b| {
            b.iter(|| property.decide(&Trial::new(&sphere, &operator, 1).expect("of one size"), None));
        });
    }
    group.finish();

    let disk = domain("random-delaunay-disk:n=900,m=100,seed=1 | flip:count=50,seed=1");
    let operator = build("cotan", &disk);
    let mut group =
        c.benchmark_group(format!("properties of cotan on a flipped disk, {} vertices", disk.vertex_count()));
    for id in ["PSD", "KER", "MAX-global", "MAX-heat"] {
        let property = property::find(id).expect("a property");
        group.bench_function(id, |b| {
            b.iter(|| property.decide(&Trial::new(&disk, &operator, 1).expect("of one size"), None));
        });
    }
    group.finish();
}

fn recheck(c: &mut Criterion) {
    let disk = domain("random-delaunay:n=1000,seed=1");
    let operator = build("cotan", &disk);
    let trial = Trial::new(&disk, &operator, 1).expect("of one size");
    let mut group = c.benchmark_group(format!("recheck on {} vertices", disk.vertex_count()));
    for id in ["SYM", "POS0", "LIN", "PSD"] {
        let verdict = property::find(id).expect("a property").decide(&trial, None);
        group.bench_function(id, |b| b.iter(|| of_verdict(&verdict, id, &disk, &operator).expect("true evidence")));
    }
    group.finish();
}

fn files(c: &mut Criterion) {
    let sphere = domain("icosphere:levels=5");
    let off = write_domain(&sphere, Format::Off).expect("a mesh");
    let matrix = build("cotan", &sphere).stiffness().clone();
    let text = write_matrix_market(&matrix);
    let mut group = c.benchmark_group(format!("files of an icosphere, {} vertices", sphere.vertex_count()));
    group.bench_function("read OFF", |b| {
        b.iter(|| parse_domain(Format::Off, "sphere.off", off.as_bytes()).expect("a mesh"))
    });
    group.bench_function("write Matrix Market", |b| b.iter(|| write_matrix_market(&matrix)));
    group
        .bench_function("read Matrix Market", |b| b.iter(|| parse_matrix("l.mtx", text.as_bytes()).expect("a matrix")));
    group.finish();
}

fn experiments(c: &mut Criterion) {
    let mut group = c.benchmark_group("experiments, smoke");
    for entry in experiment::ALL {
        let setting = Setting { seed: 1, effort: Effort::Smoke };
        group.bench_function(entry.id, |b| b.iter(|| (entry.run)(&setting)));
    }
    group.finish();
}

fn whole_cases(c: &mut Criterion) {
    let plan = Suite::built_in("smoke").and_then(|suite| suite.plan()).expect("a plan");
    let case = plan.cases.iter().find(|case| case.class == "flipped").expect("a flipped mesh");
    c.bench_function("one case of the smoke suite, every operator and property", |b| {
        b.iter(|| cases::decide(case, Path::new(".")).expect("a domain"));
    });
}

criterion_group! {
    name = parts;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500))
        .without_plots();
    targets = domains, operators, predicates, properties, recheck, files, experiments, whole_cases
}
criterion_main!(parts);
