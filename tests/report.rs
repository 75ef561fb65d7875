//! Records and reports: what is written reads back, the digest sees verdicts and nothing else, the page keeps its rules.

mod sample;

use std::collections::BTreeSet;
use std::time::Instant;

use lapjury::property::{Statement, Verdict};
use lapjury::record::{ClaimOutcome, Line, ReadError, Record, Writer};
use lapjury::report::{self, Options, csv, render, text};

fn options() -> Options {
    let names =
        [("SYM", "symmetric"), ("LOC", "local"), ("POS", "positive weights"), ("PSD", "positive semi-definite")];
    Options {
        bibliography: "@article{wardetzky2007,\n  title = {Discrete {Laplace} operators: no free lunch}\n}\n".into(),
        licences: "spot.ply: CC0, Keenan Crane\n".into(),
        names: names.map(|(k, v)| (k.to_string(), v.to_string())).into(),
    }
}

fn page(record: &Record) -> String {
    let files = render(record, &options()).unwrap();
    String::from_utf8(files.into_iter().find(|f| f.path == "index.html").unwrap().bytes).unwrap()
}

// ── the record ──────────────────────────────────────────────────────────────────────────────────────────────────────

#[test]
fn a_record_reads_back_as_it_was_written() {
    let record = sample::rich();
    let mut bytes = Vec::new();
    record.write(&mut bytes).unwrap();
    assert_eq!(bytes, sample::written(&record));
    assert_eq!(Record::parse(&bytes).unwrap(), record);
    assert_eq!(record.footer.as_ref().unwrap().results_digest, record.digest().unwrap());
    assert_eq!(record.footer.as_ref().unwrap().unexpected, 3, "two cells and one claim of the sample");
}

#[test]
fn the_digest_sees_neither_timings_nor_the_environment_nor_the_order() {
    let record = sample::rich();
    let digest = record.digest().unwrap();
    let mut other = record.clone();
    other.timing.as_mut().unwrap().seconds *= 2.0;
    other.timing.as_mut().unwrap().threads = 1;
    other.header.environment.insert("processor".into(), "another".into());
    other.cells.reverse();
    assert_eq!(other.digest().unwrap(), digest);
}

#[test]
fn the_digest_sees_every_verdict_and_claim() {
    let record = sample::tiny();
    let digest = record.digest().unwrap();
    for k in 0..record.cells.len() {
        let mut other = record.clone();
        other.cells[k].verdict = Verdict::undecided("changed");
        assert_ne!(other.digest().unwrap(), digest, "cell {k}");
        let mut other = record.clone();
        other.cells[k].verdict.margin = Some(other.cells[k].verdict.margin.unwrap_or(0.0) + f64::EPSILON);
        assert_ne!(other.digest().unwrap(), digest, "margin of cell {k}");
    }
    for k in 0..record.claims.len() {
        let mut other = record.clone();
        other.claims[k].outcome = ClaimOutcome::Inconclusive;
        assert_ne!(other.digest().unwrap(), digest, "claim {k}");
    }
    let mut other = record.clone();
    other.header.seed += 1;
    assert_ne!(other.digest().unwrap(), digest);
}

#[test]
fn a_torn_last_line_is_dropped_with_a_notice_wherever_it_is_torn() {
    let bytes = sample::written(&sample::tiny());
    let start = bytes[..bytes.len() - 1].iter().rposition(|&b| b == b'\n').unwrap() + 1;
    for end in start + 1..bytes.len() {
        let record = Record::parse(&bytes[..end]).unwrap();
        assert!(record.footer.is_none() && record.notices.len() == 1 && record.notices[0].contains("torn"), "{end}");
        assert_eq!(Record::intact_length(&bytes[..end]), start);
    }
    assert!(Record::parse(&bytes).unwrap().notices.is_empty());
}

#[test]
fn an_interrupted_record_goes_on_and_ends_as_if_nothing_had_happened() {
    let whole = sample::tiny();
    let bytes = sample::written(&whole);
    let lines: Vec<Line> = whole.results().collect();
    for keep in [1, 4, lines.len()] {
        let cut: usize = bytes.split_inclusive(|&b| b == b'\n').take(keep).map(<[u8]>::len).sum();
        let mut journal = bytes[..cut].to_vec();
        let begun = Record::parse(&journal).unwrap();
        let mut writer = Writer::resume(&mut journal, &begun).unwrap();
        lines[keep..].iter().for_each(|line| writer.write(line).unwrap());
        writer.finish().unwrap();
        assert_eq!(journal, bytes);
    }
}

#[test]
fn any_other_damage_is_an_error_that_names_its_line() {
    let text = String::from_utf8(sample::written(&sample::tiny())).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let with = |at: usize, line: &str| {
        let mut lines = lines.clone();
        lines[at] = line;
        Record::parse((lines.join("\n") + "\n").as_bytes()).unwrap_err().to_string()
    };
    assert_eq!(with(2, "{\"line\":\"cell\""), "line 3: column 14: EOF while parsing an object; the record is damaged");
    assert_eq!(with(2, "{\"line\":\"gossip\"}"), "line 3: unknown kind of line `gossip`; the record is damaged");
    assert!(with(3, "{\"line\":\"cell\"}").starts_with("line 4: column 15: missing field `recipe`"));
    assert!(with(0, lines[1]).contains("not the header of a record"));
    assert!(with(1, lines[0]).contains("line 2: a second header"));
    assert!(with(4, lines[3]).starts_with("line 5: cell graph SYM kite"), "{}", with(4, lines[3]));
    assert!(with(3, &lines[3].replace("0.1", "0.2")).starts_with("the footer states digest"));
    let after = text.clone() + lines[3] + "\n";
    assert!(Record::parse(after.as_bytes()).unwrap_err().to_string().contains("after the footer"));
    assert!(matches!(Record::parse(b""), Err(ReadError::Empty)));
    assert!(matches!(Record::parse(b"\xff\n"), Err(ReadError::NotText { line: 1 })));
}

#[test]
fn a_record_of_another_schema_is_refused_whatever_else_it_says() {
    let text = "{\"line\":\"header\",\"schema\":2,\"shape\":\"unheard of\"}\n";
    let error = Record::parse(text.as_bytes()).unwrap_err().to_string();
    assert_eq!(error, "the record has schema 2, this program reads schema 1; use the program that wrote it");
}

#[test]
fn a_number_that_is_not_finite_is_refused_when_it_is_written() {
    let mut record = sample::tiny();
    record.domains[0].facts.surface.as_mut().unwrap().area = f64::NAN;
    let error = record.write(Vec::new()).unwrap_err().to_string();
    assert!(error.contains("not finite"), "{error}");
}

#[test]
fn lookups_find_what_the_record_holds() {
    let record = sample::tiny();
    let index = record.index();
    assert_eq!(index.laplacians, ["graph", "cotan"]);
    assert_eq!(index.properties, ["SYM", "LIN", "POS"]);
    assert_eq!(index.classes, ["hand-made", "perturbed grids"]);
    assert_eq!((index.cells("cotan", "POS").len(), index.cells("graph", "POS").len()), (2, 0));
    let exhibit = index.exhibit("cotan", "POS").unwrap();
    assert_eq!(index.cell_of(exhibit).unwrap().recipe, index.domain(&exhibit.recipe).unwrap().recipe);
    assert_eq!(index.claim("c81").unwrap().outcome, ClaimOutcome::Amended);
}

// ── the terminal and the tables ─────────────────────────────────────────────────────────────────────────────────────

const TINY: &str = "\
suite tiny · seed 7 · 2 domains · 9 verdicts · 2 unexpected

       SYM  LIN  POS
graph  ✓ 2  –    ·
cotan  ✓ 2  ? 1  ✗ 1/2

✓ n holds in all n cases   ✗ k/n fails in k of n   ? k/n left open in k of n   – says nothing   · no case

Unexpected
  cotan POS on kite(apex=0.35)
    fails although it is promised to hold: edge (1, 3): ω = −0.31; the opposite angles 127.9° and 133.6° add up to more than 180°
    lapjury check --domain 'kite(apex=0.35)' --laplacian cotan --property POS

Claims
  c33  confirmed
  c81  confirmed with an amendment
  c40  refuted as stated   expected: confirmed

Atlas: 4 cells failing, 3 of them by a provably smallest mesh; 1 without a counterexample in the small world
";

#[test]
fn the_terminal_shows_the_taxonomy_the_unexpected_and_the_claims() {
    assert_eq!(text::text(&sample::tiny(), text::Style::default()), TINY);
}

#[test]
fn a_narrow_terminal_gets_the_table_in_bands_and_colour_only_if_asked() {
    let record = sample::rich();
    let narrow = text::text(&record, text::Style { colour: false, width: 60 });
    let table: Vec<&str> = narrow.lines().skip(2).take_while(|l| !l.starts_with('✓')).collect();
    assert!(table.iter().all(|l| l.chars().count() <= 60), "{table:#?}");
    assert!(table.iter().filter(|l| l.starts_with("cotan ")).count() > 1);
    assert!(!narrow.contains('\u{1b}'));
    assert!(text::text(&record, text::Style { colour: true, width: 60 }).contains("\u{1b}[34m✓"));
    let wants = |terminal, no_color: Option<&str>| text::wants_colour(terminal, no_color.map(AsRef::as_ref));
    assert!(wants(true, None) && wants(true, Some("")) && !wants(true, Some("1")) && !wants(false, None));
}

#[test]
fn each_table_has_a_row_for_each_of_its_things() {
    let record = sample::rich();
    let rows = |table: csv::Table| {
        let bytes = table.unwrap();
        ::csv::Reader::from_reader(bytes.as_slice()).records().map(|r| r.unwrap().len()).collect::<Vec<_>>().len()
    };
    assert_eq!(rows(csv::cells(&record)), record.cells.len());
    assert_eq!(rows(csv::domains(&record)), record.domains.len());
    assert_eq!(rows(csv::claims(&record)), record.claims.len());
    assert_eq!(rows(csv::tests(&record)), record.claims.iter().map(|c| c.tests.len()).sum::<usize>());
    let pairs: BTreeSet<_> = record.cells.iter().map(|c| (&c.laplacian, &c.property)).collect();
    assert_eq!(rows(csv::taxonomy(&record.index())), pairs.len());
}

#[test]
fn the_ci_files_say_what_was_not_expected() {
    let record = sample::tiny();
    let summary = report::markdown(&record);
    assert!(summary.contains("| cotan | ✓ 2 | ? 1 | ✗ 1/2 |") && summary.contains("### Unexpected"), "{summary}");
    let junit = report::junit(&record);
    assert_eq!(junit.matches("<failure").count(), 2, "one cell, one claim\n{junit}");
    balanced(junit.trim_start_matches("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"));
}

// ── words and pictures ──────────────────────────────────────────────────────────────────────────────────────────────

#[test]
fn every_kind_of_evidence_has_a_sentence_of_its_own_and_every_witness_a_picture() {
    let record = sample::rich();
    let witnesses = sample::witnesses();
    let mut sentences = BTreeSet::new();
    for (property, statement, excerpt) in &witnesses {
        let evidence = lapjury::property::Evidence::new(statement.clone(), excerpt.clone());
        let verdict = Verdict::fails(lapjury::property::Level::Exact, evidence);
        let said = report::sentence(&verdict);
        assert!(said.len() > 20 && !said.contains("NaN") || property == &"FIN", "{said}");
        sentences.insert(said);
    }
    let others: Vec<Statement> = sample::certificates().into_iter().chain(sample::triangulations()).collect();
    for statement in others.iter().cloned() {
        let verdict = Verdict::holds(lapjury::property::Level::Exact, lapjury::property::Evidence::bare(statement));
        sentences.insert(report::sentence(&verdict));
    }
    assert_eq!(sentences.len(), witnesses.len() + others.len());
    for exhibit in &record.exhibits {
        let svg = report::exhibit_svg(exhibit, record.index().cell_of(exhibit)).unwrap();
        balanced(&svg);
        let marked = ["\"bad\"", "\"pair\"", "\"star\"", "\"v0\"", "\"v8\"", "\"focus\""];
        let total = matches!(exhibit.property.as_str(), "MASS");
        assert!(total || marked.iter().any(|class| svg.contains(class)), "{} {}", exhibit.laplacian, exhibit.property);
    }
}

#[test]
fn the_sample_has_every_kind_of_statement() {
    let statements: Vec<Statement> = sample::witnesses()
        .into_iter()
        .map(|w| w.1)
        .chain(sample::certificates())
        .chain(sample::triangulations())
        .chain(sample::weighings().into_iter().map(|e| e.statement))
        .collect();
    let found: BTreeSet<&str> = statements.iter().map(kind).collect();
    assert_eq!(found.len(), KINDS, "a kind of evidence is missing in the sample");
}

const KINDS: usize = 45;

/// The match makes a new kind of statement an error here, so that it is given a sentence, a picture and a sample.
fn kind(statement: &Statement) -> &'static str {
    match statement {
        Statement::NotFinite { .. } => "NotFinite",
        Statement::FarEntry { .. } => "FarEntry",
        Statement::Asymmetry { .. } => "Asymmetry",
        Statement::RowSum { .. } => "RowSum",
        Statement::KernelVector { .. } => "KernelVector",
        Statement::Weight { .. } => "Weight",
        Statement::NegativeEnergy { .. } => "NegativeEnergy",
        Statement::Moment { .. } => "Moment",
        Statement::Energy { .. } => "Energy",
        Statement::Inaccurate { .. } => "Inaccurate",
        Statement::BothSigns { .. } => "BothSigns",
        Statement::NoWeight { .. } => "NoWeight",
        Statement::NotConvex { .. } => "NotConvex",
        Statement::Overshoot { .. } => "Overshoot",
        Statement::Singular { .. } => "Singular",
        Statement::HeatLoss { .. } => "HeatLoss",
        Statement::MassTotal { .. } => "MassTotal",
        Statement::MassAsymmetry { .. } => "MassAsymmetry",
        Statement::MassNotPositive { .. } => "MassNotPositive",
        Statement::MassShare { .. } => "MassShare",
        Statement::Changed { .. } => "Changed",
        Statement::BelowCheeger { .. } => "BelowCheeger",
        Statement::Lift { .. } => "Lift",
        Statement::Equilibrium { .. } => "Equilibrium",
        Statement::Motion { .. } => "Motion",
        Statement::NoLift { .. } => "NoLift",
        Statement::Scan { .. } => "Scan",
        Statement::SumOfSquares => "SumOfSquares",
        Statement::ShiftedFactor { .. } => "ShiftedFactor",
        Statement::InertiaCount { .. } => "InertiaCount",
        Statement::ClosedClasses { .. } => "ClosedClasses",
        Statement::SingularValues { .. } => "SingularValues",
        Statement::SignPattern { .. } => "SignPattern",
        Statement::Solved { .. } => "Solved",
        Statement::Compared { .. } => "Compared",
        Statement::FlipsToDelaunay { .. } => "FlipsToDelaunay",
        Statement::DelaunayNotMinimal { .. } => "DelaunayNotMinimal",
        Statement::PositiveExtension { .. } => "PositiveExtension",
        Statement::NotEmbedded { .. } => "NotEmbedded",
        Statement::TorusFlips { .. } => "TorusFlips",
        Statement::Cospectral { .. } => "Cospectral",
        Statement::Transplantation { .. } => "Transplantation",
        Statement::SpectraDiffer { .. } => "SpectraDiffer",
        Statement::DelaunayEigenvalue { .. } => "DelaunayEigenvalue",
        Statement::HarmonicForm { .. } => "HarmonicForm",
    }
}

#[test]
fn the_figures_of_a_claim_stand_beside_it_and_its_charts_are_files() {
    let mut record = sample::rich();
    let page = |record: &Record| report::html(record, &report::Options::default(), &[]).unwrap();
    let text = page(&record);
    for title in ["The first eigenvalue under refinement", "Numbers that fall", "A cycle of four"] {
        assert!(text.contains(&format!("<figcaption>{title}.</figcaption>")), "{title}");
    }
    let files = report::render(&record, &report::Options::default()).unwrap();
    let id = record.claims[0].id.clone();
    for number in [1, 2] {
        let path = format!("charts/{id}-{number}.svg");
        let svg = files.iter().find(|f| f.path == path).unwrap_or_else(|| panic!("{path} is missing"));
        balanced(std::str::from_utf8(&svg.bytes).unwrap());
    }
    record.claims.iter_mut().flat_map(|c| &mut c.tests).for_each(|t| t.figures.clear());
    assert!(!page(&record).contains("A cycle of four"));
}

#[test]
fn every_statement_about_a_triangulation_has_its_sentence_and_its_pictures() {
    let marks = [("Lift", "dual"), ("Equilibrium", "f5"), ("Motion", "arrow"), ("NoLift", "f5")];
    let mut sentences = BTreeSet::new();
    for (evidence, (name, mark)) in sample::weighings().iter().zip(marks) {
        assert_eq!(kind(&evidence.statement), name);
        sentences.insert(report::statement(evidence));
        let figures = report::figures(evidence);
        figures.iter().for_each(|f| drop(balanced(&f.svg)));
        assert_eq!(figures.len(), if name == "Lift" { 2 } else { 1 }, "{name}");
        assert!(figures[0].svg.contains(&format!("class=\"{mark}\"")), "{name}: {}", figures[0].svg);
    }
    assert_eq!(sentences.len(), 4);
    assert!(report::figures(&lapjury::property::Evidence::bare(Statement::SumOfSquares)).is_empty());
    let mut record = sample::rich();
    record.claims[0].tests[0].evidence = sample::weighings();
    let page = report::html(&record, &report::Options::default(), &[]).unwrap();
    assert!(page.contains("The lifted surface, convex.") && page.contains("class=\"arrow\""));
}

#[test]
fn charts_and_exhibits_come_as_png_too() {
    let record = sample::rich();
    let exhibit = record.index().exhibit("cotan", "POS").unwrap().clone();
    let picture = report::exhibit_png(&exhibit, record.index().cell_of(&exhibit), 1).unwrap().unwrap();
    let chart = report::plot::charts(&record).last().unwrap().png().unwrap();
    for png in [&picture, &chart] {
        assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(&png[png.len() - 8..], b"IEND\xaeB`\x82", "the checksum of an empty IEND chunk is AE 42 60 82");
    }
    assert_eq!(picture[16..20], 400u32.to_be_bytes());
    let directory = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(directory.join("exhibit.png"), picture).unwrap();
    std::fs::write(directory.join("chart.png"), chart).unwrap();
}

// ── the page ────────────────────────────────────────────────────────────────────────────────────────────────────────

#[test]
fn the_page_is_balanced_its_anchors_resolve_and_it_loads_nothing() {
    for record in [sample::rich(), sample::tiny(), Record::new(sample::header("empty"))] {
        let page = page(&record);
        let (ids, links) = balanced(&page);
        let distinct: BTreeSet<&String> = ids.iter().collect();
        assert_eq!(distinct.len(), ids.len(), "an id is there twice");
        let inside: Vec<_> = links.iter().filter_map(|l| l.strip_prefix('#')).collect();
        assert!(inside.iter().all(|l| distinct.contains(&l.to_string())), "{inside:?}");
        for link in &links {
            let beside =
                ["atlas.csv", "taxonomy.csv", "taxonomy.json", "claims.csv", "tests.csv", "domains.csv", "cells.csv"];
            assert!(link.starts_with('#') || link.starts_with("data:") || beside.contains(&link.as_str()), "{link}");
        }
        assert!(!page.contains("src=") && !page.contains("@import") && !page.contains("url("));
        let addresses = page.matches("http://").count() + page.matches("https://").count();
        assert_eq!(addresses, page.matches("xmlns=\"http://www.w3.org/2000/svg\"").count());
    }
}

#[test]
fn the_atlas_has_a_picture_with_the_cases_searched_for_each_counterexample_and_a_row_for_each_other_cell() {
    let page = page(&sample::tiny());
    let atlas = &page[page.find("<section id=\"atlas\"").unwrap()..];
    let atlas = &atlas[..atlas.find("</section>").unwrap()];
    assert_eq!((atlas.matches("<figure").count(), atlas.matches("<svg").count()), (4, 4));
    assert_eq!(atlas.matches("provably the smallest, number 34 of 6917 (decided exactly)").count(), 3);
    assert!(atlas.contains("the first known, number 34 of 6917; 2 smaller ones were left open"), "{atlas}");
    assert!(atlas.contains("cotan:mass=voronoi fails MASS"));
    assert_eq!(atlas.matches("<tr").count(), 2, "a head and one cell without a counterexample");
    assert!(
        text::text(&sample::tiny(), text::Style::default())
            .contains("4 cells failing, 3 of them by a provably smallest")
    );
    let none = Record::new(sample::header("empty"));
    assert!(self::page(&none).contains("No small world was searched exhaustively."));
}

#[test]
fn a_name_in_a_record_is_never_markup() {
    let mut record = sample::tiny();
    let evil = "<script>alert(1)</script>\"&'";
    record.cells.iter_mut().for_each(|c| {
        c.laplacian = evil.into();
        c.recipe = evil.into();
        c.replay = evil.into();
    });
    record.exhibits[0].laplacian = evil.into();
    record.exhibits[0].recipe = evil.into();
    record.atlas.iter_mut().for_each(|line| line.laplacian = evil.into());
    record.atlas.iter_mut().for_each(|line| line.property = format!("{evil}{}", line.size));
    record.atlas.truncate(1);
    record.claims[0].statement = evil.into();
    let page = page(&record);
    assert!(!page.contains("<script>alert") && page.contains("&lt;script&gt;alert(1)"));
    balanced(&page);
    balanced(report::junit(&record).split_once('\n').unwrap().1);
}

#[test]
fn the_page_of_seventy_thousand_verdicts_is_below_three_megabytes() {
    let record = sample::large();
    assert!(record.cells.len() > 70_000);
    let page = page(&record);
    assert!(page.len() < 3_000_000, "{}", page.len());
    balanced(&page);
}

#[test]
fn the_sample_page_is_written_for_the_browser_check() {
    let directory = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("report");
    let files = render(&sample::rich(), &options()).unwrap();
    for file in &files {
        let path = directory.join(&file.path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, &file.bytes).unwrap();
    }
    let paths: BTreeSet<&str> = files.iter().map(|f| f.path.as_str()).collect();
    for path in [
        "index.html",
        "summary.md",
        "junit.xml",
        "charts/margins.svg",
        "charts/negative-weights.svg",
        "charts/time.svg",
    ] {
        assert!(paths.contains(path), "{path}");
    }
}

/// Run in the release profile for the figure: `cargo test --release --test report -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn reading_a_large_record_takes_about_a_second() {
    let bytes = sample::written(&sample::large());
    let start = Instant::now();
    let record = Record::parse(&bytes).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    println!("{} cells, {} MB: {seconds:.2} s", record.cells.len(), bytes.len() / 1_000_000);
    assert!(seconds < 5.0);
}

/// Checks that every element is closed in order; gives the ids and the addresses of links.
fn balanced(markup: &str) -> (Vec<String>, Vec<String>) {
    const VOID: [&str; 6] = ["meta", "link", "br", "wbr", "input", "!DOCTYPE"];
    let (mut open, mut ids, mut links) = (Vec::new(), Vec::new(), Vec::new());
    let mut rest = markup;
    while let Some(at) = rest.find('<') {
        rest = &rest[at + 1..];
        let end = rest.find('>').expect("every tag ends");
        let tag = &rest[..end];
        rest = &rest[end + 1..];
        let name = tag.trim_start_matches('/').split([' ', '/']).next().unwrap();
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name), "closing tag out of order near {}", &rest[..rest.len().min(80)]);
            continue;
        }
        let attribute =
            |key: &str| tag.split_once(&format!(" {key}=\"")).map(|(_, v)| v.split('"').next().unwrap().to_string());
        ids.extend(attribute("id"));
        links.extend(attribute("href"));
        if !tag.ends_with('/') && !VOID.contains(&name) {
            open.push(name);
        }
        if name == "script" || name == "style" {
            rest = &rest[rest.find(&format!("</{name}>")).expect("closed")..];
        }
    }
    assert!(open.is_empty(), "never closed: {open:?}");
    (ids, links)
}
