//! A case before the jury: an operator on a domain.

use std::sync::OnceLock;

use super::measure::rounding::Rounding;
use super::measure::shares;
use super::measure::weights::Surveys;
use super::stencil::Stencil;
use super::tolerance::{Scales, Threshold};
use super::{Level, Verdict};
use crate::domain::{Domain, DomainKind, Surface};
use crate::linalg::{Csr, Mirror, parallel};
use crate::operator::{Operator, Signs};

/// An operator on its domain, with what several properties need of both, computed once.
pub struct Trial<'a> {
    /// The domain.
    pub domain: &'a Domain,
    /// The operator.
    pub operator: &'a Operator,
    /// The seed of whatever a check draws at random.
    pub seed: u64,
    scales: OnceLock<Scales>,
    rounding: OnceLock<Rounding>,
    stencil: OnceLock<Stencil>,
    finite: OnceLock<bool>,
    surveys: OnceLock<Surveys>,
    mirror: OnceLock<Option<Mirror>>,
    area: OnceLock<(f64, Threshold)>,
}

/// Matrix and domain do not belong together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("the matrix has {rows} rows, the domain {vertices} vertices{hint}")]
pub struct SizeMismatch {
    /// Rows of the matrix.
    pub rows: usize,
    /// Vertices of the domain.
    pub vertices: usize,
    /// The likely reason, introduced by a colon, or empty.
    pub hint: String,
}

impl<'a> Trial<'a> {
    /// Brings an operator before the jury.
    ///
    /// # Errors
    /// An operator whose size is not the number of vertices, with the likely reason.
    pub fn new(domain: &'a Domain, operator: &'a Operator, seed: u64) -> Result<Self, SizeMismatch> {
        let (rows, vertices) = (operator.size(), domain.vertex_count());
        if rows != vertices {
            let facts = domain.facts();
            let hint = if rows == facts.vertices - facts.isolated_vertices {
                format!(": {} vertices belong to no face and were probably left out", facts.isolated_vertices)
            } else if rows == facts.vertices - facts.boundary_vertices {
                ": probably the boundary was removed; export the whole matrix".to_string()
            } else if rows == facts.edges {
                ": there is one row for each edge; this is an operator on edges".to_string()
            } else if rows == facts.faces {
                ": there is one row for each face; this is an operator on faces".to_string()
            } else if rows < vertices {
                ": vertices were probably welded or unreferenced ones dropped before the export".to_string()
            } else {
                ": the matrix probably belongs to another mesh".to_string()
            };
            return Err(SizeMismatch { rows, vertices, hint });
        }
        let (scales, rounding, stencil) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        let (finite, surveys, mirror, area) = (OnceLock::new(), OnceLock::new(), OnceLock::new(), OnceLock::new());
        Ok(Trial { domain, operator, seed, scales, rounding, stencil, finite, surveys, mirror, area })
    }

    /// The scales that thresholds are relative to.
    pub fn scales(&self) -> &Scales {
        self.scales.get_or_init(|| Scales::with_stencil(self.domain, self.operator.stiffness(), self.stencil()))
    }

    /// The thresholds of rows where their neighbours count.
    pub(crate) fn rounding(&self) -> &Rounding {
        self.rounding.get_or_init(|| Rounding::of(self))
    }

    /// Each entry of the stiffness matrix above the diagonal with its mirror image; `None` where one has none.
    pub(crate) fn mirror(&self) -> Option<&Mirror> {
        self.mirror.get_or_init(|| Mirror::of(self.operator.stiffness())).as_ref()
    }

    /// The area of the surface of the trial, and what a total is measured against as far as the area's own rounding goes.
    pub(crate) fn area(&self, surface: &Surface) -> (f64, Threshold) {
        *self.area.get_or_init(|| shares::area(surface, self.scales()))
    }

    /// What the signs of the weights come to.
    pub(crate) fn surveys(&self) -> &Surveys {
        self.surveys.get_or_init(|| Surveys::of(self))
    }

    /// Whether the signs of weights are read off the matrix: a construction vouches for them, or the weights do not come out of a
    /// cancellation (graphs, point clouds).
    pub fn has_literal_signs(&self) -> bool {
        self.operator.signs() == Signs::Exact || matches!(self.domain.kind(), DomainKind::Graph | DomainKind::Points)
    }

    /// The level of a verdict that rests on the signs of weights and on row sums.
    pub(crate) fn level_of_signs(&self) -> Level {
        if self.operator.signs() == Signs::Exact { Level::Exact } else { Level::Bounded }
    }

    /// The vertices that belong to nothing: no edge of the domain and no entry off the diagonal. On a point cloud, where edges
    /// are not given, none.
    pub(crate) fn isolated(&self) -> Vec<bool> {
        if self.domain.kind() == DomainKind::Points {
            return vec![false; self.domain.vertex_count()];
        }
        let mut alone = parallel::collect(self.domain.vertex_count(), |v| self.stencil().neighbours(v).is_empty());
        if !alone.contains(&true) {
            return alone;
        }
        for (i, j, _) in self.operator.stiffness().entries().filter(|(i, j, v)| i != j && **v != 0.0) {
            (alone[i], alone[j]) = (false, false);
        }
        alone
    }

    /// Who is next to whom.
    pub fn stencil(&self) -> &Stencil {
        self.stencil.get_or_init(|| Stencil::of(self.domain))
    }

    /// Whether every entry of both matrices is a finite number: what every property but FIN takes for granted.
    pub fn is_finite(&self) -> bool {
        *self.finite.get_or_init(|| {
            let finite = |m: &Csr| m.values().iter().all(|v| v.is_finite());
            finite(self.operator.stiffness()) && self.operator.mass().is_none_or(|m| finite(m.matrix()))
        })
    }

    /// The verdict of every property but FIN where an entry is not finite; `None` where all are.
    pub fn unless_finite(&self) -> Option<Verdict> {
        (!self.is_finite()).then(|| Verdict::not_applicable("the matrix has a non-finite entry; see FIN"))
    }
}
