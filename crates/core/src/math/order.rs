//! Order statistics: medians and the median absolute deviation. An even count takes the mean of the two middle
//! values; an empty slice gives NaN. Values must not be NaN.

use std::ops::RangeInclusive;

use super::pieces::{self, Check};

mod rank;
mod sort;

pub use sort::sort_many;

/// Makes the median absolute deviation of normal noise its standard deviation: 1 / `PhiInv(3/4)`, to the five
/// digits in which the literature uses it.
pub const MAD_TO_SIGMA: f64 = 1.4826;

/// The median; reorders the values.
#[must_use]
pub fn median_in_place(values: &mut [f64]) -> f64 {
    if values.is_empty() {
        return f64::NAN;
    }
    let n = values.len();
    middle_of_smallest(values, n / 2, !n.is_multiple_of(2))
}

/// The median of the values, which stay as they are.
#[must_use]
pub fn median(values: &[f64]) -> f64 {
    median_in_place(&mut values.to_vec())
}

/// The median of `value(0 .. n)`, of many values: in parallel and without a copy of them, the same on any number of
/// threads. A negative zero counts as zero.
///
/// # Errors
/// What `check` gives, which is asked before each piece of work.
pub fn median_of_many<E: Send>(n: usize, value: impl Fn(usize) -> f64 + Sync, check: &impl Check<E>) -> Result<f64, E> {
    median_of_smallest(n, n, value, check)
}

/// Quantile `q` (0 to 1) of `value(0 .. n)`, the one at or below, of many values: in parallel and without a copy of them.
/// NaN without any. A negative zero counts as zero.
///
/// # Errors
/// What `check` gives.
pub fn quantile_of_many<E: Send>(
    n: usize,
    q: f64,
    value: impl Fn(usize) -> f64 + Sync,
    check: &impl Check<E>,
) -> Result<f64, E> {
    if n == 0 {
        return Ok(f64::NAN);
    }
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "counts of samples are far below 2^53, and 0 <= q <= 1"
    )]
    let rank = (q * (n - 1) as f64) as usize;
    Ok(rank::of_many(n, [rank, rank], value, check)?[0])
}

/// The median of the `count <= n` smallest of `value(0 .. n)`, as [`median_of_many`] finds it.
///
/// # Errors
/// What `check` gives.
pub fn median_of_smallest<E: Send>(
    n: usize,
    count: usize,
    value: impl Fn(usize) -> f64 + Sync,
    check: &impl Check<E>,
) -> Result<f64, E> {
    if count == 0 {
        return Ok(f64::NAN);
    }
    let upper = count / 2;
    let lower = if count.is_multiple_of(2) { upper - 1 } else { upper };
    let [lower, upper] = rank::of_many(n, [lower, upper], value, check)?;
    Ok(if count.is_multiple_of(2) { mean_of_two(lower, upper) } else { upper })
}

/// The value of rank `middle` (from 0), or its mean with the one of the rank before.
fn middle_of_smallest(values: &mut [f64], middle: usize, odd: bool) -> f64 {
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    if odd { upper } else { mean_of_two(below.iter().copied().fold(f64::NEG_INFINITY, f64::max), upper) }
}

/// Those of many values that lie between two limits, for medians that are asked for again and again of ever other
/// parts, and those of the tail, which say how large such a part is.
#[derive(Debug, Clone, Default)]
pub struct Middle {
    below: usize,
    /// Those within the limits but not at the upper one.
    within: Vec<f64>,
    /// How many are the upper limit.
    at_end: usize,
    end: f64,
    tail: Vec<f64>,
    tail_from: f64,
}

impl Middle {
    /// Of `value(0 .. n)`, none of which may be NaN, those within `limits` and those from `tail_from` on.
    ///
    /// # Errors
    /// What `check` gives.
    pub fn of<E: Send>(
        n: usize,
        value: impl Fn(usize) -> f64 + Sync,
        limits: RangeInclusive<f64>,
        tail_from: f64,
        check: &impl Check<E>,
    ) -> Result<Self, E> {
        let (start, end) = (*limits.start(), *limits.end());
        let pieces = pieces::map(n, check, |piece| {
            let mut found = Self { end, tail_from, ..Self::default() };
            // Every value is written down, and the next over it where it does not count: no branch to guess.
            let (mut within, mut kept) = (vec![0.0; piece.len()], 0);
            let (mut tail, mut far) = (vec![0.0; piece.len()], 0);
            for v in piece.map(&value) {
                found.below += usize::from(v < start);
                found.at_end += usize::from(v >= start && v <= end) - usize::from(v >= start && v < end);
                within[kept] = v;
                kept += usize::from(v >= start && v < end);
                tail[far] = v;
                far += usize::from(v >= tail_from);
            }
            found.within = within[..kept].to_vec();
            found.tail = tail[..far].to_vec();
            found
        })?;
        let mut middle = Self { end, tail_from, ..Self::default() };
        for piece in pieces {
            middle.below += piece.below;
            middle.within.extend(piece.within);
            middle.at_end += piece.at_end;
            middle.tail.extend(piece.tail);
        }
        Ok(middle)
    }

    /// The values from [`Middle::tail_from`] on.
    #[must_use]
    pub fn tail(&self) -> &[f64] {
        &self.tail
    }

    /// Where the tail begins.
    #[must_use]
    pub fn tail_from(&self) -> f64 {
        self.tail_from
    }

    /// The median of the `count` smallest of all values, where what stands in their middle is among these.
    ///
    /// # Errors
    /// What `check` gives.
    pub fn median_of_smallest<E: Send>(&self, count: usize, check: &impl Check<E>) -> Result<Option<f64>, E> {
        let last = if count.is_multiple_of(2) { 1 } else { 0 };
        let upper = (count / 2).checked_sub(self.below);
        let Some((lower, upper)) = upper.and_then(|upper| Some((upper.checked_sub(last)?, upper))) else {
            return Ok(None);
        };
        let n = self.within.len();
        if upper >= n + self.at_end {
            return Ok(None);
        }
        let inside = [lower, upper].map(|rank| rank.min(n.saturating_sub(1)));
        let found = if n == 0 { [self.end; 2] } else { rank::of_slice(&self.within, inside, check)? };
        let [lower, upper] = [(lower, found[0]), (upper, found[1])].map(|(r, v)| if r < n { v } else { self.end });
        Ok(Some(if last == 1 { mean_of_two(lower, upper) } else { upper }))
    }
}

/// `1.4826 * median |x - center|`; reorders and overwrites the values.
#[must_use]
pub fn mad_scale_in_place(values: &mut [f64], center: f64) -> f64 {
    for v in values.iter_mut() {
        *v = (*v - center).abs();
    }
    MAD_TO_SIGMA * median_in_place(values)
}

/// The mean of two values, without overflow.
#[must_use]
#[inline]
pub fn mean_of_two(a: f64, b: f64) -> f64 {
    f64::midpoint(a, b)
}

#[cfg(test)]
mod tests {
    use super::super::pieces::{certain, to_the_end};
    use super::*;

    #[test]
    fn medians_of_odd_even_and_no_values() {
        assert!((median(&[3.0, 1.0, 2.0]) - 2.0).abs() < 1e-15);
        assert!((median(&[4.0, 1.0, 2.0, 3.0]) - 2.5).abs() < 1e-15);
        assert!(median(&[]).is_nan());
    }

    #[test]
    fn the_median_of_many_is_that_of_all() {
        let spread = |i: usize| ((i * 7919) % 104_729) as f64;
        for n in [100usize, 50_000, 100_001] {
            let sorted = |i: usize| i as f64;
            // The same value again and again at even distances.
            let misleading =
                |i: usize| if i.is_multiple_of(n / 4096 + usize::from(n < 4096)) { 9.0 } else { spread(i) };
            let constant = |_: usize| 3.0;
            for value in [&spread as &(dyn Fn(usize) -> f64 + Sync), &sorted, &misleading, &constant] {
                let all: Vec<f64> = (0..n).map(value).collect();
                let of_many = certain(median_of_many(n, value, &to_the_end));
                assert_eq!(of_many.to_bits(), median(&all).to_bits());
                let mut sorted = all;
                sorted.sort_unstable_by(f64::total_cmp);
                for count in [1, 2, n / 3, n / 2 + 1, n - 1] {
                    let of_smallest = certain(median_of_smallest(n, count, value, &to_the_end));
                    assert_eq!(of_smallest.to_bits(), median(&sorted[..count]).to_bits());
                }
            }
        }
    }

    #[test]
    fn the_middle_knows_the_medians_that_it_holds_and_no_others() {
        let values: Vec<f64> = (0..40_000).map(|i| f64::from((i * 7919) % 20_011)).collect();
        let mut sorted = values.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let middle = certain(Middle::of(values.len(), |i| values[i], 9_000.0..=10_000.0, 19_000.0, &to_the_end));
        assert_eq!(middle.tail().len(), values.iter().filter(|v| **v >= middle.tail_from()).count());
        assert!(middle.tail().iter().all(|v| *v >= 19_000.0));
        let mut known = 0;
        for count in (1..values.len()).step_by(97) {
            let wanted = [(count - 1) / 2, count / 2].map(|rank| sorted[rank]);
            let inside = wanted.iter().all(|v| (9_000.0..=10_000.0).contains(v));
            let got = certain(middle.median_of_smallest(count, &to_the_end));
            assert_eq!(got.map(f64::to_bits), inside.then(|| mean_of_two(wanted[0], wanted[1]).to_bits()), "{count}");
            known += usize::from(inside);
        }
        assert_eq!(certain(middle.median_of_smallest(0, &to_the_end)), None);
        assert!(known > 30);
    }

    #[test]
    fn the_mad_of_a_known_sample() {
        // |x - 2| = 1 1 0 0 2 4 7 for 1 1 2 2 4 6 9: median 1 (the textbook example of the MAD).
        let mut x = [1.0, 1.0, 2.0, 2.0, 4.0, 6.0, 9.0];
        assert!((mad_scale_in_place(&mut x, 2.0) - MAD_TO_SIGMA).abs() < 1e-15);
    }
}
