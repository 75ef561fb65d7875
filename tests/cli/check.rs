//! `check` with built-in operators.

use std::collections::BTreeSet;

use lapjury::property;
use serde_json::Value;

use crate::lapjury;

fn keys(value: &Value) -> BTreeSet<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

#[test]
fn the_json_answer_has_domain_operator_and_a_verdict_for_each_property() {
    let answer = lapjury(&["check", "--domain", "grid:nx=2,ny=2", "--laplacian", "cotan", "--format", "json"])
        .ends_with(0)
        .json();
    assert_eq!(keys(&answer), ["domain", "operator", "verdicts"].into());
    let domain = &answer["domain"];
    assert_eq!((&domain["source"], &domain["kind"]), (&"grid:nx=2,ny=2".into(), &"surface".into()));
    // A 2 × 2 grid: 9 points, 12 sides and 4 diagonals, 8 triangles; the diagonals are the cocircular edges.
    for (fact, value) in [("vertices", 9), ("edges", 16), ("faces", 8), ("cocircular_edges", 4)] {
        assert_eq!(domain[fact], value, "{fact}");
    }
    assert_eq!((&domain["planar"], &domain["area"]), (&true.into(), &4.0.into()));
    assert_eq!(domain["digest"].as_str().unwrap().len(), 64);

    let operator = &answer["operator"];
    assert_eq!((&operator["id"], &operator["parameters"]["mass"]), (&"cotan".into(), &"barycentric".into()));
    assert_eq!(operator["mass_total"], 4.0);

    let verdicts = answer["verdicts"].as_array().unwrap();
    let ids: Vec<&str> = verdicts.iter().map(|v| v["property"].as_str().unwrap()).collect();
    assert_eq!(ids, property::ALL.iter().map(|p| p.id).collect::<Vec<_>>());
    let known: BTreeSet<&str> = [
        "property",
        "status",
        "evidence",
        "violations",
        "zeros",
        "open",
        "total",
        "margin",
        "reason",
        "notes",
        "witness",
        "certificate",
        "recheck",
        "promised",
    ]
    .into();
    for verdict in verdicts {
        let keys = keys(verdict);
        assert!(
            keys.is_subset(&known) && keys.is_superset(&["property", "status", "evidence", "margin", "recheck"].into())
        );
        match verdict["status"].as_str().unwrap() {
            "holds" => assert!(keys.contains("certificate") && !keys.contains("witness"), "{verdict}"),
            "fails" => assert!(keys.contains("witness") && !keys.contains("certificate"), "{verdict}"),
            _ => assert!(keys.contains("reason") && verdict["recheck"] == "nothing", "{verdict}"),
        }
    }
    // The weights of the four diagonals are zero: cos 90° + cos 90°.
    let pos = &verdicts[ids.iter().position(|id| *id == "POS").unwrap()];
    assert_eq!(
        (&pos["status"], &pos["evidence"], &pos["recheck"]),
        (&"fails".into(), &"exact".into(), &"exact".into())
    );
    assert_eq!((&pos["violations"], &pos["zeros"], &pos["total"]), (&0.into(), &4.into(), &8.into()));
    assert_eq!(
        (&pos["witness"]["statement"]["kind"], &pos["witness"]["statement"]["zero"]),
        (&"weight".into(), &true.into())
    );
}

#[test]
fn the_human_answer_has_a_line_for_each_verdict_and_a_sentence_for_each_witness() {
    let out =
        lapjury(&["check", "--domain", "grid:nx=2,ny=2", "--laplacian", "cotan", "--mass", "mixed"]).ends_with(0).out;
    assert!(
        out.starts_with("grid:nx=2,ny=2: surface with 9 vertices, 16 edges, 8 faces, 1 component, angles 45"),
        "{out}"
    );
    assert!(out.contains("\noperator cotan degenerate=refuse, mass=mixed\n"), "{out}");
    for property in property::ALL {
        assert!(out.contains(&format!("\n{:<13}", property.id)), "{}: {out}", property.id);
    }
    assert!(
        out.contains("\nPOS          fails          exact     0 of 8 violated, 4 zero\n             edge "),
        "{out}"
    );
}

#[test]
fn the_properties_asked_are_decided_and_no_other() {
    let check = |more: &[&str]| {
        let arguments =
            [&["check", "--domain", "grid:nx=2,ny=2", "--laplacian", "cotan", "--format", "json"], more].concat();
        let answer = lapjury(&arguments).ends_with(0).json();
        let verdicts = answer["verdicts"].as_array().unwrap().clone();
        verdicts.iter().map(|v| v["property"].as_str().unwrap().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(check(&["--property", "PSD,SYM"]), ["SYM", "PSD"], "in the order of the tables");
    assert_eq!(
        check(&["--property", "SYM", "--promises", "NULL"]),
        ["FIN", "SYM", "NULL"],
        "a promise is decided, and implies FIN"
    );
}

#[test]
fn a_broken_promise_ends_with_1_and_one_that_says_nothing_with_4() {
    let check = |promise: &str, domain: &str| {
        lapjury(&["check", "--domain", domain, "--laplacian", "mean-value", "--property", "LOC", "--promises", promise])
    };
    let broken = check("SYM", "grid:nx=3,ny=3").ends_with(1).out;
    assert!(
        broken.contains("SYM          fails") && broken.contains("unexpected: this property is promised here"),
        "{broken}"
    );
    check("LOC,POS", "grid:nx=3,ny=3").ends_with(0);
    // A closed surface is not flat: it has no star for LIN to be asked about.
    check("LIN", "icosphere:levels=1").ends_with(4);
    check("LIN,POS", "icosphere:levels=1").ends_with(0);
    let unasked = ["check", "--domain", "grid:nx=3,ny=3", "--laplacian", "mean-value", "--property", "SYM"];
    assert!(lapjury(&unasked).ends_with(0).out.contains("SYM          fails"), "an expected failure is knowledge");
}

#[test]
fn a_mesh_with_degenerate_triangles_is_refused_by_the_cotangents_with_the_triangle_named() {
    let refused = "triangle 924 (487, 490, 509) has zero area, where 'cotan' is not defined (56 such triangles in all)";
    let check = ["check", "--mesh", "fixtures/meshes/spider.obj", "--laplacian"];
    let human = lapjury(&[&check[..], &["cotan"]].concat()).ends_with(2);
    assert!(human.err.contains(refused) && human.err.contains("degenerate=skip"), "{}", human.err);
    assert_eq!(human.out, "");
    let json = lapjury(&[&check[..], &["cotan", "--format", "json"]].concat()).ends_with(2).json();
    assert!(json["operator"]["refused"].as_str().unwrap().starts_with(refused));
    assert_eq!((&json["operator"]["id"], &json["domain"]["degenerate_faces"]), (&"cotan".into(), &56.into()));
    assert_eq!(json["verdicts"], Value::Array(vec![]));
    let skipped = lapjury(&[&check[..], &["cotan:degenerate=skip", "--property", "FIN,SYM"]].concat()).ends_with(0).out;
    assert!(skipped.contains("FIN          holds") && skipped.contains("SYM          holds"), "{skipped}");
}

#[test]
fn a_mesh_that_is_no_manifold_is_judged_and_what_was_welded_is_said() {
    let ran = lapjury(&["check", "--mesh", "fixtures/meshes/3DSMaxExport.STL", "--laplacian", "cotan"]).ends_with(0);
    assert!(ran.err.contains("6000 corners were welded to 1042 vertices"), "{}", ran.err);
    assert!(ran.out.contains("16 edges have more than two faces, the first is (722, 723) with 3 faces"), "{}", ran.out);
    assert!(ran.out.contains("PSD          holds") && !ran.out.contains("NaN"), "{}", ran.out);
    let mean_value =
        lapjury(&["check", "--mesh", "fixtures/meshes/3DSMaxExport.STL", "--laplacian", "intrinsic-delaunay"]);
    assert!(mean_value.ends_with(2).err.contains("'intrinsic-delaunay' needs a manifold"));
}

#[test]
fn faces_that_were_turned_round_are_said_on_standard_error_and_in_the_answer() {
    let check = ["check", "--mesh", "fixtures/meshes/oblong-shuffled.off", "--laplacian", "cotan", "--property", "SYM"];
    let human = lapjury(&check).ends_with(0);
    let notice = "397 of 840 faces were turned round";
    assert!(human.err.contains(notice) && !human.out.contains(notice), "{}", human.err);
    let json = lapjury(&[&check[..], &["--format", "json"]].concat()).ends_with(0).json();
    assert!(json["domain"]["notices"][0].as_str().unwrap().starts_with(notice));
    assert_eq!(json["domain"]["flipped_faces"], 397);
}
