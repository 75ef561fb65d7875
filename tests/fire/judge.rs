//! What must come of an input: read whole and sound, or refused with place and advice; never more than a stated amount of
//! memory, never more than a stated time.

use std::io::Read;
use std::time::{Duration, Instant};

use flate2::read::MultiGzDecoder;
use lapjury::domain::Domain;
use lapjury::exchange::{
    Format, MatrixFile, native_format, parse_domain, parse_matrix, unpack, write_domain, write_matrix_market,
};
use lapjury::property::recheck;
use lapjury::record::Record;
use lapjury::{Recipe, Suite, suite};

use super::document::Expected;
use super::{Reader, meter};

/// How the inputs are called.
const NAME: &str = "in.put";

/// How many times its length an input may cost in memory.
pub fn factor(reader: Reader) -> usize {
    match reader {
        // The crate `toml` makes a tree of the text first, of a table for each point in a chain of keys.
        Reader::Suite | Reader::Claims => 1024,
        _ => 10,
    }
}

/// What every input may cost beyond that, in bytes.
pub fn constant(reader: Reader) -> usize {
    match reader {
        // Rows that are empty, up to 65536 of them, at 8 bytes in each of three arrays.
        Reader::Coordinate | Reader::Graph => 2 << 20,
        Reader::Array => 1 << 15,
        // The window and the tables of the decompressor, and a field of its header of up to 64 KiB, which is doubled as it grows.
        Reader::Gzip => 1 << 18,
        Reader::Suite | Reader::Claims => 1 << 19,
        Reader::Record => 1 << 16,
        _ => 1 << 15,
    }
}

/// What reading one input came to.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    pub accepted: bool,
    /// The most memory held while it was read, as a multiple of its length; of inputs of 500 bytes or more.
    pub ratio: f64,
    /// The most memory held, in bytes.
    pub peak: usize,
    pub time: Duration,
}

/// What was read.
enum Found {
    Domain(Domain),
    Matrix(MatrixFile),
    Recipe(Recipe),
    Record(Box<Record>),
    Other,
}

fn read(reader: Reader, bytes: &[u8]) -> Result<Found, String> {
    fn told<T, E: std::fmt::Display>(result: Result<T, E>) -> Result<T, String> {
        result.map_err(|error| error.to_string())
    }
    let text = || String::from_utf8_lossy(bytes);
    match reader {
        Reader::Coordinate | Reader::Array => told(parse_matrix(NAME, bytes)).map(Found::Matrix),
        Reader::Gzip => {
            let content = told(unpack(NAME, bytes))?;
            told(parse_domain(Format::Off, NAME, &content)).map(Found::Domain)
        }
        Reader::Recipe => told(text().parse()).map(Found::Recipe),
        Reader::Suite => told(Suite::parse(NAME, &text())).map(|_| Found::Other),
        Reader::Claims => told(suite::claims::parse(NAME, &text())).map(|_| Found::Other),
        Reader::Record => told(Record::parse(bytes)).map(|record| Found::Record(Box::new(record))),
        _ => match reader.format() {
            Some(format) => told(parse_domain(format, NAME, bytes)).map(Found::Domain),
            None => Err("no format".into()),
        },
    }
}

/// The length that counts: of a compressed input that of its content, as far as it goes.
fn length(reader: Reader, bytes: &[u8]) -> usize {
    if reader != Reader::Gzip {
        return bytes.len();
    }
    let (mut decoder, mut piece, mut content) = (MultiGzDecoder::new(bytes), [0; 4096], 0);
    while let Ok(n @ 1..) = decoder.read(&mut piece) {
        content += n;
    }
    bytes.len().max(content)
}

/// Reads an input and says what is wrong with what came of it. `worst` is the largest ratio so far: the exact peak is
/// measured only where it could be larger, or too large.
pub fn judge(reader: Reader, bytes: &[u8], expected: Expected, worst: f64) -> Result<Cost, String> {
    let start = Instant::now();
    let (result, requested) = meter::requested(|| read(reader, bytes));
    let mut time = start.elapsed();
    // Ten times as much where nothing is optimised.
    let patience = if cfg!(debug_assertions) { 10 } else { 1 };
    let slow = (Duration::from_millis(5) + Duration::from_micros(2) * length(reader, bytes) as u32) * patience;
    for _ in 0..3 {
        // Another program may have had the processor.
        if time > slow {
            let start = Instant::now();
            drop(read(reader, bytes));
            time = time.min(start.elapsed());
        }
    }
    if time > slow {
        return Err(format!("{} bytes took {time:?}", bytes.len()));
    }
    let mut cost = Cost { accepted: result.is_ok(), time, ..Cost::default() };
    let beyond = |bytes: usize| bytes.saturating_sub(constant(reader)) as f64;
    let long = bytes.len() >= 500;
    if requested > constant(reader) || (long && requested as f64 > worst * bytes.len() as f64) {
        let length = length(reader, bytes).max(1);
        cost.peak = meter::peak(|| drop(read(reader, bytes))).1;
        cost.ratio = if long { cost.peak as f64 / length as f64 } else { 0.0 };
        if beyond(cost.peak) > (factor(reader) * length) as f64 {
            return Err(format!("{length} bytes of content took {} bytes of memory", cost.peak));
        }
    }
    match (&result, expected) {
        (Ok(_), Expected::Refused) => return Err("a malformed file was read".into()),
        (Err(message), Expected::Read) => return Err(format!("a valid file was refused: {message}")),
        _ => {}
    }
    match result {
        Ok(found) => sound(&found)?,
        Err(message) => well_said(reader, &message)?,
    }
    Ok(cost)
}

/// A message begins with the file and its place, and goes on to what to do, in one line.
fn well_said(reader: Reader, message: &str) -> Result<(), String> {
    let bad = |what: &str| Err(format!("{what}: {message}"));
    if matches!(reader, Reader::Recipe | Reader::Suite | Reader::Claims | Reader::Record) {
        return if message.is_empty() { bad("no message") } else { Ok(()) };
    }
    if message.len() > 700 {
        return bad("a very long message");
    }
    let Some(rest) = message.strip_prefix(NAME) else { return bad("no file") };
    if !rest.starts_with([':', ',']) || message.contains('\n') || !rest[1..].contains([';', ',']) {
        return bad("no place, no advice, or more than a line");
    }
    // A place in the file, unless something is missing from the whole of it.
    let placed = rest.starts_with(", byte ") || rest[1..].starts_with(|c: char| c.is_ascii_digit());
    let whole = ["there is no ", "not a whole gzip file", "longer than ", "text in UTF-16"];
    if !placed && !whole.iter().any(|w| rest.contains(w)) && !rest.starts_with(": a skew-symmetric matrix of weights") {
        return bad("no line or byte");
    }
    Ok(())
}

/// What was read has all that its type promises, and survives being written.
fn sound(found: &Found) -> Result<(), String> {
    match found {
        Found::Domain(domain) => sound_domain(domain),
        Found::Matrix(file) => {
            let text = write_matrix_market(&file.matrix);
            let back = parse_matrix(NAME, text.as_bytes()).map_err(|e| format!("our own matrix was refused: {e}"))?;
            let plain = |v: f64| if v.is_nan() { f64::NAN.copysign(v).to_bits() } else { v.to_bits() };
            let bits = |m: &MatrixFile| m.matrix.entries().map(|(i, j, &v)| (i, j, plain(v))).collect::<Vec<_>>();
            if bits(&back) != bits(file) || file.matrix.entries().any(|(_, j, _)| j >= file.matrix.columns()) {
                return Err("the matrix does not survive being written".into());
            }
            Ok(())
        }
        Found::Recipe(recipe) => match recipe.to_string().parse::<Recipe>() {
            Ok(back) if back == *recipe => Ok(()),
            other => Err(format!("the recipe '{recipe}' reads back as {other:?}")),
        },
        Found::Record(record) => {
            let mut text = Vec::new();
            record.write(&mut text).map_err(|e| format!("a record that was read cannot be written: {e}"))?;
            let back = Record::parse(&text).map_err(|e| format!("our own record was refused: {e}"))?;
            if back.results().ne(record.results()) {
                return Err("the record does not survive being written".into());
            }
            // Whatever the evidence says, it is an answer and no crash.
            let verdicts = record.cells.iter().filter_map(|cell| cell.verdict.evidence());
            verdicts.for_each(|evidence| drop(recheck::from_excerpt(evidence)));
            Ok(())
        }
        Found::Other => Ok(()),
    }
}

fn sound_domain(domain: &Domain) -> Result<(), String> {
    let n = domain.vertex_count();
    let finite = domain.positions().unwrap_or(&[]).iter().flatten().all(|x| x.is_finite());
    let inside = match domain {
        Domain::Surface(s) => s.faces().iter().all(|f| f.len() > 2 && f.iter().all(|&v| v < n)),
        Domain::Volume(v) => v.tetrahedra().iter().flatten().all(|&v| v < n),
        Domain::Graph(g) => {
            g.edges().iter().all(|e| e[0] < e[1] && e[1] < n)
                && g.weights().unwrap_or(&[]).iter().all(|w| w.is_finite())
        }
        Domain::Points(p) => p.normals().is_none_or(|normals| normals.len() == n),
    };
    if n == 0 || !finite || !inside {
        return Err("a domain with no vertices, an index out of range, or a number that is not finite".into());
    }
    if let Some(facts) = domain.facts().surface
        && [facts.min_angle_deg, facts.max_angle_deg, facts.area].iter().any(|x| !x.is_finite() || *x < 0.0)
    {
        return Err(format!("facts that are no numbers: {facts:?}"));
    }
    let formats = match domain {
        Domain::Surface(_) => vec![Format::Off, Format::Obj],
        other => vec![native_format(other)],
    };
    for format in formats {
        let text = write_domain(domain, format).map_err(|e| e.to_string())?;
        let back = parse_domain(format, NAME, text.as_bytes()).map_err(|e| format!("our own file was refused: {e}"))?;
        if back.digest() != domain.digest() {
            return Err(format!("the domain does not survive being written as {format:?}:\n{text}"));
        }
    }
    Ok(())
}
