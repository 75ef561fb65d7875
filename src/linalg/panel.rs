//! Panels: eight vectors side by side, row after row, and what the eigensolver does with them.
//!
//! A row of a panel is a cache line, so an entry of a sparse matrix or of a factor that is fetched once serves eight vectors, from
//! one line of memory each. What is done with it is written out over the eight and compiled for the instructions that
//! the machine has (`pulp`; loops are `for` loops, for a closure of an iterator is compiled by itself, without them); every number
//! is formed by the same sums in the same order on any machine and any number of threads.

use pulp::{Arch, NullaryFnOnce};
use rayon::prelude::*;

use super::Csr;
use super::parallel::{self, BLOCK};

/// Vectors in a panel.
pub(super) const WIDTH: usize = 8;

/// One row of a panel.
pub(super) type Row<const W: usize = WIDTH> = [f64; W];

/// Eight vectors, row after row.
pub(super) type Panel = Vec<Row>;

/// A matrix that takes the vectors of a panel to others: entry (i, j) is the share of vector i in the new vector j.
pub(super) type Square = [Row; WIDTH];

/// Rows that stay in the first cache while all panels go over them.
const CHUNK: usize = 128;

/// `x −= l y`, entry by entry.
#[inline(always)]
pub(super) fn subtract_multiple<const W: usize>(x: &mut Row<W>, l: f64, y: &Row<W>) {
    for k in 0..W {
        x[k] -= l * y[k];
    }
}

/// `A X`.
pub(super) fn apply(a: &Csr, x: &[Row]) -> Panel {
    parallel::collect(x.len(), |i| {
        let mut sum = [0.0; WIDTH];
        for (j, v) in a.row(i) {
            subtract_multiple(&mut sum, -v, &x[j]);
        }
        sum
    })
}

/// `Vᵀ W` for every panel V of a space, summed block by block in a fixed order.
pub(super) fn products(space: &[Panel], w: &[Row]) -> Vec<Square> {
    let parts = parallel::blocks(w.len(), |range| Arch::new().dispatch(Products { space, w, range }));
    let mut total = vec![[[0.0; WIDTH]; WIDTH]; space.len()];
    for part in parts {
        for (sum, square) in total.iter_mut().zip(part) {
            for i in 0..WIDTH {
                subtract_multiple(&mut sum[i], -1.0, &square[i]);
            }
        }
    }
    total
}

struct Products<'a> {
    space: &'a [Panel],
    w: &'a [Row],
    range: std::ops::Range<usize>,
}

impl NullaryFnOnce for Products<'_> {
    type Output = Vec<Square>;

    #[inline(always)]
    fn call(self) -> Vec<Square> {
        let mut sums = vec![[[0.0; WIDTH]; WIDTH]; self.space.len()];
        for from in self.range.clone().step_by(CHUNK) {
            let rows = from..self.range.end.min(from + CHUNK);
            for (v, sum) in self.space.iter().zip(&mut sums) {
                // Half the vectors at a time: their sums then fit into registers.
                for half in [0, WIDTH / 2] {
                    let mut s: [Row; WIDTH / 2] = std::array::from_fn(|i| sum[half + i]);
                    for (x, y) in v[rows.clone()].iter().zip(&self.w[rows.clone()]) {
                        for i in 0..WIDTH / 2 {
                            for j in 0..WIDTH {
                                s[i][j] += x[half + i] * y[j];
                            }
                        }
                    }
                    sum[half..half + WIDTH / 2].copy_from_slice(&s);
                }
            }
        }
        sums
    }
}

/// `W −= Σ V C` over the panels V of a space with their squares C.
pub(super) fn subtract(w: &mut [Row], space: &[Panel], squares: &[Square]) {
    parallel::fill(w, |from, w| Arch::new().dispatch(Subtract { from, w, space, squares }));
}

struct Subtract<'a> {
    from: usize,
    w: &'a mut [Row],
    space: &'a [Panel],
    squares: &'a [Square],
}

impl NullaryFnOnce for Subtract<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (k, w) in self.w.chunks_mut(CHUNK).enumerate() {
            let from = self.from + k * CHUNK;
            for (v, c) in self.space.iter().zip(self.squares) {
                for (y, x) in w.iter_mut().zip(&v[from..]) {
                    let mut sum = *y;
                    for i in 0..WIDTH {
                        subtract_multiple(&mut sum, x[i], &c[i]);
                    }
                    *y = sum;
                }
            }
        }
    }
}

/// `W S` in place, for a single panel.
pub(super) fn transform(w: &mut [Row], s: &Square) {
    parallel::fill(w, |_, w| {
        for y in w {
            let x = std::mem::replace(y, [0.0; WIDTH]);
            for i in 0..WIDTH {
                subtract_multiple(y, -x[i], &s[i]);
            }
        }
    });
}

/// Replaces the vectors of a space by combinations of them, in place: panel j becomes `Σ_i V_i S[i][j]`, panels beyond the last
/// such j are given up.
pub(super) fn combine(space: &mut Vec<Panel>, squares: &[Vec<Square>]) {
    let kept = squares.first().map_or(0, Vec::len);
    let rows = space.first().map_or(0, Vec::len);
    let mut blocks: Vec<Vec<&mut [Row]>> = (0..rows.div_ceil(BLOCK)).map(|_| Vec::new()).collect();
    for panel in space.iter_mut() {
        for (block, rows) in blocks.iter_mut().zip(panel.chunks_mut(BLOCK)) {
            block.push(rows);
        }
    }
    blocks.par_iter_mut().for_each(|block| Arch::new().dispatch(Combine { block, squares, kept }));
    space.truncate(kept);
}

struct Combine<'a, 'b> {
    block: &'a mut [&'b mut [Row]],
    squares: &'a [Vec<Square>],
    kept: usize,
}

impl NullaryFnOnce for Combine<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let rows = self.block.first().map_or(0, |rows| rows.len());
        let mut made = vec![[[0.0; WIDTH]; CHUNK]; self.kept];
        for from in (0..rows).step_by(CHUNK) {
            let range = from..rows.min(from + CHUNK);
            for (j, new) in made.iter_mut().enumerate() {
                new.fill([0.0; WIDTH]);
                for (v, squares) in self.block.iter().zip(self.squares) {
                    for (y, x) in new.iter_mut().zip(&v[range.clone()]) {
                        let mut sum = *y;
                        for i in 0..WIDTH {
                            subtract_multiple(&mut sum, -x[i], &squares[j][i]);
                        }
                        *y = sum;
                    }
                }
            }
            for (old, new) in self.block.iter_mut().zip(&made) {
                old[range.clone()].copy_from_slice(&new[..range.len()]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(i: usize, j: usize) -> f64 {
        ((i * 7919 + j * 104_729) % 1009) as f64 / 1009.0 - 0.5
    }

    fn panel(n: usize, seed: usize) -> Panel {
        (0..n).map(|i| std::array::from_fn(|j| number(i + seed, j + 3 * seed))).collect()
    }

    #[test]
    fn products_differences_and_combinations_are_those_of_the_definition() {
        let n = 2 * BLOCK + 77;
        let space = vec![panel(n, 1), panel(n, 2), panel(n, 3)];
        let w = panel(n, 4);
        let found = products(&space, &w);
        let direct = |v: &Panel, i: usize, j: usize| v.iter().zip(&w).map(|(x, y)| x[i] * y[j]).sum::<f64>();
        for (v, square) in space.iter().zip(&found) {
            for (i, j) in (0..WIDTH).flat_map(|i| (0..WIDTH).map(move |j| (i, j))) {
                assert!((square[i][j] - direct(v, i, j)).abs() < 1e-10);
            }
        }
        let s: Vec<Vec<Square>> = (0..3)
            .map(|a| {
                (0..2).map(|b| std::array::from_fn(|i| std::array::from_fn(|j| number(8 * a + i, 8 * b + j)))).collect()
            })
            .collect();
        let mut combined = space.clone();
        combine(&mut combined, &s);
        assert_eq!(combined.len(), 2);
        for (b, made) in combined.iter().enumerate() {
            let mut expected = vec![[0.0; WIDTH]; n];
            let minus: Vec<Square> = s.iter().map(|row| row[b].map(|r| r.map(|v| -v))).collect();
            subtract(&mut expected, &space, &minus);
            for row in (0..n).step_by(101) {
                for j in 0..WIDTH {
                    let sum: f64 = (0..24).map(|i| space[i / 8][row][i % 8] * s[i / 8][b][i % 8][j]).sum();
                    assert!((made[row][j] - sum).abs() < 1e-13 && (expected[row][j] - sum).abs() < 1e-13);
                }
            }
        }
        let mut alone = w.clone();
        transform(&mut alone, &s[1][1]);
        let sum: f64 = (0..8).map(|i| w[5000][i] * s[1][1][i][3]).sum();
        assert!((alone[5000][3] - sum).abs() < 1e-14);
    }

    #[test]
    fn one_thread_and_three_give_the_same_bits() {
        let n = 3 * BLOCK;
        let near = (0..n).flat_map(|i| [(i, i, 1.0), (i, (i + 1) % n, number(i, 1))]);
        let a = Csr::from_triplets(n, n, &near.collect::<Vec<_>>());
        let run = |threads: usize| {
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| {
                let mut space = vec![panel(n, 1), panel(n, 2)];
                let mut w = apply(&a, &panel(n, 3));
                let squares = products(&space, &w);
                subtract(&mut w, &space, &squares);
                combine(&mut space, &[vec![squares[0]], vec![squares[1]]]);
                (w, space)
            })
        };
        assert_eq!(run(1), run(3));
    }
}
