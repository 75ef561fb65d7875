//! Where positive weights exist without a weighted Delaunay triangulation: the domains that are no disc with convex boundary.

use rayon::prelude::*;

use super::super::poll::{Case, Every, Search};
use super::super::world::certified::{certified, verified};
use super::super::world::lifting::{Lifting, lifting};
use super::super::world::twisted::{degrees, ratio, twisted};
use super::{ENTRY, Small};
use crate::domain::{Surface, geometry};
use crate::experiment::Finding;
use crate::laplacian::equilibrium::Net;
use crate::linalg::simplex::{Farkas, gordan, stiemke};
use crate::property::Evidence;
use crate::scalar::{Rational, Scalar};

/// A domain with both answers.
struct Answer {
    text: String,
    positive: Result<bool, String>,
    /// Whether heights exist that have every vertex above every triangle (on a torus: positive duals of some weights).
    lifted: bool,
    /// What shows both.
    evidence: Vec<Evidence>,
}

impl Answer {
    /// Both decided from scratch, with evidence that survived the recheck.
    fn of(surface: &Surface, text: String) -> Self {
        let certified = certified(surface);
        let positive = certified.as_ref().map(|c| c.decision.certificate.is_positive()).map_err(Clone::clone);
        let mut evidence: Vec<Evidence> = certified.into_iter().map(|c| c.evidence).collect();
        // The stronger refutation, where there is one: not even locally convex.
        let refutation = [Lifting::Local, Lifting::Global].into_iter().find_map(|which| lifting(surface, which)?.err());
        let lifted = refutation.is_none();
        match refutation.map(|r| verified(&r)) {
            None => {}
            Some(Ok(shown)) => evidence.push(shown),
            Some(Err(why)) => return Answer { text, positive: Err(why), lifted, evidence },
        }
        Answer { text, positive, lifted, evidence }
    }

    /// Positive weights without a weighted Delaunay triangulation.
    fn exception(&self) -> Option<Case> {
        let case = || Case { text: self.text.clone(), evidence: self.evidence.clone() };
        (self.positive == Ok(true) && !self.lifted).then(case)
    }

    fn failure(&self) -> Option<Case> {
        self.positive.as_ref().err().map(|why| Case::told(format!("{}: {why}", self.text)))
    }
}

pub(super) fn run(small: &[Small]) -> Vec<Finding> {
    let convex: Vec<Answer> = small
        .iter()
        .map(|s| Answer {
            text: s.recipe.clone(),
            positive: s.certified.as_ref().map(|c| c.decision.certificate.is_positive()).map_err(Clone::clone),
            lifted: matches!(s.global, Some(Ok(_))),
            evidence: Vec::new(),
        })
        .collect();
    let (bitten, annuli, tori) = (non_convex_discs(small), annuli(), flat_tori());
    let mut every = Every::default();
    for answer in [&convex, &bitten, &annuli, &tori].into_iter().flatten() {
        every.ask(answer.failure().or_else(|| answer.exception()));
    }
    let only = every.answer(
        ENTRY.parts[4],
        format!(
            "Have only weighted Delaunay triangulations positive weights in equilibrium? Cases: {} discs with convex boundary, {} \
             without, {} annuli, {} flat tori.",
            convex.len(),
            bitten.len(),
            annuli.len(),
            tori.len()
        ),
        "triangulations",
    );
    let search = |part: usize, question: &str, list: &[Answer], cases: &str| {
        let mut search = Search::default();
        list.iter().for_each(|answer| search.ask(answer.exception()));
        search.answer(ENTRY.parts[part], question, cases)
    };
    vec![
        only,
        search(
            5,
            "Has a disc whose boundary is not convex positive weights although it is part of no weighted Delaunay triangulation of \
             its vertices? Cases: twisted and random triangulations with one triangle at the boundary taken away, smallest first.",
            &bitten,
            "discs",
        ),
        search(
            6,
            "Has an annulus positive weights in equilibrium without a convex lift? Cases: two rings of twisted triangles without the \
             innermost one.",
            &annuli,
            "annuli",
        ),
        search(
            7,
            "Has a flat torus positive weights in equilibrium although no weights of its nine vertices have a positive orthogonal \
             dual? Cases: 3 × 3 sheared copies of a lattice triangle and its mirror image.",
            &tori,
            "tori",
        ),
    ]
}

/// Discs with a triangle at the boundary taken away, so that its inner corner is on the boundary.
fn non_convex_discs(small: &[Small]) -> Vec<Answer> {
    let twists = [ratio(1, 4), ratio(1, 8), ratio(0, 1), ratio(-1, 4)];
    let twisted = twists.iter().filter_map(|m| {
        let text = format!("triangles twisted by {:.2}°", degrees(m));
        Some((twisted(m, &ratio(2, 5), 1)?, text))
    });
    let random = small.iter().step_by(3).map(|s| (s.surface.clone(), s.recipe.clone()));
    let discs: Vec<(Surface, String)> = twisted.chain(random).collect();
    discs.par_iter().filter_map(|(surface, text)| bitten(surface, text)).collect()
}

fn bitten(surface: &Surface, text: &str) -> Option<Answer> {
    let topology = surface.topology();
    let inner = |v: &usize| !topology.boundary_vertices()[*v];
    let at_rim = |f: &[usize]| {
        f.iter().filter(|v| inner(v)).count() == 1 && {
            let rim: Vec<usize> = f.iter().copied().filter(|v| !inner(v)).collect();
            topology.edge_between(rim[0], rim[1]).is_some_and(|e| topology.is_boundary_edge(e))
        }
    };
    let gone = surface.faces().iter().position(at_rim)?;
    let mut faces = surface.faces().to_vec();
    let corners = faces.remove(gone);
    let rest = Surface::new(surface.positions().to_vec(), faces).ok()?;
    Some(Answer::of(&rest, format!("{text}, without the triangle {corners:?}")))
}

fn annuli() -> Vec<Answer> {
    let twists = [(1, 4), (1, 8), (0, 1), (-1, 4), (-1, 2)];
    let annulus = |(n, d): (i64, i64)| {
        let m = ratio(n, d);
        let whole = twisted(&m, &ratio(2, 5), 2)?;
        let mut faces = whole.faces().to_vec();
        faces.pop();
        let ring = Surface::new(whole.positions().to_vec(), faces).ok()?;
        Some(Answer::of(&ring, format!("two rings of triangles twisted by {:.2}°", degrees(&m))))
    };
    twists.into_iter().filter_map(annulus).collect()
}

type Step = [i64; 2];

/// A torus of 3 × 3 copies of a lattice cell, cut by the edges a, b and a + b; steps are counted in the lattice vectors (2, 0) and
/// (−1, 2), whose Delaunay triangulation has a = (1, 0) and b = (0, 1).
struct Torus {
    a: Step,
    b: Step,
}

impl Torus {
    fn vertex(p: Step) -> usize {
        (p[0].rem_euclid(3) + 3 * p[1].rem_euclid(3)) as usize
    }

    fn place(p: Step) -> [Rational; 2] {
        [ratio(2 * p[0] - p[1], 1), ratio(2 * p[1], 1)]
    }

    /// For each edge its start and its end, the vertex opposite to the left, and the one to the right, unfolded.
    fn edges(&self) -> Vec<[Step; 4]> {
        let plus = |p: Step, q: Step| [p[0] + q[0], p[1] + q[1]];
        let minus = |p: Step, q: Step| [p[0] - q[0], p[1] - q[1]];
        let (a, b) = (self.a, self.b);
        let c = plus(a, b);
        let cells = (0..9).map(|k| [k % 3, k / 3]);
        cells
            .flat_map(|p| {
                [
                    [p, plus(p, a), plus(p, c), minus(p, b)],
                    [p, plus(p, b), minus(p, a), plus(p, c)],
                    [p, plus(p, c), plus(p, b), plus(p, a)],
                ]
            })
            .collect()
    }

    fn has_positive_weights(&self) -> Result<bool, String> {
        let edges = self.edges();
        let ends = edges.iter().map(|e| [Self::vertex(e[0]), Self::vertex(e[1])]).collect();
        let vector = |e: &[Step; 4]| {
            let (p, q) = (Self::place(e[0]), Self::place(e[1]));
            [p[0].clone() - q[0].clone(), p[1].clone() - q[1].clone()]
        };
        let net = Net::new(&[false; 9], ends, edges.iter().map(vector).collect());
        match stiemke(&net.rows()) {
            Farkas::Solution(weights) if net.is_carried_by(&weights) => Ok(true),
            Farkas::Refutation(y) if net.is_refuted_by(&net.motion_of(&y)) => Ok(false),
            _ => Err("the simplex method is wrong".into()),
        }
    }

    /// Whether weights of the nine vertices exist whose orthogonal dual is positive on every edge: the weight of an edge is a constant
    /// plus a linear function of them, and a tenth unknown, positive, stands before the constant.
    fn has_positive_duals(&self) -> bool {
        let mut rows: Vec<Vec<Rational>> = self.edges().iter().map(Self::dual).collect();
        rows.push((0..10).map(|k| ratio(i64::from(k == 9), 1)).collect());
        matches!(gordan(&rows), Farkas::Solution(_))
    }

    /// The numerator of the weight of the lift `½ (|x|² − w)` on an edge.
    fn dual([i, j, k, l]: &[Step; 4]) -> Vec<Rational> {
        let area =
            |p: &Step, q: &Step, r: &Step| geometry::doubled_area(&Self::place(*p), &Self::place(*q), &Self::place(*r));
        let terms = [(l, area(i, j, k)), (i, -area(l, j, k)), (j, -area(i, l, k)), (k, area(j, i, l))];
        let mut row = vec![Rational::ZERO; 10];
        for (p, factor) in terms {
            let factor = factor * Rational::half();
            let [x, y] = Self::place(*p);
            let v = Self::vertex(*p);
            row[v] = row[v].clone() - factor.clone();
            row[9] = row[9].clone() + factor * (x.clone() * x + y.clone() * y);
        }
        row
    }
}

fn flat_tori() -> Vec<Answer> {
    let torus = |shear: i64| {
        let torus = Torus { a: [1, 0], b: [shear, 1] };
        let text = format!("the lattice of (2, 0) and (−1, 2) modulo 3, cut by (2, 0) and ({}, 2)", 2 * shear - 1);
        Answer {
            text,
            positive: torus.has_positive_weights(),
            lifted: torus.has_positive_duals(),
            evidence: Vec::new(),
        }
    };
    (0..4).map(torus).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_delaunay_torus_has_both_and_a_sheared_one_has_weights_alone() {
        let tori = flat_tori();
        assert_eq!(tori.iter().map(|t| t.positive.clone()).collect::<Vec<_>>(), vec![Ok(true); 4]);
        assert_eq!(tori.iter().map(|t| t.lifted).collect::<Vec<_>>(), [true, false, false, false]);
    }

    #[test]
    fn the_duals_of_equal_weights_on_the_delaunay_torus_are_the_cotangents() {
        // Triangle (0, 0), (2, 0), (1, 2): cotangents ½ at the base and ¾ at the top; numerators times [ijk] [jil] = 16.
        let torus = Torus { a: [1, 0], b: [0, 1] };
        let found: Vec<f64> = torus.edges()[..3].iter().map(|e| Torus::dual(e)[9].approximate() / 16.0).collect();
        assert_eq!(found, [0.75, 0.5, 0.5]);
    }
}
