//! What the verbs that put the jury itself on trial have in common.

use std::path::PathBuf;

use super::{Common, Format, print, print_json, report};
use crate::campaign::Options;
use crate::report::File;

/// How a campaign is run, and where its result goes.
#[derive(clap::Args)]
pub(super) struct Jury {
    /// The seed of whatever is drawn
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// How many threads (default: all processors); the results do not depend on it
    #[arg(long)]
    threads: Option<usize>,
    /// Where tables and page are written
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// How the result is printed
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

impl Jury {
    pub(super) fn options(&self, common: &Common) -> Options {
        Options { root: common.root.clone(), threads: self.threads, seed: self.seed }
    }

    /// Writes the files, of which `page` is the one to open, if they are wanted, and prints the result.
    pub(super) fn deliver<E: std::error::Error + Send + Sync + 'static>(
        &self,
        common: &Common,
        found: &impl serde::Serialize,
        text: impl FnOnce() -> Result<String, E>,
        (page, files): (&str, impl FnOnce() -> Result<Vec<File>, E>),
    ) -> anyhow::Result<()> {
        if let Some(out) = &self.out {
            report::write_all(files()?, out)?;
            common.say(format!("tables and page in {}", out.join(page).display()));
        }
        match self.format {
            Format::Human => print(&text()?),
            Format::Json => print_json(found),
        }
    }
}
