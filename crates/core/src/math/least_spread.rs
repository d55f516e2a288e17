//! How little a large part of many values can be spread, whichever part it is: a bound that needs no order.

use super::pieces::{self, Check};

/// Parts into which the range of the values is cut.
const BINS: usize = 1024;

/// A lower bound on the sum of the squares about their own mean of any `keep` of `values`, which are best counted
/// within `reach` of `center`. It is close where `keep` is many and the values are not all alike, and 0 where
/// nothing can be said. None of the values may be NaN.
///
/// Why it is one: to move values that lie further out to the ends of the range brings no two of them further apart;
/// to move each to the middle of its bin changes the root of the sum by at most the root of `keep` half bins; the
/// part of least spread is an unbroken stretch in the order of the values; and such a stretch is spread at least as
/// much as the bins that lie wholly in it.
///
/// # Errors
/// What `check` gives, which is asked before each piece of work.
pub fn least_squares_of_any<E: Send>(
    values: &[f64],
    keep: usize,
    (center, reach): (f64, f64),
    check: &impl Check<E>,
) -> Result<f64, E> {
    let (start, width) = (center - reach, 2.0 * reach / BINS as f64);
    if keep < 2 || keep > values.len() || !start.is_finite() || !width.is_finite() || width <= 0.0 {
        return Ok(0.0);
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast keeps within 0..")]
    let bin = |v: f64| (((v - start) / width) as usize).min(BINS - 1);
    let counted = pieces::map(values.len(), check, |piece| {
        let mut counts = [0_u32; BINS];
        values[piece].iter().for_each(|v| counts[bin(*v)] += 1);
        counts
    })?;
    let mut counts = [0_u64; BINS];
    for piece in counted {
        counts.iter_mut().zip(piece).for_each(|(all, own)| *all += u64::from(own));
    }
    let about_half = 0.51 * (keep as f64).sqrt();
    let root = (least_of_stretches(&counts, keep as u64).sqrt() - about_half) * width;
    Ok(if root > 0.0 { root * root } else { 0.0 })
}

/// Counts and sums of the numbers of the bins before each bin.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    count: u64,
    first: u64,
    second: u64,
}

/// The least sum of squares, in bins, of what is sure to lie in a stretch of `keep` values.
fn least_of_stretches(counts: &[u64], keep: u64) -> f64 {
    let mut before = vec![Sums::default()];
    for (bin, &count) in (0_u64..).zip(counts) {
        let Sums { count: n, first, second } = before[before.len() - 1];
        before.push(Sums { count: n + count, first: first + count * bin, second: second + count * bin * bin });
    }
    let mut least = f64::INFINITY;
    let mut end = 0;
    for start in 0..counts.len() {
        // The stretch begins in this bin, and ends in `end - 1` at the earliest.
        while end < counts.len() && before[end].count < before[start].count + keep {
            end += 1;
        }
        if before[end].count < before[start].count + keep {
            break;
        }
        if end >= start + 2 {
            least = least.min(squares(before[start + 1], before[end - 1]));
        } else {
            return 0.0;
        }
    }
    if least.is_finite() { least } else { 0.0 }
}

/// The sum of squares about their mean of the bins between two.
fn squares(from: Sums, to: Sums) -> f64 {
    let [n, first, second] = [to.count - from.count, to.first - from.first, to.second - from.second].map(u128::from);
    // Whole numbers: nothing is lost in the difference.
    if n == 0 { 0.0 } else { (second * n - first * first) as f64 / n as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::moments::Moments;
    use crate::math::pieces::{certain, to_the_end};

    /// The least of all stretches of the sorted values, which is the least of all parts.
    fn plain(values: &[f64], keep: usize) -> f64 {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        sorted.windows(keep).map(|w| Moments::of(w).squares).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn it_is_below_the_least_spread_of_any_part_and_close_to_it() {
        let wave = |i: usize| (i as f64 * 12.9898).sin() + (i as f64 * 78.233).cos();
        // Of values in coarse steps much is lost with the bins in which a stretch begins and ends.
        let shapes: [(bool, &dyn Fn(usize) -> f64); 4] = [
            (true, &wave),
            (true, &|i| wave(i) + if i.is_multiple_of(20) { 40.0 } else { 0.0 }),
            (true, &|i| wave(i).powi(3)),
            (false, &|i| (wave(i) * 3.0).round()),
        ];
        for (fine, shape) in shapes {
            let values: Vec<f64> = (0..1500).map(shape).collect();
            for keep in [750, 975, 1400, 1500] {
                let least = plain(&values, keep);
                for around in [(0.0, 2.0), (0.3, 4.0), (-50.0, 300.0)] {
                    let bound = certain(least_squares_of_any(&values, keep, around, &to_the_end));
                    assert!(bound <= least, "{bound} {least} {keep} {around:?}");
                    let close = fine && around.1 < 5.0 && keep < 1400;
                    assert!(!close || bound > 0.5 * least, "{bound} {least} {keep} {around:?}");
                }
            }
        }
    }

    #[test]
    fn of_equal_values_of_few_and_of_none_nothing_is_said() {
        for (values, keep) in [(vec![5.0; 900], 500), (vec![1.0, 2.0], 1), (vec![1.0, 2.0], 3), (Vec::new(), 2)] {
            let bound = certain(least_squares_of_any(&values, keep, (4.0, 2.0), &to_the_end));
            assert!(bound.abs() < 1e-300, "{bound}");
        }
        let unbounded = certain(least_squares_of_any(&[1.0, 2.0, 4.0], 2, (0.0, f64::INFINITY), &to_the_end));
        assert!(unbounded.abs() < 1e-300);
    }
}
