//! Cuts along the level sets of a piecewise linear function: on each triangle a straight piece, so that lengths and areas are
//! those of the level set itself.

use super::patchwork::{Boundary, Patchwork};

/// Levels tried before the best is refined.
const LEVELS: usize = 64;

/// Steps of the golden section: the bracket shrinks to 10⁻¹³ of itself, about what levels can be told apart by.
const STEPS: usize = 64;

/// A point on an edge: `(above, below, t)` is the point `(1 − t) above + t below`.
pub type Crossing = (usize, usize, f64);

/// A level set with what it cuts off.
#[derive(Clone, Debug)]
pub struct Cut {
    /// The level.
    pub level: f64,
    /// The length of the level set.
    pub length: f64,
    /// The area where the function is above the level, or of the smaller part if the boundary is not fixed.
    pub area: f64,
    /// How far rounding can have moved the length, and the area.
    pub errors: [f64; 2],
    /// The straight pieces, between crossings of edges.
    pub pieces: Vec<[Crossing; 2]>,
}

impl Cut {
    /// Length over area; infinite where no more is cut off than rounding explains.
    pub fn ratio(&self) -> f64 {
        if self.area > self.errors[1] { self.length / self.area } else { f64::INFINITY }
    }

    /// The ratio without what rounding can have added.
    pub fn at_least(&self) -> f64 {
        (self.length - self.errors[0]) / (self.area + self.errors[1])
    }

    /// The ratio with what rounding can have taken away.
    pub fn at_most(&self) -> f64 {
        let area = self.area - self.errors[1];
        if area > 0.0 { (self.length + self.errors[0]) / area } else { f64::INFINITY }
    }

    /// Where the pieces begin and end.
    pub fn points<'a>(&'a self, patchwork: &'a Patchwork) -> impl Iterator<Item = [[f64; 3]; 2]> + 'a {
        let at = |(a, b, t): Crossing| {
            let [p, q] = [a, b].map(|v| patchwork.positions[v]);
            std::array::from_fn(|k| p[k] + t * (q[k] - p[k]))
        };
        self.pieces.iter().map(move |ends| ends.map(at))
    }

    /// The number of closed curves and arcs that it consists of.
    pub fn curves(&self) -> usize {
        let mut places = std::collections::BTreeMap::new();
        let mut number = |(a, b, _): Crossing| {
            let next = places.len();
            *places.entry([a.min(b), a.max(b)]).or_insert(next)
        };
        let pieces: Vec<[usize; 2]> = self.pieces.iter().map(|ends| ends.map(&mut number)).collect();
        crate::domain::topology::components(places.len(), &pieces).into_iter().max().map_or(0, |last| last + 1)
    }
}

/// The cut at a level.
pub fn cut(patchwork: &Patchwork, u: &[f64], level: f64, boundary: Boundary) -> Cut {
    let (mut length, mut above, mut spread, mut total) = (0.0, 0.0, 0.0, 0.0);
    let mut pieces = Vec::new();
    for (f, face) in patchwork.faces.iter().enumerate() {
        let area = patchwork.area(f);
        total += area;
        let is_above = face.map(|v| u[v] > level);
        let count = is_above.iter().filter(|a| **a).count();
        // The corner that is alone on its side of the level.
        let alone = match count {
            1 => is_above.iter().position(|a| *a),
            2 => is_above.iter().position(|a| !*a),
            _ => None,
        };
        let Some(k) = alone else {
            above += if count == 3 { area } else { 0.0 };
            continue;
        };
        let corners = patchwork.corners[f];
        let crossing = |other: usize| {
            let [a, b] = if is_above[k] { [face[k], face[other]] } else { [face[other], face[k]] };
            // From the vertex above to the one below, the same number from either side of the edge.
            let t = (u[a] - level) / (u[a] - u[b]);
            let from_alone = if is_above[k] { t } else { 1.0 - t };
            let [p, q] = [corners[k], corners[other]];
            let arm = [from_alone * (q[0] - p[0]), from_alone * (q[1] - p[1])];
            ((a, b, t), from_alone, arm, (q[0] - p[0]).hypot(q[1] - p[1]))
        };
        let [(one, s, x, reach), (two, t, y, range)] = [(k + 1) % 3, (k + 2) % 3].map(crossing);
        length += (x[0] - y[0]).hypot(x[1] - y[1]);
        spread += reach + range;
        above += if count == 1 { s * t * area } else { area - s * t * area };
        pieces.push([one, two]);
    }
    let area = if boundary == Boundary::Fixed { above } else { above.min(total - above) };
    // A piece carries a few roundings of its triangle's sides, a part of an area of its triangle's area, and a sum of n terms n
    // roundings of itself.
    let terms = f64::EPSILON * (patchwork.faces.len() as f64 + 16.0);
    let errors = [16.0 * f64::EPSILON * spread + terms * length, 2.0 * terms * total];
    Cut { level, length, area, errors, pieces }
}

/// The level set with the smallest ratio: the best of evenly spaced levels, refined. Levels from 0 where the boundary is fixed.
pub fn sweep(patchwork: &Patchwork, u: &[f64], boundary: Boundary) -> Option<Cut> {
    let highest = u.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let lowest = u.iter().copied().fold(f64::INFINITY, f64::min);
    let start = if boundary == Boundary::Fixed { 0.0 } else { lowest };
    let step = (highest - start) / LEVELS as f64;
    let at = |level: f64| cut(patchwork, u, level, boundary);
    let tried = (0..LEVELS).map(|k| at(start + k as f64 * step));
    let best = tried.min_by(|a, b| a.ratio().total_cmp(&b.ratio()))?;
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut low, mut high) = ((best.level - step).max(start), best.level + step);
    let inner = |low: f64, high: f64| [high - golden * (high - low), low + golden * (high - low)].map(at);
    let mut found = best;
    for _ in 0..STEPS {
        let [left, right] = inner(low, high);
        if left.ratio() < right.ratio() {
            high = right.level
        } else {
            low = left.level
        }
        for cut in [left, right] {
            if cut.ratio() < found.ratio() {
                found = cut;
            }
        }
    }
    found.ratio().is_finite().then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(n: usize) -> Patchwork {
        Patchwork::parallelogram([[1.0, 0.0], [0.0, 1.0]], [n, n], false)
    }

    fn values(patchwork: &Patchwork, f: impl Fn([f64; 3]) -> f64) -> Vec<f64> {
        patchwork.positions.iter().map(|p| f(*p)).collect()
    }

    #[test]
    fn level_sets_of_a_linear_function_are_straight_lines_of_exact_length_and_area() {
        let square = square(7);
        let u = values(&square, |p| p[0] + p[1]);
        // x + y = 3/4 cuts off a triangle of area 9/32 by a line of length 3/4 √2.
        let line = cut(&square, &u, 0.75, Boundary::Free);
        assert!((line.length - 0.75 * 2f64.sqrt()).abs() < 1e-14 && (line.area - 9.0 / 32.0).abs() < 1e-14);
        assert!(line.errors.iter().all(|e| *e < 1e-12) && line.curves() == 1);
        // The true ratio is between both bounds, which leave room for more than its own rounding.
        let ratio = 0.75 * 2f64.sqrt() / (9.0 / 32.0);
        assert!(line.at_least() < ratio * (1.0 - f64::EPSILON) && ratio * (1.0 + f64::EPSILON) < line.at_most());
        assert!(line.points(&square).flatten().all(|[x, y, _]| (x + y - 0.75).abs() < 1e-14));
        // Fixed: what lies above, whatever its size.
        assert!((cut(&square, &u, 0.75, Boundary::Fixed).area - 23.0 / 32.0).abs() < 1e-14);
    }

    #[test]
    fn the_best_level_of_a_linear_function_is_the_middle() {
        let square = square(9);
        let best = sweep(&square, &values(&square, |p| p[0]), Boundary::Free).unwrap();
        assert!((best.ratio() - 2.0).abs() < 1e-5 && (best.level - 0.5).abs() < 1e-5, "{}", best.level);
        assert!(best.at_least() <= best.ratio() && best.ratio() <= best.at_most());
    }

    #[test]
    fn level_zero_of_a_function_with_fixed_boundary_is_the_boundary() {
        let square = square(8);
        let u = values(&square, |p| p[0] * (1.0 - p[0]) * p[1] * (1.0 - p[1]));
        let all = cut(&square, &u, 0.0, Boundary::Fixed);
        // The two corners cut off by a diagonal have no vertex inside.
        let corner = 1.0 / 8.0;
        assert!((all.length - (4.0 - 4.0 * corner + 2.0 * corner * 2f64.sqrt())).abs() < 1e-14, "{}", all.length);
        assert!((all.area - (1.0 - corner * corner)).abs() < 1e-14);
    }

    #[test]
    fn two_bumps_are_cut_off_by_two_curves() {
        let square = square(24);
        let u = values(&square, |p| (std::f64::consts::TAU * p[0]).sin().powi(2) * (std::f64::consts::PI * p[1]).sin());
        assert_eq!(cut(&square, &u, 0.5, Boundary::Free).curves(), 2);
    }
}
