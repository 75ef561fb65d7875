//! Puts edge weights together to a stiffness matrix.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use super::BuildError;
use crate::domain::incidence::Incidence;
use crate::linalg::Csr;
use crate::scalar::Scalar;

/// The two weights `[ω_ij, ω_ji]` of an edge `[i, j]`.
pub type EdgeWeights<S> = ([usize; 2], [S; 2]);

/// The matrix `L_ij = −ω_ij`, `L_ii = Σ_j ω_ij`. Weights of parallel edges are added; an edge from a vertex to itself
/// contributes nothing.
///
/// The diagonal is summed over the finished weights of the row, columns ascending: a row sum is zero up to the rounding of
/// that one sum, however the weights came about. Over the rationals it is zero. Cost: O(n + E log valence).
pub fn from_weights<S: Scalar>(vertices: usize, weights: &[EdgeWeights<S>]) -> Csr<S> {
    from_each(vertices, weights.len(), |e| weights[e].0, |e, forth| weights[e].1[usize::from(!forth)].clone())
}

/// The same where ends and weights are told by the number of the edge: the weight in the row of its first end (`true`) and of its second.
pub(super) fn from_each<S: Scalar>(
    vertices: usize,
    edges: usize,
    ends: impl Fn(usize) -> [usize; 2] + Sync,
    weight: impl Fn(usize, bool) -> S + Sync,
) -> Csr<S> {
    // At each vertex the other end and the number of each edge, by that end; those of a column in the order given.
    let mut at = Lists::gather(vertices, edges, |e| {
        let [a, b] = ends(e);
        (a != b).then_some([(a, (b as u32, e as u32)), (b, (a as u32, e as u32))])
    });
    at.sort();
    let columns = |i: usize| at.of(i).chunk_by(|a, b| a.0 == b.0);
    let write = |i: usize, indices: &mut [usize], values: &mut [S]| {
        let entries = columns(i).map(|parallel| {
            // Subtracted from zero rather than negated: a weight of zero is stored as +0.
            let entry = |&(_, e): &(u32, u32)| S::zero() - weight(e as usize, ends(e as usize)[0] == i);
            let sum = parallel[1..].iter().fold(entry(&parallel[0]), |sum, e| sum + entry(e));
            (parallel[0].0 as usize, sum)
        });
        write_row(i, entries, indices, values);
    };
    Csr::from_rows(vertices, vertices, |i| 1 + columns(i).count(), write)
}

/// The same for the edges of a domain, `[smaller, larger]` in lexicographic order: `weight` has that of an edge in the row of its
/// smaller end (`true`) and of its larger one. What [`from_weights`] makes of them, bit for bit, without sorting. Rows are written in
/// parallel, each once; it takes no memory beside the matrix.
///
/// # Errors
/// The first entry that is NaN or infinite.
pub(super) fn of_edges(
    laplacian: &'static str,
    edges: &[[usize; 2]],
    incidence: &Incidence,
    weight: impl Fn(usize, bool) -> f64 + Sync,
) -> Result<Csr, BuildError> {
    // A sum is finite if and only if its terms and their sums are: the diagonal speaks for its row.
    let finite = AtomicBool::new(true);
    let n = incidence.vertices();
    let matrix = Csr::from_rows(
        n,
        n,
        |i| 1 + incidence.degree(i),
        |i, indices, values| {
            let below = incidence.downward(i).iter().map(|&e| (edges[e as usize][0], 0.0 - weight(e as usize, false)));
            let above = incidence.upward(i).map(|e| (edges[e][1], 0.0 - weight(e, true)));
            let (mut at, mut sum) = (0, 0.0);
            let mut put = |j: usize, value: f64| {
                (indices[at], values[at]) = (j, value);
                at += 1;
            };
            for (j, value) in below {
                sum -= value;
                put(j, value);
            }
            put(i, 0.0);
            for (j, value) in above {
                sum -= value;
                put(j, value);
            }
            values[incidence.downward(i).len()] = sum;
            if !sum.is_finite() {
                finite.store(false, Relaxed);
            }
        },
    );
    if !finite.into_inner() {
        check_finite(laplacian, &matrix)?;
    }
    Ok(matrix)
}

/// The matrix of these weights, row by row, each row `(j, ω_ij)` with columns ascending and without its diagonal.
///
/// # Errors
/// The first entry that is NaN or infinite.
pub(super) fn of_rows(laplacian: &'static str, rows: &[Vec<(usize, f64)>]) -> Result<Csr, BuildError> {
    let entries = |i: usize| rows[i].iter().map(|&(j, weight)| (j, 0.0 - weight));
    let write = |i: usize, indices: &mut [usize], values: &mut [f64]| write_row(i, entries(i), indices, values);
    let matrix = Csr::from_rows(rows.len(), rows.len(), |i| 1 + rows[i].len(), write);
    check_finite(laplacian, &matrix)?;
    Ok(matrix)
}

/// Writes the entries of a row, columns ascending, and the diagonal between them, which is summed over them.
fn write_row<S: Scalar>(i: usize, entries: impl Iterator<Item = (usize, S)>, indices: &mut [usize], values: &mut [S]) {
    let (mut sum, mut at, mut diagonal) = (S::zero(), 0, 0);
    for (j, value) in entries {
        if j < i {
            diagonal = at + 1;
        }
        if at == diagonal && j > i {
            at += 1;
        }
        sum = sum - value.clone();
        (indices[at], values[at]) = (j, value);
        at += 1;
    }
    (indices[diagonal], values[diagonal]) = (i, sum);
}

/// A list for each vertex, all in one allocation.
struct Lists<T> {
    offsets: Vec<usize>,
    items: Vec<T>,
}

impl<T: Copy + Default + Ord> Lists<T> {
    /// Puts down the two items of each of `0..count` that has any, at the vertices that they come with, in that order: a counting sort.
    fn gather(vertices: usize, count: usize, pair: impl Fn(usize) -> Option<[(usize, T); 2]>) -> Self {
        let all = || (0..count).filter_map(&pair).flatten();
        let mut offsets = vec![0; vertices + 2];
        // Counted two places on, the offsets are where the next item goes, and where each list begins in the end.
        all().for_each(|(v, _)| offsets[v + 2] += 1);
        (0..=vertices).for_each(|v| offsets[v + 1] += offsets[v]);
        let mut items = vec![T::default(); offsets[vertices + 1]];
        for (v, item) in all() {
            items[offsets[v + 1]] = item;
            offsets[v + 1] += 1;
        }
        Lists { offsets, items }
    }

    /// Sorts each list.
    fn sort(&mut self) {
        for v in 0..self.offsets.len() - 2 {
            self.items[self.offsets[v]..self.offsets[v + 1]].sort_unstable();
        }
    }

    fn of(&self, vertex: usize) -> &[T] {
        &self.items[self.offsets[vertex]..self.offsets[vertex + 1]]
    }
}

/// The same, refused if an entry is not finite.
///
/// # Errors
/// The first entry that is NaN or infinite.
pub fn finite(laplacian: &'static str, vertices: usize, weights: &[EdgeWeights<f64>]) -> Result<Csr, BuildError> {
    let matrix = from_weights(vertices, weights);
    check_finite(laplacian, &matrix)?;
    Ok(matrix)
}

/// Refuses a matrix with an entry that is not finite.
///
/// # Errors
/// The first entry that is NaN or infinite.
pub fn check_finite(laplacian: &'static str, matrix: &Csr) -> Result<(), BuildError> {
    if matrix.values().iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    match matrix.entries().find(|(_, _, v)| !v.is_finite()) {
        Some((i, j, value)) => Err(BuildError::NotFinite { laplacian, i, j, value: value.to_string() }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The matrix from triplets, another way than row by row.
    fn from_triplets<S: Scalar>(vertices: usize, weights: &[EdgeWeights<S>]) -> Csr<S> {
        let mut entries = Vec::new();
        for ([i, j], [forth, back]) in weights.iter().filter(|([i, j], _)| i != j) {
            entries.push((*i, *j, S::zero() - forth.clone()));
            entries.push((*j, *i, S::zero() - back.clone()));
        }
        let off_diagonal = Csr::from_triplets(vertices, vertices, &entries);
        let row_sum = |i: usize| off_diagonal.row(i).fold(S::zero(), |sum, (_, v)| sum - v.clone());
        off_diagonal.add(&Csr::diagonal(&(0..vertices).map(row_sum).collect::<Vec<S>>()))
    }

    /// Columns and values, bit for bit.
    fn bits(matrix: &Csr) -> Vec<(usize, usize, u64)> {
        matrix.entries().map(|(i, j, v)| (i, j, v.to_bits())).collect()
    }

    fn random(n: usize, count: usize) -> Vec<EdgeWeights<f64>> {
        let mut state = 3_u64;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as usize
        };
        let weight = |k: usize| if k.is_multiple_of(7) { 0.0 } else { k as f64 / 1e9 - 1.0 };
        (0..count).map(|_| ([next() % n, next() % n], [weight(next()), weight(next())])).collect()
    }

    #[test]
    fn rows_have_the_bits_of_triplets_parallel_edges_and_loops_and_isolated_vertices_included() {
        for (n, count) in [(1, 3), (2, 9), (7, 60), (40, 30), (9000, 40_000)] {
            let weights = random(n, count);
            assert_eq!(bits(&from_weights(n, &weights)), bits(&from_triplets(n, &weights)), "{n} {count}");
        }
    }

    #[test]
    fn edges_in_order_have_the_bits_of_triplets_on_any_number_of_threads() {
        for (n, count) in [(2, 1), (7, 12), (40, 30), (20_000, 60_000)] {
            let mut weights = random(n, count);
            weights.iter_mut().for_each(|(e, _)| e.sort_unstable());
            weights.retain(|(e, _)| e[0] != e[1]);
            weights.sort_by_key(|&(e, _)| e);
            weights.dedup_by_key(|(e, _)| *e);
            let (edges, values): (Vec<_>, Vec<_>) = weights.iter().copied().unzip();
            let expected = bits(&from_triplets(n, &weights));
            for threads in [1, 2, 5] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let weight = |e: usize, upward: bool| if upward { values[e][0] } else { values[e][1] };
                let build = || of_edges("x", &edges, &Incidence::new(n, &edges), weight).unwrap();
                assert_eq!(pool.install(|| bits(&build())), expected, "{n} {count} {threads}");
            }
        }
    }

    #[test]
    fn parallel_edges_add_up_and_loops_vanish() {
        let l = from_weights(2, &[([0, 1], [1.0, 2.0]), ([0, 1], [0.5, 0.25]), ([1, 1], [7.0, 7.0])]);
        assert_eq!([l.at(0, 0), l.at(0, 1), l.at(1, 0), l.at(1, 1)], [1.5, -1.5, -2.25, 2.25]);
    }

    #[test]
    fn a_zero_weight_is_stored_as_positive_zero() {
        let l = from_weights(2, &[([0, 1], [0.0, 0.0])]);
        assert!(l.get(0, 1).is_some_and(|v| *v == 0.0 && v.is_sign_positive()));
    }

    #[test]
    fn an_infinite_weight_is_refused_with_its_place() {
        let refusal = finite("x", 2, &[([0, 1], [1.0, f64::INFINITY])]).unwrap_err();
        assert!(matches!(refusal, BuildError::NotFinite { i: 1, j: 0, .. }), "{refusal}");
        for weight in [f64::INFINITY, f64::NAN, 1e308] {
            let edges = [[0, 1], [0, 2]];
            let refusal = of_edges("x", &edges, &Incidence::new(3, &edges), |_, _| weight).unwrap_err();
            assert!(matches!(refusal, BuildError::NotFinite { i: 0, j: 0, .. }), "{refusal}");
        }
    }
}
