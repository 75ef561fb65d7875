//! `recheck`: evidence that holds, and records in which something was changed.

use lapjury::property::Outcome;
use lapjury::record::Record;

use crate::run::TINY;
use crate::{Scratch, lapjury};

/// A scratch directory with a fresh record of the tiny suite.
fn fresh() -> Scratch {
    let scratch = Scratch::new();
    let suite = scratch.file("tiny.toml", TINY);
    lapjury(&["run", &suite, "--out", &scratch.at("")]).ends_with(0);
    scratch
}

#[test]
fn a_fresh_record_is_verified_whole_and_alone() {
    let scratch = fresh();
    let record = Record::read(&scratch.path("record.jsonl")).unwrap();
    let pieces = record.cells.iter().filter(|c| c.verdict.evidence().is_some()).count()
        + record.claims.iter().flat_map(|c| &c.tests).map(|t| t.evidence.len()).sum::<usize>();
    for alone in [&[][..], &["--alone"]] {
        let out = lapjury(&[&["recheck", &scratch.at("record.jsonl")], alone].concat()).ends_with(0).out;
        let counts: Vec<usize> = out.lines().map(|line| line.rsplit(' ').next().unwrap().parse().unwrap()).collect();
        assert_eq!(counts.iter().sum::<usize>(), pieces, "{out}");
        assert!(counts[0] > 0 && counts[3] == 0, "{out}");
    }
}

#[test]
fn a_record_that_was_edited_is_refused_as_a_whole() {
    let scratch = fresh();
    let text = scratch.read("record.jsonl");
    // A failing verdict that is made to hold, without touching the footer.
    let edited = text.replacen("\"violations\":", "\"violations\":1", 1);
    assert_ne!(edited, text);
    let path = scratch.file("edited.jsonl", &edited);
    for verb in ["recheck", "report"] {
        let err = lapjury(&[verb, &path]).ends_with(2).err;
        assert!(err.contains("the record was changed after it was written"), "{verb}: {err}");
    }
}

#[test]
fn a_changed_number_in_a_witness_is_refused_although_the_digest_was_repaired() {
    let scratch = fresh();
    let honest = Record::read(&scratch.path("record.jsonl")).unwrap();
    let mut tampered = 0;
    for (at, cell) in honest.cells.iter().enumerate() {
        let Outcome::Fails(evidence) = &cell.verdict.outcome else { continue };
        let mut lie = evidence.clone();
        let Some((_, value)) = lie.excerpt.rows.first_mut().and_then(|row| row.entries.first_mut()) else { continue };
        *value = f64::from_bits(value.to_bits() ^ 1);
        let mut record = honest.clone();
        record.cells[at].verdict.outcome = Outcome::Fails(lie);
        let mut bytes = Vec::new();
        record.write(&mut bytes).unwrap();
        let path = scratch.file("lie.jsonl", std::str::from_utf8(&bytes).unwrap());
        let out = lapjury(&["recheck", &path]).ends_with(1).out;
        assert!(out.contains("refused: 1\n") && out.contains("was not copied faithfully"), "{out}");
        tampered += 1;
        if tampered == 3 {
            return;
        }
    }
    panic!("only {tampered} witnesses with a row");
}

#[test]
fn a_torn_record_is_read_up_to_its_last_whole_line() {
    let scratch = fresh();
    let text = scratch.read("record.jsonl");
    let path = scratch.file("torn.jsonl", &text[..text.len() - 20]);
    let ran = lapjury(&["recheck", &path]).ends_with(0);
    assert!(ran.err.contains("the last one, is torn (no newline) and was dropped"), "{}", ran.err);
}

#[test]
fn a_record_without_evidence_ends_with_4() {
    let scratch = fresh();
    let text = scratch.read("record.jsonl");
    let path = scratch.file("header.jsonl", text.split_inclusive('\n').next().unwrap());
    lapjury(&["recheck", &path]).ends_with(4);
}
