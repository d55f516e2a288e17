//! The floor of each sample, applied to what a method says: noise that changes along the record needs a limit that
//! changes with it, whatever the method.

use super::shared::multiplier;
use super::{Judged, Segment, Verdict, reaches};
use crate::param::Settings;
use crate::stop::{Stop, Stopped};

/// An outlier lies outside of what both sides expect by this share of its tolerance at least: then no real change of
/// the target, which one side agrees with, is removed.
const OUTSIDE: f64 = 0.3;

/// What `judged` is with no tolerance below the multiplier times the floor of its sample. An objection that does not
/// reach that is withdrawn, and one with which only one side of the sample agrees leaves it suspect.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub(super) fn bounded_below(
    mut judged: Judged,
    segment: &Segment<'_>,
    settings: &Settings,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    if segment.floors.len() != judged.verdict.len() {
        return Ok(judged);
    }
    stop.check()?;
    let k = multiplier(settings);
    judged.scale.clear();
    for (i, verdict) in judged.verdict.iter_mut().enumerate() {
        let (y, expected, tolerance) = (segment.y[i], judged.expected[i], &mut judged.tolerance[i]);
        if tolerance.is_nan() || expected.is_nan() {
            continue;
        }
        *tolerance = tolerance.max(k * segment.floors[i]);
        // What only one direction objects to is suspect already: its expected value is that of the other one.
        if *verdict != Verdict::Outlier {
            continue;
        }
        if !reaches((y - expected).abs(), *tolerance) {
            *verdict = Verdict::Normal;
        } else if segment.objections[i] < OUTSIDE * *tolerance {
            *verdict = Verdict::Suspect;
        }
    }
    Ok(judged)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::{Method, hampel::Hampel};

    #[test]
    fn a_flag_needs_the_floor_of_its_sample_and_the_objection_of_both_sides() {
        let y = [0.0, 9.0, 9.0, 9.0];
        // The multiplier of hampel is 3 by default; that of these settings is 4.
        let mut settings = Settings::defaults(Hampel.about().params);
        settings.set_text("hampel", "k", "4").unwrap();
        let (floors, objections) = ([1.0, 1.0, 3.0, 1.0], [0.0, 9.0, 9.0, 1.0]);
        let t = [0.0, 1.0, 2.0, 3.0];
        let segment = Segment {
            t: &t,
            y: &y,
            interval: 1.0,
            sigma: 1.0,
            floor: 1.0,
            floors: &floors,
            objections: &objections,
            rate: None,
        };
        let said = Judged {
            verdict: vec![Verdict::Normal, Verdict::Outlier, Verdict::Outlier, Verdict::Outlier],
            expected: vec![0.0; 4],
            tolerance: vec![2.0; 4],
            ..Judged::default()
        };
        let judged = bounded_below(said, &segment, &settings, &Stop::never()).unwrap();
        let wanted = [Verdict::Normal, Verdict::Outlier, Verdict::Normal, Verdict::Suspect];
        assert_eq!((judged.verdict, judged.tolerance), (wanted.to_vec(), vec![4.0, 4.0, 12.0, 4.0]));
    }
}
