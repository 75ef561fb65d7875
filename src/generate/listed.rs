//! A mesh written out in the recipe: its points and its faces.

use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "listed",
    name: "mesh written out: points and faces, as a smallest counterexample is",
    guarantees: &[
        "the vertices and faces that are listed, in their order; a point of two coordinates lies in the plane z = 0",
    ],
    sources: &[],
    parameters: &[
        Parameter {
            name: "points",
            meaning: "the points, coordinates apart by a space and points by ';'",
            default: "0 0;1 0;0 1",
            range: Range::Form("points of two or three finite coordinates, as in '0 0;1 0;0 1'", |text| {
                points(text).is_some()
            }),
        },
        Parameter {
            name: "faces",
            meaning: "the faces, corners apart by a space and faces by ';', the first point being 0",
            default: "0 1 2",
            range: Range::Form("faces of three or more corners, as in '0 1 2;1 3 2'", |text| faces(text).is_some()),
        },
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    // Both were checked against their form.
    let points = points(settings.get("points")).unwrap_or_default();
    let faces = faces(settings.get("faces")).unwrap_or_default();
    Ok(Surface::new(points, faces)?.into())
}

fn points(text: &str) -> Option<Vec<[f64; 3]>> {
    let point = |part: &str| {
        let x: Vec<f64> = part.split_whitespace().map(|w| w.parse().ok()).collect::<Option<_>>()?;
        let whole = x.iter().all(|x| x.is_finite());
        match *x.as_slice() {
            [x, y] if whole => Some([x, y, 0.0]),
            [x, y, z] if whole => Some([x, y, z]),
            _ => None,
        }
    };
    text.split(';').map(point).collect()
}

fn faces(text: &str) -> Option<Vec<Vec<usize>>> {
    let face = |part: &str| {
        let corners: Vec<usize> = part.split_whitespace().map(|w| w.parse().ok()).collect::<Option<_>>()?;
        (corners.len() >= 3).then_some(corners)
    };
    text.split(';').map(face).collect()
}

/// The call that lists a surface; two coordinates where the third is zero everywhere.
pub fn call<F: AsRef<[usize]>>(positions: &[[f64; 3]], faces: impl IntoIterator<Item = F>) -> String {
    let plane = positions.iter().all(|p| p[2] == 0.0);
    let point = |p: &[f64; 3]| p[..if plane { 2 } else { 3 }].iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let face = |f: F| f.as_ref().iter().map(usize::to_string).collect::<Vec<_>>().join(" ");
    let points: Vec<String> = positions.iter().map(point).collect();
    let faces: Vec<String> = faces.into_iter().map(face).collect();
    format!("listed:faces={},points={}", faces.join(";"), points.join(";"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::testing::{disc, given, make};

    #[test]
    fn a_listed_surface_lists_itself() {
        for (points, faces) in [("0 0;4 0;3 1;1 1", "0 1 2;0 2 3"), ("0 0 0;1 0 0.5;0 1 -1e-3", "0 1 2")] {
            let domain = make("listed", &[("points", points), ("faces", faces)], 0);
            let surface = domain.as_surface().unwrap();
            let text = call(surface.positions(), surface.faces());
            assert_eq!(text, format!("listed:faces={faces},points={}", points.replace("-1e-3", "-0.001")));
        }
        assert_eq!(disc(&make("listed", &[], 0)).area, 0.5);
    }

    #[test]
    fn a_corner_that_is_no_point_is_refused_by_the_domain_and_a_form_that_is_none_by_the_parameter() {
        let refused = |points: &str, faces: &str| {
            let settings = given(&[("points", points), ("faces", faces)]);
            ENTRY.run(None, &settings, 0).unwrap_err().to_string()
        };
        assert_eq!(refused("0 0;1 0;0 1", "0 1 3"), "face 0 names vertex 3, but the domain has 3 vertices (0 to 2)");
        let advice = "it must be points of two or three finite coordinates, as in '0 0;1 0;0 1'";
        assert!(refused("0 0;1;0 1", "0 1 2").ends_with(advice));
        assert!(refused("0 0;inf 0;0 1", "0 1 2").ends_with(advice));
        assert!(refused("0 0;1 0;0 1", "0 1").ends_with("as in '0 1 2;1 3 2'"));
    }
}
