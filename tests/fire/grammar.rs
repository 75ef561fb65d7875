//! Small valid files of every format, and what each of their words is.

use super::Reader;
use super::document::{Comments, Document, Kind};
use super::tape::Tape;

const COORDINATES: [&str; 16] = [
    "0",
    "1",
    "-1",
    "2",
    "0.5",
    "-0",
    "+.5",
    "2.",
    "1E-3",
    "0.1",
    "-12.25e+1",
    "4e-320",
    "1e150",
    "-1e150",
    "1e-300",
    "0.3333333333333333148296162562473909929394721984863281250",
];
const SINGLES: [&str; 8] = ["0", "1", "-1", "0.5", "-0", "+.5", "1e38", "1e-40"];
const VALUES: [&str; 12] =
    ["1", "-0.5", "0", "NaN", "-inf", "Infinity", "1e308", "5e-324", "-1e-3", "+2.", "-nan(ind)", "-0"];

type Word = (String, Kind);

fn words(kind: Kind, all: impl IntoIterator<Item = impl ToString>) -> Vec<Word> {
    all.into_iter().map(|w| (w.to_string(), kind)).collect()
}

fn point(tape: &mut Tape) -> Vec<Word> {
    words(Kind::Coordinate, (0..3).map(|_| tape.pick(&COORDINATES)))
}

/// `k` distinct numbers below `n`.
fn corners(tape: &mut Tape, n: usize, k: usize) -> Vec<usize> {
    let start = tape.below(n);
    let mut all: Vec<usize> = (0..k).map(|i| (start + i) % n).collect();
    let (a, b) = (tape.below(k), tape.below(k));
    all.swap(a, b);
    all
}

/// A small valid file.
pub fn document(reader: Reader, tape: &mut Tape) -> Document {
    let mut d = Document { lines: Vec::new(), body: Vec::new(), comments: Comments::Hash };
    match reader {
        Reader::Off => off(&mut d, tape),
        Reader::Obj => obj(&mut d, tape),
        Reader::PlyAscii | Reader::PlyLittle | Reader::PlyBig => ply(&mut d, tape, reader),
        Reader::StlAscii => stl(&mut d, tape),
        Reader::StlBinary => stl_binary(&mut d, tape),
        Reader::Xyz => {
            let normals = tape.once_in(2);
            for _ in 0..=tape.below(4) {
                let mut line = point(tape);
                line.extend(if normals { point(tape) } else { Vec::new() });
                d.push(line);
            }
        }
        Reader::Medit => medit(&mut d, tape),
        Reader::Coordinate => coordinate(&mut d, tape),
        Reader::Array => array(&mut d, tape),
        Reader::Graph => graph(&mut d, tape),
        Reader::Gzip => off(&mut d, tape),
        Reader::Recipe | Reader::Suite | Reader::Claims | Reader::Record => d.line("x"),
    }
    d
}

fn off(d: &mut Document, tape: &mut Tape) {
    let (n, faces) = (3 + tape.below(4), tape.below(4));
    d.line("OFF");
    d.push([words(Kind::Count, [n, faces]), words(Kind::Plain, [0])].concat());
    (0..n).for_each(|_| d.push(point(tape)));
    for _ in 0..faces {
        let k = 3 + tape.below(n - 2);
        d.push([words(Kind::Count, [k]), words(Kind::Index, corners(tape, n, k))].concat());
    }
}

fn obj(d: &mut Document, tape: &mut Tape) {
    let n = 3 + tape.below(4);
    let vertex = |tape: &mut Tape| [words(Kind::Plain, ["v"]), point(tape)].concat();
    (0..n).for_each(|_| d.push(vertex(tape)));
    for _ in 0..tape.below(4) {
        let k = 3 + tape.below(n - 2);
        let face = corners(tape, n, k).into_iter().map(|v| v + 1);
        d.push([words(Kind::Plain, ["f"]), words(Kind::Index, face)].concat());
    }
    d.line(tape.pick(&["g a", "vt 0 0", "usemtl b", "s off", "l 1 2"]));
}

fn ply(d: &mut Document, tape: &mut Tape, reader: Reader) {
    d.comments = Comments::Ply;
    let (n, faces, extra) = (3 + tape.below(4), tape.below(4), tape.once_in(2));
    let encoding = match reader {
        Reader::PlyLittle => "binary_little_endian",
        Reader::PlyBig => "binary_big_endian",
        _ => "ascii",
    };
    d.line("ply");
    d.line(&format!("format {encoding} 1.0"));
    d.push([words(Kind::Plain, ["element", "vertex"]), words(Kind::Count, [n])].concat());
    ["property float x", "property double y", "property float32 z"].iter().for_each(|l| d.line(l));
    if extra {
        d.line("property list uchar short extra");
    }
    d.push([words(Kind::Plain, ["element", "face"]), words(Kind::Count, [faces])].concat());
    d.line("property list uchar int vertex_indices");
    d.line("end_header");
    for _ in 0..n {
        let [x, y, z] = [tape.pick(&SINGLES), tape.pick(&COORDINATES), tape.pick(&SINGLES)];
        let listed = tape.below(3);
        if reader == Reader::PlyAscii {
            let mut row = words(Kind::Coordinate, [x, y, z]);
            if extra {
                row.extend([words(Kind::Count, [listed]), words(Kind::Index, vec![1; listed])].concat());
            }
            d.push(row);
        } else {
            let mut put = |little: &[u8]| put(&mut d.body, reader, little);
            put(&x.parse::<f32>().unwrap().to_le_bytes());
            put(&y.parse::<f64>().unwrap().to_le_bytes());
            put(&z.parse::<f32>().unwrap().to_le_bytes());
            if extra {
                put(&[listed as u8]);
                (0..listed).for_each(|_| put(&7_i16.to_le_bytes()));
            }
        }
    }
    for _ in 0..faces {
        let k = 3 + tape.below(n - 2);
        let face = corners(tape, n, k);
        if reader == Reader::PlyAscii {
            d.push([words(Kind::Count, [k]), words(Kind::Index, face)].concat());
        } else {
            put(&mut d.body, reader, &[k as u8]);
            face.iter().for_each(|&v| put(&mut d.body, reader, &(v as i32).to_le_bytes()));
        }
    }
}

fn put(body: &mut Vec<u8>, reader: Reader, little: &[u8]) {
    match reader {
        Reader::PlyBig => body.extend(little.iter().rev()),
        _ => body.extend(little),
    }
}

fn stl(d: &mut Document, tape: &mut Tape) {
    d.comments = Comments::None;
    d.line("solid a b");
    for k in 0..=tape.below(3) {
        d.line("facet normal 0 nan 1");
        d.line("outer loop");
        for corner in 0..3 {
            let mut at = point(tape);
            // Three different places.
            at[0].0 = ["0", "1", "-2.5"][(corner + k) % 3].into();
            d.push([words(Kind::Plain, ["vertex"]), at].concat());
        }
        d.line("endloop");
        d.line("endfacet");
    }
    d.line(tape.pick(&["endsolid", "endsolid a b"]));
}

fn stl_binary(d: &mut Document, tape: &mut Tape) {
    let facets = 1 + tape.below(4);
    let title = tape.pick(&["", "solid", "solid a\nfacet normal 0 0 1"]);
    d.body.extend(title.bytes().chain(std::iter::repeat_n(b' ', 80 - title.len())));
    d.body.extend((facets as u32).to_le_bytes());
    for _ in 0..facets {
        d.body.extend([0xff; 12]);
        for corner in 0..3 {
            let at = [["0", "1", "-2.5"][corner], tape.pick(&SINGLES), tape.pick(&SINGLES)];
            at.iter().for_each(|w| d.body.extend(w.parse::<f32>().unwrap().to_le_bytes()));
        }
        d.body.extend([1, 2]);
    }
}

fn medit(d: &mut Document, tape: &mut Tape) {
    let (n, cells) = (4 + tape.below(3), 1 + tape.below(3));
    d.line("MeshVersionFormatted 1");
    d.line("Dimension 3");
    d.line("Vertices");
    d.push(words(Kind::Count, [n]));
    (0..n).for_each(|_| d.push([point(tape), words(Kind::Plain, [0])].concat()));
    let (section, k) = tape.pick(&[("Tetrahedra", 4), ("Triangles", 3), ("Quadrilaterals", 4)]);
    d.line(section);
    d.push(words(Kind::Count, [cells]));
    for _ in 0..cells {
        let cell = corners(tape, n, k).into_iter().map(|v| v + 1);
        d.push([words(Kind::Index, cell), words(Kind::Plain, [0])].concat());
    }
    d.line("End");
}

fn coordinate(d: &mut Document, tape: &mut Tape) {
    d.comments = Comments::Percent;
    let field = tape.pick(&["real", "real", "integer", "pattern", "double"]);
    let symmetry = tape.pick(&["general", "symmetric", "skew-symmetric"]);
    let field = if symmetry == "skew-symmetric" && field == "pattern" { "real" } else { field };
    let (n, entries) = (2 + tape.below(4), tape.below(7));
    d.line(&format!("%%MatrixMarket matrix coordinate {field} {symmetry}"));
    d.push(words(Kind::Count, [n, n, entries]));
    for _ in 0..entries {
        let (mut i, mut j) = (1 + tape.below(n), 1 + tape.below(n));
        if symmetry != "general" {
            (i, j) = (i.max(j), i.min(j));
        }
        if symmetry == "skew-symmetric" && i == j {
            (i, j) = (2, 1);
        }
        let value = match field {
            "pattern" => vec![],
            "integer" => words(Kind::Value, [tape.pick(&["1", "0", "-7", "9007199254740992"])]),
            _ => words(Kind::Value, [tape.pick(&VALUES)]),
        };
        d.push([words(Kind::Index, [i, j]), value].concat());
    }
}

fn array(d: &mut Document, tape: &mut Tape) {
    d.comments = Comments::Percent;
    let symmetry = tape.pick(&["general", "symmetric", "skew-symmetric"]);
    let n = 1 + tape.below(4);
    let columns = if symmetry == "general" { 1 + tape.below(3) } else { n };
    d.line(&format!("%%MatrixMarket matrix array real {symmetry}"));
    d.push(words(Kind::Count, [n, columns]));
    let count = match symmetry {
        "general" => n * columns,
        "symmetric" => n * (n + 1) / 2,
        _ => n * (n - 1) / 2,
    };
    (0..count).for_each(|_| d.push(words(Kind::Value, [tape.pick(&VALUES)])));
}

fn graph(d: &mut Document, tape: &mut Tape) {
    d.comments = Comments::Percent;
    let n = 2 + tape.below(5);
    let edges: Vec<(usize, usize)> =
        (2..=n).flat_map(|i| (1..i).map(move |j| (i, j))).filter(|_| tape.once_in(2)).collect();
    let (pattern, general) = (tape.once_in(3), tape.once_in(2));
    let field = if pattern { "pattern" } else { "real" };
    d.line(&format!("%%MatrixMarket matrix coordinate {field} {}", if general { "general" } else { "symmetric" }));
    d.push(words(Kind::Count, [n, n, edges.len() * if general { 2 } else { 1 }]));
    for (i, j) in edges {
        let value = match pattern {
            true => vec![],
            false => words(Kind::Value, [tape.pick(&["1", "0.1", "-2", "0", "1e300"])]),
        };
        d.push([words(Kind::Index, [i, j]), value.clone()].concat());
        if general {
            d.push([words(Kind::Index, [j, i]), value].concat());
        }
    }
}
