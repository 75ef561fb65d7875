//! A file in the making: lines of words that know what they are, perhaps with binary data behind them.

use super::tape::Tape;

/// What a word is, which decides how it can be spoilt.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Kind {
    /// A keyword, or a number that may be anything.
    Plain,
    /// A number of rows or the like.
    Count,
    /// The index of a vertex, a row or a column.
    Index,
    /// A finite coordinate within ±1e150.
    Coordinate,
    /// The value of a matrix, which may be NaN or infinite.
    Value,
}

/// Where comments may stand.
#[derive(Clone, Copy, PartialEq)]
pub enum Comments {
    None,
    /// `#` anywhere.
    Hash,
    /// Lines that begin with `%`, below the first.
    Percent,
    /// Lines that begin with `comment`, below the second and above `end_header`.
    Ply,
}

/// A file in the making.
#[derive(Clone)]
pub struct Document {
    pub lines: Vec<Vec<(String, Kind)>>,
    pub body: Vec<u8>,
    pub comments: Comments,
}

/// What must come of an input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    Read,
    Refused,
    Either,
}

/// What no reader may take for a number, whatever it stands for.
const NO_NUMBER: [&str; 31] = [
    "1,5",
    "0x1p0",
    "0x10",
    "1e",
    "1e+",
    "1.0.0",
    "1_000",
    "--1",
    "+-1",
    "1e5x",
    ".",
    "e5",
    "1d5",
    "½",
    "１",
    "٣",
    "−1",
    "1\u{a0}",
    "1\0",
    "1f",
    "1.5L",
    "(1)",
    "1;2",
    "'1'",
    "1e1.5",
    "-",
    "+",
    "1'000",
    "1e400",
    "1e-400",
    "1e99999999999999999999",
];
const NO_COORDINATE: [&str; 7] = ["nan", "-NaN", "inf", "-Infinity", "1.1e150", "-1e200", "nan(ind)"];
const NO_COUNT: [&str; 14] = [
    "2147483647",
    "2147483648",
    "4294967295",
    "4294967296",
    "1000000000000",
    "9223372036854775807",
    "9223372036854775808",
    "18446744073709551615",
    "18446744073709551616",
    "-2147483648",
    "-7",
    "4.0",
    "4e0",
    "nan",
];
const NO_INDEX: [&str; 8] =
    ["1.0", "1e0", "2147483648", "9223372036854775808", "18446744073709551617", "-9999999999", "700000", "inf"];

impl Document {
    pub fn line(&mut self, text: &str) {
        self.push(text.split(' ').map(|w| (w.to_string(), Kind::Plain)).collect());
    }

    pub fn push(&mut self, words: Vec<(String, Kind)>) {
        self.lines.push(words);
    }

    /// Puts something malformed in the place of a number; `false` if there is none.
    pub fn spoil(&mut self, tape: &mut Tape) -> bool {
        let numbers: Vec<(usize, usize)> = self
            .lines
            .iter()
            .enumerate()
            .flat_map(|(l, words)| words.iter().enumerate().filter(|w| w.1.1 != Kind::Plain).map(move |w| (l, w.0)))
            .collect();
        if numbers.is_empty() {
            return false;
        }
        let (l, w) = tape.pick(&numbers);
        let (word, kind) = &mut self.lines[l][w];
        let special: &[&str] = match kind {
            Kind::Coordinate => &NO_COORDINATE,
            Kind::Count => &NO_COUNT,
            Kind::Index => &NO_INDEX,
            Kind::Value | Kind::Plain => &[],
        };
        let chosen = tape.below(special.len() + NO_NUMBER.len());
        *word = special.get(chosen).copied().unwrap_or_else(|| NO_NUMBER[chosen - special.len()]).to_string();
        true
    }

    /// Changes lines and words in ways that may or may not matter: left out, doubled, swapped, replaced by others.
    pub fn disturb(&mut self, tape: &mut Tape) {
        if self.lines.is_empty() {
            return;
        }
        for _ in 0..=tape.below(3) {
            let n = self.lines.len();
            let (a, b) = (tape.below(n), tape.below(n));
            match tape.below(8) {
                0 => self.lines.swap(a, b),
                1 => drop(self.lines.remove(a)),
                2 => self.lines.insert(b, self.lines[a].clone()),
                3 => self.lines.truncate(a + 1),
                4 => {
                    let k = tape.below(self.lines[a].len() + 1);
                    self.lines[a].insert(
                        k,
                        (tape.pick(&["0", "1", "-1", "7", "0.5", "nan", "f", "/", "#"]).into(), Kind::Plain),
                    );
                }
                5 => {
                    let k = tape.below(self.lines[a].len());
                    self.lines[a].remove(k);
                }
                6 => {
                    let (i, j) = (tape.below(self.lines[a].len()), tape.below(self.lines[b].len()));
                    let word = self.lines[a][i].clone();
                    self.lines[b][j] = word;
                }
                _ => {
                    let k = tape.below(self.lines[a].len());
                    let near = self.lines[a][k].0.parse().map(|v: i64| v + [1, -1, 2, 256][tape.below(4)]);
                    self.lines[a][k].0 = near.map_or("x".into(), |v| v.to_string());
                }
            }
            self.lines.retain(|line| !line.is_empty());
            if self.lines.is_empty() {
                self.line("x");
            }
        }
    }

    /// The file, in one of the many ways to write it that must not matter.
    pub fn render(&self, tape: &mut Tape) -> Vec<u8> {
        let end = tape.pick(&["\n", "\n", "\r\n", "\r"]);
        let blank = tape.pick(&[" ", " ", "\t", "   ", " \t "]);
        let (indent, trail) = (tape.pick(&["", "", " ", "\t"]), tape.pick(&["", "", " ", "\t "]));
        let mut noise = tape.below(4) == 3;
        let mut text = String::from(tape.pick(&["", "", "", "\u{feff}"]));
        let last = self.lines.len().saturating_sub(1);
        if self.lines.is_empty() {
            return self.body.clone();
        }
        for (k, words) in self.lines.iter().enumerate() {
            text += indent;
            for (j, word) in words.iter().enumerate() {
                text += if j > 0 { blank } else { "" };
                text += &word.0;
            }
            text += trail;
            if noise && self.comments == Comments::Hash && tape.once_in(3) {
                text += tape.pick(&["#", " # a comment, 1,5", "#\0\u{fffd}"]);
            }
            if k < last || !self.body.is_empty() || tape.below(4) < 3 {
                text += end;
            }
            // Below the header of PLY there are no comments.
            noise &= self.comments != Comments::Ply || words[0].0 != "end_header";
            if noise && k < last && tape.once_in(3) {
                match self.comments {
                    Comments::Hash => text += &format!("# {}{end}{blank}{end}", "x".repeat(tape.pick(&[0, 3, 700]))),
                    Comments::Percent => text += &format!("%{end}{end}% 1 2 3{end}"),
                    Comments::Ply if k > 0 => text += &format!("comment é {end}"),
                    Comments::Ply | Comments::None => {}
                }
            }
        }
        [text.as_bytes(), &self.body].concat()
    }
}
