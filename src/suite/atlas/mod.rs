//! The atlas of smallest counterexamples: every triangulation of every small point set of a lattice box is tried, so that the
//! first on which a property fails is provably the smallest there is in the box.
//!
//! # Definition
//! The world with at most n points in a box of side s is every triangulation of every set of 3 to n points of the
//! `(s+1) × (s+1)` lattice, once up to the symmetries of the box and translation
//! ([`triangulations`](crate::experiment::world::triangulations)). *Smaller* means fewer vertices, then the smaller bounding box (width
//! before height), then the lexicographic order of the points, then of the faces.
//!
//! # Decision
//! Where operator and property are rational, by [`exact`](crate::property::exact); elsewhere by the verdict of the property, whose level is
//! kept: the line of a cell says the weakest level at which one of its cases was decided. A cell ends with its first
//! counterexample; a case before it that stayed open takes away the word "provably".
//!
//! # Cost
//! The cells that hold are decided on the whole world. Parallel over point sets, in the order of the world: the lines do not
//! depend on the number of threads.
//!
//! # Limitations
//! A verdict is invariant under the symmetries of the box up to the rounding of the operator; what draws at random (REACH, PERM)
//! draws once for each triangulation.

mod judge;
mod plan;

use rayon::prelude::*;

use super::cases;
use super::choice::Choice;
use crate::domain::Domain;
use crate::experiment::world::triangulations::{Point, Triangulation, point_sets, triangulations};
use crate::generate::listed;
use crate::property::{Level, Property, Status};
use crate::record::{AtlasFound, AtlasLine, Recheck};

use judge::{Answer, Judge};
pub use plan::{Atlas, Written};

/// The triangulations that are searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct World {
    /// The largest number of points.
    pub vertices: usize,
    /// The side of the box, in lattice steps.
    pub side: i64,
}

impl std::fmt::Display for World {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let side = self.side + 1;
        write!(
            f,
            "every triangulation of every set of 3 to {} points in a box of {side} × {side} lattice points",
            self.vertices
        )
    }
}

impl World {
    /// What `witness` searches: six points; five where operators are built again for each case.
    pub fn of(property: &Property) -> Self {
        World { vertices: if property.is_relation() { 5 } else { 6 }, side: 3 }
    }

    /// Its point sets, smallest first.
    fn sets(&self) -> Vec<Vec<Point>> {
        (3..=self.vertices).flat_map(|n| point_sets(n, self.side)).collect()
    }
}

/// An operator and a property, with what became of them so far.
struct Cell<'a> {
    choice: &'a Choice,
    property: &'static Property,
    line: AtlasLine,
}

/// How many point sets are decided together: enough to keep the threads busy, few enough that a cell which has failed is soon
/// left out.
const CHUNK: usize = 64;

/// Searches the world for each pair of operator and property.
pub fn search(world: World, pairs: &[(&Choice, &'static Property)]) -> Vec<AtlasLine> {
    let mut cells: Vec<Cell> = pairs
        .iter()
        .map(|&(choice, property)| Cell { choice, property, line: blank(world, choice, property) })
        .collect();
    let mut before = 0;
    for chunk in world.sets().chunks(CHUNK) {
        let open: Vec<usize> = (0..cells.len()).filter(|&c| cells[c].line.found.is_none()).collect();
        let wanted: Vec<(usize, &Choice, &'static Property)> =
            open.iter().map(|&c| (c, cells[c].choice, cells[c].property)).collect();
        let judge = Judge::new(&wanted);
        let decide = |set: &Vec<Point>| -> Vec<(Triangulation, Vec<(usize, Answer)>)> {
            let all = triangulations(set);
            all.into_iter().map(|t| (judge.answers(&domain(&t), &recipe(&t)), t)).map(|(a, t)| (t, a)).collect()
        };
        let decided: Vec<Vec<_>> = chunk.par_iter().map(decide).collect();
        for (triangulation, answers) in decided.into_iter().flatten() {
            before += 1;
            for (c, answer) in answers {
                cells[c].take(&triangulation, before, answer);
            }
        }
    }
    let finish = |cell: Cell| AtlasLine { size: before, ..cell.line };
    cells.into_iter().map(finish).collect()
}

fn blank(world: World, choice: &Choice, property: &Property) -> AtlasLine {
    AtlasLine {
        laplacian: choice.to_string(),
        property: property.id.into(),
        world: world.to_string(),
        size: 0,
        searched: 0,
        decided: 0,
        open: 0,
        silent: 0,
        refused: 0,
        level: None,
        found: None,
    }
}

/// The triangulation as a domain.
fn domain(triangulation: &Triangulation) -> Domain {
    triangulation.surface().into()
}

/// The recipe that makes it.
fn recipe(triangulation: &Triangulation) -> String {
    let positions: Vec<[f64; 3]> = triangulation.points().iter().map(|p| [p[0] as f64, p[1] as f64, 0.0]).collect();
    let faces: Vec<Vec<usize>> = triangulation.faces().iter().map(|f| f.to_vec()).collect();
    listed::call(&positions, &faces)
}

impl Cell<'_> {
    /// Takes in the answer on the `number`-th triangulation of the world, unless an earlier one was a counterexample.
    fn take(&mut self, triangulation: &Triangulation, number: usize, answer: Answer) {
        let line = &mut self.line;
        if line.found.is_some() {
            return;
        }
        line.searched = number;
        match answer {
            Answer::Refused => line.refused += 1,
            Answer::Decided(Status::NotApplicable, _) => line.silent += 1,
            Answer::Decided(Status::Undecided, _) => line.open += 1,
            Answer::Decided(status, level) => {
                line.decided += 1;
                line.level = line.level.max(Some(level));
                if status == Status::Fails {
                    self.found(triangulation, level);
                }
            }
        }
    }

    /// Writes down a counterexample with its witness, rechecked. Where the exact decision and the verdict in floating point
    /// do not agree there is no witness, and the evidence counts as refused.
    fn found(&mut self, triangulation: &Triangulation, level: Level) {
        let (domain, recipe) = (domain(triangulation), recipe(triangulation));
        let Some(mut cell) = cases::cell(self.choice, self.property, &domain, &recipe) else {
            // It has a twin, and in floating point it refuses this mesh.
            (self.line.decided, self.line.refused) = (self.line.decided - 1, self.line.refused + 1);
            return;
        };
        if cell.verdict.status() != Status::Fails {
            let why = "the exact decision says that the property fails here".into();
            cell.recheck = Recheck::Refused(why);
        } else if level == Level::Exact {
            cell.verdict.level = Level::Exact;
        }
        let exhibit = super::run::exhibit(&cell, &domain);
        let extent = |axis: usize| triangulation.points().iter().map(|p| p[axis]).max().unwrap_or(0);
        self.line.found = Some(Box::new(AtlasFound { extent: [extent(0), extent(1)], cell, exhibit }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::find;

    fn one(laplacian: &str, property: &str, world: World) -> AtlasLine {
        let choice: Choice = laplacian.parse().unwrap();
        search(world, &[(&choice, find(property).unwrap())]).remove(0)
    }

    const FIVE: World = World { vertices: 5, side: 3 };

    #[test]
    fn the_smallest_negative_cotangent_weights_are_those_that_a_hand_finds() {
        // Half of the unit square, the smallest triangle of all: the angle opposite its long side is right, the weight zero.
        let boundary = one("cotan", "POS-boundary", FIVE).found.unwrap();
        assert_eq!(boundary.cell.recipe, "listed:faces=0 2 1,points=0 0;0 1;1 0");
        // Two right angles opposite the diagonal of the unit square: the weight is zero, and POS is strict.
        let strict = one("cotan", "POS", FIVE);
        assert_eq!(strict.found.as_ref().unwrap().extent, [1, 1]);
        assert_eq!((strict.level, strict.open), (Some(Level::Exact), 0));
        assert_eq!(strict.found.unwrap().exhibit.positions.len(), 4);
        // Below zero it takes a quadrangle that is no rectangle: its box is 2 × 1.
        let weak = one("cotan", "POS0", FIVE).found.unwrap();
        assert_eq!((weak.exhibit.positions.len(), weak.extent), (4, [2, 1]));
        assert!(matches!(weak.cell.recheck, Recheck::Exact));
    }

    #[test]
    fn what_holds_is_decided_on_the_whole_world() {
        let line = one("cotan", "PSD", FIVE);
        assert!(line.found.is_none() && line.open == 0 && line.refused == 0);
        assert_eq!((line.decided, line.searched, line.level), (line.size, line.size, Some(Level::Exact)));
        let sizes: usize = FIVE.sets().iter().map(|s| triangulations(s).len()).sum();
        assert_eq!(line.size, sizes);
        // Five points need not have an interior vertex: there LIN says nothing.
        let linear = one("cotan", "LIN", FIVE);
        assert!(linear.found.is_none() && linear.silent > 0 && linear.decided > 0);
        assert_eq!(linear.decided + linear.silent, linear.size);
    }

    #[test]
    fn the_lines_do_not_depend_on_the_number_of_threads() {
        let choices: Vec<Choice> = ["cotan", "mean-value", "graph"].iter().map(|id| id.parse().unwrap()).collect();
        let properties = ["SYM", "POS", "LIN", "PSD", "MAX-local"].map(|id| find(id).unwrap());
        let pairs: Vec<_> = choices.iter().flat_map(|c| properties.iter().map(move |p| (c, *p))).collect();
        let world = World { vertices: 5, side: 2 };
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| search(world, &pairs))
        };
        assert_eq!(on(1), on(3));
    }
}
