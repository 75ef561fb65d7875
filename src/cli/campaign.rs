//! `lapjury campaign`: correct operators on thousands of domains, in search of false alarms.

use super::jury::Jury;
use super::{Common, Exit};
use crate::campaign::alarms as search;
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
    #[command(flatten)]
    jury: Jury,
}

impl Campaign {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let found = search::run(self.cases, &self.jury.options(common))?;
        let files = ("campaign.html", || alarms::render(&found));
        self.jury.deliver(common, &found, || alarms::text(&found), files)?;
        let all = found.sum(|_| true);
        Ok(match (all.fails, all.undecided_healthy, all.total()) {
            (1.., _, _) => Exit::Unexpected,
            (0, 1.., _) => Exit::Incomplete,
            (0, 0, 0) => Exit::Nothing,
            _ => Exit::AsExpected,
        })
    }
}
