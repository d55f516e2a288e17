//! `linear`: the line between the nearest accepted samples.

use super::Around;
use crate::param::Settings;

/// Values on the line from the last sample before to the first after.
pub(super) fn values(around: &Around<'_>, at: &[f64], _: &Settings) -> Option<Vec<f64>> {
    draw(around, at)
}

/// The same, which has no settings.
pub(super) fn draw(around: &Around<'_>, at: &[f64]) -> Option<Vec<f64>> {
    let (&t0, &y0) = around.before.0.last().zip(around.before.1.last())?;
    let (&t1, &y1) = around.after.0.first().zip(around.after.1.first())?;
    Some(at.iter().map(|t| y0 + (y1 - y0) * ((t - t0) / (t1 - t0))).collect())
}
