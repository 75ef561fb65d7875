//! `lapjury witness`: the smallest domain on which an operator fails a property.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use serde::Serialize;

use super::{Common, Exit, Format, print, print_json};
use crate::domain::Domain;
use crate::exchange;
use crate::property;
use crate::record::{AtlasLine, Cell, Exhibit, Recheck};
use crate::suite::witness::{self, Search};
use crate::suite::{Choice, Recipe};

/// Print the smallest domain on which an operator fails a property
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  lapjury witness cotan POS
  lapjury witness mean-value SYM --out witness/

Every triangulation of every set of up to 6 points in a box of 4 × 4 lattice points is tried first (5 points for properties that
compare operators of related domains): the first counterexample there is provably the smallest, fewest vertices first, then the
smaller box, then in lexicographic order. Where none fails, families of small domains are tried in the order of their size, and
what fails is shrunk while it does: small, not provably smallest.")]
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

/// A counterexample, wherever it was found.
struct Shown<'a> {
    cell: &'a Cell,
    exhibit: &'a Exhibit,
    domain: Domain,
}

/// The answer as JSON.
#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct Answer<'a> {
    laplacian: String,
    property: &'static str,
    /// What the exhaustive search came to; none for an operator that does not live on surfaces.
    exhaustive: Option<&'a AtlasLine>,
    /// What the families came to, where the exhaustive search found nothing.
    families: Option<Families<'a>>,
}

#[derive(Serialize)]
struct Families<'a> {
    decided: usize,
    open: usize,
    skipped: usize,
    cell: Option<&'a Cell>,
    exhibit: Option<&'a Exhibit>,
    shrunk_from: Option<&'a str>,
}

impl Witness {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let choice: Choice = self.laplacian.parse()?;
        let Some(property) = property::find(&self.property) else {
            bail!("there is no property '{}'; 'lapjury list properties' names those that there are", self.property);
        };
        let line = witness::smallest(&choice, property);
        let proved = line.as_ref().and_then(|l| l.found.as_deref());
        let search = if proved.is_none() { Some(witness::search(&choice, property)) } else { None };
        let family = search.as_ref().and_then(|s| s.found.as_ref());
        let shown = match (proved, family) {
            (Some(found), _) => Some(Shown {
                cell: &found.cell,
                exhibit: &found.exhibit,
                domain: found.cell.recipe.parse::<Recipe>()?.build(&common.root)?,
            }),
            (None, Some(found)) => {
                Some(Shown { cell: &found.cell, exhibit: &found.exhibit, domain: found.domain.clone() })
            }
            (None, None) => None,
        };
        match self.format {
            Format::Json => print_json(&Answer {
                laplacian: choice.to_string(),
                property: property.id,
                exhaustive: line.as_ref(),
                families: search.as_ref().map(families),
            })?,
            Format::Human => print(&human(&choice.to_string(), property.id, line.as_ref(), search.as_ref(), &shown))?,
        }
        let Some(shown) = shown else { return Ok(Exit::Nothing) };
        if let Some(dir) = &self.out {
            write(common, dir, &shown)?;
        }
        // Evidence that the recheck refuses is a bug of ours, and no counterexample.
        let refused = matches!(shown.cell.recheck, Recheck::Refused(_));
        Ok(if refused { Exit::Unexpected } else { Exit::AsExpected })
    }
}

fn families(search: &Search) -> Families<'_> {
    let found = search.found.as_ref();
    Families {
        decided: search.decided,
        open: search.open,
        skipped: search.skipped,
        cell: found.map(|f| &f.cell),
        exhibit: found.map(|f| &f.exhibit),
        shrunk_from: found.and_then(|f| f.from.as_deref()),
    }
}

fn write(common: &Common, dir: &Path, shown: &Shown) -> anyhow::Result<()> {
    std::fs::create_dir_all(dir).with_context(|| format!("cannot make {}", dir.display()))?;
    let stem = format!("{}-{}", shown.cell.laplacian, shown.cell.property).replace([':', '=', ','], "-");
    let path = |extension: &str| dir.join(format!("{stem}.{extension}"));
    if let Some(svg) = crate::report::exhibit_svg(shown.exhibit, Some(shown.cell)) {
        common.write(&path("svg"), &svg)?;
    }
    common.write(&path("json"), &serde_json::to_string_pretty(shown.cell)?)?;
    let format = exchange::native_format(&shown.domain);
    common.write_domain(&path(format.extension()), &shown.domain, format)
}

fn human(
    laplacian: &str,
    property: &str,
    line: Option<&AtlasLine>,
    search: Option<&Search>,
    shown: &Option<Shown>,
) -> String {
    let nowhere = |line: &AtlasLine| {
        format!(
            "{laplacian} fails {property} on none of {} ({} of them: {} decided, {}, {} left open, {} not applicable, {} refused)\n",
            line.world,
            line.size,
            line.decided,
            line.level.map_or("no level".into(), |level| level.to_string()),
            line.open,
            line.silent,
            line.refused
        )
    };
    let mut text = match (line, search) {
        (Some(line), None) => crate::report::smallest(line) + "\n",
        (Some(line), Some(_)) => nowhere(line),
        (None, _) => String::new(),
    };
    if let Some(search) = search {
        text += &match &search.found {
            Some(found) => format!(
                "{laplacian} fails {property} on {} ({} vertices), number {} of the domains of small families on which it was decided{}\n",
                found.cell.recipe,
                found.domain.vertex_count(),
                search.decided,
                found.from.as_ref().map_or(String::new(), |from| format!("; shrunk from {from}")),
            ),
            None => format!(
                "no counterexample: {property} was decided on {} domains of small families and failed on none ({} left open, {} not \
                 applicable)",
                search.decided, search.open, search.skipped
            ),
        };
    }
    if let Some(shown) = shown {
        text += &mesh(shown);
    }
    text
}

/// The mesh and what is wrong with it.
fn mesh(shown: &Shown) -> String {
    let cell = shown.cell;
    let mut text = format!("  {} ({})\n", crate::report::sentence(&cell.verdict), cell.verdict.level);
    for (i, p) in shown.domain.positions().unwrap_or_default().iter().enumerate() {
        text += &format!("  vertex {i}: {} {} {}\n", p[0], p[1], p[2]);
    }
    for (f, face) in shown.domain.as_surface().into_iter().flat_map(|s| s.faces()).enumerate() {
        let corners: Vec<String> = face.iter().map(ToString::to_string).collect();
        text += &format!("  face {f}: {}\n", corners.join(" "));
    }
    text + &format!("  recheck: {}\n  replay: {}\n", crate::report::csv::recheck(&cell.recheck), cell.replay)
}
