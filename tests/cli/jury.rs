//! `faults` and `campaign`: the jury itself on trial.

use super::{Scratch, lapjury};

/// The last line of the text that a verb prints.
fn digest(out: &str) -> &str {
    out.lines().last().and_then(|line| line.strip_prefix("digest ")).unwrap_or_else(|| panic!("{out}"))
}

#[test]
fn a_small_campaign_finds_no_false_alarm_on_one_thread_and_on_two() {
    let run = |threads: &str, seed: &str| {
        lapjury(&["campaign", "--cases", "60", "--threads", threads, "--seed", seed]).ends_with(0).out
    };
    let one = run("1", "4");
    assert!(one.starts_with("60 domains of ") && one.contains("\n0 false alarms, "), "{one}");
    assert_eq!(digest(&one), digest(&run("2", "4")));
    assert_ne!(digest(&one), digest(&run("2", "5")));
}

#[test]
fn a_campaign_writes_a_page_and_tables_and_prints_an_object() {
    let scratch = Scratch::new();
    let ran = lapjury(&["campaign", "--cases", "20", "--out", &scratch.at("c"), "--format", "json"]).ends_with(0);
    assert!(ran.err.contains("campaign.html"), "{}", ran.err);
    assert_eq!(ran.json()["cases"], 20);
    assert!(scratch.read("c/campaign.html").contains("<!DOCTYPE html>"));
    let holds = |line: &str| line.split(',').any(|cell| cell == "cotan");
    assert!(scratch.read("c/tallies.csv").lines().skip(1).any(holds));
    assert_eq!(scratch.read("c/alarms.csv").lines().count(), 1, "a head and no alarm");
}

#[test]
fn a_campaign_without_a_case_decides_nothing() {
    let ran = lapjury(&["campaign", "--cases", "0"]).ends_with(4);
    assert!(ran.out.contains("0 verdicts on promised properties"), "{}", ran.out);
}

#[test]
fn the_faults_of_the_small_pool_are_all_seen_and_the_tables_say_by_whom() {
    let scratch = Scratch::new();
    let ran = lapjury(&["faults", "--out", &scratch.at("f")]).ends_with(0);
    assert!(ran.out.contains("144 faults on 48 meshes (small)") && !ran.out.contains(" missed"), "{}", ran.out);
    assert!(scratch.read("f/faults.html").contains("<!DOCTYPE html>"));
    let faults = scratch.read("f/faults.csv");
    assert!(faults.lines().count() == 145 && faults.contains("boundary-weights-doubled"), "{faults}");
    assert!(scratch.read("f/plantings.csv").lines().count() > 10_000);
    let whole: serde_json::Value = serde_json::from_str(&scratch.read("f/faults.json")).unwrap();
    assert_eq!(whole["size"], "small");
}

#[test]
fn what_no_pool_and_no_number_is_ends_with_2() {
    let pool = lapjury(&["faults", "--size", "huge"]).ends_with(2);
    assert!(pool.err.contains("possible values: small, full"), "{}", pool.err);
    let cases = lapjury(&["campaign", "--cases", "-3"]).ends_with(2);
    assert!(cases.err.contains("unexpected argument") || cases.err.contains("invalid"), "{}", cases.err);
}
