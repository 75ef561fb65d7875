//! t
use lapjury::experiment::world::planar::{specimen, FAMILIES};
use lapjury::generate::Stream;
use lapjury::laplacian::equilibrium::decide;

#[test]
fn probe() {
    let n: usize = std::env::var("N").map_or(900, |n| n.parse().unwrap());
    let mut stream = Stream::new(1, "probe");
    let mut stat = vec![(0, 0, 0, 0.0f64, 0.0f64); FAMILIES];
    for k in 0..n {
        let s = specimen(k, 60, &mut stream);
        let t = std::time::Instant::now();
        let Some(d) = decide(s.domain.as_surface().unwrap()) else { println!("NONE {}", s.recipe); continue };
        let t = t.elapsed().as_secs_f64();
        let e = &mut stat[k % FAMILIES];
        if d.certificate.is_positive() { e.0 += 1 } else { e.1 += 1 }
        if d.by_simplex { e.2 += 1; println!("simplex {:.2}s {} {}", t, d.certificate.is_positive(), s.recipe); }
        e.3 += t; e.4 = e.4.max(t);
    }
    for (k, e) in stat.iter().enumerate() { println!("{k}: positive {} motion {} simplex {} time {:.2} max {:.2}", e.0, e.1, e.2, e.3, e.4); }
}
