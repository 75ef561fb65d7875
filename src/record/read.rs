//! Reading a record back.

use std::collections::HashSet;
use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::{Digest, Line, Record, SCHEMA};

/// Why a record could not be read: which line, and what is wrong there.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file could not be read.
    #[error("{path}: {source}")]
    Io {
        /// The file.
        path: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// No line at all.
    #[error("the record is empty; a record begins with a header line")]
    Empty,
    /// A line that is not text.
    #[error("line {line}: not UTF-8 text; the record is damaged")]
    NotText {
        /// Which line.
        line: usize,
    },
    /// A line that is not of the schema.
    #[error("line {line}: {what}; the record is damaged")]
    Malformed {
        /// Which line.
        line: usize,
        /// What is wrong.
        what: String,
    },
    /// A schema of another version.
    #[error("the record has schema {found}, this program reads schema {SCHEMA}; use the program that wrote it")]
    UnknownSchema {
        /// The schema found.
        found: u64,
    },
    /// A line in the wrong place.
    #[error("line {line}: {what}")]
    OutOfPlace {
        /// Which line.
        line: usize,
        /// What is wrong.
        what: &'static str,
    },
    /// The same thing twice.
    #[error("line {line}: {what} was recorded before; merge records with the merge command, not by joining files")]
    Twice {
        /// Which line.
        line: usize,
        /// What came twice.
        what: String,
    },
    /// The lines are not those that the footer speaks of.
    #[error("the footer states digest {stated}, the lines have {found}; the record was changed after it was written")]
    Digest {
        /// What the footer states.
        stated: String,
        /// What the lines add up to.
        found: String,
    },
}

impl Record {
    /// Reads a record from a file.
    ///
    /// # Errors
    /// See [`Record::parse`].
    pub fn read(path: &Path) -> Result<Record, ReadError> {
        let bytes = std::fs::read(path).map_err(|source| ReadError::Io { path: path.display().to_string(), source })?;
        Record::parse(&bytes)
    }

    /// Reads a record from its text. A line counts once its newline is written: a last line without one was torn when the
    /// run was killed, and is dropped with a notice. Where there is a footer its digest is compared.
    ///
    /// # Errors
    /// Any other damage, with the line; a schema of another version.
    pub fn parse(bytes: &[u8]) -> Result<Record, ReadError> {
        let intact = intact_length(bytes);
        let mut reader = Reader::default();
        for (at, text) in bytes[..intact].split_inclusive(|&b| b == b'\n').enumerate() {
            reader.take(at + 1, &text[..text.len() - 1])?;
        }
        let mut record = reader.record.ok_or(ReadError::Empty)?;
        if let Some(footer) = &record.footer {
            let found = reader.digest.value();
            if found != footer.results_digest {
                return Err(ReadError::Digest { stated: footer.results_digest.clone(), found });
            }
        }
        if intact < bytes.len() {
            let line = bytes[..intact].iter().filter(|&&b| b == b'\n').count() + 1;
            record.notices.push(format!("line {line}, the last one, is torn (no newline) and was dropped"));
        }
        Ok(record)
    }
}

/// The length of the part of a record that is whole: up to and with the last newline. A run that goes on cuts the file here.
pub(super) fn intact_length(bytes: &[u8]) -> usize {
    bytes.iter().rposition(|&b| b == b'\n').map_or(0, |at| at + 1)
}

impl Record {
    /// The length of the part of a record's text that is whole: a run that goes on cuts its file here.
    pub fn intact_length(bytes: &[u8]) -> usize {
        intact_length(bytes)
    }
}

#[derive(Default)]
struct Reader {
    record: Option<Record>,
    digest: Digest,
    seen: HashSet<[String; 4]>,
}

impl Reader {
    fn take(&mut self, number: usize, text: &[u8]) -> Result<(), ReadError> {
        let text = std::str::from_utf8(text).map_err(|_| ReadError::NotText { line: number })?;
        if self.record.is_none() {
            check_schema(number, text)?;
        }
        let line = line(text).map_err(|what| ReadError::Malformed { line: number, what })?;
        let out_of_place = |what| Err(ReadError::OutOfPlace { line: number, what });
        match (&mut self.record, &line) {
            (None, Line::Header(header)) => {
                self.record = Some(Record::new(header.clone()));
                return self.digest.add(&line).map_err(|e| ReadError::Malformed { line: number, what: e.to_string() });
            }
            (None, _) => return out_of_place("a record begins with a header; this is another line"),
            (Some(_), Line::Header(_)) => return out_of_place("a second header; these are two records in one file"),
            (Some(record), _) if record.footer.is_some() => {
                return out_of_place("there are lines after the footer, which is the last line of a record");
            }
            (Some(record), _) => {
                if let Some(key) = key(&line) {
                    let what = key.iter().filter(|k| !k.is_empty()).cloned().collect::<Vec<_>>().join(" ");
                    if !self.seen.insert(key) {
                        return Err(ReadError::Twice { line: number, what });
                    }
                }
                if !matches!(line, Line::Timing(_) | Line::Footer(_)) {
                    self.digest.add_text(text);
                }
                record.push(line);
            }
        }
        Ok(())
    }
}

/// What may be recorded only once.
fn key(line: &Line) -> Option<[String; 4]> {
    let key = |kind: &str, a: &str, b: &str, c: &str| Some([kind, a, b, c].map(str::to_string));
    match line {
        Line::Domain(d) => key("domain", &d.recipe, "", ""),
        Line::Broken(b) => key("broken", &b.recipe, "", ""),
        Line::Operator(o) => key("operator", &o.laplacian, &o.recipe, ""),
        Line::Cell(c) => key("cell", &c.laplacian, &c.property, &c.recipe),
        Line::Claim(c) => key("claim", &c.id, "", ""),
        Line::Atlas(a) => key("atlas", &a.laplacian, &a.property, ""),
        Line::Exhibit(e) => key("exhibit", &e.laplacian, &e.property, ""),
        Line::Header(_) | Line::Timing(_) | Line::Footer(_) => None,
    }
}

/// The schema comes first: a header of another version may look different in everything else.
fn check_schema(number: usize, text: &str) -> Result<(), ReadError> {
    #[derive(Deserialize)]
    struct Version {
        schema: u64,
    }
    match serde_json::from_str::<Version>(text) {
        Ok(Version { schema }) if schema == u64::from(SCHEMA) => Ok(()),
        Ok(Version { schema }) => Err(ReadError::UnknownSchema { found: schema }),
        Err(_) => {
            Err(ReadError::OutOfPlace { line: number, what: "not the header of a record (no number named `schema`)" })
        }
    }
}

/// One line. The kind is looked up first and the rest read straight into its type: faster than buffering the line to find
/// its tag, and the errors name the column.
pub(super) fn line(text: &str) -> Result<Line, String> {
    #[derive(Deserialize)]
    struct Kind<'a> {
        line: &'a str,
    }
    let kind: Kind = serde_json::from_str(text).map_err(in_words)?;
    match kind.line {
        "header" => typed(text).map(Line::Header),
        "domain" => typed(text).map(Line::Domain),
        "operator" => typed(text).map(Line::Operator),
        "broken" => typed(text).map(Line::Broken),
        "cell" => typed(text).map(Line::Cell),
        "claim" => typed(text).map(Line::Claim),
        "atlas" => typed(text).map(Line::Atlas),
        "exhibit" => typed(text).map(Line::Exhibit),
        "timing" => typed(text).map(Line::Timing),
        "footer" => typed(text).map(Line::Footer),
        other => Err(format!("unknown kind of line `{other}`")),
    }
}

fn typed<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    serde_json::from_str(text).map_err(in_words)
}

/// The message without "at line 1", which would contradict the number of the line in the record.
fn in_words(error: serde_json::Error) -> String {
    let column = error.column();
    let text = error.to_string();
    let what = text.rsplit_once(" at line ").map_or(text.as_str(), |(what, _)| what);
    format!("column {column}: {what}")
}
