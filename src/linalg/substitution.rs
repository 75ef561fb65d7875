//! Forward and backward substitution for eight right-hand sides at a time.
//!
//! A node of the factor, columns with the same rows below themselves, goes over the rows of the [panel](super::panel) four columns at
//! a time: an entry of L is fetched once for eight vectors, a row of the panel once for four columns.
//!
//! # Cost
//! Two operations an entry of L, forward and backward, and a vector. With 163,842 rows half the time of the substitution in `faer`
//! with eight columns.

use pulp::{Arch, NullaryFnOnce};

use super::factor::{Ldlt, Node};
use super::panel::{Row, subtract_multiple};
use super::parallel::BLOCK;

/// Columns of L that are taken together.
const TILE: usize = 4;

impl Ldlt {
    /// Solves `L D Lᵀ X = B` in place, in the numbering of the elimination; on two threads each takes half the columns.
    pub(super) fn substitute(&self, x: &mut [Row]) {
        if rayon::current_num_threads() < 2 || x.len() <= BLOCK {
            return Arch::new().dispatch(Substitute { factor: self, x });
        }
        let half = |from: usize| x.iter().map(|row| std::array::from_fn(|k| row[from + k])).collect();
        let (mut left, mut right): (Vec<Row<4>>, Vec<Row<4>>) = (half(0), half(4));
        rayon::join(
            || Arch::new().dispatch(Substitute { factor: self, x: &mut left }),
            || Arch::new().dispatch(Substitute { factor: self, x: &mut right }),
        );
        for (row, (l, r)) in x.iter_mut().zip(left.iter().zip(&right)) {
            row[..4].copy_from_slice(l);
            row[4..].copy_from_slice(r);
        }
    }
}

struct Substitute<'a, const W: usize> {
    factor: &'a Ldlt,
    x: &'a mut [Row<W>],
}

impl<const W: usize> NullaryFnOnce for Substitute<'_, W> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for node in self.factor.nodes() {
            forward(&node, self.x);
        }
        for node in self.factor.nodes().rev() {
            backward(&node, self.x);
        }
    }
}

/// `X −= L X` for the columns of a node: from its own rows into those below.
#[inline(always)]
fn forward<const W: usize>(node: &Node<'_>, x: &mut [Row<W>]) {
    let mut j = 0;
    while j + TILE <= node.width {
        let next = node.first + j + TILE;
        let (head, tail) = x.split_at_mut(next);
        let own = &mut head[node.first + j..];
        let columns: [&[f64]; TILE] = std::array::from_fn(|q| &node.column(j + q)[j..]);
        for q in 0..TILE {
            let y = own[q];
            for r in q + 1..TILE {
                subtract_multiple(&mut own[r], columns[q][r], &y);
            }
        }
        let y: [Row<W>; TILE] = std::array::from_fn(|q| own[q]);
        let rest: [&[f64]; TILE] = std::array::from_fn(|q| &columns[q][TILE..]);
        let within = node.width - j - TILE;
        let here: [&[f64]; TILE] = std::array::from_fn(|q| &rest[q][..within]);
        for (i, z) in tail[..within].iter_mut().enumerate() {
            for q in 0..TILE {
                subtract_multiple(z, here[q][i], &y[q]);
            }
        }
        let there: [&[f64]; TILE] = std::array::from_fn(|q| &rest[q][within..][..node.below.len()]);
        for (i, &row) in node.below.iter().enumerate() {
            let z = &mut tail[row - next];
            for q in 0..TILE {
                subtract_multiple(z, there[q][i], &y[q]);
            }
        }
        j += TILE;
    }
    for j in j..node.width {
        let next = node.first + j + 1;
        let (head, tail) = x.split_at_mut(next);
        let y = head[next - 1];
        let (own, below) = node.column(j).split_at(node.width);
        for (&l, z) in own[j + 1..].iter().zip(tail.iter_mut()) {
            subtract_multiple(z, l, &y);
        }
        for (&row, &l) in node.below.iter().zip(below) {
            subtract_multiple(&mut tail[row - next], l, &y);
        }
    }
}

/// `X = D⁻¹ X − Lᵀ X` for the columns of a node: into its own rows from those below.
#[inline(always)]
fn backward<const W: usize>(node: &Node<'_>, x: &mut [Row<W>]) {
    let tiled = node.width / TILE * TILE;
    for j in (tiled..node.width).rev() {
        let next = node.first + j + 1;
        let (head, tail) = x.split_at_mut(next);
        let (own, below) = node.column(j).split_at(node.width);
        let mut sum: Row<W> = std::array::from_fn(|k| head[next - 1][k] / own[j]);
        for (&l, z) in own[j + 1..].iter().zip(tail.iter()) {
            subtract_multiple(&mut sum, l, z);
        }
        for (&row, &l) in node.below.iter().zip(below) {
            subtract_multiple(&mut sum, l, &tail[row - next]);
        }
        head[next - 1] = sum;
    }
    for j in (0..tiled).step_by(TILE).rev() {
        let next = node.first + j + TILE;
        let (head, tail) = x.split_at_mut(next);
        let own = &mut head[node.first + j..];
        let columns: [&[f64]; TILE] = std::array::from_fn(|q| &node.column(j + q)[j..]);
        let mut sums: [Row<W>; TILE] = std::array::from_fn(|q| std::array::from_fn(|k| own[q][k] / columns[q][q]));
        let rest: [&[f64]; TILE] = std::array::from_fn(|q| &columns[q][TILE..]);
        let within = node.width - j - TILE;
        let here: [&[f64]; TILE] = std::array::from_fn(|q| &rest[q][..within]);
        for (i, z) in tail[..within].iter().enumerate() {
            for q in 0..TILE {
                subtract_multiple(&mut sums[q], here[q][i], z);
            }
        }
        let there: [&[f64]; TILE] = std::array::from_fn(|q| &rest[q][within..][..node.below.len()]);
        for (i, &row) in node.below.iter().enumerate() {
            let z = &tail[row - next];
            for q in 0..TILE {
                subtract_multiple(&mut sums[q], there[q][i], z);
            }
        }
        for q in (0..TILE).rev() {
            for r in q + 1..TILE {
                let y = sums[r];
                subtract_multiple(&mut sums[q], columns[q][r], &y);
            }
        }
        own.copy_from_slice(&sums);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Csr;
    use crate::linalg::factor::Elimination;
    use crate::linalg::panel::{Panel, apply};

    fn number(i: usize, j: usize) -> f64 {
        ((i * 7919 + j * 104_729) % 1009) as f64 / 1009.0 - 0.5
    }

    fn panel(n: usize) -> Panel {
        (0..n).map(|i| std::array::from_fn(|j| number(i, j))).collect()
    }

    /// A band of five diagonals with a few far entries, positive definite.
    fn band(n: usize) -> Csr {
        let mut t: Vec<_> = (0..n).map(|i| (i, i, 9.0)).collect();
        for (i, j) in (0..n).flat_map(|i| [(i, i + 1), (i, i + 2), (i, (i * i + 40) % n)]) {
            if i < j && j < n {
                t.extend([(i, j, -number(i, j)), (j, i, -number(i, j))]);
            }
        }
        Csr::from_triplets(n, n, &t)
    }

    /// Copies of a band of 40 rows: nodes of many widths, and together more rows than a block.
    fn bands(copies: usize) -> Csr {
        let band = band(40);
        let entries = (0..copies).flat_map(|k| band.entries().map(move |(i, j, v)| (40 * k + i, 40 * k + j, *v)));
        Csr::from_triplets(40 * copies, 40 * copies, &entries.collect::<Vec<_>>())
    }

    #[test]
    fn substitution_solves_the_system_whatever_the_width_of_the_nodes() {
        let few = [1, 2, 3, 7, 40, 200].map(band);
        for a in few.into_iter().chain([bands(125)]) {
            let factor = Elimination::row_by_row(&a).unwrap().factor(&a).unwrap();
            let b = panel(a.rows());
            let mut x = b.clone();
            factor.substitute(&mut x);
            for (found, wanted) in apply(&a, &x).iter().flatten().zip(b.iter().flatten()) {
                assert!((found - wanted).abs() < 1e-13, "{}: {found} is not {wanted}", a.rows());
            }
        }
    }

    #[test]
    fn the_factor_of_every_kind_is_substituted() {
        // Small matrices in the order of minimum degree have nodes of one column.
        let a = band(200);
        let factor = Ldlt::new(&a).unwrap();
        let (order, b) = (factor.order(), panel(200));
        let mut x: Panel = order.iter().map(|&i| b[i]).collect();
        factor.substitute(&mut x);
        let mut columns: Vec<Vec<f64>> = (0..8).map(|j| b.iter().map(|row| row[j]).collect()).collect();
        factor.solve(&mut columns);
        for (k, &i) in order.iter().enumerate() {
            (0..8).for_each(|j| assert!((x[k][j] - columns[j][i]).abs() < 1e-13));
        }
    }

    #[test]
    fn one_thread_and_three_give_the_same_bits() {
        let a = bands(BLOCK / 40 + 2);
        let factor = Elimination::row_by_row(&a).unwrap().factor(&a).unwrap();
        let run = |threads: usize| {
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| {
                let mut x = panel(a.rows());
                factor.substitute(&mut x);
                x
            })
        };
        assert_eq!(run(1), run(3));
    }
}
