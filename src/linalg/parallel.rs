//! Lists made in parallel, element by element, with the same result on any number of threads.

use rayon::prelude::*;

/// How many elements a thread takes at a time. Shorter lists are made where they are asked for: waking a thread costs more.
pub(crate) const BLOCK: usize = 1 << 12;

/// The list of `f(0), …, f(count − 1)`.
pub(crate) fn collect<T: Send>(count: usize, f: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    if count <= BLOCK {
        return (0..count).map(f).collect();
    }
    (0..count).into_par_iter().with_min_len(BLOCK).map(&f).collect()
}

/// Fills a list block by block, each with the number of its first element, and lists what each comes to, in order.
pub(crate) fn fill<T: Send, R: Send>(list: &mut [T], write: impl Fn(usize, &mut [T]) -> R + Sync + Send) -> Vec<R> {
    if list.len() <= BLOCK {
        return vec![write(0, list)];
    }
    list.par_chunks_mut(BLOCK).enumerate().map(|(k, block)| write(k * BLOCK, block)).collect()
}

/// Folds the blocks of `0..count` each by itself and lists the results in order: for sums and scans that need no list.
pub(crate) fn blocks<T: Send>(count: usize, fold: impl Fn(std::ops::Range<usize>) -> T + Sync + Send) -> Vec<T> {
    let block = |k: usize| fold(k * BLOCK..count.min((k + 1) * BLOCK));
    match count.div_ceil(BLOCK) {
        many @ 2.. => (0..many).into_par_iter().map(block).collect(),
        few => (0..few).map(block).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_blocks_are_in_order_whatever_their_length() {
        for count in [0, 1, BLOCK, BLOCK + 1, 3 * BLOCK + 5] {
            assert_eq!(collect(count, |k| 2 * k), (0..count).map(|k| 2 * k).collect::<Vec<_>>());
            let mut filled = vec![0; count];
            let firsts = fill(&mut filled, |first, block| {
                block.iter_mut().enumerate().for_each(|(k, x)| *x = 2 * (first + k));
                first
            });
            assert_eq!(filled, collect(count, |k| 2 * k));
            assert_eq!(firsts, (0..count.max(1)).step_by(BLOCK).collect::<Vec<_>>());
            let all: Vec<usize> = blocks(count, |range| range.collect::<Vec<_>>()).concat();
            assert_eq!(all, (0..count).collect::<Vec<_>>());
        }
    }
}
