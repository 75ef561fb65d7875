//! PLY, in ascii and binary.
//!
//! Read are `x`, `y`, `z` of the element `vertex`, `vertex_indices` or `vertex_index` of the element `face`, and, where there
//! are no faces, the normals `nx`, `ny`, `nz`. Other elements and properties are skipped, whatever their types. A number has
//! the precision of its declared type in ascii as well (`0.1` under `float` is 0.100000001490116…): the same mesh is the same
//! in each encoding, and is what other programs read.

use super::bytes::Bytes;
use super::error::{Place, ReadError};
use super::ply_header::{Element, Encoding, Header, Shape, Type};
use super::text::{Comments, Line, Lines, Word};
use super::{face, number};
use crate::domain::{Domain, PointCloud, Surface};

pub(super) fn parse(name: &str, bytes: &[u8]) -> Result<Domain, ReadError> {
    let mut lines = Lines::new(name, bytes, Comments::None)?;
    let header = Header::read(name, &mut lines)?;
    check_elements(name, &header)?;
    let start = bytes.len() - lines.remaining();
    match header.encoding {
        Encoding::Ascii => read(name, &header, Ascii { lines, line: None }),
        other => {
            read(name, &header, Binary { bytes: Bytes::new(name, bytes, start), big: other == Encoding::BigEndian })
        }
    }
}

/// Where the numbers come from, one after the other.
trait Body {
    /// A place that is cheap to remember.
    type Mark: Copy;
    /// Goes to the next row; `false` at the end of the file.
    fn start_row(&mut self) -> bool;
    /// The next number, of the property with this name; `None` where binary data end. Every type fits into `f64`.
    fn number(&mut self, ty: Type, name: &str) -> Result<Option<(f64, Self::Mark)>, ReadError>;
    /// Refuses more numbers in the row.
    fn end_row(&mut self) -> Result<(), ReadError>;
    /// What follows the last row, with its place.
    fn surplus(&mut self) -> Option<(Place, String)>;
    /// The place of a mark.
    fn place(&self, mark: Self::Mark) -> Place;
    /// Where reading has come to.
    fn here(&self) -> Place;
}

struct Ascii<'a> {
    lines: Lines<'a>,
    line: Option<Line<'a>>,
}

impl<'a> Body for Ascii<'a> {
    type Mark = Word<'a>;

    fn start_row(&mut self) -> bool {
        self.line = self.lines.next();
        self.line.is_some()
    }

    fn number(&mut self, ty: Type, name: &str) -> Result<Option<(f64, Word<'a>)>, ReadError> {
        let Some(line) = &mut self.line else { return Ok(None) };
        let word = line.word_or_end();
        let value = match (ty.whole_range(), ty) {
            (Some((low, high)), _) => {
                let value = word.integer(name)?;
                if !(low..=high).contains(&value) {
                    return Err(word.expected(
                        format!("a whole number from {low} to {high}"),
                        "its type in the header holds no other",
                    ));
                }
                value as f64
            }
            (None, Type::Float) => match number::special(word.bytes()) {
                Some(special) => special,
                None => number::finite_single(word.bytes())
                    .map_err(|advice| word.expected(format!("a number ({name})"), advice))?
                    .into(),
            },
            (None, _) => word.value(name)?,
        };
        Ok(Some((value, word)))
    }

    fn end_row(&mut self) -> Result<(), ReadError> {
        self.line.as_mut().map_or(Ok(()), |line| line.finish("the header declares fewer numbers in a row"))
    }

    fn surplus(&mut self) -> Option<(Place, String)> {
        self.lines.next()?.word().map(|word| (word.place(), word.shown()))
    }

    fn place(&self, word: Word<'a>) -> Place {
        word.place()
    }

    fn here(&self) -> Place {
        self.lines.end()
    }
}

struct Binary<'a> {
    bytes: Bytes<'a>,
    big: bool,
}

impl Binary<'_> {
    fn take<const N: usize, T>(&mut self, little: fn([u8; N]) -> T, big: fn([u8; N]) -> T) -> Option<T> {
        self.bytes.take().map(if self.big { big } else { little })
    }
}

impl Body for Binary<'_> {
    type Mark = usize;

    fn start_row(&mut self) -> bool {
        self.bytes.remaining() > 0
    }

    fn number(&mut self, ty: Type, _: &str) -> Result<Option<(f64, usize)>, ReadError> {
        let offset = self.bytes.offset();
        let value = match ty {
            Type::Char => self.take(i8::from_le_bytes, i8::from_be_bytes).map(f64::from),
            Type::UChar => self.take(u8::from_le_bytes, u8::from_be_bytes).map(f64::from),
            Type::Short => self.take(i16::from_le_bytes, i16::from_be_bytes).map(f64::from),
            Type::UShort => self.take(u16::from_le_bytes, u16::from_be_bytes).map(f64::from),
            Type::Int => self.take(i32::from_le_bytes, i32::from_be_bytes).map(f64::from),
            Type::UInt => self.take(u32::from_le_bytes, u32::from_be_bytes).map(f64::from),
            Type::Float => self.take(f32::from_le_bytes, f32::from_be_bytes).map(f64::from),
            Type::Double => self.take(f64::from_le_bytes, f64::from_be_bytes),
        };
        Ok(value.map(|v| (v, offset)))
    }

    fn end_row(&mut self) -> Result<(), ReadError> {
        Ok(())
    }

    fn surplus(&mut self) -> Option<(Place, String)> {
        let left = self.bytes.remaining();
        (left > 0).then(|| (self.here(), format!("{left} bytes")))
    }

    fn place(&self, offset: usize) -> Place {
        self.bytes.place(offset)
    }

    fn here(&self) -> Place {
        self.bytes.place(self.bytes.offset())
    }
}

/// Refuses a header from which no domain can come.
fn check_elements(name: &str, header: &Header) -> Result<(), ReadError> {
    let missing = |place: Place, what: &str, advice: &'static str| {
        Err(ReadError::Missing { place, what: what.to_string(), advice: advice.into() })
    };
    let Some(vertex) = header.element("vertex") else {
        return missing(Place::file(name), "element 'vertex' with rows", "a mesh or point cloud needs vertices");
    };
    for axis in ["x", "y", "z"] {
        let found = vertex.property(&[axis]).map(|k| vertex.properties[k].shape);
        if !matches!(found, Some(Shape::Scalar(_))) {
            let what = format!("scalar property '{axis}' of element 'vertex'");
            return missing(vertex.name.place(), &what, "the coordinates are the properties x, y and z");
        }
    }
    let Some(face) = header.element("face") else {
        return match header.element("tristrips") {
            Some(strips) => Err(ReadError::Unsupported {
                place: strips.name.place(),
                what: "a mesh of triangle strips".into(),
                advice: "export it with an element 'face'",
            }),
            None => Ok(()),
        };
    };
    match corners_property(face).map(|k| face.properties[k].shape) {
        Some(Shape::List { item, .. }) if item.whole_range().is_some() => Ok(()),
        _ => missing(
            face.name.place(),
            "property 'vertex_indices' of element 'face'",
            "declare 'property list uchar int vertex_indices'",
        ),
    }
}

fn corners_property(face: &Element) -> Option<usize> {
    face.property(&["vertex_indices", "vertex_index"])
}

fn read<B: Body>(name: &str, header: &Header, mut body: B) -> Result<Domain, ReadError> {
    let (mut positions, mut normals, mut faces) = (Vec::new(), None, Vec::new());
    let vertices = header.element("vertex").map_or(0, |e| e.rows.value);
    for element in &header.elements {
        if element.is("vertex") {
            (positions, normals) = read_vertices(&mut body, element)?;
        } else if element.is("face") {
            faces = read_faces(&mut body, element, vertices)?;
        } else {
            (0..element.rows.value).try_for_each(|row| read_row(&mut body, element, row, |_, _, _, _| Ok(())))?;
        }
    }
    if let (Some((place, found)), Some(last)) = (body.surplus(), header.elements.last()) {
        return Err(ReadError::TooMany { place, what: last.rows_of().into(), promised: last.rows.value, found });
    }
    let domain = |source| ReadError::Domain { file: name.to_string(), source };
    if faces.is_empty() {
        return Ok(PointCloud::new(positions, normals).map_err(domain)?.into());
    }
    Ok(Surface::new(positions, faces).map_err(domain)?.into())
}

/// Reads a row and hands every number of it, the counts of lists aside, to `take` with the number of its property.
fn read_row<B: Body>(
    body: &mut B,
    element: &Element,
    row: usize,
    mut take: impl FnMut(&B, usize, f64, B::Mark) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    let ended = |body: &B| ReadError::TooFew {
        place: body.here(),
        what: element.rows_of().into(),
        promised: element.rows.value,
        found: row,
    };
    if !body.start_row() {
        return Err(ended(body));
    }
    for (k, property) in element.properties.iter().enumerate() {
        let name = String::from_utf8_lossy(property.name.bytes());
        let (ty, items) = match property.shape {
            Shape::Scalar(ty) => (ty, 1),
            Shape::List { count, item } => {
                let (items, mark) = body.number(count, &name)?.ok_or_else(|| ended(body))?;
                if items < 0.0 {
                    let (place, expected) = (body.place(mark), "the number of items of a list".into());
                    let advice = "it cannot be negative".into();
                    return Err(ReadError::Expected { place, expected, found: format!("'{items}'"), advice });
                }
                (item, items as u64)
            }
        };
        for _ in 0..items {
            let (value, mark) = body.number(ty, &name)?.ok_or_else(|| ended(body))?;
            take(body, k, value, mark)?;
        }
    }
    body.end_row()
}

type Points = Vec<[f64; 3]>;

/// Positions, and normals where they are declared.
fn read_vertices<B: Body>(body: &mut B, element: &Element) -> Result<(Points, Option<Points>), ReadError> {
    let rows = element.rows.value;
    let mut columns = ["x", "y", "z", "nx", "ny", "nz"].map(|name| element.property(&[name]));
    let has_normals = columns[3..].iter().all(|c| c.is_some_and(|k| element.properties[k].is_scalar()));
    if !has_normals {
        columns[3..].fill(None);
    }
    let (mut positions, mut normals) = (vec![[0.0; 3]; rows], vec![[0.0; 3]; if has_normals { rows } else { 0 }]);
    for row in 0..rows {
        read_row(body, element, row, |body, property, value, mark| {
            match columns.iter().position(|&c| c == Some(property)) {
                Some(axis @ 0..3) => {
                    positions[row][axis] = ReadError::coordinate(value, axis, || body.place(mark))?;
                }
                Some(axis) => normals[row][axis - 3] = ReadError::normal(value, axis - 3, || body.place(mark))?,
                None => {}
            }
            Ok(())
        })?;
    }
    Ok((positions, has_normals.then_some(normals)))
}

fn read_faces<B: Body>(body: &mut B, element: &Element, vertices: usize) -> Result<Vec<Vec<usize>>, ReadError> {
    let at = corners_property(element);
    let mut faces = Vec::with_capacity(element.rows.value);
    for row in 0..element.rows.value {
        let (mut corners, mut marks) = (Vec::new(), Vec::new());
        read_row(body, element, row, |body, property, value, mark| {
            if Some(property) == at {
                if corners.len() == vertices {
                    let (place, corners) = (body.place(mark), vertices as u64 + 1);
                    return Err(ReadError::TooManyCorners { place, corners, vertices });
                }
                let index = value as i64;
                let vertex = usize::try_from(index).ok().filter(|&v| v < vertices);
                corners.push(vertex.ok_or_else(|| ReadError::index(body.place(mark), index, vertices, 0))?);
                marks.push(mark);
            }
            Ok(())
        })?;
        face::check(&corners, 0, "remove it", |at| {
            marks.get(at).map_or_else(|| body.here(), |&mark| body.place(mark))
        })?;
        faces.push(corners);
    }
    Ok(faces)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "comment made by hand\nelement vertex 3\nproperty double x\nproperty uchar red\nproperty float y\n\
        property short z\nproperty list uint double extra\nelement edge 1\nproperty int a\nproperty list char ushort b\n\
        element face 1\nproperty float quality\nproperty list ushort uint vertex_index\nproperty char flag\nend_header\n";

    fn ascii() -> Vec<u8> {
        let rows = "0.1 255 0.1 -3 0\n1 0 0 2 2 1.5 nan\n0 7 1 0 1 9\n\n-5 2 1 65535\n0.5 3 2 0 1 -128\n";
        format!("ply\nformat ascii 1.0\n{HEADER}{rows}").into_bytes()
    }

    /// The rows of [`ascii`] once more, byte by byte.
    fn binary(big: bool) -> Vec<u8> {
        let encoding = if big { "big" } else { "little" };
        let mut file = format!("ply\nformat binary_{encoding}_endian 1.0\n{HEADER}").into_bytes();
        let mut put = |little: &[u8]| {
            if big { file.extend(little.iter().rev()) } else { file.extend(little) }
        };
        for (x, red, y, z, extra) in [
            (0.1_f64, 255_u8, 0.1_f32, -3_i16, vec![]),
            (1.0, 0, 0.0, 2, vec![1.5, f64::NAN]),
            (0.0, 7, 1.0, 0, vec![9.0]),
        ] {
            put(&x.to_le_bytes());
            put(&[red]);
            put(&y.to_le_bytes());
            put(&z.to_le_bytes());
            put(&(extra.len() as u32).to_le_bytes());
            extra.iter().for_each(|e: &f64| put(&e.to_le_bytes()));
        }
        put(&(-5_i32).to_le_bytes());
        put(&[2]);
        put(&1_u16.to_le_bytes());
        put(&65535_u16.to_le_bytes());
        put(&0.5_f32.to_le_bytes());
        put(&3_u16.to_le_bytes());
        [2_u32, 0, 1].iter().for_each(|v| put(&v.to_le_bytes()));
        put(&[128]);
        file
    }

    #[test]
    fn every_encoding_gives_the_same_surface() {
        let expected = [[0.1, f64::from(0.1_f32), -3.0], [1.0, 0.0, 2.0], [0.0, 1.0, 0.0]];
        for file in [ascii(), binary(false), binary(true)] {
            let domain = parse("t.ply", &file).unwrap();
            let surface = domain.as_surface().unwrap();
            assert_eq!((surface.positions(), surface.faces().to_vec()), (&expected[..], vec![vec![2, 0, 1]]));
        }
    }

    #[test]
    fn a_header_with_other_line_ends_does_not_shift_binary_data() {
        let [file, header] = [binary(false), format!("ply\nformat binary_little_endian 1.0\n{HEADER}").into_bytes()];
        // The first byte of the data is a line feed here, which a lone carriage return must not swallow.
        for end in ["\r\n", "\r"] {
            let mut changed = String::from_utf8(header.clone()).unwrap().replace('\n', end).into_bytes();
            let mut data = file[header.len()..].to_vec();
            data[0] = b'\n';
            changed.extend(&data);
            let domain = parse("t.ply", &changed).unwrap();
            assert_eq!(domain.positions().unwrap()[0][0].to_le_bytes()[..], data[..8]);
        }
    }

    #[test]
    fn data_that_end_early_are_refused_at_every_length() {
        let file = binary(true);
        for length in 0..file.len() {
            assert!(parse("t.ply", &file[..length]).is_err(), "{length}");
        }
        assert!(parse("t.ply", &[file, vec![0]].concat()).is_err());
    }

    #[test]
    fn without_faces_it_is_a_point_cloud_with_its_normals() {
        let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
            property float nx\nproperty float ny\nproperty float nz\nend_header\n1 2 3 0 0 1\n";
        let Ok(Domain::Points(points)) = parse("t.ply", text.as_bytes()) else { panic!("points") };
        assert_eq!(points.normals(), Some(&[[0.0, 0.0, 1.0]][..]));
    }
}
