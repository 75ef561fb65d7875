//! A progress bar on a terminal; else a line every half minute.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::suite::Observer;

/// How often a run says where it is when nobody watches a terminal.
const INTERVAL: Duration = Duration::from_secs(30);

/// Shows how far a run is, on standard error.
pub(super) struct Progress {
    bar: Option<ProgressBar>,
    quiet: bool,
    total: usize,
    last: Instant,
}

impl Progress {
    pub(super) fn new(quiet: bool) -> Self {
        Progress { bar: None, quiet, total: 0, last: Instant::now() }
    }
}

impl Observer for Progress {
    fn planned(&mut self, cases: usize) {
        self.total = cases;
        if !self.quiet && std::io::stderr().is_terminal() {
            let style = ProgressStyle::with_template("{bar:40} {pos}/{len} domains, {eta} left {msg}");
            let bar = ProgressBar::new(cases as u64);
            self.bar = Some(style.map_or(bar.clone(), |style| bar.with_style(style)));
        }
    }

    fn decided(&mut self, done: usize) {
        if let Some(bar) = &self.bar {
            bar.set_position(done as u64);
        } else if !self.quiet && self.last.elapsed() >= INTERVAL {
            super::complain(format_args!("{done} of {} domains done", self.total));
            self.last = Instant::now();
        }
    }

    fn testing_claims(&mut self, claims: usize) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
        if !self.quiet && claims > 0 {
            super::complain(format_args!("testing {claims} claims"));
        }
    }
}
