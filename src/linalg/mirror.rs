//! Each entry above the diagonal with its mirror image below.

use super::Csr;
use crate::scalar::Scalar;

/// The entries that a square matrix stores above the diagonal, row by row, each with where it is stored and where its mirror image is.
///
/// # Memory
/// 8 bytes an entry above the diagonal.
#[derive(Clone, Debug)]
pub struct Mirror {
    pairs: Vec<[u32; 2]>,
    /// The first pair of each row, and the end.
    starts: Vec<u32>,
}

impl Mirror {
    /// Of a matrix whose pattern is symmetric and that stores fewer than 2³² entries; `None` for any other. Cost: O(n + nnz), each
    /// row read once in order and once as the rows above come by.
    pub fn of<S: Scalar>(matrix: &Csr<S>) -> Option<Self> {
        let offsets = matrix.offsets();
        let n = matrix.rows();
        if n != matrix.columns() || u32::try_from(matrix.stored()).is_err() {
            return None;
        }
        // In each row, the next entry before the diagonal that nobody has met: the rows above come in the order of its columns.
        let mut next: Vec<u32> = offsets[..n].iter().map(|&at| at as u32).collect();
        let indices = matrix.indices();
        let (mut pairs, mut starts) =
            (Vec::with_capacity(matrix.stored().saturating_sub(n) / 2), Vec::with_capacity(n + 1));
        starts.push(0);
        for i in 0..n {
            let first = next[i] as usize;
            // All before the diagonal have been met, or one of them has no mirror image.
            if first < offsets[i + 1] && indices[first] < i {
                return None;
            }
            let first = first + usize::from(first < offsets[i + 1] && indices[first] == i);
            for at in first..offsets[i + 1] {
                let mirrored = &mut next[indices[at]];
                let j = indices[at];
                if *mirrored as usize >= offsets[j + 1] || indices[*mirrored as usize] != i {
                    return None;
                }
                pairs.push([at as u32, *mirrored]);
                *mirrored += 1;
            }
            starts.push(pairs.len() as u32);
        }
        Some(Mirror { pairs, starts })
    }

    /// Where the entries of row i above the diagonal are stored, and their mirror images.
    pub fn row(&self, i: usize) -> &[[u32; 2]] {
        &self.pairs[self.starts[i] as usize..self.starts[i + 1] as usize]
    }

    /// The pairs of all rows.
    pub fn pairs(&self) -> &[[u32; 2]] {
        &self.pairs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_meet_their_mirror_images_and_a_missing_one_is_noticed_wherever_it_is() {
        let places = [(0, 0), (0, 2), (0, 3), (1, 2), (2, 0), (2, 1), (2, 2), (3, 0)];
        let matrix = |skip: Option<usize>| {
            let kept = places.iter().enumerate().filter(|(k, _)| Some(*k) != skip);
            let triplets: Vec<_> = kept.map(|(k, &(i, j))| (i, j, k as f64)).collect();
            Csr::from_triplets(4, 4, &triplets)
        };
        let whole = matrix(None);
        let mirror = Mirror::of(&whole).unwrap();
        let values =
            |i: usize| mirror.row(i).iter().map(|p| p.map(|at| whole.values()[at as usize])).collect::<Vec<_>>();
        assert_eq!([0, 1, 2, 3].map(values), [vec![[1.0, 4.0], [2.0, 7.0]], vec![[3.0, 5.0]], vec![], vec![]]);
        for (k, &(i, j)) in places.iter().enumerate() {
            assert_eq!(Mirror::of(&matrix(Some(k))).is_some(), i == j, "without ({i}, {j})");
        }
        assert!(Mirror::of(&Csr::from_triplets(2, 3, &[(0, 2, 1.0)])).is_none());
    }
}
