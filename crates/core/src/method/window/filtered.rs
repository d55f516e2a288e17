//! The windows' own values, over the record with the wild samples replaced.

use super::{Center, Rule, judge};
use crate::method::filtered::{Filter, Filtered, Fit, Settled, fits};
use crate::method::{Damaged, Segment, shared};
use crate::stop::{Stop, Stopped};

/// The model of the sliding mean and the sliding median.
pub(in crate::method) struct Smooth(pub(in crate::method) Center);

impl Filter for Smooth {
    fn about(&self) -> &'static str {
        match self.0 {
            Center::Mean => "mean of the window around the sample, wild ones replaced",
            Center::Median => "median of the window around the sample, wild ones replaced",
        }
    }

    fn run(&self, settled: &Settled<'_>, stop: &Stop) -> Result<Filtered, Stopped> {
        let Damaged { segment, settings, .. } = settled.damaged;
        let Some(y) = settled.standing() else { return Ok(Filtered::none(segment.len())) };
        let rule = Rule { feedback: false, ..Rule::of(settings, self.0) };
        let judged = judge(&rule, &Segment { y: &y, ..*segment }, stop)?;
        Ok(Filtered::of_values(judged.expected))
    }
}

/// The model of the sliding polynomial: its value in the middle of the window.
pub(in crate::method) struct Middle;

impl Filter for Middle {
    fn about(&self) -> &'static str {
        "polynomial over the window around the sample, wild ones replaced"
    }

    fn run(&self, settled: &Settled<'_>, stop: &Stop) -> Result<Filtered, Stopped> {
        let Damaged { segment, settings, .. } = settled.damaged;
        let (width, order) = (settings.whole(shared::WINDOW.key), settings.whole("order"));
        let Some(y) = settled.standing() else { return Ok(Filtered::none(segment.len())) };
        let (before, after) = (width / 2, width - 1 - width / 2);
        fits(segment.t, &y, |_| true, &Fit { before, after, order, least: order + 2, sigma: f64::NAN }, stop)
    }
}

/// The line that ends at each sample: the model of `template`, `five-point` and `adaptive`.
pub(in crate::method) struct LineUpTo {
    /// Its samples; those of `window` where none are given.
    pub(in crate::method) points: Option<usize>,
    /// With fewer there is no value.
    pub(in crate::method) least: usize,
    /// True where `sigma` is the noise that the method judges by, and the value has a standard deviation.
    pub(in crate::method) deviation: bool,
}

impl Filter for LineUpTo {
    fn about(&self) -> &'static str {
        "end of the line through the last samples, this one included, wild ones replaced"
    }

    fn run(&self, settled: &Settled<'_>, stop: &Stop) -> Result<Filtered, Stopped> {
        let Damaged { segment, settings, .. } = settled.damaged;
        let Some(y) = settled.standing() else { return Ok(Filtered::none(segment.len())) };
        let points = self.points.unwrap_or_else(|| settings.whole(shared::WINDOW.key));
        let sigma = if self.deviation { segment.sigma } else { f64::NAN };
        let fit = Fit { before: points - 1, after: 0, order: 1, least: self.least, sigma };
        let mut filtered = fits(segment.t, &y, |_| true, &fit, stop)?;
        // The first samples have what the verdicts of the first have: a look from the other side.
        if settings.get(shared::LOOK_BACK.key).is_some_and(|_| settings.switch(shared::LOOK_BACK.key)) {
            let first = self.least.min(y.len()).saturating_sub(1);
            let reach = y.len().min(first + points);
            let back = Fit { before: 0, after: points - 1, ..fit };
            let ahead = fits(&segment.t[..reach], &y[..reach], |_| true, &back, stop)?;
            filtered.value[..first].copy_from_slice(&ahead.value[..first]);
            filtered.deviation[..first].copy_from_slice(&ahead.deviation[..first]);
        }
        Ok(filtered)
    }
}
