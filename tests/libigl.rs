//! libigl's matrices on trial: `fixtures/operators/libigl`, written by `scripts/export_libigl.py`, no Python needed here.

use std::path::{Path, PathBuf};

use lapjury::domain::Domain;
use lapjury::exchange::{read_domain, read_matrix, write_matrix_market};
use lapjury::external::{Comparison, DeclaredSign, compare, read_operator};
use lapjury::laplacian;
use lapjury::linalg::Csr;
use lapjury::operator::{Mass, MassKind, Operator, Provenance};
use lapjury::property::tolerance::{Judgement, Scales};
use lapjury::property::{self, Status, Tally, Trial, Verdict, recheck};
use serde_json::Value;
use sha2::{Digest, Sha256};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn folder() -> PathBuf {
    root().join("fixtures/operators/libigl")
}

/// A mesh with libigl's matrices, in libigl's sign.
struct Fixture {
    name: String,
    domain: Domain,
    stiffness: PathBuf,
    entry: Value,
}

impl Fixture {
    fn all() -> Vec<Fixture> {
        let manifest = std::fs::read_to_string(folder().join("manifest.json")).unwrap();
        let manifest: Value = serde_json::from_str(&manifest).unwrap();
        manifest["meshes"].as_array().unwrap().iter().map(Fixture::read).collect()
    }

    fn named(name: &str) -> Fixture {
        Fixture::all().into_iter().find(|f| f.name == name).unwrap()
    }

    fn read(entry: &Value) -> Fixture {
        let mesh = root().join(entry["mesh"].as_str().unwrap());
        Fixture {
            name: mesh.file_stem().unwrap().to_str().unwrap().to_string(),
            domain: read_domain(&mesh).unwrap_or_else(|e| panic!("{e}")),
            stiffness: folder().join(entry["stiffness"].as_str().unwrap()),
            entry: entry.clone(),
        }
    }

    fn mass_path(&self, kind: &str) -> PathBuf {
        folder().join(self.entry["masses"][kind]["file"].as_str().unwrap())
    }

    fn mass(&self, kind: &str) -> Csr {
        read_matrix(&self.mass_path(kind)).unwrap().matrix
    }

    /// As `check --stiffness L --mass M` reads it.
    fn operator(&self, mass: &str) -> Operator {
        read_operator(&self.stiffness, Some(&self.mass_path(mass)), DeclaredSign::Auto, 1.0).unwrap()
    }

    fn ours(&self, mass: &str) -> Operator {
        let cotan = laplacian::find("cotan").unwrap();
        cotan.build(&self.domain, &[("mass".to_string(), mass.to_string())].into()).unwrap()
    }

    fn is_planar(&self) -> bool {
        self.domain.facts().surface.unwrap().planar
    }
}

/// The verdict; evidence that does not survive the recheck is a bug.
fn judge(id: &str, domain: &Domain, operator: &Operator) -> Verdict {
    let trial = Trial::new(domain, operator, 1).unwrap();
    let verdict = property::find(id).unwrap().decide(&trial, None);
    if let Err(refusal) = recheck::of_verdict(&verdict, id, domain, operator) {
        panic!("{id}: {refusal}");
    }
    verdict
}

fn status(id: &str, domain: &Domain, operator: &Operator) -> Status {
    judge(id, domain, operator).status()
}

fn sha256(path: &Path) -> String {
    let digest = Sha256::digest(std::fs::read(path).unwrap());
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn every_file_is_the_one_of_the_manifest() {
    let fixtures = Fixture::all();
    assert_eq!(fixtures.len(), 8);
    for f in &fixtures {
        assert_eq!(sha256(&root().join(f.entry["mesh"].as_str().unwrap())), f.entry["sha256"], "{}", f.name);
        assert_eq!(sha256(&f.stiffness), f.entry["stiffness_sha256"], "{}", f.name);
        for kind in ["barycentric", "voronoi", "full"] {
            assert_eq!(sha256(&f.mass_path(kind)), f.entry["masses"][kind]["sha256"], "{} {kind}", f.name);
        }
    }
}

#[test]
fn the_sign_is_detected_and_said() {
    for f in Fixture::all() {
        let notes = f.operator("barycentric").provenance().notes.clone();
        assert!(notes.contains(&"sign: negative semi-definite (read off the diagonal)".to_string()), "{notes:?}");
        assert!(notes.iter().any(|n| n.starts_with("every entry was multiplied by −1")), "{notes:?}");
        let theirs = read_matrix(&f.stiffness).unwrap().matrix;
        assert!((0..theirs.rows()).all(|i| theirs.at(i, i) < 0.0), "{}", f.name);
        let declared = read_operator(&f.stiffness, None, DeclaredSign::Psd, 1.0).unwrap_err().to_string();
        assert!(declared.contains("declared positive semi-definite"), "{declared}");
    }
}

#[test]
fn cotmatrix_keeps_every_promise_without_a_flag() {
    for f in Fixture::all() {
        let operator = f.operator("barycentric");
        for id in ["FIN", "LOC", "SYM", "NULL", "KER", "PSD", "ENERGY"] {
            assert_eq!(status(id, &f.domain, &operator), Status::Holds, "{} {id}", f.name);
        }
        let flat = if f.is_planar() { Status::Holds } else { Status::NotApplicable };
        for id in ["LIN", "FLUX"] {
            assert_eq!(status(id, &f.domain, &operator), flat, "{} {id}", f.name);
        }
    }
}

fn tally(id: &str, domain: &Domain, operator: &Operator) -> Tally {
    judge(id, domain, operator).tally.unwrap_or_default()
}

#[test]
fn its_negative_weights_are_the_violated_edges_that_no_rounding_made() {
    for f in Fixture::all() {
        let (theirs, ours) = (f.operator("barycentric"), f.ours("barycentric"));
        let facts = f.domain.facts().surface.unwrap();
        let (violated, near) = (facts.non_delaunay_edges.unwrap(), facts.non_delaunay_within_rounding.unwrap());
        let (read, built) = (tally("POS", &f.domain, &theirs), tally("POS", &f.domain, &ours));
        assert_eq!((built.violations, built.undecided), (violated, 0), "{}", f.name);
        assert_eq!(read.violations, violated - near, "{}", f.name);
        // What it does not call negative it leaves open, or has as a zero.
        assert!(near + built.zeros <= read.zeros + read.undecided, "{}: {read:?} {built:?}", f.name);
        assert_eq!(
            tally("POS-boundary", &f.domain, &theirs),
            tally("POS-boundary", &f.domain, &ours),
            "{}: a single cotangent has no cancellation",
            f.name
        );
    }
}

#[test]
fn every_weight_with_a_clear_sign_has_the_exact_sign() {
    for f in Fixture::all() {
        let (theirs, ours) = (f.operator("barycentric"), f.ours("barycentric"));
        let scales = Scales::of(&f.domain, theirs.stiffness());
        let mut open = 0;
        for (e, &[i, j]) in f.domain.edges().iter().enumerate() {
            let (x, exact) = (theirs.stiffness().at(i, j), ours.stiffness().at(i, j));
            match scales.sign(i, x, Some(e)).judge(x.abs()) {
                Judgement::Defect => assert_eq!(x > 0.0, exact > 0.0, "{}: edge {i} {j}", f.name),
                _ => open += 1,
            }
        }
        let facts = f.domain.facts().surface.unwrap();
        let near = facts.non_delaunay_within_rounding.unwrap() + facts.cocircular_edges.unwrap();
        assert!(open >= near && (near > 0 || open == 0), "{}: {open} open, {near} near cocircular", f.name);
    }
}

#[test]
fn no_entry_differs_from_ours_beyond_the_bound_of_the_mesh() {
    for f in Fixture::all() {
        let c = compare(&f.domain, &f.operator("barycentric"), &f.ours("barycentric"), "cotan");
        let stored = f.domain.vertex_count() + 2 * f.domain.edges().len();
        assert_eq!(c.identical + c.explained + c.open + c.beyond, c.entries, "{c}");
        assert!(c.entries <= stored && c.beyond == 0, "{}: {c}", f.name);
        // Its cotangents come from edge lengths, which costs a factor 1/sin θ_min: nothing to see above two degrees.
        if f.domain.facts().surface.unwrap().min_angle_deg > 2.0 {
            assert_eq!((c.entries, c.open), (stored, 0), "{}: {c}", f.name);
        }
    }
}

/// Which mass of ours each of libigl's is.
const MASSES: [(&str, MassKind); 3] =
    [("barycentric", MassKind::Barycentric), ("voronoi", MassKind::Mixed), ("full", MassKind::Consistent)];

#[test]
fn its_masses_are_ours_entry_by_entry_and_its_voronoi_is_the_mixed_one() {
    for f in Fixture::all() {
        for (name, kind) in MASSES {
            let (theirs, ours) = (f.mass(name), f.ours(kind.name()));
            let ours = ours.mass().unwrap().matrix();
            // A sum of positive areas: its condition is that of the triangles around the row's vertex.
            let scales = Scales::of(&f.domain, ours);
            for (i, j, &x) in theirs.entries() {
                let difference = (x - ours.at(i, j)).abs();
                let threshold = scales.combination(i, ours.at(i, j).abs());
                assert_ne!(threshold.judge(difference), Judgement::Defect, "{} {name} {i} {j}", f.name);
            }
            assert_eq!(theirs.entries().filter(|e| *e.2 != 0.0).count(), ours.stored(), "{} {name}", f.name);
        }
    }
}

#[test]
fn each_mass_passes_as_given_and_as_the_one_it_is() {
    for f in Fixture::all() {
        for (name, kind) in MASSES {
            let given = f.operator(name);
            let verdict = judge("MASS", &f.domain, &given);
            assert_eq!(verdict.status(), Status::Holds, "{} {name}: {verdict:?}", f.name);
            let looks = if kind == MassKind::Mixed { "the mixed mass" } else { "the barycentric or consistent mass" };
            assert!(verdict.notes.contains(&format!("looks like {looks}")), "{} {name}: {:?}", f.name, verdict.notes);
            let declared = |kind| given.clone().with_mass(Mass::full(kind, f.mass(name))).unwrap();
            assert_eq!(status("MASS", &f.domain, &declared(kind)), Status::Holds, "{} {name}", f.name);
            // There is an obtuse triangle in each mesh, and there the circumcentric mass is another one.
            assert_eq!(status("MASS", &f.domain, &declared(MassKind::Voronoi)), Status::Fails, "{} {name}", f.name);
        }
    }
}

// ── planted faults ───────────────────────────────────────────────────────────────────────────────────────────────────

/// The properties that a planar matrix is held against here.
const HELD: [&str; 6] = ["LOC", "SYM", "NULL", "LIN", "ENERGY", "FLUX"];

/// A matrix of libigl's with a mistake, written to a file and read as anyone's; what fails, and the comparison with ours.
fn convicted(f: &Fixture, matrix: &Csr) -> (Vec<&'static str>, Comparison) {
    let file = tempfile::Builder::new().suffix(".mtx").tempfile().unwrap();
    std::fs::write(file.path(), write_matrix_market(matrix)).unwrap();
    let operator = read_operator(file.path(), None, DeclaredSign::Auto, 1.0).unwrap();
    let failing = HELD.into_iter().filter(|id| status(id, &f.domain, &operator) == Status::Fails).collect();
    (failing, compare(&f.domain, &operator, &f.ours("barycentric"), "cotan"))
}

/// The fixture, its matrix in libigl's sign, and the interior edge with the best-conditioned ends, neither of them next to
/// the boundary.
fn accused() -> (Fixture, Csr, [usize; 2]) {
    let f = Fixture::named("flipped");
    let matrix = read_matrix(&f.stiffness).unwrap().matrix;
    let mut near = f.domain.boundary().to_vec();
    for &[i, j] in f.domain.edges() {
        let at_boundary = f.domain.boundary()[i] || f.domain.boundary()[j];
        near[i] |= at_boundary;
        near[j] |= at_boundary;
    }
    let scales = Scales::of(&f.domain, &matrix);
    let condition = |[i, j]: [usize; 2]| scales.condition(i).max(scales.condition(j));
    let inner = f.domain.edges().iter().copied().filter(|e| e.iter().all(|&v| !near[v]));
    let edge = inner.min_by(|a, b| condition(*a).total_cmp(&condition(*b))).unwrap();
    (f, matrix, edge)
}

/// With `delta` added to the listed entries.
fn with(matrix: &Csr, changes: &[(usize, usize, f64)]) -> Csr {
    matrix.add(&Csr::from_triplets(matrix.rows(), matrix.columns(), changes))
}

/// With `delta` added to the weight of an edge and the diagonal following.
fn with_weight(matrix: &Csr, [i, j]: [usize; 2], delta: f64) -> Csr {
    with(matrix, &[(i, j, delta), (j, i, delta), (i, i, -delta), (j, j, -delta)])
}

#[test]
fn without_a_fault_nothing_fails() {
    let (f, matrix, [i, j]) = accused();
    let (failing, comparison) = convicted(&f, &matrix);
    assert!(failing.is_empty() && comparison.beyond == 0, "{failing:?} {comparison}");
    assert!(!f.domain.boundary()[i] && !f.domain.boundary()[j] && matrix.at(i, j) != 0.0);
}

#[test]
fn a_weight_with_the_wrong_sign_is_caught_by_row_sums_linear_precision_energy_and_comparison() {
    let (f, matrix, [i, j]) = accused();
    let delta = -2.0 * matrix.at(i, j);
    let (failing, comparison) = convicted(&f, &with(&matrix, &[(i, j, delta), (j, i, delta)]));
    assert_eq!((failing, comparison.beyond), (vec!["NULL", "LIN", "ENERGY"], 2));
}

#[test]
fn a_weight_with_the_wrong_sign_and_a_diagonal_that_follows_is_caught_without_row_sums() {
    let (f, matrix, edge) = accused();
    let (failing, comparison) = convicted(&f, &with_weight(&matrix, edge, -2.0 * matrix.at(edge[0], edge[1])));
    assert_eq!((failing, comparison.beyond), (vec!["LIN", "ENERGY"], 4));
}

#[test]
fn one_entry_off_by_a_billionth_is_caught_by_symmetry_row_sum_and_linear_precision() {
    let (f, matrix, [i, j]) = accused();
    let (failing, comparison) = convicted(&f, &with(&matrix, &[(i, j, 1e-9)]));
    // A sum over the whole mesh, as ENERGY is, need not notice.
    assert_eq!((&failing[..3], comparison.beyond), (&["SYM", "NULL", "LIN"][..], 1));
    let worst = comparison.worst.unwrap();
    assert_eq!((worst.i, worst.j), (i, j));
    assert!((worst.theirs - worst.ours + 1e-9).abs() < 1e-13, "{worst:?}");
}

#[test]
fn a_missing_transposed_entry_is_caught_by_symmetry() {
    let (f, matrix, [i, j]) = accused();
    let without = matrix.entries().filter(|&(a, b, _)| (a, b) != (j, i)).map(|(a, b, v)| (a, b, *v));
    let without = Csr::from_triplets(matrix.rows(), matrix.columns(), &without.collect::<Vec<_>>());
    assert_eq!(without.stored() + 1, matrix.stored());
    let (failing, comparison) = convicted(&f, &without);
    assert_eq!((failing, comparison.beyond), (vec!["SYM", "NULL", "LIN", "ENERGY"], 1));
    assert_eq!(comparison.worst.map(|w| (w.i, w.j)), Some((j, i)));
}

#[test]
fn halved_boundary_weights_are_caught_by_flux_and_energy_only() {
    // Rows of interior vertices have no boundary edge, so linear precision cannot see it.
    let (f, matrix, _) = accused();
    let topology = f.domain.as_surface().unwrap().topology();
    let boundary = (0..f.domain.edges().len()).filter(|&e| topology.is_boundary_edge(e)).map(|e| f.domain.edges()[e]);
    let boundary: Vec<[usize; 2]> = boundary.collect();
    let halved = boundary.iter().fold(matrix.clone(), |m, &e| with_weight(&m, e, -0.5 * matrix.at(e[0], e[1])));
    let (failing, comparison) = convicted(&f, &halved);
    assert_eq!(failing, ["ENERGY", "FLUX"]);
    // Two entries for each boundary edge, one for each boundary vertex.
    assert_eq!(comparison.beyond, 3 * boundary.len());
}

#[test]
fn a_factor_on_the_whole_matrix_is_caught_by_energy_and_flux_and_named() {
    let (f, matrix, _) = accused();
    let doubled = matrix.map(|_, _, v| 2.0 * v);
    let (failing, comparison) = convicted(&f, &doubled);
    assert_eq!((failing, comparison.beyond), (vec!["ENERGY", "FLUX"], comparison.entries));
}

#[test]
fn two_exchanged_vertices_are_caught_by_locality() {
    let (f, matrix, [i, j]) = accused();
    let far = (0..matrix.rows()).find(|&k| !f.domain.boundary()[k] && matrix.get(i, k).is_none()).unwrap();
    let exchange = |v: usize| {
        if v == i {
            far
        } else if v == far {
            i
        } else {
            v
        }
    };
    let entries: Vec<_> = matrix.entries().map(|(a, b, v)| (exchange(a), exchange(b), *v)).collect();
    let (failing, comparison) = convicted(&f, &Csr::from_triplets(matrix.rows(), matrix.columns(), &entries));
    assert!(failing.contains(&"LOC") && failing.contains(&"ENERGY"), "{failing:?}");
    assert!(!failing.contains(&"SYM") && !failing.contains(&"NULL"), "renumbering keeps these: {failing:?}");
    assert!(comparison.beyond > 0 && matrix.get(i, j).is_some());
}

#[test]
fn masses_at_the_wrong_vertices_are_caught_by_their_shares_though_the_total_is_right() {
    let (f, matrix, _) = accused();
    let diagonal: Vec<f64> = (0..matrix.rows()).map(|i| f.mass("barycentric").at(i, i)).collect();
    let mut turned = diagonal.clone();
    turned.rotate_left(1);
    let judged = |masses: &[f64]| {
        let operator = Operator::new(matrix.map(|_, _, v| -v), Provenance::default()).unwrap();
        let operator = operator.with_mass(Mass::lumped(MassKind::Given, masses)).unwrap();
        status("MASS", &f.domain, &operator)
    };
    assert_eq!((judged(&diagonal), judged(&turned)), (Status::Holds, Status::Fails));
}

#[test]
fn the_weights_of_libigl_are_as_accurate_as_rounding_allows_and_the_verdict_says_how_accurate() {
    for fixture in Fixture::all() {
        let verdict = judge("ACC", &fixture.domain, &fixture.operator("voronoi"));
        let reason = verdict.reason().unwrap_or_default().to_string();
        println!("{}: {} {:?} {reason} {:?}", fixture.name, verdict.status(), verdict.margin, verdict.notes);
        assert!(matches!(verdict.status(), Status::Holds | Status::Undecided), "{}: {verdict:?}", fixture.name);
        assert!(verdict.notes.iter().any(|note| note.contains(" ulp")), "{}: {:?}", fixture.name, verdict.notes);
    }
}
