//! What an exhaustive search of a small world came to, in a sentence.

use super::number::count;
use crate::record::{AtlasLine, Level};

/// The counterexample with the cases searched; or on how many cases the property holds.
pub fn smallest(line: &AtlasLine) -> String {
    let Some(found) = &line.found else {
        return format!("{} {} {}: {}", line.laplacian, verb(line), line.property, cases(line));
    };
    let [width, height] = found.extent;
    format!(
        "{} fails {} on a mesh of {} vertices and {} faces in a box {width} × {height}: {}",
        line.laplacian,
        line.property,
        found.exhibit.positions.len(),
        found.exhibit.faces.len(),
        cases(line)
    )
}

/// What holds, holds where it was decided.
fn verb(line: &AtlasLine) -> &'static str {
    if line.decided == 0 { "is not decided for" } else { "holds" }
}

/// The cases searched, in words.
pub(super) fn cases(line: &AtlasLine) -> String {
    let mut text = match &line.found {
        Some(_) if line.is_proved() => {
            format!("provably the smallest, number {} of {}", count(line.searched), count(line.size))
        }
        Some(_) => format!(
            "the first known, number {} of {}; {} smaller ones were left open",
            count(line.searched),
            count(line.size),
            count(line.open)
        ),
        None if line.decided == 0 => format!("none of {} cases", count(line.size)),
        None => format!("on all of {} cases", count(line.decided)),
    };
    if line.found.is_none() {
        for (n, what) in [(line.open, "left open"), (line.silent, "not applicable"), (line.refused, "refused")] {
            if n > 0 {
                text += &format!(", {} {what}", count(n));
            }
        }
    } else if line.refused > 0 {
        text += &format!(", {} refused", count(line.refused));
    }
    match line.level {
        Some(level) => text + &format!(" ({})", how(level)),
        None => text,
    }
}

fn how(level: Level) -> &'static str {
    match level {
        Level::Exact => "decided exactly",
        Level::Bounded => "decided within error bounds",
        Level::Measured => "decided against a tolerance",
    }
}
