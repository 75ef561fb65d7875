//! The catalogue of Laplacians: one construction a file, one `static ENTRY` each.
//!
//! To add one: write the file and name it below, in the `catalogue`.
//!
//! Besides the constructions: [`shape`] holds the metric of a triangle, [`stiffness`] puts edge weights together to a
//! matrix, [`mass`] the mass matrices that all constructions on triangles share, [`exact`] knows which operators are rational.

pub mod equilibrium;
pub mod exact;
mod local_star;
pub mod mass;
mod on_triangles;
pub mod shape;
pub mod stiffness;

catalogue! {
    /// Every Laplacian of the catalogue.
    Laplacian:
    graph,
    weighted_graph,
    normalized_graph,
    pub cotan,
    intrinsic_delaunay,
    mean_value,
    pub wachspress,
    pub three_point,
    pub tet_cotan,
    pub orthogonal_dual,
    optimal_positive,
    pub point_cloud_heat,
}

use std::collections::BTreeMap;

use crate::domain::{Domain, DomainKind, Facts};
use crate::operator::{Operator, OperatorError};
use crate::parameter::{Parameter, Settings, SettingsError};

/// A catalogue entry.
pub struct Laplacian {
    /// The id, in kebab case; the file has the same name in snake case.
    pub id: &'static str,
    /// What the field calls it.
    pub name: &'static str,
    /// The definition, in plain Unicode maths.
    pub definition: &'static str,
    /// Keys of `references.bib`.
    pub sources: &'static [&'static str],
    /// The kinds of domain it is defined on.
    pub accepts: &'static [DomainKind],
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// What the literature promises of it.
    pub promises: &'static [Promise],
    /// Builds the operator.
    pub build: fn(&Domain, &Settings) -> Result<Operator, BuildError>,
}

impl Laplacian {
    /// Checks the settings against the parameters, checks the kind of domain, and builds.
    ///
    /// # Errors
    /// A domain or a parameter that the entry does not accept, or what the construction refuses.
    pub fn build(&self, domain: &Domain, given: &BTreeMap<String, String>) -> Result<Operator, BuildError> {
        let settings = self.check(given)?;
        if !self.accepts.contains(&domain.kind()) {
            return Err(BuildError::WrongKind { laplacian: self.id, kind: domain.kind(), accepts: self.accepts });
        }
        (self.build)(domain, &settings)
    }

    /// Checks settings without building anything.
    ///
    /// # Errors
    /// An unknown parameter, or a value out of range.
    pub fn check(&self, given: &BTreeMap<String, String>) -> Result<Settings, SettingsError> {
        Settings::new(self.id, self.parameters, given)
    }

    /// Whether the entry promises the property on a domain with these facts, whatever the parameters: `Some(true)` it holds
    /// there, `None` it says nothing.
    pub fn promises(&self, property: &str, facts: &Facts) -> Option<bool> {
        self.holding(property, facts).any(|p| p.when.is_empty()).then_some(true)
    }

    /// As [`Laplacian::promises`], for the operator built with these parameters (defaults where a name is missing).
    pub fn promises_with(&self, property: &str, facts: &Facts, given: &BTreeMap<String, String>) -> Option<bool> {
        let settings = Settings::new(self.id, self.parameters, given).ok()?;
        self.holding(property, facts).any(|p| p.when.iter().all(|when| when.is_true_of(&settings))).then_some(true)
    }

    /// The promises that the property holds, of those whose facts are given.
    fn holding(&self, property: &str, facts: &Facts) -> impl Iterator<Item = &Promise> {
        self.promises
            .iter()
            .filter(move |p| p.property == property && p.outcome == Promised::Holds)
            .filter(move |p| p.given.iter().all(|given| given.is_true_of(facts)))
    }
}

/// CON, the convergence of "Discrete Laplace operators: no free lunch" \[wardetzky2007\]: solutions of Poisson's equation, and with them
/// eigenvalues and eigenspaces, tend to the smooth ones on meshes that refine a smooth domain. It is promised like a property, and is none: no
/// single mesh decides it. The experiment [`convergence`](crate::experiment) tries every promise of it.
pub const CONVERGENCE: &str = "CON";

/// A promise of the literature about a property, or of [`CONVERGENCE`].
pub struct Promise {
    /// The property's id.
    pub property: &'static str,
    /// What is promised.
    pub outcome: Promised,
    /// The facts of the domain under which it is promised.
    pub given: &'static [Fact],
    /// The parameter values under which it is promised.
    pub when: &'static [When],
}

impl Promise {
    /// It holds on every domain.
    pub const fn holds(property: &'static str) -> Self {
        Promise { property, outcome: Promised::Holds, given: &[], when: &[] }
    }

    /// It holds where the domain has these facts.
    pub const fn holds_given(property: &'static str, given: &'static [Fact]) -> Self {
        Promise { property, outcome: Promised::Holds, given, when: &[] }
    }

    /// It fails on some domain.
    pub const fn fails_somewhere(property: &'static str) -> Self {
        Promise { property, outcome: Promised::FailsSomewhere, given: &[], when: &[] }
    }

    /// The same promise, of the operators built with these parameter values only.
    pub const fn when(self, when: &'static [When]) -> Self {
        Promise { when, ..self }
    }
}

/// A condition on a parameter of the entry under which a promise is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    /// The parameter of this name is one of these words.
    Is(&'static str, &'static [&'static str]),
    /// The parameter of this name is a number between two bounds, both included.
    Between(&'static str, f64, f64),
}

impl When {
    /// Whether the condition is true of these settings.
    pub fn is_true_of(self, settings: &Settings) -> bool {
        match self {
            When::Is(name, words) => words.contains(&settings.get(name)),
            When::Between(name, low, high) => (low..=high).contains(&settings.number(name)),
        }
    }
}

/// What a promise says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Promised {
    /// The property holds wherever the facts are given.
    Holds,
    /// Some domain makes it fail.
    FailsSomewhere,
}

/// A fact of a domain that a promise may ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fact {
    /// Every interior edge is Delaunay.
    Delaunay,
    /// Every interior edge is strictly Delaunay: Delaunay and none cocircular.
    StrictlyDelaunay,
    /// Unfolded in a coordinate plane.
    Planar,
    /// No boundary edge.
    Closed,
    /// Manifold.
    Manifold,
    /// No degenerate face.
    NonDegenerate,
    /// One component.
    Connected,
    /// Every angle of every face is at least one degree: conditioning is no excuse.
    HealthyAngles,
    /// Every angle of every face is clearly below a right one (at most 89.99°), and no face is degenerate.
    Acute,
    /// Every vertex has an edge.
    NoIsolatedVertex,
}

impl Fact {
    /// Every fact.
    pub const ALL: [Fact; 10] = [
        Fact::Delaunay,
        Fact::StrictlyDelaunay,
        Fact::Planar,
        Fact::Closed,
        Fact::Manifold,
        Fact::NonDegenerate,
        Fact::Connected,
        Fact::HealthyAngles,
        Fact::Acute,
        Fact::NoIsolatedVertex,
    ];

    /// Whether the fact is true of a domain with these facts.
    pub fn is_true_of(self, facts: &Facts) -> bool {
        let surface = facts.surface.as_ref();
        match self {
            Fact::Connected => facts.connected(),
            Fact::Delaunay => surface.is_some_and(|s| s.delaunay == Some(true)),
            Fact::StrictlyDelaunay => {
                surface.is_some_and(|s| s.delaunay == Some(true) && s.cocircular_edges == Some(0))
            }
            Fact::Planar => surface.is_some_and(|s| s.planar),
            Fact::Closed => surface.is_some_and(|s| s.closed),
            Fact::Manifold => surface.is_some_and(|s| s.manifold),
            Fact::NonDegenerate => surface.is_some_and(|s| s.degenerate_faces == 0),
            Fact::HealthyAngles => surface.is_some_and(|s| s.min_angle_deg >= 1.0),
            Fact::Acute => surface.is_some_and(|s| s.max_angle_deg <= 89.99 && s.degenerate_faces == 0),
            Fact::NoIsolatedVertex => facts.isolated_vertices == 0,
        }
    }

    /// The fact in words.
    pub fn name(self) -> &'static str {
        match self {
            Fact::Delaunay => "Delaunay",
            Fact::StrictlyDelaunay => "strictly Delaunay",
            Fact::Planar => "planar",
            Fact::Closed => "closed",
            Fact::Manifold => "manifold",
            Fact::NonDegenerate => "no degenerate face",
            Fact::Connected => "connected",
            Fact::HealthyAngles => "all angles at least 1°",
            Fact::Acute => "all angles acute",
            Fact::NoIsolatedVertex => "no isolated vertex",
        }
    }
}

/// The rest of an advice, for a construction that can leave degenerate triangles out.
fn or_leave_them_out(laplacian: &str) -> &'static str {
    let can = find(laplacian).is_some_and(|l| l.parameters.iter().any(|p| p.name == on_triangles::DEGENERATE.name));
    if can { ", or leave them out with degenerate=skip" } else { "" }
}

/// Why a construction gave no operator. A refusal is not a verdict.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// The domain is of another kind.
    #[error("'{laplacian}' is not defined on a {kind}; it accepts {}", accepts.iter().map(|k| k.to_string()).collect::<Vec<_>>().join(", "))]
    WrongKind {
        /// The entry.
        laplacian: &'static str,
        /// The kind of the domain.
        kind: DomainKind,
        /// What the entry accepts.
        accepts: &'static [DomainKind],
    },
    /// A parameter that the entry does not have, or a value that it does not admit.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A face that is not a triangle.
    #[error("face {face} has {corners} corners; '{laplacian}' is defined on triangles: triangulate the mesh first")]
    NotATriangle {
        /// The entry.
        laplacian: &'static str,
        /// The face.
        face: usize,
        /// How many corners it has.
        corners: usize,
    },
    /// A triangle of zero area.
    #[error(
        "triangle {face} ({}, {}, {}) has zero area, where '{laplacian}' is not defined ({count} such triangles in all); \
         remove them{}", corners[0], corners[1], corners[2], or_leave_them_out(laplacian)
    )]
    Degenerate {
        /// The entry.
        laplacian: &'static str,
        /// The first degenerate triangle.
        face: usize,
        /// Its corners.
        corners: [usize; 3],
        /// How many there are.
        count: usize,
    },
    /// A tetrahedron of zero volume.
    #[error(
        "tetrahedron {tetrahedron} ({}, {}, {}, {}) has zero volume, where '{laplacian}' is not defined ({count} such \
         tetrahedra in all); remove them", corners[0], corners[1], corners[2], corners[3]
    )]
    Flat {
        /// The entry.
        laplacian: &'static str,
        /// The first flat tetrahedron.
        tetrahedron: usize,
        /// Its corners.
        corners: [usize; 4],
        /// How many there are.
        count: usize,
    },
    /// An edge between two vertices at the same place, where the weights are inverse lengths.
    #[error(
        "edge ({a}, {b}) has length zero, and '{laplacian}' divides by it ({count} such edges in all); merge the vertices \
         that coincide, or choose weights=unit"
    )]
    ZeroLength {
        /// The entry.
        laplacian: &'static str,
        /// One end.
        a: usize,
        /// The other end.
        b: usize,
        /// How many there are.
        count: usize,
    },
    /// A non-manifold edge.
    #[error("edge ({a}, {b}) has {faces} faces, and '{laplacian}' needs a manifold; separate the sheets first")]
    NonManifold {
        /// The entry.
        laplacian: &'static str,
        /// One end.
        a: usize,
        /// The other end.
        b: usize,
        /// How many faces lie at it.
        faces: usize,
    },
    /// A surface that cannot be oriented.
    #[error(
        "the faces beside edge ({a}, {b}) cannot be made to agree in orientation, as '{laplacian}' needs; cut the surface open"
    )]
    NotOrientable {
        /// The entry.
        laplacian: &'static str,
        /// One end.
        a: usize,
        /// The other end.
        b: usize,
    },
    /// A vertex whose degree is not positive although it has edges.
    #[error(
        "vertex {vertex} has degree {degree:e} (the sum of its weights), where '{laplacian}' needs a positive one; \
         give its edges positive weights"
    )]
    Degree {
        /// The entry.
        laplacian: &'static str,
        /// The vertex.
        vertex: usize,
        /// Its degree.
        degree: f64,
    },
    /// Something that the construction needs is missing from the domain.
    #[error("'{laplacian}' needs {what}; {remedy}")]
    Missing {
        /// The entry.
        laplacian: &'static str,
        /// What is missing.
        what: &'static str,
        /// What to do.
        remedy: &'static str,
    },
    /// No positive weights in equilibrium exist.
    #[error(
        "'{laplacian}' does not exist on this mesh: {}; flip edges until the triangulation is a weighted Delaunay one",
        certificate.in_words()
    )]
    NoPositiveWeights {
        /// The entry.
        laplacian: &'static str,
        /// The motion that shows it.
        certificate: Box<equilibrium::Certificate>,
    },
    /// Fewer points than a star needs.
    #[error(
        "'{laplacian}' needs at least {needed} points for a tangent space of dimension {dimension}, and there are {points}; add points"
    )]
    TooFewPoints {
        /// The entry.
        laplacian: &'static str,
        /// How many there are.
        points: usize,
        /// How many are needed.
        needed: usize,
        /// The dimension.
        dimension: usize,
    },
    /// Two points at the same place.
    #[error(
        "points {a} and {b} coincide, or nearly so, and '{laplacian}' gives each point an area of its own; merge points that \
         coincide"
    )]
    Coincident {
        /// The entry.
        laplacian: &'static str,
        /// One point.
        a: usize,
        /// The other.
        b: usize,
    },
    /// A point whose neighbours have no tangent space.
    #[error(
        "the {neighbours} points nearest to point {vertex} {why}, so that '{laplacian}' finds no tangent space there; sample \
         what is curved more densely, and set the dimension to that of what is sampled"
    )]
    NoTangent {
        /// The entry.
        laplacian: &'static str,
        /// The point.
        vertex: usize,
        /// How many neighbours were looked at.
        neighbours: usize,
        /// What they do.
        why: &'static str,
    },
    /// A point that is out of reach of all others.
    #[error(
        "point {vertex} is {distance:e} away from the next, and '{laplacian}' reaches {reach:e} with this bandwidth and cutoff; \
         choose a larger bandwidth, or remove the point"
    )]
    OutOfReach {
        /// The entry.
        laplacian: &'static str,
        /// The point.
        vertex: usize,
        /// The distance of the nearest other.
        distance: f64,
        /// How far the kernel reaches.
        reach: f64,
    },
    /// A weight or mass that came out NaN or infinite.
    #[error(
        "'{laplacian}' gives {value} at ({i}, {j}): the geometry there is beyond the range of f64; rescale the domain"
    )]
    NotFinite {
        /// The entry.
        laplacian: &'static str,
        /// Row.
        i: usize,
        /// Column.
        j: usize,
        /// The value as text.
        value: String,
    },
    /// The matrices do not make an operator.
    #[error(transparent)]
    Operator(#[from] OperatorError),
}
