//! Template convolution: each sample against the end of the straight line through the samples up to it.

use super::window::{self, Limits, LineUpTo, Spread};
use super::{About, Filter, Judged, Method, Own, Segment, Verdict, reaches, shared};
use crate::math::line::LineSums;
use crate::math::moments::Moments;
use crate::math::pieces;
use crate::math::sliding::{Sliding, Summary};
use crate::math::sorted_window::SortedWindow;
use crate::param::{Param, Settings};
use crate::stop::{Stop, Stopped};

/// The method `template` of section 3 of `docs/methods.md`.
#[derive(Debug, Clone, Copy)]
pub struct Template;

static PARAMS: [Param; 8] = [
    shared::WINDOW,
    shared::K,
    shared::SCALE,
    shared::FEEDBACK,
    shared::NOISE_FLOOR,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

static ABOUT: About = About {
    id: "template",
    name: "template convolution",
    family: shared::SLIDING_WINDOW,
    source: "[003] s.2, template convolution",
    advice: "Compares each sample with the end of the line fitted to the last n. It needs no later sample, but lags by \
             about a T^2 n^2 / 12 under an acceleration a: keep that below the noise. [003] finds it the worst of its \
             four, and worse with longer windows. The first two samples are not judged.",
    params: &PARAMS,
    own: Own::Expected,
    needs_rate: false,
};

impl Method for Template {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        let n = segment.len();
        if n < 3 {
            return Ok(window::too_short(n, window::has_feedback(settings)));
        }
        let check = || stop.check();
        let mut lines = Lines::new(segment, settings, stop)?;
        // What is said on the data as given: residual and scale. With feedback, only what lies within reach of a
        // replaced sample differs from it.
        let mut residual = vec![0.0; n];
        window::sweep(&mut residual, stop, State::default, |state, i| lines.residual(state, i))?;
        let mut scale = vec![0.0; n];
        window::sweep(&mut scale, stop, State::default, |state, i| lines.scale(state, &residual, i))?;
        let pooled = settings.word(shared::NOISE_FLOOR.key) == "pooled";
        let limits = Limits::new(pooled.then_some(&scale[2..]), segment, stop)?;
        let k = settings.real(shared::K.key);
        if window::has_feedback(settings) {
            return lines.feed_back(&mut residual, &scale, &limits, k, stop);
        }
        let expected = pieces::collect(n, &check, |i| segment.y[i] - residual[i])?;
        pieces::over(&mut scale, &check, |_, scale| scale.iter_mut().for_each(|s| *s = limits.bound(*s)))?;
        let mut judged = Judged::gated(segment.y, expected, scale, k, stop)?;
        judged.scale[..2].fill(f64::NAN);
        judged.tolerance[..2].fill(f64::NAN);
        Ok(judged)
    }

    fn gate(&self, settings: &Settings) -> Option<&'static str> {
        window::gate(settings)
    }

    fn filter(&self, _: &Settings) -> Option<&'static dyn Filter> {
        Some(&LineUpTo { points: None, least: 3, deviation: false })
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        // The scale is taken about zero, as that of the median window: a lone spike leaves the others at 0.
        window::warnings(settings, window::Center::Median)
    }
}

/// Lines through the last samples, and the scale of what they left.
struct Lines {
    /// Time from the first sample, value less the level; flagged values replaced.
    points: Vec<[f64; 2]>,
    level: f64,
    width: usize,
    spread: Spread,
}

/// What one run along the samples carries on.
#[derive(Default)]
struct State {
    line: Sliding<LineSums>,
    sorted: SortedWindow,
    squares: Sliding<Moments>,
}

impl Lines {
    fn new(segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Self, Stopped> {
        let level = window::level(segment.y);
        let point = |i: usize| [segment.t[i] - segment.t[0], segment.y[i] - level];
        let points = pieces::collect(segment.len(), &|| stop.check(), point)?;
        let width = settings.whole(shared::WINDOW.key);
        Ok(Self { points, level, width, spread: window::spread(settings) })
    }

    /// First of the last `width` samples up to `i`, none before `least`.
    fn begin(&self, i: usize, least: usize) -> usize {
        (i + 1).saturating_sub(self.width).max(least)
    }

    /// What the line that ends at sample `i` leaves of it; NaN for the first two.
    fn residual(&self, state: &mut State, i: usize) -> f64 {
        if i < 2 {
            return f64::NAN;
        }
        // Only the samples before are kept in the sums: the one at the end may yet be replaced.
        state.line.move_to(&self.points, self.begin(i, 0)..i);
        let mut sums = state.line.get();
        sums.add(self.points[i]);
        let [t, x] = self.points[i];
        x - sums.at(t)
    }

    /// The scale of the last residuals up to `i`.
    fn scale(&self, state: &mut State, residual: &[f64], i: usize) -> f64 {
        if i < 2 {
            return f64::NAN;
        }
        let last = self.begin(i, 2)..i + 1;
        match self.spread {
            _ if last.len() == 1 => 0.0,
            Spread::Mad => {
                state.sorted.move_to(residual, last);
                state.sorted.mad_scale(state.sorted.median())
            }
            // It is made of residuals either way.
            Spread::Rms | Spread::Residuals => {
                state.squares.move_to(residual, last);
                let sums = state.squares.get();
                (sums.squares_about(0.0) / (sums.count - 1.0)).sqrt()
            }
        }
    }

    /// One pass in which a flagged sample is replaced by its expected value before the window moves on. `residual`
    /// and `scales` are those of the data as given.
    fn feed_back(
        &mut self,
        residual: &mut [f64],
        scales: &[f64],
        limits: &Limits<'_>,
        k: f64,
        stop: &Stop,
    ) -> Result<Judged, Stopped> {
        let n = self.points.len();
        let mut judged = Judged::unchecked_many(n, stop)?;
        let mut state = State::default();
        // The last sample that was replaced, and the last residual that differs from that on the data as given.
        let (mut replaced, mut changed) = (None, None);
        for i in 2..n {
            stop.check_at(i)?;
            let begin = self.begin(i, 0);
            if replaced.is_some_and(|last| last >= begin) {
                residual[i] = self.residual(&mut state, i);
                changed = Some(i);
            }
            let scale =
                if changed.is_some_and(|last| last >= begin) { self.scale(&mut state, residual, i) } else { scales[i] };
            let tolerance = k * limits.bound(scale);
            let x = self.points[i][1] - residual[i];
            judged.expected[i] = x + self.level;
            judged.tolerance[i] = tolerance;
            judged.verdict[i] = Verdict::Normal;
            if reaches(residual[i].abs(), tolerance) {
                judged.verdict[i] = Verdict::Outlier;
                self.points[i][1] = x;
                replaced = Some(i);
            }
        }
        Ok(judged)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::math::order::{mad_scale_in_place, median};
    use crate::math::polyfit::Polynomial;
    use crate::param::Value;

    /// The page's words, one window after the other, without a pooled floor.
    fn plain(t: &[f64], y: &[f64], n: usize, rms: bool, feedback: bool) -> (Vec<bool>, Vec<f64>) {
        let (mut x, mut rest) = (y.to_vec(), Vec::new());
        let (mut flags, mut expected) = (vec![false; 2], vec![f64::NAN; 2]);
        for i in 2..y.len() {
            let window = (i + 1).saturating_sub(n)..i + 1;
            let p = Polynomial::fit(&t[window.clone()], &x[window], 1).at(t[i]);
            rest.push(y[i] - p);
            let last = &rest[rest.len().saturating_sub(n)..];
            let scale = match last.len() {
                1 => 0.0,
                m if rms => (last.iter().map(|r| r * r).sum::<f64>() / (m as f64 - 1.0)).sqrt(),
                _ => mad_scale_in_place(&mut last.to_vec(), median(last)),
            };
            flags.push(scale > super::super::zero_scale(y) && reaches((y[i] - p).abs(), 3.0 * scale));
            expected.push(p);
            if flags[i] && feedback {
                x[i] = p;
            }
        }
        (flags, expected)
    }

    proptest! {
        #[test]
        fn it_equals_its_plain_twin(
            y in prop::collection::vec(prop_oneof![8 => -1.0..1.0, 1 => 5.0..40.0, 1 => -40.0..-5.0], 3..120),
            n in 3i64..30, rms: bool, feedback: bool,
        ) {
            let t: Vec<f64> = (0..y.len()).map(|i| i as f64 + 0.3 * (i % 3) as f64).collect();
            let mut settings = Settings::defaults(&PARAMS);
            for (key, value) in [
                ("window", Value::Whole(n)),
                ("scale", Value::Word(if rms { "rms" } else { "mad" })),
                ("feedback", Value::Switch(feedback)),
                ("noise_floor", Value::Word("off")),
            ] {
                settings.set("template", key, value).unwrap();
            }
            let segment = Segment { t: &t, y: &y, interval: 1.0, sigma: 0.0, floor: 0.0, floors: &[], objections: &[], rate: None };
            let judged = Template.judge(&segment, &settings, &Stop::never()).unwrap();
            let (flags, expected) = plain(&t, &y, n as usize, rms, feedback);
            for i in 0..y.len() {
                prop_assert_eq!(judged.verdict[i] == Verdict::Outlier, flags[i], "sample {}", i);
                prop_assert!(i < 2 || (judged.expected[i] - expected[i]).abs() < 1e-9);
            }
        }
    }
}
