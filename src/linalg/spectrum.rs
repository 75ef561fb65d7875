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
//! is at least the number of eigenvalues below `τ − e`, `e = |E|/c`. The k computed vectors V are M-orthonormal up to
//! `δ = ‖VᵀMV − I‖_F`, hence there are at least k eigenvalues within `√2 r/√(1 − δ)` of the computed ones, r the Frobenius norm of their
//! residuals (Kahan), all below `τ − e`. If N = k these are all, each once:
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

mod dense;
mod slice;

use super::Csr;
use super::factor::{FactorError, Ldlt};
use super::panel::{self, Panel, WIDTH};

/// Up to this many unknowns the dense decomposition is at least as quick as the iteration.
const DENSE_UP_TO: usize = 256;

/// Ritz values of the shift-inverted problem are good to this relative residual; the eigenvalue is good to its square.
const TOLERANCE: f64 = 1e-10;

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
/// Two or three factorisations, and some `4 count` solves; memory for about `3 count + 60` vectors.
pub fn lowest(stiffness: &Csr, mass: &Csr, count: usize, seed: u64) -> Result<Spectrum, SpectrumError> {
    let n = stiffness.rows();
    if mass.rows() != n {
        return Err(SpectrumError::Sizes { stiffness: n, mass: mass.rows() });
    }
    if let Some(row) = (0..n).find(|&i| mass.at(i, i).is_nan() || mass.at(i, i) <= 0.0) {
        return Err(SpectrumError::Mass { row });
    }
    let pencil = Pencil::new(stiffness, mass)?;
    if n <= DENSE_UP_TO || 4 * count >= n { pencil.dense(count) } else { pencil.slice(count, seed) }
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
    fn below(&self) -> f64 {
        let total: f64 = self.mass.entries().map(|(_, _, m)| m).sum();
        -4.0 * std::f64::consts::PI / total
    }

    /// What a factorisation of `L − τM` counts below τ, with its backward error relative to M.
    fn count(&self, factor: &Ldlt) -> (usize, f64) {
        (factor.inertia().negative, factor.backward_error(&self.diagonal) / self.domination)
    }

    /// The spectrum with its residuals, from vectors in panels in the numbering of the pencil.
    fn spectrum(
        &self,
        values: Vec<f64>,
        vectors: &[Panel],
        cut: f64,
        (count, backward_error): (usize, f64),
        solves: usize,
    ) -> Spectrum {
        let (residuals, defect) = self.defects(&values, vectors);
        let all = (2.0 * residuals.iter().map(|r| r * r).sum::<f64>() / self.domination / (1.0 - defect)).sqrt();
        let last = values.last().copied().unwrap_or(f64::NEG_INFINITY);
        // From a defect of 1 on there is no bound: `all` is infinite or no number, and nothing is certified.
        let certified = last + all < cut - backward_error;
        let closure = Closure { cut, count, backward_error, certified };
        let n = self.stiffness.rows();
        let entry = |j: usize, i: usize| vectors[j / WIDTH][i][j % WIDTH];
        let vectors = (0..values.len()).flat_map(|j| (0..n).map(move |i| entry(j, i))).collect();
        Spectrum { values, residuals, closure, solves, n, vectors }
    }

    /// The residual of each pair, and `‖VᵀMV − I‖_F`.
    fn defects(&self, values: &[f64], vectors: &[Panel]) -> (Vec<f64>, f64) {
        let (mut squares, mut defect) = (vec![0.0; values.len()], 0.0);
        for (b, (u, values)) in vectors.iter().zip(values.chunks(WIDTH)).enumerate() {
            let squares = &mut squares[WIDTH * b..][..values.len()];
            let (lu, mu) = (panel::apply(self.stiffness, u), panel::apply(self.mass, u));
            for ((l, m), d) in lu.iter().zip(&mu).zip(&self.diagonal) {
                for (j, lambda) in values.iter().enumerate() {
                    squares[j] += (l[j] - lambda * m[j]) * (l[j] - lambda * m[j]) / d;
                }
            }
            for (a, gram) in panel::products(&vectors[..=b], &mu).iter().enumerate() {
                for (i, j) in (0..WIDTH).flat_map(|i| (0..values.len()).map(move |j| (i, j))) {
                    match a == b {
                        true if i >= values.len() => {}
                        true => defect += (gram[i][j] - f64::from(u8::from(i == j))).powi(2),
                        false => defect += 2.0 * gram[i][j] * gram[i][j],
                    }
                }
            }
        }
        (squares.into_iter().map(f64::sqrt).collect(), defect.sqrt())
    }
}

/// The first place k ≥ `count` with `λ_{k+1} − λ_k` at least half the mean spacing of the values up to there,
/// and large enough to be told from the tolerance of the values, which are resolved relative to their distance from `sigma`.
fn gap(values: &[f64], count: usize, sigma: f64) -> Option<usize> {
    let first = values.first()?;
    (count.max(1)..values.len()).find(|&k| {
        let step = values[k] - values[k - 1];
        step > TOLERANCE * (values[k] - sigma) && 2.0 * step * k as f64 >= values[k] - first
    })
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
        let (dense, iterated) = (pencil.dense(20).unwrap(), pencil.slice(20, 3).unwrap());
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
            let entry = |i: usize, j: usize| match j < count {
                true => found.vector(j)[i] + if i == j { shaken } else { 0.0 },
                false => 0.0,
            };
            let panel = |p: usize| (0..255).map(|i| std::array::from_fn(|q| entry(i, WIDTH * p + q))).collect();
            let vectors: Vec<Panel> = (0..count.div_ceil(WIDTH)).map(panel).collect();
            pencil.spectrum(found.values.clone(), &vectors, cut, (count, backward_error), 0).closure.certified
        };
        let room = cut - found.values[count - 1];
        assert!(certified(0.0, 0.0) && certified(1e-9, 0.5 * room));
        assert!(!certified(room, 0.0) && !certified(0.0, 1.5 * room));
    }

    #[test]
    fn an_eigenvector_with_a_value_off_by_delta_has_the_residual_delta_whatever_the_masses() {
        let (l, _) = torus(15, 17);
        for scale in [1e-3, 1.0, 40.0] {
            let mass = Csr::diagonal(&(0..255).map(|i| scale * (1.0 + f64::from(i % 7))).collect::<Vec<_>>());
            let pencil = Pencil::new(&l, &mass).unwrap();
            let found = pencil.dense(20).unwrap();
            let delta = 1e-3 / scale;
            let values: Vec<f64> = found.values.iter().map(|v| v + delta).collect();
            let entry = |i: usize, j: usize| if j < values.len() { found.vector(j)[i] } else { 0.0 };
            let panel = |p: usize| (0..255).map(|i| std::array::from_fn(|q| entry(i, WIDTH * p + q))).collect();
            let vectors: Vec<Panel> = (0..values.len().div_ceil(WIDTH)).map(panel).collect();
            for residual in pencil.defects(&values, &vectors).0 {
                assert!((residual / delta - 1.0).abs() < 1e-9, "{residual} is not {delta}");
            }
        }
    }

    #[test]
    fn eigenvalues_below_zero_are_refused_by_either_shift() {
        let (l, _) = torus(20, 20);
        let unit = Csr::diagonal(&vec![1.0; 400]);
        for (sunk, count) in [(0.1, 3), (0.1, 20), (0.1, 40), (0.5, 40)] {
            let l = l.map(|i, j, v| if i == j { v - sunk } else { *v });
            let found = lowest(&l, &unit, count, 0);
            assert!(matches!(found, Err(SpectrumError::Indefinite { .. })), "{sunk} {count}");
        }
    }

    #[test]
    fn a_vector_found_twice_is_not_certified() {
        let (l, _) = torus(15, 17);
        let mass = Csr::diagonal(&vec![1.0; 255]);
        let pencil = Pencil::new(&l, &mass).unwrap();
        let found = pencil.dense(20).unwrap();
        let (count, cut) = (found.values.len(), found.closure.cut);
        let certified = |other: usize| {
            let entry =
                |i: usize, j: usize| if j < count { found.vector(if j == 1 { other } else { j })[i] } else { 0.0 };
            let panel = |p: usize| (0..255).map(|i| std::array::from_fn(|q| entry(i, WIDTH * p + q))).collect();
            let vectors: Vec<Panel> = (0..count.div_ceil(WIDTH)).map(panel).collect();
            let mut values = found.values.clone();
            values[1] = values[other];
            pencil.spectrum(values, &vectors, cut, (count, 0.0), 0).closure.certified
        };
        assert!(certified(1) && !certified(2), "every residual is as small");
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
