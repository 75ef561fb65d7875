//! `lapjury check --shrink`: a small mesh on which the same property fails.

use std::path::Path;

use anyhow::Context;

use super::{Common, Decided};
use crate::domain::Domain;
use crate::exchange;
use crate::property::Status;
use crate::suite::{Choice, cases, witness};

/// Shrinks the domain while the first failing property fails, writes the mesh and says how to judge it alone.
pub(super) fn write(
    common: &Common,
    dir: &Path,
    choice: &Choice,
    source: &str,
    domain: &Domain,
    decided: &[Decided],
) -> anyhow::Result<()> {
    let Some(failing) = decided.iter().find(|d| d.verdict.status() == Status::Fails) else {
        common.say("nothing fails, so there is nothing to shrink");
        return Ok(());
    };
    let id = failing.property.id;
    // A file's path is a recipe as well; a name that is none has been read already.
    let Some(cell) = cases::cell(choice, failing.property, domain, source) else {
        common.say(format_args!("{id} does not shrink: '{source}' is no recipe"));
        return Ok(());
    };
    let small = witness::smaller(choice, failing.property, domain.clone(), cell);
    if small.from.is_none() {
        common.say(format_args!("{id} fails, and no step makes the domain smaller"));
        return Ok(());
    }
    std::fs::create_dir_all(dir).with_context(|| format!("cannot make {}", dir.display()))?;
    let stem = format!("{choice}-{id}").replace([':', '=', ','], "-");
    let format = exchange::native_format(&small.domain);
    common.write_domain(&dir.join(format!("{stem}.{}", format.extension())), &small.domain, format)?;
    let (before, after) = (domain.vertex_count(), small.domain.vertex_count());
    common.say(format_args!("{id} still fails on {after} vertices instead of {before}: {}", small.cell.replay));
    Ok(())
}
