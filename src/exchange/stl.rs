//! STL, ascii and binary.
//!
//! Which of the two it is, the length decides: a binary file has 84 + 50 n bytes, n being the number at byte 80. The word
//! `solid` at the start decides nothing, as binary files begin with it too. Normals and attributes are skipped.
//!
//! The format has no vertices, three corners a facet only. Corners at exactly the same place become one vertex, −0 and 0
//! being the same; nothing is moved. A facet two corners of which coincide is left out. Notices tell of both.

use std::collections::HashMap;

use super::bytes::Bytes;
use super::error::{Place, ReadError};
use super::text::{Comments, Lines};
use crate::domain::{Domain, Surface};

/// 80 bytes of anything and the number of facets.
const HEADER: usize = 84;
/// A normal, three corners, and two bytes of attributes.
const FACET: usize = 50;

type Facet = [[f64; 3]; 3];

pub(super) fn parse(name: &str, bytes: &[u8]) -> Result<Domain, ReadError> {
    let promised = bytes.get(80..HEADER).and_then(|b| b.first_chunk()).map(|b| u32::from_le_bytes(*b) as usize);
    let facets = match promised {
        Some(n) if bytes.len() == HEADER + FACET * n => read_binary(name, bytes)?,
        Some(n) if bytes.contains(&0) => return Err(wrong_length(name, bytes, n)),
        _ => read_ascii(name, bytes)?,
    };
    weld(name, &facets)
}

fn wrong_length(name: &str, bytes: &[u8], promised: usize) -> ReadError {
    let (whole, rest) = ((bytes.len() - HEADER) / FACET, (bytes.len() - HEADER) % FACET);
    if whole < promised {
        return ReadError::TooFew {
            place: Place::byte(name, bytes.len()),
            what: "facets".into(),
            promised,
            found: whole,
        };
    }
    let found = format!("{} bytes", FACET * (whole - promised) + rest);
    ReadError::TooMany { place: Place::byte(name, HEADER + FACET * promised), what: "facets".into(), promised, found }
}

fn read_binary(name: &str, bytes: &[u8]) -> Result<Vec<Facet>, ReadError> {
    let mut facets = Vec::with_capacity((bytes.len() - HEADER) / FACET);
    let mut bytes = Bytes::new(name, bytes, HEADER);
    // The caller has compared the length with the number of facets: it is whole facets up to the end.
    while bytes.take::<12>().is_some() {
        let mut facet = [[0.0; 3]; 3];
        for corner in &mut facet {
            let offset = bytes.offset();
            *corner = bytes.little_endian_point().unwrap_or([f64::NAN; 3]);
            for (axis, &x) in corner.iter().enumerate() {
                ReadError::coordinate(x, axis, || bytes.place(offset + 4 * axis))?;
            }
        }
        facets.push(facet);
        bytes.take::<2>();
    }
    Ok(facets)
}

fn read_ascii(name: &str, bytes: &[u8]) -> Result<Vec<Facet>, ReadError> {
    let mut lines = Lines::new(name, bytes, Comments::None)?;
    let mut facets = Vec::new();
    let mut solid = false;
    while let Some(mut line) = lines.next() {
        let word = line.word_or_end();
        if !solid && word.is("solid") {
            solid = true;
        } else if solid && word.is("endsolid") {
            solid = false;
        } else if solid && word.is("facet") {
            facets.push(read_facet(&mut lines)?);
        } else if solid {
            return Err(word.expected("'facet' or 'endsolid'", "a solid is a list of facets"));
        } else {
            let advice = "an ascii STL file begins so; a binary one has 84 + 50 n bytes, n being the number at byte 80";
            return Err(word.expected("'solid'", advice));
        }
    }
    if solid {
        let advice = "the file is cut short".into();
        return Err(ReadError::Missing { place: lines.end(), what: "'endsolid'".into(), advice });
    }
    Ok(facets)
}

/// The lines of a facet below its first, which has the normal.
fn read_facet(lines: &mut Lines) -> Result<Facet, ReadError> {
    let mut facet = [[0.0; 3]; 3];
    expect(lines, &["outer", "loop"])?;
    for corner in &mut facet {
        let mut line = next(lines, "vertex")?;
        let word = line.word_or_end();
        if !word.is("vertex") {
            return Err(word.expected("'vertex'", "a facet has three vertices"));
        }
        *corner = line.point()?;
        line.finish("a vertex has three coordinates")?;
    }
    expect(lines, &["endloop"])?;
    expect(lines, &["endfacet"])?;
    Ok(facet)
}

fn next<'a>(lines: &mut Lines<'a>, expected: &str) -> Result<super::text::Line<'a>, ReadError> {
    lines.next().ok_or_else(|| {
        let (what, advice) = (format!("line '{expected}'"), "the file is cut short".into());
        ReadError::Missing { place: lines.end(), what, advice }
    })
}

/// Takes a line of exactly these words.
fn expect(lines: &mut Lines, words: &[&'static str]) -> Result<(), ReadError> {
    let advice = "a facet is 'facet normal', 'outer loop', three lines 'vertex', 'endloop', 'endfacet'";
    let mut line = next(lines, &words.join(" "))?;
    for expected in words {
        let word = line.word_or_end();
        if !word.is(expected) {
            return Err(word.expected(format!("'{expected}'"), advice));
        }
    }
    line.finish(advice)
}

fn weld(name: &str, facets: &[Facet]) -> Result<Domain, ReadError> {
    let mut vertex_at: HashMap<[u64; 3], usize> = HashMap::new();
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    // Adding 0 turns −0 into 0 and changes nothing else.
    let proper = facets.iter().map(|f| f.map(|p| p.map(|x| x + 0.0))).filter(|[a, b, c]| a != b && b != c && c != a);
    for facet in proper {
        faces.push(facet.map(|p| {
            *vertex_at.entry(p.map(f64::to_bits)).or_insert_with(|| {
                positions.push(p);
                positions.len() - 1
            })
        }));
    }
    if faces.is_empty() {
        let advice = match facets.len() {
            0 => "the file is empty; export the mesh again".into(),
            n => format!("none of the {n} in the file has three distinct corners").into(),
        };
        return Err(ReadError::Missing { place: Place::file(name), what: "facet".into(), advice });
    }
    let (corners, vertices, dropped) = (3 * faces.len(), positions.len(), facets.len() - faces.len());
    let surface = Surface::triangles(positions, &faces)
        .map_err(|source| ReadError::Domain { file: name.to_string(), source })?
        .with_notice(format!("{corners} corners were welded to {vertices} vertices where they coincide exactly"));
    Ok(match dropped {
        0 => surface,
        n => {
            surface.with_notice(format!("{n} of {} facets were left out: two of their corners coincide", facets.len()))
        }
    }
    .into())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: [Facet; 4] = {
        let [o, x, y, z] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        [[o, y, x], [o, x, z], [o, z, y], [x, y, z]]
    };

    fn ascii(facets: &[Facet]) -> String {
        let mut text = String::from("solid a tetrahedron\n");
        for facet in facets {
            text += "  facet normal nan 0 0\n    OUTER loop\n";
            facet.iter().for_each(|[x, y, z]| text += &format!("      vertex {x:?} {y:?} {z:?}\n"));
            text += "    endloop\n  endfacet\n";
        }
        text + "endsolid a tetrahedron\n"
    }

    fn binary(facets: &[Facet]) -> Vec<u8> {
        let mut file = [b"solid, though binary".as_slice(), &[b' '; 60]].concat();
        file.extend((facets.len() as u32).to_le_bytes());
        for facet in facets {
            file.extend([0xff; 12]);
            facet.iter().flatten().for_each(|&x| file.extend((x as f32).to_le_bytes()));
            file.extend([1, 2]);
        }
        file
    }

    #[test]
    fn ascii_and_binary_are_told_apart_by_length_and_read_alike() {
        for file in [ascii(&TETRAHEDRON).into_bytes(), binary(&TETRAHEDRON)] {
            let domain = parse("t.stl", &file).unwrap();
            let facts = domain.facts();
            assert_eq!((facts.vertices, facts.edges, facts.faces), (4, 6, 4));
            assert!(facts.surface.is_some_and(|s| s.closed && s.flipped_faces == 0));
            assert_eq!(domain.notices(), ["12 corners were welded to 4 vertices where they coincide exactly"]);
        }
    }

    #[test]
    fn both_zeros_are_one_place_and_collapsed_facets_are_told() {
        let mut facets = TETRAHEDRON.to_vec();
        facets[0][0] = [-0.0, 0.0, -0.0];
        facets.push([[5.0; 3], [5.0; 3], [6.0; 3]]);
        let domain = parse("t.stl", ascii(&facets).as_bytes()).unwrap();
        assert_eq!(domain.vertex_count(), 4);
        assert_eq!(domain.notices()[0], "1 of 5 facets were left out: two of their corners coincide");
    }
}
