//! `check` with matrices from files, and `export`, which writes such files.

use crate::{Ran, Scratch, lapjury};

/// The cotangent Laplacian of the unit square with its centre (vertex 4), by hand: each spoke has two opposite angles of 45°,
/// so that its weight is ½ (1 + 1) = 1; each side has one of 90°, so that its weight is 0.
const SQUARE: &str = "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";

/// The entries above, times a factor.
fn stiffness(factor: f64) -> String {
    let spokes = (1..=4).map(|i| format!("{i} {i} {factor}\n{i} 5 {0}\n5 {i} {0}\n", -factor));
    format!(
        "%%MatrixMarket matrix coordinate real general\n5 5 13\n{}5 5 {}\n",
        spokes.collect::<String>(),
        4.0 * factor
    )
}

/// A scratch directory with the mesh, and a check of the matrix written there.
struct Bench(Scratch);

impl Bench {
    fn new() -> Self {
        let scratch = Scratch::new();
        scratch.file("square.off", SQUARE);
        Bench(scratch)
    }

    fn check(&self, matrix: &str, more: &[&str]) -> Ran {
        let (mesh, stiffness) = (self.0.at("square.off"), self.0.file("L.mtx", matrix));
        lapjury(&[&["check", "--mesh", &mesh, "--stiffness", &stiffness], more].concat())
    }
}

const PROMISES: [&str; 2] = ["--promises", "FIN,LOC,SYM,NULL,KER,POS,POS0,PSD,LIN,MVP,MAX-local"];

#[test]
fn either_sign_is_read_off_converted_and_said_and_a_wrong_declaration_is_an_error() {
    let bench = Bench::new();
    let positive = bench.check(&stiffness(1.0), &PROMISES).ends_with(0).out;
    assert!(positive.contains("sign: positive semi-definite (read off the diagonal)"), "{positive}");
    let negative = bench.check(&stiffness(-1.0), &PROMISES).ends_with(0).out;
    assert!(negative.contains("sign: negative semi-definite (read off the diagonal)"), "{negative}");
    assert!(negative.contains("every entry was multiplied by −1"), "{negative}");
    let declared = bench.check(&stiffness(-1.0), &["--sign", "nsd", "--property", "PSD"]).ends_with(0).out;
    assert!(declared.contains("sign: negative semi-definite (as declared)"), "{declared}");
    bench.check(&stiffness(1.0), &["--sign", "psd"]).ends_with(0);
    for (factor, sign) in [(1.0, "nsd"), (-1.0, "psd")] {
        let err = bench.check(&stiffness(factor), &["--sign", sign]).ends_with(2).err;
        assert!(
            err.contains("5 of its 5 non-zero diagonal entries say the opposite; correct the declaration"),
            "{err}"
        );
    }
}

#[test]
fn a_declared_scale_is_divided_out_and_an_undeclared_one_seen() {
    let bench = Bench::new();
    let against = ["--against", "cotan", "--property", "SYM"];
    let scaled = bench.check(&stiffness(-2.0), &[&against[..], &["--scale", "2"]].concat()).ends_with(0).out;
    assert!(scaled.contains("every entry was divided by the declared scale 2"), "{scaled}");
    assert!(scaled.contains("against cotan: 13 entries, 13 identical"), "{scaled}");
    let undeclared = bench.check(&stiffness(-2.0), &against).ends_with(1).out;
    assert!(undeclared.contains("0 identical") && undeclared.contains("13 beyond"), "{undeclared}");
    for scale in ["0", "-1", "nan", "inf"] {
        let err = bench.check(&stiffness(1.0), &[&format!("--scale={scale}")]).ends_with(2).err;
        assert!(err.contains("must be a positive finite number"), "{err}");
    }
}

#[test]
fn a_mass_is_read_as_a_matrix_or_as_a_column() {
    let bench = Bench::new();
    // A third of the area of the triangles at each vertex: two of area ¼ at a corner, four at the centre.
    let (corner, centre) = (1.0 / 6.0, 1.0 / 3.0);
    let diagonal: String = (1..=4).map(|i| format!("{i} {i} {corner}\n")).collect();
    let matrix = format!("%%MatrixMarket matrix coordinate real general\n5 5 5\n{diagonal}5 5 {centre}\n");
    let column = format!("%%MatrixMarket matrix array real general\n5 1\n{0}\n{0}\n{0}\n{0}\n{centre}\n", corner);
    for (name, text) in [("matrix.mtx", &matrix), ("column.mtx", &column)] {
        let mass = bench.0.file(name, text);
        let json = bench
            .check(&stiffness(1.0), &["--mass", &mass, "--promises", "MASS", "--format", "json"])
            .ends_with(0)
            .json();
        assert!((json["operator"]["mass_total"].as_f64().unwrap() - 1.0).abs() < 1e-15, "{name}");
    }
    let negative = bench.0.file("negative.mtx", &column.replace(&centre.to_string(), "-1"));
    bench.check(&stiffness(1.0), &["--mass", &negative, "--promises", "MASS"]).ends_with(1);
    let short = bench.0.file("short.mtx", "%%MatrixMarket matrix array real general\n2 1\n1\n1\n");
    let err = bench.check(&stiffness(1.0), &["--mass", &short]).ends_with(2).err;
    assert!(err.contains("the mass matrix has 2 rows, the stiffness matrix 5"), "{err}");
}

#[test]
fn one_nan_fails_fin_and_nothing_else_can_be_asked() {
    let bench = Bench::new();
    let broken = stiffness(1.0).replacen("1 5 -1", "1 5 nan", 1);
    let json = bench.check(&broken, &["--format", "json"]).ends_with(0).json();
    for verdict in json["verdicts"].as_array().unwrap() {
        let expected = if verdict["property"] == "FIN" { "fails" } else { "not-applicable" };
        assert_eq!(verdict["status"], expected, "{verdict}");
    }
    assert_eq!(json["verdicts"][0]["witness"]["statement"]["value"], "NaN");
    bench.check(&broken, &["--promises", "FIN"]).ends_with(1);
    // Whatever is promised takes finite entries for granted.
    bench.check(&broken, &["--promises", "SYM"]).ends_with(1);
}

#[test]
fn what_rounding_leaves_open_of_a_promise_ends_with_3() {
    // Between what rounding explains of two entries with opposite angles of 45°, 40u, and what only a defect does, 40√2 · 4u.
    let open = stiffness(1.0).replacen("5 1 -1", "5 1 -1.00000000000001", 1);
    Bench::new().check(&open, &["--promises", "SYM"]).ends_with(3);
    let beyond = stiffness(1.0).replacen("5 1 -1", "5 1 -1.0000000000001", 1);
    Bench::new().check(&beyond, &["--promises", "SYM"]).ends_with(1);
}

#[test]
fn a_promise_that_says_nothing_on_the_mesh_is_not_broken() {
    let bench = Bench::new();
    let json = bench.check(&stiffness(1.0), &["--promises", "FLUX,SYM,MASS", "--format", "json"]).json();
    let status = |id: &str| {
        let verdicts = json["verdicts"].as_array().unwrap();
        verdicts.iter().find(|v| v["property"] == id).map(|v| v["status"].clone()).unwrap()
    };
    // No mass was given.
    assert_eq!((status("MASS"), status("SYM")), ("not-applicable".into(), "holds".into()));
    bench.check(&stiffness(1.0), &["--promises", "FLUX,SYM,MASS"]).ends_with(0);
}

#[test]
fn a_matrix_of_another_size_is_refused_with_the_likely_reason() {
    let bench = Bench::new();
    let identity = |n: usize| {
        let entries: String = (1..=n).map(|i| format!("{i} {i} 1\n")).collect();
        format!("%%MatrixMarket matrix coordinate real general\n{n} {n} {n}\n{entries}")
    };
    for (rows, reason) in [
        (1, "probably the boundary was removed; export the whole matrix"),
        (4, "there is one row for each face"),
        (8, "there is one row for each edge"),
        (3, "vertices were probably welded or unreferenced ones dropped"),
        (6, "the matrix probably belongs to another mesh"),
    ] {
        let err = bench.check(&identity(rows), &[]).ends_with(2).err;
        assert!(
            err.contains(&format!("the matrix has {rows} rows, the domain 5 vertices: ")) && err.contains(reason),
            "{err}"
        );
    }
    let err = bench.check("%%MatrixMarket matrix coordinate real general\n5 4 1\n1 1 1\n", &[]).ends_with(2).err;
    assert!(err.contains("5×4; it must be square"), "{err}");
}

#[test]
fn relations_between_constructions_are_not_asked_of_a_matrix() {
    let json = Bench::new().check(&stiffness(1.0), &["--property", "PERM,SYM", "--format", "json"]).ends_with(0).json();
    assert_eq!((&json["verdicts"][0]["property"], &json["verdicts"][0]["status"]), (&"SYM".into(), &"holds".into()));
    assert_eq!(json["verdicts"][1]["status"], "not-applicable");
    assert!(json["verdicts"][1]["reason"].as_str().unwrap().contains("came as a matrix"));
}

#[test]
fn sign_and_scale_are_for_matrices_only() {
    let err = lapjury(&["check", "--domain", "grid", "--laplacian", "cotan", "--scale", "2"]).ends_with(2).err;
    assert!(err.contains("cannot be used with"), "{err}");
}

#[test]
fn what_export_writes_check_reads_bit_for_bit() {
    for (laplacian, domain) in [
        ("cotan", "random-delaunay:n=40,seed=3"),
        ("cotan:mass=consistent", "fixtures/meshes/bob_small.ply"),
        ("mean-value", "random-delaunay:n=30,seed=9 | flip:count=9"),
        ("intrinsic-delaunay", "icosphere:levels=1 | flip:count=20"),
        ("weighted-graph", "gnp:n=12,p=0.4 | random-weights"),
    ] {
        let scratch = Scratch::new();
        lapjury(&["export", laplacian, domain, "--out", &scratch.at("v1.2")]).ends_with(0);
        let mesh = if laplacian == "weighted-graph" { "v1.2.mtx" } else { "v1.2.off" };
        let (mesh, stiffness, mass) = (scratch.at(mesh), scratch.at("v1.2.L.mtx"), scratch.at("v1.2.M.mtx"));
        let check = [
            "check",
            "--mesh",
            &mesh,
            "--stiffness",
            &stiffness,
            "--mass",
            &mass,
            "--against",
            laplacian,
            "--sign",
            "psd",
        ];
        let json = lapjury(&[&check[..], &["--property", "FIN", "--format", "json"]].concat()).ends_with(0).json();
        let comparison = &json["comparison"];
        assert!(comparison["entries"].as_u64().unwrap() > 20, "{laplacian}: {comparison}");
        assert_eq!(comparison["identical"], comparison["entries"], "{laplacian}: {comparison}");
        assert!(!mesh.ends_with(".off") || json["domain"]["digest"] == digest(domain), "{laplacian}");
    }
}

/// The digest of a domain made here.
fn digest(recipe: &str) -> String {
    recipe.parse::<lapjury::suite::Recipe>().unwrap().build(crate::root()).unwrap().digest()
}
