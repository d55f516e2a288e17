//! What a method sees: the samples of one segment, with the scales to judge them by.

use std::ops::Range;

use super::noise;
use crate::calibration::local_interval;
use crate::math::movement;
use crate::series::Series;
use crate::stop::{Stop, Stopped};

/// What a method sees: the present samples of one segment, never empty.
#[derive(Debug, Clone, Copy)]
pub struct Segment<'a> {
    /// Times in seconds, strictly increasing.
    pub t: &'a [f64],
    /// Values, finite, as many.
    pub y: &'a [f64],
    /// Nominal interval in seconds, of the whole channel or, where the record was calibrated, of the segment; NaN where
    /// that has one sample.
    pub interval: f64,
    /// Noise scale by the setting `sigma`, at least [`Segment::floor`]; 0 when it counts as zero (section 1 of
    /// `docs/methods.md`), and for methods without that setting.
    pub sigma: f64,
    /// Lower bound on any scale, by the setting `floor`; 0 when there is none. The median of [`Segment::floors`] where
    /// each sample has its own.
    pub floor: f64,
    /// Lower bound on the scale of each sample; empty where one holds for all.
    pub floors: &'a [f64],
    /// What the calibration has against each sample; with [`Segment::floors`].
    pub objections: &'a [noise::Objection],
    /// The present samples of the rate channel, over the whole record.
    pub rate: Option<Rate<'a>>,
}

/// The present samples of a channel that measures the rate of the judged one, per second.
#[derive(Debug, Clone, Copy)]
pub struct Rate<'a> {
    /// Times in seconds, strictly increasing.
    pub t: &'a [f64],
    /// Values, finite, as many.
    pub y: &'a [f64],
}

impl<'a> Segment<'a> {
    /// The segment of `series` that `range` names.
    #[must_use]
    pub fn of(series: &'a Series<'_>, range: &Range<usize>, scales: &'a noise::Scales, rate: Option<Rate<'a>>) -> Self {
        Self {
            t: &series.t[range.clone()],
            y: &series.y[range.clone()],
            interval: if scales.floors.is_some() { local_interval(&series.t[range.clone()]) } else { series.interval },
            sigma: scales.sigma,
            floor: scales.floor,
            floors: scales.floors.as_deref().map_or(&[], |all| &all[range.clone()]),
            objections: scales.objections.as_deref().map_or(&[], |all| &all[range.clone()]),
            rate,
        }
    }

    /// How many samples it has.
    #[must_use]
    pub fn len(&self) -> usize {
        self.y.len()
    }

    /// True when it has none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.y.is_empty()
    }

    /// Samples lost just before sample `i`; 0 for the first.
    #[must_use]
    pub fn lost_before(&self, i: usize) -> usize {
        if i == 0 { 0 } else { crate::series::lost_samples(self.t[i] - self.t[i - 1], self.interval) }
    }

    /// What counts as a scale of zero here: `8 * 2^-52 * max|y|`.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for it any more.
    pub fn zero(&self, stop: &Stop) -> Result<f64, Stopped> {
        zero_scale_of_many(self.y, stop)
    }

    /// A scale measured in this segment: taken as 0 when it is at most `zero`, and then at least the floor.
    #[must_use]
    #[inline]
    pub fn bounded(&self, scale: f64, zero: f64) -> f64 {
        if scale > zero { scale.max(self.floor) } else { self.floor }
    }
}

/// A scale of at most this counts as zero among such values: what rounding alone leaves of an exact line.
#[must_use]
pub fn zero_scale(y: &[f64]) -> f64 {
    8.0 * f64::EPSILON * movement::largest(y)
}

/// [`zero_scale`] of many values.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for it any more.
pub fn zero_scale_of_many(y: &[f64], stop: &Stop) -> Result<f64, Stopped> {
    Ok(8.0 * f64::EPSILON * movement::largest_of_many(y, &|| stop.check())?)
}
