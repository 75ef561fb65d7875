//! The command line: one verb a file. Results go to standard output, chatter to standard error.

mod campaign;
mod check;
mod explain;
mod export;
mod faults;
mod generate;
mod jury;
mod list;
mod progress;
mod recheck;
mod report;
mod run;
mod verify;
mod witness;

use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context;
use clap::{Parser, Subcommand};

use crate::domain::Domain;
use crate::exchange;

/// How a command ends. These numbers are a contract: see the README.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Exit {
    /// Everything came out as expected. An expected failure is expected.
    AsExpected = 0,
    /// A verdict contradicts a promise, a claim came out otherwise, evidence was refused.
    Unexpected = 1,
    /// The command or its input cannot be understood.
    Usage = 2,
    /// The result is incomplete: a domain could not be made, or rounding leaves open what was promised on the command line.
    Incomplete = 3,
    /// Nothing was decided: no cell was selected, a claim or a promise tested nothing, no counterexample is known.
    Nothing = 4,
}

const AFTER_HELP: &str = "\
Exit codes:
  0  as expected          1  unexpected verdict or claim    2  usage or unreadable input
  3  incomplete           4  nothing decided

Examples:
  lapjury                                             run the primer suite, write reports/latest/
  lapjury check --mesh bunny.off --laplacian cotan    judge a built-in operator on a mesh
  lapjury check --mesh bunny.off --stiffness L.mtx    judge a matrix that your library wrote
  lapjury witness cotan POS                           the smallest known counterexample";

/// Every discrete Laplacian gets a fair trial; none gets a free lunch.
#[derive(Parser)]
#[command(name = "lapjury", version, about, after_help = AFTER_HELP, max_term_width = 110)]
struct Arguments {
    #[command(subcommand)]
    verb: Option<Verb>,
    #[command(flatten)]
    common: Common,
}

/// What every verb understands.
#[derive(clap::Args)]
struct Common {
    /// Say less on standard error
    #[arg(short, long, global = true)]
    quiet: bool,
    /// The directory that mesh files in recipes are relative to
    #[arg(long, global = true, value_name = "DIR", default_value = ".")]
    root: PathBuf,
}

#[derive(Subcommand)]
enum Verb {
    /// Run a suite (default: primer) and write its record, tables and report
    Run(run::Run),
    /// Judge one operator on one domain: built in, or a matrix from a file
    Check(check::Check),
    /// Test one claim of the literature
    Verify(verify::Verify),
    /// Print the smallest known domain on which an operator fails a property
    Witness(witness::Witness),
    /// List the catalogue
    List(list::List),
    /// Explain an entry of the catalogue: definition, parameters, promises, source
    Explain(explain::Explain),
    /// Write a generated domain to a mesh file
    Generate(generate::Generate),
    /// Write a built-in operator as Matrix Market files
    Export(export::Export),
    /// Make the tables and the report of a record again
    Report(report::Report),
    /// Verify all evidence of a record again, independently of the checkers
    Recheck(recheck::Recheck),
    /// Plant every known fault on every mesh of a pool: who catches it?
    Faults(faults::Faults),
    /// Judge correct operators on thousands of generated domains, in search of false alarms
    Campaign(campaign::Campaign),
}

/// Runs the program.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let verb = arguments.verb.unwrap_or_else(|| Verb::Run(run::Run::default()));
    let common = &arguments.common;
    let result = match verb {
        Verb::Run(verb) => verb.execute(common),
        Verb::Check(verb) => verb.execute(common),
        Verb::Verify(verb) => verb.execute(common),
        Verb::Witness(verb) => verb.execute(common),
        Verb::List(verb) => verb.execute(),
        Verb::Explain(verb) => verb.execute(),
        Verb::Generate(verb) => verb.execute(common),
        Verb::Export(verb) => verb.execute(common),
        Verb::Report(verb) => verb.execute(common),
        Verb::Recheck(verb) => verb.execute(common),
        Verb::Faults(verb) => verb.execute(common),
        Verb::Campaign(verb) => verb.execute(common),
    };
    match result {
        Ok(exit) => ExitCode::from(exit as u8),
        Err(error) => {
            complain(format_args!("lapjury: {error:#}"));
            let nothing = matches!(error.downcast_ref(), Some(crate::suite::SuiteError::Empty { .. }));
            ExitCode::from(if nothing { Exit::Nothing } else { Exit::Usage } as u8)
        }
    }
}

/// Writes a result to standard output. A reader that goes away, as `head` does, changes nothing in how the command ends.
fn print(text: &str) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    let end = if text.ends_with('\n') { "" } else { "\n" };
    match out.write_all(text.as_bytes()).and_then(|()| out.write_all(end.as_bytes())).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(()),
    }
}

/// Says something on standard error, and goes on if nobody listens.
fn complain(text: impl std::fmt::Display) {
    let _ = writeln!(io::stderr(), "{text}");
}

/// Writes a value to standard output as JSON.
fn print_json(value: &impl serde::Serialize) -> anyhow::Result<()> {
    print(&serde_json::to_string_pretty(value)?)
}

impl Common {
    /// Writes a file and says so.
    fn write(&self, path: &Path, text: &str) -> anyhow::Result<()> {
        std::fs::write(path, text).with_context(|| format!("cannot write {}", path.display()))?;
        self.say(path.display());
        Ok(())
    }

    /// Writes a domain in a format, and says what has no place in it.
    fn write_domain(&self, path: &Path, domain: &Domain, format: exchange::Format) -> anyhow::Result<()> {
        self.write(path, &exchange::write_domain(domain, format)?)?;
        self.say_what_is_lost(domain);
        Ok(())
    }

    /// A Matrix Market file has no place for the boundary of a graph.
    fn say_what_is_lost(&self, domain: &Domain) {
        if let (Domain::Graph(_), n @ 1..) = (domain, domain.facts().boundary_vertices) {
            self.say(format_args!("the file does not say which {n} vertices are boundary; a recipe does"));
        }
    }

    /// Says something on standard error, unless asked to be quiet.
    fn say(&self, text: impl std::fmt::Display) {
        if !self.quiet {
            complain(text);
        }
    }
}

/// Whether standard output shows colours.
fn colour() -> bool {
    crate::report::text::wants_colour(io::stdout().is_terminal(), std::env::var_os("NO_COLOR").as_deref())
}

/// The width of the terminal, or of a page where there is none.
fn terminal_width() -> usize {
    let told = std::env::var("COLUMNS").ok().and_then(|text| text.parse().ok());
    told.unwrap_or(110)
}

/// How a result is printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// For people
    #[default]
    Human,
    /// One JSON object
    Json,
}
