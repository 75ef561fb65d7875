//! What a suite says of its atlas, and which pairs of operator and property that asks for.

use serde::Deserialize;

use super::{World, search};
use crate::domain::DomainKind;
use crate::property::Property;
use crate::record::AtlasLine;
use crate::suite::choice::Choice;

/// The table `[atlas]` of a suite. Unknown keys are errors.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Written {
    /// The largest number of points.
    pub vertices: usize,
    /// The side of the box, in lattice steps.
    pub side: i64,
    /// The largest number of points for properties that compare operators of related domains; as `vertices` if absent.
    #[serde(default)]
    pub relations: Option<usize>,
    /// Operators that differ from another one in their mass: only the properties that read it are asked of them.
    #[serde(default)]
    pub masses: Vec<String>,
}

/// The properties that read the mass.
const OF_MASS: [&str; 3] = ["MASS", "MAX-heat", "SCALE"];

/// The atlas of a suite with every name looked up.
#[derive(Clone)]
pub struct Atlas {
    world: World,
    related: World,
    choices: Vec<Choice>,
    masses: Vec<Choice>,
    properties: Vec<&'static Property>,
}

/// The most points and the longest side: beyond, the world has millions of triangulations.
const LARGEST: (usize, i64) = (7, 4);

impl Atlas {
    /// The atlas of operators that live on surfaces.
    ///
    /// # Errors
    /// A world that is too large to be searched, with the limits.
    pub fn new(
        written: &Written,
        choices: &[Choice],
        masses: Vec<Choice>,
        properties: Vec<&'static Property>,
    ) -> Result<Self, String> {
        let world = World { vertices: written.vertices, side: written.side };
        let related = World { vertices: written.relations.unwrap_or(written.vertices), ..world };
        for w in [world, related] {
            if !(3..=LARGEST.0).contains(&w.vertices) || !(1..=LARGEST.1).contains(&w.side) {
                return Err(format!(
                    "asks for {} points in a box of side {}; it must be 3 to {} points and a side of 1 to {}",
                    w.vertices, w.side, LARGEST.0, LARGEST.1
                ));
            }
        }
        let on_surfaces = |c: &&Choice| c.laplacian.accepts.contains(&DomainKind::Surface);
        let choices = choices.iter().filter(on_surfaces).cloned().collect();
        Ok(Atlas { world, related, choices, masses, properties })
    }

    /// Searches both worlds.
    pub fn search(&self) -> Vec<AtlasLine> {
        let (related, plain): (Vec<_>, Vec<_>) = self.pairs().into_iter().partition(|(_, p)| p.is_relation());
        let mut lines = search(self.world, &plain);
        lines.extend(search(self.related, &related));
        lines
    }

    /// The pairs that are asked, in the order of operators, then properties.
    fn pairs(&self) -> Vec<(&Choice, &'static Property)> {
        let all = self.choices.iter().flat_map(|c| self.properties.iter().map(move |p| (c, *p)));
        let of_mass = move |p: &&Property| OF_MASS.contains(&p.id);
        let masses =
            self.masses.iter().flat_map(|c| self.properties.iter().copied().filter(of_mass).map(move |p| (c, p)));
        all.chain(masses).collect()
    }
}
