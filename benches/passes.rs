//! Each pass over a large mesh on its own: connectivity, shapes, rows, masses, flips, and every structural verdict.
//!
//! `cargo bench --bench passes` measures, `cargo test --benches` only tries each once. The number of threads is that of
//! `RAYON_NUM_THREADS`. Beside other libraries the same passes are measured by `scripts/bench_peers.py`.

use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use lapjury::domain::intrinsic::IntrinsicTriangulation;
use lapjury::domain::topology::Topology;
use lapjury::laplacian::shape::Triangles;
use lapjury::laplacian::{mass, stiffness};
use lapjury::operator::Provenance;
use lapjury::{Domain, Mass, MassKind, Operator, Recipe, Surface, Trial, laplacian, property};

fn domain(recipe: &str) -> Domain {
    recipe.parse::<Recipe>().expect("a recipe").build(Path::new(".")).expect("a domain")
}

fn surface(domain: &Domain) -> &Surface {
    domain.as_surface().expect("a surface")
}

/// 10 242 and 163 842 vertices: what fits the caches, and what does not.
const LEVELS: [usize; 2] = [5, 7];

fn sphere(levels: usize) -> Domain {
    domain(&format!("icosphere:levels={levels} | perturb:amount=0.1,seed=1"))
}

fn build(id: &str, domain: &Domain) -> Operator {
    laplacian::find(id).expect("in the catalogue").build(domain, &Default::default()).expect("an operator")
}

fn construction(c: &mut Criterion) {
    for domain in LEVELS.map(sphere) {
        let (surface, n) = (surface(&domain), domain.vertex_count());
        let mut group = c.benchmark_group("construction, per vertex");
        group.throughput(Throughput::Elements(n as u64));
        group.bench_function(BenchmarkId::new("topology", n), |b| b.iter(|| Topology::new(n, surface.faces())));
        group.bench_function(BenchmarkId::new("shapes", n), |b| b.iter(|| Triangles::new("cotan", surface, false)));
        let triangles = Triangles::new("cotan", surface, false).expect("proper triangles");
        let weight = |e: usize| triangles.cotangents_opposite(e).map(|cot| 0.5 * cot).sum::<f64>();
        let edges = surface.topology().edges();
        let weights: Vec<_> = edges.iter().enumerate().map(|(e, &ends)| (ends, [weight(e); 2])).collect();
        group.bench_function(BenchmarkId::new("weights", n), |b| {
            b.iter(|| (0..edges.len()).map(weight).map(black_box).fold(0.0, f64::max))
        });
        group.bench_function(BenchmarkId::new("rows of edges in any order", n), |b| {
            b.iter(|| stiffness::from_weights(n, &weights))
        });
        for kind in [MassKind::Barycentric, MassKind::Mixed, MassKind::Consistent] {
            let each = || triangles.each().map(|(_, corners, shape)| (corners, shape));
            group.bench_function(BenchmarkId::new(format!("{} mass, face by face", kind.name()), n), |b| {
                b.iter(|| mass::of_triangles(kind, n, each()))
            });
        }
        group
            .bench_function(BenchmarkId::new("cotan with barycentric mass", n), |b| b.iter(|| build("cotan", &domain)));
        group.finish();
    }
}

fn flips(c: &mut Criterion) {
    let mut group = c.benchmark_group("intrinsic Delaunay, a tenth of the edges flipped");
    let flipped = domain("random-delaunay:n=10000,seed=1 | flip:count=3000,seed=1");
    let in_space = surface(&flipped).positions().iter().map(|p| [0.6 * p[0], p[1], 0.8 * p[0]]).collect();
    let in_space = Domain::from(surface(&flipped).with_positions(in_space).expect("finite"));
    for (place, domain) in [("in the plane", &flipped), ("in space", &in_space)] {
        group.bench_function(format!("{place}, gluing and flips"), |b| {
            b.iter(|| IntrinsicTriangulation::new(surface(domain), |_| true).expect("a manifold").make_delaunay());
        });
        group.bench_function(format!("{place}, operator"), |b| b.iter(|| build("intrinsic-delaunay", domain)));
    }
    group.finish();
}

/// The same operator as it would come from a file: nothing is known of its signs and its mass.
fn given(operator: &Operator) -> Operator {
    let provenance = Provenance { id: "given".into(), ..Provenance::default() };
    let mass = Mass::full(MassKind::Given, operator.mass().expect("a mass").matrix().clone());
    Operator::new(operator.stiffness().clone(), provenance).and_then(|o| o.with_mass(mass)).expect("of one size")
}

fn verdicts(c: &mut Criterion) {
    let plane = domain("perturbed-grid:nx=150,ny=150,displacement=0.2,seed=1");
    for (name, domain) in [("a sphere", sphere(5)), ("a planar grid", plane)] {
        let operator = given(&build("cotan", &domain));
        let mut group = c.benchmark_group(format!("verdicts on {name} of {} vertices", domain.vertex_count()));
        group.bench_function("stencil and scales, shared by all", |b| {
            b.iter(|| Trial::new(&domain, &operator, 0).expect("of one size").scales().rows.len());
        });
        let trial = Trial::new(&domain, &operator, 0).expect("of one size");
        trial.scales();
        // The three POS share one survey: the first asks for it.
        for id in "FIN LOC SYM NULL POS POS0 POS-boundary LIN ENERGY FLUX MVP MASS MAX-local".split(' ') {
            let property = property::find(id).expect("a property");
            group.bench_function(id, |b| b.iter(|| property.decide(&trial, None)));
        }
        group.finish();
    }
}

fn facts(c: &mut Criterion) {
    let domain = sphere(6);
    let mut group = c.benchmark_group(format!("a surface of {} vertices", domain.vertex_count()));
    group.bench_function("facts", |b| b.iter(|| domain.facts()));
    group.bench_function("digest", |b| b.iter(|| domain.digest()));
    group.finish();
}

criterion_group! {
    name = passes;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500))
        .without_plots();
    targets = construction, flips, verdicts, facts
}
criterion_main!(passes);
