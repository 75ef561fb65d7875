//! `run`, `report`, and the replay commands of what a run found.

use lapjury::property::Status;
use lapjury::record::Record;

use crate::{Scratch, command, lapjury};

/// A suite in which operators fail what nobody promised of them.
pub const TINY: &str = "
id = 'tiny'
title = 'a few small domains'
seed = 3
effort = 'smoke'
laplacians = ['graph', 'cotan', 'mean-value', 'three-point:p=0.5']
properties = ['FIN', 'LOC', 'SYM', 'POS0', 'PSD', 'LIN', 'MAX-global', 'SCALE']
claims = ['c81']
[[class]]
id = 'flipped'
recipe = 'random-delaunay:n={n},seed={seed} | flip:count=6,seed={seed}'
count = 2
vary = { n = { from = 12, to = 16 } }
[[class]]
id = 'weighted'
recipe = 'gnp:n=8,p=0.5,boundary=3,seed={seed} | random-weights:negative=0.3,seed={seed}'
laplacians = ['weighted-graph']
";

/// The files of a report below a directory, by name, but for what says how long it took and where.
fn files(scratch: &Scratch, folder: &str) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    let mut folders = vec![scratch.path(folder)];
    while let Some(at) = folders.pop() {
        for entry in std::fs::read_dir(at).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(scratch.path(folder)).unwrap().to_str().unwrap().to_string();
                found.push((name, std::fs::read(path).unwrap()));
            }
        }
    }
    found.sort();
    found
}

#[test]
fn a_run_writes_record_tables_and_page_and_report_makes_the_same_again() {
    let scratch = Scratch::new();
    let (suite, out) = (scratch.file("tiny.toml", TINY), scratch.at("out"));
    let ran = lapjury(&["run", &suite, "--out", &out]).ends_with(0);
    assert!(ran.out.starts_with("suite tiny · seed 3 · 3 domains"), "{}", ran.out);
    assert!(ran.err.contains("index.html"), "{}", ran.err);
    let first = files(&scratch, "out");
    let names: Vec<&str> = first.iter().map(|(name, _)| name.as_str()).collect();
    for name in [
        "record.jsonl",
        "index.html",
        "summary.md",
        "junit.xml",
        "taxonomy.csv",
        "taxonomy.json",
        "claims.csv",
        "tests.csv",
        "domains.csv",
        "cells.csv",
    ] {
        assert!(names.contains(&name), "{name} of {names:?}");
    }
    let again =
        lapjury(&["report", &scratch.at("out/record.jsonl"), "--out", &scratch.at("again"), "--png"]).ends_with(0);
    assert_eq!(again.out, ran.out);
    let mut second = files(&scratch, "again");
    assert!(second.iter().any(|(name, bytes)| name.starts_with("png/") && bytes.starts_with(b"\x89PNG")));
    second.retain(|(name, _)| !name.starts_with("png/"));
    let without_record: Vec<_> = first.iter().filter(|(name, _)| name != "record.jsonl").cloned().collect();
    assert_eq!(second, without_record);
    lapjury(&["report", &scratch.at("out/record.jsonl")]).ends_with(0);
    assert_eq!(files(&scratch, "out"), first, "beside the record, byte for byte");
}

#[test]
fn the_footer_is_the_json_answer_and_does_not_depend_on_the_number_of_threads() {
    let scratch = Scratch::new();
    let suite = scratch.file("tiny.toml", TINY);
    let run = |more: &[&str]| {
        let out = scratch.at("out");
        lapjury(&[&["run", &suite, "--out", &out, "--format", "json", "-q"], more].concat()).ends_with(0)
    };
    let [one, two, other] = [&["--threads", "1"][..], &["--threads", "2"], &["--seed", "4"]].map(run);
    assert_eq!((one.json(), one.err.as_str()), (two.json(), ""));
    assert_eq!((&one.json()["unexpected"], &one.json()["broken"]), (&0.into(), &0.into()));
    assert_ne!(one.json()["results_digest"], other.json()["results_digest"]);
}

#[test]
fn the_replay_command_of_a_failing_cell_finds_the_same_verdict() {
    let scratch = Scratch::new();
    let suite = scratch.file("tiny.toml", TINY);
    lapjury(&["run", &suite, "--out", &scratch.at("out")]).ends_with(0);
    let record = Record::read(&scratch.path("out/record.jsonl")).unwrap();
    let failing: Vec<_> = record.cells.iter().filter(|c| c.verdict.status() == Status::Fails).collect();
    // One of each operator and property, so that the cells are of many kinds.
    let mut seen = std::collections::BTreeSet::new();
    let chosen: Vec<_> = failing.into_iter().filter(|c| seen.insert((&c.laplacian, &c.property))).collect();
    assert!(chosen.len() >= 5, "{seen:?}");
    for cell in chosen {
        let words = words(&cell.replay);
        assert_eq!(words[0], "lapjury");
        let arguments: Vec<&str> = words[1..].iter().map(String::as_str).chain(["--format", "json"]).collect();
        let answer = lapjury(&arguments).ends_with(0).json();
        let [verdict] = answer["verdicts"].as_array().unwrap().as_slice() else { panic!("{answer}") };
        assert_eq!((verdict["property"].as_str(), &verdict["status"]), (Some(cell.property.as_str()), &"fails".into()));
        assert_eq!(
            verdict["witness"],
            serde_json::to_value(cell.verdict.evidence().unwrap()).unwrap(),
            "{}",
            cell.replay
        );
    }
}

/// The words of a command as a shell splits it; there are no quotes but single ones.
fn words(command: &str) -> Vec<String> {
    let (mut words, mut word, mut quoted) = (Vec::new(), String::new(), false);
    for c in command.chars() {
        match c {
            '\'' => quoted = !quoted,
            ' ' if !quoted => words.push(std::mem::take(&mut word)),
            c => word.push(c),
        }
    }
    assert!(!quoted, "{command}");
    words.push(word);
    words
}

/// Runs the text as a suite; what it leaves behind is in "out".
fn run(scratch: &Scratch, text: &str) -> crate::Ran {
    let suite = scratch.file("suite.toml", text);
    lapjury(&["run", &suite, "--out", &scratch.at("out")])
}

const HEAD: &str = "id = 'bare'\ntitle = 'bare'\nseed = 1\neffort = 'smoke'\nproperties = ['SYM']\n";

#[test]
fn a_domain_that_a_generator_refuses_leaves_the_run_incomplete() {
    let scratch = Scratch::new();
    let classes = "[[class]]\nid = 'folded'\nrecipe = 'schonhardt:twist=2'\n[[class]]\nid = 'grid'\nrecipe = 'grid'\n";
    let ran = run(&scratch, &format!("{HEAD}laplacians = ['cotan']\n{classes}")).ends_with(3);
    assert!(ran.err.contains("no domain from schonhardt:twist=2: 'schonhardt' cannot do this"), "{}", ran.err);
    let record = Record::read(&scratch.path("out/record.jsonl")).unwrap();
    assert_eq!((record.broken.len(), record.cells.len()), (1, 1));
    assert_eq!(record.footer.unwrap().broken, 1);
}

#[test]
fn a_mistake_in_a_suite_ends_with_2_and_leaves_the_last_record_alone() {
    let scratch = Scratch::new();
    run(&scratch, &format!("{HEAD}[[class]]\nid = 'grid'\nrecipe = 'grid:nx=2,ny=2'\n")).ends_with(0);
    let before = scratch.read("out/record.jsonl");
    for (line, message) in [
        ("colour = 'red'", "unknown field `colour`"),
        ("laplacians = ['cotangent']", "there is no operator 'cotangent'; 'lapjury list laplacians'"),
        ("claims = ['c999']", "there is no claim 'c999'; 'lapjury list claims'"),
        ("[[class]]\nid = 'grid'\nrecipe = 'gird'", "'gird' is neither a generator nor a mesh file"),
    ] {
        let ran = run(&scratch, &format!("{HEAD}{line}\n")).ends_with(2);
        assert!(ran.err.contains(message), "{}", ran.err);
        assert_eq!(scratch.read("out/record.jsonl"), before, "{line}");
    }
}

#[test]
fn where_nothing_is_decided_a_run_ends_with_4() {
    let scratch = Scratch::new();
    let grid = "[[class]]\nid = 'grid'\nrecipe = 'grid:nx=2,ny=2'\n";
    for (text, why) in [
        (format!("{HEAD}claims = ['c77']\nlaplacians = ['cotan']\n{grid}"), "the claim asks another operator"),
        (
            format!("{HEAD}laplacians = ['cotan']\n[[class]]\nid = 'path'\nrecipe = 'path:n=5'\n"),
            "no surface for cotan",
        ),
        (HEAD.to_string(), "no domain and no claim"),
        (format!("{HEAD}laplacians = []\n{grid}"), "no operator"),
    ] {
        assert_eq!(run(&scratch, &text).code, 4, "{why}");
    }
}

#[test]
fn the_root_is_where_the_paths_of_a_suite_begin() {
    let scratch = Scratch::new();
    let text = format!("{HEAD}[[class]]\nid = 'file'\nfiles = ['mesh.off']\n");
    run(&scratch, &text).ends_with(3);
    lapjury(&["generate", "grid", "--out", &scratch.at("mesh.off")]).ends_with(0);
    let suite = scratch.at("suite.toml");
    lapjury(&["run", &suite, "--out", &scratch.at("out"), "--root", &scratch.at("")]).ends_with(0);
    // As seen from there, with the output beside it.
    command(&["run", "suite.toml", "--out", "here"]).current_dir(scratch.path("")).assert().code(0);
    assert!(scratch.path("here/index.html").exists());
}
