//! Stretches without a gap, by the steps of the neighbourhood: a record may change its rate.

use std::ops::Range;

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
    let step: Vec<f64> = t.windows(2).map(|w| w[1] - w[0]).collect();
    let (mut all, mut start) = (Vec::new(), 0);
    let mut near = Vec::with_capacity(2 * NEAR);
    for (i, dt) in step.iter().enumerate() {
        near.clear();
        near.extend_from_slice(&step[i.saturating_sub(NEAR)..i]);
        near.extend_from_slice(&step[i + 1..step.len().min(i + 1 + NEAR)]);
        // Most steps are as long as one of their neighbours.
        if near.iter().any(|other| dt <= other) && near.len() > 1 && *dt <= gap * near[0].min(near[near.len() - 1]) {
            continue;
        }
        if !near.is_empty() && *dt > gap * super::quantile(&mut near, 0.75) {
            all.push(start..i + 1);
            start = i + 1;
        }
    }
    if start < t.len() {
        all.push(start..t.len());
    }
    all
}

/// The nominal interval of a stretch: three quarters of its steps are no longer, so that a record of two rates, or of
/// samples in bursts, has lost nothing between them. NaN with fewer than two samples.
#[must_use]
pub fn local_interval(t: &[f64]) -> f64 {
    let mut steps: Vec<f64> = t.windows(2).map(|w| w[1] - w[0]).collect();
    if steps.is_empty() { f64::NAN } else { super::quantile(&mut steps, 0.75) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_of_rate_is_no_gap_and_a_long_step_is_one() {
        let mut t: Vec<f64> = (0..50).map(|i| 0.05 * f64::from(i)).collect();
        t.extend((0..50).map(|i| 3.45 + f64::from(i)));
        assert_eq!(stretches(&t, Some(5)).as_slice(), std::slice::from_ref(&(0..100)));
        t.iter_mut().skip(80).for_each(|t| *t += 20.0);
        assert_eq!(stretches(&t, Some(5)), [0..80, 80..100]);
    }
}
