//! The faces of a surface: one list of corners, cut into faces.

use std::fmt;
use std::ops::Index;

/// A list of faces, each a slice of vertex numbers, all in one allocation: 8 bytes a corner, and 8 a face where not all of
/// them are triangles.
///
/// It is used like a slice of slices: `faces[f]`, `faces.len()`, `for corners in &faces`.
#[derive(Clone, Default, PartialEq, Eq)]
pub struct Faces {
    corners: Vec<usize>,
    /// Where each face begins, and the end; empty where every face is a triangle.
    offsets: Vec<usize>,
}

impl Faces {
    /// Triangles.
    pub fn triangles(triangles: &[[usize; 3]]) -> Self {
        Faces { corners: triangles.as_flattened().to_vec(), offsets: Vec::new() }
    }

    /// Whether every face is a triangle.
    pub fn are_triangles(&self) -> bool {
        self.offsets.is_empty()
    }

    /// The number of faces.
    pub fn len(&self) -> usize {
        if self.are_triangles() { self.corners.len() / 3 } else { self.offsets.len() - 1 }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The corners of a face; `None` if there is no such face.
    pub fn get(&self, face: usize) -> Option<&[usize]> {
        (face < self.len()).then(|| &self[face])
    }

    /// The faces in order.
    pub fn iter(&self) -> Iter<'_> {
        Iter { faces: self, left: 0..self.len() }
    }

    /// All corners, face after face.
    pub fn corners(&self) -> &[usize] {
        &self.corners
    }

    /// A list of lists.
    pub fn to_vec(&self) -> Vec<Vec<usize>> {
        self.iter().map(<[usize]>::to_vec).collect()
    }

    /// Turns a face round.
    pub(super) fn reverse(&mut self, face: usize) {
        let range = self.range(face);
        self.corners[range].reverse();
    }

    fn range(&self, face: usize) -> std::ops::Range<usize> {
        if self.are_triangles() { 3 * face..3 * face + 3 } else { self.offsets[face]..self.offsets[face + 1] }
    }
}

impl From<Vec<[usize; 3]>> for Faces {
    /// Triangles; the list is taken over, not copied.
    fn from(triangles: Vec<[usize; 3]>) -> Self {
        Faces { corners: triangles.into_flattened(), offsets: Vec::new() }
    }
}

impl Index<usize> for Faces {
    type Output = [usize];

    fn index(&self, face: usize) -> &[usize] {
        &self.corners[self.range(face)]
    }
}

impl<F: AsRef<[usize]>> FromIterator<F> for Faces {
    fn from_iter<T: IntoIterator<Item = F>>(faces: T) -> Self {
        let mut list = Faces { corners: Vec::new(), offsets: vec![0] };
        let mut triangles = true;
        for face in faces {
            list.corners.extend_from_slice(face.as_ref());
            list.offsets.push(list.corners.len());
            triangles &= face.as_ref().len() == 3;
        }
        if triangles {
            list.offsets = Vec::new();
        }
        list
    }
}

/// The faces in order.
#[derive(Clone, Debug)]
pub struct Iter<'a> {
    faces: &'a Faces,
    left: std::ops::Range<usize>,
}

impl<'a> Iterator for Iter<'a> {
    type Item = &'a [usize];

    fn next(&mut self) -> Option<&'a [usize]> {
        self.left.next().map(|face| &self.faces[face])
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.left.size_hint()
    }

    fn nth(&mut self, n: usize) -> Option<&'a [usize]> {
        self.left.nth(n).map(|face| &self.faces[face])
    }
}

impl<'a> DoubleEndedIterator for Iter<'a> {
    fn next_back(&mut self) -> Option<&'a [usize]> {
        self.left.next_back().map(|face| &self.faces[face])
    }
}

impl ExactSizeIterator for Iter<'_> {}

impl<'a> IntoIterator for &'a Faces {
    type Item = &'a [usize];
    type IntoIter = Iter<'a>;

    fn into_iter(self) -> Iter<'a> {
        self.iter()
    }
}

impl<F: AsRef<[usize]>> PartialEq<[F]> for Faces {
    fn eq(&self, other: &[F]) -> bool {
        self.len() == other.len() && self.iter().zip(other).all(|(a, b)| a == b.as_ref())
    }
}

impl<F: AsRef<[usize]>, const N: usize> PartialEq<[F; N]> for Faces {
    fn eq(&self, other: &[F; N]) -> bool {
        *self == other[..]
    }
}

impl<F: AsRef<[usize]>> PartialEq<Vec<F>> for Faces {
    fn eq(&self, other: &Vec<F>) -> bool {
        *self == other[..]
    }
}

impl fmt::Debug for Faces {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_need_no_offsets_and_a_single_quadrilateral_makes_them() {
        let triangles = Faces::triangles(&[[0, 1, 2], [0, 2, 3]]);
        assert_eq!(triangles, [vec![0, 1, 2], vec![0, 2, 3]].iter().collect::<Faces>());
        let mixed: Faces = [vec![0, 1, 2], vec![0, 2, 3, 4]].iter().collect();
        assert_eq!(triangles, Faces::from(vec![[0, 1, 2], [0, 2, 3]]));
        assert!(triangles.are_triangles() && !mixed.are_triangles());
        assert_eq!((mixed.len(), &mixed[1], mixed.get(2)), (2, &[0, 2, 3, 4][..], None));
        assert_eq!(mixed.to_vec(), [vec![0, 1, 2], vec![0, 2, 3, 4]]);
    }

    #[test]
    fn a_face_is_turned_round_in_place() {
        let mut faces = Faces::triangles(&[[0, 1, 2], [0, 2, 3]]);
        faces.reverse(1);
        assert_eq!(faces, [[0, 1, 2], [3, 2, 0]]);
        assert_eq!(format!("{faces:?}"), "[[0, 1, 2], [3, 2, 0]]");
    }

    #[test]
    fn no_faces_are_triangles_all_the_same() {
        let none: Faces = Vec::<Vec<usize>>::new().iter().collect();
        assert!(none.is_empty() && none.are_triangles());
    }
}
