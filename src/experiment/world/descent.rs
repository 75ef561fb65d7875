//! Flips to Delaunay in the plane, each with its term `κ w wᵀ` in exact arithmetic.
//!
//! For a counter-clockwise, strictly convex quadrilateral a, b, c, d with the affine dependency `w = ([bcd], −[acd], [abd], −[abc])`
//! of its corners, `[xyz]` twice the area of a triangle,
//! ```text
//! L_ac − L_bd = κ w wᵀ,   κ = incircle(a, b, c, d) / (2 [abc] [acd] [abd] [bcd])
//! ```
//! Both sides take affine functions to zero: on those the two triangulations have the same gradient in the quadrilateral and
//! the same flux through its sides. So the difference of the two symmetric matrices, of four rows, is a multiple of `w wᵀ`; at
//! `(a, c)` it is `−ω_ac`, which is `incircle(a, b, c, d) / (2 [abc] [acd])`, and `w_a w_c = [bcd] [abd]`.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use crate::domain::flip::{FlipError, Quad, Triangulation};
use crate::domain::{Surface, geometry};
use crate::laplacian::cotan::stiffness_in_plane;
use crate::property::evidence::Flip;
use crate::property::{Evidence, Excerpt, Statement};
use crate::scalar::{Rational, Scalar, sum};

/// A flip with its term.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// The corners a, b, c, d; the diagonal ac gives way to bd.
    pub quad: [usize; 4],
    /// κ.
    pub kappa: Rational,
    /// The affine dependency of the corners.
    pub w: [Rational; 4],
}

/// Flips from a triangulation to a Delaunay one.
#[derive(Clone, Debug)]
pub struct Descent {
    /// Where it starts.
    pub start: Surface,
    /// The flips in their order.
    pub terms: Vec<Term>,
    /// The faces where it ends.
    pub end: Vec<[usize; 3]>,
}

/// The affine dependency of four points and κ; `None` unless they are the corners of a strictly convex quadrilateral,
/// counter-clockwise.
pub fn term(points: &[[Rational; 2]], quad: [usize; 4]) -> Option<Term> {
    let [a, b, c, d] = quad.map(|v| &points[v]);
    let area = |p, q, r| geometry::doubled_area(p, q, r);
    let [bcd, acd, abd, abc] = [area(b, c, d), area(a, c, d), area(a, b, d), area(a, b, c)];
    if [&bcd, &acd, &abd, &abc].iter().any(|x| x.cmp_zero() != Ordering::Greater) {
        return None;
    }
    let product = abc.clone() * acd.clone() * abd.clone() * bcd.clone();
    let kappa = (Rational::half() * geometry::incircle_determinant(a, b, c, d) / product).reduced();
    Some(Term { quad, kappa, w: [bcd, -acd, abd, -abc] })
}

impl Descent {
    /// Flips edges in the order of [`Triangulation::flip_to_delaunay`]; each is recorded before it is made.
    ///
    /// # Errors
    /// The surface is no planar triangulation, or a face is degenerate.
    pub fn of(start: Surface) -> Result<Self, FlipError> {
        let mut mesh = Triangulation::of(&start)?;
        let points = start.planar_positions::<Rational>().ok_or(FlipError::NotPlanar)?;
        let mut stack: Vec<usize> = (0..mesh.half_edges()).rev().collect();
        let mut terms = Vec::new();
        while let Some(h) = stack.pop() {
            let Some(Quad { a, b, c, d }) = mesh.quad(h) else { continue };
            if mesh.in_circle(h) != Some(Ordering::Greater) || !mesh.is_legal(h) {
                continue;
            }
            terms.push(term(&points, [a, d, b, c]).ok_or(FlipError::Illegal { a, b })?);
            let twin = mesh.twin(h).ok_or(FlipError::Illegal { a, b })?;
            mesh.flip(h)?;
            let (f, g) = (h / 3, twin / 3);
            stack.extend([3 * f + 1, 3 * f + 2, 3 * g + 1, 3 * g + 2]);
        }
        Ok(Descent { start, terms, end: mesh.faces().to_vec() })
    }

    /// What speaks against `L_T − L_D = Σ κ w wᵀ` with κ > 0 in every entry, exactly, or against the end being Delaunay; in
    /// words.
    pub fn violation(&self) -> Option<String> {
        if let Some(t) = self.terms.iter().find(|t| t.kappa.cmp_zero() != Ordering::Greater) {
            return Some(format!("the flip of {:?} has κ = {}", t.quad, t.kappa));
        }
        let at = |s: &Surface| s.positions().iter().map(|p| [p[0], p[1]]).collect::<Vec<_>>();
        let points = at(&self.start);
        for &[a, b, c] in &self.end {
            let inside =
                |d: &usize| geometry::incircle(points[a], points[b], points[c], points[*d]) == Ordering::Greater;
            if let Some(d) = (0..points.len()).find(inside) {
                return Some(format!("vertex {d} is inside the circle of ({a}, {b}, {c})"));
            }
        }
        let Some(mut left) = self.difference() else { return Some("there is no cotangent stiffness".into()) };
        for t in &self.terms {
            for (m, &i) in t.quad.iter().enumerate() {
                for (n, &j) in t.quad.iter().enumerate() {
                    let product = t.kappa.clone() * t.w[m].clone() * t.w[n].clone();
                    let entry = left.entry((i, j)).or_insert_with(Rational::zero);
                    *entry = (entry.clone() - product).reduced();
                }
            }
        }
        let (place, value) = left.into_iter().find(|(_, v)| v.cmp_zero() != Ordering::Equal)?;
        Some(format!("L_T − L_D − Σ κ w wᵀ is {value} at {place:?}"))
    }

    /// The entries of `L_T − L_D`.
    pub fn difference(&self) -> Option<BTreeMap<(usize, usize), Rational>> {
        let end = Surface::triangles(self.start.positions().to_vec(), &self.end).ok()?;
        let (before, after) = (stiffness_in_plane::<Rational>(&self.start)?, stiffness_in_plane::<Rational>(&end)?);
        let mut entries = BTreeMap::new();
        let negative = after.entries().map(|(i, j, v)| (i, j, -v.clone()));
        for (i, j, v) in before.entries().map(|(i, j, v)| (i, j, v.clone())).chain(negative) {
            let entry = entries.entry((i, j)).or_insert_with(Rational::zero);
            *entry = (entry.clone() + v).reduced();
        }
        Some(entries)
    }

    /// The certificate, for a function with these whole values; the positions must be whole numbers.
    pub fn certificate(&self, values: &[f64]) -> Option<Evidence> {
        let u: Vec<Rational> = values.iter().map(|&x| Rational::exactly(x)).collect::<Option<_>>()?;
        let mut energy = (Rational::half() * stiffness_in_plane::<Rational>(&self.start)?.quadratic_form(&u)).reduced();
        let mut energies = vec![energy.approximate()];
        for t in &self.terms {
            let along = sum((0..4).map(|m| t.w[m].clone() * u[t.quad[m]].clone()));
            energy = (energy - Rational::half() * t.kappa.clone() * along.clone() * along).reduced();
            energies.push(energy.approximate());
        }
        let flips = self.terms.iter().map(|t| Flip { quad: t.quad, kappa: t.kappa.clone().reduced().to_string() });
        let statement = Statement::FlipsToDelaunay {
            flips: flips.collect(),
            end: self.end.clone(),
            values: values.to_vec(),
            energies,
        };
        let excerpt = Excerpt {
            positions: self.start.positions().iter().copied().enumerate().collect(),
            faces: self.start.faces().iter().map(<[usize]>::to_vec).enumerate().collect(),
            ..Excerpt::default()
        };
        Some(Evidence::new(statement, excerpt))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::recheck::{self, Rechecked};

    fn rhombus() -> Surface {
        let points = [[0.0, 0.0], [2.0, -1.0], [4.0, 0.0], [2.0, 1.0]];
        Surface::planar(&points, &[[0, 1, 2], [0, 2, 3]]).unwrap()
    }

    #[test]
    fn the_long_diagonal_of_a_rhombus_gives_way_with_the_kappa_of_hand_computation() {
        // All four areas are 4 ([abc] = [acd] = 4, [abd] = [bcd] = 4). The weight of the long diagonal is ½(c + c) with the
        // cotangent c = ((−2)·2 + 1·1)/4 = −3/4, so −ω = 3/4 = κ w_a w_c = 16 κ.
        let descent = Descent::of(rhombus()).unwrap();
        assert_eq!(descent.terms.len(), 1);
        let t = &descent.terms[0];
        assert_eq!(t.kappa, Rational::from(3) / Rational::from(64));
        assert_eq!(t.w.clone().map(|w| w.approximate().abs()), [4.0; 4]);
        assert_eq!(descent.violation(), None);
    }

    #[test]
    fn a_spoilt_term_and_an_end_that_is_not_delaunay_are_noticed() {
        let good = Descent::of(rhombus()).unwrap();
        let mut bad = good.clone();
        bad.terms[0].kappa = Rational::from(3) / Rational::from(63);
        assert!(bad.violation().unwrap().starts_with("L_T − L_D − Σ κ w wᵀ is"));
        bad.terms[0].kappa = Rational::from(-1);
        assert!(bad.violation().unwrap().contains("has κ = -1"));
        let mut bad = good.clone();
        (bad.end, bad.terms) = (vec![[0, 1, 2], [0, 2, 3]], Vec::new());
        assert!(bad.violation().unwrap().contains("is inside the circle"));
    }

    #[test]
    fn the_certificate_is_verified_from_its_json_alone() {
        let evidence = Descent::of(rhombus()).unwrap().certificate(&[1.0, 0.0, 0.0, 0.0]).unwrap();
        let text = serde_json::to_string(&evidence).unwrap();
        let read = serde_json::from_str(&text).unwrap();
        assert_eq!(recheck::from_excerpt(&read), Ok(Rechecked::Exact));
    }
}
