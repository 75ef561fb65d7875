//! The cotangent Laplacian of a tetrahedral mesh: linear finite elements in space.
//!
//! # Definition
//! ```text
//! ω_ij = ⅙ Σ ℓ_kl cot θ_kl   over the tetrahedra ijkl at the edge ij,   L_ij = −ω_ij,   L_ii = Σ_j ω_ij
//! ```
//! with kl the edge opposite to ij in the tetrahedron, ℓ_kl its length and θ_kl the dihedral angle there: the cotangent formula
//! `1/(n(n−1)) Σ |σ| cot θ` in dimension n = 3. It is the stiffness matrix `∫ ∇φ_i · ∇φ_j` of the hat functions. It is computed in the
//! form
//! ```text
//! ω_ij = − Σ N_i·N_j / (6 D),   D = |det(x_j − x_i, x_k − x_i, x_l − x_i)|,   ∇φ_i = N_i / D
//! ```
//! with N_i the cross product of two edges of the face opposite i, turned inwards: rational in the coordinates.
//!
//! # Shapes and units
//! L: n×n, length. M: n×n, length³ (`unit`: dimensionless).
//!
//! # Convention
//! The crate's: positive semi-definite. A sixth of the sum, not a half.
//!
//! # Guarantees
//! * FIN, LOC, SYM, NULL, PSD, PERM, UNION, REACH: always.
//! * LIN: at interior vertices whose tetrahedra fill a neighbourhood. *Exception*: where two tetrahedra overlap the fluxes do not cancel.
//! * MASS: `barycentric`, `consistent`.
//! * CON: for these, where the angles of and between faces stay below a bound less than 180° \[strang-fix1973\].
//!
//! The kernel is the constants on every connected volume, and motions and scalings act as they should (length, length³), but
//! that is not promised: on a sliver an eigenvalue, or a weight after a motion, drowns in rounding.
//!
//! # Does not hold
//! * POS, POS0, POS-boundary, MVP, MAX-local, MAX-global, MAX-heat: some tetrahedra with obtuse dihedral angles; Delaunay does not
//!   help in space.
//!
//! # Boundary
//! Natural: the row of a boundary vertex is the sum over the tetrahedra present.
//!
//! # Degenerate input
//! A tetrahedron without volume (decided exactly) is refused. Tetrahedra may be given in either orientation. An isolated vertex
//! has an empty row and mass zero.
//!
//! # Cost and accuracy
//! O(T log T). A term of a weight has an absolute error below `128u ℓ⁴/(6D) (1 + ℓ³/D)`, ℓ the longest edge of the tetrahedron; a weight
//! that does not exceed the sum of these bounds is computed in rational arithmetic and rounded once, so that every sign is
//! exact and a true zero is stored as zero.
//!
//! # References
//! \[crane2019\] (the formula in n dimensions and its derivation); \[strang-fix1973\] (linear elements).
//!
//! # Example
//! The corner of a cube, legs of length one: the gradients are the axes and −(1, 1, 1), the volume ⅙.
//! ```
//! use lapjury::domain::{Domain, Volume};
//! let corner = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//! let volume = Volume::new(corner, vec![[0, 1, 2, 3]])?;
//! let tet_cotan = lapjury::laplacian::find("tet-cotan").ok_or("missing")?;
//! let operator = tet_cotan.build(&Domain::from(volume), &Default::default())?;
//! let l = operator.stiffness();
//! assert_eq!([l.at(0, 0), l.at(0, 1), l.at(1, 1), l.at(1, 2)], [0.5, -1.0 / 6.0, 1.0 / 6.0, 0.0]);
//! assert_eq!(operator.mass().map(|m| m.total()), Some(1.0 / 6.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::cmp::Ordering;
use std::collections::BTreeMap;

use super::shape::with_sign;
use super::{BuildError, CONVERGENCE, Fact, Laplacian, Promise, When, stiffness};
use crate::domain::geometry::{self, cross3, dot};
use crate::domain::{Domain, DomainKind, Volume};
use crate::linalg::Csr;
use crate::operator::{Mass, MassKind, Operator, Provenance};
use crate::parameter::{Parameter, Range, Settings};
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Laplacian = Laplacian {
    id: "tet-cotan",
    name: "cotangent Laplacian of tetrahedra",
    definition: "ω_ij = ⅙ Σ ℓ_kl cot θ_kl over the tetrahedra ijkl, θ the dihedral angle at the edge opposite",
    sources: &["crane2019", "strang-fix1973"],
    accepts: &[DomainKind::Volume],
    parameters: &[Parameter {
        name: "mass",
        meaning: "the mass matrix",
        default: "barycentric",
        range: Range::Choice(&["barycentric", "consistent", "unit"]),
    }],
    promises: &[
        Promise::holds("FIN"),
        Promise::holds("LOC"),
        Promise::holds("SYM"),
        Promise::holds("NULL"),
        Promise::holds("PSD"),
        Promise::holds("PERM"),
        Promise::holds("UNION"),
        Promise::holds("REACH"),
        Promise::holds("LIN"),
        Promise::holds_given("MASS", &[Fact::NoIsolatedVertex])
            .when(&[When::Is("mass", &["barycentric", "consistent"])]),
        Promise::holds(CONVERGENCE).when(&[When::Is("mass", &["barycentric", "consistent"])]),
        Promise::fails_somewhere("POS"),
        Promise::fails_somewhere("POS0"),
        Promise::fails_somewhere("POS-boundary"),
        Promise::fails_somewhere("MVP"),
        Promise::fails_somewhere("MAX-local"),
        Promise::fails_somewhere("MAX-global"),
        Promise::fails_somewhere("MAX-heat"),
    ],
    build,
};

/// A tetrahedron over any scalar.
struct Shape<S> {
    /// `N_i` of each corner, `∇φ_i = N_i / D`.
    normals: [[S; 3]; 4],
    /// Six times the volume, D.
    sextuple: S,
}

impl<S: Scalar> Shape<S> {
    /// None where the volume is zero in this scalar's arithmetic.
    fn of(p: &[[S; 3]; 4]) -> Option<Self> {
        let edge = |from: usize, to: usize| std::array::from_fn(|a| p[to][a].clone() - p[from][a].clone());
        let volume = dot(&edge(0, 1), &cross3(&edge(0, 2), &edge(0, 3)));
        let negative = volume.cmp_zero() == Ordering::Less;
        // Each corner with the face opposite in an order that makes the normal point inwards where the volume is positive.
        let normals = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]].map(|[a, b, c]| {
            let n = cross3(&edge(a, b), &edge(a, c));
            if negative { n.map(|x| -x) } else { n }
        });
        (volume.cmp_zero() != Ordering::Equal).then(|| Shape { normals, sextuple: volume.magnitude() })
    }

    /// What the tetrahedron adds to the weight between two of its corners.
    fn weight(&self, i: usize, j: usize) -> S {
        let six = number::<S>(6.0);
        -(dot(&self.normals[i], &self.normals[j]) / (six * self.sextuple.clone()))
    }
}

fn number<S: Scalar>(x: f64) -> S {
    // Whole numbers have an exact counterpart in every scalar.
    S::exactly(x).unwrap_or_else(S::zero)
}

/// The corners of a tetrahedron over a scalar.
fn corners<S: Scalar>(volume: &Volume, tetrahedron: usize) -> [[S; 3]; 4] {
    // Coordinates are finite (checked by the constructor), so each has its exact counterpart.
    volume.tetrahedra()[tetrahedron].map(|v| volume.positions()[v].map(number))
}

/// The stiffness matrix over any scalar, exactly over the rationals; `None` where a tetrahedron has no volume.
pub fn stiffness_of<S: Scalar>(volume: &Volume) -> Option<Csr<S>> {
    let mut weights = Vec::new();
    for (t, tet) in volume.tetrahedra().iter().enumerate() {
        let shape = Shape::<S>::of(&corners(volume, t))?;
        for (i, j) in PAIRS {
            let weight = shape.weight(i, j);
            weights.push(([tet[i], tet[j]], [weight.clone(), weight]));
        }
    }
    Some(stiffness::from_weights(volume.positions().len(), &weights))
}

/// The mass matrix of a kind over any scalar; `None` for a kind that tetrahedra do not make, or without volume.
pub fn mass_of<S: Scalar>(volume: &Volume, kind: MassKind) -> Option<Csr<S>> {
    let volumes = (0..volume.tetrahedra().len()).map(|t| Some(Shape::<S>::of(&corners(volume, t))?.sextuple));
    mass(volume, kind, &volumes.collect::<Option<Vec<S>>>()?)
}

/// `V/4` for each corner; or `V/10` on the diagonal and `V/20` off it. From the sixfold volumes.
fn mass<S: Scalar>(volume: &Volume, kind: MassKind, sextuple: &[S]) -> Option<Csr<S>> {
    let n = volume.positions().len();
    let mut entries = Vec::new();
    for (tet, six) in volume.tetrahedra().iter().zip(sextuple) {
        let share = |parts: f64| six.clone() / number(6.0 * parts);
        for &i in tet {
            match kind {
                MassKind::Barycentric => entries.push((i, i, share(4.0))),
                MassKind::Consistent => {
                    entries.extend(tet.iter().map(|&j| (i, j, share(if i == j { 10.0 } else { 20.0 }))));
                }
                _ => {}
            }
        }
    }
    match kind {
        MassKind::Barycentric => {
            let mut diagonal = vec![S::zero(); n];
            entries.into_iter().for_each(|(i, _, share)| diagonal[i] = diagonal[i].clone() + share);
            Some(Csr::diagonal(&diagonal))
        }
        MassKind::Consistent => Some(Csr::from_triplets(n, n, &entries)),
        MassKind::Unit => Some(Csr::diagonal(&vec![number(1.0); n])),
        _ => None,
    }
}

/// The six pairs of corners.
const PAIRS: [(usize, usize); 6] = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];

/// Half an ulp of a number in [1, 2).
const HALF_ULP: f64 = f64::EPSILON / 2.0;

/// A tetrahedron in floating point, with what its rounding may amount to.
struct Rounded {
    shape: Option<Shape<f64>>,
    /// The bound of the error of a term, see the heading; infinite where the volume is not to be trusted.
    bound: f64,
    /// Whether the volume is lost in its rounding: `|δD| ≤ 24u ℓ³`.
    flat: bool,
}

impl Rounded {
    fn of(p: &[[f64; 3]; 4]) -> Self {
        let length = |(a, b): (usize, usize)| (0..3).map(|k| (p[a][k] - p[b][k]).powi(2)).sum::<f64>().sqrt();
        let longest = PAIRS.into_iter().map(length).fold(0.0, f64::max);
        let shape = Shape::of(p);
        let d = shape.as_ref().map_or(0.0, |s| s.sextuple);
        let cubed = longest.powi(3);
        let bound = 128.0 * HALF_ULP * cubed * longest / (6.0 * d) * (1.0 + cubed / d);
        // A NaN from an overflow must count as not to be trusted as well.
        let trusted = d.is_normal() && d > 48.0 * HALF_ULP * cubed && bound.is_finite();
        Rounded { shape, bound: if trusted { bound } else { f64::INFINITY }, flat: !trusted }
    }
}

fn build(domain: &Domain, settings: &Settings) -> Result<Operator, BuildError> {
    let Domain::Volume(volume) = domain else {
        return Err(BuildError::WrongKind { laplacian: ENTRY.id, kind: domain.kind(), accepts: ENTRY.accepts });
    };
    refuse_flat(volume)?;
    let rounded: Vec<Rounded> =
        (0..volume.tetrahedra().len()).map(|t| Rounded::of(&corners::<f64>(volume, t))).collect();
    let mut around: BTreeMap<[usize; 2], Vec<(usize, [usize; 2])>> = BTreeMap::new();
    for (t, tet) in volume.tetrahedra().iter().enumerate() {
        for (i, j) in PAIRS {
            around.entry([tet[i].min(tet[j]), tet[i].max(tet[j])]).or_default().push((t, [i, j]));
        }
    }
    let weight = |list: &[(usize, [usize; 2])]| {
        let term = |&(t, [i, j]): &(usize, [usize; 2])| rounded[t].shape.as_ref().map_or(f64::NAN, |s| s.weight(i, j));
        let (sum, bound): (f64, f64) = (list.iter().map(term).sum(), list.iter().map(|(t, _)| rounded[*t].bound).sum());
        if sum.abs() > bound { sum } else { exact_weight(volume, list) }
    };
    let weights: Vec<_> = around.iter().map(|(&ends, list)| (ends, weight(list))).map(|(e, w)| (e, [w, w])).collect();
    let n = volume.positions().len();
    let matrix = stiffness::finite(ENTRY.id, n, &weights)?;
    let kind = MassKind::from_name(settings.get("mass")).unwrap_or(MassKind::Unit);
    let sextuple: Vec<f64> = rounded.iter().enumerate().map(|(t, r)| sextuple(volume, t, r)).collect();
    // The kind was checked against the names that the entry admits.
    let mass = mass(volume, kind, &sextuple).unwrap_or_else(|| Csr::diagonal(&vec![1.0; n]));
    stiffness::check_finite(ENTRY.id, &mass)?;
    let provenance = Provenance { id: ENTRY.id.into(), parameters: settings.all().clone(), notes: Vec::new() };
    Ok(Operator::new(matrix, provenance)?.with_mass(Mass::full(kind, mass))?.with_exact_signs())
}

/// The weight of an edge in rational arithmetic, rounded once, its sign kept.
fn exact_weight(volume: &Volume, list: &[(usize, [usize; 2])]) -> f64 {
    let term = |&(t, [i, j]): &(usize, [usize; 2])| {
        Shape::<Rational>::of(&corners(volume, t)).map_or_else(Rational::zero, |shape| shape.weight(i, j))
    };
    let exact = crate::scalar::sum(list.iter().map(term));
    with_sign(exact.approximate(), exact.cmp_zero())
}

/// Six times the volume of a tetrahedron; in rational arithmetic where it is lost in its rounding.
fn sextuple(volume: &Volume, tetrahedron: usize, rounded: &Rounded) -> f64 {
    match &rounded.shape {
        Some(shape) if !rounded.flat => shape.sextuple,
        _ => Shape::<Rational>::of(&corners(volume, tetrahedron))
            .map_or(0.0, |s| with_sign(s.sextuple.approximate(), Ordering::Greater)),
    }
}

fn refuse_flat(volume: &Volume) -> Result<(), BuildError> {
    let flat = |tet: &[usize; 4]| {
        let [a, b, c, d] = tet.map(|v| volume.positions()[v]);
        geometry::orient3d(a, b, c, d).is_eq()
    };
    let mut flats = volume.tetrahedra().iter().enumerate().filter(|(_, tet)| flat(tet));
    match flats.next() {
        None => Ok(()),
        Some((tetrahedron, &corners)) => {
            Err(BuildError::Flat { laplacian: ENTRY.id, tetrahedron, corners, count: 1 + flats.count() })
        }
    }
}
