//! Planted faults: ways to spoil a correct operator or mass matrix, each with what must catch it.
//!
//! A checker that has never been seen failing proves nothing. [`all`] lists the mistakes that programs make — one entry, a
//! row, an element of the assembly, the boundary, the mass, the indices, the rounding —, each as a pure function of
//! (domain, operator, seed). They work on anybody's operator: plant one in your own and see whether your checks notice.
//! ```
//! use lapjury::fault::{self, Planting};
//! use lapjury::{Domain, Surface, Status, Trial};
//!
//! let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
//! let domain = Domain::from(Surface::planar(&points, &[[0, 1, 2], [1, 3, 2]])?);
//! let operator = lapjury::laplacian::find("cotan").ok_or("in the catalogue")?.build(&domain, &Default::default())?;
//!
//! let fault = fault::find("boundary-weights-doubled").ok_or("in the list")?;
//! assert_eq!(fault.caught_by, ["FLUX", "ENERGY"]);
//! let Planting::Spoilt(spoilt) = fault.plant(&domain, &operator, 0) else { panic!("it has a boundary") };
//! let trial = Trial::new(&domain, &spoilt, 0)?;
//! let decide = |id: &str| lapjury::property::find(id).map(|p| p.decide(&trial, None).status());
//! assert_eq!([decide("SYM"), decide("NULL"), decide("FLUX")], [Status::Holds, Status::Holds, Status::Fails].map(Some));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What must catch a fault
//! [`Fault::caught_by`] names properties; the first is the one meant for it. They see matrix and mesh and no reference.
//! Where they cannot see the fault, [`Fault::blind`] says on which meshes and why, and there only the comparison with the
//! operator that is meant ([`external::compare`](crate::external::compare)) does. Everything else is a miss.
//!
//! To add one: write it into the list of the file whose idea it shares.

mod assembly;
mod boundary;
mod element;
mod entry;
mod factor;
mod geometry;
mod index;
mod mass;
mod mass_entry;
mod pair;
mod rounding;
mod row;
mod site;

use crate::domain::{Domain, Facts};
use crate::linalg::Csr;
use crate::operator::{MassKind, Operator};
use crate::stream::Stream;
pub use site::Site;

/// The spoilt operator, or why a fault does not apply to it.
pub type Spoilt = Result<Operator, &'static str>;

/// A way to spoil an operator.
pub struct Fault {
    /// The id, in kebab case.
    pub id: &'static str,
    /// What is done, in words.
    pub what: &'static str,
    /// The kind of mistake.
    pub class: Class,
    /// The kinds of mass that it is about; empty for a fault of the stiffness matrix.
    pub masses: &'static [MassKind],
    /// The properties that must catch it, ids as in [`property::ALL`](crate::property::ALL), the one meant for it first. Empty
    /// where none can, anywhere.
    pub caught_by: &'static [&'static str],
    /// Where those properties cannot see it, and only the comparison with the operator that is meant can.
    pub blind: &'static [Blind],
    /// Does it. The error says why it does not apply here.
    pub change: fn(&Site, &mut Stream) -> Spoilt,
}

/// The kind of mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// One entry, or one pair of entries.
    Entry,
    /// A row, a column or the diagonal.
    Row,
    /// A factor of the whole.
    Factor,
    /// Which elements are added up, and how often.
    Assembly,
    /// What an element contributes.
    Element,
    /// Where the vertices are.
    Geometry,
    /// What is done at the boundary.
    Boundary,
    /// Which row belongs to which vertex.
    Index,
    /// How numbers are rounded.
    Rounding,
    /// The mass matrix.
    Mass,
}

impl Class {
    /// Every class, in the order of the tables.
    pub const ALL: [Class; 10] = [
        Class::Entry,
        Class::Row,
        Class::Factor,
        Class::Assembly,
        Class::Element,
        Class::Geometry,
        Class::Boundary,
        Class::Index,
        Class::Rounding,
        Class::Mass,
    ];

    /// A fault of this class, of the stiffness matrix.
    const fn fault(
        self,
        id: &'static str,
        what: &'static str,
        caught_by: &'static [&'static str],
        blind: &'static [Blind],
        change: fn(&Site, &mut Stream) -> Spoilt,
    ) -> Fault {
        Fault { id, what, class: self, masses: &[], caught_by, blind, change }
    }

    /// The class in a word.
    pub fn name(self) -> &'static str {
        match self {
            Class::Entry => "entry",
            Class::Row => "row",
            Class::Factor => "factor",
            Class::Assembly => "assembly",
            Class::Element => "element",
            Class::Geometry => "geometry",
            Class::Boundary => "boundary",
            Class::Index => "index",
            Class::Rounding => "rounding",
            Class::Mass => "mass",
        }
    }
}

/// Meshes on which no property of matrix and mesh alone can see a fault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Blind {
    /// Everywhere, for this reason.
    Anywhere(&'static str),
    /// Where some angle is below this many degrees: the rounding that such a triangle explains is larger than the change.
    AnglesBelow(f64),
    /// Off the plane: coordinates are not linear functions there, so that LIN and FLUX say nothing, and ENERGY is one number
    /// for the whole surface. The energy of the coordinates is at least twice the area, with equality where they are conformal:
    /// it is stationary, and a metric that is wrong by δ changes it by δ² only.
    Curved,
    /// Where the mesh is no manifold, or has a degenerate face: LIN and FLUX leave those vertices out.
    Unsound,
    /// On graphs: without coordinates no weight is wrong.
    Graph,
    /// Where the mass does not say which one it is: the bounds of its star are wide, and many masses lie within them.
    Undeclared,
}

impl Blind {
    /// Whether a domain with these facts is such a mesh; `declared`: whether the mass says which one it is.
    pub fn covers(self, facts: &Facts, declared: bool) -> bool {
        let surface = facts.surface.as_ref();
        match self {
            Blind::Anywhere(_) => true,
            Blind::AnglesBelow(degrees) => {
                surface.is_some_and(|s| s.min_angle_deg.min(180.0 - s.max_angle_deg) < degrees)
            }
            Blind::Curved => surface.is_some_and(|s| !s.planar),
            Blind::Unsound => surface.is_some_and(|s| !s.manifold || s.degenerate_faces > 0),
            Blind::Graph => surface.is_none(),
            Blind::Undeclared => !declared,
        }
    }

    /// Where and why, in words.
    pub fn text(self) -> String {
        match self {
            Blind::Anywhere(why) => format!("anywhere: {why}"),
            Blind::AnglesBelow(degrees) => {
                format!("beside angles below {degrees}°: the rounding that they explain is larger than the change")
            }
            Blind::Curved => {
                {
                "on curved surfaces: LIN and FLUX say nothing there, and ENERGY is one number for all, which a metric that is wrong by δ \
                 changes by δ² only"
                    .into()
            }
            }
            Blind::Unsound => {
                "beside degenerate faces and where the mesh is no manifold: LIN and FLUX leave these out".into()
            }
            Blind::Graph => "on graphs: without coordinates no weight is wrong".into(),
            Blind::Undeclared => {
                "in a mass that does not say which one it is: several masses lie within the bounds".into()
            }
        }
    }
}

/// What planting a fault came to.
pub enum Planting {
    /// The spoilt operator.
    Spoilt(Box<Operator>),
    /// It does not change the operator here.
    Unchanged,
    /// It does not apply here, for this reason.
    NotHere(&'static str),
}

impl Fault {
    /// Plants the fault: the same for ever for the same domain, operator and seed.
    ///
    /// The spoilt operator comes as a matrix from elsewhere would: nobody vouches for the signs of its weights. Cost: O(nnz log).
    pub fn plant(&self, domain: &Domain, operator: &Operator, seed: u64) -> Planting {
        if !self.masses.is_empty() && !operator.mass().is_some_and(|m| self.masses.contains(&m.kind())) {
            return Planting::NotHere("it is about another mass");
        }
        let mut stream = Stream::new(seed, self.id);
        match (self.change)(&Site::new(domain, operator), &mut stream) {
            Err(why) => Planting::NotHere(why),
            Ok(spoilt) if same(operator, &spoilt) => Planting::Unchanged,
            Ok(spoilt) => Planting::Spoilt(Box::new(spoilt)),
        }
    }

    /// Whether it is a fault of the mass matrix.
    pub fn is_of_mass(&self) -> bool {
        !self.masses.is_empty()
    }

    /// Whether the properties named may be unable to see it on a domain with these facts.
    pub fn is_hidden(&self, facts: &Facts, declared: bool) -> bool {
        self.blind.iter().any(|b| b.covers(facts, declared))
    }
}

/// Whether two operators have equal values everywhere, stored zeros not counted.
fn same(a: &Operator, b: &Operator) -> bool {
    let mass = |o: &Operator| o.mass().map(|m| m.matrix().clone());
    equal(a.stiffness(), b.stiffness())
        && match (mass(a), mass(b)) {
            (Some(a), Some(b)) => equal(&a, &b),
            (None, None) => true,
            _ => false,
        }
}

fn equal(a: &Csr, b: &Csr) -> bool {
    fn values(m: &Csr) -> impl Iterator<Item = (usize, usize, &f64)> {
        m.entries().filter(|(_, _, v)| **v != 0.0)
    }
    a.rows() == b.rows() && values(a).eq(values(b))
}

/// Every fault, class by class.
pub fn all() -> impl Iterator<Item = &'static Fault> {
    let lists: [&'static [Fault]; 12] = [
        entry::FAULTS,
        pair::FAULTS,
        row::FAULTS,
        factor::FAULTS,
        assembly::FAULTS,
        element::FAULTS,
        geometry::FAULTS,
        boundary::FAULTS,
        index::FAULTS,
        rounding::FAULTS,
        mass::FAULTS,
        mass_entry::FAULTS,
    ];
    lists.into_iter().flatten()
}

/// The fault with this id.
pub fn find(id: &str) -> Option<&'static Fault> {
    all().find(|f| f.id == id)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::domain::Surface;
    use crate::laplacian;

    #[test]
    fn ids_are_unique_and_every_fault_says_what_it_does_and_what_sees_it() {
        let ids: BTreeSet<&str> = all().map(|f| f.id).collect();
        assert_eq!(ids.len(), all().count());
        assert!(ids.len() >= 60, "{}", ids.len());
        for f in all() {
            assert!(f.id.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-'), "{}", f.id);
            assert!(f.what.len() > 10, "{}", f.id);
            assert!(f.caught_by.iter().all(|id| crate::property::find(id).is_some()), "{}", f.id);
            assert_eq!(f.is_of_mass(), f.class == Class::Mass, "{}", f.id);
            let nowhere_seen = f.caught_by.is_empty() && f.blind.is_empty();
            assert_eq!(nowhere_seen, f.id == "stored-zero", "{}: who sees it?", f.id);
        }
    }

    #[test]
    fn a_seed_plants_the_same_fault_for_ever_and_another_seed_another() {
        let p = [[0.0, 0.0], [2.0, 0.1], [2.2, 2.0], [0.1, 1.9], [1.0, 0.9]];
        let domain = Domain::from(Surface::planar(&p, &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]).unwrap());
        let operator = laplacian::find("cotan").unwrap().build(&domain, &Default::default()).unwrap();
        let planted = |seed| match find("entry-off-1e-6").unwrap().plant(&domain, &operator, seed) {
            Planting::Spoilt(spoilt) => spoilt.stiffness().clone(),
            _ => panic!("nothing was planted"),
        };
        assert_eq!(planted(1), planted(1));
        assert!((0..20).any(|seed| planted(seed) != planted(1)));
    }

    #[test]
    fn a_fault_of_another_mass_does_not_apply() {
        let domain = Domain::from(Surface::planar(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &[[0, 1, 2]]).unwrap());
        let operator = laplacian::find("cotan").unwrap().build(&domain, &Default::default()).unwrap();
        let planting = find("obtuse-rule-forgotten").unwrap().plant(&domain, &operator, 0);
        assert!(matches!(planting, Planting::NotHere("it is about another mass")));
    }
}
