//! All eigenvalues of a small pencil at once, through the Cholesky factor of its mass.

use super::{Pencil, Spectrum, SpectrumError, gap};
use crate::linalg::factor::{Ldlt, pencil_eigen};
use crate::linalg::panel::{Panel, WIDTH};

impl Pencil<'_> {
    /// All eigenvalues of `G⁻¹ L G⁻ᵀ`, `M = G Gᵀ`.
    pub(super) fn dense(&self, count: usize) -> Result<Spectrum, SpectrumError> {
        let n = self.stiffness.rows();
        let (values, vectors) = pencil_eigen(self.stiffness, self.mass)?;
        let cut = gap(&values, count, self.below()).unwrap_or(n);
        let mut kept: Vec<Panel> = vec![vec![[0.0; WIDTH]; n]; cut.div_ceil(WIDTH)];
        for j in 0..cut {
            (0..n).for_each(|i| kept[j / WIDTH][i][j % WIDTH] = vectors[(i, j)]);
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
