//! The eigensolver: the first eigenvalues of icospheres, closed by an inertia count.
//!
//! `cargo bench --bench spectra`. Beside SciPy it is measured by `scripts/bench_eigen.py`.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use lapjury::linalg::spectrum::lowest;
use lapjury::{Recipe, laplacian};

fn spheres(c: &mut Criterion) {
    let mut group = c.benchmark_group("lowest");
    group.sample_size(10);
    for level in [4, 5] {
        let recipe: Recipe = format!("icosphere:levels={level}").parse().expect("a recipe");
        let domain = recipe.build(std::path::Path::new(".")).expect("a sphere");
        let operator =
            laplacian::find("cotan").expect("cotan").build(&domain, &Default::default()).expect("an operator");
        let mass = operator.mass().expect("a mass").matrix();
        for count in [4, 50] {
            let id = BenchmarkId::new(format!("{} vertices", domain.vertex_count()), count);
            group.bench_with_input(id, &count, |b, &count| {
                b.iter(|| lowest(operator.stiffness(), mass, count, 1).expect("a spectrum"))
            });
        }
    }
    group.finish();
}

criterion_group!(benches, spheres);
criterion_main!(benches);
