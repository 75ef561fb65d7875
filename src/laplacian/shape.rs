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
        Some(Shape {
            cotangents: [cotangent(0)?, cotangent(1)?, cotangent(2)?],
            squared_lengths: squared_lengths(corners),
            doubled_area: geometry::doubled_area(corners[0], corners[1], corners[2]).magnitude(),
        })
    }
}

/// The triangles of a surface with their shapes; degenerate ones are refused or left out.
///
/// # Memory
/// 32 bytes a triangle over `f64`: lengths are computed when they are asked for.
pub struct Triangles<'a, S = f64> {
    surface: &'a Surface,
    /// Of each face its three cotangents and twice its area.
    angles: Vec<[S; 4]>,
    /// The squared lengths of each face where they are not computed from `f64`, else empty.
    squared_lengths: Vec<[S; 3]>,
    /// The degenerate faces, ascending.
    degenerate: Vec<usize>,
    /// The first face with a side whose square loses digits below the range of `f64`.
    too_short: Option<usize>,
    has_normal_areas: bool,
}

/// Beyond this the angles of a triangle are looked at with care: its sine is above 2⁻²¹ else.
const STEEP: f64 = 1_048_576.0;

/// 2⁻¹⁰²² · 2⁶²: a product of two numbers near its root still has all of its 53 bits.
const SMALLEST_SQUARE: f64 = 1e-289;

/// Faces that need a look.
#[derive(Default)]
struct Odd {
    degenerate: Vec<usize>,
    too_short: Option<usize>,
    without_normal_area: bool,
}

impl Odd {
    /// Looks at a face, unless one look at its angles shows that it is none of them: with cotangents up to 2²⁰ the sines are above
    /// 2⁻²¹, far beyond what rounding makes of a sine that is zero; and the sides are in proportion as the sines are, so that the
    /// square of the shortest is above 2⁻²¹ of the doubled area.
    fn look(&mut self, face: usize, [x, y, z, doubled_area]: [f64; 4], corners: [[f64; 3]; 3]) {
        let steep = x.abs().max(y.abs()).max(z.abs());
        if steep <= STEEP && doubled_area >= 4.0 * STEEP * SMALLEST_SQUARE && doubled_area.is_normal() {
            return;
        }
        let [p, q, r] = corners;
        let clear = [x, y, z].iter().any(|cot| cot.abs() <= STEEP);
        if !clear && geometry::collinear(p, q, r) {
            return self.degenerate.push(face);
        }
        self.without_normal_area |= !doubled_area.is_normal();
        let squares = squared_lengths([&p, &q, &r]);
        if squares.iter().any(|s| *s < SMALLEST_SQUARE) {
            self.too_short = self.too_short.or(Some(face));
        }
    }

    /// Those of both, those of `self` first.
    fn then(mut self, later: Self) -> Self {
        self.degenerate.extend(later.degenerate);
        self.too_short = self.too_short.or(later.too_short);
        self.without_normal_area |= later.without_normal_area;
        self
    }
}

impl<'a> Triangles<'a, f64> {
    /// Checks that every face is a triangle, finds the degenerate ones (exactly), computes the angles of the others.
    ///
    /// # Errors
    /// A face with more than three corners; a degenerate triangle, unless they are to be left out (`skip`).
    pub fn new(laplacian: &'static str, surface: &'a Surface, skip: bool) -> Result<Self, BuildError> {
        check_triangles(laplacian, surface)?;
        let (triples, _) = surface.faces().corners().as_chunks::<3>();
        let corners = |face: usize| triples[face].map(|v| surface.positions()[v]);
        let mut angles = vec![[0.0; 4]; triples.len()];
        let odd = parallel::fill(&mut angles, |first, block| {
            cotangent::of_triangles(|k| corners(first + k), block);
            let mut odd = Odd::default();
            block.iter().enumerate().for_each(|(k, angles)| odd.look(first + k, *angles, corners(first + k)));
            odd
        });
        let odd = odd.into_iter().fold(Odd::default(), Odd::then);
        if let (Some(&face), false) = (odd.degenerate.first(), skip) {
            let (corners, count) = (triples[face], odd.degenerate.len());
            return Err(BuildError::Degenerate { laplacian, face, corners, count });
        }
        let Odd { degenerate, too_short, without_normal_area } = odd;
        let has_normal_areas = !without_normal_area;
        Ok(Triangles { surface, angles, squared_lengths: Vec::new(), degenerate, too_short, has_normal_areas })
    }

    /// Refuses triangles so small that the squares of their sides lose digits below the range of `f64`.
    ///
    /// # Errors
    /// The first side shorter than about 3e-145.
    pub fn with_lengths(self, laplacian: &'static str) -> Result<Self, BuildError> {
        if let Some([i, j, _]) = self.too_short.and_then(|face| self.surface.triangle(face)) {
            return Err(BuildError::NotFinite { laplacian, i, j, value: "a length that underflows".into() });
        }
        Ok(self)
    }

    /// Whether the area of every triangle is a normal number.
    pub(super) fn have_normal_areas(&self) -> bool {
        self.has_normal_areas
    }
}

impl<'a, S: Scalar> Triangles<'a, S> {
    /// The exact triangles of a planar mesh; `None` unless all faces are triangles, none is degenerate and the mesh is
    /// planar ([`Surface::plane`]).
    pub fn in_plane(surface: &'a Surface) -> Option<Self> {
        let positions = surface.planar_positions::<S>()?;
        let (mut angles, mut squared_lengths) = (Vec::new(), Vec::new());
        for face in 0..surface.faces().len() {
            let shape = Shape::in_plane(surface.triangle(face)?.map(|v| &positions[v]))?;
            let [x, y, z] = shape.cotangents;
            angles.push([x, y, z, shape.doubled_area]);
            squared_lengths.push(shape.squared_lengths);
        }
        let (degenerate, too_short, has_normal_areas) = (Vec::new(), None, true);
        Some(Triangles { surface, angles, squared_lengths, degenerate, too_short, has_normal_areas })
    }

    /// The surface.
    pub fn surface(&self) -> &'a Surface {
        self.surface
    }

    /// The proper triangles: face, corners and shape.
    pub fn each(&self) -> impl Iterator<Item = (usize, [usize; 3], Shape<S>)> + Clone {
        (0..self.angles.len()).filter_map(|f| Some((f, self.surface.triangle(f)?, self.shape(f)?)))
    }

    /// Whether a triangle is not degenerate.
    #[inline]
    pub fn is_proper(&self, face: usize) -> bool {
        self.degenerate.is_empty() || self.degenerate.binary_search(&face).is_err()
    }

    /// The cotangents and twice the area of a triangle; `None` if it was left out.
    #[inline]
    pub(super) fn angles(&self, face: usize) -> Option<&[S; 4]> {
        self.is_proper(face).then(|| &self.angles[face])
    }

    /// The shape of a triangle; `None` if it was left out.
    #[inline]
    pub fn shape(&self, face: usize) -> Option<Shape<S>> {
        let [x, y, z, doubled_area] = self.angles(face)?.clone();
        let squared_lengths = match self.squared_lengths.get(face) {
            Some(known) => known.clone(),
            None => {
                let corners = self.surface.triangle(face)?.map(|v| self.surface.positions()[v]);
                // Coordinates are finite (checked by the surface), so each has its exact counterpart.
                let corners = corners.map(|p| p.map(|x| S::exactly(x).unwrap_or_else(S::zero)));
                squared_lengths(corners.each_ref())
            }
        };
        Some(Shape { cotangents: [x, y, z], squared_lengths, doubled_area })
    }

    /// The cotangents of the angles opposite an edge, in face order.
    #[inline]
    pub fn cotangents_opposite(&self, edge: usize) -> impl Iterator<Item = &S> + Clone {
        let sides = self.surface.topology().sides(edge).iter();
        sides.filter_map(|side| Some(&self.angles(side.face())?[LAST[side.corner()]]))
    }

    /// The number of triangles left out.
    pub fn skipped(&self) -> usize {
        self.degenerate.len()
    }

    /// The proper triangles beside an edge, each seen from the edge.
    pub fn beside(&self, edge: usize) -> impl Iterator<Item = Flank<S>> {
        self.surface.topology().sides(edge).iter().filter_map(|side| self.flank(side))
    }

    fn flank(&self, side: &Side) -> Option<Flank<S>> {
        let shape = self.shape(side.face())?;
        let (start, end) = (side.corner(), (side.corner() + 1) % 3);
        let (low, high) = if side.forward() { (start, end) } else { (end, start) };
        let apex = (side.corner() + 2) % 3;
        let opposite = self.surface.triangle(side.face())?[apex];
        Some(Flank { shape, corners: [low, high, apex], opposite })
    }
}

/// A triangle seen from one of its edges ij, i < j.
pub struct Flank<S> {
    /// Its shape.
    pub shape: Shape<S>,
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

/// The corner before each.
const LAST: [usize; 3] = [2, 0, 1];

/// The squared length of the side opposite each corner.
pub(super) fn squared_lengths<S: Scalar, const D: usize>(corners: [&[S; D]; 3]) -> [S; 3] {
    std::array::from_fn(|k| {
        let (p, q) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
        let side: [S; D] = std::array::from_fn(|axis| q[axis].clone() - p[axis].clone());
        geometry::dot(&side, &side)
    })
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
