//! `lapjury recheck`: all evidence of a record, verified again without any checker.

use std::path::PathBuf;

use rayon::prelude::*;

use super::{Common, Exit, print};
use crate::property::{Evidence, Trial, find, recheck};
use crate::record::{Cell, Recheck as Answer, Record};
use crate::suite::{Choice, Recipe, cases};

/// Verify all evidence of a record again, independently of the checkers
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  lapjury recheck reports/latest/record.jsonl
  lapjury recheck reports/latest/record.jsonl --alone

Domains and operators are built again from their recipes, and excerpts compared bit for bit. With --alone, only what the
record itself carries is used. The command ends with 1 where evidence is refused, with 2 where the record was changed after
it was written.")]
pub(super) struct Recheck {
    /// The record
    #[arg(default_value = "reports/latest/record.jsonl")]
    record: PathBuf,
    /// Use nothing but the record: evidence that speaks of a whole matrix too large to carry is counted apart
    #[arg(long)]
    alone: bool,
}

/// How many pieces of evidence came to what.
#[derive(Default)]
struct Count {
    exact: usize,
    bounded: usize,
    open: usize,
    refused: Vec<String>,
}

impl Recheck {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let record = Record::read(&self.record)?;
        record.notices.iter().for_each(|notice| common.say(notice));
        let cells: Vec<&Cell> = record.cells.iter().filter(|c| c.verdict.evidence().is_some()).collect();
        let answers: Vec<(&Cell, Answer)> = if self.alone {
            cells.par_iter().map(|cell| (*cell, alone(cell.verdict.evidence()))).collect()
        } else {
            // Cells of the same domain and operator stand together in a record.
            let together = |a: &&Cell, b: &&Cell| a.recipe == b.recipe && a.laplacian == b.laplacian;
            let groups: Vec<&[&Cell]> = cells.chunk_by(together).collect();
            groups.par_iter().flat_map_iter(|group| again(group, common)).collect()
        };
        let mut count = Count::default();
        for (cell, answer) in answers {
            count.add(answer, || format!("{} {} on {}", cell.laplacian, cell.property, cell.recipe));
        }
        // The smallest counterexamples are listed in full in their recipes.
        for found in record.atlas.iter().filter_map(|line| line.found.as_deref()) {
            let cell = &found.cell;
            let evidence = cell.verdict.evidence();
            let answer = if self.alone { alone(evidence) } else { again(&[cell], common).remove(0).1 };
            count.add(answer, || format!("{} {} on {}", cell.laplacian, cell.property, cell.recipe));
        }
        // What an experiment built is gone: its evidence speaks for itself or not at all.
        for claim in &record.claims {
            for (test, evidence) in claim.tests.iter().flat_map(|t| t.evidence.iter().map(move |e| (t, e))) {
                count.add(alone(Some(evidence)), || format!("claim {}: {}", claim.id, test.question));
            }
        }
        print(&count.to_string())?;
        Ok(if !count.refused.is_empty() {
            Exit::Unexpected
        } else if count.exact + count.bounded + count.open == 0 {
            Exit::Nothing
        } else {
            Exit::AsExpected
        })
    }
}

impl Count {
    fn add(&mut self, answer: Answer, what: impl Fn() -> String) {
        match answer {
            Answer::Exact => self.exact += 1,
            Answer::Bounded => self.bounded += 1,
            Answer::Open(_) => self.open += 1,
            Answer::Refused(why) => self.refused.push(format!("{}: {why}", what())),
            Answer::Nothing => {}
        }
    }
}

impl std::fmt::Display for Count {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        writeln!(f, "verified exactly: {}", self.exact)?;
        writeln!(f, "verified within an error bound: {}", self.bounded)?;
        writeln!(f, "left open, being about more than is at hand or more than can be decided twice: {}", self.open)?;
        writeln!(f, "refused: {}", self.refused.len())?;
        self.refused.iter().try_for_each(|line| writeln!(f, "  {line}"))
    }
}

/// Verifies evidence by what it carries.
fn alone(evidence: Option<&Evidence>) -> Answer {
    cases::told(evidence.map(recheck::from_excerpt).transpose())
}

/// Builds domain and operator of a group again and verifies its evidence against them.
fn again<'a>(group: &[&'a Cell], common: &Common) -> Vec<(&'a Cell, Answer)> {
    let rebuilt = || -> anyhow::Result<_> {
        let domain = group[0].recipe.parse::<Recipe>()?.build(&common.root)?;
        let operator = group[0].laplacian.parse::<Choice>()?.build(&domain)?;
        Ok((domain, operator))
    };
    match rebuilt() {
        Err(error) => {
            group.iter().map(|c| (*c, Answer::Refused(format!("cannot be built again: {error:#}")))).collect()
        }
        Ok((domain, operator)) => {
            let trial = match Trial::new(&domain, &operator, cases::seed_of(&group[0].recipe)) {
                Ok(trial) => trial,
                Err(error) => return group.iter().map(|c| (*c, Answer::Refused(error.to_string()))).collect(),
            };
            let verify = |cell: &Cell| match find(&cell.property) {
                Some(property) => cases::recheck_verdict(&cell.verdict, property, &trial),
                None => Answer::Refused(format!("there is no property '{}'", cell.property)),
            };
            group.iter().map(|c| (*c, verify(c))).collect()
        }
    }
}
