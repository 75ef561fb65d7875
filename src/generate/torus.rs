//! Refinement sequence of the torus of revolution in space.

use super::shape::circle;
use super::shape::input::impossible;
use super::shape::sheet::{DIAGONALS, Sheet};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "torus",
    name: "torus of revolution about the z-axis, 12·2^levels × 6·2^levels cells",
    guarantees: &[
        "72·4^levels vertices on the torus (up to rounding), 144·4^levels triangles, nested in their vertices",
        "closed, manifold, connected, genus 1, no degenerate face, faces counter-clockwise seen from outside",
    ],
    sources: &[],
    parameters: &[
        Parameter { name: "levels", meaning: "level of refinement", default: "1", range: Range::Whole(0, 6) },
        Parameter {
            name: "major",
            meaning: "distance of the tube's centre from the axis",
            default: "2",
            range: Range::Number(1e-6, 1e6),
        },
        Parameter {
            name: "minor",
            meaning: "radius of the tube, below major",
            default: "1",
            range: Range::Number(1e-6, 1e6),
        },
        DIAGONALS,
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let (major, minor) = (settings.number("major"), settings.number("minor"));
    if minor >= major {
        return Err(impossible(
            "torus",
            format!("minor = {minor} must be below major = {major}, or the tube meets itself"),
        ));
    }
    let n = 6 << settings.whole("levels");
    let sheet = Sheet { columns: 2 * n, rows: n, periodic: [true, true] };
    let at = |[i, j]: [usize; 2]| {
        let ([c, s], [radial, up]) = (circle::turn(i, sheet.columns), circle::turn(j, sheet.rows));
        let distance = major + minor * radial;
        [distance * c, distance * s, minor * up]
    };
    let faces = sheet.cut(settings.get("diagonals"), stream);
    Ok(Surface::triangles(sheet.vertices().map(at).collect(), &faces)?.into())
}

#[cfg(test)]
mod tests {
    use crate::generate::testing::{make, outward_volume, surface_facts};

    #[test]
    fn every_level_is_a_closed_surface_of_genus_one_whose_area_tends_to_that_of_the_torus() {
        let (major, minor, pi) = (2.0, 1.0, std::f64::consts::PI);
        let mut defects = Vec::new();
        for level in 0..4 {
            let domain = make("torus", &[("levels", &level.to_string())], 0);
            let (all, facts) = (domain.facts(), surface_facts(&domain));
            assert_eq!((all.vertices, all.faces), (72 * 4_usize.pow(level), 144 * 4_usize.pow(level)));
            assert_eq!((facts.genus, facts.closed, facts.manifold), (Some(1), true, true));
            assert_eq!((facts.degenerate_faces, facts.flipped_faces), (0, 0));
            for p in domain.positions().unwrap() {
                assert!(((p[0].hypot(p[1]) - major).hypot(p[2]) - minor).abs() < 1e-14);
            }
            assert!(outward_volume(&domain) > 0.0);
            defects.push(4.0 * pi * pi * major * minor - facts.area);
        }
        assert!(defects.windows(2).skip(1).all(|w| (w[0] / w[1] - 4.0).abs() < 0.2), "{defects:?}");
    }

    #[test]
    fn a_tube_that_meets_itself_is_refused() {
        let error = super::ENTRY.run(None, &crate::generate::testing::given(&[("minor", "2")]), 0).unwrap_err();
        assert!(error.to_string().contains("must be below major"), "{error}");
    }
}
