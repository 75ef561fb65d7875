//! Random triangulations of discs, of every family that the generators have, each with the recipe that makes it.

use std::collections::BTreeMap;

use crate::domain::Domain;
use crate::generate::{self, Stream};

/// A triangulation and the recipe that makes it.
pub struct Specimen {
    /// The recipe, as the command line takes it.
    pub recipe: String,
    /// The domain.
    pub domain: Domain,
}

/// A triangulation of 5 to `largest` points: Delaunay, with random flips, with every angle as small as flips can make it, in
/// a disc, a grid with random diagonals (exact or shaken), or nested and twisted triangles of Schönhardt's kind, flipped
/// or not. `case` chooses the family.
pub fn specimen(case: usize, largest: usize, stream: &mut Stream) -> Specimen {
    loop {
        // A family may refuse what was drawn: a twist that folds a triangle.
        if let Some(specimen) = draw(case, largest, stream) {
            return specimen;
        }
    }
}

/// How many families there are.
pub const FAMILIES: usize = 9;

fn draw(case: usize, largest: usize, stream: &mut Stream) -> Option<Specimen> {
    let n = 5 + stream.below(largest.max(5) - 4);
    let flips = 1 + stream.below(n);
    let seed = stream.below(1 << 20) as u64;
    let whole = |x: usize| x.to_string();
    let source = |id: &str, given: &[(&str, String)]| Step::new(id, given);
    let flipped = || source("flip", &[("count", whole(flips))]);
    let twisted = |twist: f64, ratio: f64| {
        // At twist 0 rounding decides nothing, and the exact simplex method is for few points.
        let nested = ((n / 3).max(2) - 1).min(if twist == 0.0 { 1 + n % 6 } else { n });
        source("schonhardt", &[("twist", twist.to_string()), ("nested", whole(nested)), ("ratio", ratio.to_string())])
    };
    let side = |n: usize| whole(((n as f64).sqrt() as usize).clamp(3, 12) - 1);
    let grid = |id: &str, more: &[(&str, String)]| {
        let sides = [("nx", side(n)), ("ny", side(n)), ("diagonals", "random".to_string())];
        source(id, &[&sides[..], more].concat())
    };
    let scattered = || source("random-delaunay", &[("n", whole(n))]);
    let steps = match case % FAMILIES {
        0 => vec![scattered()],
        1 => vec![scattered(), flipped()],
        2 => vec![scattered(), source("worst-angle", &[])],
        3 => {
            let rim = 3 + stream.below((n - 2).min(12));
            vec![source("random-delaunay-disk", &[("n", whole(n - rim)), ("m", whole(rim))]), flipped()]
        }
        4 => vec![grid("grid", &[])],
        5 => {
            let displacement = stream.between(0.02, 0.45);
            vec![grid("perturbed-grid", &[("displacement", displacement.to_string())])]
        }
        6 => vec![twisted(stream.between(-0.6, 0.3), stream.between(0.2, 0.45))],
        7 => vec![twisted(stream.between(-0.6, 0.3), stream.between(0.2, 0.45)), flipped()],
        _ => vec![twisted(0.0, 0.5)],
    };
    let mut domain: Option<Domain> = None;
    for step in &steps {
        domain = Some(generate::find(&step.id)?.run(domain.as_ref(), &step.given, seed).ok()?);
    }
    let recipe = steps.iter().map(|step| step.text(seed)).collect::<Vec<_>>().join(" | ");
    Some(Specimen { recipe, domain: domain? })
}

struct Step {
    id: String,
    given: BTreeMap<String, String>,
}

impl Step {
    fn new(id: &str, given: &[(&str, String)]) -> Self {
        Step { id: id.into(), given: given.iter().map(|(k, v)| (k.to_string(), v.clone())).collect() }
    }

    fn text(&self, seed: u64) -> String {
        let settings = self.given.iter().map(|(k, v)| format!("{k}={v}")).chain([format!("seed={seed}")]);
        format!("{}:{}", self.id, settings.collect::<Vec<_>>().join(","))
    }
}
