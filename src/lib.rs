#![forbid(unsafe_code)]
#![deny(missing_docs)]
//! Every discrete Laplacian gets a fair trial; none gets a free lunch.
//!
//! lapjury builds discrete Laplace operators on meshes and graphs, decides which properties they have — symmetry, locality,
//! linear precision, positive weights, maximum principles, … — and gives *evidence* for each decision: a witness or a
//! certificate that [`recheck`](property::recheck) verifies by a second program, in exact arithmetic where the data allow.
//!
//! # A tour
//!
//! **A domain.** Four points and two triangles over the edge (0, 3), small enough to check by hand:
//!
//! ```text
//!  1 (0,1)────────3 (2,1)        cot at 1 in (0, 3, 1):  (0,−1)·(2,0)  / |(0,−1)×(2,0)|  =  0/2 =  0
//!  │         ╱   ╱               cot at 2 in (0, 2, 3):  (−1,0)·(1,1)  / |(−1,0)×(1,1)|  = −1/1 = −1
//!  │    ╱      ╱                 ω₀₃ = ½ (0 − 1) = −½
//!  0 (0,0)──2 (1,0)
//! ```
//! What is known of a domain is computed, never declared. The angles opposite (0, 3) are 90° and 135°: together more than
//! 180°, so the edge is not Delaunay.
//! ```
//! use lapjury::{Domain, Surface};
//!
//! let points = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [2.0, 1.0]];
//! let domain = Domain::from(Surface::planar(&points, &[[0, 3, 1], [0, 2, 3]])?);
//! let facts = domain.facts().surface.ok_or("a surface")?;
//! assert_eq!((facts.planar, facts.non_delaunay_edges), (true, Some(1)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **An operator** from the catalogue. `L` has the geometer's sign: `L_ij = −ω_ij`, positive semi-definite where symmetric.
//! The remaining weights are `ω₀₁ = ½ cot = ½·2`, `ω₁₃ = ½·½`, `ω₀₂ = ½·3`, `ω₂₃ = ½·2`, and the rows sum to zero.
//! ```
//! # use lapjury::{Domain, Surface};
//! # let points = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [2.0, 1.0]];
//! # let domain = Domain::from(Surface::planar(&points, &[[0, 3, 1], [0, 2, 3]])?);
//! let cotan = lapjury::laplacian::find("cotan").ok_or("in the catalogue")?;
//! let operator = cotan.build(&domain, &Default::default())?;
//! let row = |i: usize| (0..4).map(|j| operator.stiffness().at(i, j)).collect::<Vec<_>>();
//! assert_eq!(row(0), [2.0, -1.0, -1.5, 0.5]);
//! assert_eq!(row(3), [0.5, -0.25, -1.0, 0.75]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **A property** and its verdict. POS0 asks for `ω ≥ 0` on interior edges; the witness names the edge and the corners
//! opposite, and carries the row and the faces that show it. Another program believes none of it and looks again: first at
//! the numbers written down with the witness, then at the operator itself.
//! ```
//! # use lapjury::{Domain, Surface};
//! # let points = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [2.0, 1.0]];
//! # let domain = Domain::from(Surface::planar(&points, &[[0, 3, 1], [0, 2, 3]])?);
//! # let cotan = lapjury::laplacian::find("cotan").ok_or("in the catalogue")?;
//! # let operator = cotan.build(&domain, &Default::default())?;
//! use lapjury::property::recheck::{self, Rechecked};
//! use lapjury::{Level, Statement, Status, Trial};
//!
//! let trial = Trial::new(&domain, &operator, 0)?;
//! let verdict = lapjury::property::find("POS0").ok_or("a property")?.decide(&trial, None);
//! assert_eq!((verdict.status(), verdict.level), (Status::Fails, Level::Exact));
//!
//! let witness = verdict.evidence().ok_or("a failing verdict has a witness")?;
//! let Statement::Weight { i: 0, j: 3, zero: false, opposite } = &witness.statement else { panic!("{witness:?}") };
//! assert_eq!(opposite.iter().map(|corner| corner.vertex).collect::<Vec<_>>(), [1, 2]);
//!
//! assert_eq!(recheck::from_excerpt(witness)?, Rechecked::Exact);
//! assert_eq!(recheck::against(witness, "POS0", &domain, &operator)?, Rechecked::Exact);
//!
//! // A witness that says more than is true is refused.
//! let mut spoilt = witness.clone();
//! spoilt.excerpt.rows[0].entries[3].1 = 0.75;
//! assert!(recheck::against(&spoilt, "POS0", &domain, &operator).is_err());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **No free lunch.** The intrinsic Delaunay Laplacian flips the edge: (1, 2) takes its place, with opposite cotangents 0 at
//! vertex 0 and 1 at vertex 3, so `ω₁₂ = ½`. Now no weight is negative, but 1 and 2 share no edge of the mesh: what was won
//! in positivity is paid for in locality.
//! ```
//! # use lapjury::{Domain, Surface, Statement, Status, Trial};
//! # let points = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [2.0, 1.0]];
//! # let domain = Domain::from(Surface::planar(&points, &[[0, 3, 1], [0, 2, 3]])?);
//! let delaunay = lapjury::laplacian::find("intrinsic-delaunay").ok_or("in the catalogue")?;
//! let operator = delaunay.build(&domain, &Default::default())?;
//! assert_eq!([operator.stiffness().at(0, 3), operator.stiffness().at(1, 2)], [0.0, -0.5]);
//!
//! let trial = Trial::new(&domain, &operator, 0)?;
//! let decide = |id: &str| lapjury::property::find(id).map(|property| property.decide(&trial, None));
//! assert_eq!(decide("POS0").map(|v| v.status()), Some(Status::Holds));
//! let locality = decide("LOC").ok_or("a property")?;
//! let far = locality.evidence().map(|e| &e.statement);
//! assert_eq!(far, Some(&Statement::FarEntry { i: 1, j: 2, rings: Some(2) }));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **Many of them.** A [`Recipe`] is a line of text that makes a domain, the same one for ever; a [`Suite`] tries operators
//! on classes of recipes and tests claims of the literature on what comes out, and [`suite::run`](suite::run()) writes the
//! [`Record`] that every report is made of.
//! ```
//! # use lapjury::Recipe;
//! let recipe: Recipe = "random-delaunay:n=20,seed=7 | flip:count=5".parse()?;
//! let domain = recipe.build(std::path::Path::new("."))?;
//! assert_eq!(domain.digest(), recipe.build(std::path::Path::new("."))?.digest());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # How to read a verdict
//!
//! | status | meaning |
//! | --- | --- |
//! | [holds](Status::Holds) | true of this operator on this domain; the evidence is a certificate |
//! | [fails](Status::Fails) | false; the evidence is a witness: a vertex, an edge, a vector, a solution |
//! | [undecided](Status::Undecided) | the residual lies between what rounding explains and what a defect explains |
//! | [not applicable](Status::NotApplicable) | the property says nothing here, for the reason given |
//!
//! | level | how it was reached |
//! | --- | --- |
//! | [exact](Level::Exact) | in rational arithmetic, by exact predicates, or combinatorially |
//! | [bounded](Level::Bounded) | in floating point, with an error bound that covers the worst case |
//! | [measured](Level::Measured) | in floating point, against a stated tolerance that follows from the rounding of the operations and the local condition |
//!
//! The margin is the worst residual over its threshold: far below 1 where a property holds, far above where it fails. That
//! a construction *refuses* a domain, with the element named, is no verdict.
//!
//! # Where things are
//!
//! [`domain`] → [`laplacian`] (with [`operator`], [`linalg`], [`scalar`]) → [`property`] → [`suite`] → [`record`] →
//! [`report`]. Domains come from [`generate`] or, as matrices do, from files ([`exchange`], [`external`]). Theorems that are
//! more than property × operator × domain are an [`experiment`]. To add a Laplacian, a property, a generator or an experiment,
//! write one file with one `ENTRY` and name it in the `ALL` of its module.
//!
//! # Features
//!
//! `cli` (on by default) carries what only the command-line tool needs: the module `cli`, clap, indicatif, anyhow. For the
//! library alone: `lapjury = { version = "0.1", default-features = false }`.

#[macro_use]
mod catalogue;
pub mod campaign;
#[cfg(feature = "cli")]
pub mod cli;
pub mod domain;
pub mod exchange;
pub mod experiment;
pub mod external;
pub mod fault;
pub mod figure;
pub mod generate;
pub mod laplacian;
pub mod linalg;
pub mod operator;
pub mod parameter;
pub mod property;
pub mod record;
pub mod report;
pub mod scalar;
pub mod stream;
pub mod suite;

pub use domain::{Domain, DomainKind, Facts, Graph, PointCloud, Surface, Volume};
pub use experiment::{Experiment, Finding};
pub use generate::Generator;
pub use laplacian::Laplacian;
pub use linalg::Csr;
pub use operator::{Mass, MassKind, Operator};
pub use property::{Evidence, Excerpt, Level, Outcome, Property, Statement, Status, Trial, Verdict};
pub use record::Record;
pub use scalar::{Rational, Scalar};
pub use suite::{Recipe, Suite};
