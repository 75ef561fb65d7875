//! `lapjury explain`: everything the catalogue knows of an entry.

use anyhow::bail;

use super::{Exit, print};
use crate::experiment::{self, Experiment};
use crate::generate::{self, Generator};
use crate::laplacian::{self, Laplacian, Promised, When};
use crate::parameter::Parameter;
use crate::property::{self, Property};
use crate::suite::claims::{self, Claim};

/// Explain an entry of the catalogue: definition, parameters, promises, source
#[derive(clap::Args)]
#[command(after_help = "Example:\n  lapjury explain MAX-global")]
pub(super) struct Explain {
    /// The id of a Laplacian, property, generator, experiment or claim
    id: String,
}

impl Explain {
    pub(super) fn execute(&self) -> anyhow::Result<Exit> {
        let id = self.id.as_str();
        let mut texts = Vec::new();
        texts.extend(laplacian::find(id).map(of_laplacian));
        texts.extend(property::find(id).map(of_property));
        texts.extend(generate::find(id).map(of_generator));
        texts.extend(experiment::find(id).map(of_experiment));
        texts.extend(claims::all()?.iter().find(|c| c.id == id).map(of_claim));
        if texts.is_empty() {
            bail!("nothing in the catalogue is called '{id}'; 'lapjury list' shows what there is");
        }
        print(&texts.join("\n"))?;
        Ok(Exit::AsExpected)
    }
}

fn of_laplacian(l: &Laplacian) -> String {
    let kinds: Vec<String> = l.accepts.iter().map(ToString::to_string).collect();
    let mut text = format!("{}: {}\n  {}\n  defined on: {}\n", l.id, l.name, l.definition, kinds.join(", "));
    text += &parameters(l.parameters);
    for promise in l.promises {
        let given: Vec<&str> = promise.given.iter().map(|f| f.name()).collect();
        let given = if given.is_empty() { String::new() } else { format!(" on a domain that is {}", given.join(", ")) };
        let when: Vec<String> = promise.when.iter().map(condition).collect();
        let when = if when.is_empty() { String::new() } else { format!(", with {}", when.join(" and ")) };
        text += &match promise.outcome {
            Promised::Holds => format!("  promise: {} holds{given}{when}\n", promise.property),
            Promised::FailsSomewhere if promise.property == laplacian::CONVERGENCE => {
                format!("  promise: {} fails on some sequence of meshes{when}: lapjury verify t01\n", promise.property)
            }
            Promised::FailsSomewhere => format!(
                "  promise: {} fails on some domain: lapjury witness {} {}\n",
                promise.property, l.id, promise.property
            ),
        };
    }
    text + &sources(l.sources)
}

/// A condition on a parameter, in words.
fn condition(when: &When) -> String {
    match *when {
        When::Is(name, words) => format!("{name}={}", words.join(" or ")),
        When::Between(name, low, high) if low == high => format!("{name}={low}"),
        When::Between(name, low, high) => format!("{name} from {low} to {high}"),
    }
}

fn of_property(p: &Property) -> String {
    format!("{}: {}\n  {}\n{}", p.id, p.name, p.statement, sources(p.sources))
}

fn of_generator(g: &Generator) -> String {
    let mut text = format!("{}: {}\n{}", g.id, g.name, parameters(g.parameters));
    for guarantee in g.guarantees {
        text += &format!("  guarantee: {guarantee}\n");
    }
    text + &sources(g.sources)
}

fn of_experiment(e: &Experiment) -> String {
    format!("{}: {}\n  {}\n  parts: {}\n{}", e.id, e.name, e.statement, e.parts.join(", "), sources(e.sources))
}

fn of_claim(c: &Claim) -> String {
    let mut text = format!(
        "{}: {}\n  stated in: {}, section {}\n  expected: {}\n",
        c.id, c.statement, c.source, c.section, c.expected
    );
    if let Some(amendment) = &c.amendment {
        text += &format!("  amended form: {amendment}\n");
    }
    text + &format!("  test it: lapjury verify {}\n", c.id)
}

fn parameters(list: &[Parameter]) -> String {
    list.iter()
        .map(|p| format!("  parameter {} (default {}): {}; {}\n", p.name, p.default, p.meaning, p.range))
        .collect()
}

fn sources(keys: &[&str]) -> String {
    if keys.is_empty() { String::new() } else { format!("  sources: {}\n", keys.join(", ")) }
}
