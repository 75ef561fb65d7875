//! Factorisation `A = LDLᵀ` of a sparse symmetric matrix within its profile, with a bound on its rounding.

use super::terms::U;

/// More multiplications than this take longer than a recheck may.
const MOST_WORK: f64 = 2e9;

/// A symmetric matrix by rows: `(column, value)`, columns ascending, both triangles.
pub(super) type Symmetric = Vec<Vec<(usize, f64)>>;

/// Whether a matrix by rows is symmetric bit for bit.
pub(super) fn is_symmetric(a: &Symmetric) -> bool {
    let at = |i: usize, j: usize| a[i].binary_search_by_key(&j, |e| e.0).map_or(0.0, |k| a[i][k].1);
    a.iter().enumerate().all(|(i, row)| row.iter().all(|&(j, v)| at(j, i) == v))
}

/// The row scales `Σ_k |A_ik|`.
pub(super) fn scales(a: &Symmetric) -> Vec<f64> {
    a.iter().map(|r| r.iter().map(|e| e.1.abs()).sum()).collect()
}

/// `A + factor·diag(d)`.
pub(super) fn add_diagonal(a: &Symmetric, d: &[f64], factor: f64) -> Symmetric {
    let mut sum = a.clone();
    for (i, row) in sum.iter_mut().enumerate() {
        match row.binary_search_by_key(&i, |e| e.0) {
            Ok(at) => row[at].1 += factor * d[i],
            Err(at) => row.insert(at, (i, factor * d[i])),
        }
    }
    sum
}

/// An order of elimination with a small profile (reverse Cuthill–McKee): breadth first from an end of each component.
fn order(a: &Symmetric) -> Vec<usize> {
    let sweep = |start: usize, seen: &mut [bool]| {
        let (mut queue, mut next) = (vec![start], 0);
        seen[start] = true;
        while next < queue.len() {
            let v = queue[next];
            next += 1;
            let mut fresh: Vec<usize> = a[v].iter().map(|e| e.0).filter(|&w| !seen[w]).collect();
            fresh.sort_by_key(|&w| (a[w].len(), w));
            fresh.iter().for_each(|&w| seen[w] = true);
            queue.extend(fresh);
        }
        queue
    };
    let mut seen = vec![false; a.len()];
    let mut order = Vec::with_capacity(a.len());
    for start in 0..a.len() {
        if seen[start] {
            continue;
        }
        let mut end = start;
        for _ in 0..2 {
            let reached = sweep(end, &mut seen);
            end = reached[reached.len() - 1];
            reached.iter().for_each(|&v| seen[v] = false);
        }
        order.extend(sweep(end, &mut seen));
    }
    order.reverse();
    order
}

/// `P A Pᵀ = L D Lᵀ`, row i of L stored from its first column on.
pub(super) struct Profile {
    order: Vec<usize>,
    first: Vec<usize>,
    rows: Vec<Vec<f64>>,
    pivots: Vec<f64>,
}

impl Profile {
    /// Factorises without pivoting; the error says why not.
    pub fn factor(a: &Symmetric) -> Result<Self, String> {
        let n = a.len();
        let order = order(a);
        let mut place = vec![0; n];
        order.iter().enumerate().for_each(|(at, &v)| place[v] = at);
        let first: Vec<usize> =
            (0..n).map(|i| a[order[i]].iter().map(|e| place[e.0]).min().unwrap_or(i).min(i)).collect();
        let work: f64 = first.iter().enumerate().map(|(i, f)| ((i - f) as f64).powi(2)).sum();
        if work > MOST_WORK {
            return Err(format!("{n} unknowns with a profile factorisation of {work:.1e} operations are too many"));
        }
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(n);
        let mut pivots: Vec<f64> = Vec::with_capacity(n);
        for i in 0..n {
            let f = first[i];
            let mut g = vec![0.0; i - f];
            let mut diagonal = 0.0;
            for &(v, value) in &a[order[i]] {
                match place[v] {
                    j if j < i => g[j - f] = value,
                    j if j == i => diagonal = value,
                    _ => {}
                }
            }
            for j in f..i {
                let from = f.max(first[j]);
                let known = &rows[j][from - first[j]..];
                let dot: f64 = g[from - f..j - f].iter().zip(known).map(|(x, y)| x * y).sum();
                g[j - f] -= dot;
            }
            for (g, d) in g.iter_mut().zip(&pivots[f..i]) {
                let entry = *g / d;
                diagonal -= *g * entry;
                *g = entry;
            }
            if !diagonal.is_finite() || diagonal == 0.0 {
                return Err("a pivot vanished".into());
            }
            rows.push(g);
            pivots.push(diagonal);
        }
        Ok(Profile { order, first, rows, pivots })
    }

    /// How many pivots are negative: the negative eigenvalues of `LDLᵀ` (Sylvester).
    pub fn negative_pivots(&self) -> usize {
        self.pivots.iter().filter(|d| **d < 0.0).count()
    }

    /// A bound δ such that `|xᵀ(A − LDLᵀ)x| ≤ δ xᵀ diag(s) x` for every x.
    ///
    /// Each entry of `A − LDLᵀ` is at most `γ (|L||D||L|ᵀ)_ij` with γ of one rounding for each product and three more. For a
    /// non-negative symmetric matrix N, `‖S^(−½) N S^(−½)‖ ≤ max_i (N1)_i / s_i` (Collatz–Wielandt, with the vector `S^½ 1`).
    pub fn backward_error(&self, scales: &[f64]) -> f64 {
        let n = self.rows.len();
        let mut below: Vec<f64> = vec![1.0; n];
        for i in 0..n {
            for (k, l) in self.rows[i].iter().enumerate() {
                below[self.first[i] + k] += l.abs();
            }
        }
        let weighted: Vec<f64> = below.iter().zip(&self.pivots).map(|(b, d)| b * d.abs()).collect();
        let mut worst = 0.0_f64;
        let mut longest = 0;
        for i in 0..n {
            let row = self.rows[i].iter().zip(&weighted[self.first[i]..]).map(|(l, w)| l.abs() * w);
            worst = worst.max((row.sum::<f64>() + weighted[i]) / scales[self.order[i]]);
            longest = longest.max(self.rows[i].len());
        }
        let gamma = (longest as f64 + 8.0) * U * 1.1;
        if worst.is_nan() { f64::INFINITY } else { gamma * worst }
    }

    /// Solves `A x = b`.
    pub fn solve(&self, b: &[f64]) -> Vec<f64> {
        let n = self.rows.len();
        let mut y: Vec<f64> = self.order.iter().map(|&v| b[v]).collect();
        for i in 0..n {
            let f = self.first[i];
            let dot: f64 = self.rows[i].iter().zip(&y[f..i]).map(|(l, y)| l * y).sum();
            y[i] -= dot;
        }
        y.iter_mut().zip(&self.pivots).for_each(|(y, d)| *y /= d);
        for i in (0..n).rev() {
            let (f, yi) = (self.first[i], y[i]);
            y[f..i].iter_mut().zip(&self.rows[i]).for_each(|(y, l)| *y -= l * yi);
        }
        let mut x = vec![0.0; n];
        self.order.iter().zip(&y).for_each(|(&v, &y)| x[v] = y);
        x
    }

    /// An estimate from above of the smallest eigenvalue of `A x = λ diag(s) x`, by inverse iteration from a vector of no
    /// symmetry.
    pub fn smallest_eigenvalue(&self, a: &Symmetric, scales: &[f64]) -> f64 {
        let mut x: Vec<f64> = (0..a.len()).map(|i| 1.0 + 0.5 * (i as f64).sin()).collect();
        let mut quotient = 0.0;
        for _ in 0..20 {
            let b: Vec<f64> = x.iter().zip(scales).map(|(x, s)| x * s).collect();
            x = self.solve(&b);
            let energy: f64 = (0..a.len()).map(|i| x[i] * a[i].iter().map(|&(j, v)| v * x[j]).sum::<f64>()).sum();
            let norm: f64 = x.iter().zip(scales).map(|(x, s)| x * x * s).sum();
            quotient = energy / norm;
            let size = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            x.iter_mut().for_each(|v| *v /= size);
        }
        quotient
    }

    /// How many multiplications a solve takes.
    pub fn stored(&self) -> usize {
        self.rows.iter().map(Vec::len).sum::<usize>() + self.rows.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The Laplacian of a grid of k × k vertices.
    fn grid(k: usize) -> Symmetric {
        let at = |x: usize, y: usize| y * k + x;
        let mut rows = Vec::new();
        for y in 0..k {
            for x in 0..k {
                let mut row = Vec::new();
                row.extend((y > 0).then(|| (at(x, y - 1), -1.0)));
                row.extend((x > 0).then(|| (at(x - 1, y), -1.0)));
                let degree = [x > 0, y > 0, x + 1 < k, y + 1 < k].into_iter().filter(|b| *b).count();
                row.push((at(x, y), degree as f64));
                row.extend((x + 1 < k).then(|| (at(x + 1, y), -1.0)));
                row.extend((y + 1 < k).then(|| (at(x, y + 1), -1.0)));
                rows.push(row);
            }
        }
        rows
    }

    #[test]
    fn negative_pivots_count_the_eigenvalues_of_a_grid_below_the_shift() {
        // Eigenvalues 4 − 2 cos(πp/k) − 2 cos(πq/k).
        let (k, sigma) = (9, 0.731);
        let wave = |p: usize| 2.0 - 2.0 * (std::f64::consts::PI * p as f64 / k as f64).cos();
        let below = (0..k * k).filter(|&m| wave(m / k) + wave(m % k) < sigma).count();
        let factor = Profile::factor(&add_diagonal(&grid(k), &vec![1.0; k * k], -sigma)).unwrap();
        assert_eq!(factor.negative_pivots(), below);
        assert!(factor.backward_error(&scales(&grid(k))) < 1e-12);
    }

    #[test]
    fn the_solution_has_a_small_residual() {
        let a = add_diagonal(&grid(12), &vec![1.0; 144], 0.01);
        let b: Vec<f64> = (0..144).map(|i| (i as f64).cos()).collect();
        let x = Profile::factor(&a).unwrap().solve(&b);
        for (i, row) in a.iter().enumerate() {
            assert!((row.iter().map(|&(j, v)| v * x[j]).sum::<f64>() - b[i]).abs() < 1e-11);
        }
    }

    #[test]
    fn the_backward_error_covers_the_rounding_that_happened() {
        let k = 6;
        let a = add_diagonal(&grid(k), &vec![0.1; k * k], 1.0);
        let factor = Profile::factor(&a).unwrap();
        let s = scales(&a);
        let delta = factor.backward_error(&s);
        let entry = |i: usize, j: usize| {
            if j == i { 1.0 } else { *factor.rows[i].get(j.wrapping_sub(factor.first[i])).unwrap_or(&0.0) }
        };
        for i in 0..k * k {
            let row: f64 = (0..k * k)
                .map(|j| {
                    let product: f64 = (0..=i.min(j)).map(|m| entry(i, m) * factor.pivots[m] * entry(j, m)).sum();
                    let (v, w) = (factor.order[i], factor.order[j]);
                    let stored = a[v].iter().find(|e| e.0 == w).map_or(0.0, |e| e.1);
                    (product - stored).abs()
                })
                .sum();
            assert!(row <= delta * s[factor.order[i]]);
        }
    }

    #[test]
    fn a_matrix_without_pivots_is_refused() {
        assert!(Profile::factor(&vec![vec![(1, 1.0)], vec![(0, 1.0)]]).is_err());
    }
}
