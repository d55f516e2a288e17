//! The floor of each sample, applied to what a method says: noise that changes along the record needs a limit that
//! changes with it, whatever the method.

use super::shared::{C, K};
use super::{Judged, Segment, Verdict, reaches};
use crate::param::{Settings, Value};
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

/// The multiplier of these settings; 4 for criteria that have none.
fn multiplier(settings: &Settings) -> f64 {
    match settings.get(K.key).or_else(|| settings.get(C.key)) {
        Some(Value::Real(k)) => k,
        _ => 4.0,
    }
}
