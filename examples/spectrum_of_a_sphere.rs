//! The first eigenvalues of an icosphere against `l(l + 1)`: multiplicities, order, inertia, time.
//!
//! `cargo run --release --example spectrum_of_a_sphere -- [COUNT] [SEEDS] [LEVEL …]`

use std::time::Instant;

use lapjury::linalg::spectrum::lowest;
use lapjury::{Recipe, laplacian};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let numbers: Vec<usize> = std::env::args().skip(1).map(|a| a.parse()).collect::<Result<_, _>>()?;
    let count = numbers.first().copied().unwrap_or(100);
    let seeds = numbers.get(1).copied().unwrap_or(1) as u64;
    let levels = if numbers.len() > 2 { numbers[2..].to_vec() } else { vec![5, 6, 7] };
    let mut last: Option<Vec<f64>> = None;
    for level in levels {
        let recipe: Recipe = format!("icosphere:levels={level}").parse()?;
        let domain = recipe.build(std::path::Path::new("."))?;
        let operator = laplacian::find("cotan").ok_or("cotan")?.build(&domain, &Default::default())?;
        let mass = operator.mass().ok_or("a mass")?.matrix();
        for seed in 0..seeds {
            let start = Instant::now();
            let spectrum = lowest(operator.stiffness(), mass, count, seed)?;
            let seconds = start.elapsed().as_secs_f64();
            let degree = |k: usize| (k as f64).sqrt().floor();
            let exact = |k: usize| degree(k) * (degree(k) + 1.0);
            let errors: Vec<f64> = (0..spectrum.values.len()).map(|k| (spectrum.values[k] - exact(k)).abs()).collect();
            let worst = errors.iter().zip(0..).skip(4).map(|(e, k)| e / exact(k)).fold(0.0, f64::max);
            let residual = spectrum.residuals.iter().copied().fold(0.0, f64::max);
            println!(
                "{} vertices, seed {seed}: {} eigenvalues in {seconds:.2} s ({} solves), worst relative error {worst:.3e}, \
                 worst residual {residual:.1e}, {:?}",
                domain.vertex_count(),
                spectrum.values.len(),
                spectrum.solves,
                spectrum.closure
            );
            if seed + 1 == seeds {
                if let Some(last) = &last {
                    let order = |k: usize| (last[k] / errors[k]).log2();
                    let orders: Vec<f64> = (4..errors.len().min(last.len())).map(order).collect();
                    let (low, high) = orders.iter().fold((f64::MAX, f64::MIN), |(a, b), o| (a.min(*o), b.max(*o)));
                    println!("  observed order for l ≥ 2: {low:.3} to {high:.3}");
                }
                last = Some(errors);
            }
        }
    }
    Ok(())
}
