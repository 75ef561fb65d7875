//! `lapjury faults`: every planted fault on every mesh of a pool.

use super::jury::Jury;
use super::{Common, Exit};
use crate::campaign::faults;
use crate::campaign::pool::Size;
use crate::record::Planted;
use crate::report::planted;

/// Plant every known fault on every mesh of a pool: who catches it?
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  lapjury faults --size full --out reports/faults

Ends with 1 if a fault is missed: an entry changed beyond what rounding explains, and nothing that must see it does.")]
pub(super) struct Faults {
    /// Which meshes
    #[arg(long, value_enum, default_value_t)]
    size: Size,
    #[command(flatten)]
    jury: Jury,
}

impl Faults {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let found: Planted = faults::run(self.size, &self.jury.options(common))?;
        let files = ("faults.html", || planted::render(&found));
        self.jury.deliver(common, &found, || planted::text(&found), files)?;
        Ok(if found.missed().next().is_some() { Exit::Unexpected } else { Exit::AsExpected })
    }
}
