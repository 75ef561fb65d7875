//! `lapjury list`: the catalogue, a line an entry.

use super::{Exit, print};
use crate::suite::claims;
use crate::{experiment, generate, laplacian, property, suite};

/// List the catalogue
#[derive(clap::Args)]
#[command(after_help = "Example:\n  lapjury list properties")]
pub(super) struct List {
    /// What to list
    #[arg(value_enum)]
    what: What,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum What {
    Laplacians,
    Properties,
    Claims,
    Generators,
    Experiments,
    Suites,
}

impl List {
    pub(super) fn execute(&self) -> anyhow::Result<Exit> {
        let rows: Vec<(String, String)> = match self.what {
            What::Laplacians => laplacian::ALL.iter().map(|l| row(l.id, l.definition)).collect(),
            What::Properties => property::ALL.iter().map(|p| row(p.id, p.statement)).collect(),
            What::Generators => generate::ALL.iter().map(|g| row(g.id, g.name)).collect(),
            What::Experiments => experiment::ALL.iter().map(|e| row(e.id, e.name)).collect(),
            What::Claims => claims::all()?.into_iter().map(|c| (c.id, c.statement)).collect(),
            What::Suites => suite::schema::BUILT_IN
                .iter()
                .map(|(id, _)| Ok((id.to_string(), suite::Suite::built_in(id)?.title)))
                .collect::<anyhow::Result<_>>()?,
        };
        let width = rows.iter().map(|(id, _)| id.chars().count()).max().unwrap_or(0);
        let lines: Vec<String> = rows.iter().map(|(id, what)| format!("{id:<width$}  {what}")).collect();
        print(&lines.join("\n"))?;
        Ok(Exit::AsExpected)
    }
}

fn row(id: &str, what: &str) -> (String, String) {
    (id.to_string(), what.to_string())
}
