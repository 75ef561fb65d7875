//! Uniform scaling.

use super::shape::place;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::Domain;
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "scale",
    name: "uniform scaling about the origin",
    guarantees: &[
        "the same connectivity; every coordinate times factor, rounded once",
        "exact for a power of two: angles, planarity and Delaunay stay bit for bit",
    ],
    sources: &[],
    parameters: &[Parameter {
        name: "factor",
        meaning: "the factor of all lengths",
        default: "2",
        range: Range::Number(1e-30, 1e30),
    }],
    make: Make::Modifier(change),
};

fn change(domain: &Domain, settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let factor = settings.number("factor");
    place::positions("scale", domain, |p| p.map(|x| factor * x), |normal| normal)
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{change, make, surface_facts};

    #[test]
    fn a_power_of_two_keeps_angles_and_multiplies_the_area_exactly() {
        let before = make("random-delaunay", &[], 1);
        let after = change(&before, "scale", &[("factor", "1024")], 0);
        let (f, g) = (surface_facts(&before), surface_facts(&after));
        assert_eq!((f.min_angle_deg, f.delaunay, f.area * 1048576.0), (g.min_angle_deg, g.delaunay, g.area));
    }
}
