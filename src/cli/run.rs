//! `lapjury run`: a suite from plan to report.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::PathBuf;

use anyhow::Context;

use super::progress::Progress;
use super::{Common, Exit, Format, print, print_json, report};
use crate::record::{ClaimOutcome, Record, Writer};
use crate::suite::{self, Options, Suite};

/// Run a suite (default: primer) and write its record, tables and report
#[derive(clap::Args)]
#[command(after_help = "Example:\n  lapjury run smoke --threads 2 --out /tmp/smoke")]
pub(super) struct Run {
    /// A suite by id (see 'lapjury list suites') or a TOML file
    #[arg(default_value = "primer")]
    suite: String,
    /// A seed instead of the suite's own
    #[arg(long)]
    seed: Option<u64>,
    /// How many threads (default: all processors); the results do not depend on it
    #[arg(long)]
    threads: Option<usize>,
    /// Where record, tables and report are written
    #[arg(long, value_name = "DIR", default_value = "reports/latest")]
    out: PathBuf,
    /// How the result is printed
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Also write the charts and exhibits as PNG
    #[arg(long)]
    png: bool,
}

impl Default for Run {
    fn default() -> Self {
        Run {
            suite: "primer".into(),
            seed: None,
            threads: None,
            out: "reports/latest".into(),
            format: Format::Human,
            png: false,
        }
    }
}

impl Run {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let mut suite = Suite::named(&self.suite)?;
        suite.seed = self.seed.unwrap_or(suite.seed);
        let plan = suite.plan()?;
        // Only now, so that a mistake in a suite leaves the last record as it is.
        std::fs::create_dir_all(&self.out).with_context(|| format!("cannot make {}", self.out.display()))?;
        let path = self.out.join(report::RECORD);
        let options = Options { root: common.root.clone(), threads: self.threads, environment: environment() };
        let file = File::create(&path).with_context(|| format!("cannot write {}", path.display()))?;
        let mut writer = Writer::new(file);
        suite::run(&plan, &options, &mut Progress::new(common.quiet), &mut |line| writer.write(line))?;
        let footer = writer.finish()?;
        let record = Record::read(&path)?;
        report::write_files(&record, &self.out, self.png)?;
        match self.format {
            Format::Human => print(&report::text(&record))?,
            Format::Json => print_json(&footer)?,
        }
        common.say(format!("record and report in {}", self.out.join("index.html").display()));
        record.broken.iter().for_each(|b| common.say(format!("no domain from {}: {}", b.recipe, b.error)));
        Ok(exit_of(&record))
    }
}

/// How a run ends, by what is in its record.
fn exit_of(record: &Record) -> Exit {
    if record.claims.iter().any(|c| c.outcome == ClaimOutcome::Empty) {
        Exit::Nothing
    } else if record.unexpected() > 0 {
        Exit::Unexpected
    } else if !record.broken.is_empty() {
        Exit::Incomplete
    } else if record.cells.is_empty() && record.claims.is_empty() {
        Exit::Nothing
    } else {
        Exit::AsExpected
    }
}

/// Provenance for the header: never compared, no absolute paths.
fn environment() -> BTreeMap<String, String> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let processor = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|l| l.starts_with("model name"))?.split_once(':')?.1.trim().to_string();
        Some(line)
    });
    let mut environment = BTreeMap::from([
        ("command".to_string(), format!("lapjury {}", words.join(" ")).trim().to_string()),
        ("system".to_string(), format!("{} {}", std::env::consts::OS, std::env::consts::ARCH)),
    ]);
    environment.extend(processor.map(|p| ("processor".to_string(), p)));
    environment
}
