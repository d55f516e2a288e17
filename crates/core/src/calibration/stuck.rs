//! Stretches over which a sensor was stuck: the same value for longer than the record's own held values explain.
//!
//! A target at rest, a limit of the instrument and a record that holds its values all repeat a value, too. They are
//! told from a stuck sensor by what surrounds the stretch: a stuck sensor stops in the middle of movement and goes on
//! somewhere else.

use std::ops::Range;

use crate::math::order::median_in_place;

/// Stretches in which a sensor was stuck, as far as the record shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stuck {
    /// The longest run of equal values that the record has elsewhere.
    pub longest_own: usize,
    /// A limit of length that parts those runs from the stretches.
    pub limit: usize,
    /// The stretches, in positions, ascending.
    pub stretches: Vec<Range<usize>>,
    /// True where the record leaves no doubt: it moves right before and right after each of them.
    pub certain: bool,
}

/// A stuck stretch has at least this many samples …
const LEAST: usize = 20;
/// … and this many times as many as the longest other run.
const LONGER: usize = 8;
/// More stretches than this are a habit of the record.
const MOST: usize = 12;
/// Samples on either side of a stretch that are looked at.
const AROUND: usize = 20;

/// The stuck stretches of `y` (finite values in the order of the record); none where it has none. Linear in the number
/// of samples.
#[must_use]
pub fn stuck(y: &[f64]) -> Option<Stuck> {
    let long = longest_runs(y);
    // The stretches end where the length falls by the factor.
    let parts = (1..long.len()).rev().find(|&k| long[k - 1].len() >= LEAST.max(LONGER * long[k].len()))?;
    let longest_own = long[parts].len();
    let mut stretches = long[..parts].to_vec();
    stretches.sort_by_key(|s| s.start);
    let (low, high) = y.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    let held = |s: &Range<usize>| y[s.start];
    // At rest and at a limit a value is held for good reason.
    #[expect(clippy::float_cmp, reason = "the ends of the record are two of its own values")]
    stretches.retain(|s| held(s) != 0.0 && held(s) != low && held(s) != high);
    let shortest = stretches.iter().map(Range::len).min()?;
    let certain = stretches.iter().all(|s| moves_around(y, s));
    // Between the two lengths, nearer to the record's own.
    let limit = (2 * longest_own).max(LEAST - 1).min(shortest - 1);
    Some(Stuck { longest_own, limit, stretches, certain })
}

/// The longest runs of equal values, the longest first: one more than can be stretches.
fn longest_runs(y: &[f64]) -> Vec<Range<usize>> {
    let mut long: Vec<Range<usize>> = Vec::with_capacity(MOST + 2);
    let mut start = 0;
    for i in 1..=y.len() {
        #[expect(clippy::float_cmp, reason = "exact repetition is what is looked for")]
        if i < y.len() && y[i] == y[start] {
            continue;
        }
        let run = start..i;
        start = i;
        if long.len() > MOST && long[MOST].len() >= run.len() {
            continue;
        }
        let place = long.partition_point(|l| l.len() >= run.len());
        if place <= MOST {
            long.insert(place, run);
            long.truncate(MOST + 1);
        }
    }
    long
}

/// True when the record moves on both sides of a stretch, up to it and from it on: at rest it would slow down first.
fn moves_around(y: &[f64], stretch: &Range<usize>) -> bool {
    let steps = |range: Range<usize>| range.map(|i| (y[i] - y[i - 1]).abs()).collect::<Vec<f64>>();
    let before = steps(stretch.start.saturating_sub(AROUND).max(1)..(stretch.start + 1).min(y.len()));
    let after = steps(stretch.end..(stretch.end + AROUND).min(y.len()));
    let moves = |steps: &[f64], nearest: Option<&f64>| {
        let still = steps.iter().filter(|s| **s == 0.0).count();
        let usual = median_in_place(&mut steps.to_vec());
        steps.len() >= AROUND / 2 && still * 4 <= steps.len() && nearest.is_some_and(|n| *n >= usual / 4.0)
    };
    moves(&before, before.last()) && moves(&after, after.first())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wave with noise.
    fn wave(n: usize) -> Vec<f64> {
        let noise = |i: usize| ((i * 7919) % 101) as f64 / 50.0;
        (0..n).map(|i| ((100.0 + 18.0 * (i as f64 * 0.02).sin() + noise(i)) * 100.0).round() / 100.0).collect()
    }

    #[test]
    fn a_frozen_stretch_is_certain_and_the_limit_parts_it_from_the_records_own_runs() {
        let mut y = wave(600);
        let held = y[150];
        y[151..260].fill(held);
        let stuck = stuck(&y).unwrap();
        assert_eq!((stuck.stretches.as_slice(), stuck.certain), (std::slice::from_ref(&(150..260)), true));
        assert!(stuck.limit > stuck.longest_own && stuck.limit < 110, "{stuck:?}");
    }

    #[test]
    fn several_stretches_are_found_together() {
        let mut y = wave(1000);
        for start in [100, 400, 700] {
            let held = y[start];
            y[start + 1..start + 40].fill(held);
        }
        assert_eq!(stuck(&y).map(|s| s.stretches.len()), Some(3));
    }

    #[test]
    fn rest_limits_and_held_records_are_not_stuck() {
        let held: Vec<f64> = wave(100).into_iter().flat_map(|v| [v; 10]).collect();
        assert!(stuck(&held).is_none());
        let saturated: Vec<f64> = wave(600).iter().map(|v| v.min(108.0)).collect();
        assert!(stuck(&saturated).is_none());
        // A speed that comes to rest, and the way that it covers.
        let speed: Vec<f64> = (0..600).map(|i| (f64::from(i - 300).abs() - 100.0).max(0.0) / 8.0).collect();
        assert!(stuck(&speed).is_none());
        let way: Vec<f64> = speed.iter().scan(7.0, |at, v| Some(std::mem::replace(at, *at + v))).collect();
        assert!(stuck(&way).is_none_or(|s| !s.certain));
        let quantised: Vec<f64> = (0..3000).map(|i| (f64::from(i) * 0.01).sin().mul_add(20.0, 0.0).round()).collect();
        assert!(stuck(&quantised).is_none());
        assert!(stuck(&[]).is_none() && stuck(&[3.0; 50]).is_none());
    }

    #[test]
    fn a_record_that_ends_stuck_is_doubtful() {
        let mut y = wave(600);
        let held = y[399];
        y[400..].fill(held);
        assert!(stuck(&y).is_some_and(|s| !s.certain));
    }
}
