//! The lower end of the spectrum of a large pencil, by shift-inverted block Lanczos.
//!
//! # The shift
//! An eigenvalue λ is found the sooner the larger `|λ − σ|⁻¹` is beside that of the eigenvalues that are not wanted. With σ inside the
//! wanted part both of its ends are at most a half of it away, which takes a quarter of the solves less than with σ below the spectrum.
//! The factorisation tells how many eigenvalues p lie below σ; a σ with p between a third and four fifths of those wanted is accepted, found
//! from Weyl's law for surfaces, `λ_k ≈ 4πk/A`, and corrected by what p turns out to be. Where that does not end, or few are wanted, σ lies
//! below the spectrum.
//!
//! With σ inside, `L − σM` is indefinite and is factorised without pivoting. Nothing rests on the accuracy of that: the residuals
//! are computed from L and M themselves, the spectrum is closed by its own count, and where that gives no certificate the iteration is run once
//! more with σ below the spectrum.

use super::{Pencil, Spectrum, SpectrumError, TOLERANCE, gap};
use crate::linalg::dissection::dissection;
use crate::linalg::factor::{Elimination, FactorError, Ldlt};
use crate::linalg::lanczos::{Lanczos, Ritz};
use crate::linalg::panel::WIDTH;

/// A Ritz value with this relative residual is good to its square, which is that of the tolerance: enough to see a gap before it.
const ROUGH: f64 = 1e-5;

/// Below this number of eigenvalues a shift inside the spectrum saves less than the search for it costs.
const FEW: usize = 2 * WIDTH;

/// So many shifts are tried for one inside the wanted part.
const TRIALS: usize = 6;

/// After so many restarts without an end the iteration gives up.
const PATIENCE: usize = 60;

impl Pencil<'_> {
    /// At least `count` of the smallest eigenvalues, closed by an inertia count.
    pub(super) fn slice(&self, count: usize, seed: u64) -> Result<Spectrum, SpectrumError> {
        let order = dissection(&self.shifted(1.0));
        let (stiffness, mass) = (self.stiffness.permuted(&order), self.mass.permuted(&order));
        let diagonal = order.iter().map(|&i| self.diagonal[i]).collect();
        let inner = Pencil { stiffness: &stiffness, mass: &mass, diagonal, domination: self.domination };
        let elimination = Elimination::row_by_row(&inner.shifted(1.0))?;
        let within = if count < FEW { None } else { inner.shift_within(&elimination, count)? };
        if let Some(shift) = within
            && let Ok(found) = inner.iterate(&elimination, shift, count, seed)
            && found.closure.certified
        {
            return inner.refuse_negative(found.renumbered(&order));
        }
        let sigma = inner.below();
        let factor = elimination.factor(&inner.shifted(sigma))?;
        if factor.inertia().positive < inner.stiffness.rows() {
            return Err(SpectrumError::Indefinite { shift: sigma });
        }
        let found = inner.iterate(&elimination, Shift { sigma, below: 0, factor }, count, seed)?;
        Ok(found.renumbered(&order))
    }

    fn refuse_negative(&self, found: Spectrum) -> Result<Spectrum, SpectrumError> {
        match found.values.first() {
            Some(first) if *first < self.below() => Err(SpectrumError::Indefinite { shift: self.below() }),
            _ => Ok(found),
        }
    }

    /// A shift with between a third and four fifths of `count` eigenvalues below it, if one is found.
    fn shift_within(&self, elimination: &Elimination, count: usize) -> Result<Option<Shift>, SpectrumError> {
        // Three fifths of the eigenvalues wanted: the middle of what is accepted.
        let wanted = 0.6 * count as f64;
        let mut sigma = -self.below() * wanted;
        for _ in 0..TRIALS {
            let factor = elimination.factor(&self.shifted(sigma))?;
            let below = factor.inertia().negative;
            if 3 * below >= count && 5 * below <= 4 * count {
                return Ok(Some(Shift { sigma, below, factor }));
            }
            sigma *= (wanted / below.max(1) as f64).clamp(0.125, 8.0);
        }
        Ok(None)
    }

    fn iterate(
        &self,
        elimination: &Elimination,
        Shift { sigma, below, mut factor }: Shift,
        count: usize,
        seed: u64,
    ) -> Result<Spectrum, SpectrumError> {
        let n = self.stiffness.rows();
        let most = n / WIDTH * WIDTH;
        let mut wanted = count + WIDTH;
        let room = |wanted: usize| (8 * wanted / 5 + 3 * WIDTH).next_multiple_of(WIDTH).min(most);
        let mut lanczos = Lanczos::new(self.mass, seed)?;
        let mut patience = PATIENCE;
        loop {
            // The space is looked at now and then while it grows, each time an eighth larger.
            let next = lanczos.dimension().max(wanted) * 9 / 8 + WIDTH;
            let ritz = lanczos.grow(&factor, next.min(room(wanted)))?;
            let known = known(&ritz, sigma, below);
            let converged = known.iter().take_while(|k| ritz.residual[k.number] <= TOLERANCE).count();
            let values: Vec<f64> = known.iter().map(|k| k.value).collect();
            let cut = gap(&values, count, self.below()).filter(|cut| *cut <= converged);
            let full = lanczos.dimension() >= room(wanted);
            if let Some(cut) = cut {
                let tau = 0.5 * (values[cut - 1] + values[cut]);
                lanczos.restart(&ritz, &known[..cut].iter().map(|k| k.number).collect::<Vec<_>>());
                // One factorisation at a time: beside the space they are what takes memory.
                drop(factor);
                let counted = self.count(&elimination.factor(&self.shifted(tau))?);
                if counted.0 == cut {
                    let solves = lanczos.solves;
                    return Ok(self.spectrum(values[..cut].to_vec(), &lanczos.into_basis(), tau, counted, solves));
                }
                if counted.0 < cut || patience == 0 {
                    return Err(SpectrumError::Incomplete { count: counted.0, cut: tau, found: cut });
                }
                // A copy is missing: everything found is kept, and a fresh random block looks for it.
                factor = elimination.factor(&self.shifted(sigma))?;
                lanczos.refresh()?;
            } else if full {
                if converged >= wanted {
                    // No gap yet: the search goes on for more from what it has.
                    wanted = (wanted + wanted / 4 + WIDTH).min(most);
                }
                let keep = (wanted + (lanczos.dimension().saturating_sub(wanted)) / 3).max(converged);
                let keep = keep.next_multiple_of(WIDTH).min(lanczos.dimension().saturating_sub(2 * WIDTH));
                lanczos.restart(&ritz, &(0..keep).collect::<Vec<_>>());
            } else {
                continue;
            }
            patience = match patience.checked_sub(1) {
                Some(left) => left,
                None => return Err(SpectrumError::Factor(FactorError::Unfinished)),
            };
        }
    }
}

/// `L − σM`, factorised, and the number of eigenvalues below σ.
struct Shift {
    sigma: f64,
    below: usize,
    factor: Ldlt,
}

/// An eigenvalue that is known to within the square of its residual.
struct Known {
    value: f64,
    number: usize,
}

/// The eigenvalues that are known without a hole, ascending: all `below` of them below the shift, then those above it up to the first
/// that is not known; none unless all below are.
fn known(ritz: &Ritz, sigma: f64, below: usize) -> Vec<Known> {
    let mut known: Vec<Known> = (0..ritz.theta.len())
        .filter(|&k| ritz.residual[k] <= ROUGH)
        .map(|number| Known { value: sigma + 1.0 / ritz.theta[number], number })
        .collect();
    known.sort_by(|a, b| a.value.total_cmp(&b.value));
    if known.iter().filter(|k| k.value < sigma).count() < below {
        return Vec::new();
    }
    let unknown = (0..ritz.theta.len()).find(|&k| ritz.theta[k] > 0.0 && ritz.residual[k] > ROUGH);
    let end = unknown.map_or(f64::INFINITY, |k| sigma + 1.0 / ritz.theta[k]);
    known.retain(|k| k.value < end);
    known
}

impl Spectrum {
    /// The same vectors with their entry k as number `order[k]`.
    fn renumbered(mut self, order: &[usize]) -> Self {
        let mut moved = vec![0.0; self.n];
        for vector in self.vectors.chunks_mut(self.n) {
            order.iter().zip(vector.iter()).for_each(|(&i, v)| moved[i] = *v);
            vector.copy_from_slice(&moved);
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use faer::Mat;

    use super::*;
    use crate::linalg::Csr;

    /// Eigenvalues with their residuals, as Ritz pairs for a shift of 5.
    fn ritz(pairs: &[(f64, f64)]) -> Ritz {
        let mut pairs: Vec<(f64, f64)> =
            pairs.iter().map(|(value, residual)| (1.0 / (value - 5.0), *residual)).collect();
        pairs.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
        let (theta, residual) = pairs.into_iter().unzip();
        Ritz { theta, residual, rotation: Mat::zeros(0, 0) }
    }

    #[test]
    fn what_is_known_has_no_hole() {
        let found = |pairs: &[(f64, f64)], below: usize| -> Vec<f64> {
            known(&ritz(pairs), 5.0, below).iter().map(|k| (1e6 * k.value).round() / 1e6).collect()
        };
        let all = [(1.0, 0.0), (2.0, 1e-6), (7.0, 0.0), (8.0, 1e-6), (9.0, 0.0)];
        assert_eq!(found(&all, 2), [1.0, 2.0, 7.0, 8.0, 9.0]);
        // A value above the shift that is not known ends the list, one below it empties it, as does one that is not there.
        let mut above = all;
        above[3].1 = 1e-4;
        assert_eq!(found(&above, 2), [1.0, 2.0, 7.0]);
        let mut under = all;
        under[0].1 = 1e-4;
        assert_eq!(found(&under, 2), [0.0; 0]);
        assert_eq!(found(&all, 3), [0.0; 0]);
    }

    #[test]
    fn a_shift_inside_the_wanted_part_takes_fewer_solves_and_finds_the_same() {
        let n = 2000;
        let path = (0..n - 1).flat_map(|i| [(i, i, 1.0), (i + 1, i + 1, 1.0), (i, i + 1, -1.0), (i + 1, i, -1.0)]);
        let (l, mass) = (Csr::from_triplets(n, n, &path.collect::<Vec<_>>()), Csr::diagonal(&vec![1e-2; n]));
        let pencil = Pencil::new(&l, &mass).unwrap();
        let elimination = Elimination::row_by_row(&pencil.shifted(1.0)).unwrap();
        let within = pencil.shift_within(&elimination, 40).unwrap().unwrap();
        assert!((14..=32).contains(&within.below) && within.below == pencil.count(&within.factor).0);
        let sigma = pencil.below();
        let outside = Shift { sigma, below: 0, factor: elimination.factor(&pencil.shifted(sigma)).unwrap() };
        let [inside, outside] = [within, outside].map(|s| pencil.iterate(&elimination, s, 40, 1).unwrap());
        assert!(inside.solves < outside.solves, "{} {}", inside.solves, outside.solves);
        assert_eq!(inside.values.len(), outside.values.len());
        for (a, b) in inside.values.iter().zip(&outside.values) {
            assert!((a - b).abs() < 1e-9, "{a} {b}");
        }
    }
}
