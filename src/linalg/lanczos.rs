//! Block Lanczos with thick restarts for a pencil `(L, M)`, shift-inverted, in the inner product of M.
//!
//! # Method
//! For a shift σ that is no eigenvalue the operator `K⁻¹M`, `K = L − σM`, is self-adjoint in `⟨x, y⟩ = xᵀMy`; an eigenpair (λ, u) of
//! `L u = λ M u` is one of `K⁻¹M` for `θ = 1/(λ − σ)`, those next to σ first. The Krylov space of a block of eight random vectors
//! is built one block at a time and kept orthonormal: against the last blocks first, where the recurrence puts its
//! coefficients, then once more against everything, which removes what rounding left. When the space is full the best Ritz
//! vectors are kept and the iteration goes on from the same residual block (Wu and Simon's thick restart).
//!
//! A block finds up to eight copies of a multiple eigenvalue at once. That none is missed is not promised here: it is what the
//! inertia count of [`spectrum`](super::spectrum) is for, and [`Lanczos::refresh`] puts a fresh random block in where it finds
//! one missing.
//!
//! # Cost
//! Memory: `largest + 24` vectors. A block step solves eight right-hand sides and reads the space twice to orthogonalise, `4 n m` operations a
//! vector, m the dimension reached.

use faer::{Mat, Side};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::Csr;
use super::factor::{FactorError, Ldlt};
use super::panel::{self, Panel, Square, WIDTH};

/// Columns of a block whose squared length is below this share of the largest are noise: the square root is 10⁻¹³, some
/// hundred roundings.
const NOISE: f64 = 1e-26;

/// Columns of a block that lose more than two digits of their length when they are made orthonormal are made orthogonal to the space
/// again: the loss magnifies what rounding left, and two digits of sixteen keep the space orthonormal to well below the tolerance.
const LOSS: f64 = 1e-4;

/// The iteration: an orthonormal basis, the operator on it, and the block that comes next.
pub(super) struct Lanczos<'a> {
    mass: &'a Csr,
    basis: Vec<Panel>,
    projected: Mat<f64>,
    /// The panel where the blocks begin that a step is orthogonalised against first.
    recent: usize,
    next: Panel,
    /// The triangle that couples the space to the block that comes next.
    coupling: Mat<f64>,
    random: ChaCha8Rng,
    /// Right-hand sides solved so far.
    pub(super) solves: usize,
}

/// Ritz pairs, |θ| descending, with the residual norms of the shift-inverted problem relative to |θ|.
pub(super) struct Ritz {
    pub(super) theta: Vec<f64>,
    pub(super) residual: Vec<f64>,
    pub(super) rotation: Mat<f64>,
}

impl<'a> Lanczos<'a> {
    /// Starts from random vectors. The mass is in the numbering of the elimination.
    pub(super) fn new(mass: &'a Csr, seed: u64) -> Result<Self, FactorError> {
        let mut iteration = Lanczos {
            mass,
            basis: Vec::new(),
            projected: Mat::zeros(0, 0),
            recent: 0,
            next: Vec::new(),
            coupling: Mat::zeros(WIDTH, WIDTH),
            random: ChaCha8Rng::seed_from_u64(seed),
            solves: 0,
        };
        iteration.refresh()?;
        Ok(iteration)
    }

    /// The dimension of the space.
    pub(super) fn dimension(&self) -> usize {
        WIDTH * self.basis.len()
    }

    /// Replaces the next block by random vectors orthogonal to what there is.
    pub(super) fn refresh(&mut self) -> Result<(), FactorError> {
        let mut block = vec![[0.0; WIDTH]; self.mass.rows()];
        (0..WIDTH).for_each(|j| self.randomise(&mut block, j));
        self.orthogonalise(&mut block, 0);
        self.orthonormalise(&mut block, 0.0)?;
        self.next = block;
        self.recent = 0;
        Ok(())
    }

    /// Grows the space to a dimension, with a factorisation of `L − σM`, and returns its Ritz pairs.
    pub(super) fn grow(&mut self, factor: &Ldlt, dimension: usize) -> Result<Ritz, FactorError> {
        while self.dimension() < dimension {
            self.step(factor)?;
        }
        let m = self.dimension();
        let h = Mat::from_fn(m, m, |i, j| 0.5 * (self.projected[(i, j)] + self.projected[(j, i)]));
        let eigen = h.self_adjoint_eigen(Side::Lower).map_err(|_| FactorError::Unfinished)?;
        let s = eigen.S().column_vector();
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|&i, &j| s[j].abs().total_cmp(&s[i].abs()));
        let rotation = Mat::from_fn(m, m, |i, j| eigen.U()[(i, order[j])]);
        let tail = &self.coupling * rotation.get(m - WIDTH.min(m).., ..);
        let norm = |j: usize| tail.col(j).norm_l2() / s[order[j]].abs().max(f64::MIN_POSITIVE);
        Ok(Ritz { theta: order.iter().map(|&j| s[j]).collect(), residual: (0..m).map(norm).collect(), rotation })
    }

    /// Keeps the Ritz vectors with these numbers, and as many of the others as fill the last block, and gives up the rest of the space.
    pub(super) fn restart(&mut self, ritz: &Ritz, numbers: &[usize]) {
        let mut chosen = numbers.to_vec();
        let others = (0..ritz.theta.len()).filter(|k| !numbers.contains(k));
        chosen.extend(others.take(numbers.len().next_multiple_of(WIDTH) - numbers.len()));
        let square = |a: usize, b: usize| -> Square {
            std::array::from_fn(|i| std::array::from_fn(|j| ritz.rotation[(WIDTH * a + i, chosen[WIDTH * b + j])]))
        };
        let kept = chosen.len() / WIDTH;
        let squares: Vec<Vec<Square>> =
            (0..self.basis.len()).map(|a| (0..kept).map(|b| square(a, b)).collect()).collect();
        panel::combine(&mut self.basis, &squares);
        let theta = |i: usize, j: usize| if i == j { ritz.theta[chosen[i]] } else { 0.0 };
        self.projected = Mat::from_fn(chosen.len(), chosen.len(), theta);
        // The first step after a restart couples to all that is kept.
        self.recent = 0;
    }

    /// The basis, M-orthonormal; after a restart its first vectors are the ones that were chosen.
    pub(super) fn into_basis(self) -> Vec<Panel> {
        self.basis
    }

    /// One block more.
    fn step(&mut self, factor: &Ldlt) -> Result<(), FactorError> {
        let m = self.dimension();
        let mut image = panel::apply(self.mass, &self.next);
        self.basis.push(std::mem::take(&mut self.next));
        factor.substitute(&mut image);
        self.solves += WIDTH;
        let grown = self.dimension();
        let mut coefficients = Mat::<f64>::zeros(grown, WIDTH);
        let passes = if self.recent == 0 { [0, 0] } else { [self.recent, 0] };
        for from in passes {
            for (k, square) in self.orthogonalise(&mut image, from).iter().enumerate() {
                for (i, j) in (0..WIDTH).flat_map(|i| (0..WIDTH).map(move |j| (i, j))) {
                    coefficients[(WIDTH * (from + k) + i, j)] += square[i][j];
                }
            }
        }
        self.projected.resize_with(grown, grown, |_, _| 0.0);
        for j in 0..WIDTH {
            for i in 0..grown {
                self.projected[(i, m + j)] = coefficients[(i, j)];
                self.projected[(m + j, i)] = coefficients[(i, j)];
            }
        }
        // A recurrence of three blocks: the image of the next block has components along that block and this one.
        self.recent = self.basis.len() - 1;
        let taken = (0..WIDTH).map(|j| coefficients.col(j).squared_norm_l2()).fold(0.0, f64::max);
        self.coupling = self.orthonormalise(&mut image, taken)?;
        self.next = image;
        Ok(())
    }

    /// Makes a block orthogonal to the basis from a panel on, and returns what it took off.
    fn orthogonalise(&self, block: &mut Panel, from: usize) -> Vec<Square> {
        let weighted = panel::apply(self.mass, block);
        let squares = panel::products(&self.basis[from..], &weighted);
        panel::subtract(block, &self.basis[from..], &squares);
        squares
    }

    /// Makes a block that is orthogonal to the basis M-orthonormal, through the eigenvectors of its Gram matrix, as often as it takes.
    /// Columns that vanish beside the squared length `taken` off before are replaced by random ones orthogonal to the basis. Returns R
    /// with `block before = block after · R`.
    fn orthonormalise(&mut self, block: &mut Panel, taken: f64) -> Result<Mat<f64>, FactorError> {
        let b = WIDTH;
        let mut triangle = Mat::<f64>::identity(b, b);
        // Once to scale the columns, once more after what they lost to the basis, and again where some had vanished.
        for round in 0..4 {
            let weighted = panel::apply(self.mass, block);
            let gram = panel::products(std::slice::from_ref(block), &weighted)[0];
            let eigen = Mat::from_fn(b, b, |i, j| 0.5 * (gram[i][j] + gram[j][i]))
                .self_adjoint_eigen(Side::Lower)
                .map_err(|_| FactorError::Unfinished)?;
            let (s, u) = (eigen.S().column_vector(), eigen.U());
            let largest = s[b - 1];
            let noise = NOISE * if round == 0 { largest.max(taken) } else { largest };
            let is_sound = |j: usize| s[j] > noise.max(f64::MIN_POSITIVE);
            let scale = |j: usize| if is_sound(j) { s[j].sqrt() } else { 0.0 };
            let inverse = |j: usize| if is_sound(j) { 1.0 / s[j].sqrt() } else { 0.0 };
            panel::transform(block, &std::array::from_fn(|i| std::array::from_fn(|j| u[(i, j)] * inverse(j))));
            triangle = Mat::from_fn(b, b, |i, j| u[(j, i)] * scale(i)) * &triangle;
            let lost: Vec<usize> = (0..b).filter(|&j| !is_sound(j)).collect();
            if lost.is_empty() && s[0] > LOSS * largest {
                break;
            }
            lost.iter().for_each(|&j| self.randomise(block, j));
            self.orthogonalise(block, 0);
        }
        Ok(triangle)
    }

    fn randomise(&mut self, block: &mut Panel, j: usize) {
        block.iter_mut().for_each(|row| row[j] = self.random.random::<f64>() - 0.5);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::factor::Elimination;

    #[test]
    fn a_space_that_is_exhausted_goes_on_with_vectors_orthogonal_to_it() {
        // One eigenvalue of three hundred copies: after the first block there is nothing new in the Krylov space.
        let mass = Csr::diagonal(&(0..300).map(|i| 1.0 + f64::from(i % 3)).collect::<Vec<_>>());
        let l = mass.clone();
        let factor = Elimination::row_by_row(&l).unwrap().factor(&l).unwrap();
        let mut lanczos = Lanczos::new(&mass, 1).unwrap();
        lanczos.grow(&factor, 80).unwrap();
        let basis = lanczos.into_basis();
        for (b, panel) in basis.iter().enumerate() {
            let weighted = panel::apply(&mass, panel);
            for (a, square) in panel::products(&basis, &weighted).iter().enumerate() {
                for (i, j) in (0..WIDTH).flat_map(|i| (0..WIDTH).map(move |j| (i, j))) {
                    let wanted = f64::from(u8::from(a == b && i == j));
                    assert!((square[i][j] - wanted).abs() < 1e-10, "{a} {b} {i} {j}: {}", square[i][j]);
                }
            }
        }
    }
}
