//! What holds the catalogues together: every file with an entry is registered, every source is in the bibliography, and the
//! promises that the docs of a Laplacian make are the promises that its entry makes.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use lapjury::laplacian::{Laplacian, Promised};
use lapjury::suite::claims;
use lapjury::{experiment, generate, laplacian, property};

fn source(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(folder)
}

/// The names of the files of a folder that declare an entry, without their extension.
fn files_with_an_entry(folder: &str) -> BTreeSet<String> {
    let files = fs::read_dir(source(folder)).unwrap().map(|entry| entry.unwrap().path());
    let entries = files.filter(|path| {
        path.extension().is_some_and(|e| e == "rs") && fs::read_to_string(path).unwrap().contains("pub static ENTRY")
    });
    entries.map(|path| path.file_stem().unwrap().to_string_lossy().into_owned()).collect()
}

/// The file that an id belongs to: the id in lower snake case.
fn file_of(id: &str) -> String {
    id.to_lowercase().replace('-', "_")
}

fn check_registration(folder: &str, ids: &[&str]) {
    let registered: BTreeSet<String> = ids.iter().map(|id| file_of(id)).collect();
    assert_eq!(registered.len(), ids.len(), "two entries of {folder} share an id");
    let files = files_with_an_entry(folder);
    let forgotten: Vec<_> = files.difference(&registered).collect();
    let strangers: Vec<_> = registered.difference(&files).collect();
    assert!(
        forgotten.is_empty(),
        "src/{folder}: {forgotten:?} declare an ENTRY that the catalogue of mod.rs does not name (or whose id differs)"
    );
    assert!(strangers.is_empty(), "src/{folder}: the catalogue names {strangers:?}, which are the ids of no file");
}

#[test]
fn every_laplacian_is_registered_under_the_name_of_its_file() {
    check_registration("laplacian", &laplacian::ALL.iter().map(|l| l.id).collect::<Vec<_>>());
}

#[test]
fn every_property_is_registered_under_the_name_of_its_file() {
    check_registration("property", &property::ALL.iter().map(|p| p.id).collect::<Vec<_>>());
}

#[test]
fn every_experiment_is_registered_under_the_name_of_its_file() {
    check_registration("experiment", &experiment::ALL.iter().map(|e| e.id).collect::<Vec<_>>());
}

#[test]
fn every_generator_is_registered_under_the_name_of_its_file() {
    check_registration("generate", &generate::ALL.iter().map(|g| g.id).collect::<Vec<_>>());
}

/// The keys of the bibliography.
fn bibliography() -> BTreeSet<String> {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("references.bib")).unwrap();
    let entries = text.lines().filter(|line| line.starts_with('@'));
    let keys: Vec<String> =
        entries.map(|line| line.split(['{', ',']).nth(1).unwrap_or_default().trim().to_string()).collect();
    let unique: BTreeSet<String> = keys.iter().cloned().collect();
    assert_eq!(unique.len(), keys.len(), "a key occurs twice in references.bib");
    unique
}

#[test]
fn every_source_is_in_the_bibliography() {
    let known = bibliography();
    let laplacians = laplacian::ALL.iter().map(|l| (l.id, l.sources));
    let properties = property::ALL.iter().map(|p| (p.id, p.sources));
    let generators = generate::ALL.iter().map(|g| (g.id, g.sources));
    let experiments = experiment::ALL.iter().map(|e| (e.id, e.sources));
    for (id, sources) in laplacians.chain(properties).chain(generators).chain(experiments) {
        for key in sources {
            assert!(known.contains(*key), "'{id}' names the source {key}, which references.bib does not have");
        }
    }
    for claim in claims::all().unwrap() {
        let key = claim.source;
        assert!(
            known.contains(&key),
            "claim '{}' names the source {key}, which references.bib does not have",
            claim.id
        );
    }
}

#[test]
fn every_key_in_the_docs_of_a_laplacian_is_one_of_its_sources() {
    for entry in laplacian::ALL {
        let docs = docs(entry);
        for key in docs.split("\\[").skip(1).filter_map(|rest| rest.split("\\]").next()) {
            assert!(entry.sources.contains(&key), "the docs of '{}' cite {key}, its sources do not", entry.id);
        }
        for key in entry.sources {
            assert!(docs.contains(key), "'{}' has the source {key}, its docs do not say for what", entry.id);
        }
    }
}

/// The module docs of an entry.
fn docs(entry: &Laplacian) -> String {
    let text = fs::read_to_string(source("laplacian").join(file_of(entry.id)).with_extension("rs")).unwrap();
    let lines = text.lines().map_while(|line| line.strip_prefix("//!"));
    lines.map(|line| line.strip_prefix(' ').unwrap_or(line)).collect::<Vec<_>>().join("\n")
}

/// The section of some docs under a heading.
fn section<'a>(docs: &'a str, heading: &str) -> &'a str {
    let start = docs.find(&format!("# {heading}\n")).unwrap_or_else(|| panic!("no section '{heading}'"));
    let body = &docs[start + heading.len() + 3..];
    &body[..body.find("\n# ").unwrap_or(body.len())]
}

/// Whether a word has the form of the id of a property: capitals and digits, then perhaps a suffix in small letters.
fn is_id(word: &str) -> bool {
    let (head, tail) = word.split_once('-').unwrap_or((word, ""));
    head.len() >= 3
        && head.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit())
        && tail.chars().all(|c| c.is_ascii_lowercase())
}

/// The ids that the items of a section are about: in `* A, B: text. C: text.` they are A, B and C.
fn ids(section: &str) -> BTreeSet<String> {
    let text = section.replace('\n', " ");
    let mut found = BTreeSet::new();
    for claim in text.split([':', '*']) {
        // What stands before a colon: the ids since the last sentence.
        let list = claim.rsplit(". ").next().unwrap_or_default();
        let words: Vec<&str> = list.split(", ").map(str::trim).collect();
        if words.iter().all(|word| is_id(word)) {
            found.extend(words.into_iter().map(str::to_string));
        }
    }
    found
}

fn promised(entry: &Laplacian, outcome: Promised) -> BTreeSet<String> {
    entry.promises.iter().filter(|p| p.outcome == outcome).map(|p| p.property.to_string()).collect()
}

#[test]
fn the_guarantees_in_the_docs_are_the_promises_of_the_entry() {
    for entry in laplacian::ALL {
        let docs = docs(entry);
        let holds = ids(section(&docs, "Guarantees"));
        assert_eq!(holds, promised(entry, Promised::Holds), "Guarantees of '{}' (docs, then entry)", entry.id);
        let fails = ids(section(&docs, "Does not hold"));
        assert_eq!(fails, promised(entry, Promised::FailsSomewhere), "Does not hold of '{}'", entry.id);
    }
}

#[test]
fn the_docs_of_a_laplacian_have_every_section() {
    let headings = [
        "Definition",
        "Shapes and units",
        "Convention",
        "Guarantees",
        "Does not hold",
        "Boundary",
        "Degenerate input",
        "Cost and accuracy",
        "References",
        "Example",
    ];
    for entry in laplacian::ALL {
        let docs = docs(entry);
        let places: Vec<usize> = headings.iter().map(|h| docs.find(section(&docs, h)).unwrap()).collect();
        assert!(places.is_sorted(), "the sections of '{}' are out of order", entry.id);
        assert!(section(&docs, "Example").contains("assert"), "the example of '{}' asserts nothing", entry.id);
    }
}

#[test]
fn nothing_is_promised_always_that_fails_somewhere() {
    for entry in laplacian::ALL {
        let fails = promised(entry, Promised::FailsSomewhere);
        for promise in entry.promises.iter().filter(|p| p.outcome == Promised::Holds) {
            let always = promise.given.is_empty() && promise.when.is_empty();
            assert!(!always || !fails.contains(promise.property), "'{}' on {}", entry.id, promise.property);
        }
    }
}

#[test]
fn an_id_is_told_from_a_word() {
    for id in ["LOC", "POS0", "POS-boundary", "MAX-global"] {
        assert!(is_id(id));
    }
    for word in ["L", "ID", "always", "Exception", "POS0 of", "CON-λ", ""] {
        assert!(!is_id(word), "{word}");
    }
    let text = "* FIN, LOC: always. KER: sometimes\n  and here. PSD: with *Exception*: not.\n* POS: x";
    assert_eq!(ids(text).into_iter().collect::<Vec<_>>(), ["FIN", "KER", "LOC", "POS", "PSD"]);
}
