//! Lines and words of a text, each of which knows its place.
//!
//! Bytes, not characters: a file need not be UTF-8. Line ends are `\n`, `\r\n` or a lone `\r`. Columns are counted only when
//! an error asks for them, so that reading stays linear in long lines.

use std::borrow::Cow;

use super::error::{Place, Position, ReadError};
use super::number;

/// Where comments may stand.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Comments {
    /// From `#` to the end of the line.
    Hash,
    /// Whole lines that begin with `%`.
    PercentLines,
    /// The format has no such comments.
    None,
}

/// The lines of a text. A clone is cheap and reads the same lines again.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    name: &'a str,
    rest: &'a [u8],
    comments: Comments,
    number: usize,
    /// Where the line read last ends.
    end: Word<'a>,
    /// Whether the first line ended in a lone `\r`; a `\n` behind a later `\r` is then not part of the line end.
    lone_return: Option<bool>,
}

impl<'a> Lines<'a> {
    /// Starts at the first line, behind a byte-order mark.
    ///
    /// # Errors
    /// A text in UTF-16.
    pub fn new(name: &'a str, bytes: &'a [u8], comments: Comments) -> Result<Self, ReadError> {
        if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
            let (place, what) = (Place::file(name), "text in UTF-16".to_string());
            return Err(ReadError::Unsupported { place, what, advice: "save the file as UTF-8 or ASCII" });
        }
        let rest = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let end = Word { name, line: &[], number: 1, start: 0, end: 0 };
        Ok(Lines { name, rest, comments, number: 0, end, lone_return: None })
    }

    /// Admits comments from the next line on.
    pub fn allow(&mut self, comments: Comments) {
        self.comments = comments;
    }

    /// The next line, blank or not.
    pub fn raw(&mut self) -> Option<Line<'a>> {
        if self.rest.is_empty() {
            return None;
        }
        let length = self.rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(self.rest.len());
        let full = &self.rest[..length];
        let terminator = match &self.rest[length..] {
            [b'\r', b'\n', ..] if self.lone_return != Some(true) => 2,
            [] => 0,
            _ => 1,
        };
        self.lone_return.get_or_insert(terminator == 1 && self.rest[length] == b'\r');
        self.rest = &self.rest[length + terminator..];
        self.number += 1;
        self.end = Word { name: self.name, line: full, number: self.number, start: length, end: length };
        let stop = match self.comments {
            Comments::Hash => full.iter().position(|&b| b == b'#').unwrap_or(length),
            Comments::PercentLines if full.first() == Some(&b'%') => 0,
            _ => length,
        };
        Some(Line { name: self.name, full, stop, number: self.number, at: 0 })
    }

    /// The next line that holds more than blanks and comments.
    pub fn next(&mut self) -> Option<Line<'a>> {
        loop {
            let line = self.raw()?;
            if line.clone().word().is_some() {
                return Some(line);
            }
        }
    }

    /// The next line with content, which is row `found` of those promised.
    ///
    /// # Errors
    /// The end of the file.
    pub fn row(&mut self, what: &'static str, promised: usize, found: usize) -> Result<Line<'a>, ReadError> {
        let row = self.next();
        row.ok_or_else(|| ReadError::TooFew { place: self.end(), what: what.into(), promised, found })
    }

    /// Refuses anything but blanks and comments up to the end of the file.
    pub fn finish(&mut self, what: &'static str, promised: usize) -> Result<(), ReadError> {
        match self.next().and_then(|mut line| line.word()) {
            None => Ok(()),
            Some(word) => {
                Err(ReadError::TooMany { place: word.place(), what: what.into(), promised, found: word.shown() })
            }
        }
    }

    /// The number of bytes that are left.
    pub fn remaining(&self) -> usize {
        self.rest.len()
    }

    /// Where the line read last ends.
    pub fn end(&self) -> Place {
        self.end.place()
    }

    /// Refuses a count of rows, each at least `least` bytes with its line end, that the rest of the text cannot hold.
    pub fn check_count(&self, count: Count<'a>, what: &'static str, least: usize) -> Result<usize, ReadError> {
        let bytes = self.remaining();
        let most = (bytes + 1) / least;
        if count.value > most {
            let (place, promised) = (count.word.place(), count.value);
            return Err(ReadError::Oversized { place, what: what.into(), promised, bytes, most });
        }
        Ok(count.value)
    }
}

/// A count in a header, with its place.
#[derive(Clone, Copy)]
pub(super) struct Count<'a> {
    /// The number.
    pub value: usize,
    /// Where it stands.
    pub word: Word<'a>,
}

/// A line, read word by word.
#[derive(Clone)]
pub(super) struct Line<'a> {
    name: &'a str,
    full: &'a [u8],
    stop: usize,
    number: usize,
    at: usize,
}

/// A word and its place.
#[derive(Clone, Copy)]
pub(super) struct Word<'a> {
    name: &'a str,
    line: &'a [u8],
    number: usize,
    start: usize,
    end: usize,
}

impl<'a> Word<'a> {
    /// The bytes of the word.
    pub fn bytes(&self) -> &'a [u8] {
        &self.line[self.start..self.end]
    }

    /// Whether it is this word, letter case aside.
    pub fn is(&self, other: &str) -> bool {
        self.bytes().eq_ignore_ascii_case(other.as_bytes())
    }

    /// The word for a message.
    pub fn shown(&self) -> String {
        quoted(self.bytes())
    }

    /// The line it stands in.
    pub fn line_number(&self) -> usize {
        self.number
    }

    /// The word without the `\\` that ends its line, if one does.
    pub fn continued(&self) -> Option<Self> {
        let last = self.line[self.end..].iter().all(u8::is_ascii_whitespace);
        (last && self.bytes().ends_with(b"\\")).then(|| Word { end: self.end - 1, ..*self })
    }

    /// Where it stands. Cost: O(line length).
    pub fn place(&self) -> Place {
        let continued = |b: &u8| b & 0xc0 == 0x80;
        let column = 1 + self.line[..self.start].iter().filter(|b| !continued(b)).count();
        Place { file: self.name.to_string(), position: Position::Text { line: self.number, column } }
    }

    /// "Expected …, found this word; …".
    pub fn expected(&self, expected: impl Into<Cow<'static, str>>, advice: impl Into<Cow<'static, str>>) -> ReadError {
        let found = if self.bytes().is_empty() { "the end of the line".to_string() } else { self.shown() };
        ReadError::Expected { place: self.place(), expected: expected.into(), found, advice: advice.into() }
    }

    /// A finite number.
    pub fn real(&self, role: &str) -> Result<f64, ReadError> {
        number::finite(self.bytes()).map_err(|advice| self.expected(format!("a number ({role})"), advice))
    }

    /// A number, NaN and infinity admitted.
    pub fn value(&self, role: &str) -> Result<f64, ReadError> {
        number::special(self.bytes()).map_or_else(|| self.real(role), Ok)
    }

    /// A whole number of either sign.
    pub fn integer(&self, role: &str) -> Result<i64, ReadError> {
        number::whole(self.bytes()).map_err(|advice| self.expected(format!("a whole number ({role})"), advice))
    }

    /// A whole number that is not negative.
    pub fn whole(&self, role: &str) -> Result<usize, ReadError> {
        let negative = |_| self.expected(format!("a whole number ({role})"), "it cannot be negative");
        usize::try_from(self.integer(role)?).map_err(negative)
    }

    /// A vertex index of a format that counts from `base`, as an index from 0.
    pub fn index(&self, vertices: usize, base: usize) -> Result<usize, ReadError> {
        let index = self.integer("vertex index")?;
        match usize::try_from(index).ok().and_then(|i| i.checked_sub(base)) {
            Some(i) if i < vertices => Ok(i),
            _ => Err(ReadError::index(self.place(), index, vertices, base)),
        }
    }

    /// A component of a normal, within the same range as a coordinate.
    pub fn normal(&self, axis: usize) -> Result<f64, ReadError> {
        let value = self.value("normal")?;
        ReadError::normal(value, axis, || self.place())
    }

    /// A coordinate of a domain: finite and of a magnitude whose square does not overflow.
    pub fn coordinate(&self, axis: usize) -> Result<f64, ReadError> {
        let value = self.value(["x", "y", "z"][axis])?;
        ReadError::coordinate(value, axis, || self.place())
    }
}

impl<'a> Line<'a> {
    /// The next word.
    pub fn word(&mut self) -> Option<Word<'a>> {
        let open = &self.full[..self.stop];
        let start = (self.at..self.stop).find(|&k| !open[k].is_ascii_whitespace())?;
        let end = (start..self.stop).find(|&k| open[k].is_ascii_whitespace()).unwrap_or(self.stop);
        self.at = end;
        Some(Word { start, end, ..self.rest() })
    }

    /// The next word, or an empty one at the end of the line, which no reader of numbers takes.
    pub fn word_or_end(&mut self) -> Word<'a> {
        self.word().unwrap_or(self.rest())
    }

    /// The empty word at the end of what has been read.
    fn rest(&self) -> Word<'a> {
        Word { name: self.name, line: self.full, number: self.number, start: self.at, end: self.at }
    }

    /// The number of bytes that are left.
    pub fn remaining(&self) -> usize {
        self.stop - self.at.min(self.stop)
    }

    /// Three coordinates.
    pub fn point(&mut self) -> Result<[f64; 3], ReadError> {
        let mut point = [0.0; 3];
        for (axis, x) in point.iter_mut().enumerate() {
            *x = self.word_or_end().coordinate(axis)?;
        }
        Ok(point)
    }

    /// A count with its place.
    pub fn count(&mut self, role: &str) -> Result<Count<'a>, ReadError> {
        let word = self.word_or_end();
        Ok(Count { value: word.whole(role)?, word })
    }

    /// Refuses further words.
    pub fn finish(&mut self, advice: impl Into<Cow<'static, str>>) -> Result<(), ReadError> {
        match self.word() {
            None => Ok(()),
            Some(word) => Err(word.expected("the end of the line", advice)),
        }
    }
}

/// Bytes for a message: at most 40 characters, in quotes, what cannot be printed escaped.
pub(super) fn quoted(bytes: &[u8]) -> String {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(160)]).into_owned();
    let shown: String = head.chars().take(40).flat_map(char::escape_debug).collect();
    let cut = if head.chars().count() > 40 { "…" } else { "" };
    // Single quotes are ours to add; inside they stay as they are.
    format!("'{}{cut}'", shown.replace("\\'", "'"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &[u8], comments: Comments) -> Vec<(String, String)> {
        let mut lines = Lines::new("f", text, comments).unwrap();
        let mut all = Vec::new();
        while let Some(mut line) = lines.next() {
            while let Some(word) = line.word() {
                all.push((String::from_utf8_lossy(word.bytes()).into_owned(), word.place().to_string()));
            }
        }
        all
    }

    #[test]
    fn every_kind_of_line_end_gives_the_same_words_and_places() {
        let expected = words(b"a b\n\n # c\n d#e\n", Comments::Hash);
        assert_eq!(expected.iter().map(|w| w.1.as_str()).collect::<Vec<_>>(), ["f:1:1", "f:1:3", "f:4:2"]);
        assert_eq!(words(b"\xef\xbb\xbfa b\r\n\r\n # c\r\n d#e", Comments::Hash), expected);
        assert_eq!(words(b"a b\r\r # c\r d#e\r", Comments::Hash), expected);
    }

    #[test]
    fn columns_are_characters() {
        assert_eq!(words("äö x".as_bytes(), Comments::None)[1].1, "f:1:4");
    }

    #[test]
    fn percent_makes_a_comment_only_at_the_start_of_a_line() {
        assert_eq!(words(b"% a\n1 %\n", Comments::PercentLines).len(), 2);
    }

    #[test]
    fn what_is_quoted_is_short_and_printable() {
        assert_eq!(quoted(b"a'\0\xff"), "'a'\\0\u{fffd}'");
        assert_eq!(quoted(&[b'x'; 1000]).chars().count(), 43);
    }
}
