//! What the methods of section 3 of `docs/methods.md` share: windows, scales, pooled floor and feedback \[003\].

use rayon::prelude::*;

use super::{Judged, Segment, Verdict, reaches, shared};
use crate::math::order::median_of_many;
use crate::math::pieces;
use crate::param::Settings;
use crate::stop::{Stop, Stopped};

mod baseline;
mod figures;
mod filtered;
mod geometry;
mod polynomial;
mod residuals;
mod sorted;
mod statistics;
mod warning;

use figures::{Figures, figures};
pub(super) use filtered::{LineUpTo, Middle, Smooth};
pub(super) use geometry::{Edge, Windows, level};
pub(super) use polynomial::{PolyRule, judge as judge_polynomials};
pub(super) use sorted::medians;
use statistics::Statistics;
pub(super) use warning::{of_reach, warnings};

/// Samples that one piece of parallel work handles. It does not depend on the number of threads, so neither do the
/// bits of the results.
pub(super) const CHUNK: usize = 8192;

/// What a window's samples are compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Center {
    Mean,
    Median,
}

/// How a window's scale is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Spread {
    /// `1.4826 * median |x - median(x)|`.
    Mad,
    /// `sqrt(sum (x - p)^2 / (n - 1))` about the expected value `p` of the middle.
    Rms,
    /// The same, each sample about its own expected value.
    Residuals,
}

/// The settings of a window method.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rule {
    pub(super) center: Center,
    pub(super) spread: Spread,
    pub(super) width: usize,
    pub(super) edge: Edge,
    pub(super) detrend: bool,
    pub(super) pooled: bool,
    pub(super) feedback: bool,
    pub(super) k: f64,
}

impl Rule {
    /// The rule that `settings` describe; without a `feedback` setting there is none.
    pub(super) fn of(settings: &Settings, center: Center) -> Self {
        Self {
            center,
            spread: spread(settings),
            width: settings.whole(shared::WINDOW.key),
            edge: Edge::of(settings),
            detrend: settings.word(shared::DETREND.key) == "slope",
            pooled: settings.word(shared::NOISE_FLOOR.key) == "pooled",
            feedback: has_feedback(settings),
            k: settings.real(shared::K.key),
        }
    }
}

/// How these settings measure a window's scale.
pub(super) fn spread(settings: &Settings) -> Spread {
    match settings.word(shared::SCALE.key) {
        "rms" => Spread::Rms,
        "residuals" => Spread::Residuals,
        _ => Spread::Mad,
    }
}

/// True when a flagged sample is replaced before the window moves on.
pub(super) fn has_feedback(settings: &Settings) -> bool {
    settings.get(shared::FEEDBACK.key).is_some_and(|_| settings.switch(shared::FEEDBACK.key))
}

/// The key of the multiplier, where there is no feedback and it only gates.
pub(super) fn gate(settings: &Settings) -> Option<&'static str> {
    (!has_feedback(settings)).then_some(shared::K.key)
}

/// Fills `out` by `each(state, index)`, piece by piece in parallel, each piece with a new state.
pub(super) fn sweep<T: Send, S>(
    out: &mut [T],
    stop: &Stop,
    state: impl Fn() -> S + Sync,
    each: impl Fn(&mut S, usize) -> T + Sync,
) -> Result<(), Stopped> {
    out.par_chunks_mut(CHUNK).enumerate().try_for_each(|(chunk, out)| {
        let mut state = state();
        for (i, slot) in out.iter_mut().enumerate() {
            if i.is_multiple_of(Stop::STRIDE / 4) {
                stop.check()?;
            }
            *slot = each(&mut state, chunk * CHUNK + i);
        }
        Ok(())
    })
}

/// What is said of a segment too short to judge: without feedback it has scales, as the segments beside it have.
pub(super) fn too_short(n: usize, feedback: bool) -> Judged {
    Judged { scale: vec![f64::NAN; if feedback { 0 } else { n }], ..Judged::unchecked(n) }
}

/// Judges a segment by windows around each sample.
pub(super) fn judge(rule: &Rule, segment: &Segment<'_>, stop: &Stop) -> Result<Judged, Stopped> {
    let n = segment.len();
    if n < 3 {
        return Ok(too_short(n, rule.feedback));
    }
    // A level and the slope are taken off first and added again at the end: what is left is as small as the data
    // allow, whatever their offset.
    let level = level(segment.y);
    let slope = if rule.detrend { baseline::slope(segment, rule.width, stop)? } else { None };
    let base = |c: usize| slope.as_ref().map_or(0.0, |slope| slope[c]);
    let windows = Windows::new(n, rule.width, rule.edge);
    let check = || stop.check();
    let samples = pieces::collect(n, &check, |c| segment.y[c] - level - base(c))?;
    let mut x = windows.padded(samples, -level, stop)?;
    let mut figures = figures(rule, &x, &windows, stop)?;
    let mut own = Vec::new();
    if rule.spread == Spread::Residuals {
        own = residuals::residuals(&figures, &x, &windows);
        figures.scale = residuals::scales(&own, &windows, stop)?;
    }
    let limits = Limits::new(rule.pooled.then_some(&figures.scale[..]), segment, stop)?;
    if rule.feedback && rule.spread != Spread::Residuals {
        return feed_back(rule, &windows, &mut x, |c| base(c) + level, &figures, &limits, stop);
    }
    drop(x);
    pieces::over(&mut figures.expected, &check, |first, expected| {
        for (c, expected) in (first..).zip(expected) {
            *expected = *expected + base(c) + level;
        }
    })?;
    if rule.feedback {
        return residuals::feed_back(rule, &windows, &mut own, figures.expected, &limits, stop);
    }
    drop(slope);
    pieces::over(&mut figures.scale, &check, |_, scale| scale.iter_mut().for_each(|s| *s = limits.bound(*s)))?;
    Judged::gated(segment.y, figures.expected, figures.scale, rule.k, stop)
}

/// The lower bounds on a window's scale.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits<'a> {
    segment: Segment<'a>,
    zero: f64,
    pooled: f64,
}

impl<'a> Limits<'a> {
    /// With the pooled floor, the median of the scales of all windows on the data as given, when they are there.
    pub(super) fn new(scales: Option<&[f64]>, segment: &Segment<'a>, stop: &Stop) -> Result<Self, Stopped> {
        let median = |scales: &[f64]| median_of_many(scales.len(), |i| scales[i], &|| stop.check());
        let pooled = scales.map(median).transpose()?.map_or(0.0, |median| median.max(0.0));
        Ok(Self { segment: *segment, zero: segment.zero(stop)?, pooled })
    }

    /// The scale to judge by, for a measured one.
    #[inline]
    pub(super) fn bound(&self, scale: f64) -> f64 {
        self.segment.bounded(scale.max(self.pooled), self.zero)
    }
}

/// One pass in which a flagged sample is replaced by its expected value before the window moves on. Windows without
/// a replaced sample have been measured already.
fn feed_back(
    rule: &Rule,
    windows: &Windows,
    x: &mut [f64],
    base: impl Fn(usize) -> f64,
    figures: &Figures,
    limits: &Limits<'_>,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    let n = windows.len();
    let mut judged = Judged { verdict: vec![Verdict::Normal; n], ..Judged::default() };
    judged.expected.reserve_exact(n);
    judged.tolerance.reserve_exact(n);
    let mut statistics = Statistics::new(rule);
    // Windows that begin at or before this position hold a replaced sample.
    let mut touched: Option<usize> = None;
    for c in 0..n {
        stop.check_at(c)?;
        let range = windows.range(c);
        let [p, scale] = if touched.is_some_and(|last| last >= range.start) {
            statistics.move_to(x, range.clone(), windows.center(c));
            statistics.figures()
        } else {
            [figures.expected[c], figures.scale[c]]
        };
        let tolerance = rule.k * limits.bound(scale);
        judged.expected.push(p + base(c));
        judged.tolerance.push(tolerance);
        let old = x[windows.center(c)];
        if reaches((old - p).abs(), tolerance) {
            judged.verdict[c] = Verdict::Outlier;
            touched = Some(windows.last_touched(c));
            if windows.replace(x, c, p) > 1 {
                statistics.forget();
            } else {
                statistics.replaced(windows.center(c), &range, old, p);
            }
        }
    }
    Ok(judged)
}

#[cfg(test)]
mod tests;
