//! Readers under random input: nothing panics, hangs, takes memory beyond a stated multiple of the input, or is read in part.
//!
//! A program of its own, and one test at a time, so that what is allocated can be counted. The long run is
//! `cargo run --release --example readers_under_fire`.

mod fire;

use std::io::Write;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use fire::document::Expected;
use fire::{Reader, input, judge, meter, numbers};
use flate2::Compression;
use flate2::write::GzEncoder;
use lapjury::Recipe;
use lapjury::exchange::{Format, parse_domain, parse_matrix, unpack, write_domain};
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};

/// Nothing else is allocated while a test holds this.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

fn message(format: Format, bytes: &[u8]) -> String {
    parse_domain(format, "f", bytes).map(drop).expect_err("malformed").to_string()
}

#[test]
fn two_thousand_inputs_for_each_reader_are_read_whole_or_refused_with_place_and_advice() {
    let _alone = alone();
    for reader in Reader::ALL {
        let config = Config { cases: 2000, failure_persistence: None, ..Config::default() };
        let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[reader as u8; 32]);
        let mut runner = TestRunner::new_with_rng(config, rng);
        let (counts, slowest) = (std::cell::Cell::new([0, 0]), std::cell::Cell::new(Duration::ZERO));
        let result = runner.run(&numbers(), |numbers| {
            let (bytes, expected) = input(reader, &numbers);
            let cost = judge::judge(reader, &bytes, expected, f64::INFINITY);
            let cost = cost.map_err(|why| TestCaseError::fail(format!("{why}\n{}", bytes.escape_ascii())))?;
            slowest.set(slowest.get().max(cost.time));
            let [refused, accepted] = counts.get();
            counts.set(if cost.accepted { [refused, accepted + 1] } else { [refused + 1, accepted] });
            Ok(())
        });
        result.unwrap_or_else(|e| panic!("{}: {e}", reader.name()));
        let [refused, accepted] = counts.get();
        println!("{}: {accepted} read, {refused} refused, the slowest in {:?}", reader.name(), slowest.get());
        assert!(refused > 100 && accepted > 100, "{}: {refused} refused, {accepted} read", reader.name());
    }
}

/// The judge itself: it must see a file that should not have been read, and one that should.
#[test]
fn the_judge_sees_a_malformed_file_that_was_read_and_a_valid_one_that_was_refused() {
    let _alone = alone();
    let judge = |text: &str, expected| judge::judge(Reader::Xyz, text.as_bytes(), expected, 0.0).map(|c| c.accepted);
    assert_eq!(judge("0 0 0\n", Expected::Read), Ok(true));
    assert_eq!(judge("0 0,5 0\n", Expected::Refused), Ok(false));
    assert!(judge("0 0 0\n", Expected::Refused).is_err());
    assert!(judge("0 0,5 0\n", Expected::Read).is_err());
}

#[test]
fn the_meter_sees_what_is_held_and_what_was_freed_in_between() {
    let _alone = alone();
    for size in [1_000_000, 10_000] {
        let (_, peak) = meter::peak(|| drop(std::hint::black_box(vec![1_u8; size])));
        assert!((size..size + 5000).contains(&peak), "{peak} for {size}");
        let twice = || (0..2).for_each(|_| drop(std::hint::black_box(vec![1_u8; size])));
        let (_, requested) = meter::requested(twice);
        assert!((2 * size..2 * size + 5000).contains(&requested), "{requested} for {size} twice");
    }
}

#[test]
fn a_component_of_a_normal_beyond_the_range_is_refused_where_it_stands() {
    let _alone = alone();
    let range = "every component must be a finite number between -1e150 and 1e150";
    assert_eq!(
        message(Format::Xyz, b"0 0 0 0 1.1e150 0\n"),
        format!("f:1:9: component y of a normal is 1.1e150; {range}")
    );
    assert_eq!(
        message(Format::Off, b"NOFF 1 0 0\n0 0 0 nan 0 0\n"),
        format!("f:2:7: component x of a normal is NaN; {range}")
    );
    let header = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
        property float nx\nproperty float ny\nproperty float nz\nend_header\n";
    assert_eq!(
        message(Format::Ply, format!("{header}0 0 0 0 0 inf\n").as_bytes()),
        format!("f:11:11: component z of a normal is inf; {range}")
    );
}

#[test]
fn a_face_with_more_corners_than_vertices_is_refused_before_they_are_read() {
    let _alone = alone();
    assert_eq!(
        message(Format::Off, b"OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n2147483647 0 1 2\n"),
        "f:5:1: a face with 2147483647 corners, but there are 3 vertices and a face names each once at most; correct the \
         number of corners"
    );
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar x\nproperty uchar y\n\
        property uchar z\nelement face 1\nproperty list uint uchar vertex_indices\nend_header\n";
    let lying = [header.as_bytes(), &[0; 3], &u32::MAX.to_le_bytes(), &vec![0; 100_000]].concat();
    let (message, peak) = meter::peak(|| message(Format::Ply, &lying));
    assert!(message.contains("a face with 2 corners, but there are 1 vertices"), "{message}");
    assert!(peak < 10_000, "{peak} bytes");
}

#[test]
fn an_obj_statement_of_a_million_words_costs_no_more_than_the_file() {
    let _alone = alone();
    for start in ["vt", "v 0 0 0 0", "# c\ng"] {
        let text = format!("{start}{}\nv 0 0 0\n", " 1".repeat(500_000));
        let (_, peak) = meter::peak(|| parse_domain(Format::Obj, "f", text.as_bytes()).is_ok());
        assert!(peak < 10_000, "{start}: {peak} bytes");
    }
    let slashes = format!("v 0 0 0\nf 1{}\n", "/".repeat(1_000_000));
    let (error, peak) = meter::peak(|| message(Format::Obj, slashes.as_bytes()));
    assert!(error.contains("an index is missing beside a slash") && peak < 10_000, "{peak} bytes: {error}");
}

#[test]
fn an_obj_index_ahead_of_the_file_is_refused_where_it_stands_although_it_is_known_late() {
    let _alone = alone();
    let text = "v 0 0 0\nf 1 2 5\nf 1 2 9\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
    assert!(message(Format::Obj, text.as_bytes()).starts_with("f:2:7: index 5 names no vertex"));
}

/// Zeros shrink a thousandfold: what is behind the limit is never unpacked.
#[test]
fn a_compressed_bomb_is_stopped_at_the_limit() {
    let _alone = alone();
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    let zeros = vec![b' '; 1 << 20];
    (0..64).for_each(|_| encoder.write_all(&zeros).unwrap());
    let bomb = encoder.finish().unwrap();
    let limit = 1 << 24;
    assert!(200 * bomb.len() < limit, "{} bytes", bomb.len());
    let (error, peak) = meter::peak(|| unpack("bomb.off.gz", &bomb).map(drop).unwrap_err().to_string());
    assert_eq!(
        error,
        format!(
            "bomb.off.gz: {} bytes of gzip hold more than {limit}, out of all proportion for text of numbers; if it is a mesh \
             or matrix all the same, decompress it with gzip -d first",
            bomb.len()
        )
    );
    assert!(peak < 4 * limit, "{peak} bytes");
}

/// The densest valid files of each format, a hundred thousand bytes and more: memory in proportion to the length, by a
/// factor that is the format's own.
#[test]
fn memory_grows_with_the_length_of_the_densest_files_by_a_stated_factor() {
    let _alone = alone();
    let n = 20_000;
    let point = "0 0 0\n";
    let refused_late = |start: String| start + "x";
    let files = [
        ("off points", Format::Off, format!("OFF {n} 0\n{}", point.repeat(n)), 10),
        ("xyz points", Format::Xyz, point.repeat(n), 13),
        ("obj points", Format::Obj, format!("v {point}").repeat(n), 10),
        (
            "off faces, the last one wrong",
            Format::Off,
            refused_late(format!("OFF 3 {n}\n{}{}3 0 1 ", point.repeat(3), "3 0 1 2\n".repeat(n - 1))),
            10,
        ),
        (
            "graph, the last edge wrong",
            Format::MatrixMarket,
            refused_late(format!(
                "%%MatrixMarket matrix coordinate pattern general\n9 9 {n}\n{}1 ",
                "2 1\n".repeat(n - 1)
            )),
            10,
        ),
    ];
    for (what, format, text, factor) in files {
        let (_, peak) = meter::peak(|| parse_domain(format, "f", text.as_bytes()).is_ok());
        let ratio = peak as f64 / text.len() as f64;
        println!("{what}: {ratio:.1} times {} bytes", text.len());
        assert!(ratio < f64::from(factor), "{what}: {ratio}");
    }
    // Accepted, the edges of a surface are found as well: the densest one there is, and a usual one.
    let dense = format!("OFF 3 {n}\n{}{}", point.repeat(3), "3 0 1 2\n".repeat(n));
    let recipe: Recipe = "icosphere:levels=4".parse().unwrap();
    let usual = write_domain(&recipe.build(".".as_ref()).unwrap(), Format::Off).unwrap();
    for (what, text, factor) in [("the densest surface", dense, 80.0), ("a sphere", usual, 16.0)] {
        let (accepted, peak) = meter::peak(|| parse_domain(Format::Off, "f", text.as_bytes()).is_ok());
        let ratio = peak as f64 / text.len() as f64;
        println!("{what}: {ratio:.1} times {} bytes", text.len());
        assert!(accepted && ratio < factor, "{what}: {ratio}");
    }
    let entries = |n: usize| (0..n).map(|k| format!("{} {} 1\n", k % 99 + 1, k / 99 % 99 + 1)).collect::<String>();
    let matrix = format!("%%MatrixMarket matrix coordinate real general\n99 99 9801\n{}", entries(9801));
    let (_, peak) = meter::peak(|| parse_matrix("f", matrix.as_bytes()).is_ok());
    let ratio = peak as f64 / matrix.len() as f64;
    println!("matrix: {ratio:.1} times {} bytes", matrix.len());
    assert!(ratio < 10.0, "matrix: {ratio}");
}

/// Eigen's `saveMarket` with its symmetric flag: two blanks in the header, and both triangles below it.
#[test]
fn what_eigen_and_scipy_write_is_read_once_or_refused_with_its_cause() {
    let _alone = alone();
    let eigen = "%%MatrixMarket matrix coordinate  real symmetric\n2 2 4\n1 1 2\n2 1 -1\n1 2 -1\n2 2 2\n";
    let error = parse_matrix("L.mtx", eigen.as_bytes()).map(drop).unwrap_err().to_string();
    assert!(error.starts_with("L.mtx:5:1: ") && error.contains("Eigen's saveMarket"), "{error}");
    assert!(error.contains("write 'general' in the header"), "{error}");
    let general = parse_matrix("L.mtx", eigen.replace("symmetric", "general").as_bytes()).unwrap();
    // What SciPy writes for the same matrix: one triangle below a hundred rows.
    let scipy = "%%MatrixMarket matrix coordinate real symmetric\n%\n2 2 3\n1 1 2\n2 1 -1\n2 2 2\n";
    assert_eq!(parse_matrix("L.mtx", scipy.as_bytes()).unwrap(), general);
    // Each repetition is counted once, though it is mirrored.
    let twice = scipy.replace("2 2 3", "2 2 5").replace("2 1 -1\n", "2 1 -0.5\n2 1 -0.25\n2 1 -0.25\n");
    let summed = parse_matrix("L.mtx", twice.as_bytes()).unwrap();
    assert_eq!(summed.matrix, general.matrix);
    let told = "2 entries repeat the place of an earlier one and were added to it, the first at (2, 1)";
    assert_eq!(summed.notices, [told]);
    let from_zero = scipy.replace("1 1 2", "0 0 2");
    let error = parse_matrix("L.mtx", from_zero.as_bytes()).map(drop).unwrap_err().to_string();
    assert_eq!(
        error,
        "L.mtx:4:1: index 0, but this format counts from 1; is the file 0-based? Then add 1 to every index"
    );
}
