//! The arrows between modules, kept true: `crate::` paths are read off the source, test modules left out.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Which modules a module may use.
fn allowed() -> BTreeMap<&'static str, Vec<&'static str>> {
    let foundation = ["scalar", "stream", "parameter", "linalg", "domain", "operator"];
    let with = |more: &[&'static str]| foundation.iter().chain(more).copied().collect::<Vec<_>>();
    BTreeMap::from([
        ("catalogue", vec![]),
        ("scalar", vec![]),
        ("stream", vec![]),
        ("parameter", vec![]),
        ("figure", vec![]),
        ("linalg", vec!["scalar"]),
        ("domain", vec!["scalar"]),
        ("operator", vec!["linalg"]),
        ("generate", vec!["stream", "domain", "parameter"]),
        ("laplacian", vec!["scalar", "parameter", "linalg", "domain", "operator"]),
        ("property", vec!["scalar", "stream", "linalg", "domain", "operator"]),
        ("exchange", vec!["linalg", "domain"]),
        ("external", with(&["exchange", "property"])),
        ("fault", vec!["scalar", "stream", "linalg", "domain", "operator"]),
        ("campaign", vec!["stream", "domain", "operator", "property", "external", "record", "suite", "fault"]),
        ("experiment", with(&["figure", "generate", "laplacian", "property"])),
        ("record", vec!["figure", "domain", "property"]),
        ("suite", with(&["generate", "laplacian", "property", "exchange", "external", "experiment", "record"])),
        ("report", vec!["figure", "record", "property"]),
        (
            "cli",
            with(&[
                "generate",
                "laplacian",
                "property",
                "exchange",
                "external",
                "experiment",
                "record",
                "suite",
                "report",
                "fault",
                "campaign",
            ]),
        ),
    ])
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// The module that a path below `src` belongs to; `None` for the crate's root files.
fn module(path: &Path) -> Option<String> {
    let relative = path.strip_prefix(Path::new(env!("CARGO_MANIFEST_DIR")).join("src")).unwrap();
    let first = relative.components().next().unwrap().as_os_str().to_str().unwrap();
    let name = first.trim_end_matches(".rs");
    (name != "lib" && name != "main").then(|| name.to_string())
}

/// The modules that a source text names in `crate::` paths outside its test module and its comments.
fn used(text: &str) -> Vec<String> {
    let code = text.split("#[cfg(test)]").next().unwrap();
    let mut names = Vec::new();
    for line in code.lines().map(|l| l.split("//").next().unwrap()) {
        for rest in line.split("crate::").skip(1) {
            if let Some(list) = rest.strip_prefix('{') {
                let list = list.split('}').next().unwrap();
                names.extend(list.split(',').map(|n| n.trim().split("::").next().unwrap().to_string()));
            } else {
                names.push(rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect());
            }
        }
    }
    names.retain(|n| !n.is_empty() && n != "Scalar");
    names
}

#[test]
fn every_module_uses_only_what_the_architecture_allows() {
    let allowed = allowed();
    let mut files = Vec::new();
    sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut files);
    let mut wrong = Vec::new();
    for path in files {
        let Some(from) = module(&path) else { continue };
        let may = allowed.get(from.as_str()).unwrap_or_else(|| panic!("module '{from}' has no arrows in this test"));
        for to in used(&fs::read_to_string(&path).unwrap()) {
            if to != from && !may.contains(&to.as_str()) {
                wrong.push(format!("{} uses {to}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "arrows against the architecture:\n{}", wrong.join("\n"));
}

#[test]
fn properties_never_see_laplacians_and_recheck_never_sees_a_checker() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/property");
    let mut files = Vec::new();
    sources(&root, &mut files);
    for path in files {
        let text = fs::read_to_string(&path).unwrap();
        assert!(!used(&text).contains(&"laplacian".to_string()), "{} imports laplacian", path.display());
        if path.starts_with(root.join("recheck")) {
            let own = ["evidence", "verdict", "recheck"];
            for line in text.lines().filter(|l| l.contains("property::") && !l.trim_start().starts_with("//")) {
                let ok = own.iter().any(|o| line.contains(&format!("property::{o}"))) || line.contains("property::{");
                assert!(ok, "{}: {line}", path.display());
            }
        }
    }
}

#[test]
fn the_scan_sees_plain_and_braced_paths_and_skips_tests_and_comments() {
    let text = "use crate::domain::X;\nuse crate::{linalg::Csr, operator};\n// crate::cli\n#[cfg(test)] mod t { use crate::cli; }";
    assert_eq!(used(text), ["domain", "linalg", "operator"]);
}
