//! Changes of files, byte by byte and word by word, and what is read besides meshes and matrices.

use std::io::Write;
use std::sync::OnceLock;

use flate2::Compression;
use flate2::write::GzEncoder;
use lapjury::record::Writer;
use lapjury::suite::Options;

use super::Reader;
use super::document::Expected;
use super::tape::Tape;

const PIECES: [&str; 35] = [
    "0",
    "1",
    "-1",
    "4",
    "1e400",
    "1e-400",
    "65536",
    "nan",
    "-inf",
    "1,5",
    "0x1",
    "2147483648",
    "9223372036854775808",
    "99999999999999999999",
    "1000000000000",
    "1.0",
    " ",
    "\n",
    "\r",
    "\r\n",
    "\t",
    "#",
    "%",
    "\\\n",
    "/",
    "//",
    "\0",
    "é",
    "\u{feff}",
    "end_header",
    "general",
    "pattern",
    "٣",
    "\u{b}",
    "\u{2028}",
];

/// Changes anywhere: bits, bytes, pieces cut, doubled, put in or replaced.
pub fn changed(mut bytes: Vec<u8>, tape: &mut Tape) -> Vec<u8> {
    for _ in 0..=tape.below(4) {
        let n = bytes.len();
        let (a, b) = (tape.below(n + 1), tape.below(n + 1));
        let (low, high) = (a.min(b), a.max(b));
        match tape.below(8) {
            0 => bytes.truncate(a),
            1 if a < n => bytes[a] ^= 1 << tape.below(8),
            2 if a < n => bytes[a] = tape.next() as u8,
            3 => drop(bytes.drain(low..high.min(low + 9))),
            4 => bytes.extend_from_within(low..high),
            5 => drop(bytes.splice(a..a, tape.pick(&PIECES).bytes())),
            6 => {
                let word = |b: &u8| !b.is_ascii_whitespace();
                let from = bytes[a..].iter().position(word).map_or(n, |k| a + k);
                let to = bytes[from..].iter().position(|b| !word(b)).map_or(n, |k| from + k);
                bytes.splice(from..to, tape.pick(&PIECES).bytes());
            }
            _ => {
                let piece = bytes[low..high].to_vec();
                let at = tape.below(n + 1);
                bytes.splice(at..at, piece);
            }
        }
        bytes.truncate(4000);
    }
    bytes
}

/// The beginning of one file and the end of another.
pub fn spliced(mut first: Vec<u8>, second: &[u8], tape: &mut Tape) -> Vec<u8> {
    first.truncate(tape.below(first.len() + 1));
    first.extend(&second[tape.below(second.len() + 1)..]);
    first
}

/// A file under gzip, perhaps damaged, perhaps a bomb.
pub fn compressed(bytes: &[u8], expected: Expected, tape: &mut Tape) -> (Vec<u8>, Expected) {
    let gzip = |bytes: &[u8]| {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    };
    let mut whole = gzip(bytes);
    match tape.below(6) {
        0 => (whole, expected),
        1 => {
            whole.truncate(tape.below(whole.len()));
            (whole, Expected::Either)
        }
        2 => (changed(whole, tape), Expected::Either),
        3 => {
            whole.extend(gzip(b"\n"));
            (whole, expected)
        }
        4 => {
            whole.extend(tape.bytes());
            (whole, Expected::Either)
        }
        _ => (gzip(&vec![tape.pick(b" 0\n\0#"); tape.pick(&[1, 100, 70_000])]), Expected::Refused),
    }
}

/// Valid texts of what is no mesh and no matrix.
pub fn seeds(reader: Reader) -> Option<&'static [Vec<u8>]> {
    static RECORD: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    static OTHERS: OnceLock<[Vec<Vec<u8>>; 3]> = OnceLock::new();
    let others = || {
        OTHERS.get_or_init(|| {
            let texts = |all: &[&str]| all.iter().map(|t| t.as_bytes().to_vec()).collect();
            [
                texts(&[
                    "random-delaunay:n=20,seed=7 | flip:count=5",
                    "fixtures/meshes/eight.off | scale:factor=1e-3",
                    "grid:nx=3,ny=4",
                    "a b.ply.gz",
                ]),
                texts(&[SUITE]),
                texts(&[CLAIMS]),
            ]
        })
    };
    match reader {
        Reader::Recipe => Some(&others()[0]),
        Reader::Suite => Some(&others()[1]),
        Reader::Claims => Some(&others()[2]),
        Reader::Record => Some(RECORD.get_or_init(record)),
        _ => None,
    }
}

const SUITE: &str = "id = \"s\"\ntitle = \"t\"\nseed = 1\nlaplacians = [\"cotan\", \"others\"]\nproperties = [\"POS0\"]\n\
    [[class]]\nid = \"planar\"\nrecipe = \"random-delaunay:n={n},seed={seed}\"\ncount = 3\nvary = { n = { from = 8, to = 40 } }\n\
    [[class]]\nid = \"real\"\nfiles = [\"a.off\", \"b.ply | scale:factor=2\"]\nwithout = [\"relations\"]\n";
const CLAIMS: &str = include_str!("../../suites/claims/graphs.toml");

/// The header of the record of a small run and single lines of it, no longer than two thousand bytes.
fn record() -> Vec<Vec<u8>> {
    let text = "id = 's'\ntitle = 't'\nseed = 1\nlaplacians = ['cotan', 'graph']\nproperties = ['SYM', 'POS0', 'LOC', 'PSD', 'LIN']\n\
        [[class]]\nid = 'c'\nrecipe = 'random-delaunay:n=6,seed=1 | flip:count=2'\n";
    let plan = lapjury::Suite::parse("s", text).unwrap().plan().unwrap();
    let options = Options { root: ".".into(), threads: Some(1), environment: Default::default() };
    let mut lines = Vec::new();
    lapjury::suite::run(&plan, &options, &mut (), &mut |line| {
        let mut text = Vec::new();
        Writer::new(&mut text).write(line)?;
        lines.push(text);
        Ok(())
    })
    .unwrap();
    let (header, rest) = lines.split_first().unwrap();
    let short = rest.iter().filter(|line| line.len() < 2000).map(|line| [&header[..], line].concat());
    std::iter::once(header.clone()).chain(short).collect()
}

/// A valid text changed, or a line of nothing but openings, or anything.
pub fn of_text(seeds: &[Vec<u8>], how: usize, tape: &mut Tape) -> Vec<u8> {
    let seed = &seeds[tape.below(seeds.len())];
    match how {
        0 => seed.clone(),
        1..=6 => changed(seed.clone(), tape),
        7 => spliced(seed.clone(), &seeds[tape.below(seeds.len())], tape),
        8 => {
            let opening = tape.pick(&["[", "{", "{\"a\":", "[[", "a.", "(", "\"", "a=[", "a={b=", "|", ":", ","]);
            let mut text = spliced(seed.clone(), opening.repeat(tape.pick(&[1, 20, 200, 900])).as_bytes(), tape);
            text.extend(tape.pick(&["", "]", "}"]).bytes());
            text
        }
        _ => tape.bytes(),
    }
}
