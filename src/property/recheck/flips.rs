//! Rippa's theorem in the plane as a certificate: flips to Delaunay, each a term `κ w wᵀ`.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use dashu_int::IBig;

use super::alone::{check_exact, fraction, whole};
use super::planar::{Planar, Upper, add, difference, from_smallest};
use super::{Answer, Rechecked, Refusal};
use crate::property::evidence::{Excerpt, Flip};
use crate::scalar::{Rational, Scalar, sum};

/// Every flip is legal, strictly convex and has κ > 0; the end is Delaunay; the terms add up to `L_T − L_D`; the energies fall
/// as stated.
pub(super) fn decide(
    excerpt: &Excerpt,
    flips: &[Flip],
    end: &[[usize; 3]],
    values: &[f64],
    energies: &[f64],
) -> Answer {
    let mut mesh = Planar::read(excerpt)?;
    mesh.check_fills_the_hull()?;
    let u = read_values(values, mesh.points.len())?;
    if energies.len() != flips.len() + 1 {
        return Err(Refusal::untrue(format!("there are {} energies", flips.len() + 1), energies.len().to_string()));
    }
    let before = mesh.stiffness();
    let mut energy = dirichlet(&before, &u);
    check_energy(0, energies[0], &energy)?;
    let mut terms = Upper::new();
    for (k, flip) in flips.iter().enumerate() {
        let (kappa, w) = apply(&mut mesh, k, flip)?;
        check_exact(&format!("κ of flip {k}"), &flip.kappa, &kappa)?;
        let along = sum((0..4).map(|m| Rational::from(w[m].clone()) * u[flip.quad[m]].clone()));
        energy -= Rational::half() * kappa.clone() * along.clone() * along;
        check_energy(k + 1, energies[k + 1], &energy)?;
        add_term(&mut terms, flip.quad, &kappa, &w);
    }
    let stated: BTreeSet<[usize; 3]> = end.iter().map(|&t| from_smallest(t)).collect();
    if stated != mesh.faces || end.len() != stated.len() {
        return Err(Refusal::untrue("the flips end at the faces written down", "they end at others"));
    }
    mesh.check_delaunay()?;
    for ((i, j), value) in mesh.stiffness() {
        add(&mut terms, i, j, value);
    }
    match difference(&before, &terms) {
        Some((i, j)) => Err(Refusal::untrue("L_T − L_D = Σ κ w wᵀ", format!("they differ at the entry ({i}, {j})"))),
        None => Ok(Rechecked::Exact),
    }
}

/// The values of a function as whole numbers, one for each vertex.
pub(super) fn read_values(values: &[f64], vertices: usize) -> Result<Vec<Rational>, Refusal> {
    if values.len() != vertices {
        return Err(Refusal::untrue(format!("there are {vertices} values"), values.len().to_string()));
    }
    values.iter().enumerate().map(|(k, &x)| Ok(Rational::from(whole("value", k, x)?))).collect()
}

/// Makes a flip; κ and w.
fn apply(mesh: &mut Planar, k: usize, flip: &Flip) -> Result<(Rational, [IBig; 4]), Refusal> {
    let [a, b, c, d] = flip.quad;
    for old in [[a, b, c], [a, c, d]] {
        if !mesh.faces.remove(&from_smallest(old)) {
            return Err(Refusal::Malformed {
                what: "flip",
                index: k,
                problem: "is not of two triangles that there are",
            });
        }
    }
    let [bcd, acd, abd, abc] = [mesh.area(b, c, d), mesh.area(a, c, d), mesh.area(a, b, d), mesh.area(a, b, c)];
    if [&bcd, &acd, &abd, &abc].iter().any(|area| **area <= IBig::ZERO) {
        return Err(Refusal::Malformed {
            what: "flip",
            index: k,
            problem: "is not of a strictly convex quadrilateral",
        });
    }
    let new = [[a, b, d], [b, c, d]];
    let doubled = |f: &[usize; 3]| f.contains(&b) && f.contains(&d);
    if mesh.faces.iter().any(doubled) || new.iter().any(|&t| !mesh.faces.insert(from_smallest(t))) {
        return Err(Refusal::Malformed { what: "flip", index: k, problem: "puts in an edge that there is" });
    }
    let kappa = fraction(mesh.incircle(a, b, c, d), IBig::from(2) * &abc * &acd * &abd * &bcd);
    if kappa.cmp_zero() != Ordering::Greater {
        return Err(Refusal::untrue(format!("κ of flip {k} is positive"), kappa.to_string()));
    }
    Ok((kappa, [bcd, -acd, abd, -abc]))
}

fn add_term(l: &mut Upper, quad: [usize; 4], kappa: &Rational, w: &[IBig; 4]) {
    for m in 0..4 {
        for n in 0..4 {
            if quad[m] <= quad[n] {
                add(l, quad[m], quad[n], kappa.clone() * Rational::from(&w[m] * &w[n]));
            }
        }
    }
}

/// `½ uᵀLu`.
pub(super) fn dirichlet(l: &Upper, u: &[Rational]) -> Rational {
    let term = |(&(i, j), value): (&(usize, usize), &Rational)| {
        let factor = if i == j { Rational::half() } else { Rational::ONE };
        factor * value.clone() * u[i].clone() * u[j].clone()
    };
    l.iter().map(term).fold(Rational::zero(), |total, t| (total + t).reduced())
}

fn check_energy(k: usize, stated: f64, found: &Rational) -> Result<(), Refusal> {
    let found = found.clone().reduced().approximate();
    if stated == found {
        return Ok(());
    }
    Err(Refusal::untrue(format!("the energy after {k} flips is {stated}"), found.to_string()))
}
