//! Wavefront OBJ: the polygons of it.
//!
//! ```text
//! v 0 0 0              a vertex, from 1; also with a weight 1, with a colour, or with both
//! f 1 2 3              a face of vertices; v/vt, v//vn and v/vt/vn as well; −1 is the vertex read last
//! ```
//! `#` begins a comment, `\` at the end of a line continues it. Texture coordinates, normals, groups, smoothing, materials,
//! lines and points are skipped; curves and free-form surfaces are refused.

use super::error::{Place, ReadError};
use super::text::{Comments, Line, Lines, Word};
use super::{face, number};
use crate::domain::{Domain, PointCloud, Surface};

const SKIPPED: [&str; 19] = [
    "vt",
    "vn",
    "vp",
    "g",
    "o",
    "s",
    "mg",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "lod",
    "bevel",
    "c_interp",
    "d_interp",
    "shadow_obj",
    "trace_obj",
    "l",
    "p",
];
const FREE_FORM: [&str; 11] =
    ["curv", "curv2", "surf", "cstype", "deg", "bmat", "step", "parm", "trim", "hole", "call"];

pub(super) fn parse(name: &str, bytes: &[u8]) -> Result<Domain, ReadError> {
    let mut mesh = Mesh::read(name, bytes, None)?;
    let vertices = mesh.positions.len();
    if vertices == 0 {
        let (place, advice) = (Place::file(name), "write a line 'v x y z' for each vertex".into());
        return Err(ReadError::Missing { place, what: "vertex".into(), advice });
    }
    if mesh.ahead > vertices as i64 {
        // Some index names no vertex. Now that their number is known, the first such index says so where it stands.
        mesh = Mesh::read(name, bytes, Some(vertices))?;
    }
    let domain = |source| ReadError::Domain { file: name.to_string(), source };
    if mesh.faces.is_empty() {
        return Ok(PointCloud::new(mesh.positions, None).map_err(domain)?.into());
    }
    Ok(Surface::new(mesh.positions, mesh.faces).map_err(domain)?.into())
}

/// A line, with those after it as long as they end in `\`. A clone reads the same words again.
#[derive(Clone)]
struct Statement<'a> {
    lines: Lines<'a>,
    line: Line<'a>,
}

impl<'a> Statement<'a> {
    /// The next word; the empty one at the end.
    fn word(&mut self) -> Word<'a> {
        loop {
            let word = self.line.word_or_end();
            let Some(cut) = word.continued() else { return word };
            if let Some(next) = self.lines.raw() {
                self.line = next;
            }
            if !cut.bytes().is_empty() {
                return cut;
            }
        }
    }

    /// The lines behind the statement.
    fn rest(mut self) -> Lines<'a> {
        while !self.word().bytes().is_empty() {}
        self.lines
    }
}

/// What has been read.
#[derive(Default)]
struct Mesh {
    positions: Vec<[f64; 3]>,
    faces: Vec<Vec<usize>>,
    /// The largest index of a vertex that had not been read where it was named.
    ahead: i64,
    /// The number of vertices, once the file has been read before.
    known: Option<usize>,
}

impl Mesh {
    fn read(name: &str, bytes: &[u8], known: Option<usize>) -> Result<Self, ReadError> {
        let mut lines = Lines::new(name, bytes, Comments::Hash)?;
        let mut mesh = Mesh { known, ..Mesh::default() };
        while let Some(line) = lines.next() {
            let mut statement = Statement { lines, line };
            mesh.take(&mut statement)?;
            lines = statement.rest();
        }
        Ok(mesh)
    }

    fn take(&mut self, statement: &mut Statement) -> Result<(), ReadError> {
        let keyword = statement.word();
        let is_one_of = |list: &[&str]| list.iter().any(|known| known.as_bytes() == keyword.bytes());
        match keyword.bytes() {
            b"v" => self.vertex(statement),
            b"f" | b"fo" => self.face(keyword, statement),
            _ if is_one_of(&SKIPPED) || keyword.bytes().is_empty() => Ok(()),
            _ if is_one_of(&FREE_FORM) => {
                let what = format!("{}: a curve or free-form surface", keyword.shown());
                let advice = "export the object as a polygon mesh";
                Err(ReadError::Unsupported { place: keyword.place(), what, advice })
            }
            _ => Err(keyword
                .expected("a statement of OBJ", "a mesh has lines 'v x y z' and 'f i j k'; '#' begins a comment")),
        }
    }

    /// Coordinates, then nothing, a weight, a colour, or a weight and a colour.
    fn vertex(&mut self, statement: &mut Statement) -> Result<(), ReadError> {
        // One more than a vertex has; the empty word at the end counts.
        let mut words = vec![statement.word()];
        while words.len() < 9 && words.last().is_some_and(|w| !w.bytes().is_empty()) {
            words.push(statement.word());
        }
        let end = words.len() - 1;
        let at = |k: usize| words[k.min(end)];
        self.positions.push([at(0).coordinate(0)?, at(1).coordinate(1)?, at(2).coordinate(2)?]);
        for word in &words[3..end] {
            word.real("weight or colour")?;
        }
        if matches!(end, 4 | 7) && words[3].real("weight")? != 1.0 {
            return Err(words[3].expected("the weight 1", "divide the coordinates by the weight and leave it out"));
        }
        if !matches!(end, 3 | 4 | 6 | 7) {
            return Err(words[end.min(7)].expected(
                if end > 7 { "the end of the line" } else { "three numbers of a colour" },
                "a vertex is x y z, x y z w, x y z r g b or x y z w r g b",
            ));
        }
        Ok(())
    }

    fn face(&mut self, keyword: Word, statement: &mut Statement) -> Result<(), ReadError> {
        let start = statement.clone();
        let mut vertices = Vec::new();
        loop {
            let word = statement.word();
            if word.bytes().is_empty() {
                break;
            }
            vertices.push(self.corner(word)?);
        }
        face::check(&vertices, 1, "remove it", |at| {
            let mut again = start.clone();
            let word = (0..=at).map(|_| again.word()).last().filter(|w| !w.bytes().is_empty());
            word.unwrap_or(keyword).place()
        })?;
        self.faces.push(vertices);
        Ok(())
    }

    /// The vertex of a corner `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 0.
    fn corner(&mut self, word: Word) -> Result<usize, ReadError> {
        let form = |advice| word.expected("a corner v, v/vt, v//vn or v/vt/vn", advice);
        let mut parts = word.bytes().split(|&b| b == b'/');
        let whole = |part: &[u8]| match part {
            [] => Err("an index is missing beside a slash"),
            digits => number::whole(digits),
        };
        let index = whole(parts.next().unwrap_or_default()).map_err(form)?;
        // One more than a corner has: that many slashes are refused below.
        let rest: Vec<&[u8]> = parts.take(3).collect();
        for (k, part) in rest.iter().enumerate() {
            let skipped_texture = part.is_empty() && k == 0 && rest.len() == 2;
            match whole(part) {
                _ if skipped_texture => {}
                Ok(0) => return Err(ReadError::ZeroIndex { place: word.place() }),
                Ok(_) if k < 2 => {}
                Ok(_) => return Err(form("a corner has at most two slashes")),
                Err(advice) => return Err(form(advice)),
            }
        }
        self.resolve(index, word)
    }

    fn resolve(&mut self, index: i64, word: Word) -> Result<usize, ReadError> {
        let read = self.positions.len() as i64;
        let vertex = match index {
            0 => return Err(ReadError::ZeroIndex { place: word.place() }),
            i if i > 0 => i - 1,
            i if i + read >= 0 => i + read,
            _ => {
                let advice = "a negative index counts back from the vertex read last";
                let (place, vertices) = (word.place(), self.positions.len());
                return Err(ReadError::IndexOutOfRange { place, index, vertices, base: 1, advice });
            }
        };
        if vertex >= read {
            match self.known {
                Some(vertices) if vertex >= vertices as i64 => {
                    return Err(ReadError::index(word.place(), index, vertices, 1));
                }
                _ => self.ahead = self.ahead.max(index),
            }
        }
        // A whole number from 0 up fits `usize` wherever 64-bit files are read; elsewhere it is out of range in the second reading.
        Ok(usize::try_from(vertex).unwrap_or(usize::MAX))
    }
}

/// The surface as OBJ. Numbers have the fewest digits that read back bit for bit.
pub fn write_obj(surface: &Surface) -> String {
    let mut text = String::new();
    for [x, y, z] in surface.positions() {
        text.push_str(&format!("v {x:?} {y:?} {z:?}\n"));
    }
    for corners in surface.faces() {
        text.push('f');
        corners.iter().for_each(|v| text.push_str(&format!(" {}", v + 1)));
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(text: &str) -> Surface {
        parse("t.obj", text.as_bytes()).unwrap().as_surface().unwrap().clone()
    }

    const VERTICES: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    #[test]
    fn every_form_of_a_corner_names_the_same_face() {
        for face in [
            "f 1 2 3 4",
            "f 1/1 2/2 3/3 4/4",
            "f 1//9 2//9 3//9 4//9",
            "f 1/1/1 2/2/1 3/3/-1 4/4/1",
            "f -4 -3 -2 -1",
            "f 1 2 \\\n 3\\\n 4",
            "f 1 2 3 4 \\",
            "f 1 2 3 4 # a square",
            "f 1 2 3 4\\\n\nl 1 2",
        ] {
            let found = surface(&format!("{VERTICES}{face}"));
            assert_eq!(*found.faces(), [[0, 1, 2, 3]], "{face}");
            assert_eq!(found.positions().len(), 4);
        }
    }

    #[test]
    fn a_face_may_stand_before_its_vertices_unless_it_counts_back() {
        assert_eq!(surface(&format!("f 1 2 3\n{VERTICES}")).faces().to_vec(), [[0, 1, 2]]);
        assert!(parse("t.obj", format!("f -1 -2 -3\n{VERTICES}").as_bytes()).is_err());
    }

    #[test]
    fn weights_of_one_and_colours_are_skipped() {
        for extra in ["", " 1", " 1.0", " 0.5 0.5 0.5", " 1 0.5 0.5 0.5"] {
            let text = format!("{}f 1 2 3 4", VERTICES.replace(" 0\n", &format!(" 0{extra}\n")));
            assert_eq!(surface(&text).positions(), surface(&format!("{VERTICES}f 1 2 3 4")).positions(), "{extra}");
        }
    }

    #[test]
    fn without_faces_it_is_a_point_cloud() {
        assert!(matches!(parse("t.obj", VERTICES.as_bytes()), Ok(Domain::Points(_))));
    }
}
