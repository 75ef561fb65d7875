//! Directions of negative energy: found by an elimination, made small, and evaluated exactly.

use crate::linalg::Csr;
use crate::linalg::factor::{FactorError, Ldlt, negative_direction};
use crate::property::tolerance::Threshold;
use crate::scalar::{Rational, Scalar, sum};

/// The largest number of vertices around a vertex among which a direction is searched: those of two rings, about.
const LARGEST_BALL: usize = 30;

/// A direction whose energy is below zero by more than a correct operator's can be.
pub(crate) struct Direction {
    /// Its non-zero components, ascending.
    pub x: Vec<(usize, f64)>,
    /// `xᵀLx`, exact up to the conversion to `f64`.
    pub energy: f64,
    /// `Σ defect_i s_i x_i²`.
    pub tolerated: f64,
    /// `−energy / tolerated`.
    pub margin: f64,
}

/// The energy of a matrix, and what is tolerated of it.
pub(crate) struct Energy<'a> {
    /// The symmetric part S, in which directions are searched.
    pub part: &'a Csr,
    /// The matrix L itself, in which they are evaluated.
    pub given: &'a Csr,
    /// The thresholds of the rows: a direction is decisive when its energy is below `−Σ defect_i x_i²`.
    pub thresholds: &'a [Threshold],
}

impl Energy<'_> {
    /// A decisive direction of at most two components: a negative diagonal entry, or a 2×2 block with a negative determinant.
    pub(crate) fn in_the_plane(&self) -> Option<Direction> {
        let negative = (0..self.part.rows()).filter(|&i| self.part.at(i, i) < 0.0);
        if let Some(found) = negative.into_iter().find_map(|i| self.evaluate(&[(i, 1.0)])) {
            return Some(found);
        }
        self.part.entries().filter(|(i, j, _)| i < j).find_map(|(i, j, &b)| {
            let (a, c) = (self.part.at(i, i), self.part.at(j, j));
            // The eigenvector of the smaller eigenvalue of [a b; b c].
            let angle = 0.5 * (2.0 * b).atan2(a - c) + std::f64::consts::FRAC_PI_2;
            (b * b > a * c).then(|| self.evaluate(&[(i, short(angle.cos())), (j, short(angle.sin()))])).flatten()
        })
    }

    /// A decisive direction on few vertices around some vertex: of all such the one on the fewest, the first of equals. `None` if
    /// [`LARGEST_BALL`] vertices are not enough anywhere. Cost: O(n) eliminations of that size.
    pub(crate) fn in_a_ball(&self) -> Option<Direction> {
        let mut best: Option<Direction> = None;
        for centre in 0..self.part.rows() {
            let most = best.as_ref().map_or(LARGEST_BALL, |b| b.x.len() - 1);
            let Some(x) = self.direction_around(centre, most) else { continue };
            let rounded: Vec<(usize, f64)> = x.iter().map(|&(i, v)| (i, short(v))).filter(|e| e.1 != 0.0).collect();
            best = self.evaluate(&rounded).or_else(|| self.evaluate(&x)).or(best);
        }
        best
    }

    /// Eliminates `S + diag(defect)` breadth first from a vertex until a pivot is negative: the block eliminated so far then has a
    /// direction x of energy below `−Σ defect_i x_i²`. With L the unit triangle of the block before pivot p and l its row there,
    /// `x = (−L⁻ᵀ l, 1)`.
    fn direction_around(&self, centre: usize, most: usize) -> Option<Vec<(usize, f64)>> {
        let mut ball = vec![centre];
        let (mut lower, mut pivots): (Vec<Vec<f64>>, Vec<f64>) = (Vec::new(), Vec::new());
        for p in 0..most {
            let &v = ball.get(p)?;
            let mut row: Vec<f64> = ball[..p].iter().map(|&w| self.part.at(v, w)).collect();
            let mut pivot = self.part.at(v, v) + self.thresholds[v].defect;
            for j in 0..p {
                row[j] -= lower[j].iter().zip(&row).map(|(l, g)| l * g).sum::<f64>();
            }
            for (entry, d) in row.iter_mut().zip(&pivots) {
                pivot -= *entry * *entry / d;
                *entry /= d;
            }
            if pivot < 0.0 {
                return Some(solved(&ball[..=p], &lower, row));
            }
            // A pivot of zero ends the elimination; NaN does too.
            if pivot.is_nan() || pivot == 0.0 {
                return None;
            }
            lower.push(row);
            pivots.push(pivot);
            for (w, _) in self.part.row(v).filter(|(_, v)| **v != 0.0) {
                if ball.len() < most && !ball.contains(&w) {
                    ball.push(w);
                }
            }
        }
        None
    }

    /// A decisive direction from the elimination of a lifted S, as small as cutting makes it; `None` if there is none.
    pub(crate) fn search(&self, lifted: &Csr) -> Option<Direction> {
        let x = first_negative(lifted)?;
        let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if !(largest > 0.0 && largest.is_finite()) {
            return None;
        }
        // A smooth bump stays one when its foot is cut off; the higher the cut, the smaller the witness.
        let shrunk = |level: f64| sparse(&x, |v| short((v.abs() / largest - level).max(0.0).copysign(v)));
        let clipped = |level: f64| sparse(&x, |v| if v.abs() > level * largest { short(v / largest) } else { 0.0 });
        let levels = [0.75, 0.5, 0.35, 0.25, 0.15, 0.1, 0.05, 0.02, 1e-2, 1e-3, 1e-5];
        levels
            .iter()
            .flat_map(|&level| [shrunk(level), clipped(level)])
            .filter(|x| self.is_promising(x))
            .chain([clipped(0.0), sparse(&x, |v| v / largest)])
            .find_map(|x| self.evaluate(&x))
    }

    fn slack(&self, x: &[(usize, f64)]) -> f64 {
        x.iter().map(|&(i, v)| self.thresholds[i].defect * v * v).sum()
    }

    /// Whether the energy is decisive as far as floating point can tell.
    fn is_promising(&self, x: &[(usize, f64)]) -> bool {
        let mut full = vec![0.0; self.part.rows()];
        x.iter().for_each(|&(i, v)| full[i] = v);
        let energy: f64 = x.iter().map(|&(i, v)| v * self.part.row(i).map(|(j, w)| w * full[j]).sum::<f64>()).sum();
        energy < -self.slack(x)
    }

    /// The direction with its exact energy, if that is decisive.
    fn evaluate(&self, x: &[(usize, f64)]) -> Option<Direction> {
        let (exact, slack) = (energy(self.given, x)?, self.slack(x));
        let value = exact.approximate();
        let decisive = exact.cmp_zero().is_lt() && -value > slack;
        decisive.then(|| Direction { x: x.to_vec(), energy: value, tolerated: slack, margin: -value / slack })
    }
}

/// `(−L⁻ᵀ l, 1)` at the vertices of a ball, ascending, the largest component one.
fn solved(ball: &[usize], lower: &[Vec<f64>], mut row: Vec<f64>) -> Vec<(usize, f64)> {
    for j in (0..row.len()).rev() {
        let (known, rest) = row.split_at_mut(j);
        known.iter_mut().zip(&lower[j]).for_each(|(x, l)| *x -= l * rest[0]);
    }
    let components = || row.iter().map(|x| -x).chain([1.0]);
    let largest = components().map(f64::abs).fold(0.0, f64::max);
    let mut x: Vec<(usize, f64)> = ball.iter().copied().zip(components().map(|x| x / largest)).collect();
    x.retain(|&(_, v)| v != 0.0);
    x.sort_unstable_by_key(|&(i, _)| i);
    x
}

fn sparse(x: &[f64], change: impl Fn(f64) -> f64) -> Vec<(usize, f64)> {
    x.iter().map(|&v| change(v)).enumerate().filter(|&(_, v)| v != 0.0).collect()
}

/// The direction of the first pivot that is not positive. A pivot that is exactly zero stops the elimination; the
/// matrix is then lowered a little, which only makes the pivot negative.
fn first_negative(lifted: &Csr) -> Option<Vec<f64>> {
    match negative_direction(lifted) {
        Ok(found) => found,
        Err(FactorError::Singular) => {
            let lower: Vec<f64> = lifted.row_scales().iter().map(|s| -1e-14 * s).collect();
            let lowered = lifted.add(&Csr::diagonal(&lower));
            Ldlt::new(&lowered).ok()?;
            negative_direction(&lowered).ok()?
        }
        Err(_) => None,
    }
}

/// Few digits make a witness that can be read.
fn short(x: f64) -> f64 {
    f64::from(x as f32)
}

/// `xᵀLx` in rationals.
fn energy(matrix: &Csr, x: &[(usize, f64)]) -> Option<Rational> {
    let mut full: Vec<Option<Rational>> = vec![None; matrix.rows()];
    for &(i, v) in x {
        full[i] = Some(Rational::exactly(v)?);
    }
    let mut terms = Vec::with_capacity(x.len());
    for &(i, v) in x {
        let mut row = Vec::new();
        for (j, &v) in matrix.row(i) {
            if let Some(xj) = &full[j] {
                row.push(Rational::exactly(v)? * xj.clone());
            }
        }
        terms.push(sum(row) * Rational::exactly(v)?);
    }
    Some(sum(terms))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The Laplacian of a path of n vertices with weight one, but for one weight `w` between `at` and `at + 1`.
    fn path(n: usize, at: usize, w: f64) -> Csr {
        let mut t = Vec::new();
        for i in 0..n - 1 {
            let weight = if i == at { w } else { 1.0 };
            t.extend([(i, i, weight), (i + 1, i + 1, weight), (i, i + 1, -weight), (i + 1, i, -weight)]);
        }
        Csr::from_triplets(n, n, &t)
    }

    fn found(part: &Csr) -> Option<Direction> {
        let thresholds: Vec<_> = part.row_scales().iter().map(|s| Threshold::over(*s, 3, 1.0)).collect();
        Energy { part, given: part, thresholds: &thresholds }.in_a_ball()
    }

    #[test]
    fn a_weight_that_is_too_negative_for_its_surroundings_is_found_on_few_vertices() {
        // Coming down to zero over a edges on one side and b on the other, a jump of one costs at least 1/(a + b) (resistors in
        // series): the energy is negative once 1/(a + b) < 0.12, from nine vertices on.
        let direction = found(&path(2000, 1000, -0.12)).unwrap();
        assert!(direction.x.len() == 9 && direction.energy < 0.0, "{:?}", direction.x);
        assert!(direction.x.windows(2).all(|w| w[0].0 < w[1].0));
        assert!(direction.x.iter().any(|e| e.0 == 1000 || e.0 == 1001));
    }

    #[test]
    fn no_ball_around_a_vertex_has_a_direction_where_only_the_whole_path_has_one() {
        assert!(found(&path(200, 100, 1.0)).is_none());
        // A step over the whole path has energy −0.01; within a ball it costs 1/(a + b) ≥ 1/30.
        assert!(found(&path(200, 100, -0.01)).is_none());
    }
}
