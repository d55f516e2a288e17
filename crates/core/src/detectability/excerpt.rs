//! The part of a long record on which wild points are tried.

use std::ops::Range;

/// A record of at most this many samples is taken whole.
pub const WHOLE: usize = 65_536;

/// Pieces of a longer one …
const PIECES: usize = 16;
/// … with this many samples each.
const PIECE: usize = WHOLE / PIECES;

/// The positions of the samples that are taken of `n`, ascending; none: all of them. Pieces lie at equal distances.
pub(super) fn excerpt(n: usize) -> Option<Vec<u32>> {
    if n <= WHOLE {
        return None;
    }
    let start = |piece: usize| piece * (n - PIECE) / (PIECES - 1);
    let positions = |piece: usize| -> Range<usize> { start(piece)..start(piece) + PIECE };
    #[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
    let all = (0..PIECES).flat_map(positions).map(|i| i as u32).collect();
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_record_is_seen_from_its_first_sample_to_its_last() {
        assert_eq!(excerpt(WHOLE), None);
        for n in [WHOLE + 1, 1_000_000] {
            let taken = excerpt(n).unwrap();
            assert_eq!((taken.len(), taken[0], taken[WHOLE - 1] as usize), (WHOLE, 0, n - 1));
            assert!(taken.windows(2).all(|w| w[0] < w[1]));
        }
    }
}
