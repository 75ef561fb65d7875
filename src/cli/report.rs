//! `lapjury report`: tables and page of a record, made again without any mathematics.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::Context;

use super::{Common, Exit, colour, print, terminal_width};
use crate::record::Record;
use crate::report::text::Style;
use crate::report::{File, Options, exhibit_png, plot};
use crate::{laplacian, property};

/// The record's file name in an output directory.
pub(super) const RECORD: &str = "record.jsonl";

/// The sources of everything in the catalogue, for the page.
const BIBLIOGRAPHY: &str = include_str!("../../references.bib");

/// Where the meshes come from and under which licence, for the page.
const MESH_LICENCES: &str = include_str!("../../fixtures/meshes/LICENSES.md");

/// Make the tables and the report of a record again
#[derive(clap::Args)]
#[command(after_help = "Example:\n  lapjury report reports/latest/record.jsonl --out reports/again --png")]
pub(super) struct Report {
    /// The record
    #[arg(default_value = "reports/latest/record.jsonl")]
    record: PathBuf,
    /// Where to write (default: beside the record)
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Also write the charts and exhibits as PNG
    #[arg(long)]
    png: bool,
}

impl Report {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let record = Record::read(&self.record)?;
        let beside = self.record.parent().map_or_else(PathBuf::new, Path::to_path_buf);
        let out = self.out.clone().unwrap_or(beside);
        write_files(&record, &out, self.png)?;
        print(&text(&record))?;
        common.say(format!("report in {}", out.join("index.html").display()));
        Ok(Exit::AsExpected)
    }
}

/// What a terminal shows of a record.
pub(super) fn text(record: &Record) -> String {
    crate::report::text::text(record, Style { colour: colour(), width: terminal_width() })
}

/// Writes every file of the report.
pub(super) fn write_files(record: &Record, out: &Path, png: bool) -> anyhow::Result<()> {
    let options = Options { bibliography: BIBLIOGRAPHY.into(), licences: MESH_LICENCES.into(), names: names() };
    let mut files = crate::report::render(record, &options)?;
    if png {
        files.extend(pictures(record)?);
    }
    write_all(files, out)
}

/// Writes files below a directory.
pub(super) fn write_all(files: Vec<File>, out: &Path) -> anyhow::Result<()> {
    for file in files {
        let path = out.join(&file.path);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent).with_context(|| format!("cannot make {}", parent.display()))?;
        }
        std::fs::write(&path, &file.bytes).with_context(|| format!("cannot write {}", path.display()))?;
    }
    Ok(())
}

/// Short names of properties and operators, for the page.
fn names() -> BTreeMap<String, String> {
    let laplacians = laplacian::ALL.iter().map(|l| (l.id.to_string(), l.name.to_string()));
    let properties = property::ALL.iter().map(|p| (p.id.to_string(), p.name.to_string()));
    laplacians.chain(properties).collect()
}

/// Every chart and exhibit as PNG.
fn pictures(record: &Record) -> anyhow::Result<Vec<File>> {
    let mut files = Vec::new();
    for chart in plot::charts(record) {
        files.push(File { path: format!("png/{}.png", chart.id), bytes: chart.png()? });
    }
    let index = record.index();
    for exhibit in &record.exhibits {
        if let Some(bytes) = exhibit_png(exhibit, index.cell_of(exhibit), 2)? {
            let stem = format!("{}-{}", exhibit.laplacian, exhibit.property).replace([':', '=', ','], "-");
            files.push(File { path: format!("png/{stem}.png"), bytes });
        }
    }
    Ok(files)
}
