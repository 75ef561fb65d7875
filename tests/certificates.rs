//! What certifies PSD, KER and MAX, against a second way and against operators that are spoilt a little.

use std::path::Path;

use lapjury::domain::Domain;
use lapjury::laplacian;
use lapjury::linalg::Csr;
use lapjury::linalg::exact::Dense;
use lapjury::operator::{Mass, MassKind, Operator, Provenance};
use lapjury::property::{self, Level, Status, Trial, Verdict, recheck};
use lapjury::scalar::{Rational, Scalar};

fn domain(recipe: &str) -> Domain {
    recipe.parse::<lapjury::Recipe>().unwrap().build(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn built(id: &str, domain: &Domain) -> Operator {
    laplacian::find(id).unwrap().build(domain, &Default::default()).unwrap()
}

fn given(l: Csr) -> Operator {
    Operator::new(l, Provenance::default()).unwrap()
}

/// The verdict; its evidence must survive the recheck.
fn judge(id: &str, domain: &Domain, operator: &Operator) -> Verdict {
    let trial = Trial::new(domain, operator, 3).unwrap();
    let verdict = property::find(id).unwrap().decide(&trial, None);
    if let Some(evidence) = verdict.evidence() {
        recheck::against(evidence, id, domain, operator).unwrap();
    }
    verdict
}

/// The matrix in rationals, each diagonal entry replaced by minus the sum of the others.
fn with_exact_sums(l: &Csr) -> Dense<Rational> {
    let exact = |v: f64| Rational::exactly(v).unwrap();
    let off = |i: usize| l.row(i).filter(|(j, _)| *j != i).fold(Rational::zero(), |s, (_, v)| s + exact(*v));
    let diagonal: Vec<Rational> = (0..l.rows()).map(|i| -off(i)).collect();
    Dense::from_fn(l.rows(), l.rows(), |i, j| if i == j { diagonal[i].clone() } else { exact(l.at(i, j)) })
}

#[test]
fn a_kernel_bounded_by_singular_values_has_the_rank_of_the_rationals() {
    let mut bounded = 0;
    for recipe in ["slivers:aspect=1e6,columns=3,rows=4,shape=cap", "slivers:aspect=1e3,columns=3,rows=3,shape=cap"] {
        let domain = domain(recipe);
        for id in ["wachspress", "three-point"] {
            let operator = built(id, &domain);
            let verdict = judge("KER", &domain, &operator);
            assert_eq!(verdict.status(), Status::Holds, "{id} on {recipe}: {verdict:?}");
            bounded += usize::from(verdict.level == Level::Bounded);
            assert_eq!(with_exact_sums(operator.stiffness()).rank(), operator.size() - 1);
        }
    }
    assert!(bounded > 1, "{bounded}");
}

#[test]
fn a_second_vector_of_the_kernel_is_never_bounded_away() {
    let domain = domain("random-delaunay:n=30,seed=5 | flip:count=12,seed=5");
    let operator = built("wachspress", &domain);
    let l = operator.stiffness();
    assert_eq!(judge("KER", &domain, &operator).status(), Status::Holds);
    // L − (Lx)(e_a − e_b)ᵀ / (x_a − x_b) has constants and x in its kernel.
    let x: Vec<f64> = (0..l.rows()).map(|i| ((7 * i) % 11) as f64).collect();
    let image = l.mul(&x);
    let correction: Vec<_> =
        (0..l.rows()).flat_map(|i| [(i, 1, -image[i] / (x[1] - x[0])), (i, 0, image[i] / (x[1] - x[0]))]).collect();
    let spoilt = given(l.add(&Csr::from_triplets(l.rows(), l.rows(), &correction)));
    assert_ne!(judge("KER", &domain, &spoilt).status(), Status::Holds);
}

#[test]
fn a_sliver_excuses_no_negative_energy_among_healthy_triangles() {
    // An equilateral star, and apart from it a needle of 1e-6.
    let mut points: Vec<[f64; 2]> = vec![[0.0, 0.0]];
    points.extend((0..6).map(|k| f64::from(k) * std::f64::consts::FRAC_PI_3).map(|a| [a.cos(), a.sin()]));
    points.extend([[5.0, 0.0], [6.0, 0.0], [5.0, 1e-6]]);
    let mut faces: Vec<[usize; 3]> = (0..6).map(|k| [0, 1 + k, 1 + (k + 1) % 6]).collect();
    faces.push([7, 8, 9]);
    let domain = Domain::from(lapjury::Surface::planar(&points, &faces).unwrap());
    let l = built("cotan", &domain).stiffness().clone();
    let lowered = |i: usize, by: f64| given(l.add(&Csr::from_triplets(10, 10, &[(i, i, -by * l.row_scales()[i])])));
    for by in [1e-12, 1e-10, 1e-7] {
        let verdict = judge("PSD", &domain, &lowered(0, by));
        assert_eq!((verdict.status(), verdict.level), (Status::Fails, Level::Exact), "{by}: {verdict:?}");
    }
    // As much beside the sliver is what rounding does there.
    assert_eq!(judge("PSD", &domain, &lowered(9, 1e-10)).status(), Status::Holds);
}

#[test]
fn heat_flows_from_hot_to_cold_in_large_steps_too_and_a_negative_weight_is_seen_there() {
    let domain = domain("random-delaunay:n=30,seed=11 | scale:factor=1e12");
    for id in ["graph", "mean-value"] {
        let operator = built(id, &domain);
        assert_eq!(judge("MAX-heat", &domain, &operator).status(), Status::Holds, "{id}");
        let (l, mass) = (operator.stiffness(), operator.mass().unwrap().diagonal());
        let (i, j, v) = l.entries().find(|(i, j, v)| i < j && **v != 0.0).unwrap();
        let d = -2.0 * v;
        let changes = [(i, j, d), (j, i, d), (i, i, -d), (j, j, -d)];
        let spoilt = given(l.add(&Csr::from_triplets(l.rows(), l.rows(), &changes)));
        let spoilt = spoilt.with_mass(Mass::lumped(MassKind::Given, &mass)).unwrap();
        assert_ne!(judge("MAX-heat", &domain, &spoilt).status(), Status::Holds, "{id}");
    }
}

#[test]
fn the_maximum_principle_of_a_large_positive_definite_matrix_is_bounded() {
    // Flips make weights negative: no certificate by signs, and more equations than are inverted.
    let domain = domain("random-delaunay:n=800,seed=2 | flip:count=4,seed=2");
    let operator = built("cotan", &domain);
    let verdict = judge("MAX-global", &domain, &operator);
    assert!(domain.interior().len() > 512);
    assert!(matches!(verdict.status(), Status::Holds | Status::Fails), "{verdict:?}");
    assert_eq!(verdict.level, Level::Bounded, "{verdict:?}");
}
