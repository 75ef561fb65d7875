//! The nearest of many points in space, by a k-d tree.
//!
//! # Definition
//! The square of a distance is `(x₁ − x₂)² + (y₁ − y₂)² + (z₁ − z₂)²`, rounded: the same for both orders of two points, so that "within"
//! is a symmetric relation. Of points at the same distance the one with the smaller number comes first.
//!
//! # Cost
//! O(n log n) to build; a query takes O(log n + found) where points are spread evenly, O(n) at worst. Memory: 5 bytes a point.

/// A point that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// The square of its distance.
    pub squared: f64,
    /// Its number.
    pub point: usize,
}

/// Points in space, sorted for queries.
pub struct Nearest<'a> {
    points: &'a [[f64; 3]],
    /// The numbers of the points: the median of each range, in its middle, parts what lies before it from what lies behind.
    order: Vec<u32>,
    /// The axis along which the range with this middle is parted.
    axes: Vec<u8>,
}

/// Ranges up to this length are searched one by one: the query is as quick for anything from 4 to 16.
const LEAF: usize = 8;

/// The square of the distance of two points.
pub fn squared_distance(p: [f64; 3], q: [f64; 3]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|k| (p[k] - q[k]) * (p[k] - q[k]));
    x + y + z
}

impl<'a> Nearest<'a> {
    /// Sorts the points.
    pub fn new(points: &'a [[f64; 3]]) -> Self {
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        let mut axes = vec![0; points.len()];
        part(points, &mut order, &mut axes);
        Nearest { points, order, axes }
    }

    /// The points sorted.
    pub fn points(&self) -> &'a [[f64; 3]] {
        self.points
    }

    /// The `count` points nearest to a point of the cloud, itself left out, by distance.
    pub fn nearest_to(&self, point: usize, count: usize) -> Vec<Found> {
        let mut found: Vec<Found> = Vec::with_capacity(count + 1);
        if count > 0 {
            self.gather(point, count, 0, self.order.len(), &mut found);
        }
        found
    }

    /// The points within a distance, given by its square, of a point of the cloud, itself left out, by number.
    pub fn within(&self, point: usize, squared: f64) -> Vec<Found> {
        let mut found = Vec::new();
        self.collect(point, squared, 0, self.order.len(), &mut found);
        found.sort_unstable_by_key(|f| f.point);
        found
    }

    fn look(&self, from: usize, at: usize) -> Option<Found> {
        let point = self.order[at] as usize;
        let squared = squared_distance(self.points[from], self.points[point]);
        (point != from).then_some(Found { squared, point })
    }

    /// The two sides of the range `low..high` about its middle, the one that the point lies on first, and the square of the distance from
    /// the point to the plane between them: a bound from below, rounded as a summand of the distance is.
    fn sides(&self, from: usize, low: usize, high: usize) -> (usize, [[usize; 2]; 2], f64) {
        let middle = low + (high - low) / 2;
        let axis = usize::from(self.axes[middle]);
        let (here, there) = (self.points[from][axis], self.points[self.order[middle] as usize][axis]);
        let sides = [[low, middle], [middle + 1, high]];
        let sides = if here < there { sides } else { [sides[1], sides[0]] };
        (middle, sides, (here - there) * (here - there))
    }

    fn gather(&self, from: usize, count: usize, low: usize, high: usize, found: &mut Vec<Found>) {
        let keep = |candidate: Option<Found>, found: &mut Vec<Found>| {
            let Some(new) = candidate else { return };
            let before = |f: &Found| (f.squared, f.point) < (new.squared, new.point);
            let at = found.partition_point(before);
            if at < count {
                found.truncate(count - 1);
                found.insert(at, new);
            }
        };
        if high - low <= LEAF {
            (low..high).for_each(|at| keep(self.look(from, at), found));
            return;
        }
        let (middle, [near, far], gap) = self.sides(from, low, high);
        self.gather(from, count, near[0], near[1], found);
        keep(self.look(from, middle), found);
        if found.len() < count || found.last().is_some_and(|last| gap <= last.squared) {
            self.gather(from, count, far[0], far[1], found);
        }
    }

    fn collect(&self, from: usize, squared: f64, low: usize, high: usize, found: &mut Vec<Found>) {
        let inside = |at: usize| self.look(from, at).filter(|f| f.squared <= squared);
        if high - low <= LEAF {
            found.extend((low..high).filter_map(inside));
            return;
        }
        let (middle, [near, far], gap) = self.sides(from, low, high);
        self.collect(from, squared, near[0], near[1], found);
        found.extend(inside(middle));
        if gap <= squared {
            self.collect(from, squared, far[0], far[1], found);
        }
    }
}

/// Parts a range at its median along the axis in which it is widest, and so on.
fn part(points: &[[f64; 3]], order: &mut [u32], axes: &mut [u8]) {
    if order.len() <= LEAF {
        return;
    }
    let width = |axis: usize| {
        let range = order.iter().map(|&p| points[p as usize][axis]);
        range.clone().fold(f64::MIN, f64::max) - range.fold(f64::MAX, f64::min)
    };
    let widths = [0, 1, 2].map(width);
    let axis = (0..3).fold(0, |best, axis| if widths[axis] > widths[best] { axis } else { best });
    let middle = order.len() / 2;
    let key = |&p: &u32| points[p as usize][axis];
    order.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
    axes[middle] = axis as u8;
    let (before, behind) = order.split_at_mut(middle);
    let (axes_before, axes_behind) = axes.split_at_mut(middle);
    part(points, before, axes_before);
    part(points, &mut behind[1..], &mut axes_behind[1..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of a lattice, many at the same distance and some at the same place, or of a line.
    fn clouds() -> Vec<Vec<[f64; 3]>> {
        let mut state = 7_u64;
        let mut next = |below: u64| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((state >> 33) % below) as f64
        };
        let mut cloud = |n: usize, sides: [u64; 3]| (0..n).map(|_| sides.map(&mut next)).collect::<Vec<_>>();
        vec![cloud(0, [1; 3]), cloud(1, [9; 3]), cloud(9, [2; 3]), cloud(300, [9, 9, 5]), cloud(200, [1 << 20, 1, 1])]
    }

    #[test]
    fn what_is_found_is_what_looking_at_every_point_finds() {
        for points in clouds() {
            let tree = Nearest::new(&points);
            for from in 0..points.len() {
                let all = (0..points.len()).filter(|&p| p != from);
                let all = all.map(|point| Found { squared: squared_distance(points[from], points[point]), point });
                let mut all: Vec<Found> = all.collect();
                for squared in [0.0, 1.0, 9.0, 1e9] {
                    let inside: Vec<Found> = all.iter().copied().filter(|f| f.squared <= squared).collect();
                    assert_eq!(tree.within(from, squared), inside);
                }
                all.sort_by(|a, b| a.squared.total_cmp(&b.squared).then(a.point.cmp(&b.point)));
                for count in [0, 1, 7, 20, 1000] {
                    assert_eq!(tree.nearest_to(from, count), all[..count.min(all.len())]);
                }
            }
        }
    }
}
