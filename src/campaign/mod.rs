//! The jury itself on trial: does it catch what is wrong, and does it leave alone what is right?
//!
//! [`faults`] plants every [`fault`](crate::fault) on every mesh of a [`pool`] and records who catches it;
//! [`alarms`] builds correct operators on thousands of domains drawn by [`draw`] and records every promised
//! property that does not hold. Both are parallel over domains, keep their order, and give the same digest on any number of
//! threads; their results ([`record::planted`](crate::record::planted), [`record::alarms`](crate::record::alarms)) are
//! plain data for a report.

pub mod alarms;
pub mod draw;
pub mod faults;
pub mod pool;

use std::path::PathBuf;

use rayon::ThreadPool;

/// How a campaign is run.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The directory that mesh files are relative to.
    pub root: PathBuf,
    /// How many threads; all processors if absent. The results do not depend on it.
    pub threads: Option<usize>,
    /// The seed of whatever is drawn.
    pub seed: u64,
}

/// Why a campaign came to no end.
#[derive(Debug, thiserror::Error)]
pub enum CampaignError {
    /// A domain of the pool could not be made.
    #[error("{name}: {error}")]
    Domain {
        /// The recipe or name.
        name: String,
        /// What went wrong.
        error: String,
    },
    /// The threads could not be started.
    #[error("{0} threads could not be started; ask for fewer")]
    Threads(usize),
}

impl Options {
    fn pool(&self) -> Result<ThreadPool, CampaignError> {
        let threads = self.threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|_| CampaignError::Threads(threads))
    }
}
