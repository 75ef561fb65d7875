//! How the area of a surface is shared out among its vertices: the shares of the known mass matrices, and the bounds of any.
//!
//! # Definition
//! In a triangle of area A with angles α, β, γ the corner at α gets `A/3` (barycentric; also the row sum of the consistent
//! mass, `A/6 + 2·A/12`), or the signed circumcentric part `⅛ (b² cot β + c² cot γ) = ¼ (1 + cot β cot γ) A`, or that part in
//! triangles without an obtuse angle and `A/2` at, `A/4` beside an obtuse one (mixed).
//!
//! # Bounds
//! Without an obtuse angle `cot β cot γ` lies in [0, 1], so the circumcentric part lies in [A/4, A/2]; so does the mixed part
//! always, and A/3. With `f = ¼ (1 + cot β cot γ)` every known share of a triangle is therefore in
//! `[min(¼, f), max(½, f)]·A`, and the share of a vertex between the sums of these over its star.

use super::compensated::Sum;
use super::condition::{Element, Shape};
use super::tolerance::{Scales, Threshold, UNIT_ROUNDOFF};
use crate::domain::geometry::orient3d;
use crate::domain::{Surface, geometry};
use crate::linalg::parallel;

/// The shares of one vertex.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Share {
    /// The area of the star.
    pub star: f64,
    /// A third of it.
    pub third: f64,
    /// The signed circumcentric area.
    pub voronoi: f64,
    /// The mixed area of Meyer et al.
    pub mixed: f64,
    /// No known mass gives less …
    pub lower: f64,
    /// … and none more.
    pub upper: f64,
    /// What a difference of shares is measured against.
    pub threshold: Threshold,
    /// The same for circumcentric shares, whose parts cancel.
    pub voronoi_threshold: Threshold,
}

/// The signed circumcentric part of a corner.
pub(crate) fn voronoi(shape: &Shape, corner: usize) -> f64 {
    let (b, c) = ((corner + 1) % 3, (corner + 2) % 3);
    0.125 * (shape.squared_length(b) * shape.cotangent[b] + shape.squared_length(c) * shape.cotangent[c])
}

/// The mixed part of a corner, whose circumcentric part is known.
fn mixed(shape: &Shape, corner: usize, voronoi: f64) -> f64 {
    let [x, y, z] = shape.cotangent;
    match () {
        () if x >= 0.0 && y >= 0.0 && z >= 0.0 => voronoi,
        () if shape.cotangent[corner] < 0.0 => 0.5 * shape.area,
        () => 0.25 * shape.area,
    }
}

/// The shares of all vertices, gathered over the faces around each in face order. Degenerate faces have none; of a polygon
/// only the area of the star is known, and a share between nothing and that.
pub(crate) fn of(surface: &Surface, scales: &Scales) -> Vec<Share> {
    let topology = surface.topology();
    let faces = surface.faces();
    let known = scales.geometry().triangles.as_ref().map(|t| &t.faces);
    parallel::collect(surface.positions().len(), |v| {
        let (mut s, mut circumscribed) = (Share::default(), 0.0);
        for at in topology.star(v) {
            let (face, corner) = (at.face(), at.corner());
            let of_polygons = if known.is_none() { Shape::of_face(surface, face) } else { None };
            let Some(shape) = known.map_or(of_polygons.as_ref(), |known| known[face].shape()) else {
                if faces[face].len() > 3 {
                    s.star += surface.face_area(face);
                    s.upper += surface.face_area(face);
                }
                continue;
            };
            let part = voronoi(shape, corner);
            s.star += shape.area;
            s.third += shape.area;
            s.voronoi += part;
            s.mixed += mixed(shape, corner, part);
            s.lower += part.min(0.25 * shape.area);
            s.upper += part.max(0.5 * shape.area);
            circumscribed += shape.squared_length(corner) * shape.squared_cosecant(corner);
        }
        s.third /= 3.0;
        let q = scales.condition(v);
        s.threshold = Threshold::over(s.star, topology.star(v).len(), q);
        // ⅛ b² cot β is off by ⅛ b²·8u/sin² β = u D², D the circumdiameter, in each of two terms; as much again for ours.
        let explained = 4.0 * UNIT_ROUNDOFF * circumscribed;
        s.voronoi_threshold = s.threshold.plus(Threshold { explained, defect: 4.0 * q * explained });
        s
    })
}

/// The total area, and what a total is measured against as far as the area's own rounding goes; kept by
/// [`Trial::area`](crate::property::Trial).
pub(crate) fn area(surface: &Surface, scales: &Scales) -> (f64, Threshold) {
    let face = |face: usize| match &scales.geometry().triangles {
        Some(triangles) => {
            let element: &Element = &triangles.faces[face];
            (element.shape().map_or(0.0, |s| s.area), element.condition().unwrap_or(1.0))
        }
        None => match Shape::of_face(surface, face) {
            Some(shape) => (shape.area, shape.condition()),
            None if surface.faces()[face].len() == 3 => (0.0, 1.0),
            None => (surface.face_area(face), 1.0),
        },
    };
    let block = |range: std::ops::Range<usize>| {
        let (mut total, mut threshold) = (Sum::default(), Threshold::NONE);
        for at in range {
            let (area, q) = face(at);
            total.add(area);
            threshold = threshold.plus(Threshold::over(area, surface.faces()[at].len(), q));
        }
        (total, threshold)
    };
    let (mut total, mut threshold) = (Sum::default(), Threshold::NONE);
    for (area, explained) in parallel::blocks(surface.faces().len(), block) {
        total.add_sum(area);
        threshold = threshold.plus(explained);
    }
    (total.value(), threshold)
}

/// Whether every face lies in a plane. Exact.
pub(crate) fn has_planar_faces(surface: &Surface) -> bool {
    if surface.is_triangulated() {
        return true;
    }
    let at = |v: usize| surface.positions()[v];
    surface.faces().iter().filter(|f| f.len() > 3).all(|f| {
        let fan = f[1..].windows(2).map(|w| [at(f[0]), at(w[0]), at(w[1])]);
        let proper = fan.into_iter().find(|&[a, b, c]| !geometry::collinear(a, b, c));
        proper.is_none_or(|[a, b, c]| f.iter().all(|&v| orient3d(a, b, c, at(v)).is_eq()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::geometry::Vec3;

    fn shape(apex: [f64; 2]) -> Shape {
        Shape::of([Vec3::zeros(), Vec3::x(), Vec3::new(apex[0], apex[1], 0.0)]).unwrap()
    }

    #[test]
    fn the_parts_of_a_triangle_add_up_to_its_area() {
        for apex in [[0.5, 0.8], [0.0, 1.0], [-0.7, 0.3], [0.5, 0.01]] {
            let s = shape(apex);
            let total = |part: &dyn Fn(usize) -> f64| (0..3).map(part).sum::<f64>();
            assert!((total(&|c| voronoi(&s, c)) / s.area - 1.0).abs() < 1e-9, "{apex:?}");
            assert!((total(&|c| mixed(&s, c, voronoi(&s, c))) / s.area - 1.0).abs() < 1e-12, "{apex:?}");
        }
    }

    #[test]
    fn the_circumcentric_part_has_its_closed_form_and_the_mixed_part_its_bounds() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        for _ in 0..1000 {
            let s = shape([3.0 * random() - 1.0, 0.05 + random()]);
            for c in 0..3 {
                let f = 0.25 * (1.0 + s.cotangent[(c + 1) % 3] * s.cotangent[(c + 2) % 3]);
                assert!((voronoi(&s, c) - f * s.area).abs() < 1e-12 * (1.0 + f.abs()));
                let relative = mixed(&s, c, voronoi(&s, c)) / s.area;
                assert!((0.25 - 1e-12..=0.5 + 1e-12).contains(&relative));
            }
        }
    }
}
