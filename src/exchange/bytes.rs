//! Fixed-size values from binary data.

use super::error::Place;

/// A position in binary data.
pub(super) struct Bytes<'a> {
    name: &'a str,
    all: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    /// Starts at an offset; behind the end there is nothing to take.
    pub fn new(name: &'a str, all: &'a [u8], at: usize) -> Self {
        Bytes { name, all, at: at.min(all.len()) }
    }

    /// The next `N` bytes; `None`, and no step forward, if fewer are left.
    pub fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let taken = *self.all[self.at..].first_chunk()?;
        self.at += N;
        Some(taken)
    }

    /// Three little-endian floats.
    pub fn little_endian_point(&mut self) -> Option<[f64; 3]> {
        let bytes: [u8; 12] = self.take()?;
        Some(std::array::from_fn(|k| f64::from(f32::from_le_bytes(std::array::from_fn(|byte| bytes[4 * k + byte])))))
    }

    /// The offset of the next byte.
    pub fn offset(&self) -> usize {
        self.at
    }

    /// How many bytes are left.
    pub fn remaining(&self) -> usize {
        self.all.len() - self.at
    }

    /// An offset as a place.
    pub fn place(&self, offset: usize) -> Place {
        Place::byte(self.name, offset)
    }
}
