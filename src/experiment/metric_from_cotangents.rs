//! The metric from its cotangent weights: lengths recovered by Newton's method on a convex energy.
//!
//! See [`energy`] for the mathematics. The weights come from the catalogue's cotangent operator on a mesh in space; what is
//! given to the method is the list of triangles by their sides, and one number for each side.

mod energy;
mod exact;
mod worlds;

use super::poll::{Case, Every};
use super::{Experiment, Finding, Setting};
use crate::domain::{Domain, Surface};
use crate::figure::{Axis, Chart, Figure, Mark, Series};
use crate::generate::Stream;
use crate::property::Level;

use energy::{Minimum, Sides};
use worlds::Specimen;

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "metric-from-cotangents",
    name: "The edge lengths of a surface from its cotangent weights",
    statement: "½ cot is the derivative of a triangle's area by ½ℓ², the area is concave, and the cotangent weights of a \
                triangulated surface, closed or with boundary, determine its edge lengths up to one factor for each part \
                that is connected through edges",
    sources: &["wardetzky-primer", "zeng2012"],
    parts: &[
        "gradient-identity",
        "area-is-concave",
        "one-scale-for-each-part",
        "closed-surfaces",
        "surfaces-with-boundary",
        "several-parts",
        "wrong-weight-is-noticed",
    ],
    run,
};

/// The relative error of a length that the claim allows.
const TOLERANCE: f64 = 1e-10;

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let (mut identity, mut concave, mut scales) = (Every::default(), Every::default(), Every::default());
    let heron = exact::heron();
    exact::gradient_identities(&heron).into_iter().for_each(|violation| identity.ask(violation));
    for _ in 0..setting.pick(50, 400) {
        concave.ask(exact::not_concave(&heron, &exact::random_sides(&mut stream)));
    }
    for _ in 0..setting.pick(1, 4) {
        for (name, surface, parts) in worlds::whole(&mut stream) {
            scales.ask(exact::scales_are_not_parts(&surface, parts, &name));
        }
    }
    let (mut closed, mut bounded, mut several, mut wrong) =
        (Tally::default(), Tally::default(), Tally::default(), Every::default());
    for case in 0..setting.pick(6, 100) {
        let specimen = worlds::closed(case, &mut stream);
        closed.ask(&specimen, case % 3);
        wrong.ask(unnoticed(&specimen, &mut stream));
    }
    for case in 0..setting.pick(4, 24) {
        let specimen = worlds::bounded(case, &mut stream);
        bounded.ask(&specimen, 0);
        wrong.ask(unnoticed(&specimen, &mut stream));
    }
    for case in 0..setting.pick(2, 9) {
        let (a, b) = (worlds::closed(case, &mut stream), worlds::bounded(case, &mut stream));
        let Some(surface) = worlds::united(&a.surface, &b.surface, case % 2 == 1) else { continue };
        several.ask(&Specimen { recipe: format!("{} and {}", a.recipe, b.recipe), surface }, 0);
    }
    let within =
        "within 1e-10 of each length, one factor for each part left open, where no angle is below half a degree";
    let figures = closed.figures();
    let found = closed.answer(
        "closed-surfaces",
        format!("Are the edge lengths of closed surfaces recovered {within}?"),
        "closed surfaces of genus 0, 1 and 2",
    );
    vec![
        identity.answer(
            "gradient-identity",
            "With u = ½ℓ²: is 4A² Heron's polynomial Q(u), and ½ cot = ∂A/∂u at each corner, for every triangle in space?",
            "identities between polynomials in nine coordinates",
        ),
        concave.answer(
            "area-is-concave",
            "Has the second derivative of the area two negative eigenvalues and the kernel u?",
            "random triangles with whole coordinates",
        ),
        scales.answer(
            "one-scale-for-each-part",
            "Is the area of a surface flat along exactly one scaling for each part that is connected through edges?",
            "surfaces with whole coordinates: tetrahedra, octahedra, fans, and pairs of them apart or touching in a vertex",
        ),
        Finding { figures, ..found },
        bounded.answer(
            "surfaces-with-boundary",
            format!("Are the edge lengths of surfaces with boundary recovered {within}?"),
            "surfaces with boundary",
        ),
        several.answer(
            "several-parts",
            format!("Are the edge lengths of two surfaces, apart or touching in a vertex, recovered {within}?"),
            "pairs of surfaces",
        ),
        Finding {
            level: Level::Bounded,
            ..wrong.answer(
                "wrong-weight-is-noticed",
                "Where a single weight is changed by a thousandth, is it shown that the weights belong to no metric?",
                "surfaces, closed and with boundary",
            )
        },
    ]
}

/// The weights of the catalogue's cotangent operator, one for each edge.
fn weights(surface: &Surface) -> Option<Vec<f64>> {
    let domain = Domain::from(surface.clone());
    let operator = crate::laplacian::find("cotan")?.build(&domain, &Default::default()).ok()?;
    Some(surface.topology().edges().iter().map(|&[a, b]| -operator.stiffness().at(a, b)).collect())
}

/// The largest relative error of a length, each part scaled to the same sum of ℓ².
fn error(surface: &Surface, sides: &Sides, found: &Minimum) -> f64 {
    let square = |&[a, b]: &[usize; 2]| (surface.point(a) - surface.point(b)).norm_squared();
    let squares: Vec<f64> = surface.topology().edges().iter().map(square).collect();
    let (expected, total) = (sides.per_part(squares.iter().copied()), sides.per_part(found.u.iter().copied()));
    let relative = squares.iter().zip(&found.u).zip(&sides.parts).map(|((square, u), &part)| {
        let length = (u * (expected[part] / total[part])).sqrt();
        (length / square.sqrt() - 1.0).abs()
    });
    relative.fold(0.0, |m, e| if e.is_nan() || e > m { e } else { m })
}

/// Counts recoveries, with what a reader may want to see of them.
#[derive(Default)]
struct Tally {
    every: Every,
    worst: f64,
    edges: usize,
    steps: usize,
    errors: [Vec<[f64; 2]>; 3],
    paths: [Vec<[f64; 2]>; 3],
}

impl Tally {
    fn ask(&mut self, specimen: &Specimen, genus: usize) {
        let surface = &specimen.surface;
        let (Some(sides), Some(w)) = (Sides::of(surface), weights(surface)) else {
            self.every.ask(Some(Case::told(format!("{}: no cotangent weights", specimen.recipe))));
            return;
        };
        let violation = match sides.minimise(&w) {
            Err(why) => Some(why.to_string()),
            Ok(found) => {
                let error = error(surface, &sides, &found);
                self.worst = self.worst.max(error);
                self.edges = self.edges.max(w.len());
                self.steps = self.steps.max(found.steps.len());
                self.errors[genus].push([w.len() as f64, error]);
                if self.paths[genus].is_empty() {
                    self.paths[genus] = found.steps.iter().enumerate().map(|(k, s)| [k as f64 + 1.0, *s]).collect();
                }
                match found.without_metric() {
                    Some(_) => Some("the weights are said to belong to no metric".to_string()),
                    None if error <= TOLERANCE => None,
                    None => Some(format!("a length is off by {error:.1e}")),
                }
            }
        };
        self.every.ask(violation.map(|text| Case::told(format!("{}: {text}", specimen.recipe))));
    }

    fn answer(self, part: &'static str, question: String, cases: &str) -> Finding {
        let numbers = format!(
            "; largest relative error {:.1e}, up to {} edges, at most {} Newton steps",
            self.worst, self.edges, self.steps
        );
        let mut finding = self.every.answer(part, question, cases);
        finding.finding += &numbers;
        Finding { level: Level::Measured, ..finding }
    }

    fn figures(&self) -> Vec<Figure> {
        let series = |points: &[Vec<[f64; 2]>; 3], mark: Mark| {
            let named =
                points.iter().enumerate().map(|(g, p)| Series::new(format!("genus {g}"), mark, p.iter().copied()));
            named.collect::<Vec<_>>()
        };
        let errors = Chart {
            title: "Largest relative error of a recovered edge length, one dot a surface".into(),
            x: Axis::linear("edges"),
            y: Axis::logarithmic("error"),
            series: series(&self.errors, Mark::Dots),
        };
        let steps = Chart {
            title: "Newton's method on the convex energy: largest relative change of u in each step".into(),
            x: Axis::linear("step"),
            y: Axis::logarithmic("change"),
            series: series(&self.paths, Mark::Both),
        };
        vec![Figure::Chart(errors), Figure::Chart(steps)]
    }
}

/// One weight is changed by a thousandth of the average magnitude, up or down: a violation where the energy's minimum does
/// not show that there is no metric.
fn unnoticed(specimen: &Specimen, stream: &mut Stream) -> Option<Case> {
    let (sides, mut w) = (Sides::of(&specimen.surface)?, weights(&specimen.surface)?);
    let average = w.iter().map(|w| w.abs()).sum::<f64>() / w.len() as f64;
    let edge = stream.below(w.len());
    let change = if stream.below(2) == 0 { 1e-3 } else { -1e-3 } * average;
    w[edge] += change;
    let text = match sides.minimise(&w) {
        Err(why) => why.to_string(),
        Ok(found) => match found.without_metric() {
            Some(part) if found.multipliers[part] * change > 0.0 => return None,
            Some(_) => "the energy has the wrong sign".to_string(),
            None => format!("not noticed: λ = {:.1e} ± {:.1e}", found.multipliers[0], found.residuals[0]),
        },
    };
    Some(Case::told(format!("{}, weight of edge {edge} changed by {change:e}: {text}", specimen.recipe)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sphere() -> Surface {
        let sphere = crate::generate::find("icosphere").unwrap().run(None, &Default::default(), 1).unwrap();
        sphere.as_surface().unwrap().clone()
    }

    #[test]
    fn the_weights_of_another_metric_give_that_metric_and_not_the_one_asked_for() {
        let (surface, mut torn) = (sphere(), Stream::new(5, "torn"));
        let moved = surface.positions().iter().map(|p| p.map(|x| x * torn.between(0.95, 1.05))).collect();
        let other = surface.with_positions(moved).unwrap();
        let sides = Sides::of(&surface).unwrap();
        let found = sides.minimise(&weights(&other).unwrap()).unwrap();
        assert!(error(&other, &sides, &found) < TOLERANCE && error(&surface, &sides, &found) > 1e-3);
        assert_eq!(found.without_metric(), None);
    }

    #[test]
    fn doubled_weights_and_weights_without_the_half_belong_to_no_metric() {
        let surface = sphere();
        let (sides, w) = (Sides::of(&surface).unwrap(), weights(&surface).unwrap());
        for factor in [2.0, 0.5, -1.0] {
            let scaled: Vec<f64> = w.iter().map(|w| factor * w).collect();
            assert_eq!(sides.minimise(&scaled).unwrap().without_metric(), Some(0), "{factor}");
        }
    }

    #[test]
    fn a_wrong_side_list_is_noticed() {
        let surface = sphere();
        let (mut sides, w) = (Sides::of(&surface).unwrap(), weights(&surface).unwrap());
        let last = sides.triangles[7][2];
        sides.triangles[7][2] = sides.triangles[31][0];
        sides.triangles[31][0] = last;
        let found = sides.minimise(&w);
        assert!(found.is_err() || found.is_ok_and(|f| error(&surface, &sides, &f) > TOLERANCE));
    }
}
