//! OFF, the Object File Format of Geomview, in text.
//!
//! ```text
//! OFF                      or COFF, NOFF, STOFF, STCNOFF: more columns behind the coordinates of a vertex
//! 4 1 0                    vertices, faces, edges (the last may be missing and is not used)
//! 0 0 0
//! …
//! 4  0 1 2 3  255 0 0      corners, their indices from 0, a colour of one, three or four numbers
//! ```
//! The counts may follow the keyword on its line; `#` begins a comment. Vertices and faces stand on a line each.

use super::error::{Place, ReadError};
use super::face;
use super::text::{Comments, Count, Line, Lines, Word};
use crate::domain::{Domain, PointCloud, Surface};

/// What follows the coordinates of a vertex.
#[derive(Clone, Copy)]
struct Columns {
    normal: bool,
    colour: bool,
    texture: bool,
}

pub(super) fn parse(name: &str, bytes: &[u8]) -> Result<Domain, ReadError> {
    let mut lines = Lines::new(name, bytes, Comments::Hash)?;
    let (columns, [vertices, faces]) = header(name, &mut lines)?;
    let mut positions = Vec::with_capacity(vertices);
    let mut normals = Vec::new();
    for found in 0..vertices {
        let mut line = lines.row("vertices", vertices, found)?;
        positions.push(line.point()?);
        let extra = extra_columns(&mut line, columns, vertices)?;
        if columns.normal {
            normals.push([extra[0], extra[1], extra[2]]);
        }
    }
    let mut corners = Vec::with_capacity(faces);
    let mut coloured = 0;
    for found in 0..faces {
        let mut line = lines.row("faces", faces, found)?;
        corners.push(face_corners(&mut line, vertices)?);
        coloured += usize::from(skip_colour(&mut line)?);
    }
    if faces > 0 {
        lines.finish("faces", faces)?
    } else {
        lines.finish("vertices", vertices)?
    }
    let domain = |source| ReadError::Domain { file: name.to_string(), source };
    if faces == 0 {
        return Ok(PointCloud::new(positions, columns.normal.then_some(normals)).map_err(domain)?.into());
    }
    let surface = Surface::new(positions, corners).map_err(domain)?;
    Ok(match coloured {
        0 => surface.into(),
        n => surface.with_notice(format!("{n} of {faces} faces have a colour, which was skipped")).into(),
    })
}

/// The kind of file and the numbers of vertices and faces.
fn header(name: &str, lines: &mut Lines) -> Result<(Columns, [usize; 2]), ReadError> {
    const ADVICE: &str = "an OFF file begins with OFF, COFF, NOFF or STOFF";
    let missing = || ReadError::Missing { place: Place::file(name), what: "keyword OFF".into(), advice: ADVICE.into() };
    let mut line = lines.next().ok_or_else(missing)?;
    let keyword = line.word_or_end();
    let columns = keyword_columns(keyword)?.ok_or_else(|| keyword.expected("the keyword OFF", ADVICE))?;
    if line.clone().word().is_some_and(|w| w.is("BINARY")) {
        let (place, what) = (line.word_or_end().place(), "binary OFF".into());
        return Err(ReadError::Unsupported { place, what, advice: "write it as text, or as PLY" });
    }
    if line.clone().word().is_none() {
        line = lines.next().ok_or_else(|| {
            let what = "line of counts".into();
            ReadError::Missing { place: lines.end(), what, advice: "write 'vertices faces edges' behind OFF".into() }
        })?;
    }
    let vertices = line.count("number of vertices")?;
    let faces = line.count("number of faces")?;
    if let Some(edges) = line.word() {
        edges.whole("number of edges")?;
    }
    line.finish("the counts are vertices, faces and edges")?;
    check_counts(lines, vertices, faces)?;
    Ok((columns, [vertices.value, faces.value]))
}

/// A vertex takes six bytes at least ("0 0 0" and the line end), a face eight.
fn check_counts(lines: &Lines, vertices: Count, faces: Count) -> Result<(), ReadError> {
    if vertices.value == 0 {
        let advice = "their number is 0, and a domain needs at least one".into();
        return Err(ReadError::Missing { place: vertices.word.place(), what: "vertex".into(), advice });
    }
    lines.check_count(vertices, "vertices", 6)?;
    lines.check_count(faces, "faces", 8)?;
    Ok(())
}

/// The columns that `[ST][C][N]OFF` announces; `None` if the word is no keyword of OFF.
fn keyword_columns(keyword: Word) -> Result<Option<Columns>, ReadError> {
    let bytes = if keyword.is("off") { b"OFF" } else { keyword.bytes() };
    let Some(mut rest) = bytes.strip_suffix(b"OFF") else { return Ok(None) };
    let mut letters = |prefix: &[u8]| {
        let found = rest.strip_prefix(prefix);
        rest = found.unwrap_or(rest);
        found.is_some()
    };
    let columns = Columns { texture: letters(b"ST"), colour: letters(b"C"), normal: letters(b"N") };
    match rest {
        b"" => Ok(Some(columns)),
        b"4" | b"n" | b"4n" => {
            let (place, what) =
                (keyword.place(), format!("{}: vertices in other than three dimensions", keyword.shown()));
            Err(ReadError::Unsupported {
                place,
                what,
                advice: "write three coordinates a vertex under the keyword OFF",
            })
        }
        _ => Ok(None),
    }
}

/// The numbers behind the coordinates: normal, colour (three or four numbers), texture, in this order.
fn extra_columns(line: &mut Line, columns: Columns, vertices: usize) -> Result<Vec<f64>, ReadError> {
    let least = 3 * usize::from(columns.normal) + 3 * usize::from(columns.colour) + 2 * usize::from(columns.texture);
    let most = least + usize::from(columns.colour);
    let mut extra = Vec::with_capacity(most);
    loop {
        let word = line.word_or_end();
        match (word.bytes().is_empty(), extra.len()) {
            (true, n) if n >= least => return Ok(extra),
            (false, n) if n == most => {
                return Err(word.expected(
                    "the end of the line",
                    format!(
                        "{vertices} lines of vertices are promised; behind their coordinates NOFF puts 3 numbers, COFF 3 or 4, \
                         STOFF 2, and OFF none"
                    ),
                ));
            }
            (_, axis @ 0..3) if columns.normal => extra.push(word.normal(axis)?),
            _ => extra.push(word.real("normal, colour or texture")?),
        }
    }
}

fn face_corners(line: &mut Line, vertices: usize) -> Result<Vec<usize>, ReadError> {
    let start = line.count("number of corners")?;
    if start.value > vertices {
        let (place, corners) = (start.word.place(), start.value as u64);
        return Err(ReadError::TooManyCorners { place, corners, vertices });
    }
    let again = line.clone();
    // An index takes two bytes at least, with the blank before it.
    let mut corners = Vec::with_capacity(start.value.min(line.remaining() / 2));
    for k in 0..start.value {
        let word = line.word_or_end();
        if word.bytes().is_empty() {
            let expected = format!("the index of corner {} of {}", k + 1, start.value);
            return Err(word.expected(expected, "a face line is the number of corners, then their indices"));
        }
        corners.push(word.index(vertices, 0)?);
    }
    face::check(&corners, 0, "remove it, or correct the number of vertices if it is one", |at| {
        let mut again = again.clone();
        // Without corners, what follows their number is a colour.
        if corners.is_empty() {
            return start.word.place();
        }
        (0..=at).filter_map(|_| again.word()).last().unwrap_or(start.word).place()
    })?;
    Ok(corners)
}

/// Whether a colour follows: nothing, an index into a colour map, or three or four components.
fn skip_colour(line: &mut Line) -> Result<bool, ReadError> {
    let mut components = 0;
    while let Some(word) = line.word() {
        word.real("colour")?;
        components += 1;
        if components > 4 {
            return Err(
                word.expected("the end of the line", "a face has at most four numbers of colour behind its corners")
            );
        }
    }
    if components == 2 {
        let advice = "the colour of a face is 1, 3 or 4 numbers; is the number of corners right?";
        return Err(line.word_or_end().expected("a third number of the colour", advice));
    }
    Ok(components > 0)
}

/// The surface as OFF. Numbers have the fewest digits that read back bit for bit.
pub fn write_off(surface: &Surface) -> String {
    let mut text = format!("OFF\n{} {} 0\n", surface.positions().len(), surface.faces().len());
    for [x, y, z] in surface.positions() {
        text.push_str(&format!("{x:?} {y:?} {z:?}\n"));
    }
    for corners in surface.faces() {
        text.push_str(&corners.len().to_string());
        corners.iter().for_each(|v| text.push_str(&format!(" {v}")));
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(text: &str) -> Surface {
        parse("t.off", text.as_bytes()).unwrap().as_surface().unwrap().clone()
    }

    const SQUARE: &str = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

    #[test]
    fn layout_comments_and_line_ends_do_not_matter() {
        let plain = surface(SQUARE);
        let variants = [
            SQUARE.replace('\n', "\r\n"),
            format!("\u{feff}# made by hand\n\n{}", SQUARE.replace("\n4 1 0", " 4 1 0 # counts\n\n")),
            SQUARE.replace("4 1 0", "4 1").replace("4 0 1 2 3\n", "4\t0 1 2 3  "),
            SQUARE.replace("OFF", "off"),
        ];
        for text in variants {
            let found = surface(&text);
            assert_eq!((found.positions(), found.faces()), (plain.positions(), plain.faces()), "{text}");
        }
    }

    #[test]
    fn announced_columns_are_skipped_and_face_colours_told() {
        let columns = |keyword: &str, extra: &str| {
            SQUARE.replace("OFF", keyword).replace(" 0\n", &format!(" 0 {extra}\n")).replacen(
                &format!(" 0 {extra}\n"),
                " 0\n",
                1,
            )
        };
        for (keyword, extra) in [
            ("COFF", "255 0 0"),
            ("COFF", "1 0 0 0.5"),
            ("NOFF", "0 0 1"),
            ("STOFF", "0.5 0.5"),
            ("STCNOFF", "0 0 1 255 0 0 255 0.5 0.5"),
            ("STCOFF", "255 0 0 0.5 0.5"),
        ] {
            assert_eq!(surface(&columns(keyword, extra)).positions(), surface(SQUARE).positions(), "{keyword}");
        }
        for colour in ["7", "255 0 0", "1 0 0 0.5"] {
            let found = surface(&SQUARE.replace("0 1 2 3", &format!("0 1 2 3 {colour}")));
            assert_eq!(found.notices(), ["1 of 1 faces have a colour, which was skipped"]);
        }
    }

    #[test]
    fn without_faces_it_is_a_point_cloud_with_its_normals() {
        let Ok(Domain::Points(points)) = parse("t.off", b"NOFF 1 0 0\n1 2 3 0 0 1\n") else { panic!("points") };
        assert_eq!((points.positions(), points.normals()), (&[[1.0, 2.0, 3.0]][..], Some(&[[0.0, 0.0, 1.0]][..])));
    }
}
