//! `lapjury verify`: one claim of the literature.

use std::collections::BTreeMap;

use super::progress::Progress;
use super::{Common, Exit, Format, print, print_json};
use crate::experiment::Effort;
use crate::record::{ClaimLine, ClaimOutcome, Line};
use crate::suite::{self, Options, Suite};

/// Test one claim of the literature
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  lapjury verify c36
  lapjury verify t01 --format json

A claim that asks the cells of a suite runs as much of that suite first.")]
pub(super) struct Verify {
    /// The claim's id (see 'lapjury list claims')
    claim: String,
    /// The suite whose cells are asked: an id or a TOML file
    #[arg(long, default_value = "primer")]
    suite: String,
    /// A seed instead of the suite's own
    #[arg(long)]
    seed: Option<u64>,
    /// How many random cases the experiments take, instead of what the suite says
    #[arg(long, value_enum)]
    effort: Option<Effort>,
    /// How the result is printed
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

impl Verify {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let mut suite = Suite::named(&self.suite)?;
        suite.seed = self.seed.unwrap_or(suite.seed);
        suite.effort = self.effort.unwrap_or(suite.effort);
        suite.claims = vec![self.claim.clone()];
        let mut plan = suite.plan()?;
        plan.narrow();
        let options = Options { root: common.root.clone(), threads: None, environment: BTreeMap::new() };
        let (mut found, mut broken) = (None, 0);
        suite::run(&plan, &options, &mut Progress::new(common.quiet), &mut |line| {
            match line {
                Line::Claim(claim) => found = Some(claim.clone()),
                Line::Broken(line) => {
                    broken += 1;
                    common.say(format!("no domain from {}: {}", line.recipe, line.error));
                }
                _ => {}
            }
            Ok(())
        })?;
        let Some(claim) = found else { return Ok(Exit::Nothing) };
        match self.format {
            Format::Human => print(&human(&claim))?,
            Format::Json => print_json(&claim)?,
        }
        Ok(match claim.outcome {
            ClaimOutcome::Empty => Exit::Nothing,
            outcome if outcome != claim.expected => Exit::Unexpected,
            _ if broken > 0 => Exit::Incomplete,
            _ => Exit::AsExpected,
        })
    }
}

fn human(claim: &ClaimLine) -> String {
    let mut text = format!("{}  {}\n     ({})\n\n", claim.id, claim.statement, claim.source);
    for test in &claim.tests {
        let mark = match (test.decided, test.agrees) {
            (0, _) => "open",
            (_, true) => "agrees",
            (_, false) => "disagrees",
        };
        text += &format!("  {} form: {}\n    {mark} ({}): {}\n", test.form, test.question, test.level, test.finding);
        for evidence in &test.evidence {
            text += &format!("    evidence: {}\n", crate::report::statement(evidence));
        }
    }
    text += &format!("\noutcome: {}", claim.outcome);
    if claim.outcome != claim.expected {
        text += &format!("  (expected: {})", claim.expected);
    }
    if let Some(amendment) = &claim.amendment {
        text += &format!("\namended: {amendment}");
    }
    text + "\n"
}
