//! Suites: plans that mean the same for ever, names that must exist, results that do not depend on threads.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use lapjury::record::{Line, Record, Writer};
use lapjury::suite::schema::BUILT_IN;
use lapjury::suite::{self, Options, Plan, Suite, claims};
use lapjury::{experiment, laplacian, property};

/// A suite with these lines after its head.
fn parse(lines: &str) -> Suite {
    Suite::parse("test", &format!("id = 'test'\ntitle = 'test'\nseed = 1\neffort = 'smoke'\n{lines}")).unwrap()
}

fn plan(lines: &str) -> Plan {
    parse(lines).plan().unwrap_or_else(|error| panic!("{error}"))
}

fn refusal(lines: &str) -> String {
    parse(lines).plan().err().unwrap_or_else(|| panic!("planned: {lines}")).to_string()
}

fn recipes(plan: &Plan) -> Vec<String> {
    plan.cases.iter().map(|case| case.recipe.to_string()).collect()
}

fn labels(plan: &Plan, case: usize) -> Vec<String> {
    plan.cases[case].choices.iter().map(ToString::to_string).collect()
}

/// Runs a plan and gives the text of its record.
fn run(plan: &Plan, threads: usize) -> Vec<u8> {
    let options = Options {
        root: PathBuf::from(env!("CARGO_MANIFEST_DIR")),
        threads: Some(threads),
        environment: BTreeMap::new(),
    };
    let mut bytes = Vec::new();
    let mut writer = Writer::new(&mut bytes);
    suite::run(plan, &options, &mut (), &mut |line| writer.write(line)).unwrap();
    writer.finish().unwrap();
    bytes
}

fn digest(bytes: &[u8]) -> String {
    Record::parse(bytes).unwrap().footer.unwrap().results_digest
}

const SQUARES: &str = "
laplacians = ['cotan', 'graph']
properties = ['SYM', 'POS0', 'PSD', 'RIGID']
claims = ['c81']
[[class]]
id = 'squares'
recipe = 'random-delaunay:n={n},seed={seed} | flip:count=4,seed={seed}'
count = 6
vary = { n = { from = 8, to = 30 } }
";

#[test]
fn the_digest_is_the_same_for_any_number_of_threads_and_on_a_second_run() {
    let plan = plan(SQUARES);
    let first = run(&plan, 1);
    for threads in [1, 2, 3] {
        let again = run(&plan, threads);
        assert_eq!(digest(&again), digest(&first));
        let lines = |bytes: &[u8]| -> Vec<String> {
            let text = String::from_utf8(bytes.to_vec()).unwrap();
            text.lines().filter(|line| !line.contains("\"line\":\"timing\"")).map(str::to_string).collect()
        };
        assert_eq!(lines(&again), lines(&first), "byte for byte but for the timing");
    }
}

#[test]
fn another_seed_draws_other_domains_and_breaks_no_promise() {
    let mut suite = parse(SQUARES);
    let first = run(&suite.plan().unwrap(), 2);
    suite.seed = 2;
    let second = run(&suite.plan().unwrap(), 2);
    assert_ne!(digest(&first), digest(&second));
    let promised = |bytes: &[u8]| {
        let cells = Record::parse(bytes).unwrap().cells;
        assert!(cells.iter().all(|c| c.as_expected));
        cells.iter().filter(|c| c.promised == Some(true)).count()
    };
    assert!(promised(&first) > 20 && promised(&second) > 20);
}

#[test]
fn lines_come_in_the_order_of_the_plan() {
    let plan = plan(SQUARES);
    let mut seen = Vec::new();
    let options = Options { root: PathBuf::new(), threads: Some(2), environment: BTreeMap::new() };
    suite::run(&plan, &options, &mut (), &mut |line| {
        seen.push(match line {
            Line::Domain(d) => format!("domain {}", d.recipe),
            Line::Operator(o) => format!("operator {} {}", o.laplacian, o.recipe),
            Line::Cell(c) => format!("cell {} {} {}", c.property, c.laplacian, c.recipe),
            Line::Header(_) => "header".into(),
            Line::Claim(c) => format!("claim {}", c.id),
            Line::Exhibit(_) | Line::Atlas(_) => return Ok(()),
            Line::Timing(_) => "timing".into(),
            Line::Broken(_) | Line::Footer(_) => panic!("neither is in this run"),
        });
        Ok(())
    })
    .unwrap();
    let mut expected = vec!["header".to_string()];
    for case in &plan.cases {
        expected.push(format!("domain {}", case.recipe));
        for choice in &case.choices {
            expected.push(format!("operator {choice} {}", case.recipe));
            expected.extend(case.properties.iter().map(|p| format!("cell {} {choice} {}", p.id, case.recipe)));
        }
    }
    expected.extend(["claim c81".into(), "timing".into()]);
    assert_eq!(seen, expected);
}

#[test]
fn a_larger_count_keeps_the_earlier_domains() {
    let (few, more) = (recipes(&plan(SQUARES)), recipes(&plan(&SQUARES.replace("count = 6", "count = 9"))));
    assert_eq!((few.len(), more.len()), (6, 9));
    assert_eq!(few, more[..6]);
}

#[test]
fn values_are_drawn_from_their_ranges_both_ends_included() {
    let plan = plan(
        "[[class]]\nid = 'a'\nrecipe = 'slivers:shape={s},columns={c},aspect={a},seed={seed}'\ncount = 200\n\
         vary = { s = ['needle', 'cap'], c = { from = 2, to = 4 }, a = { from = 1.5, to = 1.50001 } }",
    );
    let texts = recipes(&plan);
    let drawn = |key: &str| -> BTreeSet<String> {
        let value =
            |text: &String| text.split(&format!("{key}=")).nth(1).unwrap().split(',').next().unwrap().to_string();
        texts.iter().map(value).collect()
    };
    assert_eq!(drawn("columns").into_iter().collect::<Vec<_>>(), ["2", "3", "4"]);
    assert_eq!(drawn("shape").into_iter().collect::<Vec<_>>(), ["cap", "needle"]);
    assert!(drawn("aspect").iter().all(|a| (1.5..=1.50001).contains(&a.parse::<f64>().unwrap())));
    assert!(drawn("seed").len() > 190);
}

#[test]
fn a_domain_that_comes_twice_is_tried_once_with_all_that_was_asked() {
    let plan = plan(
        "properties = ['SYM', 'PSD']\n\
         [[class]]\nid = 'a'\nrecipe = 'grid:nx=2,ny={n}'\ncount = 40\nvary = { n = { from = 1, to = 2 } }\n\
         laplacians = ['cotan']\nwithout = ['PSD']\n\
         [[class]]\nid = 'b'\nrecipe = ' grid : ny=2, nx=2 '\nlaplacians = ['graph', 'cotan']\n",
    );
    assert_eq!(
        recipes(&plan).into_iter().collect::<BTreeSet<_>>(),
        ["grid:nx=2,ny=1".into(), "grid:nx=2,ny=2".into()].into()
    );
    assert_eq!(plan.cases.len(), 2);
    let twice = plan.cases.iter().position(|c| c.recipe.to_string() == "grid:nx=2,ny=2").unwrap();
    assert_eq!(labels(&plan, twice), ["cotan", "graph"]);
    assert_eq!(plan.cases[twice].properties.iter().map(|p| p.id).collect::<Vec<_>>(), ["SYM", "PSD"]);
    assert_eq!(plan.cases[twice].class, "a");
    assert_eq!((labels(&plan, 1 - twice), plan.cases[1 - twice].properties.len()), (vec!["cotan".to_string()], 1));
    // The record has each cell once: a reader takes a second one for damage.
    Record::parse(&run(&plan, 2)).unwrap();
}

#[test]
fn names_that_are_left_out_stand_for_the_whole_catalogue() {
    let grid = "[[class]]\nid = 'a'\nrecipe = 'grid'\n";
    let all: Vec<&str> = laplacian::ALL.iter().map(|l| l.id).collect();
    let whole = plan(grid);
    assert_eq!(labels(&whole, 0), all);
    assert_eq!(whole.cases[0].properties.len(), property::ALL.len());
    assert!(whole.claims.is_empty());
    let named = plan(&format!(
        "laplacians = ['three-point: p = 2', 'others', 'cotan', 'cotan:mass=mixed', 'cotan']\n\
         properties = ['PSD', 'others']\nclaims = ['c81', 'others']\n{grid}"
    ));
    let others: Vec<&str> = all.iter().copied().filter(|id| !["three-point", "cotan"].contains(id)).collect();
    assert_eq!(labels(&named, 0), [&["three-point:p=2"][..], &others, &["cotan", "cotan:mass=mixed"]].concat());
    let properties: Vec<&str> = named.cases[0].properties.iter().map(|p| p.id).collect();
    assert_eq!((properties[0], properties.len()), ("PSD", property::ALL.len()));
    let known = claims::all().unwrap();
    assert_eq!((named.claims[0].id.as_str(), named.claims.len()), ("c81", known.len()));
}

#[test]
fn what_a_suite_names_must_exist_and_make_sense() {
    let class = |lines: &str| format!("[[class]]\nid = 'a'\n{lines}\n");
    for (lines, message) in [
        (
            "laplacians = ['cotangent']\n[[class]]\nid = 'a'\nrecipe = 'grid'".to_string(),
            "there is no operator 'cotangent'; 'lapjury list laplacians' names",
        ),
        (
            "laplacians = ['cotan:mass=heavy']\n[[class]]\nid = 'a'\nrecipe = 'grid'".into(),
            "parameter 'mass' of 'cotan' is 'heavy'; it must be one of",
        ),
        (
            "properties = ['PSDD']\n[[class]]\nid = 'a'\nrecipe = 'grid'".into(),
            "there is no property 'PSDD'; 'lapjury list properties' names",
        ),
        ("claims = ['c0']".into(), "there is no claim 'c0'; 'lapjury list claims' names"),
        (class("recipe = 'grid'\nwithout = ['PSDD']"), "there is no property 'PSDD'"),
        (class("recipe = 'grid'\nlaplacians = ['cotangent']"), "there is no operator 'cotangent'"),
        (class("recipe = 'gird'"), "class 'a' of suite 'test': 'gird' is neither a generator nor a mesh file"),
        (class("recipe = 'grid:nx'"), "'nx' in 'grid:nx' is not a setting"),
        (class("files = ['mesh.jpg']"), "'mesh.jpg' is neither a generator nor a mesh file"),
        (class(""), "class 'a' of suite 'test' needs a recipe or files"),
        (class("recipe = 'grid'\nfiles = ['mesh.off']"), "has both a recipe and files"),
        (class("files = ['mesh.off']\nvary = { n = ['1'] }"), "varies files, which have nothing to vary"),
        (class("recipe = 'grid'\nvary = { n = ['1'] }"), "varies 'n', which its recipe does not name"),
        (class("recipe = 'grid:nx={n},ny={m}'\nvary = { n = ['1'] }"), "does not vary what its recipe names at '{m}'"),
        (class("recipe = 'grid:nx={n}'\nvary = { n = [] }"), "draws 'n' from an empty range"),
        (class("recipe = 'grid:nx={n}'\nvary = { n = { from = 3, to = 2 } }"), "draws 'n' from an empty range"),
        (class("recipe = 'grid:nx={n}'\nvary = { n = { from = nan, to = 2.0 } }"), "draws 'n' from an empty range"),
        (
            class("recipe = 'grid'") + &class("recipe = 'path'"),
            "class 'a' of suite 'test' has the id of an earlier one",
        ),
        (String::new(), "suite 'test' selects nothing"),
        (format!("laplacians = []\n{}", class("recipe = 'grid'")), "suite 'test' selects nothing"),
    ] {
        assert!(refusal(&lines).contains(message), "{lines}\n{}", refusal(&lines));
    }
    for (text, message) in [
        ("id = 'x'\ntitle = 'x'\nseed = 1\ncolour = 'red'", "unknown field `colour`"),
        ("id = 'x'\ntitle = 'x'\nseed = 1\n[[class]]\nid = 'a'\nrecipes = 'grid'", "unknown field `recipes`"),
        ("id = 'x'\ntitle = 'x'", "missing field `seed`"),
        ("id = ", "suite 'x': TOML parse error"),
    ] {
        let error = Suite::parse("x", text).expect_err(text).to_string();
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn the_built_in_suites_plan_with_every_operator_and_property_and_claims_that_exist() {
    for (id, text) in BUILT_IN {
        let suite = Suite::built_in(id).unwrap();
        assert_eq!(suite.id, *id);
        let plan = suite.plan().unwrap_or_else(|error| panic!("{error}"));
        let names = |all: &mut dyn Iterator<Item = &'static str>| all.collect::<BTreeSet<_>>();
        let tried = names(&mut plan.cases.iter().flat_map(|c| c.choices.iter().map(|choice| choice.laplacian.id)));
        assert_eq!(tried, names(&mut laplacian::ALL.iter().map(|l| l.id)), "operators of {id}");
        let asked = names(&mut plan.cases.iter().flat_map(|c| c.properties.iter().map(|p| p.id)));
        assert_eq!(asked, names(&mut property::ALL.iter().map(|p| p.id)), "properties of {id}");
        assert!(!plan.claims.is_empty() && !text.contains("count = 0"));
        for class in suite.classes.iter().flat_map(|c| &c.files) {
            assert!(PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(class).exists(), "{class}");
        }
    }
    assert!(Suite::built_in("primer").unwrap().plan().unwrap().cases.len() > 1000);
    assert!(Suite::built_in("prime").is_err_and(|e| e.to_string().contains("'lapjury list suites'")));
}

#[test]
fn every_built_in_claim_has_an_id_of_its_own_and_a_test_of_its_stated_form() {
    let all = claims::all().unwrap();
    let ids: BTreeSet<&str> = all.iter().map(|c| c.id.as_str()).collect();
    assert_eq!(ids.len(), all.len());
    for claim in &all {
        assert!(claim.tests.iter().any(|t| t.form == claims::Form::Stated), "{}", claim.id);
        let amended = claim.tests.iter().any(|t| t.form == claims::Form::Amended);
        assert_eq!(
            claim.amendment.is_some(),
            amended,
            "{}: an amendment has tests, and tests have an amendment",
            claim.id
        );
    }
    let text: String = claims::BUILT_IN.iter().map(|(_, text)| *text).collect();
    for entry in experiment::ALL {
        for part in entry.parts {
            let named = text.contains(&format!("experiment = \"{}\"\npart = \"{part}\"", entry.id));
            assert!(named, "no claim asks {}/{part}", entry.id);
        }
    }
}

#[test]
fn narrowed_to_its_claims_a_plan_comes_to_the_same_outcomes() {
    let lines = SQUARES.replace("'c81'", "'c36', 'c70', 'c81'");
    let whole = plan(&lines);
    let mut narrow = plan(&lines);
    narrow.narrow();
    let asked: BTreeSet<&str> = narrow.cases.iter().flat_map(|c| c.properties.iter().map(|p| p.id)).collect();
    assert_eq!(asked.into_iter().collect::<Vec<_>>(), ["POS0", "PSD", "SYM"]);
    let [a, b] = [&whole, &narrow].map(|plan| Record::parse(&run(plan, 2)).unwrap());
    assert_eq!(a.claims, b.claims);
    assert!(b.cells.len() < a.cells.len());
    let mut experiments = plan(SQUARES);
    experiments.narrow();
    assert!(experiments.cases.is_empty(), "c81 asks no cell");
}
