//! The metric of a triangle as the constructions need it, and the triangles of a surface that have one.

use std::cmp::Ordering;

use super::BuildError;
use crate::domain::cotangent;
use crate::domain::geometry::{self, Vec3};
use crate::domain::{Surface, topology::Side};
use crate::linalg::parallel;
use crate::scalar::Scalar;

/// What the constructions need of a triangle, over `f64` or over the rationals (in the plane all of it is rational).
#[derive(Clone, Debug, PartialEq)]
pub struct Shape<S> {
    /// The cotangents of the angles at the three corners.
    pub cotangents: [S; 3],
    /// The squared length of the side opposite each corner.
    pub squared_lengths: [S; 3],
    /// Twice the area, positive.
    pub doubled_area: S,
}

impl Shape<f64> {
    /// Of a triangle in space: cotangents as [`cotangent::of_triangle`] has them, right to the last digit; nothing over- or
    /// underflows on the way.
    #[inline]
    pub fn in_space(corners: [Vec3; 3]) -> Self {
        let sides: [Vec3; 3] = std::array::from_fn(|k| corners[(k + 2) % 3] - corners[(k + 1) % 3]);
        let found = cotangent::of_triangle(corners);
        Shape {
            cotangents: found.values,
            squared_lengths: sides.map(|side| side.norm_squared()),
            doubled_area: found.doubled_area,
        }
    }
}

impl<S: Scalar> Shape<S> {
    /// Of a triangle in the plane, exactly over the rationals; `None` if it is degenerate.
    pub fn in_plane(corners: [&[S; 2]; 3]) -> Option<Self> {
        let cotangent = |k: usize| geometry::cotangent_in_plane(corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
        let squared = |k: usize| {
            let (p, q) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
            let side: [S; 2] = std::array::from_fn(|axis| q[axis].clone() - p[axis].clone());
            geometry::dot(&side, &side)
        };
        Some(Shape {
            cotangents: [cotangent(0)?, cotangent(1)?, cotangent(2)?],
            squared_lengths: [squared(0), squared(1), squared(2)],
            doubled_area: geometry::doubled_area(corners[0], corners[1], corners[2]).magnitude(),
        })
    }
}

/// The triangles of a surface with their shapes; degenerate ones are refused or left out.
pub struct Triangles<'a, S = f64> {
    surface: &'a Surface,
    shapes: Vec<Option<Shape<S>>>,
}

impl<'a> Triangles<'a, f64> {
    /// Checks that every face is a triangle, finds the degenerate ones (exactly), computes the shapes of the others.
    ///
    /// # Errors
    /// A face with more than three corners; a degenerate triangle, unless they are to be left out (`skip`).
    pub fn new(laplacian: &'static str, surface: &'a Surface, skip: bool) -> Result<Self, BuildError> {
        check_triangles(laplacian, surface)?;
        let shapes = parallel::collect(surface.faces().len(), |face| proper_shape(surface.triangle(face)?, surface));
        let triangles = Triangles { surface, shapes };
        if let (Some(face), false) = (triangles.shapes.iter().position(Option::is_none), skip) {
            let (corners, count) = (surface.triangle(face).unwrap_or_default(), triangles.skipped());
            return Err(BuildError::Degenerate { laplacian, face, corners, count });
        }
        Ok(triangles)
    }

    /// Refuses triangles so small that the squares of their sides lose digits below the range of `f64`.
    ///
    /// # Errors
    /// The first side shorter than about 3e-145.
    pub fn with_lengths(self, laplacian: &'static str) -> Result<Self, BuildError> {
        // 2⁻¹⁰²² · 2⁶²: a product of two numbers near its root still has all of its 53 bits.
        const SMALLEST: f64 = 1e-289;
        let underflows = |shape: &Shape<f64>| shape.squared_lengths.iter().any(|s| *s < SMALLEST);
        let found = self.each().find(|(_, _, shape)| underflows(shape)).map(|(_, corners, _)| corners);
        if let Some([i, j, _]) = found {
            return Err(BuildError::NotFinite { laplacian, i, j, value: "a length that underflows".into() });
        }
        Ok(self)
    }

    /// Whether the area of every triangle is a normal number.
    pub(super) fn have_normal_areas(&self) -> bool {
        self.shapes.iter().flatten().all(|shape| shape.doubled_area.is_normal())
    }
}

impl<'a, S: Scalar> Triangles<'a, S> {
    /// The exact triangles of a planar mesh; `None` unless all faces are triangles, none is degenerate and the mesh is
    /// planar ([`Surface::plane`]).
    pub fn in_plane(surface: &'a Surface) -> Option<Self> {
        let positions = surface.planar_positions::<S>()?;
        let shape = |f: usize| Shape::in_plane(surface.triangle(f)?.map(|v| &positions[v])).map(Some);
        let shapes = (0..surface.faces().len()).map(shape).collect::<Option<Vec<_>>>()?;
        Some(Triangles { surface, shapes })
    }

    /// The surface.
    pub fn surface(&self) -> &'a Surface {
        self.surface
    }

    /// The proper triangles: face, corners and shape.
    pub fn each(&self) -> impl Iterator<Item = (usize, [usize; 3], &Shape<S>)> + Clone {
        self.shapes.iter().enumerate().filter_map(|(f, shape)| Some((f, self.surface.triangle(f)?, shape.as_ref()?)))
    }

    /// Whether a triangle is not degenerate.
    pub fn is_proper(&self, face: usize) -> bool {
        self.shapes[face].is_some()
    }

    /// The shape of a triangle; `None` if it was left out.
    pub fn shape(&self, face: usize) -> Option<&Shape<S>> {
        self.shapes[face].as_ref()
    }

    /// The cotangents of the angles opposite an edge, in face order.
    pub fn cotangents_opposite(&self, edge: usize) -> impl Iterator<Item = &S> + Clone {
        let sides = self.surface.topology().sides(edge).iter();
        sides.filter_map(|side| Some(&self.shape(side.face())?.cotangents[(side.corner() + 2) % 3]))
    }

    /// The number of triangles left out.
    pub fn skipped(&self) -> usize {
        self.shapes.iter().filter(|s| s.is_none()).count()
    }

    /// The proper triangles beside an edge, each seen from the edge.
    pub fn beside(&self, edge: usize) -> impl Iterator<Item = Flank<'_, S>> {
        self.surface.topology().sides(edge).iter().filter_map(|side| self.flank(side))
    }

    fn flank(&self, side: &Side) -> Option<Flank<'_, S>> {
        let shape = self.shapes[side.face()].as_ref()?;
        let (start, end) = (side.corner(), (side.corner() + 1) % 3);
        let (low, high) = if side.forward() { (start, end) } else { (end, start) };
        let apex = (side.corner() + 2) % 3;
        let opposite = self.surface.triangle(side.face())?[apex];
        Some(Flank { shape, corners: [low, high, apex], opposite })
    }
}

/// A triangle seen from one of its edges ij, i < j.
pub struct Flank<'a, S> {
    /// Its shape.
    pub shape: &'a Shape<S>,
    /// Which corners of the shape are i, j, and the one opposite.
    pub corners: [usize; 3],
    /// The vertex opposite.
    pub opposite: usize,
}

fn check_triangles(laplacian: &'static str, surface: &Surface) -> Result<(), BuildError> {
    match surface.faces().iter().map(<[usize]>::len).enumerate().find(|&(_, corners)| corners != 3) {
        Some((face, corners)) => Err(BuildError::NotATriangle { laplacian, face, corners }),
        None => Ok(()),
    }
}

/// The shape of a triangle; `None` if it is degenerate (exactly).
///
/// Where a cotangent is at most 2²⁰ the sine of its angle is above 2⁻²¹, far beyond what rounding makes of a sine that is zero
/// ([`geometry::cotangent`]: its error is below 8u/sin²); only thinner triangles are asked exactly.
fn proper_shape(corners: [usize; 3], surface: &Surface) -> Option<Shape<f64>> {
    let shape = Shape::in_space(corners.map(|v| surface.point(v)));
    let clear = shape.cotangents.iter().any(|cot| cot.abs() <= 1_048_576.0);
    let [i, j, k] = corners.map(|v| surface.positions()[v]);
    (clear || !geometry::collinear(i, j, k)).then_some(shape)
}

/// The weight with its sign replaced by the exact one: zero where that is zero, and never zero where it is not.
///
/// The sign that is replaced was one of rounding, so the weight moves by no more than its rounding error.
pub(super) fn with_sign(weight: f64, sign: Ordering) -> f64 {
    if !weight.is_finite() {
        return weight;
    }
    match sign {
        Ordering::Less => -weight.abs().max(f64::MIN_POSITIVE),
        Ordering::Equal => 0.0,
        Ordering::Greater => weight.abs().max(f64::MIN_POSITIVE),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shape_of_the_3_4_5_triangle() {
        let shape = Shape::in_space([Vec3::zeros(), Vec3::x() * 4.0, Vec3::y() * 3.0]);
        assert_eq!(shape.squared_lengths, [25.0, 9.0, 16.0]);
        assert_eq!(shape.doubled_area, 12.0);
        assert_eq!(shape.cotangents[0], 0.0);
        assert!((shape.cotangents[1] - 4.0 / 3.0).abs() < 1e-15 && (shape.cotangents[2] - 0.75).abs() < 1e-15);
    }

    #[test]
    fn both_shapes_agree() {
        let p = [[0.5, -2.0], [3.25, 0.125], [-1.0, 7.0]];
        let planar = Shape::in_plane([&p[0], &p[1], &p[2]]).unwrap();
        let space = Shape::in_space(p.map(|[x, y]| Vec3::new(x, 0.0, y)));
        for k in 0..3 {
            assert!((planar.cotangents[k] - space.cotangents[k]).abs() < 1e-15);
            assert!((planar.squared_lengths[k] - space.squared_lengths[k]).abs() < 1e-13);
        }
        assert!((planar.doubled_area - space.doubled_area).abs() < 1e-14);
    }

    #[test]
    fn a_replaced_sign_keeps_the_magnitude_and_lets_a_nan_through() {
        assert_eq!(with_sign(-1e-17, Ordering::Greater), 1e-17);
        assert_eq!(with_sign(0.0, Ordering::Less), -f64::MIN_POSITIVE);
        assert_eq!(with_sign(1e-17, Ordering::Equal), 0.0);
        assert!(with_sign(f64::NAN, Ordering::Greater).is_nan());
    }
}
