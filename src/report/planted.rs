//! The trial of faults as tables, as a page, and in a few lines: fault × class of meshes, caught by which property.

use std::collections::BTreeMap;

use super::csv::{Table, table};
use super::{File, RenderError, html};
use crate::record::planted::{Planted, PlantingLine, PlantingResult};

/// What became of a fault on a class of meshes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// How often each property was the first to catch it.
    pub caught: BTreeMap<String, usize>,
    /// Seen by the comparison only.
    pub compared: usize,
    /// In the band between rounding and a defect.
    pub undecided: usize,
    /// Changed by no more than rounding explains.
    pub rounding: usize,
    /// Beyond the band, and seen by nothing.
    pub missed: usize,
    /// Not changed, or not applicable.
    pub silent: usize,
}

impl Tally {
    /// Of some plantings.
    pub fn of<'a>(lines: impl Iterator<Item = &'a PlantingLine>) -> Self {
        let mut tally = Tally::default();
        for line in lines {
            match &line.result {
                PlantingResult::Caught { by, .. } => *tally.caught.entry(by.clone()).or_insert(0) += 1,
                PlantingResult::Compared { .. } => tally.compared += 1,
                PlantingResult::Undecided { .. } => tally.undecided += 1,
                PlantingResult::WithinRounding => tally.rounding += 1,
                PlantingResult::Missed { .. } => tally.missed += 1,
                PlantingResult::Unchanged | PlantingResult::NotHere(_) => tally.silent += 1,
            }
        }
        tally
    }

    /// How many were caught by a property.
    pub fn all_caught(&self) -> usize {
        self.caught.values().sum()
    }

    /// How many changed the operator at all.
    pub fn changed(&self) -> usize {
        self.all_caught() + self.compared + self.undecided + self.rounding + self.missed
    }
}

/// Every file: the confusion matrix, each planting, the faults, the data, the page.
///
/// # Errors
/// What a writer of tables refuses.
pub fn render(planted: &Planted) -> Result<Vec<File>, RenderError> {
    let file = |path: &str, bytes| File { path: path.into(), bytes };
    Ok(vec![
        file("confusion.csv", confusion(planted)?),
        file("plantings.csv", plantings(planted)?),
        file("faults.csv", faults(planted)?),
        file("faults.json", serde_json::to_vec(planted)?),
        file("faults.html", html::planted_page(planted)?.into_bytes()),
    ])
}

/// `confusion.csv`: a row for each fault and class of meshes.
pub fn confusion(planted: &Planted) -> Table {
    let head = [
        "fault",
        "kind",
        "meshes",
        "caught",
        "by",
        "comparison_only",
        "undecided",
        "within_rounding",
        "missed",
        "no_change",
    ];
    let classes = planted.classes();
    let pairs = planted.faults.iter().flat_map(|f| classes.iter().map(move |c| (f, *c)));
    table(
        head,
        pairs.map(|(fault, class)| {
            let of = |p: &&PlantingLine| p.fault == fault.id && p.class == class;
            let tally = Tally::of(planted.plantings.iter().filter(of));
            let by: Vec<String> = tally.caught.iter().map(|(id, n)| format!("{id} {n}")).collect();
            [
                fault.id.clone(),
                fault.class.clone(),
                class.to_string(),
                tally.all_caught().to_string(),
                by.join("; "),
                tally.compared.to_string(),
                tally.undecided.to_string(),
                tally.rounding.to_string(),
                tally.missed.to_string(),
                tally.silent.to_string(),
            ]
        }),
    )
}

/// `plantings.csv`: a row for each fault on each mesh.
pub fn plantings(planted: &Planted) -> Table {
    let head = ["fault", "mesh", "class", "operator", "mass_declared", "result", "by", "also"];
    table(
        head,
        planted.plantings.iter().map(|p| {
            let also = match &p.result {
                PlantingResult::Caught { also, .. } => also.join(" "),
                _ => String::new(),
            };
            [
                p.fault.clone(),
                p.mesh.clone(),
                p.class.clone(),
                p.operator.clone(),
                p.declared.to_string(),
                p.result.word().into(),
                p.result.by(),
                also,
            ]
        }),
    )
}

/// `faults.csv`: a row for each fault: what it does, what must see it, where nothing but the comparison can.
pub fn faults(planted: &Planted) -> Table {
    let head = ["fault", "kind", "what", "caught_by", "comparison_only"];
    table(
        head,
        planted
            .faults
            .iter()
            .map(|f| [f.id.clone(), f.class.clone(), f.what.clone(), f.caught_by.join(" "), f.blind.join("; ")]),
    )
}

/// What a terminal shows: the counts, and every miss.
///
/// # Errors
/// What JSON cannot say (nothing in this schema).
pub fn text(planted: &Planted) -> Result<String, RenderError> {
    let counts: Vec<String> = planted.counts().iter().map(|(word, n)| format!("{n} {word}")).collect();
    let mut text = format!(
        "{} faults on {} meshes ({}), {} plantings: {}\n",
        planted.faults.len(),
        planted.meshes.len(),
        planted.size,
        planted.plantings.len(),
        counts.join(", ")
    );
    let all = Tally::of(planted.plantings.iter());
    let by: Vec<String> = all.caught.iter().map(|(id, n)| format!("{id} {n}")).collect();
    text += &format!("caught first by: {}\n", by.join(", "));
    for p in planted.missed() {
        text += &format!("missed: {} on {} ({}, {}): {:?}\n", p.fault, p.mesh, p.operator, declared(p), p.result);
    }
    Ok(text + &format!("digest {}\n", planted.digest()?))
}

fn declared(p: &PlantingLine) -> &'static str {
    if p.declared { "mass declared" } else { "mass not declared" }
}
