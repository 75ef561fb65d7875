//! From a suite to its cases: names are looked up, seeds drawn. Everything that can be wrong with a suite is found here,
//! before anything is run.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use super::atlas::Atlas;
use super::choice::Choice;
use super::claims::{self, Claim};
use super::recipe::{Recipe, RecipeError};
use super::schema::{Class, OTHERS, Suite, SuiteError, Vary};
use crate::experiment::Setting;
use crate::generate::Stream;
use crate::laplacian;
use crate::property::{self, Property};

/// A suite with every name looked up and every seed drawn.
pub struct Plan {
    /// The suite's id.
    pub suite: String,
    /// Seed and effort.
    pub setting: Setting,
    /// The cases, in the order of the file.
    pub cases: Vec<Case>,
    /// The claims to test on them.
    pub claims: Vec<Claim>,
    /// The search for smallest counterexamples.
    pub atlas: Option<Atlas>,
}

/// One domain of a plan with what is tried on it.
#[derive(Clone)]
pub struct Case {
    /// The class that it belongs to.
    pub class: String,
    /// What makes it.
    pub recipe: Recipe,
    /// The operators.
    pub choices: Vec<Choice>,
    /// The properties.
    pub properties: Vec<&'static Property>,
}

impl Suite {
    /// The plan of the suite: the same for the same seed.
    ///
    /// A class with few choices draws the same domain again, and two classes may draw the same one; it is tried once, with
    /// the operators and properties of all.
    ///
    /// # Errors
    /// A name that does not exist, a class that makes no sense, a plan that tests nothing.
    pub fn plan(&self) -> Result<Plan, SuiteError> {
        // Also where no class asks for them: a name that does not exist is a mistake wherever it stands.
        let (choices, properties) = (self.choices(&self.laplacians)?, self.properties(&self.properties)?);
        let mut cases: Vec<Case> = Vec::new();
        let mut drawn = BTreeMap::new();
        for (at, class) in self.classes.iter().enumerate() {
            if self.classes[..at].iter().any(|c| c.id == class.id) {
                return Err(self.bad(class, "has the id of an earlier one"));
            }
            for case in self.cases(class, &choices, &properties)? {
                match drawn.entry(case.recipe.clone()) {
                    Entry::Vacant(place) => {
                        place.insert(cases.len());
                        cases.push(case);
                    }
                    Entry::Occupied(place) => cases[*place.get()].join(case),
                }
            }
        }
        let claims = self.claims()?;
        if claims.is_empty() && cases.iter().all(|c| c.choices.is_empty() || c.properties.is_empty()) {
            return Err(SuiteError::Empty { suite: self.id.clone() });
        }
        let setting = Setting { seed: self.seed, effort: self.effort };
        let atlas = self.atlas(&choices, properties)?;
        Ok(Plan { suite: self.id.clone(), setting, cases, claims, atlas })
    }

    /// The cases of a class, with these operators unless it names its own, and these properties but for those it leaves out.
    fn cases(
        &self,
        class: &Class,
        choices: &[Choice],
        properties: &[&'static Property],
    ) -> Result<Vec<Case>, SuiteError> {
        let choices = match &class.laplacians {
            Some(list) => self.choices(list)?,
            None => choices.to_vec(),
        };
        let without = self.left_out(class)?;
        let mut properties = properties.to_vec();
        properties.retain(|p| without.iter().all(|w| w.id != p.id));
        let case =
            |recipe| Case { class: class.id.clone(), recipe, choices: choices.clone(), properties: properties.clone() };
        Ok(self.recipes(class)?.into_iter().map(case).collect())
    }

    /// The properties that a class leaves out; "relations" stands for all that compare operators of related domains.
    fn left_out(&self, class: &Class) -> Result<Vec<&'static Property>, SuiteError> {
        let named: Vec<String> = class.without.iter().filter(|id| *id != "relations").cloned().collect();
        let mut list = self.properties(&named)?;
        if named.len() < class.without.len() {
            list.extend(property::ALL.iter().filter(|p| p.is_relation()));
        }
        Ok(list)
    }

    fn recipes(&self, class: &Class) -> Result<Vec<Recipe>, SuiteError> {
        let texts = match &class.recipe {
            None if class.files.is_empty() => return Err(self.bad(class, "needs a recipe or files")),
            Some(_) if !class.files.is_empty() => return Err(self.bad(class, "has both a recipe and files")),
            None if !class.vary.is_empty() => return Err(self.bad(class, "varies files, which have nothing to vary")),
            None => class.files.clone(),
            Some(template) => {
                class.check(template).map_err(|problem| self.bad(class, problem))?;
                (0..class.count).map(|k| self.draw(class, template, k)).collect()
            }
        };
        let error = |error: RecipeError| SuiteError::Recipe {
            suite: self.id.clone(),
            class: class.id.clone(),
            error: Box::new(error),
        };
        texts.iter().map(|text| text.parse().map_err(error)).collect()
    }

    /// The text of the `k`-th recipe of a class. Each has a stream of its own, so that a larger count keeps the earlier ones.
    fn draw(&self, class: &Class, template: &str, k: usize) -> String {
        let mut stream = Stream::new(self.seed, &format!("suite/{}/{}/{k}", self.id, class.id));
        let mut text = template.to_string();
        for (name, vary) in &class.vary {
            text = text.replace(&placeholder(name), &vary.draw(&mut stream));
        }
        // Nine digits are easy to type again.
        text.replace(&placeholder("seed"), &(stream.bits() % 1_000_000_000).to_string())
    }

    fn choices(&self, list: &[String]) -> Result<Vec<Choice>, SuiteError> {
        let mut choices: Vec<Choice> = Vec::new();
        for text in expand(list, laplacian::ALL.iter().map(|l| l.id)) {
            let choice: Choice =
                text.parse().map_err(|error| SuiteError::Choice { suite: self.id.clone(), error: Box::new(error) })?;
            push_new(&mut choices, choice, Choice::to_string);
        }
        Ok(choices)
    }

    fn properties(&self, list: &[String]) -> Result<Vec<&'static Property>, SuiteError> {
        let unknown = |id: String| SuiteError::Property { suite: self.id.clone(), id };
        expand(list, property::ALL.iter().map(|p| p.id))
            .into_iter()
            .map(|id| property::find(&id).ok_or_else(|| unknown(id)))
            .collect()
    }

    fn claims(&self) -> Result<Vec<Claim>, SuiteError> {
        let select = || {
            let all = claims::all()?;
            claims::select(&expand(&self.claims, all.iter().map(|c| c.id.as_str())))
        };
        select().map_err(|error| SuiteError::Claim { suite: self.id.clone(), error: Box::new(error) })
    }

    fn atlas(&self, choices: &[Choice], properties: Vec<&'static Property>) -> Result<Option<Atlas>, SuiteError> {
        let Some(written) = &self.atlas else { return Ok(None) };
        let atlas = Atlas::new(written, choices, self.choices(&written.masses)?, properties);
        atlas.map(Some).map_err(|problem| SuiteError::Atlas { suite: self.id.clone(), problem })
    }

    fn bad(&self, class: &Class, problem: impl Into<String>) -> SuiteError {
        SuiteError::Class { suite: self.id.clone(), class: class.id.clone(), problem: problem.into() }
    }
}

impl Plan {
    /// Leaves out every case, operator and property that no claim asks, and the atlas.
    pub fn narrow(&mut self) {
        self.atlas = None;
        let claims = &self.claims;
        for case in &mut self.cases {
            let asks = |c: &Choice, p: &Property| claims.iter().any(|claim| claim.asks(c.laplacian.id, p.id));
            let choices = std::mem::take(&mut case.choices);
            case.properties.retain(|p| choices.iter().any(|c| asks(c, p)));
            case.choices = choices.into_iter().filter(|c| case.properties.iter().any(|p| asks(c, p))).collect();
        }
        self.cases.retain(|case| !case.choices.is_empty());
    }
}

/// The names of a list, each once, with the word `others` replaced by the ids of a catalogue that the list does not name.
fn expand<'a>(list: &[String], catalogue: impl Iterator<Item = &'a str> + Clone) -> Vec<String> {
    let named: Vec<&str> = list.iter().map(|text| text.split(':').next().unwrap_or_default().trim()).collect();
    let mut names: Vec<String> = Vec::new();
    for text in list {
        let new: Vec<String> = match text.as_str() {
            OTHERS => catalogue.clone().filter(|id| !named.contains(id)).map(str::to_string).collect(),
            text => vec![text.to_string()],
        };
        for name in new {
            push_new(&mut names, name, String::clone);
        }
    }
    names
}

/// Pushes what has another key than all before it.
fn push_new<T>(list: &mut Vec<T>, item: T, key: impl Fn(&T) -> String) {
    if list.iter().all(|known| key(known) != key(&item)) {
        list.push(item);
    }
}

impl Case {
    /// Takes over the operators and properties of another case on the same domain.
    fn join(&mut self, other: Case) {
        for choice in other.choices {
            push_new(&mut self.choices, choice, Choice::to_string);
        }
        for property in other.properties {
            push_new(&mut self.properties, property, |p| p.id.to_string());
        }
    }
}

impl Class {
    /// Whether the recipe and what is varied belong together.
    fn check(&self, template: &str) -> Result<(), String> {
        let mut rest = template.to_string();
        for (name, vary) in &self.vary {
            if vary.is_empty() {
                return Err(format!("draws '{name}' from an empty range"));
            }
            if !rest.contains(&placeholder(name)) {
                return Err(format!(
                    "varies '{name}', which its recipe does not name; write {{{name}}} where it belongs"
                ));
            }
            rest = rest.replace(&placeholder(name), "");
        }
        match rest.replace(&placeholder("seed"), "").split_once('{') {
            Some((_, at)) => Err(format!("does not vary what its recipe names at '{{{at}'")),
            None => Ok(()),
        }
    }
}

impl Vary {
    fn draw(&self, stream: &mut Stream) -> String {
        match self {
            // TOML has no whole number above i64::MAX: the difference plus one is in range.
            Vary::Whole { from, to } => (from + stream.below((to - from + 1) as usize) as u64).to_string(),
            Vary::Number { from, to } => {
                let digits = format!("{:.5e}", stream.between(*from, *to));
                digits.parse().unwrap_or(*from).clamp(*from, *to).to_string()
            }
            Vary::Choice(words) => words[stream.below(words.len())].clone(),
        }
    }

    fn is_empty(&self) -> bool {
        match self {
            Vary::Whole { from, to } => from > to,
            Vary::Number { from, to } => !(from.is_finite() && to.is_finite() && from <= to),
            Vary::Choice(words) => words.is_empty(),
        }
    }
}

fn placeholder(name: &str) -> String {
    format!("{{{name}}}")
}
