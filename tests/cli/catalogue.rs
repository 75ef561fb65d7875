//! `list`, `explain`, `verify`, `witness`.

use lapjury::property::recheck::{self, Rechecked};
use lapjury::record::Cell;
use lapjury::suite::claims;
use lapjury::{experiment, generate, laplacian, property};

use crate::{Scratch, lapjury};

#[test]
fn each_list_names_every_entry_in_the_order_of_the_catalogue() {
    let lists: [(&str, Vec<String>); 6] = [
        ("laplacians", laplacian::ALL.iter().map(|l| l.id.to_string()).collect()),
        ("properties", property::ALL.iter().map(|p| p.id.to_string()).collect()),
        ("generators", generate::ALL.iter().map(|g| g.id.to_string()).collect()),
        ("experiments", experiment::ALL.iter().map(|e| e.id.to_string()).collect()),
        ("claims", claims::all().unwrap().into_iter().map(|c| c.id).collect()),
        ("suites", vec!["primer".into(), "smoke".into()]),
    ];
    for (kind, expected) in lists {
        let out = lapjury(&["list", kind]).ends_with(0).out;
        let rows: Vec<(&str, &str)> = out.lines().map(|line| line.split_once("  ").expect("id and sentence")).collect();
        assert_eq!(rows.iter().map(|(id, _)| *id).collect::<Vec<_>>(), expected, "{kind}");
        assert!(rows.iter().all(|(_, sentence)| sentence.trim().len() > 5), "{kind}: {out}");
    }
}

#[test]
fn explain_says_what_an_entry_of_each_kind_is() {
    for (id, parts) in [
        (
            "three-point",
            &[
                "defined on: surface",
                "parameter p (default",
                "promise: LOC holds\n",
                ", with p=1",
                "lapjury witness three-point SYM\n",
                "sources: ",
            ][..],
        ),
        (
            "cotan",
            &["promise: POS holds on a domain that is strictly Delaunay, manifold", "lapjury witness cotan POS\n"],
        ),
        ("POS0", &["ω_ij ≥ 0", "sources: wardetzky2007"]),
        ("icosphere", &["parameter levels (default", "guarantee: "]),
        ("heat-flow", &["parts: flux-runs-from-hot-to-cold, "]),
        ("c82", &["stated in: wardetzky-primer, section", "amended form: ", "test it: lapjury verify c82"]),
    ] {
        let out = lapjury(&["explain", id]).ends_with(0).out;
        assert!(out.starts_with(&format!("{id}: ")), "{out}");
        assert!(parts.iter().all(|part| out.contains(part)), "{out}");
    }
}

#[test]
fn a_claim_is_tested_by_its_experiments_and_by_the_cells_that_it_asks() {
    let out = lapjury(&["verify", "c36", "--suite", "smoke"]).ends_with(0).out;
    assert!(out.starts_with("c36  "), "{out}");
    assert!(out.contains("agrees (exact)") && out.contains("evidence: "), "{out}");
    assert!(out.contains("cotan: on some domain with POS0 fails, PSD holds"), "{out}");
    assert!(out.ends_with("outcome: confirmed\n"), "{out}");

    let amended = lapjury(&["verify", "c82", "--suite", "smoke", "--format", "json"]).ends_with(0).json();
    assert_eq!((&amended["outcome"], &amended["expected"]), (&"amended".into(), &"amended".into()));
    let tests = amended["tests"].as_array().unwrap();
    let agree = |form: &str| tests.iter().filter(|t| t["form"] == form).all(|t| t["agrees"] == true);
    assert!(!agree("stated") && agree("amended"));
    assert!(tests.iter().all(|t| t["replay"] == "lapjury verify c82 --seed 1 --effort smoke"));
}

#[test]
fn the_replay_command_of_an_experiment_finds_the_same() {
    let first = lapjury(&["verify", "c73", "--suite", "smoke", "--seed", "5", "--format", "json"]).ends_with(0).json();
    let replay = first["tests"][0]["replay"].as_str().unwrap();
    let words: Vec<&str> = replay.split(' ').skip(1).chain(["--format", "json"]).collect();
    assert_eq!(lapjury(&words).ends_with(0).json(), first);
}

#[test]
fn a_claim_that_tests_nothing_ends_with_4() {
    let scratch = Scratch::new();
    // The claim asks about graphs' Laplacians; the suite has none.
    let suite = scratch.file(
        "bare.toml",
        "id = 'bare'\ntitle = 'no graph'\nseed = 1\neffort = 'smoke'\nlaplacians = ['cotan']\n\
         [[class]]\nid = 'one'\nrecipe = 'grid:nx=2,ny=2'\n",
    );
    let out = lapjury(&["verify", "c77", "--suite", &suite]).ends_with(4).out;
    assert!(out.contains("outcome: nothing was tested  (expected: confirmed)"), "{out}");
}

#[test]
fn a_witness_comes_with_mesh_picture_and_evidence_that_speaks_for_itself() {
    let scratch = Scratch::new();
    let ran = lapjury(&["witness", "cotan", "POS", "--out", &scratch.at("found")]).ends_with(0);
    assert!(
        ran.out.starts_with(
            "cotan fails POS on a mesh of 4 vertices and 2 faces in a box 1 × 1: provably the smallest, number "
        ),
        "{}",
        ran.out
    );
    assert!(ran.out.contains("  recheck: exact\n") && ran.out.contains("  replay: lapjury check "), "{}", ran.out);
    let cell: Cell = serde_json::from_str(&scratch.read("found/cotan-POS.json")).unwrap();
    assert_eq!(recheck::from_excerpt(cell.verdict.evidence().unwrap()), Ok(Rechecked::Exact));
    assert!(scratch.read("found/cotan-POS.svg").starts_with("<svg"));
    let mesh = scratch.at("found/cotan-POS.off");
    let again = lapjury(&["check", "--mesh", &mesh, "--laplacian", "cotan", "--property", "POS"]).ends_with(0);
    assert!(again.out.contains("POS          fails          exact"), "{}", again.out);
}

#[test]
fn where_no_counterexample_is_known_the_search_ends_with_4() {
    let ran = lapjury(&["witness", "graph", "LOC"]).ends_with(4);
    assert!(
        ran.out.starts_with("graph fails LOC on none of every triangulation of every set of 3 to 6 points"),
        "{}",
        ran.out
    );
    assert!(ran.out.contains("\nno counterexample: LOC was decided on "), "{}", ran.out);
}

#[test]
fn the_json_of_a_witness_has_the_cases_searched_and_the_mesh() {
    let json = lapjury(&["witness", "cotan", "POS0", "--format", "json"]).ends_with(0).json();
    let line = &json["exhaustive"];
    assert_eq!(
        (&line["open"], &line["level"], &json["families"]),
        (&0.into(), &"exact".into(), &serde_json::Value::Null)
    );
    assert!(line["searched"].as_u64().unwrap() < line["size"].as_u64().unwrap());
    assert_eq!(line["found"]["exhibit"]["positions"].as_array().unwrap().len(), 4);
    // No surface: the families of volumes are searched.
    let volume = lapjury(&["witness", "tet-cotan", "POS0", "--format", "json"]).ends_with(0).json();
    assert_eq!(volume["exhaustive"], serde_json::Value::Null);
    assert!(volume["families"]["cell"]["recipe"].as_str().unwrap().starts_with("tet-grid"));
}

#[test]
fn a_failing_mesh_shrinks_to_one_that_fails_alike() {
    let scratch = Scratch::new();
    let ran = lapjury(&[
        "check",
        "--domain",
        "random-delaunay:n=40,seed=7 | flip:count=20,seed=7",
        "--laplacian",
        "cotan",
        "--property",
        "POS0",
        "--shrink",
        &scratch.at("small"),
    ])
    .ends_with(0);
    assert!(
        ran.err.contains("POS0 still fails on 4 vertices instead of 40: lapjury check --domain 'listed:"),
        "{}",
        ran.err
    );
    let mesh = scratch.at("small/cotan-POS0.off");
    let again = lapjury(&["check", "--mesh", &mesh, "--laplacian", "cotan", "--property", "POS0"]).ends_with(0);
    assert!(again.out.contains("POS0         fails          exact"), "{}", again.out);
}
