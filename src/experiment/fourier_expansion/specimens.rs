//! Meshes and graphs with symmetric operators, and functions on them.

use crate::domain::Domain;
use crate::generate::{self, Stream};
use crate::linalg::Csr;

/// A domain, the operator on it, and what to call them.
pub struct Specimen {
    /// What to call it.
    pub name: String,
    /// The domain.
    pub domain: Domain,
    /// The id of the operator.
    pub operator: &'static str,
    /// Its parameters.
    pub settings: Given,
}

/// Parameters and their values.
type Given = &'static [(&'static str, &'static str)];

/// Generators with their parameters, one after the other.
type Steps = &'static [(&'static str, Given)];

/// Generators, an operator and its parameters.
type Plan = (Steps, &'static str, Given);

/// What generators make; `None` where one refuses.
pub fn domain(steps: Steps, seed: u64) -> Option<Domain> {
    steps.iter().try_fold(None, |made: Option<Domain>, (id, settings)| {
        let given = settings.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect();
        generate::find(id)?.run(made.as_ref(), &given, seed).ok().map(Some)
    })?
}

/// Closed surfaces of genus 0, 1 and 2, discs, graphs with weights of either sign; a name where a generator refuses.
pub fn specimens(everything: bool, seed: u64) -> Vec<Result<Specimen, String>> {
    const CONSISTENT: Given = &[("mass", "consistent")];
    const GIVEN: Given = &[("weights", "given")];
    let small: &[Plan] = &[
        (&[("icosphere", &[("levels", "1")])], "cotan", &[]),
        (&[("square", &[("levels", "2")])], "cotan", CONSISTENT),
        (&[("random-delaunay", &[("n", "40")]), ("flip", &[("count", "12")])], "intrinsic-delaunay", &[]),
        (&[("gnp", &[("n", "24"), ("p", "0.3")]), ("random-weights", &[("negative", "0.4")])], "weighted-graph", GIVEN),
    ];
    let large: &[Plan] = &[
        (&[("icosphere", &[("levels", "2")])], "cotan", &[]),
        (&[("icosphere", &[("levels", "2")])], "cotan", CONSISTENT),
        (&[("torus", &[("levels", "0")])], "cotan", &[]),
        (&[("genus", &[("genus", "2"), ("levels", "0")])], "cotan", CONSISTENT),
        (&[("random-delaunay-disk", &[("n", "120"), ("m", "20")]), ("flip", &[("count", "30")])], "cotan", &[]),
        (&[("flat-torus", &[("levels", "1")])], "cotan", &[]),
        (
            &[("gnp", &[("n", "120"), ("p", "0.08")]), ("random-weights", &[("negative", "0.4")])],
            "weighted-graph",
            GIVEN,
        ),
    ];
    let chosen = small.iter().chain(large.iter().filter(|_| everything));
    chosen
        .map(|&(steps, operator, settings)| {
            let names = steps.iter().map(|(id, given)| {
                let given: Vec<String> = given.iter().map(|(k, v)| format!("{k}={v}")).collect();
                if given.is_empty() { (*id).to_string() } else { format!("{id}:{}", given.join(",")) }
            });
            let given: Vec<String> = settings.iter().map(|(k, v)| format!(" {k}={v}")).collect();
            let name = format!("{}, {operator}{}", names.collect::<Vec<_>>().join(" | "), given.concat());
            match domain(steps, seed) {
                Some(domain) => Ok(Specimen { name, domain, operator, settings }),
                None => Err(name),
            }
        })
        .collect()
}

impl Specimen {
    /// Stiffness and mass; the mass is the identity where the operator has none.
    pub fn matrices(&self) -> Option<(Csr, Csr)> {
        let given = self.settings.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect();
        let operator = crate::laplacian::find(self.operator)?.build(&self.domain, &given).ok()?;
        let n = operator.size();
        let mass = operator.mass().map_or_else(|| Csr::diagonal(&vec![1.0; n]), |m| m.matrix().clone());
        Some((operator.stiffness().clone(), mass))
    }
}

/// Functions on n vertices: one vertex alone, signs, random values, and the coordinates where there are positions.
pub fn functions(domain: &Domain, stream: &mut Stream) -> Vec<(&'static str, Vec<f64>)> {
    let n = domain.vertex_count();
    let at = stream.below(n);
    let mut all = vec![
        ("one vertex", (0..n).map(|i| f64::from(u8::from(i == at))).collect::<Vec<f64>>()),
        ("random signs", (0..n).map(|_| if stream.below(2) == 0 { 1.0 } else { -1.0 }).collect()),
        ("random values", (0..n).map(|_| stream.normal()).collect()),
    ];
    if let Some(surface) = domain.as_surface() {
        let positions = surface.positions();
        all.push(("a coordinate", positions.iter().map(|p| p[0]).collect()));
        all.push(("a product of coordinates", positions.iter().map(|p| p[0] * p[1] + p[2]).collect()));
    }
    all
}
