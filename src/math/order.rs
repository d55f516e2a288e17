//! Order statistics: medians and the median absolute deviation. An even count takes the mean of the two middle
//! values; an empty slice gives NaN. Values must not be NaN.

use std::ops::RangeInclusive;

use rayon::prelude::*;

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
/// threads.
#[must_use]
pub fn median_of_many(n: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    median_of_smallest(n, n, value)
}

/// The median of the `count <= n` smallest of `value(0 .. n)`, as [`median_of_many`] finds it.
#[must_use]
pub fn median_of_smallest(n: usize, count: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    const SAMPLE: usize = 4096;
    const CHUNK: usize = 16_384;
    if count == 0 {
        return f64::NAN;
    }
    if n < 8 * SAMPLE {
        return middle_of_smallest(&mut (0..n).map(value).collect::<Vec<f64>>(), count / 2, !count.is_multiple_of(2));
    }
    // A sample of the values tells two between which the middle ones lie, almost surely: only those are collected.
    let mut sample: Vec<f64> = (0..SAMPLE).map(|i| value(i * (n / SAMPLE))).collect();
    sample.sort_unstable_by(f64::total_cmp);
    let likely = count / 2 / (n / SAMPLE).max(1);
    let (low, high) = (sample[likely.saturating_sub(SAMPLE / 25)], sample[(likely + SAMPLE / 25).min(SAMPLE - 1)]);
    let pieces: Vec<(usize, Vec<f64>)> = (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            // Every value is written down, and the next over it where it does not count: no branch to guess.
            let (mut below, mut kept, mut between) = (0, 0, vec![0.0; CHUNK]);
            for v in (chunk * CHUNK..n.min((chunk + 1) * CHUNK)).map(&value) {
                below += usize::from(v < low);
                between[kept] = v;
                kept += usize::from(v >= low && v <= high);
            }
            between.truncate(kept);
            (below, between)
        })
        .collect();
    let below: usize = pieces.iter().map(|p| p.0).sum();
    let mut between: Vec<f64> = pieces.into_iter().flat_map(|p| p.1).collect();
    // Both middle values of an even count must be among them.
    let (middle, odd) = (count / 2, !count.is_multiple_of(2));
    if below + 1 > middle || below + between.len() <= middle {
        return middle_of_smallest(&mut (0..n).map(value).collect::<Vec<f64>>(), middle, odd);
    }
    middle_of_smallest(&mut between, middle - below, odd)
}

/// The value of rank `middle` (from 0), or its mean with the one of the rank before.
fn middle_of_smallest(values: &mut [f64], middle: usize, odd: bool) -> f64 {
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    if odd { upper } else { mean_of_two(below.iter().copied().fold(f64::NEG_INFINITY, f64::max), upper) }
}

/// Those of many values that lie between two limits, in order: for medians that are asked for again and again of ever
/// other parts.
#[derive(Debug, Clone)]
pub struct Middle {
    below: usize,
    sorted: Vec<f64>,
}

impl Middle {
    /// The values within `limits`; none of `values` may be NaN.
    #[must_use]
    pub fn of(values: &[f64], limits: RangeInclusive<f64>) -> Self {
        const CHUNK: usize = 16_384;
        let piece = |values: &[f64]| {
            let below = values.iter().filter(|v| **v < *limits.start()).count();
            (below, values.iter().copied().filter(|v| limits.contains(v)).collect::<Vec<f64>>())
        };
        let pieces: Vec<(usize, Vec<f64>)> = values.par_chunks(CHUNK).map(piece).collect();
        let below = pieces.iter().map(|p| p.0).sum();
        let mut sorted: Vec<f64> = pieces.into_iter().flat_map(|p| p.1).collect();
        sorted.par_sort_unstable_by(f64::total_cmp);
        Self { below, sorted }
    }

    /// The median of the `count` smallest of all values, where what stands in their middle is among these.
    #[must_use]
    pub fn median_of_smallest(&self, count: usize) -> Option<f64> {
        let upper = (count / 2).checked_sub(self.below)?;
        let &high = self.sorted.get(upper)?;
        if count.is_multiple_of(2) {
            Some(mean_of_two(*self.sorted.get(upper.checked_sub(1)?)?, high))
        } else {
            Some(high)
        }
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
            // Periodic with the stride of the sample: it sees one value only, and the wrong one.
            let misleading =
                |i: usize| if i.is_multiple_of(n / 4096 + usize::from(n < 4096)) { 9.0 } else { spread(i) };
            let constant = |_: usize| 3.0;
            for value in [&spread as &(dyn Fn(usize) -> f64 + Sync), &sorted, &misleading, &constant] {
                let all: Vec<f64> = (0..n).map(value).collect();
                assert_eq!(median_of_many(n, value).to_bits(), median(&all).to_bits());
                let mut sorted = all;
                sorted.sort_unstable_by(f64::total_cmp);
                for count in [1, 2, n / 3, n / 2 + 1, n - 1] {
                    assert_eq!(median_of_smallest(n, count, value).to_bits(), median(&sorted[..count]).to_bits());
                }
            }
        }
    }

    #[test]
    fn the_middle_knows_the_medians_that_it_holds_and_no_others() {
        let values: Vec<f64> = (0..40_000).map(|i| f64::from((i * 7919) % 20_011)).collect();
        let mut sorted = values.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let middle = Middle::of(&values, 9_000.0..=10_000.0);
        let mut known = 0;
        for count in (1..values.len()).step_by(97) {
            let wanted = [(count - 1) / 2, count / 2].map(|rank| sorted[rank]);
            let inside = wanted.iter().all(|v| (9_000.0..=10_000.0).contains(v));
            let got = middle.median_of_smallest(count);
            assert_eq!(got.map(f64::to_bits), inside.then(|| mean_of_two(wanted[0], wanted[1]).to_bits()), "{count}");
            known += usize::from(inside);
        }
        assert_eq!(middle.median_of_smallest(0), None);
        assert!(known > 30);
    }

    #[test]
    fn the_mad_of_a_known_sample() {
        // |x - 2| = 1 1 0 0 2 4 7 for 1 1 2 2 4 6 9: median 1 (the textbook example of the MAD).
        let mut x = [1.0, 1.0, 2.0, 2.0, 4.0, 6.0, 9.0];
        assert!((mad_scale_in_place(&mut x, 2.0) - MAD_TO_SIGMA).abs() < 1e-15);
    }
}
