//! The command line end to end: every verb, what it writes where, and how it ends.

mod catalogue;
mod check;
mod external;
mod jury;
mod recheck;
mod run;
mod writing;

use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin_cmd;

/// How a command ended and what it said.
struct Ran {
    code: i32,
    /// Standard output: results.
    out: String,
    /// Standard error: chatter and complaints.
    err: String,
}

impl Ran {
    /// Fails with everything that the command said unless it ended with this code.
    #[track_caller]
    fn ends_with(self, code: i32) -> Self {
        assert_eq!(self.code, code, "stdout:\n{}\nstderr:\n{}", self.out, self.err);
        self
    }

    fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.out).unwrap_or_else(|error| panic!("{error}: {}", self.out))
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The program, in the root of the project, without what the surroundings say about terminals.
fn command(arguments: &[&str]) -> Command {
    let mut command = cargo_bin_cmd!("lapjury");
    command.args(arguments).current_dir(root()).env_remove("NO_COLOR").env("COLUMNS", "110");
    command
}

fn lapjury(arguments: &[&str]) -> Ran {
    let Output { status, stdout, stderr } = command(arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Ran { code: status.code().expect("no signal"), out: text(stdout), err: text(stderr) }
}

/// A directory of its own for a test, removed at its end.
struct Scratch(tempfile::TempDir);

impl Scratch {
    fn new() -> Self {
        Scratch(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The path of a file as an argument.
    fn at(&self, name: &str) -> String {
        self.path(name).to_str().unwrap().to_string()
    }

    /// Writes a file and gives its path as an argument.
    fn file(&self, name: &str, text: &str) -> String {
        std::fs::write(self.path(name), text).unwrap();
        self.at(name)
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }
}

const VERBS: [&str; 12] = [
    "run", "check", "verify", "witness", "list", "explain", "generate", "export", "report", "recheck", "faults",
    "campaign",
];

#[test]
fn the_help_of_every_verb_has_an_example_of_it() {
    for verb in VERBS {
        let help = lapjury(&[verb, "--help"]).ends_with(0).out;
        let (_, examples) = help.split_once("Example").unwrap_or_else(|| panic!("{verb}: {help}"));
        assert!(examples.contains(&format!("\n  lapjury {verb} ")), "{verb}: {help}");
    }
    let help = lapjury(&["--help"]).ends_with(0).out;
    assert!(VERBS.iter().all(|verb| help.contains(&format!("\n  {verb} "))), "{help}");
    assert!(help.contains("Exit codes:") && help.contains("\n  lapjury check "), "{help}");
}

#[test]
fn what_cannot_be_understood_ends_with_2_and_advice() {
    for (arguments, advice) in [
        (&["chekc"][..], "unrecognized subcommand 'chekc'"),
        (&["list", "nonsense"], "possible values: laplacians, properties, claims, generators, experiments, suites"),
        (&["explain", "nonsense"], "'lapjury list' shows what there is"),
        (&["verify", "nonsense"], "'lapjury list claims' names those that there are"),
        (&["witness", "cotan", "nonsense"], "'lapjury list properties' names those that there are"),
        (&["witness", "nonsense", "POS"], "'lapjury list laplacians' names those that there are"),
        (&["run", "nonsense"], "'lapjury list suites' names those that there are"),
        (&["run", "nonsense.toml"], "suite nonsense.toml: No such file"),
        (&["report", "nonsense.jsonl"], "nonsense.jsonl: No such file"),
        (&["recheck", "nonsense.jsonl"], "nonsense.jsonl: No such file"),
        (&["generate", "nonsense"], "'lapjury list generators' names the generators"),
        (&["generate", "grid:nx=0"], "it must be a whole number from 1 to"),
        (&["export", "nonsense", "grid", "--out", "x"], "'lapjury list laplacians' names those that there are"),
        (&["check", "--domain", "grid"], "--laplacian"),
        (&["check", "--laplacian", "cotan"], "--mesh"),
    ] {
        let ran = lapjury(arguments).ends_with(2);
        assert!(ran.err.contains(advice), "{arguments:?}: {}", ran.err);
        assert_eq!(ran.out, "", "{arguments:?} has no result");
    }
}

#[test]
fn a_reader_that_goes_away_changes_nothing() {
    let mut child = std::process::Command::new(command(&[]).get_program())
        .args(["check", "--domain", "grid", "--laplacian", "mean-value", "--promises", "SYM"])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop((child.stdout.take(), child.stderr.take()));
    assert_eq!(child.wait().unwrap().code(), Some(1), "the promise is broken, whoever reads it");
}

#[test]
fn quiet_says_nothing_but_the_result_and_colours_are_for_terminals() {
    let check = ["check", "--mesh", "fixtures/meshes/oblong-shuffled.off", "--laplacian", "graph", "--property", "SYM"];
    assert!(lapjury(&check).ends_with(0).err.contains("faces were turned round"));
    let quiet = lapjury(&[&check[..], &["-q"]].concat()).ends_with(0);
    assert_eq!(quiet.err, "");
    assert!(quiet.out.contains("SYM          holds"));
    for no_colour in [true, false] {
        let mut command = command(&check);
        if no_colour {
            command.env("NO_COLOR", "1");
        }
        assert!(!command.output().unwrap().stdout.contains(&0x1b), "NO_COLOR: {no_colour}");
    }
}
