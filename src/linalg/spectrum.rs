//! The lower end of the spectrum of a pencil, `L u = λ M u`, complete: closed by an inertia count.
//!
//! `L` is symmetric and positive semi-definite, `M` symmetric and positive definite, lumped or full. Eigenpairs come from a
//! block Lanczos iteration (`lanczos`), or densely where the matrix is small. Iterations of this kind lose copies of multiple
//! eigenvalues now and then, so none is believed: the spectrum is cut in a gap, and the number of eigenvalues below the cut
//! is counted by the signs of the pivots of `L − τM`.
//!
//! # What is certified
//! The computed pivots are those of `L − τM + E` exactly, with E bounded relative to `diag(M)` by
//! [`Ldlt::backward_error`]; and `M ≥ c diag(M)` with c = 1 for a lumped mass, else ¼, confirmed by a factorisation. So the count N
//! is at least the number of eigenvalues below `τ − e`, `e = |E|/c`. The k computed vectors are M-orthonormal, hence there are at
//! least k eigenvalues within their residual of the computed ones (Kahan), all below `τ − e`. If N = k these are all, each once:
//! [`Closure::certified`]. Where the residuals or e do not leave that room, the count agrees but is not a proof.
//!
//! # Where the spectrum is cut
//! A multiple eigenvalue is not to be cut in two: k is raised to the next gap of at least half the mean spacing so
//! far. Eigenvalues of a surface grow linearly (Weyl), and a sequence without repulsion has such a gap after each value
//! with probability `exp(−½)`, three in five, so that a step or two more suffice as a rule; the copies of a multiplet of the smooth operator differ
//! by its discretisation error, which is of the second order in the mesh size.
//!
//! # References
//! Parlett 1998, chapters 10 to 13; Grimes, Lewis and Simon 1994 for shift-invert with inertia counts.

use faer::Mat;

use super::factor::{FactorError, Ldlt, symmetric_eigen};
use super::lanczos::Lanczos;
use super::{Csr, Dense};

/// Up to this many unknowns the dense decomposition is at least as quick as the iteration.
const DENSE_UP_TO: usize = 256;

/// Right-hand sides in a block: two threads with half a dozen cache lines each, and as many copies of an eigenvalue at once.
const BLOCK: usize = 8;

/// Ritz values of the shift-inverted problem are good to this relative residual; the eigenvalue is good to its square.
const TOLERANCE: f64 = 1e-10;

/// After so many restarts without a new eigenpair the iteration gives up.
const PATIENCE: usize = 60;

/// Eigenpairs, ascending.
#[derive(Clone, Debug)]
pub struct Spectrum {
    /// The eigenvalues.
    pub values: Vec<f64>,
    /// `‖L u − λ M u‖` in the norm of `diag(M)⁻¹`, u of M-norm one: for a lumped mass an eigenvalue is that near to λ, for a
    /// consistent one within twice that.
    pub residuals: Vec<f64>,
    /// Why none is missing below the last one.
    pub closure: Closure,
    /// Right-hand sides solved.
    pub solves: usize,
    n: usize,
    vectors: Vec<f64>,
}

/// The inertia count that closes a spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closure {
    /// Where the spectrum is cut: between the last eigenvalue and the next one; infinite where all were computed.
    pub cut: f64,
    /// How many eigenvalues lie below the cut; always the number computed.
    pub count: usize,
    /// By how much an eigenvalue of the pencil that was really factorised may differ.
    pub backward_error: f64,
    /// Whether residuals and backward error leave no room for another eigenvalue below the cut.
    pub certified: bool,
}

/// Why there is no spectrum.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SpectrumError {
    /// The matrices do not make a pencil.
    #[error("a stiffness matrix of {stiffness} rows and a mass matrix of {mass} rows make no pencil")]
    Sizes {
        /// Rows of L.
        stiffness: usize,
        /// Rows of M.
        mass: usize,
    },
    /// A mass that is not positive.
    #[error(
        "the mass matrix is not positive definite (row {row}), so that L u = λ M u has no complete system of eigenvectors; \
         use another mass, or leave out vertices without mass"
    )]
    Mass {
        /// A row with a diagonal entry that is not positive, or where the elimination found a pivot that is not.
        row: usize,
    },
    /// `L` is not positive semi-definite up to rounding.
    #[error("the stiffness matrix has a negative eigenvalue below {shift:e}; see PSD")]
    Indefinite {
        /// The shift below which one lies.
        shift: f64,
    },
    /// The iteration did not find what the inertia count says is there.
    #[error("{count} eigenvalues lie below {cut:e}, and {found} of them were found")]
    Incomplete {
        /// Eigenvalues below the cut.
        count: usize,
        /// The cut.
        cut: f64,
        /// How many were found.
        found: usize,
    },
    /// A factorisation failed.
    #[error(transparent)]
    Factor(#[from] FactorError),
}

impl Spectrum {
    /// The j-th eigenvector, of M-norm one.
    pub fn vector(&self, j: usize) -> &[f64] {
        &self.vectors[j * self.n..(j + 1) * self.n]
    }
}

/// The smallest eigenvalues of `L u = λ M u` and their vectors: at least `count`, more where the last would cut a cluster in
/// two, all where there are no more. `seed` chooses the random start.
///
/// # Errors
/// A mass that is not positive definite, a stiffness matrix with a negative eigenvalue, a factorisation or iteration that does
/// not finish.
///
/// # Cost
/// Two factorisations, and some `2 count` solves; memory for about `3 count + 40` vectors.
pub fn lowest(stiffness: &Csr, mass: &Csr, count: usize, seed: u64) -> Result<Spectrum, SpectrumError> {
    let n = stiffness.rows();
    if mass.rows() != n {
        return Err(SpectrumError::Sizes { stiffness: n, mass: mass.rows() });
    }
    if let Some(row) = (0..n).find(|&i| mass.at(i, i).is_nan() || mass.at(i, i) <= 0.0) {
        return Err(SpectrumError::Mass { row });
    }
    let pencil = Pencil::new(stiffness, mass)?;
    if n <= DENSE_UP_TO || 4 * count >= n { pencil.dense(count) } else { pencil.iterate(count, seed) }
}

/// The pencil with what is known of it.
struct Pencil<'a> {
    stiffness: &'a Csr,
    mass: &'a Csr,
    diagonal: Vec<f64>,
    /// `M ≥ c diag(M)`.
    domination: f64,
}

impl<'a> Pencil<'a> {
    fn new(stiffness: &'a Csr, mass: &'a Csr) -> Result<Self, SpectrumError> {
        let diagonal: Vec<f64> = (0..mass.rows()).map(|i| mass.at(i, i)).collect();
        let lumped = mass.entries().all(|(i, j, v)| i == j || *v == 0.0);
        let domination = if lumped {
            1.0
        } else {
            let reduced = mass.add(&Csr::diagonal(&diagonal.iter().map(|d| -0.25 * d).collect::<Vec<_>>()));
            let factor = Ldlt::new(&reduced)?;
            if let Some(at) = factor.pivots().iter().position(|d| d.is_nan() || *d <= 0.0) {
                return Err(SpectrumError::Mass { row: factor.order()[at] });
            }
            0.25
        };
        Ok(Pencil { stiffness, mass, diagonal, domination })
    }

    /// `L − τM`.
    fn shifted(&self, tau: f64) -> Csr {
        self.stiffness.add(&self.mass.map(|_, _, m| -tau * m))
    }

    /// A shift below the spectrum, of the order of the first eigenvalue above zero of a surface with this area (Weyl: `4π/A`): near
    /// enough to tell the smallest eigenvalues apart, far enough to keep `L − σM` well conditioned.
    fn shift(&self) -> f64 {
        let total: f64 = self.mass.entries().map(|(_, _, m)| m).sum();
        -4.0 * std::f64::consts::PI / total
    }

    fn iterate(&self, count: usize, seed: u64) -> Result<Spectrum, SpectrumError> {
        let n = self.stiffness.rows();
        let sigma = self.shift();
        let factor = Ldlt::new(&self.shifted(sigma))?;
        if factor.inertia().positive < n {
            return Err(SpectrumError::Indefinite { shift: sigma });
        }
        let mut wanted = (count + BLOCK).min(n);
        let room = |wanted: usize| (2 * wanted + 3 * BLOCK).min(n);
        let mut lanczos = Lanczos::new(&factor, self.mass, BLOCK, room(wanted), seed)?;
        let mut patience = PATIENCE;
        loop {
            let ritz = lanczos.fill()?;
            let converged = ritz.residual.iter().take_while(|r| **r <= TOLERANCE).count();
            let values: Vec<f64> = ritz.theta.iter().map(|theta| sigma + 1.0 / theta).collect();
            if let Some(cut) = gap(&values[..converged], count, sigma) {
                let tau = 0.5 * (values[cut - 1] + values[cut]);
                let counted = self.count_below(tau)?;
                if counted.0 == cut {
                    let vectors = lanczos.vectors(&ritz, cut);
                    return Ok(self.spectrum(values[..cut].to_vec(), &vectors, tau, counted, lanczos.solves));
                }
                if counted.0 < cut || patience == 0 {
                    return Err(SpectrumError::Incomplete { count: counted.0, cut: tau, found: cut });
                }
                // A copy is missing: everything found is kept, and a fresh random block looks for it.
                lanczos.restart(&ritz, converged.min(lanczos.largest() - 2 * BLOCK));
                lanczos.refresh()?;
            } else {
                if converged >= wanted {
                    // No gap yet: the search goes on for more from what it has.
                    wanted = (wanted + wanted / 4 + BLOCK).min(n);
                    lanczos.enlarge(room(wanted));
                }
                let keep = (wanted + (lanczos.largest() - wanted) / 3).min(lanczos.largest() - 2 * BLOCK);
                lanczos.restart(&ritz, keep.max(converged).min(lanczos.largest() - 2 * BLOCK));
            }
            patience = match patience.checked_sub(1) {
                Some(left) => left,
                None => return Err(SpectrumError::Factor(FactorError::Unfinished)),
            };
        }
    }

    /// The number of negative pivots of `L − τM`, with the backward error relative to M.
    fn count_below(&self, tau: f64) -> Result<(usize, f64), SpectrumError> {
        let factor = Ldlt::new(&self.shifted(tau))?;
        let error = factor.backward_error(&self.diagonal) / self.domination;
        Ok((factor.inertia().negative, error))
    }

    fn spectrum(
        &self,
        values: Vec<f64>,
        vectors: &Mat<f64>,
        cut: f64,
        (count, backward_error): (usize, f64),
        solves: usize,
    ) -> Spectrum {
        let n = self.stiffness.rows();
        let vectors: Vec<f64> = (0..values.len()).flat_map(|j| (0..n).map(move |i| vectors[(i, j)])).collect();
        let residuals: Vec<f64> =
            values.iter().enumerate().map(|(j, lambda)| self.residual(*lambda, &vectors[j * n..(j + 1) * n])).collect();
        // Kahan: the eigenvalues differ by at most √2 times the norm of all residuals together.
        let all = (2.0 * residuals.iter().map(|r| r * r).sum::<f64>() / self.domination).sqrt();
        let last = values.last().copied().unwrap_or(f64::NEG_INFINITY);
        let certified = last + all < cut - backward_error;
        let closure = Closure { cut, count, backward_error, certified };
        Spectrum { values, residuals, closure, solves, n, vectors }
    }

    fn residual(&self, lambda: f64, u: &[f64]) -> f64 {
        let (lu, mu) = (self.stiffness.mul(u), self.mass.mul(u));
        let terms = lu.iter().zip(&mu).zip(&self.diagonal);
        terms.map(|((l, m), d)| (l - lambda * m) * (l - lambda * m) / d).sum::<f64>().sqrt()
    }

    /// All eigenvalues of `G⁻¹ L G⁻ᵀ`, `M = G Gᵀ`.
    fn dense(&self, count: usize) -> Result<Spectrum, SpectrumError> {
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
        let cut = gap(&values, count, self.shift()).unwrap_or(n);
        let mut kept = Mat::zeros(n, cut);
        for (j, vector) in vectors.iter().take(cut).enumerate() {
            let mut u = vector.clone();
            backward(&root, &mut u);
            (0..n).for_each(|i| kept[(i, j)] = u[i]);
        }
        let values_kept = values[..cut].to_vec();
        if cut == n {
            let mut spectrum = self.spectrum(values_kept, &kept, f64::INFINITY, (n, 0.0), 0);
            spectrum.closure.certified = true;
            return Ok(spectrum);
        }
        let tau = 0.5 * (values[cut - 1] + values[cut]);
        let counted = self.count_below(tau)?;
        if counted.0 != cut {
            return Err(SpectrumError::Incomplete { count: counted.0, cut: tau, found: cut });
        }
        Ok(self.spectrum(values_kept, &kept, tau, counted, 0))
    }
}

/// The first place k ≥ `count` with `λ_{k+1} − λ_k` at least half the mean spacing of the values up to there.
/// and large enough to be told from the tolerance of the values, which are resolved relative to their distance from `sigma`.
fn gap(values: &[f64], count: usize, sigma: f64) -> Option<usize> {
    let first = values.first()?;
    (count.max(1)..values.len()).find(|&k| {
        let step = values[k] - values[k - 1];
        step > TOLERANCE * (values[k] - sigma) && 2.0 * step * k as f64 >= values[k] - first
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The periodic grid of m × n vertices with unit weights: eigenvalues `4 − 2 cos(2πa/m) − 2 cos(2πb/n)`.
    fn torus(m: usize, n: usize) -> (Csr, Vec<f64>) {
        let at = |a: usize, b: usize| (a % m) * n + b % n;
        let mut t = Vec::new();
        for a in 0..m {
            for b in 0..n {
                t.push((at(a, b), at(a, b), 4.0));
                for j in [at(a + 1, b), at(a + m - 1, b), at(a, b + 1), at(a, b + n - 1)] {
                    t.push((at(a, b), j, -1.0));
                }
            }
        }
        let c = |k: usize, n: usize| 2.0 - 2.0 * (std::f64::consts::TAU * k as f64 / n as f64).cos();
        let mut exact: Vec<f64> = (0..m * n).map(|k| c(k / n, m) + c(k % n, n)).collect();
        exact.sort_by(f64::total_cmp);
        (Csr::from_triplets(m * n, m * n, &t), exact)
    }

    fn assert_spectrum(spectrum: &Spectrum, exact: &[f64], count: usize) {
        assert!(spectrum.values.len() >= count && spectrum.closure.certified, "{:?}", spectrum.closure);
        assert_eq!(spectrum.closure.count, spectrum.values.len());
        for (k, (found, exact)) in spectrum.values.iter().zip(exact).enumerate() {
            assert!((found - exact).abs() < 1e-9, "{k}: {found} is not {exact}");
            assert!(spectrum.residuals[k] < 1e-6, "{k}: {}", spectrum.residuals[k]);
        }
        let k = spectrum.values.len();
        assert!(exact[k] - exact[k - 1] > 1e-6, "a multiplet was cut at {k}");
    }

    #[test]
    fn every_copy_of_every_eigenvalue_of_a_periodic_grid_is_found_from_any_start() {
        // Copies come in eights and fours on the square torus.
        let (l, exact) = torus(24, 24);
        let mass = Csr::diagonal(&vec![1.0; 576]);
        for seed in 0..20 {
            for count in [1, 5, 30] {
                assert_spectrum(&lowest(&l, &mass, count, seed).unwrap(), &exact, count);
            }
        }
    }

    #[test]
    fn the_dense_and_the_iterated_spectrum_agree() {
        let (l, exact) = torus(15, 17);
        let mass = Csr::diagonal(&vec![1.0; 255]);
        let pencil = Pencil::new(&l, &mass).unwrap();
        let (dense, iterated) = (pencil.dense(20).unwrap(), pencil.iterate(20, 3).unwrap());
        assert_eq!(dense.values.len(), iterated.values.len());
        assert_spectrum(&dense, &exact, 20);
        assert_spectrum(&iterated, &exact, 20);
    }

    #[test]
    fn what_residuals_or_rounding_could_hide_is_not_certified() {
        let (l, _) = torus(15, 17);
        let mass = Csr::diagonal(&vec![1.0; 255]);
        let pencil = Pencil::new(&l, &mass).unwrap();
        let found = pencil.dense(20).unwrap();
        let (count, cut) = (found.values.len(), found.closure.cut);
        let certified = |shaken: f64, backward_error: f64| {
            let vectors = Mat::from_fn(255, count, |i, j| found.vector(j)[i] + if i == j { shaken } else { 0.0 });
            pencil.spectrum(found.values.clone(), &vectors, cut, (count, backward_error), 0).closure.certified
        };
        let room = cut - found.values[count - 1];
        assert!(certified(0.0, 0.0) && certified(1e-9, 0.5 * room));
        assert!(!certified(room, 0.0) && !certified(0.0, 1.5 * room));
    }

    #[test]
    fn eigenvectors_are_orthonormal_in_a_full_mass() {
        // P1 elements on an interval of 700 cells: λ = 6/h² (1 − cos kh)/(2 + cos kh), kh = πj/700.
        let (n, h) = (701, 1.0 / 700.0);
        let (mut l, mut m) = (Vec::new(), Vec::new());
        for i in 0..n - 1 {
            for (a, b, sign) in [(i, i, 1.0), (i + 1, i + 1, 1.0), (i, i + 1, -1.0), (i + 1, i, -1.0)] {
                l.push((a, b, sign / h));
                m.push((a, b, if a == b { h / 3.0 } else { h / 6.0 }));
            }
        }
        let (l, m) = (Csr::from_triplets(n, n, &l), Csr::from_triplets(n, n, &m));
        let spectrum = lowest(&l, &m, 12, 1).unwrap();
        for (j, value) in spectrum.values.iter().enumerate() {
            let c = (std::f64::consts::PI * j as f64 * h).cos();
            let exact = 6.0 / (h * h) * (1.0 - c) / (2.0 + c);
            assert!((value - exact).abs() < 1e-7 * exact.max(1.0), "{j}: {value} is not {exact}");
            for k in 0..=j {
                let product: f64 = m.mul(spectrum.vector(j)).iter().zip(spectrum.vector(k)).map(|(a, b)| a * b).sum();
                assert!((product - f64::from(u8::from(j == k))).abs() < 1e-10, "{j} {k}: {product}");
            }
        }
        assert!(spectrum.closure.certified);
    }

    #[test]
    fn a_kernel_of_many_components_is_found_whole() {
        // Thirty rings of twenty vertices: the kernel has dimension thirty, more than a block.
        let mut t = Vec::new();
        for ring in 0..30 {
            for k in 0..20 {
                let (i, j) = (20 * ring + k, 20 * ring + (k + 1) % 20);
                t.extend([(i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)]);
            }
        }
        let spectrum = lowest(&Csr::from_triplets(600, 600, &t), &Csr::diagonal(&vec![1.0; 600]), 3, 0).unwrap();
        assert_eq!(spectrum.values.len(), 30);
        assert!(spectrum.values.iter().all(|v| v.abs() < 1e-12) && spectrum.closure.certified);
    }

    #[test]
    fn what_is_no_pencil_of_a_laplacian_is_refused() {
        let (l, _) = torus(20, 20);
        let negative = l.map(|_, _, v| -v);
        let unit = Csr::diagonal(&vec![1.0; 400]);
        assert!(matches!(lowest(&negative, &unit, 3, 0), Err(SpectrumError::Indefinite { .. })));
        let mut masses = vec![1.0; 400];
        masses[7] = 0.0;
        assert_eq!(lowest(&l, &Csr::diagonal(&masses), 3, 0).err(), Some(SpectrumError::Mass { row: 7 }));
        assert!(matches!(lowest(&l, &Csr::diagonal(&[1.0; 3]), 3, 0), Err(SpectrumError::Sizes { .. })));
    }

    #[test]
    fn a_gap_is_not_inside_a_cluster() {
        let values = [0.0, 1.0, 1.0 + 1e-9, 1.0 + 2e-9, 2.0];
        assert_eq!([1, 2, 3].map(|count| gap(&values, count, -1.0)), [Some(1), Some(4), Some(4)]);
        assert_eq!(gap(&values, 5, -1.0), None);
    }
}
