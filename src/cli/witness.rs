//! `lapjury witness`: the smallest known domain on which an operator fails a property.

use std::path::PathBuf;

use anyhow::{Context, bail};

use super::{Common, Exit, Format, print, print_json};
use crate::exchange;
use crate::property;
use crate::record::Recheck;
use crate::suite::Choice;
use crate::suite::witness::{self, Found};

/// Print the smallest known domain on which an operator fails a property
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  lapjury witness cotan POS
  lapjury witness mean-value SYM --out witness/

The search goes through families of small domains in the order of their size; 'smallest known' means the first that fails.")]
pub(super) struct Witness {
    /// The operator, with settings as in three-point:p=2
    laplacian: String,
    /// The property
    property: String,
    /// Write mesh and picture there
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// How the result is printed
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

impl Witness {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let choice: Choice = self.laplacian.parse()?;
        let Some(property) = property::find(&self.property) else {
            bail!("there is no property '{}'; 'lapjury list properties' names those that there are", self.property);
        };
        let search = witness::search(&choice, property);
        let Some(found) = search.found else {
            print(&format!(
                "no counterexample: {} was decided on {} small domains and failed on none ({} left open, {} not applicable)",
                property.id, search.decided, search.open, search.skipped
            ))?;
            return Ok(Exit::Nothing);
        };
        match self.format {
            Format::Json => print_json(&found.cell)?,
            Format::Human => print(&human(&found, search.decided))?,
        }
        if let Some(dir) = &self.out {
            self.write(common, dir, &found)?;
        }
        // Evidence that the recheck refuses is a bug of ours, and no counterexample.
        let refused = matches!(found.cell.recheck, Recheck::Refused(_));
        Ok(if refused { Exit::Unexpected } else { Exit::AsExpected })
    }

    fn write(&self, common: &Common, dir: &std::path::Path, found: &Found) -> anyhow::Result<()> {
        std::fs::create_dir_all(dir).with_context(|| format!("cannot make {}", dir.display()))?;
        let stem = format!("{}-{}", found.cell.laplacian, found.cell.property).replace([':', '=', ','], "-");
        let path = |extension: &str| dir.join(format!("{stem}.{extension}"));
        if let Some(svg) = crate::report::exhibit_svg(&found.exhibit, Some(&found.cell)) {
            common.write(&path("svg"), &svg)?;
        }
        common.write(&path("json"), &serde_json::to_string_pretty(&found.cell)?)?;
        let format = exchange::native_format(&found.domain);
        common.write_domain(&path(format.extension()), &found.domain, format)
    }
}

fn human(found: &Found, decided: usize) -> String {
    let cell = &found.cell;
    let mut text = format!(
        "{} fails {} on {} ({} vertices), number {decided} of the domains on which it was decided, smallest first\n",
        cell.laplacian,
        cell.property,
        cell.recipe,
        found.domain.vertex_count()
    );
    text += &format!("  {}\n", crate::report::sentence(&cell.verdict));
    if let Some(positions) = found.domain.positions() {
        for (i, p) in positions.iter().enumerate() {
            text += &format!("  vertex {i}: {} {} {}\n", p[0], p[1], p[2]);
        }
    }
    for (f, face) in found.domain.as_surface().into_iter().flat_map(|s| s.faces()).enumerate() {
        let corners: Vec<String> = face.iter().map(ToString::to_string).collect();
        text += &format!("  face {f}: {}\n", corners.join(" "));
    }
    text + &format!("  recheck: {}\n  replay: {}\n", crate::report::csv::recheck(&cell.recheck), cell.replay)
}
