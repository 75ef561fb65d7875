//! From a path to a format and to decompressed bytes.

use std::borrow::Cow;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use flate2::read::MultiGzDecoder;

use super::error::ReadError;

/// No file is read beyond this length, decompressed: a guard against compressed bombs and endless devices.
const LONGEST: u64 = 1 << 32;

/// Compressed content is read up to this many times the compressed length. Text of numbers shrinks to a third or a tenth, a
/// regular grid to a fortieth; the most that the format can do is 1032, and only a bomb comes near.
const EXPANSION: u64 = 200;

/// Compressed content up to this length is read whatever its compressed length.
const SMALL: u64 = 1 << 24;

/// The formats a domain can be read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Object File Format of Geomview.
    Off,
    /// Wavefront OBJ.
    Obj,
    /// Polygon File Format, also called Stanford triangle format.
    Ply,
    /// Stereolithography.
    Stl,
    /// Points, a line each.
    Xyz,
    /// The mesh format of medit and the INRIA tools.
    Medit,
    /// A symmetric Matrix Market file: the weights of a graph.
    MatrixMarket,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 7] =
        [Format::Off, Format::Obj, Format::Ply, Format::Stl, Format::Xyz, Format::Medit, Format::MatrixMarket];

    /// The extension, in lower case and without its point.
    pub fn extension(self) -> &'static str {
        match self {
            Format::Off => "off",
            Format::Obj => "obj",
            Format::Ply => "ply",
            Format::Stl => "stl",
            Format::Xyz => "xyz",
            Format::Medit => "mesh",
            Format::MatrixMarket => "mtx",
        }
    }

    /// The format that the extension of a path names, letter case and a trailing `.gz` aside.
    ///
    /// # Errors
    /// An unknown extension.
    pub fn of(path: &Path) -> Result<Self, ReadError> {
        let extension = extension(path);
        Format::ALL.into_iter().find(|f| f.extension() == extension).ok_or_else(|| {
            let known = Format::ALL.map(|f| format!(".{}", f.extension())).join(", ");
            unknown(
                path,
                extension,
                format!("a mesh, point set or graph comes as {known}, each also with .gz behind it"),
            )
        })
    }
}

/// Refuses a path that does not end in `.mtx` or `.mtx.gz`.
pub(super) fn check_matrix_extension(path: &Path) -> Result<(), ReadError> {
    match extension(path) {
        known if known == Format::MatrixMarket.extension() => Ok(()),
        other => Err(unknown(path, other, "a matrix comes as .mtx or .mtx.gz".into())),
    }
}

fn unknown(path: &Path, extension: String, known: String) -> ReadError {
    let advice = match extension.as_str() {
        "npz" => "; in Python: scipy.io.mmwrite('L.mtx', scipy.sparse.load_npz('L.npz'))",
        "mat" => "; in Python: scipy.io.mmwrite('L.mtx', scipy.io.loadmat('L.mat')['L'])",
        "zst" => "; decompress it with zstd -d",
        "msh" | "vtk" | "vtu" | "inp" => "; meshio convert writes one of these from it",
        _ => "",
    };
    let extension = if extension.is_empty() { "a name without extension".into() } else { format!("'.{extension}'") };
    ReadError::UnknownExtension { file: path.display().to_string(), extension, known, advice }
}

/// The extension in lower case, behind which `.gz` does not count.
fn extension(path: &Path) -> String {
    let lower = |p: &Path| p.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    match lower(path) {
        gz if gz == "gz" => lower(Path::new(path.file_stem().unwrap_or_default())),
        other => other,
    }
}

/// The content of a file, decompressed if it begins with the signature of gzip.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, ReadError> {
    let name = path.display().to_string();
    let open = |e: std::io::Error| ReadError::Open { file: name.clone(), why: e.to_string() };
    let content = limited(File::open(path).map_err(open)?, &name, LONGEST, open)?;
    if is_compressed(&content) {
        return decompress(&name, &content);
    }
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gz")) {
        return Err(ReadError::Compressed { file: name, why: "it does not begin with the signature 1f 8b".into() });
    }
    Ok(content)
}

/// The content of a file that is in memory already, decompressed if it begins with the signature of gzip; `name` is what
/// errors call it. What [`parse_domain`](super::parse_domain) and [`parse_matrix`](super::parse_matrix) take.
///
/// # Errors
/// A gzip file that is damaged, or whose content is longer than any reader would take: beyond 4 GiB, or beyond 16 MiB and
/// 200 times the compressed length, which no mesh or matrix comes near.
pub fn unpack<'a>(name: &str, bytes: &'a [u8]) -> Result<Cow<'a, [u8]>, ReadError> {
    if is_compressed(bytes) { decompress(name, bytes).map(Cow::Owned) } else { Ok(Cow::Borrowed(bytes)) }
}

fn is_compressed(content: &[u8]) -> bool {
    content.starts_with(&[0x1f, 0x8b])
}

fn decompress(name: &str, bytes: &[u8]) -> Result<Vec<u8>, ReadError> {
    let limit = (bytes.len() as u64).saturating_mul(EXPANSION).clamp(SMALL, LONGEST);
    let broken = |why: String| ReadError::Compressed { file: name.to_string(), why };
    let content = limited(MultiGzDecoder::new(bytes), name, limit, |e| match e.kind() {
        std::io::ErrorKind::UnexpectedEof => broken("it ends too early".into()),
        _ => broken(e.to_string()),
    });
    content.map_err(|error| match error {
        ReadError::TooLong { file, limit } if limit < LONGEST => {
            ReadError::Bomb { file, compressed: bytes.len(), limit }
        }
        other => other,
    })
}

fn limited(
    source: impl Read,
    name: &str,
    limit: u64,
    refuse: impl Fn(std::io::Error) -> ReadError,
) -> Result<Vec<u8>, ReadError> {
    let mut content = Vec::new();
    let length = source.take(limit + 1).read_to_end(&mut content).map_err(refuse)?;
    if length as u64 > limit {
        return Err(ReadError::TooLong { file: name.to_string(), limit });
    }
    Ok(content)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_decides_whatever_its_case_and_compression() {
        for (path, format) in [("a/b.off", Format::Off), ("x.y.STL", Format::Stl), ("m.Mtx.GZ", Format::MatrixMarket)] {
            assert_eq!(Format::of(Path::new(path)), Ok(format));
        }
        for path in ["off", "a.gz", "b.off.zip", "", ".off"] {
            assert!(Format::of(Path::new(path)).is_err(), "{path}");
        }
    }

    #[test]
    fn an_unknown_extension_lists_the_known_ones() {
        assert_eq!(
            Format::of(Path::new("a.npz")).unwrap_err().to_string(),
            "a.npz: no reader for '.npz'; a mesh, point set or graph comes as .off, .obj, .ply, .stl, .xyz, .mesh, .mtx, \
             each also with .gz behind it; in Python: scipy.io.mmwrite('L.mtx', scipy.sparse.load_npz('L.npz'))"
        );
    }
}
