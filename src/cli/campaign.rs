//! `lapjury campaign`: correct operators on thousands of domains, in search of false alarms.

use std::path::PathBuf;

use super::{Common, Exit, Format, print, print_json, report};
use crate::campaign::{Options, alarms as search};
use crate::report::alarms;

/// Judge correct operators on thousands of generated domains, in search of false alarms
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  lapjury campaign --cases 100000 --seed 7 --out reports/campaign

Ends with 1 at a false alarm (a promised property that fails), and with 3 if a promised property is undecided although no angle
is below one degree.")]
pub(super) struct Campaign {
    /// How many domains
    #[arg(long, default_value_t = 5000)]
    cases: usize,
    /// The seed
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

impl Campaign {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let options = Options { root: common.root.clone(), threads: self.threads, seed: self.seed };
        let found = search::run(self.cases, &options)?;
        if let Some(out) = &self.out {
            report::write_all(alarms::render(&found)?, out)?;
            common.say(format!("tables and page in {}", out.join("campaign.html").display()));
        }
        match self.format {
            Format::Human => print(&alarms::text(&found)?)?,
            Format::Json => print_json(&found)?,
        }
        let all = found.sum(|_| true);
        Ok(match (all.fails, all.undecided_healthy, all.total()) {
            (1.., _, _) => Exit::Unexpected,
            (0, 1.., _) => Exit::Incomplete,
            (0, 0, 0) => Exit::Nothing,
            _ => Exit::AsExpected,
        })
    }
}
