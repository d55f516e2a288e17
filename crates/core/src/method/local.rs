//! The floor of each sample, applied to what a method says: noise that changes along the record needs a limit that
//! changes with it, whatever the method.

use super::shared::{C, K};
use super::{Judged, Method, Segment, Verdict, reaches};
use crate::param::{Settings, Value};
use crate::stop::{Stop, Stopped};

/// What `judged` is with no tolerance below the multiplier times the floor of its sample. An objection that does not
/// reach that is withdrawn.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub(super) fn bounded_below(
    mut judged: Judged,
    segment: &Segment<'_>,
    method: &dyn Method,
    settings: &Settings,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    if segment.floors.len() != judged.verdict.len() {
        return Ok(judged);
    }
    if judged.scale.len() == segment.floors.len()
        && let Some(key) = method.gate(settings)
    {
        judged.scale.iter_mut().zip(segment.floors).for_each(|(scale, floor)| *scale = scale.max(*floor));
        judged.gate(segment.y, settings.real(key), stop)?;
        return Ok(judged);
    }
    let k = multiplier(settings);
    stop.check()?;
    let said = judged.verdict.iter_mut().zip(&judged.expected).zip(&mut judged.tolerance);
    for (((verdict, &expected), tolerance), (&y, &floor)) in said.zip(segment.y.iter().zip(segment.floors)) {
        if tolerance.is_nan() || expected.is_nan() {
            continue;
        }
        *tolerance = tolerance.max(k * floor);
        if matches!(verdict, Verdict::Outlier | Verdict::Suspect) && !reaches((y - expected).abs(), *tolerance) {
            *verdict = Verdict::Normal;
        }
    }
    Ok(judged)
}

/// The multiplier of these settings; 4 for criteria that have none.
pub(super) fn multiplier(settings: &Settings) -> f64 {
    match settings.get(K.key).or_else(|| settings.get(C.key)) {
        Some(Value::Real(k)) => k,
        _ => 4.0,
    }
}
