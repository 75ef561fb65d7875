//! KER: only locally constant functions are in the kernel.
//!
//! # Definition
//! `ker L` = the functions that are constant on each connected component of the domain; its dimension is the number of
//! components, isolated vertices counted.
//!
//! # Decision
//! 1. Locally constant functions must be in the kernel: row sums vanish up to rounding, over each component.
//! 2. No weight negative: −L generates a random walk, and `dim ker L` is the number of its closed classes (a harmonic function
//!    is constant on each by the maximum principle and determined by these constants elsewhere). Combinatorial.
//! 3. Symmetric: the inertia of `L ± τ diag(s)` counts the eigenvalues relative to `diag(s)` in `(−τ, τ)`, for τ from four
//!    times the backward error of the factorisation upwards until exactly the constants are left inside.
//! 4. Otherwise the singular values of `diag(s)^(−½) L diag(s)^(−½)`, s the larger of the sums of a row and its column so that a sliver
//!    has no say elsewhere; dense, up to [`LARGEST_DENSE`] vertices. As many as there are components must be zero up to the
//!    rounding of the decomposition and what constants leave, and the next one is bounded away from that
//!    ([`regular`](crate::linalg::regular)).
//!
//! The kernel is that of the matrix as it is given. A second vector whose image is not zero, but smaller than what rounding explains
//! beside a sliver, is none; how near to the kernel it may come is told in `docs/tolerance.md`.
//!
//! A further vector of the kernel is accepted as a witness when Lx vanishes exactly; or up to what rounding explains on healthy
//! faces (Q = 1) while entries are of such sizes that the eigenvalues of a correct operator off the kernel are a thousand times
//! larger. On a mesh squeezed by 1e7 even linear functions come that near to the kernel, and nothing is decided.
//!
//! # Exception
//! Not applicable to point clouds, where being connected is a matter of distance. A matrix that is neither symmetric nor without
//! negative weights is not decided beyond [`LARGEST_DENSE`] vertices.
//!
//! # Cost
//! O(n + nnz) for step 2, two sparse factorisations for step 3, O(n³) for step 4.

use super::evidence::Excerpt;
use super::excerpt::{copy_rows, of_all_rows, of_rows};
use super::measure::row;
use super::solve::chains::Chains;
use super::solve::null_vector;
use super::tolerance::{Sign, Threshold, UNIT_ROUNDOFF};
use super::{Evidence, Level, Property, Question, Statement, Trial, Verdict};
use crate::domain::DomainKind;
use crate::linalg::Csr;
use crate::linalg::factor::Ldlt;
use crate::linalg::full::Full;
use crate::linalg::regular::singular_value_from_below;
use crate::scalar::{Rational, Scalar};

/// Singular values are computed up to this many vertices.
pub const LARGEST_DENSE: usize = 500;

/// Where no rigorous bound was found, singular values count as apart where the next one is this many times the bound for those
/// counted as zero: the constant in the backward error of the algorithm is known only as "small".
const GAP: f64 = 8.0;

/// How far a vanishing image must lie below the eigenvalues that are to be expected.
const CLEARANCE: f64 = 1024.0;

/// The catalogue entry.
pub static ENTRY: Property = Property {
    id: "KER",
    name: "kernel of locally constant functions",
    statement: "Lx = 0 ⇔ x is constant on each connected component",
    sources: &["wardetzky2007"],
    question: Question::Operator(decide),
};

fn decide(trial: &Trial) -> Verdict {
    if let Some(verdict) = trial.unless_finite() {
        return verdict;
    }
    if trial.domain.vertex_count() == 0 {
        return Verdict::not_applicable("the domain has no vertex");
    }
    if trial.domain.kind() == DomainKind::Points {
        return Verdict::not_applicable("in a point cloud being connected is a matter of distance");
    }
    let case = Case::new(trial);
    let verdict = case.constants().or_else(|| case.pieces()).or_else(|| case.random_walk());
    let verdict = verdict.unwrap_or_else(|| if row::is_symmetric(case.matrix) { case.inertia() } else { case.dense() });
    verdict.with_note(format!("components: {}", case.count))
}

struct Case<'a> {
    trial: &'a Trial<'a>,
    matrix: &'a Csr,
    scales: &'a [f64],
    components: Vec<usize>,
    count: usize,
}

impl<'a> Case<'a> {
    fn new(trial: &'a Trial<'a>) -> Self {
        let (matrix, components) = (trial.operator.stiffness(), trial.domain.components());
        let count = components.iter().max().map_or(0, |m| m + 1);
        Case { trial, matrix, scales: &trial.scales().rows, components, count }
    }

    /// Locally constant functions: fails where a row sum, or the part of it in one component, does not vanish.
    fn constants(&self) -> Option<Verdict> {
        let (sum, foreign) = (|i: usize| row::sum(self.matrix, i).abs(), |i: usize| self.foreign(i));
        let (row, margin) = self.worst(sum, |t| t.defect);
        if margin > 1.0 {
            let threshold = self.trial.rounding().row(row).defect * self.scales[row];
            let evidence = Evidence::new(Statement::RowSum { i: row, threshold }, of_rows(self.trial, [row]));
            return Some(Verdict::fails(Level::Bounded, evidence).with_margin(margin));
        }
        let (row, margin) = self.worst(foreign, |t| t.defect);
        if margin > 1.0 {
            return Some(self.joined(row, margin));
        }
        let (row, margin) = self.worst(sum, |t| t.explained);
        (margin > 1.0).then(|| {
            Verdict::undecided(format!(
                "the sum of row {row} is {margin:.2} times what rounding explains: constants may not be in the kernel"
            ))
        })
    }

    /// The magnitude of the entries of a row that lie in other components.
    fn foreign(&self, i: usize) -> f64 {
        let elsewhere = self.matrix.row(i).filter(|&(j, _)| self.components[j] != self.components[i]);
        elsewhere.map(|(_, v)| v.abs()).sum()
    }

    /// The row with the largest residual over a threshold.
    fn worst(&self, residual: impl Fn(usize) -> f64, threshold: impl Fn(Threshold) -> f64) -> (usize, f64) {
        let ratio = |i: usize| residual(i) / (threshold(self.trial.rounding().row(i)) * self.scales[i]);
        let rows = (0..self.matrix.rows()).filter(|&i| self.scales[i] > 0.0).map(|i| (i, ratio(i)));
        rows.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
    }

    /// A row that joins two components of the domain.
    fn joined(&self, i: usize, margin: f64) -> Verdict {
        let foreign = self.matrix.row(i).filter(|&(j, _)| self.components[j] != self.components[i]);
        let j = foreign.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).map_or(i, |(j, _)| j);
        let mut excerpt = Excerpt { rows: copy_rows(self.matrix, [i]), ..Excerpt::default() };
        match self.trial.domain.as_surface() {
            Some(surface) => {
                let star = surface.topology().star(i).iter();
                excerpt.faces = star.map(|c| (c.face(), surface.faces()[c.face()].to_vec())).collect();
            }
            None => excerpt.edges = self.trial.domain.edges().iter().filter(|e| e.contains(&i)).copied().collect(),
        }
        Verdict::fails(Level::Bounded, Evidence::new(Statement::FarEntry { i, j, rings: None }, excerpt))
            .with_margin(margin)
            .with_note("the indicator of a component is not in the kernel: this entry joins two components")
    }

    /// A part of a component that no entry joins to the rest: its indicator is in the kernel.
    fn pieces(&self) -> Option<Verdict> {
        let joined: Vec<[usize; 2]> =
            self.matrix.entries().filter(|(i, j, v)| i != j && **v != 0.0).map(|(i, j, _)| [i, j]).collect();
        let piece = crate::domain::topology::components(self.matrix.rows(), &joined);
        let mut first = vec![usize::MAX; self.count];
        for (v, &c) in self.components.iter().enumerate() {
            if first[c] == usize::MAX {
                first[c] = v;
            } else if piece[first[c]] != piece[v] {
                // The smaller of the two is the better witness.
                let size = |at: usize| piece.iter().filter(|&&p| p == piece[at]).count();
                let (inside, outside) = if size(v) <= size(first[c]) { (v, first[c]) } else { (first[c], v) };
                let x: Vec<f64> = piece.iter().map(|&p| f64::from(u8::from(p == piece[inside]))).collect();
                let explained = |i: usize| self.trial.rounding().row(i).explained;
                let near = |i: usize| self.image(&x, i) <= explained(i) * self.scales[i];
                return (0..x.len()).all(near).then(|| self.too_large(&x, inside, outside, explained));
            }
        }
        None
    }

    /// No negative weight: the number of closed classes. Weights that rounding could have made must not change it.
    fn random_walk(&self) -> Option<Verdict> {
        if !(0..self.matrix.rows()).all(|i| row::no_negative_weight(self.matrix, i)) {
            return None;
        }
        let rounding = self.trial.rounding();
        let kernel = Chains::new(self.matrix, |_, _, v| v < 0.0).closed_classes();
        let decisive =
            Chains::new(self.matrix, |i, _, v| v < 0.0 && rounding.weight(i, v) != Sign::Zero).closed_classes();
        if kernel != decisive || kernel != self.count {
            return None;
        }
        Some(Verdict::holds(self.trial.level_of_signs(), Evidence::bare(Statement::ClosedClasses { kernel })))
    }

    fn inertia(&self) -> Verdict {
        let rows: Vec<usize> = (0..self.scales.len()).filter(|&i| self.scales[i] > 0.0).collect();
        let empty = self.scales.len() - rows.len();
        let part = self.matrix.symmetric_part().submatrix(&rows, &rows);
        let scales: Vec<f64> = rows.iter().map(|&i| self.scales[i]).collect();
        let shifted = |shift: f64| {
            let diagonal: Vec<f64> = scales.iter().map(|s| shift * s).collect();
            Ldlt::new(&part.add(&Csr::diagonal(&diagonal))).ok()
        };
        let mut tried = String::from("no shift gave a factorisation");
        let mut shift = 512.0 * UNIT_ROUNDOFF;
        let mut candidate = None;
        while shift < 1e-4 {
            let (above, below) = (shifted(shift), shifted(-shift));
            let (Some(above), Some(below)) = (above, below) else {
                shift *= 7.0;
                continue;
            };
            let error = above.backward_error(&scales).max(below.backward_error(&scales));
            if 4.0 * error > shift {
                shift = (8.0 * error).max(2.0 * shift);
                continue;
            }
            let (negative, within) = (above.inertia().negative, below.inertia().negative + empty);
            tried = format!(
                "{within} eigenvalues are below {shift:.1e} of the row scales, {negative} below −{shift:.1e}; {} expected",
                self.count
            );
            if negative == 0 && within == self.count {
                let statement = Statement::InertiaCount { shift, kernel: self.count };
                return Verdict::holds(Level::Bounded, Evidence::bare(statement)).with_margin(error / shift);
            }
            if negative == 0 && within > self.count {
                candidate = null_vector::by_iteration(&above, &scales, &rows, &self.components);
                break;
            }
            shift *= 16.0;
        }
        if let Some(verdict) = candidate.and_then(|x| self.beyond_constants(&x)) {
            return verdict;
        }
        if self.scales.len() <= LARGEST_DENSE { self.dense() } else { Verdict::undecided(tried) }
    }

    fn dense(&self) -> Verdict {
        let n = self.matrix.rows();
        if n > LARGEST_DENSE {
            return Verdict::not_applicable(format!(
                "the matrix is not symmetric and has negative weights; its kernel is decided by singular values, which is \
                 done up to {LARGEST_DENSE} vertices (here {n})"
            ));
        }
        let root = self.roots();
        let mut scaled = Full::from_fn(n, |_, _| 0.0);
        self.matrix.entries().for_each(|(i, j, v)| scaled.set(i, j, v / root[i] / root[j]));
        let Ok(found) = scaled.singular_values() else {
            return Verdict::undecided("the singular values did not converge");
        };
        let largest = found.values.first().copied().unwrap_or(0.0);
        if largest == 0.0 {
            let statement = Statement::SingularValues { kernel: n, zero: 0.0, positive: 0.0 };
            return Verdict::holds(Level::Exact, Evidence::bare(statement));
        }
        // Backward stable: each value is off by a small multiple of n u times the largest. Constants add what they leave.
        let zero = 16.0 * n as f64 * UNIT_ROUNDOFF + self.image_of_constants(&root) / largest;
        let kernel = found.values.iter().filter(|v| **v <= zero * largest).count();
        let at = |k: usize| found.values.get(k).map_or(0.0, |v| v / largest);
        if kernel == self.count && kernel < n {
            // Two quotients round each entry twice.
            let bound = singular_value_from_below(&scaled, &found, kernel, 2.5 * UNIT_ROUNDOFF) / largest;
            let positive = at(n - kernel - 1);
            if bound > zero || positive > GAP * zero {
                let level = if bound > zero { Level::Bounded } else { Level::Measured };
                let statement = Statement::SingularValues { kernel, zero: at(n - kernel), positive };
                return Verdict::holds(level, Evidence::bare(statement)).with_margin(zero / positive);
            }
        }
        if kernel > self.count {
            let unscaled = |v: &Vec<f64>| v.iter().zip(&root).map(|(v, r)| v / r).collect();
            let space: Vec<Vec<f64>> = found.right[n - kernel..].iter().map(unscaled).collect();
            let candidate = null_vector::farthest_from_constants(&space, &self.components);
            if let Some(verdict) = candidate.and_then(|x| self.beyond_constants(&x)) {
                return verdict;
            }
        }
        Verdict::undecided(format!(
            "{kernel} singular values are below {zero:.1e} of the largest, the next is {:.1e}; {} expected",
            at(n.saturating_sub(kernel + 1)),
            self.count
        ))
    }

    /// The square roots of the larger of the absolute sums of a row and its column; 1 where both are empty.
    fn roots(&self) -> Vec<f64> {
        let mut sums = self.scales.to_vec();
        let columns = self.matrix.transpose().row_scales();
        sums.iter_mut().zip(columns).for_each(|(s, c)| *s = s.max(c));
        sums.into_iter().map(|s| if s > 0.0 { s.sqrt() } else { 1.0 }).collect()
    }

    /// The largest `‖Bx‖ / ‖x‖` of the scaled matrix for x a scaled indicator of a component; of more than one component the sum,
    /// which covers their combinations.
    fn image_of_constants(&self, root: &[f64]) -> f64 {
        let mut images = vec![(0.0, 0.0); self.count];
        for (i, r) in root.iter().enumerate() {
            let mut sums = vec![0.0; self.count];
            self.matrix.row(i).for_each(|(j, v)| sums[self.components[j]] += v);
            images.iter_mut().zip(&sums).for_each(|(image, sum)| image.0 += (sum / r).powi(2));
            images[self.components[i]].1 += r * r;
        }
        images.iter().map(|(image, size)| (image / size).sqrt()).sum()
    }

    /// The verdict on a vector that may be in the kernel without being locally constant.
    fn beyond_constants(&self, x: &[f64]) -> Option<Verdict> {
        let (a, b, spread) = null_vector::widest(x, &self.components)?;
        let own = self.components[a];
        let shifted = |i: usize| if self.components[i] == own { (x[i] - x[b]) / spread * (1.0 + 1e-6) } else { 0.0 };
        let scaled: Vec<f64> = (0..x.len()).map(shifted).collect();
        let healthy = |i: usize| Threshold::over(1.0, self.matrix.row(i).len(), 1.0).explained;
        let near = (0..x.len()).all(|i| self.image(&scaled, i) <= healthy(i) * self.scales[i]);
        let exact = near && (0..x.len()).all(|i| self.image(&scaled, i) == 0.0);
        let threshold = (0..x.len()).map(healthy).fold(0.0, f64::max);
        (exact || near && threshold * CLEARANCE < self.smallest_expected())
            .then(|| self.too_large(&scaled, a, b, healthy))
    }

    /// A crude bound for the smallest eigenvalue off the kernel that a correct operator with these entries has, relative to the row
    /// scales: with weights at least w on a connected graph of n vertices `Σ ω (x_i − x_j)² ≥ w/n` for values that spread by
    /// one, against `Σ s_i x_i² ≤ n max s`.
    fn smallest_expected(&self) -> f64 {
        let off = self.matrix.entries().filter(|(i, j, v)| i != j && **v != 0.0);
        let weakest = off.map(|(_, _, v)| v.abs()).fold(f64::INFINITY, f64::min);
        let largest = self.scales.iter().copied().fold(0.0, f64::max);
        weakest / largest / (self.scales.len() as f64).powi(2)
    }

    /// `|(Lx)_i|`, exact up to the last rounding.
    fn image(&self, x: &[f64], i: usize) -> f64 {
        let exact = |v: f64| Rational::exactly(v).unwrap_or_else(Rational::zero);
        let terms = self.matrix.row(i).filter(|&(j, _)| x[j] != 0.0).map(|(j, v)| exact(*v) * exact(x[j]));
        crate::scalar::sum(terms).approximate().abs()
    }

    fn too_large(&self, x: &[f64], a: usize, b: usize, explained: impl Fn(usize) -> f64) -> Verdict {
        let images: Vec<f64> = (0..x.len()).map(|i| self.image(x, i)).collect();
        let exact = images.iter().all(|v| *v == 0.0);
        let ratio = |i: usize| if images[i] == 0.0 { 0.0 } else { images[i] / (explained(i) * self.scales[i]) };
        let margin = (0..x.len()).map(ratio).fold(0.0, f64::max);
        let threshold = (0..x.len()).map(explained).fold(0.0, f64::max);
        let statement = Statement::KernelVector {
            x: x.iter().copied().enumerate().filter(|&(_, v)| v != 0.0).collect(),
            a,
            b,
            threshold,
        };
        let evidence = Evidence::new(statement, of_all_rows(self.trial, 0..x.len()));
        Verdict::fails(if exact { Level::Exact } else { Level::Bounded }, evidence).with_margin(margin)
    }
}
