//! `lapjury faults`: every planted fault on every mesh of a pool.

use std::path::PathBuf;

use super::{Common, Exit, Format, print, print_json, report};
use crate::campaign::pool::Size;
use crate::campaign::{Options, faults};
use crate::record::Planted;
use crate::report::planted;

/// Plant every known fault on every mesh of a pool: who catches it?
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  lapjury faults --size full --out reports/faults

Ends with 1 if a fault is missed: an entry changed beyond what rounding explains, and nothing that must see it does.")]
pub(super) struct Faults {
    /// Which meshes
    #[arg(long, value_enum, default_value_t)]
    size: Size,
    /// The seed of what the faults draw
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

impl Faults {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let options = Options { root: common.root.clone(), threads: self.threads, seed: self.seed };
        let found: Planted = faults::run(self.size, &options)?;
        if let Some(out) = &self.out {
            report::write_all(planted::render(&found)?, out)?;
            common.say(format!("tables and page in {}", out.join("faults.html").display()));
        }
        match self.format {
            Format::Human => print(&planted::text(&found)?)?,
            Format::Json => print_json(&found)?,
        }
        Ok(if found.missed().next().is_some() { Exit::Unexpected } else { Exit::AsExpected })
    }
}
