//! Every reader under random input: what is drawn, and what must come of it. Shared by `tests/readers_under_fire.rs` and
//! `examples/readers_under_fire.rs`, which are programs of their own so that they may count what is allocated.

pub mod document;
pub mod grammar;
pub mod judge;
pub mod meter;
pub mod mutation;
pub mod tape;

use lapjury::exchange::Format;
use proptest::collection::vec;
use proptest::prelude::*;

use document::Expected;
use tape::Tape;

/// What reads text or bytes from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reader {
    Off,
    Obj,
    PlyAscii,
    PlyLittle,
    PlyBig,
    StlAscii,
    StlBinary,
    Xyz,
    Medit,
    Coordinate,
    Array,
    Graph,
    Gzip,
    Recipe,
    Suite,
    Claims,
    Record,
}

impl Reader {
    pub const ALL: [Reader; 17] = [
        Reader::Off,
        Reader::Obj,
        Reader::PlyAscii,
        Reader::PlyLittle,
        Reader::PlyBig,
        Reader::StlAscii,
        Reader::StlBinary,
        Reader::Xyz,
        Reader::Medit,
        Reader::Coordinate,
        Reader::Array,
        Reader::Graph,
        Reader::Gzip,
        Reader::Recipe,
        Reader::Suite,
        Reader::Claims,
        Reader::Record,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Reader::Off => "off",
            Reader::Obj => "obj",
            Reader::PlyAscii => "ply-ascii",
            Reader::PlyLittle => "ply-little-endian",
            Reader::PlyBig => "ply-big-endian",
            Reader::StlAscii => "stl-ascii",
            Reader::StlBinary => "stl-binary",
            Reader::Xyz => "xyz",
            Reader::Medit => "medit",
            Reader::Coordinate => "mtx-coordinate",
            Reader::Array => "mtx-array",
            Reader::Graph => "mtx-graph",
            Reader::Gzip => "gzip",
            Reader::Recipe => "recipe",
            Reader::Suite => "suite",
            Reader::Claims => "claims",
            Reader::Record => "record",
        }
    }

    /// The format that the reader reads as a domain.
    pub fn format(self) -> Option<Format> {
        match self {
            Reader::Off | Reader::Gzip => Some(Format::Off),
            Reader::Obj => Some(Format::Obj),
            Reader::PlyAscii | Reader::PlyLittle | Reader::PlyBig => Some(Format::Ply),
            Reader::StlAscii | Reader::StlBinary => Some(Format::Stl),
            Reader::Xyz => Some(Format::Xyz),
            Reader::Medit => Some(Format::Medit),
            Reader::Graph => Some(Format::MatrixMarket),
            _ => None,
        }
    }
}

/// The numbers from which an input is made.
pub fn numbers() -> impl Strategy<Value = Vec<u32>> {
    vec(any::<u32>(), 0..100)
}

/// The input that a list of numbers stands for, and what must come of it.
pub fn input(reader: Reader, numbers: &[u32]) -> (Vec<u8>, Expected) {
    let tape = &mut Tape::new(numbers);
    let how = tape.below(10);
    if let Some(seeds) = mutation::seeds(reader) {
        return (mutation::of_text(seeds, how, tape), Expected::Either);
    }
    let mut document = grammar::document(reader, tape);
    let (bytes, expected) = match how {
        0 => (document.render(tape), Expected::Read),
        1 | 2 => {
            let expected = if document.spoil(tape) { Expected::Refused } else { Expected::Read };
            (document.render(tape), expected)
        }
        3 | 4 => {
            document.disturb(tape);
            (document.render(tape), Expected::Either)
        }
        5 | 6 => (mutation::changed(document.render(tape), tape), Expected::Either),
        7 => {
            let other = grammar::document(tape.pick(&Reader::ALL[..13]), tape).render(tape);
            (mutation::spliced(document.render(tape), &other, tape), Expected::Either)
        }
        8 => {
            let mut start = document.render(tape);
            start.truncate(tape.below(start.len() + 1));
            start.extend(tape.bytes());
            (start, Expected::Either)
        }
        _ => (tape.bytes(), Expected::Either),
    };
    if reader == Reader::Gzip { mutation::compressed(&bytes, expected, tape) } else { (bytes, expected) }
}
