//! Files inside a page: `data:` addresses, and the text of a mesh to take away.

use std::fmt::Write as _;

use crate::record::Exhibit;

/// A `data:` address of a text.
pub fn address(mime: &str, content: &[u8]) -> String {
    let mut out = format!("data:{mime};charset=utf-8,");
    for &byte in content {
        match byte {
            b'A'..=b'Z'
            | b'a'..=b'z'
            | b'0'..=b'9'
            | b'-'
            | b'_'
            | b'.'
            | b','
            | b';'
            | b':'
            | b'/'
            | b'='
            | b'('
            | b')' => {
                out.push(char::from(byte));
            }
            _ => {
                let _ = write!(out, "%{byte:02X}");
            }
        }
    }
    out
}

/// The mesh of an exhibit: the ending of its file and its text. A surface as OFF, a graph as OBJ with its edges as lines.
/// Coordinates are written so that they read back to the same `f64`.
pub fn mesh(exhibit: &Exhibit) -> (&'static str, String) {
    let mut out = String::new();
    if exhibit.faces.is_empty() {
        for [x, y, z] in &exhibit.positions {
            let _ = writeln!(out, "v {x} {y} {z}");
        }
        for [a, b] in &exhibit.edges {
            let _ = writeln!(out, "l {} {}", a + 1, b + 1);
        }
        return ("obj", out);
    }
    let _ = writeln!(out, "OFF\n{} {} 0", exhibit.positions.len(), exhibit.faces.len());
    for [x, y, z] in &exhibit.positions {
        let _ = writeln!(out, "{x} {y} {z}");
    }
    for face in &exhibit.faces {
        let corners: String = face.iter().map(|v| format!(" {v}")).collect();
        let _ = writeln!(out, "{}{corners}", face.len());
    }
    ("off", out)
}
