//! A short fingerprint of the rows of a record, by which a session names the row that changed without having the old
//! file.
//!
//! Each data row `r` (from 0) has a hash `h_r` modulo `p = 2^61 - 1`, and the record the three sums of `h_r`,
//! `(r + 1) h_r` and `(r + 1)^2 h_r` modulo `p`. Where one row changed, the sums differ by `d`, `(r + 1) d` and
//! `(r + 1)^2 d`, so two of them give the row and the third confirms it. Where more changed, hashes of at most 64
//! blocks of rows narrow the first down. Session files hold these numbers: what is computed here must never change.

use std::fmt;

use super::Track;
use super::rows::{text_of, unchanged, walk};
use crate::error::Result;

/// The modulus, a Mersenne prime.
const P: u64 = (1 << 61) - 1;
/// The point at which the polynomial of a row is evaluated: binary digits of pi.
const POINT: u64 = 0x1243_f6a8_885a_308d;
const MOST_BLOCKS: usize = 64;

/// A fingerprint of the rows of a record. Its text form is one line of hexadecimal digits.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RowChecks {
    sums: [u64; 3],
    /// Binary logarithm of the rows in a block.
    shift: u32,
    /// For each block, the sum of the low 32 bits of `(r + 1) h_r`, modulo 2^32: blocks add up to larger blocks.
    blocks: Vec<u32>,
}

impl RowChecks {
    /// The fingerprint of the rows of `track`, of the bytes of each row without its line end.
    ///
    /// # Errors
    /// [`Error::Input`](crate::error::Error::Input) when the source is no longer the one that was loaded.
    pub fn of(track: &Track) -> Result<Self> {
        let stored = unchanged(track)?;
        let text = text_of(track, &stored)?;
        let mut checks = Self::empty(track.rows);
        walk(track, &text, |row, record, _| {
            checks.add(row, record.bytes);
            Ok(true)
        })?;
        Ok(checks)
    }

    fn empty(rows: usize) -> Self {
        let mut shift = 0;
        while rows.div_ceil(1 << shift) > MOST_BLOCKS {
            shift += 1;
        }
        Self { sums: [0; 3], shift, blocks: vec![0; rows.div_ceil(1 << shift)] }
    }

    fn add(&mut self, row: usize, bytes: &[u8]) {
        let place = row as u64 + 1;
        let zeroth = hash(bytes);
        let first = times(zeroth, place);
        let second = times(first, place);
        for (sum, term) in self.sums.iter_mut().zip([zeroth, first, second]) {
            *sum = plus(*sum, term);
        }
        if let Some(block) = self.blocks.get_mut(row >> self.shift) {
            #[expect(clippy::cast_possible_truncation, reason = "the low half is wanted")]
            let low = first as u32;
            *block = block.wrapping_add(low);
        }
    }

    /// Reads the text form; none when it is not one.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let mut words = text.split_ascii_whitespace();
        let sums = words.next()?;
        if sums.len() != 48 || !sums.is_ascii() {
            return None;
        }
        let sum = |i: usize| u64::from_str_radix(&sums[16 * i..16 * (i + 1)], 16).ok().filter(|s| *s < P);
        let sums = [sum(0)?, sum(1)?, sum(2)?];
        let shift = words.next()?.parse().ok().filter(|s| *s < 32)?;
        let digits = words.next().unwrap_or_default();
        if words.next().is_some()
            || !digits.is_ascii()
            || !digits.len().is_multiple_of(8)
            || digits.len() > 8 * MOST_BLOCKS
        {
            return None;
        }
        let block = |i: usize| u32::from_str_radix(&digits[8 * i..8 * (i + 1)], 16).ok();
        let blocks = (0..digits.len() / 8).map(block).collect::<Option<_>>()?;
        Some(Self { sums, shift, blocks })
    }

    /// The first difference between these rows (of `rows_then`) and those of `now` (of `rows_now`), in words.
    #[must_use]
    pub fn first_difference(&self, now: &Self, rows_then: usize, rows_now: usize) -> String {
        if rows_then == rows_now {
            if self == now {
                return "every row is the same; header, comments, line ends or packing differ".into();
            }
            if let Some(row) = self.only_row(now, rows_now) {
                return format!("row {row} differs, and no other");
            }
        }
        let shift = self.shift.max(now.shift);
        let (then_blocks, now_blocks) = (self.blocks_of(shift), now.blocks_of(shift));
        let length = 1_usize << shift;
        let differing = then_blocks.iter().zip(&now_blocks).position(|(a, b)| a != b);
        let common = rows_then.min(rows_now);
        if rows_then == rows_now {
            return match differing {
                Some(block) => {
                    format!("the first row that differs is {}", range(block * length, (block + 1) * length, common))
                }
                None => "some rows differ".into(),
            };
        }
        let change = match rows_now.checked_sub(rows_then) {
            Some(added) => format!("{} added", counted(added)),
            None => format!("{} removed", counted(rows_then - rows_now)),
        };
        // The last block of the shorter record is not whole, so it differs anyway.
        match differing.map_or(common, |block| block * length) {
            same if same + length > common => format!("{change}: the first {} are the same", counted(same)),
            same => format!("{change}: the first difference is in {}", range(same, same + length, common)),
        }
    }

    /// The row (from 1) that alone differs.
    fn only_row(&self, now: &Self, rows: usize) -> Option<u64> {
        let [d0, d1, d2] = [0, 1, 2].map(|i| plus(now.sums[i], P - self.sums[i]));
        if d0 == 0 {
            return None;
        }
        let place = times(d1, inverse(d0));
        ((1..=rows as u64).contains(&place) && times(times(d0, place), place) == d2).then_some(place)
    }

    fn blocks_of(&self, shift: u32) -> Vec<u32> {
        let together = 1 << (shift - self.shift);
        self.blocks.chunks(together).map(|b| b.iter().fold(0_u32, |sum, b| sum.wrapping_add(*b))).collect()
    }
}

impl fmt::Display for RowChecks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [s0, s1, s2] = self.sums;
        write!(f, "{s0:016x}{s1:016x}{s2:016x} {} ", self.shift)?;
        self.blocks.iter().try_for_each(|block| write!(f, "{block:08x}"))
    }
}

fn range(from: usize, to: usize, rows: usize) -> String {
    let (from, to) = (from + 1, to.min(rows).max(from + 1));
    if from == to { format!("row {from}") } else { format!("one of rows {from} to {to}") }
}

fn counted(rows: usize) -> String {
    if rows == 1 { "1 row".into() } else { format!("{rows} rows") }
}

/// The bytes as a polynomial: seven bytes (little-endian, the last ones filled with zeros) plus one make a
/// coefficient, the number of bytes the last.
fn hash(bytes: &[u8]) -> u64 {
    let mut hash = 0;
    for chunk in bytes.chunks(7) {
        let mut word = [0; 8];
        word[..chunk.len()].copy_from_slice(chunk);
        hash = plus(times(hash, POINT), u64::from_le_bytes(word) + 1);
    }
    plus(times(hash, POINT), bytes.len() as u64 % P)
}

fn plus(a: u64, b: u64) -> u64 {
    let sum = a + b;
    if sum >= P { sum - P } else { sum }
}

fn times(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b);
    // 2^61 = 1, so the high bits count like the low ones; the sum is below 2 p.
    #[expect(clippy::cast_possible_truncation, reason = "61 bits each")]
    let (low, high) = ((product & u128::from(P)) as u64, (product >> 61) as u64);
    plus(low, high)
}

/// By Fermat's little theorem: `a^(p - 2)`.
fn inverse(a: u64) -> u64 {
    let (mut result, mut base, mut exponent) = (1, a, P - 2);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = times(result, base);
        }
        base = times(base, base);
        exponent >>= 1;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(count: usize) -> Vec<String> {
        (0..count).map(|i| format!("{i},{}.5", i * 7 % 1000)).collect()
    }

    fn checks(rows: &[String]) -> RowChecks {
        let mut checks = RowChecks::empty(rows.len());
        rows.iter().enumerate().for_each(|(i, row)| checks.add(i, row.as_bytes()));
        checks
    }

    fn difference(then: &[String], now: &[String]) -> String {
        checks(then).first_difference(&checks(now), then.len(), now.len())
    }

    #[test]
    fn arithmetic_is_that_of_the_field() {
        assert_eq!(times(1 << 60, 2), 1); // 2^61 = 1 mod p
        assert_eq!(times(P - 1, P - 1), 1);
        for a in [1, 2, 12_345, P - 1] {
            assert_eq!(times(a, inverse(a)), 1);
        }
    }

    #[test]
    fn a_single_changed_row_is_named() {
        let then = rows(10_000);
        for row in [0, 1240, 9999] {
            let mut now = then.clone();
            now[row].push('1');
            assert_eq!(difference(&then, &now), format!("row {} differs, and no other", row + 1));
        }
        assert!(difference(&then, &then).starts_with("every row is the same"));
    }

    #[test]
    fn of_several_changed_rows_the_first_is_narrowed_down() {
        let then = rows(10_000); // 40 blocks of 256
        let mut now = then.clone();
        now[2000].push('1');
        now[700].push('1');
        assert_eq!(difference(&then, &now), "the first row that differs is one of rows 513 to 768");
        now = then.clone();
        now.swap(3, 4);
        assert_eq!(difference(&then, &now), "the first row that differs is one of rows 1 to 256");
        let few = rows(50);
        let mut now = few.clone();
        now[20].push('1');
        now[30].push('1');
        assert_eq!(difference(&few, &now), "the first row that differs is row 21");
    }

    #[test]
    fn added_and_removed_rows_are_counted_and_placed() {
        let then = rows(10_000);
        assert_eq!(difference(&then, &rows(10_010)), "10 rows added: the first 9984 rows are the same");
        // Twice the rows, twice the length of a block.
        assert_eq!(difference(&then, &rows(20_000)), "10000 rows added: the first 9728 rows are the same");
        assert_eq!(difference(&then, &rows(9_999)), "1 row removed: the first 9984 rows are the same");
        let mut now = then.clone();
        now.remove(700);
        assert_eq!(difference(&then, &now), "1 row removed: the first difference is in one of rows 513 to 768");
    }

    #[test]
    fn the_text_form_reads_back() {
        for count in [0, 1, 64, 65, 10_000] {
            let checks = checks(&rows(count));
            assert_eq!(RowChecks::parse(&checks.to_string()), Some(checks));
        }
        for bad in ["", "12", "xyz 0 ", &"f".repeat(48), &format!("{} 0 123", "0".repeat(48))] {
            assert_eq!(RowChecks::parse(bad), None);
        }
    }

    #[test]
    fn what_is_computed_never_changes() {
        // Worked out apart with Python's integers: h = (h * POINT + word + 1) % p over words of 7 bytes, then the length.
        assert_eq!(hash(b""), 0);
        assert_eq!(hash(b"a"), 2_162_973_036_083_844_658);
        assert_eq!(hash(b"2019-11-11T17:57:05Z,48.1673677089"), 2_012_009_191_089_177_434);
    }
}
