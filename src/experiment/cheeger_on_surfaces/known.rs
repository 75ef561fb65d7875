//! Surfaces whose Cheeger constant and first eigenvalue are known in closed form, with the reason.
//!
//! # Definition
//! `λ_C = inf length(∂A) / min(area A, area B)` over the partitions of a closed surface into A and B by curves [Cheeger 1970],
//! as the primer has it. With a boundary there are two constants, each with its own eigenvalue, and the inequality
//! `λ_C²/4 ≤ λ₁` holds for each: *free*, the same with the part of ∂A inside the surface alone, and λ₁ the first eigenvalue above zero of
//! the natural condition; *fixed*, the infimum of `length(∂A)/area A` over A inside, and λ₁ the first eigenvalue of functions that vanish on the
//! boundary. The primer's statement is the closed one.
//!
//! # The constants, and why
//! Each is the ratio of a cut that is written down below, so that none can be too large. That none is too small:
//!
//! * *Sphere of radius one*: curves that bound the area A on it are at least `√(A(4π − A))` long (Osserman 1978), so the ratio is at
//!   least `√(4π/A − 1) ≥ 1` for `A ≤ 2π`.
//! * *Flat torus of area T with the shortest closed line ℓ*: if ∂A contains a curve that is not contractible it contains two, since
//!   it bounds, each at least ℓ long: ratio at least `2ℓ/(T/2)`. Otherwise ∂A lifts to the plane, and A or B lies inside of it:
//!   length at least `2√(π a)`, a the smaller area, so the ratio is at least `2√(2π/T)`. That is the larger one, since
//!   `ℓ² ≤ 2T/√3 < πT/2`. Hence `λ_C = 4ℓ/T`. (Howards, Hutchings and Morgan 1999 have all minimisers.)
//! * *Rectangle with free boundary, a ≥ b*: A reflected in the sides is a part of the torus 2a × 2b, with four times its area and
//!   its length; the torus has `4/(2a)`. Attained in the middle: `2/a`. A thin one has the constant and the eigenvalue of the
//!   interval.
//! * *Disc of radius one with free boundary*: among the parts of at most half its area the half disc has the smallest
//!   `length²/area`, 8/π (Burago and Maz'ya 1969), and `length/area ≥ √(8/(π a)) ≥ 4/π`.
//! * *Disc with fixed boundary*: `length ≥ 2√(πa)` and `a ≤ π`: 2.
//! * *Convex polygon with fixed boundary*: the optimal part is the union of the discs of radius `ρ = 1/λ_C` inside, and ρ is where the
//!   inner parallel polygon has the area πρ² (Kawohl and Lachand-Robert 2006). For the rectangle `(a − 2ρ)(b − 2ρ) = πρ²`; for a
//!   triangle with inradius R, `T(1 − ρ/R)² = πρ²`. The unit square: `(4 − π)/(2 − √π)`.
//!
//! Eigenvalues: separation of variables, and Lamé's for the triangle (Chavel 1984, chapter II; McCartin 2003).

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::patchwork::{Boundary, Patchwork};
use crate::generate;

/// The first zero of J₀.
const J0_ZERO: f64 = 2.404_825_557_695_773;

/// The first zero of J₁′.
const J1_PRIME_ZERO: f64 = 1.841_183_781_340_659_3;

/// A surface with what is known of it.
#[derive(Clone)]
pub struct Known {
    /// What it is.
    pub name: &'static str,
    /// Its boundary.
    pub boundary: Boundary,
    /// The length of an optimal cut.
    pub length: f64,
    /// The smaller area that it cuts off.
    pub area: f64,
    /// The first eigenvalue above zero.
    pub eigenvalue: f64,
    /// How many copies it has.
    pub copies: usize,
    /// How the mesh stands to the surface.
    pub likeness: Likeness,
    /// An eigenfunction with an optimal cut among its level sets; `None` where no level set is optimal.
    pub guide: Option<fn([f64; 3]) -> f64>,
    /// The mesh, by level of refinement from 0.
    pub mesh: fn(usize) -> Option<Patchwork>,
}

/// How a mesh stands to the surface: what a cut of the mesh says of cuts of the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Likeness {
    /// It is the surface.
    Same,
    /// It lies inside a planar surface, whose boundary is fixed.
    Inside,
    /// It is inscribed in the unit sphere. Projection from the centre makes curves at most `1/d` times as long and areas at
    /// least d times as large, d the distance of the nearest triangle's plane from the centre.
    InSphere,
    /// It is a regular polygon inscribed in the unit circle. Stretching the rays from the centre makes no area smaller, and curves
    /// at most `(1 + sin φ)/cos φ` times as long, φ half the angle of a side.
    InDisc,
}

impl Likeness {
    /// A ratio of the mesh is at least this times the constant of the surface.
    pub fn factor(self, mesh: &Patchwork) -> f64 {
        match self {
            Likeness::Same | Likeness::Inside => 1.0,
            Likeness::InSphere => mesh.inradius().powi(2),
            Likeness::InDisc => mesh.half_angle().cos() / (1.0 + mesh.half_angle().sin()),
        }
    }

    /// Whether the eigenvalue of linear elements is at least that of the surface: functions on the mesh, or their extensions by
    /// zero, are functions on the surface (min-max).
    pub fn is_from_above(self) -> bool {
        matches!(self, Likeness::Same | Likeness::Inside)
    }
}

impl Known {
    /// The Cheeger constant.
    pub fn constant(&self) -> f64 {
        self.length / self.area
    }
}

/// The radius ρ of the optimal part of an a × b rectangle with fixed boundary.
fn rectangle_radius(a: f64, b: f64) -> f64 {
    a * b / (a + b + ((a - b).powi(2) + PI * a * b).sqrt())
}

/// Length and area of the a × b rectangle with its corners rounded by quarter circles of radius ρ.
fn rounded_rectangle(a: f64, b: f64) -> [f64; 2] {
    let rho = rectangle_radius(a, b);
    [2.0 * (a + b) - (8.0 - 2.0 * PI) * rho, a * b - (4.0 - PI) * rho * rho]
}

/// Length and area of the equilateral triangle of side one with its corners rounded by its optimal radius: the inner parallel
/// triangle with a disc of that radius added at each of its points.
fn rounded_triangle() -> [f64; 2] {
    let (perimeter, area) = (3.0, 0.25 * 3f64.sqrt());
    let inradius = 2.0 * area / perimeter;
    let rho = 1.0 / (1.0 / inradius + (PI / area).sqrt());
    let shrunk = 1.0 - rho / inradius;
    let inner = shrunk * perimeter;
    [inner + 2.0 * PI * rho, shrunk * shrunk * area + inner * rho + PI * rho * rho]
}

fn generated(id: &str, level: usize) -> Option<Patchwork> {
    let given = BTreeMap::from([("levels".to_string(), level.to_string())]);
    let domain = generate::find(id)?.run(None, &given, 0).ok()?;
    Patchwork::of(domain.as_surface()?, domain.boundary())
}

fn rectangle(a: f64, b: f64, cells: [usize; 2], level: usize, periodic: bool) -> Option<Patchwork> {
    let cells = cells.map(|n| n << level);
    Some(Patchwork::parallelogram([[a, 0.0], [0.0, b]], cells, periodic))
}

const HEXAGONAL: [[f64; 2]; 2] = [[1.0, 0.0], [0.5, 0.866_025_403_784_438_6]];

/// All of them.
pub fn all() -> Vec<Known> {
    let hexagon = 0.5 * 3f64.sqrt();
    let pi2 = PI * PI;
    let [square, oblong, triangle] = [rounded_rectangle(1.0, 1.0), rounded_rectangle(2.0, 1.0), rounded_triangle()];
    let closed = |name, [length, area]: [f64; 2], eigenvalue, copies| Known {
        name,
        boundary: Boundary::Closed,
        length,
        area,
        eigenvalue,
        copies,
        likeness: Likeness::Same,
        guide: Some(|p| (2.0 * PI * p[0]).cos()),
        mesh: |_| None,
    };
    let free = |name, cut, eigenvalue, copies| Known {
        boundary: Boundary::Free,
        guide: Some(|p| (PI * p[0]).cos()),
        ..closed(name, cut, eigenvalue, copies)
    };
    let fixed =
        |name, cut, eigenvalue| Known { boundary: Boundary::Fixed, guide: None, ..closed(name, cut, eigenvalue, 1) };
    vec![
        Known {
            likeness: Likeness::InSphere,
            guide: Some(|p| p[2]),
            mesh: |k| generated("icosphere", k + 1),
            ..closed("sphere of radius 1", [2.0 * PI, 2.0 * PI], 2.0, 3)
        },
        Known {
            mesh: |k| rectangle(1.0, 0.5, [8, 4], k, true),
            ..closed("flat torus 1 × ½", [1.0, 0.25], 4.0 * pi2, 2)
        },
        Known { mesh: |k| rectangle(1.0, 1.0, [6, 6], k, true), ..closed("square torus", [2.0, 0.5], 4.0 * pi2, 4) },
        Known {
            // The shortest dual vectors have the length 2/√3; one of them is (0, 2/√3).
            guide: Some(|p| (2.0 * PI * p[1] / HEXAGONAL[1][1]).cos()),
            mesh: |k| Some(Patchwork::parallelogram(HEXAGONAL, [6 << k; 2], true)),
            ..closed("hexagonal torus", [2.0, 0.5 * hexagon], 16.0 * pi2 / 3.0, 6)
        },
        Known { mesh: |k| rectangle(1.0, 1.0, [6, 6], k, false), ..free("square, free boundary", [1.0, 0.5], pi2, 2) },
        Known {
            guide: Some(|p| (0.5 * PI * p[0]).cos()),
            mesh: |k| rectangle(2.0, 1.0, [8, 4], k, false),
            ..free("rectangle 2 × 1, free boundary", [1.0, 1.0], 0.25 * pi2, 1)
        },
        Known {
            mesh: |k| rectangle(1.0, 0.125, [8, 1], k, false),
            ..free("interval as a strip 1 × ⅛, free boundary", [0.125, 0.0625], pi2, 1)
        },
        Known {
            likeness: Likeness::InDisc,
            guide: Some(|p| p[0]),
            mesh: |k| generated("disk", k + 2),
            ..free("disc of radius 1, free boundary", [2.0, 0.5 * PI], J1_PRIME_ZERO.powi(2), 2)
        },
        Known {
            likeness: Likeness::Inside,
            // Level zero of the only mode is the boundary, and that is optimal.
            guide: Some(|p| 1.0 - p[0] * p[0] - p[1] * p[1]),
            mesh: |k| generated("disk", k + 2),
            ..fixed("disc of radius 1, fixed boundary", [2.0 * PI, PI], J0_ZERO.powi(2))
        },
        Known { mesh: |k| rectangle(1.0, 1.0, [6, 6], k, false), ..fixed("square, fixed boundary", square, 2.0 * pi2) },
        Known {
            mesh: |k| rectangle(2.0, 1.0, [8, 4], k, false),
            ..fixed("rectangle 2 × 1, fixed boundary", oblong, 1.25 * pi2)
        },
        Known {
            mesh: |k| Some(Patchwork::triangle(HEXAGONAL, 6 << k)),
            ..fixed("equilateral triangle of side 1, fixed boundary", triangle, 16.0 * pi2 / 3.0)
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rounded_polygons_have_one_over_their_radius_as_ratio() {
        for (a, b) in [(1.0, 1.0), (2.0, 1.0), (8.0, 1.0)] {
            let [length, area] = rounded_rectangle(a, b);
            assert!((length / area * rectangle_radius(a, b) - 1.0).abs() < 1e-14, "{a} {b}");
            // The printed formula for the rectangle.
            let printed = (4.0 - PI) / (a + b - ((a - b).powi(2) + PI * a * b).sqrt());
            assert!((length / area / printed - 1.0).abs() < 1e-13);
        }
        let square = rounded_rectangle(1.0, 1.0);
        assert!((square[0] / square[1] - (4.0 - PI) / (2.0 - PI.sqrt())).abs() < 1e-13);
        // For a polygon around a circle: (P + √(4πT))/(2T).
        let [length, area] = rounded_triangle();
        let (perimeter, whole) = (3.0, 0.25 * 3f64.sqrt());
        assert!((length / area - (perimeter + (4.0 * PI * whole).sqrt()) / (2.0 * whole)).abs() < 1e-13);
    }

    #[test]
    fn other_radii_and_other_curves_are_no_better() {
        // Corners rounded by another radius.
        let best = rounded_rectangle(1.0, 1.0);
        for rho in (1..50).map(|k| f64::from(k) / 100.0) {
            let [length, area] = [4.0 - (8.0 - 2.0 * PI) * rho, 1.0 - (4.0 - PI) * rho * rho];
            assert!(length / area >= best[0] / best[1] - 1e-14, "{rho}");
        }
        // Arcs that meet the unit circle at right angles, through the ends of a chord of half angle φ: the curves of constant
        // curvature that can be optimal.
        for phi in (1..100).map(|k| f64::from(k) / 100.0 * 0.5 * PI) {
            let (radius, turn) = (phi.tan(), PI - 2.0 * phi);
            let area = 0.5 * (2.0 * phi - (2.0 * phi).sin()) + 0.5 * radius * radius * (turn - turn.sin());
            assert!(radius * turn / area >= 4.0 / PI, "{phi}");
        }
        // Quarter circles in the corner of a free rectangle, up to half its area; discs on tori.
        for (a, b) in [(1.0, 1.0), (2.0, 1.0)] {
            for r in (1..=100).map(|k| f64::from(k) / 100.0 * (2.0 * a * b / PI).sqrt()).filter(|r| *r <= b) {
                assert!(0.5 * PI * r / (0.25 * PI * r * r) >= 2.0 / a, "{r}");
            }
        }
        for known in all().iter().filter(|k| k.boundary == Boundary::Closed && k.likeness == Likeness::Same) {
            assert!(2.0 * (PI / known.area).sqrt() > known.constant(), "{}", known.name);
        }
    }

    #[test]
    fn the_zeros_are_zeros_of_bessel_functions() {
        let series = |x: f64, order: i32, derivative: bool| {
            let mut sum = 0.0;
            let mut term = (0.5 * x).powi(order) / (1..=order).map(f64::from).product::<f64>();
            for k in 0..40 {
                sum += if derivative { term * f64::from(2 * k + order) / x } else { term };
                term *= -0.25 * x * x / (f64::from(k + 1) * f64::from(k + 1 + order));
            }
            sum
        };
        for (zero, order, derivative) in [(J0_ZERO, 0, false), (J1_PRIME_ZERO, 1, true)] {
            let f = |x: f64| series(x, order, derivative);
            assert!(f(zero - 1e-14) * f(zero + 1e-14) < 0.0);
            // The first one: no sign changes before.
            assert!((1..1000).all(|k| f(zero * f64::from(k) / 1000.0) * f(zero * 1e-3) > 0.0));
        }
    }

    #[test]
    fn guides_are_eigenfunctions_of_the_stated_eigenvalue_and_meshes_have_the_stated_area() {
        for known in all() {
            let mesh = (known.mesh)(2).unwrap();
            let whole = match known.boundary {
                Boundary::Fixed => None,
                _ => Some(2.0 * known.area),
            };
            assert!(whole.is_none_or(|area| (mesh.total() / area - 1.0).abs() < 0.03), "{}", known.name);
            if let Some(guide) = known.guide.filter(|_| known.likeness == Likeness::Same) {
                let [l, m] = mesh.matrices();
                let u: Vec<f64> = mesh.positions.iter().map(|p| guide(*p)).collect();
                let quotient = l.quadratic_form(&u) / m.quadratic_form(&u);
                assert!((quotient / known.eigenvalue - 1.0).abs() < 0.01, "{}: {quotient}", known.name);
            }
        }
    }
}
