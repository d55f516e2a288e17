//! The nominal interval of a record.

use rayon::prelude::*;

/// Steps of which two are known between which the middle ones lie, almost surely.
const SAMPLE: usize = 4096;
/// Steps that one piece of parallel work counts.
const PIECE: usize = 1 << 16;

/// The median of the steps between neighbours of `t`; NaN with fewer than two. An even count takes the mean of the two
/// middle ones.
pub(super) fn nominal_interval(t: &[f64]) -> f64 {
    let n = t.len().saturating_sub(1);
    let step = |i: usize| t[i + 1] - t[i];
    if n == 0 {
        return f64::NAN;
    }
    let middle = [n / 2, (n - 1) / 2];
    let [upper, lower] = (n > 8 * SAMPLE)
        .then(|| Counted::of(n, step))
        .and_then(|mut counted| Some([counted.at(middle[0])?, counted.at(middle[1])?]))
        .unwrap_or_else(|| {
            let mut steps: Vec<f64> = (0..n).map(step).collect();
            middle.map(|rank| *steps.select_nth_unstable_by(rank, f64::total_cmp).1)
        });
    if n.is_multiple_of(2) { f64::midpoint(lower, upper) } else { upper }
}

/// Values counted around two of them, and those between. Nearly all steps of a record are one of very few values, so
/// those equal to either are counted and not kept.
struct Counted {
    low: f64,
    high: f64,
    below: usize,
    at_low: usize,
    between: Vec<f64>,
    at_high: usize,
}

impl Counted {
    fn of(n: usize, value: impl Fn(usize) -> f64 + Sync) -> Self {
        let mut sample: Vec<f64> = (0..SAMPLE).map(|i| value(i * (n / SAMPLE))).collect();
        sample.sort_unstable_by(f64::total_cmp);
        let (low, high) = (sample[SAMPLE / 2 - SAMPLE / 20], sample[SAMPLE / 2 + SAMPLE / 20]);
        let none = || Self { low, high, below: 0, at_low: 0, between: Vec::new(), at_high: 0 };
        let piece = |piece: usize| {
            let mut counted = none();
            for value in (piece * PIECE..n.min((piece + 1) * PIECE)).map(&value) {
                counted.below += usize::from(value < low);
                counted.at_low += usize::from(value == low);
                // Where both are one value, it is counted once.
                counted.at_high += usize::from(value == high && high > low);
                if value > low && value < high {
                    counted.between.push(value);
                }
            }
            counted
        };
        (0..n.div_ceil(PIECE)).into_par_iter().map(piece).reduce(none, Self::and)
    }

    fn and(mut self, other: Self) -> Self {
        self.below += other.below;
        self.at_low += other.at_low;
        self.at_high += other.at_high;
        self.between.extend(other.between);
        self
    }

    /// The value of this rank, from 0; none when it is not among those that were counted.
    fn at(&mut self, rank: usize) -> Option<f64> {
        let rank = rank.checked_sub(self.below)?;
        let Some(rank) = rank.checked_sub(self.at_low) else { return Some(self.low) };
        if rank < self.between.len() {
            return Some(*self.between.select_nth_unstable_by(rank, f64::total_cmp).1);
        }
        (rank - self.between.len() < self.at_high).then_some(self.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By sorting all steps.
    fn plain(t: &[f64]) -> f64 {
        let mut steps: Vec<f64> = t.windows(2).map(|w| w[1] - w[0]).collect();
        steps.sort_by(f64::total_cmp);
        let n = steps.len();
        if n.is_multiple_of(2) { f64::midpoint(steps[n / 2 - 1], steps[n / 2]) } else { steps[n / 2] }
    }

    #[test]
    fn long_records_have_the_interval_that_sorting_gives() {
        let mut state = 7_u64;
        let mut random = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        for n in [2, 3, 40_000, 40_001, 100_003] {
            let even: Vec<f64> = (0..n).map(|i| i as f64 * 0.1).collect();
            let whole: Vec<f64> = (0..n).map(f64::from).collect();
            let mut t = 0.0;
            let mut wander = |step: &mut dyn FnMut() -> f64| -> Vec<f64> {
                (0..n)
                    .map(|_| {
                        t += step();
                        t
                    })
                    .collect()
            };
            let jitter = wander(&mut || 0.05 + random());
            let two = wander(&mut || if random() < 0.5 { 1.0 } else { 2.0 });
            // Long stretches of one step: a sample of them all the same.
            let mut count = 0;
            let stretches = wander(&mut || {
                count += 1;
                if count % 5000 < 2600 { 1.0 } else { 3.0 }
            });
            for t in [even, whole, jitter, two, stretches] {
                assert_eq!(nominal_interval(&t).to_bits(), plain(&t).to_bits(), "{n}");
            }
        }
        assert!(nominal_interval(&[]).is_nan() && nominal_interval(&[1.0]).is_nan());
    }
}
