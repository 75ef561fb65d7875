//! Thresholds: the one place where it is said how large a residual rounding explains.
//!
//! Every residual is measured against a **local** scale and two thresholds. Up to `explained` the rounding of a good
//! implementation accounts for it: the property holds. Beyond `defect` not even a poor but correct one can have produced
//! it: the property fails. In between the verdict is undecided. `u = 2⁻⁵³`. This is the short version; `docs/tolerance.md` has the
//! derivations step by step, the largest defect that can hide for each property, and what it comes to on three meshes.
//!
//! # One cotangent
//! The coordinates are exact, so edge vectors carry one rounding and turn by at most u each: the angle θ between two of them
//! changes by 2u, its cotangent by `2u/sin²θ`. The dot product is off by `3u |a||b|`, which adds `3u/sin θ`; the cross product by
//! `2.4u |a||b|`, its norm and the quotient by 3.5u relative, which adds `2.4u |cot θ|/sin θ + 3.5u |cot θ|`. The sum times `sin²θ/u` is
//! at most 7.6: `|δ cot θ| ≤ 8u / sin²θ`, and `4u / sin²θ` for the weight `½ cot θ`.
//!
//! # A row
//! A triangle puts `½ (cot θ_j + cot θ_k) = sin θ_i / (2 sin θ_j sin θ_k) > 0` on the diagonal of row i: contributions of
//! different triangles do not cancel there, so `L_ii ≤ s_i = Σ_k |L_ik|` is a scale that no sliver elsewhere inflates. Its two
//! off-diagonal terms are off by `4u (1/sin²θ_j + 1/sin²θ_k)`; over the diagonal term that is
//! `8u (sin θ_j / sin θ_k + sin θ_k / sin θ_j) / sin θ_i`, and since `sin θ_j ≤ sin θ_i + sin θ_k` it is at most `24 u Q`,
//! `Q = 1/sin θ_min`. Adding up m entries costs `2m u s_i` in the matrix, at most `2 Q u s_i` more where the terms of a triangle cancel
//! on the way, and at most `2m u s_i` in our sum:
//!
//! `explained_i = (4m + 32 Q_i) u s_i`, Q_i the largest Q at vertex i (1 on graphs).
//!
//! # Algorithms that start from edge lengths
//! A length is off by 4u relative, and Heron's formula divides by `s − a`, which for a cap of relative height 1/2Q is of
//! the order 1/4Q²: the area and all cotangents are off by about `12 Q² u` relative. So
//!
//! `defect_i = 4 (4m + 32 Q_i²) u s_i`.
//!
//! At a smallest angle of 30° (Q = 2) the two are a factor of 7 apart, at one degree (Q = 57) 230; past Q ≈ 8e6
//! `defect_i ≥ s_i`, which no residual exceeds: on slivers rounding is never mistaken for a defect. Conversely nothing above
//! [`LARGEST_EXPLAINED`] of its scale is called explained, however bad the triangles.
//!
//! # A moment
//! `Σ_j L_ij (x_j − x_i)` is compared with `S_i = Σ_j |L_ij| |x_j − x_i|`, Euclidean lengths. With D the circumdiameter,
//! `|x_j − x_i| = D sin θ_k`, so a triangle's error is `4u D (1/sin θ_j + 1/sin θ_k)`, against the share of its diagonal term times
//! its shorter edge at i: again at most `24 u Q`. The factors of a row apply to `S_i`. Where the weights of two triangles at an edge
//! cancel, `S_i` may be smaller than the sum of the shares, so that such verdicts are "measured".
//!
//! # A single weight
//! What an entry owes to cancellation is known edge by edge: `ρ_ij = Σ 1/sin²θ` over the angles opposite ij. It is brought to
//! the unit of the matrix by the factor between its row and that of the cotangent Laplacian, `s_i / 2σ_i`,
//! `σ_i = Σ ½ (cot θ_j + cot θ_k)` (the factor is 1 for a cotangent matrix without negative weights):
//!
//! `explained_ij = u (4 |L_ij| + 4 ρ_ij s_i / 2σ_i)`, `defect_ij = 4 Q_ij explained_ij`.
//!
//! Asymmetry is measured against the sum of both directions: a weight written twice is equal bit for bit, one computed twice
//! differs by no more. The *sign* of a weight is clear only beyond `max(defect_ij, explained_i)`, since weights other than
//! cotangents cancel between other angles than those opposite. Rows with entries off the stencil come from other triangles
//! than those of the mesh: there, and on volumes and polygons, an entry is measured as its row is, with the worst Q of the
//! whole mesh where the row leaves the stencil. The weights of graphs and point clouds do not come out of cancellation:
//! `4u |L_ij|`, and their signs are literal.
//!
//! # A row with its neighbours
//! What couples rows — a solution, a direction of negative energy, two operators that are compared — is measured with the worst
//! Q of the row's vertices in place of Q_i alone, and with nothing finer than rows (`measure::rounding`).
//!
//! # Moved coordinates
//! Moving the coordinates by δ turns an angle at edges no shorter than ℓ by at most `2δ/ℓ` at either edge, and `½ cot θ` by
//! `2δ/ℓ sin²θ`: an entry by `8Q δ/ℓ` of the diagonal terms of the triangles beside it, the diagonal `ℓ_a²/4A` itself by less. Eight
//! times that is a defect.
//!
//! # A sum, and a number computed twice
//! A row of m entries that sums to zero before rounding does so up to `4m u s_i` after it, each entry being a sum of two or more
//! terms. Two roundings of the same number, both good to `2u`, agree up to `4u` of the larger.

use super::condition::Condition;
use super::stencil::Stencil;
use crate::domain::{Domain, DomainKind};
pub use crate::linalg::backward::UNIT_ROUNDOFF;
use crate::linalg::{Csr, parallel};

/// No residual above this share of its scale is ever called explained: half of the digits would be lost.
pub const LARGEST_EXPLAINED: f64 = 1.0 / 1_048_576.0;

/// What a residual is measured against.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Threshold {
    /// Up to here the rounding of a good implementation explains it.
    pub explained: f64,
    /// Beyond this only a defect does.
    pub defect: f64,
}

/// What a residual comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Judgement {
    /// Rounding explains it.
    Explained,
    /// It lies between the thresholds, or beyond the range of `f64`.
    Open,
    /// Only a defect explains it.
    Defect,
}

/// What the sign of a weight comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Above zero by more than a defect's worth.
    Positive,
    /// Zero, or no more than rounding makes.
    Zero,
    /// Below zero by more than a defect's worth.
    Negative,
    /// Between rounding and a defect.
    Open,
}

/// Whether two numbers may be one, computed twice.
pub(crate) fn agree(a: f64, b: f64) -> bool {
    (a - b).abs() <= 4.0 * UNIT_ROUNDOFF * a.abs().max(b.abs())
}

impl Threshold {
    /// No tolerance: anything above zero is a defect. For decisions that are exact.
    pub const NONE: Threshold = Threshold { explained: 0.0, defect: 0.0 };

    /// The threshold of a quantity with accumulation factor `m` and condition `q` over a scale; see the module's text.
    pub fn over(scale: f64, m: usize, q: f64) -> Self {
        let m = 4.0 * m as f64;
        let explained = ((m + 32.0 * q) * UNIT_ROUNDOFF).min(LARGEST_EXPLAINED);
        let defect = (4.0 * (m + 32.0 * q * q) * UNIT_ROUNDOFF).max(explained);
        Threshold { explained: explained * scale, defect: defect * scale }
    }

    /// The threshold of a sum of m entries with magnitudes that add up to `size`, where only the summation rounds.
    pub(crate) fn of_sum(size: f64, m: usize) -> Self {
        let explained = 4.0 * m as f64 * UNIT_ROUNDOFF * size;
        Threshold { explained, defect: 4.0 * explained }
    }

    /// What moving coordinates by `displaced` of the shortest edge adds, relative to a scale, at condition q.
    pub(crate) fn of_displacement(q: f64, displaced: f64) -> Self {
        let explained = 8.0 * q * displaced;
        Threshold { explained, defect: 8.0 * explained }
    }

    /// Both times a factor.
    pub(crate) fn times(self, factor: f64) -> Self {
        Threshold { explained: self.explained * factor, defect: self.defect * factor }
    }

    /// The larger of each.
    pub(crate) fn max(self, other: Self) -> Self {
        Threshold { explained: self.explained.max(other.explained), defect: self.defect.max(other.defect) }
    }

    /// The sign of a weight.
    pub fn sign(&self, weight: f64) -> Sign {
        match weight {
            w if w.abs() <= self.explained => Sign::Zero,
            w if w.abs() <= self.defect => Sign::Open,
            w if w > 0.0 => Sign::Positive,
            _ => Sign::Negative,
        }
    }

    /// The threshold of a sum of two such residuals.
    pub fn plus(self, other: Threshold) -> Self {
        Threshold { explained: self.explained + other.explained, defect: self.defect + other.defect }
    }

    /// What a residual, not negative, comes to. The comparison with `defect` leaves room for the rounding of the residual, so
    /// that a witness stays one in exact arithmetic.
    pub fn judge(&self, residual: f64) -> Judgement {
        if residual.is_nan() || !self.explained.is_finite() {
            Judgement::Open
        } else if residual <= self.explained {
            Judgement::Explained
        } else if residual > self.defect * (1.0 + 8.0 * f64::EPSILON) {
            Judgement::Defect
        } else {
            Judgement::Open
        }
    }

    /// The residual over what is explained: 0 for none at all, infinite where nothing is tolerated.
    pub fn margin(&self, residual: f64) -> f64 {
        if residual == 0.0 { 0.0 } else { residual / self.explained }
    }
}

/// The scales of an operator's rows and the conditions of its domain.
pub struct Scales {
    /// `s_i = Σ_k |L_ik|`.
    pub rows: Vec<f64>,
    own: Vec<Row>,
    condition: Condition,
    kind: DomainKind,
}

/// What a row is measured with.
#[derive(Clone, Copy)]
struct Row {
    condition: f64,
    length: u32,
    leaves_stencil: bool,
}

impl Scales {
    /// Of a matrix on a domain. Cost: O(nnz log + F).
    pub fn of(domain: &Domain, stiffness: &Csr) -> Self {
        Scales::with_stencil(domain, stiffness, &Stencil::of(domain))
    }

    /// The same where the stencil of the domain is at hand.
    pub(crate) fn with_stencil(domain: &Domain, stiffness: &Csr, stencil: &Stencil) -> Self {
        let condition = Condition::of(domain);
        let (local, worst) = (domain.kind() != DomainKind::Points, condition.worst());
        let row = |i: usize| {
            let leaves_stencil = local && stencil.far_entries(stiffness, i).next().is_some();
            let condition = if leaves_stencil { worst } else { condition.stars[i].condition };
            Row { condition, length: stiffness.row_slices(i).0.len() as u32, leaves_stencil }
        };
        let own = parallel::collect(stiffness.rows(), row);
        Scales { rows: stiffness.row_scales(), own, condition, kind: domain.kind() }
    }

    /// The condition Q_i that row i is measured with.
    pub fn condition(&self, i: usize) -> f64 {
        self.own[i].condition
    }

    /// The conditioning of the domain itself.
    pub(crate) fn geometry(&self) -> &Condition {
        &self.condition
    }

    /// Whether row i has a non-zero entry off the stencil.
    pub fn leaves_stencil(&self, i: usize) -> bool {
        self.own[i].leaves_stencil
    }

    /// For a linear combination of the entries of row i whose terms have magnitudes that add up to `size`.
    pub fn combination(&self, i: usize, size: f64) -> Threshold {
        Threshold::over(size, self.own[i].length as usize, self.own[i].condition)
    }

    /// For the sum of row i.
    pub fn row(&self, i: usize) -> Threshold {
        self.combination(i, self.rows[i])
    }

    /// For the entry `value` at (i, j), `edge` being the number of the edge between them, if there is one.
    pub fn entry(&self, i: usize, value: f64, edge: Option<usize>) -> Threshold {
        if self.weights_do_not_cancel() {
            let explained = 4.0 * UNIT_ROUNDOFF * value.abs();
            return Threshold { explained, defect: 4.0 * explained };
        }
        let (Some(t), Some(edge), false) = (&self.condition.triangles, edge, self.own[i].leaves_stencil) else {
            return self.row(i);
        };
        let (pull, flanks) = (self.condition.stars[i].pull, &t.flanks[edge]);
        if pull == 0.0 {
            return self.row(i);
        }
        let unit = self.rows[i] / (2.0 * pull);
        let bound = 4.0 * UNIT_ROUNDOFF * (value.abs() + flanks.opposite * unit);
        Threshold { explained: bound.min(LARGEST_EXPLAINED * self.rows[i]), defect: 4.0 * flanks.condition * bound }
    }

    /// For the sign of the entry `value` at (i, j), where no construction vouches for it.
    pub fn sign(&self, i: usize, value: f64, edge: Option<usize>) -> Threshold {
        if self.weights_do_not_cancel() {
            return Threshold::NONE;
        }
        let entry = self.entry(i, value, edge);
        Threshold { explained: entry.explained, defect: entry.defect.max(self.row(i).explained) }
    }

    /// Whether weights are given or positive by construction, so that none is the small difference of large terms.
    fn weights_do_not_cancel(&self) -> bool {
        matches!(self.kind, DomainKind::Graph | DomainKind::Points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::{Graph, Surface};

    #[test]
    fn the_thresholds_are_close_on_healthy_triangles_and_open_on_slivers() {
        let gap = |q| {
            let t = Threshold::over(1.0, 7, q);
            t.defect / t.explained
        };
        assert!(gap(2.0) < 10.0 && gap(57.3) < 250.0);
        let sliver = Threshold::over(1.0, 7, 1e8);
        assert!(sliver.defect >= 1.0 && sliver.explained < 1e-6);
        assert_eq!(Threshold::over(1.0, 7, 1e17).explained, LARGEST_EXPLAINED);
    }

    #[test]
    fn nothing_is_explained_without_tolerance_and_nothing_decided_beyond_the_range() {
        assert_eq!(Threshold::NONE.judge(0.0), Judgement::Explained);
        assert_eq!(Threshold::NONE.judge(5e-324), Judgement::Defect);
        assert_eq!(Threshold::over(f64::INFINITY, 1, 1.0).judge(1.0), Judgement::Open);
        assert_eq!(Threshold::over(1.0, 1, 1.0).judge(f64::NAN), Judgement::Open);
        assert_eq!(Threshold::NONE.margin(0.0), 0.0);
    }

    #[test]
    fn a_sliver_far_away_does_not_loosen_a_healthy_row() {
        // Two components: an equilateral-like triangle, and a cap of height 1e-9.
        let p = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.9], [9.0, 0.0], [10.0, 0.0], [9.5, 1e-9]];
        let domain = Surface::planar(&p, &[[0, 1, 2], [3, 4, 5]]).unwrap().into();
        let identity = Csr::diagonal(&[1.0; 6]);
        let scales = Scales::of(&domain, &identity);
        assert!(scales.row(0).explained < 1e-14 && scales.row(3).explained > 1e-7);
        // An entry that joins the two makes its row inherit the worst of the mesh.
        let joined = identity.add(&Csr::from_triplets(6, 6, &[(0, 4, 1.0)]));
        let scales = Scales::of(&domain, &joined);
        assert!(scales.leaves_stencil(0) && !scales.leaves_stencil(4));
        assert!(scales.row(0).explained > 1e-7 && scales.row(1).explained < 1e-14);
    }

    #[test]
    fn a_sign_is_clear_beyond_the_defect_only() {
        let t = Threshold { explained: 1.0, defect: 10.0 };
        let signs = [-11.0, -10.0, -1.0, 0.0, 1.0, 10.0, 11.0].map(|w| t.sign(w));
        use Sign::{Negative, Open, Positive, Zero};
        assert_eq!(signs, [Negative, Open, Zero, Zero, Zero, Open, Positive]);
        assert_eq!([-5e-324, 0.0, 5e-324].map(|w| Threshold::NONE.sign(w)), [Negative, Zero, Positive]);
    }

    #[test]
    fn on_graphs_signs_are_literal() {
        let domain = Graph::new(2, &[[0, 1]]).unwrap().into();
        let l = Csr::from_triplets(2, 2, &[(0, 0, 1.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 1.0)]);
        assert_eq!(Scales::of(&domain, &l).sign(0, -1.0, Some(0)), Threshold::NONE);
    }
}
