//! Filling missing samples (`fill_gaps`): the repair's own interpolation, or a line for repairs that have none.

use super::{Accepted, Damage, Way, chosen, fill_limit, linear};
use crate::param::Settings;
use crate::stop::{Stop, Stopped};

/// A stretch of missing samples between two neighbouring present ones of the same segment.
#[derive(Debug, Clone, PartialEq)]
pub struct Gap {
    /// Position (in the segment) of the present sample after it; never 0.
    pub before: usize,
    /// Times of the missing samples in seconds, ascending.
    pub at: Vec<f64>,
}

/// A value for each missing sample of each gap; none for a gap that is left open: one without accepted samples on
/// both sides, or inside a run of outliers too long to be repaired. `own`, `expected` and `remove` have nothing to
/// say about a sample that was never measured; the line is used for them.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn fill(
    damage: &Damage<'_>,
    gaps: &[Gap],
    settings: &Settings,
    stop: &Stop,
) -> Result<Vec<Option<Vec<f64>>>, Stopped> {
    if gaps.is_empty() {
        return Ok(Vec::new());
    }
    let interpolate = match chosen(settings).way {
        Way::Interpolate(interpolate) => interpolate,
        Way::Own | Way::Remove | Way::Expected => linear::values,
    };
    let accepted = Accepted::of(damage, stop)?;
    let limit = fill_limit(settings);
    let one = |gap: &Gap| {
        let outliers_before = damage.outliers.partition_point(|&i| i < gap.before);
        if run_around(damage.outliers, outliers_before, gap.before) > limit {
            return None;
        }
        let around = accepted.around(gap.before - outliers_before)?;
        interpolate(&around, &gap.at, settings).filter(|values| values.iter().all(|v| v.is_finite()))
    };
    let looked = |(n, gap): (usize, &Gap)| {
        // A gap costs some microseconds.
        stop.check_at(64 * n)?;
        Ok(one(gap))
    };
    gaps.iter().enumerate().map(looked).collect()
}

/// How many outliers in a row touch the gap before position `at`, `split` of all outliers lying before it.
fn run_around(outliers: &[usize], split: usize, at: usize) -> usize {
    let left = (0..split).rev().zip(1..).take_while(|&(i, back)| outliers[i] + back == at).count();
    let right = (split..outliers.len()).zip(at..).take_while(|&(i, position)| outliers[i] == position).count();
    left + right
}

#[cfg(test)]
mod tests {
    use super::super::{PARAMS, Settings};
    use super::*;

    #[test]
    fn gaps_are_filled_from_accepted_samples_and_left_open_in_long_runs_and_at_ends() {
        // One sample a second of the line 2 t, seconds 4 and 8 missing; 3, 5 wild (a run of two around the gap).
        let t = [0.0, 1.0, 2.0, 3.0, 5.0, 6.0, 7.0, 9.0];
        let y = t.map(|t| if t == 3.0 || t == 5.0 { 99.0 } else { 2.0 * t });
        let nothing = [f64::NAN; 2];
        let damage = Damage { t: &t, y: &y, outliers: &[3, 4], own: &nothing, expected: &nothing };
        let gaps = [Gap { before: 4, at: vec![4.0] }, Gap { before: 7, at: vec![7.5, 8.0] }];
        let mut settings = Settings::defaults(PARAMS);
        assert_eq!(fill(&damage, &gaps, &settings, &Stop::never()).unwrap(), [Some(vec![8.0]), Some(vec![15.0, 16.0])]);
        settings.set_text("repair", "max_fill", "2").unwrap();
        assert_eq!(fill(&damage, &gaps, &settings, &Stop::never()).unwrap(), [Some(vec![8.0]), Some(vec![15.0, 16.0])]);
        settings.set_text("repair", "max_fill", "1").unwrap();
        assert_eq!(fill(&damage, &gaps, &settings, &Stop::never()).unwrap(), [None, Some(vec![15.0, 16.0])]);
        let damage = Damage { outliers: &[7], own: &nothing[..1], expected: &nothing[..1], ..damage };
        assert_eq!(fill(&damage, &gaps[1..], &settings, &Stop::never()).unwrap(), [None]);
    }
}
