//! Recipes: a line of text that makes a domain, the same one for ever.
//!
//! ```text
//! recipe    = source { " | " modifier }
//! source    = generator call | path of a mesh file
//! modifier  = generator call
//! call      = id [ ":" key "=" value { "," key "=" value } ]
//! ```
//! The key `seed` sets the seed of a call (0 if absent). A path is relative to the root that [`Recipe::build`] is given; it
//! has the extension of a format that can be read, and no `|`.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use super::call::{Call, CallError};
use crate::domain::Domain;
use crate::exchange::{self, Format, ReadError};
use crate::generate::{self, GenerateError};

/// What makes a domain: a file or a generator, then modifiers.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Recipe {
    source: Source,
    modifiers: Vec<Step>,
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Source {
    File(String),
    Generator(Step),
}

/// A generator with its settings and seed.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Step {
    call: Call,
    seed: u64,
}

/// Why a recipe makes no domain.
#[derive(Debug, thiserror::Error)]
pub enum RecipeError {
    /// Not written as an id with settings.
    #[error(transparent)]
    Call(#[from] CallError),
    /// Neither a generator nor a file of a known format.
    #[error("'{word}' is neither a generator nor a mesh file; 'lapjury list generators' names the generators")]
    Unknown {
        /// The word in question.
        word: String,
    },
    /// A seed that is not a whole number.
    #[error("the seed '{seed}' in '{call}' is not a whole number below 2⁶⁴")]
    Seed {
        /// The call.
        call: String,
        /// The value in question.
        seed: String,
    },
    /// The file could not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A generator refused.
    #[error(transparent)]
    Generate(#[from] GenerateError),
}

impl Recipe {
    /// Makes the domain; paths are relative to `root`.
    ///
    /// # Errors
    /// A file that cannot be read, a generator that refuses its settings or its place in the recipe.
    pub fn build(&self, root: &Path) -> Result<Domain, RecipeError> {
        let mut domain = match &self.source {
            Source::File(path) => exchange::read_domain(&root.join(path))?,
            Source::Generator(step) => step.run(None)?,
        };
        for modifier in &self.modifiers {
            domain = modifier.run(Some(&domain))?;
        }
        Ok(domain)
    }
}

impl Step {
    fn run(&self, input: Option<&Domain>) -> Result<Domain, RecipeError> {
        let id = &self.call.id;
        let generator = generate::find(id).ok_or_else(|| RecipeError::Unknown { word: id.clone() })?;
        Ok(generator.run(input, &self.call.settings, self.seed)?)
    }
}

impl FromStr for Step {
    type Err = RecipeError;

    fn from_str(text: &str) -> Result<Self, RecipeError> {
        let mut call: Call = text.parse()?;
        if generate::find(&call.id).is_none() {
            return Err(RecipeError::Unknown { word: call.id });
        }
        let seed = match call.settings.remove("seed") {
            None => 0,
            Some(seed) => seed.parse().map_err(|_| RecipeError::Seed { call: text.into(), seed })?,
        };
        Ok(Step { call, seed })
    }
}

impl FromStr for Source {
    type Err = RecipeError;

    fn from_str(text: &str) -> Result<Self, RecipeError> {
        match text.parse::<Step>() {
            Ok(step) => Ok(Source::Generator(step)),
            // A path may have any character, so that it need not be a call.
            Err(RecipeError::Unknown { .. } | RecipeError::Call(_)) if Format::of(Path::new(text)).is_ok() => {
                Ok(Source::File(text.into()))
            }
            Err(error) => Err(error),
        }
    }
}

impl FromStr for Recipe {
    type Err = RecipeError;

    fn from_str(text: &str) -> Result<Self, RecipeError> {
        let mut parts = text.split('|').map(str::trim);
        let source = parts.next().unwrap_or_default().parse()?;
        Ok(Recipe { source, modifiers: parts.map(str::parse).collect::<Result<_, _>>()? })
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.call.fmt(f)?;
        if self.seed == 0 {
            return Ok(());
        }
        write!(f, "{}seed={}", if self.call.settings.is_empty() { ':' } else { ',' }, self.seed)
    }
}

impl fmt::Display for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.source {
            Source::File(path) => f.write_str(path)?,
            Source::Generator(step) => step.fmt(f)?,
        }
        self.modifiers.iter().try_for_each(|m| write!(f, " | {m}"))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::generate::Make;

    /// A call of an entry with some of its parameters, at their defaults, and a seed.
    fn step(modifier: bool) -> impl Strategy<Value = Step> {
        let entries: Vec<_> =
            generate::ALL.iter().filter(|g| matches!(g.make, Make::Modifier(_)) == modifier).copied().collect();
        (proptest::sample::select(entries.iter().map(|g| g.id).collect::<Vec<_>>()), any::<u64>(), any::<u8>())
            .prop_map(|(id, seed, mask)| {
                let parameters = generate::find(id).unwrap().parameters.iter().enumerate();
                let settings = parameters
                    .filter(|(k, _)| mask >> (k % 8) & 1 == 1)
                    .map(|(_, p)| (p.name.to_string(), p.default.to_string()))
                    .collect();
                Step { call: Call { id: id.to_string(), settings }, seed: if seed % 4 == 0 { 0 } else { seed } }
            })
    }

    fn source() -> impl Strategy<Value = Source> {
        let path = "(\\./|/)?[a-zA-Z0-9_:=,'é-][a-zA-Z0-9_:=,' é-]{0,11}(/[a-z.]{1,6})?";
        let file = (path, proptest::sample::select(Format::ALL.to_vec()))
            .prop_map(|(stem, format)| Source::File(format!("{stem}.{}", format.extension())));
        prop_oneof![step(false).prop_map(Source::Generator), file]
    }

    proptest! {
        #[test]
        fn a_recipe_reads_back_from_its_text(source in source(), modifiers in prop::collection::vec(step(true), 0..4)) {
            let recipe = Recipe { source, modifiers };
            let text = recipe.to_string();
            prop_assert_eq!(&text.parse::<Recipe>().unwrap(), &recipe, "{}", text);
        }

        #[test]
        fn no_text_makes_the_reader_panic_and_what_it_reads_it_writes(text in "[a-z:=,| .é0-9-]{0,40}") {
            if let Ok(recipe) = text.parse::<Recipe>() {
                prop_assert_eq!(recipe.to_string().parse::<Recipe>().unwrap(), recipe);
            }
        }
    }

    fn message(text: &str) -> String {
        let made = text.parse::<Recipe>().and_then(|recipe| recipe.build(Path::new(".")));
        made.expect_err(text).to_string()
    }

    #[test]
    fn what_makes_no_domain_is_refused_with_its_place_and_advice() {
        for (text, expected) in [
            (
                "gird:nx=2",
                "'gird' is neither a generator nor a mesh file; 'lapjury list generators' names the generators",
            ),
            ("gird:nx=2.5", "'gird' is neither a generator"),
            ("", "'' is neither a generator"),
            ("cube.jpg", "'cube.jpg' is neither a generator"),
            ("grid:nx", "'nx' in 'grid:nx' is not a setting; write key=value"),
            ("grid:seed=-1", "the seed '-1' in 'grid:seed=-1' is not a whole number below 2⁶⁴"),
            ("grid | flop:count=1", "'flop' is neither a generator"),
            ("grid | fixtures/meshes/eight.off", "'fixtures/meshes/eight.off' is neither a generator"),
            ("grid:width=3", "'grid' has no parameter 'width'"),
            ("grid | icosphere", "'icosphere' makes a domain from nothing; it must come first in a recipe"),
            ("flip:count=3", "'flip' changes a domain; give it one"),
            ("no-such-file.off", "./no-such-file.off: No such file"),
        ] {
            assert!(message(text).starts_with(expected), "{text}: {}", message(text));
        }
    }

    #[test]
    fn the_seed_belongs_to_its_call_and_zero_is_not_written() {
        let recipe: Recipe = "random-delaunay: seed = 7 ,n=9 | flip:seed=0".parse().unwrap();
        assert_eq!(recipe.to_string(), "random-delaunay:n=9,seed=7 | flip");
        let digest = |text: &str| text.parse::<Recipe>().unwrap().build(Path::new(".")).unwrap().digest();
        assert_eq!(digest("random-delaunay:n=9,seed=7"), digest("random-delaunay:seed=7,n=9"));
        assert_ne!(digest("random-delaunay:n=9,seed=7"), digest("random-delaunay:n=9,seed=8"));
    }
}
