//! Tutte's theorem on triangulated discs, exactly, and a smallest counterexample for each hypothesis left out.
//!
//! The vertices of the boundary are put at the corners of a convex polygon, the others where `Σ_j ω_ij (x_j − x_i) = 0`. With
//! positive weights every inner vertex is a convex combination of its neighbours; the drawing is an embedding if the polygon
//! is strictly convex, or if no edge inside joins two vertices of one of its sides \[tutte1963\] \[floater2003b\].

use std::cmp::Ordering;

use super::poll::{Case, Every, Search};
use super::world::discs::{Disc, Drawn, Turning, discs, polygons, surfaces};
use super::world::excerpt::on_graph;
use super::world::graphs::{component_count, graphs, laplacian, with_weights};
use super::world::harmonic::global;
use super::world::triangulations::{Point, doubled_area, sweep};
use super::{Experiment, Finding, Setting};
use crate::domain::{Graph, geometry};
use crate::generate::Stream;
use crate::property::Statement;
use crate::property::evidence::{Fault, Hypothesis};
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "tutte-embedding",
    name: "Tutte's embedding of triangulated discs",
    statement: "with positive weights and the boundary at a strictly convex polygon, or a convex one without an inner edge between \
                vertices of one side, the equilibrium drawing of a triangulated disc is unique and an embedding",
    sources: &["wardetzky-primer", "wardetzky2007", "tutte1963", "floater2003b"],
    parts: &[
        "convex-boundary",
        "strictly-convex-boundary",
        "convex-boundary-without-chord-on-a-side",
        "random-discs",
        "needs-a-convex-boundary",
        "needs-positive-weights",
        "needs-a-disc",
        "needs-3-connection",
        "unique",
        "not-unique-with-a-negative-weight",
        "linearly-precise",
    ],
    run,
};

#[derive(Default)]
struct Polls {
    convex: Every,
    strict: Every,
    no_chord: Every,
    random: Every,
    reflex: Search,
    negative: Search,
    surface: Search,
    loose: Search,
    unique: Every,
    singular: Search,
    precise: Every,
}

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let mut polls = Polls::default();
    let (largest, side) = (5, setting.pick(2, 3) as i64);
    for n in 4..=largest {
        let discs = discs(n);
        for width in 1..=side {
            for height in 1..=width {
                for disc in &discs {
                    for (polygon, turning) in polygons(disc.rim, [width, height]) {
                        polls.draw_small(disc, &polygon, turning, &mut stream);
                    }
                }
            }
        }
    }
    (4..=6).flat_map(surfaces).for_each(|surface| polls.draw_surface(&surface));
    polls.draw_graphs();
    for _ in 0..setting.pick(6, 60) {
        polls.draw_random(8 + stream.below(setting.pick(10, 30)), &mut stream);
    }
    polls.answer(largest, side)
}

impl Polls {
    /// One disc with unit weights and with random ones, positive and of both signs.
    fn draw_small(&mut self, disc: &Disc, polygon: &[Point], turning: Turning, stream: &mut Stream) {
        let count = disc.inner_edges().count();
        let unit = vec![1.0; count];
        let random: Vec<f64> = (0..count).map(|_| (1 + stream.below(4)) as f64).collect();
        for weights in [&unit, &random] {
            self.draw_positive(disc, polygon, turning, weights);
        }
        if turning == Turning::Strict {
            for k in 0..count {
                for (own, others) in [(-1.0, 1.0), (-2.0, 1.0)] {
                    let weights: Vec<f64> = (0..count).map(|m| if m == k { own } else { others }).collect();
                    self.draw_negative(disc, polygon, &weights);
                }
            }
        }
    }

    fn draw_positive(&mut self, disc: &Disc, polygon: &[Point], turning: Turning, weights: &[f64]) {
        let Some(at) = disc.draw(polygon, weights) else {
            self.unique.ask(Some(told(disc, polygon, weights, "the drawing is not unique")));
            return;
        };
        self.unique.ask(None);
        self.precise.ask(unbalanced(disc, polygon, weights, &at));
        let folded = |missing| shown(disc, polygon, weights, &at, missing);
        match turning {
            Turning::Strict => {
                // No hypothesis is missing, so an exception has words for evidence.
                let exception = disc.folded(&at).map(|f| told(disc, polygon, weights, &format!("face {f} is folded")));
                self.convex.ask(exception.clone());
                self.strict.ask(exception);
            }
            Turning::Straight => {
                let exception = folded(Hypothesis::NoChordOnASide);
                if !has_chord_on_a_side(disc, polygon) {
                    self.no_chord.ask(exception.clone());
                }
                self.convex.ask(exception);
            }
            Turning::Reflex if disc.chords().next().is_none() => self.reflex.ask(folded(Hypothesis::ConvexBoundary)),
            Turning::Reflex => {}
        }
    }

    fn draw_negative(&mut self, disc: &Disc, polygon: &[Point], weights: &[f64]) {
        match disc.draw(polygon, weights) {
            Some(at) => {
                self.singular.ask(None);
                self.negative.ask(shown(disc, polygon, weights, &at, Hypothesis::PositiveWeights));
            }
            None => self.singular.ask(singular(disc, weights)),
        }
    }

    /// A closed surface without a face: a disc with unit weights; another one with the weight 2 on two of the edges inside (with
    /// fewer, vertices coincide).
    fn draw_surface(&mut self, surface: &Disc) {
        let polygon = [[0, 0], [1, 0], [0, 1]];
        let count = surface.inner_edges().count();
        let euler = surface.vertices as i64 - surface.edges.len() as i64 + surface.faces.len() as i64;
        if euler == 1 {
            let weights = vec![1.0; count];
            let Some(at) = surface.draw(&polygon, &weights) else { return };
            let exception = surface.folded(&at);
            self.strict.ask(exception.map(|f| told(surface, &polygon, &weights, &format!("face {f} is folded"))));
            return self.surface.ask(None);
        }
        for [first, second] in (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j])) {
            let weights: Vec<f64> = (0..count).map(|k| if k == first || k == second { 2.0 } else { 1.0 }).collect();
            let Some(at) = surface.draw(&polygon, &weights) else { continue };
            let area = |f: &[usize; 3]| geometry::doubled_area(&at[f[0]], &at[f[1]], &at[f[2]]).magnitude();
            let total = surface.faces.iter().map(area).fold(Rational::zero(), |sum, a| (sum + a).reduced());
            let apart = surface.edges.iter().all(|&[a, b]| at[a] != at[b]);
            self.surface.ask((apart && total > Rational::ONE).then(|| {
                let fault = Fault::Overlap { faces: total.to_string(), polygon: Rational::ONE.to_string() };
                let what = format!("twice the area of the faces is {total}, of the polygon 1");
                let text = in_words(surface, &polygon, &weights, &what);
                Case::shown(text, surface.witness(&at, &weights, Hypothesis::Disc, fault))
            }));
        }
    }

    /// Every connected graph with four vertices, each of its triangles as the boundary, unit weights.
    fn draw_graphs(&mut self) {
        let polygon = [[0, 0], [1, 0], [0, 1]];
        for graph in graphs(4).into_iter().filter(|g| component_count(g) == 1) {
            for inner in 0..4 {
                let mut rim = (0..4).filter(|v| *v != inner);
                let order: [usize; 4] =
                    [rim.next().unwrap_or(0), rim.next().unwrap_or(0), rim.next().unwrap_or(0), inner];
                let has = |a: usize, b: usize| graph.edges().contains(&[a.min(b), a.max(b)]);
                if !(has(order[0], order[1]) && has(order[1], order[2]) && has(order[0], order[2])) {
                    continue;
                }
                let place = |v: usize| (0..4).find(|&k| order[k] == v).unwrap_or(0);
                let edges = graph.edges().iter().map(|&[a, b]| [place(a).min(place(b)), place(a).max(place(b))]);
                let mut drawn = Disc { vertices: 4, rim: 3, faces: Vec::new(), edges: edges.collect() };
                drawn.edges.sort_unstable();
                let weights = vec![1.0; drawn.inner_edges().count()];
                let Some(at) = drawn.draw(&polygon, &weights) else { continue };
                let point = drawn.inner_edges().find(|&[a, b]| at[a] == at[b]);
                self.loose.ask(point.map(|[a, b]| {
                    let text = in_words(&drawn, &polygon, &weights, &format!("vertices {a} and {b} coincide"));
                    let fault = Fault::Edge { a, b };
                    Case::shown(text, drawn.witness(&at, &weights, Hypothesis::ThreeConnected, fault))
                }));
            }
        }
    }

    /// A random disc with random weights, its boundary at random points of a parabola.
    fn draw_random(&mut self, n: usize, stream: &mut Stream) {
        let mut points: Vec<Point> = Vec::new();
        while points.len() < n {
            let p = [stream.below(100) as i64, stream.below(100) as i64];
            if !points.contains(&p) {
                points.push(p);
            }
        }
        let Some(disc) = sweep(&points).and_then(|t| Disc::of(&t)) else { return };
        if disc.rim == disc.vertices {
            return;
        }
        let mut places: Vec<i64> = (0..60).collect();
        stream.shuffle(&mut places);
        places.truncate(disc.rim);
        places.sort_unstable();
        let polygon: Vec<Point> = places.iter().map(|&t| [t, t * t]).collect();
        let weights: Vec<f64> = disc.inner_edges().map(|_| (1 + stream.below(16)) as f64).collect();
        let Some(at) = disc.draw(&polygon, &weights) else {
            return self.unique.ask(Some(told(&disc, &polygon, &weights, "the drawing is not unique")));
        };
        self.unique.ask(None);
        self.precise.ask(unbalanced(&disc, &polygon, &weights, &at));
        let exception = disc.folded(&at);
        self.random.ask(exception.map(|f| told(&disc, &polygon, &weights, &format!("face {f} is folded"))));
    }

    fn answer(self, largest: usize, side: i64) -> Vec<Finding> {
        let cases = format!(
            "discs with up to {largest} vertices, one inside at least; the boundary at a polygon in a box of up to {side} × {side} unit \
             squares; fewest vertices first, then the smaller box"
        );
        let ask = |text: &str| format!("{text} Cases: {cases}.");
        let positive = "drawings with unit and with random weights";
        let negative = "drawings with one weight −1 or −2, the others 1";
        let embedded = "Is the equilibrium drawing with positive weights an embedding, with the boundary at a";
        let p = ENTRY.parts;
        vec![
            self.convex.answer(p[0], ask(&format!("{embedded} convex polygon?")), positive),
            self.strict.answer(
                p[1],
                ask(&format!("{embedded} strictly convex polygon?")),
                &format!("{positive}, and of triangulated spheres with up to 6 vertices without a face"),
            ),
            self.no_chord.answer(
                p[2],
                ask(&format!(
                    "{embedded} convex polygon with straight corners, if no edge inside joins two vertices of one side?"
                )),
                positive,
            ),
            self.random.answer(
                p[3],
                format!("{embedded} strictly convex polygon?"),
                "sweep triangulations of random points, the boundary at random points of a parabola, random weights 1 to 16",
            ),
            self.reflex.answer(
                p[4],
                ask("Is there a fold with positive weights, a boundary that is not convex, and no chord?"),
                positive,
            ),
            self.negative.answer(
                p[5],
                ask("Is there a fold with one negative weight and a strictly convex boundary?"),
                negative,
            ),
            self.surface.answer(
                p[6],
                "Is there a surface with a triangle as its boundary, no disc, whose drawing with positive weights overlaps \
                 itself? Cases: closed surfaces with up to 6 vertices without a face, numbered in every way; fewest vertices first.",
                "drawings of discs with unit weights, of others with the weight 2 on two edges and no two neighbours in one place",
            ),
            self.loose.answer(
                p[7],
                "Is there a connected planar graph, not 3-connected, that is drawn with an edge of length zero?",
                "connected graphs with 4 vertices with each of their triangles as the boundary",
            ),
            self.unique.answer(
                p[8],
                ask("Is the equilibrium drawing with positive weights unique (L_II regular)?"),
                "drawings, and random discs",
            ),
            self.singular.answer(
                p[9],
                ask("Is there a disc with one negative weight whose equilibrium drawing is not unique?"),
                negative,
            ),
            self.precise.answer(
                p[10],
                ask("Is Σ_j ω_ij (x_j − x_i) = 0 at every inner vertex of the drawing, summed anew?"),
                "drawings, and random discs",
            ),
        ]
    }
}

fn has_chord_on_a_side(disc: &Disc, polygon: &[Point]) -> bool {
    let m = disc.rim;
    let on_side = |k: usize, v: usize| doubled_area(polygon[k], polygon[(k + 1) % m], polygon[v]) == 0;
    disc.chords().any(|[a, b]| (0..m).any(|k| on_side(k, a) && on_side(k, b)))
}

fn shown(disc: &Disc, polygon: &[Point], weights: &[f64], at: &[Drawn], missing: Hypothesis) -> Option<Case> {
    let face = disc.folded(at)?;
    let text = in_words(disc, polygon, weights, &format!("face {face} is not counter-clockwise"));
    if missing == Hypothesis::NoChordOnASide && !has_chord_on_a_side(disc, polygon) {
        return Some(Case::told(text));
    }
    Some(Case::shown(text, disc.witness(at, weights, missing, Fault::Face { face })))
}

fn told(disc: &Disc, polygon: &[Point], weights: &[f64], what: &str) -> Case {
    Case::told(in_words(disc, polygon, weights, what))
}

fn in_words(disc: &Disc, polygon: &[Point], weights: &[f64], what: &str) -> String {
    let corners: Vec<String> = polygon.iter().map(|[x, y]| format!("({x}, {y})")).collect();
    format!("{what}, {} with the boundary at {} and the inner weights {weights:?}", disc.describe(), corners.join(" "))
}

fn unbalanced(disc: &Disc, polygon: &[Point], weights: &[f64], at: &[Drawn]) -> Option<Case> {
    let at_rest =
        |v: usize| disc.force(at, weights, v).is_some_and(|f| f.iter().all(|x| x.cmp_zero() == Ordering::Equal));
    let v = (disc.rim..disc.vertices).find(|&v| !at_rest(v))?;
    Some(told(disc, polygon, weights, &format!("a force is left at vertex {v}")))
}

/// A direction in which the inner vertices can move in equilibrium, the boundary fixed.
fn singular(disc: &Disc, weights: &[f64]) -> Option<Case> {
    let edges: Vec<[usize; 2]> = disc.inner_edges().collect();
    let graph = with_weights(&Graph::new(disc.vertices, &edges).ok()?, weights);
    let l = laplacian(&graph);
    let rim: Vec<usize> = (0..disc.rim).collect();
    let violation = global(&l, &rim).filter(|v| matches!(v.statement, Statement::Singular { .. }))?;
    let text = format!("{}, {} with the inner weights {weights:?}", violation.text, disc.describe());
    Some(Case::shown(text, on_graph(violation.statement, &graph, &l, &violation.rows)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::recheck::{self, Rechecked};

    #[test]
    fn each_hypothesis_has_a_witness_that_another_program_verifies() {
        let findings = run(&Setting { seed: 3, effort: super::super::Effort::Smoke });
        for part in [
            "convex-boundary",
            "needs-a-convex-boundary",
            "needs-positive-weights",
            "needs-a-disc",
            "needs-3-connection",
        ] {
            let finding = findings.iter().find(|f| f.part == part).unwrap();
            assert_eq!(finding.evidence.len(), 1, "{part}: {}", finding.finding);
            assert_eq!(recheck::from_excerpt(&finding.evidence[0]), Ok(Rechecked::Exact), "{part}");
        }
    }

    #[test]
    fn a_force_that_is_left_is_noticed() {
        let wheel = &discs(4)[0];
        let polygon = [[0, 0], [1, 0], [0, 1]];
        let at = wheel.draw(&polygon, &[1.0, 1.0, 1.0]).unwrap();
        assert!(unbalanced(wheel, &polygon, &[1.0, 1.0, 1.0], &at).is_none());
        assert!(unbalanced(wheel, &polygon, &[1.0, 1.0, 2.0], &at).is_some());
    }
}
