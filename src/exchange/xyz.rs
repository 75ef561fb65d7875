//! XYZ: a point a line, three coordinates, or three coordinates and the three components of a normal.
//!
//! Either every line has a normal or none has; `#` begins a comment.

use super::error::{Place, ReadError};
use super::text::{Comments, Line, Lines};
use crate::domain::{Domain, PointCloud};

pub(super) fn parse(name: &str, bytes: &[u8]) -> Result<Domain, ReadError> {
    let mut lines = Lines::new(name, bytes, Comments::Hash)?;
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    while let Some(mut line) = lines.next() {
        if positions.is_empty() {
            refuse_atoms(line.clone())?;
        }
        positions.push(line.point()?);
        let six = line.clone().word().is_some();
        if six != (normals.len() + 1 == positions.len()) && positions.len() > 1 {
            let word = line.word_or_end();
            let expected = if six { "the end of the line" } else { "a normal" };
            return Err(word.expected(expected, "all lines have three numbers, or all have six"));
        }
        if six {
            let mut component = |axis| line.word_or_end().normal(axis);
            normals.push([component(0)?, component(1)?, component(2)?]);
        }
        line.finish("a line is x y z, or x y z and a normal nx ny nz")?;
    }
    if positions.is_empty() {
        let advice = "write a line x y z for each".into();
        return Err(ReadError::Missing { place: Place::file(name), what: "point".into(), advice });
    }
    let normals = (!normals.is_empty()).then_some(normals);
    let cloud = PointCloud::new(positions, normals);
    Ok(cloud.map_err(|source| ReadError::Domain { file: name.to_string(), source })?.into())
}

/// Refuses the format of the same name that lists the atoms of a molecule: it begins with their number.
fn refuse_atoms(mut first: Line) -> Result<(), ReadError> {
    let word = first.word_or_end();
    if first.word().is_some() || word.whole("count").is_err() {
        return Ok(());
    }
    let (place, what) = (word.place(), "an XYZ file that begins with a count, like a list of atoms,".into());
    Err(ReadError::Unsupported { place, what, advice: "keep only the lines of coordinates, without names" })
}

/// The points as XYZ, with normals if there are any. Numbers have the fewest digits that read back bit for bit.
pub fn write_xyz(points: &PointCloud) -> String {
    let mut text = String::new();
    for (k, [x, y, z]) in points.positions().iter().enumerate() {
        text.push_str(&format!("{x:?} {y:?} {z:?}"));
        if let Some([x, y, z]) = points.normals().map(|n| n[k]) {
            text.push_str(&format!(" {x:?} {y:?} {z:?}"));
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_with_and_without_normals_come_back_bit_for_bit() {
        let p = vec![[0.1, -0.0, 1e-300], [2.0 / 3.0, 1e16, 5e-324]];
        for normals in [None, Some(vec![[0.0, 0.0, 1.0], [1.0 / 3.0, 2.0, -2.0]])] {
            let cloud = PointCloud::new(p.clone(), normals).unwrap();
            let Ok(Domain::Points(back)) = parse("t.xyz", write_xyz(&cloud).as_bytes()) else { panic!("points") };
            assert_eq!((back.positions(), back.normals()), (cloud.positions(), cloud.normals()));
            assert!(back.positions()[0][1].is_sign_negative());
        }
    }
}
