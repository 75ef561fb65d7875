//! Linear systems with a bound on the error of every component.

use super::dense::{self, Inverse};
use super::profile::{self, Profile};
use super::terms::U;

/// Above this size a dense inverse takes longer than a tenth of a second.
const DENSE: usize = 300;

/// Up to this size a dense inverse is cheaper than two sparse factorisations.
const SMALL: usize = 24;

/// An entry of a matrix: column, value, and how far the exact value may be away.
pub(super) type Entry = (usize, f64, f64);

/// A square matrix by rows, columns ascending.
pub(super) struct System {
    /// The rows.
    pub rows: Vec<Vec<Entry>>,
}

/// A solution and how far each component may be from the exact one.
pub(super) struct Enclosure {
    /// The approximate solution.
    pub x: Vec<f64>,
    /// The bound for each component.
    pub error: Vec<f64>,
}

/// A factorisation that bounds what it solves.
pub(super) enum Solver<'a> {
    /// `R ≈ A⁻¹` with `‖I − RA‖∞ ≤ ρ < 1`.
    Dense(&'a System, Inverse),
    /// `A = LDLᵀ` and `A ⪰ gap·diag(s)`.
    Sparse(&'a System, Profile, Vec<f64>, f64),
}

impl<'a> Solver<'a> {
    /// Factorises; the error says why not.
    pub fn new(system: &'a System) -> Result<Self, String> {
        let n = system.rows.len();
        let sparse = if n > SMALL { Solver::sparse(system) } else { Err(String::new()) };
        if sparse.is_ok() || n > DENSE {
            return sparse;
        }
        let inverse = dense::invert(system).ok_or("the matrix is singular up to rounding")?;
        Ok(Solver::Dense(system, inverse))
    }

    fn sparse(system: &'a System) -> Result<Self, String> {
        let n = system.rows.len();
        let values = system.symmetric().ok_or_else(|| format!("{n} unknowns without symmetry are too many"))?;
        let scales = profile::scales(&values);
        let factor = Profile::factor(&values)?;
        let shift = 0.5 * factor.smallest_eigenvalue(&values, &scales);
        let shifted = Profile::factor(&profile::add_diagonal(&values, &scales, -shift))?;
        let radius = system.rows.iter().zip(&scales).map(|(r, s)| r.iter().map(|e| e.2).sum::<f64>() / s);
        // Shifting the diagonal rounds twice.
        let gap = shift - shifted.backward_error(&scales) - radius.fold(0.0, f64::max) - 4.0 * U;
        if shifted.negative_pivots() > 0 || gap.is_nan() || gap <= 0.0 {
            return Err("the matrix is not positive definite beyond rounding".into());
        }
        Ok(Solver::Sparse(system, factor, scales, gap))
    }

    /// About how many multiplications a solve takes.
    pub fn work(&self) -> usize {
        match self {
            Solver::Dense(system, _) => 2 * system.rows.len() * system.rows.len(),
            Solver::Sparse(_, factor, ..) => 2 * factor.stored(),
        }
    }

    /// Solves `A x = b`.
    pub fn solve(&self, b: &[f64]) -> Enclosure {
        match self {
            Solver::Dense(system, inverse) => {
                let x = inverse.mul(b);
                let (residual, slack) = system.residual(&x, b);
                let defect: Vec<f64> = residual.iter().zip(&slack).map(|(r, s)| r.abs() + s).collect();
                // x* − x = (RA)⁻¹ R r, and ‖(RA)⁻¹ − I‖∞ ≤ ρ/(1 − ρ).
                let first = inverse.mul_magnitudes(&defect);
                let worst = first.iter().copied().fold(0.0, f64::max);
                let rest = inverse.defect / (1.0 - inverse.defect) * worst;
                Enclosure { x, error: first.iter().map(|e| (e + rest) * (1.0 + 1e-9)).collect() }
            }
            Solver::Sparse(system, factor, scales, gap) => {
                let x = factor.solve(b);
                let (residual, slack) = system.residual(&x, b);
                // A ⪰ g S gives (x* − x)ᵀ S (x* − x) ≤ rᵀ S⁻¹ r / g².
                let parts = residual.iter().zip(&slack).zip(scales);
                let energy: f64 = parts.map(|((r, e), s)| (r.abs() + e).powi(2) / s).sum();
                let error = scales.iter().map(|s| (energy / s).sqrt() / gap * (1.0 + 1e-9)).collect();
                Enclosure { x, error }
            }
        }
    }
}

impl System {
    /// `b − Ax` and a bound on its error: each row of m products rounds at most m + 2 times.
    fn residual(&self, x: &[f64], b: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let row = |(r, &b): (&Vec<Entry>, &f64)| {
            let (mut sum, mut scale, mut radius) = (b, b.abs(), 0.0);
            for &(j, v, e) in r {
                let product = v * x[j];
                sum -= product;
                scale += product.abs();
                radius += e * x[j].abs();
            }
            (sum, (r.len() as f64 + 4.0) * U * scale + radius * (1.0 + 1e-9) + f64::MIN_POSITIVE)
        };
        self.rows.iter().zip(b).map(row).unzip()
    }

    /// The values, where they are symmetric bit for bit.
    fn symmetric(&self) -> Option<Vec<Vec<(usize, f64)>>> {
        let values: Vec<Vec<(usize, f64)>> =
            self.rows.iter().map(|r| r.iter().filter(|e| e.1 != 0.0).map(|e| (e.0, e.1)).collect()).collect();
        profile::is_symmetric(&values).then_some(values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The Dirichlet problem on a path: the solution is linear.
    fn path(n: usize) -> System {
        let row = |i: usize| {
            let mut r = vec![(i, 2.0, 0.0)];
            if i > 0 {
                r.insert(0, (i - 1, -1.0, 0.0));
            }
            if i + 1 < n {
                r.push((i + 1, -1.0, 0.0));
            }
            r
        };
        System { rows: (0..n).map(row).collect() }
    }

    #[test]
    fn the_solution_on_a_path_is_linear_within_its_bound_dense_and_sparse() {
        for n in [7, 250, 1000] {
            let system = path(n);
            let mut b = vec![0.0; n];
            b[n - 1] = 1.0;
            let found = Solver::new(&system).unwrap().solve(&b);
            for i in 0..n {
                let exact = (i + 1) as f64 / (n + 1) as f64;
                assert!((found.x[i] - exact).abs() <= found.error[i] + 1e-16, "{n} {i}");
                assert!(found.error[i] < 1e-6, "{n} {i} {}", found.error[i]);
            }
        }
    }

    #[test]
    fn an_uncertain_matrix_makes_an_uncertain_solution() {
        let mut system = path(5);
        system.rows[2][1].2 = 1e-3;
        let found = Solver::new(&system).unwrap().solve(&[0.0, 0.0, 0.0, 0.0, 1.0]);
        system.rows[2][1].1 += 1e-3;
        let moved = Solver::new(&system).unwrap().solve(&[0.0, 0.0, 0.0, 0.0, 1.0]);
        for i in 0..5 {
            assert!((found.x[i] - moved.x[i]).abs() <= found.error[i]);
        }
    }

    #[test]
    fn singular_and_indefinite_systems_are_not_solved() {
        let singular = System { rows: vec![vec![(0, 1.0, 0.0), (1, 1.0, 0.0)], vec![(0, 1.0, 0.0), (1, 1.0, 0.0)]] };
        assert!(Solver::new(&singular).is_err());
        let mut indefinite = path(400);
        indefinite.rows[200][1].1 = -2.0;
        assert!(Solver::new(&indefinite).is_err());
    }
}
