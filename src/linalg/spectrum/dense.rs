//! All eigenvalues of a small pencil at once, through the Cholesky factor of its mass.

use super::{Pencil, Spectrum, SpectrumError, gap};
use crate::linalg::factor::{Ldlt, symmetric_eigen};
use crate::linalg::panel::{Panel, WIDTH};
use crate::linalg::{Csr, Dense};

impl Pencil<'_> {
    /// All eigenvalues of `G⁻¹ L G⁻ᵀ`, `M = G Gᵀ`.
    pub(super) fn dense(&self, count: usize) -> Result<Spectrum, SpectrumError> {
        let n = self.stiffness.rows();
        let root = cholesky(self.mass)?;
        let columns: Vec<Vec<f64>> = (0..n)
            .map(|j| {
                let mut column: Vec<f64> = (0..n).map(|i| self.stiffness.at(i, j)).collect();
                forward(&root, &mut column);
                column
            })
            .collect();
        // The rows of G⁻¹L, solved once more, are the columns of G⁻¹ L G⁻ᵀ.
        let mut entries = Vec::with_capacity(n * n);
        for i in 0..n {
            let mut row: Vec<f64> = columns.iter().map(|column| column[i]).collect();
            forward(&root, &mut row);
            entries.extend(row.into_iter().enumerate().take(i + 1).map(|(j, v)| (i, j, v)));
        }
        let (values, vectors) = symmetric_eigen(&Csr::from_triplets(n, n, &entries))?;
        let cut = gap(&values, count, self.below()).unwrap_or(n);
        let mut kept: Vec<Panel> = vec![vec![[0.0; WIDTH]; n]; cut.div_ceil(WIDTH)];
        for (j, vector) in vectors.iter().take(cut).enumerate() {
            let mut u = vector.clone();
            backward(&root, &mut u);
            (0..n).for_each(|i| kept[j / WIDTH][i][j % WIDTH] = u[i]);
        }
        let values_kept = values[..cut].to_vec();
        if cut == n {
            let mut spectrum = self.spectrum(values_kept, &kept, f64::INFINITY, (n, 0.0), 0);
            spectrum.closure.certified = true;
            return Ok(spectrum);
        }
        let tau = 0.5 * (values[cut - 1] + values[cut]);
        let counted = self.count(&Ldlt::new(&self.shifted(tau))?);
        if counted.0 != cut {
            return Err(SpectrumError::Incomplete { count: counted.0, cut: tau, found: cut });
        }
        Ok(self.spectrum(values_kept, &kept, tau, counted, 0))
    }
}

/// The lower triangular G with `G Gᵀ = M`.
fn cholesky(mass: &Csr) -> Result<Dense<f64>, SpectrumError> {
    let n = mass.rows();
    let mut g: Vec<Vec<f64>> = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| g[i][k] * g[j][k]).sum();
            let rest = mass.at(i, j) - sum;
            if i == j && (rest.is_nan() || rest <= 0.0) {
                return Err(SpectrumError::Mass { row: i });
            }
            g[i][j] = if i == j { rest.sqrt() } else { rest / g[j][j] };
        }
    }
    Ok(Dense::from_fn(n, n, |i, j| g[i][j]))
}

fn forward(g: &Dense<f64>, x: &mut [f64]) {
    for i in 0..x.len() {
        let sum: f64 = (0..i).map(|k| g.at(i, k) * x[k]).sum();
        x[i] = (x[i] - sum) / g.at(i, i);
    }
}

fn backward(g: &Dense<f64>, x: &mut [f64]) {
    for i in (0..x.len()).rev() {
        let sum: f64 = (i + 1..x.len()).map(|k| g.at(k, i) * x[k]).sum();
        x[i] = (x[i] - sum) / g.at(i, i);
    }
}
