//! Linear precision without symmetry: a dual face for each vertex, orthogonal to its edges, and the one-parameter family
//! between Wachspress, mean value and cotangent weights.

use std::cmp::Ordering;

use super::poll::{Case, Every, Search};
use super::world::excerpt::on_triangulation;
use super::world::stars::{Place, Star, dot, is_origin, power, turn};
use super::world::triangulations::{Triangulation, describe_world, world};
use super::{Experiment, Finding, Setting};
use crate::generate::Stream;
use crate::laplacian::{cotan, three_point, wachspress};
use crate::linalg::Dense;
use crate::property::Statement;
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "dual-faces",
    name: "Dual faces and linear precision",
    statement: "a closed polygon with its edges orthogonal to the edges at a vertex gives that vertex linear-precise weights, and \
                every linear-precise row is of this form; mean value: edges tangent to a circle; c_j = r_j^p: the family",
    sources: &["wardetzky2007", "langer2006", "floater-hormann-kos2006", "floater2003"],
    parts: &[
        "dual-face-is-linear",
        "linear-is-dual-face",
        "need-not-be-symmetric",
        "mean-value-is-tangent",
        "family-is-linear",
        "members-are-dual-faces",
    ],
    run,
};

/// The even exponents of the family whose matrices are built.
const EVEN: [i32; 5] = [-4, -2, 0, 2, 4];

fn run(setting: &Setting) -> Vec<Finding> {
    let largest = setting.pick(5, 6);
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let (mut linear, mut dual, mut symmetric) = (Every::default(), Every::default(), Search::default());
    let (mut tangent, mut family, mut members) = (Every::default(), Every::default(), Every::default());
    for t in world(largest) {
        let boundary = t.boundary();
        let inside: Vec<usize> = (0..boundary.len()).filter(|&i| !boundary[i]).collect();
        if inside.is_empty() {
            continue;
        }
        let rows = rows(&t);
        for &i in &inside {
            let Some((star, ring)) = Star::of(&t, i) else { continue };
            linear.ask(open_polygon(&star, &random_numbers(star.spokes.len(), &mut stream)));
            for (name, matrix, exponent) in &rows {
                let weights: Vec<Rational> = ring.iter().map(|&j| -matrix.at(i, j).clone()).collect();
                dual.ask(no_dual_face(&star, &weights).map(|case| named(name, case)));
                if let Some(e) = exponent {
                    family.ask(not_linear(&star, &weights).map(|case| named(name, case)));
                    members.ask(no_member(&star, &weights, &star.numbers(*e)).map(|case| named(name, case)));
                }
            }
            if let Some((_, matrix, _)) = rows.first() {
                symmetric.ask(asymmetry(&t, matrix, &inside, i));
            }
        }
    }
    for _ in 0..setting.pick(300, 2000) {
        let q = 1 + stream.below(3) as i64;
        let Some(star) = Star::random(q, &mut stream) else { continue };
        linear.ask(open_polygon(&star, &random_numbers(star.spokes.len(), &mut stream)));
        tangent.ask(not_tangent(&star, q));
        for m in -4..=4 {
            let c = star.numbers(m);
            let weights = star.weights(&c);
            let name = format!("p = {m}/{q}");
            family.ask(not_linear(&star, &weights).map(|case| named(&name, case)));
            members.ask(no_member(&star, &weights, &c).map(|case| named(&name, case)));
        }
    }
    let stars = format!("stars of {}; and random stars whose spokes have rational lengths", describe_world(largest));
    let question = |text: &str| format!("{text} Cases: {stars}.");
    vec![
        linear.answer(
            ENTRY.parts[0],
            question("Does the polygon with edges on the lines x·v_i = c_i, random c_i, give weights with Σ ω_i v_i = 0?"),
            "stars",
        ),
        dual.answer(
            ENTRY.parts[1],
            question(
                "Are the rows of Wachspress, cotangent and family weights the edges of a closed polygon orthogonal to the \
                 spokes, and does that polygon give the weights back?",
            ),
            "rows at interior vertices",
        ),
        symmetric.answer(
            ENTRY.parts[2],
            question("Are there interior vertices i, j with ω_ij ≠ ω_ji among Wachspress weights?"),
            "interior vertices",
        ),
        tangent.answer(
            ENTRY.parts[3],
            question(
                "Is the dual face of c_i = r_i tangent to the unit circle with each edge, does it touch in the foot of the spoke, and \
                 is ω_i = (tan(γ/2) + tan(δ/2))/r_i?",
            ),
            "random stars",
        ),
        family.answer(
            ENTRY.parts[4],
            question("Is Σ ω_i v_i = 0 for c_i = r_i^p, p even from −4 to 4, and p = m/q, |m| ≤ 4, q ≤ 3 on random stars?"),
            "stars and exponents",
        ),
        members.answer(
            ENTRY.parts[5],
            question("Is the dual face of c_i = r_i^p closed, orthogonal to the spokes, with ω_i the ratio of the lengths?"),
            "stars and exponents",
        ),
    ]
}

/// Exact matrices by name, with half the exponent of the family where they are a member of it.
fn rows(t: &Triangulation) -> Vec<(String, Dense<Rational>, Option<i64>)> {
    let surface = t.surface();
    let mut rows = Vec::new();
    rows.extend(wachspress::stiffness_in_plane(&surface).map(|m| ("wachspress".into(), Dense::from_csr(&m), None)));
    rows.extend(cotan::stiffness_in_plane(&surface).map(|m| ("cotan".into(), Dense::from_csr(&m), None)));
    for p in EVEN {
        let matrix = three_point::stiffness_in_plane(&surface, p);
        rows.extend(matrix.map(|m| (format!("p = {p}"), Dense::from_csr(&m), Some(i64::from(p / 2)))));
    }
    rows
}

fn random_numbers(n: usize, stream: &mut Stream) -> Vec<Rational> {
    (0..n).map(|_| Rational::from_parts((stream.below(65) as i64 - 32).into(), 8u8.into())).collect()
}

fn named(name: &str, case: Case) -> Case {
    Case { text: format!("{name}: {}", case.text), ..case }
}

/// The dual face by its corners: its edges, as ratios, must be the weights of the formula, and these linear-precise.
fn open_polygon(star: &Star, c: &[Rational]) -> Option<Case> {
    no_member(star, &star.weights(c), c).or_else(|| not_linear(star, &star.weights(c)))
}

fn not_linear(star: &Star, weights: &[Rational]) -> Option<Case> {
    let [x, y] = star.moment(weights);
    let zero = is_origin(&[x.clone(), y.clone()]);
    (!zero).then(|| Case::told(format!("Σ ω v = ({x}, {y}) at {}", star.describe())))
}

/// The polygon whose edges are `ω_i J v_i`, from any first corner, must close; the numbers `c_i = d_i·v_i` of a closed one must give
/// the weights back.
fn no_dual_face(star: &Star, weights: &[Rational]) -> Option<Case> {
    let mut polygon: Vec<Place> = Vec::with_capacity(weights.len());
    let mut corner: Place = [Rational::ONE, Rational::from(2)];
    let first = corner.clone();
    for (v, w) in star.spokes.iter().zip(weights) {
        corner = [
            (corner[0].clone() - w.clone() * v[1].clone()).reduced(),
            (corner[1].clone() + w.clone() * v[0].clone()).reduced(),
        ];
        polygon.push(corner.clone());
    }
    if corner != first {
        return Some(Case::told(format!("the polygon of the dual edges does not close at {}", star.describe())));
    }
    let c: Vec<Rational> = polygon.iter().zip(&star.spokes).map(|(d, v)| dot(d, v)).collect();
    let back = star.weights(&c) == weights && star.dual_face(&c) == polygon;
    (!back).then(|| Case::told(format!("the dual face gives other weights at {}", star.describe())))
}

/// The dual face of the numbers must have the weights as the ratios of its edges to the spokes.
fn no_member(star: &Star, weights: &[Rational], c: &[Rational]) -> Option<Case> {
    let found = star.ratios(&star.dual_face(c));
    (found.as_deref() != Some(weights)).then(|| Case::told(format!("another dual face at {}", star.describe())))
}

/// Mean value weights where lengths are rational: `r = root^q`.
fn not_tangent(star: &Star, q: i64) -> Option<Case> {
    let r: Vec<Rational> = star.roots.iter().map(|root| power(root, q)).collect();
    let (weights, corners) = (star.weights(&r), star.dual_face(&r));
    let n = r.len();
    // tan(θ/2) = sin θ/(1 + cos θ), times r r' above and below.
    let tangent = |k: usize| {
        let (v, w, product) = (&star.spokes[k], &star.spokes[(k + 1) % n], r[k].clone() * r[(k + 1) % n].clone());
        turn(v, w) / (product + dot(v, w))
    };
    let wrong = (0..n).find(|&i| {
        let formula = (tangent((i + n - 1) % n) + tangent(i)) / r[i].clone();
        // The foot of the spoke's unit vector lies on the edge: its distance to either end along the edge has the sign that
        // says "between", and the edge's line has distance c/r = 1 from the origin.
        let foot = star.spokes[i].clone().map(|x| x / r[i].clone());
        let along = |d: &Place| turn(&foot, d).cmp_zero();
        let between = along(&corners[i]) == Ordering::Greater && along(&corners[(i + n - 1) % n]) == Ordering::Less;
        let unit = dot(&foot, &foot) == Rational::ONE && dot(&corners[i], &foot) == Rational::ONE;
        formula != weights[i] || !between || !unit
    });
    wrong.map(|i| Case::told(format!("spoke {i} of {}", star.describe())))
}

fn asymmetry(t: &Triangulation, matrix: &Dense<Rational>, inside: &[usize], i: usize) -> Option<Case> {
    let j = inside.iter().copied().find(|&j| j > i && matrix.at(i, j) != matrix.at(j, i))?;
    let text = format!(
        "ω_{i}{j} = {} and ω_{j}{i} = {} on {}",
        -matrix.at(i, j).clone(),
        -matrix.at(j, i).clone(),
        t.describe()
    );
    let statement = Statement::Asymmetry { i, j, threshold: 0.0 };
    Some(Case::shown(text, on_triangulation(statement, t, matrix, &[i, j])))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn star() -> Star {
        let mut star = Star { spokes: Vec::new(), roots: Vec::new() };
        for (k, root) in [(-24, 2), (-4, 3), (8, 1), (20, 2)] {
            star.push(&Rational::from_parts(i64::into(k), 16u8.into()), &Rational::from(root), 1);
        }
        star
    }

    #[test]
    fn each_question_is_answered_no_where_a_weight_is_changed() {
        let (star, one) = (star(), Rational::ONE);
        assert!(star.is_proper());
        let c = star.numbers(1);
        let good = star.weights(&c);
        let mut spoilt = good.clone();
        spoilt[1] = spoilt[1].clone() + one.clone();
        assert!(not_linear(&star, &good).is_none() && not_linear(&star, &spoilt).is_some());
        assert!(no_dual_face(&star, &good).is_none() && no_dual_face(&star, &spoilt).is_some());
        assert!(no_member(&star, &good, &c).is_none() && no_member(&star, &spoilt, &c).is_some());
        assert!(not_tangent(&star, 1).is_none());
        // With the lengths of another exponent the lines are no tangents.
        assert!(not_tangent(&star, 2).is_some());
    }

    #[test]
    fn any_weights_with_a_vanishing_moment_are_a_dual_face_without_being_of_the_family() {
        let star = star();
        let (a, b) = (star.weights(&star.numbers(0)), star.weights(&star.numbers(3)));
        let mixed: Vec<Rational> =
            a.iter().zip(&b).map(|(x, y)| (x.clone() * Rational::from(7) - y.clone()).reduced()).collect();
        assert!(no_dual_face(&star, &mixed).is_none());
    }
}
