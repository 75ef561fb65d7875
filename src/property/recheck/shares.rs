//! How the area around a vertex can be shared out, and the scan of a mass matrix.

use super::energy::area;
use super::leeway::Leeway;
use super::profile::{self, Profile};
use super::scan::{check_finite, check_sum, symmetric};
use super::terms::{Terms, U};
use super::{Answer, Rechecked, Refusal};
use crate::domain::{Domain, Surface, geometry};
use crate::linalg::Csr;
use crate::operator::Operator;

/// A mass scaled to unit diagonal counts as positive definite if its eigenvalues exceed this.
const SMALLEST: f64 = 1.0 / (1_u64 << 34) as f64;

/// What the faces around a vertex can give it.
#[derive(Default)]
pub(super) struct Star {
    /// Total area.
    pub area: f64,
    /// Each face divided evenly among its corners.
    pub even: f64,
    /// The signed circumcentric share.
    pub circumcentric: f64,
    /// The same, but half of the area at and a quarter beside an obtuse angle (Meyer et al. 2003).
    pub mixed: f64,
    /// The least that any of these divisions gives.
    pub least: f64,
    /// The most.
    pub most: f64,
}

impl Star {
    /// Adds a face with the vertex at corner `at`.
    pub fn add(&mut self, corners: &[[f64; 3]], at: usize) {
        let face: Vec<usize> = (0..corners.len()).collect();
        let Ok(area) = area(std::iter::once(face.as_slice()), |v| Ok(corners[v])) else { return };
        let area = area.approximate().0;
        let even = area / corners.len() as f64;
        self.area += area;
        self.even += even;
        if corners.len() > 3 {
            // How a polygon is divided is a matter of convention: anything between nothing and all of it.
            self.circumcentric += even;
            self.mixed += even;
            self.most += area;
            return;
        }
        // Of a triangle without an obtuse angle a corner gets between a quarter and a half.
        let circumcentric = circumcentric(corners, at);
        let mixed = match (0..3).find(|&k| dot(corners, k) < 0.0) {
            Some(obtuse) if obtuse == at => 0.5 * area,
            Some(_) => 0.25 * area,
            None => circumcentric,
        };
        self.circumcentric += circumcentric;
        self.mixed += mixed;
        self.least += circumcentric.min(0.25 * area);
        self.most += circumcentric.max(0.5 * area);
    }
}

fn side(corners: &[[f64; 3]], from: usize, to: usize) -> geometry::Vec3 {
    geometry::Vec3::from(corners[to]) - geometry::Vec3::from(corners[from])
}

/// The dot product of the two sides at a corner of a triangle.
fn dot(corners: &[[f64; 3]], at: usize) -> f64 {
    side(corners, at, (at + 1) % 3).dot(&side(corners, at, (at + 2) % 3))
}

/// `⅛ (|b|² cot β + |c|² cot γ)` over the two sides at the corner, with the angles opposite them; zero where the triangle is
/// degenerate.
fn circumcentric(corners: &[[f64; 3]], at: usize) -> f64 {
    let (p, q) = ((at + 1) % 3, (at + 2) % 3);
    let (u, v) = (side(corners, at, p), side(corners, at, q));
    let normal = u.cross(&v);
    // Scaled before it is squared: the square of a height of 1e-170 is zero.
    let doubled_area = (normal / normal.amax()).norm() * normal.amax();
    let share = (v.norm_squared() * dot(corners, p) + u.norm_squared() * dot(corners, q)) / (8.0 * doubled_area);
    if share.is_finite() { share } else { 0.0 }
}

/// MASS: symmetric, positive definite, total and shares those of the surface.
pub(super) fn scan(domain: &Domain, operator: &Operator) -> Answer {
    let Some(mass) = operator.mass() else {
        return Err(Refusal::untrue("there is a mass matrix", "there is none"));
    };
    let m = mass.matrix();
    check_finite(m)?;
    let leeway = Leeway::of(domain, m);
    symmetric(m, &leeway)?;
    let surface = domain.as_surface().filter(|s| has_planar_faces(s));
    let stars = surface.map(|s| (0..m.rows()).map(|i| star(s, i)).collect::<Vec<_>>());
    let mut massive = vec![matches!(domain, Domain::Points(_)); m.rows()];
    domain.edges().iter().flatten().for_each(|&v| massive[v] = true);
    if let Some(stars) = &stars {
        massive.iter_mut().zip(stars).for_each(|(m, s)| *m = s.area > 0.0);
    }
    if let (Some(surface), Some(stars)) = (surface, &stars) {
        check_shares(m, surface, stars, &leeway)?;
    }
    definite(m, &massive)
}

fn star(surface: &Surface, i: usize) -> Star {
    let mut star = Star::default();
    for at in surface.topology().star(i) {
        let corners: Vec<_> = surface.faces()[at.face()].iter().map(|&v| surface.positions()[v]).collect();
        star.add(&corners, at.corner());
    }
    star
}

/// Whether the corners of every polygon are coplanar: else its area is a convention. Exact.
fn has_planar_faces(surface: &Surface) -> bool {
    let at = |v: usize| surface.positions()[v];
    surface.faces().iter().filter(|f| f.len() > 3).all(|f| {
        let proper = f[1..].windows(2).find(|w| !geometry::collinear(at(f[0]), at(w[0]), at(w[1])));
        proper.is_none_or(|w| f.iter().all(|&v| geometry::orient3d(at(f[0]), at(w[0]), at(w[1]), at(v)).is_eq()))
    })
}

/// Refuses a total that is not the area, a share that no division of the star gives by a factor of two.
fn check_shares(m: &Csr, surface: &Surface, stars: &[Star], leeway: &Leeway) -> Result<(), Refusal> {
    let area = area(surface.faces().iter(), |v| Ok(surface.positions()[v]))?;
    let (size, error) = area.approximate();
    let mut total = Terms::default();
    m.entries().for_each(|e| total.add(*e.2));
    total.add(-size);
    check_sum(&total, leeway.rows.iter().sum::<f64>() + error, || "the masses add up to the area".into())?;
    for (i, star) in stars.iter().enumerate() {
        let share: f64 = m.row(i).map(|(_, v)| v).sum();
        let slack = 0.5 * star.least.abs().min(star.area) + leeway.rows[i] + 1e-9 * star.area;
        if share < star.least - slack || share > 2.0 * star.most + slack {
            return Err(Refusal::untrue(
                format!("the share of vertex {i} lies between {} and {}", star.least, star.most),
                share.to_string(),
            ));
        }
    }
    Ok(())
}

/// Refuses a mass that is not positive definite on the vertices that must have one.
fn definite(m: &Csr, massive: &[bool]) -> Answer {
    let kept: Vec<usize> = (0..m.rows()).filter(|&i| massive[i]).collect();
    if let Some(&i) = kept.iter().find(|&&i| m.at(i, i) <= 0.0) {
        return Err(Refusal::untrue("the mass is positive definite", format!("M_{i},{i} = {}", m.at(i, i))));
    }
    if m.entries().all(|(i, j, v)| i == j || *v == 0.0) {
        return Ok(Rechecked::Bounded);
    }
    let part = m.symmetric_part().submatrix(&kept, &kept);
    let root: Vec<f64> = (0..part.rows()).map(|i| part.at(i, i).sqrt()).collect();
    let row = |i: usize| part.row(i).map(|(j, v)| (j, v / root[i] / root[j])).collect();
    let scaled: profile::Symmetric = (0..part.rows()).map(row).collect();
    let ones = vec![1.0; scaled.len()];
    let widest = scaled.iter().map(|r| r.iter().map(|e| e.1.abs()).sum()).fold(0.0, f64::max);
    match Profile::factor(&profile::add_diagonal(&scaled, &ones, -SMALLEST)) {
        Ok(factor) if factor.negative_pivots() > 0 => {
            let found = format!("{} negative pivots", factor.negative_pivots());
            Err(Refusal::untrue("the mass is positive definite", found))
        }
        // Scaling rounds each entry five times, the shift once more.
        Ok(factor) if factor.backward_error(&ones) + 6.0 * U * widest < SMALLEST => Ok(Rechecked::Bounded),
        Ok(_) => Ok(Rechecked::Open("the smallest eigenvalue of the mass is within rounding of zero".into())),
        Err(why) => Ok(Rechecked::Open(why)),
    }
}
