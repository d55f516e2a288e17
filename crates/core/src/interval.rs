//! The nominal interval of a record.

use crate::math::order::median_of_many;
use crate::math::pieces::{certain, to_the_end};

/// The median of the steps between neighbours of `t`; NaN with fewer than two. An even count takes the mean of the two
/// middle ones.
pub(super) fn nominal_interval(t: &[f64]) -> f64 {
    certain(median_of_many(t.len().saturating_sub(1), |i| t[i + 1] - t[i], &to_the_end))
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
