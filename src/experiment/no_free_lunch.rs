//! No free lunch: which triangulations have weights that are symmetric, local, linearly precise and positive at once.
//!
//! The decisions and their certificates are those of [`equilibrium`](crate::laplacian::equilibrium): a convex lift with the
//! weights that follow from it, positive weights as such, or a motion that rules them out.

mod beyond;
mod range;

use rayon::prelude::*;

use super::poll::{Case, Every};
use super::world::certified::{Certified, certified, verified};
use super::world::lifting::{Lifting, lifting};
use super::world::planar::{FAMILIES, Specimen, specimen};
use super::{Experiment, Finding, Setting};
use crate::domain::Surface;
use crate::generate::Stream;
use crate::laplacian::equilibrium::{Certificate, Lift, decide_by_simplex};
use crate::laplacian::orthogonal_dual::stiffness_in_plane;
use crate::property::Evidence;
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "no-free-lunch",
    name: "Positive weights in equilibrium, convex lifts and weighted Delaunay triangulations",
    statement: "a planar triangulation has symmetric, local, linearly precise, positive weights, shown by a lift or by weights, \
                or it has none, shown by a motion; on discs with convex boundary it has them exactly if it is a weighted \
                Delaunay triangulation; twisted nested triangles have none",
    sources: &["wardetzky-primer", "wardetzky2007"],
    parts: &[
        "exactly-one-certificate",
        "the-exact-simplex-method-agrees",
        "positive-duals-iff-weighted-delaunay-on-convex-discs",
        "positive-iff-weighted-delaunay-on-convex-discs",
        "positive-only-on-weighted-delaunay",
        "positive-on-a-non-convex-disc",
        "positive-on-an-annulus",
        "positive-on-a-flat-torus",
        "twisted-triangulations-have-none",
        "the-range-of-twists",
    ],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let (many, few) = (setting.pick(90, 270), setting.pick(36, 108));
    let decided = one_certificate(setting.seed, many);
    let small = small_discs(setting.seed, few);
    let mut findings = vec![decided];
    findings.extend(on_small_discs(&small));
    findings.extend(beyond::run(&small));
    findings.extend(range::run(setting.pick(4, 12)));
    findings
}

/// A random triangulation of 5 to 60 points, number `k`.
pub fn random_case(seed: u64, k: usize) -> Specimen {
    specimen(k, 60, &mut Stream::new(seed, &format!("{}/{k}", ENTRY.id)))
}

fn surface_of(specimen: &Specimen) -> Result<&Surface, String> {
    specimen.domain.as_surface().ok_or_else(|| "no surface".to_string())
}

/// Every random triangulation has a certificate that survives the recheck.
fn one_certificate(seed: u64, count: usize) -> Finding {
    let decide = |k: usize| {
        let specimen = random_case(seed, k);
        let found = surface_of(&specimen).and_then(certified);
        (specimen.recipe, found)
    };
    let results: Vec<_> = (0..count).into_par_iter().map(decide).collect();
    let (mut poll, mut kinds, mut by_simplex) = (Every::default(), [0, 0], 0);
    for (recipe, found) in results {
        match found {
            Ok(Certified { decision, .. }) => {
                kinds[usize::from(!decision.certificate.is_positive())] += 1;
                by_simplex += usize::from(decision.by_simplex);
                poll.ask(None);
            }
            Err(why) => poll.ask(Some(Case::told(format!("{recipe}: {why}")))),
        }
    }
    let mut finding = poll.answer(
        ENTRY.parts[0],
        format!(
            "Has every triangulation either a convex lift with positive weights in equilibrium or a motion that rules them out, \
             verified exactly from what is written down? Cases: {count} random triangulations of 5 to 60 points from {FAMILIES} \
             families: Delaunay, flipped, of smallest angles, in discs, grids, twisted nested triangles."
        ),
        "triangulations",
    );
    finding.finding += &format!(
        "; {} have a lift, {} a motion; {by_simplex} of them by the exact simplex method, rounding having decided nothing",
        kinds[0], kinds[1]
    );
    finding
}

/// A small disc with convex boundary, and what was decided on it.
struct Small {
    recipe: String,
    surface: Surface,
    certified: Result<Certified, String>,
    /// A lift above which every vertex is, or the evidence that there is none.
    global: Option<Result<Vec<Rational>, Evidence>>,
    /// A lift that is convex across every interior edge, or the evidence that there is none.
    local: Option<Result<Vec<Rational>, Evidence>>,
    /// What the exact simplex method alone says.
    second: Option<bool>,
}

fn small_discs(seed: u64, count: usize) -> Vec<Small> {
    let make = |k: usize| {
        let Specimen { recipe, domain } = specimen(k, 7, &mut Stream::new(seed, &format!("{}/small/{k}", ENTRY.id)));
        let surface = domain.as_surface()?.clone();
        let [global, local] = [Lifting::Global, Lifting::Local].map(|which| lifting(&surface, which));
        let second = decide_by_simplex(&surface).map(|c| c.is_positive());
        Some(Small { certified: certified(&surface), recipe, surface, global, local, second })
    };
    (0..count).into_par_iter().filter_map(make).collect()
}

/// Whether the orthogonal duals of the weights `w = |x|² − 2h` are the weights of the lift h, edge by edge.
fn duals_are_the_lift(surface: &Surface, heights: &[Rational]) -> Option<bool> {
    let at = surface.planar_positions::<Rational>()?;
    let square = |p: &[Rational; 2]| p[0].clone() * p[0].clone() + p[1].clone() * p[1].clone();
    let weights: Vec<Rational> = at.iter().zip(heights).map(|(p, h)| square(p) - h.clone() - h.clone()).collect();
    let (stiffness, lift) = (stiffness_in_plane(surface, &weights)?, Lift::of(surface)?);
    let same = |([i, j], w): ([usize; 2], Rational)| (stiffness.at(i, j) + w).cmp_zero().is_eq();
    Some(lift.edges().zip(lift.weights(heights)).all(same))
}

fn on_small_discs(small: &[Small]) -> Vec<Finding> {
    let (mut simplex, mut duals, mut delaunay) = (Every::default(), Every::default(), Every::default());
    for case in small {
        let told = |why: &str| Some(Case::told(format!("{}: {why}", case.recipe)));
        let positive = case.certified.as_ref().map(|c| c.decision.certificate.is_positive());
        simplex.ask(if positive.as_ref().ok() == case.second.as_ref() { None } else { told("the two ways differ") });
        let shown = |lift: &Option<Result<Vec<Rational>, Evidence>>| match lift {
            Some(Ok(_)) => (true, false),
            Some(Err(evidence)) => (false, verified(evidence).is_ok()),
            None => (false, false),
        };
        let ((lifted, refuted), (_, none)) = (shown(&case.global), shown(&case.local));
        let heights = case.certified.as_ref().ok().and_then(|c| match &c.decision.certificate {
            Certificate::Heights(heights) => Some(heights),
            _ => None,
        });
        // Positive duals are those of some weights: the lift has them; without a lift no weights do, by the exact method.
        let has_duals = heights.is_some_and(|h| duals_are_the_lift(&case.surface, h) == Some(true));
        duals.ask(match (has_duals, none, lifted, refuted) {
            (true, false, true, false) | (false, true, false, true) => None,
            _ => told("positive duals without a weighted Delaunay triangulation, or the reverse"),
        });
        delaunay.ask(match (&positive, lifted, refuted) {
            (Ok(true), true, false) | (Ok(false), false, true) => None,
            _ => told("positive weights without a weighted Delaunay triangulation, or the reverse"),
        });
    }
    let cases = format!("Cases: {} random triangulations of 5 to 9 points, all of convex regions.", small.len());
    vec![
        simplex.answer(
            ENTRY.parts[1],
            format!("Does the exact simplex method alone decide as linear program and rounding do? {cases}"),
            "triangulations",
        ),
        duals.answer(
            ENTRY.parts[2],
            format!(
                "Do vertex weights exist whose orthogonal dual is positive on every interior edge exactly where heights exist \
                 that have every vertex above the plane of every triangle? {cases}"
            ),
            "triangulations",
        ),
        delaunay.answer(
            ENTRY.parts[3],
            format!("Do positive weights in equilibrium exist exactly where such heights do? {cases}"),
            "triangulations",
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn duals_of_other_weights_are_not_the_lift() {
        let points = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [-2.0, 0.0], [0.0, -1.0]];
        let star = Surface::planar(&points, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]).unwrap();
        let number = |x: f64| Rational::exactly(x).unwrap();
        let paraboloid: Vec<Rational> = points.iter().map(|p| number(0.5 * (p[0] * p[0] + p[1] * p[1]))).collect();
        assert_eq!(duals_are_the_lift(&star, &paraboloid), Some(true));
        let lift = Lift::of(&star).unwrap();
        assert_eq!(lift.weights(&paraboloid), [0.5, 2.0, 0.5, 2.0].map(number));
        assert!(lift.is_convex(&paraboloid) && !lift.is_convex(&vec![Rational::ZERO; 5]));
    }
}
