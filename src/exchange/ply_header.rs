//! The header of a PLY file: encoding, elements, properties.

use super::error::{Place, ReadError};
use super::text::{Count, Line, Lines, Word};

/// How the rows behind the header are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Type {
    Char,
    UChar,
    Short,
    UShort,
    Int,
    UInt,
    Float,
    Double,
}

impl Type {
    /// The type with this name, in the old or in the new spelling.
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Type::Char,
            b"uchar" | b"uint8" => Type::UChar,
            b"short" | b"int16" => Type::Short,
            b"ushort" | b"uint16" => Type::UShort,
            b"int" | b"int32" => Type::Int,
            b"uint" | b"uint32" => Type::UInt,
            b"float" | b"float32" => Type::Float,
            b"double" | b"float64" => Type::Double,
            _ => return None,
        })
    }

    /// The number of bytes in a binary file.
    pub fn size(self) -> usize {
        match self {
            Type::Char | Type::UChar => 1,
            Type::Short | Type::UShort => 2,
            Type::Int | Type::UInt | Type::Float => 4,
            Type::Double => 8,
        }
    }

    /// The values that a whole-number type holds; `None` for the other two.
    pub fn whole_range(self) -> Option<(i64, i64)> {
        match self {
            Type::Char => Some((i8::MIN.into(), i8::MAX.into())),
            Type::UChar => Some((0, u8::MAX.into())),
            Type::Short => Some((i16::MIN.into(), i16::MAX.into())),
            Type::UShort => Some((0, u16::MAX.into())),
            Type::Int => Some((i32::MIN.into(), i32::MAX.into())),
            Type::UInt => Some((0, u32::MAX.into())),
            Type::Float | Type::Double => None,
        }
    }
}

/// What a property holds in each row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// One number.
    Scalar(Type),
    /// A count, then as many items.
    List { count: Type, item: Type },
}

/// A named column of an element.
pub(super) struct Property<'a> {
    pub name: Word<'a>,
    pub shape: Shape,
}

impl Property<'_> {
    /// Whether it is one number.
    pub fn is_scalar(&self) -> bool {
        matches!(self.shape, Shape::Scalar(_))
    }
}

/// A table of the file.
pub(super) struct Element<'a> {
    pub name: Word<'a>,
    pub rows: Count<'a>,
    pub properties: Vec<Property<'a>>,
}

impl Element<'_> {
    /// Whether it has this name.
    pub fn is(&self, name: &str) -> bool {
        self.name.bytes() == name.as_bytes()
    }

    /// What a message calls its rows.
    pub fn rows_of(&self) -> String {
        format!("rows of element {}", self.name.shown())
    }

    /// The number of the property with one of these names.
    pub fn property(&self, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|p| names.iter().any(|n| n.as_bytes() == p.name.bytes()))
    }

    /// The fewest bytes a row can take.
    fn least_bytes(&self, encoding: Encoding) -> usize {
        let binary = |p: &Property| match p.shape {
            Shape::Scalar(ty) | Shape::List { count: ty, .. } => ty.size(),
        };
        match encoding {
            Encoding::Ascii => 2 * self.properties.len(),
            _ => self.properties.iter().map(binary).sum(),
        }
    }
}

/// Encoding and elements, in the order of the file.
pub(super) struct Header<'a> {
    pub encoding: Encoding,
    pub elements: Vec<Element<'a>>,
}

impl<'a> Header<'a> {
    /// Reads the lines up to `end_header`.
    pub fn read(name: &str, lines: &mut Lines<'a>) -> Result<Self, ReadError> {
        let magic = lines.next().map(|mut line| line.word_or_end());
        match magic {
            Some(word) if word.bytes() == b"ply" => {}
            Some(word) => return Err(word.expected("the word 'ply'", "a PLY file begins with a line 'ply'")),
            None => {
                let advice = "a PLY file begins with a line 'ply'".into();
                return Err(ReadError::Missing { place: Place::file(name), what: "header".into(), advice });
            }
        }
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        loop {
            let Some(mut line) = lines.next() else {
                let advice = "the header ends with a line 'end_header'; is the file cut short?".into();
                return Err(ReadError::Missing { place: lines.end(), what: "line 'end_header'".into(), advice });
            };
            let keyword = line.word_or_end();
            match keyword.bytes() {
                b"comment" | b"obj_info" => {}
                b"format" => encoding = Some(read_encoding(&mut line)?),
                b"element" => elements.push(read_element(&mut line, &elements)?),
                b"property" => {
                    let element = elements.last_mut().ok_or_else(|| {
                        keyword.expected("an element first", "a property belongs to the element line above it")
                    })?;
                    element.properties.push(read_property(&mut line, &element.properties)?);
                }
                b"end_header" => break,
                _ => {
                    return Err(keyword.expected(
                        "a line of a PLY header",
                        "they begin with format, element, property, comment, obj_info or end_header",
                    ));
                }
            }
        }
        let no_format = || ReadError::Missing {
            place: lines.end(),
            what: "line 'format' in the header".into(),
            advice: "write 'format ascii 1.0', or binary_little_endian or binary_big_endian, below 'ply'".into(),
        };
        let header = Header { encoding: encoding.ok_or_else(no_format)?, elements };
        header.check_sizes(lines.remaining())?;
        Ok(header)
    }

    /// Refuses an element without properties, and one with more rows than the rest of the file can hold.
    fn check_sizes(&self, bytes: usize) -> Result<(), ReadError> {
        for element in &self.elements {
            let promised = element.rows.value;
            if element.properties.is_empty() && promised > 0 {
                let advice = "its rows would be empty: declare its properties or remove the element".into();
                let what = format!("property of element {}", element.name.shown());
                return Err(ReadError::Missing { place: element.name.place(), what, advice });
            }
            let most = (bytes + 1) / element.least_bytes(self.encoding).max(1);
            if promised > most {
                let (place, what) = (element.rows.word.place(), element.rows_of().into());
                return Err(ReadError::Oversized { place, what, promised, bytes, most });
            }
        }
        Ok(())
    }

    /// The element with this name, if it has rows.
    pub fn element(&self, name: &str) -> Option<&Element<'a>> {
        self.elements.iter().find(|e| e.is(name) && e.rows.value > 0)
    }
}

fn read_encoding(line: &mut Line) -> Result<Encoding, ReadError> {
    let word = line.word_or_end();
    let encoding = match word.bytes() {
        b"ascii" => Encoding::Ascii,
        b"binary_little_endian" => Encoding::LittleEndian,
        b"binary_big_endian" => Encoding::BigEndian,
        _ => {
            return Err(
                word.expected("ascii, binary_little_endian or binary_big_endian", "these are the encodings of PLY")
            );
        }
    };
    let version = line.word_or_end();
    if version.bytes() != b"1.0" {
        return Err(version.expected("the version 1.0", "there is no other version of PLY"));
    }
    line.finish("a format line is 'format', encoding and version")?;
    Ok(encoding)
}

fn read_element<'a>(line: &mut Line<'a>, before: &[Element]) -> Result<Element<'a>, ReadError> {
    let name = line.word_or_end();
    if name.bytes().is_empty() {
        return Err(name.expected("the name of the element", "an element line is 'element', name and number of rows"));
    }
    if before.iter().any(|e| e.name.bytes() == name.bytes()) {
        return Err(ReadError::Twice { place: name.place(), what: format!("element {}", name.shown()) });
    }
    let rows = line.count("number of rows")?;
    line.finish("an element line is 'element', name and number of rows")?;
    Ok(Element { name, rows, properties: Vec::new() })
}

fn read_property<'a>(line: &mut Line<'a>, before: &[Property]) -> Result<Property<'a>, ReadError> {
    let first = line.word_or_end();
    let shape = if first.bytes() == b"list" {
        let (count_word, item) = (line.word_or_end(), line.word_or_end());
        let count = read_type(count_word)?;
        if count.whole_range().is_none() {
            return Err(count_word.expected("a whole-number type for the count of a list", "uchar is usual"));
        }
        Shape::List { count, item: read_type(item)? }
    } else {
        Shape::Scalar(read_type(first)?)
    };
    let name = line.word_or_end();
    if name.bytes().is_empty() {
        return Err(name.expected("the name of the property", "a property line is 'property', type and name"));
    }
    if before.iter().any(|p| p.name.bytes() == name.bytes()) {
        return Err(ReadError::Twice { place: name.place(), what: format!("property {}", name.shown()) });
    }
    line.finish("a property line is 'property', type and name")?;
    Ok(Property { name, shape })
}

fn read_type(word: Word) -> Result<Type, ReadError> {
    const ADVICE: &str = "the types are char, uchar, short, ushort, int, uint, float, double, or int8 to float64";
    Type::named(word.bytes()).ok_or_else(|| word.expected("a type", ADVICE))
}
