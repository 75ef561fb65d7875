//! Decisions read off a list of numbers: the list is what proptest draws and shrinks, the input is a function of it.

/// A list of numbers, read from the front; behind its end there are zeros, and zero is the plainest decision everywhere.
pub struct Tape<'a> {
    rest: &'a [u32],
}

impl<'a> Tape<'a> {
    pub fn new(numbers: &'a [u32]) -> Self {
        Tape { rest: numbers }
    }

    pub fn next(&mut self) -> u32 {
        let (first, rest) = self.rest.split_first().unwrap_or((&0, &[]));
        self.rest = rest;
        *first
    }

    /// A number below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        self.next() as usize % n.max(1)
    }

    pub fn pick<T: Copy>(&mut self, options: &[T]) -> T {
        options[self.below(options.len())]
    }

    /// True once in `n` times.
    pub fn once_in(&mut self, n: usize) -> bool {
        self.below(n) == n - 1
    }

    /// What is left, as bytes.
    pub fn bytes(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.rest).iter().flat_map(|n| n.to_le_bytes()).collect()
    }
}
