//! Round trips through files, and readers under fire: nothing may panic, hang, or be read in part.

use std::cell::Cell;
use std::io::Write;
use std::path::Path;

use lapjury::domain::{Domain, Graph, PointCloud, Surface, Volume};
use lapjury::exchange::{
    Format, parse_domain, parse_matrix, read_domain, read_matrix, write_graph, write_matrix_market, write_medit,
    write_obj, write_off, write_xyz,
};
use lapjury::linalg::Csr;
use proptest::collection::vec;
use proptest::num::f64::{ANY, INFINITE, NEGATIVE, NORMAL, POSITIVE, QUIET_NAN, SUBNORMAL, ZERO};
use proptest::prelude::*;
use proptest::sample::{Index, select, subsequence};
use proptest::test_runner::{Config, TestRunner};

/// Runs a property on this many generated cases, the same ones every time.
fn check<S: Strategy>(cases: u32, strategy: S, property: impl Fn(S::Value) -> Result<(), TestCaseError>) {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let rng = proptest::test_runner::TestRng::deterministic_rng(config.rng_algorithm);
    TestRunner::new_with_rng(config, rng).run(&strategy, property).unwrap_or_else(|e| panic!("{e}"));
}

/// Any coordinate that a domain admits, both zeros and the smallest ones included.
fn coordinate() -> impl Strategy<Value = f64> {
    (NORMAL | SUBNORMAL | ZERO | POSITIVE | NEGATIVE).prop_filter("within ±1e150", |x| x.abs() <= 1e150)
}

fn points(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<[f64; 3]>> {
    vec([coordinate(), coordinate(), coordinate()], count)
}

fn surface() -> impl Strategy<Value = Surface> {
    points(5..9).prop_flat_map(|p| {
        let corners = subsequence((0..p.len()).collect::<Vec<_>>(), 3..=5).prop_shuffle();
        vec(corners, 1..9)
            .prop_map(move |faces| Surface::new(p.clone(), faces).expect("admitted coordinates, distinct corners"))
    })
}

fn matrix() -> impl Strategy<Value = Csr> {
    let value = ANY | QUIET_NAN | INFINITE | ZERO;
    (1_usize..9, 1_usize..9).prop_flat_map(move |(rows, columns)| {
        // A NaN keeps its sign only: there is one of each sign in text.
        let plain = |v: f64| if v.is_nan() { f64::NAN.copysign(v) } else { v };
        let triplets = vec((0..rows, 0..columns, value.prop_map(plain)), 0..20);
        triplets.prop_map(move |mut t| {
            t.sort_by_key(|&(i, j, _)| (i, j));
            t.dedup_by_key(|&mut (i, j, _)| (i, j));
            Csr::from_triplets(rows, columns, &t)
        })
    })
}

fn bits(points: &[[f64; 3]]) -> Vec<u64> {
    points.iter().flatten().map(|x| x.to_bits()).collect()
}

fn reread(format: Format, text: &str) -> Domain {
    parse_domain(format, "again", text.as_bytes()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

#[test]
fn a_surface_comes_back_from_off_and_obj_bit_for_bit() {
    check(300, surface(), |s| {
        for (format, text) in [(Format::Off, write_off(&s)), (Format::Obj, write_obj(&s))] {
            let domain = reread(format, &text);
            let back = domain.as_surface().expect("a surface");
            prop_assert_eq!(bits(back.positions()), bits(s.positions()));
            prop_assert_eq!(back.faces(), s.faces());
        }
        Ok(())
    });
}

#[test]
fn a_matrix_comes_back_bit_for_bit_with_nan_and_negative_zero() {
    let entries = |m: &Csr| m.entries().map(|(i, j, v)| (i, j, v.to_bits())).collect::<Vec<_>>();
    let special = Cell::new([0; 3]);
    check(500, matrix(), |m| {
        let back = parse_matrix("again", write_matrix_market(&m).as_bytes()).expect("our own matrix").matrix;
        prop_assert_eq!((back.rows(), back.columns(), entries(&back)), (m.rows(), m.columns(), entries(&m)));
        let count = |is: fn(&f64) -> bool| m.entries().filter(|(_, _, v)| is(v)).count();
        let [a, b, c] = special.get();
        special.set([
            a + count(|v| v.is_nan()),
            b + count(|v| v.is_infinite()),
            c + count(|v| *v == 0.0 && v.is_sign_negative()),
        ]);
        Ok(())
    });
    assert!(special.get().iter().all(|&n| n > 50), "NaN, infinities and −0 occur: {:?}", special.get());
}

#[test]
fn points_volumes_and_graphs_come_back_bit_for_bit() {
    check(200, (points(4..12), vec(NORMAL | ZERO, 3)), |(p, weights)| {
        let cloud = PointCloud::new(p.clone(), None).expect("admitted coordinates");
        prop_assert_eq!(bits(reread(Format::Xyz, &write_xyz(&cloud)).positions().unwrap()), bits(&p));
        let volume = Volume::new(p.clone(), vec![[3, 0, 2, 1]]).expect("admitted coordinates");
        let back = reread(Format::Medit, &write_medit(&volume));
        prop_assert_eq!(bits(back.positions().unwrap()), bits(&p));
        let graph = Graph::weighted(p.len(), &[[0, 3], [1, 0], [2, 3]], &weights).expect("finite weights");
        prop_assert_eq!(reread(Format::MatrixMarket, &write_graph(&graph)).digest(), Domain::from(graph).digest());
        Ok(())
    });
}

#[test]
fn a_compressed_file_is_read_like_the_plain_one_whatever_its_name() {
    let plain = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/meshes/eight.off");
    let content = std::fs::read(&plain).unwrap();
    let folder = tempfile::tempdir().unwrap();
    // Two members one after the other are one gzip file.
    let half = content.len() / 2;
    let mut compressed = Vec::new();
    for part in [&content[..half], &content[half..]] {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        encoder.write_all(part).unwrap();
        compressed.extend(encoder.finish().unwrap());
    }
    for name in ["eight.off.gz", "EIGHT.OFF.GZ", "eight.off"] {
        let path = folder.path().join(name);
        std::fs::write(&path, &compressed).unwrap();
        assert_eq!(read_domain(&path).unwrap().digest(), read_domain(&plain).unwrap().digest());
    }
    let path = folder.path().join("m.MTX");
    std::fs::write(&path, write_matrix_market(&Csr::diagonal(&[1.0, -0.5]))).unwrap();
    assert_eq!(read_matrix(&path).unwrap().matrix, Csr::diagonal(&[1.0, -0.5]));
    let missing = read_domain(&folder.path().join("nothing.off")).unwrap_err().to_string();
    assert!(missing.ends_with("check the path and its permissions"), "{missing}");
}

/// A valid file of each format, small enough that a random change often meets what matters.
fn seeds() -> Vec<(Format, Vec<u8>)> {
    let header = |encoding: &str| {
        format!(
            "ply\nformat {encoding} 1.0\ncomment c\nelement vertex 3\nproperty float x\nproperty double y\nproperty short z\n\
             element edge 1\nproperty list uchar int e\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    let mut binary = header("binary_little_endian").into_bytes();
    for (x, y, z) in [(0_f32, 0_f64, 0_i16), (1.0, 0.0, 0), (0.0, 1.0, 0)] {
        binary.extend([&x.to_le_bytes()[..], &y.to_le_bytes(), &z.to_le_bytes()].concat());
    }
    binary.extend([2, 0, 0, 0, 0, 1, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
    let mut stl = [vec![b' '; 80], 1_u32.to_le_bytes().to_vec(), vec![0; 12]].concat();
    stl.extend([0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|x| x.to_le_bytes()));
    stl.extend([0, 0]);
    let text = |s: &str| s.as_bytes().to_vec();
    vec![
        (Format::Off, text("OFF\n# c\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3 7\n")),
        (Format::Off, text("STCNOFF 1 0 0\n0 0 0 0 0 1 255 0 0 0.5 0.5\n")),
        (Format::Obj, text("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\ng a\nf 1/1 2//3 \\\n -1\nl 1 2\n")),
        (Format::Ply, text(&(header("ascii") + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n"))),
        (Format::Ply, binary),
        (Format::Stl, stl),
        (
            Format::Stl,
            text(
                "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n",
            ),
        ),
        (Format::Xyz, text("0 0 0 0 0 1\n1 2 3 1 0 0\n")),
        (
            Format::Medit,
            text(
                "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nEdges 1\n1 2 0\nTetrahedra\n1\n1 2 3 4 0\nEnd\n",
            ),
        ),
        (Format::MatrixMarket, text("%%MatrixMarket matrix coordinate real symmetric\n% c\n3 3 2\n2 1 0.5\n3 2 -1\n")),
        (Format::MatrixMarket, text("%%MatrixMarket matrix array integer general\n2 2\n0\n1\n1\n0\n")),
    ]
}

/// Reads as domain and, for Matrix Market, as matrix; says whether the file was read. What was read must survive its writer.
fn read_everything(format: Format, bytes: &[u8]) -> bool {
    if format == Format::MatrixMarket
        && let Err(error) = parse_matrix("fuzz", bytes)
    {
        assert!(error.to_string().starts_with("fuzz"), "{error}");
    }
    match parse_domain(format, "fuzz", bytes) {
        Err(error) => {
            assert!(error.to_string().starts_with("fuzz"), "{error}");
            false
        }
        Ok(domain) => {
            let back = match &domain {
                Domain::Surface(s) => reread(Format::Off, &write_off(s)),
                Domain::Points(p) => reread(Format::Xyz, &write_xyz(p)),
                Domain::Volume(v) => reread(Format::Medit, &write_medit(v)),
                Domain::Graph(g) => reread(Format::MatrixMarket, &write_graph(g)),
            };
            assert_eq!(back.digest(), domain.digest());
            true
        }
    }
}

#[test]
fn the_seeds_are_valid() {
    for (format, bytes) in seeds() {
        assert!(read_everything(format, &bytes), "{:?}", parse_domain(format, "seed", &bytes).map(drop));
    }
}

#[test]
fn arbitrary_bytes_are_refused_in_peace() {
    for format in Format::ALL {
        check(1000, vec(any::<u8>(), 0..300), |bytes| {
            read_everything(format, &bytes);
            Ok(())
        });
    }
    // Behind a valid beginning they get further.
    for (format, seed) in seeds() {
        check(100, (any::<Index>(), vec(any::<u8>(), 0..100)), |(cut, bytes)| {
            read_everything(format, &[&seed[..cut.index(seed.len())], &bytes[..]].concat());
            Ok(())
        });
    }
}

#[test]
fn arbitrary_words_of_the_grammar_are_refused_in_peace() {
    let words = vec![
        "OFF",
        "COFF",
        "v",
        "f",
        "ply",
        "format",
        "ascii",
        "element",
        "vertex",
        "face",
        "property",
        "list",
        "float",
        "uchar",
        "end_header",
        "solid",
        "facet",
        "vertex",
        "outer",
        "loop",
        "endloop",
        "Vertices",
        "Tetrahedra",
        "Dimension",
        "\n",
        "\n",
        "\n",
        "\r\n",
        "#",
        "%",
        "\\\n",
        "0",
        "1",
        "2",
        "3",
        "-1",
        "1.5",
        "nan",
        "1/2/3",
        "18446744073709551615",
        "symmetric",
    ];
    for (format, seed) in seeds() {
        let line = seed.iter().position(|&b| b == b'\n').unwrap_or(0);
        check(200, vec(select(words.clone()), 0..60), |words| {
            read_everything(format, words.join(" ").as_bytes());
            read_everything(format, &[&seed[..=line], words.join(" ").as_bytes()].concat());
            Ok(())
        });
    }
}

/// A change of a file.
#[derive(Clone, Debug)]
enum Change {
    Byte(Index, u8),
    Cut(Index, Index),
    Insert(Index, &'static str),
    Replace(Index, &'static str),
    RepeatLine(Index, Index),
    Truncate(Index),
}

fn change() -> impl Strategy<Value = Change> {
    let word = select(vec![
        "0",
        "1",
        "-1",
        "4",
        "7",
        "1e400",
        "1e-400",
        "nan",
        "-inf",
        "1,5",
        "0x1",
        "99999999999999999999",
        "1000000000000",
        "1.0",
        " ",
        "\n",
        "\r",
        "\t",
        "#",
        "%",
        "\\\n",
        "/",
        "\0",
        "é",
        "\u{feff}",
        "end_header",
        "general",
        "pattern",
        "4294967295",
    ]);
    let at = any::<Index>;
    prop_oneof![
        (at(), any::<u8>()).prop_map(|(i, b)| Change::Byte(i, b)),
        (at(), at()).prop_map(|(i, j)| Change::Cut(i, j)),
        (at(), word.clone()).prop_map(|(i, w)| Change::Insert(i, w)),
        (at(), word).prop_map(|(i, w)| Change::Replace(i, w)),
        (at(), at()).prop_map(|(i, j)| Change::RepeatLine(i, j)),
        at().prop_map(Change::Truncate),
    ]
}

/// Applies a change; `Replace` takes a whole word out of the text, `RepeatLine` copies a line to the end of another.
fn apply(bytes: &mut Vec<u8>, change: &Change) {
    let n = bytes.len();
    let at = |i: &Index| i.index(n + 1);
    let end_of =
        |from: usize, stop: fn(&u8) -> bool, bytes: &[u8]| bytes[from..].iter().position(stop).map_or(n, |k| from + k);
    match change {
        Change::Byte(i, b) if n > 0 => bytes[i.index(n)] = *b,
        Change::Byte(..) => {}
        Change::Cut(i, j) => drop(bytes.drain(at(i).min(at(j))..(at(i).min(at(j)) + 8).min(at(i).max(at(j))))),
        Change::Insert(i, word) => drop(bytes.splice(at(i)..at(i), word.bytes())),
        Change::Replace(i, word) => {
            let from = end_of(at(i), |b| !b.is_ascii_whitespace(), bytes);
            let to = end_of(from, u8::is_ascii_whitespace, bytes);
            bytes.splice(from..to, word.bytes());
        }
        Change::RepeatLine(i, j) => {
            let [from, to] = [i, j].map(|k| (end_of(at(k), |&b| b == b'\n', bytes) + 1).min(n));
            let line = bytes[from..end_of(from, |&b| b == b'\n', bytes)].to_vec();
            bytes.splice(to..to, [line, b"\n".to_vec()].concat());
        }
        Change::Truncate(i) => bytes.truncate(at(i)),
    }
}

#[test]
fn mutations_of_valid_files_are_read_whole_or_refused() {
    for (format, seed) in seeds() {
        let outcomes = Cell::new([0, 0]);
        check(2000, vec(change(), 1..4), |changes| {
            let mut bytes = seed.clone();
            changes.iter().for_each(|c| apply(&mut bytes, c));
            let mut counts = outcomes.get();
            counts[usize::from(read_everything(format, &bytes))] += 1;
            outcomes.set(counts);
            Ok(())
        });
        let [refused, read] = outcomes.get();
        assert!(refused > 250 && read > 25, "{format:?}: {refused} refused, {read} read; the changes test nothing");
    }
}
