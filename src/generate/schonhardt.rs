//! Twisted nested triangles, the planar relatives of Schönhardt's polyhedron.
//!
//! # Definition
//! Triangle `r` of `nested + 1` has the corners `ratioʳ (cos φ, sin φ)`, `φ = 120° k + r · twist`. Between two triangles
//! each of the three quadrilaterals o_k o_{k+1} i_{k+1} i_k is cut by the diagonal from the outer corner o_k to the inner
//! corner i_{k+1}; the innermost triangle is a face. Every triangle is counter-clockwise iff
//! `cos(twist + 60°) > ratio/2` and `ratio · cos(twist + 60°) < ½`; checked exactly, refused otherwise.
//!
//! # Why
//! Turning the inner triangles by a small positive angle keeps their sides, and changes the squared length of o_k i_k at
//! the rate `2 ratio sin(twist)` and that of o_k i_{k+1} at `2 ratio sin(twist + 120°)`. For `0 ≤ twist < 60°` no edge
//! becomes shorter and some become longer, so that no positive weights are in equilibrium at the inner vertices: by Farkas
//! the triangulation is not regular and no operator has SYM, LOC, LIN and POS at once \[wardetzky2007\]. For
//! `−120° < twist < 0` one ring is regular: lifting the inner triangle makes every edge convex. A positive twist is the
//! Schönhardt-like one; twist 0 is the boundary case, in which weights in equilibrium exist but cannot all be positive. At
//! twist 0 this is exact for a ratio that is a power of two; else the rounding of the corners decides which case it is.

use super::shape::circle;
use super::shape::input::impossible;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface, geometry};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "schonhardt",
    name: "twisted nested triangles in the style of Schönhardt",
    guarantees: &[
        "3(nested+1) vertices, ring by ring from the outside, 6·nested+1 triangles, all counter-clockwise (exact)",
        "planar, manifold, connected, genus 0, one boundary loop of three edges, area 3√3/4",
        "0 < twist < 60°: not regular, no positive weights in equilibrium; −120° < twist < 0 with one ring: regular",
    ],
    sources: &["schonhardt1928", "wardetzky2007"],
    parameters: &[
        Parameter {
            name: "twist",
            meaning: "rotation of each triangle against the next outer one, radians",
            default: "0.3",
            range: Range::Number(-7.0, 7.0),
        },
        Parameter {
            name: "nested",
            meaning: "how many triangles are nested inside the outer one",
            default: "1",
            range: Range::Whole(1, 300),
        },
        Parameter {
            name: "ratio",
            meaning: "size of each triangle over the next outer one",
            default: "0.4",
            range: Range::Number(0.01, 0.99),
        },
    ],
    make: Make::Source(make),
};

/// Areas squared, which lengths of cross products go through, must stay far above the smallest number: 1e-50⁴ = 1e-200.
const SMALLEST: f64 = 1e-50;

fn make(settings: &Settings, _: &mut Stream) -> Result<Domain, GenerateError> {
    let (twist, nested, ratio) = (settings.number("twist"), settings.whole("nested"), settings.number("ratio"));
    let mut points = Vec::with_capacity(3 * (nested + 1));
    let mut size = 1.0;
    for ring in 0..=nested {
        let [c, s] = circle::direction(ring as f64 * twist);
        points
            .extend((0..3).map(|k| circle::turn(k, 3)).map(|[x, y]| [size * (c * x - s * y), size * (s * x + c * y)]));
        size *= ratio;
    }
    if size < SMALLEST * ratio {
        let why =
            format!("the innermost triangle would be smaller than {SMALLEST:e}; nest fewer or choose a larger ratio");
        return Err(impossible("schonhardt", why));
    }
    let faces = faces(nested);
    let folded = |f: &&[usize; 3]| !geometry::orient2d(points[f[0]], points[f[1]], points[f[2]]).is_gt();
    if let Some([a, b, c]) = faces.iter().find(folded) {
        let why = format!(
            "triangle ({a}, {b}, {c}) is not counter-clockwise; with ratio {ratio} the twist must satisfy \
             cos(twist + 60°) > {:.3} and cos(twist + 60°) < {:.3}",
            ratio / 2.0,
            0.5 / ratio
        );
        return Err(impossible("schonhardt", why));
    }
    Ok(Surface::planar(&points, &faces)?.into())
}

fn faces(nested: usize) -> Vec<[usize; 3]> {
    let ring = |r: usize| {
        (0..3).flat_map(move |k| {
            let corner = |ring: usize, k: usize| 3 * ring + k % 3;
            let (o, p, i, j) = (corner(r, k), corner(r, k + 1), corner(r + 1, k), corner(r + 1, k + 1));
            [[o, p, j], [o, j, i]]
        })
    };
    let inner = 3 * nested;
    (0..nested).flat_map(ring).chain([[inner, inner + 1, inner + 2]]).collect()
}

#[cfg(test)]
mod tests {
    use std::cmp::Ordering;

    use crate::domain::{Domain, geometry};
    use crate::generate::testing::{disc, given, make};
    use crate::scalar::{Rational, Scalar};

    fn twisted(twist: f64, nested: usize) -> Domain {
        make("schonhardt", &[("twist", &twist.to_string()), ("nested", &nested.to_string())], 0)
    }

    #[test]
    fn counts_area_and_orientation_are_those_of_the_definition() {
        for nested in [1, 2, 7, 40] {
            for twist in [-1.9, -0.6, -0.1, 0.0, 0.1, 0.32] {
                let domain = twisted(twist, nested);
                let facts = disc(&domain);
                assert_eq!((domain.vertex_count(), domain.facts().faces), (3 * (nested + 1), 6 * nested + 1));
                assert_eq!(facts.boundary_edges, 3);
                assert!((facts.area - 0.75 * 3_f64.sqrt()).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn a_twist_that_folds_a_triangle_is_refused_exactly_where_the_formula_says() {
        for ratio in [0.2, 0.4, 0.7, 0.9] {
            for step in -62..=62 {
                let twist = f64::from(step) * 0.05;
                let cosine = (twist + std::f64::consts::FRAC_PI_3).cos();
                let allowed = cosine > ratio / 2.0 && cosine < 0.5 / ratio;
                let given = given(&[("twist", &twist.to_string()), ("ratio", &ratio.to_string())]);
                assert_eq!(super::ENTRY.run(None, &given, 0).is_ok(), allowed, "twist {twist}, ratio {ratio}");
            }
        }
    }

    /// The rates `(y_i − y_j)·(x_i − x_j)` of all inner edges for the motion that turns every inner triangle by the same
    /// angle, in rational arithmetic.
    fn rates_of_turning(domain: &Domain) -> Vec<Ordering> {
        let at = domain.as_surface().unwrap().planar_positions::<Rational>().unwrap();
        let motion = |v: usize| {
            let [x, y] = at[v].clone();
            if v < 3 { [Rational::zero(), Rational::zero()] } else { [-y, x] }
        };
        let minus = |a: [Rational; 2], b: [Rational; 2]| [a[0].clone() - b[0].clone(), a[1].clone() - b[1].clone()];
        let inner = domain.edges().iter().filter(|e| e[1] >= 3);
        inner
            .map(|&[i, j]| geometry::dot(&minus(motion(i), motion(j)), &minus(at[i].clone(), at[j].clone())).cmp_zero())
            .collect()
    }

    #[test]
    fn a_positive_twist_has_an_exact_certificate_that_no_positive_weights_exist() {
        for twist in [0.05, 0.2, 0.3] {
            for nested in [1, 2, 5] {
                let rates = rates_of_turning(&twisted(twist, nested));
                assert!(rates.iter().all(|r| r.is_ge()));
                assert_eq!(
                    rates.iter().filter(|r| r.is_gt()).count(),
                    6,
                    "three struts and three diagonals of the first ring"
                );
            }
        }
        let straight = make("schonhardt", &[("twist", "0"), ("ratio", "0.5")], 0);
        let rates = rates_of_turning(&straight);
        assert!(rates.iter().all(|r| r.is_ge()) && rates.iter().filter(|r| r.is_gt()).count() == 3);
        assert!(rates_of_turning(&twisted(-0.3, 1)).contains(&Ordering::Less), "the certificate can fail");
    }

    /// Whether the lift with z = 0 outside and z = −1 inside is strictly convex across every inner edge. Exact.
    fn lift_is_convex(domain: &Domain) -> bool {
        let s = domain.as_surface().unwrap();
        let lifted = |v: usize| [s.positions()[v][0], s.positions()[v][1], if v < 3 { 0.0 } else { -1.0 }];
        (0..domain.edges().len()).filter(|&e| !s.topology().is_boundary_edge(e)).all(|e| {
            let (face, _) = s.opposite(e)[0];
            let (_, other) = s.opposite(e)[1];
            let [a, b, c] = s.triangle(face).unwrap().map(lifted);
            // robust's orientation: negative when the fourth point is above the plane of three counter-clockwise points.
            geometry::orient3d(a, b, c, lifted(other)).is_lt()
        })
    }

    #[test]
    fn a_negative_twist_has_a_strictly_convex_lift_and_no_other_has_this_one() {
        assert!([-2.0, -1.0, -0.3, -0.01].iter().all(|&t| lift_is_convex(&twisted(t, 1))));
        assert!([0.01, 0.3, -2.2].iter().all(|&t| !lift_is_convex(&twisted(t, 1))));
    }
}
