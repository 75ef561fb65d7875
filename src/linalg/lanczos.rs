//! Block Lanczos with thick restarts for a pencil `(L, M)`, shift-inverted, in the inner product of M.
//!
//! # Method
//! For `K = L − σM` positive definite the operator `K⁻¹M` is self-adjoint in `⟨x, y⟩ = xᵀMy`; an eigenpair (λ, u) of
//! `L u = λ M u` is one of `K⁻¹M` for `θ = 1/(λ − σ)`, the smallest λ first. The Krylov space of a block of b random vectors
//! is built one block at a time and kept orthonormal: against the last blocks first, where the recurrence puts its
//! coefficients, then once more against everything, which removes what rounding left. When the space is full the best Ritz
//! vectors are kept and the iteration goes on from the same residual block (Wu and Simon's thick restart).
//!
//! A block finds up to b copies of a multiple eigenvalue at once. That none is missed is not promised here: it is what the
//! inertia count of [`spectrum`](super::spectrum) is for, and [`Lanczos::refresh`] puts a fresh random block in where it finds
//! one missing.
//!
//! # Cost
//! Memory: (`largest` + 3b) vectors. A block step solves b right-hand sides and spends about `4 n m b` operations on
//! orthogonality, m the dimension reached. Products are split over two threads at fixed places, so the result does not
//! depend on the number of threads.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par, Side};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::Csr;
use super::factor::{FactorError, Ldlt};

/// From here on a product is worth two threads.
const SPLIT_FROM: usize = 4096;

/// Columns of a block whose squared length is below this share of the largest are noise: the square root is 10⁻¹³, some
/// hundred roundings.
const NOISE: f64 = 1e-26;

/// The iteration: an orthonormal basis, the operator on it, and the block that comes next.
pub(super) struct Lanczos<'a> {
    factor: &'a Ldlt,
    mass: &'a Csr,
    basis: Mat<f64>,
    projected: Mat<f64>,
    dimension: usize,
    /// Where the blocks begin that a step is orthogonalised against first.
    recent: usize,
    next: Mat<f64>,
    random: ChaCha8Rng,
    /// Right-hand sides solved so far.
    pub(super) solves: usize,
    /// Restarts so far.
    pub(super) restarts: usize,
}

/// Ritz pairs, θ descending, with the residual norms of the shift-inverted problem relative to θ.
pub(super) struct Ritz {
    pub(super) theta: Vec<f64>,
    pub(super) residual: Vec<f64>,
    rotation: Mat<f64>,
}

impl<'a> Lanczos<'a> {
    /// Starts from random vectors. `largest` is the dimension at which to restart, at least four blocks.
    pub(super) fn new(
        factor: &'a Ldlt,
        mass: &'a Csr,
        block: usize,
        largest: usize,
        seed: u64,
    ) -> Result<Self, FactorError> {
        let n = mass.rows();
        let mut iteration = Lanczos {
            factor,
            mass,
            basis: Mat::zeros(n, largest.max(4 * block)),
            projected: Mat::zeros(largest.max(4 * block), largest.max(4 * block)),
            dimension: 0,
            recent: 0,
            next: Mat::zeros(n, block),
            random: ChaCha8Rng::seed_from_u64(seed),
            solves: 0,
            restarts: 0,
        };
        iteration.refresh()?;
        Ok(iteration)
    }

    /// Replaces the next block by random vectors orthogonal to what there is.
    pub(super) fn refresh(&mut self) -> Result<(), FactorError> {
        let mut block = Mat::zeros(self.next.nrows(), self.next.ncols());
        (0..block.ncols()).for_each(|j| self.randomise(&mut block, j));
        self.orthonormalise(&mut block)?;
        self.next = block;
        self.recent = 0;
        Ok(())
    }

    /// Grows the space to its largest dimension and returns its Ritz pairs.
    pub(super) fn fill(&mut self) -> Result<Ritz, FactorError> {
        let b = self.next.ncols();
        let mut coupling = Mat::zeros(b, b);
        while self.dimension + b <= self.basis.ncols() {
            coupling = self.step()?;
        }
        let m = self.dimension;
        let h = Mat::from_fn(m, m, |i, j| 0.5 * (self.projected[(i, j)] + self.projected[(j, i)]));
        let eigen = h.self_adjoint_eigen(Side::Lower).map_err(|_| FactorError::Unfinished)?;
        let theta = |j: usize| eigen.S().column_vector()[m - 1 - j];
        let rotation = Mat::from_fn(m, m, |i, j| eigen.U()[(i, m - 1 - j)]);
        let tail = &coupling * rotation.get(m - b.., ..);
        let norm = |j: usize| tail.col(j).norm_l2() / theta(j).abs().max(f64::MIN_POSITIVE);
        Ok(Ritz { theta: (0..m).map(theta).collect(), residual: (0..m).map(norm).collect(), rotation })
    }

    /// The first Ritz vectors, M-orthonormal.
    pub(super) fn vectors(&self, ritz: &Ritz, count: usize) -> Mat<f64> {
        combine(self.basis.get(.., ..self.dimension), ritz.rotation.get(.., ..count))
    }

    /// Keeps the first Ritz vectors and gives up the rest of the space.
    pub(super) fn restart(&mut self, ritz: &Ritz, keep: usize) {
        let kept = self.vectors(ritz, keep);
        self.basis.get_mut(.., ..keep).copy_from(&kept);
        self.projected.fill(0.0);
        (0..keep).for_each(|j| self.projected[(j, j)] = ritz.theta[j]);
        self.dimension = keep;
        // The first step after a restart couples to all that is kept.
        self.recent = 0;
        self.restarts += 1;
    }

    /// Raises the dimension at which the space is full.
    pub(super) fn enlarge(&mut self, largest: usize) {
        let (n, before) = (self.basis.nrows(), self.basis.ncols());
        if largest <= before {
            return;
        }
        self.basis.resize_with(n, largest, |_, _| 0.0);
        self.projected.resize_with(largest, largest, |_, _| 0.0);
    }

    /// The dimension at which the space is full.
    pub(super) fn largest(&self) -> usize {
        self.basis.ncols()
    }

    /// One block more; returns the triangle that couples the space to the block after it.
    fn step(&mut self) -> Result<Mat<f64>, FactorError> {
        let (m, b) = (self.dimension, self.next.ncols());
        self.basis.get_mut(.., m..m + b).copy_from(&self.next);
        let mut image = self.apply_mass(self.next.as_ref());
        self.factor.solve_block(image.as_mut());
        self.solves += b;
        let grown = m + b;
        let mut coefficients = Mat::<f64>::zeros(grown, b);
        for from in [self.recent, 0] {
            let space = self.basis.get(.., from..grown);
            let weighted = self.apply_mass(image.as_ref());
            let found = products(space, weighted.as_ref());
            subtract(image.as_mut(), space, found.as_ref());
            for j in 0..b {
                (0..found.nrows()).for_each(|i| coefficients[(from + i, j)] += found[(i, j)]);
            }
        }
        for j in 0..b {
            for i in 0..grown {
                self.projected[(i, m + j)] = coefficients[(i, j)];
                self.projected[(m + j, i)] = coefficients[(i, j)];
            }
        }
        self.dimension = grown;
        // A recurrence of three blocks: the image of the next block has components along that block and this one.
        self.recent = m;
        let coupling = self.orthonormalise(&mut image)?;
        self.next = image;
        Ok(coupling)
    }

    /// Makes a block M-orthonormal (through the eigenvectors of its Gram matrix, as often as it takes) and orthogonal to the basis, columns that vanish being replaced
    /// by random ones orthogonal to the basis. Returns R with `block before = block after · R`.
    fn orthonormalise(&mut self, block: &mut Mat<f64>) -> Result<Mat<f64>, FactorError> {
        let b = block.ncols();
        let mut triangle = Mat::<f64>::identity(b, b);
        // Once to scale the columns, once more after what they lost to the basis, and again where some had vanished.
        for _ in 0..4 {
            let weighted = self.apply_mass(block.as_ref());
            let gram = products(block.as_ref(), weighted.as_ref());
            let eigen = gram.self_adjoint_eigen(Side::Lower).map_err(|_| FactorError::Unfinished)?;
            let (s, u) = (eigen.S().column_vector(), eigen.U());
            let largest = s[b - 1];
            let is_sound = |j: usize| s[j] > largest * NOISE && s[j] > f64::MIN_POSITIVE;
            let scale = |j: usize| if is_sound(j) { s[j].sqrt() } else { 0.0 };
            let inverse = |j: usize| if is_sound(j) { 1.0 / s[j].sqrt() } else { 0.0 };
            *block = combine(block.as_ref(), Mat::from_fn(b, b, |i, j| u[(i, j)] * inverse(j)).as_ref());
            triangle = Mat::from_fn(b, b, |i, j| u[(j, i)] * scale(i)) * &triangle;
            let lost: Vec<usize> = (0..b).filter(|&j| !is_sound(j)).collect();
            // A block that was nearly orthonormal before is as orthogonal to the basis after.
            if lost.is_empty() && s[0] > 0.25 && largest < 4.0 {
                break;
            }
            lost.iter().for_each(|&j| self.randomise(block, j));
            let space = self.basis.get(.., ..self.dimension);
            let weighted = self.apply_mass(block.as_ref());
            let found = products(space, weighted.as_ref());
            subtract(block.as_mut(), space, found.as_ref());
        }
        Ok(triangle)
    }

    fn randomise(&mut self, block: &mut Mat<f64>, j: usize) {
        (0..block.nrows()).for_each(|i| block[(i, j)] = self.random.random::<f64>() - 0.5);
    }

    fn apply_mass(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        let mut y = Mat::zeros(x.nrows(), x.ncols());
        for j in 0..x.ncols() {
            for i in 0..x.nrows() {
                y[(i, j)] = self.mass.row(i).map(|(k, m)| m * x[(k, j)]).sum();
            }
        }
        y
    }
}

/// `Vᵀ W`, the columns of V split over two threads.
fn products(v: MatRef<'_, f64>, w: MatRef<'_, f64>) -> Mat<f64> {
    let mut out = Mat::zeros(v.ncols(), w.ncols());
    let half = v.ncols() / 2;
    let (top, bottom) = out.as_mut().split_at_row_mut(half);
    let (left, right) = v.split_at_col(half);
    both(
        v.nrows(),
        || matmul(top, Accum::Replace, left.transpose(), w, 1.0, Par::Seq),
        || matmul(bottom, Accum::Replace, right.transpose(), w, 1.0, Par::Seq),
    );
    out
}

/// `W −= V C`, the rows split over two threads.
fn subtract(w: MatMut<'_, f64>, v: MatRef<'_, f64>, c: MatRef<'_, f64>) {
    if v.ncols() == 0 {
        return;
    }
    let (n, half) = (v.nrows(), v.nrows() / 2);
    let (top, bottom) = w.split_at_row_mut(half);
    let (above, below) = v.split_at_row(half);
    both(
        n,
        || matmul(top, Accum::Add, above, c, -1.0, Par::Seq),
        || matmul(bottom, Accum::Add, below, c, -1.0, Par::Seq),
    );
}

/// `V S`, the rows split over two threads.
fn combine(v: MatRef<'_, f64>, s: MatRef<'_, f64>) -> Mat<f64> {
    let mut out = Mat::zeros(v.nrows(), s.ncols());
    subtract(out.as_mut(), v, (-1.0 * s).as_ref());
    out
}

fn both(size: usize, one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    if size < SPLIT_FROM {
        one();
        other();
    } else {
        rayon::join(one, other);
    }
}
