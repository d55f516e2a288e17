//! Stretches of samples that cannot be reached from the samples around them: what a test of speed finds.

use std::ops::Range;

use crate::stop::{Stop, Stopped};

/// A stretch of samples that cannot be reached.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Island {
    /// Its samples.
    pub(super) range: Range<usize>,
    /// True when the samples on its two sides can be reached from each other, so that it alone is in the way. False at
    /// the ends of the record and where the record really changes.
    pub(super) both_sides: bool,
}

/// The islands among `n` samples, ascending. `too_far(a, b)` says that sample `b` cannot be reached from sample `a`
/// before it. The longest stretch without such a step is taken for good; from there both ways a stretch is good when
/// it can be reached from the last good one, or when it is longer than `longest`: then the record really changes, and
/// only its first sample is an island.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub(super) fn islands(
    n: usize,
    longest: usize,
    too_far: impl Fn(usize, usize) -> bool,
    stop: &Stop,
) -> Result<Vec<Island>, Stopped> {
    let mut stretches: Vec<Range<usize>> = Vec::new();
    let mut start = 0;
    for i in 1..n {
        stop.check_at(i)?;
        if too_far(i - 1, i) {
            stretches.push(start..i);
            start = i;
        }
    }
    if stretches.is_empty() {
        return Ok(Vec::new());
    }
    stretches.push(start..n);
    let good = (0..stretches.len()).max_by_key(|&k| (stretches[k].len(), stretches.len() - k)).unwrap_or(0);
    let mut found = Vec::new();
    let mut coast = Coast { last: &stretches[good], pending: Vec::new(), longest };
    for stretch in &stretches[good + 1..] {
        let reached = !too_far(coast.last.end - 1, stretch.start);
        coast.meet(stretch, stretch.start, reached, &mut found);
    }
    coast.end(&mut found);
    let mut coast = Coast { last: &stretches[good], pending: Vec::new(), longest };
    for stretch in stretches[..good].iter().rev() {
        let reached = !too_far(stretch.end - 1, coast.last.start);
        coast.meet(stretch, coast.last.start, reached, &mut found);
    }
    coast.end(&mut found);
    found.sort_by_key(|island| island.range.start);
    Ok(found)
}

/// The last good stretch on the way through the record, and what could not be reached since.
struct Coast<'a> {
    last: &'a Range<usize>,
    pending: Vec<Range<usize>>,
    longest: usize,
}

impl<'a> Coast<'a> {
    /// Meets the next stretch. Where the record really changes, `first` is the first sample after the change.
    fn meet(&mut self, stretch: &'a Range<usize>, first: usize, reached: bool, found: &mut Vec<Island>) {
        let changes = !reached && stretch.len() > self.longest;
        if !reached && !changes {
            self.pending.push(stretch.clone());
            return;
        }
        let pending = self.pending.drain(..);
        found.extend(pending.map(|range| Island { range, both_sides: reached }));
        if changes {
            found.push(Island { range: first..first + 1, both_sides: false });
        }
        self.last = stretch;
    }

    /// Nothing follows: what is pending has one side only.
    fn end(&mut self, found: &mut Vec<Island>) {
        found.extend(self.pending.drain(..).map(|range| Island { range, both_sides: false }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Islands of values that cannot change by more than 1 from one sample to the next.
    fn of(y: &[f64], longest: usize) -> Vec<(Range<usize>, bool)> {
        #[expect(clippy::cast_precision_loss, reason = "a few samples")]
        let too_far = |a: usize, b: usize| (y[b] - y[a]).abs() > (b - a) as f64;
        let found = islands(y.len(), longest, too_far, &Stop::never()).unwrap();
        found.into_iter().map(|i| (i.range, i.both_sides)).collect()
    }

    #[test]
    fn a_spike_and_a_patch_lie_between_samples_that_reach_each_other() {
        let mut y = vec![0.0; 30];
        y[7] = 50.0;
        (15..18).for_each(|i| y[i] = -40.0);
        assert_eq!(of(&y, 10), [(7..8, true), (15..18, true)]);
        assert!(of(&[0.0, 0.5, 1.0, 1.5], 10).is_empty());
    }

    #[test]
    fn a_patch_that_jumps_about_is_one_after_the_other() {
        let mut y = vec![0.0; 30];
        (y[9], y[10], y[11]) = (80.0, -70.0, 60.0);
        assert_eq!(of(&y, 10), [(9..10, true), (10..11, true), (11..12, true)]);
    }

    #[test]
    fn at_the_ends_and_at_a_real_change_there_is_one_side_only() {
        let mut y = vec![0.0; 40];
        (y[0], y[1], y[39]) = (90.0, 90.0, -90.0);
        assert_eq!(of(&y, 10), [(0..2, false), (39..40, false)]);
        let mut step = vec![0.0; 40];
        (25..40).for_each(|i| step[i] = 500.0);
        assert_eq!(of(&step, 10), [(25..26, false)], "the first sample after the change");
        let mut step = vec![0.0; 40];
        (0..12).for_each(|i| step[i] = 500.0);
        assert_eq!(of(&step, 10), [(12..13, false)], "the same where the part before is the shorter one");
    }
}
