//! The corners of a face, checked where they stand.

use super::error::{Place, ReadError};

/// The position in the list of the first corner that stands there already. Cost: O(k log k).
pub(super) fn repeated(corners: &[usize]) -> Option<usize> {
    let mut order: Vec<usize> = (0..corners.len()).collect();
    order.sort_unstable_by_key(|&at| (corners[at], at));
    order.windows(2).filter(|w| corners[w[0]] == corners[w[1]]).map(|w| w[1]).min()
}

/// Refuses a face with fewer than three corners or a repeated one. `place` gives the place of a corner, and that of the face
/// when the list is empty; `base` is the number of the first vertex in the format, `advice` tells
/// what to do about a face with too few corners.
pub(super) fn check(
    corners: &[usize],
    base: usize,
    advice: &'static str,
    place: impl Fn(usize) -> Place,
) -> Result<(), ReadError> {
    if let Some(at) = repeated(corners) {
        return Err(ReadError::RepeatedVertex { place: place(at), element: "face", vertex: corners[at] + base });
    }
    if corners.len() < 3 {
        return Err(ReadError::TooFewCorners { place: place(0), corners: corners.len(), advice });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_repetition_is_found() {
        assert_eq!(repeated(&[4, 7, 1]), None);
        assert_eq!(repeated(&[4, 7, 1, 7, 4]), Some(3));
        assert_eq!(repeated(&[]), None);
    }
}
