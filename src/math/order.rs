//! Order statistics: medians and the median absolute deviation. An even count takes the mean of the two middle
//! values; an empty slice gives NaN. Values must not be NaN.

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
    let middle = values.len() / 2;
    let odd = !values.len().is_multiple_of(2);
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    if odd {
        return upper;
    }
    let lower = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    mean_of_two(lower, upper)
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
    const SAMPLE: usize = 4096;
    const CHUNK: usize = 16_384;
    if n < 8 * SAMPLE {
        return median_in_place(&mut (0..n).map(value).collect::<Vec<f64>>());
    }
    // A sample of the values tells two between which the middle ones lie, almost surely: only those are collected.
    let mut sample: Vec<f64> = (0..SAMPLE).map(|i| value(i * (n / SAMPLE))).collect();
    sample.sort_unstable_by(f64::total_cmp);
    let (low, high) = (sample[SAMPLE / 2 - SAMPLE / 20], sample[SAMPLE / 2 + SAMPLE / 20]);
    let pieces: Vec<(usize, Vec<f64>)> = (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let (mut below, mut between) = (0, Vec::with_capacity(CHUNK / 8));
            for v in (chunk * CHUNK..n.min((chunk + 1) * CHUNK)).map(&value) {
                below += usize::from(v < low);
                if v >= low && v <= high {
                    between.push(v);
                }
            }
            (below, between)
        })
        .collect();
    let below: usize = pieces.iter().map(|p| p.0).sum();
    let mut between: Vec<f64> = pieces.into_iter().flat_map(|p| p.1).collect();
    // Both middle values of an even count must be among them.
    if below + 1 > n / 2 || below + between.len() <= n / 2 {
        return median_in_place(&mut (0..n).map(value).collect::<Vec<f64>>());
    }
    let middle = n / 2 - below;
    let (lower, &mut upper, _) = between.select_nth_unstable_by(middle, f64::total_cmp);
    if !n.is_multiple_of(2) {
        return upper;
    }
    mean_of_two(lower.iter().copied().fold(f64::NEG_INFINITY, f64::max), upper)
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
            }
        }
    }

    #[test]
    fn the_mad_of_a_known_sample() {
        // |x - 2| = 1 1 0 0 2 4 7 for 1 1 2 2 4 6 9: median 1 (the textbook example of the MAD).
        let mut x = [1.0, 1.0, 2.0, 2.0, 4.0, 6.0, 9.0];
        assert!((mad_scale_in_place(&mut x, 2.0) - MAD_TO_SIGMA).abs() < 1e-15);
    }
}
