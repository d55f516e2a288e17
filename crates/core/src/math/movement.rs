//! How large the values of a slice are, and how little they move.

use std::ops::Range;

use super::pieces::{self, Check};

/// Values handled at a time, so that the compiler may use vector instructions.
const LANES: usize = 8;

/// The largest absolute value; 0 where there is none.
///
/// # Errors
/// What `check` gives, which is asked before each piece of work.
pub fn largest_of_many<E: Send>(values: &[f64], check: &impl Check<E>) -> Result<f64, E> {
    let each = pieces::map(values.len(), check, |piece| largest(&values[piece]))?;
    Ok(each.into_iter().fold(0.0, f64::max))
}

/// The largest absolute value; 0 where there is none.
#[must_use]
pub fn largest(values: &[f64]) -> f64 {
    let mut lanes = [0.0_f64; LANES];
    let (eights, rest) = values.as_chunks::<LANES>();
    for eight in eights {
        for (most, v) in lanes.iter_mut().zip(eight) {
            *most = if v.abs() > *most { v.abs() } else { *most };
        }
    }
    lanes.iter().copied().chain(rest.iter().map(|v| v.abs())).fold(0.0, f64::max)
}

/// The smallest step `|y[i + 1] - y[i]|` or third difference `|(y[i] - y[i + 3]) - 3 (y[i + 1] - y[i + 2])|` of more
/// than `zero`; infinite where there is none.
///
/// # Errors
/// What `check` gives, which is asked before each piece of work.
pub fn smallest_movement<E: Send>(y: &[f64], zero: f64, check: &impl Check<E>) -> Result<f64, E> {
    // Three samples more: what begins in this piece ends there.
    let of = |piece: Range<usize>| smallest_of(&y[piece.start..(piece.end + 3).min(y.len())], zero);
    Ok(pieces::map(y.len(), check, of)?.into_iter().fold(f64::INFINITY, f64::min))
}

fn smallest_of(y: &[f64], zero: f64) -> f64 {
    let step = |y: &[f64]| (y[1] - y[0]).abs();
    let third = |y: &[f64]| ((y[0] - y[3]) - 3.0 * (y[1] - y[2])).abs();
    let take = |least: f64, d: f64| if d > zero && d < least { d } else { least };
    let mut lanes = [f64::INFINITY; LANES];
    let mut at = 0;
    while let Some(window) = y.get(at..at + LANES + 3) {
        for (i, least) in lanes.iter_mut().enumerate() {
            *least = take(take(*least, step(&window[i..i + 2])), third(&window[i..i + 4]));
        }
        at += LANES;
    }
    let rest = &y[at..];
    let least = lanes.iter().copied().fold(f64::INFINITY, f64::min);
    let least = rest.windows(2).map(step).fold(least, take);
    rest.windows(4).map(third).fold(least, take)
}

#[cfg(test)]
mod tests {
    use super::super::pieces::{PIECE as CHUNK, certain, to_the_end};
    use super::*;

    #[test]
    fn they_are_what_single_comparisons_find() {
        for n in [0usize, 1, 2, 3, 4, 11, 12, 40, 40_000] {
            let y: Vec<f64> = (0..n).map(|i| ((i * 7919) % 10_007) as f64 * 0.25 - 700.0).collect();
            let size = y.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            assert_eq!(certain(largest_of_many(&y, &to_the_end)).to_bits(), size.to_bits());
            for zero in [0.0, 0.25, 300.0] {
                let steps = y.windows(2).map(|w| (w[1] - w[0]).abs());
                let thirds = y.windows(4).map(|w| ((w[0] - w[3]) - 3.0 * (w[1] - w[2])).abs());
                let least = steps.chain(thirds).filter(|d| *d > zero).fold(f64::INFINITY, f64::min);
                let got = certain(smallest_movement(&y, zero, &to_the_end));
                assert_eq!(got.to_bits(), least.to_bits(), "{n} {zero}");
            }
        }
    }

    #[test]
    fn nothing_is_missed_where_pieces_meet() {
        for at in CHUNK - 4..CHUNK + 4 {
            let mut y: Vec<f64> = (0..2 * CHUNK).map(|i| 1e3 * ((i * 7919) % 10_007) as f64).collect();
            y[at] = y[at - 1] + 0.5;
            assert_eq!(certain(smallest_movement(&y, 0.0, &to_the_end)).to_bits(), 0.5_f64.to_bits());
            y[at] = -1e9;
            assert_eq!(certain(largest_of_many(&y, &to_the_end)).to_bits(), 1e9_f64.to_bits());
        }
    }
}
