//! Every malformed file of `fixtures/broken` is refused with exactly the message that `messages.txt` has for it.
//!
//! After a message has changed on purpose, write the list anew with `UPDATE_MESSAGES=1 cargo test --test broken_files`, and
//! read the difference: a message must tell what was expected, where, and what to do.

use std::fs;
use std::path::{Path, PathBuf};

use lapjury::exchange::{ReadError, read_domain, read_matrix};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/broken")
}

/// The malformed files, by name.
fn names() -> Vec<String> {
    let entries = fs::read_dir(folder()).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.retain(|name| name != "messages.txt");
    names.sort();
    names
}

/// Names that begin with "mtx" are read as matrices, all others as domains.
fn refusal(name: &str) -> ReadError {
    let path = folder().join(name);
    let refused = if name.starts_with("mtx") { read_matrix(&path).map(drop) } else { read_domain(&path).map(drop) };
    refused.expect_err(name)
}

/// The message without the folder, as it stands in the list; it begins with the name of the file.
fn message(name: &str) -> String {
    let text = refusal(name).to_string();
    let prefix = format!("{}{}", folder().display(), std::path::MAIN_SEPARATOR);
    text.strip_prefix(&prefix).unwrap_or_else(|| panic!("'{text}' does not begin with the file")).to_string()
}

#[test]
fn every_broken_file_is_refused_with_the_message_of_the_list() {
    let list = folder().join("messages.txt");
    let found: Vec<String> = names().iter().map(|name| message(name)).collect();
    if std::env::var_os("UPDATE_MESSAGES").is_some() {
        fs::write(&list, found.join("\n") + "\n").unwrap();
    }
    let text = fs::read_to_string(&list).unwrap();
    let listed: Vec<&str> = text.lines().collect();
    let unlisted: Vec<_> = found.iter().filter(|m| !listed.contains(&m.as_str())).collect();
    let unfound: Vec<_> = listed.iter().filter(|&&m| !found.iter().any(|f| f == m)).collect();
    assert!(
        unlisted.is_empty() && unfound.is_empty(),
        "not in the list: {unlisted:#?}\nonly in the list: {unfound:#?}"
    );
    assert_eq!(found, listed, "one line a file, sorted by file");
}

#[test]
fn every_message_gives_a_place_and_advice() {
    for name in names() {
        let message = message(&name);
        let rest = message.strip_prefix(name.as_str()).unwrap_or_else(|| panic!("{message}"));
        assert!(rest.starts_with([':', ',']), "{message}");
        assert!(!message.contains('\n') && message.contains([';', ',']), "one line, with advice: {message}");
    }
}

#[test]
fn every_format_has_broken_files() {
    for (prefix, least) in
        [("off", 20), ("obj", 10), ("ply", 15), ("stl", 8), ("xyz", 5), ("medit", 8), ("mtx", 20), ("graph", 5)]
    {
        let count = names().iter().filter(|n| n.starts_with(prefix)).count();
        assert!(count >= least, "{count} files for {prefix}");
    }
}
