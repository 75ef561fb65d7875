//! Statements about what weights a planar triangulation can have: lifts, equilibria, motions. In rational arithmetic.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use super::excerpt::Material;
use super::{Answer, Rechecked, Refusal};
use crate::property::evidence::Fraction;
use crate::scalar::{Rational, Scalar};

type Vector = [Rational; 2];

fn zero() -> Vector {
    [Rational::ZERO, Rational::ZERO]
}

fn minus(a: &Vector, b: &Vector) -> Vector {
    [a[0].clone() - b[0].clone(), a[1].clone() - b[1].clone()]
}

fn dot(a: &Vector, b: &Vector) -> Rational {
    a[0].clone() * b[0].clone() + a[1].clone() * b[1].clone()
}

fn cross(a: &Vector, b: &Vector) -> Rational {
    a[0].clone() * b[1].clone() - a[1].clone() * b[0].clone()
}

fn differ(a: &Rational, b: &Rational) -> bool {
    (a.clone() - b.clone()).cmp_zero() != Ordering::Equal
}

fn read(what: &'static str, index: usize, number: &Fraction) -> Result<Rational, Refusal> {
    number.value().ok_or(Refusal::Malformed { what, index, problem: "is no fraction" })
}

/// A face beside an edge: which, its corner opposite, and whether it runs along the edge from the smaller end.
type Side = (usize, usize, bool);

/// The triangulation of an excerpt.
struct Mesh {
    at: BTreeMap<usize, Vector>,
    faces: BTreeMap<usize, [usize; 3]>,
    edges: BTreeMap<[usize; 2], Vec<Side>>,
    boundary: BTreeSet<usize>,
    clockwise: bool,
}

impl Mesh {
    /// Refuses what is not a planar mesh of triangles that all turn the same way, at most two at an edge.
    fn read(m: &Material) -> Result<Self, Refusal> {
        let corners: BTreeSet<usize> = m.faces.iter().flat_map(|(_, f)| f.iter().copied()).collect();
        let points = corners.iter().map(|&v| Ok((v, m.position(v)?))).collect::<Result<Vec<_>, Refusal>>()?;
        let constant = |axis: usize| points.windows(2).all(|w| w[0].1[axis] == w[1].1[axis]);
        let Some(normal) = [2, 0, 1].into_iter().find(|&axis| constant(axis)) else {
            return Err(Refusal::untrue("the mesh lies in a coordinate plane", "it does not"));
        };
        // Positions were read as finite numbers.
        let exact = |x: f64| Rational::exactly(x).unwrap_or_else(Rational::zero);
        let axes = [(normal + 1) % 3, (normal + 2) % 3];
        let at = points.into_iter().map(|(v, p)| (v, axes.map(|axis| exact(p[axis])))).collect();
        let mut mesh =
            Mesh { at, faces: BTreeMap::new(), edges: BTreeMap::new(), boundary: BTreeSet::new(), clockwise: false };
        let mut turns = BTreeSet::new();
        for (place, (index, face)) in m.faces.iter().enumerate() {
            let malformed = |problem| Refusal::Malformed { what: "face", index: *index, problem };
            if place != *index {
                return Err(malformed("is out of order: the whole mesh is needed, faces numbered from 0"));
            }
            let &[a, b, c] = face.as_slice() else { return Err(malformed("is no triangle")) };
            turns.insert(mesh.area([a, b, c]).cmp_zero());
            mesh.faces.insert(*index, [a, b, c]);
            for [p, q, apex] in [[a, b, c], [b, c, a], [c, a, b]] {
                let sides = mesh.edges.entry([p.min(q), p.max(q)]).or_default();
                sides.push((*index, apex, p < q));
                if sides.len() > 2 || (sides.len() == 2 && sides[0].2 == sides[1].2) {
                    return Err(malformed("lies at an edge as a third one, or turned against the one beside"));
                }
            }
        }
        if turns.len() != 1 || turns.contains(&Ordering::Equal) {
            return Err(Refusal::untrue("all triangles turn the same way", format!("{turns:?}")));
        }
        mesh.clockwise = turns.contains(&Ordering::Less);
        let rims = mesh.edges.iter().filter(|(_, sides)| sides.len() == 1).flat_map(|(ends, _)| *ends);
        mesh.boundary = rims.collect();
        Ok(mesh)
    }

    fn point(&self, v: usize) -> &Vector {
        // `read` refused a face with a corner that has no position.
        &self.at[&v]
    }

    fn area(&self, [a, b, c]: [usize; 3]) -> Rational {
        cross(&minus(self.point(b), self.point(a)), &minus(self.point(c), self.point(a)))
    }

    /// The vector from the second end of an edge to the first.
    fn vector(&self, [i, j]: [usize; 2]) -> Vector {
        minus(self.point(i), self.point(j))
    }

    fn interior_edges(&self) -> BTreeSet<[usize; 2]> {
        self.edges.iter().filter(|(_, sides)| sides.len() == 2).map(|(ends, _)| *ends).collect()
    }

    fn constrained_edges(&self) -> BTreeSet<[usize; 2]> {
        self.edges.keys().filter(|ends| ends.iter().any(|v| !self.boundary.contains(v))).copied().collect()
    }

    /// Numbers on exactly these edges, each once.
    fn on_edges(
        &self,
        what: &'static str,
        needed: &BTreeSet<[usize; 2]>,
        list: &[([usize; 2], Fraction)],
    ) -> Result<BTreeMap<[usize; 2], Rational>, Refusal> {
        let mut found = BTreeMap::new();
        for (index, (ends, number)) in list.iter().enumerate() {
            let malformed = |problem| Refusal::Malformed { what, index, problem };
            if !needed.contains(ends) {
                return Err(malformed("stands on no edge of which the statement speaks"));
            }
            if found.insert(*ends, read(what, index, number)?).is_some() {
                return Err(malformed("is given twice"));
            }
        }
        match needed.iter().find(|ends| !found.contains_key(*ends)) {
            Some(ends) => Err(Refusal::Missing { what: "the number of the edge from vertex", index: ends[0] }),
            None => Ok(found),
        }
    }

    /// Refuses weights that are not positive, or not in equilibrium at an interior vertex.
    fn check_equilibrium(&self, weights: &BTreeMap<[usize; 2], Rational>) -> Result<(), Refusal> {
        let mut forces: BTreeMap<usize, Vector> = BTreeMap::new();
        for (&[i, j], weight) in weights {
            if weight.cmp_zero() != Ordering::Greater {
                return Err(Refusal::untrue(format!("the weight of ({i}, {j}) is positive"), approximate(weight)));
            }
            let pull = self.vector([i, j]).map(|x| x * weight.clone());
            for (v, sign) in [(i, Rational::ONE), (j, -Rational::ONE)] {
                let force = forces.entry(v).or_insert_with(zero);
                *force = std::array::from_fn(|a| force[a].clone() + sign.clone() * pull[a].clone());
            }
        }
        let unbalanced =
            |v: &usize, f: &Vector| !self.boundary.contains(v) && f.iter().any(|x| x.cmp_zero() != Ordering::Equal);
        match forces.iter().find(|(v, f)| unbalanced(v, f)) {
            Some((v, f)) => Err(Refusal::untrue(
                format!("Σ_j ω_ij (x_i − x_j) = 0 at vertex {v}"),
                format!("({}, {})", approximate(&f[0]), approximate(&f[1])),
            )),
            None => Ok(()),
        }
    }

    /// The gradient of the linear function with these values at the corners of a face.
    fn gradient(&self, face: usize, h: &BTreeMap<usize, Rational>) -> Vector {
        let [a, b, c] = self.faces[&face];
        let (u, v) = (minus(self.point(b), self.point(a)), minus(self.point(c), self.point(a)));
        let (rise, climb) = (h[&b].clone() - h[&a].clone(), h[&c].clone() - h[&a].clone());
        let area = cross(&u, &v);
        let component = |x: Rational| x / area.clone();
        [
            component(rise.clone() * v[1].clone() - climb.clone() * u[1].clone()),
            component(climb * u[0].clone() - rise * v[0].clone()),
        ]
    }
}

fn approximate(x: &Rational) -> String {
    format!("{:e}", x.approximate())
}

/// A lift: strictly convex across interior edges; its weights are the ones stated, and in equilibrium.
pub(super) fn lift(m: &Material, heights: &[(usize, Fraction)], weights: &[([usize; 2], Fraction)]) -> Answer {
    let mesh = Mesh::read(m)?;
    let mut h = BTreeMap::new();
    for (index, (v, number)) in heights.iter().enumerate() {
        if h.insert(*v, read("height", index, number)?).is_some() {
            return Err(Refusal::Malformed { what: "height", index, problem: "is given twice" });
        }
    }
    if let Some(&index) = mesh.at.keys().find(|v| !h.contains_key(v)) {
        return Err(Refusal::Missing { what: "the height of vertex", index });
    }
    let stated = mesh.on_edges("weight", &mesh.interior_edges(), weights)?;
    for (&[i, j], weight) in &stated {
        let gradient = |forward: bool| {
            let side = mesh.edges[&[i, j]].iter().find(|s| s.2 == forward);
            side.map_or_else(zero, |s| mesh.gradient(s.0, &h))
        };
        let e = mesh.vector([j, i]);
        // The face that runs along the edge lies to its left; (b, −a) points to the right of (a, b).
        let jump = dot(&minus(&gradient(false), &gradient(true)), &[e[1].clone(), -e[0].clone()]);
        let found = if mesh.clockwise { -jump } else { jump } / dot(&e, &e);
        if differ(&found, weight) {
            return Err(Refusal::untrue(
                format!("the weight of ({i}, {j}) is {}", approximate(weight)),
                approximate(&found),
            ));
        }
    }
    mesh.check_equilibrium(&stated)?;
    Ok(Rechecked::Exact)
}

/// Positive weights in equilibrium.
pub(super) fn weights(m: &Material, weights: &[([usize; 2], Fraction)]) -> Answer {
    let mesh = Mesh::read(m)?;
    let stated = mesh.on_edges("weight", &mesh.constrained_edges(), weights)?;
    mesh.check_equilibrium(&stated)?;
    Ok(Rechecked::Exact)
}

/// A motion that shortens no edge with an interior end, and lengthens one.
pub(super) fn motion(m: &Material, motion: &[(usize, [Fraction; 2])], rates: &[([usize; 2], Fraction)]) -> Answer {
    let mesh = Mesh::read(m)?;
    let mut y = BTreeMap::new();
    for (index, (v, [a, b])) in motion.iter().enumerate() {
        let malformed = |problem| Refusal::Malformed { what: "motion", index, problem };
        if mesh.boundary.contains(v) || !mesh.at.contains_key(v) {
            return Err(malformed("moves a vertex that is not an interior one"));
        }
        if y.insert(*v, [read("motion", index, a)?, read("motion", index, b)?]).is_some() {
            return Err(malformed("is given twice"));
        }
    }
    let still = zero();
    let stated = mesh.on_edges("rate", &mesh.constrained_edges(), rates)?;
    for (&[i, j], rate) in &stated {
        let at = |v: usize| y.get(&v).unwrap_or(&still);
        let found = dot(&minus(at(i), at(j)), &mesh.vector([i, j]));
        if differ(&found, rate) {
            return Err(Refusal::untrue(
                format!("the rate of ({i}, {j}) is {}", approximate(rate)),
                approximate(&found),
            ));
        }
        if rate.cmp_zero() == Ordering::Less {
            return Err(Refusal::untrue(format!("edge ({i}, {j}) is not shortened"), approximate(rate)));
        }
    }
    if stated.values().all(|rate| rate.cmp_zero() == Ordering::Equal) {
        return Err(Refusal::untrue("some edge is lengthened", "none is"));
    }
    Ok(Rechecked::Exact)
}

/// Conditions on heights that add up to a contradiction.
pub(super) fn no_lift(m: &Material, beside: bool, multipliers: &[(usize, usize, Fraction)]) -> Answer {
    let mesh = Mesh::read(m)?;
    let mut sum: BTreeMap<usize, Rational> = BTreeMap::new();
    let (mut seen, mut positive) = (BTreeSet::new(), false);
    for (index, (face, v, number)) in multipliers.iter().enumerate() {
        let malformed = |problem| Refusal::Malformed { what: "multiplier", index, problem };
        let Some(&[a, b, c]) = mesh.faces.get(face) else { return Err(malformed("names a face that is not there")) };
        if [a, b, c].contains(v) || !mesh.at.contains_key(v) {
            return Err(malformed("names a vertex that is not one off its face"));
        }
        let shares = |[p, q]: [usize; 2]| mesh.edges[&[p.min(q), p.max(q)]].iter().any(|s| s.1 == *v);
        if beside && ![[a, b], [b, c], [c, a]].into_iter().any(shares) {
            return Err(malformed("names a vertex that is not opposite in a face beside"));
        }
        if !seen.insert((face, v)) {
            return Err(malformed("is given twice"));
        }
        let factor = read("multiplier", index, number)?;
        if factor.cmp_zero() == Ordering::Less {
            return Err(malformed("is negative"));
        }
        positive |= factor.cmp_zero() == Ordering::Greater;
        let factor = if mesh.clockwise { -factor } else { factor };
        let terms = [(*v, [a, b, c], false), (a, [*v, b, c], true), (b, [a, *v, c], true), (c, [a, b, *v], true)];
        for (vertex, triangle, subtracted) in terms {
            let term = factor.clone() * mesh.area(triangle);
            let total = sum.entry(vertex).or_insert(Rational::ZERO);
            *total = total.clone() + if subtracted { -term } else { term };
        }
    }
    if !positive {
        return Err(Refusal::untrue("some multiplier is positive", "none is"));
    }
    match sum.iter().find(|(_, s)| s.cmp_zero() != Ordering::Equal) {
        Some((v, s)) => Err(Refusal::untrue(format!("the height of {v} cancels"), approximate(s))),
        None => Ok(Rechecked::Exact),
    }
}
