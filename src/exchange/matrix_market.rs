//! Matrix Market: sparse (`coordinate`) and dense (`array`) matrices in text.
//!
//! ```text
//! %%MatrixMarket matrix coordinate real symmetric      letter case and repeated blanks do not matter
//! % comments
//! 3 3 2                                                rows, columns, stored entries
//! 1 1 0.5                                              row, column, value; counted from 1
//! 3 1 -2
//! ```
//! Fields real, integer and pattern (every entry 1); symmetries general, symmetric and skew-symmetric. NaN and infinities
//! *are* read, in every spelling: in a matrix they are a finding (property FIN), not a mistake of the file. Zeros that are
//! stored stay stored, in `array` files only values other than zero are. Entries of the same place are added in the order of
//! the file, with a notice. `symmetric` with entries on both sides of the diagonal is refused: mirroring would double them.

use super::error::ReadError;
use super::text::{Lines, Word};
use crate::linalg::Csr;

/// Rows and columns beyond the bytes of the file are admitted up to this number: small empty matrices are no mistake.
pub(super) const EMPTY_ROWS: usize = 1 << 16;

/// A matrix and what is worth knowing about its file.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixFile {
    /// The matrix, both triangles stored.
    pub matrix: Csr,
    /// What was repaired, in words.
    pub notices: Vec<String>,
}

impl MatrixFile {
    /// The diagonal, if the file holds no more than one: a matrix of one column (or one row, but more columns), or a square
    /// matrix whose entries off the diagonal are zero. So a lumped mass may come in either form.
    pub fn as_diagonal(&self) -> Option<Vec<f64>> {
        let m = &self.matrix;
        match (m.rows(), m.columns()) {
            (n, 1) => Some((0..n).map(|i| m.at(i, 0)).collect()),
            (1, n) => Some((0..n).map(|j| m.at(0, j)).collect()),
            (n, k) if n == k && m.entries().all(|(i, j, v)| i == j || *v == 0.0) => {
                Some((0..n).map(|i| m.at(i, i)).collect())
            }
            _ => None,
        }
    }

    /// The matrix, or the diagonal matrix that [`MatrixFile::as_diagonal`] describes.
    pub fn diagonal_or_full(&self) -> Csr {
        self.as_diagonal().map_or_else(|| self.matrix.clone(), |diagonal| Csr::diagonal(&diagonal))
    }
}

/// Which entries a file stores.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Symmetry {
    General,
    Symmetric,
    SkewSymmetric,
}

/// What an entry holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Field {
    Real,
    Integer,
    Pattern,
}

/// A stored entry: row and column, counted from 0, and value. Its place is read again when an error asks for it.
pub(super) type Entry = (usize, usize, f64);

/// A file as it stands: nothing mirrored, nothing added up.
pub(super) struct Stored<'a> {
    pub rows: usize,
    pub columns: usize,
    pub field: Field,
    pub symmetry: Symmetry,
    pub entries: Vec<Entry>,
    /// What follows the sizes.
    pub lines: Lines<'a>,
    /// Where the sizes stand.
    pub size: Word<'a>,
}

/// Reads a matrix from the (decompressed) content of a Matrix Market file; `name` is what errors call it.
///
/// Cost: linear in the length of the file.
///
/// # Errors
/// Content that does not follow the format, or promises more than it holds.
pub fn parse_matrix(name: &str, bytes: &[u8]) -> Result<MatrixFile, ReadError> {
    let Stored { rows, columns, symmetry, entries: mut triplets, .. } = Stored::read(name, bytes)?;
    let given = triplets.len();
    let mut notices = Vec::new();
    if symmetry != Symmetry::General {
        if triplets.iter().any(|&(i, j, _)| j > i) {
            notices.push("the upper triangle was stored instead of the lower one, and was mirrored downwards".into());
        }
        let sign = if symmetry == Symmetry::Symmetric { 1.0 } else { -1.0 };
        triplets.reserve_exact(triplets.iter().filter(|(i, j, _)| i != j).count());
        for k in 0..given {
            let (i, j, value) = triplets[k];
            if i != j {
                triplets.push((j, i, sign * value));
            }
        }
    }
    let matrix = Csr::from_triplets(rows, columns, &triplets);
    if matrix.stored() < triplets.len() {
        notices.insert(0, duplicates(&triplets[..given]));
    }
    Ok(MatrixFile { matrix, notices })
}

/// What to tell about entries that share their place, of which there are some.
fn duplicates(entries: &[Entry]) -> String {
    let mut places: Vec<(usize, usize)> = entries.iter().map(|&(i, j, _)| (i, j)).collect();
    places.sort_unstable();
    let repeated = || places.windows(2).filter(|w| w[0] == w[1]);
    let (i, j) = repeated().next().map_or((0, 0), |w| (w[0].0 + 1, w[0].1 + 1));
    let count = repeated().count();
    format!("{count} entries repeat the place of an earlier one and were added to it, the first at ({i}, {j})")
}

/// The matrix in coordinate form, general, every stored entry written, with the fewest digits that read back bit for bit
/// (of a NaN the sign only is kept).
pub fn write_matrix_market(matrix: &Csr) -> String {
    let mut text = "%%MatrixMarket matrix coordinate real general\n".to_string();
    text.push_str(&format!("{} {} {}\n", matrix.rows(), matrix.columns(), matrix.stored()));
    for (i, j, &value) in matrix.entries() {
        text.push_str(&format!("{} {} {}\n", i + 1, j + 1, shortest(value)));
    }
    text
}

/// The shortest decimal that reads back as the same bits; NaN and infinities as SciPy writes them.
pub(super) fn shortest(value: f64) -> String {
    let sign = if value.is_sign_negative() { "-" } else { "" };
    match value {
        v if v.is_nan() => format!("{sign}NaN"),
        v if v.is_infinite() => format!("{sign}Infinity"),
        v => format!("{v:?}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> MatrixFile {
        parse_matrix("t.mtx", text.as_bytes()).unwrap_or_else(|e| panic!("{e}"))
    }

    fn dense(m: &Csr) -> Vec<Vec<f64>> {
        (0..m.rows()).map(|i| (0..m.columns()).map(|j| m.at(i, j)).collect()).collect()
    }

    #[test]
    fn the_header_may_be_spelled_freely() {
        for header in
            ["%%MatrixMarket matrix coordinate real general", "%%matrixmarket  MATRIX\tCoordinate  Real General "]
        {
            let file =
                read(&format!("\u{feff}{header}\r\n% a comment\r\n\r\n2 3 2\r\n\r\n1 1 0.5\r\n 2\t3 -1e-3 \r\n"));
            assert_eq!(dense(&file.matrix), [[0.5, 0.0, 0.0], [0.0, 0.0, -1e-3]]);
            assert!(file.notices.is_empty());
        }
    }

    #[test]
    fn one_triangle_is_mirrored_whichever_it_is() {
        let lower = read("%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 4\n2 1 -3\n");
        assert_eq!(dense(&lower.matrix), [[4.0, -3.0], [-3.0, 0.0]]);
        let upper = read("%%MatrixMarket matrix coordinate integer symmetric\n2 2 2\n1 1 4\n1 2 -3\n");
        assert_eq!(upper.matrix, lower.matrix);
        assert_eq!(upper.notices.len(), 1);
        let skew = read("%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n2 1 -3\n");
        assert_eq!(dense(&skew.matrix), [[0.0, 3.0], [-3.0, 0.0]]);
        let pattern = read("%%MatrixMarket matrix coordinate pattern symmetric\n2 2 1\n2 1\n");
        assert_eq!(dense(&pattern.matrix), [[0.0, 1.0], [1.0, 0.0]]);
    }

    #[test]
    fn arrays_run_down_the_columns() {
        let general = read("%%MatrixMarket matrix array real general\n2 3\n1\n2\n3\n4\n0\n6\n");
        assert_eq!(dense(&general.matrix), [[1.0, 3.0, 0.0], [2.0, 4.0, 6.0]]);
        assert_eq!(general.matrix.stored(), 5);
        let symmetric = read("%%MatrixMarket matrix array integer symmetric\n3 3\n1\n2\n3\n4\n5\n6\n");
        assert_eq!(dense(&symmetric.matrix), [[1.0, 2.0, 3.0], [2.0, 4.0, 5.0], [3.0, 5.0, 6.0]]);
        let skew = read("%%MatrixMarket matrix array real skew-symmetric\n3 3\n1\n2\n3\n");
        assert_eq!(dense(&skew.matrix), [[0.0, -1.0, -2.0], [1.0, 0.0, -3.0], [2.0, 3.0, 0.0]]);
    }

    #[test]
    fn duplicates_are_added_and_counted_and_stored_zeros_stay() {
        let file = read("%%MatrixMarket matrix coordinate real symmetric\n2 2 4\n2 1 1\n2 1 2\n1 1 0\n2 1 4\n");
        assert_eq!(dense(&file.matrix), [[0.0, 7.0], [7.0, 0.0]]);
        assert_eq!(
            file.notices,
            ["2 entries repeat the place of an earlier one and were added to it, the first at (2, 1)"]
        );
        assert_eq!(file.matrix.get(0, 0), Some(&0.0));
    }

    #[test]
    fn what_is_not_finite_is_a_value_and_comes_back() {
        let values = [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, 5e-324, f64::MAX, 0.1, 1e23];
        let matrix = Csr::diagonal(&values);
        let text = write_matrix_market(&matrix);
        let back = read(&text).matrix;
        let bits = |m: &Csr| m.entries().map(|(i, j, v)| (i, j, v.to_bits())).collect::<Vec<_>>();
        assert_eq!(bits(&back), bits(&matrix));
        for word in ["nan", "NaN", "-NAN", "inf", "-Inf", "+Infinity", "-nan(ind)"] {
            assert!(!read(&text.replace("3 3 Infinity", &format!("3 3 {word}"))).matrix.at(2, 2).is_finite(), "{word}");
        }
    }

    #[test]
    fn a_lumped_mass_comes_as_a_column_or_as_a_diagonal() {
        let diagonal = Some(vec![1.5, 2.5]);
        for text in [
            "array real general\n2 1\n1.5\n2.5\n",
            "array real general\n1 2\n1.5\n2.5\n",
            "coordinate real general\n2 2 3\n1 1 1.5\n2 2 2.5\n1 2 0\n",
        ] {
            let file = read(&format!("%%MatrixMarket matrix {text}"));
            assert_eq!(file.as_diagonal(), diagonal);
            assert_eq!(file.diagonal_or_full(), Csr::diagonal(&[1.5, 2.5]));
        }
        assert_eq!(read("%%MatrixMarket matrix coordinate real general\n2 2 1\n1 2 1\n").as_diagonal(), None);
    }
}
