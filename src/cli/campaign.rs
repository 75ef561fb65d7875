//! `lapjury campaign`: correct operators on thousands of domains, in search of false alarms.

use super::jury::Jury;
use super::{Common, Exit};
use crate::campaign::alarms as search;
use crate::record::alarms::AlarmTally;
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
        Ok(exit(&found.sum(|_| true)))
    }
}

/// How a campaign ends that came to this.
fn exit(all: &AlarmTally) -> Exit {
    match (all.fails, all.undecided_healthy, all.total()) {
        (1.., _, _) => Exit::Unexpected,
        (0, 1.., _) => Exit::Incomplete,
        (0, 0, 0) => Exit::Nothing,
        _ => Exit::AsExpected,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_false_alarm_outweighs_what_is_undecided_and_nothing_is_not_success() {
        let tally = |holds, undecided_healthy, fails| AlarmTally {
            holds,
            undecided: undecided_healthy,
            undecided_healthy,
            fails,
            ..AlarmTally::default()
        };
        let ends = [(5, 0, 1), (5, 2, 1), (5, 2, 0), (0, 0, 0), (5, 0, 0)].map(|(h, u, f)| exit(&tally(h, u, f)));
        let expected = [Exit::Unexpected, Exit::Unexpected, Exit::Incomplete, Exit::Nothing, Exit::AsExpected];
        assert_eq!(ends, expected);
    }
}
