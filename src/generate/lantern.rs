//! The Schwarz lantern.
//!
//! # Definition
//! m + 1 regular n-gons inscribed in the circles at heights `k·height/m` of a cylinder, each turned by π/n against the one
//! below, joined by 2mn congruent isosceles triangles. Their total area is
//! `2mn r sin(π/n) √((height/m)² + r²(1 − cos(π/n))²)`, which tends to that of the cylinder only if m/n² → 0 \[schwarz1890\].

use super::shape::circle;
use super::shape::input::admit;
use super::shape::sheet::Sheet;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "lantern",
    name: "Schwarz lantern: a cylinder of m layers of n sectors",
    guarantees: &[
        "n(m+1) vertices on the cylinder about the z-axis, 2mn triangles, all congruent up to rounding, two boundary loops of n edges",
        "manifold, connected, genus 0, faces counter-clockwise seen from outside",
        "area 2mn r sin(π/n) √((height/m)² + r²(1 − cos(π/n))²)",
    ],
    sources: &["schwarz1890"],
    parameters: &[
        Parameter { name: "m", meaning: "layers", default: "8", range: Range::Whole(1, 100_000) },
        Parameter { name: "n", meaning: "sectors", default: "12", range: Range::Whole(3, 100_000) },
        Parameter { name: "radius", meaning: "radius of the cylinder", default: "1", range: Range::Number(1e-6, 1e6) },
        Parameter { name: "height", meaning: "height of the cylinder", default: "1", range: Range::Number(1e-6, 1e6) },
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let (m, n) = (settings.whole("m"), settings.whole("n"));
    let (radius, height) = (settings.number("radius"), settings.number("height"));
    admit("lantern", "vertices", n * (m + 1))?;
    let sheet = Sheet { columns: n, rows: m, periodic: [true, false] };
    let at = |[i, k]: [usize; 2]| {
        let [c, s] = circle::turn(2 * i + k % 2, 2 * n);
        [radius * c, radius * s, height * (k as f64 / m as f64)]
    };
    // Odd circles are turned forward by half a sector, so that the diagonals alternate from layer to layer.
    let faces = sheet.triangles(|_, k| k % 2 == 1);
    Ok(Surface::triangles(sheet.vertices().map(at).collect(), &faces)?.into())
}

#[cfg(test)]
mod tests {
    use crate::domain::Domain;
    use crate::generate::testing::{make, surface_facts};

    fn lantern(m: usize, n: usize) -> Domain {
        make("lantern", &[("m", &m.to_string()), ("n", &n.to_string()), ("radius", "2"), ("height", "3")], 0)
    }

    #[test]
    fn counts_boundary_and_area_are_the_closed_forms() {
        for (m, n) in [(1, 3), (2, 3), (8, 12), (50, 7), (5, 40)] {
            let domain = lantern(m, n);
            let (all, facts) = (domain.facts(), surface_facts(&domain));
            assert_eq!((all.vertices, all.faces, all.components), (n * (m + 1), 2 * m * n, 1));
            assert_eq!((facts.manifold, facts.genus, facts.boundary_loops), (true, Some(0), 2));
            assert_eq!((facts.boundary_edges, facts.flipped_faces, facts.degenerate_faces), (2 * n, 0, 0));
            let angle = std::f64::consts::PI / n as f64;
            let slant = (3.0 / m as f64).hypot(2.0 * (1.0 - angle.cos()));
            let area = (2 * m * n) as f64 * 2.0 * angle.sin() * slant;
            assert!((facts.area - area).abs() < 1e-12 * area, "{m} {n}: {} {area}", facts.area);
            let s = domain.as_surface().unwrap();
            for (f, corners) in s.faces().iter().enumerate() {
                assert!((s.face_area(f) * (2 * m * n) as f64 - area).abs() < 1e-12 * area, "congruent");
                let [a, b, c] = [0, 1, 2].map(|k| s.point(corners[k]));
                let outward = (a + b + c).component_mul(&crate::domain::geometry::Vec3::new(1.0, 1.0, 0.0));
                assert!((b - a).cross(&(c - a)).dot(&outward) > 0.0, "seen from outside");
            }
        }
    }

    #[test]
    fn the_area_diverges_when_layers_grow_faster_than_the_square_of_sectors() {
        let area = |n: usize| surface_facts(&lantern(n * n * n / 4, n)).area;
        assert!(area(16) > 1.5 * area(8));
    }
}
