//! The bridge over a run of outliers: the integral of the rate, put through the good values on both sides. It does not
//! depend on the length of the run, and no wild value enters it.

use crate::math::order::median_in_place;
use crate::method::Damaged;
use crate::stop::{Stop, Stopped};

/// Good values of a side that the bridge rests on: their median holds off what is left of noise.
const PIERS: usize = 5;

/// Where a bridge rests: how far the values of either side lie above the integral of the rate.
#[derive(Debug, Clone, Copy)]
struct Piers {
    before: Option<f64>,
    after: Option<f64>,
}

impl Piers {
    /// What both sides disagree by.
    fn closure(self) -> Option<f64> {
        Some(self.after? - self.before?)
    }
}

/// One value for each outlier; NaN where neither side has a good value.
pub(super) fn repair(damaged: &Damaged<'_>, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let Damaged { segment, judged, outliers, .. } = *damaged;
    let accepted = accepted(damaged);
    let mut values = Vec::with_capacity(outliers.len());
    for (n, run) in outliers.chunk_by(|a, b| a + 1 == *b).enumerate() {
        stop.check_at(16 * n)?;
        let Piers { before, after } = piers(damaged, &accepted, run);
        let ends = [run[0].saturating_sub(1), (run[run.len() - 1] + 1).min(segment.len() - 1)].map(|i| segment.t[i]);
        values.extend(run.iter().map(|&i| {
            let share = (segment.t[i] - ends[0]) / (ends[1] - ends[0]);
            let above = match (before, after) {
                (Some(before), Some(after)) => before + share * (after - before),
                (Some(one), None) | (None, Some(one)) => one,
                (None, None) => f64::NAN,
            };
            judged.own.get(i).copied().unwrap_or(f64::NAN) + above
        }));
    }
    Ok(values)
}

/// The largest closure error of the bridges over runs of two and more, in words; none without such a run.
pub(super) fn closure(damaged: &Damaged<'_>) -> Option<String> {
    let accepted = accepted(damaged);
    let runs = damaged.outliers.chunk_by(|a, b| a + 1 == *b).filter(|run| run.len() > 1);
    let closed = runs.filter_map(|run| Some((run.len(), piers(damaged, &accepted, run).closure()?.abs())));
    let (length, error) = closed.max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(format!("the rate bridges runs with a closure error of {error:.3e} at most (a run of {length})"))
}

fn accepted(damaged: &Damaged<'_>) -> Vec<bool> {
    let mut accepted = vec![true; damaged.segment.len()];
    damaged.outliers.iter().for_each(|&i| accepted[i] = false);
    accepted
}

fn piers(damaged: &Damaged<'_>, accepted: &[bool], run: &[usize]) -> Piers {
    let above = |i: usize| damaged.segment.y[i] - damaged.judged.own.get(i).copied().unwrap_or(f64::NAN);
    let middle = |places: &mut dyn Iterator<Item = usize>| {
        let mut near: Vec<f64> =
            places.filter(|&i| accepted[i]).map(above).filter(|v| v.is_finite()).take(PIERS).collect();
        (!near.is_empty()).then(|| median_in_place(&mut near))
    };
    let (first, last) = (run[0], run[run.len() - 1]);
    Piers { before: middle(&mut (0..first).rev()), after: middle(&mut (last + 1..damaged.segment.len())) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::matched::Matched;
    use crate::method::{Judged, Method, Segment};
    use crate::param::Settings;

    /// A curve whose rate is known, with noise of 0.1 and a run of wild points longer than the window is half.
    #[test]
    fn a_bridge_does_not_depend_on_the_wild_values_or_the_length_of_their_run() {
        let t: Vec<f64> = (0..300).map(f64::from).collect();
        let curve = |t: f64| 1e6 + 50.0 * (0.02 * t).sin() * 100.0;
        let noise = |i: usize| ((i * 7919 % 101) as f64 / 50.0 - 1.0) * 0.1;
        let run: Vec<usize> = (100..220).collect();
        let y: Vec<f64> =
            (0..300).map(|i| curve(t[i]) + noise(i) + if run.contains(&i) { 4.94e13 } else { 0.0 }).collect();
        let own: Vec<f64> = t.iter().map(|&t| curve(t) - 123.0).collect();
        let judged = Judged { own, expected: y.clone(), ..Judged::default() };
        let segment =
            Segment { t: &t, y: &y, interval: 1.0, sigma: 1.0, floor: 0.0, floors: &[], objections: &[], rate: None };
        let settings = Settings::defaults(Matched.about().params);
        let damaged = Damaged { segment: &segment, settings: &settings, judged: judged.part(0..300), outliers: &run };
        let repaired = repair(&damaged, &Stop::never()).unwrap();
        assert!(run.iter().zip(&repaired).all(|(&i, v)| (v - curve(t[i])).abs() < 0.2));
        assert!(closure(&damaged).unwrap().contains("a run of 120"));
        // At the start of a segment one side carries it.
        let start: Vec<usize> = (0..20).collect();
        let damaged = Damaged { outliers: &start, ..damaged };
        let repaired = repair(&damaged, &Stop::never()).unwrap();
        assert!(
            start.iter().zip(&repaired).all(|(&i, v)| (v - curve(t[i])).abs() < 0.2) && closure(&damaged).is_none()
        );
    }
}
