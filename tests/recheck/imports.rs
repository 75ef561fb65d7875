//! The recheck is independent: it uses no checker, no threshold of theirs and none of their factorisations.

use std::fs;
use std::path::Path;

/// The modules of `property` that it may use: what evidence says, and what a verdict is.
const CONTRACTS: &[&str] = &["evidence", "verdict"];

/// The modules of the crate that it may use, and of `linalg` nothing but the matrix.
const ALLOWED: &[&str] = &["domain", "linalg", "operator", "property", "scalar"];

#[test]
fn recheck_uses_no_checker() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/property/recheck");
    let mut own: Vec<String> = Vec::new();
    let mut files = Vec::new();
    for file in fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        own.push(path.file_stem().unwrap().to_str().unwrap().to_string());
        files.push(path);
    }
    assert!(files.len() > 10);
    for path in files {
        let text = fs::read_to_string(&path).unwrap();
        let is_root = path.ends_with("mod.rs");
        let code = text.lines().filter(|l| !l.trim_start().starts_with("//"));
        for (number, line) in code.enumerate() {
            let place = format!("{}, statement {number}: {line}", path.display());
            for module in after(line, "crate::") {
                assert!(ALLOWED.contains(&module.as_str()), "{place}");
            }
            for module in after(line, "property::") {
                assert!(CONTRACTS.contains(&module.as_str()), "{place}");
            }
            for module in after(line, "linalg::") {
                assert_eq!(module, "Csr", "{place}");
            }
            assert!(!line.contains("super::super"), "{place}");
            for module in after(line, "super::").iter().filter(|m| m.starts_with(char::is_lowercase)) {
                let known = if is_root { CONTRACTS.contains(&module.as_str()) } else { own.contains(module) };
                assert!(known || line.contains("pub(super)") || is_function(module), "{place}");
            }
        }
    }
}

/// The names that follow a prefix.
fn after(line: &str, prefix: &str) -> Vec<String> {
    let name = |s: &str| s.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    line.match_indices(prefix).map(|(at, _)| name(&line[at + prefix.len()..])).filter(|s| !s.is_empty()).collect()
}

/// Functions of the root of the folder.
fn is_function(name: &str) -> bool {
    ["check_threshold", "check_number"].contains(&name)
}
