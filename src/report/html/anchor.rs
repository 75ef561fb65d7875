//! Anchors that stay the same from report to report: made of the ids themselves.

use std::collections::{BTreeMap, BTreeSet};

use crate::record::Index;

/// Anchors of operators, properties and claims.
pub struct Anchors {
    names: BTreeMap<String, String>,
    claims: BTreeMap<String, String>,
}

impl Anchors {
    /// Chooses the anchors; `more` are operators and properties that have no cell. Where two names become equal the later one
    /// gets a number.
    pub fn of<'a>(
        index: &Index<'a>,
        more: impl Iterator<Item = &'a str>,
        claims: impl Iterator<Item = &'a str>,
    ) -> Self {
        let names = distinct(index.laplacians.iter().chain(&index.properties).copied().chain(more), &[]);
        let taken: Vec<&str> = super::SECTIONS.iter().map(|s| s.0).chain(["unexpected"]).collect();
        Anchors { names, claims: distinct(claims, &taken) }
    }

    /// The exhibit of an operator and a property: `cotan:POS`.
    pub fn exhibit(&self, laplacian: &str, property: &str) -> String {
        format!("{}:{}", self.name(laplacian), self.name(property))
    }

    /// The row of the evidence table: `evidence:cotan:POS`.
    pub fn evidence(&self, laplacian: &str, property: &str) -> String {
        format!("evidence:{}", self.exhibit(laplacian, property))
    }

    /// The section of a claim: `c33`.
    pub fn claim(&self, id: &str) -> &str {
        self.claims.get(id).map_or("claims", String::as_str)
    }

    fn name(&self, label: &str) -> &str {
        self.names.get(label).map_or("unknown", String::as_str)
    }
}

fn distinct<'a>(labels: impl Iterator<Item = &'a str>, taken: &[&str]) -> BTreeMap<String, String> {
    let mut used: BTreeSet<String> = taken.iter().map(|t| t.to_string()).collect();
    let mut names = BTreeMap::new();
    for label in labels {
        if names.contains_key(label) {
            continue;
        }
        let plain: String =
            label.chars().map(|c| if c.is_ascii_alphanumeric() || "-.".contains(c) { c } else { '_' }).collect();
        let mut name = plain.clone();
        let mut number = 2;
        while !used.insert(name.clone()) {
            name = format!("{plain}_{number}");
            number += 1;
        }
        names.insert(label.to_string(), name);
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_become_equal_are_numbered() {
        let names = distinct(["a b", "a_b", "a(b", "a b"].into_iter(), &[]);
        assert_eq!(names["a b"], "a_b");
        assert_eq!(names["a_b"], "a_b_2");
        assert_eq!(names["a(b"], "a_b_3");
    }
}
