//! Translation.

use super::shape::place;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::Domain;
use crate::parameter::{Parameter, Range, Settings};

const SHIFT: Range = Range::Number(-1e30, 1e30);

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "translate",
    name: "translation",
    guarantees: &[
        "the same connectivity; every coordinate plus the shift, rounded once",
        "a mesh in a coordinate plane stays in one; a shift far larger than the mesh may round it into a degenerate one",
    ],
    sources: &[],
    parameters: &[
        Parameter { name: "x", meaning: "shift in x", default: "1", range: SHIFT },
        Parameter { name: "y", meaning: "shift in y", default: "0", range: SHIFT },
        Parameter { name: "z", meaning: "shift in z", default: "0", range: SHIFT },
    ],
    make: Make::Modifier(change),
};

fn change(domain: &Domain, settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let shift = ["x", "y", "z"].map(|axis| settings.number(axis));
    place::positions("translate", domain, |p| std::array::from_fn(|k| p[k] + shift[k]), |normal| normal)
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{change, disc, make};

    #[test]
    fn an_integer_grid_is_moved_exactly() {
        let before = make("grid", &[], 0);
        let after = change(&before, "translate", &[("x", "-3"), ("y", "7"), ("z", "5")], 0);
        for (p, q) in before.positions().unwrap().iter().zip(after.positions().unwrap()) {
            assert_eq!([p[0] - 3.0, p[1] + 7.0, p[2] + 5.0], *q);
        }
        assert_eq!(disc(&after).delaunay, Some(true));
    }
}
