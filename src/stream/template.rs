//! Template convolution on a stream: section 3 of `docs/methods.md`, where it needs the last samples only.

use std::collections::VecDeque;

use super::judge::{Event, Online, Said};
use crate::math::line::LineSums;
use crate::math::order::{mad_scale_in_place, median};
use crate::math::sliding::Summary;
use crate::method::{Verdict, reaches, shared, zero_scale};
use crate::param::Settings;

/// The last samples of a segment, and what their lines left.
pub(super) struct Template {
    width: usize,
    k: f64,
    rms: bool,
    feedback: bool,
    floor: f64,
    /// Time and value of the first sample: what is computed with is relative to them, so that offsets cost no digits.
    origin: Option<(f64, f64)>,
    /// The last samples before the one at hand; flagged ones replaced, with feedback.
    points: VecDeque<[f64; 2]>,
    /// The last residuals as they were measured.
    residuals: VecDeque<f64>,
    count: usize,
    /// What counts as a scale of zero among the values so far.
    zero: f64,
    scratch: Vec<f64>,
}

impl Template {
    /// With the settings of the method `template`, without a pooled noise floor.
    pub(super) fn new(settings: &Settings, floor: f64) -> Self {
        Self {
            width: settings.whole(shared::WINDOW.key),
            k: settings.real(shared::K.key),
            rms: settings.word(shared::SCALE.key) == "rms",
            feedback: settings.switch(shared::FEEDBACK.key),
            floor,
            origin: None,
            points: VecDeque::new(),
            residuals: VecDeque::new(),
            count: 0,
            zero: 0.0,
            scratch: Vec::new(),
        }
    }

    /// The scale of the last residuals, that of the sample at hand included.
    fn scale(&mut self) -> f64 {
        self.scratch.clear();
        self.scratch.extend(&self.residuals);
        let n = self.scratch.len();
        if n == 1 {
            return 0.0;
        }
        if !self.rms {
            let center = median(&self.scratch);
            return mad_scale_in_place(&mut self.scratch, center);
        }
        #[expect(clippy::cast_precision_loss, reason = "at most a window")]
        let freedom = (n - 1) as f64;
        (self.scratch.iter().map(|r| r * r).sum::<f64>() / freedom).sqrt()
    }
}

/// Adds to the newest of at most `most`.
fn keep<T>(newest: &mut VecDeque<T>, value: T, most: usize) {
    if newest.len() == most {
        newest.pop_front();
    }
    newest.push_back(value);
}

impl Online for Template {
    fn push(&mut self, t: f64, y: f64, events: &mut Vec<Event>) {
        let at = self.count;
        self.count += 1;
        let origin = *self.origin.get_or_insert((t, y));
        self.zero = self.zero.max(zero_scale(&[y]));
        let mut point = [t - origin.0, y - origin.1];
        if at >= 2 {
            let mut sums = LineSums::default();
            self.points.iter().for_each(|p| sums.add(*p));
            sums.add(point);
            let fit = sums.at(point[0]);
            let residual = point[1] - fit;
            keep(&mut self.residuals, residual, self.width);
            let scale = self.scale();
            // The rule of zero comes before the floor.
            let tolerance = self.k * if scale > self.zero { scale.max(self.floor) } else { self.floor };
            let outlier = reaches(residual.abs(), tolerance);
            let verdict = if outlier { Verdict::Outlier } else { Verdict::Normal };
            events.push(Event::Says(at, Said { verdict, expected: fit + origin.1, tolerance }));
            if outlier && self.feedback {
                point[1] = fit;
            }
        }
        keep(&mut self.points, point, self.width - 1);
    }
}
