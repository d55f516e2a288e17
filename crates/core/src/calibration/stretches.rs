//! Stretches without a gap, by the steps of the neighbourhood: a record may change its rate.

use std::ops::Range;

use crate::math::order::quantile_of_many;
use crate::math::pieces::{self, certain, to_the_end};

/// Steps on either side that say what is usual here.
const NEAR: usize = 12;

/// The stretches of `t` (increasing) between gaps: steps in which more than `max_gap` samples are lost by the steps
/// around them; none: never.
#[must_use]
pub fn stretches(t: &[f64], max_gap: Option<usize>) -> Vec<Range<usize>> {
    let Some(max_gap) = max_gap else {
        return if t.is_empty() { Vec::new() } else { std::iter::once(0..t.len()).collect() };
    };
    #[expect(clippy::cast_precision_loss, reason = "at most a million")]
    let gap = max_gap as f64 + 1.5;
    let steps = t.len().saturating_sub(1);
    let gaps = |piece: Range<usize>| piece.filter(|&i| is_gap(t, i, gap)).collect::<Vec<usize>>();
    let (mut all, mut start) = (Vec::new(), 0);
    for i in certain(pieces::map(steps, &to_the_end, gaps)).into_iter().flatten() {
        all.push(start..i + 1);
        start = i + 1;
    }
    if start < t.len() {
        all.push(start..t.len());
    }
    all
}

/// True where the step from `t[i]` is more than `gap` times the usual one around it.
fn is_gap(t: &[f64], i: usize, gap: f64) -> bool {
    let step = |i: usize| t[i + 1] - t[i];
    let steps = t.len() - 1;
    let near = || (i.saturating_sub(NEAR)..i).chain(i + 1..steps.min(i + 1 + NEAR)).map(step);
    let dt = step(i);
    if (NEAR..steps.saturating_sub(NEAR)).contains(&i) {
        // Most steps are no longer than the one before or after.
        let beside = dt <= step(i - 1) || dt <= step(i + 1);
        if beside && dt <= gap * step(i - NEAR).min(step(i + NEAR)) {
            return false;
        }
    }
    let ends = [near().next(), near().next_back()].into_iter().flatten().fold(f64::INFINITY, f64::min);
    if dt <= gap * ends && near().any(|other| dt <= other) && near().nth(1).is_some() {
        return false;
    }
    let mut around: Vec<f64> = near().collect();
    !around.is_empty() && dt > gap * super::quantile(&mut around, 0.75)
}

/// The nominal interval of a stretch: three quarters of its steps are no longer, so that a record of two rates, or of
/// samples in bursts, has lost nothing between them. NaN with fewer than two samples.
#[must_use]
pub fn local_interval(t: &[f64]) -> f64 {
    certain(quantile_of_many(t.len().saturating_sub(1), 0.75, |i| t[i + 1] - t[i], &to_the_end))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By looking at the steps around each of them.
    fn plain(t: &[f64], gap: f64) -> Vec<usize> {
        let step: Vec<f64> = t.windows(2).map(|w| w[1] - w[0]).collect();
        let is_gap = |i: &usize| {
            let mut near = step[i.saturating_sub(NEAR)..*i].to_vec();
            near.extend_from_slice(&step[i + 1..step.len().min(i + 1 + NEAR)]);
            !near.is_empty() && step[*i] > gap * super::super::quantile(&mut near, 0.75)
        };
        (0..step.len()).filter(is_gap).collect()
    }

    #[test]
    fn gaps_and_intervals_are_those_of_the_plain_rule() {
        let mut random = crate::math::random::Random::new(5);
        for n in [2, 3, 5, 40, 3000] {
            let mut now = 0.0;
            let mut step = |_| {
                let usual = if random.uniform() < 0.5 { 0.1 } else { 0.1 * random.uniform() + 0.05 };
                now += if random.uniform() < 0.05 { 0.9 * random.uniform() } else { usual };
                now
            };
            let t: Vec<f64> = (0..n).map(&mut step).collect();
            let cuts: Vec<usize> = stretches(&t, Some(2)).iter().skip(1).map(|s| s.start - 1).collect();
            // The quick rule takes no step for a gap that has a longer one beside it and ends as long around it.
            let plain = plain(&t, 3.5);
            assert!(cuts.iter().all(|cut| plain.contains(cut)), "{n}: {cuts:?} {plain:?}");
            assert!(cuts.len() * 10 >= plain.len() * 9, "{n}: {cuts:?} {plain:?}");
            let mut steps: Vec<f64> = t.windows(2).map(|w| w[1] - w[0]).collect();
            assert_eq!(local_interval(&t).to_bits(), super::super::quantile(&mut steps, 0.75).to_bits());
        }
        assert!(local_interval(&[1.0]).is_nan());
    }

    #[test]
    fn a_change_of_rate_is_no_gap_and_a_long_step_is_one() {
        let mut t: Vec<f64> = (0..50).map(|i| 0.05 * f64::from(i)).collect();
        t.extend((0..50).map(|i| 3.45 + f64::from(i)));
        assert_eq!(stretches(&t, Some(5)).as_slice(), std::slice::from_ref(&(0..100)));
        t.iter_mut().skip(80).for_each(|t| *t += 20.0);
        assert_eq!(stretches(&t, Some(5)), [0..80, 80..100]);
    }
}
