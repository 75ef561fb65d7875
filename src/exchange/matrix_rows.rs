//! The banner, the sizes and the entries of a Matrix Market file, checked where they stand.

use super::error::{Place, ReadError};
use super::matrix_market::{EMPTY_ROWS, Entry, Field, Stored, Symmetry};
use super::text::{Comments, Count, Line, Lines, Word};

impl Symmetry {
    /// The name in the banner.
    fn name(self) -> &'static str {
        match self {
            Symmetry::General => "general",
            Symmetry::Symmetric => "symmetric",
            Symmetry::SkewSymmetric => "skew-symmetric",
        }
    }
}

/// The words of the banner that decide how the rest is read.
#[derive(Clone, Copy)]
struct Banner {
    dense: bool,
    field: Field,
    symmetry: Symmetry,
}

impl<'a> Stored<'a> {
    /// Reads a file as it stands.
    pub fn read(name: &'a str, bytes: &'a [u8]) -> Result<Self, ReadError> {
        let mut lines = Lines::new(name, bytes, Comments::None)?;
        let banner = read_banner(name, &mut lines)?;
        lines.allow(Comments::PercentLines);
        let advice = if banner.dense { "write 'rows columns'" } else { "write 'rows columns entries'" };
        let Some(mut line) = lines.next() else {
            let (place, what) = (lines.end(), "line of sizes".into());
            return Err(ReadError::Missing { place, what, advice: advice.into() });
        };
        let (rows, columns) = (line.count("number of rows")?, line.count("number of columns")?);
        check_sizes(&lines, banner, rows, columns)?;
        let start = lines.clone();
        let entries = match banner.dense {
            true => {
                line.finish("the sizes of an array are its rows and columns")?;
                read_array(&mut lines, banner, rows, columns)?
            }
            false => {
                let count = line.count("number of entries")?;
                line.finish("the sizes are rows, columns and entries")?;
                read_coordinates(&mut lines, banner, [rows.value, columns.value], count)?
            }
        };
        let (field, symmetry) = (banner.field, banner.symmetry);
        let (rows, columns, size) = (rows.value, columns.value, rows.word);
        Ok(Stored { rows, columns, field, symmetry, entries, lines: start, size })
    }

    /// The place of the `k`-th entry of a file in coordinates. Cost: reads the file again up to there.
    pub fn place(&self, k: usize) -> Place {
        let mut lines = self.lines.clone();
        let word = (0..=k).filter_map(|_| lines.next()).last().map(|mut line| line.word_or_end());
        word.unwrap_or(self.size).place()
    }
}

fn read_banner(name: &str, lines: &mut Lines) -> Result<Banner, ReadError> {
    const ADVICE: &str = "the first line is '%%MatrixMarket matrix coordinate real general' or the like";
    let Some(mut line) = lines.next() else {
        let what = "banner %%MatrixMarket".into();
        return Err(ReadError::Missing { place: Place::file(name), what, advice: ADVICE.into() });
    };
    let mut choose = |options: &[&str]| -> Result<(usize, Word), ReadError> {
        let word = line.word_or_end();
        let found = options.iter().position(|o| word.is(o));
        found.map(|k| (k, word)).ok_or_else(|| word.expected(format!("'{}'", options.join("' or '")), ADVICE))
    };
    choose(&["%%MatrixMarket"])?;
    choose(&["matrix"])?;
    let dense = choose(&["coordinate", "array"])?.0 == 1;
    let (field, field_word) = choose(&["real", "integer", "pattern", "double", "complex"])?;
    let (symmetry, symmetry_word) = choose(&["general", "symmetric", "skew-symmetric", "hermitian"])?;
    line.finish(ADVICE)?;
    if field == 4 || symmetry == 3 {
        let (place, what) = (if field == 4 { field_word } else { symmetry_word }.place(), "a complex matrix".into());
        return Err(ReadError::Unsupported { place, what, advice: "write its real part with the field 'real'" });
    }
    let field = [Field::Real, Field::Integer, Field::Pattern, Field::Real][field];
    let symmetry = [Symmetry::General, Symmetry::Symmetric, Symmetry::SkewSymmetric][symmetry];
    if field == Field::Pattern && (dense || symmetry == Symmetry::SkewSymmetric) {
        let advice = "a pattern has no values, so that it is neither an array nor skew-symmetric";
        return Err(field_word.expected("'real' or 'integer'", advice));
    }
    Ok(Banner { dense, field, symmetry })
}

/// Refuses sizes that a file of this length does not fill, and symmetry without as many columns as rows.
fn check_sizes(lines: &Lines, banner: Banner, rows: Count, columns: Count) -> Result<(), ReadError> {
    let most = EMPTY_ROWS + lines.remaining();
    for (size, what) in [(rows, "rows"), (columns, "columns")] {
        if size.value > most {
            let (place, promised) = (size.word.place(), size.value);
            return Err(ReadError::MostlyEmpty { place, what, promised, most });
        }
    }
    if banner.symmetry != Symmetry::General && rows.value != columns.value {
        let (place, symmetry) = (rows.word.place(), banner.symmetry.name());
        return Err(ReadError::NotSquare { place, symmetry, rows: rows.value, columns: columns.value });
    }
    Ok(())
}

fn read_coordinates<'a>(
    lines: &mut Lines<'a>,
    banner: Banner,
    size: [usize; 2],
    count: Count<'a>,
) -> Result<Vec<Entry>, ReadError> {
    // "1 1" and the line end.
    let promised = lines.check_count(count, "entries", 4)?;
    let mut entries = Vec::with_capacity(promised);
    let mut side: Option<(bool, usize)> = None;
    for found in 0..promised {
        let mut line = lines.row("entries", promised, found)?;
        let (word, row) = index(&mut line, "row", size)?;
        let (_, column) = index(&mut line, "column", size)?;
        let value = match banner.field {
            Field::Pattern => 1.0,
            field => read_value(&mut line, field)?,
        };
        line.finish(match banner.field {
            Field::Pattern => "an entry of a pattern is its row and column, without a value",
            _ => "an entry is its row, column and value",
        })?;
        check_symmetry((row, column, value), word, banner.symmetry, &mut side)?;
        entries.push((row, column, value));
    }
    lines.finish("entries", promised)?;
    Ok(entries)
}

/// A row or column, counted from 1 in the file and from 0 in the result.
fn index<'a>(
    line: &mut Line<'a>,
    axis: &'static str,
    [rows, columns]: [usize; 2],
) -> Result<(Word<'a>, usize), ReadError> {
    let word = line.word_or_end();
    let index = word.whole(axis)?;
    let size = if axis == "row" { rows } else { columns };
    match index.checked_sub(1) {
        None => Err(ReadError::ZeroIndex { place: word.place() }),
        Some(from_zero) if from_zero < size => Ok((word, from_zero)),
        Some(_) => Err(ReadError::EntryOutOfRange { place: word.place(), axis, index, rows, columns }),
    }
}

fn read_value(line: &mut Line, field: Field) -> Result<f64, ReadError> {
    let word = line.word_or_end();
    if field != Field::Integer {
        return word.value("value");
    }
    let value = word.integer("value")?;
    // Beyond 2⁵³ not every whole number is a double.
    if (value as f64) as i128 != i128::from(value) {
        return Err(
            word.expected("a whole number that is a double", "from 2^53 on not every one is; use the field 'real'")
        );
    }
    Ok(value as f64)
}

/// Refuses an entry on the other side of the diagonal than those before it, `side` being that of the first and its line.
fn check_symmetry(
    (row, column, value): Entry,
    word: Word,
    symmetry: Symmetry,
    side: &mut Option<(bool, usize)>,
) -> Result<(), ReadError> {
    if symmetry == Symmetry::General {
        return Ok(());
    }
    if row == column {
        if symmetry == Symmetry::SkewSymmetric && value != 0.0 {
            let (place, row, value) = (word.place(), row + 1, value.to_string());
            return Err(ReadError::SkewDiagonal { place, row, value });
        }
        return Ok(());
    }
    let lower = row > column;
    let &mut (first, other_line) = side.get_or_insert((lower, word.line_number()));
    if first != lower {
        let (place, symmetry) = (word.place(), symmetry.name());
        return Err(ReadError::BothTriangles { place, symmetry, entry: (row + 1, column + 1), other_line });
    }
    Ok(())
}

/// A value a line, down the columns; of a symmetric matrix from the diagonal, of a skew-symmetric one from below it.
fn read_array(lines: &mut Lines, banner: Banner, rows: Count, columns: Count) -> Result<Vec<Entry>, ReadError> {
    let n = rows.value;
    let values = match banner.symmetry {
        Symmetry::General => n.saturating_mul(columns.value),
        Symmetry::Symmetric => n.saturating_mul(n + 1) / 2,
        Symmetry::SkewSymmetric => n.saturating_mul(n.saturating_sub(1)) / 2,
    };
    lines.check_count(Count { value: values, word: rows.word }, "values of the array", 2)?;
    let (mut entries, mut found) = (Vec::new(), 0);
    for column in 0..columns.value {
        let first = match banner.symmetry {
            Symmetry::General => 0,
            Symmetry::Symmetric => column,
            Symmetry::SkewSymmetric => column + 1,
        };
        for row in first..n {
            let mut line = lines.row("values of the array", values, found)?;
            let value = read_value(&mut line, banner.field)?;
            line.finish("an array has one value a line, down its columns")?;
            found += 1;
            if value != 0.0 {
                entries.push((row, column, value));
            }
        }
    }
    lines.finish("values of the array", values)?;
    Ok(entries)
}
