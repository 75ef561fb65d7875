//! Lookups in a record by key.

use std::collections::{BTreeMap, BTreeSet};

use super::{Cell, ClaimLine, DomainLine, Exhibit, Record};

type ByPair<'a, T> = BTreeMap<&'a str, BTreeMap<&'a str, T>>;

/// A record by its keys. Lists keep the order of the record.
#[derive(Clone, Debug)]
pub struct Index<'a> {
    /// Labels of the operators, in order of first appearance.
    pub laplacians: Vec<&'a str>,
    /// Ids of the properties, in order of first appearance.
    pub properties: Vec<&'a str>,
    /// Classes of domains, in order of first appearance.
    pub classes: Vec<&'a str>,
    cells: ByPair<'a, Vec<&'a Cell>>,
    domains: BTreeMap<&'a str, &'a DomainLine>,
    claims: BTreeMap<&'a str, &'a ClaimLine>,
    exhibits: ByPair<'a, &'a Exhibit>,
}

impl<'a> Index<'a> {
    pub(super) fn of(record: &'a Record) -> Self {
        let mut cells: ByPair<Vec<&Cell>> = BTreeMap::new();
        for cell in &record.cells {
            cells.entry(&cell.laplacian).or_default().entry(&cell.property).or_default().push(cell);
        }
        let mut exhibits: ByPair<&Exhibit> = BTreeMap::new();
        for exhibit in &record.exhibits {
            exhibits.entry(&exhibit.laplacian).or_default().insert(&exhibit.property, exhibit);
        }
        let refused = record.operators.iter().map(|o| o.laplacian.as_str());
        Index {
            laplacians: distinct(record.cells.iter().map(|c| c.laplacian.as_str()).chain(refused)),
            properties: distinct(record.cells.iter().map(|c| c.property.as_str())),
            classes: distinct(record.domains.iter().map(|d| d.class.as_str())),
            cells,
            domains: record.domains.iter().map(|d| (d.recipe.as_str(), d)).collect(),
            claims: record.claims.iter().map(|c| (c.id.as_str(), c)).collect(),
            exhibits,
        }
    }

    /// The cells of an operator and a property.
    pub fn cells(&self, laplacian: &str, property: &str) -> &[&'a Cell] {
        self.cells.get(laplacian).and_then(|row| row.get(property)).map_or(&[], Vec::as_slice)
    }

    /// The domain that this recipe makes.
    pub fn domain(&self, recipe: &str) -> Option<&'a DomainLine> {
        self.domains.get(recipe).copied()
    }

    /// The claim with this id.
    pub fn claim(&self, id: &str) -> Option<&'a ClaimLine> {
        self.claims.get(id).copied()
    }

    /// The smallest failing case of an operator and a property.
    pub fn exhibit(&self, laplacian: &str, property: &str) -> Option<&'a Exhibit> {
        self.exhibits.get(laplacian)?.get(property).copied()
    }

    /// The cell that an exhibit shows.
    pub fn cell_of(&self, exhibit: &Exhibit) -> Option<&'a Cell> {
        let cells = self.cells(&exhibit.laplacian, &exhibit.property);
        cells.iter().copied().find(|c| c.recipe == exhibit.recipe)
    }
}

fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut seen = BTreeSet::new();
    names.filter(|name| seen.insert(*name)).collect()
}
