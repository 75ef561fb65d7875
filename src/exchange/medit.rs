//! The mesh format of medit, in text: `.mesh`.
//!
//! ```text
//! MeshVersionFormatted 1
//! Dimension 3
//! Vertices
//! 4
//! 0 0 0  7             coordinates and a reference number
//! …
//! Tetrahedra
//! 1
//! 1 2 3 4  7           vertices, counted from 1, and a reference number
//! End
//! ```
//! With tetrahedra it is a volume, whose triangles and edges are not read; else a surface of its triangles and
//! quadrilaterals; else a point cloud. Reference numbers and all other sections are skipped. `#` begins a comment.

use super::error::{Place, ReadError};
use super::face;
use super::text::{Comments, Count, Line, Lines, Word};
use crate::domain::{Domain, PointCloud, Surface, Volume};

/// Sections that are skipped, with the numbers in a row.
const SKIPPED: [(&str, usize); 12] = [
    ("Edges", 3),
    ("Corners", 1),
    ("Ridges", 1),
    ("RequiredVertices", 1),
    ("RequiredEdges", 1),
    ("RequiredTriangles", 1),
    ("RequiredQuadrilaterals", 1),
    ("Normals", 3),
    ("NormalAtVertices", 2),
    ("Tangents", 3),
    ("TangentAtVertices", 2),
    ("TangentAtEdges", 3),
];

pub(super) fn parse(name: &str, bytes: &[u8]) -> Result<Domain, ReadError> {
    let mut file = File { lines: Lines::new(name, bytes, Comments::Hash)?, line: None };
    let mut mesh = Mesh { dimension: 3, ..Mesh::default() };
    let first =
        file.keyword().ok_or_else(|| missing(name, "keyword 'MeshVersionFormatted'", "a medit file begins with it"))?;
    if first.is("MeshVersionBinary") || first.bytes().first() == Some(&0) {
        let (place, what) = (first.place(), "binary medit (.meshb)".into());
        return Err(ReadError::Unsupported { place, what, advice: "write it as text (.mesh)" });
    }
    if !first.is("MeshVersionFormatted") {
        return Err(first.expected("'MeshVersionFormatted'", "a medit file begins with it"));
    }
    file.count("version")?;
    while let Some(keyword) = file.keyword() {
        if keyword.is("End") {
            break;
        }
        mesh.section(&mut file, keyword)?;
    }
    mesh.finish(name)
}

fn missing(name: &str, what: &str, advice: &'static str) -> ReadError {
    ReadError::Missing { place: Place::file(name), what: what.into(), advice: advice.into() }
}

/// Keywords and counts may share a line; rows have lines of their own.
struct File<'a> {
    lines: Lines<'a>,
    line: Option<Line<'a>>,
}

impl<'a> File<'a> {
    fn keyword(&mut self) -> Option<Word<'a>> {
        if let Some(word) = self.line.as_mut().and_then(Line::word) {
            return Some(word);
        }
        self.line = self.lines.next();
        self.line.as_mut()?.word()
    }

    fn count(&mut self, role: &str) -> Result<Count<'a>, ReadError> {
        let end = self.lines.end();
        let word = self.keyword().ok_or_else(|| {
            let advice = "the file is cut short".into();
            ReadError::Missing { place: end, what: format!("number ({role})"), advice }
        })?;
        Ok(Count { value: word.whole(role)?, word })
    }

    /// Hands each row of a section to `take`; a row has `columns` numbers.
    fn rows(
        &mut self,
        what: &'static str,
        columns: usize,
        mut take: impl FnMut(&mut Line<'a>) -> Result<(), ReadError>,
    ) -> Result<(), ReadError> {
        let count = self.count("number of rows")?;
        self.line.take().map_or(Ok(()), |mut rest| rest.finish("rows begin on a line of their own"))?;
        let promised = self.lines.check_count(count, what, 2 * columns)?;
        for found in 0..promised {
            let mut line = self.lines.row(what, promised, found)?;
            take(&mut line)?;
            line.finish(format!("a row of this section has {columns} numbers, and {promised} rows are promised"))?;
        }
        Ok(())
    }
}

#[derive(Default)]
struct Mesh {
    dimension: usize,
    positions: Vec<[f64; 3]>,
    faces: Vec<Vec<usize>>,
    tetrahedra: Vec<[usize; 4]>,
}

impl Mesh {
    fn section(&mut self, file: &mut File, keyword: Word) -> Result<(), ReadError> {
        if keyword.is("Dimension") {
            let found = file.count("dimension")?;
            self.dimension = found.value;
            let known = matches!(found.value, 2 | 3);
            return if known {
                Ok(())
            } else {
                Err(found.word.expected("the dimension 2 or 3", "no other can be read"))
            };
        }
        if keyword.is("Vertices") {
            return self.vertices(file, keyword);
        }
        let vertices = self.positions.len();
        if keyword.is("Triangles") {
            return file.rows("triangles", 4, |line| {
                corners::<3>(line, vertices, "face").map(|face| self.faces.push(face.to_vec()))
            });
        }
        if keyword.is("Quadrilaterals") {
            return file.rows("quadrilaterals", 5, |line| {
                corners::<4>(line, vertices, "face").map(|face| self.faces.push(face.to_vec()))
            });
        }
        if keyword.is("Tetrahedra") {
            return file.rows("tetrahedra", 5, |line| {
                corners(line, vertices, "tetrahedron").map(|tetrahedron| self.tetrahedra.push(tetrahedron))
            });
        }
        if let Some(&(_, columns)) = SKIPPED.iter().find(|(name, _)| keyword.is(name)) {
            return file.rows("rows", columns, |line| {
                (0..columns).try_for_each(|_| line.word_or_end().real("skipped").map(drop))
            });
        }
        if ["Hexahedra", "Prisms", "Pyramids"].iter().any(|name| keyword.is(name)) {
            let (place, what) = (keyword.place(), format!("section {}", keyword.shown()));
            return Err(ReadError::Unsupported { place, what, advice: "split its cells into tetrahedra" });
        }
        Err(keyword.expected(
            "a section of medit",
            "such as Vertices, Triangles, Tetrahedra or End; is the count of the section before right?",
        ))
    }

    fn vertices(&mut self, file: &mut File, keyword: Word) -> Result<(), ReadError> {
        if !self.positions.is_empty() {
            return Err(ReadError::Twice { place: keyword.place(), what: "section 'Vertices'".into() });
        }
        let dimension = self.dimension;
        file.rows("vertices", dimension + 1, |line| {
            let mut point = [0.0; 3];
            for (axis, x) in point.iter_mut().enumerate().take(dimension) {
                *x = line.word_or_end().coordinate(axis)?;
            }
            self.positions.push(point);
            line.word_or_end().integer("reference number").map(drop)
        })
    }

    fn finish(self, name: &str) -> Result<Domain, ReadError> {
        if self.positions.is_empty() {
            return Err(missing(name, "vertex", "write a section 'Vertices'"));
        }
        let domain = |source| ReadError::Domain { file: name.to_string(), source };
        if !self.tetrahedra.is_empty() {
            Ok(Volume::new(self.positions, self.tetrahedra).map_err(domain)?.into())
        } else if !self.faces.is_empty() {
            Ok(Surface::new(self.positions, self.faces).map_err(domain)?.into())
        } else {
            Ok(PointCloud::new(self.positions, None).map_err(domain)?.into())
        }
    }
}

/// `N` vertices and a reference number.
fn corners<const N: usize>(line: &mut Line, vertices: usize, element: &'static str) -> Result<[usize; N], ReadError> {
    let first = line.clone().word_or_end();
    if vertices == 0 {
        return Err(first.expected("the vertices before this section", "put the section 'Vertices' first"));
    }
    let mut words = [first; N];
    let mut found = [0; N];
    for (vertex, word) in found.iter_mut().zip(&mut words) {
        *word = line.word_or_end();
        *vertex = word.index(vertices, 1)?;
    }
    if let Some(at) = face::repeated(&found) {
        return Err(ReadError::RepeatedVertex { place: words[at].place(), element, vertex: found[at] + 1 });
    }
    line.word_or_end().integer("reference number")?;
    Ok(found)
}

/// The volume as medit text, reference numbers 0. Numbers have the fewest digits that read back bit for bit.
pub fn write_medit(volume: &Volume) -> String {
    let mut text = format!("MeshVersionFormatted 2\nDimension 3\nVertices\n{}\n", volume.positions().len());
    for [x, y, z] in volume.positions() {
        text.push_str(&format!("{x:?} {y:?} {z:?} 0\n"));
    }
    text.push_str(&format!("Tetrahedra\n{}\n", volume.tetrahedra().len()));
    for [a, b, c, d] in volume.tetrahedra() {
        text.push_str(&format!("{} {} {} {} 0\n", a + 1, b + 1, c + 1, d + 1));
    }
    text + "End\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_volume_comes_back_bit_for_bit() {
        let p = vec![[0.1, 0.0, -0.0], [1.0 / 3.0, 0.0, 1e-200], [0.0, 1.0, 0.0], [0.0, 0.0, 1e17]];
        let volume = Volume::new(p, vec![[0, 1, 2, 3]]).unwrap();
        let Ok(Domain::Volume(back)) = parse("t.mesh", write_medit(&volume).as_bytes()) else { panic!("volume") };
        let bits = |v: &Volume| v.positions().iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!((bits(&back), back.tetrahedra()), (bits(&volume), volume.tetrahedra()));
    }

    #[test]
    fn without_tetrahedra_it_is_a_surface_also_in_the_plane() {
        let text = "MeshVersionFormatted 1 Dimension 2 Vertices 4\n0 0 1\n1 0 1\n1 1 1\n0 1 1\nEdges\n1\n1 2 9\n\
            Triangles 1\n1 2 3 0\nQuadrilaterals\n1\n1 3 4 2 0\nEnd and nothing else is read";
        let domain = parse("t.mesh", text.as_bytes()).unwrap();
        let surface = domain.as_surface().unwrap();
        assert_eq!(surface.positions()[2], [1.0, 1.0, 0.0]);
        assert_eq!(surface.faces().iter().map(<[usize]>::len).collect::<Vec<_>>(), [3, 4]);
    }
}
